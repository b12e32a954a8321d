// The films of the lands in the implicit step: how they slow one half of the cage.
//
// A land's film slows the velocity u of the land at the lever x, u_y = v_y + gamma_dot x and u_z = v_z - beta_dot x.
// Because u has two components, the inverse of the body's 4 x 4 block needs a 2 x 2 inverse only (Woodbury): with the
// film matrix C the impulse is (C^-1/gamma + 1/m + x^2/J_t)^-1 u = (yy, yz; yz, zz) u.
#pragma once

#include "physics/model.h"

// A land's film ready to be solved for one half.
typedef struct {
    double m, J_p, J_t;  // inertia of the half
    double x;            // lever of the land from the half's centre of mass
    double yy, yz, zz;   // impulse of the film per velocity u that the land would have without it
    double spin;         // gamma A of the spin
} HalfFilm;

#ifndef DUAL
// Lever of the land from the centre of mass of half h.
INLINE double land_lever(const Model *model, int h)
{
    return (h == 0 ? -model->p->cage.land_x : model->p->cage.land_x) - model->d->com_x[h];
}

// Velocity of the land per impulse there.
INLINE double land_mobility(const Model *model, double lever)
{
    return 1.0 / model->p->cage.m + lever * lever / model->d->J_t;
}

// The film of half h.
INLINE HalfFilm half_film(const Model *model, const LandFilm *film, int h, double gamma)
{
    const Parameters *p = model->p;
    const double m = p->cage.m, J_p = model->d->J_p, J_t = model->d->J_t;
    const double x = land_lever(model, h), inv_m = land_mobility(model, x);
    const double yy = gamma * film->yy, yz = gamma * film->yz, zz = gamma * film->zz;

    // (1 + gamma C inv_m)^-1 gamma C, by Cramer's rule; it is symmetric.
    const double a = 1.0 + inv_m * yy, b = inv_m * yz, c = 1.0 + inv_m * zz, inv_det = 1.0 / (a * c - b * b);
    const double impulse_yy = (yy * c - yz * b) * inv_det;
    const double impulse_yz = (yz * a - yy * b) * inv_det;
    const double impulse_zz = (zz * a - yz * b) * inv_det;
    return (HalfFilm){m, J_p, J_t, x, impulse_yy, impulse_yz, impulse_zz, gamma * film->spin / J_p};
}

// Takes an impulse (y, z) on the land of half h from the half's velocities in v.
INLINE void half_push_land(const HalfFilm *f, int h, double I_y, double I_z, double *v)
{
    v[Y_CAGE_V_Y + h] -= I_y / f->m;
    v[Y_CAGE_V_Z + h] -= I_z / f->m;
    v[Y_CAGE_GAMMA_DOT + h] -= f->x * I_y / f->J_t;
    v[Y_CAGE_BETA_DOT + h] += f->x * I_z / f->J_t;
}

// v = (1 + gamma A)^-1 v of the velocities of half h, A of this film.
INLINE void half_film_solve(const HalfFilm *f, int h, double *v)
{
    const double u_y = v[Y_CAGE_V_Y + h] + v[Y_CAGE_GAMMA_DOT + h] * f->x,
                 u_z = v[Y_CAGE_V_Z + h] - v[Y_CAGE_BETA_DOT + h] * f->x;
    half_push_land(f, h, f->yy * u_y + f->yz * u_z, f->yz * u_y + f->zz * u_z, v);
    v[Y_CAGE_S + h] /= 1.0 + f->spin;
}
#endif
