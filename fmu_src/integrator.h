// Integration of the right-hand side with control of the error.  The only file that knows SUNDIALS is integrator.c.
#pragma once

#include "kernels.h"

// What the integrator carries from step to step; plain bytes, part of the saved state.
typedef struct {
    double t;
    VerletState now;
    double h;          // step size to start with [s]
    int f_is_current;  // now.f belongs to now.y and the present drive
    double steps, rhs_evals, error_tests_failed;
} IntegratorState;

typedef struct Integrator Integrator;

// Called after every accepted step and at the start: w holds the results at (state->t, state->y), h is the length of the step just taken.
typedef void StepHook(void *context, double h, const Work *w);

typedef void IntegratorLog(void *context, const char *message);

// NULL if out of memory.  All memory is taken here.
Integrator *integrator_create(const Kernels *kernels, const Model *model, Work *w, IntegratorState *state, StepHook *hook, IntegratorLog *log, void *context);
void integrator_destroy(Integrator *integrator);

// Error weights for the tolerance; scale of each state class in model->d.
void integrator_tolerance(Integrator *integrator, double tolerance);

// now.f at the present state; cheap if known.
void integrator_evaluate(Integrator *integrator);

// Steps to t_stop with the present drive, at most max_steps.  0, or < 0 if it cannot go on: then the state is the last good one.
int integrator_advance(Integrator *integrator, double t_stop, long max_steps);
