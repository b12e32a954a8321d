"""Scenes: units, time histories, and one clear message for everything that cannot be used."""

import math

import numpy as np
import pytest

from riveted_bearing import read_result, run, write_result
from riveted_bearing.base.errors import UserError
from riveted_bearing.base.shipped import shipped_scenes
from riveted_bearing.base.units import scales_of, suffix, to_si
from riveted_bearing.running.inputs import History
from riveted_bearing.running.scene import load_scene

VISCOSITY = {"m2/s": (1.0, 0.0), "mm2/s": (1e6, 0.0)}
SPEED = scales_of("rad/s", {"rev/min": (30.0 / math.pi, 0.0)})
TEMPERATURE = scales_of("K", {"degC": (1.0, -273.15)})
MORE = {unit: scales_of(unit, {}) for unit in ("m", "N", "Pa", "1")}


@pytest.fixture
def scene_file(tmp_path):
    """Writes a scene with the given text and returns its path."""

    def write(text):
        path = tmp_path / "mine.toml"
        path.write_text(text)
        return path

    return write


@pytest.mark.parametrize(
    ("value", "scales", "si"),
    [
        (18238, SPEED, 18238.0),  # a bare number is SI
        ("18238 rev/min", SPEED, 18238 * math.pi / 30),  # paper Table 2
        ("18238rpm", SPEED, 18238 * math.pi / 30),
        ("60 r/min", SPEED, 2 * math.pi),
        ("1e3 rad/s", SPEED, 1000.0),
        ("20 degC", TEMPERATURE, 293.15),
        ("-10 um", {"m": (1.0, 0.0), "um": (1e6, 0.0)}, -10e-6),
        ("-10 µm", {"m": (1.0, 0.0), "um": (1e6, 0.0)}, -10e-6),
        ("0.5", {"1": (1.0, 0.0)}, 0.5),
        ("18.238 krpm", SPEED, 18238 * math.pi / 30),
        ("10 rev/s", SPEED, 20 * math.pi),
        ("0.4375 inch", MORE["m"], 11.1125e-3),  # the 6207's ball, 7/16 inch
        ('0.4375"', MORE["m"], 11.1125e-3),
        ("300 kgf", MORE["N"], 2941.995),  # CGPM 1901: 9.80665 m/s2
        ("1000 lbf", MORE["N"], 4448.2216152605),  # NIST SP 811, table 8
        ("70 degF", TEMPERATURE, 294.26111111111111),  # NIST SP 811: (70 + 459.67)/1.8
        ("1 psi", MORE["Pa"], 6894.757293168361),  # NIST SP 811
        ("2 %", MORE["1"], 0.02),
        ("25 cSt", VISCOSITY, 25e-6),  # BIPM SI brochure, 8th edition: 1 St = 1e-4 m2/s
        ("25 mm²/s", VISCOSITY, 25e-6),
    ],
)
def test_values_become_si(value, scales, si):
    assert to_si(value, scales) == pytest.approx(si, rel=1e-15)  # one or two multiplications: observed 2e-16


@pytest.mark.parametrize("value", ["3600", "3600 N", "50 Hz", "fast", "", float("nan"), float("inf"), True, None, [1]])
def test_what_is_no_speed_is_refused(value):
    with pytest.raises(UserError):
        to_si(value, SPEED)


def test_every_display_unit_of_the_fmu_is_understood(model):
    for unit, scales in model.units.items():
        for symbol, (factor, offset) in scales.items():
            assert to_si(f"{factor * 3.0 + offset!r}{suffix(symbol)}", scales) == pytest.approx(3.0, rel=1e-12), unit


@pytest.mark.parametrize("name", shipped_scenes())
def test_shipped_scenes_load(model, name):
    scene = load_scene(name, model)
    t_end, step, load = (1.05, 2.5e-5, 3000.0) if name == "spall" else (0.4, 1e-4, 2994.0)
    assert (scene.t_end, scene.step, scene.inputs["shaft.F_y"](0.0)) == pytest.approx((t_end, step, load), rel=1e-12)


def test_scenes_mean_what_the_design_says(model):
    scenes = {name: load_scene(name, model) for name in shipped_scenes()}
    assert scenes["demo"].parameters == {"scene.statistics": "on"}
    assert scenes["demo"].inputs["shaft.omega"](0.0) == pytest.approx(1909.8788938, rel=1e-9)  # paper Table 2
    assert scenes["R"].parameters["ring.k_tilt"] == 2e4 and scenes["F"].parameters["ring.k_tilt"] == 1000.0
    assert scenes["R"].inputs["shaft.tilt_z"](0.0) == pytest.approx(math.radians(0.15), rel=1e-12)
    assert scenes["jam"].parameters["start.settle"] == 0.2 and scenes["jam"].parameters["ring.k_tilt"] == 500.0
    free, physical = scenes["paper"].parameters, scenes["physical"].parameters
    assert free["ring.tilt_mode"] == physical["ring.tilt_mode"] == "free" and free["scene.lubrication"] == "mixed"
    differ = {name: (free[name], physical[name]) for name in free if free[name] != physical[name]}
    assert differ == {"cage.centrifugal": ("off", "on"), "scene.cage": ("two_half", "elastic")}
    assert (free["cage.pocket_clearance"], free["cage.guide_clearance"]) == pytest.approx((1e-4, 2e-4), rel=1e-15)
    for name in ("R", "F", "jam"):
        assert scenes[name].parameters["ring.tilt_mode"] == "supported"
        assert scenes[name].parameters["scene.lubrication"] == "mixed"
        assert scenes[name].parameters["cage.pocket_clearance"] == pytest.approx(1e-4, rel=1e-15)


def test_dotted_nested_and_quoted_names_are_the_same(model, scene_file):
    texts = (
        "[parameters]\njoint.preload = 30\njoint.fit = '-20 um'",
        "[parameters.joint]\npreload = 30.0\nfit = -2e-5",
        "[parameters]\n'joint.preload' = '30 N'\n'joint.fit' = '-0.02 mm'",
    )
    scenes = [load_scene(scene_file(text), model) for text in texts]
    for scene in scenes:
        assert scene.parameters["joint.preload"] == 30.0
        assert scene.parameters["joint.fit"] == pytest.approx(-2e-5, rel=1e-15)


def test_outputs_by_pattern_in_the_order_of_the_fmu(model, scene_file):
    scene = load_scene(
        scene_file("[simulation]\noutputs = ['rivet[*].sigma_head_peak', 'ring.y', 'rivet[1].N', 'shaft.omega']"), model
    )
    assert scene.outputs[:2] == ("shaft.omega", "ring.y")
    assert [name for name in scene.outputs if name.endswith("_peak")] == [
        f"rivet[{k}].sigma_head_peak" for k in range(1, 10)
    ]
    assert "rivet[1].N" in scene.outputs and len(scene.outputs) == 12


def test_all_outputs_but_statistics_by_default(model):
    outputs = load_scene("demo", model).outputs
    assert set(outputs) == {*model.inputs, *model.outputs} - {
        name for name in model.outputs if name.startswith("stat.")
    }


def test_changes_win_over_the_file(model):
    scene = load_scene("R", model, ("--set", {"parameters": {"ring.k_tilt": 5.0}, "simulation": {"t_end": "10 ms"}}))
    assert scene.parameters["ring.k_tilt"] == 5.0 and scene.t_end == pytest.approx(0.01, rel=1e-15)
    assert scene.parameters["ring.tilt_mode"] == "supported"


def test_history_by_hand():
    t = np.array([-1.0, 0.0, 0.5, 1.0, 2.5, 3.0, 9.0])
    points = np.array([0.0, 1.0, 3.0]), np.array([1.0, 2.0, -2.0])
    assert History(*points)(t) == pytest.approx([1, 1, 1.5, 2, -1, -2, -2], rel=1e-15)
    assert History(*points, hold=True)(t).tolist() == [1, 1, 1, 2, 2, -2, -2]


@pytest.mark.parametrize(
    ("text", "unit"),
    [
        ("# measured\nt,Fr,other\n0,1,7\n0.1,3,8\n0.2,2.5,9\n", ", unit = 'kN'"),
        ("t [ms];Fr [kN]\n0;1\n100;3\n200;2,5\n", ""),
        ("t (s)\tFr (N)\n0\t1000\n0.1\t3000\n0.2\t2500\n", ", unit = 'N'"),
    ],
)
def test_points_and_columns_give_the_same_history(model, scene_file, tmp_path, text, unit):
    (tmp_path / "loads.csv").write_text(text)
    points = load_scene(
        scene_file("[inputs]\nshaft.F_y = { t = [0, '100 ms', 0.2], value = [1, '3 kN', 2.5], unit = 'kN' }"), model
    )
    column = load_scene(
        scene_file("[inputs]\nshaft.F_y = { file = 'loads.csv', column = 'Fr', time = 't'" + unit + " }"), model
    )
    t = np.linspace(0.0, 0.3, 31)
    assert points.inputs["shaft.F_y"](t) == pytest.approx(np.interp(t, [0, 0.1, 0.2], [1000, 3000, 2500]), rel=1e-14)
    assert column.inputs["shaft.F_y"](t) == pytest.approx(points.inputs["shaft.F_y"](t), rel=1e-14)


def test_communication_points_end_exactly(model):
    for t_end, step in ((0.4, 1e-4), (1e-3, 3e-4), (0.3, 0.1), (1e-4, 1e-4)):
        scene = load_scene("demo", model, ("test", {"simulation": {"t_end": t_end, "step": step}}))
        points = scene.communication_points()
        assert points[0] == 0.0 and points[-1] == t_end and len(points) == math.ceil(t_end / step - 1e-9) + 1
        assert np.all(np.diff(points) > 0.0)


def test_a_scene_that_is_not_there(model, tmp_path):
    with pytest.raises(UserError, match='scene: unknown name "dmeo"; did you mean "demo"'):
        load_scene("dmeo", model)
    with pytest.raises(UserError, match="none.toml: no such scene file"):
        load_scene(tmp_path / "none.toml", model)


# changes in a run -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["parquet", "csv"])
def test_a_scene_changes_parameters_in_the_run(tmp_path, kind):
    """At the first communication point from `at` on; the file of results says so."""
    path = tmp_path / "changing.toml"
    path.write_text(
        '[simulation]\nt_end = "2 ms"\noutputs = ["rivet[1].P", "rivet[2].P"]\n[parameters]\nscene.cage = "two_half"\n'
        '[[change]]\nat = "1.05 ms"\njoint.preload = "35 N"\n[[change]]\nat = "0.5 ms"\n"rivet[2].intact" = 0\n'
    )
    result = run(path)
    t, first, second = (result.data[name] for name in ("time", "rivet[1].P", "rivet[2].P"))
    np.testing.assert_array_equal(first, np.where(t < 1.15e-3, 20.0, 35.0))
    np.testing.assert_array_equal(second, np.where(t < 0.55e-3, 20.0, 0.0))
    expected = {"0.0005 s": {"rivet[2].intact": 0}, "0.00105 s": {"joint.preload": 35.0}}
    assert read_result(write_result(result, tmp_path / f"r.{kind}")).about["changes"] == expected
