"""The table of contents of the physics: one evaluation of dy/dt in named steps."""

import numpy as np

from bearing_model.cage.common.cage_joint import cage_joint_force, cage_joint_kinematics
from bearing_model.cage.common.pocket import pocket_force
from bearing_model.cage.elastic.cage_elastic import (
    cage_elastic_acceleration,
    cage_elastic_coriolis,
    cage_elastic_energy,
    cage_elastic_joints,
    cage_elastic_kinematics,
    cage_elastic_pads,
)
from bearing_model.generated.variables import (
    CAGE_BETA,
    CAGE_BETA_DOT,
    CAGE_GAMMA,
    CAGE_GAMMA_DOT,
    CAGE_PSI,
    CAGE_S,
    CAGE_V_X,
    CAGE_V_Y,
    CAGE_V_Z,
    CAGE_X,
    CAGE_Y,
    CAGE_Z,
    JOINT_HEAD_Y,
    JOINT_HEAD_Z,
    JOINT_PLATE_Y,
    JOINT_PLATE_Z,
    RING_BETA,
    RING_BETA_DOT,
    RING_GAMMA,
    RING_GAMMA_DOT,
    RING_V_X,
    RING_V_Y,
    RING_V_Z,
    RING_X,
    RING_Y,
    RING_Z,
    WORK,
    CageModel,
    RingMotion,
)
from bearing_model.instance.energy import net_power
from bearing_model.numbers.vec import vec_cross
from bearing_model.physics.ball import ball_acceleration, ball_kinematics
from bearing_model.physics.drag import drag_cage, drag_force, drag_mixture, drag_ring
from bearing_model.physics.frame import frame_acceleration, frame_moment
from bearing_model.physics.land_film import land_film_force
from bearing_model.physics.model import Work
from bearing_model.physics.outer_ring import spread
from bearing_model.physics.race_contact import race_contact_force
from bearing_model.physics.ring import ring_acceleration
from bearing_model.physics.rotor import Rotor, rotor_acceleration, rotor_axis, rotor_body_axes, rotor_roll

CAGE_PLACE = ((CAGE_X, CAGE_V_X), (CAGE_Y, CAGE_V_Y), (CAGE_Z, CAGE_V_Z))


def of_half(y, block, h):
    """The entry of half h in a block of the state, with an axis of length 1."""
    return y[..., block][..., h : h + 1]


def rotor_kinematics(model, y, w):
    """Pose and velocity of inner ring and cage halves from y.  A half's states are those of its centre of mass."""
    w.ring, w.half = Rotor(), [Rotor(), Rotor()]
    given, like = model.ring_load, y[..., RING_X]
    w.outer_x, w.frame_omega = spread(given.outer_x, like), given.frame_omega  # for what is recorded over steps
    w.outer_gamma, w.outer_beta = given.outer_gamma, given.outer_beta
    if model.p.ring.motion == RingMotion.PRESCRIBED:
        w.ring.x, w.ring.v = spread(given.x, like), spread(given.v, like)
        rotor_axis(w.ring, *spread((given.beta, given.gamma, given.beta_dot, given.gamma_dot), like), given.omega)
    else:
        w.ring.x = np.array([y[..., RING_X], y[..., RING_Y], y[..., RING_Z]])
        w.ring.v = np.array([y[..., RING_V_X], y[..., RING_V_Y], y[..., RING_V_Z]])
        rotor_axis(
            w.ring, y[..., RING_BETA], y[..., RING_GAMMA], y[..., RING_BETA_DOT], y[..., RING_GAMMA_DOT], given.omega
        )
    for h, half in enumerate(w.half):
        rotor_axis(
            half, *(of_half(y, block, h) for block in (CAGE_BETA, CAGE_GAMMA, CAGE_BETA_DOT, CAGE_GAMMA_DOT, CAGE_S))
        )
        psi = of_half(y, CAGE_PSI, h)
        rotor_body_axes(half, np.cos(psi), np.sin(psi))
        half.c = model.d.com_x[h] * half.a + model.d.com_e * half.b_y
        half.x = np.array([of_half(y, X, h) for X, _ in CAGE_PLACE]) - half.c
        half.v = np.array([of_half(y, V, h) for _, V in CAGE_PLACE]) - vec_cross(half.Omega, half.c)
    if model.p.scene.cage == CageModel.RIGID:  # half 1 moves with half 0
        h0 = w.half[0]
        w.half[1] = Rotor(**vars(h0))
        w.half[1].c = model.d.com_x[1] * h0.a + model.d.com_e * h0.b_y


def half_rates(y, half, h, acc, a_ddot, s_dot, y_dot):
    """Set y_dot of half h from the accelerations of its centre of mass (acc), of its axis (a_ddot) and of its spin
    (s_dot).
    """
    for i, (X, V) in enumerate(CAGE_PLACE):
        of_half(y_dot, X, h)[...] = of_half(y, V, h)
        of_half(y_dot, V, h)[...] = acc[i]
    of_half(y_dot, CAGE_BETA, h)[...] = of_half(y, CAGE_BETA_DOT, h)
    of_half(y_dot, CAGE_GAMMA, h)[...] = of_half(y, CAGE_GAMMA_DOT, h)
    of_half(y_dot, CAGE_PSI, h)[...] = half.s - rotor_roll(half)
    of_half(y_dot, CAGE_BETA_DOT, h)[...] = -a_ddot[2]
    of_half(y_dot, CAGE_GAMMA_DOT, h)[...] = a_ddot[1]
    of_half(y_dot, CAGE_S, h)[...] = s_dot


def cage_acceleration(model, y, w, y_dot):
    """Both halves under their forces, or as one rigid body about their common centre of mass."""
    p, d = model.p, model.d
    frame = model.ring_load
    if p.scene.cage != CageModel.RIGID:
        for h, half in enumerate(w.half):
            s, v = half.x + half.c, half.v + vec_cross(half.Omega, half.c)  # of the centre of mass
            M = half.M - vec_cross(half.c, half.F) + frame_moment(frame, half, d.J_p, d.J_t)
            if p.scene.cage == CageModel.ELASTIC:  # what widens takes spin
                M = M - cage_elastic_coriolis(model, w, h) * half.a
            a_ddot, s_dot = rotor_acceleration(half, d.J_p, d.J_t, M)
            if p.scene.cage == CageModel.ELASTIC:
                s_dot = s_dot * d.J_p / (d.J_p + w.more_J[h])
            half_rates(y, half, h, half.F / p.cage.m + frame_acceleration(frame, s, v), a_ddot, s_dot, y_dot)
        return
    cage = w.half[0]
    J_t = 2.0 * (d.J_t + p.cage.m * d.com_x[1] ** 2)
    F = w.half[0].F + w.half[1].F
    c = d.com_e * cage.b_y  # the common centre of mass, at which gravity and the frame's inertia forces act
    M = w.half[0].M + w.half[1].M - vec_cross(c, F) + frame_moment(frame, cage, 2.0 * d.J_p, J_t)
    field = frame_acceleration(frame, cage.x + c, cage.v + vec_cross(cage.Omega, c))
    a_ddot, s_dot = rotor_acceleration(cage, 2.0 * d.J_p, J_t, M)
    spin_up = vec_cross(cage.a, a_ddot) + s_dot * cage.a + cage.s * cage.a_dot  # rate of Omega
    for h in range(2):
        c = d.com_x[h] * cage.a
        acc = F / (2.0 * p.cage.m) + field + vec_cross(spin_up, c) + vec_cross(cage.Omega, vec_cross(cage.Omega, c))
        half_rates(y, cage, h, acc, a_ddot, s_dot, y_dot)


def rhs(model, t, y, w=None):
    """dy/dt at time t [s], one for all states or one for each.

    y: state [..., N_STATES], of elastic halves N_ALL_STATES, offsets in variables.py; leading axes are independent
    states, complex values carry derivatives. w: a Work that keeps all results, if given.
    """
    if y.shape[-1] != len(model.d.scale):
        raise ValueError(f"y has {y.shape[-1]} states; {len(model.d.scale)} are needed")
    w = Work() if w is None else w
    model = model.at(t)
    rigid, elastic = (model.p.scene.cage == kind for kind in (CageModel.RIGID, CageModel.ELASTIC))
    ball_kinematics(y, w)
    rotor_kinematics(model, y, w)
    race_contact_force(model, w)
    if elastic:
        cage_elastic_kinematics(model, y, w)
    pocket_force(model, w)
    drag_mixture(model, w)
    drag_force(model, w)
    drag_ring(model, w)
    land_film_force(model, w)
    drag_cage(model, w)
    if not rigid:
        cage_joint_kinematics(model, w)
        if elastic:
            cage_elastic_pads(model, w)
            cage_elastic_joints(model, y, w)
        cage_joint_force(model, y, w)
    y_dot = np.zeros_like(y)
    ball_acceleration(model, w, y_dot)
    cage_acceleration(model, y, w, y_dot)
    ring_acceleration(model, w, y_dot)
    if not rigid:
        y_dot[..., JOINT_PLATE_Y] = w.plate_y_dot
        y_dot[..., JOINT_PLATE_Z] = w.plate_z_dot
        y_dot[..., JOINT_HEAD_Y] = w.head_y_dot
        y_dot[..., JOINT_HEAD_Z] = w.head_z_dot
    if elastic:
        cage_elastic_acceleration(model, y, w, y_dot)
    w.modes_energy = cage_elastic_energy(model, y, w) if elastic else 0.0
    y_dot[..., WORK] = net_power(model, w)
    return y_dot


def jacobian(model, t, y):
    """d(dy/dt)/dy [states, states], exact to rounding: complex steps in all directions at once."""
    step = 1e-30
    return np.imag(rhs(model, t, y + 1j * step * np.eye(len(y)))).T / step
