// Memory that runs out: each act of an instance's life is repeated with its first, second, third ...
// allocation refused until none is, and holds:
//
//   the call is refused with a message, nothing else happens; what was taken for it is given back
//   the instance can then be reset and runs as a new one, byte for byte
//
// The linker sends all allocations of the FMU's own code here (--wrap), those of a sanitizer's build too.
// Prints for each act how many were refused.
#include "instance/part.h"

#include "fmi2Functions.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define REQUIRE(condition) require(condition, #condition, __LINE__)

static void require(bool condition, const char *text, int line)
{
    if (condition) return;
    fprintf(stderr, "fault_memory.c:%d: violated: %s\n", line, text);
    abort();
}

// ---- allocations of the FMU ---------------------------------------------------------------------------------------------------------------------
void *__real_malloc(size_t size);
void *__real_calloc(size_t n, size_t size);
void *__real_realloc(void *memory, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
void __real_free(void *memory);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t n, size_t size);
void *__wrap_realloc(void *memory, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);
void __wrap_free(void *memory);

static long before_refusal = -1;  // allocations that are granted; negative: all
static long refused, blocks;

static bool granted(void)
{
    if (before_refusal != 0) {
        before_refusal--;
        return true;
    }
    before_refusal = -1;
    refused++;
    return false;
}

static void *counted(void *memory)
{
    blocks += memory != NULL;
    return memory;
}

void *__wrap_malloc(size_t size)
{
    return granted() ? counted(__real_malloc(size)) : NULL;
}

void *__wrap_calloc(size_t n, size_t size)
{
    return granted() ? counted(__real_calloc(n, size)) : NULL;
}

void *__wrap_realloc(void *memory, size_t size)
{
    if (!granted()) return NULL;
    blocks -= memory != NULL;
    return counted(__real_realloc(memory, size));
}

void *__wrap_aligned_alloc(size_t alignment, size_t size)
{
    return granted() ? counted(__real_aligned_alloc(alignment, size)) : NULL;
}

void __wrap_free(void *memory)
{
    blocks -= memory != NULL;
    __real_free(memory);
}

// ---- a host ---------------------------------------------------------------------------------------------------------------------------------------
static long messages;

static void logger(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status,
                   fmi2String category, fmi2String message, ...)
{
    (void)environment, (void)instance, (void)category;
    messages += status == fmi2Error && strstr(message, "memory") != NULL;
}

static fmi2Component c;
static fmi2FMUstate state;
static char *bytes;  // a serialized state
static size_t size;

static fmi2Status instantiate(void)
{
    static const fmi2CallbackFunctions functions = {.logger = logger};
    c = fmi2Instantiate("instance", fmi2CoSimulation, MODEL_GUID, "", &functions, 0, 1);
    return c ? fmi2OK : fmi2Error;
}

static fmi2Status initialize(void)
{
    if (fmi2SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0) > fmi2Warning ||
        fmi2EnterInitializationMode(c) > fmi2Warning)
        return fmi2Error;
    return fmi2ExitInitializationMode(c);
}

static fmi2Status step(void)
{
    return fmi2DoStep(c, 0.0, 1e-5, 1);
}

static fmi2Status save(void)
{
    return fmi2GetFMUstate(c, &state);
}

static fmi2Status load(void)
{
    return fmi2DeSerializeFMUstate(c, bytes, size, &state);
}

static fmi2Status restore(void)
{
    return fmi2SetFMUstate(c, state);
}

static void nothing(void) {}

static void instance(void)
{
    REQUIRE(instantiate() == fmi2OK);
}

static void initialized(void)
{
    instance();
    REQUIRE(initialize() <= fmi2Warning);
}

static void saved(void)
{
    initialized();
    REQUIRE(save() == fmi2OK);
}

static void release(void)
{
    if (c && state) REQUIRE(fmi2FreeFMUstate(c, &state) == fmi2OK);
    if (c) fmi2FreeInstance(c);
    c = NULL;
}

// The state after one step of a new or reset instance, serialized into memory of this file's.
static unsigned char *run(void)
{
    fmi2FMUstate end = NULL;
    REQUIRE(initialize() <= fmi2Warning && step() <= fmi2Warning);
    REQUIRE(fmi2GetFMUstate(c, &end) == fmi2OK && fmi2SerializedFMUstateSize(c, end, &size) == fmi2OK);
    unsigned char *serialized = __real_malloc(size);
    REQUIRE(serialized && fmi2SerializeFMUstate(c, end, (char *)serialized, size) == fmi2OK &&
            fmi2FreeFMUstate(c, &end) == fmi2OK);
    return serialized;
}

// Repeats an act, prepared anew each time, until none of its allocations is refused; returns how many could be.
static long refuse_each(void (*prepare)(void), fmi2Status (*act)(void), const unsigned char *expected)
{
    for (long n = 0;; n++) {
        prepare();
        const long before = blocks, said = messages;
        refused = 0;
        before_refusal = n;
        const fmi2Status status = act();
        before_refusal = -1;
        if (refused == 0) {
            REQUIRE(status <= fmi2Warning);
            release();
            REQUIRE(blocks == 0);
            return n;
        }
        REQUIRE(status == fmi2Error || status == fmi2Fatal);
        REQUIRE(messages > said);
        REQUIRE(blocks == before);
        if (c && status == fmi2Error) {
            REQUIRE(fmi2Reset(c) == fmi2OK);
            unsigned char *after = run();
            REQUIRE(memcmp(after, expected, size) == 0);
            __real_free(after);
        }
        release();
        REQUIRE(blocks == 0);
    }
}

int main(void)
{
    instance();
    unsigned char *expected = run();
    bytes = (char *)expected;
    release();
    printf("instantiate %ld\n", refuse_each(nothing, instantiate, expected));
    printf("initialize %ld\n", refuse_each(instance, initialize, expected));
    printf("step %ld\n", refuse_each(initialized, step, expected));
    printf("save %ld\n", refuse_each(initialized, save, expected));
    printf("load %ld\n", refuse_each(initialized, load, expected));
    printf("restore %ld\n", refuse_each(saved, restore, expected));
    __real_free(expected);
    return 0;
}
