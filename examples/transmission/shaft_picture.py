"""Pictures of the shaft to scale, from its start values: with letters for the documentation, and the FMU's icon.

PYTHONPATH=fmus python examples/transmission/shaft_picture.py --description modelDescription.xml --drawing shaft.svg
--icons FOLDER
"""

import argparse
from pathlib import Path
from xml.etree import ElementTree

import matplotlib
import matplotlib.pyplot as plt
from matplotlib.patches import Rectangle
from picture import BALL, CAGE, INK, RIM, STEEL, arrow, icon, save, use_style

OVERHANG, WIDTH, FACE = 0.35, 0.14, 0.22  # beyond the bearings, of a bearing, of the gear / distance of the bearings


def dimensions(description):
    """Start values of the dimensions [mm]."""
    start = {v.get("name"): v[0].get("start") for v in ElementTree.parse(description).getroot().find("ModelVariables")}
    return {
        letter: 1e3 * float(start[name])
        for letter, name in {"L": "shaft.L", "x": "gear.x", "r": "gear.r_b", "d": "support.d"}.items()
    }


def shaft(ax, mm):
    """Shaft, gear and bearings, bearing A at 0."""
    L, r = mm["L"], mm["d"] / 2
    ax.add_patch(Rectangle((-OVERHANG * L, -0.8 * r), (1 + 2 * OVERHANG) * L, 1.6 * r, facecolor=STEEL, **RIM))
    ax.add_patch(Rectangle((mm["x"] - FACE * L / 2, -mm["r"]), FACE * L, 2 * mm["r"], facecolor=CAGE, **RIM))
    for at in (0.0, L):
        for side in (-1.9 * r, 0.8 * r):
            ax.add_patch(Rectangle((at - WIDTH * L / 2, side), WIDTH * L, 1.1 * r, facecolor=BALL, **RIM))


def draw(mm, path):
    """The drawing with letters."""
    figure, ax = plt.subplots(figsize=(9, 4))
    shaft(ax, mm)
    L, top = mm["L"], mm["r"]
    for at, name in ((0.0, "A"), (L, "B")):
        ax.text(at, -1.35 * mm["d"], name, fontsize=13, ha="center", color=INK)
    arrow(ax, (0.0, -1.1 * top), (mm["x"], -1.1 * top), "$x$")
    arrow(ax, (mm["x"], 1.5 * top), (mm["x"], 1.05 * top), "")
    ax.text(mm["x"] + 0.03 * L, 1.3 * top, "$F_r$, $F_t$, $F_a$", fontsize=11, color=INK)
    ax.text(-OVERHANG * L, 1.1 * mm["d"], r"drive: $k (\omega_d - \omega)$", fontsize=11, color=INK)
    ax.set_aspect("equal")
    ax.autoscale_view()
    ax.axis("off")
    save(figure, path, bbox_inches="tight")


def main():
    use_style(matplotlib.rcParams)
    parser = argparse.ArgumentParser(description="Draw the shaft.")
    parser.add_argument(
        "--description", type=Path, required=True, help="modelDescription.xml, whose start values are drawn"
    )
    parser.add_argument("--drawing", type=Path, required=True, help="file for the drawing with letters")
    parser.add_argument("--icons", type=Path, required=True, help="folder for the icon")
    options = parser.parse_args()
    mm = dimensions(options.description)
    draw(mm, options.drawing)
    options.icons.mkdir(parents=True, exist_ok=True)
    half = (0.5 + OVERHANG) * mm["L"]
    icon(options.icons / "icon.png", lambda ax: shaft(ax, mm), half, centre=mm["L"] / 2)


if __name__ == "__main__":
    main()
