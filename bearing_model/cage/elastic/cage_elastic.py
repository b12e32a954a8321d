"""Elastic cage halves: vibration modes of both halves, the joints between them.

Each half vibrates in the frame that moves with it as a rigid body, by its free modes i with the coordinates q_i and the
modal mass m of the half:

    m (q_i'' + 2 zeta omega_i q_i' + omega_i^2 q_i) = sum phi_i . F,       u = sum phi_i q_i

F: forces of balls on the pockets' walls (pocket.py), loads of the joints on the pads, centrifugal load.  Half 0 is the
mirror image of half 1, so that with S = (q_1 + q_0)/sqrt 2 (mirrored) and D = (q_1 - q_0)/sqrt 2 (opposed) the pads of
one joint move against each other by

    x, phi_r, phi_t:  sqrt 2 sum phi_i S_i  (out of the plane: N, M_r, M_t)          r, t:  sqrt 2 sum phi_i D_i  (in the plane: V_r, V_t)

Modes are cyclic: at the angle theta, even components (x, r, phi_t) are a cos(n theta), odd ones (t, phi_x, phi_r) -b
sin(n theta) for the first mode of a pair and a sin(n theta), b cos(n theta) for the second.

Joint, out of the plane: with e half of the relative motion of its pads (rigid and elastic) and K the inverse of the
static compliance that the modes leave between the pads of one joint,

    L^ = K e,    (L, T, m_r, m_t) = law(L^, P)

with the joint's law over K (joint_law.py, LawBehind): its pads move by delta, L = K (e - delta).  So each joint follows
from its own pads; what the loads of other joints move them by beside the modes is left out.
In the plane, friction states and the hole's contact as in cage_joint.py, in series with what the modes leave.  Pads do
not hold each other about x.

Left out: Coriolis forces and the softening of modes by spin, of the order 2 omega_c/omega_i and (omega_c/omega_i)^2.
"""

from dataclasses import dataclass

import numpy as np

from bearing_model.cage.common.joint_law import LawBehind, joint_law, law_spline
from bearing_model.cage.elastic.half_modes import (
    OUT,
    PAD,
    coordinates,
    denser,
    frequencies,
    phases,
    rivet_shapes,
    spin_load,
)
from bearing_model.generated.variables import (
    CAGE_BETA_DOT,
    CAGE_GAMMA_DOT,
    CAGE_S,
    CAGE_V_X,
    CAGE_V_Y,
    CAGE_V_Z,
    MODE_D,
    MODE_D_DOT,
    MODE_S,
    MODE_S_DOT,
    Z,
)
from bearing_model.numbers.lanes import absolute, ball_array_sum, maximum, minimum
from bearing_model.numbers.vec import vec_cross, vec_dot

IN = [1, 2]  # of the motions (x, r, t, phi_x, phi_r, phi_t) of a pad: in the plane; OUT: out of it
ROOT = np.sqrt(2.0)
CAGE_RATES = CAGE_V_X, CAGE_V_Y, CAGE_V_Z, CAGE_BETA_DOT, CAGE_GAMMA_DOT, CAGE_S
SUBSTEP_TURN = 1.6  # angle by which the fastest vibration of closed joints turns in a substep (cage_substeps.py)
WALL_NODE = 1  # of the walls' angle: impacts meet the wall at 7 degrees in the median


@dataclass
class ElasticHalf:
    """A half's modes in a scene; n of them, without dimension, of modal mass m."""

    n: int
    omega: np.ndarray  # [n] rad/s
    damping: np.ndarray  # 2 zeta omega [n]
    alike: np.ndarray  # whether a mode moves all joints alike and does not twist them [n]
    pad: np.ndarray  # motions of the pads [n, 6, Z]
    wave: np.ndarray  # Re and Im of the wave at the pockets [n, 2, Z]
    chi: np.ndarray  # nodes of the wall's angle
    pocket: np.ndarray  # (x, r, t) by Re and Im of the wave at the nodes [chi, n, 3, 2]
    slope: np.ndarray  # its slopes
    spin: np.ndarray  # modal force per (rad/s)^2 [n]
    R: np.ndarray  # compliance that the modes leave between the pads of a joint, out of the plane [3, 3]
    series: float  # part of the friction states' stiffness that is left in series with it
    k_hole: np.ndarray  # what is left of the holes' [Z] [N/m]
    reach_2: float  # largest |u|^2 of a wall / sum omega^2 q^2 [s2] by modes that do not move all pockets alike
    widest: np.ndarray  # largest |u|/|q| by the others, else 0 [n]
    wall: float  # compliance that the modes leave at a wall, along its normal, less that in Hertz's [m/N]
    # squares of the frequencies of S and the relative rigid motions out of the plane with closed joints, rising [n + 3]
    mirrored: np.ndarray
    substep: float  # of the default method, at most [s]
    law: LawBehind


def mode_order(modes):
    """Place of each coordinate of the state among those of half_modes.py [n]: all a, those of pairs first, then all b
    likewise; its entry; 0 of a, 1 of b.
    """
    entry, part = (
        np.repeat(np.arange(len(modes.omega)), modes.count),
        coordinates(modes, 0.0 * modes.omega, 0.0 * modes.omega + 1.0),
    )
    order = np.lexsort((entry, modes.parity[entry] != 0, part))
    return order, entry[order], part[order]


def derive_elastic(p, d, table):
    """ElasticHalf of the scene."""
    if table.modes is None:
        raise ValueError("scene.cage = elastic: the rivet table has no vibration modes")
    ratio = p.cage.m / table.half.m
    modes, law = denser(table.modes, ratio), table.modes.law
    unit = np.sqrt(p.cage.m)  # the table's modes have unit modal mass
    order, entry, part = mode_order(modes)
    c, s = (f[entry] for f in phases(modes, 0.0))
    wave = np.where(part[:, None, None] == 0.0, np.stack([c, -s], axis=1), np.stack([s, c], axis=1))
    omega, residual = frequencies(modes)[order], modes.residual
    shear = 2.0 * np.mean(np.diag(residual.pad[0])[IN])  # of both halves
    pocket = unit * np.moveaxis(modes.pocket[entry], 1, 0)
    pad = unit * np.moveaxis(rivet_shapes(modes)[order][:, :, : len(PAD)], 1, 2)
    series, k_hole = 1.0 / (1.0 + shear * (d.k_plate_t + d.k_head)), d.k_hole / (1.0 + shear * d.k_hole)
    held = series * (d.k_plate_t + d.k_head) + np.max(k_hole)
    alike = (modes.harmonic[entry] == 0) & (part == 0.0)
    # [chi, n], at the nodes; between them a quarter farther at most
    u_2 = np.sum(pocket[:, :, [0, 2]] ** 2, axis=(2, 3))
    mirrored = frequencies_2(
        p.cage.m,
        omega,
        joints_out(d, pad),
        0.5 * np.kron(np.eye(Z), law.stiffness),
        (0.5 * p.cage.m, 0.5 * d.J_t, 0.5 * d.J_t),
    )
    opposed = frequencies_2(
        p.cage.m, omega, joints_in(d, pad), np.eye(2 * Z) * held, (0.5 * p.cage.m, 0.5 * p.cage.m, 0.5 * d.J_p)
    )
    return ElasticHalf(
        n=len(omega),
        omega=omega,
        alike=alike,
        damping=2.0 * p.cage.modal_damping * omega,
        pad=pad,
        wave=wave,
        chi=table.half.chi,
        pocket=pocket,
        slope=unit * np.moveaxis(modes.slope[entry], 1, 0),
        spin=d.centrifugal * unit * spin_load(modes)[order],
        reach_2=1.5625
        * np.max(np.sum(np.where(alike, 0.0, np.where(modes.parity[entry] == 0, 0.5, 1.0) * u_2 / omega**2), axis=1)),
        widest=np.where(alike, 1.25 * np.sqrt(np.max(u_2, axis=0)), 0.0),
        R=np.linalg.inv(law.stiffness),
        series=series,
        k_hole=k_hole,
        wall=residual.wall[WALL_NODE],
        mirrored=mirrored,
        substep=SUBSTEP_TURN / np.sqrt(max(mirrored[-1], opposed[-1])),
        law=law,
    )


def frequencies_2(m, omega, motions, stiffness, rigid):
    """Squares of the frequencies with closed joints, rising.

    motions [joints' motions, n + 3] by unit coordinates; rigid: inertia of the three rigid motions.
    """
    K = motions.T @ stiffness @ motions + np.diag(np.append(m * omega**2, np.zeros(3)))
    root = np.sqrt(np.append(np.full(len(omega), m), rigid))
    return np.linalg.eigvalsh(K / np.outer(root, root))


def circle(d):
    """Pitch radius of the rivets, cosine and sine of their angles."""
    R = 0.5 * d.table.joint["d_m"]
    return R, d.rivet_y / R, d.rivet_z / R


def joints_out(d, pad):
    """Relative motions (x, about r, about t) of all joints [3 Z, n + 3] by S, v_x and rotations about y and z."""
    R, c, s = circle(d)
    rigid = np.array([[1.0 + 0.0 * c, 0.0 * c, 0.0 * c], [R * s, c, -s], [-R * c, s, c]])
    return np.concatenate([ROOT * pad[:, OUT], rigid]).transpose(2, 1, 0).reshape(3 * Z, -1)


def joints_in(d, pad):
    """Relative motions (r, t) of all joints [2 Z, n + 3] by D, v_y, v_z and the spin."""
    R, c, s = circle(d)
    rigid = np.array([[c, -s], [s, c], [0.0 * c, R + 0.0 * c]])
    return np.concatenate([ROOT * pad[:, IN], rigid]).transpose(2, 1, 0).reshape(2 * Z, -1)


# ------------------------------------------------------------------------------------------------- walls of the pockets


def cage_elastic_shapes(half, side, n_x, n_t):
    """Motions (x, r, t) [3, ..., Z, n] of the walls by all modes where the contacts are, and their slopes over the
    wall's angle.
    """
    chi = maximum(np.arctan(side * n_x / maximum(absolute(n_t), 1e-30)), 0.0)
    i = np.clip(np.searchsorted(half.chi, np.real(chi), side="right") - 1, 0, len(half.chi) - 2)
    h = half.chi[i + 1] - half.chi[i]
    u = (chi - half.chi[i]) / h
    v = 1.0 - u
    terms = half.pocket[i], half.slope[i], half.pocket[i + 1], half.slope[i + 1]  # [..., Z, n, 3, 2]
    value = v * v * (1.0 + 2.0 * u), h * u * v * v, u * u * (1.0 + 2.0 * v), -h * u * u * v
    slope = -6.0 * u * v / h, v * (v - 2.0 * u), 6.0 * u * v / h, u * (u - 2.0 * v)
    back = np.where(np.real(n_t) < 0.0, -1.0, 1.0)[..., None, None, None] * np.array(
        [[0.0, 1.0], [0.0, 1.0], [1.0, 0.0]]
    ) + [
        [1.0, 0.0],
        [1.0, 0.0],
        [0.0, 1.0],
    ]
    wave = np.moveaxis(half.wave, 2, 0)[:, :, None, :]  # [Z, n, 1, 2]

    def shapes(weights):
        A = sum(w[..., None, None, None] * term for w, term in zip(weights, terms, strict=True))
        return np.moveaxis(np.sum(A * back * wave, axis=-1), -1, 0) * np.array([side, 1.0, 1.0]).reshape(
            -1, *[1] * (A.ndim - 2)
        )

    on_wall = np.real(side * n_x) > 0.0
    return shapes(value), shapes(slope) * on_wall[..., None]


def cage_elastic_coordinates(model, y, h):
    """Modal coordinates of half h and their rates [..., 1, n]."""
    n, sign = model.d.elastic.n, 1.0 if h == 1 else -1.0
    S, D, S_dot, D_dot = (y[..., None, block][..., :n] for block in (MODE_S, MODE_D, MODE_S_DOT, MODE_D_DOT))
    return (S + sign * D) / ROOT, (S_dot + sign * D_dot) / ROOT


def cage_elastic_walls(model, w, h, n_x, n_t, S, delta):
    """Motion and velocity (x, r, t) [3, ..., Z] of the walls of half h along the ball's pocket axes; slope of n.u
    across n; the modes' shapes there.
    """
    shape, shape_chi = cage_elastic_shapes(model.d.elastic, 2 * h - 1, n_x, n_t)
    q, q_dot = w.modes[h]
    near = np.real(delta) + w.reach[h] > 0.0  # others cannot have been reached
    u, u_dot, u_chi = (np.sum(a * b, axis=-1) * near for a, b in ((shape, q), (shape, q_dot), (shape_chi, q)))
    turn = (2 * h - 1) * np.where(np.real(n_t) < 0.0, -1.0, 1.0)
    slope = (n_t * u[0] - n_x * u[2] + turn * (n_x * u_chi[0] + n_t * u_chi[2])) / S
    return u, u_dot, slope, shape


def cage_elastic_approach(d, share, delta):
    """Approach [..., Z] of ball and wall without what the compliance c of the wall takes: delta_h + c w K delta_h^1.5 =
    delta, Newton's method.

    share: function of the approach that gives the part w of the load.
    """
    c = d.elastic.wall * d.pocket.K
    own = maximum(delta, 0.0)
    for _ in range(4):
        root = np.sqrt(np.where(np.real(own) > 0.0, own, 1e-30))
        load = maximum(c * share(own) * root, -0.3)
        own = maximum(own - (own + load * own - delta) / (1.0 + 1.5 * load), 0.0)
    return np.where(np.real(delta) > 0.0, own, delta)


# --------------------------------------------------------------------------------------------------------------- joints


def cage_elastic_kinematics(model, y, w):
    """Motions of the halves' modes, of the pads against each other: elastic part, out of the plane (x, phi_r, phi_t)
    and in it (r, t).
    """
    half = model.d.elastic
    w.modes = [cage_elastic_coordinates(model, y, h) for h in range(2)]
    others = np.where(half.alike, 0.0, half.omega)
    places = [np.real(q) for q, _ in w.modes]
    w.reach = [
        np.sqrt(half.reach_2 * np.sum((others * q) ** 2, axis=-1)) + np.sum(half.widest * np.abs(q), axis=-1)
        for q in places
    ]
    w.more_J = [2.0 * np.sum(half.spin * q, axis=-1) for q, _ in w.modes]
    S, D, S_dot, D_dot = (ROOT * y[..., block][..., : half.n] for block in (MODE_S, MODE_D, MODE_S_DOT, MODE_D_DOT))
    w.pad_out, w.pad_out_dot = (np.einsum("...i,ikz->k...z", q, half.pad[:, OUT]) for q in (S, S_dot))
    w.pad_in, w.pad_in_dot = (np.einsum("...i,ikz->k...z", q, half.pad[:, IN]) for q in (D, D_dot))


def cage_elastic_pads(model, w):
    """Adds the modes to offset and velocity of the joints (cage_joint_kinematics); sets e [3, ..., Z], half the
    relative motion out of the plane.
    """
    d, (h0, h1) = model.d, w.half
    R = 0.5 * d.table.joint["d_m"]
    c, s = d.rivet_y / R, d.rivet_z / R
    w.turn_y, w.turn_z = -vec_dot(h0.b_z, h1.a), vec_dot(h0.b_y, h1.a)  # small rotation of half 1 against half 0
    e = np.array([w.u[0], w.turn_y * c + w.turn_z * s, w.turn_z * c - w.turn_y * s])
    w.e = 0.5 * (e + w.pad_out)
    w.u, w.v_j = w.u.copy(), w.v_j.copy()
    w.u_rigid = w.u.copy()
    for total, (r, t) in ((w.u, w.pad_in), (w.v_j, w.pad_in_dot)):
        total[1] += c * r - s * t
        total[2] += s * r + c * t


def broken_answer(K, behind):
    """Loads (N, M_r, M_t) [..., 3] of joints without a rivet at L^ = behind: the pads press on each other in their
    middles or carry nothing.
    """
    N = minimum(behind[..., 0] - behind[..., 1:] @ np.linalg.solve(K[1:, 1:], K[1:, 0]), 0.0)
    return N[..., None] * [1.0, 0.0, 0.0]


def cage_elastic_law(model, e, P):
    """Loads L (N, M_r, M_t) of the joints, loads of the rivets (T, m_r, m_t), [3, ..., Z], energy of one half [..., Z],
    for motions e [3, ..., Z].

    P: preloads with what the centrifugal load adds [..., Z].
    """
    d, half, law = model.d, model.d.elastic, model.d.elastic.law
    e = np.moveaxis(e, 0, -1)
    behind = e @ law.stiffness.T
    load, rivet = joint_law(law, behind, P)
    broken = broken_answer(law.stiffness, behind)
    s = P + np.sqrt(behind[..., 0] ** 2 + (behind[..., 1] ** 2 + behind[..., 2] ** 2) / law.length**2)
    V = 0.5 * np.sum(e * behind, axis=-1) - s**2 * spline_value(law, law.energy, behind, P)
    V = np.where(d.intact > 0.0, V, 0.5 * np.sum(broken * (broken @ half.R.T), axis=-1))
    load = np.where(d.intact[:, None] > 0.0, load, broken)
    return np.moveaxis(load, -1, 0), np.moveaxis(d.intact[:, None] * rivet, -1, 0), V


def spline_value(law, coefficients, load, P):
    """The tensor product of splines of the law's knots at loads [..., 3] and preloads [...]."""
    return law_spline(law, coefficients[..., None], load, P)[1][..., 0]


def cage_elastic_speed_2(w):
    """Square of the halves' speed in space, mean of both."""
    h0, h1 = w.half
    return 0.5 * ((h0.s + w.frame_omega) ** 2 + (h1.s + w.frame_omega) ** 2)


def cage_elastic_joints(model, y, w):
    """Loads of the joints out of the plane; sets what rivets and plates carry, adds the moments to both halves.
    cage_joint_force needs T and N_plate.
    """
    d, (h0, h1) = model.d, w.half
    omega_2 = cage_elastic_speed_2(w)
    P = maximum(d.P + d.spin[5] * omega_2, 0.0) + 0.0 * w.e[0]
    w.joint_load, w.joint_rivet, V = cage_elastic_law(model, w.e, P)
    w.joint_potential = 2.0 * V
    w.T = maximum(w.joint_rivet[0], 0.0)
    w.N_plate = maximum(w.T - w.joint_load[0], 0.0)

    # moments on half 1, whose power is that of the rates of turn_y and turn_z
    R = 0.5 * d.table.joint["d_m"]
    c, s = d.rivet_y / R, d.rivet_z / R
    _, M_r, M_t = w.joint_load
    M_y, M_z = ball_array_sum(M_r * c - M_t * s), ball_array_sum(M_r * s + M_t * c)
    moment = M_y * vec_cross(h1.a, h0.b_z) - M_z * vec_cross(h1.a, h0.b_y)
    h0.M, h1.M = h0.M - moment, h1.M + moment


def cage_elastic_coriolis(model, w, h):
    """Moment [N.m] about the axis of half h that its widening needs; w.more_J: moment of inertia that its modes add, 2
    spin . q.
    """
    _, q_dot = w.modes[h]
    spin = model.d.elastic.spin
    return 2.0 * np.sum(spin * q_dot, axis=-1) * (w.half[h].s + w.frame_omega)


def cage_elastic_acceleration(model, y, w, y_dot):
    """Rates of the modal coordinates."""
    half, d, p = model.d.elastic, model.d, model.p
    R = 0.5 * d.table.joint["d_m"]
    c, s = d.rivet_y / R, d.rivet_z / R
    _, F_y, F_z = w.joint_force  # on half 1, in the frame of half 0
    across = np.stack([c * F_y + s * F_z, c * F_z - s * F_y])
    mirrored = -ROOT * np.einsum("k...z,ikz->...i", w.joint_load, half.pad[:, OUT])
    opposed = ROOT * np.einsum("k...z,ikz->...i", across, half.pad[:, IN])
    f0, f1 = (np.sum(w.pocket_modal[h], axis=-2) + (w.half[h].s + w.frame_omega) ** 2 * half.spin for h in range(2))
    w.modes_dissipated = 0.0
    for q, rate, force in (
        (MODE_S, MODE_S_DOT, mirrored + (f1 + f0) / ROOT),
        (MODE_D, MODE_D_DOT, opposed + (f1 - f0) / ROOT),
    ):
        x, v = y[..., q][..., : half.n], y[..., rate][..., : half.n]
        y_dot[..., q][..., : half.n] = v
        y_dot[..., rate][..., : half.n] = force / p.cage.m - half.damping * v - half.omega**2 * x
        w.modes_dissipated = w.modes_dissipated + p.cage.m * np.sum(half.damping * v * v, axis=-1, keepdims=True)


def find_rest(half, m, omega_2, P):
    """Coordinates S [n] and (u_x, M_t) of the rest under the centrifugal load of the speed's square omega_2 [rad2/s2]
    and the preload P.

    All joints are alike: N = 0, and their M_t balances S_i = sqrt 2 (spin_i omega^2 - Z phi_t,i M_t)/(m omega_i^2).
    Newton's method with differences for the halves' distance u_x and M_t.
    """
    at = half.pad[:, OUT, 0]  # x, phi_r, phi_t

    def off(x):
        S = ROOT * (half.spin * omega_2 - np.where(half.alike, Z * at[:, 2] * x[1], 0.0)) / (m * half.omega**2)
        e = 0.5 * x[0] * np.array([1.0, 0.0, 0.0]) + S @ at / ROOT * [1.0, 0.0, 1.0]
        N, _, M_t = joint_law(half.law, e @ half.law.stiffness.T, P)[0]
        return np.array([N, (M_t - x[1]) / half.law.length]), S

    x = np.zeros(2)
    for _ in range(60):
        rest, S = off(x)
        if np.max(np.abs(rest)) < 1e-11:
            break
        slope = np.stack([(off(x + step)[0] - rest) / step.sum() for step in np.diag([1e-10, 1e-7])], axis=-1)
        x = x - np.linalg.solve(slope, rest)
    return S, x


def cage_elastic_rest(model, omega):
    """Coordinates S [n] and distance of the halves' bodies [m] at which modes and joints rest under the centrifugal
    load of the speed omega [rad/s].
    """
    d = model.d
    S, x = find_rest(d.elastic, model.p.cage.m, omega**2, max(d.P_mean + d.spin[5] * omega**2, 0.0))
    return S, x[0]


def cage_elastic_energy(model, y, w):
    """Kinetic and elastic energy of the modes [J], [..., 1], with that of the spin in the moment of inertia that they
    add.
    """
    half = model.d.elastic
    n = half.n
    rates = y[..., MODE_S_DOT][..., :n] ** 2 + y[..., MODE_D_DOT][..., :n] ** 2
    places = half.omega**2 * (y[..., MODE_S][..., :n] ** 2 + y[..., MODE_D][..., :n] ** 2)
    spin = sum(0.5 * J * (half.s**2 - w.frame_omega**2) for J, half in zip(w.more_J, w.half, strict=True))
    return 0.5 * model.p.cage.m * np.sum(rates + places, axis=-1, keepdims=True) + spin
