// Energy of balls and cage: kinetic and elastic, less the work of a turning frame's centrifugal load, which has widened the
// cage (cage_widened).  Its change is the net work of the state `work`.
#pragma once

#include "physics/model.h"

// Total energy [J] at the state y, whose results are w.
scalar energy_total(const Model *model, const scalar *y, const Work *w);

// Elastic energy that a jump of the speed from `before` to `after`, both in the fixed frame, adds to the inner race
// contacts [J], at the state y: the ring grows at once.
double energy_of_speed(const Model *model, const double *y, double before, double after);
