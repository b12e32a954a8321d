// The functions that exist once per instruction set, and the choice among them at run time.
#pragma once

#include "implicit.h"
#include "race_contact.h"
#include "rhs.h"
#include "rivet_primary.h"
#include "rivets.h"
#include "vector_ops.h"
#include "verlet.h"

// The kernels of one instruction set.
typedef struct {
    const char *name;
    Rhs *rhs;
    RaceContactForce *race_contact_force;
    const VectorOps *ops;
    VerletStep *verlet;
    ImplicitSolve *implicit;
    RivetsLoad *rivets_load;
    RivetPrimary *rivet_primary;
} Kernels;

// Those of the best instruction set of this processor.
Kernels kernels_select(void);
