"""docs/showing.md: its commands have the options that the page uses."""

import re
import shlex
from pathlib import Path

import pytest
import typer
from typer.main import get_command

from riveted_bearing.cli import program

PAGE = (Path(__file__).parents[1] / "docs" / "showing.md").read_text(encoding="utf-8")
COMMANDS = [line for text in re.findall(r"^```sh\n(.*?)^```", PAGE, re.S | re.M) for line in text.splitlines()]


@pytest.mark.parametrize("line", COMMANDS)
def test_commands_parse(line):
    _, name, *arguments = shlex.split(line)
    command = get_command(program)
    with typer.Context(command) as context:
        command.get_command(context, name).make_context(name, arguments, parent=context)


def test_the_page_has_each_command():
    assert {line.split()[1] for line in COMMANDS} == {"summary", "compare-designs", "report"}
