"""Names in pages and in comments exist: files, functions and variables that a text names are those of the sources.

A page's names are its inline code; of a comment they are words with an underscore and names of source files.
"""

import io
import re
import subprocess
import tokenize
from dataclasses import fields
from functools import cache
from pathlib import Path

import pytest
from test_pages import GENERATED, PAGES, name_of

from bearing_model.generated import variables
from rivet_model.geometry import Geometry

ROOT = Path(__file__).resolve().parents[1]
SOURCES = (
    "fmu_src",
    "bearing_model",
    "rivet_model",
    "riveted_bearing",
    "fmus",
    "benchmarks",
    "cmake",
    "tests",
    "examples",
    "docs/site",
)
CODE = (".c", ".h", ".py", ".toml", ".cmake", ".txt", ".js", ".html", ".yml", ".csv", ".md")
# of importers, other FMUs and SUNDIALS, made by the build, or written by the reader
ELSEWHERE = {
    "oms_addSubModel",
    "oms_initialize",
    "oms_setFixedStepSize",
    "oms_setReal",
    "fmi_headers",
    "sundials_config.h",
    "rivet_table.c",
    "OUT.c",
    "x.c",
    "x.h",
    "x.py",
    "physics/x.c",
    "bearing_frame",
    "bearing.F_y",
    "bearing.F_z",
    "bearing.M_x",
    "tests/test_x.py",
}
GREEK = (
    "alpha beta gamma delta eta theta kappa lambda mu nu rho sigma tau phi psi omega zeta tilt".split()
)  # symbols: no names
FILE = re.compile(r"(?<![\w./*])(?:[\w-]+/)*[\w-]+\.(?:c|h|py|cmake)(?![\w*])")
WORD = re.compile(r"(?<![\w.\\^{$/-])[A-Za-z]\w*[a-z]_[a-z]\w+(?![\w/*{-])")
VARIABLE = re.compile(r"([a-z]+(?:\[\w+\])?\.[A-Za-z]\w*)(?: = .*)?")
NAMES = variables.PARAMETERS | variables.INPUTS | variables.OUTPUTS | variables.LOCALS
GROUPS = {name.partition(".")[0].partition("[")[0] for name in NAMES}
WHAT = 0.5  # times the noun may stand in 1,000 words of a folder's comments; observed 0


def sources(folder):
    """Files of a folder whose comments are read."""
    files = (path for path in (ROOT / folder).rglob("*.*") if path.suffix in (".c", ".h", ".py"))
    return sorted(path for path in files if "generated" not in path.parts)


@cache
def tracked():
    """Files of the project."""
    return subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.split("\n")


def parted(path):
    """Code and comments of a source file."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".py":
        code, comments = [], []
        for token in tokenize.generate_tokens(io.StringIO(text).readline):
            is_text = token.type == tokenize.COMMENT or (
                token.type == tokenize.STRING and token.string.startswith('"""')
            )
            (comments if is_text else code).append(token.string)
        return " ".join(code), "\n".join(comments)
    if path.suffix in (".c", ".h"):
        return re.sub(r"//[^\n]*", "", text), "\n".join(re.findall(r"//[^\n]*", text))
    return text, ""


@cache
def words():
    """All words of the project's code."""
    files = [
        ROOT / name
        for name in tracked()
        if name.startswith(SOURCES) and name.endswith(CODE) and not name.endswith(".md")
    ]
    found = {word for path in files if path.exists() for word in re.findall(r"\w+", parted(path)[0])}
    return found | {Path(name).stem for name in tracked()}


def missing_files(text):
    names = {f"/{name}" for name in tracked()}
    return {name for name in FILE.findall(text) if not any(known.endswith(f"/{name}") for known in names)} - ELSEWHERE


def missing_words(text):
    found = {word for word in WORD.findall(text) if word.partition("_")[0] not in GREEK}
    return found - words() - ELSEWHERE


def missing_variables(code):
    """Names of variables that neither the table nor a rivet's file has."""
    known = {re.sub(r"\[\w\]", "", name) for name in NAMES} | {f"rivet.{field.name}" for field in fields(Geometry)}
    named = [
        match[1] for match in map(VARIABLE.fullmatch, code) if match and not match[1].endswith((".c", ".h", ".ssv"))
    ]
    missing = {n for n in named if re.sub(r"\[\w+\]", "", n) not in known} - ELSEWHERE
    return {name for name in missing if name.partition(".")[0].partition("[")[0] in GROUPS}


@pytest.mark.parametrize("page", [page for page in PAGES if name_of(page) not in GENERATED], ids=name_of)
def test_names_of_a_page(page):
    text = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.S | re.M)
    code = re.findall(r"`([^`\n]+)`", text)
    missing = missing_files(" ".join(code)) | missing_variables(code) | missing_words(" ".join(code))
    assert not missing


@pytest.mark.parametrize(
    "path", [*sources("fmu_src"), *sources("bearing_model")], ids=lambda path: path.relative_to(ROOT).as_posix()
)
def test_names_in_comments(path):
    comments = parted(path)[1]
    assert not missing_files(comments) | missing_words(comments)


@pytest.mark.parametrize("folder", ["fmu_src", "bearing_model", "rivet_model"])
def test_what_is_no_noun_in_comments(folder):
    """The thing has its name: "what is left" is "the rest"."""
    lines = [line for path in sources(folder) for line in parted(path)[1].split("\n")]
    found = [line.strip() for line in lines for _ in re.findall(r"\bwhat\b", line, re.I)]
    count = sum(len(line.split()) for line in lines)
    assert count > 10_000 and len(found) <= WHAT * count / 1000, f"{len(found)} in {count} words\n" + "\n".join(found)


def test_a_name_that_is_gone_is_found():
    assert missing_files("see nowhere.c and hertz.c") == {"nowhere.c"}
    assert missing_variables(["cage.nowhere", "cage.D_o = 3 mm", "ball[j].Q_i"]) == {"cage.nowhere"}
    assert WORD.findall("land_film_nowhere and 1") == ["land_film_nowhere"] and "land_film_force" in words()
