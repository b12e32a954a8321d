"""Errors that the user can put right: one message each, without a traceback."""

import re
import reprlib
from collections.abc import Iterator
from contextlib import contextmanager
from difflib import get_close_matches
from importlib import import_module
from pathlib import Path
from typing import Any

INSTEAD = {  # names that are near to others of another meaning: what does it
    "bearing.Z": "the build fixes the number of balls: Z = 9 in a bearing file",
    "oil": 'the kind of oil stands above all sections: oil = "mineral ISO VG 32"',
    "gravity.x": "gravity along the shaft is the input frame.a_x: an acceleration of the frame against it",
}


class UserError(ValueError):
    """A file, name, value or unit that cannot be used; the message says where it stands and what is allowed."""


def unknown(where: Any, kind: Any, name: str, allowed: Any, prefix: str = "") -> UserError:
    """The error for a name that is not allowed, with the nearest one if there is any; prefix: of all these names."""
    bracketed = re.sub(r"\.(\d+)(?=\.|$)", r"[\1]", str(name))  # rivet.3.intact is rivet[3].intact
    near = [bracketed] if bracketed in allowed else get_close_matches(bracketed, list(allowed), n=1, cutoff=0.6)
    listed = shortlist([f"{prefix}{one}" for one in allowed]) if prefix else shortlist(allowed)
    hint = f'did you mean "{prefix}{near[0]}"?' if near else f"allowed: {listed}"
    hint = INSTEAD.get(bracketed, hint)
    return UserError(f'{where}: unknown {kind} "{prefix}{name}"; {hint}')


def is_file(path: str | Path) -> bool:
    """Whether a path is a file; a name that the system cannot have is none."""
    try:
        return Path(path).is_file()
    except OSError:
        return False


def refusal(where: Any, key: Any, value: Any, reason: Any) -> UserError:
    """The error for a value that cannot be used."""
    return UserError(f"{where}: {key} = {reprlib.repr(value)}: {reason}")


@contextmanager
def refusing(where: Any, key: Any, value: Any) -> Iterator[None]:
    """What is wrong inside, as the error for a value."""
    try:
        yield
    except UserError as problem:
        raise refusal(where, key, value, problem) from None


@contextmanager
def naming(where: Any, kinds: tuple[type[Exception], ...] = (ValueError, ArithmeticError)) -> Iterator[None]:
    """An error of these kinds inside as a UserError that says where; a UserError stays as it is unless it is among them."""
    try:
        yield
    except kinds as problem:
        if isinstance(problem, UserError) and UserError not in kinds:
            raise
        raise UserError(f"{where}: {problem}") from None


def extra(name: str) -> str:
    """How to install what one of the package's extras brings: the package is in no index."""
    return f'pip install -e ".[{name}]" in a checkout, or pip install "riveted_bearing-….whl[{name}]" with the wheel\'s own name'


def library(name: str, what: str) -> Any:
    """A library of the extra "full"; UserError if it is missing; what: needs it."""
    try:
        return import_module(name)
    except ImportError:
        raise UserError(f"{what}: needs the library {name.partition('.')[0]}: {extra('full')}") from None


def shortlist(names: Any, length: int = 12) -> str:
    """The first names, separated by commas."""
    names = [str(name) for name in names]
    return ", ".join(names[:length]) + (f", ... ({len(names)} in all)" if len(names) > length else "")
