"""The C core and the Python reference on a second bearing: the 6310, eight balls, its own variables, core and rivet table."""

import os
import subprocess
import sys

import pytest
from library import ROOT

from riveted_bearing import build
from riveted_bearing.builder import build_folder

TESTS = "derivatives or jacobian or start or outputs or power_is_rate"


@pytest.mark.slow
def test_6310(tmp_path):
    """dy/dt at 1200 states, Jacobian, start and outputs of both twins: the tests of test_twin.py with their tolerances."""
    build("6310", out=tmp_path / "6310.fmu", table="closed-form")
    folder = build_folder(ROOT, "6310")
    subprocess.run([sys.executable, "-m", "cmake", "--build", folder, "--target", "bearing_test"], check=True, capture_output=True)
    command = [sys.executable, "-m", "pytest", "-q", "-rP", "-p", "no:cacheprovider", "tests/test_twin.py", "-k", TESTS]
    done = subprocess.run(command, cwd=ROOT, env=os.environ | {"BEARING_BUILD": str(folder)}, capture_output=True, text=True, check=False)
    print(done.stdout)
    assert done.returncode == 0, done.stdout
    assert " passed" in done.stdout
