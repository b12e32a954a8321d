"""Heads of solid rivets by the standards that makers deliver: head diameter and height by the shank's nominal diameter
(data/rivet_heads.csv).

The closing head, which riveting forms, is taken to have the dimensions of the set head.  The fillet below
the head follows the shank by rule (scaling.py): the standards give its upper limit only.
"""

import math
from functools import cache
from importlib.resources import files

from ..base.errors import refusal, unknown
from ..base.shipped import csv_rows

TABLE = files("riveted_bearing") / "data" / "rivet_heads.csv"


@cache
def heads():
    """{standard: {shank diameter [mm]: (head diameter, head height) [m]}}."""
    found = {}
    for row in csv_rows(TABLE):
        sizes = round(1e-3 * float(row["head_diameter"]), 9), round(1e-3 * float(row["head_height"]), 9)
        found.setdefault(row["standard"], {})[float(row["shank_diameter"])] = sizes
    return found


def head_of(path, standard, sizes):
    """Head diameter and height [m] by a standard's name for the rivet's shank; UserError if the standard or the shank
    is not in the table.

    >>> head_of("", "DIN 660", {"shank_diameter": 2e-3})
    {'head_diameter': 0.0035, 'head_height': 0.0012}
    """
    if standard not in heads():
        raise unknown(path, "rivet.head", standard, heads())
    rows = heads()[standard]
    shanks = ", ".join(f"{shank:g}" for shank in rows)
    if "shank_diameter" not in sizes:
        raise refusal(path, "rivet.head", standard, f"rivet.shank_diameter is needed too; {standard} has {shanks} mm")
    shank = next((shank for shank in rows if math.isclose(shank, 1e3 * sizes["shank_diameter"], rel_tol=1e-6)), None)
    if shank is None:
        given = f"rivet.shank_diameter = {1e3 * sizes['shank_diameter']:g} mm"
        raise refusal(path, "rivet.head", standard, f"it has shanks of {shanks} mm, but {given}")
    return dict(zip(("head_diameter", "head_height"), rows[shank], strict=True))
