"""Whether the error budget's intervals hold the truth, in scenes that nobody tuned on.

    python benchmarks/coverage.py SEED ... N [--bearing FMU ...] [--accuracy 0.02]

N scenes of each SEED, drawn by blind.py.  Each runs with SEEDS start seeds by the default and by the finer tolerance of
running/accuracy.py, from which the budget's numerical and seed parts follow, and with MANY other seeds at REFERENCE,
twice as long.
The interval should hold the reference's mean, whose own scatter is added to it, in 85 to 97 % of the scenes.  Then
`accurate` runs the scene to the accuracy that is asked for; its figure and cost stand beside.  A scene's runs stay in
build/coverage/, so that a study that was stopped goes on.
"""

import argparse
import json
import math
from dataclasses import replace
from pathlib import Path

from blind import draw, in_words, model_of
from common import BUILD, FMU, say

from riveted_bearing import UserError
from riveted_bearing.running import accuracy
from riveted_bearing.running.scene import load_scene

SETTLE, SPAN, LONGEST, STEP = 0.05, 0.06, 0.12, 1e-4  # [s], as in blind.py, but shorter
SEEDS, MANY, REFERENCE = 4, 24, 1e-6
FIRST = 101  # seed of the reference
FIGURES = ("stress", "static", "damage")


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
        finer = [accuracy.sample(model, scene, s + 1, accuracy.finer(model, scene)) for s in range(SEEDS)]
        long = replace(scene, t_end=2.0 * scene.t_end - scene.parameters["start.settle"])
        reference = [accuracy.sample(model, long, FIRST + s, REFERENCE) for s in range(MANY)]
    except (ArithmeticError, UserError) as problem:
        return row | {"failed": str(problem)[:200]}
    for name, runs in (("default", ours), ("finer", finer), ("reference", reference)):
        row[name] = [run.values | {f"block_{n}": v for n, v in run.blocks.items()} | {"cost": run.cost} for run in runs]
    return row


def run_all(options, folder):
    """Records of all scenes of options.seed in their order; those in the folder are not run again."""
    folder.mkdir(parents=True, exist_ok=True)
    kept = folder / f"{options.seed}.jsonl"
    rows = {row["scene"]: row for row in map(json.loads, kept.read_text().splitlines())} if kept.exists() else {}
    with kept.open("a") as file:
        for number in range(options.count):
            if number not in rows:
                rows[number] = compare(number, options)
                file.write(json.dumps(rows[number]) + "\n")
                file.flush()
                say(f"{options.seed} {number}: {rows[number].get('failed', 'done')}")
    return [rows[number] for number in range(options.count)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("seed", type=int, nargs="+", help="of the scenes; a record needs such that were never run")
    parser.add_argument("count", type=int, help="scenes of each seed")
    parser.add_argument("--bearing", nargs="+", default=[FMU], metavar="FMU", help="FMUs that take turns")
    options = parser.parse_args()
    options.bearing = [str(Path(fmu).resolve()) for fmu in options.bearing]
    seeds, rows = options.seed, []
    for options.seed in seeds:
        rows += [{"seed": options.seed} | row for row in run_all(options, BUILD / "coverage")]


if __name__ == "__main__":
    main()
