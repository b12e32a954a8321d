"""What happens when the first rivet goes: the most damaged one breaks, the rest is simulated on, and so on.

    scene = "demo"                       # as in a sweep (default: none, the FMU's own parameters and inputs), and so are [simulation], [parameters], [inputs]
    seeds = 4                            # runs of each state of the cage
    breaks = 3                           # rivets that break before the end
    until = "20000 h"                    # what breaks later is not followed (default: no limit)
    [[case]]                             # each case is a cascade of its own; without one there is a single one
    name = "clearance"
    [case.parameters]
    joint.fit = "-90 um"
    [case.inputs]
    shaft.tilt_y = "0.1 deg"

A state of the cage is the list of rivets that are gone (rivet[k].intact = 0); those that a case leaves out are gone from the
start.  Its runs give the damage per hour of each rivet's head and middle, mean over the seeds.  Damage adds up over
the states (Miner); the place that first reaches 1 breaks, and with it the rivet carries nothing.  A cascade ends when as many
rivets have broken as were asked for, when no rivet is left, when the halves part so that the FMU stops every run, when the next
break comes after `until` hours, or when nothing is damaged any more.  Joints that open are no end: between elastic
halves at speed all of them do, under the centrifugal load.

The same as one simulation for each seed (run_single): rivets break by themselves (scene.breakage = on), and
fatigue.acceleration is so large that the first one breaks in the middle of the run.  Its times of breakage, multiplied
by fatigue.acceleration, equal those of the restarted runs apart from the scatter of short runs.

How sure the order is: the share of bootstrap resamples of the seeds in which the same place is the next to break.
"""

from __future__ import annotations

import json
import textwrap
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
from pydantic import Field

from ..base.errors import UserError, refusal
from ..base.file_kinds import check_keys
from ..base.files import write_atomically
from ..base.schema import Count, Named, Number, Section, Text, checked
from ..base.toml_files import leaves, section_of
from ..base.units import hours_text
from ..show.plot import HEAD, MIDDLE, MUTED, STYLE, plt
from ..studies.sweep_file import known_names
from .bench import Bench, Seeded

if TYPE_CHECKING:
    from ..running.fmu import Model

SECTIONS = ("parameters", "inputs")
HOURS = {"h": 1.0, "d": 1.0 / 24.0, "years": 1.0 / 8766.0}  # of one hour
PLACES = ("head", "middle")
RESAMPLES = 2000


class CascadeCase(Section):
    """A cascade of its own."""

    name: Text | None = Field(None, description="default: its number")
    parameters: Named = {}
    inputs: Named = {}


class CascadeFile(Seeded):
    """What happens when the first rivet goes: without [[case]] there is a single cascade."""

    breaks: Annotated[int, Count()] = Field(3, description="rivets that break before the end")
    until: Annotated[float, Number(HOURS, above=0.0, words="a time above 0 h is needed")] = Field(
        np.inf, description="what breaks later is not followed; default: no limit"
    )
    case: list[CascadeCase] = []


@dataclass(frozen=True)
class State:
    """A state of the cage: rivets gone before (numbers from 1), its damage rates [Z, 2] of heads and middles per hour,
    mean over seeds, and loads.

    hours: how long it lasts; rivet, place: what breaks at its end, None if nothing does; sure: share of the resamples
    that agree; end: why nothing is followed any more. stress [Z]: 99.9 % quantile of the heads [Pa]; dislocation: largest
    between the halves [m]; open: most joints that were open at once.
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


@dataclass(frozen=True)
class Cascade:
    """The states of one case, in order; basis: of its runs."""

    name: str
    states: tuple
    basis: tuple = ()

    @property
    def order(self):
        """(rivet, place, hours since the begin) of each break."""
        hours = np.cumsum([state.hours for state in self.states])
        return [
            (state.rivet, state.place, float(at))
            for state, at in zip(self.states, hours, strict=True)
            if state.rivet is not None
        ]


def plan_cascade(path: Path, document: dict[str, Any]) -> Any:
    """Names and parameters of the cases, number of breaks, hours that are followed; UserError names what cannot be used."""
    check_keys(path, document, CascadeFile.model_fields, "cascade")
    file = checked(CascadeFile, document, path)
    cases = file.case or [CascadeCase()]
    named = {case.name or str(i + 1 if len(cases) > 1 else path.stem): case for i, case in enumerate(cases)}
    if len(named) < len(cases):
        raise refusal(path, "case", [case.name for case in cases], "each case needs a name of its own")
    return named, file.breaks, file.until


def bench_of(path, document, model, folder, client, progress, case, own=()):
    """Bench of a case: what the document says, changed by the case's parameters and inputs, changed by own parameters."""
    common = {key: document[key] for key in ("description", "scene", "simulation", "seeds", "seed") if key in document}
    names = known_names(model)
    for section in SECTIONS:
        common[section] = dict(leaves(section_of(path, document, section), names)) | dict(
            leaves(getattr(case, section), names)
        )
    common["parameters"] |= dict(own)
    return Bench(path, common, model, folder, client, progress)


def default_document(model: Model, shipped: Any) -> Any:
    """What a cascade is without a file: the shipped one, of an FMU of its own with the fit that the FMU has, and long
    enough for its speed.
    """
    if not model.origin:
        return shipped
    settle = model.default(model.parameters["start.settle"])
    t_end = max(shipped["simulation"]["t_end"], 2.0 * settle)
    kept = {key: shipped[key] for key in ("seeds", "breaks")}
    return kept | {"description": "Rivet after rivet at the FMU's own working point", "simulation": {"t_end": t_end}}


def run_cascades(
    path: Path, document: dict[str, Any], model: Model, folder: Path, client: Any, progress: Any = None
) -> Any:
    """The Cascades of all cases; runs are read from the folder where they are there."""
    cases, breaks, until = plan_cascade(path, document)
    found = []
    for name, case in cases.items():
        bench = bench_of(path, document, model, folder, client, progress, case)
        bench.counts_damage = True
        bench.label = name
        rivets = sum(each.startswith("rivet[") and each.endswith("].intact") for each in model.parameters)
        missing = missing_of(bench.scene, rivets)
        if breaks > rivets - len(missing):
            raise refusal(
                path, "breaks", breaks, f"at most the rivets that stand, {rivets - len(missing)}, are allowed"
            )
        states = follow(
            lambda gone, bench=bench, rivets=rivets: state_of(bench, rivets, gone), breaks, bench.first, missing, until
        )
        found.append(Cascade(name, tuple(states), tuple(bench.basis())))
    return found


def run_single(
    path: Path,
    document: dict[str, Any],
    model: Model,
    folder: Path,
    client: Any,
    found: Any,
    progress: Any = None,
) -> Any:
    """Breaks of one simulation for each seed, by the case's name: [seed][break] (rivet, place, hours since the begin).

    found: Cascades of run_cascades, whose first state says by how much the damage is to be accelerated.  A case in which
    nothing is damaged has no breaks.
    """
    cases, breaks, _ = plan_cascade(path, document)
    lives = {}
    for cascade in found:
        plain = bench_of(path, document, model, folder, client, progress, cases[cascade.name])
        settle = plain.scene.parameters.get("start.settle", model.default(model.parameters["start.settle"]))
        first = cascade.states[0].hours
        if not np.isfinite(first):
            lives[cascade.name] = [[] for _ in range(plain.seeds)]
            continue
        factor, most = 2.0 * 3600.0 * first / (plain.scene.t_end - settle), model.parameters["fatigue.acceleration"].max
        if most is not None and factor > float(most):
            raise UserError(
                f"{path}: {cascade.name}: the first rivet breaks after {hours_text(first)}, so late that --single needs "
                f"fatigue.acceleration = {factor:.3g}; at most {float(most):g} is allowed: leave --single out, or raise load or speed"
            )
        own = {"scene.breakage": "on", "fatigue.acceleration": factor}
        bench = bench_of(path, document, model, folder, client, progress, cases[cascade.name], own)
        rivets = len(cascade.states[0].rates)
        names = [f"rivet[{k}].{what}" for k in range(1, rivets + 1) for what in ("break_time", "broken")]
        # a run ends where all rivets are broken
        values = bench([], [[]], names, to_the_stop=True)[0].reshape(bench.seeds, rivets, 2)
        lives[cascade.name] = [breaks_of(times, settle, factor)[:breaks] for times in values]
    return lives


def breaks_of(values, settle, factor):
    """(rivet, place, hours) in the order of time from break times and places [Z, 2] of a run with accelerated damage."""
    broken = [(t, k + 1, PLACES[int(place) - 1]) for k, (t, place) in enumerate(values) if t >= 0.0]
    return [(k, place, (t - settle) * factor / 3600.0) for t, k, place in sorted(broken)]


def missing_of(scene, rivets):
    """Rivets (numbers from 1) that the parameters of a scene leave out."""
    return [k for k in range(1, rivets + 1) if float(scene.parameters.get(f"rivet[{k}].intact", 1.0)) == 0.0]


def state_of(bench, rivets, gone):
    """State without its end, and the damage rates with each seed [seeds, Z, 2]; None where the FMU stops every run."""
    if len(gone) == rivets:
        return State(tuple(gone), np.zeros((rivets, 2)), np.zeros(rivets), 0.0, 0), None
    numbers = range(1, rivets + 1)
    names = [f"rivet[{k}].damage_{place}" for k in numbers for place in ("head", "mid")] + [
        f"stat.rivet_head_p999[{k}]" for k in numbers
    ]
    names += ["simulated_time", "start.settle", "max(cage.dislocation)", "max(event.joint_open)"]
    values = bench([f"rivet[{k}].intact" for k in gone], [[0.0] * len(gone)], names)[0]  # [seeds, names]
    if np.isnan(values).any(axis=1).all():
        return State(tuple(gone), np.zeros((rivets, 2)), np.zeros(rivets), 0.0, rivets - len(gone)), None
    values = values[~np.isnan(values).any(axis=1)]
    hours = np.maximum(values[:, -4] - values[:, -3], 1e-9) / 3600.0
    hours *= float(bench.scene.parameters.get("fatigue.acceleration", 1.0))
    rates = values[:, : 2 * rivets].reshape(-1, rivets, 2) / hours[:, None, None]
    stress = values[:, 2 * rivets : 3 * rivets].mean(axis=0)
    return State(
        tuple(gone), rates.mean(axis=0), stress, float(np.max(values[:, -2])), int(np.max(values[:, -1]))
    ), rates


def follow(state_at, breaks, seed=1, missing=(), until=np.inf):
    """States of a cascade; state_at(gone) gives a State and its rates with each seed.  missing: gone from the start; until:
    hours that are followed.
    """
    damage, gone, states, rng = None, list(missing), [], np.random.default_rng(seed)
    while True:
        state, rates = state_at(gone)
        damage = np.zeros(state.rates.shape) if damage is None else damage
        if missing and not states:
            damage[np.array(missing) - 1] = -np.inf
        hours, first = next_break(damage, state.rates)
        end = end_of(
            state, rates, len(gone) - len(missing) >= breaks, hours, until - sum(each.hours for each in states)
        )
        if end:
            return [*states, replace(state, end=end)]
        resampled = rates[rng.integers(len(rates), size=(RESAMPLES, len(rates)))].mean(axis=1)
        sure = float(np.mean([next_break(damage, each)[1] == first for each in resampled]))
        damage = damage + hours * state.rates
        damage[first[0]] = -np.inf  # what is gone breaks no more
        gone = sorted([*gone, first[0] + 1])
        states.append(
            State(
                state.gone,
                state.rates,
                state.stress,
                state.dislocation,
                state.open,
                float(hours),
                first[0] + 1,
                PLACES[first[1]],
                sure,
            )
        )


def end_of(state, rates, enough, hours, left):
    """Why a cascade ends in this state, or None."""
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


def write_cascades(found: Any, path: Path, single: Any = None) -> Path:
    """JSON: for each case what it rests on, its breaks (rivet, place, hours, sure), its states, and the breaks of single
    simulations by seed, if there are any (run_single); returns the path.
    """

    def plain(state):
        values = asdict(state) | {
            "rates": state.rates.tolist(),
            "stress": state.stress.tolist(),
            "gone": list(state.gone),
        }
        return values | {"hours": state.hours if np.isfinite(state.hours) else None}

    content = {
        each.name: {
            "basis": dict(each.basis),
            "order": [{"rivet": rivet, "place": place, "hours": hours} for rivet, place, hours in each.order],
            "states": list(map(plain, each.states)),
        }
        | (
            {
                "single": [
                    [{"rivet": k, "place": place, "hours": hours} for k, place, hours in run]
                    for run in single[each.name]
                ]
            }
            if single
            else {}
        )
        for each in found
    }
    write_atomically(
        path, lambda temporary: temporary.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")
    )
    return path


def write_picture(found: Any, path: Path) -> Path:
    """Picture: a row for each case, a circle of rivets for each of its states with the damage rate of the worse place,
    what is gone crossed out.
    """
    most = max(len(each.states) for each in found)
    rates = [np.max(state.rates, axis=1) for each in found for state in each.states]
    positive = np.concatenate(rates)[np.concatenate(rates) > 0.0]
    low, high = (np.log10(positive.min()), np.log10(positive.max())) if positive.size else (-1.0, 0.0)
    with plt.rc_context(STYLE):
        figure, axes = plt.subplots(
            len(found), most, figsize=(2.6 * most, 2.9 * len(found)), squeeze=False, layout="constrained"
        )
        for row, each in zip(axes, found, strict=True):
            for ax in row[len(each.states) :]:
                ax.axis("off")
            for ax, state in zip(row, each.states, strict=False):
                circle(ax, state, low, high)
            row[0].set_ylabel(each.name)
        figure.suptitle(
            textwrap.fill(
                "Damage of each rivet (area: logarithm of the rate), what breaks next and when", 12 * int(2.6 * most)
            ),
            x=0.01,
            ha="left",
            fontsize=11,
        )
        write_atomically(path, lambda temporary: figure.savefig(temporary, dpi=110))
        plt.close(figure)
    return path


def circle(ax, state, low, high):
    """One state: rivet k at its angle."""
    Z = len(state.rates)
    angle = 2.0 * np.pi * (np.arange(Z) + 0.5) / Z
    worse = np.argmax(state.rates, axis=1)
    size = 30.0 + 170.0 * np.clip(
        (np.log10(np.maximum(state.rates.max(axis=1), 1e-300)) - low) / max(high - low, 1e-9), 0.0, 1.0
    )
    ax.plot(
        np.cos(np.linspace(0, 2 * np.pi, 200)), np.sin(np.linspace(0, 2 * np.pi, 200)), color=MUTED, lw=0.8, zorder=0
    )
    for k in range(Z):
        x, y = np.cos(angle[k]), np.sin(angle[k])
        if k + 1 in state.gone:
            ax.plot(x, y, "x", color=MUTED, ms=9)
        else:
            ax.scatter(
                x,
                y,
                s=size[k],
                color=MIDDLE if worse[k] else HEAD,
                edgecolor="black" if k + 1 == state.rivet else "none",
                linewidth=2.0,
            )
        ax.text(0.72 * x, 0.72 * y, str(k + 1), ha="center", va="center", fontsize=8)
    text = (
        textwrap.fill(state.end or "end", 18)
        if state.rivet is None
        else f"{state.place} of {state.rivet}\nafter {hours_text(state.hours)}"
    )
    ax.text(0.0, 0.0, text, ha="center", va="center", fontsize=8)
    ax.set(xlim=(-1.25, 1.25), ylim=(-1.25, 1.25), aspect="equal", xticks=[], yticks=[])
    ax.spines[:].set_visible(False)
