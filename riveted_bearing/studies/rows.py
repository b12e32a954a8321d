"""Rows of a sweep, one a run: in _rows.sqlite as they arrive, then in the design's order in runs.parquet for readers."""

import base64
import contextlib
import json
import sqlite3
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from ..base.errors import UserError
from ..base.files import KEY, make_folder, one_line, read_table, write_atomically, write_table
from ..base.interrupts import held_interrupts

STORE, ROWS = "_rows.sqlite", "runs.parquet"
AGAIN = "without this file its runs are done again"


def coded(value):
    """A number or an array of numpy for JSON; an array as its bytes, which take a tenth of the time of its digits."""
    if value.ndim == 0:
        return value.item()
    return {"dtype": value.dtype.str, "base64": base64.b64encode(value.tobytes()).decode()}


def decoded(found):
    """The array of coded(), or the row."""
    return np.frombuffer(base64.b64decode(found["base64"]), found["dtype"]) if "base64" in found else found


class Store:
    """The rows of a folder by key, in a file of one process at a time; a context manager.  A row is there once `add` returned,
    stays when the design changes, and is taken over from Parquet files where these are all.
    """

    def __init__(self, folder):
        self.folder, self.path = Path(folder), Path(folder) / STORE
        self.file = None
        make_folder(folder)

    def __enter__(self):
        try:
            with self.errors():
                self.file = sqlite3.connect(self.path, timeout=0, isolation_level=None)
                self.open()
        except BaseException:
            self.__exit__()
            raise
        return self

    def open(self):
        """Take the file for this process; a new one takes over the rows of Parquet files."""
        self.file.execute("PRAGMA locking_mode = EXCLUSIVE")
        self.file.execute("PRAGMA journal_mode = WAL")  # a row does not wait for the disk
        self.file.execute("PRAGMA synchronous = NORMAL")
        self.file.execute("BEGIN IMMEDIATE")
        if not self.file.execute("SELECT name FROM sqlite_master").fetchall():
            self.file.execute("CREATE TABLE runs (key TEXT PRIMARY KEY, status TEXT, row TEXT)")
            for path in sorted(self.folder.glob("[!._]*.parquet"), key=lambda path: (path.name != ROWS, path)):
                for row in read_rows(path).to_pylist():
                    self.put(row)
        self.file.execute("COMMIT")

    def __exit__(self, *_):
        if self.file:
            self.file.close()

    @contextlib.contextmanager
    def errors(self):
        """What SQLite refuses, as a UserError."""
        try:
            yield
        except sqlite3.DatabaseError as problem:
            kind = problem.sqlite_errorname
            if kind.startswith("SQLITE_BUSY"):
                raise UserError(
                    f"{self.folder}: another sweep is writing to this folder: wait until it has ended, or name another folder with --out"
                ) from None
            if kind.startswith(("SQLITE_FULL", "SQLITE_IOERR", "SQLITE_CANTOPEN", "SQLITE_READONLY")):
                raise UserError(f"{self.path}: cannot be written: {problem}") from None
            raise UserError(f"{self.path}: not a result of a sweep, or damaged: {problem}; {AGAIN}") from None

    def put(self, row):
        """Keep a row in the place of an earlier one of its key."""
        text = json.dumps(row, default=coded)
        self.file.execute("INSERT OR REPLACE INTO runs VALUES (?, ?, ?)", (row["key"], row["status"], text))

    def add(self, row):
        """Keep a row also from an interrupt; KeyboardInterrupt once it is there."""
        with held_interrupts() as interrupts, self.errors():
            self.put(row)
        if interrupts.pending:
            raise KeyboardInterrupt

    def done(self):
        """Keys of the runs that are done."""
        with self.errors():
            return {key for (key,) in self.file.execute("SELECT key FROM runs WHERE status = 'done'")}

    def export(self, schema, keys, grows=False):
        """Write runs.parquet, rows in the keys' order with their place as `run`, all others behind if it grows."""
        import pyarrow as pa

        with self.errors():
            found = dict(self.file.execute("SELECT key, row FROM runs ORDER BY rowid"))
        keys = dict.fromkeys([*keys, *(found if grows else ())])
        there = [(place, found[key]) for place, key in enumerate(keys) if key in found]
        rows = [json.loads(text, object_hook=decoded) | {"run": place} for place, text in there]
        table = pa.Table.from_pylist(rows, schema=schema)
        write_atomically(self.folder / ROWS, lambda temporary: write_table(table, temporary))
        return numbers(table)


def read_rows(path):
    """The Arrow table of a Parquet file of rows; UserError if it is damaged or something else."""
    try:
        table = read_table(path)
        if KEY.encode() not in (table.schema.metadata or {}) or not {"key", "status", "run"} <= set(table.column_names):
            raise ValueError("no table of runs")
        return table
    except Exception as problem:  # pyarrow has many
        raise UserError(f"{path}: not a result of a sweep, or damaged: {one_line(repr(problem))}; {AGAIN}") from None


def columns_of(folder: str | Path) -> dict[str, np.ndarray]:
    """The rows of a sweep's folder by column name, as numpy arrays; raises UserError if there are none."""
    path = Path(folder) / ROWS
    if not path.is_file():
        raise UserError(f"{path}: no such sweep result")
    return numbers(read_rows(path))


def numbers(table):
    """The columns of an Arrow table as numpy arrays by name."""
    return {name: table[name].to_numpy() for name in table.column_names}


def of_keys(rows: dict[str, np.ndarray], keys: Iterable[str]) -> dict[str, np.ndarray]:
    """The rows of the keys, in their order."""
    places = {key: i for i, key in enumerate(rows["key"])}
    chosen = [places[key] for key in keys]
    return {name: column[chosen] for name, column in rows.items()}
