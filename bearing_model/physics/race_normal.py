"""Ball and race without traction: Hertz' contact, its motion, and that of races and balls that are not perfect.  Equations in race_contact.py."""

from types import SimpleNamespace

import numpy as np

from bearing_model.numbers.lanes import maximum
from bearing_model.numbers.vec import vec, vec_across, vec_cross, vec_dot, vec_local
from bearing_model.physics.hertz import hertz_damped, hertz_load
from bearing_model.physics.race_surface import (
    Spall,
    race_surface_drop,
    race_surface_load,
    race_surface_waves,
    spall_drop,
    spall_strips,
)


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
