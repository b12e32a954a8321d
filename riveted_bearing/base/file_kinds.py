"""Which of the program's files a TOML document is, so that a file given to another command is named as what it is."""

from pathlib import Path
from typing import Any

from .errors import UserError, unknown

OF_BEARINGS = ("designation", "Z", "catalogue", "cage", "rings", "balls", "rivet", "between")
KINDS = {  # keys that only such a file has, and the command that reads it
    "bearing file": (OF_BEARINGS, "riveted-bearing build --bearing {}"),
    "mission": (
        ("point", "event", "table", "history", "life", "preload_loss", "sn", "tolerance"),
        "riveted-bearing life {}",
    ),
    "sweep": (("vary", "sample", "repeats"), "riveted-bearing sweep {}"),
    "sensitivity study": (("morris", "sobol", "responses"), "riveted-bearing sensitivity {}"),
    "search for best values": (("objectives", "trials", "limits"), "riveted-bearing optimize {}"),
    "file of findings": (("broken", "measured", "marks", "loose", "missing"), "riveted-bearing causes {}"),
}


def check_keys(path: str | Path, document: dict[str, Any], allowed: Any, meant: Any) -> None:
    """UserError for a key that is not allowed; one of another kind of file names that kind and its command."""
    for key in document:
        if key not in allowed:
            for kind, (keys, command) in KINDS.items():
                if kind != meant and key in keys:
                    raise UserError(f"{path}: this is a {kind}, not a {meant}: `{command.format(path)}` reads it")
            raise unknown(path, "key", key, allowed)
