// Calls the FMI functions in any order with any arguments, as a byte string says, and holds what must hold
// whatever the calls were:
//
//   a status of the standard, never fmi2Fatal;  no NaN with fmi2OK;  an error comes with a message
//   fmi2Discard of a step: fmi2Terminated is true, the time reached lies inside the step, all outputs are finite
//   a reset instance runs as a new one: its state after one step is the same byte for byte
//   floating-point environment and arguments beyond the given sizes are left alone (the sanitizers see the latter)
//
// LLVMFuzzerTestOneInput is what coverage-guided fuzzers call.  With -DSTANDALONE:  fuzz_api CALLS [SEED
// [THREADS]]  feeds pseudo-random strings until each thread has made that many calls and prints what came
// back.  A violation aborts.
#include "instance/part.h"

#include "fmi2Functions.h"

#include <fenv.h>
#include <inttypes.h>
#include <math.h>
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define REQUIRE(condition) require(condition, #condition, __LINE__)

enum { INSTANCES = 2, STATES = 3, MAX_VALUES = 24, N_STATUS = 6 };

// ---- the string that decides ------------------------------------------------------------------------------
typedef struct {
    const uint8_t *next, *end;
} Bytes;

static uint64_t take(Bytes *bytes, int n)
{
    uint64_t value = 0;
    while (n-- > 0) value = value << 8 | (bytes->next < bytes->end ? *bytes->next++ : 0);
    return value;
}

static unsigned choose(Bytes *bytes, unsigned choices)
{
    return (unsigned)take(bytes, choices > 256 ? 2 : 1) % choices;
}

static bool chance(Bytes *bytes, unsigned in_256)
{
    return take(bytes, 1) < in_256;
}

static double uniform(Bytes *bytes)
{
    return (double)take(bytes, 2) / 65535.0;
}

static double any_double(Bytes *bytes)
{
    static const double odd[] = {0.0,    -0.0,      1.0,     -1.0,     NAN,  INFINITY, -INFINITY,
                                 5e-324, -2.2e-308, 1.7e308, -1.7e308, 1e-9, 0.1,      1e15};
    if (chance(bytes, 192)) return odd[choose(bytes, sizeof odd / sizeof odd[0])];
    const uint64_t word = take(bytes, 8);
    double value;
    memcpy(&value, &word, sizeof value);
    return value;
}

// ---- bookkeeping ------------------------------------------------------------------------------------------
static _Thread_local long calls, counts[N_STATUS], steps_done, runs_compared;
static _Thread_local const char *last_call = "nothing";
static _Thread_local char last_message[512];
static _Thread_local uint64_t string_seed;  // fuzz_api 1 SEED repeats this string

static void require(bool condition, const char *text, int line)
{
    if (condition) return;
    fprintf(stderr,
            "fuzz_api.c:%d: violated after %s: %s\nlast message: %s\nseed of the string: %" PRIu64 "\n", line,
            last_call, text, last_message, string_seed);
    abort();
}

typedef struct {
    fmi2Component component;
    double time, stop;               // as the host knows them
    long messages, messages_before;  // before the call in progress
    bool refused;                    // since the last reset or restored state
} Host;

typedef struct {
    Bytes bytes;
    Host hosts[INSTANCES];
    fmi2FMUstate states[STATES];
} Fuzz;

static void logger(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status,
                   fmi2String category, fmi2String message, ...)
{
    Host *host = environment;
    host->messages++;
    REQUIRE(instance && category && message && strlen(message) > 0 && strlen(message) < 2048);
    REQUIRE(status <= fmi2Fatal);
    snprintf(last_message, sizeof last_message, "%.500s", message);
}

static fmi2Status seen(Host *host, const char *name, fmi2Status status)
{
    last_call = name;
    calls++;
    REQUIRE(status <= fmi2Error);
    counts[status]++;
    steps_done += status <= fmi2Warning && strcmp(name, "fmi2DoStep") == 0;
    if (status == fmi2Error && host->component) REQUIRE(host->messages > host->messages_before);
    host->refused |= status == fmi2Error;
    return status;
}

// CALL(host, DoStep, ...) calls fmi2DoStep(host->component, ...).
#define CALL(host, function, ...) \
    ((host)->messages_before = (host)->messages, seen(host, "fmi2" #function, fmi2##function(__VA_ARGS__)))

// `wrong`: with something that must be refused.
static void new_instance(Host *host, Bytes *bytes, bool wrong)
{
    const fmi2CallbackFunctions functions = {.logger = logger, .componentEnvironment = host};
    fmi2Component component = wrong
                                  ? fmi2Instantiate(chance(bytes, 128) ? NULL : "",
                                                    chance(bytes, 128) ? fmi2CoSimulation : fmi2ModelExchange,
                                                    chance(bytes, 128) ? NULL : "{0}", NULL,
                                                    chance(bytes, 64) ? NULL : &functions, 1, 1)
                                  : fmi2Instantiate("fuzz", fmi2CoSimulation, MODEL_GUID,
                                                    chance(bytes, 128) ? NULL : "file:///nowhere", &functions,
                                                    0, chance(bytes, 128));
    calls++;
    REQUIRE(wrong == (component == NULL));
    host->component = component;
    host->refused = false;
    host->time = 0.0;
    host->stop = INFINITY;
}

// ---- arguments --------------------------------------------------------------------------------------------
// Mostly references of the table.
static fmi2ValueReference any_reference(Bytes *bytes)
{
    if (chance(bytes, 12)) return (fmi2ValueReference)take(bytes, 4);
    const Variable *v = &VARIABLES[choose(bytes, N_VARIABLES)];
    return v->value_reference + choose(bytes, (unsigned)v->count + chance(bytes, 8));
}

// One that can be set to a Real or an Integer.
static fmi2ValueReference settable_reference(Bytes *bytes)
{
    for (int trial = 0; trial < 8; trial++) {
        const Variable *v = &VARIABLES[choose(bytes, N_VARIABLES)];
        if (v->causality == CAUSALITY_INPUT || v->causality == CAUSALITY_PARAMETER) return v->value_reference;
    }
    return any_reference(bytes);
}

// A value that often is allowed.
static double value_for(fmi2ValueReference reference, Bytes *bytes)
{
    int element;
    const Variable *v = variable_find(reference, &element);
    if (v == NULL || chance(bytes, 10)) return any_double(bytes);
    switch (choose(bytes, 6)) {
    case 0: return v->min;
    case 1: return v->max;
    case 2: return v->min + uniform(bytes) * (v->max - v->min);
    default: return v->start * (0.9 + 0.2 * uniform(bytes));
    }
}

static size_t some(Bytes *bytes)
{
    return chance(bytes, 230) ? choose(bytes, 4) : choose(bytes, MAX_VALUES + 1);
}

// ---- actions ----------------------------------------------------------------------------------------------
static void check_outputs(Host *host)
{
    for (const Variable *v = VARIABLES; v < VARIABLES + N_VARIABLES; v++) {
        if (v->causality != CAUSALITY_OUTPUT) continue;
        for (int i = 0; i < v->count; i++) {
            const fmi2ValueReference reference = v->value_reference + (unsigned)i;
            double value = NAN;
            REQUIRE(CALL(host, GetReal, host->component, &reference, 1, &value) <= fmi2Warning);
            REQUIRE(isfinite(value));
        }
    }
}

static void get_real(Fuzz *f, Host *host)
{
    fmi2ValueReference references[MAX_VALUES];
    const size_t n = some(&f->bytes);
    double *values =
        malloc((n + 1) * sizeof *values);  // exactly as large as told: the address sanitizer watches
    for (size_t i = 0; i < n; i++) references[i] = any_reference(&f->bytes);
    const bool null = chance(&f->bytes, 4);
    const fmi2Status status = CALL(host, GetReal, host->component, null ? NULL : references, n, values);
    if (status == fmi2OK && !(null && n == 0)) {
        for (size_t i = 0; i < n; i++) REQUIRE(!isnan(values[i]));
    }
    free(values);
}

static void get_integer(Fuzz *f, Host *host)
{
    fmi2ValueReference references[MAX_VALUES];
    fmi2Integer values[MAX_VALUES];
    const size_t n = some(&f->bytes);
    for (size_t i = 0; i < n; i++) references[i] = any_reference(&f->bytes);
    CALL(host, GetInteger, host->component, references, n, chance(&f->bytes, 4) ? NULL : values);
}

static void get_other(Fuzz *f, Host *host)
{
    fmi2ValueReference reference = any_reference(&f->bytes);
    fmi2Boolean boolean;
    fmi2String text;
    const size_t n = choose(&f->bytes, 2);
    if (chance(&f->bytes, 128))
        CALL(host, GetBoolean, host->component, &reference, n, &boolean);
    else
        CALL(host, GetString, host->component, &reference, n, &text);
}

static void set_real(Fuzz *f, Host *host)
{
    fmi2ValueReference references[MAX_VALUES];
    double values[MAX_VALUES];
    const size_t n = some(&f->bytes);
    for (size_t i = 0; i < n; i++) {
        references[i] = chance(&f->bytes, 240) ? settable_reference(&f->bytes) : any_reference(&f->bytes);
        values[i] = value_for(references[i], &f->bytes);
    }
    const bool null = chance(&f->bytes, 4);
    CALL(host, SetReal, host->component, references, n, null ? NULL : values);
}

static void set_input(Fuzz *f, Host *host)
{
    const fmi2ValueReference reference = 1 + choose(&f->bytes, 10);
    const double value = value_for(reference, &f->bytes);
    CALL(host, SetReal, host->component, &reference, 1, &value);
}

enum { MOST_STEPS = 1000 };  // internal ones in one communication step: a host may allow 2e9, which are hours

static fmi2ValueReference work_limit(void)
{
    return variable_named("solver.max_steps")->value_reference;
}

// A bounded number of internal steps keeps the sequences short.
static void limit_work(Host *host, fmi2Integer steps)
{
    const fmi2ValueReference reference = work_limit();
    CALL(host, SetInteger, host->component, &reference, 1, &steps);
}

static void set_integer(Fuzz *f, Host *host)
{
    const fmi2ValueReference reference = settable_reference(&f->bytes);
    const double wanted = value_for(reference, &f->bytes);
    fmi2Integer value = fabs(wanted) < 1e9 ? (fmi2Integer)wanted : (fmi2Integer)take(&f->bytes, 4);
    if (reference == work_limit() && (value > MOST_STEPS || value == 0) &&
        value <= (fmi2Integer)variable_named("solver.max_steps")->max)
        value = MOST_STEPS;
    CALL(host, SetInteger, host->component, &reference, 1, chance(&f->bytes, 4) ? NULL : &value);
}

static void set_other(Fuzz *f, Host *host)
{
    const fmi2ValueReference reference = any_reference(&f->bytes);
    const fmi2Boolean boolean = 1;
    const fmi2String text = "";
    const size_t n = choose(&f->bytes, 2);
    if (chance(&f->bytes, 128))
        CALL(host, SetBoolean, host->component, &reference, n, &boolean);
    else
        CALL(host, SetString, host->component, &reference, n, &text);
}

static void set_up(Fuzz *f, Host *host)
{
    const bool odd = chance(&f->bytes, 40);
    const double tolerance = odd ? any_double(&f->bytes) : pow(10.0, -1.5 - 6.0 * uniform(&f->bytes));
    const double start = odd ? any_double(&f->bytes) : 0.0, stop = odd ? any_double(&f->bytes) : 1.0;
    const bool has_stop = chance(&f->bytes, 128);
    if (CALL(host, SetupExperiment, host->component, chance(&f->bytes, 128), tolerance, start, has_stop,
             stop) == fmi2OK) {
        host->time = start;
        host->stop = has_stop ? stop : INFINITY;
    }
}

static void start(Fuzz *f, Host *host)
{
    limit_work(host, 10 + (fmi2Integer)choose(&f->bytes, 60));
    CALL(host, EnterInitializationMode, host->component);
    CALL(host, ExitInitializationMode, host->component);
}

static void enter(Fuzz *f, Host *host)
{
    (void)f;
    limit_work(host, MOST_STEPS);
    CALL(host, EnterInitializationMode, host->component);
}

static void leave(Fuzz *f, Host *host)
{
    (void)f;
    CALL(host, ExitInitializationMode, host->component);
}

static void do_step(Fuzz *f, Host *host)
{
    const bool odd = chance(&f->bytes, 12);
    const double step = odd ? any_double(&f->bytes) : pow(10.0, -9.0 + 5.0 * uniform(&f->bytes));
    const double point = odd && chance(&f->bytes, 128) ? any_double(&f->bytes) : host->time;
    static const int modes[] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
    const int mode = modes[choose(&f->bytes, 4)];
    fesetround(mode);
    const fmi2Status status = CALL(host, DoStep, host->component, point, step, chance(&f->bytes, 128));
    const int kept = fegetround();
    fesetround(FE_TONEAREST);
    REQUIRE(kept == mode);
    if (status <= fmi2Warning) host->time = point + step;
    if (status != fmi2Discard) return;
    double reached = NAN;
    fmi2Boolean terminated = 0;
    REQUIRE(CALL(host, GetRealStatus, host->component, fmi2LastSuccessfulTime, &reached) == fmi2OK);
    REQUIRE(CALL(host, GetBooleanStatus, host->component, fmi2Terminated, &terminated) == fmi2OK);
    REQUIRE(terminated && reached >= point - 1e-6 * step && reached <= point + step * (1.0 + 1e-6));
    check_outputs(host);
}

static void steps(Fuzz *f, Host *host)
{
    for (unsigned n = choose(&f->bytes, 16); n > 0; n--) {
        if (CALL(host, DoStep, host->component, host->time, 2e-6, 1) > fmi2Warning) return;
        host->time += 2e-6;
    }
}

static void outputs(Fuzz *f, Host *host)
{
    double time;
    const fmi2ValueReference reference = 0;
    (void)f;
    if (CALL(host, GetReal, host->component, &reference, 1, &time) != fmi2OK) return;
    for (const Variable *v = VARIABLES; v < VARIABLES + N_VARIABLES; v++) {
        if (v->causality != CAUSALITY_OUTPUT) continue;
        fmi2ValueReference all[Z];
        double values[Z];
        for (int i = 0; i < v->count; i++) all[i] = v->value_reference + (unsigned)i;
        const fmi2Status status = CALL(host, GetReal, host->component, all, (size_t)v->count, values);
        for (int i = 0; i < v->count && status == fmi2OK; i++) REQUIRE(isfinite(values[i]));
        if (status > fmi2OK) return;
    }
}

static void terminate(Fuzz *f, Host *host)
{
    (void)f;
    CALL(host, Terminate, host->component);
}

static void reset(Fuzz *f, Host *host)
{
    (void)f;
    if (CALL(host, Reset, host->component) != fmi2OK) return;
    host->time = 0.0;
    host->stop = INFINITY;
    host->refused = false;
}

static void debug_logging(Fuzz *f, Host *host)
{
    static const fmi2String names[] = {"logEvents", "logSolver",          "logStatusError",
                                       "logAll",    "nonsense %s%n #r1#", NULL};
    fmi2String categories[3];
    const size_t n = choose(&f->bytes, 4);
    for (size_t i = 0; i < n; i++) categories[i] = names[choose(&f->bytes, 6)];
    CALL(host, SetDebugLogging, host->component, chance(&f->bytes, 128), n,
         chance(&f->bytes, 16) ? NULL : categories);
}

static void get_state(Fuzz *f, Host *host)
{
    const bool null = chance(&f->bytes, 8);
    CALL(host, GetFMUstate, host->component, null ? NULL : &f->states[choose(&f->bytes, STATES)]);
}

static void set_state(Fuzz *f, Host *host)
{
    const fmi2FMUstate state = f->states[choose(&f->bytes, STATES)];
    const fmi2ValueReference reference = 0;
    if (CALL(host, SetFMUstate, host->component, state) != fmi2OK) return;
    double time;
    host->refused = false;
    if (fmi2GetReal(host->component, &reference, 1, &time) == fmi2OK) host->time = time;
}

static void free_state(Fuzz *f, Host *host)
{
    fmi2FMUstate *state = &f->states[choose(&f->bytes, STATES)];
    if (CALL(host, FreeFMUstate, host->component, chance(&f->bytes, 8) ? NULL : state) == fmi2OK) return;
}

// Serialized, changed somewhere or cut short, and taken back.
static void serialize(Fuzz *f, Host *host)
{
    const fmi2FMUstate state = f->states[choose(&f->bytes, STATES)];
    size_t size = 0;
    if (CALL(host, SerializedFMUstateSize, host->component, state, &size) != fmi2OK) return;
    const size_t room = chance(&f->bytes, 32) ? size - 1 - choose(&f->bytes, 200) : size;
    fmi2Byte *bytes = malloc(room);
    const bool written = CALL(host, SerializeFMUstate, host->component, state, bytes, room) == fmi2OK;
    REQUIRE(written == (room == size));
    if (written) {
        fmi2FMUstate copy = NULL;
        const unsigned damage = choose(&f->bytes, 4);
        size_t length = size;
        bool damaged = damage == 1 || damage == 2;
        if (damage == 1) bytes[take(&f->bytes, 4) % size] ^= (fmi2Byte)(1 << choose(&f->bytes, 8));
        if (damage == 2) length = take(&f->bytes, 4) % size;
        fmi2Byte *exact = malloc(length + 1);
        memcpy(exact, bytes, length);
        const fmi2Status status = CALL(host, DeSerializeFMUstate, host->component, exact, length, &copy);
        REQUIRE(damaged == (status != fmi2OK) && damaged == (copy == NULL));
        if (copy && chance(&f->bytes, 128)) CALL(host, SetFMUstate, host->component, copy);
        if (copy) fmi2FreeFMUstate(host->component, &copy);
        free(exact);
    }
    free(bytes);
}

static void garbage_state(Fuzz *f, Host *host)
{
    fmi2Byte bytes[300];
    fmi2FMUstate state = NULL;
    const size_t n = choose(&f->bytes, sizeof bytes);
    for (size_t i = 0; i < n; i++) bytes[i] = (fmi2Byte)take(&f->bytes, 1);
    REQUIRE(CALL(host, DeSerializeFMUstate, host->component, chance(&f->bytes, 16) ? NULL : bytes, n,
                 &state) == fmi2Error);
    REQUIRE(state == NULL);
}

static void get_status(Fuzz *f, Host *host)
{
    const fmi2StatusKind kind = (fmi2StatusKind)choose(&f->bytes, 5);
    const bool null = chance(&f->bytes, 8);
    fmi2Status status;
    fmi2Real real;
    fmi2Integer integer;
    fmi2Boolean boolean;
    fmi2String text = NULL;
    switch (choose(&f->bytes, 5)) {
    case 0: CALL(host, GetStatus, host->component, kind, null ? NULL : &status); break;
    case 1: CALL(host, GetRealStatus, host->component, kind, null ? NULL : &real); break;
    case 2: CALL(host, GetIntegerStatus, host->component, kind, null ? NULL : &integer); break;
    case 3: CALL(host, GetBooleanStatus, host->component, kind, null ? NULL : &boolean); break;
    default:
        if (CALL(host, GetStringStatus, host->component, kind, null ? NULL : &text) == fmi2OK)
            REQUIRE(text && strlen(text) < 2048);
    }
}

static void derivatives(Fuzz *f, Host *host)
{
    fmi2ValueReference unknowns[MAX_VALUES], knowns[MAX_VALUES];
    fmi2Integer orders[MAX_VALUES] = {0};
    fmi2Real values[MAX_VALUES] = {0}, seeds[MAX_VALUES];
    const size_t n = some(&f->bytes), m = some(&f->bytes);
    for (size_t i = 0; i < n; i++)
        unknowns[i] = any_reference(&f->bytes), orders[i] = (fmi2Integer)choose(&f->bytes, 4),
        values[i] = any_double(&f->bytes);
    for (size_t i = 0; i < m; i++) {
        knowns[i] = chance(&f->bytes, 128) ? 1 + choose(&f->bytes, 10) : any_reference(&f->bytes);
        seeds[i] = chance(&f->bytes, 200) ? 1.0 : any_double(&f->bytes);
    }
    const bool null = chance(&f->bytes, 8);
    switch (choose(&f->bytes, 3)) {
    case 0:
        CALL(host, SetRealInputDerivatives, host->component, null ? NULL : knowns, m, orders, values);
        break;
    case 1:
        CALL(host, GetRealOutputDerivatives, host->component, unknowns, n, null ? NULL : orders, values);
        break;
    default:
        CALL(host, GetDirectionalDerivative, host->component, unknowns, n, knowns, m, seeds,
             null ? NULL : values);
    }
}

static void model_exchange(Fuzz *f, Host *host)
{
    double x[4] = {0.0};
    fmi2Boolean b[2];
    fmi2EventInfo info;
    fmi2Component c = host->component;
    switch (choose(&f->bytes, 11)) {
    case 0: CALL(host, EnterEventMode, c); break;
    case 1: CALL(host, NewDiscreteStates, c, &info); break;
    case 2: CALL(host, EnterContinuousTimeMode, c); break;
    case 3: CALL(host, CompletedIntegratorStep, c, 1, &b[0], &b[1]); break;
    case 4: CALL(host, SetTime, c, any_double(&f->bytes)); break;
    case 5: CALL(host, SetContinuousStates, c, x, 4); break;
    case 6: CALL(host, GetDerivatives, c, x, 4); break;
    case 7: CALL(host, GetEventIndicators, c, x, 4); break;
    case 8: CALL(host, GetContinuousStates, c, x, 4); break;
    case 9: CALL(host, GetNominalsOfContinuousStates, c, x, 4); break;
    default: CALL(host, CancelStep, c);
    }
}

static void without_component(Fuzz *f, Host *host)
{
    (void)host;
    Host nobody = {0};
    double value;
    const fmi2ValueReference reference = any_reference(&f->bytes);
    REQUIRE(CALL(&nobody, DoStep, NULL, 0.0, 1e-6, 1) == fmi2Error);
    REQUIRE(CALL(&nobody, GetReal, NULL, &reference, 1, &value) == fmi2Error);
    REQUIRE(CALL(&nobody, Reset, NULL) == fmi2Error);
    fmi2FreeInstance(NULL);
    derivatives(f, &nobody);
    get_status(f, &nobody);
    model_exchange(f, &nobody);
}

static void renew(Fuzz *f, Host *host)
{
    fmi2FreeInstance(host->component);
    if (chance(&f->bytes, 10)) new_instance(host, &f->bytes, true);
    new_instance(host, &f->bytes, false);
}

// ---- a reset instance is as a new one ---------------------------------------------------------------------
static unsigned char *run_state(Host *host, size_t *size)
{
    fmi2FMUstate state = NULL;
    limit_work(host, MOST_STEPS);
    REQUIRE(CALL(host, SetupExperiment, host->component, 0, 0.0, 0.0, 0, 0.0) == fmi2OK);
    REQUIRE(CALL(host, EnterInitializationMode, host->component) == fmi2OK);
    REQUIRE(CALL(host, ExitInitializationMode, host->component) == fmi2OK);
    REQUIRE(CALL(host, DoStep, host->component, 0.0, 2e-5, 1) == fmi2OK);
    host->time = 2e-5;
    REQUIRE(CALL(host, GetFMUstate, host->component, &state) == fmi2OK);
    REQUIRE(CALL(host, SerializedFMUstateSize, host->component, state, size) == fmi2OK);
    unsigned char *bytes = malloc(*size);
    REQUIRE(CALL(host, SerializeFMUstate, host->component, state, (fmi2Byte *)bytes, *size) == fmi2OK);
    REQUIRE(CALL(host, FreeFMUstate, host->component, &state) == fmi2OK);
    return bytes;
}

static unsigned char *new_run_state;  // of a new instance
static size_t new_run_size;

static void remember_new_run(void)
{
    Host fresh = {0};
    const fmi2CallbackFunctions functions = {.logger = logger, .componentEnvironment = &fresh};
    fresh.component = fmi2Instantiate("fresh", fmi2CoSimulation, MODEL_GUID, NULL, &functions, 0, 0);
    new_run_state = run_state(&fresh, &new_run_size);
    fmi2FreeInstance(fresh.component);
}

static void compare_run(Fuzz *f, Host *host)
{
    size_t size;
    reset(f, host);
    unsigned char *bytes = run_state(host, &size);
    REQUIRE(size == new_run_size && memcmp(bytes, new_run_state, size) == 0);
    free(bytes);
    runs_compared++;
}

// ---- one string -------------------------------------------------------------------------------------------
typedef void Action(Fuzz *, Host *);
static Action *const ACTIONS[] = {
    get_real,      get_real,      get_real,       get_integer,
    get_integer,   get_other,     set_real,       set_real,
    set_real,      set_input,     set_input,      set_input,
    set_input,     set_integer,   set_other,      set_up,
    start,         start,         start,          enter,
    leave,         do_step,       do_step,        do_step,
    do_step,       steps,         steps,          outputs,
    terminate,     reset,         reset,          reset,
    get_state,     set_state,     free_state,     serialize,
    garbage_state, debug_logging, get_status,     get_status,
    derivatives,   derivatives,   model_exchange, without_component,
    renew,         compare_run,
};

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    Fuzz f = {.bytes = {data, data + size}};
    if (new_run_state == NULL) remember_new_run();
    for (int i = 0; i < INSTANCES; i++) renew(&f, &f.hosts[i]);
    while (f.bytes.next < f.bytes.end) {
        Host *host = &f.hosts[choose(&f.bytes, INSTANCES)];
        if (host->refused && chance(&f.bytes, 160)) reset(&f, host);
        ACTIONS[choose(&f.bytes, sizeof ACTIONS / sizeof ACTIONS[0])](&f, host);
    }
    for (int s = 0; s < STATES; s++) {
        if (CALL(&f.hosts[0], Reset, f.hosts[0].component) == fmi2OK)
            fmi2FreeFMUstate(f.hosts[0].component, &f.states[s]);
    }
    for (int i = 0; i < INSTANCES; i++) fmi2FreeInstance(f.hosts[i].component);
    return 0;
}

#ifdef STANDALONE
// splitmix64
static uint64_t random_word(uint64_t *state)
{
    uint64_t z = (*state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

typedef struct {
    long wanted, strings, calls, counts[N_STATUS], steps_done, runs_compared;
    uint64_t seed;
} Share;

static void *run_share(void *argument)
{
    Share *share = argument;
    while (calls < share->wanted) {
        uint64_t words[256];
        string_seed = share->seed;
        for (int i = 0; i < 256; i++) words[i] = random_word(&share->seed);
        LLVMFuzzerTestOneInput((const uint8_t *)words, sizeof words);
        share->strings++;
    }
    share->calls = calls;
    share->steps_done = steps_done;
    share->runs_compared = runs_compared;
    memcpy(share->counts, counts, sizeof counts);
    return NULL;
}

int main(int argc, char **argv)
{
    enum { MAX_THREADS = 16 };

    const long wanted = argc > 1 ? atol(argv[1]) : 100000;
    const uint64_t seed = argc > 2 ? strtoull(argv[2], NULL, 10) : 1;
    const int threads = argc > 3 ? atoi(argv[3]) : 1;
    Share share[MAX_THREADS] = {{0}}, all = {0};
    pthread_t thread[MAX_THREADS];
    if (threads < 1 || threads > MAX_THREADS) return 2;
    remember_new_run();
    for (int i = 0; i < threads; i++) {
        share[i] = (Share){.wanted = wanted, .seed = seed + (uint64_t)i};
        if (pthread_create(&thread[i], NULL, run_share, &share[i]) != 0) return 3;
    }
    for (int i = 0; i < threads; i++) {
        pthread_join(thread[i], NULL);
        all.calls += share[i].calls, all.strings += share[i].strings, all.steps_done += share[i].steps_done,
            all.runs_compared += share[i].runs_compared;
        for (int status = 0; status < N_STATUS; status++) all.counts[status] += share[i].counts[status];
    }
    free(new_run_state);
    printf("%ld calls in %ld strings: %ld OK, %ld warning, %ld discard, %ld error; %ld steps done; "
           "%ld reset runs equal to a fresh one\n",
           all.calls, all.strings, all.counts[fmi2OK], all.counts[fmi2Warning], all.counts[fmi2Discard],
           all.counts[fmi2Error], all.steps_done, all.runs_compared);
    return 0;
}
#endif
