"""The FMU's variables for readers: the essential ones, and those that match a pattern."""

import math
import re
from fnmatch import fnmatchcase
from typing import Any

from bearing_model.generated import variables
from bearing_model.generated.variables import ESSENTIALS, INPUTS, LOCALS, OUTPUTS, PARAMETERS

from .errors import unknown
from .units import suffix

KINDS = {"Inputs": INPUTS, "Parameters": PARAMETERS, "Outputs": OUTPUTS, "Locals": LOCALS}
KNOWN = INPUTS | PARAMETERS | OUTPUTS | LOCALS


def variable_of(name: str) -> Any:
    """The variable of a name in the table, where those of an array have one entry; None for an unknown name."""
    names = (re.sub(r"\[\d+\]", index, name) for index in ("[j]", "[k]", "[n]"))
    return next((KNOWN[known] for known in names if known in KNOWN), None)


def essentials() -> Any:
    """The essential variables by question."""
    return {title: [KNOWN[name] for name in names] for title, names in ESSENTIALS.items()}


def is_like(text: str, pattern: Any) -> bool:
    """Whether a text matches a pattern in which * stands for any text, and brackets for themselves."""
    return fnmatchcase(text, re.sub(r"[\[?]", r"[\g<0>]", pattern))


def matching(pattern: Any) -> Any:
    """Variables by kind whose name matches a pattern with *, or whose name or description contains it; or UserError."""
    general = re.sub(r"\[\d+\]", "[*]", pattern)  # ball[3].Q_i is one of ball[j].Q_i
    pattern_or_word = general if "*" in general else f"*{general}*"

    def fits(text):
        return is_like(text.lower(), pattern_or_word.lower())

    found = {
        title: [v for v in known.values() if fits(v.name) or ("*" not in general and fits(v.description))]
        for title, known in KINDS.items()
    }
    if not any(found.values()):
        raise unknown("variables", "name or word", pattern, KNOWN)
    return {title: listed for title, listed in found.items() if listed}


def row(variable: Any, model: Any = None) -> Any:
    """Name, kind, unit, start (of `model`, if given), limits and description in the unit in which people read it."""
    kind = next(title for title, known in KINDS.items() if variable.name in known).removesuffix("s").lower()
    symbol = variable.display or variable.unit
    start = allowed = ""
    if variable.name in INPUTS | PARAMETERS:
        first, value = re.sub(r"\[[jkn]\]", "[1]", variable.name), variable.start
        if model is not None:
            value = model.default((model.parameters | model.inputs)[first])
        if variable.type in ("Real", "Integer"):
            start = shown(value, variable)
            allowed = f"{shown(variable.min, variable, -math.inf)} ... {shown(variable.max, variable, math.inf)}"
        else:
            items = getattr(variables, variable.type)
            start = items(value).name.lower() if model is None else value
            allowed = ", ".join(item.name.lower() for item in items)
    return variable.name, kind, suffix(symbol).strip(), start, allowed, variable.description


def shown(value, variable, otherwise=0.0):
    """A value in the variable's display unit, without its symbol."""
    factor, offset = variables.UNITS[variable.unit][variable.display or variable.unit]
    return f"{factor * (otherwise if value is None else value) + offset:.6g}"
