"""Records of benchmarks: what is written to benchmarks/results is read again digit for digit, and the pages are made
from it.
"""

import math
import sys

import pytest
from library import ROOT

sys.path.insert(0, str(ROOT / "benchmarks"))

from records import RESULTS, folder_of, newest_record, read_record, write_record

MACHINE = {
    "processor": "Intel(R) Xeon(R) CPU @ 2.20GHz",
    "system": "Linux x86_64",
    "compiler": "gcc (Debian 12.2.0-14) 12.2.0",
    "python": "3.11.7",
}
ABOUT = {
    "benchmark": "rtf",
    "short": True,
    "date": "2025-01-31T12:00:00+00:00",
    "commit": "732eda5+",
    "machine": MACHINE,
}


@pytest.mark.parametrize(
    "measured",
    [
        {"rounds": 7, "scenes": {"demo": {"rtf": 0.1 + 0.2, "evals": 103000.0}, "jam": {"rtf": 1e-300, "evals": -0.0}}},
        {
            "rows": [{"family": "CVODE BDF, dense", "tolerance": 1e-3}, {"family": "failed"}],
            "seeds": [8, 16, 32],
            "nothing": [],
            "none": {},
        },
        {
            "records": [
                {"name": '"5"', "message": "ring.tilt_y = 0.2:\n out of range", "events": {"skid": 3}},
                {"name": "5", "message": "", "events": {}},
            ]
        },
        {
            "step": {"1e-06": {"constant": {"rtf": 2.5}}, "0.01": {"constant": {"rtf": 0.4}}},
            "horizon": {"0.4": [{"rtf": 1.0}, {"rtf": 2.0}]},
        },
        {"same_bits": True, "missing": None, "text": "true", "nested": [[1.0, 2.0], [3.0, 4.0]], "# no header": "# 1"},
    ],
)
def test_record_is_read_as_written(tmp_path, measured):
    path = write_record(ABOUT | measured, tmp_path)
    assert read_record(path) == ABOUT | measured


def test_numbers_that_are_none_are_kept(tmp_path):
    found = read_record(write_record(ABOUT | {"scenes": {"a": {"error": math.nan, "ratio": math.inf}}}, tmp_path))[
        "scenes"
    ]["a"]
    assert math.isnan(found["error"]) and found["ratio"] == math.inf


def test_record_tells_machine_date_and_commit(tmp_path):
    """As text in the file's head, and the machine in the folder's name; the table behind the head is plain CSV."""
    path = write_record(ABOUT | {"rounds": 7, "scenes": {"demo": {"rtf": 0.41}}}, tmp_path)
    assert path.relative_to(tmp_path).as_posix() == "intel-xeon-gcc-12.2.0/rtf.csv"
    head, table = [], []
    for line in path.read_text().splitlines():
        (head if line.startswith("# ") else table).append(line)
    assert (
        '# commit = "732eda5+"' in head
        and '# date = "2025-01-31T12:00:00+00:00"' in head
        and any("2.20GHz" in line for line in head)
    )
    assert table == ["where,rounds,rtf", ",7,", "scenes/demo,,0.41"]


def test_newest_record_counts_whatever_the_machine(tmp_path):
    other = MACHINE | {"processor": "AMD EPYC 9B14"}
    assert folder_of(other) == "amd-epyc-9b14-gcc-12.2.0"
    write_record(ABOUT | {"machine": other, "rounds": 1, "date": "2025-03-01T00:00:00+00:00"}, tmp_path)
    write_record(ABOUT | {"rounds": 2}, tmp_path)
    assert newest_record("rtf", tmp_path)["rounds"] == 1
    with pytest.raises(FileNotFoundError, match="no record of scaling"):
        newest_record("scaling", tmp_path)


@pytest.mark.parametrize("text", ["", "where,rtf\n,1\n", "# benchmark = rtf\n"])
def test_damaged_records_are_refused(tmp_path, text):
    path = tmp_path / "rtf.csv"
    path.write_text(text)
    with pytest.raises(ValueError, match="rtf.csv: not a benchmark's record"):
        read_record(path)


def test_names_with_slashes_are_refused(tmp_path):
    with pytest.raises(ValueError, match="no slash"):
        write_record(ABOUT | {"a/b": {"rtf": 1.0}}, tmp_path)


TRACKED = sorted(RESULTS.glob("*/*.csv"))


@pytest.mark.parametrize("path", TRACKED, ids=lambda path: f"{path.parent.name}/{path.name}")
def test_tracked_records_can_be_read(path):
    record = read_record(path)
    assert record["benchmark"] == path.stem and folder_of(record["machine"]) == path.parent.name and record["commit"]


def test_page_shows_the_records_numbers(tmp_path):
    """What a chapter says is what the file says: another number in the file is another number in the chapter."""
    from performance_page import CHAPTERS, page

    assert page(tmp_path).count("Not measured here") == len(CHAPTERS) == 6
    sets = {isa: {"rhs": ns} for isa, ns in (("scalar", 3456.0), ("avx2", 1728.0))}
    peaks = {isa: {"arithmetic": 0.25, "load": 0.2, "divide": 1.5, "root": 2.5} for isa in sets}
    data = {"peaks": peaks, "scenes": {"demo": {"title": "working point", "pockets_touched": 2.5, "sets": sets}}}
    path = write_record(ABOUT | {"benchmark": "rhs"} | data, tmp_path)
    text = page(tmp_path)
    assert "short form, 2025-01-31, commit 732eda5+, Intel(R) Xeon(R) CPU @ 2.20GHz" in text
    assert "**3,456**" in text and "2.00×" in text
    path.write_text(path.read_text().replace("3456.0", "5184.0"))
    assert "3.00×" in page(tmp_path)
