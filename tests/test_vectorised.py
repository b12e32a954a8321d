"""The kernels keep their vectors: arithmetic of the kernels' objects counted by disassembly, packed and as wide as the
instruction set, against scalar.

A packet's arithmetic must be packed; what remains scalar belongs to bodies of which there is one (cage, joint frame) or
sums over the balls. Losing the vectors (wrong options, a member that the compiler takes apart, code per ball) halves
the speed without a warning and without a wrong number.
"""

import json
import re
import shutil
import subprocess

import pytest
from library import ROOT

OBJECTS = ROOT / "build" / "CMakeFiles"
REGISTER = {"sse2": "xmm", "avx2": "ymm", "avx512": "zmm"}
# Least share of full-width packed instructions in the arithmetic; observed 0.954...0.973, 0.92...0.95, 0.97...0.99,
# 0.45...0.68
# The growth of the ring in race_contact is one number a bearing, and scalar.
LEAST = {"race_contact": 0.95, "pocket": 0.85, "ball": 0.95, "cage_joint": 0.4}
ARITHMETIC = re.compile(r"\sv?(?:add|sub|mul|div|sqrt|max|min|fn?m(?:add|sub)\d{3})([ps])d\s+(\S.*)$")


@pytest.fixture(scope="module")
def commands():
    """Compile commands by object, of an optimised x86-64 build."""
    entries = json.loads((ROOT / "build" / "compile_commands.json").read_text())
    table = {entry["output"]: entry["command"] for entry in entries}
    if not any("kernel_sse2" in name for name in table):
        pytest.skip("no x86-64 build")
    if any("-fsanitize" in command for command in table.values()):
        pytest.skip("a build with sanitizers is not optimised")
    assert shutil.which("objdump"), "objdump is missing: install binutils"
    return table


def objects(isa):
    """The objects of an instruction set's kernels by the names of their elements."""
    folder = OBJECTS / f"kernel_{isa}.dir" / "fmu_src"
    return {path.name.removesuffix(".c.o"): path for path in sorted(folder.rglob("*.c.o"))}


def disassembly(path):
    return subprocess.run(
        ["objdump", "-d", "--no-show-raw-insn", str(path)], capture_output=True, text=True, check=True
    ).stdout


def packed_share(path, register):
    """Share of the object's arithmetic instructions that are packed and use whole registers of this kind, and their
    number.
    """
    found = [match.groups() for match in map(ARITHMETIC.search, disassembly(path).splitlines()) if match]
    whole = sum(kind == "p" and register in operands for kind, operands in found)
    return whole / max(len(found), 1), len(found)


@pytest.mark.parametrize("isa", REGISTER)
@pytest.mark.parametrize("element", LEAST)
def test_arithmetic_is_packed(commands, element, isa):
    share, count = packed_share(objects(isa)[element], REGISTER[isa])
    assert count > 50, f"{element}: only {count} arithmetic instructions found, the count itself is broken"
    assert share >= LEAST[element], (
        f"{element} for {isa}: {100 * share:.0f} % of {count} arithmetic instructions are packed"
    )


def test_loss_is_seen(commands, tmp_path):
    """The same element with packets of four compiled without AVX: half-width registers, as after a lost option."""
    command = next(text for name, text in commands.items() if name.endswith("kernel_avx2.dir/fmu_src/physics/ball.c.o"))
    words = [word for word in command.split() if word not in ("-mavx2", "-mfma")]
    words[words.index("-o") + 1] = str(tmp_path / "lost.o")
    subprocess.run([*words, "-Wno-psabi"], check=True, cwd=ROOT / "build")
    share, _ = packed_share(tmp_path / "lost.o", REGISTER["avx2"])
    assert share < LEAST["ball"]


@pytest.mark.parametrize("isa", ["avx2", "avx512"])
def test_only_written_sums_are_fused(commands, isa):
    """No fmaddsub, which the source cannot ask for: GCC makes it of a b - c d beside a b + c d, against its options;
    other compilers round these otherwise.
    """
    texts = {name: disassembly(path) for name, path in objects(isa).items()}
    assert "vfmadd" in texts["race_contact"]  # what wide_fma is
    assert not [name for name, text in texts.items() if re.search("vfmaddsub|vfmsubadd", text)]
