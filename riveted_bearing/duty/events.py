"""Events of a mission, such as shocks and landings: how often each happens, and whether its times count."""

from dataclasses import replace

import numpy as np

from ..base.errors import UserError, refusal, unknown
from ..base.toml_files import leaves
from .parts import amount, part_of, settling, tables

EVENT = ("name", "count", "after_settle", "preload_factor", "scene", "simulation", "parameters", "inputs")


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
        part = part_of(path, document, model, label, str(block.get("name", f"event {i}")), block, weight)
        own = {name for name, _ in leaves(block.get("inputs", {}), model.inputs)}
        names = own | (set(part.scene.inputs) if "scene" in block else set())
        scene, warnings = event_in_time(path, label, block, part.scene, settling(part.scene, model), sorted(names))
        yield replace(part, event=True, scene=scene, warnings=warnings)


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
        begin, end = changing_time(history)
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


def changing_time(history):
    """First and last time [s] of the changes of a History that is not constant."""
    first = int(np.argmax(history.value != history.value[0]))
    last = len(history.t) - 1 - int(np.argmax(history.value[::-1] != history.value[-1]))
    return float(history.t[first if history.hold else first - 1]), float(history.t[last + 1])
