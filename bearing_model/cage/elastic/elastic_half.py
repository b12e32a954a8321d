"""The vibration modes of a cage half in a scene, and the joints' law over the stiffness that they leave.
Equations in half_modes.py and cage_elastic.py.
"""

from dataclasses import dataclass

import numpy as np

from bearing_model.cage.common.centrifugal import cage_centrifugal
from bearing_model.cage.common.joint_law import LawOfModes, joint_law
from bearing_model.cage.elastic.half_modes import (
    OUT,
    PAD,
    coordinates,
    denser,
    frequencies,
    phases,
    rim_shapes,
    rivet_shapes,
    spin_load,
)
from bearing_model.generated.variables import CageShape, Z

IN = [1, 2]  # of the motions (x, r, t, phi_x, phi_r, phi_t) of a pad: in the plane; OUT: out of it
ROOT = np.sqrt(2.0)
LONGEST, LONGEST_RIBBON = 5.0, 3.5  # substeps in the longest step
WEAK_FILM = 0.05  # part of a wall's velocity that a film takes in the longest step, below which it need not follow
SUBSTEP_TURN = 1.55  # angle by which the fastest vibration of closed joints turns in a substep (cage_substeps.py)
WALL_NODE = 1  # of the walls' angle: impacts meet the wall at 7 degrees in the median


@dataclass
class ElasticHalf:
    """A half's modes in a scene; n of them, without dimension, of modal mass m."""

    n: int
    omega: np.ndarray  # [n] rad/s
    damping: np.ndarray  # 2 zeta omega [n]
    uniform: np.ndarray  # whether a mode moves all joints alike and does not twist them [n]
    pad: np.ndarray  # motions of the pads [n, 6, Z]
    wave: np.ndarray  # Re and Im of the wave at the pockets [n, 2, Z]
    chi: np.ndarray  # nodes of the wall's angle
    pocket: (
        np.ndarray
    )  # (x, r, t) by Re and Im of the wave at the nodes [chi, n, 3, 2], of a ribbon's table [radii, chi ...]
    slope: np.ndarray  # its slopes
    radii: np.ndarray  # nodes of the wall's radius, none of a machined half [m]
    centrifugal: np.ndarray  # modal force per (rad/s)^2 [n]
    rim: np.ndarray  # of the rim's shapes at the land (land_bent.py) [n, 4]
    mobility: np.ndarray  # velocity of a shape by an impulse on it [4] [1/kg]
    R: np.ndarray  # compliance that the modes leave between the pads of a joint, out of the plane [3, 3]
    series: float  # part of the friction states' stiffness that is left in series with it
    k_hole: np.ndarray  # stiffness of the holes in series with R [Z] [N/m]
    pairs: int  # modes of one frequency in twos, whose a come first and whose b first among the b
    b: int  # where the b begin
    # largest |u|/|q| of a wall, of a pair's a over the amplitude of both: by modes that move all pockets alike, else 0; by the others [n]
    widest: np.ndarray
    widest_others: np.ndarray
    wall_mobility: float  # of a wall by modes and half, at the widest place, at most [m/s/(N.s)]
    weak_film: float  # damping of a pocket's film that need not follow in the substeps [N.s/m]
    compliance: float  # that the modes leave at a wall, along its normal, less that in Hertz's [m/N]
    # squares of the frequencies of S and the relative rigid motions out of the plane with closed joints, rising [n + 3]
    mirrored: np.ndarray
    substep: float  # of the default method, at most [s]
    longest_step: float  # likewise: forces that are constant over it feed vibrations that turn by much more than pi
    law: LawOfModes


def mode_order(modes):
    """Place of each coordinate of the state among those of half_modes.py [n]: all a, those of pairs first, then all b
    likewise; its entry; 0 of a, 1 of b.
    """
    entry, part = (
        np.repeat(np.arange(len(modes.omega)), modes.count),
        coordinates(modes, 0.0 * modes.omega, 0.0 * modes.omega + 1.0),
    )
    order = np.lexsort((entry, modes.parity[entry] != 0, part))
    return order, entry[order], part[order]


def damping_ratios(p, omega):
    """Damping ratios [n] of modes: modal_damping at the lowest one, modal_damping_high at the highest one, linear in ln omega
    between them; modal_damping of all where the other one is 0.
    """
    zeta, high = p.cage.modal_damping, p.cage.modal_damping_high
    if high == 0.0 or np.max(omega) <= np.min(omega):
        return np.full(len(omega), zeta)
    return zeta + (high - zeta) * np.log(omega / np.min(omega)) / np.log(np.max(omega) / np.min(omega))


def elastic_half_derive(p, d, table):
    """ElasticHalf of the scene."""
    if table.modes is None:
        raise ValueError("scene.cage = elastic: the rivet table has no vibration modes")
    ratio = p.cage.m / table.half.m
    modes, law = denser(table.modes, ratio), table.modes.law
    unit = np.sqrt(p.cage.m)  # the table's modes have unit modal mass
    order, entry, part = mode_order(modes)
    c, s = (f[entry] for f in phases(modes, 0.0))
    wave = np.where(part[:, None, None] == 0.0, np.stack([c, -s], axis=1), np.stack([s, c], axis=1))
    omega, residual = frequencies(modes)[order], modes.residual
    shear = 2.0 * np.mean(np.diag(residual.pad[0])[IN])  # of both halves
    pocket = unit * np.moveaxis(modes.pocket[entry], 0, -3)
    ribbon = p.cage.shape == CageShape.RIBBON
    pad = unit * np.moveaxis(rivet_shapes(modes)[order][:, :, : len(PAD)], 1, 2)
    series, k_hole = 1.0 / (1.0 + shear * d.k_plate_t), d.k_hole / (1.0 + shear * d.k_hole)
    held = series * d.k_plate_t + np.max(k_hole)
    uniform = (modes.harmonic[entry] == 0) & (part == 0.0)
    # [nodes, n]
    u_2 = np.sum(pocket[..., slice(None) if ribbon else [0, 2], :] ** 2, axis=(-2, -1)).reshape(-1, len(entry))
    farther, most, paired = 1.25, np.sqrt(np.max(u_2, axis=0)), modes.parity[entry] == 0  # between the nodes
    one_of_pair = ~(paired & (part > 0.0))
    wall = residual.wall[..., WALL_NODE]
    mirrored = frequencies_2(
        p.cage.m,
        omega,
        joints_out(d, pad),
        0.5 * np.kron(np.eye(Z), law.stiffness),
        (0.5 * p.cage.m, 0.5 * d.J_t, 0.5 * d.J_t),
    )
    opposed = frequencies_2(
        p.cage.m, omega, joints_in(d, pad), np.eye(2 * Z) * held, (0.5 * p.cage.m, 0.5 * p.cage.m, 0.5 * d.J_p)
    )
    rim = unit * rim_shapes(modes, p.cage.land_x)[order]
    substep = SUBSTEP_TURN / np.sqrt(max(mirrored[-1], opposed[-1]))
    longest_step = (LONGEST_RIBBON if ribbon else LONGEST) * substep
    wall_mobility = (1.0 + np.sum(most[one_of_pair] ** 2)) / p.cage.m + (
        0.5 * p.bearing.d_m
    ) ** 2 / d.J_t  # at most [m/s/(N.s)]
    return ElasticHalf(
        n=len(omega),
        rim=rim,
        mobility=np.sum(rim**2, axis=0) / p.cage.m,
        omega=omega,
        uniform=uniform,
        damping=2.0 * damping_ratios(p, omega) * omega,
        pad=pad,
        wave=wave,
        chi=table.half.chi,
        pocket=pocket,
        slope=unit * np.moveaxis(modes.slope[entry], 0, -3),
        radii=modes.radii,
        centrifugal=cage_centrifugal(p, table) * np.sqrt(table.half.m) * spin_load(table.modes)[order],
        pairs=int(np.sum(paired & (part == 0.0))),
        b=int(np.sum(part == 0.0)),
        widest=np.where(uniform, farther * most, 0.0),
        widest_others=np.where(one_of_pair & ~uniform, farther * most, 0.0),
        R=np.linalg.inv(law.stiffness),
        series=series,
        k_hole=k_hole,
        compliance=max(float(np.ravel(wall)[len(np.ravel(wall)) // 2]), 0.0) if ribbon else wall,
        mirrored=mirrored,
        substep=substep,
        longest_step=longest_step,
        wall_mobility=wall_mobility,
        weak_film=WEAK_FILM / (longest_step * wall_mobility),
        law=law,
    )


def frequencies_2(m, omega, motions, stiffness, rigid):
    """Squares of the frequencies with closed joints, rising.

    motions [joints' motions, n + 3] by unit coordinates; rigid: inertia of the three rigid motions.
    """
    K = motions.T @ stiffness @ motions + np.diag(np.append(m * omega**2, np.zeros(3)))
    root = np.sqrt(np.append(np.full(len(omega), m), rigid))
    return np.linalg.eigvalsh(K / np.outer(root, root))


def circle(d):
    """Pitch radius of the rivets, cosine and sine of their angles."""
    return 1.0 / d.inv_R, d.rivet_y * d.inv_R, d.rivet_z * d.inv_R


def joints_out(d, pad):
    """Relative motions (x, about r, about t) of all joints [3 Z, n + 3] by S, v_x and rotations about y and z."""
    R, c, s = circle(d)
    rigid = np.array([[1.0 + 0.0 * c, 0.0 * c, 0.0 * c], [R * s, c, -s], [-R * c, s, c]])
    return np.concatenate([ROOT * pad[:, OUT], rigid]).transpose(2, 1, 0).reshape(3 * Z, -1)


def joints_in(d, pad):
    """Relative motions (r, t) of all joints [2 Z, n + 3] by D, v_y, v_z and the spin."""
    R, c, s = circle(d)
    rigid = np.array([[c, -s], [s, c], [0.0 * c, R + 0.0 * c]])
    return np.concatenate([ROOT * pad[:, IN], rigid]).transpose(2, 1, 0).reshape(2 * Z, -1)


def elastic_half_rest(half, m, omega_2, P):
    """Coordinates S [n] and (u_x, M_t) of the rest under the centrifugal load of the speed's square omega_2 [rad2/s2]
    and the preload P.

    All joints are alike: N = 0, and their M_t balances S_i = sqrt 2 (spin_i omega^2 - Z phi_t,i M_t)/(m omega_i^2).
    Newton's method with differences for the halves' distance u_x and M_t.
    """
    at = half.pad[:, OUT, 0]  # x, phi_r, phi_t

    def off(x):
        S = ROOT * (half.centrifugal * omega_2 - np.where(half.uniform, Z * at[:, 2] * x[1], 0.0)) / (m * half.omega**2)
        e = 0.5 * x[0] * np.array([1.0, 0.0, 0.0]) + S @ at / ROOT * [1.0, 0.0, 1.0]
        N, _, M_t = joint_law(half.law, e @ half.law.stiffness.T, P)[0]
        return np.array([N, (M_t - x[1]) / half.law.length]), S

    x = np.zeros(2)
    for _ in range(60):
        rest, S = off(x)
        if np.max(np.abs(rest)) < 1e-11:
            break
        slope = np.stack([(off(x + step)[0] - rest) / step.sum() for step in np.diag([1e-10, 1e-7])], axis=-1)
        x = x - np.linalg.solve(slope, rest)
    return S, x
