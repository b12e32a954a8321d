"""riveted-bearing: build the FMU, run scenes through it, look at bearings."""

import functools
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, MofNCompleteColumn, Progress, ProgressColumn, SpinnerColumn, TextColumn, TimeElapsedColumn, TimeRemainingColumn
from rich.table import Column, Table
from rich.text import Text

from .errors import UserError, unknown
from .results import FORMATS, make_folder, write_result
from .scene import load_scene, shipped_scenes

BAD_INPUT, STOPPED = 2, 3  # exit codes
DEFAULT_BEARING = "6207"
app = typer.Typer(no_args_is_help=True, add_completion=False, pretty_exceptions_enable=False, help=__doc__)
console = Console(highlight=False)
messages = Console(stderr=True, highlight=False)


@app.callback()
def main():
    """riveted-bearing: dynamics of a ball bearing with a two-piece riveted cage, as an FMU."""


def command(function):
    """A command of the program: what the user can put right is one line on stderr and exit code 2."""

    @functools.wraps(function)
    def guarded(*arguments, **options):
        try:
            return function(*arguments, **options)
        except UserError as problem:
            messages.print(f"[bold red]error:[/] {escape(str(problem))}", soft_wrap=True)
            raise typer.Exit(BAD_INPUT) from None

    return app.command()(guarded)


@command
def build(
    bearing: Annotated[str | None, typer.Option(help="bearing file (TOML) or designation; default: the 6207")] = None,
    rivet: Annotated[
        Path | None,
        typer.Option(
            help="rivet table (JSON), or geometry (TOML) to make one by finite elements; default: the one shipped if it fits the bearing, else closed forms"
        ),
    ] = None,
    coarse: Annotated[bool, typer.Option("--coarse", help="with a geometry: a rough table in seconds instead of some half an hour")] = False,
    out: Annotated[
        Path | None,
        typer.Option(help="the FMU to write; default: my.fmu here for the bearing or rivet my.toml, else RivetedBearing.fmu, in a checkout in fmus/"),
    ] = None,
    platforms: Annotated[str | None, typer.Option(help="all, or names such as linux64,win64: cross-compiled; default: this machine's compiler")] = None,
):
    """Make an FMU for a bearing: needs a C compiler, takes about half a minute; with a rivet's geometry also half an hour for its table."""
    from .build import build as build_fmu
    from .build import platform_names

    columns = SpinnerColumn(), TextColumn("{task.description}"), BarColumn(bar_width=30), TimeElapsedColumn()
    with Progress(*columns, console=messages, disable=not messages.is_terminal) as bar:
        task = bar.add_task("starting", total=None)

        def say(text, share=None):
            bar.update(task, description=text, total=1.0 if share else None, completed=share or 0.0)

        path = build_fmu(bearing, rivet, out, say, platform_names(platforms), coarse)
    console.print(str(path), style="cyan", soft_wrap=True)


@command
def run(
    scene: Annotated[str, typer.Argument(help=f"scene file (TOML) or one of the shipped scenes: {', '.join(shipped_scenes())}")],
    fmu: Annotated[Path | None, typer.Option(help="the FMU; default: RivetedBearing.fmu here, in the checkout or as installed")] = None,
    out: Annotated[Path, typer.Option(help="folder, or file whose suffix is the format")] = Path("results"),
    format: Annotated[str | None, typer.Option(help=f"{', '.join(FORMATS)} (default: the suffix of --out, else {FORMATS[0]})")] = None,
    set: Annotated[
        list[str] | None, typer.Option(help='parameter or constant input, e.g. --set joint.preload="30 N"; repeatable', metavar="NAME=VALUE")
    ] = None,
    seed: Annotated[int | None, typer.Option(help="start.seed: initial spacing of the balls")] = None,
    t_end: Annotated[str | None, typer.Option(help='simulated time, e.g. 0.4 or "400 ms"')] = None,
    step: Annotated[str | None, typer.Option(help='communication step, e.g. 1e-4 or "0.1 ms"')] = None,
    plot: Annotated[bool, typer.Option(help="write a picture beside the results")] = True,
):
    """Simulate a scene: progress, a summary, results with all parameters inside, and a picture."""
    from .fmu import Model
    from .runner import simulate

    target = result_path(scene, out, format)
    model = Model(fmu)
    plan = load_scene(scene, model, ("the command line", changes(model, set or [], seed, t_end, step)))
    make_folder(target.parent)
    with simulation_progress(plan) as progress:
        result = simulate(model, plan, progress)
    print_summary(result)
    paths = [write_result(result, target)]
    if plot:
        from .plot import plot_result

        paths.append(plot_result(result, target.with_suffix(".png")))
    for label, path in zip(("results", "picture"), paths, strict=False):
        console.print(f"{label}  [cyan]{escape(str(path))}[/]", soft_wrap=True)
    console.print(f"FMU      [cyan]{escape(str(model.path))}[/]", soft_wrap=True)
    console.print(f"[dim]riveted-bearing report {escape(str(paths[0]))}[/]  a page with charts, life and the motion to play", soft_wrap=True)
    if result.stopped:
        messages.print(f"[bold red]stopped:[/] {escape(result.stopped)}", soft_wrap=True)
        raise typer.Exit(STOPPED)


def result_path(scene, out, kind):
    """File of the results: --out itself if it has the suffix of a format, else named after the scene in the folder --out."""
    suffix = out.suffix.removeprefix(".")
    if kind is not None and kind not in FORMATS:
        raise unknown("--format", "format", kind, FORMATS)
    if suffix not in FORMATS:
        return out / f"{Path(scene).stem}.{kind or FORMATS[0]}"
    if kind not in (None, suffix):
        raise UserError(f"--out {out}: does not go with --format {kind}")
    return out


def changes(model, settings, seed, t_end, step):
    """The command line's options as a document like a scene file's."""
    document = {"parameters": {}, "inputs": {}, "simulation": {}}
    for setting in settings:
        name, equals, value = setting.partition("=")
        if not equals:
            raise UserError(f'--set {setting}: not of the form NAME=VALUE, e.g. joint.preload="30 N"')
        section = "inputs" if name.strip() in model.inputs else "parameters"
        document[section][name.strip()] = number_or_text(value.strip().strip("\"'"))
        if section == "parameters" and name.strip() not in model.parameters:
            raise unknown("--set", "parameter or input", name.strip(), [*model.parameters, *model.inputs])
    if seed is not None:
        document["parameters"]["start.seed"] = seed
    document["simulation"] |= {key: number_or_text(value) for key, value in (("t_end", t_end), ("step", step)) if value is not None}
    return document


def number_or_text(value):
    """An int or float if the text is one."""
    for kind in (int, float):
        try:
            return kind(value)
        except ValueError:
            pass
    return value


class RealTimeFactor(ProgressColumn):
    """Wall time per simulated time so far."""

    def render(self, task):
        elapsed = task.elapsed or 0.0
        return Text(f"{elapsed / task.completed:.2f} x real time" if task.completed else "")


class Remaining(ProgressColumn):
    """Wall time still needed at the speed so far."""

    def render(self, task):
        if not task.completed:
            return Text("")
        return Text(f"{(task.elapsed or 0.0) * (task.total / task.completed - 1.0):.0f} s left")


class simulation_progress:
    """A progress bar for a scene on a terminal, nothing in a pipe; as a context manager it gives the function to call with the simulated time [s]."""

    def __init__(self, scene):
        self.bar = Progress(
            TextColumn("{task.description}"),
            BarColumn(bar_width=30),
            TextColumn("{task.completed:.3f} of {task.total:g} s"),
            RealTimeFactor(),
            Remaining(),
            console=messages,
            disable=not messages.is_terminal,
            transient=True,
        )
        self.task = self.bar.add_task(scene.name, total=scene.t_end)

    def __enter__(self):
        self.bar.start()
        return lambda t: self.bar.update(self.task, completed=t)

    def __exit__(self, *_):
        self.bar.stop()


def print_summary(result):
    """The figures of a run on the terminal."""
    from .summary import rivet_rows, summary_rows

    about, summary = result.about, result.summary
    console.print(f"[bold]{escape(about['scene'])}[/]  {escape(about['description'])}", soft_wrap=True)
    table = Table("", "unit", *(Column(text, justify="right") for text in ("mean", "RMS", "p99.9", "max")), box=None, pad_edge=False)
    for row in summary_rows(result):
        mark = "" if row.every_step else " *"
        table.add_row(row.channel + mark, row.unit, *(f"{value:.4g}" for value in (row.mean, row.rms, row.p999, row.largest)))
    console.print(table)
    rivets = rivet_rows(result)
    if rivets:
        worst = max(rivets, key=lambda row: row[1].p999)
        console.print(f"worst rivet: {worst[0]} (head p99.9 {worst[1].p999:.4g} MPa, middle p99.9 {worst[2].p999:.4g} MPa)")
    settle = result.parameters.get("start.settle", 0.0)
    if summary["simulated_time"] > settle:
        console.print(f"[dim]after the first {settle:g} s; every internal step, * at communication points only[/]")
    else:
        messages.print(f"[yellow]note:[/] no statistics: they begin at start.settle = {settle:g} s, and the run ended at {summary['simulated_time']:g} s")
    counters = {name: f"{summary[f'solver.{name}']:,.0f}" for name in ("steps", "rhs_evals", "error_tests_failed") if f"solver.{name}" in summary}
    if counters:
        console.print(f"{counters['steps']} steps, {counters['rhs_evals']} evaluations of the equations, {counters['error_tests_failed']} steps rejected")
    console.print(
        f"simulated {summary['simulated_time']:g} s in {summary['wall_time']:.2f} s, CPU time {summary['cpu_time']:.2f} s, "
        f"[bold]real-time factor {summary['real_time_factor']:.2f}[/] (CPU time / simulated time)",
        soft_wrap=True,
    )
    for text in dict.fromkeys(about.get("messages", [])):
        if not result.stopped or text not in result.stopped:
            messages.print(f"[yellow]note:[/] {escape(text)}", soft_wrap=True)


@command
def sweep(
    study: Annotated[Path, typer.Argument(help="sweep file (TOML): scene, what varies, repeats; see docs/sweeps.md", metavar="STUDY.toml")],
    fmu: Annotated[Path | None, typer.Option(help="the FMU; default: RivetedBearing.fmu here, in the checkout or as installed")] = None,
    out: Annotated[Path | None, typer.Option(help="folder of the Parquet dataset; default: results/STUDY")] = None,
    scheduler: Annotated[str | None, typer.Option(help="address of a running Dask scheduler; default: processes of this machine")] = None,
    workers: Annotated[int | None, typer.Option(min=1, help="number of local processes; default: one for each core")] = None,
):
    """Run a design of experiments on a Dask cluster, one row a run; started again, it does what is missing."""
    from .fmu import Model
    from .sweep import cluster, load_sweep, run_sweep

    plan = load_sweep(study, Model(fmu))
    folder = out or Path("results") / plan.name
    make_folder(folder)
    with cluster(scheduler, workers) as client, sweep_progress() as progress:
        rows = run_sweep(plan, folder, client, functools.partial(progress, plan.name))
    failures = rows["message"][rows["status"] != "done"]
    spent = rows["cpu_time"][rows["status"] == "done"].sum()
    console.print(f"{len(rows['key'])} runs, {len(failures)} of them failed, CPU time {spent:.1f} s")
    console.print(f"results  [cyan]{escape(str(folder))}[/]", soft_wrap=True)
    for text in dict.fromkeys(failures):
        messages.print(f"[bold red]failed:[/] {escape(text)}", soft_wrap=True)
    if len(failures):
        raise typer.Exit(STOPPED)


@command
def study(
    names: Annotated[list[str] | None, typer.Argument(help="sweeps of the study; default: all", metavar="NAME")] = None,
    fmu: Annotated[Path | None, typer.Option(help="the FMU; default: RivetedBearing.fmu here, in the checkout or as installed")] = None,
    out: Annotated[Path, typer.Option(help="folder of the runs")] = Path("results/study"),
    report: Annotated[Path | None, typer.Option(help="folder of paper.md and its pictures; default: that of the runs")] = None,
    seeds: Annotated[int | None, typer.Option(min=2, help="seeds of each point; default: eight, which the report's confidence needs")] = None,
    scheduler: Annotated[str | None, typer.Option(help="address of a running Dask scheduler; default: processes of this machine")] = None,
    workers: Annotated[int | None, typer.Option(min=1, help="number of local processes; default: one for each core")] = None,
):
    """The paper's figures again and its claims one by one: runs, pictures and paper.md; started again, it does what is missing."""
    from .fmu import Model
    from .paper import write_paper
    from .study import run_study
    from .sweep import cluster

    make_folder(report or out)
    with cluster(scheduler, workers) as client, sweep_progress() as progress:
        data = run_study(Model(fmu), out, client, names, seeds, progress)
    path = write_paper(data, report or out)
    console.print(f"report   [cyan]{escape(str(path))}[/]", soft_wrap=True)


class sweep_progress:
    """Progress bars over runs on a terminal, nothing in a pipe; as a context manager it gives the function to call with the sweep's name and its runs
    done, failed and in all."""

    def __init__(self):
        columns = (TextColumn("{task.description}"), BarColumn(bar_width=30), MofNCompleteColumn(), TextColumn("{task.fields[failed]}"), TimeRemainingColumn())
        self.bar = Progress(*columns, console=messages, disable=not messages.is_terminal, transient=True, speed_estimate_period=300.0)

    def __enter__(self):
        self.bar.start()
        tasks = {}

        def progress(name, done, failed, total):
            if name not in tasks:  # what an earlier call has done does not count for the speed
                tasks[name] = self.bar.add_task(name, total=total, completed=done, failed="")
            self.bar.update(tasks[name], completed=done + failed, failed=f"[red]{failed} failed[/]" if failed else "")

        return progress

    def __exit__(self, *_):
        self.bar.stop()


@command
def compare(
    scene: Annotated[str, typer.Argument(help="scene file (TOML) or one of the shipped scenes")],
    fmu: Annotated[Path | None, typer.Option(help="the FMU; default: RivetedBearing.fmu here, in the checkout or as installed")] = None,
    out: Annotated[Path, typer.Option(help="folder for the picture")] = Path("results"),
    set: Annotated[list[str] | None, typer.Option(help="as of `run`", metavar="NAME=VALUE")] = None,
    short: Annotated[str, typer.Option(help="horizon of the comparison point by point")] = "1 ms",
    long: Annotated[str, typer.Option(help="horizon of the statistics, 0 for none; 0.1 s take the reference some minutes")] = "0.1 s",
    seeds: Annotated[int, typer.Option(help="runs of the FMU over the long horizon")] = 8,
    method: Annotated[str, typer.Option(help="the reference's method over the short horizon: DOP853, Radau where films or joints are stiff")] = "DOP853",
):
    """Run a scene through the FMU and through the Python reference: differences in tables and a picture."""
    from .compare import compare as compare_scene
    from .compare import ledger_table, long_table, short_table
    from .fmu import Model
    from .plot import plot_comparison
    from .scene import seconds

    model = Model(fmu)
    plan = load_scene(scene, model, ("the command line", changes(model, set or [], None, None, None)))
    make_folder(out)
    horizons = {name: seconds(f"--{name}", number_or_text(text)) for name, text in (("short", short), ("long", long))}
    with Progress(SpinnerColumn(), TextColumn("{task.description}"), BarColumn(bar_width=30), console=messages, disable=not messages.is_terminal) as bar:
        task = bar.add_task("FMU, short horizon", total=1.0)
        found = compare_scene(
            model, plan, **horizons, seeds=seeds, method=method, progress=lambda what, share: bar.update(task, description=what, completed=share)
        )
    console.print(f"[bold]{escape(plan.name)}[/]: FMU against reference over {1e3 * found.t[-1]:g} ms, at tolerances of the FMU", soft_wrap=True)
    console.print(short_table(found))
    if found.statistics:
        console.print(f"\n[bold]Statistics[/] from {found.settle:g} to {found.long:g} s, {found.seeds} seeds of the FMU, one of the reference", soft_wrap=True)
        console.print(long_table(found))
        console.print("\n[bold]Energy in the reference[/]")
        console.print(ledger_table(found.ledger))
    path = plot_comparison(found, out / f"{Path(scene).stem}_compare.png")
    console.print(f"picture  [cyan]{escape(str(path))}[/]", soft_wrap=True)


@command
def report(
    results: Annotated[Path, typer.Argument(help="result file of `run`, or a folder of such files")],
    out: Annotated[Path | None, typer.Option(help="the page to write, a folder for several; default: beside the results")] = None,
):
    """One HTML page per run that needs nothing else: figures, charts, and the motion to play and scrub."""
    from .report import report_pages

    for path in report_pages(results, out):
        console.print(f"report  [cyan]{escape(str(path))}[/]", soft_wrap=True)


@command
def info(
    target: Annotated[str, typer.Argument(metavar="BEARING|SCENE", help="bearing file or designation, or scene file or name")] = DEFAULT_BEARING,
    fmu: Annotated[Path | None, typer.Option(help="the FMU whose parameters a scene starts from")] = None,
):
    """Geometry, masses, kinematic and fault frequencies, quasi-static loads and life."""
    from .bearings import bearing_case, is_bearing, scene_case, shipped_bearings
    from .fmu import Model
    from .info import info_tables

    if target not in (names := [*shipped_bearings(), *shipped_scenes()]) and not Path(target).is_file():
        raise unknown("info", "bearing, scene or file", target, names)
    case = bearing_case(target) if is_bearing(target) else scene_case(target, Model(fmu))
    console.print(f"[bold]{escape(case.designation)}[/]  {escape(case.description)}", soft_wrap=True)
    for title, table in info_tables(case):
        console.print(f"\n[bold]{title}[/]", soft_wrap=True)
        console.print(table)


@command
def rivet(
    source: Annotated[Path | None, typer.Argument(metavar="TABLE|GEOMETRY", help="rivet table (JSON) or geometry (TOML); default: the table shipped")] = None,
    out: Annotated[Path, typer.Option(help="folder for the pictures")] = Path("results"),
):
    """Stress of the rivet over preload, fit and transverse load; pictures of curves, mesh, deformed section and stress."""
    from .rivet import curve_tables, rivet_curves, write_pictures

    make_folder(out)
    with messages.status("finite elements"):
        title, curves, joint = rivet_curves(source)
        paths = write_pictures(out, title, curves, joint)
    console.print(f"[bold]{escape(title)}[/]", soft_wrap=True)
    for name, rows in curve_tables(curves):
        console.print(f"\n[bold]{name}[/]", soft_wrap=True)
        console.print(rows)
    for path in paths:
        console.print(f"picture  [cyan]{escape(str(path))}[/]", soft_wrap=True)
