"""Ribbon cages of bearings by rule and by bearing files: sizes, marks of their origin, refusals by the user's key."""

import numpy as np
import pytest

from rivet_model import half_shape, ribbon_shape
from riveted_bearing.base.errors import UserError
from riveted_bearing.bearing import ribbon
from riveted_bearing.bearing.bearing_file import bearing_case
from riveted_bearing.building.rivet import geometry_of

MM = 1e-3


@pytest.mark.parametrize(
    ("designation", "sheet", "depth", "radius", "ring", "shank"),
    [("6205", 0.8, 4.02, 4.07, 3.57, 1.2), ("6309", 1.5, 8.80, 8.87, 7.86, 1.5)],
)
def test_sizes_of_the_handbook(designation, sheet, depth, radius, ring, shank):
    """Two bearings worked out by hand from the handbook's rules, to 0.005 mm."""
    case = bearing_case(designation, cage="ribbon")
    v, tolerance = case.values, 0.0051 * MM
    assert v["cage.sheet"] == pytest.approx(sheet * MM, abs=1e-9)
    assert v["cage.pocket_depth"] == pytest.approx(depth * MM, abs=tolerance)
    assert 0.5 * (v["bearing.D"] + v["cage.pocket_clearance"]) == pytest.approx(radius * MM, abs=tolerance)
    assert 0.5 * (v["cage.D_o"] - v["cage.D_i"]) == pytest.approx(ring * MM, abs=tolerance)
    assert case.rivet["shank_diameter"] == pytest.approx(shank * MM)
    assert case.rivet["head_diameter"] == pytest.approx(1.6 * shank * MM)
    assert v["cage.guidance"] == "balls" and case.materials["cage"].name == "DC04"
    names = ("cage.sheet", "cage.pocket_depth", "cage.pocket_fillet", "cage.E", "fatigue.sigma_m")
    assert {case.origin[name] for name in names} == {"rule"} and case.origin["cage.shape"] == "yours"


@pytest.mark.parametrize("designation", ["6005", "6205", "6309", "6316", "6010", "6222"])
def test_every_size_can_be_built(designation):
    """Small to large, light to heavy: within the limits, seam below the contact of both halves, mass by the shape."""
    case = bearing_case(designation, cage="ribbon")
    g = geometry_of(case)
    half_shape.check_half(g)
    assert g.shape == "ribbon" and g.flange_thickness == case.values["cage.sheet"]
    assert ribbon_shape.seam(g) < 0.7 * ribbon_shape.both_halves(g)
    assert np.rad2deg(ribbon_shape.both_halves(g)) == pytest.approx(30.0, abs=0.1)
    assert case.values["cage.m"] == pytest.approx(half_shape.half_inertia(g).m, rel=1e-5)
    machined = bearing_case(designation).values["cage.m"]
    assert case.values["cage.m"] < 0.6 * machined


def test_machined_stays_as_it_is():
    """Without --cage, and with machined, nothing of the ribbon comes in."""
    plain, machined = bearing_case("6309"), bearing_case("6309", cage="machined")
    assert plain.values == machined.values and plain.values["cage.shape"] == "machined"
    assert plain.values["cage.sheet"] == 0.0 and geometry_of(plain).shape == "machined"


def written(tmp_path, text):
    path = tmp_path / "mine.toml"
    path.write_text(f'designation = "6309"\n[parameters]\ncage.shape = "ribbon"\n{text}', encoding="utf-8")
    return path


def test_own_sizes_in_a_file(tmp_path):
    """Sheet, depth and radius of a file decide width, clearance and mass; a material of its own stays."""
    path = written(tmp_path, 'cage.sheet = "1.2 mm"\ncage.pocket_radius = "8.9 mm"\n[cage]\nmaterial = "brass"\n')
    case = bearing_case(path)
    assert case.values["cage.pocket_clearance"] == pytest.approx(2 * 8.9 * MM - case.values["bearing.D"], rel=1e-9)
    assert case.values["cage.width"] == pytest.approx(2 * (case.values["cage.pocket_depth"] + 1.2 * MM), rel=1e-9)
    assert case.materials["cage"].name == "brass" and case.rivet["flange_thickness"] == pytest.approx(1.2 * MM)
    assert case.values["cage.m"] == pytest.approx(half_shape.half_inertia(geometry_of(case)).m, rel=1e-5)


def test_other_refusals(tmp_path):
    with pytest.raises(UserError, match="--cage.*wicker.*machined"):
        bearing_case("6309", cage="wicker")
    with pytest.raises(UserError, match="6207"):
        bearing_case("6207", cage="ribbon")
    path = tmp_path / "mine.toml"
    path.write_text('designation = "6309"\n[parameters]\ncage.shape = "machined"\n', encoding="utf-8")
    with pytest.raises(UserError, match="another one"):
        bearing_case(path, cage="ribbon")


def test_sheet_is_stock():
    """Thicknesses are stock sizes and do not fall with the ball, in either series."""
    for series in ("2", "3"):
        found = [ribbon.sheet(d * MM, f"6{series}00") for d in np.linspace(4.0, 40.0, 73)]
        assert np.all(np.diff(found) >= 0.0) and {round(1e3 * s, 3) for s in found} <= set(ribbon.STOCK)
