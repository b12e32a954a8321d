"""Values that nobody gave and that the rivets' stress moves with, who gave the others, and what a drawing allows of these.

Ranges of the 6207's own values stand in fmus/variables.toml, those of values by rule in data/rules.csv, which
benchmarks/rules.py writes with docs/own_bearing.md.  How far a range moves stress and damage is another amount in each bearing:
running/screening.py measures it in the FMU at hand, and without it no amount is told.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

from bearing_model.generated import variables

from ..base.shipped import csv_rows
from ..base.units import suffix
from .oil import name_of
from .origin import EXAMPLE
from .ribbon import is_guided_by_balls, is_ribbon

RULES = files("riveted_bearing") / "data" / "rules.csv"
OF_RULES = "6309"  # in which benchmarks/rules.py measures the effects of values by rule
OF_BRONZE = ("cage.mu", "cage.mu_land", "cage.modal_damping", "joint.mu")
OF_ASPERITIES = ("oil.sigma_race",)  # move no stress in full film, where the film ratio alone moves with them
OF_BUILD = ("cage.D_o", "cage.D_i", "cage.width")  # shape the stress table, as rivet.* do: another value needs a build
TEMPERATURES = {  # usual range around the oil's temperature [K]
    "oil.T": (-25.0, 35.0, "oil from 60 to 120 degC, if it has 85 degC by assumption"),
    "cage.T": (-20.0, 25.0, "bearings that dissipate have parts 10 to 40 K apart"),
}
DEEPEST = 1.05  # clearance of a ribbon's pocket over that at which its sphere ends in the split
SEEN = 2.0  # standard errors from which an effect is more than the seeds' scatter
YOURS = "your own range"
UNKNOWN = "unknown until riveted-bearing build --screen or sensitivity --quick measures it"


@dataclass(frozen=True)
class Range:
    """Usual range of a value as factors of it, and where the range comes from."""

    low: float
    high: float
    source: str


@dataclass(frozen=True)
class Assumed:
    """An assumed value with its usual range in `unit`, or a given one with a range of the user's own; value, low, high are None where
    the FMU does not hold the value, a dimension of the rivet.

    effect: changes of each figure at both ends with their standard errors, {"stress": [[-0.07, 0.01], [0.33, 0.02]]}: relative, of the
    damage in decades; None where it is not known, for the reason `unknown`.  screened: where it was measured.
    """

    name: str
    unit: str
    value: float | None
    low: float | None
    high: float | None
    source: str
    factors: tuple
    effect: Any = None
    unknown: str = UNKNOWN
    screened: str = ""

    @property
    def words(self):
        """Value and usual range, each with its unit."""
        if self.value is None:
            return "by rule", f"{self.factors[0]:g} … {self.factors[1]:g} times"
        unit = suffix(self.unit)
        return f"{self.value:.3g}{unit}", f"{self.low + 0.0:.3g} … {self.high + 0.0:.3g}{unit}"

    def size(self, figure):
        """Largest change of a figure, 0 for one that is not known or within the scatter."""
        return max((abs(e) for e, se in (self.effect or {}).get(figure, ()) if abs(e) > SEEN * se), default=0.0)

    def change(self, figure):
        """The change of a figure over the range in words, "" if it is not known."""
        pairs = (self.effect or {}).get(figure)
        if pairs is None:
            return ""
        percent = figure != "damage"
        unit, (low, high) = "%" if percent else "decades", sorted(100.0 * e if percent else e for e, _ in pairs)
        if not self.size(figure):
            noise = max(100.0 * se if percent else se for _, se in pairs)
            return f"within the seeds' ±{noise:.1g} {unit}" if noise else "none"
        least, digits = (1.0, ".0f") if percent else (0.1, ".1f")
        if max(high, -low) < least:
            return f"below {least:g} {unit}"
        ends = (min(low, 0.0), max(high, 0.0))
        texts = (f"{end:+{digits}}".replace("-", "−") if abs(end) >= 0.5 * least else "0" for end in ends)
        return f"{' … '.join(texts)} {unit}"


@cache
def ranges():
    """Range by name of the values of the 6207, and by name of those by rule."""
    own = {name: Range(*entry) for name, entry in variables.ASSUMPTIONS.items()}
    rows = csv_rows(RULES)
    return own, {row["name"]: Range(float(row["low"]), float(row["high"]), row["source"]) for row in rows}


def ranges_of(given: Any, example: bool, parameters: Any) -> dict[str, Range]:
    """Ranges of the values that nobody gave and that follow from no others; example: whether it is the 6207."""
    own, by_rule = ranges()
    found = own if example else own | by_rule
    return {name: each for name, each in found.items() if not is_known(name, given, parameters)}


def is_of_build(name: str) -> bool:
    """Whether another value needs another FMU."""
    return name.startswith("rivet.") or name in OF_BUILD


def assumed_rows(result: Any, figure: str = "stress") -> list[Assumed]:
    """The Assumed of a run, those that move the figure most first; those without a known effect last."""
    rows = list(all_assumed(result.about, result.parameters))
    return sorted(rows, key=lambda row: (row.effect is None, -row.size(figure)))


def all_assumed(about: Any, parameters: Any) -> Iterator[Assumed]:
    """The Assumed of what a Result says of its FMU and its parameters, with the effects of the FMU's screening."""
    sizes, given = about.get("rivet", {}), set(about.get("given", ()))
    example = about.get("example", not (about.get("ruled") or about.get("not_given")))
    screening = about.get("screening") or {}
    temperatures = about.get("temperatures", {})
    own = own_ranges(about.get("ranges", {}), screening)
    for name, each in ranges_of(given, example, parameters).items():
        if name not in own and (name.startswith("rivet.") or name in parameters):
            unit, factor, _ = shown_in(name)
            value = sizes.get(name) if name.startswith("rivet.") else parameters[name]
            told = each.source, (each.low, each.high), *known_effect(name, screening)
            if value is None:
                yield Assumed(name, unit, None, None, None, *told)
            else:
                yield Assumed(name, unit, *(factor * x for x in (value, *ends(name, value, each, parameters))), *told)
    for name, (low, high, source) in TEMPERATURES.items():
        if name in temperatures and name not in given and name not in own:
            T, of_oil = (temperatures[n] - 273.15 for n in (name, "oil.T"))
            reached = min(T, of_oil + low), max(T, of_oil + high)
            yield Assumed(name, "degC", T, *reached, source, (low, high), *known_effect(name, screening))
    values = parameters | sizes | temperatures
    for name, pair in own.items():
        if name in values:
            unit, factor, offset = shown_in(name)
            value, low, high = (factor * x + offset for x in (values[name], *pair))
            yield Assumed(name, unit, value, low, high, YOURS, (low, high), *known_effect(name, screening))


def own_ranges(ranges: dict[str, Any], screening: dict[str, Any]) -> dict[str, Any]:
    """{name: (lowest, highest)} of the user's own ranges: those of a bearing's file, and of a study with which the FMU was screened."""
    entries = screening.get("entries", {}).items()
    return ranges | {name: (entry["low"], entry["high"]) for name, entry in entries if entry["source"] == YOURS}


def shown_in(name):
    """Unit in which people read a value, with factor and offset from SI."""
    if name.startswith("rivet."):
        return "mm", 1e3, 0.0
    variable = (variables.PARAMETERS | variables.INPUTS)[name]
    unit = variable.display or variable.unit
    return unit, *variables.UNITS[variable.unit][unit]


def known_effect(name, screening):
    """Effect of a value, why it is not known, and where it was measured."""
    if not screening:
        return None, UNKNOWN, ""
    if entry := screening["entries"].get(name):
        return entry["effect"], "", f"screened in this bearing at its own loads and speed, {screening['seeds']} seeds"
    return None, screening["not_covered"].get(name, UNKNOWN), ""


def ends(name, value, each, parameters):
    """Usual range of a value, SI, as far as the others leave room for it: a ribbon's pocket is no deeper than its sphere."""
    low = each.low
    if name == "cage.pocket_clearance" and is_ribbon(parameters):
        low = max(low, DEEPEST * (2.0 * parameters["cage.pocket_depth"] - parameters["bearing.D"]) / parameters[name])
    return sorted((low * value, each.high * value))


def measured_in(rows: Any) -> Any:
    """Where the changes of the figures over the ranges of some Assumed were measured, in words."""
    return next((row.screened for row in rows if row.effect), UNKNOWN)


def assumed_ranges(model: Any, scene: Any = None) -> Any:
    """Usual ranges of the assumed parameters that a run can set: {name: (lowest, highest)} in SI."""
    values = {name: model.default(variable) for name, variable in model.parameters.items()} | (
        scene.parameters if scene else {}
    )
    found = ranges_of(given_names(model, scene), is_example(model), values)
    return {
        name: tuple(ends(name, values[name], each, values))
        for name, each in found.items()
        if name in model.parameters
        and not is_of_build(name)
        and (name not in OF_ASPERITIES or values.get("scene.lubrication") == "mixed")
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
    """Whether a parameter is given, follows from others that are, or has no effect, as the clearance of no land."""
    follows = {
        "oil.eta": {"oil.nu_1", "oil.nu_2"} <= given,
        "oil.rho_mix": "oil.flow" in given and parameters["oil.flow"] > 0.0,
        "cage.guide_clearance": is_guided_by_balls(parameters),
    }
    return name in given or follows.get(name, False)


def given_names(model: Any, scene: Any = None) -> Any:
    """Names of the values that a scene or the bearing's own file gives, those of an oil that they name among them."""
    of_file = {name for name, origin in model.origin.items() if origin == "yours" or name_of({name: origin})}
    if scene is None:
        return of_file
    oil = scene.inputs.get("oil.T")  # parts that are as warm by rule are not given
    return of_file | {
        *scene.parameters,
        *(n for n, history in scene.inputs.items() if n == "oil.T" or history is not oil),
    }


def is_example(model: Any) -> Any:
    """Whether an FMU is that of the 6207 as it is shipped."""
    return model.bearing.startswith(EXAMPLE) and "yours" not in model.origin.values()
