"""Inner ring: translation, two tilts, prescribed speed.

    m x'' = F_shaft + F_impact + F_contacts - c x' + m g       (the paper's equation; the load is given on the ring)
    tilt: prescribed  beta'' = (beta_shaft - beta)/tau^2 - 2 beta'/tau, gamma likewise: critically damped
          supported   M = k_tilt (shaft - ring) - c_tilt rates + shaft.M
          free        M = shaft.M only
          both with the gyroscopic moment of the spin (rotor.py)
    inputs: u(t) = u_0 + u_0' (t - t_0) + u_0'' (t - t_0)^2/2 from the communication point t_0 on
    pulses: F_r sin(pi (t - t_n)/duration) along the radial load (+Y without one) and F_a along +X, t_n = t_start + n interval

The vectors of force are in the global frame.  Shaft tilt is a rotation about (0, tilt_y, tilt_z): a = (cos, tilt_z sinc, -tilt_y sinc).
"""

from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np

from bearing_model.parameters import InputDerivatives
from bearing_model.rotor import rotor_acceleration
from bearing_model.variables import (
    RING_BETA,
    RING_BETA_DOT,
    RING_GAMMA,
    RING_GAMMA_DOT,
    RING_V_X,
    RING_V_Y,
    RING_V_Z,
    RING_X,
    RING_Y,
    RING_Z,
    TiltMode,
)


@dataclass(frozen=True)
class Course:
    """The inputs over a communication step: polynomials of time, and the half-sine in progress."""

    t_0: float  # communication point [s]
    u: tuple  # the inputs there (Inputs) and their derivatives (InputDerivatives)
    pulse_r: float  # amplitude of the half-sine in progress, radial and axial [N]; 0 between pulses
    pulse_a: float
    pulse_start: float  # its start [s]
    pulse_rate: float  # pi / duration [1/s]


@dataclass(frozen=True)
class Drive:
    """What the ring sees of them at one time."""

    F: tuple  # load [N]
    M: tuple  # moment about Y, Z [N.m]
    omega: float  # speed [rad/s]
    beta: float  # direction cosines of the shaft's tilt
    gamma: float


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
    """Indices of the pulses that may have started last: the division may round either way."""
    n = int((t - p.pulse.t_start) // p.pulse.interval)
    return [i for i in (n - 1, n, n + 1, p.pulse.count - 1) if 0 <= i < p.pulse.count]


def drive_next_edge(p, t):
    """Next start or end of a pulse after t [s], infinity after the last one."""
    if p.pulse.F_r == 0.0 and p.pulse.F_a == 0.0:
        return np.inf
    i = pulse_index(p, t)
    edges = [pulse_start(p, i) + p.pulse.duration] if i >= 0 else []
    edges += [pulse_start(p, i + 1)] if i + 1 < p.pulse.count else []
    return min((edge for edge in edges if edge > t), default=np.inf)


def course_update(p, u, t_0, t):
    """The course of the inputs u (value and derivatives at t_0 [s]) from time t up to the next edge of a pulse."""
    i = pulse_index(p, t)
    active = i >= 0 and t < pulse_start(p, i) + p.pulse.duration
    pulse = (p.pulse.F_r, p.pulse.F_a, pulse_start(p, i)) if active else (0.0, 0.0, 0.0)
    return Course(t_0, tuple(u), *pulse, np.pi / p.pulse.duration)


def course_varies(course):
    """Whether the drive changes along it."""
    derivatives = [value for u in course.u[1:] for group in vars(u).values() for value in vars(group).values()]
    return course.pulse_r != 0.0 or course.pulse_a != 0.0 or any(derivatives)


def drive_inputs(course, t):
    """The inputs at time t [s]: Taylor's polynomial."""
    tau, u = t - course.t_0, SimpleNamespace()
    for group in vars(course.u[0]):
        u_0, u_1, u_2 = (vars(getattr(u, group)) for u in course.u)
        setattr(u, group, SimpleNamespace(**{name: u_0[name] + tau * (u_1[name] + 0.5 * tau * u_2[name]) for name in u_0}))
    return u


def drive_at(course, t):
    """The Drive at time t [s]; arrays of times give arrays, complex ones carry derivatives."""
    u = drive_inputs(course, t)
    sine = np.sin((t - course.pulse_start) * course.pulse_rate)
    F_r, F_a = u.impact.F_r + course.pulse_r * sine, u.impact.F_a + course.pulse_a * sine
    radial = np.sqrt(u.shaft.F_y**2 + u.shaft.F_z**2)
    loaded, length = np.real(radial) > 0.0, np.where(radial == 0.0, 1.0, radial)
    y, z = np.where(loaded, u.shaft.F_y / length, 1.0), np.where(loaded, u.shaft.F_z / length, 0.0)
    beta, gamma = ring_cosines(u.shaft.tilt_y, u.shaft.tilt_z)
    F = (u.shaft.F_x + F_a, u.shaft.F_y + F_r * y, u.shaft.F_z + F_r * z)
    return Drive(F, (u.shaft.M_y, u.shaft.M_z), u.shaft.omega, beta, gamma)


def drive_update(p, u, t):
    """The Drive at time t [s], inputs u held."""
    return drive_at(course_update(p, (u, InputDerivatives(), InputDerivatives()), t, t), t)


def ring_acceleration(model, w, y_dot):
    p, drive, ring = model.p, model.drive, w.ring
    gravity = (0.0, p.gravity.y, p.gravity.z)
    beta, gamma, beta_dot, gamma_dot = -ring.a[2], ring.a[1], -ring.a_dot[2], ring.a_dot[1]
    for i, (X, V) in enumerate(((RING_X, RING_V_X), (RING_Y, RING_V_Y), (RING_Z, RING_V_Z))):
        y_dot[..., X] = ring.v[i]
        y_dot[..., V] = (drive.F[i] + ring.F[i] - p.ring.c * ring.v[i]) / p.ring.m + gravity[i]
    y_dot[..., RING_BETA] = beta_dot
    y_dot[..., RING_GAMMA] = gamma_dot
    if p.ring.tilt_mode == TiltMode.PRESCRIBED:
        rate = 1.0 / p.ring.tilt_time
        y_dot[..., RING_BETA_DOT] = ((drive.beta - beta) * rate - 2.0 * beta_dot) * rate
        y_dot[..., RING_GAMMA_DOT] = ((drive.gamma - gamma) * rate - 2.0 * gamma_dot) * rate
        return
    M = np.array([ring.M[0], ring.M[1] + drive.M[0], ring.M[2] + drive.M[1]])
    if p.ring.tilt_mode == TiltMode.SUPPORTED:
        M[1] += p.ring.k_tilt * (drive.beta - beta) - p.ring.c_tilt * beta_dot
        M[2] += p.ring.k_tilt * (drive.gamma - gamma) - p.ring.c_tilt * gamma_dot
    a_ddot, _ = rotor_acceleration(ring, p.ring.J_p, p.ring.J_t, M)  # the drive holds the speed
    y_dot[..., RING_BETA_DOT] = -a_ddot[2]
    y_dot[..., RING_GAMMA_DOT] = a_ddot[1]
