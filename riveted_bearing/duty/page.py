"""The page of a mission: life with its confidence, who contributes, rivet by rivet, damage against load and speed."""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from scipy.stats import t as student

from ..base.units import LONGEST, figure, hours_text
from ..running.accuracy import DECADES
from ..running.budget import digits, life_ends
from ..running.summary import RPM
from ..show import charts
from ..show.pages import save_page
from ..show.style import FORCE, HEAD, MIDDLE, MUTED, RING, few_ticks, picture
from ..show.tornado import tornado
from .assess import Life
from .raceways import card

MOST_BARS = 14
OPEN = 11.0  # times life: an end of the interval beyond it, or below life over it, says nothing
BEYOND = 1.6  # half-widths of ln life that the picture shows on each side
WIDE, TALL = (4.9, 2.9), (4.9, 3.6)  # inches


def write_page(life: Life, path: Path, notes: Any, warnings: Any = ()) -> Path:
    """Write a Life's page with sentences (notes) and further warnings, whole or not at all; returns the path."""
    return save_page(
        path,
        "life.html",
        mission=life.mission,
        cards=list(cards(life)),
        rows=list(part_rows(life)),
        notes=notes,
        warnings=[*life.mission.warnings, *warnings],
        told=life.estimate.life <= LONGEST,
        charts={
            name: charts.svg(lambda fig, draw=draw: draw(fig, life), size, label)
            for name, (draw, size, label) in charts_of(life).items()
        },
        budgets=list(life.budgets.values()),
    )


def share_text(share):
    """A share of the damage in per cent."""
    return f"{100 * share:.3g} %" if share < 0.9995 and share >= 1e-3 else "100 %" if share > 0.5 else "< 0.1 %"


def cards(life: Life) -> Iterator[Any]:
    """The figures to see first: (title, value, remark)."""
    found, settings = life.estimate, life.mission.settings
    few = digits(life.budgets)
    yield "Life of the rivets", hours_text(found.life, few), f"{life.place} · Miner's sum 1"
    if (ends := life_ends(life.budgets)) and found.life <= LONGEST:
        largest = ", ".join(part.name for part in life.budgets[DECADES].parts[:3])
        both = " – ".join(hours_text(end, few) for end in ends)
        yield "with all its errors", both, f"90 %, by parts: {largest} first"
    interval = interval_text(*ends_of(life), few=few)
    yield f"{100 * settings['confidence']:g} % interval", interval, f"of the runs, {width_text(life)}"
    yield "Life of the raceways", *card(life.mission.raceways())
    yield "Mission", *mission_text(life)
    simulated = sum(part.scene is not None for part in life.mission.parts) - len(life.bounds)
    yield "Runs", f"{sum(life.counts)}", f"{simulated} points and events simulated"


def mission_text(life):
    """How long a mission is, and a life in passes of it; one of shares alone has no length."""
    mission, found = life.mission, life.estimate
    if not mission.shares:
        return f"{figure(mission.hours)} h", passes_text(found.life, mission.hours, digits(life.budgets))
    if any(part.event for part in mission.parts):
        return (
            "shares of an hour",
            f"events count for each hour · {passes_text(found.life, mission.hours, digits(life.budgets))}",
        )
    return "shares of time", "of any length"


def ends_of(life: Any) -> tuple[float, float, float]:
    """Life, lower and upper end of a Life's interval [h]."""
    return life.estimate.life, life.low, life.estimate.high


def open_ends(life, low, high):
    """Which ends of the interval are so far from life that they say nothing: "lower", "upper"."""
    if not math.isfinite(life):
        return []
    return [end for end, far in (("lower", life > OPEN * low), ("upper", high > OPEN * life)) if far]


def interval_text(life: Any, low: Any, high: Any, few: int = 3) -> str:
    """The interval, without the ends that are open; few: digits."""
    low_text, high_text, ends = hours_text(low, few), hours_text(high, few), open_ends(life, low, high)
    if len(ends) == 2:
        return "open at both ends"
    if ends == ["lower"]:
        return "open" if high > LONGEST else f"below {high_text}"
    if ends:
        return low_text if low > LONGEST else f"above {low_text}"
    return low_text if low_text == high_text else f"{low_text} – {high_text}"


def open_text(ends):
    """Which ends of an interval are open and what closes them."""
    return f"open at its {' and its '.join(ends)} end: more seeds (max_seeds) or a longer t_end close it"


def width_text(life):
    """How wide the interval is, or which of its ends are open and what closes them; nothing of one beyond LONGEST."""
    if min(life.low, life.estimate.life) > LONGEST:
        return "longer than a life can be told"
    if ends := open_ends(*ends_of(life)):
        return open_text(ends)
    return f"half-width {percent(life.estimate.half_width)} of life"


def passes_text(life, hours, few=3):
    """A life in passes of the mission; few: digits."""
    if not math.isfinite(life):
        return "no damage"
    if life < hours:
        return f"fails within the first pass, after {hours_text(life)}"
    return (
        f"{'> ' if life > LONGEST else ''}{figure(float(f'{min(life, max(LONGEST, hours)) / hours:.{few}g}'))} passes"
    )


def percent(half_width: Any) -> str:
    """A half-width of ln life as a share of life."""
    return f"{100 * math.expm1(half_width):.3g} %" if half_width <= math.log(OPEN) else f"> {100 * (OPEN - 1):,.0f} %"


def part_rows(life: Life) -> Iterator[Any]:
    """Name, load, speed, weight, how it was simulated, damage per hour or event, share of each part."""
    share = dict(zip(life.kept, life.estimate.shares, strict=True))
    for i, part in enumerate(life.mission.parts):
        weight = f"{figure(part.weight)} times" if part.event else time_text(part.weight, life.mission)
        if i in life.bounds:
            how, rate, text = "left out", "", f"< {100 * life.bounds[i] * life.estimate.life:.2g} %"
        else:
            how = "interpolated" if part.scene is None else f"{life.counts[i]} seeds"
            rate, text = f"{rate_at_place(life, i):.3g}", share_text(share[i])
        yield part.name, part.load, part.speed, weight, how, rate, "event" if part.event else "h", text


def time_text(hours, mission):
    """The hours of a point, or their share of the whole if the mission has shares."""
    return f"{figure(100.0 * hours / mission.hours)} %" if mission.shares else f"{figure(hours)} h"


def rate_at_place(life, i):
    """Damage of part i per hour or event at the place that fails first."""
    place = life.estimate.place
    each = life.mission.settings["rivets"] == "each"
    return life.rates[i].reshape(-1)[place] if each else life.rates[i, :, place].mean()


def life_chart(fig, life):
    """How likely each life is by the scatter of the runs, the interval shaded."""
    ax, found = fig.subplots(), life.estimate
    if found.life > LONGEST:  # no scatter to draw
        why = "the S–N curve is not known\nfor so many cycles, so that its scatter says nothing"
        text = f"{hours_text(found.life)}: {why}" if math.isfinite(found.life) else "no damage"
        ax.text(0.5, 0.5, text, ha="center", transform=ax.transAxes)
        ax.set(xticks=[], yticks=[])
        return
    beyond = min(max(BEYOND * found.half_width, math.log(found.life / life.low)), BEYOND * math.log(OPEN)) or 0.1
    hours, likely = life_density(found, beyond)
    label = f"{100 * life.mission.settings['confidence']:g} % interval"
    ax.axvspan(life.low, found.high, color="#f3f4f6", zorder=0, label=label)
    ax.fill_between(hours, likely, color=MIDDLE, alpha=0.8, lw=0, label="Student's law")
    ax.axvline(found.life, color=HEAD, lw=1.8, label="life")
    ax.set_xscale("log")
    ax.set(xlabel="life [h]", ylabel="density of ln life", xlim=(hours[0], hours[-1]), ylim=(0.0, None))
    if hours[-1] < 10.0 * hours[0]:
        few_ticks(ax, np.geomspace(hours[0], hours[-1], 5)[1:-1])
    ax.legend(ncols=3, loc="lower right", bbox_to_anchor=(1.0, 1.0))


def life_density(found, beyond):
    """Lives [h] up to the factor exp(beyond) from an Estimate's, and the density of ln life by which its interval is made."""
    x = np.linspace(-beyond, beyond, 401)
    likely = student.pdf(x / found.spread, found.freedom) / found.spread if found.spread > 0.0 else np.zeros_like(x)
    return found.life * np.exp(x), likely


def share_chart(fig, life):
    """Share of each part in the damage, the largest first."""
    ax = fig.subplots()
    parts = [(life.mission.parts[i], share) for i, share in zip(life.kept, life.estimate.shares, strict=True)]
    parts.sort(key=lambda pair: -pair[1])
    shown = parts if len(parts) <= MOST_BARS else parts[: MOST_BARS - 1]
    rows = [(part.name, share, RING if part.event else MIDDLE) for part, share in shown]
    if rest := parts[len(shown) :]:
        rows.append((f"{len(rest)} others", sum(share for _, share in rest), MUTED))
    names, shares, colours = zip(*rows, strict=True)
    bars = ax.barh(range(len(names)), 100 * np.array(shares), color=colours, height=0.66)
    ax.bar_label(bars, [share_text(share) for share in shares], padding=3, fontsize=8)
    ax.set_yticks(range(len(names)), names)
    ax.invert_yaxis()
    ax.grid(axis="y", visible=False)
    ax.set(xlabel="share of the damage [%]", xlim=(0, 115 * max(shares, default=1.0) or 1.0))


def rivet_chart(fig, life):
    """Damage per hour of the mission of each rivet's head and middle."""
    ax = fig.subplots()
    damage = np.einsum("i,ikp->kp", life.mission.duty.weights, life.rates)
    k = np.arange(1, len(damage) + 1)
    for place, colour, label in ((0, HEAD, "head fillet"), (1, MIDDLE, "middle of the shank")):
        look = {"width": 0.36, "color": colour, "alpha": 0.85, "label": label}
        ax.bar(k + 0.4 * place - 0.2, np.maximum(damage[:, place], 1e-300), **look)
    seen = damage[damage > 1e-299]
    if len(seen):
        ax.set_yscale("log")
        ax.set_ylim(10 ** math.floor(math.log10(seen.min()) - 0.3), 10 ** (math.log10(seen.max()) + 0.3))
    ax.set(xlabel="rivet", ylabel="damage per hour")
    ax.set_xticks(k)
    ax.grid(axis="x", visible=False)
    ax.legend(ncols=2, loc="lower right", bbox_to_anchor=(1.0, 1.0))


def load_and_speed_chart(fig, life):
    """Damage per hour of the points over their radial load, coloured by speed; the area grows with the hours."""
    ax = fig.subplots()
    points = [i for i in life.kept if not life.mission.parts[i].event]
    load, speed = np.array([condition(life.mission.parts[i].values) for i in points]).T
    rate = np.array([rate_at_place(life, i) for i in points])
    hours = np.array([life.mission.parts[i].weight for i in points])
    if np.ptp(load) == 0.0 and np.ptp(speed) > 0.0:
        x, colour, labels = speed, load, ("speed [rev/min]", "radial load [kN]")
    else:
        x, colour, labels = load, speed, ("radial load [kN]", "speed [rev/min]")
    varies = np.ptp(colour) > 0.0
    look = {"c": colour, "cmap": "viridis"} if varies else {"color": MIDDLE}
    dots = ax.scatter(
        x, np.maximum(rate, 1e-300), s=18 + 130 * hours / hours.max(), edgecolor=FORCE, lw=0.5, alpha=0.9, **look
    )
    ax.set(xlabel=labels[0], ylabel="damage per hour")
    if np.any(rate > 1e-299):
        ax.set_yscale("log")
        low, high = np.log10([rate[rate > 1e-299].min(), rate.max()])
        ax.set_ylim(10 ** (low - 0.12 * (high - low) - 0.3), 10 ** (high + 0.12 * (high - low) + 0.3))
    ax.margins(x=0.12)
    if varies:
        fig.colorbar(dots, ax=ax, label=labels[1], pad=0.02).outline.set_visible(False)


def condition(values):
    """Radial load [kN] and speed [rev/min] of a point."""
    loads = [values.get(name) or 0.0 for name in ("shaft.F_y", "shaft.F_z")]
    return 1e-3 * math.hypot(*loads), RPM * (values.get("shaft.omega") or 0.0)


CHARTS = {
    "life": (life_chart, WIDE, "Life and its confidence"),
    "shares": (share_chart, TALL, "Share of each point and event in the damage"),
    "rivets": (rivet_chart, WIDE, "Damage of each rivet"),
    "conditions": (load_and_speed_chart, TALL, "Damage against load and speed"),
    "wrong": (
        lambda fig, life: tornado(fig, life.budgets[DECADES], -1.0, "true life over the number, decades"),
        TALL,
        "How wrong the life may be, by parts",
    ),
}


def charts_of(life):
    """The charts that a Life has: only with an error budget one of it."""
    return {name: chart for name, chart in CHARTS.items() if name != "wrong" or DECADES in life.budgets}


def write_picture(life: Life, path: Path) -> Path:
    """The charts as one PNG, whole or not at all; returns the path."""
    shown = charts_of(life).values()
    rows = (len(shown) + 1) // 2
    title = f"{life.mission.name}: life {hours_text(life.estimate.life, digits(life.budgets))}, {life.place}"
    with picture(path, (11, 3.7 * rows), title) as whole:
        for part, (draw, _, label) in zip(whole.subfigures(rows, 2).ravel(), shown, strict=False):
            draw(part, life)
            part.suptitle(label, x=0.02, ha="left", fontsize=10, fontweight="bold")
    return path
