"""Compilers and CMake: which there are, folders configured for them, targets compiled, what went wrong in one line."""

from __future__ import annotations

import contextlib
import importlib.util
import os
import platform as machine
import re
import shutil
import signal
import subprocess
import sys
import sysconfig
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from filelock import FileLock, Timeout

from ..base.errors import UserError, extra

PLATFORM_OF = {  # (system, machine) -> FMI's folder of binaries
    ("Linux", "x86_64"): "linux64",
    ("Linux", "aarch64"): "aarch64-linux",
    ("Windows", "AMD64"): "win64",
    ("Darwin", "x86_64"): "darwin64",
    ("Darwin", "arm64"): "aarch64-darwin",
}
OPTIONS = ("CFLAGS", "LDFLAGS", "CMAKE_BUILD_TYPE")  # of the environment, which CMake takes into a new build folder
STEP = re.compile(r"\[\s*(?:(\d+)/(\d+)|(\d+)%)\s*\]")  # Ninja's [3/40], make's [ 7%]


# ------------------------------------------------------------------------------------------------------------ compilers


def compilers() -> list[str]:
    """Names by which a C compiler is looked for."""
    return [os.environ["CC"].split()[0]] if os.environ.get("CC") else ["cc", "gcc", "clang"]


def has_compiler() -> bool:
    """Whether this machine has a C compiler of its own."""
    return any(map(shutil.which, compilers()))


def compiler_platforms() -> tuple[str, ...]:
    """Platforms if the user names none: () with a C compiler, this machine's with zig; else UserError."""
    if has_compiler():
        return ()
    if find_zig(needed=False):
        return (PLATFORM_OF[machine.system(), machine.machine()],)
    raise UserError(
        f"no C compiler ({', '.join(compilers())}) found: install one, or zig, which is one: {extra('cross')}"
    )


def identity(platform: str | None = None) -> str:
    """What compiles for a platform (None: this machine): program, version and options; UserError without it."""
    if platform:
        return f"{zig_version()} {platform}"
    program = next(filter(None, map(shutil.which, compilers())), None) or compiler_platforms()
    version = subprocess.run([str(program), "--version"], capture_output=True, text=True, check=False).stdout
    given = [f"{name}={os.environ.get(name, '')}" for name in ("CC", *OPTIONS)]
    return "\n".join([str(program), version, machine.machine(), *given])


def zig_version() -> str:
    """Name and version of zig, for the FMU's bill of materials."""
    return f"zig {subprocess.run([find_zig(), 'version'], capture_output=True, text=True, check=True).stdout.strip()}"


def find_zig(needed: bool = True) -> Any:
    """Path of zig: of the Python package, else on the search path; else UserError, or None if not needed."""
    package = importlib.util.find_spec("ziglang")
    places = package.submodule_search_locations if package else None
    found = (places and shutil.which("zig", path=places[0])) or shutil.which("zig")
    if not found and needed:
        raise UserError(f"zig not found, which compiles for other platforms: {extra('cross')}")
    return found


# ---------------------------------------------------------------------------------------------------------------- CMake


def tool(name: str) -> str | None:
    """A program beside this Python or on the path; None if there is none."""
    return shutil.which(name, path=sysconfig.get_path("scripts")) or shutil.which(name)


def cmake() -> str:
    """CMake's path; UserError if there is none."""
    found = tool("cmake")
    if not found:
        raise UserError("cmake not found: `pip install cmake`, or install it with the system's packages")
    return found


def configure(sources: Path, folder: Path, options: Sequence[str], platform: str | None, say: Any) -> None:
    """Configure a build folder for a platform (None: this machine's compiler); from nothing after another compiler or options
    of it, which CMake would not notice.
    """
    say("configuring (the first time fetches SUNDIALS)")
    stamp, compiler = folder / "compiler.txt", identity(platform)
    known = stamp.is_file() and stamp.read_text(encoding="utf-8") == compiler
    fresh = [] if known else ["--fresh"]
    stamp.unlink(missing_ok=True)
    execute(
        [cmake(), *fresh, "-S", sources, "-B", folder, *generator(folder), *toolchain(sources, platform), *options],
        folder,
        say,
    )
    stamp.write_text(compiler, encoding="utf-8")


def generate(sources: Path, folder: Path, name: str, text: str, say: Any) -> Path:
    """Write what fmus/generate.py reads as a file of a build folder, and run it; the folder of its variables."""
    (folder / name).write_text(text, encoding="utf-8")
    generated, program = folder / "generated", sources / "fmus" / "generate.py"
    execute([sys.executable, program, "--bearing", folder / name, "--out", generated], folder, say)
    return generated


def toolchain(sources: Path, platform: str | None) -> list[str]:
    """Options of CMake to compile for a platform with zig."""
    if not platform:
        return []
    file = sources / "cmake" / "zig.cmake"
    return [f"-DCMAKE_TOOLCHAIN_FILE={file}", f"-DPLATFORM={platform}", f"-DZIG={find_zig()}"]


def generator(folder: Path) -> list[str]:
    """Ninja if it is there, except in a folder that was configured without."""
    ninja = tool("ninja")
    return ["-G", "Ninja", f"-DCMAKE_MAKE_PROGRAM={ninja}"] if ninja and not (folder / "Makefile").is_file() else []


def compile_command(folder: Path, target: str) -> list[Any]:
    """The command that builds a target in a configured folder."""
    return [cmake(), "--build", folder, "--target", target, "--parallel", str(min(os.cpu_count() or 1, 8))]


def compile_target(
    sources: Path, folder: Path, options: Sequence[str], target: str, say: Any, platform: str | None = None
) -> None:
    """Configure and build one target."""
    configure(sources, folder, options, platform, say)
    say("compiling")
    execute(compile_command(folder, target), folder, say)


# ------------------------------------------------------------------------------------------------------------- programs


@contextlib.contextmanager
def alone_in(folder: Path, say: Any) -> Iterator[None]:
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


def execute(command: Sequence[Any], folder: Path, say: Any) -> None:
    """Run one program of the build, its output in BUILD/build.log; UserError with the first error lines if it fails."""
    process = start(command)
    try:
        finish(process, folder, say)
    finally:
        stop(process)


def start(command: Sequence[Any]) -> subprocess.Popen[str]:
    """Start a program of the build, all its children in a group of their own."""
    return subprocess.Popen(
        [str(part) for part in command],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        start_new_session=True,
    )


def finish(process: subprocess.Popen[str], folder: Path, say: Any) -> None:
    """Wait for a program, as execute."""
    lines = []
    for line in process.stdout or ():
        lines.append(line)
        if match := STEP.match(line):
            done, of, percent = match.groups()
            say("compiling", int(percent) / 100 if percent else int(done) / int(of))
    (folder / "build.log").write_text("".join(lines))
    if process.wait():
        program = Path(str(process.args[0])).name  # type: ignore[index]
        raise UserError(f"{program} failed: {essence(lines)} (all of it in {folder / 'build.log'})")


def stop(process: subprocess.Popen[str]) -> None:
    """End a program that still runs, with its children."""
    if process.poll() is None:
        if hasattr(os, "killpg"):
            os.killpg(process.pid, signal.SIGTERM)
        else:
            process.terminate()
    if process.stdout:
        process.stdout.close()
    process.wait()


def essence(lines: list[str]) -> str:
    """The lines that tell the cause: the first error and the two lines after it, else the last three lines."""
    lines = [line.strip() for line in lines if line.strip() and not STEP.match(line)]
    first = next(
        (i for i, line in enumerate(lines) if re.search(r"\berror\b|^generate:|^rivet table:", line, re.IGNORECASE)),
        max(len(lines) - 3, 0),
    )
    return " ".join(lines[first : first + 3])
