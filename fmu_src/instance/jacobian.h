// Derivatives of the right-hand side and of the outputs, exact to rounding: the kernel files themselves in
// dual numbers (dual.h).
//
// Inside jacobian.c the structs of model.h hold a dual number in place of every scalar.  Its functions take
// and give these structs as arrays of doubles, in the order of the members.  At a kink (touch-down of a
// damped contact, start of slip) the derivative is that of one side.
#pragma once

#include "physics/model.h"

// Derivative of y_dot(t, y, ring load) along the direction (dy, d_ring_load):
//     dy_dot = J dy + d(y_dot)/d(ring load) d_ring_load
// d_ring_load: a RingLoad, or NULL for 0.  dw: a Work for the derivatives of all results of the right-hand
// side, or NULL.  One product costs as much as some five right-hand sides.
void jacobian_product(const Model *model, double t, const double *y, const double *dy,
                      const double *d_ring_load, double *dy_dot, double *dw);

// Derivatives of all outputs along dt of time, du of the inputs and dy of the states.
//
// trajectory: the InputTrajectory at time t.  du: Inputs, or NULL for 0.  d_out: Outputs; those that are
// recorded over steps (peaks, statistics, fatigue, solver) do not follow from one evaluation, and their
// derivatives are 0.
void jacobian_outputs(const Model *model, const double *trajectory, double t, double dt, const double *du,
                      const double *y, const double *dy, double *d_out);

// Derivative of the housing's reaction (powers.h) from results and their derivative (Work).
void jacobian_housing(const double *w, const double *dw, double dF[3], double dM[3]);
