// Quadratic B-splines of the rivet table (see rivet_rom.h): of one axis, and their tensor product.
#pragma once

#include "rivet_rom.h"

#include <string.h>

// Active splines of one axis: index of the first coefficient, their weights, and how many there are: one at the axis' start, where idle loads are.
typedef struct {
    int first, count;
    number w[3];
} Splines;

// Cell of u, by bisection: number of inner knots not above it; fewer than twice MOST_CELLS of them.
INLINE int axis_cell(const RivetAxis *axis, number u)
{
    enum { MOST_CELLS = 32 };
    int cell = 0;
    for (int step = MOST_CELLS; step > 0; step /= 2)
        if (cell + step < axis->cells && number_value(u) >= axis->knot[cell + step]) cell += step;
    return cell;
}

// Quadratic B-splines (de Boor), u inside the axis, in its cell i.  Their sum is 1; C1 at the knots.
INLINE Splines axis_splines(const RivetAxis *axis, int i, number u)
{
#ifndef DUAL
    if (u == axis->knot[0]) return (Splines){.count = 1, .w = {1.0, 0.0, 0.0}};
#endif
    number up = u - axis->knot[i], down = axis->knot[i + 1] - u;
    Splines s = {.first = i, .count = 3};
    s.w[0] = down * down * axis->fall[i];
    s.w[2] = up * up * axis->rise[i];
    s.w[1] = 1.0 - s.w[0] - s.w[2];
    return s;
}

// s times the splines of xi = fit/s in its cell; outside the axis without xi, as s may vanish.
INLINE Splines axis_splines_xi(const RivetAxis *axis, int cell, number xi, number s, double fit)
{
    int last = axis->cells - 1;
    if (fit <= number_value(s) * axis->knot[0]) return (Splines){.count = 3, .w = {s, 0.0, 0.0}};
    number beyond = fit - s * axis->knot[axis->cells];
    if (number_value(beyond) >= 0.0) {  // end value and end slope, which is 2 h rise of the last spline
        number w = 2.0 * (axis->knot[last + 1] - axis->knot[last]) * axis->rise[last] * beyond;
        return (Splines){.first = last, .count = 3, .w = {0.0, -w, s + w}};
    }
    Splines splines = axis_splines(axis, cell, xi);
    for (int i = 0; i < 3; i++) splines.w[i] *= s;
    return splines;
}

// A load's place in the table; the splines of xi carry the factor s.
typedef struct {
    Splines at[RIVET_AXES];
    int sheet;        // the first of the two sheets around chi
    number first[2];  // its weight in head and middle
} Place;

// Tensor product over 3^4 coefficients of two sheets for a pair of channels.  Order of sums: xi with chi, c, b, a.
#ifdef DUAL
INLINE void contract(const RivetTable *t, const float *coefficients, const Place *place, number sigma[2])
{
    const Splines *A = &place->at[RIVET_A], *B = &place->at[RIVET_B], *C = &place->at[RIVET_C], *X = &place->at[RIVET_XI];
    int n_b = t->axis[RIVET_B].cells + 2, n_c = t->axis[RIVET_C].cells + 2, n_xi = t->axis[RIVET_XI].cells + 2;
    sigma[0] = sigma[1] = 0.0;
    for (int i = 0; i < 81; i++) {
        int a = i / 27, b = i / 9 % 3, c = i / 3 % 3, x = i % 3;
        int place_xi = (((A->first + a) * n_b + B->first + b) * n_c + C->first + c) * n_xi + X->first + x;
        const float *T = coefficients + 2 * (RIVET_SHEETS * place_xi + place->sheet);
        number weight = A->w[a] * B->w[b] * C->w[c] * X->w[x];
        for (int k = 0; k < 2; k++) sigma[k] += weight * (place->first[k] * T[k] + (1.0 - place->first[k]) * T[2 + k]);
    }
}
#else
// Two channels of two neighbouring sheets side by side, as they lie in the table.
typedef double quad __attribute__((vector_size(32)));

// By pointer: as a value it would want registers that the baseline does not have.
INLINE void fetch(const float *from, quad *to)
{
#if defined(__AVX__)
    *to = (quad)_mm256_cvtps_pd(_mm_loadu_ps(from));
#else
    *to = (quad){from[0], from[1], from[2], from[3]};
#endif
}

INLINE void contract(const RivetTable *t, const float *coefficients, const Place *place, double sigma[2])
{
    const Splines *A = &place->at[RIVET_A], *B = &place->at[RIVET_B], *C = &place->at[RIVET_C], *X = &place->at[RIVET_XI];
    const int n_b = t->axis[RIVET_B].cells + 2, n_c = t->axis[RIVET_C].cells + 2, n_xi = t->axis[RIVET_XI].cells + 2;
    const int xi = 2 * RIVET_SHEETS, row = n_xi * xi;  // coefficients from one xi, one c to the next
    const quad sheets = {place->first[0], place->first[1], 1.0 - place->first[0], 1.0 - place->first[1]};
    const quad w[3] = {X->w[0] * sheets, X->w[1] * sheets, X->w[2] * sheets};
    quad sum = {0};
    for (int a = 0; a < A->count; a++) {
        quad sum_a = {0};
        for (int b = 0; b < B->count; b++) {
            const float *T = coefficients + row * (((A->first + a) * n_b + B->first + b) * n_c + C->first) + xi * X->first + 2 * place->sheet;
            quad sum_b = {0};
            for (int c = 0; c < C->count; c++, T += row) {
                quad low, mid, high;
                fetch(T, &low);
                fetch(T + xi, &mid);
                fetch(T + 2 * xi, &high);
                sum_b += C->w[c] * (w[0] * low + w[1] * mid + w[2] * high);
            }
            sum_a += B->w[b] * sum_b;
        }
        sum += A->w[a] * sum_a;
    }
    sigma[0] = sum[0] + sum[2];
    sigma[1] = sum[1] + sum[3];
}
#endif
