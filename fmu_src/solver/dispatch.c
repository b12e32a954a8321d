// Choice of the kernels for this processor, at run time.  The build names the instruction sets that it
// compiled by KERNELS_X86 or KERNELS_NEON; without such a name there is only the one of lanes.h.
#include "solver/kernels.h"

#undef rhs
#undef vector_ops
#undef vector_ops_all
#undef verlet_step
#undef verlet_evaluate
#undef race_contact_force
#undef cage_loads
#undef rivet_rom_stress
#define DECLARE_2(isa)                         \
    Rhs rhs_##isa;                             \
    RaceContactForce race_contact_force_##isa; \
    VerletStep verlet_step_##isa;              \
    VerletEvaluate verlet_evaluate_##isa;      \
    CageLoads cage_loads_##isa;                \
    RivetRomStress rivet_rom_stress_##isa;     \
    extern const VectorOps vector_ops_##isa, vector_ops_all_##isa
#define KERNELS_2(isa)                                                                              \
    ((Kernels){#isa, rhs_##isa, race_contact_force_##isa, &vector_ops_##isa, &vector_ops_all_##isa, \
               verlet_step_##isa, verlet_evaluate_##isa, cage_loads_##isa, rivet_rom_stress_##isa})
#define DECLARE(isa) DECLARE_2(isa)
#define KERNELS(isa) KERNELS_2(isa)

#if defined(KERNELS_X86)
#include <cpuid.h>

DECLARE(sse2);
DECLARE(avx2);
DECLARE(avx512);

// Bits of the registers that the operating system keeps for a process (XCR0): 2 SSE, 4 AVX, 0xe0 AVX-512.
static unsigned registers_kept(void)
{
    unsigned a, b, c, d;
    const unsigned OSXSAVE = 1u << 27;
    if (!__get_cpuid(1, &a, &b, &c, &d) || !(c & OSXSAVE)) return 0;
    __asm__("xgetbv" : "=a"(a), "=d"(d) : "c"(0));
    return a;
}

// Asks the processor by cpuid, because the compilers' __builtin_cpu_supports needs a runtime library that not
// every tool chain has.
Kernels kernels_select(void)
{
    enum { YMM = 0x6, ZMM = 0xe6 };

    const unsigned AVX2 = 1u << 5, AVX512 = 1u << 16 | 1u << 17 | 1u << 31;  // F, DQ, VL
    const unsigned FMA = 1u << 12;
    unsigned a, b, c, d;
    const unsigned kept = registers_kept();
    if (!__get_cpuid(1, &a, &b, &c, &d) || !(c & FMA)) return KERNELS(sse2);
    if (!__get_cpuid_count(7, 0, &a, &b, &c, &d)) b = 0;
    if ((kept & ZMM) == ZMM && (b & AVX512) == AVX512) return KERNELS(avx512);
    return (kept & YMM) == YMM && (b & AVX2) ? KERNELS(avx2) : KERNELS(sse2);
}
#elif defined(KERNELS_NEON)
DECLARE(neon);

Kernels kernels_select(void)
{
    return KERNELS(neon);
}
#else
DECLARE(ISA);

Kernels kernels_select(void)
{
    return KERNELS(ISA);
}
#endif
