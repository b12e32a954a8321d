"""Stress of the rivets of a table or of a geometry: curves over preload, fit and load, and pictures of the elements."""

import contextlib
import math
from collections.abc import Iterator
from concurrent.futures import BrokenExecutor
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from bearing_model.cage.common import joint_law
from bearing_model.cage.elastic import half_modes
from bearing_model.cage.two_half import half_path
from bearing_model.rivet import rivet_rom, rivet_splines, rivet_table
from rivet_model import closed_form, table
from rivet_model.build import make_table, other_modes
from rivet_model.geometry import Geometry
from rivet_model.half_modes import check_count
from rivet_model.load_cases import Joint
from riveted_bearing.building import rivet_pictures

from ..base.errors import UserError, naming, refusal, refusing
from ..base.files import cache_folder, cache_path, write_atomically
from ..base.schema import Number
from ..base.toml_files import read_toml
from ..bearing.bearing_file import bearing_case
from ..bearing.bearing_keys import BALLS, RIVET_SIZES
from ..bearing.file_values import is_number, unit_scales
from ..bearing.rules import CAGE_SIZES, check_limits, in_cage
from ..bearing.scaling import SHAPE

TABLES = ("coarse", "full", "closed-form")  # kinds that a user can ask for
# key of a geometry file -> of a bearing file
CAGE_NAMES = {key: name for key, name in SHAPE.items() if key not in ("cage_half_width", "rho_flange")}


@threadpool_limits.wrap(limits=1)  # small matrices
def rivet_curves(source: Any = None, bearing: Any = None) -> Any:
    """Title, curves (rivet_pictures.curves) and Joint of a rivet; UserError naming file and fault.

    source: table (JSON) or geometry (TOML, solved in some 20 s), None for the tracked table or the bearing's own rivet.
    """
    path = Path(source or bearing or rivet_table.DEFAULT_TABLE)
    if bearing is not None or path.suffix == ".toml":
        geometry = source_geometry(source, bearing)
        joint = condensed(geometry, path)
        whose = f"{bearing_case(bearing).designation}" if bearing else "6207 where the file gives no other sizes"
        cage = f"in the cage of the {whose}"
        response, title = rivet_pictures.joint_response(joint), f"{path.name}: finite elements, {cage}"
    else:
        t = read_table(path)
        geometry = Geometry(**t.geometry)
        joint = condensed(geometry, path)
        response, title = rivet_pictures.table_response(t), f"{path.name}: {table_text(t)}"
    stress, fit_eff = response
    return title, rivet_pictures.curves(stress, fit_eff, geometry.size, is_papers(geometry)), joint


def source_geometry(source: Any, bearing: Any) -> Any:
    """Geometry of a rivet given as for rivet_curves."""
    if source is None:
        return geometry_of(bearing_case(bearing))
    if bearing is not None and Path(source).suffix != ".toml":
        raise UserError(f"--bearing {bearing}: {source} is a table, which is made for a cage already")
    return given_geometry(source, bearing)


def is_papers(geometry):
    """Whether a rivet has the sizes and the steel of the paper's."""
    own = Geometry()
    names = [name for name in RIVET_SIZES if name not in ("seat_diameter", "T_0")]
    return all(getattr(geometry, name) == getattr(own, name) for name in (*names, "E_rivet", "nu_rivet"))


def read_geometry(path, bearing=None):
    """Geometry of a rivet file (TOML) in a bearing's cage, without one the 6207's, of which the file may give other sizes;
    UserError if it cannot be made.
    """
    path = Path(path)
    case, document = rivet_case(path, bearing or "6207", fixed=bearing is not None), read_toml(path)
    own = dict(cage_sizes(path, document))
    numbers = {name: value for name, value in case.values.items() if is_number(value)}
    given = numbers | {CAGE_NAMES[name]: value for name, value in own.items() if name in CAGE_NAMES}
    written = {
        "rivet": own_keys(document),
        "parameters": {CAGE_NAMES[name]: document[name] for name in own if name in CAGE_NAMES},
    }
    parts = own.get("Z", case.Z), given, case.rivet, {}, {}, None
    keys = {name: key for key, name in CAGE_NAMES.items()}
    called = lambda name: keys.get(name, name.removeprefix("rivet."))
    check_limits(path, written, parts, called, in_cage(case.designation))
    with naming(path):
        return Geometry(**(case.joint | own))


def rivet_case(path, bearing, fixed=True):
    """The Case of a bearing with the rivet of a file like a section [rivet]; fixed: it may not change the bearing's sizes."""
    document, case = read_toml(path), bearing_case(bearing)
    for name, value in cage_sizes(path, document):
        if fixed and not math.isclose(value, case.joint[name], rel_tol=1e-9):
            raise refusal(path, name, document[name], f"the bearing has {case.joint[name]!r}")
    return bearing_case(bearing, (path, own_keys(document)))


def own_keys(document):
    """What of a rivet file is the rivet's own."""
    return {name: value for name, value in document.items() if name not in CAGE_SIZES}


def cage_sizes(path, section):
    """Sizes of the cage from a geometry file: SI values and the number of rivets."""
    for name, value in section.items():
        if name not in CAGE_SIZES:
            continue
        with refusing(path, name, value):
            yield name, BALLS.read(value) if name == "Z" else Number(unit_scales("m"), above=0.0).read(value)


def geometry_of(case):
    """Geometry of a Case; UserError if it cannot be made."""
    with naming(case.designation):
        return Geometry(**case.joint)


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
    with naming(path):
        return Joint(geometry)


def table_of(where, geometry, kind=None, say=lambda text, share=None: None, modes=None, meanwhile=None):
    """Path of a geometry's rivet table: the shipped one, or one of the user's cache, made if need be; UserError leaves none.

    where: for messages; kind: of TABLES, None: shipped or coarse; say: called with stage and share; modes: of a half, None:
    usual; meanwhile: a context for the time in which finite elements are solved.
    """
    if modes is not None and kind == "closed-form":
        raise UserError(f"--modes {modes}: a table of closed forms has none; allowed: coarse or full")
    shipped = kind in (None, "full") and geometry.digest == Geometry().digest
    if shipped and modes is None:
        return rivet_table.DEFAULT_TABLE
    kind = kind or ("full" if shipped else "coarse")
    name = f"{kind}-{geometry.digest}-{sources_digest()}" + (f"-{modes}" if modes else "")
    target = cache_path("tables") / f"{name}.json"
    # a table that is whole, perhaps of another user, whose cache takes no files
    with contextlib.suppress(OSError, ValueError):
        rivet_table.read(target)
        return target
    cache_folder("tables")

    def progress(stage, done, total):
        say(f"rivet: {stage}", done / total)

    with naming(where, (ValueError, ArithmeticError, BrokenExecutor)):
        if modes is not None:
            check_count(modes, geometry.Z)
        if kind == "closed-form":
            made = closed_form.make_table(geometry)
        else:
            with meanwhile or contextlib.nullcontext():
                if shipped:
                    made = other_modes(rivet_table.read(rivet_table.DEFAULT_TABLE), modes, progress)
                else:
                    made = make_table(geometry, kind == "coarse", progress=progress, modes=modes)
    write_atomically(target, lambda temporary: table.write(made, temporary))
    return target


def table_text(t):
    """What a rivet table rests on and how far it is off, in words."""
    text = rivet_table.KINDS[t.kind]
    if t.kind == "closed_form":
        return f"{text}, tens of per cent off in the head and not on the safe side"
    errors = t.errors.get("all")
    if not errors:
        return f"{text}, error not measured"
    largest, rms = (100.0 * max(errors[key].values()) for key in ("maximum", "rms"))
    return f"{text}, error at {errors['loads']} loads that did not make it: RMS {rms:.2g} %, largest {largest:.2g} % of the largest stress"


def sources_digest():
    """Digest of the source files that make a table, so that a table made by other sources is not taken for theirs."""
    readers = (
        Path(module.__file__) for module in (half_modes, half_path, joint_law, rivet_rom, rivet_splines, rivet_table)
    )
    files = [*sorted(Path(table.__file__).parent.glob("*.py")), *readers]
    return sha256(b"".join(file.read_bytes() for file in files)).hexdigest()[:8]


def curve_tables(curves: Any) -> Iterator[Any]:
    """Title, heads and rows of each curve, a row every Curve.row."""
    for curve in curves.values():
        shown = np.isclose(curve.x / curve.row, np.round(curve.x / curve.row), atol=1e-6)
        columns = curve.scale * curve.x[shown], curve.head[shown] / 1e6, curve.mid[shown] / 1e6
        rows = [(f"{x:.0f}", f"{head:.1f}", f"{mid:.1f}") for x, head, mid in zip(*columns, strict=True)]
        yield curve.title, (f"{curve.label} [{curve.unit}]", "head [MPa]", "middle [MPa]"), rows


@threadpool_limits.wrap(limits=1)
def write_pictures(folder: Path, title: str, curves: Any, joint: Any) -> Any:
    """Write drawing, curves, section and cage modes as PNG into a folder; returns their paths."""
    figures = {
        "rivet_curves.png": rivet_pictures.plot_curves(curves, title),
        "rivet_section.png": rivet_pictures.plot_section(joint),
        "cage_modes.png": rivet_pictures.plot_modes(joint.geometry),
    }
    for name, figure in figures.items():
        write_figure(figure, folder / name)
    return [write_drawing(joint.geometry, folder / "rivet_drawing.png"), *(folder / name for name in figures)]


def write_figure(figure, path):
    """Write a figure as PNG, whole or not at all."""
    write_atomically(path, lambda temporary: figure.savefig(temporary, dpi=120, format="png"))


def write_drawing(geometry: Any, path: Path) -> Path:
    """Write the drawing of a rivet with its dimensions; returns the path."""
    write_figure(rivet_pictures.plot_geometry(geometry), path)
    return path


def given_geometry(rivet: Any, bearing: Any = None) -> Any:
    """Geometry of a rivet given as table (JSON) or geometry (TOML), in the cage of a bearing."""
    path = Path(rivet)
    return read_geometry(path, bearing) if path.suffix == ".toml" else Geometry(**read_table(path).geometry)


def seat_note(geometry: Any) -> str:
    """A warning where the seat is smaller than the shank's section, so that the head presses harder; else ""."""
    if geometry.seat_share >= 1.0:
        return ""
    ring = f"{1e3 * geometry.seat_width:.2g} mm wide, {100.0 * geometry.seat_share:.0f} % of the shank's section"
    sizes = f"head_diameter = {1e3 * geometry.head_diameter:g} mm is small for shank_diameter = {1e3 * geometry.shank_diameter:g} mm"
    return f"the seat under the head is a ring {ring}: the head presses on it with {1.0 / geometry.seat_share:.1f} times the shank's tension stress; {sizes}"
