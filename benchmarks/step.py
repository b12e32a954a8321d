"""Instructions of a step by element, with the processor's floor beside them.

Communication steps of 1e-4 s with peak stress and statistics are run instruction by instruction in a child process and
counted by the source file of their function (what the compiler inlines from a header counts where it is used).  Counts
are per accepted step, rejected ones included.  For the floor see rhs.py.
"""

import collections
import re
import subprocess
from bisect import bisect_right

import numpy as np
from common import BUILD, Core, Scene, build_target, counters, cpu, options, say, write
from rhs import base_address, disassembly, floor, instruction_sets, kinds, peaks

from bearing_model.generated.variables import CageModel, Stress, Switch

STEP = 1e-4  # [s]
CAGES = CageModel.ELASTIC, CageModel.TWO_HALF  # the default first
PARTS = {  # source file -> part
    "race_contact": "race contacts",
    "pocket": "pockets",
    "pocket_spheres": "pockets",
    "pocket_squeeze": "pockets",
    "spheres_squeeze": "pockets",
    "land_film": "land films",
    "land_bent": "land films",
    "cage_joint": "joints",
    "two_half": "joints",
    "cage": "cage bodies, sums",
    "halves": "cage bodies, sums",
    "films": "cage bodies, sums",
    "cage_elastic": "elastic halves: modes, pads, law of the joints",
    "cage_substeps": "elastic halves: substeps",
    "elastic_wall": "elastic halves: walls of the pockets",
    "wall_loads": "elastic halves: walls of the pockets",
    "elastic_lands": "elastic halves: films on the rivets",
    "rim_films": "elastic halves: substeps",
    "ball": "balls: kinematics, accelerations",
    "drag": "drag",
    "ring": "ring",
    "ring_load": "ring",
    "ring_fit": "ring",
    "rhs": "cage bodies, sums",
    "implicit": "implicit solve",
    "verlet": "Verlet step itself",
    "half_path": "rivet loads",
    "joint_law": "rivet loads",
    "joint_open": "rivet loads",
    "joint_slip": "rivet loads",
    "cage_read": "rivet loads",
    "rivet_rom": "rivet table",
    "bearing": "peaks and statistics",
    "outputs_recorded": "peaks and statistics",
    "statistics": "peaks and statistics",
}
REST, OUTSIDE = "control of steps, inputs", "memcpy, memset, clock"


def lines(*command):
    return subprocess.run(
        [str(word) for word in command], capture_output=True, text=True, check=True
    ).stdout.splitlines()


def sources(library):
    """Starts of the functions in order, and (end, source file) of each: local symbols follow their file's, global ones
    are found in the objects.
    """
    defined = {}
    for path in BUILD.glob("CMakeFiles/*.dir/fmu_src/**/*.c.o"):
        defined |= {
            line.split()[2]: path.name.removesuffix(".c.o")
            for line in lines("nm", "--defined-only", path)
            if " T " in line
        }
    functions, file = {}, ""
    for line in lines("readelf", "-sW", library):
        match = re.match(r"\s*\d+: ([0-9a-f]+)\s+(\S+) (FILE|FUNC)\s+(LOCAL|GLOBAL|WEAK)\s+\S+\s+\S+ (\S+)", line)
        if match and match[3] == "FILE":
            file = match[5].removesuffix(".c")
        elif match and int(match[2], 0) > 0:
            begin = int(match[1], 16)
            functions[begin] = (begin + int(match[2], 0), file if match[4] == "LOCAL" else defined.get(match[5], ""))
    starts = sorted(functions)
    return starts, [functions[start] for start in starts]


def part_of(offset, starts, functions):
    """Which part an instruction belongs to."""
    i = bisect_right(starts, offset) - 1
    inside = i >= 0 and offset < functions[i][0]
    return PARTS.get(functions[i][1], REST) if inside else OUTSIDE


def declare(core):
    core.ffi.cdef("long trace_step(struct Part *, double, unsigned long *, long);", override=True)
    return core


def moving(scene, cage, core):
    """A settled instance with peak stress and statistics."""
    return scene.start(core, scene_cage=int(cage), scene_stress=int(Stress.PEAK), scene_statistics=int(Switch.ON)).step(
        scene.settle
    )


def instructions(scene, cage, core, library, samples):
    """Counts by part and kind per accepted step, over some communication steps 3.7 ms apart."""
    table, (starts, functions), base = disassembly(library), sources(library), base_address(library)
    instance, addresses, steps = moving(scene, cage, core), np.empty(20_000_000, dtype=np.uint64), 0.0
    pointer = core.ffi.cast("unsigned long *", core.ffi.from_buffer(addresses))
    counts = collections.defaultdict(collections.Counter)
    for i in range(samples):
        instance.step(scene.settle + 3.7e-3 * (i + 1))
        t, before = instance.time + STEP, counters(instance)["steps"]
        found = core.lib.trace_step(instance.bearing, t, pointer, len(addresses))
        if found <= 0:
            raise SystemExit(f"{scene.name}: no single steps of a child process here ({found})")
        for address, number in zip(*np.unique(addresses[:found], return_counts=True)):
            offset = int(address) - base
            row = counts[part_of(offset, starts, functions)]
            for kind in kinds(*table[offset][1:]) if offset in table else ["instructions"]:
                row[kind] += int(number)
        steps += counters(instance.step(t))["steps"] - before
    return {part: {kind: number / steps for kind, number in row.items()} for part, row in counts.items()}


def time_of_step(scene, cage, core, length, repeat):
    """Least processor time of an accepted step [ns], and steps and evaluations per second."""
    best = np.inf
    for _ in range(repeat):
        instance = moving(scene, cage, core)
        before = counters(instance)
        seconds, _ = cpu(
            lambda instance=instance: [
                instance.step(scene.settle + (i + 1) * STEP) for i in range(round(length / STEP))
            ]
        )
        done = {name: (value - before[name]) / length for name, value in counters(instance).items()}
        best = min(best, 1e9 * seconds / (done["steps"] * length))
    return {"ns": best} | done


def measure(scene, cage, core, library, peak, short):
    """A row of the record: steps, time and counts of a scene with one model of the cage."""
    row = time_of_step(scene, cage, core, 0.02 if short else 0.1, 5)
    parts = instructions(scene, cage, core, library, 2 if short else 8)
    whole = sum(map(collections.Counter, parts.values()), collections.Counter())
    row |= {"title": scene.title, "counts": whole, "floor": floor(whole, peak)}
    say(
        f"{scene.name}, {cage.name.lower()}: {row['ns']:.0f} ns a step, {whole['instructions']:.0f} instructions, floor {row['floor']['floor']:.0f} ns"
    )
    return row | {
        "parts": {part: {"counts": counts, "floor": floor(counts, peak)["floor"]} for part, counts in parts.items()}
    }


def main():
    short = options(__doc__).short
    library = build_target("bearing_kernels")
    core = declare(Core.load(library))
    isa = instruction_sets(core)[-1]
    core.ffi.cdef(f"void peak_times_{isa}(long, double *);")
    peak, scenes = peaks(core, isa), [Scene(name) for name in ("demo", "tilt", "jam")]
    cages = {
        cage.name.lower(): {scene.name: measure(scene, cage, core, library, peak, short) for scene in scenes}
        for cage in CAGES
    }
    write("step", {"isa": isa, "peaks": peak, "cages": cages}, short)


if __name__ == "__main__":
    main()
