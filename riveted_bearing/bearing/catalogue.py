"""Bearings by designation: boundary dimensions and load ratings from a maker's catalogue, the balls from the ratings by
a rule.

A catalogue tells neither balls nor cage.  Rule for the balls: of all numbers and usual sizes of balls that can be
filled in, those whose ratings by ISO 281 and ISO 76 come nearest to C and C_0 (the larger of both logarithmic
deviations is smallest), on the pitch circle (bore + outside diameter)/2. How good the rule is: 69 of the 85 bearings
have ball sizes within 2 % (RMS 2.4 %) of those that follow from another maker's factors f_0 (NSK), the numbers of balls
known from measurements agree; makers differ in some bearings by a ball size or a ball (6305: 7 balls of 11.5 mm here).
"""

import math
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from riveted_bearing.bearing.load_ratings import dynamic_rating, static_rating

from ..base.errors import UserError
from ..base.shipped import csv_rows

TABLE = files("riveted_bearing") / "data" / "catalogue.csv"
INCH = 25.4e-3
# [m] usual with ball makers: 1/32 inch up to 1 1/2 inch, then 1/16 inch; two of 1/64 inch; millimetres up to 25 mm
BALL_SIZES = sorted(
    [n * INCH / 32 for n in range(4, 49)]
    + [n * INCH / 16 for n in range(25, 41)]
    + [15 * INCH / 64, 17 * INCH / 64]
    + [0.5e-3 * n for n in (10, 11, 12, 13, 14, 15, 16, 17, 18, 20, 22, 23, *range(24, 51, 2))]
)
# angle of the arc that the balls take when they are filled in: usual 180 to 200 degrees
LARGEST_FILL = math.radians(205.0)
THICKEST_BALL = 0.325  # ball diameter over the difference of the bearing's diameters: usual 0.28 to 0.32
ROWS = csv_rows(files("riveted_bearing") / "data" / "clearance.csv")
UP_TO = [int(row["up_to"]) for row in ROWS]  # mm
CLEARANCE = {  # class: least and largest radial internal clearance [um] for bores up to UP_TO
    name.removesuffix("_least"): [(int(row[name]), int(row[name.replace("least", "largest")])) for row in ROWS]
    for name in ROWS[0]
    if name.endswith("_least")
}


@dataclass(frozen=True)
class Entry:
    """A line of the catalogue, in SI: designation, bore, outside_diameter, width [m], C, C_0 [N]."""

    designation: str
    bore: float
    outside_diameter: float
    width: float
    C: float
    C_0: float

    @property
    def data(self):
        """What a bearing file calls its catalogue data."""
        return {key: value for key, value in vars(self).items() if key != "designation"}

    @property
    def d_m(self):
        """Pitch diameter by rule: the mean of bore and outside diameter [m]."""
        return round(0.5 * (self.bore + self.outside_diameter), 9)


@cache
def entries():
    """All bearings of the catalogue by designation."""
    table = {}
    for row in csv_rows(TABLE):
        lengths = {key: round(1e-3 * float(row[key]), 9) for key in ("bore", "outside_diameter", "width")}
        forces = {key: round(1e3 * float(row[key]), 6) for key in ("C", "C_0")}
        table[row["designation"]] = Entry(row["designation"], **lengths, **forces)
    return table


@cache
def balls(entry):
    """Number and diameter [m] of the balls of an Entry, by the rule above.

    >>> Z, D = balls(entries()["6308"])
    >>> print(Z, f"{1e3 * D:.3f}")
    8 15.081
    """
    candidates = []
    for D in BALL_SIZES:
        if D > THICKEST_BALL * (entry.outside_diameter - entry.bore):
            break
        most = 1 + int(0.5 * LARGEST_FILL / math.asin(D / entry.d_m))
        for Z in range(5, most + 1):
            ratios = dynamic_rating(Z, D, entry.d_m) / entry.C, static_rating(Z, D, entry.d_m) / entry.C_0
            candidates.append((max(abs(math.log(ratio)) for ratio in ratios), Z, D))
    if not candidates:
        least = 1e3 * (entry.bore + BALL_SIZES[0] / THICKEST_BALL)
        raise UserError(
            f"at least {least:.4g} mm is allowed with catalogue.bore = {1e3 * entry.bore:g} mm, so that balls lie between"
        )
    _, Z, D = min(candidates)
    return Z, round(D, 9)


def clearance(bore, name="CN"):
    """Radial internal clearance by rule [m]: the middle of a class for the bore [m]; None beyond the table.

    >>> print(f"{1e6 * clearance(0.035):g} {1e6 * clearance(0.035, 'C3'):g}")
    13 24
    """
    for largest, (low, high) in zip(UP_TO, CLEARANCE[name], strict=True):
        if bore <= 1e-3 * largest + 1e-9:
            return round(0.5e-6 * (low + high), 9)
    return None
