// The start: quasi-static equilibrium of ring and balls, kinematic speeds, cage centred on the balls.
// Equations in start.c.
#pragma once

#include "solver/kernels.h"

// Sets the whole state y; returns the largest residual force [N] of the equilibrium.
double start_state(const Kernels *kernels, const Model *model, Work *w, double *y);
