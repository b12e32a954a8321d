"""Parameters and inputs by the names of the variable table (variables.py): p.bearing.D, p.scene.cage, u.shaft.F_x ...  SI units.

A name that Python reserves has an underscore behind it: p.bearing.lambda_.
"""

import keyword
import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np

from bearing_model import variables
from bearing_model.variables import INPUTS, PARAMETERS, Z

ENUMERATIONS = (
    variables.TiltMode,
    variables.RingMotion,
    variables.CageModel,
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


class Values:
    """Groups of values of one table, start values where nothing is given."""

    def __init__(self, table, values=None):
        values = dict(values or {})
        for name, variable in table.items():
            value = values.pop(name, variable.start)
            if variable.count > 1:
                value = [value] * variable.count if np.ndim(value) == 0 else value
                value = [values.pop(name.replace("[j]", f"[{j + 1}]").replace("[k]", f"[{j + 1}]"), v) for j, v in enumerate(value)]
                require(len(value) == variable.count, f"{name}: {len(value)} values; {variable.count} are needed")
                value = np.array([admit(variable, v) for v in value])
            else:
                value = admit(variable, value)
            group, member = name.replace("[j]", "").split(".")
            member += "_" * keyword.iskeyword(member)
            if not hasattr(self, group):
                setattr(self, group, SimpleNamespace())
            setattr(getattr(self, group), member, value)
        require(not values, f"{', '.join(values)}: unknown; variables are listed in docs/parameters.md")


class Parameters(Values):
    """All parameters; ValueError for an unknown name, a value outside its limits, or values that together make no bearing.

    >>> Parameters({"bearing.P_d": 0.0, "scene.lubrication": "mixed"}).scene.lubrication
    <Lubrication.MIXED: 2>
    """

    def __init__(self, values=None):
        super().__init__(PARAMETERS, values)
        check_geometry(self)


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
            raise ValueError(f"{variable.name} = {value}: allowed are {allowed}") from None
    low = -math.inf if variable.min is None else variable.min
    high = math.inf if variable.max is None else variable.max
    unit = "" if variable.unit == "1" else f" {variable.unit}"
    require(math.isfinite(value) and low <= value <= high, f"{variable.name} = {value}{unit}: {low:g} ... {high:g} is allowed")
    return int(value) if variable.type == "Integer" else float(value)


def check_geometry(p):
    """Refuse parameters that contradict each other: ValueError naming one of them, its value and what is allowed."""
    D, d_m = p.bearing.D, p.bearing.d_m
    chord, pocket, play = d_m * math.sin(math.pi / Z), p.cage.pocket_clearance, 4.0 * (min(p.bearing.f_i, p.bearing.f_e) - 0.5) * D
    require(D < chord, f"bearing.D = {D} m: the balls overlap; less than bearing.d_m sin(pi/Z) = {chord:g} m is allowed")
    apart = f"the pockets overlap; less than bearing.d_m sin(pi/Z) - bearing.D = {chord - D:g} m is allowed"
    require(D + pocket < chord, f"cage.pocket_clearance = {pocket} m: {apart}")
    far = f"a ball on one race would reach the other groove's far side; less than 4 (min(f_i, f_e) - 1/2) D = {play:g} m is allowed"
    require(p.bearing.P_d < play, f"bearing.P_d = {p.bearing.P_d} m: {far}")
    require(-p.bearing.P_d < 0.01 * D, f"bearing.P_d = {p.bearing.P_d} m: the interference exceeds 1 % of bearing.D; at least {-0.01 * D:g} m is allowed")
    require(p.cage.D_i < p.cage.D_o, f"cage.D_i = {p.cage.D_i} m: less than cage.D_o = {p.cage.D_o} m is allowed")
    require(p.cage.D_i < d_m, f"cage.D_i = {p.cage.D_i} m: less than bearing.d_m = {d_m} m is allowed")
    require(d_m < p.cage.D_o, f"cage.D_o = {p.cage.D_o} m: more than bearing.d_m = {d_m} m is allowed")
    half = 0.5 * p.cage.width
    require(p.cage.land_width <= half, f"cage.land_width = {p.cage.land_width} m: at most half of cage.width, {half:g} m, is allowed")
    require(p.fatigue.k_2 >= p.fatigue.k_1, f"fatigue.k_2 = {p.fatigue.k_2}: at least fatigue.k_1 = {p.fatigue.k_1} is allowed")
    apart = p.pulse.count < 2 or p.pulse.interval >= p.pulse.duration
    require(apart, f"pulse.interval = {p.pulse.interval} s: at least pulse.duration = {p.pulse.duration} s is allowed")
    j = np.argmax(p.ball.dD)
    dD = p.ball.dD[j]
    require(dD <= 0.0 or dD < pocket, f"ball[{j + 1}].dD = {dD} m: less than cage.pocket_clearance = {pocket} m is allowed")
