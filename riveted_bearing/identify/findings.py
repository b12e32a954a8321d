"""Findings of a failure analyst, and the causes that may explain them; docs/failure.md has an example.

What is missing is not known.  "about" makes an uncertainty three times as large, that of the hours a factor of two.
"""

import operator
from dataclasses import dataclass, field
from functools import cached_property, reduce
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from pydantic import Field

from ..base.errors import UserError, refusal, refusing, unknown
from ..base.file_kinds import check_keys
from ..base.schema import Choice, Count, Named, Number, Section, checked, holds, is_list_of
from ..base.units import to_si
from ..design.bench import Seeded
from ..running.fmu import Model
from ..running.scene import Scene
from .candidates import Inspection, OwnCause, candidates, scales_at

HOURS = {"h": (1.0, 0.0), "d": (1.0 / 24.0, 0.0), "years": (1.0 / 8766.0, 0.0)}
ABOUT, ABOUT_HOURS = 3.0, np.log10(2.0)
LOOSE = 0.3  # of the nominal preload: a rivet that rattles
CASCADE = {  # keys of the cascade files of earlier versions, which `causes --order` reads apart from these
    "case": "`riveted-bearing causes --order` has no cases: write a file for each, with its [parameters] and [inputs]",
    "until": "write within in its place",
}
NONE = "none of these"


def is_of_rivets(value: Any) -> bool:
    """Whether a value is a list of different numbers, or a number of rivets."""
    return (is_list_of([value], int) and value >= 0) or (is_list_of(value, int) and len(set(value)) == len(value))


Rivets = Annotated[Any, holds(is_of_rivets, "a list of different rivets' numbers, or how many there are, is needed")]
Mark = Annotated[str, Choice(("none", "heavy"))]


class Broken(Section):
    """Broken rivets: their numbers, or how many where the numbers are not known."""

    head: Rivets = Field([], description="broken in a head")
    formed: Rivets = Field([], description="of these, in the head that riveting formed")
    set: Rivets = Field([], description="of these, in the head that the rivet had before")
    middle: Rivets = Field([], description="broken in the middle of the shank")
    unknown: Rivets = Field([], description="broken in a place that is not known")
    order: list[Annotated[int, Count()]] = Field([], description="numbers, first to last, as far as known")


class Marks(Section):
    """Wear marks; what is left out is not known."""

    pocket: Mark | None = Field(None, description="in the pockets, where the balls push along the track")
    side: Mark | None = Field(None, description="on the side beams of the pockets, where the balls push along the axis")
    land: Mark | None = Field(None, description="on the lands of the cage")
    face: Mark | None = Field(None, description="on the faces on which the halves meet")


class FindingsFile(Seeded):
    """Why did it break? Findings on broken rivets and candidate causes; all but the file itself may be missing."""

    broken: Broken = Broken()
    loose: Rivets | None = Field(None, description="rivets that hold but rattle; [] for none")
    missing: Rivets | None = Field(None, description="rivets that were never set; [] for none")
    hours: Any = Field(None, description='until the rivets were found broken: "900 h", "about 900 h"')
    within: Annotated[float, Number(HOURS, above=0.0, words="a time above 0 h is needed")] = Field(
        1e5, description="what breaks later is never found; hours; --order follows all breaks without it"
    )
    marks: Marks = Marks()
    measured: Named = Field({}, description="by the name of an inspection, with unit")
    causes: list[str] | None = Field(None, description="names of those that are tried; default: all")
    cause: list[OwnCause] = []
    inspection: list[Inspection] = []
    prior: dict[str, Annotated[float, Number(least=0.0)]] = Field(
        {}, description=f'weight by the name of a cause, "{NONE}" included; default: 1'
    )
    samples: Annotated[int, Count(8)] = Field(32, description="designs of each cause, each with a seed of its own")
    life_decades: Annotated[float, Number(above=0.0)] = Field(
        1.0, description="standard deviation of log10 of the lives: S-N curve and short runs"
    )
    breaks: Annotated[int, Count()] = Field(4, description="breaks that are followed in each design; of --order too")


@dataclass(frozen=True)
class Findings:
    """Checked findings: numbers of rivets by place, None where unknown, and counts; looked: for loose and missing ones; hours:
    (log10, standard deviation) or None; measured: (value, standard deviation).
    """

    looked: frozenset
    counts: dict
    places: dict
    order: tuple
    hours: tuple | None
    within: float
    marks: dict
    measured: dict = field(default_factory=dict)

    @property
    def broken(self):
        """How many are broken."""
        return sum(self.counts[place] for place in ("head", "middle", "unknown"))

    @cached_property
    def gone(self):
        """Numbers of the rivets that are gone, None where they are not known."""
        parts = [self.places[place] for place in ("head", "middle", "unknown", "missing")]
        return None if None in parts else sorted(k for part in parts for k in part)


@dataclass(frozen=True)
class Study:
    """A file of findings checked against its FMU."""

    path: Path
    file: FindingsFile
    findings: Findings
    causes: list
    quantities: dict
    prior: np.ndarray  # of the causes and, last, of none of these
    Z: int


def plan_causes(path: Path, document: dict[str, Any], model: Model, scene: Scene) -> Study:
    """The Study of a document; UserError naming what cannot be used.  scene: the mission's, from which multiples are."""
    for key, way in CASCADE.items():
        if key in document:
            raise UserError(f"{path}: {key}: {way}")
    check_keys(path, document, FindingsFile.model_fields, "file of findings")
    file = checked(FindingsFile, document, path)
    causes, quantities = candidates(path, file, model, scene)
    for name in file.prior:
        if name not in (allowed := [cause.name for cause in causes] + [NONE]):
            raise unknown(f"{path}: prior", "cause", name, allowed)
    prior = np.array([file.prior.get(name, 1.0) for name in [*(cause.name for cause in causes), NONE]])
    if not prior[:-1].sum() > 0.0:
        raise refusal(path, "prior", file.prior, "one cause at least must be possible")
    Z = model.Z
    return Study(path, file, findings_of(path, file, Z, quantities, model), causes, quantities, prior / prior.sum(), Z)


def findings_of(path, file, Z, quantities, model):
    """The Findings of a file, contradictions refused by name."""
    broken = file.broken
    groups = {name: getattr(broken, name) for name in ("head", "middle", "unknown", "formed", "set")}
    groups |= {"loose": file.loose or [], "missing": file.missing or []}
    counts = {name: len(value) if isinstance(value, list) else value for name, value in groups.items()}
    places = {name: value if isinstance(value, list) else (None if value else []) for name, value in groups.items()}
    keys = {name: f"broken.{name}" if name in Broken.model_fields else name for name in groups}
    for name, value in places.items():
        for k in value or ():
            if not 1 <= k <= Z:
                raise refusal(path, keys[name], groups[name], f"rivet {k}: the bearing has the rivets 1 to {Z}")
    apart = ("head", "middle", "unknown", "loose", "missing")
    for i, one in enumerate(apart):
        for other in apart[i + 1 :]:
            if both := sorted(set(places[one] or ()) & set(places[other] or ())):
                raise refusal(path, keys[other], groups[other], f"rivet {both[0]} is in {keys[one]} too")
    if (total := sum(counts[name] for name in apart)) > Z:
        raise refusal(path, "broken", total, f"broken, loose and missing rivets are more than the {Z} of the bearing")
    for name in ("formed", "set"):
        if places["head"] is not None and (other := sorted(set(places[name] or ()) - set(places["head"]))):
            raise refusal(path, keys[name], groups[name], f"rivet {other[0]} is not in broken.head")
    if both := sorted(set(places["formed"] or ()) & set(places["set"] or ())):
        raise refusal(path, "broken.set", groups["set"], f"rivet {both[0]} is in broken.formed too")
    if counts["formed"] + counts["set"] > counts["head"]:
        raise refusal(path, "broken.formed", groups["formed"], "with broken.set more than broken.head")
    known = [places[name] for name in ("head", "middle", "unknown")]
    if len(set(broken.order)) < len(broken.order):
        twice = next(k for k in broken.order if broken.order.count(k) > 1)
        raise refusal(path, "broken.order", broken.order, f"rivet {twice} breaks twice")
    if other := [k for k in broken.order if None in known or k not in reduce(operator.iadd, known, [])]:
        raise refusal(path, "broken.order", broken.order, f"rivet {other[0]} is not among the broken ones")
    hours = None
    if file.hours is not None:
        about, text = is_about(file.hours)
        with refusing(path, "hours", file.hours):
            value = Number(HOURS, above=0.0).read(text)
        if value > file.within:
            raise refusal(path, "hours", file.hours, f"at most within = {file.within:g} h is allowed")
        hours = (np.log10(value), ABOUT_HOURS if about else 0.0)
    measured = {}
    for name, given in file.measured.items():
        if name not in quantities:
            raise unknown(f"{path}: measured", "inspection", name, quantities)
        one = quantities[name]
        about, text = is_about(given)
        with refusing(path, f"measured.{name}", given):
            value = to_si(text, scales_at(one.quantity, model))
        measured[name] = (value, float(one.sd(value)) * (ABOUT if about else 1.0))
    marks = {name: value == "heavy" for name, value in vars(file.marks).items() if value is not None}
    looked = frozenset(name for name in ("loose", "missing") if getattr(file, name) is not None)
    return Findings(looked, counts, places, tuple(broken.order), hours, file.within, marks, measured)


def is_about(value):
    """Whether a value is about so large, and the value."""
    if isinstance(value, str) and value.strip().lower().startswith("about "):
        return True, value.strip()[6:]
    return False, value
