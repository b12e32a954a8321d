"""Commands as a user starts them."""

import shlex
import subprocess
import sys


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


def run_in_shell(line):
    """A command as typed, with this Python's program of the checkout."""
    program, *arguments = shlex.split(line)
    module = ["-m", "riveted_bearing"] if program == "riveted-bearing" else []
    done = subprocess.run(
        [sys.executable, *module, *arguments], capture_output=True, text=True, timeout=1800, check=False
    )
    assert done.returncode == 0, f"{line}\n{done.stdout}\n{done.stderr}"


def rows_kept(folder):
    """Whether a running sweep has kept a row: SQLite's log then holds more than the empty table."""
    log = folder / "_rows.sqlite-wal"
    return log.is_file() and log.stat().st_size > 20_000
