"""riveted-bearing sweep: many runs, one row each."""

from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape
from rich.table import Column, Table

from ..base.files import make_folder
from .terminal import FMU, SCHEDULER, STOPPED, WORKERS, command, console, design_runs, messages, print_basis


@command
def sweep(
    study: Annotated[
        Path,
        typer.Argument(help="sweep file (TOML): scene, what varies, repeats; see docs/sweeps.md", metavar="STUDY.toml"),
    ],
    fmu: FMU = None,
    out: Annotated[Path | None, typer.Option(help="folder of the Parquet dataset; default: results/STUDY")] = None,
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
    failures = rows["message"][rows["status"] != "done"]
    spent = rows["cpu_time"][rows["status"] == "done"].sum()
    table = sweep_table(plan, rows)
    print_basis(table.basis)
    for text in fast_speeds(plan.model, plan.scenes.values()):
        messages.print(f"[yellow]note:[/] {text}", soft_wrap=True)
    if table.responses:
        print_table(table)
    console.print(f"{len(rows['key'])} runs, {len(failures)} of them failed, CPU time {spent:.1f} s")
    console.print(f"results  [cyan]{escape(str(folder))}[/]", soft_wrap=True)
    if table.responses:
        console.print(f"picture  [cyan]{escape(str(write_picture(table, folder / 'sweep.png')))}[/]", soft_wrap=True)
    if table.responses and report:
        console.print(
            f"page     [cyan]{escape(str(write_page(table, plan.description, folder / 'sweep.html')))}[/]",
            soft_wrap=True,
        )
    early = sum(status == "done" and time != time for status, time in zip(rows["status"], rows["stat.time"]))
    if early:
        messages.print(
            f"[yellow]{early} runs have no statistics: they end at or before start.settle; set simulation.t_end higher[/]",
            soft_wrap=True,
        )
    for text in dict.fromkeys(failures):
        messages.print(f"[bold red]failed:[/] {escape(text)}", soft_wrap=True)
    if len(failures):
        raise typer.Exit(STOPPED)


def print_table(table):
    """Means over seeds with their confidence, the first lines of the design."""
    from ..studies.sweep_table import CONFIDENCE, LARGEST, lines

    heads, cells = lines(table)
    shown = Table(*(Column(escape(head), justify="right") for head in heads), box=None, pad_edge=False)
    for row in cells[:LARGEST]:
        shown.add_row(*map(escape, row))
    console.print(shown)
    if len(cells) > LARGEST:
        console.print(f"... {len(cells) - LARGEST} more points: --report has them all")
    if any(table.seeds > 1):
        console.print(f"[dim]means over seeds ± half-width of the {100 * CONFIDENCE:g} % interval[/]")
