// A part (part.h) as an FMI 2.0 co-simulation slave: call order, value references, host time, logging, saved states.  No physics.
//
// Every function that returns fmi2Error has changed nothing but the phase: the instance then stands in ERRONEOUS until fmi2Reset or
// fmi2SetFMUstate (FMI 2.0.4, section 2.1.3), and its outputs read NaN with fmi2Warning, so that a host which ignores the status shows no
// plausible result.
// fmi2Discard comes with fmi2Terminated and fmi2LastSuccessfulTime; the outputs then are those of the last good state.
#include "part.h"

#include "fmi2Functions.h"

#include <fenv.h>
#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// ---- call order ---------------------------------------------------------------------------------------------------------------------------
typedef enum { INSTANTIATED = 1, INITIALIZING = 2, STEPPING = 4, FAILED = 8, TERMINATED = 16, ERRONEOUS = 32, FATAL = 64 } Phase;

enum { NEVER = 0, STEPPED = STEPPING | FAILED | TERMINATED | ERRONEOUS, READABLE = INITIALIZING | STEPPED, ALIVE = INSTANTIATED | READABLE };

// Function and phases in which it may be called (FMI 2.0.4, section 4.2.4); steps are never in progress or canceled.  No directional derivatives in
// initialization mode: there the inputs act through the equilibrium, which has none.
typedef enum {
    CALL_SetDebugLogging,
    CALL_SetupExperiment,
    CALL_EnterInitializationMode,
    CALL_ExitInitializationMode,
    CALL_Terminate,
    CALL_Reset,
    CALL_GetReal,
    CALL_GetInteger,
    CALL_GetBoolean,
    CALL_GetString,
    CALL_SetReal,
    CALL_SetInteger,
    CALL_SetBoolean,
    CALL_SetString,
    CALL_GetFMUstate,
    CALL_SetFMUstate,
    CALL_FreeFMUstate,
    CALL_SerializedFMUstateSize,
    CALL_SerializeFMUstate,
    CALL_DeSerializeFMUstate,
    CALL_SetRealInputDerivatives,
    CALL_GetRealOutputDerivatives,
    CALL_GetDirectionalDerivative,
    CALL_DoStep,
    CALL_CancelStep,
    CALL_GetStatus,
    CALL_GetRealStatus,
    CALL_GetIntegerStatus,
    CALL_GetBooleanStatus,
    CALL_GetStringStatus,
} Call;

static const struct {
    const char *name;
    unsigned phases;
} CALLS[] = {
    [CALL_SetDebugLogging] = {"fmi2SetDebugLogging", ALIVE},
    [CALL_SetupExperiment] = {"fmi2SetupExperiment", INSTANTIATED},
    [CALL_EnterInitializationMode] = {"fmi2EnterInitializationMode", INSTANTIATED},
    [CALL_ExitInitializationMode] = {"fmi2ExitInitializationMode", INITIALIZING},
    [CALL_Terminate] = {"fmi2Terminate", STEPPING | FAILED},
    [CALL_Reset] = {"fmi2Reset", ALIVE},
    [CALL_GetReal] = {"fmi2GetReal", READABLE},
    [CALL_GetInteger] = {"fmi2GetInteger", READABLE},
    [CALL_GetBoolean] = {"fmi2GetBoolean", READABLE},
    [CALL_GetString] = {"fmi2GetString", READABLE},
    [CALL_SetReal] = {"fmi2SetReal", INSTANTIATED | INITIALIZING | STEPPING},
    [CALL_SetInteger] = {"fmi2SetInteger", INSTANTIATED | INITIALIZING},
    [CALL_SetBoolean] = {"fmi2SetBoolean", INSTANTIATED | INITIALIZING | STEPPING},
    [CALL_SetString] = {"fmi2SetString", INSTANTIATED | INITIALIZING | STEPPING},
    [CALL_GetFMUstate] = {"fmi2GetFMUstate", ALIVE},
    [CALL_SetFMUstate] = {"fmi2SetFMUstate", ALIVE},
    [CALL_FreeFMUstate] = {"fmi2FreeFMUstate", ALIVE},
    [CALL_SerializedFMUstateSize] = {"fmi2SerializedFMUstateSize", ALIVE},
    [CALL_SerializeFMUstate] = {"fmi2SerializeFMUstate", ALIVE},
    [CALL_DeSerializeFMUstate] = {"fmi2DeSerializeFMUstate", ALIVE},
    [CALL_SetRealInputDerivatives] = {"fmi2SetRealInputDerivatives", INSTANTIATED | INITIALIZING | STEPPING},
    [CALL_GetRealOutputDerivatives] = {"fmi2GetRealOutputDerivatives", STEPPED},
    [CALL_GetDirectionalDerivative] = {"fmi2GetDirectionalDerivative", STEPPED},
    [CALL_DoStep] = {"fmi2DoStep", STEPPING},
    [CALL_CancelStep] = {"fmi2CancelStep", NEVER},
    [CALL_GetStatus] = {"fmi2GetStatus", STEPPED},
    [CALL_GetRealStatus] = {"fmi2GetRealStatus", STEPPED},
    [CALL_GetIntegerStatus] = {"fmi2GetIntegerStatus", STEPPED},
    [CALL_GetBooleanStatus] = {"fmi2GetBooleanStatus", STEPPED},
    [CALL_GetStringStatus] = {"fmi2GetStringStatus", STEPPED},
};

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
    fmi2CallbackFunctions callbacks;
    char *name;
    unsigned categories;  // that are sent: bits 1 << LogCategory
    char message[512];    // the last error or warning
} Instance;

static const Session NEW_SESSION = {.phase = INSTANTIATED, .stop_time = INFINITY};

// In the order of LogCategory; errors and warnings are always sent.
static const char *const CATEGORIES[] = {"logStatusError", "logStatusWarning", "logEvents", "logSolver"};
enum { N_CATEGORIES = sizeof CATEGORIES / sizeof CATEGORIES[0], ALL_CATEGORIES = (1 << N_CATEGORIES) - 1 };
enum { ALWAYS_SENT = 1 << LOG_ERROR | 1 << LOG_WARNING };

// Hosts read the message as a printf format and '#' as the start of a value reference: both are doubled.
static void send(const fmi2CallbackFunctions *callbacks, const char *instance, fmi2Status status, LogCategory category, const char *message)
{
    if (!callbacks->logger) return;
    char escaped[1024];
    size_t n = 0;
    for (; *message && n + 3 < sizeof escaped; message++) {
        if (*message == '%' || *message == '#') escaped[n++] = *message;
        escaped[n++] = *message;
    }
    escaped[n] = '\0';
    callbacks->logger(callbacks->componentEnvironment, instance, status, CATEGORIES[category], escaped);
}

static void instance_log(void *environment, LogCategory category, const char *message)
{
    static const fmi2Status status[] = {fmi2Error, fmi2Warning, fmi2OK, fmi2OK};
    Instance *m = environment;
    if (category == LOG_ERROR || category == LOG_WARNING) snprintf(m->message, sizeof m->message, "%s", message);
    if (m->categories & 1u << category) send(&m->callbacks, m->name, status[category], category, message);
}

static fmi2Status refuse(Instance *m, Call call, const char *format, ...)
{
    char reason[400], message[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(reason, sizeof reason, format, arguments);
    va_end(arguments);
    snprintf(message, sizeof message, "%s at t = %.9g s: %s", CALLS[call].name, part_time(m->part), reason);
    instance_log(m, LOG_ERROR, message);
    m->session.phase = ERRONEOUS;
    return fmi2Error;
}

// The instance, if the call is allowed now.
static Instance *enter(fmi2Component component, Call call)
{
    Instance *m = component;
    if (!m) return NULL;
    if (m->session.phase & CALLS[call].phases) return m;
    if (m->session.phase != FATAL) refuse(m, call, "not allowed in state \"%s\"", phase_name(m->session.phase));
    return NULL;
}

static fmi2Status refuse_unsupported(fmi2Component component, const char *function)
{
    Instance *m = component;
    if (m && m->session.phase != FATAL) {
        char message[128];
        snprintf(message, sizeof message, "%s is not offered by this FMU (see its capability flags)", function);
        instance_log(m, LOG_ERROR, message);
        m->session.phase = ERRONEOUS;
    }
    return fmi2Error;
}

// The status of the core as FMI's, with the phase that follows.
static fmi2Status conclude(Instance *m, PartStatus status)
{
    switch (status) {
    case PART_OK:
        return fmi2OK;
    case PART_WARNING:
        return fmi2Warning;
    case PART_DISCARD:
        m->session.phase = FAILED;
        return fmi2Discard;
    case PART_ERROR:
        m->session.phase = ERRONEOUS;
        return fmi2Error;
    case PART_FATAL:
        break;
    }
    m->session.phase = FATAL;
    return fmi2Fatal;
}

// The core computes in the default floating-point environment, whatever rounding, flushing or traps the host has set.
static fenv_t floating_point_default(void)
{
    fenv_t host;
    fegetenv(&host);
    fesetenv(FE_DFL_ENV);
    return host;
}

// The start for the present parameters and inputs, from a new part: an earlier start, made to read outputs, leaves no trace.
// A step cannot be discarded here: there is no last good state.
static fmi2Status instance_initialize(Instance *m)
{
    if (m->session.initialized) return fmi2OK;
    const fenv_t host = floating_point_default();
    const Parameters parameters = *part_parameters(m->part);
    Inputs inputs[INPUT_ORDERS + 1];
    for (int order = 0; order <= INPUT_ORDERS; order++) inputs[order] = *part_inputs(m->part, order);
    part_reset(m->part);
    *part_parameters(m->part) = parameters;
    for (int order = 0; order <= INPUT_ORDERS; order++) *part_inputs(m->part, order) = inputs[order];
    PartStatus status = part_initialize(m->part, m->session.start_time, m->session.tolerance);
    fesetenv(&host);
    if (status == PART_DISCARD) status = PART_ERROR;
    m->session.initialized = status == PART_OK || status == PART_WARNING;
    return conclude(m, status);
}

// ---- creation and destruction ---------------------------------------------------------------------------------------------------------------
const char *fmi2GetTypesPlatform(void)
{
    return fmi2TypesPlatform;
}

const char *fmi2GetVersion(void)
{
    return fmi2Version;
}

static const char *instantiation_problem(fmi2String name, fmi2Type type, fmi2String guid)
{
    if (!name || !*name) return "fmi2Instantiate: the instance name is empty";
    if (type != fmi2CoSimulation) return "fmi2Instantiate: this FMU offers co-simulation only";
    if (!guid || strcmp(guid, MODEL_GUID) != 0) return "fmi2Instantiate: the GUID is not " MODEL_GUID ": description and binary do not belong together";
    return NULL;
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources, const fmi2CallbackFunctions *functions,
                              fmi2Boolean visible, fmi2Boolean logging)
{
    (void)resources;
    (void)visible;
    if (!functions) return NULL;
    const char *problem = instantiation_problem(name, type, guid);
    Instance *m = problem ? NULL : calloc(1, sizeof *m);
    if (m) {
        m->session = NEW_SESSION;
        m->host = (PartHost){m, instance_log};
        m->callbacks = *functions;
        m->categories = logging ? ALL_CATEGORIES : ALWAYS_SENT;
        const size_t size = strlen(name) + 1;
        m->name = malloc(size);
        if (m->name) m->part = part_create(&m->host);
        if (m->part) {
            memcpy(m->name, name, size);
            return m;
        }
        fmi2FreeInstance(m);
    }
    send(functions, name ? name : "", fmi2Error, LOG_ERROR, problem ? problem : "fmi2Instantiate: out of memory");
    return NULL;
}

void fmi2FreeInstance(fmi2Component component)
{
    Instance *m = component;
    if (!m) return;
    part_destroy(m->part);
    free(m->name);
    free(m);
}

// Unknown categories are ignored with a warning.
fmi2Status fmi2SetDebugLogging(fmi2Component component, fmi2Boolean on, size_t n, const fmi2String categories[])
{
    Instance *m = enter(component, CALL_SetDebugLogging);
    if (!m) return fmi2Error;
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
            snprintf(message, sizeof message, "fmi2SetDebugLogging: unknown category \"%.60s\"", categories[i] ? categories[i] : "(null)");
            instance_log(m, LOG_WARNING, message);
            status = fmi2Warning;
        }
        chosen |= found;
    }
    m->categories = on ? chosen : ALWAYS_SENT;
    return status;
}

// ---- initialization and end -----------------------------------------------------------------------------------------------------------------
fmi2Status fmi2SetupExperiment(fmi2Component component, fmi2Boolean tolerance_defined, fmi2Real tolerance, fmi2Real start_time, fmi2Boolean stop_time_defined,
                               fmi2Real stop_time)
{
    Instance *m = enter(component, CALL_SetupExperiment);
    if (!m) return fmi2Error;
    char message[256];
    const Variable *known = variable_named("solver.tol");  // a part without it has no use for a tolerance
    if (tolerance_defined && known && !variable_allows(known, 0, tolerance, message, sizeof message)) {
        return refuse(m, CALL_SetupExperiment, "%s (given as tolerance)", message);
    }
    if (!isfinite(start_time)) return refuse(m, CALL_SetupExperiment, "startTime = %g s is not allowed: it must be finite", start_time);
    if (stop_time_defined && !(stop_time >= start_time)) {
        return refuse(m, CALL_SetupExperiment, "stopTime = %g s is not allowed: it must not lie before startTime = %g s", stop_time, start_time);
    }
    m->session.tolerance = tolerance_defined ? tolerance : 0.0;
    m->session.start_time = start_time;
    m->session.stop_time = stop_time_defined ? stop_time : INFINITY;
    return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component component)
{
    Instance *m = enter(component, CALL_EnterInitializationMode);
    if (!m) return fmi2Error;
    m->session.phase = INITIALIZING;
    return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component component)
{
    Instance *m = enter(component, CALL_ExitInitializationMode);
    if (!m) return fmi2Error;
    const fmi2Status status = instance_initialize(m);
    if (status <= fmi2Warning) m->session.phase = STEPPING;
    return status;
}

fmi2Status fmi2Terminate(fmi2Component component)
{
    Instance *m = enter(component, CALL_Terminate);
    if (!m) return fmi2Error;
    m->session.phase = TERMINATED;
    return fmi2OK;
}

fmi2Status fmi2Reset(fmi2Component component)
{
    Instance *m = enter(component, CALL_Reset);
    if (!m) return fmi2Error;
    part_reset(m->part);
    m->session = NEW_SESSION;
    m->message[0] = '\0';
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
    refuse(m, call, "value reference %u belongs to no %s variable", reference, real ? "Real" : "Integer or Enumeration");
    return NULL;
}

static void *storage(Instance *m, const Variable *v)
{
    char *base = v->causality == CAUSALITY_INPUT ? (char *)part_inputs(m->part, 0) : (char *)part_parameters(m->part);
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
    case CAUSALITY_PARAMETER:
        *value = ((const double *)storage(m, v))[element];
        return fmi2OK;
    case CAUSALITY_OUTPUT:
        break;
    }
    return output_value(m, v, element, value);
}

fmi2Status fmi2GetReal(fmi2Component component, const fmi2ValueReference vr[], size_t n, fmi2Real value[])
{
    Instance *m = enter(component, CALL_GetReal);
    if (!m) return fmi2Error;
    if (n > 0 && (!vr || !value)) return refuse(m, CALL_GetReal, "a null pointer for %zu values", n);
    const fenv_t host = floating_point_default();
    fmi2Status status = fmi2OK;
    for (size_t i = 0; i < n && status <= fmi2Warning; i++) {
        int element;
        const Variable *v = find(m, CALL_GetReal, vr[i], true, &element);
        const fmi2Status one = v ? real_value(m, v, element, &value[i]) : fmi2Error;
        if (one > status) status = one;
    }
    fesetenv(&host);
    return status;
}

fmi2Status fmi2GetInteger(fmi2Component component, const fmi2ValueReference vr[], size_t n, fmi2Integer value[])
{
    Instance *m = enter(component, CALL_GetInteger);
    if (!m) return fmi2Error;
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
    if (v->causality == CAUSALITY_PARAMETER && m->session.phase == STEPPING) {
        variable_element_name(v, element, message, sizeof message);
        refuse(m, call, "%s = %.10g is not allowed: parameters are fixed after initialization", message, value);
        return false;
    }
    if (!variable_allows(v, element, value, message, sizeof message)) {
        refuse(m, call, "%s", message);
        return false;
    }
    return true;
}

// All values are checked before the first is set.
fmi2Status fmi2SetReal(fmi2Component component, const fmi2ValueReference vr[], size_t n, const fmi2Real value[])
{
    Instance *m = enter(component, CALL_SetReal);
    if (!m) return fmi2Error;
    if (n > 0 && (!vr || !value)) return refuse(m, CALL_SetReal, "a null pointer for %zu values", n);
    for (size_t i = 0; i < n; i++) {
        if (!settable(m, CALL_SetReal, vr[i], true, value[i])) return fmi2Error;
    }
    for (size_t i = 0; i < n; i++) {
        int element;
        const Variable *v = variable_find(vr[i], &element);
        ((double *)storage(m, v))[element] = value[i];
    }
    m->session.initialized = false;
    return fmi2OK;
}

fmi2Status fmi2SetInteger(fmi2Component component, const fmi2ValueReference vr[], size_t n, const fmi2Integer value[])
{
    Instance *m = enter(component, CALL_SetInteger);
    if (!m) return fmi2Error;
    if (n > 0 && (!vr || !value)) return refuse(m, CALL_SetInteger, "a null pointer for %zu values", n);
    for (size_t i = 0; i < n; i++) {
        if (!settable(m, CALL_SetInteger, vr[i], false, value[i])) return fmi2Error;
    }
    for (size_t i = 0; i < n; i++) {
        int element;
        const Variable *v = variable_find(vr[i], &element);
        ((int *)storage(m, v))[element] = value[i];
    }
    m->session.initialized = false;
    return fmi2OK;
}

// There are no Boolean and no String variables.
static fmi2Status no_variables(fmi2Component component, Call call, size_t n, const char *type)
{
    Instance *m = enter(component, call);
    if (!m) return fmi2Error;
    return n == 0 ? fmi2OK : refuse(m, call, "this FMU has no %s variables", type);
}

fmi2Status fmi2GetBoolean(fmi2Component component, const fmi2ValueReference vr[], size_t n, fmi2Boolean value[])
{
    (void)vr;
    (void)value;
    return no_variables(component, CALL_GetBoolean, n, "Boolean");
}

fmi2Status fmi2SetBoolean(fmi2Component component, const fmi2ValueReference vr[], size_t n, const fmi2Boolean value[])
{
    (void)vr;
    (void)value;
    return no_variables(component, CALL_SetBoolean, n, "Boolean");
}

fmi2Status fmi2GetString(fmi2Component component, const fmi2ValueReference vr[], size_t n, fmi2String value[])
{
    (void)vr;
    (void)value;
    return no_variables(component, CALL_GetString, n, "String");
}

fmi2Status fmi2SetString(fmi2Component component, const fmi2ValueReference vr[], size_t n, const fmi2String value[])
{
    (void)vr;
    (void)value;
    return no_variables(component, CALL_SetString, n, "String");
}

// ---- derivatives ------------------------------------------------------------------------------------------------------------------------------
// The input of a value reference, if it may have this derivative.
static const Variable *differentiable_input(Instance *m, fmi2ValueReference reference, int order, double value, int *element)
{
    const Variable *v = find(m, CALL_SetRealInputDerivatives, reference, true, element);
    if (!v) return NULL;
    if (v->causality != CAUSALITY_INPUT) {
        refuse(m, CALL_SetRealInputDerivatives, "%s: only inputs have derivatives that can be set", v->name);
    } else if (order < 1 || order > INPUT_ORDERS) {
        refuse(m, CALL_SetRealInputDerivatives, "order = %d of %s is not allowed: it must lie in [1, %d]", order, v->name, INPUT_ORDERS);
    } else if (!isfinite(value)) {
        refuse(m, CALL_SetRealInputDerivatives, "%s: derivative of order %d = %g is not allowed: it must be finite", v->name, order, value);
    } else {
        return v;
    }
    return NULL;
}

// They hold for the next step, from its beginning on; without them an input stays where it is.
fmi2Status fmi2SetRealInputDerivatives(fmi2Component component, const fmi2ValueReference vr[], size_t n, const fmi2Integer order[], const fmi2Real value[])
{
    Instance *m = enter(component, CALL_SetRealInputDerivatives);
    if (!m) return fmi2Error;
    if (n > 0 && (!vr || !order || !value)) return refuse(m, CALL_SetRealInputDerivatives, "a null pointer for %zu values", n);
    int element;
    for (size_t i = 0; i < n; i++) {
        if (!differentiable_input(m, vr[i], order[i], value[i], &element)) return fmi2Error;
    }
    for (size_t i = 0; i < n; i++) {
        const Variable *v = variable_find(vr[i], &element);
        ((double *)((char *)part_inputs(m->part, order[i]) + v->offset))[element] = value[i];
    }
    m->session.initialized = false;
    return fmi2OK;
}

// Derivatives of the variables vr, all outputs, from those of all outputs; NaN after an error, as the outputs themselves.
static fmi2Status output_derivatives(Instance *m, Call call, const Outputs *derivatives, const fmi2ValueReference vr[], size_t n, fmi2Real value[])
{
    const bool erroneous = m->session.phase == ERRONEOUS;
    for (size_t i = 0; i < n; i++) {
        int element;
        const Variable *v = find(m, call, vr[i], true, &element);
        if (!v) return fmi2Error;
        if (v->causality != CAUSALITY_OUTPUT) return refuse(m, call, "%s is no output: it has no derivative that could be asked for", v->name);
        value[i] = erroneous ? NAN : ((const double *)((const char *)derivatives + v->offset))[element];
    }
    return fmi2OK;
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component component, const fmi2ValueReference vr[], size_t n, const fmi2Integer order[], fmi2Real value[])
{
    Instance *m = enter(component, CALL_GetRealOutputDerivatives);
    if (!m) return fmi2Error;
    if (n > 0 && (!vr || !order || !value)) return refuse(m, CALL_GetRealOutputDerivatives, "a null pointer for %zu values", n);
    for (size_t i = 0; i < n; i++) {
        if (order[i] != 1) return refuse(m, CALL_GetRealOutputDerivatives, "order = %d is not allowed: it must be 1", order[i]);
    }
    Outputs derivatives;
    const fenv_t host = floating_point_default();
    part_time_derivatives(m->part, &derivatives);
    fesetenv(&host);
    return output_derivatives(m, CALL_GetRealOutputDerivatives, &derivatives, vr, n, value);
}

// Known are inputs and the states of the ring, all other states kept.
fmi2Status fmi2GetDirectionalDerivative(fmi2Component component, const fmi2ValueReference unknown[], size_t n_unknown, const fmi2ValueReference known[],
                                        size_t n_known, const fmi2Real d_known[], fmi2Real d_unknown[])
{
    const Call call = CALL_GetDirectionalDerivative;
    Instance *m = enter(component, call);
    if (!m) return fmi2Error;
    if ((n_unknown > 0 && (!unknown || !d_unknown)) || (n_known > 0 && (!known || !d_known))) return refuse(m, call, "a null pointer");
    Inputs inputs;
    double state[N_STATES] = {0.0};
    memset(&inputs, 0, sizeof inputs);
    for (size_t i = 0; i < n_known; i++) {
        int element;
        const Variable *v = find(m, call, known[i], true, &element);
        if (!v) return fmi2Error;
        if (!isfinite(d_known[i])) return refuse(m, call, "%s: %g is not allowed in a direction: it must be finite", v->name, d_known[i]);
        if (v->causality == CAUSALITY_INPUT)
            ((double *)((char *)&inputs + v->offset))[element] += d_known[i];
        else if (v->state >= 0)
            state[v->state] += d_known[i];
        else
            return refuse(m, call, "%s is neither an input nor a state: there is no derivative by it", v->name);
    }
    Outputs derivatives;
    const fenv_t host = floating_point_default();
    part_directional_derivatives(m->part, &inputs, state, &derivatives);
    fesetenv(&host);
    return output_derivatives(m, call, &derivatives, unknown, n_unknown, d_unknown);
}

// ---- saved states: one block of bytes, in memory as in a file -------------------------------------------------------------------------------
typedef struct {
    char magic[8];
    uint64_t version;   // of this layout
    char guid[40];      // of the model
    char data[72];      // digest of data built in
    uint64_t size;      // of the whole block
    uint64_t checksum;  // of all that follows the header
} BlobHeader;

static const char BLOB_MAGIC[8] = "RBstate";
enum { BLOB_VERSION = 2 };

static size_t blob_size(void)
{
    return sizeof(BlobHeader) + sizeof(Session) + part_saved_size();
}

// FNV-1a, 64 bits: changes with any single byte.
static uint64_t blob_checksum(const unsigned char *blob)
{
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t i = sizeof(BlobHeader); i < blob_size(); i++) hash = (hash ^ blob[i]) * 0x100000001b3u;
    return hash;
}

// Why a block is not a state of this model; NULL if it is.
static const char *blob_problem(const unsigned char *blob, size_t size, bool checked)
{
    BlobHeader header;
    if (size < sizeof header) return "the saved state is truncated";
    memcpy(&header, blob, sizeof header);
    if (memcmp(header.magic, BLOB_MAGIC, sizeof header.magic) != 0) return "this is not a saved state of a " MODEL_IDENTIFIER;
    if (header.version != BLOB_VERSION) return "the saved state is of another version of this FMU";
    if (strncmp(header.guid, MODEL_GUID, sizeof header.guid) != 0) return "the saved state is of another model (its GUID is not " MODEL_GUID ")";
    if (strncmp(header.data, part_data_digest(), sizeof header.data) != 0)
        return "the saved state is of an FMU with other data built in (of a bearing: another rivet table)";
    if (header.size != blob_size()) return "the saved state is of another build of this FMU (its size differs)";
    if (size != header.size) return "the saved state is truncated or too long";
    if (checked && header.checksum != blob_checksum(blob)) return "the saved state is corrupted (its checksum is wrong)";
    return NULL;
}

fmi2Status fmi2GetFMUstate(fmi2Component component, fmi2FMUstate *state)
{
    Instance *m = enter(component, CALL_GetFMUstate);
    if (!m) return fmi2Error;
    if (!state) return refuse(m, CALL_GetFMUstate, "a null pointer for the state");
    unsigned char *blob = *state ? *state : calloc(1, blob_size());
    if (!blob) return refuse(m, CALL_GetFMUstate, "out of memory");
    BlobHeader header = {.version = BLOB_VERSION, .guid = MODEL_GUID, .size = blob_size()};
    memcpy(header.magic, BLOB_MAGIC, sizeof header.magic);
    snprintf(header.data, sizeof header.data, "%s", part_data_digest());
    memcpy(blob, &header, sizeof header);
    memcpy(blob + sizeof header, &m->session, sizeof m->session);
    part_save(m->part, blob + sizeof header + sizeof m->session);
    *state = blob;
    return fmi2OK;
}

fmi2Status fmi2SetFMUstate(fmi2Component component, fmi2FMUstate state)
{
    Instance *m = enter(component, CALL_SetFMUstate);
    if (!m) return fmi2Error;
    const unsigned char *blob = state;
    const char *problem = blob ? blob_problem(blob, blob_size(), false) : "a null pointer for the state";
    if (problem) return refuse(m, CALL_SetFMUstate, "%s", problem);
    memcpy(&m->session, blob + sizeof(BlobHeader), sizeof m->session);
    part_restore(m->part, blob + sizeof(BlobHeader) + sizeof m->session);
    return fmi2OK;
}

fmi2Status fmi2FreeFMUstate(fmi2Component component, fmi2FMUstate *state)
{
    Instance *m = enter(component, CALL_FreeFMUstate);
    if (!m) return fmi2Error;
    if (!state) return fmi2OK;
    free(*state);
    *state = NULL;
    return fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component component, fmi2FMUstate state, size_t *size)
{
    Instance *m = enter(component, CALL_SerializedFMUstateSize);
    if (!m) return fmi2Error;
    if (!state || !size) return refuse(m, CALL_SerializedFMUstateSize, "a null pointer");
    *size = blob_size();
    return fmi2OK;
}

fmi2Status fmi2SerializeFMUstate(fmi2Component component, fmi2FMUstate state, fmi2Byte bytes[], size_t size)
{
    Instance *m = enter(component, CALL_SerializeFMUstate);
    if (!m) return fmi2Error;
    if (!state || !bytes) return refuse(m, CALL_SerializeFMUstate, "a null pointer");
    if (size < blob_size()) return refuse(m, CALL_SerializeFMUstate, "size = %zu is not allowed: the state has %zu bytes", size, blob_size());
    BlobHeader header;
    memcpy(&header, state, sizeof header);
    header.checksum = blob_checksum(state);
    memcpy(bytes, &header, sizeof header);
    memcpy(bytes + sizeof header, (const unsigned char *)state + sizeof header, blob_size() - sizeof header);
    return fmi2OK;
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component component, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state)
{
    Instance *m = enter(component, CALL_DeSerializeFMUstate);
    if (!m) return fmi2Error;
    if (!bytes || !state) return refuse(m, CALL_DeSerializeFMUstate, "a null pointer");
    const char *problem = blob_problem((const unsigned char *)bytes, size, true);
    if (problem) return refuse(m, CALL_DeSerializeFMUstate, "%s", problem);
    if (!*state) *state = calloc(1, blob_size());
    if (!*state) return refuse(m, CALL_DeSerializeFMUstate, "out of memory");
    memcpy(*state, bytes, blob_size());
    return fmi2OK;
}

// ---- steps ----------------------------------------------------------------------------------------------------------------------------------
// Rounding that a host's clock may have, t += h or k h or in nanoseconds, against the end of the last step.
static double clock_slack(double time, double step)
{
    return 1e-12 * fabs(time) + 1e-6 * step;
}

static fmi2Status do_step(Instance *m, double point, double step)
{
    const double time = part_time(m->part), end = point + step;
    if (!(isfinite(step) && step > 0.0)) {
        return refuse(m, CALL_DoStep, "communicationStepSize = %g s is not allowed: it must be positive and finite", step);
    }
    if (!(fabs(point - time) <= clock_slack(time, step))) {
        return refuse(m, CALL_DoStep, "currentCommunicationPoint = %.17g s is not allowed: the last step ended at %.17g s", point, time);
    }
    if (end > m->session.stop_time + clock_slack(m->session.stop_time, step)) {
        return refuse(m, CALL_DoStep, "communicationStepSize = %g s is not allowed: the step goes beyond stopTime = %.17g s", step, m->session.stop_time);
    }
    return conclude(m, end > time ? part_step(m->part, end) : PART_OK);
}

fmi2Status fmi2DoStep(fmi2Component component, fmi2Real point, fmi2Real step, fmi2Boolean no_earlier_state)
{
    (void)no_earlier_state;  // nothing is kept for it
    Instance *m = enter(component, CALL_DoStep);
    if (!m) return fmi2Error;
    const fenv_t host = floating_point_default();
    const fmi2Status status = do_step(m, point, step);
    fesetenv(&host);
    m->session.step_status = status;
    return status;
}

fmi2Status fmi2CancelStep(fmi2Component component)
{
    enter(component, CALL_CancelStep);
    return fmi2Error;
}

// Answers of the status functions: fmi2Discard where there is no such status (FMI 2.0.4, section 4.2.3).
fmi2Status fmi2GetStatus(fmi2Component component, const fmi2StatusKind kind, fmi2Status *value)
{
    Instance *m = enter(component, CALL_GetStatus);
    if (!m) return fmi2Error;
    if (!value) return refuse(m, CALL_GetStatus, "a null pointer");
    if (kind != fmi2DoStepStatus) return fmi2Discard;
    *value = (fmi2Status)m->session.step_status;
    return fmi2OK;
}

fmi2Status fmi2GetRealStatus(fmi2Component component, const fmi2StatusKind kind, fmi2Real *value)
{
    Instance *m = enter(component, CALL_GetRealStatus);
    if (!m) return fmi2Error;
    if (!value) return refuse(m, CALL_GetRealStatus, "a null pointer");
    if (kind != fmi2LastSuccessfulTime) return fmi2Discard;
    *value = part_time(m->part);
    return fmi2OK;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component component, const fmi2StatusKind kind, fmi2Integer *value)
{
    (void)kind;
    Instance *m = enter(component, CALL_GetIntegerStatus);
    if (!m) return fmi2Error;
    return value ? fmi2Discard : refuse(m, CALL_GetIntegerStatus, "a null pointer");
}

fmi2Status fmi2GetBooleanStatus(fmi2Component component, const fmi2StatusKind kind, fmi2Boolean *value)
{
    Instance *m = enter(component, CALL_GetBooleanStatus);
    if (!m) return fmi2Error;
    if (!value) return refuse(m, CALL_GetBooleanStatus, "a null pointer");
    if (kind != fmi2Terminated) return fmi2Discard;
    *value = m->session.phase == FAILED;
    return fmi2OK;
}

// fmi2PendingStatus: the last error or warning.
fmi2Status fmi2GetStringStatus(fmi2Component component, const fmi2StatusKind kind, fmi2String *value)
{
    Instance *m = enter(component, CALL_GetStringStatus);
    if (!m) return fmi2Error;
    if (!value) return refuse(m, CALL_GetStringStatus, "a null pointer");
    if (kind != fmi2PendingStatus) return fmi2Discard;
    *value = m->message;
    return fmi2OK;
}

// ---- not offered ------------------------------------------------------------------------------------------------------------------------------
// Model exchange: exported because some importers refuse a binary without these symbols.
fmi2Status fmi2EnterEventMode(fmi2Component c)
{
    return refuse_unsupported(c, "fmi2EnterEventMode");
}
fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *info)
{
    (void)info;
    return refuse_unsupported(c, "fmi2NewDiscreteStates");
}
fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c)
{
    return refuse_unsupported(c, "fmi2EnterContinuousTimeMode");
}
fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean no_earlier_state, fmi2Boolean *enter_event_mode, fmi2Boolean *terminate)
{
    (void)no_earlier_state, (void)enter_event_mode, (void)terminate;
    return refuse_unsupported(c, "fmi2CompletedIntegratorStep");
}
fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time)
{
    (void)time;
    return refuse_unsupported(c, "fmi2SetTime");
}
fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t n)
{
    (void)x, (void)n;
    return refuse_unsupported(c, "fmi2SetContinuousStates");
}
fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real derivatives[], size_t n)
{
    (void)derivatives, (void)n;
    return refuse_unsupported(c, "fmi2GetDerivatives");
}
fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real indicators[], size_t n)
{
    (void)indicators, (void)n;
    return refuse_unsupported(c, "fmi2GetEventIndicators");
}
fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t n)
{
    (void)x, (void)n;
    return refuse_unsupported(c, "fmi2GetContinuousStates");
}
fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real nominals[], size_t n)
{
    (void)nominals, (void)n;
    return refuse_unsupported(c, "fmi2GetNominalsOfContinuousStates");
}
