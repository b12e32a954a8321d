// The inner ring: equations of motion.  Equations in ring.c.
#pragma once

#include "isa.h"
#include "model.h"

// Load on the ring at time t [N].
void drive_load(const Drive *drive, double t, number F[3]);

// Acceleration of the ring: y_dot of its states from the wrench of all contacts.
void ring_acceleration(const Model *model, double t, const Work *w, number *y_dot);
