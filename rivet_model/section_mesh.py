"""Meridian meshes of rivet and flange: structured quadrilaterals whose contact edges have the same nodes on both
bodies.

z = 0 is the split plane, the upper (+x of the bearing) half has z > 0.  The fit is a gap in the contact problem, so the
meshes do not depend on it.
"""

from dataclasses import dataclass

import numpy as np
from skfem import MeshQuad

TOLERANCE = 1e-9  # m: nodes closer than this are one node; the smallest element is a few um


@dataclass(frozen=True)
class Fineness:
    """Number of elements; `factor` 1 is the shipped mesh, 2 halves every element."""

    factor: float = 1.0

    def __call__(self, count):
        return max(1, round(count * self.factor))


def graded(start, end, count, ratio=1.0):
    """count + 1 points from start to end; the last step is `ratio` times the first one (geometric)."""
    steps = ratio ** (np.arange(count) / max(count - 1, 1))
    return start + (end - start) * np.concatenate([[0.0], np.cumsum(steps)]) / steps.sum()


def graded_both(start, end, count, ratio):
    """Steps growing from both ends toward the middle."""
    half = max(1, (count + 1) // 2)
    middle = 0.5 * (start + end)
    left = graded(start, middle, half, ratio)
    return np.concatenate([left, start + end - left[-2::-1]])


def _levels(parts):
    return np.concatenate([parts[0], *(part[1:] for part in parts[1:])])


class _Blocks:
    """Collects structured blocks and merges their common nodes."""

    def __init__(self):
        self.points, self.quads, self.count = [], [], 0

    def add(self, r, z):
        """One block of node coordinates r[i, j], z[i, j]."""
        n, m = r.shape
        index = np.arange(self.count, self.count + n * m).reshape(n, m)
        self.points.append(np.stack([r.ravel(), z.ravel()]))
        self.quads.append(
            np.stack([index[:-1, :-1].ravel(), index[1:, :-1].ravel(), index[1:, 1:].ravel(), index[:-1, 1:].ravel()])
        )
        self.count += n * m

    def rectangle(self, r, z):
        self.add(*np.meshgrid(r, z, indexing="ij"))

    def mesh(self):
        points, quads = np.concatenate(self.points, axis=1), np.concatenate(self.quads, axis=1)
        _, first, inverse = np.unique(
            np.round(points / TOLERANCE).astype(np.int64), axis=1, return_index=True, return_inverse=True
        )
        quads = inverse.ravel()[quads]
        p = points[:, first]
        x, y = p[0][quads], p[1][quads]
        area = 0.5 * ((x[2] - x[0]) * (y[3] - y[1]) - (x[3] - x[1]) * (y[2] - y[0]))
        if np.any(area == 0.0):
            raise ValueError("geometry cannot be meshed: an element has no area")
        quads = np.where(area > 0.0, quads, quads[::-1])
        return MeshQuad(np.ascontiguousarray(p), np.ascontiguousarray(quads))


def bore_levels(g, fine):
    """Heights of the contact between shank and bore, fine at both ends, where the pressure peaks."""
    return graded_both(g.edge_break, g.flange_thickness - g.relief_depth, fine(12), 5.0)


def head_radii(g, fine):
    """Radii of the contact under the head."""
    return graded_both(g.shank_diameter / 2 + g.relief_radius, g.head_diameter / 2, fine(6), 1.5)


def plate_radii(g, fine):
    """Radii of the contact in the split plane."""
    R = g.shank_diameter / 2
    inner = np.linspace(R + g.edge_break, R + g.relief_radius, fine(1) + 1)
    return _levels([inner, head_radii(g, fine), np.linspace(g.head_diameter / 2, g.patch_radius, fine(8) + 1)])


def rivet_mesh(g, fine=None):
    """Mesh of the whole rivet: shank, two heads, four graded layers around each fillet."""
    fine = fine or Fineness()
    R, rf, t = g.shank_diameter / 2, g.fillet_radius, g.flange_thickness
    top = t + g.head_height
    w = min(1.6 * rf, 0.45 * R, 0.45 * g.head_height)  # depth of the refined layers
    layers = w * graded(0.0, 1.0, fine(7), 8.0)  # distance from the surface
    core = np.linspace(0.0, R - w, fine(5) + 1)
    arc = fine(10)
    middle = _levels(
        [np.linspace(0.0, g.middle_zone, fine(3) + 1), np.linspace(g.middle_zone, g.edge_break, fine(2) + 1)]
    )
    neck = graded_both(g.flange_thickness - g.relief_depth, t - rf, fine(6), 2.0)
    shank = _levels([middle, bore_levels(g, fine), neck])
    beside = R - w, np.linspace(t - rf, t + w, arc + 1)  # straight edges opposite to the two halves of the fillet's arc
    above = np.linspace(R - w, R + rf, arc + 1), t + w
    tall = np.linspace(t + w, top, fine(5) + 1)
    under = _levels([np.linspace(R + rf, R + g.relief_radius, fine(3) + 1), head_radii(g, fine)])
    blocks = _Blocks()
    for side in (1.0, -1.0):
        blocks.rectangle(core, side * _levels([shank, beside[1], tall]))
        blocks.rectangle(R - layers, side * shank)
        blocks.rectangle(above[0], side * tall)
        blocks.rectangle(under, side * _levels([t + layers, tall]))
        share = (layers / w)[:, None]
        for angle, r_out, z_out in (
            (np.linspace(np.pi, 0.75 * np.pi, arc + 1), np.full(arc + 1, beside[0]), beside[1]),
            (np.linspace(0.75 * np.pi, 0.5 * np.pi, arc + 1), above[0], np.full(arc + 1, above[1])),
        ):
            r_in, z_in = R + rf + rf * np.cos(angle), t - rf + rf * np.sin(angle)
            blocks.add(r_in + share * (r_out - r_in), side * (z_in + share * (z_out - z_in)))
    return blocks.mesh()


def flange_mesh(g, fine=None):
    """Mesh of the upper flange from its bore to the rigid rim."""
    fine = fine or Fineness()
    R, t = g.shank_diameter / 2, g.flange_thickness
    inner = graded(0.0, 1.0, fine(6), 8.0)
    bore = bore_levels(g, fine)
    chamfer = np.linspace(0.0, g.edge_break, fine(2) + 1)
    relief = graded(t - g.relief_depth, t, fine(4), 1.0)
    outer = _levels([head_radii(g, fine), np.linspace(g.head_diameter / 2, g.patch_radius, fine(8) + 1)])
    edge = R + g.relief_radius
    blocks = _Blocks()
    blocks.rectangle(R + inner * g.relief_radius, bore)
    blocks.rectangle(outer, _levels([chamfer, bore, relief]))
    # Block between the chamfer and the nodes plate_radii on the split plane: its levels follow the chamfer from the
    # split plane to the bore's layers.
    plane = np.linspace(R + g.edge_break, edge, len(inner))
    share = (chamfer / g.edge_break)[None, :]
    start = R + g.edge_break * (1.0 - share)
    spread = (1.0 - share) * ((plane - plane[0]) / (edge - plane[0]))[:, None] + share * inner[:, None]
    r = start + spread * (edge - start)
    blocks.add(r, np.broadcast_to(chamfer[None, :], r.shape).copy())
    return blocks.mesh()


def edge_nodes(mesh, r=None, z=None, between=None):
    """Vertices on a straight line r = const or z = const, in the order of the other coordinate, limited to `between`."""
    fixed, value = (0, r) if r is not None else (1, z)
    other = 1 - fixed
    on = np.abs(mesh.p[fixed] - value) < 2 * TOLERANCE
    if between is not None:
        on &= (mesh.p[other] > between[0] - 2 * TOLERANCE) & (mesh.p[other] < between[1] + 2 * TOLERANCE)
    nodes = np.flatnonzero(on)
    return nodes[np.argsort(mesh.p[other][nodes])]
