// One FMI instance around a part, and the functions of FMI's chapters that the exported ones call.  For the files of this folder only.
#pragma once

#include "host/float_environment.h"
#include "host/fmi2_calls.h"
#include "instance/part.h"

#include "fmi2Functions.h"

#include <stdint.h>

#define CALL_OF(name, phases, parameters, arguments) CALL_##name,
#define PROTOTYPE(name, phases, parameters, arguments) \
    fmi2##name##TYPE slave_##name __attribute__((noinline));

typedef enum { FMI2_CALLS(CALL_OF) } Call;

// Not inlined, so that no arithmetic moves out of the floating-point environment that exported functions make.
FMI2_CALLS(PROTOTYPE)

typedef struct {
    uint32_t phase;        // Phase
    uint32_t initialized;  // in initialization mode: the start belongs to the present parameters and inputs
    double start_time;     // [s]
    double stop_time;      // [s], infinite if none
    double tolerance;      // 0: solver.tol
    uint64_t step_status;  // fmi2Status of the last step
} Session;                 // saved with the state of the part

typedef struct {
    Part *part;
    Session session;
    Call call;  // that runs, or ran last
    PartHost host;
    FloatEnvironment *host_floats;  // during a call: the host's floating-point environment
    fmi2CallbackFunctions callbacks;
    char *name;
    unsigned categories;  // that are sent: bits 1 << LogCategory
    char message[512];    // the last error or warning, sent or not
    bool warned_of_clock;
} Instance;

// Creation and destruction; host_floats: the host's floating-point environment.
fmi2Component instance_create(fmi2String name, fmi2Type type, fmi2String guid,
                              const fmi2CallbackFunctions *functions, fmi2Boolean logging,
                              FloatEnvironment *host_floats) __attribute__((noinline));
void instance_destroy(fmi2Component c, FloatEnvironment *host_floats) __attribute__((noinline));

// Whether the call is allowed now.
bool instance_enter(fmi2Component c, Call call, FloatEnvironment *host_floats) __attribute__((noinline));

// For functions that are not offered.
void instance_refuse_unsupported(fmi2Component c, const char *function, FloatEnvironment *host_floats)
    __attribute__((noinline));

void instance_log(void *environment, LogCategory category, const char *message);

// Logs the reason for which the call is refused; the instance is in error from then on.
fmi2Status refuse(Instance *m, const char *format, ...) __attribute__((format(printf, 2, 3)));

// The status of the core as FMI's, with the phase that follows.
fmi2Status conclude(Instance *m, PartStatus status);

// The start for the present parameters and inputs: an earlier start, made to read outputs, leaves no trace,
// nor does one that fails. A step cannot be discarded here: there is no last good state.
fmi2Status instance_initialize(Instance *m);

// Parameters or inputs have changed: in initialization mode the start that outputs were read from is none any more.
void forget_start(Instance *m);

// Distance between the host's clock and the FMU's that double precision alone explains.
double clock_rounding(const Session *s, double time, double step);

// The variable of a value reference, if it has the right type.
const Variable *find_variable(Instance *m, fmi2ValueReference reference, bool real, int *element);
