"""Every parameter of a bearing feeds what docs/parameters.md says: the rivet table, the run, both, or it is refused;
none is dropped in silence.
"""

import re
import sys
from pathlib import Path

import numpy as np
import pytest

from rivet_model.geometry import Geometry
from riveted_bearing import UserError, build
from riveted_bearing.bearing.bearing_file import bearing_case
from riveted_bearing.running.fmu import Model, codes
from riveted_bearing.running.runner import simulate
from riveted_bearing.running.scene import load_scene

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "fmus"))
from generate import load_table

TABLE = load_table()
PARAMETERS = {v.name: v for v in TABLE.of("parameter")}
# a bearing of its own
OWN = 'designation = "6309"\nZ = 8\n[cage]\nmaterial = "steel"\n[rivet]\nshank_diameter = "2.5 mm"\n'
SETTINGS = {"start.settle": 0.0, "scene.stress": "fatigue", "scene.statistics": "on"}
T_END = 6e-3  # balls have met their pockets
SPALL, WAVES = (
    {"angle": 0.02, "length": 2e-3, "width": 2e-3, "depth": 5e-5},
    {"waviness[n]": 1e-6, "waviness_phase[n]": 0.5},
)
INSTEAD_OF_ZERO = {  # another value where the start value is zero, which mostly stands for a rule
    "ball.E": 310e9,
    "ball.nu": 0.26,
    "ball.expansion": 3.2e-6,
    "ball[j].dD": 1e-6,
    "cage.unbalance": 1e-6,
    "cage.sheet": 1e-3,
    "cage.pocket_depth": 1e-2,
    "cage.pocket_radius": 1e-2,
    "cage.pocket_fillet": 1e-3,
    "cage.pocket_edge": 1e-4,
    "cage.pocket_filling": 0.5,
    "cage.modal_damping_high": 0.03,
    "pocket[j].dtheta": 1e-4,
    "pocket[j].dD": 1e-5,
    "rivet[k].dfit": -2e-6,
    "ring.bore": 0.9,  # of the pitch diameter less the ball's, likewise the next three
    "ring.effective_i": 1.1,
    "ring.outside": 1.2,
    "ring.effective_e": 0.95,
    "shaft.bore": 0.01,
    "shaft.interference": 1e-5,
    "housing.interference": 1e-5,
    "housing.outside": 0.3,
    "oil.flow": 1e-5,
    "joint.wear": 1e-7,
    "gravity.y": 9.81,
    "gravity.z": 9.81,
    "frame.radius": 0.1,
    "solver.step": 5e-6,
    **{f"{body}.spall_{name}": value for body in ("outer", "inner", "ball[j]") for name, value in SPALL.items()},
    **{f"{race}.{name}": value for race in ("outer", "inner") for name, value in WAVES.items()},
    "pulse.F_r": 1000.0,
    "pulse.F_a": 1000.0,
}
WHOLE = {f"{body}.spall_{size}" for body in ("outer", "inner", "ball[j]") for size in ("length", "width", "depth")}
BESIDE = {"oil.nu_1": "oil.nu_2 = 5e-6\n", "oil.nu_2": "oil.nu_1 = 25e-6\n"}
NO_EFFECT = {"solver.max_steps": "a limit that no run here reaches", "solver.clock": "measures the machine"}


def another(model, v, name):
    """A value that differs from the start value of the variable v, whose first element has the name."""
    variable = model.parameters[name]
    start = model.default(variable)
    if v.choices:
        return next(item for item in codes(variable) if item != SETTINGS.get(name, start))
    if v.name == "bearing.p_limit":
        return 1e9  # below the pressures of the working point
    if v.name in NO_EFFECT:
        return v.limits[1]
    if v.type == "Integer":
        return start + 1 if start < v.limits[1] else start - 1
    if start:
        return 1.005 * start if 1.005 * start <= v.limits[1] else 0.995 * start
    return instead_of_zero(v.name, *(float(model.parameters[f"bearing.{size}"].start) for size in ("D", "d_m")))


def instead_of_zero(name, D, d_m):
    """Another value where the start value is zero, of a bearing with these balls."""
    outer = name in ("ring.outside", "ring.effective_e")
    return INSTEAD_OF_ZERO[name] * ((d_m + D if outer else d_m - D) if name.startswith("ring.") else 1.0)


def run(model, settings):
    """All outputs and closing figures of a short run, by name."""
    document = {"parameters": dict(SETTINGS), "inputs": {}, "simulation": {"t_end": T_END, "step": 2e-4}}
    for name, value in settings.items():
        document["inputs" if name in model.inputs else "parameters"][name] = value
    result = simulate(model, load_scene(None, model, ("the test", document)))
    clocks = ("cpu", "wall", "real_time", "solver.cpu_time")
    return {
        name: values
        for name, values in (result.data | result.summary).items()
        if not name.startswith(clocks) and name not in model.inputs
    }


def felt(model, v):
    """Whether a run feels another value of v, without its needs and with them; the words of a refusal in their place."""
    name = v.elements[0][0]
    found = []
    for needs in [{}, v.needs] if v.needs else [{}]:
        try:
            changed = run(model, needs | {name: another(model, v, name)})
        except UserError as refusal:
            if v.name in WHOLE and not needs and "all three" in str(refusal):  # a spall has all of its sizes or none
                found.append(False)
                continue
            return str(refusal)
        plain = run(model, {} if v.name in WHOLE else needs)
        found.append(any(not np.array_equal(changed[key], value, equal_nan=True) for key, value in plain.items()))
    return found


def check_run(model, v):
    """The run feels the parameter as the table of variables says."""
    found = felt(model, v)
    if v.built:
        assert v.name in found and "for which this FMU and its rivet table were built" in found
    elif "cage.shape" in v.needs:
        assert v.name in found and "a machined cage (cage.shape)" in found
    elif v.name == "bearing.d_m":
        assert "bearing.d_m" in found and "build an FMU for this bearing" in found
    elif v.name in NO_EFFECT:
        assert found == [False]
    else:
        assert found == ([False, True] if v.needs else [True])


@pytest.mark.parametrize("name", PARAMETERS)
def test_what_a_run_feels(model, name):
    """A parameter of the shipped FMU, half a per cent off: some output of six milliseconds changes, and without what
    the parameter needs none does.
    """
    check_run(model, PARAMETERS[name])


@pytest.fixture(scope="module")
def own_model(tmp_path_factory):
    folder = tmp_path_factory.mktemp("own")
    (folder / "mine.toml").write_text(OWN, encoding="utf-8")
    return Model(build(folder / "mine.toml", out=folder / "mine.fmu"))


@pytest.mark.slow
@pytest.mark.parametrize("name", PARAMETERS)
def test_what_a_run_of_an_own_bearing_feels(own_model, name):
    """The same of a 6309 with eight balls, a cage of steel and rivets of 2.5 mm."""
    check_run(own_model, PARAMETERS[name])


def other_case(tmp_path, name, value):
    """The own bearing with one parameter of its file."""
    written = f'"{value}"' if isinstance(value, str) else repr(value)
    path = tmp_path / "mine.toml"
    beside = BESIDE.get(name, "")  # of an oil one point alone is refused
    path.write_text(f"{OWN}[parameters]\n{name} = {written}\n{beside}", encoding="utf-8")
    return bearing_case(path)


OF_SHAPE = {name for name, v in PARAMETERS.items() if "cage.shape" in v.needs} | {"cage.shape"}  # of another build
OF_TABLE = [name for name, v in PARAMETERS.items() if not v.is_array and name not in OF_SHAPE | {"cage.material"}]


@pytest.mark.parametrize("name", OF_TABLE)
def test_what_the_rivet_table_is_made_from(tmp_path, name):
    """A parameter of a bearing file, half a per cent off: the rivet table's geometry changes if the variable table says
    so, the FMU's value in any case.
    """
    (tmp_path / "plain.toml").write_text(OWN, encoding="utf-8")
    plain, v = bearing_case(tmp_path / "plain.toml"), PARAMETERS[name]
    start = plain.values[name]
    value = (
        next(item for item in v.choices if item != start)
        if v.choices
        else start + 1
        if v.type == "Integer"
        else 1.005 * start or instead_of_zero(name, plain.values["bearing.D"], plain.values["bearing.d_m"])
    )
    changed = other_case(
        tmp_path, name, value if v.choices or v.type == "Integer" or value <= v.limits[1] else 0.995 * start
    )
    assert changed.values[name] != start and changed.origin[name] == "yours"
    same = Geometry(**changed.joint).digest == Geometry(**plain.joint).digest
    assert same != (v.table or v.built)


def test_sizes_that_the_core_tells_are_those_of_the_table():
    """The core warns of each size that leaves the rivet table behind, but for the pitch diameter, which the load path refuses, and the pockets'
    clearance.
    """
    text = (Path(__file__).resolve().parents[1] / "fmu_src" / "instance" / "check.c").read_text(encoding="utf-8")
    said = re.findall(r'"(\w+\.\w+)"', text.partition("SIZES_OF_TABLE[] = {")[2].partition("NULL")[0])
    assert set(said) == {name for name, v in PARAMETERS.items() if v.table} - {"bearing.d_m", "cage.pocket_clearance"}
