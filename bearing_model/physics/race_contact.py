"""Ball and race: Hertz' contact under a groove that may be displaced and tilted, with traction.

             groove-curvature circle, radius R_g about the ring's axis a           p   ball centre - ring centre
                   o ________                                                       e   unit vector from the axis to the ball: radial part of p
                  /  L       \\                                                      L = (p.a) a + (|p - (p.a) a| - R_g) e
                 /            \\         n = L/|L|: out of the groove's centre       delta = |L| - (r_g - R)
         race   (    ball      )        through the ball's centre to the contact    delta_dot = n.(v_ball - v_ring - Omega x p)
                 \\            /                                                     Q = K delta^1.5 max(0, 1 + lambda delta_dot)
                  \\__________/                                                      force on the ball -Q n

The outer race is the same with the outer ring's centre, axis and motion (outer_ring.py).

The inner ring grows by its rotation in the fixed frame and its fit: R_g + ring_fit_growth (ring_fit.py).

Races that are not perfect have approaches and normals of their own (race_surface.py), balls with spalls moments too
(ball_spall.py).

No offset or tilt is taken as small: the geometry is exact, so that the normal forces derive from a potential.
Slip and mean speed at the contact point p + R n, seen from the frame that orbits with the ball:
    u_ball = (omega_ball - omega_m e_x) x R n,   u_race = v_ring + Omega x (p + R n) - v_ball - omega_m e_x x R n
    Delta u = u_ball - u_race,   U = (u_ball + u_race)/2     (their parts in the tangent plane)
The ring gets the opposite forces at the same points: force -F, moment -(p x F) - M about its centre.
Spin and curvature let the slip vary along the long axis of the ellipse; `sliced` integrates the traction over this
axis:
    Delta u(xi) = Delta u + Delta omega x (xi t_2 - xi^2/(2 R_m) n),  pressure (3/4)(1 - xi^2/a^2) per length
in slices on both sides of where the slip changes its sign, because the traction is nearly a step there.  With x = xi/a
the slip along t_1 is s_1 + k x + b_1 x^2; the place is x_0 = -s_1 k/(k^2 + b_1^2), not beyond the ends.  That is the
root where spin (k) outweighs curvature (b_1); the two roots of curvature lie about the middle, which x_0 tends to.
Smoothness: C1 at touch-down.  Hertz' ellipse is not cut at the shoulder.
"""

from types import SimpleNamespace

import numpy as np
from scipy.special import roots_jacobi

from bearing_model.generated.variables import Lubrication, Traction
from bearing_model.numbers.lanes import ball_array_sum, maximum, minimum
from bearing_model.numbers.vec import vec, vec_across, vec_cross, vec_dot, vec_local, vec_to_global
from bearing_model.physics.ball_spall import add_ball_spalls, ball_roll
from bearing_model.physics.hertz import hertz_damped, hertz_load
from bearing_model.physics.outer_ring import outer_ring, spread
from bearing_model.physics.race_surface import (
    Spall,
    race_surface_drop,
    race_surface_load,
    race_surface_waves,
    spall_drop,
    spall_strips,
)
from bearing_model.physics.ring_fit import ring_fit_growth, ring_fit_rate, ring_fit_speed
from bearing_model.physics.rotor import Rotor, rotor_body_axes
from bearing_model.physics.traction import (
    Q_FLOOR,
    traction_asperity_share,
    traction_ln_film,
    traction_ln_thermal,
    traction_mu,
    traction_race_inlet,
)

SIDE = np.repeat([-1.0, 1.0], 6)
Z_JACOBI, W_JACOBI = np.tile(roots_jacobi(6, 1.0, 0.0), 2)  # on either side, of the weight 1 - z on [-1, 1]
TINY = 1e-30  # [m^2/s^2] keeps contacts without load from dividing by 0


def split_place(s_1, k, b_1):
    """Place x_0 = -s_1 k/(k^2 + b_1^2) in [-1, 1] where the slip s_1 + k x + b_1 x^2 changes its sign."""
    return maximum(minimum(-s_1 * k / (k * k + b_1 * b_1 + TINY), 1.0), -1.0)


def slices(x_0):
    """Places x in [-1, 1] and shares of the pressure (3/4)(1 - x^2) of all slices, [12, ...]: on each side x = x_0 (1 -
    z) + side z with (3/4)(1 + side x)(1 - side x_0)^2 w, where z and w are Gauss-Jacobi's points for the weight 1 - z
    on [0, 1].  Polynomials up to degree 10 on each side are integrated exactly.
    """
    side, z, w = (column.reshape(-1, *[1] * np.ndim(x_0)) for column in (SIDE, 0.5 * (Z_JACOBI + 1.0), 0.25 * W_JACOBI))
    x = x_0 * (1.0 - z) + side * z
    return x, (1.0 + side * x) * 0.75 * (1.0 - side * x_0) ** 2 * w


def race_traction(model, race, c, mixed):
    """Forces on the ball by traction at a point or over the slices and by the inlet's rolling friction.

    c: the contact, normal n, rolling direction t_1, long axis t_2, slip Delta u, mean speed roll = U, spin = omega_ball
    - Omega of the race, approach = velocity of the ball's centre against the race there, load Q, sqrt_delta, ball
      radius R.
    Returns U with its floor [m/s], F_s at the contact point, F_c through the ball's centre [N], M of F_s about the
    ball's centre with spin [N.m], dissipated power, of it by the inlet and by spin about the normal [W]; for the
    integrator's Jacobian (verlet.py) the secant coefficients g = |traction|/|slip| [N.s/m] and g_spin = moment/spin
    [N.m.s].
    """
    p = model.p
    U = np.sqrt(vec_dot(c.roll, c.roll) + p.oil.U_0**2)
    ln_U, ln_Q = np.log(U), np.log(c.Q + Q_FLOOR)
    f_a = (
        traction_asperity_share(
            traction_ln_film(race.ln_Lambda, ln_U, ln_Q) + traction_ln_thermal(model.d.ln_thermal, ln_U)
        )
        if mixed
        else 0.0
    )
    F_R = traction_race_inlet(model.d, race.rolling, U, ln_U, c.Q, ln_Q)

    # slip along t_1 and t_2 at x = xi/a: s_1 + k x + b_1 x^2, s_2 + b_2 x^2
    sliced = p.scene.traction == Traction.SLICED
    a = race.hertz.a_delta * c.sqrt_delta
    sagitta = a * a * (0.5 / race.R_m)
    spin_n = vec_dot(c.spin, c.n)
    s_1, s_2, k = vec_dot(c.slip, c.t_1), vec_dot(c.slip, c.t_2), -a * spin_n
    b_1, b_2 = -sagitta * vec_dot(c.spin, c.t_2), sagitta * vec_dot(c.spin, c.t_1)
    x, share = slices(split_place(s_1, k, b_1)) if sliced else (np.zeros((1, *a.shape)), 1.0)
    slip_1, slip_2 = s_1 + k * x + b_1 * x * x, s_2 + b_2 * x * x
    squared = slip_1 * slip_1 + slip_2 * slip_2
    slip = np.sqrt(squared + p.oil.v_0**2)
    g = share * traction_mu(p, slip / U, f_a, mixed) * c.Q / slip
    F = -g * (slip_1 * c.t_1[:, None] + slip_2 * c.t_2[:, None])
    lever = (c.R - sagitta * x * x) * c.n[:, None] + a * x * c.t_2[:, None]
    out = SimpleNamespace(U=U, F_s=F.sum(axis=1), M=vec_cross(lever, F).sum(axis=1))
    out.g, out.g_spin, out.dissipated = (part.sum(axis=0) for part in (g, g * (a * x) ** 2, g * squared))
    out.spin_dissipated = -vec_dot(out.M, c.n) * spin_n if sliced else 0.0
    # Inlet: -F_R U/|U| at the surface, the film's horizontal pressure force +F_H U/|U| through the ball's centre.
    rolling = F_R / U * c.roll
    out.F_s = out.F_s - rolling
    out.M = out.M - vec_cross(c.R * c.n, rolling)
    out.F_c = race.horizontal * rolling
    out.inlet_dissipated = vec_dot(rolling, c.slip) - vec_dot(out.F_c, c.approach)
    out.dissipated = out.dissipated + out.inlet_dissipated
    return out


def race_contact(race, R_g, R, lambda_, p, a, Omega, approach, omega_b, omega_m):
    """Normal contact and kinematics of the balls with one race.

    R_g: present radius of the circle of groove centres, p: ball centres - ring centre, a: axis, Omega: angular velocity
    of the ring, approach: v_ball - v_ring - Omega x p, all in the balls' frames.
    """
    along = vec_dot(p, a)
    radial = p - along * a
    r = np.sqrt(vec_dot(radial, radial))
    e = radial / r
    L = along * a + (r - R_g) * e
    L_abs = np.sqrt(vec_dot(L, L))
    c = SimpleNamespace(R=R, n=L / L_abs, t_1=vec_cross(a, e), approach=approach)
    c.delta, delta_dot = L_abs - (race.r_g - R), vec_dot(c.n, approach)
    Q_0 = hertz_load(race.hertz.K, c.delta)
    c.Q = hertz_damped(Q_0, lambda_, delta_dot)
    c.damped = (c.Q - Q_0) * delta_dot
    c.sqrt_delta = np.sqrt(maximum(c.delta, 0.0))
    return contact_motion(c, Omega, omega_b, omega_m)


def contact_motion(c, Omega, omega_b, omega_m):
    """Slip and mean speed of a contact whose normal and approach are known."""
    c.t_2, c.spin = vec_cross(c.n, c.t_1), omega_b - Omega
    arm = c.R * c.n
    orbit = vec_cross(vec(omega_m, 0.0, 0.0), arm)
    u_ball, u_race = vec_cross(omega_b, arm) - orbit, vec_cross(Omega, arm) - c.approach - orbit
    c.slip = vec_across(u_ball - u_race, c.n)
    c.roll = vec_across(0.5 * (u_ball + u_race), c.n)
    return c


def surface_place(R_g, ring, w):
    """Places of the balls on a race that is not perfect; ring: Rotor whose body axes turn with the race, w: the balls'
    motions.
    """

    def local(v):
        return vec_local(v, w.cos_theta, w.sin_theta)

    at = SimpleNamespace(p=vec(w.x, w.r, 0.0) - local(ring.x), a=local(ring.a), Omega=local(ring.Omega), s=ring.s)
    along = vec_dot(at.p, at.a)
    radial = at.p - along * at.a
    at.r = np.sqrt(vec_dot(radial, radial))
    e = radial / at.r
    at.t = vec_cross(at.a, e)
    L = along * at.a + (at.r - R_g) * e
    at.L = np.sqrt(vec_dot(L, L))
    at.n = L / at.L
    at.approach = vec(w.v_x, w.v_r, w.v_t) - local(ring.v) - vec_cross(at.Omega, at.p)
    at.spin = vec(w.omega_x, w.omega_r, w.omega_t) - at.Omega
    at.cos_phi, at.sin_phi = vec_dot(e, local(ring.b_y)), vec_dot(e, local(ring.b_z))
    return at


def surface_contact(race, R, lambda_, at, w, angle=None):
    """The contact where the race is not perfect or the ball has a spall; stored: its elastic energy [J], damped: power of
    its damping [W], P: moment on the ball by its spall [N.m].

    at: by surface_place; angle: cos, sin and rate of the spalls' angles on the balls from the contact, None if no ball has
    one.
    """
    # heights and drops at the ball's angles
    height, slope = race_surface_waves(race.surface, at.cos_phi, at.sin_phi)
    f = drop = f_ball = drop_ball = rate_ball = 0.0 * at.cos_phi
    strips, none = None, Spall(R, race.hertz.R_x)
    if race.surface.spalled:
        f, drop = race_surface_drop(race.surface, at.cos_phi, at.sin_phi)
    if angle is not None:
        f_ball, drop_ball = spall_drop(race.balls, *angle[:2])
        rate_ball = angle[2]
    if race.surface.spalled or angle is not None:
        strips = spall_strips(race.surface.spall, f, none if angle is None else race.balls, f_ball)
    delta = at.L - (race.r_g - R) + height
    Q_0, Q_race, Q_ball, stored, delta = race_surface_load(race.hertz, delta, strips)

    # minus the gradient of the energy, Q (n + q t), whose direction is the normal, and the moment Q m on the ball
    q = (slope - Q_race / (Q_0 + 1e-30) * drop) / at.r
    m = Q_ball / (Q_0 + 1e-30) * drop_ball
    length = np.sqrt(1.0 + q * q)
    n, t_1 = (at.n + q * at.t) / length, (at.t - q * at.n) / length
    c = SimpleNamespace(R=R, p=at.p, n=n, t_1=t_1, approach=at.approach, stored=stored)
    c.delta, c.sqrt_delta = delta, np.sqrt(maximum(delta, 0.0))
    rate = length * vec_dot(c.n, c.approach) - m * rate_ball
    Q = Q_0 * maximum(1.0 + lambda_ * rate, 0.0)
    c.Q, c.P, c.damped = Q * length, Q * m, (Q - Q_0) * rate
    return contact_motion(c, at.Omega, vec(w.omega_x, w.omega_r, w.omega_t), w.omega_m)


def perfect_contacts(model, w, R_g):
    """Contacts of all balls with both races where these are perfect, c.p: ball centres - ring centre."""
    p, d = model.p, model.d
    v_b, omega_b = vec(w.v_x, w.v_r, w.v_t), vec(w.omega_x, w.omega_r, w.omega_t)
    position, contacts = vec(w.x, w.r, 0.0), []
    for race, radius, ring in ((d.inner, R_g, w.ring), (d.outer, d.outer.R_g, outer_ring(model.ring_load, w.x))):
        a, Omega, v, x = (vec_local(v, w.cos_theta, w.sin_theta) for v in (ring.a, ring.Omega, ring.v, ring.x))
        p_b = position - x
        approach = v_b - v - vec_cross(Omega, p_b)
        c = race_contact(race, radius, d.R, p.bearing.lambda_, p_b, a, Omega, approach, omega_b, w.omega_m)
        c.p = p_b
        contacts.append(c)
    return contacts


def rough_contacts(model, w, R_g):
    """The same where a race is not perfect or a ball has a spall; further the turn of the balls and their places on both
    races, None if no ball has one.
    """
    d, given, places = model.d, model.ring_load, []
    rings = (w.ring, given.inner_angle), (outer_ring(given, w.x), given.outer_angle)
    for radius, (ring, angle) in zip((R_g, d.outer.R_g), rings, strict=True):
        turned = Rotor(x=ring.x, v=ring.v, a=ring.a, Omega=ring.Omega, s=ring.s)
        rotor_body_axes(turned, *spread((np.cos(angle), np.sin(angle)), w.x))
        places.append(surface_place(radius, turned, w))
    angle_i = angle_e = spalls = None
    if d.spalled:
        turn = model.p.ball.spall_angle if model.turn is None else model.turn
        apart = spread((given.inner_angle - given.outer_angle,), w.x)[0]
        roll = ball_roll(*places, turn, apart)
        angle_i, angle_e = (roll.cos_i, roll.sin_i, roll.rate_i), (roll.cos_e, roll.sin_e, roll.rate_e)
        spalls, w.turn_rate = (roll, *places), roll.rate_e
    inner, outer = (
        surface_contact(race, d.R, model.p.bearing.lambda_, at, w, angle)
        for race, at, angle in zip((d.inner, d.outer), places, (angle_i, angle_e), strict=True)
    )
    w.race_stored = inner.stored + outer.stored
    return inner, outer, spalls


def race_contact_force(model, w):
    """Sets force and moment on the balls, their dissipated power and contact results, and the wrench on the inner ring."""
    p, d = model.p, model.d
    mixed = p.scene.lubrication == Lubrication.MIXED
    R_g = d.inner.R_g + ring_fit_growth(d.fit, ring_fit_speed(model.ring_load))
    inner, outer, spalls = rough_contacts(model, w, R_g) if d.rough else (*perfect_contacts(model, w, R_g), None)
    T_i, T_e = race_traction(model, d.inner, inner, mixed), race_traction(model, d.outer, outer, mixed)
    if spalls is not None:
        add_ball_spalls(*spalls, inner.P, outer.P, T_i, T_e)
    F_i, F_e = (c.Q * -c.n + T.F_s + T.F_c for c, T in ((inner, T_i), (outer, T_e)))

    # sums on the balls, the wrench on the ring
    w.F = F_i + F_e
    w.M = T_i.M + T_e.M
    w.race_dissipated = T_i.dissipated + T_e.dissipated + inner.damped + outer.damped
    w.inlet_dissipated = T_i.inlet_dissipated + T_e.inlet_dissipated
    w.spin_dissipated = T_i.spin_dissipated + T_e.spin_dissipated + 0.0 * w.x
    w.ring_F = vec_to_global(-F_i, w.cos_theta, w.sin_theta)  # by each ball, about the ring's centre
    w.ring_M = vec_to_global(-vec_cross(inner.p, F_i) - T_i.M, w.cos_theta, w.sin_theta)
    w.ring.F, w.ring.M = ball_array_sum(w.ring_F), ball_array_sum(w.ring_M)

    w.delta_i, w.delta_e, w.Q_i, w.Q_e, w.n_i, w.n_e = inner.delta, outer.delta, inner.Q, outer.Q, inner.n, outer.n
    w.U_i, w.U_e = T_i.U, T_e.U
    w.g_i, w.g_e, w.g_spin_i, w.g_spin_e = T_i.g, T_e.g, T_i.g_spin, T_e.g_spin


def race_growth_power(model, w):
    """Power that the inner ring's growth, where its speed changes, puts into the balls: -K delta^1.5 n.e dR_g/dt [W],
    [..., 1].
    """
    load, p = model.ring_load, vec(w.x, w.r, 0.0) - vec_local(w.ring.x, w.cos_theta, w.sin_theta)
    a = vec_local(w.ring.a, w.cos_theta, w.sin_theta)
    radial = p - vec_dot(p, a) * a
    force = -ball_array_sum(
        hertz_load(model.d.inner.hertz.K, w.delta_i) * vec_dot(w.n_i, radial) / np.sqrt(vec_dot(radial, radial))
    )
    return force * ring_fit_rate(model.d.fit, ring_fit_speed(load), load.omega_dot + load.frame_omega_dot)
