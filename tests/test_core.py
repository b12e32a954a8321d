"""The compiled core in the user's cache: compiled once for each number of balls, compiler and state of the sources, never
used damaged.

Most tests count the compiler's calls on a project of two files that stands for the core's.
"""

import contextlib
import os
import re
import shutil
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from types import SimpleNamespace

import pytest
from library import ROOT

from riveted_bearing import UserError, build
from riveted_bearing.base.files import cache_path
from riveted_bearing.building import builder
from riveted_bearing.building.core import Core

pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="a shell script stands for the compiler")

CMAKE = """cmake_minimum_required(VERSION 3.25)
project(small LANGUAGES C)
add_library(core STATIC fmu_src/a.c fmu_src/b.c)
set_target_properties(core PROPERTIES PREFIX "" SUFFIX .a)
target_include_directories(core PRIVATE ${GENERATED_DIR})
"""
GENERATE = """import sys, pathlib
sizes, out = pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[4])
out.mkdir(exist_ok=True)
header, text = out / "variables.h", "enum { " + sizes.read_text().replace("\\n", ", ") + "};\\n"
if not header.exists() or header.read_text() != text:
    header.write_text(text)
"""
COMPILER = """#!/bin/sh
# logs the C file of a call of the compiler, CMake's own trials left out, and waits while there is a file `hold`
for last in "$@"; do :; done
case "$last" in *CMake*) ;; *.c) echo "$last" >> {log}; while [ -e {hold} ]; do sleep 0.02; done ;; esac
exec cc "$@"
"""


def quiet(text, share=None):
    pass


@pytest.fixture
def compiler(tmp_path, monkeypatch):
    """A compiler that logs the files that it compiles, and a cache of one's own."""
    program, log, hold = tmp_path / "cc", tmp_path / "log", tmp_path / "hold"
    program.write_text(COMPILER.format(log=log, hold=hold))
    program.chmod(0o755)
    monkeypatch.setenv("CC", str(program))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.delenv("CMAKE_C_COMPILER_LAUNCHER", raising=False)

    def calls():
        """Names of the files compiled since the last question."""
        found = [Path(line) for line in log.read_text().split()] if log.exists() else []
        log.unlink(missing_ok=True)
        return sorted(file.name for file in found)

    return SimpleNamespace(calls=calls, log=log, hold=hold)


@pytest.fixture
def core(tmp_path, compiler):
    """The core of a project of two files, for 9 balls."""
    sources = tmp_path / "project"
    for name, text in {
        "CMakeLists.txt": CMAKE,
        "fmus/generate.py": GENERATE,
        "fmu_src/a.c": '#include "variables.h"\nint a(void) { return Z; }\n',
        "fmu_src/b.c": "int b(void) { return 2; }\n",
    }.items():
        (sources / name).parent.mkdir(parents=True, exist_ok=True)
        (sources / name).write_text(text)
    return Core(sources, tmp_path / "build", 9, 40)


def entries():
    """Archives in the cache."""
    return sorted(cache_path("cores").glob("*.a"))


def until(condition):
    """Waits until the condition holds."""
    end = time.monotonic() + 60.0
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.02)


def compiles(core, file):
    """Whether the compiler has begun with a file."""
    return core.log.exists() and f"/{file}\n" in core.log.read_text()


# Only the core of the same balls, modes, sources, compiler and options is taken.


def test_compiled_once_for_each_number_of_balls(tmp_path, core, compiler):
    first = core.archive(quiet)
    assert compiler.calls() == ["a.c", "b.c"] and entries() == [first]
    assert Core(core.sources, tmp_path / "elsewhere", 9, 40).archive(quiet) == first
    assert compiler.calls() == []
    for sizes in ((10, 40), (9, 48)):
        other = Core(core.sources, tmp_path / "{}_{}".format(*sizes), *sizes).archive(quiet)
        assert compiler.calls() == ["a.c", "b.c"] and other != first
    assert core.archive(quiet) == first and len(entries()) == 3


def test_a_changed_source_is_compiled_again(core, compiler):
    """One of the sources, and a file that all depend on."""
    first = core.archive(quiet)
    before = (core.sources / "fmu_src" / "b.c").read_text()
    compiler.calls()
    (core.sources / "fmu_src" / "b.c").write_text("int b(void) { return 3; }\n")
    second = core.archive(quiet)
    assert compiler.calls() == ["b.c"] and second.read_bytes() != first.read_bytes()
    (core.sources / "fmu_src" / "b.c").write_text(before)
    assert core.archive(quiet) == first and compiler.calls() == []
    (core.sources / "CMakeLists.txt").write_text(CMAKE + "target_compile_options(core PRIVATE -O1)\n")
    assert core.archive(quiet) not in (first, second) and compiler.calls() == ["a.c", "b.c"]


def test_other_options_and_another_compiler_compile_again(tmp_path, core, compiler, monkeypatch):
    """In the same build folder, whose options CMake would keep."""
    kept = {core.archive(quiet)}
    compiler.calls()
    monkeypatch.setenv("CFLAGS", "-DUNUSED -O2")
    kept.add(core.archive(quiet))
    assert compiler.calls() == ["a.c", "b.c"] and len(kept) == 2
    assert "-DUNUSED -O2" in (core.folder / "build.ninja").read_text()
    newer = Path(shutil.copy(os.environ["CC"], tmp_path / "newer"))
    newer.write_text(newer.read_text().replace("exec", '[ "$1" = --version ] && echo "cc 99" && exit\nexec'))
    monkeypatch.setenv("CC", str(newer))
    kept.add(core.archive(quiet))
    assert compiler.calls() == ["a.c", "b.c"] and len(kept) == 3


# Never a part of it, whatever happens.


@pytest.mark.parametrize("damage", [lambda data: data[: len(data) // 2], lambda data: data[:-9] + b"x" + data[-8:]])
def test_a_damaged_archive_is_made_again(core, compiler, damage):
    archive = core.archive(quiet)
    whole = archive.read_bytes()
    archive.write_bytes(damage(whole))
    assert core.cached() is None
    assert core.archive(quiet).read_bytes() == whole
    shutil.rmtree(core.folder)
    archive.write_bytes(damage(whole))
    compiler.calls()
    assert core.archive(quiet).read_bytes() == whole and compiler.calls() == ["a.c", "b.c"]


def test_a_killed_build_leaves_nothing_wrong(core, compiler):
    """Killed while the compiler runs: the next build makes what one without such a past makes."""
    compiler.hold.touch()
    code = """import sys
from pathlib import Path
from riveted_bearing.building.core import Core
Core(Path(sys.argv[1]), Path(sys.argv[2]), 9, 40).archive(print)"""
    process = subprocess.Popen([sys.executable, "-c", code, core.sources, core.folder], cwd=ROOT)
    try:
        until(lambda: compiles(compiler, "a.c"))
    finally:
        process.send_signal(signal.SIGKILL)
        process.wait()
    assert entries() == []
    compiler.hold.unlink()
    after = core.archive(quiet).read_bytes()
    shutil.rmtree(core.folder)
    shutil.rmtree(cache_path("cores"))
    assert core.archive(quiet).read_bytes() == after


def test_two_at_once_compile_once(core, compiler):
    """The second waits, and finds the first one's."""
    said, found = [], []
    compiler.hold.touch()

    def make():
        found.append(core.archive(lambda text, share=None: said.append(text)))

    threads = [threading.Thread(target=make) for _ in range(2)]
    for thread in threads:
        thread.start()
    until(lambda: compiles(compiler, "a.c") and any("another build" in text for text in said))
    compiler.hold.unlink()
    for thread in threads:
        thread.join(60.0)
    assert found == entries() * 2 and compiler.calls() == ["a.c", "b.c"]


def test_what_fails_meanwhile_stops_the_compiler(core, compiler):
    """As a rivet table that cannot be made; the compiler, held, would never end."""
    compiler.hold.touch()

    def no_table():
        with core.compiling(quiet):
            until(lambda: compiles(compiler, "a.c"))
            raise UserError("no table")

    with pytest.raises(UserError, match="no table"):
        no_table()
    assert entries() == []
    compiler.hold.unlink()
    assert core.archive(quiet).is_file()


def test_sources_changed_while_they_are_compiled_are_not_kept(core):
    before = core.key
    with core.compiling(quiet):
        (core.sources / "fmu_src" / "b.c").write_text("int b(void) { return 4; }\n")
    assert entries() == []
    assert not core.archive(quiet).name.startswith(before)


def test_an_error_of_the_compiler_is_one_line(core):
    (core.sources / "fmu_src" / "b.c").write_text("int b(void) { return nothing; }\n")
    with pytest.raises(UserError, match=r"cmake failed: .*b\.c:1.*nothing") as caught:
        core.archive(quiet)
    assert "\n" not in str(caught.value) and entries() == []


# The real core.


@pytest.mark.slow  # a minute of compilation
def test_a_second_bearing_with_as_many_balls_links_only(fmu, tmp_path, compiler, monkeypatch):
    """The 6207 as `make build` makes it, byte for byte, then the 6205: nine balls, and of the core no file again."""
    archives = Path(os.environ.get("HOME", "")) / ".cache" / "riveted-bearing"
    for archive in archives.glob("*sundials*"):
        cache_path("").mkdir(parents=True, exist_ok=True)
        shutil.copy(archive, cache_path(""))
    monkeypatch.setattr(builder, "PACKAGE", tmp_path / "riveted_bearing")  # folders in the cache, not in the checkout
    build("6207", out=tmp_path / "named.fmu")
    assert len(compiler.calls()) > 100
    with contextlib.chdir(tmp_path):
        assert build(out=tmp_path / "6207.fmu").read_bytes() == fmu.read_bytes()
    assert set(compiler.calls()) == OWN
    build("6205", out=tmp_path / "6205.fmu", table="closed-form")
    assert set(compiler.calls()) == OWN
    assert len(entries()) == 1 and re.match("core_z09_40-", entries()[0].name)


OWN = {"variables.c", "rivet_table.c", "build_info.c"} | {file.name for file in (ROOT / "fmu_src" / "host").glob("*.c")}
