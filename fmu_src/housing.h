// Load on the housing at one evaluation of the right-hand side.
#pragma once

#include "rotor.h"

// Force and moment about the bearing's centre that balls and cage put on the housing (outer ring, oil).
// All forces on balls and cage together accelerate them; the housing carries the forces that the ring puts on
// balls and cage less the sum that accelerates them.
static inline void housing_reaction(const Work *w, scalar F[3], scalar M[3])
{
    const Rotor *bodies[3] = {&w->ring, &w->half[0], &w->half[1]};
    for (int i = 0; i < 3; i++) F[i] = M[i] = 0.0;

    // forces and moments on ring and cage halves
    for (int b = 0; b < 3; b++) {
        scalar lever[3];
        cross3(bodies[b]->x, bodies[b]->F, lever);
        for (int i = 0; i < 3; i++) {
            F[i] -= bodies[b]->F[i];
            M[i] -= bodies[b]->M[i] + lever[i];
        }
    }

    // less the forces and moments on the balls
    for (int j = 0; j < Z; j++) {
        const scalar c = w->cos_theta[j], s = w->sin_theta[j];
        const scalar position[3] = {w->x[j], w->r[j] * c, w->r[j] * s};
        const scalar force[3] = {w->F_x[j], w->F_r[j] * c - w->F_t[j] * s, w->F_r[j] * s + w->F_t[j] * c};
        const scalar moment[3] = {w->M_x[j], w->M_r[j] * c - w->M_t[j] * s, w->M_r[j] * s + w->M_t[j] * c};
        scalar lever[3];
        cross3(position, force, lever);
        for (int i = 0; i < 3; i++) {
            F[i] -= force[i];
            M[i] -= moment[i] + lever[i];
        }
    }
}
