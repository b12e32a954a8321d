// The right-hand side: y -> dy/dt.
#pragma once

#include "implicit.h"
#include "model.h"
#include "rivet_primary.h"
#include "rivets.h"
#include "vector_ops.h"
#include "verlet.h"

typedef void Rhs(const Model *model, double t, const number *y, number *y_dot, Work *w);
typedef void ContactKernel(const Model *model, Work *w);

// y_dot = f(t, y); w keeps all results.
Rhs rhs;

// Rotations and friction states of the cage in y over a step h, from the state in its middle; writes part of w.
void rhs_cage_advance(const Model *model, const double *middle, double h, double *y, Work *w);

// The kernels of one instruction set.
typedef struct {
    const char *name;
    Rhs *rhs;
    ContactKernel *race_contact_force;
    const VectorOps *ops;
    VerletStep *verlet;
    ImplicitSolve *implicit;
    RivetsLoad *rivets_load;
    RivetPrimary *rivet_primary;
} Kernels;

// Those of the best instruction set of this processor.
Kernels kernels_select(void);

// A Work whose ghost lanes are harmless.
void work_init(const Derived *d, Work *w);
