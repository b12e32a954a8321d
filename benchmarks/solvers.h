// Solvers to compare the core's integrator with.
#pragma once

typedef enum { SOLVER_ERK, SOLVER_ADAMS, SOLVER_BDF } SolverMethod;

typedef enum { JACOBIAN_DENSE, JACOBIAN_DIAGONAL } SolverJacobian;

// Solver of all instances created from now on.
//   table            explicit Runge-Kutta method by ARKODE's name, e.g. "ARKODE_DORMAND_PRINCE_7_4_5" (SOLVER_ERK)
//   jacobian         of BDF
//   output_interval  time between values taken from the solver's interpolant [s], 0: none
void solver_choose(SolverMethod method, const char *table, SolverJacobian jacobian, double output_interval);

// Evaluations of the right-hand side for Jacobians by differences, and values taken from interpolants, since
// solver_choose.
void solver_counts(double *jacobian_evals, double *outputs);
