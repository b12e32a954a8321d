"""The two halves of the cage as rigid bodies.  Equations in rotor.py.

The states of a half are those of its centre of mass, which lies c away from its geometric centre; contacts act about
the geometric centre.
"""

import numpy as np

from bearing_model.generated import variables as Y
from bearing_model.numbers.vec import vec_cross
from bearing_model.physics.frame import frame_acceleration, frame_moment
from bearing_model.physics.rotor import Rotor, rotor_acceleration, rotor_axis, rotor_body_axes, rotor_roll

CAGE_PLACE = ((Y.CAGE_X, Y.CAGE_V_X), (Y.CAGE_Y, Y.CAGE_V_Y), (Y.CAGE_Z, Y.CAGE_V_Z))


def of_half(y, block, h):
    """The entry of half h in a block of the state, with an axis of length 1."""
    return y[..., block][..., h : h + 1]


def halves_kinematics(model, y, w):
    """Poses and velocities of both halves from y, without forces."""
    w.half = [Rotor(), Rotor()]
    for h, half in enumerate(w.half):
        rotor_axis(
            half,
            *(
                of_half(y, block, h)
                for block in (Y.CAGE_BETA, Y.CAGE_GAMMA, Y.CAGE_BETA_DOT, Y.CAGE_GAMMA_DOT, Y.CAGE_S)
            ),
        )
        psi = of_half(y, Y.CAGE_PSI, h)
        rotor_body_axes(half, np.cos(psi), np.sin(psi))
        half.c = model.d.com_x[h] * half.a + model.d.com_e * half.b_y
        half.x = np.array([of_half(y, X, h) for X, _ in CAGE_PLACE]) - half.c
        half.v = np.array([of_half(y, V, h) for _, V in CAGE_PLACE]) - vec_cross(half.Omega, half.c)
        half.F = half.M = 0.0 * half.x  # the elements add their forces


def half_rates(y, half, h, acc, a_ddot, s_dot, y_dot):
    """Sets y_dot of half h from the accelerations of its centre of mass (acc), of its axis (a_ddot) and of its spin
    (s_dot).
    """
    for i, (X, V) in enumerate(CAGE_PLACE):
        of_half(y_dot, X, h)[...] = of_half(y, V, h)
        of_half(y_dot, V, h)[...] = acc[i]
    of_half(y_dot, Y.CAGE_BETA, h)[...] = of_half(y, Y.CAGE_BETA_DOT, h)
    of_half(y_dot, Y.CAGE_GAMMA, h)[...] = of_half(y, Y.CAGE_GAMMA_DOT, h)
    of_half(y_dot, Y.CAGE_PSI, h)[...] = half.s - rotor_roll(half)
    of_half(y_dot, Y.CAGE_BETA_DOT, h)[...] = -a_ddot[2]
    of_half(y_dot, Y.CAGE_GAMMA_DOT, h)[...] = a_ddot[1]
    of_half(y_dot, Y.CAGE_S, h)[...] = s_dot


def halves_acceleration(model, y, w, y_dot):
    """Rates of both halves under the forces and moments in w."""
    p, d, frame = model.p, model.d, model.ring_load
    for h, half in enumerate(w.half):
        s, v = half.x + half.c, half.v + vec_cross(half.Omega, half.c)  # of the centre of mass
        M = half.M - vec_cross(half.c, half.F) + frame_moment(frame, half, d.J_p, d.J_t)
        # A half that expands gains inertia and slows down; the gained inertia resists the frame's angular acceleration too.
        moment = (
            w.cage.elastic.more_J_dot[h] * (half.s + w.frame_omega) + w.cage.elastic.more_J[h] * frame.frame_omega_dot
        )
        M = M - moment * half.a
        a_ddot, s_dot = rotor_acceleration(half, d.J_p, d.J_t, M)
        s_dot = s_dot * (d.J_p / (d.J_p + w.cage.elastic.more_J[h]))
        half_rates(y, half, h, half.F / p.cage.m + frame_acceleration(frame, s, v), a_ddot, s_dot, y_dot)
