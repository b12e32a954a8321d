"""riveted-bearing matrices: stiffness and damping over speed and load."""

from pathlib import Path
from typing import Annotated

import typer

from ..base.files import make_folder
from .options import FMU
from .printing import note, print_basis, print_paths, table
from .terminal import command, console, option_value, progress_bar

SPEEDS = 6  # up to that of the scene, if none is given


@command
def matrices(
    scene: Annotated[
        str | None,
        typer.Argument(help="scene file (TOML) or one of the shipped scenes; default: the FMU's own loads and speed"),
    ] = None,
    fmu: FMU = None,
    out: Annotated[Path, typer.Option(help="folder for the files")] = Path("results"),
    speeds: Annotated[
        list[str] | None,
        typer.Option("--speed", help='speed, e.g. --speed "6000 rev/min"; repeatable; default: six up to the scene\'s'),
    ] = None,
    loads: Annotated[
        list[float] | None, typer.Option("--load", help="factor of the scene's loads; repeatable; default: 1")
    ] = None,
    frequencies: Annotated[
        list[float] | None,
        typer.Option(
            "--frequency", min=1.0, help="frequency of the shakes (whirl) in Hz; repeatable; default: the speed's own"
        ),
    ] = None,
    static: Annotated[
        bool, typer.Option("--static", help="the quasi-static stiffness alone, without the FMU's response")
    ] = False,
):
    """Stiffness and damping (5 x 5, shaft against housing) over speed and load, as CSV, as a ROSS bearing and as a
    picture.
    """
    import math

    from ..base.units import to_si
    from ..running.basis import basis, fast_speeds
    from ..running.effects import in_words
    from ..running.fmu import Model
    from ..running.scene import load_scene
    from ..running.scene_case import scene_case
    from ..studies.matrices import (
        dynamic_matrices,
        idle_settings,
        plot_matrices,
        quasi_static_matrices,
        scene_at,
        write_ross,
        write_table,
    )

    model = Model(fmu)
    plan = load_scene(scene, model)
    case = scene_case(scene, model)
    variable = model.inputs["shaft.omega"]

    def speed_of(value):
        number = to_si(value, model.units[variable.unit])
        model.check_range(number, variable)
        return number

    omegas = [option_value("--speed", text, speed_of) for text in speeds or ()]
    omegas = omegas or [case.load.omega * (i + 1) / SPEEDS for i in range(SPEEDS)]
    loads = list(dict.fromkeys(loads or [1.0]))
    balanced = quasi_static_matrices(case, sorted(set(omegas)), loads)  # refuses before anything is written
    make_folder(out)
    with progress_bar() as bar:
        task, found = bar.add_task("matrices", total=1.0), balanced if static else []
        whirls: list[float | None]
        whirls = [] if static else [2.0 * math.pi * f for f in sorted(set(frequencies or ()))] or [None]
        for i, w in enumerate(whirls):

            def progress(share, done=i):
                bar.update(task, completed=(done + share) / len(whirls))

            found = found + dynamic_matrices(model, case, plan, balanced, w, progress=progress)
    if static and frequencies:
        console.print("without effect here: --frequency, the quasi-static stiffness has none")
    if idle := idle_settings(model, plan, balanced[-1], bool(speeds), static):
        console.print(f"{in_words(idle)}: the shake moves the inner ring, without stress")
    rows, stem = basis(model, [scene_at(model, plan, point) for point in found]), plan.name
    print_basis(rows)
    for text in fast_speeds(model, [scene_at(model, plan, point) for point in found]):
        note(text)
    console.print(diagonals(found))
    paths = [write_table(found, out / f"{stem}_matrices.csv", rows), plot_matrices(found, out / f"{stem}_matrices.png")]
    for load in dict.fromkeys(point.load for point in found):
        name = f"{stem}_ross.toml" if len(loads) == 1 else f"{stem}_ross_{load:g}.toml"
        of_load = [point for point in found if point.load == load]
        paths.append(write_ross(of_load, out / name, tag=stem, basis=rows))
        if len(whirls) < 2:
            paths.append(write_ross(of_load, out / name.replace("_ross", "_ross2"), tag=stem, basis=rows, version=2))
    print_paths(*(("written", path) for path in paths))


def diagonals(found):
    """Diagonals of stiffness and damping for the terminal."""
    from ..base.units import RPM

    heads = (
        "speed rev/min",
        "load",
        *(f"K {i}{i} N/um" for i in "xyz"),
        *(f"K FMU {i}{i}" for i in "xyz"),
        *(f"C {i}{i} N s/m" for i in "xyz"),
    )
    shown = heads if found[0].K is not None else heads[:5]
    rows = []
    for p in found:
        rows.append([f"{RPM * p.omega:,.0f}", f"{p.load:g}", *(f"{1e-6 * p.K_static[i, i]:.1f}" for i in range(3))])
        if p.K is not None:
            rows[-1] += [f"{1e-6 * p.K[i, i]:.1f}" for i in range(3)] + [f"{p.C[i, i]:.0f}" for i in range(3)]
    return table(shown, rows, left=0)
