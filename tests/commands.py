"""Commands as a user starts them."""

import os
import shlex
import subprocess
import sys
import time
from pathlib import Path

from typer.testing import CliRunner

from riveted_bearing.cli import program


def command(*arguments, folder):
    """The program as a user starts it, its output in pipes."""
    return subprocess.run(
        [sys.executable, "-m", "riveted_bearing", *map(str, arguments)],
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=1800,
        check=False,
    )


def begun(*arguments, folder):
    """The program as a process with a group of its own, which a signal reaches as a terminal's does."""
    return subprocess.Popen(
        [sys.executable, "-m", "riveted_bearing", *map(str, arguments)],
        cwd=folder,
        env=os.environ | {"PYTHONPATH": str(Path(__file__).parents[1])},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


def stopped_after_a_row(process, folder, kind):
    """Send a signal to all processes of a sweep once its folder has a row; output, messages and exit code."""
    patience = time.monotonic() + 300.0
    while not rows_kept(folder) and time.monotonic() < patience:
        time.sleep(0.02)
    os.killpg(process.pid, kind)
    return finished(process)


def finished(process):
    """Output, messages and exit code."""
    out, err = process.communicate(timeout=600)
    return out, err, process.returncode


def typed(line, *words, **options):
    """The Result of a command as typed, run in this process; words: further ones, such as paths."""
    return CliRunner().invoke(program, [*shlex.split(line), *map(str, words)], **options)


def run_in_shell(line):
    """A command as typed, with this Python's program of the checkout."""
    name, *arguments = shlex.split(line)
    module = ["-m", "riveted_bearing"] if name == "riveted-bearing" else []
    done = subprocess.run(
        [sys.executable, *module, *arguments], capture_output=True, text=True, timeout=1800, check=False
    )
    assert done.returncode == 0, f"{line}\n{done.stdout}\n{done.stderr}"


def rows_kept(folder):
    """Whether a running sweep has kept a row: SQLite's log then holds more than the empty table."""
    log = folder / "_rows.sqlite-wal"
    return log.is_file() and log.stat().st_size > 20_000
