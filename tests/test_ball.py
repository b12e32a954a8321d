"""A ball that nothing touches: a straight path (or a parabola) and a spin that does not turn, seen from its turning
frame.
"""

import numpy as np
import pytest
from mechanics import SLICE, Z, frames
from scipy.integrate import solve_ivp

NAMES = [f"ball_{name}" for name in ("x", "r", "theta", "v_x", "v_r", "omega_m", "omega_x", "omega_r", "omega_t")]
D, RHO = 0.0111125, 7800.0


def free_balls(core, **parameters):
    """The derivative of the 9 Z states of balls without races, pockets and drag, and a random start."""
    model = core.model(parameters={"oil.rho_mix": 0.0} | parameters)
    y = model.start()
    model.d.inner.hertz.K = model.d.outer.hertz.K = model.d.pocket.K = 0.0
    index = np.concatenate([np.arange(SLICE[name].start, SLICE[name].stop) for name in NAMES])

    def rates(t, balls):
        y[index] = balls
        return model.rhs(t, y)[index]

    rng = np.random.default_rng(1)
    start = y[index].reshape(9, Z)
    start[3:5] = rng.uniform(-3, 3, (2, Z))
    start[5] = rng.uniform(-800, 800, Z)
    start[6:] = rng.uniform(-4000, 4000, (3, Z))
    return rates, start


def in_space(state):
    """Place, velocity and angular velocity of the balls in the global frame, (Z, 3) each."""
    x, r, theta, v_x, v_r, omega_m, *omega = state.reshape(9, Z)
    to_global = lambda v: np.einsum("jik,ji->jk", frames(theta), np.stack(v, -1))
    return to_global([x, r, 0 * r]), to_global([v_x, v_r, r * omega_m]), to_global(omega)


def test_free_flight(core):
    """1 ms: half a turn or less of the frame; integrated to 1e-11, observed 2e-11."""
    gravity = np.array([0.0, -900.0, 400.0])
    rates, start = free_balls(core, **{"gravity.y": gravity[1], "gravity.z": gravity[2]})
    t = 1e-3
    end = solve_ivp(rates, (0.0, t), start.ravel(), rtol=1e-11, atol=1e-14, method="DOP853").y[:, -1]
    place, velocity, omega = in_space(start)
    place_end, velocity_end, omega_end = in_space(end)
    assert velocity_end == pytest.approx(velocity + gravity * t, abs=1e-8)
    assert place_end == pytest.approx(place + velocity * t + 0.5 * gravity * t * t, abs=1e-11)
    assert omega_end == pytest.approx(omega, abs=1e-6)


def test_forces_and_moments_accelerate(core):
    """m a = F and J dOmega/dt = M in space, with the race contacts' forces; the sphere's mass and inertia from its
    diameter.
    """
    model = core.model()
    y = model.start()
    rng = np.random.default_rng(2)
    for name, scale in zip(NAMES, (5e-6, 3e-6, 1e-3, 0.1, 0.1, 3.0, 30.0, 30.0, 30.0), strict=True):
        y[SLICE[name]] += scale * rng.uniform(-1, 1, Z)
    rate, h = model.rhs(0.0, y), 1e-9
    index = np.concatenate([np.arange(SLICE[name].start, SLICE[name].stop) for name in NAMES])
    later, before = in_space((y + h * rate)[index]), in_space((y - h * rate)[index])
    m = RHO * np.pi / 6.0 * D**3
    w = model.work
    axes = frames(y[SLICE["ball_theta"]])
    F = np.einsum("jik,ji->jk", axes, np.stack([list(w.F_x)[:Z], list(w.F_r)[:Z], list(w.F_t)[:Z]], -1))
    M = np.einsum("jik,ji->jk", axes, np.stack([list(w.M_x)[:Z], list(w.M_r)[:Z], list(w.M_t)[:Z]], -1))
    assert m * (later[1] - before[1]) / (2 * h) == pytest.approx(F, abs=1e-6 * np.abs(F).max())
    assert 0.1 * m * D**2 * (later[2] - before[2]) / (2 * h) == pytest.approx(M, abs=1e-6 * np.abs(M).max())
    assert np.abs(M).max() > 1e-3
