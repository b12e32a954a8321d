"""Film of oil between ball and sphere of a ribbon's half: Reynolds' equation on the whole cap and at a straight edge, the closed
form, filling, floor, a ball that is pressed in, parts of a step.
"""

from types import SimpleNamespace

import numpy as np
import pytest
from mechanics import assert_step_gets_film, pocket_loads
from scipy.integrate import quad
from skfem import Basis, BilinearForm, ElementQuad2, LinearForm, MeshQuad, MeshQuad2, condense, solve
from test_pocket_spheres import EDGE, FILLET, R_PITCH, WIDTH, E, R, on_pocket, one_ball

from bearing_model.cage.common.spheres_squeeze import squeeze_edge

TWINS = True
ETA, SLACK = 6e-3, 1e-4  # default oil; R_c - R of tests/ribbon.py
SLOW = 1e-9  # so slow that the floor of the gap is below 4 nm
WET = {
    "cage.mu": 0.0,
    "cage.lambda": 0.0,
    "oil.sigma_pocket": 1e-9,
    "oil.eta": ETA,
    "cage.pocket_filling": 1.0,
}


def cap_of(slack=SLACK, e=E, fillet=FILLET):
    """A half's cap: ends chi_1 and eta, radii."""
    radius = R + slack
    chi_1 = np.arcsin((fillet + e) / (radius + fillet))
    eta = np.arcsin((0.5 * WIDTH - EDGE) / (radius + EDGE))
    return SimpleNamespace(slack=slack, e=e, fillet=fillet, radius=radius, chi=chi_1, eta=eta)


CAP = cap_of()
NARROW = cap_of(
    slack=0.5e-4, e=0.2e-4, fillet=1.95e-3
)  # half the clearance; sin chi_1 = 0.65 sin chi_0, the rule's limit


def sizes(cap):
    depth = cap.radius - cap.e
    return {
        "cage.pocket_clearance": 2.0 * cap.slack,
        "cage.pocket_depth": depth,
        "cage.pocket_fillet": cap.fillet,
        "cage.width": 2.0 * (depth + 9e-4),
    }


def direction(chi, zeta):
    """Unit vectors (x, r, t) by their angles round the pocket's radius and toward it."""
    return np.array([np.cos(zeta) * np.sin(chi), np.sin(zeta) + 0.0 * chi, np.cos(zeta) * np.cos(chi)])


# --------------------------------------------------------------------------------------------------- Reynolds' equation


def graded(first, last, at, grade, count):
    """Places from first to last, close together at the one nearest to `at`."""
    at = np.clip(at, first, last)
    ends = np.arcsinh((np.array([first, last]) - at) / grade)
    x = at + grade * np.sinh(np.linspace(*ends, count + 1))
    x[[0, -1]] = first, last
    return x


def reynolds(cap, n, h, layer=np.inf, cells=(40, 26)):
    """Force (x, r, t)/(eta v) of a ball that closes in along n at the gap h, by finite elements on the cap: div (gap^3 grad p) = -12 n.u
    on a sphere of the radius sqrt(R R_c), p = 0 at the seam, at both edges and where the gap is more than `layer`.
    """
    part = h / cap.slack
    S, width = 1.0 - part, 0.5 * np.sqrt(2.0 * part)
    half = 0.5 * np.pi - cap.chi
    along = graded(-half, half, np.arctan2(n[0], n[2]) - 0.5 * np.pi, width, cells[0]) / half
    across = graded(-cap.eta, cap.eta, np.arcsin(n[1]), width, cells[1])
    mesh = MeshQuad2.from_mesh(MeshQuad.init_tensor(along, across))
    place, zeta = mesh.doflocs
    ends = 0.5 * np.pi - np.arcsin(np.sin(cap.chi) / np.cos(zeta))  # the seam lies in a plane
    basis = Basis(MeshQuad2(np.array([0.5 * np.pi + place * ends, zeta]), mesh.t), ElementQuad2(), intorder=6)

    def gap(x):
        return 1.0 - S * np.tensordot(n, direction(*x), 1)

    @BilinearForm
    def flow(p, q, w):
        cosine = np.cos(w.x[1])
        return gap(w.x) ** 3 * (p.grad[0] * q.grad[0] / cosine + cosine * p.grad[1] * q.grad[1])

    def loads(axis):
        return LinearForm(lambda q, w: np.cos(w.x[1]) * direction(*w.x)[axis] * q).assemble(basis)

    load = np.array([loads(axis) for axis in range(3)])
    dry = np.flatnonzero(gap(basis.doflocs) > layer / cap.slack)
    ends = np.union1d(basis.get_dofs().flatten(), dry)
    p = solve(*condense(flow.assemble(basis), n @ load, D=ends))
    return 12.0 * (R * cap.radius) ** 2 / cap.slack**3 * (load @ p)


def half_plane(s, far=200.0, cells=(64, 56)):
    """Force of the film in the gap 1 + x^2 + y^2 beyond a straight edge at x = -s over that of a whole film, pi/8: by finite elements."""
    x, y = graded(-s, far, 0.0, 0.5, cells[0]), graded(0.0, far, 0.0, 0.5, cells[1])
    basis = Basis(MeshQuad.init_tensor(x, y), ElementQuad2(), intorder=6)
    flow = BilinearForm(
        lambda p, q, w: (1.0 + w.x[0] ** 2 + w.x[1] ** 2) ** 3 * (p.grad[0] * q.grad[0] + p.grad[1] * q.grad[1])
    )
    load = LinearForm(lambda q, w: q).assemble(basis)
    ends = basis.get_dofs(lambda x: (np.abs(x[0] + s) < 1e-9) | (x[0] > far - 1e-9) | (x[1] > far - 1e-9))
    p = solve(*condense(flow.assemble(basis), load, D=ends))
    return 2.0 * (load @ p) / (np.pi / 8.0)


def test_straight_edge():
    """E(s) of a film that ends at a straight edge: 0.5 % of Reynolds' equation for s > 0, 2 % down to s = -3; observed 0.4, 1.9 %."""
    for s, bound in (
        (-3.0, 0.02),
        (-1.5, 0.02),
        (-0.5, 0.02),
        (0.0, 5e-3),
        (0.5, 5e-3),
        (1.0, 5e-3),
        (2.0, 5e-3),
        (6.0, 5e-3),
    ):
        assert squeeze_edge(s, 1.0) == pytest.approx(half_plane(s), rel=bound)


def closing(core, n, h, speed=SLOW, cap=CAP, **changes):
    """Model and Work with every ball at the gap h from the sphere of half 1, closing in along n."""
    x, r, t = (cap.slack - h) * np.asarray(n) - np.array([cap.e, 0.0, 0.0])
    turn = np.arctan2(t, R_PITCH + r)  # of the ball's frame against the pocket's
    v = speed * np.array([n[0], n[1] * np.cos(turn) + n[2] * np.sin(turn), n[2] * np.cos(turn) - n[1] * np.sin(turn)])
    return one_ball(core, x, r, t, v=v, **(sizes(cap) | WET | changes))


def film(core, n, h, speed=SLOW, cap=CAP, **changes):
    """Force (x, r, t) of the film on half 1 over the speed."""
    return on_pocket(closing(core, n, h, speed, cap, **changes)[0], 1) / speed


def off(found, exact):
    """Error of a force's size, and its angle to the exact one [deg]."""
    sizes = np.linalg.norm(found), np.linalg.norm(exact)
    return sizes[0] / sizes[1] - 1.0, np.rad2deg(np.arccos(min(1.0, found @ exact / (sizes[0] * sizes[1]))))


PARTS = (0.003, 0.01, 0.03, 0.08, 0.2, 0.45, 0.7)  # of the clearance


def errors(core, cap, directions, parts=PARTS):
    """Largest error of force and angle over directions and gaps."""
    found = [
        off(film(core, n, part * cap.slack, cap=cap), ETA * reynolds(cap, n, part * cap.slack))
        for n in directions
        for part in parts
    ]
    size, angle = np.abs(found).max(axis=0)
    return size, angle


@pytest.mark.parametrize(("cap", "bounds"), [(CAP, (0.03, 3.0)), (NARROW, (0.08, 5.0))], ids=["ribbon", "narrow"])
def test_force_is_that_of_reynolds_equation(core, cap, bounds):
    """Directions of a ball that is pushed along the circle, chi_0 to the pole, and up to 0.9 eta aside: 3 % and 3 degrees, observed 2.8 % and
    2.7; where the seam comes to 8 degrees from chi_0, 8 % and 5 degrees, observed 7.0 % and 4.8.
    """
    chi_0 = np.arcsin(cap.e / cap.slack)
    directions = [
        direction(chi, part * cap.eta)
        for chi in (chi_0, 0.75 * chi_0 + 0.4, 1.05, 0.5 * np.pi)
        for part in (0.0, 0.5, -0.9)
    ]
    size, angle = errors(core, cap, directions)
    assert size < bounds[0]
    assert angle < bounds[1]


def test_above_the_pole_the_coefficient_is_exact(core):
    """80 degrees from the split the law has Reynolds' own P: 0.6 %, observed 0.3 %; an error of 1 % in c would show."""
    size, angle = errors(core, CAP, [direction(np.deg2rad(80.0), 0.0)])
    assert size < 6e-3
    assert angle < 0.5


def test_closed_form(core):
    """c v/h of two whole spheres, 6 pi eta R_eff^2 v/h, less 0.6/s^2 for each edge: at C/1000, to 0.2 %; the edges take 1.3 %."""
    h, l_2 = 1e-3 * SLACK, 2e-3
    edges = np.array([(1.0 - np.sin(CAP.chi)) / np.cos(CAP.chi), np.tan(CAP.eta), np.tan(CAP.eta)])
    expected = 6.0 * np.pi * ETA * (R * CAP.radius / SLACK) ** 2 / h * (1.0 - 0.6 * l_2 * np.sum(edges**-2.0))
    found = film(core, direction(0.5 * np.pi, 0.0), h)
    assert np.linalg.norm(found) == pytest.approx(expected, rel=2e-3)


def test_outside_of_the_stated_directions(core):
    """Down to the seam 20 % and 20 degrees; beyond an edge, up to 5 degrees off, 15 % and 17 degrees."""
    below = [direction(chi, part * CAP.eta) for chi in np.linspace(CAP.chi + 0.02, 0.5, 3) for part in (0.0, 0.6)]
    size, angle = errors(core, CAP, below)
    assert size < 0.2
    assert angle < 20.0
    beyond = [direction(chi, CAP.eta + np.deg2rad(5.0)) for chi in (0.5 * np.pi, 0.8, 0.55)]
    size, angle = errors(core, CAP, beyond)
    assert size < 0.15
    assert angle < 17.0


# ---------------------------------------------------------------------------------------------------------- oil and floor


@pytest.mark.parametrize("filling", [0.05, 0.2, 0.5])
def test_a_layer_limits_the_film(core, filling):
    """The film ends where the oil of a layer t, pushed aside on a disc, fills the gap, h_m = 2 t - h: within 12 % of Reynolds' equation with
    p = 0 from there on, for h < 0.6 t; nothing where h > t.  Observed 11 % at 0.6 t, 5 % at 0.4 t.
    """
    t = filling * SLACK
    for n in (direction(np.deg2rad(80.0), 0.0), direction(np.deg2rad(30.0), 0.0)):
        for part in (0.05, 0.2, 0.4, 0.6):
            h = part * t
            limited = ETA * np.linalg.norm(reynolds(CAP, n, h, 2.0 * t - h, cells=(90, 60)))
            found = np.linalg.norm(film(core, n, h, **{"cage.pocket_filling": filling}))
            assert found == pytest.approx(limited, rel=0.12)
        assert np.linalg.norm(film(core, n, 1.001 * t, **{"cage.pocket_filling": filling})) == 0.0


def test_a_thin_layer_is_a_disc(core):
    """Far within the edges the closed form (c v/h) (1 - h/h_m)^2 with h_m = 2 t - h: a layer of C/50, 0.6 %."""
    t, c = 0.02 * SLACK, 6.0 * np.pi * ETA * (R * CAP.radius / SLACK) ** 2
    for part in (0.2, 0.3, 0.5):
        h = part * t
        found = np.linalg.norm(film(core, direction(0.5 * np.pi, 0.0), h, **{"cage.pocket_filling": 0.02}))
        full = 1.0 - h / (2.0 * SLACK - h)  # over that of a full pocket
        assert found == pytest.approx(c / h * ((1.0 - h / (2.0 * t - h)) / full) ** 2, rel=6e-3)


def test_a_full_pocket_is_the_limit(core):
    """Filling 1 is wet to the ends at every gap: a little less changes little, and no filling is no force."""
    n = direction(0.8, 0.1)
    for h in (1e-6, 2e-5, 7e-5):
        full = film(core, n, h)
        assert film(core, n, h, **{"cage.pocket_filling": 0.999}) == pytest.approx(full, rel=8e-3, abs=1e-12)
        assert not film(core, n, h, **{"cage.pocket_filling": 0.0}).any()


def test_floor(core):
    """h_eff^2 = h^2 + sigma^2 + h_e^2, h_e = 1.5 (c v/K)^0.4, with the sphere's K: at the pole as the force of the law at h_eff without
    a floor, and in contact falling with the approach.
    """
    n, speed, sigma = direction(0.5 * np.pi, 0.0), 0.3, 0.6e-6
    K = closing(core, n, 1e-5)[0].d.spheres.K
    h_e = 1.5 * (6.0 * np.pi * ETA * (R * CAP.radius / SLACK) ** 2 * speed / K) ** 0.4
    floor = np.hypot(sigma, h_e)
    assert 5e-6 < floor < 1e-5
    for ratio in (0.5, 1.0, 3.0):
        h = ratio * floor
        found = np.linalg.norm(film(core, n, h, speed, **{"oil.sigma_pocket": sigma}))
        assert found == pytest.approx(np.linalg.norm(film(core, n, np.hypot(h, floor))), rel=0.02)
    dry = {"cage.pocket_filling": 0.0}
    rough = {"oil.sigma_pocket": sigma}
    touched = [
        np.linalg.norm(film(core, n, -d, speed, **rough)) - np.linalg.norm(film(core, n, -d, speed, **(rough | dry)))
        for d in (1e-9, floor)
    ]
    at_pole = (1.0 - np.sin(CAP.chi)) / np.cos(CAP.chi), np.tan(CAP.eta), np.tan(CAP.eta)
    edges = [np.prod([squeeze_edge(s_l, 2.0 * f * floor / SLACK) for s_l in at_pole]) for f in (1.0, np.sqrt(2.0))]
    assert touched[1] / touched[0] == pytest.approx(np.sqrt(0.5) * edges[1] / edges[0], rel=0.02)


# ------------------------------------------------------------------------------------------------------------------ motion


def test_a_ball_that_is_pressed_in(core):
    """Under a constant force F the gap falls as h = h_0 exp(-F t/c) of the closed form: from C/500 to a quarter, 2 %; observed 1.4 %,
    by which the edges make the film weaker.
    """
    n, h_0, F = direction(0.5 * np.pi, 0.0), 2e-3 * SLACK, 1e-3
    D = lambda h: np.linalg.norm(film(core, n, h))
    time = quad(lambda ln_h: D(np.exp(ln_h)) * np.exp(ln_h) / F, np.log(0.25 * h_0), np.log(h_0), epsrel=1e-4, limit=8)[
        0
    ]
    c = 6.0 * np.pi * ETA * (R * CAP.radius / SLACK) ** 2
    assert time == pytest.approx(c / F * np.log(4.0), rel=0.02)
    assert time < c / F * np.log(4.0)


def test_no_suction(core):
    """A ball that withdraws meets no force, and loses none; one that closes in loses F v, by its half's film alone."""
    n = direction(0.8, 0.1)
    m, w = closing(core, n, 1e-5, speed=-0.1)
    assert not on_pocket(m, 1).any() and pocket_loads(m)[1, 0] == 0.0
    m, w = closing(core, n, 1e-5, speed=0.1)
    lost = 0.1 * on_pocket(m, 1) @ n + 0.1 * on_pocket(m, 0) @ n
    assert w.dissipated[0] == pytest.approx(lost, rel=1e-9)
    assert w.pocket_dissipated[0] == w.dissipated[0] > 1e-3


def test_the_step_gets_the_film(core):
    n, h = direction(0.7, 0.15), 2e-5
    x, r, t = (SLACK - h) * n - [E, 0.0, 0.0]
    assert_step_gets_film(lambda dv: one_ball(core, x, r, t, v=0.05 * n + dv, **WET)[1], least=10.0)
