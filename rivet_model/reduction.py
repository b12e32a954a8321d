"""From the condensed joint to the table: sample the homogeneous response, fit splines, measure the error at loads that the table was not made from."""

import signal
from concurrent.futures import ProcessPoolExecutor
from contextlib import ExitStack
from dataclasses import dataclass
from multiprocessing import get_context

import numpy as np
from threadpoolctl import threadpool_limits

from bearing_model import rivet_rom, rivet_table

from . import splines
from .closed_form import loads_of
from .load_cases import Joint

MOMENT_LENGTH = 2e-3  # L: prying opens the default joint near M = P L

# Knots are close together where contacts open: b = 1/2 (N = P), c = 1/2 (M = P L), xi = 0...12 nm/N (the bore closes all around).
FULL = {
    "a": np.array([0.0, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 1.0]),
    "b": np.array([0.0, 0.2, 0.35, 0.44, 0.5, 0.56, 0.65, 0.77, 0.9, 1.0]),
    "c": np.array([0.0, 0.07, 0.15, 0.3, 0.42, 0.54, 0.7, 1.0]),
    "xi": 1e-9 * np.array([-2800, -1500, -800, -400, -200, -110, -50, -20, -5, 0.5, 1.5, 3, 5, 8, 12, 18, 30, 60, 150, 400]),
}
COARSE = {"a": np.array([0.0, 0.5, 1.0]), "b": np.array([0.0, 0.5, 1.0]), "c": np.array([0.0, 0.5, 1.0]), "xi": 1e-9 * np.array([-1000, -100, 0, 30, 400])}

DIRECTION = {"plane": 0.0, "oblique": np.pi / 3, "across": np.pi / 2}  # of M, to the axis across V: chi = cos

_joint = None  # of the worker processes, inherited by fork


def _moments(M, direction):
    """Parts of a moment in the plane of V and across it; exactly 0 where symmetry says so."""
    return 0.0 if direction == np.pi / 2 else M * np.cos(direction), M * np.sin(direction)


def _row(task):
    """Results of `measure` per newton at all xi of one (a, b, c, sheet) [xi, ...]; xi falls, so that contacts open one after the other."""
    a, b, c, sheet, xi, measure = task
    P, N, V, M = loads_of(a, b, c, MOMENT_LENGTH)
    forces, active = [], None
    for value in xi[::-1]:
        force, _, solution, _ = _joint.solve(P, N, V, *_moments(M, DIRECTION[sheet]), value, active)
        active = solution.active
        forces.append(force)
    return measure(_joint, np.stack(forces[::-1], axis=1))


def representative(a, b, c, sheet):
    """One set of coordinates for all those with the same response: a, b and the sheet are 0 and "plane" where they have no meaning."""
    if c == 1.0:
        a = b = 0.0
    if a == 1.0:
        b = 0.0
    if c in (0.0, 1.0) or a == 0.0:
        sheet = "plane"
    return a, b, c, sheet


@threadpool_limits.wrap(limits=1)
def _map(joint, function, tasks, workers, progress):
    """function of all tasks, in `workers` processes that inherit the joint by fork, each with one thread: the matrices are small."""
    global _joint
    _joint = joint
    results = []
    with ExitStack() as stack:
        quiet = {"initializer": signal.signal, "initargs": (signal.SIGINT, signal.SIG_IGN)}  # a terminal sends Ctrl-C to the workers too
        pool = stack.enter_context(ProcessPoolExecutor(workers, mp_context=get_context("fork"), **quiet)) if workers > 1 else None
        for result in pool.map(function, tasks, chunksize=4) if pool else map(function, tasks):
            results.append(result)
            progress(len(results), len(tasks))
    return results


def sample(joint, knots, workers=2, progress=None, measure=Joint.channels, representative=representative):
    """T [1/m2] at the sites of all axes: [a, b, c, xi, sheet, channel].

    measure(joint, forces [contacts, cases]) -> [cases, numbers]; representative: maps coordinates to those with the same response.
    """
    a, b, c, xi = (splines.sites(knots[name]) for name in rivet_table.AXES)
    points = [(x, y, z, sheet) for x in a for y in b for z in c for sheet in rivet_table.SHEETS]
    names = [representative(*point) for point in points]
    unique = list(dict.fromkeys(names))
    rows = _map(joint, _row, [(*name, xi, measure) for name in unique], workers, progress or (lambda done, total: None))
    found = dict(zip(unique, rows, strict=True))
    values = np.stack([found[name] for name in names]).reshape(len(a), len(b), len(c), len(rivet_table.SHEETS), len(xi), -1)
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
    """Random loads that no table is made from, with prying in all directions: P, V <= 60 N, N <= 40 N, M <= 60 N.mm, half of the fits in clearance."""
    rng = np.random.default_rng(seed)
    loads = []
    for i in range(count):
        clear = clearance_only or i % 2 == 0
        direction = rng.choice([0.0, np.pi / 2, rng.uniform(0.0, np.pi / 2)])
        fit = -90e-6 * rng.uniform() ** 2 if clear else largest_fit * rng.uniform()
        loads.append(Load(rng.uniform(0, 60), rng.uniform(0, 40), rng.uniform(0, 60), rng.uniform(0, 0.06), direction, fit))
    return loads


def load_forces(joint, load):
    """Contact forces [contacts] of a fresh solution."""
    return joint.solve(load.P, load.N, load.V, *_moments(load.M, load.direction), load.fit)[0]


def _fresh(load):
    return _joint.channels(load_forces(_joint, load)[:, None])[0]


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
            "maximum": dict(zip(rivet_table.CHANNELS, np.abs(error).max(axis=0).round(5).tolist(), strict=True)),
            "rms": dict(zip(rivet_table.CHANNELS, np.sqrt((error**2).mean(axis=0)).round(5).tolist(), strict=True)),
            "channel_maximum_MPa": dict(zip(rivet_table.CHANNELS, (fresh[chosen].max(axis=0) / 1e6).round(1).tolist(), strict=True)),
        }
    return report
