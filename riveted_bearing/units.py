"""Values with units: "18238 rev/min" becomes 1909.9 rad/s, or an error.

The units are those of the FMU (fmus/variables.toml, [units]).  A text must carry a unit of its own variable, so that 3600 rev/min cannot pass for
3600 rad/s; a bare number is SI.
"""

import math
import re
from numbers import Real

from .errors import UserError

SPELLINGS = {"rpm": "rev/min", "r/min": "rev/min", "1/min": "rev/min", "µm": "um", "μm": "um", "°": "deg", "°C": "degC", "Nm": "N.m", "mPas": "mPa.s"}
MULTIPLES = {"N": {"kN": (1e-3, 0.0)}, "s": {"us": (1e6, 0.0)}}  # in addition to the display units of the variable table
NUMBER = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*?)\s*")


def unit_table(unit_definitions):
    """For each unit of a model description its scales: symbol -> (factor, offset), value in that symbol = factor * SI + offset."""
    return {
        unit.name: {unit.name: (1.0, 0.0)}
        | {display.name: (float(display.factor), float(display.offset)) for display in unit.displayUnits}
        | MULTIPLES.get(unit.name, {})
        for unit in unit_definitions
    }


def suffix(symbol):
    """A unit as it stands behind a number: nothing for 1."""
    return "" if symbol in ("1", "") else f" {symbol}"


def scale(symbol, scales):
    """Factor and offset of a unit's symbol; UserError if the variable has no such unit."""
    symbol = symbol.replace("·", ".").replace("*", ".") or "1"
    symbol = SPELLINGS.get(symbol, symbol)
    if symbol not in scales:
        complaint = "a text needs a unit" if symbol == "1" else f'unit "{symbol}" does not fit'
        raise UserError(f"{complaint}; allowed: {', '.join(scales)}")
    return scales[symbol]


def to_si(value, scales):
    """SI value of a number (SI already) or of a text with a unit: 0.01, "10 mm".

    Raises UserError for a text without a unit, a unit that does not fit, or anything that is not a finite number.
    """
    if isinstance(value, str):
        match = NUMBER.fullmatch(value)
        if not match:
            raise UserError("not a number" if list(scales) == ["1"] else f'not a number with a unit such as "1.5 {list(scales)[-1]}"')
        factor, offset = scale(match[2], scales)
        value = (float(match[1]) - offset) / factor
    if isinstance(value, bool) or not isinstance(value, Real) or not math.isfinite(value):
        raise UserError("not a finite number")
    return float(value)
