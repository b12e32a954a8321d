// The inner ring: equations of motion.  Equations in ring.c.
#pragma once

#include "physics/model.h"

// Pose and velocity of the ring from y, or as its motion is prescribed.
void ring_kinematics(const Model *model, const scalar *y, Work *w);

// Acceleration of the ring: y_dot of its states from the wrench of all contacts.
void ring_acceleration(const Model *model, const Work *w, scalar *y_dot);
