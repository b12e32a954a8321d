"""Lives, sensitivities and choices under test: what the commands of docs/life.md say beside what far more runs say.

    coverage    40 missions of two points with seeds of their own through the code of `life`; truth: all runs together.  Share whose interval holds it
    binned      a measured record of load, simulated whole by many seeds, beside `life` of its classes
    twenty      time of a mission of 20 points and 1,000 h with 25 % at 90 % confidence, and where it goes
    choice      `optimize` of preload and fit beside a grid of equal cost: both answers simulated again with the same fresh seeds

python benchmarks/life.py [PART ...]    all parts in some 15 minutes on two cores; writes the record "life"
"""

import argparse
import contextlib
import io
import itertools
import json
import resource
import subprocess
import sys
import tempfile
import time
import tomllib
from functools import cache
from pathlib import Path

import numpy as np
from common import FMU, say, write

from riveted_bearing.design.bench import Bench
from riveted_bearing.design.optimize import plan_optimize, search
from riveted_bearing.duty.assess import Runs
from riveted_bearing.duty.confidence import until_sure
from riveted_bearing.duty.miner import lives
from riveted_bearing.duty.mission import load_mission
from riveted_bearing.running.fmu import Model
from riveted_bearing.studies.sweep import cluster

MISSIONS, SEEDS = 40, 12  # and runs that a mission may ask for at each point
TWO_POINTS = """
scene = "demo"
simulation.t_end = 0.1
[[point]]
hours = 3
inputs.shaft.F_y = "2 kN"
[[point]]
hours = 1
[life]
rivets = "alike"
half_width = 0.15
max_seeds = 480
"""
RECORD_S, WHOLE_SEEDS = 2.0, 12  # length of the record of load [s]
HISTORY = """
scene = "demo"
simulation.t_end = 0.2
[history]
file = "load.csv"
time = "t"
inputs.shaft.F_y = {{ column = "F", unit = "N", bins = {bins} }}
[life]
rivets = "alike"
half_width = 0.1
max_seeds = 24
skip = 0
"""
WHOLE = """
scene = "demo"
simulation.t_end = {end}
[[point]]
hours = 1
inputs.shaft.F_y = {{ t = {t}, value = {F} }}
[life]
rivets = "alike"
max_seeds = {seeds}
"""
CHOICE = """
scene = "demo"
seeds = 2
objectives = ["damage"]
trials = 24
batch = 4
check_seeds = 4
candidates = 3
simulation.t_end = 0.1
[between]
joint.preload = ["5 N", "60 N"]
joint.fit = ["-30 um", "0 um"]
"""
FRESH = range(5001, 5025)  # seeds that neither search has seen


@cache
def model():
    return Model(FMU)


class Workshop:
    """A folder with a cluster that starts when it is needed."""

    def __init__(self, stack):
        self.folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        self.client = cache(lambda: stack.enter_context(cluster()))

    def file(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def runs(self, name, text):
        mission = load_mission(self.file(f"{name}.toml", text), model())
        (self.folder / name).mkdir()
        return mission, Runs(mission, model(), self.folder / name, self.client)


def coverage(shop):
    """Missions that draw their runs from a pool, a stretch of it each."""
    mission, runs = shop.runs("two", TWO_POINTS)
    pool = runs([MISSIONS * SEEDS] * 2)
    truth = life_of(mission, pool)
    hits, lowest, highest, counts = 0, np.inf, 0.0, []
    for m in range(MISSIONS):
        own = [damages[m * SEEDS : (m + 1) * SEEDS] for damages in pool]
        found, _, used = until_sure(
            mission.duty,
            lambda n, own=own: [d[:k] for d, k in zip(map(alike, own), n, strict=True)],
            mission.settings,
            SEEDS,
        )
        hits += int(found.low <= truth <= found.high)
        lowest, highest = min(lowest, found.life), max(highest, found.life)
        counts.append(int(sum(used)))
    return {
        "missions": MISSIONS,
        "covered": hits,
        "truth_h": truth,
        "lowest_h": lowest,
        "highest_h": highest,
        "mean_runs": float(np.mean(counts)),
    }


def alike(damages):
    """Damages [n, K] of rivets that take every place in turn: mean over the rivets of heads and of middles."""
    return np.asarray(damages).mean(axis=1)


def life_of(mission, pool):
    """Life [h] of a mission whose rates are the means over all runs of the pool."""
    return float(lives(mission.duty, np.array([alike(damages).mean(axis=0) for damages in pool]))[0].min())


def binned(shop):
    """The load swings once between 2.4 and 4.2 kN; the record has a sample each 10 ms, the run goes linearly between
    them.

    The speed stays: where it swings, each swing is also one large cycle of stress between the classes, which no class
    has.
    """
    t = np.arange(0.0, RECORD_S, 1e-2)
    F = 3300.0 - 900.0 * np.cos(2.0 * np.pi * t / RECORD_S)
    np.savetxt(shop.folder / "load.csv", np.column_stack([t, F]), delimiter=",", header="t,F", comments="")
    settle = 0.02  # the run's beginning, which does not count, has the record's first load
    text = WHOLE.format(
        end=RECORD_S + settle, t=[0.0, *map(float, t + settle)], F=[float(F[0]), *map(float, F)], seeds=WHOLE_SEEDS
    )
    mission, runs = shop.runs("whole", text)
    (damages,) = runs([WHOLE_SEEDS])
    whole = alike(damages)
    place = whole.mean(axis=0).argmax()
    rates = whole[:, place]
    result = {
        "whole_h": 1.0 / rates.mean(),
        "whole_relative_error": float(rates.std(ddof=1) / np.sqrt(len(rates)) / rates.mean()),
    }
    for bins in (5, 10):
        mission, runs = shop.runs(f"bins_{bins}", HISTORY.format(bins=bins))
        found, _, counts = until_sure(
            mission.duty, lambda n, runs=runs: [alike(d) for d in runs(n)], mission.settings, 24
        )
        result |= {
            f"life_{bins}_h": found.life,
            f"low_{bins}_h": found.low,
            f"high_{bins}_h": found.high,
            f"runs_{bins}": int(sum(counts)),
        }
    return result


def twenty(shop):
    """Loads and speeds of 20 points hours fall with the load."""
    lines = ['scene = "demo"', "simulation.t_end = 0.1", "[life]", "half_width = 0.25", "max_seeds = 32"]
    for i, (F_y, speed) in enumerate(itertools.product((600, 1200, 1800, 2400, 3000), (9000, 12000, 15000, 18000))):
        lines += [
            "[[point]]",
            f"hours = {1000 * [0.1, 0.08, 0.04, 0.02, 0.01][i // 4]:g}",
            f'inputs.shaft.F_y = "{F_y} N"',
        ]
        lines += [f'inputs.shaft.omega = "{speed} rev/min"']
    path, out = shop.file("twenty.toml", "\n".join(lines)), shop.folder / "twenty"
    before, began = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    subprocess.run(
        [sys.executable, "-m", "riveted_bearing", "life", str(path), "--fmu", str(FMU), "--out", str(out)],
        check=True,
        capture_output=True,
    )
    wall, after = time.monotonic() - began, resource.getrusage(resource.RUSAGE_CHILDREN)
    found = json.loads((out / "life.json").read_text())
    mission = load_mission(path, model())
    runs = Runs(mission, model(), out, None)
    runs([point["seeds"] or 0 for point in found["points"]])
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    seeds = sum(point["seeds"] or 0 for point in found["points"])
    half_width = (found["high_h"] / found["low_h"]) ** 0.5 - 1.0
    costs = {"wall_s": wall, "cpu_s": cpu, "runs_cpu_s": sum(runs.cost.values()), "runs": seeds}
    return costs | {"half_width": half_width} | {key: found[key] for key in ("life_h", "low_h", "high_h")}


def choice(shop):
    """Optuna's trials beside as many points of a grid."""
    document = tomllib.loads(CHOICE)
    path = shop.file("choice.toml", CHOICE)
    plan = plan_optimize(path, document, model())
    (shop.folder / "choice").mkdir()
    bench = Bench(path, document, model(), shop.folder / "choice", shop.client)
    found = search(plan, bench)
    spent = plan.trials * bench.seeds + len(found.candidates) * plan.check_seeds
    chosen = found.points[found.candidates[found.best]]
    grid = np.array(list(itertools.product(np.linspace(5.0, 60.0, 6), np.linspace(-30e-6, 0.0, 3))))
    values = bench(plan.box.names, grid, plan.responses, range(1, 1 + spent // len(grid))).mean(axis=1)[:, 0]
    best = grid[values.argmin()]
    again = bench(plan.box.names, np.array([chosen, best]), plan.responses, FRESH)[..., 0]
    rates = 10.0**again
    error = rates.std(axis=1, ddof=1) / np.sqrt(rates.shape[1])
    return {
        "cost_runs": spent,
        "grid_runs": len(grid) * (spent // len(grid)),
        "optimum": {
            "preload": chosen[0],
            "fit": chosen[1],
            "log10_damage_per_h": float(np.log10(rates[0].mean())),
            "error": float(error[0] / rates[0].mean()),
        },
        "grid": {
            "preload": best[0],
            "fit": best[1],
            "log10_damage_per_h": float(np.log10(rates[1].mean())),
            "error": float(error[1] / rates[1].mean()),
        },
        "pairs_better": int((again[0] < again[1]).sum()),
        "pairs": len(FRESH),
    }


PARTS = {part.__name__: part for part in (coverage, binned, twenty, choice)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument(
        "parts", nargs="*", metavar="PART", help=f"of {', '.join(PARTS)}; default: all, written as a record"
    )
    chosen = parser.parse_args().parts or list(PARTS)
    result = {}
    for name in chosen:
        with contextlib.ExitStack() as stack, contextlib.redirect_stderr(io.StringIO()):
            result[name] = PARTS[name](Workshop(stack))
        say(f"{name}: {json.dumps(result[name])}")
    if len(chosen) == len(PARTS):
        write("life", result, short=False)


if __name__ == "__main__":
    main()
