"""From the condensed joint to the table: sample the homogeneous response, fit splines, measure the error on loads that did not build it."""

import os
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context

import numpy as np

from bearing_model import rivet_rom

from . import splines, table
from .closed_form import loads_of
from .load_cases import Joint

MOMENT_LENGTH = 2e-3  # L: prying opens the default joint near M = P L

# Knots close where contacts open: b = 1/2 (N = P), c = 1/2 (M = P L), xi = 0...12 nm/N (the bore closes all around).
FULL = {
    "a": np.array([0.0, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 1.0]),
    "b": np.array([0.0, 0.2, 0.35, 0.44, 0.5, 0.56, 0.65, 0.77, 0.9, 1.0]),
    "c": np.array([0.0, 0.07, 0.15, 0.3, 0.42, 0.54, 0.7, 1.0]),
    "xi": 1e-9 * np.array([-2800, -1500, -800, -400, -200, -110, -50, -20, -5, 0.5, 1.5, 3, 5, 8, 12, 18, 30, 60, 150, 400]),
}
COARSE = {"a": np.array([0.0, 0.5, 1.0]), "b": np.array([0.0, 0.5, 1.0]), "c": np.array([0.0, 0.5, 1.0]), "xi": 1e-9 * np.array([-1000, -100, 0, 30, 400])}

_joint = None  # of the worker processes, inherited by fork


def _use_one_thread():
    for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"):
        os.environ[name] = "1"


def _row(task):
    """All xi of one (a, b, c, sheet), from high to low so that contacts open one after the other: T in 1/m2 [xi, channel]."""
    a, b, c, sheet, xi = task
    P, N, V, M = loads_of(a, b, c, MOMENT_LENGTH)
    forces, active = [], None
    for value in xi[::-1]:
        moments = (M, 0.0) if sheet == "plane" else (0.0, M)
        force, _, solution, _ = _joint.solve(P, N, V, *moments, value, active)
        active = solution.active
        forces.append(force)
    return _joint.channels(np.stack(forces[::-1], axis=1))


def representative(a, b, c, sheet):
    """Coordinates that stand for all equal ones: where a, b or the sheet have no meaning they are 0 and "plane"."""
    if c == 1.0:
        a = b = 0.0
    if a == 1.0:
        b = 0.0
    if c in (0.0, 1.0) or a == 0.0:
        sheet = "plane"
    return a, b, c, sheet


def _map(joint, function, tasks, workers, progress):
    global _joint
    _joint = joint
    results = []
    if workers == 1:
        for i, task in enumerate(tasks):
            results.append(function(task))
            progress(i + 1, len(tasks))
        return results
    with ProcessPoolExecutor(workers, mp_context=get_context("fork")) as pool:
        for i, result in enumerate(pool.map(function, tasks, chunksize=4)):
            results.append(result)
            progress(i + 1, len(tasks))
    return results


def sample(joint, knots, workers=2, progress=None):
    """T [1/m2] at the sites of all axes: [a, b, c, xi, sheet, channel]."""
    a, b, c, xi = (splines.sites(knots[name]) for name in table.AXES)
    points = [(x, y, z, sheet) for x in a for y in b for z in c for sheet in table.SHEETS]
    names = [representative(*point) for point in points]
    unique = list(dict.fromkeys(names))
    rows = _map(joint, _row, [(*name, xi) for name in unique], workers, progress or (lambda done, total: None))
    found = dict(zip(unique, rows, strict=True))
    values = np.stack([found[name] for name in names]).reshape(len(a), len(b), len(c), len(table.SHEETS), len(xi), -1)
    return np.moveaxis(values, 3, 4)


@dataclass(frozen=True)
class Load:
    """One load of the hold-out set [N, N.m, m]; direction: angle of M to the axis across V [rad], 0 bends in the plane of V."""

    P: float
    N: float
    V: float
    M: float
    direction: float
    fit: float


def random_loads(count, seed, largest_fit=9.1e-6, clearance_only=False):
    """Loads of the study's hold-out with prying in all directions: P, V <= 60 N, N <= 40 N, M <= 60 N.mm, half of the fits in clearance."""
    rng = np.random.default_rng(seed)
    loads = []
    for i in range(count):
        clear = clearance_only or i % 2 == 0
        direction = rng.choice([0.0, np.pi / 2, rng.uniform(0.0, np.pi / 2)])
        fit = -90e-6 * rng.uniform() ** 2 if clear else largest_fit * rng.uniform()
        loads.append(Load(rng.uniform(0, 60), rng.uniform(0, 40), rng.uniform(0, 60), rng.uniform(0, 0.06), direction, fit))
    return loads


def _fresh(load):
    across = np.pi / 2 == load.direction
    M_plane = 0.0 if across else load.M * np.cos(load.direction)
    M_across = load.M if across else load.M * np.sin(load.direction)
    force, *_ = _joint.solve(load.P, load.N, load.V, M_plane, M_across, load.fit)
    return _joint.channels(force[:, None])[0]


def solve_loads(joint, loads, workers=2, progress=None):
    """Channels [loads, 4] in Pa by fresh contact solutions."""
    return np.array(_map(joint, _fresh, loads, workers, progress or (lambda done, total: None)))


def table_stress(t, loads):
    """Channels [loads, 4] in Pa by the table at effective fit = fit."""
    P, N, V, M, direction, fit = (np.array([getattr(load, name) for load in loads]) for name in ("P", "N", "V", "M", "direction", "fit"))
    rivet_load = rivet_rom.RivetLoad(P, N, V, 0.0 * V, M * np.sin(direction), M * np.cos(direction))
    return rivet_rom.rivet_rom_stress(t, rivet_load, fit)[0]


def hold_out_errors(t, loads, fresh):
    """Largest and RMS error of each channel relative to the channel's maximum, over all loads and over those in clearance."""
    got, clear = table_stress(t, loads), np.array([load.fit <= 0.0 for load in loads])
    report = {}
    for name, chosen in (("all", np.ones(len(loads), dtype=bool)), ("clearance", clear)):
        error = (got - fresh)[chosen] / fresh[chosen].max(axis=0)
        report[name] = {
            "loads": int(chosen.sum()),
            "maximum": dict(zip(table.CHANNELS, np.abs(error).max(axis=0).round(5).tolist(), strict=True)),
            "rms": dict(zip(table.CHANNELS, np.sqrt((error**2).mean(axis=0)).round(5).tolist(), strict=True)),
            "channel_maximum_MPa": dict(zip(table.CHANNELS, (fresh[chosen].max(axis=0) / 1e6).round(1).tolist(), strict=True)),
        }
    return report


def condense(geometry, grid, progress=None):
    """The condensed joint, computed with one thread: processes share the machine."""
    _use_one_thread()
    return Joint(geometry, grid, progress)
