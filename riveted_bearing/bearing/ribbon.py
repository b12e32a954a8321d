"""A pressed ribbon cage by rule, for a bearing whose cage.shape is "ribbon": docs/cages.md has the table of the rules.

Handbook rules of Chinese bearing makers for ball-guided ribbons (sheet S, ring width, pocket depth K, sphere's radius
Rc; lengths in mm, D: ball):

    S = sqrt(D/6.3 - 0.5) - 0.04 (diameter series 0, 1, 2), sqrt(D/8.5 - 0.5) + 0.15 (series 3, 4), to the next stock size
    ring width 0.45 D about d_m,   K = D/2 + eps,   Rc = D/2 + 2 eps,   eps 0.05 up to SMALL, 0.07 above
    shank by the bore, head 1.6 shanks wide

Assumed here: the change of eps, the steps of the shank, the head's height, and the fillet, which is as large as the
head's room on the land and a contact beside the fillet allow.
"""

import math
from types import SimpleNamespace
from typing import Any

from rivet_model import ribbon_shape

from ..base.units import rounded

MATERIAL, RIVET_MATERIAL = "DC04", "C10C"
STOCK = (0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.2, 1.5, 1.8, 2.0, 2.5, 3.0)  # mm
SMALL = 12.0e-3  # ball diameter [m]
SHANK = ((17e-3, 1.0e-3), (30e-3, 1.2e-3), (50e-3, 1.5e-3), (70e-3, 2.0e-3), (90e-3, 2.5e-3))  # up to the bore [m]
LARGEST_SHANK = 3.0e-3
HEAD, HEAD_HEIGHT = 1.6, 0.6  # of the shank
ROOM = 0.2  # of the shank, on the land beside the head
SEAM = 0.65  # most of sin chi_1 over sin chi_0
BEND = 1.3  # least fillet over the sheet
HEAVY = "34"  # second digits of designations
RELIEF = {"relief_depth": 0.25, "edge_break": 0.1, "middle_zone": 0.05}  # of the sheet


def is_ribbon(values: Any) -> bool:
    """Whether values by the names of a bearing file mean a ribbon cage."""
    return values.get("cage.shape") == "ribbon"


def is_guided_by_balls(values: Any) -> bool:
    """Whether values mean a cage without a land."""
    return values.get("cage.guidance") == "balls"


def sheet(D, designation=""):
    """Thickness of the sheet [m] by rule for a ball [m].

    >>> sheet(7.938e-3, "6205"), sheet(17.4625e-3, "6309")
    (0.0008, 0.0015)
    """
    d = 1e3 * D
    heavy = len(designation) == 4 and designation[1] in HEAVY
    S = math.sqrt(max(d / 8.5 - 0.5, 0.04)) + 0.15 if heavy else math.sqrt(max(d / 6.3 - 0.5, 0.04)) - 0.04
    return round(1e-3 * min(STOCK, key=lambda size: abs(size - S)), 9)


def shank(bore):
    """Diameter of the rivets [m] by rule for a bore [m]."""
    return next((size for largest, size in SHANK if bore <= largest + 1e-9), LARGEST_SHANK)


def rivet_sizes(D, bore, given, rivet, designation=""):
    """Dimensions of the rivet by rule [m], the sheet as flange_thickness; the seat is none, its diameter the head's."""
    S = given.get("cage.sheet", rivet.get("flange_thickness", sheet(D, designation)))
    d = rivet.get("shank_diameter", shank(bore))
    head = rivet.get("head_diameter", round(HEAD * d, 9))
    values = {"shank_diameter": d, "head_diameter": head, "head_height": round(HEAD_HEIGHT * d, 9)}
    values |= {"flange_thickness": S, "seat_diameter": head}
    return values | {name: round(share * S, 9) for name, share in RELIEF.items()}


def cage_sizes(Z, D, d_m, given, rivet, designation=""):
    """Parameters of the cage by rule [m], beside `given`; rivet: all its dimensions."""
    S = given.get("cage.sheet", rivet["flange_thickness"])
    eps = 0.05e-3 if D <= SMALL else 0.07e-3
    values = {
        "cage.guidance": "balls",
        "cage.sheet": S,
        "cage.D_o": round(d_m + 0.45 * D, 9),
        "cage.D_i": round(d_m - 0.45 * D, 9),
        "cage.pocket_depth": round(0.5 * D + eps, 9),
    }
    if "cage.pocket_radius" in given:
        values["cage.pocket_clearance"] = round(2.0 * given["cage.pocket_radius"] - D, 12)
    else:
        values["cage.pocket_clearance"] = 4.0 * eps
    values |= given
    values["cage.width"] = given.get("cage.width", round(2.0 * (values["cage.pocket_depth"] + values["cage.sheet"]), 9))
    # of the machined cage's land, which no ribbon has: inside the half
    values |= {
        "cage.land_width": round(0.2 * values["cage.width"], 9),
        "cage.land_x": round(0.1 * values["cage.width"], 9),
    }
    if "cage.pocket_fillet" not in given:
        values["cage.pocket_fillet"] = fillet(Z, D, d_m, values, rivet)
    return {name: value for name, value in values.items() if name not in given}


def fillet(Z, D, d_m, values, rivet):
    """Radius of the fillet [m]: the largest that leaves ROOM beside the head and the ball's contact on the sphere."""
    clearance, depth = values["cage.pocket_clearance"], values["cage.pocket_depth"]
    Rc, e, S = 0.5 * (D + clearance), 0.5 * (D + clearance) - depth, values["cage.sheet"]
    most = SEAM * e / (0.5 * clearance)  # of sin chi_1 = (f + e)/(Rc + f)
    by_seam = max((most * Rc - e) / (1.0 - most), 0.0) if most < 1.0 else Rc
    needed = 0.5 * rivet["head_diameter"] + ROOM * rivet["shank_diameter"]

    sizes = {"Z": Z, "d_m": d_m, "ball_diameter": D, "pocket_clearance": clearance, "cage_half_width": depth + S}
    sizes |= {"cage_outer_diameter": values["cage.D_o"], "cage_inner_diameter": values["cage.D_i"]}

    def land(f):
        return ribbon_shape.land_half_length(SimpleNamespace(**sizes, flange_thickness=S, pocket_fillet=f))

    low, high = BEND * S, max(by_seam, BEND * S)
    if not land(high) >= needed:
        for _ in range(60):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if land(middle) >= needed else (low, middle)
        high = low
    return rounded(high, 4)
