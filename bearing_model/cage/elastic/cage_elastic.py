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
static compliance between the pads of one joint that the modes do not contain,

    L_K = K e,    (L, T, m_r, m_t) = law(L_K, P)

with the joint's law over K (joint_law.py, LawOfModes): its pads move by delta, L = K (e - delta).  So each joint follows
from its own pads; the motion by the loads of other joints, beside the modes, is left out.
In the plane, friction states and the hole's contact as in cage_joint.py, in series with that compliance.  Pads do
not hold each other about x.  The films of the lands load the rivets statically (elastic_lands.py).

The centrifugal load widens a half: its moment of inertia is J_p + 2 sum c_i q_i, and an expanding half slows down.
Left out: Coriolis forces and the softening of modes by spin, of the order 2 omega_c/omega_i and (omega_c/omega_i)^2.
"""

from types import SimpleNamespace

import numpy as np

from bearing_model.cage.common.cage_joint import (
    JointMotion,
    JointStiffness,
    cage_joint_carried,
    cage_joint_force,
    cage_joint_loads,
)
from bearing_model.cage.common.joint_law import law_answer, law_places, law_sum
from bearing_model.cage.common.spin_preload import spin_bending
from bearing_model.cage.elastic.elastic_half import IN, ROOT, circle
from bearing_model.cage.elastic.elastic_lands import elastic_lands
from bearing_model.cage.elastic.half_modes import OUT
from bearing_model.generated.variables import MODE_D, MODE_D_DOT, MODE_S, MODE_S_DOT
from bearing_model.numbers.lanes import ball_array_sum, maximum, minimum
from bearing_model.numbers.vec import vec_cross, vec_dot

ROW_DP = 5


def cage_elastic_stiffness(model):
    """Stiffnesses in the plane, in series with the residual of the modes."""
    half, d = model.modes, model.d
    return JointStiffness(half.series * d.k_plate_t, d.k_head, half.k_hole)


def cage_elastic_out(half, S):
    """Motions (x, about r, about t) [3, ..., Z] of all pads against each other by coordinates S [..., n]."""
    return ROOT * np.einsum("...i,ikz->k...z", S, half.pad[:, OUT])


def cage_elastic_in(half, D):
    """Motions (r, t) [2, ..., Z] of all pads against each other by coordinates D [..., n]."""
    return ROOT * np.einsum("...i,ikz->k...z", D, half.pad[:, IN])


def wall_amplitudes(half, q):
    """Amplitudes of the modes by their coordinates q [..., n], of a pair at the place of its a."""
    amplitude = np.abs(q)
    a, b = slice(half.pairs), slice(half.b, half.b + half.pairs)
    amplitude[..., a] = np.sqrt(q[..., a] ** 2 + q[..., b] ** 2)
    return amplitude


def cage_elastic_kinematics(model, y, w):
    """Coordinates of both halves [..., 1, n], reach of their walls, inertia that the modes add, motions of the pads against
    each other: elastic part, out of the plane (x, phi_r, phi_t) and in it (r, t).
    """
    half, e = model.modes, w.cage.elastic
    S, D, S_dot, D_dot = (y[..., block][..., : half.n] for block in (MODE_S, MODE_D, MODE_S_DOT, MODE_D_DOT))
    e.q, e.q_dot = ([(s - d)[..., None, :] / ROOT, (s + d)[..., None, :] / ROOT] for s, d in ((S, D), (S_dot, D_dot)))
    moved = [wall_amplitudes(half, np.real(q)) for q in e.q]
    e.reach_others = [np.sum(half.widest_others * amplitude, axis=-1) for amplitude in moved]
    e.reach = [
        others + np.sum(half.widest * amplitude, axis=-1)
        for others, amplitude in zip(e.reach_others, moved, strict=True)
    ]
    e.more_J, e.more_J_dot = ([2.0 * np.sum(half.centrifugal * q, axis=-1) for q in both] for both in (e.q, e.q_dot))
    e.pad_out, e.pad_in, e.pad_in_dot = (
        cage_elastic_out(half, S),
        cage_elastic_in(half, D),
        cage_elastic_in(half, D_dot),
    )


def move_pads(model, w):
    """Motions of the pads against each other: those of the halves as rigid bodies and of their modes.  Sets e [3, ..., Z],
    half the relative motion out of the plane, and u, v [2, ..., Z], offset and velocity (y, z) in it.
    """
    (_, c, s), (h0, h1), j = circle(model.d), w.half, w.cage.elastic.joints
    turn_y, turn_z = -vec_dot(h0.b_z, h1.a), vec_dot(h0.b_y, h1.a)  # small rotation of half 1 against half 0
    rigid = np.array([w.u[0], turn_y * c + turn_z * s, turn_z * c - turn_y * s])
    j.e = 0.5 * (rigid + w.cage.elastic.pad_out)
    j.u, j.v = (
        total[1:] + np.array([c * r - s * t, s * r + c * t])
        for total, (r, t) in ((w.u, w.cage.elastic.pad_in), (w.v_j, w.cage.elastic.pad_in_dot))
    )


def broken_answer(K, L_K):
    """Loads (N, M_r, M_t) [..., 3] of joints without a rivet at the trial loads L_K: the pads press on each other in their
    middles or carry nothing.
    """
    N = minimum(L_K[..., 0] - L_K[..., 1:] @ np.linalg.solve(K[1:, 1:], K[1:, 0]), 0.0)
    return N[..., None] * [1.0, 0.0, 0.0]


def cage_elastic_loads(model, P, j):
    """Loads of the joints j out of the plane and of their rivets for the motions e [3, ..., Z] and preloads P [..., Z]: sets
    trial loads L_K, load (N, M_r, M_t), rivet (T, m_r, m_t) [3, ..., Z], N_plate and the energy U of the law [J], [..., Z].
    """
    intact, half, law, e = model.d.intact, model.modes, model.modes.law, np.moveaxis(j.e, 0, -1)
    trial = e @ law.stiffness.T
    places = law_places(law, trial, P + 0.0 * trial[..., 0])
    load, rivet = law_answer(law, places, trial[..., 1])
    j.U = places[0] ** 2 * law_sum(half.law.energy[..., None], places)[..., 0]
    if not np.all(intact > 0.0):
        broken = broken_answer(law.stiffness, trial)
        U = 0.5 * np.sum(e * trial, axis=-1) - 0.5 * half.R[0, 0] * broken[..., 0] ** 2
        j.U = np.where(intact > 0.0, j.U, U)
        load, rivet = np.where(intact[:, None] > 0.0, load, broken), intact[:, None] * rivet
    j.trial, j.load, (T, m_r, m_t) = (np.moveaxis(x, -1, 0) for x in (trial, load, rivet))
    j.rivet = np.array([maximum(T, 0.0), m_r, m_t])
    j.N_plate = maximum(j.rivet[0] - j.load[0], 0.0)


def cage_elastic_speed_2(w):
    """Square of the halves' speed in space, mean of both."""
    h0, h1 = w.half
    return 0.5 * ((h0.s + w.frame_omega) ** 2 + (h1.s + w.frame_omega) ** 2)


def cage_elastic_preload(model, omega_2):
    """Preloads [N] with the addition of the centrifugal load of that speed."""
    d = model.d
    w = d.centrifugal[ROW_DP] * omega_2
    return maximum(d.P + w + spin_bending(d.table.half, d.P, w), 0.0)


def add_moments(model, w):
    """Adds the moments of the joints to both halves: on half 1 those whose power is that of the rates of turn_y, turn_z."""
    (_, c, s), (h0, h1), (_, M_r, M_t) = circle(model.d), w.half, w.cage.elastic.joints.load
    M_y, M_z = ball_array_sum(M_r * c - M_t * s), ball_array_sum(M_r * s + M_t * c)
    moment = M_y * vec_cross(h1.a, h0.b_z) - M_z * vec_cross(h1.a, h0.b_y)
    h0.M, h1.M = h0.M - moment, h1.M + moment


def cage_elastic_joints(model, y, w):
    """Joints by the present state (cage_joint_kinematics before); adds their forces and moments to both halves."""
    j = w.cage.elastic.joints = SimpleNamespace()
    move_pads(model, w)
    cage_elastic_loads(model, cage_elastic_preload(model, cage_elastic_speed_2(w)), j)
    add_moments(model, w)
    at = JointMotion(j.u, j.v, j.rivet[0], j.N_plate, -j.load[0])
    cage_joint_force(model, y, cage_elastic_stiffness(model), at, w)
    j.F = w.joint_F


def cage_elastic_pull(model, load, F):
    """Forces of the joints on the modes, S and D [..., n], by their loads out of the plane [3, ..., Z] and forces F (y, z) in
    it [2, ..., Z].
    """
    half, (_, c, s) = model.modes, circle(model.d)
    across = np.stack([c * F[0] + s * F[1], c * F[1] - s * F[0]])
    by_out = -ROOT * np.einsum("k...z,ikz->...i", load, half.pad[:, OUT])
    return by_out, ROOT * np.einsum("k...z,ikz->...i", across, half.pad[:, IN])


def cage_elastic_acceleration(model, y, w, y_dot):
    """Rates of the modal coordinates; their energy and dissipation [..., 1], the energy with that of the spin in the moment
    of inertia that they add.
    """
    half, m, e = model.modes, model.p.cage.m, w.cage.elastic
    mirrored, opposed = cage_elastic_pull(model, e.joints.load, e.joints.F)
    if w.pressure:
        e.wall_force = [
            e.wall_force[h] + np.einsum("c...,ic->...i", w.pressure.rim_force[..., h], half.rim) for h in range(2)
        ]
    f0, f1 = (e.wall_force[h] + (w.half[h].s + w.frame_omega) ** 2 * half.centrifugal for h in range(2))
    e.dissipated, e.energy = 0.0, 0.0
    for q, rate, force in (
        (MODE_S, MODE_S_DOT, mirrored + (f1 + f0) / ROOT),
        (MODE_D, MODE_D_DOT, opposed + (f1 - f0) / ROOT),
    ):
        x, v = y[..., q][..., : half.n], y[..., rate][..., : half.n]
        y_dot[..., q][..., : half.n] = v
        y_dot[..., rate][..., : half.n] = force / m - half.damping * v - half.omega**2 * x
        e.dissipated = e.dissipated + m * np.sum(half.damping * v * v, axis=-1, keepdims=True)
        e.energy = e.energy + 0.5 * m * np.sum(v * v + half.omega**2 * x * x, axis=-1, keepdims=True)
    for J, body in zip(e.more_J, w.half, strict=True):
        e.energy = e.energy + 0.5 * J * (body.s**2 - w.frame_omega**2)


def cage_elastic_rivets(model, w):
    """JointLoads of all joints and their rivets."""
    j, shear = w.cage.elastic.joints, cage_joint_carried(model, w)
    if w.pressure and np.any(np.real(w.pressure.felt) > 0.0):
        j = elastic_lands(model, w, cage_elastic_preload(model, cage_elastic_speed_2(w)), shear)
    return cage_joint_loads(model, j.load, j.rivet, shear)
