"""How wrong a number is: parts of an error, their rule, what decides in one bearing, and accuracies that are asked for."""

import json
import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from commands import command
from scipy import stats

import riveted_bearing as rb
from riveted_bearing import UserError
from riveted_bearing.base.units import certain, hours_text, with_error
from riveted_bearing.bearing.assumed import all_assumed, assumed_rows
from riveted_bearing.running import accuracy, budget, screen, screening, seeds
from riveted_bearing.running.accuracy import BLOCKS, Found, found_of, spread_of
from riveted_bearing.running.fmu import Model
from riveted_bearing.running.scene import load_scene

SCENES = 400  # of synthetic runs; the standard error of a share of 0.9 is 1.5 %


# The rule -------------------------------------------------------------------------------------------------------------


def test_parts_add_by_the_rule():
    """Shifts 1 and -3 add to -2; 3 and 4 below make 5, 5 and 12 above make 13."""
    parts = (budget.Part("a", 1.0, 3.0, 5.0, ""), budget.Part("b", -3.0, 4.0, 12.0, ""))
    found = budget.Budget("stress", 100.0, parts)
    assert (found.low, found.high) == (pytest.approx(93.0, rel=1e-12), pytest.approx(111.0, rel=1e-12))
    assert budget.of_record(json.loads(json.dumps(found.record()))) == found


def test_largest_part_stands_first_and_an_effect_loses_its_scatter():
    """+30 ± 5 % of 200 MPa: (30^2 - 5^2)^(1/2) = 29.58 %, and -4 ± 5 % is nothing."""
    effect = {"stress": [[-0.04, 0.05], [0.30, 0.05]]}
    row = SimpleNamespace(name="joint.fit", words=("-8 um", "-16 … 0 um"), source="a book", effect=effect)
    found = Found(200e6, 200e6, 1e6, 4e6, 2e6, False, (4, 2))
    made = budget.budget_of("stress", found, {}, {}, {}, [row])
    assert [part.name for part in made.parts] == ["joint.fit", "seeds", "numerical"]
    assert (made.parts[0].below, made.parts[0].above) == (0.0, pytest.approx(200e6 * math.sqrt(0.30**2 - 0.05**2)))


def test_the_tables_own_error_counts():
    """RMS 2.4 % of a largest stress of 661 MPa is 15.9 MPa, times 1.645 for 90 %; of an older FMU without that stress the
    percentage of the number itself.
    """
    written = "Stress table of the rivets: coarse finite elements, error at 320 loads: RMS 2.4 %, largest 8.9 % of the largest stress"
    for text, expected in ((f"{written}, 661 MPa", 0.024 * 661e6), (written, 0.024 * 300e6)):
        parts = list(budget.table_parts({"model": text}, {"rivet.table_kind": 2.0}, 300e6, 1.0, "stress", 300e6))
        assert parts[0].above == pytest.approx(1.6448536 * expected, rel=1e-6)
        assert (parts[1].shift, parts[1].above) == (pytest.approx(-0.0035 * 300e6), pytest.approx(0.0385 * 300e6))


# Step and seeds -------------------------------------------------------------------------------------------------------


def test_a_bias_without_scatter_is_taken_as_it_is():
    """Plain runs at 100, finer ones at 103: the value is 103, open are the 3, if the finer run has half of the plain one's error."""
    found = found_of("stress", [100.0] * 4, [103.0] * 4)
    assert (found.value, found.shift, found.seeds) == (103.0, 3.0, 0.0)
    assert found.numerical == pytest.approx(3.0, rel=1e-12)


def test_without_a_finer_run_the_blind_scenes_stand_for_it():
    found = found_of("stress", [100.0, 102.0])
    assert found.numerical == pytest.approx(stats.norm.ppf(0.95) * 0.014 * 101.0, rel=1e-12)
    assert found.seeds == pytest.approx(stats.t.ppf(0.95, 1) * math.sqrt(2.0) / math.sqrt(2.0), rel=1e-12)


@pytest.mark.parametrize(("n", "m", "noise"), [(4, 4, 0.01), (4, 4, 0.05), (6, 3, 0.02), (2, 1, 0.01)])
def test_intervals_hold_the_truth_of_chaotic_runs(n, m, noise):
    """Biases as in the blind scenes, runs and finer runs that scatter independently: 90 % intervals hold the truth in 85 to 97 %."""
    rng, held = np.random.default_rng(5), 0
    for _ in range(SCENES):
        truth, bias = 100.0, 1.4 * rng.normal()
        x, y = truth + bias + 100.0 * noise * rng.normal(size=n), truth + 100.0 * noise * rng.normal(size=m)
        blocks = (100.0 * noise) ** 2 * rng.chisquare(BLOCKS - 1, n) / (BLOCKS - 1)
        found = found_of("stress", x, y, blocks)
        held += abs(found.value - truth) <= found.half
    assert 0.85 <= held / SCENES <= 0.97


def slow(rng, count, memory):
    """A motion: a series of variance 1 that remembers `memory` samples."""
    a, x = math.exp(-1.0 / memory), np.empty(count)
    x[0] = rng.normal()
    for i in range(1, count):
        x[i] = a * x[i - 1] + math.sqrt(1.0 - a * a) * rng.normal()
    return x


def seeds_of(kind, rng, n=4, count=400, memory=8.0):
    """Means of n runs and their block variances: of independent motions, of one that all seeds have, of motions with levels of their
    own.  The long run's mean is 0.
    """
    common = slow(rng, count, memory)
    runs = []
    for _ in range(n):
        run = common + 0.001 * rng.normal(size=count) if kind == "one motion" else slow(rng, count, memory)
        runs.append(run + (rng.normal() if kind == "several motions" else 0.0))
    blocks = [np.var([part.mean() for part in np.array_split(run, BLOCKS)], ddof=1) / BLOCKS for run in runs]
    return np.array([run.mean() for run in runs]), blocks


@pytest.mark.parametrize("kind", ["independent", "one motion", "several motions"])
def test_seeds_are_honest(kind):
    """The 90 % interval of four seeds holds the long run in 85 to 95 % of scenes, also where all seeds fall on one motion: there the
    seeds alone hold it in hardly any.
    """
    rng, held, alone, told = np.random.default_rng(11), 0, 0, 0
    for _ in range(SCENES):
        x, blocks = seeds_of(kind, rng)
        V, freedom, common = spread_of(x, blocks)
        half = stats.t.ppf(0.95, freedom) * math.sqrt(V / len(x) + common)
        held, told = held + (abs(x.mean()) <= half), told + (common > 0.0)
        alone += abs(x.mean()) <= stats.t.ppf(0.95, len(x) - 1) * x.std(ddof=1) / math.sqrt(len(x))
    assert 0.85 <= held / SCENES <= 0.95
    assert (alone / SCENES < 0.05) == (kind == "one motion") and (told / SCENES > 0.9) == (kind == "one motion")


@pytest.mark.parametrize("far", [0.1, 0.2])
def test_damages_of_two_peaks_are_held(far):
    """Logarithms of damage of which a tenth or a fifth lie five standard deviations off, as the blind scenes have them (excess kurtosis
    2.4 and 0.2): 90 % intervals of four seeds hold the mean in 85 to 97 %, and by a normal scatter in fewer.
    """
    rng, held, normal = np.random.default_rng(7), 0, 0
    for _ in range(5 * SCENES):
        x = np.where(rng.random(4) < far, 5.0, 0.0) + rng.normal(size=4)
        off, scatter = abs(x.mean() - 5.0 * far), x.std(ddof=1) / 2.0
        V, freedom, _ = spread_of(x, (), accuracy.KURTOSIS["damage"])
        assert V == pytest.approx(4.0 * scatter**2) and freedom == pytest.approx(2.0 / (2.0 / 3.0 + 2.3 / 4.0))
        held, normal = (
            held + (off <= stats.t.ppf(0.95, freedom) * scatter),
            normal + (off <= stats.t.ppf(0.95, 3) * scatter),
        )
    assert 0.85 <= held / (5 * SCENES) <= 0.97 and normal < held - 0.05 * 5 * SCENES


PULSED = {"pulse.F_r": 1000.0, "pulse.t_start": 0.08, "pulse.interval": 4e-3}


@pytest.mark.parametrize(("speed", "width"), [("1000 rev/min", 4e-3), ("60000 rev/min", 2.5e-3)])
def test_seeds_differ_in_the_phase_of_pulses(model, speed, width):
    """Four runs begin 0, 1/2, 1/4 and 3/4 of the interval later, or of the cage's turn: at two fifths of 1000 r/s it takes 2.5 ms.  The
    first run and scenes without pulses stay.
    """
    scene = load_scene(None, model, ("test", {"parameters": PULSED, "inputs": {"shaft.omega": speed}}))
    runs = [seeds.seeded(scene, model, 7, s) for s in range(4)]
    begun = [run.parameters["pulse.t_start"] for run in runs]
    assert begun == pytest.approx([0.08 + part * width for part in (0.0, 0.5, 0.25, 0.75)], rel=1e-12)
    assert [run.parameters["start.seed"] for run in runs] == [7, 8, 9, 10]
    plain = load_scene(None, model)
    assert seeds.seeded(plain, model, 7, 1).parameters == plain.parameters | {"start.seed": 8}


def test_the_budget_says_where_pulses_have_other_phases():
    found = Found(200e6, 200e6, 1e6, 4e6, 2e6, False, (4, 2))
    told = {
        name: part.source
        for pulses in (PULSED, {})
        for name, part in [(bool(pulses), [*budget.numerical_parts("stress", found, pulses)][1])]
    }
    assert told == {True: "4 seeds, each with another phase of the pulses", False: "4 seeds"}


# To an accuracy -------------------------------------------------------------------------------------------------------


def stand_in(monkeypatch, bias=(0.0, 0.0, 0.0), noise=0.0, failed=(0.0,), limited=True):
    """Runs that need no FMU: figures of 100 with a bias and failed error tests at each level of the steps, and scatter; 10,000 steps
    take a second.  A tenth of the tolerance takes 3^(1/2) times the steps, if it limits them.
    """
    rng = np.random.default_rng(3)

    def sample(model, scene, whole):
        level = round(limited * math.log10(1e-3 / scene.parameters.get("solver.tol", 1e-3)))
        if step := scene.parameters.get("solver.step"):
            level = round(math.log(scene.t_end / step / 1e4, math.sqrt(3.0)))
        steps = 1e4 * 3.0 ** (0.5 * level)
        value = 100.0 * (1.0 + bias[min(level, len(bias) - 1)] + noise * rng.normal())
        figures = (dict.fromkeys(accuracy.NAMED, x) for x in (value, (100.0 * noise) ** 2))
        return accuracy.Sample(*figures, steps / 1e4, steps, failed[min(level, len(failed) - 1)])

    monkeypatch.setattr(accuracy, "sample", sample)


def reach(model, target, **settings):
    return accuracy.accurate(model, load_scene(None, model), target, **settings)


@pytest.mark.parametrize("failed", [0.0, 0.01])
def test_a_plain_run_that_suffices_costs_less_than_four(model, monkeypatch, failed):
    """Two runs, and a finer one with 3^(1/2) times the steps, be it by the tolerance or by equal steps."""
    stand_in(monkeypatch, noise=0.002, failed=(failed,))
    found = reach(model, 0.02)
    assert found.cost == pytest.approx(2.0 + math.sqrt(3.0)) and (found.settings, found.missed) == ({}, {})


@pytest.mark.parametrize(
    ("failed", "limited", "settings"),
    [
        ((0.01,), True, {"solver.tol": 1e-4}),  # the tolerance limits the steps
        ((0.0,), True, {"solver.step": 1.0 / 3.0**0.5}),  # no step fails: something else limits them
        ((0.01, 0.0), False, {"solver.step": 1.0 / 3.0**0.5}),  # steps fail, but a tenth of the tolerance takes as many
        ((0.0, 0.05, 0.0), True, {"solver.step": 1.0 / 3.0}),  # 5 % of the first equal steps fail: shorter ones
    ],
)
def test_finer_is_what_limits_the_steps(model, monkeypatch, failed, limited, settings):
    """Lengths of steps are relative to the plain run's."""
    stand_in(monkeypatch, failed=failed, limited=limited)
    scene = load_scene(None, model)
    if step := settings.get("solver.step"):
        settings = {"solver.method": "fixed", "solver.step": pytest.approx(step * scene.t_end / 1e4)}
    runs = accuracy.Runs(model, scene, lambda runs: None)
    runs.scene(1)
    assert runs.settings[1] == (settings if step else {"solver.tol": pytest.approx(1e-4)})
    assert accuracy.with_settings(replace(scene, tolerance=1e-3), {"solver.tol": 1e-4}).tolerance is None


def test_a_bias_is_refined_away(model, monkeypatch):
    """9 % by the plain run, 0.5 % with shorter steps: the runs are those with shorter steps, their value is right to 0.5 %."""
    stand_in(monkeypatch, bias=(0.09, 0.005, 0.001), noise=1e-4)
    found = reach(model, 0.01)
    assert found.settings["solver.step"] == pytest.approx(load_scene(None, model).t_end / 1e4 / math.sqrt(3.0))
    assert not found.missed
    assert all(each.value == pytest.approx(100.0, rel=0.005) for each in found.found.values())


def test_a_bias_that_does_not_fall_is_named(model, monkeypatch):
    """The runs with shorter steps lie 6 % lower each time."""
    stand_in(monkeypatch, bias=(0.0, -0.06, -0.12, -0.18), noise=1e-4)
    found = reach(model, 0.01)
    assert set(found.missed) == set(accuracy.NAMED)
    assert all("does not fall with the step" in why for why in found.missed.values())


def test_more_seeds_narrow_scatter(model, monkeypatch):
    """Scatter of 4 % to 2 %: t s/n^(1/2) needs some 16 to 40 seeds."""
    stand_in(monkeypatch, noise=0.04)
    found = reach(model, 0.02)
    assert 12 <= found.found["stress"].runs[0] <= 64 and all(each.within(0.02) for each in found.found.values())


def test_an_accuracy_beyond_the_time_is_refused_with_what_it_takes(model, monkeypatch):
    stand_in(monkeypatch, noise=0.04)
    with pytest.raises(
        UserError, match=r"accuracy 0.1 %: .* is known to .* would take about [\d,]+ seeds, .* 20 s are allowed"
    ) as told:
        reach(model, 0.001, within=20.0)
    seeds = int(str(told.value).partition("about ")[2].partition(" seeds")[0].replace(",", ""))
    assert 2000 < seeds < 200_000  # (1.96 * 4 % / 0.1 %)^2 = 6,100, by the scatter of a few runs


@pytest.mark.parametrize(
    ("given", "why"), [("0 %", "above 0"), ("80 %", "below 0.5"), ("2 N", "does not fit|not a"), (-0.1, "above 0")]
)
def test_what_is_no_accuracy_is_refused(model, given, why):
    with pytest.raises(UserError, match=f"accuracy.*({why})"):
        load_scene(None, model, ("test", {"simulation": {"accuracy": given}}))


def test_an_accuracy_is_refused_where_tolerance_and_seeds_are_given(model):
    from riveted_bearing.running.runner import simulate

    with pytest.raises(UserError, match="simulation.accuracy = 2 %: run and life choose"):
        simulate(model, load_scene(None, model, ("test", {"simulation": {"accuracy": "2 %"}})))


def test_a_run_to_an_accuracy(tmp_path):
    """Against the mean of twelve runs at a tenth of the tolerance, within 5 % and that mean's own scatter."""
    found = rb.run("demo", accuracy="5 %", t_end=0.15)
    told = found.about["accuracy"]["figures"]["stress"]
    assert told["half_width"] <= 0.05 * told["value"] and found.about["accuracy"]["missed"] == {}
    many = [
        rb.run("demo", seed=s, t_end=0.15, tolerance=1e-4, outputs=["ring.y"]).summary["stat.sigma_head_p999"]
        for s in range(50, 62)
    ]
    assert abs(told["value"] - np.mean(many)) <= 0.05 * np.mean(many) + 2.0 * np.std(many, ddof=1) / math.sqrt(12)


# What decides ---------------------------------------------------------------------------------------------------------


@pytest.fixture
def few(monkeypatch, model, tmp_path):
    """A screening of two values, in short runs, kept beside a copy of the FMU."""
    copy = tmp_path / "own.fmu"
    copy.write_bytes(model.path.read_bytes())
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    ranges = {"oil.B": (1.1, 4.4), "ring.J_t": (1e-4, 2e-4)}
    monkeypatch.setattr(screen, "assumed_ranges", lambda model: ranges)
    monkeypatch.setattr(screen, "ranges_of", lambda *_: dict.fromkeys(ranges, SimpleNamespace(source="a book")))
    monkeypatch.setattr(screen, "TEMPERATURES", {})
    monkeypatch.setattr(screen, "SPAN", 0.02)
    return Model(copy)


def mean_of(model, t_end, **settings):
    """Mean stress of three seeds by the Python interface."""
    runs = (rb.run(None, fmu=model.path, seed=s, t_end=t_end, outputs=["ring.y"], **settings) for s in (1, 2, 3))
    return np.mean([run.summary["stat.sigma_head_p999"] for run in runs])


def test_an_effect_is_the_difference_of_runs(few):
    """Mean of three seeds against runs of the Python interface; a tilting inertia moves nothing where the tilt is prescribed."""
    record = screen.screened(few)
    (low, _), _ = record["entries"]["oil.B"]["effect"]["stress"]

    base = mean_of(few, record["t_end"])
    assert low == pytest.approx(mean_of(few, record["t_end"], parameters={"oil.B": 1.1}) / base - 1.0, rel=1e-9)
    assert low != 0.0
    assert record["entries"]["ring.J_t"]["effect"]["stress"] == [[0.0, 0.0], [0.0, 0.0]]


def test_a_screening_is_kept_by_the_digest(few, monkeypatch):
    """Once beside the FMU; in the cache where the folder takes no file; none for another FMU of that name."""
    record = {"version": screening.VERSION, "fmu_sha256": few.digest, "entries": {}}
    screening.keep(few, record)
    beside = few.path.with_name("own.screening.json")
    assert beside.is_file() and screening.known(few) == record
    beside.unlink()
    beside.mkdir()  # where no file can be written
    screening.keep(few, record)
    assert screening.paths(few)[1].is_file() and screening.known(few) == record
    with few.path.open("ab") as file:
        file.write(b"\0")
    assert screening.known(SimpleNamespace(path=few.path, digest="another")) is None


def test_a_drawings_range_takes_the_place_of_the_assumed_one(few, monkeypatch, tmp_path):
    """Of a value with a usual range, of the oil's temperature, and of a rivet's dimension, which is named as not covered; the budget tells
    whose range it is.
    """
    ranges = {"oil.B": (2.0, 3.0), "oil.T": (350.0, 360.0), "rivet.shank_diameter": (2.4e-3, 2.5e-3)}
    monkeypatch.setattr(Model, "ranges", ranges)
    record = screen.screened(few)
    ends = {name: (one["low"], one["high"], one["source"]) for name, one in record["entries"].items()}
    assert ends == {n: (*ranges[n], "your own range") for n in ("oil.B", "oil.T")} | {
        "ring.J_t": (1e-4, 2e-4, "a book")
    }
    assert record["not_covered"] == {"rivet.shank_diameter": screen.OF_BUILD}
    T = {name: few.default(few.inputs[name]) for name in ("oil.T", "ring.T_i", "ring.T_e", "ball.T", "cage.T")}
    hotter = {
        name: own + 360.0 - T["oil.T"] for name, own in T.items()
    }  # nobody gave those of the parts: they move with the oil's
    hot = mean_of(few, record["t_end"], inputs=hotter) / mean_of(few, record["t_end"]) - 1.0
    assert record["entries"]["oil.T"]["effect"]["stress"][1][0] == pytest.approx(hot, rel=1e-9)

    result = rb.run(None, fmu=few.path, t_end=record["t_end"], outputs=["ring.y"])
    about = result.about | {"rivet": {"rivet.shank_diameter": 2.45e-3}}
    rows = {row.name: row for row in all_assumed(about, result.parameters) if row.name in ranges}
    assert rows["oil.T"].words[1] == "76.9 … 86.9 degC"
    assert rows["rivet.shank_diameter"].words == ("2.45 mm", "2.4 … 2.5 mm")
    assert budget.assumed_part(rows["oil.T"], "stress", 1.0).source == "your own range, 76.9 … 86.9 degC"
    assert budget.assumed_part(rows["rivet.shank_diameter"], "stress", 1.0) is None
    assert rows["rivet.shank_diameter"].unknown == screen.OF_BUILD


def of_bearing(entries):
    """What a result of a bearing by rule says, with a screening of its FMU."""
    values = {
        "joint.preload": 49.4,
        "joint.fit": -15.7e-6,
        "cage.pocket_clearance": 0.314e-3,
        "oil.eta": 6e-3,
        "oil.flow": 0.0,
    }
    record = (
        {"entries": entries, "not_covered": {"rivet.fillet_radius": "needs a build"}, "seeds": 3} if entries else {}
    )
    about = {
        "ruled": ["joint.preload"],
        "given": [],
        "rivet": {},
        "example": False,
        "screening": record,
        "temperatures": {},
    }
    return SimpleNamespace(parameters=values, about=about)


def entry(stress, damage):
    pairs = {"stress": [[0.0, 0.01], [stress, 0.01]], "damage": [[0.0, 0.1], [damage, 0.1]]}
    return {"low": 0.0, "high": 1.0, "source": "a book", "effect": pairs}


def test_lists_come_from_the_bearings_own_screening():
    """Ranked by the figure that is judged; an effect within the scatter of the seeds has no size."""
    entries = {"joint.fit": entry(2.89, 0.09), "cage.pocket_clearance": entry(0.28, 0.48), "oil.eta": entry(0.015, 0.1)}
    by_stress, by_damage = (assumed_rows(of_bearing(entries), figure) for figure in ("stress", "damage"))
    assert [row.name for row in by_stress[:2]] == ["joint.fit", "cage.pocket_clearance"]
    assert by_damage[0].name == "cage.pocket_clearance" and by_damage[0].change("damage") == "0 … +0.5 decades"
    assert by_stress[0].change("stress") == "0 … +289 %"
    own = {row.name: row for row in by_stress}
    assert own["oil.eta"].change("stress") == "within the seeds' ±1 %"
    assert own["rivet.fillet_radius"].unknown == "needs a build"


def test_without_a_screening_no_size_is_printed():
    rows = list(all_assumed(of_bearing({}).about, of_bearing({}).parameters))
    assert len(rows) > 10 and not any(row.change(figure) for row in rows for figure in ("stress", "damage"))
    assert all("build --screen" in row.unknown for row in rows)


# Digits ---------------------------------------------------------------------------------------------------------------


def test_no_more_digits_than_are_known():
    assert with_error(289.5, 12.3) == "290 ± 12" and with_error(0.2896, 0.0123) == "0.290 ± 0.012"
    assert with_error(289.5, 20.0, 12.0, 28.0) == "290 (−12 … +28)"
    assert [certain(289.5, half) for half in (0.03, 0.4, 3.0, 12.0, 120.0)] == ["289.50", "289.5", "290", "290", "300"]
    assert [hours_text(12345.0, few) for few in (1, 2, 3)] == ["10,000 h", "12,000 h", "12,300 h"]
    assert [hours_text(0.0123, few) for few in (1, 3)] == ["40 s", "44.3 s"]


def test_life_has_the_digits_of_its_budget():
    def of(half):
        return {"damage": budget.Budget("damage", -4.0, (budget.Part("seeds", 0.0, half, half, ""),))}

    assert [budget.digits(of(half)) for half in (0.5, 0.1, 0.01)] == [1, 2, 3]
    assert budget.life_ends(of(0.5)) == (pytest.approx(10**3.5), pytest.approx(10**4.5))


def test_a_checked_run_says_how_wrong_it_is(tmp_path, few):
    """Terminal and file have the same budget: 90 % and its parts, the largest first."""
    screen.screened(few)
    words = "--check", "--t-end", "80 ms", "--no-plot", "--out", tmp_path / "run.parquet"
    done = command("run", "--fmu", few.path, *words, folder=tmp_path)
    assert done.returncode == 0, done.stderr
    record = rb.read_result(tmp_path / "run.parquet").about["budget"]["stress"]
    sizes = [abs(part["shift"]) + max(part["below"], part["above"]) for part in record["parts"]]
    assert sizes == sorted(sizes, reverse=True)
    assert {"numerical", "seeds", "rivet table"} <= {part["name"] for part in record["parts"]}
    assert budget.told(budget.of_record(record)) in done.stdout
    assert "independent parts" in done.stdout.replace("\n", " ")


def test_the_life_of_a_sheet_is_judged_with_its_error():
    from riveted_bearing.duty import verdict

    seen = SimpleNamespace(
        budgets={"damage": budget.Budget("damage", -4.0, (budget.Part("seeds", 0.0, 0.3, 0.3, ""),))}, life=1e4
    )
    assert verdict.errors_told(seen) == " (5,000 h to 20,000 h with all its errors)"


def test_samples_do_not_keep_the_accuracy(model):
    """Keys of runs are those of before: an accuracy chooses runs and is none of their settings."""
    from riveted_bearing.studies.sweep_file import key_of

    scene = load_scene(None, model)
    assert key_of(scene, "f") == key_of(replace(scene, accuracy=0.02), "f")


def test_blocks_are_of_the_size_of_the_run():
    """A series of 40 blocks' worth of samples with known scatter: RMS of a force that is six times the run's own figure, and stress."""
    rng = np.random.default_rng(2)
    t = np.linspace(0.0, 1.0, 4001)
    data = {
        "time": t,
        "rivet.sigma_head_max": 200e6 + 1e6 * rng.normal(size=t.size),
        "cage.F_pocket_peak": 18.0 + 0.0 * t,
    }
    data["cage.F_pocket_peak"][1001:2001] = 20.0
    result = SimpleNamespace(data=data, parameters={"start.settle": 0.0, "fatigue.k_2": 15.0}, summary={})
    found = accuracy.block_variances(result, {"pocket_force": 3.0, "stress": 203e6, "static": 200e6})
    blocks = np.array([18.0, 20.0, 18.0, 18.0])
    assert found["pocket_force"] == pytest.approx((3.0 / 18.5) ** 2 * blocks.var(ddof=1) / 4, rel=2e-3)
    assert found["static"] == pytest.approx((1e6) ** 2 / 4000, rel=3.0)  # of four blocks: chance by some times
