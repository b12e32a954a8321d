"""Whether the error budget's intervals hold the truth, in scenes that nobody tuned on.

    python benchmarks/coverage.py SEED ... N [--bearing FMU ...] [--accuracy 0.02]

N scenes of each SEED, drawn by blind.py.  Each runs with SEEDS start seeds by the default and by the finer tolerance of
running/accuracy.py, from which the budget's numerical and seed parts follow, and with MANY other seeds at REFERENCE.
The interval should hold the reference's mean, whose own scatter is added to it, in 85 to 97 % of the scenes.  Then
`accurate` runs the scene to the accuracy that is asked for; its figure and cost stand beside.  A scene's runs stay in
build/coverage/, so that a study that was stopped goes on.
"""

import argparse
import json
import math
from pathlib import Path

import numpy as np
from blind import draw, in_words, model_of
from common import BUILD, FMU, say, write
from scipy import stats

from riveted_bearing import UserError
from riveted_bearing.running import accuracy
from riveted_bearing.running.scene import load_scene

SETTLE, SPAN, LONGEST, STEP = 0.05, 0.08, 0.12, 1e-4  # [s], as in blind.py, but shorter
SEEDS, MANY, REFERENCE = 4, 24, 1e-6
FIRST = 101  # seed of the reference
FIGURES = ("stress", "static", "pocket_force", "damage")
WITHIN = 20.0  # s that an accuracy may take in a scene


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
        "parameters": parameters | {"start.settle": settle, "scene.stress": "fatigue"},
        "inputs": inputs,
    }
    return load_scene(None, model_of(fmu), ("a blind scene", changes))


def compare(number, options):
    """Record of one scene."""
    fmu = options.bearing[number % len(options.bearing)]
    model = model_of(fmu)
    drawn = draw(options.seed, number, model, "any")
    row = {"scene": number, "bearing": Path(fmu).stem, "words": in_words(*drawn)}
    try:
        scene = scene_of(fmu, drawn)
        ours = [accuracy.sample(model, scene, s + 1) for s in range(SEEDS)]
        row["tolerance"] = accuracy.finer_tolerance(model, scene)
        finer = [accuracy.sample(model, scene, s + 1, row["tolerance"]) for s in range(SEEDS)]
        reference = [accuracy.sample(model, scene, FIRST + s, REFERENCE) for s in range(MANY)]
    except (ArithmeticError, UserError) as problem:
        return row | {"failed": str(problem)[:200]}
    for name, runs in (("default", ours), ("finer", finer), ("reference", reference)):
        row[name] = [run.values | {f"block_{n}": v for n, v in run.blocks.items()} | {"cost": run.cost} for run in runs]
    return row


def to_accuracy(number, options):
    """Record of what an accuracy gives in one scene."""
    fmu = options.bearing[number % len(options.bearing)]
    model = model_of(fmu)
    row = {"scene": number}
    try:
        reached = accuracy.accurate(
            model, scene_of(fmu, draw(options.seed, number, model, "any")), options.accuracy, WITHIN
        )
    except (ArithmeticError, UserError) as problem:
        return row | {"refused": str(problem)[:300]}
    values = {name: found.value for name, found in reached.found.items()}
    return row | {"cost": reached.cost, "tolerance": reached.tolerance, "missed": reached.missed, "values": values}


def kept(options, kind, make):
    """Records of all scenes of options.seed in their order; those in the folder are not made again."""
    folder = BUILD / "coverage"
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{options.seed}{kind}.jsonl"
    rows = {row["scene"]: row for row in map(json.loads, path.read_text().splitlines())} if path.exists() else {}
    with path.open("a") as file:
        for number in range(options.count):
            if number not in rows:
                rows[number] = make(number, options)
                file.write(json.dumps(rows[number]) + "\n")
                file.flush()
                say(f"{options.seed}{kind} {number}: {rows[number].get('failed', 'done')}")
    return [rows[number] for number in range(options.count)]


# -------------------------------------------------------------------------------------------------------------- figures


def judged(row, reached, target):
    """What a scene says of each figure: intervals against the reference, and the accuracy's value."""
    told = {}
    for name in FIGURES:
        if any(name not in run for kind in ("default", "finer", "reference") for run in row[kind]):
            continue  # without damage
        ours, finer, reference = (
            np.array([run[name] for run in row[kind]]) for kind in ("default", "finer", "reference")
        )
        blocks = [run[f"block_{name}"] for run in row["default"] if f"block_{name}" in run]
        found = accuracy.found_of(name, ours, finer, blocks)
        truth, error = float(reference.mean()), float(reference.std(ddof=1)) / math.sqrt(len(reference))
        alone = stats.t.ppf(0.95, len(ours) - 1) * ours.std(ddof=1) / math.sqrt(len(ours))
        distance, of_reference = abs(found.value - truth), stats.norm.ppf(0.95) * error
        told[name] = {
            "reference": truth,
            "error": error,
            "plain": found.plain,
            "value": found.value,
            "half": found.half,
            "one_motion": int(found.one_motion),
            "held": int(distance <= math.hypot(found.half, of_reference)),
            "held_by_seeds_alone": int(abs(found.plain - truth) <= math.hypot(alone, of_reference)),
        }
        if name in reached.get("values", {}) and name not in reached["missed"]:
            off = abs(reached["values"][name] - truth)
            told[name] |= {"reached": reached["values"][name], "met": int(off <= target * abs(truth) + of_reference)}
    return told


def summary(rows):
    """Shares of scenes by figure, and the costs of an accuracy over a plain run."""
    fine = [row for row in rows if "failed" not in row]
    costs = [row["cost"] for row in fine if "cost" in row]
    found = {
        "scenes": len(rows),
        "failed": len(rows) - len(fine),
        "refused": sum("refused" in row for row in fine),
        "cost": {f"q{q}": float(np.quantile(costs, 0.01 * q)) for q in (10, 25, 50, 75, 90, 100)} if costs else {},
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
            "accuracies": len(met),
            "met": float(np.mean(met)) if met else 0.0,
        }
    return found


def say_summary(found):
    """The shares in lines."""
    say(
        f"{found['scenes']} scenes, {found['failed']} failed; accuracy refused in {found['refused']}; cost over a plain run {found['cost']}"
    )
    for name, row in found["figures"].items():
        say(
            f"{name}: {100 * row['held']:.0f} % of {row['scenes']} held, by seeds alone {100 * row['held_by_seeds_alone']:.0f} %, "
            f"one motion in {row['one_motion']}; accuracy met in {100 * row['met']:.0f} % of {row['accuracies']}"
        )


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("seed", type=int, nargs="+", help="of the scenes; a record needs such that were never run")
    parser.add_argument("count", type=int, help="scenes of each seed")
    parser.add_argument("--bearing", nargs="+", default=[FMU], metavar="FMU", help="FMUs that take turns")
    parser.add_argument("--accuracy", type=float, default=0.02, help="that is asked for, as a share")
    options = parser.parse_args()
    options.bearing = [str(Path(fmu).resolve()) for fmu in options.bearing]
    seeds, rows = options.seed, []
    for options.seed in seeds:
        pairs = zip(kept(options, "", compare), kept(options, "-accuracy", to_accuracy), strict=True)
        for row, reached in pairs:
            told = {} if "failed" in row else {"figures": judged(row, reached, options.accuracy)}
            bare = {key: row[key] for key in ("scene", "bearing", "words", "failed", "tolerance") if key in row}
            rows.append(
                {"seed": options.seed} | bare | {k: v for k, v in reached.items() if k in ("cost", "refused")} | told
            )
    found = summary(rows)
    say_summary(found)
    settings = {
        "scene_seeds": " ".join(map(str, seeds)),
        "seeds": SEEDS,
        "many": MANY,
        "reference_tolerance": REFERENCE,
    }
    write("coverage", settings | {"target": options.accuracy} | found | {"rows": rows}, False)


if __name__ == "__main__":
    main()
