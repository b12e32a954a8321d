"""Measured records of a mission, read in pieces and binned into operating points."""

import numpy as np

from ..base.errors import UserError
from ..base.tables import Table

NOISE = 0.01  # of the range of a column: values of the other sign up to it are none


def edges_of(low, high, bins):
    """Edges of the classes of a column from its extremes; no class has values of both signs, noise apart, because a load
    or a speed and its opposite have no mean that stands for them.

    >>> edges_of(-2.0, 4.0, 3).tolist(), edges_of(-1.0, 1.0, 1).tolist()
    ([-2.0, 0.0, 2.0, 4.0], [-1.0, 0.0, 1.0])
    """
    if min(-low, high) <= NOISE * (high - low):
        return np.linspace(low, high, bins + 1)
    below = max(1, min(round(-bins * low / (high - low)), bins - 1))
    return np.concatenate([np.linspace(low, 0.0, below + 1), np.linspace(0.0, high, max(1, bins - below) + 1)[1:]])


def binned(path, time, columns, bins, gap=None):
    """Time [s] in the classes [P] of a record, their numbers [P, columns], means and standard deviations [P, columns] in SI.

    Each sample holds until the next one, at most for `gap` [s] (None: ten usual intervals).  time, columns: Wanted; bins: of
    each column, see edges_of.  The file is read twice, in pieces.
    """
    table = Table(path)
    clock = table.clock(time, gap)
    low, high = np.full(len(columns), np.inf), np.full(len(columns), -np.inf)
    for rows, block in table.blocks(time, *columns):
        clock.add(rows, block[:, 0])
        low, high = np.minimum(low, block[:, 1:].min(axis=0)), np.maximum(high, block[:, 1:].max(axis=0))
    if not np.all(high >= low):
        raise UserError(f"{path}: no samples")
    width = np.where(high > low, high - low, 1.0)
    edges = [edges_of(*ends, count) for *ends, count in zip(low, high, bins, strict=True)]
    bins = [len(ends) - 1 for ends in edges]
    spent, (sums, squares) = np.zeros(np.prod(bins)), np.zeros((2, np.prod(bins), len(columns)))
    before = None
    for _, block in table.blocks(time, *columns):
        whole = block if before is None else np.vstack([before, block])
        seconds, values = np.diff(whole[:, 0]), whole[:-1, 1:]
        classes = [np.searchsorted(e[1:-1], v, side="right") for e, v in zip(edges, values.T, strict=True)]
        place = np.ravel_multi_index(classes, bins)
        spent += np.bincount(place, seconds, minlength=len(spent))
        for i in range(len(columns)):
            shifted = (values[:, i] - low[i]) / width[i]  # squares of values that hardly differ would lose their digits
            sums[:, i] += np.bincount(place, seconds * shifted, minlength=len(spent))
            squares[:, i] += np.bincount(place, seconds * shifted**2, minlength=len(spent))
        before = block[-1:]
    seen = spent > 0.0
    if not seen.any():
        raise UserError(f"{path}: at least two samples are needed")
    means, squares = sums[seen] / spent[seen, None], squares[seen] / spent[seen, None]
    spread = np.sqrt(np.maximum(squares - means**2, 0.0))
    cells = np.column_stack(np.unravel_index(np.flatnonzero(seen), bins))
    return spent[seen], cells, low + width * means, width * spread
