// Running statistics over time: mean, RMS, largest value and quantiles of positive quantities.  The values at both ends
// of a step count for half of its length each.  Were the value at its end to count for all of it, the shorter steps into
// a pulse would weigh less than the longer ones out of it: 99.9 % of the pocket force would err by up to 2 % at any tolerance.
#pragma once

#include <stdbool.h>

// 64 bins in each octave, 213 in each decade: a bin is 0.8...1.6 % wide.  Where a motion repeats itself a
// quantile can be wrong by a whole bin.  There are 24 octaves above the channel's floor; smaller values count
// as below the floor.
enum {
    STATISTICS_OCTAVES = 24,
    STATISTICS_BITS = 6,  // of the mantissa
    STATISTICS_PER_OCTAVE = 1 << STATISTICS_BITS,
    STATISTICS_BINS = STATISTICS_OCTAVES * STATISTICS_PER_OCTAVE
};

// Plain bytes; all zeros is an empty channel.
typedef struct {
    double time, first, second, max;  // sums of weight, weight x, weight x^2; largest x
    double below;                     // weight of values below the floor
    double weight[STATISTICS_BINS];
} StatisticsChannel;

// Adds a step of length h from the value `before` to the value `now`.
void statistics_add(StatisticsChannel *channel, double floor, double h, double before, double now);
double statistics_mean(const StatisticsChannel *channel);
double statistics_rms(const StatisticsChannel *channel);

// Quantile: the value that is not exceeded for the part p of the time.  Linear inside a bin, 0 below the
// floor.
double statistics_quantile(const StatisticsChannel *channel, double floor, double p);

// Whether adding values for `time` at most can have made it.
bool statistics_is_valid(const StatisticsChannel *channel, double time);
