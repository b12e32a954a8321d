"""The main figures of a run, as rows of mean, RMS, p99.9 and largest value."""

from dataclasses import dataclass

import numpy as np

from bearing_model import variables

RPM = 30.0 / np.pi  # rev/min per rad/s
DEG = 180.0 / np.pi


@dataclass(frozen=True)
class Row:
    """One line: channel, unit shown, figures in that unit (nan if unknown), and whether every internal step or only the communication points count."""

    channel: str
    unit: str
    mean: float
    rms: float
    p999: float
    largest: float
    every_step: bool


def summary_rows(result):
    """Rows for every channel that the result has; values before start.settle [s] do not count."""
    rows = [
        counted(result, "pocket force, all balls", "N", "stat.Q_c_{}", 1.0),
        stress(result, "head stress, worst rivet", "stat.sigma_head_{}"),
        stress(result, "middle stress, worst rivet", "stat.sigma_mid_{}"),
        sampled(result, "largest inner contact load", "N", 1.0, columns(result, "ball[", "].Q_i"), largest_of),
        sampled(result, "largest outer contact load", "N", 1.0, columns(result, "ball[", "].Q_e"), largest_of),
        sampled(result, "largest inner pressure", "MPa", 1e-6, columns(result, "ball[", "].p_i"), largest_of),
        sampled(result, "cage speed", "rev/min", RPM, ["cage.omega"]),
        sampled(result, "cage slip ratio", "%", 100.0, ["cage.slip_ratio"]),
        sampled(result, "cage eccentricity", "1", 1.0, ["cage.eccentricity"]),
        sampled(result, "cage dislocation", "um", 1e6, ["cage.dislocation"]),
        sampled(result, "ring displacement, radial", "um", 1e6, ["ring.y", "ring.z"], length_of),
        sampled(result, "ring displacement, axial", "um", 1e6, ["ring.x"]),
        sampled(result, "ring tilt", "deg", DEG, ["ring.tilt_y", "ring.tilt_z"], length_of),
        sampled(result, "friction torque", "N.m", 1.0, ["bearing.friction_torque"]),
        sampled(result, "power loss", "W", 1.0, ["bearing.power_loss"]),
    ]
    return [row for row in rows if row]


TABLE_NOTES = {  # by rivet.table_kind
    2: "the rivets' stress rests on coarse finite elements: RMS error some 2 %, at single loads up to 10 % of the largest stress",
    3: "the rivets' stress rests on closed forms: tens of per cent off in the head, not on the safe side; build --table coarse makes a better table",
}


def table_note(result):
    """What limits the rivets' stress beside the model: "" for a full table by finite elements, or if it is not known."""
    return TABLE_NOTES.get(int(result.summary.get("rivet.table_kind", 0)), "")


def assumed_rows(result):
    """Assumed parameters that move the rivets' stress most and that neither scene nor bearing file gives: (name, value, low, high, unit, stress, source).

    stress: change of the worst head's 99.9 % quantile over the range low to high, over the quantile, at the working point.
    """
    for name, (low, high, stress, source) in variables.ASSUMPTIONS.items():
        if name in result.parameters and name not in result.about.get("given", ()):
            unit = variables.PARAMETERS[name].display or variables.PARAMETERS[name].unit
            factor, _ = variables.UNITS[variables.PARAMETERS[name].unit][unit]
            value = factor * result.parameters[name]
            yield name, value, low * value, high * value, unit, stress, source


def life_is_known(result):
    """Whether the stress is good enough to speak of a life: not from closed forms."""
    return int(result.summary.get("rivet.table_kind", 0)) != 3


def rivet_rows(result):
    """Head and middle stress [MPa] of each rivet over every internal step, as (k, Row of the head, Row of the middle)."""
    count = sum(name.startswith("stat.rivet_head_mean[") for name in result.summary)
    pairs = [tuple(stress(result, f"rivet {k}, {place}", f"stat.rivet_{place}_{{}}[{k}]") for place in ("head", "mid")) for k in range(1, count + 1)]
    return [(k, *pair) for k, pair in enumerate(pairs, 1) if all(pair)]


def counted(result, channel, unit, pattern, factor):
    """A row from the FMU's own statistics; None if they were off or never started."""
    names = [pattern.format(kind) for kind in ("mean", "rms", "p999", "max")]
    if not result.summary.get("stat.time") or not all(name in result.summary for name in names):
        return None
    return Row(channel, unit, *(factor * result.summary[name] for name in names), every_step=True)


def stress(result, channel, pattern):
    """A row of stress; None also if stress was not computed at every step, where the statistics are 0."""
    every_step = result.parameters.get("scene.stress") in ("peak", "fatigue")
    return counted(result, channel, "MPa", pattern, 1e-6) if every_step else None


def sampled(result, channel, unit, factor, names, combine=None):
    """A row from the samples after settling; None if a channel was not recorded."""
    if not names or not all(name in result.data for name in names):
        return None
    values = np.column_stack([result.data[name] for name in names])[settled(result)]
    values = factor * (combine(values) if combine else values[:, 0])
    extreme = values[np.argmax(np.abs(values))]
    return Row(channel, unit, float(values.mean()), float(np.sqrt(np.mean(values**2))), float(np.quantile(values, 0.999)), float(extreme), every_step=False)


def settled(result):
    """Mask of the rows after start.settle; of all rows if none is later."""
    late = result.data["time"] >= result.parameters.get("start.settle", 0.0)
    return late if late.any() else np.ones_like(late)


def columns(result, head, tail):
    """Recorded channels of one quantity of all balls or rivets."""
    return [name for name in result.data if name.startswith(head) and name.endswith(tail)]


def largest_of(values):
    """Largest of the columns at each time."""
    return values.max(axis=1)


def length_of(values):
    """Length of the vector of the columns at each time."""
    return np.sqrt((values**2).sum(axis=1))


def assumed_ranges(model):
    """Documented ranges of the assumed parameters that the bearing's file does not give: {name: (lowest, highest)} in SI."""
    return {
        name: (low * model.default(model.parameters[name]), high * model.default(model.parameters[name]))
        for name, (low, high, *_) in variables.ASSUMPTIONS.items()
        if name in model.parameters and model.origin.get(name) != "yours"
    }
