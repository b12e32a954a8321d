"""The runs of an identification: all operating points at given parameter values, on a Dask cluster, each run once."""

import functools
import hashlib

import numpy as np

from ..base.errors import unknown
from ..base.toml_files import section_of
from ..design.bench import Bench
from ..running.basis import basis
from ..studies.sweep import schema_of
from ..studies.sweep_file import scene_of, sections_of
from .measures import of_result


class Rig(Bench):
    """A Bench whose points are parameter values of a Study at all its operating points, and whose figures its targets'."""

    def __init__(self, study, document, model, folder, client, progress=None):
        self.study = study
        further = (functools.partial(of_result, study.measures), self.fields) if study.measures else ()
        super().__init__(study.path, document, model, folder, client, progress, further)
        self.common["simulation"] |= {"outputs": list(study.outputs or ["bearing.friction_torque"])}
        if not any(target.column == "damage" or ".damage_" in target.column for target in study.targets):
            self.common["parameters"] = section_of(study.path, document, "parameters")
        words = ", ".join(measure.column for measure in study.measures)
        self.fingerprint = hashlib.sha256(model.content + words.encode()).hexdigest()
        self.needed = sorted({k for t in study.targets for k in (t.point, *([t.other] if t.operation else []))})
        self.columns = list(dict.fromkeys(target.column for target in study.targets))
        self.label, self.scene = "a point", self.scene_at((), (), self.needed[0])
        self.check()

    def check(self):
        """Refuse a column that the rows will not have, before anything is simulated."""
        columns = schema_of(self.sweep((), {"": self.scene})).names
        for target in self.study.targets:
            if target.column != "damage" and target.column not in columns:
                raise unknown(f"{self.path}: target {target.name}", "measure", target.column, columns)

    def fields(self):
        """Fields of the measures, beside those of a sweep's rows."""
        import pyarrow as pa

        return [pa.field(measure.column, pa.float64()) for measure in self.study.measures]

    def scene_at(self, names, values, point=None):
        """The scene of an operating point, or before its changes, with parameter values."""
        changes = {} if point is None else self.study.points[point][1]
        settings = sections_of({name: float(value) for name, value in zip(names, values, strict=True)}, self.model)
        outputs = {"simulation": {"outputs": self.common["simulation"]["outputs"]}}
        return scene_of(self.path, self.source, self.model, self.common, changes, settings, outputs)

    def start(self):
        """Values of the parameters in the scene itself, [d]."""
        return np.array([float(self.scene.value(name, self.model)) for name in self.study.names])

    def basis(self):
        """Lines on which the runs rest."""
        return basis(self.model, self.scenes.values() or [self.scene_at((), (), k) for k in self.needed])

    def __call__(self, points, seeds):
        """Figures [n, seeds, targets] at parameter values [n, d] with each seed; nan where the FMU stopped."""
        scenes = [self.scene_at(self.study.names, values, k) for values in points for k in self.needed]
        values = self.figures(self.study.names, scenes, self.columns, seeds)
        values = values.reshape(len(points), len(self.needed), len(seeds), len(self.columns))
        by_column = dict(zip(self.columns, np.moveaxis(values, -1, 0), strict=True))
        return np.stack([figure_of(t, by_column[t.column], self.needed) for t in self.study.targets], axis=-1)


def figure_of(target, values, needed):
    """A target's figure [n, seeds] from its column [n, operating points, seeds]."""
    own = values[:, needed.index(target.point)]
    if not target.operation:
        return own
    other = values[:, needed.index(target.other)]
    return own / other if target.operation == "over" else own - other
