"""Labelled signals: the runs of a design with their vibration, as a Parquet dataset to train on; docs/surfaces.md.

A row holds what a sweep's row holds and further the labels (label.fault: none, outer, inner, both, ball, or names with +;
label.length, width and depth of the longest spall; label.waviness, the largest amplitude), the kinematic frequencies of the
computed speeds, and for each channel a list of single-precision samples from start.settle on, signal.rate apart.
"""

import math
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
from pydantic import Field

from ..base.errors import UserError, unknown
from ..base.schema import Section, Texts, checked
from ..base.toml_files import read_toml, section_of
from ..running.fmu import Model
from ..running.summary import settled
from ..show.spectrum import SPEEDS, kinematic_frequencies, speed_of
from .sweep_file import Sweep, SweepFile, plan_sweep

RACES = ("outer", "inner")
SIZES = ("length", "width", "depth")
FREQUENCIES = ("shaft", "FTF", "BSF", "BPFO", "BPFI")


class Channels(Section):
    """The signals of a dataset."""

    channels: Texts = Field(["housing.a_y"], description="outputs to keep")


class DatasetFile(SweepFile):
    """A data set to train on: a sweep whose rows have signals and labels."""

    dataset: Channels = Channels()


def load_dataset(path: str | Path, model: Model) -> Sweep:
    """The Sweep of a dataset's TOML file, whose rows have labels and signals; UserError naming file, key and value."""
    path = Path(path)
    document = read_toml(path, "dataset file")
    section = checked(Channels, section_of(path, document, "dataset"), path, "dataset")
    for name in section.channels:
        if name not in model.outputs:
            raise unknown(path, "channel", name, list(model.outputs))
    channels = tuple(dict.fromkeys(section.channels))
    document = {key: value for key, value in document.items() if key != "dataset"}
    simulation = section_of(path, document, "simulation")
    if "outputs" in simulation:
        raise UserError(f"{path}: simulation.outputs: [dataset] channels names the outputs of a dataset")
    recorded = [*dict.fromkeys([*channels, *SPEEDS])]
    document["simulation"] = simulation | {"outputs": recorded}
    plan = plan_sweep(path.stem, document, model, path)
    for scene in plan.scenes.values():
        settle = scene.value("start.settle", model)
        if scene.t_end <= settle:
            raise UserError(
                f"{path}: simulation.t_end = {scene.t_end:g} s: more than start.settle = {settle:g} s is allowed"
            )
    units = {name: model.outputs[name].unit or "1" for name in channels}
    return replace(plan, further=(partial(measured, channels), partial(fields, units)))


def measured(channels, result):
    """Labels and signals of a run's Result by column; a worker calls it."""
    rows = settled(result)
    t = result.data["time"][rows]
    speeds = {name: speed_of(result, name, rows) for name in SPEEDS}
    frequencies = kinematic_frequencies(result, speeds, orders=False)
    return (
        labels(result.parameters)
        | {f"frequency.{name}": frequencies[name] for name in FREQUENCIES}
        | {"signal.rate": 1.0 / float(np.mean(np.diff(t))) if len(t) > 1 else math.nan}
        | {f"signal.{name}": result.data[name][rows].astype(np.float32) for name in channels}
    )


def fields(units):
    """The fields of these columns; units: by channel."""
    import pyarrow as pa

    found = [pa.field("label.fault", pa.string())]
    found += [pa.field(f"label.{name}", pa.float64(), metadata={"unit": "m"}) for name in (*SIZES, "waviness")]
    names = [f"frequency.{name}" for name in FREQUENCIES] + ["signal.rate"]
    found += [pa.field(name, pa.float64(), metadata={"unit": "Hz"}) for name in names]
    kind = pa.list_(pa.float32())
    return found + [pa.field(f"signal.{name}", kind, metadata={"unit": unit}) for name, unit in units.items()]


def labels(parameters):
    """What is wrong with the bearing of these parameters."""
    lengths = {
        name.removesuffix(".spall_length"): x for name, x in parameters.items() if name.endswith(".spall_length")
    }
    spalled = [body for body, length in lengths.items() if length > 0.0]
    worst = max(spalled, key=lengths.get, default=None)
    places = [race for race in RACES if race in spalled] + ["ball"] * any(body not in RACES for body in spalled)
    fault = "both" if places == [*RACES] else "+".join(places) or "none"
    sizes = {f"label.{size}": parameters[f"{worst}.spall_{size}"] if worst else 0.0 for size in SIZES}
    waves = [value for name, value in parameters.items() if name.startswith(("outer.waviness[", "inner.waviness["))]
    return {"label.fault": fault} | sizes | {"label.waviness": max(waves, default=0.0)}
