"""The paper's claims against the runs of the study: the evaluation of claims.toml, which explains itself."""

import re
import tomllib
from dataclasses import dataclass
from itertools import product
from pathlib import Path

import numpy as np
from figures import CLEARANCES, SCATTER, Estimate, Runs, clearance_series, estimate
from scipy.stats import norm

PICTURES = tomllib.loads(Path(__file__).with_name("claims.toml").read_text(encoding="utf-8"))
NUMBERS = PICTURES.pop("numbers")
MEASURES = {"mean": "", "p99.9": "_peak", "range": "_range"}  # measures of the stress: end of the columns' names
LOOP = r" for (\$\w+) in ([^$]+?)(?= for \$|$)"
PREDICATES = {
    ">": lambda a, b: a.low > b.high,
    ">=": lambda a, b: a.low >= b.high,
    "<": lambda a, b: a.high < b.low,
    "<=": lambda a, b: a.high <= b.low,
    "exceeds": lambda a, b: a.mean > b.mean,
    "within": lambda a, b: b.low <= a.low and a.high <= b.high,
}


@dataclass(frozen=True)
class Claim:
    """A sentence of the paper: its place, the claim in short, the paper's words, the condition in words and why it is
    fair; figures of the runs, which conditions they meet, and which of those before the repair; the reason.
    """

    where: str
    said: str
    sentence: str
    condition: str
    reason: str
    found: str
    holds: tuple
    before: tuple
    repaired: bool
    why: str

    @property
    def verdict(self):
        """reproduced, partly or not: all, some or none of the conditions are met."""
        return verdict_of(self.holds)

    @property
    def verdict_before(self):
        """The verdict by the conditions before the repair."""
        return verdict_of(self.before)


def verdict_of(holds):
    """reproduced, partly or not: all, some or none of the conditions are met."""
    return "reproduced" if all(holds) else "partly" if any(holds) else "not"


def all_claims(data, measure="mean"):
    """Claims for which there are runs, in the order of the paper, by the picture; measure: of the stress."""
    return {
        name: Figures(data, data[sweep_of(name)], picture, measure).claims()
        for name, picture in PICTURES.items()
        if sweep_of(name) in data
    }


def number_of_claims():
    """Number of the paper's claims, with or without runs."""
    return sum(": " in title for picture in PICTURES.values() for title in picture)


def sweep_of(picture):
    """Name of the sweep whose runs a picture shows."""
    return PICTURES[picture].get("sweep", picture)


def numbers(data):
    """The paper's numbers for which there are runs: (what, the paper's value, the value in these runs)."""
    return [
        (number["what"], number["paper"], figures_of(data, number["sweep"]).filled(number["value"]))
        for number in NUMBERS
        if sweep_of(number["sweep"]) in data
    ]


def figures_of(data, picture, measure="mean"):
    """Figures of the runs of a picture."""
    return Figures(data, data[sweep_of(picture)], PICTURES[picture], measure)


@dataclass(frozen=True)
class Figures:
    """Figures of the runs of one picture, a table of claims.toml; data: Runs of all sweeps by name; measure: of the
    stress.
    """

    data: dict
    runs: Runs
    picture: dict
    measure: str = "mean"

    def claims(self):
        """The picture's Claims of which all runs are there."""
        tables = {title: table for title, table in self.picture.items() if ": " in title}
        return [
            self.claim(*title.split(": ", 1), **table)
            for title, table in tables.items()
            if all(sweep in self.data for sweep in others(table["holds"]))
        ]

    def claim(self, where, said, holds, sentence, condition, reason, why, here, before=None, lines=()):
        """The Claim of its table."""
        here += "".join(f"\n    - {line}" for line in repeated(lines))
        now, old = (tuple(map(self.met, repeated(conditions))) for conditions in (holds, before or holds))
        return Claim(
            where, said, sentence, condition, reason, self.filled(here), now, old, before is not None, self.filled(why)
        )

    def filled(self, text):
        """A text with figures for its quantities; a format after a colon is for the mean, "[]" adds the interval."""
        return re.sub(r"{([^{}:]+):?([^{}]*)}", lambda match: shown(self.value(match[1]), match[2]), text)

    def met(self, condition):
        """Whether "QUANTITY PREDICATE QUANTITY" holds, or all of several joined by "and"; "PICTURE: ..." for another
        picture's runs.
        """
        if other := re.fullmatch(r"(\w+): (.+)", condition):
            return figures_of(self.data, other[1], self.measure).met(other[2])
        parts = (
            re.fullmatch(r"(.+) (>=?|<=?|exceeds|within) (.+)", part).groups() for part in condition.split(" and ")
        )
        return all(PREDICATES[word](self.estimate(left), self.estimate(right)) for left, word, right in parts)

    def estimate(self, text):
        """A quantity, a number or a range a..b as an Estimate."""
        if ".." in text and "[" not in text:
            return Estimate(np.nan, *map(float, text.split("..")))
        value = self.value(text)
        return value if isinstance(value, Estimate) else Estimate(value, value, value)

    def value(self, text):
        """Estimate or number of "WORD COLUMN, ...[POINTS]", a number, a multiple or a ratio of means."""
        text = replaced(text, {f"${place}": f"{place}{MEASURES[self.measure]}" for place in ("head", "mid")})
        if " / " in text:
            above, below = map(self.estimate, text.split(" / "))
            return above.mean / below.mean
        if multiple := re.fullmatch(r"([\d.]+) (.+)", text):
            return float(multiple[1]) * self.estimate(multiple[2]).mean
        if quantity := re.fullmatch(r"(?:(\w+) )?(.+)\[(.*)\]", text):
            return WORDS[quantity[1] or "mean"](self, *quantity[2].split(", "), quantity[3])
        return float(text)

    def places(self, points):
        """Runs at a point, or at all points of a range, beside the value of the last axis: [(value, Runs)]."""
        found = [("", self.runs)]
        for axis, word in zip(self.picture.get("axes", ()), points.split()):
            found = [place for _, runs in found for place in along(runs, axis, word)]
        return found

    def values(self, column, points):
        """Values of a column by rising seed: at a point, or their rise or ratio between two."""
        for sign, operation in {" -> ": lambda start, end: end - start, " over ": np.divide}.items():
            if sign in points:
                return operation(*(self.values(column, point) for point in points.split(sign)))
        ((_, runs),) = self.places(points)
        for sign, operation in {"/": np.divide, "-": np.subtract}.items():
            if sign in column:
                return operation(*map(runs.values, column.split(sign)))
        return runs.values(column)

    def means(self, *columns_points):
        """Places of the points, and there the largest of the columns' means."""
        *columns, points = columns_points
        places, runs = zip(*self.places(points))
        return places, np.array([max(at.estimate(column).mean for column in columns) for at in runs])


def along(runs, axis, word):
    """Runs at a value of an axis, or at all values of a..b: [(value, Runs)]."""
    if axis == "series":
        return [(word, clearance_series(runs, label)) for label in CLEARANCES if label.startswith(word)]
    if ".." not in word:
        return [(word, runs.at(**{axis: float(word)}))]
    first, last = (float(end or default) for end, default in zip(word.split(".."), ("-inf", "inf")))
    return [(float(value), runs.at(**{axis: value})) for value in np.unique(runs[axis]) if first <= value <= last]


def others(conditions):
    """Sweeps of other pictures that conditions are about."""
    return [sweep_of(other[1]) for line in conditions if (other := re.match(r"(\w+): ", line))]


def repeated(lines):
    """Lines, each for all values of its loops "for $x in a b"."""
    for line in lines:
        loops = [[(name, value) for value in values.split()] for name, values in re.findall(LOOP, line)]
        yield from (replaced(re.sub(LOOP, "", line), dict(values)) for values in product(*loops))


def replaced(text, values):
    """A text with the values in the place of their names."""
    for name, value in values.items():
        text = text.replace(name, value)
    return text


def shown(value, form):
    """A quantity as text."""
    if not form or not isinstance(value, Estimate):
        return format(value, form)
    mean, low, high = (format(end, form.removesuffix("[]")) for end in vars(value).values())
    return f"{mean} [{low}, {high}]" if form.endswith("[]") else mean


# The words of claims.toml, which explains them: functions of Figures, columns and points ------------------------------


def mean(f, column, points):
    return estimate(f.values(column, points))


def clear(f, column, points):
    pairs = zip(*map(f.places, points.split(" -> ")))
    return sum(estimate(end.values(column) - start.values(column)).low > 0.0 for (_, start), (_, end) in pairs)


def best(f, *where):
    places, means = f.means(*where)
    return places[means.argmin()]


def from_best(f, column, points):
    start, end = points.split(" -> ")
    return mean(f, column, f"{start.replace('..', str(best(f, column, start)))} -> {end}")


def valley(f, column, points):
    (first, _), *_, (last, _) = f.places(points)
    return min(from_best(f, column, f"{points} -> {points.replace('..', str(end))}").low for end in (first, last))


def below_from(f, column, limit, points):
    places, means = f.means(column, points)
    return next((place for i, place in enumerate(places) if (means[i:] < float(limit)).all()), places[-1])


def crossing(f, first, second, points):
    (places, a), (_, b) = f.means(first, points), f.means(second, points)
    gap = a - b
    for i in np.flatnonzero((gap[:-1] > 0.0) & (gap[1:] <= 0.0)):
        return places[i] + (places[i + 1] - places[i]) * gap[i] / (gap[i] - gap[i + 1])
    return np.nan


def rivets(f, place, _=""):
    return sum(name.startswith(f"{place}_damage_") for name in f.runs.columns)


def damaged(f, place, other, point):
    pairs = (f"{place}_damage_{k}-{other}_damage_{k}" for k in range(1, rivets(f, place) + 1))
    return sum(mean(f, pair, point).low > 0.0 for pair in pairs)


def share(f, place, other, point):
    """A rivet's strength at both places is log-normal: the odds that the first breaks before the second."""
    decades = np.array(
        [f.values(f"{place}_damage_{k}-{other}_damage_{k}", point) for k in range(1, rivets(f, place) + 1)]
    )
    return estimate(norm.cdf(decades / (np.sqrt(2.0) * SCATTER)).mean(axis=0))


def ratios(f, first, second, points):
    return np.divide(*(f.means(column, points)[1] for column in (first, second)))


FUNCTIONS = (mean, clear, best, from_best, valley, below_from, crossing, rivets, damaged, share)
WORDS = {word.__name__: word for word in FUNCTIONS} | {
    "tenfold": lambda f, *where: Estimate(*(10.0**end for end in vars(mean(f, *where)).values())),
    "median": lambda f, *where: np.median(f.values(*where)),
    "highest": lambda f, column, points: max(runs[column].max() for _, runs in f.places(points)),
    "largest": lambda f, *where: f.means(*where)[1].max(),
    "least": lambda f, *where: f.means(*where)[1].min(),
    "spread": lambda f, *where: np.ptp(f.means(*where)[1]),
    "over_least": lambda f, *where: f.means(*where)[1][0] / f.means(*where)[1].min(),
    "highest_ratio": lambda f, *where: ratios(f, *where).max(),
    "lowest_ratio": lambda f, *where: ratios(f, *where).min(),
}
