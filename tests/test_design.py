"""Sensitivity and optimization: functions with known answers through the same code as the bearing, then the bearing."""

import json
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from commands import command

from riveted_bearing import UserError
from riveted_bearing.bearing.assumed import assumed_ranges
from riveted_bearing.cli.optimize import print_optimum
from riveted_bearing.design.bench import Bench
from riveted_bearing.design.optimize import plan_optimize, search, write_optimum
from riveted_bearing.design.optimize import write_picture as write_optimum_picture
from riveted_bearing.design.sensitivity import analyse, plan_sensitivity, read_indices, write_indices, write_picture
from riveted_bearing.running.responses import displayed, response, shown, titled
from riveted_bearing.running.scene import load_scene
from riveted_bearing.studies.sweep import cluster

ROOT = Path(__file__).resolve().parents[1]
NAMES = ["joint.mu", "oil.eta", "joint.preload"]  # any three with ranges; the functions below take them in [0, 1]
BOX = {"joint.mu": [0.1, 0.3], "oil.eta": [0.002, 0.01], "joint.preload": [5.0, 45.0]}


def in_place_of_the_bearing(function, noise=0.0, seed=1):
    """evaluate(names, points, responses, seeds) of a function of the unit cube, with normal noise for each seed."""
    rng = np.random.default_rng(seed)

    def evaluate(names, points, responses, seeds=(1, 2)):
        low, high = np.array([BOX[name] for name in names]).reshape(-1, 2).T
        unit = dict.fromkeys(NAMES, 0.5 * np.ones(len(points))) | dict(
            zip(names, ((np.asarray(points) - low) / (high - low)).T, strict=True)
        )
        values = np.array(function(*unit.values()), ndmin=2)  # [m, n]
        return values.T[:, None, :] + noise * rng.normal(size=(len(points), len(seeds), len(values)))

    return evaluate


def ishigami(a, b, c):
    """sin x + 7 sin^2 y + 0.1 z^4 sin x on [-pi, pi]^3."""
    x, y, z = (math.pi * (2.0 * u - 1.0) for u in (a, b, c))
    return np.sin(x) + 7.0 * np.sin(y) ** 2 + 0.1 * z**4 * np.sin(x)


def test_sobol_indices_of_ishigamis_function(model):
    """Ishigami and Homma (1990) in closed form: V1 = (1 + b pi^4/5)^2/2, V2 = a^2/8, V13 = b^2 pi^8 (1/18 - 1/50); a =
    7, b = 0.1.
    """
    V1, V2, V13 = 0.5 * (1 + 0.1 * math.pi**4 / 5) ** 2, 49 / 8, 0.01 * math.pi**8 * (1 / 18 - 1 / 50)
    V = V1 + V2 + V13
    document = {
        "between": BOX,
        "responses": ["damage"],
        "sobol": {"count": 4096, "factors": 3},
        "morris": {"trajectories": 20},
    }
    found = analyse(plan_sensitivity("s.toml", document, model), in_place_of_the_bearing(ishigami))
    S1, ST = (dict(zip(found.chosen, found.sobol["damage"][key], strict=True)) for key in ("S1", "ST"))
    expected = dict(zip(NAMES, (V1 / V, V2 / V, 0.0), strict=True))
    total = dict(zip(NAMES, ((V1 + V13) / V, V2 / V, V13 / V), strict=True))
    for name in NAMES:  # observed within 0.005 at 4096 points
        assert S1[name] == pytest.approx(expected[name], abs=0.015)
        assert ST[name] == pytest.approx(total[name], abs=0.015)


def test_elementary_effects_of_a_plane_are_its_slopes(model):
    """y = 5 a - 2 b: mu_star 5, 2, 0 and no scatter, exactly."""
    document = {"between": BOX, "responses": ["damage"], "sobol": {"factors": 0}}
    found = analyse(
        plan_sensitivity("s.toml", document, model), in_place_of_the_bearing(lambda a, b, c: 5 * a - 2 * b + 0 * c)
    )
    morris = found.morris["damage"]
    assert dict(zip(found.factors, morris["mu_star"], strict=True)) == pytest.approx(
        dict(zip(NAMES, (5, 2, 0), strict=True)), abs=1e-9
    )
    assert np.allclose(morris["sigma"], 0.0, atol=1e-9) and morris["noise"] == pytest.approx(0.0, abs=1e-12)


def test_noise_stands_beside_the_indices(model):
    """Nothing but seeds with variance 1, 2 of them: mu_star is 2 s/sqrt(pi)/delta with s^2 = 1/2, delta = 2/3; 40
    trajectories scatter by some 10 %.
    """
    document = {"between": BOX, "responses": ["damage"], "sobol": {"factors": 0}, "morris": {"trajectories": 40}}
    found = analyse(
        plan_sensitivity("s.toml", document, model), in_place_of_the_bearing(lambda a, b, c: 0 * a, noise=1.0)
    )
    expected = 2 * math.sqrt(0.5 / math.pi) / (2 / 3)
    assert found.morris["damage"]["noise"] == pytest.approx(expected, rel=0.15)
    assert np.mean(found.morris["damage"]["mu_star"]) == pytest.approx(expected, rel=0.2)


def test_indices_are_written_and_drawn(tmp_path, model):
    document = {"between": BOX, "responses": ["damage", "stress"], "sobol": {"count": 64, "factors": 2}}
    found = analyse(
        plan_sensitivity("s.toml", document, model),
        in_place_of_the_bearing(lambda a, b, c: [ishigami(a, b, c), a + b * c], noise=0.3),
    )
    assert json.loads(write_indices(found, tmp_path / "sensitivity.json").read_text())["chosen"] == list(found.chosen)
    again = read_indices(tmp_path)
    assert (again.morris, again.sobol, again.ranked) == (found.morris, found.sobol, found.ranked)
    assert again.ranked == [0, 1, 2]
    assert write_picture(found, tmp_path / "s.png").stat().st_size > 20000


def test_assumed_parameters_are_the_factors_unless_others_are_named(model):
    ranges = assumed_ranges(model)
    study = plan_sensitivity("s.toml", {}, model, ranges)
    assert study.box.names == list(ranges) and len(ranges) >= 3 and np.all(study.box.low < study.box.high)


def valley(a, b, c):
    """Least at (0.3, 0.6) with the value 0, whatever c is."""
    return (a - 0.3) ** 2 + 2.0 * (b - 0.6) ** 2 + 0.0 * c


def test_a_known_optimum_is_found_under_noise(model):
    """A search point's mean has a noise of 0.1/sqrt(2) = 0.07.  Over three searches the recommended points are on
    average far better than that (observed
    0.01 to 0.02), and better than the one that a grid of 8 x 8 points would choose by its noisy values.
    """
    two = {name: BOX[name] for name in NAMES[:2]}
    found, grid = [], []
    for seed in (1, 2, 3):
        evaluate = in_place_of_the_bearing(valley, noise=0.1, seed=seed)
        document = {"between": two, "objectives": ["damage"], "trials": 60, "check_seeds": 8, "seed": seed}
        optimum = search(plan_optimize("o.toml", document, model), evaluate)
        value = valley(*unit(optimum.points[optimum.candidates[optimum.best]]), 0.0)
        # fresh seeds: without the luck of the search
        assert abs(optimum.means[optimum.best, 0] - value) < 4 * 0.1 / math.sqrt(8)
        found.append(value)
        a, b = (x.ravel() for x in np.meshgrid(*[(np.arange(8) + 0.5) / 8] * 2))
        points = np.column_stack(
            [BOX[name][0] + x * (BOX[name][1] - BOX[name][0]) for name, x in zip(NAMES, (a, b), strict=False)]
        )
        grid.append(valley(*unit(points[evaluate(NAMES[:2], points, ["damage"]).mean(axis=1)[:, 0].argmin()]), 0.0))
    assert np.mean(found) < 0.03 and np.mean(found) < np.mean(grid)


def unit(point):
    """A point of the first two names in [0, 1]."""
    return [(x - BOX[name][0]) / (BOX[name][1] - BOX[name][0]) for name, x in zip(NAMES, point, strict=False)]


def test_a_limit_is_kept_and_its_optimum_lies_on_it(model):
    """Least of a + b with a b >= 0.25, that is -ab <= -0.25: a = b = 0.5."""
    document = {
        "between": {name: BOX[name] for name in NAMES[:2]},
        "objectives": ["damage"],
        "limits": {"dislocation": -0.25},
        "trials": 80,
        "candidates": 3,
    }
    found = search(plan_optimize("o.toml", document, model), in_place_of_the_bearing(lambda a, b, c: [a + b, -a * b]))
    assert found.means[found.best, 1] <= -0.25 and found.means[found.best, 0] == pytest.approx(1.0, abs=0.12)


def test_two_objectives_give_a_front(tmp_path, model):
    """a^2 and (1 - a)^2: every a is on the front as long as b = 0 is not worse; the recommended one is in the middle."""
    document = {
        "between": {name: BOX[name] for name in NAMES[:2]},
        "objectives": ["damage", "friction"],
        "trials": 60,
        "candidates": 4,
    }
    found = search(
        plan_optimize("o.toml", document, model),
        in_place_of_the_bearing(lambda a, b, c: [a**2 + 0.2 * b, (1 - a) ** 2 + 0.2 * b]),
    )
    a = (found.points[found.candidates[found.best], 0] - 0.1) / 0.2
    assert 0.25 < a < 0.75
    answer = json.loads(write_optimum(found, tmp_path / "o.json").read_text())
    assert answer["recommended"]["at"]["joint.mu"] == found.points[found.candidates[found.best], 0]
    assert len(answer["candidates"]) == 4
    assert write_optimum_picture(found, tmp_path / "o.png").stat().st_size > 15000
    assert answer["criterion"].startswith("the point simulated again nearest to the least damage and least friction")
    assert answer["present"]["mean"] == pytest.approx({"damage": 0.35, "friction": 0.35})  # the middle of the box


def test_the_program_says_why_a_point_is_recommended(model, capsys):
    """The criterion with its limits, and the present design, with the values of the scene, as a row of the table."""
    two = {name: BOX[name] for name in NAMES[:2]}
    document = {"between": two, "objectives": ["-damage"], "limits": {"stress": "1 MPa"}, "trials": 10, "candidates": 2}
    found = search(plan_optimize("o.toml", document, model), in_place_of_the_bearing(lambda a, b, c: [a, 0.0 * a]))
    names = found.study.box.names
    print_optimum(found, [load_scene(None, model).value(name, model) for name in names])
    text = capsys.readouterr().out
    assert "recommended: the point simulated again with the largest damage, of those that keep stress <= 1 MPa" in text
    row = next(line for line in text.splitlines() if line.startswith("present design"))
    assert row.split()[2] == f"{displayed(names[0], model.default(model.parameters[names[0]])):.4g}"
    assert "0.5 ± 0" in row


def test_a_search_repeats_itself(model):
    document = {"between": BOX, "objectives": ["damage"], "trials": 24, "candidates": 2}
    one, two = (
        search(plan_optimize("o.toml", document, model), in_place_of_the_bearing(valley, noise=0.1)) for _ in range(2)
    )
    np.testing.assert_array_equal(one.points, two.points)


def test_what_no_point_can_keep_is_said(model):
    document = {"between": BOX, "objectives": ["damage"], "limits": {"stress": "1 MPa"}, "trials": 8}
    with pytest.raises(UserError, match="none of 8 points keeps the limits"):
        search(plan_optimize("o.toml", document, model), in_place_of_the_bearing(lambda a, b, c: [a, 2e6 + 0 * a]))


def test_a_response_that_does_not_exist_is_refused():
    with pytest.raises(UserError, match='unknown response "stres"; did you mean "stress"'):
        response("study.toml", {"stat.sigma_head_p999": np.ones(2)}, "stres")


@pytest.mark.parametrize("kind", ["sensitivity", "optimize"])
def test_a_response_that_does_not_exist_is_refused_before_a_run(tmp_path, kind):
    """One line, and no folder is left."""
    key = {"sensitivity": "responses", "optimize": "objectives"}[kind]
    (tmp_path / "study.toml").write_text(f'{key} = ["stres"]\n[between]\njoint.mu = [0.1, 0.3]\n')
    refused = command(kind, "study.toml", folder=tmp_path)
    assert refused.returncode == 2
    assert refused.stderr == 'error: study.toml: unknown response "stres"; did you mean "stress"?\n'
    assert [path.name for path in tmp_path.iterdir()] == ["study.toml"]


def test_values_are_shown_in_units_that_people_use():
    """SI inside; printed and drawn as the variable table displays them, a temperature with its offset."""
    values = {
        "joint.fit": (-3e-6, "-3 um"),
        "stress": (3.1e8, "310 MPa"),
        "damage": (-7.0, "-7 log10 per hour"),
        "ball.T": (293.15, "20 degC"),
    }
    values |= {
        "max(cage.dislocation)": (2e-6, "2 um"),
        "rivet[3].sigma_head": (2e8, "200 MPa"),
        "shaft.omega": (100.0 * math.pi, "3000 rev/min"),
    }
    values |= {"joint.mu": (0.2, "0.2"), "wall_time": (2.0, "2"), "mean(bearing.friction_torque)": (0.1, "0.1 N.m")}
    assert {name: shown(name, value) for name, (value, _) in values.items()} == {
        name: text for name, (_, text) in values.items()
    }
    assert titled("joint.fit") == "joint.fit [um]" and titled("joint.mu") == "joint.mu"


def test_the_bench_simulates_what_it_is_asked_and_nothing_twice(tmp_path, model, monkeypatch):
    """Two points, two seeds: responses are those of rows read again; a third point later keeps the first ones."""
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    document = {"simulation": {"t_end": 4e-3}, "parameters": {"start.settle": 1e-3, "cage.centrifugal": "off"}}
    with cluster(workers=1) as client:
        bench = Bench(tmp_path / "b.toml", document, model, tmp_path / "out", lambda: client)
        first = bench(["joint.preload"], [[10.0], [60.0]], ["damage", "stress"])
        more = bench(["joint.preload"], [[20.0]], ["stress"], seeds=[7])
    assert first.shape == (2, 2, 2) and more.shape == (1, 1, 1) and np.isfinite(first).all()
    assert np.all(first[1, :, 1] > 1.5 * first[0, :, 1])  # six times the preload, and impacts

    def no_cluster():
        raise AssertionError("nothing is to be simulated")

    again = Bench(tmp_path / "b.toml", document, model, tmp_path / "out", no_cluster)(
        ["joint.preload"], [[10.0], [60.0]], ["damage", "stress"]
    )
    np.testing.assert_array_equal(again, first)


@pytest.mark.parametrize(
    ("kind", "key", "library"), [("sensitivity", "responses", "SALib"), ("optimize", "objectives", "optuna")]
)
def test_a_missing_library_is_named_and_leaves_nothing(tmp_path, kind, key, library):
    (tmp_path / "study.toml").write_text(f'{key} = ["stress"]\n[between]\njoint.mu = [0.1, 0.3]\n')
    without = f"import sys; sys.modules[{library!r}] = None; sys.argv = ['', {kind!r}, 'study.toml']; from riveted_bearing.__main__ import main; main()"
    refused = subprocess.run([sys.executable, "-c", without], cwd=tmp_path, capture_output=True, text=True)
    assert refused.returncode == 2 and refused.stderr.startswith(f"error: {kind}: needs the library")
    assert refused.stderr.count("\n") == 1
    assert [path.name for path in tmp_path.iterdir()] == ["study.toml"]
