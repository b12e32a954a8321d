"""riveted-bearing life: from a mission's hours and events to the life of the rivets."""

from pathlib import Path
from typing import Annotated

from rich.markup import escape

from ..base.files import make_folder
from .options import FMU, OUT, SCHEDULER, WORKERS, file_argument
from .printing import print_basis, print_budgets, print_paths, print_warnings, table
from .terminal import command, console, design_runs, messages, screen

SHEET = "summary.html"  # of the command `summary`, in the same folder


@command
def life(
    mission: Annotated[
        Path, file_argument("MISSION.toml", "mission file (TOML): operating points, hours, events; see docs/life.md")
    ],
    fmu: FMU = None,
    out: OUT = None,
    scheduler: SCHEDULER = None,
    workers: WORKERS = None,
):
    """Life of the rivets under a mission, with confidence: runs as many seeds as that needs; a second call does only
    missing runs.
    """
    from ..duty.assess import Runs, assess, check_folder, is_current
    from ..duty.life_budget import to_accuracy, with_budgets
    from ..duty.mission import load_mission
    from ..duty.notes import matrix_warnings, notes
    from ..duty.page import percent
    from ..duty.tolerances import RECORD, read_tolerances, scatter, write_scatter
    from ..running.fmu import Model

    model = Model(fmu)
    plan, told = to_accuracy(load_mission(mission, model), model)
    print_warnings([*plan.warnings, *told])
    tolerances = read_tolerances(plan, model)
    folder = out or Path("results") / plan.name
    check_folder(folder, plan, "choose another folder by --out")
    make_folder(folder)
    screen(model)
    reached = []

    def say(found, target):
        reached.append(found)
        if messages.is_terminal:
            half = f"half-width {percent(found.half_width)} of life, wanted {percent(target)}"
            messages.print(f"[dim]round {len(reached)}: {half}[/]")

    with design_runs(plan.name, folder, scheduler, workers) as (client, progress):
        runs = Runs(plan, model, folder, client, progress)
        found = with_budgets(assess(plan, runs, say), runs)
        of_bearings = scatter(found, tolerances, model, folder, client, progress) if tolerances else None
    texts, warnings = notes(found, runs, of_bearings), matrix_warnings(runs)
    print_warnings(warnings)
    print_life(found, texts)
    old_sheet = (folder / SHEET).is_file() and not is_current(found, folder)
    files = write_life(found, folder, texts, warnings)
    if of_bearings:
        from ..duty.weibull import write_weibull_plot

        files.append(("results", write_scatter(of_bearings, folder / RECORD)))
        title = f"{plan.name}: {tolerances.bearings} bearings"
        files.append(("picture", write_weibull_plot(of_bearings.law, title, folder / "weibull.png")))
    print_paths(*files)
    if old_sheet:
        console.print(f"[dim]{SHEET} there is of an earlier life: riveted-bearing summary writes it again[/]")


def write_life(found, folder, texts, warnings):
    """Write all files of a Life into its folder: (label, path) of each."""
    from ..duty.assess import write_record
    from ..duty.page import write_page, write_picture

    return [
        ("results", write_record(found, folder)),
        ("page", write_page(found, folder / "life.html", texts, warnings)),
        ("picture", write_picture(found, folder / "life.png")),
    ]


def print_life(found, remarks):
    """Life, interval, points and rivets on the terminal."""
    from ..duty.page import cards, part_rows

    console.print(f"[bold]{escape(found.mission.name)}[/]  {escape(found.mission.description)}")
    print_basis(found.mission.basis)
    for title, value, remark in cards(found):
        console.print(f"{title:21} [bold]{escape(value)}[/]  [dim]{escape(remark)}[/]")
    heads = "", "load", "speed", "in the mission", "simulated", "damage", "per", "share"
    console.print(table(heads, part_rows(found), left=3))
    print_budgets(list(found.budgets.values()))
    for remark in remarks:
        console.print(f"[dim]{escape(remark)}[/]")
