"""Scaling of the cost with balls, communication step, outputs read, parallel processes, horizon and inputs; and the
time that fmpy itself takes.

All runs go through the FMU and fmpy, as users run them.  The FMU's own share is its variable solver.cpu_time, the time
inside fmi2DoStep; the rest is fmpy's: ctypes calls, and Python's loop around them.
"""

import math
import multiprocessing
import resource
import time
from dataclasses import replace

import numpy as np
from common import BUILD, FMU, Scene, options, say, write

from riveted_bearing import build
from riveted_bearing.running.fmu import Instance, Model

BALLS = (5, 9, 16, 32)


def peak_channels(model):
    return [name for name in model.outputs if name.startswith("rivet[") and name.endswith("_peak")]


def simulate(model, scene, length, step, outputs=(), changing=False, begin=0.0):
    """Run through fmpy's calls: processor times per simulated second, of the process and inside fmi2DoStep, and
    evaluations per second.
    """
    started = time.process_time()
    with Instance(model) as instance:
        instance.initialize(replace(scene, parameters=scene.parameters | {"solver.clock": "on"}))
        start_time = time.process_time() - started
        if begin > 0.0:
            instance.fmu.doStep(0.0, begin)
        references = [model.outputs[name].valueReference for name in outputs]
        load, F_y = float(scene.inputs["shaft.F_y"](0.0)), [model.inputs["shaft.F_y"].valueReference]
        before, spent = instance.read(["solver.cpu_time", "solver.rhs_evals", "solver.steps"]), time.process_time()
        for i in range(round(length / step)):
            if changing:
                instance.fmu.setReal(F_y, [load * (1.0 + 0.01 * math.sin(2e3 * math.pi * i * step))])
            instance.fmu.doStep(begin + i * step, step)
            if references:
                instance.fmu.getReal(references)
        spent = time.process_time() - spent
        after = instance.read(list(before))
    own = {name: (after[name] - before[name]) / length for name in before}
    return {
        "rtf": spent / length,
        "inside": own["solver.cpu_time"],
        "evals": own["solver.rhs_evals"],
        "steps": own["solver.steps"],
        "start_ms": 1e3 * start_time,
    }


def least(repeat, *arguments, **options_):
    """The run of several that took least time."""
    return min((simulate(*arguments, **options_) for _ in range(repeat)), key=lambda row: row["rtf"])


# ---------------------------------------------------------------------------------------------------------------- balls


def bearing_file(Z):
    """A bearing of Z balls of the 6207's: pitch, masses and loads grow with Z, the balls' speed stays."""
    ratio = Z / 9.0
    d_m = 0.0535 * ratio
    values = {
        "bearing.D": 0.0111125,
        "bearing.d_m": d_m,
        "cage.D_o": d_m + 0.0060,
        "cage.D_i": d_m - 0.0038,
        "cage.m": 0.0276 * ratio,
        "cage.J_p": 2.07e-5 * ratio**3,
        "cage.J_t": 1.06e-5 * ratio**3,
    }
    inputs = {"shaft.F_x": 515.0 * ratio, "shaft.F_y": 2994.0 * ratio, "shaft.omega": 18238.0 * math.pi / 30.0 / ratio}
    text = [f'designation = "scaling-{Z}"', f'description = "{Z} balls of the 6207"', f"Z = {Z}", "[parameters]"]
    text += (
        [f"{name} = {value!r}" for name, value in values.items()]
        + ["[inputs]"]
        + [f"{name} = {value!r}" for name, value in inputs.items()]
    )
    folder = BUILD / "benchmarks"
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"scaling{Z}.toml"
    path.write_text("\n".join(text) + "\n")
    return path, inputs


def balls(scene, length, repeat):
    """Cost over the number of balls; each FMU is built for it."""
    rows = {}
    for Z in BALLS:
        path, inputs = bearing_file(Z)
        model = Model(build(path, out=path.with_suffix(".fmu")))
        history = scene.inputs["shaft.F_y"]
        loaded = replace(
            scene,
            inputs={name: replace(history, value=np.full_like(history.value, value)) for name, value in inputs.items()},
        )
        rows[Z] = least(repeat, model, loaded, length, 1e-4, outputs=peak_channels(model), begin=0.02)
        rows[Z]["us_per_eval"] = 1e6 * rows[Z]["inside"] / rows[Z]["evals"]
        say(f"Z = {Z}: RTF {rows[Z]['rtf']:.2f}, {rows[Z]['us_per_eval']:.2f} us an evaluation")
    return rows


# ----------------------------------------------------------------------------------------------------------------- runs


def horizon_child(connection, length):
    """One long run in a process of its own: cost and memory quarter by quarter."""
    model, scene = Model(FMU), replace(Scene("demo").checked, t_end=length)
    rows = []
    with Instance(model) as instance:
        instance.initialize(scene)
        references = [model.outputs[name].valueReference for name in peak_channels(model)]
        part, step = length / 4.0, 1e-3
        for quarter in range(4):
            spent = time.process_time()
            for i in range(round(part / step)):
                instance.fmu.doStep(quarter * part + i * step, step)
                instance.fmu.getReal(references)
            rows.append(
                {
                    "rtf": (time.process_time() - spent) / part,
                    "peak_memory_MB": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0,
                }
            )
    connection.send(rows)


def parallel_child(connection, barrier, length):
    """One of several runs at the same time."""
    model, scene = Model(FMU), replace(Scene("demo").checked, t_end=length)
    barrier.wait()
    wall = time.perf_counter()
    row = simulate(model, scene, length, 1e-4, outputs=peak_channels(model))
    connection.send(row | {"wall": time.perf_counter() - wall})


def children(count, target, *arguments):
    """Results of `count` processes that run at the same time."""
    context = multiprocessing.get_context("spawn")
    pairs = [context.Pipe(duplex=False) for _ in range(count)]
    processes = [context.Process(target=target, args=(sender, *arguments)) for _, sender in pairs]
    for process in processes:
        process.start()
    for _, sender in pairs:
        sender.close()  # the child holds the other end: EOFError below if it fails
    results = [receiver.recv() for receiver, _ in pairs]
    for process in processes:
        process.join()
    return results


def parallel(length):
    """Processor and wall time of one run alone and of two at a time; wall times mean something on an idle machine only."""
    rows = {}
    for count in (1, 2):
        barrier = multiprocessing.get_context("spawn").Barrier(count)
        results = children(count, parallel_child, barrier, length)
        rows[count] = {
            "rtf": float(np.mean([row["rtf"] for row in results])),
            "wall": max(row["wall"] for row in results) / length,
        }
    return rows


def main():
    short = options(__doc__).short
    model, scene = Model(FMU), Scene("demo").checked
    length, repeat = (0.05, 3) if short else (0.2, 5)
    channels = peak_channels(model)
    data = {"length": length}

    data["start_ms"] = min(simulate(model, scene, 1e-4, 1e-4)["start_ms"] for _ in range(5))
    data["step"] = {}
    for step in (1e-6, 1e-5, 1e-4, 1e-3, 1e-2):
        for name, changing in (("constant", False), ("changing", True)):
            span = min(length, 2000 * step) if step < 1e-5 else length
            data["step"].setdefault(f"{step:g}", {})[name] = least(
                repeat, model, scene, span, step, outputs=channels, changing=changing, begin=0.02
            )
        row = data["step"][f"{step:g}"]
        say(f"step {step:g} s: RTF {row['constant']['rtf']:.2f}, inside the FMU {row['constant']['inside']:.2f}")

    everything = list(model.outputs)
    data["outputs"] = {}
    for count in (0, 1, 18, 60, len(everything)):
        names = channels if count == 18 else everything[1 : count + 1] if count < len(everything) else everything
        data["outputs"][count] = least(repeat, model, scene, length, 1e-4, outputs=names, begin=0.02)
        say(f"{count} outputs: RTF {data['outputs'][count]['rtf']:.3f}")

    data["horizon"] = {}
    for horizon in (0.4, 4.0) if short else (0.4, 4.0, 40.0):
        data["horizon"][f"{horizon:g}"] = children(1, horizon_child, horizon)[0]
        say(f"{horizon} s: {data['horizon'][f'{horizon:g}']}")
    data["parallel"] = parallel(4 * length)
    say(f"parallel: {data['parallel']}")
    data["balls"] = balls(scene, length, repeat)
    write("scaling", data, short)


if __name__ == "__main__":
    main()
