"""Runs that a mission needs, and the points that are interpolated between them."""

from dataclasses import dataclass, field, replace

import numpy as np

from ..base.errors import UserError
from ..running.scene import Scene
from ..studies.sweep_file import key_of

PRELOAD = "joint.preload"


@dataclass(frozen=True)
class Case:
    """What is simulated with several seeds: part number i with the factor of preload at hour number j."""

    part: int
    scene: Scene = field(repr=False)


def cases_of(path, parts, factors, model):
    """The Cases of all parts at all factors of preload, equal ones once, and the blends of Duty."""
    simulated = [i for i, part in enumerate(parts) if part.scene is not None]
    mixtures = {i: mixture(path, parts, i, simulated) for i, part in enumerate(parts) if part.scene is None}
    cases, places = [], {}
    for j, factor in enumerate(factors):
        for i in simulated:
            scene = loosened(parts[i].scene, factor * parts[i].factor, model)
            key = (parts[i].event, key_of(scene, ""))
            if key not in places:
                places[key] = len(cases)
                cases.append(Case(i, scene))
            places[i, j, "at"] = places[key]
    blends = np.zeros((len(factors), len(parts), len(cases)))
    for j in range(len(factors)):
        for i in range(len(parts)):
            for source, share in mixtures.get(i, {i: 1.0}).items():
                blends[j, i, places[source, j, "at"]] += share
    return cases, blends


def slopes_of(parts, blends):
    """Duty.slopes: difference quotients between neighbouring classes times their spread; None without a record."""
    classes = {part.cell: i for i, part in enumerate(parts) if part.cell}
    if not classes:
        return None
    axes = len(next(iter(classes)))
    slopes = np.zeros((axes, *blends.shape))
    for cell, i in classes.items():
        for axis in range(axes):
            line = sorted(
                other for other in classes if other[:axis] + other[axis + 1 :] == cell[:axis] + cell[axis + 1 :]
            )
            place = line.index(cell)
            low, high = classes[line[max(place - 1, 0)]], classes[line[min(place + 1, len(line) - 1)]]
            if low != high:
                apart = parts[high].means[axis] - parts[low].means[axis]
                slopes[axis, :, i] = (blends[:, high] - blends[:, low]) * parts[i].spreads[axis] / apart
    return slopes


def loosened(scene, factor, model):
    """The scene with its preload times the factor."""
    if factor == 1.0:
        return scene
    return replace(scene, parameters=scene.parameters | {PRELOAD: factor * scene.value(PRELOAD, model)})


def mixture(path, parts, i, simulated):
    """Shares {part: weight} of simulated points around point i, which differ in numbers alone, whose logarithms of rates make
    that of point i; UserError if it is not between them.
    """
    from scipy.interpolate import griddata
    from scipy.spatial import QhullError

    own = parts[i].values
    comparable = [
        q
        for q in simulated
        if not parts[q].event
        and parts[q].values.keys() == own.keys()
        and all(is_close_kind(parts[q].values[n], own[n]) for n in own)
    ]
    axes = [n for n in own if len({parts[q].values[n] for q in comparable} | {own[n]}) > 1]
    outside = UserError(
        f"{path}: point {parts[i].name}: interpolate: not between the simulated points ({', '.join(axes) or 'none like it'}): simulate it"
    )
    if not axes or len(comparable) <= len(axes):
        raise outside
    grid = np.array([[parts[q].values[n] for n in axes] for q in comparable])
    try:
        shares = griddata(grid, np.eye(len(grid)), [[own[n] for n in axes]], rescale=True).ravel()
    except QhullError:
        raise outside from None
    if np.isnan(shares).any():
        raise outside
    return {q: float(share) for q, share in zip(comparable, shares, strict=True) if share > 0.0}


def is_close_kind(one, other):
    """Whether two values may differ and yet be interpolated: numbers; texts and histories must be equal."""
    numbers = all(isinstance(value, (int, float)) for value in (one, other))
    return numbers or (one is not None and one == other)
