"""Values that nobody gave and that the rivets' stress moves with, and who gave the others.

Ranges of the 6207's own values stand in fmus/variables.toml, those of values by rule in data/rules.csv, which
benchmarks/rules.py writes with docs/own_bearing.md.  The change of the stress over a range is another one in each bearing:
that of the 6207 is said of the 6207 alone, that of the 6309 decides which values by rule are named.
"""

import csv
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache
from importlib.resources import files
from typing import Any

from bearing_model.generated import variables

from ..base.units import suffix
from .oil import name_of
from .origin import EXAMPLE
from .ribbon import is_guided_by_balls, is_ribbon

RULES = files("riveted_bearing") / "data" / "rules.csv"
OF_RULES = "6309"  # in which benchmarks/rules.py measures the effects of values by rule
OF_BRONZE = ("cage.mu", "cage.mu_land", "cage.modal_damping", "joint.mu")
OF_ASPERITIES = ("oil.sigma_race",)  # move no stress in full film, where the film ratio alone moves with them
MATTERS = 0.05  # change of the 6309's stress from which a value by rule is named: below it is within the seeds' scatter
TEMPERATURES = {  # usual range around the oil's temperature [K]
    "oil.T": (-25.0, 35.0, "oil from 60 to 120 degC, if it has 85 degC by assumption"),
    "cage.T": (-20.0, 25.0, "bearings that dissipate have parts 10 to 40 K apart"),
}
DEEPEST = 1.05  # clearance of a ribbon's pocket over that at which its sphere ends in the split


@dataclass(frozen=True)
class Effect:
    """Usual range of a value as factors of it, the change of the stress over it, and where the range comes from.

    stress: change of the worst head's 99.9 % quantile, over the quantile; None if it is not known in the bearing.
    """

    low: float
    high: float
    stress: float | None
    source: str

    @property
    def change(self):
        """The change of the stress in words, "" if it is not known."""
        if self.stress is None:
            return ""
        return f"{100 * self.stress:.0f} %" if self.stress >= 0.01 else "below 1 %"


@dataclass(frozen=True)
class Assumed:
    """An assumed value with its usual range in `unit`; value, low, high are None where the FMU does not hold the value,
    a dimension of the rivet.
    """

    name: str
    unit: str
    value: float | None
    low: float | None
    high: float | None
    effect: Effect

    @property
    def words(self):
        """Value and usual range, each with its unit."""
        if self.value is None:
            return "by rule", f"{self.effect.low:g} … {self.effect.high:g} times"
        unit = suffix(self.unit)
        return f"{self.value:.3g}{unit}", f"{self.low + 0.0:.3g} … {self.high + 0.0:.3g}{unit}"


@cache
def effects():
    """Effect by name of the values of the 6207, and by name of those by rule."""
    own = {name: Effect(*entry) for name, entry in variables.ASSUMPTIONS.items()}
    rows = csv.DictReader(RULES.read_text(encoding="utf-8").splitlines()[1:])
    by_rule = {
        row["name"]: Effect(*(float(row[key]) for key in ("low", "high", "stress")), row["source"]) for row in rows
    }
    return own, {name: effect for name, effect in by_rule.items() if name in own or effect.stress >= MATTERS}


def effects_of(given, example, parameters):
    """Effects of the values that were neither given nor follow from others; example: whether the bearing is the 6207,
    else those by rule are among them, and the changes of the stress are not known.
    """
    own, by_rule = effects()
    found = own if example else own | by_rule
    return {
        name: effect if example else replace(effect, stress=None)
        for name, effect in sorted(found.items(), key=lambda item: -item[1].stress)
        if not is_known(name, given, parameters)
    }


def assumed_rows(result: Any) -> Iterator[Any]:
    """The Assumed of a run, in the 6207 the strongest first; temperatures last."""
    about, parameters = result.about, result.parameters
    sizes, given = about.get("rivet", {}), set(about.get("given", ()))
    example = about.get("example", not (about.get("ruled") or about.get("not_given")))
    for name, effect in effects_of(given, example, parameters).items():
        if name.startswith("rivet."):
            yield assumed(name, "mm", 1e3, sizes.get(name), effect)
        elif name in parameters:
            unit = variables.PARAMETERS[name].display or variables.PARAMETERS[name].unit
            factor, _ = variables.UNITS[variables.PARAMETERS[name].unit][unit]
            yield assumed(name, unit, factor, parameters[name], effect, parameters)
    temperatures = {name: T - 273.15 for name, T in about.get("temperatures", {}).items()}
    for name, T in temperatures.items():
        low, high, source = TEMPERATURES[name]
        if name not in given:
            ends = min(T, temperatures["oil.T"] + low), max(T, temperatures["oil.T"] + high)
            yield Assumed(name, "degC", T, *ends, Effect(low, high, None, source))


def assumed(name, unit, factor, value, effect, parameters=None):
    """An Assumed of a value in SI."""
    if value is None:
        return Assumed(name, unit, None, None, None, effect)
    return Assumed(name, unit, factor * value, *(factor * end for end in ends(name, value, effect, parameters)), effect)


def ends(name, value, effect, parameters):
    """Usual range of a value, SI."""
    return sorted((max(effect.low, least_share(name, parameters)) * value, effect.high * value))


def measured_in(rows: Any) -> Any:
    """Where the changes of the stress over the ranges of some Assumed were measured, in words."""
    if any(row.effect.stress is not None for row in rows):
        return f"measured at the working point of the {EXAMPLE}"
    return "not measured in this bearing: `riveted-bearing sensitivity` does it"


def assumed_ranges(model: Any, scene: Any = None) -> Any:
    """Usual ranges of the assumed parameters: {name: (lowest, highest)} in SI."""
    values = {name: model.default(variable) for name, variable in model.parameters.items()} | (
        scene.parameters if scene else {}
    )
    found = effects_of(given_names(model, scene), is_example(model), values)
    return {
        name: tuple(ends(name, values[name], effect, values))
        for name, effect in found.items()
        if name in model.parameters and (name not in OF_ASPERITIES or values.get("scene.lubrication") == "mixed")
    }


def assumed_as_bronze(result: Any) -> Any:
    """Values of a cage of bronze that nobody gave for one of another material, in words; "" for none."""
    known = {*result.about.get("given", ()), *result.about.get("ruled", ())}
    if result.parameters.get("cage.material", "bronze") == "bronze":
        return ""
    shown = (
        f"{name} {result.parameters[name]:g}"
        for name in OF_BRONZE
        if name in result.parameters
        and name not in known
        and not (name == "cage.mu_land" and is_guided_by_balls(result.parameters))
    )
    return ", ".join(shown)


def is_known(name, given, parameters):
    """Whether a parameter is given, or follows from others that are: the viscosity from both its points, the mixture's
    density from the flow of oil; or has no effect: the clearance of a land that a cage guided by its balls does not have.
    """
    follows = {
        "oil.eta": {"oil.nu_1", "oil.nu_2"} <= given,
        "oil.rho_mix": "oil.flow" in given and parameters["oil.flow"] > 0.0,
        "cage.guide_clearance": is_guided_by_balls(parameters),
    }
    return name in given or follows.get(name, False)


def least_share(name, values):
    """Least part of a value that the other ones leave room for: a ribbon's pocket is no deeper than its sphere."""
    if name != "cage.pocket_clearance" or not is_ribbon(values):
        return 0.0
    least = 2.0 * values["cage.pocket_depth"] - values["bearing.D"]
    return DEEPEST * least / values[name]


def given_names(model: Any, scene: Any = None) -> Any:
    """Names of the values that a scene or the bearing's own file gives, those of an oil that they name among them."""
    of_file = {name for name, origin in model.origin.items() if origin == "yours" or name_of({name: origin})}
    return of_file | {*(scene.parameters if scene else ()), *(given_inputs(scene) if scene else ())}


def given_inputs(scene):
    """Names of the inputs that a scene gives; parts that are as warm as its oil by rule are not among them."""
    oil = scene.inputs.get("oil.T")
    return {name for name, history in scene.inputs.items() if name == "oil.T" or history is not oil}


def is_example(model: Any) -> Any:
    """Whether an FMU is that of the 6207 as it is shipped."""
    return model.bearing.startswith(EXAMPLE) and "yours" not in model.origin.values()


def ruled_names(model: Any) -> Any:
    """Names of the values that follow from the bearing's file by rule and that nothing else sets."""
    return {name for name, origin in model.origin.items() if origin == "rule"}
