"""The verdict on a bearing: checks of rivets, raceways, pressure and film against their limits."""

import math
from dataclasses import dataclass

import numpy as np

from ..base.errors import shortlist
from ..base.units import LONGEST, hours_text
from ..running.budget import digits, life_ends
from ..running.summary import columns, flag_note, settled
from .raceways import life_text

MIXED = 1.0  # film over roughness: below it asperities carry
SLIP = 0.1  # of the cage's speed: beyond it balls skid
SCALES = (0.05, 20.0)  # of stress, between which the target is looked for
HALVINGS = 12  # of the logarithm of their ratio: to 0.15 % of stress
OF_PLACE = ("Head, fatigue", "Middle, fatigue")
LINES, CHARACTERS = 9, 90  # of all texts of the basis together; of a line
LIMITS = {  # event.* -> in words
    "overpressure": "contact pressure beyond bearing.p_limit",
    "joint_open": "plates of a joint apart",
    "rivet_overload": "rivet beyond its tensile strength",
    "rivet_yield": "rivet beyond its yield stress",
    "cage_yield": "ribbon cage beyond its yield stress",
    "no_clearance": "bearing without clearance",
    "ellipse_cut": "contact ellipse over the shoulder",
    "pocket_exit": "ball outside its pocket",
    "energy_off": "energy residual beyond 2 % of the loss",
    "land_contact": "cage's land touches the ring",
}
ORDINARY = ("land_contact",)  # crossed in ordinary operation: told, but no fault


@dataclass(frozen=True)
class Check:
    """One line of the verdict; use: utilisation, None without a limit; state: of STATES."""

    title: str
    value: str
    allowed: str = ""
    use: float | None = None
    state: str = ""


def judged(evidence, target):
    """State, headline and reason, of rivets and raceways together; target: hours or None."""
    if evidence.life is None:
        return "open", "No life can be told", evidence.untold
    found, life = evidence.raceways, f"{hours_text(evidence.life, digits(evidence.budgets))}{errors_told(evidence)}"
    of_raceways = f"raceways {life_text(found)}"
    if target is None:
        return "", f"Life of the rivets {life}", f"{of_raceways}; no target was given (--target)"
    wanted = hours_text(target)
    state, reason = rivets_judged(evidence, target)
    states = [state, *([] if found.untold else [raceways_judged(found, target)])]
    worst = next(each for each in ("bad", "open", "good") if each in states)
    verdict = {"bad": f"Misses the target of {wanted}", "open": f"Target of {wanted} not safe"}
    meets = f"{'Rivets meet' if found.untold else 'Meets'} the target of {wanted}"
    return worst, verdict.get(worst, meets), f"rivets {reason}{errors_told(evidence)}; {of_raceways}"


def errors_told(evidence):
    """The ends of a life by all its errors, "" where they are not known or both beyond what can be told."""
    ends = life_ends(evidence.budgets)
    if not ends or min(ends) > LONGEST:
        return ""
    return f" ({' to '.join(hours_text(end, digits(evidence.budgets)) for end in ends)} with all its errors)"


def rivets_judged(evidence, target):
    """State and reason of the rivets against a target [h]."""
    few = digits(evidence.budgets)
    life, low, high = (
        hours_text(x, few) for x in (evidence.life, evidence.low or evidence.life, evidence.high or evidence.life)
    )
    if evidence.life < target:
        sure = evidence.high is not None and evidence.high < target
        return "bad", f"{life}, even the upper end of the interval, {high}, is below it" if sure else life
    if evidence.low is not None and evidence.low < target:
        return "open", f"{life}, but the interval begins {'' if low.startswith('<') else 'at '}{low}"
    return "good", life + (f", at least {low}" if evidence.low and low != life else "")


def raceways_judged(found, target):
    """State of Raceways against a target [h]: open where it hangs on an assumed cleanliness."""
    return "good" if min(found.lives) >= target else "bad" if max(found.lives) < target else "open"


def reserve(evidence, place, target):
    """Factor of all stresses at which head (0) or middle (1) just reaches the target; an end of SCALES beyond."""
    low, high = SCALES
    for _ in range(HALVINGS):
        middle = math.sqrt(low * high)
        if evidence.scaled(middle)[place] >= target:
            low = middle
        else:
            high = middle
    return math.sqrt(low * high)


def checks(evidence, target):
    """The lines of the verdict."""
    if evidence.life is not None:
        use = target / evidence.life if target and math.isfinite(evidence.life) and evidence.life > 0.0 else None
        state = rivets_judged(evidence, target)[0] if target else ""
        yield Check(
            "First rivet to fail",
            f"{hours_text(evidence.life, digits(evidence.budgets))} ({evidence.interval}), {evidence.place}",
            f"at least {hours_text(target)}" if target else "",
            0.0 if target and math.isinf(evidence.life) else use,
            state,
        )
    for place, title in enumerate(OF_PLACE):
        yield fatigue_check(evidence, place, title, target)
    yield from raceway_checks(evidence, target)
    yield from pressure_checks(evidence.results)
    yield from film_checks(evidence.results)


def fatigue_check(evidence, place, title, target):
    """Utilisation of a place by fatigue."""
    amplitude = f"amplitude up to {1e-6 * evidence.amplitudes[place]:.3g} MPa (R = −1)"
    if target and evidence.life is not None:
        x = reserve(evidence, place, target)
        times = f"{x:.3g}" if SCALES[0] * 1.01 < x < SCALES[1] / 1.01 else f"over {x:.2g}"
        return Check(
            title, amplitude, f"{times} times the stress at the target", 1.0 / x, "good" if x >= 1.0 else "bad"
        )
    if (knee := evidence.knees[place]) is None:
        return Check(title, amplitude)
    return Check(title, amplitude, f"S–N curve's knee {1e-6 * knee:.3g} MPa", evidence.amplitudes[place] / knee)


def raceway_checks(evidence, target):
    """Life of the raceways, and their least load with the cage's slip."""
    found = evidence.raceways
    if found.untold:
        return
    limits = ("", None, "")
    if target:
        limits = f"at least {hours_text(target)}", target / min(found.lives), raceways_judged(found, target)
    yield Check("Raceways", life_text(found), *limits)
    if math.isfinite(least := found.least_load):
        recorded = [result for result in evidence.results.values() if "cage.slip_ratio" in result.data]
        slips = [abs(float(result.data["cage.slip_ratio"][settled(result)].mean())) for result in recorded]
        slip = f", cage slip up to {100.0 * max(slips):.2g} %" if slips else ""
        state = "good" if least >= 1.0 and max(slips, default=0.0) <= SLIP else "open"
        allowed = f"minimum load; slip {100.0 * SLIP:.0f} %"
        yield Check("Load, slip", f"{least:.3g} times the minimum load{slip}", allowed, None, state)


def pressure_checks(results):
    """Largest pressure of each race against the FMU's limit."""
    for name, title in (("p_i", "Pressure, inner race"), ("p_e", "Pressure, outer race")):
        found = {
            part: max(float(result.data[key][settled(result)].max()) for key in keys)
            for part, result in results.items()
            if (keys := columns(result, "ball[", f"].{name}"))
        }
        if found:
            part = max(found, key=found.get)
            limit, value = results[part].parameters["bearing.p_limit"], found[part]
            state = "good" if value <= limit else "bad"
            where = f" ({clipped(part, 24)})" if len(results) > 1 else ""
            yield Check(title, f"{1e-6 * value:,.0f} MPa{where}", f"{1e-6 * limit:,.0f} MPa", value / limit, state)


def film_checks(results):
    """Mean film over roughness of the contacts that carry, in the race and the part where it is thinnest."""
    found = {}
    for part, result in results.items():
        late = settled(result)
        for side, race in (("i", "inner"), ("e", "outer")):
            films, loads = (columns(result, "ball[", f"].{name}_{side}") for name in ("Lambda", "Q"))
            if films and len(films) == len(loads):
                film, load = (np.concatenate([result.data[n][late] for n in names]) for names in (films, loads))
                if np.any(load > 0.0):
                    found[part, race] = float(film[load > 0.0].mean())
    if found:
        part, race = min(found, key=found.get)
        value = found[part, race]
        where = f", {clipped(part, 18)}" if len(results) > 1 else ""
        state = "good" if value >= MIXED else "open"
        allowed = f"at least {MIXED:g}, below it asperities carry"
        yield Check("Oil film/roughness", f"{value:.2g} ({race} race{where})", allowed, None, state)


def limits_crossed(results):
    """Which limits were crossed, where: (whether it is a fault, text)."""
    found = {}
    for part, result in results.items():
        for event, words in LIMITS.items():
            count = result.data.get(f"event.{event}_onsets", np.zeros(1))[-1]
            if count:
                found.setdefault((event not in ORDINARY, words), []).append(f"{part} {count:,.0f} ×")
        if flags := flag_note(result).partition(": ")[2]:
            found.setdefault((True, flags), []).append(part)
        if result.stopped:
            found.setdefault((True, f"run stopped early: {clipped(result.stopped, 90)}"), []).append(part)
    for (fault, words), parts in sorted(found.items(), key=lambda item: not item[0][0]):
        yield fault, clipped(f"{words}: {shortlist(parts, 3)}", CHARACTERS)


def clipped(text, length):
    """A text of at most this length, cut between words where there are some."""
    text = str(text)
    if len(text) <= length:
        return text
    kept = text[: length - 1]
    if not text[length - 1].isspace() and " " in kept:
        kept = kept[: kept.rindex(" ")]
    return f"{kept.rstrip(' ,;:(')}…"
