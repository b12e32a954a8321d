"""Files and folders: written whole or not at all, in Parquet with checksums, and the user's cache."""

import json
import os
import secrets
from pathlib import Path
from typing import Any

from .errors import UserError

KEY = "riveted_bearing"  # of the metadata in a Parquet file
FORMATS = ("parquet", "csv", "mat")


def one_line(problem: Any) -> Any:
    """An error of a library in words for a message of one line."""
    return " ".join(f"{problem}".split())[:300]


def make_folder(folder: str | Path) -> None:
    """Make a folder unless it is there; UserError if files cannot be written to it."""
    folder = Path(folder)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as problem:
        raise UserError(f"{folder}: no folder to write to: {problem.strerror}") from None
    if not os.access(folder, os.W_OK | os.X_OK):
        raise UserError(f"{folder}: no permission to write to this folder")


def cache_path(name: str) -> Path:
    """Path of a folder of the user's cache."""
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "riveted-bearing" / name


def cache_folder(name: str) -> Path:
    """A folder of the user's cache, made if it is not there."""
    folder = cache_path(name)
    try:
        make_folder(folder)
    except UserError as problem:
        raise UserError(f"{problem}; the environment variable XDG_CACHE_HOME names another cache") from None
    return folder


def write_atomically(path: Path, write: Any) -> None:
    """Let write(temporary path) make a file, then rename it to `path`: never half a file; UserError if that fails."""
    make_folder(path.parent)
    temporary = path.with_name(f".{path.stem}.{secrets.token_hex(8)}{path.suffix}")
    try:
        write(temporary)
        with temporary.open("rb+") as file:  # some file systems say only now that they are full
            os.fsync(file.fileno())
        os.replace(temporary, path)
    except OSError as problem:
        raise UserError(f"{path}: cannot be written: {problem.strerror or problem}") from None
    finally:
        temporary.unlink(missing_ok=True)


def write_text(path: str | Path, text: str) -> Path:
    """Write a text, whole or not at all; returns its path."""
    write_atomically(Path(path), lambda temporary: temporary.write_text(text, encoding="utf-8"))
    return Path(path)


def write_json(path: str | Path, document: Any) -> Path:
    """Write a document as JSON, whole or not at all; returns its path."""
    return write_text(path, json.dumps(document, indent=1) + "\n")


def write_table(table: Any, path: Path) -> None:
    """Write an Arrow table as Parquet with a checksum for each page."""
    from pyarrow import parquet

    parquet.write_table(table, path, compression="zstd", write_page_checksum=True)


def read_table(path: Path) -> Any:
    """The Arrow table of a Parquet file, its checksums compared; errors of pyarrow."""
    from pyarrow import parquet

    return parquet.read_table(path, page_checksum_verification=True, partitioning=None)


def format_of(path: Path) -> Any:
    """Format by suffix."""
    kind = path.suffix.removeprefix(".")
    if kind not in FORMATS:
        raise UserError(f'{path}: unknown format "{kind}"; allowed: {", ".join(FORMATS)}')
    return kind
