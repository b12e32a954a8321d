"""Make an FMU for a bearing: variable files, rivet table, compilation and archive, and a first start to see that it
works.

    python fmus/generate.py --bearing FILE --out BUILD/generated
    cmake -S SOURCES -B BUILD -DGENERATED_DIR=BUILD/generated -DRIVET_TABLE=TABLE
    cmake --build BUILD --target fmu

For other platforms zig compiles each binary in a build folder of its own (cmake/zig.cmake), and the last step packs all
binaries into one FMU.

Intermediate files stay in BUILD, so that the next build of the same bearing compiles only what changed.  A second build
in the same folder waits for the first.
"""

from __future__ import annotations

import contextlib
import importlib.util
import math
import os
import platform as machine
import re
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path
from typing import TYPE_CHECKING, Any

from filelock import FileLock, Timeout

from bearing_model.generated import variables
from rivet_model.geometry import Geometry

from ..base.errors import UserError, extra, unknown
from ..base.files import cache_folder, make_folder, write_atomically
from ..base.toml_files import to_toml
from ..bearing.bearing_file import CAGE_MEANT, bearing_case
from ..bearing.materials import PARTS
from ..bearing.ribbon import is_ribbon
from ..bearing.rules import RIVET
from ..running.fmu import FMU_NAME, PACKAGE, Instance, Model
from ..running.scene import Scene
from ..running.summary import TABLE_TITLE
from .rivet import TABLES, geometry_of, read_table, rivet_case, table_of, table_text

if TYPE_CHECKING:
    from ..bearing.case import Case

SOURCES = (PACKAGE.parent, PACKAGE / "_source")  # a checkout, an installed package
PLATFORMS = ("linux64", "win64", "darwin64", "aarch64-darwin")  # "all"
PLATFORM_OF = {  # (system, machine) -> FMI's folder of binaries
    ("Linux", "x86_64"): "linux64",
    ("Linux", "aarch64"): "aarch64-linux",
    ("Windows", "AMD64"): "win64",
    ("Darwin", "x86_64"): "darwin64",
    ("Darwin", "arm64"): "aarch64-darwin",
}
LIBRARIES = ("RivetedBearing.so", "RivetedBearing.dll", "RivetedBearing.dylib")
STEP = re.compile(r"\[\s*(?:(\d+)/(\d+)|(\d+)%)\s*\]")  # Ninja's [3/40], make's [ 7%]


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
    """Build an FMU and return its path.

    bearing: bearing file or designation, None for the default one; rivet: rivet table (JSON) or geometry of the rivet
    (TOML), None for the bearing's own rivet; out: the FMU to write, None for my.fmu here from my.toml,
    RivetedBearing.fmu from the default (in a checkout: in fmus/); say: called with what is being done and the share
    done; platforms: names of FMI's binary folders to cross-compile for (cmake/zig.cmake), none for this machine's
    compiler alone; kind, modes: of the rivet table, see table_of; cage: machined or ribbon, None: the file's, else
    machined. Raises UserError with the reason; `out` is then left
    as it was.
    """
    sources = source_folder()
    out = Path(out) if out else default_out(sources, bearing or rivet, cage)
    case, folder = case_with(bearing, rivet, cage), build_folder(sources, bearing, cage)
    cmake, platforms = tool("cmake") or no_tool("cmake"), platforms or compiler_platforms()
    make_folder(out.parent)
    given = given_table(rivet, case, kind, say, modes)
    with alone_in(folder, say):
        table = kept(given, table_copy(bearing, cage))
        # said in any case: a build folder remembers what it was told before
        generated = folder / "generated" if bearing or rivet or kind or modes else ""
        options = [f"-DRIVET_TABLE={table}", f"-DPython_EXECUTABLE={sys.executable}", f"-DGENERATED_DIR={generated}"]
        if generated:
            say("variables")
            resolved = folder / "bearing.toml"
            resolved.write_text("\n".join(to_toml(start_document(case, table))), encoding="utf-8")
            execute(
                [sys.executable, sources / "fmus" / "generate.py", "--bearing", resolved, "--out", generated],
                folder,
                say,
            )
        binaries = [
            f"{platform}={cross_compile(cmake, sources, folder / platform, options, platform, say)}"
            for platform in platforms
        ]
        options += [f"-DBINARIES={';'.join(binaries)}", f"-DCOMPILER={zig_version() if platforms else ''}"]
        if not has_compiler():  # the archive's project wants some compiler too
            folder = folder / "archive"
            folder.mkdir(exist_ok=True)
            options += toolchain(sources, platforms[0])
        compile_target(cmake, sources, folder, options, "fmu", say)
        finished = folder / FMU_NAME
        say("starting it once")
        try_start(finished)
        write_atomically(out, lambda temporary: shutil.copyfile(finished, temporary))
        # the example uses the FMU of the checkout
        if out.resolve() == sources / "fmus" / FMU_NAME and not bearing and (sources / "examples").is_dir():
            compile_target(cmake, sources, folder, options, "transmission", say)
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


def cross_compile(cmake, sources, folder, options, platform, say):
    """The binary for another platform, compiled with zig in its own build folder."""
    folder.mkdir(exist_ok=True)
    compile_target(
        cmake,
        sources,
        folder,
        [*options, *toolchain(sources, platform)],
        "binaries",
        lambda text, share=None: say(f"{platform}: {text}", share),
    )
    return next(path for name in LIBRARIES if (path := folder / name).is_file())


def toolchain(sources, platform):
    """Options of CMake to compile for a platform with zig."""
    return [
        f"-DCMAKE_TOOLCHAIN_FILE={sources / 'cmake' / 'zig.cmake'}",
        f"-DPLATFORM={platform}",
        f"-DZIG={find_zig()}",
    ]


def compile_target(cmake, sources, folder, options, target, say):
    """Configure and build one target."""
    say("configuring (the first time fetches SUNDIALS)")
    execute([cmake, "-S", sources, "-B", folder, *generator(folder), *options], folder, say)
    say("compiling")
    execute([cmake, "--build", folder, "--target", target, "--parallel", str(min(os.cpu_count() or 1, 8))], folder, say)


def zig_version():
    """Name and version of zig, for the FMU's bill of materials."""
    return f"zig {subprocess.run([find_zig(), 'version'], capture_output=True, text=True, check=True).stdout.strip()}"


def find_zig(needed=True):
    """Path of zig: that of the Python package, else that on the search path; without it UserError, or None if it is not
    needed.
    """
    package = importlib.util.find_spec("ziglang")
    found = (package and shutil.which("zig", path=package.submodule_search_locations[0])) or shutil.which("zig")
    if not found and needed:
        raise UserError(f"zig not found, which compiles for other platforms: {extra('cross')}")
    return found


def start_document(case, path):
    """A case with its rivet table as fmus/generate.py reads it: all start values in SI, and what an importer shows of
    the FMU.
    """
    table, sections = read_table(path, case.Z), {"parameters": variables.PARAMETERS, "inputs": variables.INPUTS}
    values = case.values | cage_of(case, table)
    start = {section: {name: values[name] for name in known} for section, known in sections.items()}
    modes = {"modes": table.modes.room} if table.modes else {}
    rivet = {f"rivet.{name}": value for name, value in case.rivet.items() if f"rivet.{name}" in case.origin}
    about = {"description": fmu_description(case, table), "origin": case.origin, "numbers": case.catalogue | rivet}
    return {"Z": case.Z} | modes | about | start


def cage_of(case, table):
    """The start value of scene.cage: rigid halves where the table has no vibration modes, unless the bearing file asks
    for elastic ones, a UserError.
    """
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
    """Default path of the FMU: my.fmu in the working directory for the bearing or rivet my.toml; that of the 6207 in
    fmus/ of a checkout.
    """
    if source:
        return Path.cwd() / f"{Path(source).stem}{of_cage(cage)}.fmu"
    return (sources / "fmus" if sources == PACKAGE.parent else Path.cwd()) / FMU_NAME


def of_cage(cage):
    """What names of a bearing's files have behind them for a ribbon cage."""
    return "-ribbon" if cage == "ribbon" else ""


def build_folder(sources, bearing, cage=None):
    """Folder for intermediate files, one per bearing: in the build/ of a checkout that can be written to, else in the
    user's cache.
    """
    own = sources == PACKAGE.parent and os.access(sources, os.W_OK)
    base = sources / "build" / "bearings" if own else cache_folder("bearings")
    folder = base / ((Path(str(bearing)).stem if bearing else "default") + of_cage(cage))
    make_folder(folder)
    return folder


@contextlib.contextmanager
def alone_in(folder, say):
    """No second build writes to the folder meanwhile: it waits here."""
    lock = FileLock(folder / ".lock")
    try:
        lock.acquire(timeout=0)
    except Timeout:
        say("waiting for another build in this folder")
        lock.acquire()
    try:
        yield
    finally:
        lock.release()


def compilers():
    """Names by which a C compiler is looked for."""
    return [os.environ["CC"].split()[0]] if os.environ.get("CC") else ["cc", "gcc", "clang"]


def has_compiler():
    """Whether this machine has a C compiler of its own."""
    return any(map(shutil.which, compilers()))


def compiler_platforms():
    """Platforms to compile for if the user names none: () with a C compiler of this machine, this machine's platform
    with zig; UserError without either.
    """
    if has_compiler():
        return ()
    if find_zig(needed=False):
        return (PLATFORM_OF[machine.system(), machine.machine()],)
    raise UserError(
        f"no C compiler ({', '.join(compilers())}) found: install one, or zig, which is one: {extra('cross')}"
    )


def tool(name):
    """A program beside this Python or on the path; None if there is none."""
    return shutil.which(name, path=sysconfig.get_path("scripts")) or shutil.which(name)


def no_tool(name):
    """The error for a missing program."""
    raise UserError(f"{name} not found: `pip install {name}`, or install it with the system's packages")


def generator(folder):
    """Ninja if it is there, except in a folder that was configured without."""
    ninja = tool("ninja")
    return ["-G", "Ninja", f"-DCMAKE_MAKE_PROGRAM={ninja}"] if ninja and not (folder / "Makefile").is_file() else []


def case_with(bearing: Any, rivet: Any, cage: Any = None) -> Case:
    """The Case of a bearing, with the rivet of a geometry file if there is one: preload and seat follow from its shank."""
    if rivet is None or Path(rivet).suffix != ".toml":
        return bearing_case(bearing or "6207", cage=cage)
    if cage is not None:
        raise UserError(f"--cage {cage}: not beside a rivet's file; give cage.shape in the bearing file's [parameters]")
    return rivet_case(Path(rivet), bearing or "6207")


def given_table(rivet, case, kind, say, modes=None):
    """Absolute path of the rivet table: the user's, or one for the case's geometry; UserError if it cannot be had or is
    for another cage.
    """
    if kind is not None and kind not in TABLES:
        raise unknown("--table", "kind", kind, TABLES)
    if rivet is None or Path(rivet).suffix == ".toml":
        return table_of(rivet or case.designation, geometry_of(case), kind, say, modes)
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


def execute(command, folder, say):
    """Run one program of the build, its output in BUILD/build.log; UserError with the first error lines if it fails."""
    lines = []
    with subprocess.Popen(
        [str(part) for part in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace"
    ) as process:
        for line in process.stdout:
            lines.append(line)
            if match := STEP.match(line):
                done, of, percent = match.groups()
                say("compiling", int(percent) / 100 if percent else int(done) / int(of))
    (folder / "build.log").write_text("".join(lines))
    if process.returncode:
        raise UserError(f"{Path(str(command[0])).name} failed: {essence(lines)} (all of it in {folder / 'build.log'})")


def essence(lines):
    """The lines that tell the cause: the first error and the two lines after it, else the last three lines."""
    lines = [line.strip() for line in lines if line.strip() and not STEP.match(line)]
    first = next(
        (i for i, line in enumerate(lines) if re.search(r"\berror\b|^generate:|^rivet table:", line, re.IGNORECASE)),
        max(len(lines) - 3, 0),
    )
    return " ".join(lines[first : first + 3])


def try_start(fmu):
    """Initialize the FMU at its start values; UserError with its reason if it refuses."""
    with Instance(Model(fmu)) as instance:
        instance.initialize(Scene(name="start values of the bearing"))
