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

// Forces of a packet in which no ball touches its pocket.
INLINE void pocket_clear(Pockets *pocket, int j)
{
    const vec none = {0};
    wide_store(&pocket->Q[j], wide_set(0.0));
    vec_store(none, &pocket->F_x[j], &pocket->F_r[j], &pocket->F_t[j]);
    vec_store(none, &pocket->half_F_x[j], &pocket->half_F_y[j], &pocket->half_F_z[j]);
    vec_store(none, &pocket->half_M_x[j], &pocket->half_M_y[j], &pocket->half_M_z[j]);
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
