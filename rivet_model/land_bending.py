"""Bending of a ribbon's lands, put into the rows dP of the load path.

The joint's law (bearing_model/cage/common/joint_law.py) loads a pad by three resultants, N, M_r, M_t, as if it were
rigid.  A machined pad is; a ribbon's land is a strip of the sheet, which the ring's hoop force bends about r, and so
pries the heads off it although N and M vanish.  In direct contact (joint_contact.py) all of this is present.  Two
corrections make the law's rivets carry the direct tension T:

    centrifugal load    P_spin = s S(tau),  s = P + w,  tau = w/s,  w = spin[dP] omega^2:  exact for joints that are all
                        alike, S at equal steps of tau; spin[dP] alone is the straight line that errs least up to STRAIGHT P
    pocket forces       dP of the path changes by Delta n, so that a normal force RATIO P at a node gives the direct T

Both are homogeneous of degree 1 in (load, P), as the law is.
"""

from dataclasses import replace

import numpy as np
from scipy.optimize import brentq

from bearing_model.cage.two_half.half_path import ROWS
from bearing_model.cage.two_half.joint_open import joints_open

from . import half_loads
from .joint_contact import JointContact

DP, OUT = ROWS.index("dP"), [ROWS.index(name) for name in ("N", "M_r", "M_t")]
STEPS = 33  # of S over tau
STRAIGHT = 4.0  # preloads
RATIO = 3.0  # of the pocket force over the preload
SWEEPS, ROUNDS = 30, 6


def law_tension(half, rows, spin, P):
    """T [Z] of the rivets by the law, under bonded rows [Z, 8], of which `spin` [8] are those of the centrifugal load."""
    return joints_open(half.law, rows[:, OUT], np.maximum(P + rows[:, DP], 0.0), spin[4], P + spin[DP], SWEEPS)[1][:, 0]


def spin_tension(elastic, alone, speeds):
    """T of joints that are all alike under preload 1 N at squares of the speed [(rad/s)^2], by direct contact."""
    contact, column = JointContact(elastic, alone.rivet, alike=True), half_loads.centrifugal(elastic)
    return np.array(
        [contact.solve(1.0, (contact.loads(column=s * column)[0], np.zeros(1))).rivet[0, 0] for s in speeds]
    )


def spin_preload(half, elastic, alone):
    """Spin row [8] with its dP, and S [STEPS]."""

    # per newton of preload: the preload at which the law's tension is the direct one
    def needed(square, T):
        c = np.abs(half.spin[4]) * square / half.law.length
        return brentq(lambda P: half.law.uniform.at(c, P)[1][3] - T, 1e-6 * T, 2.0 * T + 1.0)

    far = 1e4 / np.abs(half.spin[4] / half.law.length)
    end = needed(far, spin_tension(elastic, alone, [far])[0]) / far  # N per (rad/s)^2 of open joints
    squares = np.linspace(0.0, (STRAIGHT + 1.0) / end, 60)[1:]
    preload = np.array([needed(s, T) for s, T in zip(squares, spin_tension(elastic, alone, squares), strict=True)])
    near = preload < STRAIGHT
    slopes = end * np.linspace(0.3, 1.2, 181)
    error = np.abs(1.0 + slopes[:, None] * squares[near] - preload[near]) / preload[near]
    slope = slopes[np.argmin(error.max(axis=1))]
    spin = half.spin.copy()
    spin[DP] = slope
    tau = np.linspace(0.0, 1.0, STEPS)[1:-1]
    squares = tau / (1.0 - tau) / slope
    S = [needed(s, T) * (1.0 - t) for s, T, t in zip(squares, spin_tension(elastic, alone, squares), tau, strict=True)]
    return spin, np.array([1.0, *S, end / slope])


def path(half, elastic, alone):
    """The path [radii, chi, Z, 8, 3] whose dP gives the direct tension under a normal force at each node."""
    contact, none = JointContact(elastic, alone.rivet), np.zeros(8)
    result = half.path.reshape(-1, *half.path.shape[-3:]).copy()
    normals = elastic.wall.normal(*half_loads.nodes(elastic.g).T)
    for i, n in enumerate(normals):
        place = elastic.point_places()[i]
        rigid = np.einsum("f,fk->k", n, half_loads.rigid_rows(elastic, place)[:, :, 0])
        direct = contact.solve(1.0, contact.loads([(0, i, RATIO * n)])).rivet[:, 0]
        for _ in range(ROUNDS):
            rows = RATIO * (result[i] @ n)
            rows[:, 0] += RATIO * rigid
            change = (direct - law_tension(half, rows, none, 1.0)) / RATIO
            result[i, :, DP] += change[:, None] * n
    return result.reshape(half.path.shape)


def with_bending(half, elastic, alone):
    """HalfData of a ribbon with both corrections."""
    spin, S = spin_preload(half, elastic, alone)
    return replace(half, path=path(half, elastic, alone), spin=spin, spin_preload=S)
