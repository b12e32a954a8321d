"""Changes and breaks of a run, as the program and the report say them."""

import re
from dataclasses import replace
from pathlib import Path

import pytest

from riveted_bearing import run
from riveted_bearing.running.in_run import alone_note, break_lines, change_lines
from riveted_bearing.running.summary import breaks
from riveted_bearing.show.report import render, setting_rows

PAGE = Path(__file__).parents[1] / "docs" / "coupling.md"
RIGID = {"scene.cage": "two_half", "start.settle": 0.0}


def test_the_program_and_the_report_say_what_changed(tmp_path):
    """One line for each time in units that people read, none for a time after the end; the table of the report has the
    first value and those after it.
    """
    path = tmp_path / "changing.toml"
    path.write_text(
        '[simulation]\nt_end = "2 ms"\n[[change]]\nat = "1 ms"\njoint.preload = "35 N"\njoint.mu = 0.3\nscene.growth = "off"\n'
        '"rivet[2].intact" = 0\n[[change]]\nat = "3 ms"\njoint.mu = 0.1\n'
    )
    result = run(path, parameters=RIGID)
    assert change_lines(result) == ["at 1 ms: joint.preload 35 N, joint.mu 0.3, scene.growth off, rivet[2].intact 0"]
    rows = {name: (value, differs) for name, _, value, _, differs in setting_rows(result)}
    assert rows["joint.preload"] == ("20; 35 from 1 ms", True) and rows["joint.mu"] == ("0.15; 0.3 from 1 ms", True)
    assert rows["scene.growth"] == ("on; off from 1 ms", True) and rows["rivet[2].intact"] == ("1; 0 from 1 ms", True)
    assert rows["rivet[3].intact"] == ("1", False)
    assert "Changed at 1 ms: joint.preload 35 N, joint.mu 0.3" in render(result)
    unchanged = replace(result, about=result.about | {"changes": {}})
    assert change_lines(unchanged) == [] and "Changed at" not in render(unchanged)


def test_the_rivet_of_the_page_breaks(tmp_path):
    """The block of docs/coupling.md: the rivet that the page names, in the times that twelve seeds have, a quarter wider (a chaotic run's
    time of damage changes with rounding).
    """
    text = PAGE.read_text()
    scene = re.search(r"## Rivets that break\n\n```toml\n(.*?)```", text, re.S)[1]
    (tmp_path / "breaks.toml").write_text(scene)
    result = run(tmp_path / "breaks.toml")
    (k, place, first), *others = breaks(result)
    low, high, apart = re.search(
        rf"rivet {k} breaks first, after ([\d.]+) to ([\d.]+) s .*? the others within (\d+) ms", " ".join(text.split())
    ).groups()
    assert 0.75 * float(low) < first < 1.25 * float(high)
    assert len(others) == 8 and others[-1][2] - first < 1.25e-3 * float(apart)
    assert break_lines(result)[0] == f"rivet 3 broke in the {place} at {1e3 * first:.4g} ms"


def test_a_run_without_a_break_says_how_near_it_was():
    on = RIGID | {"scene.breakage": "on", "scene.stress": "fatigue"}
    result = run(None, t_end=2e-3, parameters=on)
    damaged = replace(result, summary=result.summary | {"rivet[3].damage_head": 0.78, "rivet[4].damage_mid": 0.5})
    assert break_lines(damaged) == ["no rivet broke; largest damage 0.78, rivet 3 head"]
    assert break_lines(replace(damaged, parameters=result.parameters | {"scene.breakage": "off"})) == []


@pytest.mark.parametrize(("rivets", "gone"), [(range(1, 10), True), (range(1, 9), False)])
def test_a_cage_without_rivets_is_said(rivets, gone):
    """The run goes on with breakage off; with the last rivet in place there is no note."""
    result = run(None, t_end=1e-3, parameters=RIGID | {f"rivet[{k}].intact": 0 for k in rivets})
    assert not result.stopped and bool(alone_note(result)) == gone
