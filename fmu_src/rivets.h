// From the dynamics to the rivets: loads of each joint as arguments of the stress table.  Equations in
// rivets.c.
#pragma once

#include "isa.h"
#include "model.h"
#include "rivet_rom.h"

// Loads of all rivets from the results w of the right-hand side.
typedef void RivetsLoad(const Model *model, const Work *w, RivetLoads *load);
RivetsLoad rivets_load;

// Limits the prying moments.  A moment above M_0 = prying_lever (P - N) opens its joint; the joint then turns
// and takes only prying_share of what exceeds M_0, and the cage half carries the rest to the neighbouring
// joints.  The direction of the moment is kept; its size is C0.
void joint_prying(const JointData *j, RivetLoads *load);

// Slip of half 1 against half 0 at each joint, in the plane [m].
INLINE void rivets_slip(const Model *model, const Work *w, scalar slip[Z])
{
    const bool rigid = model->p->scene.cage == CAGE_MODEL_RIGID;
    for (int k = 0; k < Z; k++)
        slip[k] = rigid ? 0.0 : scalar_sqrt(w->u_y[k] * w->u_y[k] + w->u_z[k] * w->u_z[k]);
}
