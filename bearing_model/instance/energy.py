"""Energy of balls, cage halves and everything elastic between them and the rings.

    contacts  (2/5) K delta^2.5, of races that are not perfect as in race_surface.py; in pockets shared between the halves as in pocket.py
    cage      halves, pockets, joints and modes (cage.py), less the work of a turning frame's centrifugal load (cage_widened)

The rings are outside this balance: their motions put the power -F.v - M.Omega into balls and cage, with F and M of
contacts and films on the ring, and the inner ring's growth the power -K delta^1.5 n.e dR_g/dt (race_contact.py).  In a
frame that moves, motions are relative to it, and its inertia forces do work as gravity does (powers.py).
"""

from bearing_model.cage.cage import cage_energy
from bearing_model.numbers.lanes import ball_array_sum
from bearing_model.numbers.vec import vec, vec_dot
from bearing_model.physics.hertz import hertz_energy


def energy_terms(model, y, w):
    """Kinetic and elastic energies [J] by name at the state y of the evaluation w, each [..., 1]."""
    d, v, omega = model.d, vec(w.v_x, w.v_r, w.v_t), vec(w.omega_x, w.omega_r, w.omega_t)
    perfect = hertz_energy(d.inner.hertz.K, w.delta_i) + hertz_energy(d.outer.hertz.K, w.delta_e)
    races = w.race_stored if d.rough else perfect
    return {
        "motion of the balls": ball_array_sum(0.5 * d.m * vec_dot(v, v) + 0.5 * d.J * vec_dot(omega, omega)),
        "races, elastic": ball_array_sum(races),
        "land, elastic": w.land_elastic,
    } | cage_energy(model, y, w)


def energy_total(model, y, w):
    """Kinetic and elastic energy less cage_widened [J] at the state y of the evaluation w."""
    return sum(energy_terms(model, y, w).values())[..., 0]
