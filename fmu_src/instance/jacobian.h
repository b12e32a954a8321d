// Derivatives of the right-hand side and of the outputs, exact to rounding: the kernel files themselves in
// dual numbers (dual.h).
//
// Inside jacobian.c the structs of model.h hold a dual number in place of every scalar.  Its functions take
// and give these structs as arrays of doubles, in the order of the members.  At a kink (touch-down of a
// damped contact, start of slip) the derivative is that of one side.
#pragma once

#include "physics/model.h"

// Derivatives of all outputs along dt of time, du of the inputs and dy of the states.
//
// trajectory: the InputTrajectory at time t.  du: Inputs, or NULL for 0.  d_out: Outputs; those that are
// recorded over steps (peaks, statistics, fatigue, solver) do not follow from one evaluation, and their
// derivatives are 0.
void jacobian_outputs(const Model *model, const double *trajectory, double t, double dt, const double *du,
                      const double *y, const double *dy, double *d_out);
