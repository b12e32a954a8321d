// From the dynamics to the rivets: loads of each joint as the stress table wants them.  Equations in rivets.c.
#pragma once

#include "isa.h"
#include "model.h"
#include "rivet_rom.h"

// Loads of all rivets at the state of w, as the stress table takes them.
typedef void RivetsLoad(const Model *model, const Work *w, RivetLoads *load);
RivetsLoad rivets_load;

// Limits the prying moments: where one opens its joint, the joint turns, and the cage half carries the rest to its neighbours.
// M stays up to M_0 = prying_lever (P - N), beyond it grows by prying_share only.  C0; the direction is kept.
void joint_prying(const JointData *j, RivetLoads *load);

// Slip of half 1 against half 0 at each joint, in the plane [m].
INLINE void rivets_slip(const Model *model, const Work *w, scalar slip[Z])
{
    const bool rigid = model->p->scene.cage == CAGE_MODEL_RIGID;
    for (int k = 0; k < Z; k++) slip[k] = rigid ? 0.0 : scalar_sqrt(w->u_y[k] * w->u_y[k] + w->u_z[k] * w->u_z[k]);
}
