"""Files of sweeps: the axes of a design, read and checked before the first run."""

import hashlib
import itertools
import json
import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from pydantic import Field

from ..base.errors import UserError, is_file, refusal, refusing, unknown
from ..base.file_kinds import check_keys
from ..base.schema import Choice, Count, Named, Section, Text, checked
from ..base.shipped import shipped_scenes
from ..base.toml_files import leaves, read_toml
from ..base.units import SECONDS, check_alike, to_si
from ..running.fmu import Model
from ..running.scene import SIMULATION, Scene, load_scene

RANGE = ("from", "to", "count", "spacing")
SETTINGS = {
    "simulation.t_end": SECONDS,
    "simulation.step": SECONDS,
    "simulation.output_interval": SECONDS,
    "simulation.tolerance": {"1": (1.0, 0.0)},
}
SAMPLED = ("cage.dislocation", "rivet[*].sigma_head", "rivet[*].sigma_mid")  # unless simulation.outputs names others
WORDS = ("accuracy", "description", "source", "replaced", "units", "oil")  # of a scene: no other run
ROW_VERSION = 2
MOST_RUNS = 1_000_000  # of a design, all of which is in memory
RUN_MEMORY = 7e3  # of a run in a design [B], measured
RUN_PLANNING = 0.01  # time to read and check a run's scene [s], measured


class Settings(Section):
    """A scene and what is set otherwise in all runs."""

    description: Text = ""
    scene: Any = Field(
        None, description="shipped name or file, beside this one; default: the FMU's parameters and inputs"
    )
    simulation: Named = Field({}, description="as in a scene file, for all runs; so are the two below")
    parameters: Named = {}
    inputs: Named = {}


class Sample(Section):
    """One more axis: points spread over a box."""

    method: Annotated[str, Choice(("latin_hypercube", "sobol"))] = Field(description="of spreading them")
    count: Annotated[int, Count()] = Field(description="points; of sobol a power of 2")
    seed: Annotated[int, Count(0)] = 0
    between: Named = Field({}, description="[lowest, highest] by name")


class SweepFile(Settings):
    """A sweep: a run for each point of a design; outputs of [simulation] are sampled at the communication points."""

    repeats: Annotated[int | None, Count()] = Field(None, description="seeds 1 ... repeats; default: the scene's seed")
    vary: list[Named] = Field(
        [],
        description="axes, all of which are crossed: a list by name, or { from, to, count, spacing }; "
        "entries of one block go together; scenes and keys of [simulation] can vary too",
    )
    sample: Sample | None = None


@dataclass(frozen=True)
class Sweep:
    """A design of experiments checked against its Model: scenes by key, and the names that vary."""

    name: str
    description: str
    model: Model
    document: dict
    factors: tuple
    scenes: dict = field(repr=False)  # key -> Scene, in the order in which they are run
    # further columns of a row: function of a run's Result that gives them by name, and function that gives their fields
    further: tuple = ()
    grows: bool = False  # whether further runs may join the design: rows that do not belong to it are kept
    perform: Any = None  # what a worker does with a scene and the FMU as bytes; default: a run and its row


def load_sweep(path: str | Path, model: Model) -> Sweep:
    """Read a sweep's TOML file; raises UserError naming file, key, value and what is allowed."""
    path = Path(path)
    return plan_sweep(path.stem, read_toml(path, "sweep file"), model, path)


def plan_sweep(name, document, model, path):
    """The Sweep of a document; path: of its file, for messages and to find scenes beside it."""
    check_keys(path, document, SweepFile.model_fields, "sweep")
    file = checked(SweepFile, document, path)
    if not all(file.vary):
        raise UserError(f"{path}: vary: write [[vary]] with a name and a list below it")
    axes = [*(vary_axis(path, block, model) for block in file.vary), *sample_axes(path, file.sample, model)]
    if file.repeats is not None:
        limit_runs(path, f"repeats = {file.repeats}", file.repeats)
        axes.insert(0, [{"start.seed": seed} for seed in range(1, file.repeats + 1)])
    limit_runs(path, "design", math.prod(len(axis) for axis in axes))
    factors = tuple(name for axis in axes for name in axis[0])
    if twice := {name for name in factors if factors.count(name) > 1}:
        raise UserError(f"{path}: {', '.join(sorted(twice))} varies in more than one place")
    common = settings_of(file)
    common["simulation"] = {"outputs": list(SAMPLED)} | file.simulation
    scenes = {}
    for point in itertools.product(*axes):
        settings = {name: value for part in point for name, value in part.items()}
        source = settings.pop("scene", file.scene)
        scene = scene_of(path, source, model, common, sections_of(settings, model))
        key = key_of(scene, model.digest)
        if key in scenes:
            raise UserError(f"{path}: the same run occurs twice: {settings}")
        scenes[key] = scene
    return Sweep(name, file.description, model, document, factors, scenes)


def vary_axis(path, block, model):
    """One axis: a list of points, {name: value as in a scene file}; the entries of its names go together."""
    values = {name: values_of(path, name, value, model) for name, value in leaves(block, known_names(model))}
    lengths = {name: len(value) for name, value in values.items()}
    if len(set(lengths.values())) != 1:
        raise UserError(f"{path}: vary: entries of one block go together, but their numbers differ: {lengths}")
    return [dict(zip(values, point, strict=True)) for point in zip(*values.values(), strict=True)]


def known_names(model: Model) -> Any:
    """Names of everything that can vary."""
    return ["scene", *(f"simulation.{key}" for key in SIMULATION), *model.parameters, *model.inputs]


def values_of(path, name, value, model):
    """The values of a factor from a list or a range."""
    if name not in known_names(model):
        raise unknown(path, "parameter, input or setting", name, known_names(model))
    if isinstance(value, list) and value:
        variable = (model.parameters | model.inputs).get(name)
        with refusing(path, f"vary.{name}", value):
            check_alike(value, SETTINGS.get(name) or model.units[getattr(variable, "unit", None) or "1"])
        return value
    if not isinstance(value, dict) or not {"from", "to", "count"} <= set(value) <= set(RANGE):
        reason = 'a list of values or { from = ..., to = ..., count = ..., spacing = "linear" or "log" } is needed'
        raise refusal(path, f"vary.{name}", value, reason)
    low, high = bounds(path, name, (value["from"], value["to"]), model)
    count = count_of(path, f"vary.{name}.count", value["count"])
    limit_runs(path, f"vary.{name}.count = {count}", count)  # before there is memory for them
    spacing = value.get("spacing", "linear")
    if spacing not in ("linear", "log"):
        raise refusal(path, f"vary.{name}.spacing", spacing, "allowed: linear, log")
    if spacing == "log" and low * high <= 0.0:
        raise refusal(path, f"vary.{name}", value, "a logarithmic range needs two ends of one sign, not 0")
    return (np.linspace if spacing == "linear" else np.geomspace)(low, high, count).tolist()


def bounds(path: Path, name: str, pair: Any, model: Model) -> tuple[float, ...]:
    """Two SI values of a Real parameter, an input or a setting of [simulation]."""
    variable = (model.parameters | model.inputs).get(name)
    if name in SETTINGS:
        scales = SETTINGS[name]
    elif variable is not None and variable.type == "Real":
        scales = model.units[variable.unit]
    else:
        raise refusal(path, name, list(pair), "only real numbers have ranges: list the values instead")
    with refusing(path, name, list(pair)):
        check_alike(pair, scales)
        return tuple(to_si(value, scales) for value in pair)


def box_of(path: Path, key: str, section: Any, model: Model) -> dict[str, tuple[float, ...]]:
    """Lowest and highest SI values by name, of a section with full names; key: of the section, for messages."""
    if not section:
        raise UserError(f"{path}: {key}: name at least one parameter or input with its lowest and highest value")
    found = {}
    for name, pair in section.items():
        if name not in known_names(model) or name == "scene":
            raise unknown(path, "parameter or input", name, known_names(model))
        if not isinstance(pair, list | tuple) or len(pair) != 2:
            raise refusal(path, f"{key}.{name}", pair, "[lowest, highest] is needed")
        found[name] = bounds(path, name, pair, model)
        if not found[name][0] < found[name][1]:
            raise refusal(path, f"{key}.{name}", list(pair), "the lowest value must be below the highest")
    return found


def count_of(path: Path, name: str, value: Any) -> Any:
    """A whole number of at least 1."""
    if isinstance(value, bool) or not isinstance(value, int) or value < 1:
        raise refusal(path, name, value, "a whole number from 1 on is needed")
    return value


def limit_runs(path, what, runs):
    """UserError if a design has more runs than its memory is meant for."""
    if runs > MOST_RUNS:
        memory, hours = 1e-9 * RUN_MEMORY * runs, RUN_PLANNING * runs / 3600.0
        raise UserError(
            f"{path}: {what}: {runs:,} runs would take {memory:,.0f} GB of memory and {hours:,.0f} h before the first one; at most {MOST_RUNS:,} are allowed"
        )


def sample_axes(path, sample, model):
    """The axis of a Sample, if there is one: Latin hypercube or scrambled Sobol points in the box."""
    if sample is None:
        return []
    from scipy.stats import qmc

    box = box_of(path, "sample.between", dict(leaves(sample.between, known_names(model))), model)
    low, high = np.array(list(box.values())).T
    limit_runs(path, f"sample.count = {sample.count}", sample.count)
    if sample.method == "sobol" and sample.count & (sample.count - 1):
        raise refusal(path, "sample.count", sample.count, "a Sobol sequence is balanced only for powers of 2")
    spread = {"latin_hypercube": qmc.LatinHypercube, "sobol": qmc.Sobol}[sample.method]
    points = spread(d=len(box), seed=sample.seed).random(sample.count)
    return [[dict(zip(box, point, strict=True)) for point in qmc.scale(points, low, high).tolist()]]


def beside(path: str | Path, source: Any) -> Any:
    """A scene's name, or its file beside the sweep's; None, the FMU's own parameters and inputs, stays None."""
    if source is not None and not isinstance(source, str):
        raise refusal(path, "scene", source, "a shipped scene's name or a file is needed")
    if source is None or source in shipped_scenes() or Path(source).is_absolute():
        return source
    file = Path(path).parent / source
    if not is_file(file):
        if not file.suffix:
            raise unknown(f"{path}: scene", "name", source, shipped_scenes())
        raise UserError(f"{path}: scene: {file}: no such scene file")
    return file


def scene_of(path: str | Path, source: Any, model: Model, *documents: Any) -> Scene:
    """The Scene of a study's file, by shipped name or beside it, with changes by documents like a scene file's."""
    return load_scene(beside(path, source), model, *((str(path), document) for document in documents))


def settings_of(block: Any) -> dict[str, Any]:
    """The settings of a file or of one of its blocks as a document like a scene file's."""
    return {"simulation": block.simulation, "parameters": block.parameters, "inputs": block.inputs}


def sections_of(settings: Any, model: Model) -> Any:
    """A point of the design as a document like a scene file's."""
    document = {"simulation": {}, "parameters": {}, "inputs": {}}
    for name, value in settings.items():
        if name.startswith("simulation."):
            document["simulation"][name.removeprefix("simulation.")] = value
        else:
            document["inputs" if name in model.inputs else "parameters"][name] = value
    return document


def key_of(scene: Scene, fingerprint: Any) -> str:
    """Key of a run: a digest of the FMU's content and of everything in the scene."""
    inputs = {name: (h.t.tolist(), h.value.tolist(), h.hold) for name, h in scene.inputs.items()}
    content = {name: value for name, value in vars(scene).items() if name not in WORDS}
    content |= {"inputs": inputs, "fmu": fingerprint, "row": ROW_VERSION}
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()[:24]
