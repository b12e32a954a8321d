"""Running statistics over time: mean, RMS, largest value and quantiles of positive quantities.

The values at both ends of a step count for half of its length each (fmu_src/instance/statistics.h says why).
64 bins in each octave, 213 a decade: a bin is 0.8...1.6 % wide; 24 octaves above the channel's floor.  Smaller values
count as below the floor.
"""

import numpy as np

STATISTICS_OCTAVES, STATISTICS_PER_OCTAVE = 24, 64
STATISTICS_BINS = STATISTICS_OCTAVES * STATISTICS_PER_OCTAVE


def bin_of(ratio):
    """Bin of value/floor >= 1."""
    mantissa, exponent = np.frexp(ratio)
    octave = (np.array(exponent) - 1) * STATISTICS_PER_OCTAVE
    return np.minimum(octave + ((2.0 * mantissa - 1.0) * STATISTICS_PER_OCTAVE).astype(int), STATISTICS_BINS - 1)


def edge_of(bin_):
    """Lower edge of a bin as a multiple of the floor."""
    return (1.0 + (bin_ % STATISTICS_PER_OCTAVE) / STATISTICS_PER_OCTAVE) * 2.0 ** (bin_ // STATISTICS_PER_OCTAVE)


class StatisticsChannel:
    """Statistics of one quantity; floor: smaller values are not resolved.

    >>> channel = StatisticsChannel(1e-3)
    >>> channel.add(np.array([2.0, 6.0]), np.array([4.0, 0.0]), np.array([0.0, 0.0]))
    >>> channel.mean, channel.rms
    (np.float64(0.5), np.float64(1.4142135623730951))
    """

    def __init__(self, floor):
        self.floor = floor
        self.time, self.first, self.second, self.max = 0.0, 0.0, 0.0, 0.0
        self.weight = np.zeros(STATISTICS_BINS)

    def add(self, h, before, now):
        """Add steps of lengths h [s] with the values at their starts and at their ends, arrays of one shape."""
        weight, value = np.tile(0.5 * h, 2), np.concatenate([before, now])
        self.time += np.sum(weight)
        self.first += np.sum(weight * value)
        self.second += np.sum(weight * value * value)
        self.max = max(self.max, np.max(value, initial=0.0))
        counts = value >= self.floor
        self.weight += np.bincount(
            bin_of(value[counts] / self.floor), weights=weight[counts], minlength=STATISTICS_BINS
        )

    @property
    def mean(self):
        return self.first / self.time if self.time > 0.0 else 0.0

    @property
    def rms(self):
        return np.sqrt(self.second / self.time) if self.time > 0.0 else 0.0

    def quantile(self, p):
        """Value that the quantity does not exceed in the part p of the time: linear inside a bin, 0 below the floor."""
        above = (1.0 - p) * self.time  # weight that lies above the quantile
        beyond = np.cumsum(self.weight[::-1])[::-1]  # weight in this bin and higher ones
        reached = np.flatnonzero((self.weight > 0.0) & (beyond >= above))
        if self.time <= 0.0 or len(reached) == 0:
            return 0.0
        bin_ = reached[-1]
        low, high = edge_of(bin_), edge_of(bin_ + 1)
        rest = above - (beyond[bin_] - self.weight[bin_])
        return min(self.floor * (high - (high - low) * rest / self.weight[bin_]), self.max)
