// `scalar`: whatever depends on state, inputs or time.  A double; where kernels and outputs are compiled for derivatives a dual number (dual.h).
#pragma once

#ifdef DUAL
typedef double _Complex scalar;
#else
typedef double scalar;
#endif
