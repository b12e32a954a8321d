// Arithmetic on packets of doubles: the balls (or joints, or cage halves) of one packet are computed side by
// side.
//
// A `wide` holds LANE_WIDTH doubles and has C's operators, so that the code for a packet reads like the code
// for one ball.  The kernel files are compiled once for each instruction set, and every function that another
// file calls, each that is not static, gets the set's name as a suffix (FOR_ISA, generated/kernel_names.h).
//
// Each lane does the same IEEE operations in the same order whatever the width, and sums run over the balls
// in a fixed order (ball_array_sum).  Therefore all instruction sets with a fused multiply-add (FUSED: AVX2,
// AVX-512, NEON) give the same bits, and so do all sets without one.  A fused multiply-add is computed where
// wide_fma is written and nowhere else; compilers must not contract other expressions into one.
//
// A `scalar` is a single number that depends on the state.  dual.h makes both types dual numbers, which carry
// a derivative.
#pragma once

#include "variables.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#ifdef __FAST_MATH__
#error "-ffast-math changes results and takes tests for numbers out: compile without it"
#endif

#ifndef LANE_WIDTH
#define LANE_WIDTH 2
#endif
#ifndef ISA
#define ISA generic
#endif
#define FOR_ISA_2(name, isa) name##_##isa
#define FOR_ISA_1(name, isa) FOR_ISA_2(name, isa)
#define FOR_ISA(name) FOR_ISA_1(name, ISA)
#include "generated/kernel_names.h"

#if defined(__AVX__)
#include <immintrin.h>  // 64,000 lines: half the time of compiling a small file
#elif defined(__SSE2__)
#include <emmintrin.h>
#elif defined(__ARM_NEON) && LANE_WIDTH == 2
#include <arm_neon.h>
#endif

// Arrays over balls are padded to LANES elements; packets cover the first PACKETS * LANE_WIDTH of these.  The
// elements from Z on are padding and hold harmless numbers.
enum { LANES = (Z + 7) / 8 * 8, PACKETS = (Z + LANE_WIDTH - 1) / LANE_WIDTH };

// Packets that go side by side through long chains of operations, where one packet would wait for each result.
enum { ABREAST = 6 };

#define INLINE static inline __attribute__((always_inline))
#define ONCE static __attribute__((noinline, unused))  // in a header: one copy for each file that calls it

#ifdef DUAL
#include "numbers/dual.h"
#else
#if LANE_WIDTH == 1
enum { HALVES = 1 };
#else
enum { HALVES = 2 };  // cage halves that are computed side by side in one packet (wide_pair)
#endif

typedef double wide __attribute__((vector_size(8 * LANE_WIDTH)));
typedef int64_t bits
    __attribute__((vector_size(8 * LANE_WIDTH)));  // a comparison's result: all ones where true
typedef uint64_t words __attribute__((vector_size(8 * LANE_WIDTH)));

INLINE double scalar_value(scalar x)
{
    return x;
}

INLINE scalar scalar_sqrt(scalar x)
{
    return sqrt(x);
}

INLINE scalar scalar_max(scalar x, scalar y)
{
    return x > y ? x : y;
}

INLINE scalar scalar_min(scalar x, scalar y)
{
    return x < y ? x : y;
}

INLINE wide wide_set(double value)
{
    return value - (wide){0};
}

// A packet of the numbers of two cage halves: the first half's in lane 0, the last half's in all others.
INLINE wide wide_pair(double first, double last)
{
    wide value = wide_set(last);
    value[0] = first;
    return value;
}

#define wide_lane(x, i) ((x)[i])  // a macro, because a function would copy the packet

INLINE wide wide_load(const double *from)
{
    wide value;
    memcpy(&value, from, sizeof value);
    return value;
}

INLINE void wide_store(double *to, wide value)
{
    memcpy(to, &value, sizeof value);
}

INLINE wide wide_select(bits condition, wide yes, wide no)
{
#if defined(__AVX512F__) && LANE_WIDTH == 8
    return (wide)_mm512_mask_blend_pd(_mm512_movepi64_mask((__m512i)condition), (__m512d)no, (__m512d)yes);
#elif defined(__AVX__) && LANE_WIDTH == 4
    return (wide)_mm256_blendv_pd((__m256d)no, (__m256d)yes, (__m256d)condition);
#else
    return (wide)((condition & (bits)yes) | (~condition & (bits)no));
#endif
}

INLINE bits wide_above(wide x, double limit)
{
    return x > limit;
}

// Bit k: the condition in lane k.
INLINE int wide_mask(bits condition)
{
#if defined(__AVX512F__) && LANE_WIDTH == 8
    return _mm512_movepi64_mask((__m512i)condition);
#elif defined(__AVX__) && LANE_WIDTH == 4
    return _mm256_movemask_pd((__m256d)condition);
#elif defined(__SSE2__) && LANE_WIDTH == 2
    return _mm_movemask_pd((__m128d)condition);
#else
    int mask = 0;
    for (int i = 0; i < LANE_WIDTH; i++) mask |= (condition[i] != 0) << i;
    return mask;
#endif
}

INLINE bool wide_any(bits condition)
{
    return wide_mask(condition) != 0;
}

INLINE wide wide_sqrt(wide x)
{
#if defined(__AVX512F__) && LANE_WIDTH == 8
    return (wide)_mm512_sqrt_pd((__m512d)x);
#elif defined(__AVX__) && LANE_WIDTH == 4
    return (wide)_mm256_sqrt_pd((__m256d)x);
#elif defined(__SSE2__) && LANE_WIDTH == 2
    return (wide)_mm_sqrt_pd((__m128d)x);
#elif defined(__ARM_NEON) && LANE_WIDTH == 2
    return (wide)vsqrtq_f64((float64x2_t)x);
#else
    for (int i = 0; i < LANE_WIDTH; i++) x[i] = sqrt(x[i]);
    return x;
#endif
}

// x y + z, with one rounding where the kernels' instruction set has a fused multiply-add.
INLINE wide wide_fma(wide x, wide y, wide z)
{
#if defined(FUSED) && defined(__AVX512F__) && LANE_WIDTH == 8
    return (wide)_mm512_fmadd_pd((__m512d)x, (__m512d)y, (__m512d)z);
#elif defined(FUSED) && defined(__FMA__) && LANE_WIDTH == 4
    return (wide)_mm256_fmadd_pd((__m256d)x, (__m256d)y, (__m256d)z);
#elif defined(FUSED) && defined(__FMA__) && LANE_WIDTH == 8
    // AVX-512's packets on a processor without it, for the tests (cmake/core.cmake)
    __m256d part[2][3];
    memcpy(&part[0][0], &x, 32), memcpy(&part[1][0], (const char *)&x + 32, 32);
    memcpy(&part[0][1], &y, 32), memcpy(&part[1][1], (const char *)&y + 32, 32);
    memcpy(&part[0][2], &z, 32), memcpy(&part[1][2], (const char *)&z + 32, 32);
    for (int i = 0; i < 2; i++) part[i][0] = _mm256_fmadd_pd(part[i][0], part[i][1], part[i][2]);
    memcpy(&x, &part[0][0], 32), memcpy((char *)&x + 32, &part[1][0], 32);
    return x;
#elif defined(FUSED) && defined(__ARM_NEON) && LANE_WIDTH == 2
    return (wide)vfmaq_f64((float64x2_t)z, (float64x2_t)x, (float64x2_t)y);
#else
    return x * y + z;
#endif
}

// Packet of the first halves of x and y, and of the last half of x twice.
INLINE wide wide_join(wide x, wide y)
{
#if defined(__AVX512F__) && LANE_WIDTH == 8
    return (wide)_mm512_shuffle_f64x2((__m512d)x, (__m512d)y, 0x44);
#elif defined(__AVX__) && LANE_WIDTH == 4
    return (wide)_mm256_permute2f128_pd((__m256d)x, (__m256d)y, 0x20);
#else
    for (int i = 0; i < LANE_WIDTH / 2; i++) x[LANE_WIDTH / 2 + i] = y[i];
    return x;
#endif
}

INLINE wide wide_last_half(wide x)
{
#if defined(__AVX512F__) && LANE_WIDTH == 8
    return (wide)_mm512_shuffle_f64x2((__m512d)x, (__m512d)x, 0xee);
#elif defined(__AVX__) && LANE_WIDTH == 4
    return (wide)_mm256_permute2f128_pd((__m256d)x, (__m256d)x, 0x11);
#else
    for (int i = 0; i < LANE_WIDTH / 2; i++) x[i] = x[LANE_WIDTH / 2 + i];
    return x;
#endif
}

// In each four lanes the one of them with this number.  For packets of four or eight.
INLINE wide wide_fill(wide x, int lane)
{
#if LANE_WIDTH == 8
    return wide_join(wide_set(x[lane]), wide_set(x[lane + 4]));
#else
    return wide_set(x[lane]);
#endif
}

// In each four lanes their sum (0 + 1) + (2 + 3).  For packets of four or eight.
INLINE wide wide_sum_fours(wide x)
{
#if defined(__AVX512F__) && LANE_WIDTH == 8
    x += (wide)_mm512_permute_pd((__m512d)x, 0x55);
    return x + (wide)_mm512_permutex_pd((__m512d)x, 0x4e);
#elif defined(__AVX__) && LANE_WIDTH == 4
    x += (wide)_mm256_permute_pd((__m256d)x, 0x5);
    return x + (wide)_mm256_permute2f128_pd((__m256d)x, (__m256d)x, 0x01);
#else
    wide sum = x;
    for (int i = 0; i < LANE_WIDTH / 4 * 4; i++)
        sum[i] = (x[i / 4 * 4] + x[i / 4 * 4 + 1]) + (x[i / 4 * 4 + 2] + x[i / 4 * 4 + 3]);
    return sum;
#endif
}

// The larger one; y where x is NaN, like the x86 instruction.
INLINE wide wide_max(wide x, wide y)
{
#if defined(__AVX512F__) && LANE_WIDTH == 8
    return (wide)_mm512_max_pd((__m512d)x, (__m512d)y);
#elif defined(__AVX__) && LANE_WIDTH == 4
    return (wide)_mm256_max_pd((__m256d)x, (__m256d)y);
#elif defined(__SSE2__) && LANE_WIDTH == 2
    return (wide)_mm_max_pd((__m128d)x, (__m128d)y);
#else
    return wide_select(x > y, x, y);
#endif
}

// The smaller one; y where x is NaN.
INLINE wide wide_min(wide x, wide y)
{
#if defined(__AVX512F__) && LANE_WIDTH == 8
    return (wide)_mm512_min_pd((__m512d)x, (__m512d)y);
#elif defined(__AVX__) && LANE_WIDTH == 4
    return (wide)_mm256_min_pd((__m256d)x, (__m256d)y);
#elif defined(__SSE2__) && LANE_WIDTH == 2
    return (wide)_mm_min_pd((__m128d)x, (__m128d)y);
#else
    return wide_select(x < y, x, y);
#endif
}

INLINE wide wide_abs(wide x)
{
    return (wide)((bits)x & INT64_MAX);
}

// The sum of x and this number, 1.5 * 2^52, rounds |x| < 2^51 to the nearest integer, which its last bits hold.
static const double ROUND_SHIFT = 6755399441055744.0;

// Largest integer that is not above x, |x| < 2^51.
INLINE wide wide_floor(wide x)
{
    const wide shift = wide_set(ROUND_SHIFT), nearest = (x + shift) - shift;
    return nearest - (wide)((bits)wide_set(1.0) & (nearest > x));
}

// The polynomials below are Chebyshev fits over the reduced ranges; tests/test_lanes.py measures the errors
// stated.

// e^x, relative error < 3e-15; 0 below -700, e^700 above 700.
INLINE wide wide_exp(wide x)
{
    const bits underflow = x < -700.0;
    x = wide_max(wide_min(x, wide_set(700.0)), wide_set(-700.0));
    const wide shift = wide_set(ROUND_SHIFT), shifted = x * 1.4426950408889634 + shift, k = shifted - shift;
    const wide r = wide_fma(k, wide_set(-1.6465949582897082e-12),
                            wide_fma(k, wide_set(-0.6931471805582987), x));  // ln 2 in two parts
    wide p = wide_set(2.761380686153829e-07);
    p = wide_fma(p, r, wide_set(2.762511557828763e-06));
    p = wide_fma(p, r, wide_set(2.4801536388690766e-05));
    p = wide_fma(p, r, wide_set(0.00019841208732536384));
    p = wide_fma(p, r, wide_set(0.0013888888905881542));
    p = wide_fma(p, r, wide_set(0.008333333353729397));
    p = wide_fma(p, r, wide_set(0.04166666666665136));
    p = wide_fma(p, r, wide_set(0.1666666666664829));
    p = wide_fma(p, r, wide_set(0.5));
    p = wide_fma(p * r, r, r) + 1.0;
    return wide_select(underflow, wide_set(0.0), (wide)((words)p + ((words)shifted << 52)));
}

// 2^x of n <= ABREAST packets of x < 1020, relative error < 2e-14; 2^-1020 below -1020.
INLINE void wide_power_of_2(int n, const wide x[], wide power[])
{
    static const double c[] = {1.3258279803210894e-06, 1.5252998019728296e-05, 0.00015403441115819673,
                               0.0013333557613701514,  0.009618129180880362,   0.0555041086684745,
                               0.24022650695723774,    0.6931471805598846,     1.0};
    const wide shift = wide_set(ROUND_SHIFT);
    wide whole[ABREAST], r[ABREAST];
    for (int i = 0; i < n; i++) {
        const wide in_range = wide_max(x[i], wide_set(-1020.0));
        whole[i] = in_range + shift;
        r[i] = in_range - (whole[i] - shift);
        power[i] = wide_set(1.0146613104608205e-07);
    }
    for (unsigned k = 0; k < sizeof c / sizeof *c; k++)
        for (int i = 0; i < n; i++) power[i] = wide_fma(power[i], r[i], wide_set(c[k]));
    for (int i = 0; i < n; i++) power[i] = (wide)((words)power[i] + ((words)whole[i] << 52));
}

// 1/sqrt(x) of n <= ABREAST packets of normal x > 0, relative error < 5e-16.  A constant less half the bits
// of x, read as a number, is within 3.5 %; two steps with polynomials in e = x y^2 - 1 do the rest.  A root
// and a division take longer.
INLINE void wide_inv_sqrt(int n, const wide x[], wide y[])
{
    wide e[ABREAST];
    for (int i = 0; i < n; i++) {
        y[i] = (wide)(0x5fe6eb50c7b537a9 - ((words)x[i] >> 1));
        e[i] = wide_fma(x[i] * y[i], y[i], wide_set(-1.0));
    }
    for (int i = 0; i < n; i++) {
        wide p = wide_fma(e[i], wide_set(-0.3123717714165978), wide_set(0.37606163612818344));
        p = wide_fma(e[i], p, wide_set(-0.5000016917620744));
        y[i] = wide_fma(y[i] * e[i], p, y[i]);
        e[i] = wide_fma(x[i] * y[i], y[i], wide_set(-1.0));
    }
    for (int i = 0; i < n; i++)
        y[i] = wide_fma(y[i] * e[i], wide_fma(e[i], wide_set(0.375), wide_set(-0.5)), y[i]);
}

// x = 2^k m with sqrt(1/2) <= m < sqrt(2).
INLINE wide wide_split(wide x, wide *m)
{
    const uint64_t one = 0x3ff0000000000000, sqrt_half = 0x3fe6a09e667f3bcd;
    const uint64_t two_52 = 0x4330000000000000;                   // the bits of these numbers
    const words exponent = ((words)x + (one - sqrt_half)) >> 52;  // k + 1023
    *m = (wide)((words)x - (exponent << 52) + one);
    return (wide)(exponent | two_52) - (4503599627370496.0 + 1023.0);
}

// k ln 2 + 2 atanh t
INLINE wide wide_log_of(wide k, wide t)
{
    const wide z = t * t;
    wide p = wide_set(0.166219470901774);
    p = wide_fma(p, z, wide_set(0.18140185202493248));
    p = wide_fma(p, z, wide_set(0.22222862476849542));
    p = wide_fma(p, z, wide_set(0.2857142413651635));
    p = wide_fma(p, z, wide_set(0.400000000112122));
    p = wide_fma(p, z, wide_set(0.6666666666666208));
    return wide_fma(k, wide_set(0.6931471805582987),
                    wide_fma(k, wide_set(1.6465949582897082e-12), wide_fma(t * z, p, 2.0 * t)));
}

// ln x of a normal x > 0, relative error < 3e-15.
INLINE wide wide_log(wide x)
{
    wide m;
    const wide k = wide_split(x, &m);
    return wide_log_of(k, (m - 1.0) / (m + 1.0));
}

// ln x and ln y for the price of one division.
INLINE void wide_log2(wide x, wide y, wide *ln_x, wide *ln_y)
{
    wide m, n;
    const wide k = wide_split(x, &m), l = wide_split(y, &n), both = 1.0 / ((m + 1.0) * (n + 1.0));
    *ln_x = wide_log_of(k, (m - 1.0) * (n + 1.0) * both);
    *ln_y = wide_log_of(l, (n - 1.0) * (m + 1.0) * both);
}

// sin x and cos x, absolute error < 3e-16 for |x| < 1e7.
INLINE void wide_sincos(wide x, wide *sine, wide *cosine)
{
    const wide shift = wide_set(ROUND_SHIFT), shifted = x * 0.6366197723675814 + shift, k = shifted - shift;
    const bits n = (bits)shifted - (bits)shift;  // k as an integer
    const wide near =
        wide_fma(k, wide_set(-9.920935791635221e-10), wide_fma(k, wide_set(-1.570796325802803), x));
    const wide r = wide_fma(k, wide_set(-5.170182981794105e-19), near);  // pi/2 in three parts
    const wide z = r * r;
    wide p = wide_set(1.591810123027412e-10), q = wide_set(-1.1382614868556325e-11);
    p = wide_fma(p, z, wide_set(-2.5051131455427946e-08));
    p = wide_fma(p, z, wide_set(2.755731610068303e-06));
    p = wide_fma(p, z, wide_set(-0.0001984126983675497));
    p = wide_fma(p, z, wide_set(0.008333333333330946));
    p = wide_fma(p, z, wide_set(-0.16666666666666666));
    p = wide_fma(r * z, p, r);
    q = wide_fma(q, z, wide_set(2.0876146024689747e-09));
    q = wide_fma(q, z, wide_set(-2.7557317270560326e-07));
    q = wide_fma(q, z, wide_set(2.4801587298763433e-05));
    q = wide_fma(q, z, wide_set(-0.0013888888888887395));
    q = wide_fma(q, z, wide_set(0.041666666666666664));
    q = wide_fma(z * z, q, wide_fma(wide_set(-0.5), z, wide_set(1.0)));
    const bits swap = (n & 1) != 0;
    const words sign_s = ((words)n & 2) << 62, sign_c = ((words)(n + 1) & 2) << 62;
    *sine = (wide)((words)wide_select(swap, q, p) ^ sign_s);
    *cosine = (wide)((words)wide_select(swap, p, q) ^ sign_c);
}

// atan x, relative error < 1e-14.
INLINE wide wide_atan(wide x)
{
    const wide u = wide_abs(x);
    const bits large = u > 2.414213562373095, middle = u > 0.41421356237309503;  // tan 3 pi/8, tan pi/8
    const wide top = wide_select(large, wide_set(-1.0), wide_select(middle, u - 1.0, u));
    const wide bottom = wide_select(large, u, wide_select(middle, u + 1.0, wide_set(1.0)));
    const wide offset =
        wide_select(large, wide_set(0.5 * PI), wide_select(middle, wide_set(0.25 * PI), wide_set(0.0)));
    const wide r = top / bottom, z = r * r;
    wide p = wide_set(-0.027229493655218973);
    p = wide_fma(p, z, wide_set(0.051686162502498884));
    p = wide_fma(p, z, wide_set(-0.0655085023854286));
    p = wide_fma(p, z, wide_set(0.07681037484051574));
    p = wide_fma(p, z, wide_set(-0.09090255377464372));
    p = wide_fma(p, z, wide_set(0.11111089626077861));
    p = wide_fma(p, z, wide_set(-0.14285713929925073));
    p = wide_fma(p, z, wide_set(0.1999999999772153));
    p = wide_fma(p, z, wide_set(-0.3333333333333092));
    const wide y = offset + wide_fma(r * z, p, r);
    return (wide)((bits)y | ((bits)x & INT64_MIN));
}

#endif

typedef scalar ball_array[LANES] __attribute__((aligned(8 * sizeof(scalar))));  // one number per ball
typedef double constants[LANES]
    __attribute__((aligned(8 * sizeof(double))));  // the same, independent of the state

// Length of the vector (y, z).
INLINE wide wide_hypot(wide y, wide z)
{
    return wide_sqrt(y * y + z * z);
}

// part/whole; 0 where whole is so small that 1/whole is not finite.
INLINE wide wide_ratio(wide part, wide whole)
{
    return wide_select(wide_above(whole, 1e-300), part / whole, wide_set(0.0));
}

// Sum over the balls in one order for every lane width: four partial sums, then (0 + 1) + (2 + 3).
INLINE scalar ball_array_sum(const scalar *v)
{
    enum { WHOLE = Z / 4 * 4 };
#if defined(DUAL) || LANE_WIDTH == 1
    scalar part[4] = {v[0], v[1], v[2], v[3]};
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

// Partial sums over eight lanes, for a sum in one order for every lane width.
enum { EIGHTHS = 8 / LANE_WIDTH };

// Sums of the first n columns of eight lanes, x[packet][column]: ((0 + 1) + (2 + 3)) + ((4 + 5) + (6 + 7)) of each.
INLINE void wide_column_sums(int n, int columns, const wide *x, scalar *sum)
{
    int first = 0;
#if defined(__AVX512F__) && LANE_WIDTH == 8 && !defined(DUAL)
    const __m512i even = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13),
                  odd = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
    for (; first + 8 <= n; first += 8) {
        __m512d two[4], four[2];
        for (int i = 0; i < 4; i++) {
            const __m512d a = (__m512d)x[first + 2 * i], b = (__m512d)x[first + 2 * i + 1];
            two[i] = _mm512_add_pd(_mm512_unpacklo_pd(a, b), _mm512_unpackhi_pd(a, b));
        }
        for (int i = 0; i < 2; i++)
            four[i] = _mm512_add_pd(_mm512_permutex2var_pd(two[2 * i], even, two[2 * i + 1]),
                                    _mm512_permutex2var_pd(two[2 * i], odd, two[2 * i + 1]));
        const __m512d all = _mm512_add_pd(_mm512_shuffle_f64x2(four[0], four[1], 0x44),
                                          _mm512_shuffle_f64x2(four[0], four[1], 0xee));
        _mm512_storeu_pd(&sum[first], all);
    }
#elif defined(__AVX2__) && LANE_WIDTH == 4 && !defined(DUAL)
    for (; first + 4 <= n; first += 4) {
        __m256d half[2];
        for (int i = 0; i < 2; i++) {
            const wide *row = &x[i * columns + first];
            const __m256d a = _mm256_hadd_pd((__m256d)row[0], (__m256d)row[1]),
                          b = _mm256_hadd_pd((__m256d)row[2], (__m256d)row[3]);
            half[i] = _mm256_add_pd(_mm256_permute2f128_pd(a, b, 0x20), _mm256_permute2f128_pd(a, b, 0x31));
        }
        _mm256_storeu_pd(&sum[first], _mm256_add_pd(half[0], half[1]));
    }
#endif
    for (; first < n; first++) {
        scalar part[8];
        for (int i = 0; i < EIGHTHS; i++) wide_store(&part[i * LANE_WIDTH], x[i * columns + first]);
        sum[first] =
            ((part[0] + part[1]) + (part[2] + part[3])) + ((part[4] + part[5]) + (part[6] + part[7]));
    }
}

// Sum of one such column.
INLINE scalar wide_eight_sum(const wide part[EIGHTHS])
{
    scalar sum;
    wide_column_sums(1, 1, part, &sum);
    return sum;
}
