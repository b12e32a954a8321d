"""Whether the error budget's intervals hold the truth, in scenes that nobody tuned on.

    python benchmarks/coverage.py SEED ... N [--bearing FMU ...] [--accuracy 0.02] [--only reference]

N scenes of each SEED, drawn by blind.py.  Each runs as `run --check` does, with the default and finer steps of running/accuracy.py, and with
MANY other seeds by a reference: equal steps of 3 us, and where they fail the error test that of blind.py, a tenth of the default
tolerance in communication steps of 3 us.
The interval should hold the reference's mean, whose own scatter is added to it, in 85 to 97 % of the scenes.  Then
`accurate` runs the scene to the accuracy that is asked for; its figure and cost stand beside.  Records stay in
build/coverage/, so that a study that was stopped goes on.
"""

import argparse
import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
from blind import REFERENCE, draw, in_words, model_of
from common import BUILD, FMU, say, write
from scipy import stats

from riveted_bearing import UserError
from riveted_bearing.running import accuracy
from riveted_bearing.running.budget import CHECKS
from riveted_bearing.running.scene import load_scene
from riveted_bearing.running.seeds import seeded

SETTLE, SPAN, LONGEST, STEP = 0.05, 0.08, 0.12, 1e-4  # [s], as in blind.py, but shorter
MANY, EQUAL = 8, {"solver.method": "fixed", "solver.step": 3e-6}  # seeds of the reference, and its steps
APART = 100  # first seeds of the scenes: the same ones would miss together, as slow motions depend on the balls' spacing alone
FIGURES = ("stress", "static", "pocket_force", "damage")
MOST_STEPS = 1000  # of a communication step: jammed ribbons, of which a run takes minutes, count as failed
WITHIN = 20.0  # s that an accuracy may take in a scene
STILL = 1.5 * accuracy.RESOLUTION  # half-width of a figure that hardly moves
FEWEST = [[2, 1]]  # runs and finer runs of an accuracy for which a plain run suffices


def times(omega):
    """Settling time and span [s]: a turn of the cage each, within SETTLE or SPAN and LONGEST."""
    turn = math.ceil(2.0 * math.pi / (0.4 * abs(omega)) / STEP) * STEP
    return tuple(min(max(least, turn), LONGEST) for least in (SETTLE, SPAN))


def scene_of(fmu, drawn):
    """The checked scene of parameters and inputs that were drawn."""
    parameters, inputs = drawn
    settle, span = times(inputs["shaft.omega"])
    changes = {
        "simulation": {"t_end": settle + span, "step": STEP, "outputs": list(accuracy.CHANNELS)},
        "parameters": parameters | {"start.settle": settle, "scene.stress": "fatigue", "solver.max_steps": MOST_STEPS},
        "inputs": inputs,
    }
    return load_scene(None, model_of(fmu), ("a blind scene", changes))


def drawn(number, options):
    """Model, name and scene of a number; its words."""
    fmu = options.bearing[number % len(options.bearing)]
    model = model_of(fmu)
    values = draw(options.seed, number, model, "any")
    scene = scene_of(fmu, values)
    first = {"start.seed": APART * (number + 1)}
    return (
        model,
        replace(scene, parameters=scene.parameters | first),
        {"bearing": Path(fmu).stem, "words": in_words(*values)},
    )


def reference(number, options):
    """The reference's figures in one scene, with seeds of its own."""
    model, scene, told = drawn(number, options)
    first = int(scene.parameters["start.seed"]) + APART // 2

    def runs(changed):
        return (accuracy.sample(model, seeded(changed, model, first, s)) for s in range(MANY))

    found = runs(accuracy.with_settings(scene, EQUAL))
    if (begun := next(found)).failed > accuracy.FEW:
        tolerance, parts = REFERENCE
        parameters = scene.parameters | {"solver.max_steps": MOST_STEPS // parts}
        short = {"step": STEP / parts, "output_interval": STEP, "tolerance": tolerance}
        found = runs(replace(scene, parameters=parameters, **short))
        return told | {"reference": [run.values for run in found]}
    return told | {"reference": [run.values for run in (begun, *found)]}


def checked(number, options):
    """What `run --check` simulates in one scene."""
    model, scene, _ = drawn(number, options)
    runs = accuracy.Runs(model, scene, lambda runs: None)
    plain, finer = CHECKS
    levels = {"default": runs(0, plain), "finer": runs(1, finer)}
    return {
        name: [
            run.values | {f"block_{n}": v for n, v in run.blocks.items()} | {"cost": run.cost, "steps": run.steps}
            for run in found
        ]
        for name, found in levels.items()
    }


def to_accuracy(number, options):
    """What an accuracy gives in one scene."""
    model, scene, _ = drawn(number, options)
    reached = accuracy.accurate(model, scene, options.accuracy, WITHIN)
    values = {name: found.value for name, found in reached.found.items()}
    runs = [found.runs for found in reached.found.values()][:1]
    return {
        "cost": reached.cost,
        "refined": bool(reached.settings),
        "missed": reached.missed,
        "runs": runs,
        "values": values,
    }


def kept(options, kind, make):
    """Records of all scenes of options.seed in their order; those in the folder are not made again."""
    folder = BUILD / "coverage"
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{options.seed}-{kind}.jsonl"
    rows = {row["scene"]: row for row in map(json.loads, path.read_text().splitlines())} if path.exists() else {}
    with path.open("a") as file:
        for number in range(options.count):
            if number not in rows:
                try:
                    rows[number] = {"scene": number} | make(number, options)
                except (ArithmeticError, UserError) as problem:
                    rows[number] = {"scene": number, "failed": str(problem)[:300]}
                file.write(json.dumps(rows[number]) + "\n")
                file.flush()
                say(f"{options.seed} {kind} {number}: {rows[number].get('failed', 'done')}")
    return [rows[number] for number in range(options.count)]


# -------------------------------------------------------------------------------------------------------------- figures


def judged(row, reached, target):
    """What a scene says of each figure: intervals against the reference, and the accuracy's value."""
    told = {}
    for name in FIGURES:
        if any(name not in run for kind in ("default", "finer", "reference") for run in row[kind]):
            continue  # without damage
        ours, finer, truths = (np.array([run[name] for run in row[kind]]) for kind in ("default", "finer", "reference"))
        blocks = [run[f"block_{name}"] for run in row["default"] if f"block_{name}" in run]
        found = accuracy.found_of(name, ours, finer, blocks)
        truth, error = float(truths.mean()), float(truths.std(ddof=1)) / math.sqrt(len(truths))
        alone = stats.t.ppf(0.95, len(ours) - 1) * ours.std(ddof=1) / math.sqrt(len(ours))
        distance, of_reference = abs(found.value - truth), stats.norm.ppf(0.95) * error
        told[name] = {
            "reference": truth,
            "error": error,
            "plain": found.plain,
            "value": found.value,
            "half": found.half,
            "still": int(found.half <= STILL * (1.0 if name == accuracy.DECADES else abs(found.value))),
            "one_motion": int(found.one_motion),
            "held": int(distance <= math.hypot(found.half, of_reference)),
            "held_by_seeds_alone": int(abs(found.plain - truth) <= math.hypot(alone, of_reference)),
        }
        if name in reached.get("values", {}) and name not in reached["missed"]:
            off = abs(reached["values"][name] - truth)
            told[name] |= {"reached": reached["values"][name], "met": int(off <= target * abs(truth) + of_reference)}
    return told


def summary(rows):
    """Shares of scenes by figure, and the costs of an accuracy over a plain run: of all, and where the first runs suffice."""
    fine = [row for row in rows if "failed" not in row]
    costs = [row["cost"] for row in fine if "cost" in row]
    enough = [row["cost"] for row in fine if row.get("runs") == FEWEST and not row["missed"] and not row["refined"]]
    found = {
        "scenes": len(rows),
        "failed": len(rows) - len(fine),
        "refused": sum("refused" in row for row in fine),
        "cost": {f"q{q}": float(np.quantile(costs, 0.01 * q)) for q in (10, 25, 50, 75, 90, 100)} if costs else {},
        "suffices": len(enough),
        "cost_where_it_suffices": {f"q{q}": float(np.quantile(enough, 0.01 * q)) for q in (10, 50, 90, 100)}
        if enough
        else {},
        "figures": {},
    }
    for name in FIGURES:
        told = [row["figures"][name] for row in fine if name in row["figures"]]
        met = [each["met"] for each in told if "met" in each]
        found["figures"][name] = {
            "scenes": len(told),
            "held": float(np.mean([each["held"] for each in told])),
            "held_by_seeds_alone": float(np.mean([each["held_by_seeds_alone"] for each in told])),
            "one_motion": sum(each["one_motion"] for each in told),
            "still": sum(each["still"] for each in told),
            "held_of_moving": float(np.mean([each["held"] for each in told if not each["still"]] or [1.0])),
            "accuracies": len(met),
            "met": float(np.mean(met)) if met else 0.0,
        }
    return found


def say_summary(found):
    """The shares in lines."""
    say(
        f"{found['scenes']} scenes, {found['failed']} failed; accuracy refused in {found['refused']}; cost over a plain run {found['cost']}, "
        f"where the first runs suffice ({found['suffices']}) {found['cost_where_it_suffices']}"
    )
    for name, row in found["figures"].items():
        moving = row["scenes"] - row["still"]
        say(
            f"{name}: {100 * row['held']:.0f} % of {row['scenes']} held, {100 * row['held_of_moving']:.0f} % of the {moving} that move, "
            f"by seeds alone {100 * row['held_by_seeds_alone']:.0f} %, one motion in {row['one_motion']}; "
            f"accuracy met in {100 * row['met']:.0f} % of {row['accuracies']}"
        )


def row_of(options, told, runs, reached):
    """A scene's line in the record."""
    bare = {"seed": options.seed} | {key: told[key] for key in ("scene", "bearing", "words") if key in told}
    if failed := told.get("failed") or runs.get("failed"):
        return bare | {"failed": failed}
    reached = {"refused" if key == "failed" else key: value for key, value in reached.items()}
    kept_keys = {key: reached[key] for key in ("cost", "runs", "refined", "missed", "refused") if key in reached}
    return bare | kept_keys | {"figures": judged(told | runs, reached, options.accuracy)}


def main():
    kinds = {"reference": reference, "check": checked, "accuracy": to_accuracy}
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("seed", type=int, nargs="+", help="of the scenes; a record needs such that were never run")
    parser.add_argument("count", type=int, help="scenes of each seed")
    parser.add_argument("--bearing", nargs="+", default=[FMU], metavar="FMU", help="FMUs that take turns")
    parser.add_argument("--accuracy", type=float, default=0.02, help="that is asked for, as a share")
    parser.add_argument("--only", choices=kinds, help="make these records alone")
    options = parser.parse_args()
    options.bearing = [str(Path(fmu).resolve()) for fmu in options.bearing]
    seeds, rows = options.seed, []
    for options.seed in seeds:
        made = {kind: kept(options, kind, make) for kind, make in kinds.items() if options.only in (None, kind)}
        if not options.only:
            rows += [row_of(options, *parts) for parts in zip(*made.values(), strict=True)]
    if options.only:
        return
    found = summary(rows)
    say_summary(found)
    settings = {"scene_seeds": " ".join(map(str, seeds)), "seeds": CHECKS[0], "finer": CHECKS[1], "many": MANY}
    write("coverage", settings | {"target": options.accuracy} | found | {"rows": rows}, False)


if __name__ == "__main__":
    main()
