// Films of oil between balls and both halves within a step.  Equations in pocket_films.c; twin:
// bearing_model/cage/common/pocket_films.py.
#pragma once

#include "physics/model.h"

// The films of both halves at an evaluation, D = 0 where there is none.
typedef struct {
    double D[2][LANES], u[2][LANES], F[2][LANES];        // damping [N.s/m], speed of closing [m/s], force [N]
    double m_x[2][LANES], m_r[2][LANES], m_t[2][LANES];  // direction along the pocket's axes
    double shape[2][Z][N_MODES];                         // motion of the wall along it by each mode
    // largest D over the mass of its wall at the end of a step, over the least mass of any wall where lands guide the cage [1/s]
    double rate;
} PocketFilms;

// A film within a step.
typedef struct {
    int h, k;                        // of this half, before this ball
    double D, F_0, F;                // damping; force at the step's start and now
    double impulse;                  // so far [N.s]
    double rate, acceleration;       // of the rigid approach, in the middle of the step and at its start
    double mobility;                 // of wall and half [m/s/(N.s)]
    double along[RELATIVE_MOTIONS];  // motion of the wall along m by those of the half, and by each mode
    mode_array shape;
    double direction[3];  // m along (x, r, t) of the ball
} PocketFilm;

// Films that follow in the substeps of a step.
typedef struct {
    int count;
    double middle;  // of the step [s]
    PocketFilm film[2 * Z];
} PocketFilmsStep;

// Adds `more`, the film's force at the end of a step less that of an evaluation, to load and force of a pocket.
INLINE void pocket_films_add(const PocketFilms *films, int h, int k, double more, Work *w)
{
    Pockets *pocket = &w->pocket[h];
    pocket->Q[k] += more;
    pocket->F_x[k] += more * films->m_x[h][k];
    pocket->F_r[k] += more * films->m_r[h][k];
    pocket->F_t[k] += more * films->m_t[h][k];
}

// Takes the films of an evaluation.
void pocket_films_split(const Model *model, const Work *w, PocketFilms *films);

// Finds the films of a step of length h under the rates f.  state: velocities in the middle of the step; y: positions at its end; w:
// kinematics of the halves in the middle.
void pocket_films_find(const Model *model, double h, const PocketFilms *films, const double *f,
                       const double *state, const double *y, const Work *w, PocketFilmsStep *step);

// The impulses of a substep of length d at its end, the time t of the step, on velocities v of S and D and on those of the
// halves by all but slow forces, `halves`; `pushed` gets the same as halves.
void pocket_films_follow(const Model *model, double t, double d, double *v,
                         double halves[2 * RELATIVE_MOTIONS], double pushed[2 * RELATIVE_MOTIONS],
                         PocketFilmsStep *step);

// Adds to accelerations of the modes and of the halves the part by the change of the films' forces since the step's start.
void pocket_films_foreseen(const Model *model, const PocketFilmsStep *step, double modes[2 * N_MODES],
                           double halves[2 * RELATIVE_MOTIONS]);

// At the step's end y, w, behind the evaluation: takes the excess of the films' forces at the predicted velocities from the rates f and
// the pockets' forces, and returns the power that this saves [W].  step: films that followed in substeps, NULL without.
double pocket_films_arrive(const Model *model, double gamma, const PocketFilmsStep *step,
                           const PocketFilms *before, const double *y, Work *w, double *f,
                           PocketFilms *films);
