"""The inputs over a communication step, and the load and motion that they impose on the ring at one time.

    inputs: u(t) = u_0 + u_0' (t - t_0) + u_0'' (t - t_0)^2/2 from the communication point t_0 on
    pulses: F_r sin(pi (t - t_n)/duration) along the radial load (+Y without one) and F_a along +X, t_n = t_start + n interval

Forces and moments are in the global frame.  Shaft tilt is a rotation about (0, tilt_y, tilt_z): a = (cos, tilt_z sinc, -tilt_y sinc).
"""

from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np

from bearing_model.parameters import InputDerivatives


@dataclass(frozen=True)
class InputTrajectory:
    """The inputs over a communication step: polynomials of time, and the half-sine in progress."""

    t_0: float  # communication point [s]
    u: tuple  # the inputs there (Inputs) and their derivatives (InputDerivatives)
    pulse_r: float  # amplitude of the half-sine in progress, radial and axial [N]; 0 between pulses
    pulse_a: float
    pulse_start: float  # its start [s]
    pulse_rate: float  # pi / duration [1/s]


@dataclass(frozen=True)
class RingLoad:
    """Load and motion that the inputs impose on the ring at one time."""

    F: tuple  # load [N]
    M: tuple  # moment about Y, Z [N.m]
    omega: float  # speed [rad/s]
    beta: float  # direction cosines of the shaft's tilt
    gamma: float
    omega_dot: float = 0.0  # rate of the speed [rad/s2]


def ring_cosines(tilt_y, tilt_z):
    """Direction cosines beta, gamma of a rotation about (0, tilt_y, tilt_z) [rad]."""
    sinc = np.sinc(np.sqrt(tilt_y**2 + tilt_z**2) / np.pi)
    return tilt_y * sinc, tilt_z * sinc


def ring_tilts(beta, gamma):
    """Angles tilt_y, tilt_z [rad] of the rotation with the direction cosines beta, gamma."""
    sine = np.sqrt(beta**2 + gamma**2)
    factor = np.divide(np.arcsin(sine), sine, out=np.ones_like(sine), where=sine > 1e-8)
    return beta * factor, gamma * factor


def pulse_start(p, n):
    """Start of pulse n [s]."""
    return p.pulse.t_start + n * p.pulse.interval


def pulse_index(p, t):
    """Index of the last pulse that started at or before t, -1 before the first one."""
    started = [n for n in pulse_candidates(p, t) if pulse_start(p, n) <= t]
    return max(started, default=-1)


def pulse_candidates(p, t):
    """Indices of the pulses that may have started last: the division may round up or down."""
    n = int((t - p.pulse.t_start) // p.pulse.interval)
    return [i for i in (n - 1, n, n + 1, p.pulse.count - 1) if 0 <= i < p.pulse.count]


def pulse_next_edge(p, t):
    """Next start or end of a pulse after t [s], infinity after the last one."""
    if p.pulse.F_r == 0.0 and p.pulse.F_a == 0.0:
        return np.inf
    i = pulse_index(p, t)
    edges = [pulse_start(p, i) + p.pulse.duration] if i >= 0 else []
    edges += [pulse_start(p, i + 1)] if i + 1 < p.pulse.count else []
    return min((edge for edge in edges if edge > t), default=np.inf)


def input_trajectory_update(p, u, t_0, t):
    """The trajectory of the inputs u (value and derivatives at t_0 [s]) from time t up to the next edge of a pulse."""
    i = pulse_index(p, t)
    active = i >= 0 and t < pulse_start(p, i) + p.pulse.duration
    pulse = (p.pulse.F_r, p.pulse.F_a, pulse_start(p, i)) if active else (0.0, 0.0, 0.0)
    return InputTrajectory(t_0, tuple(u), *pulse, np.pi / p.pulse.duration)


def input_trajectory_varies(trajectory):
    """Whether load or motion changes along the trajectory."""
    derivatives = [value for u in trajectory.u[1:] for group in vars(u).values() for value in vars(group).values()]
    return trajectory.pulse_r != 0.0 or trajectory.pulse_a != 0.0 or any(derivatives)


def input_trajectory_at(trajectory, t):
    """The inputs at time t [s]: Taylor's polynomial."""
    tau, u = t - trajectory.t_0, SimpleNamespace()
    for group in vars(trajectory.u[0]):
        u_0, u_1, u_2 = (vars(getattr(u, group)) for u in trajectory.u)
        setattr(u, group, SimpleNamespace(**{name: u_0[name] + tau * (u_1[name] + 0.5 * tau * u_2[name]) for name in u_0}))
    return u


def ring_load_at(trajectory, t):
    """The RingLoad at time t [s]; arrays of times give arrays, complex ones carry derivatives."""
    u = input_trajectory_at(trajectory, t)
    sine = np.sin((t - trajectory.pulse_start) * trajectory.pulse_rate)
    F_r, F_a = u.impact.F_r + trajectory.pulse_r * sine, u.impact.F_a + trajectory.pulse_a * sine
    radial = np.sqrt(u.shaft.F_y**2 + u.shaft.F_z**2)
    loaded, length = np.real(radial) > 0.0, np.where(radial == 0.0, 1.0, radial)
    y, z = np.where(loaded, u.shaft.F_y / length, 1.0), np.where(loaded, u.shaft.F_z / length, 0.0)
    beta, gamma = ring_cosines(u.shaft.tilt_y, u.shaft.tilt_z)
    F = (u.shaft.F_x + F_a, u.shaft.F_y + F_r * y, u.shaft.F_z + F_r * z)
    omega_dot = trajectory.u[1].shaft.omega + (t - trajectory.t_0) * trajectory.u[2].shaft.omega
    return RingLoad(F, (u.shaft.M_y, u.shaft.M_z), u.shaft.omega, beta, gamma, omega_dot)


def ring_load_update(p, u, t):
    """The RingLoad at time t [s], inputs u held."""
    return ring_load_at(input_trajectory_update(p, (u, InputDerivatives(), InputDerivatives()), t, t), t)
