"""Long runs: what is recorded goes to disk, bit for bit the same, and memory does not grow with it."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from riveted_bearing import read_result, run, write_result
from riveted_bearing.running import record

ROOT = Path(__file__).resolve().parents[1]

GROWTH = """
import re, sys
import numpy as np
from riveted_bearing.running.record import Record

def anonymous():
    return int(re.search(r"RssAnon:\\s+(\\d+)", open("/proc/self/status").read())[1]) / 1024

rows = int(sys.argv[1])
before = anonymous()
kept, values = Record(rows, 100), np.arange(100.0)
for row in range(rows):
    kept.write(row, values)
columns = kept.columns()
assert columns[99][-1] == 99.0 and columns.nbytes == 800 * rows
print(anonymous() - before)
"""


@pytest.mark.parametrize("count", [1, 7, 1024, 1025, 5000])
@pytest.mark.parametrize("limit", [0, 2**40], ids=["on disk", "in memory"])
def test_rows_become_columns(monkeypatch, count, limit):
    monkeypatch.setattr(record, "IN_MEMORY", limit)
    rows = np.random.default_rng(count).normal(size=(count, 5))
    kept = record.Record(count + 3, 5)
    for row, values in enumerate(rows):
        kept.write(row, np.zeros(5))  # a row may be written again
        kept.write(row, values)
        assert kept.last([1, 4]).tolist() == values[[1, 4]].tolist()
    assert np.array_equal(kept.columns(), rows.T)


def test_a_run_on_disk_has_the_same_bits(monkeypatch, tmp_path):
    """With peaks held over seven steps, and a file of it that is read back."""
    (tmp_path / "mine.toml").write_text("[simulation]\nt_end = 4e-3\nstep = 1e-4\noutput_interval = 7e-4")
    here = run(tmp_path / "mine.toml")
    monkeypatch.setattr(record, "IN_MEMORY", 0)
    there = run(tmp_path / "mine.toml")
    back = read_result(write_result(there, tmp_path / "x.parquet"))
    for name, values in here.data.items():
        assert values.tobytes() == np.asarray(there.data[name]).tobytes() == back.data[name].tobytes(), name


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
def test_memory_does_not_grow_with_the_run():
    """80 and 480 MB of numbers.  What the process itself holds beside the pages of the file: observed 0.8 MB each time."""
    growth = [
        float(
            subprocess.run(
                [sys.executable, "-c", GROWTH, str(rows)], cwd=ROOT, capture_output=True, text=True, check=True
            ).stdout
        )
        for rows in (100_000, 600_000)
    ]
    print(growth)
    assert growth[1] < growth[0] + 20.0
