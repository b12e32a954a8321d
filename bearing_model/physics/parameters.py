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

from bearing_model.cage.common.pocket_spheres_setup import spheres_edge, spheres_seams
from bearing_model.generated import variables
from bearing_model.generated.limits import LIMITS
from bearing_model.generated.variables import INPUTS, PARAMETERS, Z
from bearing_model.physics.ring_fit import ring_fit_bore, ring_fit_effective_e, ring_fit_effective_i, ring_fit_outside

TYPES = {enumeration.__name__: enumeration for enumeration in variables.ENUMERATIONS}


def place(name):
    """Group and member of a variable: "bearing.lambda" is p.bearing.lambda_."""
    group, member = re.sub(r"\[[jkn]\]", "", name).split(".")
    return group, member + "_" * keyword.iskeyword(member)


def value_of(values, name):
    """A value by its name in the table, of Values or of groups like them."""
    group, member = place(name)
    return getattr(getattr(values, group), member)


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
        return value_of(self, name)


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


def follows_mass(p, name):
    """A moment of inertia of the half: left at its start value it follows the mass, which scales the density."""
    J, mass_ratio = getattr(p.cage, name), p.cage.m / PARAMETERS["cage.m"].start
    return mass_ratio * J if PARAMETERS[f"cage.{name}"].start == J else J


def in_force(given):
    """Parameters with the sizes that 0 leaves to a rule and the moments of inertia that follow the mass filled in."""
    p = copy.copy(given)
    p.cage, p.ring = copy.copy(given.cage), copy.copy(given.ring)
    p.cage.J_p, p.cage.J_t = follows_mass(given, "J_p"), follows_mass(given, "J_t")
    p.ring.bore, p.ring.outside = ring_fit_bore(given), ring_fit_outside(given)
    p.ring.effective_i, p.ring.effective_e = ring_fit_effective_i(given), ring_fit_effective_e(given)
    if given.cage.shape == variables.CageShape.RIBBON:
        p.cage.pocket_edge = spheres_edge(given)
    return p


def check_limits(p, limits, where=""):
    """ValueError with the message of the first limit that does not hold, behind `where`."""
    for limit in limits:
        for j in range(Z) if limit.is_array else (None,):
            if not limit.holds(p, Z, j):
                raise ValueError(where + limit.message(p, Z, j))


def check_geometry(p):
    """Refuse parameters that contradict each other: ValueError naming one of them, its value and the allowed range."""
    check_limits(in_force(p), [limit for limit in LIMITS if limit.at == "everywhere"])
    if p.cage.shape == variables.CageShape.RIBBON:
        squares = sum(sine**2 for sine in spheres_seams(p))
        require(
            squares < 0.95,
            "cage.pocket_fillet, cage.D_o - cage.D_i: the sum of the squares of the sines of the angles of fillet and "
            f"edges is {squares:g}; less than 0.95 is allowed for a sphere between them",
        )


def check_run(p):
    """Refuse parameters whose laws can be looked at, but of which no run is possible."""
    check_limits(in_force(p), [limit for limit in LIMITS if limit.at == "run"])
