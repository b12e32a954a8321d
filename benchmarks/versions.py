"""What a user of one FMU finds changed in another: variables, bits of the trajectories, statistics; and which number of
the version must rise (VERSIONING.md).

    python benchmarks/versions.py OLD.fmu NEW.fmu

The shipped scenes run through both FMUs.  Bits are those of all outputs that both have, at the communication points of
the first 50 ms; statistics are the means over seeds, their differences with half-widths at 95 %.
"""

import argparse
import hashlib
import sys
from pathlib import Path

import numpy as np
from scipy import stats

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from fmpy import read_model_description  # noqa: E402

from riveted_bearing import run  # noqa: E402

SCENES = ("demo", "R", "F", "jam")
FIGURES = [
    f"stat.{channel}_{figure}" for channel in ("Q_c", "sigma_head", "sigma_mid") for figure in ("mean", "rms", "p999")
]
MACHINE = ("solver.cpu_time",)  # measures the machine
SPAN = 0.05  # s, of the bits
BOUND = 0.01  # by which a statistic may move in a minor release
SEEDS = 48  # one seed of demo scatters by 1.1 %: the difference of two means of 48 is known to 0.5 %
# of every variable; its limits may only widen
PROMISED = ("valueReference", "causality", "variability", "type", "unit", "start")
PATCH, MINOR, MAJOR = range(3)
NUMBERS = ("patch", "minor", "major")


def variables(path):
    """The variables of an FMU by name."""
    return {v.name: v for v in read_model_description(str(path)).modelVariables}


def items(variable):
    """Items of an enumeration by number, nothing for other types."""
    declared = variable.declaredType
    return {item.value: item.name for item in declared.items} if declared is not None and declared.items else {}


def broken_promises(old, new):
    """What of the variable `old` does not hold for `new`, a list of texts."""
    broken = [
        f"{key} {getattr(old, key)} -> {getattr(new, key)}"
        for key in PROMISED
        if getattr(old, key) != getattr(new, key)
    ]
    if float(new.min or "-inf") > float(old.min or "-inf") or float(new.max or "inf") < float(old.max or "inf"):
        broken.append(f"limits {old.min} … {old.max} -> {new.min} … {new.max}")
    moved = [
        f"{number} {name} -> {items(new).get(number)}"
        for number, name in items(old).items()
        if items(new).get(number) != name
    ]
    return broken + moved


def compare_variables(old, new):
    """The number of the version that the variables ask for, and lines that say why."""
    gone = [f"{name}: gone" for name in old if name not in new]
    broken = gone + [
        f"{name}: {', '.join(faults)}"
        for name in old
        if name in new and (faults := broken_promises(old[name], new[name]))
    ]
    added = [f"{name}: new" for name in new if name not in old]
    added += [
        f"{name}: new item {item}"
        for name in new
        if name in old
        for number, item in items(new[name]).items()
        if number not in items(old[name])
    ]
    return MAJOR if broken else MINOR if added else PATCH, broken + added


def digest(path, scene, outputs, span):
    """First digits of the SHA-256 of the outputs' trajectories."""
    result = run(scene, fmu=path, t_end=span, outputs=outputs)
    return hashlib.sha256(np.column_stack([result.data[name] for name in outputs]).tobytes()).hexdigest()[:16]


def compare_bits(paths, scene, outputs, span):
    """The number that the scene's bits ask for, and a line."""
    before, after = (digest(path, scene, outputs, span) for path in paths)
    return PATCH if before == after else MINOR, f"{scene}: {before} {'==' if before == after else '!='} {after}"


def sample(path, scene, seeds, t_end):
    """FIGURES of a scene for each seed: [seeds, figures]."""
    runs = (run(scene, fmu=path, seed=seed, t_end=t_end, outputs=["cage.omega"]) for seed in range(1, seeds + 1))
    return np.array([[result.summary[name] for name in FIGURES] for result in runs])


def compare_statistics(before, after):
    """The number that the statistics [seeds, figures] before and after ask for, relative differences of their means,
    half-widths at 95 %.
    """
    mean = before.mean(axis=0)
    width = np.sqrt(before.var(axis=0, ddof=1) / len(before) + after.var(axis=0, ddof=1) / len(after)) * stats.t.ppf(
        0.975, len(before) + len(after) - 2
    )
    difference = (after.mean(axis=0) - mean) / mean
    width = width / mean
    return (
        (PATCH if np.array_equal(before, after) else MAJOR if np.any(np.abs(difference) > BOUND + width) else MINOR),
        difference,
        width,
    )


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("old", type=Path)
    parser.add_argument("new", type=Path)
    parser.add_argument("--seeds", type=int, default=SEEDS)
    parser.add_argument("--scenes", nargs="+", default=SCENES)
    parser.add_argument("--t-end", type=float, help="of the statistics [s], the scene's own unless given")
    options = parser.parse_args(arguments)
    paths = options.old, options.new
    old, new = map(variables, paths)

    number, lines = compare_variables(old, new)
    asked = [number]
    print(f"Variables: {NUMBERS[number]}", *lines, sep="\n  ")

    outputs = [name for name, v in old.items() if v.causality == "output" and name in new and name not in MACHINE]
    for scene in options.scenes:
        number, line = compare_bits(paths, scene, outputs, SPAN)
        asked.append(number)
        print(f"Bits of {len(outputs)} outputs, {line}: {NUMBERS[number]}", flush=True)

    for scene in options.scenes:
        number, difference, width = compare_statistics(
            *(sample(path, scene, options.seeds, options.t_end) for path in paths)
        )
        asked.append(number)
        print(f"Statistics of {scene}, {options.seeds} seeds: {NUMBERS[number]}", flush=True)
        for name, d, w in zip(FIGURES, difference, width):
            print(f"  {name:22} {100 * d:+6.2f} ± {100 * w:.2f} %")

    print(f"The {NUMBERS[max(asked)]} number must rise at least.")
    return max(asked)


if __name__ == "__main__":
    main()
