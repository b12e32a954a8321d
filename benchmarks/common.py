"""Shared by the benchmarks: scenes, the core with either integrator, processor time, records.

Times are processor times of this process: other users of the machine change wall times, but hardly processor times.
"""

import argparse
import platform
import subprocess
import sys
import time
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
from records import write_record

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT), str(ROOT / "tests")]

from library import LIBRARY, Core  # noqa: E402
from mechanics import Instance  # noqa: E402

from bearing_model.generated import variables  # noqa: E402
from riveted_bearing.running.fmu import Model, codes  # noqa: E402
from riveted_bearing.running.scene import load_scene  # noqa: E402

FMU = ROOT / "fmus" / "RivetedBearing.fmu"
BUILD = ROOT / "build"

# Name -> title, shipped scene, changes.  Pulses as in the paper: three half-sines in 0.01 s.
SCENES = {
    "demo": ("working point, 18,238 r/min", "demo", {}),
    "slow": ("4,000 r/min", "demo", {"inputs": {"shaft.omega": "4000 rev/min"}}),
    "tilt": ("shaft tilted by 0.5°", "demo", {"inputs": {"shaft.tilt_z": "0.5 deg"}}),
    "impact": (
        "impact train",
        "demo",
        {
            "parameters": {
                "pulse.t_start": 0.0,
                "pulse.F_r": 1401.0,
                "pulse.F_a": 241.0,
                "pulse.duration": 1e-3,
                "pulse.interval": 1e-2 / 3,
                "pulse.count": 1000,
            }
        },
    ),
    "jam": ("jam, 4,000 r/min", "jam", {}),
}


class Scene:
    """A scene with rigid cage halves, which all solvers can run, as the core takes it: numbers by full variable name.
    rtf.py has the elastic ones' cost.
    """

    def __init__(self, name):
        model = Model(FMU)
        self.name, (self.title, shipped, changes) = name, SCENES[name]
        parameters = {"scene.cage": "two_half"} | changes.get("parameters", {})
        self.checked = load_scene(shipped, model, ("benchmark", changes | {"parameters": parameters}))
        items = self.checked.parameters.items()
        self.parameters = {
            key: codes(model.parameters[key])[value] if isinstance(value, str) else value for key, value in items
        }
        self.inputs = {key: float(history(0.0)) for key, history in self.checked.inputs.items()}
        self.settle = self.parameters.get("start.settle", variables.PARAMETERS["start.settle"].start)  # [s]

    def start(self, core, tolerance=0.0, **parameters):
        """An initialised instance; parameters with _ for the dot change the scene's."""
        changes = {
            name.replace("_", ".", 1): int(value) if isinstance(value, bool) else value
            for name, value in parameters.items()
        }
        return Instance(core, self.parameters | changes, self.inputs, tolerance)


def core_library():
    """The core as it is in the FMU."""
    return Core.load(LIBRARY)


def build_target(name):
    """Build a target that only benchmarks need; returns its library."""
    cmake = Path(sys.executable).with_name("cmake")
    subprocess.run(
        [str(cmake if cmake.exists() else "cmake"), "--build", str(BUILD), "--target", name],
        check=True,
        stdout=subprocess.DEVNULL,
    )
    return BUILD / f"lib{name}.so"


def declare(core, header):
    """Add the functions of a header in this folder to a core's declarations."""
    lines = (ROOT / "benchmarks" / header).read_text().splitlines()
    text = "\n".join(line for line in lines if not line.startswith(("#", "//")))
    core.ffi.cdef("\n".join(line.partition("//")[0] for line in text.splitlines()))
    return core


def set_state(instance, y, h=4e-6):
    """Put an instance into state y with the step size h [s] to start with."""
    core = instance.core
    saved = core.new("InstanceState")
    core.lib.part_save(instance.bearing, saved)
    saved.integrator.now.y = list(y)
    saved.integrator.now.jerk = [0.0] * len(y)  # no memory of another trajectory
    saved.integrator.now.h = 0.0
    saved.integrator.h = h
    saved.integrator.f_is_current = 0
    core.lib.part_restore(instance.bearing, saved)


def counters(instance):
    """Steps, evaluations of the right-hand side and failed error tests so far."""
    return {name: instance.output(f"solver.{name}") for name in ("steps", "rhs_evals", "error_tests_failed")}


def cpu(action, repeat=1):
    """Least processor time [s] of `repeat` runs of an action, and what its last run returned."""
    best = np.inf
    for _ in range(repeat):
        begin = time.process_time()
        result = action()
        best = min(best, time.process_time() - begin)
    return best, result


def processor():
    """Name of the processor; a name without a number says little, so that family and model follow it."""
    said = {key.strip(): value.strip() for key, _, value in (line.partition(":") for line in cpu_info())}
    name = said.get("model name") or said.get("Model") or platform.machine()
    if "cpu family" not in said or any(letter.isdigit() for letter in name):
        return name
    return f"{name} family {said['cpu family']} model {said['model']}"


def machine():
    """Processor, system, compiler and Python, without names of hosts or users."""
    compiler = subprocess.run(["cc", "--version"], capture_output=True, text=True, check=False).stdout.partition("\n")[
        0
    ]
    return {
        "processor": processor(),
        "system": f"{platform.system()} {platform.machine()}",
        "compiler": compiler,
        "python": platform.python_version(),
    }


def cpu_info():
    path = Path("/proc/cpuinfo")
    return path.read_text().splitlines() if path.is_file() else []


def commit():
    """Commit of the checkout, with + if files differ from it, records and pages apart; "" outside a checkout."""

    def git(*arguments):
        return subprocess.run(
            ["git", "-C", str(ROOT), *arguments], capture_output=True, text=True, check=False
        ).stdout.strip()

    return git("rev-parse", "--short", "HEAD") + (
        "+" if git("status", "--porcelain", "-uno", "--", ".", ":!benchmarks/results", ":!docs") else ""
    )


def options(description):
    """Command line of a benchmark."""
    parser = argparse.ArgumentParser(description=description.partition("\n")[0])
    parser.add_argument("--short", action="store_true", help="minutes instead of an hour: fewer settings, shorter runs")
    return parser.parse_args()


def write(name, data, short):
    """Write the record of a benchmark, with commit, date and machine, to benchmarks/results/."""
    about = {
        "benchmark": name,
        "short": short,
        "date": datetime.now(UTC).isoformat(timespec="seconds"),
        "commit": commit(),
        "machine": machine(),
    }
    path = write_record(about | data)
    print(f"wrote {path.relative_to(ROOT)}")


def say(text):
    print(text, flush=True)
