"""Quadratic B-splines of the rivet table, one axis: twin of fmu_src/rivet/rivet_splines.h.

The splines are clamped and C1; three coefficients are active in each cell, and the first and the last coefficient are
the values at the ends.
"""

import functools

import numpy as np


def constants(knots):
    """rise and fall of each cell: w_2 = (u - t_i)^2 rise_i, w_0 = (t_(i+1) - u)^2 fall_i, w_1 = 1 - w_0 - w_2 (de
    Boor's recursion).

    >>> constants([0.0, 1.0])
    (array([1.]), array([1.]))
    """
    t = np.concatenate([[knots[0]], knots, [knots[-1]]])
    h = np.diff(knots)
    return 1.0 / ((t[3:] - t[1:-2]) * h), 1.0 / ((t[2:-1] - t[:-3]) * h)


@functools.lru_cache(maxsize=64)
def kept_constants(knots):
    """constants of knots that are given by their bytes, found once."""
    return constants(np.frombuffer(knots))


def cell_weights(knots, u):
    """Index of the first active coefficient and the three weights, u inside the knots.  Shapes u.shape, u.shape + (3,)."""
    knots, u = np.asarray(knots, dtype=float), np.asarray(u)
    rise, fall = kept_constants(knots.tobytes())
    cell = np.searchsorted(knots[1:-1], np.real(u), side="right")
    w_0 = (knots[cell + 1] - u) ** 2 * fall[cell]
    w_2 = (u - knots[cell]) ** 2 * rise[cell]
    return cell, np.stack([w_0, 1.0 - w_0 - w_2, w_2], axis=-1)
