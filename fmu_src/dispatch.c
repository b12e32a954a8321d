// Choice of the right-hand side for this processor, at run time.
#include "rhs.h"

#undef rhs
Rhs rhs_sse2, rhs_avx2, rhs_avx512, rhs_generic;

Rhs *rhs_select(const char **name)
{
#if defined(__x86_64__) || defined(_M_X64)
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")) {
        *name = "avx512";
        return rhs_avx512;
    }
    if (__builtin_cpu_supports("avx2")) {
        *name = "avx2";
        return rhs_avx2;
    }
    *name = "sse2";
    return rhs_sse2;
#else
    *name = "generic";
    return rhs_generic;
#endif
}

void work_init(const Derived *d, Work *w)
{
    memset(w, 0, sizeof *w);
    for (int j = 0; j < LANES; j++) w->r[j] = 0.5 * (d->inner.R_g + d->outer.R_g);
}
