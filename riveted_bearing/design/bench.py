"""The bench of a study: points of a box of parameters, simulated with common seeds, and the responses that it asks for.

Responses: damage (log10 of Miner's sum per hour at the worst place), stress (99.9 % quantile of the worst head [Pa]),
dislocation (largest between the halves [m]), friction (mean torque [N.m]), pocket_force (RMS [N]), or the name of any
column of a sweep's rows; static and swing part the worst head's stress (summary.static_and_swing).
"""

from dataclasses import replace
from pathlib import Path
from typing import Annotated

import numpy as np
from pydantic import Field

from ..base.errors import UserError, unknown
from ..base.schema import Count, Named, checked, holds, is_list_of
from ..base.toml_files import leaves
from ..duty.mission import curves
from ..running.basis import basis
from ..running.responses import COLUMNS, response, shown
from ..studies.rows import of_keys
from ..studies.sweep import run_sweep, schema_of
from ..studies.sweep_file import Settings, Sweep, box_of, key_of, known_names, scene_of, sections_of, settings_of

OUTPUTS = ["cage.dislocation", "bearing.friction_torque", "event.joint_open"]


class Seeded(Settings):
    """A study whose points are simulated with common seeds."""

    seeds: Annotated[int, Count()] = Field(2, description="runs of each point, the same start.seed for all points")
    seed: Annotated[int, Count()] = Field(1, description="first start.seed, and seed of the study's own choices")


class BenchFile(Seeded):
    """A study over a box."""

    between: Named = Field({}, description="[lowest, highest] by name of a parameter or input")


class Box:
    """Names of what varies with the lowest and highest SI values [d]."""

    def __init__(self, path, section, model, default=None):
        found = box_of(path, "between", dict(leaves(section, known_names(model))) or dict(default or {}), model)
        self.names, (self.low, self.high) = list(found), np.array(list(found.values())).T

    def problem(self):
        """The box as SALib has it."""
        bounds = np.column_stack([self.low, self.high]).tolist()
        return {"num_vars": len(self.names), "names": self.names, "bounds": bounds}

    def chosen(self, names):
        """The box of some of its names."""
        other = object.__new__(Box)
        places = [self.names.index(name) for name in names]
        other.names, other.low, other.high = list(names), self.low[places], self.high[places]
        return other


class Bench:
    """Simulates points of a box and returns responses; a call again for the same points reads them from the folder.

    client: function that gives the Dask client, called once something has to be simulated; progress: as of run_sweep.
    further: columns of the rows beside a sweep's, as of Sweep.
    """

    def __init__(self, path, document, model, folder, client, progress=None, further=()):
        self.path, self.document, self.model, self.folder = Path(path), document, model, Path(folder)
        self.client, self.progress = client, progress
        shared = {key: value for key, value in document.items() if key in Seeded.model_fields}
        file = checked(Seeded, shared, path)
        self.common, self.source = settings_of(file), file.scene
        self.common["simulation"] = {"outputs": OUTPUTS} | file.simulation
        self.common["parameters"] = {"scene.stress": "fatigue"} | file.parameters
        self.scene = scene_of(path, self.source, model, self.common)
        self.seeds, self.first = file.seeds, file.seed
        self.description, self.fingerprint, self.further = file.description, model.digest, further
        self.scenes, self.rows, self.known = {}, {}, set()  # rows: those read so far; known: their keys
        self.counts_damage = False
        self.label = "the scene"  # of a point without names, for messages

    def sweep(self, names, scenes):
        """The runs of scenes by key, in which the names vary."""
        about = self.path.stem, self.description, self.model, self.document
        return Sweep(*about, tuple(names), scenes, self.further, grows=True)

    def basis(self):
        """What the runs asked for so far rest on; of a damage also the S-N curve, of the scene without what varies."""
        curve = curves(self.path, {}, [self.scene], self.model) if self.counts_damage else ""
        return basis(self.model, self.scenes.values() or [self.scene], curve)

    def check(self, responses):
        """Refuse a response that the rows will not have, before anything is simulated."""
        columns = schema_of(self.sweep((), {"": self.scene})).names
        for name in responses:
            if name != "damage" and COLUMNS.get(name, name) not in columns:
                raise unknown(self.path, "response", name, ["damage", *COLUMNS, *columns])
        self.counts_damage = any(name == "damage" or ".damage_" in name for name in responses)
        return self

    def scene_at(self, names, point):
        """The scene of one point."""
        settings = {name: self.plain(name, value) for name, value in zip(names, point, strict=True)}
        return scene_of(self.path, self.source, self.model, self.common, sections_of(settings, self.model))

    def plain(self, name, value):
        """A value as the scene takes it: whole numbers for integer parameters."""
        variable = self.model.parameters.get(name)
        whole = variable is not None and variable.type == "Integer" and float(value).is_integer()
        return int(value) if whole else float(value)

    def __call__(self, names, points, responses, seeds=None):
        """Responses [n, seeds, m] of points [n, d], NaN of runs that the FMU ended; seeds: None, the study's."""
        seeds = range(self.first, self.first + self.seeds) if seeds is None else seeds
        return self.figures(names, [self.scene_at(names, point) for point in points], responses, seeds)

    def figures(self, names, scenes, responses, seeds):
        """Responses of scenes [n] in which the names vary, with each seed, [n, seeds, m]."""
        keys = []
        for scene in scenes:
            for seed in seeds:
                run = replace(scene, parameters=scene.parameters | {"start.seed": int(seed)})
                keys.append(key_of(run, self.fingerprint))
                self.scenes[keys[-1]] = run
        if missing := list(dict.fromkeys(key for key in keys if key not in self.known)):
            found = run_sweep(self.sweep(names, self.scenes), self.folder, self.client, self.progress, missing)
            self.rows = {name: np.concatenate([self.rows.get(name, x[:0]), x]) for name, x in found.items()}
            self.known.update(missing)
        rows = of_keys(self.rows, keys)
        for i in np.flatnonzero(rows["status"] == "failed"):
            point = ", ".join(f"{n} = {shown(n, rows[n][i])}" for n in names if n in rows) or self.label
            raise UserError(f"{self.path}: {point}: the run failed: {rows['message'][i]}")
        values = np.column_stack([response(self.path, rows, name) for name in responses])
        values[rows["status"] == "stopped"] = np.nan
        return values.reshape(len(scenes), len(seeds), len(responses))


DIFFERENT = f"a list of different responses is needed, such as {', '.join(['damage', *COLUMNS])}"
Responses = Annotated[
    list[str], holds(lambda names: is_list_of(names, str) and len(set(names)) == len(names) > 0, DIFFERENT)
]


def noise_variance(values):
    """Variance that the seeds leave in a point's mean [m], of values [n, seeds, m]; nan with one seed."""
    if values.shape[1] < 2:
        return np.full(values.shape[2], np.nan)
    return values.var(axis=1, ddof=1).mean(axis=0) / values.shape[1]
