// Loads of balls on the walls of elastic halves within a step.  Equations in wall_loads.c; twin:
// bearing_model/cage/elastic/wall_loads.py.
#pragma once

#include "cage/common/rigid_approach.h"
#include "cage/elastic/cage_substeps.h"

enum { WALL_LOADS = (2 * Z + 7) / 8 * 8 };  // room for packets

// Relative rigid motions of the halves at the joints.
enum { MOTION_X, MOTION_ABOUT_Y, MOTION_ABOUT_Z, MOTION_ACROSS_Y, MOTION_ACROSS_Z, MOTION_SPIN };

typedef double wall_load_array[WALL_LOADS];

// Motions of the balls along (x, r, t) by changes of the loads: accelerations, velocities, ways since the step's start.
typedef struct {
    double push[3][LANES], speed[3][LANES], way[3][LANES];
} BallMotions;

// Balls on the walls of half 0 (side -1) and 1 (side 1), or before them.
typedef struct {
    int count, of_0;                // all, those of half 0, which come first
    bool first;                     // the next substep is the first
    double middle, c;               // of the step [s]; compliance of the walls beside their modes
    wall_load_array K, Q;           // law w K delta^1.5, load at the step's start
    wall_load_array elastic, more;  // w K delta^1.5, and change of the load since the start
    // part of the normal towards the half's side, on which its share w of a contact depends
    wall_load_array towards;
    wall_load_array moved,
        speed;  // way of the approach since the start; its mean speed in the substep, at first the start's
    wall_load_array mobility;             // of wall, half and ball along the normal, tilts left out [1/kg]
    wall_load_array x, from;              // approach and motion of the wall at the step's start
    wall_load_array rate, acceleration;   // of the rigid approach, in the middle of the step and at its start
    wall_load_array along[CAGE_MOTIONS];  // motion along the normal by those of the halves
    wall_load_array normal[3];            // along (x, r, t) of the ball
    int ball[WALL_LOADS];
    BallMotions balls;
    mode_array shape[2 * Z];  // motion of the wall along the normal by S, and by D; of half 0 by -D
} WallLoads;

// Finds the loads of a step of length h from `fast` under the rates f.  state: velocities in the middle of the step; y: positions at its
// end, coordinates of the modes at its start; w: kinematics of the halves in the middle.
void wall_loads_find(const Model *model, double h, const FastState *fast, const double *f,
                     const double *state, const double *y, const Work *w, WallLoads *loads);

// Adds to the modes' accelerations (S, then D) the part by the change of the loads up to the time t of the step, the end of a substep of the
// length sub, and writes the parts of the halves and of the balls.  q: coordinates at t; moved: rigid motions of the halves by the fast
// accelerations and by this part.
void wall_loads_follow(const Model *model, double t, double sub, const double *q,
                       const double moved[CAGE_MOTIONS], WallLoads *loads, double slow[2 * N_MODES],
                       double push[CAGE_MOTIONS]);

// The same at the end of the step, at the velocities there: q_dot of the modes, `moving` of the halves beside the slow motion.
void wall_loads_end(const Model *model, const double *q_dot, const double moving[CAGE_MOTIONS],
                    WallLoads *loads, double slow[2 * N_MODES], double push[CAGE_MOTIONS]);

// Velocities of the balls by the changes of the loads, after another time t.
INLINE void ball_motions_push(double t, BallMotions *balls)
{
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < Z; k++) balls->speed[i][k] += t * balls->push[i][k];
}

INLINE void ball_motions_move(double t, BallMotions *balls)
{
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < Z; k++) balls->way[i][k] += t * balls->speed[i][k];
}

// Adds the ways of a step of length h to the state, and to the predicted velocities the part of the impulses that the trapezoidal rule
// of the changes of the accelerations at the step's end, `foreseen` in the order of the balls' velocities, does not have.
void ball_motions_arrive(const BallMotions *balls, double h, double *y, double foreseen[BALL_MOTIONS]);
