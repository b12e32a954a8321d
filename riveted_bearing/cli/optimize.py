"""riveted-bearing optimize: which values to choose."""

from pathlib import Path
from typing import Annotated

from rich.markup import escape

from ..base.files import make_folder
from ..base.toml_files import read_toml
from .options import FMU, OUT, SCHEDULER, WORKERS, file_argument
from .printing import note, print_basis, print_budgets, print_paths, table
from .terminal import command, console, design_runs, screen


@command
def optimize(
    study: Annotated[
        Path, file_argument("STUDY.toml", "study file (TOML): variables, limits, objectives; see docs/life.md")
    ],
    fmu: FMU = None,
    out: OUT = None,
    scheduler: SCHEDULER = None,
    workers: WORKERS = None,
):
    """Which values to choose: a search under the noise of the seeds, its best points again with fresh seeds; a second
    call does only missing runs.
    """
    from ..design.bench import Bench
    from ..design.optimize import optuna_library, plan_optimize, search, write_optimum, write_picture
    from ..running.budget import of_record
    from ..running.fmu import Model

    document, model = read_toml(study, "study file"), Model(fmu)
    plan = plan_optimize(study, document, model)
    optuna_library()  # before there is a folder
    folder = out or Path("results") / study.stem
    with design_runs(study.stem, folder, scheduler, workers) as (client, progress):
        bench = Bench(study, document, model, folder, client, progress).check(plan.responses)
        make_folder(folder)
        found = search(plan, bench)
    budgets = best_budgets(found, bench, model)
    print_basis(bench.basis())
    present = [bench.scene.value(name, model) for name in plan.box.names]
    print_optimum(found, present, parts_of_stress(found, bench))
    print_budgets([of_record(record) for record in budgets.values()])
    written = write_optimum(found, folder / "optimize.json", bench.basis(), budgets)
    print_paths(("results", written), ("picture", write_picture(found, folder / "optimize.png")))


def best_budgets(found, bench, model):
    """Records of the recommended point's error budgets by figure; none without such a point or without statistics."""
    from ..running.budget import known_result

    if found.best is None or bench.scene.parameters["scene.statistics"] == "off":
        return {}
    screen(model)
    scene = bench.scene_at(found.study.box.names, found.points[found.candidates[found.best]])
    return known_result(model, scene, True).about["budget"]


def parts_of_stress(found, bench):
    """Static stress and swing of candidates and present design [n, 2] [Pa]; None without statistics."""
    import numpy as np

    from ..design.optimize import fresh_seeds
    from ..running.responses import PARTS

    if bench.scene.parameters["scene.statistics"] == "off":
        return None
    points, seeds = found.points[found.candidates], fresh_seeds(found.study)
    again = bench(found.study.box.names, points, PARTS, seeds), bench([], np.zeros((1, 0)), PARTS, seeds)
    return np.concatenate([values.mean(axis=1) for values in again])


def print_optimum(found, present, parts=None):
    """Candidates, the recommended one marked, the present design, and the criterion; parts: of parts_of_stress."""
    from ..design.optimize import criterion
    from ..running.responses import PARTS, shown, titled

    study = found.study
    missing = [] if parts is None else [name for name in PARTS if name not in study.responses]
    shown_points = table(["", *map(titled, (*study.box.names, *study.responses, *missing))])
    rows = [("", found.points[i], *of) for i, *of in zip(found.candidates, found.means, found.errors, strict=True)]
    for place, row in enumerate([*rows, ("present design", present, *found.present)]):
        best = place == found.best
        title, *rest = row
        stress = [f"{1e-6 * parts[place][PARTS.index(name)]:.3g}" for name in missing]
        texts = "recommended" if best else title, *cells(study, *rest), *stress
        shown_points.add_row(*texts, style="bold" if best else None)
    console.print(shown_points)
    text = f"{len(found.points)} points searched; means ± standard error over {study.file.check_seeds} seeds that the search has not seen"
    console.print(f"[dim]{text}{'' if found.best is not None else '; none of them keeps the limits'}[/]")
    if found.best is not None:
        console.print(f"recommended: {escape(criterion(study))}")
    if found.best is not None and parts is not None and go_apart(parts[-1], parts[found.best]):
        was, now = ([shown(name, value) for name, value in zip(PARTS, row)] for row in (parts[-1], parts[found.best]))
        changes = ", ".join(f"{name} {a} to {b}" for name, a, b in zip(PARTS, was, now))
        note(f"static stress and swing go apart ({changes}): damage follows the swing")


def go_apart(was, now):
    """Whether static stress and swing (arrays) change in opposite directions, the first one by more than APART."""
    import numpy as np

    from ..duty.designs import APART

    static, swing = np.log(now / was)
    return static * swing < 0.0 and abs(static) > np.log(APART)


def cells(study, point, mean, error):
    """Values of a point and its responses as text."""
    from ..base.units import with_error
    from ..running.responses import display_of, displayed

    values = [f"{displayed(name, value):.4g}" for name, value in zip(study.box.names, point, strict=True)]
    return values + [
        with_error(float(displayed(name, m)), float(display_of(name)[1] * e))
        for name, m, e in zip(study.responses, mean, error, strict=True)
    ]
