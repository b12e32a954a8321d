"""Models and states of every kind in which the right-hand side has a branch, and the matrix of its derivatives."""

import itertools

import numpy as np
from mechanics import SLICE, running_state

from bearing_model.generated.variables import N_STATES, CageModel, Lubrication, TiltMode, Traction
from bearing_model.solver.verlet import FRICTION

KINDS = (
    "pockets closed",
    "pockets open",
    "rolling",
    "separated",
    "dry land",
    "high tilt",
    "unloaded",
    "joints apart",
    "slow",
)
SCENES = list(itertools.product([CageModel.TWO_HALF], Traction, Lubrication, TiltMode))  # 12 of them: 108 states


def make_model(core, kind, scene, **changes):
    cage, traction, lubrication, tilt_mode = scene
    parameters = {
        "scene.cage": cage,
        "scene.traction": traction,
        "scene.lubrication": lubrication,
        "ring.tilt_mode": tilt_mode,
    }
    parameters |= {"gravity.y": -9.81, "gravity.z": 3.0, "cage.unbalance": 1e-8, "ring.c": 50.0, "oil.v_0": 0.01}
    inputs = {"shaft.M_y": 0.5, "shaft.M_z": -0.7}
    if kind == "high tilt":
        inputs |= {"shaft.tilt_y": 0.003, "shaft.tilt_z": 0.0087}
    if kind == "unloaded":
        inputs |= {"shaft.F_x": 0.0, "shaft.F_y": 0.0, "shaft.M_y": 0.0, "shaft.M_z": 0.0}
    if kind == "slow":
        inputs |= {"shaft.omega": 30.0}
    return core.model(parameters | changes, inputs)


def push_cage(model, y, eccentricity):
    """Push the cage toward Y and turn the balls with their pockets."""
    shift = eccentricity * model.d.C_land - y[SLICE["cage_y"]].mean(), -y[SLICE["cage_z"]].mean()
    theta = y[SLICE["ball_theta"]]
    theta += (shift[1] * np.cos(theta) - shift[0] * np.sin(theta)) / (0.5 * model.p.bearing.d_m)
    y[SLICE["cage_y"]] += shift[0]
    y[SLICE["cage_z"]] += shift[1]


def make_state(model, kind, rng):
    y = running_state(
        model,
        rng,
        pockets=kind not in ("pockets open", "separated"),
        slip={"rolling": 1e-3, "slow": 0.02}.get(kind, 1.0),
    )
    if kind == "separated":  # balls halfway between the races
        y[SLICE["ball_x"]], y[SLICE["ball_r"]] = 0.0, 0.5 * model.p.bearing.d_m
        for name in ("ring_x", "ring_y", "ring_z", "ring_beta", "ring_gamma"):
            y[SLICE[name]] = 0.0
    if kind == "dry land":
        push_cage(model, y, 1.02)
    if kind == "pockets open":  # plates and heads slip
        y[FRICTION] *= 300.0
    if kind == "joints apart":  # plates open, shanks against their holes
        y[SLICE["cage_x"]][1] += 1e-5
        y[SLICE["cage_z"]][1] += 3e-5
    return y


def rhs(model, y, t=0.0):
    """dy/dt with the drive as it is."""
    out = np.empty(N_STATES)
    model.kernel("rhs")(model.pointer, t, model.core.array(y), model.core.array(out), model.work)
    return out


def matrix(model, y):
    J = np.empty((N_STATES, N_STATES))
    model.core.lib.jacobian_matrix(model.pointer, 0.0, model.core.array(y), model.core.array(J))
    return J.T


def prepared(core, kind, scene, rng, **changes):
    """Model and state, the drive set."""
    model = make_model(core, kind, scene, **changes)
    y = make_state(model, kind, rng)
    model.rhs(0.0, y)
    return model, y
