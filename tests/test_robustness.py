"""Properties of any run: finite values, closed energy balance, refusals by name, recovery and the same bits whatever
the host does.
"""

import ctypes
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from slave import DISCARD, ERROR, OK, WARNING, Slave

from bearing_model.generated import variables
from bearing_model.physics import parameters

H = 1e-4  # communication step [s]
TYPES = parameters.TYPES
QUICK = settings(
    deadline=None,
    max_examples=60,
    derandomize=True,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)


@pytest.fixture(scope="module")
def slave(folder):
    """One instance for all examples, reset between them: whatever an example leaves behind would spoil the next one."""
    return Slave(folder)


# ----------------------------------------------------------------------------------------------------------- any values

# work, table, time: set by the test or without effect
FIXED = {"solver.max_steps", "solver.tol", "bearing.d_m", "pulse.t_start", "start.settle"}


def value_of(variable):
    """Any allowed value of a variable, small ones as likely as large ones."""
    if variable.type in TYPES:
        return st.sampled_from([int(member) for member in TYPES[variable.type]])
    if variable.type == "Integer":
        return st.integers(variable.min, min(variable.max, 1000))
    near = st.floats(0.5, 2.0).map(
        lambda factor: min(max(factor * (variable.start or 0.1 * variable.max), variable.min), variable.max)
    )
    return st.one_of(near, near, st.floats(variable.min, variable.max))


def element_name(name):
    return re.sub(r"\[\w\]", "[1]", name)


def some_values(table, most):
    """A dict of up to `most` variables with allowed values."""
    names = sorted(set(table) - FIXED)
    return st.lists(st.sampled_from(names), max_size=most, unique=True).flatmap(
        lambda chosen: st.fixed_dictionaries({element_name(name): value_of(table[name]) for name in chosen})
    )


def try_initialize(slave, values):
    """Status of initialization with values by name."""
    slave.check("Reset")
    slave.messages.clear()
    slave.set("solver.max_steps", 300)
    for name, value in values.items():
        slave.set(name, value)
    slave.check("EnterInitializationMode")
    slave.time = 0.0
    return slave.call("ExitInitializationMode")


def names_value_and_limit(message):
    """Whether a refusal says which variable, what it is and what is allowed."""
    name = r"[a-z]+(\[\d+\])?\.\w+"
    return (
        re.search(rf"{name} = -?[\d.]", message)
        and re.search(r"allowed|must lie", message)
        and len(re.findall(r"\d", message)) > 1
    )


@QUICK
@given(parameters=some_values(variables.PARAMETERS, 6), inputs=some_values(variables.INPUTS, 3))
def test_any_allowed_values_run_or_are_refused_by_name(slave, parameters, inputs):
    """A bearing starts, or the message names a variable, its value and what is allowed; then one step ends, or is
    discarded with a time inside it.
    """
    status = try_initialize(slave, parameters | inputs)
    if status == ERROR:
        assert names_value_and_limit(slave.messages[-1][2]), slave.messages
        return
    assert status in (OK, WARNING)
    assert np.isfinite(slave.outputs()).all()
    status = slave.call("DoStep", 0.0, 2e-5, 1)
    assert status in (OK, WARNING, DISCARD), slave.messages
    assert np.isfinite(slave.outputs()).all()
    assert 0.0 <= slave.get("time")[0] <= 2e-5 * (1 + 1e-12)


TINY = (5e-324, 1e-160, -1e-160)  # whose reciprocal is infinite, whose square is zero


@pytest.mark.parametrize("tiny", TINY)
def test_any_value_next_to_zero_runs_or_is_refused_by_name(slave, tiny):
    """Each parameter and input that may be zero or of either sign: what divides by it, or by its square, says so."""
    known = (variables.PARAMETERS | variables.INPUTS).values()
    allowed = [re.sub(r"\[\w\]", "[1]", v.name) for v in known if isinstance(v.start, float) and v.min <= tiny <= v.max]
    assert len(allowed) > 30
    for name in allowed:
        status = try_initialize(slave, {name: tiny})
        if status == ERROR:
            assert name in slave.messages[-1][2] and names_value_and_limit(slave.messages[-1][2]), slave.messages
            continue
        assert np.isfinite(slave.outputs()).all(), name
        assert slave.call("DoStep", 0.0, 1e-5, 1) in (OK, WARNING), (name, slave.messages)
        assert np.isfinite(slave.outputs()).all(), name


@QUICK
@given(
    inputs=st.lists(some_values(variables.INPUTS, 4), min_size=2, max_size=6),
    steps=st.lists(st.floats(1e-9, 3e-5), min_size=6, max_size=6),
)
def test_any_jump_of_inputs_keeps_values_finite(slave, inputs, steps):
    """Loads, speed, tilt and temperatures jump within their limits at every communication point; temperatures that the
    bearing does not bear are refused.
    """
    assert try_initialize(slave, {}) == OK
    for changes, step in zip(inputs, steps, strict=False):
        for name, value in changes.items():
            slave.set(name, value)
        status = slave.call("DoStep", slave.time, step, 1)
        if status == ERROR and " K: there " in slave.messages[-1][2]:
            return
        assert np.isfinite(slave.outputs()).all()
        if status == DISCARD:
            return
        assert status in (OK, WARNING)
        slave.time += step


@QUICK
@given(
    omega=st.floats(-4000.0, 4000.0),
    loads=st.tuples(*[st.floats(-6000.0, 6000.0)] * 3),
    tilt=st.floats(-0.004, 0.004),
    pulse=st.floats(0.0, 1e4),
    mode=st.integers(1, 3),
)
def test_energy_balance_closes(slave, omega, loads, tilt, pulse, mode):
    """Residual of Runge-Kutta over 0.2 ms below 5e-4 J.  A step may err by the tolerance 3e-4 in each state class, that
    is 3 nm of way against some kN (10 uJ) and 3e-5 m/s of a ball's 30 m/s (6 uJ), in some 50 steps; largest observed
    1.2e-4 J.
    """
    F_x, F_y, F_z = loads
    values = {
        "shaft.omega": omega,
        "shaft.F_x": F_x,
        "shaft.F_y": F_y,
        "shaft.F_z": F_z,
        "shaft.tilt_z": tilt,
        "ring.tilt_mode": mode,
    }
    solver = {"solver.tol": 3e-4, "solver.method": variables.Method.EXPLICIT, "solver.max_steps": 100000}
    assert try_initialize(
        slave, values | solver | {"pulse.F_r": pulse, "pulse.t_start": 5e-5, "pulse.duration": 1e-4}
    ) in (OK, WARNING)
    slave.step(2e-4)
    assert abs(slave.get("bearing.energy_residual")[0]) < 5e-4


# ------------------------------------------------------------------------------------------------------------- recovery


def state_after(slave, steps=5):
    """The whole state after some steps of the default scene, as bytes."""
    return slave.initialize().step(H, steps).bytes(slave.save())


def refused_value(slave):
    assert slave.try_set("shaft.F_x", np.nan) == ERROR


def refused_parameters(slave):
    slave.set("cage.D_i", 0.061)
    slave.check("EnterInitializationMode")
    assert slave.call("ExitInitializationMode") == ERROR


def refused_start(slave):
    slave.set("shaft.F_x", 1e5)
    slave.set("shaft.tilt_z", 0.035)
    slave.check("EnterInitializationMode")
    assert slave.call("ExitInitializationMode") == ERROR
    assert "out of the" in slave.messages[-1][2]


def refused_step(slave):
    slave.initialize(shaft__omega=300.0).step(H)
    assert slave.call("DoStep", 1.0, H, 1) == ERROR


def discarded_step(slave):
    slave.initialize(solver__max_steps=20, scene__lubrication=2)
    assert slave.call("DoStep", 0.0, 0.01, 1) == DISCARD


def damaged_state(slave):
    data = bytearray(slave.initialize().step(H).bytes(slave.save()))
    data[len(data) // 2] ^= 4
    assert slave.try_load(bytes(data))[0] == ERROR


@pytest.mark.parametrize(
    "accident", [refused_value, refused_parameters, refused_start, refused_step, discarded_step, damaged_state]
)
def test_after_any_accident_a_reset_instance_is_as_new(folder, accident):
    """Every byte of the state; and the accident's instance can be freed as it is."""
    fresh, used, freed = Slave(folder), Slave(folder), Slave(folder)
    accident(used)
    accident(freed)
    freed.free()
    used.check("Reset")
    assert state_after(used) == state_after(fresh)


@pytest.mark.parametrize("cage", [1, 3])
@pytest.mark.parametrize("step", [2.5e-5, 3.3e-5, 5e-5, 1e-4])
def test_steps_far_too_long_end_with_numbers_and_a_state_to_restore(folder, step, cage):
    """Equal steps beyond what the bearing bears: the run ends within 20 ms.  Each state until then, and that of
    the end, can be restored from its bytes.
    """
    slave = Slave(folder).initialize(solver__method=3, solver__step=step, scene__cage=cage)
    status, n = OK, 0
    while status == OK and n < 200:
        loaded, _ = slave.try_load(slave.bytes(slave.save()))
        assert loaded == OK, (n, slave.messages[-1])
        status = slave.call("DoStep", 1e-4 * n, 1e-4, 1)
        n += 1
    assert status == DISCARD
    assert "smaller solver.step" in slave.messages[-1][2]
    outputs = slave.outputs()
    assert np.all(np.isfinite(outputs))
    assert slave.try_load(slave.bytes(slave.save()))[0] == OK
    good = Slave(folder)
    loaded, state = good.try_load(slave.bytes(slave.save()))
    good.check("SetFMUstate", state[0])
    assert np.array_equal(good.get("ball[1].Q_i", "cage.omega"), slave.get("ball[1].Q_i", "cage.omega"))


def test_a_failed_step_leaves_the_last_good_state(folder):
    """Time and outputs of a discarded step are those of an instance that was asked to stop there."""
    failed, stopped = Slave(folder).initialize(solver__max_steps=40), Slave(folder).initialize()
    assert failed.call("DoStep", 0.0, 0.01, 1) == DISCARD
    reached = failed.get("time")[0]
    assert 0.0 < reached < 0.01
    stopped.step(reached)
    names = ["ring.x", "ring.y", "ball[1].x", "ball[5].r", "cage.y", "cage.z"]
    # at most the last steps are cut otherwise: ten times the tolerance of one step in a length; observed 0
    allowed = 10 * 3e-4 * 1e-5
    assert np.max(np.abs(failed.get(*names) - stopped.get(*names))) < allowed
    assert np.isfinite(failed.outputs()).all()


# ---------------------------------------------------------------------------------------------------------- determinism

PROGRAM = """
import sys; from pathlib import Path; from slave import Slave
slave = Slave(Path(sys.argv[1])).initialize(scene__lubrication=2).step(1e-4, 5)
sys.stdout.write(slave.bytes(slave.save()).hex())
"""


def elsewhere(folder, cwd, **environment):
    """The state of the same run in another process."""
    here = str(Path(__file__).parent)
    paths = os.pathsep.join([here, str(Path(here).parent)])
    result = subprocess.run(
        [sys.executable, "-c", PROGRAM, str(folder)],
        cwd=cwd,
        env=os.environ | {"PYTHONPATH": paths} | environment,
        capture_output=True,
        text=True,
        check=True,
    )
    return bytes.fromhex(result.stdout)


def test_another_process_directory_and_environment(folder, tmp_path):
    slave = Slave(folder).initialize(scene__lubrication=2).step(H, 5)
    assert elsewhere(folder, tmp_path, LC_ALL="de_DE.UTF-8", OMP_NUM_THREADS="1", TZ="Asia/Tokyo") == slave.bytes(
        slave.save()
    )


def decimal_comma():
    """Name of an installed locale whose decimal point is a comma; None if there is none."""
    names = subprocess.run(["locale", "-a"], capture_output=True, text=True, check=False).stdout.split()
    libc = ctypes.CDLL(None)
    libc.setlocale.restype, libc.setlocale.argtypes = ctypes.c_char_p, (ctypes.c_int, ctypes.c_char_p)
    for name in (name for name in names if re.match(r"(de|fr|it|es|nl|pl|sv|da|fi)_", name)):
        if libc.setlocale(1, name.encode()):  # LC_NUMERIC
            buffer = ctypes.create_string_buffer(16)
            libc.snprintf(buffer, 16, b"%.1f", ctypes.c_double(0.5))
            libc.setlocale(1, b"C")
            if b"," in buffer.value:
                return name
    return None


@pytest.fixture
def comma_locale(tmp_path):
    """A decimal comma for the C library of this process; glibc's own tool makes the locale where none is installed."""
    libc = ctypes.CDLL(None)
    libc.setlocale.restype, libc.setlocale.argtypes = ctypes.c_char_p, (ctypes.c_int, ctypes.c_char_p)
    name = decimal_comma()
    if name is None:
        made = subprocess.run(
            ["localedef", "-i", "de_DE", "-f", "UTF-8", str(tmp_path / "de_DE.UTF-8")], capture_output=True, check=False
        )
        if made.returncode > 1:
            pytest.skip("no locale with a decimal comma, and none can be made")
        os.environ["LOCPATH"] = str(tmp_path)
        name = "de_DE.UTF-8"
    if not libc.setlocale(1, name.encode()):
        pytest.skip(f"{name} can be neither made nor set: apt-get install locales")
    yield name
    libc.setlocale(1, b"C")
    os.environ.pop("LOCPATH", None)


def test_decimal_comma_changes_no_bit(folder, comma_locale):
    """Also the refusals are understood: numbers in messages have the host's comma, the values are the same."""
    there = Slave(folder).initialize(scene__lubrication=2).step(H, 5)
    there_bytes = there.bytes(there.save())
    ctypes.CDLL(None).setlocale(1, b"C")
    here = Slave(folder).initialize(scene__lubrication=2).step(H, 5)
    assert here.bytes(here.save()) == there_bytes


FLUSH = 0x8040  # x86-64: denormals read and written as zero
X86 = os.uname().machine == "x86_64" if hasattr(os, "uname") else False


@pytest.fixture
def control_word(tmp_path):
    """Reads and writes the SSE control word of this thread."""
    source, library = tmp_path / "mode.c", tmp_path / "mode.so"
    source.write_text(
        "#include <xmmintrin.h>\nunsigned get(void) { return _mm_getcsr(); }\nvoid set(unsigned word) { _mm_setcsr(word); }\n"
    )
    subprocess.run(["cc", "-shared", "-fPIC", str(source), "-o", str(library)], check=True)
    mode = ctypes.CDLL(str(library))
    before = mode.get()
    yield mode
    mode.set(before)


@pytest.mark.skipif(not X86, reason="sets the SSE control word")
@pytest.mark.parametrize("bits", [FLUSH, 0x6000 | FLUSH, 0x2000])
def test_flushed_denormals_and_rounding_of_the_host_change_no_bit(folder, control_word, bits):
    """Set before each call, as a host that computes in that mode has it; still set after each call."""
    states = []
    for extra in (0, bits):
        slave = Slave(folder)
        slave.check("EnterInitializationMode")
        word = (control_word.get() & ~0x3F) | extra
        for function, arguments in [("ExitInitializationMode", ()), *(("DoStep", (k * H, H, 1)) for k in range(5))]:
            control_word.set(word)
            status = slave.call(function, *arguments)
            kept = control_word.get() & ~0x3F
            control_word.set(word & ~(0x6000 | FLUSH))
            assert status == OK
            assert kept == word & ~0x3F
        states.append(slave.bytes(slave.save()))
    assert states[0] == states[1]


def test_the_number_of_instances_changes_no_bit(folder):
    """One alone, and one among ten that run other scenes in between."""
    alone = Slave(folder).initialize().step(H, 5)
    others = [Slave(folder).initialize(shaft__omega=100.0 * k, joint__preload=5.0 * k) for k in range(9)]
    among = Slave(folder).initialize()
    for _ in range(5):
        for other in others:
            other.step(1e-5)
        among.step(H)
    assert among.bytes(among.save()) == alone.bytes(alone.save())


def test_angles_stay_exact_after_a_million_turns(core):
    """dy/dt with all azimuths and the cage a million turns ahead: as without, to the angles' resolution.

    That is 9e-10 rad, 2.5e-11 m at the pitch circle; with a contact's 1.8e8 N/m 4e-3 N of 1500 N: 3e-6.  Observed
    1.3e-9: angles enter by the direction of the loads only.
    """
    model = core.model()
    y = model.start()
    ahead = y.copy()
    for block in (variables.BALL_THETA, variables.CAGE_PSI):
        ahead[block] += 2.0 * np.pi * 1_000_000
    a, b = model.rhs(0.0, y), model.rhs(0.0, ahead)
    for name, block in (("v_r", variables.BALL_V_R), ("v_x", variables.BALL_V_X), ("omega_m", variables.BALL_OMEGA_M)):
        scale = 1500.0 / model.d.m / (1.0 if name != "omega_m" else 0.02675)
        assert np.max(np.abs(a[block] - b[block])) < 3e-6 * scale, name
