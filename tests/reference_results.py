"""The FMU against the reference results that it carries: its outputs over the first millisecond, on any machine on
which fmpy runs.

    python tests/reference_results.py fmus/RivetedBearing.fmu

Over 1 ms trajectories can be compared point by point; the motion is chaotic, so later only its statistics can.
"""

import csv
import platform
import shutil
import sys
import tempfile
from pathlib import Path

import fmpy
import numpy as np

# Largest difference of an output against its largest magnitude: what a user may count on.  Observed: 0 for zig's clang
# and for gcc -O1 and -O3 on Linux,
# 2e-16 for Windows (contact angles, by the system's atan2), 1.1e-10 for sources compiled without the fused
# multiply-adds of the binary's kernels.  Only because
# elementary.h takes no other function from the system: with the systems' own, differences of 1e-16 at the start reached
# 1e-2 in 0.6 ms, when one error test was
# passed here and failed there.
SAME = 1e-9
FLOORS = {
    "m": 1e-7,
    "N": 0.1,
    "W": 1e-3,
    "N.m": 2e-4,
    "1": 1e-7,
    "rad": 1e-7,
    # smaller ones are compared with these: a slip of 3e-11 m is known to 4e-18 m; halves that rest lose 2e-8 W by
    # vibration
}
# What a joint carries, 6e-4 N at most here, is the tension of its rivet, 53 N, less what its plates press; what they hold across it,
# 2e-3 N, follows places that are known to 1e-17 m, by 1e8 N/m: both are compared with the tension.
DIFFERENCE_OF = {".N": ".T", ".V": ".T"}


def read_reference(folder):
    """Names of the outputs, times [s] and rows [times, outputs] of the reference results in an unpacked FMU."""
    (path,) = (Path(folder) / "extra" / "org.fmi-standard.fmi-ls-ref").glob("*.csv")
    header, *rows = csv.reader(path.read_text().splitlines())
    rows = np.array(rows, dtype=float)
    return header[1:], rows[:, 0], rows[:, 1:]


def difference(rows, expected, names, units):
    """Largest difference [1] of each output, a column with name and unit, from its expected trajectory, against the
    largest magnitude there.
    """
    assert rows.shape == expected.shape
    assert np.abs(expected).max() > 1e3
    largest = np.maximum(np.abs(expected).max(axis=0), [FLOORS.get(unit, 0.0) for unit in units])
    for i, name in enumerate(names):
        for ending, of in DIFFERENCE_OF.items():
            if name.startswith("rivet[") and name.endswith(ending):
                largest[i] = max(largest[i], largest[names.index(name.removesuffix(ending) + of)])
    return np.max(np.abs(rows - expected) / np.where(largest > 0.0, largest, 1.0), axis=0)


def native_binary(folder):
    """Puts the binary for macOS on Arm where fmpy looks for it: FMI 2.0.4 calls its folder aarch64-darwin, fmpy
    darwin64.
    """
    binary = folder / "binaries" / "aarch64-darwin"
    if sys.platform == "darwin" and platform.machine() == "arm64" and binary.is_dir():
        shutil.copytree(binary, folder / "binaries" / "darwin64", dirs_exist_ok=True)


def main(path):
    # Windows keeps a library that was loaded
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as temporary:
        folder = Path(fmpy.extract(path, temporary))
        native_binary(folder)
        names, times, expected = read_reference(folder)
        step = times[1] - times[0]
        result = fmpy.simulate_fmu(str(folder), stop_time=times[-1], step_size=step, output_interval=step, output=names)
        units = {v.name: v.unit or "1" for v in fmpy.read_model_description(str(folder)).modelVariables}
    largest = difference(np.array([result[name] for name in names]).T, expected, names, [units[name] for name in names])
    worst = int(largest.argmax())
    print(
        f"{platform.system()} {platform.machine()}, fmpy {fmpy.__version__}: {len(names)} outputs, {len(times) - 1} steps of {step:g} s"
    )
    print(f"largest difference from the reference results: {largest[worst]:.1e} of {names[worst]}, allowed {SAME:g}")
    return int(not np.all(largest <= SAME))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
