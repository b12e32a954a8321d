"""One picture of a run: loads, pocket force and rivet stress over time, the cage's orbit, and the rivets side by side."""

import textwrap
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.patches import Circle

from ..running.in_run import changes
from ..running.results import Result
from ..running.summary import RPM, breaks, clearance_of_cage, rivet_rows, settled, summary_rows
from .style import FORCE, HEAD, MIDDLE, MUTED, RING, picture

TITLE_WIDTH = 160  # characters of a line over the whole picture
MARK = "_mark"  # label of lines that are no curves
NOTHING = 1e-3  # um; an orbit below a nanometre is a point


def plot_result(result: Result, path: Path) -> Path:
    """Write the picture of a result as PNG, whole or not at all; panels whose channels were not recorded are left out."""
    panels = [(draw, data) for draw, data in ((draw, wanted(result, names)) for draw, names in OVER_TIME) if data]
    with picture(path, (13, 1.2 + 1.65 * max(len(panels), 4)), title(result), 130) as figure:
        left, right = figure.subfigures(1, 2, width_ratios=[2.1, 1])
        if panels:
            heights = [HEIGHTS.get(draw, 1.0) for draw, _ in panels]
            axes = left.subplots(len(panels), 1, sharex=True, squeeze=False, height_ratios=heights)[:, 0]
            for ax, (draw, data) in zip(axes, panels, strict=True):
                draw(ax, 1e3 * result.data["time"], data)
                mark_settling(ax, result)
                show_settled(ax, result)
            axes[-1].set_xlabel("time [ms]")
        orbit_ax, bars_ax = right.subplots(2, 1)
        cage_orbit(orbit_ax, result)
        rivet_bars(bars_ax, result)
    return path


def title(result):
    """Scene, conditions and main figures in a few lines."""
    about, speed = result.about, result.data.get("shaft.omega")
    p = result.parameters
    facts = [f"preload {p['joint.preload']:.4g} N", f"fit {1e6 * p['joint.fit']:+.4g} µm", f"seed {p['start.seed']}"]
    if speed is not None:
        facts.insert(0, f"{RPM * speed[-1]:,.0f} rev/min")
    lines = [": ".join(filter(None, (about.get("scene"), about.get("description")))), " · ".join(facts)]
    figures = [
        f"{row.channel}: mean {row.mean:.3g}, p99.9 {row.p999:.3g} {row.unit}"
        for row in summary_rows(result)
        if row.every_step
    ]
    lines += [" · ".join(figures)] if figures else []
    lines += [f"STOPPED: {result.stopped}"] if result.stopped else []
    return "\n".join(textwrap.fill(line, TITLE_WIDTH) for line in lines)


def wanted(result, names):
    """Those of the named channels that were recorded."""
    return {name: result.data[name] for name in names if name in result.data}


def mark_settling(ax, result):
    """Shade the time that the statistics leave out; a line where a rivet broke, of its place's colour, or parameters changed."""
    end = 1e3 * min(result.parameters.get("start.settle", 0.0), result.data["time"][-1])
    ax.axvspan(0.0, end, color="#f3f4f6", zorder=0)
    ax.margins(x=0.0)
    for _, place, t in breaks(result):
        ax.axvline(1e3 * t, color=HEAD if place == "head" else MIDDLE, lw=0.9, ls="--", label=MARK)
    for t, _ in changes(result):
        ax.axvline(1e3 * t, color=FORCE, lw=1.0, ls=":", label=MARK)


def show_settled(ax, result):
    """Scale a panel by the values after settling; the first shock may exceed the panel."""
    late = settled(result)
    curves = [line for line in ax.get_lines() if line.get_label() != MARK]
    if not curves:  # none of the panel's channels was recorded
        return
    values = np.concatenate([line.get_ydata()[late] for line in curves])
    low, high = values.min(), values.max()
    if high > low:
        margin = 0.08 * (high - low)
        ax.set_ylim(low - margin if low < 0.0 or low > 0.5 * high else 0.0, high + margin)


def legend(ax):
    """The legend above the right end of a panel, its lines thick enough to tell colours."""
    for line in ax.legend(ncols=5, loc="lower right", bbox_to_anchor=(1.0, 1.0)).get_lines():
        line.set_linewidth(2)


def loads(ax, t, data):
    """Loads on the inner ring and, on the right, its speed if that varies."""
    colours = {"shaft.F_y": FORCE, "shaft.F_x": MIDDLE, "shaft.F_z": MUTED, "impact.F_r": HEAD, "impact.F_a": "#e09f3e"}
    for name, values in data.items():
        if name in colours and (name in ("shaft.F_x", "shaft.F_y") or np.any(values)):
            label = name.replace("shaft.", "").replace("impact.", "impact ")
            ax.plot(t, 1e-3 * values, color=colours[name], label=label)
    ax.set(title="Loads on the inner ring", ylabel="kN")
    speed = RPM * data.get("shaft.omega", np.zeros(1))
    if np.ptp(speed):
        twin = ax.twinx()
        twin.plot(t, speed, color=RING, label="speed")
        twin.set_ylabel("rev/min", color=RING)
        twin.grid(False)
    legend(ax)


def pocket_force(ax, t, data):
    """Largest force between a ball and its pocket in each communication step."""
    ax.plot(t, next(iter(data.values())), color=FORCE, lw=0.5)
    ax.set(title="Ball–pocket force, largest in each step", ylabel="N")


def stress(ax, t, data):
    """Largest stress of all rivets in each communication step."""
    for place, colour, label in (("head", HEAD, "head fillet"), ("mid", MIDDLE, "middle of the shank")):
        if (values := data.get(f"rivet.sigma_{place}_max")) is not None:
            ax.plot(t, 1e-6 * values, color=colour, lw=0.5, label=label)
    ax.set(title="Rivet stress, worst rivet, largest in each step", ylabel="MPa")
    legend(ax)


def ring(ax, t, data):
    """Displacement of the inner ring."""
    for (name, values), colour in zip(data.items(), (MIDDLE, FORCE, MUTED), strict=False):
        ax.plot(t, 1e6 * values, color=colour, lw=0.7, label=name.removeprefix("ring."))
    ax.set(title="Displacement of the inner ring", ylabel="µm")
    legend(ax)


def slip(ax, t, data):
    """Slip of the cage: how much slower it turns than by rolling without slip."""
    ax.plot(t, 100 * data["cage.slip_ratio"], color=RING, lw=0.7)
    ax.set(title="Cage slip against the epicyclic speed", ylabel="%")


OVER_TIME = (
    (loads, ("shaft.F_x", "shaft.F_y", "shaft.F_z", "impact.F_r", "impact.F_a", "shaft.omega")),
    (pocket_force, ("cage.F_pocket_peak",)),
    (stress, ("rivet.sigma_head_max", "rivet.sigma_mid_max")),
    (ring, ("ring.x", "ring.y", "ring.z")),
    (slip, ("cage.slip_ratio",)),
)
HEIGHTS = {loads: 0.6, stress: 1.4}


def rivet_bars(ax, result):
    """Mean and 99.9 % quantile of each rivet's stress."""
    ax.set(title="Stress of each rivet: bar p99.9, line mean", xlabel="rivet", ylabel="MPa")
    rivets = rivet_rows(result)
    if not rivets:
        ax.text(0.5, 0.5, "no statistics of rivet stress", ha="center", transform=ax.transAxes)
        return
    for place, colour, label in ((1, HEAD, "head fillet"), (2, MIDDLE, "middle of the shank")):
        x = np.array([row[0] for row in rivets]) + (place - 1.5) * 0.4
        ax.bar(x, [row[place].p999 for row in rivets], width=0.36, color=colour, alpha=0.85, label=label)
        ax.hlines([row[place].mean for row in rivets], x - 0.18, x + 0.18, color="black", lw=1.2)
    ax.set_xticks([row[0] for row in rivets])
    ax.grid(axis="x", visible=False)
    ax.margins(y=0.12)
    ax.legend(ncols=2, loc="upper right")


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


# ----------------------------------------------------------------------------------------------------------- comparison

# [N]
OVERLAID = (("ball[j].Q_i", "Contact loads"), ("ball[j].Q_c", "Pocket loads"), ("rivet[k].V", "Loads of the joints"))


def plot_comparison(found: Any, path: Path) -> Path:
    """Write a Comparison as PNG: outputs of both, differences by tolerance, statistics in deviations."""
    widths = [2.7, 2.7, *([3.6] if found.statistics else [])]  # inches
    with picture(path, (sum(widths), 6.2), f"{found.scene}: FMU (points), Python reference (lines)", 144) as figure:
        grid = figure.add_gridspec(2, len(widths), width_ratios=widths)
        by_name = {channel.name: channel for channel in found.channels}
        for place, (name, title) in zip((grid[0, 0], grid[0, 1], grid[1, 0]), OVERLAID, strict=True):
            overlay(figure.add_subplot(place), 1e3 * found.t, by_name[name], title)
        differences(figure.add_subplot(grid[1, 1]), found)
        if found.statistics:
            deviations(figure.add_subplot(grid[:, 2]), found)
    return path


def overlay(ax, t, channel, title):
    """One output: the reference as lines, the FMU at the scene's tolerance as points."""
    ax.plot(t, channel.reference, color=FORCE, lw=0.8)
    ax.plot(t, channel.fmu, ".", color=HEAD, ms=4)
    ax.set(title=f"{title}, {channel.unit}", xlabel="ms")
    ax.locator_params(nbins=4)


def differences(ax, found):
    """Largest difference of all motion (full lines) and of all loads and stresses (dashed) over time, by tolerance."""
    from ..building.compare import is_motion

    for i, (tolerance, colour) in enumerate(zip(found.tolerances, (HEAD, MIDDLE, RING), strict=True)):
        for motion, style in ((True, "-"), (False, "--")):
            worst = np.max([channel.error[i] for channel in found.channels if is_motion(channel) == motion], axis=0)
            ax.semilogy(1e3 * found.t[1:], worst[1:], style, color=colour, lw=1.2)
        ax.plot([], [], color=colour, label=f"{tolerance:.0e}")
    for style, label in (("-", "motion"), ("--", "loads")):
        ax.plot([], [], style, color=FORCE, label=label)
    ax.locator_params(axis="x", nbins=4)
    ax.set(title="Difference / scale", xlabel="ms")
    ax.legend(ncols=2, loc="upper left", bbox_to_anchor=(0.0, -0.2), columnspacing=1.0)


def deviations(ax, found):
    """Statistics of the reference in standard deviations of the FMU's over seeds."""
    rows = [row for row in found.statistics if np.isfinite(row.deviation)][::-1]
    colours = [MIDDLE if abs(row.deviation) < 3.0 else HEAD for row in rows]
    ax.barh(range(len(rows)), [row.deviation for row in rows], color=colours, height=0.6)
    ax.set_yticks(range(len(rows)), [row.name.removeprefix("stat.") for row in rows])
    ax.locator_params(axis="x", nbins=4)
    limit = max(3.5, 1.1 * max((abs(row.deviation) for row in rows), default=0.0))
    title = f"Reference - FMU, {found.long - found.settle:g} s"
    ax.set(title=title, xlabel="standard deviations", xlim=(-limit, limit))
    ax.axvline(0.0, color=MUTED, lw=0.8)
