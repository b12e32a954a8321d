"""riveted-bearing build: an FMU for a bearing."""

from pathlib import Path
from typing import Annotated

import typer
from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

from .terminal import command, console, messages


@command
def build(
    bearing: Annotated[str | None, typer.Option(help="bearing file (TOML) or designation; default: the 6207")] = None,
    rivet: Annotated[
        Path | None,
        typer.Option(
            help="rivet table (JSON), or geometry (TOML) to make one by finite elements; default: the one shipped if it fits the bearing, else closed forms"
        ),
    ] = None,
    coarse: Annotated[bool, typer.Option("--coarse", help="with a geometry: a rough table in seconds instead of some half an hour")] = False,
    out: Annotated[
        Path | None,
        typer.Option(help="the FMU to write; default: my.fmu here for the bearing or rivet my.toml, else RivetedBearing.fmu, in a checkout in fmus/"),
    ] = None,
    platforms: Annotated[str | None, typer.Option(help="all, or names such as linux64,win64: cross-compiled; default: this machine's compiler")] = None,
):
    """Make an FMU for a bearing: needs a C compiler, takes about half a minute; with a rivet's geometry also half an hour for its table."""
    from ..builder import build_fmu, platform_names

    columns = SpinnerColumn(), TextColumn("{task.description}"), BarColumn(bar_width=30), TimeElapsedColumn()
    with Progress(*columns, console=messages, disable=not messages.is_terminal) as bar:
        task = bar.add_task("starting", total=None)

        def say(text, share=None):
            bar.update(task, description=text, total=1.0 if share else None, completed=share or 0.0)

        path = build_fmu(bearing, rivet, out, say, platform_names(platforms), coarse)
    console.print(str(path), style="cyan", soft_wrap=True)
