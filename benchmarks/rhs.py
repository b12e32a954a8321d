"""Cost of one evaluation of the right-hand side per instruction set, element by element, with the processor's floor
beside it.

States are those of settled runs, in turn.  Elements are timed one by one, so their sum is not exactly the whole.
Instructions are counted by single steps of a child process and named by disassembly.  The floor takes the measured
times of independent instructions on this processor: arithmetic and loads run side by side, division and root on a unit
of their own, so no evaluation with these instructions can take less than the largest of the three.
"""

import collections
import re
import subprocess

import numpy as np
from common import SCENES, Core, Scene, build_target, options, say, write

from bearing_model.generated import variables

ELEMENT_NAMES = (
    "ball kinematics",
    "race contacts",
    "pockets",
    "ball drag",
    "land films",
    "cage drag",
    "joint kinematics",
    "joints",
    "ball accelerations",
    "ring acceleration",
)
PEAKS = ("arithmetic", "load", "divide", "root")
LANES = {"scalar": 1, "sse2": 2, "generic": 2, "neon": 2, "avx2": 4, "avx512": 8}
FUSED = r"fn?m(?:add|sub)\d{3}"
ARITHMETIC = re.compile(rf"^v?(add|sub|mul|max|min|{FUSED})[sp]d$")
DIVIDE, ROOT = re.compile(r"^v?div[sp]d$"), re.compile(r"^v?sqrt[sp]d$")
DECLARATIONS = """
double rhs_time_{isa}(const Model *, int, const double *, int, Work *);
void element_times_{isa}(const Model *, const double *, int, Work *, double *);
void peak_times_{isa}(long, double *);
"""


def instruction_sets(core):
    """Those that are built and that this processor has, scalar first."""
    best = core.ffi.string(core.lib.kernels_select().name).decode()
    if best in ("neon", "generic"):
        return ("scalar", best)
    return ("scalar", "sse2", "avx2", "avx512")[: {"sse2": 2, "avx2": 3, "avx512": 4}[best]]


def settled_states(scene, core, count):
    """States after settling, 37 us apart (no simple fraction of a ball pass)."""
    instance = scene.start(core, scene_stress=1, scene_statistics=1).step(scene.settle)
    return np.array([instance.step(scene.settle + (i + 1) * 37e-6).y for i in range(count)])


def timing(core, model, isa, y, rounds):
    """Least times of several repeats [ns]: the whole evaluation and each element."""
    whole = min(
        getattr(core.lib, f"rhs_time_{isa}")(model.pointer, len(y), core.array(y), rounds, model.work) for _ in range(7)
    )
    elements, ns = [], np.empty(len(ELEMENT_NAMES))
    for state in y[:: max(1, len(y) // 16)]:
        repeats = []
        for _ in range(5):
            getattr(core.lib, f"element_times_{isa}")(
                model.pointer, core.array(state.copy()), 40 * rounds, model.work, core.array(ns)
            )
            repeats.append(ns.copy())
        elements.append(np.min(repeats, axis=0))
    return {"rhs": whole, "elements": dict(zip(ELEMENT_NAMES, np.mean(elements, axis=0)))}


def peaks(core, isa):
    """Time of one instruction among independent ones [ns]."""
    ns, best = np.empty(len(PEAKS)), np.full(len(PEAKS), np.inf)
    for _ in range(9):
        getattr(core.lib, f"peak_times_{isa}")(200_000, core.array(ns))
        best = np.minimum(best, ns)
    return dict(zip(PEAKS, best))


# --------------------------------------------------------------------------------------------------------- instructions


def disassembly(library):
    """Offset -> (function, mnemonic, operands) of all instructions."""
    text = subprocess.run(
        ["objdump", "-d", "--no-show-raw-insn", str(library)], capture_output=True, text=True, check=True
    ).stdout
    table, function = {}, ""
    for line in text.splitlines():
        if match := re.match(r"^[0-9a-f]+ <(.*)>:$", line):
            function = match[1]
        elif match := re.match(r"^ *([0-9a-f]+):\s+(\S+)\s*(.*)$", line):
            table[int(match[1], 16)] = (function, match[2], match[3])
    return table


def base_address(library):
    """Where the library lies in this process."""
    with open("/proc/self/maps") as maps:
        return min(int(line.partition("-")[0], 16) for line in maps if line.rstrip().endswith(library.name))


def instructions(core, library, table, model, isa, y):
    """Mean counts of instructions by kind over states; None where single steps are not possible."""
    core.ffi.cdef(
        "long trace_rhs(void *, const Model *, const double *, Work *, unsigned long *, long);", override=True
    )
    function, addresses = core.ffi.addressof(core.lib, f"rhs_{isa}"), np.empty(200_000, dtype=np.uint64)
    counts = collections.Counter()
    for state in y:
        pointer = core.ffi.cast("unsigned long *", core.ffi.from_buffer(addresses))
        count = core.lib.trace_rhs(
            function, model.pointer, core.array(state.copy()), model.work, pointer, len(addresses)
        )
        if count <= 0:
            return None
        base = base_address(library)
        for address in addresses[:count]:
            found = table.get(int(address) - base)
            if found is None or found[0] in ("trace", "call_rhs") or "@plt" in found[0]:
                continue  # around the call; libc's memcpy and memset
            counts.update(kinds(*found[1:]))
    return {kind: number / len(y) for kind, number in counts.items()}


def kinds(mnemonic, operands):
    """What one instruction counts as."""
    result = ["instructions"]
    packed = mnemonic.endswith("pd")
    width = 8 if "%zmm" in operands else 4 if "%ymm" in operands else 2
    for name, pattern in (("arithmetic", ARITHMETIC), ("divide", DIVIDE), ("root", ROOT)):
        if pattern.match(mnemonic):
            result += [name, f"{name}_packed"] if packed else [name]
            result += ["flops"] * (width if packed else 1) * (2 if re.match(f"v{FUSED}", mnemonic) else 1)
    if "(" in operands and not mnemonic.startswith(("lea", "nop", "prefetch", "cmp", "test")):
        result.append("stores" if operands.endswith(")") else "loads")
    return result


def floor(counts, peak):
    """Shortest time of these instructions at the peaks of the processor [ns]."""
    parts = {
        "arithmetic": counts.get("arithmetic", 0) * peak["arithmetic"],
        "load": counts.get("loads", 0) * peak["load"],
        "divide_root": counts.get("divide", 0) * peak["divide"] + counts.get("root", 0) * peak["root"],
    }
    return parts | {"floor": max(parts.values())}


def main():
    short = options(__doc__).short
    library = build_target("bearing_kernels")
    core = Core.load(library)
    sets = instruction_sets(core)
    core.ffi.cdef("void rhs_scalar(const Model *, double, const double *, double *, Work *);")
    for isa in sets:
        core.ffi.cdef(DECLARATIONS.format(isa=isa))
    table, scenes = disassembly(library), {}
    for name in ("demo", "jam") if short else SCENES:
        scene = Scene(name)
        y = settled_states(scene, core, 32 if short else 128)
        model = core.model(scene.parameters, scene.inputs)
        touched = []
        for state in y:
            model.rhs(0.0, state)
            touched.append(sum(Q > 0.0 for h in range(2) for Q in list(model.work.pocket[h].Q)[: variables.Z]))
        rows = {}
        for isa in sets:
            rows[isa] = timing(core, model, isa, y, 50 if short else 200)
            if counts := instructions(core, library, table, model, isa, y[:8]):
                rows[isa] |= {"counts": counts, "floor": floor(counts, peaks(core, isa))}
            say(
                f"{name} {isa}: {rows[isa]['rhs']:.0f} ns, floor {rows[isa].get('floor', {}).get('floor', float('nan')):.0f} ns"
            )
        scenes[name] = {"title": scene.title, "pockets_touched": float(np.mean(touched)), "sets": rows}
    write("rhs", {"peaks": {isa: peaks(core, isa) for isa in sets}, "lanes": LANES, "scenes": scenes}, short)


if __name__ == "__main__":
    main()
