// Ball and pocket: a cylinder with a radial axis, cut by the split plane into the two halves.
//
//        x (a)                      a     axis of the half         p = ball centre - geometric centre of the half
//        |   half 1                 e_t   its tangent at pocket j  (x, t) = (p.a, p.e_t): ball against the pocket's axis
//     .--+--.                       S = sqrt(x^2 + t^2),  n = (x, t)/S
//    (   |n->)---- t (e_t)          delta = S - (R_c - R)                                                  Cui et al. (2023)
//     '--+--'                       V = e(xi) (2/5) K delta^2.5,  xi = +- n_x R_c/a, at most 1: split plane against the patch, a = a_delta delta^0.5
//        |   half 0                 force on the ball: -dV/d(x, t), damping -(w K delta^1.5) lambda delta_dot n, Coulomb friction mu Q
//
// A half bears the part of the Hertz pressure on its side of the split plane, which cuts the contact ellipse across its long half axis a:
//     w = 1/2 + 3/4 xi - 1/4 xi^3,  e = 1/2 + 15/16 xi - 5/8 xi^3 + 3/16 xi^5
// w: the pressure sqrt(1 - (x/a)^2 - (y/b)^2) summed over y leaves 1 - (x/a)^2 along x.  e: the work of pressing the half in, of w K delta^1.5
// over delta at its place; so -dV/d(delta) is w K delta^1.5, and both halves together store and bear what one contact does.  The slope of V along
// the wall is a force across n that pushes the halves apart; without this force energy would not be conserved.
// Friction P_S at the contact point p + R n with the slip v + omega x R n; the coefficient goes from that of the film to that of the
// asperities by Lambda (mixed lubrication); P_R and its horizontal counterpart are the inlet's rolling friction as in the races, with the
// mean speed |slip|/2 and R_x = R.  The half gets the opposite forces at the same points.
// Smoothness: C1 at touch-down and where the patch leaves a half.  The cylinder has no radial end: a ball whose equator leaves the cage's section is reported,
// not modelled.
#include "pocket.h"

#include "hertz.h"
#include "traction.h"

// Friction coefficient of a pocket at sliding speed v and load Q.  Film: the thicker one of piezoviscous and isoviscous-rigid lubrication.
INLINE wide pocket_mu(const Model *model, wide ln_U, wide ln_Q, bool mixed)
{
    const wide film = wide_set(model->p->cage.mu);
    if (!mixed) return film;
    const wide ln_piezo = traction_ln_film(wide_set(model->d->ln_pocket_piezo), ln_U, ln_Q);
    const wide ln_rigid = model->d->ln_pocket_rigid + 2.0 * (ln_U - ln_Q);
    return film + traction_asperity_share(wide_max(ln_piezo, ln_rigid)) * (model->p->oil.mu_b - film);
}

INLINE void add_vec(vec v, scalar *x, scalar *r, scalar *t)
{
    vec_store(vec_add(vec_load(x, r, t), v), x, r, t);
}

// Forces in a packet of pockets, stored for the half and added to the balls.
INLINE void pocket_contacts(const Model *model, Work *w, int h, int j, bool mixed, bool whole)
{
    const Parameters *p = model->p;
    const Derived *d = model->d;
    const Rotor *half = &w->half[h];
    Pockets *pocket = &w->pocket[h];
    const wide cos_theta = wide_load(&w->cos_theta[j]), sin_theta = wide_load(&w->sin_theta[j]), R = wide_load(&d->R[j]);

    const PocketPlace at = pocket_place(d, w, half, j);
    const vec a = at.a, e_t = at.e_t, arm_p = at.p;
    const wide n_x = at.n_x, n_t = at.n_t;
    const vec n = vec_axpy(n_t, e_t, vec_scale(n_x, a));

    const vec omega_b = vec_load(&w->omega_x[j], &w->omega_r[j], &w->omega_t[j]), v_b = vec_load(&w->v_x[j], &w->v_r[j], &w->v_t[j]);
    const vec Omega = vec_local(half->Omega, cos_theta, sin_theta);
    const vec v = vec_sub(vec_sub(v_b, vec_local(half->v, cos_theta, sin_theta)), vec_cross(Omega, arm_p));
    const wide delta_dot = vec_dot(n, v);

    const PocketShare share = whole ? (PocketShare){wide_set(1.0), wide_set(1.0), wide_set(0.0)} : pocket_share(d, h, n_x, at.delta);
    const wide Q_0 = share.load * hertz_load(wide_set(d->pocket.K), at.delta);
    const wide Q = hertz_damped(Q_0, wide_set(p->cage.lambda), delta_dot);
    const wide F_across = pocket_across(d, &at, share.slope);
    const vec F_n = vec_axpy(-Q, n, vec_axpy(-F_across * n_t, a, vec_scale(F_across * n_x, e_t)));

    const vec arm = vec_scale(R, n);
    const vec slip = vec_across(vec_add(v, vec_cross(vec_sub(omega_b, Omega), arm)), n);
    const wide slip_2 = vec_dot(slip, slip), U_2 = 0.25 * slip_2 + p->oil.U_0 * p->oil.U_0, inv_U = 1.0 / wide_sqrt(U_2);
    wide ln_U, ln_Q;
    wide_log2(U_2 * inv_U, Q + Q_FLOOR, &ln_U, &ln_Q);
    const wide g = pocket_mu(model, ln_U, ln_Q, mixed) * Q / wide_sqrt(slip_2 + p->cage.v_c * p->cage.v_c);
    const wide g_R = 0.5 * traction_inlet(wide_set(d->pocket_rolling), ln_U, Q, ln_Q) * inv_U;
    const vec F_s = vec_scale(-(g + g_R), slip), F_c = vec_scale(2.0 * g_R, slip);
    const vec F = vec_add(F_n, vec_add(F_s, F_c)), M = vec_cross(arm, F_s);
    const vec F_half = vec_scale(wide_set(-1.0), F), M_half = vec_sub(vec_cross(arm_p, F_half), M);

    wide_store(&pocket->Q[j], Q);
    wide_store(&pocket->F_x[j], vec_dot(F_half, a));
    wide_store(&pocket->F_r[j], vec_dot(F_half, at.b));
    wide_store(&pocket->F_t[j], vec_dot(F_half, e_t));
    vec_to_global(F_half, cos_theta, sin_theta, &pocket->half_F_x[j], &pocket->half_F_y[j], &pocket->half_F_z[j]);
    vec_to_global(M_half, cos_theta, sin_theta, &pocket->half_M_x[j], &pocket->half_M_y[j], &pocket->half_M_z[j]);

    const vec tangent = {1.0 - n.x * n.x, 1.0 - n.r * n.r, 1.0 - n.t * n.t};
    add_vec(F, &w->F_x[j], &w->F_r[j], &w->F_t[j]);
    add_vec(M, &w->M_x[j], &w->M_r[j], &w->M_t[j]);
    add_vec(vec_scale(g / d->m, tangent), &w->D_x[j], &w->D_r[j], &w->D_t[j]);
    add_vec(vec_scale(g * (R * R / d->J), tangent), &w->D_omega_x[j], &w->D_omega_r[j], &w->D_omega_t[j]);
    wide_store(&w->dissipated[j], wide_load(&w->dissipated[j]) + ((Q - Q_0) * delta_dot - vec_dot(F_s, slip) - vec_dot(F_c, v)));
}

// Nothing touches.
INLINE void pocket_clear(Pockets *pocket, int j)
{
    const vec none = {0};
    wide_store(&pocket->Q[j], wide_set(0.0));
    vec_store(none, &pocket->F_x[j], &pocket->F_r[j], &pocket->F_t[j]);
    vec_store(none, &pocket->half_F_x[j], &pocket->half_F_y[j], &pocket->half_F_z[j]);
    vec_store(none, &pocket->half_M_x[j], &pocket->half_M_y[j], &pocket->half_M_z[j]);
}

// Elastic approach of a packet of balls to the pockets of one half (negative: open).
INLINE wide pocket_approach(const Derived *d, const Work *w, const Rotor *half, int j)
{
    const wide r = wide_load(&w->r[j]);
    const wide p_x = wide_load(&w->x[j]) - half->x[0], p_y = r * wide_load(&w->cos_theta[j]) - half->x[1];
    const wide p_z = r * wide_load(&w->sin_theta[j]) - half->x[2];
    const wide x = p_x * half->a[0] + p_y * half->a[1] + p_z * half->a[2];
    const wide y = p_x * half->b_y[0] + p_y * half->b_y[1] + p_z * half->b_y[2], z = p_x * half->b_z[0] + p_y * half->b_z[1] + p_z * half->b_z[2];
    const wide t = z * wide_load(&d->pocket_cos[j]) - y * wide_load(&d->pocket_sin[j]);  // e_t = b_z cos phi - b_y sin phi
    return wide_sqrt(x * x + t * t + 1e-30) - (d->pocket_radius - wide_load(&d->R[j]));
}

// All pockets of one half; most are not touched.
INLINE void pocket_half(const Model *model, Work *w, int h, bool mixed, bool whole)
{
    Pockets *pocket = &w->pocket[h];
    Rotor *half = &w->half[h];
    bool touched = false;
    for (int j = 0; j < PACKETS * LANE_WIDTH; j += LANE_WIDTH) {
        const wide delta = pocket_approach(model->d, w, half, j);
        wide_store(&w->delta_c[h][j], delta);
        if (wide_any(wide_above(delta, 0.0))) {
            pocket_contacts(model, w, h, j, mixed, whole);
            touched = true;
        } else
            pocket_clear(pocket, j);
    }
    if (!touched) return;
    const scalar *F[3] = {pocket->half_F_x, pocket->half_F_y, pocket->half_F_z}, *M[3] = {pocket->half_M_x, pocket->half_M_y, pocket->half_M_z};
    for (int i = 0; i < 3; i++) {
        half->F[i] += ball_array_sum(F[i]);
        half->M[i] += ball_array_sum(M[i]);
    }
}

void pocket_force(const Model *model, Work *w)
{
    const bool mixed = model->p->scene.lubrication == LUBRICATION_MIXED, rigid = model->p->scene.cage == CAGE_MODEL_RIGID;
    for (int h = 0; h < (rigid ? 1 : 2); h++) pocket_half(model, w, h, mixed, rigid);
}

void pocket_split(const Model *model, const Work *w, Pockets on[2])
{
    const Derived *d = model->d;
    const Rotor *cage = &w->half[0];
    const Pockets *whole = &w->pocket[0];
    const scalar *from[] = {whole->F_x,      whole->F_r,      whole->F_t,      whole->half_F_x, whole->half_F_y,
                            whole->half_F_z, whole->half_M_x, whole->half_M_y, whole->half_M_z};
    scalar *to[2][9];
    for (int h = 0; h < 2; h++) {
        scalar *rows[] = {on[h].F_x, on[h].F_r, on[h].F_t, on[h].half_F_x, on[h].half_F_y, on[h].half_F_z, on[h].half_M_x, on[h].half_M_y, on[h].half_M_z};
        memcpy(to[h], rows, sizeof rows);
    }
    for (int j = 0; j < PACKETS * LANE_WIDTH; j += LANE_WIDTH) {
        const wide cos_theta = wide_load(&w->cos_theta[j]), sin_theta = wide_load(&w->sin_theta[j]);
        const PocketPlace at = pocket_place(d, w, cage, j);
        const PocketShare share = pocket_share(d, 1, at.n_x, at.delta);
        const wide F_across = pocket_across(d, &at, share.slope);
        const vec push = vec_axpy(F_across * at.n_t, at.a, vec_scale(-F_across * at.n_x, at.e_t));
        vec_store((vec){F_across * at.n_t, wide_set(0.0), -F_across * at.n_x}, &on[1].F_x[j], &on[1].F_r[j], &on[1].F_t[j]);
        vec_to_global(push, cos_theta, sin_theta, &on[1].half_F_x[j], &on[1].half_F_y[j], &on[1].half_F_z[j]);
        vec_to_global(vec_cross(at.p, push), cos_theta, sin_theta, &on[1].half_M_x[j], &on[1].half_M_y[j], &on[1].half_M_z[j]);
        for (int i = 0; i < 9; i++) {
            const wide both = wide_load(&from[i][j]), part = wide_fma(share.load, both, wide_load(&to[1][i][j]));
            wide_store(&to[1][i][j], part);
            wide_store(&to[0][i][j], both - part);
        }
    }
}
