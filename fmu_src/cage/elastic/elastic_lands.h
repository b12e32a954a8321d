// The films of the lands on the rivets of elastic halves.  Equations in elastic_lands.c.
#pragma once

#include "cage/common/cage_joint.h"
#include "physics/model.h"

// Loads (N, M_r, M_t) of the joints and (T, m_r, m_t) of their rivets.
typedef struct {
    ball_array load[3], rivet[3];
} LandedJoints;

// Whether the rivets feel the films.  If so, sets the loads with the films and adds the shear loads that the films put on plates,
// heads and shanks.  P: preloads with the centrifugal load.
bool elastic_lands(const Model *model, const Work *w, const ball_array P, LandedJoints *joints,
                   JointShear *shear);
