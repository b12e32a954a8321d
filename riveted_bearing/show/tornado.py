"""An error budget as a picture: a bar for each part, the largest on top, and the whole below."""

from typing import Any

from ..running.accuracy import FIGURES
from ..running.budget import Budget, amounts, computed_share, of_result, shown
from ..running.results import Result
from . import charts
from .style import FORCE, HEAD, MIDDLE

MOST = 7  # bars beside the whole


def tornado(fig: Any, budget: Budget, sign: float = 1.0, label: str = "", most: int = MOST) -> None:
    """Draw a Budget: the distance of the truth from the number by its `most` largest parts; sign: -1 for life, which
    falls as damage grows.
    """
    ax = fig.subplots()
    _, unit, factor = FIGURES[budget.figure]
    named = {name for name, *_ in amounts(budget)}
    parts = [part for part in budget.parts if part.name in named][:most]
    bars = [(part.name, part.shift - part.below, part.shift + part.above, part.source) for part in parts]
    bars.append(("all parts", budget.low - budget.value, budget.high - budget.value, ""))
    for k, (_, low, high, source) in enumerate(bars):
        low, high = sorted(sign * factor * end for end in (low, high))
        colour = HEAD if not source else MIDDLE if source.startswith("assumed") else FORCE
        ax.barh(k, high - low, left=low, height=0.62, color=colour)
    ax.axvline(0.0, color=FORCE, lw=0.8)
    ax.set_yticks(range(len(bars)), [name for name, *_ in bars])
    ax.invert_yaxis()
    ax.use_sticky_edges = False
    ax.margins(x=0.04)  # the longest bar ends inside the axes
    ax.grid(axis="y", visible=False)
    ax.set_xlabel(
        label or f"truth less number [{unit}]", loc="right"
    )  # beside short names the axes are narrower than the label


def wrong(result: Result) -> dict[str, Any]:
    """The error budgets that a Result carries, as tables and pictures."""
    found = list(of_result(result).values()) if "budget" in result.about else []
    pictures = [
        charts.svg(lambda fig, each=each: tornado(fig, each), (4.9, 3.0), f"How wrong: {FIGURES[each.figure][0]}")
        for each in found
    ]
    return {
        "budgets": found,
        "budget_pictures": pictures,
        "shown": shown,
        "share": computed_share(result),
    }
