"""Energy of balls, cage halves and everything elastic between them and the rings, and the powers that change it.

    contacts (2/5) K delta^2.5, shared between the halves as in pocket.py;  joint T^2/(2 k_rivet) + N_plate^2/(2
    k_plate) + k z^2/2 + hole contact

The rings are outside this balance: their motions put the power -F.v - M.Omega into balls and cage, with F and M of
contacts and films on the ring, and the inner ring's growth the power -K delta^1.5 n.e dR_g/dt (race_contact.py).  In a
frame that moves, motions are relative to it, and its inertia forces do work as gravity does (powers.py).
"""

from bearing_model.generated.variables import CageModel
from bearing_model.numbers.lanes import ball_array_sum
from bearing_model.numbers.vec import vec, vec_cross, vec_dot
from bearing_model.physics.hertz import hertz_energy
from bearing_model.physics.powers import frame_power, housing_power, shaft_power
from bearing_model.physics.race_contact import race_growth_power


def energy_terms(model, w):
    """Kinetic and elastic energies [J] by name at the state of the evaluation w, each [..., 1]."""
    p, d = model.p, model.d
    v, omega = vec(w.v_x, w.v_r, w.v_t), vec(w.omega_x, w.omega_r, w.omega_t)
    terms = {
        "motion of the balls": ball_array_sum(0.5 * d.m * vec_dot(v, v) + 0.5 * d.J * vec_dot(omega, omega)),
        "motion of the cage": 0.0,
        "races, elastic": ball_array_sum(
            hertz_energy(d.inner.hertz.K, w.delta_i) + hertz_energy(d.outer.hertz.K, w.delta_e)
        ),
        "pockets, elastic": ball_array_sum(w.pocket_energy),
        "land, elastic": w.land_elastic,
    }
    if p.scene.cage == CageModel.ELASTIC:
        terms["modes of the cage"] = w.modes_energy
    if p.scene.cage != CageModel.RIGID:
        terms["joints, elastic"] = ball_array_sum(w.joint_energy)
    for half in w.half:
        v = half.v + vec_cross(half.Omega, half.c)  # of the centre of mass
        motion = 0.5 * (p.cage.m * vec_dot(v, v) + d.J_t * vec_dot(half.a_dot, half.a_dot) + d.J_p * half.s**2)
        terms["motion of the cage"] = terms["motion of the cage"] + motion
    return terms


def energy_total(model, w):
    """Kinetic and elastic energy [J] at the state of the evaluation w."""
    return sum(energy_terms(model, w).values())[..., 0]


def loss_terms(model, w):
    """Powers dissipated [W] by name, each [..., 1]."""
    terms = {
        "races": ball_array_sum(w.race_dissipated),
        "pockets": ball_array_sum(w.pocket_dissipated),
        "drag of the balls": ball_array_sum(w.drag_dissipated),
        "drag of the cage": w.cage_drag_dissipated,
        "drag of the ring": w.ring_drag_dissipated,
        "land": w.land_dissipated,
    }
    if model.p.scene.cage != CageModel.RIGID:
        terms["joints"] = ball_array_sum(w.joint_dissipated)
    if model.p.scene.cage == CageModel.ELASTIC:
        terms["modes"] = w.modes_dissipated
    return terms


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
        "housing": housing_power(model, w),
        "gravity and frame": frame_power(model, w),
    }


def net_power(model, w):
    """Net power into balls and cage [W], [..., 1]: by the rings' motions and the frame, less what is dissipated."""
    return sum(supply_terms(model, w).values()) - power_loss(model, w)
