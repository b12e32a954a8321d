"""What an instance refuses or bounds: bodies that cannot be, motions that contradict their velocity, tolerances,
messages, and large or foreign files.
"""

import time
import zipfile
from dataclasses import replace
from functools import cache
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy import fmi2
from fmpy.fmi1 import FMICallException

from bearing_model.generated.variables import RingMotion
from bearing_model.physics import ring_load
from bearing_model.physics.parameters import InputDerivatives, Inputs, Parameters
from riveted_bearing.base.errors import UserError
from riveted_bearing.running import fmu as reader
from riveted_bearing.running.results import write_result
from riveted_bearing.running.runner import simulate
from riveted_bearing.running.scene import load_scene
from riveted_bearing.show.report import report_pages
from riveted_bearing.studies.sweep_file import MOST_RUNS, load_sweep

FMU = Path(__file__).resolve().parents[1] / "fmus" / "RivetedBearing.fmu"
STEP = 1e-4  # [s]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The FMU's files."""
    return fmpy.extract(str(FMU), str(tmp_path_factory.mktemp("fmu")))


@cache
def describe(folder):
    return fmpy.read_model_description(folder)


class Host:
    """An instance through fmpy; `messages` has (status, category, text) of every call of the logger."""

    def __init__(self, folder, logging=False, tolerance=None, **start):
        description = describe(folder)
        identifier = description.coSimulation.modelIdentifier
        self.slave = fmi2.FMU2Slave(
            guid=description.guid, unzipDirectory=folder, modelIdentifier=identifier, instanceName="bearing"
        )
        self.variables = {v.name: v for v in description.modelVariables}
        self.messages = []
        self.memory = fmi2.fmi2CallbackFunctions()
        self.memory.logger = fmi2.fmi2CallbackLoggerTYPE(self.keep)
        self.memory.allocateMemory = fmi2.fmi2CallbackAllocateMemoryTYPE(fmi2.calloc)
        self.memory.freeMemory = fmi2.fmi2CallbackFreeMemoryTYPE(fmi2.free)
        self.instantiate(callbacks=self.memory, loggingOn=logging)
        self.set(**start)
        self.setupExperiment(tolerance=tolerance, startTime=0.0)

    def __getattr__(self, name):
        return getattr(self.slave, name)

    def keep(self, _environment, _instance, status, category, text):
        self.messages.append((status, category.decode(), text.decode()))

    def set(self, **values):
        for name, value in values.items():
            variable = self.variables[name.replace("__", ".")]
            write = self.setReal if variable.type == "Real" else self.setInteger
            write([variable.valueReference], [value])

    def get(self, *names):
        return np.array(self.getReal([self.variables[name].valueReference for name in names]))

    def start(self):
        self.enterInitializationMode()
        self.exitInitializationMode()
        return self

    def texts(self, status):
        return [text for kind, _, text in self.messages if kind == status]


@pytest.fixture
def host(folder):
    """Hosts, freed at the end."""
    made = []

    def make(start=(), **options):
        made.append(Host(folder, **options, **dict(start)))
        return made[-1]

    yield make
    for one in made:
        one.freeInstance()


# ---------------------------------------------------------------------------------------------------------- inertia

TILTING = {"ring.tilt_mode": 2}


@pytest.mark.parametrize(
    ("start", "name"),
    [
        ({"cage.J_t": 1e-10}, "cage.J_p"),  # 3 s a step before
        ({"cage.J_p": 1.0}, "cage.J_p"),
        ({"cage.J_p": 1.0, "cage.J_t": 1.0}, "cage.J_p"),
        ({"cage.J_t": 1e-3}, "cage.J_t"),
        ({"cage.m": 1e-5}, "cage.m"),  # 40,000 steps in 0.1 ms with cage.J_t = 0.7
        ({"cage.m": 10.0}, "cage.m"),
        ({"cage.J_p": 4e-10, "cage.J_t": 2e-10}, "cage.J_p"),
        ({"cage.J_t": 1.04e-5}, "cage.J_p"),  # 2 % below J_p/2
        ({"cage.m": 0.05, "cage.J_p": 2.2e-5, "cage.J_t": 1.11e-5}, "cage.J_p"),  # of a lighter half
        ({"ring.J_p": 100.0}, "ring.J_p"),
        ({"ring.J_t": 1e-9}, "ring.J_p"),
        (TILTING | {"ring.J_p": 1e-9, "ring.J_t": 1e-9}, "ring.J_p"),
    ],
    ids=str,
)
def test_impossible_inertia_is_refused(host, start, name):
    one = host(start)
    one.enterInitializationMode()
    with pytest.raises(FMICallException):
        one.exitInitializationMode()
    assert one.texts(fmi2.fmi2Error)[0].startswith(f"{name} = ") and "is allowed" in one.texts(fmi2.fmi2Error)[0]


@pytest.mark.parametrize(
    "start",
    [
        {},
        {"cage.m": 0.1},  # moments of inertia left at their start follow the mass
        {"cage.m": 1e-3},
        {"cage.J_p": 2.0e-5},
        {"cage.J_p": 2.13e-5, "cage.J_t": 1.06e-5},  # a thin ring, rounded
        {"cage.J_t": 5e-5},
        {"ring.m": 1000.0},  # a ring that does not tilt has no use for its moments of inertia
        {"ring.J_p": 1e-9},
        TILTING | {"ring.m": 3.0},
        TILTING | {"ring.J_p": 10.0, "ring.J_t": 6.0},  # a disk on the shaft
    ],
    ids=str,
)
def test_possible_inertia_is_accepted(host, start):
    one = host(start).start()
    began = time.perf_counter()
    one.doStep(0.0, STEP)
    assert time.perf_counter() - began < 1.0  # a few ms; J_t = 1e-10 kg m2 took 3 s
    assert not one.texts(fmi2.fmi2Error)


# ----------------------------------------------------------------------------------------------------------- motions


def test_contradicting_motion_bounds_a_short_step(host):
    """A housing given at rest in place with 10 m/s, and a step of 2e-8 s: 285,992 internal steps and 1.2e7 N in the 1e-4
    s after it, or fmi2Discard, when the whole mismatch of 1 mm was made up within the short step.
    """
    one, t, steps, force = host({}, logging=True).start(), 0.0, [], []
    lags = []
    for k in range(24):
        h = 2e-8 if k == 17 else STEP
        if k >= 10:
            one.set(**{"housing.v_z": 10.0, "housing.z": 0.0})
        before = one.get("solver.steps")[0]
        one.doStep(t, h)
        t += h
        steps.append(one.get("solver.steps")[0] - before)
        lags.append(one.get("event.motion_lag")[0])
        force.append(np.hypot(*one.get("housing.F_y", "housing.F_z")))
    assert max(steps) < 3000 and max(force) < 5e5  # observed 671, 1.9e5 N
    assert lags == [1.0 if k == 17 else 0.0 for k in range(24)]
    assert one.get("event.motion_lag_onsets")[0] == 1.0
    said = [text for text in one.texts(fmi2.fmi2Warning) if "catches up" in text]
    assert len(said) == 1 and "housing.z and housing.v_z" in said[0] and "they are -0.001 m and" in said[0]


def motions(given, now, h, **parameters):
    """Inputs at the end of a step of length h [s] by the Python reference, and their trajectory."""
    p = Parameters({"ring.motion": RingMotion.PRESCRIBED} | parameters)
    u = ring_load.motion_trajectory(p, (given, InputDerivatives(), InputDerivatives()), now, h)
    trajectory = ring_load.input_trajectory_update(p, u, 0.0, 0.0)
    return ring_load.input_trajectory_at(trajectory, h), trajectory


@pytest.mark.parametrize("h", [2e-8, 1e-6, 2e-5])
@pytest.mark.parametrize(("x", "v"), [(2e-4, 0.0), (-5e-5, 3.0)])
def test_twins_catch_up_alike(host, h, x, v):
    """The ring's position and velocity after a jump in a prescribed motion."""
    one = host({"ring.motion": 2}, logging=True).start()
    one.set(**{"shaft.z": x, "shaft.v_z": v})
    one.doStep(0.0, h)
    end, _ = motions(Inputs({"shaft.z": x, "shaft.v_z": v}), Inputs({}), h)
    assert one.get("ring.z", "ring.v_z") == pytest.approx([end.shaft.z, end.shaft.v_z], rel=1e-9)
    assert ("catches up" in "".join(one.texts(fmi2.fmi2Warning))) == (abs(end.shaft.z - x - v * h) > 1e-9)


@pytest.mark.parametrize(
    ("group", "q", "v", "r"), [("housing", "z", "v_z", 1.0), ("shaft", "tilt_y", "tilt_y_dot", None)]
)
def test_acceleration_of_catching_up_is_bounded(group, q, v, r):
    """In whatever steps the mismatch is made up: the acceleration stays below the limit, and the motion arrives."""
    r = r or 0.5 * Parameters({}).bearing.d_m
    jump = 5e-4 / r
    for h in (1e-8, 1e-6, 1e-5, 1e-4):
        given, now, t = Inputs({f"{group}.{q}": jump}), Inputs({}), 0.0
        for _ in range(round(min(1e-3 / h, 400))):
            before = abs(getattr(getattr(now, group), q) - jump)
            now, trajectory = motions(given, now, h)
            t += h
            first, rate = (getattr(getattr(u, group), v) for u in trajectory.u[1:])
            assert max(abs(first), abs(first + h * rate)) <= 1.001e6 / r
            assert abs(getattr(getattr(now, group), q) - jump) <= before + 0.1 * jump
        left = abs(getattr(getattr(now, group), q) - jump)
        assert left < 1e-3 * jump or t < 5e-4


@pytest.mark.parametrize("h", [1e-3, 1e-4, 1e-5, 1e-6])
def test_smooth_motion_does_not_catch_up(h):
    """1 kHz with 20 um, sampled: each step ends where the given values lead, by the one cubic polynomial of its ends."""
    p, now, history, w = Parameters({}), None, None, 2.0 * np.pi * 1000.0
    for k in range(50):
        z, v_z = 2e-5 * np.sin(w * k * h + 0.3), 2e-5 * w * np.cos(w * k * h + 0.3)
        given = Inputs({"housing.z": z, "housing.v_z": v_z})
        now = now or given
        gap, slow = z - now.housing.z, v_z - now.housing.v_z
        assert ring_load.catch_up_time(gap, slow, h, ring_load.catch_up_limit(p, "housing", "z")) == h
        u = ring_load.motion_trajectory(p, (given, InputDerivatives(), InputDerivatives()), now, h, history)
        history = ring_load.motion_remember(given, h, history)
        now = ring_load.input_trajectory_at(ring_load.input_trajectory_update(p, u, 0.0, 0.0), h)


@pytest.mark.parametrize("name", ["housing.y", "housing.tilt_z", "frame.omega"])
@pytest.mark.parametrize("h", [1e-9, 1e-7, 2e-6])
def test_jump_stays_cheap(host, name, h):
    """Twenty short steps and three of 0.1 ms after it; where the motion is caught up with, the event has gone."""
    size = {"housing.y": 2e-4, "housing.tilt_z": 5e-3, "frame.omega": 50.0}[name]
    one, t = host({}).start(), 0.0
    one.set(**{name: size})
    for step in [h] * 20 + [STEP] * 3:
        one.doStep(t, step)
        t += step
    assert one.get("solver.steps")[0] < 5000  # observed 620 at most
    assert one.get("event.motion_lag", "event.motion_lag_onsets") == pytest.approx([0.0, 1.0])


def test_smooth_motions_are_no_event(host):
    """Sines of housing and shaft, 3 kHz and 9e3 m/s2, in steps of 1 ns, of 1 us and of 1 to 5 us in turn."""
    one = host({"ring.motion": 2, "shaft.x": 1e-5, "shaft.y": 2e-5}).start()
    w, size, t = 2.0 * np.pi * 3e3, 2.5e-5, 0.0
    for h in [1e-9] * 100 + [1e-6] * 100 + list(np.random.default_rng(5).choice([1e-6, 2e-6, 5e-6], 200)):
        for name, place in (("housing.{}z", 0.0), ("shaft.{}y", 2e-5)):
            one.set(**{name.format(""): place + size * (1.0 - np.cos(w * t))})
            one.set(**{name.format("v_"): size * w * np.sin(w * t)})
        one.doStep(t, h)
        t += h
        assert one.get("event.motion_lag")[0] == 0.0


# -------------------------------------------------------------------------------------------------------- work limit


def test_work_limit_scales_with_the_communication_step(host):
    """0, the default: 10,000 steps for each 0.1 ms; a limit that is given counts for one communication step."""
    limited = host({"solver.max_steps": 300}).start()
    with pytest.raises(FMICallException) as refused:
        limited.doStep(0.0, 1e-2)
    assert refused.value.status == fmi2.fmi2Discard
    assert "work limit is reached, 300 steps since 0 s (solver.max_steps = 300)" in limited.messages[-1][2]
    one = host({}).start()
    one.doStep(0.0, 5e-2)
    assert one.get("solver.steps")[0] > 300


def test_default_work_limit_is_in_force(host):
    """10,000 times gravity at the smallest tolerance: refused after 0.2 s of processor time, with the number of steps."""
    one = host({"frame.a_y": -1e5}, tolerance=1e-10).start()
    with pytest.raises(FMICallException) as refused:
        one.doStep(0.0, STEP)
    assert refused.value.status == fmi2.fmi2Discard
    assert "work limit is reached, 6000 steps since 0 s (solver.max_steps = 0)" in one.messages[-1][2]


def test_smallest_tolerance_stays_within_the_work_limit(host):
    one = host({}, tolerance=1e-10).start()
    for k in range(2):
        one.doStep(k * STEP, STEP)
    assert one.get("solver.steps")[0] < 2 * 5000  # observed 2 * 860


@pytest.mark.parametrize("step", [5e-324, 1e-12, 9.9e-10])
def test_steps_too_short_for_any_communication_are_refused_by_name(host, step):
    one = host({"solver.method": 3, "solver.step": step})
    with pytest.raises(FMICallException):
        one.start()
    assert f"solver.step = {step:g} s: 0, which stands for a derived step, or at least 1e-09 s" in one.messages[-1][2]


def test_more_fixed_steps_than_the_work_limit_are_refused_at_once(host):
    """2 ns are 50,000 steps in 0.1 ms, and 5,000 in 0.01 ms."""
    one = host({"solver.method": 3, "solver.step": 2e-9}).start()
    one.doStep(0.0, 0.1 * STEP)
    with pytest.raises(FMICallException) as refused:
        one.doStep(0.1 * STEP, STEP)
    assert refused.value.status == fmi2.fmi2Error
    text = one.messages[-1][2]
    assert "solver.step = 2e-09 s" in text and "5e+04 internal steps, 20000 are allowed" in text
    assert "5e-09 s or more" in text


def test_fixed_steps_are_the_users_own(host):
    """solver.step = 8 ns: 12,500 steps in 0.1 ms are no failure."""
    one = host({"solver.method": 3, "solver.step": 8e-9}).start()
    one.doStep(0.0, STEP)
    assert one.get("solver.steps")[0] == 12500


# --------------------------------------------------------------------------------------------------------- tolerance


@pytest.mark.parametrize("tolerance", [1e-12, 9.9e-11, 0.0, -1.0, float("-inf"), float("nan")])
def test_unusable_tolerance_leaves_that_of_the_bearing(host, tolerance):
    """One warning, and the run of solver.tol; 1e-12 became 1e-10, with 124 times the steps."""
    one, own = host({}, tolerance=tolerance, logging=True).start(), host({}).start()
    names = [name for name, v in one.variables.items() if v.causality == "output" and not name.startswith("solver.")]
    for k in range(5):
        one.doStep(k * STEP, STEP)
        own.doStep(k * STEP, STEP)
    assert np.array_equal(one.get(*names), own.get(*names))
    assert one.get("solver.steps") == own.get("solver.steps")
    warnings = one.texts(fmi2.fmi2Warning)
    assert len(warnings) == 1 and "solver.tol takes its place" in warnings[0]


@pytest.mark.parametrize(("tolerance", "warnings"), [(1e-10, 0), (1e-4, 0), (1.0, 1)])
def test_usable_tolerance_is_used(host, tolerance, warnings):
    one, own = host({}, tolerance=tolerance, logging=True).start(), host({}).start()
    one.doStep(0.0, STEP)
    own.doStep(0.0, STEP)
    assert len(one.texts(fmi2.fmi2Warning)) == warnings
    assert one.get("solver.steps") != own.get("solver.steps")


# ------------------------------------------------------------------------------------------- large and foreign files

FROM_TO = "{ from = 100.0, to = 200.0, count = 1000 }"
HUGE = {
    "repeats": "repeats = 1000000000",
    "range": "[[vary]]\nshaft.F_x = { from = 1.0, to = 2.0, count = 1000000000 }",
    "product": "".join(f"[[vary]]\nshaft.F_{i} = {FROM_TO}\n" for i in "xyz"),
    "sample": '[sample]\nmethod = "latin_hypercube"\ncount = 1000000000\nbetween = { shaft.F_x = [100.0, 200.0] }',
}


@pytest.mark.parametrize("kind", HUGE)
def test_huge_sweep_is_refused_before_it_has_memory(kind, tmp_path):
    """A billion runs: one line with their number and memory; before, the process took memory until it was killed."""
    path = tmp_path / "huge.toml"
    path.write_text(HUGE[kind] + "\n")
    began, model = time.perf_counter(), reader.Model(FMU)
    with pytest.raises(UserError, match=f"1,000,000,000 runs would take 7,000 GB .* at most {MOST_RUNS:,} are allowed"):
        load_sweep(path, model)
    assert time.perf_counter() - began < 5.0


def fmu_with(path, change=lambda description: description, zeros=0):
    """A copy of the FMU with another description, and with a file of zeros."""
    with zipfile.ZipFile(FMU) as source, zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as copy:
        for name in source.namelist():
            content = source.read(name)
            copy.writestr(name, change(content) if name == "modelDescription.xml" else content)
        if zeros:
            with copy.open("resources/zeros", "w", force_zip64=True) as file:
                for _ in range(zeros // 10**7):
                    file.write(bytes(10**7))
    return path


def test_fmu_that_unpacks_to_too_much_is_refused(tmp_path):
    """510 MB in an archive of 3 MB."""
    path = fmu_with(tmp_path / "large.fmu", zeros=510_000_000)
    assert path.stat().st_size < 1e7
    with pytest.raises(UserError, match="files of 51. MB are too much for an FMU; at most .* 500 MB are allowed"):
        reader.Model(path)


@pytest.mark.parametrize("identifier", ["../../outside/RivetedBearing", "/tmp/RivetedBearing", "..", "a/b", ""])
def test_model_identifier_stays_in_its_folder(identifier, tmp_path):
    """It names the binary: one that leaves the folder would load a file from elsewhere."""
    new = f'modelIdentifier="{identifier}"'.encode()
    path = fmu_with(tmp_path / "other.fmu", lambda text: text.replace(b'modelIdentifier="RivetedBearing"', new))
    with pytest.raises(UserError, match="modelIdentifier = .* is not allowed: a C name is needed"):
        reader.Model(path)


def test_whole_fmu_is_read():
    assert reader.Model(FMU).description.coSimulation.modelIdentifier == "RivetedBearing"


@pytest.mark.parametrize("inputs_too", [False, True])
def test_result_of_nothing_but_nan_is_one_line(inputs_too, tmp_path):
    """Before, ValueError from one chart or another."""
    model = reader.Model(FMU)
    result = simulate(model, load_scene(None, model, ("test", {"simulation": {"t_end": 2e-3}})))
    kept = {"time"} | (set() if inputs_too else {name for name in result.data if name in model.inputs})
    data = {name: x if name in kept else np.full_like(x, np.nan) for name, x in result.data.items()}
    summary = dict.fromkeys(result.summary, float("nan"))
    path = write_result(replace(result, data=data, summary=summary), tmp_path / "nan.parquet")
    with pytest.raises(UserError, match=r"nan\.parquet: no output has a number"):
        list(report_pages(path))


# ----------------------------------------------------------------------------------------------------------- messages


def overdriven(one):
    """A step with a warning (the tolerance), events and solver messages, then one that the work limit discards."""
    one.start()
    one.doStep(0.0, STEP)
    with pytest.raises(FMICallException) as refused:
        one.doStep(STEP, 1.0)
    return refused.value.status


def test_reason_of_discard_and_error_is_always_logged(host):
    for logging in (False, True):
        one = host({"solver.max_steps": 1000, "bearing.p_limit": 1e9}, tolerance=1.0, logging=logging)
        assert overdriven(one) == fmi2.fmi2Discard
        reasons = [text for status, category, text in one.messages if category == "logStatusError"]
        assert len(reasons) == 1 and "solver.max_steps = 1000" in reasons[0]
        with pytest.raises(FMICallException) as refused:
            one.doStep(5.0, STEP)
        assert refused.value.status == fmi2.fmi2Error
        assert one.messages[-1][1] == "logStatusError"
        others = {category for _, category, _ in one.messages} - {"logStatusError"}
        assert ("logStatusWarning" in others) == logging
        assert logging or not others


def test_chosen_categories_are_logged(host):
    one = host({"bearing.p_limit": 1e9}, logging=True)
    one.setDebugLogging(True, ["logEvents"])
    one.start()
    one.doStep(0.0, STEP)
    assert {category for _, category, _ in one.messages} <= {"logEvents"}
    one.setDebugLogging(False, [])
    count = len(one.messages)
    one.doStep(STEP, STEP)
    assert len(one.messages) == count


def test_runs_keep_warnings():
    """riveted-bearing turns logging on: warnings are part of a run's record."""
    model = reader.Model(FMU)
    changes = {"simulation": {"t_end": 1e-3}, "parameters": {"bearing": {"p_limit": 1e9}}}
    result = simulate(model, load_scene(None, model, ("test", changes)))
    assert any("p_limit" in text for text in result.about["messages"])
