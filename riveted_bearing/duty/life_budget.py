"""The error budgets of a mission's life: of the stress in the case that decides, and of the damage in decades.

The step's bias is that of finer runs of the deciding case, the seeds' interval that of the life (confidence.py) unless all
seeds of the case fall on one motion; table, assumed values and model as in running/budget.py.
"""

import math
from dataclasses import replace
from typing import Any

import numpy as np

from ..bearing.assumed import all_assumed
from ..running.accuracy import DECADES, FIGURES, accurate, found_of, with_settings
from ..running.budget import Budget, budget_of
from ..running.runner import origin_of
from .assess import Life, Runs, places, used_cases

STRESS = "stat.sigma_head_p999"


def with_budgets(life: Life, runs: Runs) -> Life:
    """The Life with its Budgets."""
    return replace(life, budgets=budgets_of(life.mission, life.estimate, life.kept, runs))


def budgets_of(mission: Any, found: Any, kept: Any, runs: Runs) -> dict[str, Budget]:
    """The Budgets of an Estimate by figure; that of the damage only where there is some."""
    c = int(used_cases(mission.duty, list(kept))[int(np.argmax(found.case_shares))])
    scene, model = mission.cases[c].scene, runs.model
    keys = [key for s in range(mission.settings["max_seeds"]) if (key := runs.keys[c, s]) in runs.figures]
    fine = runs.finer(c)
    parameters = {name: model.default(variable) for name, variable in model.parameters.items()} | scene.parameters
    known = origin_of(model, scene), runs.figures[keys[0]], parameters
    rows = list(all_assumed(known[0], parameters))

    def resolved(figure, value):
        blocks = [runs.figures[key].get(f"blocks.{figure}", math.nan) for key in keys]
        plain, finer = ([value(key) for key in some] for some in (keys, fine))
        return found_of(figure, plain, finer, [] if np.isnan(blocks).any() else blocks, mission.settings["confidence"])

    stress = resolved("stress", lambda key: runs.figures[key][STRESS])
    budgets = {"stress": budget_of("stress", stress, *known, rows)}
    damages = {
        key: places(runs.damages[key][None], mission.settings["rivets"])[0, found.place] for key in [*keys, *fine]
    }
    if math.isfinite(found.life) and min(damages.values()) > 0.0:
        of_case = resolved(DECADES, lambda key: math.log10(damages[key]))
        seeds = found.half_width / math.log(10.0)
        value = -math.log10(found.life)
        damage = replace(
            of_case, value=value, plain=value, seeds=max(seeds, of_case.seeds) if of_case.one_motion else seeds
        )
        budgets[DECADES] = budget_of(DECADES, damage, *known, rows)
    return budgets


def to_accuracy(mission: Any, model: Any) -> tuple[Any, list[str]]:
    """The Mission with the steps that its accuracy needs, and a sentence on each case that is not within it."""
    cases, told, chosen = [], [], {}
    for case in mission.cases:
        asked = case.scene.accuracy
        if asked is not None:
            plain = replace(case.scene, accuracy=None)
            reached = accurate(model, plain, asked)
            told += [
                f"{mission.parts[case.part].name}: {FIGURES[name][0]}: {why}" for name, why in reached.missed.items()
            ]
            case = replace(case, scene=with_settings(plain, reached.settings))
            chosen[case.part] = case.scene
        cases.append(case)
    if not chosen:
        return mission, []
    parts = [replace(part, scene=chosen.get(i, part.scene)) for i, part in enumerate(mission.parts)]
    return replace(mission, cases=tuple(cases), parts=tuple(parts)), told
