"""Measured series beside a run's: units, statistics and spectra against closed forms, and what is refused."""

import math

import numpy as np
import pytest

from riveted_bearing import UserError, run
from riveted_bearing.base.units import figure
from riveted_bearing.running.results import Result, write_result
from riveted_bearing.show.overlay import assigned, read_measured, spectrum, spectrum_note, statistics, table_rows
from riveted_bearing.show.report import render, report_pages

RATE = 20e3


@pytest.fixture(scope="module")
def result():
    """A run of known series: 100 N + 30 N at 500 Hz, after a beginning that does not count."""
    t = np.arange(4001) / RATE
    force = np.where(t < 0.05, 9e9, 100.0 + 30.0 * np.sin(2 * np.pi * 500.0 * t))
    return Result(
        data={"time": t, "housing.F_y": force, "ball[3].Q_c": 0.0 * t, "oil.T": 300.0 + t},
        units={"time": "s", "housing.F_y": "N", "ball[3].Q_c": "N", "oil.T": "K"},
        parameters={"start.settle": 0.05},
        about={"scene": "sine"},
    )


def written(path, headers, *columns):
    lines = [
        ",".join(headers),
        *(",".join(f"{value!r}" for value in row) for row in zip(*(c.tolist() for c in columns))),
    ]
    path.write_text("\n".join(["# from the test rig", *lines]) + "\n", encoding="utf-8-sig")
    return path


@pytest.fixture
def measured(tmp_path):
    """The same sine at another rate and in other units, from -0.2 s on."""
    t = np.arange(6000) / 12e3 - 0.2
    return written(
        tmp_path / "rig.csv", ["time [ms]", "housing.F_y [kN]"], 1e3 * t, 0.1 + 0.06 * np.sin(2 * np.pi * 800 * t)
    )


def test_units_meet(result, measured):
    """Both in the file's unit, and the beginning of the run left out; statistics of sines in closed form."""
    (series,) = read_measured(measured, result)
    assert series.unit == "kN" and series.t_run[0] == 0.05 and series.t_measured[0] == pytest.approx(-0.2)
    rows = {name: (run, value) for name, run, value in table_rows(series)}
    assert rows["mean"] == pytest.approx((0.1, 0.1), rel=1e-3)
    assert rows["standard deviation"] == pytest.approx((0.03 / math.sqrt(2), 0.06 / math.sqrt(2)), rel=1e-3)
    assert rows["RMS"] == pytest.approx([math.hypot(0.1, a / math.sqrt(2)) for a in (0.03, 0.06)], rel=1e-3)
    assert rows["largest"] == pytest.approx((0.13, 0.16), rel=3e-3)  # a sample lies up to 0.1 rad beside the crest
    assert rows["samples per ms"] == pytest.approx((20.0, 12.0), rel=1e-9)


def test_spectrum_is_that_of_the_sine(result, measured):
    """Its peak lies at the sine's frequency within a line, and its power is amplitude^2/2 (Parseval)."""
    (series,) = read_measured(measured, result)
    for t, values, frequency, amplitude in (
        (series.t_run, series.run, 500.0, 0.03),
        (series.t_measured, series.measured, 800.0, 0.06),
    ):
        f, density = spectrum(t, values)
        assert abs(f[np.argmax(density)] - frequency) <= f[1] - f[0]
        assert np.sum(density**2) * (f[1] - f[0]) == pytest.approx(amplitude**2 / 2, rel=0.02)


def test_uneven_times_have_no_spectrum(result, tmp_path):
    t = np.cumsum(np.random.default_rng(1).uniform(1e-4, 3e-4, 400))
    path = written(tmp_path / "rig.csv", ["time", "housing.F_y"], t, 100.0 + t)
    (series,) = read_measured(path, result)
    assert spectrum_note(series) == "No spectrum of the measurement: its times are not equally spaced."
    assert dict(statistics(series.t_measured, series.measured))["mean"] == pytest.approx(100.0 + t.mean(), rel=1e-12)


def test_columns_of_other_names(result, tmp_path):
    """Assigned ones, indices in brackets that are no unit, and temperatures with an offset."""
    t = np.arange(64) / 1e3
    path = written(tmp_path / "rig.csv", ["t/s", "Q3", "Toil [degC]"], t, 5.0 + t, 20.0 + 0.0 * t)
    given = assigned(["time=t/s", "ball[3].Q_c=Q3 [kN]", 'oil.T="Toil [degC]"'])
    force, oil = read_measured(path, result, given)
    assert (force.channel, force.unit) == ("ball[3].Q_c", "kN") and force.measured[0] == pytest.approx(5.0)
    assert oil.unit == "degC" and oil.measured[0] == pytest.approx(20.0) and oil.run[0] == pytest.approx(26.9, abs=0.01)


@pytest.mark.parametrize(
    ("headers", "columns", "message"),
    [
        (["time", "force"], [], r"no column has the name of a recorded channel \(time, force\)"),
        (["time", "housing.F_y [mm]"], [], r'column "housing.F_y \[mm\]": unit "mm" does not fit; allowed: N'),
        (["when", "housing.F_y"], [], r'unknown column "time"'),
        (["time", "housing.F_y"], ["housing.F_q=housing.F_y"], r'unknown recorded channel "housing.F_q"; did you mean'),
        (["time", "housing.F_y [kN]"], ["housing.F_y=housing.F_y [N]"], r"its unit is kN, but N was asked for"),
        (["time", "housing.F_y"], ["housing.F_y"], r"not of the form CHANNEL=COLUMN"),
    ],
)
def test_what_does_not_fit_is_refused(result, tmp_path, headers, columns, message):
    t = np.arange(32) / 1e3
    path = written(tmp_path / "rig.csv", headers, t, t)
    with pytest.raises(UserError, match=message):
        read_measured(path, result, assigned(columns))


def test_rows_that_are_no_numbers_are_refused(result, tmp_path):
    path = tmp_path / "rig.csv"
    for text, message in (
        (
            "time,housing.F_y\n0,1\n1,broken\n" + "".join(f"{k},1\n" for k in range(2, 30)),
            r"housing.F_y.*broken.*not a number",
        ),
        ("time,housing.F_y\n0,1\n1\n", r"row 3 has 1 entries"),
        ("time,housing.F_y\n" + "0,1\n" * 20, r"row 3: 0 s after 0 s: times must increase"),
        ("time,time\n0,1\n", r"time: two columns have this name"),
    ):
        path.write_text(text)
        with pytest.raises(UserError, match=message):
            read_measured(path, result)


def test_the_page_shows_both_and_claims_nothing(measured, tmp_path):
    ran = run("demo", t_end=0.02, parameters={"start.settle": "5 ms"})
    write_result(ran, tmp_path / "demo.csv")
    (page,) = report_pages(tmp_path / "demo.csv", None, None, measured)
    text = page.read_text(encoding="utf-8")
    part = text.split('<section id="measured">')[1].split("</section>")[0]
    assert part.count("<svg") == 2 and "compare statistics and spectra, not points" in part
    largest = 1e-3 * ran.data["housing.F_y"][ran.data["time"] >= 0.005].max()
    assert f'largest</td><td class="n">{figure(largest)}</td><td class="n">{figure(0.159671313722098)}<' in part
    assert 'id="measured"' not in render(ran)
