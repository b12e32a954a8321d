"""Reactions on the rings, and the powers by which shaft, housing and frame change the energy of balls and cage.

All forces on balls and cage together accelerate them; the outer ring carries the forces that the inner ring puts on
balls and cage less the sum of what acts on them.  Gravity and the frame's inertia forces are not among these forces.
"""

from bearing_model.numbers.lanes import ball_array_sum
from bearing_model.numbers.vec import vec, vec_cross, vec_dot, vec_to_global
from bearing_model.physics.frame import frame_acceleration, frame_moment
from bearing_model.physics.outer_ring import outer_ring


def housing_reaction(w):
    """Force and moment about the origin that balls and cage put on the housing (outer ring, oil)."""
    F, M = 0.0, 0.0
    for body in (w.ring, *w.half):
        F = F - body.F
        M = M - body.M - vec_cross(body.x, body.F)
    position, force, moment = (vec_to_global(v, w.cos_theta, w.sin_theta) for v in (vec(w.x, w.r, 0.0), w.F, w.M))
    return F - ball_array_sum(force), M - ball_array_sum(moment + vec_cross(position, force))


def housing_wrench(model, w):
    """The same about the outer ring's centre."""
    F, M = housing_reaction(w)
    return F, M - vec_cross(w.outer_x, F)


def shaft_power(w):
    """Power of the shaft into balls and cage [W], [..., 1]."""
    return -vec_dot(w.ring.F, w.ring.v) - vec_dot(w.ring.M, w.ring.Omega)


def housing_power(model, w):
    """Power of the housing into balls and cage [W], [..., 1]."""
    outer, (F, M) = outer_ring(model.ring_load, w.x), housing_wrench(model, w)
    return -vec_dot(F, outer.v) - vec_dot(M, outer.Omega)


def frame_power(model, w):
    """Power of gravity and of the frame's inertia forces into balls and cage [W], [..., 1]."""
    frame, d = model.ring_load, model.d
    place, v = (
        vec_to_global(value, w.cos_theta, w.sin_theta) for value in (vec(w.x, w.r, 0.0), vec(w.v_x, w.v_r, w.v_t))
    )
    power = ball_array_sum(
        d.m * vec_dot(frame_acceleration(frame, place, v), v) - d.J * frame.frame_omega_dot * w.omega_x
    )
    for half in w.half:
        v = half.v + vec_cross(half.Omega, half.c)
        force = model.p.cage.m * frame_acceleration(frame, half.x + half.c, v)
        power = power + vec_dot(force, v) + vec_dot(frame_moment(frame, half, d.J_p, d.J_t), half.Omega)
    return power
