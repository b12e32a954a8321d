"""Reactions on the rings, and the powers that change the energy of balls and cage: of shaft, housing and frame, and the
losses.

All forces on balls and cage together accelerate them; the outer ring carries the forces that the inner ring puts on
balls and cage less the sum of the forces on them.  Gravity and the frame's inertia forces are not among these forces.
"""

from bearing_model.cage.cage import cage_drawn, cage_losses
from bearing_model.numbers.lanes import ball_array_sum
from bearing_model.numbers.vec import vec, vec_cross, vec_dot, vec_to_global
from bearing_model.physics.frame import frame_acceleration, frame_moment
from bearing_model.physics.land_film import land_growth_power
from bearing_model.physics.outer_ring import outer_ring
from bearing_model.physics.race_contact import race_growth_power


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


def friction_torque(w):
    """Torque of the shaft about its axis [N.m], [..., 1]."""
    return -vec_dot(w.ring.M, w.ring.a)


def housing_power(model, w):
    """Power of the housing into balls and cage [W], [..., 1]."""
    outer, (F, M) = outer_ring(model.ring_load, w.x), housing_wrench(model, w)
    return -vec_dot(F, outer.v) - vec_dot(M, outer.Omega)


def frame_power(model, w):
    """Power of gravity and of the frame's inertia forces into balls and cage, less cage_widening [W], [..., 1]."""
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
    return power - cage_drawn(w, frame.frame_omega_dot)


def loss_terms(model, w):
    """Powers dissipated [W] by name, each [..., 1]."""
    return {
        "races": ball_array_sum(w.race_dissipated),
        "pockets": ball_array_sum(w.pocket_dissipated),
        "drag of the balls": ball_array_sum(w.drag_dissipated),
        "drag of the cage": w.cage_drag_dissipated,
        "drag of the ring": w.ring_drag_dissipated,
        "land": w.land_dissipated,
    } | cage_losses(model, w)


def power_loss(model, w):
    """Power dissipated in contacts, films, drag and joints [W], [..., 1]."""
    return sum(loss_terms(model, w).values())


def supply_terms(model, w):
    """Powers that rings, gravity and frame put into balls and cage [W] by name, each [..., 1]: the inner ring by its
    spin, translation and tilting.
    """
    ring = w.ring
    spin, translation = -ring.s * vec_dot(ring.M, ring.a), -vec_dot(ring.F, ring.v)
    return {
        "shaft torque": spin,
        "translation of the ring": translation,
        "tilting of the ring": shaft_power(w) - translation - spin,
        "growth of the ring": race_growth_power(model, w),
        "growth of the cage": land_growth_power(w),
        "housing": housing_power(model, w),
        "gravity and frame": frame_power(model, w),
    }


def net_power(model, w):
    """Net power into balls and cage [W], [..., 1]: by the rings' motions and the frame, less the dissipated power."""
    return sum(supply_terms(model, w).values()) - power_loss(model, w)
