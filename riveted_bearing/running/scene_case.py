"""Cases of scenes and FMUs at their start, and whatever `info` may be asked for."""

from pathlib import Path
from typing import Any

from ..base.errors import UserError, is_file
from ..base.file_kinds import OF_BEARINGS
from ..base.shipped import shipped_scenes
from ..base.toml_files import read_toml
from ..bearing import catalogue, oil
from ..bearing.bearing_file import bearing_case
from ..bearing.case import Case
from ..bearing.designations import known_bearings, shipped_bearings, unknown_designation
from ..bearing.origin import EXAMPLE
from ..bearing.rules import SHAPE
from .fmu import Model
from .scene import Scene, load_scene


def is_bearing(source: Any) -> bool:
    """Whether a name or file means a bearing, not a scene."""
    if str(source) in known_bearings() or str(source) in shipped_scenes():
        return str(source) in known_bearings()
    return is_file(source) and not read_toml(Path(source)).keys().isdisjoint(OF_BEARINGS)


def case_of(target: Any = None, fmu: Any = None, cage: Any = None) -> Case:
    """The Case of a bearing (file or designation) or of a scene at its start; without a target of the FMU, without both EXAMPLE."""
    target = EXAMPLE if target is None and fmu is None else target
    names = [*known_bearings(), *shipped_scenes()]
    if target is not None and str(target) not in names and not is_file(target):
        raise unknown_designation("info", "bearing, scene or file", target, names)
    if target is not None and is_bearing(target):
        return bearing_case(target, cage=cage)
    if cage is not None:
        raise UserError(f"--cage {cage}: a scene runs in an FMU, whose cage is fixed; name a bearing")
    from .fmu import Model

    return scene_case(target, Model(fmu))


def scene_case(source: Any, model: Model) -> Case:
    """The Case of a scene at its start, None: of the FMU itself, over its start values; it holds no dimensions of rivets."""
    return case_at(load_scene(source, model), model)


def case_at(scene: Scene, model: Model) -> Case:
    """The Case of a Scene at its start."""
    values = {name: model.default(variable) for name, variable in (model.parameters | model.inputs).items()}
    values |= scene.parameters | {name: float(history(0.0)) for name, history in scene.inputs.items()}
    known = [
        case
        for case in map(bearing_case, shipped_bearings())
        if case.Z == model.Z and all(case.values[f"bearing.{s}"] == values[f"bearing.{s}"] for s in ("D", "d_m"))
    ]
    designation = model.bearing.partition(". ")[0].partition(":")[0]
    entry = catalogue.entries().get(designation) if model.origin.get("C") == "catalogue" else None
    data = model.catalogue or (known[0].catalogue if known else entry.data if entry else {})
    alone = tuple(name for name in SHAPE if name in scene.parameters)
    name = f"{designation}, scene {scene.name}" if scene.source else designation
    origin = {} if scene.source else model.origin
    about: dict[str, Any] = {
        "origin": origin,
        "alone": alone,
        "model": model,
        "oil": scene.oil or oil.name_of(model.origin),
    }
    return Case(name, scene.description, model.Z, values, data, rivet=None, **about)
