"""The life of a mission: runs on a cluster round by round, points left out by a bound, runs.parquet and life.json."""

import json
import math
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from bearing_model.generated.variables import INPUTS

from ..base.errors import UserError
from ..base.files import write_json
from ..bearing.strength import Strength, damage_of_cycles, damage_of_matrix, read_strength
from ..running.accuracy import Sample, finer_settings, steps_of, with_settings
from ..running.rainflow import fatigue_law, fatigue_law_at
from ..running.seeds import started
from ..studies.sweep import run_sweep
from ..studies.sweep_file import Sweep, key_of
from .confidence import Estimate, until_sure
from .cycles import BLOCK_COLUMNS, outputs_of, rainflow_columns, rainflow_fields, stored_cycles
from .miner import Duty, part_rates
from .mission import Mission
from .raceways import finite
from .raceways import record as raceway_record

PLACES = ("head", "mid")
SAFETY = 10.0  # of the bound on the damage of points that are not simulated
SPEED_SQUARED = ("shaft.omega",)  # centrifugal loads
RECORD = "life.json"
PAIRS = 3  # finer runs of the case that decides
FIGURES_KEPT = ("stat.sigma_head_p999", "rivet.table_kind", "solver.steps", "solver.error_tests_failed")


@dataclass(frozen=True)
class Life:
    """estimate of the parts kept; kept: numbers; bounds: of the damage per hour of those left out; counts: runs of each part;
    samples: their damages [n, Z, 2] or None; rates: means at the start, per hour or per event [I, Z, 2].
    """

    mission: Mission
    estimate: Estimate
    kept: tuple
    bounds: dict
    counts: tuple
    samples: tuple = field(repr=False)
    rates: np.ndarray = field(repr=False)
    budgets: dict = field(default_factory=dict, repr=False, compare=False)  # error budgets, by figure (life_budget.py)

    @property
    def place(self):
        """What fails first, in words."""
        return place_text(self.estimate.place, self.mission.settings["rivets"])

    @property
    def low(self):
        """Lower end of the interval [h], with the damage of the points left out at its bound."""
        return 1.0 / (1.0 / self.estimate.low + sum(self.bounds.values()))


class Runs:
    """The runs of a mission in a folder: damages by case and seed, simulated when they are asked for."""

    def __init__(self, mission, model, folder, client, progress=None):
        """client: function that gives the Dask client, called when it is needed; progress: as of run_sweep."""
        self.mission, self.folder, self.client, self.progress = mission, folder, client, progress
        self.model, self.keys, scenes = model, {}, {}
        outputs = outputs_of(model)
        for c, case in enumerate(mission.cases):
            for s in range(mission.settings["max_seeds"]):
                scene = started(replace(case.scene, outputs=outputs), model, mission.settings["seed"], s)
                self.keys[c, s] = key_of(scene, model.digest)
                scenes[self.keys[c, s]] = scene
        about = mission.name, mission.description, model, mission.document
        self.sweep = Sweep(*about, ("start.seed",), scenes, (rainflow_columns, rainflow_fields))
        self.strengths, self.damages, self.matrices, self.cost, self.figures = {}, {}, {}, {}, {}
        self.per = {}  # of each run: what makes its damage one per hour of a point, or per event

    def __call__(self, counts):
        """Damages [n, Z, 2] of the first counts[c] runs of each case that has some, per hour or per event."""
        self.simulate({(c, s): self.keys[c, s] for c, n in enumerate(counts) for s in range(n)})
        return [np.array([self.damages[self.keys[c, s]] for s in range(n)]) for c, n in enumerate(counts)]

    def finer(self, c):
        """Keys of the finer runs of case c, on its first seeds."""

        def found(key):
            return Sample({}, {}, self.cost[key], *steps_of(self.figures[key]))

        scene, plain = self.mission.cases[c].scene, found(self.keys[c, 0])
        settings, _ = finer_settings(self.model, scene, plain, lambda settings: found(self.at(c, settings)[0]))
        return self.at(c, settings)

    def at(self, c, settings):
        """Keys of the runs of case c on its first seeds with other steps, which are done if need be."""
        keys = {}
        for s in range(min(PAIRS, self.mission.settings["max_seeds"])):
            scene = with_settings(self.sweep.scenes[self.keys[c, s]], settings)
            keys[c, s] = key_of(scene, self.model.digest)
            self.sweep.scenes[keys[c, s]] = scene
        self.simulate(keys)
        return list(keys.values())

    def simulate(self, wanted):
        """Do the runs that are missing of the keys wanted[case, seed], and read their damages."""
        if self.damages.keys() >= set(wanted.values()):
            return
        rows = run_sweep(self.sweep, self.folder, self.client, self.progress, list(wanted.values()))
        for i, ((c, s), key) in enumerate(wanted.items()):
            if key not in self.damages:
                self.take(c, s, key, rows, i)

    def keys_of(self, c):
        """Keys of the runs of case c that were asked for."""
        keys = (self.keys[c, s] for s in range(self.mission.settings["max_seeds"]))
        return [key for key in keys if key in self.damages]

    def take(self, c, s, key, rows, i):
        """Read the damage of one run, row i."""
        part = self.mission.parts[self.mission.cases[c].part]
        where = f"{self.mission.path}: {'event' if part.event else 'point'} {part.name}, seed {self.mission.settings['seed'] + s}"
        if rows["status"][i] != "done":
            raise UserError(f"{where}: the run {rows['status'][i]}: {rows['message'][i]}")
        if rows["rivet.table_kind"][i] == 3.0:
            raise UserError(
                f"{where}: the rivets' stress rests on closed forms, which are no base of a life: build --table coarse makes finite elements"
            )
        rivets = range(1, 1 + sum(name.startswith("rivet[") and name.endswith("].damage_head") for name in rows))
        own = np.array([[rows[f"rivet[{k}].damage_{place}"][i] for place in PLACES] for k in rivets])
        law = fatigue_law({name: rows[name][i] for name in rows if name.startswith("fatigue.")})
        matrix = stored_cycles(rows, i)
        damage = own
        if "sn" in self.mission.document:
            if law.fretting != 1.0:
                raise UserError(
                    f"{where}: fatigue.fretting = {law.fretting:g}: with a section [sn], whose curve is for all places, only 1 is allowed"
                )
            if law not in self.strengths:
                self.strengths[law] = read_strength(self.mission.path, self.mission.document["sn"], law)
            damage = damage_of_matrix(self.strengths[law], matrix, own.size).reshape(own.shape)
        seconds = rows["simulated_time"][i] - rows["start.settle"][i]
        self.per[key] = 1.0 if part.event else 3600.0 / seconds
        self.damages[key] = damage * self.per[key]
        laws = [fatigue_law_at({n: rows[n][i] for n in rows}, 1 + c // 2, PLACES[c % 2]) for c in range(own.size)]
        self.matrices[key] = (matrix, laws, own)
        self.cost[key] = float(rows["whole_cpu_time"][i])
        self.figures[key] = {name: float(rows[name][i]) for name in (*FIGURES_KEPT, *BLOCK_COLUMNS) if name in rows}

    def counted(self):
        """Damage of all matrices over the FMU's own count at each run's worst place, weighted by the mission."""
        found, own = 0.0, 0.0
        for c, case in enumerate(self.mission.cases):
            keys = self.keys_of(c)
            for key in keys:
                weight = self.mission.duty.weights[case.part] * self.per[key] / len(keys)
                of_matrix, of_fmu = damages_counted(*self.matrices[key])
                found, own = found + weight * of_matrix, own + weight * of_fmu
        return found / own if own > 0.0 else 1.0


def damages_counted(matrix, laws, own):
    """Damage of a run's matrix and the FMU's own count at the place with the most damage."""
    channel = own.argmax()
    chosen = matrix[0] == channel
    cycles = (column[chosen] for column in matrix[1:])
    return damage_of_cycles(Strength(laws[channel]), *cycles).sum(), own.max()


def place_text(place, rivets):
    """A place that can fail in words: a rivet's head or middle, or, if all rivets take all places in turn, all of them."""
    k, end = divmod(place, 2)
    where = ("head", "middle")[end]
    return f"rivet {k + 1}, {where}" if rivets == "each" else f"{where}s of the rivets"


def assess(mission: Mission, runs: Runs, progress: Any = lambda found, target: None) -> Life:
    """The Life of a mission from runs(counts), damages [n, Z, 2] of each case; points that cannot matter are left out."""
    settings, duty = mission.settings, mission.duty
    target = math.log1p(settings["half_width"])
    rare = rare_parts(mission)
    kept = [i for i in range(len(mission.parts)) if i not in rare]
    found, samples, counts = solve(duty, kept, runs, settings, lambda found: progress(found, target))
    bounds = bounded(mission, found, kept, rare)
    if len(bounds) < len(rare):
        kept = [i for i in range(len(mission.parts)) if i not in bounds]
        found, samples, counts = solve(duty, kept, runs, settings, lambda found: progress(found, target))
    used = used_cases(duty, kept).tolist()
    means = np.array([damages.mean(axis=0) for damages in samples])
    rates = np.zeros((len(mission.parts), *means.shape[1:]))
    at_start = part_rates(part_duty(duty, kept), means.reshape(len(means), -1))[0]
    rates[kept] = at_start.reshape(len(kept), *means.shape[1:])
    simulated = [duty.blends[:, i].any(axis=0) & (part.scene is not None) for i, part in enumerate(mission.parts)]
    own = [[used.index(c) for c in np.flatnonzero(cases).tolist() if c in used] for cases in simulated]
    runs_of = tuple(int(sum(counts[place] for place in places)) for places in own)
    damages_of = tuple(samples[places[0]] if places else None for places in own)
    return Life(mission, found, tuple(kept), bounds, runs_of, damages_of, rates)


def used_cases(duty, kept):
    """Numbers of the cases on which the parts kept rest."""
    return np.flatnonzero(duty.blends[:, kept].any(axis=(0, 1)))


def part_duty(duty, kept):
    """The Duty of the parts kept alone."""
    used = used_cases(duty, kept)
    slopes = duty.slopes
    if slopes is not None:
        slopes = slopes[:, :, kept]
        alone = np.delete(slopes, used, axis=-1).any(axis=-1)  # one of the neighbours is left out
        slopes = np.where(alone[..., None], 0.0, slopes[..., used])
    return Duty(duty.weights[kept], duty.blends[:, kept][:, :, used], duty.hours, slopes)


def solve(duty, kept, runs, settings, progress):
    """until_sure() for the parts kept: (Estimate, damages [n, Z, 2] of the cases used, numbers of their runs)."""
    used, part, whole = used_cases(duty, kept), part_duty(duty, kept), {}

    def run(counts):
        asked = np.zeros(duty.blends.shape[2], int)
        asked[used] = counts
        whole["samples"] = [damages for c, damages in enumerate(runs(asked)) if c in used]
        return [places(damages, settings["rivets"]) for damages in whole["samples"]]

    found, _, counts = until_sure(part, run, settings, settings["max_seeds"], progress)
    return found, whole["samples"], counts


def places(damages, rivets):
    """Damages [n, K] at the places that can fail: each head and middle, or their means if rivets change places."""
    return damages.reshape(len(damages), -1) if rivets == "each" else damages.mean(axis=1)


# Points that cannot matter --------------------------------------------------------------------------------------------


def rare_parts(mission):
    """Numbers of the rarest points, together less than the share `skip` of the hours, on which no interpolation rests."""
    needed = {
        mission.cases[c].part
        for i, part in enumerate(mission.parts)
        if part.scene is None
        for c in np.flatnonzero(mission.duty.blends[:, i].any(axis=0))
    }
    free = [i for i, part in enumerate(mission.parts) if not part.event and part.scene is not None and i not in needed]
    rare, left = [], mission.settings["skip"] * mission.hours
    for i in sorted(free, key=lambda i: mission.parts[i].weight):
        left -= mission.parts[i].weight
        if left < 0.0:
            break
        rare.append(i)
    return rare if len(rare) < len(mission.parts) else []


def bounded(mission, found, kept, rare):
    """Bounds of the damage per hour of rare points that together cannot have more than the share `skip` of it.

    By the ratio of loads and of squared speeds to any simulated point, to the steeper slope of the S-N curve, times 10: stress
    changes no faster.  Less load may do more damage, as balls skid, so the largest bound by all simulated points counts.
    """
    duty, total = mission.duty, 1.0 / found.life if found.life > 0.0 else math.inf
    rate_of = dict(zip(kept, found.shares * total / np.maximum(duty.weights[list(kept)], 1e-300), strict=True))
    comparable = {i: [b for q in kept if math.isfinite(b := bound(mission, rate_of[q], q, i))] for i in rare}
    bounds = {i: duty.weights[i] * max(comparable[i], default=math.inf) for i in rare}
    chosen, left = {}, mission.settings["skip"] * total
    for i in sorted(bounds, key=bounds.get):
        left -= bounds[i]
        if left < 0.0:
            break
        chosen[i] = bounds[i]
    return chosen


def bound(mission, rate, q, i):
    """Bound of the damage per hour of point i by that of point q; infinite if they differ in more than loads and speed."""
    known, rare = mission.parts[q], mission.parts[i]
    alike = known.factor == rare.factor and known.values.keys() == rare.values.keys()
    if known.event or not alike or mission.duty.weights[q] == 0.0:
        return math.inf
    ratio = 1.0
    for name, value in rare.values.items():
        if value == known.values[name] and value is not None:
            continue
        if known.scene is None or name not in INPUTS or value is None or not known.values[name]:
            return math.inf
        change = abs(value / known.values[name])
        ratio *= max(change, 1.0 / change if change else math.inf) ** (2.0 if name in SPEED_SQUARED else 1.0)
    slope = max(known.values.get(f"fatigue.{k}", default) for k, default in (("k_1", 8.0), ("k_2", 15.0)))
    return SAFETY * rate * ratio**slope


# What is written ------------------------------------------------------------------------------------------------------


def record(life):
    """life.json's content; None where nothing is known (a point left out) or never (no damage)."""
    mission, found = life.mission, life.estimate
    share = dict(zip(life.kept, found.shares, strict=True))
    k, place = divmod(found.place, 2) if mission.settings["rivets"] == "each" else (slice(None), found.place)
    rivets = np.einsum("i,ikp->kp", mission.duty.weights, life.rates)
    return {
        "fmu": mission.fmu,
        "fmu_sha256": mission.fmu_sha256,
        "basis": dict(mission.basis),
        "life_h": finite(found.life),
        "low_h": finite(life.low),
        "high_h": finite(found.high),
        "confidence": mission.settings["confidence"],
        "error_budget": {figure: budget.record() for figure, budget in life.budgets.items()},
        "raceways": raceway_record(mission.raceways()),
        "points": [
            {
                "share": float(share.get(i, 0.0)),
                "damage_per_h": None if i in life.bounds else float(np.mean(life.rates[i, k, place])),
                "seeds": life.counts[i],
            }
            for i, part in enumerate(mission.parts)
            if not part.event
        ],
        "rivets": [{"head_per_h": float(head), "middle_per_h": float(middle)} for head, middle in rivets],
    }


def check_folder(folder: Path, mission: Mission, remedy: Any) -> None:
    """UserError if a folder has the life of another FMU, whose pages and runs would be replaced in part."""
    if is_of_another(folder, mission):
        other = read_record(folder)["fmu"]
        raise UserError(f"{folder}: has the life of another FMU, {other}, not of {mission.fmu}: {remedy}")


def is_of_another(folder: Path, mission: Mission) -> bool:
    """Whether life.json of a folder is of the FMU of another file; one that was built again at its place is no other one."""
    known = read_record(folder)
    return "fmu" in known and known["fmu"] != mission.fmu and known["fmu_sha256"] != mission.fmu_sha256


def is_current(life: Life, folder: Path) -> bool:
    """Whether life.json of a folder is this Life's."""
    return read_record(folder) == json.loads(json.dumps(record(life)))


def read_record(folder):
    """The content of a folder's life.json, empty if there is none."""
    try:
        return json.loads((folder / RECORD).read_text(encoding="utf-8"))
    except (FileNotFoundError, ValueError):
        return {}


def write_record(life: Life, folder: Path) -> Path:
    """Write life.json, whole or not at all; returns its path."""
    return write_json(folder / RECORD, record(life))
