"""Ball and pocket: a cylinder with a radial axis, cut by the split plane into the two halves.

         x (a)                      a     axis of the half         p = ball centre - geometric centre of the half
         |   half 1                 e_t   its tangent at pocket j  (x, t) = (p.a, p.e_t): ball against the pocket's axis
      .--+--.                       S = sqrt(x^2 + t^2),  n = (x, t)/S
     (   |n->)---- t (e_t)          delta = S - (R_c - R)                                                  Cui et al. (2023)
      '--+--'                       V = e(xi) (2/5) K delta^2.5,  xi = +- n_x R_c/a, at most 1: split plane against the patch, a = a_delta delta^0.5
         |   half 0                 force on the ball: -dV/d(x, t), damping -(w K delta^1.5) lambda delta_dot n, Coulomb friction mu Q

A half bears the part of the Hertz pressure on its side of the split plane, which cuts the contact ellipse across its
long half axis a:
    w = 1/2 + 3/4 xi - 1/4 xi^3,  e = 1/2 + 15/16 xi - 5/8 xi^3 + 3/16 xi^5
w: the pressure sqrt(1 - (x/a)^2 - (y/b)^2) summed over y leaves 1 - (x/a)^2 along x.  e: the work of pressing the half
in, of w K delta^1.5 over delta at its place; so -dV/d(delta) is w K delta^1.5, and both halves together store and bear
what one contact does.  The slope of V along the wall is a force across n that pushes the halves apart; without this
force energy would not be conserved. Friction P_S at the contact point p + R n with the slip v + omega x R n; the
coefficient goes from that of the film to that of the asperities by Lambda (mixed lubrication); P_R and its horizontal
counterpart are the inlet's rolling friction as in the races, with the mean speed |slip|/2 and R_x = R.  The half gets
the opposite forces at the same points. Smoothness: C1 at touch-down and where the patch leaves a half.  The cylinder
has no radial end: a ball whose equator leaves the cage's section is reported, not modelled.
"""

import numpy as np

from bearing_model.cage.elastic.cage_elastic import cage_elastic_approach, cage_elastic_walls
from bearing_model.generated.variables import CageModel, Lubrication
from bearing_model.numbers.lanes import ball_array_sum, maximum, minimum
from bearing_model.numbers.vec import vec, vec_across, vec_cross, vec_dot, vec_local, vec_to_global
from bearing_model.physics.hertz import hertz_damped, hertz_energy, hertz_load
from bearing_model.physics.traction import Q_FLOOR, traction_asperity_share, traction_inlet, traction_ln_film


def pocket_mu(model, ln_U, ln_Q, mixed):
    """Friction coefficient at mean speed U and load Q.  Film: the thicker one of piezoviscous and isoviscous-rigid
    lubrication.
    """
    film = model.p.cage.mu
    if not mixed:
        return film
    ln_piezo = traction_ln_film(model.d.ln_pocket_piezo, ln_U, ln_Q)
    ln_rigid = model.d.ln_pocket_rigid + 2.0 * (ln_U - ln_Q)
    return film + traction_asperity_share(maximum(ln_piezo, ln_rigid)) * (model.p.oil.mu_b - film)


def pocket_share(d, h, n_x, delta):
    """Parts w of the load and e of the energy that half h has of a contact at n_x, and de/dn_x."""
    xi_n = (2 * h - 1) * d.pocket_radius / (d.pocket.a_delta * np.sqrt(maximum(delta, 1e-30)))
    xi = maximum(minimum(xi_n * n_x, 1.0), -1.0)
    xi_2 = xi * xi
    w = 0.5 + xi * (0.75 - 0.25 * xi_2)
    e = 0.5 + xi * (15.0 / 16.0 - xi_2 * (0.625 - 3.0 / 16.0 * xi_2))
    return w, e, 15.0 / 16.0 * (1.0 - xi_2) * (1.0 - xi_2) * xi_n


def pocket_gap(model, w, h):
    """Axes a, b, e_t of the pockets of half h in the balls' frames, p, and S, n_x, n_t, delta of the balls in them."""
    d, half = model.d, w.half[h]
    # direction of pocket j: body angle phi_j turned by the half, b = b_y cos phi + b_z sin phi, e_t = a x b
    a, b_y, b_z, x_h = (vec_local(v, w.cos_theta, w.sin_theta) for v in (half.a, half.b_y, half.b_z, half.x))
    b = d.pocket_cos * b_y + d.pocket_sin * b_z
    e_t = vec_cross(a, b)
    arm_p = vec(w.x, w.r, 0.0) - x_h
    x, t = vec_dot(arm_p, a), vec_dot(arm_p, e_t)
    S = np.sqrt(x * x + t * t + 1e-30)  # 1e-30 gives a centred ball a direction
    return a, b, e_t, arm_p, S, x / S, t / S, S - (d.R_c - d.R)


def pocket_half(model, w, h, mixed, whole):
    """The contact with one half (or the whole rigid cage), added to F, M of the balls."""
    p, d, half = model.p, model.d, w.half[h]
    a, b, e_t, arm_p, S, n_x, n_t, delta = pocket_gap(model, w, h)
    v_h, Omega = (vec_local(v, w.cos_theta, w.sin_theta) for v in (half.v, half.Omega))

    omega_b, v_b = vec(w.omega_x, w.omega_r, w.omega_t), vec(w.v_x, w.v_r, w.v_t)
    v = v_b - v_h - vec_cross(Omega, arm_p)
    n = n_x * a + n_t * e_t
    delta_dot = vec_dot(n, v)

    elastic, tilt, stored = p.scene.cage == CageModel.ELASTIC, 0.0, 0.0
    if elastic:  # the wall has moved by u, by its modes and what they leave
        u, u_dot, tilt, shape = cage_elastic_walls(model, w, h, n_x, n_t, S, delta)
        wall = delta - n_x * u[0] - n_t * u[2]
        delta = cage_elastic_approach(d, lambda own: pocket_share(d, h, n_x, own)[0], wall)
        v = v - (u_dot[0] * a + u_dot[1] * b + u_dot[2] * e_t)
        delta_dot = vec_dot(n, v)
    w_h, e_h, slope = (1.0, 1.0, 0.0) if whole else pocket_share(d, h, n_x, delta)
    Q_0 = w_h * hertz_load(d.pocket.K, delta)
    Q = hertz_damped(Q_0, p.cage.lambda_, delta_dot)
    # -dV/dn_x grad n_x, grad n_x = (n_t a - n_x e_t) n_t/S
    F_across = hertz_energy(d.pocket.K, delta) * slope * n_t / S - Q_0 * tilt
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
    w.D = w.D + g / d.m * (1.0 - n * n)
    w.D_omega = w.D_omega + g * d.R**2 / d.J * (1.0 - n * n)
    w.pocket_dissipated = w.pocket_dissipated + (Q - Q_0) * delta_dot - vec_dot(F_s, slip) - vec_dot(F_c, v)
    w.pocket_F[h] = vec_to_global(-F, w.cos_theta, w.sin_theta)
    w.pocket_M[h] = vec_to_global(-vec_cross(arm_p, F) - M, w.cos_theta, w.sin_theta)
    w.pocket[h] = np.array([-vec_dot(F, a), -vec_dot(F, b), -vec_dot(F, e_t)])
    w.pocket_push[h] = np.array([Q * n_x + F_across * n_t, Q * n_t - F_across * n_x])
    if elastic:
        on_wall = (Q * n_x - vec_dot(F_s + F_c, a), -vec_dot(F_s + F_c, b), Q * n_t - vec_dot(F_s + F_c, e_t))
        w.pocket_modal[h] = sum(force[..., None] * motion for force, motion in zip(on_wall, shape, strict=True))
        stored = 0.5 * d.elastic.wall * Q_0 * Q_0
        # direction, stiffness with the wall's own compliance in series, rate of the approach by rigid motions
        # (cage_substeps.py)
        k = 1.5 * Q_0 / (maximum(delta, 1e-30) + d.elastic.wall * 1.5 * Q_0)
        w.touch[h] = n_x, n_t, k, delta_dot + n_x * u_dot[0] + n_t * u_dot[2]
    half.F, half.M = ball_array_sum(w.pocket_F[h]), ball_array_sum(w.pocket_M[h])
    w.delta_c[h], w.Q_c[h] = delta, Q
    w.pocket_energy = w.pocket_energy + e_h * hertz_energy(d.pocket.K, delta) + stored


def pocket_force(model, w):
    """Adds the pocket contacts to the balls; sets their results and wrench on the halves.

    pocket: force on the half in the pocket's frame (x, r, t), pocket_push: its normal part (x, t); pocket_F, pocket_M:
    force and moment about the half's centre, global.
    D, D_omega: rates at which friction slows each velocity of a ball by itself, -d(acceleration)/d(velocity) [1/s], for
    the integrator's Jacobian.
    """
    mixed, rigid = model.p.scene.lubrication == Lubrication.MIXED, model.p.scene.cage == CageModel.RIGID
    # by half
    w.delta_c, w.Q_c, w.pocket, w.pocket_push, w.pocket_F, w.pocket_M, w.pocket_modal, w.touch = (
        {},
        {},
        {},
        {},
        {},
        {},
        {},
        {},
    )
    w.pocket_energy, w.pocket_dissipated = 0.0, 0.0
    w.D, w.D_omega = 0.0 * w.F, 0.0 * w.F
    if rigid:
        pocket_half(model, w, 0, mixed, True)
        w.half[1].F, w.half[1].M = 0.0 * w.half[0].F, 0.0 * w.half[0].M
    else:
        for h in range(2):
            pocket_half(model, w, h, mixed, False)
    w.Q_pocket = sum(w.Q_c.values())  # of both halves together


def pocket_split(model, w):
    """pocket, pocket_push, pocket_F, pocket_M on each half of a rigid cage, lists; pocket_force has them all on half 0."""
    d = model.d
    a, _, e_t, arm_p, S, n_x, n_t, delta = pocket_gap(model, w, 0)
    w_1, _, slope = pocket_share(d, 1, n_x, delta)
    F_across = hertz_energy(d.pocket.K, delta) * slope * n_t / S
    push = F_across * (n_t * a - n_x * e_t)
    push_moment = vec_cross(arm_p, push)
    on_1 = (
        w_1 * w.pocket[0] + np.array([F_across * n_t, 0.0 * n_t, -F_across * n_x]),
        w_1 * w.pocket_push[0] + np.array([F_across * n_t, -F_across * n_x]),
        w_1 * w.pocket_F[0] + vec_to_global(push, w.cos_theta, w.sin_theta),
        w_1 * w.pocket_M[0] + vec_to_global(push_moment, w.cos_theta, w.sin_theta),
    )
    whole = w.pocket[0], w.pocket_push[0], w.pocket_F[0], w.pocket_M[0]
    return tuple([both - part, part] for both, part in zip(whole, on_1, strict=True))
