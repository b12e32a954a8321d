"""One pressed ribbon half as a solid: its mesh and the places on its pockets; ribbon_shape.py has sketch and limits.

The sheet is one layer of blocks: around the rivet, then along each arc from the land's edge over the fillet to the
pocket's axis, all between the cylinders of the ring and with the same levels through the sheet.  Cells, by the names of
half.HalfMesh: flange and relief through the sheet, quarter over the ring's width; MORE than bar along a fillet, MORE
than web along a sphere, because a ribbon bends there (measured on the 6309: with bar and web the modes are 0.7 % too
high and the wall 1.3 % too stiff, with two more 0.2 and 0.2 %).
"""

import numpy as np
from scipy.optimize import brentq

from . import ribbon_shape as shape
from .blocks import Blocks, around_rivet, lagrange, levels

MORE = 2  # cells


def through(g, size):
    """Levels through the sheet at double resolution [m]."""
    S = g.flange_thickness
    return levels([0.0, S - g.relief_depth, S], [size.flange, size.relief])


def radii(g, size):
    """Radial levels at double resolution [m]."""
    return levels([g.cage_inner_diameter / 2, g.cage_outer_diameter / 2], [size.quarter])


def arcs(size):
    """Levels of the arc (ribbon_shape.at_radius) at double resolution."""
    return levels([0.0, 1.0, 2.0], [size.bar + MORE, size.web + MORE])


def pitch_mesh(g, size):
    """Mesh of one pitch, pocket 0 at theta = 0, rivet at pi/Z, pocket 1 at 2 pi/Z: as half.pitch_mesh."""
    r, zeta, arc, R = radii(g, size), through(g, size), arcs(size), g.d_m / 2
    blocks, top = Blocks(), len(zeta)

    rings = [g.shank_diameter / 2, g.shank_diameter / 2 + g.relief_radius, g.head_diameter / 2]
    angle = np.pi / g.Z - shape.land_angle(g, r)
    side = np.stack([r * np.cos(angle) - R, r * np.sin(angle)], axis=1)
    ends = [(r[i], levels([-angle[i], angle[i]], [size.quarter])) for i in (0, -1)]
    inner, outer = (np.stack([end * np.cos(a) - R, end * np.sin(a)], axis=1) for end, a in ends)
    outline = [side, outer[::-1], side[::-1] * [1.0, -1.0], inner]
    around_rivet(blocks, g, size, zeta, rings, [2 * size.flange + 1, top, top], outline)

    seam = 2 * (size.bar + MORE)
    for part in (slice(0, seam + 1), slice(seam, None)):
        x, theta = shape.at_radius(g, arc[part], zeta[:, None, None], r[:, None])
        for place in (theta, 2 * np.pi / g.Z - theta):
            blocks.add(np.stack(np.broadcast_arrays(x, r[:, None], place), axis=-1))
    return blocks.mesh()


class Wall:
    """The wall of a ribbon's pocket: a place is its angle chi from the split about the sphere's centre, seen along r,
    and its radius [m].

    nodes: places of the mesh's nodes on the side t > 0 [arcs, radii, (x, r, t)] in the frame of pocket 0, fillet and
    sphere.
    """

    def __init__(self, g, size):
        self.g, self.arcs, self.radii = g, arcs(size), radii(g, size)
        self.nodes = self._at(self.arcs[:, None], self.radii)

    def _at(self, arc, r):
        x, theta = shape.at_radius(self.g, arc, 0.0, r)
        return np.stack(np.broadcast_arrays(x, r * np.cos(theta), r * np.sin(theta)), axis=-1)

    def arc(self, angle, radius):
        """The arc of a place on the side t > 0."""

        def beyond(arc):
            x, _, t = self._at(np.float64(arc), radius)
            return np.arctan2(x + shape.offset(self.g), t) - angle

        return 2.0 if angle >= 0.5 * np.pi - 1e-12 else brentq(beyond, 0.2, 2.0, xtol=1e-14)

    def weights(self, angle, radius):
        """Values of the nodes' shape functions at a place [arcs, radii]."""
        return np.outer(lagrange(self.arcs, self.arc(angle, radius)), lagrange(self.radii, radius))

    def place(self, angle, radius):
        """(x, r, t) of places in the frame of pocket 0, on the curved cells; angles beyond pi/2 lie on the side t < 0."""
        angle, radius = np.broadcast_arrays(angle, radius)
        found = [
            np.tensordot(self.weights(min(a, np.pi - a), r), self.nodes) * [1.0, 1.0, -1.0 if a > 0.5 * np.pi else 1.0]
            for a, r in zip(angle.ravel(), radius.ravel(), strict=True)
        ]
        return np.reshape(found, (*angle.shape, 3))

    def normal(self, angle, radius):
        """Direction (x, r, t) of a force of the ball at a place of the sphere."""
        from_centre = self.place(angle, radius) - [-shape.offset(self.g), 0.5 * self.g.d_m, 0.0]
        return from_centre / np.linalg.norm(from_centre, axis=-1, keepdims=True)


def places(g):
    """Nodes of the wall's angle [rad], from the seam at the ring's edges on, and of the radius [m] of the tables."""
    widest = max(g.cage_outer_diameter - g.d_m, g.d_m - g.cage_inner_diameter) / 2.0
    first = np.arcsin(min(np.sin(shape.seam(g)) / np.sqrt(1.0 - (widest / shape.sphere_radius(g)) ** 2), 0.9))
    share = np.array([0.0, 0.08, 0.17, 0.28, 0.42, 0.58, 0.78, 1.0])
    chi = first + (0.5 * np.pi - first) * share
    return chi, 0.5 * np.array([g.cage_inner_diameter, g.d_m, g.cage_outer_diameter])
