"""riveted-bearing info: a bearing without a simulation."""

from dataclasses import replace
from typing import Annotated

import typer
from rich.markup import escape

from .options import CAGE, CLEANLINESS, FMU
from .printing import note, print_basis
from .terminal import chosen_cleanliness, command, console

OF_BEARING = (
    "With a line `Z = ...` or `designation = ...` the file is a bearing's: cage, rivets and masses follow by rule"
)


@command
def info(
    target: Annotated[
        str | None,
        typer.Argument(
            metavar="[BEARING|SCENE]",
            help="bearing file or designation, or scene file or name; default: the bearing of --fmu, else the 6207",
        ),
    ] = None,
    fmu: FMU = None,
    cage: CAGE = None,
    cleanliness: CLEANLINESS = None,
):
    """Geometry, masses, kinematic and fault frequencies, quasi-static loads and life."""
    from ..bearing.bearing_file import CAGE_MEANT
    from ..bearing.origin import EXAMPLE
    from ..bearing.plausible import doubts
    from ..duty.raceways import too_little_load
    from ..running.basis import basis
    from ..running.fmu import Model
    from ..running.scene import load_scene
    from ..running.scene_case import case_of, is_bearing
    from .info_tables import given_values, info_tables, without_effect

    case, scene, model = case_of(target, fmu, cage), None, None
    case = replace(case, cleanliness=chosen_cleanliness(cleanliness))
    console.print(f"[bold]{escape(case.designation)}[/]  {escape(case.description)}")
    if target is None and fmu is None:
        text = f"no bearing is named: this is the {EXAMPLE}, as an example; name a bearing or a scene, or an FMU with --fmu"
        note(text, to=console)
    elif target is None or not is_bearing(target):
        model = Model(fmu)
        scene = load_scene(target, model)
        print_basis(basis(model, [scene]))
    if case.bare:
        console.print(escape(CAGE_MEANT))
    for text in doubts(case):
        note(text, to=console)
    if case.alone:
        words = f"read as a scene, which sets {', '.join(case.alone)}; all else is the FMU's. {OF_BEARING}"
        note(words, to=console)
    for text in too_little_load(case):
        note(text, to=console)
    for title, table in info_tables(case):
        console.print(f"\n[bold]{title}[/]")
        console.print(table)
    if idle := without_effect(case, given_values(case, scene, model)):
        console.print(f"\nwithout effect here: {escape(', '.join(idle))}")
