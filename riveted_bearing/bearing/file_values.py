"""Values of a bearing file: units, limits and words of each."""

import math
from typing import Any

from bearing_model.generated import variables

from ..base.errors import UserError, refusal, refusing, unknown
from ..base.units import scales_of, suffix, symbol_of, to_si

BOUNDARY = ("bore", "outside_diameter", "width")
CATALOGUE = (*BOUNDARY, "C", "C_0")


def defaults():
    """Start values of the variable table, by item name where they belong to an enumeration."""
    return {
        name: named(variable, variable.start) for name, variable in (variables.PARAMETERS | variables.INPUTS).items()
    }


def shown(name, value, written, words=""):
    """A value in the unit that the user wrote, else in the one that people read; a bound on its allowed side."""
    if name == "Z":
        return f"{value}"
    unit = unit_of(name)
    read = (list(variables.UNITS[unit]) * 2)[1]  # in which people read it
    symbol = read if written is None else symbol_of(written) or unit
    factor, offset = unit_scales(unit).get(symbol, (1.0, 0.0))
    number = factor * value + offset
    if words:
        digits = 3 - math.floor(math.log10(abs(number) or 1.0))
        to_side, rest = (math.floor, 1e-9) if words == "at most" else (math.ceil, -1e-9)
        number = to_side(number * 10.0**digits + rest) / 10.0**digits
    return f"{number:.4g}{suffix(symbol)}"


def unit_of(name):
    """SI unit of a parameter, a rivet's dimension or a catalogue value."""
    if name in variables.PARAMETERS:
        return variables.PARAMETERS[name].unit
    group, _, key = name.partition(".")
    if group == "rivet":
        return rivet_unit(key)
    return "m" if key in BOUNDARY else "N"


def rivet_unit(key):
    """SI unit of a dimension or material constant of the rivet."""
    if key.startswith(("E_", "yield_", "hardening_")):
        return "Pa"
    # alpha: 1/K, without a symbol of its own
    return {"nu": "1", "alpha": "1", "T": "K"}.get(key.partition("_")[0], "m")


def unit_scales(unit: str) -> Any:
    """Symbols that a text may carry for an SI unit, with their (factor, offset)."""
    return scales_of(unit, variables.UNITS[unit])


def start_values(path, section, tree, known):
    """Full names and values of one section of a bearing file, each checked."""
    for name, value in flat(tree):
        other = "inputs" if name in variables.INPUTS else "parameters" if name in variables.PARAMETERS else section
        if other != section:
            raise UserError(f"{path}: {section}.{name}: does not belong into [{section}] but into [{other}]")
        if name not in known:
            raise unknown(path, section.removesuffix("s"), name, known)
        variable = known[name]
        plain = variable.type in ("Real", "Integer")
        items = [] if plain else [item.name.lower() for item in getattr(variables, variable.type)]
        if items and value not in items:
            raise refusal(path, f"{section}.{name}", value, f"allowed: {', '.join(items)}")
        written = value
        with refusing(path, f"{section}.{name}", value):
            value = to_si(value, unit_scales(variable.unit)) if isinstance(value, str) and not items else value
        low = -math.inf if variable.min is None else variable.min
        high = math.inf if variable.max is None else variable.max
        whole = variable.type == "Integer"
        if not items and not (is_number(value) and low <= value <= high and (isinstance(value, int) or not whole)):
            what, text = ("an integer", "") if whole else ("a number", ", or a text with its unit")
            reason = f"not {what} in {span(low, high, variable.unit, symbol_of(written))}{text}"
            raise refusal(path, f"{section}.{name}", written, reason)
        yield name, value


def span(low, high, unit, symbol):
    """The limits of a value in the unit that the user wrote, else in SI."""
    symbol = symbol or unit
    factor, offset = unit_scales(unit)[symbol]
    return f"{factor * low + offset:.4g} ... {factor * high + offset:.4g}{suffix(symbol)}"


def named(variable, value):
    """A value, by item name if it belongs to an enumeration."""
    return value if variable.type in ("Real", "Integer") else getattr(variables, variable.type)(value).name.lower()


def is_number(value: Any) -> Any:
    """Whether a TOML value is a finite number."""
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def flat(tree, prefix=""):
    """Full names and values of nested tables."""
    for key, value in tree.items():
        if isinstance(value, dict):
            yield from flat(value, f"{prefix}{key}.")
        else:
            yield f"{prefix}{key}", value
