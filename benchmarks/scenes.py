"""Parts of the model that a scene does not need are not computed: gain in processor time and error of each.

Where there should be no error, the states at the end are compared bit for bit.  Errors of a simpler model
(traction at a point) are differences of statistics pooled over seeds, with 95 % half-widths of the seeds' scatter;
sampled peaks are compared with peaks over every step. Runs that are compared take turns, and the least time of several
counts, so that other users of the machine affect all runs alike.
"""

import math
import time

import numpy as np
from common import FMU, SCENES, Scene, core_library, counters, cpu, options, say, write
from scipy.stats import t as student

from bearing_model.generated import variables
from bearing_model.generated.variables import Lubrication, Method, Stress, Switch, Traction

STEP = 1e-4  # communication step [s]
FIGURES = [
    f"stat.{channel}_{figure}" for channel in ("Q_c", "sigma_head", "sigma_mid") for figure in ("mean", "rms", "p999")
]
GROUPS = sorted({variable.group for variable in variables.OUTPUTS.values()} - {"constant"})


def march(core, scene, length, groups=(), **parameters):
    """Processor time per simulated second, evaluations per second and the end state of a run in communication steps,
    output groups read at each.
    """
    instance = scene.start(core, **parameters)
    codes = [getattr(core.lib, f"GROUP_{group.upper()}") for group in groups]
    bearing, step, update = instance.bearing, core.lib.part_step, core.lib.part_update

    def steps():
        for i in range(round(length / STEP)):
            if step(bearing, (i + 1) * STEP) != core.lib.PART_OK:
                raise ArithmeticError(f"{scene.name}: {instance.messages}")
            for code in codes:
                update(bearing, code)

    before = counters(instance)["rhs_evals"]
    seconds, _ = cpu(steps)
    return seconds / length, (counters(instance)["rhs_evals"] - before) / length, instance.y


def compare(core, scene, length, cases, repeat):
    """Least time of each case, runs taking turns; bits: whether the end state is that of the first case."""
    results = {}
    for _ in range(repeat):
        for name, case in cases.items():
            rtf, evals, y = march(core, scene, length, **case)
            best = min(rtf, results[name]["rtf"]) if name in results else rtf
            results[name] = {"rtf": best, "evals": evals, "y": y}
    first = next(iter(results.values()))["y"]
    return {
        name: {"rtf": r["rtf"], "evals": r["evals"], "same_bits": r["y"].tobytes() == first.tobytes()}
        for name, r in results.items()
    }


# ----------------------------------------------------------------------------------------------------------- statistics


def statistics(core, scene, seeds, length, **parameters):
    """stat.* of each seed, {name: array}, and the cost."""
    rows, seconds = [], 0.0
    for seed in seeds:
        instance = scene.start(core, start_seed=seed, scene_statistics=int(Switch.ON), **parameters)
        spent, _ = cpu(lambda instance=instance: instance.step(scene.settle + length))
        seconds += spent
        rows.append([instance.output(name) for name in FIGURES])
    return dict(zip(FIGURES, np.array(rows).T)), seconds / (len(seeds) * (scene.settle + length))


def difference(simple, full):
    """Relative difference of means over seeds, with its 95 % half-width."""
    result = {}
    for name in FIGURES:
        a, b = simple[name], full[name]
        half = student.ppf(0.975, len(a) - 1) * math.hypot(a.std(ddof=1), b.std(ddof=1)) / math.sqrt(len(a))
        result[name.removeprefix("stat.")] = {"error": a.mean() / b.mean() - 1.0, "half_width": half / b.mean()}
    return result


def simpler(core, scene, seeds, length, name, value, full):
    """A simpler model against the full one."""
    rows, full_cost = statistics(core, scene, seeds, length, **{name: int(full)})
    simple, cost = statistics(core, scene, seeds, length, **{name: int(value)})
    return {"rtf": cost, "rtf_full": full_cost, "figures": difference(simple, rows)}


# ---------------------------------------------------------------------------------------------------------------- items


def stress_levels(core, scene, length, repeat):
    """Stress off, sampled, peak, fatigue; statistics off and on."""
    off = int(Switch.OFF)
    cases = {level.name.lower(): {"scene_stress": int(level), "scene_statistics": off} for level in Stress}
    cases["sampled"]["groups"] = ("stress",) if "stress" in GROUPS else ()
    cases["peak, statistics"] = {
        "scene_stress": int(Stress.PEAK),
        "scene_statistics": int(Switch.ON),
        "start_settle": 0.0,
    }
    cases["off, statistics"] = {
        "scene_stress": int(Stress.OFF),
        "scene_statistics": int(Switch.ON),
        "start_settle": 0.0,
    }
    return compare(core, scene, length, cases, repeat)


def sampled_peaks(core, scene, length):
    """Part of the largest head stress that samples at communication points miss, by the distance of these points."""
    instance = scene.start(core, scene_stress=int(Stress.PEAK)).step(scene.settle)
    fine, peaks, samples = 1e-5, [], []
    for i in range(round(length / fine)):
        instance.step(scene.settle + (i + 1) * fine)
        peaks.append(instance.output("rivet.sigma_head_max"))
        samples.append(np.max(instance.output("rivet.sigma_head")))
    peaks, samples = np.array(peaks), np.array(samples)
    result = {}
    for stride in (1, 10, 100):
        windows = peaks[: len(peaks) // 100 * 100].reshape(-1, 100).max(axis=1)  # over 1 ms
        seen = samples[stride - 1 : len(peaks) // 100 * 100 : stride].reshape(len(windows), -1).max(axis=1)
        result[f"{stride * fine:g}"] = {
            "missed_mean": float(np.mean(1.0 - seen / windows)),
            "missed_most": float(np.max(1.0 - seen / windows)),
        }
    return result


def output_groups(core, scene, repeat):
    """Time to read each group of outputs at a communication point [us], and whether reading changes the trajectory."""
    instance = scene.start(core, scene_stress=int(Stress.PEAK), scene_statistics=int(Switch.ON), start_settle=0.0)
    costs, rounds = {}, 40 * repeat
    t = 0.0
    for group in ("the evaluation that all share", *GROUPS, "all"):
        names = GROUPS if group == "all" else [group] if group in GROUPS else ["state"]
        codes = [getattr(core.lib, f"GROUP_{name.upper()}") for name in names]
        spent = []
        for _ in range(rounds):
            t += 1e-5
            instance.step(t)
            if group in GROUPS:
                core.lib.part_update(instance.bearing, core.lib.GROUP_STATE)  # the evaluation that all groups share
            begin = time.perf_counter_ns()
            for code in codes:
                core.lib.part_update(instance.bearing, code)
            spent.append(1e-3 * (time.perf_counter_ns() - begin))
        costs[group] = float(np.median(spent))
    length = 0.01
    bits = compare(core, scene, length, {"none": {}, "all": {"groups": GROUPS}}, repeat)
    return {"median_us": costs, "reading": bits}


def unchanged_inputs(core, scene, length, step, repeat):
    """Evaluations and time of a run in communication steps: free, with constant inputs, with inputs that change at
    each.
    """
    results = {}
    for _ in range(repeat):
        for name in ("free", "constant", "changing"):
            instance = scene.start(core, scene_stress=int(Stress.OFF), scene_statistics=int(Switch.OFF))
            instance.step(0.01)
            before, inputs = counters(instance)["rhs_evals"], core.lib.part_inputs(instance.bearing, 0)
            load = inputs.shaft.F_y

            def steps(name=name, instance=instance, inputs=inputs, load=load):
                if name == "free":
                    instance.step(0.01 + length)
                    return
                for i in range(round(length / step)):
                    if name == "changing":
                        inputs.shaft.F_y = load * (1.0 + 0.01 * math.sin(2e3 * math.pi * i * step))
                    core.lib.part_step(instance.bearing, 0.01 + (i + 1) * step)

            seconds, _ = cpu(steps)
            evals = counters(instance)["rhs_evals"] - before
            best = min(seconds, results[name]["seconds"]) if name in results else seconds
            results[name] = {"seconds": best, "evals": evals}
    return {name: {"rtf": r["seconds"] / length, "evals": r["evals"] / length} for name, r in results.items()}


def solver_paths(core, length, repeat):
    """Every solver path in every scene."""
    rows = {}
    for name in SCENES:
        scene = Scene(name)
        cases = {
            method.name.lower(): {"solver_method": int(method), "scene_statistics": int(Switch.OFF)}
            for method in Method
        }
        rows[name] = compare(core, scene, length, cases, repeat)
        say("paths, " + name + ": " + ", ".join(f"{path} {row['rtf']:.2f}" for path, row in rows[name].items()))
    return rows


def main():
    short = options(__doc__).short
    core, demo = core_library(), Scene("demo")
    assert FMU.is_file()
    length, repeat = (0.02, 3) if short else (0.1, 5)
    seeds, span = (range(1, 5), 0.1) if short else (range(1, 9), 0.4)
    data = {"stress": stress_levels(core, demo, length, repeat)}
    say("stress: " + ", ".join(f"{name} {row['rtf']:.3f}" for name, row in data["stress"].items()))
    data["sampled_peaks"] = sampled_peaks(core, demo, 0.05 if short else 0.2)
    data["groups"] = output_groups(core, demo, repeat)
    say(f"groups: {data['groups']['median_us']}")
    data["inputs"] = {f"{step:g}": unchanged_inputs(core, demo, length, step, repeat) for step in (1e-4, 1e-5)}
    say(f"inputs: {data['inputs']}")
    data["paths"] = solver_paths(core, length, repeat)
    simple = {
        "traction at a point": ("scene_traction", Traction.POINT, Traction.SLICED),
        "full film": ("scene_lubrication", Lubrication.FILM, Lubrication.MIXED),
    }
    data["models"] = {}
    for name, (parameter, value, full) in simple.items():
        data["models"][name] = simpler(core, demo, seeds, span, parameter, value, full)
        row = data["models"][name]
        say(f"{name}: RTF {row['rtf']:.2f} against {row['rtf_full']:.2f}")
    write("scenes", data | {"length": length, "seeds": len(seeds), "span": span}, short)


if __name__ == "__main__":
    main()
