"""The pages: links lead somewhere, the cookbook's commands do what they say, the site is whole and needs no network."""

import contextlib
import fnmatch
import glob
import html.parser
import os
import re
import shlex
import subprocess
import sys
from dataclasses import fields
from pathlib import Path
from urllib.parse import unquote

import pytest
import typer
from commands import run_in_shell
from typer.main import get_command

from bearing_model.generated import variables
from rivet_model.geometry import Geometry
from riveted_bearing import cli

ROOT = Path(__file__).resolve().parents[1]
DOCS = ROOT / "docs"
PAGES = [*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md"), *(ROOT / "examples").rglob("*.md")]
COOKBOOK = (ROOT / "docs" / "cookbook.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```(\w+)\n(.*?)^```", COOKBOOK, re.S | re.M)
LINK = re.compile(r"(?<!\\)\[(?:[^][]|\[[^]]*\])*\]\(([^)\s]+)\)")


def without_code(text):
    return re.sub(r"```.*?```|`[^`\n]*`", "", text, flags=re.S)


def anchors(path):
    """Names of a page's headings as GitHub makes them."""
    titles = re.findall(r"^#+ (.*)$", re.sub(r"```.*?```", "", path.read_text(encoding="utf-8"), flags=re.S), re.M)
    return {re.sub(r"[^\w -]", "", title).lower().replace(" ", "-") for title in titles}


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_no_link_is_dead(page):
    for target in LINK.findall(without_code(page.read_text(encoding="utf-8"))):
        if target.startswith(("http", "mailto:")):
            continue
        path, _, anchor = target.partition("#")
        place = (page.parent / path).resolve() if path else page
        assert place.exists(), f"{page.name}: {target}"
        assert not anchor or anchor in anchors(place), f"{page.name}: {target}"


def command_lines():
    """Calls of the program in the blocks of all pages."""
    blocks = (
        block
        for page in PAGES
        for block in re.findall(r"^```sh\n(.*?)^```", page.read_text(encoding="utf-8"), re.S | re.M)
    )
    return sorted({line for block in blocks for line in block.splitlines() if line.startswith("riveted-bearing ")})


@pytest.mark.parametrize("line", command_lines())
def test_commands_parse(line):
    """Known command, options and kinds of value."""
    _, name, *arguments = shlex.split(line, comments=True)
    program = get_command(cli.program)
    with typer.Context(program) as context:
        program.get_command(context, name).make_context(name, arguments, parent=context)


def without_numbers(name):
    """A variable's name without the number, or the letter for it, of its rivet, ball or wave."""
    return re.sub(r"\[[^]]*\]", "[]", name)


KNOWN = {without_numbers(name) for name in variables.INPUTS | variables.PARAMETERS | variables.OUTPUTS}
GROUPS = {re.split(r"[.[]", name)[0] for name in KNOWN}
KNOWN |= {f"rivet.{field.name}" for field in fields(Geometry)}  # keys of a bearing's file
KNOWN |= {"bearing.F_y", "bearing.F_z", "bearing.M_x", "solver.cpu_time"}  # inputs of examples/transmission; a local
FOLDERS = (
    "fmu_src",
    "bearing_model",
    "rivet_model",
    "riveted_bearing",
    "benchmarks",
    "tests",
    "examples",
    "fmus",
    "docs",
    "cmake",
)
PLACEHOLDERS = {
    "tests/test_x.py",
    "fmus/Transmission-2.0.ssp",
    "fmus/Transmission.ssp",
    "fmus/Shaft.fmu",
    "fmus/RivetedBearing.fmu",
}


def named(page):
    """What stands in backticks on a page, as words."""
    text = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.S | re.M)
    return {word for code in re.findall(r"`([^`\n]+)`", text) for word in re.split(r"[\s,=]+", code)}


@pytest.mark.parametrize(
    "page", sorted({*ROOT.glob("*.md"), *DOCS.glob("*.md")} - {DOCS / "files.md"}), ids=lambda path: path.name
)
def test_names_on_a_page_exist(page):
    """Variables of the FMU, also with a star, and files of the project; files.md has keys of files."""
    unknown = set()
    for word in named(page):
        if re.fullmatch(r"[a-z]+(\[\w\*?\])?\.[A-Za-z]\w*(\[\w+\])?\*?", word) and re.split(r"[.[]", word)[0] in GROUPS:
            is_file = word.endswith((".c", ".h", ".toml", ".ssv", ".fmu"))
            unknown |= (
                set()
                if is_file or fnmatch.filter(KNOWN, glob.escape(without_numbers(word)).replace("[*]", "*"))
                else {word}
            )
        elif word.split("/")[0] in FOLDERS and "/" in word and not set("*…{<") & set(word) and word not in PLACEHOLDERS:
            unknown |= (
                set() if any((ROOT / f"{word}{ending}").exists() for ending in ("", ".c", ".h", ".py")) else {word}
            )
    assert not unknown, f"{page.name}: {sorted(unknown)}"


# ------------------------------------------------------------------------------------------------------------- cookbook


SLOW = ("my6308", "rivet rivet.toml")


@pytest.fixture
def kitchen(laid):
    return laid({re.match(r"# (\S+)", text)[1]: text for language, text in BLOCKS if language in ("toml", "csv")})


def cook(kinds, skip=()):
    """Run the page's blocks in their order; what the Python blocks print."""
    for language, text in BLOCKS:
        if language == "sh" and "sh" in kinds:
            for line in text.splitlines():
                if not any(word in line for word in skip):
                    run_in_shell(line)
        elif language == "python" and "python" in kinds:
            exec(compile(text, "cookbook.md", "exec"), {"__name__": "cookbook"})


def test_the_cookbook(kitchen, capsys):
    """All but what takes minutes, which the next test does: the build of another bearing, a rivet's finite elements."""
    pytest.importorskip("xarray", reason='pip install -e ".[full]"')
    cook(("sh", "python"), skip=SLOW)
    printed = capsys.readouterr().out
    assert len(re.findall(r"N, [+-]?\d+ um: p99.9 \d+ MPa", printed)) == 2 * 2 * 2
    assert re.search(r"101 rows, largest load \d+ N", printed)
    made = {path.relative_to(kitchen).as_posix() for path in kitchen.rglob("*") if path.is_file()}
    assert {"results/demo.csv", "results/demo.mat", "results/history.html", "results/preload/runs.parquet"} <= made


@pytest.mark.slow
def test_the_slow_part_of_the_cookbook(kitchen):
    for line in (line for language, text in BLOCKS if language == "sh" for line in text.splitlines()):
        if any(word in line for word in SLOW):
            run_in_shell(line)
    assert (kitchen / "rivet" / "rivet_drawing.png").is_file()
    assert (kitchen / "results" / "my6308.parquet").is_file() and (kitchen / "results" / "my6308.png").is_file()


# ----------------------------------------------------------------------------------------------------------------- site


class Links(html.parser.HTMLParser):
    """What a page loads, what it links to, and the names in it."""

    def __init__(self, text):
        super().__init__()
        self.loaded, self.linked, self.names, self.formulas = [], [], set(), 0
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.names.add(values.get("id"))
        self.formulas += tag == "math"
        if tag in ("script", "img", "iframe") and values.get("src"):
            self.loaded.append(values["src"])
        if tag == "link" and values.get("rel") in ("stylesheet", "icon"):
            self.loaded.append(values["href"])
        if tag == "a" and values.get("href"):
            self.linked.append(values["href"])


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """The site, built as `make site` does; any warning of the generator is an error."""
    pytest.importorskip("mkdocs", reason='pip install -e ".[docs]"')
    pytest.importorskip("mkdocstrings", reason='pip install -e ".[docs]"')
    folder = tmp_path_factory.mktemp("site")
    env = os.environ | {"NO_MKDOCS_2_WARNING": "1"}
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet", "--site-dir", str(folder)]
    done = subprocess.run(command, cwd=ROOT, env=env, capture_output=True, text=True, timeout=300, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return {path.relative_to(folder).as_posix(): path for path in folder.rglob("*") if path.is_file()}


def test_the_site_needs_no_network_and_has_no_dead_link(site):
    pages = {name: Links(path.read_text(encoding="utf-8")) for name, path in site.items() if name.endswith(".html")}
    assert len(pages) >= 18
    for name, page in pages.items():
        folder = Path(name).parent
        for target in page.loaded:
            assert not target.startswith(("http:", "https:", "//")), f"{name} loads {target}"
        for target in page.linked + page.loaded:
            if target.startswith(("http:", "https:", "mailto:", "data:")) or name == "404.html":
                continue
            path, _, anchor = unquote(target).partition("#")
            place = os.path.normpath(folder / path) if path not in ("", ".") else name if not path else "index.html"
            assert place in site, f"{name}: {target}"
            assert not anchor or not place.endswith(".html") or anchor in pages[place].names | {"__tabbed_1_1"}, (
                f"{name}: {target}"
            )


def test_the_site_has_formulas_search_and_the_interface(site):
    method = Links(site["method.html"].read_text(encoding="utf-8"))
    source = without_code((ROOT / "docs" / "method.md").read_text(encoding="utf-8"))
    assert method.formulas == len(re.findall(r"\$\$.+?\$\$|\$[^$\n]+\$", source, re.S)) > 100
    assert "$" not in re.sub(
        r"<(script|code|annotation)\b.*?</\1>", "", site["method.html"].read_text(encoding="utf-8"), flags=re.S
    )
    assert re.search(r"with\s*<span><math", site["method.html"].read_text(encoding="utf-8")), (
        "a formula at a line's start stays in its sentence"
    )
    index = site["search/search_index.json"].read_text(encoding="utf-8")
    assert "joint.preload" in index and "Your own bearing" in index
    api = site["api.html"].read_text(encoding="utf-8")
    for text in ("Simulate the FMU at its own working point", "to_xarray", "Raises UserError"):
        assert text in api
    with contextlib.suppress(KeyError):
        assert "hooks.py" not in site
