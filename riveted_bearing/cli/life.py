"""riveted-bearing life: from a mission's hours and events to the life of the rivets."""

from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape
from rich.table import Column, Table

from ..results import make_folder
from .terminal import FMU, SCHEDULER, WORKERS, command, console, design_runs, messages, print_basis


@command
def life(
    mission: Annotated[
        Path,
        typer.Argument(
            help="mission file (TOML): operating points, hours, events; see docs/life.md", metavar="MISSION.toml"
        ),
    ],
    fmu: FMU = None,
    out: Annotated[
        Path | None, typer.Option(help="folder of runs, life.json, page and picture; default: results/MISSION")
    ] = None,
    scheduler: SCHEDULER = None,
    workers: WORKERS = None,
):
    """Life of the rivets under a mission, with confidence: runs as many seeds as that needs; a second call does only
    missing runs.
    """
    from ..duty.assess import Runs, assess, write_record
    from ..duty.mission import load_mission
    from ..duty.notes import notes
    from ..duty.page import percent, write_page, write_picture
    from ..duty.tolerances import RECORD, read_tolerances, scatter, write_scatter
    from ..fmu import Model

    model = Model(fmu)
    plan = load_mission(mission, model)
    tolerances = read_tolerances(plan, model)
    folder = out or Path("results") / plan.name
    make_folder(folder)
    reached = []

    def say(found, target):
        reached.append(found)
        if messages.is_terminal:
            messages.print(
                f"[dim]round {len(reached)}: half-width {percent(found.half_width)} of life, wanted {percent(target)}[/]"
            )

    with design_runs(plan.name, folder, scheduler, workers) as (client, progress):
        runs = Runs(plan, model, folder, client, progress)
        found = assess(plan, runs, say)
        of_bearings = scatter(found, tolerances, model, folder, client, progress) if tolerances else None
    remarks = notes(found, runs, of_bearings)
    print_life(found, remarks)
    files = [
        ("results", write_record(found, folder)),
        ("page", write_page(found, folder / "life.html", remarks)),
        ("picture", write_picture(found, folder / "life.png")),
    ]
    if of_bearings:
        from ..design.weibull import write_weibull_plot

        files.append(("results", write_scatter(of_bearings, folder / RECORD)))
        files.append(
            (
                "picture",
                write_weibull_plot(
                    of_bearings.law, f"{plan.name}: {tolerances.bearings} bearings", folder / "weibull.png"
                ),
            )
        )
    for label, path in files:
        console.print(f"{label:8} [cyan]{escape(str(path))}[/]", soft_wrap=True)


def print_life(found, remarks):
    """Life, interval, points and rivets on the terminal."""
    from ..duty.page import cards, part_rows

    console.print(f"[bold]{escape(found.mission.name)}[/]  {escape(found.mission.description)}", soft_wrap=True)
    print_basis(found.mission.basis)
    for title, value, remark in cards(found):
        console.print(f"{title:14} [bold]{escape(value)}[/]  [dim]{escape(remark)}[/]", soft_wrap=True)
    table = Table(
        "",
        "load",
        "speed",
        *(Column(text, justify="right") for text in ("in the mission", "simulated", "damage")),
        "per",
        Column("share", justify="right"),
        box=None,
        pad_edge=False,
    )
    for row in part_rows(found):
        table.add_row(*map(escape, row))
    console.print(table)
    for remark in remarks:
        console.print(f"[dim]{escape(remark)}[/]", soft_wrap=True)
