// Dual numbers in place of bundles: value + derivative along one direction, one ball at a time.
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

typedef number real;
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

INLINE double number_value(number x)
{
    return creal(x);
}
INLINE number number_dual(double value, double derivative)
{
    return __builtin_complex(value, SEED * derivative);
}
INLINE double number_derivative(number x)
{
    return cimag(x) / SEED;
}
// f(x) from f and f' at the value of x.
INLINE number number_chain(number x, double f, double df_dx)
{
    return __builtin_complex(f, df_dx * cimag(x));
}

INLINE real real_set(number value)
{
    return value;
}
INLINE real real_pair(number first, number last)
{
    (void)last;  // the same half
    return first;
}
#define real_lane(x, i) ((void)(i), (x))
#define real_load(from) ((real) * (from))  // of numbers and of constants
INLINE void real_store(number *to, real value)
{
    *to = value;
}
INLINE bits real_above(real x, double limit)
{
    return creal(x) > limit;
}
INLINE bool real_any(bits condition)
{
    return condition;
}
INLINE real real_select(bits condition, real yes, real no)
{
    return condition ? yes : no;
}
INLINE real real_fma(real x, real y, real z)
{
    return x * y + z;
}
INLINE real real_max(real x, real y)
{
    return creal(x) > creal(y) ? x : y;
}
INLINE real real_min(real x, real y)
{
    return creal(x) < creal(y) ? x : y;
}
INLINE real real_abs(real x)
{
    return signbit(creal(x)) ? -x : x;
}
// 0 has derivative 0: where kernels take the root of 0, a factor of 0 stands before it or the direction is without a slope.
INLINE real real_sqrt(real x)
{
    const double root = sqrt(creal(x));
    return number_chain(x, root, root > 0.0 ? 0.5 / root : 0.0);
}
INLINE number number_sqrt(number x)
{
    return real_sqrt(x);
}
INLINE number number_cbrt(number x)
{
    const double root = cbrt(creal(x));
    return number_chain(x, root, root != 0.0 ? 1.0 / (3.0 * root * root) : 0.0);
}
INLINE number number_asin(number x)
{
    return number_chain(x, asin(creal(x)), 1.0 / sqrt(1.0 - creal(x) * creal(x)));
}
INLINE number number_atan2(number y, number x)
{
    const double a = creal(x), b = creal(y), square = a * a + b * b;
    return __builtin_complex(atan2(b, a), (a * cimag(y) - b * cimag(x)) / square);
}
INLINE number number_max(number x, number y)
{
    return creal(x) > creal(y) ? x : y;
}
INLINE number number_min(number x, number y)
{
    return creal(x) < creal(y) ? x : y;
}
INLINE real real_exp(real x)
{
    const double value = creal(x), power = value < -700.0 ? 0.0 : exp(fmin(value, 700.0));
    return number_chain(x, power, value > 700.0 ? 0.0 : power);
}
INLINE real real_log(real x)
{
    return number_chain(x, log(creal(x)), 1.0 / creal(x));
}
INLINE number number_exp(number x)
{
    return real_exp(x);
}
INLINE number number_log(number x)
{
    return real_log(x);
}
INLINE void real_log2(real x, real y, real *ln_x, real *ln_y)
{
    *ln_x = real_log(x);
    *ln_y = real_log(y);
}
INLINE void real_sincos(real x, real *sine, real *cosine)
{
    const double s = sin(creal(x)), c = cos(creal(x));
    *sine = number_chain(x, s, c);
    *cosine = number_chain(x, c, -s);
}
INLINE real real_atan(real x)
{
    return number_chain(x, atan(creal(x)), 1.0 / (1.0 + creal(x) * creal(x)));
}

#endif
