"""No two bearings alike: tolerances as distributions, and the scatter of life over bearings that are drawn from them.

Of a lognormal one 68 % lie within median/factor ... median factor.
"""

import math
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from ..base.errors import UserError, refusal, refusing, unknown
from ..base.files import write_json
from ..base.toml_files import leaves
from ..base.units import check_alike, differences, to_si
from ..running.fmu import Model
from .assess import Life, Runs, places
from .blends import Case, loosened
from .mission import Mission
from .weibull import Weibull, fit_weibull

DISTRIBUTIONS = {
    "normal": ("mean", "sd"),
    "lognormal": ("median", "factor"),
    "uniform": ("low", "high"),
    "triangular": ("low", "mode", "high"),
}
RECORD = "bearings.json"


@dataclass(frozen=True)
class Tolerances:
    """Numbers of bearings and seeds, share of the damage, and distributions of scipy.stats by parameter (SI)."""

    bearings: int
    seeds: int
    share: float
    distributions: dict


@dataclass(frozen=True)
class Scatter:
    """lives [h]; draws: {parameter: values}; noise: share of the seeds in the variance of ln life; law: Weibull."""

    lives: np.ndarray
    draws: dict = field(repr=False)
    noise: float
    law: Weibull


def read_tolerances(mission: Mission, model: Model) -> Any:
    """The Tolerances of a mission, None if it has none; raises UserError naming parameter and distribution."""
    path, section = mission.path, mission.file.tolerance
    if section is None:
        return None
    given = dict(leaves(section.parameters, model.parameters))
    if not given:
        raise UserError(f"{path}: tolerance.parameters: name at least one parameter with its distribution")
    laws = {name: distribution(path, name, entry, model) for name, entry in given.items()}
    return Tolerances(section.bearings, section.seeds, section.share, laws)


def distribution(path, name, entry, model):
    """The frozen distribution of one parameter."""
    from scipy import stats

    where = f"tolerance.{name}"
    if name not in model.parameters:
        raise unknown(path, "parameter", name, model.parameters)
    variable = model.parameters[name]
    if variable.type != "Real":
        raise refusal(path, where, entry, "only real numbers have distributions")
    kind = entry.get("distribution") if isinstance(entry, dict) else None
    if kind not in DISTRIBUTIONS:
        raise refusal(path, f"{where}.distribution", kind, f"allowed: {', '.join(DISTRIBUTIONS)}")
    if set(entry) != {"distribution", *DISTRIBUTIONS[kind]}:
        raise refusal(path, where, entry, f"{kind} needs {', '.join(DISTRIBUTIONS[kind])}, and nothing else")
    scales, values = model.units[variable.unit], []
    for key in DISTRIBUTIONS[kind]:
        allowed = {"1": (1.0, 0.0)} if key == "factor" else differences(scales) if key == "sd" else scales
        with refusing(path, f"{where}.{key}", entry[key]):
            values.append(to_si(entry[key], allowed))
    with refusing(path, where, entry):
        check_alike([entry[key] for key in DISTRIBUTIONS[kind] if key != "factor"], scales)
    first, *rest = values
    if kind == "normal" and rest[0] > 0.0:
        return stats.norm(first, rest[0])
    if kind == "lognormal" and first > 0.0 and rest[0] > 1.0:
        return stats.lognorm(math.log(rest[0]), scale=first)
    if kind == "uniform" and first < rest[0]:
        return stats.uniform(first, rest[0] - first)
    if kind == "triangular" and first < rest[1] and first <= rest[0] <= rest[1]:
        return stats.triang((rest[0] - first) / (rest[1] - first), loc=first, scale=rest[1] - first)
    reason = "sd above 0, median above 0, factor above 1, low below high and mode between them are allowed"
    raise refusal(path, where, entry, reason)


def drawn(tolerances, seed):
    """Values of the parameters of all bearings: {name: [bearings]}."""
    rng = np.random.default_rng(seed)
    return {name: law.rvs(tolerances.bearings, random_state=rng) for name, law in tolerances.distributions.items()}


def scatter(
    life: Life,
    tolerances: Any,
    model: Model,
    folder: Path,
    client: Any,
    progress: Any = None,
    runs_of: Any = None,
) -> Any:
    """The Scatter of life over bearings drawn from the tolerances: parts with the share asked for run for each, common seeds, at
    the start's preload.  runs_of(mission): its runs(counts), None for the FMU's in a folder.
    """
    mission, settings = life.mission, life.mission.settings
    draws = drawn(tolerances, settings["seed"])
    chosen = decisive_parts(life, tolerances.share)
    cases = [
        Case(i, changed(mission, model, i, {name: float(values[b]) for name, values in draws.items()}))
        for b in range(tolerances.bearings)
        for i in chosen
    ]
    of_bearings = replace(mission, cases=tuple(cases), settings=settings | {"max_seeds": tolerances.seeds})
    runs = runs_of(of_bearings) if runs_of else Runs(of_bearings, model, folder / "bearings", client, progress)
    samples = runs([tolerances.seeds] * len(cases))
    weights = mission.duty.weights
    rest = sum(weights[i] * life.rates[i] for i in range(len(mission.parts)) if i not in chosen)
    lives, noise = [], []
    for b in range(tolerances.bearings):
        own = samples[b * len(chosen) : (b + 1) * len(chosen)]
        weighted = [weights[i] * runs for i, runs in zip(chosen, own, strict=True)]
        damage = places((rest + sum(runs.mean(axis=0) for runs in weighted))[None], settings["rivets"])[0]
        place = int(damage.argmax())
        lives.append(1.0 / damage[place])
        at_place = [places(runs, settings["rivets"])[:, place] for runs in weighted]
        if tolerances.seeds > 1:
            spread = np.array([np.log(np.maximum(runs, 1e-300)).std(ddof=1) for runs in at_place])
            shares = np.array([runs.mean() for runs in at_place]) / damage[place]
            error = np.expm1(np.minimum(spread, 5.0) ** 2) / tolerances.seeds  # of the mean of log-normal runs, squared
            noise.append(np.sum(shares**2 * error))
    lives = np.array(lives)
    share = float(np.mean(noise) / np.log(lives).var(ddof=1)) if noise else math.nan
    return Scatter(lives, draws, share, fit_weibull(lives, confidence=settings["confidence"]))


def decisive_parts(life, share):
    """Numbers of the simulated parts that together have the share of the damage, the largest first."""
    chosen, reached = [], 0.0
    for i, part in sorted(zip(life.kept, life.estimate.shares, strict=True), key=lambda pair: -pair[1]):
        if reached >= share:
            break
        reached += part
        if life.mission.parts[i].scene is not None:
            chosen.append(i)
    return chosen


def changed(mission, model, i, values):
    """The scene of part i for a bearing with these parameters; preload times the part's own factor."""
    part = mission.parts[i]
    scene = part.scene
    for name, value in values.items():
        try:
            model.check_range(value, model.parameters[name])
        except UserError as problem:
            reason = f"a bearing drawn from the distribution is impossible: {problem}"
            raise refusal(mission.path, f"tolerance.{name}", value, reason) from None
    scene = replace(scene, parameters=scene.parameters | values)
    return loosened(scene, part.factor, model)


def write_scatter(found: Any, path: Path) -> Path:
    """Write bearings.json: Weibull law, the seeds' share, lives and what was drawn; returns the path."""
    document = found.law.record() | {
        "confidence": found.law.confidence,
        "seeds_share": found.noise if math.isfinite(found.noise) else None,
        "lives_h": found.lives.tolist(),
        "drawn": {name: values.tolist() for name, values in found.draws.items()},
    }
    return write_json(path, document)
