// Loads of balls on the walls of elastic halves within a step.  Equations in wall_loads.c; twin:
// bearing_model/cage/elastic/wall_loads.py.
#pragma once

#include "cage/elastic/cage_substeps.h"

// A ball on the wall of half 0 (side -1) or 1 (side 1), or before it.
typedef struct {
    double side, K, c, damped;  // Q = K delta^1.5 times `damped`; compliance of the wall beside its modes
    double x, Q;                // approach and load at the step's start
    double rate, acceleration;  // of the rigid approach, in the middle of the step
    double from;                // the wall's motion at the step's start
    mode_array shape;           // its motion along the normal by S; by D: side times that
} WallLoad;

typedef struct {
    int count;
    double middle;  // of the step [s]
    WallLoad of[2 * Z];
} WallLoads;

// Those of a step of length h from `fast` under the rates f.  state: velocities in the middle of the step; y: positions at its
// end, coordinates of the modes at its start; w: kinematics of the halves in the middle.
#define wall_loads_find FOR_ISA(wall_loads_find)
void wall_loads_find(const Model *model, double h, const FastState *fast, const double *f,
                     const double *state, const double *y, const Work *w, WallLoads *loads);

// Adds to the modes' accelerations (S, then D) what the loads have changed by at the time t of the step, q: coordinates there.
#define wall_loads_follow FOR_ISA(wall_loads_follow)
void wall_loads_follow(const Model *model, double t, const double *q, const WallLoads *loads,
                       double slow[2 * N_MODES]);
