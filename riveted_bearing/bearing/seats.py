"""Interference of the rings' seats by tolerance classes, such as k5 of a shaft and H7 of a housing.

    shaft.interference   = shaft diameter - bore          middle of the shaft's class - middle of the bore's
    housing.interference = outside diameter - housing     middle of the outside diameter's - middle of the housing's

Bores and outside diameters are those of radial bearings of class Normal.  Rule of the standard for holes K to P up to IT7:
ES = -ei of the shaft's same letter + (IT of the grade - IT of the next finer one).
Sources: ISO 286-1:2010 (grades and deviations), ISO 492:2014, table 1 and 2 (rings).
"""

import re
from bisect import bisect_left

from ..base.errors import UserError

UP_TO = (6, 10, 18, 30, 50, 80, 120, 180, 250)  # mm; from 3 mm on
GRADES = {  # um
    4: (4, 4, 5, 6, 7, 8, 10, 12, 14),
    5: (5, 6, 8, 9, 11, 13, 15, 18, 20),
    6: (8, 9, 11, 13, 16, 19, 22, 25, 29),
    7: (12, 15, 18, 21, 25, 30, 35, 40, 46),
    8: (18, 22, 27, 33, 39, 46, 54, 63, 72),
}
UPPER = {  # of shafts, um
    "e": (-20, -25, -32, -40, -50, -60, -72, -85, -100),
    "f": (-10, -13, -16, -20, -25, -30, -36, -43, -50),
    "g": (-4, -5, -6, -7, -9, -10, -12, -14, -15),
    "h": (0,) * 9,
}
LOWER = {  # of shafts, um
    "k": (1, 1, 1, 2, 2, 2, 3, 3, 4),
    "m": (4, 6, 7, 8, 9, 11, 13, 15, 17),
    "n": (8, 10, 12, 15, 17, 20, 23, 27, 31),
    "p": (12, 15, 18, 22, 26, 32, 37, 43, 50),
}
LOWER_J = {5: (-2, -2, -3, -4, -5, -7, -9, -11, -13), 6: (-2, -2, -3, -4, -5, -7, -9, -11, -13), 7: (-4, -5, -6, -8, -10, -12, -15, -18, -21)}  # fmt: skip
UPPER_J = {6: (5, 5, 6, 8, 10, 13, 16, 18, 22), 7: (6, 8, 10, 12, 14, 18, 22, 26, 30), 8: (10, 12, 15, 20, 24, 28, 34, 41, 47)}  # of holes  # fmt: skip
BORE = ((10, -8), (18, -8), (30, -10), (50, -12), (80, -15), (120, -20), (180, -25), (250, -30))  # least deviation, um
OUTSIDE = ((18, -8), (30, -9), (50, -11), (80, -13), (120, -15), (150, -18), (180, -25), (250, -30))
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
    ring = 0.5 * next(low for limit, low in (BORE if which == "bore" else OUTSIDE) if mm <= limit + 1e-6)
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
