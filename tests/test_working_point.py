"""The FMU as a bearing: the paper's working point against the equilibrium of the books, statistics against a
prototype's, and the range it must stand.

The prototype: a separate program for the same equations, written before this one and not kept here; its numbers stand
where they are used. Observed values: FMU at its default tolerance, seeds 1 and 2.
"""

import math
from functools import cache

import fmpy
import numpy as np
import pytest
from library import TWO_HALF
from mechanics import Instance, View, Z, pocket_contact
from scipy.spatial.transform import Rotation

from bearing_model.generated.variables import (
    PARAMETERS,
    CageModel,
    Drag,
    Lubrication,
    Method,
    Stress,
    Switch,
    TiltMode,
    Traction,
)
from bearing_model.kinematics import cage_speed
from bearing_model.physics.parameters import Parameters
from bearing_model.physics.ring_fit import ring_fit_of
from bearing_model.quasi_static import Bearing, Load, quasi_static

RPM = math.pi / 30.0
OMEGA = 18238 * RPM
GROWN = ring_fit_of(Parameters())  # the inner ring's growth
SETTLE = 0.05
STATISTICS = {"scene.statistics": int(Switch.ON), "scene.stress": int(Stress.OFF)}
PASS = 2.0 * math.pi / (Z * 756.6)  # one ball takes the place of the next [s]


@pytest.fixture(scope="module")
def simulate(fmu, tmp_path_factory):
    """simulate(t_end, step, outputs, start values) -> recorded outputs after SETTLE; the FMU is unzipped once."""
    folder = fmpy.extract(str(fmu), str(tmp_path_factory.mktemp("fmu")))
    description = fmpy.read_model_description(folder)

    def run(t_end, step, outputs, settle=SETTLE, **start):
        values = {name.replace("__", "."): value for name, value in start.items()}
        result = fmpy.simulate_fmu(
            folder,
            stop_time=t_end,
            step_size=step,
            output_interval=step,
            start_values=values,
            output=outputs,
            model_description=description,
        )
        assert result["time"][-1] == pytest.approx(t_end, rel=1e-9)
        assert all(np.isfinite(result[name]).all() for name in result.dtype.names)
        return result[result["time"] >= settle]

    return run


@cache
def equilibrium(fit=GROWN):
    """Means over one ball pass of ring displacement and, at its worst azimuth, the largest ball load; fit: RingFit,
    None for a ring that keeps its size.
    """
    load = Load(F_x=515.0, F_y=2994.0, omega=OMEGA)
    results = [quasi_static(Bearing(fit=fit), load, psi=psi) for psi in np.arange(12) * 2.0 * np.pi / Z / 12]
    return {
        "x": np.mean([r.x for r in results]),
        "y": np.mean([r.y for r in results]),
        "Q_i": max(r.Q_i.max() for r in results),
    }


@pytest.fixture(scope="module")
def working_point(simulate):
    """0.25 s at the working point, steps of 1e-4 s, from settled motion on.  Rigid halves, whose walls keep their
    place. Traction at a point: spin in the contacts takes 7 N of the axial load.
    """
    balls = [
        f"ball[{j}].{name}" for j in range(1, Z + 1) for name in ("Q_i", "alpha_i", "Q_c", "x", "r", "psi", "omega_m")
    ]
    names = [
        "ring.x",
        "ring.y",
        "ring.z",
        "cage.omega",
        "cage.eccentricity",
        "housing.F_x",
        "housing.F_y",
        "housing.F_z",
        *balls,
    ]
    names += [f"half_{h}.{name}" for h in (0, 1) for name in ("x", "y", "z", "tilt_y", "tilt_z", "psi")]
    return simulate(0.25, 1e-4, names, **TWO_HALF, **{"scene.traction": int(Traction.POINT)})


def test_reference_numbers():
    """The equilibrium itself, of a ring that keeps its size: 56.3 and 30.35 um, 1543 N."""
    reference = equilibrium(None)
    assert reference["x"] == pytest.approx(56.30e-6, rel=1e-3)
    assert reference["y"] == pytest.approx(30.35e-6, rel=1e-3)
    assert reference["Q_i"] == pytest.approx(1543.0, rel=1e-3)


def test_ring_displacement(working_point):
    """Within 2 % of the static and centrifugal equilibrium; observed x -0.23 %, y +0.35 % (traction and the cage act
    too).
    """
    assert working_point["ring.x"].mean() == pytest.approx(equilibrium()["x"], rel=0.02)
    assert working_point["ring.y"].mean() == pytest.approx(equilibrium()["y"], rel=0.02)


def test_clearance_moves_the_ring(simulate):
    """Clearance acts in the running geometry, not only at the start (a known failure of another code): from P_d = 5 to
    40 um the mean radial and axial displacements of a running ring follow the equilibrium's within 3 % each; observed
    -0.3 ... +0.5 %.
    """
    means = {}
    for P_d in (5e-6, 15e-6, 40e-6):
        run = simulate(0.05, 1e-4, ["ring.x", "ring.y"], settle=0.02, bearing__P_d=P_d)
        load, angles = Load(F_x=515.0, F_y=2994.0, omega=OMEGA), np.arange(6) * 2.0 * np.pi / Z / 6
        rest = [quasi_static(Bearing(P_d=P_d, fit=GROWN), load, psi=psi) for psi in angles]
        means[P_d] = run["ring.x"].mean(), run["ring.y"].mean()
        assert means[P_d] == pytest.approx((np.mean([r.x for r in rest]), np.mean([r.y for r in rest])), rel=0.03)
    y = [y for _, y in means.values()]
    # P_d/2 of rigid parts, more because fewer balls carry; observed 5.7 and 14.2 um
    assert y[1] - y[0] > 5e-6 and y[2] - y[1] > 12.5e-6


def test_housing_carries_the_load(working_point):
    """Mean reaction = load within 0.5 %; momentum of ring and cage over 0.2 s leaves less than 1 N."""
    housing = [working_point[f"housing.F_{i}"].mean() for i in "xyz"]
    assert housing[0] == pytest.approx(515.0, rel=5e-3)
    assert housing[1] == pytest.approx(2994.0, rel=5e-3)
    assert abs(housing[2]) < 5e-3 * 2994.0


def test_axial_contact_loads(working_point):
    """Sum of Q_i sin(alpha_i) = F_x: traction carries less than 0.5 % of it in the mean; observed -0.13 %."""
    axial = sum(working_point[f"ball[{j}].Q_i"] * np.sin(working_point[f"ball[{j}].alpha_i"]) for j in range(1, Z + 1))
    assert axial.mean() == pytest.approx(515.0, rel=5e-3)


def test_largest_ball_load(working_point):
    """Largest load of any ball in each ball pass, averaged: within 5 % of the equilibrium's largest; observed +0.6 %."""
    loads = np.max([working_point[f"ball[{j}].Q_i"] for j in range(1, Z + 1)], axis=0)
    samples = round(PASS / 1e-4)
    passes = loads[: len(loads) // samples * samples].reshape(-1, samples).max(axis=1)
    assert passes.mean() == pytest.approx(equilibrium()["Q_i"], rel=0.05)


def test_cage_speed(working_point):
    """Epicyclic within 2 %: a cage that stands fails.  Observed -0.28 %."""
    epicyclic = cage_speed(OMEGA, 0.0111125, 0.0535)
    assert epicyclic == pytest.approx(756.6, rel=1e-4)
    assert working_point["cage.omega"].mean() == pytest.approx(epicyclic, rel=0.02)


def of_balls(run, name):
    """One output of all balls, [time, ball]."""
    return np.column_stack([run[f"ball[{j}].{name}"] for j in range(1, Z + 1)])


def test_azimuths_are_the_integral_of_the_orbital_speeds(simulate):
    """Trapezoidal rule over 5 ms and half a turn at 1e-5 s, which resolves impacts of 70 us; 2e-5 rad is 0.5 um at the
    pitch circle.  Observed 8e-7."""
    run = simulate(
        5e-3, 1e-5, [f"ball[{j}].{name}" for j in range(1, Z + 1) for name in ("psi", "omega_m")], settle=0.0
    )
    psi = of_balls(run, "psi")
    turned = np.trapezoid(of_balls(run, "omega_m"), run["time"], axis=0)
    assert np.all(turned > 3.0)
    assert psi[-1] - psi[0] == pytest.approx(turned, abs=2e-5)


def test_ball_positions_carry_the_load(working_point):
    """Radial parts of the inner contact loads at the balls' azimuths add up to the radial load, mean of 0.2 s: within
    0.5 %, +0.08 % observed.
    """
    radial = of_balls(working_point, "Q_i") * np.cos(of_balls(working_point, "alpha_i"))
    psi = of_balls(working_point, "psi")
    assert np.sum(radial * np.cos(psi), axis=1).mean() == pytest.approx(2994.0, rel=5e-3)
    assert np.sum(radial * np.sin(psi), axis=1).mean() == pytest.approx(0.0, abs=15.0)


def test_pocket_forces_follow_from_the_positions(working_point):
    """A pocket is a cylinder with a radial axis, cut in two: a ball presses exactly where it is farther from the axis
    of a half than half the clearance and its Hertz patch reaches over the wall of that half.

    A half is turned by psi about its axis e_x, then tilted from e_x to (a_x, tilt_z, -tilt_y) on the shortest way.  The
    split plane needs the exact tilt: the square of a tilt of 2e-3 moves a ball by 0.1 um, and the point on the wall by
    R_c/S = 57 times that.  Left open is the rounding only; observed at four seeds: no ball of 72,036 differs.
    """
    x, r, psi, pressed = (of_balls(working_point, name) for name in ("x", "r", "psi", "Q_c"))
    touching, clear = np.zeros_like(x, dtype=bool), np.ones_like(x, dtype=bool)
    contact, R_c = pocket_contact(), 0.5 * 0.0111125 + 1e-4
    for h in (0, 1):
        half = {name: working_point[f"half_{h}.{name}"] for name in ("x", "y", "z", "tilt_y", "tilt_z", "psi")}
        tilt = Rotation.from_rotvec(turning_e_x_to(half["tilt_z"], -half["tilt_y"]))
        for j in range(Z):
            azimuth = half["psi"] + 2.0 * math.pi * j / Z
            axis = tilt.apply([1.0, 0.0, 0.0])
            tangent = tilt.apply(np.column_stack([np.zeros_like(azimuth), -np.sin(azimuth), np.cos(azimuth)]))
            ball = np.column_stack(
                [x[:, j] - half["x"], r[:, j] * np.cos(psi[:, j]) - half["y"], r[:, j] * np.sin(psi[:, j]) - half["z"]]
            )
            along_axis, across = np.sum(ball * axis, axis=1), np.sum(ball * tangent, axis=1)
            distance = np.hypot(along_axis, across)
            depth = distance - 1e-4
            # of the patch, past the split plane
            reach = (2 * h - 1) * along_axis / distance * R_c + contact.semi_axes(contact.load(depth))[0]
            touching[:, j] |= (depth > 0.0) & (reach > 0.0)
            clear[:, j] &= (np.abs(depth) > 1e-12) & ((depth < 0.0) | (np.abs(reach) > 1e-9))
    assert np.mean(clear) > 0.999
    assert np.mean(pressed > 0.0) > 0.02
    np.testing.assert_array_equal(pressed[clear] > 0.0, touching[clear])


def turning_e_x_to(a_y, a_z):
    """Rotation vectors of the shortest turn of e_x to the unit vector with these components across it (n x 3) [rad]."""
    sine = np.hypot(a_y, a_z)
    angle = np.arcsin(sine) / np.maximum(sine, 1e-300)
    return np.column_stack([np.zeros_like(sine), -a_z * angle, a_y * angle])


def test_contact_loads_on_the_ring(core):
    """Vector sum of all normal loads on the ring against the load, mean of 20 ms: within 0.5 %.  At a point: spin takes
    7 N of the axial load.
    """
    point = {"scene.traction": int(Traction.POINT)}
    bearing, model = Instance(core, point), core.model(parameters=point)
    w = View(core, model.work)
    bearing.step(SETTLE)
    total, n = np.zeros(3), 1000
    for i in range(n):
        bearing.step(SETTLE + (i + 1) * 22 * PASS / n)
        model.rhs(bearing.time, bearing.y)
        c, s = w.cos_theta[:Z], w.sin_theta[:Z]
        Q, n_x, n_r, n_t = w.Q_i[:Z], w.n_ix[:Z], w.n_ir[:Z], w.n_it[:Z]
        # on the ring: + Q n
        total += [np.sum(Q * n_x), np.sum(Q * (n_r * c - n_t * s)), np.sum(Q * (n_r * s + n_t * c))]
    assert -total[:2] / n == pytest.approx([515.0, 2994.0], rel=5e-3)
    assert abs(total[2] / n) < 5e-3 * 2994.0


def test_no_friction_no_sideways_drift(simulate):
    """Without friction nothing pushes the ring across the load: mean of z below 0.1 um; observed 0.083 um, 0.027 um
    with pockets so wide that hardly a ball touches: what remains is the loss in pockets and damping.  Rigid halves:
    vibrations that lose energy take it from the balls (0.116 um).
    """
    smooth = dict.fromkeys(("oil.A", "oil.B", "oil.mu_b", "oil.rolling", "oil.rho_mix", "cage.mu", "cage.mu_land"), 0.0)
    result = simulate(0.15, 1e-4, ["ring.y", "ring.z"], **smooth, **TWO_HALF, **{"oil.eta": 1e-5})
    assert abs(result["ring.z"].mean()) < 1e-7
    assert result["ring.y"].mean() == pytest.approx(equilibrium()["y"], rel=0.02)


# ----------------------------------------------------------------------------------------------------------- statistics

# what the prototype has: rigid halves,
# traction at a point, isolated balls in a mixture at rest, no churning, no shear heating, flooded inlets, no inlet
# friction
FRICTION = TWO_HALF | {
    "scene.traction": int(Traction.POINT),
    "scene.drag": int(Drag.ISOLATED),
    "scene.churning": int(Switch.OFF),
    "scene.heating": int(Switch.OFF),
    "oil.K_rs": 0.0,
    "oil.rolling": 0.0,
}
# mean and RMS of the pocket force [N]
PROTOTYPE = {"Q_c_mean": 0.655, "Q_c_rms": 4.73, "contact_duty": 0.087, "eccentricity": 0.88}


@pytest.fixture(scope="module")
def statistics(simulate):
    """stat.* of the prototype's setting: no horizontal film force and the ellipse's ratio in F_R there, so without
    inlet friction here.
    """
    names = [f"stat.{name}" for name in (*PROTOTYPE, "Q_c_p999", "Q_c_max", "cage_omega", "time")]
    runs = [simulate(0.4, 1e-3, names, settle=0.4, **STATISTICS, **FRICTION, **{"start.seed": seed}) for seed in (1, 2)]
    return {name.removeprefix("stat."): np.mean([run[name][-1] for run in runs]) for name in names}


@pytest.mark.parametrize("name", PROTOTYPE)
def test_statistics_near_the_prototype(statistics, name):
    """Within 25 % over 0.35 s and two seeds; observed +9, -1, 0, -3 %."""
    assert statistics["time"] == pytest.approx(0.35, rel=1e-3)
    assert statistics[name] == pytest.approx(PROTOTYPE[name], rel=0.25)


def test_free_cage_would_be_seen(simulate):
    """The bands above are narrow enough: duty 2 % with a cage that is hardly touched."""
    free = {"cage.pocket_clearance": 2.6e-3, "cage.width": 14.8e-3}
    run = simulate(0.2, 1e-3, ["stat.contact_duty"], settle=0.2, **STATISTICS, **FRICTION, **free)
    assert abs(run["stat.contact_duty"][-1] / PROTOTYPE["contact_duty"] - 1.0) > 0.25


def test_extremes_near_the_prototype(core):
    """The prototype's p99.9 = 117 N and maximum 160 N are of the largest pocket force at each instant, sampled every 4
    us: their ratio 0.73 is ours of that quantity (0.74), not of all balls pooled (0.54).  Observed -19 % and -22 %; the
    cause is not isolated (pocket damping 0 gives 110 N, a rigid cage 117 N).
    """
    pooled, largest = [], []
    for seed in (1, 2):
        bearing = Instance(core, STATISTICS | FRICTION | {"start.seed": seed})
        bearing.step(SETTLE)
        loads = []
        for i in range(50_000):
            bearing.step(SETTLE + (i + 1) * 4e-6)
            loads.append(bearing.output("cage.F_pocket_max"))
        largest += loads
        pooled.append(bearing.output("stat.Q_c_p999"))
    assert np.quantile(largest, 0.999) == pytest.approx(117.0, rel=0.25)
    assert max(largest) == pytest.approx(160.0, rel=0.3)
    assert np.mean(pooled) < 0.85 * np.quantile(largest, 0.999)


# -------------------------------------------------------------------------------------------------- communication steps


def pooled(simulate, step, seeds, t_end, **start):
    """Mean over seeds of stat.* at the end."""
    names = [
        f"stat.{name}" for name in ("Q_c_mean", "Q_c_rms", "Q_c_p999", "contact_duty", "eccentricity", "cage_omega")
    ]
    runs = [
        simulate(t_end, step, names, settle=t_end * (1 - 1e-9), **STATISTICS, **{"start.seed": seed}, **start)
        for seed in seeds
    ]
    return {name: np.mean([run[name][-1] for run in runs]) for name in names}


# of one seed, 0.4 s; contact_duty by 72 seeds
SCATTER = {
    "Q_c_mean": 0.007,
    "Q_c_rms": 0.006,
    "Q_c_p999": 0.014,
    "contact_duty": 0.013,
    "eccentricity": 0.003,
    "cage_omega": 1e-4,
}


@pytest.mark.slow
@pytest.mark.parametrize("step", [1e-6, 1e-5, 1e-3, 1e-2])
def test_communication_step_changes_no_statistics(simulate, step):
    """Four seeds over 0.4 s against steps of 1e-4 s: differences within 4 standard errors of both ensembles."""
    seeds = (1, 2, 3, 4)
    reference, other = pooled(simulate, 1e-4, seeds, 0.4), pooled(simulate, step, seeds, 0.4)
    for name, scatter in SCATTER.items():
        assert other[f"stat.{name}"] == pytest.approx(
            reference[f"stat.{name}"], rel=4.0 * scatter * math.sqrt(2 / len(seeds))
        )


def test_communication_step_over_a_millisecond(simulate):
    """Before chaos: ring, cage and ball loads after 1 ms agree to the integrator's error whatever the step: places to
    tolerance times 10 um, of the cage twice that, loads to what that length is in the stiffest contact (1e8 N/m).
    """
    names = ["ring.x", "ring.y", "cage.y", "cage.z", "ball[1].Q_i", "cage.omega"]
    ends = [simulate(1e-3, step, names, settle=0.0)[-1] for step in (1e-6, 1e-5, 1e-4, 1e-3)]
    for end in ends[1:]:
        for name, bound in zip(names, (1e-8, 1e-8, 2e-8, 2e-8, 1.0, 1e-2), strict=True):
            assert end[name] == pytest.approx(ends[0][name], abs=bound), name


# ---------------------------------------------------------------------------------------------------------------- range

RANGE = {
    "speed": (2000.0, 24000.0),
    "F_r": (0.0, 6000.0),
    "F_a": (0.0, 1500.0),
    "tilt": (0.0, 0.5),
    "preload": (0.0, 100.0),
    "fit": (-9e-5, 4e-5),
}
CORNERS = [
    {"speed": 2000.0, "F_r": 6000.0, "F_a": 1500.0, "tilt": 0.5, "preload": 0.0, "fit": -9e-5},
    {"speed": 24000.0, "F_r": 6000.0, "F_a": 1500.0, "tilt": 0.5, "preload": 100.0, "fit": 4e-5},
    {"speed": 24000.0, "F_r": 0.0, "F_a": 0.0, "tilt": 0.0, "preload": 0.0, "fit": -9e-5},
    {"speed": 2000.0, "F_r": 0.0, "F_a": 0.0, "tilt": 0.0, "preload": 20.0, "fit": 4e-5},
    {"speed": 24000.0, "F_r": 0.0, "F_a": 1500.0, "tilt": 0.5, "preload": 0.0, "fit": 4e-5},
    {"speed": 24000.0, "F_r": 6000.0, "F_a": 0.0, "tilt": 0.0, "preload": 100.0, "fit": -9e-5},
]


def settings(case, **scene):
    """Start values of the FMU for a case of the range."""
    return {
        "shaft.omega": case["speed"] * RPM,
        "shaft.F_y": case["F_r"],
        "shaft.F_x": case["F_a"],
        "shaft.tilt_z": math.radians(case["tilt"]),
        "joint.preload": case["preload"],
        "joint.fit": case["fit"],
    } | scene


def check_run(simulate, case, t_end, **scene):
    """The run ends, its numbers are finite, its energy balance closes and the ring stays in the bearing.

    The balance is off by the work's integral, of powers at predicted velocities, which falls at least with the
    tolerance: observed 7.2 % of the energy lost at 1e-3 (2,000 r/min, tilted, joints without preload that rub at 16
    kHz; the loss itself is off by 1 %), 0.7 % at 3e-4 and 0.05 % at 1e-4.

    A rim that bends lets its land go on: at 0.42 deg of tilt an oval of 66 um has an eccentricity of 1.5 clearances with 7 N of dry contact.
    """
    names = [
        "bearing.energy_residual",
        "bearing.power_loss",
        "bearing.penetration",
        "ring.x",
        "ring.y",
        "cage.eccentricity",
        "cage.dislocation",
    ]
    result = simulate(t_end, 1e-4, names, settle=0.0, **settings(case, **scene))
    dissipated = np.sum(np.abs(result["bearing.power_loss"])) * 1e-4
    assert (
        abs(result["bearing.energy_residual"][-1])
        < 100.0 * scene.get("solver.tol", PARAMETERS["solver.tol"].start) * dissipated + 1e-4
    )
    assert result["bearing.penetration"].max() < 2e-4
    assert np.abs(result["ring.x"]).max() < 5e-4 and np.abs(result["ring.y"]).max() < 5e-4
    assert result["cage.eccentricity"].max() < (1.5 if scene.get("scene.cage") == CageModel.TWO_HALF else 2.0)
    assert result["cage.dislocation"].max() < 1.5e-4


@pytest.mark.parametrize(
    "case",
    CORNERS,
    ids=[f"{c['speed']:.0f}-{c['F_r']:.0f}-{c['F_a']:.0f}-{c['tilt']}-{c['preload']:.0f}" for c in CORNERS],
)
def test_corners_of_the_range(simulate, case):
    """20 ms in six corners, mixed lubrication in every second one."""
    lubrication = Lubrication.MIXED if CORNERS.index(case) % 2 else Lubrication.FILM
    check_run(simulate, case, 0.02, **{"scene.lubrication": int(lubrication), "solver.tol": 1e-4})


def sample(n, seed):
    """Random settings: a latin hypercube over the range, and scenes."""
    rng = np.random.default_rng(seed)
    strata = {name: (rng.permutation(n) + rng.uniform(size=n)) / n for name in RANGE}
    cases = [{name: low + (high - low) * strata[name][i] for name, (low, high) in RANGE.items()} for i in range(n)]
    return [
        (
            case,
            {
                "scene.lubrication": int(rng.choice(Lubrication)),
                "scene.cage": int(rng.choice(CageModel, p=[0.7, 0.3])),
                "ring.tilt_mode": int(rng.choice([TiltMode.PRESCRIBED, TiltMode.SUPPORTED])),
                "cage.pocket_clearance": float(rng.choice([1e-4, 2e-4])),
            },
        )
        for case in cases
    ]


LONG = [(case, {}) for case in CORNERS] + sample(30, 20)


@pytest.mark.slow
@pytest.mark.parametrize(("case", "scene"), LONG, ids=range(len(LONG)))
def test_long_runs_over_the_range(simulate, case, scene):
    """0.4 s without failure: the six corners and 30 random settings."""
    check_run(simulate, case, 0.4, **scene)


@pytest.mark.slow
def test_methods_agree_in_statistics(simulate):
    """Verlet at the default tolerance against Runge-Kutta at 1e-4: the same ensemble within its scatter."""
    seeds = (1, 2, 3, 4)
    reference, default = (
        pooled(simulate, 1e-4, seeds, 0.4, **{"solver.method": int(Method.EXPLICIT)}),
        pooled(simulate, 1e-3, seeds, 0.4),
    )
    for name, scatter in SCATTER.items():
        assert default[f"stat.{name}"] == pytest.approx(
            reference[f"stat.{name}"], rel=4.0 * scatter * math.sqrt(2 / len(seeds))
        )
