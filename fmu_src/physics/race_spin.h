// Traction of a contact whose slip varies over the long axis of the ellipse, by spin and curvature:
//   Delta u(xi) = Delta u + Delta omega x (xi t_2 - xi^2/(2 R_m) n),  pressure (3/4)(1 - xi^2/a^2) per length
// in slices on both sides of where the slip changes its sign, because the traction is nearly a step there.
// With x = xi/a the slip along t_1 is s_1 + k x + b_1 x^2; the place is x_0 = -s_1 k/(k^2 + b_1^2), not
// beyond the ends.  That is the root where spin (k) outweighs curvature (b_1); the two roots of curvature lie
// about the middle, which x_0 tends to.
#pragma once

#include "physics/race_normal.h"
#include "physics/traction.h"

// Slices on both sides of the place x_0 that splits the ellipse, x = xi/a in [-1, 1]: x = x_0 (1 - z) + side z with
// weights (3/4)(1 + side x)(1 - side x_0)^2 w, where z and w are Gauss-Jacobi's points for the weight 1 - z on [0, 1].
// They integrate the pressure (3/4)(1 - x^2) times polynomials up to degree 10 on each side exactly.
// Slices 3 l to 3 l + 2 are the threes l = 0...3, two on each side: THIRDS rows with a slice of each.  Rows
// are repeated, so that a packet may hold one row for each of two contacts.
enum { SIDES = 2, ONE_SIDE = 6, THREES = 4, THIRDS = 3, ROW = 8 };

#define BOTH_SIDES(sign, x, y) {sign(x), sign(y), x, y, sign(x), sign(y), x, y}

static const struct {
    double near[THIRDS][ROW];  // 1 - z, coefficient of x_0 in x
    double far[THIRDS][ROW];   // side z, part of x by the ellipse's end
    double w[THIRDS][ROW];     // w
} SLICE = {{BOTH_SIDES(+, 0.9706835728402151, 0.4413284812284498),
            BOTH_SIDES(+, 0.8519214003315158, 0.2307661379699455),
            BOTH_SIDES(+, 0.6630153097188457, 0.073054328680259)},
           {BOTH_SIDES(-, 0.02931642715978494, 0.5586715187715502),
            BOTH_SIDES(-, 0.1480785996684843, 0.7692338620300545),
            BOTH_SIDES(-, 0.3369846902811543, 0.926945671319741)},
           {BOTH_SIDES(+, 0.0723103307255089, 0.0986611508906552),
            BOTH_SIDES(+, 0.13554249723151868, 0.04395516555050896),
            BOTH_SIDES(+, 0.14079255378819883, 0.008738301813609529)}};

// A race's constants at the contacts of a packet.
typedef struct {
    wide a_delta;         // a/sqrt(delta)
    wide half_curvature;  // 1/(2 R_m)
    wide ln_Lambda, rolling, horizontal;
} RaceConstants;

// Film of a contact: mean surface speed with its floor, 1/U, asperities' share of the load, rolling friction
// of the inlet.
typedef struct {
    wide U, inv_U, f_a, F_R;
} Film;

// Values common to the slices of a contact.  Slip along t_1 and t_2: s_1 + k x + b_1 x^2, s_2 + b_2 x^2.
typedef struct {
    wide s_1, s_2, k, b_1, b_2, inv_U, f_a;
    wide x_0;  // where the ellipse is split
    wide Q;
} SlicedContact;

// A slice: its side, -1 or 1, and coefficients of SLICE.
typedef struct {
    wide side, near, far, w;
} Slice;

// Sums over the slices of g x^n, n < MOMENTS, g = |traction| / |slip|.  The traction is -g times the slip, and the slip a
// polynomial in x: forces, moments and power follow from these sums.
enum { MOMENTS = 5 };

// Place x_0 = -s_1 k/(k^2 + b_1^2) where the slip s_1 + k x + b_1 x^2 changes its sign, within the ellipse.
INLINE wide split_place(wide s_1, wide k, wide b_1)
{
    const wide x_0 = -(s_1 * k) / (k * k + b_1 * b_1 + TINY);
    return wide_max(wide_min(x_0, wide_set(1.0)), wide_set(-1.0));
}

// g x^m of n <= ABREAST packets of a contact's slices.
INLINE void slice_tractions(const Parameters *p, int n, const SlicedContact *c, const Slice slice[],
                            bool mixed, wide g[][MOMENTS])
{
    wide x[ABREAST], slip_2[ABREAST], inv_slip[ABREAST], s[ABREAST], f_a[ABREAST], mu[ABREAST];
    for (int i = 0; i < n; i++) {
        x[i] = wide_fma(c->x_0, slice[i].near, slice[i].far);
        const wide s_1 = wide_fma(x[i], wide_fma(x[i], c->b_1, c->k), c->s_1);
        const wide s_2 = wide_fma(x[i] * x[i], c->b_2, c->s_2);
        slip_2[i] = wide_fma(s_1, s_1, wide_fma(s_2, s_2, wide_set(p->oil.v_0 * p->oil.v_0)));
    }
    wide_inv_sqrt(n, slip_2, inv_slip);
    for (int i = 0; i < n; i++) s[i] = slip_2[i] * inv_slip[i] * c->inv_U, f_a[i] = c->f_a;
    traction_mu(p, n, s, f_a, mixed, mu);
    for (int i = 0; i < n; i++) {
        const wide half = 1.0 - slice[i].side * c->x_0, load = 0.75 * c->Q * (half * half);
        const wide side_w = slice[i].side * slice[i].w;
        g[i][0] = wide_fma(side_w, x[i], slice[i].w) * load * (mu[i] * inv_slip[i]);
        for (int m = 1; m < MOMENTS; m++) g[i][m] = g[i][m - 1] * x[i];
    }
}

INLINE wide sum_of_three(wide g[][MOMENTS], int m)
{
    return g[0][m] + g[1][m] + g[2][m];
}

// Sums slice by slice, all slices of one side together.
INLINE void slice_by_slice(const Parameters *p, const SlicedContact *c, bool mixed, wide out[MOMENTS])
{
    wide part[SIDES][MOMENTS];
    for (int side = 0; side < SIDES; side++) {
        const wide sign = wide_set(side == 0 ? -1.0 : 1.0);
        Slice slice[ONE_SIDE];
        wide g[ONE_SIDE][MOMENTS];
        for (int i = 0; i < ONE_SIDE; i++) {
            const int third = i % THIRDS, three = THREES / SIDES * side + i / THIRDS;
            slice[i] = (Slice){sign, wide_set(SLICE.near[third][three]), wide_set(SLICE.far[third][three]),
                               wide_set(SLICE.w[third][three])};
        }
        slice_tractions(p, ONE_SIDE, c, slice, mixed, g);
        for (int m = 0; m < MOMENTS; m++)
            part[side][m] = sum_of_three(&g[0], m) + sum_of_three(&g[THIRDS], m);
    }
    for (int m = 0; m < MOMENTS; m++) out[m] = part[0][m] + part[1][m];
}

// The same sums, in the same order, where a quarter of a packet with four lanes, or half of one with eight,
// has the slices of one contact: THIRDS packets for each lane with a contact among the first four.
INLINE void contact_by_contact(const Parameters *p, const SlicedContact *all, int lanes, int balls,
                               bool mixed, wide out[MOMENTS])
{
    static const double LANE[ROW] = {0.0, 1.0, 2.0, 3.0, 0.0, 1.0, 2.0, 3.0};
    static const double SIDE[ROW] = {-1.0, -1.0, 1.0, 1.0, -1.0, -1.0, 1.0, 1.0};

    for (int m = 0; m < MOMENTS; m++) out[m] = wide_set(0.0);
    for (int k = 0; k < lanes; k++) {
        const int lane = k % balls + k / balls * (LANE_WIDTH / 2);
        const SlicedContact c = {.s_1 = wide_fill(all->s_1, lane),
                                 .s_2 = wide_fill(all->s_2, lane),
                                 .k = wide_fill(all->k, lane),
                                 .b_1 = wide_fill(all->b_1, lane),
                                 .b_2 = wide_fill(all->b_2, lane),
                                 .inv_U = wide_fill(all->inv_U, lane),
                                 .f_a = wide_fill(all->f_a, lane),
                                 .x_0 = wide_fill(all->x_0, lane),
                                 .Q = wide_fill(all->Q, lane)};
        Slice slice[THIRDS];
        wide g[THIRDS][MOMENTS];
        for (int i = 0; i < THIRDS; i++)
            slice[i] = (Slice){wide_load(SIDE), wide_load(SLICE.near[i]), wide_load(SLICE.far[i]),
                               wide_load(SLICE.w[i])};
        slice_tractions(p, THIRDS, &c, slice, mixed, g);
        const bits here = wide_above(0.5 - wide_abs(wide_load(LANE) - (double)lane), 0.0);
        for (int m = 0; m < MOMENTS; m++)
            out[m] = wide_select(here, wide_sum_fours(sum_of_three(g, m)), out[m]);
    }
}

// Traction over the long axis of the ellipse, of a packet's contacts: `balls` at one race or at each of both.
INLINE Tangential sliced_traction(const Parameters *p, const RaceConstants *race, const Contact *c,
                                  const Film *film, int contacts, int balls, bool mixed)
{
    const wide a = race->a_delta * c->sqrt_delta, sagitta = a * a * race->half_curvature;
    const wide spin_n = vec_dot(c->spin, c->n), k = -(a * spin_n);
    const wide s_1 = vec_dot(c->slip, c->t_1), b_1 = -(sagitta * vec_dot(c->spin, c->t_2));
    const wide s_2 = vec_dot(c->slip, c->t_2), b_2 = sagitta * vec_dot(c->spin, c->t_1);
    const SlicedContact common = {.s_1 = s_1,
                                  .s_2 = s_2,
                                  .k = k,
                                  .b_1 = b_1,
                                  .b_2 = b_2,
                                  .inv_U = film->inv_U,
                                  .f_a = film->f_a,
                                  .x_0 = split_place(s_1, k, b_1),
                                  .Q = c->Q};
    // lanes with contacts among the first four: with fewer than four, contact by contact takes fewer packets
    const int lanes = LANE_WIDTH == 8 ? balls : LANE_WIDTH == 4 ? contacts : THREES;
    wide g[MOMENTS];
    if (lanes < THREES)
        contact_by_contact(p, &common, lanes, balls, mixed, g);
    else
        slice_by_slice(p, &common, mixed, g);

    // sums of -F_1 x^n and -F_2 x^n, F = -g slip
    wide F_1[3], F_2[3];
    for (int n = 0; n < 3; n++) {
        F_1[n] = wide_fma(b_1, g[n + 2], wide_fma(k, g[n + 1], s_1 * g[n]));
        F_2[n] = wide_fma(b_2, g[n + 2], s_2 * g[n]);
    }
    // a slice's lever about the ball's centre: (R - sagitta x^2) n + a x t_2
    Tangential out;
    out.g = g[0], out.g_spin = a * a * g[2];
    out.dissipated =
        wide_fma(s_1, F_1[0], k * F_1[1]) + wide_fma(b_1, F_1[2], wide_fma(s_2, F_2[0], b_2 * F_2[2]));
    const wide spin_M = a * F_1[1];
    out.F_s = vec_axpy(-F_1[0], c->t_1, vec_scale(-F_2[0], c->t_2));
    out.M = vec_axpy(sagitta * F_1[2] - c->R * F_1[0], c->t_2,
                     vec_axpy(c->R * F_2[0] - sagitta * F_2[2], c->t_1, vec_scale(spin_M, c->n)));
    out.spin_dissipated = -(spin_M * spin_n);
    return out;
}
