// Oil film between the lands of the cage halves and the outer ring.  Equations in land_film.c.
#pragma once

#include "numbers/isa.h"
#include "physics/model.h"

// Adds force and moment to both halves (Rotor F, M); sets their film rates, the loads on their rims, the dissipated power
// and the elastic energy.
void land_film_force(const Model *model, Work *w);
