// Running statistics.  The exponent of a number and the first bits of its mantissa give its bin, without
// a logarithm.
#include "instance/statistics.h"

#include "numbers/saved_numbers.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

// Bin of the ratio value/floor >= 1.
static int bin_of(double ratio)
{
    uint64_t word;
    memcpy(&word, &ratio, sizeof word);
    const int64_t bin = (int64_t)(word >> (52 - STATISTICS_BITS)) - ((int64_t)1023 << STATISTICS_BITS);
    return bin < STATISTICS_BINS ? (int)bin : STATISTICS_BINS - 1;
}

// Lower edge of a bin as a multiple of the floor.
static double edge_of(int bin)
{
    return ldexp(1.0 + (bin % STATISTICS_PER_OCTAVE) / (double)STATISTICS_PER_OCTAVE,
                 bin / STATISTICS_PER_OCTAVE);
}

static void count(StatisticsChannel *channel, double floor, double weight, double value)
{
    if (value > channel->max) channel->max = value;
    if (value < floor)
        channel->below += weight;
    else
        channel->weight[bin_of(value / floor)] += weight;
}

void statistics_add(StatisticsChannel *channel, double floor, double h, double before, double now)
{
    const double weight = 0.5 * h;
    channel->time += h;
    if (before == 0.0 && now == 0.0) {  // most balls touch no pocket
        channel->below += h;
        return;
    }
    channel->first += weight * (before + now);
    channel->second += weight * (before * before + now * now);
    count(channel, floor, weight, before);
    count(channel, floor, weight, now);
}

double statistics_mean(const StatisticsChannel *channel)
{
    return channel->time > 0.0 ? channel->first / channel->time : 0.0;
}

double statistics_rms(const StatisticsChannel *channel)
{
    return channel->time > 0.0 ? sqrt(channel->second / channel->time) : 0.0;
}

double statistics_quantile(const StatisticsChannel *channel, double floor, double p)
{
    double above = (1.0 - p) * channel->time;  // weight above the quantile; the bins are summed from the top
    if (channel->time <= 0.0) return 0.0;
    for (int bin = STATISTICS_BINS - 1; bin >= 0; bin--) {
        const double weight = channel->weight[bin];
        if (weight > 0.0 && weight >= above) {
            const double low = edge_of(bin), high = edge_of(bin + 1);
            return fmin(floor * (high - (high - low) * above / weight), channel->max);
        }
        above -= weight;
    }
    return 0.0;
}

bool statistics_is_valid(const StatisticsChannel *channel, double time)
{
    const double most = time * (1.0 + 1e-6);  // rounding of the sums
    bool fine = channel->time <= most && channel->below <= most;
    for (int bin = 0; bin < STATISTICS_BINS; bin++) fine &= channel->weight[bin] <= most;
    fine &= values_are_amounts(&channel->time, 1) && values_are_amounts(&channel->below, 1) &&
            values_are_amounts(channel->weight, STATISTICS_BINS);
    return fine && values_are_sane(&channel->first, 1) && values_are_amounts(&channel->second, 1) &&
           values_are_amounts(&channel->max, 1);
}
