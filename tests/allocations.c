// Counts what an FMU's binary takes of memory: allocations inside fmi2DoStep, fmi2GetReal and the derivative
// functions, growth of the process.
//     allocations BINARY GUID STEPS STEP_SIZE REFERENCE...
// prints: allocations, bytes grown in the second half of the steps; blocks left and bytes grown by 500 lives
// of an instance after 500 others
#define _GNU_SOURCE
#include "fmi2Functions.h"

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

// The C library's own, under the names it offers for this.
extern void *__libc_malloc(size_t size);
extern void *__libc_calloc(size_t n, size_t size);
extern void *__libc_realloc(void *memory, size_t size);
extern void *__libc_memalign(size_t alignment, size_t size);
extern void __libc_free(void *memory);

static int counting;
static long allocations, blocks;

static void *counted(void *memory)
{
    allocations += counting;
    blocks += memory != NULL;
    return memory;
}

void *malloc(size_t size)
{
    return counted(__libc_malloc(size));
}

void *calloc(size_t n, size_t size)
{
    return counted(__libc_calloc(n, size));
}

void *realloc(void *memory, size_t size)
{
    blocks -= memory != NULL;
    return counted(__libc_realloc(memory, size));
}

void *aligned_alloc(size_t alignment, size_t size)
{
    return counted(__libc_memalign(alignment, size));
}

int posix_memalign(void **memory, size_t alignment, size_t size)
{
    *memory = counted(__libc_memalign(alignment, size));
    return *memory ? 0 : 12;
}

void free(void *memory)
{
    blocks -= memory != NULL;
    __libc_free(memory);
}

static long resident(void)
{
    long pages = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    long shared = 0;
    if (!file || fscanf(file, "%*d %ld %ld", &pages, &shared) != 2) exit(2);
    fclose(file);
    return (pages - shared) * sysconf(_SC_PAGESIZE);
}

static void *symbol(void *library, const char *name)
{
    void *found = dlsym(library, name);
    if (!found) exit(2);
    return found;
}

static fmi2InstantiateTYPE *instantiate;
static fmi2SetupExperimentTYPE *setup;
static fmi2EnterInitializationModeTYPE *enter;
static fmi2ExitInitializationModeTYPE *leave;
static fmi2DoStepTYPE *do_step;
static fmi2GetRealTYPE *get_real;
static fmi2SetRealInputDerivativesTYPE *set_slope;
static fmi2GetDirectionalDerivativeTYPE *get_derivative;
static fmi2GetFMUstateTYPE *get_state;
static fmi2FreeFMUstateTYPE *free_state;
static fmi2FreeInstanceTYPE *free_instance;

static fmi2Component start(const char *guid)
{
    static const fmi2CallbackFunctions functions = {0};  // no logger, no memory functions
    fmi2Component c = instantiate("bearing", fmi2CoSimulation, guid, "", &functions, 0, 0);
    if (!c || setup(c, 0, 0.0, 0.0, 0, 0.0) || enter(c) || leave(c)) exit(3);
    return c;
}

static void live(const char *guid, int times)
{
    while (times-- > 0) {
        fmi2Component c = start(guid);
        fmi2FMUstate state = NULL;
        if (do_step(c, 0.0, 1e-6, 1) > fmi2Warning || get_state(c, &state) || free_state(c, &state)) exit(4);
        free_instance(c);
    }
}

int main(int argc, char **argv)
{
    void *library = argc > 5 ? dlopen(argv[1], RTLD_NOW) : NULL;
    if (!library) return 2;
    instantiate = (fmi2InstantiateTYPE *)symbol(library, "fmi2Instantiate");
    setup = (fmi2SetupExperimentTYPE *)symbol(library, "fmi2SetupExperiment");
    enter = (fmi2EnterInitializationModeTYPE *)symbol(library, "fmi2EnterInitializationMode");
    leave = (fmi2ExitInitializationModeTYPE *)symbol(library, "fmi2ExitInitializationMode");
    do_step = (fmi2DoStepTYPE *)symbol(library, "fmi2DoStep");
    get_real = (fmi2GetRealTYPE *)symbol(library, "fmi2GetReal");
    set_slope = (fmi2SetRealInputDerivativesTYPE *)symbol(library, "fmi2SetRealInputDerivatives");
    get_derivative = (fmi2GetDirectionalDerivativeTYPE *)symbol(library, "fmi2GetDirectionalDerivative");
    get_state = (fmi2GetFMUstateTYPE *)symbol(library, "fmi2GetFMUstate");
    free_state = (fmi2FreeFMUstateTYPE *)symbol(library, "fmi2FreeFMUstate");
    free_instance = (fmi2FreeInstanceTYPE *)symbol(library, "fmi2FreeInstance");

    const long steps = atol(argv[3]);
    const double h = atof(argv[4]);
    fmi2Component c = start(argv[2]);
    long before = resident();
    for (long k = 0; k < steps; k++) {
        if (k == steps / 2) before = resident();
        const fmi2ValueReference load = 1;
        const fmi2Integer order = 1;
        const fmi2Real slope = k % 2 ? 1e3 : -1e3;
        counting = 1;
        if (set_slope(c, &load, 1, &order, &slope)) return 6;
        if (do_step(c, (double)k * h, h, 1) > fmi2Warning) return 4;
        for (int i = 5; i < argc; i++) {
            const fmi2ValueReference reference = (fmi2ValueReference)atol(argv[i]);
            double value;
            if (get_real(c, &reference, 1, &value) > fmi2Warning) return 5;
            if (i == 5 && get_derivative(c, &reference, 1, &load, 1, &slope, &value)) return 7;
        }
        counting = 0;
    }
    printf("%ld %ld ", allocations, resident() - before);
    free_instance(c);

    live(argv[2], 500);
    const long held = blocks, grown = resident();
    live(argv[2], 500);
    printf("%ld %ld\n", blocks - held, resident() - grown);
    return 0;
}
