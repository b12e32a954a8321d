"""The paper's claims as targets, in stages: many sets of parameters on the figures that are fitted, some of them on all
figures, few with the full sweeps and fresh seeds.

    python benchmarks/paper/fit_claims.py      as fit_claims.toml says: 40 minutes of two cores for its 2,000 screens

    scene = "paper"
    [parameter]                          # as for other targets
    [claims]
    fit = ["preload", "speed"]           # pictures whose claims the search sees; those of the others are held out
    measure = "mean"                     # of the stress: mean, p99.9 or range
    screens = 2000                       # sets on the fitted figures, one seed, few points
    figures = 200                        # sets on all figures: half of them the best, half chosen by chance
    verified = 20                        # best sets with the full sweeps, seeds of their own
    seeds = 4                            # of the latter

A condition of claims.toml is a target of weight 1: met or not.  Screens judge by means, because one seed has no
interval; the verification by the intervals of its seeds, as study.py.  Chance shows what the fit is
worth: if the best half meets no more of the held-out conditions than the half by chance, the fit predicts nothing.
"""

import hashlib
import json
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from claims import MEASURES, PICTURES, figures_of, others, repeated, sweep_of
from figures import Runs, runs_of, study_sweep
from rich.markup import escape
from scipy.stats import qmc, spearmanr
from scipy.stats import t as student

from riveted_bearing.base.errors import refusal, unknown
from riveted_bearing.base.files import make_folder, write_json
from riveted_bearing.base.toml_files import leaves, read_toml, section_of
from riveted_bearing.cli.options import FMU, SCHEDULER, WORKERS
from riveted_bearing.cli.printing import print_paths
from riveted_bearing.cli.printing import table as grid
from riveted_bearing.cli.terminal import console, design_runs, guarded
from riveted_bearing.identify.fit import FRESH
from riveted_bearing.identify.study import parameters_of
from riveted_bearing.running.fmu import Model
from riveted_bearing.running.responses import displayed, titled
from riveted_bearing.show import charts
from riveted_bearing.show.pages import save_page
from riveted_bearing.show.style import HEAD, MUTED
from riveted_bearing.studies.sweep import run_sweep
from riveted_bearing.studies.sweep_file import count_of, key_of

STUDY = Path(__file__).with_name("fit_claims.toml")
KEYS = ("description", "scene", "parameter", "claims", "seed")
COUNTS = {"screens": 2000, "figures": 200, "verified": 20, "seeds": 4}
CHUNK = 16  # sets whose runs share a folder
FEW = {  # points of a screen, in the units of study.runs_of: those that the conditions name, and ends of ranges
    "preload": {"preload": (0, 10, 20, 40, 60)},
    "speed": {"speed": (4000, 8000, 12000, 16000, 20000, 24000)},
    "fit": {"fit": (-90, -20, -15, 0, 40)},
    "impact": {"seed": (1, 7)},
    "tilt": {"tilt": (-0.5, -0.4, -0.2, -0.1, 0.0)},
    "clearance": {
        "pocket": (69.231, 128.571, 150.0, 171.429, 225.0),
        "guide": (230.769, 171.429, 150.0, 128.571, 75.0),
    },
}
SHORT = {  # start.settle and end of a screen's runs [s]; impacts keep their own
    **dict.fromkeys(("preload", "fit", "tilt", "clearance"), (0.05, 0.12)),
    "speed": (0.06, 0.12),
}
COLUMNS = {  # of a scene: name and factor to the unit of study.runs_of
    "preload": ("joint.preload", 1.0),
    "speed": ("shaft.omega", 30.0 / np.pi),
    "fit": ("joint.fit", 1e6),
    "tilt": ("shaft.tilt_z", 180.0 / np.pi),
    "pocket": ("cage.pocket_clearance", 1e6),
    "guide": ("cage.guide_clearance", 1e6),
    "seed": ("start.seed", 1.0),
}
AXES = ("speed", "F_r", "F_a", "tilt", "preload", "fit", "pocket", "guide", "impact", "width")  # of runs that are alike


@dataclass(frozen=True)
class ClaimsStudy:
    """A study of the paper's claims that was checked."""

    path: Path
    description: str
    parameters: list
    scene: str
    fit: tuple
    measure: str
    settings: dict

    @property
    def names(self):
        """Of the parameters."""
        return [parameter.name for parameter in self.parameters]

    def values(self, u):
        """Values of points of the unit cube [n, d]."""
        return np.column_stack([p.value(column) for p, column in zip(self.parameters, np.atleast_2d(u).T, strict=True)])


def plan_claims(path, document, model):
    """The ClaimsStudy of a document; raises UserError naming what cannot be used."""
    for key in document:
        if key not in KEYS:
            raise unknown(path, "key", key, KEYS)
    section = section_of(path, document, "claims")
    for key in section:
        if key not in ("fit", "measure", *COUNTS):
            raise unknown(path, "key", f"claims.{key}", [f"claims.{name}" for name in ("fit", "measure", *COUNTS)])
    settings = {key: count_of(path, f"claims.{key}", section.get(key, n)) for key, n in COUNTS.items()}
    settings["seed"] = count_of(path, "seed", document.get("seed", 1))
    if not settings["screens"] >= settings["figures"] >= 4:
        raise refusal(
            path, "claims.figures", settings["figures"], f"from 4 to claims.screens = {settings['screens']} is allowed"
        )
    if settings["verified"] > settings["figures"] // 2:
        raise refusal(path, "claims.verified", settings["verified"], "at most half of claims.figures is allowed")
    if settings["seeds"] < 2:
        raise refusal(path, "claims.seeds", settings["seeds"], "from 2 on, which show scatter, is allowed")
    fit = section.get("fit", ["preload", "speed"])
    if not isinstance(fit, list) or not fit or any(name not in PICTURES for name in fit) or len(fit) == len(PICTURES):
        raise refusal(path, "claims.fit", fit, f"a list of some, not all, of {', '.join(PICTURES)} is needed")
    measure = section.get("measure", "mean")
    if measure not in MEASURES:
        raise refusal(path, "claims.measure", measure, f"allowed: {', '.join(MEASURES)}")
    parameters = parameters_of(path, section_of(path, document, "parameter"), model, [])
    for parameter in parameters:
        if parameter.name in model.inputs:
            raise refusal(
                path, "parameter", parameter.name, "an input belongs to the figures: only parameters can be found"
            )
    scene = document.get("scene", "paper")
    return ClaimsStudy(
        Path(path), str(document.get("description", "")), parameters, scene, tuple(fit), measure, settings
    )


# Conditions -----------------------------------------------------------------------------------------------------------


def conditions(pictures, seen=None):
    """(picture, title, condition) of all claims of pictures; seen: sweeps that there are, None for all."""
    found = []
    for picture in pictures:
        for title, table in PICTURES[picture].items():
            if ": " in title:
                for line in repeated(table["holds"]):
                    if seen is None or (sweep_of(picture) in seen and set(others([line])) <= set(seen)):
                        found.append((picture, title, line))
    return found


def fitted_conditions(study):
    """Those of the fitted pictures, from their own sweeps alone."""
    return conditions(study.fit, {sweep_of(picture) for picture in study.fit})


def held_out_conditions(study):
    """All others."""
    fitted = set(fitted_conditions(study))
    return [one for one in conditions(PICTURES) if one not in fitted]


def met(which, data, measure):
    """Whether each condition is met by the Runs of the sweeps."""
    return [bool(figures_of(data, picture, measure).met(line)) for picture, _, line in which]


def as_means(runs):
    """Runs of which those alike but for the seed are one, twice: their intervals are their means."""
    columns = runs.columns
    _, groups = np.unique(np.round([columns[name] for name in AXES], 6), axis=1, return_inverse=True)
    groups = groups.ravel()
    averaged = {}
    for name, values in columns.items():
        if np.issubdtype(np.asarray(values).dtype, np.number):
            averaged[name] = np.bincount(groups, weights=np.asarray(values, float)) / np.bincount(groups)
        else:
            averaged[name] = np.array([values[np.flatnonzero(groups == g)[0]] for g in range(groups.max() + 1)])
    count = groups.max() + 1
    doubled = {name: np.concatenate([values, values]) for name, values in averaged.items()}
    return Runs(doubled | {"seed": np.repeat([1.0, 2.0], count)})


# Runs -----------------------------------------------------------------------------------------------------------------


class Bench:
    """Runs of the paper's sweeps at sets of parameters."""

    def __init__(self, study, model, folder, client, progress=None):
        self.study, self.model, self.folder, self.client = study, model, Path(folder), client
        self.progress = progress
        self.bases, self.spent = {}, 0.0

    def base(self, name, seeds):
        """The Sweep of a shipped study with so many seeds."""
        if (name, seeds) not in self.bases:
            self.bases[name, seeds] = study_sweep(name, self.model, seeds, self.study.scene)
        return self.bases[name, seeds]

    def scenes(self, sweep_name, values, few, seeds, first=0):
        """The scenes of a sweep at parameter values; few: those of FEW with their short horizon."""
        base = self.base(sweep_name, seeds)
        own = factors_of(base)
        changed = {name: float(x) for name, x in zip(self.study.names, values, strict=True) if name not in own}
        for scene in base.scenes.values():
            if few and not chosen(sweep_name, scene, self.model):
                continue
            parameters = scene.parameters | changed
            if few and sweep_name in SHORT:
                settle, t_end = SHORT[sweep_name]
                scene = replace(scene, t_end=t_end)
                parameters["start.settle"] = settle
            parameters["start.seed"] = int(parameters.get("start.seed", 1)) + first
            yield replace(scene, parameters=parameters)

    def data(self, sets, sweeps, folder, few=True, seeds=1, first=0):
        """Runs of sweeps for each set of values: [{sweep: Runs}]; few runs of one seed as means."""
        fingerprint = hashlib.sha256(self.base(sweeps[0], seeds).fmu).hexdigest()
        scenes, keys = {}, {}
        for i, values in enumerate(sets):
            for name in sweeps:
                for scene in self.scenes(name, values, few, seeds, first):
                    key = key_of(scene, fingerprint)
                    scenes[key] = scene
                    keys.setdefault((i, name), []).append(key)
        whole = replace(self.base(sweeps[0], seeds), name=folder.name, scenes=scenes, grows=False)
        rows = run_sweep(whole, folder, self.client(), self.progress)
        self.spent += float(np.nansum(rows["whole_cpu_time"]))
        places = {key: k for k, key in enumerate(rows["key"])}
        found = [{} for _ in sets]
        for (i, name), own in keys.items():
            k = [places[key] for key in own]
            if any(rows["status"][k] != "done"):
                continue  # a set at which the FMU stops meets nothing of this figure
            part = {column: values[k] for column, values in rows.items()}
            part = {column: values for column, values in part.items() if not lacks(values)}
            runs = runs_of(part)
            found[i][name] = as_means(runs) if few else runs
        return found


def factors_of(sweep):
    """Names that a shipped study sets itself, which a set does not change."""
    known = [*sweep.model.parameters, *sweep.model.inputs]
    return set(sweep.factors) | {name for name, _ in leaves(sweep.document.get("parameters", {}), known)}


def lacks(values):
    """Whether a column has no value at all."""
    return values.dtype.kind == "f" and bool(np.isnan(values).all())


def chosen(sweep_name, scene, model):
    """Whether a scene is among the FEW."""
    for column, allowed in FEW[sweep_name].items():
        name, factor = COLUMNS[column]
        if name in scene.inputs:
            value = float(scene.inputs[name].value[0])
        else:
            value = float(scene.parameters.get(name, model.default((model.parameters | model.inputs)[name])))
        if not np.isclose(factor * value, allowed, rtol=1e-5, atol=1e-9).any():
            return False
    if sweep_name == "clearance":  # along the constant sum alone
        total = sum(1e6 * scene.parameters[name] for name in ("cage.pocket_clearance", "cage.guide_clearance"))
        return abs(total - 300.0) < 0.01
    return True


# Stages ---------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class FoundClaims:
    """A staged search: shares of the conditions met [sets], fitted and held out, by stage; verified: {name: ...} of the
    best sets and of the scene's own values; notes: sentences.
    """

    study: ClaimsStudy
    screens: np.ndarray  # share of the fitted conditions, by set
    best: tuple  # (fitted, held out) shares of the best half on all figures
    chance: tuple  # the same of the half by chance
    verified: list
    untuned: dict
    values: np.ndarray
    cpu: dict
    notes: list


def identify_claims(study, bench):
    """The FoundClaims of a ClaimsStudy; each finished part is kept in the folder, and a second call goes on."""
    settings, rng = study.settings, np.random.default_rng(study.settings["seed"])
    u = qmc.LatinHypercube(d=len(study.parameters), rng=rng).random(settings["screens"])
    values = study.values(u)
    fitted, held = fitted_conditions(study), held_out_conditions(study)
    sweeps = tuple(dict.fromkeys(sweep_of(picture) for picture in study.fit))
    everything = tuple(dict.fromkeys(sweep_of(picture) for picture in PICTURES))
    score, cpu_1 = staged(bench, "screen", values, sweeps, fitted)
    score = score.mean(axis=1)
    order = np.lexsort((rng.random(len(score)), -score))  # equals by chance
    half = settings["figures"] // 2
    best, rest = order[:half], order[half:]
    chance = rng.choice(rest, size=min(half, len(rest)), replace=False)
    both = np.concatenate([best, chance])
    judged, cpu_2 = staged(bench, "figures", values[both], everything, [*fitted, *held])
    shares = judged[:, : len(fitted)].mean(axis=1), judged[:, len(fitted) :].mean(axis=1)
    first = best[np.argsort(-shares[0][:half], kind="stable")][: settings["verified"]]  # by the fitted claims alone
    untuned = own_values(study, bench)
    sets = np.vstack([untuned, values[first]])
    verdicts, cpu_3 = verified(bench, sets, everything, fitted, held)
    found = FoundClaims(
        study,
        score,
        (shares[0][:half], shares[1][:half]),
        (shares[0][half:], shares[1][half:]),
        verdicts[1:],
        verdicts[0],
        values[first],
        {"screens": cpu_1, "figures": cpu_2, "verified": cpu_3},
        [],
    )
    found.notes.extend(claim_notes(found, len(fitted), len(held)))
    return found


def own_values(study, bench):
    """Values of the parameters in the scene itself."""
    base = bench.base("speed", 1)
    scene = next(iter(base.scenes.values()))
    default = lambda name: bench.model.default(bench.model.parameters[name])
    return np.array([float(scene.parameters.get(name, default(name))) for name in study.names])


def staged(bench, stage, values, sweeps, which):
    """Conditions met by sets [n, conditions], chunk by chunk, and processor time of the runs [s]; a finished chunk is a
    file.
    """
    found, spent = [], 0.0
    for start in range(0, len(values), CHUNK):
        sets = values[start : start + CHUNK]
        text = json.dumps([sets.tolist(), sweeps, [line for *_, line in which], bench.study.measure, bench.study.scene])
        text += bench.model.digest
        name = f"{start:05d}-{hashlib.sha256(text.encode()).hexdigest()[:12]}"
        file = bench.folder / stage / f"{name}.json"
        if not file.is_file():
            before = bench.spent
            data = bench.data(sets, list(sweeps), bench.folder / stage / name)
            record = {"met": [judge(which, one, bench.study.measure) for one in data], "cpu": bench.spent - before}
            make_folder(file.parent)
            write_json(file, record)
        record = json.loads(file.read_text(encoding="utf-8"))
        found += record["met"]
        spent += record["cpu"]
    return np.array(found, float), spent


def judge(which, data, measure):
    """met, where a figure without runs meets nothing."""
    found = []
    for picture, title, line in which:
        there = sweep_of(picture) in data and set(others([line])) <= set(data)
        found.append(there and met([(picture, title, line)], data, measure)[0])
    return found


def verified(bench, sets, sweeps, fitted, held):
    """Conditions met by sets with the full sweeps and fresh seeds: [{"fit": share, "held_out": share, ...}]."""
    seeds, found, before = bench.study.settings["seeds"], [], bench.spent
    for i, values in enumerate(sets):
        folder = bench.folder / "verified" / (f"set {i}" if i else "own values")
        (data,) = bench.data([values], list(sweeps), folder, few=False, seeds=seeds, first=FRESH)
        one = judge([*fitted, *held], data, bench.study.measure)
        found.append(
            {
                "values": dict(zip(bench.study.names, map(float, values), strict=True)),
                "fit": sum(one[: len(fitted)]),
                "held_out": sum(one[len(fitted) :]),
                "of": [len(fitted), len(held)],
                "met": one,
            }
        )
    return found, bench.spent - before


def difference(a, b):
    """Difference of two means with the half-width of its 95 % interval (Welch)."""
    own = [x.var(ddof=1) / len(x) if len(x) > 1 else np.inf for x in (a, b)]
    freedom = sum(own) ** 2 / max(sum(x**2 / (len(y) - 1) for x, y in zip(own, (a, b))), 1e-300)
    half = student.ppf(0.975, freedom) * np.sqrt(sum(own)) if sum(own) > 0.0 else 0.0
    return float(a.mean() - b.mean()), float(half)


def claim_notes(found, fitted, held):
    """Sentences about the search: whether a good fit meets more of the claims that it has not seen."""
    gain, half = difference(found.best[1], found.chance[1])
    both = [np.concatenate(pair) for pair in zip(found.best, found.chance)]
    yield (
        f"Of {held} held-out conditions the best sets meet {held * found.best[1].mean():.1f}, sets by chance "
        f"{held * found.chance[1].mean():.1f}: a difference of {held * gain:.1f} ± {held * half:.1f} (95 %)."
    )
    if min(np.ptp(x) for x in both) > 0.0:
        yield f"Rank correlation of fitted and held-out conditions over these sets: {spearmanr(*both).statistic:.2f}."
    if gain > half:
        yield "Sets that fit better meet more of the claims that they have not seen: the fit predicts."
    else:
        yield "Sets that fit better do not meet more of the claims that they have not seen: the fit predicts nothing."
    kept = np.array([one["held_out"] for one in found.verified])
    own, best = found.untuned["held_out"], "best set meets" if len(kept) == 1 else f"best {len(kept)} sets meet"
    yield (
        f"Verified with fresh seeds, the {best} {np.mean([one['fit'] for one in found.verified]):.1f} of {fitted} fitted "
        f"and {kept.mean():.1f} of {held} held-out conditions, the scene's own values {found.untuned['fit']} and {own}."
    )


def set_rows(found):
    """Heads and rows (set, values, conditions met) of the sets that were verified, as texts."""
    rows = []
    for i, one in enumerate([found.untuned, *found.verified]):
        counts = [f"{one[key]} of {count}" for key, count in zip(("fit", "held_out"), one["of"], strict=True)]
        values = [f"{displayed(name, value):.4g}" for name, value in one["values"].items()]
        rows.append(("own values" if i == 0 else str(i), *values, *counts))
    return ("set", *map(titled, found.study.names), "fitted", "held out"), rows


def write_claims_page(found, path):
    """Write the page, whole or not at all; returns the path."""
    study, heads_rows = found.study, set_rows(found)
    which = [*fitted_conditions(study), *held_out_conditions(study)]
    fitted = len(fitted_conditions(study))
    marks = {True: "met", False: "not"}
    best = found.verified[0]["met"] if found.verified else []
    rows = [
        (picture, title, line, "fitted" if k < fitted else "held out", marks[found.untuned["met"][k]], marks[best[k]])
        for k, (picture, title, line) in enumerate(which)
    ]
    return save_page(
        path,
        Path(__file__).with_name("claims.html"),
        name=study.path.stem,
        description=study.description,
        screens=study.settings["screens"],
        figures=len(found.best[0]) + len(found.chance[0]),
        verified=len(found.verified),
        seeds=study.settings["seeds"],
        notes=found.notes,
        chart=charts.svg(lambda fig: shares_chart(fig, found), (4.9, 3.2), "fitted and held-out conditions"),
        heads=heads_rows[0],
        sets=heads_rows[1],
        conditions=rows,
    )


def shares_chart(fig, found):
    """Held-out against fitted conditions met, of the best sets and of those by chance."""
    ax = fig.subplots()
    for label, (x, y), colour, mark in (("best sets", found.best, HEAD, "o"), ("by chance", found.chance, MUTED, "x")):
        ax.plot(100.0 * x, 100.0 * y, mark, color=colour, ms=4, label=label)
    ax.set(xlabel="fitted conditions met [%]", ylabel="held-out conditions met [%]")
    fig.legend(loc="outside upper right", ncols=2)


def write_claims(found, path):
    """Write the search as JSON, whole or not at all; returns the path."""
    document = {
        "description": found.study.description,
        "settings": found.study.settings,
        "fit": found.study.fit,
        "measure": found.study.measure,
        "parameters": {p.name: [p.low, p.high] for p in found.study.parameters},
        "screens": found.screens.tolist(),
        "best": [x.tolist() for x in found.best],
        "chance": [x.tolist() for x in found.chance],
        "verified": found.verified,
        "own_values": found.untuned,
        "cpu_s": found.cpu,
        "notes": found.notes,
    }
    return write_json(path, document)


@guarded
def fit(
    study: Annotated[Path, typer.Argument(metavar="STUDY.toml")] = STUDY,
    fmu: FMU = None,
    out: Annotated[Path, typer.Option(help="folder of runs, claims.json and page")] = Path("results/fit_claims"),
    scheduler: SCHEDULER = None,
    workers: WORKERS = None,
):
    """Whether other values of the unpublished parameters meet more of the paper's claims."""
    plan = plan_claims(study, read_toml(study), model := Model(fmu))
    make_folder(out)
    with design_runs(study.stem, out, scheduler, workers) as (client, progress):
        found = identify_claims(plan, Bench(plan, model, out, client, progress))
    console.print(grid(*set_rows(found)))
    for note in found.notes:
        console.print(escape(note), soft_wrap=True)
    print_paths(
        ("results", write_claims(found, out / "claims.json")),
        ("page", write_claims_page(found, out / "claims.html")),
    )


if __name__ == "__main__":
    typer.run(fit)
