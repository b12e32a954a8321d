"""How all pictures look: colours by what a curve shows, matplotlib's settings, and files written whole or not at all."""

from pathlib import Path
from typing import Any

import matplotlib
import numpy as np

matplotlib.use("Agg")

import matplotlib.pyplot as plt

from ..base.files import write_atomically

HEAD, MIDDLE, FORCE, RING, MUTED = "#c8442b", "#2a6f97", "#40495a", "#7a9e3b", "#9aa2ad"
STYLE = {
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#e4e7eb",
    "axes.axisbelow": True,
    "axes.titlesize": 10,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "legend.frameon": False,
    "legend.fontsize": 8,
    "legend.borderpad": 0.0,
    "figure.constrained_layout.w_pad": 0.12,  # inch
    "figure.constrained_layout.h_pad": 0.08,
}


def few_ticks(ax: Any, places: Any) -> None:
    """Label a short logarithmic axis at these places, rounded to two digits, and nowhere else."""
    ticks = np.unique([float(f"{x:.2g}") for x in places])
    ax.set_xticks(ticks, [f"{x:,.0f}" if 1e2 <= x < 1e7 else f"{x:.3g}" for x in ticks])
    ax.xaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())


def save_figure(figure: Any, path: Path, dpi: int = 110) -> Path:
    """Write a figure as PNG, whole or not at all, and close it; returns the path."""
    write_atomically(path, lambda temporary: figure.savefig(temporary, dpi=dpi))
    plt.close(figure)
    return path
