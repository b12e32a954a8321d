"""riveted-bearing schema: the keys of the program's files."""

import json
from importlib import import_module
from pathlib import Path
from typing import Annotated

import typer

from ..base.errors import unknown
from .terminal import command

FILES = {  # kind of file: module and model
    "bearing": "bearing.bearing_keys:BearingFile",
    "rivet": "bearing.bearing_keys:RivetFile",
    "scene": "running.scene_file:SceneFile",
    "sweep": "studies.sweep_file:SweepFile",
    "dataset": "studies.dataset:DatasetFile",
    "mission": "duty.mission_file:MissionFile",
    "sn": "bearing.strength:StrengthFile",
    "sensitivity": "design.sensitivity:SensitivityFile",
    "optimize": "design.optimize:OptimizeFile",
    "identify": "identify.study:IdentifyFile",
    "causes": "identify.findings:FindingsFile",
}


@command
def schema(
    kind: Annotated[str | None, typer.Argument(help=f"{', '.join(FILES)}; default: all, as a page of Markdown")] = None,
    out: Annotated[Path | None, typer.Option(help="folder of a JSON Schema for each kind, for editors")] = None,
):
    """Keys of a file as JSON Schema, which editors check TOML files by; without a kind a page with the keys of all."""
    from ..base.files import make_folder, write_json
    from ..base.schema import json_schema

    if kind is not None and kind not in FILES:
        raise unknown("schema", "kind of file", kind, FILES)
    if out is not None:
        make_folder(out)
        for name in FILES if kind is None else [kind]:
            write_json(out / f"{name}.json", json_schema(model_of(name)))
    elif kind is None:
        typer.echo(page(), nl=False)
    else:
        typer.echo(json.dumps(json_schema(model_of(kind)), indent=1))


def model_of(kind):
    """The model of a kind of file."""
    module, name = FILES[kind].split(":")
    return getattr(import_module(f"..{module}", __package__), name)


def page():
    """docs/files.md: the keys of all files in tables."""
    from ..base.schema import listed

    lines = ["# Files and their keys", "", "<!-- Written by `riveted-bearing schema`: do not edit. -->", ""]
    lines += [
        "`riveted-bearing schema mission` prints a JSON Schema, `--out schemas` writes one for each kind of file: an editor that knows TOML",
        "checks a file by it. Names of variables stand in [parameters.md](parameters.md).",
    ]
    for kind in FILES:
        model = model_of(kind)
        about = " ".join((model.__doc__ or "").split())
        lines += ["", f"## {kind.capitalize()}", "", about, "", "| key | default | |", "|---|---|---|"]
        for name, default, text in listed(model):
            cells = [f"`{name}`", f"`{default}`" if default else "", " ".join(text.split()).replace("|", "\\|")]
            lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"
