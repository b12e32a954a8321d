"""Inputs over time: constants, points or columns of tables, checked against the FMU's variables."""

import reprlib
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..base.errors import UserError, shortlist
from ..base.toml_files import seconds
from ..base.units import SECONDS, canonical, check_alike, scale, symbol_of, to_si

HISTORY = ("t", "value", "unit", "interpolation")
COLUMN = ("file", "column", "time", "unit", "interpolation", "longest_gap")


@dataclass(frozen=True)
class History:
    """An input over time: straight lines or, with hold, steps; constant before the first and after the last point."""

    t: np.ndarray
    value: np.ndarray
    hold: bool = False

    def __call__(self, t):
        """Values at the times t [s]."""
        if self.hold:
            return self.value[np.maximum(np.searchsorted(self.t, t, side="right") - 1, 0)]
        return np.interp(t, self.t, self.value)

    def reached(self, end):
        """The values that it has from 0 to the time `end` [s]."""
        inside = self.value[(self.t > 0.0) & (self.t < end)]
        return np.concatenate([inside, self(np.array([0.0, end]))])

    def changing_time(self):
        """First and last time [s] of its changes; None if it is constant."""
        if np.ptp(self.value) == 0.0:
            return None
        first = int(np.argmax(self.value != self.value[0]))
        last = len(self.t) - 1 - int(np.argmax(self.value[::-1] != self.value[-1]))
        return float(self.t[first if self.hold else first - 1]), float(self.t[last + 1])


def histories_of(about: dict[str, Any]) -> dict[str, History]:
    """The inputs of a run by name, of what a Result says of it."""
    found = about.get("inputs", {}).items()
    return {name: History(np.array(of["t"]), np.array(of["value"]), of["hold"]) for name, of in found}


def unit_of(value):
    """The unit that the user wrote with a value or a history; None for numbers."""
    return canonical(value["unit"]) if isinstance(value, dict) and value.get("unit") else symbol_of(value)


def input_history(value, variable, model, folder):
    """The History of an input from a constant, points or a column of a file."""
    scales = model.units[variable.unit]
    if not isinstance(value, dict):
        history = History(np.zeros(1), np.array([to_si(value, scales)]))
    elif "file" in value:
        history = from_column(value, scales, folder)
    else:
        history = from_points(value, scales)
    if len(history.t) != len(history.value) or not len(history.t):
        raise UserError(f"as many times as values are needed, got {len(history.t)} and {len(history.value)}")
    if not np.all(np.isfinite(history.t)) or not np.all(np.isfinite(history.value)):
        raise UserError("not all times and values are finite numbers")
    if not np.all(np.diff(history.t) > 0.0):
        raise UserError("the times do not increase")
    for extreme in (history.value.min(), history.value.max()):
        model.check_range(extreme, variable, unit_of(value))
    return history


def from_points(value, scales):
    """A History from { t = [...], value = [...] }."""
    check_entries(value, HISTORY, ("t", "value"))
    if not all(isinstance(value[key], (list, tuple, np.ndarray)) for key in ("t", "value")):
        raise UserError("t and value must be lists")
    factor, offset = scale(value["unit"], scales) if "unit" in value else (1.0, 0.0)
    if "unit" not in value:
        check_alike(value["value"], scales)
    si = [
        to_si(entry, scales) if isinstance(entry, str) else (to_si(entry, scales) - offset) / factor
        for entry in value["value"]
    ]
    return History(np.array([to_si(entry, SECONDS) for entry in value["t"]]), np.array(si), is_hold(value))


def from_column(value, scales, folder):
    """A History from { file = "...", column = "..." }: a table with times in s or in the unit of their head."""
    from ..base import tables  # not for a run without files

    check_entries(value, COLUMN, ("file", "column"))
    gap = seconds("longest_gap", value["longest_gap"]) if "longest_gap" in value else None
    t, values = tables.Table(folder / value["file"]).series(
        tables.Wanted(value.get("time", "time"), SECONDS),
        tables.Wanted(value["column"], scales, value.get("unit", "")),
        gap=gap,
    )
    return History(t, values, is_hold(value))


def check_entries(value, allowed, needed):
    """Keys of an input's table: none unknown, none missing, texts where only t and value hold numbers."""
    for key, entry in value.items():
        if key not in allowed:
            raise UserError(f'unknown key "{key}"; allowed: {shortlist(allowed)}')
        if key not in ("t", "value", "longest_gap") and not isinstance(entry, str):
            raise UserError(f"{key} = {reprlib.repr(entry)}: not a text")
    for key in needed:
        if key not in value:
            raise UserError(f'"{key}" is missing; allowed: {shortlist(allowed)}')


def is_hold(value):
    """Whether an input's table asks for steps instead of straight lines."""
    kind = value.get("interpolation", "linear")
    if kind not in ("linear", "hold"):
        raise UserError(f'interpolation "{kind}"; allowed: linear, hold')
    return kind == "hold"
