"""A run as one self-contained HTML page: settings, stress, loads, cage, life, solver, and the motion to play and scrub."""

import math
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from bearing_model.generated import variables

from ..base.errors import UserError
from ..base.files import FORMATS, write_text
from ..base.units import duration, figure
from ..base.variable_list import variable_of
from ..bearing.assumed import assumed_as_bronze, assumed_rows, measured_in
from ..bearing.ribbon import is_guided_by_balls
from ..bearing.strength import Strength, assumed, in_words
from ..running import in_run, summary
from ..running.budget import computed_share, shown
from ..running.in_run import later_values, unit_of
from ..running.rainflow import fatigue_law, rivet_life
from ..running.responses import display_of
from ..running.results import Result, read_result
from ..running.summary import (
    DEG,
    breaks,
    columns,
    early_rows,
    flag_note,
    has_statistics,
    life_is_known,
    settled,
    summary_rows,
    table_note,
)
from . import charts, plot
from .animation import frames, number_of_balls
from .overlay import read_measured, views
from .pages import PARTS, page_text
from .tornado import wrong

FIRST = 3  # rows without statistics that stand on the cards
PLACE_NAMES = {"head": "head", "mid": "middle"}
OF_LAND = ("cage.guide_clearance", "cage.land_x", "cage.land_width", "cage.mu_land")  # no effect without a land
WIDE, LOW, SQUARE, HIGH = (4.9, 2.7), (4.9, 1.9), (4.9, 4.2), (4.9, 3.0)  # inches
NOT_SAID = dict.fromkeys(("scene", "description", "model", "date", "guid"), "") | {
    "basis": {},
    "versions": {},
    "not_given": {},
    "messages": [],
}


def report_files(source):
    """The result files of a path: the file itself, or all in the folder; UserError if there are none."""
    source = Path(source)
    if not source.is_dir():
        return [source]
    found = sorted(
        path for path in source.iterdir() if path.suffix.removeprefix(".") in FORMATS and not path.name.startswith(".")
    )
    if not found:
        raise UserError(f"{source}: no results in this folder; allowed are files ending in {', '.join(FORMATS)}")
    return found


def report_pages(
    source: Any, out: Any = None, decides: Any = None, overlay: Any = None, columns: Any = None
) -> Iterator[Any]:
    """Write a page for each result of a path and yield their paths; UserError for no result, no numbers, or several in a file.

    out: file or folder, None: beside the results; decides: a Sensitivity; overlay, columns: as of read_measured.
    """
    sources, out = report_files(source), Path(out) if out else None
    as_file = out is not None and out.suffix in (".html", ".htm")
    if as_file and len(sources) > 1:
        raise UserError(f"--out {out}: one page for {len(sources)} results; allowed is a folder")
    for path in sources:
        name = path.with_suffix(".html")
        result = read_result(path)
        if not has_numbers(result):
            raise UserError(f"{path}: no output has a number: there is nothing to show")
        measured = read_measured(overlay, result, columns) if overlay else ()
        target = out if as_file else out / name.name if out else name
        yield write_text(target, render(result, decides, measured))


def has_numbers(result):
    """Whether any column beside time and inputs has a number, if there are such columns."""
    outputs = [values for name, values in result.data.items() if name not in {"time", *variables.INPUTS}]
    return not outputs or not all(np.all(np.isnan(values)) for values in outputs)


def render(result, decides=None, measured=()):
    """The page as text; decides: see report_pages; measured: Series beside the run's."""
    film, missing = frames(result)
    lives, elastic = all_lives(result), result.parameters.get("scene.cage") == "elastic"
    absent = () if elastic else OF_ELASTIC
    absent = absent if charts.vibrates(result) else (*absent, "vibration")  # of races that are not perfect
    return page_text(
        "page.html",
        about=NOT_SAID | result.about,
        result=result,
        summary=summary,
        in_run=in_run,
        script="".join((PARTS / name).read_text(encoding="utf-8") for name in ("drawing.js", "animation.js")),
        film=film,
        missing=missing,
        cards=cards(result, lives),
        inputs=list(input_rows(result)),
        settings=list(setting_rows(result)),
        rows=[replace(row, unit=row.unit.replace("um", "µm")) for row in summary_rows(result)],
        early=[] if has_statistics(result) else list(early_rows(result)),
        curve=curve(result) if lives else "",
        balls=list(ball_rows(result)),
        settle=min(result.parameters.get("start.settle", 0.0), float(result.data["time"][-1])),
        lives=lives,
        worst=charts.worst_rivet(result),
        weakest=weakest(lives) if lives else None,
        elastic=elastic,
        vibrates=charts.vibrates(result),
        loaded=charts.loaded_rivet(result),
        assumed=(rows := assumed_rows(result)),
        **wrong(result),
        measured_in=measured_in(rows),
        as_bronze=assumed_as_bronze(result),
        decides=decides,
        measured=views(measured),
        display_of=display_of,
        onsets={
            name.split(".")[1].removesuffix("_onsets"): result.data[name][-1]
            for name in columns(result, "event.", "_onsets")
        },
        flags=flag_note(result).partition(": ")[2] or "none" if columns(result, "rivet[", "].flag") else "",
        charts={name: chart(result, name, lives) for name in CHARTS if name not in absent},
        figure=figure,
        duration=duration,
    )


def curve(result: Result) -> str:
    """The S-N curve in words, with what of it is assumed."""
    strength = Strength(fatigue_law(result.parameters))
    return in_words(strength) + assumed(strength, result.about.get("given", ()))


PANELS = {draw.__name__: charts.over_time((draw, names)) for draw, names in plot.OVER_TIME}
CHARTS = {  # name: draw(figure, result), size, label, channels that the chart needs: ball[*] and rivet[*] of each
    "loads": (PANELS["loads"], LOW, "Loads on the inner ring over time", "shaft.F_x shaft.F_y shaft.omega"),
    "stress": (PANELS["stress"], WIDE, "Largest rivet stress over time", "rivet.sigma_head_max rivet.sigma_mid_max"),
    "spectra": (charts.spectra, WIDE, "Spectra of the worst rivet's stress", "rivet[*].sigma_head rivet[*].sigma_mid"),
    "bars": (charts.untitled(plot.rivet_bars), WIDE, "Stress of each rivet", ""),
    "map": (
        charts.stress_over_azimuth,
        HIGH,
        "Head stress of each rivet over its azimuth",
        "half_0.psi rivet[*].sigma_head_peak",
    ),
    "history": (charts.stress_over_time, HIGH, "Head stress of each rivet over time", "rivet[*].sigma_head_peak"),
    "rainflow": (None, HIGH, "Rainflow matrix of the weakest rivet", "rivet[*].sigma_head"),
    "distribution": (
        charts.load_distribution,
        WIDE,
        "Load distribution over the azimuth",
        "ball[*].psi ball[*].Q_i ball[*].Q_e",
    ),
    "histogram": (charts.force_histogram, WIDE, "Histogram of contact forces", "ball[*].Q_c"),
    "pocket": (PANELS["pocket_force"], WIDE, "Pocket force over time", "cage.F_pocket_peak"),
    "section": (charts.section, SQUARE, "Section of the bearing with its dimensions", ""),
    "orbit": (charts.untitled(plot.cage_orbit), SQUARE, "Orbit of the cage's centre", "cage.y cage.z"),
    "joints": (charts.joint_spectra, HIGH, "Spectra of the joint loads", "rivet[*].T rivet[*].M_y rivet[*].M_z"),
    "slip": (PANELS["slip"], LOW, "Cage slip over time", "cage.slip_ratio"),
    "ring": (PANELS["ring"], WIDE, "Displacement of the inner ring over time", "ring.x ring.y ring.z"),
    "vibration": (
        charts.vibration,
        SQUARE,
        "Spectrum and envelope spectrum of the vibration",
        "shaft.omega cage.omega",
    ),
    "energy": (charts.energy, LOW, "Power loss and energy balance over time", "bearing.power_loss"),
}
OF_ELASTIC = ("joints",)  # charts of elastic cage halves alone


def chart(result, name, lives):
    """SVG of one chart, or in words which channels it lacks."""
    draw, size, label, needs = CHARTS[name]
    numbers = range(1, max(number_of_balls(result), 1) + 1)
    each = (channel.replace("*", str(k)) for k in numbers for channel in needs.split())  # one without * each time
    missing = list(dict.fromkeys(channel for channel in each if channel not in result.data))
    if missing or len(result.data["time"]) < 16:
        names = f"not recorded: {', '.join(missing[:4])}{' …' if len(missing) > 4 else ''}"
        lack = names if missing else "too few samples"
        return f'<p class="missing">{label}: {lack}</p>'
    if name == "vibration" and (reason := charts.no_vibration(result)):
        return f'<p class="missing">{label}: {reason}</p>'
    if name in ("spectra", "rainflow") and not np.any(
        np.diff(result.data[f"rivet[{charts.worst_rivet(result)}].sigma_head"][settled(result)])
    ):
        return f'<p class="missing">{label}: the stress does not change</p>'
    if name == "joints" and (reason := charts.no_joint_spectra(result)):
        return f'<p class="missing">{label}: {reason}</p>'
    if name == "rainflow" and not lives:
        return f'<p class="missing">{label}: {table_note(result) or "the stress of the rivets was not recorded"}</p>'
    if name == "rainflow":
        k, place = weakest(lives)
        cycles = next(life[place].cycles for life in lives if life["k"] == k) * np.array([1e-6, 1e-6, 1.0])
        return charts.svg(lambda figure: charts.rainflow_matrix(figure, cycles), size, label)
    return charts.svg(lambda figure: draw(figure, result), size, label)


def all_lives(result):
    """One dict a rivet: k, RivetLife of head and middle, the FMU's own sums; none from closed forms."""
    rows = []
    if result.parameters.get("scene.stress") == "off" or not life_is_known(result) or not has_statistics(result):
        return rows
    for k in range(1, number_of_balls(result) + 1):
        head, mid = (rivet_life(result, k, place) for place in ("head", "mid"))
        if head and mid:
            counted = (result.data.get(f"rivet[{k}].damage_{place}", [math.nan])[-1] for place in ("head", "mid"))
            own = dict(zip(("fmu_head", "fmu_mid"), map(float, counted), strict=True))
            rows.append({"k": k, "head": head, "mid": mid} | own)
    return rows


def weakest(lives):
    """Number and place, "head" or "mid", with the shortest life."""
    places = ((life[place].life, life["k"], place) for life in lives for place in PLACE_NAMES)
    return min(places, key=lambda each: each[0])[1:]


def cards(result, lives):
    """The figures to see first: (title, value, unit, remark)."""
    rows, share = {row.channel: row for row in summary_rows(result)}, computed_share(result)
    if not rows:
        for channel, unit, last, largest in list(early_rows(result))[:FIRST]:
            remark = f"largest since the start · {figure(last)} at the end"
            yield channel.capitalize(), figure(largest), unit.replace("um", "µm"), remark
    for channel, title in (
        ("head stress, largest of rivets", "Head stress"),
        ("middle stress, largest of rivets", "Middle stress"),
        ("pocket force, all balls", "Pocket force"),
    ):
        if channel in rows:
            row = rows[channel]
            p999, mean, largest = (shown(row, value, share) for value in (row.p999, row.mean, row.largest))
            yield title, p999, row.unit, f"p99.9 · mean {mean} · largest {largest}"
    if "cage slip ratio" in rows:
        speed = f" · {figure(rows['cage speed'].mean)} rev/min" if "cage speed" in rows else ""
        yield "Cage slip", figure(rows["cage slip ratio"].mean), "%", f"mean{speed}"
    if row := rows.get("cage dislocation"):
        yield "Dislocation of the halves", figure(row.largest), "µm", f"largest · mean {figure(row.mean)}"
    broken = breaks(result)
    if broken:
        k, place, t = broken[0]
        count = len(broken)
        yield "Broken rivets", str(count), "", f"first rivet {k}, {place}, at {figure(1e3 * t)} ms · no life is told"
    if lives and not broken:
        k, place = weakest(lives)
        shortest = next(life[place].life for life in lives if life["k"] == k)
        yield "Life of the weakest rivet", duration(shortest), "", f"rivet {k}, {PLACE_NAMES[place]} · Miner's sum 1"
    if "real_time_factor" in result.summary:
        s = result.summary
        remark = f"{s['cpu_time']:.2f} s for {s['simulated_time']:g} s"
        yield "Real-time factor", figure(s["real_time_factor"]), "", remark


def input_rows(result):
    """Name, meaning and value of every input that is not zero all the time, in the units that people read."""
    for name, variable in variables.INPUTS.items():
        if name in result.data and np.any(result.data[name]):
            unit, factor, offset = unit_of(result, name, variable)
            low, high = factor * result.data[name].min() + offset, factor * result.data[name].max() + offset
            yield name, variable.description, figure(low) if low == high else f"{figure(low)} … {figure(high)}", unit


def setting_rows(result):
    """Name, meaning, value, unit of every parameter and whether it differs from the 6207's default or changed in the run."""
    ineffective = OF_LAND if is_guided_by_balls(result.parameters) else ()
    for name, value in result.parameters.items():
        variable, later = variable_of(name), later_values(result, name)
        if variable is None:
            yield name, "", value if isinstance(value, str) else figure(value), "", False
        elif isinstance(value, str):
            other = value != getattr(variables, variable.type)(variable.start).name.lower()
            yield name, variable.description, value + later, "", bool(later) or other
        else:
            unit, factor, offset = unit_of(result, name, variable)
            shown = value if variable.type == "Integer" else factor * value + offset
            other = not math.isclose(value, variable.start, rel_tol=1e-9, abs_tol=1e-15) and name not in ineffective
            yield name, variable.description, figure(shown) + later, unit, bool(later) or other


def ball_rows(result):
    """Smallest, mean and largest values in the race contacts while they carry: (name, unit, three figures)."""
    late = settled(result)
    for title, name, factor, unit in (
        ("Load, inner race", "Q_i", 1.0, "N"),
        ("Load, outer race", "Q_e", 1.0, "N"),
        ("Pressure, inner race", "p_i", 1e-6, "MPa"),
        ("Pressure, outer race", "p_e", 1e-6, "MPa"),
        ("Contact angle, inner race", "alpha_i", DEG, "deg"),
        ("Contact angle, outer race", "alpha_e", DEG, "deg"),
        ("Film / roughness, inner race", "Lambda_i", 1.0, ""),
        ("Film / roughness, outer race", "Lambda_e", 1.0, ""),
        ("Spin / roll, inner race", "spin_roll", 1.0, ""),
    ):
        names = columns(result, "ball[", f"].{name}")
        loads = columns(result, "ball[", f"].Q_{'e' if name.endswith('e') else 'i'}")
        if not names or len(names) != len(loads):
            continue
        values = np.concatenate([result.data[n][late] for n in names])
        carrying = np.concatenate([result.data[n][late] for n in loads]) > 0.0
        if carrying.any():
            values = factor * values[carrying]
            yield title, unit, figure(values.min()), figure(values.mean()), figure(values.max())
