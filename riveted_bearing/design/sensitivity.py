"""What decides: Morris' screening of all factors, then Sobol indices of those that are left, by SALib.

Morris: mu_star is the mean size of the change of a response when a factor crosses its range (elementary effects), sigma
their scatter: interactions and curvature.  Sobol: S1 is the share of the variance that goes with a factor alone, ST
that with all its interactions.  Seeds are noise: a factor without any effect has mu_star = 2 s/sqrt(pi)/delta, s^2 the
variance that the seeds leave in a point's mean, delta the step of a trajectory; in Sobol's variances the noise has the
share s^2/V.  Both stand beside the indices.
"""

import json
import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from pydantic import AfterValidator, Field

from ..base.errors import UserError, library
from ..base.file_kinds import check_keys
from ..base.files import write_json
from ..base.schema import Count, Section, checked, holds
from ..running.fmu import Model
from ..running.responses import display_of
from ..show.style import FORCE, HEAD, MIDDLE, MUTED, picture
from .bench import BenchFile, Box, Responses, noise_variance

EVEN = holds(lambda value: value > 1 and value % 2 == 0, "an even number is needed", AfterValidator)
POWER_OF_2 = holds(
    lambda value: not value & (value - 1), "a Sobol sequence is balanced only for powers of 2", AfterValidator
)


class Morris(Section):
    """The screening of all factors."""

    trajectories: Annotated[int, Count()] = Field(8, description="(factors + 1) points each")
    levels: Annotated[int, Count(), EVEN] = Field(4, description="even")


class Sobol(Section):
    """The indices of the factors that are left."""

    factors: Annotated[int, Count(0)] = Field(3, description="the first of the screening; 0: no Sobol indices")
    count: Annotated[int, Count(), POWER_OF_2] = Field(64, description="power of 2; (factors + 2) count points")


class SensitivityFile(BenchFile):
    """What decides: without [between] the factors are the parameters that were assumed, over their documented ranges."""

    responses: Responses = ["damage", "stress"]
    morris: Morris = Morris()
    sobol: Sobol = Sobol()


@dataclass(frozen=True)
class Sensitivity:
    """Of each response morris (mu_star, its confidence, sigma, noise) of factors and sobol (S1, ST, confidence 95 %, noise) of
    the chosen ones; basis: of the runs; ranges: of the factors (SI).
    """

    name: str
    description: str
    seeds: int
    responses: tuple
    factors: tuple
    morris: dict
    chosen: tuple
    sobol: dict = field(default_factory=dict)
    basis: dict = field(default_factory=dict)
    ranges: dict = field(default_factory=dict)

    @property
    def ranked(self):
        """Indices of the factors by their effect on the first response, the largest first."""
        return order(self, self.responses[0])


@dataclass(frozen=True)
class Study:
    """A sensitivity study that was checked."""

    path: Path
    box: Box
    file: SensitivityFile

    @property
    def responses(self):
        """Names of the responses."""
        return self.file.responses


def plan_sensitivity(path: str | Path, document: dict[str, Any], model: Model, assumed: Any = None) -> Any:
    """The Study of a document; assumed: {name: (low, high)} if it names no factors; else UserError."""
    check_keys(path, document, SensitivityFile.model_fields, "sensitivity study")
    file = checked(SensitivityFile, document, path)
    return Study(Path(path), Box(path, file.between, model, assumed), file)


def salib(command: str = "sensitivity") -> Any:
    """SALib's modules, samples and analyses of Morris and Sobol; UserError if the library is missing."""
    return [
        library(f"SALib.{part}", command)
        for part in ("sample.morris", "analyze.morris", "sample.sobol", "analyze.sobol")
    ]


def analyse(study: Any, evaluate: Any) -> Any:
    """The Sensitivity of a Study; evaluate(names, points [n, d], responses) returns [n, seeds, m]."""
    sample_morris, analyze_morris, sample_sobol, analyze_sobol = salib()
    design, sobol_design, seed = study.file.morris, study.file.sobol, study.file.seed
    problem = study.box.problem()
    points = sample_morris.sample(problem, design.trajectories, num_levels=design.levels, seed=seed)
    values = complete(study, evaluate(study.box.names, points, study.responses))
    noise, step = noise_variance(values), design.levels / (2.0 * (design.levels - 1))
    morris: dict[str, dict[str, Any]] = {}
    for i, name in enumerate(study.responses):
        found = analyze_morris.analyze(problem, points, values.mean(axis=1)[:, i], num_levels=design.levels, seed=seed)
        morris[name] = {key: [float(x) for x in found[key]] for key in ("mu_star", "mu_star_conf", "sigma")}
        morris[name]["noise"] = float(2.0 * math.sqrt(noise[i] / math.pi) / step) if np.isfinite(noise[i]) else None
    effects = [np.array(morris[name]["mu_star"]) for name in study.responses]
    strength = np.max([effect / max(effect.max(), 1e-300) for effect in effects], axis=0)
    chosen = [study.box.names[k] for k in np.argsort(-strength, kind="stable")[: sobol_design.factors]]
    sobol: dict[str, dict[str, Any]] = {}
    seeds = values.shape[1]
    if chosen:
        box = study.box.chosen(chosen)
        points = sample_sobol.sample(box.problem(), sobol_design.count, calc_second_order=False, seed=seed)
        values = complete(study, evaluate(box.names, points, study.responses))
        noise = noise_variance(values)
        for i, name in enumerate(study.responses):
            means = values.mean(axis=1)[:, i]
            if np.ptp(means) == 0.0:
                raise UserError(f"{study.path}: response {name} is {means[0]:g} everywhere: no variance to share out")
            found = analyze_sobol.analyze(box.problem(), means, calc_second_order=False, seed=seed)
            sobol[name] = {key: [float(x) for x in found[key]] for key in ("S1", "S1_conf", "ST", "ST_conf")}
            sobol[name]["noise"] = float(noise[i] / means.var()) if np.isfinite(noise[i]) else None
    ends = zip(study.box.low.tolist(), study.box.high.tolist(), strict=True)
    ranges = {name: list(pair) for name, pair in zip(study.box.names, ends, strict=True)}
    about = study.path.stem, study.file.description, seeds, tuple(study.responses), tuple(study.box.names)
    return Sensitivity(*about, morris, tuple(chosen), sobol, ranges=ranges)


def complete(study, values):
    """The values, if all runs have reached their end; UserError otherwise, because indices need every point."""
    if bad := np.argwhere(np.isnan(values).any(axis=(1, 2))).ravel().tolist():
        raise UserError(
            f"{study.path}: {len(bad)} points were stopped by the FMU, or end at or before start.settle and have no "
            "statistics: narrow the ranges, or set simulation.t_end higher (the rows in the folder say which)"
        )
    return values


def order(found: Any, name: str) -> Any:
    """Factors of the screening by their effect on a response, the largest first."""
    return sorted(range(len(found.factors)), key=lambda k: -found.morris[name]["mu_star"][k])


def write_indices(found: Any, path: Path) -> Path:
    """Write all indices as JSON, whole or not at all; returns the path."""
    return write_json(path, vars(found))


def read_indices(path: str | Path) -> Any:
    """The Sensitivity that write_indices wrote at a path, or in a folder; UserError names what is wrong."""
    path = Path(path)
    path = path / "sensitivity.json" if path.is_dir() else path
    try:
        found = Sensitivity(**json.loads(path.read_text(encoding="utf-8")))
        of_responses, keys = [found.morris[name] for name in found.responses], ("mu_star", "mu_star_conf", "sigma")
        lengths = {len(indices[key]) for indices in of_responses for key in keys}
        whole = lengths == {len(found.factors)} != {0} and all("noise" in indices for indices in of_responses)
    except OSError as error:
        raise UserError(
            f"{path}: {error.strerror or error}; allowed is the sensitivity.json of `riveted-bearing sensitivity`, or its folder"
        ) from None
    except (ValueError, TypeError, KeyError):
        whole = False
    if not whole:
        raise UserError(f"{path}: not a record of `riveted-bearing sensitivity`")
    return found


def write_picture(found: Any, path: Path) -> Path:
    """Write the picture: mu_star of each factor with its confidence and the noise, and Sobol indices; returns the path."""
    columns = 2 if found.sobol else 1
    height = 1.2 + max(2.2, 0.34 * len(found.factors) + 0.9) * len(found.responses)
    with picture(path, (5.6 * columns, height), f"{found.name}: what decides, {found.seeds} seeds a point") as figure:
        axes = figure.subplots(len(found.responses), columns, squeeze=False)
        for row, name in zip(axes, found.responses, strict=True):
            screening_panel(row[0], found, name)
            if found.sobol:
                sobol_panel(row[1], found, name)
        keys = {text: handle for ax in axes.flat for handle, text in zip(*ax.get_legend_handles_labels(), strict=True)}
        if keys:  # beside the panels, whose bars and errors lie anywhere
            figure.legend(keys.values(), keys, loc="outside lower center", ncols=len(keys))
    return path


def screening_panel(ax, found, name):
    """Bars of mu_star with their confidence; the effect of noise alone as a line."""
    indices, ranked = found.morris[name], order(found, name)
    unit, factor, _ = display_of(name)
    size, error = (factor * np.array([indices[key][k] for k in ranked]) for key in ("mu_star", "mu_star_conf"))
    ax.barh(range(len(ranked)), size, xerr=error, color=MIDDLE, height=0.6, error_kw={"ecolor": FORCE, "lw": 1.0})
    ax.set_yticks(range(len(ranked)), [found.factors[k] for k in ranked])
    ax.invert_yaxis()
    ax.grid(axis="y", visible=False)
    if indices["noise"] is not None:
        ax.axvline(factor * indices["noise"], color=HEAD, lw=1.2, ls="--", label="seeds alone")
    label = f"mu*: change of the response{unit and f' [{unit}]'}"
    ax.set(title=f"{name}: effect over the range (Morris)", xlabel=label)
    ax.set_xlim(left=0.0)


def sobol_panel(ax, found, name):
    """Bars of S1 and ST with their confidence; the share of the noise as a line."""
    indices, k = found.sobol[name], np.arange(len(found.chosen))
    for key, shift, colour in (("S1", -0.19, MIDDLE), ("ST", 0.19, MUTED)):
        look = {"color": colour, "height": 0.34, "error_kw": {"ecolor": FORCE, "lw": 1.0}}
        ax.barh(k + shift, indices[key], xerr=indices[f"{key}_conf"], label=key, **look)
    ax.set_yticks(k, found.chosen)
    ax.invert_yaxis()
    ax.grid(axis="y", visible=False)
    if indices["noise"] is not None:
        ax.axvline(indices["noise"], color=HEAD, lw=1.2, ls="--", label="seeds alone")
    ax.set(title=f"{name}: share of the variance (Sobol)", xlabel="alone S1, with interactions ST")
    ax.set_xlim(left=min(0.0, ax.get_xlim()[0]))
