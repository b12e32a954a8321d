"""Which bearings can be built: limits between dimensions, each refused by the user's own key, value and unit with what
is allowed.  Here are those that follow from the half's shape; the others are of the table of variables.

A limit is a margin, a length (or another quantity) that must not be negative, over the named values; the bound of one
of them comes from the margin itself, by bisection.  Names are those of a bearing file: parameters by their full names,
Z, catalogue.*, rivet.*.
"""

from types import SimpleNamespace

from bearing_model.generated import limits, variables
from bearing_model.physics.parameters import in_force
from rivet_model import half_shape, ribbon_shape
from rivet_model.half_shape import Limit

from . import ribbon, scaling


def parameters_of(v):
    """Values by their names as the parameters in force that limits of the table are functions of."""
    groups = {}
    for name, value in v.items():
        group, dot, member = name.partition(".")
        if dot:
            groups.setdefault(group, {})[member] = value
    p = SimpleNamespace(**{group: SimpleNamespace(**members) for group, members in groups.items()})
    p.cage.shape = variables.CageShape[p.cage.shape.upper()]
    return in_force(p)


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


TABLE = [limit for limit in limits.LIMITS if not limit.is_array]
# limits of balls and the cage's diameters, before those of the half
FIRST = next(place for place, limit in enumerate(TABLE) if limit.quantity == "cage.land_width")
OF_BODY = (
    Limit(
        ("cage.x_c", "cage.width", "cage.D_o", "cage.D_i"),
        centre_of_mass_beside_shape,
        "a centre of mass (2 % for rounding) of the half's own shape; without cage.x_c it follows",
    ),
    Limit(
        ("cage.m", "cage.rho"),
        mass_beside_density,
        "a half's mass by its shape and the density of its material (10 % for edges that no drawing has); without cage.m it follows",
    ),
)
MACHINED = tuple(of_half(limit) for limit in half_shape.LIMITS)
RIBBON_NAMES = scaling.SHAPE | scaling.RIBBON | {"cage_half_width": "cage.pocket_depth"}
RIBBON = tuple(of_half(limit, RIBBON_NAMES) for limit in ribbon_shape.LIMITS)


def limits_of(values):
    """All limits that a bearing with these values must keep, but those about values that are not known."""
    first, rest = (
        tuple(
            Limit(limit.keys, lambda v, limit=limit: limit.margin(parameters_of(v), v["Z"]), limit.reason)
            for limit in part
            if all(name in values for name in limit.needs)
        )
        for part in (TABLE[:FIRST], TABLE[FIRST:])
    )
    return first + (RIBBON if ribbon.is_ribbon(values) else MACHINED) + OF_BODY + rest


def holds(limit, values):
    """Whether a limit holds, to a millionth of its first value; one about values that are not known does."""
    return not all(key in values for key in limit.keys) or limit.margin(values) >= -1e-6 * abs(values[limit.keys[0]])


def bound(limit, value, values_with):
    """What is allowed for a refused value: ("at most" or "at least", bound), None if nothing within a thousand times does;
    values_with: a function of it that gives all values.
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
