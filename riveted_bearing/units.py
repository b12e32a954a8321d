"""Values with units: "18238 rev/min" becomes 1909.9 rad/s, or an error.

The units are those of the FMU (fmus/variables.toml, [units]) and those of workshops and catalogues (MULTIPLES).  A text
must carry a unit of its own variable, so that 3600 rev/min cannot pass for 3600 rad/s; a bare number is SI.
"""

import math
import re
from numbers import Real

from .errors import UserError

# m, kg, m/s2: exact by definition; rev/min per rad/s
INCH, POUND, GRAVITY, RPM = 0.0254, 0.45359237, 9.80665, 30.0 / math.pi
SPELLINGS = {  # symbol -> how else people write it
    "rev/min": "rpm r/min 1/min min-1",
    "krpm": "krev/min",
    "um": "µm μm micron",
    "in": 'inch inches "',
    "deg": "°",
    "degC": "°C C",
    "degF": "°F F",
    "kgf": "kp",
    "N.m": "Nm",
    "N.mm": "Nmm",
    "MPa": "N/mm2 N/mm²",
    "m2/s": "m²/s",
    "mm2/s": "mm²/s cSt",
    "kg/m3": "kg/m³",
    "g/cm3": "g/cm³",
    "m/s2": "m/s²",
    "L/min": "l/min",
    "Pa.s": "Pas",
    "mPa.s": "mPas",
    "s": "sec",
}
SYMBOLS = {spelling: symbol for symbol, spellings in SPELLINGS.items() for spelling in spellings.split()}
# in addition to the display units of the variable table: value in that symbol = factor * SI value + offset
MULTIPLES = {
    "m": {"cm": (1e2, 0.0), "in": (1.0 / INCH, 0.0)},
    "N": {"kN": (1e-3, 0.0), "kgf": (1.0 / GRAVITY, 0.0), "lbf": (1.0 / (POUND * GRAVITY), 0.0)},
    "N.m": {"N.mm": (1e3, 0.0), "kN.m": (1e-3, 0.0)},
    "rad": {"mrad": (1e3, 0.0)},
    "rad/s": {"krpm": (1e-3 * RPM, 0.0), "rev/s": (RPM / 60.0, 0.0)},
    "Pa": {"bar": (1e-5, 0.0), "psi": (INCH**2 / (POUND * GRAVITY), 0.0)},
    "Pa.s": {"cP": (1e3, 0.0)},
    "kg": {"lb": (1.0 / POUND, 0.0)},
    "kg/m3": {"g/cm3": (1e-3, 0.0)},
    "s": {"us": (1e6, 0.0), "min": (1.0 / 60.0, 0.0), "h": (1.0 / 3600.0, 0.0)},
    "K": {"degF": (1.8, -459.67)},
    "1": {"%": (1e2, 0.0)},
}
SECONDS = {"s": (1.0, 0.0), "ms": (1e3, 0.0)} | MULTIPLES["s"]
SHORT = 0.1  # h: a shorter life is told in minutes or seconds
LONGEST = 1e6  # h: a longer life is no figure to tell
NUMBER = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*((?:1/|[^\d.,\s]).*?)?\s*")


def unit_table(unit_definitions):
    """For each unit of a model description its scales: symbol -> (factor, offset), value in that symbol = factor * SI +
    offset.
    """
    return {
        unit.name: scales_of(unit.name, {d.name: (float(d.factor), float(d.offset)) for d in unit.displayUnits})
        for unit in unit_definitions
    }


def scales_of(unit, displays):
    """Scales of an SI unit: its own, those of its display units, and its MULTIPLES."""
    return {unit: (1.0, 0.0)} | displays | MULTIPLES.get(unit, {})


def canonical(symbol):
    """A unit's symbol as the tables spell it."""
    symbol = symbol.strip()
    symbol = SYMBOLS.get(symbol, symbol).replace("·", ".").replace("*", ".") or "1"
    return SYMBOLS.get(symbol, symbol)


def symbol_of(value):
    """The unit that the user wrote: its canonical symbol, None for a number."""
    match = NUMBER.fullmatch(value) if isinstance(value, str) else None
    return canonical(match[2] or "") if match else None


def suffix(symbol):
    """A unit as it stands behind a number: nothing for 1."""
    return "" if symbol in ("1", "") else f" {symbol}"


def scale(symbol, scales):
    """Factor and offset of a unit's symbol; UserError if the variable has no such unit."""
    symbol = canonical(symbol)
    if symbol not in scales:
        complaint = "a text needs a unit" if symbol == "1" else f'unit "{symbol}" does not fit'
        raise UserError(f"{complaint}; allowed: {', '.join(scales)}")
    return scales[symbol]


def hours_text(hours):
    """A life in hours, minutes or seconds with three digits, or that it is longer than LONGEST."""
    if not math.isfinite(hours):
        return "no damage"
    if hours > LONGEST:
        return "> 1e6 h"
    if hours < SHORT:
        return f"{3600.0 * hours:.3g} s" if hours < 1.0 / 60.0 else f"{60.0 * hours:.3g} min"
    return f"{hours:.3g} h" if hours < 1e3 else f"{round(hours, 2 - math.floor(math.log10(hours))):,.0f} h"


def to_si(value, scales):
    """SI value of a number (SI already) or of a text with a unit: 0.01, "10 mm".

    Raises UserError for a text without a unit, a unit that does not fit, or anything that is not a finite number.
    """
    if isinstance(value, str):
        match = NUMBER.fullmatch(value)
        if not match:
            raise UserError(
                "not a number"
                if "1" in scales
                else f'not a number with a unit such as "1.5 {list(scales)[min(1, len(scales) - 1)]}"'
            )
        factor, offset = scale(match[2] or "", scales)
        value = (float(match[1]) - offset) / factor
    if isinstance(value, bool) or not isinstance(value, Real) or not math.isfinite(value):
        raise UserError("not a finite number")
    return float(value)
