"""Refusals of files, replayed: refusals.json has files that cannot be used and what the program said of each.

The files were written for the tests of the readers, each with the words that its message has to have: the key as the user
wrote it, the value, what is allowed or the nearest name.  Who changes a message changes it in the record too, so that
somebody has seen each difference.  A further file goes into the record with the message wanted.
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
    assert found and {old: new for old, new in found if new != old} == {}


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


def test_the_page_of_keys_is_the_models():
    """`riveted-bearing schema > docs/files.md` writes it anew."""
    assert (ROOT / "docs" / "files.md").read_text(encoding="utf-8") == page()


@pytest.mark.parametrize("kind", FILES)
def test_every_kind_of_file_has_a_schema(kind):
    """JSON Schema of the keys that a refusal allows, without null, which TOML does not have."""
    found = json_schema(model_of(kind))
    assert found["properties"].keys() == model_of(kind).model_fields.keys() and "null" not in json.dumps(found)
