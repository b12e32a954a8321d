"""Inner ring: filter of the prescribed tilt, support, gyroscopic motion, loads and pulses."""

import numpy as np
import pytest
from mechanics import SLICE, Instance
from scipy.integrate import quad, solve_ivp

from bearing_model.generated.variables import INPUTS, Method, TiltMode
from bearing_model.physics import ring_load as twin_load
from bearing_model.physics.parameters import InputDerivatives, Inputs, Parameters

LOOSE = {"bearing.P_d": 4e-4}  # a ring that rests free of the balls


def ring_model(core, parameters=None, inputs=None):
    """A ring that no ball touches and its states' derivative alone: ten numbers (x, y, z, beta, gamma and rates)."""
    model = core.model(parameters=parameters or {}, inputs={"shaft.F_x": 0.0, "shaft.F_y": 0.0} | (inputs or {}))
    y = model.start()
    model.d.inner.hertz.K = 0.0
    names = [f"ring_{name}" for name in ("x", "y", "z", "beta", "gamma", "v_x", "v_y", "v_z", "beta_dot", "gamma_dot")]
    index = [SLICE[name].start for name in names]

    def rates(t, ring):
        y[index] = ring
        rate = model.rhs(t, y)[index]
        assert max(model.work.Q_i) == 0.0
        return rate

    return model, rates


def run(rates, start, t):
    """The ring's motion from `start` at times t; relative error 1e-10."""
    solution = solve_ivp(rates, (0.0, t[-1]), start, t_eval=t, rtol=1e-10, atol=1e-14, method="DOP853")
    assert solution.success
    return solution.y


# ----------------------------------------------------------------------------------------------------------------- tilt


def test_prescribed_tilt_is_critically_damped(core):
    """Step of the shaft's tilt: theta (1 - (1 + t/tau) exp(-t/tau)), tau = ring.tilt_time."""
    tau, tilt = 1e-4, 5e-3
    _, rates = ring_model(core, inputs={"shaft.tilt_z": tilt, "shaft.tilt_y": -0.5 * tilt})
    t = np.linspace(0.0, 8e-4, 41)
    motion = run(rates, np.zeros(10), t)
    size = np.hypot(tilt, 0.5 * tilt)
    sinc = np.sin(size) / size  # direction cosines of the tilt vector (0, tilt_y, tilt_z)
    response = 1.0 - (1.0 + t / tau) * np.exp(-t / tau)
    assert motion[4] == pytest.approx(tilt * sinc * response, abs=1e-8 * tilt)
    assert motion[3] == pytest.approx(-0.5 * tilt * sinc * response, abs=1e-8 * tilt)


def test_tilt_is_a_rotation_vector(core):
    """Outputs give the shaft's tilts back; both ways for a large tilt against scipy's rotation of the axis."""
    from scipy.spatial.transform import Rotation

    tilt_y, tilt_z = 0.021, -0.033
    model = core.model(inputs={"shaft.tilt_y": tilt_y, "shaft.tilt_z": tilt_z})
    core.lib.ring_load_update(model.p, model.u, 0.0, model.ring_load)
    beta, gamma = model.ring_load.beta, model.ring_load.gamma
    a = Rotation.from_rotvec([0.0, tilt_y, tilt_z]).apply([1.0, 0.0, 0.0])
    assert (gamma, -beta) == pytest.approx((a[1], a[2]), rel=1e-13)
    back = [core.ffi.new("double *") for _ in range(2)]
    core.lib.test_ring_tilts(beta, gamma, *back)
    assert (back[0][0], back[1][0]) == pytest.approx((tilt_y, tilt_z), rel=1e-13)
    assert a[1] < 0.0  # + tilt_z turns +X toward +Y, here it is negative


def test_prescribed_tilt_reaches_the_outputs(core):
    bearing = Instance(core, LOOSE, {"shaft.F_x": 0.0, "shaft.F_y": 0.0, "shaft.omega": 0.0}, tolerance=1e-7)
    bearing.set(**{"shaft.tilt_y": 2e-3, "shaft.tilt_z": -1e-3})
    bearing.step(2e-3)
    # after 20 time constants, within 1e-7 of 0.4 mrad a step
    assert bearing.output("ring.tilt_y") == pytest.approx(2e-3, abs=1e-9)
    assert bearing.output("ring.tilt_z") == pytest.approx(-1e-3, abs=1e-9)


def test_supported_tilt(core):
    """At standstill a damped oscillator in each plane: J_t tilt'' = k (shaft - tilt) - c tilt' + M."""
    k, c, J = 2e4, 1.0, 1.2e-4
    parameters = {"ring.tilt_mode": TiltMode.SUPPORTED, "ring.k_tilt": k, "ring.c_tilt": c}
    _, rates = ring_model(
        core, parameters, {"shaft.omega": 0.0, "shaft.M_y": 1e-3, "shaft.M_z": -2e-3, "shaft.tilt_z": 1e-6}
    )
    t = np.linspace(0.0, 1e-3, 51)
    motion = run(rates, np.zeros(10), t)
    decay, omega = c / (2 * J), np.sqrt(k / J - (c / (2 * J)) ** 2)
    response = 1.0 - np.exp(-decay * t) * (np.cos(omega * t) + decay / omega * np.sin(omega * t))
    assert motion[3] == pytest.approx(1e-3 / k * response, abs=1e-13)  # 2e-6 of the deflection
    assert motion[4] == pytest.approx((1e-6 - 2e-3 / k) * response, abs=2e-13)


def test_gyroscopic_precession(core):
    """A free spinning ring's axis moves on a cone about the angular momentum at |L|/J_t, in the sense of the spin."""
    J_p, J_t, omega = 1.8e-4, 1.2e-4, 1900.0
    _, rates = ring_model(core, {"ring.tilt_mode": TiltMode.FREE}, {"shaft.omega": omega})
    rate = 2.0  # of gamma at the start [1/s]
    nutation = np.hypot(J_p * omega, J_t * rate) / J_t
    t = np.linspace(0.0, 2.0 * np.pi / nutation, 33)
    start = np.zeros(10)
    start[9] = rate
    motion = run(rates, start, t)
    a = np.array([np.sqrt(1.0 - motion[3] ** 2 - motion[4] ** 2), motion[4], -motion[3]])
    L = np.array([J_p * omega, 0.0, 0.0]) + J_t * np.cross([1.0, 0.0, 0.0], [0.0, rate, 0.0])
    n = L / np.linalg.norm(L)
    across, along = np.array([1.0, 0, 0]) - n * n[0], n * n[0]
    cone = along[:, None] + across[:, None] * np.cos(nutation * t) + np.cross(n, across)[:, None] * np.sin(nutation * t)
    assert np.abs(a - cone).max() < 1e-9 * np.linalg.norm(across) + 1e-12
    assert np.linalg.norm(across) > 1e-4


def test_moment_precesses_a_spinning_ring(core):
    """A constant moment about Z on a ring spinning fast about X: mean drift of the axis M/(J_p omega) toward +Z (axis
    follows the moment).
    """
    J_p, J_t, omega, M = 1.8e-4, 1.2e-4, 1900.0, 0.01
    _, rates = ring_model(core, {"ring.tilt_mode": TiltMode.FREE}, {"shaft.omega": omega, "shaft.M_z": M})
    period = 2.0 * np.pi * J_t / (J_p * omega)
    motion = run(rates, np.zeros(10), np.array([0.0, 3.0 * period]))
    # cosines of 4e-4: second order 1e-7
    assert -motion[3, -1] == pytest.approx(M / (J_p * omega) * 3.0 * period, rel=1e-4)
    assert abs(motion[4, -1]) < 1e-3 * abs(motion[3, -1])


def test_translation(core):
    """m x'' = F - c x' + m g: exponential approach of F/c."""
    m, c = 0.6, 1500.0
    _, rates = ring_model(core, {"gravity.y": -9.81}, {"shaft.F_x": 12.0, "shaft.F_z": -20.0})
    t = np.linspace(0.0, 2e-3, 21)
    motion = run(rates, np.zeros(10), t)
    response = (1.0 - np.exp(-c / m * t)) / c
    assert motion[5] == pytest.approx(12.0 * response, rel=1e-8, abs=1e-13)
    assert motion[6] == pytest.approx(-9.81 * m * response, rel=1e-8, abs=1e-13)
    assert motion[7] == pytest.approx(-20.0 * response, rel=1e-8, abs=1e-13)


# --------------------------------------------------------------------------------------------------------------- pulses


RADIAL = (("shaft", "F_y"), ("shaft", "F_z"), ("impact", "F_r"))
PULSES = {
    "pulse.F_r": 1401.0,
    "pulse.F_a": 241.0,
    "pulse.t_start": 0.1,
    "pulse.duration": 1e-3,
    "pulse.interval": 10e-3 / 3,
    "pulse.count": 3,
}


def load(core, parameters, inputs, t):
    """Load on the ring at time t, as a step to t sets it."""
    model = core.model(parameters=parameters, inputs=inputs)
    core.lib.ring_load_update(model.p, model.u, t, model.ring_load)
    return np.array(list(model.ring_load.F))


@pytest.mark.parametrize(("F_y", "F_z"), [(2994.0, 0.0), (-300.0, 400.0), (0.0, 0.0)])
def test_pulses(core, F_y, F_z):
    """Half-sines along the radial load (+Y without one) and +X; each gives the impulse 2 F duration/pi; nothing between
    them.
    """
    inputs = {"shaft.F_x": 515.0, "shaft.F_y": F_y, "shaft.F_z": F_z}
    direction = np.array([F_y, F_z]) / np.hypot(F_y, F_z) if F_y or F_z else np.array([1.0, 0.0])
    static = np.array([515.0, F_y, F_z])
    for n in range(3):
        start = 0.1 + n * 10e-3 / 3
        middle = load(core, PULSES, inputs, start + 0.5e-3) - static
        assert middle == pytest.approx([241.0, *1401.0 * direction], rel=1e-12)
        eighth = load(core, PULSES, inputs, start + 0.25e-3) - static
        assert eighth == pytest.approx(middle * np.sin(np.pi / 4), rel=1e-9)
        impulse = [
            quad(lambda t, i=i: load(core, PULSES, inputs, t)[i] - static[i], start, start + 1e-3)[0] for i in range(3)
        ]
        assert impulse == pytest.approx(2.0 * 1e-3 / np.pi * middle, rel=1e-8)
    for t in (0.0, 0.0999, 0.1 + 1.0001e-3, 0.1 + 9.9e-3, 0.2):
        assert load(core, PULSES, inputs, t) == pytest.approx(static, abs=0.0)


def test_edges(core):
    """Starts are t_start + n interval and ends start + duration, to the bit; none after the last; each later than the
    time asked from.
    """
    p = core.model(parameters=PULSES).p
    starts = [0.1 + n * (10e-3 / 3) for n in range(3)]
    expected = [edge for start in starts for edge in (start, start + 1e-3)]
    t, edges = 0.0, []
    while np.isfinite(t := core.lib.pulse_next_edge(p, t)):
        edges.append(t)
    assert edges == expected
    assert core.lib.pulse_next_edge(core.model().p, 0.0) == np.inf


@pytest.mark.parametrize(("method", "steps"), [(Method.VERLET, 220), (Method.EXPLICIT, 25)])
def test_impulse_through_the_integrator(core, method, steps):
    """Three pulses push a loose undamped ring of 0.6 kg to 3 * 2 F duration/(pi m), whatever the communication step.

    A step may err by 1e-8 of 0.1 m/s (of Verlet's scale of 0.5 m/s a fifth of that) in the mean over 152 states, 1.2e-8
    m/s in one. Verlet's h^3/12 F/m (pi/duration)^2 makes that a step of 1.7 us,
    220 in all, and h^2/6 F/m pi/duration = 5e-7 m/s a pulse; observed 1.3e-6 m/s in three, with Runge-Kutta 2e-8.
    """
    parameters = LOOSE | {
        "solver.method": method,
        "ring.c": 0.0,
        "pulse.F_r": 30.0,
        "pulse.F_a": -20.0,
        "pulse.t_start": 3.7e-5,
        "pulse.duration": 1.3e-4,
    }
    parameters |= {"pulse.interval": 2.1e-4, "pulse.count": 3}
    bearing = Instance(
        core,
        parameters,
        {"shaft.F_x": 0.0, "shaft.F_y": 0.0, "shaft.omega": 0.0},
        tolerance=1e-8 if method == Method.EXPLICIT else 2e-9,
    )
    start = bearing.y[SLICE["ring_v_x"].start :][:3]
    for n in range(1, 8):
        bearing.step(n * 1e-4)
    velocity = bearing.y[SLICE["ring_v_x"].start :][:3] - start
    expected = 3.0 * 2.0 * 1.3e-4 / (np.pi * 0.6) * np.array([-20.0, 30.0, 0.0])
    assert velocity == pytest.approx(expected, abs=1.2e-8 * steps)


def test_impact_inputs(core):
    """impact.F_r adds along the present radial load, impact.F_a along +X."""
    inputs = {"shaft.F_x": 10.0, "shaft.F_y": -30.0, "shaft.F_z": 40.0, "impact.F_r": 5.0, "impact.F_a": -2.0}
    assert load(core, {}, inputs, 0.0) == pytest.approx([8.0, -33.0, 44.0], rel=1e-14)


# ------------------------------------------------------------------------------------------------------- inputs by time


# of inputs by the first part of their names; others 1000
SIZE = {"omega": 1000.0, "tilt": 0.01, "x": 1e-4, "y": 1e-4, "z": 1e-4, "v": 0.1}


def random_trajectory(core, rng):
    """The same polynomials of all inputs in both twins, at a time in the middle of a pulse."""
    names, u = list(INPUTS), core.ffi.new("Inputs[3]")
    size = np.array([SIZE.get(name.split(".")[1].split("_")[0], 1000.0) for name in names])
    values = np.frombuffer(core.ffi.buffer(u)).reshape(3, -1)
    values[...] = rng.uniform(-1.0, 1.0, values.shape) * size * np.array([[1.0], [1e3], [1e6]])
    values[0, [i for i, name in enumerate(names) if INPUTS[name].unit == "K"]] = 300.0  # limits that no load has
    t_0, t = 0.1001, 0.1004
    model, trajectory = core.model(parameters=PULSES), core.new("InputTrajectory")
    core.lib.input_trajectory_update(model.p, u, t_0, t, trajectory)
    orders = [dict(zip(names, row.tolist(), strict=True)) for row in values]
    return (
        model,
        trajectory,
        twin_load.input_trajectory_update(
            Parameters(PULSES), (Inputs(orders[0]), *map(InputDerivatives, orders[1:])), t_0, t
        ),
    )


def test_ring_load_along_the_trajectory(core):
    """Both twins, at random polynomials and times; the load is Taylor's polynomial plus the pulse along the present
    radial load.
    """
    rng = np.random.default_rng(4)
    for _ in range(50):
        _, trajectory, twin = random_trajectory(core, rng)
        ring_load, t = core.new("RingLoad"), rng.uniform(0.1, 0.101)
        core.lib.test_ring_load_at(trajectory, t, ring_load)
        other = twin_load.ring_load_at(twin, t)
        got = np.array([*ring_load.F, *ring_load.M, ring_load.omega, ring_load.beta, ring_load.gamma])
        np.testing.assert_allclose(
            got,
            np.array([*other.F, *other.M, other.omega, other.beta, other.gamma]),
            rtol=1e-12,
            atol=1e-12 * np.abs(got).max(),
        )
        u, tau = trajectory.u, t - 0.1001
        F_y, F_z, F_r = (
            sum(getattr(getattr(u[k], group), name) * tau**k / (1, 1, 2)[k] for k in range(3)) for group, name in RADIAL
        )
        pulse = 1401.0 * np.sin(np.pi * (t - 0.1) / 1e-3)
        assert ring_load.F[1] == pytest.approx(F_y * (1.0 + (F_r + pulse) / np.hypot(F_y, F_z)), rel=1e-9, abs=1e-6)


def test_rhs_takes_the_ring_load_from_the_trajectory(core):
    """At each time the same bits as under inputs held at that time's values; a trajectory that does not vary says so."""
    rng = np.random.default_rng(5)
    model, trajectory, _ = random_trajectory(core, rng)
    y = core.model().start()
    held, moving = (np.empty_like(y) for _ in range(2))
    for t in rng.uniform(0.1, 0.101, 10):
        core.lib.test_ring_load_at(trajectory, t, model.ring_load)
        for out, along in ((held, core.ffi.NULL), (moving, trajectory)):
            model.pointer.trajectory = along
            model.kernel("rhs")(model.pointer, t, core.array(y), core.array(out), model.work)
        assert held.tobytes() == moving.tobytes()
    assert core.lib.input_trajectory_varies(trajectory)
    still = core.model()
    core.lib.input_trajectory_update(still.p, core.ffi.new("Inputs[3]", [still.u[0]]), 0.0, 0.0, trajectory)
    assert not core.lib.input_trajectory_varies(trajectory)
