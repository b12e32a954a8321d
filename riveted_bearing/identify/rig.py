"""The runs of an identification: all operating points at given parameter values, on a Dask cluster, each run once."""

import functools
import hashlib
from dataclasses import replace

import numpy as np

from ..base.errors import UserError, unknown
from ..base.toml_files import section_of
from ..running.basis import basis
from ..running.responses import response
from ..running.scene import load_scene
from ..studies.sweep import run_sweep, schema_of
from ..studies.sweep_file import Sweep, beside, key_of, sections_of
from .measures import of_result


class Rig:
    """Simulates points of a Study and returns its targets' figures; a call again for the same points reads them from
    the folder.

    client: function that gives the Dask client, called once something has to be simulated; progress: as of run_sweep.
    """

    def __init__(self, study, document, model, folder, client, progress=None):
        self.study, self.document, self.model, self.folder = study, document, model, folder
        self.client, self.progress = client, progress
        path = study.path
        common = {section: section_of(path, document, section) for section in ("simulation", "parameters", "inputs")}
        outputs = list(study.outputs or ["bearing.friction_torque"])
        common["simulation"] = common["simulation"] | {"outputs": outputs}
        if any(target.column == "damage" or ".damage_" in target.column for target in study.targets):
            common["parameters"] = {"scene.stress": "fatigue"} | common["parameters"]
        self.common, self.source = common, beside(path, document.get("scene"))
        self.fmu = model.path.read_bytes()
        words = ", ".join(measure.column for measure in study.measures)
        self.fingerprint = hashlib.sha256(self.fmu + words.encode()).hexdigest()
        self.scenes = {}
        self.needed = sorted({k for t in study.targets for k in (t.point, *([t.other] if t.operation else []))})
        self.check()

    def check(self):
        """Refuse a column that the rows will not have, before anything is simulated."""
        columns = schema_of(self.sweep({"": self.scene_at((), (), self.needed[0])})).names
        for target in self.study.targets:
            if target.column != "damage" and target.column not in columns:
                raise unknown(f"{self.study.path}: target {target.name}", "measure", target.column, columns)

    def fields(self):
        """Fields of the measures, beside those of a sweep's rows."""
        import pyarrow as pa

        return [pa.field(measure.column, pa.float64()) for measure in self.study.measures]

    def sweep(self, scenes):
        """The runs of scenes by key."""
        further = (functools.partial(of_result, self.study.measures), self.fields) if self.study.measures else ()
        name, about = self.study.path.stem, self.study.description
        return Sweep(name, about, self.model, self.fmu, self.document, tuple(self.study.names), scenes, further, True)

    def scene_at(self, names, values, point=None):
        """The scene of an operating point, or before its changes, with parameter values."""
        path, changes = self.study.path, {} if point is None else self.study.points[point][1]
        settings = sections_of({name: float(value) for name, value in zip(names, values, strict=True)}, self.model)
        base = (str(path), self.common), (str(path), changes)
        outputs = {"simulation": {"outputs": self.common["simulation"]["outputs"]}}
        return load_scene(self.source, self.model, *base, (str(path), settings), (str(path), outputs))

    def start(self):
        """Values of the parameters in the scene itself, [d]."""
        scene = self.scene_at((), (), self.needed[0])
        return np.array([float(scene.value(name, self.model)) for name in self.study.names])

    def basis(self):
        """Lines on which the runs rest."""
        return basis(self.model, self.scenes.values() or [self.scene_at((), (), k) for k in self.needed])

    def __call__(self, points, seeds):
        """Figures of the targets at parameter values [n, d] with each seed, [n, seeds, targets]; nan where the FMU
        stopped.
        """
        keys = []
        for values in points:
            for k in self.needed:
                scene = self.scene_at(self.study.names, values, k)
                for seed in seeds:
                    run = replace(scene, parameters=scene.parameters | {"start.seed": int(seed)})
                    keys.append(key_of(run, self.fingerprint))
                    self.scenes[keys[-1]] = run
        rows = run_sweep(self.sweep(self.scenes), self.folder, self.client, self.progress, keys)
        for why in rows["message"][rows["status"] == "failed"]:
            raise UserError(f"{self.study.path}: a run failed: {why}")
        figures = {}
        for column in {target.column for target in self.study.targets}:
            values = np.where(rows["status"] == "stopped", np.nan, response(self.study.path, rows, column))
            figures[column] = values.reshape(len(points), len(self.needed), len(seeds))
        return np.stack(
            [figure_of(target, figures[target.column], self.needed) for target in self.study.targets], axis=-1
        )


def figure_of(target, values, needed):
    """A target's figure [n, seeds] from its column [n, operating points, seeds]."""
    own = values[:, needed.index(target.point)]
    if not target.operation:
        return own
    other = values[:, needed.index(target.other)]
    return own / other if target.operation == "over" else own - other
