// A part (part.h) as an FMI 2.0 co-simulation slave: call order, value references, host time, logging, saved
// states.  No physics.
//
// A function that returns fmi2Error changes only the instance's phase (fmi2_calls.h).  It stays ERRONEOUS until
// fmi2Reset or fmi2SetFMUstate (FMI 2.0.4, section 2.1.3), and its outputs read NaN with fmi2Warning,
// so that a host which ignores the status shows no plausible result.
// fmi2Discard comes with fmi2Terminated and fmi2LastSuccessfulTime; the outputs then are those of the last good state.
#include "instance/part.h"

#include "fmi2Functions.h"
#include "host/build_info.h"
#include "host/float_environment.h"
#include "host/fmi2_calls.h"
#include "numbers/saved_numbers.h"

#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// ---- call order ---------------------------------------------------------------------------------------------------------------------------
#define CALL_OF(name, phases, parameters, arguments) CALL_##name,
#define NAME_AND_PHASES(name, phases, parameters, arguments) {"fmi2" #name, phases},
#define PROTOTYPE(name, phases, parameters, arguments) static fmi2##name##TYPE name __attribute__((noinline));

typedef enum { FMI2_CALLS(CALL_OF) } Call;

static const struct {
    const char *name;
    unsigned phases;
} CALLS[] = {FMI2_CALLS(NAME_AND_PHASES)};

// What the exported functions call; not inlined, so that no arithmetic moves out of the floating-point
// environment that they make.
FMI2_CALLS(PROTOTYPE)

static const char *phase_name(uint32_t phase)
{
    return phase == INSTANTIATED   ? "instantiated"
           : phase == INITIALIZING ? "initialization mode"
           : phase == STEPPING     ? "step complete"
           : phase == FAILED       ? "step failed"
           : phase == TERMINATED   ? "terminated"
                                   : "error";
}

// ---- instance -----------------------------------------------------------------------------------------------------------------------------
typedef struct {
    uint32_t phase;        // Phase
    uint32_t initialized;  // in initialization mode: the start belongs to the present parameters and inputs
    double start_time;     // [s]
    double stop_time;      // [s], infinite if none
    double tolerance;      // 0: solver.tol
    uint64_t step_status;  // fmi2Status of the last step
} Session;                 // what the saved state holds beside the part

typedef struct {
    Part *part;
    Session session;
    PartHost host;
    FloatEnvironment *host_floats;  // during a call: the host's floating-point environment
    fmi2CallbackFunctions callbacks;
    char *name;
    unsigned categories;  // that are sent: bits 1 << LogCategory
    char message[512];    // the last error or warning, sent or not
    bool warned_of_clock;
} Instance;

static const Session NEW_SESSION = {.phase = INSTANTIATED, .stop_time = INFINITY};

// In the order of LogCategory.  Without logging, only the reason of fmi2Error or fmi2Discard is sent.
static const char *const CATEGORIES[] = {"logStatusError", "logStatusWarning", "logEvents", "logSolver"};

enum { N_CATEGORIES = sizeof CATEGORIES / sizeof CATEGORIES[0], ALL_CATEGORIES = (1 << N_CATEGORIES) - 1 };

enum { ALWAYS_SENT = 1 << LOG_ERROR };

// Hosts read the message as a printf format and '#' as the start of a value reference: both are doubled.  The
// logger runs in the host's floating-point environment; what it leaves is what the host has from then on.
static void send(const fmi2CallbackFunctions *callbacks, FloatEnvironment *host_floats, const char *instance,
                 LogCategory category, const char *message)
{
    static const fmi2Status STATUS[] = {fmi2Error, fmi2Warning, fmi2OK, fmi2OK};
    if (!callbacks->logger) return;
    char escaped[1024];
    size_t n = 0;
    for (; *message && n + 3 < sizeof escaped; message++) {
        if (*message == '%' || *message == '#') escaped[n++] = *message;
        escaped[n++] = *message;
    }
    escaped[n] = '\0';
    float_leave(host_floats);
    callbacks->logger(callbacks->componentEnvironment, instance, STATUS[category], CATEGORIES[category],
                      escaped);
    float_enter(host_floats);
}

static void instance_log(void *environment, LogCategory category, const char *message)
{
    Instance *m = environment;
    if (category == LOG_ERROR || category == LOG_WARNING)
        snprintf(m->message, sizeof m->message, "%s", message);
    if (m->categories & 1u << category) send(&m->callbacks, m->host_floats, m->name, category, message);
}

static void log_refusal(Instance *m, Call call, const char *format, va_list arguments)
{
    char reason[400], message[512];
    vsnprintf(reason, sizeof reason, format, arguments);
    snprintf(message, sizeof message, "%s at t = %.9g s: %s", CALLS[call].name, part_time(m->part), reason);
    instance_log(m, LOG_ERROR, message);
}

static fmi2Status refuse(Instance *m, Call call, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    log_refusal(m, call, format, arguments);
    va_end(arguments);
    m->session.phase = ERRONEOUS;
    return fmi2Error;
}

// As refuse, for a step that has not begun: the state is untouched, and the host may go on with a right clock.
static fmi2Status refuse_step(Instance *m, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    log_refusal(m, CALL_DoStep, format, arguments);
    va_end(arguments);
    return fmi2Error;
}

// Whether the call is allowed now.
static __attribute__((noinline)) bool enter(fmi2Component c, Call call, FloatEnvironment *host_floats)
{
    Instance *m = c;
    if (!m) return false;
    m->host_floats = host_floats;
    if (m->session.phase & CALLS[call].phases) return true;
    if (m->session.phase != FATAL)
        refuse(m, call, "not allowed in state \"%s\"", phase_name(m->session.phase));
    return false;
}

static __attribute__((noinline)) void refuse_unsupported(fmi2Component c, const char *function,
                                                         FloatEnvironment *host_floats)
{
    Instance *m = c;
    if (!m || m->session.phase == FATAL) return;
    m->host_floats = host_floats;
    char message[128];
    snprintf(message, sizeof message, "%s is not offered by this FMU (see its capability flags)", function);
    instance_log(m, LOG_ERROR, message);
    m->session.phase = ERRONEOUS;
}

// The status of the core as FMI's, with the phase that follows.
static fmi2Status conclude(Instance *m, PartStatus status)
{
    switch (status) {
    case PART_OK: return fmi2OK;
    case PART_WARNING: return fmi2Warning;
    case PART_DISCARD: m->session.phase = FAILED; return fmi2Discard;
    case PART_ERROR: m->session.phase = ERRONEOUS; return fmi2Error;
    case PART_FATAL: break;
    }
    m->session.phase = FATAL;
    return fmi2Fatal;
}

// A new part with the present parameters and inputs.
static void renew(Part *part)
{
    const Parameters parameters = *part_parameters(part);
    Inputs inputs[INPUT_ORDERS + 1];
    for (int order = 0; order <= INPUT_ORDERS; order++) inputs[order] = *part_inputs(part, order);
    part_reset(part);
    *part_parameters(part) = parameters;
    for (int order = 0; order <= INPUT_ORDERS; order++) *part_inputs(part, order) = inputs[order];
}

// The start for the present parameters and inputs: an earlier start, made to read outputs, leaves no trace,
// nor does one that fails. A step cannot be discarded here: there is no last good state.
static fmi2Status instance_initialize(Instance *m)
{
    if (m->session.initialized) return fmi2OK;
    renew(m->part);
    PartStatus status = part_initialize(m->part, m->session.start_time, m->session.tolerance);
    if (status == PART_DISCARD) status = PART_ERROR;
    m->session.initialized = status == PART_OK || status == PART_WARNING;
    if (!m->session.initialized) renew(m->part);
    return conclude(m, status);
}

// Parameters or inputs have changed: in initialization mode the start that outputs were read from is none any more.
static void forget_start(Instance *m)
{
    if (m->session.phase != INITIALIZING || !m->session.initialized) return;
    renew(m->part);
    m->session.initialized = false;
}

// ---- creation and destruction ---------------------------------------------------------------------------------------------------------------
static const char *instantiation_problem(fmi2String name, fmi2Type type, fmi2String guid)
{
    if (!name || !*name) return "fmi2Instantiate: the instance name is empty";
    if (type != fmi2CoSimulation) return "fmi2Instantiate: this FMU offers co-simulation only";
    if (!guid || strcmp(guid, MODEL_GUID) != 0)
        return "fmi2Instantiate: the GUID is not " MODEL_GUID
               ": description and binary do not belong together";
    return NULL;
}

static __attribute__((noinline)) void FreeInstance(fmi2Component c, FloatEnvironment *host_floats)
{
    Instance *m = c;
    if (!m) return;
    m->host_floats = host_floats;
    part_destroy(m->part);
    free(m->name);
    free(m);
}

static __attribute__((noinline)) fmi2Component Instantiate(fmi2String name, fmi2Type type, fmi2String guid,
                                                           const fmi2CallbackFunctions *functions,
                                                           fmi2Boolean logging, FloatEnvironment *host_floats)
{
    if (!functions) return NULL;
    const char *problem = instantiation_problem(name, type, guid);
    Instance *m = problem ? NULL : calloc(1, sizeof *m);
    if (m) {
        m->session = NEW_SESSION;
        m->host = (PartHost){m, instance_log};
        m->host_floats = host_floats;
        m->callbacks = *functions;
        m->categories = logging ? ALL_CATEGORIES : ALWAYS_SENT;
        const size_t size = strlen(name) + 1;
        m->name = malloc(size);
        if (m->name) {
            memcpy(m->name, name, size);
            m->part = part_create(&m->host);
        }
        if (m->part) return m;
        FreeInstance(m, host_floats);
    }
    send(functions, host_floats, name ? name : "", LOG_ERROR,
         problem ? problem : "fmi2Instantiate: out of memory");
    return NULL;
}

// Unknown categories are ignored with a warning.
static fmi2Status SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n, const fmi2String categories[])
{
    Instance *m = c;
    if (n > 0 && !categories) return refuse(m, CALL_SetDebugLogging, "no categories given");
    unsigned chosen = n == 0 ? ALL_CATEGORIES : ALWAYS_SENT;
    fmi2Status status = fmi2OK;
    for (size_t i = 0; i < n; i++) {
        unsigned found = 0;
        for (int k = 0; categories[i] && k < N_CATEGORIES; k++) {
            if (strcmp(categories[i], CATEGORIES[k]) == 0) found = 1u << k;
        }
        if (categories[i] && strcmp(categories[i], "logAll") == 0) found = ALL_CATEGORIES;
        if (!found) {
            char message[200];
            snprintf(message, sizeof message, "fmi2SetDebugLogging: unknown category \"%.60s\"",
                     categories[i] ? categories[i] : "(null)");
            if (on) m->categories |= 1u << LOG_WARNING;
            instance_log(m, LOG_WARNING, message);
            status = fmi2Warning;
        }
        chosen |= found;
    }
    m->categories = on ? chosen : ALWAYS_SENT;
    return status;
}

// ---- initialization and end -----------------------------------------------------------------------------------------------------------------
// A host's tolerance is a hint.  The part uses it within its limits, and its largest tolerance in the place of a larger
// one.  A smaller one, a negative one or none that is a number leaves solver.tol (returned is 0), because with the
// smallest tolerance a run would take a hundred times as long.
static double admissible_tolerance(Instance *m, double tolerance)
{
    const Variable *known = variable_named("solver.tol");
    if (!known) return 0.0;
    if (tolerance >= known->min && tolerance <= known->max) return tolerance;
    const bool above = tolerance > known->max;
    char message[256], place[32] = "solver.tol";
    if (above) snprintf(place, sizeof place, "%.10g", known->max);
    snprintf(message, sizeof message,
             "fmi2SetupExperiment: tolerance = %.10g lies outside [%.10g, %.10g]: %s takes its place",
             tolerance, known->min, known->max, place);
    instance_log(m, LOG_WARNING, message);
    return above ? known->max : 0.0;
}

static fmi2Status SetupExperiment(fmi2Component c, fmi2Boolean tolerance_defined, fmi2Real tolerance,
                                  fmi2Real start_time, fmi2Boolean stop_time_defined, fmi2Real stop_time)
{
    Instance *m = c;
    if (!values_are_within(&start_time, 1, LARGEST_TIME)) {
        return refuse(m, CALL_SetupExperiment, "startTime = %g s is not allowed: it must lie within +-%g s",
                      start_time, LARGEST_TIME);
    }
    if (stop_time_defined && !(stop_time >= start_time)) {
        return refuse(m, CALL_SetupExperiment,
                      "stopTime = %g s is not allowed: it must not lie before startTime = %g s", stop_time,
                      start_time);
    }
    m->session.tolerance = tolerance_defined ? admissible_tolerance(m, tolerance) : 0.0;
    m->session.start_time = start_time;
    m->session.stop_time = stop_time_defined ? stop_time : INFINITY;
    return fmi2OK;
}

static fmi2Status EnterInitializationMode(fmi2Component c)
{
    Instance *m = c;
    m->session.phase = INITIALIZING;
    return fmi2OK;
}

static fmi2Status ExitInitializationMode(fmi2Component c)
{
    Instance *m = c;
    const fmi2Status status = instance_initialize(m);
    if (status <= fmi2Warning) m->session.phase = STEPPING;
    return status;
}

static fmi2Status Terminate(fmi2Component c)
{
    Instance *m = c;
    m->session.phase = TERMINATED;
    return fmi2OK;
}

static fmi2Status Reset(fmi2Component c)
{
    Instance *m = c;
    part_reset(m->part);
    m->session = NEW_SESSION;
    m->message[0] = '\0';
    m->warned_of_clock = false;
    return fmi2OK;
}

// ---- variables ------------------------------------------------------------------------------------------------------------------------------
static bool is_real(const Variable *v)
{
    return v->type == TYPE_REAL;
}

// The variable of a value reference, if it has the right type.
static const Variable *find(Instance *m, Call call, fmi2ValueReference reference, bool real, int *element)
{
    const Variable *v = variable_find(reference, element);
    if (v && is_real(v) == real) return v;
    refuse(m, call, "value reference %u belongs to no %s variable", reference,
           real ? "Real" : "Integer or Enumeration");
    return NULL;
}

static void *storage(Instance *m, const Variable *v)
{
    char *base =
        v->causality == CAUSALITY_INPUT ? (char *)part_inputs(m->part, 0) : (char *)part_parameters(m->part);
    return base + v->offset;
}

// An output, evaluated with its group on first read after a step.
static fmi2Status output_value(Instance *m, const Variable *v, int element, double *value)
{
    fmi2Status status = fmi2OK;
    *value = NAN;
    if (m->session.phase == INITIALIZING) status = instance_initialize(m);
    if (m->session.phase == ERRONEOUS) return status > fmi2OK ? status : fmi2Warning;
    part_update(m->part, v->group);
    *value = ((const double *)((const char *)part_outputs(m->part) + v->offset))[element];
    return status;
}

static fmi2Status real_value(Instance *m, const Variable *v, int element, double *value)
{
    switch (v->causality) {
    case CAUSALITY_INDEPENDENT:
        *value = m->session.phase == INITIALIZING ? m->session.start_time : part_time(m->part);
        return fmi2OK;
    case CAUSALITY_INPUT:
    case CAUSALITY_PARAMETER: *value = ((const double *)storage(m, v))[element]; return fmi2OK;
    case CAUSALITY_OUTPUT:
    case CAUSALITY_LOCAL: break;
    }
    return output_value(m, v, element, value);
}

static fmi2Status GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Real value[])
{
    Instance *m = c;
    if (n > 0 && (!vr || !value)) return refuse(m, CALL_GetReal, "a null pointer for %zu values", n);
    fmi2Status status = fmi2OK;
    for (size_t i = 0; i < n && status <= fmi2Warning; i++) {
        int element;
        const Variable *v = find(m, CALL_GetReal, vr[i], true, &element);
        const fmi2Status one = v ? real_value(m, v, element, &value[i]) : fmi2Error;
        if (one > status) status = one;
    }
    return status;
}

static fmi2Status GetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Integer value[])
{
    Instance *m = c;
    if (n > 0 && (!vr || !value)) return refuse(m, CALL_GetInteger, "a null pointer for %zu values", n);
    for (size_t i = 0; i < n; i++) {
        int element;
        const Variable *v = find(m, CALL_GetInteger, vr[i], false, &element);
        if (!v) return fmi2Error;
        value[i] = ((const int *)storage(m, v))[element];
    }
    return fmi2OK;
}

// Whether this value may be set now.
static bool settable(Instance *m, Call call, fmi2ValueReference reference, bool real, double value)
{
    int element;
    const Variable *v = find(m, call, reference, real, &element);
    if (!v) return false;
    char message[256];
    if (v->causality != CAUSALITY_INPUT && v->causality != CAUSALITY_PARAMETER) {
        variable_element_name(v, element, message, sizeof message);
        refuse(m, call, "%s = %.10g is not allowed: only inputs and parameters can be set", message, value);
        return false;
    }
    if (v->causality == CAUSALITY_PARAMETER && v->fixed && m->session.phase == STEPPING) {
        variable_element_name(v, element, message, sizeof message);
        refuse(m, call, "%s = %.10g is not allowed: it is fixed after initialization, for %s", message, value,
               v->fixed);
        return false;
    }
    if (!variable_allows(v, element, value, message, sizeof message)) {
        refuse(m, call, "%s", message);
        return false;
    }
    return true;
}

// Notes that the host has given a value to a parameter whose start value stands for one that follows from others.
// Before the run a value that is the start value notes nothing: importers set all start values.
static void note_given(Instance *m, const Variable *v)
{
    if (v->given > 0 && m->session.phase == STEPPING)
        *(int *)((char *)part_parameters(m->part) + v->given) = 1;
}

// All values are checked before the first is set.
static fmi2Status SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Real value[])
{
    Instance *m = c;
    if (n > 0 && (!vr || !value)) return refuse(m, CALL_SetReal, "a null pointer for %zu values", n);
    for (size_t i = 0; i < n; i++) {
        if (!settable(m, CALL_SetReal, vr[i], true, value[i])) return fmi2Error;
    }
    for (size_t i = 0; i < n; i++) {
        int element;
        const Variable *v = variable_find(vr[i], &element);
        ((double *)storage(m, v))[element] = value[i];
        note_given(m, v);
    }
    if (n > 0) forget_start(m);
    return fmi2OK;
}

static fmi2Status SetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                             const fmi2Integer value[])
{
    Instance *m = c;
    if (n > 0 && (!vr || !value)) return refuse(m, CALL_SetInteger, "a null pointer for %zu values", n);
    for (size_t i = 0; i < n; i++) {
        if (!settable(m, CALL_SetInteger, vr[i], false, value[i])) return fmi2Error;
    }
    for (size_t i = 0; i < n; i++) {
        int element;
        const Variable *v = variable_find(vr[i], &element);
        ((int *)storage(m, v))[element] = value[i];
    }
    if (n > 0) forget_start(m);
    return fmi2OK;
}

// There are no Boolean and no String variables.
static fmi2Status no_variables(fmi2Component c, Call call, size_t n, const char *type)
{
    Instance *m = c;
    return n == 0 ? fmi2OK : refuse(m, call, "this FMU has no %s variables", type);
}

static fmi2Status GetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Boolean value[])
{
    (void)vr;
    (void)value;
    return no_variables(c, CALL_GetBoolean, n, "Boolean");
}

static fmi2Status SetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                             const fmi2Boolean value[])
{
    (void)vr;
    (void)value;
    return no_variables(c, CALL_SetBoolean, n, "Boolean");
}

static fmi2Status GetString(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2String value[])
{
    (void)vr;
    (void)value;
    return no_variables(c, CALL_GetString, n, "String");
}

static fmi2Status SetString(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                            const fmi2String value[])
{
    (void)vr;
    (void)value;
    return no_variables(c, CALL_SetString, n, "String");
}

// ---- derivatives ------------------------------------------------------------------------------------------------------------------------------
// The input of a value reference, if it may have this derivative.
static const Variable *differentiable_input(Instance *m, fmi2ValueReference reference, int order,
                                            double value, int *element)
{
    const Variable *v = find(m, CALL_SetRealInputDerivatives, reference, true, element);
    if (!v) return NULL;
    if (v->causality != CAUSALITY_INPUT) {
        refuse(m, CALL_SetRealInputDerivatives, "%s: only inputs have derivatives that can be set", v->name);
    } else if (order < 1 || order > INPUT_ORDERS) {
        refuse(m, CALL_SetRealInputDerivatives, "order = %d of %s is not allowed: it must lie in [1, %d]",
               order, v->name, INPUT_ORDERS);
    } else if (!values_are_within(&value, 1, LARGEST_DERIVATIVE)) {
        refuse(m, CALL_SetRealInputDerivatives,
               "%s: derivative of order %d = %g is not allowed: it must lie within +-%g", v->name, order,
               value, LARGEST_DERIVATIVE);
    } else {
        return v;
    }
    return NULL;
}

// They hold for the next step, from its beginning on; without them an input stays where it is.
static fmi2Status SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                          const fmi2Integer order[], const fmi2Real value[])
{
    Instance *m = c;
    if (n > 0 && (!vr || !order || !value))
        return refuse(m, CALL_SetRealInputDerivatives, "a null pointer for %zu values", n);
    int element;
    for (size_t i = 0; i < n; i++) {
        if (!differentiable_input(m, vr[i], order[i], value[i], &element)) return fmi2Error;
    }
    for (size_t i = 0; i < n; i++) {
        const Variable *v = variable_find(vr[i], &element);
        ((double *)((char *)part_inputs(m->part, order[i]) + v->offset))[element] = value[i];
    }
    if (n > 0) forget_start(m);
    return fmi2OK;
}

// Derivatives of the variables vr, all outputs, from those of all outputs; NaN after an error, as the outputs
// themselves: a start that failed has no state to differentiate at.
static fmi2Status output_derivatives(Instance *m, Call call, const Outputs *derivatives,
                                     const fmi2ValueReference vr[], size_t n, fmi2Real value[])
{
    const bool erroneous = m->session.phase == ERRONEOUS;
    for (size_t i = 0; i < n; i++) {
        int element;
        const Variable *v = find(m, call, vr[i], true, &element);
        if (!v) return fmi2Error;
        if (v->causality != CAUSALITY_OUTPUT)
            return refuse(m, call, "%s is no output: it has no derivative that could be asked for", v->name);
        value[i] = erroneous ? NAN : ((const double *)((const char *)derivatives + v->offset))[element];
    }
    return fmi2OK;
}

static fmi2Status GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                           const fmi2Integer order[], fmi2Real value[])
{
    Instance *m = c;
    if (n > 0 && (!vr || !order || !value))
        return refuse(m, CALL_GetRealOutputDerivatives, "a null pointer for %zu values", n);
    for (size_t i = 0; i < n; i++) {
        if (order[i] != 1)
            return refuse(m, CALL_GetRealOutputDerivatives, "order = %d is not allowed: it must be 1",
                          order[i]);
    }
    Outputs derivatives = {0};
    if (m->session.phase != ERRONEOUS) part_time_derivatives(m->part, &derivatives);
    return output_derivatives(m, CALL_GetRealOutputDerivatives, &derivatives, vr, n, value);
}

// Known are inputs and the states of the ring, all other states kept.
static fmi2Status GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknown[],
                                           size_t n_unknown, const fmi2ValueReference known[], size_t n_known,
                                           const fmi2Real d_known[], fmi2Real d_unknown[])
{
    const Call call = CALL_GetDirectionalDerivative;
    Instance *m = c;
    if ((n_unknown > 0 && (!unknown || !d_unknown)) || (n_known > 0 && (!known || !d_known)))
        return refuse(m, call, "a null pointer");
    Inputs inputs;
    double state[N_ALL_STATES] = {0.0};
    memset(&inputs, 0, sizeof inputs);
    for (size_t i = 0; i < n_known; i++) {
        int element;
        const Variable *v = find(m, call, known[i], true, &element);
        if (!v) return fmi2Error;
        if (!isfinite(d_known[i]))
            return refuse(m, call, "%s: %g is not allowed in a direction: it must be finite", v->name,
                          d_known[i]);
        if (v->causality == CAUSALITY_INPUT)
            ((double *)((char *)&inputs + v->offset))[element] += d_known[i];
        else if (v->state >= 0)
            state[v->state] += d_known[i];
        else
            return refuse(m, call, "%s is neither an input nor a state: there is no derivative by it",
                          v->name);
    }
    Outputs derivatives = {0};
    if (m->session.phase != ERRONEOUS) part_directional_derivatives(m->part, &inputs, state, &derivatives);
    return output_derivatives(m, call, &derivatives, unknown, n_unknown, d_unknown);
}

// Distance that a host's clock may have from the FMU's: single precision (6e-8 of the time, a few of them) and
// times that a host rounds for itself, never less than a thousandth of the step, nor more than half of it: a point
// a whole step away is another one.
static double clock_slack(double time, double step)
{
    return fmax(fmin(1e-6 * fabs(time), 0.5 * step), 1e-3 * step);
}

// Distance that double precision alone explains: t += h, start + k h, whole nanoseconds.
static double clock_rounding(const Session *s, double time, double step)
{
    return 2.0 * DBL_EPSILON * (fmax(fabs(s->start_time), fabs(time)) + step);
}

// ---- saved states: one block of bytes, in memory as in a file -------------------------------------------------------------------------------
typedef struct {
    char magic[8];
    uint64_t version;   // of this layout
    char guid[40];      // of the model
    char build[72];     // digest of the sources
    char data[72];      // digest of data built in
    uint64_t size;      // of the whole block
    uint64_t checksum;  // of all that follows the header
} BlobHeader;

static const char BLOB_MAGIC[8] = "RBstate";

enum { BLOB_VERSION = 5 };

static size_t blob_size(void)
{
    return (sizeof(BlobHeader) + sizeof(Session) + part_saved_size() + 7) / 8 * 8;
}

// 64 bits, eight bytes at a time: each step is a permutation of the hash, so a change of any single word changes it.
static uint64_t blob_checksum(const unsigned char *blob)
{
    uint64_t hash = 0xcbf29ce484222325u, word;
    for (size_t i = sizeof(BlobHeader); i + sizeof word <= blob_size(); i += sizeof word) {
        memcpy(&word, blob + i, sizeof word);
        hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    }
    return hash;
}

// The header of this model's states, the checksum left out.
static BlobHeader blob_header(void)
{
    BlobHeader header = {.version = BLOB_VERSION, .guid = MODEL_GUID, .size = blob_size()};
    memcpy(header.magic, BLOB_MAGIC, sizeof header.magic);
    snprintf(header.build, sizeof header.build, "%s", BUILD_DIGEST);
    snprintf(header.data, sizeof header.data, "%s", part_data_digest());
    return header;
}

// Why a block is not a state of this model; NULL if it is.
static const char *blob_problem(const unsigned char *blob, size_t size, bool checked)
{
    const BlobHeader ours = blob_header();
    BlobHeader header;
    if (size < sizeof header) return "the saved state is truncated";
    memcpy(&header, blob, sizeof header);
    if (memcmp(header.magic, BLOB_MAGIC, sizeof header.magic) != 0)
        return "this is not a saved state of a " MODEL_IDENTIFIER;
    if (header.version != BLOB_VERSION) return "the saved state is of another version of this FMU";
    if (memcmp(header.guid, ours.guid, sizeof header.guid) != 0)
        return "the saved state is of another model (its GUID is not " MODEL_GUID ")";
    if (memcmp(header.data, ours.data, sizeof header.data) != 0)
        return "the saved state is of an FMU with other data built in (of a bearing: another rivet table)";
    if (memcmp(header.build, ours.build, sizeof header.build) != 0)
        return "the saved state is of an FMU that was built from other sources";
    if (header.size != ours.size) return "the saved state has another size than this FMU's";
    if (size != header.size) return "the saved state is truncated or too long";
    if (checked && header.checksum != blob_checksum(blob))
        return "the saved state is corrupted (its checksum is wrong)";
    return NULL;
}

// Where the messages about a state go that is tried: the last one is the reason.
typedef struct {
    char *text;
    size_t size;
} Reason;

static void keep_reason(void *environment, LogCategory category, const char *message)
{
    const Reason *reason = environment;
    if (category == LOG_ERROR)
        snprintf(reason->text, reason->size, "the saved state cannot be restored: %s", message);
}

// Why this cannot be the session of a part at this time; NULL if it can.
static const char *session_problem(const Session *s, const Part *part)
{
    const Variable *tolerance = variable_named("solver.tol");
    const double time = part_time(part),
                 slack = clock_rounding(s, time, 0.0) + 1e-6 * (1.0 + time - s->start_time);
    if (!(s->phase == INSTANTIATED || s->phase == INITIALIZING || s->phase == STEPPING ||
          s->phase == FAILED || s->phase == TERMINATED || s->phase == ERRONEOUS))
        return "there is no such phase";
    if (s->initialized > 1 || (s->initialized && (s->phase == INSTANTIATED || !part_is_initialized(part))))
        return "phase and part do not belong together";
    if (s->phase & (STEPPING | FAILED | TERMINATED) && !part_is_initialized(part))
        return "it has this phase without a start";
    if (!values_are_within(&s->start_time, 1, LARGEST_TIME) || !(s->stop_time >= s->start_time))
        return "start and stop time are not in order";
    if (s->phase & (STEPPING | FAILED | TERMINATED) &&
        !(time >= s->start_time && time <= s->stop_time + slack))
        return "its time is not between start and stop";
    if (s->tolerance != 0.0 &&
        !(tolerance && s->tolerance >= tolerance->min && s->tolerance <= tolerance->max))
        return "its tolerance is out of range";
    if (s->step_status > fmi2Error) return "there is no such status of a step";
    return NULL;
}

// Whether a block of this model, from outside, holds what an instance can go on from: tried on a part of its own.
static bool blob_can_be_restored(const unsigned char *blob, char *reason, size_t size)
{
    Reason kept = {reason, size};
    const PartHost listener = {&kept, keep_reason};
    Session session;
    memcpy(&session, blob + sizeof(BlobHeader), sizeof session);
    snprintf(reason, size, "out of memory");
    Part *part = part_create(&listener);
    if (!part) return false;
    bool fine = part_restore_unknown(part, blob + sizeof(BlobHeader) + sizeof session);
    const char *problem = fine ? session_problem(&session, part) : NULL;
    if (problem) keep_reason(&kept, LOG_ERROR, problem);
    part_destroy(part);
    return fine && !problem;
}

static fmi2Status GetFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    Instance *m = c;
    if (!state) return refuse(m, CALL_GetFMUstate, "a null pointer for the state");
    unsigned char *blob = *state ? *state : calloc(1, blob_size());
    if (!blob) return refuse(m, CALL_GetFMUstate, "out of memory");
    const BlobHeader header = blob_header();
    memcpy(blob, &header, sizeof header);
    memcpy(blob + sizeof header, &m->session, sizeof m->session);
    part_save(m->part, blob + sizeof header + sizeof m->session);
    *state = blob;
    return fmi2OK;
}

static fmi2Status SetFMUstate(fmi2Component c, fmi2FMUstate state)
{
    Instance *m = c;
    const unsigned char *blob = state;
    const char *problem = blob ? blob_problem(blob, blob_size(), false) : "a null pointer for the state";
    if (problem) return refuse(m, CALL_SetFMUstate, "%s", problem);
    memcpy(&m->session, blob + sizeof(BlobHeader), sizeof m->session);
    part_restore(m->part, blob + sizeof(BlobHeader) + sizeof m->session);
    return fmi2OK;
}

static fmi2Status FreeFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    (void)c;
    if (!state) return fmi2OK;
    free(*state);
    *state = NULL;
    return fmi2OK;
}

static fmi2Status SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size)
{
    Instance *m = c;
    if (!state || !size) return refuse(m, CALL_SerializedFMUstateSize, "a null pointer");
    *size = blob_size();
    return fmi2OK;
}

static fmi2Status SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size)
{
    Instance *m = c;
    if (!state || !bytes) return refuse(m, CALL_SerializeFMUstate, "a null pointer");
    if (size < blob_size())
        return refuse(m, CALL_SerializeFMUstate, "size = %zu is not allowed: the state has %zu bytes", size,
                      blob_size());
    BlobHeader header;
    memcpy(&header, state, sizeof header);
    header.checksum = blob_checksum(state);
    memcpy(bytes, &header, sizeof header);
    memcpy(bytes + sizeof header, (const unsigned char *)state + sizeof header, blob_size() - sizeof header);
    return fmi2OK;
}

static fmi2Status DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size,
                                      fmi2FMUstate *state)
{
    Instance *m = c;
    if (!bytes || !state) return refuse(m, CALL_DeSerializeFMUstate, "a null pointer");
    const char *problem = blob_problem((const unsigned char *)bytes, size, true);
    if (problem) return refuse(m, CALL_DeSerializeFMUstate, "%s", problem);
    char reason[300];
    if (!blob_can_be_restored((const unsigned char *)bytes, reason, sizeof reason))
        return refuse(m, CALL_DeSerializeFMUstate, "%s", reason);
    if (!*state) *state = calloc(1, blob_size());
    if (!*state) return refuse(m, CALL_DeSerializeFMUstate, "out of memory");
    memcpy(*state, bytes, blob_size());
    return fmi2OK;
}

// ---- steps ----------------------------------------------------------------------------------------------------------------------------------
static void warn_of_clock(Instance *m, double point, double time)
{
    if (m->warned_of_clock) return;
    m->warned_of_clock = true;
    char message[256];
    snprintf(message, sizeof message,
             "currentCommunicationPoint = %.17g s, but the last step ended at %.17g s: the FMU goes on from "
             "its own time "
             "to the end of each step (said once)",
             point, time);
    instance_log(m, LOG_WARNING, message);
}

// The step from the FMU's own time to the end that the host means.
static fmi2Status do_step(Instance *m, double point, double step)
{
    const Session *s = &m->session;
    const double time = part_time(m->part), end = point + step;
    if (!(isfinite(step) && step > 0.0)) {
        return refuse(m, CALL_DoStep,
                      "communicationStepSize = %g s is not allowed: it must be positive and finite", step);
    }
    const double slack = clock_slack(time, step), rounding = clock_rounding(s, time, step);
    if (!(fabs(point - time) <= slack + rounding)) {
        return refuse_step(
            m,
            "currentCommunicationPoint = %.17g s is not allowed: the last step ended at %.17g s; "
            "at most %.3g s off is allowed",
            point, time, slack);
    }
    if (!(end > time)) {
        return refuse_step(
            m,
            "communicationStepSize = %g s is not allowed: currentCommunicationPoint = %.17g s and the "
            "step end at or before %.17g s, where the last step ended",
            step, point, time);
    }
    if (end > s->stop_time + fmin(slack, 0.5 * step) + rounding) {
        return refuse(m, CALL_DoStep,
                      "communicationStepSize = %g s is not allowed: the step goes beyond stopTime = %.17g s",
                      step, s->stop_time);
    }
    if (fabs(point - time) > rounding) warn_of_clock(m, point, time);
    return conclude(m, part_step(m->part, end));
}

static fmi2Status DoStep(fmi2Component c, fmi2Real point, fmi2Real step, fmi2Boolean no_earlier_state)
{
    (void)no_earlier_state;  // nothing is kept for it
    Instance *m = c;
    const fmi2Status status = do_step(m, point, step);
    m->session.step_status = status;
    return status;
}

// Answers of the status functions: fmi2Discard where there is no such status (FMI 2.0.4, section 4.2.3).
static fmi2Status GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value)
{
    Instance *m = c;
    if (!value) return refuse(m, CALL_GetStatus, "a null pointer");
    if (kind != fmi2DoStepStatus) return fmi2Discard;
    *value = (fmi2Status)m->session.step_status;
    return fmi2OK;
}

static fmi2Status GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
{
    Instance *m = c;
    if (!value) return refuse(m, CALL_GetRealStatus, "a null pointer");
    if (kind != fmi2LastSuccessfulTime) return fmi2Discard;
    *value = part_time(m->part);
    return fmi2OK;
}

static fmi2Status GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value)
{
    (void)kind;
    Instance *m = c;
    return value ? fmi2Discard : refuse(m, CALL_GetIntegerStatus, "a null pointer");
}

static fmi2Status GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value)
{
    Instance *m = c;
    if (!value) return refuse(m, CALL_GetBooleanStatus, "a null pointer");
    if (kind != fmi2Terminated) return fmi2Discard;
    *value = m->session.phase == FAILED;
    return fmi2OK;
}

// fmi2PendingStatus: the last error or warning.
static fmi2Status GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value)
{
    Instance *m = c;
    if (!value) return refuse(m, CALL_GetStringStatus, "a null pointer");
    if (kind != fmi2PendingStatus) return fmi2Discard;
    *value = m->message;
    return fmi2OK;
}

// ---- exported functions: each a shell around the function above that has its name ---------------------------------------------------------------
// The statement in the core's floating-point environment; afterwards the host's.
#define GUARDED(statement) \
    FloatEnvironment host; \
    float_enter(&host);    \
    statement;             \
    float_leave(&host);

#define CALL(name, phases, parameters, arguments)                                                    \
    fmi2Status fmi2##name parameters                                                                 \
    {                                                                                                \
        GUARDED(const fmi2Status status = enter(c, CALL_##name, &host) ? name arguments : fmi2Error) \
        return status;                                                                               \
    }
#define NOT_OFFERED(name, parameters)                       \
    fmi2Status fmi2##name parameters                        \
    {                                                       \
        GUARDED(refuse_unsupported(c, "fmi2" #name, &host)) \
        return fmi2Error;                                   \
    }

FMI2_CALLS(CALL)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
FMI2_NOT_OFFERED(NOT_OFFERED)
#pragma GCC diagnostic pop

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible,
                              fmi2Boolean logging)
{
    (void)resources, (void)visible;
    GUARDED(fmi2Component component = Instantiate(name, type, guid, functions, logging, &host))
    return component;
}

void fmi2FreeInstance(fmi2Component c)
{
    GUARDED(FreeInstance(c, &host))
}

// No arithmetic, no instance.
const char *fmi2GetTypesPlatform(void)
{
    return fmi2TypesPlatform;
}

const char *fmi2GetVersion(void)
{
    return fmi2Version;
}
