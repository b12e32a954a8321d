// The right-hand side in dual numbers, for jacobian.c.  RingLoad and Work are dual inside; outside, here, they are arrays of doubles.
#pragma once

#include "model.h"

// Derivatives of y_dot and of all results along the direction dy of the states and d_ring_load of the drive (or NULL); dw may be NULL.
void tangent_rhs(const Model *model, double t, const double *y, const double *dy, const double *d_ring_load, double *dy_dot, double *dw);

// Derivatives of all outputs that follow from an evaluation, along dt of time, du of the inputs and dy of the states; those of the others are 0.
void tangent_outputs(const Model *model, const double *trajectory, double t, double dt, const double *du, const double *y, const double *dy, double *d_out);

// Derivative of the housing's reaction from that of the results.
void tangent_housing(const double *w, const double *dw, double dF[3], double dM[3]);
