"""Settings without effect: what a scene sets otherwise than its FMU and yet leaves every figure of a command as it was.

Runs are the same to the last bit where nothing acts.  So a value acts if the FMU's own value in its place gives other bits:
most values do in the first steps, others once damage and statistics count or an input changes; the rest is tried over the
whole run.
"""

from dataclasses import replace
from typing import Any

import numpy as np

from ..base.errors import UserError
from .fmu import Model
from .results import Result
from .runner import simulate
from .scene import ALWAYS, Scene

FIRST = 5  # communication steps
COUNTED = 0.01  # s after start.settle, and after the first point of an input
LONGEST = 30.0  # s of computing that whole runs may take
TIMES = ("solver.", "simulated_time", "cpu_time", "wall_time", "real_time_factor")  # of a summary: how, not what


def all_figures(result: Result) -> Any:
    """What a Result tells of the bearing: {name: array or number}."""
    told = {name: value for name, value in result.summary.items() if not name.startswith(TIMES)}
    return result.data | told | {"stopped": bool(result.stopped)}


def without(scene, name):
    """The Scene without one of its parameters or inputs."""
    always = {n: value for n, value in ALWAYS.items() if n == name}
    return replace(
        scene,
        parameters={n: value for n, value in scene.parameters.items() if n != name} | always,
        inputs={n: history for n, history in scene.inputs.items() if n != name},
    )


def without_effect(
    model: Model,
    scene: Scene,
    names: Any,
    figures: Any = all_figures,
    prepared: Any = lambda scene: scene,
    whole: Any = None,
    cost: float = 0.0,
) -> Any:
    """Names without effect of a scene's values, and the time [s] up to which that was seen, inf for the whole run.

    figures(result): {name: array} that counts; prepared(scene): as the command runs it; whole, cost [s]: of a whole run.
    """
    begins = [scene.value("start.settle", model)]
    begins += [float(scene.inputs[name].t[0]) for name in names if name in scene.inputs]
    counted = max(begins) + COUNTED
    for length in (FIRST * scene.step, counted, scene.t_end):
        end = min(length, scene.t_end)
        if length == scene.t_end and len(names) * cost > LONGEST:
            return list(names), counted

        def run(one, end=end):
            return figures(simulate(model, replace(prepared(one), t_end=end)))

        if names:
            reference = whole if whole is not None and end == scene.t_end else run(scene)
            names = [name for name in names if not acts(name, scene, run, reference)]
    return list(names), np.inf


def acts(name: str, scene: Scene, figures: Any, reference: Any) -> bool:
    """Whether {name: array} of a scene changes without one of its values; what is refused changes it."""
    try:
        found = figures(without(scene, name))
    except UserError:
        return True
    return found.keys() != reference.keys() or any(
        not np.array_equal(reference[key], found[key], equal_nan=True) for key in found if key != name
    )


def in_words(names: Any, until: Any = np.inf) -> str:
    """A line on settings without effect."""
    seen = "here" if np.isinf(until) else f"in the first {until:g} s"
    return f"without effect {seen}: {', '.join(names)}"
