"""Missions: operating points with their hours and events with their counts, from TOML files, checked against the FMU.

description = "..."
scene = "demo"                       # shipped name or file, default: none, the FMU's own parameters and inputs; points and events may name another one
[simulation]                         # as in a scene file, for all points and events; so are:
t_end = 0.2
[parameters]
[inputs]

[[point]]
name = "climb"                       # default: its number
hours = 20                           # or "90 min", or share = 0.02 of the whole in every point
preload_factor = 0.9                 # of joint.preload at this point; default 1
interpolate = true                   # not simulated: from the points around it; default false
inputs.shaft.F_y = "3 kN"            # [point.inputs], [point.parameters], [point.simulation]
[[event]]
name = "landing"
count = 12                           # per pass of the mission; damage of its whole run after start.settle
after_settle = true                  # the times of its inputs count from start.settle; default false: from the start of the run
inputs.impact.F_r = { t = [0.01, 0.011, 0.012], value = [0, 4000, 0] }

[[change]]                           # of tunable parameters, in every pass of the mission: from this time of its points on,
at = "2 h"                           # in their order; a point that is under way is divided
joint.mu = 0.2

[table]                              # further points from a CSV or Parquet table; a unit may stand in a column's name (tables.py)
file = "duty.csv"
hours = "h"                          # column
inputs.shaft.omega = { column = "n", unit = "rev/min" }
[history]                            # further points: a measured record, binned
file = "flight.csv"
time = "t"                           # column [s], or with its unit
longest_gap = "10 min"               # between samples; default: ten usual intervals
hours = 1000                         # what the record stands for; default: its own length
inputs.shaft.F_y = { column = "load", unit = "kN", bins = 6 }

[preload_loss]                       # straight lines between; constant after the last hour
hours = [0, 100, 2000]
factor = [1, 0.9, 0.7]
[life]
confidence = 0.9                     # of the interval
half_width = 0.25                    # of life: simulate until the interval is at most life/1.25 ... 1.25 life wide
min_seeds = 6
max_seeds = 32
seed = 1                             # first start.seed, common to all points
skip = 0.01                          # share of the damage that rare points may have and yet be left out by a bound; 0: none left out
rivets = "each"                      # or "alike": every rivet takes every place in turn, so that rates are means over the rivets
cleanliness = "normal"               # of the oil, for the raceways' life: see ../raceways.py; default: normal, assumed
[sn]                                 # see sn.py; default: the FMU's law and its own count
[tolerance]                          # see tolerances.py
"""

import itertools
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cache, partial
from pathlib import Path

import numpy as np

from ..assumed import given_names
from ..basis import basis, fast_speeds, loads, speeds
from ..bearings import case_at
from ..effects import acts, without_effect
from ..errors import UserError, unknown
from ..file_kinds import check_keys
from ..life import fatigue_law
from ..raceways import Raceways, cleanliness_of, of_parts, rated, slip_warning, why_unrated
from ..scene import Scene, leaves, load_scene, own_names, read_toml, refusal, section_of
from ..sweep import beside, count_of, key_of
from ..tables import Wanted, read
from ..units import SECONDS, scale, to_si
from .cycles import outputs_of
from .history import binned
from .miner import Duty
from .slow import slow_warnings
from .sn import assumed, in_words, read_strength

SECTIONS = (
    "description",
    "scene",
    "simulation",
    "parameters",
    "inputs",
    "point",
    "event",
    "change",
    "table",
    "history",
    "preload_loss",
    "life",
    "sn",
    "tolerance",
)
POINT = ("name", "hours", "share", "preload_factor", "interpolate", "scene", "simulation", "parameters", "inputs")
EVENT = ("name", "count", "after_settle", "preload_factor", "scene", "simulation", "parameters", "inputs")
TABLE = ("file", "hours", "inputs", "parameters")
HISTORY = ("file", "time", "hours", "longest_gap", "inputs", "parameters")
LOSS = ("hours", "factor")
FEWEST = 3  # seeds
LIFE = {
    "confidence": 0.9,
    "half_width": 0.25,
    "min_seeds": 6,
    "max_seeds": 32,
    "seed": 1,
    "skip": 0.01,
    "rivets": "each",
    "cleanliness": None,
}
HOURS = {"h": (1.0, 0.0), "min": (60.0, 0.0), "s": (3600.0, 0.0)}
SHARES = {"1": (1.0, 0.0), "%": (100.0, 0.0)}
FORCES = ("shaft.F_x", "shaft.F_y", "shaft.F_z")
WIDE = 0.1  # of the mean cube of a force: missed by wide classes of a record
ROUNDED = 0.011  # by how much shares may miss 1, as three of 0.33 do
RIVETS = ("each", "alike")
MOST_TRIED = 8  # parts in which a setting without effect in one is tried
MOST_CLASSES = 100_000  # of a record
PRELOAD = "joint.preload"
FORCED = {"scene.stress": "fatigue", "scene.statistics": "on", "scene.breakage": "off", "fatigue.acceleration": 1.0}


@dataclass(frozen=True)
class Part:
    """An operating point (weight: hours) or an event (weight: count); scene: None if it is interpolated; values: of all
    inputs, None for those that vary, and of the parameters that it sets, SI; load, speed: in words; warnings: sentences.
    Of a class of a record: cell, its number along each axis; means and spreads, of the record's values in it.
    """

    name: str
    event: bool
    weight: float
    scene: Scene | None = field(repr=False)
    factor: float = 1.0
    values: dict = field(default_factory=dict, repr=False)
    load: str = ""
    speed: str = ""
    cell: tuple = ()
    means: tuple = ()
    spreads: tuple = ()
    warnings: tuple = ()


@dataclass(frozen=True)
class Case:
    """What is simulated with several seeds: part number i with the factor of preload at hour number j."""

    part: int
    scene: Scene = field(repr=False)


@dataclass(frozen=True)
class Mission:
    """A mission checked against its Model; hours: of all points together; basis: what all of it rests on; shares:
    whether its points have shares of a time that is not given; fmu, fmu_sha256: path and digest of the Model's file;
    slow: sentences on points at which the shaft turns too few times; raceways(): the Raceways; idle(): names of settings
    without effect.
    """

    name: str
    description: str
    path: Path
    document: dict = field(repr=False)
    parts: tuple
    cases: tuple = field(repr=False)
    duty: Duty = field(repr=False)
    hours: float
    settings: dict
    basis: tuple
    shares: bool = False
    fmu: str = ""
    fmu_sha256: str = ""
    slow: tuple = ()
    raceways: Callable = field(default=Raceways, repr=False, compare=False)
    idle: Callable = field(default=tuple, repr=False, compare=False)

    @property
    def warnings(self):
        """What the user has to know of the parts before the runs: sentences."""
        of_parts = (text for part in self.parts for text in part.warnings)
        return (*of_parts, *self.slow, *slip_warning(self.raceways()))


def load_mission(path, model):
    """Read a mission's TOML file; raises UserError naming file, key, value and what is allowed."""
    path = Path(path)
    if not path.is_file():
        raise UserError(f"{path}: no such mission file")
    return plan_mission(path.stem, read_toml(path), model, path)


def plan_mission(name, document, model, path):
    """The Mission of a document like the file's."""
    check_keys(path, document, SECTIONS, "mission")
    settings = life_settings(path, section_of(path, document, "life"))
    parts = [*points(path, document, model), *events(path, document, model)]
    if not any(not part.event for part in parts):
        raise UserError(f"{path}: no operating points: write [[point]] with hours, or [table] or [history] with a file")
    hours = sum(part.weight for part in parts if not part.event)
    if hours <= 0.0:
        raise UserError(f"{path}: the hours of all points are 0")
    loss = preload_loss(path, section_of(path, document, "preload_loss"))
    cases, blends = cases_of(path, parts, loss[1], model)
    duty = Duty(np.array([part.weight / hours for part in parts]), blends, loss[0], slopes_of(parts, blends))
    scenes = [case.scene for case in cases]
    rows = tuple(basis(model, scenes, curves(path, document, scenes, model)))
    return Mission(
        name,
        str(document.get("description", "")),
        path,
        document,
        tuple(parts),
        tuple(cases),
        duty,
        hours,
        settings,
        rows,
        any("share" in block for block in tables(path, document, "point")),
        str(model.path.resolve()),
        model.digest,
        (*slow_warnings(parts, model), *fast_speeds(model, scenes)),
        cache(lambda: of_parts(model, parts, settings["cleanliness"])),
        cache(lambda: idle_settings(model, parts)),
    )


def idle_settings(model, parts):
    """Names of what the scenes of simulated parts set without effect on stress, damage and raceways in any of them; of many
    parts the MOST_TRIED with the most hours or counts.
    """
    tried = sorted((part for part in parts if part.scene is not None), key=lambda part: -part.weight)[:MOST_TRIED]
    idle = {name: True for part in tried for name in own_names(part.scene, model) if name not in FORCED}

    def prepared(scene):  # seeds are the life's own
        return replace(scene, outputs=outputs_of(model), parameters=scene.parameters | {"start.seed": 1})

    for part in tried:
        names = [name for name in own_names(part.scene, model) if idle.get(name)]
        left, _ = without_effect(model, part.scene, names, stress_figures, prepared)
        if left and not part.event:
            rated_at = partial(raceway_figures, model)
            reference = rated_at(part.scene)
            left = [name for name in left if not acts(name, part.scene, rated_at, reference)]
        idle |= {name: name in left for name in names}
    return tuple(name for name, still in idle.items() if still)


def stress_figures(result):
    """Stress and damage of a Result."""
    return result.data | {name: value for name, value in result.summary.items() if ".damage_" in name}


def raceway_figures(model, scene):
    """Lives of the raceways in a Scene at its start; of a bearing that is not rated none."""
    case = case_at(scene, model)
    return {} if why_unrated(case) is not None else rated(case).lives


def curves(path, document, scenes, model):
    """The S-N curves of the scenes in words, and what of them is assumed."""
    section, found = section_of(path, document, "sn"), {}
    for scene in scenes:
        given = frozenset(name for name in given_names(model, scene) if name.startswith("fatigue."))
        found[scene_law(scene, model), given] = None
    strengths = ((read_strength(path, section, law), given) for law, given in found)
    return "; ".join(dict.fromkeys(f"{in_words(strength)}{assumed(strength, given)}" for strength, given in strengths))


def scene_law(scene, model):
    """The FatigueLaw of a scene's parameters."""
    return fatigue_law(
        {
            name: scene.parameters.get(name, model.default(v))
            for name, v in model.parameters.items()
            if name.startswith("fatigue.")
        }
    )


def life_settings(path, section):
    """The settings of [life] with their defaults."""
    for key in section:
        if key not in LIFE:
            raise unknown(path, "key", f"life.{key}", [f"life.{name}" for name in LIFE])
    settings = LIFE | section
    for key, low, high in (("confidence", 0.5, 1.0), ("half_width", 1e-3, 100.0), ("skip", 0.0, 0.5)):
        value = number(path, f"life.{key}", settings[key], SHARES)
        if not low <= value < high:
            raise refusal(path, f"life.{key}", settings[key], f"from {low:g} to below {high:g} is allowed")
        settings[key] = value
    for key in ("min_seeds", "max_seeds", "seed"):
        count_of(path, f"life.{key}", settings[key])
    if settings["max_seeds"] < FEWEST:
        raise refusal(
            path, "life.max_seeds", settings["max_seeds"], f"at least {FEWEST} is allowed: fewer show no scatter"
        )
    if "min_seeds" not in section:
        settings["min_seeds"] = min(settings["min_seeds"], settings["max_seeds"])
    if not FEWEST <= settings["min_seeds"] <= settings["max_seeds"]:
        bounds = f"allowed: {FEWEST} (fewer show no scatter) to {settings['max_seeds']} (life.max_seeds)"
        raise refusal(path, "life.min_seeds", settings["min_seeds"], bounds)
    if settings["rivets"] not in RIVETS:
        raise refusal(path, "life.rivets", settings["rivets"], f"allowed: {', '.join(RIVETS)}")
    if (written := settings["cleanliness"]) is not None:
        try:
            settings["cleanliness"] = cleanliness_of(written)
        except UserError as problem:
            raise refusal(path, "life.cleanliness", written, problem) from None
    return settings


def number(path, key, value, scales):
    """SI value, hours for times; UserError naming the key."""
    try:
        return to_si(value, scales)
    except UserError as problem:
        raise refusal(path, key, value, problem) from None


def amount(path, key, value, scales):
    """A number that is not negative."""
    found = number(path, key, value, scales)
    if found < 0.0:
        raise refusal(path, key, value, "must not be negative")
    return found


def tables(path, document, name):
    """The list of tables [[name]]."""
    blocks = document.get(name, [])
    if not isinstance(blocks, list) or not all(isinstance(block, dict) for block in blocks):
        raise UserError(f"{path}: {name}: write [[{name}]] with its keys below it")
    return blocks


def changed_points(path, document, model):
    """The tables [[point]] with the parameters of [[change]]; a point in which a change falls is divided."""
    blocks, changes = tables(path, document, "point"), tables(path, document, "change")
    if not changes:
        return blocks
    if any(key in document for key in ("table", "history")) or any("hours" not in block for block in blocks):
        raise UserError(f"{path}: change: needs an order of time: [[point]] with hours, no [table] and no [history]")
    times = [change_of(path, i, change, model) for i, change in enumerate(changes, 1)]
    ends = np.cumsum([amount(path, "point: hours", block["hours"], HOURS) for block in blocks])
    late = [at for at, _ in times if not 0.0 <= at < ends[-1]]
    if late:
        raise refusal(
            path, "change.at", f"{late[0]:g} h", f"from 0 to below the {ends[-1]:g} h of all points is allowed"
        )
    found, begin = [], 0.0
    for i, (block, end) in enumerate(zip(blocks, ends, strict=True), 1):
        edges = [begin, *sorted({at for at, _ in times if begin < at < end}), float(end)]
        for part, (start, stop) in enumerate(itertools.pairwise(edges)):
            parameters = dict(block.get("parameters", {}))
            for at, values in times:
                if at <= start:
                    parameters = merged(parameters, values)
            name = f"{block.get('name', i)}" + (f" from {start:g} h" if part else "")
            found.append(block | {"name": name, "hours": stop - start, "parameters": parameters})
        begin = float(end)
    return found


def change_of(path, number_of, change, model):
    """Time [h] and parameters of one [[change]]; UserError for one that a run could not change."""
    label = f"change {number_of}"
    if "at" not in change:
        raise UserError(f"{path}: {label}: at is needed: the time at which its parameters change")
    values = {key: value for key, value in change.items() if key != "at"}
    for name, _ in leaves(values, model.parameters):
        variable = model.parameters.get(name)
        if variable is not None and variable.variability != "tunable":
            raise UserError(f"{path}: {label}: {name} is fixed in a run: see docs/parameters.md")
    return amount(path, f"{label}: at", change["at"], HOURS), values


def merged(tree, other):
    """Nested tables with those of another one put over them."""
    both = {
        key: merged(tree[key], other[key])
        for key in other
        if isinstance(tree.get(key), dict) and isinstance(other[key], dict)
    }
    return tree | other | both


def points(path, document, model):
    """The Parts of [[point]], [table] and [history]."""
    blocks = changed_points(path, document, model)
    found = []
    for i, block in enumerate(blocks, 1):
        label = f"point {block.get('name', i)}"
        for key in block:
            if key not in POINT:
                raise unknown(f"{path}: {label}", "key", key, POINT)
        given = [key for key in ("hours", "share") if key in block]
        if len(given) != 1:
            raise UserError(f"{path}: {label}: hours or share is needed" + (", not both" if given else ""))
        if given[0] != next(key for key in ("hours", "share") if key in blocks[0]):
            raise UserError(
                f"{path}: {label}: has {given[0]}, but the first point has not: hours in every point or share in every point is allowed"
            )
        weight = amount(path, f"{label}: {given[0]}", block[given[0]], HOURS if given[0] == "hours" else SHARES)
        if not isinstance(block.get("interpolate", False), bool):
            raise refusal(path, f"{label}: interpolate", block["interpolate"], "allowed: true, false")
        found.append(part_of(path, document, model, label, str(block.get("name", i)), block, weight))
    if found and "share" in blocks[0] and abs((whole := sum(part.weight for part in found)) - 1.0) > ROUNDED:
        raise UserError(f"{path}: share: those of the points add up to {whole:.4g}; 1 is allowed")
    if found and "share" in blocks[0] and ("table" in document or "history" in document):
        raise UserError(
            f"{path}: share: points of a table or a history have hours, so that the other points need hours too"
        )
    return [*found, *table_points(path, document, model), *history_points(path, document, model)]


def events(path, document, model):
    """The Parts of [[event]]."""
    for i, block in enumerate(tables(path, document, "event"), 1):
        label = f"event {block.get('name', i)}"
        for key in block:
            if key not in EVENT:
                raise unknown(f"{path}: {label}", "key", key, EVENT)
        if "count" not in block:
            raise UserError(f"{path}: {label}: count is needed: how often it happens in one pass of the mission")
        weight = amount(path, f"{label}: count", block["count"], {"1": (1.0, 0.0)})
        yield part_of(path, document, model, label, str(block.get("name", f"event {i}")), block, weight, event=True)


def part_of(path, document, model, label, name, block, weight, event=False):
    """The Part of one block, its scene checked."""
    factor = amount(path, f"{label}: preload_factor", block.get("preload_factor", 1.0), SHARES)
    common = {section: section_of(path, document, section) for section in ("simulation", "parameters", "inputs")}
    own = {
        section: section_of(f"{path}: {label}", block, section) for section in ("simulation", "parameters", "inputs")
    }
    for changes in (common, own):
        if any(key in FORCED for key, _ in leaves(changes["parameters"], model.parameters)):
            raise UserError(
                f"{path}: {label}: {' and '.join(FORCED)} are not free here: a life needs the count of stress cycles"
            )
    source = block.get("scene", document.get("scene"))
    scene = load_scene(
        beside(path, source),
        model,
        (str(path), common),
        (f"{path}: {label}", own),
        ("a mission", {"parameters": {name: value for name, value in FORCED.items() if name in model.parameters}}),
    )
    settle = scene.parameters.get("start.settle", model.default(model.parameters["start.settle"]))
    if scene.t_end <= settle:
        raise refusal(
            f"{path}: {label}",
            "simulation.t_end",
            scene.t_end,
            f"longer than start.settle = {settle:g} s is needed, before which damage does not count",
        )
    warnings = ()
    if event:
        names = {name for name, _ in leaves(own["inputs"], model.inputs)} | (
            set(scene.inputs) if "scene" in block else set()
        )
        scene, warnings = event_in_time(path, label, block, scene, settle, sorted(names))
    simulated = None if block.get("interpolate", False) else scene
    return Part(
        name,
        event,
        weight,
        simulated,
        factor,
        values_of(scene, model),
        loads(model, [scene]),
        speeds(model, [scene]),
        warnings=warnings,
    )


def event_in_time(path, label, block, scene, settle, names):
    """The scene of an event with its times moved if it says so, and warnings; names: of the inputs that the event sets.

    UserError for an input whose changes are all over before start.settle, or begin after the end: they count nothing.
    """
    moved = block.get("after_settle", False)
    if not isinstance(moved, bool):
        raise refusal(f"{path}: {label}", "after_settle", moved, "allowed: true, false")
    varying = {name: scene.inputs[name] for name in names if np.ptp(scene.inputs[name].value) > 0.0}
    if moved:
        varying = {name: replace(history, t=history.t + settle) for name, history in varying.items()}
        scene = replace(scene, inputs=scene.inputs | varying)
    counted = f"damage counts from start.settle = {settle:g} s to t_end = {scene.t_end:g} s"
    warnings = []
    for name, history in varying.items():
        begin, end = history.changing_time()
        told = f"{label}: inputs.{name} changes from {begin:g} s to {end:g} s"
        over = end <= settle and history.value[0] == history.value[-1]
        if over or begin >= scene.t_end:
            remedy = (
                "set a longer t_end" if not over else "set later times, or after_settle = true, from which they count"
            )
            raise UserError(f"{path}: {told}, but {counted}: {remedy}")
        if begin < settle or end > scene.t_end:
            warnings.append(f"{told}, but {counted}: a part of the event does not count")
    return scene, tuple(warnings)


def values_of(scene, model):
    """What of a scene can be compared and interpolated: constant inputs, its own or the FMU's, and its parameters, SI;
    None for inputs that vary.
    """
    own = {name: model.default(variable) for name, variable in model.inputs.items()}
    inputs = own | {
        name: float(history.value[0]) if len(history.t) == 1 else None for name, history in scene.inputs.items()
    }
    return inputs | {name: value for name, value in scene.parameters.items() if not isinstance(value, bool)}


def columns_of(path, where, section, model, further=()):
    """The columns that a table or a history gives: {full name: (kind, Wanted column, entries)}."""
    found = {}
    known = {"inputs": model.inputs, "parameters": model.parameters}
    for kind, variables in known.items():
        for name, value in leaves(section_of(f"{path}: {where}", section, kind), variables):
            if name not in variables:
                raise unknown(f"{path}: {where}", kind.removesuffix("s"), name, variables)
            if not isinstance(value, dict) or "column" not in value or not set(value) <= {"column", "unit", *further}:
                raise refusal(
                    path,
                    f"{where}.{name}",
                    value,
                    f"{{ column = ..., unit = ...{''.join(f', {key} = ...' for key in further)} }} is needed",
                )
            if any(not isinstance(value.get(key, ""), str) for key in ("column", "unit")):
                raise refusal(path, f"{where}.{name}", value, "column and unit are texts")
            scales = model.units[variables[name].unit]
            try:
                scale(value["unit"], scales) if "unit" in value else None
            except UserError as problem:
                raise refusal(path, f"{where}.{name}.unit", value["unit"], problem) from None
            found[name] = (kind, Wanted(value["column"], scales, value.get("unit", "")), value)
    if not found:
        raise UserError(f"{path}: {where}: inputs or parameters are needed, each with its column")
    return found


def file_of(path, where, section, keys, needed):
    """The file of a section, whose keys are checked."""
    for key in section:
        if key not in keys:
            raise unknown(path, "key", f"{where}.{key}", [f"{where}.{name}" for name in keys])
    for key in needed:
        if not isinstance(section.get(key), str):
            raise refusal(path, f"{where}.{key}", section.get(key), "a text is needed")
    return Path(path).parent / section["file"]


def table_points(path, document, model):
    """The Parts of [table], one for each line of the file."""
    section = section_of(path, document, "table")
    if not section:
        return
    file = file_of(path, "table", section, TABLE, ("file", "hours"))
    columns = columns_of(path, "table", section, model)
    hours, *values = read(file, Wanted(section["hours"], HOURS), *(column for _, column, _ in columns.values()))
    for i, row in enumerate(np.column_stack([hours, *values]), 1):
        label = f"{file.name} line {i}"
        weight = amount(path, f"{label}: {section['hours']}", float(row[0]), HOURS)
        yield part_of(path, document, model, label, label, block_of(columns, row[1:]), weight)


def history_points(path, document, model):
    """The Parts of [history]: the classes of a measured record."""
    section = section_of(path, document, "history")
    if not section:
        return
    file = file_of(path, "history", section, HISTORY, ("file", "time"))
    columns = columns_of(path, "history", section, model, ("bins",))
    bins = [count_of(path, f"history.{name}.bins", entry.get("bins", 5)) for name, (*_, entry) in columns.items()]
    if np.prod(bins, dtype=float) > MOST_CLASSES:
        raise UserError(
            f"{path}: history: {np.prod(bins, dtype=float):.3g} classes; at most {MOST_CLASSES} are allowed"
        )
    gap = section.get("longest_gap")
    gap = None if gap is None else 3600.0 * amount(path, "history.longest_gap", gap, HOURS)
    wanted = [column for _, column, _ in columns.values()]
    spent, cells, means, spreads = binned(file, Wanted(section["time"], SECONDS), wanted, bins, gap)
    wide = wide_classes(columns, spent, means, spreads)
    hours = amount(path, "history.hours", section.get("hours", spent.sum() / 3600.0), HOURS)
    for i, (seconds, cell, row, spread) in enumerate(zip(spent, cells, means, spreads, strict=True), 1):
        label = f"{file.name} class {i}"
        part = part_of(path, document, model, label, label, block_of(columns, row), hours * seconds / spent.sum())
        warnings, wide = wide, ()
        cell, row, spread = (tuple(each.tolist()) for each in (cell, row, spread))
        yield replace(part, cell=cell, means=row, spreads=spread, warnings=warnings)


def wide_classes(columns, spent, means, spreads):
    """Sentences on columns of forces whose classes are too wide for the raceways' lives, which go with the third power of
    the load and take the mean of each class: mean of F^3 = mu^3 + 3 mu sigma^2.
    """
    found = []
    for name, mean, spread in zip(columns, np.abs(means.T), spreads.T, strict=True):
        cubes = spent @ mean**3
        if name in FORCES and 3.0 * spent @ (mean * spread**2) > WIDE * cubes > 0.0:
            missed = 300.0 * spent @ (mean * spread**2) / cubes
            found.append(
                f"history.{name}: the means of its classes miss {missed:.2g} % of the mean of F^3, by which raceways live: more bins"
            )
    return tuple(found)


def block_of(columns, row):
    """A point's block from SI values of columns."""
    block = {"inputs": {}, "parameters": {}}
    for (name, (kind, *_)), value in zip(columns.items(), row.tolist(), strict=True):
        block[kind][name] = value
    return block


def preload_loss(path, section):
    """Hours and factors of the law of preload loss."""
    if not section:
        return np.zeros(1), np.ones(1)
    for key in section:
        if key not in LOSS:
            raise unknown(path, "key", f"preload_loss.{key}", [f"preload_loss.{name}" for name in LOSS])
    if not all(isinstance(section.get(key), list) and section[key] for key in LOSS) or len(section["hours"]) != len(
        section["factor"]
    ):
        raise UserError(f"{path}: preload_loss: hours and factor are needed, lists of one length")
    hours = np.array([amount(path, "preload_loss.hours", value, HOURS) for value in section["hours"]])
    factor = np.array([amount(path, "preload_loss.factor", value, SHARES) for value in section["factor"]])
    if hours[0] != 0.0 or np.any(np.diff(hours) <= 0.0):
        raise refusal(path, "preload_loss.hours", section["hours"], "they must begin with 0 and increase")
    return hours, factor


def cases_of(path, parts, factors, model):
    """The Cases of all parts at all factors of preload, equal ones once, and the blends of Duty."""
    simulated = [i for i, part in enumerate(parts) if part.scene is not None]
    mixtures = {i: mixture(path, parts, i, simulated) for i, part in enumerate(parts) if part.scene is None}
    cases, places = [], {}
    for j, factor in enumerate(factors):
        for i in simulated:
            scene = loosened(parts[i].scene, factor * parts[i].factor, model)
            key = (parts[i].event, key_of(scene, ""))
            if key not in places:
                places[key] = len(cases)
                cases.append(Case(i, scene))
            places[i, j, "at"] = places[key]
    blends = np.zeros((len(factors), len(parts), len(cases)))
    for j in range(len(factors)):
        for i in range(len(parts)):
            for source, share in mixtures.get(i, {i: 1.0}).items():
                blends[j, i, places[source, j, "at"]] += share
    return cases, blends


def slopes_of(parts, blends):
    """Duty.slopes: difference quotients between the neighbours of a class along each axis, times the spread of its
    values; None without a record.
    """
    classes = {part.cell: i for i, part in enumerate(parts) if part.cell}
    if not classes:
        return None
    axes = len(next(iter(classes)))
    slopes = np.zeros((axes, *blends.shape))
    for cell, i in classes.items():
        for axis in range(axes):
            line = sorted(
                other for other in classes if other[:axis] + other[axis + 1 :] == cell[:axis] + cell[axis + 1 :]
            )
            place = line.index(cell)
            low, high = classes[line[max(place - 1, 0)]], classes[line[min(place + 1, len(line) - 1)]]
            if low != high:
                apart = parts[high].means[axis] - parts[low].means[axis]
                slopes[axis, :, i] = (blends[:, high] - blends[:, low]) * parts[i].spreads[axis] / apart
    return slopes


def loosened(scene, factor, model):
    """The scene with its preload times the factor."""
    if factor == 1.0:
        return scene
    preload = scene.parameters.get(PRELOAD, model.default(model.parameters[PRELOAD]))
    return replace(scene, parameters=scene.parameters | {PRELOAD: factor * preload})


def mixture(path, parts, i, simulated):
    """Shares {part: weight} with which the logarithms of the rates of simulated points make that of point i: linear
    between the points around it.

    The points that count differ from point i in numbers alone; raises UserError if point i is not between them.
    """
    from scipy.spatial import Delaunay, QhullError

    own = parts[i].values
    comparable = [
        q
        for q in simulated
        if not parts[q].event
        and parts[q].values.keys() == own.keys()
        and all(is_close_kind(parts[q].values[n], own[n]) for n in own)
    ]
    axes = [n for n in own if len({parts[q].values[n] for q in comparable} | {own[n]}) > 1]
    outside = UserError(
        f"{path}: point {parts[i].name}: interpolate: not between the simulated points ({', '.join(axes) or 'none like it'}): simulate it"
    )
    if not axes or len(comparable) <= len(axes):
        raise outside
    grid = np.array([[parts[q].values[n] for n in axes] for q in comparable])
    low, width = grid.min(axis=0), np.ptp(grid, axis=0)
    if not np.all(width > 0.0):
        raise outside
    grid, target = (grid - low) / width, (np.array([own[n] for n in axes]) - low) / width
    if len(axes) == 1:
        order = np.argsort(grid[:, 0])
        place = np.searchsorted(grid[order, 0], target[0])
        if not grid[order[0], 0] <= target[0] <= grid[order[-1], 0]:
            raise outside
        corners = order[[max(place - 1, 0), max(place, 1)]]
        near, far = grid[corners, 0]
        shares = np.array([far - target[0], target[0] - near]) / (far - near)
    else:
        try:
            net = Delaunay(grid)
        except QhullError:
            raise outside from None
        simplex = int(net.find_simplex(target))
        if simplex < 0:
            raise outside
        corners = net.simplices[simplex]
        shares = net.transform[simplex, :-1] @ (target - net.transform[simplex, -1])
        shares = np.append(shares, 1.0 - shares.sum())
    return {comparable[c]: float(share) for c, share in zip(corners, shares, strict=True) if share > 0.0}


def is_close_kind(one, other):
    """Whether two values may differ and yet be interpolated: numbers; texts and histories must be equal."""
    numbers = all(isinstance(value, (int, float)) for value in (one, other))
    return numbers or (one is not None and one == other)
