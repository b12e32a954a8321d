"""A ball in its cylindrical frame (x, r, t), azimuth theta, orbital speed omega_m = theta_dot, angular velocity omega:

    m x''                         = F_x            J omega_x' = M_x
    m (r'' - r omega_m^2)         = F_r            J omega_r' = M_r + J omega_m omega_t
    m (r omega_m' + 2 r' omega_m) = F_t            J omega_t' = M_t - J omega_m omega_r

Beside the forces acts the field of gravity and of the frame's acceleration (frame.py).  In a frame that turns at
omega_f all of them hold with omega_m + omega_f on the right, and omega_f' is taken from omega_m' and omega_x'.

Gupta (1979), J. Lubr. Technol. 101, 293.  The last terms on the right are the gyroscopic moments:
they arise because the frame turns with the orbit; the sphere itself needs no orientation.
"""

import numpy as np

from bearing_model.generated import variables as Y


def ball_kinematics(y, w):
    """Positions and velocities of the balls, from the state."""
    w.x, w.r, w.theta = y[..., Y.BALL_X], y[..., Y.BALL_R], y[..., Y.BALL_THETA]
    w.v_x, w.v_r, w.omega_m = y[..., Y.BALL_V_X], y[..., Y.BALL_V_R], y[..., Y.BALL_OMEGA_M]
    w.omega_x, w.omega_r, w.omega_t = y[..., Y.BALL_OMEGA_X], y[..., Y.BALL_OMEGA_R], y[..., Y.BALL_OMEGA_T]
    w.cos_theta, w.sin_theta = np.cos(w.theta), np.sin(w.theta)
    w.v_t = w.r * w.omega_m


def ball_acceleration(model, w, y_dot):
    """Equations of motion under the total forces and moments."""
    m, J, frame = model.d.m, model.d.J, model.ring_load
    (g_x, g_y, g_z), omega_m = frame.field, w.omega_m + frame.frame_omega  # omega_m: in the fixed frame
    y_dot[..., Y.BALL_X] = w.v_x
    y_dot[..., Y.BALL_R] = w.v_r
    y_dot[..., Y.BALL_THETA] = w.omega_m
    y_dot[..., Y.BALL_V_X] = w.F[0] / m + g_x
    y_dot[..., Y.BALL_V_R] = w.F[1] / m + g_y * w.cos_theta + g_z * w.sin_theta + w.r * omega_m**2
    y_dot[..., Y.BALL_OMEGA_M] = (
        w.F[2] / m + g_z * w.cos_theta - g_y * w.sin_theta - 2.0 * w.v_r * omega_m
    ) / w.r - frame.frame_omega_dot
    y_dot[..., Y.BALL_OMEGA_X] = w.M[0] / J - frame.frame_omega_dot
    y_dot[..., Y.BALL_OMEGA_R] = w.M[1] / J + omega_m * w.omega_t
    y_dot[..., Y.BALL_OMEGA_T] = w.M[2] / J - omega_m * w.omega_r
