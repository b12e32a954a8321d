"""Riveted joint k: plates pressed together by the rivet, friction of plates and heads, the rivet's shank in its holes.

       |  T  |          u    hole of half 1 - hole of half 0 at rivet k, in the body frame of half 0, v its rate
    ---+-   -+---       T    tension of the rivet, N_plate force between the plates: two_half.py, cage_elastic.py
    half 1     | u_x    plate friction  S = -k_t z,  |S| <= C = mu N_plate + F_floor
    ===+=====+===       head friction   H = -k_h z_h, likewise with mu T + F_floor
    half 0     |        hole contact    B = -k_hole max(0, |u| - gap) u/|u|,  gap = max(0, -fit_a): the diametral play
    ---+-   -+---
       |     |

Friction is elastic and perfectly plastic: the deflection z of a spring follows the motion, z' = v, as long as Coulomb's
law allows its force, and slips where it does not (Moreau 1977: z' - v is normal to the disc k |z| <= C).  Below the slip
load nothing slips, so that a joint that carries a constant load under vibration shakes down (Melan's theorem) instead of
creeping.  Between two moments the law is integrated by return mapping (Simo and Hughes 1998, section 1.4): z first
follows the whole motion; its part beyond the disc, taken off along z, is slip,

    z = f z_trial,  z_trial = z_0 + h v,  f = min(1, C/(k |z_trial|)),  dissipated: k (z_0 + z)/2 . (1 - f) z_trial

for any h and for a capacity C that changes.  An evaluation has the trial deflections among its states and the forces of f
z_trial; the end of a step or substep maps the states back (cage_joint_slide).  The dissipation is the work of the mean
force over the motion less the change of k z^2/2: the balance of energy is closed in every step.

Under a growing transverse load the plates slip first (at mu N_plate), then the heads slip on the rivet (at mu T more),
then the halves move freely across the gap, and at last the shank bears against its holes.

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


def held_part(k, C, z):
    """Part f of a trial deflection z (y, z) that friction of the capacity C holds."""
    return C / maximum(k * np.sqrt(z[0] * z[0] + z[1] * z[1] + 1e-30), C)


def sliding_power(k, C, z, v):
    """Power of sliding friction: the capacity times the speed along the force."""
    size = np.sqrt(z[0] * z[0] + z[1] * z[1] + 1e-30)
    slides = np.real(k * size) > SLIDES * np.real(C)
    return np.where(slides, C * maximum(v[0] * z[0] + v[1] * z[1], 0.0) / size, 0.0)


def cage_joint_bearing(k_hole, gap, u):
    """Force (y, z) of shanks that bear against their holes, at offsets u, and |u|."""
    slip = np.sqrt(u[0] * u[0] + u[1] * u[1] + 1e-30)
    return -k_hole * maximum(slip - gap, 0.0) / slip * u, slip


def cage_joint_follow(h, v, y):
    """The friction states in y follow the motion with the velocities v [2, Z] for the time h [s]: trial deflections.
    Returns those before it [4, Z].
    """
    before = np.array([y[row] for row in STATES])
    for row, along in zip(STATES, (*v, *v), strict=True):
        y[row] += h * along
    return before


def cage_joint_slide(model, k, T, N_plate, y, step):
    """Maps the trial deflections in y back onto what friction holds under the tension T of the rivets and the force N_plate
    between the plates [Z]; adds to step.rubbed.  Returns what the slip dissipates [J].
    """
    joint, lost = model.p.joint, 0.0
    for stiffness, N, rows, z_0 in ((k.plate, N_plate, PLATES, step.before[:2]), (k.head, T, HEADS, step.before[2:])):
        trial = np.array([y[row] for row in rows])
        f = held_part(stiffness, joint.mu * N + joint.F_floor, trial)
        slip, mean = (1.0 - f) * trial, 0.5 * (z_0 + f * trial)
        step.rubbed = step.rubbed + N * np.hypot(*slip)
        lost += np.sum(np.maximum(stiffness * np.sum(mean * slip, axis=0), 0.0))
        for row, held in zip(rows, f * trial, strict=True):
            y[row] = held
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
    """Friction and hole contact of all joints: sets S, H, B [2, ..., Z] (y, z), their sum joint_F, the parts of the trial
    deflections that friction holds and the power of the friction; adds the joints' wrench to both halves, as forces at the
    holes of the halves as rigid bodies.
    """
    joint, d = model.p.joint, model.d
    plates, heads = (np.array([y[..., row] for row in rows]) for rows in (PLATES, HEADS))
    C_plate, C_head = (joint.mu * load + joint.F_floor for load in (at.N_plate, at.T))
    w.plate_held, w.head_held = held_part(k.plate, C_plate, plates), held_part(k.head, C_head, heads)
    w.S, w.H = -k.plate * w.plate_held * plates, -k.head * w.head_held * heads
    w.joint_dissipated = sliding_power(k.plate, C_plate, plates, at.v) + sliding_power(k.head, C_head, heads, at.v)

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
