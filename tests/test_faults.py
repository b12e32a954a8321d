"""Published rules of faulty bearings against runs: which orders of waves move the ring, where the lines of spalls are."""

import numpy as np
import pytest

from riveted_bearing import build, run
from riveted_bearing.running.summary import settled
from riveted_bearing.show.spectrum import amplitude_spectrum, spectra

pytestmark = pytest.mark.slow  # minutes: 13 runs of 1.2 s; an FMU of its own and four runs of 2 s
Z, A, SHAFT = 9, 5e-8, 10.0  # balls, amplitude of the waves [m], turns of the shaft a second

# Order: harmonic k of the balls, and -1 or 1 for waves across the axis at n = Z k -+ 1, 0 for waves along it at n = Z k
RULE = {Z - 1: (1, -1), Z: (1, 0), Z + 1: (1, 1), 2 * Z - 1: (2, -1)}
STILL = (Z - 2, 2 * Z + 2)


def moves(parameters):
    """Lines of the ring's motion across and along the axis, [Hz] and [m], the cage's turns a second, the contact angle."""
    inputs = {"shaft.F_x": 600.0, "shaft.F_y": 0.0, "shaft.omega": 2.0 * np.pi * SHAFT}
    parameters = {"scene.cage": "two_half", "start.spacing": 0.0, "start.settle": 0.2} | parameters
    outputs = ["ring.x", "ring.y", "cage.omega", "ball[1].alpha_e"]
    result = run(parameters=parameters, inputs=inputs, t_end=1.2, step=1e-3, outputs=outputs)
    rows = settled(result)
    found = [amplitude_spectrum(result.data[name][rows], 1000.0) for name in ("ring.y", "ring.x")]
    return *found, np.mean(result.data["cage.omega"][rows]) / (2.0 * np.pi), np.mean(result.data["ball[1].alpha_e"])


def strongest(spectrum):
    """Frequency and amplitude of the strongest line under a Hann window, whose three bins hold 1.5 of its square."""
    f, amplitude = spectrum
    i = int(np.clip(np.argmax(amplitude[1:]) + 1, 1, len(f) - 2))
    bins = amplitude[i - 1 : i + 2]
    return np.sum(bins**2 * f[i - 1 : i + 2]) / np.sum(bins**2), np.sqrt(np.sum(bins**2) / 1.5)


@pytest.mark.parametrize("race", ["outer", "inner"])
def test_orders_that_move_a_running_ring(race):
    """Wardle (1988, Proc. Inst. Mech. Eng. C 202, 289), Harsha (2006, J. Sound Vib. 289, 360): waves of the orders n = Z k on
    the outer race move the ring along its axis with k Z f_c, n = Z k -+ 1 across it, on the inner race with k Z (f - f_c)
    and k Z (f - f_c) +- f; other orders do not.  Frequencies of the computed cage speed, within half the resolution of
    1 Hz; A/cos(alpha) across to 3 %: second-order terms, and 0.1 % by the ring's inertia at 108 Hz.
    """
    for n, (k, side) in RULE.items():
        across, along, f_c, alpha = moves({f"{race}.waviness[{n}]": A})
        rate = k * Z * f_c if race == "outer" else k * Z * (SHAFT - f_c) + side * SHAFT
        moved, still = (across, along) if side else (along, across)
        f, amplitude = strongest(moved)
        assert f == pytest.approx(rate, abs=0.5), n
        assert strongest(still)[1] < 0.05 * A, n
        if side:
            assert amplitude == pytest.approx(A / np.cos(alpha), rel=0.03), n
        else:
            assert amplitude > 2.0 * A, n
    for n in STILL:
        across, along, *_ = moves({f"{race}.waviness[{n}]": A})
        assert max(strongest(across)[1], strongest(along)[1]) < 0.05 * A, n


BEARING_6205 = """designation = "6205"
Z = 9
[catalogue]
bore = "25 mm"
outside_diameter = "52 mm"
width = "15 mm"
[parameters]
bearing.D = "7.94 mm"
bearing.d_m = "39.04 mm"
"""
FAULT = {"length": 0.18e-3, "width": 0.18e-3, "depth": 0.28e-3}  # the smallest of the data set: 0.007 inch, 0.011 deep
TURNS = 1750.0 / 60.0
PUBLISHED = {"BPFO": 3.5848, "BPFI": 5.4152, "FTF": 0.39828, "BSF": 4.7135 / 2.0}  # of the shaft's speed, no slip


def envelope(fmu, body):
    """Spectra of the housing's acceleration over 2 s, its envelope between 2 and 18 kHz, with the fault on a race or a ball.
    After 1 s the side bands of this smallest fault are 3.5 times the median around them, after 2 s 7 times.
    """
    parameters = {"scene.cage": "two_half", "housing.motion": "supported"}
    for i in "xyz":
        parameters |= {f"housing.k_{i}": 4e8, f"housing.c_{i}": 2000.0}
    parameters |= {f"{body}.spall_{name}": value for name, value in FAULT.items()} if body else {}
    inputs = {"shaft.F_x": 50.0, "shaft.F_y": 1000.0, "shaft.omega": 2.0 * np.pi * TURNS}
    outputs = ["housing.a_y", "cage.omega", "shaft.omega", "housing.omega", "ball[1].alpha_e"]
    result = run(parameters=parameters, inputs=inputs, fmu=fmu, t_end=2.05, step=2.5e-5, outputs=outputs)
    return spectra(result, channel="housing.a_y", band=(2000.0, 18_000.0))


def height(found, f):
    """Amplitude of the envelope within the resolution of the frequency f, over the median around it."""
    near = found.envelope[np.abs(found.envelope_frequency - f) <= found.resolution].max()
    return near / np.median(found.envelope[np.abs(found.envelope_frequency - f) < 25.0])


def check_faults(fmu):
    whole = envelope(fmu, None)
    line = whole.kinematic
    for name, order in PUBLISHED.items():
        assert line[name] == pytest.approx(order * TURNS, rel=5e-3)  # slip, and the contact angle of 5 degrees
    BPFO, BPFI, FTF, BSF = (line[name] for name in ("BPFO", "BPFI", "FTF", "BSF"))
    own = {
        "outer": (BPFO, 2.0 * BPFO, 3.0 * BPFO),
        "inner": (BPFI, BPFI - TURNS, BPFI + TURNS, 2.0 * BPFI),
        "ball[1]": (2.0 * BSF, 2.0 * BSF - FTF, 2.0 * BSF + FTF, 4.0 * BSF),
    }
    found = {body: envelope(fmu, body) for body in own}
    for body, lines in own.items():
        for f in lines:  # stands out where its fault is
            assert height(found[body], f) > 4.0, (body, f)
    for body in ("inner", "ball[1]"):  # and nowhere else; the outer race's is that of varying compliance too
        for other in found.keys() - {body}:
            assert height(found[other], own[body][0]) < 4.0, (body, other)
    # side bands: of the shaft about the inner race's line, of the cage about the ball's, none about the outer race's
    assert max(height(found["outer"], BPFO + side * TURNS) for side in (-1.0, 1.0)) < 4.0
    grown = [height(found["outer"], k * BPFO) / height(whole, k * BPFO) for k in (1.0, 2.0, 3.0)]
    assert min(grown) > 1.0 and max(grown) > 3.0


def test_case_western_6205(tmp_path):
    """A 6205 as on the test rig of Case Western Reserve University, faults of 0.18 mm at 1,750 r/min: orders of the data
    set's table to the slip, lines and side bands where they belong.  Amplitudes are not compared: load, path to the
    sensor and shape of the eroded fault are not known.
    """
    (tmp_path / "6205.toml").write_text(BEARING_6205)
    check_faults(build(str(tmp_path / "6205.toml"), out=tmp_path / "6205.fmu", table="closed-form"))
