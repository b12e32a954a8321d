// Energy of balls and cage: kinetic and elastic.  Its change is the net work of the state `work`.
#pragma once

#include "model.h"

// Total energy [J] at the state y, whose results are w.
scalar energy_total(const Model *model, const scalar *y, const Work *w);
