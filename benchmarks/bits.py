"""Whether two builds run the same trajectory: digests of all outputs of the shipped scenes, elastic and rigid halves,
all methods, over 0.05 s.

    python benchmarks/bits.py > before; ...; python benchmarks/bits.py | diff before -
    python benchmarks/bits.py RIBBON.fmu                   the scenes that another bearing's FMU does not refuse
    python benchmarks/bits.py --against OTHER.fmu          the scenes in which an output of both FMUs differs, and which outputs

A change of the code's form must leave every line as it was.  Digests depend on the instruction set only by its fused
multiply-add. --outputs prints a digest of each output, to find the one that moved.
"""

import argparse
import hashlib

import numpy as np
from common import FMU, Model, load_scene

from riveted_bearing.base.errors import UserError
from riveted_bearing.running.runner import simulate

TILT = {"inputs": {"shaft.tilt_z": "0.5 deg"}}
RIGID = {"parameters": {"scene.cage": "two_half"}}
SCENES = {  # name -> shipped scene, changes
    **{
        f"{name}, {cage}": (name, changes)
        for name in ("demo", "R", "F", "jam")
        for cage, changes in (("elastic", {}), ("two halves", RIGID))
    },
    "tilt, elastic": ("demo", TILT),
    "tilt, two halves": ("demo", TILT | RIGID),
    "point, elastic": ("demo", {"parameters": {"scene.traction": "point", "scene.stress": "fatigue"}}),
    **{
        f"{method}, {cage}": ("demo", {"parameters": changes.get("parameters", {}) | {"solver.method": method}})
        for method in ("explicit", "fixed")
        for cage, changes in (("elastic", {}), ("two halves", RIGID))
    },
}
T_END = 0.05  # [s]


def outputs_of(model, name):
    """All outputs of a scene at its communication points, and its closing figures: {name: values}."""
    shipped, changes = SCENES[name]
    simulation = {"simulation": {"t_end": T_END, "outputs": list(model.outputs)}, "parameters": {"start.settle": 0.0}}
    result = simulate(model, load_scene(shipped, model, ("a benchmark", changes), ("a benchmark", simulation)))
    return {output: np.asarray(result.data[output]) for output in model.outputs}


def digest(arrays):
    """The first 16 hexadecimal digits of the arrays' SHA-256."""
    return hashlib.sha256(b"".join(np.ascontiguousarray(array, dtype=float).tobytes() for array in arrays)).hexdigest()[
        :16
    ]


def differing(outputs, others):
    """Names of the outputs that both have and that differ, with the largest difference over the largest value."""
    for name, values in outputs.items():
        if name in others and not np.array_equal(values, others[name], equal_nan=True):
            yield name, float(np.nanmax(np.abs(values - others[name])) / max(np.nanmax(np.abs(values)), 1e-300))


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("fmu", nargs="?", default=FMU, help="FMU of another bearing")
    parser.add_argument("--outputs", action="store_true", help="a digest of each output too")
    parser.add_argument("--against", metavar="FMU", help="another FMU to compare with, output by output")
    options = parser.parse_args()
    model, other = Model(options.fmu), Model(options.against) if options.against else None
    for name in SCENES:
        try:
            outputs = outputs_of(model, name)
        except UserError:
            if options.fmu == FMU:
                raise
            print(f"{name:20} refused")
            continue
        if other:
            found = dict(differing(outputs, outputs_of(other, name)))
            print(
                f"{name:20} {len(found)} outputs differ",
                *(f"{output} {share:.1e}" for output, share in list(found.items())[:6]),
                flush=True,
            )
            continue
        print(f"{name:20} {digest(outputs.values())}", flush=True)
        if options.outputs:
            for output, values in outputs.items():
                print(f"{name:20} {output:36} {digest([values])}")


if __name__ == "__main__":
    main()
