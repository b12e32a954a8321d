// Friction and sums of forces that the pockets of both shapes of cage share.
#pragma once

#include "numbers/vec.h"
#include "physics/model.h"
#include "physics/traction.h"

INLINE bool pocket_is_mixed(const Model *model)
{
    return model->p->scene.lubrication == LUBRICATION_MIXED;
}

// Friction coefficient of a pocket at mean speed U and load Q.  The film is the thicker one of piezoviscous
// and isoviscous-rigid lubrication.
INLINE wide pocket_mu(const Model *model, wide ln_U, wide ln_Q, bool mixed)
{
    const wide film = wide_set(model->p->cage.mu);
    if (!mixed) return film;
    const wide ln_piezo = traction_ln_film(wide_set(model->d->ln_pocket_piezo), ln_U, ln_Q);
    const wide ln_rigid = model->d->ln_pocket_rigid + 2.0 * (ln_U - ln_Q);
    return film + traction_asperity_share(wide_max(ln_piezo, ln_rigid)) * (model->p->oil.mu_b - film);
}

// Adds v to the vectors stored at x, r, t.
INLINE void add_vec(vec v, scalar *x, scalar *r, scalar *t)
{
    vec_store(vec_add(vec_load(x, r, t), v), x, r, t);
}

// Axes of a packet of pockets in the frames of the balls: of the half, of the pocket's radius and tangent; p: from the half's centre
// to the ball's.
typedef struct {
    vec a, b, e_t, p;
} PocketAxes;

INLINE PocketAxes pocket_axes(const Derived *d, const Work *w, const Rotor *half, int j)
{
    const wide cos_theta = wide_load(&w->cos_theta[j]), sin_theta = wide_load(&w->sin_theta[j]);
    const vec b_y = vec_local(half->b_y, cos_theta, sin_theta);
    const vec b_z = vec_local(half->b_z, cos_theta, sin_theta);
    const vec centre = {wide_load(&w->x[j]), wide_load(&w->r[j]), wide_set(0.0)};
    PocketAxes at = {.a = vec_local(half->a, cos_theta, sin_theta)};

    // body angle phi_j turned by the half, b = b_y cos phi + b_z sin phi, e_t = a x b
    at.b = vec_axpy(wide_load(&d->pocket_sin[j]), b_z, vec_scale(wide_load(&d->pocket_cos[j]), b_y));
    at.e_t = vec_cross(at.a, at.b);
    at.p = vec_sub(centre, vec_local(half->x, cos_theta, sin_theta));
    return at;
}

// A ball against the half: velocity of its centre against the place there, and its rotation.
typedef struct {
    vec v, spin;
} PocketMotion;

// u_dot: velocity (x, r, t) of the walls, NULL where they stand.
INLINE PocketMotion pocket_motion(const Work *w, const Rotor *half, int j, const PocketAxes *at,
                                  const ball_array u_dot[3])
{
    const wide cos_theta = wide_load(&w->cos_theta[j]), sin_theta = wide_load(&w->sin_theta[j]);
    const vec omega_b = vec_load(&w->omega_x[j], &w->omega_r[j], &w->omega_t[j]);
    const vec v_b = vec_load(&w->v_x[j], &w->v_r[j], &w->v_t[j]);
    const vec Omega = vec_local(half->Omega, cos_theta, sin_theta);
    vec v = vec_sub(vec_sub(v_b, vec_local(half->v, cos_theta, sin_theta)), vec_cross(Omega, at->p));
    if (u_dot) {
        const vec along =
            vec_axpy(wide_load(&u_dot[0][j]), at->a, vec_scale(wide_load(&u_dot[2][j]), at->e_t));
        v = vec_sub(v, vec_axpy(wide_load(&u_dot[1][j]), at->b, along));
    }
    return (PocketMotion){v, vec_sub(omega_b, Omega)};
}

// Stores the reactions on the half to the force F and the moment M on the balls, 0 where nothing acts.
INLINE void pocket_on_half(const Work *w, int j, const PocketAxes *at, bits acts, vec F, vec M,
                           Pockets *pocket)
{
    const wide zero = wide_set(0.0);
    const vec F_half = vec_scale(wide_set(-1.0), F), M_half = vec_sub(vec_cross(at->p, F_half), M);
    wide_store(&pocket->F_x[j], wide_select(acts, vec_dot(F_half, at->a), zero));
    wide_store(&pocket->F_r[j], wide_select(acts, vec_dot(F_half, at->b), zero));
    wide_store(&pocket->F_t[j], wide_select(acts, vec_dot(F_half, at->e_t), zero));
    scalar *const global[6] = {pocket->half_F_x, pocket->half_F_y, pocket->half_F_z,
                               pocket->half_M_x, pocket->half_M_y, pocket->half_M_z};
    const wide cos_theta = wide_load(&w->cos_theta[j]), sin_theta = wide_load(&w->sin_theta[j]);
    vec_to_global(F_half, cos_theta, sin_theta, &global[0][j], &global[1][j], &global[2][j]);
    vec_to_global(M_half, cos_theta, sin_theta, &global[3][j], &global[4][j], &global[5][j]);
    for (int i = 0; i < 6; i++) wide_store(&global[i][j], wide_select(acts, wide_load(&global[i][j]), zero));
}

// Adds to the balls: force, moment, the rate g of friction across n, the power that is lost.
INLINE void pocket_on_balls(const Model *model, Work *w, int j, bits acts, vec n, vec F, vec M, wide g,
                            wide lost)
{
    const Derived *d = model->d;
    const wide R = wide_load(&d->R[j]);
    const vec tangent = {1.0 - n.x * n.x, 1.0 - n.r * n.r, 1.0 - n.t * n.t};
    add_vec(F, &w->F_x[j], &w->F_r[j], &w->F_t[j]);
    add_vec(M, &w->M_x[j], &w->M_r[j], &w->M_t[j]);
    add_vec(vec_where(acts, vec_scale(g / d->m, tangent)), &w->D_x[j], &w->D_r[j], &w->D_t[j]);
    add_vec(vec_where(acts, vec_scale(g * (R * R / d->J), tangent)), &w->D_omega_x[j], &w->D_omega_r[j],
            &w->D_omega_t[j]);
    const wide dissipated = wide_select(acts, lost, wide_set(-0.0));
    wide_store(&w->dissipated[j], wide_load(&w->dissipated[j]) + dissipated);
    wide_store(&w->pocket_dissipated[j], wide_load(&w->pocket_dissipated[j]) + dissipated);
}

// Forces of a packet in which no ball touches its pocket.
INLINE void pocket_clear(Pockets *pocket, int j)
{
    const vec none = {0};
    wide_store(&pocket->Q[j], wide_set(0.0));
    vec_store(none, &pocket->F_x[j], &pocket->F_r[j], &pocket->F_t[j]);
    vec_store(none, &pocket->half_F_x[j], &pocket->half_F_y[j], &pocket->half_F_z[j]);
    vec_store(none, &pocket->half_M_x[j], &pocket->half_M_y[j], &pocket->half_M_z[j]);
}

// No contact in a packet of walls.
INLINE void walls_clear(Work *w, int h, int j)
{
    WallTouch *touch = &w->cage.elastic.touch;
    scalar *const all[] = {touch->x[h], touch->r[h],   touch->t[h],      touch->K[h],    touch->delta[h],
                           touch->Q[h], touch->chi[h], touch->radius[h], touch->front[h]};
    pocket_clear(&w->pocket[h], j);
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) wide_store(&all[i][j], wide_set(0.0));
}

// Adds the forces of all pockets to their half.
INLINE void add_pockets(const Pockets *pocket, Rotor *half)
{
    const scalar *F[3] = {pocket->half_F_x, pocket->half_F_y, pocket->half_F_z};
    const scalar *M[3] = {pocket->half_M_x, pocket->half_M_y, pocket->half_M_z};
    for (int i = 0; i < 3; i++) {
        half->F[i] += ball_array_sum(F[i]);
        half->M[i] += ball_array_sum(M[i]);
    }
}
