"""Missions: operating points with their hours and events with their counts, from TOML files, checked against the FMU.

description = "..."
scene = "demo"                       # shipped name or file, default: none, the FMU's own parameters and inputs; points and events may name another one
[simulation]                         # as in a scene file, for all points and events; so are:
t_end = 0.2
[parameters]
[inputs]

[[point]]
name = "climb"                       # default: its number
hours = 20                           # or "90 min", or share = 0.02 of the whole in every point
preload_factor = 0.9                 # of joint.preload at this point; default 1
interpolate = true                   # not simulated: from the points around it; default false
inputs.shaft.F_y = "3 kN"            # [point.inputs], [point.parameters], [point.simulation]
[[event]]
name = "landing"
count = 12                           # per pass of the mission; damage of its whole run after start.settle
after_settle = true                  # the times of its inputs count from start.settle; default false: from the start of the run
inputs.impact.F_r = { t = [0.01, 0.011, 0.012], value = [0, 4000, 0] }

[[change]]                           # of tunable parameters, in every pass of the mission: from this time of its points on,
at = "2 h"                           # in their order; a point that is under way is divided
joint.mu = 0.2

[table]                              # further points from a CSV or Parquet table; a unit may stand in a column's name (tables.py)
file = "duty.csv"
hours = "h"                          # column
inputs.shaft.omega = { column = "n", unit = "rev/min" }
[history]                            # further points: a measured record, binned
file = "flight.csv"
time = "t"                           # column [s], or with its unit
longest_gap = "10 min"               # between samples; default: ten usual intervals
hours = 1000                         # what the record stands for; default: its own length
inputs.shaft.F_y = { column = "load", unit = "kN", bins = 6 }

[preload_loss]                       # straight lines between; constant after the last hour
hours = [0, 100, 2000]
factor = [1, 0.9, 0.7]
[life]
confidence = 0.9                     # of the interval
half_width = 0.25                    # of life: simulate until the interval is at most life/1.25 ... 1.25 life wide
min_seeds = 6
max_seeds = 32
seed = 1                             # first start.seed, common to all points
skip = 0.01                          # share of the damage that rare points may have and yet be left out by a bound; 0: none left out
rivets = "each"                      # or "alike": every rivet takes every place in turn, so that rates are means over the rivets
cleanliness = "normal"               # of the oil, for the raceways' life: see ../raceways.py; default: normal, assumed
[sn]                                 # see sn.py; default: the FMU's law and its own count
[tolerance]                          # see tolerances.py
"""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cache, partial
from pathlib import Path

import numpy as np

from ..base.errors import UserError, refusal, unknown
from ..base.file_kinds import check_keys
from ..base.toml_files import read_toml, section_of
from ..bearing.assumed import given_names
from ..bearing.strength import assumed, in_words, read_strength
from ..running.basis import basis
from ..running.effects import acts, without_effect
from ..running.rainflow import fatigue_law
from ..running.scene import own_names
from ..running.scene_case import case_at
from ..studies.sweep_file import count_of
from .blends import cases_of, slopes_of
from .cycles import outputs_of
from .events import events
from .miner import Duty
from .parts import FORCED, HOURS, SHARES, amount, number, tables
from .points import points
from .raceways import Raceways, cleanliness_of, of_parts, rated, slip_warning, why_unrated
from .slow import slow_warnings

SECTIONS = (
    "description",
    "scene",
    "simulation",
    "parameters",
    "inputs",
    "point",
    "event",
    "change",
    "table",
    "history",
    "preload_loss",
    "life",
    "sn",
    "tolerance",
)
LOSS = ("hours", "factor")
FEWEST = 3  # seeds
LIFE = {
    "confidence": 0.9,
    "half_width": 0.25,
    "min_seeds": 6,
    "max_seeds": 32,
    "seed": 1,
    "skip": 0.01,
    "rivets": "each",
    "cleanliness": None,
}
RIVETS = ("each", "alike")
MOST_TRIED = 8  # parts in which a setting without effect in one is tried


@dataclass(frozen=True)
class Mission:
    """A mission checked against its Model; hours: of all points together; basis: what all of it rests on; shares:
    whether its points have shares of a time that is not given; fmu, fmu_sha256: path and digest of the Model's file;
    slow: sentences on points at which the shaft turns too few times; raceways(): the Raceways; idle(): names of settings
    without effect.
    """

    name: str
    description: str
    path: Path
    document: dict = field(repr=False)
    parts: tuple
    cases: tuple = field(repr=False)
    duty: Duty = field(repr=False)
    hours: float
    settings: dict
    basis: tuple
    shares: bool = False
    fmu: str = ""
    fmu_sha256: str = ""
    slow: tuple = ()
    raceways: Callable = field(default=Raceways, repr=False, compare=False)
    idle: Callable = field(default=tuple, repr=False, compare=False)

    @property
    def warnings(self):
        """What the user has to know of the parts before the runs: sentences."""
        of_parts = (text for part in self.parts for text in part.warnings)
        return (*of_parts, *self.slow, *slip_warning(self.raceways()))


def load_mission(path, model):
    """Read a mission's TOML file; raises UserError naming file, key, value and what is allowed."""
    path = Path(path)
    if not path.is_file():
        raise UserError(f"{path}: no such mission file")
    return plan_mission(path.stem, read_toml(path), model, path)


def plan_mission(name, document, model, path):
    """The Mission of a document like the file's."""
    check_keys(path, document, SECTIONS, "mission")
    settings = life_settings(path, section_of(path, document, "life"))
    parts = [*points(path, document, model), *events(path, document, model)]
    if not any(not part.event for part in parts):
        raise UserError(f"{path}: no operating points: write [[point]] with hours, or [table] or [history] with a file")
    hours = sum(part.weight for part in parts if not part.event)
    if hours <= 0.0:
        raise UserError(f"{path}: the hours of all points are 0")
    loss = preload_loss(path, section_of(path, document, "preload_loss"))
    cases, blends = cases_of(path, parts, loss[1], model)
    duty = Duty(np.array([part.weight / hours for part in parts]), blends, loss[0], slopes_of(parts, blends))
    scenes = [case.scene for case in cases]
    rows = tuple(basis(model, scenes, curves(path, document, scenes, model)))
    return Mission(
        name,
        str(document.get("description", "")),
        path,
        document,
        tuple(parts),
        tuple(cases),
        duty,
        hours,
        settings,
        rows,
        any("share" in block for block in tables(path, document, "point")),
        str(model.path.resolve()),
        model.digest,
        tuple(slow_warnings(parts, model)),
        cache(lambda: of_parts(model, parts, settings["cleanliness"])),
        cache(lambda: idle_settings(model, parts)),
    )


def idle_settings(model, parts):
    """Names of what the scenes of simulated parts set without effect on stress, damage and raceways in any of them; of many
    parts the MOST_TRIED with the most hours or counts.
    """
    tried = sorted((part for part in parts if part.scene is not None), key=lambda part: -part.weight)[:MOST_TRIED]
    idle = {name: True for part in tried for name in own_names(part.scene, model) if name not in FORCED}

    def prepared(scene):  # seeds are the life's own
        return replace(scene, outputs=outputs_of(model), parameters=scene.parameters | {"start.seed": 1})

    for part in tried:
        names = [name for name in own_names(part.scene, model) if idle.get(name)]
        left, _ = without_effect(model, part.scene, names, stress_figures, prepared)
        if left and not part.event:
            rated_at = partial(raceway_figures, model)
            reference = rated_at(part.scene)
            left = [name for name in left if not acts(name, part.scene, rated_at, reference)]
        idle |= {name: name in left for name in names}
    return tuple(name for name, still in idle.items() if still)


def stress_figures(result):
    """Stress and damage of a Result."""
    return result.data | {name: value for name, value in result.summary.items() if ".damage_" in name}


def raceway_figures(model, scene):
    """Lives of the raceways in a Scene at its start; of a bearing that is not rated none."""
    case = case_at(scene, model)
    return {} if why_unrated(case) is not None else rated(case).lives


def curves(path, document, scenes, model):
    """The S-N curves of the scenes in words, and what of them is assumed."""
    section, found = section_of(path, document, "sn"), {}
    for scene in scenes:
        given = frozenset(name for name in given_names(model, scene) if name.startswith("fatigue."))
        found[scene_law(scene, model), given] = None
    strengths = ((read_strength(path, section, law), given) for law, given in found)
    return "; ".join(dict.fromkeys(f"{in_words(strength)}{assumed(strength, given)}" for strength, given in strengths))


def scene_law(scene, model):
    """The FatigueLaw of a scene's parameters."""
    return fatigue_law(
        {
            name: scene.parameters.get(name, model.default(v))
            for name, v in model.parameters.items()
            if name.startswith("fatigue.")
        }
    )


def life_settings(path, section):
    """The settings of [life] with their defaults."""
    for key in section:
        if key not in LIFE:
            raise unknown(path, "key", f"life.{key}", [f"life.{name}" for name in LIFE])
    settings = LIFE | section
    for key, low, high in (("confidence", 0.5, 1.0), ("half_width", 1e-3, 100.0), ("skip", 0.0, 0.5)):
        value = number(path, f"life.{key}", settings[key], SHARES)
        if not low <= value < high:
            raise refusal(path, f"life.{key}", settings[key], f"from {low:g} to below {high:g} is allowed")
        settings[key] = value
    for key in ("min_seeds", "max_seeds", "seed"):
        count_of(path, f"life.{key}", settings[key])
    if settings["max_seeds"] < FEWEST:
        raise refusal(
            path, "life.max_seeds", settings["max_seeds"], f"at least {FEWEST} is allowed: fewer show no scatter"
        )
    if "min_seeds" not in section:
        settings["min_seeds"] = min(settings["min_seeds"], settings["max_seeds"])
    if not FEWEST <= settings["min_seeds"] <= settings["max_seeds"]:
        bounds = f"allowed: {FEWEST} (fewer show no scatter) to {settings['max_seeds']} (life.max_seeds)"
        raise refusal(path, "life.min_seeds", settings["min_seeds"], bounds)
    if settings["rivets"] not in RIVETS:
        raise refusal(path, "life.rivets", settings["rivets"], f"allowed: {', '.join(RIVETS)}")
    if (written := settings["cleanliness"]) is not None:
        try:
            settings["cleanliness"] = cleanliness_of(written)
        except UserError as problem:
            raise refusal(path, "life.cleanliness", written, problem) from None
    return settings


def preload_loss(path, section):
    """Hours and factors of the law of preload loss."""
    if not section:
        return np.zeros(1), np.ones(1)
    for key in section:
        if key not in LOSS:
            raise unknown(path, "key", f"preload_loss.{key}", [f"preload_loss.{name}" for name in LOSS])
    if not all(isinstance(section.get(key), list) and section[key] for key in LOSS) or len(section["hours"]) != len(
        section["factor"]
    ):
        raise UserError(f"{path}: preload_loss: hours and factor are needed, lists of one length")
    hours = np.array([amount(path, "preload_loss.hours", value, HOURS) for value in section["hours"]])
    factor = np.array([amount(path, "preload_loss.factor", value, SHARES) for value in section["factor"]])
    if hours[0] != 0.0 or np.any(np.diff(hours) <= 0.0):
        raise refusal(path, "preload_loss.hours", section["hours"], "they must begin with 0 and increase")
    return hours, factor
