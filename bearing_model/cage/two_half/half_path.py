"""From pocket forces over the wall's angle to the loads that bonded joints would carry; rivet_model/half_loads.py makes
the numbers.

Rows of a joint's loads, on the +x half in the frame (x, r, t) at the rivet: N, V_r, V_t, M_r, M_t of the joint [N, N.m]
(N and V: elastic less the rigid halves' share, which the dynamics has), then dP, dm_r, dm_t: what the rivet gets beside
it because the half gives under its head.
"""

import numpy as np

ROWS = ("N", "V_r", "V_t", "M_r", "M_t", "dP", "dm_r", "dm_t")
# of the rows N, V_r, V_t, M_r, M_t, dP, dm_r, dm_t in the pocket's plane
PATH_MIRROR = np.array([1.0, 1.0, -1.0, -1.0, 1.0, 1.0, -1.0, 1.0])
PATH_SIDE = np.array([1.0, -1.0, -1.0, 1.0, 1.0, 1.0, 1.0, 1.0])  # of a mirrored force on the -x half


def path_slopes(chi, matrix):
    """Slopes of the C1 cubic through the matrix [nodes, Z, 8, 3] over the angle chi: those of the parabolas through
    three neighbours.

    Beyond the pocket's bottom (chi = pi/2) the path is its mirror image, so the last parabola is through the last two
    nodes and the mirrored one.
    """
    mirrored = matrix[-2][::-1] * PATH_MIRROR[:, None] * [1.0, 1.0, -1.0]
    return cubic_slopes(np.append(chi, np.pi - chi[-2]), np.concatenate([matrix, mirrored[None]]))


def cubic_slopes(x, y):
    """Slopes of the parabolas through three neighbouring places x [n] at all values y [n, ...] but the last; the first
    by its parabola's end.
    """
    h = np.diff(x).reshape(-1, *[1] * (y.ndim - 1))
    d = np.diff(y, axis=0) / h
    inner = (h[1:] * d[:-1] + h[:-1] * d[1:]) / (h[1:] + h[:-1])
    return np.concatenate([(d[0] + (d[0] - inner[0]))[None], inner])


def path_rows(chi, matrix, slopes, at):
    """Rows [Z, 8, 3] per unit force (x, r, t) on pocket 0 of the +x half at the wall's angle `at` in [0, pi/2]."""
    i = min(max(int(np.searchsorted(chi, at, side="right")) - 1, 0), len(chi) - 2)
    h = chi[i + 1] - chi[i]
    u = (at - chi[i]) / h
    v = 1.0 - u
    return (
        matrix[i] * v * v * (1.0 + 2.0 * u)
        + matrix[i + 1] * u * u * (1.0 + 2.0 * v)
        + h * u * v * (slopes[i] * v - slopes[i + 1] * u)
    )


def path_load(half, side, push, force):
    """Rows [Z, 8] at all joints of the forces [3, Z] (x, r, t) on the pockets of the half at `side` (+1 or -1):
    flexible share.

    Each force acts where its normal part push [2, Z] (x, t) points on the wall: chi = atan2(|push_x|, |push_t|).
    """
    Z = half.path.shape[1]
    rows = np.zeros((Z, len(PATH_MIRROR)))
    for j in np.flatnonzero(np.any(force, axis=0)):
        at = path_rows(half.chi, half.path, half.path_slope, np.arctan2(abs(push[0, j]), abs(push[1, j])))
        back = push[1, j] < 0.0
        own = at @ (force[:, j] * [side, 1.0, -1.0 if back else 1.0])
        if back:
            own = own[::-1] * PATH_MIRROR
        rows += np.roll(own, j, axis=0) * (PATH_SIDE if side < 0 else 1.0)
    return rows


def bolt_group(d_m, wrench, c, s):
    """Rigid share: N, V_y, V_z at each rivet [N] of the wrench (F_x, F_y, F_z, M_x, M_y, M_z) [N, N.m] on the +x half
    at the circle's centre.

    c, s: cosine and sine of the rivets' angles.  Rigid halves on a circle of equal elastic rivets, whose own bending
    stiffness is neglected.

    >>> bolt_group(2.0, [9.0, 0, 0, 0, 0, 0], np.ones(9), np.zeros(9))[0][0]
    np.float64(1.0)
    """
    c, s, Z, R = np.asarray(c), np.asarray(s), len(c), 0.5 * d_m
    shear = wrench[3] / (Z * R)
    N = wrench[0] / Z + 2.0 * (wrench[4] * s - wrench[5] * c) / (Z * R)
    return N, wrench[1] / Z - shear * s, wrench[2] / Z + shear * c
