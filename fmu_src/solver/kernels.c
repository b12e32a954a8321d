// The kernels of one instruction set.
#include "solver/kernels.h"

#define TEXT_OF(isa) #isa
#define NAME(isa) TEXT_OF(isa)

const Kernels own_kernels = {NAME(ISA),       rhs,        race_contact_force, verlet_step,
                             verlet_evaluate, cage_loads, cage_slide,         rivet_rom_stress};
