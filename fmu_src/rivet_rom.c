// Rivet stress from the reduced model: see rivet_rom.h for the equations.
#include "rivet_rom.h"

#include "rivet_splines.h"

#include <math.h>

// The point of a load in the table: see the head of rivet_rom.h.
static TablePoint table_point(const RivetTable *t, const RivetLoad *load, double fit_eff)
{
    const scalar T = scalar_max(load->T, 0.0), V = scalar_sqrt(load->V_y * load->V_y + load->V_z * load->V_z);
    const scalar m = scalar_sqrt(load->m_y * load->m_y + load->m_z * load->m_z), s = T + V, Vm = V * m, largest = t->moment_length * T;
    const scalar across = load->V_y * load->m_z - load->V_z * load->m_y;
    TablePoint point;
    scalar w = scalar_value(Vm) > 0.0 ? 2.0 * scalar_min(scalar_max(across, -across) / Vm, 1.0) : 0.0;
    point.sheet = scalar_value(w) >= 1.0 ? RIVET_PLANE : RIVET_OBLIQUE;
    if (point.sheet == RIVET_PLANE) w -= 1.0;
    point.first[0] = w;
    point.first[1] = point.sheet == RIVET_PLANE ? w : w * scalar_sqrt(w);
    const scalar a = scalar_value(s) > 0.0 ? V / s : 0.0, c = scalar_value(largest) > 0.0 ? scalar_min(m / largest, 1.0) : 0.0;
    const scalar xi = scalar_value(s) > 0.0 ? fit_eff / s : 0.0;
    point.at[RIVET_A] = axis_splines(&t->axis[RIVET_A], a);
    point.at[RIVET_C] = axis_splines(&t->axis[RIVET_C], c);
    point.at[RIVET_XI] = axis_splines_xi(&t->axis[RIVET_XI], xi, s, fit_eff);
    return point;
}

unsigned rivet_rom_stress(const RivetTable *t, const RivetLoad *load, double fit_eff, scalar sigma[RIVET_CHANNELS])
{
    const TablePoint point = table_point(t, load, fit_eff);
    scalar primary[2], secondary[2];
    contract(t, t->primary, &point, primary);
    contract(t, t->secondary, &point, secondary);
    sigma[HEAD_P1] = primary[0] + t->head_friction * load->F_head;
    sigma[MID_VM] = primary[1];
    sigma[HEAD_VM] = secondary[0] + t->head_friction_vm * load->F_head;
    sigma[MID_P1] = secondary[1];

    unsigned flags = 0;
    if (fmax(scalar_value(sigma[HEAD_VM]), scalar_value(sigma[MID_VM])) > t->yield_rivet) flags |= RIVET_YIELDS;
    if (!isfinite(scalar_value(sigma[HEAD_P1]))) flags |= RIVET_OUTSIDE;
    return flags;
}

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
    return map->fit_eff[i] * v * v * (1.0 + 2.0 * u) + map->fit_eff[i + 1] * u * u * (1.0 + 2.0 * v) + h * u * v * (map->slope[i] * v - map->slope[i + 1] * u);
}

// The flanges outgrow the rivet: k_stack (alpha_flange - alpha_rivet) grip per kelvin.
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
