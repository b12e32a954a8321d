"""The worked systems of examples/: a planetary stage, a transmission in a vibrating housing, a flexible rotor of ROSS
on two bearings.
"""

import importlib.util
import json
import subprocess
import sys
import venv

import numpy as np
import pytest
from library import ROOT

from bearing_model.generated.variables import PARAMETERS


def example(*place):
    """A script of examples/ as a module."""
    path = ROOT.joinpath("examples", *place)
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    sys.path.insert(0, str(path.parent))
    try:
        spec.loader.exec_module(module)
    finally:
        sys.path.remove(str(path.parent))
    return module


# ------------------------------------------------------------------------------------------------------ planetary stage


def test_planet_bearing(fmu, tmp_path, record_property):
    """Carrier at 1500 r/min: the cage turns as both rings make it, omega_e (1 + D/d_m)/2 within 2 %; the carrier's
    field throws it against the outer ring.

    The field is 3,700 m/s2 on a cage of 56 g: 207 N, against a film that is made for its weight.  The rivets feel it:
    several times the stress.
    """
    planet = example("planet", "planet.py")
    rows = {field: planet.summary(planet.run(1500.0, field, t_end=0.08, fmu=fmu)) for field in (True, False)}
    record_property("with and without", json.dumps(rows))
    gear = -1500.0 * np.pi / 30.0 * (planet.R + planet.R_PLANET) / planet.R_PLANET
    rolling = 0.5 * gear * (1.0 + PARAMETERS["bearing.D"].start / PARAMETERS["bearing.d_m"].start)
    assert rows[False]["cage_omega"] == pytest.approx(rolling, rel=0.02)
    assert rows[True]["cage_omega"] == pytest.approx(rolling, rel=0.04)  # braked by the outer ring, on which it lies
    assert rows[True]["eccentricity"] > 0.9 > rows[False]["eccentricity"]
    assert rows[True]["sigma_head_p999"] > 3.0 * rows[False]["sigma_head_p999"]
    heads, values = planet.table([1500.0], {field: [row] for field, row in rows.items()})
    assert all(unit in heads for unit in ("[r/min]", "[MPa]", "[W]"))
    assert values.count("(") == len(rows[True]) == len(planet.COLUMNS)
    planet.plot([1500.0], {field: [row] for field, row in rows.items()}, tmp_path / "planet.png")


# ---------------------------------------------------------------------------------------------------- vibrating housing


def test_vibrating_housing(tmp_path, record_property):
    """A whirl of 30 um at 400 Hz shakes what the bearing carries: the force's harmonic is mass times acceleration,
    within the cage's share.

    The inner ring and the balls follow the housing, whose bearing is stiff (resonance at 2.5 kHz: 1 + (0.4/2.5)^2); the
    cage, 56 g of 0.71 kg, lies in its clearance and follows as it likes.
    """
    vibrating = example("transmission", "vibrating.py")
    size, frequency, stop = 3e-5, 400.0, 0.04
    quiet, shaken = (vibrating.simulate(stop=stop, amplitude=a, frequency=frequency) for a in (0.0, size))
    later = shaken["time"] > 0.015 - 1e-9  # ten periods
    wave = np.exp(-2j * np.pi * frequency * shaken["time"][later])
    harmonic = 2.0 * np.mean((shaken["housing.F_y"] - quiet["housing.F_y"])[later] * wave)
    ball = PARAMETERS["bearing.rho"].start * np.pi / 6.0 * PARAMETERS["bearing.D"].start ** 3
    mass = PARAMETERS["ring.m"].start + 9 * ball
    force = mass * size * (2.0 * np.pi * frequency) ** 2
    record_property("share", float(abs(harmonic) / force))
    assert abs(harmonic) == pytest.approx(force, rel=0.1)
    # y = size sin(w t): the inertia force on the housing is + m w^2 y
    assert abs(np.angle(harmonic / (-1j))) < 0.2
    vibrating.plot(quiet, shaken, tmp_path / "vibrating.png")


# ----------------------------------------------------------------------------------------------------------- delay line


def test_delay_line(fmu, record_property):
    """A passive connection: bounded where a held spring diverges, and of order 2; both meet the same motion as the step
    shrinks.
    """
    delay_line = example("delay_line", "delay_line.py")

    steps = [5e-5, 1e-5, 5e-6]
    rows, size = delay_line.errors(steps, fmu=fmu)
    record_property("um", (1e6 * np.array(rows)).tolist())
    line, spring = np.array(rows).T
    assert line[0] < size < 0.2 * spring[0]
    assert 1.7 < np.log2(line[1] / line[2]) < 2.3  # observed 2.0
    assert line[2] < 0.01 * size  # observed 0.7 %
    assert spring[2] < 0.02 * size  # observed 1.1 %


# ---------------------------------------------------------------------------------------------------------------- rotor

PROGRAM = """
import json, sys
import numpy as np
sys.path.insert(0, sys.argv[1])
import rotor as example
import ross as rs
from fmpy import extract, read_model_description
description, folder = read_model_description(sys.argv[2]), extract(sys.argv[2])
element = rs.BearingElement.load(example.HERE / "bearing_ross.toml")
table = {name: getattr(element, name) for name in ("kxx", "kyy", "kxy", "kyx", "cxx", "cyy", "cxy", "cyx", "frequency")}
rows = []
for speed, unbalance in ((6000.0, 5e-5), (9000.0, 5e-5), (11000.0, 5e-5), (9000.0, 5e-4)):
    w = speed * np.pi / 30.0
    linear = example.rotor([rs.BearingElement(n=n, **table) for n in example.NODES]).run_unbalance_response(
        example.DISK, unbalance, 0.0, frequency=np.array([w])).forced_resp.T[0]
    found = example.coupled(description, folder, w, unbalance, float(np.interp(w, table["frequency"], table["kxx"])), linear, settle=0.35, length=0.05)
    rows.append([[complex(q[d]).real for q in (linear, found)] + [complex(q[d]).imag for q in (linear, found)] for d in (24, 0)])
print("ROWS", json.dumps(rows))
w, by_ross, on_fmus = example.run_up((8000 * np.pi / 30, 12000 * np.pi / 30), 0.15, 2e-5, sys.argv[2])
sizes = [[np.hypot(a[:, i], a[:, i + 1]) for i in (0, 2)] for a in (by_ross, on_fmus)]
apart = [float(np.sqrt(np.mean((by_ross[:, i] - on_fmus[:, i]) ** 2) / np.mean(by_ross[:, i] ** 2))) for i in (0, 2)]
print("RUN_UP", json.dumps([[float(size.max()) for size in pair] + [float(w[size.argmax()]) for size in pair] for pair in sizes] + [apart]))
"""


@pytest.mark.slow
def test_rotor_in_ross(fmu, tmp_path, record_property):
    """Unbalance response of the rotor on two FMUs, against ROSS with the FMU's own matrices: 2 % and 2 degrees of disk
    and bearing; observed 1 %.

    The runs begin with ROSS' own response, because the rotor's decay takes 0.2 s near its critical speed; after 0.35 s
    83 % of a difference would be there.

    With ten times the unbalance the bearing's motion near the critical speed (10 um) exceeds the preload's approach of
    some um: there the stiffness is another.
    """
    environment = tmp_path / "ross"
    venv.create(environment, with_pip=True)
    python = environment / "bin" / "python"
    install = subprocess.run(
        [python, "-m", "pip", "install", "-q", "ross-rotordynamics>=2.3", "plotly<6", "fmpy"],
        capture_output=True,
        text=True,
    )
    if install.returncode:
        pytest.skip(f"ROSS cannot be installed here: {install.stderr[-200:]}")
    run = subprocess.run(
        [python, "-c", PROGRAM, str(ROOT / "examples" / "rotor"), str(fmu)],
        capture_output=True,
        text=True,
        cwd=tmp_path,
    )
    assert run.returncode == 0, run.stderr[-2000:]
    rows = json.loads(next(line for line in run.stdout.splitlines() if line.startswith("ROWS"))[4:])
    ratios = np.array([[complex(row[1], row[3]) / complex(row[0], row[2]) for row in pair] for pair in rows])
    record_property("ratios", [[str(value) for value in pair] for pair in ratios])
    assert np.abs(np.abs(ratios[:3]) - 1.0).max() < 0.02
    assert np.degrees(np.abs(np.angle(ratios[:3]))).max() < 2.0
    assert abs(abs(ratios[3, 1]) - 1.0) > 0.05  # the bearing's node at the large unbalance

    # while the speed rises through the critical one: largest motions of disk and bearing (1.4 um; the stiffness falls
    # with the square of the amplitude, and
    # at 3.6 um the bearing moves 2.4 % farther than ROSS says), where they are, RMS of the difference; observed 0.01,
    # 0.7 % and 0.07, 0.7 %
    by_ross, on_fmus, apart = (
        np.array(row)
        for row in json.loads(next(line for line in run.stdout.splitlines() if line.startswith("RUN_UP"))[6:])
    )
    record_property("run_up", [by_ross.tolist(), on_fmus.tolist(), apart.tolist()])
    assert np.abs(on_fmus[:2] / by_ross[:2] - 1.0).max() < 0.02
    assert np.abs(on_fmus[2:] / by_ross[2:] - 1.0).max() < 0.01
    assert apart.max() < 0.02


# --------------------------------------------------------------------------------------------------- a failure of the oil


def test_oil_off(fmu, tmp_path, record_property):
    """50 ms without oil, by fmpy: the drag of the balls goes with the density of the mixture, 1.2/35, and comes back; the
    pockets lose more by dry friction.
    """
    oil_off = example("oil_off", "oil_off.py")
    result = oil_off.run(0.03, 0.05, 0.03, fmu=fmu, **{"scene.cage": 1})
    means = oil_off.means(result, 0.03, 0.05)
    record_property("means", json.dumps(means))
    before, without, after = (means[name] for name in ("before", "without oil", "after"))
    assert without["loss.ball_drag"] == pytest.approx(before["loss.ball_drag"] * 1.2 / 35.0, rel=0.02)
    assert after["loss.ball_drag"] == pytest.approx(before["loss.ball_drag"], rel=0.01)
    assert without["loss.pockets"] > 1.5 * before["loss.pockets"] > after["loss.pockets"]
    oil_off.picture(result, 0.03, 0.05, tmp_path / "oil_off.png")
