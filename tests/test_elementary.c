// The elementary functions of the packets, callable over arrays: compiled once per instruction set, like the
// kernels, and once for the core.
#include "numbers/lanes.h"

void FOR_ISA(test_exp)(int n, const double *x, double *y);
void FOR_ISA(test_power_of_2)(int n, const double *x, double *y);
void FOR_ISA(test_inv_sqrt)(int n, const double *x, double *y);
void FOR_ISA(test_log)(int n, const double *x, double *y);
void FOR_ISA(test_log2)(int n, const double *x, double *y, double *z);
void FOR_ISA(test_sincos)(int n, const double *x, double *sine, double *cosine);
void FOR_ISA(test_atan)(int n, const double *x, double *y);

void FOR_ISA(test_exp)(int n, const double *x, double *y)
{
    for (int i = 0; i < n; i++) y[i] = wide_lane(wide_exp(wide_set(x[i])), 0);
}

// These two take packets together: x[i] goes last.
void FOR_ISA(test_power_of_2)(int n, const double *x, double *y)
{
    wide several[ABREAST], powers[ABREAST];
    for (int k = 0; k < ABREAST; k++) several[k] = wide_set(k + 1.0);
    for (int i = 0; i < n; i++) {
        several[ABREAST - 1] = wide_set(x[i]);
        wide_power_of_2(ABREAST, several, powers);
        y[i] = wide_lane(powers[ABREAST - 1], 0);
    }
}

void FOR_ISA(test_inv_sqrt)(int n, const double *x, double *y)
{
    wide several[ABREAST], inverse[ABREAST];
    for (int k = 0; k < ABREAST; k++) several[k] = wide_set(k + 1.0);
    for (int i = 0; i < n; i++) {
        several[ABREAST - 1] = wide_set(x[i]);
        wide_inv_sqrt(ABREAST, several, inverse);
        y[i] = wide_lane(inverse[ABREAST - 1], 0);
    }
}

void FOR_ISA(test_log)(int n, const double *x, double *y)
{
    for (int i = 0; i < n; i++) y[i] = wide_lane(wide_log(wide_set(x[i])), 0);
}

// Logarithms of x and of 1/x.
void FOR_ISA(test_log2)(int n, const double *x, double *y, double *z)
{
    for (int i = 0; i < n; i++) {
        wide one, other;
        wide_log2(wide_set(x[i]), wide_set(1.0 / x[i]), &one, &other);
        y[i] = wide_lane(one, 0), z[i] = wide_lane(other, 0);
    }
}

void FOR_ISA(test_sincos)(int n, const double *x, double *sine, double *cosine)
{
    for (int i = 0; i < n; i++) {
        wide s, c;
        wide_sincos(wide_set(x[i]), &s, &c);
        sine[i] = wide_lane(s, 0), cosine[i] = wide_lane(c, 0);
    }
}

void FOR_ISA(test_atan)(int n, const double *x, double *y)
{
    for (int i = 0; i < n; i++) y[i] = wide_lane(wide_atan(wide_set(x[i])), 0);
}
