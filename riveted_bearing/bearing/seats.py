"""Interference of the rings' seats by tolerance classes, such as k5 of a shaft and H7 of a housing.

    shaft.interference   = shaft diameter - bore          middle of the shaft's class - middle of the bore's
    housing.interference = outside diameter - housing     middle of the outside diameter's - middle of the housing's

Bores and outside diameters are those of radial bearings of class Normal.  Rule of the standard for holes K to P up to IT7:
ES = -ei of the shaft's same letter + (IT of the grade - IT of the next finer one).
Grades and deviations stand in data/seats.toml.
"""

import re
import tomllib
from bisect import bisect_left
from importlib.resources import files

from ..base.errors import UserError

TABLE = tomllib.loads((files("riveted_bearing") / "data" / "seats.toml").read_text(encoding="utf-8"))
UP_TO, UPPER, LOWER = (TABLE[name] for name in ("up_to", "upper", "lower"))
GRADES, LOWER_J, UPPER_J = (
    {int(grade): row for grade, row in TABLE[name].items()} for name in ("grades", "lower_j", "upper_J")
)
CLASS = re.compile(r"([A-Za-z]{1,2})([4-8])")
SEATS = {"shaft.interference": ("bore", str.islower), "housing.interference": ("outside_diameter", str.isupper)}


def is_class(name, value):
    """Whether the value of a parameter is written as a tolerance class."""
    return name in SEATS and isinstance(value, str) and CLASS.fullmatch(value.strip()) is not None


def interference(name, written, size):
    """Interference [m] of a seat by its counterpart's class and the ring's diameter [m]; UserError if unknown."""
    letter, grade = CLASS.fullmatch(written.strip()).groups()
    which, fits = SEATS[name]
    if not fits(letter):
        kind = "a shaft's are small, as k5" if which == "bore" else "a housing's are large, as H7"
        raise UserError(f"letters of {kind}")
    mm = 1e3 * size
    if not 3.0 < mm <= UP_TO[-1]:
        raise UserError(f"classes are known for diameters from 3 to {UP_TO[-1]} mm, this one has {mm:g} mm")
    low, high = deviations(letter, int(grade), bisect_left(UP_TO, round(mm, 6)))
    ring = 0.5 * next(low for limit, low in TABLE["bore" if which == "bore" else "outside"] if mm <= limit + 1e-6)
    return 1e-6 * (0.5 * (low + high) - ring) * (1.0 if which == "bore" else -1.0)


def deviations(letter, grade, place):
    """Lower and upper deviation [um] of a class in the range of diameters number `place`; UserError if it is not known."""
    width, small = GRADES[grade][place], letter.lower()
    if small == "js":
        return -0.5 * width, 0.5 * width
    if small == "j" and grade in (table := LOWER_J if letter == small else UPPER_J):
        low = table[grade][place] - (0 if letter == small else width)
        return low, low + width
    if small in UPPER:
        high = UPPER[small][place] if letter == small else width - UPPER[small][place]
        return high - width, high
    if small in LOWER and (letter == small or 5 <= grade <= (8 if small != "p" else 7)):
        delta = 0 if letter == small else width - GRADES[grade - 1][place]
        if letter == small and (small, grade) == ("k", 8):
            return 0.0, width
        low = LOWER[small][place] if letter == small else -LOWER[small][place] + delta - width
        return low, low + width
    known = ", ".join([*UPPER, "j", "js", *LOWER])
    raise UserError(
        f"allowed: {known if letter == small else known.upper()} with a grade of ISO 286 from 4 to 8, j from 5 to 7, J from 6"
    )
