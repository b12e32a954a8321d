"""From broken rivets to causes: Miner's sums and probabilities by hand, a world whose causes are known, and the FMU."""

import functools
import json
import re
import tomllib

import numpy as np
import pytest
from library import ROOT
from pictures import faults
from scipy import stats

from riveted_bearing import UserError
from riveted_bearing.identify import pool as pools
from riveted_bearing.identify.candidates import SOUND, Range, designs, quantity_at
from riveted_bearing.identify.causes_page import (
    bars,
    cage,
    cascade,
    gains,
    ranked_rows,
    verdict,
    write_answer,
    write_page,
)
from riveted_bearing.identify.findings import NONE, plan_causes
from riveted_bearing.identify.order import State, bench_of, follow, next_break, run_order
from riveted_bearing.identify.pool import Sample, followed, history_of, mission_scene, run_pool, sampled, weakened
from riveted_bearing.identify.posterior import (
    CREDIBLE,
    RESPONSES,
    Predicted,
    answer,
    beta_binomial,
    groups,
    information,
    predictions,
)
from riveted_bearing.running.fmu import Model
from riveted_bearing.show.style import STYLE, plt
from riveted_bearing.studies.sweep import cluster

# ---- what breaks next -------------------------------------------------------------------------------------------------


def states_by(rates_of, parts=lambda gone: False, seeds=3):
    """state_at(gone) for rates [Z, 2] per hour that are known; parts: whether every run stops."""

    def state_at(gone):
        rates = np.array(rates_of(gone), float)
        for k in gone:
            rates[k - 1] = 0.0
        state = State(tuple(gone), rates, np.full(len(rates), 1e8), 1e-6, len(rates))  # all joints open: no end
        return state, None if parts(gone) else np.tile(rates, (seeds, 1, 1))

    return state_at


def test_damage_adds_up_over_the_states_by_hand():
    """Rates 1, 0.5, 0.25 per 1000 h; after each break the others' rates double.

    Rivet 1 goes after 1000 h.  Rivet 2 has half of its damage then: 0.5/(1/1000) = 500 h more.  Rivet 3 has 0.25 + 500
    x 0.5/1000 = 0.5: with 1/1000 500 h.
    """

    def rates(gone):
        return [[r * 2.0 ** len(gone) * 1e-3, 0.0] for r in (1.0, 0.5, 0.25)] + [[0.0, 0.0]]

    states = follow(states_by(rates), 3)
    assert [(state.rivet, state.place) for state in states] == [(1, "head"), (2, "head"), (3, "head"), (None, None)]
    np.testing.assert_allclose([state.hours for state in states[:-1]], [1000.0, 500.0, 500.0], rtol=1e-14)
    assert [state.gone for state in states] == [(), (1,), (1, 2), (1, 2, 3)]
    assert all(state.sure == 1.0 for state in states[:-1])


def test_a_middle_breaks_where_its_damage_is_larger():
    assert next_break(np.zeros((3, 2)), np.array([[1.0, 0.0], [0.0, 4.0], [2.0, 3.0]])) == (0.25, (1, 1))
    damaged = np.array([[0.9, 0.0], [0.0, 0.0]])
    assert next_break(damaged, np.array([[1.0, 0.0], [0.0, 4.0]])) == (pytest.approx(0.1), (0, 0))


def test_what_ends_an_order():
    """Enough are gone; none is left; the halves part; the time is over; nothing is damaged.  Open joints are no end."""
    some = [[1e-3 * (1.0 + k), 0.0] for k in range(5)]
    enough = follow(states_by(lambda gone: some), 2)
    assert len(enough) == 3 and enough[-1].end == "as many as asked for" and enough[-1].rivet is None
    none_left = follow(states_by(lambda gone: some), 5)
    assert [state.rivet for state in none_left] == [5, 4, 3, 2, 1, None] and none_left[-1].end == "no rivet is left"
    parted = follow(states_by(lambda gone: some, parts=lambda gone: len(gone) == 1), 3)
    assert len(parted) == 2 and "the halves part" in parted[-1].end
    # the first break comes after 200 h, the second 50 h later
    late = follow(states_by(lambda gone: some), 3, within=210.0)
    assert len(late) == 2 and late[-1].end.startswith("the next break comes 50 h later")
    calm = follow(states_by(lambda gone: np.zeros((5, 2))), 3)
    assert len(calm) == 1 and calm[0].hours == np.inf and calm[0].end == "nothing is damaged any more"


def test_seeds_that_disagree_leave_the_order_unsure():
    """Two rivets, each worse with one of two seeds by the same factor: the first is the next to break in all resamples
    but those of the other seed alone.
    """

    def state_at(gone):
        rates = np.array([[[3.0, 0.0], [1.0, 0.0], [0.0, 0.0]], [[1.0, 0.0], [2.9, 0.0], [0.0, 0.0]]])
        return State((), rates.mean(axis=0), np.full(3, 1e8), 0.0, 0), rates

    assert follow(state_at, 1)[0].sure == pytest.approx(0.75, abs=0.04)


def test_neighbours_of_a_broken_rivet_carry_its_share(fmu, tmp_path):
    """Whichever goes first, its neighbours bear a part of the centrifugal load that it had.  A second call reads the
    runs; rivets that are broken in the findings are gone from the start.
    """
    document = {"scene": "demo", "seeds": 2, "simulation": {"t_end": "60 ms"}}
    document["parameters"] = {"scene.cage": "two_half", "start.settle": "5 ms", "fatigue.sigma_D": "150 MPa"}
    path, model = tmp_path / "f.toml", Model(fmu)
    with cluster(None, 1) as client:
        found = run_order(bench_of(path, document, model, tmp_path, lambda: client), 9, 2, [], np.inf)
    nothing = bench_of(path, document, model, tmp_path, lambda: pytest.fail("no run is missing"))
    assert [state.rivet for state in run_order(nothing, 9, 2, [], np.inf)] == [state.rivet for state in found]
    place, after = found[0].rivet - 1, found[1]
    (gone,) = run_order(nothing, 9, 0, [found[0].rivet], np.inf)
    assert gone.rivet is None and np.array_equal(gone.rates, after.rates)
    beside = np.array([place - 1, place + 1]) % 9
    assert np.all(after.rates[place] == 0.0) and after.stress[place] == 0.0
    assert after.stress[beside].min() > 1.1 * np.median(np.delete(after.stress, [place, *beside]))


# ---- laws by hand -----------------------------------------------------------------------------------------------------


def test_strength_acts_by_the_slope_of_its_amplitude():
    """N_D 1e6, slopes 8 and 15, 1e4 turns an hour.  At half the amplitude of the knee a rivet of 0.9 times the strength
    has 0.9^-15 times the damage; at twice 0.9^-8 times; at the knee itself 0.9 lifts it above: 0.9^-8, 1.1 below: 1.1^-15.
    """
    curve, turns = (1e6, 8.0, 15.0), 1e4
    knee = turns / curve[0]
    for amplitude, k in ((0.5, 15.0), (2.0, 8.0)):
        rate = np.array([knee * amplitude**k])
        np.testing.assert_allclose(weakened(rate, 0.9, curve, turns), rate * 0.9**-k, rtol=1e-12)
    np.testing.assert_allclose(weakened(np.array([knee]), 0.9, curve, turns), knee * 0.9**-8, rtol=1e-12)
    np.testing.assert_allclose(weakened(np.array([knee]), 1.1, curve, turns), knee * 1.1**-15, rtol=1e-12)


def test_groups_around_the_cage():
    assert groups([1, 2, 3], 9) == 1 and groups([9, 1, 2], 9) == 1 and groups([1, 3, 5], 9) == 3
    assert groups(range(1, 10), 9) == 1 and groups([2, 9], 9) == 2


def test_beta_binomial_is_a_distribution_that_becomes_binomial():
    """Its probabilities add up to 1; with endless trust it is the binomial one, with none all numbers are near alike."""
    k = np.arange(10)
    assert beta_binomial(k, 9, 0.3).sum() == pytest.approx(1.0)
    np.testing.assert_allclose(beta_binomial(k, 9, 0.3, 1e7), stats.binom.pmf(k, 9, 0.3), rtol=1e-4)
    np.testing.assert_allclose(beta_binomial(4, 9, 0.3, 20.0), stats.betabinom.pmf(4, 9, 6.5, 14.5), rtol=1e-10)


def test_information_by_hand():
    """An outcome that tells the cause has the entropy of the causes, one that is alike for all has none."""
    P = np.array([0.5, 0.25, 0.25])
    assert information(P, np.eye(3)) == pytest.approx(1.5)
    assert information(P, np.full((3, 2), 0.5)) == pytest.approx(0.0)
    # a binary channel with errors of 10 %: 1 - H(0.1) bits
    noisy = information(np.array([0.5, 0.5]), np.array([[0.9, 0.1], [0.1, 0.9]]))
    assert noisy == pytest.approx(1.0 + 0.9 * np.log2(0.9) + 0.1 * np.log2(0.1))


# ---- a world whose causes are known -----------------------------------------------------------------------------------

QUIET = dict.fromkeys(RESPONSES, 1.0)
HAND = {"causes": ["clearance", "interference"], "prior": {SOUND: 0.0, NONE: 0.0}}


def study_of(fmu, **findings):
    """A Study of clearance against interference."""
    model, scene = mission_of(fmu)
    return plan_causes("f.toml", HAND | findings, model, scene)


@functools.cache
def mission_of(fmu):
    """The Model and its own mission."""
    model = Model(fmu)
    return model, mission_scene("f.toml", {}, model)


def one(study, cause, hours=(3.0, 3.1, 3.2, 3.3), middle=0.0, fit=-1e-5, beside=0.8):
    """A Predicted; hours: their log10."""
    values = dict.fromkeys(study.quantities, 0.0) | {"fit": fit}
    many = np.full(4, middle), np.array([np.nan, *[beside] * 3])
    return Predicted(cause, np.array(hours), *many, 0.5, (1, 2, 3, 4), (), 0.0, QUIET, values)


def test_bayes_by_hand(fmu):
    """Two causes with one kind of design each, that differ in their hours alone: the odds are those of two normal
    densities, whatever the number of designs.
    """
    study = study_of(fmu, hours="1000 h", broken={"head": 1})
    pool = [one(study, 0)] + [one(study, 1, hours=(3.0,) * 4)] * 3 + [one(study, 2, hours=(5.0,) * 4)] * 7
    said = answer(study, pool)
    odds = stats.norm.pdf(3.0, 3.0, 1.0) / stats.norm.pdf(3.0, 5.0, 1.0)
    assert said.posterior[1] / said.posterior[2] == pytest.approx(odds) and said.posterior[[0, 3]].sum() == 0.0
    assert said.single["hours"][1] / said.single["hours"][2] == pytest.approx(odds)
    assert said.interval(1) == pytest.approx((said.posterior[1],) * 2)  # alike designs: no Monte Carlo error


def test_none_of_the_causes_is_left_open(fmu):
    """All of nine broken in the middle, which no design predicts: none of these leads, by the even tenth against the
    beta-binomial's (9; 9, 0.5, 20.5).
    """
    study = study_of(fmu, broken={"middle": 9}, prior={SOUND: 0.0})
    said = answer(study, [one(study, k) for k in (0, 1, 2) for _ in range(8)])
    assert said.names[said.ranked[0]] == NONE
    ratio = 0.1 / (stats.betabinom.pmf(9, 9, 0.5, 20.5) * stats.norm.cdf(5.0 - 3.3))
    assert said.posterior[3] / said.posterior[1] == pytest.approx(ratio)
    assert "None of the causes" in verdict(said)


def test_a_measured_fit_decides_and_its_density_adds_up(fmu):
    """Fits of the designs lie in the causes' ranges; of all values that can be measured the densities add up to 1."""
    rng = np.random.default_rng(1)
    ranges = {0: (-20e-6, 0.0), 1: (-90e-6, -25e-6), 2: (5e-6, 40e-6)}
    study = study_of(fmu, broken={"head": 3}, measured={"fit": "-60 um"})
    pool = [one(study, k, fit=rng.uniform(*ranges[k])) for k in (0, 1, 2) for _ in range(32)]
    assert answer(study, pool).posterior[1] > 0.95
    grid = np.linspace(-150e-6, 100e-6, 251)
    densities = []
    for value in grid:
        found = study_of(fmu, broken={"head": 3}, measured={"fit": value})
        densities.append(pools_measured(found, pool)[1])
    np.testing.assert_allclose(np.trapezoid(densities, grid), 1.0, atol=0.03)  # 2 % are a blunder, anywhere


def pools_measured(study, pool):
    """Densities of the measured fit under each cause."""
    from riveted_bearing.identify.posterior import measured

    return measured(study, pool, np.array([each.cause for each in pool]))[1][0]


def test_stated_probabilities_are_those_of_a_known_world(fmu):
    """400 failures of a world in which log10 of the hours is normal with another mean and scatter for each cause, and
    middles are as frequent as stated: the first cause is right as often as its stated probabilities say, within three
    standard deviations, and the 90 % sets hold the cause at least so often.
    """
    rng = np.random.default_rng(7)
    law = {1: (2.5, 0.6, 0.05), 2: (3.8, 0.9, 0.4)}
    study = study_of(fmu, broken={"head": 1})
    pool = [one(study, 0)] * 8
    for cause, (mean, scatter, middle) in law.items():
        pool += [one(study, cause, hours=(h,) * 4, middle=middle) for h in mean + scatter * rng.standard_normal(64)]
    right, stated, inside = [], [], []
    for _ in range(400):
        cause = int(rng.integers(1, 3))
        mean, scatter, middle = law[cause]
        hours = mean + scatter * rng.standard_normal() + rng.standard_normal()
        p = rng.beta(20.0 * middle + 0.5, 20.0 * (1.0 - middle) + 0.5)
        middles = int(rng.binomial(4, p))
        if hours > 5.0:
            continue
        said = answer(
            study_of(fmu, hours=10.0**hours, broken={"head": 4 - middles, "middle": middles}), pool, inspect=False
        )
        right.append(said.ranked[0] == cause)
        stated.append(said.posterior[said.ranked[0]])
        inside.append(cause in said.credible)
    scatter = np.sqrt(np.mean(np.array(stated) * (1.0 - np.array(stated))) / len(stated))
    assert abs(np.mean(right) - np.mean(stated)) < 3.0 * scatter  # 0.858 against 0.832, scatter 0.018
    assert np.mean(inside) > CREDIBLE - 3.0 * scatter  # 0.98: sets of whole causes hold more than they state


# ---- files ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("document", "words"),
    [
        ({"broken": {"head": [10]}}, "broken.head = [10]: rivet 10: the bearing has the rivets 1 to 9"),
        ({"broken": {"head": [1], "middle": [1]}}, "broken.middle = [1]: rivet 1 is in broken.head too"),
        ({"broken": {"head": [1, 1]}}, "a list of different rivets' numbers"),
        ({"broken": {"head": [1, 2], "order": [2, 2]}}, "broken.order = [2, 2]: rivet 2 breaks twice"),
        ({"broken": {"head": [1, 2], "order": [3]}}, "rivet 3 is not among the broken ones"),
        ({"broken": {"head": 2, "order": [1]}}, "rivet 1 is not among the broken ones"),
        ({"broken": {"head": [1], "formed": [2]}}, "rivet 2 is not in broken.head"),
        ({"broken": {"head": 7, "middle": 3}}, "more than the 9 of the bearing"),
        ({"loose": [2], "broken": {"head": [2]}}, "loose = [2]: rivet 2 is in broken.head too"),
        ({"hours": "9 N"}, "hours = '9 N': unit \"N\" does not fit"),
        ({"hours": "2e5 h"}, "at most within = 100000 h"),
        ({"marks": {"pocket": "some"}}, "marks.pocket = 'some': allowed: none, heavy"),
        ({"measured": {"fitt": 1e-6}}, 'unknown inspection "fitt"; did you mean "fit"?'),
        ({"measured": {"fit": "about 60 N"}}, "measured.fit = 'about 60 N': unit \"N\" does not fit"),
        ({"causes": ["tilt"]}, 'unknown cause "tilt"'),
        (
            {"cause": [{"name": "a", "between": {"joint": {"fitt": [0, 1]}}}]},
            'cause a: unknown parameter or input "joint.fitt"',
        ),
        ({"cause": [{"name": "a", "between": {"joint.fit": ["5 um", "1 um"]}}]}, "cause a: joint.fit"),
        ({"cause": [{"name": "a"}, {"name": "a"}]}, "each cause needs a name of its own"),
        ({"prior": {"gremlins": 1.0}}, 'prior: unknown cause "gremlins"'),
        ({"causes": [], "prior": {SOUND: 0.0}}, "one cause at least must be possible"),
        ({"samples": 3}, "samples"),
        ({"case": [{"name": "a"}]}, "`riveted-bearing causes --order` has no cases"),
        ({"until": "20000 h"}, "until: write within"),
        ({"trials": 9}, "this is a search for best values, not a file of findings"),
    ],
)
def test_what_cannot_be_is_refused_by_name(fmu, document, words):
    model = Model(fmu)
    with pytest.raises(UserError, match=re.escape(words)):
        plan_causes("f.toml", document, model, mission_scene("f.toml", {}, model))


def test_the_pages_file_is_read_and_drawn(fmu):
    """The findings of docs/failure.md; no text of its pictures lies on another or is cut."""
    text = (ROOT / "docs" / "failure.md").read_text(encoding="utf-8").split("```toml")[1].split("```")[0]
    study = study_of(fmu, **{key: value for key, value in tomllib.loads(text).items() if key != "prior"})
    assert study.findings.gone == [1, 2, 3, 8, 9] and study.findings.order == (2, 1)
    said = answer(study, [one(study, k) for k in (0, 1, 2) for _ in range(8)])
    states = follow(states_by(lambda gone: [[1e-3 * (1.0 + k), 0.0] for k in range(9)]), 3)
    for draw, size in ((lambda fig: cage(fig, study), (4.2, 4.2)), (lambda fig: bars(fig, said), (4.6, 1.6))):
        assert_in_order(draw, size)
    assert_in_order(lambda fig: gains(fig, said), (4.6, 4.0))
    assert_in_order(lambda fig: cascade(fig, states), (2.3 * len(states), 2.7))


def assert_in_order(draw, size):
    """A picture without faults."""
    with plt.rc_context(STYLE):
        figure = plt.figure(figsize=size, layout="constrained")
        draw(figure)
        assert not list(faults(figure))
        plt.close(figure)


def test_a_mission_that_varies_in_time_is_refused(fmu):
    """Inputs over time have no lives to compare; a mission's own acceleration of damage does not count."""
    model = Model(fmu)
    ramp = {"inputs": {"shaft.omega": {"t": [0.0, 0.1], "value": [1000.0, 1500.0]}}}
    with pytest.raises(UserError, match=r"shaft\.omega varies in time"):
        followed(mission_scene("f.toml", ramp, model), model, 2, ())
    fast = {"parameters": {"scene.stress": "fatigue", "scene.breakage": "on", "fatigue.acceleration": 1e9}}
    plain, accelerated = (followed(mission_scene("f.toml", document, model), model, 2, ()) for document in ({}, fast))
    assert plain.parameters == accelerated.parameters


def test_designs_fill_their_ranges(fmu):
    """A Latin hypercube has one value in each of its slices; names with [*] have one for each rivet; what no cause
    changes is the mission's own.
    """
    model = Model(fmu)
    study = plan_causes("f.toml", {}, model, mission_scene("f.toml", {}, model))
    cause = next(cause for cause in study.causes if cause.name == "preload scattered")
    found = designs(cause, 16, 1, model)
    fits = np.sort([design["joint.fit"] for design in found])
    np.testing.assert_array_equal(np.floor(16 * (fits + 20e-6) / 20e-6), np.arange(16))
    assert {f"rivet[{k}].preload_factor" for k in range(1, 10)} < set(found[0])
    spreads = [quantity_at("rivet[*].preload_factor", design, 1.0) for design in found]
    assert min(spreads) < 0.5 < 1.2 < max(spreads) < 2.0 and quantity_at("cage.unbalance", found[0], 7.0) == 7.0
    sound, loose = (next(c for c in study.causes if c.name == name) for name in (SOUND, "clearance"))
    for healthy, other in zip(designs(sound, 16, 1, model), designs(loose, 16, 1, model), strict=True):
        assert {name for name in healthy if healthy[name] != other[name]} == {"joint.fit"}
    assert Range(1.0, 100.0, True).at(np.array([0.0, 0.5, 1.0])).tolist() == pytest.approx([1.0, 10.0, 100.0])
    own = model.default(model.parameters["cage.m"])
    unbalance = next(cause for cause in study.causes if cause.name == "unbalance").ranges["cage.unbalance"]
    assert (unbalance.low, unbalance.high) == pytest.approx((4e-5 * own, 4e-4 * own))


def test_other_causes_do_not_change_the_designs_of_one(fmu):
    """A pool serves each file of the same mission, whatever causes it tries."""
    model = Model(fmu)
    scene = mission_scene("f.toml", {}, model)
    few, many = ({"causes": names} for names in (["misalignment"], ["clearance", "misalignment", "wear"]))
    plans = [sampled(plan_causes("f.toml", file, model, scene), model, file) for file in (few, many)]
    tilted = [[entry[-1] for entry in plan if entry[-1].name == "misalignment"] for plan in plans]
    assert tilted[0] == tilted[1] and len(tilted[0]) == 32


# ---- through the FMU --------------------------------------------------------------------------------------------------


def test_a_rivet_taken_out_in_the_run_equals_one_that_is_gone_from_the_start(fmu, record_property):
    """Eight seeds, tilted shaft: the damage rates after the first break in the same simulation against those of a run
    that starts without this rivet.  Their logarithms agree in the mean over rivets and seeds within 0.06 decades, four
    times the scatter of the mean, 0.015; observed: 0.000.
    """
    model = Model(fmu)
    changes = {"inputs": {"shaft.tilt_z": "0.15 deg"}}
    decades, rises = [], []
    for seed in range(1, 9):
        changes["parameters"] = {"start.seed": seed}
        scene = mission_scene("f.toml", changes, model)
        first, second = history_of(model, followed(scene, model, 2, ()))["states"]
        changes["parameters"] = {"start.seed": seed + 100, f"rivet[{first['rivet']}].intact": 0}
        (restarted,) = history_of(model, followed(mission_scene("f.toml", changes, model), model, 1, ()))["states"]
        assert second["gone"] == restarted["gone"] == [first["rivet"]]
        whole = [k for k in range(9) if k + 1 != first["rivet"]]
        decades.append(np.log10(np.array(second["rates"])[whole, 0] / np.array(restarted["rates"])[whole, 0]))
        rises.append(np.array(second["rates"])[:, 0].max() / np.array(first["rates"])[:, 0].max())
    record_property("decades", [float(np.mean(decades)), float(np.std(np.mean(decades, axis=1)) / np.sqrt(8))])
    assert abs(np.mean(decades)) < 0.06
    assert (
        np.exp(np.mean(np.log(rises))) > 2.0
    )  # the neighbours carry more than before: observed 2.8, single seeds 1.4 to 6.9


def test_a_pool_is_kept_and_answers(fmu, tmp_path):
    """Eight designs of four causes: a second call reads them; the tilt of a steep track is named; page and file are
    whole.
    """
    model, path = Model(fmu), tmp_path / "f.toml"
    document = {
        "causes": ["misalignment", "malformed rivet", "one-sided riveting"],
        "samples": 8,
        "breaks": 2,
        "broken": {"head": [1, 2], "formed": [1], "order": [2, 1]},
        "hours": "about 3 h",
        "marks": {"pocket": "heavy"},
        "measured": {"tilt": "0.2 deg"},
    }
    scene = mission_scene(path, document, model)
    study = plan_causes(path, document, model, scene)
    with cluster(None, 1) as client:
        samples = run_pool(study, model, document, tmp_path, lambda: client)
    again = run_pool(study, model, document, tmp_path, lambda: pytest.fail("no run is missing"))
    assert [each.history for each in again] == [each.history for each in samples] and len(samples) == 32
    pool = predictions(samples, study, model, scene)
    said = answer(study, pool)
    assert said.names[said.ranked[0]] == "misalignment" and "misalignment" in ranked_rows(said)[0]
    stored = json.loads(
        write_answer(study, said, pool, None, [("bearing", "6207")], tmp_path / "causes.json").read_text()
    )
    assert stored["causes"][0]["name"] == "misalignment" and len(stored["inspections"]) > 5
    assert sum(cause["probability"] for cause in stored["causes"]) == pytest.approx(1.0)
    page = write_page(study, said, pool, None, [("bearing", "6207")], tmp_path / "causes.html").read_text(
        encoding="utf-8"
    )
    assert "What to inspect next" in page and page.count("<svg") == 3
    weak = next(each for each in samples if study.causes[each.cause].name == "malformed rivet")
    assert weak.strengths[0, 0] < weak.strengths[1:, 0].min()


def test_wear_takes_its_hours_and_a_share_mixes_rates(fmu):
    """30 N of preload, 10 of which are left: 20 N over a loss of 0.1 N an hour are 200 h before the rates of the design
    count.  A cause that breaks a rivet in 1000 h, where the sound design of the same number lasts 9000 h, does so in
    1/(0.1/1000 + 0.9/9000) = 5000 h if it acts in a tenth of the time; without that design in 10,000 h.
    """
    study, model = study_of(fmu), Model(fmu)
    scene = mission_scene("f.toml", {}, model)

    def sample(cause, number, design, hours):
        state = {"gone": [], "rates": np.full((9, 2), 1e-3).tolist(), "hours": hours, "rivet": 1, "place": 0}
        return Sample(cause, number, design, {"states": [state], "preload_loss": 0.1}, np.ones((9, 2)))

    worn = {"model.worn": 30.0, "joint.preload": 10.0}
    samples = [sample(0, 0, {}, 9000.0), sample(1, 0, worn, 1000.0)]
    samples += [sample(2, number, {"model.share": 0.1}, 1000.0) for number in (0, 7)]
    found = predictions(samples, study, model, scene)
    np.testing.assert_allclose([10.0 ** each.at(1) for each in found], [9000.0, 1200.0, 5000.0, 10000.0])
    assert found[0].middle[0] == pytest.approx(0.5)


@pytest.mark.slow
def test_a_few_causes_are_recovered(fmu, tmp_path, monkeypatch):
    """Twelve failures of the 6207 with three causes that the bench hides: the cause is first in two thirds and in the
    90 % set in three quarters at least; of all eight causes and four bearings benchmarks/causes.py has the figures.
    """
    monkeypatch.syspath_prepend(str(ROOT / "benchmarks"))
    import causes as bench

    monkeypatch.setattr(bench, "EACH", 8)
    with cluster(None, 1) as client:
        found = bench.pools("6207", fmu, tmp_path, lambda: client, ["interference", "misalignment", "preload lost"], 16)
    rows = bench.recovery({"6207": found}, 12)
    assert sum(row["3 right"] for row in rows) >= 8
    assert sum(row["3 in the 90 % set"] for row in rows) >= 9


def test_scatter_of_strengths():
    """90 % over 10 % of the strengths of one lot is 1.25."""
    low, high = np.exp(pools.SCATTER * stats.norm.ppf([0.1, 0.9]))
    assert high / low == pytest.approx(1.25, rel=1e-3)
