// Choice of the kernels for this processor, at run time.  The build names the instruction sets that it
// compiled by KERNELS_X86 or KERNELS_NEON; without such a name there is only the one of lanes.h.
#include "solver/kernels.h"

#include <stdlib.h>

#if defined(KERNELS_X86)
#include <cpuid.h>

extern const Kernels own_kernels_sse2, own_kernels_avx2, own_kernels_avx512;

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

static const Kernels *kernels_best(void)
{
    bool four, eight;
    processor_has(&four, &eight);
    return eight ? &own_kernels_avx512 : four ? &own_kernels_avx2 : &own_kernels_sse2;
}

static const Kernels *kernels_named(const char *name)
{
    bool four, eight;
    processor_has(&four, &eight);
    if (strcmp(name, "avx512") == 0 && eight) return &own_kernels_avx512;
    if (strcmp(name, "avx2") == 0 && four) return &own_kernels_avx2;
    return strcmp(name, "baseline") == 0 ? &own_kernels_sse2 : NULL;
}
#else
#if defined(KERNELS_NEON)
#define BASELINE own_kernels_neon
extern const Kernels own_kernels_neon;
#else
#define BASELINE own_kernels
#endif

static const Kernels *kernels_best(void)
{
    return &BASELINE;
}

static const Kernels *kernels_named(const char *name)
{
    return strcmp(name, "baseline") == 0 ? &BASELINE : NULL;
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
    const Kernels *wanted = name && *name ? kernels_named(name) : kernels_best();
    *refused = wanted ? NULL : name;
    return wanted ? *wanted : *kernels_best();
}
