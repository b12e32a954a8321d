"""A race that is not perfect: waves around it and a spall at the bottom of its groove.

    phi     angle of the ball on its race, from +Y toward +Z at the start; the race turns with its ring
    w(phi)  sum of A_n cos(n phi + phase_n), n = 1...60: height of the race into the bearing's clearance.  A table of
            512 cells with cubic Hermite polynomials: C1, and with cells of the width h off by (n h)^4/384 A_n, 8e-4 of
            A_60 and 4e-7 of A_9.  The law is that of the polynomials, dw/dphi their derivative.
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

A spall on a ball (ball_spall.py) has the same laws, with s along the ball's great circle.  Where it meets a spall of the
race, both drops add up over the width that both have.
"""

from typing import NamedTuple

import numpy as np

from bearing_model.numbers.lanes import absolute, maximum, minimum
from bearing_model.physics.hertz import hertz_energy, hertz_load

WAVE_CELLS = 512  # of the table of the waves over a turn


class Spall(NamedTuple):
    """A spall at the contacts with one race; of balls arrays [Z]."""

    track: float  # radius of the path [m]
    R_x: float  # reduced radius of ball and race [m]
    half_length: float = 0.0  # [m]
    half_width: float = 0.0
    u_1: float = 0.0  # distances from its edge to the end of the circle, to the largest drop [m]
    u_2: float = 0.0
    c: float = 1.0  # u_2 - u_1 [m]
    flank: float = 0.0  # drop at which the ball rests on the spall's flanks [m]


class RaceSurface(NamedTuple):
    """Waves and spall of a race."""

    wave: np.ndarray | None  # table of the waves, None without
    spalled: bool  # whether there is a spall
    middle: float  # angle of its middle [rad]
    spall: Spall


def spall_given(q):
    """Whether the parameters q, p.inner, p.outer or p.ball, have the sizes of a spall; of balls an array."""
    return (q.spall_length > 0.0) & (q.spall_width > 0.0) & (q.spall_depth > 0.0)


def ball_spalls_given(p):
    """Whether a ball has a spall."""
    return bool(np.any(spall_given(p.ball)))


def race_surfaces_given(p):
    """Whether a race is not perfect, or a ball has a spall."""
    races = any(bool(spall_given(q)) or bool(np.any(q.waviness != 0.0)) for q in (p.inner, p.outer))
    return races or ball_spalls_given(p)


def spall_of(q, track, hertz):
    """Spall of the parameters q at contacts of this Hertz, track: radius of the path [m]."""
    given = spall_given(q)
    length, width, depth = (np.where(given, size, 0.0) for size in (q.spall_length, q.spall_width, q.spall_depth))
    c = np.where(given, minimum(q.spall_edge, 0.25 * length), 1.0)
    # u_1 (u_1 + c) = 2 R_x depth; a short spall ends before
    u_1 = minimum(0.5 * (np.sqrt(c * c + 8.0 * hertz.R_x * depth) - c), 0.5 * length - c)
    u_1, u_2 = np.where(given, u_1, 0.0), np.where(given, u_1 + c, 0.0)
    return Spall(track, hertz.R_x, 0.5 * length, 0.5 * width, u_1, u_2, c, (0.5 * width / hertz.a_delta) ** 2)


def race_surface_of(q, bottom, hertz):
    """RaceSurface of the parameters q of a race, p.inner or p.outer; bottom: radius of its groove's bottom [m]."""
    return RaceSurface(waves_of(q), bool(spall_given(q)), q.spall_angle, spall_of(q, bottom, hertz))


def angle_of(cosine, sine):
    """Angle of the point (cosine, sine), -pi...pi."""
    acute = 2.0 * np.arctan(sine / (1.0 + absolute(cosine)))
    half = np.where(np.real(sine) > 0.0, np.pi, -np.pi)
    return np.where(np.real(cosine) < 0.0, half - acute, acute)


def waves_of(q):
    """Table of the waves of the parameters q, p.inner or p.outer, over a turn that begins at phi = -pi: height and slope
    times width of a cell [m], [513, 2]; None without.
    """
    if not np.any(q.waviness != 0.0):
        return None
    n, width = np.arange(1, len(q.waviness) + 1), 2.0 * np.pi / WAVE_CELLS
    phi = (np.arange(WAVE_CELLS) - WAVE_CELLS // 2) * width
    c = q.waviness * np.exp(1j * (np.multiply.outer(phi, n) + q.waviness_phase))
    table = np.stack([np.sum(c.real, axis=1), -np.sum(n * c.imag, axis=1) * width], axis=1)
    return np.concatenate([table, table[:1]])


def race_surface_waves(s, cos_phi, sin_phi):
    """Height w of the waves [m] and its derivative by phi [m/rad]: cubic Hermite polynomials between the table's points."""
    if s.wave is None:
        return 0.0 * cos_phi, 0.0 * cos_phi
    u = angle_of(cos_phi, sin_phi) * WAVE_CELLS / (2.0 * np.pi) + WAVE_CELLS // 2
    cell = np.clip(np.floor(np.real(u)), 0, WAVE_CELLS - 1).astype(int)
    x, (w_0, s_0), (w_1, s_1) = u - cell, np.moveaxis(s.wave[cell], -1, 0), np.moveaxis(s.wave[cell + 1], -1, 0)
    rise, bend = w_1 - w_0, s_1 + s_0
    c_2, c_3 = 3.0 * rise - bend - s_0, bend - 2.0 * rise
    slope = s_0 + x * (2.0 * c_2 + 3.0 * x * c_3)
    return w_0 + x * (s_0 + x * (c_2 + x * c_3)), slope * WAVE_CELLS / (2.0 * np.pi)


def spall_drop(s, cosine, sine):
    """Drop f of the ball's path in a spall [m] and its derivative by the angle from the spall's middle [m/rad].

    >>> from bearing_model.physics.model import Model
    >>> spall = {"outer.spall_length": 2e-3, "outer.spall_width": 4e-3, "outer.spall_depth": 1e-3}
    >>> s = Model.of(spall | {"outer.spall_edge": 1e-6}).d.outer.surface.spall
    >>> f, _ = spall_drop(s, np.ones(1), np.zeros(1))
    >>> print(f"{1e6 * f[0]:.2f} um, {1e6 * 2e-3**2 / (8.0 * s.R_x):.2f} um")
    72.50 um, 72.57 um
    """
    along = 2.0 * s.track * np.arctan(sine / maximum(1.0 + cosine, 1e-9))
    u = minimum(maximum(s.half_length - absolute(along), 0.0), s.u_2)
    over = maximum(u - s.u_1, 0.0)
    f = (u * u - (1.0 + s.u_1 / s.c) * over * over) / (2.0 * s.R_x)
    slope = s.track * (u - (1.0 + s.u_1 / s.c) * over) / s.R_x
    return f, np.where(np.real(along) > 0.0, -slope, slope)


def race_surface_drop(s, cos_phi, sin_phi):
    """The same in the spall of a race at the angle phi on it."""
    cosine = cos_phi * np.cos(s.middle) + sin_phi * np.sin(s.middle)
    sine = sin_phi * np.cos(s.middle) - cos_phi * np.sin(s.middle)
    return spall_drop(s.spall, cosine, sine)


def race_surface_shares(half_width, hertz, delta):
    """Parts of a perfect contact's load and energy within half a width."""
    X = minimum(half_width / (hertz.a_delta * np.sqrt(delta) + 1e-12), 1.0)
    return 0.5 * (3.0 * X - X**3), 0.125 * (15.0 * X - 10.0 * X**3 + 3.0 * X**5)


def spall_strips(race, f_race, ball, f_ball):
    """Strips of two widths, the ball's spall over the race's: whether that of the race is the wider one; half widths,
    drops and flanks of the wider one and of the narrower one, whose strips drop by both.
    """
    wider = race.half_width > ball.half_width
    pairs = (race.half_width, ball.half_width), (f_race, f_ball), (race.flank, ball.flank)
    return wider, *((np.where(wider, a, b), np.where(wider, b, a)) for a, b in pairs)


def race_surface_load(hertz, delta, strips):
    """Load Q of a contact with the approach delta outside of spalls, its parts over the spall of the race and over that
    of the ball [N], its energy [J] and the approach with which a perfect race has this load [m]; without contact the
    negative gap.  strips: by spall_strips, None without a spall.
    """
    K = hertz.K
    if strips is None:
        return hertz_load(K, delta), 0.0 * delta, 0.0 * delta, hertz_energy(K, delta), delta
    race_wider, half_width, f, flank = strips
    within, both = delta - f[0], delta - f[0] - f[1]

    def shares(width, approach):
        return np.array(race_surface_shares(width, hertz, maximum(approach, 0.0)))

    S, E = shares(half_width[0], delta)
    S_in, E_in = shares(half_width[0], within) - shares(half_width[1], within)
    S_both, E_both = shares(half_width[1], both)
    Q_narrow = hertz_load(K, both) * S_both
    Q_wide = hertz_load(K, within) * S_in + Q_narrow
    Q = hertz_load(K, delta) * (1.0 - S) + Q_wide
    U = hertz_energy(K, delta) * (1.0 - E) + hertz_energy(K, within) * E_in + hertz_energy(K, both) * E_both
    # the ball rests on the flanks before it reaches the bottom where b^2/a_delta^2 < f
    fall = minimum(f[0] + minimum(f[1], flank[1]), flank[0])
    loaded, gap = np.real(Q) / K > 1e-290, minimum(delta - fall, 0.0)
    equal = np.where(loaded, np.where(loaded, Q / K, 1.0) ** (2.0 / 3.0), gap)
    return Q, np.where(race_wider, Q_wide, Q_narrow), np.where(race_wider, Q_narrow, Q_wide), U, equal
