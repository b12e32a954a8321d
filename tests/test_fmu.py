"""The FMU as its users meet it: description, life cycle, refusals, host habits, failures, memory, binary."""

import math
import os
import re
import subprocess
import sys
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.validation import validate_fmu
from mechanics import Instance
from slave import (
    DISCARD,
    DO_STEP_STATUS,
    ERROR,
    LAST_SUCCESSFUL_TIME,
    OK,
    PENDING_STATUS,
    TERMINATED,
    WARNING,
    Slave,
    describe,
    fmi,
)

from bearing_model.generated.variables import PARAMETERS, RING_V_Y

H = 1e-4  # communication step [s]
LINUX = sys.platform.startswith("linux")
SANITIZED = "asan" in os.environ.get("LD_PRELOAD", "")  # make sanitize


def binary_of(folder):
    (path,) = (folder / "binaries" / fmpy.platform).iterdir()
    return path


# --------------------------------------------------------------------------------------------------- archive and binary


def test_validation_reports_nothing(fmu):
    assert validate_fmu(str(fmu)) == []


def test_archive_is_complete(folder):
    page = (folder / "documentation" / "index.html").read_text()
    assert "joint.preload" in page
    assert "BSD" in (folder / "documentation" / "licenses" / "LICENSE").read_text()
    assert "SUNDIALS" in (folder / "documentation" / "licenses" / "THIRD_PARTY_NOTICES.md").read_text()


@pytest.mark.skipif(not LINUX or SANITIZED, reason="reads an ELF file, without sanitizers")
def test_binary_exports_fmi_only_and_needs_libc_and_libm_only(folder):
    symbols = subprocess.run(
        ["nm", "-D", "--defined-only", str(binary_of(folder))], capture_output=True, text=True, check=True
    ).stdout
    exported = {line.split()[-1] for line in symbols.splitlines()}
    assert all(name.startswith("fmi2") for name in exported)
    assert len(exported) == 44  # all functions of FMI 2.0, for model exchange and co-simulation
    dynamic = subprocess.run(
        ["readelf", "-d", str(binary_of(folder))], capture_output=True, text=True, check=True
    ).stdout
    needed = {line.split("[")[1].rstrip("]") for line in dynamic.splitlines() if "(NEEDED)" in line}
    assert needed <= {"libc.so.6", "libm.so.6", "ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1"}


def test_runs_through_fmpy(fmu):
    """The whole way of an importer; the sum of forces stays of the order of the loads."""
    result = fmpy.simulate_fmu(str(fmu), stop_time=2e-3, step_size=H, output=["housing.F_y", "ring.y", "bearing.Z"])
    assert len(result) == 21
    assert all(np.isfinite(result[name]).all() for name in result.dtype.names)
    assert result["bearing.Z"][-1] == 9
    assert 1e-6 < result["ring.y"][-1] < 1e-4


# ----------------------------------------------------------------------------------------------------------- life cycle


@pytest.mark.parametrize(
    ("changes", "reason"),
    [({"guid": b"{wrong}"}, "GUID"), ({"type": 0}, "co-simulation"), ({"name": b""}, "name is empty")],
)
def test_instantiation_refused(folder, changes, reason):
    slave = Slave(folder, **changes)
    assert slave.component == slave.ffi.NULL
    ((status, category, message),) = slave.messages
    assert (status, category) == (ERROR, "logStatusError")
    assert reason in message


def test_runs_without_callbacks(folder):
    """Neither logger nor memory functions; refusals then are silent."""
    slave = Slave(folder, functions={"logger": fmi().NULL}).initialize().step(H)
    assert slave.try_set("shaft.F_x", math.nan) == ERROR


def instantiated(slave):
    return slave


def initializing(slave):
    slave.check("EnterInitializationMode")
    return slave


def stepping(slave):
    slave.initialize()
    return slave


def terminated(slave):
    slave.initialize()
    slave.check("Terminate")
    return slave


def erroneous(slave):
    slave.initialize()
    assert slave.try_set("shaft.F_x", math.nan) == ERROR
    return slave


CALLS = {
    "SetupExperiment": (0, 0.0, 0.0, 0, 0.0),
    "EnterInitializationMode": (),
    "ExitInitializationMode": (),
    "Terminate": (),
    "DoStep": (0.0, H, 1),
    "GetReal": ([1], 1, [0.0]),
    "SetReal": ([1], 1, [0.0]),
    "SetInteger": ([1405], 1, [1]),
    "CancelStep": (),
    "EnterEventMode": (),
    "SetRealInputDerivatives": ([1], 1, [1], [0.0]),
    "GetRealOutputDerivatives": ([2101], 1, [1], [0.0]),
    "GetDirectionalDerivative": ([2101], 1, [1], 1, [1.0], [0.0]),
}
DERIVATIVES = {"GetRealOutputDerivatives", "GetDirectionalDerivative"}
ALLOWED = {  # FMI 2.0.4, section 4.2.4
    instantiated: {"SetupExperiment", "EnterInitializationMode", "SetReal", "SetInteger", "SetRealInputDerivatives"},
    initializing: {"ExitInitializationMode", "GetReal", "SetReal", "SetInteger", "SetRealInputDerivatives"},
    stepping: {"Terminate", "DoStep", "GetReal", "SetReal", "SetRealInputDerivatives"} | DERIVATIVES,
    terminated: {"GetReal"} | DERIVATIVES,
    erroneous: {"GetReal"} | DERIVATIVES,
}


@pytest.mark.parametrize("function", CALLS)
@pytest.mark.parametrize("state", ALLOWED, ids=lambda state: state.__name__)
def test_call_order(slave, state, function):
    state(slave)
    slave.messages.clear()
    status = slave.call(function, *CALLS[function])
    if function in ALLOWED[state]:
        assert status == OK, slave.messages
        assert slave.messages == []
    else:
        assert status == ERROR
        ((status, category, message),) = slave.messages
        assert (status, category) == (ERROR, "logStatusError")
        assert f"fmi2{function}" in message
        assert slave.call("Reset") == OK
        slave.initialize().step(H)  # usable again


def test_null_component(slave):
    null = slave.ffi.NULL
    assert slave.lib.fmi2DoStep(null, 0.0, H, 1) == ERROR
    assert slave.lib.fmi2Reset(null) == ERROR
    slave.lib.fmi2FreeInstance(null)


def test_versions(slave):
    assert slave.ffi.string(slave.lib.fmi2GetVersion()) == b"2.0"
    assert slave.ffi.string(slave.lib.fmi2GetTypesPlatform()) == b"default"


# ------------------------------------------------------------------------------------------------------------ variables


@pytest.mark.parametrize(
    ("name", "value", "allowed"),
    [
        ("shaft.F_x", math.nan, "[-100000, 100000]"),
        ("shaft.omega", math.inf, "[-15000, 15000]"),
        ("shaft.tilt_z", 0.1, "[-0.035, 0.035]"),
        ("bearing.D", 0.0, "[0.001, 0.1]"),
        ("ball[3].dD", 1.0, "[-0.001, 5e-05]"),
        ("ring.tilt_mode", 4, "[1, 3]"),
        ("pulse.count", -1, "[0, 1000000]"),
    ],
)
def test_value_out_of_range_is_refused_by_name(slave, name, value, allowed):
    """One message with name, value and range; nothing changed."""
    kind = "Integer" if isinstance(value, int) else "Real"
    initializing(slave)
    before = [slave.ffi.new("int[1]" if kind == "Integer" else "double[1]") for _ in range(2)]
    slave.check(f"Get{kind}", [slave.vr[name]], 1, before[0])
    assert slave.try_set(name, value) == ERROR
    ((_, _, message),) = slave.messages
    assert f"{name} = {value:.10g} " in message
    assert allowed in message
    slave.check(f"Get{kind}", [slave.vr[name]], 1, before[1])
    assert before[0][0] == before[1][0]


def test_nothing_is_set_if_one_value_is_wrong(slave):
    assert slave.call("SetReal", [1, 2], 2, [7.0, math.nan]) == ERROR
    slave.check("Reset")
    slave.check("SetReal", [1, 2], 2, [7.0, 8.0])
    initializing(slave)
    assert list(slave.get("shaft.F_x", "shaft.F_y")) == [7.0, 8.0]
    assert slave.call("SetReal", [1, 2], 2, [9.0, math.inf]) == ERROR
    assert slave.get("shaft.F_x")[0] == 7.0


@pytest.mark.parametrize(
    ("function", "reference", "reason"),
    [
        ("SetReal", 999, "999 belongs to no Real"),
        ("SetReal", 1405, "1405 belongs to no Real"),
        ("SetInteger", 1, "1 belongs to no Integer"),
        ("SetReal", 2101, "ring.x = 1 is not allowed: only inputs and parameters"),
        ("SetReal", 0, "time = 1 is not allowed"),
        ("SetReal", 1001, "fixed after initialization, for it is part of the geometry"),
        ("SetBoolean", 1, "no Boolean"),
    ],
)
def test_wrong_reference_is_refused(running, function, reference, reason):
    value = [1] if function != "SetReal" else [1.0]
    if function == "SetInteger":
        running.check("Reset")
    assert running.call(function, [reference], 1, value) == ERROR
    assert reason in running.messages[-1][2]


def test_null_pointers_are_refused(slave):
    null = slave.ffi.NULL
    for function, arguments in (
        ("SetReal", ([1], 1, null)),
        ("SetReal", (null, 1, [1.0])),
        ("GetFMUstate", (null,)),
        ("SetFMUstate", (null,)),
    ):
        assert slave.call(function, *arguments) == ERROR
        slave.check("Reset")
    slave.check("SetReal", null, 0, null)


def test_outputs_after_an_error_do_not_look_plausible(running):
    running.step(H)
    assert running.try_set("shaft.F_x", math.nan) == ERROR
    assert np.isnan(running.outputs()).all()
    assert running.get("shaft.F_x")[0] == 515.0
    assert running.call("DoStep", running.time, H, 1) == ERROR


def test_start_values_are_the_tables(slave):
    initializing(slave)
    for v in slave.description.modelVariables:
        if v.causality in ("input", "parameter") and v.type == "Real":
            assert slave.get(v.name)[0] == float(v.start), v.name


def test_outputs_in_initialization_mode_follow_the_inputs(slave):
    """The start is found anew whenever a value has changed."""
    initializing(slave)
    y = [slave.get("ring.y")[0]]
    slave.set("shaft.F_y", 1000.0)
    y.append(slave.get("ring.y")[0])
    slave.check("ExitInitializationMode")
    assert y[1] != y[0]
    assert slave.get("ring.y")[0] == y[1]


def test_what_is_read_in_initialization_mode_changes_no_bit(folder):
    curious, silent = Slave(folder), Slave(folder)
    for slave in (curious, silent):
        slave.check("EnterInitializationMode")
    curious.set("shaft.F_y", 1000.0)
    curious.outputs()
    curious.set("shaft.F_y", 2994.0)
    for slave in (curious, silent):
        slave.check("ExitInitializationMode")
        slave.time = 0.0
        slave.step(H, 3)
    assert curious.bytes(curious.save()) == silent.bytes(silent.save())


def test_inconsistent_parameters_are_refused_at_initialization(slave):
    slave.set("cage.D_i", 0.061)  # larger than the outer diameter
    slave.check("EnterInitializationMode")
    assert slave.call("ExitInitializationMode") == ERROR
    assert "cage.D_i" in slave.messages[-1][2]
    slave.check("Reset")
    slave.initialize().step(H)


@pytest.mark.parametrize(
    ("name", "value", "allowed"),
    [
        ("cage.D_i", 0.0502, 0.0501),  # d_m - seat - two walls: 53.5 - 3.0 - 0.4 mm
        ("cage.D_o", 0.0568, 0.0569),
        ("cage.D_o", 0.0645, 0.06442),  # d_m + D + P_d/2 - guide clearance
        ("cage.width", 0.0118, 1.05 * 0.0113125),
        ("cage.pocket_clearance", 0.003, 0.00265112),
        ("cage.x_c", 0.0034, 0.00401163),
    ],
)
def test_cages_that_cannot_be_built_are_refused(slave, name, value, allowed):
    """Name, value and what is allowed (the bridge: 2 r sin(pi/9 - asin(1.7 mm/r)) - D, r = 24.85 mm, by hand)."""
    slave.set(name, value)
    if name == "cage.pocket_clearance":
        slave.set("cage.width", 15e-3)  # webs over wider pockets
    slave.check("EnterInitializationMode")
    assert slave.call("ExitInitializationMode") == ERROR
    message = next(text for _, _, text in slave.messages if f"{name} = " in text)
    numbers = [
        float(number)
        for number in re.findall(r"= (\d[\d.e+-]*) m|(?:most|least|at|is) (\d[\d.e+-]*) m", message)
        for number in number
        if number
    ]
    assert (
        numbers[0] == pytest.approx(value, rel=1e-5)
        and min(abs(number / allowed - 1.0) for number in numbers[1:]) < 1e-3
    ), message


# ----------------------------------------------------------------------------------------------------------------- time


@pytest.mark.parametrize("h", [0.0, -H, math.nan, math.inf, -math.inf])
def test_wrong_step_size_is_refused(running, h):
    """FMI 2.0: the communication step size must be greater than zero."""
    assert running.call("DoStep", 0.0, h, 1) == ERROR
    assert "communicationStepSize" in running.messages[-1][2]


@pytest.mark.parametrize("point", [H, -H, math.nan, math.inf])
def test_wrong_communication_point_is_refused(running, point):
    assert running.call("DoStep", point, H, 1) == ERROR
    assert "currentCommunicationPoint" in running.messages[-1][2]


CLOCKS = {  # the times that hosts call, of the start, the step and its number
    "multiples": lambda start, h, i: start + i * h,
    "nanoseconds": lambda start, h, i: round((start + i * h) * 1e9) / 1e9,
    "single precision": lambda start, h, i: start + float(np.float32(i * h)),
    "ahead": lambda start, h, i: start + i * h + 0.9e-3 * h,
    "behind": lambda start, h, i: start + i * h - 0.9e-3 * h,
}


@pytest.mark.parametrize("start", [0.0, 1.7e9])
@pytest.mark.parametrize("clock", CLOCKS)
def test_clocks_of_hosts_are_followed(folder, clock, start):
    """The step ends where the host means it to, and the log says once that the clocks differ."""
    slave, h = Slave(folder, logging=True).initialize(start=start), 1.0 / 30000.0
    for i in range(6):
        slave.check("DoStep", CLOCKS[clock](start, h, i), h, 1)
    assert slave.get("time")[0] == CLOCKS[clock](start, h, 5) + h
    said = [message for _, _, message in slave.messages if "currentCommunicationPoint" in message]
    assert len(said) == (start == 0.0 and clock != "multiples")  # at 1.7e9 s a double cannot tell them from rounding


@pytest.mark.parametrize("off", [-1.1e-3, 1.1e-3])
def test_clock_beyond_the_slack_is_named_and_can_be_mended(running, off):
    assert running.call("DoStep", off * H, H, 1) == ERROR
    assert "ended at 0 s" in running.messages[-1][2]
    running.check("DoStep", 0.0, H, 1)


def test_stop_time_is_respected(slave):
    slave.initialize(stop=3 * H).step(H, 3)  # 3 H > H + H + H: rounding is allowed
    assert slave.call("DoStep", slave.time, H, 1) == ERROR
    assert "stopTime" in slave.messages[-1][2]


@pytest.mark.parametrize(
    "arguments",
    [(0, 0.0, math.inf, 0, 0.0), (0, 0.0, math.nan, 0, 0.0), (0, 0.0, 1.0, 1, 0.5), (0, 0.0, 0.0, 1, math.nan)],
)
def test_wrong_experiment_is_refused(slave, arguments):
    assert slave.call("SetupExperiment", *arguments) == ERROR
    assert "is not allowed" in slave.messages[-1][2]


def test_tolerance_of_the_host_is_in_force(folder):
    assert Slave(folder).initialize(tolerance=2e-3).get("solver.tolerance")[0] == 2e-3
    assert Slave(folder).initialize().get("solver.tolerance")[0] == PARAMETERS["solver.tol"].start
    assert Slave(folder).initialize(solver__tol=5e-4).get("solver.tolerance")[0] == 5e-4


@pytest.mark.parametrize(
    ("hint", "used"),
    [(1e-12, None), (5e-324, None), (0.5, 0.1), (math.inf, 0.1), (0.0, None), (-1.0, None), (math.nan, None)],
)
def test_tolerance_of_the_host_is_a_hint(folder, hint, used):
    """Some importers stop at anything but fmi2OK: the largest tolerance in the place of a larger one, the FMU's own in the
    place of any other that cannot be used, and one warning.
    """
    slave = Slave(folder, logging=True)
    assert slave.call("SetupExperiment", 1, hint, 0.0, 0, 0.0) == OK
    ((status, category, message),) = slave.messages
    assert (status, category) == (WARNING, "logStatusWarning")
    assert "tolerance" in message and "1e-10" in message
    slave.check("EnterInitializationMode")
    slave.check("ExitInitializationMode")
    assert slave.get("solver.tolerance")[0] == (used or PARAMETERS["solver.tol"].start)
    assert [category for _, category, _ in slave.messages].count("logStatusWarning") == 1


def test_nothing_can_be_set_in_any_phase_that_allows_setting(folder):
    """FMI 2.0.4, section 4.2.4: fmi2SetXXX is allowed in step complete; with no values it is no error for any type."""
    for kind in ("Real", "Integer", "Boolean", "String"):
        slave = Slave(folder)
        null = slave.ffi.NULL
        assert slave.call(f"Set{kind}", null, 0, null) == OK
        slave.check("EnterInitializationMode")
        assert slave.call(f"Set{kind}", null, 0, null) == OK
        slave.check("ExitInitializationMode")
        slave.time = 0.0
        assert slave.step(H).call(f"Set{kind}", null, 0, null) == OK
        assert slave.step(H).messages == []


def test_processor_time_is_local_and_never_zeroed(folder):
    """Readable, but no output: nothing that differs from run to run is among the results.  Measured when asked for."""
    slave = Slave(folder)
    (variable,) = [v for v in slave.description.modelVariables if v.name == "solver.cpu_time"]
    assert variable.causality == "local" and variable.initial == "calculated"
    assert variable not in [
        unknown.variable for unknown in slave.description.outputs + slave.description.initialUnknowns
    ]
    assert Slave(folder).initialize().step(1e-3).get("solver.cpu_time")[0] == 0.0
    used = [slave.initialize(solver__clock=2).step(1e-3, 3).get("solver.cpu_time")[0]]
    state = slave.save()
    used.append(slave.step(1e-3).get("solver.cpu_time")[0])
    used.append(slave.restore(state, 3e-3).get("solver.cpu_time")[0])
    slave.check("Reset")
    used.append(slave.initialize(solver__clock=2).get("solver.cpu_time")[0])
    assert 0.0 < used[0] < used[1] == used[2] == used[3]


def test_start_time(slave):
    slave.initialize(start=12.5).step(H, 3)
    assert slave.get("time")[0] == slave.time == 12.5 + H + H + H


def test_hosts_clocks(folder):
    """t += h, k h, and whole nanoseconds in seconds are all accepted, also where they differ in the last bits."""
    h = 1e-6 / 3
    added, multiplied = Slave(folder).initialize(), Slave(folder).initialize()
    added.step(h, 1000)
    for k in range(1000):
        multiplied.check("DoStep", k * h, h, 1)
    nanoseconds = Slave(folder).initialize()
    for k in range(1000):
        nanoseconds.check("DoStep", (k * 333) / 1e9, 333 / 1e9, 1)
    assert added.get("time")[0] == added.time
    assert multiplied.get("time")[0] == 999 * h + h


@pytest.mark.parametrize("start", [0.0, -1e-4, -1.0, 1.0, 1e3, 1.7e9])
def test_hosts_clocks_from_any_start(folder, start):
    """start + k h and t += h, also through 0, where times are small and their rounding is not, and in seconds since
    1970.
    """
    h = 1e-5 if start < 1e6 else 1e-4
    multiplied, added = Slave(folder).initialize(start=start), Slave(folder).initialize(start=start)
    for k in range(40):
        multiplied.check("DoStep", start + k * h, h, 1)
    added.step(h, 40)
    assert abs(multiplied.get("time")[0] - added.get("time")[0]) <= 40 * math.ulp(abs(start) + 1e-3)


@pytest.mark.parametrize("start", [0.0, 1e3, 1.7e9])
@pytest.mark.parametrize("by", [-1.0, -0.51, 0.51, 1.0])
def test_another_point_than_the_last_one_reached_is_refused(folder, start, by):
    """By more than half a step, earlier or later, however wide single precision is there."""
    h = 1e-4
    slave = Slave(folder).initialize(start=start).step(h, 2)
    assert slave.call("DoStep", slave.time + by * h, h, 1) == ERROR
    assert "the last step ended at" in slave.messages[-1][2]


def test_a_step_that_is_lost_in_the_rounding_of_time_is_refused(folder):
    slave = Slave(folder).initialize(start=1.7e9)
    assert slave.call("DoStep", 1.7e9, 1e-8, 1) == ERROR
    assert "communicationStepSize = 1e-08 s is not allowed" in slave.messages[-1][2]


# ---------------------------------------------------------------------------------------------- failures, statuses, log


def failed(slave):
    """An instance whose work limit ends a step before its end."""
    slave.initialize(solver__max_steps=20)
    slave.step(1e-5)
    assert slave.call("DoStep", slave.time, 0.01, 1) == DISCARD
    return slave


def real_status(slave):
    value = slave.ffi.new("double *")
    assert slave.call("GetRealStatus", LAST_SUCCESSFUL_TIME, value) == OK
    return value[0]


def terminated_status(slave):
    value = slave.ffi.new("int *")
    assert slave.call("GetBooleanStatus", TERMINATED, value) == OK
    return bool(value[0])


def test_discard_comes_with_terminated_and_the_time_reached(slave):
    failed(slave)
    assert terminated_status(slave)
    reached = real_status(slave)
    assert 1e-5 < reached < 0.01
    assert slave.get("time")[0] == reached
    assert np.isfinite(slave.outputs()).all()
    (status, category, reason) = slave.messages[-1]
    assert (status, category) == (ERROR, "logStatusError")
    text = slave.ffi.new("fmi2String *")
    assert slave.call("GetStringStatus", PENDING_STATUS, text) == OK
    assert slave.ffi.string(text[0]).decode() == reason.replace("%%", "%").replace("##", "#")


def test_no_step_after_a_discard(slave):
    failed(slave)
    assert slave.call("DoStep", real_status(slave), H, 1) == ERROR
    assert np.isnan(slave.outputs()).all()


def test_terminate_after_a_discard(slave):
    failed(slave)
    slave.check("Terminate")
    assert np.isfinite(slave.outputs()).all()


def test_rollback_after_a_discard(slave):
    slave.initialize(solver__max_steps=20)
    state = slave.save()
    assert slave.call("DoStep", 0.0, 0.01, 1) == DISCARD
    slave.restore(state, 0.0).step(1e-6)
    assert not terminated_status(slave)


def test_statuses(running):
    status = running.ffi.new("fmi2Status *")
    running.step(H)
    assert running.call("GetStatus", DO_STEP_STATUS, status) == OK
    assert status[0] == OK
    assert not terminated_status(running)
    assert real_status(running) == running.time
    integer = running.ffi.new("int *")
    assert running.call("GetIntegerStatus", DO_STEP_STATUS, integer) == DISCARD
    assert running.call("GetRealStatus", PENDING_STATUS, running.ffi.new("double *")) == DISCARD


def test_logger_categories(folder):
    slave = Slave(folder, logging=True)
    one = [slave.ffi.new("char[]", b"logSolver")]
    assert slave.call("SetDebugLogging", 1, 1, one) == OK
    assert slave.call("SetDebugLogging", 1, 0, slave.ffi.NULL) == OK
    assert slave.call("SetDebugLogging", 0, 0, slave.ffi.NULL) == OK
    assert slave.messages == []
    unknown = [slave.ffi.new("char[]", b"logEverything")]
    assert slave.call("SetDebugLogging", 1, 1, unknown) == WARNING
    ((status, category, message),) = slave.messages
    assert (status, category) == (WARNING, "logStatusWarning")
    assert "logEverything" in message
    declared = (
        {c.name for c in slave.description.logCategories} if hasattr(slave.description, "logCategories") else {category}
    )
    assert category in declared


@pytest.mark.parametrize(
    ("author", "start", "step", "options"),
    [
        ("Verlet", 9e9, 1e-3, {"tolerance": 1e-10, "solver__method": 1}),
        ("Runge-Kutta", 9e9, 1e-3, {"tolerance": 1e-10, "solver__method": 2}),
    ],
)
def test_the_integrators_own_messages_reach_the_log(folder, author, start, step, options):
    """Doubles at 9e9 s are 2 us apart, and the tolerance asks for shorter steps: the integrator's words under
    logSolver, then the reason and a Discard.
    """
    for logging in (True, False):
        slave = Slave(folder, logging=logging).initialize(start=start, **options)
        slave.messages.clear()
        assert slave.call("DoStep", slave.time, step, 1) == DISCARD
        assert terminated_status(slave) and start <= real_status(slave) < start + step
        assert np.isfinite(slave.outputs()).all()
        own = [text for status, category, text in slave.messages if category == "logSolver"]
        assert any(author in text for text in own) == logging
        assert slave.messages[-1][:2] == (ERROR, "logStatusError")
        assert "the solver cannot go on" in slave.messages[-1][2]


def test_messages_of_sundials_reach_the_log(core):
    """A state without a future, which the FMU would not take: the ring at 1e160 m/s."""
    bearing = Instance(core, {"solver.method": 2})
    core.lib.part_state(bearing.bearing)[RING_V_Y.start] = 1e160
    with pytest.raises(ArithmeticError):
        bearing.step(H)
    assert any("SUNDIALS" in message for message in bearing.messages)
    assert "the solver cannot go on" in bearing.messages[-1]


# ----------------------------------------------------------------------------------------------------- memory, run time


@pytest.fixture(scope="session")
def allocations(tmp_path_factory):
    """The program that counts allocations (see allocations.c)."""
    program = tmp_path_factory.mktemp("allocations") / "allocations"
    headers = Path(fmpy.__file__).parent / "c-code"
    source = Path(__file__).with_name("allocations.c")
    subprocess.run(
        ["cc", "-O1", "-fno-builtin", f"-I{headers}", str(source), "-o", str(program), "-rdynamic", "-ldl"], check=True
    )
    return program


def count_allocations(program, folder, steps, h):
    references = [v.valueReference for v in describe(folder).modelVariables if v.causality == "output"]
    guid = describe(folder).guid
    command = [str(program), str(binary_of(folder)), guid, str(steps), repr(h), *map(str, references)]
    result = subprocess.run(command, capture_output=True, text=True, check=True)
    return map(int, result.stdout.split())


@pytest.mark.skipif(not LINUX or SANITIZED, reason="replaces glibc's malloc")
@pytest.mark.parametrize(
    ("steps", "h"), [(200, H), *(pytest.param(steps, 1e-8, marks=pytest.mark.slow) for steps in (20_000, 1_000_000))]
)
def test_memory(allocations, folder, steps, h):
    """No allocation in a step, in reading outputs and derivatives, from the first step on; no page more after many
    steps or 500 lives of instances.
    """
    allocated, grown, left, pages = count_allocations(allocations, folder, steps, h)
    assert allocated == 0
    assert grown == 0
    assert left == 0
    assert pages == 0
