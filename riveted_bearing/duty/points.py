"""Operating points of a mission: written one by one, from a table of hours, or from a measured record."""

import itertools
from dataclasses import replace
from pathlib import Path

import numpy as np

from ..base.errors import UserError, refusal, unknown
from ..base.tables import Wanted, read
from ..base.toml_files import leaves, section_of
from ..base.units import SECONDS, scale
from ..studies.sweep_file import count_of
from .history import binned
from .parts import HOURS, SHARES, amount, part_of, tables

POINT = ("name", "hours", "share", "preload_factor", "interpolate", "scene", "simulation", "parameters", "inputs")
TABLE = ("file", "hours", "inputs", "parameters")
HISTORY = ("file", "time", "hours", "longest_gap", "inputs", "parameters")
ROUNDED = 0.011  # by how much shares may miss 1, as three of 0.33 do
MOST_CLASSES = 100_000  # of a record


def changed_points(path, document, model):
    """The tables [[point]] with the parameters of [[change]]; a point in which a change falls is divided."""
    blocks, changes = tables(path, document, "point"), tables(path, document, "change")
    if not changes:
        return blocks
    if any(key in document for key in ("table", "history")) or any("hours" not in block for block in blocks):
        raise UserError(f"{path}: change: needs an order of time: [[point]] with hours, no [table] and no [history]")
    times = [change_of(path, i, change, model) for i, change in enumerate(changes, 1)]
    ends = np.cumsum([amount(path, "point: hours", block["hours"], HOURS) for block in blocks])
    late = [at for at, _ in times if not 0.0 <= at < ends[-1]]
    if late:
        raise refusal(
            path, "change.at", f"{late[0]:g} h", f"from 0 to below the {ends[-1]:g} h of all points is allowed"
        )
    found, begin = [], 0.0
    for i, (block, end) in enumerate(zip(blocks, ends, strict=True), 1):
        edges = [begin, *sorted({at for at, _ in times if begin < at < end}), float(end)]
        for part, (start, stop) in enumerate(itertools.pairwise(edges)):
            parameters = dict(block.get("parameters", {}))
            for at, values in times:
                if at <= start:
                    parameters = merged(parameters, values)
            name = f"{block.get('name', i)}" + (f" from {start:g} h" if part else "")
            found.append(block | {"name": name, "hours": stop - start, "parameters": parameters})
        begin = float(end)
    return found


def change_of(path, number_of, change, model):
    """Time [h] and parameters of one [[change]]; UserError for one that a run could not change."""
    label = f"change {number_of}"
    if "at" not in change:
        raise UserError(f"{path}: {label}: at is needed: the time at which its parameters change")
    values = {key: value for key, value in change.items() if key != "at"}
    for name, _ in leaves(values, model.parameters):
        variable = model.parameters.get(name)
        if variable is not None and variable.variability != "tunable":
            raise UserError(f"{path}: {label}: {name} is fixed in a run: see docs/parameters.md")
    return amount(path, f"{label}: at", change["at"], HOURS), values


def merged(tree, other):
    """Nested tables with those of another one put over them."""
    both = {
        key: merged(tree[key], other[key])
        for key in other
        if isinstance(tree.get(key), dict) and isinstance(other[key], dict)
    }
    return tree | other | both


def points(path, document, model):
    """The Parts of [[point]], [table] and [history]."""
    blocks = changed_points(path, document, model)
    found = []
    for i, block in enumerate(blocks, 1):
        label = f"point {block.get('name', i)}"
        for key in block:
            if key not in POINT:
                raise unknown(f"{path}: {label}", "key", key, POINT)
        given = [key for key in ("hours", "share") if key in block]
        if len(given) != 1:
            raise UserError(f"{path}: {label}: hours or share is needed" + (", not both" if given else ""))
        if given[0] != next(key for key in ("hours", "share") if key in blocks[0]):
            raise UserError(
                f"{path}: {label}: has {given[0]}, but the first point has not: hours in every point or share in every point is allowed"
            )
        weight = amount(path, f"{label}: {given[0]}", block[given[0]], HOURS if given[0] == "hours" else SHARES)
        if not isinstance(block.get("interpolate", False), bool):
            raise refusal(path, f"{label}: interpolate", block["interpolate"], "allowed: true, false")
        found.append(part_of(path, document, model, label, str(block.get("name", i)), block, weight))
    if found and "share" in blocks[0] and abs((whole := sum(part.weight for part in found)) - 1.0) > ROUNDED:
        raise UserError(f"{path}: share: those of the points add up to {whole:.4g}; 1 is allowed")
    if found and "share" in blocks[0] and ("table" in document or "history" in document):
        raise UserError(
            f"{path}: share: points of a table or a history have hours, so that the other points need hours too"
        )
    return [*found, *table_points(path, document, model), *history_points(path, document, model)]


def columns_of(path, where, section, model, further=()):
    """The columns that a table or a history gives: {full name: (kind, Wanted column, entries)}."""
    found = {}
    known = {"inputs": model.inputs, "parameters": model.parameters}
    for kind, variables in known.items():
        for name, value in leaves(section_of(f"{path}: {where}", section, kind), variables):
            if name not in variables:
                raise unknown(f"{path}: {where}", kind.removesuffix("s"), name, variables)
            if not isinstance(value, dict) or "column" not in value or not set(value) <= {"column", "unit", *further}:
                raise refusal(
                    path,
                    f"{where}.{name}",
                    value,
                    f"{{ column = ..., unit = ...{''.join(f', {key} = ...' for key in further)} }} is needed",
                )
            if any(not isinstance(value.get(key, ""), str) for key in ("column", "unit")):
                raise refusal(path, f"{where}.{name}", value, "column and unit are texts")
            scales = model.units[variables[name].unit]
            try:
                scale(value["unit"], scales) if "unit" in value else None
            except UserError as problem:
                raise refusal(path, f"{where}.{name}.unit", value["unit"], problem) from None
            found[name] = (kind, Wanted(value["column"], scales, value.get("unit", "")), value)
    if not found:
        raise UserError(f"{path}: {where}: inputs or parameters are needed, each with its column")
    return found


def file_of(path, where, section, keys, needed):
    """The file of a section, whose keys are checked."""
    for key in section:
        if key not in keys:
            raise unknown(path, "key", f"{where}.{key}", [f"{where}.{name}" for name in keys])
    for key in needed:
        if not isinstance(section.get(key), str):
            raise refusal(path, f"{where}.{key}", section.get(key), "a text is needed")
    return Path(path).parent / section["file"]


def table_points(path, document, model):
    """The Parts of [table], one for each line of the file."""
    section = section_of(path, document, "table")
    if not section:
        return
    file = file_of(path, "table", section, TABLE, ("file", "hours"))
    columns = columns_of(path, "table", section, model)
    hours, *values = read(file, Wanted(section["hours"], HOURS), *(column for _, column, _ in columns.values()))
    for i, row in enumerate(np.column_stack([hours, *values]), 1):
        label = f"{file.name} line {i}"
        weight = amount(path, f"{label}: {section['hours']}", float(row[0]), HOURS)
        yield part_of(path, document, model, label, label, block_of(columns, row[1:]), weight)


def history_points(path, document, model):
    """The Parts of [history]: the classes of a measured record."""
    section = section_of(path, document, "history")
    if not section:
        return
    file = file_of(path, "history", section, HISTORY, ("file", "time"))
    columns = columns_of(path, "history", section, model, ("bins",))
    bins = [count_of(path, f"history.{name}.bins", entry.get("bins", 5)) for name, (*_, entry) in columns.items()]
    if np.prod(bins, dtype=float) > MOST_CLASSES:
        raise UserError(
            f"{path}: history: {np.prod(bins, dtype=float):.3g} classes; at most {MOST_CLASSES} are allowed"
        )
    gap = section.get("longest_gap")
    gap = None if gap is None else 3600.0 * amount(path, "history.longest_gap", gap, HOURS)
    wanted = [column for _, column, _ in columns.values()]
    spent, cells, means, spreads = binned(file, Wanted(section["time"], SECONDS), wanted, bins, gap)
    hours = amount(path, "history.hours", section.get("hours", spent.sum() / 3600.0), HOURS)
    for i, (seconds, cell, row, spread) in enumerate(zip(spent, cells, means, spreads, strict=True), 1):
        label = f"{file.name} class {i}"
        part = part_of(path, document, model, label, label, block_of(columns, row), hours * seconds / spent.sum())
        yield replace(part, cell=tuple(cell.tolist()), means=tuple(row.tolist()), spreads=tuple(spread.tolist()))


def block_of(columns, row):
    """A point's block from SI values of columns."""
    block = {"inputs": {}, "parameters": {}}
    for (name, (kind, *_)), value in zip(columns.items(), row.tolist(), strict=True):
        block[kind][name] = value
    return block
