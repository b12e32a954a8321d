"""What a comparison of designs leaves: record, ratios in words, charts and page."""

import math
from pathlib import Path
from typing import Any

import numpy as np

from ..base.files import write_json
from ..base.units import LONGEST, hours_text
from ..running.accuracy import DECADES
from ..running.budget import digits
from ..show import charts
from ..show.pages import save_page
from ..show.style import FORCE, HEAD, MIDDLE, MUTED, RING, few_ticks
from ..show.tornado import tornado
from .designs import APART, HEAD_STRESS, RESPONSES, ends_of
from .page import OPEN, interval_text, open_ends
from .raceways import card, finite
from .raceways import record as raceway_record
from .verdict import clipped

RECORD, PAGE = "designs.json", "designs.html"
COLOURS = (FORCE, MIDDLE, HEAD, RING, MUTED)


def ratio_text(ratio: Any) -> str:
    """A Ratio with its interval, or that it is open; – where there is none."""
    if ratio is None:
        return ""
    if math.isnan(ratio.ratio):
        return "–"
    if open_ends(ratio.ratio, ratio.low, ratio.high):
        return f"{ratio.ratio:.3g} (open)"
    return f"{ratio.ratio:.3g} ({ratio.low:.3g} … {ratio.high:.3g})"


def parts_of_stress(outcome):
    """Static stress and swing of the place that fails first, at the part with the most damage: two (mean, Ratio)."""
    place = "middle" if "middle" in outcome.place else "head"
    return [outcome.responses[outcome.deciding][f"{place}_{part}"] for part in ("static", "swing")]


def parts_text(outcome: Any) -> str:
    """These two in words, with their ratios to the first design's."""
    if not outcome.responses:
        return ""
    texts = (
        f"{1e-6 * mean:.3g}" + (f" ({ratio.ratio:.2g})" if ratio else "") for mean, ratio in parts_of_stress(outcome)
    )
    return f"{' + '.join(texts)} MPa"


def against_stress(outcome):
    """Words on a static stress that goes the other way than the life, "" if it does not."""
    if not outcome.responses:
        return ""
    (_, static), (_, swing) = parts_of_stress(outcome)
    longer = outcome.life.ratio > 1.0
    if static.ratio > APART if longer else static.ratio < 1.0 / APART:
        return f" at {static.ratio:.2g} times the static stress: damage follows the swing, {swing.ratio:.2g} times the first's"
    return ""


def verdict(outcome: Any) -> str:
    """A sentence on a design against the first one."""
    ratio = outcome.life
    if ratio is None or math.isnan(ratio.ratio):
        return ""
    if ratio.low == ratio.high == 1.0:
        return "the same"
    if not ratio.differs:
        return "no difference that the runs show"
    life = outcome.estimate.life
    both = f", both {hours_text(life)}" if min(life, life / ratio.ratio) > LONGEST else ""
    return ("lives longer" if ratio.ratio > 1.0 else "lives shorter") + both + against_stress(outcome)


def record(found):
    """designs.json's content."""
    return {
        "mission": found.name,
        "confidence": found.confidence,
        "runs_of_cases": list(found.counts),
        "designs": [
            {
                "name": outcome.design.name,
                "fmu": str(outcome.design.model.path),
                "fmu_sha256": outcome.design.model.digest,
                "settings": outcome.design.settings,
                "life_h": finite(outcome.estimate.life),
                "low_h": finite(outcome.estimate.low),
                "high_h": finite(outcome.estimate.high),
                "place": outcome.place,
                "error_budget": {figure: budget.record() for figure, budget in outcome.budgets.items()},
                "life_ratio": ratio_record(outcome.life),
                "raceways": raceway_record(outcome.raceways),
                "responses": {
                    part: {
                        name: {"mean": float(mean), "ratio": ratio_record(ratio)}
                        for name, (mean, ratio) in values.items()
                    }
                    for part, values in outcome.responses.items()
                },
            }
            for outcome in found.outcomes
        ],
        "differences": [{"name": name, "values": list(texts)} for name, texts in found.differences],
    }


def ratio_record(ratio):
    """A Ratio for JSON."""
    if ratio is None:
        return None
    return {key: finite(getattr(ratio, key)) for key in ("ratio", "low", "high", "correlation")}


def write_record(found: Any, folder: str | Path) -> Path:
    """Write designs.json, whole or not at all; returns its path."""
    return write_json(Path(folder) / RECORD, record(found))


def life_chart(fig, found):
    """Life of each design with its interval; in words beyond LONGEST."""
    ax = fig.subplots()
    told = [outcome for outcome in found.outcomes if outcome.estimate.life <= LONGEST]
    for k, outcome in enumerate(found.outcomes):
        colour = COLOURS[k % len(COLOURS)]
        if outcome in told:
            ax.plot(shown_ends(outcome), [k, k], color=colour, lw=3, solid_capstyle="butt")
            ax.plot(outcome.estimate.life, k, "o", color=colour, ms=7)
        else:
            look = {"transform": ax.get_yaxis_transform(), "ha": "right", "va": "center", "color": colour}
            ax.text(0.98, k, f"{hours_text(outcome.estimate.life)} →", **look)
    ends = [x for outcome in told for x in shown_ends(outcome) if math.isfinite(x)]
    ax.set_xscale("log")
    if ends and max(ends) < 10.0 * min(ends):
        few_ticks(ax, np.geomspace(min(ends), max(ends), 4))
    ax.set_yticks(range(len(found.outcomes)), [clipped(outcome.design.name, 26) for outcome in found.outcomes])
    ax.set(xlabel="life [h]", ylim=(len(found.outcomes) - 0.5, -0.5))
    ax.grid(axis="y", visible=False)


def shown_ends(outcome):
    """Ends of the interval of life [h] as the picture shows them, an open one at OPEN times the life."""
    life, low, high = ends_of(outcome)
    return max(low, life / OPEN), min(high, life * OPEN)


def ratio_chart(fig, found):
    """Ratio of the head stress to the first design's, part by part."""
    ax, response = fig.subplots(), HEAD_STRESS
    names = list(found.outcomes[0].responses)
    for k, outcome in enumerate(found.outcomes[1:], 1):
        for i, part in enumerate(names):
            ratio = outcome.responses[part][response][1]
            if not math.isnan(ratio.ratio):
                y = i + 0.16 * (k - 0.5 * len(found.outcomes))
                ax.plot([ratio.low, ratio.high], [y, y], color=COLOURS[k % len(COLOURS)], lw=2.4)
                ax.plot(ratio.ratio, y, "o", color=COLOURS[k % len(COLOURS)], ms=5)
    ax.axvline(1.0, color=MUTED, lw=1.0, ls="--")
    ax.set_yticks(range(len(names)), [clipped(name, 26) for name in names])
    ax.set(xlabel=f"{RESPONSES[response][0]}, over the first design's", ylim=(len(names) - 0.5, -0.5))
    ax.grid(axis="y", visible=False)


def write_page(found: Any, path: Path) -> Path:
    """Write the page, whole or not at all; returns its path."""
    heights = 1.1 + 0.45 * len(found.outcomes), 1.1 + 0.5 * len(found.outcomes[0].responses)

    def picture(draw, height, label):
        return charts.svg(draw, (4.9, height), label)

    def wrong(k, budget):
        label = "true life over the number [decades]"
        return picture(lambda fig: tornado(fig, budget, -1.0, label), 2.6, f"How wrong the life of design {k} may be")

    return save_page(
        path,
        "designs.html",
        found=found,
        responses=RESPONSES,
        raceway_card=card,
        interval_text=lambda outcome: interval_text(*ends_of(outcome), few=digits(outcome.budgets)),
        life_text=lambda outcome: hours_text(outcome.estimate.life, digits(outcome.budgets)),
        budgets=lambda outcome: list(outcome.budgets.values()),
        ratio_text=ratio_text,
        verdict=verdict,
        charts={
            **{
                f"wrong {k}": wrong(k + 1, outcome.budgets[DECADES])
                for k, outcome in enumerate(found.outcomes)
                if DECADES in outcome.budgets
            },
            "life": picture(lambda fig: life_chart(fig, found), max(1.8, heights[0]), "Life of the designs"),
            "ratios": picture(lambda fig: ratio_chart(fig, found), max(1.8, heights[1]), "Head stress of the designs"),
        },
    )
