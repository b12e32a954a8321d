"""Sweeps: designs, and runs on a real Dask cluster whose workers and driver are killed in the middle."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import cloudpickle
import numpy as np
import pytest
from commands import begun, command, finished, rows_kept

from riveted_bearing import run
from riveted_bearing.studies import sweep as engine
from riveted_bearing.studies.rows import Store, columns_of
from riveted_bearing.studies.sweep import cluster, outcome, run_sweep
from riveted_bearing.studies.sweep_file import load_sweep
from riveted_bearing.studies.sweep_table import lines, sweep_table, write_page, write_picture

ROOT = Path(__file__).resolve().parents[1]
SHORT = '[simulation]\nt_end = 2e-3\n[parameters]\nstart.settle = "0.5 ms"\n'  # 4 ms of processor time a run
LONGER = SHORT.replace("2e-3", "0.1")  # 0.1 s a run: there is a middle to be killed in


def plan(folder, model, text):
    """The Sweep of a file with this content."""
    path = folder / "study.toml"
    path.write_text(text)
    return load_sweep(path, model)


def settings(sweep, *names):
    """What the runs of a sweep set, in their order."""
    values = [
        scene.parameters | {name: float(history(0.0)) for name, history in scene.inputs.items()}
        for scene in sweep.scenes.values()
    ]
    return [tuple(value[name] for name in names) for value in values]


def test_axes_are_crossed_and_entries_of_a_block_go_together(tmp_path, model):
    sweep = plan(
        tmp_path,
        model,
        """
        repeats = 2
        [[vary]]
        joint.preload = ["10 N", 20]
        joint.fit = ["-20 um", "-10 um"]
        [[vary]]
        shaft.omega = { from = "3000 rev/min", to = "12000 rev/min", count = 3, spacing = "log" }
        """,
    )
    assert sweep.factors == ("start.seed", "joint.preload", "joint.fit", "shaft.omega")
    got = settings(sweep, *sweep.factors)
    want = [
        (seed, P, fit, n * np.pi / 30)
        for seed in (1, 2)
        for P, fit in ((10, -2e-5), (20, -1e-5))
        for n in (3000, 6000, 12000)
    ]
    np.testing.assert_allclose(got, want, rtol=1e-14)


def test_scenes_and_their_horizon_vary(tmp_path, model):
    (tmp_path / "own.toml").write_text("[parameters]\njoint.mu = 0.2")
    sweep = plan(tmp_path, model, '[[vary]]\nscene = ["R", "own.toml"]\n[[vary]]\nsimulation.t_end = ["10 ms", 0.02]')
    assert [(scene.name, scene.t_end) for scene in sweep.scenes.values()] == [
        ("R", 0.01),
        ("R", 0.02),
        ("own", 0.01),
        ("own", 0.02),
    ]


def test_a_latin_hypercube_hits_each_stratum_once(tmp_path, model):
    text = '[sample]\nmethod = "latin_hypercube"\ncount = 10\nbetween.joint.preload = ["10 N", "30 N"]\nbetween.shaft.F_x = [100, 200]'
    P, F = np.transpose(settings(plan(tmp_path, model, text), "joint.preload", "shaft.F_x"))
    assert sorted((P - 10) // 2) == sorted((F - 100) // 10) == list(range(10))  # its definition
    assert not np.array_equal(np.argsort(P), np.argsort(F))


def test_a_sobol_sequence_is_balanced_in_both_halves_of_each_axis(tmp_path, model):
    text = '[sample]\nmethod = "sobol"\ncount = 16\nbetween.joint.mu = [0.1, 0.3]\nbetween.oil.eta = ["2 mPa.s", "10 mPa.s"]'
    points = np.array(settings(plan(tmp_path, model, text), "joint.mu", "oil.eta"))
    upper = points > [0.2, 6e-3]
    assert upper.sum(axis=0).tolist() == [8, 8] and np.logical_and(*upper.T).sum() == 4


def test_a_row_is_what_a_single_run_gives(tmp_path, model, client):
    sweep = plan(tmp_path, model, SHORT + "[[vary]]\njoint.preload = [10, 30]")
    rows = run_sweep(sweep, tmp_path / "out", client)
    single = run(t_end=2e-3, parameters={"start.settle": 5e-4, "joint.preload": 30.0})
    assert rows["run"].tolist() == [0, 1] and rows["joint.preload"].tolist() == [10.0, 30.0]
    assert set(rows["status"]) == {"done"}
    for name, value in single.summary.items():  # the same steps: the same bits, but for the clocks
        if "time" not in name:
            assert rows[name][1] == value, name
    late = single.data["time"] >= 5e-4
    assert rows["mean(cage.dislocation)"][1] == single.data["cage.dislocation"][late].mean()
    assert all(rows[name][1] == value for name, value in single.parameters.items() if isinstance(value, str))
    assert rows["shaft.F_y"].tolist() == [2994.0, 2994.0] and rows["cpu_time"].min() > 0.0


def test_other_programs_can_read_the_dataset(tmp_path, model, client):
    from pyarrow import dataset

    run_sweep(
        plan(tmp_path, model, 'description = "two"\n' + SHORT + "[[vary]]\njoint.preload = [10, 30]"),
        tmp_path / "out",
        client,
    )
    table = dataset.dataset(tmp_path / "out").to_table()
    assert table.num_rows == 2 and table.schema.field("joint.fit").metadata[b"unit"] == b"m"
    about = json.loads(table.schema.metadata[b"riveted_bearing"])
    assert about["basis"]["loads"] == "F_x 515 N, F_y 2994 N"
    assert about["basis"]["scene"] == "none: the FMU's own parameters and inputs"
    assert about["description"] == "two" and about["factors"] == ["joint.preload"]
    assert about["document"]["vary"] == [{"joint": {"preload": [10, 30]}}]


def test_failures_are_rows_and_are_tried_again(tmp_path, model, client):
    """A bearing that cannot be, and a work limit that ends the run in its first communication step."""
    text = SHORT + "[[vary]]\nbearing.D = [0.0111125, 0.019, 0.0111125]\nsolver.max_steps = [1000, 1000, 10]"
    seen = []
    first = run_sweep(plan(tmp_path, model, text), tmp_path / "out", client, lambda *numbers: seen.append(numbers))
    assert first["status"].tolist() == ["done", "failed", "stopped"] and seen[0] == (0, 0, 3) and seen[-1] == (1, 2, 3)
    assert "refuses to start" in first["message"][1] and "10 steps" in first["message"][2] and first["message"][0] == ""
    assert np.isnan(first["stat.Q_c_mean"][1]) and first["bearing.D"][1] == 0.019
    second = run_sweep(plan(tmp_path, model, text), tmp_path / "out", client)
    assert (second["date"] == first["date"]).tolist() == [True, False, False]
    assert second["status"].tolist() == first["status"].tolist()


def test_a_lost_run_has_a_reason(client):
    future = client.submit(int, "no number", pure=False)
    future.exception()
    row = outcome(future)
    assert row["status"] == "failed" and "ValueError" in row["message"]


def test_a_changed_design_keeps_what_still_belongs(tmp_path, model, client):
    first = run_sweep(plan(tmp_path, model, SHORT + "[[vary]]\njoint.preload = [10, 30]"), tmp_path / "out", client)
    second = run_sweep(
        plan(tmp_path, model, SHORT + "[[vary]]\njoint.preload = [40, 30, 50]"), tmp_path / "out", client
    )
    assert second["joint.preload"].tolist() == [40.0, 30.0, 50.0] and second["run"].tolist() == [0, 1, 2]
    assert second["date"][1] == first["date"][1]
    third = run_sweep(plan(tmp_path, model, SHORT + "[[vary]]\njoint.preload = [60]"), tmp_path / "out", client)
    assert third["joint.preload"].tolist() == [60.0]
    again = run_sweep(plan(tmp_path, model, SHORT + "[[vary]]\njoint.preload = [10]"), tmp_path / "out", client)
    assert again["date"][0] == first["date"][0]  # 10 N is not lost


def test_killed_workers_cost_only_time(tmp_path, model, client):
    """Both workers are killed in the middle of a run; every run counts once, and is the run of an undisturbed sweep."""
    sweep, killed = plan(tmp_path, model, "repeats = 8\n" + LONGER), []

    def kill_once(done, failed, total):
        if done == 2 and not killed:
            killed.extend(client.run(os.getpid).values())
            for pid in killed:
                os.kill(pid, signal.SIGKILL)

    rows = run_sweep(sweep, tmp_path / "out", client, kill_once)
    assert len(killed) == 2 and not set(killed) & set(client.run(os.getpid).values())
    assert rows["start.seed"].tolist() == [1, 2, 3, 4, 5, 6, 7, 8] and len(set(rows["key"])) == 8
    assert set(rows["status"]) == {"done"}
    assert {path.name for path in (tmp_path / "out").iterdir()} == {"_rows.sqlite", "runs.parquet"}
    with cluster(address=client.scheduler.address) as other:  # the same scheduler, as `--scheduler` finds it
        calm = run_sweep(sweep, tmp_path / "calm", other)
    assert calm["stat.Q_c_rms"].tolist() == rows["stat.Q_c_rms"].tolist()


def deadly(scene, fmu):
    """engine.perform, but for a run that ends its worker like one that takes all memory."""
    if scene.parameters["joint.preload"] == 13.0:
        os.kill(os.getpid(), signal.SIGKILL)
    return engine.perform(scene, fmu)


@pytest.mark.slow
def test_a_run_that_kills_every_worker_becomes_a_failed_row(tmp_path, model, client, monkeypatch):
    """Dask gives up after four workers; the other runs are done, then or in the next call.  Half a minute, most of it
    new workers.
    """
    cloudpickle.register_pickle_by_value(sys.modules[__name__])  # the workers cannot import the tests
    harmless = engine.perform
    monkeypatch.setattr(engine, "perform", deadly)
    rows = run_sweep(
        plan(tmp_path, model, SHORT + "[[vary]]\njoint.preload = [10, 13, 20, 30]"), tmp_path / "out", client
    )
    assert rows["status"][1] == "failed" and "KilledWorker" in rows["message"][1]
    monkeypatch.setattr(engine, "perform", harmless)
    again = run_sweep(
        plan(tmp_path, model, SHORT + "[[vary]]\njoint.preload = [10, 13, 20, 30]"), tmp_path / "out", client
    )
    assert set(again["status"]) == {"done"}


def test_a_killed_driver_leaves_what_is_done(tmp_path, model, client):
    study, out = tmp_path / "study.toml", tmp_path / "out"
    study.write_text("repeats = 24\n" + LONGER)
    driver = subprocess.Popen(
        [sys.executable, "-m", "riveted_bearing", "sweep", study, "--out", out, "--workers", "1"],
        env=os.environ | {"PYTHONPATH": str(ROOT)},
    )
    patience = time.monotonic() + 120
    while not rows_kept(out) and time.monotonic() < patience:
        time.sleep(0.02)
    driver.kill()
    driver.wait()
    assert not (out / "runs.parquet").exists()  # it was the middle
    with Store(out) as store:
        before = store.done()
    assert 1 <= len(before) < 24
    counts = []
    rows = run_sweep(load_sweep(study, model), out, client, lambda done, failed, total: counts.append(done))
    assert counts == list(range(len(before), 25)) and rows["start.seed"].tolist() == list(range(1, 25))
    assert len(set(rows["key"])) == 24
    assert columns_of(out)["key"].tolist() == rows["key"].tolist() and before < set(rows["key"])


def test_the_command_shows_failures_and_says_where_the_rows_are(tmp_path):
    study = tmp_path / "mine.toml"
    study.write_text(SHORT + "[[vary]]\nbearing.D = [0.0111125, 0.019]")
    out, err, code = finished(begun("sweep", study, "--workers", "1", folder=tmp_path))
    assert code == 3 and "2 runs, 1 of them failed" in out and "refuses to start" in err and "Traceback" not in err
    assert (tmp_path / "results" / "mine" / "runs.parquet").is_file() and "results/mine" in out


def test_a_sweep_ends_with_a_table_a_picture_and_a_page(tmp_path, model, client):
    """Means and intervals by hand from the rows: Student's t with two degrees of freedom, 4.3027."""
    sweep = plan(
        tmp_path,
        model,
        "repeats = 3\n" + SHORT + '[[vary]]\njoint.preload = [10, 30]\n[[vary]]\nscene.stress = ["fatigue"]',
    )
    rows = run_sweep(sweep, tmp_path / "out", client)
    table = sweep_table(sweep, rows)
    assert table.factors == ("joint.preload [N]", "scene.stress")
    assert table.points == [(10.0, "fatigue"), (30.0, "fatigue")] and table.seeds.tolist() == [3, 3]
    stress = rows["stat.sigma_head_p999"][rows["joint.preload"] == 30.0] / 1e6
    first = table.responses[0]
    assert first.mean[1] == pytest.approx(stress.mean(), rel=1e-12)
    assert first.half[1] == pytest.approx(4.302653 * stress.std(ddof=1) / np.sqrt(3), rel=1e-6, abs=1e-12)
    heads, cells = lines(table)
    assert heads[:3] == ["joint.preload [N]", "scene.stress", "seeds"] and len(cells) == 2
    assert "log10 damage per hour" in heads
    assert write_picture(table, tmp_path / "sweep.png").stat().st_size > 20000
    page = write_page(table, "<mine>", tmp_path / "sweep.html").read_text()
    assert "&lt;mine&gt;" in page and page.count("<svg") == len(table.responses) and cells[1][3] in page


def test_runs_that_end_at_settling_have_no_statistics(tmp_path, fmu):
    """The FMU's own statistics are then those of one step: mean and quantile of nothing."""
    path = tmp_path / "early.toml"
    path.write_text(
        '[simulation]\nt_end = 2e-3\n[parameters]\nstart.settle = 2e-3\n[[vary]]\njoint.preload = ["20 N"]\n'
    )
    done = command("sweep", str(path), "--fmu", fmu, folder=tmp_path)
    assert done.returncode == 0 and "1 runs have no statistics" in done.stdout + done.stderr
    rows = columns_of(tmp_path / "results" / "early")
    assert np.isnan(rows["stat.sigma_head_p999"]).all() and np.isfinite(rows["solver.steps"]).all()
