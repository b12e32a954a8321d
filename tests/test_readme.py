"""The README's names exist, its files exist, its example runs."""

import re
from pathlib import Path

import pytest

from bearing_model.generated import variables

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text()


def symbol_names():
    table = README.split("### Symbols")[1].split("## ")[0]
    return sorted(
        {
            name
            for line in table.splitlines()
            if line.startswith("| $")
            for name in re.findall(r"`([^`]+)`", line.split("|")[2])
        }
    )


@pytest.mark.parametrize("name", symbol_names())
def test_symbol_is_a_variable(name):
    known = variables.INPUTS | variables.PARAMETERS | variables.OUTPUTS
    assert name in known


@pytest.mark.parametrize("element", sorted(set(re.findall(r"\| `([a-z_]+)`(?:, `([a-z_]+)`)? \|$", README, re.M))))
def test_element_has_its_file(element):
    for name in filter(None, element):
        assert any((ROOT / "fmu_src").rglob(f"{name}.[ch]"))


@pytest.mark.parametrize("path", re.findall(r"\]\(([^)]+)\)", README))
def test_linked_file_exists(path):
    assert (ROOT / path.partition("#")[0]).exists()


def test_verdicts_are_the_studys():
    sentence = re.search(r"Of \d+ claims .*? not\b", (ROOT / "docs" / "paper.md").read_text())[0]
    assert sentence in README


def test_example_runs(monkeypatch, capsys):
    pytest.importorskip("fmpy")
    if not (ROOT / "fmus" / "RivetedBearing.fmu").exists():
        pytest.skip("the FMU is not built: make build")
    monkeypatch.chdir(ROOT)
    example = README.split("```python\n")[1].split("```")[0]
    exec(compile(example.replace("stop_time=0.1", "stop_time=0.01"), "README.md", "exec"), {})
    found = int(re.search(r"(\d+) MPa", capsys.readouterr().out).group(1))
    assert 40 < found < 600  # 30 N of preload alone: 72 MPa in the head; impacts and the centrifugal load: 420 MPa
