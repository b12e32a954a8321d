// Film between the outer ring and the rim of a half that bends: the law of land_film.c with the gap of the bent rim.
//
//     w(theta) = u_2 cos 2 theta + u_3 sin 2 theta + u_4 cos 3 theta + u_5 sin 3 theta      radial, outward, by the modes
//     h = C - e.n - w,      W = V.n + w_dot - (omega/2) dw/dtheta                            closing, theta in the half's frame
//     P = -kappa C^3 max(W, 0)/h^3 dtheta                                                    radial load, outward
//
// With b = (n_y, n_z, cos 2 theta, sin 2 theta, cos 3 theta, sin 3 theta) the film has the forces F_i = int P b_i and the
// rates -dF_i/dV_k = kappa C^3 int b_i b_k/h^3 over the closing part: the matrix is symmetric and not negative, and F is
// the gradient of an integral of W^2/h^3.  Couette's torque is that of the gap, int C dtheta/(2 pi h); the pressure's is F.dV/domega.
//
// Where the gap closes, h stays finite like q^2 of a round land: h = C g_0/2 at the wall and C g_0/4 far behind it.  The
// dry contact is a linear bedding: pressure k s, s = -h, with k = (3/4) K_land sqrt(C/2), which for a round land,
// s = e - C - e theta^2/2, is F = K_land (e - C)^1.5.  Each point has Hunt and Crossley's damping by its own s_dot.
//
// The sums are over points that Sommerfeld's substitution of a round land of the same e spreads, with eps <= 0.9: 48 of
// them leave 0.05 % of the force in the median and 1 % in the worst twentieth of gaps down to -3 um.
//
// The second and the third wave of the load bend the rim.  All other waves load the rivets statically (elastic_lands.c): none of a film
// whose force is less than 2 % of the sum of the preloads, all from 4 % on, between them a smooth part.  Smoothness: that of land_film.c.
#pragma once

#include "physics/hertz.h"
#include "physics/traction.h"

static const double BENT_EPS = 0.9;  // largest eps of the points

// Load on a rim over the sum of the preloads up to which its waves do not load the rivets.
static const double FAINT_LOAD = 0.02;

// Whether the other waves of a film load the rivets.
INLINE bool land_is_felt(const Work *w, int h)
{
    return scalar_value(w->pressure[h].felt) > 0.0;
}

// Whether films bend the rims of the halves.
INLINE bool lands_bend(const Model *model)
{
    return model->modes && model->d->guided;
}

// 0 up to x = 0, 1 from x = 1 on, smooth between them.
INLINE scalar smooth_part(scalar x)
{
    x = scalar_min(scalar_max(x, 0.0), 1.0);
    return x * x * (3.0 - 2.0 * x);
}

// Part of a land's load that is not faint: none up to FAINT_LOAD times the sum of the preloads, all from twice that on.
INLINE scalar land_share(const Derived *d, const LandPressure *pressure)
{
    const scalar *film = pressure->film;
    const scalar load = scalar_sqrt(film[0] * film[0] + film[1] * film[1] + 1e-30) + pressure->dry;
    double preload = 0.0;
    for (int k = 0; k < Z; k++) preload += d->P[k];
    return smooth_part(load / (FAINT_LOAD * preload + 1e-30) - 1.0);
}

INLINE wide bent_dot(const scalar on_land[2], const scalar on_rim[RIM], const wide b[SQUEEZE])
{
    wide sum = wide_set(on_land[0]) * b[0] + wide_set(on_land[1]) * b[1];
    for (int i = 0; i < RIM; i++) sum += wide_set(on_rim[i]) * b[2 + i];
    return sum;
}

// A packet of points: shapes b, weight dtheta, gap by the geometry and of the film over the clearance, its inverse, dtheta over it,
// kappa C^3 dtheta/h^3.
typedef struct {
    wide b[SQUEEZE], weight, gap, open, inv_open, narrow, stiff;
} BentPoint;

// From point m on; u, eps, q: direction of e, Sommerfeld's substitution.
INLINE BentPoint bent_point(const Model *model, const LandPressure *pressure, const wide u[2], wide eps,
                            wide q, int m)
{
    BentPoint at;
    const wide c_psi = wide_load(&model->d->bent_cos[m]), s_psi = wide_load(&model->d->bent_sin[m]);
    const wide inv = 1.0 / (1.0 + eps * c_psi), inv_C = wide_set(1.0 / pressure->C);
    const wide cosine = (eps + c_psi) * inv, sine = q * s_psi * inv;
    const wide y = cosine * u[0] - sine * u[1], z = cosine * u[1] + sine * u[0];
    at.b[0] = y, at.b[1] = z;
    at.b[2] = y * y - z * z, at.b[3] = 2.0 * y * z;
    at.b[4] = y * at.b[2] - z * at.b[3], at.b[5] = y * at.b[3] + z * at.b[2];
    at.weight = (2.0 * PI / BENT_POINTS) * (q * inv);
    at.gap = (wide_set(pressure->C) - bent_dot(pressure->e, pressure->rim, at.b)) * inv_C;
    const double floor = 0.25 * model->p->cage.g_0;
    const wide above = at.gap - floor;
    at.open = floor + 0.5 * (above + wide_sqrt(above * above + 8.0 * floor * floor));
    at.inv_open = 1.0 / at.open;
    const wide inv_h = inv_C * at.inv_open;
    at.narrow = at.weight * at.inv_open;
    at.stiff = wide_set(pressure->kappa_C3) * at.narrow * inv_C * (inv_h * inv_h);
    return at;
}

// Sums over the points.  Forces are those that close, -F.
enum {
    BENT_FILM,
    BENT_RATES = BENT_FILM + SQUEEZE,        // waves of the rates (add_waves)
    BENT_COUETTE = BENT_RATES + BENT_WAVES,  // int C dtheta/h
    BENT_STIFFNESS,                          // int of the load per gap
    BENT_ROUGH,                              // int of the load of asperities, and times n
    BENT_DRY = BENT_ROUGH + 3,               // of the dry contact: forces, loads without and with damping,
    BENT_N_0 = BENT_DRY + SQUEEZE,
    BENT_N,
    BENT_STORED,  // energy and its rate
    BENT_STORED_RATE,
    BENT_SUMS,
    BENT_WET = (BENT_DRY + 7) / 8 * 8  // of a film without dry contact, in whole octets
};

// Adds those of the dry contact at a packet of points.
INLINE void bent_dry(const Parameters *p, const LandPressure *pressure, const BentPoint *at,
                     wide sum[BENT_SUMS])
{
    const wide pen = wide_max(-at->gap, wide_set(0.0)) * wide_set(pressure->C);
    const wide stiffness = wide_set(0.75 * p->cage.K_land * scalar_sqrt(0.5 * pressure->C)) * at->weight;
    const wide rate = bent_dot(pressure->v, pressure->rim_v, at->b), bed = stiffness * pen;
    const wide N = hertz_damped(bed, wide_set(p->cage.lambda), rate);
    for (int i = 0; i < SQUEEZE; i++) sum[BENT_DRY + i] += N * at->b[i];
    sum[BENT_STIFFNESS] += wide_select(wide_above(-at->gap, 0.0), stiffness, wide_set(0.0));
    sum[BENT_N_0] += bed;
    sum[BENT_N] += N;
    sum[BENT_STORED] += 0.5 * bed * pen;
    sum[BENT_STORED_RATE] += bed * rate;
}

// Adds a packet's rates times half of 1, cos theta, sin theta ... cos 6 theta, sin 6 theta.
INLINE void add_waves(wide rate, const wide b[SQUEEZE], wide to[BENT_WAVES])
{
    const wide half = 0.5 * rate, by_c_3 = half * b[4], by_s_3 = half * b[5];
    const wide by_c_2 = half * b[2], by_s_2 = half * b[3];
    to[0] += half;
    for (int i = 0; i < 2; i++) to[1 + i] = wide_fma(half, b[i], to[1 + i]);
    to[3] += by_c_2, to[4] += by_s_2;
    to[5] += by_c_3, to[6] += by_s_3;
    to[7] += by_c_2 * b[2] - by_s_2 * b[3];
    to[8] = wide_fma(2.0 * by_c_2, b[3], to[8]);
    to[9] += by_c_3 * b[2] - by_s_3 * b[3];
    to[10] += by_s_3 * b[2] + by_c_3 * b[3];
    to[11] += by_c_3 * b[4] - by_s_3 * b[5];
    to[12] = wide_fma(2.0 * by_c_3, b[5], to[12]);
}

// Adds those of the film.
INLINE void bent_film(const Model *model, const LandPressure *pressure, const BentPoint *at,
                      wide sum[BENT_SUMS])
{
    const wide *b = at->b, W = bent_dot(pressure->V, pressure->rim_V, b);
    const bits closing = wide_above(W, 0.0);
    sum[BENT_COUETTE] += at->narrow;
    if (!wide_any(closing)) return;
    const wide rate = wide_select(closing, at->stiff, wide_set(0.0)), load = rate * W;
    for (int i = 0; i < SQUEEZE; i++) sum[BENT_FILM + i] += load * b[i];
    add_waves(rate, b, &sum[BENT_RATES]);
    sum[BENT_STIFFNESS] += wide_set(3.0 / pressure->C) * (load * at->inv_open);
    if (model->p->scene.lubrication != LUBRICATION_MIXED) return;
    const wide thin = wide_set(pressure->C / model->d->C_land) * at->open;
    const wide rough = load * traction_asperity_share(model->d->ln_land + wide_log(thin));
    sum[BENT_ROUGH] += rough;
    sum[BENT_ROUGH + 1] += rough * b[0];
    sum[BENT_ROUGH + 2] += rough * b[1];
}

// Sets all sums of one land and its points.
INLINE void bent_sums(const Model *model, const LandPressure *pressure, BentGrid *grid,
                      scalar total[BENT_SUMS])
{
    const scalar e = scalar_sqrt(pressure->e[0] * pressure->e[0] + pressure->e[1] * pressure->e[1] + 1e-30),
                 inv_e = 1.0 / e, eps = scalar_min(e / pressure->C, BENT_EPS);
    const wide u[2] = {wide_set(pressure->e[0] * inv_e), wide_set(pressure->e[1] * inv_e)};
    const wide eps_wide = wide_set(eps), q = wide_set(scalar_sqrt(1.0 - eps * eps));
    wide sum[EIGHTHS][BENT_SUMS];
    bool dry = false;
    for (int part = 0; part < EIGHTHS; part++) {
        wide to[BENT_SUMS];
        for (int n = 0; n < BENT_SUMS; n++) to[n] = wide_set(0.0);
        for (int m = part * LANE_WIDTH; m < BENT_POINTS; m += 8) {
            const BentPoint at = bent_point(model, pressure, u, eps_wide, q, m);
            bent_film(model, pressure, &at, to);
            for (int i = 0; i < SQUEEZE; i++) wide_store(&grid->b[i][m], at.b[i]);
            wide_store(&grid->stiff[m], at.stiff);
            wide_store(&grid->behind[m], at.weight * wide_max(-at.gap, wide_set(0.0)));
            if (!wide_any(wide_above(-at.gap, 0.0))) continue;
            bent_dry(model->p, pressure, &at, to);
            dry = true;
        }
        memcpy(sum[part], to, sizeof to);
    }
    memset(total, 0, BENT_SUMS * sizeof *total);
    wide_column_sums(dry ? BENT_SUMS : BENT_WET, BENT_SUMS, sum[0], total);
}

// Rates yy, yz, zz along other axes: T^T D T.
INLINE void turn_rates(scalar T[2][2], const scalar D[3], scalar to[3])
{
    for (int i = 0; i < 2; i++)
        for (int k = 0; k <= i; k++)
            to[i + k] =
                T[0][i] * (D[0] * T[0][k] + D[1] * T[1][k]) + T[1][i] * (D[1] * T[0][k] + D[2] * T[1][k]);
}

// The film of a bent rim at the end of a step, along the half's axes: changes of the velocities of land and rim since the evaluation,
// impulses that take them from the residual, forces and rates.
typedef struct {
    double change[SQUEEZE], impulse[SQUEEZE], film[SQUEEZE], rates[SQUEEZE][SQUEEZE];
} BentSolution;

#ifndef DUAL
// A row of a matrix of squeeze velocities, padded to packets: multiplied by a number, and added to another one.
enum { SQUEEZE_ROW = 8 };

INLINE void row_scale(double times, double row[SQUEEZE_ROW])
{
    for (int k = 0; k < SQUEEZE_ROW; k += LANE_WIDTH) wide_store(&row[k], times * wide_load(&row[k]));
}

INLINE void row_add(double times, const double row[SQUEEZE_ROW], double to[SQUEEZE_ROW])
{
    for (int k = 0; k < SQUEEZE_ROW; k += LANE_WIDTH)
        wide_store(&to[k], wide_load(&to[k]) + times * wide_load(&row[k]));
}

// Whether the film at the predicted velocities of half h, in part borne by asperities, `rough` [N], has to be foreseen; then `seen` has the
// velocities at the step's end by it.
bool bent_foresee(const Work *w, int h, const scalar film[SQUEEZE], scalar rough, LandPressure *seen);

// Solves the implicit step of half h for its land and bent rim: the velocities change by the residual, which has the film's force
// at the evaluation, and by w->squeeze_by times the excess of the law's force at the end over that force.  V: squeeze velocities to
// begin with, then those of the end.
void bent_solve(const Work *w, int h, double gamma, const double residual[SQUEEZE], double V[SQUEEZE],
                BentSolution *to);

// Velocities, films and rates of bent rims become those of a step's end; returns the increase of the films' power, less
// the part of it on the halves' bodies that is of the second order in the changes by the solve.
double bent_arrive(const Derived *d, double gamma, const BentSolution solved[2], Work *w);
#endif
