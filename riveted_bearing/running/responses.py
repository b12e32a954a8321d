"""Responses of runs by name, and the units in which people read them."""

import re
from pathlib import Path
from typing import Any

import numpy as np

from bearing_model.generated import variables

from ..base.errors import unknown
from ..base.variable_list import variable_of
from .summary import static_and_swing

COLUMNS = {
    "stress": "stat.sigma_head_p999",
    "static": "stat.rivet_head_mean[1]",  # of all rivets
    "swing": "stat.rivet_head_p999[1]",
    "dislocation": "max(cage.dislocation)",
    "friction": "mean(bearing.friction_torque)",
    "pocket_force": "stat.Q_c_rms",
}
PARTS = ("static", "swing")
DAMAGE_UNIT = "log10 per hour"
NO_DAMAGE = 1e-300


def response(path: Path, rows: Any, name: str) -> Any:
    """A response of all rows."""
    if name == "damage":
        damage = np.column_stack(
            [rows[column] for column in rows if column.startswith("rivet[") and ".damage_" in column]
        )
        hours = (rows["simulated_time"] - rows["start.settle"]) / 3600.0
        return np.log10(np.maximum(np.nanmax(np.nan_to_num(damage), axis=1) / np.maximum(hours, 1e-12), NO_DAMAGE))
    if name in PARTS:
        return static_and_swing(rows, "head")[PARTS.index(name)]
    column = COLUMNS.get(name, name)
    numbers = [key for key in rows if np.issubdtype(np.asarray(rows[key]).dtype, np.number)]
    if column not in numbers:
        raise unknown(path, "response", name, ["damage", *COLUMNS, *numbers])
    return np.asarray(rows[column], float)


def display_of(name: str) -> Any:
    """Unit in which people read a name's values, "" without one; factor and offset from SI."""
    if name == "damage":
        return DAMAGE_UNIT, 1.0, 0.0
    inner = re.fullmatch(r"(?:\w+\()?([^()]*)\)?", COLUMNS.get(name, name))
    variable = variable_of(inner[1]) if inner else None
    if variable is None:
        return "", 1.0, 0.0
    symbol = variable.display or variable.unit
    return "" if symbol == "1" else symbol, *variables.UNITS[variable.unit][symbol]


def titled(name: str) -> str:
    """A name with the unit in which its values are shown."""
    unit = display_of(name)[0]
    return f"{name} [{unit}]" if unit else name


def displayed(name: str, values: Any) -> Any:
    """SI values in the unit in which people read them."""
    _, factor, offset = display_of(name)
    return factor * np.asarray(values, float) + offset


def shown(name: str, value: Any) -> str:
    """An SI value as text with its unit."""
    unit = display_of(name)[0]
    return f"{displayed(name, value):.4g}{unit and f' {unit}'}"
