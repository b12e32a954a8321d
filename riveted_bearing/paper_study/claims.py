"""The paper's claims against the runs of the study: the evaluation of data/claims.toml, which explains itself."""

import re
import tomllib
from dataclasses import dataclass
from importlib.resources import files
from itertools import product

import numpy as np

from .study import CLEARANCES, GRIPS, Estimate, Runs, clearance_series, estimate, grip

PICTURES = tomllib.loads((files("riveted_bearing") / "data" / "claims.toml").read_text(encoding="utf-8"))
LABELS = PICTURES.pop("labels")
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
    """A sentence of the paper: its place, the sentence, figures of the runs, which conditions they meet, the reason."""

    where: str
    said: str
    found: str
    holds: tuple
    why: str

    @property
    def verdict(self):
        """reproduced, partly or not: all, some or none of the conditions are met."""
        return "reproduced" if all(self.holds) else "partly" if any(self.holds) else "**not**"


def all_claims(data):
    """Claims for which there are runs, in the order of the paper, by the picture (of study.PICTURES, or "cost")."""
    sweeps = {name: picture.get("sweep", name) for name, picture in PICTURES.items()}
    return {
        name: Figures(data, data[sweep], PICTURES[name]).claims() for name, sweep in sweeps.items() if sweep in data
    }


@dataclass(frozen=True)
class Figures:
    """Figures of the runs of one picture, a table of claims.toml; data: Runs of all sweeps by name."""

    data: dict
    runs: Runs
    picture: dict

    def claims(self):
        """The picture's Claims."""
        return [self.claim(*title.split(": ", 1), **table) for title, table in self.picture.items() if ": " in title]

    def claim(self, where, said, holds, why, here="", lines=(), last=None, also=None):
        """The Claim of its table."""
        if last and all(map(self.met, repeated([last["if"]]))):
            lines = [*lines, last["line"]]
        here += "".join(f"\n    - {line}" for line in repeated(lines))
        why += "".join(text for sweep, text in (also or {}).items() if sweep in self.data)
        return Claim(where, said, self.filled(here), tuple(map(self.met, repeated(holds))), self.filled(why))

    def filled(self, text):
        """A text with figures for its quantities; a format after a colon is for the mean, "[]" adds the interval."""
        texts = {name: value for name, value in self.picture.items() if name.startswith("$")}
        return re.sub(
            r"{([^{}:]+):?([^{}]*)}", lambda match: shown(self.value(match[1]), match[2]), replaced(text, texts)
        )

    def met(self, condition):
        """Whether "QUANTITY PREDICATE QUANTITY" holds, or all of several joined by "and"."""
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
        """Estimate, number or text of "WORD COLUMN, ...[POINTS]", a number, a label, a multiple or a ratio of means."""
        if " / " in text:
            above, below = map(self.estimate, text.split(" / "))
            return above.mean / below.mean
        if multiple := re.fullmatch(r"([\d.]+) (.+)", text):
            return float(multiple[1]) * self.estimate(multiple[2]).mean
        if quantity := re.fullmatch(r"(?:(\w+) )?(.+)\[(.*)\]", text):
            return WORDS[quantity[1] or "mean"](self, *quantity[2].split(", "), quantity[3])
        return LABELS.get(text) or float(text)

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
        return [(word, runs.at(**{axis: word if axis == "scene" else float(word)}))]
    first, last = (float(end or default) for end, default in zip(word.split(".."), ("-inf", "inf")))
    return [(float(value), runs.at(**{axis: value})) for value in np.unique(runs[axis]) if first <= value <= last]


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


def valleys(f, *columns_points):
    *columns, points = columns_points
    return ", ".join(LABELS[column] for column in columns if valley(f, column, points) > 0.0) or "none"


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


def grips(f, column, preload):
    runs = {name: grip(f.data["grip"], name).at(preload=float(preload)) for name in GRIPS}
    return "; ".join(f"{name}: {np.median(at[column]):.1f}" for name, at in runs.items())


FUNCTIONS = (mean, clear, best, from_best, valley, valleys, below_from, crossing, rivets, damaged, grips)
WORDS = {word.__name__: word for word in FUNCTIONS} | {
    "tenfold": lambda f, *where: Estimate(*(10.0**end for end in vars(mean(f, *where)).values())),
    "median": lambda f, *where: np.median(f.values(*where)),
    "highest": lambda f, column, points: max(runs[column].max() for _, runs in f.places(points)),
    "largest": lambda f, *where: f.means(*where)[1].max(),
    "least": lambda f, *where: f.means(*where)[1].min(),
    "spread": lambda f, *where: np.ptp(f.means(*where)[1]),
    "over_least": lambda f, *where: f.means(*where)[1][0] / f.means(*where)[1].min(),
    "percent_over_least": lambda f, *where: 100.0 * (WORDS["over_least"](f, *where) - 1.0),
}
