"""Other importers simulate the bearing as fmpy does: each a program of its own, with its own idea of time, start values
and tolerance.
"""

import json
import logging
import zipfile

import fmpy
import numpy as np
import pytest

STEP, STEPS = 1e-4, 20
# Off the FMU's own start values: an importer that does not pass them on fails.
START = {"shaft.omega": 1500.0, "shaft.F_y": 2000.0, "shaft.F_x": 300.0, "joint.preload": 30.0}
OUTPUTS = ("rivet.sigma_head_max", "housing.F_y", "bearing.friction_torque", "ring.y", "cage.slip_ratio", "ball[1].Q_i")
# The steps have equal sizes but in rounding, where hosts count time their own way (t + h, k h, nanoseconds): what a
# user may count on over a short
# horizon, as for the binaries of other platforms in test_package.py.
SAME = 1e-9


def simulate(path, start=START):
    """Outputs at the communication points by fmpy, the start among them; at the FMU's own tolerance, as nobody passes
    one.
    """
    times = {"stop_time": STEPS * STEP, "step_size": STEP, "output_interval": STEP}
    result = fmpy.simulate_fmu(str(path), **times, start_values=start, output=OUTPUTS)
    return np.array([result[name] for name in OUTPUTS]).T


@pytest.fixture(scope="module")
def expected(fmu):
    rows = simulate(fmu)
    assert len(rows) == STEPS + 1
    default = simulate(fmu, start={})
    # the start values matter to each output
    assert np.all(np.abs(rows - default).max(axis=0) > 1e-3 * np.abs(default).max(axis=0))
    return rows


def difference(rows, expected):
    """Largest difference of an output against its largest magnitude."""
    return np.max(np.abs(rows - expected) / np.abs(expected).max(axis=0))


def test_libcosim(fmu, expected, tmp_path):
    """Fixed-step master in nanoseconds.  Observed: 5e-12."""
    pytest.importorskip("libcosimpy", reason="libcosimpy is not installed: pip install libcosimpy")
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimObserver import CosimObserver
    from libcosimpy.CosimSlave import CosimLocalSlave

    vr = {v.name: v.valueReference for v in fmpy.read_model_description(str(fmu)).modelVariables}
    execution = CosimExecution.from_step_size(round(STEP * 1e9))
    slave = execution.add_local_slave(CosimLocalSlave(fmu_path=str(fmu), instance_name="bearing"))
    observer = CosimObserver.create_last_value()
    execution.add_observer(observer)
    for name, value in START.items():
        assert execution.real_initial_value(slave, vr[name], value)
    rows = []
    for _ in range(STEPS):
        assert execution.step()
        rows.append(observer.last_real_values(slave, [vr[name] for name in OUTPUTS]))
    assert difference(rows, expected[1:]) < SAME


def test_ecos(ecospy, fmu, expected):
    """Observed: 8e-12."""
    structure = ecospy.EcosSimulationStructure()
    structure.add_model("bearing", fmu)
    structure.add_parameter_set("start", {f"bearing::{name}": value for name, value in START.items()})
    rows = []
    with ecospy.EcosSimulation(structure=structure, step_size=STEP) as simulation:
        simulation.init(parameter_set="start")
        for _ in range(STEPS):
            simulation.step()
            rows.append([simulation.get_real(f"bearing::{name}") for name in OUTPUTS])
    assert difference(rows, expected[1:]) < SAME


def by_fmuloader(fmu, integers):
    """Outputs at the communication points by a loader that asks for the functions of model exchange too."""
    fmi2 = pytest.importorskip("fmuloader.fmi2", reason="fmuloader is not installed: pip install fmuloader")
    description = fmpy.read_model_description(str(fmu))
    vr = {v.name: v.valueReference for v in description.modelVariables}
    rows = []
    with fmi2.Fmi2Slave(str(fmu), model_identifier=description.coSimulation.modelIdentifier) as slave:
        slave.instantiate("bearing", fmi2.Fmi2Type.CO_SIMULATION, guid=description.guid)
        slave.setup_experiment(start_time=0.0)
        slave.set_real([vr[name] for name in START], list(START.values()))
        slave.set_integer([vr[name] for name in integers], list(integers.values()))
        slave.enter_initialization_mode()
        slave.exit_initialization_mode()
        for k in range(STEPS):
            slave.do_step(k * STEP, STEP)
            rows.append(slave.get_real([vr[name] for name in OUTPUTS]))
        slave.terminate()
    return rows


def test_fmuloader(fmu, expected):
    """Observed: 1.2e-11."""
    assert difference(by_fmuloader(fmu, {}), expected[1:]) < SAME


def test_items_beside_a_gap(fmu, expected):
    """The items of scene.cage are 1 and 3.  Observed: 1.2e-11."""
    rigid = simulate(fmu, start=START | {"scene.cage": 1})
    for number, rows in ((1, rigid), (3, expected)):
        assert difference(by_fmuloader(fmu, {"scene.cage": number}), rows[1:]) < SAME
    assert difference(rigid, expected) > 1e-3


def test_pathsim(fmu, expected):
    """A block diagram with the bearing between constant blocks.

    The bearing's step to (k + 1) STEP is an event at k STEP: that far it has come when the diagram's clock shows k
    STEP.  Observed: 1.2e-11.
    """
    pathsim = pytest.importorskip("pathsim", reason="pathsim-fmi is not installed: pip install pathsim-fmi")
    pathsim_fmi = pytest.importorskip("pathsim_fmi", reason="pathsim-fmi is not installed: pip install pathsim-fmi")
    from pathsim.blocks import Constant

    bearing = pathsim_fmi.CoSimulationFMU(str(fmu), start_values=START, dt=STEP)
    inputs = {v.name: v for v in bearing.fmu_wrapper.model_description.modelVariables if v.causality == "input"}
    sources = [Constant(START.get(name, float(variable.start))) for name, variable in inputs.items()]
    wires = [pathsim.Connection(source, bearing[name]) for name, source in zip(inputs, sources)]
    simulation = pathsim.Simulation([bearing, *sources], wires, dt=STEP, log=False)
    rows = []
    for _ in range(STEPS - 1):
        simulation.run(STEP, reset=False)
        values = dict(zip(bearing.fmu_wrapper.output_refs, bearing.outputs.to_array()))
        rows.append([values[name] for name in OUTPUTS])
    assert difference(rows, expected[2:]) < SAME


@pytest.mark.parametrize("name", ["RivetedBearing.fmu", "Shaft.fmu"])
def test_checker_of_fmu_manipulation_toolbox(fmu, name, caplog):
    """Schema and the rules it cannot express: no finding."""
    checker = pytest.importorskip("fmu_manipulation_toolbox.checker", reason="pip install fmu-manipulation-toolbox")
    from fmu_manipulation_toolbox.operations import FMU

    with caplog.at_level(logging.INFO, logger="fmu_manipulation_toolbox"), FMU(str(fmu.with_name(name))) as archive:
        for check in checker.get_checkers():
            archive.apply_operation(check())
    assert any("compliant" in record.message for record in caplog.records)
    assert [record.message for record in caplog.records if record.levelno >= logging.WARNING] == []


def test_container_of_fmu_manipulation_toolbox(fmu, expected, tmp_path):
    """The bearing inside another FMU.  Observed: 1.2e-11.

    The tool takes names that end in [k] for an array too, which it cannot expose, and says so as an error: the elements
    are all there.
    """
    assembly = pytest.importorskip("fmu_manipulation_toolbox.assembly", reason="pip install fmu-manipulation-toolbox")
    (tmp_path / fmu.name).symlink_to(fmu)
    start = [[fmu.name, name, str(value)] for name, value in START.items()]
    description = {"name": "container.fmu", "step_size": STEP, "fmu": [fmu.name], "start": start}
    (tmp_path / "container.json").write_text(json.dumps(description))
    assembly.Assembly("container.json", fmu_directory=tmp_path).make_fmu()
    exposed = {v.name for v in fmpy.read_model_description(str(tmp_path / "container.fmu")).modelVariables}
    assert exposed >= {v.name for v in fmpy.read_model_description(str(fmu)).modelVariables if v.causality == "output"}
    rows = simulate(tmp_path / "container.fmu", start={})  # a tolerance it would take for one of time
    assert difference(rows[1:], expected[1:]) < SAME


def test_container_of_fmpy(fmu, expected, tmp_path):
    """The bearing inside another FMU, its inputs and outputs passed through.  Observed: 1.2e-11."""
    cli = pytest.importorskip("fmpy.container_fmu.cli", reason="needs fmpy >= 0.3.24")
    from fmpy.container_fmu.config import Component, Configuration
    from fmpy.model_description import CoSimulation, DefaultExperiment, ModelDescription, Unknown

    description = fmpy.read_model_description(str(fmu))
    inner = [v for v in description.modelVariables if v.name in (*START, *OUTPUTS) or v.causality == "independent"]
    outer = [v for v in fmpy.read_model_description(str(fmu)).modelVariables if v.name in {v.name for v in inner}]
    container = ModelDescription(
        fmiVersion="2.0", modelName="Container", instantiationToken="{container}", modelVariables=outer, unitDefinitions=description.unitDefinitions,
        typeDefinitions=description.typeDefinitions, outputs=[Unknown(variable=v) for v in outer if v.causality == "output"],
        coSimulation=CoSimulation("container_fmu", fixedInternalStepSize=STEP), defaultExperiment=DefaultExperiment(),
    )  # fmt: skip
    bearing = Component("bearing", fmu, description)
    mappings = {o: [(bearing, i)] for o, i in zip(outer, inner) if o.causality != "independent"}
    (tmp_path / "unzipped").mkdir()
    cli.create_container_fmu(
        Configuration(False, container, [bearing], [], mappings), tmp_path / "unzipped", tmp_path / "container.fmu"
    )
    rows = simulate(tmp_path / "container.fmu")
    assert difference(rows[1:], expected[1:]) < SAME


# ------------------------------------------------------------------------------------------------ tunable parameters


TUNED = {"joint.preload": 60.0, "oil.eta": 0.012}  # set after half of the steps
HALF = STEPS // 2


@pytest.fixture(scope="module")
def tuned(fmu):
    """Outputs by fmpy, which takes tunable parameters as columns of its input."""
    times = np.array([0.0, HALF * STEP, HALF * STEP, STEPS * STEP])
    signals = np.zeros(4, dtype=[("time", float), *((name, float) for name in TUNED)])
    signals["time"] = times
    before = {"joint.preload": START["joint.preload"], "oil.eta": 0.0061}
    for name, value in TUNED.items():
        signals[name] = [before[name]] * 2 + [value] * 2
    times = {"stop_time": STEPS * STEP, "step_size": STEP, "output_interval": STEP}
    start = START | {"oil.eta": before["oil.eta"]}
    result = fmpy.simulate_fmu(str(fmu), **times, start_values=start, input=signals, output=OUTPUTS)
    plain = simulate(fmu, start=start)
    rows = np.array([result[name] for name in OUTPUTS]).T
    assert np.array_equal(rows[: HALF + 1], plain[: HALF + 1])
    assert difference(rows[HALF + 2 :], plain[HALF + 2 :]) > 1e-3
    return start, rows


def test_fmuloader_tunes(fmu, tuned):
    """Observed: 1e-11."""
    fmi2 = pytest.importorskip("fmuloader.fmi2", reason="fmuloader is not installed: pip install fmuloader")
    (start, expected), description = tuned, fmpy.read_model_description(str(fmu))
    vr, rows = {v.name: v.valueReference for v in description.modelVariables}, []
    with fmi2.Fmi2Slave(str(fmu), model_identifier=description.coSimulation.modelIdentifier) as slave:
        slave.instantiate("bearing", fmi2.Fmi2Type.CO_SIMULATION, guid=description.guid)
        slave.setup_experiment(start_time=0.0)
        slave.set_real([vr[name] for name in start], list(start.values()))
        slave.enter_initialization_mode()
        slave.exit_initialization_mode()
        for k in range(STEPS):
            if k == HALF:
                slave.set_real([vr[name] for name in TUNED], list(TUNED.values()))
            slave.do_step(k * STEP, STEP)
            rows.append(slave.get_real([vr[name] for name in OUTPUTS]))
        slave.terminate()
    assert difference(rows, expected[1:]) < SAME


def test_libcosim_tunes(fmu, tuned):
    """Values by the manipulator of a running execution.  Observed: 1e-11."""
    pytest.importorskip("libcosimpy", reason="libcosimpy is not installed: pip install libcosimpy")
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimManipulator import CosimManipulator
    from libcosimpy.CosimObserver import CosimObserver
    from libcosimpy.CosimSlave import CosimLocalSlave

    (start, expected), rows = tuned, []
    vr = {v.name: v.valueReference for v in fmpy.read_model_description(str(fmu)).modelVariables}
    execution = CosimExecution.from_step_size(round(STEP * 1e9))
    slave = execution.add_local_slave(CosimLocalSlave(fmu_path=str(fmu), instance_name="bearing"))
    observer, manipulator = CosimObserver.create_last_value(), CosimManipulator.create_override()
    execution.add_observer(observer)
    execution.add_manipulator(manipulator)
    for name, value in start.items():
        assert execution.real_initial_value(slave, vr[name], value)
    for k in range(STEPS):
        if k == HALF:
            assert manipulator.slave_real_values(slave, [vr[name] for name in TUNED], list(TUNED.values()))
        assert execution.step()
        rows.append(observer.last_real_values(slave, [vr[name] for name in OUTPUTS]))
    assert difference(rows, expected[1:]) < SAME


def test_ecos_tunes(ecospy, fmu, tuned):
    """Observed: 1e-11."""
    (start, expected), rows = tuned, []
    structure = ecospy.EcosSimulationStructure()
    structure.add_model("bearing", fmu)
    structure.add_parameter_set("start", {f"bearing::{name}": value for name, value in start.items()})
    with ecospy.EcosSimulation(structure=structure, step_size=STEP) as simulation:
        if not hasattr(simulation, "set_real"):
            pytest.skip("this ecospy sets no value in a run")
        simulation.init(parameter_set="start")
        for k in range(STEPS):
            for name, value in TUNED.items() if k == HALF else ():
                simulation.set_real(f"bearing::{name}", value)
            simulation.step()
            rows.append([simulation.get_real(f"bearing::{name}") for name in OUTPUTS])
    assert difference(rows, expected[1:]) < SAME


def test_ssp_of_fmpy(fmu, expected, tmp_path):
    """A system of one component, start values in its parameter set.  Observed: 8e-12."""
    result = simulate_ssp_of(fmu, tmp_path, START)
    rows = np.array([result[f"bearing.{name}"] for name in OUTPUTS]).T
    assert difference(rows, expected[1:]) < SAME


def simulate_ssp_of(fmu, folder, start, inputs=None):
    """Result of fmpy for a system of the bearing alone, with parameters wired to connectors of the system: {parameter:
    function of time}.
    """
    from fmpy.ssp.simulation import simulate_ssp
    from fmpy.ssp.ssd import Parameter, ParameterSet

    inputs, path = inputs or {}, folder / "system.ssp"
    wires = [CONNECTOR.format(name=name, kind="input") for name in inputs]
    system = SYSTEM.format(
        fmu=fmu.name,
        connectors="".join([*(CONNECTOR.format(name=name, kind="output") for name in OUTPUTS), *wires]),
        outer=group("Connectors", wires),
        connections=group("Connections", [CONNECTION.format(name=name) for name in inputs]),
    )
    with zipfile.ZipFile(path, "w") as archive:
        archive.write(fmu, f"resources/{fmu.name}")
        archive.writestr("SystemStructure.ssd", system)
    values = ParameterSet(parameters=[Parameter(name=f"bearing.{name}", value=value) for name, value in start.items()])
    return simulate_ssp(str(path), stop_time=(STEPS - 0.5) * STEP, step_size=STEP, parameter_set=values, input=inputs)


def group(name, elements):
    """Elements inside one of the system's, which the schema has only with elements."""
    return f"<ssd:{name}>{''.join(elements)}</ssd:{name}>" if elements else ""


def test_ssp_of_fmpy_tunes(fmu, tmp_path):
    """A parameter wired to a connector of the system changes in the run.  This master begins every connector at 0 and passes a
    value on one step late, so that the rivets have no preload in the first step; the same history as a column of fmpy's input.
    """
    start, before, after = START | {"joint.preload": 0.0}, 30.0, 60.0
    history = {"joint.preload": lambda t: after if t > (HALF - 1.5) * STEP else before}
    result = simulate_ssp_of(fmu, tmp_path, start, history)
    rows = np.array([result[f"bearing.{name}"] for name in OUTPUTS]).T
    signals = np.zeros(6, dtype=[("time", float), ("joint.preload", float)])
    signals["time"] = np.array([0, 1, 1, HALF, HALF, STEPS]) * STEP
    signals["joint.preload"] = [0.0, 0.0, before, before, after, after]
    times = {"stop_time": STEPS * STEP, "step_size": STEP, "output_interval": STEP}
    expected = fmpy.simulate_fmu(str(fmu), **times, start_values=start, input=signals, output=OUTPUTS)
    expected = np.array([expected[name] for name in OUTPUTS]).T
    assert difference(rows, expected[1:]) < SAME
    constant = simulate(fmu, start=start)
    assert difference(rows, constant[1:]) > 1e-3


SYSTEM = """<ssd:SystemStructureDescription xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
    xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon" name="system" version="1.0">
  <ssd:System name="system">
    {outer}<ssd:Elements>
      <ssd:Component name="bearing" type="application/x-fmu-sharedlibrary" source="resources/{fmu}">
        <ssd:Connectors>{connectors}</ssd:Connectors>
      </ssd:Component>
    </ssd:Elements>
    {connections}
  </ssd:System>
</ssd:SystemStructureDescription>"""
CONNECTOR = '<ssd:Connector name="{name}" kind="{kind}"><ssc:Real/></ssd:Connector>'
CONNECTION = '<ssd:Connection startConnector="{name}" endElement="bearing" endConnector="{name}"/>'
