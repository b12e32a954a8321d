// Contact of the balls with both races.  Equations in race_contact.c.
#pragma once

#include "physics/model.h"

// Sets the forces, moments, stiff rates and contact results of all balls, and the wrench on the inner ring.
typedef void RaceContactForce(const Model *model, Work *w);
RaceContactForce race_contact_force;

// Power that the inner ring's growth, where its speed changes, puts into the balls [W]: -K delta^1.5 n.e dR_g/dt.
scalar race_growth_power(const Model *model, const Work *w);
