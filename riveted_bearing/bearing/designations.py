"""Designations of bearings: those that come as files, those of the catalogue, and what others are told."""

import re
from importlib.resources import files
from pathlib import Path
from typing import Any

from ..base.errors import UserError, is_file, unknown
from . import catalogue

SHIPPED = files("riveted_bearing") / "data" / "bearings"


def shipped_bearings() -> list[str]:
    """Designations of the bearings that come as files with the program."""
    return sorted(path.name.removesuffix(".toml") for path in SHIPPED.iterdir() if path.name.endswith(".toml"))


def known_bearings() -> list[str]:
    """Designations that need no file: shipped ones and the catalogue's."""
    return [*shipped_bearings(), *(name for name in catalogue.entries() if name not in shipped_bearings())]


def find_bearing(source):
    """The file of a bearing given by path or by designation."""
    if str(source) in shipped_bearings():
        return SHIPPED / f"{source}.toml"
    if is_file(source):
        return Path(source)
    raise unknown_designation("bearing", "name or file", source, known_bearings())


def unknown_designation(where: Any, kind: Any, name: str, known: Any) -> UserError:
    """The error for an unknown designation: a suffix leads to the one without it, another number to none."""
    name = str(name)
    number = re.match(r"\d{4,}(?!\d)", name)
    if number and number[0] in known and number[0] != name:
        return UserError(
            f'{where}: unknown {kind} "{name}"; did you mean "{number[0]}"? Suffixes for seals, cage and clearance are not '
            'part of the name: a bearing file has clearance = "C3" in [catalogue]'
        )
    if number:
        return UserError(
            f'{where}: unknown {kind} "{name}"; the catalogue has {len(catalogue.entries())} bearings of the series 60, 62, 63 '
            "and 64 with bores of 10 to 110 mm; a bearing file describes others"
        )
    if Path(name).suffix == ".toml" or Path(name).name != name:
        return UserError(f"{where}: {name}: no such file")
    return unknown(where, kind, name, known)
