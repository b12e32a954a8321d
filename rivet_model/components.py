"""Stress components around both fillets and the middle for any load: modes of the finite elements' fields, for
critical-plane work.

python -m rivet_model.components OUT.npz [GEOMETRY.toml] [--coarse] [--workers 2]

    field = s sum_i C_i(a, c, xi, direction of m) mode_i        coordinates as in fmu_src/rivet/rivet_rom.h

The fields of sampled loads are reduced to their first singular vectors; the amplitudes C_i are splines, as the channels
of the table are. Over the direction phi of the moment m against V, C = A + B cos phi + D sin phi through the three
sheets: exact as long as no contact opens or closes. A mirror and a half turn of the joint give the other three
quadrants of phi.  Angles run from the direction of V.
"""

import argparse
import json
import sys
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from bearing_model.rivet import rivet_rom, rivet_table

from . import reduction, splines
from .geometry import Geometry
from .load_cases import COARSE, SHIPPED, Joint

ANGLES = 16
MODES = 24
COARSE_KNOTS = reduction.COARSE
KNOTS = {
    "a": np.array([0.0, 0.2, 0.5, 0.8, 1.0]),
    "c": np.array([0.0, 0.35, 0.7, 1.0]),
    "xi": 1e-9 * np.array([-1500, -400, -110, -20, 0.5, 5, 18, 60, 400]),
}
PHI = np.array([reduction.DIRECTION[sheet] for sheet in rivet_table.SHEETS])
PLACES = ("upper fillet", "lower fillet", "middle")


def joint_fields(joint, forces):
    """Fields of contact forces [contacts, cases] as rows [cases, numbers]: (tt, hoop, shear) x points x ANGLES of the
    places, one after the other.
    """
    return np.concatenate([field.reshape(-1, field.shape[-1]) for field in joint.fields(forces, ANGLES)]).T


def representative(a, c, sheet):
    """One set of coordinates for all those with the same field; unlike a channel, a field turns with m where there is
    no V.
    """
    c = 0.0 if a == 1.0 else c
    return a, c, "plane" if c == 0.0 else sheet


@dataclass
class Components:
    """Modes and amplitudes of one geometry.

    coefficients [a, c, xi, sheet, mode] in 1/m2; length: of c = 1 [m]; modes [mode, numbers]; points: of each of the
    PLACES.
    """

    geometry_hash: str
    length: float
    knots: dict
    coefficients: np.ndarray
    modes: np.ndarray
    points: tuple
    errors: dict

    def fields(self, load, fit_eff):
        """(tt, hoop, shear) [3, points, ANGLES, times] in Pa of each place, angles from the direction y of the loads.

        load: rivet_rom.RivetLoad of arrays [times] in N, N.m; fit_eff: m, scalar or [times].  Head friction is not part
        of the fields.
        """
        arrays = np.broadcast_arrays(
            *(np.atleast_1d(np.asarray(v, dtype=float)) for v in (*vars(load).values(), fit_eff))
        )
        load, fit = rivet_rom.RivetLoad(*arrays[:-1]), arrays[-1]
        azimuth = np.arctan2(load.V_z, load.V_y)
        c, s = np.cos(azimuth), np.sin(azimuth)
        # m about V's own direction, and about the one 90 degrees ahead
        across, plane = c * load.m_y + s * load.m_z, c * load.m_z - s * load.m_y
        _, at = rivet_rom.load_splines(self, load, fit)
        amplitude = self._amplitudes(at, np.arctan2(np.abs(across), np.abs(plane)))
        fields = self._split(amplitude @ self.modes)
        # The joint's z leads against the bearing's x: see load_cases.  Signs of the moments by the half turn and by the
        # mirror.
        fields = _chosen(plane < 0.0, half_turn(fields), fields)
        fields = _chosen(across < 0.0, mirrored(fields), fields)
        return tuple(_turned(field, azimuth) for field in fields)

    def _amplitudes(self, at, phi):
        """Amplitudes of the modes [times, mode] at the splines' places and directions phi of m in the first quadrant."""
        basis = np.stack([np.ones(3), np.cos(PHI), np.sin(PHI)], axis=-1)
        weight = np.linalg.solve(basis.T, np.stack([np.ones_like(phi), np.cos(phi), np.sin(phi)])).T  # [times, sheet]
        (A, wa), (C, wc), (X, wx) = (at[name] for name in rivet_table.SHANK_AXES)
        total = np.zeros((len(phi), self.coefficients.shape[-1]))
        for i, j, k in np.ndindex(3, 3, 3):
            w = (wa[:, i] * wc[:, j] * wx[:, k])[:, None] * weight
            total += np.einsum("ts,tsm->tm", w, self.coefficients[A + i, C + j, X + k])
        return total

    def _split(self, rows):
        ends = np.cumsum([3 * n * ANGLES for n in self.points])[:-1]
        return [
            part.T.reshape(3, n, ANGLES, -1) for part, n in zip(np.split(rows, ends, axis=1), self.points, strict=True)
        ]


def mirrored(fields):
    """Fields of the load mirrored at the plane of V: m across it changes sign."""
    return [_reflected(field, 0) * _SHEAR for field in fields]


def half_turn(fields):
    """Fields of the load after half a turn about the axis across V: m in the plane of V changes sign, the heads change
    places.
    """
    upper, lower, middle = (_reflected(field, ANGLES // 2) for field in fields)
    return [lower * _SHEAR, upper * _SHEAR, middle[:, ::-1]]


_SHEAR = np.array([1.0, 1.0, -1.0])[:, None, None, None]


def _reflected(field, about):
    """Values at the angles `about` - angle (in steps)."""
    return field[:, :, (about - np.arange(ANGLES)) % ANGLES]


def _chosen(where, first, second):
    return [np.where(where, a, b) for a, b in zip(first, second, strict=True)]


def _turned(field, azimuth):
    """Field [3, points, ANGLES, times] turned by the azimuths: by Fourier series, so that no direction is rounded to a
    point.
    """
    spectrum = np.fft.rfft(field, axis=2)
    n = np.arange(spectrum.shape[2])[:, None]
    return np.fft.irfft(spectrum * np.exp(-1j * n * azimuth), n=field.shape[2], axis=2)


# Making ---------------------------------------------------------------------------------------------------------------


def make(geometry, coarse=False, workers=2, progress=None, hold_out=60):
    """Components of a geometry, their error at fresh loads in `errors`.  Raises as rivet_model.build.make_table does."""
    grid, knots = (COARSE, COARSE_KNOTS) if coarse else (SHIPPED, KNOTS)
    joint, knots = Joint(geometry, grid), reduction.knots_for(geometry, knots)
    samples = reduction.sample(joint, knots, workers, progress, joint_fields, representative)
    rows = samples.reshape(-1, samples.shape[-1])
    scale, vectors = np.linalg.eigh(rows.T @ rows) if rows.shape[1] < len(rows) else _row_space(rows)
    modes = vectors[:, np.argsort(scale)[::-1][:MODES]].T
    coefficients = splines.interpolate([knots[name] for name in rivet_table.SHANK_AXES], samples @ modes.T)
    points = tuple(place[2].shape[1] for place in (joint.fillet, joint.fillet, joint.middle))
    made = Components(geometry.digest, reduction.bending_length(geometry), knots, coefficients, modes, points, {})
    made.errors = (
        hold_out_errors(made, joint, reduction.random_loads(hold_out, 2027, size=geometry.size)) if hold_out else {}
    )
    return made


def _row_space(rows):
    scale, left = np.linalg.eigh(rows @ rows.T)
    return scale, rows.T @ left / np.sqrt(np.maximum(scale, 1e-300))


def hold_out_errors(components, joint, loads):
    """Largest and RMS error of the components of each place, relative to the place's largest component in all loads."""
    got = components.fields(reduction.rivet_load(loads), np.array([load.fit for load in loads]))
    report = {}
    for i, place in enumerate(PLACES):
        fresh = np.stack(
            [joint.fields(reduction.load_forces(joint, load)[:, None], ANGLES)[i][..., 0] for load in loads], axis=-1
        )
        error = (got[i] - fresh) / np.abs(fresh).max()
        report[place] = {"maximum": float(np.abs(error).max()), "rms": float(np.sqrt((error**2).mean()))}
    return report


def write(components, path):
    """Write the file, compressed; single precision."""
    data = asdict(components)
    arrays = {name: data.pop(name).astype(np.float32) for name in ("coefficients", "modes")}
    knots = {f"knots_{name}": values for name, values in data.pop("knots").items()}
    with Path(path).open("wb") as file:
        np.savez_compressed(file, header=json.dumps({"format": "rivet-components-2"} | data), **arrays, **knots)


def read(path, geometry_hash=None):
    """Components of a file; ValueError if it is none or, with geometry_hash, made for another geometry."""
    try:
        with np.load(path, allow_pickle=False) as file:
            header = json.loads(str(file["header"]))
            knots = {name: file[f"knots_{name}"] for name in rivet_table.SHANK_AXES}
            arrays = {name: file[name].astype(float) for name in ("coefficients", "modes")}
    except (ValueError, KeyError, EOFError) as error:
        raise ValueError(f"{path}: not a file of rivet components: {error}") from error
    if geometry_hash not in (None, header["geometry_hash"]):
        raise ValueError(f"{path}: made for geometry {header['geometry_hash']}; {geometry_hash} is needed")
    return Components(
        header["geometry_hash"],
        header["length"],
        knots,
        points=tuple(header["points"]),
        errors=header["errors"],
        **arrays,
    )


def main(arguments=None):
    """Command line; returns 0, or 2 with a message and no file."""
    parser = argparse.ArgumentParser(prog="python -m rivet_model.components", description=__doc__.partition("\n")[0])
    parser.add_argument("out")
    parser.add_argument("geometry", nargs="?")
    parser.add_argument("--coarse", action="store_true")
    parser.add_argument("--workers", type=int, default=2)
    options = parser.parse_args(arguments)
    if not Path(options.out).resolve().parent.is_dir():
        parser.error(f"{options.out}: no such folder")
    try:
        made = make(
            Geometry.from_toml(options.geometry) if options.geometry else Geometry(), options.coarse, options.workers
        )
        write(made, options.out)
    except (OSError, ValueError, ArithmeticError, np.linalg.LinAlgError) as error:
        print(f"rivet components: {error}", file=sys.stderr)
        return 2
    for place, error in made.errors.items():
        print(f"{place}: max {100 * error['maximum']:.1f} % rms {100 * error['rms']:.2f} % of its largest component")
    return 0


if __name__ == "__main__":
    sys.exit(main())
