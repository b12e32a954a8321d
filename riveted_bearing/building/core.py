"""The compiled core of FMUs: all of their binary that depends on the number of balls and the room for modes, and on
nothing else of a bearing (target core of cmake/core.cmake).

One archive for each lies in the user's cache.  Its name says what it was compiled from and by, and the digest of its own
bytes, so that a damaged one is not used.  It is compiled in a folder of its own, where what did not change stays.
"""

from __future__ import annotations

import contextlib
import shutil
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Any

from ..base.files import cache_folder, cache_path, make_folder, write_atomically
from .compiler import alone_in, compile_command, configure, finish, generate, identity, start, stop

MAKERS = (
    "fmus/generate.py",
    "fmus/limits.py",
    "fmus/variables.toml",
    "fmus/templates/*.[ch]",
)  # of variables.h, limits.c
SOURCES = ("CMakeLists.txt", "cmake/*.[ch]*", "fmu_src/**/*.[ch]", *MAKERS)


@dataclass(frozen=True)
class Core:
    """The core for a number of balls and a room for modes, on one platform (None: this machine's compiler)."""

    sources: Path
    folder: Path  # of the build
    Z: int
    modes: int
    platform: str | None = None

    @property
    def key(self) -> str:
        """Name without the archive's own digest: balls, room for modes, and a digest of sources, compiler and options."""
        digest = sha256(identity(self.platform).encode())
        for file in sorted(path for pattern in SOURCES for path in self.sources.glob(pattern)):
            digest.update(f"{file.relative_to(self.sources).as_posix()} ".encode() + sha256(file.read_bytes()).digest())
        return f"core_z{self.Z:02}_{self.modes}-{digest.hexdigest()[:16]}"

    def cached(self) -> Path | None:
        """The archive in the cache, perhaps of another user who may write there; None if there is none that is whole."""
        for path in cache_path("cores").glob(f"{self.key}-*.a"):
            if path.stem.rpartition("-")[2] == sha256(path.read_bytes()).hexdigest():
                return path
        return None

    def archive(self, say: Any) -> Path:
        """The archive in the cache, compiled if it is not there."""
        while not (found := self.cached()):
            with self.compiling(say):
                pass
        return found

    @contextlib.contextmanager
    def compiling(self, say: Any) -> Iterator[None]:
        """Compiled beside what is done meanwhile, cached at the end; stopped if what is done meanwhile fails."""
        make_folder(self.folder)
        with alone_in(self.folder, say):
            if self.cached():
                yield
                return
            key, sizes = self.key, f"Z = {self.Z}\nmodes = {self.modes}\n"
            generated = generate(self.sources, self.folder, "sizes.toml", sizes, say)
            options = [f"-DGENERATED_DIR={generated}", f"-DPython_EXECUTABLE={sys.executable}", "-DPRECOMPILE=ON"]
            configure(self.sources, self.folder, options, self.platform, say)
            process = start(compile_command(self.folder, "core"))
            try:
                yield
                finish(process, self.folder, say)
            finally:
                stop(process)
            if key == self.key:  # no source was changed meanwhile
                self.store(key)

    def store(self, key: str) -> None:
        """Copy the archive into the cache."""
        made = self.folder / "core.a"
        digest = sha256(made.read_bytes()).hexdigest()
        kept = cache_folder("cores") / f"{key}-{digest}.a"
        write_atomically(kept, lambda temporary: shutil.copyfile(made, temporary))


@contextlib.contextmanager
def beside(cores: list[Core], say: Any) -> Iterator[None]:
    """The first of these cores that is not in the cache is compiled beside what is done meanwhile."""
    missing = next((core for core in cores if not core.cached()), None)
    with missing.compiling(say) if missing else contextlib.nullcontext():
        yield
