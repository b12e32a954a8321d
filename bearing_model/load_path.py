"""From pocket forces to the rivets: twin of fmu_src/load_path.c, where sketch and equations stand (load_path.h)."""

import numpy as np

PATH_N, PATH_V_R, PATH_V_T, PATH_M_R, PATH_M_T = range(5)


def load_path_rigid(d_m, wrench, c, s):
    """Rigid share: N, V_y, V_z at each rivet [N] of the wrench (F_x, F_y, F_z, M_x, M_y, M_z) [N, N.m] on the +x half at the circle's centre.

    c, s: cosine and sine of the rivets' angles.  Bolt group of equal rivets.

    >>> load_path_rigid(2.0, [9.0, 0, 0, 0, 0, 0], np.ones(9), np.zeros(9))[0][0]
    np.float64(1.0)
    """
    c, s, Z, R = np.asarray(c), np.asarray(s), len(c), 0.5 * d_m
    shear = wrench[3] / (Z * R)
    N = wrench[0] / Z + 2.0 * (wrench[4] * s - wrench[5] * c) / (Z * R)
    return N, wrench[1] / Z - shear * s, wrench[2] / Z + shear * c


def load_path_flexible(matrix, side, F_x, F_r, F_t):
    """Flexible share [Z, 5] (N, V_r, V_t, M_r, M_t) of the pocket forces [N] on the half at `side` (+1 or -1); matrix [Z, 5, 3], circulant."""
    Z, matrix = len(matrix), np.asarray(matrix)
    F_t = np.asarray(F_t, dtype=float)
    relative = (np.arange(Z)[:, None] - np.arange(Z)) % Z  # rivet k, pocket j
    mirrored = matrix[::-1] * np.array([1.0, 1.0, -1.0, -1.0, 1.0])[:, None]  # the opposite wall
    loads = np.einsum("kjlf,fj->kl", matrix[relative][..., :2], np.stack([side * np.asarray(F_x, dtype=float), F_r]))
    loads += np.einsum("kjl,j->kl", matrix[relative][..., 2], np.maximum(F_t, 0.0))
    loads += np.einsum("kjl,j->kl", mirrored[relative][..., 2], np.maximum(-F_t, 0.0))
    loads[:, PATH_V_R : PATH_V_T + 1] *= side
    return loads
