"""Rivet table from closed forms: the FMU reads such a table where there is none from finite elements.

python -m rivet_model.closed_form OUT.json [GEOMETRY.toml]

Bolted joint with preload shielding, beam bending of the shank under head and hole, notch factors as stated below, interference by Lame.
The stress of the head has an error of tens of per cent, because notch factors and lever arms are estimates.
"""

import argparse
import sys

import numpy as np

from bearing_model import rivet_table

from . import splines, table
from .geometry import Geometry

K_T = 4.25  # tension, fillet under a loaded head: converged finite elements, default geometry
K_B = 2.25  # bending, shoulder fillet D/d = 1.733, r/d = 0.0533: Peterson 2.18, finite elements 2.25
K_PRESSURE = 0.5  # head stress per interference pressure: finite elements, default relief depth
HEAD_FRICTION = 11.7e6  # head stress per friction force at the heads [1/m2]: finite elements
MOMENT_LENGTH = 2e-3  # L: prying opens the default joint near M = P L
SHANK_LENGTH = 0.3e-3  # m: opening joints reach |m|/T = 0.2 mm; heads would lift off at 0.5 mm
KNOTS = {
    "a": np.linspace(0.0, 1.0, 9),
    "b": np.array([0.0, 0.2, 0.35, 0.45, 0.5, 0.55, 0.6, 0.7, 0.85, 1.0]),
    "c": np.array([0.0, 0.15, 0.3, 0.4, 0.5, 0.65, 0.8, 1.0]),
    "xi": np.array([-5e-9, 0.0, 5e-9, 2e-8, 6e-8, 1.5e-7, 4e-7]),
}


def load_share(geometry):
    """Share of an external tension that the rivet of the closed joint takes: stiffness of the rivet beside that of the pressure cone (Shigley, 30 degrees)."""
    g = geometry
    grip = 2 * g.flange_thickness
    k_rivet = g.E_rivet * g.shank_area / (grip + 2 * g.head_height)
    cone = np.log(5 * (0.5774 * grip + 0.5 * g.shank_diameter) / (0.5774 * grip + 2.5 * g.shank_diameter))
    k_cone = 0.5774 * np.pi * g.E_flange * g.shank_diameter / (2 * cone)
    return k_rivet / (k_rivet + k_cone)


def rivet_tension(geometry, P, N):
    """Tension P + share N until the joint opens, N after that; exactly P without external tension."""
    return np.maximum(P + load_share(geometry) * N, N)


def lame_pressure(geometry, fit):
    """Pressure of a solid shank in a ring with free rim, fit = diameter difference (Lame, plane stress)."""
    g = geometry
    inner, outer = (g.shank_diameter / 2) ** 2, g.patch_radius**2
    flexibility = (1 - g.nu_rivet) / g.E_rivet + ((outer + inner) / (outer - inner) + g.nu_flange) / g.E_flange
    return np.maximum(fit, 0.0) / g.shank_diameter / flexibility


def stress(geometry, P, N, V, M, chi, fit):
    """Channels [..., 4] in Pa for loads in N and N.m and an elastic fit in m; chi as in fmu_src/rivet_rom.h."""
    g = geometry
    prying = load_share(geometry) * M
    T = rivet_tension(geometry, P, N + M / MOMENT_LENGTH)
    # Cantilever: the hole bears at the end of the relief; M bends in the plane of V (|chi| = 1) or across it.
    lever = V * g.relief_depth
    bending = np.sqrt((lever + prying * np.abs(chi)) ** 2 + (prying**2) * (1 - chi**2)) / (np.pi * g.shank_diameter**3 / 32)
    p = lame_pressure(geometry, fit)
    head = K_T * T / g.shank_area + K_B * bending + K_PRESSURE * p
    head_vm = np.sqrt(1 - g.nu_rivet + g.nu_rivet**2) * head  # plane strain at the notch: second principal = nu first
    axial, shear = T / g.shank_area, 4 / 3 * V / g.shank_area
    mid_vm = np.sqrt((axial + p) ** 2 + 3 * shear**2)  # radial and hoop stress -p; 3 tau^2
    mid_p1 = axial / 2 + np.sqrt((axial / 2) ** 2 + shear**2)
    return np.stack([head, head_vm, mid_vm, mid_p1], axis=-1)


def shank_stress(geometry, T, V, m, chi, fit):
    """Channels [..., 4] in Pa of a shank that carries tension T, transverse load V and moment m, elastic fit [m]; chi as in fmu_src/rivet_rom.h."""
    g = geometry
    lever = V * g.relief_depth
    bending = np.sqrt((lever + m * np.abs(chi)) ** 2 + m**2 * (1 - chi**2)) / (np.pi * g.shank_diameter**3 / 32)
    p = lame_pressure(g, fit)
    head = K_T * T / g.shank_area + K_B * bending + K_PRESSURE * p
    axial, shear = T / g.shank_area + m / (np.pi * g.shank_diameter**3 / 32), 4 / 3 * V / g.shank_area
    mid_vm, mid_p1 = np.sqrt((axial + p) ** 2 + 3 * shear**2), axial / 2 + np.sqrt((axial / 2) ** 2 + shear**2)
    return np.stack([head, np.sqrt(1 - g.nu_rivet + g.nu_rivet**2) * head, mid_vm, mid_p1], axis=-1)


def shank_table(geometry):
    """ShankTable of the closed forms."""
    knots = {"a": KNOTS["a"], "c": np.array([0.0, 0.5, 1.0]), "xi": KNOTS["xi"]}
    a, c, xi = np.meshgrid(*(splines.sites(knots[name]) for name in rivet_table.SHANK_AXES), indexing="ij")
    T = 1.0 - a
    sheets = [shank_stress(geometry, T, a, c * SHANK_LENGTH * T, chi, xi) / rivet_table.MPA_PER_N for chi in (1.0, 0.5, 0.0)]
    return table.make_shank(SHANK_LENGTH, knots, np.stack(sheets, axis=-2))


def loads_of(a, b, c, moment_length):
    """Loads (P, N, V, M) of s = 1 N at the table's coordinates: the inverse of the formulas in fmu_src/rivet_rom.h."""
    force = 1.0 - c
    axial = (1.0 - a) * force
    return (1.0 - b) * axial, b * axial, a * force, c * moment_length


def joint_data(geometry):
    """Joint for the dynamics.  Stiffnesses are those of the default geometry, rounded, whatever the geometry."""
    g = geometry
    return {
        "A": g.shank_area,
        "d_m": g.d_m,
        "d": g.shank_diameter,
        "grip": 2 * g.flange_thickness,
        "k_rivet": 3.4e7,
        "k_plate": 6e7,
        "k_t_plate": 1.5e7,
        "k_t_head": 6.5e6,
        "k_stack": 5.05e7,
        "alpha_rivet": g.alpha_rivet,
        "alpha_flange": g.alpha_flange,
        "T_0": g.T_0,
        "prying_lever": MOMENT_LENGTH,
        "prying_share": 0.1,
        "hole_fit": [-20e-6, -10e-6, 0.0, 5e-6],
        "k_hole": [1.5e7, 2.0e7, 2.8e7, 4.65e7],
    }


def make_table(geometry=None, cage=None):
    """Table of kind closed_form for the geometry (default: that of Geometry); cage: its HalfData (default: by coarse finite elements, seconds)."""
    geometry = geometry or Geometry()
    if cage is None:
        from . import half, half_loads  # not needed by those who bring it

        cage = half_loads.make_half(geometry, half.COARSE, half_loads.COARSE_KNOTS)
    a, b, c, xi = np.meshgrid(*(splines.sites(KNOTS[name]) for name in rivet_table.AXES), indexing="ij")
    sheets = [stress(geometry, *loads_of(a, b, c, MOMENT_LENGTH), chi, xi) / rivet_table.MPA_PER_N for chi in (1.0, 0.5, 0.0)]
    yield_pressure = geometry.yield_flange / np.sqrt(3)  # first yield at the bore: 2 tau = p + hoop tension, taken as pure shear 2 p
    fit_yield = yield_pressure / lame_pressure(geometry, 1.0)
    full = 2 / np.sqrt(3) * geometry.yield_flange * np.log(2 * geometry.patch_radius / geometry.shank_diameter)  # fully plastic ring
    fit_full = full / lame_pressure(geometry, 1.0)
    fit_a = np.array([0.0, fit_yield, 2 * fit_full, 4 * fit_full, max(44e-6, 5 * fit_full)])
    fit_eff = np.array([0.0, fit_yield, 0.9 * fit_full, fit_full, 1.02 * fit_full])
    return table.make(
        geometry,
        "closed_form",
        KNOTS,
        np.stack(sheets, axis=-2),
        (fit_a, fit_eff),
        joint_data(geometry),
        np.zeros((geometry.Z, 5, 3)),
        shank=shank_table(geometry),
        half=cage,
        moment_length=MOMENT_LENGTH,
        head_friction=HEAD_FRICTION,
        head_friction_vm=HEAD_FRICTION * float(np.sqrt(1 - geometry.nu_rivet + geometry.nu_rivet**2)),
        fit_flange_yield=float(fit_yield),
        note="closed forms with stated notch factors, not finite elements; cage half by coarse finite elements",
    )


def main(arguments=None):
    """Command line; returns 0, or 2 with a message and no file."""
    parser = argparse.ArgumentParser(prog="python -m rivet_model.closed_form", description=__doc__.partition("\n")[0])
    parser.add_argument("out")
    parser.add_argument("geometry", nargs="?")
    options = parser.parse_args(arguments)
    try:
        table.write(make_table(Geometry.from_toml(options.geometry) if options.geometry else None), options.out)
    except (OSError, ValueError) as error:
        print(f"rivet table: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
