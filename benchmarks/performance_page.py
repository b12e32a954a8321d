"""docs/performance.md and its pictures from the newest records of the benchmarks in benchmarks/results/."""

import contextlib
import io
import itertools
import math
import re

import matplotlib
import numpy as np
from common import ROOT, SCENES
from records import newest_record

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import FormatStrFormatter, LogLocator

PAGE, PICTURES = ROOT / "docs" / "performance.md", ROOT / "docs" / "performance"
REACH = {"demo": 0.5, "slow": 0.6, "tilt": 1.0, "jam": 1.2}  # real-time factors aimed at
FIGURES = {  # of the nine statistical errors: title
    "Q_c_mean": "force mean",
    "Q_c_rms": "RMS",
    "Q_c_p999": "p99.9",
    "sigma_head_mean": "head stress mean",
    "sigma_head_rms": "RMS",
    "sigma_head_p999": "p99.9",
    "sigma_mid_mean": "mid stress mean",
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
plt.rcParams.update(
    {
        "svg.fonttype": "none",
        "svg.hashsalt": "performance",
        "font.size": 8,
        "axes.grid": True,
        "grid.alpha": 0.25,
        "axes.axisbelow": True,
    }
)


def section(title, name, write):
    """A chapter of the page from the record of a benchmark, or what is missing for it."""
    try:
        return f"## {title}\n\n{write(newest_record(name))}"
    except FileNotFoundError:
        return f"## {title}\n\nNot measured here: `python benchmarks/{name}.py` does it.\n"


def table(head, rows):
    """Lines of a table: first column left, the others right."""
    lines = ["| " + " | ".join(head) + " |", "|---" + "|---:" * (len(head) - 1) + "|"]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows])


def number(value, digits=2):
    """A few significant digits, — for nothing."""
    if value is None or not math.isfinite(value):
        return "—"
    if value == 0.0:
        return "0"
    decimals = max(0, digits - 1 - math.floor(math.log10(abs(value))))
    return f"{value:,.{decimals}f}" if abs(value) >= 1e-3 else f"{value:.0e}"


def percent(figure):
    """Error ± half-width."""
    return f"{100 * figure['error']:+.2f} ± {100 * figure['half_width']:.2f}"


def origin(data):
    form = "short form" if data["short"] else "full form"
    return f"{form}, {data['date'][:10]}, commit {data['commit']}, {data['machine']['processor']}, {data['machine']['compiler']}"


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
    """Colour, marker and width of a family; spare ones for those that this page does not know."""
    unknown = [name for name in families if name not in STYLES]
    return STYLES[family] if family in STYLES else SPARE[unknown.index(family) % len(SPARE)]


# --------------------------------------------------------------------------------------------------- work and precision


def curve(rows, family):
    """Errors and RTFs of one family by tolerance."""
    points = [
        (r["error"], r["rtf"])
        for r in sorted(rows, key=lambda r: r["tolerance"])
        if r["family"] == family and "error" in r
    ]
    return np.array(points).reshape(-1, 2)


def cheapest(rows, family, error):
    """Least RTF of a family at this error or better: along its curve, straight in logarithms; None where it never gets
    there.
    """
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
    return next(
        (r for r in rows if r["family"] == family and math.isclose(r["tolerance"], tolerance) and "rtf" in r), None
    )


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


def bdf_ratio(data, scene):
    """Cost of BDF with a dense Jacobian / the default's, at the default's error; None where BDF never gets there."""
    rows = scene["states"]["rows"]
    ours = row_of(rows, **data["default"])
    dense = cheapest(rows, "CVODE BDF, dense", ours["error"])
    return dense / ours["rtf"] if dense else None


def python_ratio(data, scene):
    """Cost of the cheapest Python solver / the default's, at the default's error; None where none gets there."""
    ours, rows = row_of(scene["states"].get("python_ours", []), **data["default"]), scene["states"]["python"]
    costs = [cheapest(rows, family, ours["error"]) for family in dict.fromkeys(r["family"] for r in rows)]
    costs = [cost for cost in costs if cost]
    return min(costs) / ours["rtf"] if costs else None


def ratio(value):
    return f"{value:,.0f}×" if value else "never reached"


def largest_error(data, scene):
    """The largest of the nine statistical errors of the default and its name."""
    name, figure = max(
        row_of(scene["statistics"]["rows"], **data["default"])["figures"].items(),
        key=lambda item: abs(item[1]["error"]),
    )
    return f"{percent(figure)} ({name})"


def headline(data):
    through = newest_record("rtf")
    rows = [
        [
            scene["title"],
            number(REACH.get(name)),
            *[number(cage[name]["rtf"]) for cage in through["cages"].values()],
            *[number(cage[name]["inside"]) for cage in through["cages"].values()],
            largest_error(data, scene),
            ratio(bdf_ratio(data, scene)),
            ratio(python_ratio(data, scene)) if scene["states"]["python"] else "—",
        ]
        for name, scene in data["scenes"].items()
    ]
    head = [
        "scene",
        "RTF to reach",
        "RTF through fmpy",
        "rigid halves",
        "inside the FMU",
        "rigid halves",
        "largest of nine statistical errors, %",
    ]
    head.append("BDF dense at equal error")
    return table([*head, "best Python solver at equal error"], rows)


def states_table(data):
    """Every family at one tolerance, and ours at the default."""
    default, scenes = data["default"], data["scenes"]
    wanted = [(default["family"], default["tolerance"])]
    families = dict.fromkeys(r["family"] for r in next(iter(scenes.values()))["states"]["rows"])
    wanted += [(family, 1e-3) for family in families if (family, 1e-3) != wanted[0]]
    rows = []
    for family, tolerance in wanted:
        cells = [f"**{family} {tolerance:g}**" if not rows else f"{family} {tolerance:g}"]
        for scene in scenes.values():
            row = row_of(scene["states"]["rows"], family, tolerance)
            cells.append(
                f"{number(row['rtf'])} / {row['evals'] / 100:,.0f} / {row['steps'] / 100:,.0f} / {row['error']:.0e}"
                if row
                else "failed"
            )
        rows.append(cells)
    return table(["RTF / evaluations / steps per 10 ms / error", *[scene["title"] for scene in scenes.values()]], rows)


def statistics_table(data):
    rows = []
    for scene in data["scenes"].values():
        for row in scene["statistics"]["rows"]:
            figures = row["figures"]
            cells = [percent(figures[name]) for name in FIGURES]
            mark = "**" if {"family": row["family"], "tolerance": row["tolerance"]} == data["default"] else ""
            rows.append(
                [
                    f"{scene['title']}: {mark}{row['family']} {row['tolerance']:g}{mark}",
                    number(row["rtf"]),
                    f"{row['evals'] / 100:,.0f}",
                    *cells,
                ]
            )
    return table(["", "RTF", "evaluations per 10 ms", *FIGURES.values()], rows)


def python_table(data):
    rows = []
    for scene in data["scenes"].values():
        rows += [
            [
                f"{scene['title']}: {r['family']} {r['tolerance']:g}",
                number(r["rtf"]),
                f"{r['evals'] / 100:,.0f}",
                f"{r['error']:.0e}",
            ]
            for r in [*scene["states"]["python"], *[row_of(scene["states"].get("python_ours", []), **data["default"])]]
            if r
        ]
    return table(["", "RTF", "evaluations per 10 ms", "error after 0.5 ms"], rows)


def work_precision(data):
    draw_work_precision(data)
    first = next(iter(data["scenes"].values()))
    doubt = max(scene["states"]["reference_doubt"] for scene in data["scenes"].values())
    tight = number(first["statistics"]["truth_cost"]["rtf"])
    few, many, _ = first["statistics"]["seeds"]
    most = ", ".join(f"{scene['statistics']['seeds'][2]} ({scene['title']})" for scene in data["scenes"].values())
    return f"""{origin(data)}.

{headline(data)}

RTF: processor time / simulated time on one core; through fmpy with 1e-4 s communication steps, the peak stress of all rivets read at each; inside the FMU
without fmpy's own part (`benchmarks/rtf.py`, least of {newest_record("rtf")["rounds"]} rounds). First the default, elastic cage halves, then rigid ones.
Errors are of mean, RMS and 99.9 % quantile of pocket force, head stress and middle stress of the worst rivet, with 95 % half-widths.

![Run time against error of every solver](performance/work_precision.svg)

Ring: the default, {data["default"]["family"].partition(", ")[2]} at {data["default"]["tolerance"]:g}. All start from the same settled states
(geometric mean of {first["states"]["starts"]}).
The error is the RMS over all states of error/(tolerance scale): 1 is the error that tolerance 1 allows that state ([method.md](method.md)). The
reference is Dormand–Prince at 1e-10; Verner 6(5) at 1e-10 ends within {doubt:.0e} of it. BDF's Jacobian is SUNDIALS' own by differences (*dense*: what
a general multibody solver does, the stand-in for the paper's GSTIFF with its 10,000 outputs in 0.4 s), the diagonal of damping rates, or bordered block
diagonal. No stress, no statistics in these runs.

{states_table(data)}

### Statistics

Trajectories are chaotic, so over long times only statistics compare: {many} seeds × {first["statistics"]["length"]:g} s after settling ({few} seeds for
solvers not ours; of the default {most}), pooled, against as many of Dormand–Prince at 1e-6 (RTF {tight} at the working point).
Error ± 95 % half-width in %, the larger one of the differences seed by seed and of a bootstrap over 20 ms blocks (in a jam all seeds may follow one attractor).

{statistics_table(data)}

### The Python reference

SciPy's solvers on the Python twin, its exact Jacobian where they take one; 0.5 ms from the first settled state, costs extrapolated to a simulated second.
The last row of each scene is the FMU's default over the same horizon.

{python_table(data)}
"""


# ------------------------------------------------------------------------------------------------------ right-hand side


def rhs(data):
    sets = list(data["peaks"])
    rows = []
    for scene in data["scenes"].values():
        base = scene["sets"]["scalar"]["rhs"]
        rows.append(
            [
                f"**{scene['title']}**, {scene['pockets_touched']:.1f} contacts of ball and half",
                *[f"**{scene['sets'][isa]['rhs']:,.0f}**" for isa in sets],
            ]
        )
        rows.append(["against scalar", *[f"{base / scene['sets'][isa]['rhs']:.2f}×" for isa in sets]])
        for element in scene["sets"]["scalar"]["elements"]:
            rows.append([f"– {element}", *[f"{scene['sets'][isa]['elements'][element]:,.0f}" for isa in sets]])
        if all("counts" in scene["sets"][isa] for isa in sets):
            for title, key in (
                ("instructions", "instructions"),
                ("arithmetic", "arithmetic"),
                ("of these packed", "arithmetic_packed"),
                ("flops", "flops"),
                ("loads", "loads"),
                ("stores", "stores"),
            ):
                rows.append([title, *[f"{scene['sets'][isa]['counts'].get(key, 0):,.0f}" for isa in sets]])
            counts = [scene["sets"][isa]["counts"] for isa in sets]
            rows.append(["divisions and roots", *[f"{c.get('divide', 0) + c.get('root', 0):,.0f}" for c in counts]])
            rows.append(
                [
                    "floor: arithmetic / loads / divisions",
                    *[
                        " / ".join(
                            f"{scene['sets'][isa]['floor'][part]:,.0f}"
                            for part in ("arithmetic", "load", "divide_root")
                        )
                        for isa in sets
                    ],
                ]
            )
    peaks = "; ".join(
        f"{isa} {p['arithmetic']:.3f}, {p['load']:.3f}, {p['divide']:.2f}, {p['root']:.2f}"
        for isa, p in data["peaks"].items()
    )
    return f"""{origin(data)}. Times in ns over states of a settled run, elements timed one by one.

{table(["", *sets], rows)}

Scalar is the same source with packets of one ball, vectorisation off. The floor multiplies the instructions of one evaluation, counted by single steps,
with the shortest time of an independent instruction on this processor (add or multiply, load, divide, root in ns: {peaks}).
No order of these instructions can be faster than the largest of the three. Time above this floor is mostly
latency: chains of dependent operations in few packets.
"""


# ----------------------------------------------------------------------------------------------------------------- step


def hosted(data):
    """What ARKStep costs around the core's own step."""
    rows = []
    for name in next(iter(data["cages"].values())):
        cells = [SCENES[name][0]]
        for scenes in data["cages"].values():
            own, arkstep = scenes[name]["own loop"]["us"], scenes[name]["ARKStep"]["us"]
            cells += [f"{own:.2f}", f"{arkstep:.2f}", f"+{100 * (arkstep / own - 1):.0f} %"]
        rows.append(cells)
    return (
        "Microseconds an evaluation with stress and statistics, the same steps taken by the core's own loop and by ARKStep, "
        "which calls the core's step as its nonlinear solver ([method](method.md)).\n\n"
        f"{table(['', 'elastic halves: own loop', 'ARKStep', '', 'rigid halves: own loop', 'ARKStep', ''], rows)}\n"
    )


def steps_by_part(scenes):
    """Table of instructions and floors by part, and how many steps there are."""
    parts = dict.fromkeys(part for scene in scenes for part in scene["parts"])
    first = scenes[0]["parts"]
    rows = []
    for part in sorted(parts, key=lambda part: -first[part]["counts"]["instructions"] if part in first else 0.0):
        cells = [part]
        for scene in scenes:
            row = scene["parts"].get(part, {"counts": {}, "floor": 0.0})
            count = row["counts"].get("instructions", 0)
            cells += [f"{count:,.0f} ({100 * count / scene['counts']['instructions']:.0f} %)", f"{row['floor']:,.0f}"]
        rows.append(cells)
    whole, head = ["**whole step**"], [""]
    measured = ["**measured, ns**"]
    for scene in scenes:
        parts_of_floor = " / ".join(f"{scene['floor'][name]:,.0f}" for name in ("arithmetic", "load", "divide_root"))
        whole += [f"**{scene['counts']['instructions']:,.0f}**", parts_of_floor]
        measured += ["", f"**{scene['ns']:,.0f}**"]
        head += [f"{scene['title']}: instructions", "floor, ns"]
    taken = "; ".join(
        f"{scene['title']}: {scene['steps'] / 100:,.0f} accepted, {scene['error_tests_failed'] / 100:,.0f} rejected"
        for scene in scenes
    )
    return f"Steps per 10 ms: {taken}.\n\n{table(head, [*rows, whole, measured])}"


def step(data):
    elastic, rigid = (steps_by_part([*data["cages"][cage].values()]) for cage in ("elastic", "two_half"))
    return f"""{origin(data)}. {data["isa"]}, peak stress and statistics on, 1e-4 s communication steps; per accepted step, rejected ones included.

Elastic halves, the default, with their substeps. {elastic}

Rigid halves. {rigid}

Instructions are counted by single steps of the processor. A part is a source file of the core, with the functions that the compiler inlines from headers. The
floor of a part is the largest of its three floors (see above); the floors of the whole step are those of arithmetic / loads / divisions and roots.
"""


# --------------------------------------------------------------------------------------------------------------- scenes


def scenes(data):
    stress = data["stress"]
    base, span = stress["off"]["rtf"], data["span"]
    rows = [
        [
            name,
            f"{row['rtf']:.3f}",
            f"{100 * (row['rtf'] / base - 1):+.1f} %",
            "same bits" if row["same_bits"] else "differs",
        ]
        for name, row in stress.items()
    ]
    missed = [
        f"{100 * row['missed_mean']:.1f} % (at most {100 * row['missed_most']:.0f} %) at {float(step) * 1e6:,.0f} µs"
        for step, row in data["sampled_peaks"].items()
    ]
    groups, reading = data["groups"]["median_us"], data["groups"]["reading"]
    inputs = [
        [
            f"{float(step) * 1e6:.0f} µs, {name}",
            f"{row['rtf']:.3f}",
            f"{row['evals'] / 100:,.0f}",
            f"{row['evals'] / rows_['free']['evals']:.2f}×",
        ]
        for step, rows_ in data["inputs"].items()
        for name, row in rows_.items()
    ]
    first = next(iter(data["paths"].values()))
    paths = [
        [name, *[f"{row['rtf']:.2f} / {row['evals'] / 100:,.0f}" for row in rows_.values()]]
        for name, rows_ in data["paths"].items()
    ]
    by_group = ", ".join(f"{name} {value:.2f}" for name, value in groups.items())
    bits = "same bits" if reading["all"]["same_bits"] else "the end state differs"
    head = ["simpler model", "RTF / full model's", "force mean", "RMS", "p99.9", "head stress RMS", "p99.9"]
    models = [
        [
            name,
            f"{row['rtf']:.2f} / {row['rtf_full']:.2f}",
            *[
                percent(row["figures"][key])
                for key in ("Q_c_mean", "Q_c_rms", "Q_c_p999", "sigma_head_rms", "sigma_head_p999")
            ],
        ]
        for name, row in data["models"].items()
    ]
    return f"""{origin(data)}. Working point, 1e-4 s communication steps, through the core's C interface.

{table(["stress", "RTF", "against off", "end state"], rows)}

Same bits: observation does not change the trajectory. Samples at communication points miss a part of the largest head stress in each millisecond, in the mean
{", ".join(missed)}. This is the error of `sampled`; peaks over every accepted step have no such error.

Output groups are computed on first read (µs, median, Python's call included): {by_group}.
All groups read at every step against none: RTF {reading["all"]["rtf"]:.3f} against {reading["none"]["rtf"]:.3f}, {bits}.

{table(["communication step, inputs", "RTF", "evaluations per 10 ms", "against free run"], inputs)}

{table(["solver path: RTF / evaluations per 10 ms", *first], paths)}

Simpler models at the working point, {data["seeds"]} seeds × {span:g} s; differences from the full model in %, ± 95 %:

{table(head, models)}
"""


# -------------------------------------------------------------------------------------------------------------- scaling


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


def scaling(data):
    draw_scaling(data)
    balls = [
        [z, number(r["rtf"]), f"{r['evals'] / 100:,.0f}", f"{r['us_per_eval']:.2f}", f"{r['start_ms']:.1f}"]
        for z, r in data["balls"].items()
    ]
    steps = [
        [
            f"{float(step):g}",
            *[number(row[name][key], 3) for name in ("constant", "changing") for key in ("rtf", "inside")],
            *[f"{row[name]['evals'] / 100:,.0f}" for name in ("constant", "changing")],
            f"{1e6 * (row['constant']['rtf'] - row['constant']['inside']) * float(step):.1f}",
        ]
        for step, row in data["step"].items()
    ]
    outputs = [[count, number(row["rtf"], 3), number(row["inside"], 3)] for count, row in data["outputs"].items()]
    horizon = [
        [f"{h} s", *[f"{q['rtf']:.3f}, {q['peak_memory_MB']:.1f} MB" for q in rows]]
        for h, rows in data["horizon"].items()
    ]
    head = ["communication step, s", "RTF, constant inputs", "inside the FMU", "RTF, changing inputs", "inside the FMU"]
    head += ["evaluations per 10 ms, constant", "changing", "fmpy's own µs per step"]
    parallel = [[count, number(row["rtf"], 3), number(row["wall"], 3)] for count, row in data["parallel"].items()]
    return f"""{origin(data)}. Through the FMU and fmpy. Instantiation and initialisation, quasi-static start included: {data["start_ms"]:.1f} ms.

![Cost over balls, communication step and outputs](performance/scaling.svg)

{table(["balls", "RTF", "evaluations per 10 ms", "µs per evaluation", "start, ms"], balls)}

Pitch, masses and load grow with the number of balls; the orbital speed of the balls stays. Arrays are padded to whole packets of eight.

{table(head, steps)}

The last column is fmpy's overhead for `doStep` and one `getReal` of 18 channels: Python and ctypes, not the FMU.

{table(["outputs read every 1e-4 s", "RTF", "inside doStep"], outputs)}

{table(["horizon", "first quarter: RTF, peak memory", "second", "third", "fourth"], horizon)}

{table(["processes at a time", "RTF of each", "wall time / simulated time"], parallel)}
"""


# ---------------------------------------------------------------------------------------------------------------- goals


def goals():
    """What the project set out to reach, and where it is: from all records that there are."""
    found = {}
    for name in ("rtf", "work_precision", "rhs", "scenes", "scaling"):
        with contextlib.suppress(FileNotFoundError):
            found[name] = newest_record(name)
    rows = []
    if data := found.get("rtf"):
        elastic, rigid = (data["cages"][cage] for cage in ("elastic", "two_half"))
        for name, reach in REACH.items():
            measured = f"{number(elastic[name]['rtf'])}; rigid halves {number(rigid[name]['rtf'])}"
            rows.append([f"RTF through fmpy, {SCENES[name][0]}", f"≤ {reach:g}", measured])
    if data := found.get("work_precision"):
        rows += [
            [f"largest of nine statistical errors, {scene['title']}, %", "≤ 1", largest_error(data, scene)]
            for scene in data["scenes"].values()
        ]
        rows += [
            [f"CVODE BDF dense at equal error, {scene['title']}", "≥ 10×", ratio(bdf_ratio(data, scene))]
            for scene in data["scenes"].values()
        ]
        measured = [scene for scene in data["scenes"].values() if scene["states"]["python"]]
        rows += [
            [f"best Python solver at equal error, {scene['title']}", "≥ 100×", ratio(python_ratio(data, scene))]
            for scene in measured
        ]
    if data := found.get("scenes"):
        for step_size, cases in data["inputs"].items():
            evals = cases["changing"]["evals"] / cases["free"]["evals"]
            rows.append(
                [f"evaluations, inputs changing every {float(step_size):g} s / free run", "≤ 2×", f"{evals:.2f}×"]
            )
    if data := found.get("rhs"):
        sets = next(iter(data["scenes"].values()))["sets"]
        if "avx2" in sets:
            scalar, avx2 = sets["scalar"]["rhs"], sets["avx2"]["rhs"]
            rows.append(["right-hand side, AVX2 against scalar", "≥ 2×", f"{scalar / avx2:.2f}×"])
            rows.append(
                [
                    "right-hand side, AVX2, where scalar takes 1.9 µs",
                    "≤ 0.8 µs",
                    f"{1.9 * avx2 / scalar:.2f} µs (here {1e-3 * avx2:.2f} of {1e-3 * scalar:.2f})",
                ]
            )
    if data := found.get("scaling"):
        overhead = {
            size: 1e6 * (row["constant"]["rtf"] - row["constant"]["inside"]) * float(size)
            for size, row in data["step"].items()
        }
        rows.append(
            [
                "fmpy's own time per communication step of 1e-4 s, 18 channels read",
                "apart",
                f"{overhead['0.0001']:.1f} µs",
            ]
        )
        rows.append(["instantiation and initialisation, once loaded", "≤ 50 ms", f"{data['start_ms']:.1f} ms"])
    return table(["", "to reach", "measured"], rows)


def main():
    text = f"""# Performance

Written by `make bench` (short form, minutes) or `make bench FORM=` (full form, an hour): the programs in `benchmarks/`
measure, their records stand in `benchmarks/results/`, and `benchmarks/performance_page.py` writes this page from the newest ones.
Times are processor times of one core. They scatter by some percent on a machine that others use; counts of evaluations and steps do not.
Real-time factors through fmpy are given for the default, elastic cage halves, and for rigid ones. All other figures are of rigid halves
(`scene.cage = two_half`), which every solver runs; [guide.md](guide.md#accuracy-and-cost) and
[method.md](method.md#elastic-halves) say what elastic halves cost and where.

{goals()}

{section("Run time against error", "work_precision", work_precision)}
{section("One evaluation of the right-hand side", "rhs", rhs)}
{section("Where a step goes", "step", step)}
{section("The step inside ARKODE", "hosted", hosted)}
{section("What a scene does not need", "scenes", scenes)}
{section("Scaling", "scaling", scaling)}"""
    PAGE.write_text("\n".join(line.rstrip() for line in text.splitlines()) + "\n")
    size = sum(path.stat().st_size for path in PICTURES.glob("*.svg")) / 1024
    print(f"wrote {PAGE.relative_to(ROOT)}, pictures {size:.0f} kB")


if __name__ == "__main__":
    main()
