// Contact of the balls with both races.  Equations in race_contact.c.
#pragma once

#include "isa.h"
#include "model.h"

// Sets the forces, moments, stiff rates and contact results of all balls, and the wrench on the inner ring.
void race_contact_force(const Model *model, Work *w);
