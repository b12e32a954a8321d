"""What several commands print: notes, tables, the files that were written."""

from rich.markup import escape
from rich.table import Column, Table

from .terminal import console, messages


def note(text, word="[yellow]note:[/]", to=messages):
    """A sentence behind a word that says what it is."""
    to.print(f"{word} {escape(str(text))}")


def print_paths(*files):
    """Label and path of each file that was written."""
    for label, path in files:
        console.print(f"{label:8} [cyan]{escape(str(path))}[/]")


def print_basis(rows):
    """What the figures that follow rest on; what a scene has replaced stands out."""
    for name, text in rows:
        console.print(f"[{'yellow' if name == 'replaced' else 'dim'}]{name:13} {escape(text)}[/]")


def print_warnings(texts):
    """Sentences that a user must not miss, on stderr."""
    for text in texts:
        messages.print(f"[yellow]warning: {escape(text)}[/]")


def table(heads, rows=(), left=1, **look):
    """A table of texts without rules: its first columns, `left` of them, stand on the left, the others on the right."""
    columns = (Column(head, justify="left" if i < left else "right") for i, head in enumerate(map(escape, heads)))
    shown = Table(*columns, **{"box": None, "pad_edge": False} | look)
    for row in rows:
        shown.add_row(*map(escape, row))
    return shown


def print_runs(rows, what, path):
    """How many runs of a sweep's rows are done, where they are and why others failed; returns whether some failed."""
    failures, spent = rows["message"][rows["status"] != "done"], rows["cpu_time"][rows["status"] == "done"].sum()
    console.print(f"{len(rows['key'])} {what}, {len(failures)} of them failed, CPU time {spent:.1f} s")
    print_paths(("results", path))
    for text in dict.fromkeys(failures):
        note(text, "[bold red]failed:[/]")
    return len(failures) > 0


def print_budgets(budgets):
    """Error budgets, the largest part first."""
    from ..running.accuracy import FIGURES
    from ..running.budget import RULE, amounts, told, unsized_lines

    for budget in budgets:
        console.print(f"[bold]{FIGURES[budget.figure][0]} {told(budget)}[/]  [dim]90 % interval, by parts:[/]")
        console.print(table(("", "truth less number", ""), amounts(budget), left=3))
    for line in unsized_lines(budgets[0]) if budgets else ():
        console.print(f"[dim]{escape(line)}[/]")
    if budgets:
        console.print(f"[dim]{RULE}[/]")
