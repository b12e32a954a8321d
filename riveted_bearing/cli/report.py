"""riveted-bearing report: one HTML page for each run."""

from pathlib import Path
from typing import Annotated

import typer

from .options import SENSITIVITY
from .printing import print_paths
from .terminal import command


@command
def report(
    results: Annotated[Path, typer.Argument(help="result file of `run`, or a folder of such files")],
    out: Annotated[
        Path | None, typer.Option(help="the page to write, a folder for several; default: beside the results")
    ] = None,
    sensitivity: SENSITIVITY = None,
    overlay: Annotated[
        Path | None,
        typer.Option(
            help='measured series (CSV, names like "housing.F_y \\[kN]"): the page shows them beside the run\'s'
        ),
    ] = None,
    column: Annotated[
        list[str] | None,
        typer.Option(
            help='column of the CSV for a channel, e.g. housing.F_y="Fy \\[kN]" or time="t \\[ms]"; repeatable',
            metavar="CHANNEL=COLUMN",
        ),
    ] = None,
):
    """One self-contained HTML page per run: figures, charts, and the motion to play and scrub."""
    from ..base.errors import UserError
    from ..design.sensitivity import read_indices
    from ..show.overlay import assigned
    from ..show.report import report_pages

    if column and not overlay:
        raise UserError(f"--column {column[0]}: needs --overlay with the file of the column")
    decides = read_indices(sensitivity) if sensitivity else None
    pages = report_pages(results, out, decides, overlay, assigned(column or []))
    print_paths(*(("report", path) for path in pages))
