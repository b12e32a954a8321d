"""The README's files exist and its example runs; the names and files in the tables of docs/physics.md exist."""

import re
from pathlib import Path

import pytest

from bearing_model.generated import variables

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
PHYSICS = (ROOT / "docs" / "physics.md").read_text(encoding="utf-8")


def rows(title):
    """The cells of a section's table."""
    section = PHYSICS.split(f"## {title}\n")[1].split("\n## ")[0]
    return [
        [cell.strip() for cell in line.strip("|").split(" | ")]
        for line in section.splitlines()
        if line.startswith("| ")
    ][1:]


def symbol_names():
    return sorted({name for row in rows("Symbols") for name in re.findall(r"`([^`]+)`", row[1])})


def element_files():
    return sorted(
        {
            name
            for title in ("The elements", "Integration")
            for row in rows(title)
            for name in re.findall(r"`([^`]+)`", row[2])
        }
    )


@pytest.mark.parametrize("name", symbol_names())
def test_symbol_is_a_variable(name):
    known = variables.INPUTS | variables.PARAMETERS | variables.OUTPUTS
    assert name in known


@pytest.mark.parametrize("element", element_files())
def test_element_has_its_file(element):
    assert any((ROOT / "fmu_src" / f"{element}.{ending}").exists() for ending in "ch")


def test_the_tables_are_found():
    assert len(symbol_names()) > 30 and len(element_files()) > 20


def test_verdicts_are_the_studys():
    """The counts of both columns, before links and line breaks."""
    sentence = re.search(
        r"Of the paper's \d+ claims .*?(?=\.\n)",
        (ROOT / "benchmarks" / "paper" / "paper.md").read_text(encoding="utf-8"),
    )[0]
    assert sentence in " ".join((ROOT / "docs" / "paper.md").read_text(encoding="utf-8").split())


def test_example_runs(monkeypatch, capsys):
    pytest.importorskip("fmpy")
    if not (ROOT / "fmus" / "RivetedBearing.fmu").exists():
        pytest.skip("the FMU is not built: make build")
    monkeypatch.chdir(ROOT)
    example = README.split("```python\n")[1].split("```")[0]
    exec(compile(example.replace("stop_time=0.1", "stop_time=0.01"), "README.md", "exec"), {})
    found = int(re.search(r"(\d+) MPa", capsys.readouterr().out).group(1))
    assert 40 < found < 600  # 30 N of preload alone: 72 MPa in the head; impacts and the centrifugal load: 420 MPa
