"""The rivet files of the C core as a shared library of their own: they need nothing else of the core."""

import re
import subprocess
import sys
from pathlib import Path

import cffi

ROOT = Path(__file__).resolve().parents[1]
HEADERS = ("rivet_rom.h", "load_path.h", "fatigue.h")
SOURCES = ("rivet_rom.c", "load_path.c", "fatigue.c")


def build(folder, table=ROOT / "rivet_model" / "tables" / "6207.json", extra="", declare=""):
    """Compile with the table embedded and `extra` C source; returns (ffi, lib)."""
    subprocess.run([sys.executable, "-m", "rivet_model.embed", str(table), str(folder / "rivet_table.c")], check=True, cwd=ROOT)
    files = [str(ROOT / "fmu_src" / name) for name in SOURCES] + [str(folder / "rivet_table.c")]
    if extra:
        (folder / "extra.c").write_text(extra, encoding="utf-8")
        files.append(str(folder / "extra.c"))
    library = folder / "librivet.so"
    flags = ["-std=c17", "-O3", "-ffp-contract=off", "-fPIC", "-shared", "-Wall", "-Wextra", "-Wpedantic", "-Werror"]
    subprocess.run(["cc", *flags, f"-I{ROOT / 'fmu_src'}", *files, "-o", str(library), "-lm"], check=True)
    ffi = cffi.FFI()
    ffi.cdef(f"enum {{ Z = {variables_z()} }}; typedef double number;")
    for name in HEADERS:
        text = (ROOT / "fmu_src" / name).read_text(encoding="utf-8")
        text = re.sub(r"//[^\n]*", "", text)
        ffi.cdef(re.sub(r"^#.*$", "", text, flags=re.MULTILINE).replace("bool ", "_Bool ").replace("extern const", "extern"))
    ffi.cdef(declare)
    return ffi, ffi.dlopen(str(library))


def variables_z():
    """Number of balls of the tracked variable table."""
    return int(re.search(r"enum \{ Z = (\d+) \}", (ROOT / "fmu_src" / "variables.h").read_text(encoding="utf-8")).group(1))
