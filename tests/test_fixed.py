"""solver.method = fixed: equal steps, one evaluation each, order two, whole impulses; a host that runs it against the
clock.
"""

import os
import re
import shutil
import subprocess
import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pytest
from library import ROOT
from mechanics import OUTPUTS, Instance, Z

from bearing_model.generated.variables import CageModel, Lubrication, Method, Switch, TiltMode

pytestmark = pytest.mark.c_only
FIXED = {"solver.method": Method.FIXED}
# balls and cage that meet nowhere: a smooth motion
SMOOTH = {"cage.pocket_clearance": 4e-4, "start.spacing": 0.0}


@pytest.mark.parametrize("cage", CageModel)
@pytest.mark.parametrize("step", [3e-6, 7e-6])
def test_every_step_costs_one_evaluation(core, cage, step):
    """A communication step has the fewest whole steps of at most `step`, each with one evaluation; the start has one."""
    bearing = Instance(core, FIXED | {"scene.cage": cage, "solver.step": step})
    steps = int(np.ceil(1e-4 / step * (1.0 - 1e-9)))
    assert steps in (34, 15)
    before = bearing.step(1e-4).output("solver.rhs_evals")
    for n in range(2, 11):
        bearing.step(n * 1e-4)
        assert bearing.output("solver.rhs_evals") == before + (n - 1) * steps
    assert bearing.output("solver.steps") == 10 * steps
    assert before == pytest.approx(steps, abs=1)


def test_long_communication_steps_end_with_a_whole_step(core):
    """8,334 steps of 3 us fill 25 ms to rounding, 1e-14 s, which is no step of its own: its rates of 1e14/s ended the run."""
    bearing = Instance(core, FIXED | {"scene.cage": CageModel.ELASTIC, "solver.step": 3e-6})
    for n in range(1, 4):
        assert bearing.step(n * 0.025).output("solver.steps") == n * 8334


def test_the_derived_length_resolves_the_cages_vibrations(core):
    """Rigid halves vibrate fastest along the axis, all rivets and plates between them: at half m, omega^2 = 2 Z k/m, and a step
    turns that by 2.  Elastic ones have at most two substeps of 3.3 us.
    """
    free = FIXED | SMOOTH
    lengths = {cage: Instance(core, free | {"scene.cage": cage}).output("solver.step_size") for cage in CageModel}
    d, p = core.model().d, core.model().p
    omega = np.sqrt(2.0 * Z * (d.k_rivet + d.k_plate) / p.cage.m)
    assert lengths[CageModel.TWO_HALF] == pytest.approx(2.0 / omega, rel=1e-6)  # 5.1 us
    assert 4e-6 < lengths[CageModel.ELASTIC] <= 6.8e-6


def test_order_two(core, record_property):
    """Positions of a smooth motion over 0.4 ms beside Runge-Kutta's at 1e-9: an eighth of the length leaves a 64th of the
    error; a rule of order one would leave an eighth.
    """

    def places(settings, tolerance=1e-9):
        bearing = Instance(core, SMOOTH | settings, {"shaft.F_y": 3000.0, "shaft.F_x": 800.0}, tolerance=tolerance)
        for n in range(1, 5):
            bearing.step(n * 1e-4)
        return np.concatenate([bearing.output(f"ball.{name}") for name in ("x", "r", "psi")])

    exact = places({"solver.method": Method.EXPLICIT})
    error = [np.abs(places(FIXED | {"solver.step": step}) - exact).max() for step in (8e-6, 1e-6)]
    slope = np.log(error[0] / error[1]) / np.log(8.0)
    record_property("slope", float(slope))
    assert slope == pytest.approx(2.0, abs=0.2)


@pytest.mark.parametrize("step", [7e-6, 3e-4, 2.5e-3])
def test_steps_have_the_whole_impulse(core, step):
    """The means over all steps add up to 2 F tau/pi of each half sine, however the steps lie, and whatever they skip."""
    F, tau, count = 1401.0, 1e-3, 3
    pulses = {"pulse.F_r": F, "pulse.F_a": 0.5 * F, "pulse.t_start": 1e-3, "pulse.duration": tau, "pulse.count": count}
    model, trajectory = core.model(parameters=pulses), core.new("InputTrajectory")
    total = np.zeros(2)
    for n in range(int(0.02 / step) + 1):
        trajectory.pulse_r = trajectory.pulse_a = 0.0
        core.lib.pulse_average(model.p, (n + 0.5) * step, 0.5 * step, trajectory)
        total += step * np.array([trajectory.pulse_r, trajectory.pulse_a])
    assert total == pytest.approx(count * 2.0 * F * tau / np.pi * np.array([1.0, 0.5]), rel=1e-9)


FREE = {"ring.m": 50.0, "ring.c": 0.0, "bearing.P_d": 6e-4, "solver.step": 1e-5}  # a ring that meets no ball


def test_the_ring_feels_the_impulse(core):
    """A pulse much shorter than a step moves a ring without balls' load by its impulse: m v = 2 F tau/pi."""
    F, tau = 1000.0, 1e-6
    pulse = {"pulse.F_r": F, "pulse.duration": tau, "pulse.t_start": 3.03e-4, "pulse.count": 1}
    bearing = Instance(core, FIXED | SMOOTH | FREE | pulse, {"shaft.F_y": 0.0, "shaft.F_x": 0.0})
    for n in range(1, 6):
        bearing.step(n * 1e-4)
    speed = np.hypot(bearing.output("ring.v_y"), bearing.output("ring.v_z"))
    assert speed == pytest.approx(2.0 * F * tau / np.pi / FREE["ring.m"], rel=1e-6)


@pytest.mark.parametrize("step", [5e-6, 1e-5])
def test_a_load_that_jumps_grows_over_one_step(core, step):
    """One evaluation a step: the trapezoidal rule has the old load at the start of the step after a jump and the new
    one at its end, half a step late.
    """
    F, t = 100.0, 2e-4
    bearing = Instance(core, FIXED | SMOOTH | FREE | {"solver.step": step}, {"shaft.F_y": 0.0, "shaft.F_x": 0.0})
    bearing.set(**{"shaft.F_y": F})
    for n in (1, 2):
        bearing.step(n * 0.5 * t)
    assert bearing.output("ring.v_y") == pytest.approx(F / FREE["ring.m"] * (t - 0.5 * step), rel=1e-9)


def test_a_step_out_of_its_limits_is_refused_by_name(core):
    with pytest.raises(ValueError, match="solver.step = 0.002 s is not allowed"):
        Instance(core, FIXED | {"solver.step": 2e-3})


def test_the_host_runs_the_unit_against_the_clock(fmu, tmp_path):
    """examples/real_time/host.c, as its head says to compile and start it."""
    compiler = shutil.which("cc")
    if compiler is None:
        pytest.skip("no C compiler")
    zipfile.ZipFile(fmu).extractall(tmp_path / "unit")
    command = [compiler, "-O2", f"-I{Path(fmpy.__file__).parent / 'c-code'}", ROOT / "examples/real_time/host.c"]
    subprocess.run([*map(str, command), "-ldl", "-lm", "-o", str(tmp_path / "host")], check=True)
    options = ["--step", "1e-3", "--seconds", "0.2", "--set", "solver.method=3", "--set", "scene.cage=1"]
    done = subprocess.run(
        [str(tmp_path / "host"), str(tmp_path / "unit"), *options],
        capture_output=True, text=True, timeout=60, check=False, env=os.environ,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert len(re.findall(r": 200 steps, mean", done.stdout)) == 2, done.stdout
    assert Z == 9
    asked = subprocess.run([str(tmp_path / "host"), "--help"], capture_output=True, text=True, timeout=60, check=False)
    assert asked.returncode == 0 and asked.stdout.startswith("usage: host FOLDER") and not asked.stderr


@pytest.mark.parametrize("tilt", [0.0, 8.7e-3])
def test_steps_whose_results_are_wrong_are_an_event(core, tilt, record_property):
    """A tilt of 0.5 degrees presses the cage onto its lands.  Steps of 10 us miss the largest pocket force there by 40 % and say
    so; without tilt they are right and silent.  The derived length is shorter where it has to be, and silent.
    """
    seen = {}
    for step in (1e-5, 0.0):
        bearing = Instance(core, FIXED | {"scene.cage": CageModel.ELASTIC, "solver.step": step}, {"shaft.tilt_z": tilt})
        for n in range(1, 201):
            bearing.step(n * 1e-4)
        told = [text for text in bearing.messages if "set solver.step to" in text]
        onsets = bearing.output("event.step_too_long_onsets")
        assert bool(told) == bool(onsets)
        seen[step] = onsets, bearing.output("solver.step_size")
    record_property("seen", {str(step): value for step, value in seen.items()})
    assert (seen[1e-5][0] > 0.0) == (tilt > 0.0)
    assert seen[0.0][0] == 0.0
    assert seen[0.0][1] < (4e-6 if tilt > 0.0 else 6.8e-6)  # observed 2.6 and 5.0 us


def test_films_in_the_substeps_bear_long_steps(core, record_property):
    """Balls that jam press the halves' rims onto their films, which allow 0.3 us.  Steps of 10 us against Runge-Kutta at
    1e-5 from 10 to 20 ms: force in the pockets and stress of the heads, means and the 99.9 % quantile.  Films by impulses
    at both ends of a step miss the quantile by 3.3 % and the force by 0.7 %.
    """
    jam = {
        "scene.cage": CageModel.ELASTIC, "scene.statistics": Switch.ON, "start.settle": 0.01,
        "scene.lubrication": Lubrication.MIXED, "ring.tilt_mode": TiltMode.SUPPORTED, "ring.k_tilt": 500.0,
        "cage.pocket_clearance": 1e-4,
    }  # fmt: skip
    methods = {"solver.method": Method.EXPLICIT}, FIXED | {"solver.step": 1e-5}
    found = []
    for method, tolerance in zip(methods, (1e-5, 0.0), strict=True):
        bearing = Instance(core, jam | method, {"shaft.omega": 4000.0 * np.pi / 30.0}, tolerance=tolerance).step(0.02)
        found.append([bearing.output(f"stat.{name}") for name in ("Q_c_mean", "sigma_head_mean", "sigma_head_p999")])
    error = np.array(found[1]) / found[0] - 1.0
    record_property("error", error.tolist())
    assert np.all(np.abs(error) < [0.002, 0.01, 0.03])  # observed 1e-4, 2e-3, 2.1e-2


@pytest.mark.parametrize("method", Method)
@pytest.mark.parametrize("cage", CageModel)
def test_outputs_of_a_restored_state(core, cage, method):
    """All outputs are those from before the step that is taken back, bit for bit.  A new evaluation at the end of an equal step
    has other velocities: by it loads differed by up to 5 %.
    """
    scene = {"scene.cage": cage, "solver.method": method, "cage.pocket_filling": 1.0}
    bearing = Instance(core, scene, {"shaft.omega": 800.0, "shaft.F_y": -2000.0, "shaft.tilt_y": 2e-3}).step(5e-3)
    saved = core.new("InstanceState")
    bearing.lib.part_save(bearing.bearing, saved)
    before = {name: np.copy(bearing.output(name)) for name in OUTPUTS if name != "solver.cpu_time"}
    bearing.step(5.1e-3)
    bearing.lib.part_restore(bearing.bearing, saved)
    assert [name for name, value in before.items() if not np.array_equal(value, bearing.output(name))] == []


def test_errors_beyond_the_tolerance_are_counted(core):
    """No step is refused, but solver.error_tests_failed counts those that the default method would refuse."""
    share = []
    for step in (1e-5, 4e-6):
        bearing = Instance(core, FIXED | {"scene.cage": CageModel.ELASTIC, "solver.step": step})
        for n in range(1, 51):
            bearing.step(n * 1e-4)
        share.append(bearing.output("solver.error_tests_failed") / bearing.output("solver.steps"))
    assert share[0] > 0.003 > 0.0015 > share[1]  # 0.6 and 0.08 % of the steps at the working point
