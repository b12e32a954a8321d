"""Findley's critical plane against its closed forms."""

import numpy as np
import pytest

from bearing_model.critical_plane import findley, logged_load, plane_normals, worst_point
from rivet_model.geometry import Geometry
from rivet_model.load_cases import COARSE, Joint, surface_stress

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


def test_the_worst_point_under_a_turning_load():
    """Under a load that turns about the rivet the fields turn with it: every point cycles, the worst is at a head."""
    joint, count = Joint(Geometry(), COARSE), 16
    forces, _ = joint.solve_shank(25.0, 12.0, 0.0, 0.0, -6e-6)
    start = joint.fields(forces[:, None], count)
    fields = [np.concatenate([np.roll(field, n, axis=2) for n in range(count)], axis=-1) for field in start]
    place, point, angle, worst = worst_point(fields, 0.3, 15.0)
    largest = max(surface_stress(*field)[0].max() for field in fields[:2])
    assert place in (0, 1) and np.ptp(fields[place][0, point, angle]) > 0.3 * largest
    inclined = max((np.ptp(field[0], axis=-1) / 4 + 0.3 * field[0].max(axis=-1) / 2).max() for field in fields)
    assert worst.f >= inclined  # at least what the meridian stress alone does to the plane at 45 degrees


def test_loads_of_a_run():
    outputs = {"T": "T", "V_y": "V_y", "V_z": "V_z", "M_shank_y": "m_y", "M_shank_z": "m_z", "F_head": "F_head"}
    load = logged_load({f"rivet[3].{output}": [float(n), 10.0 + n] for n, output in enumerate(outputs)}, 3)
    assert [getattr(load, name).tolist() for name in outputs.values()] == [[n, 10.0 + n] for n in range(len(outputs))]
