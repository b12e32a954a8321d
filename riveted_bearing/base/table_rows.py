"""Rows of a table as its file has them: text, Parquet, Excel sheets."""

import csv
import re
from datetime import date, datetime, time, timedelta
from functools import partial
from itertools import islice, pairwise

import numpy as np

from .encodings import encoding_of
from .errors import UserError, extra
from .files import one_line
from .heads import split_head
from .stamps import Stamps, is_stamp, parse, stamps_of
from .units import is_unit

BLOCK = 65536  # rows that are read together
SAMPLE = 60  # rows that decide on the separator
SEPARATORS = ("\t", ";", "|", ",", None)  # None: spaces
MISSING = ("", "-", "--", "nan", "na", "n/a", "null", "none", "#n/a", "#nv", "#div/0!", "#value!", "#wert!", "?", "nat")
GROUPS = re.compile(r"[ '’\u00a0\u202f](?=\d{3}(?!\d))")  # thousands
PLAIN = r"[+-]?[1-9]\d{0,2}"
DIGITS = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")
DOUBTFUL = {",": re.compile(PLAIN + r",\d{3}"), ".": re.compile(PLAIN + r"\.\d{3}")}  # a decimal sign or thousands
GROUPED = {",": re.compile(PLAIN + r"(,\d{3})+(\.\d*)?"), ".": re.compile(PLAIN + r"(\.\d{3})+(,\d*)?")}


class TextRows:
    """The rows of a CSV file."""

    def __init__(self, path, start):
        self.path = path
        self.encoding = encoding_of(path, start)
        self.separator, self.first, self.heads = self.head()
        self.decimal = self.decimal_sign()

    def lines(self):
        """Numbers and texts of the lines that are neither empty nor a remark."""
        with self.path.open(encoding=self.encoding, errors="strict") as file:
            for number, line in enumerate(file, 1):
                if line.strip() and not line.startswith("#"):
                    yield number, line

    def rows(self, separator, first=1):
        """Row numbers and entries from the line `first` on."""
        if separator is None:
            yield from ((n, re.split(r"\s+(?![\[(])", line.strip())) for n, line in self.lines() if n >= first)
            return
        at = [0]

        def texts():
            for at[0], line in self.lines():
                if at[0] >= first:
                    yield line

        try:
            yield from ((at[0], row) for row in csv.reader(texts(), delimiter=separator) if any(map(str.strip, row)))
        except csv.Error as problem:
            raise UserError(f"{self.path}: row {at[0]}: not a row of a CSV table: {problem}") from None

    def head(self):
        """Separator, first row of numbers and names: by the first separator by which most rows are as long as the names."""
        declared = next((re.fullmatch(r'"?sep=(.)"?\s*', line, re.IGNORECASE) for _, line in self.lines()), None)
        best = 2.0, None, 0, []
        for separator in (declared[1],) if declared else SEPARATORS:
            sample = list(islice(self.rows(separator, 2 if declared else 1), SAMPLE))
            faults, first, names = head_of(sample)
            if faults < best[0]:
                best = faults, separator, first, names
            if faults < 0.5:
                break
        faults, separator, first, names = best
        if faults > 1.0:
            raise UserError(
                f"{self.path}: not a CSV table: a line of names and rows of numbers with commas, semicolons or tabs between are needed"
            )
        if all(map(is_number, filter(None, names))):
            raise UserError(f"{self.path}: row {first - 1}: numbers where the names of the columns are needed")
        return separator, first, names

    def decimal_sign(self):
        """The decimal sign by all entries; UserError if the file has both, or one that may part thousands."""
        seen, plain = {}, False
        for row, entries in self.rows(self.separator, self.first):
            for entry in entries:
                if ("." in entry and "." not in seen) or ("," in entry and "," not in seen):
                    seen.setdefault(sign_of(GROUPS.sub("", entry.strip())), (row, entry.strip()))
                elif len(entry) > 3 and not plain:
                    plain = re.fullmatch(r"[+-]?\d{4,}", entry.strip()) is not None
            if "." in seen and self.separator == "," and "," not in seen:
                break  # a comma inside quotes would be a fault of its own row
        if "," in seen and "." in seen:
            rows = " and ".join(f'row {row} has "{text}"' for row, text in sorted((seen[","], seen["."])))
            raise UserError(f"{self.path}: two decimal signs: {rows}")
        for sign in (",", "."):
            if sign in seen:
                return sign
        for sign, doubt in ((",", "?,"), (".", "?.")):
            if doubt in seen and (plain or (sign == "." and self.separator in (",", None))):
                return sign
            if doubt in seen:
                row, text = seen[doubt]
                raise UserError(
                    f'{self.path}: row {row}: "{text}" may be a thousand or have decimals: write the numbers without a sign for thousands'
                )
        return "."

    def is_stamped(self, place):
        """Whether a column begins with a date or a time of day."""
        _, row = next(self.rows(self.separator, self.first), (0, []))
        return place < len(row) and is_stamp(row[place])

    def stamps(self, place):
        """The Stamps of a column; UserError if its days and months may be exchanged."""
        column = (row[place] for _, row in self.rows(self.separator, self.first) if place < len(row))
        return stamps_of(column, f'{self.path}: column "{self.heads[place]}"')

    def blocks(self, places, timed=()):
        """Row numbers and the numbers of some columns, in pieces; timed: places of those that may hold dates."""
        rows, count = self.rows(self.separator, self.first), len(self.heads)
        stamps = {place: self.stamps(place) for place in timed if self.is_stamped(place)}
        while piece := list(islice(rows, BLOCK)):
            for number, row in piece:
                if not fits(self.heads, row):
                    raise UserError(
                        f"{self.path}: row {number} has {len(row)} entries, the line of names has {count}{self.hint(row)}"
                    )
            columns = [self.numbers(place, piece, stamps.get(place)) for place in places]
            yield np.array([number for number, _ in piece]), columns

    def hint(self, row):
        """Why a row may have more entries than there are names."""
        doubled = self.separator == "," and len(row) > len(self.heads)
        return ": a comma as decimal sign needs semicolons between the entries" if doubled else ""

    def numbers(self, place, piece, stamps=None):
        """One column of a piece as floats; stamps: of one of dates, as seconds."""
        if stamps is not None:
            entries = [(number, row[place].strip()) for number, row in piece]
            return seconds_of(stamps, entries, self.path, self.heads[place])
        texts = [row[place] for _, row in piece]
        odd = "_." if self.decimal == "," else "_"
        try:
            values = np.array(
                [float(text.replace(",", ".")) for text in texts] if odd != "_" else list(map(float, texts))
            )
            if np.all(np.isfinite(values)) and not any(sign in text for text in texts for sign in odd):
                return values
        except ValueError:
            pass
        return np.array([self.number(place, number, row[place].strip()) for number, row in piece])

    def number(self, place, row, text):
        """One entry as float; UserError naming its row."""
        plain = GROUPS.sub("", text).replace("−", "-")
        other = "." if self.decimal == "," else ","
        if other in plain and GROUPED[other].fullmatch(plain):
            plain = plain.replace(other, "")
        plain = plain.replace(",", ".") if self.decimal == "," else plain
        if DIGITS.fullmatch(plain) and np.isfinite(float(plain)):
            return float(plain)
        raise entry_fault(self.path, row, self.heads[place], text)


def seconds_of(stamps, entries, path, head):
    """Seconds by Stamps of (row, text); UserError naming the first that is none like the ones before."""
    parts = [parse(text) for _, text in entries]
    for (row, text), part in zip(entries, parts, strict=True):
        if part is None or (part[0] is None) != (parts[0][0] is None):
            raise entry_fault(path, row, head, text, "not a date or time of day like those above")
    return stamps.seconds(parts)


def head_of(sample):
    """Share of rows of another length, first row of numbers, names with units: the last row without numbers that is as long."""
    for k, ((_, names), (row, entries)) in enumerate(pairwise(sample)):
        names = [" ".join(name.split()) for name in named(names)]
        if len(names) < 2 or any(map(is_number, names)) or not fits(names, entries):
            continue
        below = sample[k + 1 :]
        if any(map(is_number, entries)):
            return sum(not fits(names, cells) for _, cells in below) / len(below), row, names
        if len(below) > 1 and any(map(is_number, below[1][1])) and is_line_of_units(entries):
            units = [entry.strip().strip("[]()") for entry in entries]
            return 0.0, row + 1, [f"{n} [{u}]" if u else n for n, u in zip(names, units, strict=False)]
    if sample and len(sample[0][1]) > 1:
        return 1.0, sample[0][0] + 1, [" ".join(name.split()) for name in named(sample[0][1])]
    return 2.0, 0, []


def is_line_of_units(entries):
    """Whether all entries of a row that are not empty are units, or stand in brackets."""
    texts = [entry.strip() for entry in entries if entry.strip()]
    return all(re.fullmatch(r"\[.*\]|\(.*\)", text) or is_unit(text) for text in texts)


def named(names):
    """The names up to the last one that is not empty."""
    return names[: max((k for k, name in enumerate(names, 1) if name.strip()), default=0)]


def entry_fault(path, row, head, text, other="not a number"):
    """The error for an entry that is no finite number."""
    text = " ".join(text.split())
    text = text if len(text) < 40 else f"{text[:37]}..."
    what = "no value" if text.lower() in MISSING else other
    if other == "not a number" and re.fullmatch(r"\d{1,4}[-./]\d{1,2}[-./]\d{1,4}.*|\d{1,2}:\d\d.*", text):
        what = "a date or time of day: numbers are needed, such as the seconds since the start"
    if re.fullmatch(r"[+-]?(inf(inity)?|\d[\d.,]*e\+?\d+)", text.lower()):
        what = "not a finite number"
    return UserError(f'{path}: row {row}, column "{head}": "{text}": {what}')


def fits(names, entries):
    """Whether a row has an entry for each name, and only empty ones beyond."""
    return len(entries) == len(names) or (len(entries) > len(names) and not any(map(str.strip, entries[len(names) :])))


def is_number(text):
    """Whether an entry is a number by any decimal sign, or stands for a missing one."""
    text = GROUPS.sub("", text.strip())
    return bool(re.fullmatch(r"[-+−]?[\d.,]*\d[\d.,]*([eE][+-]?\d+)?", text)) or text.lower() == "nan"


def sign_of(text):
    """Decimal sign that an entry shows: "," or ".", "?," or "?." where the sign may part thousands, "" for none."""
    number = re.fullmatch(r"([+-]?[\d.,]+)(?:[eE][+-]?\d+)?", text)
    if not number:
        return ""
    signs = re.sub(r"[^.,]", "", number[1])
    if len(set(signs)) == 2:
        return signs[-1] if signs.count(signs[-1]) == 1 else ""
    if len(signs) > 1:
        return {",": ".", ".": ","}[signs[0]] if GROUPED[signs[0]].fullmatch(number[1]) else ""
    return f"?{signs}" if DOUBTFUL[signs].fullmatch(text) else signs


def has_commas(texts):
    """Whether the numbers among texts have decimal commas."""
    return any("," in text and sign_of(GROUPS.sub("", text)) == "," for text in texts)


def with_point(text):
    """A number with a decimal comma as one with a point; other texts as they are."""
    plain = GROUPS.sub("", text)
    if not is_number(plain) or not sign_of(plain):
        return text
    return (plain.replace(".", "") if GROUPED["."].fullmatch(plain) else plain).replace(",", ".")


class ParquetRows:
    """The rows of a Parquet file; the unit of a column may stand in its field's metadata."""

    def __init__(self, path, _start):
        try:
            from pyarrow import parquet
        except ImportError:
            raise UserError(f"{path}: pyarrow is not installed: {extra('full')}; a CSV table needs nothing") from None
        self.path = path
        try:
            self.file = parquet.ParquetFile(path, page_checksum_verification=True)
        except Exception as problem:  # pyarrow has many
            raise UserError(f"{path}: not a Parquet table: {one_line(problem)}") from None
        self.heads = []
        for one in self.file.schema_arrow:
            unit = (one.metadata or {}).get(b"unit", b"").decode(errors="replace")
            self.heads.append(f"{one.name} [{unit}]" if unit and not split_head(one.name)[1] else one.name)

    def is_stamped(self, place):
        """Whether a column holds dates or times of day, or begins with one as text."""
        from pyarrow import types

        if types.is_temporal(kind := self.file.schema_arrow.types[place]):
            return True
        texts = types.is_string(kind) or types.is_large_string(kind)
        return texts and bool(column := self.texts(place)) and is_stamp(column[0] or "")

    def texts(self, place):
        """A column of texts."""
        return self.file.read([self.file.schema_arrow.names[place]]).column(0).to_pylist()

    def stamps(self, place):
        """The Stamps of a column of texts; of dates the first one, once it is read."""
        from pyarrow import types

        if types.is_temporal(self.file.schema_arrow.types[place]):
            return []
        return stamps_of(self.texts(place), f'{self.path}: column "{self.heads[place]}"')

    def blocks(self, places, timed=()):
        """Row numbers and the numbers of some columns, in pieces; timed: places of those that may hold dates."""
        first, names = 1, [self.file.schema_arrow.names[place] for place in places]
        stamps = {place: self.stamps(place) for place in timed if self.is_stamped(place)}
        try:
            for batch in self.file.iter_batches(BLOCK, columns=names):
                rows = np.arange(first, first + len(batch))
                first += len(batch)
                columns = []
                for name, i in zip(names, places, strict=True):
                    column, read = batch.column(batch.schema.get_field_index(name)), self.numbers
                    if i in stamps:
                        read = partial(self.seconds, stamps[i])
                    columns.append(read(column, rows, self.heads[i]))
                yield rows, columns
        except UserError:
            raise
        except Exception as problem:
            raise UserError(f"{self.path}: not a Parquet table: {one_line(problem)}") from None

    def seconds(self, stamps, column, rows, head):
        """One column of dates as seconds since the first one: Stamps of texts, else the list of the first date."""
        from pyarrow import compute, int32, int64, types

        if isinstance(stamps, Stamps):
            entries = [(row, (text or "").strip()) for row, text in zip(rows, column.to_pylist(), strict=True)]
            return seconds_of(stamps, entries, self.path, head)
        if column.null_count:
            raise entry_fault(self.path, rows[column.is_null().index(True).as_py()], head, "")
        kind = column.type
        whole = compute.cast(compute.cast(column, int32()) if kind.bit_width == 32 else column, int64()).to_numpy()
        stamps[:] = stamps or [whole[0]]
        tick = {"s": 1.0, "ms": 1e3, "us": 1e6, "ns": 1e9}[kind.unit] if not types.is_date(kind) else None
        ticks = tick or (1.0 / 86400.0 if types.is_date32(kind) else 1e3)
        return (whole - stamps[0]) / ticks

    def numbers(self, column, rows, head):
        """One column as floats."""
        from pyarrow import compute, float64, types

        kind = column.type
        if types.is_string(kind) or types.is_large_string(kind):
            texts = ["" if text is None else text.strip() for text in column.to_pylist()]
            texts = list(map(with_point, texts)) if has_commas(texts) else texts
            for row, text in zip(rows, texts, strict=True):
                if not DIGITS.fullmatch(text):
                    raise entry_fault(self.path, row, head, text)
            return np.array(texts, float)
        if types.is_temporal(kind) or types.is_boolean(kind) or types.is_nested(kind):
            raise UserError(f'{self.path}: column "{head}": {kind} where numbers are needed')
        values = compute.cast(column, float64(), safe=False).to_numpy(zero_copy_only=False)
        if not np.all(np.isfinite(values)):
            k = int(np.argmin(np.isfinite(values)))
            raise entry_fault(self.path, rows[k], head, "" if column[k].as_py() is None else f"{column[k].as_py()}")
        return values


class SheetRows(TextRows):
    """The rows of the first sheet with a table in an Excel workbook: its cells as texts."""

    def __init__(self, path, _start):
        try:
            import openpyxl
        except ImportError:
            raise UserError(f"{path}: openpyxl is not installed: {extra('full')}; a CSV table needs nothing") from None
        self.path, self.separator, self.decimal = path, "", "."
        try:
            book = openpyxl.load_workbook(path, read_only=True, data_only=True)
            sheets = [list(sheet.iter_rows(values_only=True)) for sheet in book.worksheets]
        except Exception as problem:  # openpyxl has many
            raise UserError(f"{path}: not an Excel workbook (.xlsx): {one_line(problem)}") from None
        for sheet in sheets:
            commas = has_commas(cell for row in sheet for cell in row if isinstance(cell, str))
            self.cells = [(number, [cell_text(cell, commas) for cell in row]) for number, row in enumerate(sheet, 1)]
            faults, self.first, self.heads = head_of(list(islice(self.rows(), SAMPLE)))
            if faults <= 1.0:
                return
        raise UserError(f"{path}: no sheet with a line of names and rows of numbers")

    def rows(self, _separator="", first=1):
        """Row numbers and entries from the row `first` on, without empty ones."""
        yield from ((number, row) for number, row in self.cells if number >= first and any(row) and row[0][:1] != "#")


def cell_text(cell, commas=False):
    """A cell as the text that a CSV table would have; commas: whether cells of texts have decimal commas."""
    if commas and isinstance(cell, str):
        return with_point(cell.strip())
    if isinstance(cell, timedelta):
        seconds = cell.total_seconds()
        return f"{int(seconds // 3600)}:{int(seconds // 60 % 60):02}:{seconds % 60:09.6f}"
    if isinstance(cell, datetime | date | time):
        return cell.isoformat()
    return "" if cell is None else repr(cell) if isinstance(cell, float) else str(cell).strip()


KINDS = {b"PAR1": ParquetRows, b"PK\x03\x04": SheetRows}  # by the first bytes of a file
