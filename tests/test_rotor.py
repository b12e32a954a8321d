"""Cage halves as free rigid bodies: body axes, torque-free motion, conservation.  Joints, films and drag are taken
away.
"""

import numpy as np
import pytest
from mechanics import SLICE, axis
from scipy.integrate import solve_ivp

from bearing_model.generated import variables

M, J_P, J_T, X_C = (variables.PARAMETERS[f"cage.{name}"].start for name in ("m", "J_p", "J_t", "x_c"))
NAMES = [
    f"cage_{name}"
    for name in ("x", "y", "z", "beta", "gamma", "psi", "v_x", "v_y", "v_z", "beta_dot", "gamma_dot", "s")
]


def free_halves(core, **parameters):
    """Model, y and the derivative of the 24 states of two halves that nothing touches."""
    alone = {
        "oil.eta": 1e-300,
        "oil.rho_mix": 0.0,
        "cage.K_land": 0.0,
        "joint.preload": 0.0,
        "joint.mu": 0.0,
        "joint.zeta": 0.0,
    }
    model = core.model(parameters=alone | parameters)
    model.d.k_rivet = model.d.k_plate = 0.0
    model.d.k_plate_t = model.d.k_head = 1e-9  # friction divides by them
    model.d.k_hole = [0.0] * len(model.d.k_hole)
    y = model.start()
    model.d.pocket.K = 0.0
    index = np.concatenate([np.arange(SLICE[name].start, SLICE[name].stop) for name in NAMES])

    def rates(t, cage):
        y[index] = cage
        return model.rhs(t, y)[index]

    return model, y, index, rates


def spun_up(y, index, rng, tilt=0.3):
    """Both halves tilted by up to `tilt`, spinning and tumbling."""
    state = y[index].reshape(len(NAMES), 2)
    state[3:5] = rng.uniform(-tilt, tilt, (2, 2))
    state[5] = rng.uniform(-3, 3, 2)
    state[6:9] = rng.uniform(-0.3, 0.3, (3, 2))
    state[9:11] = rng.uniform(-200, 200, (2, 2))
    state[11] = [757.0, -400.0]
    return state.ravel()


def angular_velocity(state, h):
    """a, Omega = a x a' + s a of half h."""
    beta, gamma, beta_dot, gamma_dot, s = (state[2 * i + h] for i in (3, 4, 9, 10, 11))
    a = axis(beta, gamma)
    a_dot = np.array([-(beta * beta_dot + gamma * gamma_dot) / a[0], gamma_dot, -beta_dot])
    return a, np.cross(a, a_dot) + s * a


def momentum(state, h):
    """Angular momentum about the centre of mass of half h."""
    a, Omega = angular_velocity(state, h)
    return J_T * Omega + (J_P - J_T) * (Omega @ a) * a


def test_torque_free_top(core):
    """Axis on a cone about the angular momentum at |L|/J_t; L, spin and kinetic energy constant; straight path of the
    centre of mass.

    Integrated to 1e-11 over a turn, tilts up to 0.3 rad; observed 2e-10.
    """
    _model, y, index, rates = free_halves(core)
    start = spun_up(y, index, np.random.default_rng(1))
    t = np.linspace(0.0, 6e-3, 13)
    motion = solve_ivp(rates, (0.0, t[-1]), start, t_eval=t, rtol=1e-11, atol=1e-14, method="DOP853").y
    for h in range(2):
        L = momentum(start, h)
        n, rate = L / np.linalg.norm(L), np.linalg.norm(L) / J_T
        a_0 = angular_velocity(start, h)[0]
        along = n * (n @ a_0)
        across = a_0 - along
        assert np.linalg.norm(across) > 0.03
        for i, time in enumerate(t):
            state = motion[:, i]
            assert momentum(state, h) == pytest.approx(L, abs=1e-8 * np.linalg.norm(L))
            assert state[22 + h] == pytest.approx(start[22 + h], rel=1e-12)
            a = angular_velocity(state, h)[0]
            assert a == pytest.approx(
                along + across * np.cos(rate * time) + np.cross(n, across) * np.sin(rate * time), abs=1e-7
            )
            assert state[h:6:2] == pytest.approx(start[h:6:2] + start[12 + h : 18 : 2] * time, abs=1e-12)


def test_body_axes(core):
    """b_y and b_z are orthonormal to a, right-handed, and turn with Omega: psi' makes up for the turn of the minimal
    rotation.

    Central differences over 1e-8 s: (757e-8)^2/6 and rounding 1e-16/1e-8; observed 3e-8 of Omega.
    """
    model, y, index, rates = free_halves(core)
    rng = np.random.default_rng(2)
    for _ in range(5):
        state = spun_up(y, index, rng)
        rate, h = rates(0.0, state), 1e-8

        def axes(t, state=state, rate=rate):
            rates(0.0, state + t * rate)
            return [np.stack([list(half.a), list(half.b_y), list(half.b_z)]) for half in model.work.half]

        now, later, before = axes(0.0), axes(h), axes(-h)
        for i in range(2):
            assert now[i] @ now[i].T == pytest.approx(np.eye(3), abs=1e-14)
            assert np.linalg.det(now[i]) == pytest.approx(1.0, abs=1e-14)
            Omega = angular_velocity(state, i)[1]
            assert (later[i] - before[i]) / (2 * h) == pytest.approx(
                np.cross(Omega, now[i]), abs=1e-6 * np.linalg.norm(Omega)
            )


def test_geometric_centre_follows_the_body(core):
    """Its place is x_c from the centre of mass along the axis and the unbalance across it, its velocity v + Omega x
    that.
    """
    unbalance = 1e-6  # kg.m
    model, y, index, rates = free_halves(core, **{"cage.unbalance": unbalance})
    state = spun_up(y, index, np.random.default_rng(3))
    rates(0.0, state)
    for h, half in enumerate(model.work.half):
        b_y, Omega = np.array(list(half.b_y)), angular_velocity(state, h)[1]
        lever = (-1.0, 1.0)[h] * X_C * angular_velocity(state, h)[0] + unbalance / (2 * M) * b_y
        assert list(half.x) == pytest.approx(state[h:6:2] - lever, abs=1e-16)
        assert list(half.v) == pytest.approx(state[12 + h : 18 : 2] - np.cross(Omega, lever), abs=1e-12)


def test_euler_equations_under_a_moment(core):
    """dL/dt = M: the land's dry contact pushes the tilted half, its moment about the centre of mass changes the angular
    momentum.
    """
    model, y, index, rates = free_halves(core, **{"cage.K_land": 2e9, "cage.mu_land": 0.3})
    rng = np.random.default_rng(4)
    for _ in range(5):
        state = spun_up(y, index, rng, tilt=0.02)
        state[2:6] += rng.choice([-2e-4, 2e-4], 4)  # beyond the clearance of 0.1 mm
        rate = rates(0.0, state)
        w, h = model.work, 1e-9
        for i, half in enumerate(w.half):
            F, moment = np.array(list(half.F)), np.array(list(half.M))
            assert np.linalg.norm(F) > 1.0
            expected = moment - np.cross(list(half.c), F)
            change = (momentum(state + h * rate, i) - momentum(state - h * rate, i)) / (2 * h)
            assert change == pytest.approx(expected, abs=1e-6 * np.linalg.norm(expected))
            assert rate[12 + i : 18 : 2] == pytest.approx(F / M, rel=1e-12)
