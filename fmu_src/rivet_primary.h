// Peak channels of all rivets, at every step: the table's fast reader.
#pragma once

#include "isa.h"
#include "rivet_rom.h"

typedef void RivetPrimary(const RivetTable *t, const JointLoads *load, double fit_eff, double head_p1[Z], double mid_vm[Z]);

// HEAD_P1 and MID_VM of Z rivets [Pa].
RivetPrimary rivet_primary;
