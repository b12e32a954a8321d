// Quadratic B-splines of the rivet table (see rivet_rom.h): of one axis, and their tensor product.
#pragma once

#include "rivet/rivet_rom.h"

// Splines of one axis that are not 0 at a point: index of the first coefficient, and three weights.
typedef struct {
    int first;
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
INLINE void axis_splines(const RivetAxis *axis, scalar u, Splines *splines)
{
    const RivetCell *cell = axis_cell(axis, scalar_value(u));
    const scalar up = u - cell->start, down = cell->end - u, w_0 = down * down * cell->fall,
                 w_2 = up * up * cell->rise;
    splines->first = (int)(cell - axis->cell);
    splines->w[0] = w_0;
    splines->w[1] = 1.0 - w_0 - w_2;
    splines->w[2] = w_2;
}

// s times the splines of xi = fit/s.  Outside the axis they are computed without xi, because s may vanish
// there.
INLINE void axis_splines_xi(const RivetAxis *axis, scalar xi, scalar s, double fit, Splines *splines)
{
    const scalar beyond = fit - s * axis->end;
    if (fit <= scalar_value(s) * axis->start)
        *splines = (Splines){0, {s, 0.0, 0.0}};
    else if (scalar_value(beyond) >= 0.0) {
        // value and slope at the axis' end; the slope is 2 h rise of the last spline
        const RivetCell *last = &axis->cell[axis->cells - 1];
        const scalar w = 2.0 * (last->end - last->start) * last->rise * beyond;
        *splines = (Splines){axis->cells - 1, {0.0, -w, s + w}};
    } else {
        axis_splines(axis, xi, splines);
        for (int i = 0; i < 3; i++) splines->w[i] *= s;
    }
}

// The point of a load in the table; the splines of xi carry the factor s.
typedef struct {
    Splines at[RIVET_AXES];
    int sheet;        // first of the two sheets around chi
    scalar first[2];  // weight of this sheet in head and middle
} TablePoint;

// Stress of a pair of channels: tensor product of the splines over 3^3 coefficients of two sheets.  The sums
// run over xi, c, a and chi in this order.  At the start of the axis a, where idle rivets are, there is only one
// spline of a.
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
    const float *T = coefficients + row * (A->first * n_c + C->first) + xi * X->first + 2 * point->sheet;
    const int splines_a = A->first == 0 && A->w[2] == 0.0 ? 1 : 3;
    quad all = {0};
    for (int a = 0; a < splines_a; a++, T += n_c * row) {
        quad sum_a = {0};
        for (int c = 0; c < 3; c++) {
            quad sum_c = {0};
            for (int x = 0; x < 3; x++) {
                quad value;
                fetch(T + c * row + x * xi, &value);
                add_part(X->w[x], &value, &sum_c);
            }
            add_part(C->w[c], &sum_c, &sum_a);
        }
        add_part(A->w[a], &sum_a, &all);
    }
    const double *first = point->first;
    sigma[0] = all[2] + first[0] * (all[0] - all[2]);
    sigma[1] = all[3] + first[1] * (all[1] - all[3]);
}
#endif
