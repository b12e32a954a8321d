"""Rainflow matrices of a run: how often which range and mean of stress occurred at each rivet's head and middle.

Cycles of nearly equal range and mean share a class, which keeps its count, mean range and mean mean, so that damage
computed later with another S-N curve is that of the cycles: classes of 2 % of range leave 15^2/2 0.02^2/12 = 0.4 % at a
slope of 15, and nothing where all cycles of a class are equal.  A matrix is four columns of one length: channel (2 k for
the head, 2 k + 1 for the middle of rivet k + 1), range and mean [Pa], count.
"""

import numpy as np

from ..running.accuracy import block_variances
from ..running.rainflow import CHANNELS, cycles_of, stress_history
from ..running.summary import has_statistics

RANGE_STEP, MEAN_STEP, LEAST = 0.02, 1e6, 1e4  # of ln range; [Pa]; smaller ranges do no damage
BLOCK_COLUMNS = {"blocks.stress": "Pa2", "blocks.damage": "1"}  # variance by the blocks of a run (accuracy.py)
COLUMNS = ("channel", "range", "mean", "count")
ENDS = tuple(f"].{channel}{kind}" for channel in CHANNELS.values() for kind in ("", "_peak"))


def outputs_of(model):
    """Outputs of a Model that a life needs: stress of each rivet and its peaks."""
    return tuple(name for name in model.outputs if name.startswith("rivet[") and name.endswith(ENDS))


def rainflow_columns(result):
    """The rainflow matrices of a Result as columns of a sweep's row."""
    rivets = sum(name.startswith("rivet[") and name.endswith("].sigma_head") for name in result.data)
    tables = [classed(stress_history(result, k, name)) for k in range(1, rivets + 1) for name in CHANNELS]
    columns = [np.repeat(np.arange(len(tables)), list(map(len, tables))), *np.concatenate(tables).T]
    found = {f"cycles.{name}": column for name, column in zip(COLUMNS, columns, strict=True)}
    blocks = {}
    if has_statistics(result):
        blocks = block_variances(result, {"stress": result.summary["stat.sigma_head_p999"]})
    return found | {name: blocks.get(name.partition(".")[2], np.nan) for name in BLOCK_COLUMNS}


def rainflow_fields():
    """Fields of these columns for a Parquet dataset."""
    import pyarrow as pa

    units = {"channel": "1", "range": "Pa", "mean": "Pa", "count": "1"}
    kinds = {"channel": pa.int16()}
    return [
        pa.field(f"cycles.{name}", pa.list_(kinds.get(name, pa.float64())), metadata={"unit": units[name]})
        for name in COLUMNS
    ] + [pa.field(name, pa.float64(), metadata={"unit": unit}) for name, unit in BLOCK_COLUMNS.items()]


def classed(history):
    """Classes (mean range [Pa], mean mean [Pa], count) of the cycles of a stress history [Pa], as rows."""
    cycles = cycles_of(history)
    cycles = cycles[cycles[:, 0] > LEAST]
    if not len(cycles):
        return cycles
    span, mean, count = cycles.T
    key = 2.0**32 * np.floor(np.log(span) / RANGE_STEP) + np.floor(mean / MEAN_STEP)  # exact: one number for both
    _, group = np.unique(key, return_inverse=True)
    total = np.bincount(group, count)
    return np.column_stack([np.bincount(group, count * span) / total, np.bincount(group, count * mean) / total, total])


def stored_cycles(rows, i):
    """The matrix (channel, range, mean, count) of row i of a sweep's columns."""
    channel, *rest = (np.asarray(rows[f"cycles.{name}"][i]) for name in COLUMNS)
    return channel.astype(int), *(column.astype(float) for column in rest)
