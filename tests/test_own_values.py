"""A designer's own bearing: nothing of the paper's 6207 stands in for a value without being said, and a value given
twice is refused by its key.
"""

import math
import re
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from commands import typed
from lxml import etree

from bearing_model.generated import variables
from bearing_model.physics.viscosity import Oil
from rivet_model import stiffness
from rivet_model.closed_form import stack_stiffness
from rivet_model.geometry import Geometry
from rivet_model.load_cases import COARSE, Joint
from riveted_bearing import UserError, run
from riveted_bearing.base.file_kinds import KINDS, check_keys
from riveted_bearing.base.toml_files import to_toml
from riveted_bearing.bearing import assumed
from riveted_bearing.bearing import oil as oils
from riveted_bearing.bearing.bearing_file import bearing_case
from riveted_bearing.bearing.designations import known_bearings
from riveted_bearing.bearing.oil import viscosity
from riveted_bearing.bearing.plausible import doubts
from riveted_bearing.cli import info_tables
from riveted_bearing.design.bench import Bench
from riveted_bearing.duty.mission import plan_mission
from riveted_bearing.duty.page import mission_text, time_text
from riveted_bearing.running import preload, summary
from riveted_bearing.running.basis import basis
from riveted_bearing.running.fmu import Model
from riveted_bearing.running.scene import load_scene
from riveted_bearing.running.scene_case import case_of
from riveted_bearing.show.report import render
from riveted_bearing.studies.matrices import scene_at

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "fmus"))
from generate import load_table, write_description

OWN = 'designation = "6309"\nZ = 8\n'


def read(tmp_path, text):
    """The Case of a bearing file."""
    path = tmp_path / "mine.toml"
    path.write_text(text, encoding="utf-8")
    return bearing_case(path)


def shown(*arguments):
    """What the program prints."""
    done = typed("", *arguments)
    assert done.exit_code == 0, done.output
    return done.stdout


def scene_of(model, *documents):
    return load_scene(None, model, *((f"document {i}", document) for i, document in enumerate(documents, 1)))


# What a file is -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("section", ["cage", "rings", "balls", "rivet"])
def test_a_file_of_materials_alone_is_a_bearing_file(tmp_path, section):
    """Without designation, balls and pitch diameter: those are the 6207's, which is said."""
    path = tmp_path / "mine.toml"
    path.write_text(
        f"[{section}]\n{'E' if section != 'rivet' else 'head_diameter'} = 2.7e-3\n".replace("E = 2.7e-3", "")
    )
    assert case_of(path).origin["bearing.D"] == "6207"
    text = " ".join(shown("info", path).split())
    assert "of the 6207 Z, bearing (D, d_m), shaft (F_x, F_y, omega)" in text
    with pytest.raises(UserError, match="this is a bearing file, not a scene"):
        load_scene(path, SimpleNamespace())


@pytest.mark.parametrize(("key", "value", "allowed"), [("bore", "40 mm", "45 mm"), ("width", "0.03", "0.025")])
def test_a_boundary_dimension_that_contradicts_the_designation_is_refused(tmp_path, key, value, allowed):
    written = f'"{value}"' if "mm" in value else value
    with pytest.raises(UserError, match=rf"catalogue.{key} = .*{value}.*: {allowed}.* is allowed, of the 6309"):
        read(tmp_path, f"{OWN}[catalogue]\n{key} = {written}\n")
    assert read(tmp_path, f'{OWN}[catalogue]\nbore = "45 mm"\nC = "50 kN"\n').catalogue["C"] == 50e3


@pytest.mark.parametrize("outside", ["40 mm", "90 mm", "99.7 mm"])
def test_balls_need_a_bore_below_the_outside_diameter(tmp_path, outside):
    """The smallest ball of the rule, 1/8 inch, is 0.325 of the difference at most: 90 mm + 3.175 mm/0.325."""
    ratings = 'width = "23 mm"\nC = "20 kN"\nC_0 = "15 kN"\n'
    with pytest.raises(
        UserError,
        match=rf"catalogue.outside_diameter = '{outside}': at least 99.77 mm is allowed with catalogue.bore = 90 mm",
    ):
        read(tmp_path, f'designation = "mine"\n[catalogue]\nbore = "90 mm"\noutside_diameter = "{outside}"\n{ratings}')
    given = (
        'Z = 8\n[parameters]\nbearing.D = "15.081 mm"\nbearing.d_m = "65 mm"\n'  # the bore against these balls' groove
    )
    with pytest.raises(
        UserError, match="catalogue.bore = '90 mm': at most 4.* mm is allowed for an inner ring below its groove"
    ):
        read(
            tmp_path,
            f'designation = "mine"\n{given}[catalogue]\nbore = "90 mm"\noutside_diameter = "{outside}"\n{ratings}',
        )


# What follows by rule -------------------------------------------------------------------------------------------------


def test_seats_are_the_catalogues(tmp_path):
    """45 and 100 mm; by d_m -+ D/0.6, which is for unknown bearings, 43.4 and 101.6 mm.  The 6207 keeps its rule."""
    case = read(tmp_path, OWN)
    assert (case.values["ring.bore"], case.values["ring.outside"]) == (0.045, 0.1)
    assert case.origin["ring.bore"] == "rule" and bearing_case("6207").values["ring.bore"] == 0.0
    assert read(tmp_path, f'{OWN}[parameters]\nring.bore = "44 mm"\n').values["ring.bore"] == 0.044


def test_the_support_against_tilt_is_similar(tmp_path):
    """Twice as large: eight times as stiff, 16 times as damped, so that the damping ratio c/sqrt(k J) stays."""
    case = bearing_case("6309")
    r = (0.045 / 0.035) ** 2 * 25.0 / 17.0
    assert case.values["ring.k_tilt"] == pytest.approx(2e4 * r, rel=1e-5)
    ratio = case.values["ring.c_tilt"] / math.sqrt(case.values["ring.k_tilt"] * case.values["ring.J_t"])
    assert ratio == pytest.approx(1.0 / math.sqrt(2e4 * 1.2e-4), rel=1e-5)


@pytest.mark.parametrize(("speed", "settle"), [("500 rev/min", 1.8), ("9000 rev/min", 0.1), ("30000 rev/min", 0.05)])
def test_settling_lasts_fifteen_revolutions(tmp_path, speed, settle):
    """At least 50 ms, which the 6207 keeps."""
    case = read(tmp_path, f'{OWN}[inputs]\nshaft.omega = "{speed}"\n')
    assert case.values["start.settle"] == pytest.approx(settle, rel=1e-5)
    assert read(tmp_path, f"{OWN}[parameters]\nstart.settle = 0.2\n").values["start.settle"] == 0.2
    assert bearing_case("6207").values["start.settle"] == 0.05 and "start.settle" not in bearing_case("6207").origin


def test_the_lands_stiffness_goes_with_the_cages_material(tmp_path):
    """Hertz: K ~ E*, 1/E* of cage and ring together."""
    case = read(tmp_path, f'{OWN}[cage]\nmaterial = "PEEK"\n')

    def softness(E, nu):
        return (1 - nu**2) / E + (1 - 0.3**2) / 207e9

    assert case.values["cage.K_land"] == pytest.approx(2e9 * softness(110e9, 0.33) / softness(4.1e9, 0.4), rel=1e-5)
    assert bearing_case("6309").values["cage.K_land"] == 2e9


def test_the_knee_goes_with_a_rivets_strength(tmp_path):
    """A named steel of which the strength alone is another one: the knee keeps the steel's own share, 117/365."""
    case = read(tmp_path, f'{OWN}[rivet]\nmaterial = "C10C"\nstrength = "500 MPa"\n')
    assert case.values["fatigue.sigma_D"] == pytest.approx(500e6 * 117 / 365)
    assert (case.origin["fatigue.sigma_m"], case.origin["fatigue.sigma_D"]) == ("yours", "rule")
    case = read(tmp_path, f'{OWN}[rivet]\nmaterial = "C10C"\nstrength = "500 MPa"\nendurance = "120 MPa"\n')
    assert case.values["fatigue.sigma_D"] == 120e6 and case.origin["fatigue.sigma_D"] == "yours"


# Oil given once -------------------------------------------------------------------------------------------------------

POINTS = '[parameters]\noil.nu_1 = "100 mm2/s"\noil.nu_2 = "11 mm2/s"\n'


def test_two_points_give_a_bearings_viscosity(tmp_path):
    """oil.eta and oil.beta at oil.T_0 are those of the points: an FMU made of this file does not have the 6207's."""
    case, law = read(tmp_path, OWN + POINTS), Oil(100e-6, 313.15, 11e-6, 373.15)
    T_0, rho = (variables.PARAMETERS[f"oil.{name}"].start for name in ("T_0", "rho"))
    assert case.values["oil.eta"] == pytest.approx(rho * law.nu(T_0), rel=1e-5)
    assert case.values["oil.beta"] == pytest.approx(law.beta(T_0), rel=1e-5)
    assert case.origin["oil.eta"] == "rule"
    start = {name: value for name, value in case.values.items() if name in variables.PARAMETERS and name[:4] == "oil."}
    for T in (313.15, 373.15):  # as an FMU of this file has it at its start
        density = rho * (1.0 - 7.5e-4 * (T - T_0))
        assert viscosity(start, start, T) == pytest.approx(density * law.nu(T), rel=1e-5)


@pytest.mark.parametrize("eta", ["6 mPa.s", "20 mPa.s"])
def test_a_viscosity_given_twice_is_refused(tmp_path, model, eta):
    """The 6207's own value, too, which the FMU could not tell from one that nobody gave."""
    words = r"oil.eta = '.*': oil.nu_1 and oil.nu_2 mean 14.55 mPa.s at oil.T_0 = 85.85 degC: leave"
    with pytest.raises(UserError, match=words):
        read(tmp_path, f'{OWN}{POINTS}oil.eta = "{eta}"\n')
    points = {"oil": {"nu_1": "100 mm2/s", "nu_2": "11 mm2/s"}}
    with pytest.raises(UserError, match=f"document 1: {words}"):
        scene_of(model, {"parameters": {"oil": points["oil"] | {"eta": eta}}})
    assert read(tmp_path, f'{OWN}{POINTS}oil.eta = "14.6 mPa.s"\n').values["oil.eta"] == pytest.approx(14.6e-3)


def test_the_later_document_decides(model):
    """Two points of --set replace the viscosity of a scene's file, and a viscosity of --set that of the points."""
    eta, points = {"oil": {"eta": "6 mPa.s"}}, {"oil": {"nu_1": "100 mm2/s", "nu_2": "11 mm2/s"}}
    for documents, expected in (((eta, points), "14.6"), ((points, {"oil": {"eta": "8 mPa.s"}}), "8")):
        rows = dict(basis(model, [scene_of(model, *({"parameters": document} for document in documents))]))
        assert float(rows["oil"].split()[0]) == pytest.approx(float(expected))


def test_points_beside_an_fmu_with_a_viscosity_of_its_own(model, monkeypatch):
    """An FMU of 12 mPa.s whose points are left at the 6207's: a scene's two points alone decide."""
    own = Model.default

    def default(self, variable):
        return 12e-3 if variable.name == "oil.eta" else own(self, variable)

    monkeypatch.setattr(Model, "default", default)
    scene = scene_of(model, {"parameters": {"oil": {"nu_1": "100 mm2/s", "nu_2": "11 mm2/s"}}})
    assert scene.parameters["oil.eta"] == pytest.approx(14.55e-3, rel=1e-3)
    assert dict(basis(model, [scene]))["oil"].startswith("14.6 mPa.s")


@pytest.mark.parametrize(("given", "other"), [("nu_1", "nu_2"), ("nu_2", "nu_1")])
def test_one_point_is_no_oil(tmp_path, model, given, other):
    """A bearing file needs the other one; of a scene the other one is the FMU's, and said to be assumed."""
    value = {"nu_1": "30 mm2/s", "nu_2": "8 mm2/s"}[given]
    with pytest.raises(UserError, match=f"oil.{given} = '{value}': give oil.{other} at oil.T_{other[-1]} too"):
        read(tmp_path, f'{OWN}[parameters]\noil.{given} = "{value}"\n')
    rows = dict(basis(model, [scene_of(model, {"parameters": {"oil": {given: value}}})]))
    paper = {"nu_1": "oil.nu_1 25 mm2/s at 40 degC", "nu_2": "oil.nu_2 5 mm2/s at 100 degC"}[other]
    assert rows["oil"].endswith(f"; {paper} is assumed")


# Preload at temperature -----------------------------------------------------------------------------------------------


def test_the_basis_has_the_preload_at_temperature(model):
    """The FMU's own P at its start, with the reason; nothing more where cage and assembly are equally warm."""
    warm = {
        "inputs": {"oil.T": "90 degC", "cage.T": "90 degC", "ball.T": "90 degC", "ring.T_i": 363.15, "ring.T_e": 363.15}
    }
    scene = scene_of(model, warm, {"simulation": {"t_end": 1e-4, "outputs": ["rivet[*].P"]}})
    text = dict(basis(model, [scene]))["preload"]
    P = run(None, fmu=model.path, t_end=1e-4, inputs=warm["inputs"], outputs=["rivet[*].P"]).data["rivet[1].P"][0]
    assert P > 50.0 and text.startswith(f"20 N at 20 degC, {P:.3g} N with the cage at 90 degC: the cage expands more")
    assert dict(basis(model, [scene_of(model)]))["preload"] == "20 N at 20 degC, which the cage has"


def test_info_has_the_preload_at_temperature(tmp_path, model):
    """By the shank as a bar: for the 6207 the shipped table's; for a cage of the rivets' expansion nothing changes."""
    thermal = preload.of_geometry(Geometry())
    assert thermal.rate == pytest.approx(preload.of_fmu(model).rate, rel=1e-6) and thermal.T_0 == pytest.approx(293.15)
    path = tmp_path / "mine.toml"
    path.write_text(f'{OWN}[cage]\nmaterial = "brass"\n[inputs]\noil.T = "90 degC"\n')
    rows = {row[0]: row[1:] for row in info_tables.preload(bearing_case(path))}
    P = bearing_case(path).values["joint.preload"]
    assert rows["preload of a rivet at 20 degC"] == (f"{P:.4g}", "N", "rule")
    hot, _, reason = rows["preload with the cage at 90 degC"]
    rate = float(re.search(r"expands more than the rivets, \+([\d.]+) N/K", reason)[1])
    assert float(hot.removeprefix("some ")) == pytest.approx(P + 70.0 * rate, rel=0.01)
    path.write_text(f'{OWN}[cage]\nmaterial = "steel"\n[inputs]\noil.T = "90 degC"\n')
    rows = {row[0]: row[1:] for row in info_tables.preload(bearing_case(path))}
    kept = f"some {P:.3g}", "N", "the cage expands as the rivets do"
    assert rows["preload with the cage at 90 degC"] == kept


@pytest.mark.slow
def test_the_stack_by_rule_beside_finite_elements(tmp_path):
    """The 6309's rivets of 2.5 mm in steel by coarse elements, which are 3 % stiffer than the fine ones: 5 %."""
    case = read(
        tmp_path, f'{OWN}[cage]\nmaterial = "steel"\n[rivet]\nshank_diameter = "2.5 mm"\nhead_diameter = "4.4 mm"\n'
    )
    g = Geometry(**case.joint)
    assert stack_stiffness(g, 4.763e7) == pytest.approx(stiffness.stack_stiffness(Joint(g, COARSE)), rel=0.05)


def test_a_preload_that_is_lost_is_zero():
    """A cage that expands less loosens its rivets; 0 is the least."""
    thermal = preload.Thermal(-1.0, 293.15)
    words = preload.in_words(thermal, [(20.0, 293.15), (20.0, 393.15)], lambda v: f"{min(v):g} to {max(v):g} N", str)
    assert thermal.at(20.0, 393.15) == 0.0
    assert words.startswith("20 to 20 N at 20 degC, 0 to 20 N with") and "expands less" in words


def test_info_shows_oil_and_temperatures(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(f'{OWN}{POINTS}[inputs]\noil.T = "100 degC"\n')
    rows = {row[0]: row[1:] for row in info_tables.oil(bearing_case(path))}
    eta = 11e-6 * 900.0 * (1.0 - 7.5e-4 * (373.15 - 359.0006))
    assert rows["oil viscosity at 100 degC"] == (f"{1e3 * eta:.4g}", "mPa.s", "rule")
    assert rows["kinematic viscosity"] == ("100 at 40 degC, 11 at 100 degC", "mm2/s", "yours")
    assert rows["oil, inner ring, outer ring, balls, cage"] == ("100, 100, 100, 100, 100", "degC", "yours, rule")
    assert "Oil and temperatures" in shown("info", path)


# Runs -----------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("speed", "said"), [("500 rev/min", True), ("18238 rev/min", False), ("0 rev/min", False)])
def test_a_run_says_when_it_has_not_settled(model, speed, said):
    """50 ms are 0.42 revolutions at 500 r/min and 15 at the paper's speed; 1.2 s leave out ten."""
    result = run(None, fmu=model.path, t_end=2e-3, parameters={"start.settle": 1e-3}, inputs={"shaft.omega": speed})
    result.parameters["start.settle"] = 1e-3
    turns = result.about["settle_turns"]
    assert turns == pytest.approx(float(speed.split()[0]) / 60e3)
    slow = SimpleNamespace(
        about={"settle_turns": 50.0 * turns}, parameters={"start.settle": 0.05}, data={"time": np.array([0.0, 0.4])}
    )
    note = summary.settle_note(slow)
    assert bool(note) == said
    assert not said or ("0.42 revolutions" in note and "start.settle = 1.2 s" in note)


def test_a_run_says_when_it_counts_few_revolutions(model):
    """From 10 ms to 30 ms at 6,000 r/min there are two revolutions; a shaft at rest is not told."""
    parts = {"parameters": {"start.settle": 0.01}, "inputs": {"shaft.omega": "6000 rev/min"}}
    result = run(None, fmu=model.path, t_end=0.03, **parts)
    assert result.about["count_turns"] == pytest.approx(2.0)
    assert "rest on 2 revolutions" in summary.count_note(result)
    for turns in (0.0, 10.0):
        result.about["count_turns"] = turns
        assert summary.count_note(result) == ""


def test_what_stays_as_of_bronze_is_said():
    """Friction and damping have no source for other materials."""
    values = {"cage.mu": 0.05, "cage.mu_land": 0.08, "cage.modal_damping": 0.01, "joint.mu": 0.15}
    result = SimpleNamespace(parameters=values | {"cage.material": "steel"}, about={"given": ["joint.mu"]})
    assert assumed.assumed_as_bronze(result) == "cage.mu 0.05, cage.mu_land 0.08, cage.modal_damping 0.01"
    result.parameters["cage.material"] = "bronze"
    assert assumed.assumed_as_bronze(result) == ""


def test_a_flange_that_yields_is_said_on_the_terminal(model, tmp_path):
    done = typed('run --set "joint.fit=20 um" --t-end "1 ms" --no-plot', "--fmu", model.path, "--out", tmp_path)
    assert done.exit_code == 0 and "flags of the rivets (rivet[k].flag): flange yields" in done.stderr


def test_another_material_of_the_cage_is_refused_by_name(model):
    with pytest.raises(UserError, match=r"cage.material = 'brass': bronze is allowed.*for brass build an FMU"):
        scene_of(model, {"parameters": {"cage": {"material": "brass"}}})
    assert scene_of(model, {"parameters": {"cage": {"material": "bronze"}}}).parameters["cage.material"] == "bronze"


def test_a_slow_bearing_of_its_own_runs_beyond_its_settling(model, monkeypatch):
    own = Model.default
    monkeypatch.setattr(Model, "default", lambda self, v: 1.8 if v.name == "start.settle" else own(self, v))
    assert load_scene(None, model).t_end == 3.6 and load_scene("demo", model).t_end == 0.4


def test_a_speed_of_matrices_replaces_the_scenes(own):
    """The scene's speed stands nowhere, its load does."""
    model = Model(own)
    scene = load_scene("demo", model)
    scene = scene.__class__(
        **vars(scene) | {"replaced": (*scene.replaced, "shaft.omega 18238 rev/min for 9000 rev/min")}
    )
    at = scene_at(model, scene, SimpleNamespace(load=1.0, omega=942.5))
    assert at.replaced == ("shaft.F_y 2994 N for 4100 N",)
    assert dict(basis(model, [at]))["speed"] == "9000.2 rev/min"


def test_info_of_an_fmu_has_what_its_file_gave(fmu, own, tmp_path, monkeypatch):
    """Boundary dimensions and load ratings, and with them the life, which are no variables of the FMU."""
    noted = {"bore": "0.045", "outside_diameter": "0.1", "width": "0.025", "C": "53000.0", "C_0": "31900.0"}
    monkeypatch.setattr(
        Model, "noted", {name: {"name": name, "origin": "yours", "value": value} for name, value in noted.items()}
    )
    text = shown("info", "--fmu", own)
    assert "45 x 100 x 25" in text and "53, 31.9" in text and "reference life L_10r" in text


# Studies --------------------------------------------------------------------------------------------------------------


def test_a_damages_basis_has_its_curve(model, tmp_path):
    """Studies whose response is a damage state the S-N curve, others do not."""
    bench = Bench(tmp_path / "s.toml", {"simulation": {"t_end": 0.06}}, model, tmp_path, None)
    assert "S-N curve" not in dict(bench.check(["stress"]).basis())
    assert "amplitude 250 MPa" in dict(bench.check(["damage"]).basis())["S-N curve"]


def test_shares_have_no_hours(model, tmp_path):
    """70 % is no 0.7 h, and a mission of shares has no length."""
    points = [{"share": 0.7}, {"share": "30 %", "inputs": {"shaft.omega": "9000 rev/min"}}]
    document = {"simulation": {"t_end": 0.06}, "point": points}
    mission = plan_mission("m", document, model, tmp_path / "m.toml")
    assert [time_text(part.weight, mission) for part in mission.parts] == ["70 %", "30 %"]
    life = SimpleNamespace(mission=mission, estimate=SimpleNamespace(life=100.0))
    assert mission_text(life) == ("shares of time", "of any length")
    document["point"] = [{"hours": 0.7}]
    mission = plan_mission("m", document, model, tmp_path / "m.toml")
    assert time_text(0.7, mission) == "0.7 h"


def test_a_report_says_what_a_run_says(model):
    """Assumed as of bronze, settling, preload at temperature: the page has them too."""
    result = run(None, fmu=model.path, t_end=0.02, parameters={"start.settle": 5e-3}, inputs={"cage.T": "60 degC"})
    result.parameters["cage.material"] = "brass"
    page = render(result)
    assert "Assumed, as of a cage of bronze: cage.mu 0.05, cage.mu_land 0.08" in page
    assert "after 1.5 revolutions of the shaft" in page and "with the cage at 60 degC" in page


def test_an_fmu_keeps_the_catalogues_values(tmp_path):
    """Bore and load ratings are no variables: the description notes them beside their origin."""
    resolved = tmp_path / "bearing.toml"
    case = read(tmp_path, f'{OWN}[catalogue]\nC = "50 kN"\n')
    notes = {"Z": 8, "origin": case.origin, "numbers": case.catalogue}
    resolved.write_text("\n".join(to_toml(notes)), encoding="utf-8")
    root = etree.fromstring(write_description(load_table(resolved)).encode())
    values = {v.get("name"): v.attrib for v in root.iterfind("VendorAnnotations/Tool/Origin/Value")}
    assert (values["C"]["origin"], float(values["C"]["value"])) == ("yours", 50e3)
    assert float(values["bore"]["value"]) == 0.045 and "value" not in values["bearing.D"]


DRAWN = f"""{OWN}[parameters]
cage.pocket_clearance = "0.25 mm"
[rivet]
shank_diameter = "2.5 mm"
[inputs]
oil.T = "90 degC"
"""


def test_what_a_drawing_allows_goes_into_the_fmu(tmp_path):
    """Of a parameter, a temperature and a dimension of the rivet, in SI: 70 degC are 343.15 K."""
    case = read(
        tmp_path,
        f'{DRAWN}[between]\ncage.pocket_clearance = ["0.23 mm", "0.28 mm"]\noil.T = ["70 degC", "110 degC"]\nrivet.shank_diameter = ["2.45 mm", "2.5 mm"]\n',
    )
    expected = {
        "cage.pocket_clearance": (0.23e-3, 0.28e-3),
        "oil.T": (343.15, 383.15),
        "rivet.shank_diameter": (2.45e-3, 2.5e-3),
    }
    assert case.ranges == {name: pytest.approx(ends, rel=1e-12) for name, ends in expected.items()}
    resolved = tmp_path / "bearing.toml"
    document = {"Z": 8, "origin": case.origin, "ranges": case.ranges}
    resolved.write_text("\n".join(to_toml(document)), encoding="utf-8")
    root = etree.fromstring(write_description(load_table(resolved)).encode())
    values = {v.get("name"): v.attrib for v in root.iterfind("VendorAnnotations/Tool/Origin/Value")}
    assert {name for name, one in values.items() if "low" in one} == set(expected)
    assert float(values["oil.T"]["low"]) == pytest.approx(343.15)
    assert float(values["oil.T"]["high"]) == pytest.approx(383.15)


@pytest.mark.parametrize(
    ("text", "why"),
    [
        (
            'cage.pocket_clearance = ["0.26 mm", "0.28 mm"]',
            "between.cage.pocket_clearance = .*, and 0.25 mm between them",
        ),
        ('cage.pocket_clearance = ["0.28 mm", "0.23 mm"]', "lowest value must be below the highest"),
        ('cage.pocket_clearance = "0.2 mm"', r"\[lowest, highest\] is needed"),
        ('cage.pocket_clearance = ["0.2 N", "0.3 mm"]', "does not fit"),
        ('cage.guide_clearance = ["0.2 mm", "0.3 mm"]', "the file has to give its value too"),
        ('rivet.shank = ["2 mm", "3 mm"]', "rivet.shank.*rivet.shank_diameter"),
        ('shaft.F_y = ["2 N", "3 N"]', "shaft.F_y"),
        ('scene.cage = ["elastic", "two_half"]', "only real numbers have ranges"),
    ],
)
def test_what_is_no_range_of_a_drawing_is_refused(tmp_path, text, why):
    with pytest.raises(UserError, match=why):
        read(tmp_path, f"{DRAWN}[between]\n{text}\n")


# What nobody gave, for whose bearing ---------------------------------------------------------------------------------


def of_rules(ruled=(), given=(), example=False, **sizes):
    """A result of the 6309 by rule: preload 8.89 N/mm2 of the squared shank, fit a 150th of it, inwards."""
    values = {"joint.preload": 49.4, "joint.fit": -15.7e-6, "cage.pocket_clearance": 0.314e-3, "oil.eta": 6e-3}
    about = {"ruled": list(ruled), "given": list(given), "rivet": sizes, "example": example}
    about["temperatures"] = {"oil.T": 353.15, "cage.T": 363.15}
    return SimpleNamespace(parameters=values | {"oil.flow": 0.0}, about=about)


def test_values_by_rule_are_named_without_the_changes_of_another_bearing():
    """All rules of docs/own_bearing.md and what an aviation oil stands for, each with its range here; no change of the stress
    without a screening of the bearing (tests/test_budget.py).
    """
    rivet = {name for name in assumed.ranges()[1] if name.startswith("rivet.")}
    rows = list(assumed.assumed_rows(of_rules(["joint.preload"], **{"rivet.shank_diameter": 2.357e-3})))
    shown = {row.name: row.words for row in rows}
    own = {"joint.preload", "joint.fit", "cage.pocket_clearance", "oil.eta"}
    assert shown.keys() == own | {*rivet, "oil.T", "cage.T"}
    assert shown["joint.preload"] == ("49.4 N", "24.7 … 148 N") and shown["joint.fit"] == ("-15.7 um", "-31.4 … 0 um")
    assert shown["rivet.shank_diameter"] == ("2.36 mm", "1.89 … 2.95 mm")
    assert shown["rivet.fillet_radius"] == ("by rule", "0.6 … 1.8 times")  # an FMU of an older build
    assert shown["cage.T"] == ("90 degC", "60 … 105 degC")
    assert {row.change("stress") for row in rows} == {""} and "sensitivity" in assumed.measured_in(rows)
    rows = list(assumed.assumed_rows(of_rules(example=True)))
    assert {row.name for row in rows} == {"cage.pocket_clearance", "oil.eta", "oil.T", "cage.T"}


def test_what_is_given_is_not_assumed():
    ruled = ["joint.preload", "joint.fit"]
    rows = assumed.assumed_rows(of_rules(ruled, ["joint.preload", "oil.eta", "oil.T"]))
    names = {row.name for row in rows if not row.name.startswith("rivet.")}
    assert names == {"joint.fit", "cage.pocket_clearance", "cage.T"}


# Oils by kind and grade -----------------------------------------------------------------------------------------------


def oil_of(tmp_path, top, parameters=""):
    path = tmp_path / "oil.toml"
    path.write_text(f"{OWN}{top}\n[parameters]\n{parameters}\n")
    return bearing_case(path)


def parts_of(case):
    return SimpleNamespace(**{name[4:]: value for name, value in case.values.items() if name.startswith("oil.")})


@pytest.mark.parametrize(
    ("kind", "index", "in_table"), [("mineral", 95.0, "100"), ("PAO", 140.0, "68"), ("ester", 140.0, "68")]
)
def test_a_grade_is_its_viscosity_at_40_degrees(tmp_path, kind, index, in_table):
    """ISO 3448; all grades of a kind have one viscosity index, here by ASTM D2270 from 9 to 12 mm2/s at 100 degC."""
    for grade, nu_100 in oils.kinds()[kind]["grades"].items():
        found = parts_of(oil_of(tmp_path, f'oil = "{kind} ISO VG {grade}"'))
        assert (found.nu_1, found.T_1, found.nu_2) == pytest.approx((1e-6 * float(grade), 313.15, 1e-6 * nu_100))
    Y, U = oils.kinds()[kind]["grades"][in_table], float(in_table)
    L, H = 0.88779 * Y**2 + 7.5527 * Y - 16.6, 0.26665 * Y**2 + 6.7015 * Y - 10.81
    above = 100.0 + (10.0 ** (math.log10(H / U) / math.log10(Y)) - 1.0) / 0.00715
    assert (100.0 * (L - U) / (L - H) if index < 100.0 else above) == pytest.approx(index, abs=0.5)


def test_kinds_of_oil_beside_published_oils(tmp_path):
    """An ester of 30 mm2/s has 5.81 at 100 degC, a mineral oil of 68 has 8.6; ester aviation oil 8.51 1/GPa at 149 degC."""
    ester = parts_of(oil_of(tmp_path, 'oil = "ester"', 'oil.nu_1 = "30 mm2/s"'))
    assert ester.nu_2 == pytest.approx(5.81e-6, rel=0.01)
    assert parts_of(oil_of(tmp_path, 'oil = "mineral 68"')).nu_2 == pytest.approx(8.6e-6, rel=0.01)
    jet = parts_of(oil_of(tmp_path, 'oil = "aviation"'))
    assert jet.alpha * math.exp(-jet.alpha_T * (422.15 - jet.T_0)) == pytest.approx(8.51e-9, rel=0.01)


def test_a_kind_sets_what_the_model_has_of_an_oil(tmp_path):
    """alpha = s nu^t at oil.T_0 and at 100 degC, the density at 15 degC, traction in full sliding; what a file gives
    stands.
    """
    found = parts_of(oil_of(tmp_path, 'oil = { kind = "Mineral", grade = 32 }', 'oil.T_0 = "40 degC"'))
    assert found.alpha == pytest.approx(9.904e-9 * 32.0**0.139, rel=1e-5)
    assert found.alpha * math.exp(-60.0 * found.alpha_T) == pytest.approx(9.904e-9 * 5.29**0.139, rel=1e-5)
    assert found.rho * (1.0 + 25.0 * found.expansion) == pytest.approx(875.0, rel=1e-5)
    assert found.eta == pytest.approx(32e-6 * found.rho, rel=1e-5)
    s = np.linspace(0.0, 2.0, 200001)
    mu = (found.A + found.B * s) * np.exp(-found.C * s) - found.A
    assert mu[-1] == pytest.approx(0.05, rel=1e-6)
    assert oils.largest_traction(found.A, found.B, found.C) == pytest.approx(mu.max(), rel=1e-6)
    case = oil_of(tmp_path, 'oil = "PAO VG 68"', "oil.alpha = 2e-8")
    assert case.values["oil.alpha"] == 2e-8 and case.origin["oil.alpha"] == "yours"
    assert case.origin["oil.rho"] == "PAO ISO VG 68 oil" and case.origin["oil.eta"] == "rule"


def test_a_kind_with_one_viscosity_has_the_slope_of_its_grades(tmp_path):
    """Of VG 46 by the viscosity at 40 or 100 degC, at another temperature, or by oil.eta at oil.T_0."""
    whole = parts_of(oil_of(tmp_path, 'oil = "mineral ISO VG 46"'))
    for one in (f"oil.nu_1 = {whole.nu_1}", f"oil.nu_2 = {whole.nu_2}", f"oil.eta = {whole.eta}"):
        found = parts_of(oil_of(tmp_path, 'oil = "mineral"', one))
        both = (found.nu_1, found.nu_2, found.eta)
        assert both == pytest.approx((whole.nu_1, whole.nu_2, whole.eta), rel=2e-3)
    colder = parts_of(oil_of(tmp_path, 'oil = "mineral ISO VG 46"', 'oil.T_1 = "20 degC"'))
    assert colder.eta == pytest.approx(whole.eta, rel=1e-5) and colder.nu_1 > 2.0 * whole.nu_1


def test_a_scenes_oil_is_the_same_as_a_bearings(tmp_path, model):
    scene = load_scene(None, model, ("test", {"oil": "PAO 68"}))
    case = oil_of(tmp_path, 'oil = "PAO 68"')
    assert scene.oil == case.oil == "PAO ISO VG 68"
    of_oil = {name: value for name, value in scene.parameters.items() if name.startswith("oil.")}
    assert of_oil == {name: case.values[name] for name in of_oil} and "oil.alpha" in of_oil
    rows = {row[0]: row[1:] for row in info_tables.oil(case)}
    assert rows["oil"] == ("PAO ISO VG 68", "", "yours")
    assert rows["pressure-viscosity coefficient at 85.85 degC"][2].startswith("7.382 nu^0.1335, Gold")
    own = {
        row[0]: row[1:]
        for row in info_tables.oil(oil_of(tmp_path, "", 'oil.nu_1 = "46 mm2/s"\noil.nu_2 = "6.8 mm2/s"'))
    }
    assert own["oil"][2] == "what is not given is that of an aviation oil"
    assert own["traction coefficient: largest, in full sliding"] == (
        "0.048, 0.040",
        "",
        "assumed in the range of fits for 4109 aviation oil; D = -A",
    )


def test_effects_of_rules_are_those_of_the_record():
    """data/rules.csv and the rules of docs/own_bearing.md come from one record."""
    sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "benchmarks"))
    import rules
    from records import newest_record

    record = newest_record("rules")
    assert rules.effects(record) == assumed.RULES.read_text(encoding="utf-8")
    text = rules.PAGE.read_text(encoding="utf-8")
    assert rules.written(text, rules.page(record)) == text


def test_default_ranges_of_a_study_are_those_of_values_by_rule():
    """A fit is negative: its lower end is twice the value."""
    names = {"joint.preload": 49.4, "joint.fit": -15.7e-6, "oil.flow": 0.0}
    origin = dict.fromkeys(names, "rule")
    model = SimpleNamespace(parameters=names, default=lambda value: value, origin=origin, bearing="6309")
    ranges = assumed.assumed_ranges(model)
    assert ranges["joint.preload"] == pytest.approx((24.7, 148.2))
    assert ranges["joint.fit"] == pytest.approx((-31.4e-6, 0))


def test_an_fmu_keeps_the_rivets_sizes(tmp_path):
    case = read(tmp_path, OWN)
    rivet = {f"rivet.{name}": value for name, value in case.rivet.items() if f"rivet.{name}" in case.origin}
    resolved = tmp_path / "bearing.toml"
    resolved.write_text("\n".join(to_toml({"Z": 8, "origin": case.origin, "numbers": rivet})), encoding="utf-8")
    root = etree.fromstring(write_description(load_table(resolved)).encode())
    values = {v.get("name"): v.attrib for v in root.iterfind("VendorAnnotations/Tool/Origin/Value")}
    assert float(values["rivet.shank_diameter"]["value"]) == case.rivet["shank_diameter"]
    assert values["rivet.shank_diameter"]["origin"] == "rule"


# Values that few bearings have ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (OWN, []),
        (f"{OWN}[catalogue]\nC = 53\n", ["C = 53 N, but these balls have 5.28e+04 N"]),  # kN meant
        (f'{OWN}[catalogue]\nC_0 = "319 kN"\n', ["C_0 = 3.19e+05 N, but these balls have 3.1"]),
        (f'{OWN}[cage]\nmaterial = "steel"\nE = "210 MPa"\n', ["cage.E = 0.21 GPa: solids have 0.4 to 700 GPa"]),
        (f"{OWN}[inputs]\nshaft.omega = 5000\n", ["47,746 rev/min", "3.5 million mm/min", "is in rad/s"]),
    ],
)
def test_a_forgotten_unit_is_told(tmp_path, text, said):
    found = list(doubts(read(tmp_path, text)))
    assert len(found) == bool(said) and all(part in found[0] for part in said)


def test_no_bearing_of_the_catalogue_is_doubted():
    """The balls by rule have the makers' ratings within 2.4 %."""
    assert not [text for name in known_bearings() for text in doubts(bearing_case(name))]


def test_ratings_that_nobody_gave_are_those_of_the_standards(tmp_path):
    """A file without designation and catalogue: info shows lives and static safety, C and C_0 by rule."""
    case = read(tmp_path, 'Z = 8\n[parameters]\nbearing.D = "17.4625 mm"\nbearing.d_m = "72.5 mm"\n')
    assert case.catalogue["C"] == pytest.approx(53e3, rel=0.02)
    assert case.catalogue["C_0"] == pytest.approx(31.9e3, rel=0.02)
    assert case.origin["C"] == case.origin["C_0"] == "rule"


# Points of a mission that are too slow --------------------------------------------------------------------------------


def test_slow_points_of_a_mission_are_named(model):
    """0.05 s at 600 r/min are half a revolution; t_end = 0.4 s counts three and a half more; 18,000 r/min are enough."""
    points = [
        {"name": "idle", "hours": 1, "inputs": {"shaft.omega": "600 rev/min"}},
        {"name": "fast", "hours": 1, "inputs": {"shaft.omega": "18000 rev/min"}},
    ]
    early, few = plan_mission("m", {"point": points}, model, Path("m.toml")).warnings
    assert early.startswith("point idle: damage begins to count after 0.5 revolutions") and "start.settle" in early
    assert few.startswith("point idle: damage of a run rests on 3.5 revolutions") and "t_end" in few
    assert not plan_mission("m", {"point": points[1:]}, model, Path("m.toml")).warnings


@pytest.mark.parametrize(("shares", "fine"), [((0.33, 0.33, 0.33), True), ((0.5, 0.3), False), ((50, 50), False)])
def test_shares_of_a_mission_add_up(model, shares, fine):
    document = {"point": [{"share": share, "inputs": {"shaft.F_y": 1e3 + i}} for i, share in enumerate(shares)]}
    if fine:
        assert plan_mission("m", document, model, Path("m.toml")).hours == pytest.approx(0.99)
        return
    with pytest.raises(UserError, match=rf"share: those of the points add up to {sum(shares):g}; 1 is allowed"):
        plan_mission("m", document, model, Path("m.toml"))


def test_a_file_of_another_command_is_named(model, tmp_path):
    for kind, (keys, command) in KINDS.items():
        with pytest.raises(UserError, match=f"this is a {kind}, not a scene: `{command.split(' {')[0]}"):
            check_keys("f.toml", {keys[0]: 1}, ("description",), "scene")
    with pytest.raises(UserError, match='unknown key "vray"; did you mean "vary"'):
        check_keys("f.toml", {"vray": 1}, ("vary",), "sweep")
