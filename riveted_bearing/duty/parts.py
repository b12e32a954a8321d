"""Parts of a mission: operating points, and events such as shocks and landings, each with its scene."""

from dataclasses import dataclass, field, replace

import numpy as np

from ..base.errors import UserError, refusal
from ..base.toml_files import leaves
from ..running.basis import loads, speeds
from ..running.scene import Scene, load_scene
from ..studies.sweep_file import beside, settings_of

FORCED = {"scene.stress": "fatigue", "scene.statistics": "on", "scene.breakage": "off", "fatigue.acceleration": 1.0}


@dataclass(frozen=True)
class Part:
    """An operating point (weight: hours) or an event (weight: count); scene: None if interpolated; values: inputs (None if
    varying) and own parameters, SI; cell, means, spreads: of a class of a record along each axis.
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


def part_of(path, file, model, label, name, block, weight):
    """The operating point of a block of a MissionFile, its scene checked."""
    for changes in (file, block):
        if any(key in FORCED for key, _ in leaves(changes.parameters, model.parameters)):
            raise UserError(
                f"{path}: {label}: {' and '.join(FORCED)} are not free here: a life needs the count of stress cycles"
            )
    scene = load_scene(
        beside(path, file.scene if block.scene is None else block.scene),
        model,
        (str(path), settings_of(file)),
        (f"{path}: {label}", settings_of(block)),
        ("a mission", {"parameters": {name: value for name, value in FORCED.items() if name in model.parameters}}),
    )
    settle = scene.value("start.settle", model)
    if scene.t_end <= settle:
        reason = f"longer than start.settle = {settle:g} s is needed, before which damage does not count"
        raise refusal(f"{path}: {label}", "simulation.t_end", scene.t_end, reason)
    simulated = None if getattr(block, "interpolate", False) else scene
    words = loads(model, [scene]), speeds(model, [scene])
    return Part(name, False, weight, simulated, block.preload_factor, values_of(scene, model), *words)


def values_of(scene, model):
    """What can be compared and interpolated: inputs (None for varying ones) and the scene's parameters, SI."""
    varying = {name for name, history in scene.inputs.items() if len(history.t) > 1}
    inputs = {name: None if name in varying else scene.value(name, model) for name in model.inputs}
    return inputs | {name: value for name, value in scene.parameters.items() if not isinstance(value, bool)}


# Events ----------------------------------------------------------------------------------------------------------------


def events(path, file, model):
    """The Parts of a MissionFile's [[event]]."""
    for i, block in enumerate(file.event, 1):
        label, name = f"event {block.name or i}", block.name or f"event {i}"
        part = part_of(path, file, model, label, name, block, block.count)
        own = {name for name, _ in leaves(block.inputs, model.inputs)}
        names = own | (set(part.scene.inputs) if block.scene is not None else set())
        settle = part.scene.value("start.settle", model)
        scene, warnings = event_in_time(path, label, block.after_settle, part.scene, settle, sorted(names))
        yield replace(part, event=True, scene=scene, warnings=warnings)


def event_in_time(path, label, moved, scene, settle, names):
    """The scene of an event, its times from settle on if moved, and warnings; names: of its own inputs.  UserError for an input
    whose changes are all outside the counted time.
    """
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
            later = "set later times, or after_settle = true, from which they count"
            remedy = later if over else "set a longer t_end"
            raise UserError(f"{path}: {told}, but {counted}: {remedy}")
        if begin < settle or end > scene.t_end:
            warnings.append(f"{told}, but {counted}: a part of the event does not count")
    return scene, tuple(warnings)
