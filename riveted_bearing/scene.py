"""Scenes: what to simulate, from TOML files, checked against the FMU that is to run them.

    description = "..."
    oil = "mineral ISO VG 32"         # optional (oil.py)
    [simulation]
    t_end = 0.4                       # s
    step = "0.1 ms"                   # communication step
    output_interval = 1e-3            # optional, a multiple of step; *_peak channels keep the largest value in between
    tolerance = 1e-4                  # optional
    outputs = ["ring.*", "rivet[*].sigma_head_peak"]   # optional
    [parameters]                      # at the start; dotted keys, nested tables or quoted full names
    joint.preload = "30 N"
    ring.tilt_mode = "supported"
    [inputs]                          # constant, points or a column of a table (tables.py); held before the first and after the last point
    shaft.F_y = "2994 N"
    shaft.omega = { t = [0, 0.1], value = [0, 18238], unit = "rev/min", interpolation = "linear" }
    shaft.F_x = { file = "loads.csv", column = "thrust", time = "t", unit = "kN", interpolation = "hold" }
    [surfaces]                        # measured profile of a race, CSV: height over one turn, as waves of the orders 1 to 60
    outer = { file = "race.csv", angle = "phi", angle_unit = "deg", height = "h", unit = "um" }
    [[change]]                        # of tunable parameters, at the first communication point from `at` on
    at = "50 ms"
    joint.mu = 0.3

A number is SI, a text carries its unit.  Inputs are evaluated at the communication points and held over each step.
Where a scene sets oil.T, parts whose temperature nobody gives have the oil's.
"""

import re
import reprlib
import tomllib
from dataclasses import dataclass, field, replace
from importlib.resources import files
from pathlib import Path

import numpy as np

from . import seats, tables
from .errors import UserError, is_file, refusal, shortlist, unknown
from .file_kinds import check_keys
from .oil import OF_PROPERTY, check_given, merged, named
from .units import SECONDS, canonical, check_alike, scale, suffix, symbol_of, to_si
from .variable_list import is_like

SHIPPED = files("riveted_bearing") / "data" / "scenes"
SECTIONS = ("description", "simulation", "parameters", "inputs", "surfaces", "change", "oil")
SIMULATION = ("t_end", "step", "output_interval", "tolerance", "outputs")
HISTORY = ("t", "value", "unit", "interpolation")
COLUMN = ("file", "column", "time", "unit", "interpolation", "longest_gap")
PARTS_TEMPERATURES = ("ring.T_i", "ring.T_e", "ball.T", "cage.T")
SIMULATED = ("scene.", "solver.", "start.")  # begin of the parameters that say how to simulate, not what
DEEPEST = 50  # tables or lists in each other
MOST_STEPS = 1e12
ALWAYS = {"scene.statistics": "on"}  # unless a scene sets it
LARGEST_RESULT = 16 * 2**30  # bytes, on disk


@dataclass(frozen=True)
class History:
    """An input over time: straight lines between points or, with hold, steps; constant before the first and after the
    last point.
    """

    t: np.ndarray
    value: np.ndarray
    hold: bool = False

    def __call__(self, t):
        """Values at the times t [s]."""
        if self.hold:
            return self.value[np.maximum(np.searchsorted(self.t, t, side="right") - 1, 0)]
        return np.interp(t, self.t, self.value)

    def reached(self, end):
        """The values that it has from 0 to the time `end` [s]."""
        inside = self.value[(self.t > 0.0) & (self.t < end)]
        return np.concatenate([inside, self(np.array([0.0, end]))])

    def changing_time(self):
        """First and last time [s] of its changes; None if it is constant."""
        if np.ptp(self.value) == 0.0:
            return None
        first = int(np.argmax(self.value != self.value[0]))
        last = len(self.t) - 1 - int(np.argmax(self.value[::-1] != self.value[-1]))
        return float(self.t[first if self.hold else first - 1]), float(self.t[last + 1])


@dataclass(frozen=True)
class Scene:
    """What to simulate, checked: times in s, SI values and item names of enumerations by full variable name."""

    name: str = "default"
    description: str = ""
    t_end: float = 0.4
    step: float = 1e-4
    output_interval: float | None = None
    tolerance: float | None = None
    outputs: tuple = ()
    parameters: dict = field(default_factory=dict)
    inputs: dict = field(default_factory=dict)
    source: str = ""  # the scene's file, "" for the FMU's own working point
    replaced: tuple = ()  # values of its file that stand in the place of the FMU's own, in words
    units: dict = field(default_factory=dict)  # units in which values were written, by full variable name
    oil: str = ""  # name of the oil that its file names
    changes: tuple = ()  # (time [s], {name: value}) of parameters that change in the run, in the order of time

    @property
    def stride(self):
        """Communication steps per row of the result."""
        return round((self.output_interval or self.step) / self.step)

    def outside(self):
        """What of its inputs and changes lies outside the run and does not act, in words."""
        for name, history in self.inputs.items():
            begin, end = history.changing_time() or (0.0, 0.0)
            if begin < 0.0 or end > self.t_end:
                acts = "" if begin < self.t_end and end > 0.0 else "no change of it acts: "
                yield f"{name} changes from {begin:g} s to {end:g} s, {acts}the run goes from 0 to {self.t_end:g} s"
        for at, values in self.changes:
            if at >= self.t_end:
                yield f"{', '.join(values)} at {at:g} s, the run ends at {self.t_end:g} s"

    def communication_points(self):
        """0, step, 2 step ... t_end [s]; the last step may be shorter."""
        count = int(np.ceil(self.t_end / self.step * (1 - 1e-12)))
        return np.minimum(np.arange(count + 1) * self.step, self.t_end)


def shipped_scenes():
    """Names of the scenes that come with the program."""
    return sorted(path.name.removesuffix(".toml") for path in SHIPPED.iterdir() if path.name.endswith(".toml"))


def load_scene(source, model, *changes):
    """Read a scene and apply changes to it.

    source: path of a TOML file or name of a shipped scene, None for the FMU's own parameters and inputs, over at least
    twice its start.settle; model: the Model to run it; changes: pairs (origin for messages, document like the file's), later ones win.
    scene.statistics is on unless the scene sets it, because communication points alone miss the impacts.
    Returns a Scene; raises UserError naming file, key, value and what is allowed.
    """
    start = Scene(parameters=ALWAYS)
    if source is None:
        settle = model.default(model.parameters["start.settle"])
        start = replace(start, t_end=max(start.t_end, 2.0 * settle))
        of_file, folder = replace(start, name=model.path.stem, description=working_point(model)), Path()
    else:
        path = find_scene(source)
        folder = Path(str(path)).parent
        of_file = apply(
            replace(start, name=Path(path.name).stem, source=str(path)), str(path), read_toml(path), model, folder
        )
    scene = of_file
    for where, document in changes:
        scene = apply(scene, where, document, model, folder)
    check_times(scene, " with ".join([*filter(None, [scene.source]), *(where for where, _ in changes)]))
    replaced = tuple(replacements(of_file, scene, model))
    return warm(replace(scene, outputs=scene.outputs or default_outputs(model), replaced=replaced), model)


def warm(scene, model):
    """The scene with the oil's temperature, where it sets one, in all parts of which neither it nor the bearing's own
    file gives another.
    """
    if "oil.T" not in scene.inputs:
        return scene
    parts = [name for name in PARTS_TEMPERATURES if name not in scene.inputs and model.origin.get(name) != "yours"]
    units = dict.fromkeys(parts, scene.units["oil.T"]) if "oil.T" in scene.units else {}
    inputs = dict.fromkeys(parts, scene.inputs["oil.T"])
    return replace(scene, inputs=scene.inputs | inputs, units=scene.units | units)


def working_point(model):
    """The FMU's own loads and speed in words."""
    shown = [
        f"{name.removeprefix('shaft.')} {in_words(model, name)}" for name in ("shaft.F_y", "shaft.F_x", "shaft.omega")
    ]
    return f"own working point of {model.path.name}, {', '.join(shown)}"


def own_names(scene, model):
    """Names of the parameters and inputs that a scene sets otherwise than its FMU, or than load_scene; what follows from
    the kind or the temperature of its oil is not among them.
    """
    own = {name: model.default(model.parameters[name]) for name in scene.parameters} | ALWAYS
    of_oil, warm = OF_PROPERTY if scene.oil else (), scene.inputs.get("oil.T")
    return [n for n, value in scene.parameters.items() if value != own[n] and n not in of_oil] + [
        n
        for n, history in scene.inputs.items()
        if np.any(history.value != model.default(model.inputs[n])) and (n == "oil.T" or history is not warm)
    ]


def in_words(model, name, value=None, symbol=None):
    """A start value of the FMU, or values of a scene, in the unit `symbol`, None for the one in which people read it."""
    variable = (model.parameters | model.inputs)[name]
    value = model.default(variable) if value is None else value
    if variable.type != "Real":
        return str(value)
    symbol = symbol or model.display(variable)[0]
    factor, offset = model.units[variable.unit][symbol]
    low, high = (f"{factor * extreme(value) + offset:.5g}" for extreme in (np.min, np.max))
    return f"{low}{'' if low == high else f' to {high}'}{suffix(symbol)}"


def replacements(of_file, scene, model):
    """Values of a scene's file, not changed since, in the place of the FMU's own: "shaft.F_y 2994 N for 4100 N".  How
    to simulate does not count, what follows from the kind of oil is not listed.
    """
    if of_file.oil and of_file.oil == scene.oil:
        yield f"oil {scene.oil} for its own"
    for name, given in (of_file.parameters | of_file.inputs).items():
        value, own = getattr(given, "value", given), model.default((model.parameters | model.inputs)[name])
        there, here = (in_words(model, name, one, scene.units.get(name)) for one in (value, own))
        of_oil = of_file.oil and name in OF_PROPERTY
        if (
            there != here
            and not of_oil
            and not name.startswith(SIMULATED)
            and (scene.parameters | scene.inputs)[name] is given
        ):
            yield f"{name} {there} for {here}"


def find_scene(source):
    """The file of a scene given by path or by shipped name."""
    if str(source) in shipped_scenes():
        return SHIPPED / f"{source}.toml"
    path = Path(source)
    if is_file(path):
        return path
    if path.suffix:
        raise UserError(f"{source}: no such scene file")
    raise unknown("scene", "name", source, shipped_scenes())


def read_toml(path):
    """The document of a TOML file, UTF-8 with or without a mark; UserError if it cannot be read."""
    try:
        data = path.read_bytes()
        text = data.decode("utf-8-sig").replace("\r\n", "\n")
        document = tomllib.loads(text)
        check_integers(path, document)
        return document
    except UnicodeDecodeError as problem:
        row = data[: problem.start].count(b"\n") + 1
        raise UserError(f"{path}: not valid TOML: line {row} is not UTF-8: save the file as UTF-8") from None
    except tomllib.TOMLDecodeError as problem:
        raise UserError(f"{path}: not valid TOML: {problem}{quotes_hint(text, problem)}") from None
    except UserError:
        raise
    except ValueError:  # of int()
        raise UserError(f"{path}: not valid TOML: an integer of thousands of digits") from None
    except RecursionError:
        raise UserError(f"{path}: not valid TOML: tables or lists are nested too deeply") from None
    except OSError as problem:
        raise UserError(f"{path}: {problem.strerror}") from None


def check_integers(path, document, key="", depth=0):
    """UserError for an integer beyond the 64 bits that TOML has; RecursionError beyond DEEPEST."""
    if depth > DEEPEST:
        raise RecursionError
    for name, value in document.items() if isinstance(document, dict) else enumerate(document, 1):
        place = f"{key}.{name}".lstrip(".")
        if isinstance(value, dict | list):
            check_integers(path, value, place, depth + 1)
        elif isinstance(value, int) and not -(2**63) <= value < 2**63:
            raise refusal(path, place, value, "an integer of at most 64 bits is allowed")


def quotes_hint(text, problem):
    """How to write a name with brackets if the line of a TOML error begins with one, else ""."""
    line = re.search(r"line (\d+)", str(problem))
    lines = text.splitlines()
    at = int(line[1]) - 1 if line else len(lines)
    bare = re.match(r"\s*([\w.]+\[\w+\][\w.]*)\s*=", lines[at]) if at < len(lines) else None
    return f'; a name with brackets needs quotes: "{bare[1]}" = ...' if bare else ""


def apply(scene, where, document, model, folder):
    """The scene with one document's settings on top."""
    check_keys(where, document, SECTIONS, "scene")
    sections = {name: section_of(where, document, name) for name in SECTIONS[1:5]}
    parameters = read_section(
        where,
        "parameters",
        sections["parameters"],
        model.parameters,
        model.inputs,
        lambda value, v: parameter_value(value, v, model),
    )
    parameters = surface_parameters(where, sections["surfaces"], model, folder) | parameters
    inputs = read_section(
        where,
        "inputs",
        sections["inputs"],
        model.inputs,
        model.parameters,
        lambda value, v: input_history(value, v, model, folder),
    )
    written = {
        name: unit_of(value)
        for kind in ("parameters", "inputs")
        for name, value in leaves(sections[kind], model.parameters | model.inputs)
    }
    own = {name: model.default(v) for name, v in model.parameters.items() if name.startswith("oil.")}
    texts = dict(leaves(sections["parameters"], model.parameters))
    oil, of_oil = named(where, document.get("oil"), parameters, own | scene.parameters)
    parameters = of_oil | parameters
    check_given(where, parameters, texts, own | scene.parameters | parameters)
    return replace(
        scene,
        description=str(document.get("description", scene.description)),
        parameters=merged(scene.parameters, parameters, own),
        inputs=scene.inputs | inputs,
        oil=oil or scene.oil,
        changes=read_changes(where, document["change"], model) if "change" in document else scene.changes,
        units={name: symbol for name, symbol in (scene.units | written).items() if symbol},
        **read_simulation(where, sections["simulation"], model),
    )


def read_changes(where, blocks, model):
    """Times and parameters of [[change]] in the order of time; UserError for a parameter that is fixed in a run."""
    if not isinstance(blocks, list) or not all(isinstance(block, dict) and "at" in block for block in blocks):
        raise refusal(where, "change", blocks, "[[change]] tables with at and parameters are needed")
    found = []
    for i, block in enumerate(blocks, 1):
        label = f"{where}: change {i}"
        try:
            at = to_si(block["at"], SECONDS)
        except UserError as problem:
            raise refusal(label, "at", block["at"], problem) from None
        section = {key: value for key, value in block.items() if key != "at"}
        values = read_section(
            label,
            "parameters",
            section,
            model.parameters,
            model.inputs,
            lambda value, v: parameter_value(value, v, model),
        )
        for name in values:
            if model.parameters[name].variability != "tunable":
                raise refusal(label, name, values[name], "it is fixed in a run: docs/parameters.md has the reason")
        found.append((at, values))
    return tuple(sorted(found, key=lambda change: change[0]))


def unit_of(value):
    """The unit that the user wrote with a value or a history; None for numbers."""
    return canonical(value["unit"]) if isinstance(value, dict) and value.get("unit") else symbol_of(value)


def section_of(where, document, name):
    """A document's table of this name, empty if there is none; UserError if it is something else."""
    section = document.get(name, {})
    if not isinstance(section, dict):
        raise refusal(where, name, section, "not a table")
    return section


def read_section(where, kind, section, variables, others, value_of):
    """Settings of one section by full variable name; others: the variables of the other section."""
    settings = {}
    for name, value in leaves(section, variables | others):
        if name in others:
            raise UserError(
                f"{where}: {kind}.{name}: does not belong into [{kind}] but into [{'inputs' if kind == 'parameters' else 'parameters'}]"
            )
        if name == "gravity.x" and name not in variables:
            raise refusal(where, f"{kind}.{name}", value, "gravity along X is -frame.a_x of [inputs]: write it there")
        if name not in variables:
            raise unknown(where, kind.removesuffix("s"), whole_name(name, value), variables)
        try:
            settings[name] = value_of(value, variables[name])
        except UserError as problem:
            raise refusal(where, f"{kind}.{name}", value, problem) from None
    return settings


def whole_name(name, value):
    """The name that the first key of nested tables gives: rivet.3 with {strength_factor: 0.8} is rivet.3.strength_factor."""
    while isinstance(value, dict) and value and "t" not in value and "file" not in value:
        key, value = next(iter(value.items()))
        name = f"{name}.{key}"
    return name


def leaves(tree, names, prefix=""):
    """Full names and values of nested tables; a table is entered as long as some variable's name begins like it."""
    for key, value in tree.items():
        name = f"{prefix}{key}"
        if isinstance(value, dict) and any(known.startswith(f"{name}.") for known in names):
            yield from leaves(value, names, f"{name}.")
        else:
            yield name, value


def parameter_value(value, variable, model):
    """A parameter's value checked; UserError for another material than that of the FMU's cage."""
    if seats.is_class(variable.name, value):
        return seats.interference(variable.name, value, seat_of(model, seats.SEATS[variable.name][0]))
    found, own = model.parameter_value(value, variable), model.default(variable)
    if variable.name == "cage.material" and found != own:
        raise UserError(
            f"{own} is allowed, of the material for which this FMU and its rivet table were built; "
            f"for {found} build an FMU from a bearing file with [cage] material"
        )
    return found


def seat_of(model, which):
    """Bore or outside diameter of an FMU's bearing [m], by the rule of ring.bore and ring.outside where nothing has it."""
    given = model.default(model.parameters["ring.bore" if which == "bore" else "ring.outside"])
    d_m, D = (model.default(model.parameters[f"bearing.{name}"]) for name in ("d_m", "D"))
    return model.catalogue.get(which) or given or d_m + (-1.0 if which == "bore" else 1.0) * D / 0.6


SURFACE = ("file", "angle", "angle_unit", "height", "unit")


def surface_parameters(where, section, model, folder):
    """Waviness of the races from measured profiles by parameter name."""
    found = {}
    for race, value in section.items():
        if race not in ("outer", "inner"):
            raise unknown(where, "key", f"surfaces.{race}", ["surfaces.outer", "surfaces.inner"])
        try:
            found |= profile_waves(race, value, model, folder)
        except UserError as problem:
            raise refusal(where, f"surfaces.{race}", value, problem) from None
    return found


def profile_waves(race, value, model, folder):
    """Amplitudes and phases of a race's waves from one measured turn, by least squares; heights into the clearance.

    The mean height is left out: it belongs to the groove's diameter.
    """
    from .surfaces import waves_of

    if not isinstance(value, dict):
        raise UserError('not a table such as { file = "race.csv", angle = "phi", height = "h" }')
    check_entries(value, SURFACE, ("file", "angle", "height"))
    angle, height = tables.read(
        folder / value["file"],
        tables.Wanted(value["angle"], model.units["rad"], value.get("angle_unit", "")),
        tables.Wanted(value["height"], model.units["m"], value.get("unit", "")),
    )
    variables = {kind: model.parameters.get(f"{race}.{kind}[1]") for kind in ("waviness", "waviness_phase")}
    if None in variables.values():
        raise UserError(f"this FMU has no {race}.waviness")
    amplitude, phase = waves_of(angle, height)
    found = {}
    for n, (a, b) in enumerate(zip(amplitude, phase, strict=True), 1):
        model.check_range(a, model.parameters[f"{race}.waviness[{n}]"])
        found |= {f"{race}.waviness[{n}]": float(a), f"{race}.waviness_phase[{n}]": float(b)}
    return found


def read_simulation(where, section, model):
    """The settings of [simulation]."""
    settings = {}
    for key, value in section.items():
        if key not in SIMULATION:
            raise unknown(where, "key", f"simulation.{key}", [f"simulation.{name}" for name in SIMULATION])
        try:
            settings[key] = (
                select(value, model)
                if key == "outputs"
                else positive(value, SECONDS if key != "tolerance" else {"1": (1.0, 0.0)})
            )
        except UserError as problem:
            raise refusal(where, f"simulation.{key}", value, problem) from None
    return settings


def positive(value, scales):
    """SI value of a number or text, which must be greater than zero."""
    number = to_si(value, scales)
    if number <= 0.0:
        raise UserError("must be greater than 0")
    return number


def seconds(key, value):
    """A time [s] of zero or more from a number or a text with a unit; UserError naming the key."""
    try:
        time = to_si(value, SECONDS)
        if time < 0.0:
            raise UserError("must not be negative")
        return time
    except UserError as problem:
        raise UserError(f"{key} = {reprlib.repr(value)}: {problem}") from None


def select(patterns, model):
    """Names of the inputs and outputs that match the patterns (* stands for any text), in the order of the FMU."""
    if not isinstance(patterns, list) or not all(isinstance(pattern, str) for pattern in patterns):
        raise UserError('not a list of names such as ["ring.*", "rivet[*].sigma_head"]')
    names = [*model.inputs, *model.outputs]
    chosen = set()
    for pattern in patterns:
        matches = [name for name in names if is_like(name, pattern)]
        if not matches:
            raise unknown("outputs", "name", pattern, names)
        chosen.update(matches)
    return tuple(name for name in names if name in chosen)


def default_outputs(model):
    """All inputs and outputs but the statistics, which are read once at the end."""
    return tuple(name for name in [*model.inputs, *model.outputs] if not name.startswith("stat."))


def input_history(value, variable, model, folder):
    """The History of an input from a constant, points or a column of a file."""
    scales = model.units[variable.unit]
    if not isinstance(value, dict):
        history = History(np.zeros(1), np.array([to_si(value, scales)]))
    elif "file" in value:
        history = from_column(value, scales, folder)
    else:
        history = from_points(value, scales)
    if len(history.t) != len(history.value) or not len(history.t):
        raise UserError(f"as many times as values are needed, got {len(history.t)} and {len(history.value)}")
    if not np.all(np.isfinite(history.t)) or not np.all(np.isfinite(history.value)):
        raise UserError("not all times and values are finite numbers")
    if not np.all(np.diff(history.t) > 0.0):
        raise UserError("the times do not increase")
    for extreme in (history.value.min(), history.value.max()):
        model.check_range(extreme, variable, unit_of(value))
    return history


def from_points(value, scales):
    """A History from { t = [...], value = [...] }."""
    check_entries(value, HISTORY, ("t", "value"))
    if not all(isinstance(value[key], (list, tuple, np.ndarray)) for key in ("t", "value")):
        raise UserError("t and value must be lists")
    factor, offset = scale(value["unit"], scales) if "unit" in value else (1.0, 0.0)
    if "unit" not in value:
        check_alike(value["value"], scales)
    si = [
        to_si(entry, scales) if isinstance(entry, str) else (to_si(entry, scales) - offset) / factor
        for entry in value["value"]
    ]
    return History(np.array([to_si(entry, SECONDS) for entry in value["t"]]), np.array(si), is_hold(value))


def from_column(value, scales, folder):
    """A History from { file = "...", column = "..." }: a table with times in s or in the unit of their head."""
    check_entries(value, COLUMN, ("file", "column"))
    gap = seconds("longest_gap", value["longest_gap"]) if "longest_gap" in value else None
    t, values = tables.Table(folder / value["file"]).series(
        tables.Wanted(value.get("time", "time"), SECONDS),
        tables.Wanted(value["column"], scales, value.get("unit", "")),
        gap=gap,
    )
    return History(t, values, is_hold(value))


def check_entries(value, allowed, needed):
    """Keys of an input's table: none unknown, none missing, texts where only t and value hold numbers."""
    for key, entry in value.items():
        if key not in allowed:
            raise UserError(f'unknown key "{key}"; allowed: {shortlist(allowed)}')
        if key not in ("t", "value", "longest_gap") and not isinstance(entry, str):
            raise UserError(f"{key} = {reprlib.repr(entry)}: not a text")
    for key in needed:
        if key not in value:
            raise UserError(f'"{key}" is missing; allowed: {shortlist(allowed)}')


def is_hold(value):
    """Whether an input's table asks for steps instead of straight lines."""
    kind = value.get("interpolation", "linear")
    if kind not in ("linear", "hold"):
        raise UserError(f'interpolation "{kind}"; allowed: linear, hold')
    return kind == "hold"


def check_times(scene, where):
    """UserError unless step, output interval and end fit each other and the result is no larger than LARGEST_RESULT."""
    if scene.step > scene.t_end:
        raise refusal(where, "simulation.step", scene.step, f"not longer than t_end = {scene.t_end:g} s is allowed")
    longest = max(scene.t_end, scene.output_interval or 0.0)
    if longest / scene.step > MOST_STEPS:
        raise refusal(where, "simulation.step", scene.step, f"at least {longest / MOST_STEPS:.3g} s is allowed here")
    if scene.output_interval is not None and (
        scene.stride < 1 or abs(scene.stride * scene.step / scene.output_interval - 1.0) > 1e-9
    ):
        raise refusal(
            where,
            "simulation.output_interval",
            scene.output_interval,
            f"multiples of step = {scene.step:g} s are allowed",
        )
    size = 8 * len(scene.outputs or range(400)) * scene.t_end / (scene.step * scene.stride)
    if size > LARGEST_RESULT:
        raise refusal(
            where,
            "simulation.output_interval",
            scene.output_interval or scene.step,
            f"the result would need {size / 2**30:.0f} GiB: choose outputs, or a longer interval",
        )
