"""Scenes and tables that come with the program."""

import csv
from importlib.resources import files
from pathlib import Path
from typing import Any

from .errors import UserError, is_file, unknown

SHIPPED = files("riveted_bearing") / "data" / "scenes"


def shipped_scenes() -> list[str]:
    """Names of the scenes that come with the program."""
    return sorted(path.name.removesuffix(".toml") for path in SHIPPED.iterdir() if path.name.endswith(".toml"))


def find_scene(source: Any) -> Any:
    """The file of a scene given by path or by shipped name."""
    if str(source) in shipped_scenes():
        return SHIPPED / f"{source}.toml"
    if is_file(source):
        return Path(source)
    if Path(source).suffix:
        raise UserError(f"{source}: no such scene file")
    raise unknown("scene", "name", source, shipped_scenes())


def csv_rows(path: Any) -> list[dict[str, str]]:
    """The rows of a table, without the lines that begin with #."""
    return list(csv.DictReader(line for line in path.read_text(encoding="utf-8").splitlines() if line[:1] != "#"))
