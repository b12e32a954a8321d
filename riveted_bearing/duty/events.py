"""Events of a mission, such as shocks and landings: how often each happens, and whether its times count."""

from dataclasses import replace

import numpy as np

from ..base.errors import UserError
from ..base.toml_files import leaves
from .parts import part_of


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
