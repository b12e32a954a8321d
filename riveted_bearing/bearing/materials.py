"""Materials of a bearing's parts: by name from data/materials.toml, or a table of one's own in the bearing file.

    [cage]
    material = "steel"        # a name of data/materials.toml, or a table with all properties: { E = "206 GPa", nu = 0.3, ... }
    density = 7830.0          # one property in the place of the material's
    [balls]
    material = "Si3N4"

The properties of a part go to the parameters of the FMU and to the geometry that its rivet table is made from
(rivet_model.geometry): one value for both.
"""

import math
import tomllib
from dataclasses import dataclass, field
from functools import cache
from importlib.resources import files

from bearing_model.generated import variables

from ..base.errors import UserError, refusal, refusing, unknown
from ..base.schema import Number
from ..base.units import rounded, scales_of, symbol_of
from .file_values import span

TABLE = files("riveted_bearing") / "data" / "materials.toml"
OWN = "own"
OPTIONAL = ("strength", "endurance")  # of an own material; without them the S-N curve is the FMU's
UNITS = {"nu": "1", "density": "kg/m3", "expansion": "1/K"} | dict.fromkeys(
    ("E", "yield", "hardening", "strength", "endurance"), "Pa"
)
SHOWN = {  # label, factor and unit of what people ask for first
    "E": ("E", 1e-9, "GPa"),
    "nu": ("nu", 1.0, ""),
    "density": ("", 1.0, "kg/m3"),
    "expansion": ("", 1e6, "1e-6/K"),
    "yield": ("yield", 1e-6, "MPa"),
}


OF_GEOMETRY = {  # begin of the members of the rivet table's geometry
    "E": "E",
    "nu": "nu",
    "density": "rho",
    "expansion": "alpha",
    "yield": "yield",
    "hardening": "hardening",
}


@dataclass(frozen=True)
class Part:
    """Parameters of the FMU and members of the rivet table's geometry by property; material: the 6207's; named: a parameter
    that may give the material's name.
    """

    material: str
    parameters: dict
    geometry: dict = field(default_factory=dict)
    named: str = ""

    @property
    def properties(self):
        """Names of the properties that decide anything."""
        return tuple(dict.fromkeys([*self.geometry, *self.parameters]))


PARTS = {
    "cage": Part(
        "bronze",
        {"E": "cage.E", "nu": "cage.nu", "density": "cage.rho"},
        {key: f"{name}_flange" for key, name in OF_GEOMETRY.items()},
        "cage.material",
    ),
    "rings": Part(
        "bearing steel", {"E": "bearing.E", "nu": "bearing.nu", "density": "ring.rho", "expansion": "bearing.expansion"}
    ),
    "balls": Part(
        "bearing steel", {"E": "ball.E", "nu": "ball.nu", "density": "bearing.rho", "expansion": "ball.expansion"}
    ),
    "rivet": Part(
        "15CrMn",
        {"strength": "fatigue.sigma_m", "endurance": "fatigue.sigma_D"},
        {key: f"{name}_rivet" for key, name in OF_GEOMETRY.items()},
    ),
}


@dataclass(frozen=True)
class Material:
    """A part's material [SI]; sources: in words; given: what the file decides; by_rule: what follows from it."""

    name: str
    values: dict
    sources: dict
    given: tuple = ()
    by_rule: tuple = ()

    def words(self):
        """The material on one line."""
        known = ((*shown, self.values[key]) for key, shown in SHOWN.items() if key in self.values)
        texts = (" ".join(filter(None, (label, f"{factor * x:.4g}", unit))) for label, factor, unit, x in known)
        return f"{self.name}: {', '.join(texts)}"


@cache
def library():
    """All materials by name: {"parts": names of parts, "description": text, property: (value, source)}."""
    return tomllib.loads(TABLE.read_text(encoding="utf-8"))


def names_for(part):
    """Names of the materials that a part may have."""
    return [name for name, entry in library().items() if part in entry["parts"]]


def found_name(part, text):
    """A material's name as the library has it, whatever its case and hyphens; None if there is none."""
    plain = {name.lower().replace("-", "_").replace(" ", "_"): name for name in names_for(part)}
    return plain.get(str(text).lower().replace("-", "_").replace(" ", "_"))


def code_of(name):
    """The item of the FMU's enumeration cage.material for a material."""
    return name.lower().replace("-", "_")


def material_of(path, part, section, given, as_written):
    """The Material of a part; UserError naming the key for what is unknown, given twice with two values, or without material.

    section: the part's section of a bearing file; given: the file's parameters in SI, as_written: as the file has them.
    """
    where = PARTS[part]
    for key in section:
        if key not in ("material", "source", *where.properties):
            raise unknown(path, f"{part} key", key, ("material", "source", *where.properties))
    chosen = only_one(path, f"{part}.material", section.get("material"), where.named, given.get(where.named))
    values, sources = base_of(path, part, chosen)
    written = {key: section[key] for key in where.properties if key in section}
    own = {key: property_of(path, f"{part}.{key}", key, value) for key, value in written.items()}
    for key, parameter in where.parameters.items():
        texts = written.get(key), as_written.get(parameter)
        value = only_one(path, f"{part}.{key}", own.get(key), parameter, given.get(parameter), *texts)
        if value is not None:
            own[key] = value
    if chosen is None and own.keys() & where.geometry.keys():
        key = next(key for key in own if key in where.geometry)
        rest = ", ".join(name for name in where.geometry if name not in own)
        reason = f"the material is needed too, of which {rest} are taken: [{part}] material = {' | '.join(map(repr, names_for(part)))}"
        raise refusal(path, f"{part}.{key}", written.get(key, own[key]), reason)
    name = where.material if chosen is None else found_name(part, chosen) if isinstance(chosen, str) else OWN
    source = section.get("source", "the bearing file")
    by_rule = scaled_endurance(values, own)
    values |= own | by_rule
    sources |= dict.fromkeys(own, source) | dict.fromkeys(by_rule, "rule: keeps its ratio to the strength")
    return Material(name, values, sources, tuple(own if chosen is None else values), tuple(by_rule))


def scaled_endurance(values, own):
    """The endurance of a material whose strength alone is another one: it keeps its ratio to the strength."""
    if "strength" not in own or "endurance" in own or not values.keys() >= set(OPTIONAL):
        return {}
    return {"endurance": rounded(own["strength"] / values["strength"] * values["endurance"])}


def only_one(path, key, value, other, other_value, written=None, other_written=None):
    """The value that stands under one of two names; UserError if both are given and differ, with the values as written."""
    if value is None or other_value is None:
        return other_value if value is None else value
    same = value == other_value or (
        not isinstance(value, (str, dict)) and math.isclose(value, other_value, rel_tol=1e-9)
    )
    if isinstance(value, str) and isinstance(other_value, str):
        same = code_of(value) == code_of(other_value)
    if not same:
        stands = other_value if other_written is None else other_written
        reason = f"{other} = {stands!r} stands under [parameters]: leave one of them out"
        raise refusal(path, key, value if written is None else written, reason)
    return value


def base_of(path, part, chosen):
    """Values and sources of a material by name, of a table of one's own, or of the 6207's (None)."""
    where = PARTS[part]
    if isinstance(chosen, dict):
        for key in chosen:
            if key not in ("source", *where.properties):
                raise unknown(path, f"{part}.material key", key, ("source", *where.properties))
        missing = [key for key in where.properties if key not in chosen and key not in OPTIONAL]
        if missing:
            raise UserError(
                f"{path}: {part}.material: {', '.join(missing)} {'is' if len(missing) == 1 else 'are'} missing in the table of an own material"
            )
        known = [key for key in where.properties if key in chosen]
        values = {key: property_of(path, f"{part}.material.{key}", key, chosen[key]) for key in known}
        return values, dict.fromkeys(values, str(chosen.get("source", "the bearing file")))
    name = found_name(part, where.material if chosen is None else chosen)
    if name is None:
        raise unknown(path, f"{part}.material", chosen, names_for(part))
    entry = {key: library()[name][key] for key in where.properties if key in library()[name]}
    return {key: value for key, (value, _) in entry.items()}, {key: source for key, (_, source) in entry.items()}


def property_of(path, where, key, value):
    """SI value of a property, checked."""
    unit = UNITS[key]
    with refusing(path, where, value):
        number = Number(scales_of(unit, variables.UNITS[unit]), above=0.0).read(value)
        if key == "nu" and number >= 0.5:
            raise UserError("below 0.5 is allowed")
        variable = variables.PARAMETERS.get(PARTS[where.partition(".")[0]].parameters.get(key))
        if variable is not None and not (variable.min or 0.0) <= number <= (variable.max or math.inf):
            raise UserError(f"{span(variable.min or 0.0, variable.max or math.inf, unit, symbol_of(value))} is allowed")
    return number


def parameters_of(part, material):
    """What the bearing file sets of the FMU's parameters by a part's Material."""
    found = {name: material.values[key] for key, name in PARTS[part].parameters.items() if key in material.given}
    return found | ({PARTS[part].named: code_of(material.name)} if PARTS[part].named and found else {})


def geometry_of(part, material):
    """What a part's Material is in the rivet table's geometry."""
    return {name: material.values[key] for key, name in PARTS[part].geometry.items()}
