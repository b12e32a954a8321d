"""Joint data for the dynamics from the condensed finite elements: stiffnesses, and the stress by head friction.

Friction itself is not solved here: the dynamics has friction states with the capacities mu P of the plates and mu P of
the heads.  This file gives the elastic stiffness of each branch: while the bores do not touch, the sticking heads drag
the rivet; after that the bores carry.
"""

import numpy as np

from .load_cases import surface_stress
from .section_mesh import edge_nodes

REFERENCE = 20.0  # N, preload at which tangents are taken: the response is homogeneous, so only ratios to it matter
# m, a fit at which the bores of the 6207's joint do not touch; of a larger joint more by its size, as the fits below
OPEN = -90e-6
# N/m, of the 6207's joint: a regularization.  By finite elements with Coulomb's friction plates under the preload are two to nine
# times as stiff until they slip (tests/joint_friction.py); the stress of the rivets is the same from 1e8 on, while beyond
# it the vibrations in the plane would become the fastest ones and shorten the steps of the dynamics.
K_T_PLATE = 1e8
HOLE_FITS = 1e-6 * np.array([-90, -40, -20, -10, -6, -3, -1, 0, 1, 2, 4, 8])


def _rim(joint, motion, P, V, fit):
    return joint.solve(P, 0.0, V, 0.0, 0.0, fit)[1][5 + motion]


def hole_stiffness(joint, fit, V=20.0):
    """Tangent dV/dx of both bores in series at V [N/m], preload 20 N, frictionless; both loads are those of the 6207's
    joint, see Geometry.size.
    """
    P, V = (load * joint.geometry.size**2 for load in (REFERENCE, V))
    return 0.2 * V / (_rim(joint, 0, P, 1.1 * V, fit) - _rim(joint, 0, P, 0.9 * V, fit))


def stack_stiffness(joint):
    """Preload per shortening of the rivet [N/m]."""
    return REFERENCE / joint.overclosure(REFERENCE, OPEN * joint.geometry.size)


def head_friction(joint, P=REFERENCE, F=2.0):
    """Tangential stiffness of both sticking heads in series [N/m]; growth of the fillet's stress per newton of friction
    [1/m2]: p1, von Mises.

    Uniform tractions drag the upper head by +F along x and the lower one by -F; bores open; the couple is balanced by
    the heads' pressures. The slip of the halves keeps heads and flanges together: 2 t q_4 - t q_9 + elastic
    displacements.
    """
    g, rivet, flange = joint.geometry, joint.rivet, joint.flange
    t, radii = g.flange_thickness, (joint.rings["UH"][0], joint.rings["UH"][-1])
    area = np.pi * (radii[1] ** 2 - radii[0] ** 2)
    up, down = (rivet.shear_load(edge_nodes(rivet.mesh, z=z, between=radii)) for z in (t, -t))
    drag, top = (up - down) / area, flange.shear_load(edge_nodes(flange.mesh, z=t, between=radii)) / area
    # per newton, of the rivet and of the upper flange; the upper flange feels -F, the lower one +F
    u, v = rivet.solve(1, drag), flange.solve(1, top)
    # outward displacement amplitudes of the rings
    on_rivet, on_flange = joint.rivet_loads.T @ u, joint.flange_loads.T @ v
    approach = np.zeros(joint.size)
    for body, rings, sign in (
        (on_rivet, joint.ring_slices, 1.0),
        (on_flange, joint.upper, -1.0),
        (on_flange, joint.lower, 1.0),
    ):
        for name, place in rings.items():
            approach[joint.slices[name]] += sign * np.outer(body[place, 0], joint.hats[name][0][:, 1]).ravel()
    contact, member = joint.problems["plane"]

    def solve(force):
        gaps = joint.gaps(P, OPEN * g.size) - force * approach / joint.weight
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


def joint_data(joint):
    """The joint section of the table."""
    g = joint.geometry
    k_head, *_ = head_friction(joint)
    return {
        **g.joint,
        "k_t_plate": K_T_PLATE * g.size,
        "k_t_head": float(k_head),
        "k_stack": float(stack_stiffness(joint)),
        "hole_fit": g.size * HOLE_FITS,
        "k_hole": [float(hole_stiffness(joint, fit)) for fit in g.size * HOLE_FITS],
    }
