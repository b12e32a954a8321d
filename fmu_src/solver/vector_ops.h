// Operations on the state vector for ARKODE and for the error norm of Verlet steps: fixed length, one pass
// each, in the instruction set of the right-hand side.
#pragma once

#include "numbers/isa.h"

typedef struct {
    int states;
    void (*linear_sum)(double a, const double *x, double b, const double *y, double *z);  // z = a x + b y
    void (*linear_combination)(int n, const double *c, double *const *x, double *z);      // z = sum c_i x_i
    double (*wrms_norm)(const double *x, const double *w);  // sqrt(mean (x w)^2)
    bool (*finite)(const double *x);
} VectorOps;

#define vector_ops FOR_ISA(vector_ops)
extern const VectorOps vector_ops;
#define vector_ops_all FOR_ISA(vector_ops_all)
extern const VectorOps vector_ops_all;  // with the states of the cage's modes
