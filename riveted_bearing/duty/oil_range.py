"""A mission with dry and with flooded pockets: the width of a life by the oil in the pockets, which nobody measures.

Between both ends lies what a jet leaves in the pockets: the film of oil takes the peaks off the impacts, and damage rises
with a high power of the stress.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..base.errors import UserError
from ..base.files import make_folder, write_atomically
from ..base.toml_files import leaves
from ..base.units import hours_text
from .assess import Life, write_record
from .mission import plan_mission
from .page import ends_of, interval_text
from .points import changed_points
from .raceways import finite

if TYPE_CHECKING:
    from ..running.fmu import Model
    from .mission import Mission

FILLING = "cage.pocket_filling"
ENDS = {"dry": 0.0, "flooded": 1.0}
RECORD = "oil_range.json"


@dataclass(frozen=True)
class OilRange:
    """Lives of a mission by end: "dry", "flooded"."""

    lives: dict[str, Life]


def plan_ends(mission: Mission, model: Model) -> Any:
    """The Missions of both ends by name.  UserError where the FMU knows no oil in its pockets, and where points or events set
    their own filling: both ends would be the same there.
    """
    path, names = mission.path, model.parameters
    if FILLING not in names:
        raise UserError(f"{model.path}: this FMU has no {FILLING}, which --oil-range needs: build it again")
    file = mission.file
    for block in filter(None, [*changed_points(path, file, model), *file.event, file.table, file.history]):
        own = [name for name, _ in leaves(block.parameters, names)]
        if FILLING in own:
            raise UserError(
                f"{path}: a point sets {FILLING}; --oil-range computes dry (0) and flooded (1) pockets in all points: "
                "leave it out there"
            )
    common = dict(leaves(file.parameters, names))
    return {
        end: plan_mission(
            f"{mission.name} {end}", mission.document | {"parameters": common | {FILLING: filling}}, model, path
        )
        for end, filling in ENDS.items()
    }


def has_filling(mission, model, filling):
    """Whether all cases of a mission have this filling."""
    own = model.default(model.parameters[FILLING])
    return all(case.scene.parameters.get(FILLING, own) == filling for case in mission.cases)


def oil_range(found: Any, model: Model, folder: Path, assessed: Any) -> Any:
    """The OilRange beside a Life that was found in a folder; assessed(mission, folder): Life.  An end that the mission has
    itself is not simulated again; the other ones have folders of their own.
    """
    lives = {}
    for end, mission in plan_ends(found.mission, model).items():
        if has_filling(found.mission, model, ENDS[end]):
            lives[end] = found
            continue
        place = folder / end
        make_folder(place)
        lives[end] = assessed(mission, place)
        write_record(lives[end], place)
    return OilRange(lives)


def rows(ends: Any) -> Iterator[Any]:
    """Title, life and interval of each end."""
    for end, life in ends.lives.items():
        yield f"Life, {end}", hours_text(life.estimate.life), f"{interval_text(*ends_of(life))} · {life.place}"


def remarks(ends: Any) -> Any:
    """Sentences on both ends."""
    texts = {end: hours_text(life.estimate.life) for end, life in ends.lives.items()}
    return [
        f"Oil in the pockets: life is {texts['dry']} with dry and {texts['flooded']} with flooded pockets. "
        "Nobody has measured the filling, so that the life lies between both."
    ]


def write_oil_range(ends: Any, folder: Path) -> Path:
    """Write oil_range.json, whole or not at all; returns its path."""
    path = folder / RECORD
    record = {
        end: {
            "filling": ENDS[end],
            "life_h": finite(life.estimate.life),
            "low_h": finite(life.low),
            "high_h": finite(life.estimate.high),
        }
        for end, life in ends.lives.items()
    }
    write_atomically(
        path, lambda temporary: temporary.write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")
    )
    return path
