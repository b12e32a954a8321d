"""riveted-bearing identify: parameters from measurements."""

from pathlib import Path
from typing import Annotated

from rich.markup import escape

from ..base.files import make_folder
from ..base.toml_files import read_toml
from .options import FMU, OUT, SCHEDULER, WORKERS, file_argument
from .printing import print_basis, print_paths, table
from .terminal import command, console, design_runs


@command
def identify(
    study: Annotated[
        Path, file_argument("STUDY.toml", "study file (TOML): parameters with ranges, targets; see docs/identify.md")
    ],
    fmu: FMU = None,
    out: OUT = None,
    scheduler: SCHEDULER = None,
    workers: WORKERS = None,
):
    """Which values of unknown parameters measurements decide, and which they do not; a second call does only missing
    runs.
    """
    from ..design.sensitivity import salib
    from ..identify.answer import write_answer, write_page, write_scene
    from ..identify.fit import identify as fit
    from ..identify.rig import Rig
    from ..identify.study import plan_identify
    from ..running.fmu import Model

    document, model = read_toml(study, "study file"), Model(fmu)
    plan = plan_identify(study, document, model)
    salib("identify")  # before there is a folder
    folder = out or Path("results") / study.stem
    with design_runs(study.stem, folder, scheduler, workers) as (client, progress):
        rig = Rig(plan, document, model, folder, client, progress)
        make_folder(folder)
        found = fit(plan, rig, rig.start())
    basis = list(rig.basis())
    print_basis(basis)
    print_found(found)
    values = [one.value for one in found.intervals.values()]
    print_paths(
        ("results", write_answer(found, basis, folder / "identify.json")),
        ("scene", write_scene(found, rig.scene_at(plan.names, values), folder / "identified.toml")),
        ("page", write_page(found, basis, folder / "identify.html")),
    )


def print_found(found):
    """Parameters with intervals, errors, and the notes."""
    from ..identify.answer import error_rows, parameter_rows

    confidence = f"{100 * found.study.settings['confidence']:g} % interval"
    console.print(table(("parameter", "value", confidence, "searched", ""), parameter_rows(found)))
    console.print(table(("targets", "number", "error after the fit", "before"), error_rows(found)))
    console.print("[dim]errors: RMS of (result - measured)/uncertainty with fresh seeds[/]")
    for note in found.notes:
        console.print(escape(note))
