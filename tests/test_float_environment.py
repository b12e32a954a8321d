"""Every function of both FMUs in every floating-point environment that a host may have: the same bits, the host's
environment as before, no signal.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import fmpy
import lief
import pytest
from library import ROOT
from reference_results import native_binary
from slave import describe

HEADERS = Path(fmpy.__file__).parent / "c-code"
SOURCE = Path(__file__).with_name("float_host.c")
PROCESSORS = ("x86_64", "AMD64", "aarch64", "arm64")
SANITIZED = "asan" in os.environ.get("LD_PRELOAD", "")  # make sanitize
EXACT_FUNCTIONS = 44  # of FMI 2.0, for model exchange and co-simulation
# Scenes by parameters: the start values; and what computes most, with a joint that is always at its limit.
SCENES = {
    "RivetedBearing": ({}, {"joint.preload": 0.0, "start.settle": 0.0, "scene.stress": 4, "scene.lubrication": 2}),
    "Shaft": ({},),
}
INPUT = {"RivetedBearing": "shaft.F_x", "Shaft": "gear.M"}
CASES = [(name, i) for name in SCENES for i in range(len(SCENES[name]))]


def script(folder, changes):
    """What float_host reads: GUID, outputs, an input, Integer and Real parameters with values."""
    description = describe(folder)
    variables = {v.name: v for v in description.modelVariables}
    outputs = [v.valueReference for v in variables.values() if v.causality == "output"]
    integers = {name: value for name, value in changes.items() if variables[name].type != "Real"}
    reals = {name: value for name, value in changes.items() if variables[name].type == "Real"}
    words = [description.guid, len(outputs), *outputs, variables[INPUT[description.modelName]].valueReference]
    for values in (integers, reals):
        words += [
            len(values),
            *(word for name, value in values.items() for word in (variables[name].valueReference, value)),
        ]
    return " ".join(map(str, words))


def table(command, text, **options):
    """Rows of float_host by mode and function: (calls, environments changed, messages in another environment, digest)."""
    modes = subprocess.run([*command, "modes"], capture_output=True, text=True, check=True, **options).stdout.split()
    rows = {}
    for mode in modes:
        done = subprocess.run([*command, mode], input=text, capture_output=True, text=True, check=False, **options)
        assert done.returncode == 0, (mode, done.returncode, done.stderr)
        rows[mode] = {
            name: (*map(int, counts), digest) for name, *counts, digest in map(str.split, done.stdout.splitlines())
        }
    return rows


def check(rows, exported):
    """All functions in all modes; each mode is another environment, so the comparison says something."""
    assert {"default", "traps", "down", "up", "zero", "flushed", "all"} <= set(rows)
    for mode, functions in rows.items():
        assert set(functions) == exported, mode
        for name, (calls, changed, elsewhere, digest) in functions.items():
            assert calls > 0, (mode, name)
            assert (changed, elsewhere) == (0, 0), (mode, name)
            assert digest == rows["default"][name][-1], (mode, name)
    assert len({functions["fmi2GetReal"][-1] for functions in rows.values()}) == 1


def exported_functions(library):
    """Names of the FMI functions of a binary with their addresses."""
    functions = {
        symbol.name.removeprefix("_"): symbol.address for symbol in lief.parse(str(library)).exported_functions
    }
    return {name: address for name, address in functions.items() if name.startswith("fmi2")}


def unpacked(name, tmp_path_factory):
    path = ROOT / "fmus" / f"{name}.fmu"
    assert path.is_file(), f"{path} is missing: make build"
    folder = Path(fmpy.extract(str(path), str(tmp_path_factory.mktemp(name))))
    native_binary(folder)
    return folder


@pytest.fixture(scope="module")
def folders(tmp_path_factory):
    """Both FMUs, unpacked."""
    return {name: unpacked(name, tmp_path_factory) for name in SCENES}


def library_of(folder):
    return folder / "binaries" / fmpy.platform / f"{describe(folder).modelName}{fmpy.sharedLibraryExtension}"


@pytest.mark.skipif(
    os.name != "posix" or os.uname().machine not in PROCESSORS,
    reason="sets control registers of x86-64 or AArch64 under Unix",
)
@pytest.mark.parametrize(("name", "scene"), CASES)
def test_every_function_in_every_environment(folders, tmp_path, name, scene):
    host = tmp_path / "float_host"
    subprocess.run(
        ["cc", "-std=c17", "-O1", "-Wall", "-Wextra", "-Werror", f"-I{HEADERS}", str(SOURCE), "-o", str(host), "-ldl"],
        check=True,
    )
    library = library_of(folders[name])
    rows = table([host, library], script(folders[name], SCENES[name][scene]))
    check(rows, set(exported_functions(library)))


# ---------------------------------------------------------------------------------------------------- in the built code


class Code:
    """The instructions of an FMU's exported functions; capstone reads them, so that binaries that cannot run here are
    checked too.
    """

    def __init__(self, library):
        capstone = pytest.importorskip("capstone")
        self.binary = lief.parse(str(library))
        self.functions = exported_functions(library)
        kind = str(self.binary.abstract.header.architecture).rsplit(".", 1)[-1]
        self.arm = kind == "ARM64"
        self.engine = capstone.Cs(
            *(
                (capstone.CS_ARCH_ARM64, capstone.CS_MODE_ARM)
                if self.arm
                else (capstone.CS_ARCH_X86, capstone.CS_MODE_64)
            )
        )
        self.base = 0 if self.binary.format == lief.Binary.FORMATS.ELF else self.binary.imagebase

    def instructions(self, start, size=4096):
        """Instructions by address, from a function's first one on."""
        content = bytes(self.binary.get_content_from_virtual_address(start, size))
        return {one.address: one for one in self.engine.disasm(content, start)}

    def is_read(self, one):
        return one.mnemonic == "mrs" and "fpcr" in one.op_str.lower() if self.arm else one.mnemonic == "stmxcsr"

    def is_write(self, one):
        return one.mnemonic == "msr" and "fpcr" in one.op_str.lower() if self.arm else one.mnemonic == "ldmxcsr"

    def is_call(self, one):
        return one.mnemonic in (("bl", "blr") if self.arm else ("call",))

    def is_return(self, one):
        return one.mnemonic in ("ret", "retab", "retaa")

    def target(self, one):
        """Of a jump within or out of the function; None for other instructions."""
        jump = (
            one.mnemonic in ("b", "cbz", "cbnz", "tbz", "tbnz", "br") or one.mnemonic.startswith("b.")
            if self.arm
            else one.mnemonic.startswith("j")
        )
        if not jump:
            return None
        last = one.op_str.split(",")[-1].strip().removeprefix("#")
        return int(last, 0) if last.startswith("0x") else -1  # -1: to where a register points

    def falls_through(self, one):
        return one.mnemonic not in (("b", "br") if self.arm else ("jmp",))


OUTSIDE, INSIDE, CALLED, LEFT = range(4)


def guard_problems(code, start):
    """What is wrong with a function on any way through it: a call before its environment is read, a return before the
    host's is given back.
    """
    instructions = code.instructions(start)
    problems, writes = set(), 0
    seen, waiting = set(), [(start, OUTSIDE)]
    while waiting:
        address, place = waiting.pop()
        if (address, place) in seen:
            continue
        seen.add((address, place))
        one = instructions.get(address)
        target = None if one is None else code.target(one)
        leaves = one is None or (target is not None and target not in instructions)
        if one is None:
            problems.add("leaves its code")
            continue
        if code.is_return(one):
            if place not in (OUTSIDE, LEFT):
                problems.add("returns in the core's environment")
            continue
        if code.is_call(one) or leaves:
            if place in (OUTSIDE, LEFT):
                problems.add("calls in the host's environment")
            place = CALLED
        if code.is_read(one):
            place = INSIDE if place == OUTSIDE else LEFT if place == CALLED else place
        if target is not None and not leaves:
            waiting.append((target, place))
        if (target is None or code.falls_through(one)) and not (leaves and not code.falls_through(one)):
            waiting.append((address + one.size, place))
    writes = len({address for address, _ in seen if address in instructions and code.is_write(instructions[address])})
    called = any(place == CALLED for _, place in seen)
    if called and writes < 2:
        problems.add("does not set both environments")
    return problems


def check_code(library):
    """Each exported function makes its environment before its first call and gives the host's back after its last one;
    two only return a text.
    """
    code = Code(library)
    assert len(code.functions) == EXACT_FUNCTIONS
    assert {
        name: found for name, address in code.functions.items() if (found := guard_problems(code, code.base + address))
    } == {}
    calling = {
        name
        for name, address in code.functions.items()
        if any(map(code.is_read, function_body(code, code.base + address)))
    }
    assert set(code.functions) - calling == {"fmi2GetTypesPlatform", "fmi2GetVersion"}


def function_body(code, start):
    """Instructions up to the first return."""
    for one in code.instructions(start).values():
        yield one
        if code.is_return(one):
            return


@pytest.mark.skipif(SANITIZED, reason="sanitizers call their own functions everywhere")
@pytest.mark.parametrize("name", SCENES)
def test_every_exported_function_has_the_guard(folders, name):
    """Fails for a function that is exported without it: see below for one."""
    check_code(library_of(folders[name]))


@pytest.mark.skipif(os.name != "posix" or os.uname().machine != "x86_64", reason="compiles for this machine")
@pytest.mark.skipif(
    SANITIZED,
    reason="capstone opens its library in a way (RTLD_DEEPBIND) at which the address sanitizer ends the process",
)
def test_a_function_without_the_guard_is_found(tmp_path):
    source, library = tmp_path / "bare.c", tmp_path / "bare.so"
    source.write_text("double other(double);\ndouble fmi2Bare(double x) { return 2.0 * other(x); }\n")
    subprocess.run(["cc", "-O2", "-shared", "-fPIC", str(source), "-o", str(library)], check=True)
    code = Code(library)
    assert guard_problems(code, code.functions["fmi2Bare"]) >= {
        "calls in the host's environment",
        "returns in the core's environment",
    }


# -------------------------------------------------------------------------------------------------------- other systems


@pytest.mark.slow
@pytest.mark.parametrize("platform", ["linux64", "win64", "darwin64", "aarch64-darwin"])
def test_every_exported_function_of_other_systems_has_the_guard(everywhere, platform):
    suffix = {"linux64": ".so", "win64": ".dll"}.get(platform, ".dylib")
    for folder in everywhere.values():
        check_code(folder / "binaries" / platform / f"{describe(folder).modelName}{suffix}")


@pytest.mark.slow
@pytest.mark.parametrize(("name", "scene"), CASES)
def test_every_function_in_every_environment_of_windows(everywhere, wine, tmp_path, name, scene):
    host = tmp_path / "float_host.exe"
    zig = [sys.executable, "-m", "ziglang", "cc", "-target", "x86_64-windows-gnu"]
    subprocess.run(
        [*zig, "-std=c17", "-O1", "-Wall", "-Wextra", "-Werror", f"-I{HEADERS}", str(SOURCE), "-o", str(host)],
        check=True,
    )
    folder = everywhere[name]
    library = folder / "binaries" / "win64" / f"{name}.dll"
    shutil.copy(library, tmp_path)
    rows = table(
        [*wine.command, host, library.name], script(folder, SCENES[name][scene]), env=wine.environment, cwd=tmp_path
    )
    check(rows, set(exported_functions(library)))
