"""Search for the costliest communication step: random scenes and inputs within the limits of the variable table.

    python -m benchmarks.costliest [--seconds 3600] [--seed 1] [--fmu FILE] [--out costliest.json]

A candidate is a few parameters, a few inputs, and what changes before each of its steps.  Half of the candidates are
new; the others change, add or drop one value of one of the costliest so far.  The cost of a candidate is the processor
time of its costliest step, `solver.cpu_time`, per 0.1 ms of simulated time; a step shorter than 0.1 ms counts as one of
0.1 ms.  Candidates that the start refuses cost nothing.  Those that the FMU stops, at its work limit or for another
reason, are listed apart: the search goes on from those that run to their end.  The file has both lists, so that each
candidate can be run again: `python -m benchmarks.costliest --again costliest.json`.
"""

import argparse
import json
import sys
import time
from pathlib import Path

import numpy as np
from fmpy.fmi1 import FMICallException

from riveted_bearing.running.fmu import Instance, Model, codes

STEP = 1e-4  # of an honest host [s]
BOUND = 0.2  # processor time that a step of 0.1 ms may take [s]
KEPT = 25
STEPS = 8
# without effect on a single step, or its purpose is to bound the cost
LEFT_OUT = {"solver.max_steps", "start.settle", "pulse.t_start", "bearing.d_m"}
EVENTFUL = ("shaft.", "housing.", "frame.", "impact.")


def limits(variable):
    return float(variable.min), float(variable.max)


def draw(variable, random):
    """An allowed value: near the start value, uniform or logarithmic between the limits, or a limit itself."""
    if variable.type == "Enumeration":
        return str(random.choice(list(codes(variable))))
    low, high = limits(variable)
    if variable.type == "Integer":
        return int(random.integers(low, min(high, 1000) + 1))
    start, kind = float(variable.start), random.integers(4)
    if kind == 0:
        value = (start or 0.1 * high) * random.uniform(0.3, 3.0)
    elif kind == 1:
        value = random.uniform(low, high)
    elif kind == 2:
        value = random.choice([low, high])
    else:
        value = high * 10.0 ** random.uniform(-6.0, 0.0) * (random.choice([-1.0, 1.0]) if low < 0 else 1.0)
    return float(min(max(value, low), high))


class Search:
    def __init__(self, model, random):
        self.model, self.random = model, random
        self.parameters = {
            name: v
            for name, v in model.parameters.items()
            if name not in LEFT_OUT and (v.type == "Enumeration" or None not in (v.min, v.max))
        }
        self.inputs = model.inputs
        self.eventful = [name for name in self.inputs if name.startswith(EVENTFUL)]

    def some(self, table, names, most):
        chosen = self.random.choice(names, self.random.integers(most + 1), replace=False)
        return {str(name): draw(table[name], self.random) for name in chosen}

    def new(self):
        """A candidate; switches of the scene more often than by chance."""
        random = self.random
        switches = [
            name for name in self.parameters if name.startswith("scene.") or name in ("ring.motion", "ring.tilt_mode")
        ]
        parameters = self.some(self.parameters, switches, 5) | self.some(self.parameters, list(self.parameters), 5)
        inputs = self.some(self.inputs, list(self.inputs), 3)
        changes = {str(int(k)): self.some(self.inputs, self.eventful, 3) for k in random.integers(1, STEPS, 2)}
        shorter = random.random() < 0.3
        steps = [
            STEP if not shorter or random.random() < 0.6 else float(10.0 ** random.uniform(-9, -4))
            for _ in range(STEPS)
        ]
        return {"parameters": parameters, "inputs": inputs, "changes": changes, "steps": steps}

    def mutant(self, candidate):
        one = json.loads(json.dumps(candidate))
        place = self.random.choice(["parameters", "inputs", "changes"])
        table = self.parameters if place == "parameters" else self.inputs
        values = one[place]
        if place == "changes":
            values = one["changes"].setdefault(str(int(self.random.integers(1, STEPS))), {})
        if values and self.random.random() < 0.6:
            name = str(self.random.choice(list(values)))
            if self.random.random() < 0.4:
                del values[name]
            else:
                values[name] = draw(table[name], self.random)
        else:
            values |= self.some(table, list(table), 2)
        return one

    def cost(self, candidate):
        """Processor time of the costliest step [s], its internal steps, how the candidate ended."""
        with Instance(self.model) as instance:
            fmu = instance.fmu
            try:
                for name, value in candidate["parameters"].items():
                    instance.set_parameter(self.parameters[name], value)
                self.set_inputs(fmu, candidate["inputs"])
                fmu.setupExperiment(startTime=0.0)
                fmu.enterInitializationMode()
                fmu.exitInitializationMode()
            except FMICallException:
                return 0.0, 0, f"refused: {instance.complaints()[:200]}"
            worst, most, t = 0.0, 0, 0.0
            read = instance.reader(["solver.cpu_time", "solver.steps"])
            for k, h in enumerate(candidate["steps"]):
                before, ended = read().copy(), ""
                try:
                    self.set_inputs(fmu, candidate["changes"].get(str(k), {}))
                    fmu.doStep(currentCommunicationPoint=t, communicationStepSize=h)
                except FMICallException:
                    ended = instance.complaints()[-250:]
                spent = read() - before
                if np.isfinite(spent).all() and spent[0] > worst:
                    worst, most = float(spent[0]), int(spent[1])
                if ended:
                    return worst, most, ended
                t += h
            return worst, most, "ran"

    def set_inputs(self, fmu, values):
        fmu.setReal([self.inputs[name].valueReference for name in values], list(values.values()))


def search(search, seconds, out):
    best, stopped, end, count, report = [], [], time.monotonic() + seconds, 0, time.monotonic()
    while time.monotonic() < end:
        good = best and search.random.random() < 0.5
        candidate = search.mutant(best[search.random.integers(len(best))][3]) if good else search.new()
        cost, steps, ended = search.cost(candidate)
        count += 1
        if any(candidate == row[3] for row in best):
            continue
        rows = best if ended == "ran" else stopped
        if len(rows) < KEPT or cost > rows[-1][0]:
            rows.append((cost, steps, ended, candidate))
            rows.sort(key=lambda row: -row[0])
            del rows[KEPT:]
            write(out, best + stopped, count)
        if time.monotonic() > report + 60.0:
            report = time.monotonic()
            for text, rows in (("costliest", best), ("costliest that the FMU stopped", stopped)):
                print(f"{count} candidates, {text} {', '.join(f'{row[0]:.3f}' for row in rows[:6])} s", flush=True)
    return best + stopped, count


def write(out, best, count):
    rows = [dict(zip(("seconds", "internal_steps", "ended", "candidate"), row, strict=True)) for row in best]
    Path(out).write_text(json.dumps({"candidates": count, "costliest": rows}, indent=1))


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--seconds", type=float, default=3600.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--fmu")
    parser.add_argument("--out", default="costliest.json")
    parser.add_argument("--again", metavar="FILE", help="run the candidates of a file again")
    arguments = parser.parse_args()
    one = Search(Model(arguments.fmu), np.random.default_rng(arguments.seed))
    if arguments.again:
        rows = json.loads(Path(arguments.again).read_text())["costliest"]
        best, count = [(*one.cost(row["candidate"]), row["candidate"]) for row in rows], len(rows)
    else:
        best, count = search(one, arguments.seconds, arguments.out)
    best = sorted(best, key=lambda row: (row[2] != "ran", -row[0]))
    for cost, steps, ended, candidate in best[:10]:
        print(f"{cost:.4f} s, {steps} steps, {ended}: {json.dumps({k: v for k, v in candidate.items() if v})}")
    print(f"{count} candidates, bound {BOUND} s")
    return int(max(row[0] for row in best) > BOUND)


if __name__ == "__main__":
    sys.exit(main())
