"""Dates and times of day in tables, as loggers write them, read as seconds since the first row.

    2024-05-01T12:00:00.25+02:00, 2024/05/01 12:00, 20240501T120000Z      ISO 8601 and its relatives
    01.05.2024 12:00:00,25     5/1/2024 12:00:00 PM     1 May 2024        days and months in either order
    12:00:00.25    100:15:00    00:01.5                                   time of day, time since the start, minutes

A time of day begins again at midnight.  Where days and months are told by nothing else, their order is the one by which the
record takes a fifth of the time at most.
"""

import re
from datetime import date

import numpy as np

from .errors import UserError

MONTHS = ("jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec")
DAY = 86400.0
CLEARER = 5.0  # how many times longer the other order of days and months has to be
STAMP = re.compile(
    r"(?:(?P<y>\d{4})(?P<s1>[-/.]?)(?P<m>\d{2}|(?<=[-/.])\d)(?P=s1)(?P<d>\d{1,2})"
    r"|(?P<a>\d{1,2})(?P<s2>[-/.])(?P<b>\d{1,2})(?P=s2)(?P<year>\d{4}|\d{2})"
    r"|(?P<day>\d{1,2})[-. ]+(?P<month>[A-Za-z]{3})[a-z]*[-. ,]+(?P<of>\d{4}|\d{2}))?"
    r"(?P<between>[T ,;_]*)"
    r"(?:(?P<h>\d{1,6}):(?P<min>\d{2})(?::(?P<sec>\d{2}))?(?P<f>[.,]\d+)?\s*(?:(?P<half>[AaPp])\.?[Mm]\.?)?"
    r"|(?P<plain>\d{4}(?:\d{2})?)(?P<f2>[.,]\d+)?)?"
    r"\s*(?P<zone>Z|UTC|GMT|[+-]\d{2}(?::?\d{2})?)?"
)


def is_stamp(text):
    """Whether an entry is a date or a time of day, and no number."""
    return bool(re.search(r"\d[-/:]\d|\d[T ]\d|\d\.\d+\.\d|[A-Za-z]{3}", text)) and parse(text.strip()) is not None


def parse(text):
    """((days by both orders of day and month) or None for no date, seconds of the day); None if it is no stamp."""
    match = STAMP.fullmatch(text)
    if match is None:
        return None
    try:
        days = days_of(match)
    except ValueError:
        return None
    plain, fraction = match["plain"] or "", (match["f"] or match["f2"] or "0").replace(",", ".")
    texts = (plain[:2], plain[2:4], plain[4:]) if plain else (match["h"], match["min"], match["sec"])
    if days is None and not match["h"]:
        return None
    hours, minutes, seconds = (float(one or 0.0) for one in texts)
    if match["f"] and not match["sec"]:  # minutes and seconds
        hours, minutes, seconds = 0.0, hours, minutes
    if match["half"]:
        hours = hours % 12.0 + (12.0 if match["half"] in "Pp" else 0.0)
    if seconds > 60.0 or (minutes >= 60.0 and not match["f"]) or (days and (hours > 24.0 or minutes >= 60.0)):
        return None
    fraction = float(fraction)
    return days, 3600.0 * hours + 60.0 * minutes + seconds + fraction - zone_of(match["zone"])


def days_of(match):
    """Days by both orders of day and month; one is nan where only the other is a date."""
    if match["y"]:
        return (date(*(int(match[name]) for name in ("y", "m", "d"))).toordinal(),) * 2
    if match["day"]:
        month = MONTHS.index(match["month"].lower()) + 1
        return (date(whole_year(match["of"]), month, int(match["day"])).toordinal(),) * 2
    if not match["a"]:
        return None
    year, a, b = whole_year(match["year"]), int(match["a"]), int(match["b"])
    orders = ((b, a),) if match["s2"] == "." else ((b, a), (a, b))
    found = [ordinal(year, month, day) for month, day in orders]
    if all(np.isnan(found)):
        raise ValueError
    return found[0], found[-1]


def ordinal(year, month, day):
    """Number of a day, nan if there is no such day."""
    try:
        return float(date(year, month, day).toordinal())
    except ValueError:
        return np.nan


def whole_year(text):
    """A year of two or four digits."""
    return int(text) if len(text) == 4 else 2000 + int(text)


def zone_of(text):
    """Seconds by which a time zone is ahead of UTC."""
    if not text or text[0] not in "+-":
        return 0.0
    hours, minutes = int(text[1:3]), int(text[3:].lstrip(":") or 0)
    return (1 if text[0] == "+" else -1) * (3600.0 * hours + 60.0 * minutes)


class Stamps:
    """Seconds since the first stamp of a column that comes in pieces; month_first: which order of day and month holds."""

    def __init__(self, month_first=False):
        self.month_first, self.first, self.last, self.midnights = month_first, None, None, 0

    def seconds(self, parts):
        """Seconds of the next piece, of parts as of parse()."""
        days = np.array([0.0 if own is None else own[self.month_first] for own, _ in parts])
        clock = np.array([seconds for _, seconds in parts])
        if all(own is None for own, _ in parts):  # a time of day goes back at midnight, by nearly a day
            before = np.concatenate([clock[:1] if self.last is None else [self.last], clock])
            days = self.midnights + np.cumsum(np.diff(before) < -0.5 * DAY)
            self.midnights, self.last = days[-1], clock[-1]
        self.first = self.first or (days[0], clock[0])
        return DAY * (days - self.first[0]) + (clock - self.first[1])


def stamps_of(texts, where):
    """The Stamps of a column of texts; UserError if its days and months may be exchanged."""
    texts = iter(texts)
    match = STAMP.fullmatch((first := next(texts, "")).strip())
    if not (match and match["a"] and match["s2"] != "."):  # day and month in one order only
        return Stamps()
    parts = [own for text in (first, *texts) if (own := parse((text or "").strip())) is not None]
    return Stamps(month_is_first(parts, where))


def month_is_first(parts, where):
    """Which order of day and month holds in the dates of a whole column; UserError if nothing tells."""
    pairs = [own for own, _ in parts if own is not None and own[0] != own[1]]
    if not pairs:
        return False
    both = np.array(pairs, float)
    if np.isnan(both).any():
        holds = ~np.isnan(both).any(axis=0)
        if not holds.any():
            raise UserError(f"{where}: days and months change their order")
        return bool(holds[1] and not holds[0])
    both = [Stamps(order).seconds(parts) for order in (False, True)]
    day, month = (t[-1] if np.all(np.diff(t) > 0.0) else np.inf for t in both)
    if np.array_equal(*both) or not np.isfinite(min(day, month)) or CLEARER * day <= month:
        return False
    if CLEARER * month <= day:
        return True
    raise UserError(f"{where}: days and months may stand in either order: write dates as 2024-05-31")
