// What holds back velocities: rates A = -d(acceleration)/d(velocity) and stiffnesses K = -d(acceleration)/d(position) of the stiff local contacts.
#pragma once

#include "isa.h"
#include "model.h"

// v = (1 + gamma A + gamma^2 K)^-1 v, block by block, with A and K at the state of w.  v is in the rows of the state vector; positions are not touched.
typedef void ImplicitSolve(const Model *model, const Work *w, double gamma, double *v);
ImplicitSolve implicit_solve;

// v = (1 + gamma A)^-1 v of the cage halves' velocities, A of their films alone.
void implicit_films(const Model *model, const Work *w, double gamma, double *v);

// v = v - (1 + gamma A)^-1 v: the part of v that damping holds back within a time gamma; 0 for a ball whose rates are below 2/gamma.
void implicit_stiff_part(const Model *model, const Work *w, double gamma, double *v);
