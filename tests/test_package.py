"""What the FMU carries: sources that compile, pictures, terminals, documentation, reference results, binaries of other
platforms.
"""

import hashlib
import importlib.util
import json
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import threading
import tomllib
import venv
import zipfile
from html.parser import HTMLParser
from pathlib import Path
from types import SimpleNamespace

import fmpy
import lief
import matplotlib.image
import numpy as np
import pytest
import reference_results
from cyclonedx.schema import SchemaVersion
from cyclonedx.validation.json import JsonStrictValidator
from library import ROOT
from lxml import etree
from reference_results import SAME
from slave import Slave, describe

from bearing_model.generated import variables
from bearing_model.rivet.rivet_table import DEFAULT_TABLE
from riveted_bearing import UserError
from riveted_bearing.building import builder, compiler
from riveted_bearing.building.builder import build_folder

FMI_HEADERS = Path(fmpy.__file__).parent / "c-code"
SCHEMA = Path(fmpy.__file__).parent / "schema" / "fmi3"  # FMI 2.0.4 takes terminals and icons from 3.0
LINUX = sys.platform.startswith("linux")
SANITIZED = "asan" in os.environ.get("LD_PRELOAD", "")
STEP, STEPS = 1e-4, 10  # of the reference results: 1 ms, over which trajectories can be compared point by point


def outputs_of(folder):
    return [v.name for v in describe(folder).modelVariables if v.causality == "output"]


def trajectory(folder):
    """All outputs at the communication points of the reference."""
    slave = Slave(folder).initialize()
    names = outputs_of(folder)
    rows = [slave.get(*names)]
    for k in range(STEPS):
        slave.check("DoStep", k * STEP, STEP, 1)
        rows.append(slave.get(*names))
    return np.array(rows)


def difference(rows, folder):
    """Largest difference of each output from its trajectory in another FMU, against its largest magnitude there."""
    units = {v.name: v.unit or "1" for v in describe(folder).modelVariables}
    names = outputs_of(folder)
    return reference_results.difference(rows, trajectory(folder), names, [units[name] for name in names]).max()


# -------------------------------------------------------------------------------------------------------------- archive


def test_same_bytes_again(fmu, tmp_path):
    subprocess.run(
        [
            sys.executable,
            ROOT / "fmus" / "package.py",
            f"@{ROOT / 'build' / 'fmu' / 'arguments.txt'}",
            "--out",
            tmp_path / "again.fmu",
        ],
        check=True,
    )
    assert (tmp_path / "again.fmu").read_bytes() == fmu.read_bytes()


@pytest.fixture(scope="module")
def elsewhere(tmp_path_factory):
    """A copy of the checkout in a folder of another name and length, with what runs a program of the Python environment
    that lies there, too.
    """
    copy = tmp_path_factory.mktemp("elsewhere") / "of-another-length" / "checkout"
    shutil.copytree(
        ROOT,
        copy,
        ignore=shutil.ignore_patterns(
            ".git", ".venv", "build", "results", "__pycache__", ".*_cache", ".hypothesis", "*.fmu", "*.ssp"
        ),
    )
    (copy / ".venv").symlink_to(sys.prefix, target_is_directory=True)
    python = copy / ".venv" / "bin" / Path(sys.executable).name
    environment = os.environ | {"PYTHONPATH": str(copy), "PATH": f"{python.parent}{os.pathsep}{os.environ['PATH']}"}

    def run(*command):
        subprocess.run(list(map(str, command)), cwd=copy, env=environment, check=True)

    return SimpleNamespace(folder=copy, python=python, run=run)


@pytest.mark.slow  # two minutes of compilation
@pytest.mark.skipif(
    not LINUX or SANITIZED,
    reason="lays the Python environment as a symbolic link; binaries with sanitizers are not stripped",
)
def test_another_folder_gives_the_same_bytes(fmu, elsewhere):
    """Both FMUs and the system of both, compiled from nothing as `make build` does, against those that lie in this
    checkout.
    """
    made = elsewhere.folder / "fmus"
    options = ["-G", "Ninja", f"-DPython_EXECUTABLE={elsewhere.python}", f"-DFMU={made / fmu.name}"]
    elsewhere.run("cmake", "-S", elsewhere.folder, "-B", elsewhere.folder / "build", *options)
    elsewhere.run("cmake", "--build", elsewhere.folder / "build", "--target", "transmission")
    assert differing_members(made / fmu.name, fmu) == set()
    for name in (fmu.name, "Shaft.fmu", "Transmission.ssp"):
        assert (made / name).read_bytes() == fmu.with_name(name).read_bytes(), name


@pytest.mark.slow  # four minutes of compilation, shared with other tests
@pytest.mark.skipif(not LINUX or SANITIZED, reason="for a release on Linux")
def test_another_folder_gives_the_same_bytes_for_all_platforms(everywhere, dist):
    """The bearing's FMU with four binaries as `make dist` makes it in another folder, and the shaft's binaries."""
    here, there = everywhere["RivetedBearing"].parent / "RivetedBearing.fmu", dist / "RivetedBearing.fmu"
    assert differing_members(there, here) == set()
    assert there.read_bytes() == here.read_bytes()
    for platform, suffix in PLATFORMS.items():
        shaft = dist.parent / "build" / "bearings" / "default" / platform / f"Shaft{suffix}"
        assert shaft.read_bytes() == (everywhere["Shaft"] / "binaries" / platform / shaft.name).read_bytes(), platform


def differing_members(one, other):
    """Names of the members that are in one archive only or differ."""
    with zipfile.ZipFile(one) as a, zipfile.ZipFile(other) as b:
        common = set(a.namelist()) & set(b.namelist())
        return set(a.namelist()) ^ set(b.namelist()) | {name for name in common if a.read(name) != b.read(name)}


def test_archive_as_the_standard_wants_it(fmu):
    """FMI 2.0.4, section 2.3: deflated or stored, version 2.0 of the format, no links; nothing needed at run time in
    resources/.
    """
    with zipfile.ZipFile(fmu) as archive:
        members = archive.infolist()
    assert all(
        m.compress_type in (zipfile.ZIP_DEFLATED, zipfile.ZIP_STORED) and m.extract_version <= 20 for m in members
    )
    assert not any(m.external_attr >> 16 & 0o170000 == 0o120000 for m in members)
    assert not any(m.filename.startswith("resources/") for m in members)


@pytest.mark.parametrize("name", ["RivetedBearing", "Shaft"])
def test_description_and_bill_of_materials_say_what_is_inside(fmu, tmp_path, name):
    """Version, author and build as in project, binary and saved states; a valid bill (CycloneDX 1.6) of each binary,
    library and table, with checksums.
    """
    path = fmu.with_name(f"{name}.fmu")
    folder = Path(fmpy.extract(str(path), str(tmp_path)))
    text = (folder / "extra" / "org.cyclonedx" / "bom.json").read_text(encoding="utf-8")
    assert JsonStrictValidator(SchemaVersion.V1_6).validate_str(text) is None
    bill, root = json.loads(text), etree.parse(folder / "modelDescription.xml").getroot()
    whole, project = (
        bill["metadata"]["component"],
        tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"],
    )

    assert whole["name"] == root.get("modelName") == name
    assert whole["version"] == root.get("version") == project["version"]
    assert (
        [author["name"] for author in whole["authors"]]
        == [root.get("author")]
        == [author["name"] for author in project["authors"]]
    )
    about = {one["name"]: one["value"] for one in whole["properties"]}
    assert about["fmi:guid"] == root.get("guid") and re.fullmatch("[0-9a-f]{64}", about["build"])
    assert root.get("generationTool") == f"{project['name']} {project['version']}, build {about['build'][:12]}"
    slave = Slave(folder).initialize()
    state = slave.bytes(slave.save())
    # so the builds that exchange states are those of which description and bill say so
    assert state[56:128].rstrip(b"\0").decode() == about["build"]

    parts = {one["bom-ref"]: one for one in bill["components"]}
    (dependencies,) = bill["dependencies"]
    assert dependencies["ref"] == "fmu" and sorted(dependencies["dependsOn"]) == sorted(parts)
    sums = {ref: one["hashes"] for ref, one in parts.items() if "hashes" in one}
    files = {member.relative_to(folder).as_posix(): member for member in (folder / "binaries").rglob("*.*")}
    files |= {"rivet_table": DEFAULT_TABLE} if name == "RivetedBearing" else {}
    assert sums == {
        ref: [{"alg": "SHA-256", "content": hashlib.sha256(file.read_bytes()).hexdigest()}]
        for ref, file in files.items()
    }
    versions = {ref: one["version"] for ref, one in parts.items() if one["type"] == "library"}
    compiled = re.findall(
        r'#define SUNDIALS_VERSION "(.*)"',
        "".join(file.read_text() for file in (folder / "sources").glob("sundials_config.h")),
    )
    assert versions == {"fmpy": fmpy.__version__} | ({"sundials": compiled[0]} if name == "RivetedBearing" else {})


def test_terminals_are_valid_and_name_variables(folder):
    path = folder / "terminalsAndIcons" / "terminalsAndIcons.xml"
    terminals = etree.parse(path)
    etree.XMLSchema(etree.parse(SCHEMA / "fmi3TerminalsAndIcons.xsd")).assertValid(terminals)
    known = {v.name for v in describe(folder).modelVariables if v.causality in ("input", "output")}
    members = [m.get("variableName") for m in terminals.iter("TerminalMemberVariable")]
    at_a_glance = {
        name
        for title in ("Cage", "Stress of the worst rivet", "Health of bearing and run")
        for name in variables.ESSENTIALS[title]
    }
    assert at_a_glance <= set(members)
    assert len(set(members)) == len(members) > 20
    assert set(members) <= known
    inputs = {v.name for v in describe(folder).modelVariables if v.causality == "input"}
    assert inputs <= set(members)
    for terminal in terminals.iter("Terminal"):
        names = [m.get("memberName") for m in terminal.iter("TerminalMemberVariable")]
        assert len(set(names)) == len(names)
    for icon in terminals.iter("TerminalGraphicalRepresentation"):
        assert (path.parent / f"{icon.get('iconBaseName')}.png").is_file()


@pytest.mark.parametrize("name", ["model.png", "terminalsAndIcons/icon.png"])
def test_icon_shows_the_bearing(folder, name):
    """Opaque rings around a transparent bore, transparent corners."""
    picture = matplotlib.image.imread(folder / name)
    height, width, _ = picture.shape
    assert height == width >= 128
    opacity = picture[:, :, 3]
    assert opacity[0, 0] == opacity[height // 2, width // 2] == 0.0
    side, line = 1.02 * 72.0, 0.35 / 72 * 1.02 * 72.0  # of the picture, half of an outline [mm]
    ring = np.pi * ((36.0 + line) ** 2 - (17.5 - line) ** 2) / side**2  # between bore and outside of a 6207
    assert np.mean(opacity > 0.5) == pytest.approx(ring, rel=0.02)  # one sees through beside the cage; observed -0.9 %


class Page(HTMLParser):
    """Ids, links and text of a page."""

    def __init__(self, text):
        super().__init__()
        self.ids, self.links, self.text, self.loads = set(), [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.ids.add(attributes.get("id"))
        self.links += [attributes["href"]] if tag == "a" else []
        self.loads += [
            value for key, value in attributes.items() if key in ("src", "srcset") or (tag == "link" and key == "href")
        ]

    def handle_data(self, data):
        self.text.append(data)


def test_documentation_is_complete_and_self_contained(folder):
    path = folder / "documentation" / "index.html"
    page = Page(path.read_text())
    text = " ".join(page.text)
    assert page.loads == []
    for link in page.links:
        assert (
            link[1:] in page.ids if link.startswith("#") else link.startswith("http") or (path.parent / link).is_file()
        ), link
    names = {
        re.sub(r"\[\d+\]", "", v.name)
        for v in describe(folder).modelVariables
        if v.causality in ("input", "parameter", "output")
    }
    shown = {re.sub(r"\[\w\]", "", word) for word in text.split()}
    assert names <= shown, names - shown
    assert "$" not in text
    assert "assumed" in text


@pytest.mark.skipif(SANITIZED, reason="a build with sanitizers cannot run its binary while packing")
def test_reference_results_are_this_binarys(folder):
    names, times, rows = reference_results.read_reference(folder)
    assert times == pytest.approx(STEP * np.arange(STEPS + 1), abs=1e-15)
    at = [outputs_of(folder).index(name) for name in names]
    assert len(at) > 100
    assert np.array_equal(trajectory(folder)[:, at], rows)
    (path,) = (folder / "extra" / "org.fmi-standard.fmi-ls-ref").glob("*.csv")
    manifest = etree.parse(path.with_name("fmi-ls-manifest.xml"))
    related = {each.get("role"): each.get("source") for each in manifest.iter("Related")}
    assert related == {"experiment/smoke-test": "smoke_test.xml", "result": path.name, "meta-data": "validity.srmd"}
    validity = etree.parse(path.with_name("validity.srmd")).getroot()
    assert {each.get("keyword") for each in validity.iter("{*}ClassificationEntry")} >= {"range", "horizon", "left out"}
    assert (path.parent / validity.get("data")).resolve() == (folder / "modelDescription.xml").resolve()
    (experiment,) = etree.parse(path.with_name("smoke_test.xml")).iter("Experiment")
    assert experiment.find("References").get("source") == path.name and float(experiment.get("tolerance")) == 1e-3
    settings = {name: float(value) for name, value in experiment.find("TransientSimulation").attrib.items()}
    assert settings == {"startTime": 0.0, "stopTime": pytest.approx(STEP * STEPS), "stepSize": STEP}


@pytest.mark.skipif(SANITIZED, reason="a build with sanitizers has no reference results")
def test_fmpy_repeats_the_reference_results(fmu):
    """Its master adds up the time where the reference multiplies.  Observed: 6.5e-11."""
    assert reference_results.main(fmu) == 0


# -------------------------------------------------------------------------------------------------------------- sources


def test_description_lists_the_sources(folder):
    description = etree.parse(folder / "modelDescription.xml").find("CoSimulation")
    assert description.get("needsExecutionTool", "false") == "false"
    listed = {file.get("name") for file in description.iter("File")}
    assert {path.name for path in (folder / "sources").glob("*.c")} == listed
    included = re.findall(
        r'^\s*#\s*include\s*"(.*)"', "".join(path.read_text() for path in (folder / "sources").iterdir()), re.MULTILINE
    )
    missing = {name for name in included if not (folder / "sources" / name).is_file()}
    # FMI's own come from the importer; an option of SUNDIALS that is off
    assert missing == {"fmi2Functions.h", "caliper/cali.h"}


def compiled(folder, tmp_path, compile_):
    """The FMU unpacked anew without binaries, compiled by the function."""
    copy = tmp_path / "fmu"
    shutil.copytree(folder, copy, ignore=shutil.ignore_patterns("binaries"))
    compile_(copy)
    return copy


@pytest.mark.slow  # 20 s of compilation
@pytest.mark.skipif(not LINUX, reason="options of a Linux compiler")
@pytest.mark.parametrize(
    "options",
    [["-O0"], ["-O3", "-march=native", "-ffp-contract=off"], ["-O2", "-std=c17", "-pedantic-errors", "-mno-avx"]],
    ids=" ".join,
)
def test_sources_compile_with_plain_cc(folder, tmp_path, options):
    """Options of the compiler change no bit of the sources' results (observed), so what differs from the binary is what
    its kernels fuse.
    """

    def cc(copy):
        library = copy / "binaries" / fmpy.platform / "RivetedBearing.so"
        library.parent.mkdir(parents=True)
        sources = sorted(map(str, (copy / "sources").glob("*.c")))
        override = "-DFMI2_OVERRIDE_FUNCTION_PREFIX"
        subprocess.run(
            ["cc", *options, "-shared", "-fPIC", override, f"-I{FMI_HEADERS}", *sources, "-lm", "-o", str(library)],
            check=True,
        )

    assert difference(trajectory(compiled(folder, tmp_path, cc)), folder) <= SAME  # observed 1.1e-10


def test_arithmetic_that_is_not_ieee_754s_is_refused(folder, tmp_path):
    """-ffast-math would take tests for numbers out."""
    command = [
        "cc",
        "-ffast-math",
        "-c",
        f"-I{FMI_HEADERS}",
        str(folder / "sources" / "rhs.c"),
        "-o",
        str(tmp_path / "rhs.o"),
    ]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode != 0 and "-ffast-math" in done.stderr


@pytest.mark.slow  # a minute of compilation
@pytest.mark.parametrize("target", ["x86_64-linux-musl", "aarch64-linux-musl"])
def test_sources_compile_for_other_systems(folder, tmp_path, target):
    """By clang, with another C library, for another processor: what the guide for targets promises."""
    pytest.importorskip("ziglang", reason='pip install -e ".[cross]"')
    library, sources = tmp_path / "RivetedBearing.so", sorted(map(str, (folder / "sources").glob("*.c")))
    options = ["-target", target, "-std=c17", "-O1", "-ffp-contract=off", "-shared", "-fPIC"]
    subprocess.run(
        [sys.executable, "-m", "ziglang", "cc", *options, f"-I{FMI_HEADERS}", *sources, "-lm", "-o", str(library)],
        check=True,
    )
    exported = {symbol.name for symbol in lief.parse(str(library)).exported_functions}
    assert {"fmi2Instantiate", "fmi2DoStep"} <= {name.removeprefix("RivetedBearing_") for name in exported}


@pytest.mark.slow  # half a minute of compilation
def test_clang_has_nothing_to_warn_of(folder, tmp_path):
    """A build with CC=clang, macOS's compiler, makes warnings errors as gcc's does."""
    pytest.importorskip("ziglang", reason='pip install -e ".[cross]"')
    ours = {"rivet_table.c", *(path.name for path in (ROOT / "fmu_src").rglob("*.c"))}
    sources = [str(path) for path in sorted((folder / "sources").glob("*.c")) if path.name in ours]
    options = ["-target", "x86_64-linux-musl", "-std=c17", "-O0", "-c", "-Wall", "-Wextra", "-Wpedantic", "-Werror"]
    done = subprocess.run(
        [sys.executable, "-m", "ziglang", "cc", *options, f"-I{FMI_HEADERS}", *sources],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert len(sources) > 40


@pytest.mark.slow  # 20 s of compilation
def test_sources_compile_with_fmpy(folder, tmp_path, monkeypatch):
    from fmpy.build import build_platform_binary

    monkeypatch.setenv("PATH", f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}")  # cmake
    copy = compiled(folder, tmp_path, lambda copy: build_platform_binary(copy))
    assert difference(trajectory(copy), folder) <= SAME  # observed 1.1e-10


# ------------------------------------------------------------------------------------------------------ other platforms


PLATFORMS = {"linux64": ".so", "win64": ".dll", "darwin64": ".dylib", "aarch64-darwin": ".dylib"}


def binary(folder, platform):
    return folder / "binaries" / platform / f"RivetedBearing{PLATFORMS[platform]}"


@pytest.mark.slow  # two minutes of compilation
@pytest.mark.parametrize("platform", PLATFORMS)
def test_binaries_export_fmi_only_and_need_the_system_only(everywhere, platform):
    library = lief.parse(str(binary(everywhere["RivetedBearing"], platform)))
    macos = "darwin" in platform
    exported = {symbol.name.removeprefix("_") if macos else symbol.name for symbol in library.exported_functions}
    of_the_linker = {"_mh_dylib_header", "__dso_handle"}
    assert len({name for name in exported if name.startswith("fmi2")}) == 44
    assert all(name.startswith("fmi2") for name in exported - of_the_linker)
    if platform == "linux64":
        # the last for thread-local variables
        assert set(library.libraries) <= {"libc.so.6", "libm.so.6", "ld-linux-x86-64.so.2"}
        versions = {
            tuple(map(int, v.name[6:].split(".")))
            for r in library.symbols_version_requirement
            for v in r.get_auxiliary_symbols()
        }
        assert max(versions) <= (2, 17)
    elif platform == "win64":
        assert all(name.lower() == "kernel32.dll" or name.startswith("api-ms-win-crt-") for name in library.libraries)
    else:
        assert {name.name for name in library.libraries} <= {"RivetedBearing.dylib", "/usr/lib/libSystem.B.dylib"}
        assert library.build_version.minos[0] == 11
        assert library.has_code_signature or platform == "darwin64"  # Apple Silicon runs signed code only


def glibc_needed(library):
    """The newest version of glibc that a binary's symbols ask for."""
    elf = lief.parse(str(library))  # lives as long as its members are read
    wanted = [v.name for r in elf.symbols_version_requirement for v in r.get_auxiliary_symbols()]
    return max(tuple(map(int, name.removeprefix("GLIBC_").split("."))) for name in wanted if name.startswith("GLIBC_"))


@pytest.mark.skipif(
    fmpy.platform != "linux64" or SANITIZED, reason="reads the binary that this machine's compiler made for linux64"
)
@pytest.mark.parametrize("name", ["RivetedBearing", "Shaft"])
def test_a_native_binary_needs_no_newer_glibc_than_stated(name, tmp_path):
    """As the README states (cmake/glibc_2_17.h).  Observed: 2.17, and 2.14 of
    the shaft.
    """
    unpacked = Path(fmpy.extract(str(ROOT / "fmus" / f"{name}.fmu"), str(tmp_path)))
    assert glibc_needed(unpacked / "binaries" / "linux64" / f"{name}.so") <= (2, 17)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["RivetedBearing", "Shaft"])
def test_a_cross_compiled_binary_needs_glibc_2_17(everywhere, name):
    assert glibc_needed(everywhere[name] / "binaries" / "linux64" / f"{name}.so") <= (2, 17)


@pytest.mark.slow
@pytest.mark.parametrize("platform", PLATFORMS)
def test_shaft_is_cross_compiled_with_it(everywhere, platform):
    """The second FMU of examples/transmission, beside the bearing's binary."""
    library = lief.parse(str(build_folder(ROOT, None) / platform / f"Shaft{PLATFORMS[platform]}"))
    assert (
        len({symbol.name for symbol in library.exported_functions if symbol.name.removeprefix("_").startswith("fmi2")})
        == 44
    )


@pytest.mark.slow
@pytest.mark.skipif(fmpy.platform != "linux64", reason="runs the binary for linux64")
def test_cross_compiled_is_the_same(everywhere, folder):
    assert difference(trajectory(everywhere["RivetedBearing"]), folder) <= SAME  # observed 0


def processor_time(folder, steps):
    slave = Slave(folder).initialize()
    slave.step(STEP, steps)
    return slave.get("solver.cpu_time")[0]


@pytest.mark.slow
@pytest.mark.skipif(fmpy.platform != "linux64", reason="runs the binary for linux64")
def test_cross_compiled_is_as_fast(everywhere, folder):
    """Processor time of 20 ms, best of five in turns: the same within the scatter of a shared machine; observed 0.94."""
    times = np.array([[processor_time(each, 200) for each in (everywhere["RivetedBearing"], folder)] for _ in range(5)])
    assert times[:, 0].min() <= 1.1 * times[:, 1].min()


@pytest.mark.slow
def test_windows_binary_under_wine(everywhere, wine, folder, tmp_path):
    host, bearing = tmp_path / "fmu_host.exe", everywhere["RivetedBearing"]
    zig = [sys.executable, "-m", "ziglang", "cc", "-target", "x86_64-windows-gnu"]
    subprocess.run(
        [
            *zig,
            "-O1",
            "-Wall",
            "-Wextra",
            "-Werror",
            f"-I{FMI_HEADERS}",
            str(Path(__file__).with_name("fmu_host.c")),
            "-o",
            str(host),
        ],
        check=True,
    )
    description = describe(bearing)
    references = {v.name: v.valueReference for v in description.modelVariables}
    names = outputs_of(bearing)
    shutil.copy(binary(bearing, "win64"), tmp_path)
    result = subprocess.run(
        [*wine.command, str(host), "RivetedBearing.dll", description.guid, str(STEPS), repr(STEP)],
        input=" ".join(str(references[name]) for name in names), capture_output=True, text=True, env=wine.environment, cwd=tmp_path, check=False,
    )  # fmt: skip
    assert result.returncode == 0, result.stderr
    rows = np.array([[float.fromhex(value) for value in line.split()] for line in result.stdout.splitlines()])
    assert difference(rows, folder) <= SAME


# -------------------------------------------------------------------------------------------------------------- release


def environment_beside(folder):
    """A Python environment that sees this one's packages, except what stands in it itself; its folder of programs."""
    venv.create(folder, with_pip=True, symlinks=True)
    packages = folder / "lib" / f"python{sys.version_info[0]}.{sys.version_info[1]}" / "site-packages"
    # the .pth files there, of editable packages, are not read
    (packages / "beside.pth").write_text(f"{sysconfig.get_path('purelib')}\n")
    return folder / "bin"


@pytest.fixture(scope="session")
def dist(tmp_path_factory):
    """The folder that `make dist` writes in a copy of the checkout with an environment of its own; minutes of
    compilation and downloads.
    """
    if not importlib.util.find_spec("ziglang"):
        pytest.skip("needs the package ziglang: pip install ziglang")
    copy = tmp_path_factory.mktemp("release") / "of-another-length" / "checkout"
    shutil.copytree(
        ROOT,
        copy,
        ignore=shutil.ignore_patterns(
            ".git", ".venv", "build", "dist", "results", "__pycache__", ".*_cache", ".hypothesis", "*.fmu", "*.ssp"
        ),
    )
    environment_beside(copy / ".venv")
    (copy / ".venv" / "installed").touch()
    subprocess.run(["make", "dist"], cwd=copy, check=True)
    return copy / "dist"


@pytest.mark.slow
@pytest.mark.skipif(not LINUX or SANITIZED, reason="for a release on Linux")
def test_dist_holds_wheel_sources_versions_and_checksums(dist):
    (wheel,) = dist.glob("riveted_bearing-*-py3-none-any.whl")
    version = wheel.name.split("-")[1]
    names = {wheel.name, f"riveted_bearing-{version}.tar.gz", "RivetedBearing.fmu", "requirements.txt"}
    assert {path.name for path in dist.iterdir()} == names | {"SHA256SUMS"}
    sums = dict(reversed(line.split("  ")) for line in (dist / "SHA256SUMS").read_text().splitlines())
    assert sums == {name: hashlib.sha256((dist / name).read_bytes()).hexdigest() for name in names}
    with zipfile.ZipFile(wheel) as archive:
        assert archive.read("riveted_bearing/RivetedBearing.fmu") == (dist / "RivetedBearing.fmu").read_bytes()
        (metadata,) = (name for name in archive.namelist() if name.endswith(".dist-info/METADATA"))
        wanted = re.findall(r"^Requires-Dist: ([\w-]+)[^;\n]*$", archive.read(metadata).decode(), re.MULTILINE)
    with zipfile.ZipFile(dist / "RivetedBearing.fmu") as archive:
        assert {f"binaries/{platform}/RivetedBearing{suffix}" for platform, suffix in PLATFORMS.items()} <= set(
            archive.namelist()
        )
    text = (dist / "requirements.txt").read_text()
    locked = re.findall(r"^([\w.-]+)==\S+ \\\n(?:    --hash=sha256:[0-9a-f]{64}(?: \\)?\n)+", text, re.MULTILINE)
    assert len(wanted) >= 4 and {*wanted, "scipy", "pyarrow", "ziglang", "scikit-build-core"} <= set(locked)
    assert len(locked) == len(re.findall(r"^[\w.-]+==", text, re.MULTILINE))
    assert "://" not in text and str(dist.parent) not in text and "--find-links" not in text
    assert "index" not in text.replace("importlib", "")


@pytest.mark.slow
@pytest.mark.skipif(not LINUX or SANITIZED, reason="for a release on Linux")
def test_the_wheel_simulates_without_a_compiler(dist, tmp_path):
    """Installed where no program but the environment's own is on the path: nothing is compiled, the working point runs."""
    programs = environment_beside(tmp_path / "venv")
    (wheel,) = dist.glob("*.whl")
    subprocess.run(
        [programs / "python", "-m", "pip", "--quiet", "install", "--no-deps", "--no-index", wheel], check=True
    )
    environment = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "CC")} | {
        "PATH": str(programs)
    }

    def said(*arguments):
        command = [programs / "riveted-bearing", *arguments]
        return subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=True).stdout

    assert wheel.name.split("-")[1] in said("--version")
    assert "6308" in said("info", "6308")
    said("run", "demo")
    assert list((tmp_path / "results").glob("demo.parquet"))


def test_without_a_compiler_zig_is_taken_or_named(monkeypatch):
    """`build` without --platforms: this machine's compiler, else zig for this machine, else one line that names both
    ways out.
    """
    monkeypatch.delenv("CC", raising=False)
    monkeypatch.setattr(compiler.shutil, "which", lambda name, path=None: f"/bin/{name}" if name == "gcc" else None)
    assert compiler.compiler_platforms() == ()
    monkeypatch.setattr(compiler.shutil, "which", lambda name, path=None: f"/bin/{name}" if name == "zig" else None)
    monkeypatch.setattr(compiler.machine, "system", lambda: "Windows")
    monkeypatch.setattr(compiler.machine, "machine", lambda: "AMD64")
    assert compiler.compiler_platforms() == ("win64",)
    monkeypatch.setattr(compiler.shutil, "which", lambda name, path=None: None)
    with pytest.raises(UserError, match=r"no C compiler \(cc, gcc, clang\) found: install one, or zig, .*\[cross\]"):
        compiler.compiler_platforms()


def test_from_source_without_a_compiler_is_one_line(tmp_path, monkeypatch):
    """pip asks the backend before it downloads anything, and gets no list of packages but a line; archives and editable
    installs compile nothing.
    """
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    assert project["build-system"]["requires"] == []
    hook = "import sys; sys.path.insert(0, sys.argv[1]); import backend; print(*getattr(backend, f'get_requires_for_build_{sys.argv[2]}')(), sep='\\n')"

    def asked(kind, **environment):
        command = [sys.executable, "-c", hook, str(ROOT / "cmake"), kind]
        return subprocess.run(command, env=environment, capture_output=True, text=True, check=False)

    (tmp_path / "mycc").touch(mode=0o755)
    for environment in ({"PATH": str(tmp_path)}, {"PATH": os.environ["PATH"], "CC": "missing-cc -O2"}):
        refused = asked("wheel", **environment)
        assert refused.returncode == 1 and refused.stdout == "" and refused.stderr.count("\n") == 1
        assert re.search(
            r"needs a C compiler, .*\((cc, gcc, clang|missing-cc)\): install one .* gcc libc6-dev.*riveted_bearing-\*\.whl",
            refused.stderr,
        )
        assert (
            asked("sdist", **environment).stdout
            == asked("editable", **environment).stdout
            == "scikit-build-core>=0.11\n"
        )
    first, *others = asked("wheel", PATH=str(tmp_path), CC="mycc").stdout.splitlines()
    known = project["project"]["dependencies"] + project["project"]["optional-dependencies"]["build"]
    assert first.startswith("scikit-build-core") and set(others) <= set(known)


def test_a_second_build_in_a_folder_waits(tmp_path, monkeypatch):
    """Two ninja in one folder wrote the same files."""
    said, order, waiting = [], [], threading.Event()

    def say(text, share=None):
        said.append(text)
        if "another build" in text:
            waiting.set()

    def second():
        with compiler.alone_in(tmp_path, say):
            order.append("second")

    with compiler.alone_in(tmp_path, say):
        thread = threading.Thread(target=second)
        thread.start()
        assert waiting.wait(20.0)
        order.append("first")
    thread.join(20.0)
    assert said == ["waiting for another build in this folder"] and order == ["first", "second"]


def test_a_checkout_without_permission_builds_in_the_cache(tmp_path, monkeypatch):
    """Root, as whom tests may run, has permission everywhere: os.access answers for another user."""
    monkeypatch.setattr(builder, "PACKAGE", tmp_path / "riveted_bearing")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setattr(os, "access", lambda path, mode: Path(path) != tmp_path)
    assert builder.build_folder(tmp_path, "my.toml") == tmp_path / "cache" / "riveted-bearing" / "bearings" / "my"


def test_a_default_build_forgets_the_one_before(tmp_path, monkeypatch):
    """CMake remembers options: after a build with variables of its own, one without must say so, or description and
    binary do not belong together.
    """
    told = []

    class EnoughError(Exception):
        pass

    def configured(sources, folder, options, target, say, platform=None):
        told.append([option for option in options if option.startswith("-DGENERATED_DIR=")])
        raise EnoughError

    for name, value in {
        "build_folder": lambda *_: tmp_path,
        "table_copy": lambda *_: tmp_path / "table.json",
        "compiler_platforms": tuple,
    }.items():
        monkeypatch.setattr(builder, name, value)
    monkeypatch.setattr(builder, "has_compiler", lambda: True)
    monkeypatch.setattr(builder, "compile_target", configured)
    monkeypatch.setattr(builder.Core, "archive", lambda core, say: tmp_path / "core.a")
    for kind in ("closed-form", None):
        with pytest.raises(EnoughError):
            builder.build_fmu(out=tmp_path / "x.fmu", kind=kind)
    assert told == [[f"-DGENERATED_DIR={tmp_path / 'generated'}"], ["-DGENERATED_DIR="]]
