"""Drag in the mixture of oil and air: density, the balance of a mixture that turns, balls, cage ends and cylinder,
inner ring, by hand.
"""

import numpy as np
import pytest
from mechanics import Z, clear_balls, on_ball, place_balls, pose
from scipy.optimize import brentq

from bearing_model.generated.variables import Drag, Switch

TWINS = True
CHURNING = 8.3896e-5  # [N.m], see test_churning
RHO_MIX, NU = 35.0, 6e-3 / 900.0  # [kg/m3], [m2/s]: mixture's density, oil's kinematic viscosity
R_O, R_I, C = 0.02975, 0.02485, 1e-4  # cage radii, radial guide clearance [m]
WIDTH = 0.5 * 13.5e-3 - 2.5e-3  # of the cylinder beside the land of one half [m]


ALONE = {"scene.drag": Drag.ISOLATED, "scene.churning": Switch.OFF}


def mixture(core, speed=1909.879, cage=757.0, inputs=None, **changes):
    """A model with both halves at `cage` [rad/s] and the mixture set."""
    m = core.model(parameters={"cage.width": 13.5e-3} | changes, inputs={"shaft.omega": speed} | (inputs or {}))
    for half in m.work.half:
        pose(core, half, Omega=(cage, 0.0, 0.0))
    pose(core, m.work.ring, Omega=(speed, 0.0, 0.0))
    m.kernel("drag_mixture")(m.pointer, m.work)
    return m


@pytest.mark.parametrize(("speed_rpm", "X"), [(18238.0, 0.073574), (72000.0, 0.018637), (500.0, 1.0)])
def test_density_from_the_flow(core, speed_rpm, X):
    """Parker's 10^5 W^0.37/(n d_m^1.7) with 760 cm3/min and 53.5 mm; the space is full of oil at 500 r/min.  Balls,
    cage and churning feel it alike.
    """
    m = mixture(core, speed_rpm * np.pi / 30.0, **{"oil.flow": 760e-6 / 60.0})
    assert m.work.filling * 900.0 == pytest.approx(900.0 * X + 1.19 * (1.0 - X), rel=1e-4)
    assert m.d.drag == pytest.approx(0.5 * 0.45 * 900.0 * np.pi / 4.0 * 0.0111125**2, rel=1e-14)


def test_density_given(core):
    """Without a flow the mixture has oil.rho_mix at any speed."""
    assert mixture(core, 100.0).work.filling == mixture(core, 3000.0).work.filling == 1.0


def balance(omega, x, rho, flow, land):
    """Moment on a mixture that turns at x omega_m [N.m]: balls, inner ring, outer ring beside the lands, fresh oil,
    each written out by itself.
    """
    D, d_m, width = 0.0111125, 0.0535, 13.5e-3
    r_m, r_i, r_e, h = d_m / 2, (d_m - D) / 2, (d_m + D) / 2, 0.6 * D
    omega_m = omega * (1.0 - D / d_m) / 2.0

    def wall(r, width, speed):  # friction on the mixture by a wall that turns at `speed`
        f = 0.066 * (abs(speed - omega_m) * r * h / NU) ** -0.25
        return (
            0.5
            * rho
            * f
            * ((speed - x * omega_m) * r) ** 2
            * np.sign(speed - x * omega_m)
            * 2.0
            * np.pi
            * r
            * width
            * r
        )

    v = (1.0 - x) * omega_m * r_m
    balls = Z * 0.5 * 0.45 * rho * np.pi * D**2 / 4.0 * v * abs(v) * r_m
    return balls + wall(r_i, width, omega) + wall(r_e, width - 2.0 * land, 0.0) - 900.0 * flow * x * omega_m * r_m**2


@pytest.mark.parametrize("flow", [0.0, 1e-5])
@pytest.mark.parametrize("land", [2.5e-3, 6.75e-3])
@pytest.mark.parametrize("omega", [200.0, -1909.9, 7500.0])
def test_mixture_turns_where_its_moments_balance(core, omega, land, flow):
    """x from the closed form against the root of the balance; without fresh oil, and all of the outer ring under lands,
    the inner ring drives the mixture faster than the balls.
    """
    m = mixture(core, omega, cage=omega / 2.5, **{"cage.land_width": land, "oil.flow": flow})
    rho = (900.0 if flow else 35.0) * m.work.filling
    x = brentq(lambda x: balance(abs(omega), x, rho, flow, land), 0.0, 2.0, xtol=1e-15)
    assert m.work.stream == pytest.approx(x * omega / 2.5, rel=1e-11)
    assert 0.6 < x < 1.2
    if flow == 0.0:
        assert (x > 1.0) == (land > 5e-3)


def test_row_of_balls(core):
    """Drag of the speed against the mixture, (1/2) C_d rho A v|v|; the ball's loss is force times its own speed."""
    m = mixture(core, **{"scene.churning": Switch.OFF})
    w = place_balls(
        m, np.zeros(Z), np.full(Z, 0.02675), np.zeros(Z), np.stack([np.zeros(Z), np.zeros(Z), np.full(Z, 20.25)], -1)
    )
    clear_balls(w)
    m.kernel("drag_force")(m.pointer, m.work)
    v = 20.25 - m.work.stream * 0.02675
    assert 1.0 < v < 2.0
    assert on_ball(w)[0][:, 2] == pytest.approx(-0.30550 * (v / 20.0) ** 2, rel=1e-4)
    assert w.drag_dissipated[:Z] == pytest.approx(-on_ball(w)[0][:, 2] * 20.25, rel=1e-14)


def test_churning(core):
    """(1/2) rho R^5 C_n omega^2 with Re = R^2 omega/nu = 20376, C_n = 0.046762: 8.3896e-5 N.m at 4400 rad/s in a
    mixture at rest, about any axis.
    """
    m = mixture(core, **{"scene.drag": Drag.ISOLATED})
    axis = np.array([2.0, -3.0, 6.0]) / 7.0
    w = place_balls(m, np.zeros(Z), np.full(Z, 0.02675), np.zeros(Z), np.zeros((Z, 3)), np.tile(4400.0 * axis, (Z, 1)))
    clear_balls(w)
    m.kernel("drag_force")(m.pointer, m.work)
    F, M = on_ball(w)
    assert M == pytest.approx(np.tile(-CHURNING * axis, (Z, 1)), rel=1e-4)
    assert not F.any()
    assert w.drag_dissipated[:Z] == pytest.approx(CHURNING * 4400.0, rel=1e-4)


def test_churning_of_a_slow_ball(core):
    """At Re = 10 the moment of a sphere that turns in a fluid at rest is 8 pi eta R^3 omega (1 + Re^2/1200 - ...),
    Lamb's with Ovseenko's next term.

    The formula's C_n of Dennis, Singh & Ingham, fitted from Re = 10 on, is 3.6 % below.
    """
    m = mixture(core, **{"scene.drag": Drag.ISOLATED})
    R, speed = 0.5 * 0.0111125, 10.0 * NU / (0.5 * 0.0111125) ** 2
    w = place_balls(
        m, np.zeros(Z), np.full(Z, 0.02675), np.zeros(Z), np.zeros((Z, 3)), np.tile([speed, 0.0, 0.0], (Z, 1))
    )
    clear_balls(w)
    m.kernel("drag_force")(m.pointer, m.work)
    rho = 35.0
    expected = 8.0 * np.pi * NU * rho * R**3 * speed * (1.0 + 100.0 / 1200.0)
    assert on_ball(w)[1][:, 0] == pytest.approx(np.full(Z, -expected), rel=0.05)


def test_churning_is_against_the_mixture(core):
    """A ball that turns with the mixture feels no moment."""
    m = mixture(core)
    w = place_balls(
        m, np.zeros(Z), np.full(Z, 0.02675), np.zeros(Z), np.zeros((Z, 3)), np.tile([m.work.stream, 0.0, 0.0], (Z, 1))
    )
    clear_balls(w)
    m.kernel("drag_force")(m.pointer, m.work)
    assert not on_ball(w)[1].any()


def test_ring(core):
    """The mixture brakes the inner ring by what the ring gives to the balance; all of it is lost."""
    m = mixture(core)
    m.kernel("drag_ring")(m.pointer, m.work)
    r, h, omega_m = 0.02119375, 0.6 * 0.0111125, 1909.879 * (1.0 - 0.0111125 / 0.0535) / 2.0
    f = 0.066 * ((1909.879 - omega_m) * r * h / NU) ** -0.25
    M = 0.5 * RHO_MIX * f * ((1909.879 - m.work.stream) * r) ** 2 * 2.0 * np.pi * r * 13.5e-3 * r
    assert m.work.ring.M[0] == pytest.approx(-M, rel=1e-11)
    assert m.work.ring_drag_dissipated == pytest.approx(M * 1909.879, rel=1e-11)


@pytest.mark.parametrize("speed", [0.0, 1e-6, -1.0])
def test_ring_that_stops_before_the_cage(core, speed):
    """Rings at rest against each other in a mixture that the cage still carries: Hirs' friction by the speed of the mixture
    against the wall, that of rolling, within the quarter power of its floor, 0.5^-0.25 = 1.19, and of the share of the speed at
    the inner ring, 0.6^-0.25 = 1.14.
    """
    m = mixture(core, speed)
    m.kernel("drag_ring")(m.pointer, m.work)
    r, h = 0.02119375, 0.6 * 0.0111125
    assert 0.6 * 757.0 < m.work.stream < 757.0
    f = 0.066 * (m.work.stream * r * h / NU) ** -0.25
    M = 0.5 * RHO_MIX * f * ((m.work.stream - speed) * r) ** 2 * 2.0 * np.pi * r * 13.5e-3 * r
    assert 0.75 < m.work.ring.M[0] / M < 1.2
    kappa = 0.5 * (1.0 - 0.0111125 / 0.0535)  # orbital speed over shaft speed
    rolling = 0.5 * 757.0 / kappa  # half of the shaft speed at which this cage would roll
    floored = M / f * 0.066 * ((1.0 - kappa) * rolling * r * h / NU) ** -0.25
    assert m.work.ring.M[0] == pytest.approx(floored, rel=1e-11)


def test_balls(core):
    """(1/2) 0.45 * 35 kg/m3 * 96.985 mm2 * (20 m/s)^2 = 0.30550 N against the motion; power F v."""
    m = mixture(core, **ALONE)
    v_t = np.linspace(-20.0, 20.0, Z)
    w = place_balls(
        m, np.zeros(Z), np.full(Z, 0.02675), np.zeros(Z), np.stack([np.full(Z, 5.0), np.full(Z, -3.0), v_t], -1)
    )
    clear_balls(w)
    m.kernel("drag_force")(m.pointer, m.work)
    F, M = on_ball(w)
    assert F[[0, -1], 2] == pytest.approx([0.30550, -0.30550], rel=1e-4)
    assert F[:, 2] == pytest.approx(-0.30550 * (v_t / 20.0) * np.abs(v_t / 20.0), rel=1e-4)
    assert not F[:, :2].any() and not M.any()
    assert w.dissipated[:Z] == pytest.approx(-F[:, 2] * v_t, rel=1e-14)


def cage_moments(core, omega):
    m = mixture(core, **ALONE)
    for half, speed in zip(m.work.half, omega, strict=True):
        pose(core, half, Omega=(speed, 0.0, 0.0))
    m.kernel("drag_cage")(m.pointer, m.work)
    M = np.array([half.M[0] for half in m.work.half])
    assert m.work.cage_drag_dissipated == pytest.approx(-float(M @ omega), rel=1e-13)
    assert all(half.M[1] == half.M[2] == 0.0 for half in m.work.half)
    return M


def end_face(omega):
    """One face: C_n = 3.87/sqrt(Re) laminar, 0.146/Re^0.2 turbulent."""
    Re = omega * R_O**2 / NU
    C_n = max(3.87 / np.sqrt(Re), 0.146 / Re**0.2)
    return 0.5 * RHO_MIX * omega**2 * (R_O**5 - R_I**5) * C_n / 2.0


def cylinder(omega):
    """Couette flow in the gap, with Taylor vortices beyond."""
    Ta = omega * R_O * C / NU * np.sqrt(C / R_O)
    tau = RHO_MIX * NU * omega * R_O / C * max(1.0, 1.3 * (Ta / 41.0) ** 0.539)
    return tau * 2.0 * np.pi * R_O * WIDTH * R_O


@pytest.mark.parametrize(
    ("omega", "reynolds", "taylor", "hand"),
    [  # laminar both; turbulent face; turbulent face and vortices.  Moments of face and cylinder by hand [N.m]
        (100.0, 13276.0, 2.59, 4.064e-5 + 1.6406e-4),
        (757.0, 100500.0, 19.6, 1.0113e-3 + 1.2420e-3),
        (3000.0, 398300.0, 77.6, 1.2059e-2 + 9.0245e-3),
    ],
)
def test_cage(core, omega, reynolds, taylor, hand):
    assert omega * R_O**2 / NU == pytest.approx(reynolds, rel=1e-3)
    assert omega * R_O * C / NU * np.sqrt(C / R_O) == pytest.approx(taylor, rel=2e-3)
    M = cage_moments(core, np.array([omega, -omega]))
    assert M == pytest.approx(np.array([-1.0, 1.0]) * (end_face(omega) + cylinder(omega)), rel=1e-11)
    assert -M[0] == pytest.approx(hand, rel=1e-3)


def test_cage_at_rest(core):
    assert cage_moments(core, np.zeros(2)).tolist() == [0.0, 0.0]
