// Small systems of linear equations: five velocities or displacements of the ring, three of a joint or of a
// cage half.
#pragma once

#include "numbers/lanes.h"

enum { BODY_DOF = 5 };

// x = A^-1 x; A is overwritten.  No pivoting is needed: A is symmetric positive definite in the coordinates
// that forces move, and diagonal in the others.
INLINE void eliminate(double A[BODY_DOF][BODY_DOF], double x[BODY_DOF])
{
    for (int i = 0; i < BODY_DOF; i++)
        for (int k = i + 1; k < BODY_DOF; k++) {
            const double l = A[k][i] / A[i][i];
            for (int q = i; q < BODY_DOF; q++) A[k][q] -= l * A[i][q];
            x[k] -= l * x[i];
        }
    for (int i = BODY_DOF - 1; i >= 0; i--) {
        for (int k = i + 1; k < BODY_DOF; k++) x[i] -= A[i][k] * x[k];
        x[i] /= A[i][i];
    }
}

// x = A^-1 x by Cramer's rule; A: nine numbers, row by row.
INLINE void solve_3(const double *A, scalar x[3])
{
    double cofactor[3][3];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            const int a = 3 * ((i + 1) % 3), b = 3 * ((i + 2) % 3), c = (k + 1) % 3, e = (k + 2) % 3;
            cofactor[i][k] = A[a + c] * A[b + e] - A[a + e] * A[b + c];
        }
    const double inv_det = 1.0 / (A[0] * cofactor[0][0] + A[1] * cofactor[0][1] + A[2] * cofactor[0][2]);
    const scalar y[3] = {x[0], x[1], x[2]};
    for (int i = 0; i < 3; i++)
        x[i] = (cofactor[0][i] * y[0] + cofactor[1][i] * y[1] + cofactor[2][i] * y[2]) * inv_det;
}
