"""Scenes: what to simulate, checked against the FMU that is to run them; scene_file.py has the keys of the file.

Inputs are evaluated at the communication points and held over each step.
"""

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from ..base.errors import UserError, refusal, refusing, unknown
from ..base.file_kinds import check_keys
from ..base.schema import checked
from ..base.shipped import find_scene
from ..base.toml_files import leaves, read_toml, whole_name
from ..base.units import suffix
from ..base.variable_list import is_like
from ..bearing import seats
from ..bearing.oil import OF_PROPERTY, PARTS_TEMPERATURES, check_given, merged, named
from .fmu import Model
from .inputs import input_history, unit_of
from .scene_file import SceneFile, Simulation

SIMULATION = (*Simulation.model_fields,)
SIMULATED = ("scene.", "solver.", "start.")  # begin of the parameters that say how to simulate, not what
MOST_STEPS = 1e12
ALWAYS = {"scene.statistics": "on"}  # unless a scene sets it
LARGEST_RESULT = 16 * 2**30  # bytes, on disk


@dataclass(frozen=True)
class Scene:
    """What to simulate, checked: times in s, SI values and item names of enumerations by full variable name."""

    name: str = "default"
    description: str = ""
    t_end: float = 0.4
    step: float = 1e-4
    output_interval: float | None = None
    tolerance: float | None = None
    accuracy: float | None = None  # what steps and seeds are chosen for
    outputs: tuple = ()
    parameters: dict = field(default_factory=dict)
    inputs: dict = field(default_factory=dict)
    source: str = ""  # the scene's file, "" for the FMU's own working point
    replaced: tuple = ()  # values of its file that stand in the place of the FMU's own, in words
    units: dict = field(default_factory=dict)  # units in which values were written, by full variable name
    oil: str = ""  # name of the oil that its file names
    changes: tuple = ()  # (time [s], {name: value}) of parameters that change in the run, in the order of time

    def value(self, name, model):
        """A parameter, or an input at the start, as the scene or else the FMU has it: SI value or item name."""
        if name in self.inputs:
            return float(self.inputs[name](0.0))
        return self.parameters.get(name, model.default(model.parameters.get(name) or model.inputs[name]))

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


def load_scene(source: Any, model: Model, *changes: Any) -> Scene:
    """The Scene of a file or shipped name (None: the FMU's own, over twice start.settle) with changes: pairs (origin for
    messages, document), later ones win.  UserError naming file, key, value and what is allowed.
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
    all_but_statistics = tuple(name for name in [*model.inputs, *model.outputs] if not name.startswith("stat."))
    return warm(replace(scene, outputs=scene.outputs or all_but_statistics, replaced=replaced), model)


def warm(scene, model):
    """The scene with its oil's temperature in all parts whose own neither it nor the bearing's file gives."""
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


def own_names(scene: Scene, model: Model) -> Any:
    """Names that a scene sets otherwise than its FMU or load_scene; what follows from its oil is not among them."""
    own = {name: model.default(model.parameters[name]) for name in scene.parameters} | ALWAYS
    of_oil, warm = OF_PROPERTY if scene.oil else (), scene.inputs.get("oil.T")
    return [n for n, value in scene.parameters.items() if value != own[n] and n not in of_oil] + [
        n
        for n, history in scene.inputs.items()
        if np.any(history.value != model.default(model.inputs[n])) and (n == "oil.T" or history is not warm)
    ]


def in_words(model: Model, name: str, value: Any = None, symbol: Any = None) -> str:
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
    """Values of a scene's file in the place of the FMU's: "shaft.F_y 2994 N for 4100 N"; not how to simulate."""
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


def apply(scene, where, document, model, folder):
    """The scene with one document's settings on top."""
    check_keys(where, document, SceneFile.model_fields, "scene")
    file = checked(SceneFile, document, where)
    parameters = read_section(where, "parameters", file.parameters, model, folder)
    parameters = surface_parameters(where, file.surfaces, model, folder) | parameters
    inputs = read_section(where, "inputs", file.inputs, model, folder)
    written = {
        name: unit_of(value)
        for section in (file.parameters, file.inputs)
        for name, value in leaves(section, model.parameters | model.inputs)
    }
    own = {name: model.default(v) for name, v in model.parameters.items() if name.startswith("oil.")}
    texts = dict(leaves(file.parameters, model.parameters))
    oil, of_oil = named(where, file.oil, parameters, own | scene.parameters)
    parameters = of_oil | parameters
    check_given(where, parameters, texts, own | scene.parameters | parameters)
    simulation = {key: getattr(file.simulation, key) for key in file.simulation.model_fields_set}
    if "outputs" in simulation:
        with refusing(where, "simulation.outputs", simulation["outputs"]):
            simulation["outputs"] = select(simulation["outputs"], model)
    return replace(
        scene,
        description=file.description if "description" in document else scene.description,
        parameters=merged(scene.parameters, parameters, own),
        inputs=scene.inputs | inputs,
        oil=oil or scene.oil,
        changes=read_changes(where, file.change, model) if "change" in document else scene.changes,
        units={name: symbol for name, symbol in (scene.units | written).items() if symbol},
        **simulation,
    )


def read_changes(where, blocks, model):
    """Times and parameters of [[change]] in the order of time; UserError for a parameter that is fixed in a run."""
    found = []
    for i, block in enumerate(blocks, 1):
        values = read_section(f"{where}: change {i}", "parameters", block.model_extra, model)
        for name in values:
            if model.parameters[name].variability != "tunable":
                reason = "it is fixed in a run: docs/parameters.md has the reason"
                raise refusal(f"{where}: change {i}", name, values[name], reason)
        found.append((block.at, values))
    return tuple(sorted(found, key=lambda change: change[0]))


def read_section(where, kind, section, model, folder=None):
    """Settings of [parameters] or [inputs] by full variable name; folder: of files that inputs name."""
    settings, other = {}, "inputs" if kind == "parameters" else "parameters"
    variables, others = getattr(model, kind), getattr(model, other)
    for name, value in leaves(section, variables | others):
        if name in others:
            raise UserError(f"{where}: {kind}.{name}: does not belong into [{kind}] but into [{other}]")
        if name == "gravity.x" and name not in variables:
            raise refusal(where, f"{kind}.{name}", value, "gravity along X is -frame.a_x of [inputs]: write it there")
        if name not in variables:
            raise unknown(where, kind.removesuffix("s"), whole_name(name, value), variables)
        with refusing(where, f"{kind}.{name}", value):
            if kind == "parameters":
                settings[name] = parameter_value(value, variables[name], model)
            else:
                settings[name] = input_history(value, variables[name], model, folder)
    return settings


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


def surface_parameters(where, surfaces, model, folder):
    """Waviness of the races from measured profiles by parameter name."""
    found = {}
    for race, profile in surfaces:
        if profile:
            with refusing(where, f"surfaces.{race}", profile.model_dump(exclude_defaults=True)):
                found |= profile_waves(race, profile, model, folder)
    return found


def profile_waves(race, profile, model, folder):
    """Amplitudes and phases of a race's waves from one measured turn; the mean height belongs to the groove's diameter."""
    from ..base import tables
    from ..bearing.surfaces import waves_of

    angle, height = tables.read(
        folder / profile.file,
        tables.Wanted(profile.angle, model.units["rad"], profile.angle_unit),
        tables.Wanted(profile.height, model.units["m"], profile.unit),
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


def select(patterns, model):
    """Names of the inputs and outputs that match the patterns (* stands for any text), in the order of the FMU."""
    names = [*model.inputs, *model.outputs]
    chosen = set()
    for pattern in patterns:
        matches = [name for name in names if is_like(name, pattern)]
        if not matches:
            raise unknown("outputs", "name", pattern, names)
        chosen.update(matches)
    return tuple(name for name in names if name in chosen)


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
        reason = f"multiples of step = {scene.step:g} s are allowed"
        raise refusal(where, "simulation.output_interval", scene.output_interval, reason)
    size = 8 * len(scene.outputs or range(400)) * scene.t_end / (scene.step * scene.stride)
    if size > LARGEST_RESULT:
        reason = f"the result would need {size / 2**30:.0f} GiB: choose outputs, or a longer interval"
        raise refusal(where, "simulation.output_interval", scene.output_interval or scene.step, reason)
