"""Shape of one cage half in closed form: limits, mass, place of the centre of mass, moments of inertia.

The machined half, of which half.py has sketch and mesh; limits_of, check_half and half_inertia are the doors of both
shapes, the other one is ribbon_shape.py.

Lengths in m, names as in geometry.py; g: a Geometry, or anything with its members.
"""

import math

import numpy as np

from . import ribbon_shape
from .half_bodies import LEAST_WALL, Bodies, Inertia, Limit, rivet_mass

__all__ = [
    "LEAST_WALL",
    "LIMITS",
    "Inertia",
    "Limit",
    "check_half",
    "half_inertia",
    "has_bridges",
    "limits_of",
    "pocket_radius",
    "rivet_mass",
]

LARGEST_HEAD = 0.985  # of its seat's diameter: between them there are elements
LEAST_WEB = 0.05  # of the pocket's radius, between pocket and end face: assumed


def pocket_radius(g):
    """Radius of the pocket's cylinder [m]."""
    return 0.5 * (g.ball_diameter + g.pocket_clearance)


def narrowest_half_bar(g):
    """Least distance from the rivet's radial plane to the pocket's wall, in the split plane at the cage's bore [m];
    negative if the pockets overlap.
    """
    r, pocket = 0.5 * g.cage_inner_diameter, pocket_radius(g)
    return r * math.sin(math.pi / g.Z - math.asin(pocket / r)) if r > pocket else -pocket


def pad_half_length(g):
    """Half length of a pad along the circle [m]: patch_radius, or less if the bar has no room for it."""
    return min(g.patch_radius, narrowest_half_bar(g) - 0.5 * LEAST_WALL)


POCKET = ("ball_diameter", "d_m", "Z", "pocket_clearance")
LIMITS = (
    Limit(
        ("cage_inner_diameter", *POCKET),
        lambda g: g.cage_inner_diameter - 2.0 * pocket_radius(g),
        "a pocket smaller than the cage's bore",
    ),
    Limit(
        ("head_diameter", "seat_diameter"),
        lambda g: LARGEST_HEAD * g.seat_diameter - g.head_diameter,
        "a seat that takes the rivet's head",
    ),
    Limit(
        ("seat_diameter", "head_diameter", *POCKET, "cage_inner_diameter"),
        lambda g: 2.0 * (narrowest_half_bar(g) - LEAST_WALL) - g.seat_diameter,
        "a bridge between pockets that holds the seat of the rivet's head",
    ),
    Limit(
        ("cage_inner_diameter", "d_m", "seat_diameter", "head_diameter"),
        lambda g: g.d_m - g.seat_diameter - 2.0 * LEAST_WALL - g.cage_inner_diameter,
        "a cage with metal inside the rivet's seat",
    ),
    Limit(
        ("cage_outer_diameter", "d_m", "seat_diameter", "head_diameter"),
        lambda g: g.cage_outer_diameter - g.d_m - g.seat_diameter - 2.0 * LEAST_WALL,
        "a cage with metal outside the rivet's seat",
    ),
    Limit(
        ("cage_half_width", "ball_diameter", "pocket_clearance"),
        lambda g: g.cage_half_width - (1.0 + LEAST_WEB) * pocket_radius(g),
        "a half (half the cage's width) whose web closes the pocket",
    ),
    Limit(
        ("cage_half_width", "flange_thickness", "head_height"),
        lambda g: g.cage_half_width - g.flange_thickness - g.head_height,
        "a half (half the cage's width) with a seat that takes the rivet's head",
    ),
)


def limits_of(g):
    """The limits of the shape of g."""
    return ribbon_shape.LIMITS if g.shape == "ribbon" else LIMITS


def has_bridges(g):
    """Whether there is metal between the pockets, without which a half has no mass by its drawing."""
    return ribbon_shape.exists(g) if g.shape == "ribbon" else narrowest_half_bar(g) > 0.0


def check_half(g):
    """Raises ValueError naming the first limit that does not hold."""
    for limit in limits_of(g):
        if not limit.margin(g) >= -1e-9:  # rounding; NaN does not hold
            key, *others = limit.keys
            beside = ", ".join(f"{name} = {getattr(g, name):g}" for name in others)
            raise ValueError(f"geometry: {key} = {getattr(g, key):g}: no {limit.reason} with {beside}")


_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(16)


def half_inertia(g):
    """Inertia of one half with its part of the rivets (head and half of the shank), by integrals over the drawing's
    bodies.
    """
    if g.shape == "ribbon":
        return ribbon_shape.half_inertia(g)
    Z, w, p = g.Z, g.cage_half_width, pocket_radius(g)
    r_i, r_o, density = 0.5 * g.cage_inner_diameter, 0.5 * g.cage_outer_diameter, g.rho_flange
    bodies = Bodies(g)
    bodies.add(density * math.pi * (r_o**2 - r_i**2) * w, 0.5 * w, w * w / 3.0, 0.5 * (r_i**2 + r_o**2))

    # pockets: at x = p sin(phi) a radius r is cut over the angle 2 asin(p cos(phi)/r)
    phi, r = 0.25 * math.pi * (1.0 + _NODES)[:, None], 0.5 * (r_i + r_o) + 0.5 * (r_o - r_i) * _NODES
    x = p * np.sin(phi)
    dm = -Z * density * 2.0 * np.arcsin(np.minimum(p * np.cos(phi) / r, 1.0)) * r * p * np.cos(phi)
    dm *= 0.25 * math.pi * _WEIGHTS[:, None] * 0.5 * (r_o - r_i) * _WEIGHTS
    bodies.add(dm.sum(), (dm * x).sum() / dm.sum(), (dm * x * x).sum() / dm.sum(), (dm * r * r).sum() / dm.sum())

    # hole, relieved hole and seat are empty; shank and head fill a part of them
    shank, relieved, top = 0.5 * g.shank_diameter, g.flange_thickness - g.relief_depth, g.flange_thickness
    bodies.cylinders(-density, shank, 0.0, relieved)
    bodies.cylinders(-density, shank + g.relief_radius, relieved, top)
    bodies.cylinders(-density, 0.5 * g.seat_diameter, top, w)
    bodies.cylinders(g.rho_rivet, shank, 0.0, top)
    bodies.cylinders(g.rho_rivet, 0.5 * g.head_diameter, top, top + g.head_height)
    return bodies.inertia()
