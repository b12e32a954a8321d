"""The orbit of the cage's centre: its path in the clearance that lets the cage move, magnified where it is small."""

import numpy as np
from matplotlib.patches import Circle

from ..running.summary import clearance_of_cage, settled
from .style import FORCE, MUTED

NOTHING = 1e-3  # um; an orbit below a nanometre is a point


def cage_orbit(ax, result):
    """Path of the cage's centre within its guide clearance."""
    kind = clearance_of_cage(result.parameters)
    label = f"y [µm]; dashed: {kind} clearance"
    ax.set(title="Orbit of the cage's centre, from +X", xlabel=label, ylabel="z [µm]", aspect="equal")
    if not {"cage.y", "cage.z"} <= result.data.keys():
        ax.text(0.5, 0.5, "cage.y and cage.z were not recorded", ha="center", transform=ax.transAxes)
        return
    late = settled(result)
    y, z = 1e6 * result.data["cage.y"][late], 1e6 * result.data["cage.z"][late]
    clearance = 1e6 * result.parameters[f"cage.{kind}_clearance"] / 2
    ax.add_patch(Circle((0, 0), clearance, fill=False, color=MUTED, ls="--", lw=1))
    ax.plot(y, z, color=FORCE, lw=0.35, alpha=0.7)
    limit = 1.08 * max(clearance, np.abs(y).max(), np.abs(z).max())
    ax.set(xlim=(-limit, limit), ylim=(-limit, limit))
    size = max(np.ptp(y), np.ptp(z))
    if NOTHING < size < 0.5 * clearance:
        magnified(ax, y, z, 0.6 * size)


def magnified(ax, y, z, half):
    """The orbit magnified in the corner that is farthest from it: a square of the given half width [um]."""
    centre = (y.max() + y.min()) / 2, (z.max() + z.min()) / 2
    left, lower = centre[0] >= 0.0, centre[1] >= 0.0
    inset = ax.inset_axes([0.0 if left else 0.64, 0.0 if lower else 0.64, 0.36, 0.36])
    inset.yaxis.set_ticks_position("right" if left else "left")  # to the inside
    inset.xaxis.set_ticks_position("top" if lower else "bottom")
    inset.spines[:].set_visible(True)
    inset.plot(y, z, color=FORCE, lw=0.35, alpha=0.8)
    x, y = ((middle - half, middle + half) for middle in centre)
    inset.set(xlim=x, ylim=y, aspect="equal", facecolor="#ffffff")
    inset.tick_params(labelsize=7)
    ax.indicate_inset_zoom(inset, edgecolor=MUTED)
