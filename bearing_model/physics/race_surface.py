"""A race that is not perfect: waves around it and a spall at the bottom of its groove.

    phi     angle of the ball on its race, from +Y toward +Z at the start; the race turns with its ring
    w(phi)  sum of A_n cos(n phi + phase_n), n = 1...60: height of the race into the bearing's clearance
    f(s)    drop of the ball's path in the spall, s = R_t (phi - phi_0) along the track of radius R_t

A ball that enters a spall turns about the spall's edge, because it has a finite size: Ahmadi, Petersen & Howard (2015),
Mech. Syst. Signal Process. 52-53, 309.  With the distance u = length/2 - |s| to the nearer edge and the reduced radius
R_x of ball and race:

    f = u^2/(2 R_x)                               up to u_1; then the slope u_1/R_x falls to 0 over the length c:
    f = (u^2 - (1 + u_1/c)(u - u_1)^2)/(2 R_x)    up to u_2 = u_1 + c; beyond, f stays u_1 u_2/(2 R_x)

The largest drop is the depth where the ball reaches the bottom, else u_2 = length/2.  c = spall_edge, at most length/4.
c -> 0 is the rigid ball on two sharp edges, with the drop length^2/(8 R_x) in the middle.

Across the track the contact is an elastic foundation of strips, each with a load k (delta - xi^2/(2 R_y))_+ (Johnson
1985, section 4.3): their sum is Hertz' load K delta^1.5 with its pressure (3/4)(1 - x^2), x = xi/a.  The strips over the
spall, |xi| < b = width/2, are lower by f:

    Q = K delta^1.5 (1 - S(b/a)) + K (delta - f)_+^1.5 S(b/a'),   a, a' at delta, delta - f   S(X) = (3 X - X^3)/2, X <= 1
    U = (2/5) K (delta^2.5 (1 - E(b/a)) + (delta - f)_+^2.5 E(b/a'))                          E(X) = (15 X - 10 X^3 + 3 X^5)/8

with delta = |L| - (r_g - R) + w.  A narrow spall thus leaves the ball on its flanks.  The force is minus the gradient of
U: Q n plus a part along the track, as if the normal were tilted.  This part turns the ring, and the ring's rotation does
the work of the moving profile.  Smoothness: C1.  The small roll of a ring whose tilt turns (rotor.py) is left out.
"""

from typing import NamedTuple

import numpy as np

from bearing_model.numbers.lanes import absolute, maximum, minimum
from bearing_model.physics.hertz import hertz_energy, hertz_load


class RaceSurface(NamedTuple):
    """Waves and spall of a race."""

    wave: np.ndarray  # A_n exp(i phase_n) of the orders 1 ... 60 [m]
    spalled: bool  # whether there is a spall
    middle: float  # angle of its middle [rad]
    track: float  # radius of the track [m]
    half_length: float = 0.0  # of the spall [m]
    half_width: float = 0.0
    u_1: float = 0.0  # distances from its edge to the end of the circle, to the largest drop [m]
    u_2: float = 0.0
    c: float = 1.0  # u_2 - u_1 [m]
    R_x: float = 1.0  # reduced radius of ball and race [m]
    flank: float = 0.0  # drop at which the ball rests on the spall's flanks [m]


def race_is_spalled(q):
    """Whether the parameters q of a race, p.inner or p.outer, have a spall."""
    return q.spall_length > 0.0 and q.spall_width > 0.0 and q.spall_depth > 0.0


def race_surfaces_given(p):
    """Whether a race is not perfect."""
    return any(race_is_spalled(q) or bool(np.any(q.waviness != 0.0)) for q in (p.inner, p.outer))


def race_surface_of(q, bottom, hertz):
    """RaceSurface of the parameters q of a race, p.inner or p.outer; bottom: radius of its groove's bottom [m]."""
    wave = q.waviness * np.exp(1j * q.waviness_phase)
    if not race_is_spalled(q):
        return RaceSurface(wave, False, 0.0, bottom)
    c = min(q.spall_edge, 0.25 * q.spall_length)
    # u_1 (u_1 + c) = 2 R_x depth; a short spall ends before
    u_1 = min(0.5 * (np.sqrt(c * c + 8.0 * hertz.R_x * q.spall_depth) - c), 0.5 * q.spall_length - c)
    flank = (0.5 * q.spall_width / hertz.a_delta) ** 2
    half = 0.5 * q.spall_length, 0.5 * q.spall_width
    return RaceSurface(wave, True, q.spall_angle, bottom, *half, u_1, u_1 + c, c, hertz.R_x, flank)


def race_surface_waves(s, cos_phi, sin_phi):
    """Height w of the waves [m] and its derivative by phi [m/rad]."""
    w = dw = 0.0 * cos_phi
    if np.any(s.wave):
        cos_n, sin_n = 1.0, 0.0  # of n phi
        for n, c in enumerate(s.wave, 1):
            cos_n, sin_n = cos_n * cos_phi - sin_n * sin_phi, sin_n * cos_phi + cos_n * sin_phi
            w = w + c.real * cos_n - c.imag * sin_n
            dw = dw - n * (c.real * sin_n + c.imag * cos_n)
    return w, dw


def race_surface_drop(s, cos_phi, sin_phi):
    """Drop f of the ball's path in the spall [m] and its derivative by phi [m/rad].

    >>> from bearing_model.physics.model import Model
    >>> spall = {"outer.spall_length": 2e-3, "outer.spall_width": 4e-3, "outer.spall_depth": 1e-3}
    >>> s = Model.of(spall | {"outer.spall_edge": 1e-6}).d.outer.surface
    >>> f, _ = race_surface_drop(s, np.ones(1), np.zeros(1))
    >>> print(f"{1e6 * f[0]:.2f} um, {1e6 * 2e-3**2 / (8.0 * s.R_x):.2f} um")
    72.50 um, 72.57 um
    """
    c = cos_phi * np.cos(s.middle) + sin_phi * np.sin(s.middle)
    sine = sin_phi * np.cos(s.middle) - cos_phi * np.sin(s.middle)
    along = 2.0 * s.track * np.arctan(sine / maximum(1.0 + c, 1e-9))
    u = minimum(maximum(s.half_length - absolute(along), 0.0), s.u_2)
    over = maximum(u - s.u_1, 0.0)
    f = (u * u - (1.0 + s.u_1 / s.c) * over * over) / (2.0 * s.R_x)
    slope = s.track * (u - (1.0 + s.u_1 / s.c) * over) / s.R_x
    return f, np.where(np.real(along) > 0.0, -slope, slope)


def race_surface_shares(s, hertz, delta):
    """Parts of a perfect contact's load and energy within the spall's width."""
    X = minimum(s.half_width / (hertz.a_delta * np.sqrt(delta) + 1e-12), 1.0)
    return 0.5 * (3.0 * X - X**3), 0.125 * (15.0 * X - 10.0 * X**3 + 3.0 * X**5)


def race_surface_load(s, hertz, delta, f):
    """Load Q of a contact with the approach delta outside the spall and delta - f in it, its part in the spall [N],
    its energy [J] and the approach with which a perfect race has this load [m]; without contact the negative gap.
    """
    K = hertz.K
    if not s.spalled:
        return hertz_load(K, delta), 0.0 * delta, hertz_energy(K, delta), delta
    S, E = race_surface_shares(s, hertz, maximum(delta, 0.0))
    S_spall, E_spall = race_surface_shares(s, hertz, maximum(delta - f, 0.0))
    Q_spall = hertz_load(K, delta - f) * S_spall
    Q = hertz_load(K, delta) * (1.0 - S) + Q_spall
    U = hertz_energy(K, delta) * (1.0 - E) + hertz_energy(K, delta - f) * E_spall
    # the ball rests on the flanks before it reaches the bottom where b^2/a_delta^2 < f
    loaded, gap = np.real(Q) / K > 1e-290, minimum(delta - minimum(f, s.flank), 0.0)
    return Q, Q_spall, U, np.where(loaded, np.where(loaded, Q / K, 1.0) ** (2.0 / 3.0), gap)
