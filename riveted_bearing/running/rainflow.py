"""Rainflow cycles and life of the rivets by the `rainflow` package (ASTM E1049) and bearing_model.instance.fatigue."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import rainflow

from bearing_model.generated.variables import MeanStress
from bearing_model.instance.fatigue import FatigueLaw, fatigue_cycle, fatigue_law_in_hole, strengthened

from ..bearing.strength import reversed_amplitudes
from .results import Result
from .summary import settled

CHANNELS = {"head": "sigma_head", "mid": "sigma_mid"}


@dataclass(frozen=True)
class RivetLife:
    """Cycles (range [Pa], mean [Pa], count), Miner's sum, time [s] to Miner's sum 1 if the run repeated."""

    cycles: np.ndarray
    damage: float
    life: float


def fatigue_law(parameters: dict[str, Any]) -> Any:
    """FatigueLaw of a result's parameters."""
    values = {name.removeprefix("fatigue."): value for name, value in parameters.items() if name.startswith("fatigue.")}
    return FatigueLaw(**values | {"mean_stress": int(MeanStress[values["mean_stress"].upper()])})


def cycle_damages(law: Any, span: Any, mean: Any) -> Any:
    """fatigue_cycle() of many cycles: arrays of ranges and means [Pa]."""
    amplitude = reversed_amplitudes(law, span, mean)
    with np.errstate(over="ignore"):
        slope = np.where(amplitude > law.sigma_D, law.k_1, law.k_2)
        return np.minimum((amplitude / law.sigma_D) ** slope / law.N_D, 1.0)


def fatigue_law_at(parameters: dict[str, Any], k: Any, place: str) -> Any:
    """FatigueLaw of rivet k at "head" or "mid" with its strength_factor, and fretting of a pressed shank."""
    law = strengthened(fatigue_law(parameters), parameters.get(f"rivet[{k}].strength_factor", 1.0))
    if place == "head" or law.fretting == 1.0:
        return law
    fits = (parameters["joint.fit"], parameters["joint.swell"], parameters[f"rivet[{k}].dfit"])
    return fatigue_law_in_hole(law, sum(fits))  # of the sign of the effective fit


def stress_history(result: Result, k: Any, place: str) -> Any:
    """Settled stress of rivet k at "head" or "mid" [Pa]: peak and end of each step in turn, without minima between; or None."""
    ends = result.data.get(f"rivet[{k}].{CHANNELS[place]}")
    if ends is None:
        return None
    late = settled(result)
    peaks = result.data.get(f"rivet[{k}].{CHANNELS[place]}_peak", ends)
    return np.column_stack([peaks[late], ends[late]]).ravel()


def cycles_of(history: Any) -> Any:
    """Rainflow cycles of a series: rows of range, mean and count."""
    numbers = np.asarray(history, float).tolist()  # of Python, with which the library is faster by a third
    cycles = [cycle[:3] for cycle in rainflow.extract_cycles(numbers)]
    return np.array(cycles, float).reshape(-1, 3)


def rivet_life(result: Result, k: Any, place: str) -> Any:
    """RivetLife of rivet k at "head" or "mid", None if its stress was not recorded."""
    history = stress_history(result, k, place)
    if history is None:
        return None
    law, t = fatigue_law_at(result.parameters, k, place), result.data["time"][settled(result)]
    cycles = cycles_of(history)
    damage = sum(count * fatigue_cycle(law, span, mean) for span, mean, count in cycles if span > 0.0)
    return RivetLife(cycles, damage, float(t[-1] - t[0]) / damage if damage > 0.0 else np.inf)
