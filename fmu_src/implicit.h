// The stiff linear part of the right-hand side, which the IMEX path treats implicitly: f = (f + A (y - y_n)) + (-A (y - y_n)), y_n the state
// at the step's start.  Blocks of A: the six velocities of each ball (traction), five of each cage half (land film), friction states.
#pragma once

#include "isa.h"
#include "model.h"

enum { BALL_BLOCK = 6, BALL_TERMS = BALL_BLOCK * (BALL_BLOCK + 1) / 2, HALF_BLOCK = 5 };

// A in scaled velocities scale_i y_i, in which it is symmetric, and the Cholesky factor of 1 + gamma A.  Lower triangles, row by row; factors
// hold the inverse of their diagonal.
typedef struct {
    lanes ball[BALL_TERMS], ball_factor[BALL_TERMS], ball_scale[BALL_BLOCK], ball_per_scale[BALL_BLOCK];
    double half[2][HALF_BLOCK][HALF_BLOCK], half_factor[2][HALF_BLOCK][HALF_BLOCK], half_scale[HALF_BLOCK], half_per_scale[HALF_BLOCK];
    double plate[Z], head[Z];
    double gamma;    // that the factors belong to, < 0: none
    double largest;  // bound of the largest eigenvalue [1/s]
} Implicit;

typedef struct {
    void (*set)(const Model *model, const Work *w, Implicit *A);                    // A at the state of w
    void (*add)(const Implicit *A, const double *y, const double *y_n, double *f);  // f += A (y - y_n)
    void (*solve)(Implicit *A, double gamma, double *x);                            // x = (1 + gamma A)^-1 x
} ImplicitOps;

#define implicit_ops FOR_ISA(implicit_ops)
extern const ImplicitOps implicit_ops;
