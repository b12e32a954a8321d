// Joints that open, from instant to instant: see joint_follow.c.
#pragma once

#include "cage/common/joint_law.h"
#include "numbers/isa.h"

enum { FOLLOW_VALUES = 6, FOLLOW_GIVEN = 4 };  // moves and the rivet's loads; N, M_r, M_t, P

// Tangents by which the joints answer, each with the L* and P of its place, and the moves found last.  All
// zeros: no instant before.
typedef struct {
    bool known;  // set where many joints open, from when on they are followed
    ball_array at[FOLLOW_GIVEN], value[FOLLOW_VALUES], slope[FOLLOW_VALUES][FOLLOW_GIVEN];
    JointMoves move;
} JointTangents;

// What joints_open finds, more exactly, from the tangents of the instant before, which it renews where they
// do not reach.
void joints_follow(const JointLaw *law, ball_array bonded[3], const ball_array P, const constants intact,
                   scalar spin_M, scalar spin_P, JointTangents *tangents, ball_array load[3],
                   ball_array rivet[3]);
