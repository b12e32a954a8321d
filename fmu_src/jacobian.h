// Derivatives of the right-hand side.
#pragma once

#include "model.h"

// Diagonal of stiff rates D >= 0 [1/s] at the state of w, in the order of y: -d(y_dot)/dy of what traction, friction states and films hold back;
// 0 where a state has none.
void jacobian_diagonal(const Model *model, const Work *w, double *D);
