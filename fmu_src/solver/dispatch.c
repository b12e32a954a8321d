// Choice of the kernels for this processor, at run time.  The build names the instruction sets that it
// compiled by KERNELS_X86 or KERNELS_NEON; without such a name there is only the one of lanes.h.
#include "solver/kernels.h"

#include <stdlib.h>

#undef rhs
#undef verlet_step
#undef verlet_evaluate
#undef race_contact_force
#undef cage_loads
#undef cage_slide
#undef rivet_rom_stress
#define DECLARE_2(isa)                         \
    Rhs rhs_##isa;                             \
    RaceContactForce race_contact_force_##isa; \
    VerletStep verlet_step_##isa;              \
    VerletEvaluate verlet_evaluate_##isa;      \
    CageLoads cage_loads_##isa;                \
    CageSlide cage_slide_##isa;                \
    RivetRomStress rivet_rom_stress_##isa
#define KERNELS_2(isa)                                                                              \
    ((Kernels){#isa, rhs_##isa, race_contact_force_##isa, verlet_step_##isa, verlet_evaluate_##isa, \
               cage_loads_##isa, cage_slide_##isa, rivet_rom_stress_##isa})
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

// Whether this processor has fused multiply-add and packets of four, of eight.  Asked by cpuid, because the compilers'
// __builtin_cpu_supports needs a runtime library that not every tool chain has.
static void processor_has(bool *four, bool *eight)
{
    enum { YMM = 0x6, ZMM = 0xe6 };  // bits of registers_kept

    const unsigned FMA = 1u << 12, AVX2 = 1u << 5;
    unsigned a, b, c, d;
    const unsigned kept = registers_kept();
    *four = *eight = false;
    if (!__get_cpuid(1, &a, &b, &c, &d) || !(c & FMA)) return;
    if (!__get_cpuid_count(7, 0, &a, &b, &c, &d)) return;
    *four = (kept & YMM) == YMM && (b & AVX2);
#ifdef EIGHT_BY_FOURS
    *eight = *four;  // the tests' kernel of AVX-512's packets, computed by AVX2
#else
    const unsigned AVX512 = 1u << 16 | 1u << 17 | 1u << 31;  // F, DQ, VL
    *eight = (kept & ZMM) == ZMM && (b & AVX512) == AVX512;
#endif
}

Kernels kernels_select(void)
{
    bool four, eight;
    processor_has(&four, &eight);
    return eight ? KERNELS(avx512) : four ? KERNELS(avx2) : KERNELS(sse2);
}

static bool kernels_named(const char *name, Kernels *kernels)
{
    bool four, eight;
    processor_has(&four, &eight);
    if (strcmp(name, "avx512") == 0 && eight)
        *kernels = KERNELS(avx512);
    else if (strcmp(name, "avx2") == 0 && four)
        *kernels = KERNELS(avx2);
    else if (strcmp(name, "baseline") == 0)
        *kernels = KERNELS(sse2);
    else
        return false;
    return true;
}
#else
#if defined(KERNELS_NEON)
DECLARE(neon);
#define BASELINE neon
#else
DECLARE(ISA);
#define BASELINE ISA
#endif

Kernels kernels_select(void)
{
    return KERNELS(BASELINE);
}

static bool kernels_named(const char *name, Kernels *kernels)
{
    *kernels = kernels_select();
    return strcmp(name, "baseline") == 0;
}
#endif

// A web page has no environment: to ask for it there ends the program.
static const char *environment(const char *name)
{
#if defined(__wasi__)
    (void)name;
    return NULL;
#else
    return getenv(name);
#endif
}

Kernels kernels_wanted(const char **refused)
{
    const char *name = environment("RIVETED_BEARING_ISA");
    Kernels kernels = kernels_select();
    *refused = name && *name && !kernels_named(name, &kernels) ? name : NULL;
    return *refused ? kernels_select() : kernels;
}
