"""One cage half as a solid: its mesh; half_shape.py has its mass, its inertia and the limits of its shape.

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

import numpy as np
from skfem import Basis
from skfem.mapping import MappingIsoparametric

from . import ribbon
from .blocks import Blocks, around_rivet, hexahedra, lagrange
from .blocks import levels as block_levels
from .half_shape import check_half, pad_half_length, pocket_radius

__all__ = ["COARSE", "FINE", "Blocks", "HalfMesh", "hexahedra", "pitch_mesh", "solid_basis", "wall"]


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


def heights(g, size):
    """Levels of the bar along x at double resolution [m]."""
    relief = g.flange_thickness - g.relief_depth
    return block_levels([0.0, relief, g.flange_thickness, g.cage_half_width], [size.flange, size.relief, size.bar])


def radii(g, size):
    """Radial levels at double resolution [m]."""
    return block_levels([g.cage_inner_diameter / 2, g.cage_outer_diameter / 2], [size.quarter])


def wall_angles(g, size):
    """Angles of the pocket's wall at double resolution [rad]: 0 at the split, pi/2 at the pocket's bottom."""
    return np.deg2rad(
        np.concatenate([45.0 / g.cage_half_width * heights(g, size), block_levels([45.0, 90.0], [size.web])[1:]])
    )


def pitch_mesh(g, size=None):
    """Mesh of one pitch, pocket 0 at theta = 0, rivet at pi/Z, pocket 1 at 2 pi/Z; quadratic cells on the true
    cylinders.  [m]

    Raises ValueError for a half that cannot be built.
    """
    check_half(g)
    size = size or HalfMesh()
    if g.shape == "ribbon":
        return ribbon.pitch_mesh(g, size)
    pad, w, p, R = pad_half_length(g), g.cage_half_width, pocket_radius(g), g.d_m / 2
    r, levels = radii(g, size), heights(g, size)
    flange_top, relief_top = 2 * (size.flange + size.relief) + 1, 2 * size.flange + 1
    blocks = Blocks()

    # Around the rivet: rings about its axis, then from the seat's circle to the pad's outline.  Plane coordinates
    # (radial, tangential) from the rivet.
    rings = [g.shank_diameter / 2, g.shank_diameter / 2 + g.relief_radius, g.head_diameter / 2, g.seat_diameter / 2]
    side = np.stack([np.sqrt(r**2 - pad**2) - R, np.full(r.size, pad)], axis=1)
    across = block_levels([-pad, pad], [size.quarter])
    inner, outer = (np.stack([np.sqrt(end**2 - across**2) - R, across], axis=1) for end in r[[0, -1]])
    outline = [side, outer[::-1], side[::-1] * [1.0, -1.0], inner]
    around_rivet(blocks, g, size, levels, rings, [relief_top, flange_top, flange_top, levels.size], outline)

    # Between the rivet's block and the pockets: strip beside the bar up to 45 degrees of the wall, web above it; both
    # sides of the bar.
    share = block_levels([0.0, 1.0], [size.strip])[None, :, None]
    phi, theta_pad = wall_angles(g, size)[:, None], np.pi / g.Z - np.arcsin(pad / r)
    x_wall, theta_wall = p * np.sin(phi) + 0.0 * r, np.arcsin(p * np.cos(phi) / r)
    across_web = np.concatenate([np.ones(levels.size - 1), block_levels([1.0, 0.0], [size.web])])
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


def wall(g, size):
    """The wall of a pocket with its nodes in the mesh."""
    return ribbon.Wall(g, size) if g.shape == "ribbon" else Wall(g, size)


class Wall:
    """The wall of a machined pocket: a place is its angle from the split [rad] and its radius [m].

    nodes: places of the mesh's nodes on the side t > 0 [angles, radii, (x, r, t)] in the frame of pocket 0.
    """

    def __init__(self, g, size):
        self.g, self.angles, self.radii = g, wall_angles(g, size), radii(g, size)
        phi, r, p = self.angles[:, None], self.radii, pocket_radius(g)
        theta = np.arcsin(p * np.cos(phi) / r)
        self.nodes = np.stack(np.broadcast_arrays(p * np.sin(phi), r * np.cos(theta), r * np.sin(theta)), axis=-1)

    def weights(self, angle, radius):
        """Values of the nodes' shape functions at a place [angles, radii]."""
        return np.outer(lagrange(self.angles, angle), lagrange(self.radii, radius))

    def place(self, angle, radius):
        """(x, r, t) of a place in the frame of pocket 0; angles beyond pi/2 lie on the side t < 0."""
        z = pocket_radius(self.g) * np.cos(angle)
        return np.stack([pocket_radius(self.g) * np.sin(angle), np.sqrt(radius**2 - z**2), z], axis=-1)

    def normal(self, angle, radius):
        """Direction (x, r, t) of a force of the ball at a place."""
        return np.stack([np.sin(angle), 0.0 * angle, np.cos(angle)], axis=-1)


class Mapping(MappingIsoparametric):
    """Newton's iteration for local coordinates ends at 1e-10, not 1e-12, which small cells far from the origin cannot
    reach.
    """

    def invF(self, x, tind=None):
        return super().invF(x, tind, newton_tol=1e-10)


def solid_basis(mesh, element, order=5):
    """Basis on the mesh with its curved cells."""
    return Basis(mesh, element, mapping=Mapping(mesh, mesh.elem(), mesh.bndelem), intorder=order)
