"""Results of a sweep: means over seeds with their confidence at each point, as a table, a picture and a page."""

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy import stats

from ..base.units import suffix
from ..running.basis import basis
from ..running.responses import NO_DAMAGE, response
from ..show import charts
from ..show.pages import save_page
from ..show.style import FORCE, HEAD, MIDDLE, MUTED, RING, picture
from .sweep_file import Sweep

CONFIDENCE = 0.95
SEED = "start.seed"
COLUMNS = {"simulation.t_end": "t_end", "simulation.step": "step", "simulation.tolerance": "solver.tol"}  # of factors
LEGEND_LINE = 0.085  # height of a line of the legend, of that of the panel
MOST_LINES = 5
LARGEST = 60  # lines of the table on a terminal
RESPONSES = (  # (title, unit, factor, column)
    ("head stress p99.9", "MPa", 1e-6, "stat.sigma_head_p999"),
    ("middle stress p99.9", "MPa", 1e-6, "stat.sigma_mid_p999"),
    ("pocket force RMS", "N", 1.0, "stat.Q_c_rms"),
    ("largest dislocation", "µm", 1e6, "max(cage.dislocation)"),
)


@dataclass(frozen=True)
class Response:
    """Means and half-widths (nan with one seed) of a response at the points of the design [P]."""

    title: str
    unit: str
    mean: np.ndarray
    half: np.ndarray


@dataclass(frozen=True)
class SweepTable:
    """factors with unit, points: texts or numbers [P, factors], seeds: runs [P], responses, basis of all."""

    name: str
    factors: tuple
    points: list
    seeds: np.ndarray
    responses: list
    basis: list


def sweep_table(sweep: Sweep, rows: Any) -> Any:
    """The SweepTable of a sweep's rows; runs that failed or were stopped do not count."""
    names = [name for name in sweep.factors if name != SEED]
    found = [shown(sweep.model, name, rows[COLUMNS.get(name, name)]) for name in names]
    units, columns = zip(*found, strict=True) if found else ((), ())
    done = rows["status"] == "done"
    groups = {}
    for i in np.flatnonzero(done):
        point = tuple(column[i] if isinstance(column[i], str) else float(column[i]) for column in columns)
        groups.setdefault(point, []).append(i)
    responses = []
    for title, unit, factor, column in RESPONSES:
        if column in rows and np.any(rows[column][done]):
            responses.append(Response(title, unit, *averaged(factor * rows[column], groups)))
    if done.any() and np.any((damage := response(Path(sweep.name), rows, "damage"))[done] > math.log10(NO_DAMAGE)):
        responses.append(Response("log10 damage per hour", "", *averaged(damage, groups)))
    factors = tuple(f"{name} [{unit}]" if unit else name for name, unit in zip(names, units, strict=True))
    seeds = np.array([len(group) for group in groups.values()])
    return SweepTable(sweep.name, factors, list(groups), seeds, responses, basis(sweep.model, sweep.scenes.values()))


def shown(model, name, values):
    """Unit in which people read a factor, "" for a text or a plain number, and its values in it."""
    variable = (model.parameters | model.inputs).get(name)
    if variable is None or values.dtype.kind not in "fi":
        return "", values
    symbol, (factor, offset) = model.display(variable)
    return suffix(symbol).strip(), factor * values + offset


def averaged(values, groups):
    """Means over the runs of each group and half-widths of their interval by Student's t."""
    mean = np.array([values[group].mean() for group in groups.values()])

    def half(sample):
        error = sample.std(ddof=1) / math.sqrt(len(sample)) if len(sample) > 1 else math.nan
        return stats.t.ppf(0.5 + 0.5 * CONFIDENCE, len(sample) - 1) * error

    return mean, np.array([half(values[group]) for group in groups.values()])


def lines(table: Any) -> Any:
    """Heads and cells of the table as texts."""
    titles = [f"{each.title} [{each.unit}]" if each.unit else each.title for each in table.responses]
    cells = []
    for p, point in enumerate(table.points):
        values = [value if isinstance(value, str) else f"{value:.6g}" for value in point]
        means = [cell(response.mean[p], response.half[p]) for response in table.responses]
        cells.append([*values, str(table.seeds[p]), *means])
    return [*table.factors, "seeds", *titles], cells


def cell(mean, half):
    """A mean and its half-width with the digits that these allow."""
    return f"{mean:.4g}" if math.isnan(half) else f"{mean:.4g} ± {float(f'{half:.2g}'):g}"


def draw_response(ax, table, response):
    """A response over the first factor, one line for each value of the others."""
    numbers = table.factors and not isinstance(table.points[0][0], str)
    groups = {}
    for p, point in enumerate(table.points):
        groups.setdefault(point[1:], []).append(p)
    ticks = [] if numbers else list(dict.fromkeys(point[0] if point else "" for point in table.points))
    for (rest, places), colour in zip(groups.items(), colours(len(groups)), strict=True):
        firsts = [table.points[p][0] if table.points[p] else "" for p in places]
        x = firsts if numbers else list(map(ticks.index, firsts))
        order = np.argsort(x)
        places, x = np.array(places)[order], np.array(x, float)[order]
        label = ", ".join(value if isinstance(value, str) else f"{value:.5g}" for value in rest)
        style = "o-" if numbers and len(groups) <= MOST_LINES else "o"
        half, look = np.nan_to_num(response.half[places]), {"ms": 4, "lw": 1.0, "capsize": 2}
        ax.errorbar(x, response.mean[places], yerr=half, fmt=style, color=colour, label=label, **look)
    if ticks:
        ax.set_xticks(range(len(ticks)), ticks)
    label = table.factors[0] if table.factors else ""
    ax.set(title=response.title, xlabel=label, ylabel=response.unit or response.title)
    ax.margins(x=0.06, y=0.12)
    if 1 < len(groups) <= MOST_LINES:
        ax.set_ylim(top=ax.get_ylim()[1] + LEGEND_LINE * (2 + (len(groups) - 1) // 3) * np.ptp(ax.get_ylim()))
        ax.legend(title=", ".join(table.factors[1:]), title_fontsize=8, ncols=3, loc="upper left")


def colours(count):
    """One colour for each line; points alone share one."""
    return [MIDDLE, HEAD, RING, FORCE, MUTED][:count] if count <= MOST_LINES else [MIDDLE] * count


def write_picture(table: Any, path: Path) -> Path:
    """The responses side by side as PNG, whole or not at all; returns the path."""
    columns = min(3, len(table.responses))
    rows = -(-len(table.responses) // columns)
    title = f"{table.name}: means over seeds, {100 * CONFIDENCE:g} % intervals"
    with picture(path, (4.4 * columns, 0.5 + 3.3 * rows), title) as figure:
        axes = figure.subplots(rows, columns, squeeze=False)
        for ax in axes.ravel()[len(table.responses) :]:
            ax.remove()
        for ax, response in zip(axes.ravel(), table.responses, strict=False):
            draw_response(ax, table, response)
    return path


def write_page(table: Any, description: Any, path: Path) -> Path:
    """Table and charts as one HTML page, whole or not at all; returns the path."""
    heads, cells = lines(table)
    pictures = [
        charts.svg(lambda fig, r=response: draw_response(fig.subplots(), table, r), (4.9, 3.2), response.title)
        for response in table.responses
    ]
    told = {"table": table, "description": description, "confidence": f"{100 * CONFIDENCE:g} %"}
    return save_page(path, "sweep.html", heads=heads, cells=cells, charts=pictures, **told)
