// From the dynamics to the rivets: loads of each joint as the stress table wants them.  Equations in rivets.c.
#pragma once

#include "model.h"
#include "rivet_rom.h"

// Loads of all rivets at the state of w, as the stress table takes them; V: modulus of the whole transverse load of the joint [N].
void rivets_load(const Model *model, const Work *w, RivetLoad load[Z], number V[Z]);

// Slip of half 1 against half 0 at each joint, in the plane [m].
void rivets_slip(const Model *model, const Work *w, number slip[Z]);
