"""What a bearing file leaves out, by rule, and whether the bearing can be built."""

from dataclasses import fields
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from bearing_model.generated import variables
from bearing_model.generated.limits import LIMITS
from rivet_model.geometry import Geometry

from ..base.errors import refusal
from . import catalogue, limits, materials, oil, ribbon, scaling
from .file_values import defaults, flat, is_number, shown

# a bearing's own
CAGE_SIZES = (*(name for name in scaling.SHAPE if name != "rho_flange"), "shape", "pocket_fillet")
CAGE_MATERIAL = tuple(materials.PARTS["cage"].geometry.values())
# the rivet's own, with the defaults
RIVET = {f.name: f.default for f in fields(Geometry) if f.name not in (*CAGE_SIZES, *CAGE_MATERIAL)}
CAGES = ("machined", "ribbon")
SHAPE = ("bearing.D", "bearing.d_m", "cage.D_o", "cage.D_i", "cage.width")  # what the rules follow from
OF_HEAD = ("rivet.head_diameter", "rivet.head_height")  # what a standard's name decides


def rules(Z, given, rivet, inputs, data, entry):
    """What is not given, by rule: number of balls, parameters, dimensions of the rivet, inputs."""
    shape = {name: given.get(name, scaling.start(name)) for name in SHAPE}
    if entry:
        rule_Z, rule_D = catalogue.balls(entry)
        Z = Z or rule_Z
        shape |= {"bearing.D": given.get("bearing.D", rule_D), "bearing.d_m": given.get("bearing.d_m", entry.d_m)}
    Z = Z or variables.Z
    D, d_m = shape["bearing.D"], shape["bearing.d_m"]
    own_shape = bool(entry) or ribbon.is_ribbon(given) or any(shape[name] != scaling.start(name) for name in SHAPE)
    designation = entry.designation if entry else ""
    rivet_by_rule = scaling.scaled_rivet(Z, D, d_m, given, rivet, data.get("bore"), designation)
    whole = rivet_by_rule | rivet
    if own_shape:
        parameters = scaling.scaled_parameters(
            Z, D, d_m, given, whole, data.get("bore"), data.get("width"), designation
        )
        if "bore" in data and (P_d := catalogue.clearance(data["bore"])) is not None:
            parameters["bearing.P_d"] = P_d
        seats = {"ring.bore": "bore", "ring.outside": "outside_diameter"}
        parameters |= {name: data[key] for name, key in seats.items() if key in data}
        parameters["cage.material"] = given.get("cage.material", materials.PARTS["cage"].material)
        by_rule = scaling.scaled_inputs(Z, D, d_m, inputs, data.get("C"))
    else:
        known = {name: value for name, value in defaults().items() if name not in ("cage.m", "cage.rho")} | given
        parameters = scaling.scaled_joint(whole) | scaling.half_inertia({"Z": Z} | known, whole)
        parameters = {name: value for name, value in parameters.items() if value != scaling.start(name)}
        rivet_by_rule = {name: value for name, value in rivet_by_rule.items() if value != RIVET[name]}
        by_rule = {}
    parameters |= scaling.scaled_materials(given) | scaling.oil_by_points(given)
    settle = scaling.settling((by_rule | inputs).get("shaft.omega", variables.INPUTS["shaft.omega"].start))
    if settle != scaling.start("start.settle"):
        parameters["start.settle"] = settle
    by_rule |= dict.fromkeys(oil.PARTS_TEMPERATURES, inputs.get("oil.T", variables.INPUTS["oil.T"].start))
    parameters, by_rule = (
        {name: value for name, value in found.items() if name not in own}
        for found, own in ((parameters, given), (by_rule, inputs))
    )
    return Z, parameters, rivet_by_rule, by_rule


def limited_values(Z, given, rivet, inputs, data, entry):
    """All numbers that limits.LIMITS are about, given or by rule, by the names that it uses."""
    all_Z, by_rule, rivet_by_rule, _ = rules(Z, given, rivet, inputs, data, entry)
    numbers = {name: value for name, value in (defaults() | by_rule | given).items() if is_number(value)} | {"Z": all_Z}
    rivet = RIVET | rivet_by_rule | rivet
    return (
        numbers
        | {"cage.shape": given.get("cage.shape", CAGES[0])}
        | {f"rivet.{name}": value for name, value in rivet.items()}
        | {f"catalogue.{key}": value for key, value in data.items()}
    )


def in_cage(designation: str) -> str:
    """In whose cage a rivet's file does not fit, to stand behind a refusal."""
    return f", in the cage of the {designation}; --bearing names another one"


def check_limits(
    path: Path, document: dict[str, Any], parts: Any, names: Any = lambda name: name, inside: str = ""
) -> None:
    """UserError for a bearing that cannot be built, by the first limit that does not hold and a key that the user gave.

    parts: as of rules(); names: what the file calls a value; inside: in_cage of a rivet's file.
    """
    values = limited_values(*parts)
    broken = next((limit for limit in limits.limits_of(values) if not limits.holds(limit, values)), None)
    if broken is None:
        return
    written = {
        name: value
        for section in ("catalogue", "rivet")
        for name, value in flat(document.get(section, {}), f"{section}.")
    }
    written |= dict(flat(document.get("parameters", {}))) | {key: document[key] for key in ("Z",) if key in document}
    own = [
        name
        for name in written
        if is_number(values.get(name)) and name not in broken.keys and not name.startswith("oil.")
    ]
    keys = [*(key for key in broken.keys if key in written), *own, *(key for key in broken.keys if key not in written)]
    for key in keys:
        allowed = limits.bound(broken, values[key], lambda value, key=key: limited_values(*changed(parts, key, value)))
        if allowed:
            words, number = allowed
            others = ", ".join(
                f"{names(name)} = {shown(name, values[name], written.get(name))}" for name in broken.keys if name != key
            )
            reason = f"{words} {shown(key, number, written.get(key), words)} is allowed for {broken.reason}{f', with {others}' if others else ''}{inside}"
            if key in OF_HEAD and key not in written and "rivet.head" in written:
                size = shown(key, values[key], None)
                raise refusal(
                    path, names("rivet.head"), written["rivet.head"], f"{names(key)} is {size} by it; {reason}"
                )
            raise refusal(path, names(key), written.get(key, values[key]), reason)
    raise refusal(path, names(keys[0]), written.get(keys[0], values[keys[0]]), f"impossible: {broken.reason}{inside}")


def check_guidance(path, values):
    """UserError for a cage that its shape does not let be guided as the values say."""
    cage = SimpleNamespace(
        shape=variables.CageShape[values["cage.shape"].upper()],
        guidance=variables.CageGuidance[values["cage.guidance"].upper()],
    )
    for limit in LIMITS:
        if limit.quantity == "cage.guidance" and not limit.holds(SimpleNamespace(cage=cage), variables.Z):
            allowed = f"{limit.allowed} is allowed for {limit.reason}"
            raise refusal(path, "cage.guidance", values["cage.guidance"], allowed)


def changed(parts, key, value):
    """The parts of a bearing file with one value given."""
    Z, given, rivet, inputs, data, entry = parts
    group, _, name = key.partition(".")
    if key == "Z":
        Z = value
    elif group == "rivet":
        rivet = rivet | {name: value}
    elif group == "catalogue":
        data = data | {name: value}
    else:
        given = given | {key: value}
    return Z, given, rivet, inputs, data, entry
