"""Records of benchmarks as CSV, one file for each machine and benchmark: benchmarks/results/MACHINE/NAME.csv, tracked;
the pages are made from these files.

    # benchmark = "rtf"
    # short = false
    # date = "2025-01-31T12:00:00+00:00"
    # commit = "732eda5"
    # machine = {"processor": ..., "system": ..., "compiler": ..., "python": ...}
    where,rounds,rtf,inside,evals
    ,7,,,
    scenes/demo,,0.41,0.39,103000

A record is a tree of tables and lists.  Each node that has values of its own is a row; `where` is the node's path, [i]
an item of a list, and the columns are the names of all values.  Numbers have all their digits, an empty cell is no
value, and a text that reads like a number stands in quotation marks of its own.
"""

import csv
import io
import itertools
import json
import re
from pathlib import Path

RESULTS = Path(__file__).resolve().parent / "results"
HEADER = ("benchmark", "short", "date", "commit", "machine")


def folder_of(machine):
    """Name of a machine's folder: processor and compiler in lower case, without trade marks and versions of the
    distribution.
    """
    compiler = re.sub(r"\(.*?\)", "", machine["compiler"])
    text = re.sub(r"\((?:r|tm)\)|\bcpu\b|\bprocessor\b|@.*", " ", machine["processor"].lower()) + " " + compiler.lower()
    return "-".join(re.findall(r"[a-z0-9.]+", text))


def write_record(record, folder=RESULTS):
    """Write a record (members HEADER and what was measured) and return the file's path; ValueError for a name with a
    slash.
    """
    path = Path(folder) / folder_of(record["machine"]) / f"{record['benchmark']}.csv"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text_of(record), encoding="utf-8", newline="\n")
    return path


def read_record(path):
    """The record in a file; ValueError naming the file if it is none."""
    try:
        return record_of(Path(path).read_text(encoding="utf-8"))
    except (ValueError, KeyError, IndexError) as problem:
        raise ValueError(f"{path}: not a benchmark's record: {problem}") from None


def newest_record(name, folder=RESULTS):
    """The newest record of a benchmark, of whichever machine; FileNotFoundError if there is none."""
    paths = sorted(Path(folder).glob(f"*/{name}.csv"))
    if not paths:
        raise FileNotFoundError(f"{folder}: no record of {name}: `python benchmarks/{name}.py` makes one")
    return max(map(read_record, paths), key=lambda record: record["date"])


def newest_if_any(name, folder=RESULTS):
    """The newest record of a benchmark, None if there is none."""
    try:
        return newest_record(name, folder)
    except FileNotFoundError:
        return None


def text_of(record):
    """The record as CSV behind a header of "# name = JSON" lines."""
    rows = list(rows_of({name: value for name, value in record.items() if name not in HEADER}))
    columns = list(dict.fromkeys(name for _, values in rows for name in values))
    text = io.StringIO()
    text.writelines(f"# {name} = {json.dumps(record[name], ensure_ascii=False)}\n" for name in HEADER)
    table = csv.writer(text, lineterminator="\n")
    table.writerow(["where", *columns])
    table.writerows(
        [where, *(cell(values[name]) if name in values else "" for name in columns)] for where, values in rows
    )
    return text.getvalue()


def rows_of(node, where=""):
    """Path and values of each node that has values, or that has nothing at all below it."""
    items = (
        [(f"[{i}]", value) for i, value in enumerate(node)]
        if isinstance(node, (list, tuple))
        else [(str(name), value) for name, value in node.items()]
    )
    values = {name: value for name, value in items if not is_branch(value)}
    if values:
        yield where, values
    for name, value in items:
        if "/" in name:
            raise ValueError(f"{where}/{name}: a name in a record has no slash")
        if is_branch(value):
            yield from rows_of(value, f"{where}/{name}" if where else name)


def is_branch(value):
    """Whether a value is rows of its own: a table or a list that is not empty and, if a list, not of plain values only."""
    if isinstance(value, (list, tuple)):
        return any(isinstance(item, (dict, list, tuple)) for item in value)
    return isinstance(value, dict) and bool(value)


def cell(value):
    """A value as a cell."""
    if isinstance(value, str) and value and not reads_as_json(value):
        return value
    return json.dumps(value, ensure_ascii=False, default=float)


def reads_as_json(text):
    try:
        json.loads(text)
    except ValueError:
        return False
    return True


def value_of(text):
    """The value of a cell."""
    return json.loads(text) if reads_as_json(text) else text


def record_of(text):
    """The record of text_of."""
    lines = list(io.StringIO(text))
    header = [
        line.removeprefix("# ").partition(" = ")
        for line in itertools.takewhile(lambda line: line.startswith("# "), lines)
    ]
    record = {name: json.loads(value) for name, _, value in header}
    if missing := [name for name in HEADER if name not in record]:
        raise ValueError(f"{', '.join(missing)} missing in the header")
    table = csv.reader(lines[len(header) :])
    _, *columns = next(table)
    tree = {}
    for where, *cells in table:
        node = tree
        for name in filter(None, where.split("/")):
            node = node.setdefault(name, {})
        node |= {name: value_of(text) for name, text in zip(columns, cells, strict=True) if text}
    return record | {name: with_lists(value) for name, value in tree.items()}


def with_lists(node):
    """The tree with lists where the names are [0], [1], ..."""
    if not isinstance(node, dict):
        return node
    items = {name: with_lists(value) for name, value in node.items()}
    if not items or not all(re.fullmatch(r"\[\d+\]", name) for name in items):
        return items
    return [items[f"[{i}]"] for i in range(len(items))]
