"""riveted-bearing sweep: many runs, one row each."""

import functools
from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape

from ..results import make_folder
from .terminal import FMU, SCHEDULER, STOPPED, WORKERS, command, console, messages, resumable, sweep_progress


@command
def sweep(
    study: Annotated[Path, typer.Argument(help="sweep file (TOML): scene, what varies, repeats; see docs/sweeps.md", metavar="STUDY.toml")],
    fmu: FMU = None,
    out: Annotated[Path | None, typer.Option(help="folder of the Parquet dataset; default: results/STUDY")] = None,
    scheduler: SCHEDULER = None,
    workers: WORKERS = None,
):
    """Run a design of experiments on a Dask cluster, one row a run; a second call does only missing runs."""
    from ..fmu import Model
    from ..sweep import cluster, load_sweep, run_sweep

    plan = load_sweep(study, Model(fmu))
    folder = out or Path("results") / plan.name
    make_folder(folder)
    with resumable(folder), cluster(scheduler, workers) as client, sweep_progress() as progress:
        rows = run_sweep(plan, folder, client, functools.partial(progress, plan.name))
    failures = rows["message"][rows["status"] != "done"]
    spent = rows["cpu_time"][rows["status"] == "done"].sum()
    console.print(f"{len(rows['key'])} runs, {len(failures)} of them failed, CPU time {spent:.1f} s")
    console.print(f"results  [cyan]{escape(str(folder))}[/]", soft_wrap=True)
    for text in dict.fromkeys(failures):
        messages.print(f"[bold red]failed:[/] {escape(text)}", soft_wrap=True)
    if len(failures):
        raise typer.Exit(STOPPED)
