"""The motion of a run as compact numbers that animation.js draws, at a limited number of frames."""

import base64

import numpy as np
from scipy.integrate import cumulative_trapezoid

from ..bearing.ribbon import is_guided_by_balls
from ..running.runner import is_peak
from ..running.summary import clearance_of_cage, gone_from, settled

BUDGET = 650_000  # characters of all channels in the page
SCALARS = (
    *(f"half_{h}.{name}" for h in (0, 1) for name in ("x", "y", "z", "tilt_y", "tilt_z")),
    *("ring.x", "ring.y", "ring.z", "shaft.F_y", "shaft.F_z", "cage.F_pocket_peak", "rivet.sigma_head_max"),
)
OF_BALLS = ("x", "r", "Q_i", "Q_e", "Q_c")
STRESS = "sigma_head_peak"
DRAWN = 0.13  # largest clearance as drawn / ball diameter
BENT = 0.25  # largest motion of a half at a rivet by its modes as drawn / ball diameter
SIZES = (
    *(f"bearing.{name}" for name in ("D", "d_m", "P_d")),
    *(f"cage.{name}" for name in ("D_o", "D_i", "width", "sheet")),
    *(f"cage.{name}" for name in ("pocket_clearance", "guide_clearance", "pocket_depth", "pocket_fillet")),
)
FLEX = tuple(f"flex_{h}_{name}" for h in (0, 1) for name in "xrt")  # of rivets, outputs of elastic halves


def needed(Z):
    """Channels that the drawing cannot do without."""
    halves = [f"half_{h}.{name}" for h in (0, 1) for name in ("x", "y", "z", "psi")]
    return halves + [f"ball[{j}].{name}" for j in range(1, Z + 1) for name in ("x", "r", "psi")]


def number_of_balls(result):
    """Z of the FMU that ran."""
    return sum(name.startswith("ball[") and name.endswith("].dD") for name in result.parameters)


def frames(result):
    """Data for animation.js (None if channels are missing), and the missing channels: azimuths relative to `psi` [rad], channels
    as {first, step, data}: value = first + step n, 16-bit n in base64; SI.
    """
    Z = number_of_balls(result)
    missing = [name for name in needed(Z) if name not in result.data]
    if missing or len(result.data["time"]) < 2:
        return None, missing
    bends = result.parameters.get("scene.cage") == "elastic" and all(
        f"rivet[{k}].{name}" in result.data for k in range(1, Z + 1) for name in FLEX
    )
    stride = thinning(len(result.data["time"]), Z, bends)
    rows = slice(None, None, stride)
    data = result.data
    psi = 0.5 * (data["half_0.psi"] + data["half_1.psi"])
    pitch = 2.0 * np.pi / Z
    channels = {name: data[name] for name in SCALARS if name in data}
    channels["twist"] = data["half_1.psi"] - data["half_0.psi"]
    for j in range(1, Z + 1):
        channels[f"lag{j}"] = data[f"ball[{j}].psi"] - psi - pitch * (j - 1)
        channels |= {f"{name}{j}": data[f"ball[{j}].{name}"] for name in OF_BALLS if f"ball[{j}].{name}" in data}
        if (name := f"rivet[{j}].{STRESS}") in data:
            channels[f"stress{j}"] = data[name]
    forms, widening = bent(result, Z) if bends else ({}, 0.0)
    channels |= {name.replace("rivet[", "").replace("].", "_"): values for name, values in forms.items()}
    turned = {"psi": psi, "shaft": psi}
    if "shaft.omega" in data:
        turned["shaft"] = cumulative_trapezoid(data["shaft.omega"], data["time"], initial=0.0)
    p = result.parameters
    return {
        "Z": Z,
        "time": packed(data["time"][rows]),
        "turned": {name: packed(values[rows]) for name, values in turned.items()},
        "channels": {
            name: quantized(thinned(values, stride) if is_peak(name) or name.startswith("stress") else values[rows])
            for name, values in channels.items()
        },
        "scale": exaggeration(p),
        "land": not is_guided_by_balls(p),
        "bend": magnification(result, forms) if bends else 0.0,
        "widening": widening,
        "bearing": {name: p[name] for name in SIZES if name in p},
        "settle": p.get("start.settle", 0.0),
        "gone": gone_from(result),
    }, []


def thinning(rows, Z, bends=False):
    """Distance of the rows to keep, so that all channels in base64 fit the budget; bends: elastic halves."""
    channels = len(SCALARS) + 1 + Z * (len(OF_BALLS) + 2 + bends * len(FLEX))
    return max(1, -(-rows * channels * 8 // (3 * BUDGET)))


def thinned(values, stride):
    """Largest of the values since the frame before."""
    last = np.arange(0, len(values), stride)
    return np.maximum.reduceat(values, np.concatenate([[0], last[:-1] + 1])) if len(last) > 1 else values[:1]


def exaggeration(p):
    """Factor by which displacements and clearances are magnified: round, limited to a share of the ball."""
    clearances = [p[f"cage.{kind}_clearance"] for kind in {"pocket", clearance_of_cage(p)}]
    return round_factor(DRAWN * p["bearing.D"] / max(0.5 * max(clearances), 1e-5))


def bent(result, Z):
    """Motion of the halves at the rivets by their modes [m], less the mean widening after settling; that [m]."""
    late, forms, widenings = settled(result), {}, []
    for h in (0, 1):
        widenings.append(np.mean([result.data[f"rivet[{k}].flex_{h}_r"][late] for k in range(1, Z + 1)]))
        for k in range(1, Z + 1):
            for name in "xrt":
                channel = f"rivet[{k}].flex_{h}_{name}"
                forms[channel] = result.data[channel] - (widenings[h] if name == "r" else 0.0)
    return forms, float(np.mean(widenings))


def magnification(result, forms):
    """Round factor by which the halves' bending is magnified to a share of the ball."""
    late = settled(result)
    largest = max(np.abs(values[late]).max() for values in forms.values())
    return round_factor(BENT * result.parameters["bearing.D"] / max(largest, 1e-9))


def round_factor(largest):
    """1, 2 or 5 times a power of ten, not above the largest but at least 1; 1 if the largest is no number."""
    if not np.isfinite(largest):
        return 1.0
    decade = 10.0 ** np.floor(np.log10(largest))
    return float(max(1.0, decade * max(step for step in (1, 2, 5) if step * decade <= largest)))


def quantized(values):
    """A channel in 16 bits: error at most 1/131070 of its range."""
    values = np.nan_to_num(np.asarray(values, dtype=float))
    low, high = float(values.min()), float(values.max())
    step = (high - low) / 65535 or 1.0
    numbers = np.round((values - low) / step) - 32768
    return {
        "first": low + 32768 * step,
        "step": step,
        "data": base64.b64encode(numbers.astype("<i2").tobytes()).decode(),
    }


def packed(values):
    """Numbers in 32 bits."""
    return base64.b64encode(np.asarray(values).astype("<f4").tobytes()).decode()
