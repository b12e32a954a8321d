"""riveted-bearing run: one scene through the FMU."""

import re
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape

from ..base.errors import UserError, extra, unknown
from ..base.files import FORMATS, make_folder
from ..base.interrupts import held_interrupts
from ..base.shipped import find_scene, shipped_scenes
from .options import FMU, SETTINGS
from .printing import note, print_basis, print_budgets, print_paths, table
from .terminal import STOPPED, changes, command, console, messages, option_value, screen, simulation_progress

ROUNDING = 1e-9  # in the units shown: what is smaller stands as 0


@command
def run(
    scene: Annotated[
        str | None,
        typer.Argument(
            help=f"scene file (TOML) or one of the shipped scenes: {', '.join(shipped_scenes())}; default: the FMU's own working point"
        ),
    ] = None,
    fmu: FMU = None,
    out: Annotated[Path, typer.Option(help="folder, or file whose suffix is the format")] = Path("results"),
    format: Annotated[
        str | None, typer.Option(help=f"{', '.join(FORMATS)} (default: the suffix of --out, else {FORMATS[0]})")
    ] = None,
    settings: SETTINGS = None,
    seed: Annotated[int | None, typer.Option(help="start.seed: initial spacing of the balls")] = None,
    t_end: Annotated[str | None, typer.Option(help='simulated time, e.g. 0.4 or "400 ms"')] = None,
    step: Annotated[str | None, typer.Option(help='communication step, e.g. 1e-4 or "0.1 ms"')] = None,
    accuracy: Annotated[
        str | None,
        typer.Option(help='"2 %" of stress and pocket force: steps and seeds are chosen, in several runs'),
    ] = None,
    within: Annotated[str, typer.Option(help='processor time that an accuracy may take, e.g. "1 h"')] = "10 min",
    check: Annotated[
        bool,
        typer.Option(
            help="how wrong stress and damage are: further seeds, finer runs, and once a screening of this FMU"
        ),
    ] = False,
    plot: Annotated[bool, typer.Option(help="write a picture beside the results")] = True,
):
    """Simulate a scene: progress, a summary, results with all parameters inside, and a picture."""
    if scene is not None:
        find_scene(scene)  # a wrong name is told before slow imports
    from ..bearing.plausible import odd_materials
    from ..running.fmu import Model
    from ..running.results import write_result
    from ..running.runner import simulate
    from ..running.scene import load_scene

    model = Model(fmu)
    target = result_path(scene or model.path, out, format or lean_format(out))
    plan = load_scene(scene, model, ("the command line", changes(model, settings or [], seed, t_end, step, accuracy)))
    for text in odd_materials(plan.parameters):
        note(text)
    make_folder(target.parent)
    if check:
        screen(model)
    if plan.accuracy is not None or check:
        result = known_run(model, plan, check, within)
    with held_interrupts():  # from the first step until its results are written
        if plan.accuracy is None and not check:
            with simulation_progress(plan) as progress:
                result = simulate(model, plan, progress)
        print_summary(result)
        print_without_effect(model, plan, result)
        paths = [write_result(result, target)]
        if plot and is_there("matplotlib", "the picture"):
            from ..show.plot import plot_result

            paths.append(plot_result(result, target.with_suffix(".png")))
    print_paths(*zip(("results", "picture"), paths, strict=False))
    console.print(
        f"[dim]riveted-bearing report {escape(str(paths[0]))}[/]  a page with charts, life and the motion to play"
    )
    from ..running.in_run import break_lines
    from ..running.summary import accelerated

    for line in break_lines(result):
        console.print(line)
    if words := accelerated(result):
        console.print(f"[yellow]{words}[/]")
    if result.stopped:
        note(result.stopped, "[bold red]stopped:[/]")
        raise typer.Exit(STOPPED)


def known_run(model, plan, check, within):
    """The Result of a scene with how far its figures are known, by several runs of at most `within`, a text."""
    from ..base.units import SECONDS, to_si
    from ..running.budget import known_result

    def say(runs):
        if messages.is_terminal:
            messages.print(f"[dim]run {runs} done[/]")

    seconds = option_value("--within", within, lambda value: to_si(value, SECONDS))
    return known_result(model, plan, check, seconds, say)


def print_known(result):
    """What an accuracy took and what the plain run would have said; the error budgets, the largest part first."""
    from ..base.units import with_error
    from ..running.accuracy import FIGURES
    from ..running.budget import of_record

    if found := result.about.get("accuracy"):
        rows = []
        for name, each in found["figures"].items():
            words, unit, factor = FIGURES[name]
            value, half = factor * each["value"], factor * each["half_width"]
            plain = with_error(factor * each["plain_run"], half).partition(" ")[0]
            rows.append((words, unit, with_error(value, half), plain, found["missed"].get(name, "reached")))
        heads = f"to {100 * found['target']:g} %", "unit", f"{100 * found['confidence']:g} % interval", "plain run", ""
        console.print(table(heads, rows, left=2))
        n, m = next(iter(found["figures"].values()))["runs"]
        console.print(
            f"{n} seeds with steps of {1e6 * found['step']:.2g} us on average, {m} of them with finer ones too: {found['cost']:.2g} times the "
            "processor time of a plain run"
        )
    print_budgets([of_record(record) for record in result.about.get("budget", {}).values()])


def print_without_effect(model, scene, result):
    """What the scene sets without effect; of a run that was interrupted nothing."""
    from ..running.effects import all_figures, in_words, without_effect

    if result.stopped and result.stopped.startswith("interrupted"):
        return
    cost, scene = result.summary["wall_time"], replace(scene, accuracy=None)
    idle, until = without_effect(model, scene, result.about["set"], whole=all_figures(result), cost=cost)
    if idle:
        console.print(escape(in_words(idle, until)))


def is_there(library, what):
    """Whether a library of the extra "full" is installed; a note tells what is left out without it."""
    if find_spec(library):
        return True
    note(f"without {library} {what} is left out: {extra('full')}")
    return False


def lean_format(out):
    """CSV where Parquet would be written but its library is missing; None otherwise."""
    if out.suffix.removeprefix(".") in FORMATS or is_there("pyarrow", "Parquet"):
        return None
    return "csv"


def result_path(scene, out, kind):
    """File of the results: --out itself if its suffix is a format, else named after the scene in --out."""
    suffix = out.suffix.removeprefix(".")
    if kind is not None and kind not in FORMATS:
        raise unknown("--format", "format", kind, FORMATS)
    if suffix not in FORMATS and re.fullmatch(r"\.[A-Za-z]\w{1,5}", out.suffix) and not out.is_dir():  # xlsx, json
        raise UserError(f'--out {out}: unknown format "{suffix}"; allowed: {", ".join(FORMATS)}, or a folder')
    if suffix not in FORMATS:
        return out / f"{Path(scene).stem}.{kind or FORMATS[0]}"
    if kind not in (None, suffix):
        raise UserError(f"--out {out}: does not go with --format {kind}")
    return out


def statistics_table(result):
    """Mean, RMS, 99.9 % quantile and largest value after settling."""
    from ..running.budget import computed_share, shown
    from ..running.summary import summary_rows

    share = computed_share(result)
    rows = []
    for row in summary_rows(result):
        figures = (shown(row, value, share) for value in (row.mean, row.rms, row.p999, row.largest))
        rows.append((row.channel + ("" if row.every_step else " *"), row.unit, *figures))
    return table(("", "unit", "mean", "RMS", "p99.9", "max"), rows, left=2)


def early_table(result):
    """What there is without statistics."""
    from ..running.summary import early_rows

    rows = (
        (channel, unit, *(f"{value if abs(value) > ROUNDING else 0.0:.3g}" for value in values))
        for channel, unit, *values in early_rows(result)
    )
    return table(("", "unit", "at the end", "largest since the start"), rows, left=2)


def print_summary(result):
    """The figures of a run on the terminal."""
    from ..bearing.assumed import assumed_as_bronze, assumed_rows, measured_in
    from ..running.budget import computed_share, shown
    from ..running.in_run import change_lines, notes
    from ..running.summary import flag_note, has_statistics, no_statistics, rivet_rows, table_note

    about, summary = result.about, result.summary
    console.print(f"[bold]{escape(about['scene'])}[/]  {escape(about['description'])}")
    print_basis(about["basis"].items())
    for line in change_lines(result):
        console.print(f"changes {escape(line)}")
    console.print(statistics_table(result) if has_statistics(result) else early_table(result))
    rivets = rivet_rows(result)
    if rivets:
        worst, share = max(rivets, key=lambda row: row[1].p999), computed_share(result)
        console.print(
            f"of the single rivets, rivet {worst[0]} has the largest p99.9 in its head: "
            f"{shown(worst[1], worst[1].p999, share)} MPa, in its middle {shown(worst[2], worst[2].p999, share)} MPa"
        )
    if missing := no_statistics(result):
        note(missing)
    else:
        console.print(
            f"[dim]after the first {result.parameters['start.settle']:g} s; every internal step, * at communication points only[/]"
        )
    names = [f"solver.{name}" for name in ("steps", "rhs_evals", "error_tests_failed")]
    if names[0] in summary:
        steps, evaluations, rejected = (f"{summary[name]:,.0f}" for name in names)
        console.print(f"{steps} steps, {evaluations} evaluations of the equations, {rejected} steps rejected")
    console.print(
        f"simulated {summary['simulated_time']:g} s in {summary['wall_time']:.2f} s, CPU time {summary['cpu_time']:.2f} s, "
        f"[bold]real-time factor {summary['real_time_factor']:.2f}[/] (CPU time / simulated time)"
    )
    print_known(result)
    if rows := assumed_rows(result):
        moving = [row for row in rows if row.size("stress")] or rows
        meant = f"usual range: change of the worst head's stress over it, {measured_in(rows)}"
        said = ((row.name, row.words[0], filter(None, (row.words[1], row.change("stress")))) for row in moving)
        texts = (f"{name} {value} ({': '.join(span)})" for name, value, span in said)
        console.print(
            f"[dim]assumed values that the stress moves with ({escape(meant)}): {escape(', '.join(texts))}[/]"
        )
        if rest := [row for row in rows if row not in moving]:
            console.print(f"[dim]assumed too: {escape(', '.join(row.name for row in rest))}[/]")
    for source, names in about.get("not_given", {}).items():
        console.print(f"[dim]not given, {escape(source)}: {escape(names)}[/]")
    if names := assumed_as_bronze(result):
        console.print(f"[dim]assumed, as of a cage of bronze: {escape(names)}[/]")
    for text in filter(None, [*notes(result), flag_note(result), table_note(result)]):
        note(text)
    for text in dict.fromkeys(about.get("messages", [])):
        if not result.stopped or text not in result.stopped:
            note(text)
