// Integration of the right-hand side in time with control of the error (docs/method.md).  Of the solvers
// only integrator, bearing_step and kernels use SUNDIALS.
#pragma once

#include "solver/kernels.h"

// All that the integrator carries from one advance to the next; plain bytes, part of the saved state.
typedef struct {
    double t;
    VerletState now;
    double h;          // step size to go on with [s]
    int f_is_current;  // now.f is dy/dt at now.y under the present load of the ring
    Exchange sum;      // exchanged and lost since the last communication point: integrals over time
    double since;      // time of that point [s]
    double steps, rhs_evals, error_tests_failed;  // counts since the start
    double
        error_mean;  // over the last 10 ms / error that is accepted, of equal steps that of the default method
} IntegratorState;

typedef struct Integrator Integrator;

// Called after every accepted step of length h [s].  w: the last evaluation of the step, at its end; that of
// the default method is at the predicted velocities.
typedef void StepHook(void *context, double h, const Work *w);

typedef void IntegratorLog(void *context, const char *message);

// All memory is taken here; NULL if there is none.
Integrator *integrator_create(const Kernels *kernels, const Model *model, Work *w, IntegratorState *state,
                              StepHook *hook, IntegratorLog *log, void *context);
void integrator_destroy(Integrator *integrator);

// Whether steps of a scene with these parameters can have made the state.
bool integrator_state_is_valid(const IntegratorState *state, const Parameters *p);

// Error weights 1/(tolerance scale), the scale of each class of states in model->d.
void integrator_tolerance(Integrator *integrator, double tolerance);

// Makes now.f the derivative at the present state, if it is not.
void integrator_evaluate(Integrator *integrator);

// Sets the step of solver.method = fixed for the whole run: the given one, or one whose errors over 30 ms from the state at
// the start are small.  Leaves the state as it is, the results of other states in the work struct.
void integrator_fix_step(Integrator *integrator);

// Number of equal steps of that method in an advance of some length [s].
double fixed_steps(double step, double length);

// Steps to t_stop under the present load of the ring, at most max_steps.  Returns 0, ADVANCE_ESCAPED before a step that
// would end at a state of escape.h, whose evaluation is in w, or a negative code of ARKODE if it cannot go on; the
// state is then that of the last accepted step.
enum { ADVANCE_ESCAPED = 1 };

int integrator_advance(Integrator *integrator, double t_stop, long max_steps);
