// The block Jacobian of the default step: rates A = -d(acceleration)/d(velocity) and stiffnesses K =
// -d(acceleration)/d(position) of the stiff local contacts, and the linear equations that the step solves
// with them.
#pragma once

#include "physics/model.h"

// v = (1 + gamma A + gamma^2 K)^-1 v of balls and ring, A and K at the evaluation w.  v has the rows of the state vector;
// only velocities of balls and ring are read and written.
void implicit_solve(const Model *model, const Work *w, double gamma, double *v);

// The wrench of the race contacts on the ring in w becomes the one that moved the balls in a step: that of the evaluation and
// the part by the forces that the solve's result delta adds on the balls.
void implicit_ring_wrench(const Model *model, double gamma, const double *delta, Work *w);

// gamma v.M K v of the balls [W] with the stiffness K of the races' normal forces.
double implicit_spring_power(const Work *w, double gamma, const double *v);

// v = v - (1 + gamma A)^-1 v: the part of v that friction and damping take away within a time gamma.  A has
// no normal forces and no joints; of a ball whose rates are below 2/gamma the result is 0.
void implicit_stiff_part(const Model *model, const Work *w, double gamma, double *v);
