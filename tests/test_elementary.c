// The elementary functions of the bundles, callable over arrays: compiled once per instruction set, like the kernels, and once for the core.
#include "lanes.h"

void FOR_ISA(test_exp)(int n, const double *x, double *y);
void FOR_ISA(test_log)(int n, const double *x, double *y);
void FOR_ISA(test_log2)(int n, const double *x, double *y, double *z);
void FOR_ISA(test_sincos)(int n, const double *x, double *sine, double *cosine);
void FOR_ISA(test_atan)(int n, const double *x, double *y);

void FOR_ISA(test_exp)(int n, const double *x, double *y)
{
    for (int i = 0; i < n; i++) y[i] = real_lane(real_exp(real_set(x[i])), 0);
}

void FOR_ISA(test_log)(int n, const double *x, double *y)
{
    for (int i = 0; i < n; i++) y[i] = real_lane(real_log(real_set(x[i])), 0);
}

// Logarithms of x and of 1/x.
void FOR_ISA(test_log2)(int n, const double *x, double *y, double *z)
{
    for (int i = 0; i < n; i++) {
        real one, other;
        real_log2(real_set(x[i]), real_set(1.0 / x[i]), &one, &other);
        y[i] = real_lane(one, 0), z[i] = real_lane(other, 0);
    }
}

void FOR_ISA(test_sincos)(int n, const double *x, double *sine, double *cosine)
{
    for (int i = 0; i < n; i++) {
        real s, c;
        real_sincos(real_set(x[i]), &s, &c);
        sine[i] = real_lane(s, 0), cosine[i] = real_lane(c, 0);
    }
}

void FOR_ISA(test_atan)(int n, const double *x, double *y)
{
    for (int i = 0; i < n; i++) y[i] = real_lane(real_atan(real_set(x[i])), 0);
}
