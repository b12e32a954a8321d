"""What breaks next: from the rivets that are gone on, the most damaged place breaks, the rest is simulated on, and so on.

A state of the cage is the list of rivets that are gone (rivet[k].intact = 0).  Its runs give the damage per hour of each
rivet's head and middle, mean over the seeds.  Damage adds up over the states (Miner); the place that first reaches 1
breaks, and with it the rivet carries nothing.  The order ends when as many rivets have broken as were asked for, when no
rivet is left, when the halves part so that the FMU stops every run, when the next break comes after `within` hours, or
when nothing is damaged any more.  Joints that open are no end: between elastic halves at speed all of them do, under the
centrifugal load.

How sure the order is: the share of bootstrap resamples of the seeds in which the same place is the next to break.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from ..base.units import hours_text
from ..design.bench import Bench

PLACES = ("head", "middle")
RESAMPLES = 2000


@dataclass(frozen=True)
class State:
    """A state of the cage: rivets gone, mean damage rates [Z, 2] per hour, 99.9 % stress [Z] [Pa], dislocation [m], open joints.

    hours: its length; rivet, place: what breaks, or None; sure: share of resamples that agree; end: why none follows.
    """

    gone: tuple
    rates: np.ndarray
    stress: np.ndarray
    dislocation: float
    open: int
    hours: float = np.inf
    rivet: int | None = None
    place: str | None = None
    sure: float | None = None
    end: str | None = None


def bench_of(path: Any, document: Any, model: Any, folder: Any, client: Any, progress: Any = None) -> Bench:
    """The bench of a file of findings: its mission alone."""
    keys = ("description", "scene", "simulation", "seeds", "seed", "parameters", "inputs")
    bench = Bench(path, {key: document[key] for key in keys if key in document}, model, folder, client, progress)
    bench.counts_damage, bench.label = True, "the mission"
    return bench


def run_order(bench: Bench, rivets: int, breaks: int, missing: Any, within: float) -> list[State]:
    """The States from the rivets on that are missing; runs are read from the folder where they are there."""
    left_out = [k for k in range(1, rivets + 1) if float(bench.scene.parameters.get(f"rivet[{k}].intact", 1.0)) == 0.0]
    missing = sorted({*missing, *left_out})
    return follow(lambda gone: state_of(bench, rivets, gone), breaks, bench.first, missing, within)


def state_of(bench, rivets, gone):
    """State without its end, and the damage rates with each seed [seeds, Z, 2]; None where the FMU stops every run."""
    if len(gone) == rivets:
        return State(tuple(gone), np.zeros((rivets, 2)), np.zeros(rivets), 0.0, 0), None
    numbers = range(1, rivets + 1)
    names = [f"rivet[{k}].damage_{place}" for k in numbers for place in ("head", "mid")]
    names += [f"stat.rivet_head_p999[{k}]" for k in numbers]
    names += ["simulated_time", "start.settle", "max(cage.dislocation)", "max(event.joint_open)"]
    values = bench([f"rivet[{k}].intact" for k in gone], [[0.0] * len(gone)], names)[0]  # [seeds, names]
    if np.isnan(values).any(axis=1).all():
        return State(tuple(gone), np.zeros((rivets, 2)), np.zeros(rivets), 0.0, rivets - len(gone)), None
    values = values[~np.isnan(values).any(axis=1)]
    hours = np.maximum(values[:, -4] - values[:, -3], 1e-9) / 3600.0
    hours *= float(bench.scene.parameters.get("fatigue.acceleration", 1.0))
    rates = values[:, : 2 * rivets].reshape(-1, rivets, 2) / hours[:, None, None]
    stress = values[:, 2 * rivets : 3 * rivets].mean(axis=0)
    largest = float(np.max(values[:, -2])), int(np.max(values[:, -1]))
    return State(tuple(gone), rates.mean(axis=0), stress, *largest), rates


def follow(state_at, breaks, seed=1, missing=(), within=np.inf):
    """States in order; state_at(gone): a State and its rates with each seed; missing: at the start; within: hours."""
    damage, gone, states, rng = None, list(missing), [], np.random.default_rng(seed)
    while True:
        state, rates = state_at(gone)
        damage = np.zeros(state.rates.shape) if damage is None else damage
        if missing and not states:
            damage[np.array(missing) - 1] = -np.inf
        hours, first = next_break(damage, state.rates)
        left = within - sum(each.hours for each in states)
        if end := end_of(state, rates, len(gone) - len(missing) >= breaks, hours, left):
            return [*states, replace(state, end=end)]
        resampled = rates[rng.integers(len(rates), size=(RESAMPLES, len(rates)))].mean(axis=1)
        sure = float(np.mean([next_break(damage, each)[1] == first for each in resampled]))
        damage = damage + hours * state.rates
        damage[first[0]] = -np.inf  # what is gone breaks no more
        gone = sorted([*gone, first[0] + 1])
        states.append(replace(state, hours=float(hours), rivet=first[0] + 1, place=PLACES[first[1]], sure=sure))


def end_of(state, rates, enough, hours, left):
    """Why nothing follows this state, or None."""
    if len(state.gone) == len(state.rates):
        return "no rivet is left"
    if rates is None:
        return "the halves part: the FMU stops every run"
    if enough:
        return "as many as asked for"
    if not np.isfinite(hours):
        return "nothing is damaged any more"
    return f"the next break comes {hours_text(hours)} later, after the time asked for" if hours > left else None


def next_break(damage, rates):
    """Hours until the first place [rivet, head or middle] reaches a damage of 1, and that place."""
    with np.errstate(divide="ignore", invalid="ignore"):
        hours = np.where(rates > 0.0, (1.0 - damage) / rates, np.inf)
    at = np.unravel_index(np.argmin(hours), hours.shape)
    return hours[at], (int(at[0]), int(at[1]))


def plain(state: State) -> dict[str, Any]:
    """A State as JSON has it."""
    values = {"rates": state.rates.tolist(), "stress": state.stress.tolist(), "gone": list(state.gone)}
    return asdict(state) | values | {"hours": state.hours if np.isfinite(state.hours) else None}
