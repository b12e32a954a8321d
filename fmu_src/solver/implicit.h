// The block Jacobian of the default step: rates A = -d(acceleration)/d(velocity) and stiffnesses K =
// -d(acceleration)/d(position) of the stiff local contacts, and the linear equations that the step solves
// with them.
#pragma once

#include "numbers/isa.h"
#include "physics/model.h"

// v = (1 + gamma A + gamma^2 K)^-1 v, A and K at the evaluation w.  v has the rows of the state vector; only
// velocities are read and written.  Returns the weight c of the position correction c gamma delta of half 1 against
// half 0 along the axis.
typedef double ImplicitSolve(const Model *model, const Work *w, double gamma, double *v);
ImplicitSolve implicit_solve;

// v = (1 + gamma^2 K)^-1 v with the joints' stiffness across the axis, a factor of the matrix of its own.  Returns
// the weight of the position correction across the axis.
double implicit_shear(const Model *model, const Work *w, double gamma, double *v);

// gamma v.M K v of the balls [W] with the stiffness K of the races' normal forces.
double implicit_elastic(const Work *w, double gamma, const double *v);

// v = (1 + gamma A)^-1 v of the cage halves' velocities, A of the lands' films alone.
void implicit_films(const Model *model, const Work *w, double gamma, double *v);

// v = v - (1 + gamma A)^-1 v: the part of v that friction and damping take away within a time gamma.  A has
// no normal forces and no joints; of a ball whose rates are below 2/gamma the result is 0.
void implicit_stiff_part(const Model *model, const Work *w, double gamma, double *v);
