"""Constants of the pockets of a ribbon cage.  Equations in pocket_spheres.py."""

from typing import NamedTuple

import numpy as np

CONFORMING = 0.7  # of a/R in the load of ball and sphere


class Rim(NamedTuple):
    """A ring that touches the sphere along a seam."""

    K: float  # Q = K delta^1.5 [N/m^1.5]
    reach: float  # R_c + rho [m]
    A: float  # radius of the ring and distance of its plane from the sphere's centre [m]
    H: float
    sin: float  # of the seam's angle H/reach
    cos: float
    sin_arc: float  # of half the arc's opening
    cos_arc: float


class Spheres(NamedTuple):
    """Constants of the pockets of a ribbon cage."""

    e: float  # of a sphere's centre beyond the split [m]
    r: float  # of the pockets' middle from the axis [m]
    radius: float  # R_c [m]
    K: float  # Q = K delta^1.5 (1 + more delta^0.5)
    more: float
    a_delta: float  # a/delta^0.5 = sqrt(R_eff) [m^0.5]
    slack: np.ndarray  # R_c - R of each pocket [Z] [m]
    fillet: Rim
    edge: Rim


def spheres_edge(p):
    """Radius of the pockets' edges [m]."""
    return p.cage.pocket_edge or 0.1 * p.cage.sheet


def spheres_seams(p):
    """sin of the seams' angles chi_1 and eta."""
    radius, e = spheres_radius(p), spheres_radius(p) - p.cage.pocket_depth
    fillet, edge = p.cage.pocket_fillet, spheres_edge(p)
    return (fillet + e) / (radius + fillet), (0.25 * (p.cage.D_o - p.cage.D_i) - edge) / (radius + edge)


def spheres_radius(p):
    """R_c [m]."""
    return 0.5 * (p.bearing.D + p.cage.pocket_clearance)


def derive_rim(E_star, R, radius, rho, sine, middle, across):
    """A rim of the radius rho whose seam is at the angle of this sine; middle, across: of its arc's end, in its plane."""
    from bearing_model.physics.hertz import hertz_contact  # SciPy, without which parameters can be checked

    reach, end = radius + rho, np.hypot(middle, across)
    K = hertz_contact(1.0 / R + 1.0 / rho, max(1.0 / R - 1.0 / radius, 1e-3 / R), E_star).K
    cosine = np.sqrt(1.0 - sine**2)
    return Rim(K, reach, reach * cosine, reach * sine, sine, cosine, across / end, middle / end)


def spheres_derive(p, E_star, slack):
    """Constants of the pockets; slack: R_c - R of each [Z]."""
    R, radius = 0.5 * p.bearing.D, spheres_radius(p)
    R_eff = 1.0 / max(1.0 / R - 1.0 / radius, 1e-3 / R)
    sin_chi, sin_eta = spheres_seams(p)
    along = np.sqrt(1.0 - sin_chi**2 - sin_eta**2)  # of the corner
    return Spheres(
        e=radius - p.cage.pocket_depth,
        r=0.25 * (p.cage.D_o + p.cage.D_i),
        radius=radius,
        K=4.0 / 3.0 * E_star * np.sqrt(R_eff),
        more=CONFORMING * np.sqrt(R_eff) / R,
        a_delta=np.sqrt(R_eff),
        slack=slack,
        fillet=derive_rim(E_star, R, radius, p.cage.pocket_fillet, sin_chi, along, sin_eta),
        edge=derive_rim(E_star, R, radius, spheres_edge(p), sin_eta, sin_chi, along),
    )
