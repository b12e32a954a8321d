"""The inputs over a communication step, and the load and motion that they impose on the ring at one time.

    inputs: u(t) = u_0 + u_0' (t - t_0) + u_0'' (t - t_0)^2/2 from the communication point t_0 on
    motions: position and velocity are one polynomial of third order, u(t) = u_0 + ... + v_0'' (t - t_0)^3/6  (motion_trajectory)
    pulses: F_r sin(pi (t - t_n)/duration) along the radial load (+Y without one) and F_a along +X, t_n = t_start + n
    interval

Forces and moments are in the bearing's frame.  Tilt is a rotation about (0, tilt_y, tilt_z): a = (cos, tilt_z sinc,
-tilt_y sinc).  The frame's angle is the integral of frame.omega; gravity keeps its direction in the fixed frame.
"""

import copy
from dataclasses import dataclass, replace
from types import SimpleNamespace

import numpy as np

from bearing_model.generated.variables import INPUTS, RingMotion
from bearing_model.physics.parameters import InputDerivatives, require
from bearing_model.physics.race_surface import race_surfaces_given

# Inputs that are a position and its velocity: group, position, velocity; the shaft's come first.
MOTION = tuple(
    (side, q, v)
    for side in ("shaft", "housing")
    for q, v in [(i, f"v_{i}") for i in "xyz"] + [(f"tilt_{i}", f"tilt_{i}_dot") for i in "yz"]
)
MOTION += (("frame", "omega", "omega_dot"),)
SHORTEST_MOTION = 1e-12  # step whose rates of motion are known [s]

# A motion that misses the given one by much is led back to it within a time of its own, however short the step is: no
# shaft and no housing follows within less than the period of 10 kHz, and with 20 m/s, twice the largest velocity
# allowed, to make up in that time, the acceleration is 8e5 m/s2.
CATCH_UP_TIME = 1e-4  # at least [s]
CATCH_UP_ACCELERATION = 1e6  # at most [m/s2]


def check_frame(p, u):
    """ValueError if the frame's arm accelerates the bearing's centre more than frame.a_* may be."""
    R, most = p.frame.radius, INPUTS["frame.a_y"].max
    rates = (("omega", "rad/s", u.frame.omega**2 * R), ("omega_dot", "rad/s2", abs(u.frame.omega_dot) * R))
    for name, unit, a in rates:
        given = f"frame.{name} = {getattr(u.frame, name):g} {unit}, frame.radius = {R:g} m"
        allowed = f"at most {most:g} m/s2 is allowed, as of frame.a_y"
        require(a <= most, f"{given}: the bearing's centre is accelerated by {a:g} m/s2; {allowed}")


@dataclass(frozen=True)
class InputTrajectory:
    """The inputs over a communication step: polynomials of time, and the half-sine in progress."""

    t_0: float  # communication point [s]
    u: tuple  # the inputs there (Inputs) and their derivatives (InputDerivatives)
    pulse_r: float  # amplitude of the half-sine in progress, radial and axial [N]; 0 between pulses
    pulse_a: float
    pulse_start: float  # its start [s]
    pulse_rate: float  # pi / duration [1/s]
    gravity: tuple = (0.0, 0.0)  # parameters gravity.y, gravity.z [m/s2]
    radius: float = 0.0  # parameter frame.radius [m]
    frame_angle: float = 0.0  # by which the frame has turned since the start, at t_0 [rad]
    angles: tuple = (0.0, 0.0)  # by which inner and outer ring have turned since the start, at t_0 [rad]
    angles_matter: bool = False  # whether a race is not perfect: else the rings' angles stay 0


@dataclass(frozen=True)
class RingLoad:
    """Loads and motions that the inputs impose on the bearing at one time."""

    F: tuple  # load [N]
    M: tuple  # moment about Y, Z [N.m]
    omega: float  # speed [rad/s]
    beta: float  # direction cosines of the shaft's tilt
    gamma: float
    omega_dot: float = 0.0  # rate of the speed [rad/s2]
    # motion of the inner ring where it is prescribed: position, velocity, acceleration; rates of the cosines
    x: tuple = (0.0, 0.0, 0.0)
    v: tuple = (0.0, 0.0, 0.0)
    a: tuple = (0.0, 0.0, 0.0)
    beta_dot: float = 0.0
    gamma_dot: float = 0.0
    beta_ddot: float = 0.0
    gamma_ddot: float = 0.0
    # motion of the outer ring: position, velocity, direction cosines and their rates, speed [rad/s]
    outer_x: tuple = (0.0, 0.0, 0.0)
    outer_v: tuple = (0.0, 0.0, 0.0)
    outer_beta: float = 0.0
    outer_gamma: float = 0.0
    outer_beta_dot: float = 0.0
    outer_gamma_dot: float = 0.0
    outer_omega: float = 0.0
    outer_a: tuple = (0.0, 0.0, 0.0)  # and its acceleration
    field: tuple = (0.0, 0.0, 0.0)  # gravity less the acceleration of the bearing's centre [m/s2]
    frame_omega: float = 0.0  # speed of the frame [rad/s] and its rate
    frame_omega_dot: float = 0.0
    inner_angle: float = 0.0  # by which the rings have turned since the start [rad]; 0 of perfect races
    outer_angle: float = 0.0


def ring_cosines(tilt_y, tilt_z, tilt_y_dot, tilt_z_dot):
    """Direction cosines beta, gamma of a rotation about (0, tilt_y, tilt_z) [rad], and their rates."""
    angle_2 = tilt_y**2 + tilt_z**2
    sinc = np.sinc(np.sqrt(angle_2) / np.pi)
    # (cos - sinc)/angle^2 as a series: 3e-13 at 0.05 rad
    factor = -1.0 / 3.0 + angle_2 * (1.0 / 30.0 - angle_2 * (1.0 / 840.0 - angle_2 / 45360.0))
    change = factor * (tilt_y * tilt_y_dot + tilt_z * tilt_z_dot)
    return tilt_y * sinc, tilt_z * sinc, tilt_y_dot * sinc + tilt_y * change, tilt_z_dot * sinc + tilt_z * change


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
    n = int((t - p.pulse.t_start) // p.pulse.interval)  # the division may round up or down
    candidates = (i for i in (n - 1, n, n + 1, p.pulse.count - 1) if 0 <= i < p.pulse.count)
    return max((i for i in candidates if pulse_start(p, i) <= t), default=-1)


def has_pulses(p):
    return (p.pulse.F_r != 0.0 or p.pulse.F_a != 0.0) and p.ring.motion == RingMotion.FREE


def pulse_next_edge(p, t):
    """Next start or end of a pulse after t [s], infinity after the last one."""
    if not has_pulses(p):
        return np.inf
    i = pulse_index(p, t)
    edges = [pulse_start(p, i) + p.pulse.duration] if i >= 0 else []
    edges += [pulse_start(p, i + 1)] if i + 1 < p.pulse.count else []
    return min((edge for edge in edges if edge > t), default=np.inf)


@dataclass(frozen=True)
class MotionHistory:
    """Motions that were given so far: velocities at the begin of the last communication step, their mean rates over the step
    before, the length of the last step.
    """

    v: tuple
    a: tuple | None  # None: there was one step only
    h: float

    def rate(self, given):
        """Mean rates of the velocities over the last step."""
        return tuple((new - old) / self.h for new, old in zip(velocities(given), self.v, strict=True))


def velocities(given):
    return tuple(getattr(getattr(given, group), v) for group, _, v in MOTION)


def motion_remember(given, h, history=None):
    """The history with the motions that were given at the begin of a step of length h [s]."""
    return MotionHistory(velocities(given), history and history.rate(given), max(h, SHORTEST_MOTION))


def minmod(x, y):
    return 0.0 if x * y <= 0.0 else min(x, y, key=abs)


def catch_up_limit(p, group, q):
    """Largest acceleration of a motion while it catches up."""
    r = 0.5 * p.bearing.d_m
    if group == "frame":
        return CATCH_UP_ACCELERATION / (CATCH_UP_TIME * (r + p.frame.radius))
    return CATCH_UP_ACCELERATION if q in "xyz" else CATCH_UP_ACCELERATION / r


def catch_up_time(d_x, d_v, h, limit):
    """Time within which position and velocity, behind by d_x and d_v, catch up [s]: that of the step unless this needs
    more than the acceleration `limit`.
    """
    x, v = abs(d_x), abs(d_v)
    if 6.0 * x / h**2 + 4.0 * v / h <= limit:
        return h
    return max(CATCH_UP_TIME, (2.0 * v + np.sqrt(4.0 * v**2 + 6.0 * limit * x)) / limit)


def motion_trajectory(p, given, now, h, history=None):
    """Values and derivatives of the inputs over a step of length h [s] from those that the host has given at its begin.

    position and velocity at the end    X = x + v h + a h^2/2 + a' h^3/6,  V = v + a h + a' h^2/2, with the given derivatives a, a' of the velocity, or if
                                        they are 0 with a = minmod of the velocity's mean rates over the last two steps:
                                        V has an error of order two, and a velocity that jumps is not extrapolated
    inside the step                     Hermite's polynomial from where the motion is (`now`, at the end of the last step) to X, V
    catching up                         where making up the mismatch x - x_now = d, v - v_now = d' within h would need
                                        more than A = CATCH_UP_ACCELERATION, 6 |d|/h^2 + 4 |d'|/h > A, the given
                                        polynomial plus Hermite's polynomial from -d, -d' to 0 within
                                        T = max(CATCH_UP_TIME, (2 |d'| + (4 d'^2 + 6 A |d|)^(1/2))/A) > h

    A is for lengths.  Angles have A/(d_m/2); the frame's speed, whose rate makes the forces, has A/CATCH_UP_TIME over the
    frame's radius and d_m/2.  Rates estimated from the velocities are within the same limits.

    In steps shorter than SHORTEST_MOTION the motion goes on with the velocity that it has, because the rates above
    could overflow.  Where the motion is not given (the shaft's in free motion) it has no derivatives; where it is,
    there are no loads.
    """
    u = [copy.deepcopy(values) for values in given]
    if p.ring.motion == RingMotion.PRESCRIBED:
        for values in u:
            vars(values.shaft).update(F_x=0.0, F_y=0.0, F_z=0.0, M_y=0.0, M_z=0.0)
            vars(values.impact).update(F_r=0.0, F_a=0.0)
    known = history is not None and history.a is not None
    estimates = (
        [minmod(*rates) for rates in zip(history.rate(given[0]), history.a, strict=True)]
        if known
        else [0.0] * len(MOTION)
    )
    for (group, q, v), estimate in zip(MOTION, estimates, strict=True):
        out = [vars(getattr(values, group)) for values in u]
        if group == "shaft" and p.ring.motion == RingMotion.FREE:
            out[1][v] = out[2][v] = 0.0
            continue
        at = vars(getattr(now, group))
        x_0, v_0, (v_1, a, jerk) = at[q], at[v], (values[v] for values in out)
        given_x, out[0][q], out[0][v], out[1][q] = out[0][q], x_0, v_0, v_0
        out[1][v] = out[2][q] = out[2][v] = 0.0
        if h < SHORTEST_MOTION:
            continue
        limit = catch_up_limit(p, group, q)
        a = max(-limit, min(limit, estimate)) if a == 0.0 and jerk == 0.0 else a

        # a motion that is far behind the given one catches up over more than this step
        d_x, d_v = given_x - x_0, v_1 - v_0
        T = catch_up_time(d_x, d_v, h, limit)
        if h < T:
            out[1][v] = out[2][q] = a + (6.0 * d_x / T + 4.0 * d_v) / T
            out[2][v] = jerk - (12.0 * d_x / T + 6.0 * d_v) / T**2
            continue
        x_1, v_1 = given_x + h * (v_1 + 0.5 * h * (a + h / 3.0 * jerk)), v_1 + h * (a + 0.5 * h * jerk)
        mean = (x_1 - x_0) / h
        out[1][v] = out[2][q] = (6.0 * mean - 4.0 * v_0 - 2.0 * v_1) / h
        out[2][v] = (6.0 * (v_0 + v_1) - 12.0 * mean) / h**2
    return u


def input_trajectory_update(p, u, t_0, t, frame_angle=0.0, angles=(0.0, 0.0)):
    """The trajectory of the inputs u (value and derivatives at t_0 [s]) from time t up to the next edge of a pulse;
    frame_angle, angles: those of the frame, of inner and outer ring at t_0.
    """
    i = pulse_index(p, t)
    active = has_pulses(p) and i >= 0 and t < pulse_start(p, i) + p.pulse.duration
    pulse = (p.pulse.F_r, p.pulse.F_a, pulse_start(p, i)) if active else (0.0, 0.0, 0.0)
    gravity, matter = (p.gravity.y, p.gravity.z), race_surfaces_given(p)
    return InputTrajectory(
        t_0, tuple(u), *pulse, np.pi / p.pulse.duration, gravity, p.frame.radius, frame_angle, angles, matter
    )


def input_trajectory_varies(trajectory):
    """Whether load or motion changes along the trajectory."""
    derivatives = [value for u in trajectory.u[1:] for group in vars(u).values() for value in vars(group).values()]
    gravity_turns = any(trajectory.gravity) and trajectory.u[0].frame.omega != 0.0
    speeds = trajectory.u[0].shaft.omega, trajectory.u[0].housing.omega
    races_turn = trajectory.angles_matter and any(speeds)
    pulse = trajectory.pulse_r != 0.0 or trajectory.pulse_a != 0.0
    return pulse or gravity_turns or races_turn or any(derivatives)


def input_trajectory_at(trajectory, t):
    """The inputs at time t [s]: Taylor's polynomial."""
    tau, u = t - trajectory.t_0, SimpleNamespace()
    for group in vars(trajectory.u[0]):
        u_0, u_1, u_2 = (vars(getattr(u, group)) for u in trajectory.u)
        setattr(
            u, group, SimpleNamespace(**{name: u_0[name] + tau * (u_1[name] + 0.5 * tau * u_2[name]) for name in u_0})
        )
    for group, q, v in MOTION:
        vars(getattr(u, group))[q] += tau**3 / 6.0 * getattr(getattr(trajectory.u[2], group), v)
    return u


def input_trajectory_here(trajectory, t):
    """The trajectory that begins at time t [s] with the inputs' values and rates there: inputs that are held, with
    their rates as outputs show them.
    """
    rates, tau = copy.deepcopy(trajectory.u[1]), t - trajectory.t_0
    for group, members in vars(rates).items():
        for name in vars(members):
            vars(members)[name] += tau * getattr(getattr(trajectory.u[2], group), name)
    return replace(
        trajectory,
        t_0=t,
        u=(input_trajectory_at(trajectory, t), rates, InputDerivatives()),
        frame_angle=frame_angle_at(trajectory, t),
        angles=ring_angles_at(trajectory, t),
    )


def frame_angle_at(trajectory, t):
    """Angle of the frame at time t [rad]."""
    tau, (w, w_1, w_2) = t - trajectory.t_0, (u.frame.omega for u in trajectory.u)
    return trajectory.frame_angle + tau * (
        w + tau * (w_1 / 2.0 + tau * (w_2 / 6.0 + tau * trajectory.u[2].frame.omega_dot / 24.0))
    )


def ring_angles_at(trajectory, t):
    """Angles of the inner and the outer ring at time t [rad]; 0 of perfect races."""
    if not trajectory.angles_matter:
        return 0.0, 0.0
    tau = t - trajectory.t_0

    def turned(angle, w, w_1, w_2):
        return angle + tau * (w + tau * (w_1 / 2.0 + tau * w_2 / 6.0))

    inner, outer = trajectory.angles
    return (
        turned(inner, *(u.shaft.omega for u in trajectory.u)),
        turned(outer, *(u.housing.omega for u in trajectory.u)),
    )


def frame_field(trajectory, t, u):
    """Gravity in the turned frame less the acceleration of the bearing's centre [m/s2]."""
    angle, (g_y, g_z), w = frame_angle_at(trajectory, t), trajectory.gravity, u.frame.omega
    c, s = np.cos(angle), np.sin(angle)
    down = (c * g_y + s * g_z, c * g_z - s * g_y)
    return (
        -u.frame.a_x,
        down[0] - u.frame.a_y + w * w * trajectory.radius,
        down[1] - u.frame.a_z - u.frame.omega_dot * trajectory.radius,
    )


def ring_load_at(trajectory, t):
    """The RingLoad at time t [s]; arrays of times give arrays, complex ones carry derivatives."""
    u = input_trajectory_at(trajectory, t)
    sine = np.sin((t - trajectory.pulse_start) * trajectory.pulse_rate)
    F_r, F_a = u.impact.F_r + trajectory.pulse_r * sine, u.impact.F_a + trajectory.pulse_a * sine
    radial = np.sqrt(u.shaft.F_y**2 + u.shaft.F_z**2)
    loaded, length = np.real(radial) > 0.0, np.where(radial == 0.0, 1.0, radial)
    y, z = np.where(loaded, u.shaft.F_y / length, 1.0), np.where(loaded, u.shaft.F_z / length, 0.0)
    F = (u.shaft.F_x + F_a, u.shaft.F_y + F_r * y, u.shaft.F_z + F_r * z)
    M = u.shaft.M_y, u.shaft.M_z
    outer = ring_cosines(u.housing.tilt_y, u.housing.tilt_z, u.housing.tilt_y_dot, u.housing.tilt_z_dot)
    beta, gamma, beta_dot, gamma_dot = ring_cosines(
        u.shaft.tilt_y, u.shaft.tilt_z, u.shaft.tilt_y_dot, u.shaft.tilt_z_dot
    )

    def rate(name, group="shaft"):
        first, second = (getattr(getattr(u, group), name) for u in trajectory.u[1:])
        return first + (t - trajectory.t_0) * second

    def along_axes(group, name):
        return tuple(getattr(group, name + i) for i in "xyz")

    inner_angle, outer_angle = ring_angles_at(trajectory, t)
    return RingLoad(
        F,
        M,
        u.shaft.omega,
        beta,
        gamma,
        rate("omega"),
        x=along_axes(u.shaft, ""),
        v=along_axes(u.shaft, "v_"),
        a=tuple(rate(f"v_{i}") for i in "xyz"),
        beta_dot=beta_dot,
        gamma_dot=gamma_dot,
        beta_ddot=rate("tilt_y_dot"),
        gamma_ddot=rate("tilt_z_dot"),
        outer_x=along_axes(u.housing, ""),
        outer_v=along_axes(u.housing, "v_"),
        outer_beta=outer[0],
        outer_gamma=outer[1],
        outer_beta_dot=outer[2],
        outer_gamma_dot=outer[3],
        outer_omega=u.housing.omega,
        outer_a=tuple(rate(f"v_{i}", "housing") for i in "xyz"),
        field=frame_field(trajectory, t, u),
        frame_omega=u.frame.omega,
        frame_omega_dot=u.frame.omega_dot,
        inner_angle=inner_angle,
        outer_angle=outer_angle,
    )


def ring_load_update(p, u, t):
    """The RingLoad at time t [s], inputs u held."""
    return ring_load_at(input_trajectory_update(p, (u, InputDerivatives(), InputDerivatives()), t, t), t)
