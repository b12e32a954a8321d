// The right-hand side: y -> dy/dt.
#pragma once

#include "numbers/isa.h"
#include "physics/model.h"

typedef void Rhs(const Model *model, double t, const scalar *y, scalar *y_dot, Work *w);

// y_dot = f(t, y); w keeps all results.
Rhs rhs;

// Advances the rotations and friction states of the cage in y over a step h.  middle: the state in the middle
// of the step.  Writes the kinematics of cage and joints there into w.
void rhs_cage_advance(const Model *model, const double *middle, double h, double *y, Work *w);
