"""Random calls of the FMI functions, forged states, refused memory, damaged input files.

What holds for each is said in fuzz_api.c, forge_states.c, fault_memory.c and fuzz_readers.py.
"""

import random
import re
import subprocess
import sys

import pytest
from fuzz_corpus import CORPUS, read
from fuzz_readers import try_one
from library import ROOT


def said(name, *arguments):
    """What a program of the build says; a violated requirement ends the program with its text."""
    program = ROOT / "build" / name
    assert program.is_file(), f"{program} is missing: make build"
    result = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, timeout=3600, check=False)
    assert result.returncode == 0, result.stderr[-2000:]
    return result.stdout


def fuzz(calls, seed, threads=1):
    """Counts by kind."""
    found = re.findall(
        r"(\d+) (calls|OK|warning|discard|error|steps done|reset runs)", said("fuzz_api", calls, seed, threads)
    )
    return {kind: int(count) for count, kind in found}


def check(counts, calls):
    """Every kind of answer has been met often: otherwise the sequences reach nothing."""
    assert counts["calls"] >= calls
    assert counts["OK"] > 0.3 * calls
    assert counts["error"] > 0.1 * calls
    assert counts["discard"] > 1e-3 * calls
    assert counts["steps done"] > 1e-2 * calls  # observed 2.8e-2
    assert counts["reset runs"] > 1e-3 * calls


def test_random_calls_in_two_threads():
    check(fuzz(60_000, seed=1, threads=2), 120_000)


@pytest.mark.slow
def test_ten_million_random_calls():
    """Two minutes."""
    check(fuzz(10_000_000, seed=2), 10_000_000)


def forge(name, count, seed):
    """Counts by what became of the states; each kind occurs, so the forging reaches what it shall."""
    text = said(name, count, seed)
    counts = {
        kind: int(number) for number, kind in re.findall(r"(\d+) (forged|refused|kept|stepped|discarded|stopped)", text)
    }
    assert counts["forged"] == count
    assert counts["refused"] > 0.2 * count and counts["stepped"] > 0.2 * count and counts["kept"] > 0.05 * count
    assert sum(counts.values()) == 2 * count


@pytest.mark.parametrize("name", ["forge_states", "forge_states_shaft"])
def test_forged_states_are_refused_or_run(name):
    """A right checksum, changed content."""
    forge(name, 1000, seed=3)


def test_every_field_out_of_range_is_refused():
    """Indices, enumerations, depths, counts, phases, times and numbers of a bearing's state, one after the other."""
    # observed 9289
    assert int(re.match(r"(\d+) fields out of range, all refused", said("forge_states", "fields"))[1]) > 7000


@pytest.mark.slow
@pytest.mark.parametrize(("name", "count"), [("forge_states", 900_000), ("forge_states_shaft", 100_000)])
def test_a_million_forged_states(name, count):
    forge(name, count, seed=4)


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the linker of Linux sends allocations to the test")
@pytest.mark.parametrize("name", ["fault_memory", "fault_memory_shaft"])
def test_every_refused_allocation_is_said_and_leaves_nothing(name):
    """Instantiate, initialize, save, restore with the n-th allocation refused, for every n."""
    refused = {act: int(count) for act, count in re.findall(r"(\w+) (\d+)", said(name))}
    assert set(refused) == {"instantiate", "initialize", "step", "save", "load", "restore"}
    assert refused["instantiate"] >= 2 and refused["save"] == 1 and refused["load"] >= 1


@pytest.mark.filterwarnings("ignore:overflow")  # 1e308 MPa/N
@pytest.mark.parametrize("strings", [150, pytest.param(40_000, marks=pytest.mark.slow)])
def test_damaged_files_are_read_or_refused_by_name(strings):
    """Bearings, scenes, rivet tables: both happens."""
    bytes_of = random.Random(strings).randbytes
    read = sum(try_one(bytes_of(64)) for _ in range(strings))
    assert 0.02 * strings < read < 0.5 * strings


@pytest.mark.filterwarnings("ignore:overflow")  # 1e308 MPa/N
def test_damaged_files_of_the_corpus_are_read_or_refused_by_name():
    """One for each kind of refusal that random damage met."""
    done = [try_one(string) for string in read(CORPUS / "fuzz_readers.txt")]
    assert any(done) and not all(done)
