"""The cage as the rest of the model knows it: all that may be called from outside this folder.

Two kinds of cage stand behind these functions, and only this file asks which one runs:
  two_half/   two rigid halves held by springs and friction of their joints; a static load path to the rivets
  elastic/    two halves that vibrate; their joints follow from the motion of both pads
common/ has the parts of both: poses and accelerations of the halves, films, pockets, joints' friction.

             half 0 (-x)   half 1 (+x)
       ball --> wall | joint k | wall <-- ball        joint k between the pockets k and k + 1
"""

from dataclasses import dataclass, field

import numpy as np

from bearing_model.cage.common.cage_joint import (
    STATES,
    JointStep,
    cage_joint_kinematics,
)
from bearing_model.cage.common.halves import halves_acceleration, halves_kinematics
from bearing_model.cage.common.halves_step import HalvesStep
from bearing_model.cage.common.pocket import pocket_elastic, pocket_gap, pocket_rigid, pocket_share
from bearing_model.cage.common.pocket_films import PocketFilms, pocket_films_split
from bearing_model.cage.common.pocket_spheres import SEAT, spheres_elastic, spheres_energy, spheres_rigid
from bearing_model.cage.common.spin_preload import spin_bending
from bearing_model.cage.elastic.cage_elastic import (
    cage_elastic_acceleration,
    cage_elastic_joints,
    cage_elastic_kinematics,
    cage_elastic_rivets,
    cage_elastic_speed_2,
    cage_elastic_stiffness,
)
from bearing_model.cage.elastic.cage_substeps import (
    FastState,
)
from bearing_model.cage.elastic.elastic_half import elastic_half_derive, elastic_half_rest
from bearing_model.cage.elastic.elastic_step import (
    ElasticStep,
    elastic_begin,
    elastic_end,
    elastic_slide,
    elastic_split,
)
from bearing_model.cage.elastic.rim_films import RimFilms
from bearing_model.cage.elastic.wall_loads import TOUCH
from bearing_model.cage.two_half.two_half import (
    two_half_begin,
    two_half_end,
    two_half_joints,
    two_half_loads,
    two_half_slide,
    two_half_stiffness,
)
from bearing_model.generated import variables as Y
from bearing_model.generated.variables import RETIRED_ITEMS, CageModel, Z
from bearing_model.numbers.lanes import ball_array_sum, maximum
from bearing_model.numbers.vec import vec_cross, vec_dot
from bearing_model.physics.hertz import hertz_energy, hertz_load

ROW_DP = 5


@dataclass
class CageMemory:
    """Carried from an evaluation to the next step, of the kind of cage that runs."""

    film: np.ndarray = field(default_factory=lambda: np.zeros((2, 2, 2)))  # -dF/dv of each land's film [N.s/m]
    fast: FastState = None
    films: RimFilms = field(default_factory=RimFilms)
    # squeeze velocities of the lands and shapes of bent rims [2, 6]
    squeeze: np.ndarray = field(default_factory=lambda: np.zeros((2, 6)))
    force: np.ndarray = field(default_factory=lambda: np.zeros((2, 6)))  # of the films on them
    pockets: PocketFilms = field(default_factory=PocketFilms)
    omega_2: float = 0.0  # square of the halves' speed in space


@dataclass
class CageStep:
    """Carried from cage_begin to cage_end."""

    halves: HalvesStep
    elastic: ElasticStep = None


# ------------------------------------------------------------------------------------------------------------ parameters


def cage_refusal(p, table):
    """The reason why there is no such cage, or None."""
    if p.scene.cage == CageModel.TWO_HALF:
        return None
    if p.scene.cage != CageModel.ELASTIC:
        reason = RETIRED_ITEMS["CageModel"]["rigid"][1]
        return f"scene.cage = 2: {reason}; allowed are two_half (1), elastic (3)"
    if table.modes is None:
        return "scene.cage = elastic: the rivet table has no vibration modes"
    return None


def cage_vibrates(p):
    """Whether the state has modes."""
    return p.scene.cage == CageModel.ELASTIC


def cage_derive(p, d, table):
    """Model.modes: the vibration modes of elastic halves, else None."""
    return elastic_half_derive(p, d, table) if cage_vibrates(p) else None


def cage_scales(p):
    """Error scales: of a ball's velocity along its orbit, in parts of that of velocities, because it decides how the ball meets
    its pocket, less so where walls give way; of the friction states, in deflections at which the plates slip.
    """
    return (1.0 / 4.5, 300.0) if cage_vibrates(p) else (1.0 / 6.0, 130.0)


def cage_rest(model, omega, y):
    """Puts the cage, which turns steadily with the speed omega [rad/s], into its rest under the centrifugal load: modes, and
    elastic halves as far apart as their bodies are then.
    """
    if model.modes is None:
        return
    w = model.d.centrifugal[ROW_DP] * omega**2
    P = max(model.d.P_mean + w, 0.0) + float(spin_bending(model.d.table.half, model.d.P_mean, w))
    S, (apart, _) = elastic_half_rest(model.modes, model.p.cage.m, omega**2, P)
    y[Y.MODE_S][: len(S)] = S
    beta, gamma = y[Y.CAGE_BETA][0], y[Y.CAGE_GAMMA][0]
    along = np.sqrt(1.0 - beta**2 - gamma**2), gamma, -beta
    for place, a in zip((Y.CAGE_X, Y.CAGE_Y, Y.CAGE_Z), along, strict=True):
        y[place] += 0.5 * apart * a * np.array([-1.0, 1.0])


# ------------------------------------------------------------------------------------------- one evaluation, in this order


def cage_kinematics(model, y, w):
    """Poses and velocities of the halves; coordinates of the modes."""
    halves_kinematics(model, y, w)
    if model.modes:
        cage_elastic_kinematics(model, y, w)


def cage_pockets(model, w):
    """Contacts of balls and pockets: adds to balls and halves (race_contact_force before)."""
    if model.d.spheres:
        (spheres_elastic if model.modes else spheres_rigid)(model, w)
    else:
        (pocket_elastic if model.modes else pocket_rigid)(model, w)


def cage_joints(model, y, w):
    """Forces of the joints on the halves, rates of their friction, tension of the rivets."""
    cage_joint_kinematics(model, w)
    (cage_elastic_joints if model.modes else two_half_joints)(model, y, w)


def cage_acceleration(model, y, w, y_dot):
    """Rates of all states of the cage under the forces on the halves."""
    halves_acceleration(model, y, w, y_dot)
    v = w.cage.elastic.joints.v if model.modes else w.v_j[1:]
    for row, along in zip(STATES, (*v, 0.0, 0.0), strict=True):
        y_dot[..., row] = along
    if model.modes:
        cage_elastic_acceleration(model, y, w, y_dot)


# --------------------------------------------------------------------------------- one step of the default method (verlet.py)


def cage_split(model, y, w, f):
    """Separates the part that the cage advances by itself from the rates f at the state y, where w was evaluated; returns
    it as CageMemory.
    """
    memory = CageMemory(omega_2=float(np.squeeze(cage_elastic_speed_2(w))), pockets=pocket_films_split(model, w))
    if model.modes:
        elastic_split(model, y, w, f, memory)
    return memory


def cage_begin(model, h, start, middle, y, w):
    """Before the evaluation at the end of a step of length h [s] from `start` (VerletState): sets the cage's rows of y, which has
    all other positions of the end and friction states and work of the start, to positions of the end and predicted
    velocities.  middle: the state in the middle.  Returns the CageStep.
    """
    if model.modes:
        return CageStep(*elastic_begin(model, h, start, middle, y, w))
    return CageStep(two_half_begin(model, h, start, middle, y, w))


def cage_end(model, step, start, end, error, w):
    """After it: solves for the cage's velocities, sets the cage's rows of `end` (VerletState) and `error`, and takes from the other
    rates of the evaluation the share of films that are implicit.  Returns residual and delta of the halves' velocities [12],
    excess of the balls' accelerations over those whose trapezoidal rule gives the impulses of loads on walls [3 Z], and the power of films
    beyond theirs [W].
    """
    end.cage = CageMemory(omega_2=float(np.squeeze(cage_elastic_speed_2(w))), pockets=pocket_films_split(model, w))
    if model.modes:
        return elastic_end(model, step.halves, step.elastic, start, end, error, w)
    return *two_half_end(model, step.halves, start, end, error, w), np.zeros(3 * Z), 0.0


def cage_slide(model, before, y, w):
    """Maps the friction states back at the end y of a step of another method, whose evaluation is w and whose start is `before`;
    changes y.  Returns the energy that the slip dissipates, and normal force times slip of each joint [Z] [J].
    """
    joints = JointStep(np.array([before[row] for row in STATES]))
    lost = (elastic_slide if model.modes else two_half_slide)(model, w, y, joints)
    return lost, joints.rubbed


SLOW, LEAST_PART = (
    60.0,
    1.0 / 3.0,
)  # speed of a slow cage [rad/s], part of the tolerance that it has at least, rigid halves of the step too
STIFF_GAP = 0.6  # most k Y h^2 of a step h, k: stiffness of a gap on a bent rim, Y: mobility of the rim
STIFF_CORNER = (
    0.06  # most k h^2/m, k = Q/SEAT: stiffness across a load Q near the corners of a ribbon's pocket, m: mass of a half
)
LONGEST_TURN = 2.449  # of the fastest vibration between rigid halves in a step (cage_setup.c)


def rigid_fastest(p, d):
    """Square of the frequency of the fastest vibration between rigid halves [1/s2], all joints closed and sticking."""
    r, along = 0.5 * p.bearing.d_m, Z * (d.k_rivet + d.k_plate)
    across = Z * (d.k_plate_t + np.max(d.k_hole))
    return 2.0 * max(along * max(1.0 / p.cage.m, 0.5 * r * r / d.J_t), across * max(1.0 / p.cage.m, r * r / d.J_p))


def cage_part(memory):
    """Part of the tolerance that the cage is given, rigid halves of the step too: 1, less of a slow cage."""
    return min(max(np.sqrt(memory.omega_2) / SLOW, LEAST_PART), 1.0)


def cage_longest_step(model, memory):
    """The longest step that the cage bears from its memory [s]: of rigid halves the stable one of
    their fastest vibration, of elastic halves five substeps, of a ribbon 3.5, or the time 1/A that a film of the rate A allows which does
    not follow in the substeps, or one in a pocket, or that of a stiff gap or of a ball that presses a ribbon, but two substeps at
    least.  Slow rigid halves have a part of it.
    """
    if not model.modes:
        return cage_part(memory) * LONGEST_TURN / np.sqrt(rigid_fastest(model.p, model.d))
    bent = np.trace(memory.films.rates[:, :2, :2], axis1=1, axis2=2) > 0.0
    rate, d = np.max(np.where(bent, 0.0, np.trace(memory.film, axis1=1, axis2=2))), model.modes.substep
    by_gap = np.sqrt(memory.films.stiffness * model.modes.mobility[0] / STIFF_GAP)
    films = (2.0, rate / model.p.cage.m), (2.0, memory.pockets.rate), (2.0, by_gap)
    if model.d.spheres:
        Q = max(np.max(touch[TOUCH.index("Q")]) for touch in memory.fast.touch)
        films += ((1.0, np.sqrt(Q / (STIFF_CORNER * model.p.cage.m * SEAT))),)
    return min(model.modes.longest_step, *(max(n * d, 1.0 / A if A > 0.0 else np.inf) for n, A in films))


# ------------------------------------------------------------------------------------------------- read from an evaluation


def cage_loads(model, w):
    """JointLoads of all joints, of which the stress table takes those of the rivets."""
    return (cage_elastic_rivets if model.modes else two_half_loads)(model, w)


def joints_in_plane(model, w):
    """Offsets (y, z) [2, ..., Z] of the joints in the plane [m], and their stiffnesses."""
    if model.modes:
        return w.cage.elastic.joints.u, cage_elastic_stiffness(model)
    return w.u[1:], two_half_stiffness(model.d)


def cage_slip(model, w):
    """Slip of half 1 against half 0 at each joint, in the plane [m]."""
    return np.hypot(*joints_in_plane(model, w)[0])


def pocket_energy(model, w):
    """Elastic energy of all pockets [J], [..., Z]; of elastic walls also that in their compliance, beside their modes."""
    d, E = model.d, 0.0
    if d.spheres:
        return spheres_energy(model, w)
    for h, delta in enumerate(w.delta_c):
        load, energy, _ = pocket_share(d, h, pocket_gap(model, w, h).n_x, delta)
        E = E + energy * hertz_energy(d.pocket.K, delta)
        if model.modes:
            Q = load * hertz_load(d.pocket.K, delta)
            E = E + 0.5 * model.modes.compliance * Q * Q
    return E


def joint_energy(model, y, w):
    """Elastic energy of the joints [J], [..., Z]: out of the plane, friction states and holes."""
    d, (u, k) = model.d, joints_in_plane(model, w)
    if model.modes:  # of the joints, and of the halves around them beside their modes
        j = w.cage.elastic.joints
        axial = 2.0 * (0.5 * np.sum(j.e * j.trial, axis=0) - j.U)
    else:
        axial = 0.5 * (w.cage.two_half.pull**2 / d.k_rivet + w.cage.two_half.push**2 / d.k_plate)
    y_2 = [y[..., row] ** 2 for row in STATES]
    bearing = maximum(np.sqrt(u[0] * u[0] + u[1] * u[1] + 1e-30) - d.hole_gap, 0.0)
    in_plane = k.stick * (y_2[0] + y_2[1]) + k.head * (y_2[2] + y_2[3]) + k.hole * bearing**2
    return axial + 0.5 * in_plane


def cage_energy(model, y, w):
    """Kinetic energy of the halves, elastic energy of pockets, joints and modes [J] by name, each [..., 1]."""
    p, d, motion = model.p, model.d, 0.0
    for half in w.half:
        v = half.v + vec_cross(half.Omega, half.c)  # of the centre of mass
        motion = motion + 0.5 * (p.cage.m * vec_dot(v, v) + d.J_t * vec_dot(half.a_dot, half.a_dot) + d.J_p * half.s**2)
    terms = {
        "motion of the cage": motion,
        "pockets, elastic": ball_array_sum(pocket_energy(model, w)),
        "joints, elastic": ball_array_sum(joint_energy(model, y, w)),
    }
    return terms | {"modes of the cage": w.cage.elastic.energy} if model.modes else terms


def cage_widened(w):
    """Work of a turning frame's centrifugal load, which has widened the halves [J].  Of the modes' powers this one
    counts as a potential, because modes turn by much more than pi in a step.
    """
    return 0.5 * sum(w.cage.elastic.more_J) * w.frame_omega**2


def cage_widening(w, frame_omega_dot):
    """Rate of cage_widened [W]."""
    J, J_dot = sum(w.cage.elastic.more_J), sum(w.cage.elastic.more_J_dot)
    return w.frame_omega * (0.5 * J_dot * w.frame_omega + J * frame_omega_dot)


def cage_drawn(w, frame_omega_dot):
    """Power that the frame's angular acceleration draws from the moment of inertia that the halves have gained by widening [W]."""
    gained = zip(w.cage.elastic.more_J, w.half, strict=True)
    return sum(more_J * frame_omega_dot * (half.s + w.frame_omega) for more_J, half in gained)


def cage_losses(model, w):
    """Powers that the damping of joints and modes dissipates [W] by name, each [..., 1].  The loss by friction is no function
    of a state: it is the work of a step's slip (cage_slide).
    """
    return {"modes": w.cage.elastic.dissipated} if model.modes else {"joints": w.cage.two_half.dissipated}


def cage_flex(model, w, h):
    """Motions (x, r, t) [3, ..., Z] of half h at the rivets by its modes [m]; half 0 is the mirror image of half 1."""
    if not model.modes:
        return np.zeros((3, *w.x.shape))
    side = 1.0 if h == 1 else -1.0
    return np.einsum("c,...i,ick->c...k", [side, 1.0, 1.0], w.cage.elastic.q[h][..., 0, :], model.modes.pad[:, :3])
