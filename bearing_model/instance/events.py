"""Events: conditions that the model's laws do not cover, or that a user wants to know at once; counted from the results of one
evaluation.

land contact   land of a half beyond the guide clearance: e > C                                            (land_film: dry contact)
pocket exit    centre of a ball outside the cage's section D_i/2 ... D_o/2: a real pocket ends there       (pocket: the cylinder does not)
ellipse cut    |alpha| + a/R_m > arccos(1 - h D/r_g): the contact ellipse reaches over the shoulder         (race_contact: Hertz uncut)
overpressure   p_max > bearing.p_limit at a race: permanent deformation, which Hertz' law does not know     ISO 76
joint open     plates of a joint apart: u_x > P/k_plate
energy off     the energy's residual passes 2 % of the losses, or energy is gained instead of lost
no clearance   speed, temperatures and fits leave a diametral clearance below 0: the bearing is preloaded

The core also counts the onsets of events and reports them to the log, and finds rivets that yield from their peak
stresses.
"""

import numpy as np

from bearing_model.numbers.vec import vec, vec_dot, vec_local, vec_to_global
from bearing_model.physics.hertz import hertz_pressure
from bearing_model.physics.land_film import land_clearance
from bearing_model.physics.ring_fit import ring_fit_growth, ring_fit_speed


def lands(model, w):
    """Distance of the middle of each land from the outer ring's axis, and the distance at which the land touches the
    ring [m], infinite of a cage that balls guide; [..., 2].
    """
    x_land = (-model.p.cage.land_x, model.p.cage.land_x)
    arms = [half.x + x * half.a - w.outer_x for half, x in zip(w.half, x_land, strict=True)]
    e = [np.hypot(arm[1] - arm[0] * w.outer_gamma, arm[2] + arm[0] * w.outer_beta) for arm in arms]
    e = np.concatenate(np.broadcast_arrays(*e), axis=-1)
    if not model.d.guided:
        return e, np.inf
    return e, land_clearance(model.d, np.concatenate([half.s for half in w.half], axis=-1) + w.frame_omega)


def pockets(model, w):
    """Radial distance of each ball from the middle of the cage's section, and half the section's height [m]; [..., Z]."""
    cage, d = model.p.cage, model.d
    middle, reach = 0.25 * (cage.D_o + cage.D_i), 0.25 * (cage.D_o - cage.D_i)
    position = vec_to_global(vec(w.x, w.r, 0.0), w.cos_theta, w.sin_theta)
    radial = [vec_dot(position - half.x, d.pocket_cos * half.b_y + d.pocket_sin * half.b_z) for half in w.half]
    return np.max(np.abs(np.array(radial) - middle), axis=0), reach


def ellipse_reach(model, w):
    """Angles from the groove's bottom to which the contact ellipses on inner and outer race reach [rad], 0 without
    contact; (2, ..., Z).
    """
    tilted = vec_dot(w.n_i, vec_local(w.ring.a, w.cos_theta, w.sin_theta))
    sides = ((model.d.inner, w.Q_i, tilted), (model.d.outer, w.Q_e, w.n_e[0]))
    reach = [
        np.arcsin(np.minimum(np.abs(along), 1.0)) + race.hertz.a * np.cbrt(Q) / race.R_m for race, Q, along in sides
    ]
    return np.where(np.array([w.Q_i, w.Q_e]) > 0.0, reach, 0.0)


def energy_off(residual, held, exchanged, lost, lost_now):
    """1 if the residual of the energy passes 2 % of the energy lost since the start, or energy is gained in the last
    communication step, else 0.  Errors of the start and of pulses are small beside the energy that moves: 1 % of that in
    the bearing and 0.4 % of that which the shaft has exchanged are allowed in any case.
    """
    return float(lost_now < 0.0 or not abs(residual) <= max(0.02 * lost, 0.01 * held, 0.004 * exchanged))


def event_outputs(model, w):
    """Number of balls, lands or joints at which each kind of event happens, by the names of the variable table."""
    d, p = model.d, model.p
    edges = [
        np.arccos(1.0 - height * p.bearing.D / race.r_g)
        for race, height in ((d.inner, p.bearing.h_i), (d.outer, p.bearing.h_e))
    ]
    pressures = [hertz_pressure(race.hertz, Q) for race, Q in ((d.inner, w.Q_i), (d.outer, w.Q_e))]

    def count(value, limit):
        return np.sum(value > limit, axis=-1).astype(float)

    return {
        "event.land_contact": count(*lands(model, w)),
        "event.pocket_exit": count(*pockets(model, w)),
        "event.ellipse_cut": sum(
            count(reach, edge) for reach, edge in zip(ellipse_reach(model, w), edges, strict=True)
        ),
        "event.overpressure": sum(count(value, p.bearing.p_limit) for value in pressures),
        "event.no_clearance": count(
            2.0 * ring_fit_growth(d.fit, ring_fit_speed(model.ring_load)) - p.bearing.P_d + 0.0 * w.x[..., :1], 0.0
        ),
        "event.joint_open": count(w.u[0], d.P / d.k_plate),
        "event.step_too_long": np.zeros_like(w.x[..., 0]),  # its methods choose their steps
    }
