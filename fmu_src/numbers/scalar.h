// A `scalar` is a number that depends on state, inputs or time: a double, or, where kernels and outputs are
// compiled for derivatives, a dual number (dual.h).
#pragma once

#ifdef DUAL
typedef double _Complex scalar;
#else
typedef double scalar;
#endif

static const double PI = 3.14159265358979323846;
