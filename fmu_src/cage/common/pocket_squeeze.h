// The film of oil that a ball presses out of the gap to its pocket's wall.  Both are rigid here; a gap of the order of
// their elastic deflection has a floor.
//
//         wall, R_c                       h = C - S cos phi          gap around the pocket's axis, C = R_c - R
//      --.           .--                  h(phi, y) = h + y^2/(2R)   and along it, -a < y < b in the cage's section
//         `-. ___ .-'                     d/dy (h^3 dp/dy) = -12 eta v cos phi     the oil leaves along the axis: the gap is
//    phi -> ( ball )    y: along the axis         R_x/R_y = R_c/C times as wide around it; p = 0 at both ends
//           `-----'                       D_strip = 12 eta (I_2 - I_1^2/I_0),  I_n = integral of y^n/h^3 dy
//                                         D = 1/(1 + C/R_c) times the integral of D_strip cos^2 phi R_c dphi, cos phi > 0
//
// 1/(1 + C/R_c) is the exact factor R_x/(R_x + R_y) of the flow around the axis as h -> 0, where
//     D = c/h,  c = 12 pi eta (R_x R_y)^1.5/(R_x + R_y),  R_x = R R_c/C,  R_y = R        paraboloid
// Away from there D = G c/h, G a polynomial of z = sqrt(h/reach) through SQUEEZE_NODES values of that integral.  D is within
// 2 % of Reynolds' equation in two dimensions on the whole gap 0.005 C < h < C (tests/test_pocket_squeeze.py).
//
// Filling.  The oil lies as a layer of the thickness t = filling (C + b^2/(6R)) on the surfaces, b the longer side: the mean
// gap of a full pocket.  Where the gap is narrower, the layers meet and the oil is pushed aside along the axis, to where the
// mean gap is t: y_m^2 = 6R (t - h).  There p = 0.  The reach of the film is min(t, C).  A full pocket is wet to its ends.
//
// Floor.  h_eff^2 = h^2 + sigma^2 + h_e^2: roughness sigma, and h_e = 1.5 (c v/K)^0.4, the gap at which the film's pressure
// deflects both surfaces by as much as the gap (Davis, Serayssol & Hinch (1986), J. Fluid Mech. 163, 479).  1.5 is fitted to
// an impact by film and Hertz contact in series, 0.05 to 1 m/s.  In contact h is the approach: the film that is
// left gets no thinner.  So the force is within 3 % of Reynolds' where h > 4.2 sqrt(sigma^2 + h_e^2).
//
// Halves.  Each half has its part of the film, by its own gap and motion, beyond the split plane:
//     w = (1 + u/sqrt(1 + u^2))/2,  u = +- n_x/l,  l^2 = 2 h_eff/(C + 4 h_eff)
// The resultant of that part acts along m = n + kappa n_t (n_t a - n_x e_t), kappa = +- 0.85 l/(2 w sqrt(1 + u^2)), so that the
// film pushes the halves apart.  Force on the ball -F m, F = D w v.m, none where v.m < 0: the film cavitates.  The sum over both
// halves is one film, with sum of w kappa = 0.  F v.m >= 0 is lost, nothing is stored.  w is exact for the
// paraboloid; 4 and 0.85 are fitted to the strips' moments: w within 0.06 and w kappa within 0.1 of them for h < C/2.
//
// Smoothness: C1 but for v.m = 0, where it is C0.  Left out: the film's shear, which is in the friction of pocket.c, and
// the inertia of the oil.
#pragma once

#include "cage/common/pocket.h"
#include "cage/elastic/elastic_half.h"

// Constants of the films; called where those of the pockets are known.
void pocket_squeeze_derive(const Parameters *p, Derived *d);

// Nodes of the polynomials of z, Chebyshev's points from 0 to 1; values at the nodes -> coefficients in Newton's form.
void squeeze_nodes(double node[SQUEEZE_NODES]);
void squeeze_newton(const double node[SQUEEZE_NODES], double value[SQUEEZE_NODES]);

// The film of one half in a packet of pockets.
typedef struct {
    wide D, F;  // F = D v.m, 0 where the ball withdraws [N.s/m, N]
    vec m;
} SqueezeFilm;

// No films yet.
INLINE void squeeze_clear(const Model *model, Work *w)
{
    if (!model->d->squeeze.filled) return;
    memset(w->cage.films.D, 0, sizeof w->cage.films.D);
}

// Leaves a film to the step (pocket_films.c).
INLINE void squeeze_leave(const SqueezeFilm *film, vec v, const PocketAxes *at, int h, int j, Work *w)
{
    FilmWork *to = &w->cage.films;
    wide_store(&to->D[h][j], film->D);
    wide_store(&to->u[h][j], vec_dot(film->m, v));
    wide_store(&to->m[0][h][j], vec_dot(film->m, at->a));
    wide_store(&to->m[1][h][j], vec_dot(film->m, at->b));
    wide_store(&to->m[2][h][j], vec_dot(film->m, at->e_t));
}

// The motion of wall k by each mode along its film; a wall that is not near has none.
INLINE void squeeze_wall(const Model *model, int h, int k, const WallShape *shape, Work *w)
{
#ifndef DUAL
    FilmWork *films = &w->cage.films;
    if (!(films->D[h][k] > model->modes->weak_film)) return;
    const double m[3] = {films->m[0][h][k], films->m[1][h][k], films->m[2][h][k]};
    elastic_wall_along(model->modes, k, shape, m, films->shape[h][k]);
#else
    (void)model, (void)h, (void)k, (void)shape, (void)w;
#endif
}

INLINE wide squeeze_polynomial(const double node[SQUEEZE_NODES], const double newton[SQUEEZE_NODES], wide z)
{
    wide value = wide_set(newton[SQUEEZE_NODES - 1]);
    for (int i = SQUEEZE_NODES - 2; i >= 0; i--) value = wide_fma(value, z - node[i], wide_set(newton[i]));
    return value;
}

// Damping of a whole film / (c/h_eff), by the gap.
INLINE wide squeeze_shape(const PocketSqueeze *film, wide h, int j)
{
    const wide z = wide_sqrt(wide_min(h * wide_load(&film->inv_reach[j]), wide_set(1.0)) + 1e-30);
    return wide_max(squeeze_polynomial(film->node, film->newton, z), wide_set(0.0));
}

// v: velocity of the ball's centre against the wall.
INLINE SqueezeFilm pocket_squeeze(const Derived *d, int half, int j, const PocketGap *gap, vec v)
{
    const PocketSqueeze *film = &d->squeeze;
    const wide zero = wide_set(0.0), c = wide_load(&film->c[j]);
    const vec a = gap->axes.a, e_t = gap->axes.e_t;
    const wide v_x = vec_dot(v, a), v_t = vec_dot(v, e_t), n_x = gap->n_x, n_t = gap->n_t;

    // gap with its floor; below 1 nm/s the film is linear in the speed
    const wide closing = wide_max(n_x * v_x + n_t * v_t, wide_set(1e-9));
    const wide h_e2 = film->elastic * wide_exp(0.8 * wide_log(closing));
    const wide h_2 = gap->delta * gap->delta + (h_e2 + film->roughness_2), h = wide_sqrt(h_2);

    // part of the half
    const double side = half == 0 ? -1.0 : 1.0;
    const wide l_2 = 2.0 * h / (wide_load(&film->C[j]) + 4.0 * h), nn = n_x * n_x;
    const wide root = wide_sqrt(l_2 + nn);  // l sqrt(1 + u^2)
    const wide w = 0.5 * (1.0 + side * n_x / root), across = (0.425 * side) * l_2 / (w * root) * n_t;
    const vec m = vec_axpy(n_t - across * n_x, e_t, vec_scale(n_x + across * n_t, a));

    const wide D = w * c * squeeze_shape(film, wide_max(-gap->delta, zero), j) / h;
    const wide speed = (n_x + across * n_t) * v_x + (n_t - across * n_x) * v_t;
    return (SqueezeFilm){D, D * wide_max(speed, zero), m};
}
