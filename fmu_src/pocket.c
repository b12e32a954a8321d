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

// Touched pockets, side by side in one bundle: few are touched at a time.  Lanes past `count` keep older numbers: harmless.
typedef struct {
    number x[LANE_WIDTH], r[LANE_WIDTH], t[LANE_WIDTH];
} VecLanes;

typedef struct {
    int j[LANE_WIDTH], h[LANE_WIDTH], count;
    VecLanes place, velocity, spin;               // of the ball, in its frame
    VecLanes a, b_y, b_z, half_x, half_v, Omega;  // of the half, global
    number cos_theta[LANE_WIDTH], sin_theta[LANE_WIDTH], R[LANE_WIDTH], cos_phi[LANE_WIDTH], sin_phi[LANE_WIDTH], side[LANE_WIDTH];
} Touched;

static inline void vec_lane(VecLanes *to, int i, number x, number r, number t)
{
    to->x[i] = x, to->r[i] = r, to->t[i] = t;
}
static inline void vec_lane_of(VecLanes *to, int i, const number from[3])
{
    vec_lane(to, i, from[0], from[1], from[2]);
}

static void pocket_list(const Derived *d, const Work *w, int j, int h, Touched *list)
{
    const int i = list->count++;
    const Rotor *half = &w->half[h];
    list->j[i] = j, list->h[i] = h, list->side[i] = h == 0 ? -1.0 : 1.0;
    vec_lane(&list->place, i, w->x[j], w->r[j], 0.0);
    vec_lane(&list->velocity, i, w->v_x[j], w->v_r[j], w->v_t[j]);
    vec_lane(&list->spin, i, w->omega_x[j], w->omega_r[j], w->omega_t[j]);
    vec_lane_of(&list->a, i, half->a);
    vec_lane_of(&list->b_y, i, half->b_y);
    vec_lane_of(&list->b_z, i, half->b_z);
    vec_lane_of(&list->half_x, i, half->x);
    vec_lane_of(&list->half_v, i, half->v);
    vec_lane_of(&list->Omega, i, half->Omega);
    list->cos_theta[i] = w->cos_theta[j], list->sin_theta[i] = w->sin_theta[j];
    list->cos_phi[i] = d->pocket_cos[j], list->sin_phi[i] = d->pocket_sin[j];
    list->R[i] = d->R[j];
}

// A global vector of each lane in the frame of its ball.
INLINE vec pocket_local(const VecLanes *global, real cos_theta, real sin_theta)
{
    const vec v = vec_load(global->x, global->r, global->t);
    return (vec){v.x, v.r * cos_theta + v.t * sin_theta, v.t * cos_theta - v.r * sin_theta};
}

// Forces of the touched pockets, added to balls and halves in the order of the list.
INLINE void pocket_contacts(const Model *model, Work *w, const Touched *list, bool mixed, bool whole)
{
    const Parameters *p = model->p;
    const Derived *d = model->d;
    const real cos_theta = real_load(list->cos_theta), sin_theta = real_load(list->sin_theta), R = real_load(list->R);

    // Direction of the pocket: body angle phi_j turned by the half, b = b_y cos phi + b_z sin phi, e_t = a x b.
    const vec a = pocket_local(&list->a, cos_theta, sin_theta);
    const vec b = vec_axpy(real_load(list->sin_phi), pocket_local(&list->b_z, cos_theta, sin_theta),
                           vec_scale(real_load(list->cos_phi), pocket_local(&list->b_y, cos_theta, sin_theta)));
    const vec e_t = vec_cross(a, b);
    const vec arm_p = vec_sub(vec_load(list->place.x, list->place.r, list->place.t), pocket_local(&list->half_x, cos_theta, sin_theta));
    const real x = vec_dot(arm_p, a), t = vec_dot(arm_p, e_t);
    const real S = real_sqrt(x * x + t * t + 1e-30), n_x = x / S, n_t = t / S;
    const real delta = S - (d->pocket_radius - R);
    const vec n = vec_axpy(n_t, e_t, vec_scale(n_x, a));

    const vec omega_b = vec_load(list->spin.x, list->spin.r, list->spin.t), v_b = vec_load(list->velocity.x, list->velocity.r, list->velocity.t);
    const vec Omega = pocket_local(&list->Omega, cos_theta, sin_theta);
    const vec v = vec_sub(vec_sub(v_b, pocket_local(&list->half_v, cos_theta, sin_theta)), vec_cross(Omega, arm_p));
    const real delta_dot = vec_dot(n, v);

    // share of the half and its slope; the sign is that of the half's side
    const real side = real_load(list->side);
    const real width2 = real_set(p->cage.share_width * p->cage.share_width), root = real_sqrt(n_x * n_x + width2);
    const real share = whole ? real_set(1.0) : 0.5 * (1.0 + side * n_x / root);
    const real share_slope = whole ? real_set(0.0) : 0.5 * side * width2 / (root * root * root);

    const real Q_full = hertz_load(real_set(d->pocket.K), delta), Q_0 = share * Q_full;
    const real Q = hertz_damped(Q_0, real_set(p->cage.lambda), delta_dot);
    const real F_across = 0.4 * Q_full * real_max(delta, real_set(0.0)) * share_slope * n_t / S;  // dV/dn_x grad n_x, grad n_x = (n_t a - n_x e_t) n_t/S
    const vec F_n = vec_axpy(-Q, n, vec_axpy(-F_across * n_t, a, vec_scale(F_across * n_x, e_t)));

    const vec arm = vec_scale(R, n);
    const vec slip = vec_across(vec_add(v, vec_cross(vec_sub(omega_b, Omega), arm)), n);
    const real slip_2 = vec_dot(slip, slip);
    const real U = real_sqrt(0.25 * slip_2 + p->oil.U_0 * p->oil.U_0), ln_U = real_log(U), ln_Q = real_log(Q + Q_FLOOR);
    const real g = pocket_mu(model, ln_U, ln_Q, mixed) * Q / real_sqrt(slip_2 + p->cage.v_c * p->cage.v_c);
    const real g_R = 0.5 * traction_inlet(real_set(d->pocket_rolling), ln_U, Q, ln_Q) / U;
    const vec F_s = vec_scale(-(g + g_R), slip), F_c = vec_scale(2.0 * g_R, slip);
    const vec F = vec_add(F_n, vec_add(F_s, F_c)), M = vec_cross(arm, F_s);
    const vec F_half = vec_scale(real_set(-1.0), F), M_half = vec_sub(vec_cross(arm_p, F_half), M);
    const real dissipated = (Q - Q_0) * delta_dot - vec_dot(F_s, slip) - vec_dot(F_c, v);
    const real F_x = vec_dot(F_half, a), F_r = vec_dot(F_half, b), F_t = vec_dot(F_half, e_t);
    const real F_y = F_half.r * cos_theta - F_half.t * sin_theta, F_z = F_half.r * sin_theta + F_half.t * cos_theta;
    const real M_y = M_half.r * cos_theta - M_half.t * sin_theta, M_z = M_half.r * sin_theta + M_half.t * cos_theta;
    const real mass_rate = g / d->m, spin_rate = g * (R * R / d->J);
    const vec tangent = {1.0 - n.x * n.x, 1.0 - n.r * n.r, 1.0 - n.t * n.t}, D = vec_scale(mass_rate, tangent), D_omega = vec_scale(spin_rate, tangent);

    for (int i = 0; i < list->count; i++) {
        const int j = list->j[i], h = list->h[i];
        Rotor *half = &w->half[h];
        w->F_x[j] += real_lane(F.x, i), w->F_r[j] += real_lane(F.r, i), w->F_t[j] += real_lane(F.t, i);
        w->M_x[j] += real_lane(M.x, i), w->M_r[j] += real_lane(M.r, i), w->M_t[j] += real_lane(M.t, i);
        w->D_x[j] += real_lane(D.x, i), w->D_r[j] += real_lane(D.r, i), w->D_t[j] += real_lane(D.t, i);
        w->D_omega_x[j] += real_lane(D_omega.x, i), w->D_omega_r[j] += real_lane(D_omega.r, i), w->D_omega_t[j] += real_lane(D_omega.t, i);
        w->dissipated[j] += real_lane(dissipated, i);
        half->F[0] += real_lane(F_half.x, i), half->F[1] += real_lane(F_y, i), half->F[2] += real_lane(F_z, i);
        half->M[0] += real_lane(M_half.x, i), half->M[1] += real_lane(M_y, i), half->M[2] += real_lane(M_z, i);
        w->pocket[h][j] = (Pocket){.Q = real_lane(Q, i),
                                   .F_x = real_lane(F_x, i),
                                   .F_r = real_lane(F_r, i),
                                   .F_t = real_lane(F_t, i),
                                   .F = {real_lane(F_half.x, i), real_lane(F_y, i), real_lane(F_z, i)},
                                   .M = {real_lane(M_half.x, i), real_lane(M_y, i), real_lane(M_z, i)}};
    }
}

// Elastic approach of all balls to the pockets of one half (negative: open).
INLINE void pocket_approach(const Model *model, Work *w, int h)
{
    const Derived *d = model->d;
    const Rotor *half = &w->half[h];
    for (int bundle = 0; bundle < BUNDLES; bundle++) {
        const int j = bundle * LANE_WIDTH;
        const real r = real_load(&w->r[j]);
        const real p_x = real_load(&w->x[j]) - half->x[0], p_y = r * real_load(&w->cos_theta[j]) - half->x[1];
        const real p_z = r * real_load(&w->sin_theta[j]) - half->x[2];
        const real x = p_x * half->a[0] + p_y * half->a[1] + p_z * half->a[2];
        const real y = p_x * half->b_y[0] + p_y * half->b_y[1] + p_z * half->b_y[2], z = p_x * half->b_z[0] + p_y * half->b_z[1] + p_z * half->b_z[2];
        const real t = z * real_load(&d->pocket_cos[j]) - y * real_load(&d->pocket_sin[j]);  // e_t = b_z cos phi - b_y sin phi
        real_store(&w->delta_c[h][j], real_sqrt(x * x + t * t + 1e-30) - (d->pocket_radius - real_load(&d->R[j])));
    }
}

void pocket_force(const Model *model, Work *w)
{
    const bool mixed = model->p->scene.lubrication == LUBRICATION_MIXED, rigid = model->p->scene.cage == CAGE_MODEL_RIGID;
    Touched list = {0};
    memset(w->pocket, 0, sizeof w->pocket);
    for (int h = 0; h < (rigid ? 1 : 2); h++) {
        pocket_approach(model, w, h);
        for (int j = 0; j < Z; j++) {
            if (!(number_value(w->delta_c[h][j]) > 0.0)) continue;
            pocket_list(model->d, w, j, h, &list);
            if (list.count == LANE_WIDTH) {
                pocket_contacts(model, w, &list, mixed, rigid);
                list.count = 0;
            }
        }
    }
    if (list.count > 0) pocket_contacts(model, w, &list, mixed, rigid);
}
