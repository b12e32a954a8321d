// Dual numbers in place of packets: value + derivative along one direction, one ball at a time.
//
// C has operators for complex numbers only, and with a derivative scaled by SEED they are the arithmetic of dual numbers:
//   (a + i b)(c + i d) = (a c - b d) + i (a d + b c),  b d ~ 1e-200 a c: gone to the last bit, likewise in quotients
// so the kernel files, compiled with these types, give exact derivatives (to rounding) of the very formulas they give values of.
// Squire & Trapp (1998), SIAM Rev. 40, 110.  Choices (max, min, |x|, above) follow the value; at a kink one side's derivative is taken.
#pragma once

#ifdef DUAL

#include <complex.h>

#define SEED 1e-100
enum { HALVES = 1 };  // cage halves side by side

typedef scalar wide;
typedef bool bits;

// What is compiled for values and, here, for derivatives, beside the kernel files (isa.h).
#define energy_total FOR_ISA(energy_total)
#define rivet_rom_stress FOR_ISA(rivet_rom_stress)
#define rivet_rom_fit_flags FOR_ISA(rivet_rom_fit_flags)
#define rivet_rom_fit_eff FOR_ISA(rivet_rom_fit_eff)
#define joint_preload FOR_ISA(joint_preload)
#define joint_fit FOR_ISA(joint_fit)
#define joint_hole_stiffness FOR_ISA(joint_hole_stiffness)
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
    (void)last;  // the same half
    return first;
}
#define wide_lane(x, i) ((void)(i), (x))
#define wide_load(from) ((wide) * (from))  // of numbers and of constants
INLINE void wide_store(scalar *to, wide value)
{
    *to = value;
}
INLINE bits wide_above(wide x, double limit)
{
    return creal(x) > limit;
}
INLINE bool wide_any(bits condition)
{
    return condition;
}
INLINE wide wide_select(bits condition, wide yes, wide no)
{
    return condition ? yes : no;
}
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
INLINE wide wide_abs(wide x)
{
    return signbit(creal(x)) ? -x : x;
}
INLINE wide wide_floor(wide x)
{
    return floor(creal(x));
}
// 0 has derivative 0: where kernels take the root of 0, a factor of 0 stands before it or the direction is without a slope.
INLINE wide wide_sqrt(wide x)
{
    const double root = sqrt(creal(x));
    return scalar_chain(x, root, root > 0.0 ? 0.5 / root : 0.0);
}
INLINE scalar scalar_sqrt(scalar x)
{
    return wide_sqrt(x);
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
INLINE scalar scalar_max(scalar x, scalar y)
{
    return creal(x) > creal(y) ? x : y;
}
INLINE scalar scalar_min(scalar x, scalar y)
{
    return creal(x) < creal(y) ? x : y;
}
INLINE wide wide_exp(wide x)
{
    const double value = creal(x), power = value < -700.0 ? 0.0 : exp(fmin(value, 700.0));
    return scalar_chain(x, power, value > 700.0 ? 0.0 : power);
}
INLINE wide wide_log(wide x)
{
    return scalar_chain(x, log(creal(x)), 1.0 / creal(x));
}
INLINE scalar scalar_exp(scalar x)
{
    return wide_exp(x);
}
INLINE scalar scalar_log(scalar x)
{
    return wide_log(x);
}
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
