"""Life of the raceways: ISO 281 and ISO/TS 16281 at a point, over a mission, and beside the rivets' in the verdict."""

import json
import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from commands import command, typed

from riveted_bearing import UserError
from riveted_bearing.bearing.bearing_file import bearing_case
from riveted_bearing.bearing.load_ratings import (
    CLEANLINESS,
    contamination_factor,
    equivalent_load,
    fatigue_load_limit,
    life_factor,
    rating_factor_0,
)
from riveted_bearing.cli.optimize import go_apart
from riveted_bearing.duty import designs, designs_page, page, raceways, sheet, verdict
from riveted_bearing.duty.evidence import Evidence
from riveted_bearing.duty.mission import plan_mission
from riveted_bearing.running.inputs import History
from riveted_bearing.running.runner import simulate, turns
from riveted_bearing.running.scene import load_scene
from riveted_bearing.running.summary import count_note, settle_note, speed_note, static_and_swing
from riveted_bearing.show.style import plt

TURN = 2.0 * math.pi


@pytest.fixture(scope="module")
def case():
    """The 6212 at 0.1 C."""
    return bearing_case("6212")


def at(case, **values):
    return replace(case, values=case.values | {name.replace("__", "."): value for name, value in values.items()})


def test_equivalent_load():
    """F_r 2225 N, F_a 1780 N of a 6210 with f_0 F_a/C_0 = 1.104: Y = 1.55 - 0.1 (1.104 - 1.03)/0.35 = 1.5289, P = 3967 N
    (Shigley's worked example has 3964 N with Y = 1.527); up to F_a = e F_r the axial load does not count.
    """
    C_0 = rating_factor_0(0.2) * 1780.0 / 1.104
    assert equivalent_load(2225.0, 1780.0, C_0, 0.2) == pytest.approx(0.56 * 2225 + 1.5289 * 1780, rel=1e-4)
    assert equivalent_load(2225.0, 1780.0, C_0, 0.2) == pytest.approx(3964.0, rel=2e-3)
    assert equivalent_load(9000.0, 1780.0, C_0, 0.2) == 9000.0


def test_life_factor():
    """By hand at kappa = 2.45, e_C C_u/P = 0.107: 0.1 (1 - 0.7374 x 0.4747)^-9.3 = 5.50; its limits; no jump where its equations
    meet beyond their rounding (1e-3).
    """
    assert life_factor(2.45, 0.107) == pytest.approx(5.50, rel=2e-3)
    assert life_factor(2.0, 0.0) == pytest.approx(0.1) and life_factor(4.0, 1.0) == 50.0
    assert life_factor(9.0, 0.1) == life_factor(4.0, 0.1) and life_factor(0.09, 1.0) == 0.1
    for kappa in (0.4, 1.0):
        below, above = (life_factor(kappa * (1.0 + step), 0.2) for step in (-1e-9, 1e-9))
        assert below == pytest.approx(above, rel=1.5e-3)
    grid = [[life_factor(kappa, load) for load in np.geomspace(1e-3, 0.3, 20)] for kappa in np.geomspace(0.11, 4.0, 30)]
    assert np.all(np.diff(grid, axis=0) >= 0.0) and np.all(np.diff(grid, axis=1) >= 0.0)


def test_contamination_factor():
    """By hand at kappa = 1.03, d_m = 85 mm, normal: 0.0432 x 1.0203 x 11.51 (1 - 1.141/4.397) = 0.3757; large bearings come into
    the ranges of the standard's table (high 0.9 to 0.8, normal 0.8 to 0.6), and dirtier oil is worse.
    """
    assert contamination_factor("normal", 1.03, 0.085) == pytest.approx(0.3757, rel=1e-3)
    assert 0.8 <= contamination_factor("high", 1.0, 0.2) <= 0.9
    assert 0.6 <= contamination_factor("normal", 1.0, 0.2) <= 0.8
    for group in (list(CLEANLINESS)[:5], list(CLEANLINESS)[5:10], list(CLEANLINESS)[10:]):
        found = [contamination_factor(name, 0.7, 0.06) for name in group]
        assert found == sorted(found, reverse=True) and len(set(found)) == len(found)
    assert fatigue_load_limit(22e3, 0.08) == 1e3 and fatigue_load_limit(22e3, 0.4) == pytest.approx(500.0)


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("Normal", "normal"),
        ("20/17/14", "-/17/14"),
        ("-/16/13", "-/17/14"),
        ("15/12", "-/15/12"),
        ("17/14/11  filtered", "-/15/12 filtered"),
        (0.4, 0.4),
        ("0.4", 0.4),
        (0, 0.0),
    ],
)
def test_cleanliness_as_it_is_written(written, meant):
    assert raceways.cleanliness_of(written) == meant


@pytest.mark.parametrize("written", [1.2, -0.1, "clean", "26/24/21", "", True, math.nan])
def test_other_cleanliness_is_refused(written):
    with pytest.raises(UserError, match="allowed"):
        raceways.cleanliness_of(written)


def test_lives_at_a_point(case):
    """By hand at F_r = 0.1 C without axial load: L_10 = 1000; a_ISO by kappa and C_u = C_0/22 at P, and at P_ref."""
    case = at(case, shaft__F_x=0.0, shaft__F_y=0.1 * case.catalogue["C"])
    found, state = raceways.rated(case), case.standard_equilibrium()
    assert found.lives["L_10"] == pytest.approx(1000.0) and found.lives["L_10r"] == state.L_10r
    assert found.turns == pytest.approx(60.0 * case.values["shaft.omega"] * 60.0 / TURN)
    limit = contamination_factor("normal", case.kappa, case.bearing.d_m) * case.catalogue["C_0"] / 22.0
    for kind, P in (("L_10", 0.1 * case.catalogue["C"]), ("L_10r", state.P_ref)):
        ratio = found.lives[f"{kind}m" if kind == "L_10" else "L_10mr"] / found.lives[kind]
        assert ratio == pytest.approx(life_factor(case.kappa, limit / P), rel=1e-12) and ratio > 2.0


def test_the_ring_that_turns_goes_through_the_load(case):
    """ISO/TS 16281: exponents 3 for the ring that turns, 10/3 for the one that stands, so that a turning outer ring changes the
    weights alone; under an axial load, equal at all balls, nothing changes.
    """
    omega = case.values["shaft.omega"]
    inner, outer, both = (
        at(case, shaft__omega=a, housing__omega=b).standard_equilibrium()
        for a, b in ((omega, 0.0), (0.0, omega), (omega, -omega))
    )
    np.testing.assert_array_equal(inner.Q_i, outer.Q_i)

    def equivalents(state, p_i, p_e):
        return np.mean(state.Q_i**p_i) ** (1 / p_i), np.mean(state.Q_e**p_e) ** (1 / p_e)

    (i, e), (i_3, e_3), (i_2, e_2) = (equivalents(inner, *p) for p in ((3, 10 / 3), (10 / 3, 3), (3, 3)))
    failed = [state.L_10r ** (-10 / 9) for state in (inner, outer, both)]
    weights = np.linalg.solve([[i ** (10 / 3), e ** (10 / 3)], [i_3 ** (10 / 3), e_3 ** (10 / 3)]], failed[:2])
    assert weights @ [i_2 ** (10 / 3), e_2 ** (10 / 3)] == pytest.approx(failed[2], rel=1e-9)
    assert np.all(weights > 0.0) and inner.L_10r > 1.02 * outer.L_10r
    axial = [
        at(case, shaft__F_y=0.0, shaft__F_x=3e3, shaft__omega=a, housing__omega=b)
        for a, b in ((omega, 0.0), (0.0, omega))
    ]
    assert len({round(each.standard_equilibrium().L_10r, 6) for each in axial}) == 1


def test_makers_values(tmp_path):
    """C_u and the minimum load of a maker take the place of the rules."""
    file = tmp_path / "own.toml"
    file.write_text('designation = "6212"\n[catalogue]\nC_u = "3 kN"\nminimum_load = "6 kN"\n')
    own, plain = raceways.rated(bearing_case(file)), raceways.rated(bearing_case("6212"))
    assert own.slips and own.least == 6e3 and not plain.slips and plain.least == pytest.approx(0.01 * 47.7e3, rel=0.01)
    assert own.lives["L_10mr"] > 1.5 * plain.lives["L_10mr"] and own.lives["L_10r"] == plain.lives["L_10r"]
    output = typed("info", file).output
    assert "less than the minimum load 6e+03 N" in output and "L_10mr with a_ISO, normal cleanliness," in output
    assert "e_C = 0.5" in typed("info 6212 --cleanliness 0.5").output


# Missions -------------------------------------------------------------------------------------------------------------


def mission_of(model, blocks, tmp_path, **document):
    return plan_mission("test", {"point": blocks} | document, model, tmp_path / "test.toml")


def test_palmgren_miner_over_revolutions(model, tmp_path):
    """Two points by hand: 4 h with twice the revolutions of the other 6 h."""
    low, high = {"shaft.F_y": 1500.0, "shaft.omega": 500.0}, {"shaft.F_y": 3000.0, "shaft.omega": 1000.0}
    both, first, second = (
        mission_of(model, blocks, tmp_path, life={"cleanliness": "high"}).raceways()
        for blocks in (
            [{"hours": 6, "inputs": low}, {"hours": 4, "inputs": high}],
            [{"hours": 1, "inputs": low}],
            [{"hours": 1, "inputs": high}],
        )
    )
    for kind in raceways.KINDS:
        expected = 10.0 / (6.0 / first.life(kind) + 4.0 / second.life(kind))
        assert both.life(kind) == pytest.approx(expected, rel=1e-12)
    (_, _, (one,)) = second.points[0]
    assert second.life("L_10") == pytest.approx(1e6 * one.lives["L_10"] * TURN / 1000.0 / 3600.0, rel=1e-12)
    assert both.lives == [both.life("L_10mr")] and both.kappas[0] < both.kappas[1]


def test_inputs_that_vary_in_a_point(model, tmp_path):
    """A load that steps in the middle of what counts is two points of half the hours."""
    settle, end = 0.05, 0.25
    steps = {"t": [0.0, 0.5 * (settle + end)], "value": [1000.0, 2500.0], "interpolation": "hold"}
    varying = mission_of(
        model,
        [{"hours": 2, "inputs": {"shaft.F_y": steps}}],
        tmp_path,
        simulation={"t_end": end},
        parameters={"start.settle": settle},
    )
    halves = mission_of(
        model,
        [{"hours": 1, "inputs": {"shaft.F_y": value}} for value in (1000.0, 2500.0)],
        tmp_path,
        simulation={"t_end": end},
    )
    assert varying.raceways().life("L_10mr") == pytest.approx(halves.raceways().life("L_10mr"), rel=1e-9)


def test_what_has_no_rating_is_told(model, tmp_path):
    found = mission_of(model, [{"hours": 1, "parameters": {"ring.motion": "prescribed"}}], tmp_path).raceways()
    (text,) = raceways.sentences(found)
    assert "rivets only" in text and "prescribed" in text and raceways.record(found) == {"untold": found.untold}
    with pytest.raises(UserError, match=r"life\.cleanliness = 'clean'.*high, normal"):
        mission_of(model, [{"hours": 1}], tmp_path, life={"cleanliness": "clean"})


def test_points_below_the_minimum_load_are_told(model, tmp_path):
    light = {"name": "light", "hours": 1, "inputs": {"shaft.F_y": 20.0, "shaft.F_x": 0.0}}
    mission = mission_of(model, [light, {"name": "heavy", "hours": 1}], tmp_path)
    assert any("point light: less than the minimum load (0.074 of it)" in text for text in mission.warnings)


def raceways_of(L_10mr, L_10r, given):
    """Raceways with two lives [h]."""
    lives = {"L_10mr": 60e-6 * L_10mr, "L_10r": 60e-6 * L_10r}
    rated = raceways.Rated(60.0, 1e3, 1e2, 1.0, lives)
    return raceways.Raceways((("p", 1.0, (rated,)),), "normal" if given else None)


@pytest.mark.parametrize(
    ("L_10mr", "L_10r", "given", "state", "headline"),
    [
        (30e3, 14e3, True, "good", "Meets the target of 20,000 h"),
        (30e3, 14e3, False, "open", "Target of 20,000 h not safe"),
        (13e3, 14e3, False, "bad", "Misses the target of 20,000 h"),
        (13e3, 24e3, True, "bad", "Misses the target of 20,000 h"),
        (30e3, 24e3, False, "good", "Meets the target of 20,000 h"),
    ],
)
def test_the_verdict_is_of_rivets_and_raceways(L_10mr, L_10r, given, state, headline):
    """Rivets that live 50,000 h do not make a bearing whose raceways live 14,000 h meet 20,000 h."""
    evidence = Evidence(
        50e3,
        40e3,
        60e3,
        "rivet 1, head",
        "",
        None,
        (),
        (),
        {},
        "run",
        1,
        (),
        raceways=raceways_of(L_10mr, L_10r, given),
    )
    found = sheet.judged(evidence, 20e3)
    assert found[:2] == (state, headline)
    assert found[2].startswith("rivets 50,000 h, at least 40,000 h; raceways L_10mr ")
    (line,) = (check for check in verdict.raceway_checks(evidence, 20e3) if check.title == "Raceways")
    assert line.state == state and line.use == pytest.approx(20e3 / (L_10mr if given else min(L_10mr, L_10r)))


def test_a_verdict_of_rivets_only_says_so():
    evidence = Evidence(
        50e3, 40e3, 60e3, "rivet 1, head", "", None, (), (), {}, "run", 1, (), raceways=raceways.Raceways(untold="no C")
    )
    state, headline, reason = sheet.judged(evidence, 20e3)
    assert (state, headline) == ("good", "Rivets meet the target of 20,000 h") and "raceways not judged: no C" in reason


def test_life_and_summary_name_both(tmp_path):
    (tmp_path / "trial.toml").write_text(
        '[simulation]\nt_end = "12 ms"\n[parameters]\nstart.settle = "4 ms"\n[[point]]\nhours = 1\n[life]\nmax_seeds = 3\ncleanliness = "high"\n'
    )
    done = command("life", "trial.toml", "--workers", 1, folder=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "Life of the rivets" in done.stdout and "Life of the raceways" in done.stdout
    assert "(ISO/TS 16281)" in done.stdout
    found = json.loads((tmp_path / "results" / "trial" / "life.json").read_text())["raceways"]
    assert found["cleanliness"] == "high" and 0.0 < found["L_10r_h"] < found["L_10mr_h"]
    done = command("summary", "trial.toml", "--target", "1e-9 h", folder=tmp_path)
    assert "Meets the target" in done.stdout and "raceways L_10mr" in done.stdout, done.stderr


def test_a_result_has_the_raceways_of_its_fmu(model):
    """What a run's file says of its inputs and parameters is the same operating point as its scene."""
    document = {"simulation": {"t_end": 0.02}, "parameters": {"start.settle": 0.01}}
    document["inputs"] = {"shaft.F_y": 2000.0, "shaft.omega": {"t": [0, 0.02], "value": [800.0, 900.0]}}
    scene = load_scene(None, model, ("test", document))
    found = raceways.of_result(model, simulate(model, scene))
    (_, _, samples), *_ = found.points
    assert [samples[0].turns, samples[-1].turns] == pytest.approx([t * 3600.0 / TURN for t in (850.0, 900.0)], rel=3e-3)
    assert samples[0].load == 2000.0 and raceways.of_result(None, None).untold


# Static and swing stress, long lives, early ends ----------------------------------------------------------------------


def test_static_stress_and_swing():
    """The rivet with the largest mean is not the one that swings most."""
    values = {"stat.rivet_head_mean[1]": [100.0], "stat.rivet_head_p999[1]": [110.0]}
    values |= {"stat.rivet_head_mean[2]": [60.0], "stat.rivet_head_p999[2]": [100.0], "stat.rivet_mid_mean[1]": [7.0]}
    assert [float(part[0]) for part in static_and_swing(values, "head")] == [100.0, 40.0]


@pytest.mark.parametrize(
    ("life", "static", "swing", "words"),
    [
        (2.5, 2.0, 0.9, "2 times the static stress: damage follows the swing, 0.9"),
        (2.5, 0.8, 0.9, ""),
        (0.4, 0.7, 1.1, "0.7 times the static stress"),
    ],
)
def test_designs_tell_static_stress_from_swing(life, static, swing, words):
    """Brass: twice the head stress and a longer life is told, since the swing is smaller."""
    ratio = designs.Ratio(life, 0.9 * life, 1.1 * life, 0.0)
    parts = {"head_static": (2e8, SimpleNamespace(ratio=static)), "head_swing": (5e7, SimpleNamespace(ratio=swing))}
    outcome = designs.Outcome(None, SimpleNamespace(life=1e3), "rivet 1, head", ratio, {"calm": parts}, "calm")
    text = designs_page.verdict(outcome)
    assert text.startswith("lives longer" if life > 1.0 else "lives shorter")
    assert (words in text) if words else "static" not in text
    assert designs_page.parts_text(outcome) == f"200 ({static:g}) + 50 ({swing:g}) MPa"


@pytest.mark.parametrize(
    ("now", "apart"), [((2e8, 4e7), True), ((1.03e8, 4e7), False), ((2e8, 6e7), False), ((9e7, 6e7), True)]
)
def test_an_optimum_tells_static_stress_from_swing(now, apart):
    assert go_apart(np.array([1e8, 5e7]), np.array(now)) == apart


def test_a_life_beyond_telling_has_no_bell():
    """5.1e9 h is printed as > 1e6 h: neither its interval nor its density is drawn."""
    estimate = SimpleNamespace(life=5.1e9, low=4.5e9, high=5.8e9, half_width=0.13)
    life = SimpleNamespace(estimate=estimate, low=4.5e9, mission=None)
    figure = plt.figure()
    page.life_chart(figure, life)
    (ax,) = figure.axes
    assert not ax.lines and not ax.collections and "> 1e6 h" in ax.texts[0].get_text()
    assert "%" not in page.width_text(life)
    plt.close(figure)


def test_revolutions_end_with_the_run(model):
    """A speed that rises to 30,000 rev/min over 0.3 s, and a run that ends at 51 ms: turns up to there, and no note of a
    speed that the shaft never had.
    """
    top = 30000.0 * TURN / 60.0
    scene = load_scene(None, model, ("test", {"simulation": {"t_end": 0.3}, "parameters": {"start.settle": 0.02}}))
    scene = replace(scene, inputs=scene.inputs | {"shaft.omega": History(np.array([0.0, 0.3]), np.array([0.0, top]))})
    found = turns(model, scene, 0.051)
    assert found["settle_turns"] == pytest.approx(0.5 * top / 0.3 * 0.02**2 / TURN, rel=1e-9)
    assert sum(found.values()) == pytest.approx(0.5 * top / 0.3 * 0.051**2 / TURN, rel=1e-9)
    weak = {"scene.stress": "fatigue", "scene.breakage": "on", "fatigue.acceleration": 1e15, "fatigue.sigma_D": 3e7}
    result = simulate(model, replace(scene, parameters=scene.parameters | weak))
    end = float(result.data["time"][-1])
    assert result.stopped and end < 0.2
    assert result.about["settle_turns"] + result.about["count_turns"] == pytest.approx(
        0.5 * top / 0.3 * end**2 / TURN, rel=1e-9
    )
    assert speed_note(result) == ""


@pytest.mark.parametrize(("turns", "told"), [(10.0 * (1.0 - 1e-12), False), (9.4, True), (0.0, False)])
def test_ten_revolutions_are_ten(turns, told):
    """12,000 rev/min over 0.05 s are 10 revolutions less a few last digits."""
    result = SimpleNamespace(
        about={"settle_turns": turns, "count_turns": turns},
        parameters={"start.settle": 0.05},
        data={"time": [0.0, 0.1]},
    )
    assert bool(settle_note(result)) == bool(count_note(result)) == told
