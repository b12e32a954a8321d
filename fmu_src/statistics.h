// Running statistics over time, weighted by the length of the steps: mean, RMS, largest value and quantiles of positive quantities.
#pragma once

// 32 bins in each octave, 106 a decade: a bin is 1.6...3.1 % wide; 24 octaves above the channel's floor.  Smaller values count as below.
enum { STATISTICS_OCTAVES = 24, STATISTICS_PER_OCTAVE = 32, STATISTICS_BINS = STATISTICS_OCTAVES * STATISTICS_PER_OCTAVE };

// Plain bytes; all zeros is an empty channel.
typedef struct {
    double time, first, second, max;  // sums of weight, weight x, weight x^2; largest x
    double below;                     // weight of values under the floor
    double weight[STATISTICS_BINS];
} StatisticsChannel;

void statistics_add(StatisticsChannel *channel, double floor, double weight, double value);
double statistics_mean(const StatisticsChannel *channel);
double statistics_rms(const StatisticsChannel *channel);

// Value that the part p of the time is not above; linear inside a bin, 0 below the floor.
double statistics_quantile(const StatisticsChannel *channel, double floor, double p);
