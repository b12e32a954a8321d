"""Make an FMU for a bearing: rivet table, variable files, compilation and archive, and a first start to see that it
works.

    python fmus/generate.py --bearing FILE --out BUILD/generated
    cmake -S SOURCES -B BUILD -DGENERATED_DIR=BUILD/generated -DRIVET_TABLE=TABLE -DCORE=ARCHIVE
    cmake --build BUILD --target fmu

The core is compiled once for all bearings with as many balls (core.py), beside the making of the table.  For other
platforms zig compiles each binary in a build folder of its own (cmake/zig.cmake), and the last step packs all binaries
into one FMU.

Intermediate files stay in BUILD, so that the next build of the same bearing compiles only what changed.  A second build
in the same folder waits for the first.
"""

import math
import os
import shutil
import sys
from pathlib import Path
from typing import Any

from bearing_model.generated import variables
from rivet_model.geometry import Geometry
from rivet_model.half_modes import default_count

from ..base.errors import UserError, unknown
from ..base.files import cache_folder, make_folder, write_atomically
from ..base.toml_files import to_toml
from ..bearing.bearing_file import CAGE_MEANT, bearing_case
from ..bearing.case import Case
from ..bearing.materials import PARTS
from ..bearing.ribbon import is_ribbon
from ..bearing.rules import RIVET
from ..running.fmu import FMU_NAME, PACKAGE, Instance, Model
from ..running.scene import Scene
from ..running.summary import TABLE_TITLE
from .compiler import alone_in, cmake, compile_target, compiler_platforms, generate, has_compiler, zig_version
from .core import Core, beside
from .rivet import TABLES, geometry_of, read_table, rivet_case, table_of, table_text

SOURCES = (PACKAGE.parent, PACKAGE / "_source")  # a checkout, an installed package
PLATFORMS = ("linux64", "win64", "darwin64", "aarch64-darwin")  # "all"
LIBRARIES = ("RivetedBearing.so", "RivetedBearing.dll", "RivetedBearing.dylib")


def build_fmu(
    bearing: Any = None,
    rivet: Any = None,
    out: Any = None,
    say: Any = lambda text, share=None: None,
    platforms: Any = (),
    kind: Any = None,
    modes: Any = None,
    cage: Any = None,
) -> Any:
    """Build an FMU and return its path, as riveted_bearing.build; UserError leaves `out` as it was.

    say: called with what is being done and the share done; kind, modes: of the rivet table, see table_of.
    """
    sources = source_folder()
    out = Path(out) if out else default_out(sources, bearing or rivet, cage)
    case, folder = case_with(bearing, rivet, cage), build_folder(sources, bearing, cage)
    platforms = platforms or compiler_platforms()
    cmake()  # before minutes are spent on the table
    make_folder(out.parent)

    def cores(modes):
        of = [
            (platform, made_folder(sources, "cores", f"z{case.Z:02}_{modes}_{platform or 'host'}"))
            for platform in platforms or [None]
        ]
        return [Core(sources, folder, case.Z, modes, platform) for platform, folder in of]

    expected = 8 * math.ceil((modes or default_count(case.Z)) / 8)
    given = given_table(rivet, case, kind, say, modes, beside(cores(expected), say))
    with alone_in(folder, say):
        table = kept(given, table_copy(bearing, cage))
        # said in any case: a build folder remembers what it was told before
        generated = folder / "generated" if bearing or rivet or kind or modes else ""
        options = [f"-DRIVET_TABLE={table}", f"-DPython_EXECUTABLE={sys.executable}", f"-DGENERATED_DIR={generated}"]
        document = start_document(case, table)
        archives = [core.archive(say) for core in cores(document["modes"])]
        if generated:
            say("variables")
            generate(sources, folder, "bearing.toml", "\n".join(to_toml(document)), say)
        binaries = [
            f"{platform}={cross_compile(sources, folder / platform, [*options, f'-DCORE={core}'], platform, say)}"
            for platform, core in zip(platforms, archives)
        ]
        options += [f"-DBINARIES={';'.join(binaries)}", f"-DCOMPILER={zig_version() if platforms else ''}"]
        options += [f"-DCORE={'' if platforms else archives[0]}"]
        wanted = None
        if not has_compiler():  # the archive's project wants some compiler too
            folder, wanted = folder / "archive", platforms[0]
            folder.mkdir(exist_ok=True)
        compile_target(sources, folder, options, "fmu", say, wanted)
        finished = folder / FMU_NAME
        say("starting it once")
        with Instance(Model(finished)) as instance:
            instance.initialize(Scene(name="start values of the bearing"))
        write_atomically(out, lambda temporary: shutil.copyfile(finished, temporary))
        # the example uses the FMU of the checkout
        if out.resolve() == sources / "fmus" / FMU_NAME and not bearing and (sources / "examples").is_dir():
            compile_target(sources, folder, options, "transmission", say, wanted)
            for name in ("Shaft.fmu", "Transmission.ssp"):
                write_atomically(
                    out.with_name(name), lambda temporary, made=folder / name: shutil.copyfile(made, temporary)
                )
    return out


def platform_names(text: str | None) -> Any:
    """Platforms by "all" or names separated by commas; UserError for an unknown one."""
    names = PLATFORMS if text == "all" else tuple(filter(None, (text or "").split(",")))
    for name in names:
        if name not in (*PLATFORMS, "aarch64-linux"):
            raise unknown("--platforms", "platform", name, (*PLATFORMS, "aarch64-linux"))
    return names


def cross_compile(sources, folder, options, platform, say):
    """The binary for another platform, compiled with zig in its own build folder."""
    folder.mkdir(exist_ok=True)

    def told(text, share=None):
        say(f"{platform}: {text}", share)

    compile_target(sources, folder, options, "binaries", told, platform)
    return next(path for name in LIBRARIES if (path := folder / name).is_file())


def start_document(case, path):
    """A case with its table as fmus/generate.py reads it: start values in SI, and what importers show."""
    table, sections = read_table(path, case.Z), {"parameters": variables.PARAMETERS, "inputs": variables.INPUTS}
    values = case.values | cage_of(case, table)
    start = {section: {name: values[name] for name in known} for section, known in sections.items()}
    modes = table.modes.room if table.modes else default_count(case.Z)
    rivet = {f"rivet.{name}": value for name, value in case.rivet.items() if f"rivet.{name}" in case.origin}
    about = {
        "description": fmu_description(case, table),
        "origin": case.origin,
        "numbers": case.catalogue | rivet,
        "ranges": case.ranges,
    }
    return {"Z": case.Z, "modes": modes} | about | start


def cage_of(case, table):
    """scene.cage: rigid halves where the table has no modes; UserError where the file asks for elastic ones."""
    if table.modes is not None or case.values["scene.cage"] != "elastic":
        return {}
    if "scene.cage" in case.origin:
        raise UserError(
            f"{case.designation}: scene.cage = elastic: {table_text(table)} has no vibration modes of the cage halves; allowed are two_half, rigid"
        )
    return {"scene.cage": "two_half"}


def fmu_description(case, table):
    """Which bearing an FMU is, and what its stress table rests on."""
    parts = [f"{case.designation}: {case.description}" if case.description else case.designation]
    shank = (RIVET | case.rivet)["shank_diameter"]
    parts += [
        f"{case.Z} balls of {1e3 * case.values['bearing.D']:.4g} mm, rivets of {1e3 * shank:.4g} mm ({case.materials['rivet'].name})"
    ]
    kind = "Pressed ribbon cage" if is_ribbon(case.values) else "Cage"
    parts += [f"{kind}: {case.materials['cage'].words()}"]
    parts += [CAGE_MEANT] if case.bare else []
    parts += [f"{TABLE_TITLE}{table_text(table)}"]
    return ". ".join(parts)


def source_folder():
    """Folder with CMakeLists.txt, fmu_src and fmus."""
    for folder in SOURCES:
        if (folder / "CMakeLists.txt").is_file():
            return folder
    raise UserError(
        f"the C sources are not there (looked in {', '.join(map(str, SOURCES))}): install the package again, or build in a checkout"
    )


def default_out(sources, source, cage=None):
    """Default path: my.fmu here for the bearing or rivet my.toml; that of the 6207 in fmus/ of a checkout."""
    if source:
        return Path.cwd() / f"{Path(source).stem}{of_cage(cage)}.fmu"
    return (sources / "fmus" if sources == PACKAGE.parent else Path.cwd()) / FMU_NAME


def of_cage(cage):
    """What names of a bearing's files have behind them for a ribbon cage."""
    return "-ribbon" if cage == "ribbon" else ""


def build_folder(sources, bearing, cage=None):
    """Folder for a bearing's intermediate files: in build/ of a writable checkout, else in the user's cache."""
    name = (Path(str(bearing)).stem if bearing else "default") + of_cage(cage)
    return made_folder(sources, "bearings", name)


def made_folder(sources, kind, name):
    """A build folder of a kind, in a checkout that can be written to or in the user's cache."""
    own = sources == PACKAGE.parent and os.access(sources, os.W_OK)
    folder = (sources / "build" / kind if own else cache_folder(kind)) / name
    make_folder(folder)
    return folder


def case_with(bearing: Any, rivet: Any, cage: Any = None) -> Case:
    """The Case of a bearing, with the rivet of a geometry file if there is one: preload and seat follow from its shank."""
    if rivet is None or Path(rivet).suffix != ".toml":
        return bearing_case(bearing or "6207", cage=cage)
    if cage is not None:
        raise UserError(f"--cage {cage}: not beside a rivet's file; give cage.shape in the bearing file's [parameters]")
    return rivet_case(Path(rivet), bearing or "6207")


def given_table(rivet, case, kind, say, modes=None, meanwhile=None):
    """Absolute path of the rivet table, the user's or one for the case's geometry; UserError if it does not fit."""
    if kind is not None and kind not in TABLES:
        raise unknown("--table", "kind", kind, TABLES)
    if rivet is None or Path(rivet).suffix == ".toml":
        return table_of(rivet or case.designation, geometry_of(case), kind, say, modes, meanwhile)
    path = Path(rivet)
    for option, value in (("--table", kind), ("--modes", modes)):
        if value is not None:
            raise UserError(f"{option} {value}: {path} is a table already")
    check_material(path, read_table(path, case.Z), case)
    return path.resolve()


def check_material(path, table, case):
    """UserError if a table was made for a cage of another material than the case's."""
    made_for = Geometry(**table.geometry)
    for key, name in PARTS["cage"].geometry.items():
        value, own = getattr(made_for, name), case.materials["cage"].values[key]
        if not math.isclose(value, own, rel_tol=1e-6):
            raise UserError(
                f"{path}: made for a cage with {key} = {value:g}, but that of {case.designation} has {own:g} ({case.materials['cage'].name})"
            )


def table_copy(bearing: Any = None, cage: Any = None) -> Any:
    """Where the rivet table lies that build_fmu put into the FMU of a bearing."""
    return build_folder(source_folder(), bearing, cage) / "rivet_table.json"


def kept(source, copy):
    """A copy that is only written when the file has changed, so that nothing is compiled again without need; its path."""
    if not copy.is_file() or copy.read_bytes() != source.read_bytes():
        write_atomically(copy, lambda temporary: shutil.copyfile(source, temporary))
    return copy
