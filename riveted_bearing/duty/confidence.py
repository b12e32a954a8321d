"""How sure a mission's life is, and which runs make it surer.

Runs of one case differ by their seeds alone, and their damage scatters by chaos: roughly normal in its logarithm, by 1
% to a factor of ten.  Over many hours the damages themselves add up, so that the rate of a case is the arithmetic mean
of its runs.  The interval is a studentized bootstrap of residuals (Davison and Hinkley, Bootstrap Methods and their
Application, 1997, 2.4 and 3.2): logarithms of runs are drawn again as the case's mean plus its standard deviation times
a residual of any case, and

    t* = (ln L* - ln L_0)/s*        L_0 the life of what is drawn from, s* the standard error that the drawn runs show
    ln L - t*(1 - a/2) s < ln life < ln L - t*(a/2) s

The standard error follows from the shares that the cases have in the damage: d(ln L) = -sum of share_c d(ln r_c).
"""

import math
from dataclasses import dataclass

import numpy as np

from .miner import NO_DAMAGE, lives, part_rates

DRAWS = 2000
FEWEST = 3  # runs of a case that show scatter
GROWTH = 2.0  # a round has at most so many times the runs of a case before it
MARGIN = 0.9  # of the standard error that is needed: plan for a little less


@dataclass(frozen=True)
class Estimate:
    """life, low, high [h]; half_width of ln life; place: index of the place that fails first; shares: of the parts [I];
    case_shares [C]; error: standard error of ln r of each case [C]; draws: lives of the bootstrap [h]; rates: mean
    damage of the cases [C, K].
    """

    life: float
    low: float
    high: float
    half_width: float
    place: int
    shares: np.ndarray
    case_shares: np.ndarray
    error: np.ndarray
    draws: np.ndarray
    rates: np.ndarray


def estimate(duty, samples, confidence, seed):
    """The Estimate from the runs: for each case their damages per hour or per event [n, K]; n at least FEWEST."""
    rates = np.array([runs.mean(axis=0) for runs in samples])
    life, damage = lives(duty, rates)
    place = int(np.argmin(life))
    logs, spread, counts = scatter_of(samples)
    case_shares = np.einsum("ji,jic->c", damage[..., place], duty.blends)
    error = relative_error(spread[:, place], counts)
    s = math.sqrt(np.sum((case_shares * error) ** 2))
    shares = damage[..., place].sum(axis=0)
    if s == 0.0 or not math.isfinite(life[place]):
        return Estimate(
            life[place],
            life[place],
            life[place],
            0.0,
            place,
            shares,
            case_shares,
            error,
            np.full(1, life[place]),
            rates,
        )
    t, drawn = bootstrap(duty, logs, spread, counts, np.random.default_rng(seed), 0.1 * s)
    low, high = (
        life[place] * math.exp(-quantile * s)
        for quantile in np.quantile(t, [0.5 + 0.5 * confidence, 0.5 - 0.5 * confidence])
    )
    return Estimate(life[place], low, high, 0.5 * math.log(high / low), place, shares, case_shares, error, drawn, rates)


def scatter_of(samples):
    """Logarithms of the damages of each case's runs, their standard deviations [C, K], and the numbers of runs [C]."""
    logs = [np.log(np.maximum(runs, NO_DAMAGE)) for runs in samples]
    return logs, np.array([log.std(axis=0, ddof=1) for log in logs]), np.array([len(runs) for runs in samples])


def ratio_interval(duties, samples, found, confidence, seed):
    """Ends of the interval of ln(L_b/L_a) and the correlation of both over the draws, from two designs' Duties, damages
    [n, K] of each case with common seeds and equal numbers of runs, and Estimates.

    The studentized bootstrap above, in which a draw has the same runs for both:
    s^2 = s_a^2 + s_b^2 - 2 r s_a s_b, r the correlation of ln L_a* and ln L_b*.
    """
    drawn = [
        drawn_lives(duty, *scatter_of(runs), np.random.default_rng(seed))
        for duty, runs in zip(duties, samples, strict=True)
    ]
    errors = [math.sqrt(np.sum((one.case_shares * one.error) ** 2)) for one in found]
    middle = math.log(found[1].life / found[0].life)
    deviation = drawn[1][0] - drawn[0][0]
    if np.abs(deviation).max() < 1e-12:
        return middle, middle, 1.0
    scatter = drawn[0][0].std() * drawn[1][0].std()
    r = float(np.corrcoef(drawn[0][0], drawn[1][0])[0, 1]) if scatter > 0.0 else 0.0
    combined = lambda a, b: np.sqrt(np.maximum(a**2 + b**2 - 2.0 * r * a * b, 0.0))
    s = float(combined(*errors))
    t = deviation / np.maximum(combined(drawn[0][1], drawn[1][1]), 0.1 * s)
    low, high = np.quantile(t, [0.5 - 0.5 * confidence, 0.5 + 0.5 * confidence])
    return middle - high * s, middle - low * s, r


def relative_error(spread, counts):
    """Standard error of ln of the mean of n runs whose logarithms have the standard deviation `spread` (log-normal
    law).
    """
    return np.sqrt(np.expm1(np.minimum(spread, 5.0) ** 2) / counts)


def bootstrap(duty, logs, spread, counts, rng, least_error):
    """Studentized deviations of ln life and the lives themselves, DRAWS of each; the standard error of a draw is at
    least `least_error`.
    """
    deviation, s, shortest = drawn_lives(duty, logs, spread, counts, rng)
    return deviation / np.maximum(s, least_error), shortest


def drawn_lives(duty, logs, spread, counts, rng):
    """DRAWS deviations of ln life, their standard errors, and the lives [h]; the same runs are drawn for other logs of
    the same counts by an equal rng.
    """
    centres = np.array([log.mean(axis=0) for log in logs])
    scale = np.where(spread > 0.0, spread, 1.0)
    pool = np.concatenate(
        [(log - centres[c]) / scale[c] * math.sqrt(len(log) / (len(log) - 1)) for c, log in enumerate(logs)]
    )
    pool = pool - pool.mean(axis=0)
    truth = np.array([np.exp(centres[c] + spread[c] * pool).mean(axis=0) for c in range(len(logs))])
    means, deviations = np.empty((2, DRAWS, *centres.shape))
    for c, n in enumerate(counts):
        drawn = spread[c] * pool[rng.integers(0, len(pool), (DRAWS, n))]
        means[:, c], deviations[:, c] = np.exp(centres[c] + drawn).mean(axis=1), drawn.std(axis=1, ddof=1)
    life, damage = lives(duty, means)
    place = life.argmin(axis=-1)
    at_place = np.take_along_axis(damage, place[:, None, None, None], axis=-1)[..., 0]
    shares = np.einsum("bji,jic->bc", at_place, duty.blends)
    errors = relative_error(np.take_along_axis(deviations, place[:, None, None], axis=-1)[..., 0], counts)
    s = np.sqrt(np.sum((shares * errors) ** 2, axis=-1))
    shortest, expected = life.min(axis=-1), lives(duty, truth)[0].min()
    return np.log(shortest) - math.log(expected), s, shortest


def further_runs(found, counts, target, most):
    """How many runs each case needs [C], none if the half-width of ln life is at most `target` or every case that
    counts has `most`.

    Runs are spent where share times scatter is large, so that the sum of the variances share^2 v/n falls fastest
    (Neyman's allocation).
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


def part_means(duty, found):
    """Damage per hour or event of each part at the place that fails first, at the start of the mission [I]."""
    return part_rates(duty, found.rates)[0][:, found.place]


def until_sure(duty, run, settings, most, progress=lambda found: None):
    """Rounds of runs until the half-width of ln life is small enough or no case may have more runs.

    run: called with the numbers of runs of the cases [C], returns their damages, for each case [n, K], the first ones
    always the same, so that a repeated call goes through the same rounds; settings: of [life]; most: runs of a case;
    progress: called with the Estimate after each round. Returns (Estimate, damages, numbers of runs).
    """
    counts = np.full(duty.blends.shape[2], min(settings["min_seeds"], most))
    while True:
        samples = run(counts)
        found = estimate(duty, samples, settings["confidence"], settings["seed"])
        progress(found)
        wanted = further_runs(found, counts, math.log1p(settings["half_width"]), most)
        if np.array_equal(wanted, counts):
            return found, samples, counts
        counts = wanted
