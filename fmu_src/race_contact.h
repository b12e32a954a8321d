// Contact of the balls with both races.  Equations in race_contact.c.
#pragma once

#include "isa.h"
#include "model.h"

// Sets the forces, moments, stiff rates and contact results of all balls, and the wrench on the inner ring.
typedef void RaceContactForce(const Model *model, Work *w);
RaceContactForce race_contact_force;
