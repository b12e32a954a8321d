"""The pictures of docs/performance.md as SVG, and the points of a solver in its records."""

import io
import math
import re

import matplotlib
import numpy as np
from blind import FIGURES as LIMITS
from common import ROOT

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import FormatStrFormatter, LogLocator

PICTURES = ROOT / "docs" / "performance"
BLIND = {  # statistic of a blind scene: its name on the page
    "head_mean": "head stress, mean",
    "head_p999": "head stress, 99.9 %",
    "force_rms": "pocket force, RMS",
    "force_p999": "pocket force, 99.9 %",
    "dislocation": "largest dislocation",
    "torque": "friction torque",
    "land_loss": "loss of the lands",
}
STYLES = {  # family -> colour, marker, line width
    "ours, verlet": ("#0b3c8c", "o", 2.4),
    "ours, explicit": ("#3f83d9", "s", 1.2),
    "Bogacki-Shampine 3(2)": ("#9aa86b", "v", 1.0),
    "Zonneveld 4(3)": ("#6f8f2a", "^", 1.0),
    "Dormand-Prince 5(4)": ("#2f7d32", "P", 1.0),
    "Verner 6(5)": ("#b08d3c", "<", 1.0),
    "Verner 8(7)": ("#7a5c1e", ">", 1.0),
    "CVODE Adams": ("#e08a1e", "X", 1.0),
    "CVODE BDF, dense": ("#c0271f", "s", 1.6),
    "CVODE BDF, diagonal": ("#e36a6a", "D", 1.0),
}
RETIRED = ("CVODE BDF, bordered",)  # in earlier records: docs/notes/sundials_methods.md has its cost
SPARE = [("#555555", "h", 1.2), ("#999999", "p", 1.2), ("#222222", "*", 1.2)]
plt.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "performance", "font.size": 8})
plt.rcParams.update({"axes.grid": True, "grid.alpha": 0.25, "axes.axisbelow": True})


def save(figure, name):
    """A picture as SVG, coordinates to 0.1 pt."""
    text = io.StringIO()
    figure.savefig(text, format="svg", metadata={"Date": None}, bbox_inches="tight")
    plt.close(figure)
    PICTURES.mkdir(parents=True, exist_ok=True)
    (PICTURES / f"{name}.svg").write_text(re.sub(r"(\d\.\d)\d+", r"\1", text.getvalue()))


def read_off(axis):
    """Numbers at 1, 2, 5, 10 ... along a logarithmic axis of costs."""
    axis.yaxis.set(major_locator=LogLocator(subs=(1, 2, 5)), major_formatter=FormatStrFormatter("%g"))
    axis.minorticks_off()


def style(family, families):
    """Colour, marker and width of a family, spare ones for an unknown family."""
    unknown = [name for name in families if name not in STYLES]
    return STYLES[family] if family in STYLES else SPARE[unknown.index(family) % len(SPARE)]


def draw_blind(rows):
    """Run time against error of every scene: the largest bias over its limit."""
    figure, axis = plt.subplots(figsize=(5.2, 3.0))
    for bearing, marker in zip(sorted({row["bearing"] for row in rows}), "os^D", strict=False):
        own = [row["bias"] for row in rows if row["bearing"] == bearing]
        rtf = [bias["seconds"] / bias["time"] for bias in own]
        worst = [max(abs(bias[name]) / LIMITS[name][0] for name in BLIND) for bias in own]
        axis.plot(rtf, np.maximum(worst, 1e-2), marker, markersize=4, alpha=0.7, label=bearing)
    axis.axhline(1.0, color="#c0271f", linewidth=1.2)
    axis.set(xscale="log", yscale="log", xlabel="processor time / simulated time")
    axis.set_ylabel("largest bias / its limit")
    axis.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.xaxis.set_major_formatter(FormatStrFormatter("%g"))
    axis.xaxis.set_minor_formatter("")
    axis.legend(frameon=False)
    save(figure, "blind")


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
    figure, axes = plt.subplots(2, 3, figsize=(10.5, 6.6))
    for axis, scene in zip(axes.flat, data["scenes"].values()):
        rows = scene["states"]["rows"]
        families = families_of(rows)
        for family in families:
            colour, marker, width = style(family, families)
            error, rtf = curve(rows, family).T
            axis.loglog(error, rtf, color=colour, marker=marker, ms=3.5, lw=width, label=family)
        default = row_of(rows, **data["default"])
        axis.loglog(default["error"], default["rtf"], "o", ms=10, mfc="none", mec="#0b3c8c")
        read_off(axis)
        axis.set(
            title=scene["title"], xlabel="error after 2 ms / tolerance scale", ylabel="processor time / simulated time"
        )
    handles, labels = axes.flat[0].get_legend_handles_labels()
    for axis in list(axes.flat)[len(data["scenes"]) :]:
        axis.axis("off")
        axis.legend(handles, labels, loc="center", frameon=False)
    figure.tight_layout()
    save(figure, "work_precision")


def draw_scaling(data):
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(10.5, 3.0))
    Z = np.array([int(z) for z in data["balls"]])
    left.plot(Z, [row["us_per_eval"] for row in data["balls"].values()], "o-", color="#0b3c8c")
    left.set(xlabel="balls", ylabel="µs per evaluation, stepping included", ylim=(0, None))
    steps = [float(step) for step in data["step"]]
    middle.loglog(
        steps, [row["constant"]["rtf"] for row in data["step"].values()], "o-", color="#0b3c8c", label="process"
    )
    middle.loglog(
        steps,
        [row["constant"]["inside"] for row in data["step"].values()],
        "s--",
        color="#3f83d9",
        label="inside the FMU",
    )
    middle.loglog(
        steps,
        [row["changing"]["rtf"] for row in data["step"].values()],
        "^:",
        color="#c0271f",
        label="process, inputs changing",
    )
    middle.set(xlabel="communication step [s]", ylabel="processor time / simulated time")
    read_off(middle)
    middle.legend(frameon=False)
    counts = [int(count) for count in data["outputs"]]
    right.plot(counts, [row["rtf"] for row in data["outputs"].values()], "o-", color="#0b3c8c")
    right.set(xlabel="outputs read every 1e-4 s", ylabel="processor time / simulated time", ylim=(0, None))
    figure.tight_layout()
    save(figure, "scaling")
