"""The command line and the Python interface: runs, results in all formats, exit codes, and that the physics does not
depend on them.
"""

import gc
import json
import re
import shlex
import subprocess
import sys
import tomllib
from dataclasses import replace
from pathlib import Path

import fmpy
import numpy as np
import pytest
from commands import command

from bearing_model.rivet.rivet_table import DEFAULT_TABLE
from rivet_model import closed_form, table
from rivet_model.geometry import Geometry
from riveted_bearing import Result, UserError, read_result, run, write_result
from riveted_bearing.base.files import FORMATS, write_atomically
from riveted_bearing.base.toml_files import to_toml
from riveted_bearing.bearing.bearing_file import bearing_case
from riveted_bearing.bearing.bearing_keys import BearingFile
from riveted_bearing.bearing.designations import find_bearing, shipped_bearings
from riveted_bearing.bearing.file_values import flat
from riveted_bearing.building.builder import start_document
from riveted_bearing.running.fmu import Instance, Model
from riveted_bearing.running.scene_case import is_bearing
from riveted_bearing.running.scene_file import SceneFile
from riveted_bearing.running.summary import rivet_rows, summary_rows, table_note
from riveted_bearing.show.report import render

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture(scope="module", autouse=True)
def importable(monkeymodule):
    """Subprocesses started elsewhere find this checkout."""
    monkeymodule.setenv("PYTHONPATH", str(ROOT))
    monkeymodule.delenv("FORCE_COLOR", raising=False)


@pytest.fixture(scope="module")
def monkeymodule():
    with pytest.MonkeyPatch.context() as patch:
        yield patch


@pytest.fixture(scope="module")
def short():
    """A short run of the working point."""
    return run("demo", t_end=2e-3, parameters={"start.settle": 5e-4})


@pytest.fixture
def result():
    """A small made-up result with everything that is hard to store."""
    data = {
        "time": np.array([0.0, 1e-4, 2e-4]),
        "ball[1].Q_i": np.array([1 / 3, np.pi, 1e-300]),
        "ball[2].Q_i": np.array([0.0, -0.0, np.nan]),
    }
    data |= {"rivet.sigma_head_max": np.array([1e8, 2e8, 3e8]), "stat.rivet_head_max[3]": np.array([1.0, 2.0, 3.0])}
    return Result(
        data=data,
        units=dict.fromkeys(data, "N") | {"time": "s"},
        parameters={"bearing.D": 0.0111125, "ball[1].dD": 1e-6, "ring.tilt_mode": "free", "start.seed": 7},
        summary={"stat.time": 0.35, "solver.steps": 1e5, "nothing": float("inf")},
        about={
            "scene": 'a "quoted" name',
            "description": "µ, °, \\ and\nlines",
            "inputs": {"shaft.F_y": {"t": [0.0, 0.1], "value": [1.0, 2e3], "hold": True}},
            "stopped": "",
        },
    )


@pytest.mark.parametrize("kind", FORMATS)
def test_every_format_gives_back_every_bit(result, tmp_path, kind):
    back = read_result(write_result(result, tmp_path / f"x.{kind}"))
    assert list(back.data) == list(result.data)
    for name, values in result.data.items():
        assert back.data[name].tobytes() == values.tobytes(), name
    assert back.metadata() == result.metadata()


@pytest.mark.parametrize("kind", FORMATS)
def test_a_damaged_file_is_refused(result, tmp_path, kind):
    path = write_result(result, tmp_path / f"x.{kind}")
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])
    with pytest.raises(UserError, match=re.escape(str(path))):
        read_result(path)
    path.write_bytes(b"something else\n")
    with pytest.raises(UserError, match="not a result"):
        read_result(path)
    with pytest.raises(UserError, match="no such file"):
        read_result(tmp_path / f"none.{kind}")
    with pytest.raises(UserError, match='unknown format "xls"; allowed: parquet, csv, mat'):
        write_result(result, tmp_path / "x.xls")


def test_a_file_is_written_whole_or_not_at_all(tmp_path):
    path = tmp_path / "new folder" / "x.csv"
    write_atomically(path, lambda temporary: temporary.write_text("old"))

    def fail(temporary):
        temporary.write_text("half")
        raise OSError("disk full")

    with pytest.raises(UserError, match="x.csv: cannot be written: disk full"):
        write_atomically(path, fail)
    assert path.read_text() == "old" and list(path.parent.iterdir()) == [path]
    with pytest.raises(UserError, match="x.csv: no folder to write to: "):
        write_atomically(path / "y.csv", fail)


def test_mat_is_nested_as_the_names_are(result, tmp_path):
    from scipy.io import loadmat

    tree = loadmat(write_result(result, tmp_path / "x.mat"), simplify_cells=True)["result"]
    assert tree["ball"]["Q_i"].shape == (3, 2) and tree["ball"]["Q_i"][1, 0] == np.pi
    assert json.loads(tree["metadata"])["parameters"]["bearing.D"] == 0.0111125


def test_other_programs_can_read_parquet_and_csv(short, tmp_path):
    from pyarrow import parquet

    schema = parquet.read_schema(write_result(short, tmp_path / "x.parquet"))
    assert schema.field("ring.y").metadata[b"unit"] == b"m"
    assert json.loads(schema.metadata[b"riveted_bearing"])["parameters"] == short.parameters
    lines = write_result(short, tmp_path / "x.csv").read_text().splitlines()
    body = [line for line in lines if not line.startswith("#")]
    assert body[0].startswith("time,") and len(body) == 1 + len(short.data["time"])
    assert (
        tomllib.loads("\n".join(line[2:] for line in lines if line.startswith("#")))["parameters"] == short.parameters
    )


def test_pandas_and_xarray_have_every_number_and_unit(short):
    pytest.importorskip("pandas", reason='pip install -e ".[full]"')
    pytest.importorskip("xarray", reason='pip install -e ".[full]"')
    frame, data = short.to_pandas(), short.to_xarray()
    assert frame.index.tolist() == short.data["time"].tolist() and set(frame.columns) == set(short.data) - {"time"}
    assert frame["ball[3].Q_i"].to_numpy().tobytes() == short.data["ball[3].Q_i"].tobytes()
    assert frame.attrs["units"]["ball[3].Q_i"] == "N" and frame.attrs["parameters"]["joint.preload"] == 20.0
    assert data["ball.Q_i"].dims == ("time", "ball") and data["rivet.sigma_head"].sizes == {"time": 21, "rivet": 9}
    assert data["ball.Q_i"].sel(ball=3).to_numpy().tolist() == short.data["ball[3].Q_i"].tolist()
    assert data["rivet.sigma_head"].attrs["units"] == "Pa" and data["shaft.F_y"].attrs["units"] == "N"
    assert float(data["rivet.sigma_head"].sel(rivet=9).isel(time=-1)) == short.data["rivet[9].sigma_head"][-1]
    assert (
        sum(array.sizes.get("ball", 1) * array.sizes.get("rivet", 1) for array in data.data_vars.values())
        == len(short.data) - 1
    )
    assert json.loads(data.attrs["parameters"]) == short.parameters


def test_without_pandas_the_extra_is_named(result, monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(
        UserError, match=re.escape('needs the library pandas: pip install -e ".[full]" in a checkout, or')
    ):
        result.to_pandas()


def test_a_run_returns_what_was_asked_for(short):
    assert short.stopped == "" and short.data["time"][0] == 0.0 and short.data["time"][-1] == 2e-3
    assert len(short.data["time"]) == 21
    assert set(short.data) == set(short.units) and all(np.isfinite(values).all() for values in short.data.values())
    assert short.parameters["joint.preload"] == 20.0 and short.parameters["ring.tilt_mode"] == "prescribed"
    # from the first internal step (about 1e-5 s) after settling
    assert short.summary["stat.time"] == pytest.approx(1.5e-3, rel=0.02)
    assert short.summary["solver.rhs_evals"] > short.summary["solver.steps"] > 20
    assert short.about["guid"].startswith("{") and short.about["inputs"]["shaft.F_y"]["value"] == [2994.0]
    assert summary_rows(short)[0].channel == "pocket force, all balls" and len(rivet_rows(short)) == 9


def test_changes_reach_the_fmu():
    result = run(
        "demo",
        t_end=2e-4,
        seed=5,
        parameters={"joint.preload": "30 N", "scene.traction": "sliced", "ball[3].dD": "1 um"},
        inputs={"cage.T": "20 degC"},
        outputs=["rivet[*].P"],
    )
    assert result.parameters["joint.preload"] == 30.0 and result.parameters["scene.traction"] == "sliced"
    assert result.parameters["start.seed"] == 5
    assert result.parameters["ball[3].dD"] == pytest.approx(1e-6, rel=1e-15)
    assert list(result.data) == ["time", *(f"rivet[{k}].P" for k in range(1, 10))]
    assert result.data["rivet[1].P"] == pytest.approx(30.0, rel=1e-12)  # at assembly temperature


def test_numbers_may_be_numpys():
    history = {"t": np.array([0.0, 1e-4]), "value": np.array([2000, 2100])}
    changes = {"parameters": {"joint.preload": np.float32(30)}, "inputs": {"shaft.F_y": history}, "seed": np.int64(5)}
    result = run("demo", t_end=2e-4, outputs=["shaft.F_y"], **changes)
    assert result.parameters["joint.preload"] == 30.0 and result.parameters["start.seed"] == 5
    assert result.data["shaft.F_y"].tolist() == [2000.0, 2000.0, 2100.0]  # inputs hold over a step


def test_time_histories_reach_the_fmu(tmp_path):
    (tmp_path / "thrust.csv").write_text("time,kilo\n0,0.5\n0.0005,0.6\n0.001,0.4\n")
    scene = tmp_path / "mine.toml"
    scene.write_text("""
        simulation = { t_end = 1e-3, step = 1e-4, outputs = ["shaft.*"] }
        [inputs]
        shaft.omega = { t = [0, 1e-3], value = [1000, 1100] }
        shaft.F_y = { t = ["0 ms", "0.35 ms"], value = [2000, "1 kN"], interpolation = "hold" }
        shaft.F_x = { file = "thrust.csv", column = "kilo", unit = "kN" }
    """)
    data = run(scene).data
    t = data["time"][:-1]  # what holds during a step is what the history says at its start
    assert data["shaft.omega"][1:] == pytest.approx(1000 + 1e5 * t, rel=1e-12)
    assert data["shaft.F_y"][1:].tolist() == [2000.0] * 4 + [1000.0] * 6
    assert data["shaft.F_x"][1:] == pytest.approx(np.interp(t, [0, 5e-4, 1e-3], [500, 600, 400]), rel=1e-12)


def test_longer_output_intervals_keep_peaks(tmp_path):
    scene = tmp_path / "mine.toml"
    scene.write_text(
        '[simulation]\nt_end = 2e-3\nstep = 1e-4\noutputs = ["rivet.sigma_head_max", "cage.F_pocket_peak", "ring.y"]'
    )
    fine = run(scene).data
    scene.write_text(scene.read_text() + "\noutput_interval = 7e-4")
    coarse = run(scene).data
    assert coarse["time"] == pytest.approx([0, 7e-4, 1.4e-3, 2e-3], rel=1e-12)
    for name in ("rivet.sigma_head_max", "cage.F_pocket_peak"):  # the same steps: the same bits
        assert coarse[name][1:].tolist() == [fine[name][i:j].max() for i, j in ((1, 8), (8, 15), (15, 21))]
    assert coarse["ring.y"].tolist() == fine["ring.y"][[0, 7, 14, 20]].tolist()


def test_a_run_that_the_fmu_ends_keeps_what_there_is(tmp_path):
    """The work limit ends the run when a communication step needs more than 10 internal steps, here the first long one."""
    done = command(
        "run", "demo", "--set", "solver.max_steps=10", "--step", "1e-2", "--no-plot", "--out", tmp_path, folder=tmp_path
    )
    assert done.returncode == 3 and "Traceback" not in done.stderr
    assert "gave up" in done.stderr and "10 steps" in done.stderr
    result = read_result(tmp_path / "demo.parquet")
    assert "10 steps" in result.stopped and 0.0 < result.data["time"][-1] < 1e-2
    assert np.isfinite(result.data["ring.y"]).all()


def test_what_the_fmu_refuses_is_said(tmp_path):
    """Eight balls' worth of room for nine: each value is in its range, the set of them is no bearing."""
    done = command("run", "demo", "--set", "bearing.D=0.019", "--out", tmp_path, folder=tmp_path)
    assert done.returncode == 2 and "refuses to start" in done.stderr and "Traceback" not in done.stderr
    assert not list(tmp_path.iterdir())


def test_run_in_a_pipe(tmp_path):
    line = 'run demo --t-end "2 ms" --set "start.settle=0.5 ms" --format csv --out out'
    done = command(*shlex.split(line), folder=tmp_path)
    assert done.returncode == 0, done.stderr
    # neither colours nor a progress bar
    assert "\x1b" not in done.stdout + done.stderr and "real time" not in done.stderr
    figures = ("pocket force", "head stress", "cage speed", "friction torque", "real-time factor")
    for text in (*figures, "demo.csv", "demo.png"):
        assert text in done.stdout
    assert (tmp_path / "out" / "demo.png").read_bytes()[:4] == b"\x89PNG"
    assert read_result(tmp_path / "out" / "demo.csv").data["time"][-1] == 2e-3


@pytest.mark.parametrize(
    ("line", "fragments"),
    [
        ("run dmeo", ['"dmeo"', 'did you mean "demo"']),
        ("run none.toml", ["none.toml", "no such scene file"]),
        ("run demo --fmu none.fmu", ["none.fmu", "no such FMU"]),
        ("run demo --fmu broken.fmu", ["broken.fmu", "not a readable FMU"]),
        ("run demo --set joint.preload", ["--set joint.preload", "NAME=VALUE"]),
        ("run demo --set joint.preloat=3", ['"joint.preloat"', '"joint.preload"']),
        ("run demo --set 'rivet.shank_diameter=2 mm'", ["rivet.shank_diameter = '2 mm'", "[rivet] of a bearing file"]),
        ("run demo --set 'joint.preload=3 mm'", ["joint.preload = '3 mm'", "allowed: N"]),
        ("run demo --set shaft.F_y=1e9", ["shaft.F_y", "-100000 ... 100000 N"]),
        ("run demo --seed -1", ["start.seed = -1", "0 ..."]),
        ("run demo --format xls", ['"xls"', "parquet, csv, mat"]),
        ("run demo --format csv --out a.mat", ["a.mat", "csv"]),
        ("run demo --t-end '1 m'", ["t_end = '1 m'", "s, ms, us"]),
        ("run demo --set bearing.f_i=0.4", ["bearing.f_i = 0.4: 0.4 is out of range, allowed: 0.5005 ... 0.6\n"]),
        ("run demo --out bad.json", ['--out bad.json: unknown format "json"', "parquet, csv, mat, or a folder"]),
        (
            "run demo --t-end '1 ms' --step '2 ms'",
            ["demo.toml with the command line", "step = 0.002", "t_end = 0.001 s"],
        ),
        ("info 6299", ['"6299"', "the catalogue has 85 bearings"]),
        ("info 6210-2RS", ['did you mean "6210"', "clearance"]),
        ("build --bearing none.toml", ["none.toml: no such file"]),
        ("info bad.toml", ["bad.toml", "Z = 3", "5 to 32"]),
        ("build --bearing bad.toml", ["bad.toml", "Z = 3", "5 to 32"]),
        ("build --bearing 6399", ['"6399"', "a bearing file describes others"]),
        ("build --table medium", ["--table", '"medium"', "coarse, full, closed-form"]),
        ("build --table full --rivet nine.json", ["--table full", "nine.json is a table already"]),
        ("build --rivet none.json", ["none.json", "No such file"]),
        ("build --rivet bad.json", ["bad.json", "not a rivet table"]),
        ("build --rivet half.json", ["half.json", "not a rivet table"]),
        ("build --rivet nine.json --bearing 6310", ["nine.json", "made for Z = 9", "Z = 8 is needed"]),
        ("build --rivet bad.toml", ["bad.toml", "Z = 3", "5 to 32"]),
        ("build --rivet negative.toml", ["negative.toml", "shank_diameter = -0.0015"]),
        (
            "build --rivet wide.toml",
            ["wide.toml", "fillet_radius = 0.0003: at most 0.00025 m is allowed", "relief_radius = 0.25 mm"],
        ),
        ("build --rivet none.toml", ["none.toml", "No such file"]),
        ("rivet bad.json", ["bad.json", "not a rivet table"]),
        ("rivet negative.toml", ["negative.toml", "shank_diameter = -0.0015"]),
        ("build --bearing typo.toml", ["typo.toml", '"bearing.Dm"', 'did you mean "bearing.D']),
        ("info far.toml", ["far.toml", "bearing.f_i = 0.4", "0.5005 ... 0.6, or a text"]),
    ],
    ids=str,
)
def test_errors_are_one_message(tmp_path, line, fragments):
    (tmp_path / "broken.fmu").write_bytes(b"PK no zip")
    (tmp_path / "bad.json").write_text("Z = 3")
    (tmp_path / "half.json").write_bytes(DEFAULT_TABLE.read_bytes()[:100_000])
    (tmp_path / "nine.json").write_bytes(DEFAULT_TABLE.read_bytes())
    (tmp_path / "negative.toml").write_text("shank_diameter = -1.5e-3")
    (tmp_path / "wide.toml").write_text("fillet_radius = 0.3e-3")
    (tmp_path / "bad.toml").write_text("Z = 3")
    (tmp_path / "typo.toml").write_text("Z = 8\n[parameters]\nbearing.Dm = 0.05")
    (tmp_path / "far.toml").write_text("Z = 8\n[parameters]\nbearing.f_i = 0.4")
    done = command(*shlex.split(line), folder=tmp_path)
    assert done.returncode == 2 and done.stdout == "" and done.stderr.count("\n") == 1
    assert done.stderr.startswith("error: ")
    for fragment in fragments:
        assert fragment in done.stderr
    assert [path.name for path in tmp_path.rglob("*.fmu")] == ["broken.fmu"]


def test_help_names_the_commands(tmp_path):
    done = command("--help", folder=tmp_path)
    assert done.returncode == 0 and all(name in done.stdout for name in ("build", "run", "info"))


def test_info_says_that_nothing_follows_from_a_scene(tmp_path):
    """A file with D and d_m alone is a scene, in which the cage stays that of the FMU; with Z it is a bearing whose
    cage follows.
    """
    path = tmp_path / "mine.toml"
    path.write_text('[parameters]\nbearing.D = "15.081 mm"\nbearing.d_m = "65 mm"\n')
    said = command("info", path.name, folder=tmp_path).stdout
    assert "note: read as a scene, which sets bearing.D, bearing.d_m" in said and "59.5, 49.7, 13.6" in said
    path.write_text("Z = 9\n" + path.read_text())
    said = command("info", path.name, folder=tmp_path).stdout
    assert "read as a scene" not in said and "73.14, 59.84, 18.46" in said


@pytest.mark.parametrize("key", sorted(set(BearingFile.model_fields) - set(SceneFile.model_fields)))
def test_any_key_of_a_bearing_file_makes_it_one(tmp_path, key):
    """Without designation, Z and sizes too: what only a bearing file has is not an unknown key of a scene."""
    path = tmp_path / "mine.toml"
    path.write_text("Z = 8\n" if key == "Z" else 'designation = "6309"\n' if key == "designation" else f"[{key}]\n")
    assert is_bearing(path)


def test_info_reads_a_file_with_nothing_but_a_cage_material_as_a_bearing(tmp_path):
    (tmp_path / "mine.toml").write_text('[cage]\nmaterial = "steel"\n')
    done = command("info", "mine.toml", folder=tmp_path)
    assert done.returncode == 0
    assert "steel: E 210 GPa" in done.stdout
    assert "of the 6207" in done.stdout  # whose balls and loads stand for what is not given


def test_info_tells_what_speed_temperatures_and_fits_leave_of_the_clearance(tmp_path):
    """A press fit on the shaft, warm rings: the FMU's own bearing.clearance.  Sizes stand as they were given, at
    assembly temperature.
    """
    (tmp_path / "fit.toml").write_text(
        '[parameters]\nshaft.interference = "12 um"\n[inputs]\nring.T_i = "60 degC"\nring.T_e = "50 degC"\n'
    )
    out = command("info", "fit.toml", folder=tmp_path).stdout
    left = float(re.search(r"what is left of it .*?(-?[\d.]+)  um", out)[1])
    clearance = run(tmp_path / "fit.toml", t_end=1e-4).data["bearing.clearance"][0]
    assert left == pytest.approx(1e6 * clearance, abs=2e-3) and left < 10.0
    assert re.search(r"diametral clearance +15  um", out) and re.search(r"balls +9 x 11.1125  mm", out)


def test_info_gives_the_known_frequencies(tmp_path):
    done = command("info", "6207", folder=tmp_path)
    # Hz at 18,238 r/min: cage, BPFO, BPFI, ball, by hand from D, d_m, Z
    for figure in ("120.4", "1083.7", "1652.0", "700.1"):
        assert figure in done.stdout
    assert "4000 rev/min" in command("info", "jam", folder=tmp_path).stdout.replace(",", "")


def test_the_default_bearing_is_the_variable_table():
    table = tomllib.loads((ROOT / "fmus" / "variables.toml").read_text())
    starts = {entry["name"]: entry["start"] for section in ("parameters", "inputs") for entry in table[section]["list"]}
    own = tomllib.loads(find_bearing("6207").read_text())
    assert own["Z"] == table["Z"] and len(dict(flat(own["parameters"]))) > 15
    for name, value in [*flat(own["parameters"]), *flat(own["inputs"])]:
        assert value == starts[name], name


@pytest.mark.parametrize("designation", shipped_bearings())
def test_shipped_bearings_are_consistent(designation):
    """Against ISO 76, ISO 281 and the geometry of a ring of the cage's diameters."""
    case = bearing_case(designation)
    v, c = case.values, case.catalogue
    f_0 = {"6207": 13.8, "6310": 13.1}[designation]  # ISO 76, table 1
    # rounded in catalogues: observed 0.4 %
    assert c["C_0"] == pytest.approx(f_0 * 1e6 * case.Z * v["bearing.D"] ** 2, rel=0.01)
    assert v["bearing.d_m"] == pytest.approx((c["bore"] + c["outside_diameter"]) / 2, rel=1e-12)
    f_c = {"6207": 59.5, "6310": 58.8}[designation]  # ISO 281, table 2, with b_m = 1.3
    C = 1.3 * f_c * case.Z ** (2 / 3) * (1e3 * v["bearing.D"]) ** 1.8
    assert c["C"] == pytest.approx(C, rel=0.06)  # the 6207's is a maker's figure, 5 % above the standard's
    assert v["cage.J_p"] == pytest.approx(v["cage.m"] * (v["cage.D_o"] ** 2 + v["cage.D_i"] ** 2) / 8, rel=0.02)
    width = v["cage.width"] / 2
    ring_volume = np.pi / 4 * (v["cage.D_o"] ** 2 - v["cage.D_i"] ** 2) * width
    assert 0.5 < v["cage.m"] / (8800 * ring_volume) < 0.6  # bronze, of which the pockets take 40 to 50 %
    assert 0.5 * width < v["cage.x_c"] < 0.62 * width  # the pockets take from the split's side
    assert v["cage.land_x"] + v["cage.land_width"] / 2 <= width
    assert case.equilibrium().F[1] == pytest.approx(v["shaft.F_y"], rel=1e-6)
    assert find_bearing(designation).name == f"{designation}.toml"


def test_bearing_files_take_units(tmp_path):
    """The same values as numbers in SI and as texts with units; Z = 12 of 5 mm."""
    texts = """Z = 12
[catalogue]
bore = "20 mm"
C = "9.36 kN"
[parameters]
bearing.D = "5 mm"
bearing.d_m = "30 mm"
ring.tilt_mode = "free"
[inputs]
shaft.omega = "6000 rev/min"
"""
    numbers = (
        texts.replace('"20 mm"', "0.02")
        .replace('"9.36 kN"', "9360")
        .replace('"5 mm"', "0.005")
        .replace('"30 mm"', "0.03")
    )
    (tmp_path / "texts.toml").write_text(texts)
    (tmp_path / "numbers.toml").write_text(numbers.replace('"6000 rev/min"', "628.318530717958"))
    with_texts, with_numbers = (bearing_case(tmp_path / f"{name}.toml") for name in ("texts", "numbers"))
    assert with_texts.catalogue == pytest.approx(with_numbers.catalogue, rel=1e-12)
    changed = {name: value for name, value in with_texts.values.items() if isinstance(value, float)}
    assert changed == pytest.approx({name: with_numbers.values[name] for name in changed}, rel=1e-12)
    document = start_document(with_texts, closed_form_table(with_texts, tmp_path))
    assert "closed forms" in document["description"] and document["origin"]["bearing.D"] == "yours"
    assert document["origin"]["cage.D_o"] == "rule"
    assert document["parameters"]["bearing.D"] == 0.005 and document["parameters"]["ring.tilt_mode"] == "free"
    assert document["Z"] == 12


def test_halves_are_elastic_where_the_table_has_modes(tmp_path):
    """The shipped table has them; closed forms have none: their FMU starts with rigid halves, and a file that asks for
    elastic ones is refused.
    """
    (tmp_path / "mine.toml").write_text('[parameters]\nscene.cage = "elastic"')
    plain, asked = bearing_case("6207"), bearing_case(tmp_path / "mine.toml")
    assert start_document(plain, DEFAULT_TABLE)["parameters"]["scene.cage"] == "elastic"
    without = closed_form_table(plain, tmp_path)
    assert start_document(plain, without)["parameters"]["scene.cage"] == "two_half"
    with pytest.raises(
        UserError,
        match=r"mine: scene.cage = elastic: closed forms.* no vibration modes of the cage halves; allowed are two_half, rigid",
    ):
        start_document(asked, without)


def closed_form_table(case, folder):
    """A rivet table for a case, in a moment."""
    path = folder / "table.json"
    table.write(closed_form.make_table(Geometry(**case.joint)), path)
    return path


def test_a_run_shorter_than_settling_says_that_there_are_no_statistics(tmp_path):
    """Until start.settle itself there is one sample at most, whose mean, RMS, quantile and largest value would be one
    number.
    """
    for t_end in ("2 ms", "50 ms"):
        words = "--no-plot", "--set", "joint.preload='30 N'", "--out", tmp_path
        done = command("run", "demo", "--t-end", t_end, *words, folder=tmp_path)
        assert done.returncode == 0 and "no statistics yet: they begin at start.settle = 0.05 s" in done.stderr
        assert "after the first" not in done.stdout
        assert "p99.9" not in done.stdout and "largest since the start" in done.stdout
        page = render(read_result(tmp_path / "demo.parquet"))
        assert "No statistics yet" in page and "p99.9" not in page.split("<script")[0]
        assert "Life of the weakest rivet" not in page
    assert read_result(tmp_path / "demo.parquet").parameters["joint.preload"] == 30.0


def test_the_variables_of_the_second_bearing(tmp_path):
    """The files from which its FMU is compiled: eight balls, its own sizes and working point, the kind of its table."""
    case, resolved = bearing_case("6310"), tmp_path / "bearing.toml"
    resolved.write_text("\n".join(to_toml(start_document(case, closed_form_table(case, tmp_path)))), encoding="utf-8")
    subprocess.run(
        [sys.executable, ROOT / "fmus" / "generate.py", "--bearing", resolved, "--out", tmp_path], check=True
    )
    description = fmpy.read_model_description(str(tmp_path / "modelDescription.xml"))  # valid by the standard
    start = {v.name: v.start for v in description.modelVariables}
    assert "ball[8].Q_i" in start and "ball[9].Q_i" not in start and "rivet[8].N" in start and "rivet[9].N" not in start
    assert (float(start["bearing.D"]), float(start["shaft.F_y"])) == (0.01905, 6000.0)
    assert "closed forms" in description.description


def test_closed_forms_are_no_ground_for_a_life(short):
    rough = replace(short, summary=short.summary | {"rivet.table_kind": 3.0})
    assert table_note(short) == "" and "closed forms" in table_note(rough)
    known, unknown = render(short), render(rough)
    assert (
        "Life: not given, for the rivets&#39; stress rests on closed forms" in unknown
        and "Life of the weakest rivet" not in unknown
    )
    assert "Life: not given" not in known and "Life of the weakest rivet" in known


@pytest.mark.slow
def test_an_fmu_of_the_second_bearing(tmp_path):
    """Built from its file, started at its own working point: ring and ball loads near the quasi-static equilibrium."""
    done = command("build", "--bearing", "6310", "--table", "closed-form", folder=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "Meant with a machined two-piece riveted cage" in done.stdout
    assert "Stress table of the rivets: closed forms" in done.stdout
    shown = command(
        *shlex.split(done.stdout.split("as pictures: riveted-bearing ")[1]), "--out", "pictures", folder=tmp_path
    )
    assert shown.returncode == 0 and (tmp_path / "pictures" / "cage_modes.png").is_file()
    out = tmp_path / "6310.fmu"
    scene = tmp_path / "own.toml"
    scene.write_text("[simulation]\nt_end = 0.02\nstep = 1e-4\n[parameters]\nstart.settle = 0.01")
    result, state = run(scene, fmu=out), bearing_case("6310").equilibrium()
    assert result.summary["rivet.table_kind"] == 3.0 and "closed forms" in table_note(result)
    assert "closed forms" in result.about["model"]
    page = render(result)
    assert (
        "Life: not given, for the rivets&#39; stress rests on closed forms" in page
        and "Life of the weakest rivet" not in page
    )
    assert result.stopped == "" and "ball[8].Q_i" in result.data and "ball[9].Q_i" not in result.data
    assert result.parameters["bearing.D"] == 0.01905 and result.data["shaft.F_y"][-1] == 6000.0
    late = result.data["time"] > 0.01
    loads = np.column_stack([result.data[f"ball[{j}].Q_i"] for j in range(1, 9)])[late]
    # other ball positions, friction: observed 1.3 %
    assert result.data["ring.y"][late].mean() == pytest.approx(state.y, rel=0.03)
    assert result.data["ring.x"][late].mean() == pytest.approx(state.x, rel=0.03)  # observed 1.3 %
    assert loads.max() == pytest.approx(state.Q_i.max(), rel=0.03)  # observed 0.7 %


def test_a_bearing_that_cannot_be_built_leaves_the_old_fmu(tmp_path):
    out = tmp_path / "mine.fmu"
    out.write_bytes(b"the old one")
    (tmp_path / "crowded.toml").write_text("Z = 20")
    (tmp_path / "tight.toml").write_text("[parameters]\ncage.D_o = 0.05")  # no room for a rivet's head
    for name, fragments in (("crowded", ["Z = 20", "at most 15"]), ("tight", ["cage.D_o = 0.05", "0.0565"])):
        done = command("build", "--bearing", f"{name}.toml", "--out", out, folder=tmp_path)
        assert done.returncode == 2 and "Traceback" not in done.stderr
        assert all(fragment in done.stderr for fragment in [name, *fragments])
    assert out.read_bytes() == b"the old one" and len(list(tmp_path.iterdir())) == 3


def test_two_instances_keep_their_messages_apart():
    model = Model()
    with Instance(model) as first, Instance(model) as second:
        with pytest.raises(Exception, match="fmi2SetReal"):
            first.fmu.setReal([model.parameters["joint.preload"].valueReference], [-1.0])
        assert first.log and not second.log


def test_an_fmu_is_unpacked_once_and_removed_with_its_model():
    model = Model()
    folder = Path(model.folder)
    with Instance(model), Instance(model):
        assert Path(model.folder) == folder and (folder / "modelDescription.xml").is_file()
    with Instance(model):
        assert Path(model.folder) == folder
    del model
    gc.collect()
    assert not folder.exists()


@pytest.mark.parametrize(("name", "units"), [("report", ("[kN]", "[ms]")), ("dataset", ("[dataset]",))])
def test_help_keeps_its_brackets(tmp_path, name, units):
    """They are not read as markup of the terminal."""
    said = command(name, "--help", folder=tmp_path).stdout
    assert all(unit in said for unit in units)
