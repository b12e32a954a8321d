"""What a user can get wrong: one line on stderr that names it, exit code 2, nothing left behind."""

import copy
import json
import math
import random
import shutil
import tomllib
from pathlib import Path

import pytest
from commands import typed

from riveted_bearing import UserError
from riveted_bearing.base.files import write_atomically
from riveted_bearing.base.toml_files import read_toml
from riveted_bearing.base.variable_list import is_like
from riveted_bearing.bearing.bearing_file import bearing_case
from riveted_bearing.cli import COMMANDS
from riveted_bearing.duty.mission import load_mission
from riveted_bearing.running.fmu import Model
from riveted_bearing.running.scene import load_scene
from riveted_bearing.studies.sweep_file import load_sweep

ROOT = Path(__file__).resolve().parents[1]
FILES = {
    "bad.toml": "not TOML at all",
    "seven.toml": "Z = 7\nbearing = 3",
    "unit.toml": '[parameters]\nbearing.D = "8 N"',
    "three.toml": "Z = 3",
    "crowded.toml": "Z = 20",
    "text.toml": 'fillet_radius = "0.3 mm"',
    "thick.toml": 'head_height = "1 parsec"',
    "nothing.toml": 'shank = "1.5 mm"',
    "count.toml": "Z = 9.5",
    "narrow.toml": 'cage_outer_diameter = "2.1 inch"',
    "scene.toml": '[inputs]\nshaft.F_y = "3 tons"',
    "key.toml": "[simulatoin]\nt_end = 1",
    "vary.toml": "[[vary]]\njoint.preload = []",
    "loads.csv": "time,F,word\n0,1,a\n1,2,b\n",
    "bad.json": "{}",
    "broken.fmu": "PK no archive",
    "half.parquet": "PAR1",
    "empty.csv": "",
}

# arguments: what the message must name; test_refusals.py has more of what a file may not say
WRONG = {
    "schema misison": ['"misison"', 'did you mean "mission"'],
    "run dmeo": ['"dmeo"', 'did you mean "demo"'],
    "run none.toml": ["none.toml", "no such scene file"],
    "run bad.toml": ["bad.toml", "not valid TOML"],
    "run seven.toml": ["seven.toml", "a bearing file, not a scene"],
    "run scene.toml": ["inputs.shaft.F_y = '3 tons'", '"tons" does not fit', "N, kN, kgf, lbf"],
    "run key.toml": ['"simulatoin"', 'did you mean "simulation"'],
    "run demo --fmu none.fmu": ["none.fmu", "no such FMU"],
    "run demo --fmu broken.fmu": ["broken.fmu", "not a readable FMU"],
    "run demo --fmu shaft.fmu": ["shaft.fmu: the FMU of Shaft, not of a bearing"],
    "run --fmu broken.fmu": ["broken.fmu", "not a readable FMU"],
    "run demo --set joint.preload": ["--set joint.preload", "NAME=VALUE"],
    "run demo --set joint.preloat=3": ['"joint.preloat"', 'did you mean "joint.preload"'],
    "run demo --set joint.preload=3mm": ["joint.preload = '3mm'", '"mm" does not fit', "allowed: N"],
    "run demo --set oil.alpha=20": ["2e+10 1/GPa is out of range", 'in 1/Pa: did you mean "20 1/GPa"?'],
    "run demo --set cage.pocket_clearance=0.2": ["200 mm is out of range", 'in m: did you mean "0.2 mm"?'],
    "run demo --set joint.preload=300kgf": ["joint.preload = '300kgf'", "300 kgf is out of range", "0 ... 101.972 kgf"],
    "run demo --set joint.preload=": ["joint.preload = ''", "not a number with a unit"],
    "run demo --set joint.preload=1,5": ["joint.preload = '1,5'", "not a number with a unit"],
    "run demo --set shaft.F_y=1e9": ["shaft.F_y", "-100000 ... 100000 N"],
    "run demo --set shaft.omega=200krpm": ["shaft.omega = '200krpm'", "-143.239 ... 143.239 krpm"],
    "life none.toml": ["none.toml", "no such mission file"],
    "sensitivity none.toml": ["none.toml", "no such study file"],
    "causes none.toml": ["none.toml", "no such file of findings"],
    "optimize none.toml": ["none.toml", "no such study file"],
    "identify none.toml": ["none.toml", "no such study file"],
    "dataset none.toml": ["none.toml", "no such dataset file"],
    "spectrum none.parquet": ["none.parquet", "no such file"],
    "run demo --set shaft.omega=nan": ["shaft.omega", "finite"],
    "run demo --seed -1": ["start.seed = -1", "0 ..."],
    "run demo --t-end 1m": ["t_end = '1m'", "s, ms, us, min, h"],
    "run demo --t-end soon": ["t_end = 'soon'", "not a number with a unit"],
    "run demo --step 0": ["step = 0", "greater than 0"],
    "run demo --t-end 1ms --step 2ms": ["step = 0.002", "t_end = 0.001 s"],
    "run demo --format xls": ['"xls"', "parquet, csv, mat"],
    "run demo --out res.xlsx": ['--out res.xlsx: unknown format "xlsx"', "or a folder"],
    "run demo --format csv --out a.mat": ["a.mat", "csv"],
    "run demo --out loads.csv/x --t-end 1ms": ["loads.csv/x", "no folder to write to"],
    "info 6299": ['"6299"', "the catalogue has"],
    "info three.toml": ["three.toml", "Z = 3", "5 to 32"],
    "info unit.toml": ["parameters.bearing.D = '8 N'", "m, mm, um, cm, in"],
    "info crowded.toml": ["crowded.toml", "Z = 20", "at most 15"],
    "info bad.toml": ["bad.toml", "not valid TOML"],
    "build --bearing none.toml": ["none.toml", "no such file"],
    "build --bearing crowded.toml": ["Z = 20", "at most 15"],
    "build --table medium": ['"medium"', "coarse, full, closed-form"],
    "build --platforms beos": ["--platforms", '"beos"', "linux64"],
    "build --rivet bad.json": ["bad.json", "not a rivet table"],
    "build --rivet text.toml": ["text.toml: fillet_radius = '0.3 mm': at most 0.25 mm is allowed"],
    "rivet thick.toml": ["thick.toml: head_height = '1 parsec'", '"parsec" does not fit', "m, mm, um"],
    "summary none.toml": ["none.toml"],
    "compare-designs none.fmu --mission none.toml": ["none"],
    "cookbook nothing": ["nothing"],
    "rivet nothing.toml": ['unknown key "shank"', "shank_diameter"],
    "rivet count.toml": ["count.toml: Z = 9.5", "an integer from 5 to 32"],
    "rivet narrow.toml": ["cage_outer_diameter = '2.1 inch'", "at least 2.226 in is allowed"],
    "rivet none.json": ["none.json", "No such file"],
    "report none.parquet": ["none.parquet", "no such file"],
    "report half.parquet": ["half.parquet", "not a result"],
    "report empty.csv": ["empty.csv", "not a result"],
    "report loads.csv": ["loads.csv", "not a result"],
    "report loads.csv --sensitivity none.json": ["none.json", "sensitivity.json of `riveted-bearing sensitivity`"],
    "report loads.csv --sensitivity bad.json": ["bad.json: not a record of `riveted-bearing sensitivity`"],
    "report loads.csv --sensitivity bad.toml": ["bad.toml: not a record of `riveted-bearing sensitivity`"],
    "variables friction_of_the_moon": ['"friction_of_the_moon"'],
    "variables oil --fmu shaft.fmu": ["the FMU of Shaft"],
    "sweep none.toml": ["none.toml", "no such sweep file"],
    "sweep vary.toml": ["vary.joint.preload = []", "a list of values or"],
    "matrices none.toml": ["none.toml", "no such scene file"],
    "matrices demo --speed soon": ["--speed soon", "not a number with a unit"],
    "matrices demo --speed 200krpm": ["--speed 200krpm", "-143239 ... 143239 rev/min"],
    "matrices demo --load nan": ["load factor nan", "must be finite"],
    "compare demo --short 1m": ["--short = '1m'", "s, ms, us, min, h"],
}


@pytest.fixture(scope="module")
def folder(fmu, tmp_path_factory):
    """The user's files, and the FMU of the example's shaft."""
    folder = tmp_path_factory.mktemp("wrong")
    for name, text in FILES.items():
        (folder / name).write_text(text)
    shutil.copyfile(ROOT / "fmus" / "Shaft.fmu", folder / "shaft.fmu")
    shutil.copyfile(fmu, folder / fmu.name)
    return folder


def test_there_are_sixty():
    assert len(WRONG) >= 60 and {words.split()[0].replace("-", "_") for words in WRONG} == set(COMMANDS)


@pytest.mark.parametrize("arguments", WRONG)
def test_wrong_input_is_one_line(folder, monkeypatch, arguments):
    monkeypatch.chdir(folder)
    before = sorted(folder.rglob("*"))
    done = typed(arguments)
    assert done.exit_code == 2, (done.output, done.exception)
    assert done.stdout == "" and done.stderr.startswith("error: ") and done.stderr.count("\n") == 1, done.stderr
    for words in WRONG[arguments]:
        assert words in done.stderr
    assert sorted(folder.rglob("*")) == before


ODD = (
    True,
    "",
    "nan",
    "1 N",
    "x" * 300,
    -1,
    10**30,
    1e308,
    -math.inf,
    math.nan,
    [],
    {},
    [[]],
    {"": 0},
    [1, "a"],
    5e-324,
)
ODD += ("\0", {"a": {"b": [1]}}, [{}])
RICH = {  # files that have most keys of their kind, and what reads them
    "scene": (
        """
simulation = { t_end = "10 ms", step = 1e-4, output_interval = 2e-4, tolerance = 1e-4, outputs = ["ring.*"] }
parameters = { joint.preload = "30 N", ring.tilt_mode = "supported", pulse.count = 2 }
inputs.shaft.F_y = { file = "loads.csv", column = "F", time = "time", unit = "kN", longest_gap = 3 }
inputs.shaft.omega = { t = [0, 0.1], value = [0, 18238], unit = "rev/min", interpolation = "linear" }
change = [{ at = "5 ms", joint.mu = 0.3 }]
""",
        lambda path, model: load_scene(path, model),
    ),
    "bearing": (
        """
designation = "6210"
Z = 10
catalogue.clearance = "C3"
cage.material = "brass"
rivet.shank_diameter = "2 mm"
parameters = { joint.preload = "30 N" }
inputs.shaft.F_y = "2 kN"
""",
        lambda path, model: bearing_case(path),
    ),
    "mission": (
        """
scene = "demo"
point = [{ name = "climb", hours = 20, preload_factor = 0.9, interpolate = false, inputs.shaft.F_y = "3 kN" }]
event = [{ name = "bump", count = 2, after_settle = true, inputs.impact.F_r = { t = [0, 0.1, 0.2], value = [0, 4, 0] } }]
table = { file = "duty.csv", hours = "h", inputs.shaft.omega = { column = "n", unit = "rev/min" } }
history = { file = "loads.csv", time = "time", hours = 9, longest_gap = 1, inputs.shaft.F_y = { column = "F", bins = 2 } }
preload_loss = { hours = [0, 100], factor = [1, 0.9] }
life = { confidence = 0.9, min_seeds = 6, seed = 1, skip = 0.01, rivets = "each" }
sn = { sigma_D = "100 MPa", k_1 = 5 }
""",
        lambda path, model: load_mission(path, model),
    ),
    "sweep": (
        """
scene = "demo"
repeats = 2
vary = [{ joint.preload = { from = "10 N", to = "60 N", count = 3, spacing = "log" } }, { shaft.F_y = ["1 kN", 2000] }]
sample = { method = "sobol", count = 4, between.joint.fit = ["-10 um", "10 um"] }
""",
        lambda path, model: load_sweep(path, model),
    ),
}


def places(node, at=()):
    """The places of all entries of nested tables and lists."""
    for key in list(node) if isinstance(node, dict) else range(len(node)):
        yield (*at, key)
        if isinstance(node[key], dict | list):
            yield from places(node[key], (*at, key))


def inline(value):
    """A value as TOML on one line."""
    if isinstance(value, dict):
        return f"{{ {', '.join(f'{json.dumps(key)} = {inline(one)}' for key, one in value.items())} }}"
    if isinstance(value, list):
        return f"[{', '.join(map(inline, value))}]"
    return repr(value) if isinstance(value, float) else json.dumps(value)


@pytest.mark.filterwarnings("ignore:overflow")
@pytest.mark.parametrize("kind", RICH)
def test_wrong_types_are_one_line(kind, tmp_path):
    """Every entry of a file with six odd values in its place: read, or refused in one line that names the file."""
    text, load = RICH[kind]
    path, model, document = tmp_path / "mine.toml", Model(), tomllib.loads(text)
    (tmp_path / "loads.csv").write_text("time,F\n0,1\n0.1,2\n0.2,2\n")
    (tmp_path / "duty.csv").write_text("h,n\n10,8000\n20,12000\n")
    path.write_text("".join(f"{key} = {inline(value)}\n" for key, value in document.items()))
    load(path, model)
    refused, rng = 0, random.Random(kind)
    for at in places(document):
        for odd in rng.sample(ODD, 6):
            changed = copy.deepcopy(document)
            node = changed
            for key in at[:-1]:
                node = node[key]
            node[at[-1]] = odd
            path.write_text("".join(f"{key} = {inline(value)}\n" for key, value in changed.items()))
            try:
                load(path, model)
                message = ""
            except UserError as problem:
                message = str(problem)
            refused += message != ""
            assert not message or ("\n" not in message and str(tmp_path) in message), (at, odd)
    assert refused > 4 * len(list(places(document)))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("a = " + 3000 * "[", "nested too deeply"),
        ("a = " + 900 * "{ a = " + "1" + 900 * "}", "nested too deeply"),
        ("a" + 3000 * ".a" + " = 1", "nested too deeply"),
        ("a = " + 5000 * "9", "an integer of thousands of digits"),
        ("a = " + 30 * "9", "at most 64 bits"),
        ("# \u00b5".encode("latin-1"), "line 1 is not UTF-8"),
    ],
)
def test_files_beyond_toml_are_one_line(text, said, tmp_path):
    (tmp_path / "mine.toml").write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(UserError, match=said) as refused:
        read_toml(tmp_path / "mine.toml")
    assert "mine.toml" in str(refused.value) and "\n" not in str(refused.value) and len(str(refused.value)) < 300


def test_patterns_end():
    """Any number of stars and letters on names that almost fit: linear in the name."""
    for pattern in (30 * "*" + "x", 20 * "*a" + "x", 20 * "a*" + "x"):
        assert not is_like(100 * "a", pattern)
    for text, pattern in (
        ("ring.x", "ring.*"),
        ("rivet[3].N", "rivet[*].N"),
        ("aXbXc", "a*X*c"),
        ("abc", "abc"),
        ("", "*"),
    ):
        assert is_like(text, pattern)
    for text, pattern in (("ring.x", "ring"), ("aba", "ab*ba"), ("rivet[3].N", "rivet[*].V"), ("abc", "a*bc*bc")):
        assert not is_like(text, pattern)


def test_temporary_names_are_not_predictable(tmp_path):
    names = []
    for _ in range(2):
        write_atomically(tmp_path / "a.csv", lambda path: names.append(path.name) or path.write_text("1"))
    assert names[0] != names[1] and [path.name for path in tmp_path.iterdir()] == ["a.csv"]
