"""The file of an identification, read and checked before anything is simulated.

    scene = "demo"                       # as in a sweep, and so are [simulation], [parameters], [inputs]
    seeds = 2                            # runs of each point of the search, the same start.seed for all
    seed = 1                             # first start.seed, and seed of the study's own choices
    check_seeds = 8                      # fresh seeds of the answer
    held_out = 3                         # each so many-th target is kept from the fit; 0: none
    confidence = 0.95
    [parameter]                          # what is to be found, with its range
    cage.guide_clearance = ["0.1 mm", "0.3 mm"]
    oil.eta = { low = "2 mPa.s", high = "20 mPa.s", scale = "log", mean = "6 mPa.s", sd = "2 mPa.s" }    # normal prior
    [screen]
    method = "latin_hypercube"           # or "morris", then with trajectories and levels
    count = 40
    [search]
    rounds = 2                           # of the surrogate, each with so many points
    points = 12
    [[point]]                            # operating points; none: the scene itself
    name = "28k"
    inputs.shaft.omega = "28000 rev/min"
    [[target]]
    point = "28k"                        # default: the first point
    measure = "mean(bearing.power_loss)" # a response or any column of a sweep, std(x), q05(x), q50(x), q95(x)
    value = "350 W"
    uncertainty = "3 %"                  # one standard deviation, of the value or in its unit
    [[target]]                           # a line of a spectrum: RMS amplitude in frequency +- width/2
    line = "housing.F_y"
    frequency = "1250 Hz"
    width = "50 Hz"
    value = "3 N"
    uncertainty = "0.3 N"
    over = "cold"                        # the target is the ratio to another point's, or with `minus` the difference
    held_out = true                      # in the place of the rule above
    [[series]]                           # a measured series: its statistics and bands of its spectrum are targets
    file = "rig.csv"                     # or .parquet
    columns.housing.F_y = "Fy [kN]"      # channel = column; time = "t [ms]"
    statistics = ["mean", "std"]
    bands = 4
    uncertainty = "2 %"                  # of the sensor, beside the scatter of the series itself

A weight is 1/uncertainty^2.  Without an uncertainty a target has no weight and is refused.
"""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from scipy.stats import norm

from ..base.errors import UserError, refusal, unknown
from ..base.toml_files import leaves, section_of
from ..running.scene import load_scene
from ..studies.sweep_file import beside, bounds, count_of, known_names
from .targets import Reader, quantity, spread

KEYS = (
    *("description", "scene", "simulation", "parameters", "inputs", "seeds", "seed", "check_seeds", "held_out"),
    *("confidence", "parameter", "screen", "search", "point", "target", "series"),
)
PARAMETER = ("low", "high", "scale", "mean", "sd")
SCREEN = {"method": "latin_hypercube", "count": 40, "trajectories": 6, "levels": 4}
SEARCH = {"rounds": 2, "points": 12}
POINT = ("name", "inputs", "parameters", "simulation")
NOT_FOUND = ("simulation.", "start.", "solver.", "scene")  # begin of names that say how to simulate


@dataclass(frozen=True)
class Parameter:
    """A value to be found between low and high (SI); log: searched by ratios; mean, sd: of a normal prior, None: the
    whole range is equally likely.
    """

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

    def penalty(self, u):
        """-2 ln of the prior's density but for a constant."""
        return 0.0 * u if self.mean is None else ((self.value(u) - self.mean) / self.sd) ** 2

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
    """An identification that was checked; points: names and documents of the operating points; measures: of channels,
    computed by the workers.
    """

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


def plan_identify(path, document, model):
    """The Study of a document; raises UserError naming what cannot be used."""
    path = Path(path)
    for key in document:
        if key not in KEYS:
            raise unknown(path, "key", key, KEYS)
    settings = {
        key: count_of(path, key, document.get(key, n)) for key, n in (("seeds", 2), ("seed", 1), ("check_seeds", 8))
    }
    if settings["check_seeds"] < 2:
        raise refusal(path, "check_seeds", settings["check_seeds"], "from 2 on, which show scatter, is allowed")
    settings["held_out"] = document.get("held_out", 3)
    if (
        isinstance(settings["held_out"], bool)
        or not isinstance(settings["held_out"], int)
        or settings["held_out"] < 0
        or settings["held_out"] == 1
    ):
        raise refusal(path, "held_out", settings["held_out"], "0 (none), or from 2 on (each so many-th), is allowed")
    settings["confidence"] = fraction(path, "confidence", document.get("confidence", 0.95))
    settings |= {"screen": screen_of(path, document), "search": counts_of(path, document, "search", SEARCH)}
    points = points_of(path, document, model)
    parameters = parameters_of(path, document, model, points)
    scenes = [scene_of(path, document, model, changes) for _, changes in points]
    reader = Reader(path, model, points, scenes, settings["held_out"])
    for i, block in enumerate(blocks_of(path, document, "target"), 1):
        reader.target(f"target {i}", block)
    for i, block in enumerate(blocks_of(path, document, "series"), 1):
        reader.series(f"series {i}", block)
    if not reader.targets:
        raise UserError(
            f"{path}: no target: [[target]] with value and uncertainty, or [[series]] with a file, is needed"
        )
    if all(target.held_out for target in reader.targets):
        raise UserError(f"{path}: all targets are held out: nothing to fit")
    measures = tuple(dict.fromkeys(reader.measures))
    return Study(
        path,
        str(document.get("description", "")),
        parameters,
        reader.targets,
        points,
        measures,
        tuple(dict.fromkeys(reader.outputs)),
        settings,
    )


def fraction(path, key, value):
    """A number between 0 and 1."""
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not 0.0 < value < 1.0:
        raise refusal(path, key, value, "a number between 0 and 1 is needed")
    return float(value)


def blocks_of(path, document, key):
    """The tables of [[key]]."""
    blocks = document.get(key, [])
    if not isinstance(blocks, list) or not all(isinstance(block, dict) for block in blocks):
        raise UserError(f"{path}: {key}: write [[{key}]] with its keys below it")
    return blocks


def counts_of(path, document, name, defaults):
    """Whole numbers of a section."""
    section = section_of(path, document, name)
    for key in section:
        if key not in defaults:
            raise unknown(path, "key", f"{name}.{key}", [f"{name}.{known}" for known in defaults])
    return {key: count_of(path, f"{name}.{key}", section.get(key, default)) for key, default in defaults.items()}


def screen_of(path, document):
    """Settings of [screen]."""
    section = section_of(path, document, "screen")
    for key in section:
        if key not in SCREEN:
            raise unknown(path, "key", f"screen.{key}", [f"screen.{known}" for known in SCREEN])
    found = SCREEN | section
    if found["method"] not in ("latin_hypercube", "morris"):
        raise refusal(path, "screen.method", found["method"], "allowed: latin_hypercube, morris")
    for key in ("count", "trajectories", "levels"):
        count_of(path, f"screen.{key}", found[key])
    if found["levels"] < 2 or found["levels"] % 2:
        raise refusal(path, "screen.levels", found["levels"], "an even number is needed")
    return found


def points_of(path, document, model):
    """(name, document) of each operating point; one without changes if there are none."""
    found = []
    for i, block in enumerate(blocks_of(path, document, "point"), 1):
        for key in block:
            if key not in POINT:
                raise unknown(f"{path}: point {i}", "key", key, POINT)
        name = block.get("name", f"point {i}")
        if not isinstance(name, str) or not name or name in [other for other, _ in found]:
            raise refusal(path, f"point {i}: name", name, "a text is needed, another one for each point")
        found.append((name, {key: section_of(path, block, key) for key in POINT[1:]}))
    return found or [("", {})]


def parameters_of(path, document, model, points):
    """The Parameters of [parameter]."""
    section = section_of(path, document, "parameter")
    found, known = [], known_names(model)
    for name, value in leaves(section, known):
        if name not in known or name.startswith(NOT_FOUND):
            raise unknown(path, "parameter or input", name, [key for key in known if not key.startswith(NOT_FOUND)])
        table = (
            value
            if isinstance(value, dict)
            else dict(zip(("low", "high"), value))
            if isinstance(value, list) and len(value) == 2
            else None
        )
        where = f"parameter.{name}"
        if table is None or not {"low", "high"} <= set(table):
            raise refusal(path, where, value, "[lowest, highest] or { low = ..., high = ... } is needed")
        for key in table:
            if key not in PARAMETER:
                raise unknown(path, "key", f"{where}.{key}", [f"{where}.{known}" for known in PARAMETER])
        low, high = bounds(path, where.removeprefix("parameter."), (table["low"], table["high"]), model)
        variable = (model.parameters | model.inputs)[name]
        for end in (low, high):
            try:
                model.check_range(end, variable)
            except UserError as problem:
                raise refusal(path, where, value, problem) from None
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


def scene_of(path, document, model, changes):
    """The scene of an operating point, before the outputs that the targets need."""
    common = {section: section_of(path, document, section) for section in ("simulation", "parameters", "inputs")}
    return load_scene(beside(path, document.get("scene")), model, (str(path), common), (str(path), changes))
