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

import numpy as np

from bearing_model.generated.variables import Lubrication
from bearing_model.numbers.lanes import ball_array_sum
from bearing_model.numbers.vec import vec, vec_cross, vec_dot, vec_local, vec_to_global
from bearing_model.physics.ball_spall import add_ball_spalls, ball_roll
from bearing_model.physics.hertz import hertz_load
from bearing_model.physics.outer_ring import outer_ring, spread
from bearing_model.physics.race_normal import race_contact, surface_contact, surface_place
from bearing_model.physics.race_traction import race_traction
from bearing_model.physics.ring_fit import ring_fit_growth, ring_fit_rate, ring_fit_speed
from bearing_model.physics.rotor import Rotor, rotor_body_axes


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
    """Contacts where a race is not perfect or a ball has a spall; further the turn of the balls and their places on both
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
