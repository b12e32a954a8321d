"""The file of an identification, read and checked before anything is simulated; docs/identify.md has examples.

A weight is 1/uncertainty^2.  Without an uncertainty a target has no weight and is refused.
"""

from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from pydantic import AfterValidator, Field
from scipy.stats import norm

from ..base.errors import UserError, refusal, refusing, unknown
from ..base.file_kinds import check_keys
from ..base.schema import Choice, Count, Named, Number, Section, checked, holds
from ..base.toml_files import leaves
from ..design.sensitivity import EVEN
from ..running.fmu import Model
from ..studies.sweep_file import Settings, bounds, known_names, scene_of, settings_of
from .targets import Reader, SeriesBlock, TargetBlock, quantity, spread

PARAMETER = ("low", "high", "scale", "mean", "sd")
NOT_FOUND = ("simulation.", "start.", "solver.", "scene")  # begin of names that say how to simulate


SO_MANY = "0 (none), or from 2 on (each so many-th), is allowed"


class Screen(Section):
    """The screen over the whole range."""

    method: Annotated[str, Choice(("latin_hypercube", "morris"))] = "latin_hypercube"
    count: Annotated[int, Count()] = Field(40, description="points of latin_hypercube")
    trajectories: Annotated[int, Count()] = Field(6, description="of morris")
    levels: Annotated[int, Count(), EVEN] = Field(4, description="of morris, even")


class Search(Section):
    """Rounds of the surrogate."""

    rounds: Annotated[int, Count()] = 2
    points: Annotated[int, Count()] = Field(12, description="of a round")


class RigPoint(Section):
    """An operating point; without any the scene itself is the only one."""

    name: Annotated[str, Field(strict=True, min_length=1)] | None = Field(None, description="default: its number")
    inputs: Named = {}
    parameters: Named = {}
    simulation: Named = {}


class IdentifyFile(Settings):
    """An identification: parameters to be found, and what a rig has measured."""

    seeds: Annotated[int, Count()] = Field(2, description="runs of each point of the search, the same for all")
    seed: Annotated[int, Count()] = Field(1, description="first start.seed, and seed of the study's own choices")
    check_seeds: Annotated[int, Count(2, "from 2 on, which show scatter, is allowed")] = Field(
        8, description="fresh seeds of the answer"
    )
    held_out: Annotated[int, Count(0, SO_MANY), holds(lambda n: n != 1, SO_MANY, AfterValidator)] = Field(
        3, description="each so many-th target is kept from the fit; 0: none"
    )
    confidence: Annotated[float, Number(above=0.0, below=1.0, words="a number between 0 and 1 is needed")] = 0.95
    parameter: Named = Field(
        {}, description="[lowest, highest] by name, or { low, high, scale = log, mean, sd } with a normal prior"
    )
    screen: Screen = Screen()
    search: Search = Search()
    point: list[RigPoint] = []
    target: list[TargetBlock] = []
    series: list[SeriesBlock] = []


@dataclass(frozen=True)
class Parameter:
    """A value to be found in low ... high (SI); log: by ratios; mean, sd: of a normal prior, None: none."""

    name: str
    low: float
    high: float
    log: bool = False
    mean: float | None = None
    sd: float | None = None

    def value(self, u):
        """The value at a share u of the range."""
        if self.log:
            return self.low * (self.high / self.low) ** np.asarray(u, float)
        return self.low + (self.high - self.low) * np.asarray(u, float)

    def share(self, value):
        """The share of the range at a value."""
        if self.log:
            return np.log(np.asarray(value, float) / self.low) / np.log(self.high / self.low)
        return (np.asarray(value, float) - self.low) / (self.high - self.low)

    def known(self, confidence):
        """Ends of the prior's own interval, as shares of the range."""
        half = 0.5 * confidence
        if self.mean is None:
            return 0.5 - half, 0.5 + half
        z = norm.ppf(0.5 + half) * self.sd
        ends = np.clip([self.mean - z, self.mean + z], self.low, self.high)
        return tuple(map(float, self.share(ends)))


@dataclass(frozen=True)
class Study:
    """A checked identification; points: names and documents; measures: of channels, computed by workers."""

    path: Path
    description: str
    parameters: list
    targets: list
    points: list
    measures: tuple
    outputs: tuple
    settings: dict = field(default_factory=dict)

    @property
    def names(self):
        """Of the parameters."""
        return [parameter.name for parameter in self.parameters]

    def values(self, u):
        """Values of points of the unit cube [n, d]."""
        return np.column_stack([p.value(column) for p, column in zip(self.parameters, np.atleast_2d(u).T, strict=True)])

    @property
    def fitted(self):
        """Mask of the targets that the fit sees."""
        return np.array([not target.held_out for target in self.targets])


def plan_identify(path: str | Path, document: dict[str, Any], model: Model) -> Any:
    """The Study of a document; raises UserError naming what cannot be used."""
    path = Path(path)
    check_keys(path, document, IdentifyFile.model_fields, "identification")
    file = checked(IdentifyFile, document, path)
    settings = {key: getattr(file, key) for key in ("seeds", "seed", "check_seeds", "held_out", "confidence")}
    settings |= {"screen": dict(file.screen), "search": dict(file.search)}
    points = points_of(path, file)
    parameters = parameters_of(path, file.parameter, model, points)
    scenes = [scene_of(path, file.scene, model, settings_of(file), changes) for _, changes in points]
    reader = Reader(path, model, points, scenes, file.held_out)
    for i, block in enumerate(file.target, 1):
        reader.target(f"target {i}", block)
    for i, series in enumerate(file.series, 1):
        reader.series(f"series {i}", series)
    if not reader.targets:
        raise UserError(
            f"{path}: no target: [[target]] with value and uncertainty, or [[series]] with a file, is needed"
        )
    if all(target.held_out for target in reader.targets):
        raise UserError(f"{path}: all targets are held out: nothing to fit")
    measures, outputs = (tuple(dict.fromkeys(names)) for names in (reader.measures, reader.outputs))
    return Study(path, file.description, parameters, reader.targets, points, measures, outputs, settings)


def points_of(path, file):
    """(name, document) of each operating point; one without changes if there are none."""
    found = []
    for i, block in enumerate(file.point, 1):
        name = block.name or f"point {i}"
        if name in [other for other, _ in found]:
            raise refusal(path, f"point {i}: name", name, "a text is needed, another one for each point")
        found.append((name, settings_of(block)))
    return found or [("", {})]


def parameters_of(path, section, model, points):
    """The Parameters of [parameter]."""
    found, known = [], known_names(model)
    for name, value in leaves(section, known):
        if name not in known or name.startswith(NOT_FOUND):
            raise unknown(path, "parameter or input", name, [key for key in known if not key.startswith(NOT_FOUND)])
        pair = isinstance(value, list) and len(value) == 2
        table = dict(zip(("low", "high"), value)) if pair else value
        where = f"parameter.{name}"
        if not isinstance(table, dict) or not {"low", "high"} <= set(table):
            raise refusal(path, where, value, "[lowest, highest] or { low = ..., high = ... } is needed")
        for key in table:
            if key not in PARAMETER:
                raise unknown(path, "key", f"{where}.{key}", [f"{where}.{known}" for known in PARAMETER])
        low, high = bounds(path, where.removeprefix("parameter."), (table["low"], table["high"]), model)
        variable = (model.parameters | model.inputs)[name]
        for end in (low, high):
            with refusing(path, where, value):
                model.check_range(end, variable)
        if not low < high:
            raise refusal(path, where, value, "the lowest value must be below the highest")
        scale = table.get("scale", "linear")
        if scale not in ("linear", "log"):
            raise refusal(path, f"{where}.scale", scale, "allowed: linear, log")
        if scale == "log" and low <= 0.0:
            raise refusal(path, where, value, "a logarithmic scale needs a lowest value above 0")
        if ("mean" in table) != ("sd" in table):
            raise refusal(path, where, value, "a normal prior needs both mean and sd")
        mean = sd = None
        if "mean" in table:
            scales = model.units[variable.unit]
            mean = quantity(path, f"{where}.mean", table["mean"], scales)
            sd = spread(path, f"{where}.sd", table["sd"], scales, mean)
            if not low <= mean <= high:
                raise refusal(path, f"{where}.mean", table["mean"], "a mean between low and high is needed")
        found.append(Parameter(name, low, high, scale == "log", mean, sd))
    if not found:
        raise UserError(f"{path}: parameter: name at least one parameter or input with its lowest and highest value")
    for name, changes in points:
        own = {key for section in ("inputs", "parameters") for key, _ in leaves(changes.get(section, {}), known)}
        if both := own & {parameter.name for parameter in found}:
            raise UserError(f"{path}: {', '.join(sorted(both))}: to be found, but point {name} sets it")
    return found
