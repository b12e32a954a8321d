"""The pool of a bearing: designs of each cause, in each of which rivet after rivet breaks in one simulation.

A worker runs the whole cage over a window of turns, reads the damage rates of all heads and middles, and takes out the
rivet whose place is the first to reach Miner's sum 1 (rivet[k].intact = 0).  The same simulation goes on: a few turns
to settle, another window, the next break.  Damage adds up over the states.  No damage is accelerated, because after the
first break lives of 1,000 h and 1 h stand side by side, which no single factor shows.

Each place of each design has its own strength, from a normal distribution of its logarithm with SCATTER, that of rivets
of one lot.  A strength s multiplies a damage rate by s^-k; k is the slope of the S-N curve at the amplitude that would do
the same damage with one cycle a turn.
"""

import json
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from typing import Any

import numpy as np
from fmpy.fmi1 import FMICallException

from ..base.errors import UserError
from ..running.fmu import Instance, Model
from ..running.scene import Scene
from ..studies.sweep import run_sweep, unpacked
from ..studies.sweep_file import Sweep, key_of, scene_of, sections_of, settings_of
from .candidates import OWN, designs
from .findings import Study
from .order import next_break

SETTLE, WINDOW, SETTLE_AGAIN, WINDOW_AGAIN = 9.0, 21.0, 3.0, 9.0  # turns of the shaft
SCATTER = np.log(1.25) / 2.563  # of the logarithm of a rivet's strength: 90 % over 10 % is 1.25, FKM
CURVE = ("fatigue.N_D", "fatigue.k_1", "fatigue.k_2")
ACCELERATED = ("scene.breakage", "fatigue.acceleration")  # of a mission: rivets are taken out here, at true rates
MEANS = {"loss.pockets": "pocket", "loss.land": "land"}  # outputs whose mean stands for a mark
RESPONSES = ("pocket", "side", "land", "face")


@dataclass(frozen=True)
class Followed(Scene):
    """A scene in which a worker takes out rivets; vars() is the key of its run."""

    breaks: int = 4
    turn: float = 0.0  # s
    strengths: tuple = ()  # of the places, [Z][head, middle]


def followed(scene: Scene, model: Model, breaks: int, strengths: Any) -> Followed:
    """The Followed of a scene: its times in turns of its own shaft."""
    omega = scene.value("shaft.omega", model)
    if not abs(omega) > 0.0:
        raise UserError(f"{scene.name}: shaft.omega = 0: nothing breaks at rest")
    for name, history in scene.inputs.items():
        if history.changing_time():
            raise UserError(f"{scene.name}: {name} varies in time: give the point of the mission that does the damage")
    if scene.changes:
        raise UserError(f"{scene.name}: change: parameters that change in the run are not for causes")
    turn = 2.0 * np.pi / abs(omega)
    settle = np.ceil(SETTLE * turn / scene.step) * scene.step
    t_end = settle + (WINDOW + breaks * (SETTLE_AGAIN + WINDOW_AGAIN) + 1.0) * turn
    kept = {name: value for name, value in scene.parameters.items() if name not in ACCELERATED}
    forced = {"start.settle": float(settle), "scene.stress": "fatigue", "scene.statistics": "off"}
    values = vars(scene) | {"t_end": float(t_end), "parameters": kept | forced, "outputs": ()}
    return Followed(**values, breaks=breaks, turn=turn, strengths=strengths)


def weakened(rates, strengths, curve, turns):
    """Damage rates per hour of places with so much strength; curve: N_D, k_1, k_2; turns: of the shaft in an hour."""
    N_D, k_1, k_2 = curve
    damage = np.maximum(rates, 0.0) * N_D / turns  # of a cycle a turn, over that at the knee
    amplitude = np.where(damage > 1.0, damage ** (1.0 / k_1), damage ** (1.0 / k_2)) / strengths
    return np.where(amplitude > 1.0, amplitude**k_1, amplitude**k_2) * turns / N_D


def perform_history(scene, fmu, _=None):
    """Run a Followed through the FMU given as bytes; returns the measured part of the row."""
    about = {"date": datetime.now(UTC).isoformat(timespec="milliseconds"), "message": ""}
    try:
        return about | {"status": "done", "history": json.dumps(history_of(unpacked(fmu), scene))}
    except UserError as problem:
        return about | {"status": "failed", "message": str(problem)}


def history_of(model: Model, scene: Followed) -> dict[str, Any]:
    """States with who is gone, rates [Z][2] per hour and the next break; responses; end: why none follows."""
    with Instance(model) as instance:
        instance.initialize(scene)
        cage = Cage(instance, scene)
        found: dict[str, Any] = {"states": [], "end": "as many as asked for"}
        damage = np.zeros((cage.Z, 2))
        damage[[k - 1 for k in cage.gone]] = -np.inf
        try:
            cage.run(scene.parameters["start.settle"] / scene.turn)
            while len(found["states"]) < scene.breaks and len(cage.gone) < cage.Z:
                if found["states"]:
                    cage.run(SETTLE_AGAIN)
                    rates = cage.rates(WINDOW_AGAIN)
                else:
                    rates = cage.rates(WINDOW)
                    found |= cage.responses()
                effective = weakened(rates, cage.strengths, cage.curve, 3600.0 / scene.turn)
                hours, first = next_break(damage, effective)
                row = {"gone": list(cage.gone), "rates": rates.tolist()}
                if not np.isfinite(hours):
                    found["states"].append(row | {"hours": None})
                    found["end"] = "nothing is damaged"
                    break
                found["states"].append(row | {"hours": float(hours), "rivet": first[0] + 1, "place": first[1]})
                damage = damage + hours * effective
                damage[first[0]] = -np.inf
                cage.take_out(first[0] + 1)
        except FMICallException:
            found["end"] = f"the halves part: {instance.complaints()}"
        return found


class Cage:
    """An instance that runs turn by turn: gone, numbers of the rivets that are gone; curve: of CURVE."""

    def __init__(self, instance, scene):
        self.instance, self.scene, self.steps, self.seen = instance, scene, 0, []
        model = instance.model
        self.Z = model.Z
        numbers = range(1, self.Z + 1)
        self.gone = [k for k in numbers if scene.parameters.get(f"rivet[{k}].intact", 1) == 0]
        self.strengths = np.array(scene.strengths) if len(scene.strengths) else np.ones((self.Z, 2))
        self.curve = [float(scene.value(name, model)) for name in CURVE]
        self.damage = instance.reader([f"rivet[{k}].damage_{place}" for k in numbers for place in ("head", "mid")])
        sides = [name for name in model.outputs if name.endswith("].Q_cx")]
        self.watched = instance.reader([*MEANS, "cage.dislocation", *sides])
        self.lost = instance.reader([f"rivet[{k}].preload_loss" for k in numbers])

    def run(self, turns):
        """So many turns of the shaft in communication steps; returns the hours that they take."""
        step, count = self.scene.step, round(turns * self.scene.turn / self.scene.step)
        for _ in range(count):
            self.instance.fmu.doStep(self.steps * step, step)
            self.steps += 1
            self.seen.append(self.watched().copy())
        return count * step / 3600.0

    def rates(self, turns):
        """Damage rates per hour of a window."""
        before, lost = self.damage().copy(), self.lost().mean()
        self.seen.clear()
        hours = self.run(turns)
        self.loss = (self.lost().mean() - lost) / hours
        return ((self.damage() - before) / hours).reshape(self.Z, 2)

    def responses(self):
        """Means over the last window by the mark that they stand for, and the mean loss of preload per hour [N/h]."""
        sizes = np.abs(self.seen).mean(axis=0)
        marks = dict(zip([*MEANS.values(), "face"], sizes.tolist(), strict=False))
        return marks | {"side": float(sizes[len(MEANS) + 1 :].mean()), "preload_loss": float(self.loss)}

    def take_out(self, k):
        """Rivet k is gone from now on."""
        self.instance.set_parameter(self.instance.model.parameters[f"rivet[{k}].intact"], 0)
        self.gone.append(k)


@dataclass(frozen=True)
class Sample:
    """A design of a cause with its history; number: of the design in its cause; strengths: of the places, [Z, 2]."""

    cause: int
    number: int
    design: dict
    history: dict
    strengths: np.ndarray


def mission_scene(path: Any, document: dict[str, Any], model: Model) -> Scene:
    """The Scene of a file of findings, without findings."""
    common = {key: document.get(key, {}) for key in ("parameters", "inputs", "simulation")}
    return scene_of(path, document.get("scene"), model, common)


def sampled(study: Study, model: Model, document: Any, count: int | None = None, seed: int | None = None) -> list[Any]:
    """(number of the cause, number of the design, design, strengths, Followed) of all designs; count, seed: those of the file by default."""
    file, found = study.file, []
    seed = file.seed if seed is None else seed
    for number, cause in enumerate(study.causes):
        for i, design in enumerate(designs(cause, count or file.samples, seed, model)):
            rng = np.random.default_rng([seed, i])
            strengths = design.get("model.strength", 1.0) * np.exp(SCATTER * rng.standard_normal((study.Z, 2)))
            strengths[0, 0] *= design.get("model.weak", 1.0)
            strengths[:, 0] *= min(1.0, design.get("model.formed", 1.0))
            settings = {name: value for name, value in design.items() if name not in OWN}
            settings["start.seed"] = int(rng.integers(1, 2**31))
            scene = scene_of(study.path, file.scene, model, settings_of(file), sections_of(settings, model))
            scene = replace(followed(scene, model, file.breaks, strengths.tolist()), name=cause.name)
            found.append((number, i, design, strengths, scene))
    return found


def run_pool(
    study: Study, model: Model, document: Any, folder: Any, client: Any, progress: Any = None, **of: Any
) -> list[Sample]:
    """The Samples of a study; those of an earlier call are read from the folder."""
    planned = sampled(study, model, document, **of)
    keys = [key_of(scene, model.digest) for *_, scene in planned]
    scenes = {key: scene for key, (*_, scene) in zip(keys, planned, strict=True)}
    about = study.path.stem, study.file.description, model, document
    sweep = Sweep(*about, (), scenes, (None, history_field), grows=True, perform=perform_history)
    rows = run_sweep(sweep, folder, client, progress, keys)
    samples = []
    for row, (cause, number, design, strengths, _) in enumerate(planned):
        history = json.loads(str(rows["history"][row])) if rows["status"][row] == "done" else {"states": []}
        if history["states"]:
            samples.append(Sample(cause, number, design, history, strengths))
    check_starts(study, planned, samples, rows)
    return samples


def check_starts(study, planned, samples, rows):
    """UserError for a cause most of whose designs do not start or stop at once; the few of others are left out."""
    for number, cause in enumerate(study.causes):
        started = sum(sample.cause == number for sample in samples)
        if 2 * started < sum(plan[0] == number for plan in planned):
            failed = rows["message"][(rows["scene"] == cause.name) & (rows["status"] == "failed")]
            why = next(iter(failed), "they stop at once")
            raise UserError(f"{study.path}: cause {cause.name}: most designs do not run: {why}")


def history_field():
    """Field of the rows."""
    import pyarrow as pa

    return [pa.field("history", pa.string())]
