// Numbers that come from outside, in a saved state.
#pragma once

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

// [s] Doubles are 2 us apart there, as far as internal steps are long.
static const double LARGEST_TIME = 1e10;
// Of an input by time, as a host may set it: far from overflow.
static const double LARGEST_DERIVATIVE = 1e50;

// Whether all of them are numbers between -largest and largest.
static inline bool values_are_within(const double *value, size_t n, double largest)
{
    for (size_t i = 0; i < n; i++)
        if (!(fabs(value[i]) <= largest)) return false;
    return true;
}

// Whether products of a few of them stay finite: no sum of the model, in SI units, comes near this bound.
static inline bool values_are_sane(const double *value, size_t n)
{
    return values_are_within(value, n, 1e60);
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
