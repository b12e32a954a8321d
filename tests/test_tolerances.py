"""Scatter of life: the Weibull law against published field lives of bearing cages, and bearings drawn from tolerances."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from scipy import stats

from bearing_model.generated.variables import MeanStress
from bearing_model.instance.fatigue import FatigueLaw, fatigue_cycle
from riveted_bearing import UserError
from riveted_bearing.bearing.strength import cycles_to_failure, damage_of_matrix, read_strength
from riveted_bearing.duty.assess import assess
from riveted_bearing.duty.mission import plan_mission
from riveted_bearing.duty.tolerances import read_tolerances, scatter, write_scatter
from riveted_bearing.duty.weibull import fit_weibull, write_weibull_plot

# h, failures of cages of 1,703 aircraft engines: Abernethy, Breneman, Medlin and Reinman (1983)
CAGES = (230, 334, 423, 990, 1009, 1510)
RUNNING = {
    50: 288,
    150: 148,
    250: 124,
    350: 111,
    450: 106,
    550: 99,
    650: 110,
    750: 114,
    850: 119,
    950: 127,
    1050: 123,
    1150: 93,
    1250: 47,
    1350: 41,
}
RUNNING |= {1450: 27, 1550: 11, 1650: 6, 1850: 1, 2050: 2}  # h: engines without a failure
Z = 9


def test_field_lives_of_bearing_cages(tmp_path):
    """Meeker and Escobar (1998), chapter 8, for these data: shape 2.035, scale 11,792 h, B10 3,903 h."""
    law = fit_weibull(CAGES, list(RUNNING), [1] * len(CAGES) + list(RUNNING.values()))
    assert len(CAGES) + sum(RUNNING.values()) == 1703
    assert law.beta == pytest.approx(2.035, rel=1e-3) and law.eta == pytest.approx(11792, rel=1e-3)
    assert law.b10 == pytest.approx(3903, rel=1e-3)
    assert law.b10_interval[0] < law.b10 < law.b10_interval[1] and len(law.lives) == 6
    assert write_weibull_plot(law, "cages", tmp_path / "w.png").stat().st_size > 10000


def test_the_interval_of_b10_covers_it():
    """Sixty samples of thirty lives of a known law; the interval of the Fisher matrix at 90 % holds B10 in 80 to 98 %."""
    rng = np.random.default_rng(1)
    b10 = 100.0 * (-math.log(0.9)) ** (1 / 2.5)
    laws = [fit_weibull(100.0 * rng.weibull(2.5, 30)) for _ in range(60)]
    assert 0.8 <= np.mean([law.b10_interval[0] <= b10 <= law.b10_interval[1] for law in laws]) <= 0.98
    assert np.mean([law.beta for law in laws]) == pytest.approx(2.5, rel=0.1)


@pytest.mark.parametrize("lives", [[1.0, 2.0], [3.0, 3.0, 3.0], [1.0, -2.0, 3.0], [1.0, 2.0, math.inf]])
def test_lives_without_a_law_are_refused(lives):
    with pytest.raises(UserError, match="a Weibull law needs"):
        fit_weibull(lives)


DOCUMENT = {
    "simulation": {"t_end": 0.01},
    "parameters": {"start.settle": 0.002},
    "point": [
        {"name": "often", "hours": 9, "preload_factor": 0.5},
        {"name": "seldom", "hours": 1, "inputs": {"shaft.omega": 900.0}},
    ],
    "life": {"rivets": "alike"},
    "tolerance": {
        "bearings": 400,
        "seeds": 2,
        "share": 0.9,
        "parameters": {"joint.preload": {"distribution": "lognormal", "median": "20 N", "factor": 1.1}},
    },
}


def planned(model, **tolerance):
    document = DOCUMENT | {"tolerance": DOCUMENT["tolerance"] | tolerance}
    mission = plan_mission("trial", document, model, Path("trial.toml"))
    return mission, read_tolerances(mission, model)


def test_lives_scatter_as_the_tolerance_does(tmp_path, model):
    """Damage grows with preload^8 at the one point that counts; the other point has 1 % of the damage and keeps it:
    lives by hand from what was drawn, and what was drawn follows its law (Kolmogorov and Smirnov's test, 400 bearings).
    """
    mission, tolerances = planned(model)
    nominal = np.array([1e-4, 1e-5])[:, None, None] * np.ones((2, Z, 2))
    life = assess(
        mission, lambda counts: [np.repeat(rate[None], n, axis=0) for rate, n in zip(nominal, counts, strict=True)]
    )

    def runs_of(bearings):
        assert {case.part for case in bearings.cases} == {0}
        preload = [case.scene.parameters["joint.preload"] for case in bearings.cases]
        # 10 N: half of 20 N
        return lambda counts: [np.full((n, Z, 2), 1e-4 * (P / 10.0) ** 8) for P, n in zip(preload, counts, strict=True)]

    found = scatter(life, tolerances, model, tmp_path, None, runs_of=runs_of)
    preload = found.draws["joint.preload"]
    assert stats.kstest(np.log(preload / 20.0), stats.norm(0.0, math.log(1.1)).cdf).pvalue > 0.01
    np.testing.assert_allclose(found.lives, 1 / (0.9e-4 * (preload / 20.0) ** 8 + 0.1e-5), rtol=1e-12)
    assert found.noise == 0.0
    answer = json.loads(write_scatter(found, tmp_path / "b.json").read_text())
    assert answer["b10_h"] == found.law.b10 and len(answer["lives_h"]) == len(answer["drawn"]["joint.preload"]) == 400


def test_seeds_have_their_share_of_the_scatter(tmp_path, model):
    """Nothing but seeds: their share is about all of it."""
    mission, tolerances = planned(model, seeds=4)
    rng = np.random.default_rng(1)
    life = assess(mission, lambda counts: [np.full((n, Z, 2), 1e-4) for n in counts])
    found = scatter(
        life,
        tolerances,
        model,
        tmp_path,
        None,
        runs_of=lambda bearings: (
            lambda counts: [1e-4 * np.exp(0.3 * rng.normal(size=(n, 1, 1))) * np.ones((n, Z, 2)) for n in counts]
        ),
    )
    assert found.noise == pytest.approx(1.0, abs=0.25)


# S-N curves -----------------------------------------------------------------------------------------------------------

LAW = FatigueLaw(sigma_D=250e6, N_D=2e6, k_1=8.0, k_2=15.0, mean_stress=int(MeanStress.GOODMAN))


@pytest.mark.parametrize(
    ("rule", "below"), [("knee", 15.0), ("haibach", 15.0), ("elementary", 8.0), ("original", math.inf)]
)
def test_rules_below_the_knee(rule, below):
    strength = read_strength("m.toml", {"rule": rule}, LAW)
    N = cycles_to_failure(strength, np.array([500e6, 125e6]))
    assert N[0] == pytest.approx(2e6 * 2.0**-8, rel=1e-12)
    assert N[1] == pytest.approx(2e6 * 2.0**below, rel=1e-12)


def test_a_matrix_has_the_damage_of_its_cycles():
    """Three cycles of one channel and one of another by the FMU's own law: to rounding, with Goodman's correction, and
    breaking at most once.
    """
    matrix = (
        np.array([0, 0, 3]),
        np.array([300e6, 400e6, 5e9]),
        np.array([100e6, -50e6, 0.0]),
        np.array([2.0, 0.5, 3.0]),
    )
    expected = [2 * fatigue_cycle(LAW, 300e6, 100e6) + 0.5 * fatigue_cycle(LAW, 400e6, -50e6), 0, 0, 3.0]
    assert damage_of_matrix(read_strength("m.toml", {}, LAW), matrix, 4) == pytest.approx(expected, rel=1e-12)


def test_survival_moves_the_curve_by_its_scatter():
    """T_S = strength of 90 % over that of 10 % = 1.25 is 2 x 1.2816 standard deviations of lg; survival 0.9 is 1.2816
    below the middle.
    """
    strength = read_strength("m.toml", {"T_S": 1.25, "survival": 0.9}, LAW)
    assert cycles_to_failure(strength, np.array([400e6]))[0] == pytest.approx(
        2e6 * (400 / (250 / math.sqrt(1.25))) ** -8, rel=1e-4
    )


def test_factors_of_the_guideline():
    """FKM (2012) by hand for steel, R_m 785 MPa, R_z 25 um: K_R = 1 - 0.22 lg 25 lg(2 x 785/400); A_90 5 instead of 500
    mm^2: (100)^(1/30).
    """
    smooth = read_strength("m.toml", {"R_z": "0.5 um"}, LAW).factor
    rough = read_strength("m.toml", {"R_z": "25 um", "A_90": 5.0, "A_90_specimen": 500.0}, LAW).factor
    assert smooth == 1.0
    assert rough == pytest.approx((1 - 0.22 * math.log10(25) * math.log10(2 * 785 / 400)) * 100 ** (1 / 30), rel=1e-12)


def test_a_table_is_read_between_and_beyond_its_points(tmp_path):
    """Points of a Basquin line of slope 5: the line, also outside; with scatter the line moves."""
    (tmp_path / "curve.csv").write_text("# own tests\namplitude,cycles\n400,1e4\n200,3.2e5\n")
    strength = read_strength(tmp_path / "m.toml", {"file": "curve.csv", "unit": "MPa"}, LAW)
    amplitudes = np.array([800e6, 300e6, 100e6])
    assert cycles_to_failure(strength, amplitudes) == pytest.approx(1e4 * (amplitudes / 400e6) ** -5, rel=1e-9)
    weaker = read_strength(tmp_path / "m.toml", {"file": "curve.csv", "unit": "MPa", "T_S": 1.25, "survival": 0.9}, LAW)
    assert cycles_to_failure(weaker, np.array([300e6]))[0] == pytest.approx(
        1e4 * (300 / 400 * math.sqrt(1.25)) ** -5, rel=1e-3
    )


def test_a_curve_comes_from_a_file(tmp_path):
    (tmp_path / "steel.toml").write_text('sigma_D = "300 MPa"\nk_1 = 6\nrule = "elementary"\n')
    strength = read_strength(tmp_path / "m.toml", {"file": "steel.toml", "k_1": 7}, LAW)
    assert cycles_to_failure(strength, np.array([150e6]))[0] == pytest.approx(2e6 * 2.0**7, rel=1e-12)


@pytest.mark.parametrize(
    ("section", "fragments"),
    [
        ({"rule": "gassner"}, ["rule = 'gassner'", "knee, haibach"]),
        ({"sigma_D": "3 kg"}, ["sigma_D = '3 kg'", "Pa, MPa"]),
        ({"sigma_D": -1}, ["sigma_D = -1", "greater than 0"]),
        ({"survival": 1.0}, ["survival = 1.0", "below 1"]),
        ({"T_S": 1.2, "T_N": 3}, ["give one of them"]),
        ({"T_S": 0.8}, ["T_S = 0.8", "from 1 on"]),
        ({"mean_stress": "gerber"}, ["mean_stress = 'gerber'", "goodman"]),
        ({"file": "no.csv"}, ["no.csv", "no such file"]),
        ({"file": "bad.csv"}, ['column "cycles"']),
        ({"slope": 3}, ['"slope"']),
        ({"sigma_D": 250}, ["sigma_D = 250", "1 MPa", '"250 MPa" has its unit']),
        ({"file": "plain.csv"}, ["plain.csv", "amplitude = 120 Pa", "1 MPa", 'unit = "MPa"']),
    ],
)
def test_what_a_curve_cannot_say_is_refused(tmp_path, section, fragments):
    (tmp_path / "plain.csv").write_text("amplitude,cycles\n120,1e7\n400,1e4\n")
    (tmp_path / "bad.csv").write_text("amplitude,N\n1,2\n")
    with pytest.raises(UserError) as refused:
        read_strength(tmp_path / "m.toml", section, LAW)
    for fragment in fragments:
        assert fragment in str(refused.value)
