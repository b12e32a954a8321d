// The cage's own centrifugal load, which the rivet table has per (rad/s)^2 for a half of its own mass: for the bonded
// joints of rigid halves, and for the modes of elastic ones.
#pragma once

#include "rivet/rivet_rom.h"

// Factor of the table's load: the mass of the half over that of the table, 0 without the load.
static inline double cage_centrifugal(const Parameters *p)
{
    return p->cage.centrifugal == SWITCH_ON ? p->cage.m / rivet_table.half.m : 0.0;
}
