"""Ctrl-C at any moment: the program ends with one line, keeps what there is, and leaves no half file."""

import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import distributed
import pytest
from commands import begun, finished, stopped_after_a_row

from riveted_bearing import UserError, read_result, run
from riveted_bearing.base.interrupts import held_interrupts
from riveted_bearing.running.fmu import Model
from riveted_bearing.studies.rows import Store
from riveted_bearing.studies.sweep import cluster, run_sweep
from riveted_bearing.studies.sweep_file import load_sweep

ROOT = Path(__file__).resolve().parents[1]
LONG = ("run", "demo", "--t-end", "100 s")
SWEEP = 'scene = "demo"\nrepeats = 40\n[simulation]\nt_end = 0.2\n'

# A program that sends itself Ctrl-C when the function named on its command line is called, then goes on as the program
# would.
WITH_CTRL_C = """
import importlib, os, signal, sys
module, name, *arguments = sys.argv[1:]
where = importlib.import_module(module)
wrapped = getattr(where, name)
def sending(*given, **options):
    os.kill(os.getpid(), signal.SIGINT)
    return wrapped(*given, **options)
setattr(where, name, sending)
sys.argv = ["riveted-bearing", *arguments]
from riveted_bearing.__main__ import main
main()
"""


def interrupted_in(module, name, *arguments, folder):
    """The program, interrupted when it enters a function."""
    env = os.environ | {"PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-c", WITH_CTRL_C, module, name, *map(str, arguments)]
    return subprocess.run(command, cwd=folder, env=env, capture_output=True, text=True, timeout=120, check=False)


@pytest.mark.parametrize(
    ("module", "name"),
    [("riveted_bearing.running.scene", "read_toml"), ("riveted_bearing.running.fmu", "read_model_description")],
)
def test_before_the_first_step_nothing_is_left(tmp_path, module, name):
    done = interrupted_in(module, name, *LONG, "--out", tmp_path / "out", folder=tmp_path)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "interrupted: no file has changed\n")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("module", "name", "rows"),
    [
        ("riveted_bearing.running.fmu", "extract", 1),  # before the FMU is loaded
        ("riveted_bearing.running.runner", "march", 1),  # before the first step
        ("riveted_bearing.running.runner", "is_peak", 1),
    ],
)
def test_at_the_first_step_the_start_is_kept(tmp_path, module, name, rows):
    arguments = (*LONG, "--set", "start.settle=0", "--out", tmp_path) + (("--step", "1 ms") if name == "march" else ())
    if name == "is_peak":
        (tmp_path / "mine.toml").write_text(
            '[simulation]\nt_end = 100\nstep = 1e-3\noutput_interval = 1e-2\noutputs = ["ring.y"]'
        )
        arguments = ("run", "mine.toml", "--out", tmp_path)
    done = interrupted_in(module, name, *arguments, folder=tmp_path)
    assert done.returncode == 3 and "Traceback" not in done.stderr, done.stderr
    assert done.stderr.splitlines()[-1] == "stopped: interrupted after t = 0 s"
    (path,) = tmp_path.glob("*.parquet")
    assert len(read_result(path).data["time"]) == rows and path.with_suffix(".png").is_file()


@pytest.mark.parametrize(
    ("module", "name"),
    [("riveted_bearing.running.results", "write_parquet"), ("riveted_bearing.show.plot", "plot_result")],
)
def test_files_under_way_are_finished(tmp_path, module, name):
    """The dictionary WRITERS holds the function itself, so the interrupt comes in its first call of a library for
    Parquet.
    """
    target = ("pyarrow.parquet", "write_table") if name == "write_parquet" else (module, name)
    done = interrupted_in(*target, "run", "demo", "--t-end", "2 ms", "--out", tmp_path, folder=tmp_path)
    assert done.returncode == 0 and "Traceback" not in done.stderr, done.stderr
    assert sorted(path.name for path in tmp_path.iterdir()) == ["demo.parquet", "demo.png"]
    assert read_result(tmp_path / "demo.parquet").data["time"][-1] == 2e-3


def test_in_the_middle_of_a_run(tmp_path):
    """Ctrl-C as a terminal sends it, to all processes of the group."""
    process = begun(*LONG, "--no-plot", "--out", tmp_path, folder=tmp_path)
    time.sleep(6.0)
    os.killpg(process.pid, signal.SIGINT)
    _, errors, code = finished(process)
    assert "Traceback" not in errors
    if code in (130, -signal.SIGINT):  # on a busy machine still starting; shells show both as 130
        assert errors == "interrupted: no file has changed\n" and list(tmp_path.iterdir()) == []
        return
    said = re.search(r"stopped: interrupted after t = (\S+) s", errors)
    assert code == 3 and said, errors
    reached = float(said[1])
    assert read_result(tmp_path / "demo.parquet").data["time"][-1] == pytest.approx(reached, rel=1e-9)


def test_from_python_a_run_returns_what_there_is():
    def press(t):
        if t > 1e-3:
            os.kill(os.getpid(), signal.SIGINT)

    result = run("demo", t_end=10.0, progress=press)
    assert result.stopped.startswith("interrupted after t = ") and 1e-3 < result.data["time"][-1] < 10.0
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_held_interrupts_are_noted():
    with held_interrupts() as interrupts:
        os.kill(os.getpid(), signal.SIGINT)
        assert interrupts.pending
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)


# --------------------------------------------------------------------------------------------------------------- sweeps


@pytest.mark.skipif(not hasattr(signal, "pthread_sigmask"), reason="signals have no masks here")
def test_while_the_cluster_starts_it_waits(monkeypatch):
    """It is not lost: it ends the sweep as soon as the cluster can be closed.  Processes of the cluster do not see it."""
    asked = "import signal; print(signal.SIGINT in signal.pthread_sigmask(signal.SIG_BLOCK, []))"
    seen = []

    class Part:
        def __init__(self, *_, **options):
            seen.append(
                subprocess.run([sys.executable, "-c", asked], capture_output=True, text=True, check=True).stdout.strip()
            )
            os.kill(os.getpid(), signal.SIGINT)

        def close(self):
            seen.append("closed")

    monkeypatch.setattr(distributed, "LocalCluster", Part)
    monkeypatch.setattr(distributed, "Client", Part)
    with pytest.raises(KeyboardInterrupt), cluster(workers=1):
        raise AssertionError
    assert seen == ["True", "True", "closed", "closed"]
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    assert signal.SIGINT not in signal.pthread_sigmask(signal.SIG_BLOCK, [])


def test_a_sweep_says_what_is_kept(tmp_path):
    (tmp_path / "many.toml").write_text(SWEEP)
    process = begun("sweep", "many.toml", "--out", "rows", "--workers", "1", folder=tmp_path)
    output, errors, code = stopped_after_a_row(process, tmp_path / "rows", signal.SIGINT)
    assert (code, output) == (130, "")
    assert errors == "interrupted: finished runs are kept in rows; the same command does the others\n"
    assert {path.name for path in (tmp_path / "rows").iterdir()} == {"_rows.sqlite", "runs.parquet"}


def test_a_second_sweep_in_a_folder_is_refused(tmp_path):
    """Refused before it starts anything: it never asks its cluster, which is none here."""
    (tmp_path / "many.toml").write_text(SWEEP)
    plan = load_sweep(tmp_path / "many.toml", Model())
    with Store(tmp_path / "rows"), pytest.raises(UserError, match="rows: another sweep is writing to this folder"):
        run_sweep(plan, tmp_path / "rows", None)
    with Store(tmp_path / "rows"):  # free again
        pass
