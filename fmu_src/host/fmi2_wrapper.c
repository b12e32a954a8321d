// A part (part.h) as an FMI 2.0 co-simulation slave: call order, value references, host time, logging, saved
// states.  No physics.
//
// A function that returns fmi2Error changes only the instance's phase (fmi2_calls.h).  It stays ERRONEOUS until
// fmi2Reset or fmi2SetFMUstate (FMI 2.0.4, section 2.1.3), and its outputs read NaN with fmi2Warning,
// so that a host which ignores the status shows no plausible result.
// fmi2Discard comes with fmi2Terminated and fmi2LastSuccessfulTime; the outputs then are those of the last good state.
//
// Here are the exported functions, each a shell around the function of its name in the files of FMI's chapters: fmi2_instance,
// fmi2_variables, fmi2_states, fmi2_derivatives, fmi2_steps.
#include "host/fmi2_instance.h"

// The statement in the core's floating-point environment; afterwards the host's.
#define GUARDED(statement) \
    FloatEnvironment host; \
    float_enter(&host);    \
    statement;             \
    float_leave(&host);

#define CALL(name, phases, parameters, arguments)                                               \
    fmi2Status fmi2##name parameters                                                            \
    {                                                                                           \
        GUARDED(const fmi2Status status =                                                       \
                    instance_enter(c, CALL_##name, &host) ? slave_##name arguments : fmi2Error) \
        return status;                                                                          \
    }
#define NOT_OFFERED(name, parameters)                                \
    fmi2Status fmi2##name parameters                                 \
    {                                                                \
        GUARDED(instance_refuse_unsupported(c, "fmi2" #name, &host)) \
        return fmi2Error;                                            \
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
    GUARDED(fmi2Component component = instance_create(name, type, guid, functions, logging, &host))
    return component;
}

void fmi2FreeInstance(fmi2Component c)
{
    GUARDED(instance_destroy(c, &host))
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
