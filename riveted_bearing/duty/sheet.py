"""One sheet of paper for people who do not run the model: bearing, loads, verdict, the assumptions that move it, the
worst rivet, and digests of all files.

A mission is judged by its runs and, for peaks, pressures and films, by one more run of each point and event, with the
seed whose run had the largest damage.  A result of `run` is judged as if it went on like that.  Utilisation is

    life                  target/life, of the rivets and of the raceways
    fatigue, per place    1/x; with all stresses x times as large (preload's share included) the place just reaches the
                          target.  Without a target: largest amplitude over that of the S-N curve's knee
    contact pressure      largest pressure over bearing.p_limit
"""

import hashlib
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np

from ..base.units import figure
from ..base.version import __version__
from ..bearing.assumed import assumed_rows, measured_in
from ..running.accuracy import DECADES
from ..running.fmu import Model
from ..running.in_run import alone_note, change_lines
from ..running.responses import display_of
from ..running.results import Result
from ..running.summary import settled, table_note
from ..show import charts
from ..show.pages import save_page
from ..show.report import curve
from ..show.style import FORCE, HEAD, MIDDLE, MUTED, plt
from ..show.tornado import tornado
from .assess import Life
from .evidence import of_result
from .page import mission_text, part_rows, share_text
from .raceways import of_result as raceways_of
from .verdict import CHARACTERS, LINES, checks, clipped, judged, limits_crossed

MOST_CHECKS, MOST_ASSUMED, MOST_PARTS, MOST_LIMITS, MOST_REMARKS, MOST_BARS = 8, 3, 5, 4, 2, 5

STATES = {"good": "✓", "bad": "✗", "open": "?", "": ""}


@dataclass(frozen=True)
class Sheet:
    """Everything that stands on the sheet."""

    name: str
    description: str
    basis: dict
    verdict: tuple
    checks: tuple
    limits: tuple
    assumed: tuple
    assumed_from: str
    pictures: dict = field(repr=False)
    worst: str = ""
    parts: tuple = ()
    remarks: tuple = ()
    files: tuple = ()


def assumptions(result, figure, decides=None):
    """What moves the figure most, with range and effect, and where that is from; decides: a Sensitivity."""
    if decides:
        name = decides.responses[0]
        unit, factor, _ = display_of(name)
        indices, rows = decides.morris[name], []
        for k in decides.ranked[:MOST_ASSUMED]:
            factor_name = decides.factors[k]
            own_unit, scale, offset = display_of(factor_name)
            ends = decides.ranges.get(factor_name)
            span = " … ".join(f"{scale * end + offset:.3g}" for end in ends) if ends else "–"
            value = result.parameters.get(factor_name)
            shown = f"{scale * value + offset:.3g}" if isinstance(value, float) else "–"
            effect = f"{factor * indices['mu_star'][k]:.2g} {unit}".strip()
            rows.append((factor_name, f"{shown} {own_unit}".strip(), f"{span} {own_unit}".strip(), effect))
        return tuple(rows), f"mean change of {name} over the range, by the study {decides.name}"
    rows = assumed_rows(result, figure)[:MOST_ASSUMED]
    of = "damage" if figure == DECADES else "the worst head's stress"
    shown = tuple((row.name, *row.words, row.change(figure) or "–") for row in rows)
    return shown, f"change of {of} over the usual range, {measured_in(rows)}"


# The sheet ------------------------------------------------------------------------------------------------------------


def make_sheet(name, description, basis, evidence, target=None, decides=None, parts=(), remarks=(), files=()):
    """The Sheet of some Evidence; target: life [h] or None; files: paths whose digests stand on it."""
    worst = evidence.results[evidence.worst]
    figure_judged = DECADES if DECADES in evidence.budgets else "stress"
    rows, source = assumptions(worst, figure_judged, decides)
    found, parts = tuple(checks(evidence, target)), tuple(parts[:MOST_PARTS])
    limits = list(limits_crossed(evidence.results))
    if len(limits) > MOST_LIMITS:
        limits = [*limits[: MOST_LIMITS - 1], (True, f"{len(limits) - MOST_LIMITS + 1} others")]
    return Sheet(
        clipped(name, 60),
        clipped(description, CHARACTERS),
        fitted({key: text for key, text in basis.items() if key not in ("FMU", "scene")}, free_lines(found, parts)),
        judged(evidence, target),
        found,
        tuple(limits),
        rows,
        source,
        pictures(evidence, evidence.budgets.get(figure_judged)),
        f"rivet {evidence.rivet}" + (f", {clipped(evidence.worst, 28)}" if len(evidence.results) > 1 else ""),
        parts,
        tuple(clipped(text, 150) for text in [*filter(None, [table_note(worst)]), *remarks][:MOST_REMARKS]),
        tuple(
            (clipped(path.name, 40), hashlib.sha256(path.read_bytes()).hexdigest()[:16]) for path in map(Path, files)
        ),
    )


def pictures(evidence, budget):
    """The sheet's pictures by name: damage of the rivets, stress of the worst one, and, if it is known, the error budget."""
    worst, rivet = evidence.results[evidence.worst], evidence.rivet
    drawn = {  # draw(figure), size [inch], label
        "where": (
            lambda fig: rivets_chart(fig, evidence.damage, rivet),
            (2.5, 1.75),
            "Damage of the rivets on the circle",
        ),
        "when": (lambda fig: history_chart(fig, worst, rivet), (4.9, 1.75), "Stress of the worst rivet over time"),
    }
    if budget is not None:
        sign, label = (-1.0, "decades of life") if budget.figure == DECADES else (1.0, "")
        draw = lambda fig: tornado(fig, budget, sign, label, MOST_BARS)
        drawn["wrong"] = draw, (3.0, 1.5), "How wrong the verdict may be"
    return {name: charts.svg(*one) for name, one in drawn.items()}


def free_lines(checks, parts):
    """Lines that the rows of a sheet with fewer checks or parts of a mission leave to the basis."""
    return MOST_CHECKS - len(checks) + MOST_PARTS - len(parts) + (0 if parts else 1)


def fitted(texts, more=0):
    """Texts of the basis, the longest ones clipped line by line until all of them fit their place and `more` lines."""
    texts = dict(texts)
    lines = {key: -(-len(text) // CHARACTERS) for key, text in texts.items()}
    while sum(lines.values()) > max(LINES + more, len(lines)):
        longest = max(lines, key=lines.get)
        lines[longest] -= 1
        texts[longest] = clipped(texts[longest], lines[longest] * CHARACTERS)
    return texts


def rivets_chart(fig, damage, rivet):
    """The rivets at the start, seen from +X, coloured by damage over the largest; the first to fail marked."""
    ax = fig.subplots()
    share = np.array(damage) / (max(damage) or 1.0)
    angle = 2.0 * np.pi * (np.arange(len(share)) + 0.5) / len(share)
    y, z, k = np.cos(angle), np.sin(angle), rivet - 1
    ax.add_patch(plt.Circle((0, 0), 1.0, fill=False, color=MUTED, lw=6, alpha=0.35))
    dots = ax.scatter(y, z, s=70, c=share, cmap="viridis", vmin=0.0, vmax=1.0, edgecolor=FORCE, lw=0.5, zorder=3)
    ax.scatter(y[k], z[k], s=170, facecolor="none", edgecolor=HEAD, lw=1.6, zorder=4)
    for j in range(len(share)):
        ax.text(0.72 * y[j], 0.72 * z[j], str(j + 1), ha="center", va="center", fontsize=8)
    ax.set(aspect="equal", xlim=(-1.25, 1.25), ylim=(-1.25, 1.25), xticks=[], yticks=[])
    ax.grid(False)
    for side in ax.spines.values():
        side.set_visible(False)
    fig.colorbar(dots, ax=ax, label="damage, largest = 1", pad=0.02, shrink=0.85).outline.set_visible(False)


def history_chart(fig, result, rivet):
    """Stress of head and middle of a rivet after settling: largest and smallest value in each stretch."""
    ax, k = fig.subplots(), rivet
    late = settled(result)
    names = {"head": f"rivet[{k}].sigma_head", "mid": f"rivet[{k}].sigma_mid"}
    data = {"time": result.data["time"][late]} | {
        key: 1e-6 * np.maximum(result.data[name], result.data.get(f"{name}_peak", result.data[name]))[late]
        for key, name in names.items()
        if name in result.data
    }
    few = charts.thinned(replace(result, data=data), 300).data
    for key, colour, label in (("head", HEAD, "head fillet"), ("mid", MIDDLE, "middle")):
        if key in few:
            ax.plot(1e3 * few["time"], few[key], color=colour, lw=0.6, label=label)
    ax.set(xlabel="time [ms]", ylabel="MPa")
    ax.margins(x=0.0)
    ax.legend(ncols=2, loc="lower right", bbox_to_anchor=(1.0, 1.0))


def part_lines(life):
    """Points and events by their share in the damage: (name, load, speed, in the mission, share)."""
    share = dict(zip(life.kept, life.estimate.shares, strict=True))
    order = sorted(range(len(life.mission.parts)), key=lambda i: -share.get(i, 0.0))
    rows = list(part_rows(life))
    shown = [rows[i] for i in order]
    lines = [(clipped(row[0], 24), clipped(row[1], 64), row[2], row[3], row[7]) for row in shown]
    if len(lines) > MOST_PARTS:
        rest = sum(share.get(i, 0.0) for i in order[MOST_PARTS - 1 :])
        lines = [*lines[: MOST_PARTS - 1], (f"{len(lines) - MOST_PARTS + 1} others", "", "", "", share_text(rest))]
    return lines


def mission_sheet(
    life: Life, evidence: Any, target: Any = None, decides: Any = None, files: Any = (), remarks: Any = ()
) -> Any:
    """The Sheet of a mission; remarks: sentences beside the mission's own warnings."""
    mission = life.mission
    hours, passes = mission_text(life)
    return make_sheet(
        mission.name,
        mission.description,
        dict(mission.basis) | {"mission": f"{hours}, {passes}"},
        evidence,
        target,
        decides,
        part_lines(life),
        (*remarks, *mission.warnings),
        files,
    )


def write_sheet(sheet: Any, path: Path) -> Path:
    """Write the page, whole or not at all; returns its path."""
    return save_page(
        path,
        "sheet.html",
        sheet=sheet,
        style="sheet.css",
        states=STATES,
        figure=figure,
        version=__version__,
        date=datetime.now(UTC).isoformat(timespec="minutes").replace("+00:00", " UTC"),
    )


def result_sheet(
    result: Result, path: str | Path, fmu: Any = None, target: Any = None, decides: Any = None, cleanliness: Any = None
) -> Any:
    """The Sheet of a file of results; fmu: path of the FMU for its digest and ratings, None if it is not there."""
    about = result.about
    basis = dict(about.get("basis", {}))
    if "S-N curve" not in basis:
        basis["S-N curve"] = curve(result)
    raceways = raceways_of(Model(fmu) if fmu else None, result, cleanliness)
    evidence, changed = of_result(result, path, raceways), "; ".join(change_lines(result))
    if changed:
        changed = f"Changed {changed}"
    return make_sheet(
        about.get("scene") or Path(path).stem,
        about.get("description", ""),
        basis,
        evidence,
        target,
        decides,
        remarks=[note for note in (alone_note(result), changed) if note],
        files=[*filter(None, [fmu]), path],
    )
