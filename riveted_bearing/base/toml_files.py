"""TOML files of users: read whole, each fault named by file, line and key."""

import json
import re
import reprlib
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from .errors import UserError, is_file, refusal
from .schema import Number
from .units import SECONDS

DEEPEST = 50  # tables or lists in each other


def read_toml(path: Path, what: str = "") -> dict[str, Any]:
    """The document of a TOML file, UTF-8 with or without a mark; UserError if it cannot be read; what: file is meant."""
    if what and not is_file(path):
        raise UserError(f"{path}: no such {what}")
    try:
        data = path.read_bytes()
        text = data.decode("utf-8-sig").replace("\r\n", "\n")
        document = tomllib.loads(text)
        check_integers(path, document)
        return document
    except UnicodeDecodeError as problem:
        row = data[: problem.start].count(b"\n") + 1
        raise UserError(f"{path}: not valid TOML: line {row} is not UTF-8: save the file as UTF-8") from None
    except tomllib.TOMLDecodeError as problem:
        raise UserError(f"{path}: not valid TOML: {problem}{quotes_hint(text, problem)}") from None
    except UserError:
        raise
    except ValueError:  # of int()
        raise UserError(f"{path}: not valid TOML: an integer of thousands of digits") from None
    except RecursionError:
        raise UserError(f"{path}: not valid TOML: tables or lists are nested too deeply") from None
    except OSError as problem:
        raise UserError(f"{path}: {problem.strerror}") from None


def check_integers(path, document, key="", depth=0):
    """UserError for an integer beyond the 64 bits that TOML has; RecursionError beyond DEEPEST."""
    if depth > DEEPEST:
        raise RecursionError
    for name, value in document.items() if isinstance(document, dict) else enumerate(document, 1):
        place = f"{key}.{name}".lstrip(".")
        if isinstance(value, dict | list):
            check_integers(path, value, place, depth + 1)
        elif isinstance(value, int) and not -(2**63) <= value < 2**63:
            raise refusal(path, place, value, "an integer of at most 64 bits is allowed")


def quotes_hint(text, problem):
    """How to write a name with brackets if the line of a TOML error begins with one, else ""."""
    line = re.search(r"line (\d+)", str(problem))
    lines = text.splitlines()
    at = int(line[1]) - 1 if line else len(lines)
    bare = re.match(r"\s*([\w.]+\[\w+\][\w.]*)\s*=", lines[at]) if at < len(lines) else None
    return f'; a name with brackets needs quotes: "{bare[1]}" = ...' if bare else ""


def section_of(where: Any, document: dict[str, Any], name: str) -> dict[str, Any]:
    """A document's table of this name, empty if there is none; UserError if it is something else."""
    section = document.get(name, {})
    if not isinstance(section, dict):
        raise refusal(where, name, section, "not a table")
    return section


def whole_name(name: str, value: Any) -> Any:
    """The name that the first key of nested tables gives: rivet.3 with {strength_factor: 0.8} is rivet.3.strength_factor."""
    while isinstance(value, dict) and value and "t" not in value and "file" not in value:
        key, value = next(iter(value.items()))
        name = f"{name}.{key}"
    return name


def leaves(tree: Any, names: Any, prefix: str = "") -> Iterator[Any]:
    """Full names and values of nested tables; a table is entered as long as some variable's name begins like it."""
    for key, value in tree.items():
        name = f"{prefix}{key}"
        if isinstance(value, dict) and any(known.startswith(f"{name}.") for known in names):
            yield from leaves(value, names, f"{name}.")
        else:
            yield name, value


def seconds(key: Any, value: Any) -> Any:
    """A time [s] of zero or more from a number or a text with a unit; UserError naming the key."""
    try:
        return Number(SECONDS, least=0.0).read(value)
    except UserError as problem:
        raise UserError(f"{key} = {reprlib.repr(value)}: {problem}") from None


def to_toml(document: dict[str, Any], table: str = "") -> Iterator[Any]:
    """Lines of TOML for nested dicts of numbers, truth values, texts and lists of these."""
    for key, value in document.items():
        if not isinstance(value, dict):
            yield f"{toml_key(key)} = {toml_value(value)}"
    for key, value in document.items():
        if isinstance(value, dict):
            name = f"{table}.{toml_key(key)}" if table else toml_key(key)
            yield f"[{name}]"
            yield from to_toml(value, name)


def toml_key(key):
    """A key, quoted unless it is a bare word."""
    return key if re.fullmatch(r"[\w-]+", key, re.ASCII) else json.dumps(key, ensure_ascii=False)


def toml_value(value):
    """A value as TOML writes it: like JSON but for nan and inf."""
    if isinstance(value, list):
        return f"[{', '.join(map(toml_value, value))}]"
    return repr(value) if isinstance(value, float) else json.dumps(value, ensure_ascii=False)
