// Linear equations of the ring's five velocities or displacements.
#pragma once

#include "lanes.h"

enum { RING_DOF = 5 };

// x = A^-1 x; A is overwritten.  No pivoting is needed: A is symmetric positive definite in the coordinates
// that forces move, and diagonal in the others.
INLINE void eliminate(double A[RING_DOF][RING_DOF], double x[RING_DOF])
{
    for (int i = 0; i < RING_DOF; i++)
        for (int k = i + 1; k < RING_DOF; k++) {
            const double l = A[k][i] / A[i][i];
            for (int q = i; q < RING_DOF; q++) A[k][q] -= l * A[i][q];
            x[k] -= l * x[i];
        }
    for (int i = RING_DOF - 1; i >= 0; i--) {
        for (int k = i + 1; k < RING_DOF; k++) x[i] -= A[i][k] * x[k];
        x[i] /= A[i][i];
    }
}
