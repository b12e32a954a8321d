"""The default step: verlet.c, implicit.c and the control of integrator.c against their dense twin bearing_model/verlet.py, and both against what numerical
analysis expects of them.  Differences are in units of the error scales (10 um, 0.1 m/s ..., derived.py): what a tolerance of 1 allows.
"""

from types import SimpleNamespace

import numpy as np
import pytest
from mechanics import Instance
from test_jacobian import KINDS, SCENES, make_model, make_state

from bearing_model import verlet
from bearing_model.model import Model, Work
from bearing_model.rhs import jacobian, rhs
from bearing_model.variables import N_STATES, RING_V_X, WORK, CageModel, Lubrication, TiltMode, Traction
from bearing_model.verlet import FRICTION, N_V, POSITIONS, RING, V, VerletState

TWIN = SimpleNamespace(model=Model.of)  # what make_model builds models with
POINT_FILM = (CageModel.TWO_HALF, Traction.POINT, Lubrication.FILM, TiltMode.SUPPORTED)


# --------------------------------------------------------------------------------------------------------------- one step, twice


def started(core, c, y):
    """VerletState of the C core at y, without a history."""
    state = core.new("VerletState")
    state.y, state.f = list(y), list(c.rhs(0.0, y))
    return state


def copied(state):
    """The same as the twin's."""
    film = [[[yy, yz], [yz, zz]] for yy, yz, zz in state.film]
    return VerletState(np.array(list(state.y)), np.array(list(state.f)), np.array(list(state.jerk)), np.array(film), state.h)


def differences(c, end, h, scale):
    """Largest difference of each kind of result between the C core's VerletState and the twin's."""
    units, found = {"y": scale, "f": scale / h, "jerk": scale / h**2}, {}
    for name, unit in units.items():
        difference = np.abs(np.array(list(getattr(c, name))) - getattr(end, name)) / unit
        for part, rows in (("positions", POSITIONS), ("friction states", FRICTION), ("velocities", V)):
            if name == "y" or rows != POSITIONS:
                found[f"{part}: {name}"] = np.max(difference[rows])
    for name in ("y", "f"):
        value = getattr(end, name)[WORK][0]
        found[f"work: {name}"] = abs(getattr(c, name)[WORK.start] - value) / max(abs(value), 1.0)
    found["film"] = np.max(np.abs(copied(c).film - end.film)) / np.max(np.abs(end.film))
    return found


@pytest.mark.parametrize("scene", SCENES, ids=lambda scene: "-".join(part.name for part in scene))
def test_step(core, scene, record_property):
    """Two steps in a row from states of every kind (9 in each of 24 modes, 216 in all), the second with a history and another length.

    Tolerance: rounding.  Forces are known to 1e-12 ... 1e-11 of the largest term in their sums (test_twin.py).
    """
    rng, worst, seen = np.random.default_rng(31), {}, set()

    def watched(model, t, y, w, gamma):
        b = verlet.jacobian_blocks(model, t, y, w, gamma)
        stiff = np.diag(b.A_stiff)[verlet.BALL[0]] > 0.0
        seen.update({"stiff balls"} if np.any(stiff) else (), {"slow balls"} if np.any(~stiff) else ())
        seen.add("ring coupled" if np.any(b.A[verlet.BALL[0], RING[0]]) else "ring alone")
        return b

    for i, kind in enumerate(KINDS):
        c, model = make_model(core, kind, scene), make_model(TWIN, kind, scene)
        state = started(core, c, make_state(c, kind, rng))
        for h in 10.0 ** rng.uniform(-6.3, -5.0, 2) * (10.0 if kind == "slow" else 1.0):
            start = copied(state)
            weight = np.where(np.arange(N_STATES) < WORK.start, i % 2, 1 - i % 2) / model.d.scale  # the error of friction states or that of velocities
            state, error = c.verlet(0.0, h, state, weight)
            end, error_twin = verlet.verlet_step(model, 0.0, h, weight, start, watched)
            found = differences(state, end, h, model.d.scale) | {"error": abs(error - error_twin) / max(error_twin, 1e-3)}
            worst = {name: max(worst.get(name, 0.0), value) for name, value in found.items()}
            seen.update({"limited"} if np.any(verlet.predictor_limiter(model, h, start)) else ())
    record_property("worst", {name: float(value) for name, value in worst.items()})
    print({name: f"{value:.1e}" for name, value in worst.items()}, sorted(seen))
    assert max(worst.values()) < 1e-9  # observed 6e-11
    assert seen == {"stiff balls", "slow balls", "ring coupled", "ring alone", "limited"}


def evaluated(core, kind, scene, **changes):
    """Both twins at one state, and the twin's evaluation there."""
    c, model, w = make_model(core, kind, scene, **changes), make_model(TWIN, kind, scene, **changes), Work()
    y = make_state(c, kind, np.random.default_rng(32))
    c.rhs(0.0, y)
    rhs(model, 0.0, y, w)
    return c, model, y, w


def solved(c, model, y, w, gamma):
    """Random velocities taken through both linear solves by the C core and by the twin: [2, N_V] each."""
    b, v = verlet.jacobian_blocks(model, 0.0, y, w, gamma), np.zeros(N_STATES)
    v[V] = np.random.default_rng(33).standard_normal(N_V)
    by_core = np.array([c.implicit(function, gamma, v)[V] for function in ("implicit_solve", "implicit_held")])
    return by_core, np.array([np.linalg.solve(b.matrix(gamma), v[V]), v[V] - np.linalg.solve(b.matrix_stiff(gamma), v[V])])


def test_stiff_limit(core):
    """A ball's accelerations are damped from gamma A = 2 on, A the mean rate along its contacts' two tangents: half a percent less, and they are not."""
    c, model, y, w = evaluated(core, "pockets closed", POINT_FILM)
    g, D = w.g_i + w.g_e, np.sum(w.D, axis=0) + np.sum(w.D_omega, axis=0)
    rate = g / model.d.m + g * model.d.R**2 / model.d.J + D / 2.0
    j = np.argmax(D)  # a ball in touch with its pocket
    assert D[j] / 2.0 > 0.05 * rate[j]
    for factor in (0.995, 1.005):
        by_core, by_twin = solved(c, model, y, w, factor * 2.0 / rate[j])
        np.testing.assert_allclose(by_core, by_twin, rtol=0.0, atol=1e-11)
        assert np.any(by_core[1][verlet.BALL[:, j]]) == (factor > 1.0)


@pytest.mark.parametrize("tilt_mode", [TiltMode.PRESCRIBED, TiltMode.SUPPORTED])
def test_coupling_limit(core, tilt_mode):
    """Ring and balls are solved together from gamma A = 0.2 of the ring on: of its translation, or where forces tilt it, of its tilts at the pitch radius."""
    c, model, y, w = evaluated(core, "slow", (*POINT_FILM[:3], tilt_mode))
    ring, r = model.p.ring, model.p.bearing.d_m / 2.0
    rate = np.sum(w.g_i) * max(1.0 / ring.m, r * r / ring.J_t if tilt_mode == TiltMode.SUPPORTED else 0.0)
    assert r * r / ring.J_t > 1.1 / ring.m  # each criterion decides once
    for factor in (0.995, 1.005):
        by_core, by_twin = solved(c, model, y, w, factor * 0.2 / rate)
        np.testing.assert_allclose(by_core, by_twin, rtol=0.0, atol=1e-11)
        coupled = verlet.jacobian_blocks(model, 0.0, y, w, factor * 0.2 / rate).A[np.ix_(verlet.BALL[0], RING)]
        assert np.any(coupled) == (factor > 1.0)


def test_approach_floor(core):
    """The stiffness 3 Q/(2 delta) takes an approach of less than 1e-12 m as 1e-12 m; without approach there is none."""
    c, model, y, w = evaluated(core, "pockets open", POINT_FILM)
    stiffness = []
    for delta in (5e-13, 1e-12, 0.0):
        for name, work in (("Q", 1e-6), ("delta", delta)):
            for race in "ie":
                getattr(c.work, f"{name}_{race}")[0] = work
                getattr(w, f"{name}_{race}")[0] = work
        by_core, by_twin = solved(c, model, y, w, 4e-6)
        np.testing.assert_allclose(by_core, by_twin, rtol=0.0, atol=1e-11)
        stiffness.append(by_core[0][verlet.BALL[:, 0]])
    assert np.max(np.abs(stiffness[0] - stiffness[1])) < 1e-12
    assert np.max(np.abs(stiffness[0] - stiffness[2])) > 1e-4


# ------------------------------------------------------------------------------------------------------------------- order


def exact(model, y, times, steps=16):
    """States [times, N_STATES] at some times after y, side by side, by classical Runge-Kutta steps of a sixteenth."""
    h = np.array(times)[:, None] / steps
    y = np.repeat(y[None], len(h), axis=0)
    for _ in range(steps):
        f_1 = rhs(model, 0.0, y)
        f_2 = rhs(model, 0.0, y + 0.5 * h * f_1)
        f_3 = rhs(model, 0.0, y + 0.5 * h * f_2)
        y = y + h / 6.0 * (f_1 + 2.0 * f_2 + 2.0 * f_3 + rhs(model, 0.0, y + h * f_3))
    return y


def perturbed(model, t, y, w, gamma):
    """A and K wrong by up to 20 % in every entry."""
    rng, b = np.random.default_rng(34), verlet.jacobian_blocks(model, t, y, w, gamma)
    A, K = (matrix * rng.uniform(0.8, 1.2, matrix.shape) for matrix in (b.A, b.K))
    return verlet.Blocks(A, K, b.A_stiff, b.K_stiff)


def explicit(model, t, y, w, gamma):
    """No A and no K: velocity Verlet."""
    b, nothing = verlet.jacobian_blocks(model, t, y, w, gamma), np.zeros((N_V, N_V))
    return verlet.Blocks(nothing, nothing, b.A_stiff, b.K_stiff)


RUNNING = {"working point": {}, "rigid cage, point traction": {"scene.cage": 2, "scene.traction": 1}, "mixed lubrication": {"scene.lubrication": 2}}


def running(core, name):
    """The twin's model and a state on the C core's trajectory, 5 ms after the start: everything moves, no contact is about to open or close."""
    return Model.of(RUNNING[name]), Instance(core, RUNNING[name]).step(5e-3).y


@pytest.mark.parametrize("name", RUNNING)
def test_order(core, name, record_property):
    """Order two in 10 us of 8, 16 and 32 steps, whatever A and K are: a W-method.  The error stays below the sum of the steps' estimates."""
    model, y = running(core, name)
    reference, T, numbers = exact(model, y, [1e-5], steps=40)[0], 1e-5, np.array([8, 16, 32])
    unit = 1.0 / model.d.scale
    unit[WORK] = 0.0
    for blocks in (verlet.jacobian_blocks, verlet.masked_jacobian, perturbed, explicit):
        error, estimate = [], []
        for n in numbers:
            state, estimates = VerletState(y.copy(), rhs(model, 0.0, y)), []
            for k in range(n):
                state, norm = verlet.verlet_step(model, k * T / n, T / n, unit, state, blocks)
                estimates.append(norm)
            error.append(np.sqrt(np.mean(((state.y - reference) * unit) ** 2)))
            estimate.append(sum(estimates[1:]))
        slope = -np.polyfit(np.log(numbers), np.log(error), 1)[0]
        record_property(blocks.__name__, [float(value) for value in (slope, *error)])
        print(f"{name}, {blocks.__name__}: slope {slope:.3f}, errors {error}, estimates {estimate}")
        assert abs(slope - 2.0) < 0.1 
