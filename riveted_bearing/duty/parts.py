"""Parts of a mission: an operating point or an event with its scene."""

from dataclasses import dataclass, field

from ..base.errors import UserError, refusal
from ..base.toml_files import leaves, section_of
from ..base.units import to_si
from ..running.basis import loads, speeds
from ..running.scene import Scene, load_scene
from ..studies.sweep_file import beside

HOURS = {"h": (1.0, 0.0), "min": (60.0, 0.0), "s": (3600.0, 0.0)}
SHARES = {"1": (1.0, 0.0), "%": (100.0, 0.0)}
FORCED = {"scene.stress": "fatigue", "scene.statistics": "on", "scene.breakage": "off", "fatigue.acceleration": 1.0}


@dataclass(frozen=True)
class Part:
    """An operating point (weight: hours) or an event (weight: count); scene: None if it is interpolated; values: of all
    inputs, None for those that vary, and of the parameters that it sets, SI; load, speed: in words; warnings: sentences.
    Of a class of a record: cell, its number along each axis; means and spreads, of the record's values in it.
    """

    name: str
    event: bool
    weight: float
    scene: Scene | None = field(repr=False)
    factor: float = 1.0
    values: dict = field(default_factory=dict, repr=False)
    load: str = ""
    speed: str = ""
    cell: tuple = ()
    means: tuple = ()
    spreads: tuple = ()
    warnings: tuple = ()


def number(path, key, value, scales):
    """SI value, hours for times; UserError naming the key."""
    try:
        return to_si(value, scales)
    except UserError as problem:
        raise refusal(path, key, value, problem) from None


def amount(path, key, value, scales):
    """A number that is not negative."""
    found = number(path, key, value, scales)
    if found < 0.0:
        raise refusal(path, key, value, "must not be negative")
    return found


def tables(path, document, name):
    """The list of tables [[name]]."""
    blocks = document.get(name, [])
    if not isinstance(blocks, list) or not all(isinstance(block, dict) for block in blocks):
        raise UserError(f"{path}: {name}: write [[{name}]] with its keys below it")
    return blocks


def part_of(path, document, model, label, name, block, weight):
    """The operating point of one block, its scene checked."""
    factor = amount(path, f"{label}: preload_factor", block.get("preload_factor", 1.0), SHARES)
    common = {section: section_of(path, document, section) for section in ("simulation", "parameters", "inputs")}
    own = {
        section: section_of(f"{path}: {label}", block, section) for section in ("simulation", "parameters", "inputs")
    }
    for changes in (common, own):
        if any(key in FORCED for key, _ in leaves(changes["parameters"], model.parameters)):
            raise UserError(
                f"{path}: {label}: {' and '.join(FORCED)} are not free here: a life needs the count of stress cycles"
            )
    source = block.get("scene", document.get("scene"))
    scene = load_scene(
        beside(path, source),
        model,
        (str(path), common),
        (f"{path}: {label}", own),
        ("a mission", {"parameters": {name: value for name, value in FORCED.items() if name in model.parameters}}),
    )
    settle = settling(scene, model)
    if scene.t_end <= settle:
        raise refusal(
            f"{path}: {label}",
            "simulation.t_end",
            scene.t_end,
            f"longer than start.settle = {settle:g} s is needed, before which damage does not count",
        )
    return Part(
        name,
        False,
        weight,
        None if block.get("interpolate", False) else scene,
        factor,
        values_of(scene, model),
        loads(model, [scene]),
        speeds(model, [scene]),
    )


def settling(scene, model):
    """start.settle of a scene [s]."""
    return scene.parameters.get("start.settle", model.default(model.parameters["start.settle"]))


def values_of(scene, model):
    """What of a scene can be compared and interpolated: constant inputs, its own or the FMU's, and its parameters, SI;
    None for inputs that vary.
    """
    own = {name: model.default(variable) for name, variable in model.inputs.items()}
    inputs = own | {
        name: float(history.value[0]) if len(history.t) == 1 else None for name, history in scene.inputs.items()
    }
    return inputs | {name: value for name, value in scene.parameters.items() if not isinstance(value, bool)}
