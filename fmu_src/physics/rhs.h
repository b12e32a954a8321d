// The right-hand side: y -> dy/dt.
#pragma once

#include "physics/model.h"

typedef void Rhs(const Model *model, double t, const scalar *y, scalar *y_dot, Work *w);

// y_dot = f(t, y); w keeps all results.
Rhs rhs;
