"""Values that can be computed with but that few bearings have: most often a unit that was forgotten or mistaken."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from .materials import PARTS

if TYPE_CHECKING:
    from .case import Case

RATINGS = 1.5  # factor by which makers' C and C_0 do not differ from ISO 281 and ISO 76
FASTEST = 1.5e6 / 60e3  # n d_m = 1.5 million mm/min [m/s]: oil jets and hybrid bearings go somewhat beyond
SOLIDS = {  # property: least and largest of polymers, metals and ceramics, factor and unit shown
    "E": (0.4e9, 700e9, 1e-9, "GPa"),
    "density": (900.0, 2.3e4, 1.0, "kg/m3"),
    "expansion": (0.1e-6, 300e-6, 1e6, "1e-6/K"),
    "yield": (5e6, 5e9, 1e-6, "MPa"),
    "strength": (5e6, 5e9, 1e-6, "MPa"),
}
HARD = {  # the same of what rolls on each other: steels and ceramics
    "E": (150e9, 450e9, 1e-9, "GPa"),
    "density": (2400.0, 9000.0, 1.0, "kg/m3"),
    "expansion": (1e-6, 20e-6, 1e6, "1e-6/K"),
}
OF_RACES = {"rings": ("steels and ceramics", HARD), "balls": ("steels and ceramics", HARD)}
FORCES = {  # of a catalogue beside C and C_0: usual share of C, and by how much makers differ
    "C_u": (0.025, 4.0),
    "minimum_load": (0.01, 10.0),
}


def doubts(case: Case) -> Iterator[Any]:
    """Sentences on the values of a Case that few bearings have."""
    from riveted_bearing.bearing.load_ratings import (  # with SciPy, which takes half a second
        dynamic_rating,
        static_rating,
    )

    values = case.values
    balls = case.Z, values["bearing.D"], values["bearing.d_m"]
    for name, usual in (("C", dynamic_rating(*balls)), ("C_0", static_rating(*balls))):
        given = case.catalogue.get(name, usual)
        if abs(math.log(given / usual)) > math.log(RATINGS):
            yield f"{name} = {given:.4g} N, but these balls have {usual:.3g} N by {'ISO 281' if name == 'C' else 'ISO 76'}"
    for name, (share, apart) in FORCES.items():
        if name in case.catalogue and "C" in case.catalogue:
            given, usual = case.catalogue[name], share * case.catalogue["C"]
            if abs(math.log(given / usual)) > math.log(apart):
                yield f"{name} = {given:.4g} N: bearings of this C have some {usual:.3g} N"
    yield from odd_materials(values, case.materials)
    yield from fast(abs(values["shaft.omega"] - values.get("housing.omega", 0.0)), values["bearing.d_m"])


def odd_materials(values: Any, materials: Any = ()) -> Iterator[Any]:
    """Sentences on properties of materials by a bearing file's Material of each part, else by parameters."""
    for part, where in PARTS.items():
        material = dict(materials).get(part)
        own = {} if material is None else {key: material.values[key] for key in material.given}
        names = {key: f"{part}.{key}" for key in own} or where.parameters
        properties = own or {key: values.get(name) for key, name in where.parameters.items()}
        kind, ranges = OF_RACES.get(part, ("solids", SOLIDS))
        for key, (low, high, factor, unit) in (SOLIDS | ranges).items():
            value = properties.get(key)
            if value and not low <= value <= high:
                usual = f"{factor * low:.3g} to {factor * high:.3g} {unit}"
                yield f"{names[key]} = {factor * value:.3g} {unit}: {kind} have {usual}"


def fast(omega: Any, d_m: Any) -> Iterator[Any]:
    """A sentence on a speed [rad/s] that few ball bearings of a pitch diameter [m] reach."""
    if omega * d_m > 2.0 * math.pi * FASTEST:
        speed, product = 30.0 / math.pi * omega, omega * d_m * 30.0 / math.pi * 1e3
        yield (
            f"shaft.omega = {speed:,.0f} rev/min: n d_m = {1e-6 * product:.2g} million mm/min, few ball bearings go beyond "
            f"{60e-3 * FASTEST:.2g} million; a number without its unit is in rad/s"
        )
