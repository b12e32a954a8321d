"""The report's charts: matplotlib draws them as SVG, whose colours the page sets."""

import html
import io
import re
from dataclasses import replace

import numpy as np
from matplotlib.colors import LogNorm

from ..base.errors import UserError
from ..running.summary import columns, settled
from . import plot, spectrum
from .plot import wanted
from .spectrum import density
from .style import FORCE, HEAD, MIDDLE, MUTED, RING, STYLE, plt

PAGE_COLOURS = {  # of plot.py -> custom properties of style.css
    HEAD: "var(--head)",
    MIDDLE: "var(--middle)",
    FORCE: "var(--force)",
    RING: "var(--green)",
    MUTED: "var(--muted)",
    "#e4e7eb": "var(--line)",
    "#f3f4f6": "var(--shade)",
    "#e09f3e": "var(--amber)",
    "#000000": "var(--ink)",
    "#ffffff": "var(--paper)",
}
SVG = {"svg.fonttype": "none", "image.composite_image": False, "figure.facecolor": "none", "axes.facecolor": "none"}
BUCKETS = 600  # of time, each with the smallest and the largest value
AZIMUTHS = 36
SEGMENT = 32  # fewest samples of a segment of the joints' spectra


def svg(draw, size, label):
    """The figure of draw(figure) as an <svg> without fixed size; size [inch]: 9 points are legible on a phone."""
    with plt.rc_context(STYLE | SVG | {"svg.hashsalt": label}):
        figure = plt.figure(figsize=size, layout="constrained")
        draw(figure)
        out = io.StringIO()
        figure.savefig(out, format="svg", metadata={"Date": None, "Creator": None, "Format": None, "Type": None})
        plt.close(figure)
    text = out.getvalue()
    text = text[text.index("<svg") :]
    for colour, name in PAGE_COLOURS.items():
        text = text.replace(colour, name)
    text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.S)
    text = re.sub(r"font: (\S+) '[^;\"]*", r"font: \1 inherit", text).replace(" inherit", " system-ui, sans-serif")
    text = re.sub(
        r' d="[^"]*"', lambda path: re.sub(r"-?\d+\.\d+", lambda number: f"{float(number[0]):.1f}", path[0]), text
    )
    prefix = re.sub(r"\W+", "-", label)
    text = re.sub(r'(id="|url\(#|href="#)', rf"\g<1>{prefix}-", text)  # ids are shared by all charts of a page
    about = f'role="img" aria-label="{html.escape(label)}" xmlns:xlink="http://www.w3.org/1999/xlink"'
    opening = rf'<svg viewBox="\1" {about}>'
    return re.sub(r'<svg [^>]*?viewBox="([^"]*)"[^>]*>', opening, text, count=1)


def thinned(result, buckets=BUCKETS):
    """The result with the smallest and largest value of each stretch of time, so that no peak is lost."""
    t = result.data["time"]
    if len(t) <= 2 * buckets:
        return result
    first = np.linspace(0, len(t), buckets, endpoint=False).astype(int)
    data = {
        name: np.column_stack([reduce.reduceat(values, first) for reduce in (np.minimum, np.maximum)]).ravel()
        for name, values in result.data.items()
    }
    return replace(result, data=data)


def few_rows(result, names):
    """The result thinned, with the named channels alone."""
    return thinned(replace(result, data={"time": result.data["time"]} | wanted(result, names)))


def over_time(panel):
    """A panel of plot.py alone."""
    draw, names = panel

    def chart(figure, result):
        ax = figure.subplots()
        few = few_rows(result, names)
        draw(ax, 1e3 * few.data["time"], {name: few.data[name] for name in names if name in few.data})
        plot.mark_settling(ax, few)
        plot.show_settled(ax, few)
        ax.set(title="", xlabel="time [ms]")

    return chart


def untitled(draw):
    """A panel of plot.py that draws a whole result, alone."""

    def chart(figure, result):
        ax = figure.subplots()
        draw(ax, result)
        ax.set_title("")

    return chart


def worst_rivet(result):
    """Number, as text, of the rivet with the largest head stress in the run; None if it was not recorded."""
    return rivet_of(result, columns(result, "rivet[", "].sigma_head_peak") or columns(result, "rivet[", "].sigma_head"))


def rivet_of(result, names):
    """Number, as text, of the rivet whose channel has the largest value after settling; None without channels."""
    largest = max(names, key=lambda name: result.data[name][settled(result)].max(), default="")
    return largest.split("]")[0].removeprefix("rivet[") or None


def spectra(figure, result):
    """Amplitude density of head and middle stress of the worst rivet, kinematic frequencies marked."""
    ax, k, late = figure.subplots(), worst_rivet(result), settled(result)
    rate = sample_rate(result)
    for name, colour, label in (("sigma_head", HEAD, "head fillet"), ("sigma_mid", MIDDLE, "middle")):
        values = result.data.get(f"rivet[{k}].{name}")
        if values is not None:
            ax.loglog(*density(1e-6 * values[late], rate), color=colour, lw=0.8, label=label)
    ax.set(
        xlabel=f"frequency [Hz]; {1e-3 * rate:g} samples per ms", ylabel="MPa/√Hz", xlim=(2.0 * rate / 1024, 0.5 * rate)
    )
    ax.tick_params(axis="y", which="minor", labelsize=7)  # 3 and 4 of a decade stay apart
    for name, frequency in frequencies(result).items():
        if ax.get_xlim()[0] < frequency < ax.get_xlim()[1]:
            ax.axvline(frequency, color=MUTED, lw=0.8, ls=":")
            look = {"xycoords": ("data", "axes fraction"), "fontsize": 7, "va": "bottom", "ha": "center"}
            ax.annotate(name, (frequency, 1.0), **look)
    ax.legend(loc="lower left")


def loaded_rivet(result):
    """Number, as text, of the rivet with the largest tension after settling; None if tensions were not recorded."""
    return rivet_of(result, columns(result, "rivet[", "].T"))


def moment_t(result, k):
    """Moment that joint k transmits about the tangential direction [N.m] over time."""
    Z = len(columns(result, "rivet[", "].T"))
    angle = 2.0 * np.pi * (int(k) - 0.5) / Z
    return np.cos(angle) * result.data[f"rivet[{k}].M_z"] - np.sin(angle) * result.data[f"rivet[{k}].M_y"]


def sample_rate(result):
    """Rows per second after settling."""
    t = result.data["time"][settled(result)]
    return (len(t) - 1) / (t[-1] - t[0])


def no_joint_spectra(result):
    """Why the joints' spectra would show none of the vibration modes, "" if they show some."""
    if (late := settled(result).sum()) < SEGMENT:
        return f"{late} samples after settling, at least {SEGMENT} are needed"
    lowest, rate = min(result.about.get("mode_frequencies") or [0.0]), sample_rate(result)
    if 2.0 * lowest < rate:
        return ""
    return f"sampled too coarsely: {1e-3 * rate:.3g} samples per ms, more than {2e-3 * lowest:.3g} are needed for the lowest mode at {1e-3 * lowest:.3g} kHz"


def joint_spectra(figure, result):
    """Amplitude densities of tension and moment of the most loaded joint, with the frequencies of a free half's modes."""
    k, late, rate = loaded_rivet(result), settled(result), sample_rate(result)
    segment = np.clip(late.sum() // 4, SEGMENT, 1024)
    modes = [frequency for frequency in result.about.get("mode_frequencies", ()) if frequency < 0.5 * rate]
    panels = figure.subplots(2, 1, sharex=True)
    loads = (result.data[f"rivet[{k}].T"], FORCE, "T [N/√Hz]"), (1e3 * moment_t(result, k), MIDDLE, "M_t [N·mm/√Hz]")
    for ax, (values, colour, unit) in zip(panels, loads, strict=True):
        f, amplitude = density(values[late], rate, segment)
        ax.plot(1e-3 * f, amplitude, color=colour, lw=0.8)
        ax.set(ylabel=unit)
        ax.set_ylim(bottom=0)
        for frequency in modes:
            ax.axvline(
                1e-3 * frequency, color=HEAD, lw=0.5, label="modes of a free half" if frequency == modes[0] else None
            )
    panels[1].set(xlabel=f"frequency [kHz]; {1e-3 * rate:g} samples per ms", xlim=(0.0, 5e-4 * rate))
    if modes:
        panels[0].legend(loc="lower right", bbox_to_anchor=(1.0, 1.0))


def frequencies(result):
    """Frequencies of shaft, cage and ball passes from the mean speeds of the run [Hz]."""
    if not all(name in result.data for name in ("shaft.omega", "cage.omega")):
        return {}
    speeds = {name: spectrum.speed_of(result, name, settled(result)) for name in spectrum.SPEEDS}
    found = spectrum.kinematic_frequencies(result, speeds, orders=False)
    return {"cage": found["FTF"]} | {name: found[name] for name in ("shaft", "BPFO", "BPFI")}


def azimuth_of(result, kind, j, Z):
    """Azimuth of ball j or of rivet j over time in turns 0 ... 1."""
    if kind == "ball":
        return result.data[f"ball[{j}].psi"] / (2 * np.pi) % 1.0
    return (result.data["half_0.psi"] / (2 * np.pi) + (j - 0.5) / Z) % 1.0


def load_distribution(figure, result):
    """Mean, smallest and largest race loads over the azimuth, all balls pooled."""
    ax, late = figure.subplots(), settled(result)
    Z = len(columns(result, "ball[", "].psi"))
    place = np.concatenate([azimuth_of(result, "ball", j, Z)[late] for j in range(1, Z + 1)])
    bins = ((place + 0.5) % 1.0 * AZIMUTHS).astype(int)
    middle = 360.0 * ((np.arange(AZIMUTHS) + 0.5) / AZIMUTHS - 0.5)
    for name, colour, label in (("Q_e", FORCE, "outer race"), ("Q_i", MIDDLE, "inner race")):
        load = np.concatenate([result.data[f"ball[{j}].{name}"][late] for j in range(1, Z + 1)])
        low, mean, high = (by_bin(load, bins, AZIMUTHS, reduce) for reduce in (np.min, np.mean, np.max))
        ax.fill_between(middle, low, high, color=colour, alpha=0.2, lw=0)
        ax.plot(middle, mean, color=colour, label=label)
    ax.set(xlabel="azimuth from Y toward Z [deg]", ylabel="N", xlim=(-180, 180), xticks=range(-180, 181, 90))
    ax.set_ylim(bottom=0)
    plot.legend(ax)


def by_bin(values, bins, count, reduce):
    """Values reduced bin by bin, nan where a bin is empty."""
    return np.array([reduce(values[bins == b]) if np.any(bins == b) else np.nan for b in range(count)])


def section_sizes(p):
    """Radii and half widths of the section [mm]: grooves, shoulders, bore and outside (0: usual), cage."""
    mm = {name: 1e3 * p[f"bearing.{name}"] for name in ("D", "d_m", "P_d")}
    bottom = [0.5 * mm["d_m"] + side * (0.5 * mm["D"] + 0.25 * mm["P_d"]) for side in (-1, 1)]
    ribbon = p.get("cage.shape") == "ribbon"
    return {
        "r_i": bottom[0],
        "r_e": bottom[1],
        "shoulder_i": bottom[0] + p["bearing.h_i"] * mm["D"],
        "shoulder_e": bottom[1] - p["bearing.h_e"] * mm["D"],
        "bore": 0.5 * (1e3 * p.get("ring.bore", 0.0) or mm["d_m"] - mm["D"] / 0.6),
        "outside": 0.5 * (1e3 * p.get("ring.outside", 0.0) or mm["d_m"] + mm["D"] / 0.6),
        "D_o": 500.0 * p["cage.D_o"],
        "D_i": 500.0 * p["cage.D_i"],
        "half": 1e3 * (p["cage.pocket_depth"] + p["cage.sheet"]) if ribbon else 500.0 * p["cage.width"],
    }


def section(figure, result):
    """Section through a ball, above the axis, with its dimensions; the rings' width is not in the model."""
    p = result.parameters
    ax, size, D, d_m = figure.subplots(), section_sizes(p), 1e3 * p["bearing.D"], 1e3 * p["bearing.d_m"]
    end = max(0.75 * D, 1.15 * size["half"])
    x = np.linspace(-end, end, 401)
    for ring, side, back in (("i", -1, "bore"), ("e", 1, "outside")):
        groove = p[f"bearing.f_{ring}"] * D
        arc = side * (np.sqrt(np.maximum(groove**2 - x**2, 0.0)) - groove)  # from the groove's bottom
        face = size[f"r_{ring}"] + np.where(np.abs(x) < groove, arc, -side * D)
        face = side * np.maximum(side * face, side * size[f"shoulder_{ring}"])
        ax.fill_between(x, face, size[back], facecolor=MUTED, alpha=0.45, lw=0.0)
        ax.plot(x, face, color=FORCE, lw=1.0)
        ax.plot([-end, end], [size[back]] * 2, color=FORCE, lw=1.0)
    corner, height = (-size["half"], size["D_i"]), size["D_o"] - size["D_i"]
    ax.add_patch(
        plt.Rectangle(corner, 2.0 * size["half"], height, facecolor="#e09f3e", alpha=0.5, edgecolor=FORCE, lw=1.0)
    )
    ax.add_patch(plt.Circle((0.0, 0.5 * d_m), 0.5 * D, facecolor="white", edgecolor=FORCE, lw=1.0, zorder=3))
    ax.plot([-1.1 * end, 1.1 * end], [0.5 * d_m] * 2, color=MUTED, lw=0.7, ls="-.", zorder=4)
    ax.text(0.0, 0.5 * d_m + 0.12 * D, f"ball {D:.5g}", ha="center", fontsize=8, zorder=5)
    if p.get("cage.shape") != "ribbon":
        ax.plot([0.0, 0.0], [size["D_i"], size["D_o"]], color=FORCE, lw=0.6, ls=":", zorder=4)
    marks = [(1, size["bore"], "bore"), (1, size["outside"], "outside"), (1, 0.5 * d_m, "pitch")]
    for side, radius, text in [*marks, (-1, size["D_o"], "cage"), (-1, size["D_i"], "cage")]:
        ax.plot([side * (size["half"] if side < 0 else end), side * 1.18 * end], [radius] * 2, color=FORCE, lw=0.5)
        place = "left" if side > 0 else "right"
        given = text not in ("bore", "outside") or p.get(f"ring.{text}", 0.0)
        shown = f"ø{2.0 * radius:.5g}" if given else f"≈ ø{2.0 * radius:.2g}"
        ax.text(side * 1.22 * end, radius, f"{text} {shown}", ha=place, va="center", fontsize=8)
    low = size["bore"] - 0.16 * D
    ax.annotate(
        "", (-size["half"], low), (size["half"], low), arrowprops={"arrowstyle": "<->", "color": FORCE, "lw": 0.7}
    )
    for edge in (-size["half"], size["half"]):
        ax.plot([edge, edge], [low, size["D_i"]], color=FORCE, lw=0.5, ls=":")
    ax.text(0.0, low - 0.05 * D, f"cage {2.0 * size['half']:.5g}", ha="center", va="top", fontsize=8)
    ax.set(xlim=(-2.0 * end, 2.0 * end), ylim=(low - 0.3 * D, size["outside"] + 0.08 * D), aspect="equal")
    ax.axis("off")


def force_histogram(figure, result):
    """Share of time over contact loads: pockets, then races."""
    pockets, races = figure.subplots(1, 2)
    late = settled(result)
    force = np.concatenate([result.data[name][late] for name in columns(result, "ball[", "].Q_c")])
    touching = force[force > 1e-3]
    if len(touching):
        bins = np.geomspace(max(touching.min(), 1e-3), touching.max() * 1.001, 40)
        pockets.hist(touching, bins, weights=np.full(len(touching), 100.0 / len(force)), color=FORCE, alpha=0.85)
        pockets.set_xscale("log")
    title = f"touching {100 * len(touching) / len(force):.1f} %"
    pockets.set(xlabel="pocket force [N]", ylabel="share of time [%]", title=title)
    for name, colour, label in (("Q_e", FORCE, "outer"), ("Q_i", MIDDLE, "inner")):
        names = columns(result, "ball[", f"].{name}")
        if names:
            load = np.concatenate([result.data[n][late] for n in names])
            share = np.full(len(load), 100.0 / len(load))
            races.hist(load, 40, weights=share, histtype="step", color=colour, label=label)
    races.set(xlabel="race load [N]")
    races.set_yscale("log")
    races.legend(ncols=2, loc="lower right", bbox_to_anchor=(1.0, 1.0))
    for ax in (pockets, races):
        ax.tick_params(labelsize=8)


def stress_over_azimuth(figure, result):
    """Mean peak of the head stress, rivet by rivet, over the rivet's azimuth."""
    late, names = settled(result), columns(result, "rivet[", "].sigma_head_peak")
    Z, rows = len(names), []
    for k, name in enumerate(names, 1):
        bins = ((azimuth_of(result, "rivet", k, Z)[late] + 0.5) % 1.0 * AZIMUTHS).astype(int)
        rows.append(by_bin(1e-6 * result.data[name][late], bins, AZIMUTHS, np.mean))
    heat_map(figure, rows, (-180, 180), "azimuth of the rivet from Y toward Z [deg]", range(-180, 181, 90))


def stress_over_time(figure, result):
    """Largest head stress of each rivet in stretches of time, on the scale of the settled run."""
    names, t = columns(result, "rivet[", "].sigma_head_peak"), result.data["time"]
    first = np.unique(np.linspace(0, len(t), 240, endpoint=False).astype(int))
    rows = [1e-6 * np.maximum.reduceat(result.data[name], first) for name in names]
    highest = 1e-6 * max(result.data[name][settled(result)].max() for name in names)
    heat_map(figure, np.minimum(rows, highest), (0.0, 1e3 * t[-1]), "time [ms]")


def heat_map(figure, rows, extent, xlabel, ticks=None):
    """One row a rivet, in MPa."""
    ax, count = figure.subplots(), len(rows)
    field(figure, ax, rows, (*extent, 0.5, count + 0.5), "MPa")
    ax.set(xlabel=xlabel, ylabel="rivet", yticks=range(1, count + 1, 1 + count // 12))
    if ticks:
        ax.set_xticks(ticks)


def field(figure, ax, rows, ends, label, **options):
    """Numbers as colours between the ends (left, right, lower, upper), with their scale."""
    look = {"aspect": "auto", "origin": "lower", "cmap": "viridis", "interpolation": "none"}
    image = ax.imshow(rows, extent=ends, **look, **options)
    ax.grid(False)
    figure.colorbar(image, ax=ax, label=label, pad=0.02).outline.set_visible(False)


def rainflow_matrix(figure, cycles):
    """Cycles of a rivet over range and mean [MPa]; cycles: rows (range, mean, count)."""
    ax = figure.subplots()
    span, mean, count = np.asarray(cycles).T
    keep = span > 0.0
    x, y = np.linspace(0.0, max(span.max(), 1e-3), 33), np.linspace(mean.min(), max(mean.max(), mean.min() + 1e-3), 25)
    table, *_ = np.histogram2d(mean[keep], span[keep], [y, x], weights=count[keep])
    ends, norm = (x[0], x[-1], y[0], y[-1]), LogNorm(0.5, max(table.max(), 1.0))
    field(figure, ax, np.where(table > 0, table, np.nan), ends, "cycles", norm=norm)
    ax.set(xlabel="range [MPa]", ylabel="mean [MPa]")


def energy(figure, result):
    """Power loss and the residual of the energy balance."""
    ax = figure.subplots()
    few = few_rows(result, ["bearing.power_loss", "bearing.energy_residual"])
    ax.plot(1e3 * few.data["time"], few.data["bearing.power_loss"], color=RING, lw=0.6, label="power loss")
    ax.set(xlabel="time [ms]", ylabel="W")
    if "bearing.energy_residual" in few.data:
        twin = ax.twinx()
        twin.plot(1e3 * few.data["time"], 1e3 * few.data["bearing.energy_residual"], color=HEAD, lw=0.8)
        twin.set_ylabel("energy residual [mJ]", color=HEAD)
        twin.grid(False)
    plot.mark_settling(ax, few)
    plot.legend(ax)


def vibrates(result):
    """Whether a race is not perfect, a ball has a spall or the housing sits on springs: then the page shows the vibration."""
    p = result.parameters
    surfaces = (value for name, value in p.items() if re.match(r".*\.spall_length$|\w+\.waviness\[", name))
    return p.get("housing.motion") == "supported" or any(surfaces)


def no_vibration(result):
    """Why there is no spectrum of the vibration, in words; nothing if there is one."""
    try:
        spectrum.spectra(result)
    except UserError as problem:
        return html.escape(str(problem).removeprefix("spectrum: "))
    return ""


def vibration(figure, result):
    """Spectrum and envelope spectrum with the kinematic frequencies."""
    spectrum.draw(figure, spectrum.spectra(result))
