// Ball and pocket: a cylinder with a radial axis, cut by the split plane into the two halves.
//
//        x (a)                      a     axis of the half         p = ball centre - geometric centre of the half
//        |   half 1                 e_t   its tangent at pocket j  (x, t) = (p.a, p.e_t): ball against the pocket's axis
//     .--+--.                       S = sqrt(x^2 + t^2),  n = (x, t)/S
//    (   |n->)---- t (e_t)          delta = S - (R_c - R)                                                  Cui et al. (2023)
//     '--+--'                       V = w(n_x) (2/5) K delta^2.5,  w = (1 +- n_x/sqrt(n_x^2 + width^2))/2  share of this half
//        |   half 0                 force on the ball: -dV/d(x, t), damping -(K w delta^1.5) lambda delta_dot n, Coulomb friction mu Q
//
// Both halves share one contact energy, so the force has a part along the gradient of the share; without it energy is not conserved.
// Friction P_S at the contact point p + R n with the slip v + omega x R n; the coefficient goes from that of the film to that of the
// asperities by Lambda (mixed lubrication); P_R and its horizontal counterpart are the inlet's rolling friction as in the races, with the
// mean speed |slip|/2 and R_x = R.  The half gets the opposite forces at the same points.
// Smoothness: C1 at touch-down.  The cylinder has no radial end: a ball whose equator leaves the cage's section is reported, not modelled.
#include "pocket.h"

#include "hertz.h"
#include "traction.h"

// Friction coefficient of a pocket at sliding speed v and load Q.  Film: the thicker one of piezoviscous and isoviscous-rigid lubrication.
INLINE real pocket_mu(const Model *model, real ln_U, real ln_Q, bool mixed)
{
    const real film = real_set(model->p->cage.mu);
    if (!mixed) return film;
    const real ln_piezo = traction_ln_film(real_set(model->d->ln_pocket_piezo), ln_U, ln_Q);
    const real ln_rigid = model->d->ln_pocket_rigid + 2.0 * (ln_U - ln_Q);
    return film + traction_asperity_share(real_max(ln_piezo, ln_rigid)) * (model->p->oil.mu_b - film);
}

// The contact with one half (or the whole rigid cage: whole = true), added to F, M of the ball.
INLINE void pocket_half(const Model *model, Work *w, int j, int h, bool mixed, bool whole)
{
    const Parameters *p = model->p;
    const Derived *d = model->d;
    const Rotor *half = &w->half[h];
    const real cos_theta = real_load(&w->cos_theta[j]), sin_theta = real_load(&w->sin_theta[j]), R = real_load(&d->R[j]);

    // Direction of pocket j: body angle phi_j turned by the half, b = b_y cos phi + b_z sin phi, e_t = a x b.
    const vec a = vec_local(half->a, cos_theta, sin_theta);
    const vec b = vec_axpy(real_load(&d->pocket_sin[j]), vec_local(half->b_z, cos_theta, sin_theta),
                           vec_scale(real_load(&d->pocket_cos[j]), vec_local(half->b_y, cos_theta, sin_theta)));
    const vec e_t = vec_cross(a, b);
    const vec ball = {real_load(&w->x[j]), real_load(&w->r[j]), real_set(0.0)};
    const vec arm_p = vec_sub(ball, vec_local(half->x, cos_theta, sin_theta));
    const real x = vec_dot(arm_p, a), t = vec_dot(arm_p, e_t);
    const real S = real_sqrt(x * x + t * t + 1e-30);
    const real delta = S - (d->pocket_radius - R);
    real_store(&w->delta_c[h][j], delta);

    vec F = {0}, M = {0};
    real Q = real_set(0.0);
    const bits closed = delta > 0.0;
    if (real_any(closed)) {
        const vec omega_b = vec_load(&w->omega_x[j], &w->omega_r[j], &w->omega_t[j]);
        const vec Omega = vec_local(half->Omega, cos_theta, sin_theta);
        const vec v_b = vec_load(&w->v_x[j], &w->v_r[j], &w->v_t[j]);
        const vec v = vec_sub(vec_sub(v_b, vec_local(half->v, cos_theta, sin_theta)), vec_cross(Omega, arm_p));
        const real n_x = x / S, n_t = t / S;
        const vec n = vec_axpy(n_t, e_t, vec_scale(n_x, a));
        const real delta_dot = vec_dot(n, v);

        // share of this half and its slope; the sign is that of the half's side
        const real side = real_set(h == 0 ? -1.0 : 1.0), width2 = real_set(p->cage.share_width * p->cage.share_width);
        const real root = real_sqrt(n_x * n_x + width2);
        const real share = whole ? real_set(1.0) : 0.5 * (1.0 + side * n_x / root);
        const real share_slope = whole ? real_set(0.0) : 0.5 * side * width2 / (root * root * root);

        const real Q_0 = share * hertz_load(real_set(d->pocket.K), delta);
        Q = hertz_damped(Q_0, real_set(p->cage.lambda), delta_dot);
        const real energy_slope = 0.4 * hertz_load(real_set(d->pocket.K), delta) * real_max(delta, real_set(0.0)) * share_slope;
        const real F_across = energy_slope * n_t / S;  // -dV/dn_x grad n_x, grad n_x = (n_t a - n_x e_t) n_t / S
        F = vec_axpy(-Q, n, vec_axpy(-F_across * n_t, a, vec_scale(F_across * n_x, e_t)));

        const vec arm = vec_scale(R, n);
        const vec slip = vec_across(vec_add(v, vec_cross(vec_sub(omega_b, Omega), arm)), n);
        const real slip_2 = vec_dot(slip, slip);
        const real U = real_sqrt(0.25 * slip_2 + p->oil.U_0 * p->oil.U_0), ln_U = real_log(U), ln_Q = real_log(Q + Q_FLOOR);
        const real g = pocket_mu(model, ln_U, ln_Q, mixed) * Q / real_sqrt(slip_2 + p->cage.v_c * p->cage.v_c);
        const real g_R = 0.5 * traction_inlet(real_set(d->pocket_rolling), ln_U, Q, ln_Q) / U;
        const vec F_s = vec_scale(-(g + g_R), slip);
        const vec F_c = vec_scale(2.0 * g_R, slip);
        F = vec_add(F, vec_add(F_s, F_c));
        M = vec_cross(arm, F_s);

        vec_store(vec_add(vec_load(&w->F_x[j], &w->F_r[j], &w->F_t[j]), F), &w->F_x[j], &w->F_r[j], &w->F_t[j]);
        vec_store(vec_add(vec_load(&w->M_x[j], &w->M_r[j], &w->M_t[j]), M), &w->M_x[j], &w->M_r[j], &w->M_t[j]);
        const real mass_rate = g / d->m, spin_rate = g * (R * R / d->J);
        const vec tangent = {1.0 - n.x * n.x, 1.0 - n.r * n.r, 1.0 - n.t * n.t};
        vec_store(vec_axpy(mass_rate, tangent, vec_load(&w->D_x[j], &w->D_r[j], &w->D_t[j])), &w->D_x[j], &w->D_r[j], &w->D_t[j]);
        vec_store(vec_axpy(spin_rate, tangent, vec_load(&w->D_omega_x[j], &w->D_omega_r[j], &w->D_omega_t[j])), &w->D_omega_x[j],
                  &w->D_omega_r[j], &w->D_omega_t[j]);
        real_store(&w->dissipated[j], real_load(&w->dissipated[j]) + (Q - Q_0) * delta_dot - vec_dot(F_s, slip) - vec_dot(F_c, v));
    }
    const vec F_half = vec_scale(real_set(-1.0), F), M_half = vec_sub(vec_cross(arm_p, F_half), M);
    vec_to_global(F_half, cos_theta, sin_theta, &w->half_F_x[h][j], &w->half_F_y[h][j], &w->half_F_z[h][j]);
    vec_to_global(M_half, cos_theta, sin_theta, &w->half_M_x[h][j], &w->half_M_y[h][j], &w->half_M_z[h][j]);
    vec_store((vec){vec_dot(F_half, a), vec_dot(F_half, b), vec_dot(F_half, e_t)}, &w->pocket_x[h][j], &w->pocket_r[h][j], &w->pocket_t[h][j]);
    real_store(&w->Q_c[h][j], Q);
}

void pocket_force(const Model *model, Work *w)
{
    const bool mixed = model->p->scene.lubrication == LUBRICATION_MIXED, rigid = model->p->scene.cage == CAGE_MODEL_RIGID;
    for (int b = 0; b < BUNDLES; b++) {
        const int j = b * LANE_WIDTH;
        if (rigid) {
            mixed ? pocket_half(model, w, j, 0, true, true) : pocket_half(model, w, j, 0, false, true);
        } else {
            for (int h = 0; h < 2; h++) mixed ? pocket_half(model, w, j, h, true, false) : pocket_half(model, w, j, h, false, false);
        }
    }
}
