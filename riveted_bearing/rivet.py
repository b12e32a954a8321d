"""Stress of the rivets of a table or of a geometry: curves over preload, fit and transverse load, and pictures of the finite elements."""

from concurrent.futures import BrokenExecutor
from hashlib import sha256
from pathlib import Path

import numpy as np
from rich.table import Column, Table
from threadpoolctl import threadpool_limits

from bearing_model import load_path, rivet_rom, rivet_splines, rivet_table
from rivet_model import pictures, table
from rivet_model.build import make_table
from rivet_model.geometry import Geometry
from rivet_model.load_cases import Joint

from .errors import UserError
from .results import write_atomically

ROWS = {"preload": 10.0, "fit": 10e-6, "transverse load": 10.0}  # distance of the printed rows, SI


@threadpool_limits.wrap(limits=1)  # small matrices
def rivet_curves(source=None):
    """Title, curves (see rivet_model.pictures.curves) and Joint of a rivet.

    source: rivet table (JSON) or geometry (TOML), None for the tracked table; for a geometry the finite elements are solved, in some 20 s.
    Raises UserError naming file and fault.
    """
    path = Path(source or rivet_table.DEFAULT_TABLE)
    if path.suffix == ".toml":
        joint = condensed(read_geometry(path), path)
        return f"{path.name}: finite elements", pictures.curves(*pictures.joint_response(joint)), joint
    t = read_table(path)
    errors = t.errors.get("clearance", {}).get("maximum", {})
    within = f", within {100 * max(errors.values()):.1f} % of the largest stress in clearance" if errors else ""
    return f"{path.name}: {t.kind}{within}", pictures.curves(*pictures.table_response(t)), condensed(Geometry(**t.geometry), path)


def read_geometry(path, cage=None):
    """Geometry of a TOML file; UserError if it cannot be read, has an impossible size, or contradicts the bearing's cage."""
    try:
        return Geometry.from_toml(path, cage or {})
    except OSError as problem:
        raise UserError(f"{path}: {problem.strerror}") from None
    except ValueError as problem:
        raise UserError(str(problem)) from None


def read_table(path, Z=None):
    """Rivet table; UserError if it is missing, damaged or made for another number of rivets."""
    try:
        return rivet_table.read(path, Z)
    except OSError as problem:
        raise UserError(f"{path}: {problem.strerror}") from None
    except ValueError as problem:
        raise UserError(str(problem)) from None


def condensed(geometry, path):
    """The Joint of a geometry; UserError if it cannot be meshed."""
    try:
        return Joint(geometry)
    except (ValueError, ArithmeticError) as problem:
        raise UserError(f"{path}: {problem}") from None


def table_of(path, geometry, folder, coarse=False, say=lambda text, share: None):
    """Path of the rivet table of a geometry by finite elements: made in `folder`, or found there from an earlier build.

    path: the geometry's file, for messages; coarse: few loads and elements, seconds instead of some half an hour; say: called with stage and share done.
    Raises UserError if the geometry cannot be meshed or solved; then there is no new file.
    """
    kind = "coarse" if coarse else "full"
    target = folder / f"rivet-{kind}-{geometry.digest}-{sources_digest()}.json"
    if target.is_file():
        return target
    try:
        made = make_table(geometry, coarse, progress=lambda stage, done, total: say(f"rivet: {stage}", done / total))
    except (ValueError, ArithmeticError, np.linalg.LinAlgError, BrokenExecutor) as problem:
        raise UserError(f"{path}: {problem}") from None
    write_atomically(target, lambda temporary: table.write(made, temporary))
    return target


def sources_digest():
    """Digest of the source files that make a table, so that a table made by other sources is not taken for theirs."""
    readers = (Path(module.__file__) for module in (load_path, rivet_rom, rivet_splines, rivet_table))
    files = [*sorted(Path(table.__file__).parent.glob("*.py")), *readers]
    return sha256(b"".join(file.read_bytes() for file in files)).hexdigest()[:8]


def curve_tables(curves):
    """Title and rich table of each curve, a row every ROWS."""
    for name, curve in curves.items():
        step = ROWS[curve.label]
        shown = np.isclose(curve.x / step, np.round(curve.x / step), atol=1e-6)
        rows = Table(*(Column(text, justify="right") for text in (f"{curve.label} [{curve.unit}]", "head [MPa]", "middle [MPa]")), box=None, pad_edge=False)
        for x, head, mid in zip(curve.scale * curve.x[shown], curve.head[shown] / 1e6, curve.mid[shown] / 1e6, strict=True):
            rows.add_row(f"{x:.0f}", f"{head:.1f}", f"{mid:.1f}")
        yield name, rows


@threadpool_limits.wrap(limits=1)
def write_pictures(folder, title, curves, joint):
    """Write rivet_curves.png and rivet_section.png into a folder; returns their paths."""
    figures = {"rivet_curves.png": pictures.plot_curves(curves, title), "rivet_section.png": pictures.plot_section(joint)}
    for name, figure in figures.items():
        write_atomically(folder / name, lambda temporary, figure=figure: figure.savefig(temporary, dpi=120, format="png"))
    return [folder / name for name in figures]
