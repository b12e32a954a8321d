"""Response of a half to a film on its guiding land: radial motion of its rim there, by modes and by static loads.

The film's pressure on the outer rim is a radial line load at the land's middle x, P(theta) [N/rad], outward.  Both it
and the motion w(theta) of the rim there are kept as harmonics.  Those of wave n of a ring of Z pitches are
p = n + k Z; each goes straight over x, W_p + x W'_p, because the rim bends by far less than it tilts over a land:

    w(theta) = sum over p Re[(a - i b)(W_p + x W'_p) exp(i p theta)],       G_p = int P exp(i p theta) dtheta
    modal forces f_a = sum (W_p + x W'_p) Re G_p,  f_b = sum (W_p + x W'_p) Im G_p

W_p, W'_p are the least squares of the rim's radial displacement over its outer part, where a ring closes beside the
pockets. A load that gives this work is exact in its resultant, force and moments.
"""

import numpy as np

from bearing_model.cage.elastic.half_modes import EVEN, OUT, PAD
from bearing_model.cage.two_half.half_path import land_harmonics

OUTER = 0.5  # part of the half's width from which on the rim counts
ROWS_EVEN = np.array([1.0, 1.0, -1.0, -1.0, 1.0, 1.0, -1.0, 1.0]) > 0.0  # of half_path.ROWS in the rivet's plane


def _quadratic(u):
    """Shape functions of three nodes at -1, 0, 1, and their slopes, at places u [places, 3]."""
    values = np.stack([0.5 * u * (u - 1.0), 1.0 - u * u, 0.5 * u * (u + 1.0)], axis=1)
    return values, np.stack([u - 0.5, -2.0 * u, u + 0.5], axis=1)


# of a facet with nine nodes at Gauss points: shape functions [points, 9], their slopes, weights
_U, _W = np.polynomial.legendre.leggauss(5)
(_LINE, _LINE_SLOPE), _WEIGHTS = _quadratic(_U), np.outer(_W, _W).ravel()
_SHAPES, *_SLOPES = (
    np.einsum("pi,qj->pqij", a, b).reshape(len(_WEIGHTS), 9)
    for a, b in ((_LINE, _LINE), (_LINE_SLOPE, _LINE), (_LINE, _LINE_SLOPE))
)


def _rim_nodes(basis, radius):
    """Dofs [facets, 9, 3] of the facets on the rim, their nodes row by row."""
    mesh = basis.mesh
    facets = mesh.boundary_facets()
    corners = mesh.p[:, mesh.facets[:, facets]]
    facets = facets[np.all(np.abs(np.hypot(corners[1], corners[2]) - radius) < 1e-9, axis=0)]
    edge_of = {tuple(sorted(pair)): i for i, pair in enumerate(mesh.edges.T.tolist())}
    result = []
    for f in facets:
        a, b, c, d = mesh.facets[:, f].tolist()
        around = [edge_of[tuple(sorted(pair))] for pair in ((a, b), (b, c), (c, d), (d, a))]
        (ab, bc, cd, da), (a, b, c, d) = basis.edge_dofs[:, around].T, basis.nodal_dofs[:, [a, b, c, d]].T
        result.append([a, ab, b, da, basis.facet_dofs[:, f], bc, d, cd, c])
    return np.array(result)


class NoLand:
    """A half without a guiding land: no loads on its rim."""

    def __init__(self, solid):
        self.loads = np.zeros((solid.basis.N, 0))

    def of_wave(self, n):
        """No combinations of no loads."""
        return np.zeros((0, 3, 2), dtype=complex)


class LandLoads:
    """Loads on the rim of a pitch: cos and sin of all harmonics, by 1 and x, [dofs, 4 (highest + 1)] in this order, and
    the products of these functions over the rim.
    """

    def __init__(self, solid, g):
        basis, self.harmonics = solid.basis, land_harmonics(g.Z)
        self.highest = int(np.abs(self.harmonics).max())
        dofs, shape = _rim_nodes(basis, 0.5 * g.cage_outer_diameter), _SHAPES
        at = basis.doflocs[:, dofs[..., 0]]  # [3, facets, 9]
        x, y, z = np.einsum("cfn,qn->cfq", at, shape)
        tangents = (np.einsum("cfn,qn->cfq", at, slope) for slope in _SLOPES)
        area = np.linalg.norm(np.cross(*tangents, axis=0), axis=0) * _WEIGHTS * (x > OUTER * g.cage_half_width)
        theta = np.arctan2(z, y)
        self.x, self.theta, self.area = x.ravel(), theta.ravel(), area.ravel()
        self.loads = np.zeros((basis.N, 4 * (self.highest + 1)))
        places = [(p, part, power) for p in range(self.highest + 1) for part in range(2) for power in range(2)]
        for column, (p, part, power) in enumerate(places):
            size = area * x**power * (np.sin(p * theta) if part else np.cos(p * theta))
            for component, direction in ((1, np.cos(theta)), (2, np.sin(theta))):
                np.add.at(self.loads[:, column], dofs[..., component], (size * direction) @ shape)

    def of_wave(self, n):
        """The amplitudes W_p, W'_p of wave n as combinations of the loads [loads, 3, 2]: conj(combination) . displacement
        of pitch 0; 0 where there is no third harmonic.
        """
        harmonics = [p for i, p in enumerate(self.harmonics[n]) if p not in self.harmonics[n][:i]]
        functions = np.stack(
            [self.x**power * np.exp(1j * p * self.theta) for p in harmonics for power in range(2)], axis=1
        )
        gram = functions.conj().T @ (self.area[:, None] * functions)
        columns = np.zeros((self.loads.shape[1], 2 * len(harmonics)), dtype=complex)
        for i, p in enumerate(harmonics):
            for power in range(2):
                columns[4 * abs(p) + power, 2 * i + power] = 1.0
                columns[4 * abs(p) + 2 + power, 2 * i + power] = 1j * np.sign(p)
        result = np.zeros((self.loads.shape[1], 3, 2), dtype=complex)
        result[:, : len(harmonics)] = (columns @ np.linalg.inv(gram).conj().T).reshape(-1, len(harmonics), 2)
        return result


def unit_load(elastic, n):
    """Patterns [patterns, 3, 2] on pitch 0 of wave n by which G_p = 1 loads the rim, by 1 and x."""
    result = np.zeros((elastic.loads.shape[1], 3, 2), dtype=complex)
    result[elastic.patterns.land] = elastic.land.of_wave(n)
    return result * (1.0 if 2 * n in (0, elastic.Z) else 2.0) / elastic.Z


def bonded_land(elastic, alone):
    """Rows [waves, 3, 2, 8] of bonded joints by G_p = 1 on one half, without the rigid share's parting (see half_loads:
    half a mirrored pair and half an opposed one).  At rivet k a row is r cos(n theta_k) of an even, -r sin(n theta_k)
    of an odd kind.
    """
    (_, reactions, held), opposed = elastic.mirrored, elastic.opposed[1]
    result = np.zeros((elastic.Z // 2 + 1, 3, 2, 8))
    for n in range(len(result)):
        turn = np.exp(-1j * np.pi * n / elastic.Z)
        columns = 0.5 * unit_load(elastic, n)
        for i in range(3):
            for power in range(2):
                column = columns[:, i, power]
                M = ((reactions[n] @ column) @ alone.lever)[None]
                rivet = alone.rivet_rows((held[n] @ column)[alone.head][None], M)[0]
                row = turn * np.concatenate([M[0, :1], opposed[n] @ column, M[0, 1:], rivet])
                result[n, i, power] = np.where(ROWS_EVEN, row.real, row.imag)
    return result


def land_rows(elastic, alone, rigid_rows):
    """The land's rows of the load path [waves, 3, 2, 8]: bonded ones less the rigid share of N, V_r, V_t.

    rigid_rows: half_loads.rigid_rows.  Only p = 1 has a resultant, a radial force at the land: along y at theta = 0.
    """
    result = bonded_land(elastic, alone)
    angle = 2.0 * np.pi * (np.arange(elastic.Z) + 0.5) / elastic.Z
    waves = np.stack([np.cos(angle), np.cos(angle), -np.sin(angle)], axis=1)  # of N, V_r, V_t
    at = [np.sum(rigid_rows(elastic, np.array([x, 0.0, 0.0]))[1] * waves, axis=0) * 2.0 / elastic.Z for x in (0.0, 1.0)]
    result[1, 0, 0, :3] -= at[0]
    result[1, 0, 1, :3] -= at[1] - at[0]
    return result


def growth(elastic, column):
    """Mean radial displacement [2] of the rim at the land, by 1 and x, under the patterns `column` on every pitch, joints
    bonded: of a half without a land 0.

    A closed ring of radius R that turns at omega widens by rho R^3 omega^2/E.
    """
    moved = elastic.mirrored[2][0][elastic.patterns.land] @ column
    return (elastic.land.of_wave(0)[:, 0].conj().T @ moved).real if moved.size else np.zeros(2)


def land_residual(modes, alone, elastic):
    """Motions (x, about r, about t) of the pads [waves, 3, 2, 3] by G_p = 1 on one half that elastic joints see beside those
    of the modes, so that bonded joints of modes, which see no other joint's residual, carry the loads of the elements.
    """
    Z, K = elastic.Z, modes.law.stiffness
    loads = bonded_land(elastic, alone)[..., [0, 3, 4]]
    even, pad = EVEN[OUT] > 0.0, modes.pad[:, [PAD.index(name) for name in ("x", "phi_r", "phi_t")]]
    result = loads @ np.linalg.inv(K).T
    for n in range(len(loads)):
        single = 2 * n in (0, Z)
        for i in np.flatnonzero(modes.harmonic == n):
            seen = np.ones(3, dtype=bool) if not single else even == ((modes.parity[i] == 1) == (n == 0))
            shape = np.where(seen, pad[i], 0.0)
            force = 0.5 * modes.land[i] - (Z if single else 0.5 * Z) * loads[n] @ shape
            result[n] -= (force / modes.omega[i] ** 2)[..., None] * shape
    # rigid motions of the halves bring the joints' loads into balance
    R = 0.5 * elastic.g.d_m
    for n, motion in ((0, [1.0, 0.0, 0.0]), (1, [-R, -1.0, 1.0])):
        motion = np.array(motion)
        result[n] -= ((result[n] @ K @ motion) / (motion @ K @ motion))[..., None] * motion
    return result


def land_shapes(elastic, wave):
    """Amplitudes W_p, W'_p [modes, 3, 2] of a Wave."""
    measured = elastic.loads[:, elastic.patterns.land].T @ wave.shape
    return np.einsum("lkd,li->ikd", elastic.land.of_wave(wave.n).conj(), measured).real
