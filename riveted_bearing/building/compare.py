"""One scene through the FMU and through the Python reference (bearing_model.solver.integrator), which shares no code
with it.

Short horizon: outputs at the same instants, at several tolerances.  A difference that falls with the tolerance is the
integration's error; a difference that stays is one of the models.  Differences of motion are given in parts of 10 um
and 0.1 m/s (angles by arc length at the pitch circle), which are near the integrator's error scales, so that they
compare with the tolerance; those of loads and stresses as parts of the largest value. Long horizon: trajectories have
parted (errors grow e-fold in 1.4 ... 2.7 ms), so statistics are compared: the reference with the FMU's scatter over
seeds.
"""

from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

import numpy as np

from bearing_model.generated import variables
from bearing_model.solver import integrator

from ..base.errors import UserError
from ..base.variable_list import variable_of
from ..running.fmu import Model
from ..running.runner import simulate
from ..running.scene import Scene
from .reference import is_installed

POINTS = 20  # instants of the short horizon
FINER = (1.0, 1e-2, 1e-4)  # tolerances of the FMU / the scene's
REFERENCE_FINER = 1e-6  # tolerance of the reference on the short horizon / the scene's
# on the long horizon: at 1e-3 the error of RK45 moves the mean stress by 0.3 %, more than the scatter over seeds; 1e-5
# costs no more
LONG_FINER = 1e-2
SETTLED = 0.2  # share of the long horizon that its statistics leave out, unless the scene settles earlier
MOTION = {"m": 1e-5, "m/s": 0.1}
LEAST = {  # smallest scale of loads, stresses, accelerations, contact angles, ratios
    "N": 1.0, "N.m": 1e-3, "Pa": 1e5, "m/s2": 1.0, "1/s2": 100.0, "W": 1.0, "J": 1e-3, "rad": 1e-3, "1": 1e-3, "s": 1e-4
}  # fmt: skip
# the first two jump between whole numbers, the last one is itself an error
LEFT_OUT = ("rivet[k].flag", "bearing.contacts", "bearing.energy_residual")
STEPS_COUNT = ("peak", "event")  # groups that depend on the steps taken
SEEDS = 8


@dataclass(frozen=True)
class Channel:
    """An output: reference [points, elements], scale [its unit], error: largest difference/scale [tolerances, points]."""

    name: str
    unit: str
    scale: float
    reference: np.ndarray
    fmu: np.ndarray  # at the scene's tolerance
    error: np.ndarray  # [tolerances, points]

    @property
    def worst(self):
        """Largest difference over the horizon / scale, by tolerance."""
        return self.error.max(axis=1)


@dataclass(frozen=True)
class Statistic:
    """One of stat.*: the reference's value, the FMU's mean and standard deviation over seeds."""

    name: str
    unit: str
    reference: float
    mean: float
    scatter: float

    @property
    def difference(self):
        """(reference - FMU)/FMU."""
        return (self.reference - self.mean) / self.mean if self.mean else 0.0

    @property
    def deviation(self):
        """Difference in standard deviations of the FMU over seeds; nan where all seeds give one value."""
        return (self.reference - self.mean) / self.scatter if self.scatter else float("nan")


@dataclass(frozen=True)
class Comparison:
    """Channels over t [s] by tolerance; statistics from `settle` to `long` [s], none if that is 0; energies."""

    scene: str
    t: np.ndarray
    tolerances: tuple
    channels: list
    statistics: list = field(default_factory=list)
    settle: float = 0.0
    long: float = 0.0
    seeds: int = 0
    ledger: integrator.Ledger | None = None


def compare(
    model: Model,
    scene: Scene,
    short: float = 1e-3,
    long: float = 0.1,
    seeds: Any = SEEDS,
    method: str = "DOP853",
    progress: Any = None,
) -> Any:
    """The Comparison of a Scene, checked against the Model, through FMU and reference; UserError where one cannot go on.

    short, long: horizons [s], long = 0 for none; seeds: of the FMU; method: the reference's over the short one (Radau where
    films or joints are stiff; RK45 over the long one, as dense as the FMU's); progress: called with run and share done.
    """
    progress = progress or (lambda what, share: None)
    check_same_bearing(model)
    if seeds < 2:
        raise UserError(f"seeds = {seeds}: at least 2 are needed for a scatter")
    tolerance = scene.tolerance or scene.parameters.get("solver.tol") or model.default(model.parameters["solver.tol"])
    tolerances = tuple(tolerance * finer for finer in FINER)
    names = [name for name in model.outputs if variable_of(name)]
    near = replace(scene, t_end=short, step=short / POINTS, output_interval=None, outputs=tuple(names))
    runs = [through_fmu(model, near, tol) for tol in tolerances]
    parameters, finer = runs[0].parameters, tolerance * REFERENCE_FINER
    say = partial(progress, "reference, short horizon")
    reference = through_reference(parameters, near, finer, method, say)
    found = Comparison(scene.name, runs[0].data["time"], tolerances, channels(model, names, reference, runs))
    return with_statistics(found, model, scene, tolerance, long, seeds, progress) if long > 0.0 else found


def check_same_bearing(model):
    """UserError unless the reference in use is that of the FMU's bearing."""
    if model.Z != variables.Z or not is_installed(model):
        own = f"bearing.Z = {model.Z}: the reference in use is that of a bearing with Z = {variables.Z}"
        raise UserError(f"{model.path}: {own}; `riveted-bearing compare --fmu {model.path}` takes this FMU's own one")
    missing = [name for name in model.parameters if variable_of(name) is None]
    if missing:
        raise UserError(f"{model.path}: parameter {missing[0]} is not known to the reference: build the FMU anew")


def through_fmu(model, scene, tolerance, **parameters):
    """The Result of a scene; UserError where the FMU gives up."""
    result = simulate(model, replace(scene, tolerance=tolerance, parameters=scene.parameters | parameters))
    if result.stopped:
        raise UserError(result.stopped)
    return result


def through_reference(parameters, scene, tolerance, method, progress):
    """The reference's Results with the FMU's own parameters; UserError if it refuses or cannot go on."""

    def held(t):
        progress(t / scene.t_end)
        return {name: float(history(t)) for name, history in scene.inputs.items()}

    try:
        return integrator.simulate(parameters, held, scene.t_end, step=scene.step, tolerance=tolerance, method=method)
    except (ValueError, RuntimeError) as problem:
        raise UserError(f"reference: {problem}") from None


# -------------------------------------------------------------------------------------------------------- short horizon


def channels(model, names, reference, runs):
    """A Channel for every output of an instant that the reference has and that is continuous."""
    found, all_elements = [], {}
    for element in names:
        all_elements.setdefault(variable_of(element).name, []).append(element)
    for name, variable in variables.OUTPUTS.items():
        if name not in reference.outputs or variable.group in STEPS_COUNT or name in LEFT_OUT:
            continue
        elements = all_elements.get(name, [])
        exact = reference.outputs[name].reshape(len(reference.t), -1)
        values = np.array([np.column_stack([run.data[element] for element in elements]) for run in runs])
        scale = scale_of(variable, exact, runs[0].parameters)
        error = np.max(np.abs(values - exact), axis=2) / scale
        found.append(Channel(name, variable.unit, scale, exact, values[0], error))
    return found


def scale_of(variable, values, parameters):
    """Scale of a channel's differences: 10 um and 0.1 m/s for motion, else the largest value."""
    r = 0.5 * parameters["bearing.d_m"]
    motion = MOTION | {"rad": MOTION["m"] / r, "rad/s": MOTION["m/s"] / r, "1/s": MOTION["m/s"] / r}
    if is_motion(variable):
        return motion[variable.unit]
    return max(float(np.max(np.abs(values))), LEAST[variable.unit])


def is_motion(channel: Any) -> bool:
    """Whether a channel is a body's position, angle or speed, measured in parts of 10 um and 0.1 m/s."""
    return channel.unit in ("m", "m/s", "rad", "rad/s", "1/s") and "alpha" not in channel.name


# --------------------------------------------------------------------------------------------------------- long horizon


def with_statistics(found, model, scene, tolerance, long, seeds, progress):
    """The Comparison with its statistics."""
    settle = min(scene.parameters.get("start.settle", np.inf), SETTLED * long)
    counted = scene.parameters | {"start.settle": settle, "scene.statistics": "on"}
    far = replace(scene, t_end=long, output_interval=None, outputs=(), parameters=counted)
    runs = []
    for n in range(seeds):
        progress("FMU, long horizon", n / seeds)
        runs.append(through_fmu(model, far, tolerance, **{"start.seed": n + 1}))
    say = partial(progress, "reference, long horizon")
    reference = through_reference(runs[0].parameters, far, tolerance * LONG_FINER, "RK45", say)
    rows = []
    for name, value in reference.statistics.items():
        if name in runs[0].summary and name != "stat.time":
            sample = np.array([run.summary[name] for run in runs])
            figures = map(float, (value, sample.mean(), sample.std(ddof=1)))
            rows.append(Statistic(name, variables.OUTPUTS[name].unit, *figures))
    return replace(found, statistics=rows, settle=settle, long=long, seeds=seeds, ledger=reference.ledger)


# --------------------------------------------------------------------------------------------------------------- tables


def short_table(found: Any) -> Any:
    """Heads and rows of the short horizon, the largest difference first within motion, loads and stresses."""
    heads = ("largest difference / scale", "scale", "", *(f"at {tolerance:.0e}" for tolerance in found.tolerances))
    ordered = sorted(found.channels, key=lambda channel: (not is_motion(channel), -channel.worst[0]))
    return heads, [(c.name, f"{c.scale:.4g}", c.unit, *(f"{value:.1e}" for value in c.worst)) for c in ordered]


def long_table(found: Any) -> Any:
    """Heads and rows of the statistics."""
    heads = ("", "unit", "reference", "FMU, mean", "scatter", "difference", "in scatters")
    rows = []
    for row in found.statistics:
        values = f"{row.reference:.5g}", f"{row.mean:.5g}", f"{row.scatter:.2g}"
        rows.append((row.name, row.unit, *values, f"{100.0 * row.difference:+.2f} %", f"{row.deviation:+.1f}"))
    return heads, rows


def ledger_table(ledger: Any) -> Any:
    """Heads and rows of the energies supplied, stored and lost in the reference."""
    accounts = {"supplied": ledger.supplied, "stored": ledger.stored, "lost": ledger.lost}
    terms = [(f"{title}: {name}", value) for title, account in accounts.items() for name, value in account.items()]
    terms.append(("supplied - stored - lost", ledger.residual))
    return ("", "J"), [(name, f"{value[-1]:.6f}") for name, value in terms]
