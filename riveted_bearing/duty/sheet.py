"""One sheet of paper for people who do not run the model: bearing, loads, verdict, the assumptions that move it, the
worst rivet, and digests of all files.

A mission is judged by its runs and, for peaks, pressures and films, by one more run of each point and event, with the
seed whose run had the largest damage.  A result of `run` is judged as if it went on like that.  Utilisation is

    life                  target/life, of the rivets and of the raceways
    fatigue, per place    1/x; with all stresses x times as large (preload's share included) the place just reaches the
                          target.  Without a target: largest amplitude over that of the S-N curve's knee
    contact pressure      largest pressure over bearing.p_limit
"""

import functools
import hashlib
import math
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime
from pathlib import Path

import numpy as np

from bearing_model.instance.fatigue import fully_reversed

from ..base.errors import UserError, shortlist
from ..base.units import hours_text
from ..base.version import __version__
from ..bearing.assumed import assumed_rows, measured_in
from ..bearing.strength import damage_of_matrix
from ..design.bench import display_of
from ..running.fmu import Model
from ..running.in_run import alone_note, change_lines
from ..running.rainflow import CHANNELS, cycle_damages, fatigue_law_at
from ..running.runner import simulate
from ..running.summary import breaks, columns, flag_note, has_statistics, life_is_known, settled, table_note
from ..show import charts
from ..show.pages import save_page
from ..show.plot import FORCE, HEAD, MIDDLE, MUTED, plt
from ..show.report import curve, figure
from .assess import part_duty, places, used_cases
from .cycles import rainflow_columns, stored_cycles
from .miner import lives
from .page import ends_of, interval_text, mission_text, part_rows, share_text
from .raceways import Raceways, life_text
from .raceways import of_result as raceways_of
from .starts import started

MIXED = 1.0  # film over roughness: below it asperities carry
SLIP = 0.1  # of the cage's speed: beyond it balls skid
SCALES = (0.05, 20.0)  # of stress, between which the target is looked for
HALVINGS = 12  # of the logarithm of their ratio: to 0.15 % of stress
OF_PLACE = ("Head, fatigue", "Middle, fatigue")
MOST_CHECKS, MOST_ASSUMED, MOST_PARTS, MOST_LIMITS, MOST_REMARKS = 8, 3, 5, 4, 2
LINES, CHARACTERS = 9, 90  # of all texts of the basis together; of a line

STATES = {"good": "✓", "bad": "✗", "open": "?", "": ""}
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


@dataclass(frozen=True)
class Evidence:
    """What a sheet judges.

    life, low, high [h], None where nothing is known (untold: why not), with place and interval in words; scaled(x): shortest lives [h] of
    heads and of middles with all stresses x times as large; amplitudes: largest fully reversed ones of head and middle
    [Pa]; knees: of their S-N curves [Pa], None for a table; results: runs by the name of point or event; worst: name of the
    one that decides; rivet: number of the one that fails first; raceways: their Raceways.
    """

    life: float | None
    low: float | None
    high: float | None
    place: str
    interval: str
    scaled: object = field(repr=False)
    amplitudes: tuple
    knees: tuple
    results: dict = field(repr=False)
    worst: str
    rivet: int
    damage: tuple  # of each rivet in the worst part, at the worse of its places; by it `rivet` is the first to fail
    untold: str = ""
    raceways: Raceways = field(default_factory=Raceways, repr=False)


@dataclass(frozen=True)
class Sheet:
    """Everything that stands on the sheet."""

    name: str
    description: str
    basis: dict
    verdict: tuple
    checks: tuple
    limits: tuple
    assumed: tuple
    assumed_from: str
    pictures: dict = field(repr=False)
    worst: str = ""
    parts: tuple = ()
    remarks: tuple = ()
    files: tuple = ()


# What a sheet rests on ------------------------------------------------------------------------------------------------


def of_mission(life, runs, model, progress=lambda done, total: None):
    """Evidence of a mission's Life and its Runs; simulates each point and event once more, with all outputs."""
    mission, duty = life.mission, life.mission.duty
    used = used_cases(duty, list(life.kept)).tolist()
    share = dict(zip(life.kept, life.estimate.shares, strict=True))
    worst = max(share, key=share.get)
    results, rivet = {}, None
    chosen = [(i, c) for i in life.kept if (c := first_case(mission, i)) in used]
    for done, (i, c) in enumerate(chosen):
        progress(done, len(chosen))
        damage = np.array(damages_of(runs, c)).reshape(-1, runs.damages[runs.keys[c, 0]].size)
        judged = damage
        if mission.settings["rivets"] == "each":
            judged = np.where(np.arange(damage.shape[1]) == life.estimate.place, damage, 0.0)
        most = np.unravel_index(np.argmax(judged), damage.shape)
        if i == worst or rivet is None:
            rivet = int(most[1]) // 2 + 1
            of_rivets = damage.mean(axis=0) if mission.settings["rivets"] == "each" else damage[most[0]]
        scene = started(mission.cases[c].scene, model, mission.settings["seed"], int(most[0]))
        results[mission.parts[i].name] = simulate(model, scene)
    if mission.parts[worst].name not in results:  # interpolated: from the simulated part with the largest share
        worst = max((i for i, _ in chosen), key=lambda i: share[i])
    matrices = [runs.matrices[key] for key in runs.damages]
    strength = next(iter(runs.strengths.values()), None)
    laws = matrices[0][1]
    found = life.estimate
    return Evidence(
        found.life,
        life.low,
        found.high,
        life.place,
        f"{100 * mission.settings['confidence']:g} %: {interval_text(*ends_of(life))}",
        functools.cache(lambda x: scaled_lives(life, runs, used, x)),
        largest_amplitudes((matrix, laws) for matrix, laws, _ in matrices),
        knees_of(strength, laws),
        results,
        mission.parts[worst].name,
        rivet,
        worse_places(of_rivets),
        raceways=mission.raceways(),
    )


def worse_places(damage):
    """Damage of each rivet at the worse of head and middle, from [2 Z] in their order."""
    return tuple(np.reshape(damage, (-1, 2)).max(axis=1).tolist())


def first_case(mission, i):
    """Number of the case that is part i itself at the start of the mission; None if it is interpolated."""
    if mission.parts[i].scene is None:
        return None
    return int(np.flatnonzero(mission.duty.blends[0, i])[0])


def damages_of(runs, c):
    """Damages of the runs of a case that were asked for."""
    keys = (runs.keys[c, s] for s in range(runs.mission.settings["max_seeds"]))
    return [runs.damages[key] for key in keys if key in runs.damages]


def scaled_lives(life, runs, used, x):
    """Shortest lives [h] of head and middle with all stresses x times as large: cycles of the rainflow matrices, scaled
    so that they give the counted damage at x = 1.
    """
    mission, means = life.mission, []
    for c in used:
        keys = [key for s in range(mission.settings["max_seeds"]) if (key := runs.keys[c, s]) in runs.damages]
        means.append(
            places(np.array([scaled_damage(runs, key, x) for key in keys]), mission.settings["rivets"]).mean(axis=0)
        )
    hours, _ = lives(part_duty(mission.duty, list(life.kept)), np.array(means))
    return float(hours[0::2].min()), float(hours[1::2].min())


def scaled_damage(runs, key, x):
    """Damage of a run's rivets [Z, 2] at x times its stress."""
    matrix, laws, own = runs.matrices[key]
    strength = runs.strengths.get(laws[0])
    plain, scaled = (damage_by(strength, laws, matrix, scale) for scale in (1.0, x))
    counted = runs.damages[key].reshape(-1)
    whole = counted.sum() / plain.sum() if plain.sum() > 0.0 else 0.0
    factor = np.where(plain > 0.0, counted / np.where(plain > 0.0, plain, 1.0), whole)
    return (scaled * factor).reshape(own.shape)


def damage_by(strength, laws, matrix, scale):
    """Miner's sum of each channel of a matrix at a scale of its stresses; strength: of [sn], None for the FMU's laws of
    the channels.
    """
    channel, span, mean, count = matrix
    span, mean = scale * span, scale * mean
    if strength is not None:
        return damage_of_matrix(strength, (channel, span, mean, count), len(laws))
    damage = np.zeros(len(laws))
    for law in dict.fromkeys(laws):
        mine = np.isin(channel, [c for c, own in enumerate(laws) if own == law])
        of_cycles = count[mine] * cycle_damages(law, span[mine], mean[mine])
        damage += np.bincount(channel[mine], of_cycles, minlength=len(laws))
    return damage


def largest_amplitudes(pairs):
    """Largest fully reversed amplitudes of heads and middles [Pa] in pairs (matrix, laws of the channels)."""
    largest = [0.0, 0.0]
    for (channel, span, mean, _), laws in pairs:
        for place in (0, 1):
            mine = channel % 2 == place
            cycles = zip(span[mine].tolist(), mean[mine].tolist())
            largest[place] = max(
                largest[place], max((fully_reversed(laws[place], 0.5 * s, m) for s, m in cycles), default=0.0)
            )
    return tuple(largest)


def knees_of(strength, laws):
    """Lowest amplitudes at the knees of the S-N curves of heads and middles [Pa], None for a table."""
    if strength is None:
        return tuple(min(law.sigma_D for law in laws[place::2]) for place in (0, 1))
    return (None if strength.table is not None else strength.factor * strength.law.sigma_D,) * 2


def of_result(result, name, raceways):
    """Evidence of one run that is taken to go on as it did, with its Raceways."""
    if not has_statistics(result) or result.parameters.get("scene.stress") == "off":
        raise UserError(f"{name}: no stress after start.settle: a summary needs a longer run, with stress")
    if not columns(result, "rivet[", "].sigma_head"):
        raise UserError(
            f'{name}: rivet[1].sigma_head was not recorded: a summary needs it of each rivet (outputs = ["*"])'
        )
    rows = rainflow_columns(result)
    matrix = stored_cycles({key: [column] for key, column in rows.items()}, 0)
    Z = len(columns(result, "rivet[", "].sigma_head"))
    laws = [fatigue_law_at(result.parameters, k, place) for k in range(1, Z + 1) for place in CHANNELS]
    t = result.data["time"][settled(result)]
    hours = (t[-1] - t[0]) / 3600.0

    def scaled(x):
        damage = damage_by(None, laws, matrix, x)
        with np.errstate(divide="ignore"):
            life = hours / damage
        return float(life[0::2].min()), float(life[1::2].min())

    damage = damage_by(None, laws, matrix, 1.0)
    k, place = divmod(int(damage.argmax()), 2)
    untold = why_no_life(result)
    life = None if untold else min(scaled(1.0))
    scene = result.about.get("scene") or "run"
    return Evidence(
        life,
        None,
        None,
        f"rivet {k + 1}, {('head', 'middle')[place]}",
        "of one run: more seeds or a mission give its interval",
        scaled,
        largest_amplitudes([(matrix, laws)]),
        knees_of(None, laws),
        {scene: result},
        scene,
        k + 1,
        worse_places(damage),
        untold,
        raceways,
    )


def why_no_life(result):
    """Why no life follows from a run that is taken to go on as it did; "" if one does."""
    if broken := breaks(result):
        k, place, t = broken[0]
        return f"rivet {k} broke in the {place} at {1e3 * t:.4g} ms: loads before and after are not alike"
    return "" if life_is_known(result) else "the rivets' stress rests on closed forms"


# Verdict --------------------------------------------------------------------------------------------------------------


def judged(evidence, target):
    """State, headline and reason, of rivets and raceways together; target: hours or None."""
    if evidence.life is None:
        return "open", "No life can be told", evidence.untold
    found, life = evidence.raceways, hours_text(evidence.life)
    of_raceways = f"raceways {life_text(found)}"
    if target is None:
        return "", f"Life of the rivets {life}", f"{of_raceways}; no target was given (--target)"
    wanted = hours_text(target)
    state, reason = rivets_judged(evidence, target)
    states = [state, *([] if found.untold else [raceways_judged(found, target)])]
    worst = next(each for each in ("bad", "open", "good") if each in states)
    verdict = {"bad": f"Misses the target of {wanted}", "open": f"Target of {wanted} not safe"}
    meets = f"{'Rivets meet' if found.untold else 'Meets'} the target of {wanted}"
    return worst, verdict.get(worst, meets), f"rivets {reason}; {of_raceways}"


def rivets_judged(evidence, target):
    """State and reason of the rivets against a target [h]."""
    life, low, high = (
        hours_text(x) for x in (evidence.life, evidence.low or evidence.life, evidence.high or evidence.life)
    )
    if evidence.life < target:
        sure = evidence.high is not None and evidence.high < target
        return "bad", f"{life}, even the upper end of the interval, {high}, is below it" if sure else life
    if evidence.low is not None and evidence.low < target:
        return "open", f"{life}, but the interval begins at {low}"
    return "good", life + (f", at least {low}" if evidence.low else "")


def raceways_judged(found, target):
    """State of Raceways against a target [h]: open where it hangs on an assumed cleanliness."""
    return "good" if min(found.lives) >= target else "bad" if max(found.lives) < target else "open"


def reserve(evidence, place, target):
    """Factor of all stresses at which the head (0) or the middle (1) just reaches the target; an end of SCALES if it is
    beyond.
    """
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
            f"{hours_text(evidence.life)} ({evidence.interval}), {evidence.place}",
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
        text = (
            f"{x:.3g} times the stress" if SCALES[0] * 1.01 < x < SCALES[1] / 1.01 else f"over {x:.2g} times the stress"
        )
        return Check(title, amplitude, f"{text} at the target", 1.0 / x, "good" if x >= 1.0 else "bad")
    if evidence.knees[place] is None:
        return Check(title, amplitude)
    return Check(
        title,
        amplitude,
        f"S–N curve's knee {1e-6 * evidence.knees[place]:.3g} MPa",
        evidence.amplitudes[place] / evidence.knees[place],
    )


def raceway_checks(evidence, target):
    """Life of the raceways, and their least load with the cage's slip."""
    found = evidence.raceways
    if found.untold:
        return
    lives = found.lives
    yield Check(
        "Raceways",
        life_text(found),
        f"at least {hours_text(target)}" if target else "",
        target / min(lives) if target else None,
        raceways_judged(found, target) if target else "",
    )
    if math.isfinite(least := found.least_load):
        slips = [slip for result in evidence.results.values() if (slip := mean_slip(result)) is not None]
        slip = f", cage slip up to {100.0 * max(slips):.2g} %" if slips else ""
        state = "good" if least >= 1.0 and max(slips, default=0.0) <= SLIP else "open"
        allowed = f"minimum load; slip {100.0 * SLIP:.0f} %"
        yield Check("Load, slip", f"{least:.3g} times the minimum load{slip}", allowed, None, state)


def mean_slip(result):
    """Mean slip of the cage after settling, None if it was not recorded."""
    slip = result.data.get("cage.slip_ratio")
    return None if slip is None else abs(float(slip[settled(result)].mean()))


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
        yield Check(
            "Oil film/roughness",
            f"{value:.2g} ({race} race{where})",
            f"at least {MIXED:g}, below it asperities carry",
            None,
            state,
        )


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


def assumptions(result, decides=None):
    """The strongest assumptions with their range and effect, and where that is from; decides: a Sensitivity."""
    if decides:
        name = decides.responses[0]
        unit, factor, _ = display_of(name)
        indices, rows = decides.morris[name], []
        for k in decides.ranked[:MOST_ASSUMED]:
            factor_name = decides.factors[k]
            own_unit, scale, offset = display_of(factor_name)
            ends = decides.ranges.get(factor_name)
            span = " … ".join(f"{scale * end + offset:.3g}" for end in ends) if ends else "–"
            value = result.parameters.get(factor_name)
            shown = f"{scale * value + offset:.3g}" if isinstance(value, float) else "–"
            effect = f"{factor * indices['mu_star'][k]:.2g} {unit}".strip()
            rows.append((factor_name, f"{shown} {own_unit}".strip(), f"{span} {own_unit}".strip(), effect))
        return tuple(rows), f"mean change of {name} over the range, by the study {decides.name}"
    rows = list(assumed_rows(result))[:MOST_ASSUMED]
    return tuple(
        (row.name, *row.words, f"{row.effect.change} of stress" if row.effect.change else "–") for row in rows
    ), f"change of the worst head's stress over the usual range, {measured_in(rows)}"


# The sheet ------------------------------------------------------------------------------------------------------------


def make_sheet(name, description, basis, evidence, target=None, decides=None, parts=(), remarks=(), files=()):
    """The Sheet of some Evidence; target: life [h] or None; files: paths whose digests stand on it."""
    worst = evidence.results[evidence.worst]
    rows, source = assumptions(worst, decides)
    found, parts = tuple(checks(evidence, target)), tuple(parts[:MOST_PARTS])
    limits = list(limits_crossed(evidence.results))
    if len(limits) > MOST_LIMITS:
        limits = [*limits[: MOST_LIMITS - 1], (True, f"{len(limits) - MOST_LIMITS + 1} others")]
    return Sheet(
        clipped(name, 60),
        clipped(description, CHARACTERS),
        fitted({key: text for key, text in basis.items() if key not in ("FMU", "scene")}, free_lines(found, parts)),
        judged(evidence, target),
        found,
        tuple(limits),
        rows,
        source,
        {
            "where": charts.svg(
                lambda fig: rivets_chart(fig, evidence.damage, evidence.rivet),
                (2.5, 2.0),
                "Damage of the rivets on the circle",
            ),
            "when": charts.svg(
                lambda fig: history_chart(fig, worst, evidence.rivet),
                (4.9, 2.0),
                "Stress of the worst rivet over time",
            ),
        },
        f"rivet {evidence.rivet}" + (f", {clipped(evidence.worst, 28)}" if len(evidence.results) > 1 else ""),
        parts,
        tuple(clipped(text, 150) for text in [*filter(None, [table_note(worst)]), *remarks][:MOST_REMARKS]),
        tuple(
            (clipped(path.name, 40), hashlib.sha256(path.read_bytes()).hexdigest()[:16]) for path in map(Path, files)
        ),
    )


def clipped(text, length):
    """A text of at most this length, cut between words where there are some."""
    text = str(text)
    if len(text) <= length:
        return text
    kept = text[: length - 1]
    if not text[length - 1].isspace() and " " in kept:
        kept = kept[: kept.rindex(" ")]
    return f"{kept.rstrip(' ,;:(')}…"


def free_lines(checks, parts):
    """Lines that the rows of a sheet with fewer checks or parts of a mission leave to the basis."""
    return MOST_CHECKS - len(checks) + MOST_PARTS - len(parts) + (0 if parts else 1)


def fitted(texts, more=0):
    """Texts of the basis, the longest ones clipped line by line until all of them fit their place and `more` lines."""
    texts = dict(texts)
    lines = {key: -(-len(text) // CHARACTERS) for key, text in texts.items()}
    while sum(lines.values()) > max(LINES + more, len(lines)):
        longest = max(lines, key=lines.get)
        lines[longest] -= 1
        texts[longest] = clipped(texts[longest], lines[longest] * CHARACTERS)
    return texts


def rivets_chart(fig, damage, rivet):
    """The circle of rivets at the start, seen from +X, coloured by their damage against the largest, the one that
    fails first marked.
    """
    ax = fig.subplots()
    share = np.array(damage) / (max(damage) or 1.0)
    angle = 2.0 * np.pi * (np.arange(len(share)) + 0.5) / len(share)
    y, z, k = np.cos(angle), np.sin(angle), rivet - 1
    ax.add_patch(plt.Circle((0, 0), 1.0, fill=False, color=MUTED, lw=6, alpha=0.35))
    dots = ax.scatter(y, z, s=70, c=share, cmap="viridis", vmin=0.0, vmax=1.0, edgecolor=FORCE, lw=0.5, zorder=3)
    ax.scatter(y[k], z[k], s=170, facecolor="none", edgecolor=HEAD, lw=1.6, zorder=4)
    for j in range(len(share)):
        ax.text(0.72 * y[j], 0.72 * z[j], str(j + 1), ha="center", va="center", fontsize=8)
    ax.set(aspect="equal", xlim=(-1.25, 1.25), ylim=(-1.25, 1.25), xticks=[], yticks=[])
    ax.grid(False)
    for side in ax.spines.values():
        side.set_visible(False)
    fig.colorbar(dots, ax=ax, label="damage, largest = 1", pad=0.02, shrink=0.85).outline.set_visible(False)


def history_chart(fig, result, rivet):
    """Stress of head and middle of a rivet after settling: largest and smallest value in each stretch."""
    ax, k = fig.subplots(), rivet
    late = settled(result)
    names = {"head": f"rivet[{k}].sigma_head", "mid": f"rivet[{k}].sigma_mid"}
    data = {"time": result.data["time"][late]} | {
        key: 1e-6 * np.maximum(result.data[name], result.data.get(f"{name}_peak", result.data[name]))[late]
        for key, name in names.items()
        if name in result.data
    }
    few = charts.thinned(replace(result, data=data), 300).data
    for key, colour, label in (("head", HEAD, "head fillet"), ("mid", MIDDLE, "middle")):
        if key in few:
            ax.plot(1e3 * few["time"], few[key], color=colour, lw=0.6, label=label)
    ax.set(xlabel="time [ms]", ylabel="MPa")
    ax.margins(x=0.0)
    ax.legend(ncols=2, loc="lower right", bbox_to_anchor=(1.0, 1.0))


def part_lines(life):
    """Points and events by their share in the damage: (name, load, speed, in the mission, share)."""
    share = dict(zip(life.kept, life.estimate.shares, strict=True))
    order = sorted(range(len(life.mission.parts)), key=lambda i: -share.get(i, 0.0))
    rows = list(part_rows(life))
    shown = [rows[i] for i in order]
    lines = [(clipped(row[0], 24), clipped(row[1], 64), row[2], row[3], row[7]) for row in shown]
    if len(lines) > MOST_PARTS:
        rest = sum(share.get(i, 0.0) for i in order[MOST_PARTS - 1 :])
        lines = [*lines[: MOST_PARTS - 1], (f"{len(lines) - MOST_PARTS + 1} others", "", "", "", share_text(rest))]
    return lines


def mission_sheet(life, evidence, target=None, decides=None, files=(), remarks=()):
    """The Sheet of a mission; remarks: sentences beside the mission's own warnings."""
    mission = life.mission
    hours, passes = mission_text(life)
    return make_sheet(
        mission.name,
        mission.description,
        dict(mission.basis) | {"mission": f"{hours}, {passes}"},
        evidence,
        target,
        decides,
        part_lines(life),
        (*remarks, *mission.warnings),
        files,
    )


def write_sheet(sheet, path):
    """Write the page, whole or not at all; returns its path."""
    return save_page(
        path,
        "sheet.html",
        sheet=sheet,
        style="sheet.css",
        states=STATES,
        figure=figure,
        version=__version__,
        date=datetime.now(UTC).isoformat(timespec="minutes").replace("+00:00", " UTC"),
    )


def result_sheet(result, path, fmu=None, target=None, decides=None, cleanliness=None):
    """The Sheet of a file of results; fmu: path of the FMU for its digest and ratings, None if it is not there."""
    about = result.about
    basis = dict(about.get("basis", {}))
    if "S-N curve" not in basis:
        basis["S-N curve"] = curve(result)
    raceways = raceways_of(Model(fmu) if fmu else None, result, cleanliness)
    evidence, changed = of_result(result, path, raceways), "; ".join(change_lines(result))
    if changed:
        changed = f"Changed {changed}"
    return make_sheet(
        about.get("scene") or Path(path).stem,
        about.get("description", ""),
        basis,
        evidence,
        target,
        decides,
        remarks=[note for note in (alone_note(result), changed) if note],
        files=[*filter(None, [fmu]), path],
    )
