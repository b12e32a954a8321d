"""The command line, `riveted-bearing`: each command is a module of this folder, imported when it is called or shown.

For a further command write its module here.  What the command computes belongs into another room.  Slow imports (NumPy,
fmpy, matplotlib, SciPy) stand inside the command's function, because the help imports all modules of commands.
"""

from importlib import import_module
from pkgutil import iter_modules

from typer.core import TyperGroup
from typer.main import get_command_from_info

from .terminal import main, program

__all__ = ["COMMANDS", "program"]

SHARED = ("info_tables", "options", "printing", "terminal")  # modules that are no command
COMMANDS = tuple(module.name for module in iter_modules(__path__) if module.name not in SHARED)


class Commands(TyperGroup):
    """The commands by name, imported when asked for; an unknown name imports all, to name the nearest."""

    def list_commands(self, ctx):
        return [name.replace("_", "-") for name in COMMANDS]

    def get_command(self, ctx, cmd_name):
        known = self.list_commands(ctx)
        for name in [cmd_name] if cmd_name in known else known:
            if name not in self.commands:
                self.commands[name] = self.loaded(name.replace("-", "_"))
        return self.commands.get(cmd_name)

    def loaded(self, module):
        """The command that a module of this folder registers."""
        import_module(f".{module}", __name__)
        registered = {command.callback.__name__: command for command in program.registered_commands}
        return get_command_from_info(
            registered[module], pretty_exceptions_short=False, rich_markup_mode=self.rich_markup_mode
        )


program.callback(cls=Commands)(main)
