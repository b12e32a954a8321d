// The right-hand side: y -> dy/dt.
#pragma once

#include "isa.h"
#include "model.h"

typedef void Rhs(const Model *model, double t, const scalar *y, scalar *y_dot, Work *w);

// y_dot = f(t, y); w keeps all results.
Rhs rhs;

// Rotations and friction states of the cage in y over a step h, from the state in its middle; writes part of w.
void rhs_cage_advance(const Model *model, const double *middle, double h, double *y, Work *w);
