"""Law of one riveted joint, and what it leaves of the loads that bonded joints would carry; rivet_model/half_loads.py
makes its numbers.

Bonded, the joints of a half carry L_b = (N, M_r, M_t)_k (half_path.py: pocket forces, centrifugal load).  A joint that
opens moves, by delta = (u, phi_r, phi_t) of one pad against its bonded place, and is relieved through the half's
stiffness K, a circulant matrix:

    L_k = L_b,k - sum_j K_(k-j) delta_j                         K: moves of all pads -> loads; rigid motions of the half relieve nothing
    (delta, T, m_r, m_t)_k = law(L*_k, P_k),   L*_k = L_k + K_0 delta_k = L_b,k - sum_(j != k) K_(k-j) delta_j

The law is the contact of one pad whose neighbours are held (joint_contact.py): L* is what the joint would carry if it
too were bonded.  So the compliance of the half around the joint is in the law, that of the rest in K, and nothing is in
both.  Loads that equilibrium imposes are those that no move relieves: K has no stiffness there.  The law is positively
homogeneous of degree 1 in (L*, P), so with the length l

    M = |(M_r, M_t)|/l,   W = |(N, M)|,   s = P + W,   tau = W/s,   q = N/(|N| + M),   psi = M_t/(|M_t| + |M_r|)
    (u, |phi_r|, phi_t, T, |m_r|, m_t) = s S(tau, q, psi),   S: tensor product of quadratic B-splines; phi_r and m_r have the sign of M_r

Fixed point: plain sweeps over all joints, from the state under the centrifugal load alone, where all joints are alike,

    delta = s d(c/s),   c: bonded M_t of the centrifugal load / l,  s = P + |c|            (alike_states; linear between its knots)

Joints whose L* and P are within NEAR s of that state answer by its tangent, the others by the law if their L* has
changed by more than CHANGE s since they were last found; the sweeps end when there are none.  A joint is hardly felt
beyond its second neighbour.

In the plane, joints slip instead: V_b relieved through the slip stiffness, joint_slip below.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from bearing_model.numbers.lanes import absolute
from bearing_model.rivet.rivet_splines import cell_weights

AXES = ("tau", "q", "psi")
NUMBERS = ("u", "phi_r", "phi_t", "T", "m_r", "m_t")
CARRIED = ("N", "M_r", "M_t", "T", "m_r", "m_t")
SWEEPS = 6  # at most: a sweep leaves a fifth to a half of the error, and within a few per cent of s the first is right
# with it and CHANGE = 0.01, T and moments stay within 0.8 % of the fixed point's largest, by a third of the evaluations
NEAR = 0.05
CHANGE = 0.01
SLIP_SWEEPS = 3
FELT = 0.005  # part of K_0 below which the stiffness between two joints is dropped


@dataclass
class JointLaw:
    """Numbers of the law of one geometry."""

    length: float  # l [m]
    knots: dict  # AXES -> knots
    coefficients: np.ndarray  # [tau, q, psi, NUMBERS], per newton
    # K [Z, 3, 3]: load on the joint k pitches farther per move (u, phi_r, phi_t); N/m, N/rad, N.m/rad
    stiffness: np.ndarray
    # [Z, 2, 2]: (V_r, V_t) of the joint k pitches farther per slip of one half against the other [N/m]
    slip_stiffness: np.ndarray
    sign: float = -1.0  # of M_t under the centrifugal load

    @property
    def Z(self):
        return len(self.stiffness)

    @cached_property
    def reach(self):
        """Pitches over which joints are felt."""
        own = np.sqrt(np.diag(self.stiffness[0]))
        felt = np.abs(self.stiffness / np.outer(own, own)).max(axis=(1, 2)) > FELT
        return max(min(k, self.Z - k) for k in np.flatnonzero(felt))

    @cached_property
    def others(self):
        """K without K_0 and beyond its reach."""
        distance = np.minimum(np.arange(self.Z), self.Z - np.arange(self.Z))
        return np.where(((distance > 0) & (distance <= self.reach))[:, None, None], self.stiffness, 0.0)

    @cached_property
    def unit(self):
        """(N, M_r, M_t) to newtons."""
        return np.array([1.0, 1.0 / self.length, 1.0 / self.length])

    @cached_property
    def alike(self):
        """States of joints that are all alike."""
        return alike_states(self)


@dataclass
class LawBehind:
    """The law over L^ = L + K delta, where K is what vibration modes leave of the stiffness around a joint.

    K is a hundred times K_0, so that L = L^ - K delta is a small difference: the law gives L, and the moves follow from
    it.
    """

    length: float  # l [m]
    knots: dict  # AXES -> knots
    coefficients: np.ndarray  # [tau, q, psi, CARRIED], per newton
    energy: np.ndarray  # of U [tau, q, psi], whose slope over L^ is delta, per newton squared
    stiffness: np.ndarray  # K [3, 3] of (u, phi_r, phi_t); N/m, N/rad, N.m/rad


def ratio(top, bottom):
    """top/bottom, 0 where bottom is 0."""
    out = np.zeros(np.broadcast(top, bottom).shape, dtype=np.result_type(top, bottom, float))
    return np.divide(top, bottom, out=out, where=np.real(bottom) > 0.0)


def modulus(x, y):
    """sqrt(x^2 + y^2), also of numbers that carry a derivative."""
    return np.sqrt(x * x + y * y) if np.iscomplexobj(x) or np.iscomplexobj(y) else np.hypot(x, y)


def law_coordinates(length, load, P):
    """s and (tau, q, psi) of loads [..., 3] = (N, M_r, M_t) and preloads [...]."""
    N, M_r, M_t = np.moveaxis(load, -1, 0)
    M = modulus(M_r, M_t) / length
    W = modulus(N, M)
    s = P + W
    return s, (ratio(W, s), ratio(N, absolute(N) + M), ratio(M_t, absolute(M_t) + absolute(M_r)))


def law_load(length, tau, q, psi):
    """(N, M_r, M_t), P of s = 1 N at the coordinates, M_r >= 0: the inverse of law_coordinates."""
    m = 1.0 - abs(q)
    a, b = 1.0 - abs(psi), psi
    W, M = tau / np.hypot(q, m), length / np.hypot(a, b)
    return np.array([W * q, W * m * M * a, W * m * M * b]), 1.0 - tau


def joint_law(law, load, P):
    """Moves (u, phi_r, phi_t) [..., 3] of the pad and loads (T, m_r, m_t) [..., 3] of the rivet, under loads [..., 3]
    and preloads [...] >= 0.

    A LawBehind gives the joint's loads (N, M_r, M_t) in place of the moves.
    """
    s, result = law_spline(law, law.coefficients, np.asarray(load), np.asarray(P))
    result = result * s[..., None]
    side = np.where(np.real(load)[..., 1] < 0.0, -1.0, 1.0)[..., None] * [0.0, 1.0, 0.0] + [1.0, 0.0, 1.0]
    return result[..., :3] * side, result[..., 3:] * side


def law_spline(law, coefficients, load, P):
    """s = P + W [N] and the values [..., numbers] of splines with some coefficients [tau, q, psi, numbers] of the law's
    knots, under loads and preloads.
    """
    s, at = law_coordinates(law.length, load, P)
    first, weight = zip(
        *(cell_weights(law.knots[name], value) for name, value in zip(AXES, at, strict=True)), strict=True
    )
    result = 0.0
    for i in range(3):
        for j in range(3):
            for k in range(3):
                w = weight[0][..., i] * weight[1][..., j] * weight[2][..., k]
                result = result + w[..., None] * coefficients[first[0] + i, first[1] + j, first[2] + k]
    return s, result


def relief(stiffness, moves):
    """sum_j K_(k-j) moves_j [..., Z, n] for a circulant K [Z, n, n]."""
    Z = len(stiffness)
    return np.einsum("kjab,...jb->...ka", stiffness[(np.arange(Z)[:, None] - np.arange(Z)) % Z], moves)


@dataclass
class AlikeStates:
    """Joints under the same bonded M_t = sign c l and preload P of c + P = 1 N, at equal steps of c, and how one of
    them answers to a change.
    """

    x: np.ndarray  # c
    load: np.ndarray  # L* [x, 3]
    values: np.ndarray  # (u, phi_r, phi_t, T, m_r, m_t) [x, 6]
    slopes: np.ndarray  # of the values over (N, M_r, M_t, P) of one joint, differences over NEAR [x, 6, 4]

    def at(self, c, P):
        """L* [..., 3], values [..., 6] and slopes [..., 6, 4] for c >= 0 and P >= 0 [...] in newtons."""
        s = c + P
        x = ratio(c, s)

        def between(columns):
            return np.stack([np.interp(x, self.x, column) for column in columns.reshape(len(self.x), -1).T], axis=-1)

        return (
            s[..., None] * between(self.load),
            s[..., None] * between(self.values),
            between(self.slopes).reshape(*np.shape(x), *self.slopes.shape[1:]),
        )


def alike_states(law, knots=129, sweeps=400):
    """AlikeStates of a law: the fixed point by plain sweeps."""
    c = np.linspace(0.0, 1.0, knots)
    P, bonded, move = 1.0 - c, np.outer(c, [0.0, 0.0, law.sign * law.length]), np.zeros((knots, 3))
    in_plane = np.array([1.0, 0.0, 1.0])  # by symmetry no move and no load about r, unless by M_r
    for _ in range(sweeps):
        load = bonded - move @ law.others.sum(axis=0).T
        move = joint_law(law, load, P)[0] * in_plane

    def values(load, P):
        return np.concatenate(joint_law(law, load, P), axis=-1)

    slopes = np.zeros((knots, 6, 4))
    for i in range(3):
        step = NEAR / law.unit[i] * np.eye(3)[i]
        slopes[:, :, i] = (values(load + step, P) - values(load - step, P)) / (2.0 * step[i])
    less = np.minimum(P, NEAR)
    slopes[:, :, 3] = (values(load, P + NEAR) - values(load, P - less)) / (NEAR + less)[:, None]
    both = np.tile(in_plane, 2)
    slopes *= np.stack([both, 1.0 - both, both, both], axis=-1)
    return AlikeStates(c, load * in_plane, values(load, P) * both, slopes)


def joints_open(law, bonded, P, spin_M, spin_P, sweeps=SWEEPS, intact=True):
    """What joints that open leave of the bonded loads.

    bonded [..., Z, 3] = (N, M_r, M_t), P [..., Z] >= 0; spin_M, spin_P [...]: bonded M_t and preload of all joints
    under the centrifugal load alone. intact [Z]: False for a joint that carries nothing, whose move takes all of L*.
    Returns (N, M_r, M_t), (T, m_r, m_t), moves, each [..., Z, 3].
    """
    standing = np.broadcast_to(intact, law.Z)
    load, values, slopes = law.alike.at(np.abs(spin_M) / law.length, spin_P)
    change_P, size = P - np.asarray(spin_P)[..., None], P + np.abs(bonded) @ law.unit

    def near(at):
        """Moves and loads of rivets by the tangent at the state where all joints are alike, and which joints are too
        far from it.
        """
        change = at - load[..., None, :]
        found = values[..., None, :] + np.einsum(
            "...ij,...kj->...ki", slopes, np.concatenate([change, change_P[..., None]], axis=-1)
        )
        far = (np.abs(change) @ law.unit + np.abs(change_P) > NEAR * size) | ~standing
        return found[..., :3], found[..., 3:], far[..., None]

    alone = bonded - (values[..., :3] @ law.others.sum(axis=0).T)[..., None, :]
    moves, rivet, wanted = near(alone)
    going = np.any(wanted, axis=-2, keepdims=True)
    for sweep in range(sweeps):
        found = joint_law(law, alone, P)
        if not np.all(standing):
            free = np.linalg.solve(law.stiffness[0], alone[..., None])[..., 0]
            found = np.where(standing[:, None], found[0], free), np.where(standing[:, None], found[1], 0.0)
        moves, rivet = np.where(wanted, found[0], moves), np.where(wanted, found[1], rivet)
        if sweep == sweeps - 1 or not np.any(going):
            break
        at = bonded - relief(law.others, moves)
        *found, far = near(at)
        wanted = going & far & (np.abs(at - alone) @ law.unit > CHANGE * size)[..., None]
        changed = going & (wanted | ~far)
        alone, going = np.where(changed, at, alone), np.any(wanted, axis=-2, keepdims=True)
        answered = changed & ~wanted
        moves, rivet = np.where(answered, found[0], moves), np.where(answered, found[1], rivet)
    return alone - moves @ law.stiffness[0].T, rivet, moves


def single_joint(law, P, N=0.0, M_r=0.0, M_t=0.0):
    """(T, m_r, m_t) of the rivet of a joint under loads of its own, its neighbours bonded: arrays of one shape, in N
    and N.m.
    """
    P, *load = np.broadcast_arrays(*(np.asarray(v, dtype=float) for v in (P, N, M_r, M_t)))
    return tuple(np.moveaxis(joint_law(law, np.stack(load, axis=-1), P)[1], -1, 0))


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
        alone = bonded - relief(others, slip)
        V = np.hypot(alone[..., 0], alone[..., 1])
        e = ratio(alone, V[..., None])
        K = np.einsum("...a,ab,...b->...", e, K_0, e) + np.where(V > 0.0, 0.0, K_0[0, 0])
        along, H, B = joint_slip(V, K, gap, plate, head, k_head, k_hole)
        slip = along[..., None] * e
    total = alone - slip @ K_0.T
    H, B = H[..., None] * e, B[..., None] * e
    return total - H - B, H, B, slip
