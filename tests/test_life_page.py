"""docs/life.md: its files and commands do what the page says."""

import json
import re
import shlex
from pathlib import Path

import pytest
from commands import run_in_shell

from riveted_bearing.base.toml_files import read_toml
from riveted_bearing.design.optimize import plan_optimize
from riveted_bearing.design.sensitivity import plan_sensitivity
from riveted_bearing.duty.mission import load_mission
from riveted_bearing.duty.tolerances import read_tolerances
from riveted_bearing.running.fmu import Model

ROOT = Path(__file__).parents[1]
PAGE = (ROOT / "docs" / "life.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```(\w+)\n(.*?)^```", PAGE, re.S | re.M)
FILES = {re.match(r"# (\S+)", text)[1]: text for language, text in BLOCKS if language in ("toml", "csv")}
OWN = ("life", "sensitivity", "optimize")  # the others need FMUs and results of other commands
COMMANDS = [
    line for language, text in BLOCKS if language == "sh" for line in text.splitlines() if line.split()[1] in OWN
]


@pytest.fixture
def folder(laid):
    return laid(FILES)


def test_files_can_be_read(folder):
    """Every file of the page by the reader of its command."""
    model = Model()
    readers = {
        "life": lambda path: read_tolerances(load_mission(path, model), model),
        "sensitivity": lambda path: plan_sensitivity(path, read_toml(path), model),
        "optimize": lambda path: plan_optimize(path, read_toml(path), model),
    }
    for line in COMMANDS:
        _, name, path = shlex.split(line)
        readers[name](Path(path))
    assert {line.split()[2] for line in COMMANDS} == {name for name in FILES if name.endswith(".toml")}


def test_the_strike_of_the_page_counts_with_any_fmu(folder, monkeypatch):
    """A bearing that settles in 1 s, beyond the usual t_end: the strike lies 10 ms behind it."""
    default = Model.default
    monkeypatch.setattr(Model, "default", lambda self, v: 1.0 if v.name == "start.settle" else default(self, v))
    mission = load_mission(Path("spindle.toml"), Model())
    strike = mission.parts[-1].scene
    assert strike.inputs["impact.F_r"].t[0] == pytest.approx(1.01) and strike.t_end == 2.0 and not mission.warnings


@pytest.mark.slow
@pytest.mark.parametrize("line", COMMANDS)
def test_commands_do_what_the_page_says(folder, line):
    """Each command in its own folder: the files that the page names are there.  A quarter of a minute each."""
    _, name, path = shlex.split(line)
    run_in_shell(line)
    made = folder / "results" / Path(path).stem
    expected = {
        "life": ("life.json", "life.html", "life.png", "runs.parquet"),
        "sensitivity": ("sensitivity.json",),
        "optimize": ("optimize.json", "optimize.png"),
    }
    for file in expected[name] + (("bearings.json", "weibull.png") if path == "tolerance.toml" else ()):
        assert (made / file).is_file(), file
    if name == "life":
        found = json.loads((made / "life.json").read_text())
        assert 0.0 < found["low_h"] <= found["life_h"] <= found["high_h"]
