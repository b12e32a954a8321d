"""An oil that a user gives: by its viscosity at oil.T_0, or by two points of a data sheet; either one defines it.

    oil = "mineral ISO VG 32"                       # or "PAO 68", "ester ISO VG 100", "aviation"
    oil = { kind = "mineral", grade = "ISO VG 32" } # the same; without a grade the viscosity is that of [parameters]

In the FMU a viscosity left at its start value is that of the two points.  Files, scenes and --set also record which of
the two was given.  Both together are refused if they contradict each other; of two documents the later one decides.  A
kind (data/oils.toml) sets what else the model has of an oil: pressure coefficient, traction, density, conductivity.
"""

import math
import re
import tomllib
from functools import cache
from importlib.resources import files
from types import SimpleNamespace
from typing import Any

import numpy as np

from bearing_model.generated.variables import PARAMETERS
from bearing_model.physics.temperature import oil_ratios
from bearing_model.physics.viscosity import Oil

from ..base.errors import UserError, naming, refusal, unknown
from ..base.units import rounded

TABLE = files("riveted_bearing") / "data" / "oils.toml"
KEYS = ("kind", "grade")
OF_PROPERTY = {  # names of a kind's properties by those of the FMU
    **dict.fromkeys(("oil.nu_1", "oil.nu_2"), "grade"),
    **dict.fromkeys(("oil.A", "oil.B", "oil.C"), "friction"),
    "oil.alpha": "alpha",
    "oil.alpha_T": "alpha_T",
    "oil.rho": "density",
    "oil.expansion": "expansion",
    "oil.k": "conductivity",
}
TRACTION = {name: PARAMETERS[name].start for name in ("oil.A", "oil.B", "oil.C")}
VG, OF_GRADE = "ISO VG ", 0.1  # a grade of ISO 3448 is 10 % wide to both sides
PARTS_TEMPERATURES = ("ring.T_i", "ring.T_e", "ball.T", "cage.T")  # the oil's unless given
ALL_TEMPERATURES = ("oil.T", *PARTS_TEMPERATURES)
T_DENSITY, T_40, T_100, T_JONES = 288.15, 313.15, 373.15, 311.15  # [K]

POINTS = ("oil.nu_1", "oil.nu_2")
AT_T_0 = {"oil.eta": 0.01, "oil.beta": 0.05}  # follow from the points; how far apart one oil's may be
CONSISTENT = 1e-3  # of an FMU's own viscosity and points
NEEDED = ("nu_1", "T_1", "nu_2", "T_2", "T_0", "rho")


def of_points(values):
    """oil.eta [Pa.s] and oil.beta [1/K] at oil.T_0 by the points in values (oil.*); ValueError if they make no oil."""
    nu_1, T_1, nu_2, T_2, T_0, rho = (values[f"oil.{name}"] for name in NEEDED)
    points = Oil(nu_1, T_1, nu_2, T_2)
    return {"oil.eta": float(rho * points.nu(T_0)), "oil.beta": float(points.beta(T_0))}


def viscosity(values, start, T):
    """Viscosity [Pa.s] at T [K] of parameters oil.*, by full name; one left at its start is that of the two points."""
    oil, own = map(plain, (values, start))
    return float(oil.eta * oil_ratios(oil, T, own if oil.eta == own.eta else oil)[0])


def plain(values: dict[str, Any]) -> SimpleNamespace:
    """Values by full name as the model has them, oil.nu_1 as nu_1."""
    return SimpleNamespace(**{name.removeprefix("oil."): value for name, value in values.items()})


def check_given(where: Any, given: Any, written: Any, values: Any) -> Any:
    """UserError if a document's parameters (given, SI; written) have the viscosity twice, and differently; values: all oil.*."""
    if not {*POINTS} <= given.keys():
        return
    with naming(f"{where}: oil.nu_1, oil.nu_2"):
        found = of_points(values)
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


def merged(earlier: Any, given: Any, start: Any) -> Any:
    """Parameters of a scene with those of a later document; its two points replace an earlier viscosity, and the FMU's own
    (`start`: its oil.*) where that is not that of the FMU's points.
    """
    if not {*POINTS} <= given.keys():
        return earlier | given
    parameters = {name: value for name, value in earlier.items() if name not in AT_T_0} | given
    own, found = of_points(start), of_points(start | parameters)
    consistent = math.isclose(start["oil.eta"], own["oil.eta"], rel_tol=CONSISTENT)
    return parameters if consistent else {"oil.eta": found["oil.eta"]} | parameters


# Kinds of oil ---------------------------------------------------------------------------------------------------------


@cache
def kinds():
    """All kinds of oil by name: {"grades": viscosities by grade, property: (value, source)}."""
    return tomllib.loads(TABLE.read_text(encoding="utf-8"))


def named(where: Any, written: Any, given: Any, start: Any) -> Any:
    """Name and parameters of the oil that a document names, without those that it gives; "" and none for None.

    written: the document's `oil`; given: its parameters in SI; start: all of oil.* without it, by full name.
    """
    if written is None:
        return "", {}
    kind, grade = kind_and_grade(where, written)
    name = " ".join(filter(None, (kind, grade)))
    values = start | given
    entry = SimpleNamespace(
        **{key: value[0] if isinstance(value, list) else value for key, value in kinds()[kind].items()}
    )
    found = traction_of(entry) | density_of(entry, values["oil.T_0"])
    with naming(f"{where}: oil.nu_1, oil.nu_2"):
        found |= points_of(where, written, kind, grade, given, values | found | given)
        found |= pressure_of(entry, values | found | given)
    return name, {key: rounded(value) for key, value in found.items() if key not in given}


def kind_and_grade(where, written):
    """Kind and grade of an oil as a document has it, the grade "" without one; UserError for others."""
    table = written if isinstance(written, dict) else {"kind": written}
    for key in table:
        if key not in KEYS:
            hint = f"; viscosities stand in [parameters], oil.{key}" if f"oil.{key}" in OF_PROPERTY else ""
            raise UserError(f"{unknown(f'{where}: oil', 'key', key, KEYS)}{hint}")
    kind, grade = table.get("kind"), table.get("grade", "")
    allowed = ", ".join(kinds())
    if not isinstance(kind, str) or isinstance(grade, bool) or not isinstance(grade, str | int):
        raise refusal(
            where, "oil", written, f'a kind with its grade is needed, as "mineral ISO VG 32"; kinds: {allowed}'
        )
    words = kind.replace(",", " ").split()
    found = [name for word in words for name in kinds() if word.lower() == name.lower()]
    if not found:
        raise unknown(where, "oil", kind, kinds())
    if len(found) > 1:
        raise refusal(where, "oil", written, "one kind is needed")
    rest = " ".join(word for word in words if word.lower() != found[0].lower())
    if rest and grade:
        raise refusal(where, "oil", written, "one grade is needed")
    return found[0], grade_of(where, written, found[0], str(grade or rest))


def grade_of(where, written, kind, text):
    """A grade as the table of kinds has it, ISO VG 32 or a specification; UserError for one that it does not have."""
    grades = kinds()[kind]["grades"]
    if not text:
        return next(iter(grades)) if len(grades) == 1 else ""
    number = re.fullmatch(r"(?:ISO)?[ -]*(?:VG)?[ -]*(\d+)", text, re.IGNORECASE)
    key = number[1] if number else text.upper()
    if key not in grades:
        iso = VG if len(grades) > 1 else ""
        raise refusal(where, "oil", written, f"allowed grades of {kind} oils: {iso}{', '.join(grades)}")
    return f"{VG}{key}" if number else key


def points_of(where, written, kind, grade, given, values):
    """oil.nu_1 and oil.nu_2 of a kind's oil: of its grade, or through the one viscosity given; none if both are."""
    table, known = kinds()[kind]["grades"], [name for name in (*POINTS, "oil.eta") if name in given]
    if {*POINTS} <= given.keys():
        check_grade(where, written, grade, float(Oil(*(values[f"oil.{name}"] for name in NEEDED[:4])).nu(T_40)))
        return {}
    if len(table) == 1:
        (nu_40, nu_100), known = next(iter(table.values())), [name for name in known if name != "oil.eta"]
        if known:
            check_pair(where, given, given)
    elif known:
        nu_40 = viscosity_at_40(where, kind, known[0], given, values)
        check_grade(where, written, grade, 1e-6 * nu_40)
        nu_100 = at_100(table, nu_40)
    elif grade:
        nu_40 = float(grade.removeprefix(VG))
        nu_100 = table[grade.removeprefix(VG)]
    else:
        allowed = f'as "{kind} {VG}32", or by oil.nu_1 or oil.nu_2 in [parameters]'
        raise refusal(where, "oil", written, f"its viscosity is needed: {allowed}")
    oil = Oil(1e-6 * nu_40, T_40, 1e-6 * nu_100, T_100)
    return {point: rounded(oil.nu(values[point.replace("nu", "T")])) for point in POINTS}


def at_100(table, nu_40):
    """Viscosity [mm2/s] at 100 degC of an oil between a kind's grades."""
    logs = np.log([float(number) for number in table]), np.log(list(table.values()))
    return float(np.exp(np.interp(np.log(nu_40), *logs)))


def viscosity_at_40(where, kind, name, given, values):
    """Viscosity [mm2/s] at 40 degC of a kind's oil that has a given viscosity at its temperature."""
    table = kinds()[kind]["grades"]
    T = values["oil.T_0" if name == "oil.eta" else name.replace("nu", "T")]
    nu = values[name] / (values["oil.rho"] if name == "oil.eta" else 1.0)
    all_40 = np.geomspace(*(float(number) for number in (next(iter(table)), next(reversed(table)))), 400)
    there = np.array([float(Oil(1e-6 * low, T_40, 1e-6 * at_100(table, low), T_100).nu(T)) for low in all_40])
    if not there[0] <= nu <= there[-1]:
        low, high = (f"{1e6 * value:.3g}" for value in (there[0], there[-1]))
        reason = (
            f"{low} to {high} mm2/s at {T - 273.15:.4g} degC are those of {kind} oils; else give oil.nu_1 and oil.nu_2"
        )
        raise refusal(where, name, given[name], reason)
    return float(np.exp(np.interp(np.log(nu), np.log(there), np.log(all_40))))


def check_grade(where, written, grade, nu):
    """UserError for a viscosity nu [m2/s] at 40 degC that is not of the grade."""
    if grade.startswith(VG) and not math.isclose(1e6 * nu, float(grade.removeprefix(VG)), rel_tol=OF_GRADE):
        reason = f"[parameters] have {1e6 * nu:.3g} mm2/s at 40 degC: leave the grade or these out"
        raise refusal(where, "oil", written, reason)


def density_of(entry, T_0):
    """oil.rho [kg/m3] and oil.expansion [1/K] at T_0 from the density at 15 degC, and oil.k [W/m.K]."""
    fall = entry.density * entry.expansion
    rho = entry.density - fall * (T_0 - T_DENSITY)
    return {"oil.rho": rho, "oil.expansion": fall / rho, "oil.k": entry.conductivity}


def pressure_of(entry, values):
    """oil.alpha [1/Pa] at oil.T_0, oil.alpha_T [1/K]: measured, or s nu^t with its mean fall from 40 to 100 degC."""
    T_0 = values["oil.T_0"]
    if hasattr(entry, "alpha"):
        return {"oil.alpha": entry.alpha * math.exp(-entry.alpha_T * (T_0 - T_JONES)), "oil.alpha_T": entry.alpha_T}
    oil = Oil(*(values[f"oil.{name}"] for name in NEEDED[:4]))
    nu_0, nu_40, nu_100 = (1e6 * float(oil.nu(T)) for T in (T_0, T_40, T_100))
    fall = entry.t * math.log(nu_40 / nu_100) / (T_100 - T_40)
    return {"oil.alpha": 1e-9 * entry.s * nu_0**entry.t, "oil.alpha_T": fall}


def traction_of(entry):
    """The traction law of the variable table, scaled to the kind's friction in full sliding."""
    share = entry.friction / -TRACTION["oil.A"]
    return TRACTION | {name: share * TRACTION[name] for name in ("oil.A", "oil.B")}


def largest_traction(A: Any, B: Any, C: Any) -> Any:
    """Largest traction coefficient of mu(s) = (A + B s) exp(-C s) - A, at s = 1/C - A/B."""
    return B / C * math.exp(A * C / B - 1.0) - A


def origin_of(name):
    """Origin of values that follow from the oil which a file names."""
    return f"{name} oil"


def name_of(origin):
    """Name of the oil that a bearing's file names, by the origin of its values; "" for none."""
    return next((of.removesuffix(" oil") for of in origin.values() if str(of).endswith(" oil")), "")


def source_of(name: str, parameter: Any) -> Any:
    """Where a named oil's parameter comes from, in words; "" for none of its."""
    key, (kind, _, grade) = OF_PROPERTY.get(parameter), name.partition(" ")
    entry = kinds().get(kind, {})
    if key == "grade":
        index = entry.get("viscosity_index", [""])[0]
        return f"{grade}, viscosity index {index}" if grade and index else grade
    if key in ("alpha", "alpha_T") and "s" in entry:
        return f"{entry['s'][0]:g} nu^{entry['t'][0]:g}, {entry['s'][1]}"
    return entry[key][1] if key in entry else ""
