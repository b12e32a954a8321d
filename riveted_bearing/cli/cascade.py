"""riveted-bearing cascade: rivet after rivet."""

from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape
from rich.table import Column, Table

from ..base.files import make_folder
from ..base.toml_files import read_toml
from ..base.units import hours_text
from .terminal import FMU, SCHEDULER, WORKERS, command, console, design_runs, print_basis

SHIPPED = Path(__file__).resolve().parents[1] / "data" / "cascade.toml"


@command
def cascade(
    study: Annotated[
        Path | None,
        typer.Argument(
            help="cascade file (TOML): scene, seeds, cases; see docs/life.md; default: the FMU's own working point, "
            "of the 6207 with a large clearance and with interference",
            metavar="[CASCADE.toml]",
        ),
    ] = None,
    fmu: FMU = None,
    out: Annotated[
        Path | None, typer.Option(help="folder of runs, cascade.json and picture; default: results/CASCADE")
    ] = None,
    single: Annotated[
        bool, typer.Option(help="then one simulation for each seed, in which the rivets break by themselves")
    ] = False,
    scheduler: SCHEDULER = None,
    workers: WORKERS = None,
):
    """What happens when the first rivet goes: order, times and loads until three are gone, and why it ends; a second
    call does only missing runs.
    """
    from ..base.errors import UserError
    from ..design.cascade import default_document, plan_cascade, run_cascades, run_single, write_cascades, write_picture
    from ..running.fmu import Model

    if study is not None and not study.is_file():
        raise UserError(f"{study}: no such cascade file")
    model = Model(fmu)
    document = default_document(model, read_toml(SHIPPED)) if study is None else read_toml(study)
    study = study or (Path(f"{model.path.stem}_cascade.toml") if model.origin else SHIPPED)
    plan_cascade(study, document)
    folder = out or Path("results") / study.stem
    make_folder(folder)
    with design_runs(study.stem, folder, scheduler, workers) as (client, progress):
        found = run_cascades(study, document, model, folder, client, progress)
        lives = run_single(study, document, model, folder, client, found, progress) if single else None
    for rows in dict.fromkeys(each.basis for each in found):
        print_basis(rows)
    for each in found:
        print_cascade(each)
        for seed, run in enumerate(lives[each.name] if lives else (), start=1):
            order = ", ".join(f"{place} of {k} after {hours_text(hours)}" for k, place, hours in run)
            console.print(f"one simulation, seed {seed}: {order or 'nothing breaks'}", soft_wrap=True)
    for label, path in (
        ("results", write_cascades(found, folder / "cascade.json", lives)),
        ("picture", write_picture(found, folder / "cascade.png")),
    ):
        console.print(f"{label:8} [cyan]{escape(str(path))}[/]", soft_wrap=True)


def print_cascade(found):
    """A table of the states: what breaks, when, how sure, what the others then carry."""
    heads = ("breaks", "place", "after", "at", "sure", "largest head stress, MPa", "dislocation, um")
    table = Table(
        "gone",
        *(Column(text, justify="right") for text in heads),
        title=escape(found.name),
        title_justify="left",
        box=None,
        pad_edge=False,
    )
    hours = 0.0
    for state in found.states:
        hours += state.hours
        ends = (
            ("", "", "", "", "")
            if state.rivet is None
            else (
                str(state.rivet),
                state.place,
                hours_text(state.hours),
                hours_text(hours),
                f"{100 * state.sure:.0f} %",
            )
        )
        gone = ", ".join(map(str, state.gone)) or "none"
        table.add_row(
            gone,
            *ends,
            f"{state.stress.max() / 1e6:.0f}",
            f"{1e6 * state.dislocation:.1f}",
        )
    console.print(table)
    last = found.states[-1]
    console.print(f"end: {last.end}; joints open at once: {last.open} of {len(last.rates)}", soft_wrap=True)
