"""Parts common to both shapes of a cage half: statement of limits, inertia, and the bodies of revolution about the rivets."""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

LEAST_WALL = 0.2e-3  # m of metal around the seat or the head: assumed, the least that is made


class Limit(NamedTuple):
    """margin(g) >= 0 must hold [m]; keys: the values that it is about, the one to blame first; reason: the feature
    that would be impossible.
    """

    keys: tuple
    margin: Callable
    reason: str


class Inertia(NamedTuple):
    """Of one half with its half of the rivets: mass [kg], place x_c of its centre of mass [m], moments of inertia about
    it [kg m2].
    """

    m: float
    x_c: float
    J_p: float
    J_t: float


class Bodies:
    """Bodies of a half: mass, means of x, x^2, r^2."""

    def __init__(self, g):
        self.g, self.rows = g, []

    def add(self, mass, x, xx, rr):
        """One body, negative where metal is missing."""
        self.rows.append((mass, x, xx, rr))

    def cylinders(self, density, radius, low, high):
        """A cylinder about each rivet from x = low to high."""
        g, R = self.g, 0.5 * self.g.d_m
        mass = g.Z * density * math.pi * radius**2 * (high - low)
        self.add(mass, 0.5 * (low + high), (low * low + low * high + high * high) / 3.0, R**2 + 0.5 * radius**2)

    def inertia(self):
        """Inertia of all bodies together."""
        mass, mean_x, mean_xx, mean_rr = np.transpose(self.rows)
        m = mass.sum()
        x_c, J_p = mass @ mean_x / m, mass @ mean_rr
        return Inertia(float(m), float(x_c), float(J_p), float(0.5 * J_p + mass @ mean_xx - m * x_c**2))


def rivet_mass(g):
    """Mass of half a rivet [kg]: one head and the shank up to the split."""
    return g.rho_rivet * math.pi / 4 * (g.shank_diameter**2 * g.flange_thickness + g.head_diameter**2 * g.head_height)
