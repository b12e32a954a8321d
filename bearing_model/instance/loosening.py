"""Preload lost by wear of the joint's faces: twin of fmu_src/instance/loosening.c, equations in loosening.h."""

import copy
from dataclasses import dataclass, field

import numpy as np

from bearing_model.generated.variables import Z

PRELOAD_SHARE = 1e-3


@dataclass
class Loosening:
    """Preload lost by each rivet since the start, and the part of it that the constants contain [N]."""

    loss: np.ndarray = field(default_factory=lambda: np.zeros(Z))
    in_force: np.ndarray = field(default_factory=lambda: np.zeros(Z))

    def add(self, p, table, rubbed):
        """Add steps in which the joints have rubbed, force times slip [J], [steps, Z]."""
        joint = table.joint
        face = 0.25 * np.pi * joint["seat"] ** 2 - joint["A"]
        self.loss = self.loss + p.joint.wear * joint["k_stack"] / face * np.sum(rubbed, axis=0)

    def apply(self, p):
        """The Parameters p with the preloads that are left."""
        if not np.any(self.in_force) or p.joint.preload == 0.0:
            return p
        p = copy.deepcopy(p)
        p.rivet.preload_factor = np.maximum(p.rivet.preload_factor - self.in_force / p.joint.preload, 0.0)
        return p

    def update(self, preload, P):
        """Put the loss in force if it has grown enough; returns whether it has been.  preload: joint.preload at temperature [N], P:
        preload of each rivet at present [N].
        """
        off = np.any((self.loss - self.in_force > PRELOAD_SHARE * preload) & (P > 0.0))
        if off:
            self.in_force = self.loss.copy()
        return bool(off)
