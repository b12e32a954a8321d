// Dual numbers in place of packets: value + derivative along one direction, one ball at a time.
//
// C has operators for complex numbers only.  With a derivative that is scaled by SEED these operators are the
// arithmetic of dual numbers:
//   (a + i b)(c + i d) = (a c - b d) + i (a d + b c),  b d ~ 1e-200 a c: lost in rounding, likewise in quotients
// Compiled with these types, the kernel files therefore give derivatives of their own formulas, exact to
// rounding.  Squire & Trapp (1998), SIAM Rev. 40, 110.  Choices (max, min, |x|, above) follow the value; at a
// kink the derivative is that of one side.
#pragma once

#ifdef DUAL

#include <complex.h>

#define SEED 1e-100

enum { HALVES = 1 };  // cage halves side by side

typedef scalar wide;
typedef bool bits;

// Functions beside those of the kernel files that are compiled for values and, under these names, for
// derivatives.
#define cage_energy FOR_ISA(cage_energy)
#define cage_flex FOR_ISA(cage_flex)
#define cage_slip FOR_ISA(cage_slip)
#define energy_total FOR_ISA(energy_total)
#define outputs_evaluate FOR_ISA(outputs_evaluate)

INLINE double scalar_value(scalar x)
{
    return creal(x);
}

INLINE scalar scalar_dual(double value, double derivative)
{
    return __builtin_complex(value, SEED * derivative);
}

INLINE double scalar_derivative(scalar x)
{
    return cimag(x) / SEED;
}

// f(x) from f and f' at the value of x.
INLINE scalar scalar_chain(scalar x, double f, double df_dx)
{
    return __builtin_complex(f, df_dx * cimag(x));
}

INLINE wide wide_set(scalar value)
{
    return value;
}

INLINE wide wide_pair(scalar first, scalar last)
{
    (void)last;  // first and last are the same half
    return first;
}

#define wide_lane(x, i) ((void)(i), (x))
#define wide_load(from) ((wide) * (from))  // both of scalars and of constants

INLINE void wide_store(scalar *to, wide value)
{
    *to = value;
}

INLINE bits wide_above(wide x, double limit)
{
    return creal(x) > limit;
}

#define wide_mask(condition) ((int)(condition))
#define wide_any(condition) (condition)

INLINE wide wide_select(bits condition, wide yes, wide no)
{
    return condition ? yes : no;
}

// Packets of one ball have no halves and no four lanes.
#define wide_join(x, y) ((void)(y), (x))
#define wide_last_half(x) (x)
#define wide_fill(x, lane) ((void)(lane), (x))
#define wide_sum_fours(x) (x)

INLINE wide wide_fma(wide x, wide y, wide z)
{
    return x * y + z;
}

INLINE wide wide_max(wide x, wide y)
{
    return creal(x) > creal(y) ? x : y;
}

INLINE wide wide_min(wide x, wide y)
{
    return creal(x) < creal(y) ? x : y;
}

INLINE wide wide_floor(wide x)
{
    return floor(creal(x));
}

INLINE wide wide_abs(wide x)
{
    return signbit(creal(x)) ? -x : x;
}

// The root of 0 gets the derivative 0: where kernels take the root of 0, a factor of 0 stands before the
// root, or the direction has no slope.
INLINE wide wide_sqrt(wide x)
{
    const double root = sqrt(creal(x));
    return scalar_chain(x, root, root > 0.0 ? 0.5 / root : 0.0);
}

INLINE scalar scalar_cbrt(scalar x)
{
    const double root = cbrt(creal(x));
    return scalar_chain(x, root, root != 0.0 ? 1.0 / (3.0 * root * root) : 0.0);
}

INLINE scalar scalar_asin(scalar x)
{
    return scalar_chain(x, asin(creal(x)), 1.0 / sqrt(1.0 - creal(x) * creal(x)));
}

INLINE scalar scalar_atan2(scalar y, scalar x)
{
    const double a = creal(x), b = creal(y), square = a * a + b * b;
    return __builtin_complex(atan2(b, a), (a * cimag(y) - b * cimag(x)) / square);
}

INLINE wide wide_exp(wide x)
{
    const double value = creal(x), power = value < -700.0 ? 0.0 : exp(fmin(value, 700.0));
    return scalar_chain(x, power, value > 700.0 ? 0.0 : power);
}

INLINE void wide_power_of_2(int n, const wide x[], wide power[])
{
    for (int i = 0; i < n; i++) power[i] = wide_exp(0.6931471805599453 * x[i]);
}

INLINE void wide_inv_sqrt(int n, const wide x[], wide y[])
{
    for (int i = 0; i < n; i++) {
        const double inverse = 1.0 / sqrt(creal(x[i]));
        y[i] = scalar_chain(x[i], inverse, -0.5 * inverse / creal(x[i]));
    }
}

INLINE wide wide_log(wide x)
{
    return scalar_chain(x, log(creal(x)), 1.0 / creal(x));
}

#define scalar_sqrt wide_sqrt
#define scalar_max wide_max
#define scalar_min wide_min
#define scalar_exp wide_exp
#define scalar_log wide_log

INLINE void wide_log2(wide x, wide y, wide *ln_x, wide *ln_y)
{
    *ln_x = wide_log(x);
    *ln_y = wide_log(y);
}

INLINE void wide_sincos(wide x, wide *sine, wide *cosine)
{
    const double s = sin(creal(x)), c = cos(creal(x));
    *sine = scalar_chain(x, s, c);
    *cosine = scalar_chain(x, c, -s);
}

INLINE wide wide_atan(wide x)
{
    return scalar_chain(x, atan(creal(x)), 1.0 / (1.0 + creal(x) * creal(x)));
}

#endif
