// The floating-point environment of the host and of the core: rounding, traps, flushing of denormals,
// precision, status flags.
//
// The core computes in the default environment of IEEE 754: to nearest, no traps, denormals kept.  The host
// may have set anything. float_enter saves the host's environment and sets the default; float_leave restores
// the host's environment, so that not even a status flag is left behind.  Reading a control register takes about a
// nanosecond, writing one several, so each is written only where it differs.
#pragma once

#if defined(__x86_64__) || defined(_M_X64)
#include <stdint.h>
#include <string.h>

// SSE computes, so MXCSR rules; the x87 unit belongs to the environment too, because some C libraries compute
// in it (mingw's pow and atan2).
typedef struct {
    uint32_t mxcsr;
    uint16_t control, status;  // of x87
} FloatEnvironment;

enum {
    MXCSR_DEFAULT = 0x1f80,
    MXCSR_FLAGS = 0x3f,
    X87_DEFAULT = 0x37f,
    X87_MASKS = 0x3f,         // one bit for each exception: no trap
    X87_EXCEPTIONS = 0x80ff,  // in the status: the flags, and whether one of them waits to trap
    X87_ENVIRONMENT = 28,     // bytes that fnstenv stores: control at 0, status at 4
};

// The environment with which x87 instructions wait for no pending trap.
static inline void x87_read(uint16_t *control, uint16_t *status)
{
    __asm__ volatile("fnstcw %0" : "=m"(*control) : : "memory");
    __asm__ volatile("fnstsw %0" : "=am"(*status) : : "memory");
}

static inline void x87_set_control(uint16_t control)
{
    __asm__ volatile("fldcw %0" : : "m"(control) : "memory");
}

// Flags too, even those that trap at the host's next x87 instruction.
static inline void x87_restore(const FloatEnvironment *host)
{
    unsigned char environment[X87_ENVIRONMENT];
    __asm__ volatile("fnstenv %0" : "=m"(environment) : : "memory");
    uint16_t status;
    memcpy(&status, environment + 4, sizeof status);
    status = (uint16_t)((status & ~X87_EXCEPTIONS) | (host->status & X87_EXCEPTIONS));
    memcpy(environment, &host->control, sizeof host->control);
    memcpy(environment + 4, &status, sizeof status);
    __asm__ volatile("fldenv %0" : : "m"(environment) : "memory");
}

static inline void float_enter(FloatEnvironment *host)
{
    __asm__ volatile("stmxcsr %0" : "=m"(host->mxcsr) : : "memory");
    const uint32_t mxcsr = MXCSR_DEFAULT;
    if ((host->mxcsr & ~(uint32_t)MXCSR_FLAGS) != mxcsr)
        __asm__ volatile("ldmxcsr %0" : : "m"(mxcsr) : "memory");
    x87_read(&host->control, &host->status);
    if (host->control == X87_DEFAULT) return;
    if ((host->control & X87_MASKS) != X87_MASKS)
        __asm__ volatile("fnclex" : : : "memory");  // else a pending trap would meet the next instruction
    x87_set_control(X87_DEFAULT);
}

static inline void float_leave(const FloatEnvironment *host)
{
    uint32_t mxcsr;
    uint16_t control, status;
    __asm__ volatile("stmxcsr %0" : "=m"(mxcsr) : : "memory");
    if (mxcsr != host->mxcsr) __asm__ volatile("ldmxcsr %0" : : "m"(host->mxcsr) : "memory");
    x87_read(&control, &status);
    if ((status ^ host->status) & X87_EXCEPTIONS) {
        x87_restore(host);
    } else if (control != host->control) {
        x87_set_control(host->control);
    }
}

#elif defined(__aarch64__)
#include <stdint.h>

typedef struct {
    uint64_t control, status;
} FloatEnvironment;

static inline void float_read(FloatEnvironment *present)
{
    __asm__ volatile("mrs %0, fpcr" : "=r"(present->control) : : "memory");
    __asm__ volatile("mrs %0, fpsr" : "=r"(present->status) : : "memory");
}

static inline void float_enter(FloatEnvironment *host)
{
    float_read(host);
    if (host->control != 0) __asm__ volatile("msr fpcr, %0" : : "r"((uint64_t)0) : "memory");
}

static inline void float_leave(const FloatEnvironment *host)
{
    FloatEnvironment present;
    float_read(&present);
    if (present.control != host->control) __asm__ volatile("msr fpcr, %0" : : "r"(host->control) : "memory");
    if (present.status != host->status) __asm__ volatile("msr fpsr, %0" : : "r"(host->status) : "memory");
}

#else  // by the functions of C17
#include <fenv.h>

typedef fenv_t FloatEnvironment;

static inline void float_enter(FloatEnvironment *host)
{
    feholdexcept(host);
    fesetenv(FE_DFL_ENV);
}

static inline void float_leave(const FloatEnvironment *host)
{
    fesetenv(host);
}
#endif
