"""Values with units: "18238 rev/min" becomes 1909.9 rad/s, or an error.

A unit is read by its atoms, prefixes and powers: "kN", "mm/s", "lbf.in", "µm", "min^-1".  It must have the dimension of
its variable, so that 3600 rev/min cannot pass for 3600 rad/s; a bare number is SI.  The angle is a dimension of its own,
as in FMI: a library that drops it reads 1/min as 1/60 rad/s.  What a symbol means may depend on the quantity (g: gram or
gravity; lb: mass or force; 1/min: revolutions where a speed is wanted); 1/s and Hz are no speed, for they may be either.
"""

from __future__ import annotations

import math
import re
import tomllib
from functools import cache
from importlib.resources import files
from numbers import Real
from typing import Any

from .errors import UserError

# m/s2, exact by definition; rev/min per rad/s
GRAVITY, RPM = 9.80665, 30.0 / math.pi
BASE = ("kg", "m", "s", "K", "rad")
PREFIXES = {"T": 1e12, "G": 1e9, "M": 1e6, "k": 1e3, "K": 1e3, "h": 1e2, "da": 1e1, "d": 1e-1, "c": 1e-2, "m": 1e-3}
PREFIXES |= {"u": 1e-6, "n": 1e-9, "p": 1e-12}
WORD_PREFIXES = {"giga": 1e9, "mega": 1e6, "kilo": 1e3, "centi": 1e-2, "milli": 1e-3, "micro": 1e-6, "nano": 1e-9}
TABLE = tomllib.loads((files("riveted_bearing") / "data" / "units.toml").read_text(encoding="utf-8"))
PREFIXED, PLAIN = (  # symbol -> exponents of BASE and SI value
    {symbol: (tuple(TABLE["quantities"][of]), value) for symbol, (of, value, *_) in TABLE[part].items()}
    for part in ("prefixed", "plain")
)
ATOMS = PREFIXED | PLAIN
NAMED = TABLE["prefixed"] | TABLE["plain"]
ALIASES = {name: symbol for symbol, (_, _, *names) in NAMED.items() for name in " ".join(names).split()}
REVOLUTION = 2.0 * math.pi
# what a symbol means where another quantity than its own is wanted: SI unit -> {symbol: SI value}
MEANT = {
    "m/s2": {"g": GRAVITY, "G": GRAVITY, "gn": GRAVITY, "g0": GRAVITY, "mg": 1e-3 * GRAVITY, "ug": 1e-6 * GRAVITY},
    "rad/s": {"1/min": REVOLUTION / 60.0, "min-1": REVOLUTION / 60.0, "/min": REVOLUTION / 60.0, "rps": REVOLUTION},
    "1": {"-": 1.0},
}
AS_FORCE = {"lb": "lbf", "oz": "ozf"}  # where a pound of mass does not fit
TEMPERATURES = {  # symbol -> (factor, offset): value in it = factor * K + offset
    "degC": (1.0, -273.15),
    "degF": (1.8, -459.67),
}
SYMBOLS = {name: symbol for symbol, names in TABLE["spellings"].items() for name in names.split()}
WRITTEN = str.maketrans("µμ·⋅×*−℃", "uu....-C") | {ord("²"): "2", ord("³"): "3", ord("⁻"): "-", ord("¹"): "1"}
TERM = re.compile(r"([^\d^+\-()]+)\^?([+-]?\d+(?:\.\d+)?)?")
SHORT = 0.1  # h: a shorter life is told in minutes or seconds
LONGEST, SHORTEST = 1e6, 1.0 / 3600.0  # h: a longer or shorter life is no figure to tell
NUMBER = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*((?:1/|[^\d.,\s]).*?)?\s*")


class Scales(dict):
    """The units of a quantity: symbol -> (factor, offset), value in that symbol = factor * SI + offset.  The SI unit
    stands first; the others listed are those to show, and every other symbol of the dimension is found too.
    """

    def __missing__(self, symbol):
        if (found := conversion(symbol, next(iter(self)))) is None:
            raise KeyError(symbol)
        return found

    def __contains__(self, symbol):
        return super().__contains__(symbol) or conversion(symbol, next(iter(self))) is not None

    def get(self, symbol, default=None):
        return self[symbol] if symbol in self else default


def unit_table(unit_definitions: Any) -> Any:
    """The Scales of each unit of a model description."""
    return {
        unit.name: scales_of(unit.name, {d.name: (float(d.factor), float(d.offset)) for d in unit.displayUnits})
        for unit in unit_definitions
    }


def scales_of(unit: str, displays: Any) -> Any:
    """Scales of an SI unit: its own, those of its display units, and its multiples in data/units.toml."""
    more = {symbol: conversion(symbol, unit) for symbol in TABLE["multiples"].get(unit, "").split()}
    return Scales({unit: (1.0, 0.0)} | displays | more)


def differences(scales: Any) -> dict[str, tuple[float, float]]:
    """Scales of a difference: without the offset of degrees Celsius."""
    return {symbol: (factor, 0.0) for symbol, (factor, _) in scales.items()}


def plain(symbol):
    """A unit in one way of writing: u for µ, a point between factors, digits for powers."""
    symbol = re.sub(r"\s+per\s+", "/", str(symbol or "").strip().translate(WRITTEN))
    symbol = re.sub(r"\.{2}(?=[+-]?\d)", "^", symbol).replace("^", "")  # ** and ^
    symbol = re.sub(r"\s*([./])\s*", r"\1", symbol)
    symbol = re.sub(r"\s+|(?<=[A-Za-z])-(?=[A-Za-z])", ".", symbol)
    return re.sub(r"^1/\((.*)\)$", r"1/\1", symbol)


def canonical(symbol: Any) -> str:
    """A unit's symbol as it is shown."""
    symbol = plain(symbol) or "1"
    return SYMBOLS.get(symbol, symbol)


def is_unit(symbol):
    """Whether a text is a unit of any quantity."""
    written = plain(symbol)
    known = written in TEMPERATURES or SYMBOLS.get(written) in TEMPERATURES or any(written in m for m in MEANT.values())
    return known or (written not in ("", "1") and parsed(written) is not None)


@cache
def conversion(symbol, base):
    """Factor and offset from the unit `base` to a symbol, None unless both measure the same quantity.

    >>> conversion("kN", "N"), conversion("kN", "m")
    ((0.001, 0.0), None)
    """
    if not isinstance(symbol, str) or not isinstance(base, str):
        return None
    written = plain(symbol)
    shown = SYMBOLS.get(written, written)
    if base == "K" and shown in TEMPERATURES:
        return TEMPERATURES[shown]
    if written in MEANT.get(base, {}):
        return 1.0 / MEANT[base][written], 0.0
    wanted = parsed(plain(base))
    for names in ({}, AS_FORCE):
        found = parsed(written, tuple(names.items()))
        if wanted and found and wanted[0] == found[0]:
            return wanted[1] / found[1], 0.0
    return None


@cache
def parsed(symbol, renamed=()):
    """Exponents of BASE and SI value of a unit like "kg.m/s2", None if it is none; all behind a / divides."""
    if re.search(r"\([^()]*/", symbol):
        return None
    exponents, value = [0.0] * len(BASE), 1.0
    for place, part in enumerate(re.sub(r"[()]", "", symbol).split("/")):
        for term in re.split(r"\.(?!\d)", part):
            if term == "1" or (term == "" and part == "" and place == 0 and len(symbol) > 1):
                continue
            match = TERM.fullmatch(term)
            atom = atom_of(match[1], dict(renamed)) if match else None
            if atom is None:
                return None
            power = float(match[2] or 1) * (-1.0 if place else 1.0)
            exponents = [old + power * new for old, new in zip(exponents, atom[0], strict=True)]
            value *= atom[1] ** power
    return tuple(exponents), value


def atom_of(name, renamed):
    """Exponents and SI value of one symbol or word with its prefix, None if there is none."""
    symbol = ALIASES.get(name, name)
    symbol = renamed.get(symbol, symbol)
    if symbol in ATOMS:
        return ATOMS[symbol]
    for prefix in (name[:1], name[:2]):
        rest = name[len(prefix) :]
        if prefix in PREFIXES and rest in PREFIXED:
            return PREFIXED[rest][0], PREFIXES[prefix] * PREFIXED[rest][1]
    word = name.lower()
    factor = 1.0
    if prefix := next((one for one in WORD_PREFIXES if word.startswith(one)), ""):
        word, factor = word.removeprefix(prefix), WORD_PREFIXES[prefix]
    for spelled in (word, word.removesuffix("s")):
        if len(spelled) > 3 and (symbol := ALIASES.get(spelled)) in ATOMS and (not prefix or symbol in PREFIXED):
            return ATOMS[symbol][0], factor * ATOMS[symbol][1]
    return None


SECONDS = Scales(
    {"s": (1.0, 0.0), "ms": (1e3, 0.0), "us": (1e6, 0.0), "min": (1.0 / 60.0, 0.0), "h": (1.0 / 3600.0, 0.0)}
)


def symbol_of(value: Any) -> Any:
    """The unit that the user wrote: its canonical symbol, None for a number."""
    match = NUMBER.fullmatch(value) if isinstance(value, str) else None
    return canonical(match[2] or "") if match else None


def suffix(symbol: Any) -> str:
    """A unit as it stands behind a number: nothing for 1."""
    return "" if symbol in ("1", "") else f" {symbol}"


def scale(symbol: Any, scales: Any) -> Any:
    """Factor and offset of a unit's symbol; UserError if the variable has no such unit."""
    name = canonical(symbol)
    if name in scales:
        return scales[name]
    base = next(iter(scales))
    found = conversion(symbol, base)
    if found is None:
        complaint = "a text needs a unit" if name == "1" else f'unit "{str(symbol).strip()}" does not fit'
        raise UserError(f"{complaint}; allowed: {', '.join(scales)}")
    factor, offset = scales[base]
    return found[0] * factor, found[1] + found[0] * offset


def rounded(number: float, digits: int = 6) -> float:
    """A computed number with so many digits: six are enough for an assumption."""
    return float(f"{number:.{digits}g}")


def hours_text(hours: Any, digits: int = 3) -> str:
    """A life in hours, minutes or seconds with so many digits, or that it is longer than LONGEST or shorter than SHORTEST."""
    if not math.isfinite(hours):
        return "no damage"
    if hours > LONGEST:
        return "> 1e6 h"
    if 0.0 < hours < SHORTEST:
        return "< 1 s"
    if hours < SHORT:
        number, unit = (3600.0 * hours, "s") if hours < 1.0 / 60.0 else (60.0 * hours, "min")
    else:
        number, unit = hours, "h"
    if not number:
        return f"0 {unit}"
    rounded = round(number, digits - 1 - math.floor(math.log10(number)))
    return f"{rounded:.3g} {unit}" if rounded < 1e3 else f"{rounded:,.0f} {unit}"


def to_si(value: Any, scales: Any) -> float:
    """SI value of a number (SI already) or of a text with a unit, "10 mm"; UserError for anything that is not a finite one."""
    if isinstance(value, str):
        match = NUMBER.fullmatch(value)
        if not match:
            example = f' with a unit such as "1.5 {list(scales)[min(1, len(scales) - 1)]}"'
            raise UserError(f"not a number{'' if '1' in scales else example}")
        factor, offset = scale(match[2] or "", scales)
        value = (float(match[1]) - offset) / factor
    if isinstance(value, bool) or not isinstance(value, Real) or not is_finite(value):
        raise UserError("not a finite number")
    return float(value)


def check_alike(values: Any, scales: Any) -> None:
    """UserError if a bare number stands beside a text with a unit other than SI and is nearer to that text's number than to
    its SI value: few who write ["4000 rev/min", 9000] mean 9000 rad/s, but ["1 kN", 2000] is 2000 N.  Times are s beside
    any unit.
    """
    base = next(iter(scales))
    if base in ("1", "s"):
        return
    texts = [one for one in values if isinstance(one, str) and symbol_of(one) not in (None, "1", canonical(base))]
    found = {text: NUMBER.fullmatch(text) for text in texts if symbol_of(text) in scales}  # others are refused later
    given = {text: (abs(float(match[1])), abs(to_si(text, scales))) for text, match in found.items() if match}
    given = {text: pair for text, pair in given.items() if all(pair)}
    for bare in (
        one for one in values if isinstance(one, Real) and not isinstance(one, bool) and one and is_finite(one)
    ):
        apart = [[abs(math.log(abs(bare)) - math.log(size)) for size in pair] for pair in given.values()]
        if apart and min(own for own, _ in apart) < min(si for _, si in apart):
            raise UserError(f'{bare:g} has no unit beside "{next(iter(given))}": write it at both')


def is_finite(number):
    """Whether a number is finite as a float: an integer may have more digits."""
    try:
        return math.isfinite(number)
    except OverflowError:
        return False


def figure(value: Any) -> str:
    """A number with four digits, thousands apart."""
    if isinstance(value, int) or (math.isfinite(value) and value == round(value) and 1e4 <= abs(value) < 1e7):
        return f"{value:,.0f}" if abs(value) >= 1e4 else f"{value:g}"
    return f"{value:,.0f}" if 1e4 <= abs(value) < 1e7 else f"{value:.4g}"


def duration(seconds: float) -> str:
    """A life in hours, in seconds if it is short."""
    return f"{figure(seconds)} s" if seconds < 360.0 else hours_text(seconds / 3600.0)


def with_error(value: float, half: float, below: float | None = None, above: float | None = None) -> str:
    """A value with the half-width of its interval, of which two digits are told: 290 ± 12; where the ends lie at different
    distances both are told: 290 (−12 … +35).

    >>> with_error(289.5, 12.3), with_error(289.5, 20.0, 12.0, 28.0)
    ('290 ± 12', '290 (−12 … +28)')
    """
    if not half > 0.0 or not math.isfinite(half):
        return f"{value:.3g} ± 0" if half == 0.0 else f"{value:.3g}"
    place = math.floor(math.log10(half)) - 1
    shown, *ends = (placed(x, place) for x in (value, half, below or half, above or half))
    lopsided = below is not None and above is not None and abs(above - below) > 0.1 * half
    return f"{shown} (−{ends[1]} … +{ends[2]})" if lopsided else f"{shown} ± {ends[0]}"


def certain(value: float, half: float) -> str:
    """A value alone with the digits that the half-width of its interval leaves: those above its first one.

    >>> certain(289.5, 12.3), certain(289.5, 3.0), certain(0.0, 0.0)
    ('290', '290', '0')
    """
    if not half > 0.0 or not math.isfinite(half):
        return f"{value:.3g}"
    return placed(value, math.floor(math.log10(half)))


def placed(value: float, place: int) -> str:
    """A value rounded to a power of ten, without a minus sign before zero."""
    return f"{round(value, -place) + 0.0:.{max(0, -place)}f}"
