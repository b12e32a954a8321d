// The right-hand side: y -> dy/dt.
#pragma once

#include "isa.h"
#include "model.h"

typedef void Rhs(const Model *model, double t, const double *y, double *y_dot, double *D, Work *w);

// y_dot = f(t, y), and the diagonal of stiff rates D [1/s] (0 where a state has none); D may be NULL.  w keeps all results.
Rhs rhs;

// The right-hand side of the best instruction set of this processor, and its name.
Rhs *rhs_select(const char **name);

// A Work whose ghost lanes are harmless.
void work_init(const Derived *d, Work *w);
