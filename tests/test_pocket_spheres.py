"""Ball and pocket of a ribbon cage: two spheres, fillet, edges; energy, momentum, power, friction, smoothness."""

import numpy as np
import pytest
from conforming_spheres import force_at
from mechanics import (
    Z,
    assert_balanced,
    bodies_of,
    clear_balls,
    on_ball,
    place_balls,
    pocket_loads,
    pocket_wrench,
    pose,
)
from ribbon import RIBBON
from scipy.optimize import brentq

from bearing_model.cage.common.pocket_spheres import spheres_contact
from bearing_model.generated.variables import Lubrication
from bearing_model.physics.hertz_exact import HertzContact, hertz_ellipse
from bearing_model.physics.model import Model

TWINS = True
R, SLACK, E, FILLET, EDGE = 0.0111125 / 2, 1e-4, 5e-5, 1.5e-3, 9e-5  # of tests/ribbon.py
RADIUS, R_PITCH, WIDTH = R + SLACK, 0.02675, 5e-3
SIN_CHI = (FILLET + E) / (RADIUS + FILLET)
E_STAR = 1.0 / ((1.0 - 0.3**2) / 207e9 + (1.0 - 0.33**2) / 110e9)
ELASTIC = {"cage.mu": 0.0, "cage.lambda": 0.0}


def one_ball(core, x, r, t, v=(0, 0, 0), omega=(0, 0, 0), **changes):
    """Every ball at (x, r, t) from the middle of its pocket, in the pocket's frame; halves at rest and centred.

    Ball velocities v in the balls' frames.
    """
    m = core.model(parameters=RIBBON | changes)
    for half in m.work.half:
        pose(core, half)
    phi, radius = 2.0 * np.pi * np.arange(Z) / Z, np.hypot(R_PITCH + r, t)
    w = place_balls(m, x, radius, phi + np.arctan2(t, R_PITCH + r), v, omega)
    clear_balls(w)
    m.kernel("cage_pockets")(m.pointer, m.work)
    return m, w


def on_pocket(m, h):
    """Force of the first ball on half h, whose pocket's frame is the global one: (x, r, t)."""
    return pocket_wrench(m, h)[0][0]


def hertz(rho_x, rho_y):
    """K of Q = K delta^1.5 by the quasi-static model's Hertz contact."""
    F_rho = (rho_x - rho_y) / (rho_x + rho_y)
    contact = HertzContact(rho_x + rho_y, F_rho, E_STAR, hertz_ellipse(F_rho))
    return contact.K


# ------------------------------------------------------------------------------------------------------------- geometry


@pytest.mark.parametrize("beta", [0.0, 0.1, 0.25, -0.3, 0.45])
def test_two_halves_share_a_push(core, beta):
    """N = F sin(chi_0 +- beta)/sin 2 chi_0 of a push at beta from the split, chi_0 = 30 deg of e = (R_c - R)/2.

    The approach of some nanometres changes chi_0 by its part of R_c - R: 1e-4.
    """
    chi_0 = np.arcsin(E / SLACK)

    def angle(x):
        """Of the resultant, at the tangential place that presses the halves with newtons."""
        t = brentq(lambda t: max(np.hypot(E - x, t), np.hypot(E + x, t)) - SLACK - 2e-8, 0.0, 2e-4)
        m, _w = one_ball(core, x, 0.0, t, **ELASTIC)
        F = on_pocket(m, 0) + on_pocket(m, 1)
        return np.arctan2(F[0], F[2]), m, F

    # half 1 (+x) is touched when the ball is on its side
    x = brentq(lambda x: angle(x)[0] - beta, -3e-8, 3e-8, xtol=1e-13)
    _, m, F = angle(x)
    Q, push = pocket_loads(m)[:, 0], np.hypot(F[0], F[2])
    assert push > 0.1
    share = np.sin(chi_0 + np.array([-beta, beta])) / np.sin(2.0 * chi_0)
    assert Q / push == pytest.approx(share, abs=1e-3)


def test_beyond_chi_0_one_half_has_all(core):
    """A push at 45 deg from the split, more than chi_0: half 1 alone."""
    S = SLACK + 2e-6
    m, _w = one_ball(core, S * np.sin(np.pi / 4) - E, 0.0, S * np.cos(np.pi / 4), **ELASTIC)
    Q = pocket_loads(m)[:, 0]
    assert Q[0] == 0.0 and Q[1] > 10.0


def test_sphere(core):
    """In the pole and at 45 deg: (4/3) E_star R_eff^0.5 delta^1.5 (1 + 0.7 a/R), a^2 = R_eff delta, along q."""
    delta, R_eff = 2e-6, R * RADIUS / SLACK
    Q = 4.0 / 3.0 * E_STAR * np.sqrt(R_eff) * delta**1.5 * (1.0 + 0.7 * np.sqrt(R_eff * delta) / R)
    for angle in (np.pi / 2, np.pi / 4):
        S = SLACK + delta
        m, _w = one_ball(core, S * np.sin(angle) - E, 0.0, S * np.cos(angle), **ELASTIC)
        assert on_pocket(m, 1) == pytest.approx(Q * np.array([np.sin(angle), 0.0, np.cos(angle)]), abs=2e-4 * Q)
        assert m.work.delta_c[1][0] == pytest.approx(delta, rel=1e-4)


def test_fillet(core):
    """With the spheres' centres in the split (e = 0), a push along it meets both fillets: Hertz with 1/R + 1/rho across, 1/R - 1/R_c along,
    where the ring's distance from the ball's centre is R + rho - delta.
    """
    depth, delta = {"cage.pocket_depth": RADIUS, "cage.width": 2.0 * (RADIUS + 9e-4)}, 2e-6
    sine = FILLET / (RADIUS + FILLET)
    A = (RADIUS + FILLET) * np.sqrt(1.0 - sine**2)
    t = A - np.sqrt((R + FILLET - delta) ** 2 - FILLET**2)
    m, _w = one_ball(core, 0.0, 0.0, t, **(ELASTIC | depth))
    normal = np.array([FILLET, A - t]) / (R + FILLET - delta)
    Q = hertz(1.0 / R + 1.0 / FILLET, 1.0 / R - 1.0 / RADIUS) * delta**1.5
    for h, side in enumerate((-1.0, 1.0)):
        assert on_pocket(m, h)[[0, 2]] == pytest.approx(Q * normal * [side, 1.0], rel=2e-4)
    # the tip of an arc is rounded over 0.1 um: 1e-14/(2 t) of 2e-6 m


def test_edges(core):
    """A push along the radius meets the edges of both halves, outside and inside."""
    delta, sine = 2e-6, (0.5 * WIDTH - EDGE) / (RADIUS + EDGE)
    H, A = 0.5 * WIDTH - EDGE, (RADIUS + EDGE) * np.sqrt(1.0 - sine**2)
    r = H - np.sqrt((R + EDGE - delta) ** 2 - (A - E) ** 2)
    normal = np.array([A - E, H - r]) / (R + EDGE - delta)
    Q = hertz(1.0 / R + 1.0 / EDGE, 1.0 / R - 1.0 / RADIUS) * delta**1.5
    for sign in (1.0, -1.0):
        m, _w = one_ball(core, 0.0, sign * r, 0.0, **ELASTIC)
        for h, side in enumerate((-1.0, 1.0)):
            assert on_pocket(m, h)[:2] == pytest.approx(Q * normal * [side, sign], rel=4e-4)


@pytest.mark.parametrize(("clearance", "approach"), [(0.005, 1e-6), (0.01, 3e-6), (0.03, 3e-6), (0.03, 1e-5)])
def test_force_of_conforming_spheres(core, clearance, approach):
    """Force at equal approach beside an elastic ball in a spherical hole of an elastic body (Legendre series): 5 %."""
    slack = clearance * R
    depth = R + 0.5 * slack
    sizes = {"cage.pocket_clearance": 2.0 * slack, "cage.pocket_depth": depth, "cage.width": 2.0 * (depth + 9e-4)}
    m, _w = one_ball(core, 0.5 * slack + approach, 0.0, 0.0, **(ELASTIC | sizes))
    force, _a = force_at(approach, R, R + slack, (207e9, 0.3), (110e9, 0.33))
    assert pocket_loads(m)[1, 0] == pytest.approx(force, rel=0.05)


# --------------------------------------------------------------------------------------------------------------- energy


def places(count, rng):
    """Places in the sphere of a half all around its seams and corners, pressed by up to some micrometres."""
    spheres = Model.of(RIBBON).d.spheres
    q = rng.normal(size=(3, count, Z))
    q[0] = np.abs(q[0])
    q *= SLACK / np.linalg.norm(q, axis=0)
    for _ in range(60):  # outward until touched
        q *= np.where(spheres_contact(spheres, *q)[3] < 2e-6, 1.02, 1.0)
    return spheres, q


def test_force_is_the_gradient_of_the_energy():
    """By complex steps in all kinds of contact, mixed ones included; to rounding."""
    spheres, q = places(400, np.random.default_rng(1))
    _, Q, n, _ = spheres_contact(spheres, *q)
    assert np.mean(Q > 1.0) > 0.9
    for i in range(3):
        step = q.astype(complex)
        step[i] += 1e-30j
        gradient = np.imag(spheres_contact(spheres, *step)[0]) / 1e-30
        assert gradient == pytest.approx(Q * n[i], abs=1e-9 * np.max(Q))


@pytest.mark.parametrize(
    ("start", "end"),
    [
        ((1.0, 0.0, 0.02), (0.1, 0.0, 1.0)),  # over the fillet's seam
        ((1.0, 0.0, 0.3), (1.0, 1.0, 0.3)),  # over an edge's
        ((-0.1, 0.0, 1.0), (0.2, 0.0, 1.0)),
    ],
)
def test_force_is_c1_over_the_seams(start, end):
    """Along a way at a constant approach to the sphere the force has a continuous slope: its second differences fall with the step.

    A kink leaves a jump of the slope, which does not fall; a step of the force would make it grow.
    """
    spheres = Model.of(RIBBON).d.spheres

    def jump(count):
        way = np.linspace(0.0, 1.0, count)
        q = np.outer(start, 1.0 - way) + np.outer(end, way)
        q *= (SLACK + 8e-6) / np.linalg.norm(q, axis=0)
        _, Q, n, _ = spheres_contact(spheres, *(np.repeat(c[:, None], Z, axis=1) for c in q))
        F = (Q * np.array(n))[..., 0]
        slope = np.diff(F, axis=1) * count
        assert np.max(Q) > 50.0
        return np.max(np.abs(np.diff(slope, axis=1))) / np.max(np.abs(slope))

    coarse, fine = jump(20_001), jump(80_001)
    assert fine < 0.35 * coarse  # 1/4 of a bounded second derivative


def support(direction, sin_chi, sin_eta, count=400):
    """Largest n.u over the normals n that sphere and rims have, for unit vectors u [3, m] = (x, r, t): on a grid over r and the height
    above the split.
    """
    x = np.linspace(sin_chi, 1.0, count)[:, None]
    r = np.linspace(-sin_eta, sin_eta, count)[None, :]
    left = 1.0 - x**2 - r**2
    n = np.stack([(x + 0.0 * r)[left >= 0.0], (r + 0.0 * x)[left >= 0.0], np.sqrt(left[left >= 0.0])])
    return np.array([np.max(n.T @ np.array([u[0], u[1], abs(u[2])])) for u in direction.T])


def test_force_is_continuous_beside_the_corners():
    """Along ways round the whole pocket at 8 um of approach, also where neither sphere nor fillet is near: the largest difference of
    neighbouring forces falls with the step.  No force is more than three times the largest that the sphere has at such an approach.

    A law whose fillet ends at a corner as a straight line gives steps of the energy there, and forces without limit.
    """
    spheres, rng = Model.of(RIBBON).d.spheres, np.random.default_rng(2)
    sin_eta = (0.5 * WIDTH - EDGE) / (RADIUS + EDGE)
    ends = rng.normal(size=(2, 3, 40))
    ends[:, 0] = np.abs(ends[:, 0]) * 0.5  # many near the split
    ends /= np.linalg.norm(ends, axis=1, keepdims=True)
    knots = np.linspace(0.0, 1.0, 60)
    largest = spheres.K * 8e-6**1.5 * (1.0 + 0.7 * np.sqrt(R * RADIUS / SLACK * 8e-6) / R)

    def differences(count):
        found = []
        for start, end in zip(ends[0].T, ends[1].T, strict=True):
            way = np.linspace(0.0, 1.0, count)
            u = np.outer(start, 1.0 - way) + np.outer(end, way)
            u /= np.linalg.norm(u, axis=0)
            at = np.outer(start, 1.0 - knots) + np.outer(end, knots)
            at /= np.linalg.norm(at, axis=0)
            size = np.interp(way, knots, (SLACK + 8e-6) / support(at, SIN_CHI, sin_eta))
            _, Q, n, _ = spheres_contact(spheres, *(np.repeat((c * size)[:, None], Z, axis=1) for c in u))
            F = (Q * np.array(n))[..., 0]
            assert np.max(Q) < 3.0 * largest
            found.append(np.max(np.abs(np.diff(F, axis=1))) / np.max(Q))
        return np.max(found)

    assert differences(16_001) < 0.35 * differences(4_001)  # 1/4 of a bounded slope


@pytest.mark.parametrize("x", [-2e-5, 0.0, 4e-6])
def test_a_ball_passes_between_the_corners_of_both_sides(x):
    """A ball that is pushed along r, as far as 3 um into the edges: its force along t turns over the 5 um that the approaches of both corners
    overlap: in 20 nm by less than 1 % of its largest value (20 nm are 0.4 % of 5 um, and the load grows on the way; with sides that change
    places within 0.1 um 20 %).  It is the slope of the energy.
    """
    spheres, t = Model.of(RIBBON).d.spheres, np.linspace(-8e-6, 8e-6, 801)

    def contact(r, t):
        """Energy, load along t and approach of the first ball at places t."""
        V, Q, n, delta = spheres_contact(spheres, *(np.repeat((q + 0.0 * t)[:, None], Z, axis=1) for q in (x, r, t)))
        return V[:, 0], (Q * n[2])[:, 0], delta[:, 0]

    r = brentq(lambda r: contact(r, np.zeros(1))[2][0] - 3e-6, 5e-5, 3e-4)
    V, F_t, _ = contact(r, t)
    assert np.max(np.abs(np.diff(F_t))) < 0.01 * np.max(F_t)
    np.testing.assert_allclose(F_t, -F_t[::-1], atol=1e-9 * np.max(F_t))
    assert np.max(np.abs((V[2:] - V[:-2]) / (t[2:] - t[:-2]) - F_t[1:-1])) < 1e-3 * np.max(F_t)


def test_touch_down_is_c1(core):
    """Force and stiffness begin at 0 where the second half is touched: 1.5 K delta^0.5."""
    t = np.sqrt(SLACK**2 - E**2)
    loads = []
    for x in (1e-7, 2e-7, 4e-7):  # beyond the place where half 0 is touched too
        m, _w = one_ball(core, -x, 0.0, t, **ELASTIC)
        loads.append(pocket_loads(m)[0, 0])
    assert loads[1] / loads[0] == pytest.approx(2.0**1.5, rel=0.02)
    assert loads[2] / loads[1] == pytest.approx(2.0**1.5, rel=0.02)


def random_scene(core, rng, **changes):
    """Balls against their pockets in all directions, halves displaced, tilted, turning and moving."""
    m = core.model(parameters=RIBBON | changes)
    bodies = list(bodies_of(m, rng, 10e-6))
    phi, q = 2.0 * np.pi * np.arange(Z) / Z, rng.normal(size=(3, Z))
    q *= [[6e-5], [1.8e-4], [1e-4]] / np.linalg.norm(q, axis=0)
    v = np.stack(
        [rng.uniform(-0.3, 0.3, Z), rng.uniform(-0.3, 0.3, Z), 757.0 * R_PITCH + rng.uniform(-0.3, 0.3, Z)], -1
    )
    omega = np.stack([-3600 + rng.uniform(-50, 50, Z), rng.uniform(-100, 100, Z), rng.uniform(-50, 50, Z)], -1)
    ball = {"x": q[0], "r": R_PITCH + q[1], "theta": phi + q[2] / R_PITCH, "v": v, "omega": omega}
    w = place_balls(m, ball["x"], ball["r"], ball["theta"], v, omega)
    clear_balls(w)
    m.kernel("cage_pockets")(m.pointer, m.work)
    assert (pocket_loads(m).max(axis=0) > 0.0).sum() >= 4
    return m, w, ball, bodies


def energy(spheres, place, body, j, side):
    """Elastic energy of one ball and one half from their global places."""
    phi = 2.0 * np.pi * j / Z
    a, b_y, b_z = body["frame"].T
    p, b = place - body["x"], b_y * np.cos(phi) + b_z * np.sin(phi)
    q = side * (p @ a) + spheres.e, p @ b - spheres.r, p @ np.cross(a, b)
    return spheres_contact(spheres, *(np.full(Z, c) for c in q))[0][j]


@pytest.mark.parametrize("filling", [0.0, 1.0], ids=["dry", "flooded"])
@pytest.mark.parametrize("lubrication", Lubrication)
def test_momentum_and_power(core, lubrication, filling):
    """Momentum and energy of balls and halves."""
    spheres = Model.of(RIBBON).d.spheres
    changes = {"scene.lubrication": lubrication, "cage.pocket_filling": filling}
    assert_balanced(*random_scene(core, np.random.default_rng(2), **changes), lambda *place: energy(spheres, *place))


# ------------------------------------------------------------------------------------------------------------- friction


@pytest.mark.parametrize("speed", [0.05, 0.2, 20.0])
def test_friction(core, speed):
    """A ball in the pole that turns about the pocket's radius: mu Q v/sqrt(v^2 + v_c^2) along the tangent, its moment times R."""
    delta = 2e-6
    m, w = one_ball(core, SLACK - E + delta, 0.0, 0.0, omega=(0.0, speed / R, 0.0), **{"cage.lambda": 0.0})
    Q = pocket_loads(m)[1, 0]
    friction = 0.05 * Q * speed / np.hypot(speed, 0.2)
    F, M = on_ball(w)
    # the surface at +x moves toward -t
    assert F[0] == pytest.approx([-Q, 0.0, friction], rel=1e-8, abs=1e-6)
    assert M[0] == pytest.approx([0.0, -friction * R, 0.0], rel=1e-8, abs=1e-9)
    assert w.dissipated[0] == pytest.approx(friction * speed, rel=1e-8)


def test_damping(core):
    """Q (1 + lambda delta_dot), lambda = 1 s/m."""
    dry = one_ball(core, SLACK - E + 2e-6, 0.0, 0.0, v=(0.3, 0, 0), **{"cage.mu": 0.0, "cage.lambda": 0.0})[0]
    m, _w = one_ball(core, SLACK - E + 2e-6, 0.0, 0.0, v=(0.3, 0, 0), **{"cage.mu": 0.0})
    assert pocket_loads(m)[1, 0] == pytest.approx(1.3 * pocket_loads(dry)[1, 0], rel=1e-8)


# ----------------------------------------------------------------------------------------------------------- parameters


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"cage.sheet": 0.0}, "cage.sheet = 0 m: more than 0"),
        ({"cage.pocket_fillet": 0.0}, "cage.pocket_fillet"),
        (
            {"cage.pocket_depth": 0.9 * R, "cage.sheet": RIBBON["cage.sheet"] + 0.1 * R},
            "more than bearing.D/2 = .* room for the ball",
        ),
        (
            {"cage.pocket_depth": RADIUS + 1e-6},
            "at most .bearing.D . cage.pocket_clearance./2 = .* no deeper than a sphere",
        ),
        ({"cage.pocket_radius": RADIUS + 1e-6}, "cage.pocket_radius = .*: 0, .*, or .bearing.D"),
        ({"cage.width": 0.014}, "cage.width = 0.014 m: 2 .cage.pocket_depth . cage.sheet. = "),
        ({"cage.guidance": 1}, "cage.guidance = 1: balls .2. is allowed for a ribbon cage"),
        ({"cage.D_o": RIBBON["cage.D_o"] * 0.977}, "cage.D_o . cage.D_i = .* at least .* for pockets around the balls"),
        ({"cage.pocket_edge": 1.3e-3}, "cage.D_o - cage.D_i = .* for a sphere between the pocket's edges"),
        ({"cage.pocket_fillet": 0.08}, "cage.pocket_fillet, .* less than 0.95 is allowed"),
        ({"cage.shape": 1}, "0 m is allowed for a machined cage"),
    ],
)
def test_sizes_that_make_no_ribbon(changes, message):
    """Each is refused by its name, with its value and what is allowed."""
    with pytest.raises(ValueError, match=message):
        Model.of(RIBBON | changes)
