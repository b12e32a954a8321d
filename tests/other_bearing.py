"""The tests of both twins on another bearing: BEARING_BUILD=build/bearings/6310 pytest tests/test_twin.py -k
derivatives

BEARING_BUILD is a folder that `riveted-bearing build --bearing` left, with the library of the tests added (cmake
--build FOLDER --target bearing_test). Import this before anything of bearing_model: number of balls and start values
are those of the folder's variables.py, the rivet table is its own.
"""

import os
from pathlib import Path

from riveted_bearing.building.reference import install

BUILD = Path(os.environ["BEARING_BUILD"]).resolve() if "BEARING_BUILD" in os.environ else None

if BUILD:
    install(BUILD)
