"""Rivet after rivet: Miner's sums by hand, what ends a cascade, and one through the FMU."""

import json
import re

import numpy as np
import pytest

from riveted_bearing import UserError
from riveted_bearing.design.cascade import (
    Cascade,
    CascadeCase,
    State,
    bench_of,
    breaks_of,
    follow,
    next_break,
    run_cascades,
    run_single,
    write_cascades,
    write_picture,
)
from riveted_bearing.running.fmu import Model
from riveted_bearing.studies.sweep import cluster


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
    found = Cascade("hand", tuple(states)).order
    assert [(rivet, place) for rivet, place, _ in found] == [(1, "head"), (2, "head"), (3, "head")]
    np.testing.assert_allclose([hours for *_, hours in found], [1000.0, 1500.0, 2000.0], rtol=1e-14)
    assert [state.gone for state in states] == [(), (1,), (1, 2), (1, 2, 3)] and states[-1].rivet is None
    assert all(state.sure == 1.0 for state in states[:-1])


def test_a_middle_breaks_where_its_damage_is_larger():
    assert next_break(np.zeros((3, 2)), np.array([[1.0, 0.0], [0.0, 4.0], [2.0, 3.0]])) == (0.25, (1, 1))
    assert next_break(np.array([[0.9, 0.0], [0.0, 0.0]]), np.array([[1.0, 0.0], [0.0, 4.0]])) == (
        pytest.approx(0.1),
        (0, 0),
    )


def test_what_ends_a_cascade():
    """Enough are gone; none is left; the halves part; the time is over; nothing is damaged.  Open joints are no end."""
    some = [[1e-3 * (1.0 + k), 0.0] for k in range(5)]
    enough = follow(states_by(lambda gone: some), 2)
    assert len(enough) == 3 and enough[-1].end == "as many as asked for" and enough[-1].rivet is None
    none_left = follow(states_by(lambda gone: some), 5)
    assert [state.rivet for state in none_left] == [5, 4, 3, 2, 1, None] and none_left[-1].end == "no rivet is left"
    parted = follow(states_by(lambda gone: some, parts=lambda gone: len(gone) == 1), 3)
    assert len(parted) == 2 and "the halves part" in parted[-1].end
    late = follow(
        states_by(lambda gone: some), 3, until=210.0
    )  # the first break comes after 200 h, the second 50 h later
    assert len(late) == 2 and late[-1].end.startswith("the next break comes 50 h later")
    calm = follow(states_by(lambda gone: np.zeros((5, 2))), 3)
    assert len(calm) == 1 and calm[0].hours == np.inf and calm[0].end == "nothing is damaged any more"


def test_what_a_case_leaves_out_is_gone():
    """Rivets that are missing from the start are gone in each state and break no more, whatever their rates."""
    some = [[1e-3 * (1.0 + k), 0.0] for k in range(5)]

    def state_at(gone):
        return State(tuple(gone), np.array(some), np.full(5, 1e8), 0.0, 5), np.tile(some, (2, 1, 1))

    found = follow(state_at, 2, missing=[5])
    assert [state.gone for state in found] == [(5,), (4, 5), (3, 4, 5)] and [state.rivet for state in found] == [
        4,
        3,
        None,
    ]


def test_seeds_that_disagree_leave_the_order_unsure():
    """Two rivets, each worse with one of two seeds by the same factor: the first is the next to break in all resamples
    but those of the other seed alone.
    """

    def state_at(gone):
        rates = np.array([[[3.0, 0.0], [1.0, 0.0], [0.0, 0.0]], [[1.0, 0.0], [2.9, 0.0], [0.0, 0.0]]])
        return State((), rates.mean(axis=0), np.full(3, 1e8), 0.0, 0), rates

    assert follow(state_at, 1)[0].sure == pytest.approx(0.75, abs=0.04)


def test_cases_change_single_values(tmp_path, fmu):
    """A case's parameters and inputs join those of the document, one by one; tilt, speed and loads can be cases."""
    document = {
        "seeds": 1,
        "parameters": {"joint": {"preload": "30 N"}, "start.settle": 1e-3},
        "inputs": {"shaft": {"omega": 500.0}},
    }
    case = CascadeCase(parameters={"joint": {"fit": "-90 um"}}, inputs={"shaft": {"tilt_y": "0.1 deg"}})
    scene = bench_of(tmp_path / "c.toml", document, Model(fmu), tmp_path, None, None, case).scene
    assert scene.parameters["joint.preload"] == 30.0 and scene.parameters["joint.fit"] == pytest.approx(-90e-6)
    assert scene.inputs["shaft.omega"].value == [500.0] and scene.inputs["shaft.tilt_y"].value == pytest.approx(
        np.deg2rad(0.1)
    )


@pytest.mark.parametrize(
    ("document", "words"),
    [
        ({"seed": 0.5}, "seed"),
        ({"break": 3}, "break"),
        ({"breaks": 0}, "breaks"),
        ({"case": [{"name": "a"}, {"name": "a"}]}, "case"),
        ({"case": {"name": "a"}}, "case"),
        ({"breaks": 10}, "at most the rivets that stand, 9, are allowed"),
        ({"parameters": {"rivet[2].intact": 0}, "breaks": 9}, "at most the rivets that stand, 8, are allowed"),
        ({"until": "20 N"}, "until"),
        ({"until": -1}, "until"),
    ],
)
def test_what_cannot_be_is_refused_by_name(tmp_path, fmu, document, words):
    path = tmp_path / "c.toml"
    small = {
        "seeds": 1,
        "breaks": 1,
        "simulation": {"t_end": 2e-3},
        "parameters": {"start.settle": 1e-3, "fatigue.sigma_D": "20 MPa"},
    }
    small |= document
    with pytest.raises(UserError, match=re.escape(words)):
        run_cascades(path, small, Model(fmu), tmp_path / "runs", lambda: pytest.fail("nothing is simulated"))


def test_neighbours_of_a_broken_rivet_carry_its_share(fmu, tmp_path, record_property):
    """Whichever goes first, its neighbours bear a part of the centrifugal load that it had.  A second call reads the
    runs.
    """
    document = {"scene": "demo", "seeds": 2, "breaks": 2, "simulation": {"t_end": "60 ms"}}
    document["parameters"] = {"scene.cage": "two_half", "start.settle": "5 ms", "fatigue.sigma_D": "150 MPa"}
    refused = {"seeds": 1, "breaks": 1, "case": [{"name": "heavy", "parameters": {"cage.J_t": 1e-3}}]}
    with cluster(None, 1) as client:
        found = run_cascades(tmp_path / "c.toml", document, Model(fmu), tmp_path / "runs", lambda: client)
        with pytest.raises(UserError, match=r"c\.toml: heavy: the run failed: .* refuses to start: cage\.J_t = 0\.001"):
            run_cascades(tmp_path / "c.toml", refused, Model(fmu), tmp_path / "bad", lambda: client)
    again = run_cascades(
        tmp_path / "c.toml", document, Model(fmu), tmp_path / "runs", lambda: pytest.fail("no run is missing")
    )
    first, second = found[0].order
    record_property("order", json.dumps(found[0].order))
    assert first[0] != second[0] and found[0].order == again[0].order
    after, place = found[0].states[1], first[0] - 1
    beside = np.array([place - 1, place + 1]) % 9
    assert np.all(after.rates[place] == 0.0) and after.stress[place] == 0.0
    assert after.stress[beside].min() > 1.1 * np.median(np.delete(after.stress, [place, *beside]))
    stored = json.loads(write_cascades(found, tmp_path / "cascade.json").read_text())
    assert [each["rivet"] for each in stored["c"]["order"]] == [first[0], second[0]]
    assert write_picture(found, tmp_path / "cascade.png").stat().st_size > 10_000


def test_one_simulation_and_restarts_agree(fmu, tmp_path, record_property):
    """Two seeds: the first break of the single simulations comes within a factor of four of the restarts' time, as the
    damage of 55 ms scatters; a single simulation stores rivet, place and hours.
    """
    document = {"scene": "demo", "seeds": 2, "breaks": 1, "simulation": {"t_end": "60 ms"}}
    document["parameters"] = {"scene.cage": "two_half", "start.settle": "5 ms", "fatigue.sigma_D": "150 MPa"}
    with cluster(None, 1) as client:
        arguments = (tmp_path / "c.toml", document, Model(fmu), tmp_path / "runs", lambda: client)
        found = run_cascades(*arguments)
        single = run_single(*arguments, found)
    (restarts,) = found[0].order
    hours = [run[0][2] for run in single["c"] if run]
    record_property("hours", [restarts[2], *hours])
    assert hours and all(0.25 < each / restarts[2] < 4.0 for each in hours)
    rates = found[0].states[0].rates.max(axis=1)
    assert all(rates[run[0][0] - 1] > np.median(rates) for run in single["c"] if run)
    stored = json.loads(write_cascades(found, tmp_path / "cascade.json", single).read_text())
    assert next(run for run in stored["c"]["single"] if run)[0]["place"] in ("head", "middle")


def test_breaks_of_a_run_in_hours():
    """Damage accelerated 3.6e6 times: 1 ms stands for an hour."""
    values = np.full((9, 2), -1.0)
    values[3], values[7] = (0.052, 2.0), (0.051, 1.0)
    assert [(k, place) for k, place, _ in breaks_of(values, 0.05, 3.6e6)] == [(8, "head"), (4, "middle")]
    np.testing.assert_allclose([hours for *_, hours in breaks_of(values, 0.05, 3.6e6)], [1.0, 2.0])
