"""Preload of the rivets at the cage's temperature: P = P_0 + k (T - T_0), not below 0.

k = k_stack (alpha_flange - alpha_rivet) grip (bearing_model/rivet/rivet_rom.py) is a constant of the rivet table; T_0
is the temperature at which the rivets are set.
"""

from dataclasses import dataclass
from typing import Any
from weakref import WeakKeyDictionary

from ..base.errors import UserError
from ..base.units import rounded
from .fmu import Instance, Model
from .inputs import History
from .scene import Scene

PRELOAD, TEMPERATURE, OUTPUT = "joint.preload", "cage.T", "rivet[1].P"
TRIALS = (293.15, 303.15)  # temperatures at which an FMU tells its preload [K]
KNOWN = WeakKeyDictionary()  # the Thermal of each Model
LEAST = 1e-4  # of a rate that is one [N/K]
LARGE = 500.0  # preload of the trials [N]: it does not vanish


@dataclass(frozen=True)
class Thermal:
    """Change of the preload per kelvin [N/K], and the temperature at which the rivets are set [K]."""

    rate: float
    T_0: float

    @property
    def reason(self):
        """Why the preload changes with the temperature, or that it does not, in words."""
        if abs(self.rate) < LEAST:
            return "the cage expands as the rivets do"
        return f"the cage expands {'more' if self.rate > 0.0 else 'less'} than the rivets, {self.rate:+.3g} N/K"

    def at(self, preload, T):
        """Preload at T [N]."""
        return max(0.0, preload + self.rate * (T - self.T_0))


def of_fmu(model: Model) -> Any:
    """The Thermal of an FMU; None if it is not known."""
    if model not in KNOWN:
        KNOWN[model] = measured(model)
    return KNOWN[model]


def measured(model):
    """The Thermal of an FMU, by two of its starts; None if it does not start there."""
    found = []
    for T in TRIALS:
        inputs = {name: History([0.0], [T]) for name in model.inputs if name.endswith((".T", ".T_i", ".T_e"))}
        try:
            with Instance(model) as instance:
                instance.initialize(Scene(parameters={PRELOAD: LARGE}, inputs=inputs))
                found.append(instance.read([OUTPUT])[OUTPUT])
        except UserError:
            return None
    rate = (found[1] - found[0]) / (TRIALS[1] - TRIALS[0])
    return Thermal(rate, TRIALS[0] - (found[0] - LARGE) / rate if rate else TRIALS[0])


def of_geometry(geometry: Any) -> Any:
    """The Thermal of a rivet in its cage by rule from the shipped table's, without finite elements."""
    from bearing_model.physics.derived import default_table  # SciPy: not for a run
    from rivet_model.closed_form import stack_stiffness

    k = stack_stiffness(geometry, default_table().joint["k_stack"])
    expansion = (geometry.alpha_flange - geometry.alpha_rivet) * 2.0 * geometry.flange_thickness
    return Thermal(k * expansion, geometry.T_0)


def in_words(thermal, pairs, newtons, degrees):
    """Preload [N] as given and at the cage's temperature [K], of all pairs, and why; newtons, degrees: ranges in words."""
    given = newtons([preload for preload, _ in pairs])
    if thermal is None:
        return f"{given} as given"
    at = degrees([T for _, T in pairs])
    set_at, hot = f"{thermal.T_0 - 273.15:.4g} degC", newtons([rounded(thermal.at(*pair), 3) for pair in pairs])
    if at == set_at:
        return f"{given} at {set_at}, which the cage has"
    return f"{given} at {set_at}, {hot} with the cage at {at}: {thermal.reason}"
