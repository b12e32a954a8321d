"""The user's guide and the page on an own bearing: their files, commands and examples do what they say."""

import re
import runpy
from pathlib import Path

import pytest
from commands import run_in_shell

from bearing_model.generated import variables
from riveted_bearing import run
from riveted_bearing.bearing.bearing_file import bearing_case
from riveted_bearing.running.fmu import Model
from riveted_bearing.running.scene import load_scene

ROOT = Path(__file__).parents[1]
GUIDE = (ROOT / "docs" / "guide.md").read_text(encoding="utf-8")
OWN = (ROOT / "docs" / "own_bearing.md").read_text(encoding="utf-8")
BLOCKS = [
    block for page in (GUIDE, OWN) for block in re.findall(r"^```(\w+)\n(.*?)^```", page, re.S | re.M)
]  # (language, text)
FILES = {found[1]: text for language, text in BLOCKS if language == "toml" and (found := re.match(r"# (\S+)", text))}
PARTS = [text for language, text in BLOCKS if language == "toml" and not text.startswith("#")]  # of bearing files
KNOWN = variables.INPUTS | variables.PARAMETERS | variables.OUTPUTS


@pytest.fixture
def folder(laid):
    return laid(FILES)


def test_files_can_be_read(folder):
    """Every TOML file of the guide, by the reader that it is for; what is forgotten here fails."""
    model = Model()
    readers = {
        "runup.toml": lambda path: load_scene(path, model),
        "mine.toml": lambda path: bearing_case(path).equilibrium(),
        "rivet.toml": lambda path: None,  # read by rivet_model.build, in test_the_whole_guide
    }
    assert set(FILES) == set(readers)
    for name, read in readers.items():
        read(Path(name))
    assert PARTS
    for text in PARTS:
        Path("part.toml").write_text(f'designation = "6309"\n{text}', encoding="utf-8")
        bearing_case("part.toml")


def test_names_of_the_stress_table_are_outputs():
    table = GUIDE.split("## Reading the stress\n\n")[1].split("\n\n")[0]
    names = [name for name in re.findall(r"`((?:rivet|stat)[^`]*)`", table) if "..." not in name]
    assert len(names) >= 9
    assert all(name in KNOWN for name in names)


def test_python_examples_run(folder, capsys):
    """The scene; 40 N of preload alone give 96 MPa in the head."""
    examples = [text for language, text in BLOCKS if language == "python"]
    assert len(examples) == 1
    for text in examples:
        exec(compile(text, "guide.md", "exec"), {"__name__": "guide"})
    assert_stresses(capsys.readouterr().out, lines=1, stresses=2)


@pytest.mark.parametrize("column", [0, 1], ids=["elastic", "two_half"])
def test_figures_of_the_page(column, fmu):
    """Stored numbers, which guard against a page that nobody measured again: means of four seeds within 4 %, quantiles
    within 8 %, three times what sixteen seeds and these scatter.
    """
    rows = [
        re.search(rf"^\| {name}, mean / RMS / 99.9 %, \S+ \| (.*) \|$", GUIDE, re.M)[1]
        for name in ("pocket force", "head stress")
    ]
    page = [float(number) for row in rows for number in row.split(" | ")[column].split(" / ")]
    names = [f"stat.{of}_{kind}" for of in ("Q_c", "sigma_head") for kind in ("mean", "rms", "p999")]
    cage = {"scene.cage": ("elastic", "two_half")[column]}
    found = [
        run(None, fmu=fmu, parameters=cage, seed=seed, t_end=0.4, outputs=["ring.y"]).summary for seed in range(1, 5)
    ]
    for name, shown in zip(names, page, strict=True):
        scale = 1e-6 if "sigma" in name else 1.0
        mean = scale * sum(summary[name] for summary in found) / len(found)
        assert mean == pytest.approx(shown, rel=0.08 if "p999" in name else 0.04), name


def test_two_bearings_of_a_spindle_as_an_ssp(folder, capsys):
    runpy.run_path(str(ROOT / "examples" / "spindle" / "two_bearings.py"))["main"]([])
    assert_stresses(capsys.readouterr().out, lines=1, stresses=2)
    assert Path("spindle.ssp").is_file()


def assert_stresses(printed, lines, stresses):
    found = [int(text) for text in re.findall(r"(\d+) MPa", printed)]
    assert len(printed.splitlines()) == lines and len(found) == stresses
    assert all(40 < stress < 900 for stress in found)  # 730 MPa the largest, with the centrifugal load


@pytest.mark.slow
def test_the_whole_guide(folder):
    """All blocks in the order of the pages: what the commands promise is there afterwards.  Minutes, most of it the
    builds and their rivet tables.
    """
    for language, text in BLOCKS:
        if language == "sh":
            for line in text.splitlines():
                run_in_shell(line)
        elif language == "python":
            exec(compile(text, "guide.md", "exec"), {"__name__": "guide"})
    results = {path.name for path in (folder / "results").iterdir()}
    assert {"demo.html", "demo.png", "runup.html", "preload40.html", "softer.parquet", "demo_compare.png"} <= results
