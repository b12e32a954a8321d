"""riveted-bearing sensitivity: which parameters decide."""

from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape

from ..base.files import make_folder
from .printing import document_of, print_paths, table
from .terminal import FMU, SCHEDULER, WORKERS, command, console, design_runs, print_basis


@command
def sensitivity(
    study: Annotated[
        Path,
        typer.Argument(
            help="study file (TOML): factors with ranges, responses; see docs/life.md", metavar="STUDY.toml"
        ),
    ],
    fmu: FMU = None,
    out: Annotated[
        Path | None, typer.Option(help="folder of runs, sensitivity.json and picture; default: results/STUDY")
    ] = None,
    scheduler: SCHEDULER = None,
    workers: WORKERS = None,
):
    """What decides life and stress: screening of all factors (Morris), then shares of the variance (Sobol); a second
    call does only missing runs.
    """
    from ..bearing.assumed import assumed_ranges
    from ..design.bench import Bench
    from ..design.sensitivity import analyse, plan_sensitivity, salib, write_indices, write_picture
    from ..running.fmu import Model

    document, model = document_of(study, "study"), Model(fmu)
    folder = out or Path("results") / study.stem
    salib()  # before there is a folder
    with design_runs(study.stem, folder, scheduler, workers) as (client, progress):
        bench = Bench(study, document, model, folder, client, progress)
        plan = plan_sensitivity(study, document, model, assumed_ranges(model, bench.scene))
        bench.check(plan.responses)
        make_folder(folder)
        found = replace(analyse(plan, bench), basis=dict(bench.basis()))
    print_basis(found.basis.items())
    print_indices(found, plan.box)
    print_paths(
        ("results", write_indices(found, folder / "sensitivity.json")),
        ("picture", write_picture(found, folder / "sensitivity.png")),
    )


def print_indices(found, box):
    """One table for each response; box: of the factors' ranges."""
    from ..design.sensitivity import order
    from ..running.responses import display_of, displayed, titled

    ends = [
        f"{displayed(name, low):.4g} ... {displayed(name, high):.4g}"
        for name, low, high in zip(box.names, box.low, box.high, strict=True)
    ]
    for name in found.responses:
        morris, sobol = found.morris[name], found.sobol.get(name)
        factor = display_of(name)[1]
        noise = "" if morris["noise"] is None else f", seeds alone {factor * morris['noise']:.3g}"
        share = (
            ""
            if sobol is None or sobol["noise"] is None
            else f", seeds have {100 * sobol['noise']:.2g} % of the variance"
        )
        console.print(f"\n[bold]{escape(titled(name))}[/]  [dim]mu* of Morris{noise}{share}[/]", soft_wrap=True)
        rows = []
        for k in order(found, name):
            cells = [ends[k], *(f"{factor * morris[key][k]:.3g}" for key in ("mu_star", "mu_star_conf", "sigma"))]
            if found.factors[k] in found.chosen and sobol:
                place = found.chosen.index(found.factors[k])
                cells += [f"{sobol[key][place]:.2f}" for key in ("S1", "S1_conf", "ST", "ST_conf")]
            rows.append((titled(found.factors[k]), *cells))
        heads = ("factor", "range", "mu*", "±", "sigma", *(("S1", "±", "ST", "±") if sobol else ()))
        console.print(table(heads, rows))
    console.print(
        "[dim]Not among the factors: shapes of which the FMU is built (stress table, cage half, rivet). They need an FMU of "
        "their own (riveted-bearing build); compare-designs sets such FMUs side by side.[/]",
        soft_wrap=True,
    )
