"""Loads of the rivets.

    two halves   N = T - N_plate; the shank carries the hole force B, the heads the friction H; plate friction S bypasses the rivet;
                 the flexible cage half adds the loads by which a pocket force pries the joints beside it open (load_path.py)
    rigid cage   the wrench between the halves, (half 1 - half 0)/2 as both have the same inertia, on the circle of rivets; its transverse
                 part loads plates (up to mu P), then heads (mu P), then the shank

The transverse part of the load path reaches the shank only in a hole without play: in a hole with play the joint relieves this part by slipping,
by much less than the play.  The prying moment is limited where it opens the joint.  All loads are in the body frame of half 0; the rivets are at
angles 2 pi (k + 1/2)/Z.
"""

import numpy as np

from bearing_model.lanes import ball_array_sum
from bearing_model.load_path import PATH_M_R, PATH_M_T, PATH_N, PATH_V_R, PATH_V_T, load_path_flexible, load_path_rigid
from bearing_model.pocket import pocket_split
from bearing_model.rivet_rom import RivetLoad, joint_prying
from bearing_model.variables import CageModel
from bearing_model.vec import vec_dot


def rivets_slip(model, w):
    """Slip of one half against the other at the joints, in the plane [m]."""
    return 0.0 * w.x if model.p.scene.cage == CageModel.RIGID else np.hypot(w.u[1], w.u[2])


def two_half_load(model, w):
    V_y, V_z = w.S + w.H + w.B
    load = RivetLoad(P=model.d.P, N=w.T - w.N_plate, V_y=-w.B[0], V_z=-w.B[1], M_y=0.0, M_z=0.0, F_head=np.hypot(*w.H))
    return load, np.hypot(V_y, V_z)


def rigid_wrench(model, w, pocket_F, pocket_M):
    """Wrench of pockets and lands on half 1 less that on half 0, halved, about the cage's centre in its body frame."""
    cage, other = w.half
    # a rigid cage keeps all pocket forces on half 0: the part of half 1 goes over
    F = 0.5 * (other.F - cage.F) + ball_array_sum(pocket_F[1])
    M = 0.5 * (other.M - cage.M) + ball_array_sum(pocket_M[1])
    axes = (cage.a, cage.b_y, cage.b_z)
    return [vec_dot(e, F) for e in axes] + [vec_dot(e, M) for e in axes]


def rigid_load(model, w, pocket_F, pocket_M):
    R, friction = 0.5 * model.p.bearing.d_m, model.p.joint.mu * model.d.P
    N, V_y, V_z = load_path_rigid(2.0 * R, rigid_wrench(model, w, pocket_F, pocket_M), model.d.rivet_y / R, model.d.rivet_z / R)
    V = np.hypot(V_y, V_z)
    shank = np.divide(V - 2.0 * friction, V, out=np.zeros_like(V), where=V > 2.0 * friction)
    F_head = np.clip(V - friction, 0.0, friction)
    return RivetLoad(P=model.d.P, N=N, V_y=shank * V_y, V_z=shank * V_z, M_y=0.0, M_z=0.0, F_head=F_head), V


def pocket_path(model, pocket, h):
    """Loads (N, V_r, V_t, M_r, M_t) of the rivets by prying of the forces on the pockets of half h [..., Z, 5]."""
    matrix, side = model.d.table.load_path, 2 * h - 1
    forces = np.moveaxis(pocket, 0, -2)  # [..., 3, Z]
    flat = forces.reshape(-1, *forces.shape[-2:])
    loads = np.array([load_path_flexible(matrix, side, *F) for F in flat])
    return loads.reshape(*forces.shape[:-2], *loads.shape[-2:])


def rivets_load(model, w):
    """RivetLoad of all rivets and the transverse load V of the joints [N], arrays [..., Z]."""
    if model.p.scene.cage == CageModel.RIGID:
        pocket, pocket_F, pocket_M = pocket_split(model, w)
        load, V = rigid_load(model, w, pocket_F, pocket_M)
    else:
        pocket = w.pocket
        load, V = two_half_load(model, w)
    path = sum(pocket_path(model, pocket[h], h) for h in range(2))
    R = 0.5 * model.p.bearing.d_m
    c, s = model.d.rivet_y / R, model.d.rivet_z / R
    load.N = load.N + path[..., PATH_N]
    if model.d.hole_gap == 0.0:  # in a hole with play, slip relieves the transverse part of the load path
        load.V_y = load.V_y + path[..., PATH_V_R] * c - path[..., PATH_V_T] * s
        load.V_z = load.V_z + path[..., PATH_V_R] * s + path[..., PATH_V_T] * c
    load.M_y = load.M_y + path[..., PATH_M_R] * c - path[..., PATH_M_T] * s
    load.M_z = load.M_z + path[..., PATH_M_R] * s + path[..., PATH_M_T] * c
    return joint_prying(model.d.table, load), V
