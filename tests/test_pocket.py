"""Ball and pocket: cylinder, energy shared by the halves, momentum, power, friction and its film."""

import itertools

import numpy as np
import pytest
from mechanics import (
    Z,
    assert_balanced,
    bodies_of,
    clear_balls,
    frames,
    on_ball,
    place_balls,
    pocket_contact,
    pocket_loads,
    pocket_wrench,
    pose,
)
from scipy.integrate import quad
from scipy.spatial.transform import Rotation

from bearing_model.generated.variables import Lubrication

TWINS = True
R, GAP = 0.0111125 / 2, 1e-4
R_PITCH = 0.02675
FRICTIONLESS = {"cage.mu": 0.0, "oil.rolling": 0.0, "cage.lambda": 0.0}


def force(model):
    w = model.work
    model.kernel("cage_pockets")(model.pointer, w)


def one_ball(core, x, t, v=(0, 0, 0), omega=(0, 0, 0), **changes):
    """Every ball at (x, t) from its pocket's axis, halves at rest and centred."""
    m = core.model(parameters=changes)
    for half in m.work.half:
        pose(core, half)
    phi = 2.0 * np.pi * np.arange(Z) / Z
    theta = phi + np.arcsin(t / R_PITCH)
    w = place_balls(m, x, R_PITCH, theta, v, omega)
    clear_balls(w)
    force(m)
    return m, w


# ------------------------------------------------------------------------------------------------------------- cylinder


def test_cylinder(core):
    """Tangential offset gap + 2 um: each half carries K delta^1.5/2; inside the gap none."""
    m, w = one_ball(core, 0.0, GAP + 2e-6, **FRICTIONLESS)
    assert w.delta_c[:, :Z] == pytest.approx(np.full((2, Z), 2e-6), abs=1e-16)
    assert pocket_loads(m) == pytest.approx(np.full((2, Z), 0.5 * m.d.pocket.K * 2e-6**1.5), rel=1e-9)
    F, M = on_ball(w)
    angle = np.arcsin((GAP + 2e-6) / R_PITCH)  # the pocket's tangent is not the ball's
    Q = m.d.pocket.K * 2e-6**1.5
    # rounding of places, 1e-17 of 2e-6 m
    assert F == pytest.approx(np.tile([0.0, -Q * np.sin(angle), -Q * np.cos(angle)], (Z, 1)), rel=1e-9, abs=1e-9)
    assert not M.any()
    m, w = one_ball(core, 0.0, GAP - 1e-9, **FRICTIONLESS)
    assert not pocket_loads(m).any()


def pressure_beyond(chord, a, b):
    """Part of the pressure sqrt(1 - (x/a)^2 - (y/b)^2) at x > -chord, by quadrature over the ellipse."""
    across = quad(
        lambda x: quad(
            lambda y: np.sqrt(max(1 - (x / a) ** 2 - (y / b) ** 2, 0.0)), 0.0, b * np.sqrt(1 - (x / a) ** 2)
        )[0],
        -chord,
        a,
    )[0]
    return 2.0 * across / (2.0 / 3.0 * np.pi * a * b)


@pytest.mark.parametrize("angle", [-1.5, -0.3, -0.1, -0.02, 0.0, 0.04, 0.12, 0.7, 1.5])
def test_shares_are_those_of_the_pressure(core, angle):
    """Each half bears the Hertz pressure on its side of the split plane, together Hertz' load wherever the contact
    lies.
    """
    delta = 3e-6
    S = GAP + delta
    m, _w = one_ball(core, S * np.sin(angle), S * np.cos(angle), **FRICTIONLESS)
    Q = pocket_loads(m)[:, 0]
    assert Q.sum() == pytest.approx(m.d.pocket.K * delta**1.5, rel=1e-9)
    a, b = pocket_contact().semi_axes(Q.sum())
    chord = np.clip((R + GAP) * np.sin(angle), -a, a)  # of the wall, whose radius is R + GAP
    # the quadrature is off by 2e-7 at the rim
    assert Q[1] / Q.sum() == pytest.approx(pressure_beyond(chord, a, b), abs=1e-6)


def test_the_patch_lets_go_smoothly(core):
    """A half's load goes to 0 with its slope where the patch leaves it: 3/4 (1 - xi)^2 of the whole."""
    delta = 3e-6
    m, _w = one_ball(core, 0.0, GAP + delta, **FRICTIONLESS)
    a, _b = pocket_contact().semi_axes(pocket_loads(m)[:, 0].sum())
    for rest in (1e-2, 1e-3, -1e-3):
        angle = np.arcsin((1.0 - rest) * a / (R + GAP))
        m, _w = one_ball(core, (GAP + delta) * np.sin(angle), (GAP + delta) * np.cos(angle), **FRICTIONLESS)
        Q = pocket_loads(m)[:, 0]
        assert Q[0] / Q.sum() == pytest.approx(0.75 * max(rest, 0.0) ** 2, rel=1e-2)  # 1 - rest/3


def test_the_split_is_pushed_open(core):
    """A contact in the split plane pushes the halves apart by 3/8 Q delta R_c/(a S), 1.3 times the pressure's own 3/16
    Q a/R_c along the axis.
    """
    delta = 3e-6
    m, _w = one_ball(core, 0.0, GAP + delta, **FRICTIONLESS)
    F_x = np.array([pocket_wrench(m, h)[0][0, 0] for h in range(2)])
    Q = pocket_loads(m)[:, 0].sum()
    a, _b = pocket_contact().semi_axes(Q)
    assert F_x == pytest.approx(0.375 * Q * delta * (R + GAP) / (a * (GAP + delta)) * np.array([-1.0, 1.0]), rel=1e-5)
    assert 1.2 < F_x[1] / (3.0 / 16.0 * Q * a / (R + GAP)) < 1.4


# --------------------------------------------------------------------------------------------------------------- energy


def random_scene(core, rng, gap=GAP, **changes):
    """Balls against their pockets, halves displaced, tilted, turning and moving."""
    m = core.model(parameters={"cage.pocket_clearance": 2.0 * gap} | changes)
    bodies = list(bodies_of(m, rng, 20e-6))
    phi, angle = 2.0 * np.pi * np.arange(Z) / Z, rng.uniform(-np.pi, np.pi, Z)
    S = gap + rng.uniform(5e-6, 30e-6, Z)
    ball = {
        "x": S * np.sin(angle),
        "r": R_PITCH + rng.uniform(-1e-4, 1e-4, Z),
        "theta": phi + S * np.cos(angle) / R_PITCH,
        "v": np.stack(
            [rng.uniform(-0.3, 0.3, Z), rng.uniform(-0.3, 0.3, Z), 757.0 * R_PITCH + rng.uniform(-0.3, 0.3, Z)], -1
        ),
        "omega": np.stack([-3600 + rng.uniform(-50, 50, Z), rng.uniform(-100, 100, Z), rng.uniform(-50, 50, Z)], -1),
    }
    w = place_balls(m, ball["x"], ball["r"], ball["theta"], ball["v"], ball["omega"])
    clear_balls(w)
    force(m)
    assert (pocket_loads(m).max(axis=0) > 0.0).sum() >= 4
    return m, w, ball, bodies


def work(m, chord, R_c, delta):
    """Work of pressing a ball in by delta, where a half bears what lies beyond its chord of the patch, whose half length a is R_c at
    most: the load over the approach, by Gauss in its root between the roots at which a becomes the chord and R_c.
    """
    K, a_delta = m.d.pocket.K, m.d.pocket.a_delta
    node, weight = np.polynomial.legendre.leggauss(8)
    roots = np.sort(np.minimum([0.0, abs(chord) / a_delta, R_c / a_delta, np.inf], np.sqrt(max(delta, 0.0))))
    total = 0.0
    for low, high in itertools.pairwise(roots):
        if low == high:
            continue
        root = 0.5 * (high + low) + 0.5 * (high - low) * node
        xi = np.clip(chord / np.minimum(a_delta * root, R_c), -1.0, 1.0)
        total += 0.5 * (high - low) * np.sum(weight * K * root**3 * (0.5 + 0.75 * (xi - xi**3 / 3.0)) * 2.0 * root)
    return total


def energy(m, gap, place, body, j, side):
    """Elastic energy of one ball and one half from their global places."""
    phi = 2.0 * np.pi * j / Z
    a, b_y, b_z = body["frame"].T
    p = place - body["x"]
    x, t = p @ a, p @ np.cross(a, b_y * np.cos(phi) + b_z * np.sin(phi))
    S = np.hypot(x, t)
    return work(m, side * (R + gap) * x / S, R + gap, S - gap)


def turned(body, rotation):
    return body | {"frame": Rotation.from_rotvec(rotation).as_matrix() @ body["frame"]}


@pytest.mark.parametrize("gap", [GAP, 1.2e-5], ids=["usual", "close"])
def test_forces_are_the_gradient_of_the_energy(core, gap):
    """Force on ball, force and moment on each half by central differences of the energy over their places and turns.

    Difference over 1e-9 m and 1e-9/R rad: truncation (1e-9/delta)^2, rounding 1e-7; observed 2e-7 of the largest force.  Patches in
    a close pocket are as long as its radius.
    """
    rng = np.random.default_rng(1)
    m, w, ball, bodies = random_scene(core, rng, gap, **FRICTIONLESS)
    longest = m.d.pocket.a_delta * np.sqrt(np.max(np.asarray(w.delta_c)[:, :Z]))
    assert (longest > 1.1 * (R + gap)) == (gap < GAP)
    axes = frames(ball["theta"])
    sides = (-1, 1)
    F, M = on_ball(w)
    h = 1e-9
    for j in range(Z):
        place = axes[j].T @ [ball["x"][j], ball["r"][j], 0.0]
        total = np.zeros(3)
        for index, (side, body) in enumerate(zip(sides, bodies, strict=True)):
            steps = h * np.eye(3)
            gradient = np.array(
                [
                    (energy(m, gap, place + e, body, j, side) - energy(m, gap, place - e, body, j, side)) / (2 * h)
                    for e in steps
                ]
            )
            spin = np.array(
                [
                    (
                        energy(m, gap, place, turned(body, e / R_PITCH), j, side)
                        - energy(m, gap, place, turned(body, -e / R_PITCH), j, side)
                    )
                    for e in steps
                ]
            )
            spin /= 2 * h / R_PITCH
            F_half, M_half = (part[j] for part in pocket_wrench(m, index))
            scale = np.abs(gradient).max() + 1.0
            assert F_half == pytest.approx(gradient, abs=2e-6 * scale)
            assert M_half == pytest.approx(-spin, abs=2e-6 * scale * R_PITCH)
            total -= gradient
        assert axes[j].T @ F[j] == pytest.approx(total, abs=2e-6 * (np.abs(total).max() + 1.0))
    assert not M.any()


@pytest.mark.parametrize("lubrication", Lubrication)
def test_momentum_and_power(core, lubrication):
    """Momentum and energy of balls and halves, dry and wet."""
    scene = random_scene(core, np.random.default_rng(2), **{"scene.lubrication": lubrication})
    assert_balanced(*scene, lambda *place: energy(scene[0], GAP, *place))


# ------------------------------------------------------------------------------------------------------------- friction


@pytest.mark.parametrize("speed", [0.05, 0.2, 20.0])
def test_friction(core, speed):
    """Sliding across the contact: mu Q v/sqrt(v^2 + v_c^2) on the ball's surface, mu = 0.05, v_c = 0.2 m/s; its moment
    mu Q R.
    """
    m, w = one_ball(core, 0.0, GAP + 2e-6, omega=(speed / R, 0.0, 0.0), **{"oil.rolling": 0.0, "cage.lambda": 0.0})
    Q = m.d.pocket.K * 2e-6**1.5
    F, M = on_ball(w)
    angle = np.arcsin((GAP + 2e-6) / R_PITCH)
    friction = 0.05 * Q * speed / np.hypot(speed, 0.2)
    assert M[0, 0] == pytest.approx(-friction * R, rel=1e-8)
    normal, along = np.array([0.0, np.sin(angle), np.cos(angle)]), np.array([0.0, np.cos(angle), -np.sin(angle)])
    # the surface moves inward: friction pushes the ball outward
    assert F[0] @ along == pytest.approx(friction, rel=1e-8)
    assert F[0] @ normal == pytest.approx(-Q, rel=1e-8)
    assert w.dissipated[0] == pytest.approx(friction * speed, rel=1e-8)


def test_inlet_friction(core):
    """With mu = 0: -F_R on the surface (its moment F_R R), +2 F_R through the centre (R_x = R), F_R by Houpert at the
    mean speed v/2.
    """
    speed = 10.0
    m, w = one_ball(core, 0.0, GAP + 2e-6, omega=(speed / R, 0.0, 0.0), **{"cage.mu": 0.0, "cage.lambda": 0.0})
    E_prime = 2.0 / ((1 - 0.3**2) / 207e9 + (1 - 0.33**2) / 110e9)
    R_y = R * (R + GAP) / GAP
    F_R = 0.0
    for Q in pocket_loads(m)[:, 0]:  # both halves are contacts of their own
        U, W = 6e-3 * 0.5 * speed / (E_prime * R), Q / (E_prime * R**2)
        F_R += (
            2.86
            * E_prime
            * R**2
            * (R_y / R) ** 0.348
            * (13e-9 * E_prime) ** 0.022
            * U**0.66
            * W**0.47
            * (1.0 + 1.0 / Q) ** -0.53
        )
    F, M = on_ball(w)
    angle = np.arcsin((GAP + 2e-6) / R_PITCH)
    assert F_R > 0.02
    assert M[0, 0] == pytest.approx(-F_R * R, rel=1e-5)  # the floor of the mean speed, 0.01 m/s: 2e-6
    assert F[0] @ [0.0, np.cos(angle), -np.sin(angle)] == pytest.approx(F_R - 2.0 * F_R, rel=1e-5)


def test_damping(core):
    """Q (1 + lambda delta_dot), lambda = 1 s/m: approaching at 0.3 m/s the load is 1.3 times the elastic one."""
    angle = np.arcsin((GAP + 2e-6) / R_PITCH)
    v = 0.3 * np.array([0.0, np.sin(angle), np.cos(angle)])
    m, _w = one_ball(core, 0.0, GAP + 2e-6, v=v, **{"cage.mu": 0.0, "oil.rolling": 0.0})
    assert pocket_loads(m)[0, 0] == pytest.approx(1.3 * 0.5 * m.d.pocket.K * 2e-6**1.5, rel=1e-8)


@pytest.mark.parametrize(
    ("speed", "delta", "regime"), [(20.0, 2e-7, "rigid"), (2.0, 5e-6, "piezo"), (0.05, 2e-6, "boundary")]
)
def test_mixed_friction(core, speed, delta, regime):
    """mu + exp(-1.8 Lambda^1.2)(mu_b - mu), Lambda from the thicker of two films at the mean speed, written out; sigma
    = 0.6 um, mu_b = 0.12.

    Piezoviscous: Hamrock & Dowson (1977); isoviscous-rigid: Brewe, Hamrock & Taylor (1979).
    """
    parameters = {"oil.rolling": 0.0, "cage.lambda": 0.0, "cage.v_c": 1e-3, "scene.lubrication": Lubrication.MIXED}
    m, w = one_ball(core, 0.0, GAP + delta, omega=(speed / R, 0.0, 0.0), **parameters)
    Q = pocket_loads(m)[0, 0]
    E_prime = 2.0 / ((1 - 0.3**2) / 207e9 + (1 - 0.33**2) / 110e9)
    u, alpha_r = np.hypot(0.5 * speed, 0.01), (R + GAP) / GAP
    U, W, G = 6e-3 * u / (E_prime * R), (Q + 1.0) / (E_prime * R**2), 13e-9 * E_prime  # the load's floor is 1 N
    piezo = 2.69 * U**0.67 * G**0.53 * W**-0.067 * (1.0 - 0.61 * np.exp(-0.73 * m.d.pocket.k)) * R
    rigid = (
        128.0
        * alpha_r
        / (1.0 + 0.698 / alpha_r) ** 2
        * (0.131 * np.arctan(0.5 * alpha_r) + 1.683) ** 2
        * (U / W) ** 2
        * R
    )
    assert (rigid > piezo) == (regime == "rigid")
    share = np.exp(-1.8 * (max(piezo, rigid) / 0.6e-6) ** 1.2)
    assert {"rigid": share < 0.05, "piezo": 0.05 < share < 0.95, "boundary": share > 0.8}[regime]
    mu = 0.05 + share * (0.12 - 0.05)
    _, M = on_ball(w)
    assert -M[0, 0] / (R * pocket_loads(m)[:, 0].sum()) == pytest.approx(mu * speed / np.hypot(speed, 1e-3), rel=1e-8)
