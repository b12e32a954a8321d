"""Ribbon cages of three bearings for tests: steel, sizes by hand, each from its drawing's rules."""

from dataclasses import replace

from rivet_model.geometry import Geometry

MM = 1e-3


def ribbon(Z, D, d_m, sheet, width, depth, radius, bend, shank, head):
    """Geometry in mm: sheet S, ring width, pocket depth K, sphere's radius Rc, bend radius on the sheet's back."""
    return Geometry(
        shape="ribbon",
        Z=Z,
        d_m=d_m * MM,
        ball_diameter=D * MM,
        pocket_clearance=round(2.0 * radius - D, 6) * MM,
        pocket_fillet=(bend + sheet) * MM,
        cage_half_width=(depth + sheet) * MM,
        flange_thickness=sheet * MM,
        cage_inner_diameter=(d_m - width) * MM,
        cage_outer_diameter=(d_m + width) * MM,
        shank_diameter=shank * MM,
        head_diameter=head * MM,
        head_height=0.6 * shank * MM,
        relief_radius=shank / 6.0 * MM,
        relief_depth=0.25 * sheet * MM,
        edge_break=0.1 * sheet * MM,
        middle_zone=0.05 * sheet * MM,
        patch_radius=0.5 * width * MM,
        E_flange=206e9,
        nu_flange=0.3,
        rho_flange=7850.0,
        alpha_flange=12e-6,
        fillet_radius=shank / 20.0 * MM,
    )


RIBBONS = {
    "6205": ribbon(9, 7.938, 38.5, 0.8, 3.57, 4.02, 4.07, 0.73, 1.2, 1.92),
    "6309": ribbon(8, 17.4625, 72.5, 1.5, 7.86, 8.80, 8.87, 2.52, 1.5, 2.4),
}


def bare(g):
    """The half without its part of the rivets."""
    return replace(g, rho_rivet=1e-9)
