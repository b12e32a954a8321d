"""Joint loads after opening and slip, from the bonded loads: joints between rigid halves.  Equations in joint_law.py.

The equations of all joints are solved by sweeps (Jacobi's iteration), from the state under the centrifugal load alone,
where all joints are alike,

    delta = s d(c/s),   c: bonded M_t of the centrifugal load / l,  s = P + c            (UniformStates; linear between its knots)

If L_0 and P of a joint differ from that state by less than NEAR s, the tangent of that state gives its move.  Otherwise
the law is evaluated again for this joint if its L_0 has changed by more than CHANGE s since the last evaluation.  The
sweeps end when no joint needs the law.  A joint hardly influences others beyond its second neighbour.

In the plane a joint slips, by s along V: of the bonded V the part that friction and hole do not take is relieved
through the slip stiffness (joint_slip).
"""

import numpy as np

from bearing_model.cage.common.joint_law import NEAR, joint_law, ratio, relief
from bearing_model.numbers.lanes import absolute

SWEEPS = 6  # at most: a sweep leaves a fifth to a half of the error, and within a few per cent of s the first is right
# with it T and moments stay within 0.8 % of the fixed point's largest, by a third of the evaluations
CHANGE = 0.01
SLIP_SWEEPS = 3


def joint_size(law, load):
    """|N| + (|M_r| + |M_t|)/l of loads [..., 3] [N]."""
    return absolute(load) @ law.unit


def ask_law(law, trial, P, standing, wanted, moves, rivet):
    """Answers of the joints that are wanted [..., Z] in place of those before: by the law, or free without a rivet."""
    moves, rivet = moves.copy(), rivet.copy()
    intact = wanted & standing
    if np.any(intact):
        moves[intact], rivet[intact] = joint_law(law, trial[intact], P[intact])
    broken = wanted & ~standing
    if np.any(broken):
        moves[broken], rivet[broken] = np.linalg.solve(law.stiffness[0], trial[broken].T).T, 0.0
    return moves, rivet


def joints_open(law, bonded, P, spin_M, spin_P, sweeps=SWEEPS, intact=True):
    """Loads of joints that open, from the bonded loads.

    bonded [..., Z, 3] = (N, M_r, M_t), P [..., Z] >= 0; spin_M, spin_P [...]: bonded M_t and preload of all joints
    under the centrifugal load alone. intact [Z]: False for a joint that carries nothing, whose move takes all of L_0.
    Returns (N, M_r, M_t), (T, m_r, m_t), moves, each [..., Z, 3].
    """
    P = np.broadcast_to(P, np.shape(bonded)[:-1])
    standing = np.broadcast_to(intact, P.shape)
    load, values, slopes = law.uniform.at(absolute(np.asarray(spin_M)) / law.length, np.asarray(spin_P))
    load, values, slopes = load[..., None, :], values[..., None, :], np.swapaxes(slopes, -1, -2)
    change_P, size = P - np.asarray(spin_P)[..., None], np.real(P + joint_size(law, bonded))

    def near(trial):
        """Moves and loads of rivets by the tangent at the state where all joints are alike, and which joints are too
        far from it.
        """
        change = trial - load
        found = values + np.concatenate([change, change_P[..., None]], axis=-1) @ slopes
        far = (np.real(joint_size(law, change) + absolute(change_P)) > NEAR * size) | ~standing
        return found[..., :3], found[..., 3:], far

    trial = bonded - values[..., :3] @ law.others.sum(axis=0).T
    moves, rivet, wanted = near(trial)
    for sweep in range(sweeps):
        going = np.any(wanted, axis=-1, keepdims=True)
        if not np.any(going):
            break
        if sweep > 0:
            at = bonded - (moves.reshape(*moves.shape[:-2], -1) @ law.among.T).reshape(moves.shape)
            *found, far = near(at)
            wanted = going & far & (np.real(joint_size(law, at - trial)) > CHANGE * size)
            changed = (going & (wanted | ~far))[..., None]
            trial = np.where(changed, at, trial)
            moves, rivet = (np.where(changed, new, old) for new, old in zip(found, (moves, rivet), strict=True))
        moves, rivet = ask_law(law, trial, P, standing, wanted, moves, rivet)
    return trial - moves @ law.stiffness[0].T, rivet, moves


def joint_slip(V, K, gap, plate, head, k_head, k_hole):
    """Slip [m] of a joint that would carry V [N] bonded, and what heads and hole then carry [N]; all along V.

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
