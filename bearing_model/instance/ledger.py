"""Where the energy goes: the energy supplied, stored and lost since the start, term by term.

    sum of supplied + sum of changed = change of energy + sum of lost

Powers are integrated over the accepted steps from their values and rates at both ends,  h (P_0 + P_1)/2 + h^2 (P_0' - P_1')/12  (order 4, Hermite),
the energies are those of the states, so that the two sides of the balance share nothing but the trajectory.  The rates
of the powers are complex steps along dy/dt.
"""

from dataclasses import dataclass, field

import numpy as np

from bearing_model.instance.energy import energy_terms
from bearing_model.instance.events import energy_off
from bearing_model.physics.model import Work
from bearing_model.physics.powers import friction_torque, loss_terms, shaft_power, supply_terms
from bearing_model.physics.rhs import rhs

STEP = 1e-30  # of the complex step [s]


def exchange_terms(model, w):
    """Torque and power of the shaft, by the output that has the mean of each over a communication step."""
    return {"bearing.friction_torque": friction_torque(w), "shaft.power": shaft_power(w)}


@dataclass
class Ledger:
    """Energies [J] since the start by name: numbers during a simulation, arrays [points] in Results.

    supplied: by the inner ring's spin (the shaft's torque), translation and tilting, by the housing, by gravity and
    frame; stored: change of kinetic and elastic energies;
    changed: by parameters that were set in the run and rivets that broke, part of stored;
    exchanged: integrals of the shaft's torque about its axis [N.m.s] and of its power [J]; moved: of the amount of its power;
    lost: in races, pockets, drag, land and joints.
    """

    supplied: dict = field(default_factory=dict)
    stored: dict = field(default_factory=dict)
    lost: dict = field(default_factory=dict)
    changed: dict = field(default_factory=dict)
    exchanged: dict = field(default_factory=dict)
    moved: float = 0.0

    @property
    def residual(self):
        """Supplied + changed - stored - lost [J]: zero but for the error of the integration."""
        put_in = sum(self.supplied.values()) + sum(self.changed.values())
        return put_in - sum(self.stored.values()) - sum(self.lost.values())

    def add_change(self, before, after):
        """Add the energies {name: J} that a change of parameters takes from `before` to `after` at once."""
        for name, energy in after.items():
            jump = float(np.squeeze(energy - before[name]))
            self.changed[name] = self.changed.get(name, 0.0) + jump
            self.stored[name] = self.stored.get(name, 0.0) + jump

    def add(self, model, t, y):
        """Add the steps between the times t [points], whose states are y [points, N_STATES]; the first point is the
        start of the first step.
        """
        w, along = Work(), Work()
        y_dot = rhs(model, t, y, w)
        rhs(model, t + 1j * STEP, y + 1j * STEP * y_dot, along)
        accounts = (self.supplied, supply_terms), (self.lost, loss_terms), (self.exchanged, exchange_terms)
        for account, terms in accounts:
            for name, rate in terms(model.at(t + 1j * STEP), along).items():
                P = np.broadcast_to(rate, (len(t), 1))[:, 0]
                account[name] = account.get(name, 0.0) + integral(np.diff(t), np.real(P), np.imag(P) / STEP)
        P = np.broadcast_to(np.abs(shaft_power(w)), (len(t), 1))[:, 0]
        self.moved += np.sum(0.5 * np.diff(t) * (P[:-1] + P[1:]))
        for name, energy in energy_terms(model, y, w).items():
            self.stored[name] = self.stored.get(name, 0.0) + energy[-1, 0] - energy[0, 0]

    def add_friction(self, lost):
        """Add the energy that the joints' friction has dissipated [J]."""
        self.lost["joints"] = self.lost.get("joints", 0.0) + lost

    def copy(self):
        accounts = self.supplied, self.stored, self.lost, self.changed, self.exchanged
        return Ledger(*map(dict, accounts), self.moved)

    def event(self, before, held):
        """Whether the energy is off, by the Ledger at the last communication point and the energy that is held now [J]."""
        lost = sum(self.lost.values())
        return energy_off(self.residual, held, self.moved, lost, lost - sum(before.lost.values()))

    def means(self, before, length):
        """Outputs that are means over a communication step of this length [s], by the Ledger at its start."""
        return {name: (value - before.exchanged[name]) / length for name, value in self.exchanged.items()}

    @classmethod
    def over_time(cls, ledgers):
        """One Ledger of arrays from those of all points; a term that appears at a later point is 0 before it."""

        def account(name):
            terms = getattr(ledgers[-1], name)
            return {term: np.array([getattr(ledger, name).get(term, 0.0) for ledger in ledgers]) for term in terms}

        accounts = "supplied", "stored", "lost", "changed", "exchanged"
        return cls(*(account(name) for name in accounts))


def integral(h, P, P_dot):
    """Integral of a power over steps h from its values P and rates P_dot at their ends."""
    return np.sum(0.5 * h * (P[:-1] + P[1:]) + h * h / 12.0 * (P_dot[:-1] - P_dot[1:]))
