"""An oil that a user gives: by its viscosity at oil.T_0, or by two points of a data sheet; either one defines it.

In the FMU a viscosity left at its start value is that of the two points.  Files, scenes and --set also record which of
the two was given.  Both together are refused if they contradict each other; of two documents the later one decides.
"""

import math
from types import SimpleNamespace

from bearing_model.physics.temperature import oil_ratios
from bearing_model.physics.viscosity import Oil

from .errors import UserError, refusal

POINTS = ("oil.nu_1", "oil.nu_2")
AT_T_0 = {"oil.eta": 0.01, "oil.beta": 0.05}  # follow from the points; how far apart one oil's may be
CONSISTENT = 1e-3  # of an FMU's own viscosity and points
NEEDED = ("nu_1", "T_1", "nu_2", "T_2", "T_0", "rho")


def of_points(values):
    """oil.eta [Pa.s] and oil.beta [1/K] at oil.T_0 by the two points; ValueError if they make no oil.

    values: of the parameters oil.*, by full name.
    """
    nu_1, T_1, nu_2, T_2, T_0, rho = (values[f"oil.{name}"] for name in NEEDED)
    points = Oil(nu_1, T_1, nu_2, T_2)
    return {"oil.eta": float(rho * points.nu(T_0)), "oil.beta": float(points.beta(T_0))}


def viscosity(values, start, T):
    """Viscosity [Pa.s] at T [K] as the FMU has it: a start value is that of the two points; ValueError if they make no
    oil.

    values, start: of the parameters oil.*, by full name, as they are and as the FMU has them at the start.
    """
    oil, own = map(plain, (values, start))
    return float(oil.eta * oil_ratios(oil, T, own if oil.eta == own.eta else oil)[0])


def plain(values):
    """Values by full name as the model has them, oil.nu_1 as nu_1."""
    return SimpleNamespace(**{name.removeprefix("oil."): value for name, value in values.items()})


def check_given(where, given, written, values):
    """UserError if one document gives the viscosity twice, and differently.

    given: the document's parameters in SI; written: the same as it has them; values: all of oil.*, by full name.
    """
    if not {*POINTS} <= given.keys():
        return
    try:
        found = of_points(values)
    except ValueError as problem:
        raise UserError(f"{where}: oil.nu_1, oil.nu_2: {problem}") from None
    for name, apart in AT_T_0.items():
        if name in given and not math.isclose(given[name], found[name], rel_tol=apart):
            unit, factor = ("mPa.s", 1e3) if name == "oil.eta" else ("1/K", 1.0)
            reason = (
                f"oil.nu_1 and oil.nu_2 mean {factor * found[name]:.4g} {unit} at oil.T_0 = "
                f"{values['oil.T_0'] - 273.15:.4g} degC: leave {name} or the two points out"
            )
            raise refusal(where, name, written.get(name, given[name]), reason)


def check_pair(where, given, written):
    """UserError for one point of a bearing file's oil without the other, which would be the 6207's."""
    for name, other in (POINTS, POINTS[::-1]):
        if name in given and other not in given:
            T = other.replace("nu", "T")
            raise refusal(where, name, written.get(name, given[name]), f"give {other} at {T} too: one point is no oil")


def merged(earlier, given, start):
    """Parameters of a scene with those that a later document gives.

    Two points replace an earlier viscosity, and the FMU's own (`start`: values of its oil.*) where it is not that of
    the FMU's points.
    """
    if not {*POINTS} <= given.keys():
        return earlier | given
    parameters = {name: value for name, value in earlier.items() if name not in AT_T_0} | given
    own, found = of_points(start), of_points(start | parameters)
    consistent = math.isclose(start["oil.eta"], own["oil.eta"], rel_tol=CONSISTENT)
    return parameters if consistent else {"oil.eta": found["oil.eta"]} | parameters
