"""docs/coupling.md: each block does what the page says, against fmpy; the flexible shaft against the beam's closed
forms.
"""

import importlib.util
import math
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[1]
PAGE = (ROOT / "docs" / "coupling.md").read_text(encoding="utf-8")
BLOCKS = {re.match(r"# (\S+)", text)[1]: text for text in re.findall(r"^```python\n(.*?)^```", PAGE, re.S | re.M)}
NEEDS = {"with_ecos.py": "ecospy", "with_libcosim.py": "libcosimpy", "with_pathsim.py": "pathsim_fmi"}
SAME = 1e-9  # as in test_importers.py


@pytest.fixture
def said(fmu, tmp_path):
    """said(name) -> what a block of the page prints, run as a program in a folder with the FMU."""
    (tmp_path / fmu.name).symlink_to(fmu)
    programs = tmp_path / "bin"
    programs.mkdir()
    (programs / "unzip").write_text(f'#!/bin/sh\nexec "{sys.executable}" -m zipfile -e "$2" "$4"\n')  # ecos calls it
    (programs / "unzip").chmod(0o755)
    environment = os.environ | {"PATH": f"{programs}{os.pathsep}{os.environ['PATH']}"}

    def run(name):
        (tmp_path / name).write_text(BLOCKS[name], encoding="utf-8")
        done = subprocess.run(
            [sys.executable, name], cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stderr
        return done.stdout

    return run


def force(text):
    return float(re.search(r"F_y (-?[\d.]+) N", text)[1])


@pytest.fixture(scope="module")
def expected(fmu):
    """The force by this project's own runner."""
    from riveted_bearing import run

    inputs = {"shaft.omega": 1500.0, "shaft.F_y": 2000.0, "shaft.F_x": 300.0}
    settings = {"t_end": 2e-3, "step": 1e-4, "parameters": {"joint.preload": 30.0, "scene.statistics": "off"}}
    found = run(None, inputs=inputs, fmu=fmu, **settings).data["housing.F_y"][-1]
    assert abs(found - 2000.0) < 200.0  # the load, but for what accelerates the ring
    return found


@pytest.mark.parametrize("name", [name for name in BLOCKS if name.startswith("with_")])
def test_a_recipe_does_what_it_says(said, expected, name):
    if (needed := NEEDS.get(name)) and not importlib.util.find_spec(needed):
        pytest.skip(f"{needed} is not installed: pip install '.[importers]'")
    assert force(said(name)) == pytest.approx(expected, rel=SAME, abs=1e-6)  # six digits are printed


def test_the_spindle_runs_up(said):
    """50 ms of 5 N.m less some 0.3 N.m of friction on 2e-3 kg.m2; 30 N of preload alone give 72 MPa in the head."""
    omega, friction, head = map(float, re.findall(r"\d+\.?\d*", said("spindle.py"))[:3])
    assert omega == pytest.approx(1000.0 + (5.0 - friction) * 0.05 / 2e-3, rel=0.01) and 40.0 < head < 900.0


# ------------------------------------------------------------------------------------------------------ flexible shaft


@pytest.fixture(scope="module")
def shaft():
    spec = importlib.util.spec_from_file_location("flexible_shaft", ROOT / "examples" / "spindle" / "flexible_shaft.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_beam_bends_and_vibrates_as_in_the_book(shaft):
    """Free-free: two motions without stiffness, then (4.7300/L)^2 sqrt(E I/(rho A)), which Hermite elements exceed by
    less than 0.1 %; mass of the rigid motion: that of the shaft.
    """
    L, d = 0.4, shaft.DIAMETER
    nodes, M, K = shaft.beam(L)
    one = np.zeros(len(M))
    one[nodes[0]] = 1.0
    assert one @ M @ one == pytest.approx(shaft.RHO * math.pi * d**2 / 4 * L, rel=1e-12)
    from scipy.linalg import eigh

    found = eigh(K, M, eigvals_only=True)
    first = (4.730041 / L) ** 2 * math.sqrt(shaft.E / shaft.RHO) * d / 4
    assert abs(found[1]) < 1e-6 * found[2]
    assert 1.0 <= math.sqrt(found[2]) / first < 1.001


def test_the_shaft_sits_on_two_bearings(shaft, fmu):
    """F L^3/(48 E I) between its ends, half of the load on each bearing, and by symmetry no motion along Z beside
    theirs; the second half of 20 ms, ten periods of the first bending mode.
    """
    L, d, F = 0.4, shaft.DIAMETER, 1000.0
    places, reactions, stresses = shaft.simulate(F, 6000.0 * math.pi / 30.0, L, duration=0.02, fmu=fmu)
    late = slice(len(places) // 2, None)
    mean, R = places[late].mean(axis=0), reactions[late].mean(axis=0)
    bending = F * L**3 / (48 * shaft.E * math.pi * d**4 / 64)
    assert mean[shaft.ELEMENTS // 2, 0] - mean[[0, -1], 0].mean() == pytest.approx(bending, rel=5e-3)
    assert R[:, 0] == pytest.approx([-F / 2, -F / 2], rel=5e-3)
    assert np.abs(mean[:, 1]).max() < 0.05 * bending
    assert 1e-6 < mean[0, 0] < 2e-5  # bearings of some 1e8 N/m under 500 N
    assert all(1e6 < stress < 1e9 for stress in stresses)


def test_a_longer_shaft_bends_with_the_cube_of_its_length(shaft, fmu):
    """1.25^3 = 1.953 times as much under the same load."""
    bent = []
    for L in (0.32, 0.4):
        places, _, _ = shaft.simulate(500.0, 628.0, L, duration=0.008, fmu=fmu, stress=False)
        mean = places[len(places) // 2 :].mean(axis=0)[:, 0]
        bent.append(mean[shaft.ELEMENTS // 2] - mean[[0, -1]].mean())
    assert bent[1] / bent[0] == pytest.approx(1.25**3, rel=0.01)
