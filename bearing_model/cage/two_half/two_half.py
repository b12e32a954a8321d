"""Rigid cage halves and the loads of their rivets.

Joint k, along the axis: springs between the halves, u_x the distance of the holes beyond their place under preload,

    pull = max(0, P + k_rivet u_x)     the rivet and the flanges under its heads
    push = max(0, P - k_plate u_x)     the plates, damped by c v_x push/(push + F_floor)

A rigid half carries the load of a pocket straight to all joints.  A half that bends also pries at the joints beside the
pocket, and the cage's own centrifugal load pries at all of them.  So the joint's load is the rigid share, pull - push,
and the load of bonded joints of halves that bend (half_path.py).  Joints that open and slip relieve this added load
(joint_open.py); in the plane it is carried by the friction and the play that the rigid share leaves over.  The tension
T of the rivet and the force between the plates, N_plate = T - N, follow from the whole load; the friction law and the
outputs use them.  The springs alone move the halves.

The work of the added loads is that of the halves' elastic deformation, which rigid halves do not have: on rigid halves
the centrifugal loads of all parts balance, so that they do no work and the energy balance has no term for them.

In a frame that turns, the centrifugal load is that of the speed in the fixed frame; a uniform field of gravity or of
the frame's acceleration acts on a half as its own acceleration does, and is in the load path's balance of forces.

The tangential inertia load of a cage whose speed changes (Euler's) is to the centrifugal one as omega_dot to omega^2:
1.3 % in a run-up to 18,238 r/min within 0.1 s, 0.013 % within 10 s, so it is left out.

Loads are on the +x half, in the frames (x, r, t) of the rivets, at body angles 2 pi (k + 1/2)/Z of half 0.
Smoothness: C0 at opening, where a spring of finite stiffness begins.
"""

from types import SimpleNamespace

import numpy as np

from bearing_model.cage.common.cage_joint import (
    JointMotion,
    JointStep,
    JointStiffness,
    cage_joint_carried,
    cage_joint_follow,
    cage_joint_force,
    cage_joint_loads,
)
from bearing_model.cage.common.films import HALF, N_HALVES
from bearing_model.cage.common.halves_step import (
    halves_correct,
    halves_films,
    halves_move,
    halves_predict,
    halves_remember,
    halves_residual,
    halves_slide,
)
from bearing_model.cage.common.joint_slip import joint_slip_add
from bearing_model.cage.common.pocket_films import pocket_films_arrive
from bearing_model.cage.common.spin_preload import spin_bending
from bearing_model.cage.two_half.half_path import half_path_rows, land_rows
from bearing_model.cage.two_half.joint_open import joints_open
from bearing_model.generated import variables as Y
from bearing_model.generated.variables import Z
from bearing_model.numbers.lanes import ball_array_sum, maximum

ROW_M_T, ROW_DP = 4, 5


def two_half_stiffness(d):
    """Stiffnesses of the joints in the plane."""
    return JointStiffness(d.k_plate_t, d.k_head, d.k_hole)


# --------------------------------------------------------------------------------------------------------------- joints


def springs(d, u_x):
    """Pull and push of the springs at distances u_x [..., Z] of the holes [N]."""
    return d.intact * maximum(d.P + d.k_rivet * u_x, 0.0), maximum(d.P - d.k_plate * u_x, 0.0)


def bonded_rows(model, w, omega_2):
    """Rows [..., Z, 8] of bonded joints by pocket forces, films of the lands and the centrifugal load; omega_2: square of the halves' speed in
    space [..., 1].
    """
    half = model.d.table.half
    rows = sum(half_path_rows(half, 2 * h - 1, on.push, on.F, on.radius) for h, on in enumerate(w.pocket))
    if w.land:
        rows = rows + land_rows(half, model.p.cage.land_x, w.land)
    return rows + omega_2[..., None] * model.d.centrifugal


def open_joints(model, w):
    """Loads of the joints by their springs' forces and the load path: sets load, rivet [3, ..., Z], N_plate, bonded_V."""
    d, t = model.d, w.cage.two_half
    omega_2 = 0.5 * ((w.half[0].s + w.frame_omega) ** 2 + (w.half[1].s + w.frame_omega) ** 2)
    N, V_r, V_t, M_r, M_t, dP, dm_r, dm_t = np.moveaxis(bonded_rows(model, w, omega_2), -1, 0)
    t.bonded_V = np.array([V_r, V_t])
    bonded = np.stack([t.pull - t.push + N, M_r, M_t], axis=-1)
    half, spin_w = d.table.half, omega_2 * d.centrifugal[ROW_DP]
    P = d.intact * maximum(d.P + (dP + spin_bending(half, d.P, spin_w)), 0.0)
    spin_M = omega_2 * d.centrifugal[ROW_M_T]
    spin_P = maximum(d.P_mean + spin_w + spin_bending(half, d.P_mean, spin_w), 0.0)
    load, rivet, _ = joints_open(
        d.table.half.law, bonded, P, spin_M[..., 0], spin_P[..., 0], intact=np.asarray(d.intact) > 0.0
    )
    t.load, (T, m_r, m_t) = np.moveaxis(load, -1, 0), np.moveaxis(rivet, -1, 0)

    # The plates of a joint without a rivet are pressed by the springs alone.
    T = maximum(T, 0.0)
    t.N_plate = np.where(d.intact > 0.0, maximum(T - t.load[0], 0.0), t.push)
    t.rivet = np.array([T, d.intact * (m_r + dm_r), d.intact * (m_t + dm_t)])


def two_half_joints(model, y, w):
    """Forces of the joints (cage_joint_kinematics before), tension of the rivets."""
    t = w.cage.two_half = SimpleNamespace()
    t.pull, t.push = springs(model.d, w.u[0])
    open_joints(model, w)
    damping = model.d.c_joint * t.push / (t.push + model.p.joint.F_floor)
    F_x = t.push - t.pull - damping * w.v_j[0]
    at = JointMotion(w.u[1:], w.v_j[1:], t.rivet[0], t.N_plate, F_x)
    cage_joint_force(model, y, two_half_stiffness(model.d), at, w)
    t.dissipated = ball_array_sum(damping * w.v_j[0] * w.v_j[0])


# ---------------------------------------------------------------------------------------------------- loads of the rivets


def two_half_loads(model, w):
    """JointLoads of all joints and their rivets."""
    t, shear = w.cage.two_half, cage_joint_carried(model, w)
    joint_slip_add(model, w, w.u[1:], t.rivet[0], t.N_plate, t.bonded_V, shear)
    return cage_joint_loads(model, t.load, t.rivet, shear)


# --------------------------------------------------------------------------------------------------------------- a step


def vibration_weights(x_2):
    """Weights of a vibration between the halves that turns by x = omega h a step, given x^2: of K in the matrix, of the
    position correction.
    """
    part = x_2**2 / (x_2**2 + 1.0)
    return 1.0 / 3.0 + part * (1.5 - 1.0 / 3.0), 1.0 / 3.0 + part * (1.7 - 1.0 / 3.0)


def turned_rivets(model, w):
    """Places (y, z) [2, Z] of the rivets, turned with half 0."""
    d, h0 = model.d, w.half[0]
    return [d.rivet_y * h0.b_y[i] + d.rivet_z * h0.b_z[i] for i in (1, 2)]


def joint_matrix(model, w):
    """Force per axial velocity and per axial offset of half 1 against half 0 [12, 12], of all joints; b = (1, z, -y) of v_x,
    beta_dot, gamma_dot.  The rivet is stiff while it is tense, the plates while they are pressed together.
    """
    d, t, (y, z) = model.d, w.cage.two_half, turned_rivets(model, w)
    B = np.zeros((Z, N_HALVES))
    B[:, HALF[[0, 3, 4], 1]] = np.array([np.ones(Z), z, -y]).T
    B[:, HALF[[0, 3, 4], 0]] = -B[:, HALF[[0, 3, 4], 1]]
    c = d.c_joint * t.push / (t.push + model.p.joint.F_floor)
    k = d.k_rivet * (t.pull > 0.0) + d.k_plate * (t.push > 0.0)
    return B.T * c @ B, B.T * k @ B


def shear_matrix(model, w):
    """Force per offset [12, 12] of the joints across the axis: of half 1 against half 0 at a rivet, (v_y - s z, v_z + s y).

    The lever of the split from the centres of mass is left out.  Joints that slip lie between plates which stick and heads by the
    part of the trial force that friction holds.
    """
    d, (y, z) = model.d, turned_rivets(model, w)
    slipping = w.head_held / (1.0 / d.k_plate_t + 1.0 / d.k_head)
    k = slipping + (d.k_plate_t - slipping) * w.plate_held + w.k_bearing
    B = np.zeros((2, Z, N_HALVES))
    B[0][:, HALF[[1, 2, 5], 1]] = np.array([np.ones(Z), np.zeros(Z), -z]).T
    B[1][:, HALF[[1, 2, 5], 1]] = np.array([np.zeros(Z), np.ones(Z), y]).T
    B[:, :, HALF[:, 0]] = -B[:, :, HALF[:, 1]]
    return sum(b.T * k @ b for b in B)


def two_half_matrices(model, w, gamma):
    """Rates A and stiffnesses K along the axis, K across it, [12, 12] each, with the weights of the vibrations; weights of
    the position corrections along the axis and across it.
    """
    p, d = model.p, model.d
    M = np.repeat([p.cage.m] * 3 + [d.J_t] * 2 + [d.J_p], 2)[:, None]
    A, K = (force / M for force in joint_matrix(model, w))
    K_shear = shear_matrix(model, w) / M
    weight, axial = vibration_weights(8.0 * np.max(np.diag(gamma * A + gamma**2 * K)[HALF[[0, 3, 4], 0]]))
    weight_shear, shear = vibration_weights(8.0 * gamma**2 * np.max(np.diag(K_shear)[HALF[[1, 5], 0]]))
    return weight * A, weight * K, weight_shear * K_shear, axial, shear


def correct_halves(model, w, gamma, axial, shear, delta, y, joints):
    """Positions and trial deflections in y follow the corrections delta [12] of the velocities: half 1 against half 0 with
    weights; z_{n+1} += c gamma u, u the change of the joint's velocity.
    """
    d, h0 = model.d, w.half[0]
    relative = delta[HALF[:, 1]] - delta[HALF[:, 0]]
    weights = (axial, shear, shear, axial, axial, shear)
    for q, change, c in zip(
        (Y.CAGE_X, Y.CAGE_Y, Y.CAGE_Z, Y.CAGE_BETA, Y.CAGE_GAMMA, Y.CAGE_PSI), relative, weights, strict=True
    ):
        y[q] += 0.5 * c * gamma * change * np.array([-1.0, 1.0])
    _, dv_y, dv_z, _, _, ds = relative
    u_y, u_z = (axis[1] * dv_y + axis[2] * dv_z for axis in (h0.b_y, h0.b_z))
    u = np.array([u_y - ds * d.rivet_z, u_z + ds * d.rivet_y])
    cage_joint_follow(shear * gamma, u, y)
    joints.way = joints.way + shear * gamma * u


def two_half_begin(model, h, start, middle, y, w):
    """Motion and predicted velocities; returns the HalvesStep."""
    step, across = halves_move(model, h, start, middle, y, w), w.v_j[1:]
    step.joints = JointStep(cage_joint_follow(h, across, y), h * across)
    halves_predict(model, start, y, step)
    return step


def two_half_end(model, step, start, end, error, w):
    """Solution, corrections and history; returns residual and delta [12].

    S (1 + gamma A + gamma^2 K) delta = residual; S = 1 + gamma^2 K_shear, across the axis, is a factor of its own.
    """
    gamma, one, films = step.gamma, np.eye(N_HALVES), halves_films(model, w)
    before, pockets = start.cage.pockets, end.cage.pockets
    end.f[Y.WORK] += pocket_films_arrive(model, gamma, None, before, end.y, w, end.f, pockets)
    A, K, K_shear, axial, shear = two_half_matrices(model, w, gamma)
    residual = np.linalg.solve(one + gamma**2 * K_shear, halves_residual(step, start, end))
    delta = np.linalg.solve(one + gamma * (films + A) + gamma**2 * K, residual)
    change = halves_correct(step, delta, end.y)
    correct_halves(model, w, gamma, axial, shear, change, end.y, step.joints)
    two_half_slide(model, w, end.y, step.joints)
    halves_remember(model, w, step, start, change, change, end, error)
    return residual, delta


def two_half_slide(model, w, y, joints):
    """Maps the friction states in y back under the loads in w."""
    return halves_slide(model, two_half_stiffness(model.d), w.cage.two_half, y, joints)
