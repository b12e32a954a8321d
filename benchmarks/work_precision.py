"""Run time against error for every solver setting on the same scenes.

Two errors, because trajectories are chaotic (e-fold 1.4...2.7 ms):

states      RMS over all states of error/(tolerance scale) after 2 ms from settled states, against Dormand-Prince at 1e-10, itself compared with
            Verner 6(5) at 1e-10.  (Pairs of order 8 are no reference here: their error estimates miss the kinks of
            friction, and at 1e-10 they still err by 1e-4...3e-4.)  Geometric mean over start states.
statistics  mean, RMS and 99.9 % quantile of pocket force and of the worst rivet's stress, pooled over seeds, against a run at a tight tolerance.
            95 % intervals: the larger one of seeds (Student, of the differences seed by seed: under a tilt a seed's
            balls keep their spacing) and of a bootstrap over 20 ms blocks common to all seeds, since in jams all seeds
            may follow one attractor.

Cost is processor time per simulated time (RTF), with evaluations of the right-hand side and steps beside it.  Costs of
state runs are without stress and statistics, costs of statistics runs with peak stress and statistics.
"""

import itertools
import math
from dataclasses import dataclass

import numpy as np
from common import (
    SCENES,
    Core,
    Scene,
    build_target,
    core_library,
    counters,
    cpu,
    declare,
    options,
    say,
    set_state,
    write,
)
from scipy.stats import t as student

from bearing_model.generated import variables
from bearing_model.instance.statistics import StatisticsChannel
from bearing_model.solver import integrator as reference_implementation

HORIZON, PYTHON_HORIZON, BLOCK = 2e-3, 0.5e-3, 20e-3  # [s]
DENSE_OUTPUTS = 0.4 / 10_000  # the paper's 10,000 outputs in 0.4 s
TABLES = {
    "Bogacki-Shampine 3(2)": "ARKODE_BOGACKI_SHAMPINE_4_2_3",
    "Zonneveld 4(3)": "ARKODE_ZONNEVELD_5_3_4",
    "Dormand-Prince 5(4)": "ARKODE_DORMAND_PRINCE_7_4_5",
    "Verner 6(5)": "ARKODE_VERNER_8_5_6",
    "Verner 8(7)": "ARKODE_VERNER_13_7_8",
}
JACOBIANS = {"dense": 0, "diagonal": 1}
PYTHON_METHODS = ("RK45", "DOP853", "BDF", "Radau")
# of the default and the tight run: enough to resolve 1 %
SEEDS = {"demo": 48, "slow": 128, "tilt": 48, "impact": 48, "jam": 16}
CHANNELS = {"Q_c": "force", "sigma_head": "head", "sigma_mid": "mid"}
FIGURES = ("mean", "rms", "p999")
DEFAULT_TOLERANCE = variables.PARAMETERS["solver.tol"].start
DEFAULT = "ours, " + variables.Method(variables.PARAMETERS["solver.method"].start).name.lower()


@dataclass(frozen=True)
class Setting:
    """One solver at one tolerance: the core's own (method) or one of solvers.c (choice)."""

    family: str
    tolerance: float
    method: int | None = None
    choice: tuple | None = None


class Bench:
    """The two libraries and the measurements."""

    def __init__(self):
        self.core = core_library()
        self.other = declare(Core.load(build_target("bearing_solvers")), "solvers.h")
        self.kept = []  # names of tables, kept alive because C keeps pointers to them

    def instance(self, scene, setting, **parameters):
        """An instance of a scene with a solver setting."""
        if setting.choice is None:
            return scene.start(self.core, setting.tolerance, solver_method=setting.method, **parameters)
        method, table, jacobian, interval = setting.choice
        self.kept.append(self.other.ffi.new("char[]", table.encode()))
        self.other.lib.solver_choose(method, self.kept[-1], jacobian, interval)
        return scene.start(self.other, setting.tolerance, **parameters)

    def jacobian_evals(self, setting):
        """Evaluations for Jacobians since the instance was made."""
        if setting.choice is None:
            return 0.0
        counts = self.other.ffi.new("double[2]")
        self.other.lib.solver_counts(counts, counts + 1)
        return counts[0]

    def scales(self, scene):
        """Tolerance scale of each state."""
        d, scale = self.core.model(scene.parameters, scene.inputs).d, np.empty(variables.N_STATES)
        for i in range(self.core.lib.N_STATE_BLOCKS):
            block = self.core.lib.STATE_BLOCKS[i]
            scale[block.offset : block.offset + block.count] = d.scale[int(block.scale)]
        return scale

    # ---- states ------------------------------------------------------------------------------------------------------

    def settled(self, scene, seeds):
        """Settled states of several seeds."""
        setting = Setting(DEFAULT, DEFAULT_TOLERANCE, method=int(variables.Method.VERLET))
        return [
            self.instance(scene, setting, start_seed=seed, scene_stress=1, scene_statistics=1).step(scene.settle).y
            for seed in seeds
        ]

    def advance(self, scene, setting, y, horizon, repeat=1):
        """One run from state y: processor time, counters, end state."""
        best = math.inf
        for _ in range(repeat):
            instance = self.instance(scene, setting, scene_stress=1, scene_statistics=1)
            set_state(instance, y)
            before = counters(instance)
            seconds, _ = cpu(lambda instance=instance: instance.step(horizon))
            best = min(best, seconds)
        after = counters(instance)
        work = {name: after[name] - before[name] for name in after}
        work["rhs_evals"] += self.jacobian_evals(setting)
        return best, work, instance.y

    def states(self, scene, setting, starts, truths, horizon=HORIZON):
        """Error and cost of a setting over start states."""
        scale, rows = self.scales(scene), []
        for y, truth in zip(starts, truths, strict=True):
            try:
                seconds, work, end = self.advance(scene, setting, y, horizon, repeat=3)
            except ArithmeticError as problem:
                return {"failed": str(problem)[:200]}
            rows.append(
                [rms((end - truth) / scale), seconds / horizon, work["rhs_evals"] / horizon, work["steps"] / horizon]
            )
        error, rtf, evals, steps = np.array(rows).T
        return {
            "error": geometric(error),
            "error_least": error.min(),
            "error_most": error.max(),
            "rtf": rtf.mean(),
            "evals": evals.mean(),
            "steps": steps.mean(),
        }

    def truth(self, scene, y, horizon):
        """End state at 1e-10, and how far another method ends from it."""
        tight = [
            Setting(name, 1e-10, choice=(0, TABLES[name], 0, 0.0)) for name in ("Dormand-Prince 5(4)", "Verner 6(5)")
        ]
        ends = [self.advance(scene, setting, y, horizon)[2] for setting in tight]
        return ends[0], rms((ends[1] - ends[0]) / self.scales(scene))

    def python(self, scene, method, tolerance, y, truth):
        """The Python reference over its short horizon; RTF is extrapolated."""
        parameters = {key: value for key, value in scene.parameters.items() if key != "scene.statistics"} | {
            "scene.stress": 1
        }

        def simulate():
            return reference_implementation.simulate(
                parameters, scene.inputs, PYTHON_HORIZON, step=PYTHON_HORIZON, tolerance=tolerance, method=method, y=y
            )

        seconds, results = cpu(simulate)
        error = rms((results.y[-1] - truth) / self.scales(scene))
        return {
            "error": error,
            "rtf": seconds / PYTHON_HORIZON,
            "evals": results.rhs_evals / PYTHON_HORIZON,
            "steps": results.steps / PYTHON_HORIZON,
        }

    # ---- statistics --------------------------------------------------------------------------------------------------

    def statistics(self, scene, setting, seeds, length):
        """Histograms of each seed and block, [seed][block] -> {channel: numbers}, and the cost."""
        runs, seconds, evals = [], 0.0, 0.0
        for seed in seeds:
            instance = self.instance(
                scene,
                setting,
                start_seed=seed,
                scene_stress=int(variables.Stress.PEAK),
                scene_statistics=int(variables.Switch.ON),
            )
            instance.step(scene.settle)
            before, blocks = counters(instance), [moments(instance)]
            for i in range(round(length / BLOCK)):
                spent, _ = cpu(lambda t=scene.settle + (i + 1) * BLOCK, instance=instance: instance.step(t))
                seconds += spent
                blocks.append(moments(instance))
            evals += counters(instance)["rhs_evals"] - before["rhs_evals"] + self.jacobian_evals(setting)
            runs.append(
                [{name: late[name] - early[name] for name in late} for early, late in itertools.pairwise(blocks)]
            )
        span = length * len(seeds)
        return runs, {"rtf": seconds / span, "evals": evals / span}


def rms(errors):
    """RMS without the state that no error test controls, the work done."""
    return float(np.sqrt(np.mean(np.delete(errors, variables.STATE_SLICES["work"]) ** 2)))


def geometric(values):
    return float(np.exp(np.mean(np.log(values))))


def moments(instance):
    """The running statistics' numbers by channel: time, sums, histogram."""
    core = instance.core
    saved = core.new("InstanceState")
    core.lib.part_save(instance.bearing, saved)
    worst = variables.Z
    channels = {"Q_c": saved.force, "sigma_head": saved.head[worst], "sigma_mid": saved.mid[worst]}
    return {
        name: np.array([channel.time, channel.first, channel.second, *channel.weight])
        for name, channel in channels.items()
    }


def figures(blocks):
    """Pooled statistics of many blocks: {channel_figure: value}."""
    floors = {"Q_c": reference_implementation.FORCE_FLOOR, "sigma_head": reference_implementation.STRESS_FLOOR}
    values = {}
    for name in CHANNELS:
        total = np.sum([block[name] for block in blocks], axis=0)
        channel = StatisticsChannel(floors.get(name, reference_implementation.STRESS_FLOOR))
        (channel.time, channel.first, channel.second), channel.weight, channel.max = total[:3], total[3:], math.inf
        values |= {f"{name}_mean": channel.mean, f"{name}_rms": channel.rms, f"{name}_p999": channel.quantile(0.999)}
    return values


def pooled(runs, replicates=300):
    """Pooled figures with those of each seed and the bootstrap's 95 % half-width, both relative to the pooled one."""
    whole = figures([block for blocks in runs for block in blocks])
    seeds = [figures(blocks) for blocks in runs]
    rng, count = np.random.default_rng(1), len(runs[0])
    by_block = [{name: np.sum([blocks[i][name] for blocks in runs], axis=0) for name in CHANNELS} for i in range(count)]
    copies = [figures([by_block[i] for i in rng.integers(0, count, count)]) for _ in range(replicates)]
    result = {}
    for name, value in whole.items():
        by_time = 0.5 * np.subtract(*np.quantile([c[name] for c in copies], [0.975, 0.025]))
        result[name] = {"value": value, "by_seed": [s[name] / value for s in seeds], "of_blocks": by_time / abs(value)}
    return result


def against(result, truth):
    """Relative differences from the tight run with 95 % half-widths, over the seeds that both have."""
    rows = {}
    for name, r in result.items():
        tight = truth[name]
        differences = [a - b for a, b in zip(r["by_seed"], tight["by_seed"], strict=False)]
        by_seed = student.ppf(0.975, len(differences) - 1) * np.std(differences, ddof=1) / math.sqrt(len(differences))
        rows[name] = {
            "error": r["value"] / tight["value"] - 1.0,
            "half_width": max(by_seed, math.hypot(r["of_blocks"], tight["of_blocks"])),
        }
    return rows


# ------------------------------------------------------------------------------------------------------------- settings


def state_settings(short):
    ours = [
        Setting(f"ours, {method.name.lower()}", tol, method=int(method))
        for method in variables.Method
        for tol in (1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 1e-5, 1e-6)
    ]
    explicit = [
        Setting(name, tol, choice=(0, table, 0, 0.0))
        for name, table in TABLES.items()
        for tol in (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7)
    ]
    adams = [Setting("CVODE Adams", tol, choice=(1, "", 0, 0.0)) for tol in (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)]
    tols = (1e-2, 1e-3, 1e-4) if short else (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
    bdf = [
        Setting(f"CVODE BDF, {name}", tol, choice=(2, "", code, DENSE_OUTPUTS))
        for name, code in JACOBIANS.items()
        for tol in tols
    ]
    return ours + explicit + adams + bdf


def statistics_settings(short):
    default = int(variables.Method[DEFAULT.partition(", ")[2].upper()])
    ours = [
        Setting(DEFAULT, tol, method=default)
        for tol in sorted(
            {1e-2, 3e-3, 1e-3, 3e-4, 1e-4, DEFAULT_TOLERANCE} if not short else {1e-2, 1e-3, DEFAULT_TOLERANCE}
        )
    ]
    if short:
        return ours
    others = [Setting(f"ours, {m.name.lower()}", 1e-3, method=int(m)) for m in variables.Method if int(m) != default]
    explicit = [
        Setting(name, 1e-3, choice=(0, TABLES[name], 0, 0.0))
        for name in ("Bogacki-Shampine 3(2)", "Dormand-Prince 5(4)")
    ]
    adams = [Setting("CVODE Adams", 1e-3, choice=(1, "", 0, 0.0))]
    return (
        ours
        + others
        + explicit
        + adams
        + [Setting(f"CVODE BDF, {n}", 1e-3, choice=(2, "", JACOBIANS[n], DENSE_OUTPUTS)) for n in JACOBIANS]
    )


TIGHT = Setting("Dormand-Prince 5(4)", 1e-6, choice=(0, TABLES["Dormand-Prince 5(4)"], 0, 0.0))

# ------------------------------------------------------------------------------------------------------------- programs


def state_part(bench, scene, short):
    """Work and precision over 2 ms."""
    starts = bench.settled(scene, range(1, 5 if short else 9))
    truths, doubts = zip(*[bench.truth(scene, y, HORIZON) for y in starts])
    rows = []
    for setting in state_settings(short):
        few = 2 if "BDF" in setting.family and short else len(starts)
        rows.append(
            {"family": setting.family, "tolerance": setting.tolerance}
            | bench.states(scene, setting, starts[:few], truths[:few])
        )
    say(f"  states: {len(rows)} settings, reference good to {max(doubts):.1e}")
    return {"rows": rows, "reference_doubt": max(doubts), "starts": len(starts)} | python_part(
        bench, scene, starts[0], short
    )


def python_part(bench, scene, y, short):
    """The Python reference, and our default over the same horizon."""
    if short and scene.name != "demo":
        return {"python": []}
    truth, _ = bench.truth(scene, y, PYTHON_HORIZON)
    ours = [
        {"family": DEFAULT, "tolerance": tol}
        | bench.states(scene, Setting(DEFAULT, tol, method=int(variables.Method.VERLET)), [y], [truth], PYTHON_HORIZON)
        for tol in (1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 1e-5, 1e-6)
    ]
    rows = [
        {"family": f"Python {method}", "tolerance": tol} | bench.python(scene, method, tol, y, truth)
        for method in PYTHON_METHODS
        for tol in ((1e-3,) if short else (1e-2, 1e-3, 1e-4))
    ]
    say(f"  Python: RTF {min(r['rtf'] for r in rows):.0f}...{max(r['rtf'] for r in rows):.0f}")
    return {"python": rows, "python_ours": ours}


def statistics_part(bench, scene, short):
    """Statistics over seeds."""
    length = 0.1 if short else 0.4
    few, many, most = (range(1, 1 + (8 if short else count)) for count in (8, 16, SEEDS[scene.name]))
    truth_runs, truth_cost = bench.statistics(scene, TIGHT, most, length)
    rows = []
    for setting in statistics_settings(short):
        seeds = (
            few
            if setting.choice is not None
            else most
            if (setting.family, setting.tolerance) == (DEFAULT, DEFAULT_TOLERANCE)
            else many
        )
        runs, cost = bench.statistics(scene, setting, seeds, length)
        errors = against(pooled(runs), pooled(truth_runs[: len(seeds)]))
        rows.append(
            {"family": setting.family, "tolerance": setting.tolerance} | cost | {"seeds": len(seeds), "figures": errors}
        )
        worst = max(abs(figure["error"]) for figure in rows[-1]["figures"].values())
        say(
            f"  statistics: {setting.family} {setting.tolerance:g}: RTF {cost['rtf']:.2f}, largest error {100 * worst:.2f} %"
        )
    return {"rows": rows, "truth_cost": truth_cost, "seeds": [len(few), len(many), len(most)], "length": length}


def main():
    short = options(__doc__).short
    bench, scenes = Bench(), {}
    for name in SCENES:
        scene = Scene(name)
        say(scene.title)
        scenes[name] = {"title": scene.title, "states": state_part(bench, scene, short)}
        scenes[name]["statistics"] = statistics_part(bench, scene, short)
        write(
            "work_precision",
            {
                "default": {"family": DEFAULT, "tolerance": DEFAULT_TOLERANCE},
                "horizon": HORIZON,
                "python_horizon": PYTHON_HORIZON,
                "scenes": scenes,
            },
            short,
        )


if __name__ == "__main__":
    main()
