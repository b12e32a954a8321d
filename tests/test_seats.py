"""Tolerance classes of seats against the tables of ISO 286-2 and as values of a bearing file and a scene."""

from bisect import bisect_left

import pytest
from commands import typed

from riveted_bearing import UserError
from riveted_bearing.bearing.bearing_file import bearing_case
from riveted_bearing.bearing.seats import UP_TO, deviations, interference
from riveted_bearing.running.fmu import Model
from riveted_bearing.running.scene import load_scene

# class, diameter [mm], lower and upper deviation [um] of ISO 286-2
SHAFTS = [
    ("k5", 35, 2, 13),
    ("m6", 50, 9, 25),
    ("n6", 60, 20, 39),
    ("j6", 40, -5, 11),
    ("h6", 25, -13, 0),
    ("g6", 30, -20, -7),
]
SHAFTS += [
    ("f7", 45, -50, -25),
    ("p6", 100, 37, 59),
    ("js6", 20, -6.5, 6.5),
    ("j5", 70, -7, 6),
    ("k6", 110, 3, 25),
    ("m5", 18, 7, 15),
]
HOLES = [
    ("H7", 72, 0, 30),
    ("J7", 72, -12, 18),
    ("K7", 40, -18, 7),
    ("M7", 100, -35, 0),
    ("N7", 62, -39, -9),
    ("P7", 52, -51, -21),
]
HOLES += [
    ("G7", 80, 10, 40),
    ("K6", 90, -18, 4),
    ("J6", 52, -6, 13),
    ("JS7", 120, -17.5, 17.5),
    ("H8", 200, 0, 72),
    ("K8", 47, -27, 12),
]


@pytest.mark.parametrize(("name", "mm", "low", "high"), SHAFTS + HOLES)
def test_deviations_of_the_standard(name, mm, low, high):
    letter = name.rstrip("0123456789")
    assert deviations(letter, int(name[len(letter) :]), bisect_left(UP_TO, mm)) == (low, high)


def test_interference_of_seats():
    """k5 of 35 mm is 2 to 13 um over a bore 0 to 12 um under 35 mm: 13.5 um; H7 of 72 mm against 0 to 13 um: -21.5 um."""
    assert interference("shaft.interference", "k5", 0.035) == pytest.approx(13.5e-6)
    assert interference("housing.interference", "H7", 0.072) == pytest.approx(-21.5e-6)
    assert interference("housing.interference", "N7", 0.062) == pytest.approx(24e-6 - 6.5e-6)


@pytest.mark.parametrize(
    ("name", "written", "size", "said"),
    [
        ("shaft.interference", "K5", 0.035, "small"),
        ("housing.interference", "h7", 0.072, "large"),
        ("shaft.interference", "q6", 0.035, "allowed: e, f, g, h"),
        ("shaft.interference", "j8", 0.035, "j from 5 to 7"),
        ("shaft.interference", "k6", 0.3, "from 3 to 250 mm"),
    ],
)
def test_other_classes_are_refused(name, written, size, said):
    with pytest.raises(UserError, match=said):
        interference(name, written, size)


def test_classes_in_files(tmp_path):
    """The same number in a bearing file, in a scene and on the command line; what cannot be names file and key."""
    file = tmp_path / "own.toml"
    file.write_text('designation = "6207"\n[parameters]\nshaft.interference = "k5"\nhousing.interference = "J7"\n')
    values = bearing_case(file).values
    assert (values["shaft.interference"], values["housing.interference"]) == pytest.approx((13.5e-6, -9.5e-6))
    scene = load_scene(
        None, Model(), ("test", {"parameters": {"shaft.interference": "k5", "housing": {"interference": "J7"}}})
    )
    assert scene.parameters["shaft.interference"] == pytest.approx(13.5e-6)
    assert scene.parameters["housing.interference"] == pytest.approx(-9.5e-6)
    file.write_text('designation = "6207"\n[parameters]\nshaft.interference = "K5"\n')
    said = typed("info", file).output
    assert "parameters.shaft.interference = 'K5': letters of a shaft's are small" in " ".join(said.split())
