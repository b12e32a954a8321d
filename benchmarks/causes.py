"""Blind recovery of causes: synthetic failures whose cause a seed hides, and what `riveted-bearing causes` says of them.

    python benchmarks/causes.py FOLDER 6207=fmus/RivetedBearing.fmu 6310=6310.fmu ...

Each bearing has one pool of designs, seed 1, that all its failures share.  A hidden failure is a run of its own, of
designs from another seed, in which all rivets break one after another.  Its cause is drawn evenly, its life is multiplied
by a strength of the lot; what does not break within 1e5 h is nobody's failure and is drawn again.  So the shares of the
causes among the failures are those of causes that are present evenly, as the posterior supposes.

The findings are incomplete as in practice, the shares were set before the first result.  Then a laboratory does three
inspections, one after the other, each the one that the answer before it advises.
"""

import itertools
import json
import sys
import tomllib
from pathlib import Path

import numpy as np
from common import ROOT, write
from scipy.stats import beta

from riveted_bearing.base.files import write_atomically
from riveted_bearing.identify.causes_page import bars, cage
from riveted_bearing.identify.findings import plan_causes
from riveted_bearing.identify.pool import mission_scene, run_pool
from riveted_bearing.identify.posterior import RESPONSES, answer, heavy, predictions, sound_medians
from riveted_bearing.running.fmu import Model
from riveted_bearing.show.style import HEAD, MIDDLE, MUTED, STYLE, plt
from riveted_bearing.studies.sweep import cluster

KNOWN = {"place": 0.9, "order": 0.2, "hours": 0.35, "about hours": 0.35, "mark": 0.6, "inspection": 0.35, "loose": 0.7}
CAUSES = [
    "clearance",
    "interference",
    "preload lost",
    "misalignment",
    "impacts",
    "overspeed",
    "malformed rivet",
    "ball sizes",
]
MISSIONS = {  # inputs: about as fast as the sound bearing bears
    "6207": {},
    "6310": {"shaft.omega": "7600 rev/min", "shaft.F_y": "6 kN", "shaft.F_x": "1 kN"},
    "6004": {"shaft.omega": "30000 rev/min", "shaft.F_y": "1.1 kN", "shaft.F_x": "190 N"},
    "6212": {"shaft.omega": "13500 rev/min", "shaft.F_y": "6 kN", "shaft.F_x": "1 kN"},
}
HIDDEN, EACH, FAILURES = 4711, 10, 40  # seed of the hidden designs, designs of each cause, failures in all
MANY = 200  # failures of the reliability diagram
ADVISED = 3  # inspections that follow, each the one that the answer before it advises


def pools(name, path, folder, client, causes=CAUSES, samples=32):
    """(study, document, model, scene, pool, hidden) of a bearing: Predicted of all designs, Samples of the hidden with theirs."""
    model = Model(path)
    document = {"inputs": MISSIONS[name], "causes": list(causes), "samples": samples}
    file = Path(f"{name}.toml")
    scene = mission_scene(file, document, model)
    study = plan_causes(file, document, model, scene)
    pool = run_pool(study, model, document, folder / name, client)
    long = document | {"breaks": study.Z, "prior": {}}
    hidden = run_pool(
        plan_causes(file, long, model, scene), model, long, folder / f"{name}_hidden", client, count=EACH, seed=HIDDEN
    )
    return (
        study,
        document,
        model,
        scene,
        predictions(pool, study, model, scene),
        [*zip(hidden, predictions(hidden, study, model, scene), strict=True)],
    )


def failure(rng, study, model, scene, hidden, sound, known=KNOWN):
    """(cause, findings as a document, Hidden) of a failure; None if nothing breaks within the hours."""
    names = [cause.name for cause in study.causes]
    cause = int(rng.integers(1, len(names)))  # the first one is the sound bearing
    of_cause = [pair for pair in hidden if pair[0].cause == cause]
    sample, one = of_cause[int(rng.integers(len(of_cause)))]
    breaks = [state for state in sample.history["states"] if state["hours"] is not None]
    hours = one.hours + study.file.life_decades * rng.standard_normal()
    n = int(rng.integers(1, study.Z + 1))
    n = min(n, len(breaks))
    if not n or hours[n - 1] > np.log10(study.file.within):
        return None
    shift = int(rng.integers(study.Z))
    turned = [(state["rivet"] - 1 + shift) % study.Z + 1 for state in breaks[:n]]
    broken = {"head": [], "middle": [], "unknown": []}
    for rivet, state in zip(turned, breaks, strict=False):
        place = ("head", "middle")[state["place"]] if rng.random() < known["place"] else "unknown"
        broken[place].append(rivet)
    if rng.random() < known["order"]:
        broken["order"] = turned
    found = {"broken": broken}
    dice, time = rng.random(), hours[n - 1]
    if dice < known["hours"]:
        found["hours"] = f"{10.0**time:.6g} h"
    elif dice < known["hours"] + known["about hours"]:
        found["hours"] = f"about {10.0 ** (time + np.log10(2.0) * rng.standard_normal()):.6g} h"
    if "hours" in found and float(found["hours"].split()[-2]) > study.file.within:
        del found["hours"]
    if rng.random() < known["loose"]:
        standing = [k for k in range(1, study.Z + 1) if k not in turned]
        found["loose"] = [k for k in standing if rng.random() < one.loose]
    hidden_values = Hidden(rng, study, one, sound)
    found |= {"marks": {}, "measured": {}}
    for name in [*(f"mark: {name}" for name in RESPONSES), *study.quantities]:
        if rng.random() < known["mark" if name.startswith("mark: ") else "inspection"]:
            hidden_values.inspect(name, found)
    return names[cause], found, hidden_values


class Hidden:
    """What an inspection finds on the hidden failure."""

    def __init__(self, rng, study, one, sound):
        self.rng, self.study, self.one, self.sound = rng, study, one, sound

    def inspect(self, name, found):
        """Add a mark or a measured value to the findings."""
        if name.startswith("mark: "):
            mark = name.removeprefix("mark: ")
            p = heavy(self.one.responses[mark], self.sound[mark])
            found["marks"][mark] = "heavy" if self.rng.random() < p else "none"
        else:
            value = self.one.values[name]
            found["measured"][name] = value + float(self.study.quantities[name].sd(value)) * self.rng.standard_normal()


def recovery(bearings, count, seed=1, known=KNOWN, advised=ADVISED):
    """Rows of so many failures, dealt over the bearings: cause, what was said of the findings, and what after the
    inspections that the answer before each advised.
    """
    rows = []
    for attempt in itertools.count():
        if len(rows) == count:
            return rows
        rng = np.random.default_rng([HIDDEN, seed, attempt])  # the same failures, whatever is inspected
        name, (study, document, model, scene, pool, hidden) = list(bearings.items())[len(rows) % len(bearings)]
        one = failure(rng, study, model, scene, hidden, sound_medians(study, pool), known)
        if one is None:
            continue
        cause, found, values = one
        row = {"bearing": name, "cause": cause, "findings": json.dumps(found)}
        for step in range(advised + 1):
            said = answer(plan_causes(study.path, document | found, model, scene), pool)
            row |= said_of(said, cause, f"{step} ")
            if step < advised and said.inspections:
                values.inspect(said.inspections[0][0], found)
        rows.append(row)


def said_of(said, cause, when):
    """What an answer says, and whether it is right."""
    first, truth = said.ranked[0], said.names.index(cause)
    return {
        f"{when}said": said.names[first],
        f"{when}stated": float(said.posterior[first]),
        f"{when}right": said.names[first] == cause,
        f"{when}of the cause": float(said.posterior[truth]),
        f"{when}in the 90 % set": truth in said.credible,
        f"{when}size of the set": len(said.credible),
        f"{when}decided": said.decided,
    }


def reliability(rows, when, edges=(0.0, 0.4, 0.6, 0.8, 1.0)):
    """(lowest, highest stated probability, failures, mean stated, share that was right) of the first cause."""
    stated = np.array([row[f"{when}stated"] for row in rows])
    right = np.array([row[f"{when}right"] for row in rows])
    found = []
    for low, high in itertools.pairwise(edges):
        inside = (stated > low) & (stated <= high)
        if inside.any():
            found.append((low, high, int(inside.sum()), float(stated[inside].mean()), float(right[inside].mean())))
    return found


def summary(rows):
    """What came out, in lines: for each number of inspections that followed, then by the stated probability."""
    lines = []
    for step in range(ADVISED + 1):
        mean = {
            key: np.mean([row[f"{step} {key}"] for row in rows])
            for key in ("right", "in the 90 % set", "size of the set", "stated", "decided")
        }
        wrong = sum(row[f"{step} decided"] and not row[f"{step} right"] for row in rows)
        lines.append(
            f"{step} inspections: of {len(rows)} the cause is first in {mean['right']:.0%}, stated {mean['stated']:.0%}, "
            f"in the 90 % set {mean['in the 90 % set']:.0%}, causes in it {mean['size of the set']:.1f}, "
            f"decided {mean['decided']:.0%}, of these wrong {wrong}"
        )
        lines += [
            f"  stated {low:.1f} to {high:.1f}: {n} failures, mean {s:.2f}, right {r:.2f}"
            for low, high, n, s, r in reliability(rows, f"{step} ")
        ]
    return "\n".join(lines)


def pictures(rows, folder, shown):
    """A page's rivets above its causes, shown(figure, figure), and the reliability diagram, as PNG."""
    with plt.rc_context(STYLE):
        figure = plt.figure(figsize=(4.5, 8.8), layout="constrained")
        shown(*figure.subfigures(2, 1))
        save(figure, folder / "failure.png")
        figure, ax = plt.subplots(figsize=(4.5, 4.4), layout="constrained")
        ax.plot([0, 100], [0, 100], color=MUTED, lw=0.8)
        for step, colour in ((0, HEAD), (ADVISED, MIDDLE)):
            found = reliability(rows, f"{step} ")
            n, stated, share = (np.array(each, float) for each in list(zip(*found, strict=True))[2:])
            ends = 100.0 * np.array(beta.ppf([[0.16], [0.84]], share * n + 0.5, n - share * n + 0.5))
            label = f"{step} inspections followed"
            ax.vlines(100.0 * stated, *ends, color=colour, lw=1.0)
            ax.plot(100.0 * stated, 100.0 * share, "o", color=colour, label=label)
        ax.set(
            xlabel="stated probability of the first cause, %",
            ylabel="share that was right, %",
            title=f"{len(rows)} hidden failures",
        )
        ax.legend()
        save(figure, folder / "reliability.png")


def save(figure, path):
    write_atomically(path, lambda temporary: figure.savefig(temporary, dpi=100))
    plt.close(figure)


def example(path, folder, client):
    """Panels of the findings in docs/failure.md on the 6207, against all causes."""
    file = ROOT / "docs" / "failure.md"
    document = tomllib.loads(file.read_text(encoding="utf-8").split("```toml")[1].split("```")[0])
    model = Model(path)
    scene = mission_scene(file, document, model)
    study = plan_causes(file, document, model, scene)
    said = answer(study, predictions(run_pool(study, model, document, folder, client), study, model, scene))

    def shown(left, right):
        cage(left, study)
        bars(right, said)

    return shown


def main():
    folder, paths = Path(sys.argv[1]), dict(argument.split("=") for argument in sys.argv[2:])
    with cluster(None, 1) as client:
        bearings = {name: pools(name, path, folder, lambda: client) for name, path in paths.items()}
        shown = example(paths["6207"], folder / "6207", lambda: client)
    rows, many = recovery(bearings, FAILURES), recovery(bearings, MANY, seed=2)
    write("causes", {"known": KNOWN, "failures": rows}, False)
    pictures(many, folder, shown)
    print(summary(rows), summary(many), sep="\n")


if __name__ == "__main__":
    main()
