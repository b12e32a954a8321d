"""What to choose: the point of a box at which responses are smallest, found by Optuna under the noise of the seeds.

The search sees each point as a mean over common seeds (tree-structured Parzen estimator).  What looks best under noise
is partly luck, so that the candidates, one of several objectives the ones of the Pareto front, are simulated again with
fresh seeds, and the answer and its confidence come from these alone.  The search repeats itself bit by bit from its
seed, so that a call after a stop reads the runs that are done and goes on from there.
"""

import math
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from pydantic import Field

from ..base.errors import UserError, library, refusal, unknown
from ..base.file_kinds import check_keys
from ..base.files import write_json
from ..base.schema import Count, Named, checked
from ..base.units import to_si
from ..running.fmu import Model
from ..running.responses import COLUMNS, display_of, displayed, shown, titled
from ..show.style import FORCE, HEAD, MIDDLE, MUTED, picture
from .bench import BenchFile, Box, Responses

FRESH = 1000  # added to start.seed: seeds that the search has not seen
BAD = 1e30  # of an objective whose run was stopped


class OptimizeFile(BenchFile):
    """What to choose: the point of a box at which the objectives are smallest."""

    objectives: Responses = Field(["damage"], description='to be small; "-name" to be large')
    limits: Named = Field({}, description="largest value by response")
    trials: Annotated[int, Count()] = 40
    batch: Annotated[int, Count()] = Field(4, description="points simulated side by side")
    check_seeds: Annotated[int, Count(2, "from 2 on, which show scatter, is allowed")] = Field(
        8, description="fresh seeds of the points that look best"
    )
    candidates: Annotated[int, Count()] = Field(5, description="how many of them")


@dataclass(frozen=True)
class Study:
    """A checked optimization; signs: 1 for small, -1 for large objectives; limits: {response: largest value}."""

    path: Path
    file: OptimizeFile
    box: Box
    limits: dict

    @property
    def objectives(self):
        """Their names, without the sign."""
        return [name.removeprefix("-") for name in self.file.objectives]

    @property
    def signs(self):
        return np.array([-1.0 if name.startswith("-") else 1.0 for name in self.file.objectives])

    @property
    def responses(self):
        """Objectives, then what limits alone ask for."""
        return [*self.objectives, *(name for name in self.limits if name not in self.objectives)]


@dataclass(frozen=True)
class Optimum:
    """points [n, d] of the search, their means [n, m]; candidates: numbers, means [c, m] and errors over fresh seeds; best:
    place among these, None if none keeps the limits; present: mean and error [2, m] of the design as it is.
    """

    study: Study
    points: np.ndarray
    values: np.ndarray
    candidates: list
    means: np.ndarray
    errors: np.ndarray
    best: int | None
    present: np.ndarray


def plan_optimize(path: str | Path, document: dict[str, Any], model: Model) -> Any:
    """The Study of a document; raises UserError naming what cannot be used."""
    check_keys(path, document, OptimizeFile.model_fields, "search for best values")
    file = checked(OptimizeFile, document, path)
    limits = {}
    for name, value in file.limits.items():
        column = COLUMNS.get(name, name)
        variable = model.outputs.get(column) or model.outputs.get(column.split("(")[-1].removesuffix(")"))
        try:
            limits[name] = to_si(value, model.units[variable.unit] if variable else {"1": (1.0, 0.0)})
        except UserError as problem:
            if variable is None and name != "damage":  # a misspelt name, rather than a column without a unit
                allowed = [f"limits.{key}" for key in ("damage", *COLUMNS)]
                raise unknown(path, "response", f"limits.{name}", allowed) from None
            raise refusal(path, f"limits.{name}", value, problem) from None
    return Study(Path(path), file, Box(path, file.between, model), limits)


def optuna_library() -> Any:
    """Optuna; UserError if it is missing."""
    optuna = library("optuna", "optimize")
    optuna.logging.set_verbosity(optuna.logging.ERROR)
    return optuna


def search(study: Any, evaluate: Any) -> Any:
    """The Optimum; evaluate(names, points [n, d], responses, seeds=None) returns [n, seeds, m]."""
    points, values = explore(study, evaluate)
    candidates = most_promising(study, values)
    fresh = fresh_seeds(study)
    means, errors = mean_and_error(evaluate(study.box.names, points[candidates], study.responses, seeds=fresh))
    present = mean_and_error(evaluate([], np.zeros((1, 0)), study.responses, seeds=fresh))
    allowed = np.all(excess(study, means) <= 0.0, axis=1) & np.isfinite(means).all(axis=1)
    best = None
    if allowed.any():
        best = int(min(np.flatnonzero(allowed), key=lambda i: distance(study, means, allowed)[i]))
    return Optimum(study, points, values, candidates, means, errors, best, np.array(present)[:, 0])


def fresh_seeds(study: Any) -> Any:
    """start.seed of the runs that the search has not seen."""
    first = study.file.seed + FRESH
    return range(first, first + study.file.check_seeds)


def mean_and_error(values):
    """Means and standard errors [n, m] of responses [n, seeds, m]."""
    return values.mean(axis=1), values.std(axis=1, ddof=1) / math.sqrt(values.shape[1])


def criterion(study: Any) -> str:
    """In words, by which of the points simulated again one is recommended."""
    signs = zip(study.objectives, study.signs, strict=True)
    wanted = [f"{'least' if sign > 0 else 'largest'} {name}" for name, sign in signs]
    limits = [f"{name} <= {shown(name, limit)}" for name, limit in study.limits.items()]
    kept = f", of those that keep {', '.join(limits)}" if limits else ""
    if len(wanted) == 1:
        return f"the point simulated again with the {wanted[0]}{kept}"
    return f"the point simulated again nearest to the {' and '.join(wanted)} at once, each over its range among these points{kept}"


def explore(study, evaluate):
    """Points of the search [n, d] and their means over seeds [n, m]."""
    optuna, file = optuna_library(), study.file
    # experimental: variables together, points of one batch apart from each other
    warnings.filterwarnings("ignore", category=optuna.exceptions.ExperimentalWarning)
    options = {"multivariate": True, "constant_liar": True, "n_startup_trials": max(8, file.trials // 5)}
    sampler = optuna.samplers.TPESampler(seed=file.seed, **options)
    found = optuna.create_study(directions=["minimize"] * len(study.objectives), sampler=sampler)
    points, values = [], []
    while len(points) < file.trials:
        trials = [found.ask() for _ in range(min(file.batch, file.trials - len(points)))]
        box = list(zip(study.box.names, study.box.low, study.box.high, strict=True))
        batch = [[trial.suggest_float(*one) for one in box] for trial in trials]
        means = evaluate(study.box.names, np.array(batch), study.responses).mean(axis=1)
        for trial, mean in zip(trials, means, strict=True):
            for name, over in zip(study.limits, excess(study, mean[None])[0], strict=True):
                trial.set_constraint(name, over)
            found.tell(trial, np.nan_to_num(study.signs * mean[: len(study.objectives)], nan=BAD).tolist())
        points, values = [*points, *batch], [*values, *means]
    return np.array(points), np.array(values)


def excess(study, values):
    """By how much the responses [n, m] exceed their limits [n, limits]; stopped runs exceed them by far."""
    over = [values[:, study.responses.index(name)] - limit for name, limit in study.limits.items()]
    return np.nan_to_num(np.column_stack(over), nan=BAD) if over else np.zeros((len(values), 0))


def front(study, values):
    """Mask of the points that keep the limits and that no other such point beats in all objectives [n]."""
    costs = study.signs * values[:, : len(study.objectives)]
    allowed = np.all(excess(study, values) <= 0.0, axis=1) & np.isfinite(costs).all(axis=1)
    beaten = [
        any(np.all(costs[j] <= costs[i]) and np.any(costs[j] < costs[i]) for j in np.flatnonzero(allowed))
        for i in range(len(costs))
    ]
    return allowed & ~np.array(beaten)


def distance(study, values, allowed):
    """Distance from the best of all objectives, each over its range among allowed points [n]; of one its value."""
    costs = study.signs * values[:, : len(study.objectives)]
    low = costs[allowed].min(axis=0)
    width = np.ptp(costs[allowed], axis=0)
    return np.linalg.norm((costs - low) / np.where(width > 0.0, width, 1.0), axis=1)


def most_promising(study, values):
    """Numbers of the points to simulate again: the front's nearest to the best of all objectives, then the next ones."""
    allowed = np.all(excess(study, values) <= 0.0, axis=1) & np.isfinite(values).all(axis=1)
    if not allowed.any():
        raise UserError(f"{study.path}: none of {len(values)} points keeps the limits: widen the box or the limits")
    away, best = distance(study, values, allowed), front(study, values)
    ranked = sorted(np.flatnonzero(allowed), key=lambda i: (len(study.objectives) > 1 and not best[i], away[i]))
    return [int(i) for i in ranked[: study.file.candidates]]


def write_optimum(found: Any, path: Path, basis: Any = (), budgets: Any = None) -> Path:
    """Write the answer as JSON, whole or not at all; budgets: records of the recommended point's errors."""
    study = found.study

    def figures(*pair):
        named = (dict(zip(study.responses, values.tolist(), strict=True)) for values in pair)
        return dict(zip(("mean", "standard_error"), named, strict=True))

    rows = [
        {"at": dict(zip(study.box.names, found.points[i].tolist(), strict=True))} | figures(mean, error)
        for i, mean, error in zip(found.candidates, found.means, found.errors, strict=True)
    ]
    document = {
        "basis": dict(basis),
        "criterion": criterion(study),
        "present": figures(*found.present),
        "recommended": None if found.best is None else rows[found.best],
        "error_budget": budgets or {},
        "fresh_seeds": study.file.check_seeds,
        "candidates": rows,
        "trials": len(found.points),
    }
    return write_json(path, document)


def write_picture(found: Any, path: Path) -> Path:
    """Write the picture: two objectives with their Pareto front, or the one over the first variable."""
    with picture(path, (6.6, 5.0), f"{found.study.path.stem}: {len(found.points)} points searched") as figure:
        (pareto_panel if len(found.study.objectives) > 1 else single_panel)(figure.subplots(), found)
        figure.legend(loc="outside lower center", ncols=3, fontsize=8)  # points lie anywhere on the panel
    return path


def pareto_panel(ax, found):
    """The first two objectives: all points, the front, the candidates with their standard errors, the recommendation."""
    study = found.study
    keeps = np.all(excess(study, found.values) <= 0.0, axis=1)
    values = [displayed(name, found.values[:, i]) for i, name in enumerate(study.objectives[:2])]
    means = [displayed(name, found.means[:, i]) for i, name in enumerate(study.objectives[:2])]
    errors = [display_of(name)[1] * found.errors[:, i] for i, name in enumerate(study.objectives[:2])]
    x, y = values
    ax.plot(x[~keeps], y[~keeps], "x", color=MUTED, ms=5, label="beyond a limit") if not keeps.all() else None
    ax.plot(x[keeps], y[keeps], ".", color=MUTED, ms=7, label="searched")
    edge = np.column_stack(values)[front(study, found.values)]
    edge = edge[edge[:, 0].argsort()]
    ax.step(edge[:, 0], edge[:, 1], where="post", color=MIDDLE, lw=1.2, label="Pareto front of the search")
    candidates(ax, found, *means, *errors)
    ax.set(xlabel=titled(study.objectives[0]), ylabel=titled(study.objectives[1]))


def single_panel(ax, found):
    """One objective over the first variable."""
    variable, objective = found.study.box.names[0], found.study.objectives[0]
    x = displayed(variable, found.points[:, 0])
    ax.plot(x, displayed(objective, found.values[:, 0]), ".", color=MUTED, ms=7, label="searched")
    means, errors = displayed(objective, found.means[:, 0]), display_of(objective)[1] * found.errors[:, 0]
    candidates(ax, found, x[found.candidates], means, None, errors)
    ax.set(xlabel=titled(variable), ylabel=titled(objective))


def candidates(ax, found, x, y, x_error, y_error):
    """Candidates with their standard errors over fresh seeds; the recommendation filled."""
    look = {"fmt": "o", "mfc": "white", "color": FORCE, "ms": 5, "lw": 0.9}
    ax.errorbar(x, y, xerr=x_error, yerr=y_error, label="again, fresh seeds", **look)
    if found.best is not None:
        ax.plot(x[found.best], y[found.best], "o", color=HEAD, ms=8, zorder=5, label="recommended")
