// The riveted joints between the cage halves.  Equations in cage_joint.c.
#pragma once

#include "numbers/isa.h"
#include "physics/model.h"
#include "rivet/rivet_rom.h"

// Prying force dT [N]: what the cage's centrifugal load adds to the rivet's tension and to the plates' contact
// force, T_rest - P of joints that are all alike (joint_law.h), at their mean preload.  C1 in the cage's
// speed: the cubic through the states of the table, which are at equal steps of x = c/(c + P), with slopes by
// central differences.
ONCE scalar cage_joint_prying(const Model *model, const Work *w)
{
    const Derived *d = model->d;
    const JointLaw *law = &rivet_table.half.law;
    const scalar omega_2 = 0.5 * (w->half[0].s * w->half[0].s + w->half[1].s * w->half[1].s);
    const scalar c = fabs(d->spin[ROW_M_T]) / law->length * omega_2;
    const scalar P = scalar_max(d->P_mean + d->spin[ROW_DP] * omega_2, 0.0), s = c + P;
    if (!(scalar_value(c) > 0.0)) return 0.0;
    const scalar x = c / s * (law->alike_count - 1.0);
    const int last = law->alike_count - 1, i = (int)fmin(scalar_value(x), last - 1.0);
    const double from = law->alike[i][ALIKE_T], to = law->alike[i + 1][ALIKE_T], rise = to - from;
    const double slope_from = i > 0 ? 0.5 * (to - law->alike[i - 1][ALIKE_T]) : rise;
    const double slope_to = i + 1 < last ? 0.5 * (law->alike[i + 2][ALIKE_T] - from) : rise;
    const scalar u = x - i, v = 1.0 - u;
    const scalar T = from + u * rise + u * v * (v * (slope_from - rise) + u * (rise - slope_to));
    return s * T - d->P_mean * law->alike[0][ALIKE_T];
}

// Offset and velocity of half 1 against half 0 at each rivet, in the frame of half 0.
void cage_joint_kinematics(const Model *model, Work *w);

// Forces of all joints: sets T, N_plate, S, H, B and the rates of the friction states, adds the wrench to
// both halves.
void cage_joint_force(const Model *model, const scalar *y, Work *w);

// Forces of elastic halves' joints in the plane, by the offsets in w and the friction states in y: joint_F_y,
// joint_F_z.
#define cage_joint_shear FOR_ISA(cage_joint_shear)
void cage_joint_shear(const Model *model, const double *y, Work *w);

// Advances the friction states in y over a step h; w holds the kinematics in the middle of the step.  Returns what they
// dissipate [J].
double cage_joint_advance(const Model *model, const Work *w, double h, double *y);
