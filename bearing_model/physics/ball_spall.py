"""Spalls on balls: the turn of a ball, and the forces on ball and rings while a spall meets a race.

           ___                     k      rolling axis of the ball, across t and across the mean of the normals
         /  |  \\  spall            chi    angle of the spall's middle from the outer contact about k
        |   |chi|                  chi_e = chi, chi_i = chi + pi - g: angles from the contacts
        |   o   |--- t             g      azimuth of the ball about the inner ring less that about the outer ring
         \\     /
          \\___/                    d chi/dt = k.(omega_ball - Omega_e) - (a_e.k) phi_e'
        inner race                 dg/dt    = (phi_i' + a_i.Omega_i) - (phi_e' + a_e.Omega_e)

phi' = t.(v_ball - v_ring - Omega x p)/r: rate of the ball's azimuth on a ring, r its distance from the ring's axis a.
With rings in their places d chi/dt is the ball's speed about k against its orbit; a spall meets the outer race once a turn
and the inner race half a turn later.  The ball has this one angle: a spall stays in the track, for a ball that pivots
about the normal is not followed.

The drop f(R chi) and the strips are those of race_surface.py, R_x of each race.  With the energy U of a contact and
P = -dU/dchi = Q_ball df/dchi, Q_ball the load of the strips over the ball's spall:

    ball          moment P k
    outer race    force -P (a_e.k) t/r on the ball
    inner race    force -P t/r on the ball, moment on the inner ring -(p x F) - P a_i.  The remainder, P (k - a_i) and
                  P (1 - a_e.k) t/r_e, which is 0 without contact angle, comes from the outer ring.

Power on the ball and on both rings together is P dchi_i/dt or P dchi_e/dt exactly, so that energy and momentum are
closed.  Without contact angle a force on a ring passes through its axis, as on any surface of revolution.  Damping counts
the drop as part of the approach: P grows as Q does.
"""

from types import SimpleNamespace

import numpy as np

from bearing_model.numbers.vec import vec_cross, vec_dot


def ball_roll(i, e, angle, turned):
    """Turn of the balls from their places on the inner race (i) and on the outer one (e): rolling axis k, along = a_e.k,
    cos and sin of the spalls' angles from the contacts, their rates [rad/s].

    A place: normal n, rolling direction t, axis a of the ring and its spin s, distance r from it, approach and spin as in
    a contact, cos_phi and sin_phi of the angle on the race.  angle: chi [rad]; turned: angle of the inner ring less
    that of the outer ring, from where the angles on the races count.
    """
    across = vec_cross(e.n - i.n, e.t)
    k = across / np.sqrt(vec_dot(across, across))
    out = SimpleNamespace(k=k, along=vec_dot(e.a, k))
    phi_i, phi_e = (vec_dot(at.t, at.approach) / at.r for at in (i, e))
    out.rate_e = vec_dot(k, e.spin) - out.along * phi_e
    out.rate_i = out.rate_e - (phi_i + i.s - (phi_e + e.s))
    # g, of the angles on the races and of the rings'
    c, s = i.cos_phi * e.cos_phi + i.sin_phi * e.sin_phi, i.sin_phi * e.cos_phi - i.cos_phi * e.sin_phi
    cos_g, sin_g = c * np.cos(turned) - s * np.sin(turned), s * np.cos(turned) + c * np.sin(turned)
    out.cos_e, out.sin_e = np.cos(angle), np.sin(angle)
    out.cos_i = -(out.cos_e * cos_g + out.sin_e * sin_g)
    out.sin_i = -(out.sin_e * cos_g - out.cos_e * sin_g)
    return out


def add_ball_spalls(roll, i, e, P_i, P_e, T_i, T_e):
    """Adds the moments P [N.m] on the balls by their spalls, and the forces that go with them, to the tractions T."""
    beside = P_i - (P_i + P_e) * roll.along
    T_i.F_c = T_i.F_c - P_i / i.r * i.t
    T_e.F_c = T_e.F_c + beside / e.r * e.t
    T_i.M = T_i.M + P_i * i.a
    T_e.M = T_e.M + (P_i + P_e) * roll.k - P_i * i.a
