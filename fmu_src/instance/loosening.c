// Preload lost by wear: see loosening.h.
#include "instance/loosening.h"

#include "numbers/saved_numbers.h"
#include "rivet/rivet_rom.h"

// Share of joint.preload by which a rivet's preload may be off the worn one.
static const double PRELOAD_SHARE = 1e-3;

void loosening_add(const Parameters *p, const double *rubbed, Loosening *loose)
{
    const JointData *joint = &rivet_table.joint;
    const double face = 0.25 * PI * joint->seat * joint->seat - joint->A;
    const double loss = p->joint.wear * joint->k_stack / face;
    for (int k = 0; k < Z; k++) loose->loss[k] += loss * rubbed[k];
}

void loosening_apply(const Loosening *loose, Parameters *p)
{
    for (int k = 0; k < Z; k++) {
        if (!(loose->in_force[k] > 0.0 && p->joint.preload > 0.0)) continue;
        const double lost = loose->in_force[k] / p->joint.preload;
        p->rivet.preload_factor[k] = fmax(p->rivet.preload_factor[k] - lost, 0.0);
    }
}

bool loosening_update(double preload, const double P[Z], Loosening *loose)
{
    bool off = false;
    for (int k = 0; k < Z; k++)
        off |= loose->loss[k] - loose->in_force[k] > PRELOAD_SHARE * preload && P[k] > 0.0;
    if (off) memcpy(loose->in_force, loose->loss, sizeof loose->loss);
    return off;
}

bool loosening_is_valid(const Loosening *loose)
{
    bool fine = values_are_amounts(loose->loss, Z) && values_are_amounts(loose->in_force, Z);
    for (int k = 0; k < Z; k++) fine &= loose->in_force[k] <= loose->loss[k];
    return fine;
}
