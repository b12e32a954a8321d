"""Missions: operating points with hours and events with counts, checked against the FMU (mission_file.py, docs/life.md)."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cache, partial
from pathlib import Path
from typing import Any

import numpy as np

from ..base.errors import UserError, refusal, shortlist
from ..base.file_kinds import check_keys
from ..base.schema import checked
from ..base.toml_files import read_toml
from ..bearing.assumed import given_names
from ..bearing.strength import assumed, in_words, read_strength
from ..running.basis import basis, fast_speeds
from ..running.effects import acts, without_effect
from ..running.fmu import Model
from ..running.rainflow import fatigue_law
from ..running.runner import turns
from ..running.scene import own_names
from ..running.scene_case import case_at
from ..running.summary import COUNTED, SETTLED, fewer
from .blends import cases_of, slopes_of
from .cycles import outputs_of
from .miner import Duty
from .mission_file import FEWEST, MissionFile
from .parts import FORCED, events
from .points import points
from .raceways import Raceways, of_parts, rated, slip_warning, why_unrated

MOST_TRIED = 8  # parts in which a setting without effect in one is tried
TURNS = {  # of turns(): revolutions wanted, what happens with fewer, and the key that makes more
    "settle_turns": (SETTLED, "damage begins to count after", "parameters.start.settle"),
    "count_turns": (COUNTED, "damage of a run rests on", "simulation.t_end"),
}


@dataclass(frozen=True)
class Mission:
    """A mission checked against its Model; hours: of all points; basis: of all; shares: whether of a time that is not given;
    slow: sentences; raceways(): the Raceways; idle(): names of settings without effect.
    """

    name: str
    description: str
    path: Path
    document: dict = field(repr=False)
    file: MissionFile = field(repr=False, compare=False)
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


def load_mission(path: str | Path, model: Model) -> Mission:
    """Read a mission's TOML file; raises UserError naming file, key, value and what is allowed."""
    path = Path(path)
    return plan_mission(path.stem, read_toml(path, "mission file"), model, path)


def plan_mission(name, document, model, path):
    """The Mission of a document like the file's."""
    path = Path(path)
    check_keys(path, document, MissionFile.model_fields, "mission")
    file = checked(MissionFile, document, path)
    settings = life_settings(path, file.life)
    parts = [*points(path, file, model), *events(path, file, model)]
    if not any(not part.event for part in parts):
        raise UserError(f"{path}: no operating points: write [[point]] with hours, or [table] or [history] with a file")
    hours = sum(part.weight for part in parts if not part.event)
    if hours <= 0.0:
        raise UserError(f"{path}: the hours of all points are 0")
    loss = preload_loss(path, file.preload_loss)
    cases, blends = cases_of(path, parts, loss[1], model)
    duty = Duty(np.array([part.weight / hours for part in parts]), blends, loss[0], slopes_of(parts, blends))
    scenes = [case.scene for case in cases]
    rows = tuple(basis(model, scenes, curves(path, file.sn, scenes, model)))
    return Mission(
        name,
        file.description,
        path,
        document,
        file,
        tuple(parts),
        tuple(cases),
        duty,
        hours,
        settings,
        rows,
        any(block.share is not None for block in file.point),
        str(model.path.resolve()),
        model.digest,
        (*slow_warnings(parts, model), *fast_speeds(model, scenes)),
        cache(lambda: of_parts(model, parts, settings["cleanliness"])),
        cache(lambda: idle_settings(model, parts)),
    )


def idle_settings(model, parts):
    """Names that the MOST_TRIED longest parts set without effect on stress, damage and raceways."""
    tried = sorted((part for part in parts if part.scene is not None), key=lambda part: -part.weight)[:MOST_TRIED]
    idle = {name: True for part in tried for name in own_names(part.scene, model) if name not in FORCED}

    def stress_and_damage(result):
        return result.data | {name: value for name, value in result.summary.items() if ".damage_" in name}

    def prepared(scene):  # seeds are the life's own
        return replace(scene, accuracy=None, outputs=outputs_of(model), parameters=scene.parameters | {"start.seed": 1})

    for part in tried:
        names = [name for name in own_names(part.scene, model) if idle.get(name)]
        left, _ = without_effect(model, part.scene, names, stress_and_damage, prepared)
        if left and not part.event:
            rated_at = partial(raceway_figures, model)
            reference = rated_at(part.scene)
            left = [name for name in left if not acts(name, part.scene, rated_at, reference)]
        idle |= {name: name in left for name in names}
    return tuple(name for name, still in idle.items() if still)


def raceway_figures(model, scene):
    """Lives of the raceways in a Scene at its start; of a bearing that is not rated none."""
    case = case_at(scene, model)
    return {} if why_unrated(case) is not None else rated(case).lives


def curves(path: Path, section: Any, scenes: Any, model: Model) -> Any:
    """The S-N curves of the scenes in words, and what of them is assumed; section: [sn] of a mission."""
    found = {}
    for scene in scenes:
        given = frozenset(name for name in given_names(model, scene) if name.startswith("fatigue."))
        law = {name: scene.value(name, model) for name in model.parameters if name.startswith("fatigue.")}
        found[fatigue_law(law), given] = None
    strengths = ((read_strength(path, section, law), given) for law, given in found)
    return "; ".join(dict.fromkeys(f"{in_words(strength)}{assumed(strength, given)}" for strength, given in strengths))


def slow_warnings(parts, model):
    """Sentences on simulated points with few revolutions, where the start or chance counts; not at rest."""
    found = {
        part.name: turns(model, part.scene, part.scene.t_end)
        for part in parts
        if part.scene is not None and not part.event
    }
    for kind, (wanted, words, key) in TURNS.items():
        slow = {name: of[kind] for name, of in found.items() if fewer(of[kind], wanted)}
        if slow:
            least = min(slow.values())
            yield (
                f"{'points' if len(slow) > 1 else 'point'} {shortlist(slow, 4)}: {words} {least:.2g} revolutions of the shaft"
                f"{' or more' if len(slow) > 1 else ''}; from {wanted:g} on it is steady enough to compare ({key})"
            )


def life_settings(path, life):
    """The settings of a Life as a dict, what depends on each other checked."""
    settings = life.model_dump()
    if "min_seeds" not in life.model_fields_set:
        settings["min_seeds"] = min(life.min_seeds, life.max_seeds)
    if not FEWEST <= settings["min_seeds"] <= life.max_seeds:
        bounds = f"allowed: {FEWEST} (fewer show no scatter) to {life.max_seeds} (life.max_seeds)"
        raise refusal(path, "life.min_seeds", life.min_seeds, bounds)
    return settings


def preload_loss(path, loss):
    """Hours and factors of the law of preload loss."""
    if loss is None:
        return np.zeros(1), np.ones(1)
    if not loss.hours or len(loss.hours) != len(loss.factor):
        raise UserError(f"{path}: preload_loss: hours and factor are needed, lists of one length")
    hours = np.array(loss.hours)
    if hours[0] != 0.0 or np.any(np.diff(hours) <= 0.0):
        raise refusal(path, "preload_loss.hours", loss.hours, "they must begin with 0 and increase")
    return hours, np.array(loss.factor)
