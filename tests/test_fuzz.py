"""Random calls of the FMI functions (see fuzz_api.c for what they hold) and damaged input files."""

import random
import re
import subprocess

import pytest
from fuzz_readers import try_one
from library import ROOT


def fuzz(calls, seed, threads=1):
    """Counts by kind; a violated requirement ends the program with its text."""
    program = ROOT / "build" / "fuzz_api"
    assert program.is_file(), f"{program} is missing: make build"
    result = subprocess.run([program, str(calls), str(seed), str(threads)], capture_output=True, text=True, timeout=1800)
    assert result.returncode == 0, result.stderr[-2000:]
    return {kind: int(count) for count, kind in re.findall(r"(\d+) (calls|OK|warning|discard|error|reset runs)", result.stdout)}


def check(counts, calls):
    """Every kind of answer has been met often: otherwise the sequences reach nothing."""
    assert counts["calls"] >= calls
    assert counts["OK"] > 0.3 * calls
    assert counts["error"] > 0.1 * calls
    assert counts["discard"] > 1e-3 * calls
    assert counts["reset runs"] > 1e-3 * calls


def test_random_calls_in_two_threads():
    check(fuzz(100_000, seed=1, threads=2), 200_000)


@pytest.mark.slow
def test_ten_million_random_calls():
    check(fuzz(10_000_000, seed=2), 10_000_000)


@pytest.mark.filterwarnings("ignore:overflow")  # 1e308 MPa/N
@pytest.mark.parametrize("strings", [400, pytest.param(40_000, marks=pytest.mark.slow)])
def test_damaged_files_are_read_or_refused_by_name(strings):
    """Bearings, scenes, rivet tables: both happens."""
    bytes_of = random.Random(strings).randbytes
    read = sum(try_one(bytes_of(64)) for _ in range(strings))
    assert 0.02 * strings < read < 0.5 * strings
