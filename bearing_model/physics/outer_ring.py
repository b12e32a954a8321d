"""The outer ring's motion: a rigid body that moves as the inputs housing.* say.

Laws between a body and the outer ring are those of a ring at rest in the frame that moves with the ring: velocities are
taken against v + Omega x (P - x), forces and powers follow.
"""

import numpy as np

from bearing_model.numbers.vec import vec_cross, vec_local
from bearing_model.physics.rotor import Rotor, rotor_axis, rotor_body_axes


def spread(values, like):
    """Numbers or arrays [..., 1] as one array with an axis of length 1 at the end and the leading axes of `like`."""
    return np.array([value + 0.0 * like[..., :1] for value in values])


def outer_ring(ring_load, like):
    """Place, axis and motion of the outer ring; vectors [3, ..., 1], leading axes as those of `like`."""
    ring = Rotor(x=spread(ring_load.outer_x, like), v=spread(ring_load.outer_v, like))
    tilt = (ring_load.outer_beta, ring_load.outer_gamma, ring_load.outer_beta_dot, ring_load.outer_gamma_dot)
    rotor_axis(ring, *spread((*tilt, ring_load.outer_omega), like))
    rotor_body_axes(ring, 1.0 + 0.0 * ring.s, 0.0 * ring.s)
    return ring


def outer_ring_velocity(ring, p, cos_theta, sin_theta):
    """Velocity of the outer ring's material at the points p, seen from the balls' frames."""
    x, v, Omega = (vec_local(value, cos_theta, sin_theta) for value in (ring.x, ring.v, ring.Omega))
    return v + vec_cross(Omega, p - x)
