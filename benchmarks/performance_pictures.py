"""The pictures of docs/performance.md as SVG, and the points of a solver in its records."""

import math

import matplotlib
import numpy as np
from blind import FIGURES as LIMITS
from common import ROOT
from svg import save_svg

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.ticker import FormatStrFormatter, FuncFormatter, LogLocator

PICTURES = ROOT / "docs" / "performance"
SHORT = {"demo": "working point", "slow": "4,000 r/min", "tilt": "tilt 0.5°", "impact": "impacts", "jam": "jam"}
BLIND = {  # statistic of a blind scene: its name on the page
    "head_mean": "head stress, mean",
    "head_p999": "head stress, 99.9 %",
    "force_rms": "pocket force, RMS",
    "force_p999": "pocket force, 99.9 %",
    "dislocation": "largest dislocation",
    "torque": "friction torque",
    "land_loss": "loss of the lands",
}
OURS = "#0b3c8c"
NAMES = {"RivetedBearing": "6207"}  # file of a bearing -> name on the page
KUTTA = {"color": "#7f8f4a", "lw": 0.8}
STYLES = {  # family -> line
    "Bogacki-Shampine 3(2)": KUTTA,
    "Zonneveld 4(3)": KUTTA,
    "Dormand-Prince 5(4)": KUTTA,
    "Verner 6(5)": KUTTA,
    "Verner 8(7)": KUTTA,
    "CVODE Adams": {"color": "#d97b00", "lw": 1.2},
    "CVODE BDF, dense": {"color": "#c0271f", "lw": 1.6},
    "CVODE BDF, diagonal": {"color": "#c0271f", "lw": 1.4, "ls": (0, (2, 1.5))},
    "ours, explicit": {"color": "#3f83d9", "lw": 1.4},
    "ours, fixed": {"color": "#111111", "marker": "*", "ms": 8, "ls": "none"},
    "ours, verlet": {"color": OURS, "lw": 2.6},
}
KEY = {  # words under the panels -> family of that line
    "ours, Verlet": "ours, verlet",
    "ours, explicit": "ours, explicit",
    "ours, fixed step": "ours, fixed",
    "Runge–Kutta": "Verner 6(5)",
    "Adams": "CVODE Adams",
    "BDF, dense": "CVODE BDF, dense",
    "BDF, diagonal": "CVODE BDF, diagonal",
}
RETIRED = ("CVODE BDF, bordered",)  # in earlier records: docs/notes/sundials_methods.md has its cost
SPARE = {"color": "#777777", "lw": 1.0, "ls": ":"}  # of a family without a line of its own
# A page shows a picture 390 pixels wide on a telephone: letters of 10 points in a figure of 5.4 inches have 10 pixels there.
WIDTH = 5.4  # inches
plt.rcParams.update({"font.size": 10, "axes.titlesize": 11, "axes.titleweight": "bold", "axes.titlelocation": "left"})
plt.rcParams.update({"axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False})
plt.rcParams.update({"axes.grid": True, "grid.alpha": 0.25, "axes.axisbelow": True})


def read_off(axis):
    """Numbers at 1, 2, 5, 10 ... along a logarithmic axis of costs."""
    axis.yaxis.set(major_locator=LogLocator(subs=(1, 2, 5)), major_formatter=FormatStrFormatter("%g"))
    axis.minorticks_off()


def draw_blind(rows):
    """Run time against error of every scene: the largest bias over its limit."""
    figure, axis = plt.subplots(figsize=(WIDTH, 3.6), layout="constrained")
    for bearing, marker in zip(sorted({row["bearing"] for row in rows}), "os^D", strict=False):
        own = [row["bias"] for row in rows if row["bearing"] == bearing]
        rtf = [bias["seconds"] / bias["time"] for bias in own]
        worst = [max(abs(bias[name]) / LIMITS[name][0] for name in BLIND) for bias in own]
        label = NAMES.get(bearing, bearing)
        axis.plot(rtf, np.maximum(worst, 1e-2), marker, markersize=5, alpha=0.7, label=label)
    axis.axhline(1.0, color="#c0271f", linewidth=1.2)
    axis.set(xscale="log", yscale="log", xlabel="processor time / simulated time")
    axis.set_title("largest bias / its limit", pad=26)
    axis.xaxis.set(major_locator=LogLocator(subs=(1.0, 2.0, 5.0)), major_formatter=FormatStrFormatter("%g"))
    axis.yaxis.set(major_locator=LogLocator(), major_formatter=FormatStrFormatter("%g"))
    axis.minorticks_off()
    axis.legend(ncols=3, loc="lower left", bbox_to_anchor=(0.0, 1.0), borderpad=0.0, handletextpad=0.1)
    save_svg(figure, PICTURES / "blind.svg")


def families_of(rows):
    """Names of the solvers in some rows."""
    return [family for family in dict.fromkeys(r["family"] for r in rows) if family not in RETIRED]


def curve(rows, family):
    """Errors and RTFs of one family by tolerance."""
    own = [r for r in sorted(rows, key=lambda r: r["tolerance"]) if r["family"] == family and "error" in r]
    points = [(r["error"], r["rtf"]) for r in own]
    return np.array(points).reshape(-1, 2)


def row_of(rows, family, tolerance):
    own = (r for r in rows if r["family"] == family and math.isclose(r["tolerance"], tolerance) and "rtf" in r)
    return next(own, None)


def draw_work_precision(data):
    """Run time against error of every solver, a panel a scene; all panels have the same axes."""
    figure, axes = plt.subplots(3, 2, figsize=(WIDTH, 7.2), sharex=True, sharey=True, layout="constrained")
    *panels, rest = axes.flat
    for axis, (name, scene) in zip(panels, data["scenes"].items(), strict=True):
        rows = scene["states"]["rows"]
        for family in families_of(rows)[::-1]:  # ours above the others
            error, rtf = curve(rows, family).T
            axis.loglog(error, rtf, **STYLES.get(family, SPARE))
        default = row_of(rows, **data["default"])
        axis.loglog(default["error"], default["rtf"], "o", ms=11, mfc="none", mec=OURS)
        axis.set_title(SHORT[name])
        axis.set(xlim=(3e-8, 3.0), xticks=[1e-6, 1e-3, 1.0], yticks=[0.3, 1, 3, 10, 30])
        axis.yaxis.set_major_formatter(FormatStrFormatter("%g"))
        axis.minorticks_off()
    panels[-2].xaxis.set_tick_params(labelbottom=True)
    rest.axis("off")
    lines = [Line2D([], [], **STYLES[family]) for family in KEY.values()]
    rest.legend(lines, KEY, loc="center", fontsize=10, handlelength=1.6, borderpad=0.0)
    figure.supxlabel("error after 2 ms / tolerance scale", fontsize=10)
    figure.supylabel("processor time / simulated time", fontsize=10)
    save_svg(figure, PICTURES / "work_precision.svg")


def draw_scaling(data):
    """Cost over the communication step, the balls and the outputs."""
    figure, axes = plt.subplot_mosaic(
        [["step", "step"], ["balls", "outputs"]], figsize=(WIDTH, 5.6), layout="constrained"
    )
    steps = np.array([float(step) for step in data["step"]])
    for kind, key, name, line in (
        ("changing", "rtf", "changing inputs", {"color": "#c0271f", "marker": "^", "ls": ":"}),
        ("constant", "rtf", "constant inputs", {"color": OURS, "marker": "o"}),
        ("constant", "inside", "inside the FMU", {"color": "#3f83d9", "marker": "s", "ls": "--"}),
    ):
        axes["step"].loglog(1e6 * steps, [row[kind][key] for row in data["step"].values()], label=name, **line)
    axes["step"].set(title="RTF: processor time / simulated time", xlabel="communication step, µs")
    axes["step"].xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,.0f}"))
    axes["step"].legend()
    read_off(axes["step"])
    shown = (
        ("balls", "µs an evaluation", "balls", "us_per_eval"),
        ("outputs", "RTF", "outputs read each 0.1 ms", "rtf"),
    )
    for name, title, label, key in shown:
        counts = [int(count) for count in data[name]]
        axes[name].plot(counts, [row[key] for row in data[name].values()], "o-", color=OURS)
        axes[name].set(title=title, xlabel=label, xlim=(0, None), ylim=(0, None))
        axes[name].locator_params(nbins=4)
    save_svg(figure, PICTURES / "scaling.svg")
