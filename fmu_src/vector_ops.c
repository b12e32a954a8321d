// Operations on the state vector.  They run element by element, or sum in eight partial sums, so that every
// instruction set gives the same bits.
#include "vector_ops.h"

#define ALL(i) for (int i = 0; i < N_STATES; i++)

static void linear_sum(double a, const double *x, double b, const double *y, double *z)
{
    ALL(i) z[i] = a * x[i] + b * y[i];
}

// Linear combination of n vectors in one pass; the compiler knows n where it inlines this function.  z may be
// one of the vectors.
INLINE void combine(int n, const double *c, double *const *x, double *z)
{
    ALL(i)
    {
        double sum = c[0] * x[0][i];
        for (int k = 1; k < n; k++) sum += c[k] * x[k][i];
        z[i] = sum;
    }
}

static void linear_combination(int n, const double *c, double *const *x, double *z)
{
    switch (n) {
#define CASE(n) \
    case n: combine(n, c, x, z); return
        CASE(1);
        CASE(2);
        CASE(3);
        CASE(4);
        CASE(5);
        CASE(6);
    default: combine(n, c, x, z);
    }
#undef CASE
}

static double wrms_norm(const double *x, const double *w)
{
    double part[8] = {0};

    enum { WHOLE = N_STATES / 8 * 8 };

    for (int i = 0; i < WHOLE; i += 8)
        for (int k = 0; k < 8; k++) part[k] += (x[i + k] * w[i + k]) * (x[i + k] * w[i + k]);
    for (int i = WHOLE; i < N_STATES; i++) part[i - WHOLE] += (x[i] * w[i]) * (x[i] * w[i]);
    const double sum =
        ((part[0] + part[1]) + (part[2] + part[3])) + ((part[4] + part[5]) + (part[6] + part[7]));
    return sqrt(sum / N_STATES);
}

static bool all_finite(const double *x)
{
    double part[8] = {0};  // sums of x - x, which is 0 for a finite x and NaN otherwise

    enum { WHOLE = N_STATES / 8 * 8 };

    for (int i = 0; i < WHOLE; i += 8)
        for (int k = 0; k < 8; k++) part[k] += x[i + k] - x[i + k];
    for (int i = WHOLE; i < N_STATES; i++) part[0] += x[i] - x[i];
    return ((part[0] + part[1]) + (part[2] + part[3])) + ((part[4] + part[5]) + (part[6] + part[7])) == 0.0;
}

const VectorOps vector_ops = {N_STATES, linear_sum, linear_combination, wrms_norm, all_finite};

// ---- with the states of elastic cage halves -----------------------------------------------------------------
enum { MORE = N_ALL_STATES - N_STATES };

#define EACH_MORE(i) for (int i = N_STATES; i < N_ALL_STATES; i++)

static void linear_sum_all(double a, const double *x, double b, const double *y, double *z)
{
    linear_sum(a, x, b, y, z);
    EACH_MORE(i) z[i] = a * x[i] + b * y[i];
}

static void linear_combination_all(int n, const double *c, double *const *x, double *z)
{
    EACH_MORE(i)
    {
        double sum = c[0] * x[0][i];
        for (int k = 1; k < n; k++) sum += c[k] * x[k][i];
        z[i] = sum;
    }
    linear_combination(n, c, x, z);
}

// The divisor stays: more states do not make the tolerance of the others wider.
static double wrms_norm_all(const double *x, const double *w)
{
    double part[8] = {0};
    const double others = wrms_norm(x, w);
    for (int i = 0; i < MORE; i += 8)
        for (int k = 0; k < 8; k++) {
            const double e = x[N_STATES + i + k] * w[N_STATES + i + k];
            part[k] += e * e;
        }
    const double sum =
        ((part[0] + part[1]) + (part[2] + part[3])) + ((part[4] + part[5]) + (part[6] + part[7]));
    return sqrt(others * others + sum / N_STATES);
}

static bool all_finite_all(const double *x)
{
    bool finite = all_finite(x);
    EACH_MORE(i) finite &= x[i] - x[i] == 0.0;
    return finite;
}

_Static_assert(MORE % 8 == 0, "eight partial sums");

const VectorOps vector_ops_elastic = {N_ALL_STATES, linear_sum_all, linear_combination_all, wrms_norm_all,
                                      all_finite_all};
