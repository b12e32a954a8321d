"""Loads of the joints in the plane of the split beside those of the motion: the load path gives the loads of bonded joints
between halves that bend.

A joint slips, by s along V: of the bonded V the part that friction and hole do not take is relieved through the slip
stiffness of the halves (joint_slip).  Friction and play are those that the motion leaves over.
"""

import numpy as np

from bearing_model.cage.common.joint_law import ratio, relief

SLIP_SWEEPS = 3


def joint_slip(V, K, gap, plate, head, k_head, k_hole):
    """Slip [m] of a joint whose bonded load is V [N], and the loads of heads and hole that result [N]; all along V.

    K: slip stiffness of the halves around this joint.  Plates hold up to `plate`, then the heads drag the rivet
    (k_head) up to `head`, then the halves slip freely to `gap`, then the hole bears (k_hole): V - K slip = plate +
    min(k_head slip, head) + k_hole max(0, slip - gap).
    """
    beyond = V - plate
    free = np.maximum(beyond / (K + k_head), (beyond - head) / K)
    bears = np.maximum((beyond + k_hole * gap) / (K + k_head + k_hole), (beyond - head + k_hole * gap) / (K + k_hole))
    slip = np.maximum(np.where(free <= gap, free, bears), 0.0)
    return slip, np.minimum(k_head * slip, head), k_hole * np.maximum(slip - gap, 0.0)


def joints_slip(law, bonded, gap, plate, head, k_head, k_hole, sweeps=SLIP_SWEEPS):
    """(V_r, V_t) of plates, heads and holes, and the slip, each [..., Z, 2], of joints that would carry `bonded` [...,
    Z, 2].
    """
    others = law.slip_stiffness.copy()
    others[0] = 0.0
    K_0 = law.slip_stiffness[0]
    slip = np.zeros_like(bonded)
    for _ in range(sweeps):
        trial = bonded - relief(others, slip)
        V = np.hypot(trial[..., 0], trial[..., 1])
        e = ratio(trial, V[..., None])
        K = np.einsum("...a,ab,...b->...", e, K_0, e) + np.where(V > 0.0, 0.0, K_0[0, 0])
        along, H, B = joint_slip(V, K, gap, plate, head, k_head, k_hole)
        slip = along[..., None] * e
    total = trial - slip @ K_0.T
    H, B = H[..., None] * e, B[..., None] * e
    return total - H - B, H, B, slip


def joint_slip_add(model, w, u, T, N_plate, V, shear):
    """Adds to the JointShear the loads of plates, heads and shanks by the bonded loads V [2, ..., Z].

    u: offset (y, z) of the pads [2, ..., Z]; T, N_plate [..., Z]: tension of the rivets, force between the plates.
    """
    d, mu = model.d, model.p.joint.mu
    plates, heads = (np.maximum(mu * load - np.hypot(*on), 0.0) for load, on in ((N_plate, w.S), (T, w.H)))
    gap = np.maximum(d.hole_gap - np.hypot(*u), 0.0)
    more = joints_slip(d.table.half.law, np.moveaxis(V, 0, -1), gap, plates, heads, d.k_head, d.k_hole)[:3]
    for name, loads in zip(("plates", "heads", "shank"), more, strict=True):
        setattr(shear, name, getattr(shear, name) + np.moveaxis(loads, -1, 0))
