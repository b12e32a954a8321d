"""Joint data for the dynamics from the condensed finite elements: stiffnesses, moment at opening, and the stress by head friction.

Friction itself is not solved here: the dynamics has friction states with the capacities mu P of the plates and mu P of the heads.  This file gives the
elastic stiffness of each branch: while the bores do not touch, the sticking heads drag the rivet; after that the bores carry.
"""

import numpy as np

from .load_cases import surface_stress
from .section_mesh import edge_nodes

REFERENCE = 20.0  # N, preload at which tangents are taken: the response is homogeneous, so only ratios to it matter
K_T_PLATE = 1.5e7  # N/m: a regularization; the closed plates are stiffer than 2e8 by finite elements, which would only shorten the steps of the dynamics
HOLE_FITS = 1e-6 * np.array([-90, -40, -20, -10, -6, -3, -1, 0, 1, 2, 4, 8])


def _rim(joint, motion, P=REFERENCE, N=0.0, V=0.0, fit=-90e-6):
    return joint.solve(P, N, V, 0.0, 0.0, fit)[1][5 + motion]


def hole_stiffness(joint, fit, V=20.0):
    """Tangent dV/dx of both bores in series at V [N/m], preload 20 N, frictionless."""
    return 0.2 * V / (_rim(joint, 0, V=1.1 * V, fit=fit) - _rim(joint, 0, V=0.9 * V, fit=fit))


def axial_stiffness(joint):
    """Stiffness of the open joint (N = 3...4 P), and the stiffness that the closed plates add to it at N = P/4...P/2 [N/m]."""
    z = [_rim(joint, 2, N=ratio * REFERENCE) for ratio in (0.25, 0.5, 3.0, 4.0)]
    k_open = REFERENCE / (z[3] - z[2])
    return k_open, 0.25 * REFERENCE / (z[1] - z[0]) - k_open


def stack_stiffness(joint):
    """Preload per shortening of the rivet [N/m]."""
    return REFERENCE / joint.overclosure(REFERENCE, -90e-6)


def head_friction(joint, P=REFERENCE, F=2.0):
    """Tangential stiffness of both sticking heads in series [N/m]; growth of the fillet's stress per newton of friction [1/m2]: p1, von Mises.

    Uniform tractions drag the upper head by +F along x and the lower one by -F; bores open; the couple is balanced by the heads' pressures.
    The slip of the halves is what keeps heads and flanges together: 2 t q_4 - t q_9 + elastic displacements.
    """
    g, rivet, flange = joint.geometry, joint.rivet, joint.flange
    t, radii = g.flange_thickness, (joint.rings["UH"][0], joint.rings["UH"][-1])
    area = np.pi * (radii[1] ** 2 - radii[0] ** 2)
    up, down = (rivet.shear_load(edge_nodes(rivet.mesh, z=z, between=radii)) for z in (t, -t))
    drag, top = (up - down) / area, flange.shear_load(edge_nodes(flange.mesh, z=t, between=radii)) / area
    u, v = rivet.solve(1, drag), flange.solve(1, top)  # per newton, of the rivet and of the upper flange; the upper flange feels -F, the lower one +F
    on_rivet, on_flange = joint.rivet_loads.T @ u, joint.flange_loads.T @ v  # outward displacement amplitudes of the rings
    approach = np.zeros(joint.size)
    for body, rings, sign in ((on_rivet, joint.ring_slices, 1.0), (on_flange, joint.upper, -1.0), (on_flange, joint.lower, 1.0)):
        for name, place in rings.items():
            approach[joint.slices[name]] += sign * np.outer(body[place, 0], joint.hats[name][0][:, 1]).ravel()
    contact, member = joint.problems["plane"]

    def solve(force):
        gaps = joint.gaps(P, -90e-6) - force * approach / joint.weight
        f = np.zeros(10)
        f[4], f[9] = 2 * t * force, -t * force
        solution = contact.solve(np.bincount(member, weights=gaps, minlength=contact.C.shape[0]), f)
        forces = solution.p[member]
        first = {
            name: joint.amplitudes(forces[:, None], rings)[0, 1, :, 0]
            for name, rings in (("rivet", joint.ring_slices), ("upper", joint.upper), ("lower", joint.lower))
        }
        elastic = force * ((drag.T @ u)[0, 0] + 2 * (top.T @ v)[0, 0]) - on_rivet[:, 0] @ first["rivet"]
        elastic += on_flange[:, 0] @ (first["upper"] - first["lower"])
        slip = 2 * t * solution.q[4] - t * solution.q[9] + np.pi * elastic
        shear = force * joint.surface_response(joint.fillet, 1, u)[..., 0]
        field = joint.fields(forces[:, None])[0][..., 0]
        phi = 2 * np.pi * np.arange(field.shape[2]) / field.shape[2]
        total = field + shear[:, :, None] * np.stack([np.cos(phi), np.cos(phi), np.sin(phi)])[:, None, :]
        return slip, [channel.max() for channel in surface_stress(*total)]

    slip, stress = solve(F)
    rest, preloaded = solve(0.0)
    growth = [(a - b) / F for a, b in zip(stress, preloaded, strict=True)]
    return F / (slip - rest), *growth


def prying(joint, P=REFERENCE):
    """Moment at which the joint opens per clamp force [m], and rotational stiffness of the joint held open [N.m/rad].

    Far past opening, the moment over the rotation is a straight line; its intercept at zero rotation is the moment at opening.
    """
    M = np.array([4.0, 5.0]) * P * 2e-3
    rotation = [joint.solve(P, 0.0, 0.0, m, 0.0, -90e-6)[1][9] for m in M]
    k_open = (M[1] - M[0]) / (rotation[1] - rotation[0])
    return (M[1] - k_open * rotation[1]) / P, k_open


def joint_data(joint, k_half):
    """The joint section of the table.  k_half: rotational stiffness of a cage half at one rivet [N.m/rad] (cage_half.py)."""
    g = joint.geometry
    k_rivet, k_plate = axial_stiffness(joint)
    k_head, *_ = head_friction(joint)
    lever, k_open = prying(joint)
    return {
        "A": g.shank_area,
        "d_m": g.d_m,
        "d": g.shank_diameter,
        "grip": 2 * g.flange_thickness,
        "k_rivet": float(k_rivet),
        "k_plate": float(k_plate),
        "k_t_plate": K_T_PLATE,
        "k_t_head": float(k_head),
        "k_stack": float(stack_stiffness(joint)),
        "alpha_rivet": g.alpha_rivet,
        "alpha_flange": g.alpha_flange,
        "T_0": g.T_0,
        "prying_lever": float(lever),
        "prying_share": float(k_open / (k_open + 0.5 * k_half)),  # both halves turn, by half the joint's rotation each
        "hole_fit": HOLE_FITS,
        "k_hole": [float(hole_stiffness(joint, fit)) for fit in HOLE_FITS],
    }
