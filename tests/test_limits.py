"""Bearings that cannot be built are refused by the user's own key, value and unit with what is allowed; possible ones
pass.
"""

import re

import numpy as np
import pytest
from mechanics import Instance
from ribbon import RIBBON

from bearing_model.generated import variables
from bearing_model.generated.limits import LIMITS
from bearing_model.physics.parameters import Parameters, in_force, place
from riveted_bearing import UserError
from riveted_bearing.base.units import to_si
from riveted_bearing.bearing.bearing_file import bearing_case
from riveted_bearing.bearing.catalogue import entries
from riveted_bearing.bearing.file_values import unit_of, unit_scales

BASE = {"designation": '"6308"'}  # what a file leaves out follows by catalogue and rule

OTHER = {"designation": '"mine"', "Z": "8", "bearing.D": '"15.081 mm"', "bearing.d_m": '"65 mm"'}  # of its own sizes

IMPOSSIBLE = [  # what the file says, the key that is refused; the value must be the file's own text
    ({"bearing.D": '"18 mm"'}, "bearing.D"),
    ({"bearing.D": "0.018"}, "bearing.D"),
    ({"bearing.D": '"30 mm"'}, "bearing.D"),
    ({"bearing.D": '"18000 um"'}, "bearing.D"),
    ({"bearing.d_m": '"40 mm"'}, "bearing.d_m"),
    ({"bearing.d_m": '"50 mm"'}, "bearing.d_m"),
    ({"bearing.d_m": '"75 mm"', "cage.D_o": '"83 mm"', "cage.D_i": '"70 mm"'}, "bearing.d_m"),
    ({"Z": "11"}, "Z"),
    ({"Z": "10"}, "Z"),
    ({"Z": "32"}, "Z"),
    ({"cage.pocket_clearance": '"4 mm"'}, "cage.pocket_clearance"),
    ({"cage.D_o": '"85 mm"'}, "cage.D_o"),
    ({"cage.D_o": "0.0802"}, "cage.D_o"),
    ({"cage.D_o": '"68 mm"'}, "cage.D_o"),
    ({"cage.D_o": '"59 mm"'}, "cage.D_o"),
    ({"cage.D_i": '"50 mm"'}, "cage.D_i"),
    ({"cage.D_i": '"62 mm"'}, "cage.D_i"),
    ({"cage.D_i": '"74 mm"'}, "cage.D_i"),
    ({"cage.x_c": '"3 mm"'}, "cage.x_c"),
    ({"cage.x_c": '"6 mm"'}, "cage.x_c"),
    ({"cage.width": '"14 mm"'}, "cage.width"),
    ({"rivet.seat_diameter": '"9 mm"'}, "rivet.seat_diameter"),
    ({"rivet.seat_diameter": '"3 mm"'}, "rivet.seat_diameter"),
    ({"cage.width": '"24 mm"'}, "cage.width"),
    ({"cage.land_width": '"12 mm"'}, "cage.land_width"),
    ({"cage.land_x": '"9 mm"'}, "cage.land_x"),
    ({"cage.guide_clearance": '"4.9 mm"', "cage.D_o": '"76 mm"'}, "cage.D_o"),
    ({"cage.m": '"500 g"'}, "cage.m"),
    ({"cage.J_p": "1e-3"}, "cage.J_p"),
    ({"cage.J_p": "1e-5"}, "cage.J_p"),
    ({"cage.J_t": "1e-5"}, "cage.J_t"),
    ({"ring.J_t": "1e-4"}, "ring.J_t"),
    ({"bearing.P_d": '"0.9 mm"', "bearing.f_i": "0.505"}, "bearing.P_d"),
    (
        {"bearing.P_d": "-4.5e-5", "bearing.D": '"4 mm"', "bearing.d_m": '"20 mm"', "designation": '"mine"', "Z": "9"},
        "bearing.P_d",
    ),
    ({"rivet.head_diameter": '"8 mm"'}, "rivet.head_diameter"),
    ({"rivet.head_diameter": '"2.5 mm"'}, "rivet.head_diameter"),
    ({"rivet.head_height": '"8 mm"'}, "rivet.head_height"),
    ({"rivet.shank_diameter": '"3 mm"'}, "rivet.shank_diameter"),
    ({"joint.preload": '"900 N"', "rivet.shank_diameter": '"1.3 mm"'}, "joint.preload"),
    ({"rivet.fillet_radius": '"0.5 mm"'}, "rivet.fillet_radius"),
    ({"rivet.relief_depth": '"2 mm"'}, "rivet.relief_depth"),
    ({"rivet.edge_break": '"0.4 mm"'}, "rivet.edge_break"),
    ({"rivet.flange_thickness": '"0.8 mm"'}, "rivet.flange_thickness"),
    ({"rivet.middle_zone": '"0.3 mm"'}, "rivet.middle_zone"),
    (OTHER | {"catalogue.bore": '"55 mm"'}, "catalogue.bore"),
    (OTHER | {"catalogue.outside_diameter": '"79 mm"'}, "catalogue.outside_diameter"),
    (OTHER | {"cage.width": '"18.5 mm"', "catalogue.width": '"17 mm"'}, "catalogue.width"),
]
POSSIBLE = [{"designation": f'"{name}"'} for name in list(entries())[::4]] + [
    {"bearing.D": '"14 mm"'},
    {"bearing.D": '"16 mm"'},
    {"bearing.d_m": '"66 mm"'},
    {"Z": "7"},
    {"Z": "9"},
    {"cage.D_o": '"75 mm"'},
    {"cage.D_i": '"58.5 mm"'},
    {"cage.pocket_clearance": '"0.1 mm"'},
    {"cage.guide_clearance": '"0.5 mm"'},
    {"cage.m": '"80 g"'},
    {"cage.x_c": '"5.35 mm"'},
    {"cage.width": '"20 mm"'},
    {"bearing.P_d": '"60 um"'},
    {"bearing.P_d": '"-20 um"'},
    {"rivet.shank_diameter": '"2.5 mm"'},
    {"rivet.head_diameter": '"4 mm"'},
    {"rivet.head_diameter": "3.0e-3"},
    {"rivet.material": '"15CrMn"', "rivet.E": '"200 GPa"'},
    OTHER | {"catalogue.bore": '"42 mm"'},
    {"designation": '"mine"', "Z": "8", "bearing.D": '"15.081 mm"', "bearing.d_m": '"65 mm"'},
    {"designation": '"mine"', "Z": "12", "bearing.D": '"7.938 mm"', "bearing.d_m": '"54 mm"'},
]


def write(tmp_path, settings):
    """A bearing file with these settings over BASE."""
    lines = {"": [], "parameters": [], "catalogue": [], "rivet": []}
    for name, value in (BASE | settings).items():
        section = (
            name.partition(".")[0] if name.startswith(("catalogue.", "rivet.")) else "parameters" if "." in name else ""
        )
        lines[section].append(f"{name.removeprefix(f'{section}.')} = {value}")
    path = tmp_path / "mine.toml"
    path.write_text(
        "\n".join([*lines[""], *(line for name in list(lines)[1:] for line in (f"[{name}]", *lines[name]))])
    )
    return path


def complaint(path):
    """What is said against a bearing file, "" if it is accepted."""
    try:
        bearing_case(path)
    except UserError as problem:
        return str(problem)
    return ""


@pytest.mark.parametrize(("settings", "key"), IMPOSSIBLE, ids=lambda value: str(value))
def test_impossible_bearings_are_refused_by_the_users_own_key(settings, key, tmp_path):
    """The message names file, key, the value as written and a bound in its unit; a value just inside that bound is not
    refused by the same words.
    """
    path = write(tmp_path, settings)
    with pytest.raises(UserError) as refused:
        bearing_case(path)
    text = str(refused.value)
    written = settings[key]
    value = re.escape(written.replace('"', "'")) if '"' in written else r"[-\d.e]+"
    match = re.match(
        rf"{re.escape(str(path))}: {re.escape(key)} = {value}: (at most|at least) ([-\d.e+]+)(?: (\S+))? is allowed for ([^,]+)",
        text,
    )
    assert match, text
    words, number, unit, reason = match.groups()
    if key == "Z":
        return
    if '"' in written:
        assert unit == written.strip('"').split()[1]
    bound = to_si(f"{number} {unit}" if unit else float(number), unit_scales(unit_of(key)))
    assert (
        bound < to_si(written.strip('"'), unit_scales(unit_of(key))) if '"' in written else bound < float(written)
    ) == (words == "at most")
    assert reason not in complaint(write(tmp_path, settings | {key: repr(bound)}))


@pytest.mark.parametrize("settings", POSSIBLE, ids=lambda value: str(value))
def test_possible_bearings_are_accepted(settings, tmp_path):
    case = bearing_case(write(tmp_path, settings))
    assert case.equilibrium().Q_i.max() > 0.0


def test_there_are_forty_of_each():
    assert len(IMPOSSIBLE) >= 40 and len(POSSIBLE) >= 40


def test_a_standards_head_is_refused_by_its_name(tmp_path):
    """DIN 660 has a head of 2.8 mm for a shank of 1.6 mm, which a 6205's bar has no room for: the file says no diameter."""
    path = tmp_path / "mine.toml"
    path.write_text('designation = "6205"\n[rivet]\nhead = "DIN 660"\nshank_diameter = "1.6 mm"\n')
    text = complaint(path)
    assert text.startswith(f"{path}: rivet.head = 'DIN 660': rivet.head_diameter is 2.8 mm by it; at most 2."), text


# ------------------------------------------------------------------------------------------------ between parameters

SPALL = {
    f"{body}.spall_{size}": 1e-4 for body in ("inner", "outer", "ball[j]") for size in ("length", "width", "depth")
}
SCENES = (  # in one of which each limit counts and can be passed
    {},
    RIBBON,
    {"ring.tilt_mode": 2, "scene.stress": 1, "pulse.count": 2},
    {"solver.method": 2, **SPALL},
    {"ball[j].dD": 1e-6, "pocket[j].dD": -1.8e-4},
    {"bearing.D": 14.5e-3},
    {"bearing.D": 4e-3},
)
OF_ONE = [limit for limit in LIMITS if limit.at != "build" and limit.quantity in variables.PARAMETERS]


def with_value(scene, limit, value):
    """Parameters of a scene with a value of the limit's quantity, of its first element; their values for C too."""
    values = {name: [x] * variables.PARAMETERS[name].count if "[" in name else x for name, x in scene.items()}
    p = Parameters(values)
    group, member = place(limit.quantity)
    whole = getattr(getattr(p, group), member)
    whole = [value, *whole[1:]] if limit.is_array else value
    setattr(getattr(p, group), member, np.array(whole) if limit.is_array else whole)
    return in_force(p), values | {limit.quantity: whole}


def broken(limit):
    """Values just beyond a limit, by name, and the message on them."""
    v, j = variables.PARAMETERS[limit.quantity], 0 if limit.is_array else None
    allowed = list(getattr(variables, v.type, ()))
    for scene in SCENES:
        bound = limit.bound(in_force(Parameters(scene)), variables.Z, j)
        size = abs(bound) or 1e-3
        for value in allowed or [bound, bound + 0.03 * size, bound - 0.03 * size]:
            p, values = with_value(scene, limit, value)
            inside = allowed or (v.min or -np.inf) <= value <= (v.max or np.inf)
            if inside and not limit.holds(p, variables.Z, j):
                return values, limit.message(p, variables.Z, j)
    return None, None


@pytest.mark.parametrize("limit", OF_ONE, ids=lambda limit: f"{limit.quantity} {limit.sign} for {limit.reason}"[:60])
def test_both_twins_refuse_what_lies_beyond_a_limit(core, limit):
    """In the same words, which name variable, value and bound."""
    values, message = broken(limit)
    with pytest.raises(ValueError) as refusal:
        Instance(core, values)
    assert message in str(refusal.value)
    if limit.at == "everywhere":
        with pytest.raises(ValueError, match=" is allowed for "):
            Parameters(values)
