"""The fit: a screen over the whole range, rounds of a surrogate, profiles of the likelihood, and fresh seeds.

With y_k(u) the surrogate's mean of target k and v_k its variance, seeds included, the search minimizes

    J(u) = sum over fitted k of (y_k - t_k)^2/(s_k^2 + v_k) + ln(1 + v_k/s_k^2),   and the priors' part,

that is -2 ln of the posterior density.  No deviation below uncertainty and noise pays.  The interval of a parameter is
the set of values whose least J over all other parameters exceeds the least of all by no more than the quantile of
chi^2 with one degree of freedom (profile likelihood; Venzon and Moolgavkar 1988).  A parameter whose interval is nearly
as wide as that of its prior is undecided.  If the targets are missed by significantly more than their uncertainty, the
quantile grows by the ratio (Birge 1932).  The answer's errors come from runs with seeds that the search has not seen.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import least_squares
from scipy.stats import chi2, qmc
from threadpoolctl import threadpool_limits

from ..base.errors import UserError, library
from .surrogate import Surrogate, Together, pruned

FRESH = 1000  # added to start.seed: seeds that the search has not seen
UNDECIDED = 0.9  # of the width of the prior's own interval
GRID = 11  # points of a profile over the whole range, beside those around the optimum
AROUND = np.array([0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0])  # of the latter, in standard deviations
CLOUD = 2048  # points at which J is looked at before it is minimized
STEP = 1e-4  # of difference quotients, in shares of the range
SIGNIFICANT = 1.96  # standard deviations
SMALL = 0.1  # of a target's variance: the surrogate is good enough


@dataclass(frozen=True)
class Interval:
    """A parameter's value with its interval, SI; decided: "both", "below" (bounded from below only), "above", "no"."""

    value: float
    low: float
    high: float
    decided: str
    profile: list  # (value, least J minus the least of all)


@dataclass(frozen=True)
class Check:
    """Mean and standard error [targets] with fresh seeds at parameter values, and RMS deviations in uncertainties of fitted and
    held-out targets with their scatter.
    """

    values: list
    mean: list
    error: list
    deviation: list
    fit: tuple
    held_out: tuple


@dataclass(frozen=True)
class Found:
    """Intervals and correlations; widened: factor on the quantile; effects [parameters, targets] over the range, in
    uncertainties; screen: Morris; answer, before: Checks; misfit: squares and degrees of freedom; notes.
    """

    study: object
    intervals: dict
    correlations: np.ndarray
    widened: float
    misfit: tuple
    effects: np.ndarray
    screen: dict
    answer: Check
    before: Check
    points: np.ndarray
    rounds: int
    notes: list


class Objective:
    """J over the unit cube from the surrogates of the fitted targets."""

    def __init__(self, study, u, values, surrogate=Surrogate):
        self.study = study
        chosen = np.flatnonzero(study.fitted)
        self.surrogates = {k: surrogate(u, values[:, :, k]) for k in chosen}
        self.parts = Together(list(self.surrogates.values()))  # mean and variance at points, [m, k]
        self.value = np.array([study.targets[k].value for k in chosen])
        self.variance = np.array([study.targets[k].uncertainty ** 2 for k in chosen])

    def residuals(self, u):
        """Figures whose squares add up to J, at points [m, d]: deviations, the variances' logarithms, priors."""
        mean, variance = self.parts(u)
        total = self.variance + variance
        known = [(p, u[:, j]) for j, p in enumerate(self.study.parameters) if p.mean is not None]
        prior = [np.abs(p.value(share) - p.mean) / p.sd for p, share in known]
        return np.hstack(
            [(mean - self.value) / np.sqrt(total), np.sqrt(np.log(total / self.variance)), *(x[:, None] for x in prior)]
        )

    def __call__(self, u):
        """J at points [m, d]."""
        return (self.residuals(np.atleast_2d(u)) ** 2).sum(axis=1)

    def squares(self, u):
        """The squared deviations of J alone."""
        mean, variance = self.parts(u)
        return float(((mean - self.value) ** 2 / (self.variance + variance)).sum())

    def least(self, u, fixed=()):
        """Point and J of the least value from u on; fixed: numbers of parameters that stay."""
        free = [j for j in range(len(u)) if j not in fixed]
        if not free:
            return np.array(u), float(self(u)[0])

        def at(x):
            """Residuals at x, and their difference quotients for the call after it."""
            point = np.array(u, float)
            point[free] = x
            r, at.slopes = quotients(self.residuals, point, free)
            return r

        def slopes(x):
            at(x)
            return at.slopes

        start = np.clip(np.array(u, float)[free], 0.0, 1.0)
        found = least_squares(
            at, start, slopes, bounds=(0.0, 1.0), method="dogbox", ftol=1e-6, xtol=1e-6, gtol=1e-6, max_nfev=40
        )
        best = np.array(u, float)
        best[free] = found.x
        return best, 2.0 * float(found.cost)

    def slopes(self, u):
        """d mean / d u of the fitted targets at a point [k, d]."""
        return quotients(lambda points: self.parts(points)[0], u, np.arange(len(u)))[1]

    def covariance(self, u):
        """Of the parameters as shares of their range, by Gauss and Newton; a uniform prior counts as its variance."""
        J, (_, variance) = self.slopes(u), self.parts(u)
        prior = [
            12.0 if p.mean is None else ((p.value(x + STEP) - p.value(x - STEP)) / (2 * STEP * p.sd)) ** 2
            for p, x in zip(self.study.parameters, u)
        ]
        return np.linalg.inv(J.T @ (J / (self.variance + variance[0])[:, None]) + np.diag(prior))


def quotients(figures, u, free):
    """Figures [k] at a point of the unit cube, and their difference quotients by its free parameters [k, d]."""
    h = np.where(u[free] > 0.5, -STEP, STEP)
    points = np.tile(u, (len(free) + 1, 1))
    points[np.arange(1, len(free) + 1), free] += h
    found = figures(points)
    return found[0], ((found[1:] - found[0]) / h[:, None]).T


@threadpool_limits.wrap(limits=1)  # small matrices, on which threads wait longer than they compute
def identify(study: Any, evaluate: Any, start: Any) -> Any:
    """The Found; evaluate(points [n, d], seeds) gives [n, seeds, targets]; start: SI values before the fit [d]."""
    seeds = range(study.settings["seed"], study.settings["seed"] + study.settings["seeds"])
    rng = np.random.default_rng(study.settings["seed"])
    u = screen_points(study)
    values = evaluate(study.values(u), seeds)
    screen, (u, values) = screening(study, u, values), whole(study, u, values)
    objective = Objective(study, u, values)
    best, J = minimum(objective, rng)
    rounds = 0
    for _ in range(study.settings["search"]["rounds"]):
        more = next_points(objective, best, rng, study.settings["search"]["points"])
        u, values = np.vstack([u, more]), np.concatenate([values, evaluate(study.values(more), seeds)])
        u, values = whole(study, u, values)
        objective, before, rounds = Objective(study, u, values), J, rounds + 1
        best, J = minimum(objective, rng, best)
        _, variance = objective.parts(best)
        if abs(before - J) < 0.5 and np.all(variance[0] < SMALL * objective.variance):
            break
    objective = Objective(study, u, values, pruned)
    best, J = minimum(objective, rng, best)
    for j in np.flatnonzero(~objective.parts.active.any(axis=1)):  # no fitted target sees it
        if study.parameters[j].mean is None:
            best[j] = 0.5
    intervals, widened, misfit = profiles(study, objective, best, J)
    C = objective.covariance(best)
    fresh = range(study.settings["seed"] + FRESH, study.settings["seed"] + FRESH + study.settings["check_seeds"])
    again = evaluate(np.vstack([study.values(best), start]), fresh)
    answer, untuned = (check(study, point, one) for point, one in zip([study.values(best)[0], start], again))
    correlations = C / np.sqrt(np.outer(np.diag(C), np.diag(C)))
    changes = effects(study, objective, u, values, best)
    found = Found(study, intervals, correlations, widened, misfit, changes, screen, answer, untuned, u, rounds, [])
    found.notes.extend(notes(found, objective, best))
    return found


def screen_points(study):
    """Points of the screen in the unit cube [n, d]."""
    settings, d = study.settings["screen"], len(study.parameters)
    problem = {"num_vars": d, "names": study.names, "bounds": [[0.0, 1.0]] * d}
    if settings["method"] == "morris":
        morris, count = library("SALib.sample.morris", "identify"), settings["trajectories"]
        return morris.sample(problem, count, num_levels=settings["levels"], seed=study.settings["seed"])
    return library("SALib.sample.latin", "identify").sample(problem, settings["count"], seed=study.settings["seed"])


def screening(study, u, values):
    """Morris' mean effects {target: {parameter: mu_star}} in units of the target; nothing for another design."""
    if study.settings["screen"]["method"] != "morris" or np.isnan(values).any():
        return {}
    morris = library("SALib.analyze.morris", "identify")
    problem = {"num_vars": len(study.names), "names": study.names, "bounds": [[0.0, 1.0]] * len(study.names)}
    levels, found = study.settings["screen"]["levels"], {}
    for k, target in enumerate(study.targets):
        effect = morris.analyze(problem, u, values[:, :, k].mean(axis=1), num_levels=levels, seed=1)
        found[target.name] = dict(zip(study.names, map(float, effect["mu_star"]), strict=True))
    return found


def whole(study, u, values):
    """Points all of whose runs have reached their end; UserError if too few are left."""
    good = np.isfinite(values).all(axis=(1, 2))
    if good.sum() < max(len(study.parameters) + 3, 0.5 * len(u)):
        raise UserError(
            f"{study.path}: {(~good).sum()} of {len(u)} points were stopped by the FMU or lack a figure: narrow the ranges, "
            "or set simulation.t_end higher (the rows in the folder say which)"
        )
    return u[good], values[good]


def minimum(objective, rng, *known):
    """Point and J of the least value found from the best points of a cloud."""
    d = len(objective.study.parameters)
    cloud = np.vstack([qmc.Sobol(d, seed=rng).random(CLOUD), *(point[None] for point in known)])
    order = np.argsort(objective(cloud))[:6]
    return min((objective.least(u) for u in [*cloud[order], *known]), key=lambda found: found[1])


def next_points(objective, best, rng, count):
    """The least point and others around it: half by the density of a cloud, half by the covariance there."""
    d = len(best)
    cloud = qmc.Sobol(d, seed=rng).random(CLOUD)
    J = objective(cloud)
    weight = np.exp(-0.25 * (J - J.min()))
    near = cloud[rng.choice(len(cloud), size=count // 2, replace=False, p=(weight + 1e-12) / (weight + 1e-12).sum())]
    wide = np.linalg.cholesky(4.0 * objective.covariance(best))
    around = np.clip(best + rng.normal(size=(max(count - len(near) - 1, 0), d)) @ wide.T, 0.0, 1.0)
    return np.vstack([best, near, around])[:count]


def profiles(study, objective, best, J):
    """Interval of each parameter, the factor by which the quantile was widened, and the misfit."""
    confidence = study.settings["confidence"]
    found, lines, C = {}, [], objective.covariance(best)
    for j in range(len(study.parameters)):
        near = AROUND * np.sqrt(C[j, j])
        grid = np.unique(
            np.clip([*np.linspace(0.0, 1.0, GRID), best[j], *(best[j] - near), *(best[j] + near)], 0.0, 1.0)
        )
        line, middle = np.empty(len(grid)), int(np.searchsorted(grid, best[j]))
        for places in (range(middle, len(grid)), range(middle - 1, -1, -1)):
            at = best
            for place in places:  # from the optimum outward, each from its neighbour
                point = at.copy()
                point[j] = grid[place]
                at, line[place] = objective.least(point, (j,))
        lines.append((grid, line))
    least = min(J, *(line.min() for _, line in lines))
    squares = objective.squares(best)
    freedom = len(objective.value) - len(study.parameters)
    widened = 1.0
    if squares > chi2.ppf(0.95, max(freedom, 1)):
        widened = squares / max(freedom, 1)
    limit = widened * chi2.ppf(confidence, 1)
    for j, (parameter, (grid, line)) in enumerate(zip(study.parameters, lines, strict=True)):
        rise = line - least
        low, high = crossing(grid, rise, best[j], limit)
        known = parameter.known(confidence)
        open_low, open_high = rise[0] <= limit, rise[-1] <= limit
        if high - low >= UNDECIDED * (known[1] - known[0]):
            decided = "no"
        else:
            decided = "above" if open_low else "below" if open_high else "both"
        value, ends = float(parameter.value(best[j])), parameter.value([low, high])
        found[parameter.name] = Interval(
            value, *map(float, ends), decided, [[float(parameter.value(x)), float(y)] for x, y in zip(grid, rise)]
        )
    return found, float(widened), (squares, freedom)


def crossing(grid, rise, best, limit):
    """Outermost ends around `best` where a profile stays within the limit, straight between its points."""
    inside = np.flatnonzero(rise <= limit)
    if not len(inside):
        return best, best
    ends = []
    for place, step in ((inside[0], -1), (inside[-1], 1)):
        beyond = place + step
        if 0 <= beyond < len(grid):
            share = (limit - rise[place]) / (rise[beyond] - rise[place])
            ends.append(grid[place] + share * (grid[beyond] - grid[place]))
        else:
            ends.append(grid[place])
    return float(ends[0]), float(ends[1])


def effects(study, objective, u, values, best):
    """Change of each target over each parameter's range at the answer, in uncertainties [parameters, targets]."""
    found = np.zeros((len(study.parameters), len(study.targets)))
    for k, target in enumerate(study.targets):
        surrogate = objective.surrogates.get(k) or pruned(u, values[:, :, k])
        for j in range(len(study.parameters)):
            line = np.tile(best, (21, 1))
            line[:, j] = np.linspace(0.0, 1.0, 21)
            found[j, k] = np.ptp(surrogate(line)[0]) / target.uncertainty
    return found


def check(study, values, figures):
    """The Check of figures [seeds, targets] at parameter values."""
    if not np.isfinite(figures).all():
        place = dict(zip(study.names, values))
        raise UserError(f"{study.path}: runs with fresh seeds were stopped by the FMU at {place}")
    wanted = np.array([target.value for target in study.targets])
    sigma = np.array([target.uncertainty for target in study.targets])
    mean, n = figures.mean(axis=0), len(figures)
    error = figures.std(axis=0, ddof=1) / np.sqrt(n)
    deviation = (mean - wanted) / np.hypot(sigma, error)

    def rms(mask):
        if not mask.any():
            return None
        z = lambda y: float(np.sqrt(np.mean((((y - wanted) / np.hypot(sigma, error))[mask]) ** 2)))
        left_out = np.array([z(np.delete(figures, i, axis=0).mean(axis=0)) for i in range(n)])
        scatter = float(np.sqrt((n - 1) / n * ((left_out - left_out.mean()) ** 2).sum()))  # jackknife
        return z(mean), scatter

    fitted = study.fitted
    return Check(*(list(map(float, one)) for one in (values, mean, error, deviation)), rms(fitted), rms(~fitted))


def notes(found, objective, best):
    """Sentences about the answer: what the data do not decide, and what the fit predicts."""
    study = found.study
    for name, one in found.intervals.items():
        if one.decided == "no":
            yield f"The data do not decide {name}: the interval is as wide as the range that was known before."
        elif one.decided in ("below", "above"):
            yield f"The data bound {name} only from {one.decided}."
    for i, name in enumerate(study.names):
        for j in range(i):
            if abs(found.correlations[i, j]) > 0.9:
                yield (
                    f"{study.names[j]} and {name} are decided only together: their correlation is {found.correlations[i, j]:.2f}."
                )
    for parameter in study.parameters:
        one = found.intervals[parameter.name]
        if one.decided != "no" and not 0.01 < parameter.share(one.value) < 0.99:
            yield f"{parameter.name} lies at the end of the range that was searched."
    squares, freedom = found.misfit
    if found.widened > 1.0:
        yield (
            f"The model misses the fitted targets by more than their uncertainty (chi-square {squares:.3g} of {len(objective.value)} "
            f"targets with {len(study.names)} parameters): the intervals' squares are widened by {found.widened:.3g}."
        )
    elif freedom <= 0:
        yield (
            f"There are {len(objective.value)} fitted targets for {len(study.names)} parameters: the fit cannot show whether the model is right."
        )
    mean, variance = objective.parts(best)
    fresh = np.array(found.answer.mean)[study.fitted]
    error = np.array(found.answer.error)[study.fitted]
    off = np.abs(fresh - mean[0]) / np.sqrt(variance[0] + error**2 + SMALL * objective.variance)
    if off.max() > 3.0:
        name = [target.name for target in study.targets if not target.held_out][int(off.argmax())]
        yield f"The surrogate is off at the answer (target {name}): more rounds or points are needed."
    if found.answer.fit[0] < 1.0:
        yield "The fit's error is below the targets' uncertainty: a smaller one would be fitted to noise."
    if found.answer.held_out is None:
        yield "No target is held out: nothing shows what the fit predicts."
    else:
        after, before = (np.array(one.deviation)[~study.fitted] for one in (found.answer, found.before))
        yield prediction(after, before, found.answer.held_out[1], found.before.held_out[1])


def prediction(after, before, *scatter):
    """What the fit is worth on unseen targets, from their deviations after and before; scatter: of both RMS by the seeds.

    Squares fall by D, which the targets' uncertainty scatters by 2 |after - before|, as it shifts both alike.
    """
    n, errors = len(after), [float(np.sqrt(np.mean(z**2))) for z in (after, before)]
    D = n * (errors[1] ** 2 - errors[0] ** 2)
    seeds = [2.0 * n * error * own for error, own in zip(errors, scatter, strict=True)]
    limit = SIGNIFICANT * np.sqrt(4.0 * ((after - before) ** 2).sum() + sum(x**2 for x in seeds))
    text = f"held-out error {errors[0]:.3g} after and {errors[1]:.3g} before the fit, in uncertainties"
    if D > limit:
        return f"The fit predicts: {text}."
    if D < -limit:
        return f"The fit predicts worse than the values before it: {text}."
    within = f"{text}, a difference within the scatter of targets and seeds"
    if D > 0.0:
        return f"The held-out targets do not show whether the fit predicts: {within}."
    return f"The fit predicts nothing: {within}."
