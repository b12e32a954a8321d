"""The report: one file that needs nothing else, figures equal to the run's, life by a second hand, and a page that
moves in a real browser.
"""

import base64
import io
import json
import re
from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np
import pytest
from PIL import Image

from bearing_model.generated.variables import CageModel, Z
from bearing_model.instance import fatigue
from bearing_model.physics.model import Model
from riveted_bearing import UserError, run, write_result
from riveted_bearing.base.units import duration
from riveted_bearing.design.sensitivity import Sensitivity
from riveted_bearing.running.rainflow import fatigue_law, rivet_life
from riveted_bearing.running.results import Result
from riveted_bearing.running.summary import breaks, gone_from
from riveted_bearing.show.animation import BUDGET, exaggeration, frames, thinned
from riveted_bearing.show.charts import (
    PAGE_COLOURS,
    azimuth_of,
    by_bin,
    joint_spectra,
    loaded_rivet,
    section,
    section_sizes,
)
from riveted_bearing.show.charts import thinned as thinned_result
from riveted_bearing.show.report import CHARTS, OF_ELASTIC, render, report_files, report_pages, setting_rows

OF_HOUSING = ("vibration",)  # charts of a housing that vibrates

T_END = 0.012


@pytest.fixture(scope="module")
def result():
    """A run of the working point with impacts in it and elastic halves, short of what statistics need."""
    return run(
        "demo",
        t_end=T_END,
        parameters={"start.settle": 2e-3, "joint.preload": "30 N", "scene.stress": "fatigue", "scene.cage": "elastic"},
    )


@pytest.fixture(scope="module")
def few(result):
    """The run with few channels, as if no others had been asked for."""
    return replace(
        result,
        data={name: values for name, values in result.data.items() if name.startswith(("time", "ring.", "shaft."))},
    )


@pytest.fixture(scope="module")
def page(result):
    return render(result)


# ----------------------------------------------------------------------------------------------------------------- page


def test_page_is_complete_and_needs_nothing_else(page):
    """Every chart is there, nothing is fetched, no colour is fixed where the page has light and dark, and it stays
    below 2 MB.
    """
    assert len(page.encode()) < 2e6
    assert page.count('role="img" aria-label') == len(CHARTS) - len(OF_HOUSING) + 3  # and three canvases
    assert "not recorded" not in page and "too few" not in page
    assert not re.findall(r"""(?:src|href)=["'](?!#|data:)[^"']*""", page)
    assert not re.findall(r"url\((?!#)", page) and "@import" not in page
    assert set(re.findall(r'https?://[^\s"<)]*', page)) <= {"http://www.w3.org/1999/xlink"}  # the name of a namespace
    drawn = "".join(re.findall(r"<svg.*?</svg>", page, re.S))
    assert not [colour for colour in PAGE_COLOURS if colour in drawn]
    ids = re.findall(r'\sid="([^"]*)"', page)
    assert len(ids) == len(set(ids))
    assert set(re.findall(r'(?:url\(#|href="#)([^)"]*)', page)) <= set(ids)


def test_page_shows_the_figures_of_the_run(page, result):
    told, p999 = re.search(r"([\d.,]+) <small>MPa", page)[1], 1e-6 * result.summary["stat.sigma_head_p999"]
    assert float(told) == pytest.approx(p999, rel=0.02) and len(told) <= 3  # 2.8 % by the step alone
    assert f"{result.summary['stat.Q_c_p999']:.3g} <small>N" in page
    assert f"{result.summary['solver.steps']:,.0f}" in page
    assert "18,238" in page and "rev/min" in page
    changed = page.split("parameters that differ")[1].split("</table>")[0]
    assert "joint.preload" in changed and ">30<" in changed and "joint.fit" not in changed


def test_texts_are_escaped(few):
    shown = render(replace(few, about=few.about | {"description": "<script>alert(1)</script>", "stopped": "<b>"}))
    assert "<script>alert" not in shown and "&lt;script&gt;" in shown


def test_assumed_values_say_how_far_they_move_the_stress(few):
    """Their own study beside them, if there is one: its factors, the strongest first."""
    assert "moves the stress by" in render(few) and "what decides" not in render(few)
    morris = {"damage": {"mu_star": [0.25, 1.5], "mu_star_conf": [0.1, 0.2], "sigma": [0.1, 0.1], "noise": 0.3}}
    page = render(few, Sensitivity("duty", "", 2, ("damage",), ("joint.mu", "joint.preload"), morris, ()))
    rows = re.findall(r"<tr><td><code>([^<]*)</code></td><td class=.n.>([^<]*) ± ([^<]*)</td></tr>", page)
    assert rows == [("joint.preload", "1.5", "0.2"), ("joint.mu", "0.25", "0.1")] and "by the study duty" in page


def test_what_was_not_recorded_is_said(few):
    """A run with few channels gives a page with what there is."""
    page = render(few)
    assert "No animation: not recorded: half_0.x" in page
    assert "Load distribution over the azimuth: not recorded: ball[1].psi" in page
    assert 'aria-label="Displacement of the inner ring over time"' in page


def test_rigid_halves_do_not_bend(result):
    """No bending is drawn, no spectra of joints are looked for."""
    page = render(replace(result, parameters=result.parameters | {"scene.cage": "two_half"}))
    film = json.loads(page.split('id="frames">')[1].split("</script>")[0])
    assert film["bend"] == 0.0 and not any("flex" in name for name in film["channels"])
    assert "bend by their vibration modes" not in page and "Spectra of the joint loads" not in page
    assert page.count('role="img" aria-label') == len(CHARTS) - len(OF_ELASTIC) - len(OF_HOUSING) + 3


@pytest.mark.filterwarnings("error")
def test_breaks_are_on_the_page_in_the_charts_and_in_the_film():
    """Rivets that break in a run: the page lists them, the film lets them vanish at that time, the basis and the page say
    that damage was accelerated.
    """
    weak = {"fatigue.sigma_D": "30 MPa", "fatigue.k_1": 5, "fatigue.k_2": 5, "fatigue.acceleration": 3e4}
    scene = {"start.settle": 0.0, "scene.stress": "fatigue", "scene.breakage": "on", "scene.cage": "two_half"}
    broken = run("demo", t_end=0.02, parameters=scene | weak)
    found, gone = breaks(broken), gone_from(broken)
    assert found and gone == {k: t for k, _, t in found} and all(0.0 < t <= 0.02 for t in gone.values())
    assert [t for *_, t in found] == sorted(t for *_, t in found)
    page, film = render(broken), frames(broken)[0]
    assert "Broken rivets" in page and film["gone"] == gone
    assert "damage accelerated 30000 times" in page
    assert "accelerated 30000 times" in broken.about["basis"]["damage"]
    whole = run("demo", t_end=2e-3, parameters={"rivet[4].intact": 0})
    assert breaks(whole) == [] and gone_from(whole) == {4: 0.0}


def test_a_cage_guided_by_balls_has_no_land(result, page):
    """Neither in the drawing and its legend nor among the parameters that differ; its eccentricity names the pocket's
    clearance.
    """
    own = {"cage.guidance": "balls", "cage.guide_clearance": 5e-3, "cage.sheet": 1e-3}
    ribbon = replace(result, parameters=result.parameters | own)
    shown, film = render(ribbon), frames(ribbon)[0]
    assert frames(result)[0]["land"] and not film["land"] and film["scale"] == frames(result)[0]["scale"]
    assert "land of the outer ring" in page and "land of the outer ring" not in shown
    assert "dashed: the guide clearance" in page and "dashed: the pocket clearance" in shown
    assert "cage eccentricity / pocket clearance" in shown and "cage eccentricity /" not in page
    assert not {name: differs for name, *_, differs in setting_rows(ribbon)}["cage.guide_clearance"]


def test_a_run_without_stress_has_a_page():
    shown = render(run("demo", t_end=2e-3, parameters={"start.settle": 0.0, "scene.stress": "off"}))
    assert shown.count("the stress does not change") == 2  # spectra, rainflow
    # no zeros for what nobody computed
    assert "<span>Head stress</span>" not in shown and "Life of the weakest rivet" not in shown


def test_a_run_of_one_row_has_a_page(result):
    """As left by an FMU that gave up in its first step."""
    first = {name: values[:1] for name, values in result.data.items()}
    assert "too few samples" in render(replace(result, data=first))


# ------------------------------------------------------------------------------------------------------------ animation


def numbers(channel):
    return channel["first"] + channel["step"] * np.frombuffer(base64.b64decode(channel["data"]), "<i2")


def test_frames_give_back_the_motion(result):
    """Positions to 16 bits of their range, azimuths through the rotation of the cage: within 0.1 um at the pitch
    circle.
    """
    film, missing = frames(result)
    assert not missing
    film = json.loads(json.dumps(film))
    time, psi = (np.frombuffer(base64.b64decode(text), "<f4") for text in (film["time"], film["turned"]["psi"]))
    assert time == pytest.approx(result.data["time"], abs=1e-8)
    for j in (1, 5, Z):
        azimuth = psi + numbers(film["channels"][f"lag{j}"]) + 2 * np.pi * (j - 1) / Z
        # expected: 32 bits of 10 rad, 16 bits of the lag: 3e-8
        assert 0.0268 * np.abs(azimuth - result.data[f"ball[{j}].psi"]).max() < 1e-7
        x = result.data[f"ball[{j}].x"]
        assert np.abs(numbers(film["channels"][f"x{j}"]) - x).max() <= np.ptp(x) / 131070 * 1.001
    assert film["scale"] == 10.0


def test_long_runs_are_thinned_to_the_budget_and_keep_their_peaks(result):
    many = {name: np.tile(values, 80) for name, values in result.data.items()} | {
        "time": np.arange(80 * len(result.data["time"])) * 1e-4
    }
    film, _ = frames(replace(result, data=many))
    assert len(json.dumps(film)) < 1.1 * BUDGET
    stress = numbers(film["channels"]["rivet.sigma_head_max"])
    assert stress.max() == pytest.approx(many["rivet.sigma_head_max"].max(), rel=1e-6)


def test_frames_give_back_the_bending(result):
    """What the modes move at each rivet, less the mean widening of its half, to 16 bits; drawn so that the largest is
    an eighth to a quarter of the ball.
    """
    film = json.loads(json.dumps(frames(result)[0]))
    late, largest = result.data["time"] >= 2e-3, 0.0
    for h in (0, 1):
        radial = np.array([result.data[f"rivet[{k}].flex_{h}_r"] for k in range(1, Z + 1)])
        mean = radial[:, late].mean()
        for k in range(1, Z + 1):
            for name in "xrt":
                drawn = numbers(film["channels"][f"{k}_flex_{h}_{name}"])
                expected = result.data[f"rivet[{k}].flex_{h}_{name}"] - (mean if name == "r" else 0.0)
                assert np.abs(drawn - expected).max() <= np.ptp(expected) / 131070 * 1.001
                largest = max(largest, np.abs(expected[late]).max())
    assert film["widening"] == pytest.approx(
        np.mean([result.data[f"rivet[{k}].flex_{h}_r"][late] for h in (0, 1) for k in range(1, Z + 1)])
    )
    assert 0.1 * 0.0111125 < film["bend"] * largest <= 0.25 * 0.0111125  # steps of the factor: 2.5 at most
    assert f"{film['bend']:,.0f} times too large" in render(result)


def test_thinned_peaks():
    assert thinned(np.array([1.0, 5.0, 2.0, 3.0, 9.0, 4.0, 0.0]), 3).tolist() == [1.0, 5.0, 9.0]


@pytest.mark.parametrize(
    ("pocket", "guide", "scale"), [(2e-4, 2e-4, 10.0), (2e-4, 3e-4, 5.0), (1e-2, 2e-4, 1.0), (2e-5, 2e-5, 100.0)]
)
def test_exaggeration_fits_between_the_pockets(pocket, guide, scale):
    """The largest radial clearance is drawn as at most 13 % of the ball."""
    p = {"bearing.D": 0.0111125, "cage.pocket_clearance": pocket, "cage.guide_clearance": guide}
    assert exaggeration(p) == scale


# -------------------------------------------------------------------------------------------------------------- numbers


def test_thinned_curves_keep_every_extreme(result):
    rng = np.random.default_rng(1)
    long = Result(data={"time": np.arange(50_000) * 1e-5, "a": rng.normal(size=50_000)}, units={}, parameters={})
    few = thinned_result(long, 100)
    assert len(few.data["a"]) == 200
    assert (few.data["a"].min(), few.data["a"].max()) == (long.data["a"].min(), long.data["a"].max())
    assert np.all(np.diff(few.data["time"]) > 0.0)


def test_the_load_zone_is_where_the_load_points(result):
    """F_y presses the balls at azimuth 0; those opposite carry no inner load."""
    psi = np.concatenate([azimuth_of(result, "ball", j, Z) for j in range(1, Z + 1)])
    load = np.concatenate([result.data[f"ball[{j}].Q_i"] for j in range(1, Z + 1)])
    mean = by_bin(load, (psi * 12 + 0.5).astype(int) % 12, 12, np.mean)
    assert np.argmax(mean) == 0 and mean[0] > 1000.0 and mean[6] == 0.0


def test_modes_are_those_of_the_fmu(result):
    """Frequencies of the modes against those that the core's twin derives; a half of four times the mass swings
    half as fast.
    """
    for changes in ({}, {"cage.m": 4.0 * result.parameters["cage.m"]}):
        found = run("demo", t_end=1e-3, parameters={"scene.cage": "elastic"} | changes).about["mode_frequencies"]
        omega = Model.of({"scene.cage": CageModel.ELASTIC} | changes).modes.omega
        assert found == pytest.approx(sorted(set(omega / 2 / np.pi)), rel=1e-12)
    assert found[0] == pytest.approx(0.5 * result.about["mode_frequencies"][0], rel=1e-9)
    assert 700.0 < result.about["mode_frequencies"][0] < 850.0  # two lobes out of the plane
    assert "mode_frequencies" not in run("demo", t_end=1e-3, parameters={"scene.cage": "two_half"}).about


def sung(result, rows=4096, rate=2e4):
    """The result with joint 5 under a tension of 90 N that swings at 2.5 kHz by 6 N, a moment about t at 1.5 kHz by 4
    N.mm and one about r at 3.5 kHz.
    """
    t, angle = np.arange(rows) / rate, 2 * np.pi * 4.5 / Z
    channels = {f"rivet[{k}].{name}": np.zeros(rows) for k in range(1, Z + 1) for name in ("T", "M_y", "M_z")}
    about_r, about_t = 9e-3 * np.sin(2 * np.pi * 3500.0 * t), 4e-3 * np.sin(2 * np.pi * 1500.0 * t)
    channels["rivet[5].T"] = 90.0 + 6.0 * np.sin(2 * np.pi * 2500.0 * t)
    channels["rivet[5].M_y"] = np.cos(angle) * about_r - np.sin(angle) * about_t
    channels["rivet[5].M_z"] = np.sin(angle) * about_r + np.cos(angle) * about_t
    return replace(result, data={"time": t} | channels, parameters=result.parameters | {"start.settle": 0.0})


def test_spectra_of_joint_loads(result):
    """The most loaded rivet; a swing of amplitude A has the power A^2/2 at its frequency; modes below half the rate are
    marked, the others not.
    """
    song, seen = sung(result), plt.figure()
    joint_spectra(seen, song)
    marked = [frequency for frequency in result.about["mode_frequencies"] if frequency < 1e4]
    assert loaded_rivet(song) == "5" and 0 < len(marked) < len(result.about["mode_frequencies"])
    for ax, frequency, amplitude in zip(seen.axes, (2.5, 1.5), (6.0, 4.0), strict=True):
        curve, *lines = ax.lines
        f, density = curve.get_data()
        assert f[np.argmax(density)] == pytest.approx(frequency, abs=0.02)
        assert np.sum(density**2) * 1e3 * (f[1] - f[0]) == pytest.approx(0.5 * amplitude**2, rel=1e-3)
        assert [1e3 * line.get_xdata()[0] for line in lines] == pytest.approx(marked)
    plt.close(seen)


def test_coarse_samples_are_said(result):
    """1 sample per ms is too coarse for the lowest mode; an older result that does not name its modes gets the spectrum
    without marks.
    """
    slow = sung(result, rate=1e3)
    assert "Spectra of the joint loads: sampled too coarsely: 1 samples per ms, more than 1.5" in render(slow)
    assert "Spectra of the joint loads: 20 samples after settling" in render(sung(result, rows=20))
    unnamed = replace(slow, about={name: value for name, value in slow.about.items() if name != "mode_frequencies"})
    assert 'aria-label="Spectra of the joint loads"' in render(unnamed)


def made_up(result, history):
    """The result with the same stress history [Pa] in every rivet, 1 ms a sample, no peaks between them."""
    channels = {
        f"rivet[{k}].sigma_{place}{peak}": history
        for k in range(1, Z + 1)
        for place in ("head", "mid")
        for peak in ("", "_peak")
    }
    data = {"time": np.arange(len(history)) * 1e-3} | channels
    return replace(result, data=data, parameters=result.parameters | {"start.settle": 0.0})


def test_life_of_a_constant_amplitude(result):
    """1,000 cycles of 300 MPa about zero: D = n (sigma_a/sigma_D)^k_1 / N_D."""
    swing = np.append(np.tile([300e6, -300e6], 1000), 300e6)
    life = rivet_life(made_up(result, swing), 3, "head")
    assert life.damage == pytest.approx(1000 * (300 / 250) ** 8 / 2e6, rel=1e-12)
    assert life.life == pytest.approx(2.0 / life.damage, rel=1e-12)
    assert life.cycles[:, 2].sum() == 1000


def test_the_cycles_drawn_are_those_of_the_weakest_rivet(result):
    """Rivet 4 has the largest swing, rivet 2 the largest stress; card and chart name rivet 4."""
    swing = 1e6 * np.append(np.tile([100.0, -100.0], 50), 100.0)
    plain = made_up(result, swing)
    own = {f"rivet[{k}].sigma_head{peak}": values for k, values in ((4, 3.0 * swing), (2, 400e6 + 0.1 * swing))
           for peak in ("", "_peak")}  # fmt: skip
    shown = render(replace(plain, data=plain.data | own))
    assert "Cycles of the weakest rivet, 4, head" in shown and "Spectra, rivet 2" in shown
    assert "rivet 4, head · Miner" in shown and "Rainflow matrix of the weakest rivet" in shown


def test_life_agrees_with_the_streaming_count(result):
    """A third party's rainflow against the FMU's own algorithm, of any history."""
    history = 1e8 + 2e8 * np.random.default_rng(5).normal(size=3000)
    channel, law = fatigue.FatigueChannel(), fatigue_law(result.parameters)
    for sigma in history.tolist():
        channel.push(law, sigma)
    assert rivet_life(made_up(result, history), 1, "mid").damage == pytest.approx(channel.damage(law), rel=1e-9)


def test_life_agrees_with_the_count_of_every_step():
    """Peaks and samples miss the dips between communication points: never more damage than the FMU counts, and by the
    15th root the stress that would do it is at most a tenth less.  Observed 0.90 ... 1.00 of rigid halves; elastic ones
    ring between the samples: 0.87 ... 0.99.
    """
    parameters = {"start.settle": 2e-3, "joint.preload": "30 N", "scene.stress": "fatigue", "scene.cage": "two_half"}
    result = run("demo", t_end=T_END, parameters=parameters)
    ratio = [
        rivet_life(result, k, place).damage / result.data[f"rivet[{k}].damage_{place}"][-1]
        for k in range(1, Z + 1)
        for place in ("head", "mid")
    ]
    stress = np.array(ratio) ** (1 / result.parameters["fatigue.k_2"])
    assert stress.min() > 0.88 and stress.max() < 1.005


@pytest.mark.parametrize(
    ("seconds", "text"),
    [(30.0, "30 s"), (7200.0, "2 h"), (8766 * 3600.0, "8,770 h"), (1e20, "> 1e6 h"), (np.inf, "no damage")],
)
def test_durations_read_well(seconds, text):
    assert duration(seconds) == text


# ---------------------------------------------------------------------------------------------------------------- files


def test_pages_lie_beside_their_results(few, tmp_path):
    for kind in ("a.parquet", "b.csv"):
        write_result(replace(few, about=few.about | {"scene": kind}), tmp_path / kind)
    assert [path.name for path in report_pages(tmp_path)] == ["a.html", "b.html"]
    assert "<h1>b.csv</h1>" in (tmp_path / "b.html").read_text()
    assert [path.name for path in report_pages(tmp_path / "a.parquet", tmp_path / "x.html")] == ["x.html"]
    with pytest.raises(UserError, match="one page for 2 results"):
        next(report_pages(tmp_path, tmp_path / "x.html"))
    (tmp_path / "empty").mkdir()
    with pytest.raises(UserError, match=r"no results in this folder; allowed are files ending in parquet"):
        report_files(tmp_path / "empty")


# -------------------------------------------------------------------------------------------------------------- browser


@pytest.fixture
def opened(browser, page, tmp_path):
    """opened(width, height, scheme) -> the page in a window, and what it complained about or asked for."""
    (tmp_path / "report.html").write_text(page, encoding="utf-8")

    def show(width, height, scheme="light"):
        tab, complaints = browser.new_page(viewport={"width": width, "height": height}, color_scheme=scheme), []
        tab.on("console", lambda message: complaints.append(message.text))
        tab.on("pageerror", lambda error: complaints.append(str(error)))
        tab.on(
            "request",
            lambda request: complaints.append(request.url) if not request.url.startswith(("file:", "data:")) else None,
        )
        tab.goto((tmp_path / "report.html").as_uri())
        tab.wait_for_selector("#animation[data-ready]")
        return tab, complaints

    return show


def milliseconds(tab):
    """Time that the animation shows."""
    return float(tab.inner_text("#readout").split(" ms")[0])


@pytest.mark.parametrize(("width", "height", "scheme"), [(1280, 900, "light"), (375, 812, "dark")])
def test_animation_plays_and_scrubs(opened, width, height, scheme):
    tab, complaints = opened(width, height, scheme)
    assert tab.evaluate("document.documentElement.scrollWidth") == width  # nothing sticks out
    picture = "document.getElementById('{}').toDataURL()"
    before, start = (
        {name: tab.evaluate(picture.format(name)) for name in ("front", "strip", "trace")},
        milliseconds(tab),
    )
    tab.click("#play")
    # 0.15 s at 500 times slower
    tab.wait_for_function(
        "start => parseFloat(document.getElementById('readout').textContent) > start + 0.3", arg=start
    )
    tab.click("#play")
    assert tab.inner_text("#play") == "Play"
    for name, picture_before in before.items():
        assert tab.evaluate(picture.format(name)) != picture_before, name
    stopped = milliseconds(tab)
    tab.wait_for_timeout(100)
    assert milliseconds(tab) == stopped

    tab.focus("#when")
    tab.keyboard.press("End")
    assert milliseconds(tab) == pytest.approx(1e3 * T_END, abs=0.01)
    box = tab.locator("#trace").bounding_box()
    tab.locator("#trace").click(position={"x": 0.25 * box["width"], "y": 20})
    assert milliseconds(tab) == pytest.approx(0.25e3 * T_END, abs=0.1)  # a pixel is 0.04 ms
    assert float(tab.input_value("#when")) == pytest.approx(0.25 * T_END, abs=1e-4)
    fixed = tab.evaluate(picture.format("front"))
    tab.check("#follow")
    assert tab.evaluate(picture.format("front")) != fixed
    assert complaints == []
    tab.close()


# what 12 mm of margin leave of the narrower of A4 and Letter, and of the shorter, at 96 pixels an inch
PAPER = (703, 965)


@pytest.mark.parametrize("width", [1280, 375])
def test_printed_page_is_light_and_has_the_picture(opened, width):
    """Printing from a dark screen: dark ink on white, and the canvas drawn again for it, on the first page."""
    tab, complaints = opened(width, 900, "dark")
    tab.evaluate("dispatchEvent(new Event('beforeprint'))")
    assert tab.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"
    tab.emulate_media(media="print", color_scheme="dark")
    tab.set_viewport_size({"width": PAPER[0], "height": PAPER[1]})
    shown = np.array(Image.open(io.BytesIO(tab.screenshot(full_page=True))).convert("RGB"))
    box = tab.locator("#front").bounding_box()
    assert tab.evaluate("document.documentElement.scrollWidth") <= PAPER[0]
    assert (
        tab.evaluate("document.getElementById('animation').getBoundingClientRect().bottom") <= PAPER[1]
    )  # else the first page ends above it, two thirds empty
    part = shown[round(box["y"]) : round(box["y"] + box["height"]), round(box["x"]) : round(box["x"] + box["width"])]
    # the colour of the rings on paper
    extents = [np.ptp(where) for where in np.nonzero(np.all(part == (211, 219, 227), axis=2))]
    # a circle: to 2 of 250 pixels; stretched over the paper's width 2.2
    assert min(extents) > 150 and extents[0] == pytest.approx(extents[1], rel=0.02)
    tab.emulate_media(media="screen", color_scheme="dark")
    tab.evaluate("dispatchEvent(new Event('afterprint'))")
    assert tab.evaluate("getComputedStyle(document.body).backgroundColor") != "rgb(255, 255, 255)"
    assert complaints == []
    tab.close()


@pytest.mark.parametrize("Z", [8, 9])
def test_bending_between_rivets(opened, Z):
    """Waves of up to three lobes, given at the rivets alone, come back at every angle; magnified, in mm."""
    tab, _ = opened(1280, 900)
    angles = np.linspace(0.0, 2.0 * np.pi, 50)
    for lobes in range(4):
        script = f"""() => {{
            const wave = (a) => 1e-6 * Math.cos({lobes} * a + 0.3), rivet = (name) => (2 * Math.PI * (parseInt(name) - 0.5)) / {Z};
            const see = {{ value: (name) => (name.endsWith("_1_r") ? wave(rivet(name)) : name.endsWith("_1_x") ? -wave(rivet(name)) : 0) }};
            const at = bearingDrawing({{ Z: {Z}, scale: 1, bend: 500, bearing: {{}}, range: {{}}, has: () => true }}).bending(see);
            return {angles.tolist()}.map((a) => [...at(1, a), ...at(0, a)]);
        }}"""
        wave = 0.5 * np.cos(lobes * angles + 0.3)
        expected = np.column_stack([-wave, wave, *(0.0 * wave for _ in range(4))])
        np.testing.assert_allclose(tab.evaluate(script), expected, atol=1e-12)
    tab.close()


def test_bending_is_drawn(page, tmp_path, browser):
    """The same instant with and without the factor: both views of the cage differ, and only they."""
    straight = re.sub(r'"bend": [0-9.]+', '"bend": 0.0', page)
    assert straight != page
    pictures = []
    for text in (page, straight):
        (tmp_path / "bent.html").write_text(text, encoding="utf-8")
        tab = browser.new_page(viewport={"width": 1280, "height": 900})
        tab.goto((tmp_path / "bent.html").as_uri())
        tab.wait_for_selector("#animation[data-ready]")
        pictures.append(
            [tab.evaluate(f"document.getElementById('{name}').toDataURL()") for name in ("front", "strip", "trace")]
        )
        tab.close()
    (front, strip, trace), (front_0, strip_0, trace_0) = pictures
    assert front != front_0 and strip != strip_0 and trace == trace_0


@pytest.mark.parametrize(("width", "columns"), [(1400, 2), (800, 1), (390, 1)])
def test_tables_use_the_width_of_the_page(opened, width, columns):
    """Nothing sticks out, no row is a tower of single words, and the long table of parameters stands in as many columns
    as fit.
    """
    tab, complaints = opened(width, 900)
    tab.evaluate("document.querySelectorAll('details').forEach(part => part.open = true)")
    assert tab.evaluate("document.documentElement.scrollWidth") == width
    # six lines
    assert (
        tab.evaluate("Math.max(...[...document.querySelectorAll('tr')].map(row => row.getBoundingClientRect().height))")
        < 170
    )
    places = tab.evaluate(
        "[...document.querySelectorAll('details tbody tr')].map(row => Math.round(row.getBoundingClientRect().x))"
    )
    assert len(places) > 90 and len(set(places)) == columns
    last = "[...document.querySelectorAll('.settings td:last-child')].map(cell => cell.getBoundingClientRect().right)"
    assert max(tab.evaluate(last)) <= width  # no unit is hidden
    table = tab.evaluate("document.querySelector('details table').getBoundingClientRect().width")
    assert table > 0.8 * min(width, 1150)
    assert complaints == []
    tab.close()


def test_the_section_is_that_of_the_users_own_cage(result):
    """Radii by hand: a groove's bottom is half the pitch diameter, the ball's radius and a quarter of the clearance
    away; what the drawing writes and spans are the parameters.
    """
    own = {"bearing.D": 0.01, "bearing.d_m": 0.06, "bearing.P_d": 40e-6, "bearing.h_e": 0.25}
    cage = {"cage.D_o": 0.0641, "cage.D_i": 0.0553, "cage.width": 0.0124}
    mine = replace(result, parameters=result.parameters | own | cage | {"ring.bore": 0.0421, "ring.outside": 0.0})
    sizes = section_sizes(mine.parameters)
    assert (sizes["r_i"], sizes["r_e"]) == pytest.approx((24.99, 35.01), rel=1e-12)
    assert sizes["shoulder_e"] == pytest.approx(32.51, rel=1e-12) and sizes["half"] == pytest.approx(6.2, rel=1e-12)
    shape = plt.figure()
    section(shape, mine)
    (ax,) = shape.axes
    texts = {text.get_text() for text in ax.texts}
    assert {"cage ø64.1", "cage ø55.3", "cage 12.4", "ball 10", "pitch ø60", "bore ø42.1", "outside ≈ ø77"} <= texts
    box = next(patch for patch in ax.patches if isinstance(patch, plt.Rectangle))
    assert box.get_bbox().extents == pytest.approx((-6.2, 27.65, 6.2, 32.05))
    ribbon = section_sizes(
        mine.parameters | {"cage.shape": "ribbon", "cage.pocket_depth": 5.1e-3, "cage.sheet": 0.8e-3}
    )
    assert ribbon["half"] == pytest.approx(5.9, rel=1e-12)
    plt.close(shape)
