"""Writes docs/performance.md and its pictures from the newest records in benchmarks/results/; measures nothing."""

import contextlib
import io
import itertools
import math
import re

import matplotlib
import numpy as np
from blind import FIGURES as LIMITS
from common import ROOT
from records import newest_record

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import FormatStrFormatter, LogLocator

PAGE, PICTURES = ROOT / "docs" / "performance.md", ROOT / "docs" / "performance"
GOALS = {"demo": 0.5, "slow": 0.6, "tilt": 1.0, "jam": 1.2}  # real-time factors
SHORT = {"demo": "working point", "slow": "4,000 r/min", "tilt": "tilt 0.5°", "impact": "impacts", "jam": "jam"}
FIGURES = {  # the nine statistics: column title
    "Q_c_mean": "force mean",
    "Q_c_rms": "RMS",
    "Q_c_p999": "p99.9",
    "sigma_head_mean": "head mean",
    "sigma_head_rms": "RMS",
    "sigma_head_p999": "p99.9",
    "sigma_mid_mean": "middle mean",
    "sigma_mid_rms": "RMS",
    "sigma_mid_p999": "p99.9",
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
    "CVODE BDF, bordered": ("#8e1b5a", "o", 1.0),
}
SPARE = [("#555555", "h", 1.2), ("#999999", "p", 1.2), ("#222222", "*", 1.2)]
plt.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "performance", "font.size": 8})
plt.rcParams.update({"axes.grid": True, "grid.alpha": 0.25, "axes.axisbelow": True})


def section(title, name, write):
    """A chapter of the page from the record of a benchmark, or the command that measures it."""
    try:
        return f"## {title}\n\n{write(newest_record(name))}"
    except FileNotFoundError:
        return f"## {title}\n\nNot measured here: `python benchmarks/{name}.py` does it.\n"


def table(head, rows):
    """Lines of a table: first column left, the others right."""
    lines = ["| " + " | ".join(head) + " |", "|---" + "|---:" * (len(head) - 1) + "|"]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows])


def number(value, digits=2):
    """A few significant digits; — for a missing value."""
    if value is None or not math.isfinite(value):
        return "—"
    if value == 0.0:
        return "0"
    decimals = max(0, digits - 1 - math.floor(math.log10(abs(value))))
    return f"{value:,.{decimals}f}" if abs(value) >= 1e-3 else f"{value:.0e}"


def percent(figure):
    """Error ± half-width in per cent."""
    return f"{100 * figure['error']:+.2f}±{100 * figure['half_width']:.2f}"


def origin(data):
    form = "short form" if data["short"] else "full form"
    machine, compiler = data["machine"], re.sub(r" \(.*\)", "", data["machine"]["compiler"])
    return f"{form}, {data['date'][:10]}, commit {data['commit']}, {machine['processor']}, {compiler}"


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


# -------------------------------------------------------------------------------------------------------- blind scenes

BLIND = {  # figure: what it is called here
    "head_mean": "head stress, mean",
    "head_p999": "head stress, 99.9 %",
    "force_rms": "pocket force, RMS",
    "force_p999": "pocket force, 99.9 %",
    "dislocation": "largest dislocation",
    "torque": "friction torque",
    "land_loss": "loss of the lands",
}


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


def blind(data):
    rows = [row for row in data["rows"] if "failed" not in row]
    draw_blind(rows)
    cells = [
        [BLIND[name], f"{100 * LIMITS[name][0]:g}"]
        + [f"{100 * data['figures'][name][key]:.2f}" for key in ("median", "p95", "worst")]
        + [data["figures"][name]["beyond"]]
        for name in BLIND
    ]
    return f"""{origin(data)}.

{data["scenes"]} scenes from the whole design space (`benchmarks/blind.py {data["scene_seeds"]} ...`); the default against tolerance 1e-4 in steps
of 3 µs on common seeds. A bias is beyond its limit and its 95 % interval in {data["beyond"]}, beyond twice the limit in
{data["beyond_twice"]}; {data["undecided"]} are undecided, {data["failed"]} failed. Median RTF {data["rtf"]:.2f}.

{table(["absolute bias, %", "limit", "median", "95 %", "worst", "scenes beyond"], cells)}

![Run time against error of every scene](performance/blind.svg)
"""


# ------------------------------------------------------------------------------------------------- work and precision


def curve(rows, family):
    """Errors and RTFs of one family by tolerance."""
    own = [r for r in sorted(rows, key=lambda r: r["tolerance"]) if r["family"] == family and "error" in r]
    points = [(r["error"], r["rtf"]) for r in own]
    return np.array(points).reshape(-1, 2)


def cheapest(rows, family, error):
    """Least RTF of a family at this error or below, linear in logarithms; None if it never reaches it."""
    points = curve(rows, family)
    if not len(points) or points[:, 0].min() > error:
        return None
    best = points[points[:, 0] <= error, 1].min()
    for (e1, c1), (e2, c2) in itertools.pairwise(points):
        if min(e1, e2) <= error <= max(e1, e2) and e1 != e2:
            part = math.log(error / e1) / math.log(e2 / e1)
            best = min(best, math.exp(math.log(c1) + part * math.log(c2 / c1)))
    return best


def row_of(rows, family, tolerance):
    own = (r for r in rows if r["family"] == family and math.isclose(r["tolerance"], tolerance) and "rtf" in r)
    return next(own, None)


def draw_work_precision(data):
    figure, axes = plt.subplots(2, 3, figsize=(10.5, 6.6))
    for axis, scene in zip(axes.flat, data["scenes"].values()):
        rows = scene["states"]["rows"]
        families = list(dict.fromkeys(r["family"] for r in rows))
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


def cost_ratio(data, scene, family):
    """Cost of a family / the default's, at the default's error; None if the family never reaches it."""
    rows = scene["states"]["rows"]
    ours = row_of(rows, **data["default"])
    cost = cheapest(rows, family, ours["error"])
    return cost / ours["rtf"] if cost else None


def python_ratio(data, scene):
    """Cost of the cheapest Python solver / the default's, at the default's error; None if none reaches it."""
    ours, rows = row_of(scene["states"].get("python_ours", []), **data["default"]), scene["states"]["python"]
    costs = [cheapest(rows, family, ours["error"]) for family in dict.fromkeys(r["family"] for r in rows)]
    costs = [cost for cost in costs if cost]
    return min(costs) / ours["rtf"] if costs else None


def ratio(value):
    """A ratio of costs."""
    if not value:
        return "never"
    return f"{value:,.0f}×" if value >= 10.0 else f"{value:.1f}×"


def largest_error(data, scene):
    """The largest of the nine statistical errors of the default and its name."""
    figures = row_of(scene["statistics"]["rows"], **data["default"])["figures"]
    name, figure = max(figures.items(), key=lambda item: abs(item[1]["error"]))
    return f"{percent(figure)} ({name})"


def headline(data):
    """The goals that are set scene by scene, and the values reached."""
    elastic, rigid = (newest_record("rtf")["cages"][cage] for cage in ("elastic", "two_half"))
    rows = [
        [
            SHORT[name],
            f"≤ {GOALS[name]:g}" if name in GOALS else "—",
            f"{number(elastic[name]['rtf'])} ({number(elastic[name]['inside'])})",
            f"{number(rigid[name]['rtf'])} ({number(rigid[name]['inside'])})",
            largest_error(data, scene),
            ratio(cost_ratio(data, scene, "CVODE BDF, dense")),
            ratio(python_ratio(data, scene)) if scene["states"]["python"] else "—",
        ]
        for name, scene in data["scenes"].items()
    ]
    head = ["scene", "RTF, goal", "RTF", "rigid halves", "largest statistical error, %"]
    return table([*head, "BDF dense at equal error", "Python at equal error"], rows)


def costs_table(data):
    """Cost of every family at the default's error, over the default's."""
    scenes = data["scenes"]
    families = dict.fromkeys(r["family"] for r in next(iter(scenes.values()))["states"]["rows"])
    others = [family for family in families if family != data["default"]["family"]]
    rows = [[family, *[ratio(cost_ratio(data, scene, family)) for scene in scenes.values()]] for family in others]
    ours = [row_of(scene["states"]["rows"], **data["default"]) for scene in scenes.values()]
    rows += [
        ["**default**: RTF", *[number(row["rtf"]) for row in ours]],
        ["error", *[f"{row['error']:.0e}" for row in ours]],
    ]
    return table(["method", *[SHORT[name] for name in scenes]], rows)


def python_text(data):
    """Costs of SciPy's solvers on the Python twin, beside the default's over the same horizon."""
    scene = next(scene for scene in data["scenes"].values() if scene["states"]["python"])
    rtf = {r["family"].removeprefix("Python "): r["rtf"] for r in scene["states"]["python"]}
    ours = row_of(scene["states"]["python_ours"], **data["default"])
    return (
        f"SciPy's solvers ({', '.join(rtf)}) on the Python twin at tolerance 0.001 need RTF\n"
        f"{min(rtf.values()):,.0f} to {max(rtf.values()):,.0f} at the working point, extrapolated from 0.5 ms. "
        f"The default needs {number(ours['rtf'])}."
    )


def work_precision(data):
    draw_work_precision(data)
    first = next(iter(data["scenes"].values()))
    doubt = max(scene["states"]["reference_doubt"] for scene in data["scenes"].values())
    default = data["default"]
    return f"""{origin(data)}.

{headline(data)}

RTF: processor time / simulated time on one core, through fmpy with 1e-4 s communication steps and peak stress read at
each. In brackets: inside the FMU. Goals: statistical error ≤ 1 %, BDF ≥ 10×, Python ≥ 100×.

![Run time against error of every solver](performance/work_precision.svg)

Ring: the default, {default["family"].partition(", ")[2]} at {default["tolerance"]:g}.
All solvers start from the same settled states (mean of {first["states"]["starts"]}), without stress.
The error after 2 ms is the RMS over all states of error/(tolerance scale)
([method.md](method.md#error-norm-and-step-size)).
The reference is Dormand–Prince at 1e-10; Verner 6(5) at 1e-10 deviates by {doubt:.0e}.
BDF's Jacobian is by differences (*dense*, the stand-in for the paper's GSTIFF), the diagonal of damping rates, or
bordered block diagonal.

Cost at the default's error over the default's cost:

{costs_table(data)}

{python_text(data)}
"""


# ---------------------------------------------------------------------------------------------------- right-hand side


def element_rows(scene, sets):
    """Rows of the elements, those below 3 % of the scalar evaluation summed up."""
    times = {isa: scene["sets"][isa]["elements"] for isa in sets}
    large = [name for name, ns in times["scalar"].items() if ns >= 0.03 * scene["sets"]["scalar"]["rhs"]]
    rows = [[f"– {name}", *[f"{times[isa][name]:,.0f}" for isa in sets]] for name in large]
    rest = [sum(ns for name, ns in times[isa].items() if name not in large) for isa in sets]
    return [*rows, ["– others", *[f"{ns:,.0f}" for ns in rest]]] if any(rest) else rows


def rhs(data):
    """One evaluation: times by element and instruction set, and the floor of its instructions."""
    sets = list(data["peaks"])
    rows = []
    for scene in data["scenes"].values():
        times = [scene["sets"][isa]["rhs"] for isa in sets]
        title = scene["title"].removesuffix(", 18,238 r/min")
        rows.append([f"**{title}**, {scene['pockets_touched']:.1f} contacts", *[f"**{ns:,.0f}**" for ns in times]])
        if len(rows) > 1:
            continue
        rows.append(["against scalar", *[f"{scene['sets']['scalar']['rhs'] / ns:.2f}×" for ns in times]])
        rows += element_rows(scene, sets)
        if all("floor" in scene["sets"][isa] for isa in sets):
            floors = [scene["sets"][isa]["floor"] for isa in sets]
            rows.append(["floor", *[f"{max(f[part] for part in FLOORS):,.0f}" for f in floors]])
    return f"""{origin(data)}. Times in ns over states of a settled run; contacts of ball and half.

{table(["", *sets], rows)}

Scalar is the same source with one ball per packet. The floor is the largest of three bounds: counted arithmetic
instructions, loads, and divisions with roots, each times its shortest time. The rest is mostly latency.
"""


FLOORS = "arithmetic", "load", "divide_root"

# --------------------------------------------------------------------------------------------------------------- step


def share(scene, part):
    """Part of a step's instructions that a source file takes, 0 if it is not called."""
    counts = scene["parts"].get(part, {"counts": {}})["counts"]
    return counts.get("instructions", 0) / scene["counts"]["instructions"]


def steps_by_part(scenes):
    """Rows of the shares of a step's instructions by part, those below 5 % of every scene summed up."""
    parts = dict.fromkeys(part for scene in scenes for part in scene["parts"])
    large = [part for part in parts if max(share(scene, part) for scene in scenes) >= 0.05]
    large.sort(key=lambda part: -share(scenes[0], part))
    rows = [[part, *[f"{100 * share(scene, part):.0f}" for scene in scenes]] for part in large]
    rest = [sum(share(scene, part) for part in parts if part not in large) for scene in scenes]
    return [*rows, ["others", *[f"{100 * part:.0f}" for part in rest]]]


def whole_steps(scenes):
    """Rows of the whole step."""
    return [
        ["instructions", *[f"{scene['counts']['instructions']:,.0f}" for scene in scenes]],
        ["floor, ns", *[f"{max(scene['floor'][part] for part in FLOORS):,.0f}" for scene in scenes]],
        ["measured, ns", *[f"**{scene['ns']:,.0f}**" for scene in scenes]],
        ["accepted steps/10 ms", *[f"{scene['steps'] / 100:,.0f}" for scene in scenes]],
        ["rejected", *[f"{scene['error_tests_failed'] / 100:,.0f}" for scene in scenes]],
    ]


def step(data):
    elastic, rigid = ([*data["cages"][cage].values()] for cage in ("elastic", "two_half"))
    pairs = [scene for pair in zip(elastic, rigid, strict=True) for scene in pair]
    names = [SHORT[name] for name in data["cages"]["elastic"]]
    return f"""{origin(data)}. {data["isa"]}, peak stress and statistics on, 1e-4 s communication steps.
Per accepted step, rejected ones included.

{table(["share of the instructions, elastic halves, %", *names], steps_by_part(elastic))}

{table(["whole step", *[f"{name}: {cage}" for name in names for cage in ("elastic", "rigid")]], whole_steps(pairs))}

A part is a source file with its inlined functions. Instructions are counted by single steps of the processor.
"""


# ------------------------------------------------------------------------------------------------------------- scenes


def scenes(data):
    stress = data["stress"]
    base = stress["off"]["rtf"]
    rows = [[name, f"{row['rtf']:.3f}", f"{100 * (row['rtf'] / base - 1):+.1f}"] for name, row in stress.items()]
    observed = all(row["same_bits"] for row in stress.values())
    missed = [
        [f"{float(step) * 1e6:,.0f}", f"{100 * row['missed_mean']:.1f}", f"{100 * row['missed_most']:.0f}"]
        for step, row in data["sampled_peaks"].items()
    ]
    groups, reading = data["groups"]["median_us"], data["groups"]["reading"]
    single = [us for name, us in groups.items() if name not in ("all", "the evaluation that all share")]
    models = [
        [
            name,
            f"{row['rtf']:.2f}/{row['rtf_full']:.2f}",
            *[percent(row["figures"][key]) for key in MODEL_FIGURES],
        ]
        for name, row in data["models"].items()
    ]
    head = ["simpler model", "RTF/full", "force mean", "p99.9", "head stress RMS", "p99.9"]
    return f"""{origin(data)}. Working point, 1e-4 s communication steps, C interface.

{table(["stress", "RTF", "against off, %"], rows)}

The end states {"are equal bit for bit" if observed else "differ"}.
`sampled` misses a part of each millisecond's largest head stress:

{table(["communication step, µs", "missed, %", "at most"], missed)}

Output groups are computed on first read, {min(single):.1f} to {max(single):.1f} µs each, {groups["all"]:.0f} µs all.
Reading all at every step: RTF {reading["all"]["rtf"]:.3f} instead of {reading["none"]["rtf"]:.3f}.

Simpler models, {data["seeds"]} seeds of {data["span"]:g} s; differences from the full model in %, ± 95 %:

{table(head, models)}
"""


MODEL_FIGURES = "Q_c_mean", "Q_c_p999", "sigma_head_rms", "sigma_head_p999"


# ------------------------------------------------------------------------------------------------------------ scaling


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


def fmpy_us(size, row):
    """fmpy's own time per communication step [µs]."""
    return 1e6 * (row["constant"]["rtf"] - row["constant"]["inside"]) * float(size)


def scaling(data):
    draw_scaling(data)
    balls = [
        [z, number(r["rtf"]), f"{r['evals'] / 100:,.0f}", f"{r['us_per_eval']:.2f}", f"{r['start_ms']:.1f}"]
        for z, r in data["balls"].items()
    ]
    cases = "constant", "changing"
    steps = [
        [
            f"{float(step):g}",
            *[number(row["constant"][key], 3) for key in ("rtf", "inside")],
            number(row["changing"]["rtf"], 3),
            *[f"{row[name]['evals'] / 100:,.0f}" for name in cases],
            f"{fmpy_us(step, row):.1f}",
        ]
        for step, row in data["step"].items()
    ]
    outputs = [[count, number(row["rtf"], 3), number(row["inside"], 3)] for count, row in data["outputs"].items()]
    quarters = [quarter for rows in data["horizon"].values() for quarter in rows]
    rtf, memory = [q["rtf"] for q in quarters], max(q["peak_memory_MB"] for q in quarters)
    parallel = [f"{count}: {row['rtf']:.3f}" for count, row in data["parallel"].items()]
    head = ["communication step, s", "RTF, constant inputs", "inside the FMU", "RTF, changing inputs"]
    head += ["evaluations/10 ms, constant", "changing", "fmpy, µs/step"]
    return f"""{origin(data)}. Through the FMU and fmpy.

![Cost over balls, communication step and outputs](performance/scaling.svg)

{table(["balls", "RTF", "evaluations/10 ms", "µs/evaluation", "start, ms"], balls)}

Pitch, masses and load grow with the number of balls; arrays are padded to packets of eight.

{table(head, steps)}

{table(["outputs read every 1e-4 s", "RTF", "inside"], outputs)}

Over {" and ".join(data["horizon"])} s the RTF of each quarter lies between {min(rtf):.3f} and {max(rtf):.3f}.
The peak memory is {memory:.1f} MB.
RTF of each of several processes at a time: {", ".join(parallel)}.
"""


# -------------------------------------------------------------------------------------------------------------- goals


def goals():
    """The goals that hold for no single scene, from all records that exist."""
    found = {}
    for name in ("rhs", "scenes", "scaling"):
        with contextlib.suppress(FileNotFoundError):
            found[name] = newest_record(name)
    rows = []
    if data := found.get("scenes"):
        for step_size, cases in data["inputs"].items():
            evals = cases["changing"]["evals"] / cases["free"]["evals"]
            rows.append([f"evaluations, inputs changing every {float(step_size):g} s", "≤ 2×", f"{evals:.2f}×"])
    if data := found.get("rhs"):
        sets = next(iter(data["scenes"].values()))["sets"]
        if "avx2" in sets:
            gain = sets["scalar"]["rhs"] / sets["avx2"]["rhs"]
            rows.append(["right-hand side, AVX2 against scalar", "≥ 2×", f"{gain:.2f}×"])
    if data := found.get("scaling"):
        rows.append(["instantiation and initialisation", "≤ 50 ms", f"{data['start_ms']:.1f} ms"])
    return table(["other goals", "goal", "measured"], rows)


def main():
    text = f"""# Performance

`benchmarks/performance_page.py` writes this page from the newest records in `benchmarks/results/`.
`make bench` measures in minutes (short form), `make bench FORM=` in an hour (full form).
Times are processor times of one core; they scatter by some per cent.
Unless elastic halves (the default) are named, figures are of rigid halves (`two_half`), which all solvers run.

{section("Error over the whole design space", "blind", blind)}
{section("Run time against error", "work_precision", work_precision)}
{goals()}

{section("One evaluation of the right-hand side", "rhs", rhs)}
{section("Where a step goes", "step", step)}
{section("Cost of single features", "scenes", scenes)}
{section("Scaling", "scaling", scaling)}"""
    PAGE.write_text("\n".join(line.rstrip() for line in text.splitlines()) + "\n")
    size = sum(path.stat().st_size for path in PICTURES.glob("*.svg")) / 1024
    print(f"wrote {PAGE.relative_to(ROOT)}, pictures {size:.0f} kB")


if __name__ == "__main__":
    main()
