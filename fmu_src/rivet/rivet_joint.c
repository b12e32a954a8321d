// Preload, fit and hole stiffness of a joint from the rivet table and the temperature.  temperature.c and derived.c
// call these functions, not the right-hand side.
#include "rivet/rivet_rom.h"

#include <math.h>

unsigned rivet_rom_fit_flags(const RivetTable *t, double fit_a)
{
    unsigned flags = 0;
    if (fit_a > t->fit_flange_yield) flags |= FLANGE_YIELDS;
    if (fit_a > t->j2.fit_a[t->j2.count - 1]) flags |= RIVET_OUTSIDE;
    return flags;
}

double rivet_rom_fit_eff(const RivetTable *t, double fit_a, bool j2)
{
    const FitMap *map = &t->j2;
    int last = map->count - 1;
    if (!j2 || fit_a <= map->fit_a[0]) return fit_a;
    if (fit_a >= map->fit_a[last]) return map->fit_eff[last] + map->slope[last] * (fit_a - map->fit_a[last]);
    int i = 0;
    while (fit_a >= map->fit_a[i + 1]) i++;
    double h = map->fit_a[i + 1] - map->fit_a[i], u = (fit_a - map->fit_a[i]) / h, v = 1.0 - u;
    return map->fit_eff[i] * v * v * (1.0 + 2.0 * u) + map->fit_eff[i + 1] * u * u * (1.0 + 2.0 * v) +
           h * u * v * (map->slope[i] * v - map->slope[i + 1] * u);
}

// The flanges expand more than the rivet, which adds k_stack (alpha_flange - alpha_rivet) grip to the preload
// per kelvin.
double joint_preload(const JointData *j, double preload, double T)
{
    return fmax(0.0, preload + j->k_stack * (j->alpha_flange - j->alpha_rivet) * j->grip * (T - j->T_0));
}

double joint_fit(const JointData *j, double fit, double T)
{
    return fit - (j->alpha_flange - j->alpha_rivet) * j->d * (T - j->T_0);
}

double joint_hole_stiffness(const JointData *j, double fit_a)
{
    int last = j->hole_count - 1;
    if (fit_a <= j->hole_fit[0]) return j->k_hole[0];
    if (fit_a >= j->hole_fit[last]) return j->k_hole[last];
    int i = 0;
    while (fit_a >= j->hole_fit[i + 1]) i++;
    double u = (fit_a - j->hole_fit[i]) / (j->hole_fit[i + 1] - j->hole_fit[i]);
    return j->k_hole[i] + u * (j->k_hole[i + 1] - j->k_hole[i]);
}
