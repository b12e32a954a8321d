"""A planetary stage: the planet's bearing on the carrier's pin, its outer ring turning with the planet gear; rivet
stress over the carrier's speed.

    python examples/planet/planet.py [--speeds 0 1000 2000] [--picture planet.png]

In the frame of the carrier the pin stands, and with it the inner ring.  The ring gear stands in space: against the
carrier the planet turns with -omega_c (R + r)/r, R the radius of the pins' circle, r that of the planet's pitch circle.
Both meshes and the planet's own centrifugal force load the bearing.
"""

import argparse
from pathlib import Path

import numpy as np

import riveted_bearing as rb

R, R_PLANET, PLANET = 0.15, 0.06, 1.5  # [m], [m], mass of the planet gear [kg]
MESH = 2500.0  # tangential load of both meshes [N]
RING = 0.6  # ring.m [kg]: held by the pin, not by the balls
COLUMNS = {  # of the printed table: key of a summary -> heading, factor, format
    "sigma_head_mean": ("head mean [MPa]", 1.0, ".0f"),
    "sigma_head_p999": ("head 99.9 % [MPa]", 1.0, ".0f"),
    "eccentricity": ("eccentricity/clearance", 1.0, ".2f"),
    "power_loss": ("power loss [W]", 1.0, ".0f"),
    "cage_omega": ("cage [r/min]", 30.0 / np.pi, ",.0f"),
    "RTF": ("real-time factor", 1.0, ".1f"),
}
OUTPUTS = [
    "rivet.sigma_head_max",
    "rivet.sigma_mid_max",
    "cage.omega",
    "cage.eccentricity",
    "bearing.power_loss",
    "event.*",
    "stat.*",
]


def run(speed, field=True, t_end=0.12, fmu=None, **parameters):
    """The Result at a carrier speed [r/min]; field: whether balls and cage feel the carrier's centrifugal and Coriolis
    forces.
    """
    omega_c = speed * np.pi / 30.0
    inputs = {
        "shaft.omega": 0.0,
        "housing.omega": -omega_c * (R + R_PLANET) / R_PLANET,
        "shaft.F_x": 200.0,
        "shaft.F_z": MESH,
    }
    # the pin draws the planet inward; its own mass is on the pin, not in the bearing
    inputs["shaft.F_y"] = -(omega_c**2) * R * (PLANET + RING * field)
    inputs["frame.omega"] = omega_c if field else 0.0
    settings = {"frame.radius": R, "start.settle": 0.04} | parameters
    return rb.run(None, parameters=settings, inputs=inputs, t_end=t_end, outputs=OUTPUTS, fmu=fmu)


def summary(result):
    """Mean and 99.9 % quantile of the worst rivet's head stress [MPa], eccentricity of the cage, power loss [W], cage
    speed [rad/s], real-time factor.
    """
    values = {name: float(result.data[f"stat.{name}"][-1]) / 1e6 for name in ("sigma_head_mean", "sigma_head_p999")}
    later = result.data["time"] > 0.04
    values["eccentricity"] = float(np.mean(result.data["cage.eccentricity"][later]))
    values["power_loss"] = float(np.mean(result.data["bearing.power_loss"][later]))
    return values | {
        "cage_omega": float(np.mean(result.data["cage.omega"][later])),
        "RTF": result.summary["real_time_factor"],
    }


def table(speeds, rows):
    """Lines of the printed table: each value with the carrier's field, in brackets without it."""
    lines = [["carrier [r/min]", *(heading for heading, _, _ in COLUMNS.values())]]
    for speed, *both in zip(speeds, rows[True], rows[False], strict=True):
        cells = [
            [format(round(factor * row[key], 6) + 0.0, form) for row in both]
            for key, (_, factor, form) in COLUMNS.items()
        ]
        lines.append([f"{speed:,.0f}", *(f"{inside} ({outside})" for inside, outside in cells)])
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    return ["  ".join(cell.rjust(width) for cell, width in zip(line, widths, strict=True)) for line in lines]


def plot(speeds, rows, path):
    """Stress and cage over carrier speed, with and without the carrier's field."""
    import matplotlib.pyplot as plt

    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
    for field, colour in ((True, "#c8442b"), (False, "#9aa2ad")):
        label = "with the carrier's field" if field else "without"
        left.plot(speeds, [row["sigma_head_p999"] for row in rows[field]], "o-", color=colour, label=f"99.9 %, {label}")
        left.plot(speeds, [row["sigma_head_mean"] for row in rows[field]], "o--", color=colour, label=f"mean, {label}")
        right.plot(speeds, [row["eccentricity"] for row in rows[field]], "o-", color=colour, label=label)
    left.set(xlabel="carrier [r/min]", ylabel="head stress of the worst rivet [MPa]")
    right.set(xlabel="carrier [r/min]", ylabel="eccentricity of the cage / clearance")
    left.legend()
    right.legend()
    figure.savefig(path, dpi=110)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument(
        "--speeds",
        type=float,
        nargs="+",
        default=[250.0, 500.0, 1000.0, 1500.0, 2000.0, 2500.0, 3000.0],
        help="of the carrier [r/min]",
    )
    parser.add_argument("--picture", type=Path)
    options = parser.parse_args()
    rows = {field: [summary(run(speed, field)) for speed in options.speeds] for field in (True, False)}
    print(
        "Worst rivet, cage and loss over the carrier's speed; in brackets: without the carrier's field",
        *table(options.speeds, rows),
        sep="\n",
    )
    if options.picture:
        plot(options.speeds, rows, options.picture)
        print(f"picture  {options.picture}")
