// How balls approach a half of the cage along given directions, both as rigid bodies.
#pragma once

#include "physics/model.h"

// Rates and accelerations of the balls of a packet against half h along given directions, both as rigid bodies.
typedef struct {
    scalar rate[LANE_WIDTH], acceleration[LANE_WIDTH];
    scalar direction[3][LANE_WIDTH];  // along x, r, t of the ball
    scalar
        along[RELATIVE_MOTIONS]
             [LANE_WIDTH];  // motion along the direction by velocities of the half: x, y, z, beta, gamma, s
} RigidApproach;

// Of the balls from j on, at the time gamma before the positions y; direction: (x, r, t) along the pockets' axes; f: slow rates;
// state: velocities there; w: kinematics of the halves there.
void rigid_approach(const Model *model, double gamma, const double *const direction[3], const double *f,
                    const double *state, const double *y, const Work *w, int h, int j, RigidApproach *to);
