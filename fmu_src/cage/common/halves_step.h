// The halves' part of a step of the default method, as far as both kinds of halves share it: motion, predictor with its
// limiter, history and error of the halves' velocities and of the joints' friction.  Equations in halves_step.c.
#pragma once

#include "cage/common/cage_joint.h"
#include "cage/common/pocket_films.h"
#include "physics/model.h"

// Carried from an evaluation to the next step: rates of each land's film but that of the spin, which is 0; films in pockets.
typedef struct {
    LandFilm film[2];
    PocketFilms pockets;
} HalvesMemory;

// Start of a step: state, rates, their change over the step before / its length h [s].
typedef struct {
    const double *y, *f, *jerk;
    double h;
} StepFrom;

// End of a step, of which the cage sets its own rows: state, rates, their change over the step / its length, errors; residual of the
// velocities at the prediction and the change delta that the linear solve makes of it; changes of the balls' accelerations by loads on walls,
// whose ways the state has.  The rates are those of the evaluation on entry.
typedef struct {
    double *y, *f, *jerk, *error, *residual, *delta, *balls;
} StepTo;

// Between the two halves of a step.
typedef struct {
    double h, gamma;  // length of the step, half of it [s]
    double removed
        [N_STATES];    // part of the prediction h a_n that the limiter has removed, of the halves' velocities
    JointStep joints;  // friction
} HalvesStep;

#ifndef DUAL
// Rotations of the halves in y, whose other positions have their values at the end and whose velocities of the halves become those of
// the middle; kinematics of halves and joints in the middle.
void halves_move(const Model *model, double h, const StepFrom *from, const double *middle, double *y,
                 HalvesStep *step, Work *w);

// Velocities of the halves at the end as predicted, from those of the middle.  film: that of each land at the start.
void halves_predict(const Model *model, const StepFrom *from, const LandFilm film[2], double *y,
                    HalvesStep *step);

// Residual of the trapezoidal rule at the prediction.
void halves_residual(const HalvesStep *step, const StepFrom *from, const StepTo *to);

// Velocities at the end by the solution `delta`; change = v_{n+1} - v_n - h a_n.
void halves_correct(const HalvesStep *step, const StepTo *to, double change[N_STATES]);

// v = v - (1 + gamma A)^-1 v of the halves' velocities, A of the films alone.
void halves_stiff_part(const Model *model, const Work *w, double gamma, double *v);

// Maps the friction states in y back under the tensions T and the forces N_plate, from joints->before; the work loses the
// energy that the mapping dissipates.
void halves_slide(const Model *model, const JointStiffness *k, const double *T, const double *N_plate,
                  double *y, JointStep *joints, Work *w);

// Accelerations, mean rates of the friction states, their history and their errors; the films at the end.  change: v_{n+1} - v_n - h a_n;
// unforeseen: without the part that the substeps foresaw, where that is no error.
void halves_remember(const Model *model, const Work *w, const HalvesStep *step, const StepFrom *from,
                     const double change[N_STATES], const double unforeseen[N_STATES], const StepTo *to,
                     LandFilm film[2]);
#endif
