// A part of a machine as its users see it: one instance, its parameters, inputs and outputs, and what can be done with it.
// The wrapper (fmi2_wrapper.c) includes this file only.  Parameters, Inputs and Outputs come from a table of variables: the bearing's is
// fmus/variables.toml, and bearing.c is what stands behind these functions; examples/transmission/shaft.c is another part behind the same wrapper.
#pragma once

#include "variable_table.h"

#include <stdbool.h>
#include <stddef.h>

typedef enum {
    PART_OK = 0,
    PART_WARNING,  // done, and the log says what to look at
    PART_DISCARD,  // the solver cannot go on: time and outputs are those of the last good state
    PART_ERROR,    // refused: the log names variable, value and what is allowed; nothing has changed
    PART_FATAL     // out of memory
} PartStatus;

// Message categories, in the order of the logger categories of the FMU.
typedef enum { LOG_ERROR, LOG_WARNING, LOG_EVENT, LOG_SOLVER } LogCategory;

// What a part needs from its host.
typedef struct {
    void *environment;
    void (*log)(void *environment, LogCategory category, const char *message);
} PartHost;

typedef struct Part Part;

enum { INPUT_ORDERS = 2 };  // inputs are polynomials of time up to this order inside a step

Part *part_create(const PartHost *host);  // with the start values of the variable table; NULL if out of memory
void part_destroy(Part *part);            // NULL is allowed
void part_reset(Part *part);              // as newly created

Parameters *part_parameters(Part *part);  // may be changed before part_initialize
// Inputs (order 0) and their derivatives (1...INPUT_ORDERS) at the present time; may be changed before each step, which leaves the inputs where
// they have got to and the derivatives 0.
Inputs *part_inputs(Part *part, int order);
const Outputs *part_outputs(const Part *part);
double *part_state(Part *part);  // y, offsets in variables.h
double part_time(const Part *part);

// Checks all parameters and inputs, derives constants, finds the start (the bearing's is quasi-static).  tolerance 0: the part's own.
PartStatus part_initialize(Part *part, double t_start, double tolerance);

// Integrates to t_end along the inputs' polynomials, held where there are no derivatives.
PartStatus part_step(Part *part, double t_end);

// Makes the outputs of one group (GROUP_* of variables.h) current; cheap if they are.  Changes no bit of the future.
void part_update(Part *part, OutputGroup group);

// Derivatives of all outputs: by time, inputs going on as they came, and along a direction of inputs and states (arrays as y).  What is recorded
// over steps (peaks, statistics, fatigue, solver) is held between them: derivative 0.
void part_time_derivatives(Part *part, Outputs *derivatives);
void part_directional_derivatives(Part *part, const Inputs *inputs, const double state[N_STATES], Outputs *derivatives);

// The whole state as one block of plain bytes: equal blocks continue bit for bit alike.
size_t part_saved_size(void);
void part_save(const Part *part, void *saved);
void part_restore(Part *part, const void *saved);

// Digest of data built in (the bearing's rivet table), which the saved state does not hold.
const char *part_data_digest(void);
