"""riveted-bearing study: the paper's figures again."""

from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape

from ..results import make_folder
from .terminal import FMU, SCHEDULER, WORKERS, command, console, resumable, sweep_progress


@command
def study(
    names: Annotated[list[str] | None, typer.Argument(help="sweeps of the study; default: all", metavar="NAME")] = None,
    fmu: FMU = None,
    out: Annotated[Path, typer.Option(help="folder of the runs")] = Path("results/study"),
    report: Annotated[
        Path | None, typer.Option(help="folder of paper.md and its pictures; default: that of the runs")
    ] = None,
    seeds: Annotated[
        int | None, typer.Option(min=2, help="seeds of each point; default: eight, which the report's confidence needs")
    ] = None,
    elastic: Annotated[
        bool,
        typer.Option(
            "--elastic", help="all sweeps with elastic cage halves too: their verdicts beside those of rigid halves"
        ),
    ] = False,
    scheduler: SCHEDULER = None,
    workers: WORKERS = None,
):
    """The paper's figures again and its claims one by one: runs, pictures and paper.md; a second call does only missing
    runs.
    """
    from ..fmu import Model
    from ..paper_study.paper import write_paper
    from ..paper_study.study import check_names, run_study
    from ..sweep import cluster

    model = Model(fmu)
    check_names(names or [])
    make_folder(report or out)
    with resumable(out), cluster(scheduler, workers) as client, sweep_progress() as progress:
        data = run_study(model, out, client, names, seeds, progress)
        bent = run_study(model, out / "elastic", client, names, seeds, progress, cage="elastic") if elastic else None
    path = write_paper(data, report or out, bent)
    console.print(f"report   [cyan]{escape(str(path))}[/]", soft_wrap=True)
