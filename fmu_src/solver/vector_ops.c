// Operations on the state vector, for a state with and one without the modes of the cage.  They
// run element by element, or sum in a fixed order of partial sums, so that every instruction set gives the same bits.
#include "solver/vector_ops.h"

enum { MORE = N_ALL_STATES - N_STATES };  // rows of the modes

// ---- for n rows, a number that the compiler knows where it inlines these functions ----------------------------

INLINE void sum_of_two(int n, double a, const double *x, double b, const double *y, double *z)
{
    for (int i = 0; i < n; i++) z[i] = a * x[i] + b * y[i];
}

// Linear combination of `count` vectors in one pass.  z may be one of the vectors.
INLINE void combine(int n, int count, const double *c, double *const *x, double *z)
{
    for (int i = 0; i < n; i++) {
        double sum = c[0] * x[0][i];
        for (int k = 1; k < count; k++) sum += c[k] * x[k][i];
        z[i] = sum;
    }
}

INLINE void combine_any(int n, int count, const double *c, double *const *x, double *z)
{
    switch (count) {
#define CASE(count) \
    case count: combine(n, count, c, x, z); return
        CASE(1);
        CASE(2);
        CASE(3);
        CASE(4);
        CASE(5);
        CASE(6);
#undef CASE
    default: combine(n, count, c, x, z);
    }
}

// Sums of eight rows at a time wait for each other; four of them side by side do not.
enum { ROWS = 8, PARTS = 4 * ROWS };

INLINE double sum_of_parts(double part[PARTS])
{
    for (int i = 0; i < ROWS; i++)
        part[i] = (part[i] + part[ROWS + i]) + (part[2 * ROWS + i] + part[3 * ROWS + i]);
    return ((part[0] + part[1]) + (part[2] + part[3])) + ((part[4] + part[5]) + (part[6] + part[7]));
}

INLINE double sum_of_squares(int n, const double *x, const double *w)
{
    const int whole = n / PARTS * PARTS;
    double part[PARTS] = {0};
    for (int i = 0; i < whole; i += PARTS)
        for (int k = 0; k < PARTS; k++) part[k] += (x[i + k] * w[i + k]) * (x[i + k] * w[i + k]);
    for (int i = whole; i < n; i++) part[i - whole] += (x[i] * w[i]) * (x[i] * w[i]);
    return sum_of_parts(part);
}

// The sum of x - x, which is 0 for a finite x and NaN otherwise.
INLINE bool finite_rows(int n, const double *x)
{
    const int whole = n / PARTS * PARTS;
    double part[PARTS] = {0};
    for (int i = 0; i < whole; i += PARTS)
        for (int k = 0; k < PARTS; k++) part[k] += x[i + k] - x[i + k];
    for (int i = whole; i < n; i++) part[0] += x[i] - x[i];
    return sum_of_parts(part) == 0.0;
}

// ---- without the modes ------------------------------------------------------------------------------------------

static void linear_sum(double a, const double *x, double b, const double *y, double *z)
{
    sum_of_two(N_STATES, a, x, b, y, z);
}

static void linear_combination(int count, const double *c, double *const *x, double *z)
{
    combine_any(N_STATES, count, c, x, z);
}

static double wrms_norm(const double *x, const double *w)
{
    return sqrt(sum_of_squares(N_STATES, x, w) / N_STATES);
}

static bool all_finite(const double *x)
{
    return finite_rows(N_STATES, x);
}

const VectorOps vector_ops = {N_STATES, linear_sum, linear_combination, wrms_norm, all_finite};

// ---- with the modes ---------------------------------------------------------------------------------------------

static void linear_sum_all(double a, const double *x, double b, const double *y, double *z)
{
    sum_of_two(N_ALL_STATES, a, x, b, y, z);
}

static void linear_combination_all(int count, const double *c, double *const *x, double *z)
{
    combine_any(N_ALL_STATES, count, c, x, z);
}

// The divisor stays: more states do not make the tolerance of the others wider.
static double wrms_norm_all(const double *x, const double *w)
{
    return sqrt((sum_of_squares(N_STATES, x, w) + sum_of_squares(MORE, x + N_STATES, w + N_STATES)) /
                N_STATES);
}

static bool all_finite_all(const double *x)
{
    return finite_rows(N_ALL_STATES, x);
}

const VectorOps vector_ops_all = {N_ALL_STATES, linear_sum_all, linear_combination_all, wrms_norm_all,
                                  all_finite_all};
