"""Riveted joint k: plates pressed together by the rivet, friction of plates and heads, the rivet's shank in its holes.

       |  T  |          u    hole of half 1 - hole of half 0 at rivet k, in the body frame of half 0, v its rate
    ---+-   -+---       T    tension of the rivet, N_plate force between the plates: two_half.py, cage_elastic.py
    half 1     | u_x    plate friction  S, |S| <= C_p = mu N_plate + F_floor
    ===+=====+===       head friction   H = -k_h z_h, |H| <= C_h = mu T + F_floor
    half 0     |        hole contact    B = -k_hole max(0, |u| - gap) u/|u|,  gap = max(0, -fit_a): the diametral play
    ---+-   -+---
       |     |

    u --[ k_t, z_p ]--+--[ plates: C_p ]--------------+--      S + H = -k_t z_p: the sticking joint's own deflection
                      +--[ k_h, z_h ]--[ heads: C_h ]-+        z_h: deflection of the heads, which the plates' slip drags

Under a growing transverse load the plates slip first (at C_p), then the heads slip on the rivet (at C_h more), then the
halves move freely across the gap, and at last the shank bears against its holes.  Finite elements of the joint with
Coulomb's friction show the same (tests/test_joint_backbone.py): plates that stick leave the heads alone, and the
heads are one spring with one slider.

Both frictions are elastic and perfectly plastic: a deflection follows the motion as long as Coulomb's law allows its
force, and slips where it does not (Moreau 1977: the slip is normal to the disc |S| <= C_p).  Below the slip
load nothing slips, so that a joint that carries a constant load under vibration shakes down (Melan's theorem)
instead of creeping.  Between two moments the law is integrated by return mapping (Simo and Hughes 1998, chapter 2): z_p
first follows the whole motion, trial deflections,

      X = k_t z_p - k_h z_h                               trial force of the plates
      z_h += max(|X| - C_p, 0)/(k_t + k_h) X/|X|          their slip drags the heads (linear kinematic hardening)
      z_h *= min(1, C_h/(k_h |z_h|))                      which slip on the rivet
      k_t z_p = k_h z_h + min(1, C_p/|X'|) X'             X' = k_t z_p - k_h z_h

for any motion and for capacities that change.  An evaluation has the trial deflections among its states and the forces of
the mapped ones; the end of a step or substep maps the states (cage_joint_slide).  The dissipation is the work of the
mean force over the motion less the change of (k_t z_p^2 + k_h z_h^2)/2: the balance of energy is closed in every step.

Force and reaction act at the same point, so momentum and energy are exact.
Smoothness: C0 at bearing (a spring of finite stiffness begins) and where slip begins.
"""

from dataclasses import dataclass

import numpy as np

from bearing_model.generated.variables import JOINT_HEAD_Y, JOINT_HEAD_Z, JOINT_PLATE_Y, JOINT_PLATE_Z
from bearing_model.numbers.lanes import ball_array_sum, maximum
from bearing_model.numbers.vec import vec, vec_cross, vec_dot
from bearing_model.rivet.rivet_rom import JointLoads


@dataclass
class JointStiffness:
    """Stiffnesses in the plane of the split [N/m]: of the joint as long as its plates stick, of the heads that the plates'
    slip drags, of holes in which a shank bears.
    """

    stick: float
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
class JointStep:
    """Friction over a step: the states [4, Z] from which the present ones followed the motion since the last mapping; motion of
    the joints over the step [2, Z] [m]; normal force times slip [Z] [J].
    """

    before: np.ndarray
    way: np.ndarray = None
    rubbed: np.ndarray = 0.0


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


STATES = JOINT_PLATE_Y, JOINT_PLATE_Z, JOINT_HEAD_Y, JOINT_HEAD_Z
PLATES, HEADS = STATES[:2], STATES[2:]
SLIDES = 0.999  # part of its capacity from which friction that is driven outward counts as sliding
NOTHING = 1e-30  # [N2]: forces without a direction


def length_of(v):
    """Length of vectors (y, z)."""
    return np.sqrt(v[0] * v[0] + v[1] * v[1] + NOTHING)


def hold(k, C_plates, C_heads, joint, head):
    """Friction mapped back: deflections (y, z) of joints and heads, forces of the plates [N], parts of the trial forces that
    plates and heads hold.
    """
    X = k.stick * joint - k.head * head
    size = length_of(X)
    head = head + maximum(size - C_plates, 0.0) / ((k.stick + k.head) * size) * X
    held_heads = C_heads / maximum(length_of(k.head * head), C_heads)
    head = held_heads * head
    X = k.stick * joint - k.head * head
    held_plates = C_plates / maximum(length_of(X), C_plates)
    return (k.head * head + held_plates * X) / k.stick, head, held_plates * X, held_plates, held_heads


def sliding_power(C, F, v):
    """Power of friction of the force F that slides with the velocity v."""
    slides = np.real(length_of(F)) > SLIDES * np.real(C)
    return np.where(slides, maximum(v[0] * F[0] + v[1] * F[1], 0.0), 0.0)


def cage_joint_bearing(k_hole, gap, u):
    """Force (y, z) of shanks that bear against their holes, at offsets u, and |u|."""
    slip = length_of(u)
    return -k_hole * maximum(slip - gap, 0.0) / slip * u, slip


def cage_joint_follow(h, v, y):
    """The joints' deflections in y follow the motion with the velocities v [2, Z] for the time h [s]: trial deflections.
    Returns the friction states before it [4, Z].
    """
    before = np.array([y[row] for row in STATES])
    for row, along in zip(PLATES, v, strict=True):
        y[row] += h * along
    return before


def cage_joint_slide(model, k, T, N_plate, y, step):
    """Maps the trial deflections in y back onto those that friction bears under the tension T of the rivets and the force
    N_plate between the plates [Z]; adds to step.rubbed.  Returns the energy that the slip dissipates [J].
    """
    mu, floor, (joint_0, head_0) = model.p.joint.mu, model.p.joint.F_floor, step.before.reshape(2, 2, -1)
    trial, head = (np.array([y[row] for row in rows]) for rows in (PLATES, HEADS))
    joint, head, *_ = hold(k, mu * N_plate + floor, mu * T + floor, trial, head)
    plates_slip, bent = trial - joint, head - head_0
    work = 0.5 * np.sum(k.stick * (joint_0 + joint) * plates_slip - k.head * (head_0 + head) * bent, axis=0)
    step.rubbed = step.rubbed + N_plate * np.hypot(*plates_slip) + T * np.hypot(*(plates_slip - bent))
    for row, value in zip(STATES, (*joint, *head), strict=True):
        y[row] = value
    return np.sum(np.maximum(work, 0.0))


def cage_joint_shear(model, y, k, u):
    """Forces (y, z) [2, Z] on half 1 in the plane, for offsets u [2, Z] and the friction states in y."""
    B, _ = cage_joint_bearing(k.hole, model.d.hole_gap, u)
    return B - k.stick * np.array([y[row] for row in PLATES])


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
    """Friction and hole contact of all joints: sets S, H, B [2, ..., Z] (y, z), their sum joint_F, the parts of the trial
    deflections that friction holds and the power of the friction; adds the joints' wrench to both halves, as forces at the
    holes of the halves as rigid bodies.
    """
    joint, d = model.p.joint, model.d
    trial, head = (np.array([y[..., row] for row in rows]) for rows in (PLATES, HEADS))
    C_plates, C_heads = (joint.mu * load + joint.F_floor for load in (at.N_plate, at.T))
    _, head, plates, w.plate_held, w.head_held = hold(k, C_plates, C_heads, trial, head)
    w.S, w.H = -plates, -k.head * head
    # plates whose heads still stick slip with a part of the motion
    by_heads, by_plates = sliding_power(C_heads, -w.H, at.v), sliding_power(C_plates, plates, at.v)
    part = np.where(np.real(by_heads) > 0.0, 1.0, k.stick / (k.stick + k.head))
    w.joint_dissipated = np.where(np.real(by_plates) > 0.0, by_heads, 0.0) + part * by_plates

    w.B, slip = cage_joint_bearing(k.hole, d.hole_gap, at.u)
    w.k_bearing = k.hole * (np.real(slip) > d.hole_gap)
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
