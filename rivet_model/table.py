"""Making and writing the rivet table; bearing_model.rivet.rivet_table holds its format and its reader."""

import json
from pathlib import Path

import numpy as np

from bearing_model.rivet.rivet_table import (
    CHANNELS,
    FORMAT,
    MPA_PER_N,
    SHANK_AXES,
    SHEETS,
    RivetTable,
    ShankTable,
    as_embedded,
    digest_of,
)

from . import splines
from .geometry import Geometry

OF_RIBBON = ("radii", "spin_preload")  # in the section half of a ribbon
UNITS = {
    "T": "MPa/N",
    "xi": "m/N",
    "fit": "m",
    "stiffness": "N/m",
    "length": "m",
    "stress": "Pa",
    "expansion": "1/K",
    "half": "SI",
    "modes": "SI",
}


def rounded(numbers, digits=5):
    """The numbers as the file keeps them: five digits, a hundredth of the table's own error; four where the error is 1
    %.
    """
    return np.array([float(f"{value:.{digits}g}") for value in np.ravel(numbers)]).reshape(np.shape(numbers))


def write(table, path):
    """Write the table as JSON text; the same table gives the same bytes."""
    shank = table.shank
    sections = {
        "shank": {
            "length": shank.length,
            "knots": {name: [float(v) for v in shank.knots[name]] for name in SHANK_AXES},
            "order": [*SHANK_AXES, "sheet", "channel"],
            "sheets": list(SHEETS),
            "channels": list(CHANNELS),
            "head_friction": table.head_friction / MPA_PER_N,
            "head_friction_vm": table.head_friction_vm / MPA_PER_N,
            "yield_rivet": table.yield_rivet,
            "coefficients": rounded(shank.coefficients / MPA_PER_N).ravel().tolist(),
        },
        "fit_eff": {
            "fit_a": [float(v) for v in table.fit_a],
            "j2": [float(v) for v in table.fit_eff],
            "slope": [float(v) for v in table.fit_slope],
            "fit_flange_yield": table.fit_flange_yield,
        },
        "joint": {
            key: (value if np.isscalar(value) else [float(v) for v in value]) for key, value in table.joint.items()
        },
        "half": _half_section(table.half),
        "modes": _modes_section(table.modes) if table.modes else {},
    }
    header = {
        "format": FORMAT,
        "kind": table.kind,
        "note": table.note,
        "geometry_hash": table.geometry_hash,
        "geometry": table.geometry,
        "Z": table.Z,
        **({"shape": table.shape} if table.shape != "machined" else {}),
        "units": UNITS,
        "errors": table.errors,
        "digest": digest_of(sections),
    }
    blocks = [
        f'"{name}":{json.dumps(value, separators=(",", ":"))}'
        for name, value in ({"header": header} | sections).items()
    ]
    Path(path).write_text("{\n" + ",\n".join(blocks) + "\n}\n", encoding="utf-8")


def _half_section(half):
    law = half.law
    return {
        **{name: float(f"{getattr(half, name):.9g}") for name in ("m", "x_c", "J_p", "J_t", "k_closed", "k_open")},
        "chi": [float(v) for v in half.chi],
        **({name: rounded(getattr(half, name), 9).tolist() for name in OF_RIBBON} if len(half.radii) else {}),
        **({"yield_force": float(f"{half.yield_force:.4g}")} if len(half.radii) else {}),
        "path": rounded(tidy(half.path), 4).tolist(),
        "spin": rounded(tidy(half.spin)).tolist(),
        "land": rounded(tidy(half.land)).tolist(),
        "growth": rounded(half.growth).tolist(),
        "stiffness": rounded(tidy(law.stiffness)).tolist(),
        "slip_stiffness": rounded(tidy(law.slip_stiffness)).tolist(),
        "law": _law_section(law),
    }


def _law_section(law):
    return {
        "length": law.length,
        "knots": {name: [float(v) for v in law.knots[name]] for name in law.knots},
        "coefficients": rounded(tidy(law.coefficients), 4).ravel().tolist(),
    }


def _modes_section(modes):
    """Shapes to seven digits, as the softest modes' share of the flexibility is some thousand times the residual; the
    residual to five.  The energy U to seven: of open joints it is nearly all of e L_K/2.
    """
    shapes = {
        name: rounded(tidy(getattr(modes, name)), 7).tolist()
        for name in ("pocket", "pad", "rivet", "rim", "land", "spin")
    }
    return {
        "omega": rounded(modes.omega, 9).tolist(),
        "harmonic": modes.harmonic.tolist(),
        "parity": modes.parity.tolist(),
        **shapes,
        "land_residual": rounded(tidy(modes.land_residual)).tolist(),
        "residual": {name: rounded(tidy(values)).tolist() for name, values in vars(modes.residual).items()},
        "law": _law_section(modes.law)
        | {
            "energy": rounded(modes.law.energy, 7).ravel().tolist(),
            "stiffness": rounded(tidy(modes.law.stiffness), 9).tolist(),
        },
    }


def tidy(array):
    """The array with 0 where a number is only rounding: below 1e-9 of the largest one with its last index (arrays whose
    last axis is of different kinds).
    """
    return np.where(np.abs(array) < 1e-9 * np.abs(array).max(axis=tuple(range(array.ndim - 1)) or None), 0.0, array)


def monotone_slopes(x, y):
    """Slopes of a C1, monotone piecewise cubic through the points (Fritsch and Butland 1984), one-sided at the ends."""
    h, d = np.diff(x), np.diff(y) / np.diff(x)
    w_1, w_2 = 2 * h[1:] + h[:-1], h[1:] + 2 * h[:-1]
    with np.errstate(divide="ignore", invalid="ignore"):
        inner = np.where(d[1:] * d[:-1] > 0, (w_1 + w_2) / (w_1 / d[:-1] + w_2 / d[1:]), 0.0)
    return np.concatenate([d[:1], inner, d[-1:]])


def make(geometry: Geometry, kind, length, knots, samples_mpa, fit_map, joint, half, **scalars):
    """A table from samples of the shank's stress [1/mm2] at the sites of the axes (splines.sites), in the order
    SHANK_AXES, then sheets, channels last.

    length: of the axis c [m]; fit_map: (fit_a, fit_eff) of the plastic map; half: HalfData.  scalars: the remaining
    members of RivetTable.
    """
    coefficients = as_embedded(rounded(splines.interpolate([knots[name] for name in SHANK_AXES], samples_mpa)))
    fit_a, fit_eff = map(np.asarray, fit_map)
    fit_slope = np.where(fit_eff == fit_a, 1.0, monotone_slopes(fit_a, fit_eff))  # elastic until yield
    return RivetTable(
        kind=kind,
        geometry=geometry.values,
        geometry_hash=geometry.digest,
        Z=geometry.Z,
        fit_a=fit_a,
        fit_eff=fit_eff,
        fit_slope=fit_slope,
        joint=joint,
        shank=ShankTable(length, knots, coefficients),
        half=half,
        yield_rivet=geometry.yield_rivet,
        **scalars,
    )
