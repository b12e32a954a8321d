// Forged states: serialized states with changed content and a checksum that is right again.  Each is refused
// with a reason, or it is taken and then
//
//   the instance has exactly these values: serialized again, it gives the forged bytes
//   all outputs are numbers, before and after a step; the step ends with fmi2OK, fmi2Warning, fmi2Discard or an error with its reason
//   the same step from the same bytes gives the same bytes
//
// forge_states COUNT [SEED]   forges COUNT states at random from those of many scenes and phases, and prints what became of them.
// forge_states fields [all]   (bearing) every index, enumeration, depth, count, phase and time in turn beyond its range, and no number in the place of each
//                             number, each in another one of the states, or in all: all are refused.  Prints how many.
#include "instance/part.h"

#include "fmi2Functions.h"
#if defined(BEARING)
#include "instance/instance.h"
#else
#include "numbers/variable_table.h"
#endif

#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define REQUIRE(condition) require(condition, #condition, __LINE__)

static const char *doing = "nothing";
static uint64_t seed_of_this;  // forged state

static void require(bool condition, const char *text, int line)
{
    if (condition) return;
    fprintf(stderr, "forge_states.c:%d: violated at %s: %s\nforge_states 1 %" PRIu64 " repeats it\n", line,
            doing, text, seed_of_this);
    abort();
}

// ---- a host ---------------------------------------------------------------------------------------------------------------------------------------
static long errors;
static char last_error[2048];

static void logger(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status,
                   fmi2String category, fmi2String message, ...)
{
    (void)environment, (void)instance, (void)category;
    if (status == fmi2Error) snprintf(last_error, sizeof last_error, "%s", message);
    errors += status == fmi2Error;
}

static fmi2Component new_instance(void)
{
    static const fmi2CallbackFunctions functions = {.logger = logger};
    fmi2Component c = fmi2Instantiate("forger", fmi2CoSimulation, MODEL_GUID, "", &functions, 0, 0);
    REQUIRE(c != NULL);
    return c;
}

// ---- serialized states ----------------------------------------------------------------------------------------------------------------------------
enum {
    HEADER = 216,
    CHECKSUM = 208,
    MOST_STATES = 32
};  // bytes before the content, the last eight of them the checksum

static size_t size;  // of each
static unsigned char *states[MOST_STATES];
static int n_states;

static unsigned char *serialized(fmi2Component c)
{
    fmi2FMUstate state = NULL;
    REQUIRE(fmi2GetFMUstate(c, &state) == fmi2OK && fmi2SerializedFMUstateSize(c, state, &size) == fmi2OK);
    unsigned char *bytes = malloc(size);
    REQUIRE(bytes && fmi2SerializeFMUstate(c, state, (char *)bytes, size) == fmi2OK &&
            fmi2FreeFMUstate(c, &state) == fmi2OK);
    return bytes;
}

static void seal(unsigned char *bytes)
{
    uint64_t hash = 0xcbf29ce484222325u, word;
    for (size_t i = HEADER; i < size; i += 8) {
        memcpy(&word, bytes + i, 8);
        hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    }
    memcpy(bytes + CHECKSUM, &hash, sizeof hash);
}

static void keep(fmi2Component c)
{
    REQUIRE(n_states < MOST_STATES);
    states[n_states++] = serialized(c);
}

typedef struct {
    const char *name;
    double value;
} Setting;

static void set(fmi2Component c, const Setting *settings)
{
    for (; settings->name; settings++) {
        const Variable *v = variable_named(settings->name);
        if (!v || v->causality == CAUSALITY_OUTPUT) continue;  // of the other part
        const fmi2Integer integer = (fmi2Integer)settings->value;
        REQUIRE((v->type == TYPE_REAL ? fmi2SetReal(c, &v->value_reference, 1, &settings->value)
                                      : fmi2SetInteger(c, &v->value_reference, 1, &integer)) == fmi2OK);
    }
}

static const Setting WORK_LIMIT[] = {{"solver.max_steps", 2000.0}, {NULL, 0.0}};

static void start(fmi2Component c, const Setting *settings)
{
    REQUIRE(fmi2Reset(c) == fmi2OK && fmi2SetupExperiment(c, 0, 0.0, 0.25, 1, 2.0) == fmi2OK);
    set(c, WORK_LIMIT);
    set(c, settings);
    REQUIRE(fmi2EnterInitializationMode(c) == fmi2OK && fmi2ExitInitializationMode(c) <= fmi2Warning);
}

static double step(fmi2Component c, double time, double h, int n)
{
    for (; n > 0; n--, time += h) REQUIRE(fmi2DoStep(c, time, h, 1) <= fmi2Warning);
    return time;
}

// States of all phases and scenes.
static void gather(void)
{
    static const Setting scenes[][6] = {
        {{NULL, 0.0}},
        {{"scene.stress", 4.0}, {"start.settle", 0.0}, {"joint.preload", 0.0}, {NULL, 0.0}},
        {{"solver.method", 2.0}, {"scene.lubrication", 2.0}, {NULL, 0.0}},
        {{"scene.cage", 3.0}, {NULL, 0.0}},
        {{"scene.cage", 1.0},
         {"scene.traction", 2.0},
         {"ring.tilt_mode", 3.0},
         {"pulse.F_r", 1401.0},
         {"pulse.t_start", 0.2501},
         {NULL, 0.0}},
        {{"ring.tilt_mode", 2.0},
         {"scene.statistics", 2.0},
         {"start.settle", 0.0},
         {"shaft.omega", 400.0},
         {NULL, 0.0}},
    };
    fmi2Component c = new_instance();
    set(c, WORK_LIMIT);
    keep(c);  // instantiated
    REQUIRE(fmi2EnterInitializationMode(c) == fmi2OK);
    keep(c);
    const fmi2ValueReference input = 1, output = 2001;
    const fmi2Integer order = 1;
    double value;
    const fmi2Real rate = 100.0, wrong = NAN;
    REQUIRE(fmi2GetReal(c, &output, 1, &value) == fmi2OK);
    keep(c);  // its outputs have been read
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        start(c, scenes[i]);
        keep(c);
        const double time = step(c, 0.25, 1e-4, 7);
        keep(c);
        REQUIRE(fmi2SetRealInputDerivatives(c, &input, 1, &order, &rate) == fmi2OK);
        keep(c);
        step(c, time, 3e-5, 2);
    }
    REQUIRE(fmi2Terminate(c) == fmi2OK);
    keep(c);
    start(c, scenes[0]);
    REQUIRE(fmi2SetReal(c, &input, 1, &wrong) == fmi2Error);
    keep(c);  // after an error
#if defined(BEARING)
    start(c, (const Setting[]){{"solver.max_steps", 20.0}, {NULL, 0.0}});
    REQUIRE(fmi2DoStep(c, 0.25, 0.01, 1) == fmi2Discard);
    keep(c);  // after a step that was given up
#endif
    fmi2FreeInstance(c);
}

// ---- what becomes of a forged state -----------------------------------------------------------------------------------------------------------------
typedef enum { REFUSED, KEPT, STEPPED, DISCARDED, STOPPED, N_FATES } Fate;

static void outputs_are_numbers(fmi2Component c)
{
    for (const Variable *v = VARIABLES; v < VARIABLES + N_VARIABLES; v++) {
        if (v->causality != CAUSALITY_OUTPUT) continue;
        for (int i = 0; i < v->count; i++) {
            const fmi2ValueReference reference = v->value_reference + (unsigned)i;
            double value = NAN;
            doing = v->name;
            REQUIRE(fmi2GetReal(c, &reference, 1, &value) <= fmi2Warning);
            REQUIRE(isfinite(value));
        }
    }
}

static bool restore(fmi2Component c, const unsigned char *forged)
{
    fmi2FMUstate state = NULL;
    const long before = errors;
    if (fmi2DeSerializeFMUstate(c, (const char *)forged, size, &state) != fmi2OK) {
        REQUIRE(errors > before && state == NULL && strlen(last_error) > 20);
        REQUIRE(fmi2Reset(c) == fmi2OK);
        return false;
    }
    REQUIRE(fmi2SetFMUstate(c, state) == fmi2OK && fmi2FreeFMUstate(c, &state) == fmi2OK);
    return true;
}

static uint32_t phase_of(const unsigned char *bytes)
{
    uint32_t phase;
    memcpy(&phase, bytes + HEADER, sizeof phase);
    return phase;
}

static fmi2Status one_step(fmi2Component c)
{
    double time;
    REQUIRE(fmi2GetRealStatus(c, fmi2LastSuccessfulTime, &time) == fmi2OK);
    const double spacing = nextafter(fabs(time), INFINITY) - fabs(time);
    return fmi2DoStep(c, time, fmax(1e-6, 64.0 * spacing), 1);
}

static Fate fate_of(fmi2Component c, const unsigned char *forged)
{
    enum { INITIALIZING = 2, STEPPING = 4, FAILED = 8, TERMINATED = 16, ERRONEOUS = 32 };

    doing = "restoring";
    if (!restore(c, forged)) return REFUSED;
    unsigned char *again = serialized(c);
    REQUIRE(memcmp(again, forged, size) == 0);
    free(again);
    const uint32_t phase = phase_of(forged);
    if (phase & (STEPPING | FAILED | TERMINATED)) outputs_are_numbers(c);
    doing = "going on";
    if (phase & (1 | INITIALIZING)) {
        if (phase & 1) REQUIRE(fmi2EnterInitializationMode(c) == fmi2OK);
        const long before = errors;
        const fmi2Status status = fmi2ExitInitializationMode(c);
        REQUIRE(status <= fmi2Warning || (status == fmi2Error && errors > before));
        if (status <= fmi2Warning) outputs_are_numbers(c);
    }
    if (phase != STEPPING) return KEPT;
    const long before = errors;
    const fmi2Status status = one_step(c);
    REQUIRE(status <= fmi2Error && (status <= fmi2Warning || errors > before));
    if (status <= fmi2Discard) outputs_are_numbers(c);
    unsigned char *first = serialized(c);
    REQUIRE(restore(c, forged) && one_step(c) == status);
    unsigned char *second = serialized(c);
    REQUIRE(memcmp(first, second, size) == 0);
    free(first);
    free(second);
    return status <= fmi2Warning ? STEPPED : status == fmi2Discard ? DISCARDED : STOPPED;
}

// ---- forging at random --------------------------------------------------------------------------------------------------------------------------------
static uint64_t seed;

static uint64_t random_word(void)  // splitmix64
{
    uint64_t z = seed += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

static size_t below(size_t n)
{
    return (size_t)(random_word() % n);
}

// Most of a state is statistics: a place in it is chosen from the rest as often as from them.
static size_t place(size_t width)
{
    const size_t content = size - HEADER, first = content < 12000 ? content : 12000;
    const size_t from = below(2) ? 0 : below(2) && content > 24000 ? content - 12000 : 0;
    const size_t span = below(4) == 0 ? content : from + first > content ? content - from : first;
    const size_t base = span == content ? 0 : from;
    return HEADER + base + below(span / width) * width;
}

static void forge_double(unsigned char *bytes)
{
    static const double odd[] = {NAN,    INFINITY, -INFINITY, 0.0,  -0.0, 1.0,   -1.0, 0.5,    1e308,
                                 -1e308, 5e-324,   1e60,      1e61, 1e30, -1e30, 1e15, 1e-300, 1e9};
    unsigned char *at = bytes + place(8);
    double value;
    uint64_t word = random_word();
    memcpy(&value, at, sizeof value);
    switch (below(4)) {
    case 0: value = odd[below(sizeof odd / sizeof odd[0])]; break;
    case 1: memcpy(&value, &word, sizeof value); break;
    case 2: value *= 1.0 + 1e-3 * (double)(int64_t)word / 9.2e18; break;
    default: value = (value + 1e-9) * pow(10.0, 6.0 * (double)(int64_t)word / 9.2e18);
    }
    memcpy(at, &value, sizeof value);
}

static void forge_int(unsigned char *bytes)
{
    static const int odd[] = {0, 1, -1, 2, 3, 4, 5, 8, 16, 32, 64, 127, 128, 129, 1000, INT_MAX, INT_MIN};
    unsigned char *at = bytes + place(4);
    int value = below(3) ? odd[below(sizeof odd / sizeof odd[0])] : (int)(uint32_t)random_word();
    memcpy(at, &value, sizeof value);
}

static void forge_bits(unsigned char *bytes)
{
    bytes[place(1)] ^= (unsigned char)(1u << below(8));
}

// A piece of another state of the same kind of part.
static void forge_piece(unsigned char *bytes)
{
    const unsigned char *other = states[below((size_t)n_states)];
    const size_t at = place(8), most = size - at, n = 8 * (1 + below(64));
    memcpy(bytes + at, other + at, n < most ? n : most);
}

// What bounds the work of a step stays: a forged limit of a billion steps is taken, and means what it says.
static void keep_work_limit(unsigned char *bytes)
{
    const Variable *v = variable_named(WORK_LIMIT->name);
    const int steps = (int)WORK_LIMIT->value;
    if (v) memcpy(bytes + HEADER + 40 + v->offset, &steps, sizeof steps);
}

static void forge(unsigned char *bytes)
{
    static void (*const ways[])(unsigned char *) = {forge_double, forge_double, forge_double,
                                                    forge_int,    forge_bits,   forge_piece};
    memcpy(bytes, states[below((size_t)n_states)], size);
    for (size_t n = 1 + below(below(4) ? 2 : 12); n > 0; n--)
        ways[below(sizeof ways / sizeof ways[0])](bytes);
    keep_work_limit(bytes);
    seal(bytes);
}

static void at_random(long count)
{
    long fates[N_FATES] = {0};
    unsigned char *forged = malloc(size);
    REQUIRE(forged != NULL);
    fmi2Component c = new_instance();
    for (long i = 0; i < count; i++) {
        seed_of_this = seed;
        forge(forged);
        fates[fate_of(c, forged)]++;
        if (i % 64 == 63) {  // what a forged state leaves behind would meet the next one
            fmi2FreeInstance(c);
            c = new_instance();
        }
    }
    fmi2FreeInstance(c);
    free(forged);
    printf("%ld forged: %ld refused, %ld kept, %ld stepped, %ld discarded, %ld stopped\n", count,
           fates[REFUSED], fates[KEPT], fates[STEPPED], fates[DISCARDED], fates[STOPPED]);
}

// ---- every field in turn --------------------------------------------------------------------------------------------------------------------------------
#if defined(BEARING)
enum { SESSION = 40, PART = HEADER + SESSION };  // bytes of the session; where InstanceState begins

static fmi2Component victim;
static bool everywhere;
static long tried, turn;
static unsigned char *forged_field;

// A state that has been stepped, with this value there, is refused; or all such states are.
static void refused(size_t at, const void *value, size_t width, const char *what)
{
    doing = what;
    int left = everywhere ? n_states : 1;
    while (left > 0) {
        const unsigned char *state = states[turn++ % n_states];
        left -= everywhere;
        if (phase_of(state) != 4) continue;
        left -= !everywhere;
        memcpy(forged_field, state, size);
        memcpy(forged_field + at, value, width);
        if (memcmp(forged_field, state, size) == 0) continue;
        seal(forged_field);
        REQUIRE(!restore(victim, forged_field));
        tried++;
    }
}

static void double_refused(size_t at, double value, const char *what)
{
    refused(at, &value, sizeof value, what);
}

static void int_refused(size_t at, int value, const char *what)
{
    refused(at, &value, sizeof value, what);
}

static void range_refused(size_t at, int min, int max, const char *what)
{
    const long long wrong[] = {min - 1LL, max + 1LL, INT_MIN, INT_MAX, min - 1000LL, max + 1000LL};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        const bool is_int = wrong[i] >= INT_MIN && wrong[i] <= INT_MAX;
        if (is_int && (wrong[i] < min || wrong[i] > max)) int_refused(at, (int)wrong[i], what);
    }
}

static void count_refused(size_t at, const char *what)
{
    static const double wrong[] = {-1.0, 0.5, -1e-300, 1e300, 4503599627370498.0};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) double_refused(at, wrong[i], what);
}

static void amount_refused(size_t at, const char *what)
{
    double_refused(at, -1e-9, what);
    double_refused(at, 1e61, what);
}

static void sessions(void)
{
    static const uint32_t phases[] = {0, 3, 5, 6, 7, 12, 63, 64, 65, 127, 128, 1u << 31, UINT32_MAX};
    static const uint64_t statuses[] = {4, 5, 6, 1u << 31, UINT64_MAX};
    for (size_t i = 0; i < sizeof phases / sizeof phases[0]; i++) refused(HEADER, &phases[i], 4, "phase");
    range_refused(HEADER + 4, 0, 1, "session.initialized");
    static const double times[] = {INFINITY, -INFINITY, 1e300, 0.26, 3.0};
    for (size_t i = 0; i < sizeof times / sizeof times[0]; i++)
        double_refused(HEADER + 8, times[i], "start time");
    static const double stops[] = {-INFINITY, 0.2, -1e300};
    for (size_t i = 0; i < sizeof stops / sizeof stops[0]; i++)
        double_refused(HEADER + 16, stops[i], "stop time");
    static const double tolerances[] = {-1.0, 1e-11, 0.2, INFINITY};
    for (size_t i = 0; i < sizeof tolerances / sizeof tolerances[0]; i++)
        double_refused(HEADER + 24, tolerances[i], "tolerance");
    for (size_t i = 0; i < sizeof statuses / sizeof statuses[0]; i++)
        refused(HEADER + 32, &statuses[i], 8, "status");
}

static void variables(void)
{
    for (const Variable *v = VARIABLES; v < VARIABLES + N_VARIABLES; v++) {
        if (v->causality != CAUSALITY_PARAMETER && v->causality != CAUSALITY_INPUT) continue;
        const size_t base =
            PART +
            (v->causality == CAUSALITY_INPUT ? offsetof(InstanceState, u) : offsetof(InstanceState, p)) +
            v->offset;
        for (int i = 0; i < v->count; i++) {
            if (v->type != TYPE_REAL) {
                range_refused(base + (size_t)i * sizeof(int), (int)v->min, (int)v->max, v->name);
                continue;
            }
            double_refused(base + (size_t)i * sizeof(double), nextafter(v->min, -INFINITY), v->name);
            double_refused(base + (size_t)i * sizeof(double), nextafter(v->max, INFINITY), v->name);
        }
    }
}

#define AT(member) (PART + offsetof(InstanceState, member))

static void steps_and_times(void)
{
    static const double times[] = {-INFINITY, INFINITY, 0.2, -1.0, 2.1, 1e300};
    for (size_t i = 0; i < sizeof times / sizeof times[0]; i++)
        double_refused(AT(integrator.t), times[i], "time");
    static const double starts[] = {-INFINITY, INFINITY, 1.0, 1e300};
    for (size_t i = 0; i < sizeof starts / sizeof starts[0]; i++)
        double_refused(AT(t_start), starts[i], "t_start");
    double_refused(AT(integrator.h), 0.0, "step size");
    amount_refused(AT(integrator.h), "step size");
    amount_refused(AT(integrator.now.h), "last step size");
    amount_refused(AT(integrator.now.ratio), "ratio of the last step");
    double_refused(AT(integrator.now.ratio), 18.0,
                   "ratio of the last step");  // an error of 1e-4 or less gives 17.2
    range_refused(AT(integrator.f_is_current), 0, 1, "f_is_current");
    count_refused(AT(integrator.steps), "steps");
    count_refused(AT(integrator.rhs_evals), "evaluations");
    count_refused(AT(integrator.error_tests_failed), "failed tests");
    double_refused(AT(tolerance), 0.0, "tolerance in force");
    double_refused(AT(tolerance), 0.2, "tolerance in force");
    range_refused(AT(initialized), 1, 1, "initialized");
    range_refused(AT(history.steps), 0, 2, "steps of the given motion");
    amount_refused(AT(history.h), "length of the step before");
}

static void records(void)
{
    amount_refused(AT(force_peak), "force peak");
    amount_refused(AT(duty_time), "duty time");
    range_refused(AT(end.force_known), 0, 1, "force_known");
    range_refused(AT(end.stress_known), 0, 1, "stress_known");
    for (size_t j = 0; j < Z; j++) amount_refused(AT(end.force) + 8 * j, "force of the last end");
    for (size_t k = 0; k < Z; k++) {
        amount_refused(AT(head_peak) + 8 * k, "head peak");
        amount_refused(AT(mid_peak) + 8 * k, "middle peak");
        const size_t channels[] = {AT(fatigue_head) + k * sizeof(FatigueChannel),
                                   AT(fatigue_mid) + k * sizeof(FatigueChannel)};
        for (int i = 0; i < 2; i++) {
            range_refused(channels[i] + offsetof(FatigueChannel, depth), 0, FATIGUE_DEPTH, "depth");
            range_refused(channels[i] + offsetof(FatigueChannel, direction), -1, 1, "direction");
            range_refused(channels[i] + offsetof(FatigueChannel, samples), 0, 1, "samples");
            int_refused(channels[i] + offsetof(FatigueChannel, dropped), -1, "dropped");
            int_refused(channels[i] + offsetof(FatigueChannel, dropped), INT_MIN, "dropped");
            amount_refused(channels[i] + offsetof(FatigueChannel, damage), "damage");
        }
    }
    for (size_t at = AT(force); at < AT(fatigue_head); at += sizeof(StatisticsChannel)) {
        amount_refused(at + offsetof(StatisticsChannel, time), "time of statistics");
        for (size_t bin = 0; bin < STATISTICS_BINS; bin += 97)
            amount_refused(at + offsetof(StatisticsChannel, weight) + 8 * bin, "weight");
    }
    range_refused(AT(lag.count), 0, MOTIONS, "motions that catch up");
    range_refused(AT(lag.motion), 0, MOTIONS - 1, "motion that catches up");
    for (size_t kind = 0; kind < EVENT_COUNT; kind++) {
        count_refused(AT(event.onsets) + 8 * kind, "onsets");
        range_refused(AT(event.active) + 4 * kind, 0, 1, "active");
    }
}

// Whether an int stands in the eight bytes from here on: no number there would be two ints.
static bool holds_int(size_t at)
{
    for (const Variable *v = VARIABLES; v < VARIABLES + N_VARIABLES; v++) {
        if (v->causality != CAUSALITY_PARAMETER || v->type == TYPE_REAL) continue;
        const size_t bases[] = {offsetof(InstanceState, p), offsetof(InstanceState, p_now)};
        for (int i = 0; i < 2; i++) {
            const size_t first = bases[i] + v->offset, end = first + (size_t)v->count * sizeof(int);
            if (at + 8 > first && at < end) return true;
        }
    }
    static const size_t ints[] = {offsetof(InstanceState, p.given),
                                  offsetof(InstanceState, p_now.given),
                                  offsetof(InstanceState, integrator.f_is_current),
                                  offsetof(InstanceState, initialized),
                                  offsetof(InstanceState, end.force_known),
                                  offsetof(InstanceState, end.stress_known),
                                  offsetof(InstanceState, history.steps),
                                  offsetof(InstanceState, lag.count)};
    for (size_t i = 0; i < sizeof ints / sizeof ints[0]; i++)
        if (at == ints[i] / 8 * 8) return true;
    for (size_t k = 0; k < 2 * Z; k++) {
        const size_t channel = offsetof(InstanceState, fatigue_head) + k * sizeof(FatigueChannel);
        if (at >= channel + offsetof(FatigueChannel, depth) && at < channel + sizeof(FatigueChannel))
            return true;
    }
    return at >= offsetof(InstanceState, event.active) &&
           at < offsetof(InstanceState, event) + sizeof(EventState);
}

static void numbers(void)
{
    long places = 0;
    for (size_t at = 0; at + 8 <= sizeof(InstanceState); at += 8) {
        if (holds_int(at)) continue;
        if (at > offsetof(InstanceState, head) && at < offsetof(InstanceState, fatigue_head) && at / 8 % 61)
            continue;  // bins: 16,000 alike
        double_refused(PART + at, NAN, "no number");
        double_refused(PART + at, -INFINITY, "infinity");
        places++;
    }
    REQUIRE(places > 1500);
}

static void fields(void)
{
    fmi2FMUstate state = NULL;
    victim = new_instance();
    REQUIRE(size == PART + sizeof(InstanceState));
    forged_field = malloc(size);
    REQUIRE(forged_field && fmi2GetFMUstate(victim, &state) == fmi2OK &&
            fmi2FreeFMUstate(victim, &state) == fmi2OK);
    sessions();
    variables();
    steps_and_times();
    records();
    numbers();
    fmi2FreeInstance(victim);
    free(forged_field);
    printf("%ld fields out of range, all refused\n", tried);
}
#endif

int main(int count, char **argument)
{
    if (count < 2) return 2;
    gather();
    for (int i = 0; i < n_states; i++) {  // unforged ones are taken
        fmi2Component c = new_instance();
        REQUIRE(restore(c, states[i]));
        fmi2FreeInstance(c);
    }
#if defined(BEARING)
    if (strcmp(argument[1], "fields") == 0) {
        everywhere = count > 2;
        fields();
    } else
#endif
    {
        seed = count > 2 ? strtoull(argument[2], NULL, 10) : 1;
        at_random(atol(argument[1]));
    }
    for (int i = 0; i < n_states; i++) free(states[i]);
    return 0;
}
