"""Ball and race: geometry under any offset and tilt, momentum, slip and traction against a second formulation in the
global frame, spin.
"""

import numpy as np
import pytest
from mechanics import Instance, Z, axis, frames, on_ball, place_balls, pose, ring_wrench
from scipy.integrate import quad, solve_bvp
from scipy.optimize import minimize_scalar
from scipy.spatial.transform import Rotation
from scipy.special import roots_jacobi

from bearing_model.generated.variables import Lubrication, Switch, Traction

TWINS = True
D, R = 0.0111125, 0.0111125 / 2
DRY = {"oil.A": 0.0, "oil.B": 0.0, "oil.rolling": 0.0}  # no tangential force


def set_ring(model, x, v, frame, Omega):
    pose(model.core, model.work.ring, x, v, frame, Omega)


def contacts(model):
    model.kernel("race_contact_force")(model.pointer, model.work)


def tilted(beta, gamma, spin=0.0):
    """Body axes of a ring: the minimal rotation that takes +X to (a_x, gamma, -beta), after a spin."""
    a = axis(beta, gamma)
    across = np.cross([1.0, 0.0, 0.0], a)
    sine = np.linalg.norm(across)
    turn = Rotation.from_rotvec(across / sine * np.arcsin(sine)) if sine > 0.0 else Rotation.identity()
    return (turn * Rotation.from_rotvec([spin, 0.0, 0.0])).as_matrix()


def closest_on_circle(point, centre, frame, radius):
    """Nearest point of a circle about the frame's first axis, by minimising the distance over the angle."""

    def on_circle(angle):
        return centre + radius * (frame[:, 1] * np.cos(angle) + frame[:, 2] * np.sin(angle))

    guess = np.arctan2(frame[:, 2] @ (point - centre), frame[:, 1] @ (point - centre))
    best = minimize_scalar(
        lambda angle: np.sum((on_circle(angle) - point) ** 2), bracket=(guess - 0.01, guess + 0.013), tol=1e-14
    )
    return on_circle(best.x)


def scene(core, rng, ring_offset=20e-6, tilt=9e-3, **changes):
    """Random balls, all pressed between both races, under a ring with offset and tilt, everything moving."""
    rings = {"bearing.P_d": -30e-6, "scene.growth": Switch.OFF}
    m = core.model(
        parameters=rings | {"scene.traction": Traction.POINT, "scene.heating": Switch.OFF, "oil.K_rs": 0.0} | changes
    )
    theta = 2.0 * np.pi * np.arange(Z) / Z + rng.uniform(-0.1, 0.1, Z)
    frame = tilted(*rng.uniform(-tilt, tilt, 2), spin=rng.uniform(0.0, 6.0))
    centre = rng.uniform(-ring_offset, ring_offset, 3)
    # halfway between both grooves' planes
    x = 0.3 * centre[0] - 0.5 * (frame[1, 0] * np.cos(theta) + frame[2, 0] * np.sin(theta)) * 0.02675
    r = 0.02675 + 0.5 * (centre[1] * np.cos(theta) + centre[2] * np.sin(theta)) + rng.uniform(-4e-6, 4e-6, Z)
    v = np.stack([rng.uniform(-0.1, 0.1, Z), rng.uniform(-0.1, 0.1, Z), r * 757.0 + rng.uniform(-0.3, 0.3, Z)], -1)
    omega = np.stack([-3600.0 + rng.uniform(-50, 50, Z), rng.uniform(-200, 200, Z), rng.uniform(-50, 50, Z)], -1)
    Omega = 1900.0 * frame[:, 0] + rng.uniform(-2.0, 2.0, 3)
    velocity = rng.uniform(-0.05, 0.05, 3)
    set_ring(m, centre, velocity, frame, Omega)
    w = place_balls(m, x, r, theta, v, omega)
    return (
        m,
        w,
        {
            "theta": theta,
            "frame": frame,
            "centre": centre,
            "x": x,
            "r": r,
            "v": v,
            "omega": omega,
            "Omega": Omega,
            "velocity": velocity,
        },
    )


# ------------------------------------------------------------------------------------------------------------- geometry


@pytest.mark.parametrize("tilt", [0.0, 9e-3, 0.3])
def test_geometry_is_exact(core, tilt):
    """Approach and normal at the inner race against the nearest point of the tilted, displaced circle of groove
    centres.

    The minimiser finds the angle to about 1e-9, the distance therefore to rounding: observed 3e-17 m of 56 mm.
    """
    rng = np.random.default_rng(3)
    for _ in range(5):
        m, w, s = scene(core, rng, tilt=tilt, ring_offset=20e-6 if tilt < 0.1 else 1e-3, **DRY)
        contacts(m)
        axes = frames(s["theta"])
        for j in range(Z):
            ball = s["x"][j] * axes[j, 0] + s["r"][j] * axes[j, 1]
            nearest = closest_on_circle(ball, s["centre"], s["frame"], m.d.inner.R_g)
            distance = np.linalg.norm(ball - nearest)
            assert w.delta_i[j] == pytest.approx(distance - (0.515 * D - R), abs=1e-15)
            n = axes[j].T @ [w.n_ix[j], w.n_ir[j], w.n_it[j]]
            assert n == pytest.approx((ball - nearest) / distance, abs=2e-6)  # angle of the minimiser / distance
            # outer race: circle of radius R_g about X at x = 0
            L = np.hypot(s["x"][j], s["r"][j] - m.d.outer.R_g)
            assert w.delta_e[j] == pytest.approx(L - (0.52 * D - R), abs=1e-15)


def test_normal_force(core):
    """Q = K delta^1.5 (1 + lambda delta_dot) along the normal, delta_dot by differences of the exact geometry; ball
    sizes count.
    """
    rng = np.random.default_rng(4)
    m, w, s = scene(core, rng, **DRY)
    view = m.p.ball.dD
    for j in range(Z):
        view[j] = 2e-6 * (j - 4)
    core.lib.model_derive(m.p, m.d)
    contacts(m)
    axes = frames(s["theta"])
    F, M = on_ball(w)
    assert np.abs(M).max() < 1e-12 * np.abs(F).max()
    closed = 0
    for j in range(Z):

        def approach(t, j=j):
            frame = Rotation.from_rotvec(s["Omega"] * t).as_matrix() @ s["frame"]
            ball = s["x"][j] * axes[j, 0] + s["r"][j] * axes[j, 1] + axes[j].T @ s["v"][j] * t
            return np.linalg.norm(
                ball - closest_on_circle(ball, s["centre"] + s["velocity"] * t, frame, m.d.inner.R_g)
            ) - (0.515 * D - m.d.R[j])

        rate = (approach(1e-7) - approach(-1e-7)) / 2e-7
        Q_i = m.d.inner.hertz.K * max(w.delta_i[j], 0.0) ** 1.5 * max(0.0, 1.0 + 0.05 * rate)
        n_e = np.array([s["x"][j], s["r"][j] - m.d.outer.R_g]) / np.hypot(s["x"][j], s["r"][j] - m.d.outer.R_g)
        Q_e = m.d.outer.hertz.K * max(w.delta_e[j], 0.0) ** 1.5 * max(0.0, 1.0 + 0.05 * (n_e @ s["v"][j][:2]))
        closed += Q_i > 0.0 and Q_e > 0.0
        assert w.Q_i[j] == pytest.approx(Q_i, rel=1e-7, abs=1e-9)  # the difference quotient's rounding; observed 1e-9
        assert w.Q_e[j] == pytest.approx(Q_e, rel=1e-11, abs=1e-9)
        n_i = np.array([w.n_ix[j], w.n_ir[j], w.n_it[j]])
        assert F[j] == pytest.approx(-Q_i * n_i - Q_e * np.append(n_e, 0.0), abs=1e-5 + 1e-7 * Q_i)
    assert closed >= 3


# ------------------------------------------------------------------------------------------------------------- momentum


@pytest.mark.parametrize("lubrication", Lubrication)
@pytest.mark.parametrize("traction", Traction)
def test_ring_gets_the_opposite_wrench(core, traction, lubrication):
    """Force and moment about the bearing's centre by the inner race vanish over ball and ring; observed 1e-15 of the
    force.
    """
    rng = np.random.default_rng(5)
    changes = {"scene.traction": traction, "scene.lubrication": lubrication}
    m, w, s = scene(core, rng, **changes)
    contacts(m)
    F, M = (part.copy() for part in on_ball(w))
    F_ring, M_ring = (part.copy() for part in ring_wrench(w))
    assert (w.Q_i[:Z] > 0.0).sum() >= 3
    m.d.inner.hertz.K = 0.0  # what the outer race does alone
    contacts(m)
    assert w.Q_i[:Z].max() == 0.0
    F_e, M_e = on_ball(w)
    axes = frames(s["theta"])
    for j in range(Z):
        force, moment = axes[j].T @ (F[j] - F_e[j]), axes[j].T @ (M[j] - M_e[j])
        ball = s["x"][j] * axes[j, 0] + s["r"][j] * axes[j, 1]
        scale = np.linalg.norm(force) + 1.0
        assert force + F_ring[j] == pytest.approx(np.zeros(3), abs=1e-13 * scale)
        about_centre = np.cross(ball, force) + moment + np.cross(s["centre"], F_ring[j]) + M_ring[j]
        assert about_centre == pytest.approx(np.zeros(3), abs=1e-13 * scale * 0.03)


# ---------------------------------------------------------------------------------------- traction, in the global frame


def film(s, A=-0.04, B=2.2, C=45.0):
    return (A + B * s) * np.exp(-C * s) - A


def inlet(race, U, Q):
    return race.rolling * U**0.66 * Q * (Q + 1.0) ** -0.53


def reference(m, s, w, j, race):
    """Force on ball j at one race beyond the normal one, and its moment about the ball's centre, global frame: point
    contact, full film.
    """
    axes = frames(s["theta"])[j].T
    ball = axes @ [s["x"][j], s["r"][j], 0.0]
    v_b, omega_b = axes @ s["v"][j], axes @ s["omega"][j]
    orbit = np.array([s["v"][j][2] / s["r"][j], 0.0, 0.0])
    if race == "inner":
        n, Q, constants = axes @ [w.n_ix[j], w.n_ir[j], w.n_it[j]], w.Q_i[j], m.d.inner
    else:
        n, Q, constants = axes @ [w.n_ex[j], w.n_er[j], 0.0], w.Q_e[j], m.d.outer
    contact = ball + R * n
    surface = v_b + np.cross(omega_b, R * n)
    groove = s["velocity"] + np.cross(s["Omega"], contact - s["centre"]) if race == "inner" else np.zeros(3)
    carried = v_b + np.cross(orbit, R * n)  # the point of the frame that orbits with the ball
    across = np.eye(3) - np.outer(n, n)
    slip, mean = across @ (surface - groove), across @ (0.5 * (surface + groove) - carried)
    v_0, U_0 = 1e-4, 0.01
    speed, U = np.sqrt(slip @ slip + v_0**2), np.sqrt(mean @ mean + U_0**2)
    F_s = -film(speed / U) * Q * slip / speed - inlet(constants, U, Q) * mean / U
    F_c = constants.horizontal * inlet(constants, U, Q) * mean / U
    return -Q * n + F_s + F_c, np.cross(R * n, F_s)


def test_traction_in_the_global_frame(core):
    """Slip, mean speed, traction, inlet friction and horizontal force written anew; observed 1e-11 (differences of
    speeds of 30 m/s).
    """
    rng = np.random.default_rng(6)
    most = 0.0
    for _ in range(3):
        m, w, s = scene(core, rng)
        contacts(m)
        F, M = on_ball(w)
        for j in range(Z):
            axes = frames(s["theta"])[j]
            parts = [reference(m, s, w, j, race) for race in ("inner", "outer")]
            force, moment = axes @ (parts[0][0] + parts[1][0]), axes @ (parts[0][1] + parts[1][1])
            scale = w.Q_i[j] + w.Q_e[j] + 1e-3
            assert F[j] == pytest.approx(force, abs=1e-10 * scale)
            assert M[j] == pytest.approx(moment, abs=1e-10 * scale * R)
            most = max(most, np.linalg.norm(M[j]) / R / scale)
    assert most > 5e-3  # tangential forces were at work


def test_no_slip_no_traction(core):
    """A ball that rolls at omega_m = omega (1 - gamma)/2 has no slip at either race: traction vanishes, only inlet
    forces remain.
    """
    m = core.model(parameters={"oil.rolling": 0.0, "scene.traction": Traction.POINT})
    r, omega = 0.02675, 1900.0
    theta = 2.0 * np.pi * np.arange(Z) / Z
    R_eff_i, R_eff_e = r - R, r + R
    omega_m = omega * R_eff_i / (2.0 * r)
    spin = -omega_m * r / R  # in the inertial frame, rolls on the outer race
    set_ring(m, np.zeros(3), np.zeros(3), np.eye(3), np.array([omega, 0.0, 0.0]))
    set_preload(m, 30e-6)
    v = np.tile([0.0, 0.0, r * omega_m], (Z, 1))
    w = place_balls(m, np.zeros(Z), np.full(Z, r), theta, v, np.tile([spin, 0.0, 0.0], (Z, 1)))
    contacts(m)
    F, M = on_ball(w)
    assert w.Q_i[:Z].min() > 100.0
    assert np.abs(F[:, 2]).max() < 1e-9 * w.Q_i[0]
    assert np.abs(M).max() < 1e-9 * w.Q_i[0] * R
    assert w.U_i[:Z] == pytest.approx(np.hypot((omega - omega_m) * R_eff_i, 0.01), rel=1e-12)  # with its floor
    assert w.U_e[:Z] == pytest.approx(np.hypot(omega_m * R_eff_e, 0.01), rel=1e-12)


def set_preload(m, approach):
    """Interference in place of clearance, so that centred balls are pressed."""
    m.p.bearing.P_d = -2.0 * approach
    m.core.lib.model_derive(m.p, m.d)


# ----------------------------------------------------------------------------------------------------------------- spin


def spinning_ball(core, spin, slip=0.0, **changes):
    """A pressed ball between races at rest, turning at `spin` about the common normal and sliding at `slip` along t
    over the outer race.
    """
    m = core.model(parameters={"scene.traction": Traction.SLICED, "oil.rolling": 0.0} | changes)
    set_preload(m, 20e-6)
    set_ring(m, np.zeros(3), np.zeros(3), np.eye(3), np.zeros(3))
    m.d.inner.hertz.K = 0.0
    r = m.d.outer.R_g + m.d.outer.r_g - R + 8e-6
    w = place_balls(
        m,
        np.zeros(Z),
        np.full(Z, r),
        np.zeros(Z),
        np.tile([0.0, 0.0, slip], (Z, 1)),
        np.tile([0.0, spin, 0.0], (Z, 1)),
        omega_m=np.zeros(Z),
    )
    contacts(m)
    return m, w


# mu = 0.05 (1 - exp(-1000 s)): 0.05 at all but the slightest slip
COULOMB = {"oil.A": -0.05, "oil.B": 0.0, "oil.C": 1000.0}


def test_spin_moment_of_coulomb_friction(core):
    """(3/8) mu Q a: that of a long ellipse, 3 mu Q a E/8 with E -> 1 (Harris; Poritsky 1950); E = 1.02 at a/b = 8.

    The kink of |xi| lies between the slices of both sides.
    """
    m, w = spinning_ball(core, 5000.0, **COULOMB)
    a = m.d.outer.hertz.a * np.cbrt(w.Q_e[0])
    F, M = on_ball(w)
    assert a == pytest.approx(m.d.outer.hertz.a_delta * np.sqrt(w.delta_e[0]), rel=1e-12)
    assert -M[0, 1] == pytest.approx(0.375 * 0.05 * w.Q_e[0] * a, rel=2e-3)
    assert np.abs(F[0, [0, 2]]).max() < 1e-9 * w.Q_e[0]


def test_spin_moment_of_viscous_friction(core):
    """mu = B s (C = 0): M = B Q omega a^2/(5 U), as int (3/4)(1 - s^2) s^2 ds = 1/5; polynomials are integrated
    exactly.
    """
    m, w = spinning_ball(core, 200.0, **{"oil.A": 0.0, "oil.B": 0.01, "oil.C": 0.0})
    a = m.d.outer.hertz.a * np.cbrt(w.Q_e[0])
    assert -on_ball(w)[1][0, 1] == pytest.approx(0.01 * w.Q_e[0] * 200.0 * a**2 / (5.0 * 0.01), rel=1e-12)
    assert w.spin_dissipated[0] == pytest.approx(0.01 * w.Q_e[0] * 200.0**2 * a**2 / (5.0 * 0.01), rel=1e-12)


@pytest.mark.parametrize(("spin", "slip"), [(300.0, 1.5), (-800.0, 2.0), (50.0, -0.4), (2000.0, 0.3), (-3000.0, 1.0)])
def test_slices_against_quadrature(core, spin, slip):
    """Force and moments of the line pressure (3/4)(1 - (xi/a)^2) Q/a with slip varying by spin and by the surface's
    curvature, by adaptive quadrature.

    Observed: 7e-6 Q at -3000 rad/s, below 2e-7 Q elsewhere; a coefficient of traction is up to 0.05.
    """
    m, w = spinning_ball(core, spin, slip)
    Q, a, R_m = w.Q_e[0], m.d.outer.hertz.a * np.cbrt(w.Q_e[0]), 2.0 * 0.52 / (2.0 * 0.52 + 1.0) * D
    # mean of ball and race at the contact's middle, seen from the ball: it slides without orbiting
    U = np.hypot(0.5 * slip, 0.01)

    def traction(xi, part):
        place = np.array([xi, R - 0.5 * xi * xi / R_m, 0.0])  # (x, r, t) from the ball's centre
        v = np.array([0.0, 0.0, slip]) + np.cross([0.0, spin, 0.0], place)
        v[1] = 0.0
        speed = np.sqrt(v @ v + 1e-8)
        F = -film(speed / U) * Q * 0.75 * (1.0 - (xi / a) ** 2) / a * v / speed
        return F[2] if part == "force" else np.cross(place, F)[part]

    def integral(part):
        return quad(
            traction, -a, a, args=(part,), points=[np.clip(slip / spin, -0.9 * a, 0.9 * a)], epsrel=1e-10, limit=200
        )[0]

    F, M = on_ball(w)
    assert F[0, 2] == pytest.approx(integral("force"), abs=1e-5 * Q)
    assert M[0, 0] == pytest.approx(integral(0), abs=1e-5 * Q * R)
    assert M[0, 1] == pytest.approx(integral(1), abs=1e-5 * Q * a)


def test_slices_where_the_slip_changes_its_sign(core):
    """Traction is nearly a step where the slip changes its sign inside the ellipse, and the slices lie on both sides of
    it.

    RMS over fifty slips of the error of the force, of the largest force: 0.15 % (observed); twelve points of
    Gauss-Jacobi's rule for the whole ellipse, 7 %.
    """
    spin, slips, law = 2000.0, np.linspace(0.05, 2.5, 50), np.array(roots_jacobi(12, 1.0, 1.0))
    found, exact, unsplit = [], [], []
    for slip in slips:
        m, w = spinning_ball(core, spin, slip)
        a, U = m.d.outer.hertz.a * np.cbrt(w.Q_e[0]), np.hypot(0.5 * slip, 0.01)

        def traction_at(x, slip=slip, a=a, U=U):
            v = slip - spin * a * x
            return -film(np.hypot(v, 1e-4) / U) * v / np.hypot(v, 1e-4)

        where = [np.clip(slip / (spin * a), -0.999, 0.999)]
        found.append(on_ball(w)[0][0, 2] / w.Q_e[0])
        exact.append(quad(lambda x, f=traction_at: 0.75 * (1.0 - x * x) * f(x), -1.0, 1.0, points=where, limit=200)[0])
        unsplit.append(traction_at(law[0]) @ law[1] / law[1].sum())
    error, of_unsplit = (np.sqrt(np.mean((np.array(f) - exact) ** 2)) / np.abs(exact).max() for f in (found, unsplit))
    assert error < 0.003
    assert of_unsplit > 30.0 * error


def test_slices_tend_to_the_point(core):
    """As the ellipse shrinks the slices see one slip: the difference falls with a^2, that is with delta."""
    difference = []
    for shrink in (1.0, 0.01):
        results = []
        for traction in (Traction.POINT, Traction.SLICED):
            m, _ = spinning_ball(core, 0.0, **{"scene.traction": traction})
            r = m.d.outer.R_g + m.d.outer.r_g - R + 8e-6 * shrink
            turn, slide = np.tile([0.0, 300.0, 0.0], (Z, 1)), np.tile([0.0, 0.0, 0.3], (Z, 1))
            # U = 22 m/s
            w = place_balls(m, np.zeros(Z), np.full(Z, r), np.zeros(Z), slide, turn, omega_m=np.full(Z, 4000.0))
            contacts(m)
            results.append(on_ball(w)[0][0, 2] / w.Q_e[0])
        difference.append(abs(results[1] / results[0] - 1.0))
    assert difference[0] > 1e-3
    assert difference[1] == pytest.approx(0.01 * difference[0], rel=0.05)


def test_dissipation_is_the_power_of_all_forces(core):
    """Contacts lose what they take from balls and ring, less what the springs store: -F.v - M.omega - ... = dissipated
    + elastic rate.
    """
    rng = np.random.default_rng(9)
    for traction in Traction:
        for lubrication in Lubrication:
            m, w, s = scene(core, rng, **{"scene.traction": traction, "scene.lubrication": lubrication})
            contacts(m)
            F, M = on_ball(w)
            F_ring, M_ring = ring_wrench(w)
            power = (
                np.einsum("jk,jk->j", F, s["v"])
                + np.einsum("jk,jk->j", M, s["omega"])
                + F_ring @ s["velocity"]
                + M_ring @ s["Omega"]
            )
            stored = elastic_rate(m, s, w)
            assert w.dissipated[:Z] == pytest.approx(-power - stored, rel=1e-6, abs=1e-5 * np.abs(power).max())
            # only the inlet's horizontal force may feed a little
            assert w.dissipated[:Z].min() > -1e-2 * w.dissipated[:Z].max()


def elastic_rate(m, s, w):
    """K delta^1.5 delta_dot of both races, delta_dot from velocities along the normals."""
    axes = frames(s["theta"])
    rate = np.empty(Z)
    for j in range(Z):
        v = axes[j].T @ s["v"][j]
        ball = s["x"][j] * axes[j, 0] + s["r"][j] * axes[j, 1]
        n_i, n_e = axes[j].T @ [w.n_ix[j], w.n_ir[j], w.n_it[j]], axes[j].T @ [w.n_ex[j], w.n_er[j], 0.0]
        ring = s["velocity"] + np.cross(s["Omega"], ball - s["centre"])
        Q_i, Q_e = (
            race.hertz.K * max(delta, 0.0) ** 1.5
            for race, delta in ((m.d.inner, w.delta_i[j]), (m.d.outer, w.delta_e[j]))
        )
        rate[j] = Q_i * (n_i @ (v - ring)) + Q_e * (n_e @ v)
    return rate


# --------------------------------------------------------------------------------------------------------------- growth


def rotating_ring(r, a, b, omega, rho=7800.0, E=207e9, nu=0.3):
    """Radial displacement at r [m] of a free ring from a to b that turns at omega, by the equilibrium of its elements,
    solved numerically.

    u'' + u'/r - u/r^2 = -(1 - nu^2) rho omega^2 r/E with no radial stress, u' + nu u/r = 0, at bore and rim.  Lengths
    in b, displacements in the load.
    """

    def equations(x, y):
        return np.array([y[1], y[0] / x**2 - y[1] / x - x])

    def ends(at_a, at_b):
        return np.array([at_a[1] + nu * at_a[0] * b / a, at_b[1] + nu * at_b[0]])

    x = np.linspace(a / b, 1.0, 40)
    solution = solve_bvp(equations, ends, x, np.stack([x, np.ones_like(x)]), tol=1e-9)
    return solution.sol(r / b)[0] * (1.0 - nu**2) * rho * omega**2 * b**3 / E


@pytest.mark.parametrize("bore", [0.0, 0.02])
def test_inner_ring_grows(core, bore):
    """Approach of balls at the same place by the growth at the groove's bottom: 1.153 um at 18,238 r/min with the
    6207's bore of 35 mm.
    """
    omega = 18238.0 * np.pi / 30.0
    bottom = 0.5 * (0.0535 - 0.0111125)
    deltas = []
    for growth in (Switch.OFF, Switch.ON):
        m = core.model(parameters={"scene.growth": growth, "ring.bore": bore}, inputs={"shaft.omega": omega})
        set_ring(m, np.zeros(3), np.zeros(3), np.eye(3), np.array([omega, 0.0, 0.0]))
        r = m.d.inner.R_g - m.d.inner.r_g + R - 5e-6
        w = place_balls(m, np.zeros(Z), np.full(Z, r), np.zeros(Z), np.zeros((Z, 3)))
        contacts(m)
        deltas.append(np.array(w.delta_i[:Z]))
    grown = rotating_ring(bottom, 0.5 * (bore or 0.035), bottom + 0.2 * 0.0111125, omega)
    # D/0.6 makes the bore 34.98 mm: observed 4e-4
    assert deltas[1] - deltas[0] == pytest.approx(np.full(Z, grown), rel=1e-3)
    if not bore:
        assert grown == pytest.approx(1.153e-6, rel=1e-3)


@pytest.mark.c_only
def test_clearance_at_speed(core):
    """bearing.clearance: 15 um less twice the growth, which is on by default."""
    bearing = Instance(core)
    assert bearing.output("bearing.clearance") == pytest.approx(15e-6 - 2.0 * 1.153e-6, rel=2e-4)
    assert Instance(core, {"scene.growth": Switch.OFF}).output("bearing.clearance") == 15e-6
