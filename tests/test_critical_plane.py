"""Findley's critical plane against its closed forms."""

import numpy as np
import pytest

from bearing_model.critical_plane import findley, logged_load, plane_normals, worst_point
from bearing_model.rivet.rivet_rom import RivetLoad
from rivet_model import components, load_cases, reduction
from rivet_model.geometry import Geometry

CYCLE = np.sin(np.linspace(0, 2 * np.pi, 73))


@pytest.mark.parametrize("k", [0.0, 0.1, 0.3])
def test_reversed_tension(k):
    """f = sigma_a/2 (sqrt(1 + k^2) + k): planes 2.5 degrees off at worst cost 0.4 % (observed 0.1 %)."""
    worst = findley(np.stack([100e6 * CYCLE, 0 * CYCLE, 0 * CYCLE]), k, 2.5)
    assert worst.f == pytest.approx(50e6 * (np.sqrt(1 + k**2) + k), rel=4e-3)


@pytest.mark.parametrize("k", [0.0, 0.3])
def test_reversed_shear(k):
    """f = tau_a sqrt(1 + k^2)."""
    worst = findley(np.stack([0 * CYCLE, 0 * CYCLE, 80e6 * CYCLE]), k, 2.5)
    assert worst.f == pytest.approx(80e6 * np.sqrt(1 + k**2), rel=4e-3)


def test_mean_stress_and_direction():
    """A mean tension adds k times its part on the plane; turning the stress by 90 degrees changes nothing."""
    pulsating = 100e6 * (1 + CYCLE)
    one = findley(np.stack([pulsating, 0 * CYCLE, 0 * CYCLE]), 0.3, 2.5)
    other = findley(np.stack([0 * CYCLE, pulsating, 0 * CYCLE]), 0.3, 2.5)
    assert one.f == pytest.approx(other.f, rel=1e-3)  # directions in a plane are 5 degrees apart: 0.1 %
    # max of sin(2a)/2 sigma_a + k cos^2(a) 2 sigma_a = k sigma_a + sigma_a sqrt(1/4 + k^2)
    assert one.f == pytest.approx(100e6 * (0.3 + np.sqrt(0.25 + 0.09)), rel=4e-3)


def test_out_of_phase_is_worse_than_its_parts():
    """Tension and shear in quadrature: more than either alone, less than both in phase on one plane."""
    cosine = np.cos(np.linspace(0, 2 * np.pi, 73))
    alone = findley(np.stack([100e6 * CYCLE, 0 * CYCLE, 0 * CYCLE]), 0.3).f
    quadrature = findley(np.stack([100e6 * CYCLE, 0 * CYCLE, 60e6 * cosine]), 0.3).f
    in_phase = findley(np.stack([100e6 * CYCLE, 0 * CYCLE, 60e6 * CYCLE]), 0.3).f
    assert alone < quadrature < in_phase


def test_normals_and_refusals():
    np.testing.assert_allclose(np.linalg.norm(plane_normals(10.0), axis=1), 1.0)
    with pytest.raises(ValueError, match="shape"):
        findley(np.zeros((2, 5)))


def test_the_worst_point_is_the_worst():
    """Bounded search = trying all points, on random histories with one place much calmer than the other."""
    rng = np.random.default_rng(3)
    fields = [scale * rng.normal(size=(3, 4, 5, 6)) for scale in (1e8, 2e7)]
    place, point, angle, worst = worst_point(fields, 0.3, 15.0)
    tried = {
        (i, *at): findley(f[:, at[0], at[1]], 0.3, 15.0).f
        for i, f in enumerate(fields)
        for at in np.ndindex(*f.shape[1:3])
    }
    assert (place, point, angle) == max(tried, key=tried.get) and worst.f == max(tried.values())


# Stress components of the rivet ---------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def joint():
    return load_cases.Joint(Geometry(), load_cases.COARSE)


@pytest.fixture(scope="module")
def rivet(joint):
    return components.make(Geometry(), coarse=True, workers=1, hold_out=0)


def fresh(joint, load, fit):
    """Fields of one load, V along y, by a fresh solution."""
    return [
        f[..., 0]
        for f in joint.fields(
            joint.solve_shank(load.T, load.V_y, load.m_z, load.m_y, fit)[0][:, None], components.ANGLES
        )
    ]


def test_components_follow_the_finite_elements(rivet, joint):
    """At the sites of the axes and the sheets' directions they are the finite elements' fields, in all quadrants of m
    (24 modes: observed 0.5 %).
    """
    T, V, m = reduction.shank_loads(0.25, 0.5, reduction.LENGTH)
    for sign_plane, sign_across in ((1, 1), (-1, 1), (1, -1), (-1, -1)):
        load = RivetLoad(T, V, 0.0, sign_across * m * np.sin(np.pi / 3), sign_plane * m * np.cos(np.pi / 3))
        for got, expected in zip(rivet.fields(load, -550e-9), fresh(joint, load, -550e-9), strict=True):
            np.testing.assert_allclose(got[..., 0], expected, atol=0.02 * np.abs(expected).max())


def test_components_turn_with_the_load(rivet):
    """The load turned by two of the sixteen angles: the fields move on by two (rounding)."""
    one = RivetLoad(25.0, 12.0, 0.0, 0.002, 0.004)
    c, s = np.cos(np.pi / 4), np.sin(np.pi / 4)
    other = RivetLoad(25.0, c * 12.0, s * 12.0, c * 0.002 - s * 0.004, s * 0.002 + c * 0.004)
    for a, b in zip(rivet.fields(one, -6e-6), rivet.fields(other, -6e-6), strict=True):
        np.testing.assert_allclose(np.roll(a, 2, axis=2), b, atol=1e-9 * np.abs(a).max())


def test_components_of_a_logged_history(rivet, tmp_path):
    """Read back from a file, at the loads of a run's outputs; a turning V makes a cycle of a constant channel, and the
    head is the worst place.
    """
    components.write(rivet, tmp_path / "components.npz")
    again = components.read(tmp_path / "components.npz", Geometry().digest)
    turn, one = np.linspace(0.0, 2 * np.pi, 24), np.ones(24)
    values = {
        "T": 25 * one,
        "V_y": 12 * np.cos(turn),
        "V_z": 12 * np.sin(turn),
        "M_shank_y": 0 * one,
        "M_shank_z": 0 * one,
        "F_head": 0 * one,
    }
    load = logged_load({f"rivet[3].{name}": value for name, value in values.items()}, 3)
    fields = again.fields(load, -6e-6)
    for a, b in zip(fields, rivet.fields(load, -6e-6), strict=True):
        np.testing.assert_allclose(a, b, atol=1e-5 * np.abs(b).max())  # single precision in the file
    largest = np.array([load_cases.surface_stress(*f)[0].max(axis=(0, 1)) for f in fields[:2]]).max(axis=0)
    assert np.ptp(largest) < 0.1 * largest.max()  # the channel hardly changes
    place, point, angle, worst = worst_point(fields, 0.3, 15.0)
    assert place in (0, 1) and np.ptp(fields[place][0, point, angle]) > 0.3 * largest.max()  # but each point cycles
    inclined = max((np.ptp(field[0], axis=-1) / 4 + 0.3 * field[0].max(axis=-1) / 2).max() for field in fields)
    assert worst.f >= inclined  # at least what the meridian stress alone does to the plane at 45 degrees
    with pytest.raises(ValueError, match="made for geometry"):
        components.read(tmp_path / "components.npz", "another")
    (tmp_path / "text.npz").write_text("no components")
    with pytest.raises(ValueError, match="not a file of rivet components"):
        components.read(tmp_path / "text.npz")
