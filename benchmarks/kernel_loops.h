// Loops around the kernels of one instruction set, and the processor's own limits.
#pragma once

#include "physics/rhs.h"

enum { ELEMENTS = 10 };

typedef enum { PEAK_ARITHMETIC, PEAK_LOAD, PEAK_DIVIDE, PEAK_ROOT, PEAKS } Peak;

// Processor time [ns] of one evaluation, states y[0...n-1] in turn, mean over `rounds` rounds.
typedef double RhsTime(const Model *model, int n, const double *y, int rounds, Work *w);

// Processor time [ns] of each element at one state, mean over `rounds` calls.
typedef void ElementTimes(const Model *model, const double *y, int rounds, Work *w, double ns[ELEMENTS]);

// Processor time [ns] of one instruction of each kind in a loop of independent ones.
typedef void PeakTimes(long rounds, double ns[PEAKS]);

#define rhs_time FOR_ISA(rhs_time)
#define element_times FOR_ISA(element_times)
#define peak_times FOR_ISA(peak_times)
RhsTime rhs_time;
ElementTimes element_times;
PeakTimes peak_times;
