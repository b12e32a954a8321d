// The kernels of one instruction set.
#include "solver/kernels.h"

#include "numbers/error_norm.h"

#include <nvector/nvector_serial.h>

// z = c_0 x_0 + c_1 x_1 + ... in one pass.  SUNDIALS' own loops, in which z might be c, are not vectorized: they take a fifth of the
// explicit method's time.
static int combine(int n, double *c, N_Vector *x, N_Vector z)
{
    enum { PARTS = VECTOR_PASS / LANE_WIDTH };

    for (int i = 0; i < NV_LENGTH_S(z); i += VECTOR_PASS) {
        wide sum[PARTS];
        for (int part = 0; part < PARTS; part++)
            sum[part] = c[0] * wide_load(&NV_Ith_S(x[0], i + part * LANE_WIDTH));
        for (int k = 1; k < n; k++)
            for (int part = 0; part < PARTS; part++)
                sum[part] += c[k] * wide_load(&NV_Ith_S(x[k], i + part * LANE_WIDTH));
        for (int part = 0; part < PARTS; part++) wide_store(&NV_Ith_S(z, i + part * LANE_WIDTH), sum[part]);
    }
    return SUN_SUCCESS;
}

static double norm(N_Vector x, N_Vector weight)
{
    return error_norm(NV_LENGTH_S(x) > N_STATES, NV_DATA_S(x), NV_DATA_S(weight));
}

#define TEXT_OF(isa) #isa
#define NAME(isa) TEXT_OF(isa)

const Kernels own_kernels = {NAME(ISA),       rhs,        race_contact_force, verlet_step,
                             verlet_evaluate, cage_loads, cage_slide,         rivet_rom_stress,
                             combine,         norm,       all_finite};
