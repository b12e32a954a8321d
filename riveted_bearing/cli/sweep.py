"""riveted-bearing sweep: many runs, one row each."""

from pathlib import Path
from typing import Annotated

import typer

from ..base.files import make_folder
from .options import FMU, OUT, SCHEDULER, WORKERS, file_argument
from .printing import note, print_basis, print_paths, print_runs
from .printing import table as grid
from .terminal import STOPPED, command, console, design_runs, messages


@command
def sweep(
    study: Annotated[
        Path, file_argument("STUDY.toml", "sweep file (TOML): scene, what varies, repeats; see docs/running.md")
    ],
    fmu: FMU = None,
    out: OUT = None,
    scheduler: SCHEDULER = None,
    workers: WORKERS = None,
    report: Annotated[bool, typer.Option("--report", help="write a page with table and charts, sweep.html")] = False,
):
    """Run a design of experiments on a Dask cluster, one row a run; a second call does only missing runs."""
    from ..running.basis import fast_speeds
    from ..running.fmu import Model
    from ..studies.sweep import run_sweep
    from ..studies.sweep_file import load_sweep
    from ..studies.sweep_table import sweep_table, write_page, write_picture

    plan = load_sweep(study, Model(fmu))
    folder = out or Path("results") / plan.name
    make_folder(folder)
    with design_runs(plan.name, folder, scheduler, workers) as (client, progress):
        rows = run_sweep(plan, folder, client(), progress)
    table = sweep_table(plan, rows)
    print_basis(table.basis)
    for text in fast_speeds(plan.model, plan.scenes.values()):
        note(text)
    if table.responses:
        print_table(table)
    failed = print_runs(rows, "runs", folder)
    if table.responses:
        print_paths(("picture", write_picture(table, folder / "sweep.png")))
    if table.responses and report:
        print_paths(("page", write_page(table, plan.description, folder / "sweep.html")))
    early = sum(status == "done" and time != time for status, time in zip(rows["status"], rows["stat.time"]))
    if early:
        messages.print(
            f"[yellow]{early} runs have no statistics: they end at or before start.settle; set simulation.t_end higher[/]"
        )
    if failed:
        raise typer.Exit(STOPPED)


def print_table(table):
    """Means over seeds with their confidence, the first lines of the design."""
    from ..studies.sweep_table import CONFIDENCE, LARGEST, lines

    heads, cells = lines(table)
    console.print(grid(heads, cells[:LARGEST], left=0))
    if len(cells) > LARGEST:
        console.print(f"... {len(cells) - LARGEST} more points: --report has them all")
    if any(table.seeds > 1):
        console.print(f"[dim]means over seeds ± half-width of the {100 * CONFIDENCE:g} % interval[/]")
