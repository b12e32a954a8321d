"""Traction of a contact whose slip varies over the long axis of the ellipse: its slices.  Equations in race_contact.py."""

import numpy as np
from scipy.special import roots_jacobi

from bearing_model.numbers.lanes import maximum, minimum

SIDE = np.repeat([-1.0, 1.0], 6)
Z_JACOBI, W_JACOBI = np.tile(roots_jacobi(6, 1.0, 0.0), 2)  # on either side, of the weight 1 - z on [-1, 1]
TINY = 1e-30  # [m^2/s^2] keeps contacts without load from dividing by 0


def split_place(s_1, k, b_1):
    """Place x_0 = -s_1 k/(k^2 + b_1^2) in [-1, 1] where the slip s_1 + k x + b_1 x^2 changes its sign."""
    return maximum(minimum(-s_1 * k / (k * k + b_1 * b_1 + TINY), 1.0), -1.0)


def slices(x_0):
    """Places x in [-1, 1] and shares of the pressure (3/4)(1 - x^2) of all slices, [12, ...]: on each side x = x_0 (1 -
    z) + side z with (3/4)(1 + side x)(1 - side x_0)^2 w, where z and w are Gauss-Jacobi's points for the weight 1 - z
    on [0, 1].  Polynomials up to degree 10 on each side are integrated exactly.
    """
    side, z, w = (column.reshape(-1, *[1] * np.ndim(x_0)) for column in (SIDE, 0.5 * (Z_JACOBI + 1.0), 0.25 * W_JACOBI))
    x = x_0 * (1.0 - z) + side * z
    return x, (1.0 + side * x) * 0.75 * (1.0 - side * x_0) ** 2 * w
