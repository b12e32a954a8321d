"""The walls of an elastic half's pockets: motions by the modes where balls touch them.  Equations in half_modes.py."""

import numpy as np

from bearing_model.cage.two_half.half_path import radius_slopes, radius_weights
from bearing_model.numbers.lanes import absolute, maximum


def elastic_wall_shape(half, side, n_x, n_t):
    """Motions (x, r, t) [3, ..., Z, n] of the walls by all modes where the contacts are, and their slopes over the
    wall's angle.
    """
    chi = maximum(np.arctan(side * n_x / maximum(absolute(n_t), 1e-30)), 0.0)
    i = np.clip(np.searchsorted(half.chi, np.real(chi), side="right") - 1, 0, len(half.chi) - 2)
    h = half.chi[i + 1] - half.chi[i]
    u = (chi - half.chi[i]) / h
    v = 1.0 - u
    terms = half.pocket[i], half.slope[i], half.pocket[i + 1], half.slope[i + 1]  # [..., Z, n, 3, 2]
    value = v * v * (1.0 + 2.0 * u), h * u * v * v, u * u * (1.0 + 2.0 * v), -h * u * u * v
    slope = -6.0 * u * v / h, v * (v - 2.0 * u), 6.0 * u * v / h, u * (u - 2.0 * v)
    back = np.where(np.real(n_t) < 0.0, -1.0, 1.0)[..., None, None, None] * np.array(
        [[0.0, 1.0], [0.0, 1.0], [1.0, 0.0]]
    ) + [
        [1.0, 0.0],
        [1.0, 0.0],
        [0.0, 1.0],
    ]
    wave = np.moveaxis(half.wave, 2, 0)[:, :, None, :]  # [Z, n, 1, 2]

    def shapes(weights):
        A = sum(w[..., None, None, None] * term for w, term in zip(weights, terms, strict=True))
        return np.moveaxis(np.sum(A * back * wave, axis=-1), -1, 0) * np.array([side, 1.0, 1.0]).reshape(
            -1, *[1] * (A.ndim - 2)
        )

    on_wall = np.real(side * n_x) > 0.0
    return shapes(value), shapes(slope) * on_wall[..., None]


def cubic_weights(half, chi):
    """Node below chi, weights of the cubic (value, slope, next value, next slope) for the value and the slope over chi."""
    i = np.clip(np.searchsorted(half.chi, np.real(chi), side="right") - 1, 0, len(half.chi) - 2)
    h = half.chi[i + 1] - half.chi[i]
    u = (chi - half.chi[i]) / h
    v = 1.0 - u
    value = v * v * (1.0 + 2.0 * u), h * u * v * v, u * u * (1.0 + 2.0 * v), -h * u * u * v
    slope = -6.0 * u * v / h, v * (v - 2.0 * u), 6.0 * u * v / h, u * (u - 2.0 * v)
    return i, value, slope


def ribbon_wall_shapes(half, side, chi, r, front):
    """Motions (x, r, t) [3, ..., Z, n] of the walls of a ribbon half by all modes at the places (chi, r), and their slopes over chi, r and
    front: 1 on the side t > 0 of a pocket, -1 on the other, mirrored one, between them of a ball that sits on both.
    """
    i, value, slope = cubic_weights(half, chi)
    one, none = np.ones_like(front), np.zeros_like(front)
    signs, signs_slope = (
        np.moveaxis(np.array(rows), (0, 1), (-2, -1))[..., None, :, :]
        for rows in ([[one, front], [one, front], [front, one]], [[none, one], [none, one], [one, none]])
    )
    wave = np.moveaxis(half.wave, 2, 0)[:, :, None, :]  # [Z, n, 1, 2]
    on_radii = len(half.radii) > 0
    radius, radius_dot = (
        (radius_weights(half.radii, r), radius_slopes(half.radii, r)) if on_radii else ([1.0 + 0.0 * r], [0.0 * r])
    )
    U, U_slope = (x if on_radii else x[None] for x in (half.pocket, half.slope))

    def shapes(weights, over, signs=signs):
        A = sum(
            (w * along)[..., None, None, None] * term
            for along, at, at_slope in zip(over, U, U_slope, strict=True)
            for w, term in zip(weights, (at[i], at_slope[i], at[i + 1], at_slope[i + 1]), strict=True)
        )
        return np.moveaxis(np.sum(A * signs * wave, axis=-1), -1, 0) * np.array([side, 1.0, 1.0]).reshape(
            -1, *[1] * (A.ndim - 2)
        )

    return shapes(value, radius), shapes(slope, radius), shapes(value, radius_dot), shapes(value, radius, signs_slope)


def elastic_wall(model, w, h, n_x, n_t, S, delta):
    """Motion and velocity (x, r, t) [3, ..., Z] of the walls of half h along the ball's pocket axes; slope of n.u
    across n; the modes' shapes there.
    """
    shape, shape_chi = elastic_wall_shape(model.modes, 2 * h - 1, n_x, n_t)
    q, q_dot = w.cage.elastic.q[h], w.cage.elastic.q_dot[h]
    near = np.real(delta) + w.cage.elastic.reach[h] > 0.0  # others cannot have been reached
    u, u_dot, u_chi = (np.sum(a * b, axis=-1) * near for a, b in ((shape, q), (shape, q_dot), (shape_chi, q)))
    turn = (2 * h - 1) * np.where(np.real(n_t) < 0.0, -1.0, 1.0)
    slope = (n_t * u[0] - n_x * u[2] + turn * (n_x * u_chi[0] + n_t * u_chi[2])) / S
    return u, u_dot, slope, shape
