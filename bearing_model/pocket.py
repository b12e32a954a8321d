"""Ball and pocket: a cylinder with a radial axis, cut by the split plane into the two halves.

         x (a)                      a     axis of the half         p = ball centre - geometric centre of the half
         |   half 1                 e_t   its tangent at pocket j  (x, t) = (p.a, p.e_t): ball against the pocket's axis
      .--+--.                       S = sqrt(x^2 + t^2),  n = (x, t)/S
     (   |n->)---- t (e_t)          delta = S - (R_c - R)                                                  Cui et al. (2023)
      '--+--'                       V = w(n_x) (2/5) K delta^2.5,  w = (1 +- n_x/sqrt(n_x^2 + width^2))/2  share of this half
         |   half 0                 force on the ball: -dV/d(x, t), damping -(K w delta^1.5) lambda delta_dot n, Coulomb friction mu Q

Both halves share one contact energy, so the force has a part along the gradient of the share; without it energy is not conserved.
Friction P_S at the contact point p + R n with the slip v + omega x R n; the coefficient goes from that of the film to that of the
asperities by Lambda (mixed lubrication); P_R and its horizontal counterpart are the inlet's rolling friction as in the races, with the
mean speed |slip|/2 and R_x = R.  The half gets the opposite forces at the same points.
Smoothness: C1 at touch-down.  The cylinder has no radial end: a ball whose equator leaves the cage's section is reported, not modelled.
"""

import numpy as np

from bearing_model.hertz import hertz_damped, hertz_energy, hertz_load
from bearing_model.lanes import ball_array_sum, maximum
from bearing_model.traction import Q_FLOOR, traction_asperity_share, traction_inlet, traction_ln_film
from bearing_model.variables import CageModel, Lubrication
from bearing_model.vec import vec, vec_across, vec_cross, vec_dot, vec_local, vec_to_global


def pocket_mu(model, ln_U, ln_Q, mixed):
    """Friction coefficient at mean speed U and load Q.  Film: the thicker one of piezoviscous and isoviscous-rigid lubrication."""
    film = model.p.cage.mu
    if not mixed:
        return film
    ln_piezo = traction_ln_film(model.d.ln_pocket_piezo, ln_U, ln_Q)
    ln_rigid = model.d.ln_pocket_rigid + 2.0 * (ln_U - ln_Q)
    return film + traction_asperity_share(maximum(ln_piezo, ln_rigid)) * (model.p.oil.mu_b - film)


def pocket_share(model, n_x, h, whole):
    """Part of the contact that half h carries, and its slope over n_x; whole: the rigid cage carries all."""
    if whole:
        return 1.0, 0.0
    side, width2 = 2 * h - 1, model.p.cage.share_width**2
    root = np.sqrt(n_x * n_x + width2)
    return 0.5 * (1.0 + side * n_x / root), 0.5 * side * width2 / root**3


def pocket_half(model, w, h, mixed, whole):
    """The contact with one half (or the whole rigid cage), added to F, M of the balls."""
    p, d, half = model.p, model.d, w.half[h]

    # Direction of pocket j: body angle phi_j turned by the half, b = b_y cos phi + b_z sin phi, e_t = a x b.
    a, b_y, b_z, x_h, v_h, Omega = (vec_local(v, w.cos_theta, w.sin_theta) for v in (half.a, half.b_y, half.b_z, half.x, half.v, half.Omega))
    b = d.pocket_cos * b_y + d.pocket_sin * b_z
    e_t = vec_cross(a, b)
    arm_p = vec(w.x, w.r, 0.0) - x_h
    x, t = vec_dot(arm_p, a), vec_dot(arm_p, e_t)
    S = np.sqrt(x * x + t * t + 1e-30)  # a centred ball has no direction
    delta = S - (d.pocket_radius - d.R)

    omega_b, v_b = vec(w.omega_x, w.omega_r, w.omega_t), vec(w.v_x, w.v_r, w.v_t)
    v = v_b - v_h - vec_cross(Omega, arm_p)
    n_x, n_t = x / S, t / S
    n = n_x * a + n_t * e_t
    delta_dot = vec_dot(n, v)

    share, share_slope = pocket_share(model, n_x, h, whole)
    Q_0 = share * hertz_load(d.pocket.K, delta)
    Q = hertz_damped(Q_0, p.cage.lambda_, delta_dot)
    F_across = hertz_energy(d.pocket.K, delta) * share_slope * n_t / S  # -dV/dn_x grad n_x, grad n_x = (n_t a - n_x e_t) n_t / S
    F_n = -Q * n - F_across * (n_t * a - n_x * e_t)

    arm = d.R * n
    slip = vec_across(v + vec_cross(omega_b - Omega, arm), n)
    slip_2 = vec_dot(slip, slip)
    U = np.sqrt(0.25 * slip_2 + p.oil.U_0**2)
    ln_U, ln_Q = np.log(U), np.log(Q + Q_FLOOR)
    g = pocket_mu(model, ln_U, ln_Q, mixed) * Q / np.sqrt(slip_2 + p.cage.v_c**2)
    g_R = 0.5 * traction_inlet(d.pocket_rolling, ln_U, Q, ln_Q) / U
    F_s = -(g + g_R) * slip
    F_c = 2.0 * g_R * slip
    F, M = F_n + F_s + F_c, vec_cross(arm, F_s)

    w.F = w.F + F
    w.M = w.M + M
    w.pocket_dissipated = w.pocket_dissipated + (Q - Q_0) * delta_dot - vec_dot(F_s, slip) - vec_dot(F_c, v)
    w.pocket_F[h] = vec_to_global(-F, w.cos_theta, w.sin_theta)
    w.pocket_M[h] = vec_to_global(-vec_cross(arm_p, F) - M, w.cos_theta, w.sin_theta)
    w.pocket[h] = np.array([-vec_dot(F, a), -vec_dot(F, b), -vec_dot(F, e_t)])
    half.F, half.M = ball_array_sum(w.pocket_F[h]), ball_array_sum(w.pocket_M[h])
    w.delta_c[h], w.Q_c[h] = delta, Q
    w.pocket_energy = w.pocket_energy + share * hertz_energy(d.pocket.K, delta)


def pocket_force(model, w):
    """Adds the pocket contacts to the balls; sets their results and wrench on the halves.

    pocket: force on the half in the pocket's frame (x, r, t); pocket_F, pocket_M: force and moment about the half's centre, global.
    """
    mixed, rigid = model.p.scene.lubrication == Lubrication.MIXED, model.p.scene.cage == CageModel.RIGID
    w.delta_c, w.Q_c, w.pocket, w.pocket_F, w.pocket_M = {}, {}, {}, {}, {}  # by half
    w.pocket_energy, w.pocket_dissipated = 0.0, 0.0
    if rigid:
        pocket_half(model, w, 0, mixed, True)
        w.half[1].F, w.half[1].M = 0.0 * w.half[0].F, 0.0 * w.half[0].M
    else:
        for h in range(2):
            pocket_half(model, w, h, mixed, False)
    w.Q_pocket = sum(w.Q_c.values())  # of both halves together
