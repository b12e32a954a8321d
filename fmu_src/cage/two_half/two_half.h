// Rigid cage halves: the springs of their joints, the loads of their rivets, their part of a step.  Equations in
// two_half.c.
#pragma once

#include "cage/common/cage_joint.h"
#include "cage/common/halves_step.h"
#include "physics/model.h"
#include "rivet/rivet_rom.h"

// Stiffnesses of the joints in the plane.
INLINE JointStiffness two_half_stiffness(const Derived *d)
{
    return (JointStiffness){d->k_plate_t, d->k_head, d->k_hole};
}

// Forces of the joints (cage_joint_kinematics before), tension of the rivets.
void two_half_joints(const Model *model, const scalar *y, Work *w);

// Loads of all joints and their rivets.
void two_half_loads(const Model *model, const Work *w, JointLoads *load);

// Motion and predicted velocities of a step of the default method (cage_begin).
void two_half_begin(const Model *model, double h, const StepFrom *from, const HalvesMemory *at,
                    const double *middle, double *y, HalvesStep *step, Work *w);

// Solution, corrections and history (cage_end).
void two_half_end(const Model *model, HalvesStep *step, const StepFrom *from, const HalvesMemory *at,
                  const StepTo *to, HalvesMemory *at_end, Work *w);

// v = (1 + gamma^2 K)^-1 v of the halves' velocities with the joints' stiffness across the axis; returns the weight of the
// position correction.
double two_half_shear(const Model *model, const Work *w, double gamma, double *v);

// v = (1 + gamma A + gamma^2 K)^-1 v with the films and the joints along the axis; likewise.
double two_half_solve(const Model *model, const Work *w, double gamma, double *v);

// Maps the friction states in y back under the loads in w.
void two_half_slide(const Model *model, double *y, JointStep *joints, Work *w);
