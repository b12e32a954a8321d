// Functions that exist once for each instruction set, and the choice among them at run time.
#pragma once

#include "cage/cage.h"
#include "physics/race_contact.h"
#include "physics/rhs.h"
#include "rivet/rivet_rom.h"
#include "solver/implicit.h"
#include "solver/verlet.h"

// The kernels of one instruction set.
typedef struct {
    const char *name;
    Rhs *rhs;
    RaceContactForce *race_contact_force;
    VerletStep *verlet;
    VerletEvaluate *verlet_evaluate;
    CageLoads *cage_loads;
    CageSlide *cage_slide;
    RivetRomStress *rivet_rom_stress;
} Kernels;

#define own_kernels FOR_ISA(own_kernels)
extern const Kernels own_kernels;

// The kernels of the best instruction set that this processor and its operating system support.
Kernels kernels_select(void);

// The kernels that the environment variable RIVETED_BEARING_ISA names (avx512, avx2, baseline), for tests; those of
// kernels_select without it.  refused: its value where this processor has no such kernels, else NULL.
Kernels kernels_wanted(const char **refused);
