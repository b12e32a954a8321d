// The default step as a time-stepping module of ARKODE.
//
// ARKStep, ERKStep, SPRKStep and MRIStep are such modules: a table of functions behind ARKodeEvolve, which keeps time and
// stop time, tests errors, repeats refused steps, counts, asks the SUNAdaptController and reports failures.  This module
// has one entry of its own, the step (verlet.c); it estimates its own error, so that ARKODE's error weights and norms
// have nothing to do.
//
// A table of functions of ARKODE is not part of its public interface: bearing_step.c is the one file that includes a
// private header of SUNDIALS, and cmake/sundials.cmake stops if another version of SUNDIALS is given.
#pragma once

#include <sundials/sundials_nvector.h>
#include <sundials/sundials_types.h>

// The step's three functions; `context` is the integrator's.
typedef struct {
    // Length of the next attempt, if `left` [s] are left to the stop time.
    double (*length)(void *context, double left);

    // Takes the step of length h [s] at time t; returns the norm of its error, acceptable up to 1.  NaN: the step has left
    // the range of the model.
    double (*take)(void *context, double t, double h);

    void *context;
} BearingStep;

// A memory of ARKODE that steps by `step`, to be used with ARKodeEvolve, ARKodeReset and the other functions of ARKODE;
// NULL if there is no memory.  y: the vector that ARKodeEvolve will be given; the state itself is the integrator's.
void *bearing_step_create(SUNContext sun, N_Vector y, const BearingStep *step);
