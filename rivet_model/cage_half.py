"""Load path of a cage half: loads of the rivets by a pocket force beyond those of a rigid half, by solid finite elements.

The mesh is one pitch of the half, from pocket to pocket around its rivet; cyclic symmetry with waves m = 0...Z - 1 gives the whole half.

         x ^   ____________________
           |  |                    |      s: arc length on the circle d_m, 0 at the rivet; pockets (cylinders with radial
           |  \\   strip            /      axis) at both ends; solid from cage_inner_diameter to cage_outer_diameter
           |   `.                .'
           |     |  bar, pad    |         pad: |s| < patch_radius at x = 0, where the halves are clamped
           +-----+---=======----+---> s

The joint is closed and does not slip, and the other half mirrors this one, so a force is half a symmetric pair (the pad cannot move along x:
tension N, prying M) and half an antisymmetric one (the pad cannot move in the plane: V).  Inertia balances the free motions, as in the
dynamics.  The bolt group of fmu_src/load_path.h gives the share of rigid halves, without prying; the matrix holds the difference.

A force on the ball's side acts where the ball touches: F_t > 0 on the wall at growing angle, near the split; F_x and F_r at the pocket's bottom.
A force F_t < 0 acts on the opposite wall: its matrix is the mirror image.
"""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu
from skfem import Basis, BilinearForm, ElementHex2, ElementVector, FacetBasis, LinearForm, MeshHex

from bearing_model.load_path import load_path_rigid

INERTIA = 1e-6  # times the softest elastic rate: inertia balances free motions and is negligible otherwise


@dataclass(frozen=True)
class HalfMesh:
    """Cells along a quarter of the pocket's arc over 2, through the strip, and radially."""

    arc: int = 4
    strip: int = 3
    radial: int = 2


def sector_mesh(g, size=None, sectors=1):
    """Mesh of one pitch (or several) in cylinder coordinates (x, r, theta) turned to (x, y, z); rivet k at theta = 2 pi (k + 1/2)/Z."""
    size = size or HalfMesh()
    R, w, pitch = g.d_m / 2, g.cage_half_width, np.pi * g.d_m / g.Z
    pocket = 0.5 * (g.ball_diameter + g.pocket_clearance)
    pad, end = min(g.patch_radius, 0.7 * (0.5 * pitch - pocket)), 0.5 * pitch

    def block(corner_curves):
        """Transfinite block from bottom(u), top(u): points [nu, nv, 2] on straight lines from bottom to top."""
        bottom, top, count = corner_curves
        v = np.linspace(0.0, 1.0, count + 1)[None, :, None]
        return bottom[:, None] * (1.0 - v) + top[:, None] * v

    def arc(start, stop):
        phi = np.deg2rad(np.linspace(start, stop, size.arc + 1))
        return np.stack([end - pocket * np.cos(phi), pocket * np.sin(phi)], axis=1)

    def line(start, stop, count):
        return np.linspace(start, stop, count + 1)

    side = line((pad, 0.0), (pad, w), size.arc)
    beside = block((side, arc(0.0, 45.0), size.strip))
    above = block((line((pad, w), (end, w), size.arc), arc(45.0, 90.0), size.strip))
    core = block((line((-pad, 0.0), (-pad, w), size.arc), side, 4))
    blocks = [core]
    for patch in (beside, above):
        blocks += [patch, patch * np.array([-1.0, 1.0])]
    points, quads, count = [], [], 0
    for patch in blocks:
        n, m = patch.shape[:2]
        index = np.arange(count, count + n * m).reshape(n, m)
        points.append(patch.reshape(-1, 2))
        quads.append(np.stack([index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]]).reshape(4, -1))
        count += n * m
    flat, quads = np.concatenate(points), np.concatenate(quads, axis=1)
    radii = np.linspace(g.cage_inner_diameter / 2, g.cage_outer_diameter / 2, size.radial + 1)
    nodes, cells = [], []
    for q in range(sectors):
        for radius in radii:
            nodes.append(np.stack([flat[:, 1], np.full(len(flat), radius), flat[:, 0] / R + 2 * np.pi * (q + 0.5) / g.Z]))
        base = q * len(radii) * len(flat)
        for i in range(size.radial):
            lower, upper = quads + base + i * len(flat), quads + base + (i + 1) * len(flat)
            cells.append(np.concatenate([lower, upper]))
    x, r, theta = np.concatenate(nodes, axis=1)
    p, t = np.stack([x, r * np.cos(theta), r * np.sin(theta)]), np.concatenate(cells, axis=1)
    _, first, inverse = np.unique(np.round(p * 1e9).astype(np.int64), axis=1, return_index=True, return_inverse=True)
    p, t = p[:, first], inverse.ravel()[t]
    return hexahedra(p, t)


def hexahedra(p, corners):
    """MeshHex from points [3, n] and corners [8, cells]: a quadrilateral in order, then the opposite one."""
    a, b, c, d, e, f, h, i = corners  # skfem: 0 a corner, 1-3 its neighbours, 4-6 across its faces, 7 opposite
    t = np.stack([a, e, d, b, i, f, c, h])
    volume = np.linalg.det(np.stack([p[:, t[k]] - p[:, t[0]] for k in (1, 2, 3)], axis=-1).transpose(1, 0, 2))
    flip = volume < 0.0
    t[:, flip] = t[:, flip][[0, 1, 3, 2, 5, 4, 6, 7]]
    return MeshHex(np.ascontiguousarray(p), np.ascontiguousarray(t))


class CageHalf:
    """Elastic half: stiffness and mass of one pitch, or of the whole half (`sectors` = Z) as a check."""

    def __init__(self, g, size=None, sectors=1):
        self.g, self.sectors = g, sectors
        mesh = sector_mesh(g, size, sectors)
        self.basis = Basis(mesh, ElementVector(ElementHex2()), intorder=4)
        lam, mu = g.E_flange * g.nu_flange / ((1 + g.nu_flange) * (1 - 2 * g.nu_flange)), g.E_flange / (2 * (1 + g.nu_flange))

        @BilinearForm
        def hooke(u, v, w):
            e, f = u.grad + np.swapaxes(u.grad, 0, 1), v.grad + np.swapaxes(v.grad, 0, 1)
            return lam * np.trace(u.grad) * np.trace(v.grad) + 0.5 * mu * np.einsum("ij...,ij...->...", e, f)

        self.K = hooke.assemble(self.basis).tocsr()
        self.M = BilinearForm(lambda u, v, w: np.einsum("i...,i...->...", u, v)).assemble(self.basis).tocsr()
        self.x = self.basis.doflocs
        self.component = np.zeros(self.basis.N, dtype=int)
        b = self.basis
        for dofs in (b.nodal_dofs, b.edge_dofs, b.facet_dofs, b.interior_dofs):
            for i, row in enumerate(dofs):
                self.component[row] = i % 3
        self.shift = INERTIA * self._softest()

    def _softest(self):
        """Rayleigh quotient [1/s2 per unit density] of the half bent twice around: a scale for the inertia's share."""
        theta = np.arctan2(self.x[2], self.x[1])
        u = np.where(self.component == 0, np.cos(2 * theta) * 1e-3, 0.0)
        return float(u @ self.K @ u / (u @ self.M @ u))

    def pad_dofs(self, sector):
        """Dofs in the split plane at the rivet of a sector."""
        theta = np.arctan2(self.x[2], self.x[1]) - 2 * np.pi * (sector + 0.5) / self.g.Z
        s = self.g.d_m / 2 * np.angle(np.exp(1j * theta))
        pad = min(self.g.patch_radius, 0.7 * (np.pi * self.g.d_m / self.g.Z / 2 - 0.5 * (self.g.ball_diameter + self.g.pocket_clearance)))
        return np.flatnonzero((self.x[0] < 1e-9) & (np.abs(s) < pad * 1.001))

    def pocket_loads(self):
        """Nodal loads [dofs, 3] of unit forces (x, r, t > 0) on pocket 0, and the points at which they act [3, 3], as columns."""
        g, loads, places = self.g, [], []
        half_pitch, pocket = np.pi / g.Z, 0.5 * (g.ball_diameter + g.pocket_clearance)
        mesh, R = self.basis.mesh, g.d_m / 2
        facets = mesh.boundary_facets()
        middle = mesh.p[:, mesh.facets[:, facets]].mean(axis=1)
        s = R * np.angle(np.exp(1j * np.arctan2(middle[2], middle[1])))  # from pocket 0
        if self.sectors == 1:
            s = np.where(s > R * half_pitch, s - 2 * np.pi * R / g.Z, s)  # the sector's far end is the other half of pocket 1
        distance = np.hypot(s, middle[0])
        on_wall = np.abs(distance - pocket) < 0.06 * pocket
        wall = on_wall & (s > 0.0) & (middle[0] < 0.4 * pocket)
        bottom = on_wall & (np.abs(s) < 0.4 * pocket)
        for chosen, direction in ((bottom, "x"), (bottom, "r"), (wall, "t")):
            basis = FacetBasis(mesh, self.basis.elem, facets=facets[chosen], intorder=4)
            x = np.asarray(basis.global_coordinates())
            # at the far end of the sector the same force points along that pocket's axes
            theta = np.where(np.arctan2(x[2], x[1]) > half_pitch, 2 * half_pitch, 0.0) if self.sectors == 1 else np.zeros_like(x[0])
            e = {
                "x": (np.ones_like(theta), 0 * theta, 0 * theta),
                "r": (0 * theta, np.cos(theta), np.sin(theta)),
                "t": (0 * theta, -np.sin(theta), np.cos(theta)),
            }[direction]
            area = basis.dx.sum()
            form = LinearForm(lambda v, w, e=e: sum(v[i] * e[i] for i in range(3)))
            loads.append(form.assemble(basis) / area)
            turned = np.stack([x[0], np.cos(theta) * x[1] + np.sin(theta) * x[2], -np.sin(theta) * x[1] + np.cos(theta) * x[2]])
            places.append((turned * basis.dx).sum(axis=(1, 2)) / area)
        return np.stack(loads, axis=1), np.stack(places, axis=1)

    def rigid_inertia(self):
        """Mass matrix [6, 6] per unit density of the whole half for motions (x, y, z, rotations about x, y, z) at the circle's centre."""
        w = self.M @ np.where(self.component == 0, 1.0, 0.0)  # consistent mass: weights of the nodes
        part = self.component == 0
        x, y, z, w = *self.x[:, part], w[part] * self.g.Z / self.sectors
        m, first = w.sum(), w @ x
        polar, axial = w @ (y**2 + z**2), w @ x**2
        I = np.diag([m, m, m, polar, axial + 0.5 * polar, axial + 0.5 * polar])
        I[1, 5] = I[5, 1] = first
        I[2, 4] = I[4, 2] = -first
        return I

    def _reactions(self, f, dofs, sector):
        """Loads (N, V_r, V_t, M_r, M_t) on the joint from the nodal forces f that the pad exerts on the half."""
        angle = 2 * np.pi * (sector + 0.5) / self.g.Z
        e_r, e_t = np.array([0, np.cos(angle), np.sin(angle)]), np.array([0, -np.sin(angle), np.cos(angle)])
        unit = np.eye(3)[self.component[dofs]]
        forces = -f[dofs, None] * unit
        lever = self.x[:, dofs].T - self.g.d_m / 2 * e_r
        total, moment = forces.sum(axis=0), np.cross(lever, forces).sum(axis=0)
        return np.array([total[0], total @ e_r, total @ e_t, moment @ e_r, moment @ e_t])

    def _wave_basis(self, m):
        """Dofs of one pitch from the free ones, when the next pitch moves with the phase exp(2 pi i m/Z): complex sparse matrix."""
        g = self.g
        alpha = 2 * np.pi / g.Z
        theta = np.arctan2(self.x[2], self.x[1])
        near, far = np.flatnonzero(np.abs(theta) < 1e-9), np.flatnonzero(np.abs(theta - alpha) < 1e-9)
        r = np.hypot(self.x[1], self.x[2])

        def key(dofs):
            return np.lexsort((self.component[dofs], np.round(r[dofs] * 1e9), np.round(self.x[0][dofs] * 1e9)))

        near, far = near[key(near)], far[key(far)]
        N = self.basis.N
        keep = np.setdiff1d(np.arange(N), far)
        column = np.full(N, -1)
        column[keep] = np.arange(len(keep))
        rows, columns, values = [keep], [column[keep]], [np.ones(len(keep), dtype=complex)]
        phase, c, s = np.exp(1j * m * alpha), np.cos(alpha), np.sin(alpha)
        groups = near.reshape(-1, 3), far.reshape(-1, 3)
        turn = np.array([[1, 0, 0], [0, c, -s], [0, s, c]])
        for i in range(3):
            for j in range(3):
                rows.append(groups[1][:, i])
                columns.append(column[groups[0][:, j]])
                values.append(np.full(len(groups[0]), turn[i, j] * phase))
        return sp.csr_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape=(N, len(keep)))

    def reactions(self):
        """Loads of the closed joints [rivet, 5, 3] per unit force on pocket 0 of this half: elastic, with the rigid share included."""
        loads, _ = self.pocket_loads()
        return self._cyclic(loads) if self.sectors == 1 else self._whole(loads)

    def _cyclic(self, loads):
        Z, result = self.g.Z, np.zeros((self.g.Z, 5, 3))
        pad = self.pad_dofs(0)
        A = self.K + self.shift * self.M
        # In the sector's load, facets at its far end belong to pocket 0 of the wave's neighbour: their phase is that of one pitch back.
        theta = np.arctan2(self.x[2], self.x[1])
        for m in range(Z):
            T = self._wave_basis(m)
            waves = loads * np.where(theta > np.pi / Z, np.exp(1j * m * 2 * np.pi / Z), 1.0)[:, None]
            for held, rows in (((0,), (0, 3, 4)), ((1, 2), (1, 2))):
                fixed = pad[np.isin(self.component[pad], held)]
                columns = np.unique(T[fixed].indices)
                free = np.setdiff1d(np.arange(T.shape[1]), columns)
                reduced = (T.conj().T @ A @ T).tocsc()
                u = np.zeros((T.shape[1], 3), dtype=complex)
                u[free] = splu(reduced[free][:, free]).solve(np.ascontiguousarray((T.conj().T @ waves)[free]))
                force = A @ (T @ u) - waves
                for f in range(3):
                    at_0 = self._reactions(force[:, f], fixed, 0)
                    for k in range(Z):
                        result[k, rows, f] += 0.5 * np.real(at_0[list(rows)] * np.exp(2j * np.pi * m * k / Z)) / Z
        return result

    def pad_stiffness(self):
        """Moment about the radial axis per rotation of one pad, all others held, the halves mirrored [N.m/rad]."""
        Z, total = self.g.Z, 0.0
        pad = self.pad_dofs(0)
        fixed = pad[self.component[pad] == 0]
        angle = np.pi / Z
        s = -np.sin(angle) * self.x[1][fixed] + np.cos(angle) * self.x[2][fixed]  # along t
        A = self.K + self.shift * self.M
        for m in range(Z):
            T = self._wave_basis(m)
            columns = np.array([T[row].indices[0] for row in fixed])
            free = np.setdiff1d(np.arange(T.shape[1]), columns)
            reduced = (T.conj().T @ A @ T).tocsc()
            u = np.zeros(T.shape[1], dtype=complex)
            u[columns] = -s  # a unit rotation about r: u_x = -s
            u[free] = -splu(reduced[free][:, free]).solve(reduced[free][:, columns] @ u[columns])
            total += np.real((reduced @ u)[columns] @ -s) / Z
        return float(total)

    def _whole(self, loads):
        Z, result = self.g.Z, np.zeros((self.g.Z, 5, 3))
        A = (self.K + self.shift * self.M).tocsc()
        pads = [self.pad_dofs(k) for k in range(Z)]
        for held, rows in (((0,), (0, 3, 4)), ((1, 2), (1, 2))):
            fixed = np.concatenate([pad[np.isin(self.component[pad], held)] for pad in pads])
            free = np.setdiff1d(np.arange(self.basis.N), fixed)
            u = np.zeros((self.basis.N, 3))
            u[free] = splu(A[free][:, free]).solve(np.ascontiguousarray(loads[free]))
            force = A @ u - loads
            for k, pad in enumerate(pads):
                chosen = pad[np.isin(self.component[pad], held)]
                for f in range(3):
                    result[k, rows, f] += 0.5 * self._reactions(force[:, f], chosen, k)[list(rows)]
        return result

    def rigid_share(self):
        """Loads of the joints [rivet, 5, 3] for a rigid half: the bolt group, with inertia balancing the free motions."""
        g = self.g
        _, places = self.pocket_loads()
        angle = 2 * np.pi * (np.arange(g.Z) + 0.5) / g.Z
        c, s, I = np.cos(angle), np.sin(angle), self.rigid_inertia()
        result = np.zeros((g.Z, 5, 3))
        for f, force in enumerate(np.eye(3)):  # at pocket 0: e_r = y, e_t = z
            load = np.concatenate([force, np.cross(places[:, f], force)])
            wrench = np.zeros(6)
            for held, free in (([0, 4, 5], [1, 2, 3]), ([1, 2, 3], [0, 4, 5])):
                wrench[held] = load[held] - I[np.ix_(held, free)] @ np.linalg.solve(I[np.ix_(free, free)], load[free])
            N, V_y, V_z = load_path_rigid(g.d_m, 0.5 * wrench, c, s)
            result[:, 0, f], result[:, 1, f], result[:, 2, f] = N, c * V_y + s * V_z, c * V_z - s * V_y
        return result


def load_path(g, size=None):
    """Matrix [Z, 5, 3] of fmu_src/load_path.h: elastic minus rigid, for F_t > 0, index = (rivet - pocket) mod Z; and the half's pad_stiffness."""
    half = CageHalf(g, size)
    return half.reactions() - half.rigid_share(), half.pad_stiffness()
