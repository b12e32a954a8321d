"""riveted-bearing dataset: labelled signals of many runs."""

from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape

from ..base.files import make_folder
from .terminal import FMU, SCHEDULER, STOPPED, WORKERS, command, console, design_runs, messages


@command
def dataset(
    study: Annotated[
        Path,
        typer.Argument(
            help="dataset file (TOML): a sweep file with \\[dataset]; see docs/surfaces.md", metavar="STUDY.toml"
        ),
    ],
    fmu: FMU = None,
    out: Annotated[Path | None, typer.Option(help="folder of the Parquet dataset; default: results/STUDY")] = None,
    scheduler: SCHEDULER = None,
    workers: WORKERS = None,
):
    """Run a design on a Dask cluster and keep the signals with labels; a second call does only missing runs."""
    from ..running.fmu import Model
    from ..studies.dataset import load_dataset
    from ..studies.rows import ROWS
    from ..studies.sweep import run_sweep

    plan = load_dataset(study, Model(fmu))
    folder = out or Path("results") / plan.name
    make_folder(folder)
    with design_runs(plan.name, folder, scheduler, workers) as (client, progress):
        rows = run_sweep(plan, folder, client(), progress)
    failures = rows["message"][rows["status"] != "done"]
    faults, spent = rows["label.fault"], rows["cpu_time"][rows["status"] == "done"].sum()
    counts = ", ".join(f"{name} {sum(faults == name)}" for name in dict.fromkeys(faults) if name)
    console.print(f"{len(rows['key'])} signals ({counts}), {len(failures)} failed, CPU time {spent:.1f} s")
    console.print(f"dataset  [cyan]{escape(str(folder / ROWS))}[/]", soft_wrap=True)
    for text in dict.fromkeys(failures):
        messages.print(f"[bold red]failed:[/] {escape(text)}", soft_wrap=True)
    if len(failures):
        raise typer.Exit(STOPPED)
