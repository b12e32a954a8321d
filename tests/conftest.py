"""What the tests share: the built FMU and the C core, or in files that say TWINS = True each of the twins in turn."""

import ctypes
import importlib.util
import os
import re
import shutil
import signal
import subprocess
import sys
import zipfile
from pathlib import Path
from types import SimpleNamespace

import fmpy
import pytest
from fmpy.validation import validate_fmu
from library import LIBRARY, ROOT, Core
from matplotlib.figure import Figure
from pictures import faults
from python_core import python_core
from slave import Slave
from threadpoolctl import threadpool_limits

from riveted_bearing.building.builder import PLATFORMS, build_folder
from riveted_bearing.running.fmu import Model
from riveted_bearing.studies.sweep import cluster


def pytest_generate_tests(metafunc):
    """In files with TWINS = True, tests of `core` run on the C core and on the Python reference, unless they are marked
    c_only.
    """
    if (
        "core" in metafunc.fixturenames
        and getattr(metafunc.module, "TWINS", False)
        and not metafunc.definition.get_closest_marker("c_only")
    ):
        metafunc.parametrize("core", ["C", "Python"], indirect=True)


# a shell's background job ignores Ctrl-C, and so would the programs that tests start and interrupt
if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(scope="session", autouse=True)
def one_thread():
    """Small matrices: on a shared machine the threads of the linear algebra wait for each other longer than they
    compute.
    """
    with threadpool_limits(1):
        yield


@pytest.fixture(scope="session", autouse=True)
def pictures_are_in_order():
    """Every picture that a test of this process saves shows its texts whole and side by side (pictures.py)."""
    save = Figure.savefig

    def inspected(figure, *arguments, **options):
        canvas = figure.canvas
        found = list(faults(figure))
        figure.set_canvas(canvas)
        assert not found, found
        return save(figure, *arguments, **options)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Figure, "savefig", inspected)
        yield


@pytest.fixture(scope="session")
def fmu():
    """Path of the FMU that `make build` writes."""
    path = ROOT / "fmus" / "RivetedBearing.fmu"
    assert path.is_file(), f"{path} is missing: make build"
    return path


@pytest.fixture(scope="session")
def model(fmu):
    """The Model of that FMU."""
    return Model(fmu)


ORIGIN = """<VendorAnnotations><Tool name="riveted-bearing"><Origin><Value name="shaft.F_y" origin="yours"/><Value name="shaft.omega" origin="rule"/>
<Value name="bearing.D" origin="yours"/></Origin></Tool></VendorAnnotations>"""


@pytest.fixture(scope="session")
def own(fmu, tmp_path_factory):
    """The FMU described as that of another bearing: a load of its own, the 6207's balls, a speed by rule."""
    path = tmp_path_factory.mktemp("own") / "mine.fmu"
    with zipfile.ZipFile(fmu) as old, zipfile.ZipFile(path, "w") as new:
        for member in old.infolist():
            data = old.read(member)
            if member.filename == "modelDescription.xml":
                text = data.decode().replace("<ModelVariables>", f"{ORIGIN}<ModelVariables>")
                text, count = re.subn(r'(name="shaft.F_y".*?start=")2994.0', r"\g<1>4100.0", text, count=1, flags=re.S)
                assert count == 1
                data = text.encode()
            new.writestr(member, data)
    return path


@pytest.fixture(scope="session")
def core(request):
    """The C core: models of it, and every function by name (see library.py); or the reference in its place (see
    python_core.py).
    """
    if getattr(request, "param", "C") == "Python":
        return python_core()
    assert LIBRARY.is_file(), f"{LIBRARY} is missing: make build"
    return Core.load()


@pytest.fixture(scope="session")
def folder(fmu, tmp_path_factory):
    """The FMU, unzipped."""
    return Path(fmpy.extract(str(fmu), str(tmp_path_factory.mktemp("fmu"))))


@pytest.fixture
def slave(folder):
    return Slave(folder)


@pytest.fixture
def running(slave):
    return slave.initialize()


@pytest.fixture(scope="session")
def everywhere(tmp_path_factory):
    """Folders of both FMUs with binaries for all platforms, by name; two minutes of compilation."""
    if not importlib.util.find_spec("ziglang"):
        pytest.skip("needs the package ziglang: pip install ziglang")
    made = tmp_path_factory.mktemp("all")
    subprocess.run(
        [
            sys.executable,
            "-m",
            "riveted_bearing",
            "build",
            "--platforms",
            "all",
            "--out",
            str(made / "RivetedBearing.fmu"),
        ],
        check=True,
    )
    assert validate_fmu(str(made / "RivetedBearing.fmu")) == []
    bearing, built = (
        Path(fmpy.extract(str(made / "RivetedBearing.fmu"), str(made / "bearing"))),
        build_folder(ROOT, None),
    )
    shaft = Path(fmpy.extract(str(ROOT / "fmus" / "Shaft.fmu"), str(made / "shaft")))
    for platform in PLATFORMS:
        (binary,) = (built / platform).glob("Shaft.*")
        (shaft / "binaries" / platform).mkdir(parents=True, exist_ok=True)
        shutil.copy(binary, shaft / "binaries" / platform)
    return {"RivetedBearing": bearing, "Shaft": shaft}


@pytest.fixture
def laid(fmu, tmp_path, monkeypatch):
    """A function that makes the working folder that of a page's reader: the FMU, and the files of the page by name."""

    def lay(files):
        (tmp_path / fmu.name).symlink_to(fmu)
        for name, text in files.items():
            (tmp_path / name).write_text(text, encoding="utf-8")
        monkeypatch.chdir(tmp_path)
        monkeypatch.setenv("PYTHONPATH", str(ROOT))
        return tmp_path

    return lay


@pytest.fixture(scope="module")
def client():
    """Two worker processes of this machine."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PYTHONPATH", str(ROOT))
        with cluster(workers=2) as client:
            yield client


@pytest.fixture(scope="session")
def browser():
    """A headless Chromium of this machine."""
    playwright = pytest.importorskip("playwright.sync_api", reason='no playwright: pip install -e ".[slow]"')
    chromium = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    if chromium is None:
        pytest.skip("no Chromium on this machine")
    with playwright.sync_playwright() as p:
        # the sanitizers' library is not for the browser
        env = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}
        browser = p.chromium.launch(executable_path=chromium, args=["--no-sandbox"], env=env)
        yield browser
        browser.close()


@pytest.fixture(scope="session")
def wine(tmp_path_factory):
    """The command that runs Windows programs, and its environment."""
    program = next(filter(None, map(shutil.which, ("wine64", "wine", "/usr/lib/wine/wine64"))), None)
    if not program:
        pytest.skip("needs wine, which runs Windows programs: apt-get install wine64")
    environment = os.environ | {
        "WINEPREFIX": str(tmp_path_factory.mktemp("wine")),
        "WINEDEBUG": "-all",
        "WINEDLLOVERRIDES": "mscoree,mshtml=",
    }
    return SimpleNamespace(command=[program], environment=environment)


UNZIP = """#!/bin/sh
# unzip -o ARCHIVE -d FOLDER
exec "{python}" -m zipfile -e "$2" "$4"
"""


@pytest.fixture
def ecospy(tmp_path, monkeypatch):
    """The importer ecos with what its package does not bring: the program `unzip`, and the library TBB (`pip install
    tbb`, or the system's).
    """
    program = tmp_path / "bin" / "unzip"
    program.parent.mkdir()
    program.write_text(UNZIP.format(python=sys.executable))
    program.chmod(0o755)
    monkeypatch.setenv("PATH", str(program.parent), prepend=os.pathsep)
    tbb = Path(sys.prefix) / "lib" / "libtbb.so.12"
    if tbb.exists():
        ctypes.CDLL(str(tbb))
    return pytest.importorskip("ecospy", reason="ecospy is not installed: pip install ecospy")


@pytest.fixture
def record_property(record_property):
    """As pytest's, for numbers of NumPy too, which the processes of pytest-xdist cannot send."""

    def plain(value):
        if isinstance(value, dict):
            return {key: plain(one) for key, one in value.items()}
        if isinstance(value, (list, tuple)):
            return [plain(one) for one in value]
        return value.tolist() if hasattr(value, "tolist") else value

    return lambda name, value: record_property(name, plain(value))
