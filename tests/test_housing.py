"""A housing on springs: against a mass that a host integrates outside, and against the twin's law."""

import numpy as np
import pytest
from mechanics import Instance

from bearing_model.generated.variables import INPUTS
from bearing_model.physics.housing import AXES, housing_acceleration, housing_base, housing_place
from bearing_model.physics.model import Model, Work
from bearing_model.physics.rhs import rhs
from bearing_model.solver.integrator import simulate
from bearing_model.solver.start import start_state

SUPPORTED = {"scene.cage": 1, "housing.motion": 2, "housing.m": 2.0, "housing.J": 2e-3, "start.spacing": 0.0}
SUPPORTED |= {f"housing.k_{i}": k for i, k in zip("xyz", (3e7, 5e7, 4e7), strict=True)}
SUPPORTED |= {f"housing.c_{i}": 600.0 for i in "xyz"}
SUPPORTED |= {"housing.k_tilt_y": 3e4, "housing.k_tilt_z": 5e4, "housing.c_tilt_y": 0.4, "housing.c_tilt_z": 0.3}
SPALL = {"outer.spall_length": 1e-3, "outer.spall_width": 4e-3, "outer.spall_depth": 3e-5}
MASS = {name: value for name, value in SUPPORTED.items() if name != "housing.motion"}
SHAKEN = {
    "housing.x": 4e-6,
    "housing.v_y": 0.01,
    "housing.tilt_z": 3e-4,
    "housing.v_z": -0.02,
    "housing.tilt_y_dot": 0.2,
}
OUT = [f"housing.{kind}_{axis}" for kind in "ua" for axis in "xyz"]


def outputs(instance, names):
    return np.array([instance.output(name) for name in names])


def test_start_is_at_rest(core):
    """The springs carry the load of the start: the housing does not move yet, and its acceleration is 0."""
    instance = Instance(core, SUPPORTED)
    assert np.all(outputs(instance, OUT) == 0.0)
    assert instance.output("housing.F_y") == pytest.approx(2994.0, rel=0.01)


def test_against_the_law_of_the_twin(core):
    """Accelerations along a run against the law with the outputs' forces: the core's force is that of the step's
    predicted velocities, the outputs' that of the corrected ones; 5 % of the largest.
    """
    instance = Instance(core, SUPPORTED | SPALL)
    rest_model = Model.of(SUPPORTED | SPALL, {})
    w = Work()
    rhs(rest_model, 0.0, instance.y, w)
    zero = np.zeros(5)
    rest = housing_acceleration(rest_model, w, zero, zero, zero, zero, zero) * np.array([2.0, 2.0, 2.0, 2e-3, 2e-3])
    u, F, a = [], [], []
    for n in range(1, 200):
        instance.step(2e-5 * n)
        u.append(outputs(instance, OUT[:3])), a.append(outputs(instance, OUT[3:]))
        F.append(outputs(instance, [f"housing.F_{axis}" for axis in "xyz"]))
    u, F, a = np.array(u), np.array(F), np.array(a)
    v = np.gradient(u, 2e-5, axis=0)
    law = (F - rest[:3] - np.array([3e7, 5e7, 4e7]) * u - 600.0 * v) / 2.0
    assert np.abs(a).max() > 10.0
    np.testing.assert_allclose(a[1:-1], law[1:-1], atol=0.05 * np.abs(a).max())


def test_law_at_a_displaced_base():
    """The twin's law by hand at one displaced and moving base: springs and damping alone against their definition."""
    model = Model.of(SUPPORTED, SHAKEN)
    base, base_dot = housing_base(model.ring_load)
    x, v = base + np.array([1e-6, 2e-6, -1e-6, 1e-5, -2e-5]), base_dot + np.array([0.01, 0.0, 0.02, 0.1, -0.1])
    model.ring_load = housing_place(x, v, model.ring_load)
    y, w = start_state(Model.of(SUPPORTED))[0], Work()
    rhs(model, 0.0, y, w)
    moved = housing_acceleration(model, w, x, v, base, base_dot, np.zeros(5))
    still = housing_acceleration(model, w, x, v, x, v, np.zeros(5))
    k, c = np.array([3e7, 5e7, 4e7, 3e4, 5e4]), np.array([600.0, 600.0, 600.0, 0.4, 0.3])
    inertia = np.array([2.0, 2.0, 2.0, 2e-3, 2e-3])
    np.testing.assert_allclose(moved - still, -(k * (x - base) + c * (v - base_dot)) / inertia, rtol=1e-9)


def test_against_a_mass_outside(core):
    """The same housing integrated by a host, which gives the outer ring's motion in steps of 1 us by the force that it
    reads: displacements over 1 ms within 2 % of their range (first-order coupling, h omega = 1e-6 * 7e3 = 0.7 %).
    """
    step, t_end = 1e-6, 1e-3
    inside = Instance(core, SUPPORTED | SPALL)
    outside = Instance(core, MASS | SPALL)
    force = [f"housing.F_{axis}" for axis in "xyz"] + ["housing.M_y", "housing.M_z"]
    k, c = np.array([3e7, 5e7, 4e7, 3e4, 5e4]), np.array([600.0, 600.0, 600.0, 0.4, 0.3])
    inertia = np.array([2.0, 2.0, 2.0, 2e-3, 2e-3])
    rest = outputs(outside, force)
    x, v, found, expected = np.zeros(5), np.zeros(5), [], []
    names = ("x", "y", "z", "tilt_y", "tilt_z"), ("v_x", "v_y", "v_z", "tilt_y_dot", "tilt_z_dot")
    for n in range(1, round(t_end / step) + 1):
        a = (outputs(outside, force) - rest - k * x - c * v) / inertia
        v_new = v + step * a
        given = dict(zip(names[0], x, strict=True)) | dict(zip(names[1], v, strict=True))
        outside.set(**{f"housing.{name}": float(value) for name, value in given.items()})
        rates = {f"housing.{name}": float(value) for name, value in zip(names[1], a, strict=True)}
        core.set_values(core.lib.part_inputs(outside.bearing, 1), INPUTS, rates)
        outside.step(n * step)
        x, v = x + step * v + 0.5 * step**2 * a, v_new
        inside.step(n * step)
        found.append(outputs(inside, [f"housing.u_{axis}" for axis in AXES]))
        expected.append(x.copy())
    found, expected = np.array(found), np.array(expected)
    assert np.ptp(expected[:, 1]) > 1e-7
    for i in range(5):
        assert np.abs(found[:, i] - expected[:, i]).max() < 0.02 * np.ptp(expected[:, i]) + 1e-11


def test_state_goes_on_with_the_same_bits(core):
    """The housing's motion is in the saved state."""
    a = Instance(core, SUPPORTED | SPALL).step(2e-4).step(4e-4)
    saved = core.ffi.new("char[]", core.lib.part_saved_size())
    core.lib.part_save(a.bearing, saved)
    first = outputs(a.step(6e-4).step(8e-4), OUT)
    b = Instance(core, SUPPORTED | SPALL)
    core.lib.part_restore(b.bearing, saved)
    np.testing.assert_array_equal(outputs(b.step(6e-4).step(8e-4), OUT), first)
    assert np.all(first != 0.0)


def test_fixed_steps(core):
    """Steps of one length take the housing along: displacements over 1 ms as with the default method, to 2 %."""
    runs = [Instance(core, SUPPORTED | SPALL | extra) for extra in ({}, {"solver.method": 3, "solver.step": 1e-6})]
    found = []
    for n in range(1, 51):
        found.append([outputs(run.step(2e-5 * n), OUT[:3]) for run in runs])
    found = np.array(found)
    assert np.abs(found[:, 0] - found[:, 1]).max() < 0.02 * np.ptp(found[:, 0, 1])


def test_refusals(core):
    with pytest.raises(ValueError, match="housing.motion = 2: given .1. is allowed for solver.method = explicit"):
        Instance(core, SUPPORTED | {"solver.method": 2})
    with pytest.raises(ValueError, match="the FMU alone integrates a housing on springs"):
        simulate(SUPPORTED, t_end=1e-4)
