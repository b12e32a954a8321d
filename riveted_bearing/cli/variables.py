"""riveted-bearing variables: what can be set and read."""

from typing import Annotated

import typer
from rich.markup import escape
from rich.table import Column, Table

from .options import FMU
from .terminal import command, console


@command
def variables(
    pattern: Annotated[
        str | None,
        typer.Argument(help="part of a name, a name with * or a word of the description; default: the essential ones"),
    ] = None,
    fmu: FMU = None,
):
    """Inputs, parameters and outputs with unit, start value and limits: the essential ones, or those that match."""
    from ..base.variable_list import essentials, matching, row
    from ..running.fmu import Model

    model = Model(fmu) if fmu else None
    groups = essentials() if pattern is None else matching(pattern)
    heads = "name", "", "unit", "start", "allowed", "description"
    shown = Table(*(Column(title, no_wrap=i < 4) for i, title in enumerate(heads)), box=None, pad_edge=False)
    for title, variables in groups.items():
        shown.add_row(f"[bold]{escape(title)}[/]")
        for variable in variables:
            shown.add_row(*map(escape, row(variable, model)))
    console.print(shown)
    if pattern is None:
        console.print(
            "[dim]riveted-bearing variables PATTERN finds others, e.g. oil, ball[3].*, slip; docs/parameters.md has them all with their sources[/]"
        )
