"""riveted-bearing causes: from broken rivets to ranked causes."""

from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape

from ..base.errors import UserError
from ..base.files import make_folder
from ..base.toml_files import read_toml
from .options import FMU, OUT, SCHEDULER, WORKERS, file_argument
from .printing import print_basis, print_paths, table
from .terminal import command, console, design_runs


@command
def causes(
    findings: Annotated[
        Path, file_argument("FINDINGS.toml", "findings (TOML): broken rivets, hours, marks; see docs/failure.md")
    ],
    order: Annotated[
        bool, typer.Option("--order", help="what breaks next, from the broken rivets on, and no causes")
    ] = False,
    fmu: FMU = None,
    out: OUT = None,
    scheduler: SCHEDULER = None,
    workers: WORKERS = None,
):
    """Why did it break? Causes ranked by broken rivets, marks, hours and measurements, and what to inspect next; a second
    call does only missing runs.
    """
    from ..identify.causes_page import ORDER, RANKED, order_rows, ranked_rows, verdict, write_answer, write_page
    from ..identify.findings import plan_causes
    from ..identify.order import bench_of, run_order
    from ..identify.pool import mission_scene, run_pool
    from ..identify.posterior import answer, predictions
    from ..running.fmu import Model

    document, model = read_toml(findings, "file of findings"), Model(fmu)
    scene = mission_scene(findings, document, model)
    study = plan_causes(findings, document, model, scene)
    folder = out or Path("results") / findings.stem
    said, pool, states = None, [], None
    if order and study.findings.gone is None:
        raise UserError(f"{findings}: broken: --order needs the numbers of the broken rivets")
    if not order and not study.findings.broken:
        raise UserError(f"{findings}: broken: no rivet is broken; --order tells which one breaks first")
    with design_runs(findings.stem, folder, scheduler, workers) as (client, progress):
        make_folder(folder)
        bench = bench_of(findings, document, model, folder / "order", client, progress)
        if order:
            within = study.file.within if "within" in document else float("inf")
            states = run_order(bench, study.Z, study.file.breaks, study.findings.gone, within)
        else:
            samples = run_pool(study, model, document, folder, client, progress)
            pool = predictions(samples, study, model, scene)
            said = answer(study, pool, study.file.seed)
    basis = list(bench.basis())
    print_basis(basis)
    if said is not None:
        console.print(table(RANKED, ranked_rows(said)[:10], left=len(RANKED)))
        console.print(escape(verdict(said)))
        best = [f"{name} ({bits:.2f} bits)" for name, _, bits in said.inspections[:3]]
        console.print(f"inspect next: {escape(', '.join(best))}")
    if states:
        console.print(table(ORDER, order_rows(states), left=len(ORDER)))
        console.print(f"end: {states[-1].end}")
    print_paths(
        ("results", write_answer(study, said, pool, states, basis, folder / "causes.json")),
        ("page", write_page(study, said, pool, states, basis, folder / "causes.html")),
    )
