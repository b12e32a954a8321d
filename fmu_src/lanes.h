// Arithmetic on bundles of doubles: the balls (or joints, or cage halves) of one bundle are computed side by side.
//
// `real` holds LANE_WIDTH doubles and has C's operators; a bundle's code reads like the code for one ball.  The kernel files are compiled
// once per instruction set, and every function that another file calls gets that set's name as a suffix (FOR_ISA).
// Each lane does the same IEEE operations in the same order whatever the width, and sums run over balls in a fixed order (lanes_sum), so all
// instruction sets with a fused multiply-add (FUSED: AVX2, AVX-512, NEON) give the same bits, and all without one.  It stands where it is
// written, real_fma; compilers contract nothing into it.
// `number` is one of a bundle's numbers, for whatever depends on the state; dual.h makes both dual numbers, which carry a derivative.
#pragma once

#include "variables.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#ifndef LANE_WIDTH
#define LANE_WIDTH 2
#endif
#ifndef ISA
#define ISA generic
#endif
#define FOR_ISA_2(name, isa) name##_##isa
#define FOR_ISA_1(name, isa) FOR_ISA_2(name, isa)
#define FOR_ISA(name) FOR_ISA_1(name, ISA)

#if defined(__SSE2__)
#include <immintrin.h>
#elif defined(__ARM_NEON) && LANE_WIDTH == 2
#include <arm_neon.h>
#endif

// Arrays over balls are padded to LANES; bundles cover the first BUNDLES * LANE_WIDTH of them.  Lanes past Z hold harmless ghosts.
enum { LANES = (Z + 7) / 8 * 8, BUNDLES = (Z + LANE_WIDTH - 1) / LANE_WIDTH };

#define INLINE static inline __attribute__((always_inline))

#ifdef DUAL
#include "dual.h"
#else
#if LANE_WIDTH == 1
enum { HALVES = 1 };
#else
enum { HALVES = 2 };  // cage halves are lanes too, this many side by side (real_pair)
#endif

typedef double real __attribute__((vector_size(8 * LANE_WIDTH)));
typedef int64_t bits __attribute__((vector_size(8 * LANE_WIDTH)));  // a comparison's result: all ones where true
typedef uint64_t words __attribute__((vector_size(8 * LANE_WIDTH)));

INLINE double number_value(number x)
{
    return x;
}
INLINE number number_sqrt(number x)
{
    return sqrt(x);
}
INLINE number number_max(number x, number y)
{
    return x > y ? x : y;
}
INLINE number number_min(number x, number y)
{
    return x < y ? x : y;
}
INLINE real real_set(double value)
{
    return value - (real){0};
}
// Numbers of the first and the last of HALVES cage halves: half 0 in lane 0, half 1 in the others.
INLINE real real_pair(double first, double last)
{
    real value = real_set(last);
    value[0] = first;
    return value;
}
#define real_lane(x, i) ((x)[i])  // a function would copy the bundle
INLINE real real_load(const double *from)
{
    real value;
    memcpy(&value, from, sizeof value);
    return value;
}
INLINE void real_store(double *to, real value)
{
    memcpy(to, &value, sizeof value);
}
INLINE real real_select(bits condition, real yes, real no)
{
#if defined(__AVX512F__) && LANE_WIDTH == 8
    return (real)_mm512_mask_blend_pd(_mm512_movepi64_mask((__m512i)condition), (__m512d)no, (__m512d)yes);
#elif defined(__AVX__) && LANE_WIDTH == 4
    return (real)_mm256_blendv_pd((__m256d)no, (__m256d)yes, (__m256d)condition);
#else
    return (real)((condition & (bits)yes) | (~condition & (bits)no));
#endif
}
INLINE bits real_above(real x, double limit)
{
    return x > limit;
}
INLINE bool real_any(bits condition)
{
#if defined(__AVX512F__) && LANE_WIDTH == 8
    return _mm512_movepi64_mask((__m512i)condition) != 0;
#elif defined(__AVX__) && LANE_WIDTH == 4
    return _mm256_movemask_pd((__m256d)condition) != 0;
#elif defined(__SSE2__) && LANE_WIDTH == 2
    return _mm_movemask_pd((__m128d)condition) != 0;
#else
    int64_t any = 0;
    for (int i = 0; i < LANE_WIDTH; i++) any |= condition[i];
    return any != 0;
#endif
}
INLINE real real_sqrt(real x)
{
#if defined(__AVX512F__) && LANE_WIDTH == 8
    return (real)_mm512_sqrt_pd((__m512d)x);
#elif defined(__AVX__) && LANE_WIDTH == 4
    return (real)_mm256_sqrt_pd((__m256d)x);
#elif defined(__SSE2__) && LANE_WIDTH == 2
    return (real)_mm_sqrt_pd((__m128d)x);
#elif defined(__ARM_NEON) && LANE_WIDTH == 2
    return (real)vsqrtq_f64((float64x2_t)x);
#else
    for (int i = 0; i < LANE_WIDTH; i++) x[i] = sqrt(x[i]);
    return x;
#endif
}
// x y + z with one rounding where the kernels' instruction set has it.
INLINE real real_fma(real x, real y, real z)
{
#if defined(FUSED) && defined(__AVX512F__) && LANE_WIDTH == 8
    return (real)_mm512_fmadd_pd((__m512d)x, (__m512d)y, (__m512d)z);
#elif defined(FUSED) && defined(__FMA__) && LANE_WIDTH == 4
    return (real)_mm256_fmadd_pd((__m256d)x, (__m256d)y, (__m256d)z);
#elif defined(FUSED) && defined(__ARM_NEON) && LANE_WIDTH == 2
    return (real)vfmaq_f64((float64x2_t)z, (float64x2_t)x, (float64x2_t)y);
#else
    return x * y + z;
#endif
}
INLINE real real_max(real x, real y)  // y where x is NaN, like the x86 instruction
{
#if defined(__AVX512F__) && LANE_WIDTH == 8
    return (real)_mm512_max_pd((__m512d)x, (__m512d)y);
#elif defined(__AVX__) && LANE_WIDTH == 4
    return (real)_mm256_max_pd((__m256d)x, (__m256d)y);
#elif defined(__SSE2__) && LANE_WIDTH == 2
    return (real)_mm_max_pd((__m128d)x, (__m128d)y);
#else
    return real_select(x > y, x, y);
#endif
}
INLINE real real_min(real x, real y)
{
    return -real_max(-x, -y);
}
INLINE real real_abs(real x)
{
    return (real)((bits)x & INT64_MAX);
}

// Nearest integer of |x| < 2^51 as a double and as an integer, by the rounding of x + 1.5 * 2^52.
INLINE real real_round(real x, bits *n)
{
    const real shift = real_set(6755399441055744.0);
    const real shifted = x + shift;
    *n = (bits)shifted - (bits)shift;
    return shifted - shift;
}

// The polynomials below are Chebyshev fits over the reduced ranges; the errors are those of tests/test_lanes.py.

// e^x, relative error < 3e-15; 0 below -700, e^700 above 700.
INLINE real real_exp(real x)
{
    const bits underflow = x < -700.0;
    x = real_max(real_min(x, real_set(700.0)), real_set(-700.0));
    bits n;
    const real k = real_round(x * 1.4426950408889634, &n);
    const real r = real_fma(k, real_set(-1.6465949582897082e-12), real_fma(k, real_set(-0.6931471805582987), x));  // ln 2 in two parts
    real p = real_set(2.761380686153829e-07);
    p = real_fma(p, r, real_set(2.762511557828763e-06));
    p = real_fma(p, r, real_set(2.4801536388690766e-05));
    p = real_fma(p, r, real_set(0.00019841208732536384));
    p = real_fma(p, r, real_set(0.0013888888905881542));
    p = real_fma(p, r, real_set(0.008333333353729397));
    p = real_fma(p, r, real_set(0.04166666666665136));
    p = real_fma(p, r, real_set(0.1666666666664829));
    p = real_fma(p, r, real_set(0.5));
    p = real_fma(p * r, r, r) + 1.0;
    return real_select(underflow, real_set(0.0), (real)((words)p + ((words)n << 52)));
}

// x = 2^k m with sqrt(1/2) <= m < sqrt(2).
INLINE real real_split(real x, real *m)
{
    const uint64_t one = 0x3ff0000000000000, sqrt_half = 0x3fe6a09e667f3bcd, two_52 = 0x4330000000000000;  // the bits of these numbers
    const words exponent = ((words)x + (one - sqrt_half)) >> 52;                                           // k + 1023
    *m = (real)((words)x - (exponent << 52) + one);
    return (real)(exponent | two_52) - (4503599627370496.0 + 1023.0);
}
// k ln 2 + 2 atanh t
INLINE real real_log_of(real k, real t)
{
    const real z = t * t;
    real p = real_set(0.166219470901774);
    p = real_fma(p, z, real_set(0.18140185202493248));
    p = real_fma(p, z, real_set(0.22222862476849542));
    p = real_fma(p, z, real_set(0.2857142413651635));
    p = real_fma(p, z, real_set(0.400000000112122));
    p = real_fma(p, z, real_set(0.6666666666666208));
    return real_fma(k, real_set(0.6931471805582987), real_fma(k, real_set(1.6465949582897082e-12), real_fma(t * z, p, 2.0 * t)));
}
// ln x of a normal x > 0, relative error < 3e-15.
INLINE real real_log(real x)
{
    real m;
    const real k = real_split(x, &m);
    return real_log_of(k, (m - 1.0) / (m + 1.0));
}
// Two logarithms for one division.
INLINE void real_log2(real x, real y, real *ln_x, real *ln_y)
{
    real m, n;
    const real k = real_split(x, &m), l = real_split(y, &n), both = 1.0 / ((m + 1.0) * (n + 1.0));
    *ln_x = real_log_of(k, (m - 1.0) * (n + 1.0) * both);
    *ln_y = real_log_of(l, (n - 1.0) * (m + 1.0) * both);
}

// sin x and cos x, absolute error < 3e-16 for |x| < 1e7.
INLINE void real_sincos(real x, real *sine, real *cosine)
{
    bits n;
    const real k = real_round(x * 0.6366197723675814, &n);
    const real near = real_fma(k, real_set(-9.920935791635221e-10), real_fma(k, real_set(-1.570796325802803), x));
    const real r = real_fma(k, real_set(-5.170182981794105e-19), near);  // pi/2 in three parts
    const real z = r * r;
    real p = real_set(1.591810123027412e-10), q = real_set(-1.1382614868556325e-11);
    p = real_fma(p, z, real_set(-2.5051131455427946e-08));
    p = real_fma(p, z, real_set(2.755731610068303e-06));
    p = real_fma(p, z, real_set(-0.0001984126983675497));
    p = real_fma(p, z, real_set(0.008333333333330946));
    p = real_fma(p, z, real_set(-0.16666666666666666));
    p = real_fma(r * z, p, r);
    q = real_fma(q, z, real_set(2.0876146024689747e-09));
    q = real_fma(q, z, real_set(-2.7557317270560326e-07));
    q = real_fma(q, z, real_set(2.4801587298763433e-05));
    q = real_fma(q, z, real_set(-0.0013888888888887395));
    q = real_fma(q, z, real_set(0.041666666666666664));
    q = real_fma(z * z, q, real_fma(real_set(-0.5), z, real_set(1.0)));
    const bits swap = (n & 1) != 0;
    const words sign_s = ((words)n & 2) << 62, sign_c = ((words)(n + 1) & 2) << 62;
    *sine = (real)((words)real_select(swap, q, p) ^ sign_s);
    *cosine = (real)((words)real_select(swap, p, q) ^ sign_c);
}

// atan x, relative error < 1e-14.
INLINE real real_atan(real x)
{
    const real u = real_abs(x);
    const bits large = u > 2.414213562373095, middle = u > 0.41421356237309503;  // tan 3 pi/8, tan pi/8
    const real top = real_select(large, real_set(-1.0), real_select(middle, u - 1.0, u));
    const real bottom = real_select(large, u, real_select(middle, u + 1.0, real_set(1.0)));
    const real offset = real_select(large, real_set(1.5707963267948966), real_select(middle, real_set(0.7853981633974483), real_set(0.0)));
    const real r = top / bottom, z = r * r;
    real p = real_set(-0.027229493655218973);
    p = real_fma(p, z, real_set(0.051686162502498884));
    p = real_fma(p, z, real_set(-0.0655085023854286));
    p = real_fma(p, z, real_set(0.07681037484051574));
    p = real_fma(p, z, real_set(-0.09090255377464372));
    p = real_fma(p, z, real_set(0.11111089626077861));
    p = real_fma(p, z, real_set(-0.14285713929925073));
    p = real_fma(p, z, real_set(0.1999999999772153));
    p = real_fma(p, z, real_set(-0.3333333333333092));
    const real y = offset + real_fma(r * z, p, r);
    return (real)((bits)y | ((bits)x & INT64_MIN));
}

#endif

typedef number lanes[LANES] __attribute__((aligned(8 * sizeof(number))));      // one number per ball
typedef double constants[LANES] __attribute__((aligned(8 * sizeof(double))));  // the same, independent of the state

// Sum over the balls in one order for every lane width: four partial sums, then (0 + 1) + (2 + 3).
INLINE number lanes_sum(const number *v)
{
    enum { WHOLE = Z / 4 * 4 };
#if defined(DUAL) || LANE_WIDTH == 1
    number part[4] = {v[0], v[1], v[2], v[3]};
    for (int j = 4; j < WHOLE; j++) part[j % 4] += v[j];
#else
    double part __attribute__((vector_size(32))), next __attribute__((vector_size(32)));
    memcpy(&part, v, sizeof part);
    for (int j = 4; j < WHOLE; j += 4) {
        memcpy(&next, &v[j], sizeof next);
        part += next;
    }
#endif
    for (int j = WHOLE; j < Z; j++) part[j - WHOLE] += v[j];
    return (part[0] + part[1]) + (part[2] + part[3]);
}
