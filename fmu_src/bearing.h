// The bearing model as its users see it: one instance, its parameters, inputs and outputs, and what can be done with it.
// The wrapper (fmi2_wrapper.c) and the tests include this file only.  Parameters, Inputs and Outputs come from fmus/variables.toml.
#pragma once

#include "variables.h"

#include <stdbool.h>
#include <stddef.h>

typedef enum {
    BEARING_OK = 0,
    BEARING_WARNING,  // done, and the log says what to look at
    BEARING_DISCARD,  // the solver cannot go on: time and outputs are those of the last good state
    BEARING_ERROR,    // refused: the log names variable, value and what is allowed; nothing has changed
    BEARING_FATAL     // out of memory
} BearingStatus;

// Message categories, in the order of the logger categories of the FMU.
typedef enum { LOG_ERROR, LOG_WARNING, LOG_EVENT, LOG_SOLVER } LogCategory;

// What the model needs from its host.
typedef struct {
    void *environment;
    void (*log)(void *environment, LogCategory category, const char *message);
} BearingHost;

typedef struct Bearing Bearing;

enum { INPUT_ORDERS = 2 };  // inputs are polynomials of time up to this order inside a step

Bearing *bearing_create(const BearingHost *host);  // with the start values of the variable table; NULL if out of memory
void bearing_destroy(Bearing *bearing);            // NULL is allowed
void bearing_reset(Bearing *bearing);              // as newly created

Parameters *bearing_parameters(Bearing *bearing);  // may be changed before bearing_initialize
// Inputs (order 0) and their derivatives (1...INPUT_ORDERS) at the present time; may be changed before each step, which leaves the inputs where
// they have got to and the derivatives 0.
Inputs *bearing_inputs(Bearing *bearing, int order);
const Outputs *bearing_outputs(const Bearing *bearing);
double *bearing_state(Bearing *bearing);  // y, offsets in variables.h
double bearing_time(const Bearing *bearing);

// Checks all parameters and inputs, derives constants, finds the quasi-static start.  tolerance 0: solver.tol.
BearingStatus bearing_initialize(Bearing *bearing, double t_start, double tolerance);

// Integrates to t_end along the inputs' polynomials, held where there are no derivatives.
BearingStatus bearing_step(Bearing *bearing, double t_end);

// Makes the outputs of one group (GROUP_* of variables.h) current; cheap if they are.  Changes no bit of the future.
void bearing_update(Bearing *bearing, OutputGroup group);

// Derivatives of all outputs: by time, inputs going on as they came, and along a direction of inputs and states (arrays as y).  What is recorded
// over steps (peaks, statistics, fatigue, solver) is held between them: derivative 0.
void bearing_time_derivatives(Bearing *bearing, Outputs *derivatives);
void bearing_directional_derivatives(Bearing *bearing, const Inputs *inputs, const double state[N_STATES], Outputs *derivatives);

// The whole state as one block of plain bytes: equal blocks continue bit for bit alike.
size_t bearing_saved_size(void);
void bearing_save(const Bearing *bearing, void *saved);
void bearing_restore(Bearing *bearing, const void *saved);

// Digest of the embedded rivet table, which the saved state does not hold.
const char *bearing_table_digest(void);
