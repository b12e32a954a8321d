"""Inner ring: translation, two tilts, prescribed speed.

    free        m x'' = F_shaft + F_impact + F_contacts - c (x' - x_e') + m g   (the paper's equation; the load is given on the ring,
                x_e: outer ring, g: gravity and the frame's inertia forces)
    prescribed  the motion is given: its states are not integrated
    tilt: prescribed  beta'' = (beta_shaft - beta)/tau^2 - 2 beta'/tau, gamma likewise: critically damped
          supported   M = k_tilt (shaft - ring) - c_tilt (rates against the outer ring) + shaft.M
          free        M = shaft.M only
          supported and free include the gyroscopic moment of the spin (rotor.py) and the moment of a frame that turns
          (frame.py)

Forces and moments are in the global frame.
"""

import numpy as np

from bearing_model.generated import variables as Y
from bearing_model.generated.variables import RingMotion, TiltMode
from bearing_model.physics.frame import frame_acceleration, frame_moment
from bearing_model.physics.outer_ring import spread
from bearing_model.physics.rotor import Rotor, rotor_acceleration, rotor_axis


def ring_kinematics(model, y, w):
    """Pose and velocity of the ring from y, or as its motion is prescribed."""
    ring, given, like = Rotor(), model.ring_load, y[..., Y.RING_X]
    if model.p.ring.motion == RingMotion.PRESCRIBED:
        ring.x, ring.v = spread(given.x, like), spread(given.v, like)
        rotor_axis(ring, *spread((given.beta, given.gamma, given.beta_dot, given.gamma_dot), like), given.omega)
    else:
        ring.x = np.array([y[..., Y.RING_X], y[..., Y.RING_Y], y[..., Y.RING_Z]])
        ring.v = np.array([y[..., Y.RING_V_X], y[..., Y.RING_V_Y], y[..., Y.RING_V_Z]])
        tilt = (y[..., block] for block in (Y.RING_BETA, Y.RING_GAMMA, Y.RING_BETA_DOT, Y.RING_GAMMA_DOT))
        rotor_axis(ring, *tilt, given.omega)
    w.ring = ring


def ring_acceleration(model, w, y_dot):
    """Acceleration of the ring: y_dot of its states from the wrench of all contacts."""
    p, ring_load, ring = model.p, model.ring_load, w.ring
    field = frame_acceleration(ring_load, ring.x, ring.v)
    beta, gamma, beta_dot, gamma_dot = -ring.a[2], ring.a[1], -ring.a_dot[2], ring.a_dot[1]
    for i, (X, V) in enumerate(((Y.RING_X, Y.RING_V_X), (Y.RING_Y, Y.RING_V_Y), (Y.RING_Z, Y.RING_V_Z))):
        y_dot[..., X] = ring.v[i]
        y_dot[..., V] = (ring_load.F[i] + ring.F[i] - p.ring.c * (ring.v[i] - ring_load.outer_v[i])) / p.ring.m + field[
            i
        ]
    y_dot[..., Y.RING_BETA] = beta_dot
    y_dot[..., Y.RING_GAMMA] = gamma_dot
    if p.ring.motion == RingMotion.PRESCRIBED:
        for V in (Y.RING_V_X, Y.RING_V_Y, Y.RING_V_Z, Y.RING_BETA_DOT, Y.RING_GAMMA_DOT):
            y_dot[..., V] = 0.0
        return
    if p.ring.tilt_mode == TiltMode.PRESCRIBED:
        rate = 1.0 / p.ring.tilt_time
        y_dot[..., Y.RING_BETA_DOT] = ((ring_load.beta - beta) * rate - 2.0 * beta_dot) * rate
        y_dot[..., Y.RING_GAMMA_DOT] = ((ring_load.gamma - gamma) * rate - 2.0 * gamma_dot) * rate
        return
    M = np.array([ring.M[0], ring.M[1] + ring_load.M[0], ring.M[2] + ring_load.M[1]])
    if p.ring.tilt_mode == TiltMode.SUPPORTED:
        M[1] += p.ring.k_tilt * (ring_load.beta - beta) - p.ring.c_tilt * (beta_dot - ring_load.outer_beta_dot)
        M[2] += p.ring.k_tilt * (ring_load.gamma - gamma) - p.ring.c_tilt * (gamma_dot - ring_load.outer_gamma_dot)
    M = M + frame_moment(ring_load, ring, p.ring.J_p, p.ring.J_t)
    a_ddot, _ = rotor_acceleration(ring, p.ring.J_p, p.ring.J_t, M)  # the shaft holds the speed
    y_dot[..., Y.RING_BETA_DOT] = -a_ddot[2]
    y_dot[..., Y.RING_GAMMA_DOT] = a_ddot[1]
