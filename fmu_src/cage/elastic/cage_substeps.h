// Substeps of elastic halves and their joints between two evaluations of the right-hand side.  Equations in
// cage_substeps.c; twin: bearing_model/cage/elastic/cage_substeps.py.
#pragma once

#include "cage/common/cage_joint.h"
#include "cage/common/pocket_films.h"
#include "cage/elastic/rim_films.h"
#include "physics/model.h"

// Where the substeps of the next step begin: joints, contacts and fast accelerations at an evaluation.
typedef struct {
    double e[3][LANES], u_y[LANES], u_z[LANES];  // motions of the joints out of the plane and offsets in it
    WallTouch touch;
    double omega_2;             // square of the halves' speed in space [rad2/s2]
    double modes[2 * N_MODES];  // accelerations of S, then of D, by joints and the modes' own springs [m/s2]
    double
        rigid[RELATIVE_MOTIONS];  // those of the relative motions at the joints, by the joints [m/s2, rad/s2]
} FastState;

// Takes the fast part from the rates f of the state y, at which w was evaluated, and writes it to `fast`.
void cage_substeps_split(const Model *model, const double *y, const Work *w, double *f, FastState *fast);

// Slow accelerations at the step's end as the substeps foresee them: of the modes their values, of the halves their
// changes since the step's start, of the balls those by loads on walls; in the order of their velocities in the state.
typedef struct {
    double modes[2 * N_MODES], halves[2 * RELATIVE_MOTIONS], balls[BALL_MOTIONS];
} Foreseen;

// Substeps of a step of length h from `fast` under the slow rates f.  state: that in the middle of the step; y: the state at the
// step's start but for positions and velocities of the halves, which a step without fast accelerations has reached at its end
// and in its middle; the substeps add theirs, and advance modes, friction states and work.  w: kinematics in
// the middle; films: those of rims that follow in the substeps, NULL if none does; pockets: those of pockets.
void cage_substeps_advance(const Model *model, double h, const FastState *fast, const double *f,
                           const double *state, double *y, Foreseen *foreseen, JointStep *slip,
                           RimFilmsStep *films, PocketFilmsStep *pockets, const Work *w);
