"""riveted-bearing summary: one sheet of paper on a mission or a run."""

from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape

from ..base.errors import UserError
from ..base.files import FORMATS, make_folder
from .life import SHEET, write_life
from .options import CLEANLINESS, FMU, SCHEDULER, SENSITIVITY, WORKERS, file_argument
from .printing import print_paths, print_warnings
from .terminal import chosen_cleanliness, command, console, design_runs, option_value, screen


@command
def summary(
    source: Annotated[
        Path, file_argument("MISSION|RESULT", "mission file (TOML, see docs/life.md) or a result file of `run`")
    ],
    fmu: FMU = None,
    target: Annotated[str | None, typer.Option(help='life that is wanted, e.g. "10000 h"')] = None,
    sensitivity: SENSITIVITY = None,
    out: Annotated[
        Path | None,
        typer.Option(
            help="the page to write, with runs and life beside it if results/MISSION has another FMU's; default: summary.html there, or beside the result"
        ),
    ] = None,
    cleanliness: CLEANLINESS = None,
    scheduler: SCHEDULER = None,
    workers: WORKERS = None,
):
    """One page for people who do not run the model: bearing, loads, verdict, assumptions, the worst rivet. It prints on
    one A4 sheet.
    """
    from ..design.sensitivity import read_indices
    from ..duty.sheet import result_sheet, write_sheet
    from ..running.results import read_result

    hours, clean = target_hours(target), chosen_cleanliness(cleanliness)
    decides = read_indices(sensitivity) if sensitivity else None
    if source.suffix.removeprefix(".") in FORMATS:
        result = read_result(source)
        file = fmu or Path(result.about.get("fmu", ""))
        sheet = result_sheet(result, source, file if file.is_file() else None, hours, decides, clean)
        path = out or source.with_name(f"{source.stem}_summary.html")
    elif clean is not None:
        raise UserError(f"--cleanliness {cleanliness}: a mission has it in its file: cleanliness in [life]")
    else:
        sheet, folder = sheet_of_mission(source, fmu, hours, decides, out, scheduler, workers)
        path = out or folder / SHEET
    write_sheet(sheet, path)
    console.print(f"[bold]{escape(sheet.verdict[1])}[/]  {escape(sheet.verdict[2])}")
    for check in sheet.checks:
        use = "" if check.use is None else f"utilisation {check.use:.2g}"
        console.print(f"{check.title:32} {escape(check.value)}  [dim]{escape(check.allowed)}  {use}[/]")
    for fault, text in sheet.limits:
        console.print(f"[{'yellow' if fault else 'dim'}]{escape(text)}[/]")
    print_paths(("page", path))


def target_hours(target):
    """Hours of the option --target."""
    from ..base.schema import Number
    from ..duty.mission_file import HOURS

    wanted = Number(HOURS, above=0.0, words="more than 0 h is needed")
    return None if target is None else option_value("--target", target, wanted.read)


def sheet_of_mission(path, fmu, hours, decides, out, scheduler, workers):
    """The Sheet of a mission, and the folder of its runs, of which a second call does only missing ones."""
    from ..duty.assess import RECORD, Runs, assess, is_current
    from ..duty.evidence import of_mission
    from ..duty.life_budget import to_accuracy, with_budgets
    from ..duty.mission import load_mission
    from ..duty.notes import matrix_warnings, notes
    from ..duty.sheet import mission_sheet
    from ..running.fmu import Model

    model = Model(fmu)
    plan, told = to_accuracy(load_mission(path, model), model)
    print_warnings([*plan.warnings, *told])
    folder = folder_of(plan, out)
    make_folder(folder)
    screen(model)
    with design_runs(plan.name, folder, scheduler, workers) as (client, progress):
        runs = Runs(plan, model, folder, client, progress)
        found = with_budgets(assess(plan, runs), runs)
        evidence = of_mission(found, runs, model, lambda done, total: progress(done, 0, total))
    warnings = matrix_warnings(runs)
    print_warnings(warnings)
    if not is_current(found, folder):  # the pages of `life` too, so that all files are of one life
        write_life(found, folder, notes(found, runs), warnings)
    return mission_sheet(found, evidence, hours, decides, [model.path, path, folder / RECORD], warnings), folder


def folder_of(plan, out):
    """The folder of a mission's runs and life: that of `life`, or, if it is another FMU's, the one of the page."""
    from ..duty.assess import check_folder, is_of_another

    usual, remedy = Path("results") / plan.name, f"--out FOLDER/{SHEET} puts page, life and runs into another folder"
    folder = out.parent if out and is_of_another(usual, plan) else usual
    check_folder(folder, plan, remedy)
    return folder
