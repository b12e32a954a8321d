// A host in the plainest C: loads the FMU's Windows binary, simulates and prints all values as hexadecimal
// floats.  Usage: fmu_host LIBRARY GUID STEPS STEP_SIZE < value references
#include <stdio.h>
#include <stdlib.h>
#include <windows.h>

#include "fmi2FunctionTypes.h"

enum { MAX_VALUES = 4096 };

static void forward(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status,
                    fmi2String category, fmi2String message, ...)
{
    (void)environment;
    fprintf(stderr, "%s %d %s: %s\n", instance, (int)status, category, message);
}

static HMODULE library;

static void *function(const char *name)
{
    union {
        FARPROC found;
        void *pointer;
    } address = {GetProcAddress(library, name)};

    if (!address.found) {
        fprintf(stderr, "no function %s\n", name);
        exit(1);
    }
    return address.pointer;
}

static void check(fmi2Status status, const char *what)
{
    if (status > fmi2Warning) {
        fprintf(stderr, "%s: status %d\n", what, (int)status);
        exit(1);
    }
}

int main(int count, char **argument)
{
    static fmi2ValueReference reference[MAX_VALUES];
    static fmi2Real value[MAX_VALUES];
    size_t n = 0;
    if (count != 5) return 2;
    while (n < MAX_VALUES && scanf("%u", &reference[n]) == 1) n++;
    const int steps = atoi(argument[3]);
    const double h = atof(argument[4]);
    library = LoadLibraryA(argument[1]);
    if (!library) {
        fprintf(stderr, "%s: error %lu\n", argument[1], GetLastError());
        return 1;
    }
    fmi2InstantiateTYPE *instantiate = function("fmi2Instantiate");
    fmi2SetupExperimentTYPE *set_up = function("fmi2SetupExperiment");
    fmi2EnterInitializationModeTYPE *enter = function("fmi2EnterInitializationMode");
    fmi2ExitInitializationModeTYPE *leave = function("fmi2ExitInitializationMode");
    fmi2DoStepTYPE *step = function("fmi2DoStep");
    fmi2GetRealTYPE *get = function("fmi2GetReal");
    fmi2TerminateTYPE *terminate = function("fmi2Terminate");
    fmi2FreeInstanceTYPE *delete = function("fmi2FreeInstance");

    const fmi2CallbackFunctions callbacks = {.logger = forward, .allocateMemory = calloc, .freeMemory = free};
    fmi2Component bearing =
        instantiate("bearing", fmi2CoSimulation, argument[2], "", &callbacks, fmi2False, fmi2False);
    if (!bearing) return 1;
    check(set_up(bearing, fmi2False, 0.0, 0.0, fmi2False, 0.0), "fmi2SetupExperiment");
    check(enter(bearing), "fmi2EnterInitializationMode");
    check(leave(bearing), "fmi2ExitInitializationMode");
    for (int k = 0; k <= steps; k++) {
        if (k > 0) check(step(bearing, (k - 1) * h, h, fmi2True), "fmi2DoStep");
        check(get(bearing, reference, n, value), "fmi2GetReal");
        for (size_t i = 0; i < n; i++) printf("%a%c", value[i], i + 1 < n ? ' ' : '\n');
    }
    check(terminate(bearing), "fmi2Terminate");
    delete(bearing);
    FreeLibrary(library);
    return 0;
}
