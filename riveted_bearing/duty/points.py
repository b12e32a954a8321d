"""Operating points of a mission: written one by one, from a table of hours, or from a measured record."""

import itertools
from dataclasses import replace

import numpy as np

from ..base.errors import UserError, refusal, refusing, unknown
from ..base.tables import Table, Wanted
from ..base.toml_files import leaves
from ..base.units import SECONDS, scale
from ..studies.sweep_file import count_of
from .history import binned
from .mission_file import HOURS, Point
from .parts import part_of

FORCES = ("shaft.F_x", "shaft.F_y", "shaft.F_z")
WIDE = 0.1  # of the mean cube of a force: missed by wide classes of a record
ROUNDED = 0.011  # by how much shares may miss 1, as three of 0.33 do
MOST_CLASSES = 100_000  # of a record


def changed_points(path, file, model):
    """The Points of a MissionFile with the parameters of [[change]]; a point in which a change falls is divided."""
    blocks, changes = file.point, file.change
    if not changes:
        return blocks
    if file.table or file.history or any(block.hours is None for block in blocks):
        raise UserError(f"{path}: change: needs an order of time: [[point]] with hours, no [table] and no [history]")
    for i, change in enumerate(changes, 1):
        for name, _ in leaves(change.model_extra, model.parameters):
            variable = model.parameters.get(name)
            if variable is not None and variable.variability != "tunable":
                raise UserError(f"{path}: change {i}: {name} is fixed in a run: see docs/parameters.md")
    ends = np.cumsum([block.hours for block in blocks])
    late = [change.at for change in changes if change.at >= ends[-1]]
    if late:
        reason = f"from 0 to below the {ends[-1]:g} h of all points is allowed"
        raise refusal(path, "change.at", f"{late[0]:g} h", reason)
    found, begin = [], 0.0
    for i, (block, end) in enumerate(zip(blocks, ends, strict=True), 1):
        edges = [begin, *sorted({change.at for change in changes if begin < change.at < end}), float(end)]
        for part, (start, stop) in enumerate(itertools.pairwise(edges)):
            parameters = block.parameters
            for change in changes:
                if change.at <= start:
                    parameters = merged(parameters, change.model_extra)
            name = f"{block.name or i}" + (f" from {start:g} h" if part else "")
            found.append(block.model_copy(update={"name": name, "hours": stop - start, "parameters": parameters}))
        begin = float(end)
    return found


def merged(tree, other):
    """Nested tables with those of another one put over them."""
    both = {
        key: merged(tree[key], other[key])
        for key in other
        if isinstance(tree.get(key), dict) and isinstance(other[key], dict)
    }
    return tree | other | both


def points(path, file, model):
    """The Parts of a MissionFile's [[point]], [table] and [history]."""
    blocks = changed_points(path, file, model)
    shares = bool(blocks) and blocks[0].share is not None
    found = []
    for i, block in enumerate(blocks, 1):
        label = f"point {block.name or i}"
        if (block.hours is None) == (block.share is None):
            both = block.hours is not None
            raise UserError(f"{path}: {label}: hours or share is needed" + (", not both" if both else ""))
        if (block.share is not None) != shares:
            raise UserError(
                f"{path}: {label}: has {'hours' if shares else 'share'}, but the first point has not: "
                "hours in every point or share in every point is allowed"
            )
        weight = block.share if shares else block.hours
        found.append(part_of(path, file, model, label, block.name or str(i), block, weight))
    if shares and abs((whole := sum(part.weight for part in found)) - 1.0) > ROUNDED:
        raise UserError(f"{path}: share: those of the points add up to {whole:.4g}; 1 is allowed")
    if shares and (file.table or file.history):
        raise UserError(
            f"{path}: share: points of a table or a history have hours, so that the other points need hours too"
        )
    return [*found, *table_points(path, file, model), *history_points(path, file, model)]


def columns_of(path, where, section, model, further=()):
    """The columns that a table or a history gives: {full name: (kind, Wanted column, entries)}."""
    found = {}
    known = {"inputs": model.inputs, "parameters": model.parameters}
    for kind, variables in known.items():
        for name, value in leaves(getattr(section, kind), variables):
            if name not in variables:
                raise unknown(f"{path}: {where}", kind.removesuffix("s"), name, variables)
            if not isinstance(value, dict) or "column" not in value or not set(value) <= {"column", "unit", *further}:
                keys = ", ".join(f"{key} = ..." for key in ("column", "unit", *further))
                raise refusal(path, f"{where}.{name}", value, f"{{ {keys} }} is needed")
            if any(not isinstance(value.get(key, ""), str) for key in ("column", "unit")):
                raise refusal(path, f"{where}.{name}", value, "column and unit are texts")
            scales = model.units[variables[name].unit]
            if "unit" in value:
                with refusing(path, f"{where}.{name}.unit", value["unit"]):
                    scale(value["unit"], scales)
            found[name] = (kind, Wanted(value["column"], scales, value.get("unit", "")), value)
    if not found:
        raise UserError(f"{path}: {where}: inputs or parameters are needed, each with its column")
    return found


def table_points(path, file, model):
    """The Parts of [table], one for each line of the file."""
    section = file.table
    if section is None:
        return
    table = path.parent / section.file
    columns = columns_of(path, "table", section, model)
    wanted = Wanted(section.hours, HOURS), *(column for _, column, _ in columns.values())
    lines, *values = Table(table).rows_and_columns(*wanted)
    for line, row in zip(lines, np.column_stack(values), strict=True):
        label = f"{table.name} line {line}"
        if row[0] < 0.0:
            raise refusal(path, f"{label}: {section.hours}", float(row[0]), "must not be negative")
        yield part_of(path, file, model, label, label, block_of(columns, row[1:]), float(row[0]))


def history_points(path, file, model):
    """The Parts of [history]: the classes of a measured record."""
    section = file.history
    if section is None:
        return
    record = path.parent / section.file
    columns = columns_of(path, "history", section, model, ("bins",))
    bins = [count_of(path, f"history.{name}.bins", entry.get("bins", 5)) for name, (*_, entry) in columns.items()]
    if (classes := np.prod(bins, dtype=float)) > MOST_CLASSES:
        raise UserError(f"{path}: history: {classes:.3g} classes; at most {MOST_CLASSES} are allowed")
    gap = None if section.longest_gap is None else 3600.0 * section.longest_gap
    wanted = [column for _, column, _ in columns.values()]
    spent, cells, means, spreads = binned(record, Wanted(section.time, SECONDS), wanted, bins, gap)
    wide = wide_classes(columns, spent, means, spreads)
    hours = spent.sum() / 3600.0 if section.hours is None else section.hours
    for i, (seconds, cell, row, spread) in enumerate(zip(spent, cells, means, spreads, strict=True), 1):
        label = f"{record.name} class {i}"
        part = part_of(path, file, model, label, label, block_of(columns, row), hours * seconds / spent.sum())
        warnings, wide = wide, ()
        cell, row, spread = (tuple(each.tolist()) for each in (cell, row, spread))
        yield replace(part, cell=cell, means=row, spreads=spread, warnings=warnings)


def wide_classes(columns, spent, means, spreads):
    """Sentences on forces in classes too wide for the raceways: mean of F^3 = mu^3 + 3 mu sigma^2."""
    found = []
    for name, mean, spread in zip(columns, np.abs(means.T), spreads.T, strict=True):
        cubes = spent @ mean**3
        if name in FORCES and 3.0 * spent @ (mean * spread**2) > WIDE * cubes > 0.0:
            missed = 300.0 * spent @ (mean * spread**2) / cubes
            found.append(
                f"history.{name}: the means of its classes miss {missed:.2g} % of the mean of F^3, by which raceways live: more bins"
            )
    return tuple(found)


def block_of(columns, row):
    """A point's block from SI values of columns."""
    block = {"inputs": {}, "parameters": {}}
    for (name, (kind, *_)), value in zip(columns.items(), row.tolist(), strict=True):
        block[kind][name] = value
    return Point(**block)
