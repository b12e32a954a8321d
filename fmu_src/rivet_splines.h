// Quadratic B-splines of the rivet table (see rivet_rom.h): of one axis, and their tensor product.
#pragma once

#include "rivet_rom.h"

// Splines of one axis that are not 0 at a point: index of the first coefficient, number of splines, their
// weights.  At the axis' start, where idle loads are, there is only one.
typedef struct {
    int first, count;
    scalar w[3];
} Splines;

// Cell of u: the cell in which the bin of u begins, or one of the next few.  A short axis is searched from its
// start.
INLINE const RivetCell *axis_cell(const RivetAxis *axis, double u)
{
    enum { SHORT = 8 };

    const RivetCell *cell = axis->cell, *last = &axis->cell[axis->cells - 1];
    if (axis->cells > SHORT) {
        const double bin =
            scalar_min(scalar_max((u - axis->start) * axis->inv_bin, 0.0), RIVET_BINS);  // a NaN gives bin 0
        cell = &axis->cell[axis->bin[(int)bin]];
    }
    while (u >= cell->end && cell < last) cell++;
    return cell;
}

// Quadratic B-splines (de Boor) at u inside the axis.  Their sum is 1, and they are C1 at the knots.
INLINE Splines axis_splines(const RivetAxis *axis, scalar u)
{
#ifndef DUAL
    if (u == axis->start) return (Splines){.count = 1, .w = {1.0, 0.0, 0.0}};
#endif
    const RivetCell *cell = axis_cell(axis, scalar_value(u));
    const scalar up = u - cell->start, down = cell->end - u;
    Splines s = {.first = (int)(cell - axis->cell), .count = 3};
    s.w[0] = down * down * cell->fall;
    s.w[2] = up * up * cell->rise;
    s.w[1] = 1.0 - s.w[0] - s.w[2];
    return s;
}

// s times the splines of xi = fit/s.  Outside the axis they are computed without xi, because s may vanish
// there.
INLINE Splines axis_splines_xi(const RivetAxis *axis, scalar xi, scalar s, double fit)
{
    if (fit <= scalar_value(s) * axis->start) return (Splines){.count = 3, .w = {s, 0.0, 0.0}};
    const scalar beyond = fit - s * axis->end;
    if (scalar_value(beyond) >=
        0.0) {  // value and slope at the axis' end; the slope is 2 h rise of the last spline
        const RivetCell *last = &axis->cell[axis->cells - 1];
        const scalar w = 2.0 * (last->end - last->start) * last->rise * beyond;
        return (Splines){.first = axis->cells - 1, .count = 3, .w = {0.0, -w, s + w}};
    }
    Splines splines = axis_splines(axis, xi);
    for (int i = 0; i < 3; i++) splines.w[i] *= s;
    return splines;
}

// The point of a load in the table; the splines of xi carry the factor s.
typedef struct {
    Splines at[RIVET_AXES];
    int sheet;        // first of the two sheets around chi
    scalar first[2];  // weight of this sheet in head and middle
} TablePoint;

// Stress of a pair of channels: tensor product of the splines over 3^3 coefficients of two sheets.  The sums
// run over c, a, xi and chi in this order.
#ifdef DUAL
INLINE void contract(const RivetTable *t, const float *coefficients, const TablePoint *point, scalar sigma[2])
{
    const Splines *A = &point->at[RIVET_A], *C = &point->at[RIVET_C], *X = &point->at[RIVET_XI];
    int n_c = t->axis[RIVET_C].cells + 2, n_xi = t->axis[RIVET_XI].cells + 2;
    sigma[0] = sigma[1] = 0.0;
    for (int i = 0; i < 27; i++) {
        int a = i / 9, c = i / 3 % 3, x = i % 3;
        int index = ((A->first + a) * n_c + C->first + c) * n_xi + X->first + x;
        const float *T = coefficients + 2 * (RIVET_SHEETS * index + point->sheet);
        scalar weight = A->w[a] * C->w[c] * X->w[x];
        for (int k = 0; k < 2; k++)
            sigma[k] += weight * (point->first[k] * T[k] + (1.0 - point->first[k]) * T[2 + k]);
    }
}
#else
// Two channels of two neighbouring sheets side by side, as they lie in the table.  Functions take this type
// by pointer: by value it would need AVX registers, which the baseline instruction set lacks.
typedef double quad __attribute__((vector_size(32)));

// Four coefficients as doubles.
INLINE void fetch(const float *from, quad *to)
{
#if defined(__AVX__)
    *to = (quad)_mm256_cvtps_pd(_mm_loadu_ps(from));
#else
    *to = (quad){from[0], from[1], from[2], from[3]};
#endif
}

// sum += w x.
INLINE void add_part(double w, const quad *x, quad *sum)
{
    const quad weight = {w, w, w, w};
#if defined(FUSED) && defined(__FMA__)
    *sum = (quad)_mm256_fmadd_pd((__m256d)weight, (__m256d)*x, (__m256d)*sum);
#elif defined(FUSED) && defined(__ARM_NEON)
    for (int i = 0; i < 4; i++) (*sum)[i] = fma(w, (*x)[i], (*sum)[i]);
#else
    *sum += weight * *x;
#endif
}

INLINE void contract(const RivetTable *t, const float *coefficients, const TablePoint *point, double sigma[2])
{
    const Splines *A = &point->at[RIVET_A], *C = &point->at[RIVET_C], *X = &point->at[RIVET_XI];
    const int n_c = t->axis[RIVET_C].cells + 2, n_xi = t->axis[RIVET_XI].cells + 2;
    const int xi = 2 * RIVET_SHEETS, row = n_xi * xi;  // coefficients between neighbours in xi, in c
    const float *origin = coefficients + xi * X->first + 2 * point->sheet;

    // sums over c, b and a for each spline of xi
    quad sum[3] = {{0}, {0}, {0}}, all = {0};
    for (int a = 0; a < A->count; a++) {
        const float *T = origin + row * ((A->first + a) * n_c + C->first);
        quad sum_a[3] = {{0}, {0}, {0}};
        for (int c = 0; c < C->count; c++, T += row) {
            for (int x = 0; x < 3; x++) {
                quad value;
                fetch(T + x * xi, &value);
                add_part(C->w[c], &value, &sum_a[x]);
            }
        }
        for (int x = 0; x < 3; x++) add_part(A->w[a], &sum_a[x], &sum[x]);
    }

    // sums over xi and over the two sheets
    for (int x = 0; x < 3; x++) add_part(X->w[x], &sum[x], &all);
    const double *first = point->first;
    sigma[0] = first[0] * all[0] + (1.0 - first[0]) * all[2];
    sigma[1] = first[1] * all[1] + (1.0 - first[1]) * all[3];
}
#endif
