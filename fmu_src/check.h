// Numbers that come from outside, in a saved state.
#pragma once

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

// Whether all of them are numbers whose products of a few stay finite: no quantity of the model, in SI units, comes near this bound.
static inline bool values_are_sane(const double *value, size_t n)
{
    const double LARGEST = 1e60;
    for (size_t i = 0; i < n; i++)
        if (!(fabs(value[i]) <= LARGEST)) return false;
    return true;
}

// Whether they are, and none is negative.
static inline bool values_are_amounts(const double *value, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (!(value[i] >= 0.0)) return false;
    return values_are_sane(value, n);
}

// Whether it is a number of events that was counted in steps of one.
static inline bool value_is_count(double value)
{
    const double MOST = 4503599627370496.0;  // 2^52: one more still counts
    return value >= 0.0 && value <= MOST && value == floor(value);
}
