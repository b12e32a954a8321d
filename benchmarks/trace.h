// Instruction counts.
#pragma once

#include "instance/part.h"
#include "physics/rhs.h"

// Each runs a call in a child process and writes the address of each instruction on the way (those around the
// call too, a repeated string instruction once); returns their number, < 0 on failure or if there are more than `max_count`.

// One evaluation of the right-hand side.
long trace_rhs(Rhs *function, const Model *model, const double *y, Work *w, unsigned long *address,
               long max_count);

// The communication step to t.  The instance itself stays where it is.
long trace_step(Part *part, double t, unsigned long *address, long max_count);
