// Outputs, group by group.
#pragma once

#include "cage/cage.h"

// One evaluation of the right-hand side: the state y, its y_dot and all other results, and the kernels that
// outputs need.
typedef struct {
    const Model *model;
    const scalar *y, *y_dot;
    const Work *w;
    CageLoads *loads;
    RivetRomStress *stress;
} Evaluation;

// Fills one group of outputs that follow from an evaluation; the recorded groups (outputs_recorded.c) are
// left as they are.
void outputs_evaluate(const Evaluation *at, OutputGroup group, Outputs *out);
