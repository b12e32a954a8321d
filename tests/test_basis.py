"""One rule for what runs, and what figures rest on: without a scene the FMU's own parameters and inputs, a scene only
where it is named, and both said.
"""

import hashlib
import math
import re
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from commands import typed

from bearing_model.generated.variables import MeanStress
from riveted_bearing import build, read_result, run
from riveted_bearing.base.units import hours_text
from riveted_bearing.bearing.assumed import assumed_ranges, assumed_rows
from riveted_bearing.bearing.strength import Strength, assumed, in_words
from riveted_bearing.design.bench import Bench
from riveted_bearing.duty.assess import Runs, assess
from riveted_bearing.duty.mission import plan_mission
from riveted_bearing.duty.page import cards, ends_of, interval_text, passes_text, percent, width_text, write_page
from riveted_bearing.running.basis import basis, fast_speeds
from riveted_bearing.running.fmu import Model
from riveted_bearing.running.rainflow import FatigueLaw
from riveted_bearing.running.runner import provenance
from riveted_bearing.running.scene import load_scene
from riveted_bearing.running.scene_case import case_of, scene_case
from riveted_bearing.show.report import render, setting_rows
from riveted_bearing.studies.matrices import quasi_static_matrices
from riveted_bearing.studies.sweep import run_sweep
from riveted_bearing.studies.sweep_file import plan_sweep

ROOT = Path(__file__).resolve().parents[1]
OIL = '[parameters]\noil.nu_1 = "25 mm2/s"\noil.nu_2 = "5 mm2/s"\n[inputs]\noil.T = "40 degC"\nshaft.F_y = "3 kN"\nshaft.x = "20 um"\n'
NO_SCENE = "none: the FMU's own parameters and inputs"


@pytest.fixture
def warm(tmp_path):
    """A scene with an oil of two points, in the units of a data sheet."""
    path = tmp_path / "warm.toml"
    path.write_text(OIL)
    return path


# What is said ---------------------------------------------------------------------------------------------------------


def test_the_lines_of_the_default_fmu(model, fmu):
    """Digest by another hand; loads and speed of the paper's Table 2, oil and temperatures as docs/parameters.md has
    them.
    """
    rows = dict(basis(model, [load_scene(None, model)]))
    assert rows["bearing"].startswith("6207: ")
    assert rows["FMU"] == f"{fmu}, SHA-256 {hashlib.sha256(fmu.read_bytes()).hexdigest()[:12]}"
    assert (rows["scene"], rows["loads"], rows["speed"]) == (NO_SCENE, "F_x 515 N, F_y 2994 N", "18238 rev/min")
    assert rows["oil"] == "6 mPa.s at 85.851 degC"
    assert rows["temperatures"] == "inner ring, outer ring, balls, cage 20 degC" and "replaced" not in rows


def test_viscosity_is_that_at_the_oils_temperature(model, warm):
    """At oil.T_1 the kinematic viscosity is oil.nu_1: 25 mm2/s; the density is 900 kg/m3 at 85.85 degC and falls by
    7.5e-4 of that a kelvin.
    """
    rows = dict(basis(model, [load_scene(warm, model)]))
    eta = 25e-6 * 900.0 * (1.0 - 7.5e-4 * (40.0 - 85.8506))
    assert rows["oil"] == f"{1e3 * eta:.3g} mPa.s at 40 degC"
    thick = load_scene(None, model, ("test", {"parameters": {"oil.eta": 6}}))  # meant as mPa.s
    assert dict(basis(model, [thick]))["oil"].endswith(
        "(few oils in bearings have less than 0.3 or more than 3000 mPa.s)"
    )
    assert rows["loads"] == "F_x 515 N, F_y 3 kN"  # as it was written


def test_several_scenes_are_a_range(model, own):
    scenes = [
        load_scene(None, model, ("test", {"inputs": {"shaft.F_y": load, "ring.T_i": 313.15}}))
        for load in (600.0, 2994.0)
    ]
    rows = dict(basis(model, scenes))
    assert rows["loads"] == "F_x 515 N, F_y 600 to 2994 N"
    assert rows["temperatures"] == "inner ring 40 degC, outer ring 20 degC, balls 20 degC, cage 20 degC"
    other = Model(own)
    rows = dict(basis(other, [load_scene(None, other), load_scene("demo", other)]))
    assert rows["scene"] == f"{NO_SCENE}, demo" and rows["replaced"] == "the scene has shaft.F_y 2994 N for 4100 N"


@pytest.mark.parametrize("kind", ["linear", "hold"])
@pytest.mark.parametrize(
    ("t", "seen", "said"),
    [
        ([0.0, 0.05], (3000, 6000), ""),
        ([-0.2, 0.05], (5400, 6000), "shaft.omega changes from -0.2 s to 0.05 s, the run"),
        ([0.05, 0.2], (3000, 4000), "shaft.omega changes from 0.05 s to 0.2 s, the run goes from 0 to 0.1 s"),
        ([100.0, 100.3], (3000, 3000), "shaft.omega changes from 100 s to 100.3 s, no change of it acts: the run"),
        ([-2.0, -1.0], (6000, 6000), "shaft.omega changes from -2 s to -1 s, no change of it acts: the run"),
    ],
)
def test_what_of_an_input_lies_outside_the_run(model, kind, t, seen, said):
    """A record whose clock began before the run, or that ends after it: its part in the run is what stands in the lines."""
    if kind == "hold":  # its only change is at the second time
        seen = [6000 if t[1] <= 0.0 else 3000, 6000 if t[1] <= 0.1 else 3000]
        said = said.replace(f"from {t[0]:g} s", f"from {t[1]:g} s") if not 0.0 < t[1] <= 0.1 else ""
        said = said.replace(" s, the run", " s, no change of it acts: the run") if "acts" not in said else said
    speed = {"t": t, "value": [3000, 6000], "unit": "rev/min", "interpolation": kind}
    document = {"simulation": {"t_end": 0.1}, "inputs": {"shaft.omega": speed}}
    rows = dict(basis(model, [load_scene(None, model, ("test", document))]))
    assert rows["speed"] == f"{' to '.join(dict.fromkeys(map(str, seen)))} rev/min"
    assert rows.get("not reached", "").startswith(said) and bool(said) == ("not reached" in rows)


def test_a_change_after_the_end_is_not_reached(model):
    change = [{"at": "0.1 s", "joint.mu": 0.3}, {"at": 0.05, "joint.mu": 0.2}]
    scene = load_scene(None, model, ("test", {"simulation": {"t_end": 0.1}, "change": change}))
    assert dict(basis(model, [scene]))["not reached"] == "joint.mu at 0.1 s, the run ends at 0.1 s"


def test_speeds_that_few_bearings_reach_are_told_of_every_scene(model, tmp_path):
    """A speed without its unit: 3,000 "rev/min" of a 6207 are 28,648, at which n d_m is 1.53 million mm/min."""
    for inputs, told in (
        ({"shaft.omega": 3000}, True),
        ({"shaft.omega": 0.0, "housing.omega": -3000}, True),
        ({"shaft.omega": 3000, "housing.omega": 3000}, False),
        ({"shaft.omega": "3000 rev/min"}, False),
    ):
        scene = load_scene(None, model, ("test", {"inputs": inputs}))
        assert bool(fast_speeds(model, [load_scene("demo", model), scene])) == told
        document = {"simulation": {"t_end": 0.2}, "inputs": inputs, "point": [{"hours": 1}]}
        warnings = plan_mission("m", document, model, tmp_path / "m.toml").slow
        assert any("n d_m" in text for text in warnings) == told


def test_a_prescribed_motion_takes_no_loads(model):
    scene = load_scene("demo", model, ("test", {"parameters": {"ring.motion": "prescribed"}}))
    assert dict(basis(model, [scene]))["loads"] == "none: the motion of the inner ring is prescribed"


def test_a_run_keeps_and_prints_what_it_rests_on(own, tmp_path):
    done = typed('run demo --t-end "1 ms" --no-plot', "--fmu", own, "--out", tmp_path)
    assert done.exit_code == 0, done.output
    assert "the scene has shaft.F_y 2994 N for 4100 N" in done.stdout
    assert hashlib.sha256(own.read_bytes()).hexdigest()[:12] in done.stdout
    result = read_result(tmp_path / "demo.parquet")
    assert result.about["basis"]["loads"] == "F_x 515 N, F_y 2994 N"
    assert result.about["replaced"] == ["shaft.F_y 2994 N for 4100 N"]
    page = render(result)
    assert all(
        text in page
        for text in ("the scene has shaft.F_y 2994 N for 4100 N", "18238 rev/min", "6 mPa.s at 85.851 degC")
    )


def mission_of(path, model, **document):
    """A mission of two points of 10 ms."""
    common = {
        "simulation": {"t_end": 0.01},
        "parameters": {"start.settle": 0.002},
        "life": {"min_seeds": 3, "max_seeds": 3},
    }
    return plan_mission(
        "trial",
        common | {"point": [{"hours": 10}, {"hours": 30, "inputs": {"shaft.omega": "9000 rev/min"}}]} | document,
        model,
        path,
    )


def test_a_mission_without_a_scene_has_the_fmus_own_loads(own):
    """Each point shows its load and speed, those that it does not set too."""
    mission = mission_of(Path("trial.toml"), Model(own))
    assert [part.load for part in mission.parts] == ["F_x 515 N, F_y 4100 N"] * 2
    assert [part.speed for part in mission.parts] == ["18238 rev/min", "9000 rev/min"]
    assert all(part.values["shaft.F_y"] == 4100.0 for part in mission.parts)
    assert "shaft.F_y" not in mission.cases[0].scene.inputs
    rows = dict(mission.basis)
    assert (rows["scene"], rows["loads"], rows["speed"]) == (NO_SCENE, "F_x 515 N, F_y 4100 N", "9000 to 18238 rev/min")
    assert "replaced" not in rows


def test_a_mission_that_names_a_scene_says_what_it_replaces(own, tmp_path):
    mission = mission_of(Path("trial.toml"), Model(own), scene="demo")
    life = assess(mission, lambda counts: [np.full((n, 9, 2), 1e-4) for n in counts])
    page = write_page(life, tmp_path / "life.html", []).read_text()
    for text in (
        "the scene has shaft.F_y 2994 N for 4100 N",
        "9000 to 18238 rev/min",
        "amplitude 250 MPa (R = -1) at 2e+06 cycles",
        mission.basis[1][1],
    ):
        assert text in page
    assert re.findall(r"<td>F_x 515 N, F_y 2994 N</td><td>(\d+) rev/min</td>", page) == ["18238", "9000"]


def test_the_curve_says_what_of_it_is_assumed(model, tmp_path):
    """A mission for the default FMU: nobody gave its S-N curve; what a scene's parameter or a section [sn] leaves out
    stays the 6207's, and is named where it makes a difference.
    """
    point = {"simulation": {"t_end": 0.06}, "point": [{"hours": 1.0}]}
    whole = {"sigma_D": "230 MPa", "N_D": 2e6, "k_1": 8, "k_2": 15, "sigma_m": "785 MPa"}

    def said(**more):
        curve = dict(plan_mission("m", point | more, model, tmp_path / "m.toml").basis)["S-N curve"]
        return curve.partition("MPa; ")[2]  # behind the mean stress's sigma_m, the last figure before it

    def without(*names, **more):
        return {name: value for name, value in whole.items() if name not in names} | more

    paper = "assumed, that of 15CrMn"
    assert said() == paper
    assert said(parameters={"fatigue": {"sigma_D": "230 MPa"}}) == f"N_D, k_1, k_2, sigma_m {paper}"
    assert said(sn=without("sigma_m")) == f"sigma_m {paper}"
    assert said(sn=without("sigma_m", "k_2", rule="haibach")) == f"sigma_m {paper}"
    assert said(sn=whole) == "" and said(sn=without("k_2", rule="elementary")) == ""
    assert said(sn=without("sigma_m"), parameters={"fatigue": {"sigma_m": "600 MPa"}}) == ""


def test_what_of_a_curve_matters_and_what_follows():
    """Goodman takes the strength, Morrow its own coefficient, a rough surface the strength as well; a table has no
    slopes; a strength of one's own gives the rest by rule.
    """
    slopes = frozenset(f"fatigue.{name}" for name in ("N_D", "k_1", "k_2"))
    given = Strength(FatigueLaw(), given=slopes | {"fatigue.sigma_D"})
    paper = "assumed, that of 15CrMn"
    assert assumed(given) == f"; sigma_m {paper}" and assumed(given, ["fatigue.sigma_m"]) == ""
    swt = replace(given, law=FatigueLaw(mean_stress=MeanStress.SWT))
    assert assumed(swt) == "" and assumed(replace(swt, rough=True)) == f"; sigma_m {paper}"
    assert assumed(replace(given, law=FatigueLaw(mean_stress=MeanStress.MORROW))) == f"; sigma_f {paper}"
    assert assumed(Strength(swt.law, table=(np.array([1e8, 3e8]), np.array([1e7, 1e4])))) == ""
    stronger = Strength(FatigueLaw(sigma_D=300e6, sigma_m=942e6), given=slopes)
    assert assumed(stronger, ["fatigue.sigma_m"]) == "; sigma_D by rule from the strength"


def test_what_a_scene_gives_does_not_follow_by_rule(fmu, monkeypatch):
    monkeypatch.setattr(Model, "origin", {"joint.preload": "rule", "joint.fit": "rule", "shaft.F_y": "rule"})
    model = Model(fmu)
    scene = load_scene(
        None, model, ("--set", {"parameters": {"joint": {"preload": "30 N"}}, "inputs": {"shaft": {"F_y": "1 kN"}}})
    )
    assert provenance(model, scene, scene.t_end)["not_given"] == {"by rule": "joint (fit)"}


def test_entries_of_arrays_have_meaning_and_unit():
    """One pocket's diameter in the table of all parameters is no bare 2e-05."""
    result = SimpleNamespace(parameters={"pocket[3].dD": 2e-5, "rivet[2].dfit": -1e-6, "ball[1].dD": 0.0}, about={})
    rows = {row[0]: row[1:] for row in setting_rows(result)}
    assert rows["pocket[3].dD"] == ("Excess of the pocket's diameter", "20", "µm", True)
    assert rows["rivet[2].dfit"][1:] == ("-1", "µm", True) and rows["ball[1].dD"][1:] == ("0", "µm", False)


def test_the_curve_in_words():
    law = FatigueLaw(sigma_D=230e6, k_1=7.0)
    assert (
        in_words(Strength(law))
        == "amplitude 230 MPa (R = -1) at 2e+06 cycles, slope 7 above it, 15 below; mean stress: goodman, sigma_m 785 MPa"
    )
    assert "slope 7 above it, 13 below" in in_words(Strength(law, "haibach"))  # 2 k - 1
    assert "T_S 1.25, survival 97.5 %" in in_words(Strength(law, T_S=1.25, survival=0.975))
    assert "no damage below" in in_words(Strength(law, "original"))
    assert "table of 2 amplitudes from 100 to 300 MPa" in in_words(
        Strength(law, table=(np.array([1e8, 3e8]), np.array([1e7, 1e4])))
    )


def test_info_is_of_the_fmu_that_is_named(own):
    assert case_of().designation == "6207" and case_of(None, own).load.F_y == 4100.0
    shown = typed("info --fmu", own).stdout
    assert "F_y 4100 N" in shown and "as an example" not in shown and "SHA-256" in shown
    assert "no bearing is named: this is the 6207, as an example" in typed("info").stdout


# Words of results -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("hours", "text"),
    [
        (3.76e-8, "< 1 s"),
        (0.00123, "4.43 s"),
        (0.0123, "44.3 s"),
        (0.0323, "1.94 min"),
        (0.123, "0.123 h"),
        (53.21, "53.2 h"),
        (4263.0, "4,260 h"),
        (1e6, "1,000,000 h"),
        (6.8e8, "> 1e6 h"),
        (math.inf, "no damage"),
    ],
)
def test_hours(hours, text):
    assert hours_text(hours) == text


@pytest.mark.parametrize(
    ("life", "hours", "text"),
    [
        (0.2, 40.0, "fails within the first pass, after 0.2 h"),
        (100.0, 40.0, "2.5 passes"),
        (1e8, 40.0, "> 25,000 passes"),
        (math.inf, 40.0, "no damage"),
    ],
)
def test_passes(life, hours, text):
    assert passes_text(life, hours) == text


@pytest.mark.parametrize(
    ("low", "high", "interval", "width"),
    [
        (80.0, 125.0, "80 h – 125 h", "half-width 25 % of life"),
        (1.0, 150.0, "below 150 h", "open at its lower end"),
        (80.0, 1e5, "above 80 h", "open at its upper end"),
        (2e6, 1e9, "> 1e6 h", "open at its upper end"),
        (
            0.6,
            1.7e4,
            "open at both ends",
            "open at its lower and its upper end: more seeds (max_seeds) or a longer t_end close it",
        ),
    ],
)
def test_intervals(low, high, interval, width):
    """Life 100 h; an end eleven times away, a half-width of ten times life, tells nothing."""
    estimate = SimpleNamespace(life=100.0, low=low, high=high, half_width=0.5 * math.log(high / low))
    life = SimpleNamespace(estimate=estimate, low=low)
    assert interval_text(*ends_of(life)) == interval and width_text(life).startswith(width)
    assert percent(0.5 * math.log(1.7e4 / 0.6)) == "> 1,000 %"


def test_the_cards_of_a_wild_life(model):
    """Damages that scatter by ten decades with three seeds: no half-width in per cent, no share of a pass."""
    mission = mission_of(Path("trial.toml"), model)
    wild = np.array([1e-9, 1.0, 1e3])[:, None, None] * np.ones((3, 9, 2))
    shown = {
        title: (value, remark)
        for title, value, remark in cards(assess(mission, lambda counts: [wild[:n] for n in counts]))
    }
    assert shown["Mission"][1].startswith("fails within the first pass, after ")
    assert "max_seeds" in shown["90 % interval"][1]


def test_no_page_names_an_index_in_which_the_package_is_not():
    """An extra comes from a checkout or from the wheel's file."""
    places = [
        ROOT / "README.md",
        *(ROOT / "docs").rglob("*.md"),
        *(ROOT / "examples").rglob("*.*"),
        *(ROOT / "riveted_bearing").rglob("*.py"),
    ]
    assert [
        path
        for path in places
        if path.suffix in (".md", ".py", ".ipynb") and "riveted-bearing[" in path.read_text(encoding="utf-8")
    ] == []


# Units and assumptions ------------------------------------------------------------------------------------------------


def test_values_are_shown_as_they_were_written(warm):
    """A report in the units of the scene; what the scene does not set in those in which people read it."""
    page = render(run(warm, t_end=1e-3))
    cells = dict(
        re.findall(r"<code>([\w.]+)</code></td><td>[^<]*</td><td class=\"n\">([^<]*</td><td>[^<]*)</td>", page)
    )
    units = {name: cell.replace("</td><td>", " ").strip() for name, cell in cells.items()}
    expected = {
        "oil.nu_1": "25 mm2/s",
        "oil.T": "40 degC",
        "shaft.F_y": "3 kN",
        "shaft.x": "20 µm",
        "shaft.omega": "18,238 rev/min",
    }
    expected |= {
        "oil.T_1": "40 degC",
        "bearing.E": "207 GPa",
        "bearing.P_d": "15 µm",
        "bearing.D": "11.11 mm",
        "joint.fit": "-10 µm",
        "oil.eta": "6 mPa.s",
    }
    assert {name: units[name] for name in expected} == expected


def names_of(result):
    return {row.name for row in assumed_rows(result)}


CLEARANCES = {"cage.pocket_clearance", "cage.guide_clearance"}
OF_4109 = {
    "oil.A",
    "oil.B",
    "oil.C",
    "oil.alpha",
    "oil.rho",
}  # stay those of an aviation oil if only a viscosity is given


def test_assumed_is_what_nobody_gave(model, warm):
    """Both points of the oil give its viscosity, its flow the mixture's density; one point, or a flow of zero, does
    not.  Roughness moves a stress in mixed lubrication alone, so that a study of the stress leaves it out in full film.
    """
    everything = CLEARANCES | OF_4109 | {"oil.eta", "oil.rho_mix", "oil.sigma_race", "oil.T", "cage.T"}
    assert names_of(run(warm, t_end=2e-4)) == everything - {"oil.eta", "oil.T"}
    assert names_of(run(t_end=2e-4, parameters={"oil.nu_2": "6 mm2/s", "oil.flow": 0.0})) == everything
    flow = run(t_end=2e-4, parameters={"oil.eta": "6 mPa.s", "oil.flow": "1 L/min"}, inputs={"cage.T": "80 degC"})
    assert names_of(flow) == everything - {"oil.eta", "oil.rho_mix", "cage.T"}
    factors = everything - {"oil.T", "cage.T", "oil.sigma_race"}
    assert set(assumed_ranges(model)) == factors
    assert set(assumed_ranges(model, load_scene(warm, model))) == factors - {"oil.eta"}
    mixed = load_scene(None, model, ("test", {"parameters": {"scene.lubrication": "mixed"}}))
    assert set(assumed_ranges(model, mixed)) == factors | {"oil.sigma_race"}


def test_a_named_oil_is_not_assumed(model, tmp_path):
    path = tmp_path / "pao.toml"
    path.write_text('oil = "PAO 68"\n')
    done = typed('run --set "oil=PAO 68" --t-end "1 ms" --no-plot --out', tmp_path)
    assert done.exit_code == 0 and "PAO ISO VG 68, " in done.output
    refused = typed('run --set "oil=PAOO 68" --t-end "1 ms"')
    assert refused.exit_code and 'did you mean "PAO"' in refused.output
    found = run(path, t_end=2e-4)
    assert names_of(found) == CLEARANCES | {"oil.rho_mix", "oil.sigma_race", "oil.T", "cage.T"}
    assert found.about["basis"]["oil"].startswith("PAO ISO VG 68, ")
    assert load_scene(path, model).replaced == ("oil PAO ISO VG 68 for its own",)


def test_clearances_of_the_bearings_own_file_are_not_assumed(model):
    given = SimpleNamespace(
        parameters=model.parameters,
        default=model.default,
        bearing="6309: own",
        origin={"cage.pocket_clearance": "yours", "cage.guide_clearance": "rule", "oil.alpha": "PAO ISO VG 68 oil"},
    )
    by_rule = {"cage.land_width", "cage.land_x", "joint.preload", "joint.fit", "joint.swell", "bearing.P_d"}
    by_rule |= {"ring.m", "ring.c", "ring.J_t", "ring.c_tilt"}  # rivet and cage's section are the FMU's own
    assert set(assumed_ranges(given)) == OF_4109 - {"oil.alpha"} | by_rule | {
        "cage.guide_clearance",
        "oil.eta",
        "oil.rho_mix",
    }


# The same bits, whether the FMU's own inputs are written out or not ---------------------------------------------------

SHORT = {"simulation": {"t_end": 0.01}, "parameters": {"start.settle": 0.002}}


@pytest.fixture(scope="module")
def other(tmp_path_factory):
    """An FMU of the 6309, three minutes the first time."""
    return Model(build("6309", out=tmp_path_factory.mktemp("6309") / "my6309.fmu"))


def written_out(model):
    """All inputs of the FMU as a document would set them."""
    return {"inputs": {name: model.default(variable) for name, variable in model.inputs.items()}}


def variants(model):
    """Documents without a scene, with the FMU's own inputs, and with the scene demo."""
    return {}, written_out(model), {"scene": "demo"}


def same(one, two):
    """Whether all figures of two rows of sweeps are the same bits, but clocks and what says which run it was."""
    names = [name for name in one if name not in ("key", "scene", "date") and "time" not in name]
    return "stat.sigma_head_p999" in names and all(
        one[name].tolist() == two[name].tolist() or np.array_equal(one[name], two[name], True) for name in names
    )


@pytest.mark.slow
def test_a_run_of_another_bearing(other):
    own = run(fmu=other.path, t_end=2e-3)
    out = run(fmu=other.path, t_end=2e-3, **written_out(other))
    demo = run("demo", fmu=other.path, t_end=2e-3)
    assert all(np.array_equal(own.data[name], out.data[name]) for name in own.data)
    assert own.data["shaft.F_y"][0] == 5300.0
    assert demo.data["shaft.F_y"][0] == 2994.0 and not np.array_equal(own.data["ring.y"], demo.data["ring.y"])


@pytest.mark.slow
def test_a_sweep_of_another_bearing(other, client, tmp_path):
    own, out, demo = (
        run_sweep(plan_sweep("s", SHORT | document, other, tmp_path / "s.toml"), tmp_path / str(i), client)
        for i, document in enumerate(variants(other))
    )
    assert same(own, out) and not same(own, demo) and demo["shaft.F_y"].tolist() == [2994.0]


@pytest.mark.slow
def test_a_life_of_another_bearing(other, client, tmp_path):
    found = []
    for i, document in enumerate(variants(other)):
        mission = mission_of(tmp_path / "trial.toml", other, **document)
        runs = Runs(mission, other, tmp_path / str(i), lambda: client)
        found.append((assess(mission, runs).estimate.life, np.array(runs([3, 3]))))
    own, out, demo = found
    assert own[0] == out[0] and np.array_equal(own[1], out[1]) and np.any(own[1] != demo[1])


@pytest.mark.slow
def test_the_bench_of_sensitivity_and_optimize_on_another_bearing(other, client, tmp_path):
    own, out, demo = (
        Bench(tmp_path / "b.toml", SHORT | document, other, tmp_path / str(i), lambda: client)(
            ["joint.preload"], [[20.0]], ["stress", "friction"]
        )
        for i, document in enumerate(variants(other))
    )
    assert np.array_equal(own, out) and np.all(own != demo)


@pytest.mark.slow
def test_matrices_and_info_of_another_bearing(other, tmp_path):
    path = tmp_path / "own.toml"
    path.write_text(
        "[inputs]\n" + "".join(f"{name} = {value!r}\n" for name, value in written_out(other)["inputs"].items())
    )
    own, out, demo = (quasi_static_matrices(scene_case(source, other), [500.0])[0] for source in (None, path, "demo"))
    assert np.array_equal(own.K_static, out.K_static) and not np.array_equal(own.K_static, demo.K_static)
    done = typed('matrices --static --speed "500 rad/s"', "--fmu", other.path, "--out", tmp_path)
    assert done.exit_code == 0
    text = (tmp_path / "my6309_matrices.csv").read_text()
    assert "# loads: F_x 883 N, F_y 5300 N\n" in text and f"{own.K_static[0, 0]:.9g}" in text
    case = case_of(None, other.path)
    assert (case.designation, case.catalogue["C"], case.rivet) == ("6309", 53e3, None)
    assert replace(case, rivet={}).bearing.Z == 8
