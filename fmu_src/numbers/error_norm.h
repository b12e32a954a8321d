// Sums over the state vector, in a fixed order of partial sums, so that every instruction set gives the same bits.
#pragma once

#include "numbers/lanes.h"

// Sums of eight rows at a time wait for each other; four of them side by side do not.
enum { NORM_ROWS = 8, NORM_PARTS = 4 * NORM_ROWS };

INLINE double sum_of_parts(double part[NORM_PARTS])
{
    enum { ROWS_2 = 2 * NORM_ROWS, ROWS_3 = 3 * NORM_ROWS };

    for (int i = 0; i < NORM_ROWS; i++)
        part[i] = (part[i] + part[NORM_ROWS + i]) + (part[ROWS_2 + i] + part[ROWS_3 + i]);
    return ((part[0] + part[1]) + (part[2] + part[3])) + ((part[4] + part[5]) + (part[6] + part[7]));
}

// Of n rows, a number that the compiler knows where it inlines this function.
INLINE double sum_of_squares(int n, const double *x, const double *weight)
{
    const int whole = n / NORM_PARTS * NORM_PARTS;
    double part[NORM_PARTS] = {0};
    for (int i = 0; i < whole; i += NORM_PARTS)
        for (int k = 0; k < NORM_PARTS; k++)
            part[k] += (x[i + k] * weight[i + k]) * (x[i + k] * weight[i + k]);
    for (int i = whole; i < n; i++) part[i - whole] += (x[i] * weight[i]) * (x[i] * weight[i]);
    return sum_of_parts(part);
}

// Root of the mean of (x weight)^2; modes: with the rows of the cage's modes, which do not make the tolerance of the others wider.
static inline double error_norm(bool modes, const double *x, const double *weight)
{
    double sum = sum_of_squares(N_STATES, x, weight);
    if (modes) sum += sum_of_squares(N_ALL_STATES - N_STATES, x + N_STATES, weight + N_STATES);
    return sqrt(sum / N_STATES);
}

// Whether all are finite: the sum of x - x is 0 for finite x and NaN otherwise.
static inline bool all_finite(int n, const double *x)
{
    const int whole = n / NORM_PARTS * NORM_PARTS;
    double part[NORM_PARTS] = {0};
    for (int i = 0; i < whole; i += NORM_PARTS)
        for (int k = 0; k < NORM_PARTS; k++) part[k] += x[i + k] - x[i + k];
    for (int i = whole; i < n; i++) part[i - whole] += x[i] - x[i];
    return sum_of_parts(part) == 0.0;
}
