"""Steps of a fixed length: instructions of a communication step, and statistics beside those of the default.

The bound of solver.method = fixed is counted, not timed: communication steps of 1e-4 s in which load and speed change
are run instruction by instruction in a child process, until each scene has shown what varies in it (balls in contact,
joints open and closed, mixed films).  The reading of peaks and statistics belongs to the step.

Statistics are those of the FMU over every internal step: mean and 99.9 % quantile of head stress and pocket force with
fixed steps against the default, the same seeds, with the standard error of the difference.
"""

import math

import numpy as np
from common import FMU, Core, Scene, build_target, options, say, write

import riveted_bearing as rb
from bearing_model.generated.variables import CageModel, Method, Stress, Switch

STEP, MOST = 1e-4, 20_000_000  # communication step [s], instructions of one at most
CAGES = CageModel.ELASTIC, CageModel.TWO_HALF  # the default first
LENGTHS = 10e-6, 6.25e-6, 5e-6, 4.1667e-6, 3.3334e-6  # of 1e-4 s a tenth, 16th, 20th, 24th, 30th
STATISTICS = "stat.sigma_head_mean", "stat.sigma_head_p999", "stat.Q_c_mean", "stat.Q_c_p999"
T_END = 0.25  # [s] of a run
RUNS = {  # name -> shipped scene, changes
    "working point": ("demo", {}),
    "4,000 r/min": ("demo", {"inputs": {"shaft.omega": "4000 rev/min"}}),
    "tilt of 0.2°": ("demo", {"inputs": {"shaft.tilt_z": "0.2 deg"}}),
    "tilt of 0.5°": ("demo", {"inputs": {"shaft.tilt_z": "0.5 deg"}}),
    "jam": ("jam", {}),
    "R": ("R", {}),
    "F": ("F", {}),
}


def instructions(core, scene, cage, samples):
    """Instructions of communication steps 0.7 ms apart, inputs changing: median, largest, and evaluations of one."""
    instance = scene.start(
        core,
        scene_cage=int(cage), scene_stress=int(Stress.PEAK), scene_statistics=int(Switch.ON),
        solver_method=int(Method.FIXED), solver_step=6.25e-6,
    )  # fmt: skip
    instance.step(0.02)
    addresses, counts = np.empty(MOST, dtype=np.uint64), []
    pointer = core.ffi.cast("unsigned long *", core.ffi.from_buffer(addresses))
    load, before = scene.inputs["shaft.F_y"], 0.0
    for i in range(samples):
        instance.set(**{"shaft.F_y": load * (1.0 + 0.01 * math.sin(0.1 * i))})
        instance.step(0.02 + 7e-4 * (i + 1) - STEP)
        counts.append(core.lib.trace_step(instance.bearing, instance.time + STEP, pointer, MOST))
        before = instance.output("solver.rhs_evals")
        instance.step(0.02 + 7e-4 * (i + 1))
    if min(counts) <= 0:
        raise SystemExit(f"{scene.name}: no single steps of a child process here")
    evaluations = instance.output("solver.rhs_evals") - before
    return {"median": float(np.median(counts)), "most": max(counts), "evaluations": evaluations}


def statistics(run, seeds, **solver):
    """[seeds, STATISTICS] of runs of the FMU, NaN where one ended early, and the share of steps beyond the error test."""
    shipped, changes = RUNS[run]
    found, beyond = [], []
    for seed in range(1, seeds + 1):
        more = {"start.seed": seed} | {name.replace("_", ".", 1): value for name, value in solver.items()}
        result = rb.run(
            shipped,
            fmu=FMU,
            **changes | {"parameters": changes.get("parameters", {}) | more},
            t_end=T_END,
            outputs=["shaft.F_y"],
        )
        s = result.summary
        ended = result.data["time"][-1] < 0.999 * T_END
        found.append([math.nan if ended else s[name] for name in STATISTICS])
        beyond.append(s["solver.error_tests_failed"] / s["solver.steps"])
    return np.array(found), float(np.mean(beyond))


def beside(fixed, default):
    """Changes of the means of seeds and their standard errors [%]."""
    change = 100.0 * (fixed.mean(0) / default.mean(0) - 1.0)
    scatter = np.sqrt((fixed.var(0, ddof=1) + default.var(0, ddof=1)) / len(fixed)) / default.mean(0)
    return {name: [float(c), float(100.0 * s)] for name, c, s in zip(STATISTICS, change, scatter, strict=True)}


def main():
    short = options(__doc__).short
    core = Core.load(build_target("bearing_kernels"))
    core.ffi.cdef("long trace_step(struct Part *, double, unsigned long *, long);", override=True)
    record = {"step": STEP, "instructions": {}, "statistics": {}}
    for cage in CAGES:
        rows = record["instructions"][cage.name.lower()] = {}
        for name in ("demo", "slow", "tilt", "impact", "jam"):
            scene = Scene(name)
            row = rows[name] = {"title": scene.title} | instructions(core, scene, cage, 4 if short else 12)
            say(
                f"{cage.name.lower()}, {name}: {row['median']:.3g} instructions, most {row['most'] / row['median']:.3f} times"
            )
    seeds = 2 if short else 8
    for run in RUNS:
        default, _ = statistics(run, seeds)
        rows = record["statistics"][run] = {}
        for length in LENGTHS[:2] if short else LENGTHS:
            fixed, beyond = statistics(run, seeds, solver_method="fixed", solver_step=length)
            rows[f"{1e6 * length:.3g}"] = {"beyond": beyond} | beside(fixed, default)
            say(f"{run}, {1e6 * length:.3g} us: {100.0 * beyond:.2g} % beyond, {beside(fixed, default)}")
    write("real_time", record, short)


if __name__ == "__main__":
    main()
