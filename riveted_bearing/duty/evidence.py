"""The figures that a sheet rests on, of a mission or of one run."""

import functools
import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..base.errors import UserError
from ..bearing.strength import damage_of_matrix, reversed_amplitudes
from ..running.budget import digits
from ..running.budget import of_result as of_run
from ..running.fmu import Model
from ..running.rainflow import CHANNELS, cycle_damages, fatigue_law_at
from ..running.runner import simulate
from ..running.seeds import started
from ..running.summary import breaks, columns, has_statistics, life_is_known, settled
from .assess import Life, Runs, part_duty, place_text, places, used_cases
from .cycles import rainflow_columns, stored_cycles
from .miner import lives
from .page import ends_of, interval_text
from .raceways import Raceways


@dataclass(frozen=True)
class Evidence:
    """What a sheet judges: life, low, high [h] (None, and why untold), scaled(x): shortest lives [h] of heads and middles at x
    times the stress; amplitudes [Pa]; knees [Pa], None for a table; results by part; worst: the part that decides; rivet.
    """

    life: float | None
    low: float | None
    high: float | None
    place: str
    interval: str
    scaled: object = field(repr=False)
    amplitudes: tuple
    knees: tuple
    results: dict = field(repr=False)
    worst: str
    rivet: int
    damage: tuple  # of each rivet in the worst part, at the worse of its places; by it `rivet` is the first to fail
    untold: str = ""
    raceways: Raceways = field(default_factory=Raceways, repr=False)
    budgets: dict = field(default_factory=dict, repr=False)  # error budgets by figure


def of_mission(life: Life, runs: Runs, model: Model, progress: Any = lambda done, total: None) -> Any:
    """Evidence of a mission's Life and its Runs; simulates each point and event once more, with all outputs."""
    mission, duty = life.mission, life.mission.duty
    used = used_cases(duty, list(life.kept)).tolist()
    share = dict(zip(life.kept, life.estimate.shares, strict=True))
    worst = max(share, key=lambda i: share[i])
    results: dict[str, Any] = {}
    rivet = 0
    chosen = [(i, c) for i in life.kept if (c := first_case(mission, i)) in used]
    for done, (i, c) in enumerate(chosen):
        progress(done, len(chosen))
        damage = np.array([runs.damages[key] for key in runs.keys_of(c)]).reshape(
            -1, runs.damages[runs.keys[c, 0]].size
        )
        judged = damage
        if mission.settings["rivets"] == "each":
            judged = np.where(np.arange(damage.shape[1]) == life.estimate.place, damage, 0.0)
        most = np.unravel_index(np.argmax(judged), damage.shape)
        if i == worst or not rivet:
            rivet = int(most[1]) // 2 + 1
            of_rivets = damage.mean(axis=0) if mission.settings["rivets"] == "each" else damage[most[0]]
        scene = started(mission.cases[c].scene, model, mission.settings["seed"], int(most[0]))
        results[mission.parts[i].name] = simulate(model, scene)
    if mission.parts[worst].name not in results:  # interpolated: from the simulated part with the largest share
        worst = max((i for i, _ in chosen), key=lambda i: share[i])
    matrices = [runs.matrices[key] for key in runs.damages]
    strength = next(iter(runs.strengths.values()), None)
    laws = matrices[0][1]
    found = life.estimate
    return Evidence(
        found.life,
        life.low,
        found.high,
        life.place,
        f"{100 * mission.settings['confidence']:g} %: {interval_text(*ends_of(life), few=digits(life.budgets))}",
        functools.cache(lambda x: scaled_lives(life, runs, used, x)),
        largest_amplitudes((matrix, laws) for matrix, laws, _ in matrices),
        knees_of(strength, laws),
        results,
        mission.parts[worst].name,
        rivet,
        worse_places(of_rivets),
        raceways=mission.raceways(),
        budgets=life.budgets,
    )


def worse_places(damage):
    """Damage of each rivet at the worse of head and middle, from [2 Z] in their order."""
    return tuple(np.reshape(damage, (-1, 2)).max(axis=1).tolist())


def first_case(mission, i):
    """Number of the case that is part i itself at the start of the mission; None if it is interpolated."""
    if mission.parts[i].scene is None:
        return None
    return int(np.flatnonzero(mission.duty.blends[0, i])[0])


def scaled_lives(life, runs, used, x):
    """Shortest lives [h] of head and middle with all stresses x times as large, the counted ones at x = 1."""
    mission, means = life.mission, []
    for c in used:
        damages = np.array([scaled_damage(runs, key, x) for key in runs.keys_of(c)])
        means.append(places(damages, mission.settings["rivets"]).mean(axis=0))
    hours, _ = lives(part_duty(mission.duty, list(life.kept)), np.array(means))
    return float(hours[0::2].min()), float(hours[1::2].min())


def scaled_damage(runs, key, x):
    """Damage of a run's rivets [Z, 2] at x times its stress."""
    matrix, laws, own = runs.matrices[key]
    strength = runs.strengths.get(laws[0])
    plain, scaled = (damage_by(strength, laws, matrix, scale) for scale in (1.0, x))
    counted = runs.damages[key].reshape(-1)
    whole = counted.sum() / plain.sum() if plain.sum() > 0.0 else 0.0
    factor = np.where(plain > 0.0, counted / np.where(plain > 0.0, plain, 1.0), whole)
    return (scaled * factor).reshape(own.shape)


def damage_by(strength, laws, matrix, scale):
    """Miner's sum of each channel of a scaled matrix; strength: of [sn], None for the laws of the channels."""
    channel, span, mean, count = matrix
    span, mean = scale * span, scale * mean
    if strength is not None:
        return damage_of_matrix(strength, (channel, span, mean, count), len(laws))
    damage = np.zeros(len(laws))
    for law in dict.fromkeys(laws):
        mine = np.isin(channel, [c for c, own in enumerate(laws) if own == law])
        of_cycles = count[mine] * cycle_damages(law, span[mine], mean[mine])
        damage += np.bincount(channel[mine], of_cycles, minlength=len(laws))
    return damage


def largest_amplitudes(pairs):
    """Largest fully reversed amplitudes of heads and middles [Pa] in pairs (matrix, laws of the channels)."""
    largest = [0.0, 0.0]
    for (channel, span, mean, _), laws in pairs:
        for place in (0, 1):
            mine = channel % 2 == place
            amplitudes = reversed_amplitudes(laws[place], span[mine], mean[mine])
            largest[place] = max(largest[place], float(amplitudes.max(initial=0.0)))
    return tuple(largest)


def knees_of(strength, laws):
    """Lowest amplitudes at the knees of the S-N curves of heads and middles [Pa], None for a table."""
    if strength is None:
        return tuple(min(law.sigma_D for law in laws[place::2]) for place in (0, 1))
    return (None if strength.table is not None else strength.factor * strength.law.sigma_D,) * 2


def of_result(result, name, raceways):
    """Evidence of one run that is taken to go on as it did, with its Raceways."""
    if not has_statistics(result) or result.parameters.get("scene.stress") == "off":
        raise UserError(f"{name}: no stress after start.settle: a summary needs a longer run, with stress")
    if not columns(result, "rivet[", "].sigma_head"):
        raise UserError(
            f'{name}: rivet[1].sigma_head was not recorded: a summary needs it of each rivet (outputs = ["*"])'
        )
    rows = rainflow_columns(result)
    matrix = stored_cycles({key: [column] for key, column in rows.items()}, 0)
    Z = len(columns(result, "rivet[", "].sigma_head"))
    laws = [fatigue_law_at(result.parameters, k, place) for k in range(1, Z + 1) for place in CHANNELS]
    t = result.data["time"][settled(result)]
    hours = (t[-1] - t[0]) / 3600.0

    def scaled(x):
        damage = damage_by(None, laws, matrix, x)
        with np.errstate(divide="ignore"):
            life = hours / damage
        return float(life[0::2].min()), float(life[1::2].min())

    damage = damage_by(None, laws, matrix, 1.0)
    place = int(damage.argmax())
    untold = why_no_life(result)
    life = None if untold else min(scaled(1.0))
    scene = result.about.get("scene") or "run"
    return Evidence(
        life,
        None,
        None,
        place_text(place, "each"),
        "of one run: more seeds or a mission give its interval",
        scaled,
        largest_amplitudes([(matrix, laws)]),
        knees_of(None, laws),
        {scene: result},
        scene,
        place // 2 + 1,
        worse_places(damage),
        untold,
        raceways,
        of_run(result, -math.log10(life) if life and math.isfinite(life) else None),
    )


def why_no_life(result):
    """Why no life follows from a run that is taken to go on as it did; "" if one does."""
    if broken := breaks(result):
        k, place, t = broken[0]
        return f"rivet {k} broke in the {place} at {1e3 * t:.4g} ms: loads before and after are not alike"
    return "" if life_is_known(result) else "the rivets' stress rests on closed forms"
