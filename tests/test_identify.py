"""Parameters from measurements: closed forms of the measures, a cheap rig with a known truth through the same code as
the bearing, the bearing itself, and what is refused.
"""

import json
import math
import re
import subprocess
import sys
import tomllib

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from commands import command
from library import ROOT
from scipy.stats import binom

from riveted_bearing import UserError
from riveted_bearing.base.toml_files import read_toml
from riveted_bearing.identify.answer import write_answer, write_page
from riveted_bearing.identify.fit import FRESH, identify, prediction
from riveted_bearing.identify.measures import Measure, amplitude_between
from riveted_bearing.identify.rig import Rig, figure_of
from riveted_bearing.identify.study import Parameter, plan_identify
from riveted_bearing.identify.surrogate import Surrogate, noise_parts, pruned
from riveted_bearing.running.scene import load_scene
from riveted_bearing.studies.sweep import cluster

sys.path.insert(0, str(ROOT / "examples" / "identify"))
import synthetic

TRUTH = np.array([5e-3, 0.22e-3, 0.2])
NAMES = ["oil.eta", "cage.guide_clearance", "joint.mu"]
RANGES = {"oil.eta": ["2 mPa.s", "20 mPa.s"], "cage.guide_clearance": ["0.1 mm", "0.4 mm"], "joint.mu": [0.1, 0.3]}
SHARE = 0.03  # uncertainty of the cheap rig's figures, and scatter of its seeds


# Measures -------------------------------------------------------------------------------------------------------------


def test_a_line_of_a_sine_is_its_rms_amplitude():
    """A sin(2 pi f t) beside another sine outside the band: A/sqrt(2); Hann's window leaks less than 1 %."""
    t = np.arange(2000) * 1e-4
    values = 3.0 * np.sin(2 * np.pi * 1250.0 * t) + 5.0 * np.sin(2 * np.pi * 400.0 * t) + 7.0
    assert amplitude_between(t, values, 1200.0, 1300.0) == pytest.approx(3.0 / math.sqrt(2.0), rel=0.01)
    assert Measure("band", "x", 1200.0, 1300.0)(t, values) == pytest.approx(math.log10(3.0 / math.sqrt(2.0)), abs=0.005)
    assert amplitude_between(t, values, 2000.0, 2200.0) < 0.01


def test_bands_of_white_noise_share_its_variance():
    """Variance s^2 is spread evenly over 0 ... half the rate: sqrt of the band's share; 2 % by 50,000 samples."""
    t, values = np.arange(50_000) * 1e-4, np.random.default_rng(1).normal(size=50_000)
    assert amplitude_between(t, values, 1000.0, 2000.0) == pytest.approx(math.sqrt(1000.0 / 5000.0), rel=0.02)


def test_a_series_too_short_or_uneven_has_no_line():
    t = np.arange(100) * 1e-4  # 10 ms
    assert math.isnan(amplitude_between(t, np.sin(t), 200.0, 300.0))
    assert math.isnan(amplitude_between(t[::1] ** 1.5, np.sin(t), 2000.0, 3000.0))
    assert math.isnan(amplitude_between(np.arange(2000) * 1e-4, np.ones(2000), 4000.0, 6000.0))


# Surrogate ------------------------------------------------------------------------------------------------------------


def test_noise_of_seeds_is_split_into_own_and_common():
    """Values = point + seed + own noise: the variances of a point's mean are s_own^2/S and s_seed^2/S."""
    rng, S = np.random.default_rng(2), 40
    values = rng.normal(size=(60, 1)) * 5.0 + 0.7 * rng.normal(size=(1, S)) + 0.3 * rng.normal(size=(60, S))
    own, common = noise_parts(values)
    assert own == pytest.approx(0.09 / S, rel=0.1) and common == pytest.approx(0.49 / S, rel=0.5)


def test_a_surrogate_finds_a_smooth_function_and_its_own_error():
    """A smooth function of two of three variables with noise: the error is as large as the surrogate says, and well
    below that of a single point's mean.
    """
    rng = np.random.default_rng(3)
    f = lambda u: 10.0 + 3.0 * np.sin(3.0 * u[:, 0]) + 2.0 * u[:, 1] ** 2
    u, other = rng.random((60, 3)), rng.random((400, 3))
    surrogate = Surrogate(u, f(u)[:, None] + 0.2 * rng.normal(size=(60, 2)))
    mean, variance = surrogate(other)
    z = (mean - f(other)) / np.sqrt(variance)
    assert 0.4 < np.sqrt(np.mean(z**2)) < 1.6  # observed 0.8
    assert np.sqrt(np.mean((mean - f(other)) ** 2)) < 0.8 * 0.2 / math.sqrt(2)
    assert surrogate.lengths[2] > 2.0  # the third variable has no influence


def test_parameters_without_influence_are_left_out():
    """A strong variable and one whose effect is twice the noise of a point's mean (0.14) stay; an idle one goes, but for
    the half per cent of chance.
    """
    rng, kept = np.random.default_rng(7), []
    for _ in range(12):
        u = rng.random((40, 3))
        y = 3.0 * u[:, 0] + 0.3 * u[:, 1]
        kept.append(pruned(u, y[:, None] + 0.2 * rng.normal(size=(40, 2))).active)
    count = np.sum(kept, axis=0)
    assert count[0] == 12 and count[1] >= 8 and count[2] <= 1


def test_gradient_of_the_likelihood():
    """Against central differences, with one seed (noise unknown) and with two."""
    rng = np.random.default_rng(4)
    u = rng.random((12, 2))
    for seeds in (1, 2):
        surrogate = Surrogate(u, rng.normal(size=(12, seeds)))
        if seeds == 1:
            surrogate.noise = np.nan
        x = np.array([-0.3, 0.4, 0.2] + [-2.0] * (seeds == 1))
        _, gradient = surrogate.cost(x)
        for k in range(len(x)):
            step = np.eye(len(x))[k] * 1e-5
            slope = (surrogate.cost(x + step)[0] - surrogate.cost(x - step)[0]) / 2e-5
            assert gradient[k] == pytest.approx(slope, rel=1e-5, abs=1e-6)


# The fit on a cheap rig -----------------------------------------------------------------------------------------------


def cheap_rig(values):
    """Nine figures of viscosity and clearance, none of the joints' friction."""
    e, c = np.asarray(values, float).T[0] / 5e-3, np.asarray(values, float).T[1] / 0.2e-3
    found = []
    for w in (1.0, 2.0, 3.0):
        found += [
            10.0 * e**0.6 * w**0.7 + 4.0 * e * w / c,
            5.0 * w * c**0.5 + 0.5 * w * e,
            3.0 * np.exp(-0.5 * c * w) * (1.0 + e),
        ]
    return np.column_stack(found)


def document_of(data, seed=1, **changes):
    size = cheap_rig(TRUTH[None])[0]
    targets = [
        {"measure": "friction", "value": float(value), "uncertainty": float(SHARE * one)}
        for value, one in zip(data, size, strict=True)
    ]
    settings = {"seeds": 2, "check_seeds": 4, "screen": {"count": 24}, "search": {"rounds": 2, "points": 8}}
    return {"seed": seed, "parameter": RANGES, "target": targets} | settings | changes


def cheap(number, model, bias=None, **changes):
    """The Found of a repeat with noise and seeds of its own."""
    rng, size = np.random.default_rng(1000 + number), cheap_rig(TRUTH[None])[0]
    data = size * (1.0 + SHARE * rng.normal(size=9)) * (1.0 if bias is None else bias)
    study = plan_identify("rig.toml", document_of(data, 1 + 10 * number, **changes), model)

    def evaluate(points, seeds):
        return cheap_rig(points)[:, None, :] + SHARE * size * rng.normal(size=(len(points), len(seeds), 9))

    return identify(study, evaluate, 1.2 * TRUTH)


def proven(found, truth, names, undecided):
    """The issue's own conditions on repeats: truth inside the interval as often as chance has it, width at most 1.5
    times that of the estimates' scatter (3.92 standard deviations), the idle parameter undecided in all.
    """
    n = len(found)
    for name, true in zip(names, truth, strict=True):
        all_of = [one.intervals[name] for one in found]
        inside = sum(one.low <= true <= one.high for one in all_of)
        assert inside >= binom.ppf(0.005, n, 0.95), f"{name}: {inside} of {n}"
        if name == undecided:
            assert all(one.decided == "no" for one in all_of)
            continue
        scatter = 3.92 * np.std([one.value for one in all_of], ddof=1)
        assert np.mean([one.high - one.low for one in all_of]) <= 1.5 * scatter, name
        assert all(one.decided == "both" for one in all_of), name


def test_the_truth_of_a_cheap_rig_lies_in_the_intervals(model):
    """A few repeats of the code that the slow tests repeat 60 and 20 times."""
    found = [cheap(number, model) for number in range(4)]
    for one in found:
        for name, true, own in zip(NAMES[:2], TRUTH, (0.1, 0.15), strict=False):
            interval = one.intervals[name]
            assert interval.value == pytest.approx(true, rel=3 * own) and interval.decided == "both"
            assert 0.02 * true < interval.high - interval.low < 0.6 * true
        assert one.intervals["joint.mu"].decided == "no"
        assert (
            "The data do not decide joint.mu: the interval is as wide as the range that was known before." in one.notes
        )
        assert one.effects[2].max() < 2.0 < 10.0 < one.effects[:2].max(axis=1).min()  # noise of 40 points
        assert one.answer.held_out[0] < one.before.held_out[0] and "held-out error" in one.notes[-1]
        assert np.mean(np.abs(one.answer.deviation)) < np.mean(np.abs(one.before.deviation))
    inside = [one.intervals[n].low <= t <= one.intervals[n].high for one in found for n, t in zip(NAMES, TRUTH)]
    assert sum(inside) >= 9  # of 12


@pytest.mark.slow
def test_repeats_of_a_cheap_rig(model):
    """60 repeats with other seeds and noise.  20 of another draw: inside 18, 17 and 20; width over scatter 0.99, 0.78."""
    proven([cheap(number, model) for number in range(60)], TRUTH, NAMES, "joint.mu")


def test_held_out_targets_do_not_touch_the_fit(model):
    """Other values of the held-out targets: the same answer to the bit, another held-out error."""
    bias = np.ones(9)
    bias[[2, 5, 8]] = 1.5
    one, two = cheap(1, model), cheap(1, model, bias)
    assert [vars(x) for x in one.intervals.values()] == [vars(x) for x in two.intervals.values()]
    assert one.answer.fit == two.answer.fit and two.answer.held_out[0] > 3.0 * one.answer.held_out[0]
    assert [target.held_out for target in one.study.targets] == [False, False, True] * 3


def test_a_wrong_value_at_the_end_of_its_range_is_said(model):
    """A range that does not contain the truth."""
    one = cheap(5, model, parameter=RANGES | {"oil.eta": ["8 mPa.s", "20 mPa.s"]})
    assert one.intervals["oil.eta"].value == pytest.approx(8e-3, rel=0.01) and one.widened > 3.0
    assert "oil.eta lies at the end of the range that was searched." in one.notes


def test_a_model_that_is_wrong_is_said_and_widens(model):
    """Two of the fitted figures off by ten uncertainties."""
    bias = np.ones(9)
    bias[[3, 7]] = [1.3, 0.7]
    right, wrong = cheap(2, model), cheap(2, model, bias)
    assert right.widened == 1.0 and wrong.widened > 5.0
    assert any("misses the fitted targets by more than their uncertainty" in note for note in wrong.notes)


def test_a_prior_stands_in_for_missing_data(model):
    """The idle parameter gets its prior back: mean and 95 % interval of the normal distribution, and stays undecided."""
    prior = RANGES | {"joint.mu": {"low": 0.1, "high": 0.3, "mean": 0.18, "sd": 0.02}}
    one = cheap(3, model, parameter=prior).intervals["joint.mu"]
    assert one.value == pytest.approx(0.18, abs=0.004) and one.decided == "no"
    assert (one.low, one.high) == pytest.approx((0.18 - 1.96 * 0.02, 0.18 + 1.96 * 0.02), abs=0.005)


def test_morris_screens_and_answers_are_written(model, tmp_path):
    found = cheap(4, model, screen={"method": "morris", "trajectories": 6})
    effect = found.screen["friction"]
    assert effect["oil.eta"] > 20.0 * effect["joint.mu"]
    answer = json.loads(write_answer(found, [("bearing", "none")], tmp_path / "identify.json").read_text())
    assert answer["parameters"]["oil.eta"]["decided"] == "both" and answer["targets"][2]["held_out"] is True
    assert answer["targets"][0]["weight"] == pytest.approx(answer["targets"][0]["uncertainty"] ** -2)
    page = write_page(found, [("bearing", "none")], tmp_path / "identify.html").read_text()
    for text in ("do not decide joint.mu", "held out", "before the fit", "correlations", "<svg"):
        assert text.lower() in page.lower()


def test_shares_of_a_logarithmic_range():
    one = Parameter("oil.eta", 1e-3, 1e-1, True)
    assert one.value(0.5) == pytest.approx(1e-2) and one.share(1e-2) == pytest.approx(0.5)


def test_ratio_and_difference_of_points(model):
    """Of two operating points, seed by seed."""
    target = {"measure": "friction", "value": 0.5, "uncertainty": 0.1, "point": "warm"}
    points = [{"name": "cold"}, {"name": "warm", "inputs": {"oil.T": "90 degC"}}]
    document = {"parameter": RANGES, "point": points, "target": [target | {"over": "cold"}, target | {"minus": "cold"}]}
    ratio, difference = plan_identify("r.toml", document | {"held_out": 0}, model).targets
    values = np.array([[[2.0, 4.0], [1.0, 3.0]]])  # [n, points, seeds]
    assert figure_of(ratio, values, [0, 1]).tolist() == [[0.5, 0.75]]
    assert figure_of(difference, values, [0, 1]).tolist() == [[-1.0, -1.0]]
    assert ratio.unit == "1" and ratio.name == "warm: friction over cold"


def test_prediction_is_judged_by_its_scatter():
    """Two fixed candidates whose truth lies in the middle: either is called better in 5 % of cases; a true one against
    one five uncertainties off is found in nearly all.
    """
    rng, called = np.random.default_rng(6), []
    for _ in range(2000):
        error = rng.normal(size=3)
        after, before = np.array([1.0, 0.0, -1.0]) + error, np.array([-1.0, 0.0, 1.0]) + error
        called.append("scatter" not in prediction(after, before, 0.0, 0.0))
    assert np.mean(called) == pytest.approx(0.05, abs=0.02)
    right = [prediction(e := rng.normal(size=3), e + 5.0, 0.0, 0.0).startswith("The fit predicts:") for _ in range(200)]
    assert np.mean(right) > 0.98
    assert prediction(np.array([1.0, 1.0]), np.array([0.1, 0.2]), 0.0, 0.0).startswith("The fit predicts nothing")
    assert prediction(np.array([9.0, 9.0]), np.array([0.1, 0.2]), 0.0, 0.0).startswith("The fit predicts worse")
    assert prediction(np.array([0.1, 0.2]), np.array([9.0, 9.0]), 0.0, 3.0).startswith(
        "The held-out targets do not show"
    )


# Measured series ------------------------------------------------------------------------------------------------------


def series(tmp_path, text=None, **changes):
    """A study of a series in a file beside it."""
    if text is not None:
        (tmp_path / "rig.csv").write_text(text)
    block = {"file": "rig.csv", "time": "t [ms]", "columns": {"housing.F_y": "Fy [kN]"}} | changes
    return tmp_path / "s.toml", {"parameter": RANGES, "held_out": 0, "series": [block]}


def noisy(n=4000, seed=5):
    t = np.arange(n) * 1e-4
    return t, -3000.0 + 50.0 * np.random.default_rng(seed).normal(size=n) + 100.0 * np.sin(2 * np.pi * 1100.0 * t)


def csv_text(t, values):
    return "t [ms],Fy [kN]\n" + "\n".join(f"{1e3 * a:.6f},{1e-3 * b:.9f}" for a, b in zip(t, values, strict=True))


def test_a_series_becomes_statistics_and_bands(model, tmp_path):
    """Mean and standard deviation in N with the uncertainty of independent samples, s/sqrt(n) for the mean and
    s/sqrt(2 n) for the deviation of a Gaussian series (eight parts scatter by a quarter), bands by the sine's amplitude.
    """
    t, values = noisy()
    values = values - 100.0 * np.sin(2 * np.pi * 1100.0 * t)
    mean, std = plan_identify(*series(tmp_path, csv_text(t, values)), model).targets
    assert mean.value == pytest.approx(-3000.0, abs=4 * 50 / math.sqrt(4000))
    assert std.value == pytest.approx(50.0, rel=0.04)
    assert 0.3 < mean.uncertainty / (50.0 / math.sqrt(4000)) < 2.0
    assert 0.3 < std.uncertainty / (50.0 / math.sqrt(8000)) < 2.0
    assert mean.column == "mean(housing.F_y)" and mean.origin == "rig.csv: Fy [kN]"
    t, values = noisy()
    path, document = series(tmp_path, csv_text(t, values), statistics=[], bands=4, uncertainty="2 %")
    found = plan_identify(path, document | {"simulation": {"t_end": 0.2}}, model).targets
    assert len(found) == 4 and all(target.uncertainty > 0.02 / math.log(10) for target in found)
    inside = [target for target in found if (ends := measured_band(target))[0] < 1100.0 < ends[1]]
    assert len(inside) == 1 and 10 ** inside[0].value == pytest.approx(100.0 / math.sqrt(2.0), rel=0.1)


def measured_band(target):
    low, high = target.column.partition(", ")[2].removesuffix(" Hz)").split(" ... ")
    return float(low), float(high)


def test_the_same_from_parquet(model, tmp_path):
    t, values = noisy()
    fields = [
        pa.field("time", pa.float64(), metadata={"unit": "s"}),
        pa.field("F", pa.float64(), metadata={"unit": "N"}),
    ]
    pq.write_table(pa.table([t, values], schema=pa.schema(fields)), tmp_path / "rig.parquet")
    one = plan_identify(*series(tmp_path, csv_text(t, values)), model).targets
    changes = {"file": "rig.parquet", "time": "time", "columns": {"housing.F_y": "F"}}
    two = plan_identify(*series(tmp_path, None, **changes), model).targets
    assert [x.value for x in one] == pytest.approx([x.value for x in two], rel=1e-6)


@pytest.mark.parametrize(
    ("text", "changes", "fragments"),
    [
        ("t [ms],Fy [kN]\n" + "\n".join(f"{i}," for i in range(300)), {}, ['row 2, column "Fy [kN]"', "no value"]),
        ("t [ms],Fy [kN]\n" + "\n".join(f"{i},nan" for i in range(300)), {}, ['row 2, column "Fy [kN]"', "no value"]),
        ("t [ms],Fy [kN]\n" + "\n".join(f"{i},3" for i in range(300)), {}, ["does not scatter, its uncertainty is 0"]),
        ("t [ms],Fy [mm]\n" + "\n".join(f"{i},{i % 7}" for i in range(300)), {}, ["Fy"]),
        ("t [ms],Fy [kN]\n0,1\n1,2", {}, ["at least 128 times"]),
        (csv_text(*noisy()), {"columns": {"housing.F_q": "Fy [kN]"}}, ['unknown channel "housing.F_q"']),
        (csv_text(*noisy()), {"columns": {"housing.F_y": "Fz [kN]"}}, ['unknown column "Fz [kN]"']),
        (csv_text(*noisy()), {"bands": 40}, ["bands = 40", "octaves"]),
        (csv_text(*noisy()), {"statistics": ["mode"]}, ["statistics = ['mode']"]),
    ],
)
def test_a_series_that_cannot_be_used_is_refused(model, tmp_path, text, changes, fragments):
    with pytest.raises(UserError) as refused:
        plan_identify(*series(tmp_path, text, **changes), model)
    for fragment in fragments:
        assert fragment in str(refused.value)


# The bearing ----------------------------------------------------------------------------------------------------------

STUDY = """
scene = "demo"
seeds = 1
check_seeds = 2
simulation.t_end = "12 ms"
[parameters]
start.settle = "4 ms"
scene.stress = "off"
[parameter]
oil.eta = { low = "3 mPa.s", high = "15 mPa.s", scale = "log" }
[screen]
count = 5
[search]
rounds = 1
points = 2
[[point]]
name = "slow"
inputs.shaft.omega = "8000 rev/min"
[[point]]
name = "fast"
inputs.shaft.omega = "16000 rev/min"
[[target]]
point = "slow"
measure = "friction"
value = "VALUE N.m"
uncertainty = "2 %"
[[target]]
point = "fast"
measure = "std(housing.F_y)"
value = "20 N"
uncertainty = "20 N"
[[target]]
point = "fast"
measure = "friction"
over = "slow"
value = 1.5
uncertainty = 0.3
"""


def test_the_command_finds_the_viscosity_and_resumes(tmp_path, model):
    """The measured torque is that of a run at 7 mPa s: it lies in the interval, the scene file that results has it, and
    a second call simulates nothing.
    """
    from riveted_bearing import run

    inputs = {"shaft.omega": "8000 rev/min"}
    parameters = {"start.settle": 4e-3, "scene.stress": "off", "oil.eta": 7e-3}
    truth = run("demo", inputs=inputs, parameters=parameters, t_end=12e-3, seed=77, outputs=["bearing.friction_torque"])
    value = truth.data["bearing.friction_torque"][truth.data["time"] >= 4e-3].mean()
    (tmp_path / "rig.toml").write_text(STUDY.replace("VALUE", f"{value:.6g}"))
    done = command("identify", "rig.toml", "--workers", "1", folder=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "oil.eta" in done.stdout and "held out" in done.stdout
    folder = tmp_path / "results" / "rig"
    answer = json.loads((folder / "identify.json").read_text())
    found = answer["parameters"]["oil.eta"]
    assert found["low"] <= 7e-3 <= found["high"] and found["decided"] == "both"
    scene = load_scene(folder / "identified.toml", model)
    assert scene.parameters["oil.eta"] == found["value"] and scene.t_end == 12e-3
    assert (folder / "identify.html").stat().st_size > 10_000
    rows = (folder / "runs.parquet").read_bytes()
    again = command("identify", "rig.toml", "--workers", "1", folder=tmp_path)
    assert again.stdout == done.stdout and (folder / "runs.parquet").read_bytes() == rows


def test_a_killed_run_resumes(tmp_path, model):
    """A client that fails after the screen: the second call does the other runs only, with the answer of one that was
    never interrupted.
    """
    document = tomllib.loads(STUDY.replace("VALUE", "0.03"))
    plan = plan_identify(tmp_path / "s.toml", document, model)
    with cluster(workers=1) as client:
        whole = identify(plan, Rig(plan, document, model, tmp_path / "whole", lambda: client), np.array([6e-3]))
        calls = []

        def once():
            calls.append(1)
            if len(calls) == 2:
                raise KeyboardInterrupt
            return client

        with pytest.raises(KeyboardInterrupt):
            identify(plan, Rig(plan, document, model, tmp_path / "killed", once), np.array([6e-3]))
        counts = []
        rig = Rig(plan, document, model, tmp_path / "killed", lambda: client, lambda *count: counts.append(count))
        resumed = identify(plan, rig, np.array([6e-3]))
    assert vars(resumed.intervals["oil.eta"]) == vars(whole.intervals["oil.eta"])
    assert sum(count[0] for count in counts[:1]) == 0 and counts[-1][2] == 2 * 2 * 2  # answer and start, points, seeds
    assert {scene.parameters["start.seed"] for scene in rig.scenes.values()} == {1, 1 + FRESH, 2 + FRESH}


@pytest.mark.slow
def test_repeats_of_the_synthetic_rig(tmp_path, model):
    """The FMU itself, 20 repeats with other seeds and noise (examples/identify/synthetic.py): truth inside the 95 %
    interval in 17 to 20 of them, width at most 1.5 times the scatter, the joints' friction undecided in all.
    """
    found = []
    with cluster(workers=2) as client:
        for number in range(1, 21):
            document = synthetic.study(number)
            plan = plan_identify(tmp_path / f"{number}.toml", document, model)
            rig = Rig(plan, document, model, tmp_path / str(number), lambda: client)
            found.append(identify(plan, rig, rig.start()))
    proven(found, synthetic.TRUTH.values(), synthetic.TRUTH, "joint.mu")


def test_files_of_the_page_can_be_read(model, tmp_path):
    """The study of docs/identify.md, alone and with the series."""
    page = (ROOT / "docs" / "identify.md").read_text(encoding="utf-8")
    study, added = re.findall(r"```toml\n(.*?)```", page, re.S)
    (tmp_path / "rig.csv").write_text(csv_text(*noisy()))
    assert len(plan_identify(tmp_path / "rig.toml", tomllib.loads(study), model).targets) == 3
    assert len(plan_identify(tmp_path / "rig.toml", tomllib.loads(study + added), model).targets) == 8


@pytest.mark.parametrize("name", ["heat.toml"])
def test_example_can_be_read(model, name):
    path = ROOT / "examples" / "identify" / name
    assert len(plan_identify(path, read_toml(path), model).targets) == 4


def test_a_missing_library_is_named_and_leaves_nothing(tmp_path):
    (tmp_path / "rig.toml").write_text(STUDY.replace("VALUE", "0.03"))
    without = "import sys; sys.modules['SALib'] = None; sys.argv = ['', 'identify', 'rig.toml']; from riveted_bearing.__main__ import main; main()"
    refused = subprocess.run([sys.executable, "-c", without], cwd=tmp_path, capture_output=True, text=True)
    assert refused.returncode == 2 and refused.stderr.startswith("error: identify: needs the library SALib")
    assert [path.name for path in tmp_path.iterdir()] == ["rig.toml"]
