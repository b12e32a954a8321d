"""Write the page that runs the bearing in a browser: one HTML file with the core as WebAssembly, the worker that runs
it and the report's drawing.

python docs/site/browser/page.py --core build/wasm32/RivetedBearing.wasm --out build/browser/bearing.html
"""

import argparse
import base64
import json
from pathlib import Path

import jinja2

from bearing_model.generated import variables
from riveted_bearing.building.compiler import find_zig
from riveted_bearing.show.animation import exaggeration
from riveted_bearing.show.pages import PARTS

HERE = Path(__file__).resolve().parent
LICENCES = ("LICENSE", "THIRD_PARTY_NOTICES.md")  # of the repository
OF_ZIG = ("musl/COPYRIGHT", "wasi/LICENSE-MIT")  # of the C library that zig links, in its folder libc
Z = variables.Z
DRAWN = (
    "bearing.D",
    "bearing.d_m",
    "bearing.P_d",
    "cage.D_o",
    "cage.D_i",
    "cage.width",
    "cage.pocket_clearance",
    "cage.guide_clearance",
)
# shown = factor * SI
UNITS = {"rev/min": 9.549296585513721, "deg": 57.29577951308232, "MPa": 1e-6, "um": 1e6, "N": 1.0, "1": 1.0}
SLIDERS = (  # variable, label, unit, least, largest, step
    ("shaft.F_y", "Radial load", "N", 0, 6000, 2),
    ("shaft.F_x", "Axial load", "N", 0, 2000, 5),
    ("shaft.omega", "Speed", "rev/min", 1000, 24000, 2),
    ("shaft.tilt_z", "Tilt", "deg", -0.3, 0.3, 0.01),
    ("joint.preload", "Preload of a rivet", "N", 0, 100, 1),
    ("joint.fit", "Fit, rivet minus hole", "um", -40, 20, 1),
    ("pulse.F_r", "Impacts", "N", 0, 4000, 50),
)
FIXED = {"pulse.count": 1_000_000}  # impacts go on as long as the page runs
CHOICES = {"scene.cage": variables.CageModel.TWO_HALF}  # rigid halves, which a browser computes fast enough to watch
SWITCHES = {"scene.statistics": int(variables.Switch.ON)}  # as riveted-bearing run does without being told
CHANNELS = (
    *(f"half_{h}.{name}" for h in (0, 1) for name in ("x", "y", "z", "psi", "tilt_y", "tilt_z")),
    *("ring.x", "ring.y", "ring.z", "shaft.F_y", "shaft.F_z", "cage.F_pocket_peak", "rivet.sigma_head_max"),
    *(f"ball[{j}].{name}" for j in range(1, Z + 1) for name in ("x", "r", "psi", "Q_i", "Q_e", "Q_c")),
    *(f"rivet[{k}].sigma_head_peak" for k in range(1, Z + 1)),
)
PEAKS = (
    *(f"rivet[{k}].sigma_{place}_peak" for place in ("head", "mid") for k in range(1, Z + 1)),
    "cage.F_pocket_peak",
)
ROWS = (  # of the table of statistics: title, unit, prefix of the outputs
    ("Head stress, worst rivet", "MPa", "stat.sigma_head"),
    ("Middle stress, worst rivet", "MPa", "stat.sigma_mid"),
    ("Pocket force, all balls", "N", "stat.Q_c"),
)
KINDS = ("mean", "rms", "p999", "max")
FIGURES = (
    *(f"{prefix}_{kind}" for _, _, prefix in ROWS for kind in KINDS),
    "stat.time",
    "cage.slip_ratio",
    "cage.dislocation",
    "bearing.power_loss",
)


def sliders():
    """What the page knows of each slider: variable, label, unit and factor, range and start value in this unit, whether
    it is an input, and whether a parameter that the running bearing takes (impacts in progress cannot change).
    """
    known = variables.INPUTS | variables.PARAMETERS
    for name, label, unit, low, high, step in SLIDERS:
        value = round(UNITS[unit] * known[name].start / step) * step
        yield {
            "name": name,
            "label": label,
            "unit": unit,
            "factor": UNITS[unit],
            "low": low,
            "high": high,
            "step": step,
            "start": value,
            "live": name in variables.INPUTS,
            "tuned": name in variables.PARAMETERS
            and not variables.PARAMETERS[name].fixed
            and not name.startswith("pulse."),
        }


def licences():
    """Licences of what is compiled into the page, as one text."""
    zig = Path(find_zig()).resolve().parent
    libc = next(folder for folder in (zig / "lib" / "libc", zig.parent / "lib" / "zig" / "libc") if folder.is_dir())
    files = [*(HERE.parents[2] / name for name in LICENCES), *(libc / name for name in OF_ZIG)]
    return "\n\n".join(path.read_text(encoding="utf-8") for path in files)


def page(core):
    """The page as text; core: bytes of the WebAssembly module."""
    start = {name: variable.start for name, variable in variables.PARAMETERS.items()}
    data = {
        "Z": Z,
        "scale": exaggeration(start),
        "bearing": {name: start[name] for name in DRAWN},
        "settle": start["start.settle"],
        "sliders": list(sliders()),
        "fixed": FIXED,
        "switches": SWITCHES | {name: int(item) for name, item in CHOICES.items()},
        "choices": {name: item.name.lower() for name, item in CHOICES.items()},
        "channels": CHANNELS,
        "peaks": PEAKS,
        "figures": FIGURES,
    }
    environment = jinja2.Environment(
        autoescape=True, trim_blocks=True, lstrip_blocks=True, undefined=jinja2.StrictUndefined
    )
    return environment.from_string((HERE / "page.html").read_text(encoding="utf-8")).render(
        style=(PARTS / "style.css").read_text(encoding="utf-8"),
        drawing=(PARTS / "drawing.js").read_text(encoding="utf-8"),
        script=(HERE / "page.js").read_text(encoding="utf-8"),
        worker=(HERE / "worker.js").read_text(encoding="utf-8"),
        core=base64.b64encode(core).decode(),
        data=json.dumps(data),
        sliders=data["sliders"],
        rows=ROWS,
        kinds=KINDS,
        scale=data["scale"],
        settle=data["settle"],
        licences=licences(),
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--core", type=Path, required=True, help="the WebAssembly module")
    parser.add_argument("--out", type=Path, required=True, help="the page to write")
    arguments = parser.parse_args()
    arguments.out.parent.mkdir(parents=True, exist_ok=True)
    arguments.out.write_text(page(arguments.core.read_bytes()), encoding="utf-8")


if __name__ == "__main__":
    main()
