"""Designs side by side under one mission: ratios of lives and stresses with intervals, and what differs.

A design is an FMU, or an FMU with parameters of its own.  All designs have the same number of runs of each case, and
run s of each has the same start.seed (common random numbers).  The interval of a ratio of lives is that of
confidence.py for the differences of the runs of equal seeds.  Bearing motion is chaotic: where the designs differ
at all, common seeds may correlate little; the correlation stands beside the result.
"""

import hashlib
import math
import zipfile
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from scipy.stats import t as student

from ..base.errors import UserError, refusal, unknown
from ..base.schema import checked
from ..base.toml_files import leaves, read_toml, section_of
from ..running.fmu import Model
from ..running.scene import in_words
from ..running.summary import static_and_swing
from ..studies.rows import columns_of
from .assess import Runs, assess, place_text, places
from .confidence import Estimate, estimate, ratio_interval
from .life_budget import budgets_of
from .mission import plan_mission
from .mission_file import MissionFile
from .notes import matrix_warnings
from .page import open_ends, open_text
from .raceways import Raceways

RESPONSES = {  # column of a run, or part of the stress (summary.static_and_swing): in words, unit and its factor
    "head_static": ("head, static", "MPa", 1e-6),
    "head_swing": ("head, swing", "MPa", 1e-6),
    "stat.sigma_head_p999": ("head stress, p99.9", "MPa", 1e-6),
    "middle_static": ("middle, static", "MPa", 1e-6),
    "middle_swing": ("middle, swing", "MPa", 1e-6),
    "stat.sigma_mid_p999": ("middle stress, p99.9", "MPa", 1e-6),
    "stat.Q_c_p999": ("pocket force, p99.9", "N", 1.0),
}
HEAD_STRESS = "stat.sigma_head_p999"
TABLE_SOURCE = "sources/rivet_table.c"
LINES = ("loads", "speed", "oil", "temperatures", "preload", "S-N curve", "damage")  # of basis.py
SAME_INPUTS = 1e-9
APART = 1.05  # ratio of static stresses from which on a life that goes the other way needs a word


@dataclass(frozen=True)
class Design:
    """An FMU and the parameters that are set in it, as the user wrote them."""

    name: str
    model: Model = field(repr=False)
    settings: dict


@dataclass(frozen=True)
class Ratio:
    """A value over the first design's, its interval, and the correlation of logarithms (nan without scatter)."""

    ratio: float
    low: float
    high: float
    correlation: float

    @property
    def differs(self):
        """Whether the interval leaves 1 out."""
        return self.low > 1.0 or self.high < 1.0


@dataclass(frozen=True)
class Outcome:
    """One design: estimate, place that fails first, Ratio of life to the first design's (or None), {part: {response: (mean,
    Ratio)}}, deciding part, Raceways, budgets by figure.
    """

    design: Design
    estimate: Estimate = field(repr=False)
    place: str
    life: Ratio | None
    responses: dict = field(repr=False)
    deciding: str = ""
    raceways: Raceways = field(default_factory=Raceways, repr=False)
    budgets: dict = field(default_factory=dict, repr=False)


@dataclass(frozen=True)
class Comparison:
    """Outcomes of the designs; counts: runs of each case; differences: (name, [texts]); basis: shared lines."""

    name: str
    description: str
    confidence: float
    counts: tuple
    outcomes: tuple
    differences: tuple
    basis: dict
    warnings: tuple = ()


def read_designs(words: Any, number_or_text: Any) -> Any:
    """The Designs of the command's words: FMUs, each followed by NAME=VALUE of its own."""
    found = []
    for word in words:
        name, equals, value = word.partition("=")
        if not equals:
            found.append((Path(word), {}))
        elif not found:
            raise UserError(f"{word}: stands before the first FMU; a design is an FMU with NAME=VALUE behind it")
        else:
            found[-1][1][name.strip()] = number_or_text(value.strip().strip("\"'"))
    if len(found) < 2:
        raise UserError(f"{len(found)} design: at least two are needed, each an FMU with NAME=VALUE behind it")
    models = {path: Model(path) for path, _ in found}
    names = [" ".join([path.stem, *(f"{name}={value}" for name, value in own.items())]) for path, own in found]
    if twice := sorted({str(path) for i, (path, _) in enumerate(found) if names.count(names[i]) > 1}):
        raise UserError(f"{', '.join(twice)}: designs of one name; give files other names, or parameters that differ")
    return [Design(name, models[path], own) for name, (path, own) in zip(names, found, strict=True)]


def plan(path, design):
    """The Mission of a file for a design: its parameters over the mission's, no part left out."""
    document, model = read_toml(path), design.model
    file = checked(MissionFile, document, path)
    for name in design.settings:
        if name not in model.parameters:
            raise unknown(design.name, "parameter", name, model.parameters)
        for kind, blocks in (("point", file.point), ("event", file.event)):
            for block in blocks:
                if name in dict(leaves(block.parameters, model.parameters)):
                    raise refusal(design.name, name, design.settings[name], f"{path}: a {kind} sets it too")
    common = common_parameters(path, model)
    life = section_of(path, document, "life") | {"skip": 0.0}
    document |= {"parameters": common | design.settings, "life": life}
    return plan_mission(Path(path).stem, document, model, Path(path))


def common_parameters(path, model):
    """Parameters that a mission's file sets for all points and events, as written."""
    return dict(leaves(section_of(path, read_toml(path), "parameters"), model.parameters))


def check_same_inputs(missions, designs):
    """UserError if a part does not have the same loads, speeds and temperatures in all designs."""
    for parts in zip(*(mission.parts for mission in missions), strict=True):
        for mission, part, design in zip(missions, parts, designs, strict=True):
            for name in design.model.inputs:
                first, own = parts[0].values.get(name), part.values.get(name)
                if name not in designs[0].model.inputs or first is None or own is None:
                    continue  # varies in time: from the mission's file, for all designs
                if not math.isclose(first, own, rel_tol=SAME_INPUTS, abs_tol=1e-12):
                    texts = (in_words(d.model, name, v) for d, v in ((designs[0], first), (design, own)))
                    raise UserError(
                        f"{mission.path}: {part.name}: {name} is {' in '.join((next(texts), designs[0].name))} and "
                        f"{' in '.join((next(texts), design.name))}: each FMU has its own; set it under [inputs]"
                    )


def compare_designs(
    path: str | Path, designs: Any, folder: str | Path, client: Any, progress: Any = None, say: Any = lambda name: None
) -> Any:
    """The Comparison of designs under the mission of a file; folder: for the runs, client and progress: as of Runs."""
    missions = [plan(path, design) for design in designs]
    check_same_inputs(missions, designs)
    all_runs: list[Any] = []
    counts: Any = None
    for k, (mission, design) in enumerate(zip(missions, designs, strict=True)):
        say(design.name)
        runs = Runs(mission, design.model, Path(folder) / f"design_{k + 1}", client, progress)
        assess(mission, runs)
        own = np.array([len(runs.keys_of(c)) for c in range(len(mission.cases))])
        counts = own if counts is None else np.maximum(counts, own)
        all_runs.append(runs)
    settings = missions[0].settings
    samples = [[places(damage, settings["rivets"]) for damage in runs(counts)] for runs in all_runs]
    found = [estimate(m.duty, s, settings["confidence"]) for m, s in zip(missions, samples)]
    rows = [responses_of(runs, counts) for runs in all_runs]
    confidence = settings["confidence"]

    def ratio(k, part, name, values):
        return ratio_of(rows[0][part][name], values, confidence) if k else None

    def outcome(k):
        mission, of_life = missions[k], found[k]
        place = place_text(of_life.place, settings["rivets"])
        life = life_ratio([samples[0], samples[k]], [found[0], of_life], confidence) if k else None
        responses = {
            part: {name: (values.mean(), ratio(k, part, name, values)) for name, values in of_part.items()}
            for part, of_part in rows[k].items()
        }
        shares = dict(zip((part.name for part in mission.parts), of_life.shares, strict=True))
        deciding = max(rows[k], key=shares.__getitem__)
        budgets = budgets_of(mission, of_life, range(len(mission.parts)), all_runs[k])
        return Outcome(designs[k], of_life, place, life, responses, deciding, mission.raceways(), budgets)

    outcomes = tuple(map(outcome, range(len(designs))))
    lines = [dict(mission.basis) for mission in missions]
    rests_on = {key: [own.get(key, "–") for own in lines] for key in LINES if any(key in own for own in lines)}
    differ = [row for key, texts in rests_on.items() for row in differing(key, texts)]
    differ += differences(designs, common_parameters(path, designs[0].model))
    basis = {key: texts[0] for key, texts in rests_on.items() if len(set(texts)) == 1}
    about, warnings = (Path(path).stem, missions[0].description, confidence), tuple(warnings_of(all_runs, outcomes))
    return Comparison(*about, tuple(counts.tolist()), outcomes, tuple(differ), basis, warnings)


def warnings_of(all_runs, outcomes):
    """Sentences on the designs' events, matrices and intervals of life, of several designs once."""
    found = {}
    for runs, outcome in zip(all_runs, outcomes, strict=True):
        texts = [*runs.mission.warnings, *matrix_warnings(runs)]
        if ends := open_ends(*ends_of(outcome)):
            texts.append(f"the interval of life is {open_text(ends)}")
        for text in texts:
            found.setdefault(text, []).append(outcome.design.name)
    for text, names in found.items():
        yield f"{'all designs' if len(names) == len(outcomes) else '; '.join(names)}: {text}"


def life_ratio(samples, found, confidence):
    """Ratio of the lives of two Estimates, the second over the first."""
    if not all(math.isfinite(one.life) for one in found):
        return Ratio(math.nan, 0.0, math.inf, math.nan)
    low, high, r = ratio_interval(samples, found, confidence)
    return Ratio(found[1].life / found[0].life, math.exp(low), math.exp(high), r)


def ratio_of(a, b, confidence):
    """Ratio of the geometric means of a positive response over common seeds, by Student's interval of the pairs."""
    if np.min(a) <= 0.0 or np.min(b) <= 0.0:
        return Ratio(math.nan, 0.0, math.inf, math.nan)
    difference = np.log(b) - np.log(a)
    middle, error = difference.mean(), difference.std(ddof=1) / math.sqrt(len(difference))
    half = float(student.ppf(0.5 + 0.5 * confidence, len(difference) - 1)) * error
    scatter = np.std(np.log(a)) * np.std(np.log(b))
    correlation = float(np.cov(np.log([a, b]), bias=True)[0, 1] / scatter) if scatter > 1e-12 else math.nan
    return Ratio(*(math.exp(x) for x in (middle, middle - half, middle + half)), correlation)


def responses_of(runs, counts):
    """{part: {response: values of its runs, by seed}} of the parts as they are at the start of the mission."""
    rows, mission, found = columns_of(runs.folder), runs.mission, {}
    places_of = {key: i for i, key in enumerate(rows["key"])}
    for c, n in enumerate(counts):
        name = mission.parts[mission.cases[c].part].name
        if n and name not in found:
            chosen = [places_of[runs.keys[c, s]] for s in range(n)]
            found[name] = {one: np.asarray(rows[one], float)[chosen] for one in RESPONSES if one in rows}
            for place, word in (("head", "head"), ("mid", "middle")):
                parts = (part[chosen] for part in static_and_swing(rows, place))
                found[name] |= dict(zip((f"{word}_static", f"{word}_swing"), parts, strict=True))
    return found


# What differs ---------------------------------------------------------------------------------------------------------


def differences(designs, common):
    """(name, [text of each design]) of all that differs; common: parameters that the mission sets for all."""
    models = [design.model for design in designs]
    yield from differing("bearing", [model.bearing for model in models])
    names = dict.fromkeys(name for model in models for name in model.parameters)
    for name in names:
        yield from differing(name, [own_value(design, name, common) for design in designs])
    yield from differing("table of the rivets (SHA-256)", [member_digest(model) for model in models])
    yield from differing("lowest mode of a free half", [lowest_mode(model) for model in models])
    yield from differing("FMU (SHA-256)", [model.digest[:12] for model in models])


def differing(name, texts):
    """The row of a name if its texts are not all one."""
    if len(set(texts)) > 1:
        yield name, texts


def own_value(design, name, common):
    """A parameter of a design in words; – if its FMU has none."""
    variable = design.model.parameters.get(name)
    if variable is None:
        return "–"
    value = design.settings.get(name, common.get(name))
    return in_words(design.model, name, None if value is None else design.model.parameter_value(value, variable))


def member_digest(model):
    """Digest of the rivet table among the FMU's sources."""
    with zipfile.ZipFile(model.path) as archive:
        if TABLE_SOURCE not in archive.namelist():
            return "not listed"
        return hashlib.sha256(archive.read(TABLE_SOURCE)).hexdigest()[:12]


def lowest_mode(model):
    """Frequency of the lowest vibration mode of a free half in words."""
    frequencies = (model.cage_modes or {}).get("frequency")
    return f"{min(frequencies):.4g} Hz" if frequencies else "none"


# What is written ------------------------------------------------------------------------------------------------------


def ends_of(outcome: Any) -> tuple[float, float, float]:
    """Life, lower and upper end of its interval [h]."""
    return outcome.estimate.life, outcome.estimate.low, outcome.estimate.high
