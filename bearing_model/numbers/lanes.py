"""Arithmetic of the elements: the last axis runs over balls, joints or halves (length 1: a body's own numbers), leading
axes over states.

Comparisons look at real parts only, so that all functions are analytic between their kinks and a complex step y + ih dy
carries derivatives.
"""

import numpy as np


def maximum(x, y):
    """x or y, whichever has the larger real part."""
    return np.where(np.real(x) > np.real(y), x, y)


def minimum(x, y):
    """x or y, whichever has the smaller real part."""
    return np.where(np.real(x) < np.real(y), x, y)


def absolute(x):
    """x or -x, whichever has a real part that is not negative."""
    return np.where(np.real(x) < 0.0, -x, x)


def ball_array_sum(v):
    """Sum over the balls, kept as an axis of length 1."""
    return np.sum(v, axis=-1, keepdims=True)


def wide_pair(half_0, half_1):
    """Both halves side by side on the last axis."""
    return np.concatenate([half_0, half_1], axis=-1)
