"""Writes docs/performance.md and its pictures from the newest records in benchmarks/results/; measures nothing.  The
text stands in pages/performance.md; each chapter's function returns the numbers in it.
"""

import itertools
import math
import re

from blind import FIGURES as LIMITS
from common import ROOT
from pages import page_text
from performance_pictures import (
    BLIND,
    PICTURES,
    SHORT,
    curve,
    draw_blind,
    draw_scaling,
    draw_work_precision,
    families_of,
    row_of,
)
from records import RESULTS, newest_if_any, newest_record, read_record

PAGE = ROOT / "docs" / "performance.md"
GOALS = {"demo": 0.5, "slow": 0.6, "tilt": 1.0, "jam": 1.2}  # real-time factors


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


# -------------------------------------------------------------------------------------------------------- blind scenes


def blind(data):
    rows = [row for row in data["rows"] if "failed" not in row]
    draw_blind(rows)
    cells = [
        [BLIND[name], f"{100 * LIMITS[name][0]:g}"]
        + [f"{100 * data['figures'][name][key]:.2f}" for key in ("median", "p95", "worst")]
        + [data["figures"][name]["beyond"]]
        for name in BLIND
    ]
    return data | {"cells": cells}


# ------------------------------------------------------------------------------------------------- work and precision


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
    return [
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


def by_processor():
    """Real-time factors of the record of each processor, the newest one first."""
    records = sorted(map(read_record, RESULTS.glob("*/rtf.csv")), key=lambda record: record["date"], reverse=True)
    return [
        [re.sub(r"\(.*?\)| Processor", "", record["machine"]["processor"]), record["date"][:10]]
        + [number(record["cages"]["elastic"][name]["rtf"]) for name in SHORT]
        + [number(record["cages"]["two_half"]["demo"]["rtf"])]
        for record in records
        if "family" in record["machine"]["processor"]
    ]


def costs(data):
    """Cost of every family at the default's error, over the default's."""
    scenes = data["scenes"]
    families = families_of(next(iter(scenes.values()))["states"]["rows"])
    others = [family for family in families if family != data["default"]["family"]]
    rows = [[family, *[ratio(cost_ratio(data, scene, family)) for scene in scenes.values()]] for family in others]
    ours = [row_of(scene["states"]["rows"], **data["default"]) for scene in scenes.values()]
    return rows + [
        ["**default**: RTF", *[number(row["rtf"]) for row in ours]],
        ["error", *[f"{row['error']:.0e}" for row in ours]],
    ]


def work_precision(data):
    draw_work_precision(data)
    default = data["default"]
    return {
        "headline": headline(data),
        "by_processor": by_processor(),
        "method": default["family"].partition(", ")[2],
        "tolerance": default["tolerance"],
        "doubt": max(scene["states"]["reference_doubt"] for scene in data["scenes"].values()),
        "names": [SHORT[name] for name in data["scenes"]],
        "costs": costs(data),
    }


# ---------------------------------------------------------------------------------------------------- right-hand side


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
        if all("floor" in scene["sets"][isa] for isa in sets):
            floors = [scene["sets"][isa]["floor"] for isa in sets]
            rows.append(["floor", *[f"{max(f[part] for part in FLOORS):,.0f}" for f in floors]])
    return {"sets": sets, "rows": rows}


FLOORS = "arithmetic", "load", "divide_root"

# --------------------------------------------------------------------------------------------------------------- step


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
    return {
        "isa": data["isa"],
        "columns": [f"{name}: {cage}" for name in names for cage in ("elastic", "rigid")],
        "whole": whole_steps(pairs),
    }


# ------------------------------------------------------------------------------------------------------------- scenes


def scenes(data):
    stress = data["stress"]
    base = stress["off"]["rtf"]
    rows = [[name, f"{row['rtf']:.3f}", f"{100 * (row['rtf'] / base - 1):+.1f}"] for name, row in stress.items()]
    missed = [
        f"{100 * row['missed_mean']:.0f} % at steps of {float(step) * 1e6:,.0f} µs"
        for step, row in data["sampled_peaks"].items()
    ]
    return {
        "stress": rows,
        "same_bits": all(row["same_bits"] for row in stress.values()),
        "missed": missed,
        "reading": data["groups"]["reading"],
    }


# ------------------------------------------------------------------------------------------------------------ scaling


def scaling(data):
    draw_scaling(data)
    steps = [
        [
            f"{float(step):g}",
            *[number(row["constant"][key], 3) for key in ("rtf", "inside")],
            number(row["changing"]["rtf"], 3),
        ]
        for step, row in data["step"].items()
    ]
    return {"steps": steps}


CHAPTERS = blind, work_precision, rhs, step, scenes, scaling


def page(folder=RESULTS):
    """The page as text, from the newest records in a folder; draws its pictures."""
    found = {chapter.__name__: newest_if_any(chapter.__name__, folder) for chapter in CHAPTERS}
    values = {}
    for chapter in CHAPTERS:
        data = found[chapter.__name__]
        values[chapter.__name__] = data and chapter(data) | {"origin": origin(data)}
    return page_text("performance.md", values)


def main():
    PAGE.write_text(page(), encoding="utf-8")
    size = sum(path.stat().st_size for path in PICTURES.glob("*.svg")) / 1024
    print(f"wrote {PAGE.relative_to(ROOT)}, pictures {size:.0f} kB")


if __name__ == "__main__":
    main()
