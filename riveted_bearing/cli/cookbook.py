"""riveted-bearing cookbook: the pages that come with the program, without a network."""

from pathlib import Path
from typing import Annotated

import typer

from ..base.errors import UserError, unknown
from .terminal import command, console

PACKAGE = Path(__file__).resolve().parents[1]
FOLDERS = (PACKAGE.parent / "docs", PACKAGE / "_source" / "docs")  # a checkout, an installed package
FIRST = "cookbook"


@command
def cookbook(
    page: Annotated[
        str, typer.Argument(help="guide, own_bearing, cages, life, running, coupling, failure, ...; list: all pages")
    ] = FIRST,
):
    """Print a page of the documentation, by default the cookbook: tasks with the commands that do them."""
    pages = {path.stem: path for path in documentation().glob("*.md")}
    if page == "list":
        for name in sorted(pages):
            lines = pages[name].read_text(encoding="utf-8").splitlines()
            title = next(line for line in lines if line.startswith("# ")).removeprefix("# ")
            console.print(f"{name:14} {title}", markup=False)
        return
    if page not in pages:
        raise unknown("cookbook", "page", page, sorted(pages))
    text = pages[page].read_text(encoding="utf-8")
    if console.is_terminal:
        from rich.markdown import Markdown

        console.print(Markdown(text))
    else:
        console.file.write(text)


def documentation():
    """Folder of the pages; UserError if there is none."""
    for folder in FOLDERS:
        if (folder / f"{FIRST}.md").is_file():
            return folder
    raise UserError(f"the pages are not there (looked in {', '.join(map(str, FOLDERS))}): install the package again")
