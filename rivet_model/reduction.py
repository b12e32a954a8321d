"""From the condensed joint to the table: sample the homogeneous response, fit splines, measure the error at loads that
the table was not made from.
"""

import signal
from concurrent.futures import ProcessPoolExecutor
from contextlib import ExitStack
from dataclasses import dataclass
from multiprocessing import get_context

import numpy as np
from threadpoolctl import threadpool_limits

from bearing_model.rivet import rivet_rom, rivet_table

from . import splines

# The ranges of lengths are those of the 6207's joint; those of a joint f times as large are f times as long, and its
# loads at equal stress f^2 times as large.
LENGTH = 0.3e-3  # m, of the axis c: opening joints reach |m|/T = 0.2 mm; heads would lift off at 0.5 mm

# Knots are close together where contacts open: xi = 0...12 nm/N (the bore closes all around).
FULL = {
    "a": np.array([0.0, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 1.0]),
    "c": np.array([0.0, 0.2, 0.45, 0.7, 1.0]),
    "xi": 1e-9
    * np.array([-2800, -1500, -800, -400, -200, -110, -50, -20, -5, 0.5, 1.5, 3, 5, 8, 12, 18, 30, 60, 150, 400]),
}
COARSE = {"a": np.array([0.0, 0.5, 1.0]), "c": np.array([0.0, 1.0]), "xi": 1e-9 * np.array([-1000, -100, 0, 30, 400])}

DIRECTION = {"plane": 0.0, "oblique": np.pi / 3, "across": np.pi / 2}  # of m, to the axis across V: chi = cos


def bending_length(geometry):
    """|m|/T at c = 1 for a geometry [m]."""
    return LENGTH * geometry.size


def knots_for(geometry, knots):
    """FULL or COARSE for a geometry: xi, a length over a load, shrinks with the joint's size."""
    return knots | {"xi": knots["xi"] / geometry.size}


_joint = None  # of the worker processes, inherited by fork


def shank_loads(a, c, length):
    """Loads (T, V, m) of s = 1 N at the table's coordinates: the inverse of the formulas in fmu_src/rivet/rivet_rom.h."""
    return 1.0 - a, a, c * length * (1.0 - a)


def _moments(m, direction):
    """Parts of a moment in the plane of V and across it; exactly 0 where symmetry says so."""
    return 0.0 if direction == np.pi / 2 else m * np.cos(direction), m * np.sin(direction)


def _row(task):
    """Channels per newton at all xi of one (a, c, sheet) [xi, channel]; xi falls: contacts open one after the other."""
    a, c, sheet, xi = task
    T, V, m = shank_loads(a, c, bending_length(_joint.geometry))
    forces, active = [], None
    for value in xi[::-1]:
        force, solution = _joint.solve_shank(T, V, *_moments(m, DIRECTION[sheet]), value, active)
        active = solution.active
        forces.append(force)
    return _joint.channels(np.stack(forces[::-1], axis=1))


def representative(a, c, sheet):
    """One set of coordinates for all those with the same response: c and the sheet are 0 and "plane" where they have no
    meaning.
    """
    return a, 0.0 if a == 1.0 else c, "plane" if a in (0.0, 1.0) or c == 0.0 else sheet


@threadpool_limits.wrap(limits=1)
def _map(joint, function, tasks, workers, progress):
    """function of all tasks, in `workers` processes that inherit the joint by fork, each with one thread: the matrices
    are small.
    """
    global _joint
    _joint = joint
    results = []
    with ExitStack() as stack:
        # a terminal sends Ctrl-C to the workers too
        quiet = {"initializer": signal.signal, "initargs": (signal.SIGINT, signal.SIG_IGN)}
        pool = (
            stack.enter_context(ProcessPoolExecutor(workers, mp_context=get_context("fork"), **quiet))
            if workers > 1
            else None
        )
        for result in pool.map(function, tasks, chunksize=4) if pool else map(function, tasks):
            results.append(result)
            progress(len(results), len(tasks))
    return results


def sample(joint, knots, workers=2, progress=None):
    """S [1/m2] at the sites of all axes: [a, c, xi, sheet, channel]."""
    a, c, xi = (splines.sites(knots[name]) for name in rivet_table.SHANK_AXES)
    names = [representative(x, y, sheet) for x in a for y in c for sheet in rivet_table.SHEETS]
    unique = list(dict.fromkeys(names))
    rows = _map(joint, _row, [(*name, xi) for name in unique], workers, progress or (lambda done, total: None))
    found = dict(zip(unique, rows, strict=True))
    values = np.stack([found[name] for name in names]).reshape(len(a), len(c), len(rivet_table.SHEETS), len(xi), -1)
    return np.moveaxis(values, 2, 3)


@dataclass(frozen=True)
class Load:
    """Loads of the shank in one case of the hold-out set [N, N.m, m]; direction: angle of m to the axis across V
    [rad], 0 bends in the plane of V.
    """

    T: float
    V: float
    m: float
    direction: float
    fit: float


def random_loads(count, seed, largest_fit=9.1e-6, size=1.0):
    """Random loads that no table is made from: T <= 120 N, V <= 60 N, m up to 0.2 mm T in all directions, half of the
    fits in clearance.

    size: of the joint over the 6207's.
    """
    rng = np.random.default_rng(seed)
    loads = []
    for i in range(count):
        direction = rng.choice([0.0, np.pi / 2, rng.uniform(0.0, np.pi / 2)])
        fit = -90e-6 * rng.uniform() ** 2 if i % 2 == 0 else largest_fit * rng.uniform()
        T = rng.uniform(2, 120)
        V, m = rng.uniform(0, 60), 0.2e-3 * T * rng.uniform()
        loads.append(Load(T * size**2, V * size**2, m * size**3, direction, fit * size))
    return loads


def rivet_load(loads):
    """RivetLoad of Load's, V along y."""
    T, V, m, direction = (np.array([getattr(load, name) for load in loads]) for name in ("T", "V", "m", "direction"))
    return rivet_rom.RivetLoad(T, V, 0.0 * V, m * np.sin(direction), m * np.cos(direction))


def _fresh(load):
    forces, _ = _joint.solve_shank(load.T, load.V, *_moments(load.m, load.direction), load.fit)
    return _joint.channels(forces[:, None])[0]


def solve_loads(joint, loads, workers=2, progress=None):
    """Channels [loads, 4] in Pa by fresh contact solutions."""
    return np.array(_map(joint, _fresh, loads, workers, progress or (lambda done, total: None)))


def table_stress(t, loads):
    """Channels [loads, 4] in Pa by the table at effective fit = fit."""
    return rivet_rom.rivet_rom_stress(t, rivet_load(loads), np.array([load.fit for load in loads]))[0]


def hold_out_errors(t, loads, fresh):
    """Largest and RMS error of each channel relative to the channel's maximum, over all loads and over those in
    clearance.
    """
    got, clear = table_stress(t, loads), np.array([load.fit <= 0.0 for load in loads])
    report = {}
    for name, chosen in (("all", np.ones(len(loads), dtype=bool)), ("clearance", clear)):
        error = (got - fresh)[chosen] / fresh[chosen].max(axis=0)
        report[name] = {
            "loads": int(chosen.sum()),
            "maximum": dict(zip(rivet_table.CHANNELS, np.abs(error).max(axis=0).round(5).tolist(), strict=True)),
            "rms": dict(zip(rivet_table.CHANNELS, np.sqrt((error**2).mean(axis=0)).round(5).tolist(), strict=True)),
            "channel_maximum_MPa": dict(
                zip(rivet_table.CHANNELS, (fresh[chosen].max(axis=0) / 1e6).round(1).tolist(), strict=True)
            ),
        }
    return report
