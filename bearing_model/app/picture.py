"""Picture of the bearing to scale: seen along the shaft, and cut through a rivet.

python -m bearing_model.app.picture docs/bearing.svg
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Annulus, Circle, FancyArrowPatch, Rectangle

from bearing_model import variables

STEEL, BALL, CAGE, RIVET, INK = "#b8c4d0", "#dfe5ea", "#d9b36c", "#8c3b2e", "#2b2f36"
RIM = {"edgecolor": INK, "linewidth": 0.7}
HEAD_RADIUS, HEAD_HEIGHT, FLANGE = 1.3, 0.9, 1.5  # rivet head and cage flange of the rivet table's geometry [mm]


def dimensions():
    """Default dimensions of the variable table [mm]."""
    start = {name: p.start for name, p in variables.PARAMETERS.items()}
    names = {"D": "bearing.D", "d_m": "bearing.d_m", "D_o": "cage.D_o", "D_i": "cage.D_i", "width": "cage.width"}
    return {letter: 1e3 * start[name] for letter, name in names.items()} | {"bore": 35.0, "outside": 72.0, "B": 17.0, "d": 1.5}


def front(ax, mm):
    """The bearing seen from +X."""
    shoulder_e, shoulder_i = 0.5 * (mm["d_m"] + 0.55 * mm["D"]), 0.5 * (mm["d_m"] - 0.55 * mm["D"])
    ax.add_patch(Annulus((0, 0), mm["outside"] / 2, mm["outside"] / 2 - shoulder_e, facecolor=STEEL, **RIM))
    ax.add_patch(Annulus((0, 0), shoulder_i, shoulder_i - mm["bore"] / 2, facecolor=STEEL, **RIM))
    angle = 2 * np.pi * np.arange(variables.Z) / variables.Z
    for a in angle:
        ax.add_patch(Circle(0.5 * mm["d_m"] * np.array([np.cos(a), np.sin(a)]), mm["D"] / 2, facecolor=BALL, **RIM))
    ax.add_patch(Annulus((0, 0), mm["D_o"] / 2, (mm["D_o"] - mm["D_i"]) / 2, facecolor=CAGE, alpha=0.75, **RIM))
    for a in angle + np.pi / variables.Z:
        ax.add_patch(Circle(0.5 * mm["d_m"] * np.array([np.cos(a), np.sin(a)]), HEAD_RADIUS, facecolor=RIVET, **RIM))
    arrow(ax, (0, 0), (16, 0), "$F_r$ along $Y$")
    ax.text(-6, 5.5, r"$\omega$", fontsize=12, ha="center", color=INK)
    ax.add_patch(FancyArrowPatch((-4, 12), (-12, 4), connectionstyle="arc3,rad=0.35", arrowstyle="-|>", mutation_scale=12, color=INK))
    ax.set_title("seen along the shaft", y=-0.05, fontsize=10, color=INK)


def arrow(ax, start, end, text):
    ax.add_patch(FancyArrowPatch(start, end, arrowstyle="-|>", mutation_scale=14, color=INK, linewidth=1.4, zorder=5))
    ax.text(start[0] - 1, start[1] - 3.4, text, color=INK, fontsize=10)


def section(ax, mm):
    """Cut in the plane of the axis, the cage unrolled: balls between their pockets' walls and the rivets beside them."""
    x0, R, wall = 0.0, mm["D"] / 2, mm["width"] / 2
    pitch = np.pi * mm["d_m"] / variables.Z
    for side, name in ((-1, "half 0"), (1, "half 1")):
        along = np.linspace(-1.5 * pitch, 1.5 * pitch, 301)
        local = np.abs((along + pitch / 2) % pitch - pitch / 2)
        inside = np.sqrt(np.maximum((R + 0.1) ** 2 - local**2, 0.0))
        outside = np.maximum(np.sqrt(np.maximum(wall**2 - local**2, 0.0)), FLANGE)
        ax.fill_between(x0 + along, side * inside, side * outside, facecolor=CAGE, **RIM)
        ax.text(x0 + 1.53 * pitch, side * 3.0 - 0.6, name, fontsize=10, color=INK)
    for ball in (-1, 0, 1):
        ax.add_patch(Circle((x0 + ball * pitch, 0), R, facecolor=BALL, **RIM))
    for rivet in (-0.5, 0.5):
        x = x0 + rivet * pitch
        ax.add_patch(Rectangle((x - mm["d"] / 2, -FLANGE), mm["d"], 2 * FLANGE, facecolor=RIVET, **RIM))
        for side in (-1, 1):
            ax.add_patch(Rectangle((x - HEAD_RADIUS, min(side * FLANGE, side * (FLANGE + HEAD_HEIGHT))), 2 * HEAD_RADIUS, HEAD_HEIGHT, facecolor=RIVET, **RIM))
    ax.annotate("rivet: preload $P$, tension $T$,\nslip $u$, stress of head and middle", (x0 + 0.5 * pitch, -2.6), (x0 - 0.3 * pitch, -13), fontsize=10,
                color=INK, arrowprops={"arrowstyle": "-", "color": INK, "linewidth": 0.8})  # fmt: skip
    ax.set_title("the riveted cage, unrolled", y=-0.75, fontsize=10, color=INK)
    ax.annotate("ball and pocket: $Q_c$", (x0 - 0.25 * pitch, R * 0.9), (x0 - 1.2 * pitch, 10.5), fontsize=10, color=INK,
                arrowprops={"arrowstyle": "-", "color": INK, "linewidth": 0.8})  # fmt: skip


def draw(path):
    """Writes the picture; the format follows the file's ending."""
    mm = dimensions()
    figure, (left, right) = plt.subplots(1, 2, figsize=(12, 5), width_ratios=[1, 1.35])
    front(left, mm)
    section(right, mm)
    for ax in (left, right):
        ax.set_aspect("equal")
        ax.autoscale_view()
        ax.axis("off")
    figure.savefig(path, bbox_inches="tight", metadata={"Date": None} if str(path).endswith("svg") else None)
    plt.close(figure)


if __name__ == "__main__":
    matplotlib.rcParams |= {"svg.hashsalt": "riveted-bearing", "svg.fonttype": "none", "font.family": "sans-serif"}
    draw(sys.argv[1])
