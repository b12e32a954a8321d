"""Films of oil between balls and both halves within a step: the readable twin of pocket_films.c, which has the equations.

    F = D (u + Y d F_0)/(1 + d Y D),  v += (U/m) d (F - F_0),  V += g d (F - F_0)/inertia,  Y = U.U/m + g.g/inertia

u: speed at which a gap closes; v, V: velocities of the wall's modes and of the half; d: the substep.  At the step's end F is solved for ball,
wall and half, with the same impulse (h/2)(F_n + F_{n+1}) on all.
"""

from dataclasses import dataclass, field

import numpy as np

from bearing_model.cage.common.rigid_approach import rigid_approach
from bearing_model.cage.elastic.elastic_half import ROOT
from bearing_model.generated.variables import (
    BALL_OMEGA_M,
    BALL_R,
    BALL_V_R,
    BALL_V_X,
    CAGE_BETA_DOT,
    CAGE_GAMMA_DOT,
    CAGE_S,
    CAGE_V_X,
    CAGE_V_Y,
    CAGE_V_Z,
    MODE_D_DOT,
    MODE_S_DOT,
    Z,
)
from bearing_model.numbers.vec import vec_dot

HALVES = CAGE_V_X, CAGE_V_Y, CAGE_V_Z, CAGE_BETA_DOT, CAGE_GAMMA_DOT, CAGE_S


def film_before_wall(film, v, axes, shape, near):
    """Films of one half as an evaluation leaves them: damping D [N.s/m], 0 where there is none, speed u at which the gap
    closes [m/s], direction m (x, r, t), motion of the wall along it by each mode.

    v: velocity of the ball against the wall; axes: the pocket's; shape [3, ..., Z, n]: motions of the wall, n = 0 of rigid halves; near: walls
    before which there may be a film.
    """
    m = np.array([vec_dot(film.m, axis) for axis in axes])
    along = sum(part[..., None] * motion for part, motion in zip(m, shape, strict=True))
    return {"D": np.where(near, film.D, 0.0), "u": vec_dot(film.m, v), "m": m, "shape": along}


RIGID = np.zeros((3, Z, 0))  # motions of a rigid wall by no mode


@dataclass
class PocketFilms:
    """Films of both halves at an evaluation: D, u, F [2, Z], m [2, 3, Z], shape [2, Z, n]; the largest D over the mass of its wall at the end
    of a step, over the least mass of any wall where lands guide the cage [1/s]."""

    D: np.ndarray = field(default_factory=lambda: np.zeros((2, Z)))
    u: np.ndarray = field(default_factory=lambda: np.zeros((2, Z)))
    F: np.ndarray = field(default_factory=lambda: np.zeros((2, Z)))
    m: np.ndarray = None
    shape: np.ndarray = None
    rate: float = 0.0


def pocket_films_split(model, w):
    """Takes the films of an evaluation; weak ones have a force alone."""
    if not model.d.squeeze:
        return PocketFilms()
    D, u, m, shape = (np.array([film[name] for film in w.films]) for name in ("D", "u", "m", "shape"))
    F = D * np.maximum(u, 0.0)
    strong = (model.modes.weak_film if model.modes else 0.0) < D
    return PocketFilms(np.where(strong, D, 0.0), np.where(strong, u, 0.0), F, m, shape)


@dataclass
class PocketFilm:
    """One that follows in the substeps."""

    half: int
    ball: int
    D: float
    F_0: float  # force at the step's start
    rate: float
    acceleration: float
    along: np.ndarray  # motion along m by velocities of the half [6]
    shape: np.ndarray
    mobility: float  # of wall and half
    impulse: float = 0.0


def inertia_of(model):
    """Of the velocities of a half [6]."""
    return np.array(3 * [model.p.cage.m] + 2 * [model.d.J_t] + [model.d.J_p])


def mobility_of(model, shape, along):
    """Velocity of a wall by an impulse on it [m/s/(N.s)]."""
    return shape @ shape / model.p.cage.m + np.sum(along**2 / inertia_of(model))


class PocketFilmsStep:
    """The films of a step of length h [s]; arguments as of WallLoads."""

    def __init__(self, model, h, films, f, state, y, w):
        self.m, self.inertia, self.middle, self.films = model.p.cage.m, inertia_of(model), 0.5 * h, []
        for i, k in np.argwhere(films.D > 0.0):
            n = films.m[i][:, k]
            rate, acceleration, along, _ = rigid_approach(model, self.middle, n, f, state, y, w.half[i], i, k)
            shape = films.shape[i][k]
            mobility = mobility_of(model, shape, along)
            self.films.append(
                PocketFilm(i, k, films.D[i, k], films.F[i, k], rate, acceleration, along, shape, mobility)
            )

    def follow(self, t, d, v, halves):
        """Velocities that the films of a substep of length d add at its end, the time t of the step: to modes [2, n] at v, to halves
        [6, 2] at `halves`.
        """
        modes, rows = np.zeros_like(v), np.zeros_like(halves)
        of_half = np.array([v[0] - v[1], v[0] + v[1]]) / ROOT
        for film in self.films:
            i = film.half
            u = film.rate + film.acceleration * (t - self.middle)
            u = u - film.shape @ (of_half[i] + modes[i]) - film.along @ (halves[:, i] + rows[:, i])
            give = d * film.mobility
            F = film.D * max(u + give * film.F_0, 0.0) / (1.0 + give * film.D)
            film.impulse += d * F
            modes[i] += d * (F - film.F_0) / self.m * film.shape
            rows[:, i] += d * (F - film.F_0) * film.along / self.inertia
        return np.array([modes[1] + modes[0], modes[1] - modes[0]]) / ROOT, rows

    def foreseen(self, film):
        """Force at the step's end that, with that at its start, makes the impulses of the substeps."""
        return film.impulse / self.middle - film.F_0

    def accelerations(self, n):
        """Accelerations of modes [2, n] and halves [6, 2] by the change of the films' forces up to the end."""
        modes, rows = np.zeros((2, n)), np.zeros((6, 2))
        for film in self.films:
            more = self.foreseen(film) - film.F_0
            modes[film.half] += more / self.m * film.shape
            rows[:, film.half] += more * film.along / self.inertia
        return np.array([modes[1] + modes[0], modes[1] - modes[0]]) / ROOT, rows


def pocket_films_arrive(model, gamma, step, before, y, w, f, films):
    """At the step's end y, w, behind the evaluation: takes the excess of the films' forces at the predicted velocities from the rates f and
    the pockets' forces; returns the power that this saves [W].  step: films that followed in substeps, None without.
    """
    if not model.d.squeeze:
        return 0.0
    n, saved, foreseen = model.modes.n if model.modes else 0, 0.0, before.F.copy()
    for film in step.films if step else ():
        foreseen[film.half, film.ball] = step.foreseen(film)
    m, inertia = model.p.cage.m, inertia_of(model)
    (modes, more_modes), (rows, more_rows) = np.zeros((2, 2, n)), np.zeros((2, 6, 2))
    balls, more_balls = np.zeros((2, Z, 3))
    for i, k in np.argwhere(films.D > 0.0):
        _, _, along, direction = rigid_approach(model, 0.0, films.m[i][:, k], f, y, y, w.half[i], i, k)
        shape, D, F, F_0, F_f = films.shape[i][k], films.D[i, k], films.F[i, k], before.F[i, k], foreseen[i, k]
        of_wall, of_ball = mobility_of(model, shape, along), direction @ direction / model.d.m
        u = films.u[i, k] - shape @ modes[i] - along @ rows[:, i] + direction @ balls[k]
        push = gamma * (of_wall * F_f + of_ball * F_0)
        new = D * max(u + push, 0.0) / (1.0 + gamma * (of_wall + of_ball) * D)
        for on_wall, on_ball, to_modes, to_rows, to_balls in (
            (gamma * (new - F_f), gamma * (new - F_0), modes, rows, balls),
            (new - F, new - F, more_modes, more_rows, more_balls),
        ):
            to_modes[i] += on_wall / m * shape
            to_rows[:, i] += on_wall * along / inertia
            to_balls[k] -= on_ball / model.d.m * direction
        w.pocket[i].Q[k] += new - F
        w.pocket[i].F[:, k] += (new - F) * films.m[i][:, k]
        u -= gamma * (of_wall * (new - F_f) + of_ball * (new - F_0))
        saved += F * films.u[i, k] - new * u
        films.F[i, k] = new
        if model.modes:
            films.rate = max(films.rate, D * (model.modes.wall_mobility if model.d.guided else of_wall))
    f[MODE_S_DOT][:n] += (more_modes[1] + more_modes[0]) / ROOT
    f[MODE_D_DOT][:n] += (more_modes[1] - more_modes[0]) / ROOT
    for block, change in zip(HALVES, more_rows, strict=True):
        f[block] += change
    f[BALL_V_X] += more_balls[:, 0]
    f[BALL_V_R] += more_balls[:, 1]
    f[BALL_OMEGA_M] += more_balls[:, 2] / y[BALL_R]
    return saved
