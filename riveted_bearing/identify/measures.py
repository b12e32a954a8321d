"""Figures of a channel over time that a run and a measurement have in common: moments, quantiles, lines of a spectrum.

A Measure is computed by the worker that has the run, and by the same code from a measured series.  Points in time are
never compared: the motion is chaotic.
"""

import re
from dataclasses import dataclass

import numpy as np
from scipy.signal import welch

from ..base.errors import UserError
from ..running.summary import settled

STATISTICS = {
    "std": np.std,
    "q05": lambda x: np.quantile(x, 0.05),
    "q50": lambda x: np.quantile(x, 0.5),
    "q95": lambda x: np.quantile(x, 0.95),
}
SEGMENTS = 8  # of a measured series, from whose scatter its uncertainty follows
UNEVEN = 0.01  # of the mean step: times beyond it have no spectrum
FEWEST = 4  # lines of the spectrum below a band


@dataclass(frozen=True)
class Measure:
    """A figure of a channel: a key of STATISTICS, "line" (RMS amplitude in low ... high [Hz]) or "band" (its log10)."""

    kind: str
    channel: str
    low: float = 0.0
    high: float = 0.0

    @property
    def column(self):
        """Name of the column that a row has for it."""
        band = f", {self.low:g} ... {self.high:g} Hz" if self.kind in ("line", "band") else ""
        return f"{self.kind}({self.channel}{band})"

    def __call__(self, t, values):
        """The figure of values at the times t [s]; nan where the series is too short for the band."""
        if self.kind in STATISTICS:
            return float(STATISTICS[self.kind](values))
        amplitude = amplitude_between(t, values, self.low, self.high)
        return amplitude if self.kind == "line" else float(np.log10(max(amplitude, 1e-300)))


def amplitude_between(t, values, low, high):
    """RMS amplitude between two frequencies [Hz], by Welch with Hann windows whose length depends on the band alone; A/sqrt(2)
    of a sine.  nan if times are not equally spaced or windows too short.
    """
    steps = np.diff(t)
    if len(t) < 16 or np.abs(steps / steps.mean() - 1.0).max() > UNEVEN:
        return float("nan")
    rate = 1.0 / steps.mean()
    wanted = int(np.ceil(FEWEST * rate / min(max(low, 1e-300), high - low)))
    if wanted > len(t) or high > 0.5 * rate:
        return float("nan")
    f, density = welch(values, rate, nperseg=wanted, detrend="constant")
    half = 0.5 * f[1]  # a line of the density stands for its neighbourhood
    inside = np.clip(np.minimum(f + half, high) - np.maximum(f - half, low), 0.0, None)
    return float(np.sqrt((density * inside).sum()))


def of_result(measures, result):
    """Columns of a row from a run's Result, after start.settle; a worker calls it."""
    late = settled(result)
    t = result.data["time"][late]
    return {measure.column: measure(t, result.data[measure.channel][late]) for measure in measures}


def of_series(measure, t, values):
    """The figure of a measured series and its standard uncertainty from the scatter of SEGMENTS parts of it."""
    parts = [measure(*part) for part in zip(np.array_split(t, SEGMENTS), np.array_split(values, SEGMENTS))]
    return measure(t, values), float(np.std(parts, ddof=1) / np.sqrt(SEGMENTS))


def parsed(text):
    """A Measure of a text such as "std(housing.F_y)"; None for the name of another column."""
    match = re.fullmatch(r"(\w+)\(([^(),]+)\)", text)
    return Measure(match[1], match[2]) if match and match[1] in STATISTICS else None


def bands(low, high, count):
    """Ends of bands with equal ratios [count, 2]."""
    if not 0.0 < low < high:
        raise UserError(f"a spectrum from {low:.4g} to {high:.4g} Hz is empty: a longer or a finer series is needed")
    ends = np.geomspace(low, high, count + 1)
    return np.column_stack([ends[:-1], ends[1:]])
