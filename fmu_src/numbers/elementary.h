// Elementary functions of single numbers.  They use the functions of packets (lanes.h) and not those of the
// platform's C library, so that the model is the same on every platform, bit for bit.
#pragma once

#include "numbers/lanes.h"

// Whether any of the numbers is not 0: by their bits without the sign, because comparisons are made one by one.
static inline bool any_not_zero(const double *x, int count)
{
    uint64_t any = 0;
    for (int i = 0; i < count; i++) {
        uint64_t bits;
        memcpy(&bits, &x[i], sizeof bits);
        any |= bits << 1;
    }
    return any != 0;
}

#ifndef DUAL

static inline double portable_exp(double x)
{
    return wide_exp(wide_set(x))[0];
}

static inline double portable_log(double x)
{
    return wide_log(wide_set(x))[0];
}

static inline double portable_sin(double x)
{
    wide sine, cosine;
    wide_sincos(wide_set(x), &sine, &cosine);
    return sine[0];
}

static inline double portable_cos(double x)
{
    wide sine, cosine;
    wide_sincos(wide_set(x), &sine, &cosine);
    return cosine[0];
}

static inline double portable_atan(double x)
{
    return wide_atan(wide_set(x))[0];
}

// |x| < 1
static inline double portable_asin(double x)
{
    return portable_atan(x / sqrt((1.0 - x) * (1.0 + x)));
}

// x^y of x >= 0, relative error < 3e-15 (1 + |y ln x|)
static inline double portable_pow(double x, double y)
{
    return x > 0.0 ? portable_exp(y * portable_log(x)) : 0.0;
}

// Cube root of x >= 0; one step of Newton's method gives the last bits.
static inline double portable_cbrt(double x)
{
    const double y = portable_pow(x, 1.0 / 3.0);
    return y > 0.0 ? y - (y * y * y - x) / (3.0 * y * y) : 0.0;
}

// x^(-1/3) of a normal x > 0, relative error < 2e-5: minus a third of the number's bits, read as an integer,
// is a first guess, which two steps of Newton's method improve.
static inline double approx_inv_cbrt(double x)
{
    int64_t bits_of;
    double y;
    memcpy(&bits_of, &x, sizeof x);
    bits_of = 0x553ef00000000000 - bits_of / 3;
    memcpy(&y, &bits_of, sizeof y);
    for (int i = 0; i < 2; i++) y *= 4.0 / 3.0 - (1.0 / 3.0) * x * y * y * y;
    return y;
}

// The same functions of scalars, for which dual.h has versions with derivatives.
#define scalar_exp portable_exp
#define scalar_log portable_log
#define scalar_asin portable_asin
#define scalar_cbrt portable_cbrt
#define scalar_atan2 atan2

#endif
