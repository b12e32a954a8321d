"""The C core and the Python reference on a second bearing: the 6310, eight balls, its own variables, core and rivet
table.
"""

import os
import subprocess
import sys
from pathlib import Path

import fmpy
import numpy as np
import pytest
from library import ROOT
from slave import OK, Slave

from bearing_model.rivet.rivet_table import read
from riveted_bearing import build, run
from riveted_bearing.building.builder import build_folder

H = 1e-4  # communication step [s]
TESTS = "derivatives or jacobian or start or outputs or power_is_rate"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("Z", "sizes"),
    [
        (16, "bearing.D = 6.35e-3\nbearing.d_m = 0.0535"),
        (32, "bearing.D = 5.5e-3\nbearing.d_m = 0.08\ncage.D_o = 0.0836\ncage.D_i = 0.0772"),
    ],
)
def test_elastic_halves_of_many_balls(tmp_path, Z, sizes):
    """Elastic halves with as many modes a ball as the 6207: 10 ms at its speed, as many steps as rigid halves take to a
    factor of 3, mean tension to 10 %.
    """
    path = tmp_path / f"{Z}.toml"
    path.write_text(f'designation = "{Z} balls"\nZ = {Z}\n[parameters]\n{sizes}\ncage.pocket_clearance = 1e-4\n')
    fmu = build(str(path), out=tmp_path / f"{Z}.fmu")
    runs = []
    for cage in ("elastic", "two_half"):
        found = run(
            "demo",
            fmu=fmu,
            t_end=0.01,
            inputs={"shaft.F_y": 500.0, "shaft.F_x": 100.0},
            parameters={"scene.cage": cage, "start.settle": 0.002},
        )
        runs.append(
            [found.summary["solver.rhs_evals"], max(found.data[f"rivet[{k}].T"][20:].mean() for k in range(1, Z + 1))]
        )
        if cage == "elastic":  # by the FMU's own table, pairs named once
            table, named = read(build_folder(ROOT, str(path)) / "rivet_table.json", Z), found.about["mode_frequencies"]
            heavier = found.parameters["cage.m"] / table.half.m
            assert len(named) > Z and named == pytest.approx(table.modes.omega / 2 / np.pi / heavier**0.5)
    (evaluations, tension), (evaluations_rigid, tension_rigid) = runs
    assert evaluations < 3.0 * evaluations_rigid
    assert tension == pytest.approx(tension_rigid, rel=0.1)


@pytest.mark.slow
def test_joints_of_a_large_bearing_open_alike(tmp_path):
    """A 110-mm bearing at rest under the centrifugal load of 4,000 to 12,000 r/min, which makes the rivets' tension up
    to seven times the preload.

    Elastic halves have the tension of the static load path, 1 % (observed -0.6, +0.4, -0.3 %), and M to 0.1 % (0.05 %).
    The modes leave so stiff a half that a law which gives the move makes the load a small difference of large numbers:
    it erred by 3.3 %, with half the knots by a factor of two.
    """
    fmu = build(str(ROOT / "benchmarks" / "bearings" / "110mm.toml"), out=tmp_path / "110.fmu")
    for speed in (4000.0, 8000.0, 12000.0):
        rests = []
        for cage in ("elastic", "two_half"):
            inputs = {"shaft.omega": speed * np.pi / 30.0}
            data = run(
                "demo",
                fmu=fmu,
                t_end=1e-4,
                step=1e-4,
                inputs=inputs,
                parameters={"scene.cage": cage},
                outputs=["rivet[*].T", "rivet[*].M"],
            ).data
            rests.append([np.mean([data[f"rivet[{k}].{name}"][0] for k in range(1, 14)]) for name in ("T", "M")])
        (tension, moment), (tension_path, moment_path) = rests
        assert tension == pytest.approx(tension_path, rel=0.01)
        assert moment == pytest.approx(moment_path, rel=1e-3)


@pytest.mark.slow
def test_a_state_of_modes_that_fill_no_packet_goes_on(tmp_path):
    """The 6310 has 36 coordinates in room for 48.  Restored states go on with the same bits, the whole state
    compared, whatever the instance did before; coordinates beyond the modes are written too.
    """
    folder = Path(fmpy.extract(str(build("6310", out=tmp_path / "6310.fmu")), str(tmp_path / "fmu")))
    modes = read(build_folder(ROOT, "6310") / "rivet_table.json", 8).modes
    assert modes.count.sum() % 8 != 0 and modes.count.sum() < modes.room
    slave = Slave(folder).initialize().step(H, 7)
    other = Slave(folder).initialize(shaft__omega=900.0, shaft__F_y=8000.0, joint__preload=50.0).step(H, 11)
    for _ in range(5):
        slave.step(H, 3)
        state, time = slave.save(), slave.time
        status, loaded = other.try_load(slave.bytes(state))
        assert status == OK, other.messages
        ends = [slave.step(H, 5).bytes(slave.save())]
        ends.append(other.restore(loaded, time).step(H, 5).bytes(other.save()))
        fresh = Slave(folder)
        ends.append(fresh.restore(fresh.try_load(slave.bytes(state))[1], time).step(H, 5).bytes(fresh.save()))
        assert ends[0] == ends[1] == ends[2]


@pytest.mark.slow
def test_6310(tmp_path):
    """dy/dt at 1200 states, Jacobian, start and outputs of both twins: the tests of test_twin.py with their tolerances."""
    build("6310", out=tmp_path / "6310.fmu", table="closed-form")
    folder = build_folder(ROOT, "6310")
    compared = subprocess.run(
        [sys.executable, "-m", "riveted_bearing", "compare", "--fmu", tmp_path / "6310.fmu", "--short", "20 us"]
        + ["--long", "0", "--set", "scene.cage=two_half", "--out", tmp_path],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert compared.returncode == 0 and "6310: " in compared.stdout, compared.stderr
    worst = [line.split() for line in compared.stdout.splitlines() if line.startswith("rivet[k].sigma_head ")]
    assert float(worst[0][-1]) < 1e-3  # at the tightest tolerance: the same rivet table
    subprocess.run(
        [sys.executable, "-m", "cmake", "--build", folder, "--target", "bearing_test"], check=True, capture_output=True
    )
    command = [sys.executable, "-m", "pytest", "-q", "-rP", "-p", "no:cacheprovider", "tests/test_twin.py", "-k", TESTS]
    done = subprocess.run(
        command, cwd=ROOT, env=os.environ | {"BEARING_BUILD": str(folder)}, capture_output=True, text=True, check=False
    )
    print(done.stdout)
    assert done.returncode == 0, done.stdout
    assert " passed" in done.stdout
