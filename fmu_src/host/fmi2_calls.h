// The functions of FMI 2.0, each once: phases in which it may be called (FMI 2.0.4, section 4.2.4),
// parameters, arguments.
//
// fmi2_wrapper.c makes three things of this table: the check of the call order, the names in messages, and
// the exported functions.  An exported function gives the core its floating-point environment, checks the
// call order, calls the function of the same name without "fmi2", and gives the host's environment back.  A
// function that is not in this table is not exported.
#pragma once

typedef enum {
    INSTANTIATED = 1,
    INITIALIZING = 2,
    STEPPING = 4,
    FAILED = 8,
    TERMINATED = 16,
    ERRONEOUS = 32
} Phase;

enum {
    STEPPED = STEPPING | FAILED | TERMINATED | ERRONEOUS,
    READABLE = INITIALIZING | STEPPED,
    ALIVE = INSTANTIATED | READABLE
};

// X(name, phases, parameters, arguments).  Steps are never in progress or canceled.  No directional
// derivatives in initialization mode: there the inputs act through the equilibrium, which has none.
// clang-format off
#define FMI2_CALLS(X)                                                                                                                                    \
    X(SetDebugLogging, ALIVE, (fmi2Component c, fmi2Boolean on, size_t n, const fmi2String categories[]), (c, on, n, categories))                         \
    X(SetupExperiment, INSTANTIATED,                                                                                                                     \
      (fmi2Component c, fmi2Boolean has_tolerance, fmi2Real tolerance, fmi2Real start, fmi2Boolean has_stop, fmi2Real stop),                              \
      (c, has_tolerance, tolerance, start, has_stop, stop))                                                                                              \
    X(EnterInitializationMode, INSTANTIATED, (fmi2Component c), (c))                                                                                      \
    X(ExitInitializationMode, INITIALIZING, (fmi2Component c), (c))                                                                                       \
    X(Terminate, STEPPING | FAILED, (fmi2Component c), (c))                                                                                               \
    X(Reset, ALIVE, (fmi2Component c), (c))                                                                                                               \
    X(GetReal, READABLE, (fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Real value[]), (c, vr, n, value))                                 \
    X(GetInteger, READABLE, (fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Integer value[]), (c, vr, n, value))                           \
    X(GetBoolean, READABLE, (fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Boolean value[]), (c, vr, n, value))                           \
    X(GetString, READABLE, (fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2String value[]), (c, vr, n, value))                             \
    X(SetReal, SETTABLE, (fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Real value[]), (c, vr, n, value))                           \
    X(SetInteger, SETTABLE, (fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Integer value[]), (c, vr, n, value))                     \
    X(SetBoolean, SETTABLE, (fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Boolean value[]), (c, vr, n, value))                     \
    X(SetString, SETTABLE, (fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2String value[]), (c, vr, n, value))                       \
    X(GetFMUstate, ALIVE, (fmi2Component c, fmi2FMUstate *state), (c, state))                                                                             \
    X(SetFMUstate, ALIVE, (fmi2Component c, fmi2FMUstate state), (c, state))                                                                              \
    X(FreeFMUstate, ALIVE, (fmi2Component c, fmi2FMUstate *state), (c, state))                                                                            \
    X(SerializedFMUstateSize, ALIVE, (fmi2Component c, fmi2FMUstate state, size_t *size), (c, state, size))                                               \
    X(SerializeFMUstate, ALIVE, (fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size), (c, state, bytes, size))                            \
    X(DeSerializeFMUstate, ALIVE, (fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state), (c, bytes, size, state))                   \
    X(SetRealInputDerivatives, SETTABLE,                                                                                                                 \
      (fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Integer order[], const fmi2Real value[]), (c, vr, n, order, value))             \
    X(GetRealOutputDerivatives, STEPPED,                                                                                                                 \
      (fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Integer order[], fmi2Real value[]), (c, vr, n, order, value))                   \
    X(GetDirectionalDerivative, STEPPED,                                                                                                                 \
      (fmi2Component c, const fmi2ValueReference unknown[], size_t n_unknown, const fmi2ValueReference known[], size_t n_known,                           \
       const fmi2Real d_known[], fmi2Real d_unknown[]),                                                                                                  \
      (c, unknown, n_unknown, known, n_known, d_known, d_unknown))                                                                                       \
    X(DoStep, STEPPING, (fmi2Component c, fmi2Real point, fmi2Real step, fmi2Boolean no_earlier_state), (c, point, step, no_earlier_state))               \
    X(GetStatus, STEPPED, (fmi2Component c, const fmi2StatusKind kind, fmi2Status *value), (c, kind, value))                                              \
    X(GetRealStatus, STEPPED, (fmi2Component c, const fmi2StatusKind kind, fmi2Real *value), (c, kind, value))                                            \
    X(GetIntegerStatus, STEPPED, (fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value), (c, kind, value))                                      \
    X(GetBooleanStatus, STEPPED, (fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value), (c, kind, value))                                      \
    X(GetStringStatus, STEPPED, (fmi2Component c, const fmi2StatusKind kind, fmi2String *value), (c, kind, value))

enum { SETTABLE = INSTANTIATED | INITIALIZING | STEPPING };

// X(name, parameters): asynchronous steps, and model exchange, which is exported because some importers
// refuse a binary without these symbols.
#define FMI2_NOT_OFFERED(X)                                                                                                                              \
    X(CancelStep, (fmi2Component c))                                                                                                                      \
    X(EnterEventMode, (fmi2Component c))                                                                                                                  \
    X(NewDiscreteStates, (fmi2Component c, fmi2EventInfo *info))                                                                                          \
    X(EnterContinuousTimeMode, (fmi2Component c))                                                                                                         \
    X(CompletedIntegratorStep, (fmi2Component c, fmi2Boolean no_earlier_state, fmi2Boolean *enter_event_mode, fmi2Boolean *terminate))                    \
    X(SetTime, (fmi2Component c, fmi2Real time))                                                                                                          \
    X(SetContinuousStates, (fmi2Component c, const fmi2Real x[], size_t n))                                                                               \
    X(GetDerivatives, (fmi2Component c, fmi2Real derivatives[], size_t n))                                                                                \
    X(GetEventIndicators, (fmi2Component c, fmi2Real indicators[], size_t n))                                                                             \
    X(GetContinuousStates, (fmi2Component c, fmi2Real x[], size_t n))                                                                                     \
    X(GetNominalsOfContinuousStates, (fmi2Component c, fmi2Real nominals[], size_t n))
// clang-format on
