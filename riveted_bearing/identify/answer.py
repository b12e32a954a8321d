"""What an identification leaves: identify.json, the scene file identified.toml, and the page identify.html."""

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.ticker import MaxNLocator

from ..base.files import write_json, write_text
from ..base.toml_files import to_toml
from ..base.version import __version__
from ..running.responses import display_of, displayed, titled
from ..running.scene import Scene
from ..show import charts
from ..show.pages import save_page
from ..show.style import FORCE, HEAD, MIDDLE, MUTED

VERDICTS = {"both": "decided", "below": "bounded from below", "above": "bounded from above", "no": "not decided"}


def parameter_rows(found: Any) -> Any:
    """(parameter, value, interval, range, verdict) as texts."""
    rows = []
    for parameter in found.study.parameters:
        one = found.intervals[parameter.name]
        value, low, high, first, last = (
            f"{displayed(parameter.name, x):.4g}" for x in (one.value, one.low, one.high, parameter.low, parameter.high)
        )
        rows.append((titled(parameter.name), value, f"{low} ... {high}", f"{first} ... {last}", VERDICTS[one.decided]))
    return rows


def target_rows(found):
    """(target, role, measured, uncertainty, result, standard error, deviation in uncertainties, in percent, before)."""
    rows = []
    for k, target in enumerate(found.study.targets):
        unit, factor, offset = unit_of(target)
        mean, error = found.answer.mean[k], found.answer.error[k]
        share = f"{100.0 * (mean / target.value - 1.0):+.1f}" if target.value and not offset else ""
        title = target.name + (f" [{unit}]" if unit else ""), "held out" if target.held_out else "fitted"
        measured = f"{factor * target.value + offset:.4g}", f"{factor * target.uncertainty:.2g}"
        result = f"{factor * mean + offset:.4g}", f"{factor * error:.2g}"
        after, before = (f"{one.deviation[k]:+.2f}" for one in (found.answer, found.before))
        rows.append((*title, *measured, *result, after, share, before))
    return rows


def unit_of(target):
    """Unit in which people read a target, factor and offset."""
    if target.operation == "over" or target.column.startswith(("band(", "line(")):
        return ("" if target.unit == "1" else target.unit), 1.0, 0.0
    unit, factor, offset = display_of(target.column)
    difference = target.operation == "minus" or target.column.startswith("std(")
    return unit or ("" if target.unit == "1" else target.unit), factor, 0.0 if difference else offset


def error_rows(found: Any) -> Any:
    """(targets, number, after, before the fit): RMS deviations in uncertainties with their scatter by the seeds."""
    rows = []
    for label, key in (("fitted", "fit"), ("held out", "held_out")):
        count = sum(target.held_out == (key == "held_out") for target in found.study.targets)
        pairs = (getattr(one, key) for one in (found.answer, found.before))
        rows.append((label, str(count), *("" if pair is None else f"{pair[0]:.3g} ± {pair[1]:.1g}" for pair in pairs)))
    return rows


def write_answer(found: Any, basis: Any, path: Path) -> Path:
    """Write the answer as JSON, whole or not at all; returns the path."""
    study = found.study
    document = {
        "version": __version__,
        "description": study.description,
        "basis": dict(basis),
        "settings": study.settings,
        "parameters": {name: vars(one) for name, one in found.intervals.items()},
        "correlations": {"names": study.names, "matrix": found.correlations.tolist()},
        "misfit": {"chi_square": found.misfit[0], "degrees_of_freedom": found.misfit[1], "widened": found.widened},
        "errors": {
            moment: {"fit": one.fit, "held_out": one.held_out}
            for moment, one in (("after", found.answer), ("before", found.before))
        },
        "before": dict(zip(study.names, found.before.values, strict=True)),
        "targets": [
            vars(target)
            | {
                "weight": target.weight,
                "point": study.points[target.point][0],
                "other": study.points[target.other][0] if target.operation else None,
                "result": found.answer.mean[k],
                "standard_error": found.answer.error[k],
                "deviation": found.answer.deviation[k],
                "before": found.before.mean[k],
                "effects": dict(zip(study.names, found.effects[:, k].tolist(), strict=True)),
            }
            for k, target in enumerate(study.targets)
        ],
        "screen": found.screen,
        "points": len(found.points),
        "rounds": found.rounds,
        "notes": found.notes,
    }
    return write_json(path, document)


def write_scene(found: Any, scene: Scene, path: Path) -> Path:
    """Write the scene with the values found as a scene file in SI units, intervals as comments; returns the path."""
    simulation = {"t_end": scene.t_end, "step": scene.step}
    for key in ("output_interval", "tolerance"):
        if getattr(scene, key) is not None:
            simulation[key] = getattr(scene, key)
    document = {
        "description": f"{found.study.path.stem}: identified from {len(found.study.targets)} targets",
        "simulation": simulation,
        "parameters": dict(scene.parameters),
        "inputs": {name: plain(history) for name, history in scene.inputs.items()},  # numbers come first in TOML
    }
    lines = list(to_toml(document))
    for at, values in scene.changes:
        lines += ["[[change]]", *to_toml({"at": at} | values)]
    for i, line in enumerate(lines):
        name = line.partition(" = ")[0].strip('"')
        if name in found.intervals:
            one = found.intervals[name]
            lines[i] = f"{line}  # {one.low:.4g} ... {one.high:.4g}, {VERDICTS[one.decided]}"
    return write_text(path, "\n".join(lines) + "\n")


def plain(history):
    """An input as a scene file has it."""
    if len(history.t) == 1:
        return float(history.value[0])
    kind = {"interpolation": "hold"} if history.hold else {}
    return {"t": history.t.tolist(), "value": history.value.tolist()} | kind


def write_page(found: Any, basis: Any, path: Path) -> Path:
    """Write the page, whole or not at all; returns the path."""
    study = found.study
    height = 1.4 + 0.26 * len(study.targets)
    pictures = [charts.svg(lambda fig: deviations(fig, found), (6.4, height), "targets beside results")]
    for parameter in study.parameters:
        label = f"profile of {parameter.name}"
        pictures.append(charts.svg(lambda fig, p=parameter: profile(fig, found, p), (4.9, 2.7), label))
    rows = {"parameters": parameter_rows(found), "errors": error_rows(found), "targets": target_rows(found)}
    return save_page(path, "identify.html", found=found, basis=list(basis), charts=pictures, **rows)


def deviations(fig, found):
    """Results beside targets, in uncertainties: fitted, held out, and before the fit."""
    ax = fig.subplots()
    y = np.arange(len(found.study.targets))
    fitted = found.study.fitted
    ax.axvspan(-2.0, 2.0, color="#f3f4f6", zorder=0)
    ax.axvline(0.0, color=FORCE, lw=0.8)
    ax.plot(found.before.deviation, y, "x", color=MUTED, ms=5, label="before the fit")
    after = np.array(found.answer.deviation)
    ax.plot(after[fitted], y[fitted], "o", color=MIDDLE, ms=5, label="fitted")
    ax.plot(after[~fitted], y[~fitted], "o", color=HEAD, ms=5, label="held out")
    ax.set_yticks(y, [target.name for target in found.study.targets])
    ax.invert_yaxis()
    ax.set_xlabel("(result - measured)/uncertainty")
    if max(map(abs, [*after, *found.before.deviation])) > 20.0:
        ax.set_xscale("symlog", linthresh=2.0)
    fig.legend(loc="outside upper right", ncols=3)


def profile(fig, found, parameter):
    """The least J over a parameter's range, with its limit."""
    ax = fig.subplots()
    one = found.intervals[parameter.name]
    x, y = np.array(one.profile).T
    x, (low, high, value) = displayed(parameter.name, x), displayed(parameter.name, [one.low, one.high, one.value])
    ax.axvspan(low, high, color="#f3f4f6", zorder=0)
    ax.plot(x, y, ".-", color=MIDDLE, lw=1.0)
    ax.axvline(value, color=HEAD, lw=1.0)
    ax.set(xlabel=titled(parameter.name), ylabel="rise of J", ylim=(-0.5, 16.0 * found.widened))
    ax.xaxis.set_major_locator(MaxNLocator(5))
