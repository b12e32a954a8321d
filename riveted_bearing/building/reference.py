"""The Python reference of another bearing than the 6207, for `riveted-bearing compare`.

Number of balls, start values and rivet table are fixed when bearing_model is imported: those of the 6207.  A build
leaves those of its bearing in its folder.  A fresh interpreter takes them from there before anything else is imported,
and runs the command again.
"""

from __future__ import annotations

import hashlib
import importlib.util
import os
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ..running.fmu import Model

VARIABLES = "bearing_model.generated.variables"
AGAIN = (
    "import importlib.util as u, sys; s = u.spec_from_file_location('reference', sys.argv[1]); "
    "m = u.module_from_spec(s); s.loader.exec_module(m); m.install(sys.argv[2]); "
    "from riveted_bearing.cli import program; program(sys.argv[3:])"
)


def is_installed(model: Model) -> bool:
    """Whether the installed reference is that of the FMU's bearing."""
    from bearing_model.generated import variables

    return model.description.guid == variables.MODEL_GUID


def folder_of(model: Model) -> Any:
    """The build folder that has left this very FMU; UserError if there is none."""
    from ..base.errors import UserError
    from ..running.fmu import FMU_NAME
    from .builder import build_folder, source_folder

    folders = build_folder(source_folder(), None).parent
    for path in sorted(folders.glob(f"*/{FMU_NAME}")) + sorted(folders.glob(f"*/archive/{FMU_NAME}")):
        folder = path.parent.parent if path.parent.name == "archive" else path.parent
        same = path.stat().st_size == model.path.stat().st_size
        if same and (folder / "generated").is_dir() and hashlib.sha256(path.read_bytes()).hexdigest() == model.digest:
            return folder
    raise UserError(
        f"{model.path}: not of the 6207, whose reference is installed, and the build folder with this bearing's own is "
        f"gone: `riveted-bearing build --bearing FILE --out {model.path}` makes both again"
    )


def run_again(folder: Path, arguments: Any) -> int:
    """Run the program with the reference of a build folder in a fresh interpreter; returns its exit code."""
    here = Path(__file__).resolve()
    path = os.pathsep.join(filter(None, [str(here.parents[2]), os.environ.get("PYTHONPATH")]))
    command = [sys.executable, "-c", AGAIN, str(here), str(folder), *arguments]
    return subprocess.run(command, env=os.environ | {"PYTHONPATH": path}, check=False).returncode


def install(folder):
    """Make bearing_model that of the bearing of a build folder; nothing may have imported its variables before."""
    import bearing_model.generated

    assert VARIABLES not in sys.modules, "too late: another bearing's variables are in use"
    spec = importlib.util.spec_from_file_location(VARIABLES, Path(folder) / "generated" / "variables.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[VARIABLES] = bearing_model.generated.variables = module
    spec.loader.exec_module(module)
    from bearing_model.rivet import rivet_table

    rivet_table.DEFAULT_TABLE = Path(folder) / "rivet_table.json"
