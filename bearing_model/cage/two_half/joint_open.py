"""Joint loads after opening, from the bonded loads: joints between rigid halves.  Equations in joint_law.py.

The equations of all joints are solved by sweeps (Jacobi's iteration), from the state under the centrifugal load alone,
where all joints are alike,

    delta = s d(c/s),   c: bonded M_t of the centrifugal load / l,  s = P + c            (UniformStates; linear between its knots)

If L_0 and P of a joint differ from that state by less than NEAR s, the tangent of that state gives its move.  Otherwise
the law is evaluated again for this joint if its L_0 has changed by more than CHANGE s since the last evaluation.  The
sweeps end when no joint needs the law.  A joint hardly influences others beyond its second neighbour.
"""

import numpy as np

from bearing_model.cage.common.joint_law import NEAR, joint_law
from bearing_model.numbers.lanes import absolute

SWEEPS = 6  # at most: a sweep leaves a fifth to a half of the error, and within a few per cent of s the first is right
# with it T and moments stay within 0.8 % of the fixed point's largest, by a third of the evaluations
CHANGE = 0.01


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
