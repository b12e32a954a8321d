// One step of the default method.
#pragma once

#include "isa.h"
#include "model.h"

// A state, and what the method remembers of the way there.
typedef struct {
    double y[N_STATES];
    double f
        [N_STATES];  // its dy/dt; after a step: accelerations, friction states' mean rates over the step, power
    double
        jerk[N_STATES];  // change of f over the last step / its length, where the error is estimated from it
    double film[2][3];   // -dF/dv of each land's film there: yy, yz, zz
    double h;            // length of that step [s], 0: none yet
} VerletState;

// The step of length h from `from` at t to `to`; returns the weighted norm of its error.  w: the evaluation at the new positions.
typedef double VerletStep(const Model *model, double t, double h, const double *weight,
                          const VerletState *from, VerletState *to, Work *w);
VerletStep verlet_step;
