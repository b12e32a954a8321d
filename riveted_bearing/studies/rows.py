"""Rows of a sweep: one for each run, kept in the sweep's folder."""

import contextlib
import time
import uuid
from datetime import UTC, datetime
from pathlib import Path

from filelock import FileLock, Timeout

from ..base.errors import UserError
from ..base.files import KEY, make_folder, one_line, read_table, write_atomically, write_table
from ..base.interrupts import held_interrupts

WRITING = 0.05  # of the time at most goes into files of rows
ROWS = "runs.parquet"
SUPERSEDED = "_superseded"  # readers of Parquet datasets pass over names that begin so


@contextlib.contextmanager
def alone_in(folder):
    """No second sweep writes to the folder meanwhile; UserError if one does already."""
    make_folder(folder)
    try:
        with FileLock(folder / ".lock", timeout=0):
            yield
    except Timeout:
        raise UserError(
            f"{folder}: another sweep is writing to this folder: wait until it has ended, or name another folder with --out"
        ) from None


class RowStore:
    """Writes rows as they arrive: one file a row, or several rows a file where single ones would take more than WRITING
    of the time.

    A process that is killed loses the rows of the last moments, twenty times as long as a file takes: those runs are
    done again.
    """

    def __init__(self, folder, schema, clock=time.monotonic):
        self.folder, self.schema, self.clock, self.rows, self.due = folder, schema, clock, [], 0.0

    def add(self, row):
        """Take a row, which an interrupt leaves in a file; KeyboardInterrupt once it is there."""
        self.rows.append(row)
        if self.clock() < self.due:
            return
        with held_interrupts() as interrupts:
            self.write()
        if interrupts.pending:
            raise KeyboardInterrupt

    def write(self):
        """Write what has been taken."""
        if self.rows:
            begin = self.clock()
            write_rows(self.folder / f"run-{self.rows[0]['key']}.parquet", self.rows, self.schema)
            end = self.clock()
            self.rows, self.due = [], end + (end - begin) / WRITING


def write_rows(path, rows, schema):
    """Write rows as a Parquet file, whole or not at all; columns without a value are null."""
    import pyarrow as pa

    table = pa.Table.from_pylist(rows, schema=schema)
    write_atomically(path, lambda temporary: write_table(table, temporary))


def read_rows(path):
    """The Arrow table of a file of rows; UserError if it is damaged or something else."""
    try:
        table = read_table(path)
        if KEY.encode() not in (table.schema.metadata or {}) or not {"key", "status", "run"} <= set(table.column_names):
            raise ValueError("no table of runs")
        return table
    except Exception as problem:  # pyarrow has many
        raise UserError(
            f"{path}: not a result of a sweep, or damaged: {one_line(problem)}; without this file its runs are done again"
        ) from None


def compact(folder, schema, keys, grows=False):
    """Put all rows into one file, in the order of the design and each run once; returns the keys of the runs that are
    done.

    If the design or the FMU has changed, the rows that no longer belong to the design go to a folder that readers pass
    over, or behind the others if the design grows.  The new file is written before the old ones are removed; a process
    that is killed in between leaves rows twice, until the next call.
    """
    import pyarrow as pa

    whole = folder / ROWS
    # what an earlier call has put together, then what came after
    files = sorted(folder.glob("[!._]*.parquet"), key=lambda path: (path != whole, path))
    if not files:
        return set()
    table = pa.concat_tables([schema.empty_table(), *(read_rows(path) for path in files)], promote_options="default")
    facts = zip(*(table[name].to_pylist() for name in ("key", "status")), strict=True)
    # whatever the clocks say
    latest = {key: i for _, i, key in sorted((status == "done", i, key) for i, (key, status) in enumerate(facts))}
    if grows:
        keys = list(dict.fromkeys([*keys, *latest]))
    wanted = set(keys)
    if foreign := [i for key, i in latest.items() if key not in wanted]:
        path = folder / SUPERSEDED / f"{datetime.now(UTC):%Y%m%d-%H%M%S}-{uuid.uuid4().hex[:8]}.parquet"
        write_atomically(path, lambda temporary: write_table(table.take(foreign), temporary))
    places = {key: place for place, key in enumerate(keys) if key in latest}
    kept = table.take(pa.array([latest[key] for key in places], pa.int64())).select(schema.names).cast(schema)
    kept = kept.set_column(
        schema.get_field_index("run"), schema.field("run"), pa.array(list(places.values()), pa.int64())
    )
    write_atomically(whole, lambda temporary: write_table(kept.replace_schema_metadata(schema.metadata), temporary))
    for path in files:
        if path != whole:
            path.unlink()
    return {
        key for key, status in zip(kept["key"].to_pylist(), kept["status"].to_pylist(), strict=True) if status == "done"
    }


def columns_of(folder):
    """The rows of a sweep's folder by column name, as numpy arrays; raises UserError if there are none."""
    path = Path(folder) / ROWS
    if not path.is_file():
        raise UserError(f"{path}: no such sweep result")
    table = read_rows(path)
    return {name: table[name].to_numpy() for name in table.column_names}
