// Energy of balls and cage: kinetic and elastic.  Its change is the net work of the state `work`.
#pragma once

#include "model.h"

// From the state y and the results of the right-hand side there [J].
scalar energy_total(const Model *model, const scalar *y, const Work *w);
