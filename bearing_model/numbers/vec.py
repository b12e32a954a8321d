"""Vectors: axis 0 holds the components, (x, r, t) in the balls' own frames, (x, y, z) in the global one."""

import numpy as np


def vec(x, r, t):
    """A vector from its components."""
    v = np.empty((3, *np.broadcast(x, r, t).shape), np.result_type(x, r, t, float))
    v[0], v[1], v[2] = x, r, t
    return v


def vec_dot(u, v):
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def vec_cross(u, v):
    return np.array([u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]])


def vec_across(v, n):
    """The part of v across the unit vector n."""
    return v - vec_dot(v, n) * n


def vec_local(v, cos_theta, sin_theta):
    """Components of a vector of the global frame in the frames of balls at azimuth theta."""
    return np.array([v[0] + 0.0 * cos_theta, v[1] * cos_theta + v[2] * sin_theta, v[2] * cos_theta - v[1] * sin_theta])


def vec_to_global(v, cos_theta, sin_theta):
    """Components of a vector of the balls' frames in the global frame."""
    return np.array([v[0], v[1] * cos_theta - v[2] * sin_theta, v[1] * sin_theta + v[2] * cos_theta])
