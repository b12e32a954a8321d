"""Values that nobody gave and that the rivets' stress moves with, and who gave the others.

Effects are measured: those of the 6207's own values in fmus/variables.toml, those of values by rule in data/rules.csv,
which benchmarks/rules.py writes with docs/rules.md.
"""

import csv
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from bearing_model.generated import variables

from .origin import EXAMPLE
from .ribbon import is_guided_by_balls, is_ribbon

RULES = files("riveted_bearing") / "data" / "rules.csv"
OF_RULES = "6309"  # in which benchmarks/rules.py measures the effects of values by rule
OF_BRONZE = ("cage.mu", "cage.mu_land", "cage.modal_damping", "joint.mu")
MATTERS = 0.1  # change of the stress from which a value by rule is named; half of that is within the seeds' scatter
DEEPEST = 1.05  # clearance of a ribbon's pocket over that at which its sphere ends in the split


@dataclass(frozen=True)
class Effect:
    """Usual range of a value as factors of it, the change of the stress over it, where the range comes from, and the
    bearing in which the change was measured.

    stress: change of the worst head's 99.9 % quantile, over the quantile.
    """

    low: float
    high: float
    stress: float
    source: str
    bearing: str


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
        return f"{self.value:.3g} {self.unit}", f"{self.low + 0.0:.3g} … {self.high + 0.0:.3g} {self.unit}"


@cache
def effects():
    """Effect by name of the values of the 6207, and by name of those by rule."""
    own = {name: Effect(*entry, EXAMPLE) for name, entry in variables.ASSUMPTIONS.items()}
    rows = csv.DictReader(RULES.read_text(encoding="utf-8").splitlines()[1:])
    by_rule = {
        row["name"]: Effect(*(float(row[key]) for key in ("low", "high", "stress")), row["source"], OF_RULES)
        for row in rows
    }
    return own, {name: effect for name, effect in by_rule.items() if name in own or effect.stress >= MATTERS}


def effects_of(given, ruled, parameters):
    """Effects of the values that were neither given nor follow from others, the strongest first."""
    own, by_rule = effects()
    found = own | {name: effect for name, effect in by_rule.items() if name in ruled}
    return {
        name: effect
        for name, effect in sorted(found.items(), key=lambda item: -item[1].stress)
        if not is_known(name, given, parameters)
    }


def assumed_rows(result):
    """The Assumed of a run, the strongest first."""
    about, parameters = result.about, result.parameters
    sizes = about.get("rivet", {})
    for name, effect in effects_of(set(about.get("given", ())), set(about.get("ruled", ())), parameters).items():
        if name.startswith("rivet."):
            yield assumed(name, "mm", 1e3, sizes.get(name), effect)
        elif name in parameters:
            unit = variables.PARAMETERS[name].display or variables.PARAMETERS[name].unit
            factor, _ = variables.UNITS[variables.PARAMETERS[name].unit][unit]
            yield assumed(name, unit, factor, parameters[name], effect, parameters)


def assumed(name, unit, factor, value, effect, parameters=None):
    """An Assumed of a value in SI."""
    if value is None:
        return Assumed(name, unit, None, None, None, effect)
    return Assumed(name, unit, factor * value, *(factor * end for end in ends(name, value, effect, parameters)), effect)


def ends(name, value, effect, parameters):
    """Usual range of a value, SI."""
    return sorted((max(effect.low, least_share(name, parameters)) * value, effect.high * value))


def measured_in(rows):
    """Where the effects of some Assumed were measured, in words."""
    bearings = dict.fromkeys(row.effect.bearing for row in rows)
    texts = {EXAMPLE: f"at the working point of the {EXAMPLE}", OF_RULES: f"in the {OF_RULES} with a machined cage"}
    if len(bearings) < 2:
        return "".join(texts[bearing] for bearing in bearings)
    others = ", ".join(row.name for row in rows if row.effect.bearing == EXAMPLE)
    return f"{texts[OF_RULES]}, of {others} {texts[EXAMPLE]}"


def assumed_ranges(model, scene=None):
    """Usual ranges of the assumed parameters: {name: (lowest, highest)} in SI."""
    values = {name: model.default(variable) for name, variable in model.parameters.items()} | (
        scene.parameters if scene else {}
    )
    found = effects_of(given_names(model, scene), ruled_names(model), values)
    return {
        name: tuple(ends(name, values[name], effect, values))
        for name, effect in found.items()
        if name in model.parameters
    }


def assumed_as_bronze(result):
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


def given_names(model, scene=None):
    """Names of the parameters that a scene or the bearing's own file gives."""
    return {*(scene.parameters if scene else ()), *(name for name, origin in model.origin.items() if origin == "yours")}


def ruled_names(model):
    """Names of the values that follow from the bearing's file by rule and that nothing else sets."""
    return {name for name, origin in model.origin.items() if origin == "rule"}
