"""What a reader of a mission's life has to know: what was simulated and what left out, and which effects are not in it."""

import math
from typing import Any

import numpy as np

from ..base.units import hours_text
from ..running.effects import in_words
from . import raceways
from .assess import Life, Runs, part_duty
from .miner import NO_DAMAGE, class_factors
from .page import ends_of, open_ends, percent, width_text

ENOUGH = 0.95  # of the damage that the FMU counts: with less in the matrices the life is too long
WIDE, MATTERS = 1.3, 0.05  # factor of a class, and share in the damage from which it is named


def wide_classes(life):
    """Names of the classes of a record whose width matters."""
    duty, found = part_duty(life.mission.duty, list(life.kept)), life.estimate
    logs = np.log(np.maximum(found.rates, NO_DAMAGE))
    factors = np.broadcast_to(class_factors(duty, logs), (len(duty.hours), len(life.kept), logs.shape[-1]))[
        0, :, found.place
    ]
    return [
        life.mission.parts[i].name
        for i, factor, share in zip(life.kept, factors, found.shares, strict=True)
        if factor > WIDE and share > MATTERS
    ]


def matrix_warnings(runs: Runs) -> Any:
    """Sentences on matrices of [sn] that miss damage, because stress between the points is not in them."""
    if "sn" not in runs.mission.document or (found := runs.counted()) >= ENOUGH:
        return []
    step = max(case.scene.step for case in runs.mission.cases)
    return [
        f"the rainflow matrices at simulation.step = {step_text(step)} find {100 * found:.3g} % of the damage that the FMU "
        f"counts: life by [sn] is too long; take {step_text(0.1 * step)}"
    ]


def step_text(step):
    """A communication step as a mission's file has it."""
    return f'"{1e3 * step:.3g} ms"'


def oil_in_pockets(mission, model):
    """A sentence on the oil that the pockets of a mission have, of the FMU's own filling where no case sets one."""
    name = "cage.pocket_filling"
    given = sorted({case.scene.parameters[name] for case in mission.cases if name in case.scene.parameters})
    if given:
        texts = " to ".join(f"{value:g}" for value in dict.fromkeys((given[0], given[-1])))
        return f"Oil in the pockets: {name} = {texts} (0 dry, 1 flooded)."
    return (
        f"The filling of the pockets with oil is assumed to be the FMU's {name} (0, dry, unless its build changed it), because "
        "none has been measured; flooded pockets live longer: compare-designs with cage.pocket_filling=0 and =1 has both lives."
    )


def notes(life: Life, runs: Runs, scatter: Any = None) -> Any:
    """Sentences on a Life, its Runs and, if there are tolerances, the Scatter of bearings."""
    mission, found = life.mission, life.estimate
    settings = mission.settings
    reached = f"{percent(found.half_width)}, wanted {100 * settings['half_width']:g} %"
    if open_ends(*ends_of(life)):
        sentences = [f"The interval of life is {width_text(life)}; max_seeds = {settings['max_seeds']} was reached."]
    elif found.half_width > math.log1p(settings["half_width"]):
        sentences = [
            f"The interval is wider than asked for ({reached} of life): max_seeds = {settings['max_seeds']} was reached."
        ]
    else:
        sentences = [f"The interval is as narrow as asked for: {reached} of life."]
    if life.bounds:
        names = ", ".join(mission.parts[i].name for i in life.bounds)
        total = 100.0 * sum(life.bounds.values()) * found.life
        sentences.append(
            f"Not simulated, because they have less than {total:.2g} % of the damage by the bound that stress changes no faster than loads and "
            f"the square of speed, with ten times the damage on top: {names}. The lower end of the interval holds this bound."
        )
    if settings["rivets"] == "each":
        sentences.append(
            "Each rivet is taken to keep its place: in a run the balls and the cage stay as the start has arranged them. "
            'With rivets = "alike" in [life], all rivets take all places in turn.'
        )
    if wide := wide_classes(life):
        sentences.append(
            f"The classes of the record are wide: inside {', '.join(wide)} the damage rate changes so much that its mean is taken as more than "
            f"{WIDE:g} times that at the mean values. Compare with twice the bins."
        )
    sentences += raceways.sentences(mission.raceways())
    if idle := mission.idle():
        sentences.append(f"{in_words(idle)}.")
    if "sn" in mission.document:
        sentences.append(
            f"Damage by the S-N curve of [sn] from rainflow matrices of the communication points; with the FMU's own law these matrices find "
            f"{100 * runs.counted():.3g} % of the damage that the FMU counts at every internal step."
        )
    if scatter:
        law = scatter.law
        low, high = law.b10_interval
        share = f" The seeds have {100 * min(scatter.noise, 1.0):.3g} % of the scatter."
        noise = "" if math.isnan(scatter.noise) else share
        sentences.append(
            f"Over {len(scatter.lives)} bearings within their tolerances: B10 {hours_text(law.b10)} ({hours_text(low)} to {hours_text(high)} at "
            f"{100 * law.confidence:g} %), Weibull shape {law.beta:.3g}, characteristic life {hours_text(law.eta)}.{noise}"
        )
    sentences.append(oil_in_pockets(mission, runs.sweep.model))
    sentences.append(f"Processor time of the runs: {sum(runs.cost.values()):.0f} s in {len(runs.cost)} runs.")
    return sentences
