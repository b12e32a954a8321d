"""The transmission of run.py in a housing that vibrates: a whirl of the outer ring by a second source, as an engine's
order or a road.

    python examples/transmission/vibrating.py [--amplitude 3e-5] [--frequency 400] [--stop 0.05] [--picture
    vibrating.png]

SSP 1.0 has no signal source, so that the script gives housing.y, z and their velocities each step; everything else is
the archive's.
"""

import argparse
import tempfile
from pathlib import Path

import numpy as np
from fmpy.ssp.ssd import get_connections
from run import SYSTEM, load, march

SHOWN = ("housing.F_y", "housing.F_z", "rivet.sigma_head_max", "cage.F_pocket_peak", "housing.power", "ring.y")


class Shaken:
    """The bearing's FMU with the housing's motion before each step."""

    def __init__(self, part, amplitude, frequency):
        self.part, self.fmu, self.amplitude, self.w = part, part.fmu, amplitude, 2.0 * np.pi * frequency

    def __getattr__(self, name):
        return getattr(self.fmu, name)

    def doStep(self, currentCommunicationPoint, communicationStepSize):
        angle, size = self.w * currentCommunicationPoint, self.amplitude
        values = {
            "y": size * np.sin(angle),
            "z": size * (1.0 - np.cos(angle)),
            "v_y": size * self.w * np.cos(angle),
            "v_z": size * self.w * np.sin(angle),
        }
        for name, value in values.items():
            self.part.set(f"housing.{name}", value)
        self.fmu.doStep(
            currentCommunicationPoint=currentCommunicationPoint, communicationStepSize=communicationStepSize
        )


def simulate(path=SYSTEM, stop=0.05, step=2e-5, amplitude=3e-5, frequency=400.0):
    """Outputs of the bearing at the communication points, {name: array} and "time"; the housing whirls with the
    amplitude [m] and the frequency [Hz].
    """
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        system, parts, start = load(path, Path(folder))
        for name, value in start.items():
            component, variable = name.split(".", 1)
            parts[component].set(variable, value)
        parts["bearing"].set("housing.v_y", 2.0 * np.pi * frequency * amplitude)
        parts["bearing"].fmu = Shaken(parts["bearing"], amplitude, frequency)
        wires = [(a.parent.name, a.name, b.parent.name, b.name) for a, b in get_connections(system)]
        rows = march(parts, wires, [("bearing", name) for name in SHOWN], round(stop / step), step)
    return {"time": step * np.arange(len(rows))} | dict(zip(SHOWN, np.array(rows).T, strict=True))


def plot(quiet, shaken, path):
    """Radial force on the housing and head stress, housing at rest and vibrating."""
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(2, 1, figsize=(9, 5), sharex=True, layout="constrained")
    for result, colour, label in ((quiet, "#9aa2ad", "housing at rest"), (shaken, "#c8442b", "vibrating")):
        axes[0].plot(
            1e3 * result["time"],
            np.hypot(result["housing.F_y"], result["housing.F_z"]),
            color=colour,
            lw=0.8,
            label=label,
        )
        axes[1].plot(1e3 * result["time"], result["rivet.sigma_head_max"] / 1e6, color=colour, lw=0.8, label=label)
    axes[0].set_ylabel("radial force [N]")
    axes[1].set(xlabel="time [ms]", ylabel="largest head stress [MPa]")
    axes[0].legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2, frameon=False)
    figure.savefig(path, dpi=110)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    for name, value in (("amplitude", 3e-5), ("frequency", 400.0), ("stop", 0.05)):
        parser.add_argument(f"--{name}", type=float, default=value)
    parser.add_argument("--picture", type=Path)
    options = parser.parse_args()
    results = [simulate(stop=options.stop, amplitude=a, frequency=options.frequency) for a in (0.0, options.amplitude)]
    for result, name in zip(results, ("at rest", "vibrating"), strict=True):
        later = result["time"] > 0.2 * options.stop
        force = np.hypot(result["housing.F_y"], result["housing.F_z"])[later]
        stress = result["rivet.sigma_head_max"][later].max() / 1e6
        print(
            f"housing {name}: radial force {force.mean():.0f} +- {force.std():.0f} N, largest head stress {stress:.0f} MPa"
        )
    if options.picture:
        plot(*results, options.picture)
