"""riveted-bearing report: one HTML page for each run."""

from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape

from .terminal import command, console


@command
def report(
    results: Annotated[Path, typer.Argument(help="result file of `run`, or a folder of such files")],
    out: Annotated[
        Path | None, typer.Option(help="the page to write, a folder for several; default: beside the results")
    ] = None,
    sensitivity: Annotated[
        Path | None, typer.Option(help="sensitivity.json of `sensitivity`, or its folder: the pages name what decides")
    ] = None,
):
    """One self-contained HTML page per run: figures, charts, and the motion to play and scrub."""
    from ..design.sensitivity import read_indices
    from ..report import report_pages

    decides = read_indices(sensitivity) if sensitivity else None
    for path in report_pages(results, out, decides):
        console.print(f"report  [cyan]{escape(str(path))}[/]", soft_wrap=True)
