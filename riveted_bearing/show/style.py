"""How all pictures look: colours by what a curve shows, matplotlib's settings, and files written whole or not at all."""

from collections.abc import Iterator
from contextlib import contextmanager
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


@contextmanager
def picture(path: Path, size: tuple[float, float], title: str = "", dpi: int = 110) -> Iterator[Any]:
    """A figure [inches] to draw on, with its title, that is then written as PNG, whole or not at all."""
    with plt.rc_context(STYLE):
        figure = plt.figure(figsize=size, layout="constrained")
        if title:
            figure.suptitle(title, x=0.01, ha="left", fontsize=11)
        yield figure
        write_atomically(path, lambda temporary: figure.savefig(temporary, dpi=dpi))
        plt.close(figure)
