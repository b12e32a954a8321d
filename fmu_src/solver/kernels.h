// Functions that exist once for each instruction set, and the choice among them at run time.
#pragma once

#include "cage/cage.h"
#include "physics/race_contact.h"
#include "physics/rhs.h"
#include "rivet/rivet_rom.h"
#include "solver/verlet.h"

struct _generic_N_Vector;  // N_Vector without the headers of SUNDIALS

// ARKODE's vectors have memory for whole passes of a kernel over their rows.
enum { VECTOR_PASS = 32, VECTOR_ROWS = (N_ALL_STATES + VECTOR_PASS - 1) / VECTOR_PASS * VECTOR_PASS };

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
    // SUNDIALS' linear combination of n such vectors, and its norm of an error
    int (*combine)(int n, double *c, struct _generic_N_Vector **x, struct _generic_N_Vector *z);
    double (*norm)(struct _generic_N_Vector *x, struct _generic_N_Vector *weight);
    bool (*all_finite)(int n, const double *x);
} Kernels;

#define own_kernels FOR_ISA(own_kernels)
extern const Kernels own_kernels;

// The kernels that the environment variable RIVETED_BEARING_ISA names (avx512, avx2, baseline), for tests; without it those of the
// best instruction set that this processor and its operating system support.  refused: its value where this processor has no such
// kernels, else NULL.
Kernels kernels_wanted(const char **refused);
