"""The rivet table: one JSON text file, written by the model, read by the FMU's build and by Python.

Sections: `header` {format, kind closed_form|fe, note, geometry, geometry_hash, Z, units, errors, digest}, `stress` (knots and spline
coefficients of T, see fmu_src/rivet_rom.h), `fit_eff` (interference with plasticity), `joint` (stiffnesses for the dynamics), `load_path`
(see fmu_src/load_path.h).  Units in the file are SI except T, which is in MPa/N = 1/mm2 to keep it readable.
"""

import hashlib
import json
from dataclasses import asdict, dataclass, field
from pathlib import Path

import numpy as np

from . import splines
from .geometry import Geometry

FORMAT = "rivet-table-1"
CHANNELS = ("head_p1", "head_vm", "mid_vm", "mid_p1")
AXES = ("a", "b", "c", "xi")
SHEETS = ("plane", "across")
MPA_PER_N = 1e6  # 1/mm2 in 1/m2
UNITS = {"T": "MPa/N", "xi": "m/N", "fit": "m", "stiffness": "N/m", "length": "m", "stress": "Pa", "expansion": "1/K", "load_path": "1 and m"}
JOINT_KEYS = (
    "A",
    "d_m",
    "grip",
    "k_rivet",
    "k_plate",
    "k_t_plate",
    "k_t_head",
    "k_stack",
    "alpha_rivet",
    "alpha_flange",
    "d",
    "T_0",
    "prying_lever",
    "prying_share",
)


@dataclass
class RivetTable:
    """Everything the FMU knows of one rivet joint.  Arrays are those of the file; `coefficients` in 1/m2, rounded to six digits."""

    kind: str  # "closed_form" or "fe"
    geometry: dict
    geometry_hash: str
    Z: int
    moment_length: float  # L [m]
    knots: dict  # axis name -> knots
    coefficients: np.ndarray  # [a, b, c, xi, sheet, channel] [1/m2]
    head_friction: float  # [1/m2]
    head_friction_vm: float  # [1/m2]
    yield_rivet: float  # [Pa]
    fit_flange_yield: float  # [m]
    fit_a: np.ndarray
    fit_eff: np.ndarray
    fit_slope: np.ndarray
    joint: dict  # JOINT_KEYS and hole_fit, k_hole
    load_path: np.ndarray  # [Z, 5, 3]
    note: str = ""
    errors: dict = field(default_factory=dict)


def rounded(numbers):
    """The numbers as the file keeps them: six digits."""
    return np.array([float(f"{value:.6g}") for value in np.ravel(numbers)]).reshape(np.shape(numbers))


def _as_embedded(coefficients):
    """The coefficients that both readers use: those of the secondary channels in single precision."""
    coefficients = MPA_PER_N * coefficients
    secondary = [CHANNELS.index("head_vm"), CHANNELS.index("mid_p1")]
    coefficients[..., secondary] = coefficients[..., secondary].astype(np.float32)
    return coefficients


def _digest(sections):
    return hashlib.sha256(json.dumps(sections, sort_keys=True, separators=(",", ":")).encode()).hexdigest()


def write(table, path):
    """Write the table as JSON text; the same table gives the same bytes."""
    sections = {
        "stress": {
            "moment_length": table.moment_length,
            "knots": {name: [float(v) for v in table.knots[name]] for name in AXES},
            "order": [*AXES, "sheet", "channel"],
            "sheets": list(SHEETS),
            "channels": list(CHANNELS),
            "head_friction": table.head_friction / MPA_PER_N,
            "head_friction_vm": table.head_friction_vm / MPA_PER_N,
            "yield_rivet": table.yield_rivet,
            "coefficients": rounded(table.coefficients / MPA_PER_N).ravel().tolist(),
        },
        "fit_eff": {
            "fit_a": [float(v) for v in table.fit_a],
            "j2": [float(v) for v in table.fit_eff],
            "slope": [float(v) for v in table.fit_slope],
            "fit_flange_yield": table.fit_flange_yield,
        },
        "joint": {key: (value if np.isscalar(value) else [float(v) for v in value]) for key, value in table.joint.items()},
        "load_path": np.asarray(table.load_path, dtype=float).tolist(),
    }
    header = {
        "format": FORMAT,
        "kind": table.kind,
        "note": table.note,
        "geometry_hash": table.geometry_hash,
        "geometry": table.geometry,
        "Z": table.Z,
        "units": UNITS,
        "errors": table.errors,
        "digest": _digest(sections),
    }
    blocks = [f' "{name}": {json.dumps(value)}' for name, value in ({"header": header} | sections).items()]
    Path(path).write_text("{\n" + ",\n".join(blocks) + "\n}\n", encoding="utf-8")


def _need(condition, path, message):
    if not condition:
        raise ValueError(f"{path}: {message}")


def read(path, Z=None):
    """Read and check a table.

    Z: number of rivets that is needed, if given.  Raises ValueError naming file and fault (not JSON, another format, a damaged section, a wrong
    size, a table for another Z), OSError if it cannot be read.
    """
    try:
        data = json.loads(Path(path).read_text(encoding="utf-8"))
        header, stress, fit, joint, load_path = (data[k] for k in ("header", "stress", "fit_eff", "joint", "load_path"))
        known_format, digest = header["format"], header["digest"]
    except (json.JSONDecodeError, UnicodeDecodeError) as error:
        raise ValueError(f"{path}: not a rivet table (JSON text): {error}") from error
    except (KeyError, TypeError) as error:
        raise ValueError(f"{path}: not a rivet table: {error} is missing") from error
    _need(known_format == FORMAT, path, f"format is {known_format!r}; {FORMAT!r} is needed")
    _need(_digest({k: data[k] for k in data if k != "header"}) == digest, path, "damaged: the digest in the header does not fit its sections")
    _need(Z is None or header["Z"] == Z, path, f"made for Z = {header['Z']} rivets; Z = {Z} is needed")
    _need(stress["channels"] == list(CHANNELS), path, f"channels are {stress['channels']}; {list(CHANNELS)} are needed")
    knots = {name: np.array(stress["knots"][name]) for name in AXES}
    for name, values in knots.items():
        _need(len(values) >= 2 and np.all(np.diff(values) > 0), path, f"knots of axis {name} do not increase")
    shape = (*(len(knots[name]) + 1 for name in AXES), len(SHEETS), len(CHANNELS))
    _need(len(stress["coefficients"]) == np.prod(shape), path, f"{len(stress['coefficients'])} coefficients; {np.prod(shape)} are needed")
    load_path = np.array(load_path)
    _need(load_path.shape == (header["Z"], 5, 3), path, f"load_path has shape {load_path.shape}; {(header['Z'], 5, 3)} is needed")
    missing = [key for key in (*JOINT_KEYS, "hole_fit", "k_hole") if key not in joint]
    _need(not missing, path, f"joint lacks {missing}")
    table = RivetTable(
        kind=header["kind"],
        geometry=header["geometry"],
        geometry_hash=header["geometry_hash"],
        Z=header["Z"],
        moment_length=stress["moment_length"],
        knots=knots,
        coefficients=_as_embedded(np.array(stress["coefficients"]).reshape(shape)),
        head_friction=stress["head_friction"] * MPA_PER_N,
        head_friction_vm=stress["head_friction_vm"] * MPA_PER_N,
        yield_rivet=stress["yield_rivet"],
        fit_flange_yield=fit["fit_flange_yield"],
        fit_a=np.array(fit["fit_a"]),
        fit_eff=np.array(fit["j2"]),
        fit_slope=np.array(fit["slope"]),
        joint=joint,
        load_path=load_path,
        note=header["note"],
        errors=header["errors"],
    )
    numbers = [table.coefficients, table.fit_a, table.fit_eff, table.fit_slope, load_path, [joint[k] for k in JOINT_KEYS]]
    _need(all(np.all(np.isfinite(n)) for n in numbers), path, "contains a number that is not finite")
    return table


def monotone_slopes(x, y):
    """Slopes of a C1, monotone piecewise cubic through the points (Fritsch and Butland 1984), one-sided at the ends."""
    h, d = np.diff(x), np.diff(y) / np.diff(x)
    w_1, w_2 = 2 * h[1:] + h[:-1], h[1:] + 2 * h[:-1]
    with np.errstate(divide="ignore", invalid="ignore"):
        inner = np.where(d[1:] * d[:-1] > 0, (w_1 + w_2) / (w_1 / d[:-1] + w_2 / d[1:]), 0.0)
    return np.concatenate([d[:1], inner, d[-1:]])


def make(geometry: Geometry, kind, knots, samples_mpa, fit_map, joint, load_path, **scalars):
    """A table from samples of T [1/mm2] at the sites of the axes (splines.sites), in the order AXES, then sheets, channels last.

    fit_map: (fit_a, fit_eff) of the plastic map.  scalars: the remaining members of RivetTable.
    """
    coefficients = _as_embedded(rounded(splines.interpolate([knots[name] for name in AXES], samples_mpa)))
    fit_a, fit_eff = map(np.asarray, fit_map)
    fit_slope = np.where(fit_eff == fit_a, 1.0, monotone_slopes(fit_a, fit_eff))  # elastic until yield
    return RivetTable(
        kind=kind,
        geometry=asdict(geometry),
        geometry_hash=geometry.digest,
        Z=geometry.Z,
        knots=knots,
        coefficients=coefficients,
        fit_a=fit_a,
        fit_eff=fit_eff,
        fit_slope=fit_slope,
        joint=joint,
        load_path=load_path,
        yield_rivet=geometry.yield_rivet,
        **scalars,
    )
