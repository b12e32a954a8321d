"""Rivet table from closed forms: the FMU reads such a table where there is none from finite elements.

python -m rivet_model.closed_form OUT.json [GEOMETRY.toml]

Beam bending of the shank under head and hole, notch factors as stated below, interference by Lame; halves and
pads are rigid, joints hinge at the edges of their pads.
The stress of the head has an error of tens of per cent, because notch factors and lever arms are estimates.
"""

import argparse
import sys

import numpy as np

from bearing_model.cage.common.joint_law import AXES, JointLaw, law_load
from bearing_model.rivet import rivet_table

from . import half_loads, half_shape, reduction, splines, table
from .geometry import Geometry

K_T = 4.25  # tension, fillet under a loaded head: converged finite elements, default geometry
K_B = 2.25  # bending, shoulder fillet D/d = 1.733, r/d = 0.0533: Peterson 2.18, finite elements 2.25
K_PRESSURE = 0.5  # head stress per interference pressure: finite elements, default relief depth
HEAD_FRICTION = 11.7e6  # head stress per friction force at the heads [1/m2]: finite elements
K_STACK = 5.05e7  # N/m: finite elements of the default geometry, rounded
FLANGE_SHARE = (
    0.5  # of the compliance of head and flanges: within 3 % of the finite elements of steel, brass and bronze
)
K_CLOSED, K_OPEN = 2.35e8, 2.8e7  # N/m: finite elements of the default geometry, rounded
KNOTS = {
    "a": np.linspace(0.0, 1.0, 9),
    "c": np.array([0.0, 0.5, 1.0]),
    "xi": np.array([-5e-9, 0.0, 5e-9, 2e-8, 6e-8, 1.5e-7, 4e-7]),
}


def lame_pressure(geometry, fit):
    """Pressure of a solid shank in a ring with free rim, fit = diameter difference (Lame, plane stress)."""
    g = geometry
    inner, outer = (g.shank_diameter / 2) ** 2, g.patch_radius**2
    flexibility = (1 - g.nu_rivet) / g.E_rivet + ((outer + inner) / (outer - inner) + g.nu_flange) / g.E_flange
    return np.maximum(fit, 0.0) / g.shank_diameter / flexibility


def stress(geometry, T, V, m, chi, fit):
    """Channels [..., 4] in Pa of a shank that carries tension T, transverse load V and moment m, elastic fit [m]; chi
    as in fmu_src/rivet/rivet_rom.h.
    """
    g = geometry
    lever = V * g.relief_depth
    bending = np.sqrt((lever + m * np.abs(chi)) ** 2 + m**2 * (1 - chi**2)) / (np.pi * g.shank_diameter**3 / 32)
    p = lame_pressure(g, fit)
    head = K_T * T / g.shank_area + K_B * bending + K_PRESSURE * p
    axial, shear = T / g.shank_area + m / (np.pi * g.shank_diameter**3 / 32), 4 / 3 * V / g.shank_area
    mid_vm, mid_p1 = np.sqrt((axial + p) ** 2 + 3 * shear**2), axial / 2 + np.sqrt((axial / 2) ** 2 + shear**2)
    return np.stack([head, np.sqrt(1 - g.nu_rivet + g.nu_rivet**2) * head, mid_vm, mid_p1], axis=-1)


def stack_stiffness(geometry, k_own=K_STACK):
    """Preload per shortening of the rivet [N/m]: the shank as a bar, head and flanges by size and elastic constants
    from those of the default geometry, whose stiffness is k_own.
    """
    own = Geometry()

    def shank(g):
        return 2.0 * g.flange_thickness / (g.E_rivet * g.shank_area)

    softer = FLANGE_SHARE * own.E_flange / geometry.E_flange + (1.0 - FLANGE_SHARE) * own.E_rivet / geometry.E_rivet
    return 1.0 / (shank(geometry) + (1.0 / k_own - shank(own)) * softer * own.size / geometry.size)


def joint_data(geometry):
    """Joint for the dynamics.  Stiffnesses but that of the stack are those of the default geometry, rounded, whatever
    the geometry.
    """
    g = geometry
    return {
        **g.joint,
        "k_t_plate": 1e8,
        "k_t_head": 6.5e6,
        "k_stack": stack_stiffness(g),
        "hole_fit": [g.size * fit for fit in (-20e-6, -10e-6, 0.0, 5e-6)],
        "k_hole": [1.5e7, 2.0e7, 2.8e7, 4.65e7],
    }


def joint_law_samples(geometry, load, P):
    """(u, phi_r, phi_t, T, m_r, m_t) of a joint under (N, M_r, M_t) and P: rigid pads that hinge at their edges, the
    head turning with them.

    Joints do not move, so loads are carried as bonded joints would: on the safe side.  T = max(P, N + |M_r|/e_t +
    |M_t|/e_r), e: distances of the pad's edges from the rivet; the shank bends by the rotation of the hinge, m = (T -
    P) I/(A e) = (T - P) d^2/(16 e).
    """
    N, M_r, M_t = load
    e_t, e_r = half_shape.pad_half_length(geometry), (geometry.cage_outer_diameter - geometry.cage_inner_diameter) / 4
    T = max(P, N + abs(M_r) / e_t + abs(M_t) / e_r)
    M = np.hypot(M_r, M_t)
    m = (T - P) * geometry.shank_diameter**2 / 16 * np.array([M_r / e_t, M_t / e_r]) / M if M > 0.0 else np.zeros(2)
    return np.array([0.0, 0.0, 0.0, T, *m])


def half_data(geometry):
    """HalfData of rigid halves: no elastic share of the load path; the centrifugal load as the pull of a pitch beside
    the web that holds it.
    """
    g, Z = geometry, geometry.Z
    inertia = half_shape.half_inertia(g)
    lever = 0.5 * (g.cage_half_width + half_shape.pocket_radius(g)) - inertia.x_c
    spin = np.zeros(8)
    spin[4] = -lever * np.sqrt(inertia.m * inertia.J_p) / Z  # m r/Z with r the radius of gyration
    # the web as a beam from bar to bar: only its order of size matters, as joints do not move
    width, height = (g.cage_outer_diameter - g.cage_inner_diameter) / 2, g.cage_half_width - half_shape.pocket_radius(g)
    k = 2.0 * g.E_flange * width * height**3 / (np.pi * g.d_m / Z) ** 3
    chain = np.zeros((Z, 1, 1))
    chain[[0, 1, -1], 0, 0] = 1.0, -0.5, -0.5
    knots = half_loads.KNOTS
    tau, q, psi = (splines.sites(knots[name]) for name in AXES)
    values = np.array(
        [[[joint_law_samples(g, *law_load(half_loads.law_length(g), a, b, c)) for c in psi] for b in q] for a in tau]
    )
    law = JointLaw(
        half_loads.law_length(g),
        knots,
        splines.interpolate([knots[name] for name in AXES], values),
        k * chain * np.diag([1.0, width**2, width**2]),
        k * chain * np.eye(2),
        np.sign(spin[4]),
    )
    chi = np.array([0.0, np.pi / 4, np.pi / 2])
    return rivet_table.HalfData(
        **inertia._asdict(),
        chi=chi,
        path=np.zeros((3, Z, 8, 3)),
        spin=spin,
        land=np.zeros((Z // 2 + 1, 3, 2, 8)),
        growth=np.zeros(2),
        law=law,
        k_closed=K_CLOSED,
        k_open=K_OPEN,
    )


def make_table(geometry=None):
    """Table of kind closed_form for the geometry (default: that of Geometry)."""
    geometry = geometry or Geometry()
    if geometry.shape != "machined":
        raise ValueError(
            f"geometry: shape = {geometry.shape!r}: closed forms are of a machined half; finite elements know both"
        )
    knots = reduction.knots_for(geometry, KNOTS)
    a, c, xi = np.meshgrid(*(splines.sites(knots[name]) for name in rivet_table.SHANK_AXES), indexing="ij")
    loads = reduction.shank_loads(a, c, reduction.bending_length(geometry))
    sheets = [stress(geometry, *loads, chi, xi) / rivet_table.MPA_PER_N for chi in (1.0, 0.5, 0.0)]
    # first yield at the bore: 2 tau = p + hoop tension, taken as pure shear 2 p
    yield_pressure = geometry.yield_flange / np.sqrt(3)
    fit_yield = yield_pressure / lame_pressure(geometry, 1.0)
    # fully plastic ring
    full = 2 / np.sqrt(3) * geometry.yield_flange * np.log(2 * geometry.patch_radius / geometry.shank_diameter)
    fit_full = full / lame_pressure(geometry, 1.0)
    fit_a = np.array([0.0, fit_yield, 2 * fit_full, 4 * fit_full, max(44e-6, 5 * fit_full)])
    fit_eff = np.array([0.0, fit_yield, 0.9 * fit_full, fit_full, 1.02 * fit_full])
    return table.make(
        geometry,
        "closed_form",
        reduction.bending_length(geometry),
        knots,
        np.stack(sheets, axis=-2),
        (fit_a, fit_eff),
        joint_data(geometry),
        half_data(geometry),
        head_friction=HEAD_FRICTION,
        head_friction_vm=HEAD_FRICTION * float(np.sqrt(1 - geometry.nu_rivet + geometry.nu_rivet**2)),
        fit_flange_yield=float(fit_yield),
        note="closed forms with stated notch factors, not finite elements",
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
