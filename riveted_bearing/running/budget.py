"""How wrong a number is: its error in parts, the largest first.

    numerical      bias of the default tolerance, from finer runs on common seeds (accuracy.py)
    seeds          interval of the runs (accuracy.py; of a life: duty/confidence.py)
    rivet table    error of this FMU's table at loads that did not make it; of half and joints in other bearings (docs/rivet.md)
    assumed        effect of each assumed value over its range in this bearing (screening.py), of a given one over the drawing's
    model          a fixed list with what docs/validation.md knows; most of it has no size and is not added

A part is the distance of the truth from the number: a shift, and half-widths below and above.  Parts are taken as independent:
shifts add with their signs, half-widths of each side as the root of their squares.  Half-widths are those of 90 % intervals;
ranges of assumed values count as such.  A figure is in Pa, or in decades (log10 of damage, and of life with the other sign).
"""

import math
import re
from dataclasses import dataclass, replace
from statistics import NormalDist
from typing import Any

from ..base.errors import UserError
from ..base.units import certain, figure, with_error
from ..bearing.assumed import YOURS, Assumed, all_assumed
from .accuracy import CONFIDENCE, DECADES, FIGURES, PRIOR, WITHIN, Found, Runs, accurate, found_in, sample_of
from .fmu import Model
from .results import Result
from .scene import Scene
from .seeds import PULSES
from .summary import TABLE_TITLE, Row

RULE = (
    "independent parts: shifts add with their signs, half-widths of each side as the root of the sum of their squares; "
    "half-widths are those of 90 % intervals, ranges of assumed values count as such"
)
Z90 = NormalDist().inv_cdf(0.5 + 0.5 * CONFIDENCE)
HELD_OUT = re.compile(r"RMS ([\d.]+) %, largest ([\d.]+) % of the largest stress(?:, ([\d.]+) MPa)?")
OF_HALF = {1: (-0.001, 0.056), 2: (-0.042, 0.035)}  # truth over head stress less 1, by rivet.table_kind: docs/rivet.md
RIGID_HALVES = (-0.30, -0.07)  # the same of scene.cage = two_half: docs/validation.md, "Rigid and elastic halves"
MODEL = (
    ("elastic rivets", "above yield the stress is that of a linear material; flag rivet_yield tells"),
    ("rigid rings", "races and seats keep their circles; no measurement of thin housings"),
    ("lubrication regime", "film or mixed is chosen by scene.lubrication; starvation is not computed"),
)
DIGITS = ((0.2, 1), (0.02, 2))  # half-width in decades from which on a life has so few digits
ROUNDING = 1e-9  # in the units shown: what is smaller stands as 0
ASSUMED = "assumed"  # begins the source of such a part
SHOWN = 6  # parts in a line of text
JUDGED = ("stress", DECADES)
CHECKS = (4, 2)  # runs and finer runs of a check


@dataclass(frozen=True)
class Part:
    """A part of the error: shift and half-widths of the truth about the number, and where they are from."""

    name: str
    shift: float
    below: float
    above: float
    source: str

    @property
    def size(self):
        """By which parts are ranked."""
        return abs(self.shift) + max(self.below, self.above)


@dataclass(frozen=True)
class Budget:
    """The parts of a figure's error, the largest first; unsized: (name, what is known) of parts that are not added."""

    figure: str
    value: float
    parts: tuple
    unsized: tuple = ()

    @property
    def low(self):
        """Lower end of the interval."""
        return self.value + self.shift - math.sqrt(sum(part.below**2 for part in self.parts))

    @property
    def high(self):
        """Upper end of the interval."""
        return self.value + self.shift + math.sqrt(sum(part.above**2 for part in self.parts))

    @property
    def shift(self):
        """Sum of the shifts."""
        return math.fsum(part.shift for part in self.parts)

    @property
    def half(self):
        """Half-width of the interval, by which digits are chosen."""
        return 0.5 * (self.high - self.low)

    def record(self):
        """As JSON has it: numbers in SI or decades, all digits."""
        return {
            "figure": self.figure,
            "unit": "decades" if self.figure == DECADES else "Pa",
            "value": self.value,
            "low": self.low,
            "high": self.high,
            "confidence": CONFIDENCE,
            "rule": RULE,
            "parts": [vars(part) for part in self.parts],
            "not_added": [{"name": name, "known": known} for name, known in self.unsized],
        }


def of_record(record: dict[str, Any]) -> Budget:
    """The Budget that record() wrote."""
    parts = tuple(Part(**part) for part in record["parts"])
    return Budget(record["figure"], record["value"], parts, tuple((e["name"], e["known"]) for e in record["not_added"]))


def budgets(result: Result, plain: Any, fine: Any = ()) -> dict[str, Budget]:
    """The Budget of each figure that Samples of a Result's scene have."""
    rows, found = list(all_assumed(result.about, result.parameters)), found_in(plain, fine)
    known = result.about, result.summary, result.parameters
    return {figure: budget_of(figure, found[figure], *known, rows) for figure in JUDGED if figure in found}


def of_result(result: Result, damage: float | None = None) -> dict[str, Budget]:
    """The Budgets of a Result, else of its one run; damage: log10 per hour, if not counted; none without statistics."""
    if found := result.about.get("budget"):
        return {figure: of_record(record) for figure, record in found.items()}
    try:
        return budgets(result, [sample_of(result, damage=damage)])
    except UserError:
        return {}


# Parts ----------------------------------------------------------------------------------------------------------------


def budget_of(
    figure: str,
    found: Found,
    about: dict[str, Any],
    summary: dict[str, Any],
    parameters: dict[str, Any],
    rows: Any = (),
) -> Budget:
    """The Budget of a figure from its Found, what a Result says of its FMU, and the Assumed of its bearing."""
    value = found.plain
    size = 1.0 if figure == DECADES else abs(value)
    swing = PRIOR[DECADES] / PRIOR["stress"] if figure == DECADES else 1.0  # decades of damage per relative stress
    parts = [*numerical_parts(figure, found, parameters), *table_parts(about, summary, size, swing, figure, value)]
    parts += [part for row in rows if (part := assumed_part(row, figure, size))]
    unsized = [(row.name, row.unknown) for row in rows if row.effect is None]
    if parameters.get("scene.cage") == "two_half":
        low, high = (size * swing * end for end in RIGID_HALVES)
        parts.append(sided("rigid halves", low, high, "docs/validation.md: elastic halves in eight working points"))
    ranked = sorted(parts, key=lambda part: -part.size)
    return Budget(figure, value, tuple(ranked), (*unsized, *MODEL))


def numerical_parts(figure, found, parameters):
    """Error of the step and of the seeds; parameters: of the run."""
    n, m = found.runs
    source = f"{m} runs of finer steps on common seeds" if m else "no finer run: 102 scenes of benchmarks/blind.py"
    yield Part("numerical", found.shift, found.numerical, found.numerical, source)
    runs = f"{n} seeds" if n > 1 else "blocks of one run"
    if n > 1 and any(parameters.get(name) for name in PULSES):
        runs += ", each with another phase of the pulses"
    if found.one_motion:
        runs += ", which all fall on one motion: the scatter of its blocks counts, which more seeds do not reduce"
    yield Part("seeds", 0.0, found.seeds, found.seeds, runs)


def sided(name, low, high, source):
    """A part of which the truth lies between two distances: the middle is its shift."""
    return Part(name, 0.5 * (low + high), 0.5 * (high - low), 0.5 * (high - low), source)


def table_parts(about, summary, size, swing, figure, value):
    """Error of the rivets' stress table, and of half and joints."""
    kind = int(summary.get("rivet.table_kind", 0))
    written = about.get("model", "").partition(TABLE_TITLE)[2]
    if match := HELD_OUT.search(written):
        rms, _, largest = (float(text) if text else None for text in match.groups())
        relative = 0.01 * rms * (1e6 * largest / value if largest and figure != DECADES and value else 1.0)
        half = Z90 * relative * size * swing
        yield Part("rivet table", 0.0, half, half, f"this FMU's own, RMS {rms:g} % at loads that did not make it")
    if kind in OF_HALF:
        low, high = (size * swing * end for end in OF_HALF[kind])
        yield sided("half and joints", low, high, "docs/rivet.md: meshes of four other bearings")


def assumed_part(row: Assumed, figure: str, size: float) -> Part | None:
    """The part of a value with a range, None without a known effect, whose variance leaves its square, lest noise adds up."""
    if row.effect is None or figure not in row.effect:
        return None
    ends = [math.copysign(math.sqrt(max(0.0, e**2 - se**2)), e) for e, se in row.effect[figure]]
    below, above = max(0.0, -min(ends)), max(0.0, *ends)
    return Part(
        row.name, 0.0, size * below, size * above, f"{YOURS if row.source == YOURS else ASSUMED}, {row.words[1]}"
    )


def computed_share(result: Result) -> float:
    """Half-width of the stress over the stress by what computes it: all parts but those of values with ranges."""
    budget = of_result(result).get("stress")
    if budget is None or not budget.value:
        return 0.0
    parts = [part for part in budget.parts if not part.source.startswith((ASSUMED, YOURS))]
    return math.sqrt(sum((0.5 * (part.below + part.above)) ** 2 for part in parts)) / abs(budget.value)


def shown(row: Row, value: float, share: float) -> str:
    """A figure of a summary's Row with the digits that it has: of a stress those that its computed share leaves, else three."""
    if abs(value) <= ROUNDING:
        return "0"
    if row.unit == "MPa" and share and row.every_step:
        return certain(value, share * abs(value))
    return figure(float(f"{value:.3g}"))


# In words -------------------------------------------------------------------------------------------------------------


def told(budget: Budget) -> str:
    """The number with its interval and unit, no more digits than it has."""
    _, unit, factor = FIGURES[budget.figure]
    value, half = factor * budget.value, factor * budget.half
    below, above = factor * (budget.value - budget.low), factor * (budget.high - budget.value)
    return f"{with_error(value, half, below, above)} {unit}"


def amounts(budget: Budget) -> list[tuple[str, str, str]]:
    """Name, size and source of each part that shows beside the largest."""
    _, unit, factor = FIGURES[budget.figure]
    least = 0.02 * budget.half
    rows = []
    for part in budget.parts:
        if part.size > least:
            low, high = factor * (part.shift - part.below), factor * (part.shift + part.above)
            rows.append((part.name, f"{low:+.2g} … {high:+.2g} {unit}", part.source))
    return rows


def unsized_lines(budget: Budget) -> list[str]:
    """What is not added and why, the names of one reason in a line."""
    reasons: dict[str, list[str]] = {}
    for name, known in budget.unsized:
        reasons.setdefault(known, []).append(name)
    return [f"not added: {', '.join(names)}: {reason}" for reason, names in reasons.items()]


def digits(budgets: Any) -> int:
    """Digits that a life may have."""
    half = budgets[DECADES].half if DECADES in budgets else 0.0
    return next((few for width, few in DIGITS if half > width), 3)


def life_ends(budgets: Any) -> tuple[float, float] | None:
    """Ends of the life [h] by all parts of its error, None if they are not known."""
    if DECADES not in budgets:
        return None
    return 10.0 ** -budgets[DECADES].high, 10.0 ** -budgets[DECADES].low


def in_line(budget: Budget) -> str:
    """The largest parts in a line."""
    shown = [f"{name} {size}" for name, size, _ in amounts(budget)[:SHOWN]]
    return f"{FIGURES[budget.figure][0]} {told(budget)}: {', '.join(shown)}"


# A run with its error -------------------------------------------------------------------------------------------------


def known_result(
    model: Model, scene: Scene, check: bool, within: float = WITHIN, progress: Any = lambda runs: None
) -> Result:
    """The Result of a scene with its accuracy, if the scene asks for one, and with its Budgets if `check` is true, in `about`."""
    plain = replace(scene, accuracy=None)
    if scene.accuracy is None:
        runs = Runs(model, plain, progress)
        n, m = CHECKS
        samples, about, result = (runs(0, n), runs(1, m)), {}, runs(0, 1)[0].result
    else:
        reached = accurate(model, plain, scene.accuracy, within, progress)
        samples, about, result = reached.samples, {"accuracy": reached.record()}, reached.result
    if check:
        about["budget"] = {figure: budget.record() for figure, budget in budgets(result, *samples).items()}
    return replace(result, about=result.about | about)
