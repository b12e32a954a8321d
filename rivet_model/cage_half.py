"""Elastic cage half: one pitch by solid finite elements, condensed to its loads, repeated Z times (cyclic symmetry,
waves m = 0...Z-1).

A load pattern is a set of nodal loads on one pitch; the response of the half is measured by the patterns themselves
(work), so the compliance between patterns is symmetric.  In the frames of the pitches a load on pitch 0 is the sum of
all waves exp(2 pi i m k/Z)/Z, and each wave meets itself at the cuts through the webs: u(far) = turn(2 pi/Z) exp(2 pi i
m/Z) u(near).  Inside, the pitch is eliminated once:

    compliance of wave m    H_m = A_FF + A_FB T_m (T_m^H S T_m)^-1 T_m^H A_FB^T,      S = K_BB - K_BI K_II^-1 K_IB,  T_m: near -> near, far

Rigid motions of the half (waves 0, 1, Z-1) are balanced by inertia, as in the dynamics: loads are freed of their
resultants by body forces proportional to the rigid motions, and displacements are measured without them.
"""

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu
from scipy.spatial import cKDTree
from skfem import BilinearForm, ElementHex1, ElementHex2, ElementVector, FacetBasis, LinearForm

from . import half, half_shape
from .half import HalfMesh
from .half_lands import LandLoads, NoLand

SYMMETRIC = {"permc_spec": "MMD_AT_PLUS_A", "diag_pivot_thresh": 0.0, "options": {"SymmetricMode": True}}  # for splu
# the first patterns: body forces that rigid motions x, y, z and rotations about x, y, z would need, per unit density
BODY = 6
# wave -> rigid motion (see _rigid) that joints prevent if the halves' loads mirror or oppose each other
MIRRORED, OPPOSED = {0: [0], 1: [1]}, {0: [1], 1: [0]}
SPIN = 6  # the next one: centrifugal body force per (rad/s)^2 and unit density


class CyclicSolid:
    """An elastic solid of Z equal pitches, condensed to the load patterns of one of them (which lies between theta = 0
    and 2 pi/Z).
    """

    def __init__(self, mesh, Z, E, nu):
        self.Z = Z
        self.basis = half.solid_basis(mesh, ElementVector(ElementHex2()))
        self.K, self.M = _matrices(self.basis, E, nu)
        self.x = self.basis.doflocs
        self.component = np.zeros(self.basis.N, dtype=int)
        b = self.basis
        for dofs in (b.nodal_dofs, b.edge_dofs, b.facet_dofs, b.interior_dofs):
            for i, row in enumerate(dofs):
                self.component[row] = i % 3
        self.motions = self.rigid_motions()
        self.near, self.far = self._cuts()

    def _cuts(self):
        """Dofs at theta = 0 and those at 2 pi/Z that continue them."""
        theta, r = np.arctan2(self.x[2], self.x[1]), np.hypot(self.x[1], self.x[2])
        near, far = (np.flatnonzero(np.abs(theta - cut) < 1e-9) for cut in (0.0, 2 * np.pi / self.Z))
        return tuple(
            dofs[np.lexsort((self.component[dofs], np.round(r[dofs] * 1e9), np.round(self.x[0][dofs] * 1e9)))]
            for dofs in (near, far)
        )

    def rigid_motions(self):
        """Displacements [dofs, 6] by unit rigid motions about the centre of the circle in the split plane."""
        x = self.x
        zero = np.zeros_like(x[0])
        fields = [
            (1 + zero, zero, zero),
            (zero, 1 + zero, zero),
            (zero, zero, 1 + zero),
            (zero, -x[2], x[1]),
            (x[2], zero, -x[0]),
            (-x[1], x[0], zero),
        ]
        return np.stack([np.choose(self.component, field) for field in fields], axis=1)

    def body_loads(self):
        """The patterns of body forces at unit density [dofs, 7]: BODY rigid motions, then SPIN."""
        outward = np.choose(self.component, [0.0 * self.x[0], self.x[1], self.x[2]])
        return self.M @ np.column_stack([self.motions, outward])

    # Condensation -----------------------------------------------------------------------------------------------------

    def condense(self, loads, back=None):
        """Take the patterns [dofs, patterns], the first of them from body_loads; back: which of them stand one pitch
        back (on its far end).
        """
        self.loads = loads
        self.back = np.zeros(loads.shape[1], dtype=bool) if back is None else back
        near, far = self.near, self.far
        edge = np.concatenate([near, far])
        inside = np.setdiff1d(np.arange(self.basis.N), edge)
        F_I, F_B = self.loads[inside], self.loads[edge]
        K_IB = self.K[inside][:, edge].toarray()
        right = np.column_stack([F_I, K_IB])
        X, filled = np.zeros_like(right), np.any(right, axis=0)
        X[:, filled] = splu(self.K[inside][:, inside], **SYMMETRIC).solve(right[:, filled])
        X_F, X_B = X[:, : F_I.shape[1]], X[:, F_I.shape[1] :]
        self.A_FF, self.A_FB = F_I.T @ X_F, F_B.T - F_I.T @ X_B
        S = self.K[edge][:, edge].toarray() - K_IB.T @ X_B
        self.A_FF, self.S = 0.5 * (self.A_FF + self.A_FF.T), 0.5 * (S + S.T)
        self.resultants = self.loads.T @ self.motions  # [patterns, 6]: work of the patterns on rigid motions

    def _phase(self, m):
        """Factor by which patterns count in wave m [patterns]."""
        return np.where(self.back, np.exp(2j * np.pi * m / self.Z), 1.0)

    def _rigid(self, m):
        """Rigid motions of wave m as combinations of the six [6, 2]: displacement u = motions @ column, turned on from
        pitch to pitch.
        """
        e = np.eye(6, dtype=complex)
        if m == 0:
            return e[:, [0, 3]]
        if m == 1:
            return np.stack([e[:, 1] + 1j * e[:, 2], e[:, 4] + 1j * e[:, 5]], axis=1)
        return np.zeros((6, 0))

    def wave(self, m):
        """Compliance [patterns, patterns] of wave m, 0...Z/2; that of Z - m is its conjugate.  Rigid motions are
        balanced by inertia.
        """
        n = len(self.near)
        alpha = 2 * np.pi / self.Z
        c, s = np.cos(alpha), np.sin(alpha)
        turn = np.kron(np.eye(n // 3), np.array([[1, 0, 0], [0, c, -s], [0, s, c]]))
        T = np.vstack([np.eye(n), np.exp(1j * m * alpha) * turn])
        phase = self._phase(m)
        # work of patterns on boundary motions: conj(load) . u
        S, L = T.conj().T @ self.S @ T, (phase.conj()[:, None] * self.A_FB) @ T
        rigid = self._rigid(m)
        boundary = self.motions[self.near] @ rigid
        Q, _ = np.linalg.qr(boundary)
        S = S + np.abs(S).max() * (Q @ Q.conj().T)  # holds the rigid motions, which the balanced loads do not excite
        H = phase.conj()[:, None] * self.A_FF * phase + L @ np.linalg.solve(S, L.conj().T)
        if rigid.shape[1]:
            balance = self.balance(m)
            H = balance.conj().T @ H @ balance
        return 0.5 * (H + H.conj().T)

    def balance(self, m):
        """Matrix [patterns, patterns] that adds the body forces of inertia to the patterns: balanced = loads @ balance."""
        rigid, phase = self._rigid(m), self._phase(m)
        E = np.zeros((self.loads.shape[1], rigid.shape[1]), dtype=complex)
        E[:BODY] = rigid
        work = rigid.conj().T @ self.resultants.T  # of patterns on the rigid motions, pitch 0
        gram = work @ E
        return np.eye(self.loads.shape[1]) - E @ np.linalg.solve(gram, work * phase)

    @cached_property
    def waves(self):
        """Compliances of the waves 0...Z/2: [waves, patterns, patterns]."""
        return np.stack([self.wave(m) for m in range(self.Z // 2 + 1)])

    def circulant(self, waves):
        """Real blocks [Z, ...] of relative pitch k from the waves 0...Z/2 [waves, ...]."""
        return np.fft.irfft(waves, self.Z, axis=0)

    def prevented(self, m, motions):
        """Rigid motions of wave m that held patterns prevent, freed of those that stay free (orthogonal to them over
        the mass): [6, count].

        The work of a load on them already counts the part of the load that inertia balances along the free ones.
        """
        rigid, chosen = self._rigid(m), motions.get(m, [])
        held, free = rigid[:, chosen], np.delete(rigid, chosen, axis=1)
        if not chosen:
            return held
        mass = self.resultants[:BODY]
        return held - free @ np.linalg.solve(free.conj().T @ mass @ free, free.conj().T @ mass @ held)

    def held(self, rows, motions):
        """The half with some patterns held everywhere: those of `rows` do not move.

        motions: wave -> which of its two rigid motions they prevent; inertia balances the other, which does not move
        them. Returns by waves: stiffness of the held patterns [waves, rows, rows]; their reactions to all patterns
        [waves, rows, patterns], as loads of the half on its supports; compliance of all patterns [waves,
        patterns, patterns].
        """
        K, R, G = [], [], []
        for m, C in enumerate(self.waves):
            rigid = self.prevented(m, motions)
            D = (self.resultants @ rigid) * self._phase(m).conj()[:, None] * np.abs(C[rows, rows]).max()
            n = rows.stop - rows.start
            A = np.block([[C[rows, rows], D[rows]], [D[rows].conj().T, np.zeros(2 * (rigid.shape[1],))]])
            load = np.vstack([C[rows], D.conj().T])
            solution = np.linalg.solve(A, np.column_stack([np.eye(len(A))[:, :n], load]))
            K.append(solution[:n, :n])
            R.append(solution[:n, n:])
            G.append(C - load.conj().T @ solution[:, n:])
        return np.stack(K), np.stack(R), np.stack(G)


@dataclass(frozen=True)
class Patterns:
    """Where the groups of patterns stand among the columns."""

    body: slice  # rigid motions, then centrifugal: see body_loads
    pad: slice  # hats on the pad, along x
    plane: slice  # forces along r and t that friction gives to the pad, below the cone under the rivet's head
    twist: slice  # moment about x that friction gives to the pad there
    # at the seat's bottom, under the rivet's head: force along x, moments about r and t; then forces along r and t
    head: slice
    land: slice  # radial loads on the outer rim: half_lands.LandLoads
    # unit forces (x, r, t) at points of pocket 0's wall: near parts, then parts on the far end of the pitch before
    pocket: slice


class CageHalf(CyclicSolid):
    """Condensed half of a geometry.

    points: places of unit forces on the pocket's wall [n, 2]: angle from the split toward growing x [rad, 0...pi: pi/2
    the bottom] and radius [m].
    """

    def __init__(self, g, size=None, points=()):
        self.g, self.size = g, size or HalfMesh()
        super().__init__(half.pitch_mesh(g, self.size), g.Z, g.E_flange, g.nu_flange)
        self.points, self.wall = np.reshape(points, (-1, 2)), half.wall(g, self.size)
        self.land = NoLand(self) if g.shape == "ribbon" else LandLoads(self, g)
        groups = {
            "body": self.body_loads(),
            **self._pad_loads(),
            "head": self._head_loads(),
            "land": self.land.loads,
            "pocket": self._pocket_loads(),
        }
        ends = np.cumsum([0] + [loads.shape[1] for loads in groups.values()])
        self.patterns = Patterns(*(slice(a, b) for a, b in pairwise(ends.tolist())))
        back = np.zeros(ends[-1], dtype=bool)
        back[self.patterns.pocket.start + 3 * len(self.points) :] = True
        self.condense(np.column_stack(list(groups.values())), back)

    def _axes(self):
        """Unit vectors (x, r, t) at the rivet."""
        c, s = np.cos(np.pi / self.g.Z), np.sin(np.pi / self.g.Z)
        return np.array([[1.0, 0.0, 0.0], [0.0, c, s], [0.0, -s, c]])

    def rivet_place(self, x):
        """(radial, tangential) distance from the rivet's axis of points x [3, ...]."""
        _, e_r, e_t = self._axes()
        return np.tensordot(e_r, x, 1) - self.g.d_m / 2, np.tensordot(e_t, x, 1)

    def _facets(self, level, within):
        """Facets in the plane x = level whose corners are all within; not their middles, which lie nearer to the rivet
        than the ring that they belong to.
        """
        mesh = self.basis.mesh
        facets = mesh.boundary_facets()
        corners = mesh.p[:, mesh.facets[:, facets]]
        flat = np.all(np.abs(corners[0] - level) < 1e-9, axis=0)
        return facets[flat & np.all(within(*self.rivet_place(corners)), axis=0)]

    def _facet_basis(self, facets, element):
        return FacetBasis(self.basis.mesh, element, mapping=self.basis.mapping, facets=facets, intorder=4)

    def _pad_loads(self):
        """Unit forces spread by hats over the pad's vertices, without those at the edge of the hole: loads; places and
        areas of the hats stay here.
        """
        # of a ribbon all that lies in the split's plane
        pad = np.inf if self.g.shape == "ribbon" else half_shape.pad_half_length(self.g)
        facets = self._facets(0.0, lambda r, t: np.abs(t) < pad + 1e-9)
        vector, scalar = self._facet_basis(facets, self.basis.elem), self._facet_basis(facets, ElementHex1())
        vertices = np.unique(self.basis.mesh.facets[:, facets])
        r, t = self.rivet_place(self.basis.mesh.doflocs[:, vertices])
        kept = np.hypot(r, t) > self.g.shank_diameter / 2 + 1e-6  # the edge break has no contact
        vertices, dofs = vertices[kept], scalar.nodal_dofs[0, vertices[kept]]
        self.pad_area = LinearForm(lambda v, w: v).assemble(scalar)[dofs]
        # the hat's own middle: forces and moments of the patterns are exact with it
        moments = [
            LinearForm(lambda v, w, i=i: v * self.rivet_place(np.asarray(w.x))[i]).assemble(scalar)[dofs]
            for i in range(2)
        ]
        self.pad_place = np.array(moments) / self.pad_area
        e_x, e_r, e_t = self._axes()

        def hats(e):
            form = BilinearForm(lambda p, v, w: p * sum(e[i] * v[i] for i in range(3)))
            return form.assemble(scalar, vector).tocsc()[:, dofs].toarray() / self.pad_area

        # friction acts where the head presses: pressure falls from the head's edge to nothing one flange thickness
        # farther out
        cone = (
            np.clip(
                (0.5 * self.g.head_diameter + self.g.flange_thickness - np.hypot(*self.pad_place))
                / self.g.flange_thickness,
                0.0,
                1.0,
            )
            * self.pad_area
        )
        r, t = self.pad_place
        along_r, along_t = hats(e_r), hats(e_t)
        twist = along_t @ (cone * r) - along_r @ (cone * t)
        return {
            "pad": hats(e_x),
            "plane": np.stack([along_r @ cone, along_t @ cone], axis=1) / cone.sum(),
            "twist": twist[:, None] / (cone @ (r**2 + t**2)),
        }

    def _head_loads(self):
        """Uniform and linear pressures under the head: unit force along x, unit moments about r and t; unit forces
        along r and t.
        """
        g = self.g
        inner, outer = g.shank_diameter / 2 + g.relief_radius, g.head_diameter / 2
        facets = self._facets(
            g.flange_thickness, lambda r, t: (np.hypot(r, t) > inner - 1e-9) & (np.hypot(r, t) < outer + 1e-9)
        )
        basis, (e_x, e_r, e_t) = self._facet_basis(facets, self.basis.elem), self._axes()

        def load(e, weight=lambda r, t: 1.0 + 0.0 * r):
            form = LinearForm(
                lambda v, w: weight(*self.rivet_place(np.asarray(w.x))) * sum(e[i] * v[i] for i in range(3))
            )
            return form.assemble(basis)

        r, t = self.rivet_place(np.asarray(basis.global_coordinates()))
        area, square = basis.dx.sum(), 0.5 * ((r**2 + t**2) * basis.dx).sum()
        # a rotation phi moves the head by u_x = phi_r t - phi_t r
        return np.stack(
            [
                load(e_x) / area,
                load(e_x, lambda r, t: t) / square,
                -load(e_x, lambda r, t: r) / square,
                load(e_r) / area,
                load(e_t) / area,
            ],
            axis=1,
        )

    def _pocket_loads(self):
        """Unit forces along (x, r, t) of pocket 0 at the points: those on this pitch, then those on the far end of the
        pitch before it.
        """
        near, far = np.zeros((2, self.basis.N, len(self.points), 3))
        at = {end: self._wall_nodes(end) for end in (0, 1)}
        for i, (angle, radius) in enumerate(self.points):
            end = int(angle > np.pi / 2)
            weights = self.wall.weights(np.pi - angle if end else angle, radius)
            turn = 2 * np.pi / self.g.Z * end
            axes = np.array([[1.0, 0.0, 0.0], [0.0, np.cos(turn), np.sin(turn)], [0.0, -np.sin(turn), np.cos(turn)]])
            (far if end else near)[at[end], i] = (weights[..., None, None] * axes.T).reshape(weights.shape + (3, 3))
        return np.concatenate([near, far], axis=1).reshape(self.basis.N, -1)

    def _wall_nodes(self, end):
        """Dofs [angles, radii, 3] of the wall of pocket 0 (end 0) or of pocket 1 (end 1)."""
        place = self.wall.nodes
        if end:
            turn = 2 * np.pi / self.g.Z
            c, s = np.cos(turn), np.sin(turn)
            x, r, t = np.moveaxis(place, -1, 0)
            place = np.stack([x, c * r + s * t, s * r - c * t], axis=-1)
        first = np.flatnonzero(self.component == 0)
        distance, nearest = cKDTree(self.x[:, first].T).query(place.reshape(-1, 3))
        assert distance.max() < 1e-8, "the wall's nodes are not where the mesh has them"
        return first[nearest].reshape(place.shape[:2])[..., None] + np.arange(3)

    def point_places(self):
        """Where the points lie [n, 3] in the frame (x, r, t) of pocket 0."""
        return self.wall.place(*self.points.T)

    @cached_property
    def mirrored(self):
        """`held` by the pads along x: of loads that push both halves alike.  Pads balance forces along x and tilting
        moments.
        """
        return self.held(self.patterns.pad, MIRRORED)

    @cached_property
    def opposed(self):
        """`held` by friction in the split plane: of loads that push the halves against each other.  It balances
        transverse forces and the torque.
        """
        return self.held(self.patterns.plane, OPPOSED)


def _matrices(basis, E, nu):
    """Stiffness, and mass at unit density, of an elastic solid with quadratic hexahedra; the same as by skfem's forms,
    by matrix products.
    """
    lam, mu = E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu))
    scalar = basis.with_element(ElementHex2())
    value = np.stack([np.broadcast_to(field[0], basis.dx.shape) for field in scalar.basis])  # [27, cells, points]
    grad = np.stack([field[0].grad for field in scalar.basis])  # [27, 3, cells, points]
    n, cells = len(value), basis.dx.shape[0]
    flat = grad.transpose(2, 0, 1, 3).reshape(cells, 3 * n, -1)
    G = ((flat * basis.dx[:, None]) @ flat.transpose(0, 2, 1)).reshape(cells, n, 3, n, 3)
    unit = np.eye(3)
    K = lam * G + mu * G.transpose(0, 1, 4, 3, 2) + mu * np.einsum("cakbk->cab", G)[:, :, None, :, None] * unit[:, None]
    flat = value.transpose(1, 0, 2)
    M = ((flat * basis.dx[:, None]) @ flat.transpose(0, 2, 1))[:, :, None, :, None] * unit[:, None]
    dofs = basis.element_dofs.T  # [cells, 81]: node by node, component inside
    rows, columns = np.repeat(dofs, 3 * n, axis=1).ravel(), np.tile(dofs, 3 * n).ravel()
    return tuple(sp.csc_matrix((A.ravel(), (rows, columns)), shape=(basis.N, basis.N)) for A in (K, M))
