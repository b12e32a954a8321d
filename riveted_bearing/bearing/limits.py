"""Which bearings can be built: limits between dimensions, each refused by the user's own key, value and unit with what
is allowed.

A limit is a margin, a length (or another quantity) that must not be negative, over the named values; the bound of one
of them comes from the margin itself, by bisection.  Names are those of a bearing file: parameters by their full names,
Z, catalogue.*, rivet.*.
"""

import math

from rivet_model import half_shape, ribbon_shape
from rivet_model.half_shape import LEAST_WALL, Limit

from . import ribbon, scaling

DENSEST = 2.3e4  # kg/m3: no metal is heavier


def shape_of(v):
    """What half_shape.py needs of the cage half."""
    return scaling.shape_of(
        v, {name.removeprefix("rivet."): value for name, value in v.items() if name.startswith("rivet.")}
    )


def of_half(limit, names=scaling.SHAPE):
    """A limit of half_shape.py over the names of a bearing file."""
    keys = tuple(names.get(key, f"rivet.{key}") for key in limit.keys)
    return Limit(keys, lambda v: limit.margin(shape_of(v)), limit.reason)


def centre_of_mass_beside_shape(v):
    """How far cage.x_c is from the half's own, and what is allowed for rounding: 2 %."""
    own = scaling.half_inertia(v, vars(shape_of(v))).get("cage.x_c", v["cage.x_c"])
    return 0.02 * own - abs(v["cage.x_c"] - own)


def mass_beside_density(v):
    """How far cage.m is from the half's own shape and density, and what is allowed, as no drawing has every edge: 10 %."""
    own = scaling.half_inertia({name: value for name, value in v.items() if name != "cage.m"}, vars(shape_of(v))).get(
        "cage.m", v["cage.m"]
    )
    return 0.1 * own - abs(v["cage.m"] - own)


def groove_bottom(v, side):
    """Diameter of the groove's bottom, outer (side = 1) or inner (-1) [m]."""
    return v["bearing.d_m"] + side * (v["bearing.D"] + 0.5 * v["bearing.P_d"])


def ring_mass(v, density):
    """Mass of a full ring of the half's diameters and width [kg]."""
    return density * 0.25 * math.pi * (v["cage.D_o"] ** 2 - v["cage.D_i"] ** 2) * 0.5 * v["cage.width"]


CAGE, RIVET = ("bearing.D", "bearing.d_m", "Z", "cage.pocket_clearance"), "rivet.head_diameter"
LIMITS = (
    Limit(
        CAGE[:3], lambda v: v["bearing.d_m"] * math.sin(math.pi / v["Z"]) - v["bearing.D"], "balls that do not overlap"
    ),
    Limit(
        ("bearing.P_d", "bearing.D", "bearing.f_i", "bearing.f_e"),
        lambda v: 4.0 * (min(v["bearing.f_i"], v["bearing.f_e"]) - 0.5) * v["bearing.D"] - v["bearing.P_d"],
        "balls that stay on their side of the grooves",
    ),
    Limit(
        ("bearing.P_d", "bearing.D"),
        lambda v: 0.01 * v["bearing.D"] + v["bearing.P_d"],
        "an interference of at most 1 % of the ball",
    ),
    Limit(("cage.D_i", "cage.D_o"), lambda v: v["cage.D_o"] - v["cage.D_i"], "a cage with a wall"),
    Limit(
        ("cage.D_o", "bearing.d_m", "bearing.D", "cage.guide_clearance"),
        lambda v: groove_bottom(v, 1) - v["cage.D_o"] - v["cage.guide_clearance"],
        "a cage that, with its guide clearance, fits inside the outer groove's bottom",
    ),
    Limit(
        ("cage.D_i", "bearing.d_m", "bearing.D", "bearing.h_i"),
        lambda v: v["cage.D_i"] - groove_bottom(v, -1) - 2.0 * v["bearing.h_i"] * v["bearing.D"],
        "a cage that passes over the inner ring's shoulder",
    ),
    Limit(
        ("cage.x_c", "cage.width", "cage.D_o", "cage.D_i"),
        centre_of_mass_beside_shape,
        "a centre of mass (2 % for rounding) of the half's own shape; without cage.x_c it follows",
    ),
    Limit(
        ("cage.land_width", "cage.width"),
        lambda v: 0.5 * v["cage.width"] - v["cage.land_width"] + 1e-12,
        "a land on its half of the cage",
    ),
    Limit(
        ("cage.land_x", "cage.land_width", "cage.width"),
        lambda v: 0.5 * (v["cage.width"] - v["cage.land_width"]) - v["cage.land_x"] + 1e-6,
        "a land that does not reach over the cage's edge",
    ),
    Limit(
        ("cage.m", "cage.D_o", "cage.D_i", "cage.width"),
        lambda v: ring_mass(v, DENSEST) - v["cage.m"],
        "a half lighter than a full ring of the heaviest metal",
    ),
    Limit(
        ("cage.m", "cage.rho"),
        mass_beside_density,
        "a half's mass by its shape and the density of its material (10 % for edges that no drawing has); without cage.m it follows",
    ),
    Limit(
        ("cage.J_p", "cage.m", "cage.D_o"),
        lambda v: 0.25 * v["cage.m"] * v["cage.D_o"] ** 2 - v["cage.J_p"],
        "a half with its mass inside cage.D_o",
    ),
    Limit(
        ("cage.J_p", "cage.m", "cage.D_i"),
        lambda v: v["cage.J_p"] - 0.25 * v["cage.m"] * v["cage.D_i"] ** 2,
        "a half with its mass outside cage.D_i",
    ),
    Limit(("cage.J_t", "cage.J_p"), lambda v: v["cage.J_t"] - 0.499 * v["cage.J_p"], "moments of inertia of a body"),
    Limit(("ring.J_t", "ring.J_p"), lambda v: v["ring.J_t"] - 0.499 * v["ring.J_p"], "moments of inertia of a body"),
    Limit(
        (RIVET, "rivet.shank_diameter", "rivet.relief_radius"),
        lambda v: v[RIVET] - v["rivet.shank_diameter"] - 2.0 * v["rivet.relief_radius"],
        "a head wider than the relieved hole",
    ),
    Limit(
        ("joint.preload", "rivet.shank_diameter"),
        lambda v: v["rivet.yield_rivet"] * 0.25 * math.pi * v["rivet.shank_diameter"] ** 2 - v["joint.preload"],
        "a shank that does not yield by its preload",
    ),
    Limit(
        ("rivet.head_height", "rivet.fillet_radius"),
        lambda v: v["rivet.head_height"] - v["rivet.fillet_radius"],
        "a fillet below the head",
    ),
    Limit(
        ("rivet.fillet_radius", "rivet.relief_radius"),
        lambda v: v["rivet.relief_radius"] - v["rivet.fillet_radius"],
        "a fillet inside the relief",
    ),
    Limit(
        ("rivet.fillet_radius", "rivet.relief_depth"),
        lambda v: v["rivet.relief_depth"] - v["rivet.fillet_radius"],
        "a fillet inside the relief",
    ),
    Limit(
        ("rivet.flange_thickness", "rivet.relief_depth", "rivet.edge_break"),
        lambda v: v["rivet.flange_thickness"] - v["rivet.relief_depth"] - v["rivet.edge_break"],
        "a flange that bears the shank",
    ),
    Limit(
        ("rivet.edge_break", "rivet.relief_radius"),
        lambda v: v["rivet.relief_radius"] - v["rivet.edge_break"],
        "a chamfer smaller than the relief",
    ),
    Limit(
        ("rivet.middle_zone", "rivet.edge_break"),
        lambda v: v["rivet.edge_break"] - v["rivet.middle_zone"],
        "a middle zone inside the chamfer",
    ),
    Limit(
        ("catalogue.bore", "bearing.d_m", "bearing.D"),
        lambda v: groove_bottom(v, -1) - 2.0 * LEAST_WALL - v["catalogue.bore"],
        "an inner ring below its groove",
    ),
    Limit(
        ("catalogue.outside_diameter", "bearing.d_m", "bearing.D"),
        lambda v: v["catalogue.outside_diameter"] - groove_bottom(v, 1) - 2.0 * LEAST_WALL,
        "an outer ring above its groove",
    ),
    Limit(
        ("catalogue.width", "cage.width"),
        lambda v: v["catalogue.width"] - v["cage.width"],
        "a cage inside the bearing's width",
    ),
    Limit(
        ("catalogue.width", "bearing.D"),
        lambda v: v["catalogue.width"] - v["bearing.D"],
        "balls inside the bearing's width",
    ),
)


FIRST = 6  # limits of balls and the cage's diameters, before those of the half
MACHINED = tuple(of_half(limit) for limit in half_shape.LIMITS)
RIBBON_NAMES = scaling.SHAPE | scaling.RIBBON | {"cage_half_width": "cage.pocket_depth"}
RIBBON = (
    Limit(
        ("cage.width", "cage.pocket_depth", "cage.sheet"),
        lambda v: 0.01 * v["cage.width"] - abs(v["cage.width"] - 2.0 * (v["cage.pocket_depth"] + v["cage.sheet"])),
        "a ribbon as wide as pockets and sheets of both halves; without cage.width it follows",
    ),
    *(of_half(limit, RIBBON_NAMES) for limit in ribbon_shape.LIMITS),
)
OF_LAND = ("cage.guide_clearance", "cage.land_x")  # a ribbon has none


def limits_of(values):
    """All limits that a bearing with these values must keep."""
    if not ribbon.is_ribbon(values):
        return LIMITS[:FIRST] + MACHINED + LIMITS[FIRST:]
    return RIBBON + tuple(limit for limit in LIMITS if not set(limit.keys) & set(OF_LAND))


def holds(limit, values):
    """Whether a limit holds, to a millionth of its first value; one about values that are not known does."""
    return not all(key in values for key in limit.keys) or limit.margin(values) >= -1e-6 * abs(values[limit.keys[0]])


def bound(limit, value, values_with):
    """What is allowed for one value: ("at most" or "at least", bound); None if nothing between a thousandth and a
    thousand times the value would do.

    value: as it is, which the limit refuses; values_with: a function of it that gives all values, those that follow
    from it too.
    """
    if isinstance(value, int):
        fitting = [number for number in range(5, 33) if holds(limit, values_with(number))]
        return ("at most" if fitting[-1] < value else "at least", fitting[-1]) if fitting else None
    value = value or 1e-6
    for growth in (0.98, 1.0 / 0.98):  # away from the value by 2 % at a time until the limit holds, then halve
        for step in range(1, 350):
            good, bad = growth**step, growth ** (step - 1)
            if not holds(limit, values_with(good * value)):
                continue
            for _ in range(50):
                middle = 0.5 * (good + bad)
                good, bad = (middle, bad) if holds(limit, values_with(middle * value)) else (good, middle)
            return "at most" if good * value < value else "at least", good * value
    return None
