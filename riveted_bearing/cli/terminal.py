"""Shared by all commands: the program, its two consoles, the decorator `command`, progress bars."""

import contextlib
import functools
import os
import platform
import sys
from typing import Annotated

import typer
from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, MofNCompleteColumn, Progress, ProgressColumn, TextColumn, TimeRemainingColumn
from rich.text import Text

from ..base.errors import UserError, extra, naming, refusal, unknown

BAD_INPUT, STOPPED, INTERRUPTED = 2, 3, 130  # exit codes; 130: shells' own for Ctrl-C
# Libraries of the extra "full": a run needs none of them.
FULL = (
    "scipy",
    "skfem",
    "threadpoolctl",
    "jinja2",
    "matplotlib",
    "pyarrow",
    "dask",
    "distributed",
    "filelock",
    "rainflow",
)


class Terminal(Console):
    """A console whose texts are wrapped by the terminal itself, so that paths stay whole; tables fit its width."""

    def print(self, *objects, **options):
        super().print(*objects, **{"soft_wrap": all(isinstance(each, str) for each in objects)} | options)


program = typer.Typer(no_args_is_help=True, add_completion=False, pretty_exceptions_enable=False)
PIPE_WIDTH = 160  # characters, where there is no terminal to ask
console = Terminal(highlight=False, width=None if sys.stdout.isatty() or "COLUMNS" in os.environ else PIPE_WIDTH)
messages = Terminal(stderr=True, highlight=False)


def chosen_cleanliness(value):
    """The cleanliness of the option --cleanliness, None if it was not given."""
    from ..duty.raceways import cleanliness_of

    return None if value is None else option_value("--cleanliness", value, cleanliness_of)


def option_value(option, text, read):
    """What an option's text means by read(its number or text); UserError naming both."""
    with naming(f"{option} {text}", (UserError,)):
        return read(number_or_text(text))


def print_version(wanted: bool):
    """Print version, Python and platform, then end."""
    if wanted:
        from ..base.version import __version__  # its library takes longer than the rest of the help

        console.print(
            f"riveted-bearing {__version__}, Python {platform.python_version()}, {platform.system()} {platform.machine()}"
        )
        raise typer.Exit


def main(
    version: Annotated[
        bool, typer.Option("--version", callback=print_version, is_eager=True, help="print the version and end")
    ] = False,
):
    """riveted-bearing: dynamics of a ball bearing with a two-piece riveted cage, as an FMU."""


def guarded(function):
    """A command whose UserErrors and the system's become one line and exit code 2, Ctrl-C one and 130."""

    @functools.wraps(function)
    def called(*arguments, **options):
        try:
            return function(*arguments, **options)
        except UserError as problem:
            fault = str(problem)
        except ModuleNotFoundError as problem:
            library = (problem.name or "").partition(".")[0]
            if library not in FULL:
                raise
            fault = f"this command needs {library}, which an installation to simulate does not have: {extra('full')}"
        except KeyboardInterrupt:
            messages.print("interrupted: no file has changed")
            raise typer.Exit(INTERRUPTED) from None
        except BrokenPipeError:  # nobody reads the output any more: the interpreter ends in silence
            raise
        except OSError as problem:  # disk full, no permission, no more files or memory
            if problem.strerror is None:
                raise
            fault = (f"{problem.filename}: " if problem.filename else "") + problem.strerror
        messages.print(f"[bold red]error:[/] {escape(fault)}")
        raise typer.Exit(BAD_INPUT)

    return called


def command(function):
    """Add a function to the program as a guarded command."""
    return program.command()(guarded(function))


def changes(model, settings, seed, t_end, step, accuracy=None):
    """The options of the command line as a document with the structure of a scene file."""
    document = {"parameters": {}, "inputs": {}, "simulation": {}}
    for setting in settings:
        name, equals, value = setting.partition("=")
        if not equals:
            raise UserError(f'--set {setting}: not of the form NAME=VALUE, e.g. joint.preload="30 N"')
        if name.strip() == "oil":
            document["oil"] = value.strip().strip("\"'")
            continue
        section = "inputs" if name.strip() in model.inputs else "parameters"
        document[section][name.strip()] = number_or_text(value.strip().strip("\"'"))
        if is_of_rivet(name.strip()):
            remedy = "give it in [rivet] of a bearing file, of which `riveted-bearing build --bearing` makes an FMU"
            raise refusal("--set", name.strip(), value, f"fixed by the build: {remedy}")
        if section == "parameters" and name.strip() not in model.parameters:
            raise unknown("--set", "parameter or input", name.strip(), [*model.parameters, *model.inputs])
    if seed is not None:
        document["parameters"]["start.seed"] = seed
    document["simulation"] |= {
        key: number_or_text(value)
        for key, value in (("t_end", t_end), ("step", step), ("accuracy", accuracy))
        if value is not None
    }
    return document


def screen(model, further=None):
    """The screening of an FMU, measured if it has none; says so and shows how far it is."""
    from ..running.screen import screened
    from ..running.screening import known

    record = known(model)
    if record is None or further:
        messages.print(
            f"[dim]what is assumed, screened once for {escape(model.path.name)} (some minutes of processor time at most)[/]"
        )
    with sweep_progress() as progress:
        return screened(model, lambda done, total: progress("screening", done, 0, total), further)


def is_of_rivet(name):
    """Whether a name is that of a dimension of the rivet in a bearing file."""
    if not name.startswith("rivet."):
        return False
    from ..bearing.bearing_keys import RIVET_SIZES

    return name.removeprefix("rivet.") in RIVET_SIZES


def number_or_text(value):
    """An int or float if the text is one."""
    for kind in (int, float):
        try:
            return kind(value)
        except ValueError:
            pass
    return value


@contextlib.contextmanager
def resumable(folder):
    """For work whose parts are kept in a folder one by one: Ctrl-C becomes one line that says so."""
    try:
        yield
    except KeyboardInterrupt:
        kept = f"finished runs are kept in {escape(str(folder))}; the same command does the others"
        messages.print(f"interrupted: {kept}")
        raise typer.Exit(INTERRUPTED) from None


@contextlib.contextmanager
def design_runs(name, folder, scheduler, workers):
    """For a study: a function that starts the cluster when it is first called, and one for progress."""
    from ..studies.sweep import cluster

    with resumable(folder), contextlib.ExitStack() as stack:
        progress = stack.enter_context(sweep_progress())
        client = functools.cache(lambda: stack.enter_context(cluster(scheduler, workers)))
        yield client, functools.partial(progress, name)


class RealTimeFactor(ProgressColumn):
    """Wall time per simulated time so far."""

    def render(self, task):
        elapsed = task.elapsed or 0.0
        return Text(f"{elapsed / task.completed:.2f} x real time" if task.completed else "")


def progress_bar(*columns, **options):
    """A progress bar with these columns behind name and bar, on a terminal; nothing in a pipe."""
    columns = TextColumn("{task.description}"), BarColumn(bar_width=30), *columns
    return Progress(*columns, console=messages, disable=not messages.is_terminal, **options)


@contextlib.contextmanager
def simulation_progress(scene):
    """Progress bar of a scene: gives the function to call with the simulated time [s]."""
    columns = TextColumn("{task.completed:.3f} of {task.total:g} s"), RealTimeFactor(), TimeRemainingColumn()
    with progress_bar(*columns, transient=True) as bar:
        task = bar.add_task(scene.name, total=scene.t_end)
        yield lambda t: bar.update(task, completed=t)


@contextlib.contextmanager
def sweep_progress():
    """Progress bars: gives progress(sweep's name, runs done, failed, in all)."""
    columns = MofNCompleteColumn(), TextColumn("{task.fields[failed]}"), TimeRemainingColumn()
    with progress_bar(*columns, transient=True, speed_estimate_period=300.0) as bar:
        tasks = {}

        def progress(name, done, failed, total):
            if name not in tasks:  # runs that an earlier call has done do not count for the speed
                tasks[name] = bar.add_task(name, total=total, completed=done, failed="")
            words = f"[red]{failed} failed[/]" if failed else ""
            bar.update(tasks[name], total=total, completed=done + failed, failed=words)

        yield progress
