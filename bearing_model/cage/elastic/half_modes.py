"""Vibration modes of a free cage half in cyclic form, and the static flexibility beside them; rivet_model/half_modes.py
makes the numbers.

The half is a ring of Z equal pitches, each its own mirror image in its pocket's plane.  In a mode of harmonic n
(0...Z//2) pitch j moves as pitch 0 does, turned by 2 pi j/Z about the axis, with the phase 2 pi n j/Z.  With the
coordinates a (cos) and b (sin) its displacement at a place whose amplitude on pitch 0 is U is

    u_j = Re[(a - i b) U exp(i nu)] = a (U' cos nu - U'' sin nu) + b (U' sin nu + U'' cos nu),     U = U' + i U''
    pocket j, side t > 0    nu = 2 pi n j/Z           U as in `pocket`, over the wall's angle chi, along (x, r, t) of the pocket
              side t < 0                              (U_x, U_r, -U_t) conjugate
    rivet k                 nu = 2 pi n (k + 1/2)/Z   U real along x, r and about t; i times real along t and about x, r (EVEN)

a and b are two modes of the same frequency; for n = 0 and n = Z/2 there is only a (parity +1) or only b (parity -1).
All are free-free modes, normalised with the mass of the half with its part of the rivets (`half.m`) and orthogonal to
its rigid motions:

    q'' + omega^2 q = sum over places u . f + spin omega_c^2            u: displacement by q = 1; f: force or moment there

The other modes contribute their static displacement only, the residual: the static displacement of the free half, whose
inertia balances the loads, less the part of the modes in the table.  Pads: displacements (x, r, t) and
rotations (about x, r, t) at the rivet, work-conjugate to the loads of the bonded joint
(half_loads.py: N, M_r, M_t of pads that do not move along x; V_r, V_t
of friction below the head's cone).  Rivet: change of preload and bending moments of the rivet by the elastic
deformation of the half under its head, as the rows dP, dm_r, dm_t of half_path.py.  They are zero if the
half moves about the joint as a rigid body; the part caused by the joint's own load is in the law of the joint.
"""

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from bearing_model.cage.common.joint_law import LawOfModes
from bearing_model.cage.two_half.half_path import cubic_slopes, land_harmonics

PAD = ("x", "r", "t", "phi_x", "phi_r", "phi_t")
RIVET = ("dP", "dm_r", "dm_t")
# of PAD and RIVET: 1 if mirroring in the rivet's plane leaves it as it is, else -1
EVEN = np.array([1.0, 1.0, -1.0, -1.0, -1.0, 1.0, 1.0, -1.0, 1.0])
MIRROR = np.array([1.0, 1.0, -1.0])  # of x, r, t
OUT = [0, 4, 5]  # of PAD: relative motions of two pads out of the plane of the split
RIM_WAVES = (2, 3)  # of a rim's bending at the land that changes its film (land_bent.py)
OTHER_HALF = np.array([-1.0, 1.0, 1.0, 1.0, -1.0, -1.0])  # of PAD: the other half is the mirror image in the split


@dataclass
class Residual:
    """Static displacements of the free half less those of its modes; they do not depend on its density."""

    pad: np.ndarray  # [Z, PAD, PAD] at the rivet k pitches farther by unit loads on a pad
    rivet: np.ndarray  # [Z, RIVET, PAD] by unit loads on a pad
    # [chi, Z, PAD and RIVET, 3] at the rivets by unit forces (x, r, t) on the wall of pocket 0, t > 0
    pocket: np.ndarray
    spin: np.ndarray  # [PAD and RIVET] at any rivet per (rad/s)^2 at mass m
    # [chi] of the wall under the contact, along its normal, less the indentation that Hertz's formula counts [m/N]
    wall: np.ndarray


@dataclass
class HalfModes:
    """Modes by rising frequency, an entry for each pair and for each single one."""

    Z: int
    chi: np.ndarray  # nodes of the wall's angle [rad]
    omega: np.ndarray  # [entries] rad/s
    harmonic: np.ndarray  # [entries] n
    parity: np.ndarray  # [entries] 0: pair, 1: a alone, -1: b alone
    pocket: np.ndarray  # [entries, chi, 3, U' and U''] kg^-1/2
    pad: np.ndarray  # [entries, PAD]
    rivet: np.ndarray  # [entries, RIVET]
    rim: np.ndarray  # [entries, outer and inner] amplitude of the radial displacement cos(n theta): mean over the rim
    # [entries, harmonic, 1 and x] amplitudes of the rim's radial displacement at the land (half_lands.py) [kg^-1/2, and 1/m]
    land: np.ndarray
    spin: np.ndarray  # [entries] force per (rad/s)^2 at mass m
    residual: Residual
    law: LawOfModes  # of the joints, around the stiffness that these modes leave
    # [waves, harmonic, 1 and x, (x, phi_r, phi_t)] motions of the pads beside those of the modes by G_p = 1 on one half
    land_residual: np.ndarray
    # nodes of the wall's radius [m] of a ribbon, whose `pocket`, `residual.pocket` and `residual.wall` have them before chi
    radii: np.ndarray = field(default_factory=lambda: np.zeros(0))

    @property
    def count(self):
        """Modes of each entry: 2 of a pair, else 1."""
        return np.where(self.parity == 0, 2, 1)

    @property
    def room(self):
        """Least room for them in the state, in octets: half of it, in octets too, takes the coordinates of one kind."""
        one = max(np.sum(self.parity >= 0), np.sum(self.parity <= 0))
        return int(max(8 * -(-self.count.sum() // 8), 16 * -(-one // 8) - 8))

    @cached_property
    def slope(self):
        """Of `pocket` over chi [entries, chi, 3, 2]."""
        beyond = self.pocket[..., -2, :, :] * MIRROR[:, None] * [1.0, -1.0]  # at pi - chi
        return self._slopes(self.pocket, beyond, axis=-3)

    @cached_property
    def residual_slope(self):
        """Of `residual.pocket` over chi."""
        pocket = self.residual.pocket
        beyond = pocket[..., -2, ::-1, :, :] * EVEN[:, None] * MIRROR
        return self._slopes(pocket, beyond, axis=-4)

    def _slopes(self, values, beyond, axis):
        """Slopes over chi on an axis of values, whose mirrored last node is `beyond`."""
        every = np.moveaxis(np.concatenate([values, np.expand_dims(beyond, axis)], axis=axis), axis, 0)
        return np.moveaxis(cubic_slopes(np.append(self.chi, np.pi - self.chi[-2]), every), 0, axis)


def land_shapes(modes, x):
    """Radial displacement of the rim at the land x by all coordinates: cos |p| theta of the a, sin |p| theta of the b,
    [n, harmonic].
    """
    p = land_harmonics(modes.Z)[modes.harmonic]
    both = np.zeros((2, len(p), (3 * modes.Z - 1) // 2 + 1))
    for i in range(p.shape[1]):
        W = modes.land[:, i, 0] + x * modes.land[:, i, 1]
        for part, sign in ((0, 1.0), (1, np.sign(p[:, i]))):
            np.add.at(both[part], (np.arange(len(p)), np.abs(p[:, i])), W * sign)
    return coordinates(modes, *both)


def rim_amplitudes(modes):
    """Radial displacement of the rim at the land by cos p theta of the a and sin p theta of the b, p of RIM_WAVES:
    [entries, a and b, p, 1 and x]; 0 of a wave that Z pitches do not have by itself.
    """
    P, result = land_harmonics(modes.Z)[modes.harmonic], np.zeros((len(modes.omega), 2, len(RIM_WAVES), 2))
    for k, p in enumerate(RIM_WAVES):
        here = (np.abs(P) == p) & (modes.harmonic == p)[:, None]
        for part, sign in ((0, np.ones_like(P)), (1, np.sign(P))):
            result[:, part, k] = np.sum((here * sign)[..., None] * modes.land, axis=1)
    return result


def rim_shapes(modes, x):
    """Radial displacement of the rim by all coordinates at the land x [n, cos 2, sin 2, cos 3, sin 3 theta]."""
    a, b = np.moveaxis(rim_amplitudes(modes) @ np.array([1.0, x]), 1, 0)
    cosine, sine = np.stack([a, 0.0 * a], axis=-1), np.stack([0.0 * b, b], axis=-1)
    return coordinates(modes, cosine.reshape(len(a), -1), sine.reshape(len(b), -1))


def phases(modes, shift):
    """cos and sin of n 2 pi (j + shift)/Z [entries, Z]."""
    nu = 2.0 * np.pi / modes.Z * np.outer(modes.harmonic, np.arange(modes.Z) + shift)
    return np.cos(nu), np.sin(nu)


def coordinates(modes, a, b):
    """Rows of all coordinates in order, from those of a and of b [entries, ...]: both of a pair, the one that a single
    mode has.
    """
    rows = np.stack([a, b], axis=1)
    return rows[np.stack([modes.parity >= 0, modes.parity <= 0], axis=1)]


def frequencies(modes):
    """omega of all coordinates [n]."""
    return np.repeat(modes.omega, modes.count)


def pocket_shapes(modes, values=None):
    """Displacements (x, r, t) of all coordinates at all pockets [n, Z, chi, t > 0 and t < 0, 3]; values: `slope` for
    their slopes over chi.
    """
    U = modes.pocket if values is None else values
    c, s = (f.reshape(*f.shape, *[1] * (U.ndim - 2)) for f in phases(modes, 0.0))
    sides = []
    for re, im in ((U[..., 0], U[..., 1]), (U[..., 0] * MIRROR, -U[..., 1] * MIRROR)):
        re, im = re[:, None], im[:, None]
        sides.append(coordinates(modes, re * c - im * s, re * s + im * c))
    return np.stack(sides, axis=-2)


def rivet_shapes(modes):
    """PAD and RIVET of all coordinates at all rivets [n, Z, 9]."""
    w = np.concatenate([modes.pad, modes.rivet], axis=1)[:, None]
    c, s = (f[:, :, None] for f in phases(modes, 0.5))
    even = EVEN > 0.0
    return coordinates(modes, w * np.where(even, c, -s), w * np.where(even, s, c))


def spin_load(modes):
    """Modal forces of all coordinates per (rad/s)^2 [n]."""
    return coordinates(modes, modes.spin, 0.0 * modes.spin)


def denser(modes, ratio):
    """The modes of a half whose density everywhere is `ratio` times as large: omega and all shapes by 1/sqrt(ratio),
    forces of the spin by sqrt(ratio).
    """
    root = np.sqrt(ratio)
    scaled = {name: getattr(modes, name) / root for name in ("omega", "pocket", "pad", "rivet", "rim", "land")}
    return replace(
        modes, **scaled, spin=modes.spin * root, residual=replace(modes.residual, spin=modes.residual.spin * ratio)
    )
