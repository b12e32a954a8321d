"""How sure a mission's life is, and which runs make it surer.

Runs of one case differ by their seeds alone, and their damage scatters by chaos: roughly normal in its logarithm, by 1
% to a factor of ten.  Over many hours the damages themselves add up, so that the rate r_c of a case is the arithmetic
mean of its n runs.  The interval is Student's for the logarithm of life, without random numbers:

    e_c^2 = max(S^2/(n r_c^2), v/n + v^2/(2 (n - 1)))    variance of ln r_c; S standard deviation of the damages,
                                                         v variance of their logarithms
    s^2 = sum of (share_c e_c)^2                         of ln L, as d(ln L) = -sum of share_c d(ln r_c)
    nu = s^4/sum of (share_c e_c)^4/(n_c - 1)            degrees of freedom (Welch, Biometrika 34, 1947)
    ln life = ln L -+ t_nu s

The first variance is that of the runs.  The second one is that of a log-normal mean (Cox's, in Zhou and Gao, Statistics
in Medicine 16, 1997): few runs of a heavy tail have seldom met the tail, so that the runs alone look too sure.  A case
without weight in the damage changes nothing.  tests/test_mission.py measures how often the interval holds the truth.
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.stats import t as student

from .miner import NO_DAMAGE, lives

FEWEST = 3  # runs of a case that show scatter
GROWTH = 2.0  # a round has at most so many times the runs of a case before it
MARGIN = 0.9  # of the standard error that is needed: plan for a little less
WIDEST = 50.0  # half-width of ln life: e^50 is as good as unbounded, and finite
EQUAL = 1e-12  # standard error of ln(L_b/L_a) that is rounding


@dataclass(frozen=True)
class Estimate:
    """life, low, high [h]; half_width of ln life; place that fails first; shares [I]; case_shares [C]; error of ln r [C];
    spread, freedom: of ln life; rates: mean damage [C, K].
    """

    life: float
    low: float
    high: float
    half_width: float
    place: int
    shares: np.ndarray
    case_shares: np.ndarray
    error: np.ndarray
    spread: float
    freedom: float
    rates: np.ndarray


def estimate(duty, samples, confidence):
    """The Estimate from the runs: for each case their damages per hour or per event [n, K]; n at least FEWEST."""
    rates = np.array([runs.mean(axis=0) for runs in samples])
    hours, damage = lives(duty, rates)
    place = int(np.argmin(hours))
    life, shares = hours[place], damage[..., place].sum(axis=0)
    case_shares = np.einsum("ji,jic->c", damage[..., place], duty.blends)
    error = np.sqrt([variance([1.0], [runs[:, place]]) for runs in samples])
    s, freedom = combined((case_shares * error) ** 2, [len(runs) for runs in samples])
    half = half_width(s, freedom, confidence) if math.isfinite(life) else 0.0
    low, high = life * math.exp(-half), life * math.exp(half)
    return Estimate(life, low, high, half, place, shares, case_shares, error, s, freedom, rates)


def variance(weights, runs):
    """Variance of sum weight x ln(mean of runs [n]) with common seeds: that of the runs or of the law, the larger."""
    n, means = len(runs[0]), [max(x.mean(), NO_DAMAGE) for x in runs]
    own = np.var(sum(w * x / mean for w, x, mean in zip(weights, runs, means, strict=True)), ddof=1) / n
    if min(x.min() for x in runs) <= NO_DAMAGE:  # no logarithm
        return own
    weights, covariance = np.asarray(weights), np.atleast_2d(np.cov(np.log(runs)))
    of_law = weights @ (covariance / n + covariance**2 / (2.0 * (n - 1))) @ weights
    return max(own, of_law)


def combined(variances, counts):
    """Standard error and degrees of freedom of a sum, from the variances and runs of independent cases."""
    total = np.sum(variances)
    of_cases = np.sum(np.square(variances) / (np.asarray(counts) - 1))
    return math.sqrt(total), total**2 / of_cases if of_cases > 0.0 else math.inf


def half_width(s, freedom, confidence):
    """Student's half-width for a standard error with its degrees of freedom, WIDEST at most."""
    return min(float(student.ppf(0.5 + 0.5 * confidence, freedom)) * s, WIDEST)


def ratio_interval(samples, found, confidence):
    """Ends of the interval of ln(L_b/L_a) and the correlation of both, from two designs' damages [n, K] of each case with common
    seeds and Estimates: with the variances of -share_b ln r_b + share_a ln r_a.
    """
    middle = math.log(found[1].life / found[0].life)
    pairs = [[one[c][:, e.place] for one, e in zip(samples, found, strict=True)] for c in range(len(samples[0]))]
    weights = np.array([-found[0].case_shares, found[1].case_shares]).T
    counts = [len(pair[0]) for pair in pairs]
    s, freedom = combined([variance(w, pair) for w, pair in zip(weights, pairs, strict=True)], counts)
    if s < EQUAL:
        return middle, middle, 1.0
    half = half_width(s, freedom, confidence)
    return middle - half, middle + half, correlation(weights, pairs)


def correlation(weights, pairs):
    """Correlation of ln L_a and ln L_b over common seeds, 0 if one of them does not scatter."""
    total = np.zeros((2, 2))
    for w, pair in zip(np.abs(weights), pairs, strict=True):
        x = [x / max(x.mean(), NO_DAMAGE) for x in pair]
        total += np.outer(w, w) * np.cov(x) / len(x[0])
    scatter = math.sqrt(total[0, 0] * total[1, 1])
    return float(total[0, 1] / scatter) if scatter > 0.0 else 0.0


def further_runs(found, counts, target, most):
    """How many runs each case needs [C], the same if the half-width is at most `target` or every case that counts has `most`;
    share^2 v/n falls fastest where share times scatter is large (Neyman's allocation).
    """
    if found.half_width <= target:
        return counts.copy()
    weight = found.case_shares * found.error * np.sqrt(counts)
    error = math.sqrt(np.sum((found.case_shares * found.error) ** 2))
    needed = np.ceil(weight * weight.sum() / (MARGIN * error * target / found.half_width) ** 2)
    wanted = np.minimum(np.maximum(counts, np.minimum(needed, GROWTH * counts)), most).astype(int)
    if np.array_equal(wanted, counts):
        open_cases = np.where(counts < most, found.case_shares * found.error, 0.0)
        if open_cases.max() > 0.01 * error:
            wanted[open_cases.argmax()] += 1
    return wanted


def until_sure(duty, run, settings, most, progress=lambda found: None):
    """(Estimate, damages, numbers of runs) after rounds until ln life is narrow enough or no case may have more runs.

    run(counts [C]): damages [n, K] of each case, the first ones always the same; settings: of [life]; most: runs of a case.
    """
    counts = np.full(duty.blends.shape[2], min(settings["min_seeds"], most))
    while True:
        samples = run(counts)
        found = estimate(duty, samples, settings["confidence"])
        progress(found)
        wanted = further_runs(found, counts, math.log1p(settings["half_width"]), most)
        if np.array_equal(wanted, counts):
            return found, samples, counts
        counts = wanted
