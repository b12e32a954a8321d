// The right-hand side: y -> dy/dt.
#pragma once

#include "implicit.h"
#include "model.h"
#include "vector_ops.h"

typedef void Rhs(const Model *model, double t, const number *y, number *y_dot, Work *w);
typedef void ContactKernel(const Model *model, Work *w);

// y_dot = f(t, y); w keeps all results.
Rhs rhs;

// The kernels of one instruction set.
typedef struct {
    const char *name;
    Rhs *rhs;
    ContactKernel *race_contact_force;
    const VectorOps *ops;
    const ImplicitOps *implicit;
} Kernels;

// Those of the best instruction set of this processor.
Kernels kernels_select(void);

// A Work whose ghost lanes are harmless.
void work_init(const Derived *d, Work *w);
