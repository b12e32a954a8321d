"""Refusals of files, replayed: refusals.json has files that cannot be used and what the program said of each.

The files were written for the tests of the readers, each with the words that its message has to have: the key as the user
wrote it, the value, what is allowed or the nearest name.  A message that is another one since then stands beside the old
one in CHANGED, so that somebody has seen each difference.  A further file goes into the record with the message wanted.
"""

import copy
import json
from pathlib import Path

import pytest
from library import ROOT

from riveted_bearing.base.errors import UserError
from riveted_bearing.base.schema import json_schema
from riveted_bearing.base.toml_files import check_integers, read_toml
from riveted_bearing.bearing import bearing_file
from riveted_bearing.cli.schema import FILES, model_of, page
from riveted_bearing.design.optimize import plan_optimize
from riveted_bearing.design.sensitivity import plan_sensitivity
from riveted_bearing.duty.mission import plan_mission
from riveted_bearing.duty.tolerances import read_tolerances
from riveted_bearing.identify.study import plan_identify
from riveted_bearing.running import scene
from riveted_bearing.running.fmu import Model
from riveted_bearing.studies.sweep_file import plan_sweep

RECORD = json.loads(Path(__file__).with_name("refusals.json").read_text(encoding="utf-8"))
READERS = {  # of a document, which reads the file itself where the program can read files only
    "bearing": lambda path, document, model: bearing_file.bearing_case(path),
    "scene": lambda path, document, model: scene.load_scene(path, model),
    "sweep": lambda path, document, model: plan_sweep("FILE", document, model, path),
    "mission": lambda path, document, model: plan_mission("FILE", document, model, path),
    "tolerance": lambda path, document, model: read_tolerances(plan_mission("FILE", document, model, path), model),
    "sensitivity": plan_sensitivity,
    "optimize": plan_optimize,
    "identify": plan_identify,
}
CHANGED = {  # old message: new one
    # The name of the section made keys look alike that are not.
    'FILE: unknown key "sample."; did you mean "sample.seed"?': (
        'FILE: unknown key "sample."; allowed: sample.method, sample.count, sample.seed, sample.between'
    ),
    'FILE: unknown key "history."; did you mean "history.time"?': (
        'FILE: unknown key "history."; allowed: history.file, history.inputs, history.parameters, history.time, '
        "history.hours, history.longest_gap"
    ),
    'FILE: unknown key "preload_loss.a"; did you mean "preload_loss.factor"?': (
        'FILE: unknown key "preload_loss.a"; allowed: preload_loss.hours, preload_loss.factor'
    ),
    'FILE: unknown key "table.a"; did you mean "table.file"?': (
        'FILE: unknown key "table.a"; allowed: table.file, table.inputs, table.parameters, table.hours'
    ),
    'FILE: unknown key "screen.points"; did you mean "screen.count"?': (
        'FILE: unknown key "screen.points"; allowed: screen.method, screen.count, screen.trajectories, screen.levels'
    ),
    'FILE: unknown catalogue key ""; allowed: bore, outside_diameter, width, C, C_0, C_u, minimum_load, clearance': (
        'FILE: unknown key "catalogue."; allowed: catalogue.bore, catalogue.outside_diameter, catalogue.width, catalogue.C, '
        "catalogue.C_0, catalogue.C_u, catalogue.minimum_load, catalogue.clearance"
    ),
    'FILE: unknown rivet key "E_flange"; allowed: shank_diameter, head_diameter, head_height, fillet_radius, relief_radius, '
    "relief_depth, edge_break, flange_thickness, patch_radius, middle_zone, T_0, seat_diameter, ... (23 in all)": (
        'FILE: unknown key "rivet.E_flange"; allowed: rivet.shank_diameter, rivet.head_diameter, rivet.head_height, '
        "rivet.fillet_radius, rivet.relief_radius, rivet.relief_depth, rivet.edge_break, rivet.flange_thickness, "
        "rivet.patch_radius, rivet.middle_zone, rivet.T_0, rivet.seat_diameter, ... (23 in all)"
    ),
    # Keys that events and points have in common come first.
    'FILE: event 1: unknown key ""; allowed: name, count, after_settle, preload_factor, scene, simulation, parameters, inputs': (
        'FILE: event 1: unknown key ""; allowed: name, preload_factor, scene, simulation, parameters, inputs, count, after_settle'
    ),
    'FILE: point 1: unknown key ""; allowed: name, hours, share, preload_factor, interpolate, scene, simulation, parameters, inputs': (
        'FILE: point 1: unknown key ""; allowed: name, preload_factor, scene, simulation, parameters, inputs, hours, share, interpolate'
    ),
    "FILE: history: inputs = []: not a table": "FILE: history.inputs = []: not a table",
    "FILE: table: inputs = -1: not a table": "FILE: table.inputs = -1: not a table",
    "FILE: preload_loss.hours = [1, 2]: they must begin with 0 and increase": (
        "FILE: preload_loss.hours = [1.0, 2.0]: they must begin with 0 and increase"
    ),
    "FILE: change = -1: [[change]] tables with at and parameters are needed": (
        "FILE: change: write [[change]] with its keys below it"
    ),
    "FILE: vary: write [[vary]] with a name and a list below it": "FILE: vary: write [[vary]] with its keys below it",
    "FILE: sample: between = 3: not a table": "FILE: sample.between = 3: not a table",
    'FILE: target 1: unknown key "weight"; allowed: measure, line, frequency, width, value, point, over, minus, uncertainty, held_out': (
        'FILE: target 1: unknown key "weight"; allowed: point, over, minus, uncertainty, held_out, measure, line, frequency, width, value'
    ),
    "FILE: tolerance.share = 2.0: above 0 and up to 1 is allowed": "FILE: tolerance.share = 2: above 0 and up to 1 is allowed",
    # Bounds name all values that they follow from, and moments of inertia may miss theirs by 1 %, as in the FMU.
    "FILE: cage.D_i = '50 mm': at least 55.95 mm is allowed for a cage that passes over the inner ring's shoulder, "
    "with bearing.d_m = 65 mm, bearing.D = 15.08 mm, bearing.h_i = 0.2": (
        "FILE: cage.D_i = '50 mm': at least 55.95 mm is allowed for a cage that passes over the inner ring's shoulder, "
        "with bearing.d_m = 65 mm, bearing.D = 15.08 mm, bearing.P_d = 0.013 mm, bearing.h_i = 0.2"
    ),
    "FILE: cage.D_o = '85 mm': at most 79.81 mm is allowed for a cage that, with its guide clearance, fits inside "
    "the outer groove's bottom, with bearing.d_m = 65 mm, bearing.D = 15.08 mm, cage.guide_clearance = 0.2714 mm": (
        "FILE: cage.D_o = '85 mm': at most 79.81 mm is allowed for a cage that, with its guide clearance, fits inside "
        "the outer groove's bottom, with bearing.d_m = 65 mm, bearing.D = 15.08 mm, bearing.P_d = 0.013 mm, "
        "cage.guide_clearance = 0.2714 mm"
    ),
    "FILE: cage.D_o = 0.0802: at most 0.07981 m is allowed for a cage that, with its guide clearance, fits inside "
    "the outer groove's bottom, with bearing.d_m = 65 mm, bearing.D = 15.08 mm, cage.guide_clearance = 0.2714 mm": (
        "FILE: cage.D_o = 0.0802: at most 0.07981 m is allowed for a cage that, with its guide clearance, fits inside "
        "the outer groove's bottom, with bearing.d_m = 65 mm, bearing.D = 15.08 mm, bearing.P_d = 0.013 mm, "
        "cage.guide_clearance = 0.2714 mm"
    ),
    "FILE: cage.J_p = 0.001: at most 8.448e-05 kg.m2 is allowed for a half with its mass inside cage.D_o, with "
    "cage.m = 63.17 g, cage.D_o = 73.14 mm": (
        "FILE: cage.J_p = 0.001: at most 8.533e-05 kg.m2 is allowed for a half with its mass inside cage.D_o, with "
        "cage.m = 63.17 g, cage.D_o = 73.14 mm"
    ),
    "FILE: cage.J_p = 1e-05: at least 5.656e-05 kg.m2 is allowed for a half with its mass outside cage.D_i, with "
    "cage.m = 63.17 g, cage.D_i = 59.84 mm": (
        "FILE: cage.J_p = 1e-05: at least 5.599e-05 kg.m2 is allowed for a half with its mass outside cage.D_i, with "
        "cage.m = 63.17 g, cage.D_i = 59.84 mm"
    ),
    "FILE: cage.J_p = 8.448e-05: at most 7.226e-05 kg.m2 is allowed for moments of inertia of a body, with cage.J_t "
    "= 3.606e-05 kg.m2": (
        "FILE: cage.J_p = 8.448e-05: at most 7.284e-05 kg.m2 is allowed for moments of inertia of a body, with cage.J_t "
        "= 3.606e-05 kg.m2"
    ),
    "FILE: cage.J_t = 1e-05: at least 3.553e-05 kg.m2 is allowed for moments of inertia of a body, with cage.J_p = "
    "7.12e-05 kg.m2": (
        "FILE: cage.J_t = 1e-05: at least 3.525e-05 kg.m2 is allowed for moments of inertia of a body, with cage.J_p = "
        "7.12e-05 kg.m2"
    ),
    "FILE: cage.land_width = 0.009228: at most 0.00353 m is allowed for a land that does not reach over the cage's "
    "edge, with cage.land_x = 7.464 mm, cage.width = 18.46 mm": (
        "FILE: cage.land_width = 0.009228: at most 0.003543 m is allowed for a land that does not reach over the cage's "
        "edge, with cage.land_x = 7.464 mm, cage.width = 18.46 mm"
    ),
    "FILE: cage.land_x = '9 mm': at most 7.533 mm is allowed for a land that does not reach over the cage's edge, "
    "with cage.land_width = 3.393 mm, cage.width = 18.46 mm": (
        "FILE: cage.land_x = '9 mm': at most 7.539 mm is allowed for a land that does not reach over the cage's edge, "
        "with cage.width = 18.46 mm, cage.land_width = 3.393 mm"
    ),
    "FILE: cage.width = 0.01613: at least 0.01832 m is allowed for a land that does not reach over the cage's edge, "
    "with cage.land_x = 7.464 mm, cage.land_width = 3.393 mm": (
        "FILE: cage.width = 0.01613: at least 0.01831 m is allowed for a land that does not reach over the cage's edge, "
        "with cage.land_x = 7.464 mm, cage.land_width = 3.393 mm"
    ),
    "FILE: ring.J_t = 0.0001: at least 0.0002074 kg.m2 is allowed for moments of inertia of a body, with ring.J_p = "
    "0.0004154 kg.m2": (
        "FILE: ring.J_t = 0.0001: at least 0.0002057 kg.m2 is allowed for moments of inertia of a body, with ring.J_p = "
        "0.0004154 kg.m2"
    ),
    "FILE: catalogue.bore = '55 mm': at most 49.51 mm is allowed for an inner ring below its groove, with "
    "bearing.d_m = 65 mm, bearing.D = 15.08 mm": (
        "FILE: catalogue.bore = '55 mm': at most 49.51 mm is allowed for an inner ring below its groove, with "
        "bearing.d_m = 65 mm, bearing.D = 15.08 mm, bearing.P_d = 0.018 mm"
    ),
    "FILE: catalogue.outside_diameter = '79 mm': at least 80.49 mm is allowed for an outer ring above its groove, "
    "with bearing.d_m = 65 mm, bearing.D = 15.08 mm": (
        "FILE: catalogue.outside_diameter = '79 mm': at least 80.49 mm is allowed for an outer ring above its groove, "
        "with bearing.d_m = 65 mm, bearing.D = 15.08 mm, bearing.P_d = 0.015 mm"
    ),
    "FILE: bearing.d_m = '75 mm': at most 74.51 mm is allowed for an outer ring above its groove, with "
    "catalogue.outside_diameter = 90 mm, bearing.D = 15.08 mm": (
        "FILE: bearing.d_m = '75 mm': at most 74.51 mm is allowed for an outer ring above its groove, with "
        "catalogue.outside_diameter = 90 mm, bearing.D = 15.08 mm, bearing.P_d = 0.013 mm"
    ),
    "FILE: joint.preload = '900 N': at most 783.1 N is allowed for a shank that does not yield by its preload, with "
    "rivet.shank_diameter = 1.3 mm": (
        "FILE: joint.preload = '900 N': at most 783.1 N is allowed for a shank that does not yield by its preload, with "
        "rivet.yield_rivet = 590 MPa, rivet.shank_diameter = 1.3 mm"
    ),
}


@pytest.fixture(scope="module")
def model(fmu):
    return Model(fmu)


def recorded(kind):
    """Document or text, files beside it, and message of each refusal of a kind."""
    for group in RECORD:
        for said in group["said"] if group["kind"] == kind else ():
            document = copy.deepcopy(group["file"])
            for (*above, key), value in said.get("with", ()):
                table = document
                for step in above:
                    table = table[step]
                table[key] = value
            yield document, group.get("beside", {}), said["message"]


def said_of(kind, document, beside, folder, model, monkeypatch):
    """What the program says of a document, "" if it takes it."""
    for name, text in beside.items():
        (folder / name).write_text(text, encoding="utf-8")
    path = folder / "FILE"
    path.write_text(document if isinstance(document, str) else "", encoding="utf-8")

    def read(source):
        if isinstance(document, str) or Path(source) != path:
            return read_toml(source)
        check_integers(source, document)
        return copy.deepcopy(document)

    for module in (bearing_file, scene):
        monkeypatch.setattr(module, "read_toml", read)
    try:
        READERS[kind](path, read_toml(path) if isinstance(document, str) else document, model)
    except UserError as problem:
        return str(problem).replace(f"{folder}/", "")
    return ""


@pytest.mark.parametrize("kind", READERS)
def test_refusals_are_those_of_the_record(model, tmp_path, monkeypatch, kind):
    found = [
        (message, said_of(kind, document, beside, tmp_path, model, monkeypatch))
        for document, beside, message in recorded(kind)
    ]
    assert found and {old: new for old, new in found if new != CHANGED.get(old, old)} == {}


def test_each_message_is_a_line_that_names_a_file():
    """The user's own, one that stands beside it, or one that is missing there."""
    for group in RECORD:
        for message in (said["message"] for said in group["said"]):
            assert "\n" not in message
            assert (
                "FILE" in message
                or any(name in message for name in group.get("beside", ()))
                or "no such file" in message
            )


def test_changed_messages_are_of_the_record():
    assert set(CHANGED) <= {said["message"] for group in RECORD for said in group["said"]}


def test_the_page_of_keys_is_the_models():
    """`riveted-bearing schema > docs/files.md` writes it anew."""
    assert (ROOT / "docs" / "files.md").read_text(encoding="utf-8") == page()


@pytest.mark.parametrize("kind", FILES)
def test_every_kind_of_file_has_a_schema(kind):
    """JSON Schema of the keys that a refusal allows, without null, which TOML does not have."""
    found = json_schema(model_of(kind))
    assert found["properties"].keys() == model_of(kind).model_fields.keys() and "null" not in json.dumps(found)
