// Outputs, group by group.
#pragma once

#include "rivets.h"

// Where an evaluation stands: the state y, y_dot and all other results of the right-hand side there.
typedef struct {
    const Model *model;
    const scalar *y, *y_dot;
    const Work *w;
    RivetsLoad *loads;
} Evaluation;

// Fills one group of outputs that follow from an evaluation; false: this group is of another kind.
bool outputs_evaluate(const Evaluation *at, OutputGroup group, Outputs *out);
