"""One cage half as a solid: its mesh; half_shape.py has its mass, its inertia and the limits of what can be built.

    x ^   pocket 0            bar, rivet             pocket 1         A pitch of the half, from pocket to pocket, seen from outside.
      |   ______________________________________________
      |  |   web          |  seat |           web        |            w = cage_half_width, pockets: cylinders with radial axes
    w |   `.              |       |                    .'
      |     `.            |_     _|  flange_thickness .'              seat: counterbore for the rivet's head
      |       |  bar       _|   |_                   |                hole: shank_diameter, relieved under the head
      +-------+----=======+      +=======------------+---> t          pad ===: |t| < pad_half_length at x = 0, where the halves touch

Radially the half goes from cage_inner_diameter to cage_outer_diameter.  Rivet k lies at the angle 2 pi (k + 1/2)/Z on
the circle d_m, pocket j at 2 pi j/Z.  Beside its pads the bar's face is relieved by so little that no mass is lost.
Frame of a place: x away from the split, r outward, t toward growing angle (right-handed x, r, t).
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.spatial import cKDTree
from skfem import Basis, MeshHex, MeshHex2
from skfem.mapping import MappingIsoparametric

from .half_shape import check_half, pad_half_length, pocket_radius


@dataclass(frozen=True)
class HalfMesh:
    """Cells: around a quarter of the rivet (and through the ring's radial thickness), through each ring around it,
    along x through the flange below and beside the relief, through the bar above, along the web, through the strip
    between rivet and pocket.
    """

    quarter: int = 4
    outer: int = 2
    flange: int = 2
    relief: int = 1
    bar: int = 3
    web: int = 4
    strip: int = 2

    def finer(self, factor):
        """The same with `factor` times as many cells each way."""
        return HalfMesh(*(max(1, round(factor * n)) for n in vars(self).values()))


COARSE = HalfMesh(3, 1, 1, 1, 2, 3, 1)
FINE = HalfMesh(6, 3, 3, 2, 4, 6, 3)


def _levels(levels, counts):
    """Levels with `counts` cells between neighbours, at double resolution: even entries are corners."""
    parts = [np.linspace(a, b, 2 * n, endpoint=False) for a, b, n in zip(levels[:-1], levels[1:], counts, strict=True)]
    return np.append(np.concatenate(parts), levels[-1])


class _Blocks:
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


def heights(g, size):
    """Levels of the bar along x at double resolution [m]."""
    relief = g.flange_thickness - g.relief_depth
    return _levels([0.0, relief, g.flange_thickness, g.cage_half_width], [size.flange, size.relief, size.bar])


def radii(g, size):
    """Radial levels at double resolution [m]."""
    return _levels([g.cage_inner_diameter / 2, g.cage_outer_diameter / 2], [size.quarter])


def wall_angles(g, size):
    """Angles of the pocket's wall at double resolution [rad]: 0 at the split, pi/2 at the pocket's bottom."""
    return np.deg2rad(
        np.concatenate([45.0 / g.cage_half_width * heights(g, size), _levels([45.0, 90.0], [size.web])[1:]])
    )


def pitch_mesh(g, size=None):
    """Mesh of one pitch, pocket 0 at theta = 0, rivet at pi/Z, pocket 1 at 2 pi/Z; quadratic cells on the true
    cylinders.  [m]

    Raises ValueError for a half that cannot be built.
    """
    check_half(g)
    size = size or HalfMesh()
    pad, w, p, R = pad_half_length(g), g.cage_half_width, pocket_radius(g), g.d_m / 2
    r, levels = radii(g, size), heights(g, size)
    flange_top, relief_top = 2 * (size.flange + size.relief) + 1, 2 * size.flange + 1
    blocks = _Blocks()

    # Around the rivet: rings about its axis, then from the seat's circle to the pad's outline.  Plane coordinates
    # (radial, tangential) from the rivet.
    rings = [g.shank_diameter / 2, g.shank_diameter / 2 + g.relief_radius, g.head_diameter / 2, g.seat_diameter / 2]
    side = np.stack([np.sqrt(r**2 - pad**2) - R, np.full(r.size, pad)], axis=1)
    across = _levels([-pad, pad], [size.quarter])
    inner, outer = (np.stack([np.sqrt(end**2 - across**2) - R, across], axis=1) for end in r[[0, -1]])
    outline = [side, outer[::-1], side[::-1] * [1.0, -1.0], inner]
    for line in outline:
        ends = np.unwrap(np.arctan2(line[[0, -1], 1], line[[0, -1], 0]))
        angle = np.linspace(*ends, line.shape[0])
        circle = np.stack([np.cos(angle), np.sin(angle)], axis=1)
        # finer toward the pad's edge, where an opening joint touches
        share = 1.0 - (1.0 - _levels([0.0, 1.0], [size.outer])[:, None, None]) ** 2
        beyond = rings[-1] * circle * (1.0 - share) + line * share
        within = [_levels(list(pair), [1])[:, None, None] * circle for pair in pairwise(rings)]
        for plane, top in zip([*within, beyond], [relief_top, flange_top, flange_top, levels.size], strict=True):
            y, z, x = R + plane[..., 0], plane[..., 1], levels[:top, None, None]
            blocks.add(np.stack(np.broadcast_arrays(x, np.hypot(y, z), np.pi / g.Z + np.arctan2(z, y)), axis=-1))

    # Between the rivet's block and the pockets: strip beside the bar up to 45 degrees of the wall, web above it; both
    # sides of the bar.
    share = _levels([0.0, 1.0], [size.strip])[None, :, None]
    phi, theta_pad = wall_angles(g, size)[:, None], np.pi / g.Z - np.arcsin(pad / r)
    x_wall, theta_wall = p * np.sin(phi) + 0.0 * r, np.arcsin(p * np.cos(phi) / r)
    across_web = np.concatenate([np.ones(levels.size - 1), _levels([1.0, 0.0], [size.web])])
    x_top, theta_top = (
        np.concatenate([levels, np.full(2 * size.web, w)])[:, None] + 0.0 * r,
        across_web[:, None] * theta_pad,
    )
    for part in (slice(0, levels.size), slice(levels.size - 1, None)):
        x = x_top[part, None] * (1.0 - share) + x_wall[part, None] * share
        theta = theta_top[part, None] * (1.0 - share) + theta_wall[part, None] * share
        for place in (theta, 2 * np.pi / g.Z - theta):
            blocks.add(np.stack(np.broadcast_arrays(x, r, place), axis=-1))
    return blocks.mesh()


class Mapping(MappingIsoparametric):
    """Newton's iteration for local coordinates ends at 1e-10, not 1e-12, which small cells far from the origin cannot
    reach.
    """

    def invF(self, x, tind=None):
        return super().invF(x, tind, newton_tol=1e-10)


def solid_basis(mesh, element, order=5):
    """Basis on the mesh with its curved cells."""
    return Basis(mesh, element, mapping=Mapping(mesh, mesh.elem(), mesh.bndelem), intorder=order)
