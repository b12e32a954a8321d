"""Critical plane after Findley for a history of stress at a free surface: offline, from logged loads and the rivet's
stress components.

    f = max over planes of (tau_a + k sigma_n,max)        Findley (1959); crack initiation where f reaches the material's limit

tau_a: shear amplitude on the plane (half the largest extent of the shear vector's path), sigma_n,max: largest normal
stress on it.

    place, point, angle, plane = worst_point([joint.fields(solution) for joint in ...])     # rivet_model.load_cases.Joint
"""

from dataclasses import dataclass

import numpy as np

from bearing_model.rivet.rivet_rom import RivetLoad

DIRECTIONS = 36  # tried in a plane, over 180 degrees: they give the extent within 1 - cos(2.5 deg) = 0.1 %


@dataclass(frozen=True)
class CriticalPlane:
    """f, shear amplitude and largest normal stress [Pa] on the worst plane, its normal (meridian, hoop, outward)."""

    f: float
    tau_a: float
    sigma_n: float
    normal: np.ndarray


def plane_normals(step=5.0):
    """Unit normals over the half sphere, `step` degrees apart [planes, 3]."""
    normals = [np.array([0.0, 0.0, 1.0])]
    for tilt in np.deg2rad(np.arange(step, 90.0 + 1e-9, step)):
        turns = np.deg2rad(np.arange(0.0, 180.0 if tilt > np.pi / 2 - 1e-9 else 360.0, step))
        normals += [np.array([np.sin(tilt) * np.cos(a), np.sin(tilt) * np.sin(a), np.cos(tilt)]) for a in turns]
    return np.array(normals)


def findley(stress, k=0.3, step=5.0):
    """Worst plane of one point's history.

    stress: (tt, hoop, shear) [3, times] in Pa, meridian, hoop and shear stress of a free surface; k: Findley's constant
    (0.2...0.3 for ductile steel).  step: angle between the planes tried [deg].  Raises ValueError for another shape or
    numbers that are not finite.

    >>> cycle = np.array([[1.0, -1.0], [0.0, 0.0], [0.0, 0.0]])
    >>> round(findley(cycle, k=0.0, step=5.0).f, 6)
    0.5
    """
    stress = np.asarray(stress, dtype=float)
    if stress.ndim != 2 or stress.shape[0] != 3 or not np.all(np.isfinite(stress)):
        raise ValueError(f"stress has shape {stress.shape}: allowed are finite numbers [3, times]")
    tt, hoop, shear = stress
    angles = np.pi * np.arange(DIRECTIONS) / DIRECTIONS
    best = None
    for n in plane_normals(step):
        traction = np.stack([tt * n[0] + shear * n[1], shear * n[0] + hoop * n[1], 0.0 * tt])
        normal = n @ traction
        first = np.cross(n, [1.0, 0.0, 0.0] if abs(n[0]) < 0.9 else [0.0, 1.0, 0.0])
        first /= np.linalg.norm(first)
        path = np.outer(np.cos(angles), first @ traction) + np.outer(np.sin(angles), np.cross(n, first) @ traction)
        tau_a = 0.5 * np.ptp(path, axis=1).max()
        f = tau_a + k * normal.max()
        if best is None or f > best.f:
            best = CriticalPlane(float(f), float(tau_a), float(normal.max()), n)
    return best


def worst_point(fields, k=0.3, step=5.0):
    """Worst of all points of several histories: (place, point, angle, CriticalPlane), indices into `fields`.

    fields: arrays [3, points, angles, times] of (tt, hoop, shear) in Pa, e.g. of
    rivet_model.load_cases.Joint.fields.  The points are searched in the order of an upper bound of f (half the
    norm of the ranges for tau_a, the largest principal stress for sigma_n), and the search ends where the bound falls
    below the largest f found.
    """
    candidates = []
    for place, field in enumerate(fields):
        spread = np.ptp(field, axis=-1)
        mean, half = 0.5 * (field[0] + field[1]), np.hypot(0.5 * (field[0] - field[1]), field[2])
        bound = 0.5 * np.sqrt((spread[0] ** 2 + spread[1] ** 2) / 2 + spread[2] ** 2) + k * np.maximum(
            np.max(mean + half, axis=-1), 0.0
        )
        candidates += [(value, place, *index) for index, value in np.ndenumerate(bound)]
    worst = None
    for bound, place, point, angle in sorted(candidates, reverse=True):
        if worst is not None and bound <= worst[-1].f:
            break
        found = findley(fields[place][:, point, angle], k, step)
        if worst is None or found.f > worst[-1].f:
            worst = place, point, angle, found
    return worst


LOGGED = {"T": "T", "V_y": "V_y", "V_z": "V_z", "m_y": "M_shank_y", "m_z": "M_shank_z", "F_head": "F_head"}


def logged_load(data, k):
    """RivetLoad of rivet k over time from the outputs rivet[k].T, V_y, V_z, M_shank_y, M_shank_z, F_head of a run;
    data: arrays by name of the output.
    """
    return RivetLoad(**{name: np.asarray(data[f"rivet[{k}].{output}"]) for name, output in LOGGED.items()})
