"""What the FMU repeats bit for bit: reset, instances, threads, rounding modes, saved and restored states; what it
refuses to restore.
"""

import ctypes
import ctypes.util
import struct
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from slave import DISCARD, ERROR, OK, Slave

from bearing_model.generated.variables import Method, Switch

H = 1e-4  # communication step [s]
LINUX = sys.platform.startswith("linux")


def same_bits(a, b):
    return a.tobytes() == b.tobytes()


# ------------------------------------------------------------------------------------------------------ reproducibility


def test_reset_is_as_new_bit_for_bit(folder):
    fresh, used = Slave(folder).initialize(), Slave(folder)
    used.initialize(tolerance=1e-3, joint__preload=50.0, start__seed=7, shaft__F_x=100.0).step(H, 5)
    used.check("Reset")
    used.initialize()
    assert same_bits(fresh.step(H, 10).outputs(), used.step(H, 10).outputs())


def test_two_interleaved_instances_equal_two_separate_ones(folder):
    separate = [Slave(folder).initialize(joint__preload=p).step(H, 10).outputs() for p in (20.0, 40.0)]
    together = [Slave(folder).initialize(joint__preload=p) for p in (20.0, 40.0)]
    for _ in range(10):
        for slave in together:
            slave.step(H)
    for expected, slave in zip(separate, together, strict=True):
        assert same_bits(expected, slave.outputs())
    assert not same_bits(*separate)


def test_any_thread(folder):
    """Eight different instances stepped in eight threads, created in this one, equal those stepped here one after the
    other.
    """
    loads = 1000.0 + 250.0 * np.arange(8)
    slaves = [Slave(folder).initialize(shaft__F_y=float(load)) for load in loads]
    threads = [threading.Thread(target=slave.step, args=(H, 10)) for slave in slaves]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for slave, load in zip(slaves, loads, strict=True):
        assert same_bits(slave.outputs(), Slave(folder).initialize(shaft__F_y=float(load)).step(H, 10).outputs())


def test_a_pool_of_threads_that_create_and_free(folder):
    """32 threads, 128 instances of four loads and both cages, each created, stepped and freed in its thread: the bits of
    instances one after the other.
    """
    cases = [(1000.0 + 500.0 * (n % 4), 1 if n % 8 < 4 else 3) for n in range(128)]

    def outputs(case):
        slave = Slave(folder).initialize(shaft__F_y=case[0], scene__cage=case[1]).step(H, 3)
        found = slave.outputs().tobytes()
        slave.free()
        return found

    expected = {case: outputs(case) for case in set(cases)}
    with ThreadPoolExecutor(32) as pool:
        assert list(pool.map(outputs, cases)) == [expected[case] for case in cases]


@pytest.mark.skipif(not LINUX, reason="other systems' clocks tick too rarely")
def test_processor_time_is_of_the_stepping_thread(folder):
    """Two threads at a time: what both count is no more than what the process spent, which a clock of the process would
    count twice.
    """
    slaves = [Slave(folder).initialize(solver__clock=Switch.ON) for _ in range(2)]
    threads = [threading.Thread(target=slave.step, args=(1e-2, 20)) for slave in slaves]
    before = time.process_time()
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    counted = sum(slave.get("solver.cpu_time")[0] for slave in slaves)
    assert 0.0 < counted <= time.process_time() - before


@pytest.mark.skipif(not LINUX, reason="rounding modes by number")
@pytest.mark.parametrize("rounding", [0x400, 0x800, 0xC00])
def test_any_rounding_mode_of_the_host(folder, rounding):
    """x86-64: downward, upward, toward zero; the host's mode is as before after each call."""
    libm = ctypes.CDLL(ctypes.util.find_library("m"))
    points = [k * H for k in range(5)]
    slaves = [Slave(folder), Slave(folder)]
    for slave, mode in zip(slaves, (0, rounding), strict=True):
        slave.check("EnterInitializationMode")
        libm.fesetround(mode)
        try:
            statuses = [slave.call("ExitInitializationMode")] + [slave.call("DoStep", point, H, 1) for point in points]
            kept = libm.fegetround()
        finally:
            libm.fesetround(0)
        assert statuses == [OK] * 6
        assert kept == mode
    assert same_bits(*(slave.outputs() for slave in slaves))


def test_what_is_read_changes_no_bit(folder):
    curious, silent = Slave(folder).initialize(), Slave(folder).initialize()
    for _ in range(20):
        curious.step(H).outputs()
        silent.step(H)
    assert same_bits(curious.outputs(), silent.outputs())


def test_inputs_set_after_a_step_do_not_change_its_outputs(folder):
    """Whatever the order of setting and reading."""
    slaves = [Slave(folder).initialize().step(H, 3) for _ in range(2)]
    for name, value in (("shaft.F_y", 100.0), ("shaft.omega", 0.0), ("shaft.tilt_z", 0.01), ("impact.F_r", 1000.0)):
        slaves[0].set(name, value)
    assert same_bits(*(slave.outputs() for slave in slaves))


def test_communication_steps_agree_to_the_tolerance(folder):
    """Motion of the ring after 1 ms at tolerance 1e-6: within 10 times the error that the tolerance allows; observed
    1.6 times.
    """
    tolerance = 1e-6
    allowed = tolerance * np.array([1e-5] * 3 + [0.5] * 3)  # scales of length [m] and velocity [m/s]
    names = ("ring.x", "ring.y", "ring.z", "ring.v_x", "ring.v_y", "ring.v_z")
    ends = [Slave(folder).initialize(tolerance=tolerance).step(1e-3 / n, n).get(*names) for n in (1, 10, 100, 1000)]
    for end in ends[1:]:
        assert (np.abs(end - ends[0]) < 10 * allowed).all()


# --------------------------------------------------------------------------------------------------------- saved states


def test_saved_state_continues_bit_for_bit(folder):
    """In the same instance, in a new one, in one that has never been initialized, and after serialization."""
    slave = Slave(folder).initialize(joint__preload=33.0).step(H, 7)
    state, time = slave.save(), slave.time
    data = slave.bytes(state)
    expected = slave.step(H, 7).outputs()
    assert same_bits(slave.restore(state, time).step(H, 7).outputs(), expected)
    other = Slave(folder).initialize(shaft__omega=500.0).step(H, 2)
    for new in (other, Slave(folder)):
        status, loaded = new.try_load(data)
        assert status == OK
        assert same_bits(new.restore(loaded, time).step(H, 7).outputs(), expected)


SCENES = {
    "working_point": {},
    "explicit": {"solver__method": 2},
    "slow_mixed": {"shaft__omega": 400.0, "scene__lubrication": 2},
    "tilted": {"shaft__tilt_z": 0.0087},
    "sliced_fatigue": {"scene__traction": 2, "scene__stress": 4, "start__settle": 0.0},
    "rigid_halves_pulse": {"scene__cage": 1, "pulse__F_r": 1401.0, "pulse__t_start": 1e-3},
}
INPUTS = [1, 2, 6, 8, 9]  # shaft.F_x, F_y, omega, tilt_z, impact.F_r


def new_inputs(slave, rng):
    """Random inputs with random first and second derivatives."""
    values = rng.uniform(0.8, 1.2, 5) * [515.0, 2994.0, 1900.0, 5e-3, 100.0]
    rates = rng.uniform(-1.0, 1.0, 5) * [1e5, 1e6, 1e4, 1.0, 1e5]
    slave.check("SetReal", INPUTS, 5, values.tolist())
    for order, scale in ((1, 1.0), (2, 1e3)):
        slave.check("SetRealInputDerivatives", INPUTS, 5, [order] * 5, (rates * scale).tolist())


@pytest.mark.parametrize("scene", SCENES)
def test_rollback_at_random_points_with_random_steps(folder, scene):
    """100 points in all.  Whole states compared, not only outputs: solver memory, inputs, peaks, statistics and fatigue
    counters go on alike.

    Every second state is saved between new inputs with derivatives and the step that they are for; later steps have
    their own.
    """
    rng = np.random.default_rng(2)
    slave, other = Slave(folder).initialize(**SCENES[scene]), Slave(folder)
    for point in range(17):
        slave.step(10.0 ** rng.uniform(-6, -3.3))
        if point % 2:
            new_inputs(slave, rng)
        state, time = slave.save(), slave.time
        _, loaded = other.try_load(slave.bytes(state))
        steps, seed = 10.0 ** rng.uniform(-6, -3.5, size=3), int(rng.integers(1 << 30))
        ends = []
        for instance, start in ((slave, None), (slave, state), (other, loaded)):
            if start:
                instance.restore(start, time)
            for k, h in enumerate(steps):
                instance.step(h)
                if point % 3 == 0:
                    new_inputs(instance, np.random.default_rng([seed, k]))
            ends.append(instance.bytes(instance.save()))
        assert ends[0] == ends[1] == ends[2]


def test_saving_changes_no_bit(folder):
    saved, silent = Slave(folder).initialize(), Slave(folder).initialize()
    for _ in range(5):
        saved.step(H).save()
        silent.step(H)
    assert same_bits(saved.outputs(), silent.outputs())


def test_saved_state_continues_in_another_process(folder, tmp_path):
    """Fatigue counters in the middle of their cycles, inputs that have been set with their slope."""
    slave = Slave(folder).initialize(scene__stress=4, start__settle=0.0).step(H, 10)
    slave.check("SetRealInputDerivatives", [2, 8], 2, [1, 1], [-1e6, 1.0])
    path, time = tmp_path / "state", slave.time
    path.write_bytes(slave.bytes(slave.save()))
    program = (
        "import sys; from pathlib import Path; from slave import Slave\n"
        f"s = Slave(Path({str(folder)!r})); status, state = s.try_load(Path({str(path)!r}).read_bytes())\n"
        f"sys.stdout.write(s.restore(state, {time!r}).step({H!r}, 3).outputs().tobytes().hex())"
    )
    result = subprocess.run(
        [sys.executable, "-c", program], cwd=Path(__file__).parent, capture_output=True, text=True, check=True
    )
    assert result.stdout == slave.step(H, 3).outputs().tobytes().hex()


def test_inputs_that_the_next_step_would_refuse_can_be_saved(folder):
    """A cage of 700 K does not fit its guide: the step says so, not the restoring of a state in which the host has set
    it.
    """
    slave = Slave(folder).initialize().step(H)
    slave.set("cage.T", 700.0)
    status, state = slave.try_load(slave.bytes(slave.save()))
    assert status == OK, slave.messages
    slave.restore(state, H)
    assert slave.call("DoStep", H, H, 1) == ERROR and "cage.T = 700 K" in slave.messages[-1][2]
    slave.restore(state, H).set("cage.T", 293.15)
    plain = Slave(folder).initialize().step(H, 2)
    assert same_bits(slave.step(H).outputs(), plain.outputs())


def test_state_is_reused_and_freed(running):
    state = running.save()
    address = state[0]
    running.step(H).check("GetFMUstate", state)
    assert state[0] == address
    running.check("FreeFMUstate", state)
    assert state[0] == running.ffi.NULL
    running.check("FreeFMUstate", state)


def test_state_holds_parameters_inputs_and_phase(slave):
    """Saved before initialization, restored after an error."""
    slave.set("joint.preload", 55.0)
    state = slave.save()
    slave.initialize()
    assert slave.call("DoStep", 0.0, -1.0, 1) == ERROR
    slave.restore(state, 0.0)
    slave.initialize()
    assert slave.get("joint.preload")[0] == 55.0


def corrupted(data):
    """What must be refused, and why."""
    header = 216  # magic 8, version 8, GUID 40, digest of the sources 72, of data built in 72, size 8, checksum 8
    for position in (
        header,
        header + 100,
        len(data) // 2,
        len(data) - 1,
        *np.random.default_rng(3).integers(header, len(data), 50),
    ):
        yield data[:position] + bytes([data[position] ^ 1]) + data[position + 1 :], "corrupted"
    yield data[:208] + struct.pack("<Q", struct.unpack_from("<Q", data, 208)[0] ^ 1) + data[header:], "corrupted"
    for length in (0, 10, header, len(data) - 1):
        yield data[:length], "truncated"
    yield data + b"\0", "too long"
    yield bytes(len(data)), "not a saved state"
    yield data[:8] + struct.pack("<Q", 99) + data[16:], "another version"
    yield data[:17] + b"0123" + data[21:], "another model"
    yield data[:56] + b"wxyz" + data[60:], "built from other sources"
    yield data[:128] + b"wxyz" + data[132:], "other data built in"
    yield data[:200] + struct.pack("<Q", len(data) - 8) + data[208:-8], "another size"


def test_corrupted_and_foreign_states_are_refused_with_the_reason(running):
    data = running.bytes(running.save())
    for wrong, reason in corrupted(data):
        status, state = running.try_load(wrong)
        assert status == ERROR, reason
        assert reason in running.messages[-1][2]
        assert state[0] == running.ffi.NULL
        running.check("Reset")
    assert running.try_load(data)[0] == OK


@pytest.mark.parametrize("method", Method)
@pytest.mark.parametrize("step", [5e-324, 1e-310, 3e-308])
def test_a_step_too_short_for_arithmetic_leaves_nothing_behind(folder, step, method):
    """1/h of a subnormal step overflows, its product with a time underflows.  At time zero such a step is not lost in
    the rounding of time; its step size must stay neither in the state nor in the integrator's memory.
    """
    slave = Slave(folder).initialize(solver__method=int(method))
    before = slave.save()
    assert slave.call("DoStep", 0.0, step, 1) == DISCARD
    status, state = slave.try_load(slave.bytes(slave.save()))
    assert status == OK, slave.messages
    slave.restore(state, 0.0)
    assert slave.call("SetFMUstate", state[0]) == OK
    fresh = Slave(folder).initialize(solver__method=int(method)).step(H, 2)
    assert slave.bytes(slave.restore(before, 0.0).step(H, 2).save()) == fresh.bytes(fresh.save())


def test_serialization_needs_the_whole_room(running):
    state = running.save()
    buffer = running.ffi.new("char[]", 100)
    assert running.call("SerializeFMUstate", state[0], buffer, 100) == ERROR
    assert "bytes" in running.messages[-1][2]


@pytest.mark.slow
def test_rollback_by_a_master_with_variable_steps(folder):
    """Every macro step is tried as one, taken back and made as two halves, its size chosen from the difference:
    statistics as from fixed steps.

    Pooled over eight seeds, 0.1 s each after 0.02 s.  Expected: equal within 4 standard errors of the difference of
    means over seeds.
    """
    names = ("stat.Q_c_mean", "stat.Q_c_rms", "stat.sigma_head_mean", "stat.sigma_head_rms", "stat.cage_omega")
    fixed, varied = [], []
    for seed in range(8):
        options = {"start__seed": seed, "start__settle": 0.02, "scene__statistics": 2}
        fixed.append(Slave(folder).initialize(**options).step(H, 1200).get(*names))
        slave, h, tried = Slave(folder).initialize(**options), H, 0
        while slave.time < 0.12:
            state, time = slave.save(), slave.time
            whole = slave.step(h).get("ring.y")[0]
            halves = slave.restore(state, time).step(0.5 * h, 2).get("ring.y")[0]
            slave.check("FreeFMUstate", state)
            tried += 1
            h = float(np.clip(h * np.sqrt(2e-9 / (abs(whole - halves) + 1e-12)), 1e-5, 4e-4))
        assert tried > 300  # steps that vary
        varied.append(slave.get(*names))
    fixed, varied = np.array(fixed), np.array(varied)
    error = np.sqrt((fixed.var(0, ddof=1) + varied.var(0, ddof=1)) / 8)
    print(np.stack([fixed.mean(0), varied.mean(0), error]))
    assert np.all(np.abs(fixed.mean(0) - varied.mean(0)) < 4.0 * error)
    assert np.all(error < 0.03 * fixed.mean(0))  # the comparison says something
