// Rigid cage halves: the springs of their joints, the loads of their rivets, their part of a step.  Equations in
// two_half.c.
#pragma once

#include "cage/common/cage_joint.h"
#include "cage/common/films.h"
#include "numbers/isa.h"
#include "physics/model.h"
#include "rivet/rivet_rom.h"

// Stiffnesses of the joints in the plane.
INLINE JointStiffness two_half_stiffness(const Derived *d)
{
    return (JointStiffness){d->k_plate_t, d->k_head, d->k_hole};
}

// Forces of the joints (cage_joint_kinematics before), tension of the rivets.
#define two_half_joints FOR_ISA(two_half_joints)
void two_half_joints(const Model *model, const scalar *y, Work *w);

// Loads of all joints and their rivets.
#define two_half_loads FOR_ISA(two_half_loads)
void two_half_loads(const Model *model, const Work *w, JointLoads *load);

// Holds back the relative motion across the axis of the velocities v; returns the weight of the position correction.
#define two_half_shear FOR_ISA(two_half_shear)
double two_half_shear(const Model *model, const Work *w, double gamma, double *v);

// Holds back the axial motion and the tilts of half 1 against half 0, both already held back by their films f.  Returns
// the weight of the position correction.
#define two_half_solve FOR_ISA(two_half_solve)
double two_half_solve(const Model *model, const Work *w, double gamma, const HalfFilm f[2],
                      HalfVelocity half[2]);

// Positions and trial deflections in y follow the corrections delta of the velocities.
#define two_half_correct FOR_ISA(two_half_correct)
void two_half_correct(const Model *model, const Work *w, double gamma, double axial, double shear,
                      const double *delta, double *y, JointStep *joints);
