"""Outputs by the names of the variable table, from the results of one evaluation of the right-hand side (of many states
at once, too).

Each function returns {name: array}: [...] for one value, [..., Z] for the elements of name[j] or name[k].
"""

import numpy as np

from bearing_model.cage.cage import cage_flex, cage_loads, cage_slip, cage_widened, cage_widening
from bearing_model.generated import variables as Y
from bearing_model.generated.variables import RingMotion, Stress, Z
from bearing_model.instance.energy import energy_total
from bearing_model.instance.events import event_outputs
from bearing_model.numbers.lanes import ball_array_sum
from bearing_model.numbers.vec import vec, vec_dot, vec_local
from bearing_model.physics.hertz import hertz_pressure
from bearing_model.physics.outer_ring import spread
from bearing_model.physics.powers import (
    frame_power,
    friction_torque,
    housing_power,
    housing_wrench,
    power_loss,
    shaft_power,
)
from bearing_model.physics.ring_fit import ring_fit_growth, ring_fit_speed
from bearing_model.physics.ring_load import ring_tilts
from bearing_model.physics.traction import Q_FLOOR, traction_ln_film, traction_ln_thermal
from bearing_model.rivet.rivet_rom import HEAD_P1, HEAD_VM, MID_P1, MID_VM, rivet_rom_stress

STANDSTILL = 1e-9  # rad/s: up to it a speed is none that others are compared with


def ring_outputs(model, w, y_dot):
    F, M = housing_wrench(model, w)
    given, prescribed = model.ring_load, model.p.ring.motion == RingMotion.PRESCRIBED
    beta, gamma = -w.ring.a[2], w.ring.a[1]
    tilt_y, tilt_z = ring_tilts(beta, gamma)
    values = {f"ring.{name}": w.ring.x[i] for i, name in enumerate("xyz")}
    values |= {f"ring.v_{name}": w.ring.v[i] for i, name in enumerate("xyz")}
    names, blocks = (
        ("a_x", "a_y", "a_z", "beta_ddot", "gamma_ddot"),
        (Y.RING_V_X, Y.RING_V_Y, Y.RING_V_Z, Y.RING_BETA_DOT, Y.RING_GAMMA_DOT),
    )
    accelerations = (
        spread((*given.a, given.beta_ddot, given.gamma_ddot), w.x)
        if prescribed
        else [y_dot[..., block] for block in blocks]
    )
    values |= {f"ring.{name}": value for name, value in zip(names, accelerations, strict=True)}
    values |= {
        "ring.beta": beta,
        "ring.gamma": gamma,
        "ring.beta_dot": -w.ring.a_dot[2],
        "ring.gamma_dot": w.ring.a_dot[1],
    }
    values |= {"ring.tilt_y": tilt_y, "ring.tilt_z": tilt_z}
    values |= {f"housing.F_{name}": F[i] for i, name in enumerate("xyz")} | {
        f"housing.M_{name}": M[i] for i, name in enumerate("xyz")
    }
    outer = spread((*given.outer_x, *given.outer_a), w.x)
    tilts = ring_tilts(*spread((given.outer_beta, given.outer_gamma), w.x))
    names = [f"u_{i}" for i in "xyz"] + [f"a_{i}" for i in "xyz"] + ["u_tilt_y", "u_tilt_z"]
    values |= {f"housing.{name}": value for name, value in zip(names, (*outer, *tilts), strict=True)}
    values |= {f"shaft.R_{name}": w.ring.F[i] for i, name in enumerate("xyz")} | {
        "shaft.R_My": w.ring.M[1],
        "shaft.R_Mz": w.ring.M[2],
    }
    values["bearing.friction_torque"] = friction_torque(w)
    return {name: value[..., 0] for name, value in values.items()}


def film_ratio(d, race, U, Q):
    """Film thickness / roughness Lambda at mean speed U and load Q, 0 without contact."""
    ln_U = np.log(U)
    return np.where(
        Q > 0.0,
        np.exp(traction_ln_film(race.ln_Lambda, ln_U, np.log(Q + Q_FLOOR)) + traction_ln_thermal(d.ln_thermal, ln_U)),
        0.0,
    )


def spin_roll(w):
    """Spin of the ball against the inner ring about the contact normal / rolling speed across it."""
    rel = vec(w.omega_x, w.omega_r, w.omega_t) - vec_local(w.ring.Omega, w.cos_theta, w.sin_theta)
    spin, all_ = vec_dot(rel, w.n_i), vec_dot(rel, rel)
    counts = (w.Q_i > 0.0) & (all_ > spin * spin)
    return np.where(counts, spin / np.sqrt(np.where(counts, all_ - spin * spin, 1.0)), 0.0)


def pocket_loads(w):
    """Loads of the balls on both halves together [..., Z] [N]."""
    return w.pocket[0].Q + w.pocket[1].Q


def ball_outputs(model, w):
    d, delta_c, Q_c = model.d, np.max(w.delta_c, axis=0), pocket_loads(w)
    deltas = np.array([w.delta_i, w.delta_e, delta_c])
    return {
        "ball[j].Q_i": w.Q_i,
        "ball[j].Q_e": w.Q_e,
        "ball[j].Q_c": Q_c,
        "ball[j].Q_cx": sum(pocket.F[0] for pocket in w.pocket),
        "ball[j].omega_m": w.omega_m,
        "ball[j].alpha_i": np.where(w.Q_i > 0.0, np.arctan2(-w.n_i[0], -w.n_i[1]), 0.0),
        "ball[j].alpha_e": np.where(w.Q_e > 0.0, np.arctan2(w.n_e[0], w.n_e[1]), 0.0),
        "ball[j].p_i": hertz_pressure(d.inner.hertz, w.Q_i),
        "ball[j].p_e": hertz_pressure(d.outer.hertz, w.Q_e),
        "ball[j].Lambda_i": film_ratio(d, d.inner, w.U_i, w.Q_i),
        "ball[j].Lambda_e": film_ratio(d, d.outer, w.U_e, w.Q_e),
        "ball[j].spin_roll": spin_roll(w),
        "bearing.clearance": model.p.bearing.P_d
        - 2.0 * ring_fit_growth(d.fit, ring_fit_speed(model.ring_load))
        + 0.0 * Q_c[..., 0],
        "bearing.contacts": np.sum(deltas > 0.0, axis=(0, -1)),
        "bearing.penetration": np.maximum(np.max(deltas, axis=(0, -1)), 0.0),
        "cage.F_pocket_max": np.max(Q_c, axis=-1),
    }


def pose_outputs(model, w, y):
    values = {"ball[j].x": w.x, "ball[j].r": w.r, "ball[j].psi": y[..., Y.BALL_THETA]}
    for h, half in enumerate(w.half):
        tilt_y, tilt_z = ring_tilts(-half.a[2], half.a[1])
        pose = dict(zip(("x", "y", "z", "tilt_y", "tilt_z"), (*half.x, tilt_y, tilt_z), strict=True))
        values |= {f"half_{h}.{name}": value[..., 0] for name, value in pose.items()} | {
            f"half_{h}.psi": y[..., Y.CAGE_PSI][..., h]
        }
        values |= {
            f"rivet[k].flex_{h}_{name}": value for name, value in zip("xrt", cage_flex(model, w, h), strict=True)
        }
    return values


def cage_outputs(model, w):
    h0, h1 = w.half
    outer = model.ring_load.outer_omega
    epicyclic = outer + 0.5 * (model.ring_load.omega - outer) * (1.0 - model.p.bearing.D / model.p.bearing.d_m)
    e = (0.5 * (h0.x + h1.x) - w.outer_x)[..., 0]
    omega, centre = 0.5 * (h0.s + h1.s)[..., 0], 0.5 * (h0.x + h1.x)[..., 0]
    return {
        "cage.omega": omega,
        "cage.slip_ratio": 1.0 - omega / epicyclic if abs(epicyclic) > STANDSTILL else 0.0 * omega,
        "cage.y": centre[1],
        "cage.z": centre[2],
        "cage.eccentricity": np.hypot(e[1], e[2]) / model.d.play,
    }


def rivet_outputs(model, w):
    load = cage_loads(model, w)
    slip, c, s = cage_slip(model, w), model.d.rivet_y * model.d.inv_R, model.d.rivet_z * model.d.inv_R

    def along_y_z(r, t):
        return r * c - t * s, r * s + t * c

    (V_y, V_z), (M_y, M_z), (m_y, m_z) = (
        along_y_z(*v) for v in ((load.V_r, load.V_t), (load.M_r, load.M_t), (load.m_r, load.m_t))
    )
    return {
        "rivet[k].N": load.N,
        "rivet[k].V": load.V,
        "rivet[k].T": load.T,
        "rivet[k].M": np.hypot(load.M_r, load.M_t),
        "rivet[k].M_shank": np.hypot(load.m_r, load.m_t),
        "rivet[k].P": np.full(load.N.shape, model.d.P),
        "rivet[k].V_y": V_y,
        "rivet[k].V_z": V_z,
        "rivet[k].M_y": M_y,
        "rivet[k].M_z": M_z,
        "rivet[k].M_shank_y": m_y,
        "rivet[k].M_shank_z": m_z,
        "rivet[k].F_head": load.F_head,
        "rivet[k].slip": slip,
        "cage.dislocation": np.max(slip, axis=-1),
        "rivet.table_kind": np.full(load.N.shape[:-1], float(model.d.table.kind_number)),
    }


def stress_outputs(model, w):
    shape = w.x.shape
    sigma, flags = np.zeros((*shape, 4)), np.zeros(shape)
    if model.p.scene.stress != Stress.OFF:
        sigma, flags = rivet_rom_stress(model.d.table, cage_loads(model, w).rivet, model.d.fit_eff)
        flags = flags | model.d.fit_flags
    return {
        "rivet[k].sigma_head": sigma[..., HEAD_P1],
        "rivet[k].sigma_head_vm": sigma[..., HEAD_VM],
        "rivet[k].sigma_mid": sigma[..., MID_VM],
        "rivet[k].sigma_mid_p1": sigma[..., MID_P1],
        "rivet[k].flag": flags,
    }


def energy_outputs(model, y, w, energy_start, energy_change):
    energy, work = energy_total(model, y, w), y[..., Y.WORK][..., 0]
    parts = {
        "races": w.race_dissipated,
        "inlet": w.inlet_dissipated,
        "spin": w.spin_dissipated,
        "ball_drag": w.drag_dissipated,
        "pockets": w.pocket_dissipated,
    }
    values = {f"loss.{name}": ball_array_sum(power) for name, power in parts.items()}
    values |= {
        "loss.cage_drag": w.cage_drag_dissipated,
        "loss.ring_drag": w.ring_drag_dissipated,
        "loss.land": w.land_dissipated,
    }
    friction = ball_array_sum(w.joint_dissipated)
    values["loss.joints"] = friction if model.modes else friction + w.cage.two_half.dissipated
    values["loss.modes"] = w.cage.elastic.dissipated + 0.0 * values["loss.races"]
    values["bearing.power_loss"] = power_loss(model, w) + friction
    values |= {
        "shaft.power": shaft_power(w),
        "housing.power": housing_power(model, w),
        "frame.power": frame_power(model, w) + cage_widening(w, model.ring_load.frame_omega_dot),
    }
    return {name: value[..., 0] for name, value in values.items()} | {
        "bearing.energy": (energy[..., None] + cage_widened(w))[..., 0],
        "bearing.energy_change": energy_change + 0.0 * energy,
        "bearing.energy_residual": energy - energy_start - energy_change - work,
    }


def outputs(model, w, y, y_dot, energy_start, energy_change=0.0):
    """All outputs but peaks, statistics, fatigue, onsets and the solver's, at the states y.  energy_start: energy_total
    at the start, energy_change: energy that changes of parameters have added since [J].
    """
    values = {"bearing.Z": np.full(y.shape[:-1], float(Z))}
    values |= (
        ring_outputs(model, w, y_dot) | pose_outputs(model, w, y) | ball_outputs(model, w) | cage_outputs(model, w)
    )
    return (
        values
        | rivet_outputs(model, w)
        | stress_outputs(model, w)
        | energy_outputs(model, y, w, energy_start, energy_change)
        | event_outputs(model, w)
    )
