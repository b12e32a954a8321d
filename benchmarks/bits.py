"""Digests of all states and of all outputs of the shipped scenes over 0.05 s: two builds run the same trajectory if these lines are equal.

    python benchmarks/bits.py > before; ...; python benchmarks/bits.py | diff before -

A change of the code's form must leave every line as it was.  Digests depend on the instruction set only by its fused multiply-add.
--outputs prints a digest of each output, to find the one that moved.
"""

import argparse
import hashlib

import numpy as np
from common import FMU, LIBRARY, Core, Instance, Model, codes, load_scene, variables

SCENES = ("demo", "R", "F", "jam")
T_END, STEP = 0.05, 1e-4  # [s]


def trajectory(core, name):
    """States and outputs of a shipped scene at its communication points: [points, states], {output: [points, ...]}."""
    model = Model(FMU)
    scene = load_scene(name, model)
    parameters = {key: codes(model.parameters[key])[value] if isinstance(value, str) else value for key, value in scene.parameters.items()}
    instance = Instance(core, parameters, {key: float(history(0.0)) for key, history in scene.inputs.items()})
    names = list(variables.OUTPUTS)
    states, rows = [instance.y], []
    for i in range(1, round(T_END / STEP) + 1):
        instance.step(i * STEP)
        states.append(instance.y)
        rows.append([np.copy(instance.output(output.replace("[j]", "").replace("[k]", ""))) for output in names])
    return np.array(states), {output: np.array(column) for output, column in zip(names, zip(*rows))}


def digest(*arrays):
    """The first 16 hexadecimal digits of the arrays' SHA-256."""
    return hashlib.sha256(b"".join(np.ascontiguousarray(array, dtype=float).tobytes() for array in arrays)).hexdigest()[:16]


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--outputs", action="store_true", help="a digest of each output too")
    each = parser.parse_args().outputs
    core = Core.load(LIBRARY)
    for name in SCENES:
        states, outputs = trajectory(core, name)
        print(f"{name:5} states {digest(states)} outputs {digest(*outputs.values())}", flush=True)
        if each:
            for output, values in outputs.items():
                print(f"{name:5} {output:36} {digest(values)}")


if __name__ == "__main__":
    main()
