"""Spectra: known signals, known lines; and the lines of a spall in the FMU's own vibration."""

import math

import numpy as np
import pytest
from commands import typed

from riveted_bearing import run
from riveted_bearing.base.errors import UserError
from riveted_bearing.bearing.surfaces import waves_of
from riveted_bearing.running.fmu import Model
from riveted_bearing.running.results import Result, write_result
from riveted_bearing.running.scene import load_scene
from riveted_bearing.show.spectrum import amplitude_spectrum, kurtosis_band, spectra, squared, write_spectra
from riveted_bearing.studies.dataset import labels, load_dataset

RATE, D, D_M, Z = 25_600.0, 11.1125e-3, 53.5e-3, 9
BALLS = {f"ball[{j}].dD": 0.0 for j in range(1, Z + 1)}  # by which a result shows how many balls there are


def result_of(x, t, omega, cage):
    data = {"time": t, "housing.a_y": x, "shaft.omega": omega, "cage.omega": cage}
    units = {"time": "s", "housing.a_y": "m/s2", "shaft.omega": "rad/s", "cage.omega": "rad/s"} | dict.fromkeys(
        BALLS, "N"
    )
    return Result(data, units, BALLS | {"bearing.D": D, "bearing.d_m": D_M, "start.settle": 0.0}, {}, {"scene": "made"})


def ringing(t, beats, f_0=4000.0, decay=800.0):
    """Decaying oscillations from the times `beats` on."""
    x = np.zeros_like(t)
    for beat in beats:
        late = t >= beat
        x[late] += np.exp(-decay * (t[late] - beat)) * np.sin(2.0 * np.pi * f_0 * (t[late] - beat))
    return x


def test_amplitude_of_a_sine():
    """On a line of the resolution the amplitude is that of the sine, off it a Hann window loses up to 15 %."""
    t = np.arange(25_600) / RATE
    f, amplitude = amplitude_spectrum(0.7 * np.sin(2.0 * np.pi * 1000.0 * t), RATE)
    assert f[np.argmax(amplitude)] == 1000.0 and amplitude.max() == pytest.approx(0.7, rel=1e-6)


def test_band_of_impulses():
    """The band of largest kurtosis contains the resonance that rare impulses excite, in noise of their mean power."""
    t, rng = np.arange(25_600) / RATE, np.random.default_rng(1)
    x = ringing(t, np.arange(0.01, 1.0, 0.037)) + 0.1 * rng.standard_normal(len(t))
    low, high = kurtosis_band(x, RATE)
    assert low < 4000.0 < high and high - low < 0.25 * RATE


def test_lines_follow_the_cage():
    """Impacts at the outer race's frequency of a cage that slips by 3 %: the line is where this cage has it, within the
    resolution, and stands out; the inner race's does not.
    """
    t, rng = np.arange(25_600) / RATE, np.random.default_rng(2)
    omega = 2.0 * np.pi * 30.0
    cage = 0.97 * 0.5 * omega * (1.0 - D / D_M)
    bpfo = Z * cage / (2.0 * np.pi)
    x = ringing(t, np.arange(0.003, 1.0, 1.0 / bpfo)) + 0.05 * rng.standard_normal(len(t))
    found = spectra(result_of(x, t, np.full_like(t, omega), np.full_like(t, cage)))
    lines = {line.name: line for line in found.lines}
    assert found.kinematic["BPFO"] == pytest.approx(bpfo) and not found.orders
    assert abs(lines["BPFO"].found - bpfo) <= found.resolution and lines["BPFO"].stands_out
    assert not lines["BPFI"].stands_out
    assert found.kinematic["BPFO"] + found.kinematic["BPFI"] == pytest.approx(Z * 30.0)
    assert found.kinematic["BSF"] == pytest.approx((cage / omega) * 30.0 * D_M / D * (1.0 + D / D_M))


def test_run_up_has_orders():
    """A shaft that runs up from 20 to 40 turns a second: impacts at equal angles are one line, at their order."""
    t = np.arange(2 * 25_600) / RATE
    speed = 20.0 + 10.0 * t
    turns = 20.0 * t + 5.0 * t**2
    order = Z * 0.5 * (1.0 - D / D_M)
    beats = np.interp(np.arange(0.2, turns[-1] * order) / order, turns, t)
    omega = 2.0 * np.pi * speed
    found = spectra(result_of(ringing(t, beats), t, omega, 0.5 * omega * (1.0 - D / D_M)), band=(100.0, 160.0))
    line = next(line for line in found.lines if line.name == "BPFO")
    assert found.orders and found.kinematic["BPFO"] == pytest.approx(order, rel=1e-6)
    assert abs(line.found - order) <= found.resolution and line.stands_out


def test_refusals(tmp_path):
    t = np.arange(25_600) / RATE
    x, omega = np.sin(4000.0 * t), np.full_like(t, 200.0)
    fine = result_of(x, t, omega, 0.4 * omega)
    with pytest.raises(UserError, match="samples after start.settle; at least 256"):
        spectra(result_of(x[:100], t[:100], omega[:100], omega[:100]))
    with pytest.raises(UserError, match="band = 100 to 90000"):
        spectra(fine, band=(100.0, 90_000.0))
    with pytest.raises(UserError, match=r"band = 2 to 5 Hz: at least .* Hz wide"):  # meant as kHz
        spectra(fine, band=(2.0, 5.0))
    narrow = {line.name: line for line in spectra(fine, band=(1000.0, 1100.0)).lines}  # no beat above 100 Hz is in it
    assert all(line.expected > 100.0 for line in narrow.values() if math.isnan(line.found))
    assert not any(line.stands_out for line in narrow.values() if line.expected > 100.0 + spectra(fine).resolution)
    with pytest.raises(UserError, match="housing.a_q"):
        spectra(fine, channel="housing.a_q")
    path = write_spectra(spectra(fine, band=(300.0, 5000.0)), tmp_path / "s.csv")
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    assert lines[0] == "frequency,amplitude,envelope_squared"
    table = np.loadtxt(lines[1:], delimiter=",")
    assert table[np.argmax(table[:, 1]), 0] == pytest.approx(4000.0 / (2.0 * np.pi), abs=1.0)


def test_spall_in_the_housing(tmp_path):
    """The shipped scene over 0.3 s: the envelope's lines at once and twice the outer race's frequency are the largest of
    all, within the resolution of 4 Hz; the command writes table and picture.
    """
    result = run("spall", t_end=0.3)
    found = spectra(result)
    lines = {line.name: line for line in found.lines}
    for name in ("BPFO", "2 BPFO"):
        assert abs(lines[name].found - lines[name].expected) <= found.resolution and lines[name].stands_out
    others = [lines[name].amplitude for name in ("FTF", "BSF", "BPFI")]
    assert lines["BPFO"].amplitude > 10.0 * max(others)
    write_result(result, tmp_path / "spall.parquet")
    done = typed("spectrum", tmp_path / "spall.parquet")
    assert done.exit_code == 0 and "BPFO" in done.stdout
    assert "resolution 4 Hz; amplitudes are those of the squared envelope" in " ".join(done.stdout.split())
    assert "[Hz]" in done.stdout and f"[{squared(found.unit)}]" in done.stdout
    assert (squared("N"), squared("m/s2")) == ("N²", "(m/s2)²")
    assert {path.name for path in tmp_path.iterdir()} == {"spall.parquet", "spall_spectrum.csv", "spall_spectrum.png"}


# ------------------------------------------------------------------------------------------------------------- profiles


def test_profile_as_waves(tmp_path, fmu):
    """A measured turn of uneven angles gives back its waves; the scene sets them as parameters."""
    rng = np.random.default_rng(3)
    phi = np.sort(rng.uniform(0.0, 2.0 * np.pi, 2000))
    h = 3e-6 + 1e-6 * np.cos(9 * phi + 0.4) + 4e-7 * np.cos(60 * phi - 2.0)
    amplitude, phase = waves_of(phi, h)
    expected = np.zeros(60)
    expected[[8, 59]] = 1e-6, 4e-7
    np.testing.assert_allclose(amplitude, expected, atol=1e-18)
    np.testing.assert_allclose(phase[[8, 59]], [0.4, -2.0], atol=1e-9)
    with pytest.raises(UserError, match=r"57\.\d turns; one is allowed: angles without a unit are in rad"):
        waves_of(np.degrees(phi), h)
    rows = "\n".join(f"{math.degrees(a)},{1e6 * b}" for a, b in zip(phi, h, strict=True))
    (tmp_path / "race.csv").write_text(f"phi,h\n{rows}\n")
    text = '[surfaces]\nouter = { file = "race.csv", angle = "phi", angle_unit = "deg", height = "h", unit = "um" }\n'
    (tmp_path / "mine.toml").write_text(text)
    scene = load_scene(tmp_path / "mine.toml", Model(fmu))
    assert scene.parameters["outer.waviness[9]"] == pytest.approx(1e-6, rel=1e-9)
    assert scene.parameters["outer.waviness_phase[60]"] == pytest.approx(-2.0, abs=1e-6)
    (tmp_path / "race.csv").write_text("phi,h\n" + "\n".join(f"{k},0" for k in range(180)) + "\n")
    with pytest.raises(UserError, match=r"surfaces\.outer.*a gap of 181 deg"):
        load_scene(tmp_path / "mine.toml", Model(fmu))


# ------------------------------------------------------------------------------------------------------------- datasets

STUDY = """scene = "spall"
[simulation]
t_end = 0.08
[[vary]]
outer.spall_length = ["0 mm", "1 mm"]
outer.spall_width = ["0 mm", "3 mm"]
outer.spall_depth = ["0 um", "50 um"]
"""


def test_labels():
    both = {
        "outer.spall_length": 1e-3,
        "outer.spall_width": 2e-3,
        "outer.spall_depth": 1e-5,
        "inner.spall_length": 2e-3,
    }
    both |= {"inner.spall_width": 3e-3, "inner.spall_depth": 2e-5, "outer.waviness[3]": 1e-6}
    found = labels(both)
    assert found["label.fault"] == "both" and found["label.length"] == 2e-3 and found["label.depth"] == 2e-5
    assert found["label.waviness"] == 1e-6
    assert labels({})["label.fault"] == "none"
    ball = {
        "ball[3].spall_length": 5e-3,
        "ball[3].spall_width": 4e-3,
        "ball[3].spall_depth": 3e-5,
        "ball[4].spall_length": 0.0,
    }
    assert labels(ball)["label.fault"] == "ball" and labels(both | ball)["label.length"] == 5e-3
    assert labels(both | ball)["label.fault"] == "outer+inner+ball"


def test_dataset(tmp_path, fmu):
    """Two signals with labels and as many samples as the time after settling has; a second call runs nothing."""
    from pyarrow import parquet

    (tmp_path / "study.toml").write_text(STUDY)
    words = tmp_path / "study.toml", "--fmu", fmu, "--out", tmp_path / "out"
    done = typed("dataset --workers 1", *words)
    assert done.exit_code == 0, done.stderr
    assert "2 signals (none 1, outer 1), 0 of them failed" in done.stdout
    table = parquet.read_table(tmp_path / "out" / "runs.parquet").to_pylist()
    assert [row["label.fault"] for row in table] == ["none", "outer"]
    assert [len(row["signal.housing.a_y"]) for row in table] == [1201, 1201]  # 30 ms at 40 kHz
    assert table[1]["signal.rate"] == pytest.approx(40_000.0) and table[1]["label.length"] == 1e-3
    assert table[1]["frequency.BPFO"] == pytest.approx(178.0, abs=2.0)
    rms = [np.sqrt(np.mean(np.square(row["signal.housing.a_y"]))) for row in table]
    assert rms[1] > 5.0 * rms[0]
    before = {row["key"]: row["date"] for row in table}
    assert typed("dataset --workers 1", *words).exit_code == 0
    again = parquet.read_table(tmp_path / "out" / "runs.parquet").to_pylist()
    assert {row["key"]: row["date"] for row in again} == before


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ('[dataset]\nchannels = ["housing.q"]\n', "housing.q"),
        ("[dataset]\nchanels = []\n", "dataset.chanels"),
        ("[simulation]\nt_end = 0.04\n", r"simulation\.t_end = 0\.04 s: more than start\.settle"),
    ],
)
def test_wrong_datasets(tmp_path, fmu, text, complaint):
    (tmp_path / "study.toml").write_text('scene = "spall"\n' + text)
    with pytest.raises(UserError, match=complaint):
        load_dataset(tmp_path / "study.toml", Model(fmu))
