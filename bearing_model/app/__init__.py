"""The command line and what it is made of: scenes, runs through the FMU, results, plots.

    from bearing_model.app import run
    result = run("demo", parameters={"joint.preload": "30 N"})

gives result.data (arrays by channel), .units, .parameters, .summary and .about; read_result(path) gives the same from a file.
"""

from .errors import UserError
from .results import Result, read_result, write_result
from .runner import run

__all__ = ["Result", "UserError", "read_result", "run", "write_result"]
