"""Materials of an own bearing: one value for run and rivet table, given once; rivets, temperatures and loads that
follow from what the user gave.
"""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from bearing_model.generated.variables import PARAMETERS
from bearing_model.physics.derived import race_modulus
from bearing_model.physics.hertz_exact import ball_race_contact
from bearing_model.physics.parameters import Parameters
from rivet_model import half, half_loads, half_modes, half_shape
from rivet_model.geometry import Geometry
from riveted_bearing import UserError, build, run
from riveted_bearing.base.shipped import shipped_scenes
from riveted_bearing.bearing.bearing_file import bearing_case
from riveted_bearing.bearing.materials import PARTS, library, names_for
from riveted_bearing.bearing.origin import not_given
from riveted_bearing.bearing.rivet_heads import heads
from riveted_bearing.building.builder import case_with, check_material, fmu_description, start_document
from riveted_bearing.building.rivet import read_table, table_of
from riveted_bearing.running.fmu import Instance, Model
from riveted_bearing.running.inputs import History
from riveted_bearing.running.scene import Scene, load_scene, warm


def case_of(tmp_path, text, name="mine.toml"):
    """The Case of a 6309 with lines of its own."""
    path = tmp_path / name
    path.write_text(f'designation = "6309"\n{text}', encoding="utf-8")
    return bearing_case(path)


# Where a property goes ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", names_for("cage"))
def test_a_cage_material_reaches_run_and_table(tmp_path, name):
    """E, nu and density are one number in the FMU and in the geometry of the finite elements; mass and moments follow;
    all else of the table's material too.
    """
    case = case_of(tmp_path, f'[cage]\nmaterial = "{name}"\n')
    g, entry = Geometry(**case.joint), library()[name]
    for key, member in PARTS["cage"].geometry.items():
        assert getattr(g, member) == entry[key][0], key
    for key, parameter in PARTS["cage"].parameters.items():
        assert case.values[parameter] == entry[key][0] and case.origin[parameter] == "yours"
    assert case.values["cage.m"] == pytest.approx(half_shape.half_inertia(g).m, rel=1e-5)
    assert case.origin["cage.m"] == "rule"
    assert case.values["cage.material"] == name.lower().replace("-", "_")


def test_masses_go_with_the_density(tmp_path):
    """The metal of two halves of one shape weighs as its densities, without the rivets, which are of steel in both."""
    steel, brass = (case_of(tmp_path, f'[cage]\nmaterial = "{name}"\n') for name in ("steel", "brass"))
    rivets = 8 * half_shape.rivet_mass(Geometry(**steel.joint))
    ratio = (steel.values["cage.m"] - rivets) / (brass.values["cage.m"] - rivets)
    assert ratio == pytest.approx(library()["steel"]["density"][0] / library()["brass"]["density"][0], rel=1e-5)


def test_materials_of_the_6207_are_the_defaults():
    """What stands where no material is named is the library's, to the last digit, in the variable table and in
    Geometry; each property has a source.
    """
    for name, part in PARTS.items():
        entry = library()[part.material]
        for key, member in part.geometry.items():
            assert getattr(Geometry, member) == entry[key][0]
        for key, parameter in part.parameters.items():
            if not parameter.startswith("ball."):  # as the rings
                assert PARAMETERS[parameter].start == entry[key][0], (name, parameter)
    for entry in library().values():
        properties = [value for key, value in entry.items() if key not in ("parts", "description")]
        assert entry["description"] and all(value > 0.0 and len(source) > 5 for value, source in properties)


def test_a_material_by_the_name_of_the_parameter(tmp_path):
    """`cage.material` under [parameters] means the same as under [cage]; a single property takes the place of the
    material's.
    """
    here, there = (
        case_of(tmp_path, text)
        for text in ('[cage]\nmaterial = "PA66-GF25"\n', '[parameters]\ncage.material = "PA66-GF25"\n')
    )
    assert here.joint == there.joint and here.values == there.values
    stiff = case_of(tmp_path, '[cage]\nmaterial = "steel"\nE = "200 GPa"\n[parameters]\ncage.nu = 0.28\n')
    assert (stiff.values["cage.E"], stiff.joint["E_flange"], stiff.joint["nu_flange"]) == (200e9, 200e9, 0.28)
    assert stiff.joint["rho_flange"] == library()["steel"]["density"][0]


OWN = '[cage.material]\nE = "100 GPa"\nnu = 0.35\ndensity = "8.5 g/cm3"\nexpansion = 19e-6\nyield = "200 MPa"\nhardening = "1 GPa"\nsource = "our laboratory"\n'


def test_a_table_of_ones_own(tmp_path):
    case = case_of(tmp_path, OWN)
    assert case.values["cage.material"] == "own" and case.joint["rho_flange"] == pytest.approx(8500.0)
    assert case.joint["yield_flange"] == 200e6
    assert set(case.materials["cage"].sources.values()) == {"our laboratory"}


def test_the_same_value_twice_is_no_contradiction(tmp_path):
    case = case_of(
        tmp_path,
        '[cage]\nmaterial = "steel"\nE = "200 GPa"\n[parameters]\ncage.E = "200 GPa"\ncage.material = "steel"\n',
    )
    assert case.values["cage.E"] == 200e9


def test_the_fmu_refuses_another_material(tmp_path):
    """By name, with the value of the build and the way to another one; the instance after it works."""
    model = Model()
    settings = (
        ("cage.E", 207e9, "1.1e+11"),
        ("cage.nu", 0.3, "0.33"),
        ("cage.rho", 7850.0, "8800"),
        ("cage.material", "steel", "bronze is allowed"),
    )
    for name, value, allowed in settings:
        with pytest.raises(UserError) as refused:
            run(None, parameters={name: value}, t_end=1e-3)
        assert all(
            word in str(refused.value)
            for word in (name, allowed, "build an FMU from a bearing file with [cage] material")
        )
    with Instance(model) as instance:
        instance.initialize(load_scene(None, model))


def test_a_table_of_another_material_is_refused(tmp_path):
    """A finished table in an FMU for another cage: by the property and both values."""
    case = case_of(tmp_path, '[cage]\nmaterial = "steel"\n')
    table = read_table(
        table_of(
            "6309", Geometry(**case_of(tmp_path, '[cage]\nmaterial = "brass"\n', "other.toml").joint), "closed-form"
        )
    )
    with pytest.raises(UserError, match=r"brass.json: made for a cage with E = .*, but that of 6309 has .* \(steel\)"):
        check_material("brass.json", table, case)


def test_the_fmu_says_its_cage(tmp_path):
    case = case_of(tmp_path, '[cage]\nmaterial = "steel"\n')
    table = table_of("6309", Geometry(**case.joint), "closed-form")
    words = fmu_description(case, read_table(table))
    assert words.startswith("6309. 8 balls of 17.46 mm, rivets of ") and "(15CrMn). Cage: steel: E " in words
    assert start_document(case, table)["parameters"]["cage.rho"] == library()["steel"]["density"][0]


# Balls of another material than the rings -----------------------------------------------------------------------------


def test_ceramic_balls(tmp_path):
    """1/E* = sum of (1 - nu^2)/E in the dynamics and in the quasi-static model; mass by density; the load of the most
    loaded ball hardly changes.
    """
    cold = '[inputs]\noil.T = "20 degC"\n'
    case, steel = case_of(tmp_path, f'[balls]\nmaterial = "Si3N4"\n{cold}'), case_of(tmp_path, cold)
    ball, ring = (library()[name] for name in ("Si3N4", "bearing steel"))
    E_star = 1.0 / sum((1.0 - entry["nu"][0] ** 2) / entry["E"][0] for entry in (ball, ring))
    p = Parameters({"ball.E": ball["E"][0], "ball.nu": ball["nu"][0]})
    assert race_modulus(p) == pytest.approx(E_star, rel=1e-12)
    assert race_modulus(Parameters()) == 0.5 * 207e9 / (1.0 - 0.3**2)  # to the last bit
    contact = ball_race_contact(0.01, 0.06, 0.52, 0.0, 207e9, 0.3, "inner", (ball["E"][0], ball["nu"][0]))
    assert contact.E_star == pytest.approx(E_star, rel=1e-12)
    assert case.bearing.ball_mass / steel.bearing.ball_mass == pytest.approx(ball["density"][0] / 7800.0, rel=1e-12)
    stiffer = case.equilibrium().p_i.max() / steel.equilibrium().p_i.max()
    # p ~ E*^(2/3) at one load of a ball
    assert stiffer == pytest.approx((E_star / (0.5 * 207e9 / 0.91)) ** (2 / 3), rel=0.01)


# Rivets, temperatures, loads ------------------------------------------------------------------------------------------


def test_preload_head_and_seat_follow_the_shank(tmp_path):
    """Equal stress: the preload of a 2.5 mm rivet is 1.5625 times that of a 2.0 mm one; head, seat, fillet, fit and
    swell are 1.25 times as large.
    """
    thin, thick = (case_of(tmp_path, f'[rivet]\nshank_diameter = "{d} mm"\n') for d in (2.0, 2.5))
    assert thick.values["joint.preload"] / thin.values["joint.preload"] == pytest.approx(1.5625, rel=1e-5)
    for name in (
        "head_diameter",
        "head_height",
        "seat_diameter",
        "fillet_radius",
        "relief_radius",
        "relief_depth",
        "edge_break",
        "middle_zone",
    ):
        assert thick.joint[name] / thin.joint[name] == pytest.approx(1.25, rel=1e-5), name
    for name in ("joint.fit", "joint.swell"):
        assert thick.values[name] / thin.values[name] == pytest.approx(1.25, rel=1e-5)
    assert thick.joint["flange_thickness"] == thin.joint["flange_thickness"]  # the bar's
    stress = thin.values["joint.preload"] / Geometry(**thin.joint).shank_area
    assert stress == pytest.approx(20.0 / (np.pi / 4 * 1.5e-3**2), rel=1e-5)  # the 6207's


def test_the_shank_of_the_6207_too(tmp_path):
    """A file that changes nothing of the 6207 but its rivet, or a rivet file beside it."""
    path = tmp_path / "mine.toml"
    path.write_text('[rivet]\nshank_diameter = "1.8 mm"\n', encoding="utf-8")
    rivet = tmp_path / "rivet.toml"
    rivet.write_text('shank_diameter = "1.8 mm"\n', encoding="utf-8")
    for case in (bearing_case(path), case_with(None, rivet)):
        assert case.values["joint.preload"] == pytest.approx(20.0 * 1.44)
        assert case.joint["head_diameter"] == pytest.approx(1.2 * 2.6e-3)
        assert case.origin["joint.preload"] == "rule" and case.values["shaft.F_y"] == 2994.0
    assert not_given(bearing_case(path).origin)["of the 6207"] == "Z, bearing (D, d_m), shaft (F_x, F_y, omega)"


@pytest.mark.parametrize("standard", heads())
def test_heads_by_standard(tmp_path, standard):
    """Head of the standard for the shank; the seat leaves the usual room around it."""
    for shank, (diameter, height) in heads()[standard].items():
        assert 1.4 < 1e3 * diameter / shank < 2.3 and 0.3 < 1e3 * height / shank < 0.8
        if 1.5 <= shank <= 2.5:
            case = case_of(tmp_path, f'[rivet]\nhead = "{standard}"\nshank_diameter = "{shank:g} mm"\n')
            assert (case.joint["head_diameter"], case.joint["head_height"]) == (diameter, height)
            assert case.joint["seat_diameter"] > diameter


def test_strength_follows_the_rivet_steel(tmp_path):
    """The S-N curve is that of the rivet's material; a strength alone keeps the 6207's ratios; one's own curve stands."""
    for name in names_for("rivet"):
        case = case_of(tmp_path, f'[rivet]\nmaterial = "{name}"\n')
        assert case.values["fatigue.sigma_m"] == library()[name]["strength"][0]
        assert case.values["fatigue.sigma_D"] == library()[name]["endurance"][0]
        assert case.values["fatigue.sigma_f"] == pytest.approx(
            1180.0 / 785.0 * library()[name]["strength"][0], rel=1e-5
        )
        assert case.joint["yield_rivet"] == library()[name]["yield"][0]
    stronger = case_of(tmp_path, '[parameters]\nfatigue.sigma_m = "942 MPa"\n')
    assert stronger.values["fatigue.sigma_D"] == pytest.approx(300e6) and stronger.origin["fatigue.sigma_D"] == "rule"
    own = case_of(tmp_path, '[parameters]\nfatigue.sigma_m = "942 MPa"\nfatigue.sigma_D = "200 MPa"\n')
    assert own.values["fatigue.sigma_D"] == 200e6


@pytest.mark.parametrize("name", names_for("rivet"))
def test_endurance_follows_a_named_steels_other_strength(tmp_path, name):
    """It keeps its ratio to the strength, of that steel and not of the 6207's; one's own stands."""
    changed = case_of(tmp_path, f'[rivet]\nmaterial = "{name}"\nstrength = "600 MPa"\n')
    ratio = library()[name]["endurance"][0] / library()[name]["strength"][0]
    assert changed.values["fatigue.sigma_m"] == 600e6 and changed.origin["fatigue.sigma_m"] == "yours"
    assert changed.values["fatigue.sigma_D"] == pytest.approx(ratio * 600e6, rel=1e-5)
    assert changed.origin["fatigue.sigma_D"] == "rule"
    own = case_of(tmp_path, f'[rivet]\nmaterial = "{name}"\nstrength = "600 MPa"\nendurance = "150 MPa"\n')
    assert own.values["fatigue.sigma_D"] == 150e6 and own.origin["fatigue.sigma_D"] == "yours"


def test_parts_have_the_oils_temperature(tmp_path):
    """The file's or the table's; a part's own stands; the paper's bearing has the paper's, at which values are given."""
    parts = ("ring.T_i", "ring.T_e", "ball.T", "cage.T")
    hot = case_of(tmp_path, '[inputs]\noil.T = "90 degC"\nring.T_i = "110 degC"\n')
    assert [hot.values[name] for name in parts] == pytest.approx([383.15, 363.15, 363.15, 363.15])
    assert hot.origin["cage.T"] == "rule" and hot.origin["ring.T_i"] == "yours"
    assert {case_of(tmp_path, "").values[name] for name in (*parts, "oil.T")} == {359.0006}
    assert {bearing_case("6310").values[name] for name in parts} == {359.0006}
    assert {bearing_case("6207").values[name] for name in parts} == {293.15}


def warnings_of(scene):
    with Instance(Model()) as instance:
        instance.initialize(scene)
        return [text for level, text in instance.log if level == "warning"]


def test_oil_alone_is_said_once():
    """A host that heats the oil and leaves the parts is told, one that heats both or neither is not."""
    alone = warnings_of(Scene(inputs={"oil.T": History([0.0], [363.15])}))
    assert len(alone) == 1
    assert all(word in alone[0] for word in ("oil.T = 90 degC", "cage.T = 20 degC", "clearances, preload and fit"))
    hot = dict.fromkeys(("oil.T", "cage.T"), History([0.0], [363.15]))
    assert not warnings_of(Scene(inputs=hot)) and not warnings_of(Scene())
    assert not warnings_of(Scene(inputs={"oil.T": History([0.0], [293.15])}))  # that of the parts


def test_parts_of_a_scene_have_its_oils_temperature():
    """Over time too, where neither scene nor the bearing's own file gives another; shipped scenes say theirs."""
    model, parts = Model(), ("ring.T_i", "ring.T_e", "ball.T", "cage.T")
    history = {"t": [0.0, 0.1], "value": [40.0, 90.0], "unit": "degC"}
    found = load_scene(None, model, ("test", {"inputs": {"oil.T": history, "cage.T": "70 degC"}}))
    assert [float(found.inputs[name](0.05)) for name in parts] == pytest.approx([338.15] * 3 + [343.15])
    assert found.units["ball.T"] == "degC" and "ball.T" not in load_scene(None, model).inputs
    own = SimpleNamespace(origin={"ball.T": "yours", "cage.T": "rule"})
    assert set(warm(Scene(inputs={"oil.T": history}), own).inputs) == {"oil.T", *parts} - {"ball.T"}
    warm_scenes = {"demo", "spall"}
    for name in shipped_scenes():
        inputs = load_scene(name, model).inputs
        assert {float(inputs[part](0.0)) for part in parts} == {359.0006 if name in warm_scenes else 293.15}


def test_sizes_that_leave_the_table_behind_are_said():
    """The run takes another width of the cage, the rivet table keeps the built one: a warning names it."""
    said = warnings_of(Scene(parameters={"cage.width": 14e-3, "cage.x_c": 4.01163e-3}))
    assert len(said) == 1 and "cage.width: more than 1 % off" in said[0] and "rivet table" in said[0]


def test_loads_that_are_not_given(tmp_path):
    """None: by rule; one of them: the others are zero, not the 6207's; speed by rule."""
    case = case_of(tmp_path, '[inputs]\nshaft.F_y = "8 kN"\n')
    assert (case.values["shaft.F_y"], case.values["shaft.F_x"]) == (8000.0, 0.0) and case.origin["shaft.F_x"] == "rule"
    assert case.values["shaft.omega"] == pytest.approx(2.0 * np.pi * 8.0 / case.values["bearing.d_m"], rel=1e-5)
    assert case_of(tmp_path, '[inputs]\nshaft.omega = "9000 rev/min"\n').values["shaft.F_y"] == pytest.approx(
        0.1 * case.catalogue["C"], rel=1e-2
    )


# What the finite elements make of it ----------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def coarse_halves(tmp_path_factory):
    """Condensed coarse halves of the 6309 with their joints: of a material, of one twice as stiff, of one twice as
    dense (rivets too).
    """
    g = Geometry(**case_of(tmp_path_factory.mktemp("half"), '[cage]\nmaterial = "brass"\n').joint)
    stiff = replace(g, E_flange=2.0 * g.E_flange, E_rivet=2.0 * g.E_rivet)
    dense = replace(g, rho_flange=2.0 * g.rho_flange, rho_rivet=2.0 * g.rho_rivet)
    found = {}
    for name, geometry in {"plain": g, "stiff": stiff, "dense": dense}.items():
        elastic = half_loads.elastic_half(geometry, half.COARSE)
        found[name] = elastic, half_loads.JointAlone(elastic)
    return found


def test_stiffness_and_centrifugal_load_go_with_E_and_density(coarse_halves):
    """Statics: stiffness of a pad's surroundings in proportion to E, moment at the bonded joints in proportion to the
    density and to E not at all.
    """
    plain, stiff, dense = (coarse_halves[name] for name in ("plain", "stiff", "dense"))
    np.testing.assert_allclose(stiff[1].K_0, 2.0 * plain[1].K_0, rtol=1e-6)
    np.testing.assert_allclose(dense[1].K_0, plain[1].K_0, rtol=1e-9)
    moment = [half_loads.uniform_rows(*half_, half_loads.centrifugal(half_[0]))[4] for half_ in (plain, stiff, dense)]
    np.testing.assert_allclose(moment, np.array([1.0, 1.0, 2.0]) * moment[0], rtol=1e-6)


def test_frequencies_go_with_the_root_of_E_over_density(coarse_halves):
    """Free vibrations of the half with its part of the rivets: sqrt(2) up with twice E, down with twice the density."""
    plain, stiff, dense = (
        half_modes.MassiveHalf(coarse_halves[name][0]).wave(2, 4).omega for name in ("plain", "stiff", "dense")
    )
    np.testing.assert_allclose(stiff / plain, np.sqrt(2.0), rtol=1e-6)
    np.testing.assert_allclose(dense / plain, np.sqrt(0.5), rtol=1e-6)


@pytest.mark.slow
def test_tables_of_steel_and_brass_and_of_thin_and_thick_rivets(tmp_path):
    """Four FMUs of the 6309: what their tables hold, beside E, density and section; a run without a scene has the FMU's
    own point.
    """
    tables, fmus = {}, {}
    for material in ("steel", "brass"):
        for d in (2.0, 2.5):
            text = f'[cage]\nmaterial = "{material}"\n[rivet]\nshank_diameter = "{d} mm"\n[inputs]\nshaft.F_y = "8 kN"\nshaft.omega = "9000 rev/min"\n'
            case = case_of(tmp_path, text, f"{material}{d}.toml")
            tables[material, d] = read_table(table_of(case.designation, Geometry(**case.joint)))
            fmus[material, d] = build(tmp_path / f"{material}{d}.toml", out=tmp_path / f"{material}{d}.fmu")
    steel, brass = library()["steel"], library()["brass"]
    for d in (2.0, 2.5):
        a, b = tables["steel", d], tables["brass", d]
        of_density = steel["density"][0] / brass["density"][0]
        of_speed = np.sqrt(steel["E"][0] / brass["E"][0] / of_density)
        # rivets of one steel in both, nu 0.30 and 0.34
        assert a.modes.omega[0] / b.modes.omega[0] == pytest.approx(of_speed, rel=0.02)
        assert a.half.spin[4] / b.half.spin[4] == pytest.approx(of_density, rel=0.02)
        assert a.joint["alpha_flange"] == steel["expansion"][0] and b.joint["alpha_flange"] == brass["expansion"][0]
    for material in ("steel", "brass"):
        thin, thick = tables[material, 2.0], tables[material, 2.5]
        assert thick.joint["A"] / thin.joint["A"] == pytest.approx(1.5625, rel=1e-9)
        # the rivet's own share grows with its section, the seat's does not
        assert 1.1 < thick.half.k_open / thin.half.k_open < 1.5625
    for fmu in fmus.values():
        own = run(None, fmu=fmu, t_end=0.06)
        written = run(
            None, fmu=fmu, t_end=0.06, inputs={"shaft.F_y": "8 kN", "shaft.F_x": 0.0, "shaft.omega": "9000 rev/min"}
        )
        np.testing.assert_array_equal(own.data["rivet.sigma_head_max"], written.data["rivet.sigma_head_max"])
