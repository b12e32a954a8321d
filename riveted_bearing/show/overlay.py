"""A measured series beside a run's: statistics, spectra and both over time, side by side.

    time [ms],housing.F_y [kN]        # a table as tables.py reads it
    0.0,2.98

A column is that of the channel it is named after, or of the one that `columns` says.  The motion of a bearing is chaotic
and a measurement has no common start with a run: no point of one is compared with a point of the other.
"""

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from bearing_model.generated import variables

from ..base import tables
from ..base.errors import UserError, unknown
from ..base.units import SECONDS, canonical, scale, scales_of, suffix
from ..base.variable_list import variable_of
from ..running.summary import settled
from .spectrum import density
from .style import FORCE, HEAD, MUTED

UNEVEN = 0.01  # of the mean step: times beyond it have no spectrum
FEWEST = 16
TIME = "time"
BUCKETS = 300


@dataclass(frozen=True)
class Series:
    """A channel beside its measured series: times [s], values in the unit shown; column, gap: in words."""

    channel: str
    column: str
    unit: str
    t_run: np.ndarray = field(repr=False)
    run: np.ndarray = field(repr=False)
    t_measured: np.ndarray = field(repr=False)
    measured: np.ndarray = field(repr=False)
    gap: str = ""


def assigned(options: Any) -> Any:
    """{channel: column} of texts CHANNEL=COLUMN."""
    found = {}
    for text in options:
        channel, equals, column = text.partition("=")
        if not equals or not column.strip():
            raise UserError(f'--column {text}: not of the form CHANNEL=COLUMN, e.g. housing.F_y="Fy [kN]"')
        found[channel.strip()] = column.strip().strip("\"'")
    return found


def read_measured(path, result, columns=None):
    """The Series of a table beside a Result; columns: {channel: column}, "time" too, where names differ; UserError if none fits."""
    table, columns = tables.Table(path), dict(columns or {})
    recorded = [name for name in result.data if name != TIME]
    time = tables.Wanted(columns.pop(TIME, TIME), SECONDS)
    table.place(time.name)
    if not columns:
        names = [tables.split_head(head)[0] for head in table.heads]
        columns = dict(zip(names, table.heads, strict=True))
        columns = {name: head for name, head in columns.items() if name in recorded and name != TIME}
        if twice := [name for name in columns if names.count(name) > 1]:
            raise UserError(f"{path}: {twice[0]}: two columns have this name")
        if not columns:
            raise UserError(
                f"{path}: no column has the name of a recorded channel ({', '.join(table.heads)}); --column housing.F_y=NAME assigns one"
            )
    late = settled(result)
    found = []
    for channel, name in columns.items():
        if channel not in recorded:
            raise unknown(f"{path}: --column", "recorded channel", channel, recorded)
        own = result.units.get(channel, "1")
        displays = variables.UNITS.get(own, {})
        scales = scales_of(own, displays)
        wanted = tables.Wanted(name, scales)
        rows, t, values = table.rows_and_columns(time, wanted)
        clock = table.clock(time, strict=False)
        clock.add(rows, t)
        if len(t) < FEWEST:
            raise UserError(f'{path}: column "{time.name}": at least {FEWEST} times are needed')
        display = getattr(variable_of(channel), "display", None)
        shown = canonical(table.unit(wanted)) if table.unit(wanted) else display if display in displays else own
        factor, offset = scale(shown, scales) if shown != own else (1.0, 0.0)
        run = result.data["time"][late], factor * result.data[channel][late] + offset
        head, unit = table.heads[table.place(name)], suffix(shown).strip()
        found.append(Series(channel, head, unit, *run, t, factor * values + offset, clock.note))
    return found


def statistics(t, values):
    """(name, value) of one series: its length and rate, and figures in its unit."""
    yield "samples", float(len(values))
    yield "length [s]", float(t[-1] - t[0])
    yield "samples per ms", 1e-3 * (len(t) - 1) / (t[-1] - t[0])
    yield "mean", float(values.mean())
    yield "standard deviation", float(values.std())
    yield "RMS", float(np.sqrt(np.mean(values**2)))
    for share in (0.001, 0.5, 0.999):
        yield f"{100 * share:g} % quantile", float(np.quantile(values, share))
    yield "smallest", float(values.min())
    yield "largest", float(values.max())


def spectrum(t, values):
    """Frequencies [Hz] and amplitude density [unit/√Hz] by Welch; None where times are not equally spaced."""
    steps = np.diff(t)
    if np.abs(steps / steps.mean() - 1.0).max() > UNEVEN or len(t) < FEWEST:
        return None
    return density(values, 1.0 / steps.mean())


def table_rows(series):
    """(name, figure of the run, figure of the measurement)."""
    pairs = zip(statistics(series.t_run, series.run), statistics(series.t_measured, series.measured), strict=True)
    return [(name, a, b) for (name, a), (_, b) in pairs]


def spectrum_note(series):
    """Why a spectrum is missing, "" if both are there."""
    lacking = [who for who, t, values, _ in both(series, "measurement") if spectrum(t, values) is None]
    gap = f" ({series.gap})" if series.gap else ""
    of = " and of the ".join(lacking)
    return f"No spectrum of the {of}: its times are not equally spaced{gap}." if lacking else ""


def both(series, measured="measured"):
    """Name, times, values and colour of the run and of the measurement."""
    return (
        ("run", series.t_run, series.run, FORCE),
        (measured, series.t_measured, series.measured, HEAD),
    )


def time_chart(fig, series):
    """Both over their own time, on one scale of values."""
    panels = fig.subplots(1, 2, sharey=True)
    for ax, (title, t, values, colour) in zip(panels, both(series), strict=True):
        first = np.unique(np.linspace(0, len(t), BUCKETS, endpoint=False).astype(int))
        low, high = (reduce.reduceat(values, first) for reduce in (np.minimum, np.maximum))
        ax.fill_between(1e3 * t[first], low, high, color=colour, lw=0.4, step="post")
        ax.axhline(values.mean(), color=MUTED, lw=0.9, ls="--")
        ax.set_title(title)
        ax.set_xlabel("time [ms]")
    panels[0].set_ylabel(series.unit)


def spectrum_chart(fig, series):
    """Both spectra, each to half its own rate."""
    ax = fig.subplots()
    for label, t, values, colour in both(series):
        if (found := spectrum(t, values)) is not None and np.any(found[1] > 0.0):
            ax.loglog(*found, color=colour, lw=0.8, label=label)
    ax.set(xlabel="frequency [Hz]", ylabel=f"{series.unit or '1'}/√Hz")
    if ax.get_legend_handles_labels()[0]:
        ax.legend(ncols=2, loc="lower right", bbox_to_anchor=(1.0, 1.0))


def views(found):
    """What the report's page shows of each Series."""
    from . import charts

    def picture(draw, series, label):
        return charts.svg(lambda fig: draw(fig, series), (4.9, 2.7), label)

    return [
        {
            **{name: getattr(series, name) for name in ("channel", "column", "unit")},
            "rows": table_rows(series),
            "note": spectrum_note(series),
            "time": picture(time_chart, series, f"{series.channel} over time"),
            "spectrum": picture(spectrum_chart, series, f"{series.channel}, spectra"),
        }
        for series in found
    ]
