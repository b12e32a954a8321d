// Eight numbers side by side, for sums over the coefficients of tables.  Functions take them by pointer: by value
// they would need registers that not every instruction set has.
#pragma once

#include "numbers/lanes.h"

typedef union {
    scalar x[8];
#if defined(FUSED) && defined(__AVX512F__)
    __m512d part[1];
#elif defined(FUSED) && defined(__FMA__)
    __m256d part[2];
#endif
} octet;

// sum += w x.
INLINE void octet_add_from(scalar w, const double *x, octet *sum)
{
#if defined(FUSED) && defined(__AVX512F__)
    sum->part[0] = _mm512_fmadd_pd(_mm512_set1_pd(w), _mm512_loadu_pd(x), sum->part[0]);
#elif defined(FUSED) && defined(__FMA__)
    for (int i = 0; i < 2; i++)
        sum->part[i] = _mm256_fmadd_pd(_mm256_set1_pd(w), _mm256_loadu_pd(x + 4 * i), sum->part[i]);
#elif defined(FUSED) && defined(__ARM_NEON)
    for (int i = 0; i < 8; i++) sum->x[i] = fma(w, x[i], sum->x[i]);
#else
    for (int i = 0; i < 8; i++) sum->x[i] += w * x[i];
#endif
}

INLINE void octet_add_floats(scalar w, const float *x, octet *sum)
{
#if defined(FUSED) && defined(__AVX512F__)
    sum->part[0] = _mm512_fmadd_pd(_mm512_set1_pd(w), _mm512_cvtps_pd(_mm256_loadu_ps(x)), sum->part[0]);
#elif defined(FUSED) && defined(__FMA__)
    for (int i = 0; i < 2; i++)
        sum->part[i] =
            _mm256_fmadd_pd(_mm256_set1_pd(w), _mm256_cvtps_pd(_mm_loadu_ps(x + 4 * i)), sum->part[i]);
#elif defined(FUSED) && defined(__ARM_NEON)
    for (int i = 0; i < 8; i++) sum->x[i] = fma(w, x[i], sum->x[i]);
#else
    for (int i = 0; i < 8; i++) sum->x[i] += w * x[i];
#endif
}

INLINE void octet_add(scalar w, const octet *x, octet *sum)
{
#ifdef DUAL
    for (int i = 0; i < 8; i++) sum->x[i] += w * x->x[i];
#else
    octet_add_from(w, x->x, sum);
#endif
}

// to = x + y.
INLINE void octet_store_sum(const octet *x, const octet *y, scalar *to)
{
    for (int i = 0; i < 8; i += LANE_WIDTH) wide_store(&to[i], wide_load(&x->x[i]) + wide_load(&y->x[i]));
}

// sum += w_0 rows_0 + w_1 rows_1 + ...: rows of a number of octets each, even and odd ones by themselves.
INLINE void octets_add_rows(int count, const scalar *w, int octets, const double *rows, octet *sum,
                            octet *odd)
{
    const int length = 8 * octets;
    for (int i = 0; i + 1 < count; i += 2)
        for (int b = 0; b < octets; b++) {
            octet_add_from(w[i], rows + i * length + 8 * b, &sum[b]);
            octet_add_from(w[i + 1], rows + (i + 1) * length + 8 * b, &odd[b]);
        }
    if (count % 2 == 1)
        for (int b = 0; b < octets; b++)
            octet_add_from(w[count - 1], rows + (count - 1) * length + 8 * b, &sum[b]);
}

// to = sum + odd.
INLINE void octets_store_sum(int octets, const octet *sum, const octet *odd, scalar *to)
{
    for (int b = 0; b < octets; b++) octet_store_sum(&sum[b], &odd[b], &to[8 * b]);
}
