"""Targets of an identification: what a rig has measured, from the file or from its tables."""

import re
from dataclasses import dataclass
from typing import Annotated, Any

import numpy as np
from pydantic import Field

from ..base.errors import UserError, refusal, refusing, unknown
from ..base.schema import Count, Named, Number, Section, Truth
from ..base.tables import Table, Wanted
from ..base.toml_files import leaves
from ..base.units import SECONDS, differences, scales_of, to_si
from ..running.responses import COLUMNS as RESPONSES
from ..studies.sweep import KINDS
from .measures import FEWEST, SEGMENTS, STATISTICS, Measure, bands, of_series, parsed

HERTZ = {"Hz": (1.0, 0.0), "kHz": (1e-3, 0.0)}
SHORT = {"slip": "mean(cage.slip_ratio)", "cage_speed": "stat.cage_omega", "heat": "mean(bearing.power_loss)"}


class Common(Section):
    """What targets and series have in common."""

    point: Any = Field(None, description="its operating point; default: the first one")
    over: Any = Field(None, description="the target is the ratio to another point's")
    minus: Any = Field(None, description="or the difference to it")
    uncertainty: Any = Field(None, description="one standard deviation, in the unit of the value or in % of it")
    held_out: Truth | None = Field(None, description="in the place of the rule for all")


class TargetBlock(Common):
    """A measured figure: a measure of the runs, or a line of a spectrum."""

    measure: Any = Field(None, description="a response or column of a sweep, std(x), q05(x), q50(x), q95(x)")
    line: Any = Field(None, description="channel whose RMS amplitude in frequency +- width/2 is meant")
    frequency: Any = None
    width: Any = None
    value: Any = None


class SeriesBlock(Common):
    """A measured series, whose statistics and bands of the spectrum are targets."""

    file: Annotated[str, Field(strict=True)] = Field(description="CSV, Parquet or Excel, beside the study's")
    time: Annotated[str, Field(strict=True)] = "time"
    longest_gap: Annotated[float | None, Number(SECONDS)] = None
    columns: Named = Field({}, description="column by channel")
    statistics: list[str] = ["mean", "std"]
    bands: Annotated[int, Count(0)] = Field(0, description="octaves of the spectrum")


@dataclass(frozen=True)
class Target:
    """A measured figure of an operating point, or its ratio or difference to another; column: of a row; value, uncertainty: SI,
    one standard deviation; origin: of the value.
    """

    name: str
    point: int
    column: str
    value: float
    uncertainty: float
    held_out: bool
    unit: str = "1"
    operation: str = ""
    other: int = 0
    origin: str = "given"

    @property
    def weight(self):
        """Of its squared deviation in the fit."""
        return self.uncertainty**-2


def quantity(path, key, value, scales):
    """An SI value; UserError naming the key."""
    with refusing(path, key, value):
        return to_si(value, scales)


def spread(path, key, value, scales, mean):
    """A standard deviation in SI: of a unit, or in percent of the mean; offsets of units do not count."""
    relative = isinstance(value, str) and value.strip().endswith("%")
    if relative:
        found = abs(mean) * quantity(path, key, value, scales_of("1", {}))
    else:
        found = quantity(path, key, value, differences(scales))
    if not found > 0.0:
        zero = f"{value} of {mean:g} is 0" if relative and found == 0.0 else "one standard deviation"
        raise refusal(path, key, value, f"{zero}: greater than 0 is needed")
    return found


class Reader:
    """Targets as they are read, with the measures and outputs that they need."""

    def __init__(self, path, model, points, scenes, every):
        self.path, self.model, self.points, self.scenes, self.every = path, model, points, scenes, every
        self.targets, self.measures, self.outputs = [], [], []

    def target(self, where, block):
        """One [[target]]."""
        where = f"{self.path}: {where}"
        if (block.measure is None) == (block.line is None):
            raise UserError(f"{where}: either measure or line is needed")
        point, operation, other = self.place(where, block)
        if block.line is not None:
            column, unit, scales = self.line(where, block, point)
        else:
            column, unit, scales = self.column(where, block.measure)
        if operation == "over":
            unit, scales = "1", scales_of("1", {})
        elif operation == "minus":
            scales = differences(scales)
        for key in ("value", "uncertainty"):
            if getattr(block, key) is None:
                raise UserError(f"{where}: {key} is missing: its weight follows from value and uncertainty")
        value = quantity(where, "value", block.value, scales)
        uncertainty = spread(where, "uncertainty", block.uncertainty, scales, value)
        self.add(where, block, block.measure or column, point, column, value, uncertainty, unit, operation, other)

    def add(self, where, block, label, point, column, value, uncertainty, unit, operation="", other=0, origin="given"):
        """Append a Target."""
        by_rule = bool(self.every) and (len(self.targets) + 1) % self.every == 0
        held = by_rule if block.held_out is None else block.held_out
        at = self.points[point][0]
        name = f"{at}: {label}" if at else label
        if operation:
            name += f" {operation} {self.points[other][0]}"
        self.targets.append(Target(name, point, column, value, uncertainty, held, unit, operation, other, origin))

    def place(self, where, block):
        """Numbers of the operating point and of another, and the operation between."""
        names = [name for name, _ in self.points]

        def number(key):
            if getattr(block, key) not in names:
                raise unknown(where, key, getattr(block, key), names)
            return names.index(getattr(block, key))

        operations = [key for key in ("over", "minus") if getattr(block, key) is not None]
        if len(operations) > 1:
            raise UserError(f"{where}: either over or minus is needed")
        operation = operations[0] if operations else ""
        point = number("point") if block.point is not None else 0
        return point, operation, number(operation) if operation else 0

    def column(self, where, text):
        """Column, unit and scales of a measure."""
        if not isinstance(text, str):
            raise refusal(where, "measure", text, "the name of a response or column is needed")
        column = (SHORT | RESPONSES).get(text, text)
        if (measure := parsed(column)) is not None:
            unit, scales = self.channel(where, "measure", measure.channel)
            self.measures.append(measure)
            return measure.column, unit, scales
        if match := re.fullmatch(rf"({'|'.join(KINDS)})\(([^()]+)\)", column):
            unit, scales = self.channel(where, "measure", match[2])
            return column, unit, scales
        if column in self.model.outputs or column in self.model.locals:
            variable = (self.model.outputs | self.model.locals)[column]
            return column, variable.unit or "1", self.model.units[variable.unit]
        if column == "damage":
            return column, "1", scales_of("1", {})
        allowed = ["damage", *SHORT, *RESPONSES, *self.model.outputs]
        allowed += [f"mean({name})" for name in self.model.outputs]
        raise unknown(where, "measure", text, allowed)

    def channel(self, where, key, name):
        """Unit and scales of a channel over time, which the runs then record."""
        known = self.model.inputs | self.model.outputs
        if name not in known:
            raise unknown(where, key, name, known)
        self.outputs.append(name)
        return known[name].unit or "1", self.model.units[known[name].unit]

    def line(self, where, block, point):
        """Column, unit and scales of a line of a spectrum."""
        unit, scales = self.channel(where, "line", block.line)
        for key in ("frequency", "width"):
            if getattr(block, key) is None:
                raise UserError(f"{where}: {key} is missing")
        f, width = (quantity(where, key, getattr(block, key), HERTZ) for key in ("frequency", "width"))
        lowest, highest = self.limits(point)
        if not 0.0 < width < 2.0 * f:
            raise refusal(where, "width", block.width, "more than 0 and less than twice the frequency is allowed")
        if min(width, f - 0.5 * width) < lowest:
            reason = f"at least {lowest:.4g} Hz, as for the lower end, is allowed with this length of the run after start.settle"
            raise refusal(where, "width", block.width, reason)
        if f + 0.5 * width > highest:
            reason = f"at most {highest:.4g} Hz is allowed, half the rate of the run's samples"
            raise refusal(where, "frequency", block.frequency, reason)
        measure = Measure("line", block.line, f - 0.5 * width, f + 0.5 * width)
        self.measures.append(measure)
        return measure.column, unit, scales

    def limits(self, point):
        """Lowest and highest frequency [Hz] of a run's spectrum."""
        scene = self.scenes[point]
        length = scene.t_end - scene.value("start.settle", self.model)
        return 1.05 * FEWEST / length if length > 0.0 else np.inf, 0.5 / (scene.step * scene.stride)

    def series(self, where, block):
        """One [[series]]: statistics and bands of each of its columns as targets."""
        where = f"{self.path}: {where}"
        if block.over is not None or block.minus is not None:
            raise UserError(f"{where}: over and minus are for [[target]]")
        point, _, _ = self.place(where, block)
        file = self.path.parent / block.file
        table, time = Table(file), Wanted(block.time, SECONDS)
        channels = self.model.inputs | self.model.outputs
        columns = dict(leaves(block.columns, channels))
        if not columns:
            raise UserError(f"{where}: columns: name at least one channel with the column that was measured")
        kinds, allowed = block.statistics, ["mean", "rms", *STATISTICS]
        if any(kind not in allowed for kind in kinds):
            raise refusal(where, "statistics", kinds, f"a list of {', '.join(allowed)} is needed")
        for channel, wanted in columns.items():
            unit, scales = self.channel(where, "channel", channel)
            if not isinstance(wanted, str):
                raise refusal(where, f"columns.{channel}", wanted, "a text is needed")
            t, values = table.series(time, Wanted(wanted, scales), gap=block.longest_gap)
            if len(t) < 16 * SEGMENTS:
                raise UserError(f"{file}: {len(t)} rows: at least {16 * SEGMENTS} times are needed")
            head = table.heads[table.place(wanted)]
            measures = [Measure(kind, channel) for kind in kinds] + self.bands_of(where, channel, point, t, block.bands)
            for measure in measures:
                self.measured(where, block, measure, point, t, values, unit, file, head)

    def bands_of(self, where, channel, point, t, count):
        """Measures of so many bands that run and series both have."""
        if not count:
            return []
        lowest, highest = self.limits(point)
        lowest = max(lowest, 1.05 * FEWEST * SEGMENTS / (t[-1] - t[0]))
        highest = min(highest, 0.5 * (len(t) - 1) / (t[-1] - t[0])) * (1.0 - 1e-9)
        most = int(np.log2(max(highest / lowest, 1.0)))
        if count > most:
            reason = (
                f"at most {most} octaves lie between {lowest:.4g} and {highest:.4g} Hz, which run and series both have"
            )
            raise refusal(where, "bands", count, reason)
        return [Measure("band", channel, *map(float, ends)) for ends in bands(lowest, highest, count)]

    def measured(self, where, block, measure, point, t, values, unit, file, column):
        """The Target of a figure of a measured series."""
        plain = {"mean": np.mean, "rms": lambda x: np.sqrt(np.mean(x**2))}
        measure_of = measure if measure.kind not in plain else lambda _, x: float(plain[measure.kind](x))
        value, scatter = of_series(measure_of, t, values)
        if not np.isfinite(value) or not np.isfinite(scatter):
            raise UserError(f'{file}: column "{column}": no {measure.kind}: the times are not equally spaced')
        if block.uncertainty is not None:  # of the sensor
            relative = isinstance(block.uncertainty, str) and block.uncertainty.strip().endswith("%")
            if measure.kind == "band" and relative:  # a share of the amplitude
                sensor = spread(where, "uncertainty", block.uncertainty, scales_of("1", {}), 1.0) / np.log(10.0)
            elif measure.kind == "band":
                sensor = 0.0  # a shift of the zero is in no band
            else:
                sensor = spread(where, "uncertainty", block.uncertainty, self.model.units[unit], value)
            scatter = float(np.hypot(scatter, sensor))
        if not scatter > 0.0:
            words = f"{measure.column} does not scatter, its uncertainty is 0: give one"
            raise UserError(f'{file}: column "{column}": {words}')
        if measure.kind not in plain:
            self.measures.append(measure)
        unit = "1" if measure.kind == "band" else unit
        origin = f"{file.name}: {column}"
        self.add(where, block, measure.column, point, measure.column, value, scatter, unit, origin=origin)
