"""riveted-bearing compare-designs: FMUs under one mission."""

from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape

from ..base.files import make_folder
from ..base.toml_files import read_toml
from .options import SCHEDULER, WORKERS
from .printing import print_paths, print_warnings, table
from .terminal import command, console, design_runs, messages, number_or_text, screen

MOST_DIFFERENCES = 12  # on the terminal


@command
def compare_designs(
    designs: Annotated[
        list[str],
        typer.Argument(
            help='FMUs, each followed by its own parameters: a.fmu b.fmu, or a.fmu a.fmu joint.preload="40 N"',
            metavar="FMU [NAME=VALUE ...] ...",
        ),
    ],
    mission: Annotated[Path, typer.Option(help="mission file (TOML), see docs/life.md")],
    out: Annotated[
        Path | None, typer.Option(help="folder of runs, designs.json and page; default: results/MISSION_designs")
    ] = None,
    scheduler: SCHEDULER = None,
    workers: WORKERS = None,
):
    """Designs under the same mission and seeds: ratios of lives and stresses with intervals, and what differs."""
    from ..duty.designs import compare_designs, read_designs
    from ..duty.designs_page import PAGE, write_page, write_record

    read_toml(mission, "mission file")
    chosen = read_designs(designs, number_or_text)
    folder = out or Path("results") / f"{mission.stem}_designs"
    make_folder(folder)
    for model in {design.model.path: design.model for design in chosen}.values():
        screen(model)

    def say(name):
        if messages.is_terminal:
            messages.print(f"[dim]{escape(name)}[/]")

    with design_runs(mission.stem, folder, scheduler, workers) as (client, progress):
        found = compare_designs(mission, chosen, folder, client, progress, say)
    print_warnings(found.warnings)
    print_comparison(found)
    print_paths(("results", write_record(found, folder)), ("page", write_page(found, folder / PAGE)))


def print_comparison(found):
    """Lives, ratios and what differs."""
    from ..base.units import hours_text
    from ..duty.designs import ends_of
    from ..duty.designs_page import parts_text, ratio_text, verdict
    from ..duty.page import interval_text
    from ..duty.raceways import card
    from ..running.budget import digits, in_line

    names, lives, others = [outcome.design.name for outcome in found.outcomes], [], []
    for name, outcome in zip(names, found.outcomes, strict=True):
        few = digits(outcome.budgets)
        life = hours_text(outcome.estimate.life, few), interval_text(*ends_of(outcome), few=few)
        lives.append((name, *life, outcome.place, ratio_text(outcome.life), verdict(outcome)))
        others.append((name, parts_text(outcome), *card(outcome.raceways)))
    heads = "design", "life", f"{100 * found.confidence:g} % interval", "fails first", "life/first", ""
    console.print(table(heads, lives))
    console.print(table(("design", "where it fails: static + swing", "raceways", ""), others))
    for outcome in found.outcomes:
        for budget in outcome.budgets.values():
            console.print(f"[dim]{escape(outcome.design.name)}: {escape(in_line(budget))}[/]")
    differ = ((name, *texts) for name, texts in found.differences[:MOST_DIFFERENCES])
    console.print(table(("differs", *names), differ, left=1 + len(names)))
    if len(found.differences) > MOST_DIFFERENCES:
        console.print(f"[dim]and {len(found.differences) - MOST_DIFFERENCES} more, on the page[/]")
