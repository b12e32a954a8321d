// A host with a floating-point environment of its own: calls every function of an FMU in it, with what is
// right and with what is refused.
//
//   float_host LIBRARY MODE < script      one line for each function: its calls, those after which the environment differed from before, messages that
//                                         the logger got in another environment, and a digest of all that came back
//
// The script: the GUID, then numbers: how many outputs and their value references, a Real input, how many
// Integer parameters and pairs of reference and value, how many Real parameters and pairs.  Digests of two
// modes are equal if the FMU computed the same bits.
#define _DEFAULT_SOURCE
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi2FunctionTypes.h"

#if defined(_WIN32)
#include <windows.h>
#else
#include <dlfcn.h>
#endif

// ---- floating-point environments ---------------------------------------------------------------------------------------------------------------
#if defined(__x86_64__)
typedef struct {
    const char *name;
    uint32_t mxcsr;
    uint16_t control, status;  // of x87
} Mode;

static const Mode MODES[] = {
    {"default", 0x1f80, 0x37f, 0},      {"traps", 0x0000, 0x340, 0},      {"down", 0x3f80, 0x77f, 0},
    {"up", 0x5f80, 0xb7f, 0},           {"zero", 0x7f80, 0xf7f, 0},       {"flushed", 0x9fc0, 0x37f, 0},
    {"x87_double", 0x1f80, 0x27f, 0},   {"x87_single", 0x1f80, 0x07f, 0}, {"flags", 0x1fbf, 0x37f, 0x3f},
    {"pending", 0x003f, 0x340, 0x80bf},  // the next x87 instruction that waits would trap
    {"all", 0xc040, 0x840, 0},           // traps, upward, flushed, single
};

static void mode_set(const Mode *mode)
{
    unsigned char environment[28];
    __asm__ volatile("fnclex\n\tfnstenv %0" : "=m"(environment) : : "memory");
    memcpy(environment, &mode->control, sizeof mode->control);
    memcpy(environment + 4, &mode->status, sizeof mode->status);
    __asm__ volatile("fldenv %0\n\tldmxcsr %1" : : "m"(environment), "m"(mode->mxcsr) : "memory");
}

static int mode_is(const Mode *mode)
{
    Mode now = {0};
    __asm__ volatile("stmxcsr %0\n\tfnstcw %1\n\tfnstsw %2"
                     : "=m"(now.mxcsr), "=m"(now.control), "=m"(now.status)
                     :
                     : "memory");
    const uint16_t flags = 0x80ff;
    return now.mxcsr == mode->mxcsr && now.control == mode->control &&
           (now.status & flags) == (mode->status & flags);
}
#elif defined(__aarch64__)
typedef struct {
    const char *name;
    uint64_t control, status;
} Mode;

static const Mode MODES[] = {
    {"default", 0, 0},     {"traps", 0x9f00, 0},      {"down", 0x800000, 0}, {"up", 0x400000, 0},
    {"zero", 0xc00000, 0}, {"flushed", 0x1000000, 0}, {"flags", 0, 0x9f},    {"all", 0x1409f00, 0},
};

static void mode_set(const Mode *mode)
{
    __asm__ volatile("msr fpcr, %0\n\tmsr fpsr, %1" : : "r"(mode->control), "r"(mode->status) : "memory");
}

static int mode_is(const Mode *mode)
{
    uint64_t control, status;
    __asm__ volatile("mrs %0, fpcr\n\tmrs %1, fpsr" : "=r"(control), "=r"(status) : : "memory");
    return (control ^ mode->control) % 0x10000000 / 0x10000 == 0 &&
           (status & 0x9f) == (mode->status & 0x9f);  // processors need not have traps
}
#endif

// ---- what is counted of each function --------------------------------------------------------------------------------------------------------------
typedef struct {
    const char *name;
    long calls, changed, logged_elsewhere;
    uint64_t digest;
} Count;

enum { MOST_FUNCTIONS = 64, MOST = 4096 };

static Count counts[MOST_FUNCTIONS];
static Count *current;
static const Mode *host;

static void digest(const void *data, size_t size)
{
    for (size_t i = 0; i < size; i++)
        current->digest = (current->digest ^ ((const unsigned char *)data)[i]) * 0x100000001b3u;
}

static void begin(const char *name)
{
    for (current = counts; current->name && strcmp(current->name, name) != 0;) current++;
    current->name = name;
    current->calls++;
    mode_set(host);
}

static void end(void)
{
    if (!mode_is(host)) current->changed++;
    mode_set(&MODES[0]);
}

static void logger(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status,
                   fmi2String category, fmi2String message, ...)
{
    (void)environment, (void)instance;
    if (!mode_is(host)) current->logged_elsewhere++;
    mode_set(&MODES[0]);
    digest(&status, sizeof status);
    digest(category, strlen(category));
    digest(message, strlen(message));
    mode_set(host);
}

// ---- functions of the FMU ----------------------------------------------------------------------------------------------------------------------
#if defined(_WIN32)
static HMODULE library;
#else
static void *library;
#endif

static void *function(const char *name)
{
#if defined(_WIN32)
    union {
        FARPROC found;
        void *pointer;
    } address = {GetProcAddress(library, name)};
#else
    union {
        void *pointer;
    } address = {dlsym(library, name)};
#endif
    if (!address.pointer) {
        fprintf(stderr, "no function %s\n", name);
        exit(2);
    }
    return address.pointer;
}

// Calls fmi2<name>(...) in the host's environment; the result of type `type` goes into the digest and is the
// value of the expression.
static fmi2Status status;
#define CALL(name, ...)                                    \
    do {                                                   \
        fmi2##name##TYPE *called = function("fmi2" #name); \
        begin("fmi2" #name);                               \
        status = called(__VA_ARGS__);                      \
        end();                                             \
        digest(&status, sizeof status);                    \
    } while (0)
#define MUST(expected, name, ...)                                                          \
    do {                                                                                   \
        CALL(name, __VA_ARGS__);                                                           \
        if (status != (expected)) {                                                        \
            fprintf(stderr, "line %d: fmi2" #name ": status %d\n", __LINE__, (int)status); \
            exit(3);                                                                       \
        }                                                                                  \
    } while (0)

// ---- the script ---------------------------------------------------------------------------------------------------------------------------------
static char guid[128];
static fmi2ValueReference outputs[MOST], integers[MOST], reals[MOST], input;
static size_t n_outputs, n_integers, n_reals;
static fmi2Integer integer_values[MOST];
static fmi2Real real_values[MOST], values[MOST];

static size_t read_count(void)
{
    size_t n;
    if (scanf("%zu", &n) != 1 || n > MOST) exit(2);
    return n;
}

static void read_script(void)
{
    if (scanf("%127s", guid) != 1) exit(2);
    n_outputs = read_count();
    for (size_t i = 0; i < n_outputs; i++)
        if (scanf("%u", &outputs[i]) != 1) exit(2);
    if (scanf("%u", &input) != 1) exit(2);
    n_integers = read_count();
    for (size_t i = 0; i < n_integers; i++)
        if (scanf("%u %d", &integers[i], &integer_values[i]) != 2) exit(2);
    n_reals = read_count();
    for (size_t i = 0; i < n_reals; i++)
        if (scanf("%u %lf", &reals[i], &real_values[i]) != 2) exit(2);
}

// ---- scenes -----------------------------------------------------------------------------------------------------------------------------------------
static const double H = 1e-4, NOT_A_NUMBER = (double)(__builtin_inff() - __builtin_inff());
static fmi2Component c;

static void read_outputs(void)
{
    MUST(fmi2OK, GetReal, c, outputs, n_outputs, values);
    digest(values, n_outputs * sizeof *values);
}

static void instantiate(const char *token, int expected)
{
    static const fmi2CallbackFunctions functions = {.logger = logger};
    fmi2InstantiateTYPE *called = function("fmi2Instantiate");
    begin("fmi2Instantiate");
    c = called("host", fmi2CoSimulation, token, "", &functions, 0, 1);
    end();
    if ((c != NULL) != expected) exit(3);
}

static void text(const char *name)
{
    union {
        void *pointer;
        fmi2GetVersionTYPE *called;  // as fmi2GetTypesPlatformTYPE
    } address = {function(name)};

    begin(name);
    const char *answer = address.called();
    end();
    digest(answer, strlen(answer));
}

static void set_up(void)
{
    const fmi2Real slope = 1e3;
    const fmi2Integer order = 1;
    MUST(fmi2OK, SetupExperiment, c, 1, 1e-4, 0.0, 1, 1.0);
    MUST(fmi2OK, SetInteger, c, integers, n_integers, integer_values);
    MUST(fmi2OK, SetReal, c, reals, n_reals, real_values);
    MUST(fmi2OK, SetBoolean, c, NULL, 0, NULL);
    MUST(fmi2OK, SetString, c, NULL, 0, NULL);
    MUST(fmi2OK, EnterInitializationMode, c);
    read_outputs();
    CALL(ExitInitializationMode, c);
    if (status > fmi2Warning) exit(3);
    MUST(fmi2OK, SetRealInputDerivatives, c, &input, 1, &order, &slope);
}

static double step(double time, int n)
{
    for (int k = 0; k < n; k++, time += H) {
        CALL(DoStep, c, time, H, 1);
        if (status > fmi2Warning) exit(3);
    }
    read_outputs();
    return time;
}

static void save_and_restore(double time)
{
    fmi2FMUstate state = NULL, other = NULL;
    size_t size = 0;
    MUST(fmi2OK, GetFMUstate, c, &state);
    MUST(fmi2OK, SerializedFMUstateSize, c, state, &size);
    char *bytes = malloc(size);
    if (!bytes) exit(2);
    MUST(fmi2OK, SerializeFMUstate, c, state, bytes, size);
    digest(bytes, size);
    step(time, 3);
    MUST(fmi2OK, DeSerializeFMUstate, c, bytes, size, &other);
    MUST(fmi2OK, SetFMUstate, c, other);
    read_outputs();
    step(time, 3);
    MUST(fmi2OK, FreeFMUstate, c, &state);
    MUST(fmi2OK, FreeFMUstate, c, &other);
    bytes[size / 2] ^= 1;
    MUST(fmi2Error, DeSerializeFMUstate, c, bytes, size, &other);
    free(bytes);
}

static void derivatives(void)
{
    static fmi2Integer order[MOST];
    const fmi2ValueReference twice[2] = {input, input};
    const fmi2Real small[2] = {1.0, -2.0}, large[2] = {1.7e308, 1.7e308};
    for (size_t i = 0; i < n_outputs; i++) order[i] = 1;
    MUST(fmi2OK, GetRealOutputDerivatives, c, outputs, n_outputs, order, values);
    digest(values, n_outputs * sizeof *values);
    MUST(fmi2OK, GetDirectionalDerivative, c, outputs, n_outputs, twice, 2, small, values);
    digest(values, n_outputs * sizeof *values);
    MUST(fmi2OK, GetDirectionalDerivative, c, outputs, n_outputs, twice, 2, large, values);  // overflows
}

static void other_readings(void)
{
    fmi2Status kind = fmi2OK;
    fmi2Integer integer[MOST];
    fmi2Boolean boolean = 0;
    fmi2String string = NULL;
    MUST(fmi2OK, GetInteger, c, integers, n_integers, integer);
    digest(integer, n_integers * sizeof *integer);
    MUST(fmi2OK, GetBoolean, c, NULL, 0, NULL);
    MUST(fmi2OK, GetString, c, NULL, 0, NULL);
    MUST(fmi2OK, GetStatus, c, fmi2DoStepStatus, &kind);
    MUST(fmi2OK, GetRealStatus, c, fmi2LastSuccessfulTime, values);
    digest(values, sizeof *values);
    MUST(fmi2Discard, GetIntegerStatus, c, fmi2DoStepStatus, integer);
    MUST(fmi2OK, GetBooleanStatus, c, fmi2Terminated, &boolean);
    MUST(fmi2OK, GetStringStatus, c, fmi2PendingStatus, &string);
    digest(string, strlen(string));
}

// A call that is refused, with a message, and a reset.
#define REFUSED(name, ...)                  \
    do {                                    \
        MUST(fmi2Error, name, __VA_ARGS__); \
        MUST(fmi2OK, Reset, c);             \
    } while (0)

static void refusals(void)
{
    fmi2EventInfo info;
    fmi2Boolean boolean[2];
    const fmi2String categories[2] = {"logAll", "nonsense"};
    MUST(fmi2OK, SetupExperiment, c, 1, NOT_A_NUMBER, 0.0, 0, 0.0);
    MUST(fmi2OK, SetupExperiment, c, 1, 5e-324, 0.0, 0, 0.0);
    MUST(fmi2Warning, SetDebugLogging, c, 1, 2, categories);
    const fmi2Real wrong = NOT_A_NUMBER;
    REFUSED(SetReal, c, &input, 1, &wrong);
    REFUSED(SetInteger, c, &input, 1, NULL);
    REFUSED(SetBoolean, c, &input, 1, NULL);
    REFUSED(SetString, c, &input, 1, NULL);
    REFUSED(GetReal, c, &input, 1, values);
    REFUSED(SetupExperiment, c, 0, 0.0, NOT_A_NUMBER, 0, 0.0);
    REFUSED(DoStep, c, 0.0, NOT_A_NUMBER, 1);
    REFUSED(CancelStep, c);
    REFUSED(EnterEventMode, c);
    REFUSED(NewDiscreteStates, c, &info);
    REFUSED(EnterContinuousTimeMode, c);
    REFUSED(CompletedIntegratorStep, c, 1, boolean, boolean + 1);
    REFUSED(SetTime, c, 0.0);
    REFUSED(SetContinuousStates, c, values, 1);
    REFUSED(GetDerivatives, c, values, 1);
    REFUSED(GetEventIndicators, c, values, 1);
    REFUSED(GetContinuousStates, c, values, 1);
    REFUSED(GetNominalsOfContinuousStates, c, values, 1);
}

int main(int count, char **argument)
{
    if (count != 3) return 2;
    for (size_t i = 0; i < sizeof MODES / sizeof MODES[0]; i++) {
        if (strcmp(argument[2], "modes") == 0) printf("%s ", MODES[i].name);
        if (strcmp(argument[2], MODES[i].name) == 0) host = &MODES[i];
    }
    if (!host) return strcmp(argument[2], "modes") == 0 ? 0 : 2;
    read_script();
#if defined(_WIN32)
    mode_set(host);
    library = LoadLibraryA(argument[1]);
    mode_set(&MODES[0]);
#else
    mode_set(host);
    library = dlopen(argument[1], RTLD_NOW | RTLD_LOCAL);
    mode_set(&MODES[0]);
#endif
    if (!library) return 2;
    text("fmi2GetTypesPlatform");
    text("fmi2GetVersion");
    instantiate("{wrong}", 0);
    instantiate(guid, 1);
    refusals();
    set_up();
    const double time = step(0.0, 10);
    other_readings();
    derivatives();
    save_and_restore(time);
    MUST(fmi2OK, Reset, c);
    set_up();
    step(0.0, 1);
    MUST(fmi2OK, Terminate, c);
    fmi2FreeInstanceTYPE *release = function("fmi2FreeInstance");
    begin("fmi2FreeInstance");
    release(c);
    end();
    for (const Count *one = counts; one->name; one++) {
        printf("%s %ld %ld %ld %016llx\n", one->name, one->calls, one->changed, one->logged_elsewhere,
               (unsigned long long)one->digest);
    }
    return 0;
}
