"""Measured records of a mission, read in pieces and binned into operating points."""

import numpy as np

from ..base.errors import UserError
from ..base.tables import Table


def binned(path, time, columns, bins, gap=None):
    """Operating points of a measured record: each sample holds until the next one, and each class of values with
    samples becomes a point.

    time, columns: Wanted; bins: of each column the number of equal classes between its extremes; gap: longest interval
    [s] that a sample may hold, None: ten usual ones.  Returns the time spent in the classes [P] in s, their numbers along
    each column [P, columns], and the means and standard deviations of the values in them [P, columns] in SI.  The file is
    read twice, in pieces.
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
    spent, sums, squares = (
        np.zeros(np.prod(bins)),
        np.zeros((np.prod(bins), len(columns))),
        np.zeros((np.prod(bins), len(columns))),
    )
    before = None
    for _, block in table.blocks(time, *columns):
        whole = block if before is None else np.vstack([before, block])
        seconds, values = np.diff(whole[:, 0]), whole[:-1, 1:]
        classes = np.minimum((np.asarray(bins) * (values - low) / width).astype(int), np.asarray(bins) - 1)
        place = np.ravel_multi_index(classes.T, bins)
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
    return (
        spent[seen],
        np.column_stack(np.unravel_index(np.flatnonzero(seen), bins)),
        low + width * means,
        width * spread,
    )
