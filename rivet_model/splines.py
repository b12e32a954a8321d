"""Interpolation by the clamped quadratic B-splines of bearing_model.rivet.rivet_splines, on one axis and on products of
axes.
"""

import numpy as np

from bearing_model.rivet.rivet_splines import cell_weights


def sites(knots):
    """Points that determine the spline: the ends and the middle of each cell."""
    knots = np.asarray(knots)
    return np.concatenate([knots[:1], 0.5 * (knots[1:] + knots[:-1]), knots[-1:]])


def collocation(knots, u):
    """Matrix of all splines at the points u [len(u), len(knots) + 1]."""
    cell, w = cell_weights(knots, u)
    matrix = np.zeros((len(cell), len(knots) + 1))
    for k in range(3):
        matrix[np.arange(len(cell)), cell + k] += w[:, k]
    return matrix


def interpolate(axes, values):
    """Coefficients of the tensor-product spline with `values` [sites of each axis ..., channels] at the sites of all
    axes.
    """
    for axis, knots in enumerate(axes):
        matrix = collocation(knots, sites(knots))
        values = np.moveaxis(np.tensordot(np.linalg.inv(matrix), values, axes=(1, axis)), 0, axis)
    return values
