"""What a new user does first: an own FMU without a scene, a scene of another bearing, names of variables, the version."""

import os
import re
import subprocess
import sys
import time
import tomllib
import zipfile
from pathlib import Path

import numpy as np
import pytest
from commands import typed

from bearing_model.generated.variables import ESSENTIALS
from rivet_model.half_modes import default_count
from riveted_bearing import __version__, run
from riveted_bearing.base.variable_list import essentials, matching
from riveted_bearing.cli.terminal import FULL
from riveted_bearing.running.fmu import Model
from riveted_bearing.running.results import Result
from riveted_bearing.running.scene import load_scene
from riveted_bearing.running.summary import settle_note

ROOT = Path(__file__).resolve().parents[1]


def test_without_a_scene_the_fmu_has_its_own_working_point(own):
    model = Model(own)
    scene = load_scene(None, model, ("the command line", {"simulation": {"t_end": "1 ms"}}))
    assert scene.name == "mine" and scene.inputs == {} and scene.parameters == {"scene.statistics": "on"}
    assert scene.t_end == 1e-3
    assert scene.description == "own working point of mine.fmu, F_y 4100 N, F_x 515 N, omega 18238 rev/min"
    assert scene.replaced == ()


def test_a_run_without_a_scene(fmu):
    result = run(None, fmu=fmu, t_end=2e-4)
    assert result.data["shaft.F_y"][-1] == 2994.0 and result.about["scene"] == "RivetedBearing"


def test_a_scene_says_what_it_replaces(own, fmu):
    """The scene demo sets load and speed; its speed is the FMU's own.  A load of the command line is the user's, not
    the scene's.
    """
    assert load_scene("demo", Model(own)).replaced == ("shaft.F_y 2994 N for 4100 N",)
    assert load_scene("demo", Model(own), ("the command line", {"inputs": {"shaft.F_y": 1000.0}})).replaced == ()
    assert load_scene("demo", Model(fmu)).replaced == ()


def test_a_scene_of_the_user_replaces_values_of_the_default_fmu_too(fmu, tmp_path):
    """In the unit of the scene; a history by its range; how to simulate is no value of the bearing."""
    path = tmp_path / "mine.toml"
    path.write_text("""[parameters]
joint.preload = "3 kgf"
joint.mu = 0.15
start.settle = "10 ms"
[inputs]
shaft.F_y = "3 kN"
shaft.omega = { t = [0, 1], value = [3000, 12000], unit = "rev/min" }
""")
    expected = (
        "joint.preload 3 kgf for 2.0394 kgf",
        "shaft.F_y 3 kN for 2.994 kN",
        "shaft.omega 3000 to 12000 rev/min for 18238 rev/min",
    )
    assert load_scene(path, Model(fmu)).replaced == expected


def test_the_essential_variables(fmu):
    listed = [variable.name for group in essentials().values() for variable in group]
    assert listed == [name for names in ESSENTIALS.values() for name in names] and 35 <= len(listed) <= 45
    done = typed("variables")
    assert done.exit_code == 0 and all(name in done.stdout for name in listed)
    with zipfile.ZipFile(fmu) as archive:
        page = archive.read("documentation/index.html").decode()
    assert page.index('<h2 id="essentials">') < page.index('<h2 id="use">')
    assert all(f"<code>{name}</code>" in page.split('<h2 id="use">')[0] for name in listed)


@pytest.mark.parametrize(
    ("pattern", "some"),
    [
        ("slip", {"cage.slip_ratio", "rivet[k].slip"}),
        ("ball[3].Q_i", {"ball[j].Q_i"}),
        ("rivet[*].sigma_*", {"rivet[k].sigma_head", "rivet[k].sigma_mid_peak"}),
        ("VISCOSITY", {"oil.eta"}),
    ],
)
def test_variables_by_pattern(pattern, some):
    found = {variable.name for group in matching(pattern).values() for variable in group}
    assert some <= found and len(found) < 12


def test_variables_have_unit_and_limits(own):
    line = next(
        line for line in typed("variables shaft.F_y --fmu", own).stdout.splitlines() if line.startswith("shaft.F_y")
    )
    assert re.split(r"\s{1,}", line)[:7] == ["shaft.F_y", "input", "N", "4100", "-100000", "...", "100000"]


def test_the_version():
    done = typed("--version")
    assert done.exit_code == 0 and done.stdout.startswith(f"riveted-bearing {__version__}, Python 3")


LEAN = """
import sys

for name in {libraries!r}:
    sys.modules[name] = None  # as if it were not installed
from riveted_bearing.cli import program

program(sys.argv[1:])
"""


def test_an_installation_to_simulate_needs_few_libraries(fmu, tmp_path):
    """Without the libraries of the extra full a run writes CSV and says so; other commands name what they lack."""
    script = tmp_path / "lean.py"
    script.write_text(LEAN.format(libraries=(*FULL, "pandas", "markdown_it", "latex2mathml")))
    environment = os.environ | {"PYTHONPATH": str(ROOT)}

    def done(*arguments):
        words = [sys.executable, str(script), *arguments]
        return subprocess.run(words, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)

    ran = done("run", "demo", "--fmu", str(fmu), "--t-end", "2 ms")
    assert ran.returncode == 0 and (tmp_path / "results" / "demo.csv").is_file(), ran.stderr
    assert "without pyarrow Parquet is left out" in ran.stderr and "without matplotlib the picture" in ran.stderr
    assert done("variables", "joint.preload").returncode == 0
    for words, library in ((("info", "6309"), "scipy"), (("report", "results/demo.csv"), "matplotlib")):
        refused = done(*words)
        assert refused.returncode == 2 and f"needs {library}" in refused.stderr and "[full]" in refused.stderr
        assert "Traceback" not in refused.stderr


def test_the_libraries_of_a_run_are_the_few(fmu):
    """What pyproject.toml requires without an extra is what the test above leaves."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    names = [re.match(r"[\w-]+", text)[0] for text in project["dependencies"]]
    assert names == ["fmpy", "numpy", "pydantic", "typer", "rich"]
    full = {re.match(r"[\w-]+", text)[0] for text in project["optional-dependencies"]["build"]}
    assert {{"skfem": "scikit-fem", "distributed": "dask"}.get(name, name) for name in FULL} <= full


def test_the_cookbook_comes_with_the_program():
    """The pages of docs/, as files for a pipe; the wheel has them in _source/docs (cmake/fmu.cmake)."""
    assert typed("cookbook").stdout == (ROOT / "docs" / "cookbook.md").read_text(encoding="utf-8")
    listed = typed("cookbook list").stdout.splitlines()
    assert {line.split()[0] for line in listed} == {path.stem for path in (ROOT / "docs").glob("*.md")}
    refused = typed("cookbook coupler")
    assert refused.exit_code == 2 and 'did you mean "coupling"' in refused.output
    assert "fmu_src fmus docs DESTINATION" in (ROOT / "cmake" / "fmu.cmake").read_text()


HOOKS = """
import sys
sys.modules["scikit_build_core"] = None  # not installed yet
import backend
print(all(hasattr(backend, f"build_{kind}") for kind in ("wheel", "sdist", "editable")), hasattr(backend, "other"))
print(backend.get_requires_for_build_editable())
"""


def test_pip_may_ask_for_hooks_before_it_installs_their_library():
    """`pip install -e .` asks for build_editable first, in an environment that has nothing (PEP 660)."""
    words = [sys.executable, "-I", "-c", f"import sys; sys.path.insert(0, {str(ROOT / 'cmake')!r})\n{HOOKS}"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.returncode == 0 and done.stdout.splitlines() == ["True False", "['scikit-build-core>=0.11']"], (
        done.stderr
    )


def test_every_extra_that_is_named_exists():
    """In pages, messages and scripts."""
    extras = set(tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["optional-dependencies"])
    files = [*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md"), *ROOT.glob("examples/**/*.*py*"), *ROOT.glob("tests/*.py")]
    files += [*ROOT.glob("riveted_bearing/**/*.py"), ROOT / "Makefile", ROOT / ".ci" / "environment"]
    named = set()
    for file in files:
        text = file.read_text(encoding="utf-8")
        for found in re.findall(r"(?:\s|\"|')\.\[([\w,]+)\]|whl\[([\w,]+)\]|\bextra\(['\"](\w+)['\"]\)", text):
            named |= set("".join(found).split(","))
    assert {"full", "cross", "notebook"} <= named <= extras, named - extras


@pytest.mark.skipif(sys.platform != "linux" or os.geteuid() != 0, reason="root makes a system on Linux")
def test_the_check_on_a_bare_machine_ends_when_it_is_told_to(tmp_path):
    """SIGTERM while a command runs that hears none: the script ends, the command and its children too."""
    (tmp_path / "bin").mkdir()
    (tmp_path / "left").mkdir()
    fake = tmp_path / "bin" / "debootstrap"
    fake.write_text(
        f"#!/bin/sh\ntrap '' TERM\ntouch {tmp_path}/begun\n(sleep 4; touch {tmp_path}/survived) &\nsleep 4\nsleep 60\n"
    )
    fake.chmod(0o755)
    environment = os.environ | {"PATH": f"{tmp_path}/bin:{os.environ['PATH']}", "TMPDIR": str(tmp_path / "left")}
    told = subprocess.Popen(["sh", ROOT / ".ci" / "bare", "13"], env=environment)
    try:
        end = time.monotonic() + 60.0
        while not (tmp_path / "begun").exists() and told.poll() is None and time.monotonic() < end:
            time.sleep(0.05)
        if told.poll() is not None:
            pytest.skip("this machine makes no namespaces")
        told.terminate()
        assert told.wait(timeout=3.0) == 1
    finally:
        told.kill()
    time.sleep(4.5)
    assert not (tmp_path / "survived").exists() and not list((tmp_path / "left").iterdir())


@pytest.mark.parametrize(("turns", "told"), [(9.0, True), (9.97, False), (10.0 - 1e-12, False)])
def test_ten_revolutions_are_ten(turns, told):
    """What rounds to the number that the note asks for is not told to reach it."""
    parameters = {"start.settle": 0.05}
    late = Result(
        {"time": np.array([0.0, 1.0])}, {}, parameters, about={"settle_turns": turns, "count_turns": 2 * turns}
    )
    assert ("leaves out 10 revolutions" in settle_note(late)) == told


def test_help_says_what_the_program_does():
    """Five modes a ball; two numbers behind --band."""
    modes = typed("build --help", env={"COLUMNS": "200"}, terminal_width=200).output
    assert default_count(8) == default_count(9) == 40 and "about 5 a ball, 40 for 8 or 9" in " ".join(modes.split())
    assert "LOW HIGH" in typed("spectrum --help", terminal_width=200).output
