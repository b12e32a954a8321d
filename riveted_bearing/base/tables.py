"""Tables of numbers that users bring, CSV, Parquet or Excel: one reader and one convention of units for all of them.

    time [ms];radial [kN];speed (rpm)     # a line of names; a name without a unit is SI
    0,00;2,99;3000

Separator (comma, semicolon, tab, bar, spaces), decimal sign, thousands, encoding, a line of units below the names and
lines with # in front are recognised.  Numbers come out in SI, dates and times of day (stamps.py) as seconds since the first
row.  A fault is named with its file, row and column; rows count
as in an editor, those of a Parquet file from 1.
"""

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from .errors import UserError, is_file, naming, unknown
from .heads import UNSURE, same, split_head, unit_of
from .table_rows import KINDS, TextRows
from .units import SECONDS, scale

OTHERS = {
    b"\xd0\xcf\x11\xe0": "an old Excel workbook: save it as .xlsx or CSV",
    b"\x1f\x8b": "compressed: unpack it first",
}
GAP = 10.0  # usual intervals: a longer one is a gap
YEAR = 365.25 * 86400.0
LATEST = 1000.0 * YEAR  # s: beyond it a time is no time since 1970 in s
FEWEST = 5  # intervals that show what is usual
USUAL = 0.75  # share of the intervals that lie within a factor of 2 of the median in a record of a fixed rate


@dataclass(frozen=True)
class Wanted:
    """A column that is read: as the user names it, the Scales of its quantity, and the unit that the user wrote."""

    name: str
    scales: dict = field(repr=False)
    unit: str = ""


def read(path: Path, *wanted: Any) -> Any:
    """SI arrays of the Wanted columns of a file; UserError for the first fault."""
    return Table(path).columns(*wanted)


class Table:
    """The names of a file's columns, and its numbers read in pieces, as often as they are needed."""

    def __init__(self, path):
        self.path = Path(path)
        if not is_file(path):
            raise UserError(f"{path}: no such file")
        try:
            with self.path.open("rb") as file:
                start = file.read(4096)
            if other := next((what for magic, what in OTHERS.items() if start.startswith(magic)), None):
                raise UserError(f"{path}: not a CSV, Parquet or Excel table but {other}")
            kind = next((kind for magic, kind in KINDS.items() if start.startswith(magic)), TextRows)
            self.source = kind(self.path, start)
        except OSError as problem:
            raise UserError(f"{path}: {problem.strerror}") from None
        self.heads = self.source.heads

    def place(self, name):
        """Number of the column of a name, with or without its unit."""
        asked = split_head(name)[0]
        for fits in (
            lambda head: head == name.strip(),
            lambda head: split_head(head)[0] == name.strip(),
            lambda head: split_head(head)[0] == asked,
        ):
            found = [i for i, head in enumerate(self.heads) if fits(head)]
            if len(found) > 1:
                raise UserError(f"{self.path}: {name}: two columns have this name: {', '.join(self.heads)}")
            if found:
                return found[0]
        raise unknown(self.path, "column", name, [head for head in self.heads if head])

    def unit(self, wanted):
        """The unit in which a Wanted column is read, "" for SI and for dates."""
        place = self.place(wanted.name)
        if wanted.scales is SECONDS and self.source.is_stamped(place):
            return ""
        head = self.heads[place]
        own, certain = unit_of(head, wanted.scales)
        asked = wanted.unit or split_head(wanted.name)[1]
        where = f'{self.path}: column "{head}"'
        if own and certain and asked not in ("", own) and not same(own, asked, wanted.scales):
            raise UserError(f"{where}: its unit is {own}, but {asked} was asked for")
        unit = asked or own
        if not asked and not certain and unit and (len(unit) < 2 or unit in UNSURE or unit[0] == "?"):
            unit = unit.lstrip("?")
            raise UserError(f'{where}: is "{unit}" its unit? Write "[{unit}]" into its name, or the unit beside it')
        if unit:
            with naming(where, (UserError,)):
                scale(unit, wanted.scales)
        return unit

    def blocks(self, *wanted):
        """Pieces of the Wanted columns: row numbers, and numbers in SI [n, columns]."""
        places = [self.place(one.name) for one in wanted]
        timed = {place for place, one in zip(places, wanted, strict=True) if one.scales is SECONDS}  # may hold dates
        units = [self.unit(one) for one in wanted]
        scales = [scale(u, one.scales) if u else (1.0, 0.0) for u, one in zip(units, wanted, strict=True)]
        try:
            for rows, columns in self.source.blocks(places, timed):
                si = [(values - offset) / factor for values, (factor, offset) in zip(columns, scales, strict=True)]
                yield rows, np.column_stack(si)
        except OSError as problem:
            raise UserError(f"{self.path}: {problem.strerror}") from None

    def columns(self, *wanted):
        """SI arrays of the Wanted columns."""
        return self.rows_and_columns(*wanted)[1:]

    def rows_and_columns(self, *wanted):
        """The numbers of the rows, and SI arrays of the Wanted columns."""
        pieces = list(self.blocks(*wanted))
        if not pieces:
            raise UserError(f"{self.path}: a line of names but no row of numbers")
        return (np.concatenate([rows for rows, _ in pieces]), *np.concatenate([block for _, block in pieces]).T)

    def series(self, time, *wanted, gap=None):
        """SI arrays of the times and the Wanted columns; UserError for times that go back or leave a gap."""
        rows, t, *columns = self.rows_and_columns(time, *wanted)
        self.clock(time, gap).add(rows, t)
        return (t, *columns)

    def clock(self, time, gap=None, strict=True):
        """The Clock of a Wanted column of times."""
        return Clock(self.path, self.heads[self.place(time.name)], gap, strict)


class Clock:
    """Times of a record in pieces: they increase and, at a fixed rate, leave no gap [s], None: GAP usual intervals; else a
    UserError if strict, or the note.
    """

    def __init__(self, path, head, gap=None, strict=True):
        self.where, self.gap, self.strict = f'{path}: column "{head}"', gap, strict
        self.last, self.usual, self.note = None, None, ""

    def add(self, rows, t):
        """The next piece; UserError naming the row of the first fault."""
        if self.last is not None:
            rows, t = np.concatenate([self.last[0], rows]), np.concatenate([self.last[1], t])
        if np.any(np.abs(t) > LATEST):
            k = int(np.argmax(np.abs(t) > LATEST))
            raise UserError(
                f"{self.where}, row {rows[k]}: {t[k]:.4g} s are {t[k] / YEAR:,.0f} years: if they are ms, us or ns since "
                "1970, write [ms], [us] or [ns] behind the name"
            )
        step = np.diff(t)
        self.last = rows[-1:], t[-1:]
        if np.any(step <= 0.0):
            k = int(np.argmax(step <= 0.0))
            raise UserError(
                f"{self.where}, row {rows[k + 1]}: {t[k + 1]:.10g} s after {t[k]:.10g} s: times must increase"
            )
        if self.usual is None and len(step):
            self.usual = usual_interval(step)
        longest = GAP * self.usual if self.gap is None and self.usual else self.gap or np.inf
        if np.any(step > longest * (1.0 + 1e-9)):
            k = int(np.argmax(step > longest * (1.0 + 1e-9)))
            usual = f", usual is {self.usual:.4g} s" if self.usual else ""
            self.note = f"row {rows[k + 1]}: a gap of {step[k]:.6g} s{usual}"
            if self.strict:
                raise UserError(
                    f'{self.where}, {self.note}: cut the record there, or allow it with longest_gap = "{step[k]:.6g} s"'
                )


def usual_interval(step):
    """The median of intervals if they are those of a fixed rate, 0 otherwise."""
    if len(step) < FEWEST:
        return 0.0
    middle = float(np.median(step))
    return middle if np.mean((step > 0.5 * middle) & (step < 2.0 * middle)) >= USUAL else 0.0
