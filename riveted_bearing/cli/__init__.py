"""The command line, `riveted-bearing`: each command is a module, which adds the command to the program when it is
imported.

For a further command write its module here and add the module's name to the line below, whose order is that of the
help.  What the command computes belongs into a module of riveted_bearing.  Slow imports (fmpy, matplotlib, SciPy) stand
inside the command's function.
"""

from . import (
    build,
    cascade,
    compare,
    compare_designs,
    cookbook,
    dataset,
    identify,
    info,
    life,
    matrices,
    optimize,
    report,
    rivet,
    run,
    sensitivity,
    spectrum,
    summary,
    sweep,
    variables,
)
from .terminal import program

__all__ = ["program"]
