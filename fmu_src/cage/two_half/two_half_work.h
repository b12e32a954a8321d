// Results of one evaluation that rigid halves alone have.  Written by two_half.c.
#pragma once

#include "numbers/lanes.h"

typedef struct {
    // of the springs between the halves: pull of the rivet's, push of the plates' [N]
    ball_array pull, push;
    scalar dissipated;  // by their damping [W]

    // what bonded joints of halves that bend would carry in the plane (r, t) [N]
    ball_array bonded_V[2];

    // joints that open: (N, M_r, M_t) of the joint and (T, m_r, m_t) of its rivet, force between the plates
    ball_array load[3], rivet[3], N_plate;
} TwoHalfWork;
