"""Races that are not perfect: waves and spalls against geometry, energy and published rules."""

from dataclasses import replace

import numpy as np
import pytest
from mechanics import SLICE, Instance, View, place_balls, pose, ring_wrench
from scipy.optimize import brentq, fsolve

from bearing_model.generated import variables
from bearing_model.physics.parameters import Parameters
from bearing_model.physics.rhs import rhs

TWINS = True
Z, D, D_M = variables.Z, variables.PARAMETERS["bearing.D"].start, variables.PARAMETERS["bearing.d_m"].start
BOTTOM = {"inner": 0.5 * (D_M - D), "outer": 0.5 * (D_M + D)}  # radius of the groove's bottom
SIGN = {"inner": -1.0, "outer": 1.0}
WAVES = variables.PARAMETERS["outer.waviness[n]"].count


def spall(race, length, depth, width=0.9 * D, angle=0.0, edge=1e-6):
    values = {"angle": angle, "length": length, "width": width, "depth": depth, "edge": edge}
    return {f"{race}.spall_{name}": value for name, value in values.items()}


def waves(race, amplitudes, phases=None):
    """Parameters of waves {order: amplitude} with phases {order: phase}."""
    rows = np.zeros((2, WAVES))
    for row, values in zip(rows, (amplitudes, phases or {}), strict=True):
        for order, value in values.items():
            row[order - 1] = value
    return {f"{race}.waviness[n]": rows[0].tolist(), f"{race}.waviness_phase[n]": rows[1].tolist()}


EVERYTHING = (
    waves("outer", {3: 5e-7, 8: 1e-6, 10: 2e-6, 60: 2e-8}, {3: 1.0, 8: -2.0, 60: 0.3})
    | waves("inner", {2: 2e-6, 9: 1e-6, 17: 3e-7}, {2: 0.4, 17: 5.0})
    | spall("outer", 6e-3, 4e-5, width=1.5e-3, angle=0.03, edge=2e-4)
    | spall("inner", 5e-3, 1e-4, width=4e-3, angle=-1.3, edge=1e-3)
)


def as_arrays(core, parameters):
    return (
        parameters
        if core.name != "Python"
        else {name: np.array(value) if isinstance(value, list) else value for name, value in parameters.items()}
    )


def model_of(core, parameters, inputs=None):
    core.name = getattr(core, "name", "C")
    return core.model(parameters=as_arrays(core, parameters), inputs=inputs)


def set_angles(model, inner, outer=0.0):
    """The model's rhs and contacts at these angles of the rings."""
    if model.core.name == "Python":
        load = model.model

        def turned(t=0.0):
            now = type(model).model(model, t)
            now.ring_load = replace(now.ring_load, inner_angle=inner, outer_angle=outer)
            return now

        model.model = turned
        return load
    model.ring_load.inner_angle, model.ring_load.outer_angle = inner, outer


def rhs_at(model, y, inner, outer=0.0):
    """dy/dt with the rings at these angles; the work struct keeps all results."""
    set_angles(model, inner, outer)
    if model.core.name == "Python":
        return rhs(model.model(), 0.0, y, model.work.w)
    y, y_dot = np.ascontiguousarray(y), np.empty(len(y))
    model.kernel("rhs")(model.pointer, 0.0, model.core.array(y), model.core.array(y_dot), model.work)
    return y_dot


def contacts(model, theta, press=5e-6, x=0.0, ring_x=(0.0, 0.0, 0.0), angle=0.0):
    """Results of the races for balls at rest at the azimuths theta, pressed outward by `press` from the middle."""
    d = model.d
    pose(model.core, model.work.ring, ring_x)
    r = 0.5 * (d.inner.R_g + d.outer.R_g + (d.outer.r_g - d.inner.r_g)) + 0.25 * model.p.bearing.P_d + press
    w = place_balls(model, x, r + 0.0 * theta, theta)
    set_angles(model, angle, 0.3 * angle)
    model.kernel("race_contact_force")(model.pointer, model.work)
    return View(model.core, model.work) if model.core.name != "Python" else w


def delta(w, race):
    return np.array(w.delta_i if race == "inner" else w.delta_e)[:Z].copy()


def path_of_rigid_ball(race, s):
    """How far a rigid ball's centre leaves its circle where its contact with the track is the length s beyond a sharp
    edge: its centre is R from the edge, by the law of cosines R^2 = R_o^2 + r^2 - 2 R_o r cos(s/R_o).
    """
    R, R_o, side = 0.5 * D, BOTTOM[race], SIGN[race]
    r_0 = R_o - side * R

    def distance(f):
        r = r_0 + side * f
        return np.sqrt(R_o**2 + r**2 - 2.0 * R_o * r * np.cos(s / R_o)) - R

    return brentq(distance, -1e-12, 1e-3)


@pytest.mark.parametrize("race", ["inner", "outer"])
def test_ball_turns_about_the_edge(core, race):
    """The drop beyond an edge is that of a rigid ball on a sharp edge, whose exact circle the parabola u^2/(2 R_x) meets
    to u^2/(4 R^2) and more on the outer race: 0.6 % at 0.8 mm.  In the middle of a short spall it is length^2/(8 R_x).
    """
    length, angle = 4e-3, 0.4
    perfect, spalled = model_of(core, {}), model_of(core, spall(race, length, 2e-4, angle=angle))
    u = np.array([1e-5, 5e-5, 1e-4, 2e-4, 3e-4, 4e-4, 5e-4, 6e-4, 8e-4])
    for side in (-1.0, 1.0):
        theta = angle + side * (0.5 * length - u) / BOTTOM[race]
        f = delta(contacts(perfect, theta, 3e-5 * SIGN[race]), race) - delta(
            contacts(spalled, theta, 3e-5 * SIGN[race]), race
        )
        np.testing.assert_allclose(f, [path_of_rigid_ball(race, s) for s in u], rtol=7e-3, atol=1e-12)
    outside = angle + (0.5 * length + np.linspace(1e-6, 1e-3, Z)) / BOTTOM[race]
    np.testing.assert_allclose(
        delta(contacts(spalled, outside), race), delta(contacts(perfect, outside), race), atol=1e-17
    )


def test_bottom_and_short_spall(core):
    """A long spall lets the ball down by its depth; a short one by length^2/(8 R_x) less the rounding, c/length of it."""
    at = np.zeros(Z)
    free = delta(contacts(model_of(core, {}), at), "outer")
    deep = model_of(core, spall("outer", 5e-3, 5e-5))
    np.testing.assert_allclose(free - delta(contacts(deep, at), "outer"), 5e-5, rtol=1e-9)
    R_x = 1.0 / (2.0 / D - 1.0 / BOTTOM["outer"])
    short = model_of(core, spall("outer", 5e-4, 5e-5))
    drop = free - delta(contacts(short, at), "outer")
    np.testing.assert_allclose(drop, 5e-4**2 / (8.0 * R_x), rtol=5e-3)  # c/length = 2e-3, twice


@pytest.mark.parametrize("race", ["inner", "outer"])
def test_height_of_waves(core, race):
    """The approach grows by sum A_n cos(n phi + phase_n), phi against the ring that has turned: to the error of cubic Hermite
    polynomials in 512 cells, h^4/384 n^4 A_n, 7.6e-4 of A_60 (observed 7.6e-4).
    """
    amplitudes, phases = {1: 4e-7, 9: 1e-6, 60: 1e-7}, {1: 0.7, 9: -1.1, 60: 3.0}
    theta, angle = np.linspace(0.1, 6.0, Z), 0.83
    perfect, wavy = model_of(core, {}), model_of(core, waves(race, amplitudes, phases))
    phi = theta - (angle if race == "inner" else 0.3 * angle)
    w = sum(amplitudes[n] * np.cos(n * phi + phases[n]) for n in amplitudes)
    rise = delta(contacts(wavy, theta, angle=angle), race) - delta(contacts(perfect, theta, angle=angle), race)
    table = sum(amplitudes[n] * (2.0 * np.pi * n / 512) ** 4 / 384.0 for n in amplitudes)
    np.testing.assert_allclose(rise, w, rtol=0.0, atol=table + 1e-14 * D)


def test_waves_have_no_seam(core):
    """Around the angle where the table begins, and across its cells, height and force along the track are continuous:
    neighbours 1e-9 rad apart differ by less than 1e-9 rad of the steepest waves, n A and n^2 A.
    """
    model = model_of(core, waves("outer", {9: 1e-6, 60: 1e-6}, {9: 0.4, 60: 1.0}))
    joint = np.pi + 2.0 * np.pi / 512 * np.array([0, 0, 1, 2, 100, 200, 256, 300, 511])
    found = []
    for side in (-5e-10, 5e-10):
        w = contacts(model, joint + side, press=1e-5)
        found.append((delta(w, "outer"), np.array(w.F_t)[:Z].copy(), np.array(w.Q_e)[:Z].copy()))
    np.testing.assert_allclose(found[0][0], found[1][0], rtol=0.0, atol=1e-9 * 69e-6 + 1e-14 * D)
    q = (found[0][1] - found[1][1]) / found[0][2]
    np.testing.assert_allclose(q, 0.0, atol=1e-9 * 3700e-6 / BOTTOM["outer"] * 2.0 + 1e-10)


def stored(w):
    return np.array(w.race_stored)[:Z].copy()


def slope(energy, h=1e-9):
    """Derivative at 0 by a difference quotient of fourth order."""
    return (8.0 * (energy(h) - energy(-h)) - (energy(2.0 * h) - energy(-2.0 * h))) / (12.0 * h)


@pytest.mark.parametrize("seed", range(5))
def test_force_is_the_gradient_of_the_energy(core, seed):
    """Of balls at rest: forces along x, r and t against difference quotients of their energies, moments on the rings
    against a turn of both.  Fourth order with steps of 1 nm, rounding 1e-16 r K delta^1.5/h: 2e-7 of the load.
    """
    model, rng = model_of(core, EVERYTHING | {"bearing.P_d": -4e-5}), np.random.default_rng(seed)
    # within 0.8 mm of an edge of either spall; the rings have turned by 0.06 and 0.2
    edge = [
        rng.choice([-1.0, 1.0], n) * (0.5 * length - rng.uniform(-1e-4, 8e-4, n))
        for n, length in ((4, 6e-3), (5, 5e-3))
    ]
    near = 0.06 + 0.03 + edge[0] / BOTTOM["outer"], 0.2 - 1.3 + edge[1] / BOTTOM["inner"]
    theta, press, x = np.concatenate(near), rng.uniform(-1e-5, 1e-5, Z), rng.uniform(-3e-5, 3e-5, Z)
    ring_x = (3e-6, -4e-6, 5e-6)
    w = contacts(model, theta, press, x, ring_x, 0.2)
    F, r = np.array([list(w.F_x)[:Z], list(w.F_r)[:Z], list(w.F_t)[:Z]]), np.array(w.r)[:Z].copy()
    load = (np.array(w.Q_i)[:Z] + np.array(w.Q_e)[:Z]).max()
    assert np.abs(F[2]).max() > 3e-4 * load  # a thousand times the tolerance
    inner = ring_wrench(w)[1][:, 0].copy()
    outer = -(F[2] * r) - inner - np.cross(np.array(ring_x), ring_wrench(w)[0])[:, 0]
    found = np.array(
        [
            -slope(lambda e: stored(contacts(model, theta, press, x + e, ring_x, 0.2))),
            -slope(lambda e: stored(contacts(model, theta, press + e, x, ring_x, 0.2))),
            -slope(lambda e: stored(contacts(model, theta + e / r, press, x, ring_x, 0.2))),
        ]
    )
    np.testing.assert_allclose(found, F, atol=2e-7 * load + 1e-6)
    # a turn of the inner ring, and of the outer one by 0.3 of it, does the work of both moments
    turn = -slope(lambda e: stored(contacts(model, theta, press, x, ring_x, 0.2 + e / r[0]))) * r[0]
    np.testing.assert_allclose(turn, inner + 0.3 * outer, atol=2e-7 * r[0] * load)


def narrow_contact(race, K, a_delta, b, f, delta):
    """Load of strips, by quadrature, as a check on the closed form."""
    xi = np.linspace(-1.0, 1.0, 400001) * a_delta * np.sqrt(delta)
    gap = np.where(np.abs(xi) < b, f, 0.0)
    q = np.maximum(delta - gap - (xi / a_delta) ** 2, 0.0)
    return K * 0.75 / a_delta * np.trapezoid(q, xi)


@pytest.mark.parametrize("width", [0.3e-3, 1.0e-3, 2.5e-3])
def test_narrow_spall_loads_its_flanks(core, width):
    """Load of a ball over a spall narrower than its ellipse against a quadrature over strips: 1e-5 by the kinks at the
    spall's sides.
    """
    model = model_of(core, spall("outer", 6e-3, 8e-6, width=width))
    w = contacts(model, np.zeros(Z), press=np.linspace(2e-6, 3e-5, Z))
    perfect = delta(contacts(model_of(core, {}), np.zeros(Z), press=np.linspace(2e-6, 3e-5, Z)), "outer")
    Q = np.array(w.Q_e)[:Z]
    hertz = model.d.outer.hertz
    expected = [narrow_contact("outer", hertz.K, hertz.a_delta, 0.5 * width, 8e-6, x) for x in perfect]
    np.testing.assert_allclose(Q, expected, rtol=1e-4)


def test_quasi_static_crossing(core):
    """The ring's displacement while a ball crosses a spall under radial load, against the closed form: three balls that
    carry, Q_j = K' (delta_j - f)^1.5 with K' of both contacts in line, at every place of the spall; 1 % of the largest.
    """
    F, length, depth = 3000.0, 1.6e-3, 4e-5
    inputs = {"shaft.F_x": 0.0, "shaft.F_y": F, "shaft.omega": 0.0}
    base = {"bearing.P_d": 0.0, "scene.cage": 1}
    d = model_of(core, base).d
    K = (d.inner.hertz.K ** (-2 / 3) + d.outer.hertz.K ** (-2 / 3)) ** -1.5
    psi = 2.0 * np.pi * np.arange(Z) / Z
    R_x = 1.0 / (2.0 / D - 1.0 / BOTTOM["outer"])

    def balance(u, f):
        approach = 1e-6 * (u[0] * np.cos(psi) + u[1] * np.sin(psi)) - f  # u in um
        Q = K * np.maximum(approach, 0.0) ** 1.5
        return [1.0 - Q @ np.cos(psi) / F, Q @ np.sin(psi) / F]

    u_0 = fsolve(balance, [20.0, 0.0], np.zeros(Z), xtol=1e-10)
    found, expected = [], []
    for s in np.linspace(-0.9e-3, 0.9e-3, 13):
        start = model_of(core, base | spall("outer", length, depth, angle=s / BOTTOM["outer"]), inputs).start()
        found.append([start[SLICE["ring_y"]][0], start[SLICE["ring_z"]][0]])
        edge = max(0.5 * length - abs(s), 0.0)
        f = np.zeros(Z)
        f[0] = min(depth, edge**2 / (2.0 * R_x))
        expected.append(1e-6 * fsolve(balance, u_0, f, xtol=1e-10))
    found, expected = np.array(found), np.array(expected)
    sink = expected[:, 0] - expected[0, 0]
    assert sink.max() > 5e-6
    np.testing.assert_allclose(found[:, 0] - found[0, 0], sink, atol=0.01 * sink.max())


@pytest.mark.parametrize("race", ["inner", "outer"])
def test_orders_that_move_the_ring(core, race):
    """Under axial load waves of order n = Z k move the ring along its axis, n = Z k +- 1 across it, others do not
    (Wardle 1988, Proc. Inst. Mech. Eng. C 202, 289): over a ball's pitch the amplitude across is A/cos(alpha), because
    sum 2/Z w_j cos psi_j = A.  Second-order terms: A/delta = 1 %.
    """
    A, inputs = 2e-8, {"shaft.F_x": 600.0, "shaft.F_y": 0.0, "shaft.omega": 0.0}
    base = {"start.spacing": 0.0}
    plain_model = model_of(core, base, inputs)
    plain = plain_model.start()
    cos_alpha = abs(plain_model.work.n_ir[0])
    for n in (Z - 2, Z - 1, Z, Z + 1, 2 * Z - 1, 2 * Z + 2):
        moves = []
        for phase in np.linspace(0.0, 2.0 * np.pi, 4, endpoint=False):
            y = model_of(core, base | waves(race, {n: A}, {n: phase}), inputs).start()
            moves.append([y[SLICE[f"ring_{i}"]][0] - plain[SLICE[f"ring_{i}"]][0] for i in "xyz"])
        axial, across = np.abs(np.array(moves)[:, 0]).max(), np.abs(np.array(moves)[:, 1:]).max()
        if n % Z == 0:
            assert axial > 2.0 * A and across < 0.02 * A
        elif n % Z in (1, Z - 1):
            assert across == pytest.approx(A / cos_alpha, rel=0.03) and axial < 0.02 * A
        else:
            assert max(axial, across) < 0.02 * A


@pytest.mark.parametrize(
    ("values", "complaint"),
    [
        ({"outer.spall_length": 1e-3, "outer.spall_depth": 1e-5}, r"outer\.spall_width = 0"),
        ({"inner.spall_width": 1e-3, "inner.spall_depth": 1e-5}, r"inner\.spall_length = 0"),
        (spall("inner", 0.08, 1e-5), r"inner\.spall_length = 0.08 m: at most pi/2 .bearing\.d_m - bearing\.D. = "),
        (spall("outer", 1e-3, 1e-3), r"outer\.spall_depth = 0.001 m: at most bearing\.D/20"),
        (spall("outer", 1e-3, 1e-5, width=0.02), r"outer\.spall_width = 0.02 m: at most bearing\.D"),
    ],
)
def test_refusals(core, values, complaint):
    with pytest.raises(ValueError, match=complaint):
        Parameters(values) if getattr(core, "name", "C") == "Python" else Instance(core, values)


@pytest.mark.c_only
def test_turn_by_a_pitch(core):
    """A bearing whose races have turned by one ball's pitch moves as before with its balls permuted, over 0.3 ms."""
    turn = 2.0 * np.pi / Z
    turned = dict(EVERYTHING)
    for race in ("inner", "outer"):
        turned[f"{race}.spall_angle"] += turn
        n = np.arange(1, WAVES + 1)
        phases = np.array(EVERYTHING[f"{race}.waviness_phase[n]"]) - n * turn
        turned[f"{race}.waviness_phase[n]"] = (np.remainder(phases + np.pi, 2.0 * np.pi) - np.pi).tolist()
    still, spacing = {"shaft.F_x": 600.0, "shaft.F_y": 0.0}, {"start.spacing": 0.0}
    a, b = Instance(core, EVERYTHING | spacing, still).step(3e-4), Instance(core, turned | spacing, still).step(3e-4)
    np.testing.assert_allclose(np.roll(a.output("ball.Q_e"), 1), b.output("ball.Q_e"), rtol=1e-4, atol=0.05)
    assert np.ptp(a.output("ball.Q_e")) > 10.0
