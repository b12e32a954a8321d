"""Heads of columns: names, and the units that stand in them."""

import re

import numpy as np

from .errors import UserError
from .units import is_unit, scale

UNSURE = ("in", "min")  # units that end a name as words do: d_in, t_min


def split_head(head):
    """Name and unit ("" for none) of a column's head: "F [kN]", "F (kN)", "F / kN", "F in kN"; an index is no unit."""
    head = head.strip()
    for bracket in re.finditer(r"\[([^][]*)\]|\(((?:[^()]|\([^()]*\))*)\)", head):
        unit = (bracket[1] if bracket[1] is not None else bracket[2]).strip()
        last = bracket.end() == len(head) and bracket.start() > 0
        index = unit.isdigit() and not (unit == "1" and head[bracket.start() - 1].isspace())
        if (is_unit(unit) or last) and not index:
            return f"{head[: bracket.start()].rstrip()}{head[bracket.end() :]}".strip(" /,:"), unit
    for between in (r"\s+in\s+", r"\s*,\s*", r"\s*/\s*"):
        name, *unit = re.split(between, head, maxsplit=1)
        if name and unit and is_unit(unit[0]):
            return name, unit[0]
    return head, ""


def unit_of(head, scales):
    """Unit of a column's head and whether it is certain: a last word that fits, as in speed_rpm, is not."""
    name, unit = split_head(head)
    if unit:
        return unit, True
    word = re.split(r"[\s_.:-]", name)[-1]
    if changes(word, scales):
        return word, False
    last = re.search(r"(?<=[a-z\d])[A-Z][A-Za-z]+$", word)  # speedRPM, timeMs
    if last and any(changes(one, scales) for one in (last[0], last[0].lower(), last[0][0].lower() + last[0][1:])):
        return f"?{last[0]}", False
    return "", False


def changes(unit, scales):
    """Whether a text is a unit of a quantity other than its SI unit."""
    try:
        return is_unit(unit) and scale(unit, scales) != (1.0, 0.0)
    except UserError:
        return False


def same(one, other, scales):
    """Whether two units are one."""
    try:
        return np.allclose(scale(one, scales), scale(other, scales), rtol=1e-12, atol=0.0)
    except UserError:
        return False
