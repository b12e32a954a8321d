"""Riveted joint k: plates pressed together by the rivet, friction of plates and heads, the rivet's shank in its holes.

       |  T  |          u    hole of half 1 - hole of half 0 at rivet k, in the body frame of half 0, v its rate
    ---+-   -+---       T    tension of the rivet, N_plate force between the plates: two_half.py, cage_elastic.py
    half 1     | u_x    plate friction  S = -k_t z,  z' = v - |v| k_t z/(mu N_plate + F_floor)
    ===+=====+===       head friction   H = -k_h z_h, likewise with mu T + F_floor
    half 0     |        hole contact    B = -k_hole max(0, |u| - gap) u/|u|,  gap = max(0, -fit_a): the diametral play
    ---+-   -+---
       |     |

The friction law is that of Dahl (1968): its force is a state, so that a closed joint does not creep.  Under a growing
transverse load the plates slip first (at mu N_plate), then the heads slip on the rivet (at mu T more), then the halves
move freely across the gap, and at last the shank bears against its holes.

Force and reaction act at the same point, so momentum and energy are exact.
Smoothness: C0 at bearing (a spring of finite stiffness begins), C0 at v = 0.
"""

from dataclasses import dataclass

import numpy as np

from bearing_model.generated.variables import JOINT_HEAD_Y, JOINT_HEAD_Z, JOINT_PLATE_Y, JOINT_PLATE_Z
from bearing_model.numbers.lanes import ball_array_sum, maximum
from bearing_model.numbers.vec import vec, vec_cross, vec_dot
from bearing_model.rivet.rivet_rom import JointLoads


@dataclass
class JointStiffness:
    """Stiffnesses of plates, heads and holes in the plane of the split [N/m]."""

    plate: float
    head: float
    hole: np.ndarray  # [Z]


@dataclass
class JointMotion:
    """Offset u and velocity v of half 1 against half 0 at the holes, in the plane [2, ..., Z]; tension of the rivets, force
    between the plates, axial force on half 1 [..., Z].
    """

    u: np.ndarray
    v: np.ndarray
    T: np.ndarray
    N_plate: np.ndarray
    F_x: np.ndarray = None


@dataclass
class JointShear:
    """Loads (r, t) [2, ..., Z] of half 1 that plates, heads and shanks carry in the plane [N]."""

    plates: np.ndarray
    heads: np.ndarray
    shank: np.ndarray


def cage_joint_kinematics(model, w):
    """Offset u and velocity v_j of half 1 against half 0 as rigid bodies at each rivet, in the frame of half 0."""
    h0, h1 = w.half
    s_y, s_z = model.d.rivet_y, model.d.rivet_z
    g, omega = h1.x - h0.x, h1.Omega - h0.Omega
    v = h1.v - h0.v - vec_cross(h0.Omega, g)
    spin_y, spin_z = vec_cross(omega, h1.b_y), vec_cross(omega, h1.b_z)

    # u = offset + (A - 1) s with A = axes of half 1 in half 0, s = (0, rivet_y, rivet_z); v likewise with the rates
    axes = (h0.a, h0.b_y, h0.b_z)
    w.u = np.array(
        [
            vec_dot(e, g) + (vec_dot(e, h1.b_y) - (i == 1)) * s_y + (vec_dot(e, h1.b_z) - (i == 2)) * s_z
            for i, e in enumerate(axes)
        ]
    )
    w.v_j = np.array([vec_dot(e, v) + vec_dot(e, spin_y) * s_y + vec_dot(e, spin_z) * s_z for e in axes])


def cage_joint_friction(k, capacity, z_y, z_z, v_y, v_z):
    """Dahl's friction with force -k z: rates of z, their decay D, the dissipated power."""
    # |v| has no derivative at v = 0; the complex step of |v| is taken as 0 there
    speed_2 = v_y * v_y + v_z * v_z
    speed = np.sqrt(np.where(np.real(speed_2) > 0.0, speed_2, 0.0))
    rate = speed * k / capacity
    return v_y - rate * z_y, v_z - rate * z_z, rate, k * rate * (z_y * z_y + z_z * z_z)


def cage_joint_bearing(k_hole, gap, u):
    """Force (y, z) of shanks that bear against their holes, at offsets u, and |u|."""
    slip = np.sqrt(u[0] * u[0] + u[1] * u[1] + 1e-30)
    return -k_hole * maximum(slip - gap, 0.0) / slip * u, slip


def cage_joint_advance(model, h, k, at, y):
    """The friction states in y [N_STATES] over a step h [s] with the velocities and forces `at` in its middle:
    z += h z'/(1 + h D/2), D = |v| k/capacity.

    The implicit midpoint rule of z' = v - D z, solved in closed form.  Returns what they dissipate, h k D z_m^2 with
    z_m in the middle [J].
    """
    joint, speed, lost = model.p.joint, np.hypot(*at.v), 0.0
    pairs = ((k.plate, at.N_plate, (JOINT_PLATE_Y, JOINT_PLATE_Z)), (k.head, at.T, (JOINT_HEAD_Y, JOINT_HEAD_Z)))
    for stiffness, load, blocks in pairs:
        rate = speed * stiffness / (joint.mu * load + joint.F_floor)
        for v, z in zip(at.v, blocks, strict=True):
            change = h * (v - rate * y[z]) / (1.0 + 0.5 * h * rate)
            lost += np.sum(h * stiffness * rate * (y[z] + 0.5 * change) ** 2)
            y[z] += change
    return lost


def cage_joint_shear(model, y, k, u):
    """Forces (y, z) [2, Z] on half 1 in the plane, for offsets u [2, Z] and the friction states in y."""
    B, _ = cage_joint_bearing(k.hole, model.d.hole_gap, u)
    S = np.array([y[JOINT_PLATE_Y], y[JOINT_PLATE_Z]])
    return -k.plate * S - k.head * np.array([y[JOINT_HEAD_Y], y[JOINT_HEAD_Z]]) + B


def add_wrench(w, F, M):
    """Adds the joints' wrench (F, M) on half 1, about the centre of half 0 in its frame, to half 1 about its own centre,
    and the opposite to half 0.
    """
    h0, h1 = w.half
    force, moment = (h0.a * v[0] + h0.b_y * v[1] + h0.b_z * v[2] for v in (F, M))
    h0.F = h0.F - force
    h0.M = h0.M - moment
    h1.F = h1.F + force
    h1.M = h1.M + moment - vec_cross(h1.x - h0.x, force)


def cage_joint_force(model, y, k, at, w):
    """Friction and hole contact of all joints: sets S, H, B [2, ..., Z] (y, z), their sum joint_F, the rates of the
    friction states and the dissipated power; adds the joints' wrench to both halves, as forces at the holes of the
    halves as rigid bodies.
    """
    joint, d = model.p.joint, model.d
    v_y, v_z = at.v
    zp_y, zp_z, zh_y, zh_z = (y[..., block] for block in (JOINT_PLATE_Y, JOINT_PLATE_Z, JOINT_HEAD_Y, JOINT_HEAD_Z))

    plates, heads = (joint.mu * load + joint.F_floor for load in (at.N_plate, at.T))
    w.plate_y_dot, w.plate_z_dot, w.plate_rate, lost_plate = cage_joint_friction(k.plate, plates, zp_y, zp_z, v_y, v_z)
    w.head_y_dot, w.head_z_dot, w.head_rate, lost_head = cage_joint_friction(k.head, heads, zh_y, zh_z, v_y, v_z)
    w.joint_dissipated = lost_plate + lost_head

    w.B, slip = cage_joint_bearing(k.hole, d.hole_gap, at.u)
    w.k_bearing = k.hole * (np.real(slip) > d.hole_gap)
    w.S, w.H = np.array([-k.plate * zp_y, -k.plate * zp_z]), np.array([-k.head * zh_y, -k.head * zh_z])
    w.joint_F = w.S + w.H + w.B

    # force on half 1 at its hole, which is at s + u from the centre of half 0, in the frame of half 0
    f, (u_x, u_y, u_z) = vec(at.F_x, *w.joint_F), w.u
    add_wrench(w, ball_array_sum(f), ball_array_sum(vec_cross(vec(u_x, d.rivet_y + u_y, d.rivet_z + u_z), f)))


def polar(model, v):
    """A vector (y, z) [2, ..., Z] at every rivet, radially and along the circle."""
    c, s = model.d.rivet_y * model.d.inv_R, model.d.rivet_z * model.d.inv_R
    return np.array([v[0] * c + v[1] * s, v[1] * c - v[0] * s])


def cage_joint_carried(model, w):
    """JointShear of friction and holes."""
    return JointShear(*(-polar(model, force) for force in (w.S, w.H, w.B)))


def cage_joint_loads(model, joint, rivet, shear):
    """JointLoads of all joints from (N, M_r, M_t) of the joints, (T, m_r, m_t) of their rivets [3, ..., Z] and their loads
    in the plane.
    """
    (N, M_r, M_t), (T, m_r, m_t), (V_r, V_t) = joint, rivet, shear.shank
    V, F_head = np.hypot(*(shear.plates + shear.heads + shear.shank)), model.d.intact * np.hypot(*shear.heads)
    return JointLoads(N=N, M_r=M_r, M_t=M_t, V=V, T=T, m_r=m_r, m_t=m_t, V_r=V_r, V_t=V_t, F_head=F_head)
