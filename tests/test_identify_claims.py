"""The paper's claims as targets: which conditions the search sees, means of few runs, the stages, and what is refused."""

import sys
from types import SimpleNamespace

import numpy as np
import pytest
from library import ROOT

from riveted_bearing import UserError
from riveted_bearing.base.toml_files import read_toml
from riveted_bearing.studies.sweep import cluster

sys.path.insert(0, str(ROOT / "benchmarks" / "paper"))

import fit_claims as claims
from claims import PICTURES
from figures import Runs
from fit_claims import (
    FEW,
    Bench,
    as_means,
    conditions,
    difference,
    fitted_conditions,
    held_out_conditions,
    identify_claims,
    met,
    own_values,
    plan_claims,
    write_claims,
    write_claims_page,
)

DOCUMENT = {
    "scene": "paper",
    "parameter": {"joint.mu": [0.1, 0.3], "oil.eta": ["2 mPa.s", "20 mPa.s"]},
    "claims": {"screens": 200, "figures": 60, "verified": 4, "seeds": 2},
}


@pytest.fixture(scope="module")
def study(model):
    return plan_claims("claims.toml", DOCUMENT, model)


def test_conditions_are_either_fitted_or_held_out(study):
    """Every condition of the paper's claims once; those that need another figure's runs are held out."""
    fitted, held = fitted_conditions(study), held_out_conditions(study)
    assert not set(fitted) & set(held) and {*fitted, *held} == set(conditions(PICTURES))
    assert {picture for picture, *_ in fitted} == {"preload", "speed"}
    assert any(picture == "preload" and line.startswith("fit: ") for picture, _, line in held)
    assert len(fitted) > 15 < len(held)


def test_example_can_be_read(model):
    path = ROOT / "benchmarks" / "paper" / "fit_claims.toml"
    found = plan_claims(path, read_toml(path), model)
    assert len(found.parameters) == 13 and (found.settings["screens"], found.settings["verified"]) == (2000, 20)


@pytest.mark.parametrize(
    ("changes", "fragments"),
    [
        ({"claims": {"fit": ["prelaod"]}}, ["claims.fit = ['prelaod']", "preload"]),
        ({"claims": {"fit": list(PICTURES)}}, ["some, not all"]),
        ({"claims": {"figures": 3}}, ["claims.figures = 3"]),
        ({"claims": {"screens": 10, "figures": 20}}, ["claims.figures = 20", "claims.screens = 10"]),
        ({"claims": {"figures": 10, "verified": 9}}, ["claims.verified = 9"]),
        ({"claims": {"seeds": 1}}, ["claims.seeds = 1"]),
        ({"claims": {"measure": "median"}}, ["claims.measure = 'median'", "p99.9"]),
        ({"claims": {"stages": 3}}, ['"claims.stages"']),
        ({"parameter": {"shaft.omega": ["1000 rev/min", "2000 rev/min"]}}, ["shaft.omega", "belongs to the figures"]),
        ({"target": []}, ['"target"']),
    ],
)
def test_what_cannot_be_used_is_refused(model, changes, fragments):
    with pytest.raises(UserError) as refused:
        plan_claims("claims.toml", DOCUMENT | changes, model)
    for fragment in fragments:
        assert fragment in str(refused.value)


def runs(**columns):
    """Runs with the columns of all axes."""
    n = len(next(iter(columns.values())))
    plain = {name: np.zeros(n) for name in claims.AXES} | {"scene": np.array(["paper"] * n)}
    return Runs(plain | {name: np.asarray(values) for name, values in columns.items()})


def test_few_runs_are_judged_by_their_means():
    """Two seeds whose interval spans everything: by the intervals nothing is certain, by the means it is."""
    one = runs(preload=[0.0, 0.0, 60.0, 60.0], seed=[1, 2, 1, 2], head=[90.0, 110.0, 140.0, 170.0], mid=[1.0] * 4)
    data = {"preload": as_means(one)}
    assert data["preload"].at(preload=60.0).values("head").tolist() == [155.0, 155.0]
    inside, rising = ("preload", "", "$head[60] within 140..160"), ("preload", "", "$head[0 -> 60] > 50")
    assert met([inside, rising], data, "mean") == [True, True]
    assert met([inside, rising], {"preload": one}, "mean") == [False, False]


def test_difference_of_means():
    """Against the interval by hand: equal variances and numbers are Student's two-sample interval."""
    a, b = np.array([1.0, 2.0, 3.0]), np.array([2.0, 3.0, 4.0])
    gain, half = difference(a, b)
    assert gain == -1.0 and half == pytest.approx(2.776 * np.sqrt(2.0 / 3.0), rel=1e-3)  # t for 4 degrees of freedom


class Pretended:
    """A bench whose sets meet conditions by a rule: the fitted ones near joint.mu = 0.2, the held-out ones near a value
    of oil.eta that the fit does not see, or near the same joint.mu.
    """

    def __init__(self, study, model, folder, related):
        self.study, self.model, self.folder, self.related = study, model, folder, related
        self.spent, self.calls, self.rng = 0.0, 0, np.random.default_rng(1)

    def base(self, name, seeds):
        return SimpleNamespace(scenes={"": SimpleNamespace(parameters={})})

    def data(self, sets, sweeps, folder, few=True, seeds=1, first=0):
        self.calls, self.spent = self.calls + 1, self.spent + 1.0
        return [SimpleNamespace(values=values) for values in sets]


def pretended(study, model, folder, related, monkeypatch):
    rng, fitted = np.random.default_rng(2), set(fitted_conditions(study))

    def judge(which, data, measure):
        mu, eta = abs(data.values[0] - 0.2) / 0.1, abs(data.values[1] - 11e-3) / 9e-3
        far = np.array([mu if one in fitted or related else eta for one in which])
        return [bool(x) for x in rng.random(len(which)) > 0.9 * far]

    monkeypatch.setattr(claims, "judge", judge)
    bench = Pretended(study, model, folder, related)
    return identify_claims(study, bench), bench


@pytest.mark.parametrize("related", [True, False])
def test_a_fit_that_predicts_and_one_that_does_not(study, model, tmp_path, monkeypatch, related):
    """Held-out conditions that depend on what the fit finds, and such that do not."""
    found, _ = pretended(study, model, tmp_path, related, monkeypatch)
    text = " ".join(found.notes)
    assert ("the fit predicts nothing" in text) is not related and ("the fit predicts." in text) is related
    assert found.best[0].mean() > found.chance[0].mean() + 0.2  # the fit fits, either way
    assert len(found.verified) == 4 and np.all(np.abs(found.values[:, 0] - 0.2) < 0.05)
    assert write_claims(found, tmp_path / "claims.json").stat().st_size > 1000
    page = write_claims_page(found, tmp_path / "claims.html").read_text()
    assert found.notes[0].split(":")[0] in page and page.count("<td>held out") == len(held_out_conditions(study))
    assert len(found.verified[0]["met"]) == len(conditions(PICTURES))


def test_stages_resume(study, model, tmp_path, monkeypatch):
    """Finished chunks are read again: only the verification, whose runs are in its own folders, is asked for twice."""
    first, bench = pretended(study, model, tmp_path, True, monkeypatch)
    again, other = pretended(study, model, tmp_path, True, monkeypatch)
    assert bench.calls == -(-200 // claims.CHUNK) - (-60 // claims.CHUNK) + 5 and other.calls == 5
    np.testing.assert_array_equal(first.screens, again.screens)
    assert first.cpu["screens"] == again.cpu["screens"] == 13.0


def test_sets_change_what_the_figures_leave_open(study, model, tmp_path):
    """A set's values stand in every run, but for those that a figure varies; few points have a short horizon."""
    bench = Bench(study, model, tmp_path, None)
    few = list(bench.scenes("preload", [0.17, 8e-3], True, 1))
    assert [scene.parameters["joint.preload"] for scene in few] == list(FEW["preload"]["preload"])
    assert {(scene.parameters["joint.mu"], scene.parameters["oil.eta"]) for scene in few} == {(0.17, 8e-3)}
    assert {scene.t_end for scene in few} == {0.12}
    whole = list(bench.scenes("preload", [0.17, 8e-3], False, 2, 1000))
    assert len(whole) == 20 and {scene.parameters["start.seed"] for scene in whole} == {1001, 1002}
    assert {scene.t_end for scene in whole} == {0.3}
    assert own_values(study, bench).tolist() == [model.default(model.parameters["joint.mu"]), 6e-3]


@pytest.mark.slow
def test_a_set_on_all_figures(study, model, tmp_path):
    """The bearing itself: all sweeps have their runs, every condition gets a verdict, and a second call simulates
    nothing.
    """
    with cluster(workers=2) as client:
        bench = Bench(study, model, tmp_path, lambda: client)
        (data,) = bench.data(
            [[0.15, 6e-3]], ["preload", "speed", "fit", "impact", "tilt", "clearance"], tmp_path / "one"
        )
        found = claims.judge(conditions(PICTURES), data, "mean")
        spent = bench.spent
        bench.data([[0.15, 6e-3]], ["preload", "speed", "fit", "impact", "tilt", "clearance"], tmp_path / "one")
    assert set(data) == set(FEW) and 0.3 < np.mean(found) < 0.9
    assert bench.spent == 2 * spent  # of the same rows
    assert (
        data["preload"].at(preload=60.0).estimate("head").mean > data["preload"].at(preload=0.0).estimate("head").mean
    )
