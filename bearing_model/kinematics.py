"""Speeds of balls and cage, and the frequencies at which a damaged part is felt.

The ball rolls on both races without slip along the rolling direction.  Its spin omega_R, seen from the cage, lies in
the plane through the bearing's axis and the ball's centre and turns backwards; beta is the pitch angle between spin and
axis:  omega_R (-cos beta, sin beta)  in (x, r).  With g = d_m/D

    outer:  omega_R cos(beta - alpha_e) = (omega_m - omega_e) (g + cos alpha_e)
    inner:  omega_R cos(beta - alpha_i) = (omega_i - omega_m) (g - cos alpha_i)

and the race control hypothesis gives beta: no spin at the outer or at the inner race (Jones), or the axis halfway
between both contact normals. Harris & Kotzalas, Essential and Advanced Concepts of Bearing Technology (2006), ch. 10
and 2; Jones, ASME J. Basic Eng. 81 (1959) 1-12.
"""

from dataclasses import dataclass

import numpy as np

CONTROLS = ("none", "outer", "inner")


@dataclass(frozen=True)
class BallMotion:
    """Speeds of a ball rolling without slip [rad/s]; spin_i, spin_e relative to the race about the contact normal; beta
    pitch angle [rad].
    """

    omega_m: float
    omega_R: float
    beta: float
    spin_i: float
    spin_e: float


@dataclass(frozen=True)
class FaultFrequencies:
    """Frequencies [Hz]: FTF cage, BPFO and BPFI balls over a point of the outer and the inner race, BSF spin of the
    ball (it hits a race at 2 BSF).
    """

    FTF: float
    BPFO: float
    BPFI: float
    BSF: float


def check_geometry(D, d_m):
    """Raise ValueError unless 0 < D < d_m (both finite) [m]."""
    if not (np.isfinite(D) and D > 0.0):
        raise ValueError(f"D = {D} m: must be positive")
    if not (np.isfinite(d_m) and d_m > D):
        raise ValueError(f"d_m = {d_m} m: must be larger than the ball diameter D = {D} m")


def pitch_angle(D, d_m, alpha_i, alpha_e, control):
    """Pitch angle beta [rad] of the ball's spin axis under the race control hypothesis "outer", "inner" or "none"
    (halfway).

    Harris & Kotzalas (2006), ch. 2.
    """
    if control == "outer":
        return np.arctan2(np.sin(alpha_e), np.cos(alpha_e) + D / d_m)
    if control == "inner":
        return np.arctan2(np.sin(alpha_i), np.cos(alpha_i) - D / d_m)
    if control == "none":
        return 0.5 * (alpha_i + alpha_e)
    raise ValueError(f"control = {control!r}: must be one of {', '.join(CONTROLS)}")


def ball_motion(omega_i, D, d_m, alpha_i, alpha_e, control="none", omega_e=0.0):
    """Orbital speed, spin and spin relative to the races of a ball between races turning at omega_i and omega_e
    [rad/s].

    D, d_m [m], contact angles alpha_i, alpha_e [rad] (scalars or arrays).  Raises ValueError for D, d_m and control.
    Limit: alpha_i = alpha_e = alpha gives the epicyclic speed of `cage_speed`.
    """
    check_geometry(D, d_m)
    beta = pitch_angle(D, d_m, alpha_i, alpha_e, control)
    outer = (d_m / D + np.cos(alpha_e)) / np.cos(beta - alpha_e)
    inner = (d_m / D - np.cos(alpha_i)) / np.cos(beta - alpha_i)
    omega_m = (inner * omega_i + outer * omega_e) / (inner + outer)
    omega_R = (omega_m - omega_e) * outer
    spin_i = omega_R * np.sin(beta - alpha_i) - (omega_i - omega_m) * np.sin(alpha_i)
    spin_e = omega_R * np.sin(beta - alpha_e) + (omega_m - omega_e) * np.sin(alpha_e)
    return BallMotion(omega_m, omega_R, beta, spin_i, spin_e)


def cage_speed(omega_i, D, d_m, alpha=0.0, omega_e=0.0):
    """Epicyclic speed of the cage [rad/s]: (omega_i (1 - gamma) + omega_e (1 + gamma))/2, gamma = D cos(alpha)/d_m.

    Harris & Kotzalas (2006), ch. 10.  Raises ValueError for D and d_m.

    >>> print(f"{cage_speed(1909.8788938, 0.0111125, 0.0535) / (2 * np.pi):.1f} Hz")
    120.4 Hz
    """
    check_geometry(D, d_m)
    gamma = D * np.cos(alpha) / d_m
    return 0.5 * (omega_i * (1.0 - gamma) + omega_e * (1.0 + gamma))


def ball_spin(omega_i, D, d_m, alpha=0.0, omega_e=0.0):
    """Spin of the ball seen from the cage [rad/s]: d_m/(2 D) (1 - gamma^2) (omega_i - omega_e).  Harris & Kotzalas
    (2006), ch. 10.
    """
    check_geometry(D, d_m)
    gamma = D * np.cos(alpha) / d_m
    return 0.5 * d_m / D * (1.0 - gamma**2) * (omega_i - omega_e)


def fault_frequencies(omega_i, D, d_m, Z, alpha=0.0, omega_e=0.0):
    """Fault frequencies [Hz] of a bearing with Z balls at one contact angle alpha [rad]; speeds [rad/s], D, d_m [m].

    Raises ValueError for D, d_m and Z.

    >>> print(f"{fault_frequencies(1909.8788938, 0.0111125, 0.0535, 9).BPFI:.1f} Hz")
    1652.0 Hz
    """
    if not Z >= 1:
        raise ValueError(f"Z = {Z}: must be at least 1")
    omega_m = cage_speed(omega_i, D, d_m, alpha, omega_e)
    omega_R = ball_spin(omega_i, D, d_m, alpha, omega_e)
    turn = 2.0 * np.pi
    return FaultFrequencies(
        abs(omega_m) / turn, Z * abs(omega_m - omega_e) / turn, Z * abs(omega_i - omega_m) / turn, abs(omega_R) / turn
    )
