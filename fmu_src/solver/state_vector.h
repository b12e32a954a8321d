// Vectors of ARKODE over the states of a scene.
#pragma once

#include "solver/vector_ops.h"
#include "variables.h"

#include <sundials/sundials_nvector.h>

// A vector of zeros; NULL if there is no memory.  ops: where the operations of the present scene stand.
N_Vector state_vector_new(SUNContext sun, const VectorOps *const *ops);

double *state_vector_data(N_Vector v);
int state_vector_length(N_Vector v);

// Makes the vector show the numbers at y, which it does not own.
void state_vector_show(N_Vector v, double *y);
