"""The table of contents of the physics: one evaluation of dy/dt in named steps."""

import numpy as np

from bearing_model.cage.cage import cage_acceleration, cage_joints, cage_kinematics, cage_pockets
from bearing_model.generated.variables import CAGE_S, RING_X, WORK
from bearing_model.physics.ball import ball_acceleration, ball_kinematics
from bearing_model.physics.drag import drag_cage, drag_force, drag_mixture, drag_ring
from bearing_model.physics.land_film import land_film_force
from bearing_model.physics.model import Work
from bearing_model.physics.outer_ring import spread
from bearing_model.physics.powers import net_power
from bearing_model.physics.race_contact import race_contact_force
from bearing_model.physics.ring import ring_acceleration, ring_kinematics


def rhs(model, t, y, w=None):
    """dy/dt at time t [s], one for all states or one for each.

    y: state [..., N_STATES], of halves that vibrate N_ALL_STATES, offsets in variables.py; leading axes are independent
    states, complex values carry derivatives. w: a Work that keeps all results, if given.
    """
    if y.shape[-1] != len(model.d.scale):
        raise ValueError(f"y has {y.shape[-1]} states; {len(model.d.scale)} are needed")
    w = Work() if w is None else w
    model = model.at(t)
    given = model.ring_load
    w.outer_x, w.frame_omega = spread(given.outer_x, y[..., RING_X]), given.frame_omega
    w.outer_gamma, w.outer_beta = given.outer_gamma, given.outer_beta
    ball_kinematics(y, w)
    ring_kinematics(model, y, w)
    cage_kinematics(model, y, w)
    race_contact_force(model, w)
    cage_pockets(model, w)
    drag_mixture(model, w)
    drag_force(model, w)
    drag_ring(model, w)
    land_film_force(model, w)
    drag_cage(model, w)
    cage_joints(model, y, w)
    y_dot = np.zeros_like(y)
    ball_acceleration(model, w, y_dot)
    cage_acceleration(model, y, w, y_dot)
    ring_acceleration(model, w, y_dot)
    w.cage_spin_dot = y_dot[..., CAGE_S] + given.frame_omega_dot
    y_dot[..., WORK] = net_power(model, w)
    return y_dot


def jacobian(model, t, y):
    """d(dy/dt)/dy [states, states], exact to rounding: complex steps in all directions at once."""
    step = 1e-30
    return np.imag(rhs(model, t, y + 1j * step * np.eye(len(y)))).T / step
