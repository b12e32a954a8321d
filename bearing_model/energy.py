"""Energy of balls, cage halves and everything elastic between them and the rings.

    contacts (2/5) K delta^2.5, shared between the halves as in pocket.py;  joint T^2/(2 k_rivet) + N_plate^2/(2 k_plate) + k z^2/2 + hole contact

The inner ring is outside: its motion does the work -F.v - M.Omega of the contacts.
"""

from bearing_model.hertz import hertz_energy
from bearing_model.lanes import lanes_sum
from bearing_model.variables import CageModel
from bearing_model.vec import vec, vec_cross, vec_dot


def energy_total(model, w):
    """Kinetic and elastic energy [J] at the state of the evaluation w."""
    p, d = model.p, model.d
    v, omega = vec(w.v_x, w.v_r, w.v_t), vec(w.omega_x, w.omega_r, w.omega_t)
    E = 0.5 * d.m * vec_dot(v, v) + 0.5 * d.J * vec_dot(omega, omega)
    E = E + hertz_energy(d.inner.hertz.K, w.delta_i) + hertz_energy(d.outer.hertz.K, w.delta_e) + w.pocket_energy
    if p.scene.cage == CageModel.TWO_HALF:
        E = E + w.joint_energy
    E = lanes_sum(E) + w.land_elastic
    for half in w.half:
        v = half.v + vec_cross(half.Omega, half.c)  # of the centre of mass
        E = E + 0.5 * (p.cage.m * vec_dot(v, v) + p.cage.J_t * vec_dot(half.a_dot, half.a_dot) + p.cage.J_p * half.s**2)
    return E[..., 0]
