"""Bearing files: geometry, materials and catalogue data of a bearing, and the results that need no simulation.

    designation = "6310"
    Z = 8
    [catalogue]           # optional: bore, outside_diameter, width [m], C, C_0 [N]
    [parameters]          # start values of the FMU made from this file
    bearing.D = "19.05 mm"
    [inputs]              # likewise
    shaft.F_y = 6000.0

A number is SI, a text carries its unit; a variable that the file leaves out keeps its start value in the variable table, that of the 6207.
"""

import math
from dataclasses import dataclass, field, fields, replace
from importlib.resources import files
from pathlib import Path

from bearing_model import variables
from bearing_model.quasi_static import Bearing, Load, quasi_static

from .errors import UserError, unknown
from .scene import load_scene, positive, read_toml, refusal, section_of, shipped_scenes
from .units import MULTIPLES, suffix, to_si

SHIPPED = files("riveted_bearing") / "data" / "bearings"
KEYS = ("designation", "description", "Z", "catalogue", "parameters", "inputs")
CATALOGUE = ("bore", "outside_diameter", "width", "C", "C_0")


@dataclass(frozen=True)
class Case:
    """A bearing at work: catalogue data and SI values or item names by the FMU's full variable names."""

    designation: str
    description: str
    Z: int
    values: dict
    catalogue: dict = field(default_factory=dict)

    def __repr__(self):
        return f"<Case {self.designation}: {self.description or 'no description'}; Z = {self.Z}, {len(self.values)} values>"

    @property
    def bearing(self):
        """Geometry and material for the quasi-static model."""
        given = {f.name: self.values[f"bearing.{f.name}"] for f in fields(Bearing) if f"bearing.{f.name}" in self.values}
        return Bearing(**given, Z=self.Z, C=self.catalogue.get("C"), C_0=self.catalogue.get("C_0"))

    @property
    def load(self):
        """Loads, speed and support of the inner ring for the quasi-static model."""
        given = {f.name: self.values[f"shaft.{f.name}"] for f in fields(Load) if f"shaft.{f.name}" in self.values}
        mode = self.values.get("ring.tilt_mode", "prescribed")
        if mode == "prescribed":
            return Load(**given | {"M_y": 0.0, "M_z": 0.0})
        return Load(**given, k_tilt=self.values["ring.k_tilt"] if mode == "supported" else 0.0)

    def equilibrium(self):
        """The QuasiStatic of ring and balls; UserError if there is none."""
        return self.solved(self.load, "exact")

    def standard_equilibrium(self):
        """The QuasiStatic as ISO/TS 16281 has it, with linear kinematics and without centrifugal forces; UserError if there is none."""
        return self.solved(replace(self.load, omega=0.0), "linear")

    def solved(self, load, kinematics):
        """The QuasiStatic under a load; UserError if there is none."""
        try:
            return quasi_static(self.bearing, load, kinematics=kinematics)
        except (ValueError, ArithmeticError) as problem:
            raise UserError(f"{self.designation}: {problem}") from None


def shipped_bearings():
    """Designations of the bearings that come with the program."""
    return sorted(path.name.removesuffix(".toml") for path in SHIPPED.iterdir() if path.name.endswith(".toml"))


def find_bearing(source):
    """The file of a bearing given by path or by designation."""
    if str(source) in shipped_bearings():
        return SHIPPED / f"{source}.toml"
    if Path(source).is_file():
        return Path(source)
    raise unknown("bearing", "name or file", source, shipped_bearings())


def is_bearing(source):
    """Whether a name or file means a bearing, not a scene."""
    if str(source) in shipped_bearings() or str(source) in shipped_scenes():
        return str(source) in shipped_bearings()
    return Path(source).is_file() and "Z" in read_toml(Path(source))


def bearing_case(source):
    """The Case of a bearing file: its values, and start values of the variable table for all others; UserError naming file, key, value and what is allowed."""
    path = find_bearing(source)
    document = read_toml(path)
    for key in document:
        if key not in KEYS:
            raise unknown(path, "key", key, KEYS)
    Z = document.get("Z", variables.Z)
    if isinstance(Z, bool) or not isinstance(Z, int) or not 5 <= Z <= 32:
        raise refusal(path, "Z", Z, "allowed: an integer from 5 to 32")
    catalogue = dict(catalogue_values(path, section_of(path, document, "catalogue")))
    values = {}
    for section, known in (("parameters", variables.PARAMETERS), ("inputs", variables.INPUTS)):
        values |= {name: named(variable, variable.start) for name, variable in known.items()}
        values |= dict(start_values(path, section, section_of(path, document, section), known))
    return Case(str(document.get("designation", Path(path.name).stem)), str(document.get("description", "")), Z, values, catalogue)


def catalogue_values(path, section):
    """Keys and SI values of the catalogue's data, each checked."""
    for key, value in section.items():
        if key not in CATALOGUE:
            raise unknown(path, "catalogue key", key, CATALOGUE)
        try:
            yield key, positive(value, unit_scales("N" if key in ("C", "C_0") else "m"))
        except UserError as problem:
            raise refusal(path, f"catalogue.{key}", value, problem) from None


def unit_scales(unit):
    """Symbols that a text may carry for an SI unit, with their (factor, offset)."""
    return variables.UNITS[unit] | MULTIPLES.get(unit, {})


def start_values(path, section, tree, known):
    """Full names and values of one section of a bearing file, each checked."""
    for name, value in flat(tree):
        if name not in known:
            raise unknown(path, section.removesuffix("s"), name, known)
        variable = known[name]
        items = [] if variable.type in ("Real", "Integer") else [item.name.lower() for item in getattr(variables, variable.type)]
        if items and value not in items:
            raise refusal(path, f"{section}.{name}", value, f"allowed: {', '.join(items)}")
        try:
            value = to_si(value, unit_scales(variable.unit)) if isinstance(value, str) and not items else value
        except UserError as problem:
            raise refusal(path, f"{section}.{name}", value, problem) from None
        low, high = (-math.inf if variable.min is None else variable.min), (math.inf if variable.max is None else variable.max)
        if not items and not (is_number(value) and low <= value <= high):
            raise refusal(path, f"{section}.{name}", value, f"not a number in {low:g} ... {high:g}{suffix(variable.unit)}, or a text with its unit")
        yield name, value


def named(variable, value):
    """A value, by item name if it belongs to an enumeration."""
    return value if variable.type in ("Real", "Integer") else getattr(variables, variable.type)(value).name.lower()


def is_number(value):
    """Whether a TOML value is a finite number."""
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def case_of(target, fmu=None):
    """The Case of a bearing (file or designation) or of a scene at its start (file or name); fmu: path of the FMU that a scene is for."""
    names = [*shipped_bearings(), *shipped_scenes()]
    if str(target) not in names and not Path(target).is_file():
        raise unknown("info", "bearing, scene or file", target, names)
    if is_bearing(target):
        return bearing_case(target)
    from .fmu import Model

    return scene_case(target, Model(fmu))


def scene_case(source, model):
    """The Case of a scene at its start, with the FMU's start values for all variables that the scene does not set."""
    scene = load_scene(source, model)
    values = {name: model.default(variable) for name, variable in (model.parameters | model.inputs).items()}
    values |= scene.parameters | {name: float(history(0.0)) for name, history in scene.inputs.items()}
    Z = sum(name.startswith("ball[") and name.endswith("].Q_i") for name in model.outputs)
    known = [
        case
        for case in map(bearing_case, shipped_bearings())
        if case.Z == Z and all(case.values[f"bearing.{s}"] == values[f"bearing.{s}"] for s in ("D", "d_m"))
    ]
    designation, catalogue = (known[0].designation, known[0].catalogue) if known else ("bearing", {})
    return Case(f"{designation}, scene {scene.name}", scene.description, Z, values, catalogue)


def flat(tree, prefix=""):
    """Full names and values of nested tables."""
    for key, value in tree.items():
        if isinstance(value, dict):
            yield from flat(value, f"{prefix}{key}.")
        else:
            yield f"{prefix}{key}", value
