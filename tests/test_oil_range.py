"""life --oil-range: both ends of the filling, what is simulated for them, refusals and words."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from riveted_bearing import UserError
from riveted_bearing.duty.mission import plan_mission
from riveted_bearing.duty.notes import oil_in_pockets
from riveted_bearing.duty.oil_range import FILLING, has_filling, plan_ends
from riveted_bearing.running.fmu import Model

ROOT = Path(__file__).resolve().parents[1]
POINT = {"simulation": {"t_end": 0.01}, "parameters": {"start.settle": 0.002}, "point": [{"hours": 1}]}
MISSION = """scene = "demo"
[simulation]
t_end = 0.09
[parameters]
start.settle = 0.02
[[point]]
hours = 1
[life]
min_seeds = 3
max_seeds = 3
"""


@pytest.fixture(scope="module")
def model():
    return Model()


def mission(model, **document):
    return plan_mission("trial", POINT | document, model, Path("trial.toml"))


def test_both_ends_are_the_mission_with_another_filling(model):
    """Also beside a parameter in a nested table, over a value of the mission and over that of a scene."""
    nested = {"start": {"settle": 0.002}, "cage": {"pocket_filling": 0.3, "mu": 0.04}}
    for plan in (mission(model), mission(model, parameters=nested), mission(model, scene="paper")):
        ends = plan_ends(plan, model)
        assert list(ends) == ["dry", "flooded"]
        for end, filling in (("dry", 0.0), ("flooded", 1.0)):
            (case,) = ends[end].cases
            assert case.scene.parameters[FILLING] == filling
            rest = {name: value for name, value in case.scene.parameters.items() if name != FILLING}
            assert rest == {name: v for name, v in plan.cases[0].scene.parameters.items() if name != FILLING}
            assert has_filling(ends[end], model, filling) and not has_filling(ends[end], model, 1.0 - filling)
    assert has_filling(mission(model), model, 0.0)  # the FMU's own pockets are dry
    assert not has_filling(mission(model, parameters=nested), model, 0.0)


@pytest.mark.parametrize(
    "document",
    [
        {"point": [{"hours": 1, "parameters": {"cage": {"pocket_filling": 0.2}}}]},
        {"event": [{"count": 1, "parameters": {FILLING: 0.2}}]},
        {"point": [{"hours": 2}], "change": [{"at": "1 h", "cage": {"pocket_filling": 0.5}}]},
    ],
    ids=["point", "event", "change"],
)
def test_a_filling_of_its_own_is_refused(model, document):
    plan = mission(model, **document)
    with pytest.raises(UserError, match=r"trial.toml: a point sets cage.pocket_filling; --oil-range computes dry"):
        plan_ends(plan, model)


def test_the_filling_is_named(model):
    assert "is assumed" in oil_in_pockets(mission(model), model) and "--oil-range" in oil_in_pockets(
        mission(model), model
    )
    given = mission(model, parameters={"start.settle": 0.002, FILLING: 0.3})
    assert oil_in_pockets(given, model) == "Oil in the pockets: cage.pocket_filling = 0.3 (0 dry, 1 flooded)."


def test_the_command(tmp_path):
    """Both lives on the terminal, in files and on the page; the dry one, which is the mission's own, is not run twice, and
    flooded pockets live longer by far.
    """
    (tmp_path / "trial.toml").write_text(MISSION)
    line = [sys.executable, "-m", "riveted_bearing", "life", "trial.toml", "--oil-range", "--workers", "1"]
    done = subprocess.run(
        line, cwd=tmp_path, env=os.environ | {"PYTHONPATH": str(ROOT)}, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert "Life, dry" in done.stdout and "Life, flooded" in done.stdout and "is assumed" in done.stdout
    folder = tmp_path / "results" / "trial"
    ends = json.loads((folder / "oil_range.json").read_text())
    own, flooded = (json.loads((place / "life.json").read_text()) for place in (folder, folder / "flooded"))
    assert ends["dry"]["life_h"] == own["life_h"] and ends["flooded"]["life_h"] == flooded["life_h"]
    assert (ends["dry"]["filling"], ends["flooded"]["filling"]) == (0.0, 1.0)
    assert not (folder / "dry").exists()
    assert flooded["life_h"] > 3.0 * own["life_h"]
    assert "with flooded pockets" in (folder / "life.html").read_text()
