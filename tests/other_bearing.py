"""The tests of both twins on another bearing: BEARING_BUILD=build/bearings/6310 pytest tests/test_twin.py -k
derivatives

BEARING_BUILD is a folder that `riveted-bearing build --bearing` left, with the library of the tests added (cmake
--build FOLDER --target bearing_test). Import this before anything of bearing_model: number of balls and start values
are those of the folder's variables.py, the rivet table is its own.
"""

import importlib.util
import os
import sys
from pathlib import Path

BUILD = Path(os.environ["BEARING_BUILD"]).resolve() if "BEARING_BUILD" in os.environ else None


def install(build):
    """Makes the package that of the other bearing."""
    import bearing_model.generated

    spec = importlib.util.spec_from_file_location(
        "bearing_model.generated.variables", build / "generated" / "variables.py"
    )
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = bearing_model.generated.variables = module
    spec.loader.exec_module(module)
    from bearing_model.rivet import rivet_table

    rivet_table.DEFAULT_TABLE = build / "rivet_table.json"


if BUILD:
    assert "bearing_model.generated.variables" not in sys.modules, "too late: another bearing's variables are in use"
    install(BUILD)
