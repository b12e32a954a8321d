// Functions that exist once for each instruction set, and the choice among them at run time.
#pragma once

#include "physics/race_contact.h"
#include "physics/rhs.h"
#include "rivet/rivet_rom.h"
#include "rivet/rivets.h"
#include "solver/implicit.h"
#include "solver/vector_ops.h"
#include "solver/verlet.h"

// The kernels of one instruction set.
typedef struct {
    const char *name;
    Rhs *rhs;
    RaceContactForce *race_contact_force;
    const VectorOps *ops, *ops_elastic;
    VerletStep *verlet;
    VerletEvaluate *verlet_evaluate;
    ImplicitSolve *implicit;
    RivetsLoad *rivets_load;
    RivetsFollow *rivets_follow;
    RivetRomStress *rivet_rom_stress;
} Kernels;

// The kernels of the best instruction set that this processor and its operating system support.
Kernels kernels_select(void);
