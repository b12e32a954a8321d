"""riveted-bearing rivet: stress of the rivet of a table or a geometry."""

from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape

from ..base.files import make_folder
from .printing import note, print_paths, table
from .terminal import command, console, messages


@command
def rivet(
    source: Annotated[
        Path | None,
        typer.Argument(
            metavar="TABLE|GEOMETRY", help="rivet table (JSON) or geometry (TOML); default: the table shipped"
        ),
    ] = None,
    bearing: Annotated[
        str | None,
        typer.Option(
            help="bearing file (TOML) or designation in whose cage the rivet is, by default its own one; default: the 6207"
        ),
    ] = None,
    out: Annotated[Path, typer.Option(help="folder for the pictures")] = Path("results"),
):
    """Stress of the rivet over preload, fit and transverse load; drawing, curves, mesh, deformed section with its
    stress, modes of a cage half.
    """
    from ..building.rivet import curve_tables, rivet_curves, seat_note, source_geometry, write_pictures

    if source or bearing:
        source_geometry(source, bearing)  # a wrong file leaves no folder
    make_folder(out)
    messages.print("[dim]finite elements of the rivet and of a cage half: up to some minutes[/]")
    with messages.status("finite elements"):
        title, curves, joint = rivet_curves(source, bearing)
        paths = write_pictures(out, title, curves, joint)
    console.print(f"[bold]{escape(title)}[/]")
    for name, heads, rows in curve_tables(curves):
        console.print(f"\n[bold]{name}[/]")
        console.print(table(heads, rows, left=0))
    if text := seat_note(joint.geometry):
        note(text)
    print_paths(*(("picture", path) for path in paths))
