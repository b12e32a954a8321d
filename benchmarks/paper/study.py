"""The paper's figures again and its claims one by one: runs, pictures and paper.md, in some 11 minutes on two cores.

python benchmarks/paper/study.py --report benchmarks/paper
"""

from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape

from riveted_bearing.base.files import make_folder
from riveted_bearing.cli.options import FMU, SCHEDULER, SETTINGS, WORKERS
from riveted_bearing.cli.terminal import changes, console, guarded, resumable, sweep_progress

FIGURES = {  # of the paper, by the sweep that makes them
    "preload": "Figs. 10, 11",
    "fit": "Figs. 12, 17, 18",
    "speed": "Fig. 13",
    "impact": "Fig. 14",
    "tilt": "Fig. 15",
    "clearance": "Fig. 16",
    "fretting": "Fig. 18",
    "rings_speed": "Fig. 13 with other rings",
    "rings_clearance": "Fig. 16 with other rings",
    "tolerance": "of the solver",
}
SWEEPS = ", ".join(f"{name} ({figures})" for name, figures in FIGURES.items())


@guarded
def study(
    names: Annotated[
        list[str] | None, typer.Argument(help=f"sweeps of the study; default: all of {SWEEPS}", metavar="NAME")
    ] = None,
    fmu: FMU = None,
    out: Annotated[Path, typer.Option(help="folder of the runs")] = Path("results/study"),
    report: Annotated[
        Path | None, typer.Option(help="folder of paper.md and its pictures; default: that of the runs")
    ] = None,
    seeds: Annotated[
        int | None, typer.Option(min=2, help="seeds of each point; default: eight, which the report's confidence needs")
    ] = None,
    settings: SETTINGS = None,
    scheduler: SCHEDULER = None,
    workers: WORKERS = None,
):
    """The paper's figures again and its claims one by one, in the scenes `paper` and `physical`: runs, pictures and
    paper.md; a second call does only missing runs. With --set: scene `paper` beside the same with your parameters.
    """
    from figures import check_names, run_columns
    from paper_page import counted, write_paper

    from riveted_bearing.running.fmu import Model
    from riveted_bearing.studies.sweep import cluster

    model = Model(fmu)
    check_names(names or [])
    yours = changes(model, settings, None, None, None) if settings else None
    make_folder(report or out)
    with resumable(out), cluster(scheduler, workers) as client, sweep_progress() as progress:
        columns = run_columns(model, out, client, names, seeds, progress, yours)
    path = write_paper(columns, report or out, settings or (), command_line(names, seeds, settings, report or out))
    for line in counted(columns):
        console.print(escape(line), soft_wrap=True)
    console.print(f"report   [cyan]{escape(str(path))}[/]", soft_wrap=True)


def command_line(names, seeds, settings, folder):
    """The command that writes a page into a folder."""
    parts = ["study.py", *(names or []), *(f"--set {setting}" for setting in settings or [])]
    parts += [f"--seeds {seeds}"] if seeds else []
    return " ".join([*parts, f"--report {folder.as_posix()}"])


if __name__ == "__main__":
    typer.run(study)
