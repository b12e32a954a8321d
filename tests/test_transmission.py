"""The shaft, a second FMU behind the same wrapper, against closed forms; shaft and bearing as one system, by three
masters.
"""

import importlib.util
import json
import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.ssp.ssd import get_connections, read_ssd, read_ssv
from fmpy.validation import validate_fmu
from library import ROOT
from lxml import etree
from slave import OK, Slave

spec = importlib.util.spec_from_file_location("transmission", ROOT / "examples" / "transmission" / "run.py")
transmission = importlib.util.module_from_spec(spec)
spec.loader.exec_module(transmission)

FMU, SYSTEM = ROOT / "fmus" / "Shaft.fmu", ROOT / "fmus" / "Transmission.ssp"
COMMON = "http://ssp-standard.org/SSP1/SystemStructureCommon"
STEP = 1e-4
J, M, OMEGA = 0.05, 40.0, 1500.0
FREE = {"drive__k": 0.0, "support__mu": 0.0, "shaft__J": J, "shaft__omega_start": OMEGA}  # no drive, no friction


@pytest.fixture(scope="module")
def shaft(tmp_path_factory):
    """The shaft's FMU, unzipped."""
    return Path(fmpy.extract(str(FMU), str(tmp_path_factory.mktemp("shaft"))))


def angle_and_speed(slave):
    return slave.get("shaft.phi", "shaft.omega")


# ---------------------------------------------------------------------------------------------------------------- shaft


def test_shaft_is_valid():
    assert validate_fmu(str(FMU)) == []


@pytest.mark.skipif(
    not sys.platform.startswith("linux") or "asan" in os.environ.get("LD_PRELOAD", ""),
    reason="reads an ELF file, without sanitizers",
)
def test_shaft_exports_fmi_only(shaft):
    symbols = subprocess.run(
        ["nm", "-D", "--defined-only", shaft / "binaries" / fmpy.platform / "Shaft.so"],
        capture_output=True,
        text=True,
        check=True,
    )
    exported = [line.split()[-1] for line in symbols.stdout.splitlines()]
    assert len(exported) == 44 and all(name.startswith("fmi2") for name in exported)


def test_constant_torque_on_a_rigid_inertia(shaft):
    """omega = omega_0 - M t / J, phi its integral."""
    slave = Slave(shaft).initialize(**FREE, gear__M=M).step(STEP, 50)
    t = 50 * STEP
    # rounding of 50 steps; observed 2e-15
    assert angle_and_speed(slave) == pytest.approx([OMEGA * t - 0.5 * M / J * t**2, OMEGA - M / J * t], rel=1e-13)


@pytest.mark.parametrize("n", [1, 20])
def test_torque_as_a_polynomial(shaft, n):
    """M = M_0 + M_1 t + M_2 t^2 / 2 inside each step: omega is its cubic integral, however long the steps."""
    slave, M_1, M_2, h = Slave(shaft).initialize(**FREE, gear__M=M), 3e4, -2e6, 5e-3 / n
    gear = slave.vr["gear.M"]
    for k in range(n):
        t = k * h
        slave.set("gear.M", M + M_1 * t + 0.5 * M_2 * t**2)
        slave.check("SetRealInputDerivatives", [gear, gear], 2, [1, 2], [M_1 + M_2 * t, M_2])
        slave.step(h)
    t = 5e-3
    impulse = M * t + M_1 * t**2 / 2 + M_2 * t**3 / 6
    # the method is exact for it: rounding; observed 5e-16
    assert slave.get("shaft.omega")[0] == pytest.approx(OMEGA - impulse / J, rel=1e-14)


def test_drive_pulls_the_speed_to_its_own(shaft):
    """omega - omega_end decays with the time constant J / k."""
    k, omega_d = 8.0, 1600.0
    slave = Slave(shaft).initialize(**FREE | {"drive__k": k}, drive__omega=omega_d, gear__M=M)
    end = omega_d - M / k
    for _ in range(5):
        slave.step(4e-3)
        expected = end + (OMEGA - end) * np.exp(-slave.time * k / J)
        assert slave.get("shaft.omega")[0] - end == pytest.approx(
            expected - end, rel=1e-6
        )  # 20 internal steps a time constant: 5e-8 for each; observed 2e-9 after 3.2 of them, in steps of 0.1 ms


GEOMETRY = {"gear__r_b": 0.05, "gear__alpha": 0.4, "gear__beta": 0.2, "gear__x": 0.03, "shaft__L": 0.1}


def test_forces_of_the_mesh_and_their_balance(shaft):
    """Force M / r_b along the line of action; gear and both bearings in balance, moments taken in three dimensions."""
    slave = Slave(shaft).initialize(**GEOMETRY, gear__M=M, bearing__F_y=0.0, bearing__F_z=0.0)
    gear, a = slave.get("gear.F_x", "gear.F_y", "gear.F_z"), slave.get("shaft.F_x", "shaft.F_y", "shaft.F_z")
    assert np.hypot(gear[1], gear[2]) == pytest.approx(M / 0.05, rel=1e-14)
    assert np.arctan2(gear[1], gear[2]) == pytest.approx(0.4, rel=1e-14)
    assert gear[0] == pytest.approx(gear[2] * np.tan(0.2), rel=1e-14)
    contact, b = np.array([0.03, -0.05 / np.cos(0.4), 0.0]), gear - a
    moment = np.cross(contact, gear) - np.cross([0.1, 0.0, 0.0], b)
    assert moment == pytest.approx([-M, 0.0, 0.0], abs=1e-12)  # [N m], rounding of 40; observed 0
    assert b[0] == 0.0


def test_friction_of_the_other_bearing(shaft):
    """mu F d / 2 of what bearing A does not carry."""
    slave = Slave(shaft).initialize(
        support__mu=0.002, support__d=0.04, gear__M=M, bearing__F_y=300.0, bearing__F_z=-100.0
    )
    load = slave.get("gear.F_y", "gear.F_z") - [300.0, -100.0]
    assert slave.get("support.F_y", "support.F_z") == pytest.approx(load)
    # regularized: 0.5 (1 / 1910)^2 = 1.4e-7, observed
    assert slave.get("support.M")[0] == pytest.approx(0.002 * np.hypot(*load) * 0.02, rel=1e-6)


def test_work_is_kinetic_energy(shaft):
    slave, random = Slave(shaft).initialize(shaft__J=J, shaft__omega_start=OMEGA), np.random.default_rng(1)
    for _ in range(100):
        for name, most in {
            "drive.omega": 3000.0,
            "gear.M": 300.0,
            "bearing.F_y": 2000.0,
            "bearing.F_z": 2000.0,
            "bearing.M_x": 5.0,
        }.items():
            slave.set(name, most * random.uniform())
        slave.step(5e-4)
    works = slave.get("work.drive", "work.gear", "work.bearing", "work.support")
    gained = 0.5 * J * (slave.get("shaft.omega")[0] ** 2 - OMEGA**2)
    assert np.all(works > 1.0) and abs(gained) > 1e3
    # of the integrator, in steps of 0.1 ms; observed 2e-9
    assert works[0] - works[1:].sum() == pytest.approx(gained, rel=1e-7)


INPUTS = {"drive.omega": 1600.0, "gear.M": 150.0, "bearing.F_y": 500.0, "bearing.F_z": 900.0, "bearing.M_x": 0.3}


def outputs_at(shaft, changes):
    values = {name.replace(".", "__"): value for name, value in (INPUTS | changes).items()}
    slave = Slave(shaft).initialize(**values)
    return slave.outputs()


@pytest.mark.parametrize("name", [*INPUTS, "shaft.omega"])
def test_directional_derivatives_are_those_of_differences(shaft, name):
    # slow: friction of B still depends on speed
    key, value = ("shaft.omega_start", 20.0) if name == "shaft.omega" else (name, INPUTS[name])
    h = 1e-4 * value
    slave = Slave(shaft).initialize(**{n.replace(".", "__"): v for n, v in (INPUTS | {key: value}).items()})
    unknown = [v.valueReference for v in slave.description.modelVariables if v.causality == "output"]
    out = slave.ffi.new("double[]", len(unknown))
    slave.check("GetDirectionalDerivative", unknown, len(unknown), [slave.vr[name]], 1, [1.0], out)
    difference = (outputs_at(shaft, {key: value + h}) - outputs_at(shaft, {key: value - h})) / (2 * h)
    assert np.count_nonzero(difference) >= 1
    # central differences; observed 3e-8
    np.testing.assert_allclose(list(out), difference, rtol=1e-6, atol=1e-9 * np.abs(difference).max())


def test_saved_state_continues_bit_for_bit(shaft):
    slave = Slave(shaft).initialize().step(STEP, 3)
    state = slave.save()
    after = slave.step(STEP, 5).outputs()
    data = slave.bytes(state)
    other = Slave(shaft)
    status, loaded = other.try_load(data)
    assert status == OK
    assert np.array_equal(other.restore(loaded, 3 * STEP).step(STEP, 5).outputs(), after)


# --------------------------------------------------------------------------------------------------------------- system

NAMES = (
    "shaft.shaft.omega",
    "shaft.support.M",
    "bearing.housing.F_y",
    "bearing.housing.F_z",
    "bearing.bearing.friction_torque",
    "bearing.rivet.sigma_head_max",
)


@pytest.fixture(scope="module")
def result():
    """50 ms of the system as it is shipped."""
    return transmission.simulate(SYSTEM, 0.05, STEP)


def packed(path, values, units=""):
    """The system with other parameters of the bearing: entries of its parameter set and of the set's units."""
    with zipfile.ZipFile(SYSTEM) as old, zipfile.ZipFile(path, "w") as new:
        for name in old.namelist():
            data = old.read(name)
            if name == "resources/bearing.ssv":
                entries = "".join(
                    f'<ssv:Parameter name="{n}"><ssv:Real {v}/></ssv:Parameter>' for n, v in values.items()
                )
                data = data.decode()
                inside = data.split("<ssv:Parameters>")[1].split("</ssv:Parameters>")[0]
                data = data.replace(inside, entries)
                data = data.replace("</ssv:Units>", f"{units}</ssv:Units>")
            new.writestr(name, data)
    return path


def test_the_system_for_ssp_2_is_the_same_but_for_its_version():
    """Every unit that a file names has its definition there, as SSP asks for."""
    with zipfile.ZipFile(SYSTEM) as one, zipfile.ZipFile(SYSTEM.with_name("Transmission-2.0.ssp")) as two:
        assert one.namelist() == two.namelist()
        for name in one.namelist():
            if not name.endswith((".ssd", ".ssv")):
                assert one.read(name) == two.read(name)
                continue
            root, new = etree.fromstring(one.read(name)), etree.fromstring(two.read(name))
            assert (root.get("version"), new.get("version")) == ("1.0", "2.0")
            new.set("version", "1.0")
            assert etree.tostring(root) == etree.tostring(new)
            named = {each.get("unit") for each in root.iter("{*}Real")}
            assert named == {each.get("name") for each in root.iter("{*}Unit")}


def test_units_of_parameter_sets_are_converted_by_their_definitions(tmp_path):
    """Offset and factor are those of the definition; a unit that the set does not define is one of the FMU's; a unit of
    another quantity and one without a definition are refused.
    """
    units = "".join(
        f'<ssc:Unit xmlns:ssc="{COMMON}" name="{name}"><ssc:BaseUnit {base}/></ssc:Unit>'
        for name, base in (
            ("u1", 'rad="1" s="-1" factor="0.10471975511965977"'),
            ("u2", 'kg="1" m="1" s="-2" factor="1000"'),
            ("u3", 'K="1" factor="0.5555555555555556" offset="255.3722222222222"'),
        )
    )
    values = {
        "shaft.omega": 'value="3000" unit="u1"',
        "joint.preload": 'value="0.03" unit="u2"',
        "oil.T": 'value="212" unit="u3"',
        "joint.fit": 'value="-1e-5"',
        "bearing.P_d": 'value="1.5e-5" unit="m"',
    }
    _, parts, start = transmission.load(packed(tmp_path / "a.ssp", values, units), tmp_path / "a")
    found = {name: float(start[f"bearing.{name}"]) for name in values}
    assert found == pytest.approx(
        {"shaft.omega": 100 * np.pi, "joint.preload": 30.0, "oil.T": 373.15, "joint.fit": -1e-5, "bearing.P_d": 1.5e-5}
    )
    for part in parts.values():
        part.fmu.freeInstance()
    for unit, said in (("u2", "is not one of shaft.omega"), ("u9", "has no definition")):
        with pytest.raises(ValueError, match=said):
            transmission.load(
                packed(tmp_path / "b.ssp", {"shaft.omega": f'value="1" unit="{unit}"'}, units), tmp_path / unit
            )


def test_integers_and_enumerations_of_parameter_sets(tmp_path):
    """Items by their numbers or names; fractions and other names are refused, not cut."""
    part = transmission.Component(
        "bearing", Path(shutil.copy(ROOT / "fmus" / "RivetedBearing.fmu", tmp_path / "b.fmu"))
    )
    names = {item.name: int(item.value) for item in part.variables["scene.cage"].declaredType.items}
    for name, number in names.items():
        assert part.whole("scene.cage", name) == part.whole("scene.cage", str(number)) == number
    assert part.whole("start.seed", "7") == part.whole("start.seed", 7.0) == 7
    for name, value in (("start.seed", "3.7"), ("scene.cage", "elastc"), ("scene.cage", 1.5), ("start.seed", "nan")):
        with pytest.raises(ValueError, match=f"{name} = {value}: whole numbers"):
            part.set(name, value)
    part.fmu.freeInstance()


def test_connections_convert_units(tmp_path):
    """An output in kN feeds an input in N with 1,000 times its number; another quantity and a transformation are refused."""
    _, parts, _ = transmission.load(SYSTEM, tmp_path / "a")
    wire = ("shaft", "shaft.F_y", "bearing", "shaft.F_y")
    assert transmission.conversion(parts, wire) == (1.0, 0.0)
    exponents, factor, offset = parts["shaft"].units["N"]
    parts["shaft"].units["kN"] = exponents, 1e3 * factor, offset
    parts["shaft"].variables["shaft.F_y"].unit = "kN"
    assert transmission.conversion(parts, wire) == (1e3, 0.0)
    with pytest.raises(ValueError, match=r"shaft.F_y \[kN\] is connected with bearing.shaft.omega \[rad/s\]"):
        transmission.conversion(parts, (*wire[:3], "shaft.omega"))
    for part in parts.values():
        part.fmu.freeInstance()
    changed = tmp_path / "b.ssp"
    with zipfile.ZipFile(SYSTEM) as old, zipfile.ZipFile(changed, "w") as new:
        for name in old.namelist():
            data = old.read(name)
            if name.endswith(".ssd"):
                head, *rest = data.decode().split("<ssd:Connection ", 1)
                tail = rest[0].split("/>", 1)
                linear = f'<ssc:LinearTransformation xmlns:ssc="{COMMON}" factor="2"/>'
                data = f"{head}<ssd:Connection {tail[0]}>{linear}</ssd:Connection>{tail[1]}"
            new.writestr(name, data)
    with pytest.raises(ValueError, match="LinearTransformation"):
        transmission.load(changed, tmp_path / "b")


def test_reaction_carries_the_load(result):
    """After 10 ms: mean force on the housing = load, but for the momentum of ring, balls and cage, below 0.5 kg x 0.1
    m/s / 40 ms = 1 N.
    """
    late = result["time"] > 0.01
    for axis in "yz":
        mean, load = result[f"bearing.housing.F_{axis}"][late].mean(), result[f"shaft.shaft.F_{axis}"][-1]
        # sampled each 0.1 ms, scatter 20 N / sqrt(400) = 1 N; observed 0.1 to 0.3 N
        assert mean == pytest.approx(load, abs=10.0)


def test_speed_answers_to_the_friction_of_the_bearing(result):
    """J omega_dot = k (omega_d - omega) - M - M_A - M_B with the torques of each step: a chain of exponentials."""
    J, k, omega_d, M = 0.02, 5.0, 1955.8, 229.6  # shaft.ssv
    omega, decay = [result["shaft.shaft.omega"][0]], np.exp(-k * STEP / J)
    # B's answers to the reaction that the step has seen
    friction = result["bearing.bearing.friction_torque"][:-1] + result["shaft.support.M"][1:]
    for M_f in friction:
        end = omega_d - (M + M_f) / k
        omega.append(end + (omega[-1] - end) * decay)
    change = np.ptp(result["shaft.shaft.omega"])
    # rounding of 1910 in 0.05 rad/s, friction of B within a step; observed 6e-10
    assert np.abs(result["shaft.shaft.omega"] - omega).max() < 1e-6 * change
    deaf = transmission.simulate(SYSTEM, 0.05, STEP, without=("shaft.bearing.M_x",))
    late = result["time"] > 0.03
    drop = (deaf["shaft.shaft.omega"] - result["shaft.shaft.omega"])[late].mean()
    assert drop == pytest.approx(
        result["bearing.bearing.friction_torque"][late].mean() / k, rel=0.1
    )  # seven time constants J / k before; another course of chaos; observed 0.8 %


def test_bearing_answers_to_load_and_speed(result):
    half = transmission.simulate(
        SYSTEM, 0.02, STEP, {"shaft.gear.M": 114.8, "shaft.shaft.omega_start": 955.0, "shaft.drive.omega": 977.9}
    )
    late = half["time"] > 0.01
    # observed 0.004 %
    assert half["bearing.housing.F_z"][late].mean() == pytest.approx(0.5 * result["shaft.shaft.F_z"][0], rel=0.01)
    assert half["shaft.shaft.omega"][-1] == pytest.approx(955.0, rel=1e-3)


def test_coupling_error_falls_with_the_communication_step():
    """Values are held over a step: first order.  Speed after 1 ms against steps of 1 us."""
    reference = transmission.simulate(SYSTEM, 1e-3, 1e-6)["shaft.shaft.omega"]
    steps = np.array([1e-4, 5e-5, 2.5e-5, 1.25e-5])
    error = [abs(transmission.simulate(SYSTEM, 1e-3, h)["shaft.shaft.omega"][-1] - reference[-1]) for h in steps]
    order = np.log(error[0] / error[-1]) / np.log(steps[0] / steps[-1])
    assert order > 0.9, error  # observed 1.03
    # observed 6.4 %: the torque of the start, which falls from 1.2 to 0.3 N.m in 20 us, is held for a step too long
    assert error[-1] < 0.1 * abs(reference[-1] - reference[0])


@pytest.fixture(scope="module")
def short():
    """2 ms of it, without the start: what other masters are compared with."""
    result = transmission.simulate(SYSTEM, 20 * STEP, STEP)
    return np.array([result[name] for name in NAMES]).T[1:]


def difference(rows, expected):
    return np.max(np.abs(rows - expected) / np.abs(expected).max(axis=0))


def test_libcosim_runs_the_system(short):
    """Parameter sets, values exchanged in initialization, fixed steps in nanoseconds.  Observed: 6e-12."""
    pytest.importorskip("libcosimpy", reason="libcosimpy is not installed: pip install libcosimpy")
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimObserver import CosimObserver

    execution = CosimExecution.from_ssp_file(str(SYSTEM), round(STEP * 1e9))
    observer = CosimObserver.create_last_value()
    execution.add_observer(observer)
    files = {"shaft": FMU, "bearing": ROOT / "fmus" / "RivetedBearing.fmu"}
    vr = {
        f"{part}.{v.name}": v.valueReference
        for part, path in files.items()
        for v in fmpy.read_model_description(str(path)).modelVariables
    }
    slaves = {part: execution.slave_index_from_instance_name(part) for part in files}
    rows = []
    for _ in range(len(short)):
        assert execution.step()
        rows.append([observer.last_real_values(slaves[name.split(".")[0]], [vr[name]])[0] for name in NAMES])
    assert difference(rows, short) < 1e-9


def test_ecos_runs_the_system(ecospy, short):
    """Observed: 3e-12."""
    rows = []
    with ecospy.EcosSimulation(ssp_path=str(SYSTEM), step_size=STEP) as simulation:
        simulation.init(parameter_set="transmission")
        for _ in range(len(short)):
            simulation.step()
            rows.append([simulation.get_real(name.replace(".", "::", 1)) for name in NAMES])
    assert difference(rows, short) < 1e-9


def test_container_of_fmu_manipulation_toolbox_runs_the_system(tmp_path, short):
    """Both FMUs inside a third.  It breaks the loop at the shaft, whose inputs therefore start from given values.
    Observed: 0.
    """
    assembly = pytest.importorskip("fmu_manipulation_toolbox.assembly", reason="pip install fmu-manipulation-toolbox")
    files = {"shaft": FMU, "bearing": ROOT / "fmus" / "RivetedBearing.fmu"}
    for path in files.values():
        (tmp_path / path.name).symlink_to(path)
    first = transmission.simulate(SYSTEM, STEP, STEP)
    wires = get_connections(read_ssd(str(SYSTEM)).system)
    values = [
        (part, p.name, p.value)
        for part in files
        for p in read_ssv(str(ROOT / "examples" / "transmission" / f"{part}.ssv")).parameters
    ]
    values += [("shaft", b.name, str(first[f"bearing.{a.name}"][0])) for a, b in wires if b.parent.name == "shaft"]
    outputs = {name: name.replace(".", "_") for name in NAMES}
    description = {
        "name": "container.fmu", "step_size": STEP, "fmu": [path.name for path in files.values()], "auto_input": False, "auto_output": False,
        "link": [[files[a.parent.name].name, a.name, files[b.parent.name].name, b.name] for a, b in wires],
        "start": [[files[part].name, name, value] for part, name, value in values],
        "output": [[files[name.split(".")[0]].name, name.split(".", 1)[1], shown] for name, shown in outputs.items()],
    }  # fmt: skip
    (tmp_path / "container.json").write_text(json.dumps(description))
    assembly.Assembly("container.json", fmu_directory=tmp_path).make_fmu()
    times = {"stop_time": len(short) * STEP, "step_size": STEP, "output_interval": STEP}
    result = fmpy.simulate_fmu(str(tmp_path / "container.fmu"), **times, output=list(outputs.values()))
    assert difference(np.array([result[shown] for shown in outputs.values()]).T[1:], short) < 1e-9
