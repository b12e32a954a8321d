// A part of a machine as its users see it: one instance, with its parameters, inputs and outputs, and the
// functions on it.
//
// The wrapper (host/) includes this file only.  Parameters, Inputs and Outputs come from a table of
// variables; the bearing's table is fmus/variables.toml.  bearing.c implements these functions for the
// bearing, examples/transmission/shaft.c for a shaft behind the same wrapper.
#pragma once

#include "numbers/variable_table.h"

#include <stdbool.h>
#include <stddef.h>

typedef enum {
    PART_OK = 0,
    PART_WARNING,  // done, with a warning in the log
    PART_DISCARD,  // the solver cannot go on: time and outputs are those of the last good state
    PART_ERROR     // refused: the log names variable, value and allowed range; nothing has changed
} PartStatus;

// Message categories, in the order of the logger categories of the FMU.
typedef enum { LOG_ERROR, LOG_WARNING, LOG_EVENT, LOG_SOLVER } LogCategory;

// Services of the host that a part uses.
typedef struct {
    void *environment;
    void (*log)(void *environment, LogCategory category, const char *message);
} PartHost;

typedef struct Part Part;

// A new part with the start values of the variable table; NULL if out of memory.
Part *part_create(const PartHost *host);
void part_destroy(Part *part);  // NULL is allowed
void part_reset(Part *part);    // as newly created, but for the processor time it has used

// May be changed before part_initialize, and those that are not fixed before each step, which they are in force from.
Parameters *part_parameters(Part *part);
// Inputs (order 0) and their derivatives (1...INPUT_ORDERS) at the present time.  The host may change them
// before each step.  After a step the inputs have the values that their polynomials have reached, and the
// derivatives are 0.
Inputs *part_inputs(Part *part, int order);
const Outputs *part_outputs(const Part *part);
double part_time(const Part *part);

// Checks all parameters and inputs, derives constants and finds the start (that of the bearing is
// quasi-static).  tolerance 0: the part's own tolerance.
PartStatus part_initialize(Part *part, double t_start, double tolerance);

// Integrates to t_end, with the inputs following their polynomials; inputs without derivatives are held.
PartStatus part_step(Part *part, double t_end);

// Brings the outputs of one group (GROUP_* of variables.h) up to date; does nothing if they are.  The future
// of the instance does not depend on this call, to the bit.
void part_update(Part *part, OutputGroup group);

// Derivatives of all outputs: by time, with the inputs' polynomials continued, and along a direction of
// inputs and states (an array as y).  Outputs that are recorded over steps (peaks, statistics, fatigue,
// solver) do not change between steps: their derivatives are 0.
void part_time_derivatives(Part *part, Outputs *derivatives);
void part_directional_derivatives(Part *part, const Inputs *inputs, const double state[N_ALL_STATES],
                                  Outputs *derivatives);

// The whole state as one block of plain bytes.  Instances with equal blocks continue alike, bit for bit.
size_t part_saved_size(void);
void part_save(Part *part, void *saved);
void part_restore(Part *part, const void *saved);

// Restores a state from bytes of unknown origin: false, with the reason in the log, unless every count, index, choice
// and time lies in its range, all values are numbers, and so are all outputs there.  A part that refuses can
// only be reset or destroyed.
bool part_restore_unknown(Part *part, const void *saved);

bool part_is_initialized(const Part *part);

// Digest of data that are built in and not part of the saved state: the bearing's rivet table.
const char *part_data_digest(void);
