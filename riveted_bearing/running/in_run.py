"""Parameters that changed and rivets that broke while the bearing ran, in words."""

from typing import Any

from bearing_model.generated import variables

from ..base.units import scales_of, suffix
from ..base.variable_list import variable_of
from .results import Result
from .summary import breaks, count_note, rivets_of, settle_note, speed_note

ALONE = (
    "all rivets are gone: the halves come apart, held by pockets and lands alone, and there is no stress of rivets; "
    "with scene.breakage = on such a run ends"
)


def unit_of(result: Result, name: str, variable: Any) -> Any:
    """The unit that the user wrote, else the one that people read, "" for none; factor and offset from SI."""
    scales = scales_of(variable.unit, variables.UNITS[variable.unit])
    symbol = result.about.get("units", {}).get(name)
    symbol = symbol if symbol in scales else variable.display or variable.unit
    return suffix(symbol).strip().replace("um", "µm"), *scales[symbol]


def value_of(result, name, value):
    """A parameter's value in the unit that people read, as (text, unit)."""
    variable = variable_of(name)
    if variable is None or isinstance(value, str) or variable.type != "Real":
        return f"{value}", ""
    unit, factor, offset = unit_of(result, name, variable)
    return f"{factor * value + offset:.6g}", unit


def changes(result: Result) -> Any:
    """Parameters that the scene changed before the run ended, in the order of time: (time [s], {name: value})."""
    found = ((float(at.removesuffix(" s")), values) for at, values in result.about.get("changes", {}).items())
    return [(at, values) for at, values in found if at < result.data["time"][-1]]


def change_lines(result: Result) -> Any:
    """One line for each time: "at 80 ms: joint.preload 20 N, joint.mu 0.3"."""
    return [
        f"at {1e3 * at:.6g} ms: {', '.join(' '.join((name, *filter(None, value_of(result, name, value)))) for name, value in values.items())}"
        for at, values in changes(result)
    ]


def later_values(result: Result, name: str) -> str:
    """Values that a parameter took in the run: "; 20 from 80 ms", "" for one that did not change."""
    return "".join(
        f"; {value_of(result, name, values[name])[0]} from {1e3 * at:.6g} ms"
        for at, values in changes(result)
        if name in values
    )


def last_value(result, name):
    """Value of a parameter at the end of the run."""
    return next((values[name] for _, values in changes(result)[::-1] if name in values), result.parameters.get(name))


def break_lines(result: Result) -> Any:
    """The rivets that broke by their damage; with scene.breakage = on and none broken the one that was nearest to it."""
    broken = [f"rivet {k} broke in the {place} at {1e3 * t:.4g} ms" for k, place, t in breaks(result)]
    if broken or not breakage_is_on(result) or not any_rivet_stands(result):
        return broken
    damage, k, place = largest_damage(result)
    return [f"no rivet broke; largest damage {damage:.3g}, rivet {k} {place}" if k else "no rivet broke"]


def breakage_is_on(result):
    """Whether rivets break by their damage at the end of the run."""
    return last_value(result, "scene.breakage") == "on"


def any_rivet_stands(result):
    """Whether the parameters leave a rivet in the cage at the end of the run."""
    return any(last_value(result, f"rivet[{k}].intact") for k in rivets_of(result))


def largest_damage(result):
    """Miner's sum that the FMU counted, number and place of the rivet that has the largest; number 0 if none was counted."""
    found = [
        (result.summary[name], k, place)
        for k in rivets_of(result)
        for place, short in (("head", "head"), ("middle", "mid"))
        if (name := f"rivet[{k}].damage_{short}") in result.summary
    ]
    return max(found, default=(0.0, 0, ""), key=lambda each: each[0])


def notes(result: Result) -> list[str]:
    """Sentences that a reader of a run's figures has to know."""
    kinds = (settle_note, count_note, speed_note, alone_note)
    return [text for note in kinds if (text := note(result))]


def alone_note(result: Result) -> str:
    """A warning where rivet[k].intact = 0 has taken out every rivet and the run goes on, else ""."""
    gone = rivets_of(result) and not any_rivet_stands(result) and not breakage_is_on(result)
    return ALONE if gone else ""
