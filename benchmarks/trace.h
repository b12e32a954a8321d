// Instruction counts.
#pragma once

#include "rhs.h"

// Runs one evaluation and writes the address of each instruction on the way (those around the call too); returns their number, < 0 on failure.
long trace_rhs(Rhs *function, const Model *model, const double *y, Work *w, unsigned long *address, long most);
