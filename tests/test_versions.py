"""What a version promises (VERSIONING.md): one version everywhere, and the program that measures which number must
rise.
"""

import re
import subprocess
import sys
import tomllib

import numpy as np
import pytest
import yaml
from attr import evolve
from library import ROOT

sys.path.insert(0, str(ROOT / "benchmarks"))

import versions
from versions import MAJOR, MINOR, PATCH


def test_one_version():
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text())
    number, date = re.search(r"^## (\S+) \((.*)\)$", (ROOT / "CHANGELOG.md").read_text(), re.M).groups()
    assert citation["version"] == number == tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["version"]
    assert str(citation.get("date-released", "not released")) == date


def test_one_address():
    """Other files that name the project's address would be forgotten when it changes."""
    address = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["urls"]["Repository"]
    assert yaml.safe_load((ROOT / "CITATION.cff").read_text())["repository-code"] == address
    said = subprocess.run(["git", "grep", "-l", address], cwd=ROOT, capture_output=True, text=True, check=False)
    assert set(said.stdout.split()) <= {"pyproject.toml", "CITATION.cff"}


@pytest.fixture(scope="module")
def known(fmu):
    return versions.variables(fmu)


def changed(known, name, **changes):
    return known | {name: evolve(known[name], **changes)}


def test_same_variables_ask_for_a_patch(known):
    assert versions.compare_variables(known, dict(known)) == (PATCH, [])


@pytest.mark.parametrize(
    ("name", "changes"),
    [
        ("joint.preload", {"start": "21.0"}),
        ("joint.preload", {"max": "1.0"}),
        ("joint.preload", {"unit": "kN"}),
        ("ball[3].Q_i", {"valueReference": 1}),
        ("cage.omega", {"causality": "local"}),
    ],
)
def test_broken_promise_asks_for_a_major_version(known, name, changes):
    number, lines = versions.compare_variables(known, changed(known, name, **changes))
    assert number == MAJOR
    assert len(lines) == 1 and lines[0].startswith(name)


def test_lost_and_new_variables(known):
    fewer = {name: v for name, v in known.items() if name != "cage.omega"}
    assert versions.compare_variables(known, fewer) == (MAJOR, ["cage.omega: gone"])
    assert versions.compare_variables(fewer, known) == (MINOR, ["cage.omega: new"])


def test_wider_limits_and_words_ask_for_a_patch(known):
    wider = changed(known, "joint.preload", max="1e9", description="Preload")
    assert versions.compare_variables(known, wider) == (PATCH, [])


def test_items_of_enumerations(known):
    """Items keep their numbers; new ones come last."""
    variable = known["solver.method"]
    first, *others = variable.declaredType.items
    numbered = [evolve(item, value=str(number)) for number, item in enumerate([*others, first], start=1)]
    swapped = evolve(variable, declaredType=evolve(variable.declaredType, items=numbered))
    assert versions.compare_variables(known, known | {"solver.method": swapped})[0] == MAJOR
    fewer = evolve(variable, declaredType=evolve(variable.declaredType, items=[first]))
    assert versions.compare_variables(known | {"solver.method": fewer}, known)[0] == MINOR


def test_bits_of_a_short_run(fmu, known):
    """The same FMU gives the same digest twice; another output another one."""
    outputs = ["ring.y", "cage.omega"]
    assert versions.compare_bits((fmu, fmu), "demo", outputs, 1e-3)[0] == PATCH
    assert versions.digest(fmu, "demo", outputs, 1e-3) != versions.digest(fmu, "demo", outputs[::-1], 1e-3)


def test_statistics_of_known_samples():
    """48 seeds that scatter by 1 %: half-width 1.986 * 1 % * sqrt(2/48) = 0.41 %, so a shift of 2 % is found and one of
    0.5 % is none.
    """
    random = np.random.default_rng(1)
    before, noise = (100.0 * (1.0 + 0.01 * random.standard_normal((48, 9))) for _ in range(2))
    assert versions.compare_statistics(before, before)[0] == PATCH
    for shift, number in ((0.005, MINOR), (-0.005, MINOR), (0.02, MAJOR), (-0.02, MAJOR)):
        found, difference, width = versions.compare_statistics(before, noise * (1.0 + shift))
        assert found == number
        # of a standard deviation from 48 values, mean of 18: 2.4 %; observed -4 %
        assert width.mean() == pytest.approx(0.0041, rel=0.1)
        # three times 1 % sqrt(2/48) / sqrt(9); observed 0.0003
        assert difference.mean() == pytest.approx(shift, abs=0.002)
