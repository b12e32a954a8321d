"""The main figures of a run, as rows of mean, RMS, p99.9 and largest value."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..bearing.plausible import fast
from ..bearing.ribbon import is_guided_by_balls
from .results import Result

RPM = 30.0 / np.pi  # rev/min per rad/s
DEG = 180.0 / np.pi
FLAGS = {1: "rivet yields", 2: "flange yields", 4: "joint compressed", 8: "fit beyond the stress table"}  # by bit
SETTLED = 10.0  # revolutions of the shaft that statistics should leave out
TABLE_TITLE = "Stress table of the rivets: "  # in an FMU's description, before its kind and error
COUNTED = 10.0  # revolutions of the shaft that statistics should count


@dataclass(frozen=True)
class Row:
    """A line: channel, unit shown, figures in it (nan if unknown), whether every internal step counts."""

    channel: str
    unit: str
    mean: float
    rms: float
    p999: float
    largest: float
    every_step: bool


def summary_rows(result: Result) -> Any:
    """Rows of every channel that the result has, after start.settle; none without later values."""
    if not has_statistics(result):
        return []
    rows = [
        counted(result, "pocket force, all balls", "N", "stat.Q_c_{}", 1.0),
        stress(result, "head stress, largest of rivets", "stat.sigma_head_{}"),
        stress(result, "middle stress, largest of rivets", "stat.sigma_mid_{}"),
        *(sampled(result, *channel) for channel in channels(result)),
    ]
    return [row for row in rows if row]


def channels(result):
    """Channel, unit shown, factor, outputs and how they combine, of what communication points alone tell."""
    over = " / pocket clearance" if is_guided_by_balls(result.parameters) else ""
    return [
        ("largest inner contact load", "N", 1.0, columns(result, "ball[", "].Q_i"), np.max),
        ("largest outer contact load", "N", 1.0, columns(result, "ball[", "].Q_e"), np.max),
        ("largest inner pressure", "MPa", 1e-6, columns(result, "ball[", "].p_i"), np.max),
        ("cage speed", "rev/min", RPM, ["cage.omega"], None),
        ("cage slip ratio", "%", 100.0, ["cage.slip_ratio"], None),
        (f"cage eccentricity{over}", "1", 1.0, ["cage.eccentricity"], None),
        ("cage dislocation", "um", 1e6, ["cage.dislocation"], None),
        ("ring displacement, radial", "um", 1e6, ["ring.y", "ring.z"], np.linalg.norm),
        ("ring displacement, axial", "um", 1e6, ["ring.x"], None),
        ("ring tilt", "deg", DEG, ["ring.tilt_y", "ring.tilt_z"], np.linalg.norm),
        ("friction torque", "N.m", 1.0, ["bearing.friction_torque"], None),
        ("power loss", "W", 1.0, ["bearing.power_loss"], None),
    ]


def has_statistics(result: Result) -> bool:
    """Whether the run went on after start.settle, where statistics begin."""
    return float(result.data["time"][-1]) > result.parameters.get("start.settle", 0.0)


def no_statistics(result: Result) -> str:
    """Why there are no statistics and how to get them: a sentence; "" if there are some."""
    if has_statistics(result):
        return ""
    settle, end = (
        f"{time:g} s" for time in (result.parameters.get("start.settle", 0.0), float(result.data["time"][-1]))
    )
    return f"no statistics yet: they begin at start.settle = {settle}, and the run ended at {end}; let it run longer (t_end), or set start.settle lower"


def fewer(turns: Any, wanted: Any) -> bool:
    """Whether a number of revolutions, as it is printed, is below another one; a shaft at rest apart."""
    return 0.0 < float(f"{turns:.2g}") < wanted


def settle_note(result: Result) -> str:
    """A warning where the statistics begin before the bearing has settled, for slow shafts; else ""."""
    turns, settle = result.about.get("settle_turns", 0.0), result.parameters.get("start.settle", 0.0)
    if not fewer(turns, SETTLED) or not has_statistics(result):
        return ""
    enough = SETTLED / turns * settle
    return (
        f"statistics and damage begin at start.settle = {settle:g} s, after {turns:.2g} revolutions of the shaft: start and "
        f"first contacts count; start.settle = {enough:.2g} s leaves out {SETTLED:g} revolutions"
    )


def count_note(result: Result) -> str:
    """A warning where statistics rest on few revolutions of the shaft; else ""."""
    turns = result.about.get("count_turns", 0.0)
    if not fewer(turns, COUNTED) or not has_statistics(result):
        return ""
    return (
        f"statistics and life rest on {turns:.2g} revolutions of the shaft after start.settle; from {COUNTED:g} on they are "
        "steady enough to compare (t_end)"
    )


def speed_note(result: Result) -> str:
    """A warning where the shaft turns faster in the mean than few ball bearings do; else ""."""
    seconds, d_m = result.summary.get("simulated_time", 0.0), result.parameters.get("bearing.d_m", 0.0)
    turns = result.about.get("settle_turns", 0.0) + result.about.get("count_turns", 0.0)
    return "".join(fast(2.0 * np.pi * turns / seconds, d_m)) if seconds else ""


def early_rows(result: Result) -> Iterator[Any]:
    """For a run without statistics: (channel, unit, value at the end, largest since the start) of what it has."""
    peaks = [
        ("pocket force, largest in the step", "N", 1.0, ["cage.F_pocket_peak"], None),
        ("head stress, largest of rivets", "MPa", 1e-6, ["rivet.sigma_head_max"], None),
        ("middle stress, largest of rivets", "MPa", 1e-6, ["rivet.sigma_mid_max"], None),
    ]
    for channel, unit, factor, names, combine in [*peaks, *channels(result)]:
        if (
            names
            and all(name in result.data for name in names)
            and (unit != "MPa" or result.parameters.get("scene.stress") != "off")
        ):
            values = factor * combined(result, names, combine)
            yield channel, unit, float(values[-1]), float(values[np.argmax(np.abs(values))])


TABLE_NOTES = {  # by rivet.table_kind: what the stress rests on, as far as the FMU's description does not say it, and a way out
    2: ("coarse finite elements", ""),
    3: (
        "closed forms, tens of per cent off in the head and not on the safe side",
        "; build --table coarse makes a better table",
    ),
}


def table_note(result: Result) -> str:
    """What limits the rivets' stress beside the model: "" for a full table by finite elements, or if it is not known."""
    if (kind := result.summary.get("rivet.table_kind", 0)) not in TABLE_NOTES:
        return ""
    known, remedy = TABLE_NOTES[kind]
    written = result.about.get("model", "").partition(TABLE_TITLE)[2]
    return f"the rivets' stress rests on {written if written.startswith(known.partition(',')[0]) else known}{remedy}"


def flag_note(result: Result) -> str:
    """Which parts yield, and where the stress table ends, at a communication point of the run; "" for none."""
    flags = columns(result, "rivet[", "].flag")
    seen = int(np.bitwise_or.reduce(np.concatenate([result.data[name] for name in flags]).astype(int))) if flags else 0
    found = [text for bit, text in FLAGS.items() if seen & bit]
    return f"flags of the rivets (rivet[k].flag): {', '.join(found)}" if found else ""


def clearance_of_cage(parameters: dict[str, Any]) -> str:
    """The clearance that lets the cage move, and over which its eccentricity stands: "guide" or "pocket"."""
    return "pocket" if is_guided_by_balls(parameters) else "guide"


def life_is_known(result: Result) -> bool:
    """Whether the stress is good enough to speak of a life: not from closed forms."""
    return result.summary.get("rivet.table_kind", 0) != 3


def static_and_swing(values: Any, place: str) -> Any:
    """Largest mean of a rivet's heads ("head") or middles ("mid"), and largest 99.9 % quantile less its own mean, which fatigue
    follows; values: stat.* by name.
    """
    kinds = (f"stat.rivet_{place}_{kind}[" for kind in ("mean", "p999"))
    mean, p999 = (np.array([values[name] for name in values if name.startswith(kind)], float) for kind in kinds)
    return mean.max(axis=0), (p999 - mean).max(axis=0)


def rivet_rows(result: Result) -> Any:
    """Head and middle stress [MPa] of each rivet over every internal step, as (k, Row of the head, Row of the middle)."""
    count = sum(name.startswith("stat.rivet_head_mean[") for name in result.summary)
    pairs = [
        tuple(stress(result, f"rivet {k}, {place}", f"stat.rivet_{place}_{{}}[{k}]") for place in ("head", "mid"))
        for k in range(1, count + 1)
    ]
    return [(k, *pair) for k, pair in enumerate(pairs, 1) if all(pair)]


def counted(result, channel, unit, pattern, factor):
    """A row from the FMU's own statistics; None if they were off or never really started."""
    names = [pattern.format(kind) for kind in ("mean", "rms", "p999", "max")]
    if (
        not has_statistics(result)
        or not result.summary.get("stat.time")
        or not all(name in result.summary for name in names)
    ):
        return None
    return Row(channel, unit, *(factor * result.summary[name] for name in names), every_step=True)


def stress(result, channel, pattern):
    """A row of stress; None also if stress was not computed at every step, where the statistics are 0."""
    every_step = result.parameters.get("scene.stress") in ("peak", "fatigue")
    return counted(result, channel, "MPa", pattern, 1e-6) if every_step else None


def sampled(result, channel, unit, factor, names, combine):
    """A row from the samples after settling; None if a channel was not recorded."""
    if not names or not all(name in result.data for name in names):
        return None
    values = factor * combined(result, names, combine)[settled(result)]
    extreme = values[np.argmax(np.abs(values))]
    return Row(
        channel,
        unit,
        float(values.mean()),
        float(np.sqrt(np.mean(values**2))),
        float(np.quantile(values, 0.999)),
        float(extreme),
        every_step=False,
    )


def combined(result, names, combine):
    """One column of several by a function of NumPy."""
    values = np.column_stack([result.data[name] for name in names])
    return combine(values, axis=1) if combine else values[:, 0]


def settled(result: Result) -> np.ndarray:
    """Mask of the rows from start.settle on; of all rows if the run ends by then."""
    late = result.data["time"] >= result.parameters.get("start.settle", 0.0)
    return late if has_statistics(result) else np.ones_like(late)


PLACES = {1: "head", 2: "middle", 3: "by rivet[k].intact = 0"}


def breaks(result: Result) -> Any:
    """Rivets that broke by their damage, in the order of time: (number, place, time [s])."""
    times = {k: t for k in rivets_of(result) if (t := result.summary.get(f"rivet[{k}].break_time", -1.0)) >= 0.0}
    places = {k: PLACES.get(int(result.summary.get(f"rivet[{k}].broken", 1.0)), "") for k in times}
    return sorted(((k, places[k], float(t)) for k, t in times.items()), key=lambda each: each[2])


def gone_from(result: Result) -> Any:
    """Time [s] from which on each broken rivet is gone: 0 of one that never was there."""
    begun = {k: 0.0 for k in rivets_of(result) if result.parameters.get(f"rivet[{k}].intact", 1) == 0}
    return begun | {k: t for k, _, t in breaks(result)}


def rivets_of(result):
    """Numbers of the rivets."""
    return [k for k in range(1, 33) if f"rivet[{k}].intact" in result.parameters]


def accelerated(result: Result) -> str:
    """Words on damage that was not counted as it is, "" where it was."""
    factor = result.parameters.get("fatigue.acceleration", 1.0)
    return "" if factor == 1.0 else f"damage accelerated {factor:g} times (fatigue.acceleration)"


def columns(result: Result, head: Any, tail: Any) -> Any:
    """Recorded channels of one quantity of all balls or rivets."""
    return [name for name in result.data if name.startswith(head) and name.endswith(tail)]
