"""How balls approach a half of the cage along given directions, both as rigid bodies: the readable twin of rigid_approach.c."""

import numpy as np

from bearing_model.generated import variables as Y


def rigid_approach(model, gamma, direction, f, state, y, half, h, k):
    """Rate [m/s] in the middle of a step and acceleration [m/s2] of ball k against half h along a direction (x, r, t) of the pocket's axes,
    both as rigid bodies; motion along it by those of the half [6]; the direction along x, r, t of the ball [3].

    f: rates at the step's start; state: velocities in its middle; y: positions at its end; half: in the middle.
    """
    (v_x, v_r, omega), (a_x, f_r, f_t) = (
        [rows[block][k] for block in (Y.BALL_V_X, Y.BALL_V_R, Y.BALL_OMEGA_M)] for rows in (state, f)
    )
    r, theta = y[Y.BALL_R][k] - gamma * v_r, y[Y.BALL_THETA][k] - gamma * omega
    e_x, e_r = np.array([1.0, 0.0, 0.0]), np.array([0.0, np.cos(theta), np.sin(theta)])
    e_t = np.cross(e_x, e_r)
    a, b_y, b_z, x, v, c, Omega = (getattr(half, name)[:, 0] for name in ("a", "b_y", "b_z", "x", "v", "c", "Omega"))
    cosine, sine = model.d.pocket_cos[k], model.d.pocket_sin[k]
    n = direction[0] * a + direction[1] * (cosine * b_y + sine * b_z) + direction[2] * (cosine * b_z - sine * b_y)
    p = (y[Y.BALL_X][k] - gamma * v_x) * e_x + r * e_r - x
    turn = np.array([f[block][h] for block in (Y.CAGE_S, Y.CAGE_BETA_DOT, Y.CAGE_GAMMA_DOT)])
    by_half = np.array([f[block][h] for block in (Y.CAGE_V_X, Y.CAGE_V_Y, Y.CAGE_V_Z)])
    by_half = by_half + np.cross(turn, p - c) + np.cross(Omega, np.cross(Omega, p - c))
    by_ball = a_x * e_x + (f_r - r * omega**2) * e_r + (r * f_t + 2.0 * v_r * omega) * e_t
    rate = n @ (v_x * e_x + v_r * e_r + r * omega * e_t - v - np.cross(Omega, p))
    lever = np.cross(p - c, n)
    return (
        rate,
        n @ (by_ball - by_half),
        np.concatenate([n, lever[1:], lever[:1]]),
        np.array([n @ e_x, n @ e_r, n @ e_t]),
    )
