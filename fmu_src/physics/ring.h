// The inner ring: equations of motion.  Equations in ring.c.
#pragma once

#include "numbers/isa.h"
#include "physics/model.h"

// Acceleration of the ring: y_dot of its states from the wrench of all contacts.
void ring_acceleration(const Model *model, const Work *w, scalar *y_dot);
