"""The sheet of a mission or a run: utilisations against closed forms, verdicts, one page of paper whatever stands on
it.
"""

import hashlib
import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from commands import command

from bearing_model.generated.variables import MeanStress
from bearing_model.instance.fatigue import FatigueLaw, fatigue_cycle
from riveted_bearing import UserError, run
from riveted_bearing.bearing.assumed import assumed_rows
from riveted_bearing.duty import evidence, raceways, sheet, verdict
from riveted_bearing.duty.assess import Runs, assess
from riveted_bearing.duty.mission import plan_mission
from riveted_bearing.running.fmu import Model
from riveted_bearing.running.rainflow import cycle_damages
from riveted_bearing.show import report

SHORT = {"simulation": {"t_end": 0.012}, "parameters": {"start.settle": 0.004}}
LIMIT = 297.0 / 25.4 * 96.0  # pixels of a sheet of A4


@pytest.fixture(scope="module")
def result():
    return run("demo", t_end=0.03, parameters={"start.settle": "5 ms"})


@pytest.fixture(scope="module")
def made(result):
    return sheet.result_sheet(result, Path(__file__), target=1e-3)


@pytest.mark.parametrize("rule", MeanStress)
def test_many_cycles_damage_as_each_does(rule):
    """The array form against the scalar law of the twin, over knee, infinite amplitudes and overflow."""
    law = FatigueLaw(mean_stress=rule)
    rng = np.random.default_rng(1)
    span, mean = 10 ** rng.uniform(5, 9.5, 300), rng.uniform(-5e8, 1.3e9, 300)
    span[0] = 1e300
    expected = [fatigue_cycle(law, s, m) for s, m in zip(span.tolist(), mean.tolist())]
    np.testing.assert_allclose(cycle_damages(law, span, mean), expected, rtol=1e-13)
    assert np.min(expected) < 1e-9 and np.max(expected) == 1.0 and len(set(expected)) > 100


def evidence_of(life, low=None, high=None, slope=15.0):
    """Evidence whose lives fall with a power of the stress, the middle's ten times longer."""
    return evidence.Evidence(
        life, low, high, "rivet 1, head", "", lambda x: (life * x**-slope, 10 * life * x**-slope), (1e8, 5e7), (2.5e8, 2e8), {}, "run", 1, (1.0,)
    )  # fmt: skip


def test_utilisation_is_the_power_of_the_lives():
    """Closed form: (target/life)^(1/slope), of the middle another 10^(-1/15)."""
    found = evidence_of(1000.0)
    head, middle = (verdict.fatigue_check(found, place, "", 4000.0) for place in (0, 1))
    assert head.use == pytest.approx(4 ** (1 / 15), rel=2e-3) and head.state == "bad"
    assert middle.use == pytest.approx(0.4 ** (1 / 15), rel=2e-3) and middle.state == "good"
    assert [verdict.fatigue_check(found, place, "", None).use for place in (0, 1)] == pytest.approx(
        [0.4, 0.25], rel=1e-12
    )


@pytest.mark.parametrize(
    ("life", "low", "high", "state"),
    [(2000, 1500, 2600, "good"), (2000, 900, 4000, "open"), (900, 500, 1600, "bad"), (300, 200, 400, "bad"), (math.inf, math.inf, math.inf, "good")],
)  # fmt: skip
def test_the_verdict_needs_the_whole_interval(life, low, high, state):
    found = sheet.judged(evidence_of(float(life), float(low), float(high)), 1000.0)
    assert found[0] == state and ("upper end" in found[2]) == (high == 400)


def test_a_run_is_judged_by_its_own_figures(result, made):
    """Pressure and film against the arrays of the run."""
    late = result.data["time"] >= 0.005
    found = {check.title: check for check in made.checks}
    p = max(result.data[f"ball[{j}].p_i"][late].max() for j in range(1, 10))
    assert found["Pressure, inner race"].use == pytest.approx(p / 4.2e9, rel=1e-12)
    means = {}
    for side in "ie":
        film = np.array([result.data[f"ball[{j}].Lambda_{side}"][late] for j in range(1, 10)])
        load = np.array([result.data[f"ball[{j}].Q_{side}"][late] for j in range(1, 10)])
        means[side] = film[load > 0.0].mean()
    assert found["Oil film/roughness"].value.startswith(f"{min(means.values()):.2g} ")
    assert len(made.assumed) == 3 and {row[0] for row in made.assumed} <= {row.name for row in assumed_rows(result)}
    assert made.files == ((Path(__file__).name, hashlib.sha256(Path(__file__).read_bytes()).hexdigest()[:16]),)


def test_limits_are_told(result):
    data = result.data | {"event.overpressure_onsets": np.full_like(result.data["time"], 3.0)}
    assert (True, "contact pressure beyond bearing.p_limit: climb 3 ×") in list(
        sheet.limits_crossed({"climb": replace(result, data=data)})
    )


def test_changes_in_the_run_are_told(result):
    """As in the report: a sheet of a run whose preload rose is not that of its first preload."""
    late = replace(
        result, about=result.about | {"changes": {"0.01 s": {"joint.preload": 35.0}, "0.011 s": {"joint.mu": 0.3}}}
    )
    path = Path(__file__)
    told = sheet.result_sheet(late, path).remarks
    assert told[-1] == "Changed at 10 ms: joint.preload 35 N; at 11 ms: joint.mu 0.3"
    assert sheet.result_sheet(result, path).remarks == told[:-1]


def test_a_mission_at_its_own_life_has_utilisation_one(tmp_path):
    """With the target set to the mission's own life the worse of both places is at 1; x = 1 gives the life itself, as
    damages are scaled to the FMU's count; 1.2 times the stress shortens it by a power between both slopes, more by the
    mean stress.
    """
    model = Model()
    document = SHORT | {
        "scene": "demo",
        "point": [{"name": "calm", "hours": 3, "inputs": {"shaft.F_y": 2000.0}}, {"name": "rough", "hours": 1}],
        "life": {"min_seeds": 3, "max_seeds": 3},
    }
    plan = plan_mission("trial", document, model, tmp_path / "trial.toml")
    (tmp_path / "trial.toml").write_text("")
    from riveted_bearing.studies.sweep import cluster

    with cluster(None, 1) as client:
        runs = Runs(plan, model, tmp_path / "runs", lambda: client)
        life = assess(plan, runs)
    found = evidence.of_mission(life, runs, model)
    assert min(found.scaled(1.0)) == pytest.approx(life.estimate.life, rel=1e-9)
    faster = math.log(found.life / min(found.scaled(1.2))) / math.log(1.2)
    assert 8.0 < faster < 30.0
    made = sheet.mission_sheet(life, found, found.life, files=[tmp_path / "trial.toml"], remarks=["too long"])
    assert "too long" in made.remarks
    uses = [check.use for check in made.checks if check.title.endswith("fatigue")]
    assert max(uses) == pytest.approx(1.0, abs=2e-3)
    assert set(found.results) == {"calm", "rough"} and len(made.parts) == 2
    # the run of the part that decides is that of its worst seed, in which the marked rivet fails first
    own = [
        runs.damages[runs.keys[list(found.results).index(found.worst), s]].ravel()[life.estimate.place]
        for s in range(3)
    ]
    assert found.results[found.worst].parameters["start.seed"] == 1 + int(np.argmax(own))
    assert found.rivet == life.estimate.place // 2 + 1


def test_the_command_reads_a_result(tmp_path, fmu):
    """From a folder whose name has spaces and a letter beyond ASCII."""
    tmp_path = tmp_path / "Meine Lager für Ärger"
    tmp_path.mkdir()
    done = command(
        "run", "demo", "--fmu", fmu, "--t-end", "0.02", "--set", "start.settle=0.005", "--no-plot", folder=tmp_path
    )
    assert done.returncode == 0, done.stderr
    done = command("summary", "results/demo.parquet", "--target", "10000 h", folder=tmp_path)
    assert done.returncode == 0 and re.search(r"(Meets|Misses) the target of 10,000 h", done.stdout), done.stderr
    text = (tmp_path / "results" / "demo_summary.html").read_text(encoding="utf-8")
    assert hashlib.sha256(fmu.read_bytes()).hexdigest()[:16] in text
    refused = command("summary", "results/demo.parquet", "--target", "10 km", folder=tmp_path)
    assert refused.returncode == 2 and "--target 10 km" in refused.stderr and "h, min" in refused.stderr


def test_a_run_without_stress_is_refused(result):
    with pytest.raises(UserError, match=r"a summary needs a longer run, with stress"):
        sheet.result_sheet(replace(result, parameters=result.parameters | {"scene.stress": "off"}), Path("x.parquet"))


def test_a_run_with_a_broken_rivet_tells_no_life(result):
    """Its loads before and after are not alike: the sheet says which rivet broke, the report's cards count it."""
    broken = replace(result, summary=result.summary | {"rivet[4].break_time": 0.0123, "rivet[4].broken": 1.0})
    verdict = sheet.result_sheet(broken, Path(__file__), target=1000.0).verdict
    assert verdict[1] == "No life can be told" and verdict[2].startswith("rivet 4 broke in the head at 12.3 ms")
    titles = {title: (value, remark) for title, value, _, remark in report.cards(broken, report.all_lives(broken))}
    assert titles["Broken rivets"] == ("1", "first rivet 4, head, at 12.3 ms · no life is told")
    assert not any("Life" in title for title in titles)


# --------------------------------------------------------------------------------------------------------------- paper


def crowded(made, of_run=False):
    """The sheet with as much on it as there may be, of a run without parts of a mission."""
    words = "A long text of many words that goes on and on, "
    names = ("bearing", "replaced", "loads", "speed", "oil", "temperatures", "preload", "S-N curve", "mission")
    check = verdict.Check(
        "Pressure, inner race",
        "2,980 MPa (a point with a long name)",
        "at least 1, below it asperities carry",
        1.7,
        "bad",
    )
    parts = ((words[:24], words[:44], "6000 rev/min", "30 h", "< 0.1 %"),) * sheet.MOST_PARTS
    parts = () if of_run else parts
    return replace(
        made,
        name=sheet.clipped(words * 3, 60),
        description=sheet.clipped(words * 4, sheet.CHARACTERS),
        basis=sheet.fitted(dict.fromkeys(names, 20 * words), sheet.free_lines((check,) * 6, parts)),
        checks=(check,) * 6,
        limits=tuple((True, sheet.clipped(words * 5, sheet.CHARACTERS)) for _ in range(sheet.MOST_LIMITS)),
        parts=parts,
        remarks=(sheet.clipped(words * 4, 150),) * sheet.MOST_REMARKS,
        files=tuple((f"{words[:30]}.parquet", "0" * 16) for _ in range(3)),
    )  # fmt: skip


@pytest.mark.parametrize("full", ["", "mission", "run"])
def test_it_prints_on_one_sheet(browser, made, tmp_path, full):
    """One page of the PDF, nothing cut, on A4 and on the shorter Letter."""
    path = sheet.write_sheet(crowded(made, full == "run") if full else made, tmp_path / "sheet.html")
    tab = browser.new_page(viewport={"width": 390, "height": 900})
    tab.goto(path.as_uri())
    assert tab.evaluate("document.documentElement.scrollWidth") == 390  # nothing sticks out on a phone
    rights = tab.evaluate("[...document.querySelectorAll('meter')].map(part => part.getBoundingClientRect().right)")
    assert rights and max(rights) < 390.0
    for size in ({"prefer_css_page_size": True}, {"format": "Letter"}):
        pdf = tab.pdf(**size)
        assert len(re.findall(rb"/Type\s*/Page\b", pdf)) == 1
    tab.emulate_media(media="print")
    tab.set_viewport_size({"width": 703, "height": 1032})  # 186 x 273 mm
    assert tab.evaluate("(m => m.scrollHeight - m.clientHeight)(document.querySelector('main'))") <= 0
    assert tab.evaluate("(m => m.scrollWidth - m.clientWidth)(document.querySelector('main'))") <= 0
    tab.close()


def test_texts_are_cut_between_words():
    assert sheet.clipped("stress table by coarse finite elements", 30) == "stress table by coarse finite…"
    assert sheet.clipped("stress table by coarse finite elements", 34) == "stress table by coarse finite…"
    assert sheet.clipped("one two", 7) == "one two" and sheet.clipped("elements", 5) == "elem…"


def test_empty_rows_leave_their_place_to_the_basis(made):
    """A run has no parts of a mission: a basis too long for a full sheet stands there whole."""
    long = dict.fromkeys(("bearing", "replaced", "loads", "speed", "oil", "preload"), "word " * 30)
    assert sheet.fitted(long) != long
    assert sheet.fitted(long, sheet.free_lines(made.checks, made.parts)) == long
    assert sheet.free_lines(made.checks, (None,) * sheet.MOST_PARTS) == sheet.MOST_CHECKS - len(made.checks)


def test_it_needs_nothing_else(made, tmp_path):
    text = sheet.write_sheet(made, tmp_path / "sheet.html").read_text(encoding="utf-8")
    assert not re.findall(r"""(?:src|href)=["'](?!#|data:)[^"']*""", text) and "@import" not in text
    assert not re.findall(r"url\((?!#)", text)


def test_the_marked_rivet_is_the_brightest(result):
    """Colours are damages by which the first to fail is chosen: for each rivet the worse place of rainflow and law."""
    found = sheet.of_result(result, "run", raceways.Raceways())
    assert len(found.damage) == 9 and int(np.argmax(found.damage)) + 1 == found.rivet
    assert evidence.worse_places(np.array([1.0, 5.0, 3.0, 2.0])) == (5.0, 3.0)
