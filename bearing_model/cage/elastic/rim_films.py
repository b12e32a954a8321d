"""Films on bent rims within a step: the readable twin of rim_films.c, which has the equations.

    F(t) = F_n - D (u - u_n),  P = d F_n - (1 + d D Y)^-1 d D delta,  delta: u - u_n with d F_n alone

u: velocities of the land along its half's axes and of the rim's shapes [6].
"""

from dataclasses import dataclass, field

import numpy as np

from bearing_model.generated.variables import CAGE_BETA_DOT, CAGE_GAMMA_DOT, CAGE_S, CAGE_V_Y, CAGE_V_Z


@dataclass
class RimFilms:
    """Forces on the shapes of both bent rims [2, 4] and rates of land and rim [2, 6, 6] at an evaluation, 0 of one that is not
    bent; stiffness of the gap that has the larger one [N/m].
    """

    force: np.ndarray = field(default_factory=lambda: np.zeros((2, 4)))
    rates: np.ndarray = field(default_factory=lambda: np.zeros((2, 6, 6)))
    stiffness: float = 0.0


def land_lever(model, h):
    """Lever of the land from the centre of mass of half h [m]."""
    return (2 * h - 1) * model.p.cage.land_x - model.d.com_x[h]


def mobilities(model):
    """Velocities of lands and shapes per impulse on them [2, 6] [1/kg]."""
    by = [1.0 / model.p.cage.m + land_lever(model, h) ** 2 / model.d.J_t for h in range(2)]
    return np.array([np.append(np.full(2, land), model.modes.mobility) for land in by])


def rim_motions(model, modes):
    """Motions of both rims' shapes [2, 4] by coordinates S and D [2, n]."""
    S, D = modes @ model.modes.rim
    return np.array([S - D, S + D]) / np.sqrt(2.0)


def rim_modes(model, force):
    """Accelerations of S and D [2, n] by forces on both rims' shapes [2, 4]."""
    f_0, f_1 = force @ model.modes.rim.T / (np.sqrt(2.0) * model.p.cage.m)
    return np.array([f_1 + f_0, f_1 - f_0])


class RimFilmsStep:
    """The films of a step from RimFilms; impulse: on the shapes [2, 4], so far."""

    def __init__(self, model, films):
        self.model, self.rates, self.force = model, films.rates, films.force
        self.now, self.impulse = films.force, np.zeros((2, 4))

    def before(self, gamma):
        """Forces at the step's end that with those at its start make the impulses so far [2, 4]."""
        return self.impulse / gamma - self.force

    def land_velocities(self, halves):
        """Velocities of both lands along their halves' axes [2, 2] by rates of the halves: x, y, z, beta, gamma, s [6, 2]."""
        _, y, z, beta, gamma, _ = halves
        found = []
        for h, half in enumerate(self.w.half):
            x, axes = land_lever(self.model, h), np.array([half.b_y[1:, 0], half.b_z[1:, 0]])
            found.append(axes @ np.array([y[h] + gamma[h] * x, z[h] - beta[h] * x]))
        return np.array(found)

    def first(self, w, d, f, v):
        """Before the first substep of length d, with the velocities v of S and D [2, n]; f: slow rates, w: kinematics."""
        self.w, self.d, self.mobility, self.by_film = w, d, mobilities(self.model), np.zeros((2, 2))
        self.begun = rim_motions(self.model, v)
        none = np.zeros(2)
        slow = np.array([none, f[CAGE_V_Y], f[CAGE_V_Z], f[CAGE_BETA_DOT], f[CAGE_GAMMA_DOT], none])
        self.acceleration = self.land_velocities(slow)  # of the centres of mass
        e, spin = self.model.d.com_e, np.ravel([half.s for half in w.half])
        self.acceleration += e * np.array([spin**2, -f[CAGE_S]]).T
        dD = d * self.rates
        self.answer = np.linalg.solve(np.eye(6) + dD * self.mobility[:, None, :], dD)

    def kick(self):
        """Changes of the velocities of S and D [2, n] at a substep's start, by half of the impulses of the substep before."""
        return 0.5 * self.d * rim_modes(self.model, self.now)

    def follow(self, t, v, halves):
        """Changes of the velocities v of S and D [2, n] at the end of a substep, the time t after the step's start, by the rest of its
        impulses.  halves: changes of the halves' velocities by the joints [6, 2].
        """
        d, by = self.d, self.mobility
        of_land = t * self.acceleration + self.land_velocities(halves) + self.by_film
        of_rim = rim_motions(self.model, v) - self.begun + by[:, 2:] * d * (self.force - 0.5 * self.now)
        change = -np.einsum("hik,hk->hi", self.answer, np.hstack([of_land, of_rim]))
        impulse = d * self.force + change[:, 2:]
        self.by_film = self.by_film + by[:, :2] * change[:, :2]
        self.impulse = self.impulse + impulse
        more = impulse - 0.5 * d * self.now
        self.now = impulse / d
        return rim_modes(self.model, more)
