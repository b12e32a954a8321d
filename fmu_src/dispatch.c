// Choice of the kernels for this processor, at run time.
#include "rhs.h"

#undef rhs
#undef vector_ops
#undef implicit_ops
#undef race_contact_force
#define DECLARE(isa)                         \
    Rhs rhs_##isa;                           \
    ContactKernel race_contact_force_##isa;  \
    extern const VectorOps vector_ops_##isa; \
    extern const ImplicitOps implicit_ops_##isa
#define KERNELS(isa) ((Kernels){#isa, rhs_##isa, race_contact_force_##isa, &vector_ops_##isa, &implicit_ops_##isa})

#if defined(__x86_64__) || defined(_M_X64)
DECLARE(sse2);
DECLARE(avx2);
DECLARE(avx512);

Kernels kernels_select(void)
{
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")) return KERNELS(avx512);
    return __builtin_cpu_supports("avx2") ? KERNELS(avx2) : KERNELS(sse2);
}
#elif defined(__aarch64__)
DECLARE(neon);

Kernels kernels_select(void)
{
    return KERNELS(neon);
}
#else
DECLARE(generic);

Kernels kernels_select(void)
{
    return KERNELS(generic);
}
#endif

void work_init(const Derived *d, Work *w)
{
    memset(w, 0, sizeof *w);
    for (int j = 0; j < LANES; j++) w->r[j] = 0.5 * (d->inner.R_g + d->outer.R_g);
}
