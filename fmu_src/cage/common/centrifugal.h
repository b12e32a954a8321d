// The centrifugal load of the cage halves.  The rivet table gives this load per (rad/s)^2 for the mass of the table's
// half.  It loads the bonded joints of rigid halves and the modes of elastic halves.
#pragma once

#include "rivet/rivet_rom.h"

// Factor of the table's load: the mass of the half over that of the table, 0 without the load.
static inline double cage_centrifugal(const Parameters *p)
{
    return p->cage.centrifugal == SWITCH_ON ? p->cage.m / rivet_table.half.m : 0.0;
}
