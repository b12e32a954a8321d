// From the dynamics to the rivets: loads of all joints, of which the stress table takes those of the rivets.
// Equations in rivets.c.
#pragma once

#include "cage/two_half/joint_follow.h"
#include "numbers/isa.h"
#include "physics/model.h"
#include "rivet/rivet_rom.h"

// Loads of all joints from the results w of the right-hand side.
typedef void RivetsLoad(const Model *model, const Work *w, JointLoads *load);
RivetsLoad rivets_load;

// The same from one instant of a run to the next: joints that open answer by their tangents (joint_follow.h).
typedef void RivetsFollow(const Model *model, const Work *w, JointTangents *tangents, JointLoads *load);
RivetsFollow rivets_follow;

// Slip of half 1 against half 0 at each joint, in the plane [m].
INLINE void rivets_slip(const Model *model, const Work *w, scalar slip[Z])
{
    for (int k = 0; k < Z; k++)
        slip[k] = scalar_sqrt(w->u_y[k] * w->u_y[k] + w->u_z[k] * w->u_z[k]);
}
