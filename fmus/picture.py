"""Pictures of a bearing to scale: seen along the shaft, and cut through a rivet; icons of the FMU and its terminals.

python fmus/picture.py --description fmus/modelDescription.xml --drawing docs/bearing.svg
python fmus/picture.py --description fmus/modelDescription.xml --icons FOLDER
"""

import argparse
from pathlib import Path
from xml.etree import ElementTree

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Annulus, Circle, FancyArrowPatch, Rectangle

STEEL, BALL, CAGE, RIVET, INK = "#b8c4d0", "#dfe5ea", "#d9b36c", "#8c3b2e", "#2b2f36"
RIM = {"edgecolor": INK, "linewidth": 0.7}
HEAD_RADIUS, HEAD_HEIGHT, FLANGE = 1.3, 0.9, 1.5  # rivet head and cage flange of the rivet table's geometry [mm]
ICON_PIXELS = 256


def dimensions(description):
    """Number of balls and the start values of the dimensions [mm]; bore and outside from the 6207's proportions, which
    the variables do not hold.
    """
    start = {v.get("name"): v[0].get("start") for v in ElementTree.parse(description).getroot().find("ModelVariables")}
    names = {"D": "bearing.D", "d_m": "bearing.d_m", "D_o": "cage.D_o", "D_i": "cage.D_i", "width": "cage.width"}
    mm = {letter: 1e3 * float(start[name]) for letter, name in names.items()}
    wall = 18.5 / 11.1125 * mm["D"]
    return mm | {"Z": int(float(start["bearing.Z"])), "bore": mm["d_m"] - wall, "outside": mm["d_m"] + wall, "d": 1.5}


def bearing(ax, mm):
    """Rings, balls, cage and rivet heads."""
    shoulder_e, shoulder_i = 0.5 * (mm["d_m"] + 0.55 * mm["D"]), 0.5 * (mm["d_m"] - 0.55 * mm["D"])
    ax.add_patch(Annulus((0, 0), mm["outside"] / 2, mm["outside"] / 2 - shoulder_e, facecolor=STEEL, **RIM))
    ax.add_patch(Annulus((0, 0), shoulder_i, shoulder_i - mm["bore"] / 2, facecolor=STEEL, **RIM))
    angle = 2 * np.pi * np.arange(mm["Z"]) / mm["Z"]
    for a in angle:
        ax.add_patch(Circle(0.5 * mm["d_m"] * np.array([np.cos(a), np.sin(a)]), mm["D"] / 2, facecolor=BALL, **RIM))
    ax.add_patch(Annulus((0, 0), mm["D_o"] / 2, (mm["D_o"] - mm["D_i"]) / 2, facecolor=CAGE, alpha=0.75, **RIM))
    for a in angle + np.pi / mm["Z"]:
        ax.add_patch(Circle(0.5 * mm["d_m"] * np.array([np.cos(a), np.sin(a)]), HEAD_RADIUS, facecolor=RIVET, **RIM))


def front(ax, mm):
    """The bearing seen from +X, with load and speed."""
    bearing(ax, mm)
    arrow(ax, (0, 0), (16, 0), "$F_r$ along $Y$")
    ax.text(-6, 5.5, r"$\omega$", fontsize=12, ha="center", color=INK)
    ax.add_patch(
        FancyArrowPatch(
            (-4, 12), (-12, 4), connectionstyle="arc3,rad=0.35", arrowstyle="-|>", mutation_scale=12, color=INK
        )
    )
    ax.set_title("seen along the shaft", y=-0.05, fontsize=10, color=INK)


def arrow(ax, start, end, text):
    ax.add_patch(FancyArrowPatch(start, end, arrowstyle="-|>", mutation_scale=14, color=INK, linewidth=1.4, zorder=5))
    ax.text(start[0] - 1, start[1] - 3.4, text, color=INK, fontsize=10)


def section(ax, mm):
    """Cut in the plane of the axis, the cage unrolled: balls between their pockets' walls and the rivets beside them."""
    x0, R, wall = 0.0, mm["D"] / 2, mm["width"] / 2
    pitch = np.pi * mm["d_m"] / mm["Z"]
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
            ax.add_patch(
                Rectangle(
                    (x - HEAD_RADIUS, min(side * FLANGE, side * (FLANGE + HEAD_HEIGHT))),
                    2 * HEAD_RADIUS,
                    HEAD_HEIGHT,
                    facecolor=RIVET,
                    **RIM,
                )
            )
    ax.annotate("rivet: preload $P$, tension $T$,\nslip $u$, stress of head and middle", (x0 + 0.5 * pitch, -2.6), (x0 - 0.3 * pitch, -13), fontsize=10,
                color=INK, arrowprops={"arrowstyle": "-", "color": INK, "linewidth": 0.8})  # fmt: skip
    ax.set_title("the riveted cage, unrolled", y=-0.75, fontsize=10, color=INK)
    ax.annotate("ball and pocket: $Q_c$", (x0 - 0.25 * pitch, R * 0.9), (x0 - 1.2 * pitch, 10.5), fontsize=10, color=INK,
                arrowprops={"arrowstyle": "-", "color": INK, "linewidth": 0.8})  # fmt: skip


def draw(mm, path):
    """Writes the picture; the format follows the file's ending."""
    figure, (above, below) = plt.subplots(2, 1, figsize=(5.2, 6.4), height_ratios=[1.3, 1], layout="constrained")
    front(above, mm)
    section(below, mm)
    for ax in (above, below):
        ax.set_aspect("equal")
        ax.autoscale_view()
        ax.axis("off")
    save(figure, path, bbox_inches="tight")


def save(figure, path, **options):
    """The same picture gives the same bytes."""
    figure.savefig(path, metadata={"Date": None} if path.suffix == ".svg" else {"Software": None}, **options)
    plt.close(figure)


def icon(path, paint, extent, centre=0.0):
    """A square transparent picture of what `paint` draws within +-extent about a point of the x-axis."""
    figure = plt.figure(figsize=(1, 1), dpi=ICON_PIXELS)
    ax = figure.add_axes((0, 0, 1, 1))
    ax.set(xlim=(centre - extent, centre + extent), ylim=(-extent, extent), aspect="equal")
    ax.axis("off")
    paint(ax)
    save(figure, path, dpi=ICON_PIXELS, transparent=True)


def write_icons(mm, folder):
    """icon.png of the FMU; shaft.png, housing.png and impact.png of its terminals (fmus/terminalsAndIcons.xml)."""
    thin = {"edgecolor": INK, "linewidth": 1.0}
    folder.mkdir(parents=True, exist_ok=True)
    icon(folder / "icon.png", lambda ax: bearing(ax, mm), 0.51 * mm["outside"])
    icon(folder / "shaft.png", lambda ax: ax.add_patch(Circle((0, 0), 0.7, facecolor=STEEL, **thin)), 1.0)
    icon(
        folder / "housing.png", lambda ax: ax.add_patch(Rectangle((-0.7, -0.7), 1.4, 1.4, facecolor=BALL, **thin)), 1.0
    )
    icon(
        folder / "impact.png",
        lambda ax: ax.add_patch(
            FancyArrowPatch((-0.8, 0), (0.9, 0), arrowstyle="-|>", mutation_scale=18, color=RIVET, linewidth=2.0)
        ),
        1.0,
    )


def use_style(settings):
    """Fonts, and names inside SVG files that do not change from run to run."""
    settings |= {"svg.hashsalt": "riveted-bearing", "svg.fonttype": "none", "font.family": "sans-serif"}


def main(arguments=None):
    use_style(matplotlib.rcParams)
    parser = argparse.ArgumentParser(description="Draw a bearing.")
    parser.add_argument(
        "--description", type=Path, required=True, help="modelDescription.xml, whose start values are drawn"
    )
    parser.add_argument("--drawing", type=Path, help="file for both views with letters")
    parser.add_argument("--icons", type=Path, help="folder for the icons")
    options = parser.parse_args(arguments)
    mm = dimensions(options.description)
    if options.drawing:
        draw(mm, options.drawing)
    if options.icons:
        write_icons(mm, options.icons)


if __name__ == "__main__":
    main()
