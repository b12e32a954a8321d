"""Law of one riveted joint that opens, for rigid and for elastic halves; rivet_model/half_loads.py makes its numbers.

Bonded, the joints of a half carry L_b = (N, M_r, M_t)_k (half_path.py: pocket forces, centrifugal load).  A joint that
opens moves, by delta = (u, phi_r, phi_t) of one pad against its bonded place, and so relieves all joints through the
half's stiffness K, a circulant matrix:

    L_k = L_b,k - sum_j K_(k-j) delta_j
    L_0,k = L_k + K_0 delta_k = L_b,k - sum_(j != k) K_(k-j) delta_j,      (delta, T, m_r, m_t)_k = law(L_0,k, P_k)

L_0 is the load that the joint would carry if it too were bonded.  The law is the contact of one pad with its rivet while
the neighbours are at rest (joint_contact.py): the law contains the compliance of the half around the joint, K that
of the rest of the half, and no compliance is counted twice.  Rigid motions of the half relieve no load, so a load that
equilibrium imposes remains.  The law is positively homogeneous of degree 1 in (L_0, P), so that with a length l

    M = |(M_r, M_t)|/l,   W = |(N, M)|,   s = P + W,   tau = W/s,   q = N/(|N| + M),   psi = M_t/(|M_t| + |M_r|)
    (u, |phi_r|, phi_t, T, |m_r|, m_t) = s S(tau, q, psi);      phi_r and m_r have the sign of M_r

S is a tensor product of quadratic B-splines, C1 in each argument.  joint_open.py solves the equations of all joints.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from bearing_model.numbers.lanes import absolute
from bearing_model.rivet.rivet_splines import cell_weights

AXES = ("tau", "q", "psi")
NUMBERS = ("u", "phi_r", "phi_t", "T", "m_r", "m_t")
CARRIED = ("N", "M_r", "M_t", "T", "m_r", "m_t")
NEAR = 0.05  # part of s over which the differences of UniformStates are taken
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
    def among(self):
        """Loads of all joints by the moves of all others [3 Z, 3 Z]."""
        Z = self.Z
        blocks = self.others[(np.arange(Z)[:, None] - np.arange(Z)) % Z]
        return blocks.transpose(0, 2, 1, 3).reshape(3 * Z, 3 * Z)

    @cached_property
    def unit(self):
        """(N, M_r, M_t) to newtons."""
        return np.array([1.0, 1.0 / self.length, 1.0 / self.length])

    @cached_property
    def uniform(self):
        """States of joints that are all alike."""
        return uniform_states(self)


@dataclass
class LawOfModes:
    """The law over L_K = L + K delta, where K is the inverse of the compliance around a joint that the vibration modes do not contain.

    K is a hundred times K_0, so that L = L_K - K delta is a small difference: the law gives L, and the moves follow from
    it.
    """

    length: float  # l [m]
    knots: dict  # AXES -> knots
    coefficients: np.ndarray  # [tau, q, psi, CARRIED], per newton
    energy: np.ndarray  # of U [tau, q, psi], whose slope over L_K is delta, per newton squared
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


def law_places(law, load, P):
    """Places of joints under loads [..., 3] = (N, M_r, M_t) and preloads [...] >= 0 in the law's table: s = P + W [N], the
    27 coefficients around each [..., 27] and the weights of their splines.
    """
    s, at = law_coordinates(law.length, load, P)
    cells, weights = zip(
        *(cell_weights(law.knots[name], value) for name, value in zip(AXES, at, strict=True)), strict=True
    )
    (_, n_q, n_psi), three = law.coefficients.shape[:3], np.arange(3)
    tau, q, psi = (cell[..., None] + three for cell in cells)
    first = ((tau[..., :, None, None] * n_q + q[..., None, :, None]) * n_psi) + psi[..., None, None, :]
    weight = weights[0][..., :, None, None] * weights[1][..., None, :, None] * weights[2][..., None, None, :]
    return s, first.reshape(*s.shape, 27), weight.reshape(*s.shape, 27)


def law_sum(coefficients, places):
    """Values [..., numbers] at places of the law, of coefficients [tau, q, psi, numbers] on its knots."""
    _, first, weight = places
    terms = weight[..., None] * coefficients.reshape(-1, coefficients.shape[-1])[first]
    result = terms[..., 0, :]
    for i in range(1, 27):
        result = result + terms[..., i, :]
    return result


def law_answer(law, places, M_r):
    """Moves (u, phi_r, phi_t) [..., 3] of the pads and loads (T, m_r, m_t) [..., 3] of the rivets at their places, M_r
    [...]: moments of the joints about r.  A LawOfModes has the joints' loads (N, M_r, M_t) in place of the moves.
    """
    result = places[0][..., None] * law_sum(law.coefficients, places)
    across = np.where(np.real(M_r) < 0.0, -1.0, 1.0)[..., None] * [0.0, 1.0, 0.0] + [1.0, 0.0, 1.0]
    return result[..., :3] * across, result[..., 3:] * across


def joint_law(law, load, P):
    """law_answer of joints under loads [..., 3] and preloads [...] >= 0."""
    load = np.asarray(load)
    return law_answer(law, law_places(law, load, np.asarray(P)), load[..., 1])


def relief(stiffness, moves):
    """sum_j K_(k-j) moves_j [..., Z, n] for a circulant K [Z, n, n]."""
    Z = len(stiffness)
    return np.einsum("kjab,...jb->...ka", stiffness[(np.arange(Z)[:, None] - np.arange(Z)) % Z], moves)


@dataclass
class UniformStates:
    """Joints under the same bonded M_t = sign c l and preload P of c + P = 1 N, at equal steps of c, and how one of
    them answers to a change.
    """

    x: np.ndarray  # c
    load: np.ndarray  # L_0 [x, 3]
    values: np.ndarray  # (u, phi_r, phi_t, T, m_r, m_t) [x, 6]
    slopes: np.ndarray  # of the values over (N, M_r, M_t, P) of one joint, differences over NEAR [x, 6, 4]

    @cached_property
    def table(self):
        """L_0, values and slopes side by side [x, 3 + 6 + 24]."""
        return np.concatenate([self.load, self.values, self.slopes.reshape(len(self.x), -1)], axis=1)

    @cached_property
    def straight_on(self):
        """`table` with one row more at both ends, on straight lines."""
        table = self.table
        return np.concatenate([[2.0 * table[0] - table[1]], table, [2.0 * table[-1] - table[-2]]])

    def at(self, c, P):
        """L_0 [..., 3], values [..., 6] and slopes [..., 6, 4] for c >= 0 and P >= 0 [...] in newtons, by Catmull-Rom
        splines: the friction of the joints has this tension, and must have no kink over the speed.
        """
        s, last = c + P, len(self.x) - 1
        x = ratio(c, s) * last
        i = np.minimum(np.real(x), last - 1.0).astype(int)
        t = (x - i)[..., None]
        before, here, there, beyond = (self.straight_on[i + n] for n in range(4))
        row = (
            0.5 * t * (t * (2.0 - t) - 1.0) * before
            + 0.5 * (t * t * (3.0 * t - 5.0) + 2.0) * here
            + 0.5 * t * (t * (4.0 - 3.0 * t) + 1.0) * there
            + 0.5 * t * t * (t - 1.0) * beyond
        )
        slopes = row[..., 9:].reshape(*np.shape(x), *self.slopes.shape[1:])
        return s[..., None] * row[..., :3], s[..., None] * row[..., 3:9], slopes


def uniform_states(law, knots=129, sweeps=400):
    """UniformStates of a law: the fixed point by plain sweeps."""
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
    return UniformStates(c, load * in_plane, values(load, P) * both, slopes)


def single_joint(law, P, N=0.0, M_r=0.0, M_t=0.0):
    """(T, m_r, m_t) of the rivet of a joint under loads of its own, its neighbours bonded: arrays of one shape, in N
    and N.m.
    """
    P, *load = np.broadcast_arrays(*(np.asarray(v, dtype=float) for v in (P, N, M_r, M_t)))
    return tuple(np.moveaxis(joint_law(law, np.stack(load, axis=-1), P)[1], -1, 0))
