"""Land film: Ocvirk's bearing, squeeze, Reynolds' equation by quadrature, rates, dry contact, mixed friction."""

import itertools

import numpy as np
import pytest
from library import block
from mechanics import pose
from scipy.integrate import quad, solve_bvp

from bearing_model.generated.variables import PARAMETERS, Lubrication, Switch
from bearing_model.physics.derived import default_table

TWINS = True
ETA, R, L, C = 6e-3, 0.02975, 2.5e-3, 1e-4
X_LAND = 5.5e-3
M, J_T, X_C = (PARAMETERS[f"cage.{name}"].start for name in ("m", "J_t", "x_c"))
KAPPA = ETA * R * L**3 / C**3  # 0.0028 N.s/m
# without the floor of 1 - eps^2, at the oil's temperature, in a gap that does not depend on the speed
SHARP = {"cage.g_0": 1e-12, "scene.heating": Switch.OFF, "cage.centrifugal": Switch.OFF}
GROWS = {"cage.centrifugal": Switch.ON}
DRY = {"oil.eta": 1e-300, "cage.g_0": 0.02}


def film(core, e, v, omega, tilt_rate=(0.0, 0.0), **changes):
    """Force (y, z) and moment (x, y, z) on half 1 whose land's middle is at e with velocity v; half 0 likewise."""
    m = core.model(parameters=SHARP | changes)
    for sign, half in zip((-1.0, 1.0), m.work.half, strict=True):
        # the axis turns at tilt_rate (a_y', a_z'): Omega = omega e_x + e_x x a'
        Omega = (omega, -tilt_rate[1], tilt_rate[0])
        shift = sign * X_LAND * np.array(tilt_rate)
        pose(core, half, x=(0.0, *e), v=(0.0, *(np.asarray(v) - shift)), Omega=Omega)
    m.kernel("land_film_force")(m.pointer, m.work)
    half = m.work.half[1]
    return m, np.array([half.F[1], half.F[2]]), np.array(list(half.M))


def petroff(eps):
    """Couette's torque over the speed."""
    return 2 * np.pi * ETA * R**3 * L / (C * np.sqrt(1 - eps**2))


@pytest.mark.parametrize("eps", [1e-6, 0.3, 0.6, 0.9])
def test_ocvirk(core, eps):
    """Steady rotation: F_r = -eta omega R L^3 eps^2/(C^2 (1 - eps^2)^2), F_t = pi eps .../(4 (1 - eps^2)^1.5).  Ocvirk
    (1952), NACA TN 2808.
    """
    omega = 757.0
    _, F, M = film(core, (C * eps, 0.0), (0.0, 0.0), omega)
    unit = ETA * omega * R * L**3 / C**2
    assert F[0] == pytest.approx(-unit * eps**2 / (1 - eps**2) ** 2, rel=1e-9, abs=1e-12 * unit)
    assert F[1] == pytest.approx(unit * np.pi * eps / (4 * (1 - eps**2) ** 1.5), rel=1e-9)
    # Petroff / sqrt(1 - eps^2), and half of the force's moment about the outer ring's axis
    assert M[0] == pytest.approx(petroff(eps) * -omega - 0.5 * F[1] * C * eps, rel=1e-9)


def test_attitude_turns_with_the_displacement(core):
    """The same force in any direction, mirrored with the sense of rotation."""
    _, F_0, _ = film(core, (0.7 * C, 0.0), (0.0, 0.0), 757.0)
    angle = 2.1
    c, s = np.cos(angle), np.sin(angle)
    _, F, _ = film(core, (0.7 * C * c, 0.7 * C * s), (0.0, 0.0), 757.0)
    assert F == pytest.approx([c * F_0[0] - s * F_0[1], s * F_0[0] + c * F_0[1]], rel=1e-12)
    _, F, _ = film(core, (0.7 * C, 0.0), (0.0, 0.0), -757.0)
    assert F == pytest.approx([F_0[0], -F_0[1]], rel=1e-12)


@pytest.mark.parametrize("eps", [0.0, 0.3, 0.6, 0.9])
def test_squeeze(core, eps):
    """Closing: -kappa e' [3 eps/(1 - eps^2)^2 + acos(-eps)(1 + 2 eps^2)/(1 - eps^2)^2.5].

    Opening with the other half of the film; together the full film's pi (1 + 2 eps^2)/(1 - eps^2)^2.5.  Pinkus &
    Sternlicht (1961).
    """
    q2 = 1.0 - eps**2
    _, F_in, _ = film(core, (C * eps, 0.0), (0.01, 0.0), 0.0)
    _, F_out, _ = film(core, (C * eps, 0.0), (-0.01, 0.0), 0.0)
    assert F_in[0] == pytest.approx(
        -KAPPA * 0.01 * (3 * eps / q2**2 + np.arccos(-eps) * (1 + 2 * eps**2) / q2**2.5), rel=1e-9
    )
    assert F_out[0] - F_in[0] == pytest.approx(KAPPA * 0.01 * np.pi * (1 + 2 * eps**2) / q2**2.5, rel=1e-9)
    assert abs(F_in[1]) < 1e-12 * abs(F_in[0])


def reynolds(e, v, omega):
    """Force by Reynolds' short-bearing equation, gap and its rates by differences: (h^3 p'/12 eta)' = dh/dt + (omega/2)
    dh/dphi, p >= 0 where p > 0; moment of the shear stress -h/2 dp/(R dphi) of the pressure's flow at the land, integrated by parts.
    """

    def gap(phi, t):
        place = e + v * t
        return C - place[0] * np.cos(phi) - place[1] * np.sin(phi)

    def line(phi):  # int p dz over the width, p = -6 eta rhs/h^3 (L^2/4 - z^2)
        rate = (gap(phi, 1e-4) - gap(phi, -1e-4)) / 2e-4 + 0.5 * omega * (
            gap(phi + 1e-4, 0.0) - gap(phi - 1e-4, 0.0)
        ) / 2e-4
        return max(-6.0 * ETA * rate / gap(phi, 0.0) ** 3 * L**3 / 6.0, 0.0)

    closing = v - 0.5 * omega * np.array([-e[1], e[0]])
    edge = np.arctan2(closing[1], closing[0])  # pressure between edge - pi/2 and edge + pi/2
    span = {"epsrel": 1e-9, "epsabs": 0.0, "limit": 400}
    worst = np.arctan2(e[1], e[0])
    inside = [worst + k * 2 * np.pi for k in (-1, 0, 1) if abs(worst + k * 2 * np.pi - edge) < np.pi / 2]
    places = [edge - np.pi / 2, *inside, edge + np.pi / 2]
    pairs = list(itertools.pairwise(places))
    return np.array(
        [
            -sum(quad(lambda phi, d=d: d(phi) * line(phi) * R, *pair, **span)[0] for pair in pairs)
            for d in (np.cos, np.sin, lambda phi: -0.5 * (gap(phi + 1e-4, 0.0) - gap(phi - 1e-4, 0.0)) / 2e-4)
        ]
    )


def drawn(rng):
    """Eccentricity, velocity [2] and speed of a land at random, in SI."""
    angle = rng.uniform(0, 2 * np.pi)
    e = C * rng.uniform(0.05, 0.95) * np.array([np.cos(angle), np.sin(angle)])
    return e, rng.uniform(-0.1, 0.1, 2), rng.uniform(-1500, 1500)


def test_reynolds_by_quadrature(core):
    """Rotation and squeeze together in any direction: both cross terms, and the moment beside Couette's.  Differences in gap and angle: 2e-9; observed
    2e-8.
    """
    rng = np.random.default_rng(1)
    for _ in range(20):
        e, v, omega = drawn(rng)
        _, F, M = film(core, e, v, omega)
        *expected, moment = reynolds(e, v, omega)
        assert F == pytest.approx(expected, abs=2e-7 * np.abs(expected).max())
        couette = petroff(np.hypot(*e) / C) * omega
        assert M[0] + couette == pytest.approx(moment, abs=2e-7 * np.abs(expected).max() * C + 1e-9 * abs(couette))


def test_place_of_the_force(core):
    """It acts at the land's middle, 5.5 mm from the split plane, and sees the velocity there: a half that tilts
    squeezes its film.
    """
    _, F_0, _ = film(core, (0.5 * C, 0.2 * C), (0.02, -0.05), 757.0)
    m, F, M = film(core, (0.5 * C, 0.2 * C), (0.02, -0.05), 757.0, tilt_rate=(8.0, -5.0))
    assert F == pytest.approx(F_0, rel=1e-9)
    assert M[1:] == pytest.approx([-X_LAND * F[1], X_LAND * F[0]], rel=1e-9)
    assert m.work.half[0].M[1] == pytest.approx(-M[1], rel=1e-9)


@pytest.mark.c_only
def test_rates_are_derivatives(core):
    """D = -dF/dv / m and along the tilts, by differences; the floor of 1 - eps^2 at its default."""
    rng = np.random.default_rng(2)
    for _ in range(10):
        e = C * rng.uniform(-0.65, 0.65, 2)
        v, omega = rng.uniform(-0.1, 0.1, 2), rng.uniform(-1500, 1500)
        h = 1e-6
        m, _, _ = film(core, e, v, omega, **{"cage.g_0": 0.02})
        D = m.rates()
        for i, (across, tilting) in enumerate((("v_y", "gamma_dot"), ("v_z", "beta_dot"))):
            rate, tilt = D[block("cage", across)][1], D[block("cage", tilting)][1]
            step = h * np.eye(2)[i]
            slope = (
                film(core, e, v + step, omega, **{"cage.g_0": 0.02})[1]
                - film(core, e, v - step, omega, **{"cage.g_0": 0.02})[1]
            )[i] / (2 * h)
            assert rate == pytest.approx(-slope / M, rel=1e-5, abs=1e-3)
            assert tilt == pytest.approx(-slope * (X_LAND - X_C) ** 2 / J_T, rel=1e-5, abs=1e-3)


def test_film_never_gives_energy(core):
    """In the frame that turns at half speed the film only resists, F.V <= 0; with Couette's torque both lands dissipate
    at any motion.
    """
    rng = np.random.default_rng(3)
    for _ in range(200):
        radius, angle = C * rng.uniform(0, 1.2), rng.uniform(0, 2 * np.pi)
        e = radius * np.array([np.cos(angle), np.sin(angle)])
        v, omega = rng.uniform(-0.3, 0.3, 2), rng.uniform(-1500, 1500)
        m, F, _ = film(core, e, v, omega, **{"cage.g_0": 0.02, "cage.K_land": 0.0})
        V = v - 0.5 * omega * np.array([-e[1], e[0]])
        assert F @ V <= 0.0
        assert m.work.land_dissipated > 0.0


def test_loss_of_the_film(core):
    """Couette's omega^2 - F.V of each land, whatever e, v and omega: rounding."""
    rng = np.random.default_rng(7)
    for _ in range(50):
        e, v, omega = drawn(rng)
        m, F, _ = film(core, e, v, omega)
        V = v - 0.5 * omega * np.array([-e[1], e[0]])
        expected = 2 * (petroff(np.hypot(*e) / C) * omega**2 - F @ V)
        assert m.work.land_dissipated == pytest.approx(expected, rel=1e-9)


def test_floor_keeps_the_film_finite(core):
    """q^2 is g_0 = 0.02 at the wall, (pi/2)/q^3 for a motion along it, and g_0/2 far behind it, where eps counts as 1.2
    in the squeeze's numerators.
    """
    soft = {"cage.g_0": 0.02, "cage.K_land": 0.0}
    _, F, _ = film(core, (C, 0.0), (0.0, 0.01), 0.0, **soft)
    assert F[1] == pytest.approx(-KAPPA * 0.01 * np.pi / 2 / 0.02**1.5, rel=1e-6)
    _, F, _ = film(core, (100 * C, 0.0), (0.01, 0.0), 0.0, **soft)
    q = np.sqrt(0.5 * 0.02)
    integral = 3 * 1.2 / q**4 + (np.pi / 2 + np.arctan(1.2 / q)) * (q**2 + 3 * 1.2**2) / q**5
    assert F[0] == pytest.approx(-KAPPA * 0.01 * integral, rel=1e-5)  # q^2 is g_0^2/2/(100^2) above g_0/2


# --------------------------------------------------------------------------------------------------------------- growth


@pytest.mark.parametrize("lubrication", [Lubrication.FILM, Lubrication.MIXED])
def test_half_that_grows_has_a_narrower_gap(core, lubrication):
    """C = C_0 - g omega^2: film, friction and dry contact of a cage whose guide clearance is smaller by 2 g omega^2, g the
    table's at the land, for the cage's mass; rounding.  The cage's speed counts, not its sign.
    """
    by_1, by_x = M / default_table().half.m * default_table().half.growth
    mixed = {"scene.lubrication": lubrication}
    for omega in (755.0, -3000.0):
        narrower = C - (by_1 + X_LAND * by_x) * omega**2
        for eps in (0.3, 0.99, 1.02):
            place, v = (eps * narrower, 0.1 * C), (0.02, -0.05)
            grown = film(core, place, v, omega, **mixed, **GROWS)
            given = film(core, place, v, omega, **mixed, **{"cage.guide_clearance": 2.0 * narrower})
            for found, expected in zip(grown[1:], given[1:], strict=True):
                assert found == pytest.approx(expected, rel=1e-9, abs=1e-15 * np.abs(expected).max())
            assert grown[0].work.land_elastic == pytest.approx(given[0].work.land_elastic, rel=1e-9)


def test_growth_leaves_a_gap(core):
    """A tenth of the clearance stays, however fast the half turns: rounding."""
    place, v = (0.05 * C, 0.0), (0.01, 0.0)
    for omega in (1e4, 2e4):
        grown = film(core, place, v, omega, **GROWS)[1]
        assert grown == pytest.approx(film(core, place, v, omega, **{"cage.guide_clearance": 0.2 * C})[1], rel=1e-9)


# ---------------------------------------------------------------------------------------------------------- dry contact


def test_dry_contact(core):
    """Without oil: N = K_land (e - C)^1.5 (1 + lambda e') and friction mu_land N v/sqrt(v^2 + v_c^2) at the radius R."""
    e, omega = C + 3e-6, 757.0
    m, F, M = film(core, (e, 0.0), (0.1, 0.0), omega, **DRY)
    elastic = 2e9 * 3e-6**1.5
    N = elastic * 1.1
    slip = omega * R
    T = 0.08 * N * slip / np.hypot(slip, 0.2)
    assert F == pytest.approx([-N, -T], rel=1e-9)
    assert M[0] == pytest.approx(-T * R, rel=1e-9)
    assert m.work.land_elastic == pytest.approx(2 * 0.4 * elastic * 3e-6, rel=1e-9)
    assert m.work.land_dissipated == pytest.approx(2 * (T * slip + 0.1 * elastic * 0.1), rel=1e-9)
    assert np.abs(film(core, (C - 1e-9, 0.0), (0.1, 0.0), omega, **DRY)[1]).max() < 1e-200


@pytest.mark.parametrize("eps", [0.9, 0.99, 0.999])
def test_mixed_friction(core, eps):
    """Asperities carry exp(-1.8 Lambda^1.2) of the film's force, Lambda = C (1 - eps)/sigma, sigma = 0.8 um."""
    place, speed = (C * eps, 0.0), 757.0
    _, F_film, M_film = film(core, place, (0.0, 0.0), speed)
    _, F, M = film(core, place, (0.0, 0.0), speed, **{"scene.lubrication": Lubrication.MIXED})
    N = np.exp(-1.8 * (C * (1 - eps) / 0.8e-6) ** 1.2) * np.hypot(*F_film)
    T = 0.08 * N * speed * R / np.hypot(speed * R, 0.2)
    assert F - F_film == pytest.approx([0.0, -T], abs=1e-9 * np.hypot(*F_film))
    assert M[0] - M_film[0] == pytest.approx(-T * R, abs=1e-9 * abs(M_film[0]))


# -------------------------------------------------------------------------------------------------------------- heating


def couette(Na):
    """Shear stress of plane Couette flow between walls at one temperature over the isothermal stress, by its boundary
    value problem.

    Velocity u and temperature T over the gap, both 0...1 wide: tau = e^-T u', T'' = -Na tau u', T = 0 at both walls.
    """

    def equations(_, y, p):
        slope = p[0] * np.exp(y[1])  # u'
        return np.array([slope, y[2], -Na * p[0] * slope])

    def ends(at_0, at_1, _):
        return np.array([at_0[0], at_1[0] - 1.0, at_0[1], at_1[1]])

    z = np.linspace(0.0, 1.0, 50)
    solution = solve_bvp(equations, ends, z, np.stack([z, 0.0 * z, 0.0 * z]), p=[1.0], tol=1e-10, max_nodes=20000)
    assert solution.success
    return solution.p[0]


@pytest.mark.parametrize("omega", [30.0, 757.0, 3000.0])
def test_film_heats_itself(core, omega):
    """The moment of a centred land falls as the shear stress of Couette flow with a viscosity exp(-beta (T - T_wall)),
    solved numerically.

    Na = 7e-4, 0.5, 7.5.
    """
    Na = 0.022 * ETA * (omega * R) ** 2 / 0.14
    _, _, cold = film(core, (0.0, 0.0), (0.0, 0.0), omega)
    _, _, warm = film(core, (0.0, 0.0), (0.0, 0.0), omega, **{"scene.heating": Switch.ON})
    assert warm[0] / cold[0] == pytest.approx(couette(Na), rel=1e-8)
    _, F_cold, _ = film(core, (0.5 * C, 0.0), (0.0, 0.0), omega)
    _, F_warm, _ = film(core, (0.5 * C, 0.0), (0.0, 0.0), omega, **{"scene.heating": Switch.ON})
    assert F_warm / F_cold == pytest.approx(np.full(2, couette(Na)), rel=1e-8)


def test_heating_is_continuous(core):
    """Below s = 1e-3 a series takes the place of the closed form: no step of more than 1e-12."""
    speed = np.sqrt(8.0 * 0.14 / (0.022 * ETA)) * 1e-3 / R
    around = []
    for omega in (speed * (1.0 - 1e-9), speed * (1.0 + 1e-9)):
        _, _, M = film(core, (0.0, 0.0), (0.0, 0.0), omega, **{"scene.heating": Switch.ON})
        around.append(M[0] / omega)
    assert around[1] == pytest.approx(around[0], rel=2e-12)
