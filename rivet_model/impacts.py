"""Loads of bonded joints over time if balls hit the pockets, by the modes of both halves: the error that a number of
modes has.

Impacts are those of Hertz's law, F = peak sin(pi t/duration)^1.5, along the normal of the wall at an angle from the
split (0...180 degrees; beyond 90 on the side t < 0) in the frame of their own half (x away from the split).  The sum of
the loads of both halves, each half of it, moves the halves as mirror images, which gives N, M_r, M_t of the joints; the
difference moves them against each other, which gives V_r, V_t.

Transfer functions from the pockets to the joints at complex frequencies s, then Laplace's inversion by FFT on the line
s = sigma + i omega, sigma PERIOD = 6: the next period adds e^-6 of its values.  Frequencies end smoothly between
BAND[0] and BAND[1].  The stiffness is (1 + DAMPING s) K.
"""

from dataclasses import dataclass

import numpy as np

from bearing_model.cage.elastic import half_modes as modes_of
from bearing_model.cage.two_half.half_path import path_rows

from . import half, half_loads

# medians and tails of recorded impacts: 7 and 14
ANGLES = np.deg2rad([3.0, 8.0, 14.0, 22.0, 35.0, 60.0, 88.0, 118.0, 140.0, 156.0, 165.0, 171.0, 178.0])
PERIOD, SAMPLES = 1.024e-3, 2048  # s, and in steps of 0.5 us
SIGMA = 6.0 / PERIOD
BAND = (110e3, 160e3)  # Hz
DAMPING = 0.02 / (2.0 * np.pi * 10e3)  # b [s]: 1 % of critical at 10 kHz
LOADS = ("N", "V_r", "V_t", "M_r", "M_t")
TIME = PERIOD / SAMPLES * np.arange(SAMPLES)
SHOWN = TIME < 0.75 * PERIOD
FREQUENCY = np.arange(int(BAND[1] * PERIOD) + 1) / PERIOD
S = SIGMA + 2j * np.pi * FREQUENCY
TAPER = np.where(FREQUENCY < BAND[0], 1.0, 0.5 + 0.5 * np.cos(np.pi * (FREQUENCY - BAND[0]) / (BAND[1] - BAND[0])))


@dataclass
class Impacts:
    """Impacts on both halves, arrays of one length."""

    start: np.ndarray  # [s]
    duration: np.ndarray  # [s]
    peak: np.ndarray  # [N]
    half: np.ndarray  # 1: +x, 0: -x
    pocket: np.ndarray
    place: np.ndarray  # index of ANGLES


def synthetic(seed, Z=9, count=8):
    """Impacts of 35-100 us and 20-120 N within the first 0.5 ms; a third of them hit both halves at the same time, as
    near the split they do.
    """
    rng = np.random.default_rng(seed)
    half, twice = rng.integers(2, size=count), rng.random(count) < 1 / 3
    weight = np.where(np.minimum(ANGLES, np.pi - ANGLES) < 0.45, 1.0, 0.35)  # most are near the split
    first = Impacts(
        start=np.sort(rng.uniform(0.0, 0.5e-3, count)),
        duration=rng.uniform(35e-6, 100e-6, count),
        peak=rng.uniform(20.0, 120.0, count),
        half=half,
        pocket=rng.integers(Z, size=count),
        place=rng.choice(len(ANGLES), count, p=weight / weight.sum()),
    )
    share = rng.uniform(0.3, 1.0, count)
    other = {name: values[twice] for name, values in vars(first).items()}
    other |= {"half": 1 - half[twice], "peak": (share * first.peak)[twice]}
    return Impacts(**{name: np.concatenate([values, other[name]]) for name, values in vars(first).items()})


def pulses(impacts, Z=9):
    """Forces [half, Z, ANGLES, SAMPLES] over TIME."""
    result = np.zeros((2, Z, len(ANGLES), SAMPLES))
    for i in range(len(impacts.start)):
        phase = np.clip((TIME - impacts.start[i]) / impacts.duration[i], 0.0, 1.0)
        result[impacts.half[i], impacts.pocket[i], impacts.place[i]] += (
            impacts.peak[i] * np.sin(np.pi * phase).clip(0.0) ** 1.5
        )
    return result


def transformed(signal):
    """Laplace transforms [..., FREQUENCY] of signals [..., SAMPLES], band-limited."""
    return PERIOD / SAMPLES * np.fft.rfft(signal * np.exp(-SIGMA * TIME))[..., : len(S)] * TAPER


def over_time(transform):
    """Signals [..., SAMPLES] of transforms [..., FREQUENCY]."""
    full = np.zeros((*transform.shape[:-1], SAMPLES // 2 + 1), dtype=complex)
    full[..., : len(S)] = transform
    return SAMPLES / PERIOD * np.fft.irfft(full, SAMPLES) * np.exp(SIGMA * TIME)


@dataclass
class Transfer:
    """From forces normal to the wall to the loads of bonded joints, and from moves of pads to their loads.

    N, M and rivets' rows are those of mirrored forces, V those of opposed forces, each on one half.
    """

    pocket: np.ndarray  # [FREQUENCY, Z, 8 (LOADS, then dP, dm_r, dm_t), ANGLES] of the rivets behind pocket 0
    pad: np.ndarray  # [FREQUENCY, Z, 3, 3] (N, M_r, M_t) k pitches farther per move (u, phi_r, phi_t)

    def loads(self, force):
        """Loads of all joints [Z, 8, SAMPLES] under forces [half, Z, ANGLES, SAMPLES]."""
        spectrum = np.fft.fft(transformed(force), axis=1)  # waves over the pockets
        waves = np.fft.fft(self.pocket, axis=1)  # waves over the rivets
        mirrored, opposed = 0.5 * (spectrum[1] + spectrum[0]), 0.5 * (spectrum[1] - spectrum[0])
        found = np.einsum("fmla,maf->mlf", waves, mirrored)
        found[:, 1:3] = np.einsum("fmla,maf->mlf", waves[:, :, 1:3], opposed)
        return over_time(np.fft.ifft(found, axis=0))


def mass_motions(g, inertia, lever, pocket=0):
    """Displacements PAD of all pads [Z, 6, 6] and of a pocket at ANGLES along the normal [ANGLES, 6] by the rigid
    motions of unit mass.

    lever: radius at which the pads' friction acts along t [m].
    """
    scale = 1.0 / np.sqrt([inertia.m] * 3 + [inertia.J_p, inertia.J_t, inertia.J_t])

    def moved(place):
        return np.hstack([np.eye(3), np.cross(np.eye(3), np.asarray(place) - [inertia.x_c, 0.0, 0.0]).T])

    def axes(angle):
        return np.array([[1.0, 0.0, 0.0], [0.0, np.cos(angle), np.sin(angle)], [0.0, -np.sin(angle), np.cos(angle)]])

    pads = []
    for k in range(g.Z):
        own = axes(2.0 * np.pi * (k + 0.5) / g.Z)
        pads.append(np.vstack([own @ moved(0.5 * g.d_m * own[1]), np.hstack([np.zeros((3, 3)), own])]) * scale)
        pads[-1][2, 3] = lever * scale[3]
    walls, own, wall = [], axes(2.0 * np.pi * pocket / g.Z), half.wall(g, half.HalfMesh())
    first = half_loads.places(g)[0][0]
    for angle in ANGLES:
        angle = np.clip(angle, first, np.pi - first)
        place, normal = (find(angle, np.float64(0.5 * g.d_m)) for find in (wall.place, wall.normal))
        walls.append(normal @ own @ moved(place @ own) * scale)
    return np.stack(pads), np.stack(walls)


def radial_cylinder(chi):
    """Normal (x, r, t) of a machined pocket's wall."""
    return np.array([np.sin(chi), 0.0, np.cos(chi)])


def at_angles(modes, pocket=0, normal=radial_cylinder):
    """Displacements along the normal of a pocket by all coordinates [n, ANGLES], and residual rows [Z, 9, ANGLES] by
    unit forces, between the nodes; of a ribbon in the middle of its ring.  normal: of the wall over chi.
    """
    shapes, slopes = modes_of.pocket_shapes(modes)[:, pocket], modes_of.pocket_shapes(modes, modes.slope)[:, pocket]
    residual, residual_slope = modes.residual.pocket, modes.residual_slope
    if len(modes.radii):
        middle = len(modes.radii) // 2
        shapes, slopes, residual, residual_slope = (
            shapes[:, middle],
            slopes[:, middle],
            residual[middle],
            residual_slope[middle],
        )
    wall, rows = [], []
    for angle in ANGLES:
        side, chi = int(angle > np.pi / 2), np.maximum(min(angle, np.pi - angle), modes.chi[0])
        force = normal(chi)
        u = path_rows(modes.chi, np.moveaxis(shapes[:, :, side], 1, 0), np.moveaxis(slopes[:, :, side], 1, 0), chi)
        wall.append(u @ (force * [1.0, 1.0, -1.0 if side else 1.0]))
        row = path_rows(modes.chi, residual, residual_slope, chi) @ force
        rows.append(np.roll(row[::-1] * modes_of.EVEN if side else row, pocket, axis=0))
    return np.stack(wall, axis=1), np.stack(rows, axis=-1)


def modal_transfer(g, inertia, modes, lever=None, at_s=S):
    """Transfer by the modes of HalfModes and the residual, whose move d follows the load as d + DAMPING d' does.

    inertia: half_shape.Inertia; lever: see mass_motions, None: the circle of rivets; at_s: frequencies [1/s].
    """
    Z, omega, of_wall = g.Z, modes_of.frequencies(modes), half.wall(g, half.HalfMesh()).normal
    at, (wall, rows) = (
        modes_of.rivet_shapes(modes),
        at_angles(modes, normal=lambda chi: of_wall(chi, np.float64(0.5 * g.d_m))),
    )
    rigid_pad, rigid_wall = mass_motions(g, inertia, lever or 0.5 * g.d_m)
    pads, walls = np.concatenate([at[:, :, :6], np.moveaxis(rigid_pad, 2, 0)]), np.concatenate([wall, rigid_wall.T])
    rivets = np.concatenate([at[:, :, 6:], np.zeros((6, Z, 3))])
    relative = (np.arange(Z)[:, None] - np.arange(Z)) % Z
    C_pad, C_rivet = modes.residual.pad[relative], modes.residual.rivet[relative]
    pocket, pad = np.zeros((len(at_s), Z, 8, len(ANGLES)), dtype=complex), np.zeros((len(at_s), Z, 3, 3), dtype=complex)
    for f, s in enumerate(at_s):
        stiff = 1.0 + DAMPING * s
        answer = 1.0 / (s * s + np.concatenate([omega**2 * stiff, np.zeros(6)]))
        for chosen, out in (([0, 4, 5], [0, 3, 4]), ([1, 2], [1, 2])):
            n = len(chosen)
            A = pads[:, :, chosen].reshape(len(answer), -1)
            C = A.T @ (answer[:, None] * A) + 1.0 / stiff * C_pad[:, :, chosen][..., chosen].transpose(
                0, 2, 1, 3
            ).reshape(Z * n, Z * n)
            free = A.T @ (answer[:, None] * walls) + 1.0 / stiff * rows[:, chosen].reshape(Z * n, -1)
            L = np.linalg.solve(C, np.column_stack([free, np.eye(Z * n, n)]))
            held = L[:, : len(ANGLES)]
            pocket[f][:, out] = held.reshape(Z, n, -1)
            if n == 3:
                pad[f] = L[:, len(ANGLES) :].reshape(Z, n, n)
                q = answer[:, None] * (walls - A @ held)
                pocket[f][:, 5:] = np.einsum("ika,il->kal", rivets, q) + 1.0 / stiff * rows[:, 6:]
                pocket[f][:, 5:] -= (
                    1.0 / stiff * np.einsum("kjab,jbl->kal", C_rivet[..., chosen], held.reshape(Z, n, -1))
                )
    return Transfer(pocket, pad)


def errors(found, expected):
    """RMS of the difference over the RMS [8], and the error of the 99.9 % quantile of the modulus [8], of loads
    [sequences, Z, 8, SAMPLES].
    """
    a, b = (np.moveaxis(loads[..., SHOWN], 2, 0).reshape(8, -1) for loads in (found, expected))
    p = np.quantile(np.abs(a), 0.999, axis=1) / np.quantile(np.abs(b), 0.999, axis=1)
    return np.sqrt(((a - b) ** 2).mean(axis=1) / (b**2).mean(axis=1)), p - 1.0


def modes_error(g, inertia, modes, found, sequences=12):
    """Error of modes against all that were found, under synthetic impacts: for a table's header; loads of bonded
    joints, as fractions.
    """
    force = [pulses(synthetic(seed, g.Z), g.Z) for seed in range(sequences)]
    few, all_found = (
        np.stack([transfer.loads(f) for f in force])
        for transfer in (modal_transfer(g, inertia, m) for m in (modes, found))
    )
    rms, p999 = errors(few, all_found)
    return {
        "modes": int(modes.count.sum()),
        "beside": int(found.count.sum()),
        "highest_Hz": float(f"{modes.omega[-1] / (2.0 * np.pi):.4g}"),
        "rms": {name: float(f"{value:.2g}") for name, value in zip(LOADS, rms, strict=False)},
        "p999": {name: float(f"{value:.2g}") for name, value in zip(LOADS, p999, strict=False)},
    }
