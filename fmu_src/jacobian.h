// Derivatives of the right-hand side: the kernels themselves in dual numbers (dual.h).
#pragma once

#include "model.h"

// Derivative of y_dot(t, y, drive) along the direction (dy, d_ring_load), exact to rounding: dy_dot = J dy + d(y_dot)/d(drive) d_ring_load.  No d_ring_load:
// NULL. dw (or NULL) gets the derivative of every result of the right-hand side: contact loads, the wrench on the ring, ... At a kink (touch-down of a damped
// contact, start of slip) one side's derivative.  Cost: some five right-hand sides.
void jacobian_product(const Model *model, double t, const double *y, const double *dy, const RingLoad *d_ring_load, double *dy_dot, Work *dw);

// All derivatives by the states, column by column: J[j * N_STATES + i] = d(y_dot[i])/d(y[j]).
void jacobian_matrix(const Model *model, double t, const double *y, double *J);

// Derivatives of all outputs along dt of time, du of the inputs (or NULL) and dy of the states: exact as those of y_dot.
// course: of the inputs at time t.  What is recorded over steps (peaks, statistics, fatigue, solver) stays as it is: 0.
void jacobian_outputs(const Model *model, const InputTrajectory *trajectory, double t, double dt, const Inputs *du, const double *y, const double *dy,
                      Outputs *d_out);

// Derivative of the housing's reaction (housing.h) from results and their derivative.
void jacobian_housing(const Work *w, const Work *dw, double dF[3], double dM[3]);
