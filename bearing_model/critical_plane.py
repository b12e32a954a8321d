"""Critical plane after Findley for a history of stress at a free surface: offline, from logged loads and the rivet's finite elements.

    f = max over planes of (tau_a + k sigma_n,max)        Findley (1959); crack initiation where f reaches the material's limit

tau_a: shear amplitude on the plane (half the largest extent of the shear vector's path), sigma_n,max: largest normal stress on it.
"""

from dataclasses import dataclass

import numpy as np

DIRECTIONS = 36  # in a plane, over 180 degrees: extent to (1 - cos 2.5 deg) = 0.1 %


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

    stress: (tt, hoop, shear) [3, times] in Pa, meridian, hoop and shear stress of a free surface; k: Findley's constant (0.2...0.3 for ductile
    steel).  step: angle between the planes tried [deg].  Raises ValueError for another shape or numbers that are not finite.

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


def rivet_history(joint, loads, angles=16):
    """Surface stress of both fillets and the middle over a history of loads: three arrays [3, points, angles, times] in Pa.

    joint: rivet_model.load_cases.Joint.  loads: (P, N, V, M_plane, M_across, fit, azimuth) per time, azimuth of V in the rivet [rad]; SI.
    """
    fields = []
    for P, N, V, M_plane, M_across, fit, azimuth in loads:
        forces = joint.solve(P, N, V, M_plane, M_across, fit)[0]
        turn = round(azimuth / (2 * np.pi / angles)) % angles  # to the nearest of the angles
        fields.append([np.roll(field[..., 0], turn, axis=2) for field in joint.fields(forces[:, None], angles)])
    return tuple(np.stack([f[i] for f in fields], axis=-1) for i in range(3))
