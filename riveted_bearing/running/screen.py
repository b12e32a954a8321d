"""What decides the stress of the bearing at hand: each assumed value at both ends of its range, the others as they are.

One at a time, with common seeds, at the FMU's own loads and speed; temperatures are among the values, and given ones with ranges of
the bearing's file (what the drawing allows) or of a study.  What shapes the FMU's stress table is named as not covered.
Effects are relative changes of the stress, and decades of the damage.
"""

import math
import time
from dataclasses import replace
from datetime import UTC, datetime
from typing import Any

import numpy as np

from ..base.errors import UserError
from ..bearing.assumed import (
    OF_ASPERITIES,
    TEMPERATURES,
    YOURS,
    assumed_ranges,
    given_names,
    is_example,
    is_of_build,
    own_ranges,
    ranges_of,
)
from ..bearing.oil import ALL_TEMPERATURES
from .accuracy import CHANNELS, DECADES, sample
from .basis import values
from .fmu import Model
from .inputs import History
from .scene import load_scene
from .screening import VERSION, keep, known
from .seeds import seeded

SEEDS = 3
SPAN = 0.1  # s after start.settle, or as long as that
SCREENED = ("stress", "static", DECADES)
IN_FILM = "moves no stress in full film"
OF_BUILD = "part of the FMU's stress table, so that another value needs an FMU of its own (compare-designs)"


def screened(model: Model, say: Any = lambda done, total: None, further: Any = None) -> dict[str, Any]:
    """The record of an FMU's screening, measured if there is none of these further ranges {name: (low, high)}."""
    record = known(model) or {}
    further, own = further or {}, own_ranges(model.ranges, record)
    if record and all(own.get(name) == ends for name, ends in further.items()):
        return record
    return keep(model, measured(model, say, own | further))


# The runs -------------------------------------------------------------------------------------------------------------


def own_sources(model):
    """The Range of each value of an FMU that nobody gave."""
    parameters = {name: model.default(variable) for name, variable in model.parameters.items()}
    return ranges_of(given_names(model), is_example(model), parameters)


def changed_scenes(model, scene, further):
    """{name: (low, high, source, scene at the low end, scene at the high end)} of all that a run can set."""
    given, sources = given_names(model), own_sources(model)
    found = {name: (*ends, sources[name].source) for name, ends in assumed_ranges(model).items()}
    T = {name: float(values(model, [scene], name).mean()) for name in ALL_TEMPERATURES}
    for name, (below, above, source) in TEMPERATURES.items():
        if name not in given:
            found[name] = min(T[name], T["oil.T"] + below), max(T[name], T["oil.T"] + above), source
    found |= {name: (*ends, YOURS) for name, ends in further.items() if not is_of_build(name)}

    def at(name, end):
        if name not in T:
            return replace(scene, parameters=scene.parameters | {name: end})
        moved = {n: T[n] + end - T[name] for n in T if n == name or (name == "oil.T" and n not in given)}
        return replace(scene, inputs=scene.inputs | {n: History(np.zeros(1), np.array([x])) for n, x in moved.items()})

    return {name: (low, high, source, at(name, low), at(name, high)) for name, (low, high, source) in found.items()}


def measured(model, say, further):
    """The record of a screening."""
    begun, settle = time.perf_counter(), model.default(model.parameters["start.settle"])
    simulation = {"t_end": settle + max(SPAN, settle), "outputs": list(CHANNELS)}
    scene = load_scene(None, model, ("screening", {"simulation": simulation}))
    scenes = changed_scenes(model, scene, further)
    base = [sample(model, seeded(scene, model, 1, s)) for s in range(SEEDS)]
    entries, not_covered = {}, {}
    for done, (name, (low, high, source, *at)) in enumerate(scenes.items()):
        say(done, len(scenes))
        try:
            ends = [[sample(model, seeded(one, model, 1, s)) for s in range(SEEDS)] for one in at]
        except UserError as problem:
            not_covered[name] = f"no run at an end of its range: {problem}"
            continue
        effect = {f: [change(f, base, end) for end in ends] for f in SCREENED if all(has(f, e) for e in (base, *ends))}
        entries[name] = {"low": low, "high": high, "source": source, "effect": effect}
    needed = [*own_sources(model), *further]
    return {
        "version": VERSION,
        "fmu_sha256": model.digest,
        "bearing": model.bearing,
        "date": datetime.now(UTC).isoformat(timespec="seconds"),
        "t_end": scene.t_end,
        "seeds": SEEDS,
        "seconds": time.perf_counter() - begun,
        "base": {f: float(np.mean([run.values[f] for run in base])) for f in SCREENED if has(f, base)},
        "entries": entries,
        "not_covered": {name: why for name in needed if name not in entries and (why := reason(name))} | not_covered,
    }


def reason(name):
    """Why a value is not screened."""
    return OF_BUILD if is_of_build(name) else IN_FILM if name in OF_ASPERITIES else ""


def has(figure, runs):
    """Whether all runs have a figure: none has a damage where nothing is damaged."""
    return all(figure in run.values for run in runs)


def change(figure, base, end):
    """Mean change of a figure on common seeds with its standard error, relative to the base's mean, of the damage as it is."""
    x, y = (np.array([run.values[figure] for run in runs]) for runs in (base, end))
    d = (y - x) / (1.0 if figure == DECADES else max(abs(float(x.mean())), 1e-300))
    return [float(d.mean()), float(d.std(ddof=1)) / math.sqrt(len(d))]
