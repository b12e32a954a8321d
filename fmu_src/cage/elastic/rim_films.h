// Films on bent rims within a step.  Equations in rim_films.c; twin: bearing_model/cage/elastic/rim_films.py.
#pragma once

#include "physics/land_bent.h"
#include "physics/model.h"

// Forces on the shapes of both bent rims and rates of land and rim at an evaluation, both 0 of a rim that is not bent; stiffness of the gap
// that has the larger one [N/m].
typedef struct {
    double force[2][RIM], rates[2][SQUEEZE][SQUEEZE], stiffness;
} RimFilms;

// Films of a step.
typedef struct {
    const RimFilms *films;               // at the step's start
    double substep;                      // [s]
    double answer[2][SQUEEZE][SQUEEZE];  // (1 + d D Y)^-1 d D
    double mobility[2][SQUEEZE];         // Y
    double now[2][RIM];                  // forces in the present substep, at its start of the one before
    double begun[2][RIM];                // velocities of the shapes at the start
    double acceleration[2][2],
        by_film[2][2];       // of the lands along their half's axes by slow forces; their change by films
    double impulse[2][RIM];  // so far
} RimFilmsStep;

// Motions of both rims' shapes by coordinates S and D.
void rim_motions(const Model *model, const double *modes, double rim[2][RIM]);

// Adds a part of impulses on the rims' shapes to velocities of S and D.
void rim_push(const Model *model, double part, double impulse[2][RIM], double *modes);

// Before the first substep of length d, with the velocities v of S and D: constants of the films at the step's start.  f: slow rates;
// w: kinematics of the halves.
void rim_films_first(const Model *model, const Work *w, double d, const double *f, const double *v,
                     RimFilmsStep *step);

// The rest of the impulses of a substep at its end, t after the step's start.  halves: changes of the halves' velocities by the joints, in
// the order of the state.
void rim_films_follow(const Model *model, const Work *w, double t, const double halves[2 * RELATIVE_MOTIONS],
                      double *v, RimFilmsStep *step);
