"""Run a scene through the FMU, step by step, and keep its outputs."""

import contextlib
import itertools
import platform
import time
from datetime import UTC, datetime
from typing import Any

import numpy as np
from fmpy import __version__ as fmpy_version
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import fmi2Discard

from ..base.errors import UserError
from ..base.interrupts import held_interrupts
from ..base.version import __version__
from ..bearing.assumed import TEMPERATURES, given_names, is_example
from ..bearing.origin import not_given
from .basis import basis, values
from .fmu import Instance, Model
from .record import Record
from .results import Result
from .scene import Scene, own_names
from .screening import known

PROGRESS_INTERVAL = 0.05  # s of wall time between calls of progress


def simulate(model: Model, scene: Scene, progress: Any = None) -> Result:
    """The Result of a Scene checked against the Model (riveted_bearing.run); Ctrl-C ends it after a step."""
    if scene.accuracy is not None:
        raise UserError(
            f"{scene.name}: simulation.accuracy = {100 * scene.accuracy:g} %: run and life choose steps and seeds by it; here both are given"
        )
    with held_interrupts() as interrupts, Instance(model) as instance:
        instance.initialize(scene)
        parameters = instance.parameters()
        wall, cpu = time.perf_counter(), time.thread_time()
        times, columns, stopped = march(instance, scene, progress or (lambda t: None), interrupts)
        wall, cpu = time.perf_counter() - wall, time.thread_time() - cpu
        summary = {}
        with contextlib.suppress(FMICallException):  # the FMU may no longer answer
            summary = instance.read(closing_names(model))
    simulated = float(times[-1])
    summary |= {
        "simulated_time": simulated,
        "cpu_time": cpu,
        "wall_time": wall,
        "real_time_factor": cpu / simulated if simulated else float("nan"),
    }
    names = ["time", *scene.outputs]
    variables = model.inputs | model.outputs
    ending = {"stopped": stopped, "messages": [text for level, text in instance.log if level != "ok"][-20:]}
    return Result(
        data=dict(zip(names, [times, *columns], strict=True)),
        units={"time": "s"} | {name: variables[name].unit or "1" for name in scene.outputs},
        parameters=parameters,
        summary=summary,
        about=provenance(model, scene, simulated) | vibrations(model, parameters) | ending,
    )


def march(instance, scene, progress, interrupts):
    """All communication steps until interrupts.pending: times [s], columns, and why it ended early, "" at the end."""
    times = scene.communication_points()
    varying = {name: history for name, history in scene.inputs.items() if len(history.t) > 1}
    references = [instance.model.inputs[name].valueReference for name in varying]
    inputs = np.column_stack([history(times) for history in varying.values()] or [np.zeros((len(times), 0))])
    changed = [False, *np.any(np.diff(inputs, axis=0), axis=1)]
    stride = scene.stride
    peaks = [i for i, name in enumerate(scene.outputs) if is_peak(name)] if stride > 1 else []
    count = -(-(len(times) - 1) // stride) + 2
    record, row_times = Record(count, len(scene.outputs)), np.zeros(count)
    read = instance.reader(scene.outputs)
    record.write(0, read())
    row, due, stopped, changes = 0, 0.0, "", list(scene.changes)
    for i, (now, then) in enumerate(itertools.pairwise(times.tolist())):
        if interrupts.pending:
            stopped = f"interrupted after t = {now:.9g} s"
            break
        try:
            if changed[i]:
                instance.fmu.setReal(references, inputs[i].tolist())
            while changes and changes[0][0] <= now * (1.0 + 1e-12):
                for name, value in changes.pop(0)[1].items():
                    instance.set_parameter(instance.model.parameters[name], value)
            instance.fmu.doStep(now, then - now)
        except FMICallException as failure:
            stopped = f"the FMU gave up in the step from t = {now:.9g} s: {instance.complaints()}"
            reached = instance.last_successful_time(now) if failure.status == fmi2Discard else now
            if reached > row_times[row]:
                row += 1
                record.write(row, read())
                row_times[row] = reached
            break
        row = i // stride + 1
        values = read()
        if peaks and i % stride:
            values[peaks] = np.maximum(values[peaks], record.last(peaks))
        record.write(row, values)
        row_times[row] = then
        if (clock := time.perf_counter()) >= due:
            progress(then)
            due = clock + PROGRESS_INTERVAL
    progress(row_times[row])
    return row_times[: row + 1], record.columns(), stopped


def is_peak(name: str) -> bool:
    """Whether a channel is the largest value since the last communication point."""
    return name.endswith("_peak") or name in ("rivet.sigma_head_max", "rivet.sigma_mid_max")


def closing_names(model: Model) -> list[str]:
    """Variables on the whole run: statistics, damage, breaks, solver counters, what the stress rests on."""
    names = [*model.outputs, *model.locals]
    return [
        name
        for name in names
        if name.startswith(("stat.", "solver."))
        or name.endswith(("].damage_head", "].damage_mid", "].broken", "].break_time", "].preload_loss"))
        or name == "rivet.table_kind"
    ]


def vibrations(model, parameters):
    """Frequencies [Hz] of a free elastic half by the FMU's table; it is as much denser as `cage.m` is larger."""
    if parameters.get("scene.cage") != "elastic" or not model.cage_modes:
        return {}
    modes = model.cage_modes
    denser = parameters["cage.m"] / modes["mass"]
    return {"mode_frequencies": [frequency / denser**0.5 for frequency in modes["frequency"]]}


def turns(model: Model, scene: Scene, end: Any) -> Any:
    """Revolutions of the shaft against the housing before statistics begin, and from there to the end of the run [s]."""
    settle = min(scene.parameters.get("start.settle", model.default(model.parameters["start.settle"])), end)
    return {
        "settle_turns": turns_between(model, scene, 0.0, settle),
        "count_turns": turns_between(model, scene, settle, end),
    }


def turns_between(model, scene, start, end):
    """Revolutions of the shaft against the housing between two times [s]."""
    t = np.linspace(start, end, 101)
    inner, outer = (
        scene.inputs[name](t) if name in scene.inputs else model.default(model.inputs[name])
        for name in ("shaft.omega", "housing.omega")
    )
    return float(np.mean(np.abs(inner - outer)) * (end - start) / (2.0 * np.pi))


def changes_in_words(scene):
    """Parameters that change in the run, by the time."""
    found = {}
    for at, changed in scene.changes:
        found.setdefault(f"{at:.9g} s", {}).update(changed)
    return found


def provenance(model, scene, end):
    """Origin of a result that ended at a time [s]: scene, inputs, FMU, versions, machine, date."""
    return origin_of(model, scene) | {
        "scene": scene.name,
        "description": scene.description,
        "t_end": scene.t_end,
        **turns(model, scene, end),
        "step": scene.step,
        "inputs": {
            name: {"t": history.t.tolist(), "value": history.value.tolist(), "hold": history.hold}
            for name, history in scene.inputs.items()
            if len(history.t) <= 1000
        },
        "set": own_names(scene, model),
        "basis": dict(basis(model, [scene])),
        "replaced": list(scene.replaced),
        "changes": changes_in_words(scene),
        "units": scene.units,
        "guid": model.description.guid,
        "generated": f"{model.description.generationTool or ''} {model.description.generationDateAndTime or ''}".strip(),
        "versions": {"riveted-bearing": __version__, "fmpy": fmpy_version, "python": platform.python_version()},
        "machine": f"{platform.system()} {platform.machine()}",
        "date": datetime.now(UTC).isoformat(timespec="seconds"),
    }


def origin_of(model: Model, scene: Scene) -> dict[str, Any]:
    """Who gave which values of an FMU in a scene, and what is known of them."""
    return {
        "fmu": str(model.path),
        "given": sorted(given_names(model, scene)),
        "ruled": sorted(name for name, origin in model.origin.items() if origin == "rule"),
        "example": is_example(model),
        "screening": known(model) or {},
        "ranges": {name: ends for name, ends in model.ranges.items() if name not in {*scene.parameters, *scene.inputs}},
        "temperatures": {name: float(values(model, [scene], name).mean()) for name in TEMPERATURES},
        "rivet": model.rivet,
        "not_given": not_given(
            {name: origin for name, origin in model.origin.items() if name not in {*scene.parameters, *scene.inputs}}
        ),
        "model": model.description.description or model.description.modelName,
    }
