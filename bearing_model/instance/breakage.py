"""Rivets that break by their damage (scene.breakage = on): twin of fmu_src/instance/breakage.c."""

import copy
from dataclasses import dataclass, field

import numpy as np

from bearing_model.generated.variables import Switch, Z

HOLDS, BROKEN_HEAD, BROKEN_MIDDLE, BROKEN_BY_HOST = range(4)


@dataclass
class Breakage:
    """Where each rivet is broken by its damage, when [s], and how many broke at the last communication point."""

    place: np.ndarray = field(default_factory=lambda: np.full(Z, HOLDS))
    time: np.ndarray = field(default_factory=lambda: np.full(Z, -1.0))
    latest: int = 0
    onsets: int = 0

    def apply(self, p):
        """The Parameters p without the broken rivets."""
        if np.all(self.place == HOLDS):
            return p
        p = copy.deepcopy(p)
        p.rivet.intact = np.where(self.place == HOLDS, p.rivet.intact, 0)
        return p

    def holds(self, p):
        """Whether each rivet holds; by damage or by the host it may not."""
        return (self.place == HOLDS) & (p.rivet.intact != 0)

    def update(self, p, t, head, mid):
        """Mark the rivets whose damage in the head or in the middle has reached 1 at time t [s]; returns whether there are any."""
        self.latest = 0
        if p.scene.breakage != Switch.ON:
            return False
        worse = np.maximum(head, mid)
        new = self.holds(p) & (worse >= 1.0)
        self.place = np.where(new, np.where(head >= mid, BROKEN_HEAD, BROKEN_MIDDLE), self.place)
        self.time = np.where(new, t, self.time)
        self.latest = int(np.sum(new))
        self.onsets += self.latest > 0
        return self.latest > 0

    def outputs(self, p):
        """By the names of the variable table."""
        by_host = (self.place == HOLDS) & (p.rivet.intact == 0)
        return {
            "rivet[k].broken": np.where(by_host, BROKEN_BY_HOST, self.place).astype(float),
            "rivet[k].break_time": self.time,
            "event.rivet_break": float(self.latest),
            "event.rivet_break_onsets": float(self.onsets),
        }
