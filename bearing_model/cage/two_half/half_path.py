"""From pocket forces over the wall's angle to the loads that bonded joints would carry; rivet_model/half_loads.py makes
the numbers.

Rows of a joint's loads, on the +x half in the frame (x, r, t) at the rivet: N, V_r, V_t, M_r, M_t of the joint [N, N.m]
(N and V: elastic less the rigid halves' share, which the dynamics has), then dP, dm_r, dm_t: change of
the rivet's preload and bending moments of its shank, beside those of the joint's law, by the elastic deformation of the
half under the rivet's head.

All pockets are alike, so the rows of rivet k by a force on pocket j depend on (k - j) mod Z only.  push_t < 0 acts as the
mirror image about the pocket does (rivet -1 - i for i; V_t, M_r and dm_r change sign), a force on the -x half as its
mirror image on the +x half does (V changes sign).
"""

import numpy as np

from bearing_model.numbers.lanes import absolute, maximum, minimum

ROWS = ("N", "V_r", "V_t", "M_r", "M_t", "dP", "dm_r", "dm_t")
# of the rows N, V_r, V_t, M_r, M_t, dP, dm_r, dm_t in the pocket's plane
PATH_MIRROR = np.array([1.0, 1.0, -1.0, -1.0, 1.0, 1.0, -1.0, 1.0])
PATH_SIDE = np.array([1.0, -1.0, -1.0, 1.0, 1.0, 1.0, 1.0, 1.0])  # of a mirrored force on the -x half


def land_harmonics(Z):
    """Harmonics p = n, n - Z, n + Z of the waves n = 0...Z//2 that a film on the land has [waves, 3], below 3 Z/2.

    The second or third of a wave may repeat the first one: its amplitudes are 0.

    >>> land_harmonics(9)[[0, 1, 4]].tolist()
    [[0, -9, 9], [1, -8, 10], [4, -5, 13]]
    >>> land_harmonics(8)[4].tolist()
    [4, -4, 4]
    """
    n = np.arange(Z // 2 + 1)[:, None]
    p = n + Z * np.array([0, -1, 1])
    return np.where(2 * np.abs(p) < 3 * Z, p, n)


def waves_of(Z):
    """cos and sin of n theta_k at the rivets [waves, Z]."""
    angle = 2.0 * np.pi * np.outer(np.arange(Z // 2 + 1), np.arange(Z) + 0.5) / Z
    return np.cos(angle), np.sin(angle)


def by_waves(table, x, load):
    """Loads of the waves by the harmonics load (Re G_p, Im G_p [..., p]) at the land x: amplitudes of even kinds by cos n theta
    and by sin n theta, [..., waves, kinds] each.  table [waves, harmonic, 1 and x, kinds].
    """
    Z = 2 * load[0].shape[-1] // 3
    p = land_harmonics(Z)
    at = table[:, :, 0] + x * table[:, :, 1]
    cosine, sine = load[0][..., np.abs(p)], load[1][..., np.abs(p)] * np.sign(p)
    return tuple(np.einsum("...ni,nik->...nk", part, at) for part in (cosine, sine))


def at_rivets(Z, even, by_cos, by_sin):
    """Kinds [..., Z, kinds] at the rivets: even ones a cos + b sin, odd ones b cos - a sin of n theta."""
    c, s = waves_of(Z)
    a, b = np.where(even, by_cos, by_sin), np.where(even, by_sin, -by_cos)
    return np.einsum("...nk,nz->...zk", a, c) + np.einsum("...nk,nz->...zk", b, s)


def land_path_rows(half, x, side, load):
    """Rows [..., Z, 8] of all joints by the radial load (Re G_p, Im G_p [..., p]) on the rim of the half at `side`, at the
    distance x of the land from the split.
    """
    rows = at_rivets(half.path.shape[-3], PATH_MIRROR > 0.0, *by_waves(half.land, x, load))
    return rows * (PATH_SIDE if side < 0 else 1.0)


def land_rows(half, x, land):
    """Rows [..., Z, 8] of all joints by the films of both lands: loads (Re, Im G_p [..., half, p]) on the rims."""
    return sum(land_path_rows(half, x, 2 * h - 1, tuple(part[..., h, :] for part in land)) for h in range(2))


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


def radius_weights(radii, r):
    """Weights [radii, ...] of the nodes [radii] at the places r [...], which are clamped to them: Lagrange's polynomials."""
    r = minimum(maximum(r, radii[0]), radii[-1])
    return [np.prod([(r - b) / (a - b) for b in radii if b != a], axis=0) for a in radii]


def radius_slopes(radii, r):
    """Slopes of radius_weights over r; 0 where r is clamped."""
    within = (np.real(r) > radii[0]) & (np.real(r) < radii[-1])
    slopes = []
    for a in radii:
        others = [b for b in radii if b != a]
        product = sum(
            np.prod([(r - c) / (a - c) for c in others if c != b] or [1.0 + 0.0 * r], axis=0) / (a - b) for b in others
        )
        slopes.append(np.where(within, product, 0.0))
    return slopes


def half_path_rows(half, side, push, force, radius=None):
    """Rows [..., Z, 8] of all joints by the forces [3, ..., Z] (x, r, t) on the pockets of the half at `side` (+1 or -1).

    Each force acts where its normal part push [2, ..., Z] (x, t) points on the wall: chi = atan(|push_x|/|push_t|).  On a ribbon
    push is the place from the sphere's centre, and radius [..., Z] its distance from the bearing's axis.
    Leading axes are independent states.
    """
    Z, shape = half.path.shape[-3], np.shape(force)[1:]
    force, push = np.reshape(force, (3, -1, Z)), np.reshape(push, (2, -1, Z))
    rows = np.zeros((force.shape[1], Z, len(ROWS)), dtype=np.result_type(force, push))
    state, j = np.nonzero(np.any(force, axis=0))  # touched pockets
    if len(j):
        push_x, push_t = absolute(push[0, state, j]), absolute(push[1, state, j])
        back = np.real(push[1, state, j]) < 0.0
        chi = np.arctan(push_x / maximum(push_t, 1e-30))
        if len(half.radii):
            chi, r = maximum(chi, half.chi[0]), np.reshape(radius, (-1, Z))[state, j]
            matrix = sum(
                weight[:, None, None, None] * path_rows(half.chi, path, slope, chi)
                for weight, path, slope in zip(radius_weights(half.radii, r), half.path, half.path_slope, strict=True)
            )
        else:
            matrix = path_rows(half.chi, half.path, half.path_slope, chi)
        force = force[:, state, j] * np.array([side + 0.0 * j, 1.0 + 0.0 * j, np.where(back, -1.0, 1.0)])
        own = np.einsum("nkrf,fn->nkr", matrix, force)  # by the rivets behind the pocket
        own = np.where(back[:, None, None], own[:, ::-1] * PATH_MIRROR, own)
        at = (np.arange(Z) + j[:, None]) % Z
        np.add.at(rows, (state[:, None], at), own * (PATH_SIDE if side < 0 else 1.0))
    return rows.reshape(*shape, len(ROWS))
