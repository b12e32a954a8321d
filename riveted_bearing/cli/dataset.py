"""riveted-bearing dataset: labelled signals of many runs."""

from pathlib import Path
from typing import Annotated

import typer

from ..base.files import make_folder
from .options import FMU, OUT, SCHEDULER, WORKERS, file_argument
from .printing import print_runs
from .terminal import STOPPED, command, design_runs


@command
def dataset(
    study: Annotated[
        Path, file_argument("STUDY.toml", "dataset file (TOML): a sweep file with \\[dataset]; see docs/surfaces.md")
    ],
    fmu: FMU = None,
    out: OUT = None,
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
    faults = rows["label.fault"]
    counts = ", ".join(f"{name} {sum(faults == name)}" for name in dict.fromkeys(faults) if name)
    if print_runs(rows, f"signals ({counts})", folder / ROWS):
        raise typer.Exit(STOPPED)
