"""Spectrum and envelope spectrum of a run, with the lines of its kinematic frequencies.

    envelope        band-pass, analytic signal (Hilbert), squared magnitude without its mean
    band            given, or that of the largest spectral kurtosis of short-time transforms (Antoni 2006, Mech. Syst.
                    Signal Process. 20, 282)
    frequencies     from the speeds that the run computed, so that slip is in them:
                    FTF = cage, BPFO = Z (cage - outer), BPFI = Z (inner - cage),
                    BSF = (cage - outer) (d_m/D)(1 + D cos(alpha)/d_m), a ball's turns in the cage
    run-up          samples at equal angles of the shaft: frequencies are orders of the shaft's speed

Amplitudes are those of sines, with a Hann window.
"""

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy.integrate import cumulative_trapezoid
from scipy.interpolate import CubicSpline
from scipy.signal import ShortTimeFFT, butter, hilbert, periodogram, sosfiltfilt, welch
from scipy.signal.windows import hann

from ..base.errors import UserError, unknown
from ..base.files import write_atomically
from ..running.effects import without_effect
from ..running.fmu import Model
from ..running.inputs import histories_of
from ..running.results import Result
from ..running.scene import ALWAYS, Scene
from ..running.summary import settled
from .animation import number_of_balls
from .style import FORCE, HEAD, MIDDLE, MUTED, picture

CHANNELS = ("housing.a_y", "housing.F_y", "ring.a_y", "ring.y")  # first of these that moves, unless one is named
SPEEDS = ("shaft.omega", "housing.omega", "cage.omega")
STEADY = 0.01  # relative change of the shaft's speed up to which frequencies stand for orders
SEGMENTS = (16, 32, 64, 128, 256)  # samples of the short-time transforms
FEWEST = 256  # samples
FEWEST_BLOCKS = 16  # windows side by side in the signal, of which a kurtosis means something
LOWEST = 0.01  # lower end of the band / rate
NARROWEST = 4  # resolutions in a band whose envelope means something
HARMONICS = 3
ABOVE = 4.0  # a line stands out where its amplitude is this many times the median around it


@dataclass(frozen=True)
class Line:
    """One expected line: name, its frequency, amplitude found within the resolution and the median amplitude around."""

    name: str
    expected: float
    found: float
    amplitude: float
    background: float

    @property
    def stands_out(self):
        return self.amplitude > ABOVE * self.background


@dataclass(frozen=True)
class Spectra:
    """Spectrum and envelope spectrum of one channel; frequencies in Hz or, of a run-up, orders of the shaft."""

    channel: str
    unit: str
    orders: bool
    frequency: np.ndarray
    amplitude: np.ndarray
    envelope_frequency: np.ndarray
    envelope: np.ndarray
    band: tuple
    kinematic: dict  # frequencies by name
    lines: tuple  # of the envelope

    @property
    def resolution(self):
        return float(self.envelope_frequency[1])

    @property
    def axis(self):
        return "order of the shaft" if self.orders else "frequency [Hz]"

    @property
    def axis_unit(self):
        return "orders" if self.orders else "Hz"


def spectra(result: Result, channel: str | None = None, band: Any = None) -> Any:
    """Spectra of a Result; channel: None, the first of CHANNELS that moves; band: of the envelope [Hz]; UserError if it lacks."""
    rows = settled(result)
    t = result.data["time"][rows]
    channel = channel or default_channel(result)
    if channel not in result.data:
        raise unknown("spectrum", "channel", channel, list(result.data))
    x, rate = evenly(t, result.data[channel][rows], channel)
    speeds = {name: speed_of(result, name, rows) for name in SPEEDS}
    omega = speeds["shaft.omega"]
    orders = bool(np.ptp(omega) > STEADY * np.abs(omega).max())
    if orders:
        x, rate = at_equal_angles(t, x, omega)
    band = tuple(map(float, band)) if band else kurtosis_band(x, rate)
    if not 0.0 < band[0] < band[1] < 0.5 * rate:
        raise UserError(f"band = {band[0]:g} to {band[1]:g}: 0 < low < high < {0.5 * rate:g} is allowed, half the rate")
    frequency, amplitude = amplitude_spectrum(x, rate)
    width, axis = band[1] - band[0], "orders" if orders else "Hz"
    if width < NARROWEST * frequency[1]:
        raise UserError(
            f"band = {band[0]:g} to {band[1]:g} {axis}: at least {NARROWEST * frequency[1]:.3g} {axis} wide is allowed, {NARROWEST} "
            "times the resolution of this run"
        )
    envelope = np.abs(hilbert(sosfiltfilt(butter(4, band, btype="bandpass", fs=rate, output="sos"), x))) ** 2
    envelope_frequency, of_envelope = amplitude_spectrum(envelope - envelope.mean(), rate)
    kinematic = kinematic_frequencies(result, speeds, orders)
    within = envelope_frequency <= width  # an envelope has no higher frequencies than its band is wide
    lines = tuple(line_at(envelope_frequency[within], of_envelope[within], *line) for line in expected_lines(kinematic))
    unit = result.units.get(channel, "1")
    return Spectra(channel, unit, orders, frequency, amplitude, envelope_frequency, of_envelope, band, kinematic, lines)


def idle_settings(result: Result, found: Any) -> Any:
    """Names set without effect on a run's Spectra, and until when [s] that was seen; none where the run cannot be repeated."""
    about, path = result.about, Path(result.about.get("fmu", ""))
    names = about.get("set", [])
    if not names or about.get("changes") or not path.is_file() or Model(path).description.guid != about.get("guid"):
        return [], math.inf
    model = Model(path)
    inputs, own = histories_of(about), {n: model.default(v) for n, v in model.parameters.items()}
    parameters = {n: value for n, value in result.parameters.items() if n in own and (value != own[n] or n in names)}
    if set(names) - {*inputs, *parameters}:
        return [], math.inf
    scene = Scene(
        t_end=about["t_end"],
        step=about["step"],
        outputs=tuple(dict.fromkeys([found.channel, *SPEEDS])),
        parameters=ALWAYS | parameters,
        inputs=inputs,
    )

    def late(run):
        return {name: column[settled(run)] for name, column in run.data.items()}

    return without_effect(model, scene, names, late, cost=result.summary.get("wall_time", 0.0))


def default_channel(result):
    """The first of CHANNELS that was recorded and moves."""
    for name in CHANNELS:
        if name in result.data and np.ptp(result.data[name]) > 0.0:
            return name
    raise UserError(f"spectrum: none of {', '.join(CHANNELS)} was recorded; name a channel or record one of them")


def speed_of(result: Result, name: str, rows: Any) -> Any:
    """A recorded speed [rad/s]; UserError if it was not recorded."""
    if name == "housing.omega" and name not in result.data:
        return np.zeros(np.count_nonzero(rows))
    if name not in result.data:
        raise UserError(f"spectrum: {name} was not recorded, of which the kinematic frequencies follow")
    return result.data[name][rows]


def evenly(t, x, channel):
    """The samples without their mean and their rate [Hz]; UserError unless there are enough at equal distances."""
    if len(t) < FEWEST:
        raise UserError(
            f"spectrum: {len(t)} samples after start.settle; at least {FEWEST} are needed: simulate longer or "
            "with a shorter simulation.step"
        )
    steps = np.diff(t)
    if np.ptp(steps) > 1e-6 * steps.mean():
        raise UserError("spectrum: the samples are not at equal distances of time")
    if not np.all(np.isfinite(x)):
        raise UserError(f"spectrum: {channel} has values that are no numbers")
    return x - x.mean(), 1.0 / steps.mean()


def at_equal_angles(t, x, omega):
    """The samples at as many equal angles of the shaft, per turn."""
    turns = cumulative_trapezoid(omega, t, initial=0.0) / (2.0 * math.pi)
    if np.any(np.diff(turns) * np.sign(turns[-1] or 1.0) <= 0.0):
        raise UserError("spectrum: the shaft stops or turns back, so that there is no order")
    turns = np.abs(turns)
    even = np.linspace(0.0, turns[-1], len(t))
    return CubicSpline(turns, x)(even), 1.0 / even[1]


def amplitude_spectrum(x, rate):
    """Frequencies and amplitudes of sines."""
    frequency, power = periodogram(x, rate, window="hann", detrend="constant", scaling="spectrum")
    return frequency, np.sqrt(2.0 * power)


def density(values: np.ndarray, rate: float, segment: int = 1024) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies [Hz] above 0 and amplitude density [unit/√Hz] of samples at a rate, by Welch with Hann windows."""
    f, power = welch(values, rate, nperseg=min(len(values), segment), detrend="constant")
    return f[1:], np.sqrt(power[1:])


def kurtosis_band(x, rate):
    """The band (low, high) of the largest <|X|^4>/<|X|^2>^2 - 2 over frequencies and window lengths."""
    best, found = -math.inf, (0.05 * rate, 0.45 * rate)
    for segment in (n for n in SEGMENTS if 4 * FEWEST_BLOCKS * n <= len(x) or n == SEGMENTS[0]):
        transform, width = ShortTimeFFT(hann(segment, sym=False), hop=segment // 4, fs=rate), 1.5 * rate / segment
        power = np.abs(transform.stft(x)) ** 2
        kurtosis = np.mean(power**2, axis=1) / np.maximum(np.mean(power, axis=1), 1e-300) ** 2 - 2.0
        low, high = transform.f - 0.5 * width, transform.f + 0.5 * width
        kurtosis[(low < LOWEST * rate) | (high > 0.49 * rate)] = -math.inf
        k = int(np.argmax(kurtosis))
        if kurtosis[k] > best:
            best, found = kurtosis[k], (low[k], high[k])
    return tuple(float(f) for f in found)


def kinematic_frequencies(result: Result, speeds: Any, orders: Any) -> Any:
    """Frequencies by name [Hz]; orders of the shaft where its speed changes."""
    Z, parameters = number_of_balls(result), result.parameters
    unit = np.abs(speeds["shaft.omega"]) if orders else 2.0 * math.pi
    inner, outer, cage = (float(np.mean(speeds[f"{name}.omega"] / unit)) for name in ("shaft", "housing", "cage"))
    D, d_m = (parameters[f"bearing.{name}"] for name in ("D", "d_m"))
    ball = (cage - outer) * (d_m / D) * (1.0 + D / d_m * math.cos(contact_angle(result, Z)))
    values = {
        "shaft": inner,
        "housing": outer,
        "FTF": cage,
        "BSF": ball,
        "BPFO": Z * (cage - outer),
        "BPFI": Z * (inner - cage),
    }
    return {name: abs(value) for name, value in values.items()}


def contact_angle(result, Z):
    """Mean contact angle of the loaded balls at the outer race [rad]; 0 where it was not recorded."""
    rows, pairs = settled(result), [(f"ball[{j}].alpha_e", f"ball[{j}].Q_e") for j in range(1, Z + 1)]
    if not all(name in result.data for pair in pairs for name in pair):
        return 0.0
    alpha, load = (np.array([result.data[pair[i]][rows] for pair in pairs]) for i in (0, 1))
    return float(np.sum(np.abs(alpha) * load) / max(np.sum(load), 1e-300))


def expected_lines(kinematic):
    """Names and frequencies of lines, harmonics and side bands; equal ones once, none of what stands still."""
    # a fault that turns passes through the load
    modulators = {"BPFI": "shaft", "BPFO": "housing", "BSF": "FTF"}
    found = []
    for name in ("FTF", "BSF", "BPFO", "BPFI"):
        found += [(name if k == 1 else f"{k} {name}", k * kinematic[name]) for k in range(1, HARMONICS + 1)]
        if modulator := modulators.get(name):
            sides = (("-", -1.0), ("+", 1.0)) if kinematic[modulator] > 0.0 else ()
            bands = [(f"{name} {s} {modulator}", abs(kinematic[name] + k * kinematic[modulator])) for s, k in sides]
            found[1 - HARMONICS : 1 - HARMONICS] = bands
    names = {}
    for name, expected in found:
        same = next((other for other in names if math.isclose(other, expected, rel_tol=1e-9)), expected)
        if expected > 1e-9 * max(kinematic.values()):
            names.setdefault(same, []).append(name)
    return [(" = ".join(called), expected) for expected, called in names.items()]


def line_at(frequency, amplitude, name, expected):
    """The largest amplitude within the resolution, and the median around."""
    step = frequency[1]
    near = np.abs(frequency - expected) <= step
    around = np.abs(frequency - expected) <= 40.0 * step
    if not np.any(near):
        return Line(name, expected, math.nan, 0.0, 0.0)
    k = np.flatnonzero(near)[np.argmax(amplitude[near])]
    return Line(name, expected, float(frequency[k]), float(amplitude[k]), float(np.median(amplitude[around])))


def write_spectra(found: Any, path: Path) -> Path:
    """CSV: comments with band and kinematic frequencies, then frequency, amplitude and squared envelope."""
    head = [f"# channel {found.channel} [{found.unit}]; frequencies: {found.axis}"]
    head.append(f"# band of the envelope {found.band[0]:.9g} to {found.band[1]:.9g}")
    head += [f"# {name} {value:.9g}" for name, value in found.kinematic.items()]
    head.append("frequency,amplitude,envelope_squared")
    table = np.column_stack([found.frequency, found.amplitude, found.envelope])
    options = {"fmt": "%.9g", "delimiter": ",", "header": "\n".join(head), "comments": ""}
    write_atomically(path, lambda temporary: np.savetxt(temporary, table, **options))
    return path


def draw(figure, found):
    """Spectrum above, envelope spectrum with the kinematic frequencies below."""
    colours = {"FTF": MUTED, "BSF": "#e09f3e", "BPFO": HEAD, "BPFI": MIDDLE}
    above, below = figure.subplots(2, 1)
    above.semilogy(found.frequency[1:], np.maximum(found.amplitude[1:], 1e-30), color=FORCE, linewidth=0.6)
    floor = np.median(found.amplitude) * 1e-2
    above.set(ylabel=f"{found.channel} [{found.unit}]", xlabel=found.axis, ylim=(floor or None, None))
    above.axvspan(*found.band, color="#f3f4f6", zorder=0)
    last = 1.05 * HARMONICS * max(found.kinematic["BPFI"], found.kinematic["BPFO"])
    shown = (found.envelope_frequency > 0.0) & (found.envelope_frequency < last)
    below.plot(found.envelope_frequency[shown], found.envelope[shown], color=FORCE, linewidth=0.8)
    for name, colour in colours.items():
        for k in range(1, HARMONICS + 1):
            place = k * found.kinematic[name]
            below.axvline(place, color=colour, linewidth=1.2, linestyle=":", label=name if k == 1 else None)
    below.set(xlabel=found.axis, ylabel=f"squared envelope [{squared(found.unit)}]", xlim=(0.0, last))
    below.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=4)


def squared(unit: str) -> Any:
    return f"{unit}²" if unit.isalpha() else f"({unit})²"


def plot_spectra(found: Any, path: Path) -> Path:
    """A picture of both spectra."""
    with picture(path, (9, 6)) as figure:
        draw(figure, found)
    return path
