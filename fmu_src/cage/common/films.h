// The films of the lands in the implicit step: how they slow one half of the cage.
//
// A land's film slows the velocity u of the land at the lever x, u_y = v_y + gamma_dot x and u_z = v_z - beta_dot x.
// Because u has two components, the inverse of the body's 4 x 4 block needs a 2 x 2 inverse only (Woodbury): with the
// film matrix C the impulse is (C^-1/gamma + 1/m + x^2/J_t)^-1 u = (yy, yz; yz, zz) u.
//
// A film on a bent rim (land_bent.h) slows the shapes of the rim too, whose mobilities are those of the modes: with Y, the
// mobilities of u and of the shapes, S = Y^1/2 and the matrix C of all, the impulse is gamma C S (1 + gamma S C S)^-1 S^-1 u.
#pragma once

#include "physics/model.h"

// Velocities of one half.
typedef struct {
    double x, y, z, beta, gamma, s;
} HalfVelocity;

// A land's film ready to be solved for one half.
typedef struct {
    double m, J_p, J_t;  // inertia of the half
    double x;            // lever of the land from the half's centre of mass
    double yy, yz, zz;   // impulse of the film per velocity u that the land would have without it
    double spin;         // gamma A of the spin
} HalfFilm;

#ifndef DUAL
// The film of half h.
INLINE HalfFilm half_film(const Model *model, const LandFilm *film, int h, double gamma)
{
    const Parameters *p = model->p;
    const double m = p->cage.m, J_p = model->d->J_p, J_t = model->d->J_t;
    const double x = (h == 0 ? -p->cage.land_x : p->cage.land_x) - model->d->com_x[h];
    const double inv_m = 1.0 / m + x * x / J_t;  // of the land against a force there
    const double yy = gamma * film->rate[0], yz = gamma * film->rate[1], zz = gamma * film->rate[2];

    // (1 + gamma C inv_m)^-1 gamma C, by Cramer's rule; it is symmetric.
    const double a = 1.0 + inv_m * yy, b = inv_m * yz, c = 1.0 + inv_m * zz, inv_det = 1.0 / (a * c - b * b);
    const double impulse_yy = (yy * c - yz * b) * inv_det;
    const double impulse_yz = (yz * a - yy * b) * inv_det;
    const double impulse_zz = (zz * a - yz * b) * inv_det;
    return (HalfFilm){m, J_p, J_t, x, impulse_yy, impulse_yz, impulse_zz, gamma * film->spin / J_p};
}

// Takes an impulse (y, z) on the land from the half's velocities.
INLINE void half_push_land(const HalfFilm *f, double I_y, double I_z, HalfVelocity *v)
{
    v->y -= I_y / f->m;
    v->z -= I_z / f->m;
    v->gamma -= f->x * I_y / f->J_t;
    v->beta += f->x * I_z / f->J_t;
}

// v = (1 + gamma A)^-1 v, A of this film.
INLINE void half_film_solve(const HalfFilm *f, HalfVelocity *v)
{
    const double u_y = v->y + v->gamma * f->x, u_z = v->z - v->beta * f->x;
    const double I_y = f->yy * u_y + f->yz * u_z, I_z = f->yz * u_y + f->zz * u_z;
    half_push_land(f, I_y, I_z, v);
    v->s /= 1.0 + f->spin;
}

// Impulse gamma C S (1 + gamma S C S)^-1 S^-1 u of a film of the rates C on land and rim, S^2 their mobilities.
INLINE void squeeze_impulse(const double rate[SQUEEZE_TERMS], double gamma, const double root[SQUEEZE],
                            const double u[SQUEEZE], double impulse[SQUEEZE])
{
    double A[SQUEEZE_TERMS], x[SQUEEZE], inv_D[SQUEEZE];
    for (int i = 0; i < SQUEEZE; i++) {
        x[i] = root[i] > 0.0 ? u[i] / root[i] : 0.0;
        for (int k = 0; k <= i; k++)
            A[SQUEEZE_AT(i, k)] = gamma * root[i] * root[k] * rate[SQUEEZE_AT(i, k)] + (i == k);
    }

    // A = L D L^T, x = A^-1 x
    for (int i = 0; i < SQUEEZE; i++) {
        for (int k = 1; k < i; k++)
            for (int q = 0; q < k; q++) A[SQUEEZE_AT(i, k)] -= A[SQUEEZE_AT(i, q)] * A[SQUEEZE_AT(k, q)];
        for (int k = 0; k < i; k++) {
            const double l = A[SQUEEZE_AT(i, k)] * inv_D[k];
            A[SQUEEZE_AT(i, i)] -= l * A[SQUEEZE_AT(i, k)];
            A[SQUEEZE_AT(i, k)] = l;
            x[i] -= l * x[k];
        }
        inv_D[i] = 1.0 / A[SQUEEZE_AT(i, i)];
    }
    for (int i = SQUEEZE - 1; i >= 0; i--) {
        x[i] *= inv_D[i];
        for (int k = i + 1; k < SQUEEZE; k++) x[i] -= A[SQUEEZE_AT(k, i)] * x[k];
    }
    for (int i = 0; i < SQUEEZE; i++) {
        impulse[i] = 0.0;
        for (int k = 0; k < SQUEEZE; k++)
            impulse[i] += gamma * rate[i < k ? SQUEEZE_AT(k, i) : SQUEEZE_AT(i, k)] * root[k] * x[k];
    }
}

// S of a half's land and rim.
INLINE void squeeze_roots(const HalfFilm *f, const double mobility[RIM], double root[SQUEEZE])
{
    root[0] = root[1] = sqrt(1.0 / f->m + f->x * f->x / f->J_t);
    for (int i = 0; i < RIM; i++) root[2 + i] = sqrt(mobility[i]);
}

// The same of a film on a bent rim: v and the velocities of its shapes, whose mobilities are given; on return the impulses on
// these.
INLINE void half_bent_solve(const HalfFilm *f, const LandFilm *film, double gamma, const double mobility[RIM],
                            HalfVelocity *v, double rim[RIM])
{
    double root[SQUEEZE], impulse[SQUEEZE], u[SQUEEZE] = {v->y + v->gamma * f->x, v->z - v->beta * f->x};
    memcpy(&u[2], rim, RIM * sizeof *rim);
    squeeze_roots(f, mobility, root);
    squeeze_impulse(film->rate, gamma, root, u, impulse);
    half_push_land(f, impulse[0], impulse[1], v);
    memcpy(rim, &impulse[2], RIM * sizeof *rim);
    v->s /= 1.0 + f->spin;
}

INLINE HalfVelocity half_velocity_load(const double *v, int h)
{
    return (HalfVelocity){.x = v[Y_CAGE_V_X + h],
                          .y = v[Y_CAGE_V_Y + h],
                          .z = v[Y_CAGE_V_Z + h],
                          .beta = v[Y_CAGE_BETA_DOT + h],
                          .gamma = v[Y_CAGE_GAMMA_DOT + h],
                          .s = v[Y_CAGE_S + h]};
}

INLINE void half_velocity_store(const HalfVelocity *half, double *v, int h)
{
    v[Y_CAGE_V_X + h] = half->x, v[Y_CAGE_V_Y + h] = half->y, v[Y_CAGE_V_Z + h] = half->z;
    v[Y_CAGE_BETA_DOT + h] = half->beta, v[Y_CAGE_GAMMA_DOT + h] = half->gamma, v[Y_CAGE_S + h] = half->s;
}
#endif
