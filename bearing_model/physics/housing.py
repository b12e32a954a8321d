"""A housing on springs, housing.motion = supported: a rigid body that carries the outer ring.

    m x'' = F - F_0 - k (x - x_b) - c (x' - x_b') + m (field - field_0)    along X, Y and Z
    J b'' = M - M_0 - k_t (b - b_b) - c_t (b' - b_b')                      tilts about Y and Z, direction cosines

F, M: load of balls, cage and oil on the outer ring about its centre (powers.py); x_b, b_b: motion of the base, the
inputs housing.*.  F_0, M_0 belong to the start: there the springs carry the load, and the housing rests at its base's
place.  The turn about X is given by housing.omega.
"""

from dataclasses import replace

import numpy as np

from bearing_model.physics.frame import frame_acceleration
from bearing_model.physics.powers import housing_wrench

AXES = ("x", "y", "z", "tilt_y", "tilt_z")


def housing_base(ring_load):
    """Position and velocity of the base: x, y, z, direction cosines beta and gamma."""
    load = ring_load
    return (
        np.array([*load.outer_x, load.outer_beta, load.outer_gamma]),
        np.array([*load.outer_v, load.outer_beta_dot, load.outer_gamma_dot]),
    )


def housing_place(x, v, ring_load):
    """The RingLoad with the outer ring where the housing is."""
    cosines = {"outer_beta": x[3], "outer_gamma": x[4], "outer_beta_dot": v[3], "outer_gamma_dot": v[4]}
    return replace(ring_load, outer_x=tuple(x[:3]), outer_v=tuple(v[:3]), **cosines)


def housing_load(model, w, x, v):
    """Load on the housing without springs, of the evaluation w [N], [N.m]."""
    F, M = housing_wrench(model, w)
    field = frame_acceleration(model.ring_load, x[:3], v[:3])
    return np.array([*(F[:, 0] + model.p.housing.m * np.ravel(field)), M[1, 0], M[2, 0]])


def housing_acceleration(model, w, x, v, base, base_dot, rest):
    """Accelerations [m/s2], [1/s2] at the position x and velocity v; rest: load at the start."""
    p = model.p.housing
    k, c = (np.array([getattr(p, f"{letter}_{axis}") for axis in AXES]) for letter in "kc")
    inertia = np.array([p.m, p.m, p.m, p.J, p.J])
    return (housing_load(model, w, x, v) - rest - k * (x - base) - c * (v - base_dot)) / inertia
