"""Every picture that the program draws, looked at for texts that overlap, are cut or end in nothing (pictures.py,
conftest.py).
"""

from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np
import pytest
from pictures import faults

from rivet_model import load_cases
from rivet_model.geometry import Geometry
from riveted_bearing import run
from riveted_bearing.building import rivet
from riveted_bearing.building import rivet_pictures as pictures
from riveted_bearing.building.rivet import rivet_curves, seat_note, write_pictures
from riveted_bearing.running.rainflow import rivet_life
from riveted_bearing.show import charts, report
from riveted_bearing.show.plot import plot_result
from riveted_bearing.show.style import STYLE

SETTLE = {"start.settle": 2e-3}
PULSE = {"t": [0.0, 4e-3, 5e-3], "value": [0.0, 0.0, 800.0]}


@pytest.fixture(scope="module")
def results():
    """Runs that fill the panels differently: steady, with everything that varies, without stress, with one row."""
    steady = run("demo", t_end=8e-3, parameters=SETTLE)
    inputs = {
        "shaft.omega": {"t": [0.0, 8e-3], "value": [1000.0, 1900.0]},
        "shaft.F_z": -900.0,
        "impact.F_r": PULSE,
        "impact.F_a": PULSE,
    }
    varied = run("demo", t_end=8e-3, parameters=SETTLE, inputs=inputs)
    elastic = run("demo", t_end=8e-3, parameters=SETTLE | {"scene.cage": "elastic"})
    still = run("demo", t_end=4e-3, parameters={"start.settle": 0.0, "scene.stress": "off"})
    first = replace(steady, data={name: values[:1] for name, values in steady.data.items()})
    few = replace(
        steady,
        data={name: steady.data[name] for name in ("time", "ring.y", "rivet.sigma_head_max")},
        about=steady.about | {"description": ""},
    )
    return {
        "steady": steady,
        "varied": varied,
        "elastic": elastic,
        "without stress": still,
        "one row": first,
        "few channels": few,
    }


CASES = ("steady", "varied", "elastic", "without stress", "one row", "few channels")


@pytest.mark.parametrize("case", CASES)
def test_the_picture_of_a_run(results, case, tmp_path):
    assert plot_result(results[case], tmp_path / "x.png").stat().st_size > 10_000


@pytest.mark.parametrize("case", CASES)
def test_the_charts_of_a_report(results, case):
    """Drawn as they stand in the page: each chart that the page shows was saved, and so inspected."""
    drawn = report.render(results[case]).count("<svg viewBox")
    assert (
        drawn >= {"steady": 14, "varied": 14, "elastic": 15, "without stress": 8, "one row": 0, "few channels": 1}[case]
    )


@pytest.mark.parametrize(
    "grid", [load_cases.COARSE, pytest.param(load_cases.SHIPPED, marks=pytest.mark.slow)], ids=["coarse", "shipped"]
)
def test_the_pictures_of_a_rivet(tmp_path, monkeypatch, grid):
    """The command's own pictures; the finite elements of the section fine or coarse."""
    monkeypatch.setattr(rivet, "Joint", lambda geometry: load_cases.Joint(geometry, grid))
    title, curves, joint = rivet_curves()
    assert {path.name for path in write_pictures(tmp_path, title, curves, joint)} == {
        "rivet_drawing.png",
        "rivet_curves.png",
        "rivet_section.png",
        "cage_modes.png",
    }


@pytest.mark.parametrize(
    "changes",
    [{}, {"shank_diameter": 2e-3}, {"head_diameter": 4.5e-3, "patch_radius": 5e-3}, {"flange_thickness": 4e-3}],
    ids=str,
)
def test_the_drawing_of_a_rivet(changes):
    """All dimensions in the picture, in mm."""
    geometry = replace(Geometry(), **changes)
    figure = pictures.plot_geometry(geometry)
    assert not list(faults(figure))
    texts = " ".join(text.get_text() for text in figure.axes[0].texts)
    for name in pictures.LENGTHS:
        assert f"{name} {1e3 * getattr(geometry, name):.4g}" in texts


def test_a_thin_seat_is_said():
    """Seat of a ring from 1.25 to 1.3 mm radius against a shank of 1 mm: (1.3^2 - 1.25^2)/1^2."""
    thin = replace(Geometry(), shank_diameter=2e-3)
    assert thin.seat_width == pytest.approx(0.05e-3) and thin.seat_share == pytest.approx(0.1275)
    assert "0.05 mm wide, 13 % of the shank's section" in seat_note(thin)
    assert "head_diameter = 2.6 mm is small" in seat_note(thin)
    assert seat_note(Geometry()) == ""


def old_orbit(figure):
    """A title from the left and a legend from the right that meet over a narrow panel."""
    ax = figure.add_axes([0.6, 0.3, 0.3, 0.4])
    ax.plot([0, 1], label="guide clearance")
    ax.set_title("Orbit of the cage's centre, seen from +X")
    ax.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0))
    return "'guide clearance' overlap"


def cut_label(figure):
    """An axis label beyond the edge."""
    figure.add_axes([0.0, 0.3, 0.9, 0.6]).set_ylabel("stress [MPa]")
    return "'stress [MPa]' is cut"


def dangling_title(figure):
    """A name without its description."""
    figure.suptitle("own: ")
    return "dangling"


@pytest.mark.parametrize("spoil", [old_orbit, cut_label, dangling_title])
def test_faults_are_found(spoil):
    with plt.rc_context(STYLE):
        figure = plt.figure(figsize=(9, 5))
        expected = spoil(figure)
        assert any(expected in fault for fault in faults(figure))
        plt.close(figure)


def test_a_rainflow_of_one_cycle():
    """The narrowest of the charts' data."""
    assert "<svg" in charts.svg(
        lambda figure: charts.rainflow_matrix(figure, np.array([(1.0, 2.0, 1.0)])), (4.9, 3.0), "one cycle"
    )


def test_lives_are_there(results):
    assert rivet_life(results["steady"], 1, "head") is not None
