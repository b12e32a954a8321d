"""The record of what decides in the bearing at hand (screen.py measures it), kept under the digest of the FMU's file: beside the
FMU, or in the user's cache where that folder cannot be written.  An FMU that was built again is screened again.
"""

import json
from pathlib import Path
from typing import Any

from ..base.errors import UserError
from ..base.files import cache_path, write_json
from .fmu import Model

VERSION = 1


def paths(model: Model) -> list[Path]:
    """Where the screening of an FMU may be, the first choice first."""
    return [model.path.with_name(f"{model.path.stem}.screening.json"), cache_path("screening") / f"{model.digest}.json"]


def known(model: Any) -> dict[str, Any] | None:
    """The record of an FMU's screening, None if there is none of this file."""
    for path in paths(model):
        try:
            record = json.loads(path.read_text(encoding="utf-8"))
            if (record["version"], record["fmu_sha256"]) == (VERSION, model.digest):
                return record
        except (OSError, ValueError, KeyError, TypeError):
            continue
    return None


def keep(model, record):
    """Write a record to the first place that takes it; returns it."""
    for path in paths(model):
        try:
            write_json(path, record)
            break
        except UserError:
            continue
    return record
