"""Loads of the rivets.

    elastic      all loads are those of the dynamics' joints, whose halves bend (cage_elastic.py): nothing of what follows is added
    two halves   N = T - N_plate of the dynamics' joints, whose plates S, heads H and hole B carry the transverse load
    rigid cage   the wrench between the halves, (half 1 - half 0)/2 as both have the same inertia, on the circle of rivets; its transverse
                 part loads plates (up to mu T), then heads (mu T more), then the shank, T = P + dT (cage_joint_prying)

To this rigid share the elastic halves add what bonded joints would carry of pocket forces and of the cage's own
centrifugal load (half_path.py).  Joints that open and slip relieve it (joint_law.py); in the plane they have for it
what the rigid share leaves of friction and play.  The work of the added loads is that of the halves' elastic
deformation, which the dynamics of rigid halves does not have: on rigid halves the centrifugal loads of all parts
balance, so that they do no work and the energy balance has no term for them.

In a frame that turns, the centrifugal load is that of the speed in the fixed frame; a uniform field of gravity or of
the frame's acceleration acts on a half as its own acceleration does, and is in the load path's balance of forces.

The tangential inertia load of a cage whose speed changes (Euler's) is to the centrifugal one as omega_dot to omega^2:
1.3 % in a run-up to 18,238 r/min within 0.1 s, 0.013 % within 10 s, so it is left out.  What a pocket force accelerates
is in the load path: its finite elements balance the force by the half's inertia.

All loads are on the +x half, in the frames (x, r, t) of the rivets, at body angles 2 pi (k + 1/2)/Z of half 0.
"""

from dataclasses import dataclass

import numpy as np

from bearing_model.cage.common.cage_joint import cage_joint_prying
from bearing_model.cage.common.joint_law import joints_open, joints_slip
from bearing_model.cage.common.pocket import pocket_split
from bearing_model.cage.two_half.half_path import bolt_group, path_load
from bearing_model.generated.variables import CageModel
from bearing_model.numbers.lanes import ball_array_sum
from bearing_model.numbers.vec import vec_dot
from bearing_model.rivet.rivet_rom import RivetLoad


@dataclass
class JointLoads:
    """Loads of all joints [..., Z] in N and N.m."""

    N: np.ndarray  # external tension of the joint
    M_r: np.ndarray  # moment that the joint transmits
    M_t: np.ndarray
    V: np.ndarray  # modulus of its transverse load
    T: np.ndarray  # tension of the rivet, with preload and prying
    m_r: np.ndarray  # bending moment of its shank at the split
    m_t: np.ndarray
    V_r: np.ndarray  # transverse load of its shank
    V_t: np.ndarray
    F_head: np.ndarray  # modulus of the friction force at its heads

    @property
    def rivet(self):
        """What the stress table takes."""
        return RivetLoad(T=self.T, V_y=self.V_r, V_z=self.V_t, m_y=self.m_r, m_z=self.m_t, F_head=self.F_head)


@dataclass
class RigidShare:
    """What rigid halves do to the joints: external tension, transverse loads (r, t) [2, ..., Z] of plates, heads and
    shank, and what they leave.
    """

    N: np.ndarray
    plates: np.ndarray
    heads: np.ndarray
    shank: np.ndarray
    plates_left: np.ndarray  # friction that plates and heads still have [N]
    heads_left: np.ndarray
    gap_left: np.ndarray  # play [m]


def rivets_slip(model, w):
    """Slip of one half against the other at the joints, in the plane [m]."""
    return 0.0 * w.x if model.p.scene.cage == CageModel.RIGID else np.hypot(w.u[1], w.u[2])


def turned(model, v):
    """A vector (y, z) [2, ..., Z] at every rivet, radially and along the circle."""
    R = 0.5 * model.d.table.joint["d_m"]
    c, s = model.d.rivet_y / R, model.d.rivet_z / R
    return np.array([v[0] * c + v[1] * s, v[1] * c - v[0] * s])


def two_half_share(model, w):
    """RigidShare of the dynamics' joints."""
    mu, dT = model.p.joint.mu, cage_joint_prying(model, w)
    plates, heads, shank = (-turned(model, force) for force in (w.S, w.H, w.B))
    return RigidShare(
        N=w.T - w.N_plate,
        plates=plates,
        heads=heads,
        shank=shank,
        plates_left=np.maximum(mu * (w.N_plate + model.d.intact * dT) - np.hypot(*plates), 0.0),
        heads_left=np.maximum(mu * (w.T + model.d.intact * dT) - np.hypot(*heads), 0.0),
        gap_left=np.maximum(model.d.hole_gap - np.hypot(w.u[1], w.u[2]), 0.0),
    )


def rigid_wrench(model, w, pocket_F, pocket_M):
    """Wrench of pockets and lands on half 1 less that on half 0, halved, about the cage's centre in its body frame."""
    cage, other = w.half
    # a rigid cage keeps all pocket forces on half 0: the part of half 1 goes over
    F = 0.5 * (other.F - cage.F) + ball_array_sum(pocket_F[1])
    M = 0.5 * (other.M - cage.M) + ball_array_sum(pocket_M[1])
    axes = (cage.a, cage.b_y, cage.b_z)
    return [vec_dot(e, F) for e in axes] + [vec_dot(e, M) for e in axes]


def rigid_share(model, w, pocket_F, pocket_M):
    """RigidShare of a rigid cage."""
    R, friction = (
        0.5 * model.d.table.joint["d_m"],
        model.p.joint.mu * np.maximum(model.d.P_mean + cage_joint_prying(model, w), 0.0),
    )
    N, V_y, V_z = bolt_group(
        2.0 * R, rigid_wrench(model, w, pocket_F, pocket_M), model.d.rivet_y / R, model.d.rivet_z / R
    )
    force = turned(model, np.array([V_y, V_z]))
    V = np.hypot(*force)
    along = np.divide(force, V, out=np.zeros_like(force), where=V > 0.0)
    plates, heads = np.minimum(V, friction), np.clip(V - friction, 0.0, friction)
    return RigidShare(
        N=N,
        plates=plates * along,
        heads=heads * along,
        shank=np.maximum(V - 2.0 * friction, 0.0) * along,
        plates_left=friction - plates,
        heads_left=friction - heads,
        gap_left=model.d.hole_gap + 0.0 * V,
    )


def pocket_rows(model, pocket, push, h):
    """Rows [..., Z, 8] of half_path.py by the forces on the pockets of half h."""
    half, side = model.d.table.half, 2 * h - 1
    force, push = np.moveaxis(pocket, 0, -2), np.moveaxis(push, 0, -2)  # [..., 3, Z], [..., 2, Z]
    flat = [
        path_load(half, side, *at)
        for at in zip(push.reshape(-1, *push.shape[-2:]), force.reshape(-1, *force.shape[-2:]), strict=True)
    ]
    return np.array(flat).reshape(*force.shape[:-2], *np.shape(flat)[1:])


def elastic_loads(model, w):
    """JointLoads of the joints between elastic halves: the dynamics has all of them."""
    plates, heads, shank = (-turned(model, force) for force in (w.S, w.H, w.B))
    N, M_r, M_t = w.joint_load
    _, m_r, m_t = w.joint_rivet
    V, F_head = np.hypot(*(plates + heads + shank)), model.d.intact * np.hypot(*heads)
    return JointLoads(N=N, M_r=M_r, M_t=M_t, V=V, T=w.T, m_r=m_r, m_t=m_t, V_r=shank[0], V_t=shank[1], F_head=F_head)


def rivets_load(model, w):
    """JointLoads of all joints."""
    if model.p.scene.cage == CageModel.ELASTIC:
        return elastic_loads(model, w)
    d, law = model.d, model.d.table.half.law
    if model.p.scene.cage == CageModel.RIGID:
        pocket, push, pocket_F, pocket_M = pocket_split(model, w)
        share = rigid_share(model, w, pocket_F, pocket_M)
    else:
        pocket, push = w.pocket, w.pocket_push
        share = two_half_share(model, w)
    spin = 0.5 * ((w.half[0].s + w.frame_omega) ** 2 + (w.half[1].s + w.frame_omega) ** 2)[..., None] * d.spin
    rows = sum(pocket_rows(model, pocket[h], push[h], h) for h in range(2)) + spin
    N, V_r, V_t, M_r, M_t, dP, dm_r, dm_t = np.moveaxis(rows, -1, 0)

    # joints that open
    bonded, P = np.stack([share.N + N, M_r, M_t], axis=-1), d.intact * np.maximum(d.P + dP, 0.0)
    load, rivet, _ = joints_open(
        law, bonded, P, spin[..., 0, 4], np.maximum(d.P_mean + spin[..., 0, 5], 0.0), intact=d.intact > 0.0
    )

    # joints that slip
    args = share.gap_left, share.plates_left, share.heads_left, d.k_head, d.k_hole
    carried = joints_slip(law, np.stack([V_r, V_t], axis=-1), *args)[:3]
    plates, heads, shank = (
        rigid + np.moveaxis(more, -1, 0)
        for rigid, more in zip((share.plates, share.heads, share.shank), carried, strict=True)
    )
    return JointLoads(
        N=load[..., 0],
        M_r=load[..., 1],
        M_t=load[..., 2],
        V=np.hypot(*(plates + heads + shank)),
        T=rivet[..., 0],
        m_r=d.intact * (rivet[..., 1] + dm_r),
        m_t=d.intact * (rivet[..., 2] + dm_t),
        V_r=shank[0],
        V_t=shank[1],
        F_head=d.intact * np.hypot(*heads),
    )
