// The two halves of the cage as rigid bodies.  Equations in physics/rotor.h.
#pragma once

#include "physics/rotor.h"

// Poses and velocities of both halves from y, without forces.
void halves_kinematics(const Model *model, const scalar *y, Work *w);

// Rates of both halves under the forces and moments in w.
void halves_acceleration(const Model *model, const scalar *y, const Work *w, scalar *y_dot);
