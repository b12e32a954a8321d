"""The variable table and the files that follow from it."""

import re
import subprocess
import sys
from types import SimpleNamespace

import numpy as np
import pytest
from fmpy.model_description import read_model_description
from library import ROOT
from lxml import etree

from bearing_model.cage.elastic.half_modes import HalfModes
from bearing_model.generated import variables
from bearing_model.rivet import rivet_table

sys.path.insert(0, str(ROOT / "fmus"))
import generate

DESCRIPTION = ROOT / "fmus" / "modelDescription.xml"
TABLE = generate.load_table()


@pytest.fixture(scope="module")
def description():
    return read_model_description(str(DESCRIPTION))


@pytest.mark.parametrize("name", generate.OUTPUTS)
def test_regenerated_byte_for_byte(name):
    assert generate.generate()[name].encode() == (ROOT / name).read_bytes()


def test_check_finds_a_stale_file(tmp_path):
    command = [sys.executable, str(ROOT / "fmus" / "generate.py"), "--out", str(tmp_path)]
    assert subprocess.run(command, check=False).returncode == 0
    assert subprocess.run([*command, "--check"], check=False).returncode == 0
    with (tmp_path / "variables.h").open("a") as file:
        file.write(" ")
    result = subprocess.run([*command, "--check"], capture_output=True, text=True, check=False)
    assert result.returncode != 0
    assert "variables.h" in result.stderr


def test_description_is_valid():
    """FMI's XML schema, and fmpy's own checks of names and structure."""
    # raises if not
    read_model_description(str(DESCRIPTION), validate=True, validate_variable_names=True, validate_model_structure=True)


def test_every_variable_is_complete(description):
    for variable in description.modelVariables:
        assert variable.description, variable.name
        assert variable.variability, variable.name
        if variable.type == "Real":
            assert variable.unit, variable.name
        if variable.causality in ("input", "parameter"):
            assert variable.start is not None, variable.name
        if variable.causality in ("input", "parameter") and variable.type in ("Real", "Integer"):
            assert variable.min is not None and variable.max is not None, variable.name
        if variable.causality == "output":
            assert variable.type == "Real", variable.name  # some importers read nothing else
    for v in (*variables.PARAMETERS.values(), *variables.INPUTS.values()):
        assert v.source, v.name


def test_names_and_value_references_are_unique(description):
    names = [v.name for v in description.modelVariables]
    references = [v.valueReference for v in description.modelVariables]
    assert len(set(names)) == len(names)
    assert len(set(references)) == len(references)
    assert (names[0], int(references[0])) == ("time", 0)  # some importers take variable 0 for the time


def test_value_references_are_base_plus_stride(description):
    by_name = {v.name: int(v.valueReference) for v in description.modelVariables}
    for j in range(variables.Z):
        assert by_name[f"ball[{j + 1}].Q_i"] == variables.OUTPUTS["ball[j].Q_i"].vr + j


def test_units_and_display_units():
    """Each display unit says the same as its unit: 18238 r/min, degrees, degC at 293.15 K."""
    root = etree.parse(str(DESCRIPTION))
    display = {d.get("name"): (float(d.get("factor", 1)), float(d.get("offset", 0))) for d in root.iter("DisplayUnit")}
    # observed 3.2e-11: the start value's digits
    assert variables.INPUTS["shaft.omega"].start * display["rev/min"][0] == pytest.approx(18238, rel=1e-9)
    assert 3.141592653589793 * display["deg"][0] == pytest.approx(180, rel=1e-15)
    assert 293.15 * display["degC"][0] + display["degC"][1] == pytest.approx(20, rel=1e-12)
    assert all(factor > 0 for factor, _ in display.values())


def test_base_units_agree_with_the_names():
    """The exponents of every unit against those of the SI, written out here."""
    exponents = {
        "N": {"kg": 1, "m": 1, "s": -2}, "Pa": {"kg": 1, "m": -1, "s": -2}, "W": {"kg": 1, "m": 2, "s": -3}, "J": {"kg": 1, "m": 2, "s": -2},
        "m": {"m": 1}, "s": {"s": 1}, "kg": {"kg": 1}, "K": {"K": 1}, "rad": {"rad": 1}, "m2": {"m": 2}, "m3": {"m": 3}, "s2": {"s": 2}, "1": {},
    }  # fmt: skip
    root = etree.parse(str(DESCRIPTION))
    for unit in root.iter("Unit"):
        base = unit.find("BaseUnit")
        if base is None:
            assert unit.get("name") == "N/m1.5"
            continue
        expected = dict.fromkeys(generate.BASE_UNITS, 0)
        numerator, _, denominator = unit.get("name").partition("/")
        for sign, part in ((1, numerator), (-1, denominator)):
            for factor in part.split(".") if part else []:
                for si, power in exponents[factor].items():
                    expected[si] += sign * power
        assert {si: int(base.get(si, 0)) for si in expected} == expected, unit.get("name")


def test_no_tolerance_that_importers_would_pass_on():
    """fmpy and others hand the tolerance of DefaultExperiment to fmi2SetupExperiment, where it replaces solver.tol, also
    one that the user has set: the description has none.
    """
    experiment = etree.parse(str(DESCRIPTION)).find("DefaultExperiment")
    assert set(experiment.attrib) == {"startTime", "stopTime", "stepSize"}


def test_instants_of_a_chaotic_motion_say_so():
    """Loads and stresses that differ between communication steps of h and h/10 name the statistics that agree."""
    for name in ("rivet[k].N", "rivet[k].V", "rivet[k].sigma_head", "ball[j].Q_c", "cage.F_pocket_max"):
        assert variables.OUTPUTS[name].description.endswith("at an instant of a chaotic motion: compare stat.*")


def test_structure(description):
    """Every output listed; derivatives of the exposed states; what does not depend on inputs says so."""
    outputs = {v.name for v in description.modelVariables if v.causality == "output"}
    assert {u.variable.name for u in description.outputs} == outputs
    assert {u.variable.name for u in description.initialUnknowns} == outputs - {"bearing.Z"}
    derivatives = {u.variable.name: u.variable.derivative.name for u in description.derivatives}
    motion = {f"ring.{d}_{x}": f"ring.{s}" for x in "xyz" for d, s in (("v", x), ("a", f"v_{x}"))}
    turning = {f"ring.{x}_{d}": f"ring.{x}{s}" for x in ("beta", "gamma") for d, s in (("dot", ""), ("ddot", "_dot"))}
    assert derivatives == motion | turning
    by_name = {u.variable.name: u for u in description.outputs}
    assert by_name["stat.Q_c_mean"].dependencies == []
    assert [v.name for v in by_name["ring.x"].dependencies] == ["shaft.x", "ring.x"]
    assert [v.name for v in by_name["ring.tilt_y"].dependencies] == [
        "shaft.tilt_y",
        "shaft.tilt_z",
        "ring.beta",
        "ring.gamma",
    ]
    assert {"shaft.F_x", "shaft.omega", "ring.v_z"} <= {v.name for v in by_name["ring.a_x"].dependencies}


def test_python_names_the_same_variables(description):
    elements = {(name, vr) for v in TABLE.variables for name, vr in v.elements}
    assert elements == {(v.name, int(v.valueReference)) for v in description.modelVariables if v.name != "time"}
    blocks = list(variables.STATE_SLICES.values())
    assert [b.start for b in blocks] == [0, *(b.stop for b in blocks[:-1])]
    assert blocks[-1].stop == variables.N_STATES
    assert list(variables.STATE_SCALES) == list(variables.STATE_SLICES)


def test_c_table_is_the_same(core):
    """Names, limits and start values through the structs of the compiled core."""
    p, u = core.new("Parameters"), core.new("Inputs")
    core.lib.variables_set_start(p, u)
    for struct, table in ((p, variables.PARAMETERS), (u, variables.INPUTS)):
        for v in table.values():
            group, member = re.sub(r"\[\w\]", "", v.name).split(".")
            value = getattr(getattr(struct, group), member)
            assert (list(value) if v.count > 1 else [value]) == [v.start] * v.count, v.name
    element = core.ffi.new("int *")
    for v in TABLE.variables:
        for j, (_, vr) in enumerate(v.elements):
            found = core.lib.variable_find(vr, element)
            assert (core.ffi.string(found.name).decode(), element[0]) == (v.name, j)
            assert (found.min, found.max) == tuple(map(float, v.limits)), v.name
        assert core.lib.variable_find(v.vr + v.count, element) == core.ffi.NULL or not v.is_array, v.name
    for unknown in (998, 999, 7000, 2**32 - 1):
        assert core.lib.variable_find(unknown, element) == core.ffi.NULL


def test_docs_name_every_variable():
    text = (ROOT / "docs" / "parameters.md").read_text()
    for v in TABLE.variables:
        assert f"| `{v.name}` |" in text
    assert "| `joint.preload` | 20 N | 0 N … 1000 N |" in text


def write(path, text):
    path.write_text(text)
    return path


def test_bearing_file_sets_balls_and_start_values(tmp_path):
    table = generate.load_table(
        write(
            tmp_path / "b.toml",
            'Z = 12\n[parameters]\nbearing.D = 0.01\nring.tilt_mode = "supported"\n[inputs]\nshaft.F_y = 100\n',
        )
    )
    by_name = {v.name: v for v in table.variables}
    assert table.Z == 12
    assert (by_name["bearing.D"].start, by_name["ring.tilt_mode"].start, by_name["shaft.F_y"].start) == (0.01, 2, 100.0)
    assert len(by_name["ball[j].Q_i"].elements) == 12
    # 13 states a ball and joint
    assert table.states[-1].offset + table.states[-1].count == variables.N_STATES + 13 * (12 - variables.Z)
    assert table.guid != TABLE.guid


def test_the_state_has_room_for_the_modes_of_the_table(tmp_path):
    """As many octets as the shipped table's modes need; a bearing of other balls says how many its own table does."""
    modes = rivet_table.read(rivet_table.DEFAULT_TABLE).modes
    assert {block.count for block in TABLE.elastic_states} == {modes.room} == {40}
    table = generate.load_table(write(tmp_path / "b.toml", "Z = 18\nmodes = 80\n"))
    assert {block.count for block in table.elastic_states} == {80}


@pytest.mark.parametrize(
    ("pairs", "a", "b", "room"), [(15, 2, 0, 40), (16, 0, 0, 32), (24, 0, 0, 48), (24, 1, 0, 56), (19, 1, 0, 40)]
)
def test_room_for_modes(pairs, a, b, room):
    """Octets for all modes; half of the room, in octets too, takes the coordinates of one kind."""
    parity = np.array([0] * pairs + [1] * a + [-1] * b)
    assert HalfModes.room.fget(SimpleNamespace(parity=parity, count=np.where(parity == 0, 2, 1))) == room


@pytest.mark.parametrize(
    "path", sorted((ROOT / "riveted_bearing" / "data" / "bearings").glob("*.toml")), ids=lambda path: path.stem
)
def test_shipped_bearings_are_accepted(path):
    assert len(generate.generate(path)) == len(generate.OUTPUTS)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("Z = 4", r"Z = 4: allowed is an integer from 5 to 32"),
        ("[parameters]\nbearing.D = 1.0", r"bearing\.D = 1\.0: allowed is 0\.001 \.\.\. 0\.1 m"),
        ("[parameters]\nbearing.D = nan", r"bearing\.D = nan: allowed is"),
        ('[parameters]\nbearing.D = "1 mm"', r"bearing\.D = '1 mm': allowed is"),
        (
            "[parameters]\nbearing.diameter = 0.01",
            r"bearing\.diameter = 0\.01: unknown parameter, allowed are bearing\.D,",
        ),
        (
            '[parameters]\nring.tilt_mode = "loose"',
            r"ring\.tilt_mode = 'loose': allowed is one of prescribed, supported, free",
        ),
        ("[inputs]\nring.m = 1.0", r"ring\.m = 1\.0: unknown input, allowed are shaft\.F_x,"),
    ],
)
def test_wrong_bearing_file_is_refused_by_name(tmp_path, text, message):
    path = write(tmp_path / "wrong.toml", text)
    with pytest.raises(ValueError, match=f"{re.escape(str(path))}: {message}"):
        generate.load_table(path)
    result = subprocess.run(
        [sys.executable, generate.__file__, "--bearing", str(path), "--out", str(tmp_path)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert result.returncode == 1
    assert result.stderr.startswith("generate: ") and "Traceback" not in result.stderr


def test_incomplete_table_is_refused(monkeypatch, tmp_path):
    text = generate.TABLE.read_text()
    for old, new, message in (
        ("vr = 2,", "vr = 1,", "shaft.F_y: shares value references with shaft.F_x"),
        ("vr = 1117,", "vr = 1116,", "cage.mu_land: shares value references with a variable that is gone"),
        ('name = "ring.y"', 'name = "ring.x"', "ring.x: given twice"),
        ('unit = "kg.m"', 'unit = "kg m"', "cage.unbalance: unknown unit 'kg m'"),
    ):
        monkeypatch.setattr(generate, "TABLE", write(tmp_path / "variables.toml", text.replace(old, new, 1)))
        with pytest.raises(ValueError, match=re.escape(message)):
            generate.load_table()
