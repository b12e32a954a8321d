"""riveted-bearing sensitivity: which parameters decide."""

from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape

from ..base.errors import UserError
from ..base.files import make_folder
from ..base.toml_files import read_toml
from .options import FMU, OUT, SCHEDULER, WORKERS, file_argument
from .printing import print_basis, print_paths, table
from .terminal import command, console, design_runs, screen


@command
def sensitivity(
    study: Annotated[
        Path | None,
        file_argument(
            "STUDY.toml",
            "study file (TOML): factors with ranges, responses; see docs/life.md; with --quick only its [between]",
        ),
    ] = None,
    fmu: FMU = None,
    quick: Annotated[
        bool,
        typer.Option(
            "--quick",
            help="only the FMU's screening: each assumed value at both ends of its range, kept beside the FMU",
        ),
    ] = False,
    out: OUT = None,
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

    model = Model(fmu)
    if quick:
        print_screening(model, screen(model, own_ranges(study, model)))
        return
    if study is None:
        raise UserError("sensitivity: a study file is needed, or --quick for the screening of what is assumed")
    document = read_toml(study, "study file")
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


def own_ranges(study, model):
    """Ranges of a study's [between] by name, such as the tolerances of a drawing; none without a study."""
    from ..base.schema import checked
    from ..bearing.oil import ALL_TEMPERATURES
    from ..design.bench import Box
    from ..design.sensitivity import SensitivityFile

    if study is None:
        return {}
    between = checked(SensitivityFile, read_toml(study, "study file"), study).between
    box = Box(study, between, model)
    allowed = {*model.parameters, *ALL_TEMPERATURES}
    if others := [name for name in box.names if name not in allowed]:
        raise UserError(f"{study}: between: {', '.join(others)}: not screened; parameters and temperatures are allowed")
    return {name: (float(low), float(high)) for name, low, high in zip(box.names, box.low, box.high, strict=True)}


def print_screening(model, record):
    """The screening of an FMU, what moves the damage most first."""
    from ..bearing.assumed import all_assumed
    from ..running.runner import origin_of
    from ..running.scene import load_scene
    from ..running.screening import paths

    scene = load_scene(None, model)
    values = {name: model.default(variable) for name, variable in model.parameters.items()} | scene.parameters
    rows = list(all_assumed(origin_of(model, scene), values))
    rows.sort(key=lambda row: (-row.size("damage"), -row.size("stress")))
    console.print(f"[bold]{escape(model.bearing)}[/]")
    heads = "assumed", "value", "range", "stress", "damage per hour", "source of the range"
    known = [row for row in rows if row.effect]
    cells = ((row.name, *row.words, row.change("stress"), row.change("damage"), row.source) for row in known)
    console.print(table(heads, cells, left=6))
    for line in {row.unknown: None for row in rows if not row.effect}:
        names = ", ".join(row.name for row in rows if row.unknown == line and not row.effect)
        console.print(f"[dim]not covered: {names}: {escape(line)}[/]")
    console.print(
        f"[dim]99.9 % quantile of the worst head, damage of the worst place; one at a time, {record['seeds']} common seeds of "
        f"{record['t_end']:.3g} s; in {record['seconds']:.0f} s[/]"
    )
    print_paths(("results", next(path for path in paths(model) if path.is_file())))


def print_indices(found, box):
    """One table for each response; box: of the factors' ranges."""
    from ..design.sensitivity import order
    from ..running.responses import display_of, displayed, titled

    pairs = zip(box.names, box.low, box.high, strict=True)
    ends = [f"{displayed(name, low):.4g} ... {displayed(name, high):.4g}" for name, low, high in pairs]
    for name in found.responses:
        morris, sobol = found.morris[name], found.sobol.get(name)
        factor = display_of(name)[1]
        noise = "" if morris["noise"] is None else f", seeds alone {factor * morris['noise']:.3g}"
        known = sobol is not None and sobol["noise"] is not None
        share = f", seeds have {100 * sobol['noise']:.2g} % of the variance" if known else ""
        console.print(f"\n[bold]{escape(titled(name))}[/]  [dim]mu* of Morris{noise}{share}[/]")
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
        "their own (riveted-bearing build); compare-designs sets such FMUs side by side.[/]"
    )
