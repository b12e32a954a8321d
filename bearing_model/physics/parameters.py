"""Parameters and inputs by the names of the variable table (variables.py): p.bearing.D, p.scene.cage, u.shaft.F_x ...
SI units.

A name that Python reserves has an underscore behind it: p.bearing.lambda_.
"""

import copy
import keyword
import math
import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np

from bearing_model.cage.common.pocket_spheres_setup import spheres_edge, spheres_radius, spheres_seams
from bearing_model.generated import variables
from bearing_model.generated.variables import INPUTS, PARAMETERS, Z
from bearing_model.physics.ring_fit import ring_fit_bore, ring_fit_effective_e, ring_fit_effective_i, ring_fit_outside

ENUMERATIONS = (
    variables.TiltMode,
    variables.RingMotion,
    variables.HousingMotion,
    variables.CageMaterial,
    variables.CageModel,
    variables.CageShape,
    variables.CageGuidance,
    variables.Traction,
    variables.Drag,
    variables.Lubrication,
    variables.Stress,
    variables.Switch,
    variables.FitModel,
    variables.MeanStress,
    variables.Method,
)
TYPES = {enumeration.__name__: enumeration for enumeration in ENUMERATIONS}


def place(name):
    """Group and member of a variable: "bearing.lambda" is p.bearing.lambda_."""
    group, member = re.sub(r"\[[jkn]\]", "", name).split(".")
    return group, member + "_" * keyword.iskeyword(member)


class Values:
    """Groups of values of one table, start values where nothing is given."""

    def __init__(self, table, values=None):
        values = dict(values or {})
        for name, variable in table.items():
            value = values.pop(name, variable.start)
            if variable.count > 1:
                value = [value] * variable.count if np.ndim(value) == 0 else value
                value = [values.pop(re.sub(r"\[[jkn]\]", f"[{j + 1}]", name), v) for j, v in enumerate(value)]
                require(len(value) == variable.count, f"{name}: {len(value)} values; {variable.count} are needed")
                value = np.array([admit(variable, v) for v in value])
            else:
                value = admit(variable, value)
            group, member = place(name)
            if not hasattr(self, group):
                setattr(self, group, SimpleNamespace())
            setattr(getattr(self, group), member, value)
        require(not values, f"{', '.join(values)}: unknown; variables are listed in docs/parameters.md")
        self.mark_given(table)

    def mark_given(self, table):
        """Mark the values whose start value stands for one that follows from others, where they differ from it."""
        own = {n.replace(".", "_"): self.value(n) != v.start for n, v in table.items() if v.derives}
        self.given = SimpleNamespace(**own)

    def value(self, name):
        """A value by its name in the table."""
        group, member = place(name)
        return getattr(getattr(self, group), member)


class Parameters(Values):
    """All parameters; ValueError for an unknown name, a value outside its limits, or values that together make no
    bearing.

    >>> Parameters({"bearing.P_d": 0.0, "scene.lubrication": "mixed"}).scene.lubrication
    <Lubrication.MIXED: 2>
    """

    def __init__(self, values=None):
        super().__init__(PARAMETERS, values)
        check_geometry(self)

    def changed(self, values):
        """These parameters with values {name: value} that are set in a run: "joint.mu", "rivet[3].intact", "rivet[k].intact".

        ValueError as at the start, and for a parameter that is fixed.
        """
        p = copy.deepcopy(self)
        for name, value in values.items():
            head, bracket, rest = name.partition("[")
            number, _, tail = rest.partition("]")
            letter = next((x for x in "jkn" if f"{head}[{x}]{tail}" in PARAMETERS), "") if bracket else ""
            table_name = f"{head}[{letter}]{tail}" if letter else name
            require(table_name in PARAMETERS, f"{name}: unknown; variables are listed in docs/parameters.md")
            variable = PARAMETERS[table_name]
            require(
                not variable.fixed,
                f"{name} = {value} is not allowed: it is fixed after initialization, for {variable.fixed}",
            )
            group, member = place(table_name)
            new = np.array(p.value(table_name)) if variable.count > 1 else admit(variable, value)
            if variable.count > 1:
                where = slice(None) if number in "jkn" else int(number) - 1
                new[where] = [admit(variable, v) for v in value] if np.ndim(value) else admit(variable, value)
            setattr(getattr(p, group), member, new)
            if variable.derives:
                setattr(p.given, table_name.replace(".", "_"), True)
        check_geometry(p)
        return p


class Inputs(Values):
    """All inputs; ValueError for an unknown name or a value outside its limits."""

    def __init__(self, values=None):
        super().__init__(INPUTS, values)


class InputDerivatives(Values):
    """Derivatives of all inputs by time, 0 where nothing is given; ValueError for an unknown name."""

    def __init__(self, values=None):
        super().__init__({name: replace(v, start=0.0, min=None, max=None) for name, v in INPUTS.items()}, values)


def require(condition, message):
    if not condition:
        raise ValueError(message)


def admit(variable, value):
    """The value in the variable's type, if it is allowed."""
    if variable.type in TYPES:
        enumeration = TYPES[variable.type]
        allowed = ", ".join(f"{member.name.lower()} ({member.value})" for member in enumeration)
        try:
            return enumeration[value.upper()] if isinstance(value, str) else enumeration(value)
        except (KeyError, ValueError):
            retired = variables.RETIRED_ITEMS.get(variable.type, {}).items()
            reason = next((f"{why}; " for name, (number, why) in retired if value in (name, number)), "")
            raise ValueError(f"{variable.name} = {value}: {reason}allowed are {allowed}") from None
    low = -math.inf if variable.min is None else variable.min
    high = math.inf if variable.max is None else variable.max
    unit = "" if variable.unit == "1" else f" {variable.unit}"
    require(
        math.isfinite(value) and low <= value <= high,
        f"{variable.name} = {value}{unit}: {low:g} ... {high:g} is allowed",
    )
    return int(value) if variable.type == "Integer" else float(value)


def largest_clearance(p):
    """Clearance at which a ball on one race reaches the other groove's far side [m]."""
    return 4.0 * (min(p.bearing.f_i, p.bearing.f_e) - 0.5) * p.bearing.D


def check_ribbon(p):
    """Refuse sizes that make no ribbon half, and those of one on a machined cage."""
    ribbon = p.cage.shape == variables.CageShape.RIBBON
    for name in ("sheet", "pocket_depth", "pocket_fillet", "pocket_radius", "pocket_edge"):
        value, needed = getattr(p.cage, name), name in ("sheet", "pocket_depth", "pocket_fillet")
        if ribbon:
            require(
                value > 0.0 or not needed,
                f"cage.{name} = {value} m: more than 0 is allowed of a ribbon cage (cage.shape)",
            )
        else:
            none = "0 is allowed, a machined cage (cage.shape) has no such size"
            require(value == 0.0, f"cage.{name} = {value} m: {none}")
    if not ribbon:
        return
    guided = "a ribbon cage has no land on the outer ring; balls (2) is allowed"
    require(p.cage.guidance == variables.CageGuidance.BALLS, f"cage.guidance = outer: {guided}")
    radius, own, depth = spheres_radius(p), p.cage.pocket_radius, p.cage.pocket_depth
    require(
        own == 0.0 or abs(own - radius) <= 1e-6 * radius,
        f"cage.pocket_radius = {own} m: 0 or (bearing.D + cage.pocket_clearance)/2 = {radius:g} m is allowed",
    )
    least = f"no room for the ball; more than bearing.D/2 = {0.5 * p.bearing.D:g} m is allowed"
    require(depth > 0.5 * p.bearing.D, f"cage.pocket_depth = {depth} m: {least}")
    most = f"deeper than a sphere; at most (bearing.D + cage.pocket_clearance)/2 = {radius:g} m is allowed"
    require(depth <= radius, f"cage.pocket_depth = {depth} m: {most}")
    width = 2.0 * (depth + p.cage.sheet)
    require(
        abs(p.cage.width - width) <= 0.01 * width,
        f"cage.width = {p.cage.width} m: 2 (cage.pocket_depth + cage.sheet) = {width:g} m is allowed, +- 1 %",
    )
    pitch = 0.5 * (p.cage.D_o + p.cage.D_i)
    require(
        abs(pitch - p.bearing.d_m) <= p.cage.pocket_clearance,
        f"cage.D_o, cage.D_i: (cage.D_o + cage.D_i)/2 = {pitch:g} m puts the pockets beside the balls; "
        f"bearing.d_m = {p.bearing.d_m:g} m is allowed, +- cage.pocket_clearance (change both diameters)",
    )
    ring, edge = p.cage.D_o - p.cage.D_i, spheres_edge(p)
    require(
        0.25 * ring > 2.0 * edge,
        f"cage.D_o - cage.D_i = {ring:g} m: no sphere between the pocket's edges; more than {8.0 * edge:g} m, "
        "8 radii of the edges, is allowed",
    )
    squares = sum(sine**2 for sine in spheres_seams(p))
    require(
        squares < 0.95,
        "cage.pocket_fillet, cage.D_o - cage.D_i: the fillet and the edges leave no sphere; the sum of the squares of "
        f"the sines of their angles is {squares:g}, less than 0.95 is allowed",
    )


def check_guidance(p):
    """Refuse a run of a machined cage that balls should guide: pockets with radial axes do not hold it radially.  The laws of
    such a cage can be looked at.
    """
    slides = "its drilled pockets slide along the radius; outer (1) is allowed"
    require(
        p.cage.shape == variables.CageShape.RIBBON or p.cage.guidance != variables.CageGuidance.BALLS,
        f"cage.guidance = 2 (balls): a machined cage (cage.shape) has no such guidance, {slides}",
    )


def check_spall(p, body, sizes, diameter):
    """A spall has a length, a width and a depth, or none of them.  It is at most half a turn long and as wide as the
    ball, and its depth is small beside the ball, which rolls over its edges.  body: name of the ring or ball of this
    diameter.
    """
    D, parts = p.bearing.D, dict(zip(("length", "width", "depth"), sizes, strict=True))
    limits = {
        "length": (0.5 * math.pi * diameter, "half the circumference"),
        "width": (D, "bearing.D"),
        "depth": (0.05 * D, "bearing.D/20"),
    }
    whole = (
        f"a spall has {body}.spall_length, {body}.spall_width and {body}.spall_depth; more than 0 m is allowed, or 0 m for "
        "all three"
    )
    for name, value in parts.items():
        most, meaning = limits[name]
        require(value <= most, f"{body}.spall_{name} = {value} m: at most {meaning}, {most:g} m, is allowed")
        require(value > 0.0 or not any(parts.values()), f"{body}.spall_{name} = 0 m: {whole}")


def check_spalls(p):
    """Spalls of both rings and of the balls."""

    def sizes(q):
        return q.spall_length, q.spall_width, q.spall_depth

    check_spall(p, "inner", sizes(p.inner), p.bearing.d_m - p.bearing.D)
    check_spall(p, "outer", sizes(p.outer), p.bearing.d_m + p.bearing.D)
    for j, of_ball in enumerate(zip(*sizes(p.ball), strict=True), 1):
        check_spall(p, f"ball[{j}]", of_ball, p.bearing.D)


def check_geometry(p):
    """Refuse parameters that contradict each other: ValueError naming one of them, its value and what is allowed."""
    D, d_m = p.bearing.D, p.bearing.d_m
    chord, pocket, play = d_m * math.sin(math.pi / Z), p.cage.pocket_clearance, largest_clearance(p)
    require(
        D < chord, f"bearing.D = {D} m: the balls overlap; less than bearing.d_m sin(pi/Z) = {chord:g} m is allowed"
    )
    apart = f"the pockets overlap; less than bearing.d_m sin(pi/Z) - bearing.D = {chord - D:g} m is allowed"
    require(D + pocket < chord, f"cage.pocket_clearance = {pocket} m: {apart}")
    far = f"a ball on one race would reach the other groove's far side; less than 4 (min(f_i, f_e) - 1/2) D = {play:g} m is allowed"
    require(p.bearing.P_d < play, f"bearing.P_d = {p.bearing.P_d} m: {far}")
    require(
        -p.bearing.P_d < 0.01 * D,
        f"bearing.P_d = {p.bearing.P_d} m: the interference exceeds 1 % of bearing.D; at least {-0.01 * D:g} m is allowed",
    )
    softest = PARAMETERS["bearing.E"].min
    require(
        p.ball.E == 0.0 or p.ball.E >= softest,
        f"ball.E = {p.ball.E} Pa: 0, which stands for bearing.E, or at least {softest:g} Pa is allowed",
    )
    require(p.cage.D_i < p.cage.D_o, f"cage.D_i = {p.cage.D_i} m: less than cage.D_o = {p.cage.D_o} m is allowed")
    require(p.cage.D_i < d_m, f"cage.D_i = {p.cage.D_i} m: less than bearing.d_m = {d_m} m is allowed")
    require(d_m < p.cage.D_o, f"cage.D_o = {p.cage.D_o} m: more than bearing.d_m = {d_m} m is allowed")
    bore = ring_fit_bore(p)
    require(
        bore < d_m - D,
        f"ring.bore = {bore} m: less than the diameter of the inner groove's bottom, {d_m - D:g} m, is allowed",
    )
    at_least = f"at least the diameter of the inner groove's bottom, {d_m - D:g} m, is allowed"
    require(ring_fit_effective_i(p) >= d_m - D, f"ring.effective_i = {p.ring.effective_i} m: {at_least}")
    at_most = f"at most the diameter of the outer groove's bottom, {d_m + D:g} m, is allowed"
    require(ring_fit_effective_e(p) <= d_m + D, f"ring.effective_e = {p.ring.effective_e} m: {at_most}")
    outside, housing = ring_fit_outside(p), p.housing.outside
    require(
        outside > d_m + D,
        f"ring.outside = {outside} m: more than the diameter of the outer groove's bottom, {d_m + D:g} m, is allowed",
    )
    require(
        p.shaft.bore < bore,
        f"shaft.bore = {p.shaft.bore} m: less than the bore of the inner ring, {bore:g} m, is allowed",
    )
    wider = f"0 or more than the outside diameter of the outer ring, {outside:g} m, is allowed"
    require(housing == 0.0 or housing > outside, f"housing.outside = {housing} m: {wider}")
    check_spalls(p)
    half = 0.5 * p.cage.width
    require(
        p.cage.land_width <= half,
        f"cage.land_width = {p.cage.land_width} m: at most half of cage.width, {half:g} m, is allowed",
    )
    require(
        p.cage.guidance == variables.CageGuidance.OUTER or pocket > 0.0,
        f"cage.pocket_clearance = {pocket} m: more than 0 m is allowed of a cage that balls guide",
    )
    most = 2.0 * p.cage.m * 2e-4  # cages are true to 0.2 mm at worst
    require(
        p.cage.unbalance <= most,
        f"cage.unbalance = {p.cage.unbalance} kg.m: the cage's centre of mass is more than 0.2 mm off; at most "
        f"2 cage.m 0.2 mm = {most:g} kg.m is allowed",
    )
    check_ribbon(p)
    require(p.oil.T_1 < p.oil.T_2, f"oil.T_1 = {p.oil.T_1} K: less than oil.T_2 = {p.oil.T_2} K is allowed")
    falls = f"more than oil.nu_2 = {p.oil.nu_2} m2/s is allowed, for the viscosity falls with temperature"
    require(p.oil.nu_1 > p.oil.nu_2, f"oil.nu_1 = {p.oil.nu_1} m2/s: {falls}")
    require(
        p.fatigue.k_2 >= p.fatigue.k_1,
        f"fatigue.k_2 = {p.fatigue.k_2}: at least fatigue.k_1 = {p.fatigue.k_1} is allowed",
    )
    on = "rivets break by their damage, which scene.stress = fatigue alone counts; allowed is off, or on with it"
    counted = p.scene.breakage != variables.Switch.ON or p.scene.stress == variables.Stress.FATIGUE
    require(counted, f"scene.breakage = on: {on}")
    apart = p.pulse.count < 2 or p.pulse.interval >= p.pulse.duration
    require(apart, f"pulse.interval = {p.pulse.interval} s: at least pulse.duration = {p.pulse.duration} s is allowed")
    clearance = pocket + p.pocket.dD
    for j, (dD, excess) in enumerate(zip(p.ball.dD, p.pocket.dD, strict=True)):
        less = f"less than cage.pocket_clearance + pocket[{j + 1}].dD = {clearance[j]} m is allowed"
        require(
            excess >= 0.0 or clearance[j] > 0.0,
            f"pocket[{j + 1}].dD = {excess} m: more than -cage.pocket_clearance = {-pocket} m is allowed",
        )
        require(dD <= 0.0 or dD < clearance[j], f"ball[{j + 1}].dD = {dD} m: {less}")
