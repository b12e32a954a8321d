"""The command line, `riveted-bearing`: one module a command, which adds itself to the program when it is imported.

A further command is a further module and its name in the line below, which is also the order of the help.  What a command computes stands in the package,
not here; modules of commands import what is slow (fmpy, matplotlib, SciPy) when the command is called.
"""

from . import build, run, sweep, study, compare, report, info, rivet  # noqa: F401, I001
from .terminal import program

__all__ = ["program"]
