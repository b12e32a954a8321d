"""Options that several commands have."""

from pathlib import Path
from typing import Annotated, Any

import typer


def file_argument(metavar: str, words: str) -> Any:
    """The argument of a command that names a file of the user's."""
    return typer.Argument(metavar=metavar, help=words)


FMU = Annotated[
    Path | None,
    typer.Option("--fmu", help="the FMU; default: RivetedBearing.fmu here, in the checkout or as installed"),
]
OUT = Annotated[
    Path | None,
    typer.Option("--out", help="folder of runs, results and page; default: results/ and the name of the file"),
]
SETTINGS = Annotated[
    list[str] | None,
    typer.Option(
        "--set", help='parameter or constant input, e.g. --set joint.preload="30 N"; repeatable', metavar="NAME=VALUE"
    ),
]
SCHEDULER = Annotated[
    str | None,
    typer.Option("--scheduler", help="address of a running Dask scheduler; default: processes of this machine"),
]
WORKERS = Annotated[
    int | None, typer.Option("--workers", min=1, help="number of local processes; default: one for each core")
]
CAGE = Annotated[
    str | None,
    typer.Option(
        "--cage", help="shape of a bearing's cage; default: the file's, else machined", metavar="machined|ribbon"
    ),
]
SENSITIVITY = Annotated[
    Path | None,
    typer.Option("--sensitivity", help="sensitivity.json of `sensitivity`, or its folder: names what decides"),
]
CLEANLINESS = Annotated[
    str | None,
    typer.Option(
        "--cleanliness",
        help="of the oil, for the raceways' life: e_C, high, normal, typical, severe or an ISO 4406 code; default: normal, assumed",
        metavar="E_C|NAME|CODE",
    ),
]
