"""Both halves of a cage under impacts in their pockets: what bonded joints carry over time, by the full finite elements and by modes of the halves.

Impacts are those of Hertz's law, F = peak sin(pi t/duration)^1.5, along the normal of the wall at an angle from the split (0...180 degrees; beyond 90 on
the side t < 0) in the frame of their own half (x away from the split).  The sum of the loads of both halves, each half of it, moves the halves as
mirror images, which gives N, M_r, M_t of the joints; the difference moves them against each other, which gives V_r, V_t.

Full finite elements, nothing left out: at each complex frequency s one pitch with the stiffness (1 + b s) K + s^2 M is condensed to its loads and its
cuts, the waves of the ring follow from them, and the pads are held: transfer functions from the pockets to the joints.  Laplace's inversion by FFT on
the line s = sigma + i omega, sigma PERIOD = 6: what the next period would add is e^-6 of it.  Frequencies end smoothly between BAND[0] and BAND[1].
"""

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
from scipy.sparse.linalg import splu

from bearing_model import half_modes as modes_of
from bearing_model.half_path import path_rows
from rivet_model import half_loads, half_modes, half_shape
from rivet_model.cage_half import SYMMETRIC

ANGLES = np.deg2rad([3.0, 8.0, 14.0, 22.0, 35.0, 60.0, 88.0, 118.0, 140.0, 156.0, 165.0, 171.0, 178.0])  # medians and tails of recorded impacts: 7 and 14
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
    """Impacts of 35-100 us and 20-120 N within the first 0.5 ms; a third of them hit both halves at the same time, as near the split they do."""
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
        result[impacts.half[i], impacts.pocket[i], impacts.place[i]] += impacts.peak[i] * np.sin(np.pi * phase).clip(0.0) ** 1.5
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


# Full finite elements ----------------------------------------------------------------------------------------------------------------------


class FullHalf:
    """Condensed half whose waves answer at any complex frequency."""

    def __init__(self, g, size):
        self.elastic = half_loads.elastic_half(g, size, np.stack([ANGLES, np.full(len(ANGLES), g.d_m / 2)], axis=1))
        self.alone, e = half_loads.JointAlone(self.elastic), self.elastic
        self.massive = half_modes.MassiveHalf(e)
        p, n, first = e.patterns, len(e.points), len(e.points) - len(ANGLES)
        normal = np.stack([np.sin(ANGLES), 0.0 * ANGLES, np.cos(ANGLES)], axis=1)
        near = p.pocket.start + 3 * (first + np.arange(len(ANGLES)))[:, None] + np.arange(3)
        wall = [np.einsum("daf,af->da", e.loads[:, near + part], normal) for part in (0, 3 * n)]
        head = slice(p.head.start, p.head.start + 3)
        groups = (e.loads[:, p.pad], e.loads[:, p.plane], e.loads[:, head], *wall)
        self.columns = np.column_stack(groups)
        ends = np.cumsum([0] + [group.shape[1] for group in groups])
        self.pad, self.plane, self.head, self.near, self.far = (slice(a, b) for a, b in pairwise(ends))
        self.edge = np.concatenate([e.near, e.far])
        self.inside = np.setdiff1d(np.arange(e.basis.N), self.edge)

    @cached_property
    def parts(self):
        """Stiffness and mass [inside and edge]: II, IB, BB; loads of inside and edge."""
        order = np.concatenate([self.inside, self.edge])
        n = len(self.inside)
        both = [A[order][:, order].tocsc() for A in (self.elastic.K, self.massive.M)]
        return [(A[:n, :n].tocsc(), A[:n, n:].toarray(), A[n:, n:].toarray()) for A in both], self.columns[self.inside], self.columns[self.edge]

    def waves(self, s, damping=DAMPING):
        """Flexibility [waves 0...Z-1, columns, columns] at the frequency s; the far parts of the wall count with the near ones."""
        e, ((K, M), F_I, F_B) = self.elastic, self.parts
        II, IB, BB = ((1.0 + damping * s) * k + s * s * m for k, m in zip(K, M, strict=True))
        X = splu(II.tocsc(), **SYMMETRIC).solve(np.column_stack([F_I.astype(complex), IB]))
        X_F, X_B = X[:, : F_I.shape[1]], X[:, F_I.shape[1] :]
        A_FF, A_FB, stiff = F_I.T @ X_F, F_B.T - F_I.T @ X_B, BB - IB.T @ X_B
        n, angle = len(e.near), 2.0 * np.pi / e.Z
        turn = np.kron(np.eye(n // 3), np.array([[1, 0, 0], [0, np.cos(angle), -np.sin(angle)], [0, np.sin(angle), np.cos(angle)]]))
        result = np.zeros((e.Z, self.near.stop, self.near.stop), dtype=complex)
        for m in range(e.Z // 2 + 1):
            T = np.vstack([np.eye(n), np.exp(1j * m * angle) * turn])
            H = A_FF + A_FB @ T @ np.linalg.solve(T.conj().T @ stiff @ T, T.conj().T @ A_FB.T)
            gather = np.eye(H.shape[0], self.near.stop, dtype=complex)
            gather[self.far, self.near] = np.exp(2j * np.pi * m / e.Z) * np.eye(len(ANGLES))  # they stand one pitch back
            result[m] = gather.conj().T @ H @ gather
            result[-m] = result[m].T
        return result

    def bonded(self, s):
        """One frequency of Transfer: (pocket [Z, 8, ANGLES], pad [Z, 3, 3])."""
        a = self.alone
        C = self.waves(s)
        pocket, pads = np.zeros((len(C), 8, len(ANGLES)), dtype=complex), np.zeros((len(C), 3, 3), dtype=complex)
        gain = np.linalg.inv(a.clamped)
        for m, H in enumerate(C):
            pressure = np.linalg.solve(H[self.pad, self.pad], np.column_stack([H[self.pad, self.near], a.lever]))
            held, pads[m] = pressure[:, : len(ANGLES)], a.lever.T @ pressure[:, len(ANGLES) :]
            M = a.lever.T @ held
            head = H[self.head, self.near] - H[self.head, self.pad] @ held
            shift = head - a.follows @ np.linalg.solve(a.K_0, M)
            V = np.linalg.solve(H[self.plane, self.plane], H[self.plane, self.near])
            pocket[m] = np.concatenate([M[:1], V, M[1:], shift[:1] / a.shortening, (gain @ shift)[1:]])
        return np.fft.ifft(pocket, axis=0), np.fft.ifft(pads, axis=0)

    def transfer(self, progress=lambda done, total: None):
        """Transfer by full finite elements."""
        found = []
        for i, s in enumerate(S):
            found.append(self.bonded(s))
            progress(i + 1, len(S))
        return Transfer(*(np.stack(part) for part in zip(*found, strict=True)))


# Modes -----------------------------------------------------------------------------------------------------------------------------------


def mass_motions(g, inertia):
    """Displacements PAD of all pads [Z, 6, 6] and of pocket 0 at ANGLES along the normal [ANGLES, 6] by the rigid motions of unit mass."""
    scale = 1.0 / np.sqrt([inertia.m] * 3 + [inertia.J_p, inertia.J_t, inertia.J_t])

    def moved(place):
        return np.hstack([np.eye(3), np.cross(np.eye(3), np.asarray(place) - [inertia.x_c, 0.0, 0.0]).T])

    pads = []
    for angle in 2.0 * np.pi * (np.arange(g.Z) + 0.5) / g.Z:
        axes = np.array([[1.0, 0.0, 0.0], [0.0, np.cos(angle), np.sin(angle)], [0.0, -np.sin(angle), np.cos(angle)]])
        pads.append(np.vstack([axes @ moved(0.5 * g.d_m * axes[1]), np.hstack([np.zeros((3, 3)), axes])]) * scale)
    walls = []
    for angle in ANGLES:
        z = half_shape.pocket_radius(g) * np.cos(angle)
        place = [half_shape.pocket_radius(g) * np.sin(angle), np.sqrt(0.25 * g.d_m**2 - z**2), z]
        walls.append([np.sin(angle), 0.0, np.cos(angle)] @ moved(place) * scale)
    return np.stack(pads), np.stack(walls)


def at_angles(modes):
    """Displacements along the normal of pocket 0 by all coordinates [n, ANGLES], and residual rows [Z, 9, ANGLES] by unit forces, between the nodes."""
    shapes, slopes = modes_of.pocket_shapes(modes)[:, 0], modes_of.pocket_shapes(modes, modes.slope)[:, 0]
    wall, rows = [], []
    for angle in ANGLES:
        side, chi = int(angle > np.pi / 2), min(angle, np.pi - angle)
        force = np.array([np.sin(chi), 0.0, np.cos(chi)])
        u = path_rows(modes.chi, np.moveaxis(shapes[:, :, side], 1, 0), np.moveaxis(slopes[:, :, side], 1, 0), chi)
        wall.append(u @ (force * [1.0, 1.0, -1.0 if side else 1.0]))
        row = path_rows(modes.chi, modes.residual.pocket, modes.residual_slope, chi) @ force
        rows.append(row[::-1] * modes_of.EVEN if side else row)
    return np.stack(wall, axis=1), np.stack(rows, axis=-1)


def modal_transfer(g, inertia, modes, with_residual=True):
    """Transfer by the modes of HalfModes and the residual (or, without it, by the residual's resistance of pads alone, which must not be rigid)."""
    Z, omega = g.Z, modes_of.frequencies(modes)
    at, (wall, rows) = modes_of.rivet_shapes(modes), at_angles(modes)
    rigid_pad, rigid_wall = mass_motions(g, inertia)
    pads, walls = np.concatenate([at[:, :, :6], np.moveaxis(rigid_pad, 2, 0)]), np.concatenate([wall, rigid_wall.T])
    rivets = np.concatenate([at[:, :, 6:], np.zeros((6, Z, 3))])
    relative = (np.arange(Z)[:, None] - np.arange(Z)) % Z
    C_pad, C_rivet = modes.residual.pad[relative], modes.residual.rivet[relative]
    rows = rows if with_residual else 0.0 * rows
    pocket, pad = np.zeros((len(S), Z, 8, len(ANGLES)), dtype=complex), np.zeros((len(S), Z, 3, 3), dtype=complex)
    for f, s in enumerate(S):
        stiff = 1.0 + DAMPING * s
        answer = 1.0 / (s * s + np.concatenate([omega**2 * stiff, np.zeros(6)]))
        for chosen, out in (([0, 4, 5], [0, 3, 4]), ([1, 2], [1, 2])):
            n = len(chosen)
            A = pads[:, :, chosen].reshape(len(answer), -1)
            C = A.T @ (answer[:, None] * A) + 1.0 / stiff * C_pad[:, :, chosen][..., chosen].transpose(0, 2, 1, 3).reshape(Z * n, Z * n)
            free = A.T @ (answer[:, None] * walls) + 1.0 / stiff * rows[:, chosen].reshape(Z * n, -1)
            L = np.linalg.solve(C, np.column_stack([free, np.eye(Z * n, n)]))
            held = L[:, : len(ANGLES)]
            pocket[f][:, out] = held.reshape(Z, n, -1)
            if n == 3:
                pad[f] = L[:, len(ANGLES) :].reshape(Z, n, n)
                q = answer[:, None] * (walls - A @ held)
                pocket[f][:, 5:] = np.einsum("ika,il->kal", rivets, q) + 1.0 / stiff * rows[:, 6:]
                pocket[f][:, 5:] -= 1.0 / stiff * np.einsum("kjab,jbl->kal", C_rivet[..., chosen], held.reshape(Z, n, -1))
    return Transfer(pocket, pad)


def errors(found, expected):
    """RMS of the difference over the RMS [8], and the error of the 99.9 % quantile of the modulus [8], of loads [sequences, Z, 8, SAMPLES]."""
    a, b = (np.moveaxis(loads[..., SHOWN], 2, 0).reshape(8, -1) for loads in (found, expected))
    p = np.quantile(np.abs(a), 0.999, axis=1) / np.quantile(np.abs(b), 0.999, axis=1)
    return np.sqrt(((a - b) ** 2).mean(axis=1) / (b**2).mean(axis=1)), p - 1.0
