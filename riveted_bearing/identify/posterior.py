"""From findings to causes: likelihood of each finding in each design of the pool, and the posterior of the causes.

For design i of cause c, with n broken rivets, rates r [Z, 2] of the places in each state of its history, and S = TRUST:

    hours    log10 of the hours: normal about that of the n-th break, standard deviation life_decades and the finding's own;
             hours that are not known: the probability that the n-th break comes within `within`
    places   middles among heads and middles: beta-binomial, mean p = mean over the states of sum(r_middle)/sum(r), S p + 1/2, S (1 - p) + 1/2
    sides    formed heads among heads of a known side: beta-binomial about f^-k/(f^-k + 1), f the strength of formed heads
    order    breaks beside a gap: beta-binomial about the mean share of the rates that the neighbours of the gone rivets have;
             without an order the number of groups that the gone rivets form, as in the design's own history, or another by 1 in S
    loose    loose ones among those that stand: beta-binomial about the share of rivets below LOOSE of the mission's preload
    missing  rivets that were never set: as many as in the design, else one in a hundred
    marks    heavy with probability Phi(ln(x/(2 x_0))/ln 2), x_0 the median of sound designs, within SURE
    measured normal about the design's value, or with BLUNDER a value anywhere

The odds of places are those of their rates, because strengths scatter: with a slope of 15 their logarithm scatters by 1.3,
and the largest of such are distributed about as by Plackett and Luce (1975) with weights r.

    L_c = product over the measured q of p(q | c)  times  sum_i K_i product of the likelihoods of the others / sum_i K_i

p(q | c) is the density over the cause's whole range, K_i a kernel that is as wide as a quarter of the range, so that few
designs suffice.  The posterior is prior times L, its interval from bootstrap resamples of the designs, that is the Monte
Carlo error.  "None of these" predicts each finding evenly: all numbers of middles and all groups alike, hours evenly over
six decades, marks by a coin, values anywhere.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.special import betaln, comb
from scipy.stats import norm

from .candidates import SOUND, own_value, quantity_at
from .findings import LOOSE, NONE, Findings, Study
from .pool import CURVE, RESPONSES, Sample, weakened

TRUST = 20.0  # broken rivets, as many as a design's own prediction is worth
SURE = (0.02, 0.98)  # of a mark
BLUNDER = 0.02
DECADES = 6.0  # of the hours, evenly, if none of the causes is it
RESAMPLES = 400
INTERVAL = (0.05, 0.95)
CREDIBLE = 0.9
GRID = 400


@dataclass(frozen=True)
class Predicted:
    """log10 of the hours of breaks; probability of a middle and of a neighbour in each state; order; missing; share of loose
    ones; probability of marks; values of quantities.
    """

    cause: int
    hours: np.ndarray
    middle: np.ndarray
    beside: np.ndarray
    formed: float
    order: tuple
    missing: tuple
    loose: float
    responses: dict
    values: dict

    def at(self, n: int) -> float:
        """log10 of the hours of the n-th break; what follows the last one that was simulated comes at once."""
        return float(self.hours[min(n, len(self.hours)) - 1]) if len(self.hours) else np.inf


def predictions(samples: list[Sample], study: Study, model: Any, scene: Any) -> list[Predicted]:
    """What Samples predict.  Where a cause acts in a share of the hours, the sound design of the same number has the rest."""
    found = [predicted(sample, study, model, scene) for sample in samples]
    sound = {s.number: p.hours for s, p in zip(samples, found, strict=True) if study.causes[s.cause].name == SOUND}
    return [
        replace(p, hours=shared(p.hours, sound.get(s.number, np.array([])), s.design.get("model.share", 1.0)))
        for s, p in zip(samples, found, strict=True)
    ]


def shared(decades, others, share):
    """log10 of the hours of breaks that have those of `decades` in a share of the time, and of `others` in the rest."""
    if share == 1.0:
        return decades
    rates = np.zeros((2, max(len(decades), len(others))))
    rates[0, : len(decades)], rates[1, : len(others)] = 10.0**-decades, 10.0**-others
    with np.errstate(divide="ignore"):
        return -np.log10(np.array([share, 1.0 - share]) @ rates)


def predicted(sample: Sample, study: Study, model: Any, scene: Any) -> Predicted:
    """What a Sample predicts if its cause acts all the time."""
    design, states, Z = sample.design, sample.history["states"], study.Z
    turns = abs(design.get("shaft.omega", own_value(study.path, "shaft.omega", model, scene))) / (2.0 * np.pi) * 3600.0
    curve = [own_value(study.path, name, model, scene) for name in CURVE]
    strengths = np.full((Z, 2), design.get("model.strength", 1.0))
    formed = min(1.0, design.get("model.formed", 1.0))
    strengths[:, 0] *= formed
    strengths[0, 0] *= design.get("model.weak", 1.0)
    middle, beside, order, hours = [], [], [], []
    for state in states:
        rates = weakened(np.array(state["rates"]), strengths, curve, turns)
        rates[[k - 1 for k in state["gone"]]] = 0.0
        if not rates.sum() > 0.0:
            break
        middle.append(rates[:, 1].sum() / rates.sum())
        near = [k - 1 for k in range(1, Z + 1) if k not in state["gone"] and touches(k, state["gone"], Z)]
        beside.append(rates[near].sum() / rates.sum() if state["gone"] else np.nan)
        if state["hours"] is not None:
            order.append(state["rivet"])
            hours.append(state["hours"])
    total = np.cumsum(hours)
    if worn := design.get("model.worn", 0.0):
        lost = max(0.0, worn - design["joint.preload"])
        total = total + lost / max(sample.history["preload_loss"], 1e-300)
    preload = design.get("joint.preload", 1.0) / max(own_value(study.path, "joint.preload", model, scene), 1e-9)
    factors = [design.get(f"rivet[{k}].preload_factor", 1.0) for k in range(1, Z + 1)]
    missing = tuple(k for k in range(1, Z + 1) if design.get(f"rivet[{k}].intact", 1) == 0)
    with np.errstate(divide="ignore"):
        decades = np.log10(total)
    values = {}
    for name, q in study.quantities.items():
        own = 0.0 if "[*]" in q.quantity else own_value(study.path, q.quantity, model, scene)
        values[name] = quantity_at(q.quantity, design, own)
    shares = np.array(middle), np.array(beside), 1.0 / (1.0 + formed ** curve[2])
    loose = float(np.mean(preload * np.array(factors) < LOOSE))
    marks = {name: sample.history.get(name, np.nan) for name in RESPONSES}
    return Predicted(sample.cause, decades, *shares, tuple(order), missing, loose, marks, values)


def touches(rivet, gone, Z):
    """Whether a rivet is beside one that is gone."""
    return any((rivet - k) % Z in (1, Z - 1) for k in gone)


def groups(gone, Z):
    """Number of groups that the gone rivets form around the cage."""
    gone = set(gone)
    return 1 if len(gone) == Z else sum(k % Z + 1 not in gone for k in gone)


def beta_binomial(k, n, p, trust=TRUST):
    """Probability of k of n where p is expected with so much trust."""
    a, b = trust * p + 0.5, trust * (1.0 - p) + 0.5
    return comb(n, k) * np.exp(betaln(k + a, n - k + b) - betaln(a, b))


def heavy(responses, sound):
    """Probability of a heavy mark; a half where sound bearings have nothing that marks, as without lands."""
    with np.errstate(divide="ignore", invalid="ignore"):
        p = np.clip(norm.cdf(np.log(np.asarray(responses) / (2.0 * sound)) / np.log(2.0)), *SURE)
    return np.where(np.isnan(p), 0.5, p)


def likelihoods(found: Findings, pool: list[Predicted], Z: int, decades: float, sound: dict) -> dict[str, tuple]:
    """For each finding its likelihood in each Predicted, and if none of the causes is it."""
    n, counts, values = found.broken, found.counts, {}
    at = np.array([one.at(n) for one in pool])
    if found.hours is not None:
        sd = np.hypot(decades, found.hours[1])
        values["hours"] = norm.pdf(found.hours[0], at, sd), 1.0 / DECADES
    else:
        values["broke at all"] = norm.cdf((np.log10(found.within) - at) / decades), 1.0
    first = [slice(0, n)] * len(pool)
    if known := counts["head"] + counts["middle"]:
        p = np.array([np.mean(one.middle[s]) if len(one.middle) else 0.5 for one, s in zip(pool, first, strict=True)])
        values["places"] = beta_binomial(counts["middle"], known, p), 1.0 / (known + 1)
    if known := counts["formed"] + counts["set"]:
        p = np.array([one.formed for one in pool])
        values["sides of the heads"] = beta_binomial(counts["formed"], known, p), 1.0 / (known + 1)
    values |= pattern(found, pool, Z)
    if "loose" in found.looked and (standing := Z - n - counts["missing"]):
        p = np.array([one.loose for one in pool])
        values["loose"] = beta_binomial(counts["loose"], standing, p), 1.0 / (standing + 1)
    if "missing" in found.looked:
        values["missing"] = np.array([0.99 if len(one.missing) == counts["missing"] else 0.01 for one in pool]), 0.5
    for name, is_heavy in found.marks.items():
        p = heavy([one.responses[name] for one in pool], sound[name])
        values[f"mark: {name}"] = (p if is_heavy else 1.0 - p), 0.5
    return values


def pattern(found, pool, Z):
    """Likelihood of which rivets broke, in order if it is known."""
    missing = found.places["missing"]
    if len(found.order) > 1 and missing is not None:
        steps = [touches(k, [*missing, *found.order[:i]], Z) for i, k in enumerate(found.order) if i or missing]
        p = np.array([float(np.nanmean(one.beside)) if np.isfinite(one.beside).any() else 0.5 for one in pool])
        return {"order": (beta_binomial(sum(steps), len(steps), p), 1.0 / (len(steps) + 1))}
    if found.gone is None or not 2 <= len(found.gone) <= Z - 2:
        return {}
    seen, most = groups(found.gone, Z), min(len(found.gone), Z - len(found.gone))
    match = []
    for one in pool:
        gone = [*one.missing, *one.order][: len(found.gone)]
        same = len(gone) == len(found.gone) and groups(gone, Z) == seen
        match.append((TRUST * same + 1.0) / (TRUST + most) if len(gone) == len(found.gone) else 1.0 / most)
    return {"which rivets": (np.array(match), 1.0 / most)}


@dataclass(frozen=True)
class Answer:
    """posterior [causes + none] and its bootstrap; single: likelihood of each finding over its mean; effective: designs of a
    cause; weights: of designs; inspections: (name, text, bits).
    """

    names: list
    posterior: np.ndarray
    resampled: np.ndarray
    single: dict
    effective: np.ndarray
    weights: np.ndarray
    inspections: list
    decided: bool
    credible: list

    def interval(self, k: int) -> tuple[float, float]:
        """Interval of a probability by the Monte Carlo error."""
        low, high = np.quantile(self.resampled[:, k], INTERVAL)
        return float(low), float(high)

    @property
    def ranked(self) -> list[int]:
        """Numbers of the causes, the most probable first."""
        return [int(k) for k in np.argsort(-self.posterior, kind="stable")]


def answer(study: Study, pool: list[Predicted], seed: int = 1, inspect: bool = True) -> Answer:
    """The Answer to the findings of a Study from its pool."""
    found, names = study.findings, [*(cause.name for cause in study.causes), NONE]
    of = np.array([one.cause for one in pool])
    sound = sound_medians(study, pool)
    values = likelihoods(found, pool, study.Z, study.file.life_decades, sound)
    product = np.prod([value for value, _ in values.values()], axis=0) if values else np.ones(len(pool))
    evenly = float(np.prod([even for _, even in values.values()]))
    kernel, density, even = measured(study, pool, of)
    rng = np.random.default_rng(seed)
    members = [np.flatnonzero(of == k) for k in range(len(study.causes))]
    # designs of all causes have the same sound part: they are resampled together
    common = rng.random((RESAMPLES, max(map(len, members))))
    draws = [(common[:, : len(m)] * len(m)).astype(int) for m in members]

    def of_cause(values, k, draw=None):
        """Kernel mean of likelihoods of a cause's designs."""
        chosen = members[k] if draw is None else members[k][draw]
        w = kernel[chosen]
        total = w.sum(axis=-1)
        return np.where(total > 0.0, (w * values[chosen]).sum(axis=-1) / np.where(total > 0.0, total, 1.0), 0.0)

    K = range(len(study.causes))
    L = np.array([*(of_cause(product, k) * density[:, k].prod() for k in K), evenly * np.prod(even)])
    drawn = (of_cause(product, k, draws[k]) * density[:, k].prod() for k in K)
    resampled = np.stack([*drawn, np.full(RESAMPLES, L[-1])], axis=1)
    posterior, resampled = normalized(study.prior * L), normalized(study.prior * resampled)
    single = {name: np.array([*(of_cause(value, k) for k in K), other]) for name, (value, other) in values.items()}
    single |= {f"measured: {name}": np.append(density[q], even[q]) for q, name in enumerate(found.measured)}
    single = {name: value / (study.prior @ value) for name, value in single.items()}
    weights = kernel * product
    effective = np.array([weights[m].sum() ** 2 / max((weights[m] ** 2).sum(), 1e-300) for m in members])
    order = np.argsort(-posterior, kind="stable")
    credible = [int(k) for k in order[: int(np.searchsorted(np.cumsum(posterior[order]), CREDIBLE)) + 1]]
    low, high = np.quantile(resampled, INTERVAL, axis=0)
    decided = bool(posterior[order[0]] > 0.5 and low[order[0]] > high[order[1]])
    bits = inspections(study, pool, members, weights, posterior, sound) if inspect else []
    return Answer(names, posterior, resampled, single, effective, weights, bits, decided, credible)


def sound_medians(study: Study, pool: list[Predicted]) -> dict[str, float]:
    """Medians of the sound bearing's responses."""
    reference = [cause.name for cause in study.causes].index(SOUND)
    return {name: float(np.nanmedian([p.responses[name] for p in pool if p.cause == reference])) for name in RESPONSES}


def normalized(values):
    """Values over their sum along the last axis."""
    total = values.sum(axis=-1, keepdims=True)
    return values / np.where(total > 0.0, total, 1.0)


def measured(study, pool, of):
    """Kernel of each design, density of each measured quantity under each cause [q, causes] and evenly [q]."""
    kernel = np.ones(len(pool))
    density, even = np.ones((len(study.findings.measured), len(study.causes))), []
    for q, (name, (value, sd)) in enumerate(study.findings.measured.items()):
        x = np.array([one.values[name] for one in pool])
        span = max(float(max(x.max(), value) - min(x.min(), value)), 6.0 * sd)
        even.append(1.0 / span)
        for k, cause in enumerate(study.causes):
            own, at = cause.ranges.get(study.quantities[name].quantity), of == k
            if own is not None and "[*]" not in study.quantities[name].quantity:
                points = own.at((np.arange(GRID) + 0.5) / GRID)
            else:
                points = x[at]
            width = np.hypot(sd, np.ptp(points) / (len(points) if own is not None else 4.0))
            density[q, k] = (1.0 - BLUNDER) * np.mean(norm.pdf(value, points, width)) + BLUNDER / span
            kernel[at] *= np.exp(-0.5 * ((value - x[at]) / max(sd, np.ptp(points) / 4.0, 1e-300)) ** 2) + 1e-12
    return kernel, density, np.array(even)


def inspections(study, pool, members, weights, posterior, sound):
    """Expected information on the cause [bits] of what has not been inspected yet, largest first, and the most there is."""
    K, found, bits = len(study.causes), study.findings, []
    P = posterior / posterior.sum()
    for name, quantity in study.quantities.items():
        if name in found.measured:
            continue
        x = np.array([one.values[name] for one in pool])
        sd = quantity.sd(x)
        span = max(float(np.ptp(x)), 6.0 * float(np.max(sd)), 1e-300)
        grid = np.linspace(x.min() - 0.2 * span, x.max() + 0.2 * span, GRID)
        density = np.full((K + 1, GRID), 1.0 / (grid[-1] - grid[0]))
        for k, m in enumerate(members):
            w = normalized(weights[m]) if weights[m].sum() > 0.0 else np.full(len(m), 1.0 / len(m))
            width = np.hypot(np.maximum(sd[m], grid[1] - grid[0]), np.ptp(x[m]) / 12.0)
            density[k] = (w[:, None] * norm.pdf(grid, x[m][:, None], width[:, None])).sum(axis=0)
        bits.append((name, quantity.text, information(P, normalized(density))))
    for name in RESPONSES:
        if name not in found.marks:
            p = heavy([one.responses[name] for one in pool], sound[name])
            heavy_of = [float(normalized(weights[m]) @ p[m]) if weights[m].sum() > 0.0 else 0.5 for m in members]
            heavy_of.append(0.5)
            bits.append((f"mark: {name}", "wear mark", information(P, np.array([[h, 1.0 - h] for h in heavy_of]))))
    return sorted(bits, key=lambda one: -one[2])


def information(P, outcomes):
    """Mutual information [bits] of causes with probabilities P [K] and outcomes with probabilities [K, m]."""
    possible = P > 0.0
    P, outcomes = P[possible], outcomes[possible]
    mean = np.broadcast_to(P @ outcomes, outcomes.shape)
    ratio = np.divide(outcomes, mean, out=np.ones_like(mean), where=(outcomes > 0.0) & (mean > 0.0))
    return float((P[:, None] * outcomes * np.log2(ratio)).sum())
