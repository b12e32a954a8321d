"""Scenes and tables that come with the program."""

import csv
from importlib.resources import files
from typing import Any

SHIPPED = files("riveted_bearing") / "data" / "scenes"


def shipped_scenes() -> list[str]:
    """Names of the scenes that come with the program."""
    return sorted(path.name.removesuffix(".toml") for path in SHIPPED.iterdir() if path.name.endswith(".toml"))


def csv_rows(path: Any) -> list[dict[str, str]]:
    """The rows of a table, without the lines that begin with #."""
    return list(csv.DictReader(line for line in path.read_text(encoding="utf-8").splitlines() if line[:1] != "#"))
