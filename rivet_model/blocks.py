"""Structured blocks of points to a mesh of quadratic hexahedra on curved surfaces: both shapes of a cage half use them."""

from itertools import pairwise

import numpy as np
from scipy.spatial import cKDTree
from skfem import MeshHex, MeshHex2


def levels(ends, counts):
    """Levels with `counts` cells between neighbours, at double resolution: even entries are corners."""
    parts = [np.linspace(a, b, 2 * n, endpoint=False) for a, b, n in zip(ends[:-1], ends[1:], counts, strict=True)]
    return np.append(np.concatenate(parts), ends[-1])


class Blocks:
    """Structured blocks of points [2 n1 + 1, 2 n2 + 1, 2 n3 + 1, (x, r, theta)]: corners at even places, the rest
    shapes the cells' curved sides.
    """

    def __init__(self):
        self.true, self.straight, self.cells, self.count = [], [], [], 0

    def add(self, block):
        x, r, theta = np.moveaxis(block, -1, 0)
        true = np.stack([x, r * np.cos(theta), r * np.sin(theta)], axis=-1)
        straight = true.copy()  # where cells with straight sides have this point
        for axis in range(3):
            along = np.moveaxis(straight, axis, 0)
            along[1::2] = 0.5 * (along[:-1:2] + along[2::2])
        index = self.count + np.arange(true[..., 0].size).reshape(true.shape[:3])
        n = [size - 2 for size in index.shape]
        corner = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
        self.cells.append(
            np.stack([index[a : n[0] + a : 2, b : n[1] + b : 2, c : n[2] + c : 2].ravel() for a, b, c in corner])
        )
        self.true.append(true.reshape(-1, 3))
        self.straight.append(straight.reshape(-1, 3))
        self.count += index.size

    def mesh(self):
        true, straight, cells = (
            np.concatenate(self.true).T,
            np.concatenate(self.straight),
            np.concatenate(self.cells, axis=1),
        )
        corners, inverse = np.unique(cells, return_inverse=True)
        _, first, merged = np.unique(
            np.round(true[:, corners] * 1e9).astype(np.int64), axis=1, return_index=True, return_inverse=True
        )
        mesh = MeshHex2.from_mesh(hexahedra(true[:, corners][:, first], merged.ravel()[inverse.reshape(cells.shape)]))
        distance, nearest = cKDTree(straight).query(mesh.doflocs.T)
        if distance.max() > 1e-8:
            raise ValueError("geometry cannot be meshed: a node of the cage half has no place")
        mesh.doflocs[:] = true[:, nearest]
        return mesh


def hexahedra(p, corners):
    """MeshHex from points [3, n] and corners [8, cells]: a quadrilateral in order, then the opposite one."""
    a, b, c, d, e, f, h, i = corners  # skfem: 0 a corner, 1-3 its neighbours, 4-6 across its faces, 7 opposite
    t = np.stack([a, e, d, b, i, f, c, h])
    volume = np.linalg.det(np.stack([p[:, t[k]] - p[:, t[0]] for k in (1, 2, 3)], axis=-1).transpose(1, 0, 2))
    flip = volume < 0.0
    t[:, flip] = t[:, flip][[0, 1, 3, 2, 5, 4, 6, 7]]
    return MeshHex(np.ascontiguousarray(p), np.ascontiguousarray(t))


def around_rivet(blocks, g, size, x, rings, tops, outline):
    """Blocks around a rivet: rings about its axis, then from the last one to the outline.

    x: levels; rings: radii; tops: number of levels of each ring and of the part beyond; outline: four lines in plane
    coordinates (radial, tangential) from the rivet, in turn.
    """
    R = g.d_m / 2
    for line in outline:
        ends = np.unwrap(np.arctan2(line[[0, -1], 1], line[[0, -1], 0]))
        angle = np.linspace(*ends, line.shape[0])
        circle = np.stack([np.cos(angle), np.sin(angle)], axis=1)
        # finer toward the pad's edge, where an opening joint touches
        share = 1.0 - (1.0 - levels([0.0, 1.0], [size.outer])[:, None, None]) ** 2
        beyond = rings[-1] * circle * (1.0 - share) + line * share
        within = [levels(list(pair), [1])[:, None, None] * circle for pair in pairwise(rings)]
        for plane, top in zip([*within, beyond], tops, strict=True):
            y, z, at = R + plane[..., 0], plane[..., 1], x[:top, None, None]
            blocks.add(np.stack(np.broadcast_arrays(at, np.hypot(y, z), np.pi / g.Z + np.arctan2(z, y)), axis=-1))


def lagrange(nodes, at):
    """Values at a place of the quadratic shape functions on cells of two levels each [nodes]."""
    first = 2 * min(max((np.searchsorted(nodes, at) - 1) // 2, 0), (len(nodes) - 1) // 2 - 1)
    a, b, c = nodes[first : first + 3]
    weights = np.zeros(len(nodes))
    weights[first : first + 3] = (
        (at - b) * (at - c) / ((a - b) * (a - c)),
        (at - a) * (at - c) / ((b - a) * (b - c)),
        (at - a) * (at - b) / ((c - a) * (c - b)),
    )
    return weights
