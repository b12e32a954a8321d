"""Life of the raceways beside the rivets': ISO 281 and ISO/TS 16281 at one operating point and over a mission.

    L_10   = (C/P)^3                      ISO 281: P = X F_r + Y F_a by load_ratings.equivalent_load
    L_10r                                 ISO/TS 16281: by the ball loads with clearance, tilt and moments, quasi_static.QuasiStatic.L_10r
    L_10m  = a_ISO L_10                   a_ISO by kappa and e_C C_u/P, of L_10r with P_ref
    1/L_h  = sum of w_i n_i/L_i           Palmgren-Miner over revolutions: w_i share of the hours, n_i revolutions an hour

90 % of equal bearings reach such a life.
"""

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..base.errors import UserError, shortlist
from ..base.units import hours_text
from ..bearing.case import Case
from ..running.inputs import histories_of
from ..running.scene_case import scene_case

MINIMUM_LOAD = 0.01  # of C: the usual rule of makers for ball bearings
ASSUMED = "normal"  # cleanliness where nobody gave one
SAMPLES = 24  # of a point whose inputs vary
KINDS = {"L_10": "ISO 281", "L_10m": "ISO 281", "L_10r": "ISO/TS 16281", "L_10mr": "ISO/TS 16281"}
CODE = re.compile(r"(?:[\d-]+/)?(\d+)/\d+( filtered)?")  # of ISO 4406: particles from 4, 6 and 14 um on


@dataclass(frozen=True)
class Rated:
    """At an operating point: turns of the rings [1/h], load, least load [N], kappa (nan at rest), lives [10^6] by KINDS."""

    turns: float
    load: float
    least: float
    kappa: float
    lives: dict

    @property
    def slips(self):
        """Whether the bearing turns under less than its minimum load."""
        return self.turns > 0.0 and self.load < self.least


def rated(case: Case) -> Any:
    """The Rated of a Case; UserError without load ratings or an equilibrium."""
    from riveted_bearing.bearing.load_ratings import equivalent_load, fatigue_load_limit, life_factor

    if (reason := why_unrated(case)) is not None:
        raise UserError(f"{case.designation}: {reason}")
    bearing, load, values = case.bearing, case.load, case.values
    F_r, F_a = math.hypot(load.F_y, load.F_z), abs(load.F_x)
    C, C_0 = (case.catalogue[name] for name in ("C", "C_0"))
    C_u = case.catalogue.get("C_u") or fatigue_load_limit(C_0, values["bearing.d_m"])
    P = equivalent_load(F_r, F_a, C_0, bearing.D / bearing.d_m)
    L_10 = (C / P) ** 3 if P else math.inf
    state = case.standard_equilibrium()
    kappa = case.kappa
    e_C = contamination(case.cleanliness, kappa, bearing.d_m)

    def modified(life, equivalent):
        return life * life_factor(kappa, e_C * C_u / equivalent) if equivalent > 0.0 and not math.isnan(kappa) else life

    lives = {"L_10": L_10, "L_10m": modified(L_10, P)}
    lives |= {"L_10r": state.L_10r, "L_10mr": modified(state.L_10r, state.P_ref)}
    least = case.catalogue.get("minimum_load", MINIMUM_LOAD * C)
    turns = abs(load.omega - load.omega_e) * 3600.0 / (2.0 * math.pi)
    return Rated(turns, max(F_r, F_a), least, kappa, lives)


def why_unrated(case: Case) -> Any:
    """Why a Case has no rating life; None if it has one."""
    if not {"C", "C_0"} <= case.catalogue.keys():
        return "the load ratings C and C_0 are not known: build the FMU from a bearing file or a designation"
    if case.values.get("ring.motion") == "prescribed":
        return "the motion of the inner ring is prescribed, so that its load is not known before a run"
    return None


def too_little_load(case: Case) -> Iterator[Any]:
    """A sentence if the bearing turns under less than its minimum load: balls then skid."""
    if why_unrated(case) is None and (found := rated(case)).slips:
        rule = "" if "minimum_load" in case.catalogue else "0.01 C = "
        yield (
            f"the load of {found.load:.3g} N is less than the minimum load {rule}{found.least:.3g} N: "
            "balls may skid, so that frequencies and life are not those of rolling"
        )


# Cleanliness ----------------------------------------------------------------------------------------------------------


def cleanliness_of(value: Any) -> Any:
    """A name of load_ratings.CLEANLINESS, or e_C, from "normal", "20/17/14", "-/15/12 filtered", 0.4."""
    from riveted_bearing.bearing.load_ratings import CLEANLINESS

    try:
        value = float(value) if not isinstance(value, bool) else math.nan
    except (TypeError, ValueError):
        pass
    else:
        if 0.0 <= value <= 1.0:
            return value
        raise UserError(f"{value:g} is no contamination factor e_C: from 0 to 1 is allowed")
    text = " ".join(str(value).lower().split())
    if text in CLEANLINESS:
        return text
    if code := CODE.fullmatch(text):
        classes = {int(own[1]): name for name in CLEANLINESS if (own := CODE.fullmatch(name)) and own[2] == code[2]}
        if found := next((name for limit, name in sorted(classes.items()) if int(code[1]) <= limit), None):
            return found
    raise UserError(f"allowed: e_C from 0 to 1, {', '.join(CLEANLINESS)}")


def contamination(cleanliness, kappa, d_m):
    """The factor e_C of a cleanliness, of ASSUMED for None."""
    from riveted_bearing.bearing.load_ratings import contamination_factor

    return cleanliness if isinstance(cleanliness, float) else contamination_factor(cleanliness or ASSUMED, kappa, d_m)


def in_words(cleanliness: Any) -> str:
    """A cleanliness in words."""
    if cleanliness is None:
        return f"{ASSUMED} cleanliness, assumed"
    return f"e_C = {cleanliness:g}" if isinstance(cleanliness, float) else f"cleanliness {cleanliness}"


# Mission --------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Raceways:
    """(name, hours, Rated over a varying point) of points; cleanliness: None if nobody gave one; untold: why nothing is known."""

    points: tuple = ()
    cleanliness: object = None
    untold: str = ""

    def life(self, kind):
        """Life [h] of a kind of KINDS."""
        hours = sum(hours for _, hours, _ in self.points)
        rates = (np.mean([each.turns / (1e6 * each.lives[kind]) for each in samples]) for *_, samples in self.points)
        damage = sum(own * float(rate) for (_, own, _), rate in zip(self.points, rates, strict=True))
        return hours / damage if damage > 0.0 else math.inf

    @property
    def lives(self):
        """Lives [h] that a target is held against: the modified one and, with an assumed cleanliness, the plain one."""
        return [self.life(kind) for kind in (("L_10mr", "L_10r") if self.cleanliness is None else ("L_10mr",))]

    @property
    def kappas(self):
        """Least and largest kappa, nan at rest."""
        found = [each.kappa for _, _, samples in self.points for each in samples if not math.isnan(each.kappa)]
        return (min(found), max(found)) if found else (math.nan, math.nan)

    @property
    def slips(self):
        """Names of the points under less than the minimum load."""
        return [name for name, _, samples in self.points if any(each.slips for each in samples)]

    @property
    def least_load(self):
        """Least load over the minimum load, inf at rest."""
        loads = (each.load / each.least for *_, s in self.points for each in s if each.turns > 0.0)
        return min(loads, default=math.inf)


def of_points(model, points, cleanliness=None):
    """Raceways of a Model's points (name, hours, SI values by full name, histories that vary, (begin, end) [s])."""
    own, known, found = replace(scene_case(None, model), cleanliness=cleanliness), {}, []
    try:
        for name, hours, values, histories, (begin, end) in points:
            times = begin + (end - begin) * (np.arange(SAMPLES) + 0.5) / SAMPLES if histories else [begin]
            samples = []
            for t in times:
                now = values | {name: float(history(t)) for name, history in histories.items()}
                key = frozenset(now.items())
                if key not in known:
                    known[key] = rated(replace(own, values=own.values | now))
                samples.append(known[key])
            found.append((name, hours, tuple(samples)))
    except UserError as problem:
        return Raceways((), cleanliness, str(problem))
    return Raceways(tuple(found), cleanliness)


def of_parts(model, parts, cleanliness=None):
    """The Raceways of the points of a mission; events are too short to count."""

    def point(part):
        values = {name: value for name, value in part.values.items() if value is not None}
        varying = {name: part.scene.inputs[name] for name, value in part.values.items() if value is None}
        settle = values.get("start.settle", model.default(model.parameters["start.settle"]))
        return part.name, part.weight, values, varying, (settle, part.scene.t_end if varying else settle)

    return of_points(model, [point(part) for part in parts if not part.event], cleanliness)


def of_result(model, result, cleanliness=None):
    """The Raceways under a Result that goes on as it did; model: its FMU, None if it is not there."""
    if model is None:
        return Raceways((), None, "the run's FMU is not there, which has the load ratings")
    begin, end = result.parameters.get("start.settle", 0.0), float(result.data["time"][-1])
    inputs = histories_of(result.about)
    varying = {name: history for name, history in inputs.items() if len(history.t) > 1}
    constant = {name: float(history(0.0)) for name, history in inputs.items() if name not in varying}
    values = {name: value for name, value in result.parameters.items() if not isinstance(value, bool)}
    return of_points(model, [("run", 1.0, values | constant, varying, (begin, end))], cleanliness)


# In words -------------------------------------------------------------------------------------------------------------


def life_text(found):
    """Lives of Raceways and what they rest on, in a few words."""
    if found.untold:
        return f"not judged: {found.untold}"
    return f"L_10mr {hours_text(found.life('L_10mr'))} ({in_words(found.cleanliness)}), L_10r {hours_text(found.life('L_10r'))}"


def card(found: Any) -> Any:
    """Life of Raceways to see first and what it is, for a page: (value, remark)."""
    if found.untold:
        return "not judged", found.untold
    modified, plain = (hours_text(found.life(kind)) for kind in ("L_10mr", "L_10r"))
    return modified, f"L_10mr · {in_words(found.cleanliness)} · L_10r {plain}"


def sentences(found):
    """What a reader of Raceways has to know."""
    if found.untold:
        yield f"The life is that of the rivets only: {found.untold}."
        return
    low, high = found.kappas
    kappa = "" if math.isnan(low) else f", kappa {low:.2g}" + (f" to {high:.2g}" if high > 1.005 * low else "")
    of_281, of_16281 = (
        f"{', '.join(f'{kind} {hours_text(found.life(kind))}' for kind, own in KINDS.items() if own == standard)} ({standard})"
        for standard in dict.fromkeys(KINDS.values())
    )
    yield (
        f"Raceways, 90 % of bearings: {of_281}; {of_16281}; m: with a_ISO by {in_words(found.cleanliness)}"
        f"{kappa}. Events do not count in it."
    )


def slip_warning(found):
    """Sentences on points under less than the minimum load."""
    if found.slips:
        yield (
            f"{'points' if len(found.slips) > 1 else 'point'} {shortlist(found.slips, 4)}: less than the minimum load "
            f"({found.least_load:.2g} of it), so that balls may skid: rated lives are not those of skidding"
        )


def record(found):
    """Raceways for JSON: lives in hours, None where one is endless or nothing is known."""
    if found.untold:
        return {"untold": found.untold}
    hours = {f"{kind}_h": finite(found.life(kind)) for kind in KINDS}
    return hours | {
        "cleanliness": found.cleanliness,
        "kappa": [finite(kappa) for kappa in found.kappas],
        "below_minimum_load": found.slips,
    }


def finite(value):
    """A number, None for infinity and nan."""
    return float(value) if math.isfinite(value) else None
