// One step of the default method: a linearly implicit trapezoidal rule (W-method) with velocity Verlet's
// positions.
#pragma once

#include "cage/cage.h"
#include "physics/model.h"

// A state and the method's memory of the way there.
typedef struct {
    double y[N_ALL_STATES];
    double f[N_ALL_STATES];  // dy/dt; after a step: accelerations, mean rates of the friction states, power
    double jerk[N_ALL_STATES];  // unforeseen change of f over the last step / its length
    CageMemory cage;            // of the cage there; f lacks the accelerations that it advances by itself
    Housing housing;            // where it moves on springs, else 0
    BallTurn turn;              // of balls where one has a spall, else 0
    Exchange exchange;          // with the shaft there, by the forces that move the balls
    double h;                   // length of that step [s]; 0 before the first one
    double ratio;  // length that its error asks of the next step / h (integrator.c); 0 before the first one
} VerletState;

// Takes the step of length h [s] from the state `from` at time t to the state `to` and returns the weighted
// norm of the step's error: the step is acceptable up to 1.  weight: 1/(tolerance scale) of each state.  w:
// evaluation at the new positions.
typedef double VerletStep(const Model *model, double t, double h, const double *weight,
                          const VerletState *from, VerletState *to, Work *w);
VerletStep verlet_step;

// Evaluates the rates at the state now->y for the next step: f, and the cage's own part of the rates.
typedef void VerletEvaluate(const Model *model, double t, VerletState *now, Work *w);
VerletEvaluate verlet_evaluate;
