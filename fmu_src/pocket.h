// Contact of the balls with the cage pockets.  Equations in pocket.c.
#pragma once

#include "isa.h"
#include "model.h"

// Adds to the balls' forces, moments, rates and dissipation; sets the wrench on both halves.
void pocket_force(const Model *model, Work *w);
