"""The quasi-static start against the independent equilibrium of bearing_model.quasi_static, and its kinematics."""

import math

import numpy as np
import pytest
from mechanics import SLICE, Instance, View, Z, pocket_loads

from bearing_model.generated.variables import PARAMETERS, TiltMode
from bearing_model.kinematics import cage_speed
from bearing_model.physics.parameters import Parameters
from bearing_model.physics.ring_fit import ring_fit_of
from bearing_model.quasi_static import Bearing, Load, quasi_static

TWINS = True
RPM = math.pi / 30.0
CASES = {
    "working point": ({}, Load(F_x=515.0, F_y=2994.0, omega=18238 * RPM)),
    "pure axial": ({}, Load(F_x=800.0, omega=10000 * RPM)),
    "pure radial": ({}, Load(F_y=-2000.0, F_z=1500.0, omega=4000 * RPM)),
    "standstill": ({}, Load(F_x=515.0, F_y=2994.0)),
    "backwards": ({}, Load(F_x=-515.0, F_z=2994.0, omega=-18238 * RPM)),
    "prescribed tilt": (
        {},
        Load(F_x=515.0, F_y=2994.0, omega=18238 * RPM, tilt_z=math.radians(0.25), tilt_y=math.radians(-0.1)),
    ),
    "supported tilt": (
        {"ring.tilt_mode": TiltMode.SUPPORTED, "ring.k_tilt": 2e4},
        Load(F_x=515.0, F_y=2994.0, omega=18238 * RPM, tilt_z=math.radians(0.15), M_y=3.0, k_tilt=2e4),
    ),
    "free tilt": (
        {"ring.tilt_mode": TiltMode.FREE},
        Load(F_x=1500.0, F_y=2994.0, omega=18238 * RPM, M_z=2.0, k_tilt=0.0),
    ),
    "heavy": ({}, Load(F_x=1500.0, F_y=6000.0, omega=24000 * RPM)),
    "preloaded": ({"bearing.P_d": -5e-6}, Load(F_y=100.0, omega=18238 * RPM)),
}


def start(core, parameters, load):
    """Model, state and residual force of the start with exactly even balls."""
    inputs = {f"shaft.{name}": getattr(load, name) for name in ("F_x", "F_y", "F_z", "M_y", "M_z", "omega")}
    angle = math.hypot(load.tilt_y, load.tilt_z)
    scale = math.asin(angle) / angle if angle else 1.0  # the reference's tilt is a direction cosine
    inputs |= {"shaft.tilt_y": load.tilt_y * scale, "shaft.tilt_z": load.tilt_z * scale}
    model = core.model(parameters={"start.spacing": 0.0} | parameters, inputs=inputs)
    return model, *model.solve_start()


@pytest.mark.parametrize("case", CASES)
def test_equilibrium(core, case):
    """Place and tilt of the ring, ball loads and contact angles.

    The start holds the centrifugal force at the pitch radius and epicyclic speed and adds springs of 1 kN/m; the
    reference lets the speed follow the contact angles.  Bounds: 0.05 um, 3e-6 rad, 0.3 % of the largest load; observed
    0.02 um, 1e-6 rad, 0.1 %.
    """
    parameters, load = CASES[case]
    reference = quasi_static(Bearing(P_d=parameters.get("bearing.P_d", 15e-6), fit=ring_fit_of(Parameters())), load)
    model, y, residual = start(core, parameters, load)
    w = View(core, model.work)
    assert residual < 1e-6 * (abs(load.F_x) + abs(load.F_y) + abs(load.F_z) + 1.0)
    place = [y[SLICE[f"ring_{i}"]][0] for i in "xyz"]
    assert place == pytest.approx([reference.x, reference.y, reference.z], abs=5e-8)
    tilt = [y[SLICE["ring_beta"]][0], y[SLICE["ring_gamma"]][0]]
    assert tilt == pytest.approx([reference.tilt_y, reference.tilt_z], abs=3e-6)
    most = max(reference.Q_e.max(), 1.0)
    assert w.Q_i[:Z] == pytest.approx(reference.Q_i, abs=3e-3 * most)
    assert w.Q_e[:Z] == pytest.approx(reference.Q_e, abs=3e-3 * most)
    loaded = reference.Q_i > 0.05 * most
    alpha = np.arctan2(-w.n_ix[:Z], -w.n_ir[:Z])
    assert alpha[loaded] == pytest.approx(reference.alpha_i[loaded], abs=2e-3)
    assert loaded.any()


def test_forces_balance_at_the_start(core):
    """At rest in the rotating frame ring and balls have no acceleration without friction and damping."""
    inputs = {"shaft.F_x": 515.0, "shaft.F_y": 2994.0}
    smooth = {"oil.A": 0.0, "oil.B": 0.0, "oil.rolling": 0.0, "start.spacing": 0.0, "bearing.lambda": 0.0}
    model = core.model(parameters=smooth, inputs=inputs)
    y = model.start()
    rate = model.rhs(0.0, y)
    # the springs of 1 kN/m, ring displaced by 56 um
    assert np.abs(rate[SLICE["ring_v_x"].start :][:3]).max() < 1e3 * 60e-6 / 0.6
    omega_m = y[SLICE["ball_omega_m"]]
    # the start takes d_m/2 omega_0^2, the ball r omega_m^2: cos(alpha) of the mean load makes 3 %
    assert np.abs(rate[SLICE["ball_v_r"]]).max() < 0.05 * 0.02675 * omega_m[0] ** 2
    assert np.abs(rate[SLICE["ball_v_x"]]).max() < 10.0  # the spring of 1 kN/m that holds loose balls, over 5.6 g


def test_kinematic_speeds(core):
    """Balls orbit at the epicyclic speed of their contact angle and roll on the outer race without slip; the cage goes
    with them.
    """
    model, y, _ = start(core, {}, CASES["working point"][1])
    omega = 18238 * RPM
    w = View(core, model.work)
    speed = y[SLICE["ball_omega_m"]]
    alpha = np.arctan2(-w.n_ix[:Z], -w.n_ir[:Z])
    weights = w.Q_i[:Z]
    assert speed == pytest.approx(
        np.full(Z, np.average([cage_speed(omega, 0.0111125, 0.0535, a) for a in alpha], weights=weights)), rel=1e-6
    )
    r, R = y[SLICE["ball_r"]], 0.0111125 / 2
    n_x, n_r = w.n_ex[:Z], w.n_er[:Z]
    rolling = R * (y[SLICE["ball_omega_x"]] * n_r - y[SLICE["ball_omega_r"]] * n_x)
    assert rolling == pytest.approx(-r * speed, rel=1e-12)
    spin = y[SLICE["ball_omega_x"]] * n_x + y[SLICE["ball_omega_r"]] * n_r
    assert np.abs(spin).max() < 1e-9 * omega
    assert y[SLICE["cage_s"]] == pytest.approx([speed[0]] * 2, rel=1e-14)


def test_cage_stands_where_the_balls_are(core):
    """Centred on X, in the plane that fits the balls' axial places best (least squares of three numbers), turning about
    its own axis without wobble.

    The start takes means over the azimuth in place of the fit: radii differ by 1e-4.
    """
    model, y, _ = start(core, {}, Load(F_x=1000.0, F_y=2000.0, omega=1500.0, tilt_z=4e-3, tilt_y=2e-3))
    psi, x, r = y[SLICE["ball_theta"]], y[SLICE["ball_x"]], y[SLICE["ball_r"]]
    # points of a plane tilted by (beta, gamma) about its centre
    plane = np.stack([np.ones(Z), -r * np.cos(psi), r * np.sin(psi)], -1)
    x_0, gamma, beta = np.linalg.lstsq(plane, x, rcond=None)[0]
    assert abs(gamma) > 1e-4
    assert y[SLICE["cage_gamma"]] == pytest.approx([gamma] * 2, rel=1e-3)
    assert y[SLICE["cage_beta"]] == pytest.approx([beta] * 2, rel=1e-3)
    model.rhs(0.0, y)
    for half in model.work.half:
        assert list(half.x) == pytest.approx([x_0, 0.0, 0.0], abs=5e-8)
        assert list(half.v) == pytest.approx([0.0] * 3, abs=1e-12)
        assert list(half.a_dot) == [0.0] * 3


@pytest.mark.c_only
def test_nothing_loaded_nothing_moves(core):
    """No load, no speed: the ring stays within its clearance, all speeds are 0, and 1 ms later nothing has happened."""
    bearing = Instance(core, inputs={"shaft.F_x": 0.0, "shaft.F_y": 0.0, "shaft.omega": 0.0})
    y = bearing.y
    place = y[SLICE["ring_x"].start :][:3]
    assert np.abs(place[1:]).max() < 7.5e-6
    bearing.step(1e-3)
    assert np.abs(bearing.y[SLICE["ring_x"].start :][:3] - place).max() < 1e-9
    assert bearing.output("ball.Q_e").max() < 0.01


@pytest.mark.parametrize(
    ("parameters", "inputs"),
    [
        ({}, {"shaft.tilt_z": math.radians(0.5)}),
        ({}, {"shaft.tilt_z": math.radians(-0.5), "shaft.F_x": 1500.0}),
        (
            {"ring.tilt_mode": TiltMode.SUPPORTED, "ring.k_tilt": 2e4, "cage.pocket_clearance": 1e-4},
            {"shaft.tilt_z": math.radians(0.15)},
        ),
        ({"ring.tilt_mode": TiltMode.SUPPORTED, "ring.k_tilt": 1e3, "cage.pocket_clearance": 1e-4}, {}),
    ],
    ids=["tilt +0.5 deg", "tilt -0.5 deg", "scene R", "scene F"],
)
def test_no_shock_at_the_start(core, parameters, inputs):
    """No ball starts pressed into its pocket: the cage stands where the balls are, 0.15 mm off the bearing's plane at
    0.5 deg.
    """
    model = core.model(parameters=parameters, inputs=inputs)
    y = model.start()
    model.rhs(0.0, y)
    assert pocket_loads(model).max() < 1.0


def test_unbalance_turns_about_the_centre(core):
    """The centre of mass of the cage stands at unbalance/mass from the axis toward pocket 1 and moves with the cage."""
    model, y, _ = start(core, {"cage.unbalance": 2e-6}, CASES["pure axial"][1])
    e = 2e-6 / (2 * PARAMETERS["cage.m"].start)
    assert y[SLICE["cage_y"]] == pytest.approx([e, e], rel=1e-9)
    assert y[SLICE["cage_v_z"]] == pytest.approx(e * y[SLICE["cage_s"]], rel=1e-9)
    model.rhs(0.0, y)
    assert np.abs(list(model.work.half[0].x)[1:]).max() < 1e-15
    assert np.abs(list(model.work.half[0].v)).max() < 1e-12


# ---------------------------------------------------------------------------------------------------------------- seeds


def splitmix64(seed, n):
    """Uniform numbers in [0, 1): Steele, Lea & Flood (2014), in Python's integers."""
    mask, state, numbers = (1 << 64) - 1, seed, []
    for _ in range(n):
        state = (state + 0x9E3779B97F4A7C15) & mask
        z = state
        z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & mask
        z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & mask
        numbers.append(((z ^ (z >> 31)) >> 11) / 2.0**53)
    return np.array(numbers)


def test_generator():
    """The published sequence of seed 1234567."""
    assert (splitmix64(1234567, 3) * 2.0**53).astype(np.uint64).tolist() == [
        n >> 11 for n in (6457827717110365317, 3203168211198807973, 9817491932198370423)
    ]


@pytest.mark.parametrize("seed", [0, 1, 2, 12345])
def test_spacing(core, seed):
    """Azimuths 2 pi j/Z + uniform within 0.1 of the pocket clearance on the pitch circle, by the seed."""
    y = core.model(parameters={"start.seed": seed}).start()
    spread = 0.1 * 2e-4 / 0.02675
    expected = 2 * np.pi * np.arange(Z) / Z + spread * (2 * splitmix64(seed, Z) - 1)
    assert y[SLICE["ball_theta"]] == pytest.approx(expected, abs=1e-15)
