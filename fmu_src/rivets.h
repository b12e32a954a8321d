// From the dynamics to the rivets: loads of each joint as the stress table wants them.  Equations in rivets.c.
#pragma once

#include "isa.h"
#include "model.h"
#include "rivet_rom.h"

// Loads of all rivets at the state of w, as the stress table takes them; V: modulus of the whole transverse load of the joint [N].
typedef void RivetsLoad(const Model *model, const Work *w, RivetLoad load[Z], number V[Z]);
RivetsLoad rivets_load;

// Slip of half 1 against half 0 at each joint, in the plane [m].
INLINE void rivets_slip(const Model *model, const Work *w, number slip[Z])
{
    const bool rigid = model->p->scene.cage == CAGE_MODEL_RIGID;
    for (int k = 0; k < Z; k++) slip[k] = rigid ? 0.0 : number_sqrt(w->u_y[k] * w->u_y[k] + w->u_z[k] * w->u_z[k]);
}
