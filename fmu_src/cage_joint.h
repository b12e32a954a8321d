// The riveted joints between the cage halves.  Equations in cage_joint.c.
#pragma once

#include "isa.h"
#include "model.h"

// Offset and velocity of half 1 against half 0 at each rivet, in the frame of half 0.
void cage_joint_kinematics(const Model *model, Work *w);

// Forces of all joints: sets T, N_plate, S, H, B and the rates of the friction states, adds the wrench to
// both halves.
void cage_joint_force(const Model *model, const scalar *y, Work *w);

// Advances the friction states in y over a step h; w holds the kinematics in the middle of the step.
void cage_joint_advance(const Model *model, const Work *w, double h, double *y);
