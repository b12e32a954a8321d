"""From pocket forces over the wall's angle to the loads that bonded joints would carry; rivet_model/half_loads.py makes
the numbers.

Rows of a joint's loads, on the +x half in the frame (x, r, t) at the rivet: N, V_r, V_t, M_r, M_t of the joint [N, N.m]
(N and V: elastic less the rigid halves' share, which the dynamics has), then dP, dm_r, dm_t: what the rivet gets beside
it because the half gives under its head.

All pockets are alike, so the rows of rivet k by a force on pocket j depend on (k - j) mod Z only.  push_t < 0 acts as the
mirror image about the pocket does (rivet -1 - i for i; V_t, M_r and dm_r change sign), a force on the -x half as its
mirror image on the +x half does (V changes sign).
"""

import numpy as np

from bearing_model.numbers.lanes import absolute, maximum

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
    """Rows [..., Z, 8, 3] per unit force (x, r, t) on pocket 0 of the +x half at the wall's angles `at` [...] in [0, pi/2],
    from matrix and slopes [nodes, Z, 8, 3].
    """
    i = np.clip(np.searchsorted(chi, np.real(at), side="right") - 1, 0, len(chi) - 2)
    h = chi[i + 1] - chi[i]
    u = (at - chi[i]) / h
    h, u = (np.reshape(x, (*np.shape(x), *[1] * (matrix.ndim - 1))) for x in (h, u))
    v = 1.0 - u
    return (
        matrix[i] * v * v * (1.0 + 2.0 * u)
        + matrix[i + 1] * u * u * (1.0 + 2.0 * v)
        + h * u * v * (slopes[i] * v - slopes[i + 1] * u)
    )


def half_path_rows(half, side, push, force):
    """Rows [..., Z, 8] of all joints by the forces [3, ..., Z] (x, r, t) on the pockets of the half at `side` (+1 or -1).

    Each force acts where its normal part push [2, ..., Z] (x, t) points on the wall: chi = atan(|push_x|/|push_t|).
    Leading axes are independent states.
    """
    Z, shape = half.path.shape[1], np.shape(force)[1:]
    force, push = np.reshape(force, (3, -1, Z)), np.reshape(push, (2, -1, Z))
    rows = np.zeros((force.shape[1], Z, len(ROWS)), dtype=np.result_type(force, push))
    state, j = np.nonzero(np.any(force, axis=0))  # touched pockets
    if len(j):
        push_x, push_t = absolute(push[0, state, j]), absolute(push[1, state, j])
        back = np.real(push[1, state, j]) < 0.0
        matrix = path_rows(half.chi, half.path, half.path_slope, np.arctan(push_x / maximum(push_t, 1e-30)))
        force = force[:, state, j] * np.array([side + 0.0 * j, 1.0 + 0.0 * j, np.where(back, -1.0, 1.0)])
        own = np.einsum("nkrf,fn->nkr", matrix, force)  # by the rivets behind the pocket
        own = np.where(back[:, None, None], own[:, ::-1] * PATH_MIRROR, own)
        at = (np.arange(Z) + j[:, None]) % Z
        np.add.at(rows, (state[:, None], at), own * (PATH_SIDE if side < 0 else 1.0))
    return rows.reshape(*shape, len(ROWS))
