"""Damaged bearing files, scene files and rivet tables: each is read or refused by name, never anything else.

python tests/fuzz_readers.py [SECONDS]     coverage-guided from tests/corpus/ on (needs atheris: `pip install atheris`)

A string of bytes decides what becomes of a good file: bytes of its text are changed, or one of its values is replaced
by an odd one, with the rivet table's digest made to fit, so that the checks behind it are reached.
"""

import copy
import inspect
import json
import sys
import tempfile
from functools import cache
from pathlib import Path

from fuzz_corpus import CORPUS, unpack

from bearing_model.rivet import rivet_table
from riveted_bearing.base import errors, units
from riveted_bearing.bearing import bearing_file as bearings
from riveted_bearing.running import fmu, scene

ROOT = Path(__file__).resolve().parents[1]
DATA = ROOT / "riveted_bearing" / "data"
ODD = (
    None,
    True,
    "",
    "nan",
    "x" * 300,
    "1 N",
    "\0",
    -1,
    0,
    10**400,
    1e308,
    float("inf"),
    float("nan"),
    -0.0,
    [],
    {},
    [[]],
    {"": 0},
    [1, "a"],
    5e-324,
)
TOKENS = (
    b"[",
    b"]",
    b"{",
    b"}",
    b'"',
    b"=",
    b"\n",
    b"nan",
    b"inf",
    b"1e999",
    b"-",
    b".",
    b"\x00",
    b"\xff\xfe",
    b"'''",
    b"[[",
    b"file = ",
    b"0x",
    b"99999999999999999999",
)
SCENE = """
description = "all of a scene's language"
[simulation]
t_end = "10 ms"
step = 1e-4
output_interval = 2e-4
tolerance = 1e-4
outputs = ["ring.*", "rivet[*].sigma_head_peak"]
[parameters]
joint.preload = "30 N"
ring.tilt_mode = "supported"
pulse.count = 2
[inputs]
shaft.F_y = "2994 N"
shaft.omega = { t = [0, 0.1], value = [0, 18238], unit = "rev/min", interpolation = "linear" }
"""


class Choices:
    """Numbers from a string of bytes; zeros after its end."""

    def __init__(self, data):
        self.data, self.at = data, 0

    def below(self, n):
        word = self.data[self.at : self.at + 4]
        self.at += 4
        return int.from_bytes(word, "little") % n if n else 0


def damage_text(text, choices):
    """Some bytes cut out, doubled, changed or put in."""
    data = bytearray(text)
    for _ in range(1 + choices.below(4)):
        a = choices.below(len(data) + 1)
        b = min(a + choices.below(40), len(data))
        kind = choices.below(4)
        if kind == 0:
            del data[a:b]
        elif kind == 1:
            data[a:a] = data[a:b]
        elif kind == 2:
            data[a:a] = TOKENS[choices.below(len(TOKENS))]
        elif a < len(data):
            data[a] ^= 1 + choices.below(255)
    return bytes(data)


def damage_value(document, choices):
    """The document with one of its values replaced by an odd one, left out or moved."""
    document = copy.deepcopy(document)
    node = document
    while True:
        keys = list(node) if isinstance(node, dict) else range(len(node))
        key = keys[choices.below(len(keys))]
        child = node[key]
        if not isinstance(child, (dict, list)) or not child or choices.below(4) == 0:
            break
        node = child
    if choices.below(6) == 0:
        del node[key]
    else:
        node[key] = ODD[choices.below(len(ODD))]
    return document


@cache
def model():
    return fmu.Model(ROOT / "fmus" / "RivetedBearing.fmu")


@cache
def small_table():
    """A rivet table's document with few coefficients, so that reading it is quick."""
    document = json.loads(rivet_table.DEFAULT_TABLE.read_text())
    shank = document["shank"]
    for name in rivet_table.SHANK_AXES:
        shank["knots"][name] = [shank["knots"][name][0], shank["knots"][name][-1]]
    shank["coefficients"] = shank["coefficients"][: 3**3 * len(rivet_table.SHEETS) * len(rivet_table.CHANNELS)]
    return document


def sealed(document):
    """The text of a rivet table with a digest that fits."""
    sections = {key: value for key, value in document.items() if key != "header"}
    try:
        if isinstance(document.get("header"), dict) and "digest" in document["header"]:
            document["header"]["digest"] = rivet_table.digest_of(sections)
        return json.dumps(document).encode()
    except (TypeError, ValueError):  # beyond JSON
        return b"{}"


def read_table(text, path):
    path.write_bytes(text)
    rivet_table.read(path, 9)


def read_bearing(text, path):
    path.write_bytes(text)
    bearings.bearing_case(path)


def read_scene(text, path):
    path.write_bytes(text)
    scene.load_scene(path, model())


def try_one(data):
    """One damaged file, as the bytes say; True if it was read, False if refused.  Anything else is raised."""
    choices = Choices(data)
    kind = choices.below(4)
    with tempfile.TemporaryDirectory() as folder:
        if kind == 0:
            reader, path, text = (
                read_bearing,
                Path(folder) / "bearing.toml",
                damage_text((DATA / "bearings" / "6310.toml").read_bytes(), choices),
            )
        elif kind == 1:
            reader, path, text = read_scene, Path(folder) / "scene.toml", damage_text(SCENE.encode(), choices)
        elif kind == 2:
            reader, path, text = read_table, Path(folder) / "table.json", damage_text(sealed(small_table()), choices)
        else:
            reader, path, text = read_table, Path(folder) / "table.json", sealed(damage_value(small_table(), choices))
        try:
            reader(text, path)
        except (errors.UserError, ValueError, OSError) as refusal:
            if path.name not in str(refusal):
                raise AssertionError(f"a refusal that does not name the file: {refusal}") from refusal
            return False
        return True


def main():
    import atheris

    for module in (rivet_table, bearings, errors, fmu, scene, units):
        for name, function in vars(module).copy().items():
            if inspect.isfunction(function) and function.__module__ == module.__name__:
                setattr(module, name, atheris.instrument_func(function))
    found = ROOT / "build" / "corpus_readers"
    unpack(CORPUS / "fuzz_readers.txt", found)
    atheris.Setup(
        [
            sys.argv[0],
            str(found),
            f"-max_total_time={sys.argv[1] if len(sys.argv) > 1 else 60}",
            "-max_len=64",
            "-len_control=0",
        ],
        try_one,
    )
    atheris.Fuzz()


if __name__ == "__main__":
    main()
