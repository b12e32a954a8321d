"""Tables and measured records of a mission: CSV files of any length, read in pieces by pyarrow, and binned into
operating points.
"""

import numpy as np

from ..errors import UserError, unknown


def blocks(path, names):
    """Pieces of the named columns of a CSV file with a header line [n, columns]; lines with # in front may stand before
    it.

    Raises UserError if the file or a column is missing or an entry is no finite number.
    """
    from pyarrow import ArrowInvalid, csv

    if not path.is_file():
        raise UserError(f"{path}: no such file")
    try:
        with path.open(encoding="utf-8") as file:
            skipped = 0
            while file.readline().startswith("#"):
                skipped += 1
        reader = csv.open_csv(path, csv.ReadOptions(skip_rows=skipped))
        present = {name.strip(): place for place, name in enumerate(reader.schema.names)}
        for name in names:
            if name not in present:
                raise unknown(path, "column", name, present)
        for block in reader:
            columns = [block.column(present[name]).to_numpy(zero_copy_only=False) for name in names]
            for name, column in zip(names, columns, strict=True):
                if not np.issubdtype(column.dtype, np.number) or not np.all(np.isfinite(column)):
                    raise UserError(f'{path}: column "{name}" has entries that are no numbers')
            yield np.column_stack(columns).astype(float)
    except (ArrowInvalid, UnicodeDecodeError) as problem:
        raise UserError(f"{path}: not a CSV table: {problem}") from None
    except OSError as problem:
        raise UserError(f"{path}: {problem.strerror}") from None


def read_columns(path, names):
    """The named columns of a CSV file as arrays."""
    pieces = list(blocks(path, names))
    return np.concatenate(pieces).T if pieces else np.zeros((len(names), 0))


def binned(path, time, columns, bins):
    """Operating points of a measured record: each sample holds until the next one, and each class of values with
    samples becomes a point.

    time: name of the column of times [s]; columns: names; bins: of each column the number of equal classes between its
    extremes. Returns the time spent in the classes [P] in s, their numbers along each column [P, columns], and the
    means and standard deviations of the values in them [P, columns].  The file is read twice, in pieces.
    """
    low, high, last = np.full(len(columns), np.inf), np.full(len(columns), -np.inf), -np.inf
    for block in blocks(path, (time, *columns)):
        if block[0, 0] <= last or np.any(np.diff(block[:, 0]) <= 0.0):
            raise UserError(f'{path}: the times in column "{time}" do not increase')
        last, low, high = (
            block[-1, 0],
            np.minimum(low, block[:, 1:].min(axis=0)),
            np.maximum(high, block[:, 1:].max(axis=0)),
        )
    if not np.all(high >= low):
        raise UserError(f"{path}: no samples")
    width = np.where(high > low, high - low, 1.0)
    spent, sums, squares = (
        np.zeros(np.prod(bins)),
        np.zeros((np.prod(bins), len(columns))),
        np.zeros((np.prod(bins), len(columns))),
    )
    before = None
    for block in blocks(path, (time, *columns)):
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
