"""Candidate causes: their ranges, the designs that are drawn from them, and the inspections that tell causes apart."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import Field
from scipy.stats import qmc

from ..base.errors import refusal, refusing, unknown
from ..base.schema import Named, Section, Text, checked
from ..base.toml_files import leaves, read_toml
from ..base.units import scales_of, to_si
from ..running.fmu import Model
from ..running.scene import Scene
from ..studies.sweep_file import bounds, known_names

SHIPPED = Path(__file__).resolve().parents[1] / "data" / "causes.toml"
OWN = {  # names that are none of the FMU's, with their values where nothing is out of order
    "model.strength": 1.0,
    "model.formed": 1.0,
    "model.weak": 1.0,
    "model.share": 1.0,
    "model.worn": 0.0,
}
SOUND = "nothing out of order"


class OwnCause(Section):
    """A cause beside the shipped ones, or in the place of the shipped one of its name."""

    name: Text
    text: Text = ""
    source: Text = Field("yours", description="where the ranges are from")
    between: Named = Field({}, description="ranges by name, as in data/causes.toml")
    set: Named = Field({}, description="values by name")


class Inspection(Section):
    """What a laboratory may measure."""

    name: Text
    quantity: Text = Field(description="name of a parameter or input; with [*] the largest less the least")
    uncertainty: Any = Field(description="one standard deviation, with unit or in %")
    text: Text = ""


class CausesFile(Section):
    """The shipped list."""

    sound: Named
    cause: list[OwnCause]
    inspection: list[Inspection]


@dataclass(frozen=True)
class Range:
    """Where a value is drawn from, SI."""

    low: float
    high: float
    log: bool = False

    def at(self, u):
        """The values at shares u of the range."""
        if self.log:
            return self.low * (self.high / self.low) ** u
        return self.low + (self.high - self.low) * u


@dataclass(frozen=True)
class Cause:
    """A candidate: ranges of what varies, the sound ones included, and values that are set."""

    name: str
    text: str
    source: str
    ranges: dict
    values: dict
    sound: tuple = ()  # names of the sound ranges


@dataclass(frozen=True)
class Quantity:
    """An inspection: what it measures and its standard deviation, SI; relative: a share of the value."""

    name: str
    quantity: str
    uncertainty: float
    relative: bool
    text: str

    def sd(self, value):
        """Standard deviation at a value."""
        return self.uncertainty * np.abs(value) if self.relative else self.uncertainty + 0.0 * np.abs(value)


def candidates(path: Path, file: Any, model: Model, scene: Scene) -> tuple[list[Cause], dict[str, Quantity]]:
    """Causes that a file tries and inspections by name, shipped and own ones; UserError naming what cannot be used."""
    shipped = checked(CausesFile, read_toml(SHIPPED), SHIPPED)
    names = allowed_names(model)
    sound = dict(leaves(shipped.sound, names))
    blocks = {block.name: block for block in shipped.cause} | {block.name: block for block in file.cause}
    if len({block.name for block in file.cause}) < len(file.cause):
        raise refusal(path, "cause", [block.name for block in file.cause], "each cause needs a name of its own")
    chosen = list(blocks) if file.causes is None else [SOUND, *file.causes, *(b.name for b in file.cause)]
    for name in chosen:
        if name not in blocks:
            raise unknown(path, "cause", name, blocks)
    causes = [cause_of(path, blocks[name], sound, names, model, scene) for name in dict.fromkeys(chosen)]
    inspections = [*shipped.inspection, *file.inspection]
    return causes, {block.name: quantity_of(path, block, names, model) for block in inspections}


def allowed_names(model):
    """Names that ranges may have: those that can vary, with [*] all alike, and own ones."""
    known = [name for name in known_names(model) if name != "scene" and not name.startswith("simulation.")]
    return [*known, *dict.fromkeys(f"{n[: n.index('[')]}[*]{n[n.index(']') + 1 :]}" for n in known if "[" in n), *OWN]


def cause_of(path, block, sound, names, model, scene):
    """The Cause of a block."""
    where = f"{path}: cause {block.name}"
    given, values = dict(leaves(block.between, names)), dict(leaves(block.set, names))
    for name in (*given, *values):
        if name not in names:
            raise unknown(where, "parameter or input", name, names)
    ranges = {n: range_of(where, n, spec, model, scene) for n, spec in (sound | given).items() if n not in values}
    return Cause(block.name, block.text, block.source, ranges, values, tuple(sound))


def range_of(where, name, spec, model, scene):
    """The Range of [low, high] or of a table, in data/causes.toml."""
    table = spec if isinstance(spec, dict) else {"from": spec[0], "to": spec[1]} if is_pair(spec) else {}
    kinds = [kind for kind in ("times", "plus") if is_pair(table.get(kind))]
    kinds += ["from"] * ("from" in table and "to" in table)
    if len(kinds) != 1 or not set(table) <= {"from", "to", "times", "of", "plus", "spacing"}:
        reason = "[lowest, highest], { times = [a, b] }, { plus = [a, b] } or { from, to } is needed"
        raise refusal(where, name, spec, reason)
    if kinds == ["from"] and name in OWN:
        low, high = (to_si(value, scales_of("1", {})) for value in (table["from"], table["to"]))
    elif kinds == ["from"]:
        low, high = bounds(where, name.replace("[*]", "[1]"), (table["from"], table["to"]), model)
    elif kinds == ["times"]:
        own = own_value(where, table.get("of", name), model, scene)
        low, high = sorted(float(x) * own for x in table["times"])
    else:
        low, high = (float(x) + own_value(where, name, model, scene) for x in table["plus"])
    log = table.get("spacing", "linear") == "log"
    if not low <= high or (log and low <= 0.0):
        raise refusal(where, name, spec, "the lowest value must not be above the highest, and above 0 in a logarithm")
    return Range(low, high, log)


def is_pair(value):
    """Whether a value is a list of two."""
    return isinstance(value, list) and len(value) == 2


def own_value(where, name, model, scene):
    """What the mission has for a name, or the resultant radial and axial load."""
    if name == "load":
        return float(np.hypot(*(own_value(where, f"shaft.F_{axis}", model, scene) for axis in "yz")))
    name = name.replace("[*]", "[1]")
    if name in OWN:
        return OWN[name]
    if name not in (known := [*model.parameters, *model.inputs]):
        raise unknown(where, "parameter or input", name, known)
    return float(scene.value(name, model))


def quantity_of(path, block, names, model):
    """The Quantity of an inspection."""
    where = f"{path}: inspection {block.name}"
    if block.quantity not in names:
        raise unknown(where, "parameter or input", block.quantity, names)
    relative = isinstance(block.uncertainty, str) and block.uncertainty.strip().endswith("%")
    with refusing(where, "uncertainty", block.uncertainty):
        spread = to_si(block.uncertainty, scales_of("1", {}) if relative else scales_at(block.quantity, model))
    if not spread > 0.0:
        raise refusal(where, "uncertainty", block.uncertainty, "must be greater than 0")
    return Quantity(block.name, block.quantity, spread, relative, block.text)


def scales_at(name, model):
    """Units of a name, for differences too: without offset."""
    variable = (model.parameters | model.inputs).get(name.replace("[*]", "[1]"))
    return scales_of("1", {}) if variable is None else model.units[variable.unit]


def designs(cause: Cause, count: int, seed: Any, model: Model) -> list[dict[str, Any]]:
    """Values by name of so many designs: Latin hypercubes, the sound ones' the same for all causes; names with [*] have a value
    each, about the middle of the range over a part of it that is drawn too.
    """
    single = [name for name in cause.ranges if "[*]" not in name]
    shared = [name for name in single if name in cause.sound]
    own = [name for name in single if name not in cause.sound]
    names = (cause.sound, seed), (own, seed + 1)
    cubes = [qmc.LatinHypercube(d=max(len(n), 1), rng=s).random(count) for n, s in names]
    places = [cause.sound.index(name) for name in shared]
    unit = np.hstack([cubes[0][:, places], cubes[1][:, : len(own)]])
    rng, known = np.random.default_rng(seed), [*model.parameters, *model.inputs]
    found = []
    for row in unit:
        values = {name: float(cause.ranges[name].at(u)) for name, u in zip([*shared, *own], row, strict=True)}
        for name in (name for name in cause.ranges if "[*]" in name):
            begin, end = name.split("[*]")
            each = [n for n in known if n.startswith(f"{begin}[") and n.endswith(f"]{end}")]
            u = 0.5 + rng.random() * (rng.random(len(each)) - 0.5)
            values |= {n: float(x) for n, x in zip(each, cause.ranges[name].at(u), strict=True)}
        found.append(values | cause.values)
    return found


def quantity_at(quantity: str, design: Any, otherwise: float) -> float:
    """What an inspection without error finds in a design; otherwise: at the mission's own value."""
    if "[*]" not in quantity:
        return float(design.get(quantity, otherwise))
    begin, end = quantity.split("[*]")
    each = [value for name, value in design.items() if name.startswith(f"{begin}[") and name.endswith(f"]{end}")]
    return float(np.ptp(each)) if len(each) > 1 else 0.0
