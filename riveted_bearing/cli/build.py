"""riveted-bearing build: an FMU for a bearing."""

import shlex
from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape
from rich.progress import TimeElapsedColumn

from ..base.errors import UserError
from .options import CAGE
from .printing import note, print_paths
from .terminal import command, console, messages, progress_bar
from .terminal import screen as screening_of

TABLES = ("coarse", "full", "closed-form")  # of rivet.py, whose import takes a second


@command
def build(
    name: Annotated[str | None, typer.Argument(hidden=True)] = None,
    bearing: Annotated[str | None, typer.Option(help="bearing file (TOML) or designation; default: the 6207")] = None,
    rivet: Annotated[
        Path | None,
        typer.Option(help="rivet table (JSON) or geometry of the rivet (TOML); default: the bearing's own rivet"),
    ] = None,
    table: Annotated[
        str | None,
        typer.Option(
            help="coarse, full (half an hour) or closed-form: how the rivets' stress table is made; default: the shipped one if it fits, else coarse",
            metavar="|".join(TABLES),
        ),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            help="the FMU to write; default: my.fmu here for the bearing or rivet my.toml, else RivetedBearing.fmu, in a checkout in fmus/"
        ),
    ] = None,
    modes: Annotated[
        int | None,
        typer.Option(
            help="vibration modes of a cage half, a pair counted as two; default: about 5 a ball, 40 for 8 or 9"
        ),
    ] = None,
    cage: CAGE = None,
    screen: Annotated[
        bool,
        typer.Option(
            "--screen", help="measure what each assumed value does to stress and damage, and keep it beside the FMU"
        ),
    ] = False,
    platforms: Annotated[
        str | None,
        typer.Option(help="all, or names such as linux64,win64: cross-compiled; default: this machine's compiler"),
    ] = None,
):
    """Make an FMU for a bearing: needs a C compiler, takes half a minute, for the first bearing with as many balls one to two;
    with --table full half an hour more.
    """
    from ..bearing.plausible import doubts
    from ..building.builder import build_fmu, case_with, platform_names, table_copy
    from ..running.fmu import Model

    if name is not None:
        raise UserError(f"build {name}: an option names the bearing: riveted-bearing build --bearing {name}")
    for text in doubts(case_with(bearing, rivet, cage)):
        note(text)
    with progress_bar(TimeElapsedColumn()) as bar:
        task = bar.add_task("starting", total=None)

        told = []

        def say(text, share=None):
            if not messages.is_terminal and text not in told:  # a log: each step once
                told.append(text)
                messages.print(text)
            bar.update(task, description=text, total=1.0 if share else None, completed=share or 0.0)

        path = build_fmu(bearing, rivet, out, say, platform_names(platforms), table, modes, cage)
    console.print(escape(Model(path).description.description), style="dim")
    console.print(str(path), style="cyan")
    if screen:
        screening_of(Model(path))
    shown = f"riveted-bearing rivet {shlex.quote(str(table_copy(bearing, cage)))}"
    console.print(f"its stress curves and the modes of its cage as pictures: {escape(shown)}", style="dim")
    if rivet:
        from ..building.rivet import given_geometry, seat_note, write_drawing

        geometry = given_geometry(rivet, bearing or "6207")
        drawing = write_drawing(geometry, path.with_name(f"{path.stem}_rivet.png"))
        print_paths(("drawing", drawing))
        if text := seat_note(geometry):
            note(text)
