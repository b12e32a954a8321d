// Creation, logging, call order, initialization and end of an instance (FMI 2.0.4, sections 2.1.5 and 2.1.6).
#include "host/fmi2_instance.h"
#include "numbers/saved_numbers.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define NAME_AND_PHASES(name, phases, parameters, arguments) {"fmi2" #name, phases},

static const struct {
    const char *name;
    unsigned phases;
} CALLS[] = {FMI2_CALLS(NAME_AND_PHASES)};

static const char *phase_name(uint32_t phase)
{
    return phase == INSTANTIATED   ? "instantiated"
           : phase == INITIALIZING ? "initialization mode"
           : phase == STEPPING     ? "step complete"
           : phase == FAILED       ? "step failed"
           : phase == TERMINATED   ? "terminated"
                                   : "error";
}

static const Session NEW_SESSION = {.phase = INSTANTIATED, .stop_time = INFINITY};

// In the order of LogCategory.  Without logging, only the reason of fmi2Error or fmi2Discard is sent.
static const char *const CATEGORIES[] = {"logStatusError", "logStatusWarning", "logEvents", "logSolver"};

enum { N_CATEGORIES = sizeof CATEGORIES / sizeof CATEGORIES[0], ALL_CATEGORIES = (1 << N_CATEGORIES) - 1 };

enum { ALWAYS_SENT = 1 << LOG_ERROR };

// Hosts read the message as a printf format and '#' as the start of a value reference: both are doubled.  The
// logger runs in the host's floating-point environment; the host keeps the environment that the logger leaves.
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

void instance_log(void *environment, LogCategory category, const char *message)
{
    Instance *m = environment;
    if (category == LOG_ERROR || category == LOG_WARNING)
        snprintf(m->message, sizeof m->message, "%s", message);
    if (m->categories & 1u << category) send(&m->callbacks, m->host_floats, m->name, category, message);
}

fmi2Status refuse(Instance *m, const char *format, ...)
{
    char reason[400], message[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(reason, sizeof reason, format, arguments);
    va_end(arguments);
    snprintf(message, sizeof message, "%s at t = %.9g s: %s", CALLS[m->call].name, part_time(m->part),
             reason);
    instance_log(m, LOG_ERROR, message);
    m->session.phase = ERRONEOUS;
    return fmi2Error;
}

bool instance_enter(fmi2Component c, Call call, FloatEnvironment *host_floats)
{
    Instance *m = c;
    if (!m) return false;
    m->host_floats = host_floats;
    m->call = call;
    if (m->session.phase & CALLS[call].phases) return true;
    refuse(m, "not allowed in state \"%s\"", phase_name(m->session.phase));
    return false;
}

void instance_refuse_unsupported(fmi2Component c, const char *function, FloatEnvironment *host_floats)
{
    Instance *m = c;
    if (!m) return;
    m->host_floats = host_floats;
    char message[128];
    snprintf(message, sizeof message, "%s is not offered by this FMU (see its capability flags)", function);
    instance_log(m, LOG_ERROR, message);
    m->session.phase = ERRONEOUS;
}

fmi2Status conclude(Instance *m, PartStatus status)
{
    switch (status) {
    case PART_OK: return fmi2OK;
    case PART_WARNING: return fmi2Warning;
    case PART_DISCARD: m->session.phase = FAILED; return fmi2Discard;
    case PART_ERROR: break;
    }
    m->session.phase = ERRONEOUS;
    return fmi2Error;
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

fmi2Status instance_initialize(Instance *m)
{
    if (m->session.initialized) return fmi2OK;
    renew(m->part);
    PartStatus status = part_initialize(m->part, m->session.start_time, m->session.tolerance);
    if (status == PART_DISCARD) status = PART_ERROR;
    m->session.initialized = status == PART_OK || status == PART_WARNING;
    if (!m->session.initialized) renew(m->part);
    return conclude(m, status);
}

void forget_start(Instance *m)
{
    if (m->session.phase != INITIALIZING || !m->session.initialized) return;
    renew(m->part);
    m->session.initialized = false;
}

static const char *instantiation_problem(fmi2String name, fmi2Type type, fmi2String guid)
{
    if (!name || !*name) return "fmi2Instantiate: the instance name is empty";
    if (type != fmi2CoSimulation) return "fmi2Instantiate: this FMU offers co-simulation only";
    if (!guid || strcmp(guid, MODEL_GUID) != 0)
        return "fmi2Instantiate: the GUID is not " MODEL_GUID
               ": description and binary do not belong together";
    return NULL;
}

void instance_destroy(fmi2Component c, FloatEnvironment *host_floats)
{
    Instance *m = c;
    if (!m) return;
    m->host_floats = host_floats;
    part_destroy(m->part);
    free(m->name);
    free(m);
}

fmi2Component instance_create(fmi2String name, fmi2Type type, fmi2String guid,
                              const fmi2CallbackFunctions *functions, fmi2Boolean logging,
                              FloatEnvironment *host_floats)
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
        instance_destroy(m, host_floats);
    }
    send(functions, host_floats, name ? name : "", LOG_ERROR,
         problem ? problem : "fmi2Instantiate: out of memory");
    return NULL;
}

// Unknown categories are ignored with a warning.
fmi2Status slave_SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n, const fmi2String categories[])
{
    Instance *m = c;
    if (n > 0 && !categories) return refuse(m, "no categories given");
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

fmi2Status slave_SetupExperiment(fmi2Component c, fmi2Boolean tolerance_defined, fmi2Real tolerance,
                                 fmi2Real start_time, fmi2Boolean stop_time_defined, fmi2Real stop_time)
{
    Instance *m = c;
    if (!values_are_within(&start_time, 1, LARGEST_TIME)) {
        return refuse(m, "startTime = %g s is not allowed: it must lie within +-%g s", start_time,
                      LARGEST_TIME);
    }
    if (stop_time_defined && !(stop_time >= start_time)) {
        return refuse(m, "stopTime = %g s is not allowed: it must not lie before startTime = %g s", stop_time,
                      start_time);
    }
    m->session.tolerance = tolerance_defined ? admissible_tolerance(m, tolerance) : 0.0;
    m->session.start_time = start_time;
    m->session.stop_time = stop_time_defined ? stop_time : INFINITY;
    return fmi2OK;
}

fmi2Status slave_EnterInitializationMode(fmi2Component c)
{
    Instance *m = c;
    m->session.phase = INITIALIZING;
    return fmi2OK;
}

fmi2Status slave_ExitInitializationMode(fmi2Component c)
{
    Instance *m = c;
    const fmi2Status status = instance_initialize(m);
    if (status <= fmi2Warning) m->session.phase = STEPPING;
    return status;
}

fmi2Status slave_Terminate(fmi2Component c)
{
    Instance *m = c;
    m->session.phase = TERMINATED;
    return fmi2OK;
}

fmi2Status slave_Reset(fmi2Component c)
{
    Instance *m = c;
    part_reset(m->part);
    m->session = NEW_SESSION;
    m->message[0] = '\0';
    m->warned_of_clock = false;
    return fmi2OK;
}
