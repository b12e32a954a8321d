"""Files that the program writes and reads: a full disk, a killed writer, damaged content, hostile texts, and clocks
that jump.
"""

import contextlib
import json
import os
import random
import re
import subprocess
import sys
import time
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import psutil
import pyarrow as pa
import pytest
from commands import rows_kept

from riveted_bearing import Result, UserError, read_result, run, write_result
from riveted_bearing.base.files import FORMATS
from riveted_bearing.running.fmu import Model
from riveted_bearing.show import report
from riveted_bearing.show.animation import needed, number_of_balls
from riveted_bearing.show.report import render
from riveted_bearing.studies import sweep as engine
from riveted_bearing.studies.rows import Store, columns_of
from riveted_bearing.studies.sweep import cluster, schema_of
from riveted_bearing.studies.sweep_file import load_sweep

ROOT = Path(__file__).resolve().parents[1]
ENVIRONMENT = os.environ | {"PYTHONPATH": str(ROOT)}


@pytest.fixture(scope="module")
def short():
    """A short run of the working point with all that a report shows."""
    return run("demo", t_end=2e-3, parameters={"start.settle": 5e-4, "scene.stress": "fatigue"})


def command(*arguments, folder, **options):
    """The program as a user starts it."""
    words = [sys.executable, "-m", "riveted_bearing", *map(str, arguments)]
    return subprocess.run(
        words, cwd=folder, env=ENVIRONMENT, capture_output=True, text=True, timeout=300, check=False, **options
    )


def files_below(folder):
    """All files by path, hidden ones too."""
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file())


# ------------------------------------------------------------------------------------------------------------ full disk


LATE = """
import importlib, resource, signal, sys
module, name, size, *words = sys.argv[1:]
owner = importlib.import_module(module)
for part in name.split(".")[:-1]:
    owner = getattr(owner, part)
real = getattr(owner, name.split(".")[-1])
def then_full(*arguments, **options):
    done = real(*arguments, **options)
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (int(size), int(size)))
    return done
setattr(owner, name.split(".")[-1], then_full)
from riveted_bearing.cli import program
program(words)
"""


def command_on_a_small_disk(after, size, arguments, folder, **environment):
    """The program; once its function `after` (module:name) has returned, no file grows beyond `size` bytes: writing
    more fails as on a full disk.
    """
    words = [sys.executable, "-c", LATE, *after.split(":"), size, *arguments]
    return subprocess.run(
        list(map(str, words)),
        cwd=folder,
        env=ENVIRONMENT | environment,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )


RUN = ["run", "demo", "--t-end", "2 ms", "--set", "scene.stress=off", "--set", "start.settle=0", "--out", "out"]
SIMULATED, READ, ASKED = (
    "riveted_bearing.running.runner:simulate",
    "riveted_bearing.show.report:read_result",
    "riveted_bearing.building.builder:bearing_case",
)
STARTED = "riveted_bearing.studies.sweep:cluster.__enter__"
# command line, what it has done when the disk becomes full, largest file [bytes], name of the file in the message
WRITERS = {
    "parquet": ([*RUN, "--no-plot"], SIMULATED, 4000, "out/demo.parquet"),
    "csv": ([*RUN, "--no-plot", "--format", "csv"], SIMULATED, 4000, "out/demo.csv"),
    "mat": ([*RUN, "--no-plot", "--format", "mat"], SIMULATED, 4000, "out/demo.mat"),
    "report": (["report", "good.parquet", "--out", "out/page.html"], READ, 4000, "out/page.html"),
    "table": (["build", "--table", "closed-form", "--out", "out/my.fmu"], ASKED, 4000, r"\S*closed-form-\w+-\w+.json"),
    "sweep": (["sweep", "study.toml", "--workers", "1", "--out", "out"], STARTED, 2000, "out/_rows.sqlite"),
}


@pytest.mark.parametrize("name", WRITERS)
def test_a_full_disk_is_one_message_and_leaves_nothing(short, tmp_path, name):
    arguments, after, size, file = WRITERS[name]
    write_result(drawn(short), tmp_path / "good.parquet")
    (tmp_path / "study.toml").write_text(
        'repeats = 2\n[simulation]\nt_end = 1e-3\n[parameters]\nstart.settle = 0\nscene.stress = "off"'
    )
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "page.html").write_text("old")
    before = files_below(tmp_path)
    cache = {"XDG_CACHE_HOME": str(tmp_path)} if name == "table" else {}
    done = command_on_a_small_disk(after, size, arguments, tmp_path, **cache)
    said = [line for line in done.stderr.splitlines() if not line.startswith("note: ")]
    assert done.returncode == 2 and len(said) == 1, done.stderr
    assert re.fullmatch(rf"error: {file}: cannot be written: .*", said[0]), done.stderr
    left = [file for file in files_below(tmp_path) if not file.startswith("out/_rows.sqlite")]  # of a sweep: no row
    assert left == before and (tmp_path / "out" / "page.html").read_text() == "old"


def test_a_disk_that_is_full_for_the_picture_keeps_the_results(tmp_path):
    """Written before it; 60 kB are enough for the one, not for the other."""
    few = [*RUN, "--out", "out/few.csv"]
    done = command_on_a_small_disk(SIMULATED, 60_000, few, tmp_path)
    assert done.returncode == 2 and re.search(r"error: out/few.(png|csv): cannot be written: ", done.stderr), (
        done.stderr
    )
    done = command_on_a_small_disk("riveted_bearing.running.results:write_result", 20_000, few, tmp_path)
    assert done.returncode == 2 and re.search(r"error: out/few.png: cannot be written: ", done.stderr), done.stderr
    assert files_below(tmp_path) == ["out/few.csv"]
    assert len(read_result(tmp_path / "out" / "few.csv").data["time"]) == 21


def test_a_full_disk_leaves_the_old_fmu(fmu, tmp_path):
    """The packer of FMUs, and the copy of a finished one to its place: what was there stays."""
    (tmp_path / "my.fmu").write_text("old")
    limit = "import resource, sys; resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000)); sys.path.insert(0, sys.argv[1]); "
    copy = limit + "import shutil; from pathlib import Path; from riveted_bearing.base import files\n"
    copy += "files.write_atomically(Path('my.fmu'), lambda temporary: shutil.copyfile(sys.argv[2], temporary))"
    pack = limit + "import package; package.main(sys.argv[2:])"
    options = [f"@{ROOT / 'build' / 'fmu' / 'arguments.txt'}", "--out", "my.fmu"]
    for code, words, reason in (
        (copy, [fmu], "UserError: my.fmu: cannot be written: "),
        (pack, options, "File too large"),
    ):
        call = [sys.executable, "-c", code, ROOT / "fmus", *words]
        done = subprocess.run(call, cwd=tmp_path, env=ENVIRONMENT, capture_output=True, text=True, check=False)
        assert done.returncode != 0 and reason in done.stderr
        assert files_below(tmp_path) == ["my.fmu"] and (tmp_path / "my.fmu").read_text() == "old"


# -------------------------------------------------------------------------------------------------------- killed writer

SLOW = """
import sys, time; from pathlib import Path
from riveted_bearing import read_result
from riveted_bearing.running import results
real = results.WRITERS["{kind}"]
def slow(result, metadata, path):
    real(result, metadata, path)
    with path.open("rb+") as file:
        file.truncate(path.stat().st_size // 2)
    print("half", flush=True)
    time.sleep(60)
results.WRITERS["{kind}"] = slow
results.write_result(read_result("{good}"), Path("{kind}.{kind}"))
"""


@pytest.mark.parametrize("kind", FORMATS)
def test_a_killed_writer_leaves_the_old_file(short, tmp_path, kind):
    """Half of a file is written when the process is killed: under the final name stands what was there, and the next
    writer gets through.
    """
    good = write_result(replace(short, about=short.about | {"scene": "new"}), tmp_path / f"good.{kind}")
    write_result(short, tmp_path / f"{kind}.{kind}")
    code = SLOW.format(kind=kind, good=good)
    with subprocess.Popen(
        [sys.executable, "-c", code], cwd=tmp_path, env=ENVIRONMENT, stdout=subprocess.PIPE
    ) as writer:
        assert writer.stdout.readline() == b"half\n"
        writer.kill()
    assert read_result(tmp_path / f"{kind}.{kind}").about["scene"] == "demo"
    write_result(read_result(good), tmp_path / f"{kind}.{kind}")
    assert read_result(tmp_path / f"{kind}.{kind}").about["scene"] == "new"


# ------------------------------------------------------------------------------------------------------ damaged content


def same(a, b):
    """Whether two results hold the same bits."""
    return (
        a.metadata() == b.metadata()
        and list(a.data) == list(b.data)
        and all(a.data[name].tobytes() == b.data[name].tobytes() for name in b.data)
    )


@pytest.fixture(scope="module")
def little(short):
    """A result with few channels, so that a flipped bit hits each part of the file often."""
    names = ("time", "ring.y", "ball[1].Q_i", "ball[2].Q_i")
    return replace(
        short, data={name: short.data[name] for name in names}, units={name: short.units[name] for name in names}
    )


def outcome_of(path):
    """The result of a file and "", or None and why it is refused."""
    try:
        return read_result(path), ""
    except UserError as problem:
        return None, str(problem)


@pytest.mark.parametrize("kind", FORMATS)
def test_a_flipped_bit_is_refused_or_harmless(little, tmp_path, kind):
    """One bit of the file, anywhere: one line that names the file, or the very values that were written."""
    path = write_result(little, tmp_path / f"x.{kind}")
    good, refused, chance = path.read_bytes(), 0, random.Random(1)
    for _ in range(300):
        at = chance.randrange(8 * len(good))
        bad = bytearray(good)
        bad[at // 8] ^= 1 << at % 8
        path.write_bytes(bytes(bad))
        back, problem = outcome_of(path)
        assert same(back, little) if back else re.fullmatch(rf"{re.escape(str(path))}: .+", problem), (at, problem)
        refused += back is None
    assert refused > 150  # observed: Parquet 190, whose statistics nobody reads; CSV 296; MAT 283


@pytest.mark.parametrize("kind", FORMATS)
def test_a_shortened_file_is_refused(little, tmp_path, kind):
    """Also where a line or a block ends."""
    path = write_result(little, tmp_path / f"x.{kind}")
    good = path.read_bytes()
    ends = [at for at in range(1, len(good)) if kind == "csv" and good[at - 1 : at] == b"\n"][-30:]
    for length in [*ends[:-1], *range(0, len(good) - 1, len(good) // 40)]:
        path.write_bytes(good[:length])
        with pytest.raises(UserError, match=re.escape(str(path))):
            read_result(path)


def changed(result, **parts):
    """The result with members of its dicts replaced."""
    return replace(result, **{part: getattr(result, part) | values for part, values in parts.items()})


@pytest.mark.parametrize("kind", FORMATS)
@pytest.mark.parametrize(
    ("parts", "fragments"),
    [
        ({"parameters": {"joint.preload": "much"}}, ["joint.preload = 'much'", "not a number"]),
        ({"parameters": {"joint.preload": True}}, ["joint.preload = True", "not a number"]),
        ({"parameters": {"scene.stress": "loud"}}, ["scene.stress = 'loud'", "allowed: ", "fatigue"]),
        ({"parameters": {"scene.stress": 3.0}}, ["scene.stress = 3.0", "allowed: "]),
        ({"summary": {"cpu_time": "long"}}, ["cpu_time = 'long'", "not a number"]),
        ({"about": {"scene": 5}}, ["scene = 5", "not a text"]),
        (
            {"about": {"mode_frequencies": [800.0, -1.0]}},
            ["mode_frequencies = [800.0, -1.0]", "not a list of positive numbers"],
        ),
        ({"about": {"messages": "one"}}, ["messages = 'one'", "not a list of texts"]),
        ({"about": {"versions": {"fmpy": 3}}}, ["versions = {'fmpy': 3}", "not a table of texts"]),
    ],
)
def test_values_that_no_run_writes_are_refused_by_name(little, tmp_path, kind, parts, fragments):
    path = write_result(changed(little, **parts), tmp_path / f"x.{kind}")
    with pytest.raises(UserError) as refused:
        read_result(path)
    for fragment in (str(path), *fragments):
        assert fragment in str(refused.value)


def test_a_text_in_place_of_a_number_is_one_message(little, tmp_path):
    path = write_result(changed(little, parameters={"joint.preload": "much"}), tmp_path / "x.csv")
    done = command("report", path, folder=tmp_path)
    assert done.returncode == 2 and done.stderr == f"error: {path}: joint.preload = 'much': not a number\n"
    assert files_below(tmp_path) == ["x.csv"]


def test_two_users_and_one_cache(tmp_path, monkeypatch):
    """A table that another user has made is read; where none can be written, the message names the variable.  Root, as
    whom tests may run, has permission everywhere: os.access answers for another user.
    """
    from rivet_model.geometry import Geometry
    from riveted_bearing.building.rivet import table_of

    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    path = table_of("here", Geometry(shank_diameter=1.4e-3), "closed-form")
    monkeypatch.setattr(os, "access", lambda *_: False)
    assert table_of("here", Geometry(shank_diameter=1.4e-3), "closed-form") == path
    with pytest.raises(UserError, match=r"tables: no permission to write to this folder; .* XDG_CACHE_HOME"):
        table_of("here", Geometry(shank_diameter=1.5e-3), "closed-form")


def test_a_damaged_table_of_the_cache_is_made_anew(tmp_path, monkeypatch):
    from riveted_bearing.building.rivet import table_of

    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    from bearing_model.rivet import rivet_table
    from rivet_model.geometry import Geometry

    geometry = Geometry(shank_diameter=1.4e-3)
    path = table_of("here", geometry, "closed-form")
    good = path.read_bytes()
    path.write_bytes(good[: len(good) // 2])
    with pytest.raises(ValueError):
        rivet_table.read(path)
    assert table_of("here", geometry, "closed-form") == path and path.read_bytes() == good
    assert rivet_table.read(path).kind == "closed_form"


# --------------------------------------------------------------------------------------------------------------- sweeps


@pytest.fixture(scope="module")
def plan(tmp_path_factory):
    """A sweep of two runs."""
    path = tmp_path_factory.mktemp("sweep") / "study.toml"
    path.write_text("[simulation]\nt_end = 1e-3\n[[vary]]\njoint.preload = [10, 30]")
    return load_sweep(path, Model())


def row(plan, number, status, message, date):
    """A row as the driver writes it."""
    key = list(plan.scenes)[number]
    return engine.about_run(plan, key) | {"status": status, "message": message, "date": date}


def add(plan, folder, number, *words):
    """Keep the row of a run."""
    with Store(folder) as store:
        store.add(row(plan, number, *words))


def exported(plan, folder, keys):
    """Rows of some keys, and the keys that are done."""
    with Store(folder) as store:
        store.export(schema_of(plan), keys)
        return columns_of(folder), store.done()


@pytest.mark.parametrize("name", ["runs.parquet", "_rows.sqlite"])
def test_damaged_rows_of_a_sweep_are_one_message(plan, tmp_path, name):
    add(plan, tmp_path, 0, "done", "", "2026-01-01T00:00:00.000+00:00")
    exported(plan, tmp_path, list(plan.scenes))
    good = (tmp_path / name).read_bytes()
    for bad in (b"PAR1", good[: len(good) // 2], b"x" * 200 + good[200:]):
        for file in tmp_path.iterdir():
            file.unlink()
        (tmp_path / name).write_bytes(bad)
        with pytest.raises(UserError, match=f"{name}: not a result of a sweep, or damaged: .*its runs are done again"):
            exported(plan, tmp_path, list(plan.scenes))
        assert (tmp_path / name).read_bytes() == bad


def test_pages_have_checksums(plan, tmp_path):
    """A bit in the numbers of a page: pyarrow compares the page's checksum."""
    add(plan, tmp_path, 0, "done", "", "2026-01-01T00:00:00.000+00:00")
    exported(plan, tmp_path, list(plan.scenes))
    path = tmp_path / "runs.parquet"
    data = bytearray(path.read_bytes())
    data[data.index(b"2026-01-01T00") + 3] ^= 1
    path.write_bytes(bytes(data))
    with pytest.raises(UserError, match="CRC"):
        columns_of(tmp_path)


def test_what_was_written_last_counts(plan, tmp_path):
    """Whatever its date; rows of another design stay and are there again when the design has them."""
    keys = list(plan.scenes)
    add(plan, tmp_path, 0, "failed", "first try", "2026-11-01T00:00:00.000+00:00")
    assert exported(plan, tmp_path, keys)[1] == set()
    add(plan, tmp_path, 0, "failed", "second try", "2020-01-01T00:00:00.000+00:00")
    assert exported(plan, tmp_path, keys)[0]["message"].tolist() == ["second try"]
    add(plan, tmp_path, 0, "done", "", "1999-01-01T00:00:00.000+00:00")
    assert exported(plan, tmp_path, keys)[1] == {keys[0]}
    assert exported(plan, tmp_path, keys[1:])[0]["key"].tolist() == []
    assert exported(plan, tmp_path, keys)[0]["key"].tolist() == keys[:1]


def test_rows_of_parquet_files_alone_are_taken_over(plan, tmp_path):
    """As an earlier version left them, or who has deleted _rows.sqlite: every value is the same."""
    for number in (0, 1):
        add(plan, tmp_path, number, "done", "", "2026-01-01T00:00:00.000+00:00")
    before, _ = exported(plan, tmp_path, list(plan.scenes))
    (tmp_path / "_rows.sqlite").unlink()
    after, done = exported(plan, tmp_path, list(plan.scenes))
    assert done == set(plan.scenes)
    assert {name: list(map(str, column)) for name, column in after.items()} == {
        name: list(map(str, column)) for name, column in before.items()
    }


def test_arrays_of_rows_come_back_bit_by_bit(plan, tmp_path):
    """Beside lists, as an earlier version wrote them; any bits, also those of no number."""
    arrays = [np.array([0.1, -0.0, np.inf, 5e-324]), np.array([], float), [1.5, 2.5]]
    schema = (
        schema_of(plan)
        .append(pa.field("numbers", pa.list_(pa.float64())))
        .append(pa.field("places", pa.list_(pa.int16())))
    )
    keys = list(map(str, range(len(arrays))))
    with Store(tmp_path) as store:
        for key, array in zip(keys, arrays, strict=True):
            store.add({"key": key, "status": "done", "numbers": array, "places": np.arange(3)})
        columns = store.export(schema, keys)
    for found in (columns, columns_of(tmp_path)):
        assert [column.tobytes() for column in found["numbers"]] == [np.asarray(array).tobytes() for array in arrays]
        assert [column.tolist() for column in found["places"]] == [[0, 1, 2]] * 3


def test_progress_goes_on_when_the_clock_goes_back(monkeypatch):
    """An hour back at each look: time.time is for dates only."""
    hours = iter(range(10**9))
    monkeypatch.setattr(time, "time", lambda: 1e9 - 3600.0 * next(hours))
    seen = []
    result = run("demo", t_end=2e-3, parameters={"scene.stress": "off"}, progress=seen.append)
    assert seen == sorted(seen) and seen[-1] == pytest.approx(2e-3)
    assert 0.0 <= result.summary["cpu_time"] < 60.0 and 0.0 <= result.summary["wall_time"] < 60.0


def test_the_cluster_listens_on_this_machine_only(monkeypatch):
    """Scheduler, dashboard, workers and their keepers."""
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    with cluster(workers=1) as client:
        client.wait_for_workers(1)
        processes = [psutil.Process(), *psutil.Process().children(recursive=True)]
        listening = [
            c.laddr.ip
            for process in processes
            for c in process.net_connections("inet")
            if c.status == psutil.CONN_LISTEN
        ]
        assert len(listening) >= 3 and set(listening) <= {"127.0.0.1", "::1"}
        assert "127.0.0.1" in client.dashboard_link or "localhost" in client.dashboard_link


LOST = "repeats = 24\n[simulation]\nt_end = 0.1\n[parameters]\nstart.settle = '0.5 ms'"


@pytest.mark.slow  # three processes to start
def test_a_lost_scheduler_is_one_message_and_loses_no_row(tmp_path):
    (tmp_path / "study.toml").write_text(LOST)
    dask = [
        sys.executable,
        "-m",
        "distributed.cli.dask_scheduler",
        "--host",
        "127.0.0.1",
        "--port",
        "0",
        "--no-dashboard",
        "--scheduler-file",
        "where.json",
    ]
    quiet = {"cwd": tmp_path, "env": ENVIRONMENT, "stderr": subprocess.DEVNULL}
    with until_killed(dask, **quiet) as scheduler:
        address = json.loads(
            wait_for(lambda: (tmp_path / "where.json").is_file() and (tmp_path / "where.json").read_text())
        )["address"]
        worker = [
            sys.executable,
            "-m",
            "distributed.cli.dask_worker",
            address,
            "--nthreads",
            "1",
            "--no-dashboard",
            "--local-directory",
            tmp_path / "worker",
        ]
        words = [sys.executable, "-m", "riveted_bearing", "sweep", "study.toml", "--out", "out", "--scheduler", address]
        pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
        with until_killed(worker, **quiet), until_killed(words, cwd=tmp_path, env=ENVIRONMENT, **pipes) as driver:
            wait_for(lambda: driver.poll() is not None or rows_kept(tmp_path / "out"))
            scheduler.kill()
            _, said = driver.communicate(timeout=120)
    assert driver.returncode == 2 and said.count("\n") == 1, said
    done = int(
        re.fullmatch(
            r"error: the Dask scheduler is gone after (\d+) of 24 runs; they are in out, the same command does the others\n",
            said,
        )[1]
    )
    assert 1 <= done < 24 and len(columns_of(tmp_path / "out")["key"]) == done
    again = command("sweep", "study.toml", "--out", "out", "--workers", "1", folder=tmp_path)
    assert again.returncode == 0 and "24 runs, 0 of them failed" in again.stdout


@contextlib.contextmanager
def until_killed(words, **options):
    """A program that runs while the block does and not longer, however the block ends."""
    with subprocess.Popen(words, **options) as program:
        try:
            yield program
        finally:
            program.kill()


def wait_for(condition, patience=120.0):
    """The first value of a condition that is not false."""
    end = time.monotonic() + patience
    while time.monotonic() < end:
        if value := condition():
            return value
        time.sleep(0.05)
    raise TimeoutError


# --------------------------------------------------------------------------------------------------------------- report

POISON = """</script></style></title><script>alert(1)</script>'"<img src=x onerror=alert(2)>&amp;{{ 7*7 }}<!-- ]]> $\\frac{ """


class Elements(HTMLParser):
    """Tags with the names of their attributes, and the content of scripts."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.seen, self.scripts, self.inside = [], [], False
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        self.seen.append((tag, *(name for name, _ in attributes)))
        self.inside = tag == "script"

    def handle_endtag(self, tag):
        self.seen.append(tag)
        self.inside = False

    def handle_comment(self, data):
        self.seen.append("comment")

    def handle_data(self, data):
        if self.inside:
            self.scripts.append(data)


def with_texts(value, text, keys=False):
    """The value with each text in it replaced, and those of keys if asked for."""
    if isinstance(value, str):
        return text
    if isinstance(value, dict):
        return {(f"{text}{i}" if keys else name): with_texts(one, text) for i, (name, one) in enumerate(value.items())}
    return [with_texts(one, text) for one in value] if isinstance(value, list | tuple) else value


def hostile(result, text):
    """The result with a text in the place of every text: origin, messages, versions, units, items, and names that no
    table knows.
    """
    tables = {
        name: with_texts(result.about[name], text, keys=True) for name in ("versions", "not_given", "basis", "units")
    }
    about = (
        with_texts(result.about, text)
        | tables
        | {"messages": [text, text], "stopped": text, "inputs": {}, "given": [text]}
    )
    return replace(
        result,
        about=about,
        units=dict.fromkeys(result.units, text),
        parameters=result.parameters | {text: 1.0, f"{text}2": text},
        summary=result.summary | {text: 1.0},
    )


def drawn(short):
    """The run with the channels of the drawing only: a page with the film and few of the fourteen charts, which take
    0.3 s each.
    """
    return replace(
        short,
        data={
            name: values
            for name, values in short.data.items()
            if name == "time" or name in needed(number_of_balls(short))
        },
    )


@pytest.mark.parametrize("channels", [drawn, pytest.param(lambda short: short, marks=pytest.mark.slow, id="all")])
def test_no_text_of_a_result_becomes_part_of_the_page(short, monkeypatch, channels):
    """The elements, attributes and scripts of the page are those of a page with harmless texts, also with any text in
    the film.
    """
    real, pages = report.frames, []
    for text in ("harmless", POISON):
        monkeypatch.setattr(report, "frames", lambda result, text=text: (real(result)[0] | {"note": text}, []))
        pages.append(Elements(render(hostile(channels(short), text))))
    harmless, poisoned = pages
    assert len(harmless.seen) > 200 and len(harmless.scripts) == 2
    assert poisoned.seen == harmless.seen
    assert len(poisoned.scripts) == 2 and "alert" not in poisoned.scripts[1] and "<" not in poisoned.scripts[0]
    assert json.loads(poisoned.scripts[0].strip()) == json.loads(harmless.scripts[0].strip()) | {"note": POISON}


def test_the_made_up_result_of_another_program_has_a_page(tmp_path):
    """Nothing but a time and a channel: what is not there is said, not raised."""
    data = {"time": np.array([0.0, 1e-3]), "ring.y": np.array([0.0, 1e-6])}
    page = render(Result(data=data, units={"time": "s", "ring.y": "m"}, parameters={}))
    assert "not recorded" in page


def test_a_missing_fmu_names_those_of_its_folder(tmp_path):
    """The nearest name, else all, else nothing."""
    with pytest.raises(UserError, match="no such FMU$"):
        Model(tmp_path / "ribbon.fmu")
    (tmp_path / "ribbon-ribbon.fmu").touch()
    with pytest.raises(UserError, match=r'did you mean ".*ribbon-ribbon\.fmu"'):
        Model(tmp_path / "ribbon.fmu")
    with pytest.raises(UserError, match=r"the folder has ribbon-ribbon\.fmu"):
        Model(tmp_path / "6207.fmu")
