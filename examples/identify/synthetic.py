"""A synthetic test rig whose truth is known: runs of the FMU at hidden values are the measurement, with noise of its own.

    python examples/identify/synthetic.py          # writes rig.toml, then: riveted-bearing identify rig.toml

A lightly loaded 6207 at three speeds; torque and the cage's displacement in two directions are "measured".  Viscosity
and guide clearance decide them, the joints' friction does not.
"""

import sys

import numpy as np

from riveted_bearing import run
from riveted_bearing.base.toml_files import to_toml

TRUTH = {"oil.eta": 5e-3, "cage.guide_clearance": 0.22e-3, "joint.mu": 0.2}  # Pa.s, m, 1
SPEEDS = (6000, 12000, 18000)  # r/min
CHANNELS = {"mean(bearing.friction_torque)": 0.02, "rms(cage.y)": 0.03, "rms(cage.z)": 0.03}  # uncertainty of the rig
SCENE = {
    "simulation": {"t_end": 0.04},
    "parameters": {"start.settle": 0.02, "scene.stress": "off"},
    "inputs": {"shaft.F_y": 600.0, "shaft.F_x": 200.0},
}


def measured(number):
    """Figures of the rig [speeds, channels] for the repeat of this number: seeds and noise that no other repeat has."""
    rng = np.random.default_rng(number)
    names = [text.partition("(")[2].removesuffix(")") for text in CHANNELS]
    found = []
    for speed in SPEEDS:
        inputs = SCENE["inputs"] | {"shaft.omega": f"{speed} rev/min"}
        result = run(
            "demo",
            parameters=SCENE["parameters"] | TRUTH,
            inputs=inputs,
            t_end=SCENE["simulation"]["t_end"],
            outputs=names,
            seed=100_000 + number,
        )
        late = result.data["time"] >= SCENE["parameters"]["start.settle"]
        figures = [
            result.data[name][late].mean()
            if kind.startswith("mean")
            else np.sqrt((result.data[name][late] ** 2).mean())
            for kind, name in zip(CHANNELS, names, strict=True)
        ]
        found.append(figures * (1.0 + np.array(list(CHANNELS.values())) * rng.normal(size=len(names))))
    return np.array(found)


def study(number):
    """The document of the study of a repeat."""
    figures = measured(number)
    points = [{"name": f"{speed} r/min", "inputs": {"shaft.omega": f"{speed} rev/min"}} for speed in SPEEDS]
    targets = [
        {"point": point["name"], "measure": name, "value": float(value), "uncertainty": f"{100 * share:g} %"}
        for point, row in zip(points, figures, strict=True)
        for (name, share), value in zip(CHANNELS.items(), row, strict=True)
    ]
    return SCENE | {
        "description": "Synthetic rig: oil 5 mPa s, guide clearance 0.22 mm, joint friction 0.2",
        "scene": "demo",
        "seeds": 2,
        "seed": 1 + 10 * number,
        "check_seeds": 4,
        "screen": {"count": 16},
        "search": {"rounds": 2, "points": 6},
        "parameter": {
            "oil.eta": {"low": 2e-3, "high": 20e-3, "scale": "log"},
            "cage.guide_clearance": {"low": 0.1e-3, "high": 0.4e-3},
            "joint.mu": {"low": 0.1, "high": 0.3},
        },
        "point": points,
        "target": targets,
    }


def lines(document):
    """The document as TOML."""
    plain = {key: value for key, value in document.items() if key not in ("point", "target")}
    yield from to_toml(plain)
    for key in ("point", "target"):
        for block in document[key]:
            flat = {name: value for name, value in block.items() if name != "inputs"}
            yield f"[[{key}]]"
            yield from to_toml(flat)
            for name, value in block.get("inputs", {}).items():
                yield f'inputs."{name}" = "{value}"'


if __name__ == "__main__":
    number = int(sys.argv[1]) if len(sys.argv) > 1 else 1
    with open("rig.toml", "w", encoding="utf-8") as file:
        file.write("\n".join(lines(study(number))) + "\n")
