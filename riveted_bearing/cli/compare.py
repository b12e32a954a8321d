"""riveted-bearing compare: the FMU against the Python reference."""

from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape

from ..base.files import make_folder
from .options import FMU, SETTINGS
from .printing import print_basis, print_paths, table
from .terminal import changes, command, console, number_or_text, progress_bar


@command
def compare(
    scene: Annotated[
        str | None,
        typer.Argument(help="scene file (TOML) or one of the shipped scenes; default: the FMU's own working point"),
    ] = None,
    fmu: FMU = None,
    out: Annotated[Path, typer.Option(help="folder for the picture")] = Path("results"),
    settings: SETTINGS = None,
    short: Annotated[str, typer.Option(help="horizon of the comparison point by point")] = "1 ms",
    long: Annotated[
        str, typer.Option(help="horizon of the statistics, 0 for none; 0.1 s take the reference some minutes")
    ] = "0.1 s",
    seeds: Annotated[int, typer.Option(help="runs of the FMU over the long horizon")] = 8,
    method: Annotated[
        str,
        typer.Option(
            help="the reference's method over the short horizon: DOP853, Radau where films or joints are stiff"
        ),
    ] = "DOP853",
):
    """Run a scene through the FMU and through the Python reference: differences in tables and a picture."""
    from ..base.toml_files import seconds
    from ..building.compare import compare as compare_scene
    from ..building.compare import ledger_table, long_table, short_table
    from ..building.reference import folder_of, is_installed, run_again
    from ..running.basis import basis
    from ..running.fmu import Model
    from ..running.scene import load_scene
    from ..show.plot import plot_comparison

    model = Model(fmu)
    if not is_installed(model):
        options = ["--fmu", model.path, "--out", out, "--short", short, "--long", long, "--seeds", seeds]
        options += ["--method", method, *(text for setting in settings or () for text in ("--set", setting))]
        arguments = ["compare", *([scene] if scene else []), *options]
        raise typer.Exit(run_again(folder_of(model), map(str, arguments)))
    plan = load_scene(scene, model, ("the command line", changes(model, settings or [], None, None, None)))
    horizons = {name: seconds(f"--{name}", number_or_text(text)) for name, text in (("short", short), ("long", long))}
    make_folder(out)
    with progress_bar() as bar:
        task = bar.add_task("FMU, short horizon", total=1.0)
        found = compare_scene(
            model,
            plan,
            **horizons,
            seeds=seeds,
            method=method,
            progress=lambda what, share: bar.update(task, description=what, completed=share),
        )
    console.print(
        f"[bold]{escape(plan.name)}[/]: FMU against reference over {1e3 * found.t[-1]:g} ms, at tolerances of the FMU"
    )
    print_basis(basis(model, [plan]))
    console.print(table(*short_table(found)))
    if found.statistics:
        console.print(
            f"\n[bold]Statistics[/] from {found.settle:g} to {found.long:g} s, {found.seeds} seeds of the FMU, one of the reference"
        )
        heads, rows = long_table(found)
        console.print(table(heads, rows, left=2))
        console.print("\n[bold]Energy in the reference[/]")
        console.print(table(*ledger_table(found.ledger)))
    print_paths(("picture", plot_comparison(found, out / f"{plan.name}_compare.png")))
