"""Shape of one half of a pressed ribbon cage in closed form: sphere, fillet, land; limits, mass, moments of inertia.

    x ^                                     A section through a pocket's axis (x) and along the circle (t), sheet of
      |        .-''''''-.                   constant thickness S.
      |      .'  .-..-.  '.                 ball side:  sphere  Rc about x = -e,  down to the seam at chi_1 from the split
    K |     /  .'      '.  \\    S           fillet  f, a torus about the pocket's axis: circle of radius rho_f at x = f
      |    ;  ;          ;  ;               land    x = 0, where the halves touch
      |   _.  |          |  ._____
      +--'---'            '----'--- t       e = Rc - K,    sin chi_1 = (f + e)/(Rc + f),    rho_f = (Rc + f) cos chi_1
     land  fillet    - e + sphere's centre

Radially the half goes from cage_inner_diameter to cage_outer_diameter.  The sphere's centre lies e beyond the split, so
that a ball pushed along the circumference touches both halves at chi_0 from the split, sin chi_0 = e/(Rc - D/2).  Names
as in geometry.py: S = flange_thickness, K + S = cage_half_width, f = pocket_fillet, 2 Rc = ball_diameter +
pocket_clearance; lengths in m.  At the radius r a place at the distance rho from the pocket's axis lies at

    z_m = sqrt(rho^2 - (r - d_m/2)^2),      theta = 2 asin(z_m/(2 sqrt(r d_m/2)))       exactly
"""

import math

import numpy as np

from .half_bodies import LEAST_WALL, Bodies, Limit

LEAST_BEND = 0.2  # of the sheet's thickness: radius of the bend on its back
LEAST_SHARE = 1.02  # of sin chi_0 over sin chi_1: contact beside the fillet
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(24)


def sphere_radius(g):
    """Rc [m]."""
    return 0.5 * (g.ball_diameter + g.pocket_clearance)


def offset(g):
    """e: how far beyond the split the sphere's centre lies [m]."""
    return sphere_radius(g) - pocket_depth(g)


def pocket_depth(g):
    """K: the sphere's bottom over the split [m]."""
    return g.cage_half_width - g.flange_thickness


def seam(g):
    """chi_1 [rad]: angle of the seam of fillet and sphere; NaN if there is none."""
    sine = (g.pocket_fillet + offset(g)) / (sphere_radius(g) + g.pocket_fillet)
    return math.asin(sine) if abs(sine) < 1.0 else math.nan


def fillet_circle(g):
    """rho_f: distance of the land's edge from the pocket's axis [m]; NaN without a seam."""
    return (sphere_radius(g) + g.pocket_fillet) * math.cos(seam(g))


def both_halves(g):
    """chi_0 [rad]: where a ball pushed along the circumference touches both halves."""
    return math.asin(min(1.0, offset(g) / (0.5 * g.pocket_clearance)))


def angle_at(g, z, r):
    """theta [rad] of a place whose z_m is z at the radius r."""
    return 2.0 * np.arcsin(z / (2.0 * np.sqrt(r * 0.5 * g.d_m)))


def land_angle(g, r):
    """theta of the land's edge at the radius r [rad]."""
    return angle_at(g, np.sqrt(fillet_circle(g) ** 2 - (r - 0.5 * g.d_m) ** 2), r)


def farthest_edge(g):
    """Distance of the ring's farther edge from the pitch circle [m]."""
    return 0.5 * max(abs(g.cage_outer_diameter - g.d_m), abs(g.d_m - g.cage_inner_diameter))


def land_half_length(g):
    """Least distance of the land's edge from the rivet's radial plane [m]; negative if there is no land."""
    if not fillet_circle(g) > farthest_edge(g):
        return -farthest_edge(g)
    r = np.linspace(0.5 * g.cage_inner_diameter, 0.5 * g.cage_outer_diameter, 33)
    return float(np.min(r * np.sin(math.pi / g.Z - land_angle(g, r))))


def exists(g):
    """Whether seam, sphere and land are there over the whole width of the ring."""
    is_ring = g.cage_outer_diameter > g.cage_inner_diameter
    return is_ring and sphere_radius(g) * math.cos(seam(g)) > farthest_edge(g) and land_half_length(g) > 0.0


POCKET = ("pocket_clearance", "cage_half_width", "flange_thickness", "ball_diameter")
LIMITS = (
    Limit(
        ("cage_half_width", "flange_thickness", "ball_diameter"),
        lambda g: pocket_depth(g) - 0.5 * g.ball_diameter,
        "a pocket deeper than the ball's radius",
    ),
    Limit(
        ("pocket_fillet", "flange_thickness"),
        lambda g: g.pocket_fillet - (1.0 + LEAST_BEND) * g.flange_thickness,
        "a fillet on the ball's side that leaves a bend on the sheet's back",
    ),
    Limit(
        ("cage_outer_diameter", "d_m", "cage_inner_diameter", "ball_diameter", "pocket_clearance"),
        lambda g: 0.9 * sphere_radius(g) - farthest_edge(g),
        "a ring narrower than the pocket's sphere",
    ),
    Limit(
        (*POCKET, "pocket_fillet"),
        lambda g: (
            offset(g)
            * (sphere_radius(g) + g.pocket_fillet)
            / (g.pocket_fillet + offset(g) if g.pocket_fillet + offset(g) > 0.0 else 1e-9)
            - LEAST_SHARE * 0.5 * g.pocket_clearance
        ),
        "a sphere that the ball touches beside the fillet (offset e = radius - depth against the play)",
    ),
    Limit(
        ("pocket_fillet", "head_diameter", "ball_diameter", "d_m", "Z", "pocket_clearance"),
        lambda g: land_half_length(g) - 0.5 * g.head_diameter - 0.5 * LEAST_WALL,
        "a land between the pockets that takes the rivet's head",
    ),
    Limit(
        ("cage_inner_diameter", "d_m", "head_diameter"),
        lambda g: g.d_m - g.head_diameter - 2.0 * LEAST_WALL - g.cage_inner_diameter,
        "a ring with metal inside the rivet's head",
    ),
    Limit(
        ("cage_outer_diameter", "d_m", "head_diameter"),
        lambda g: g.cage_outer_diameter - g.d_m - g.head_diameter - 2.0 * LEAST_WALL,
        "a ring with metal outside the rivet's head",
    ),
)


def meridian(g, arc, zeta):
    """(x, rho) of the sheet at the arc 0 (land's edge) ... 1 (seam) ... 2 (pole) of a meridian, zeta from the ball's
    side [m].
    """
    f, Rc, chi_1 = g.pocket_fillet, sphere_radius(g), seam(g)
    omega, chi = 0.5 * np.pi - (0.5 * np.pi - chi_1) * np.minimum(arc, 1.0), chi_1
    chi = chi_1 + (0.5 * np.pi - chi_1) * np.maximum(arc - 1.0, 0.0)
    fillet = (f - (f - zeta) * np.sin(omega), fillet_circle(g) - (f - zeta) * np.cos(omega))
    sphere = ((Rc + zeta) * np.sin(chi) - offset(g), (Rc + zeta) * np.cos(chi))
    return tuple(np.where(arc < 1.0, a, b) for a, b in zip(fillet, sphere, strict=True))


def at_radius(g, arc, zeta, r):
    """(x, theta) of the sheet at the radius r: arc 0 at the land's edge, 1 at the seam, 2 where theta = 0.

    On the sphere the arc goes with the angle of the circle that the cylinder of r and the sphere have nearly in common.
    """
    beside, Rc, chi_1 = r - 0.5 * g.d_m, sphere_radius(g) + zeta, seam(g)
    x, rho = meridian(g, np.minimum(arc, 1.0), zeta)
    circle = np.sqrt(Rc**2 - beside**2)
    first = np.arctan2(Rc * np.sin(chi_1), np.sqrt((Rc * np.cos(chi_1)) ** 2 - beside**2))
    kappa = first + (0.5 * np.pi - first) * np.maximum(arc - 1.0, 0.0)
    z = np.where(arc < 1.0, np.sqrt(np.maximum(rho**2 - beside**2, 0.0)), circle * np.cos(kappa))
    return np.where(arc < 1.0, x, circle * np.sin(kappa) - offset(g)), angle_at(g, z, r)


def half_inertia(g):
    """Inertia of one half with its part of the rivets, by integrals over sphere, fillets and lands."""
    bodies, R, Z, S, f = Bodies(g), 0.5 * g.d_m, g.Z, g.flange_thickness, g.pocket_fillet
    r_i, r_o, Rc, chi_1 = 0.5 * g.cage_inner_diameter, 0.5 * g.cage_outer_diameter, sphere_radius(g), seam(g)
    unit, weight = 0.5 * (1.0 + _NODES), 0.5 * _WEIGHTS
    r, zeta, u = np.meshgrid(r_i + (r_o - r_i) * unit, S * unit, unit, indexing="ij")
    w = np.einsum("i,j,k->ijk", (r_o - r_i) * weight, S * weight, weight)
    beside = r - R

    def add(x, z, section):
        """Both sides of Z pockets by the area element of the (x, z_m) plane."""
        dm = 2.0 * Z * g.rho_flange * w * section * r / (np.sqrt(r * R) * np.sqrt(1.0 - z * z / (4.0 * r * R)))
        m = dm.sum()
        bodies.add(m, (dm * x).sum() / m, (dm * x * x).sum() / m, (dm * r * r).sum() / m)

    # sphere: circles of radius q in slices of r; q dq = (Rc + zeta) dzeta
    circle = np.sqrt((Rc + zeta) ** 2 - beside**2)
    first = np.arctan2((Rc + zeta) * np.sin(chi_1), np.sqrt(((Rc + zeta) * np.cos(chi_1)) ** 2 - beside**2))
    kappa = first + (0.5 * np.pi - first) * u
    add(circle * np.sin(kappa) - offset(g), circle * np.cos(kappa), (Rc + zeta) * (0.5 * np.pi - first))
    # fillet: torus of radius f - zeta; dz_m = rho/z_m drho
    omega, own = chi_1 + (0.5 * np.pi - chi_1) * u, f - zeta
    rho = fillet_circle(g) - own * np.cos(omega)
    z = np.sqrt(rho**2 - beside**2)
    add(f - own * np.sin(omega), z, own * (0.5 * np.pi - chi_1) * rho / z)
    # lands
    r, w = r_i + (r_o - r_i) * unit, (r_o - r_i) * weight
    dm = 2.0 * Z * g.rho_flange * S * w * r * (np.pi / Z - land_angle(g, r))
    bodies.add(dm.sum(), 0.5 * S, S * S / 3.0, (dm * r * r).sum() / dm.sum())

    # the hole and its relief are empty; shank and head fill a part of them
    shank, relieved = 0.5 * g.shank_diameter, S - g.relief_depth
    bodies.cylinders(-g.rho_flange, shank, 0.0, relieved)
    bodies.cylinders(-g.rho_flange, shank + g.relief_radius, relieved, S)
    bodies.cylinders(g.rho_rivet, shank, 0.0, S)
    bodies.cylinders(g.rho_rivet, 0.5 * g.head_diameter, S, S + g.head_height)
    return bodies.inertia()
