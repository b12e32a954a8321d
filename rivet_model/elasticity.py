"""Linear elasticity of a body of revolution, one Fourier harmonic of the angle at a time.

    u_r = U(r, z) cos n theta,   u_theta = T(r, z) sin n theta,   u_z = W(r, z) cos n theta

    e_rr = U,r   e_tt = (U + n T)/r   e_zz = W,z   g_rz = U,z + W,r   g_rt = T,r - (T + n U)/r   g_tz = T,z - n W/r

The last two go with sin n theta.  Strain is B_0 + n B_1, so three matrices serve all harmonics.  Energies and loads
leave out the common factor pi (2 pi for n = 0) of the integral over theta.  (Zienkiewicz and Taylor, The Finite Element
Method, semi-analytical processes.)
"""

from types import SimpleNamespace

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu
from skfem import Basis, BilinearForm, ElementQuad1, ElementQuad2, ElementVector, FacetBasis, Functional, LinearForm

COMPONENTS = ("rr", "tt", "zz", "rz", "rt", "tz")


def stiffness(E, nu):
    """Hooke's law [6, 6] of an isotropic body, order COMPONENTS, shear strains as angles."""
    lam, mu = E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu))
    C = np.diag([2 * mu] * 3 + [mu] * 3)
    C[:3, :3] += lam
    return C


def strain_0(u, w):
    """Strain of B_0 [6, ...]."""
    g, r = u.grad, w.x[0]
    return np.stack([g[0, 0], u[0] / r, g[2, 1], g[0, 1] + g[2, 0], g[1, 0] - u[1] / r, g[1, 1]])


def strain_1(u, w):
    """Strain of B_1 [6, ...]."""
    r, zero = w.x[0], 0.0 * u[0]
    return np.stack([zero, u[1] / r, zero, zero, -u[0] / r, -u[2] / r])


class Body:
    """One body of revolution: mesh, material, and clamped points.

    mesh: skfem MeshQuad in (r, z) [m].  E [Pa], nu.  clamped: function of the points x [2, n] that is True where all
    displacements vanish; without it the body is free, and loads are balanced by body forces proportional to the rigid
    motions (self-equilibrated loads are not affected, and the displacement is orthogonal to the rigid motions).
    plane_strain: no displacement along z anywhere.
    """

    def __init__(self, mesh, E, nu, clamped=None, plane_strain=False):
        self.mesh, self.C, self.free = mesh, stiffness(E, nu), clamped is None
        self.element = ElementVector(ElementQuad2(), 3)
        self.basis = Basis(mesh, self.element, intorder=4)
        C = self.C

        def energy(first, second):
            form = BilinearForm(
                lambda u, v, w: np.einsum(
                    "i...,i...,...->...", second(v, w), np.tensordot(C, first(u, w), axes=1), w.x[0]
                )
            )
            return form.assemble(self.basis)

        mixed = energy(strain_0, strain_1)
        self.K = [energy(strain_0, strain_0), mixed + mixed.T, energy(strain_1, strain_1)]
        self.mass = BilinearForm(lambda u, v, w: (u[0] * v[0] + u[1] * v[1] + u[2] * v[2]) * w.x[0]).assemble(
            self.basis
        )
        x = self.basis.doflocs
        self.component = self._component_of_dofs()
        self.clamped_dofs = np.flatnonzero(clamped(x)) if clamped else np.zeros(0, dtype=int)
        self.axis_dofs = np.flatnonzero(np.abs(x[0]) < 1e-12)
        self.flat_dofs = np.flatnonzero(self.component == 2) if plane_strain else np.zeros(0, dtype=int)

    def _component_of_dofs(self):
        component = np.zeros(self.basis.N, dtype=int)
        b = self.basis
        for dofs in (b.nodal_dofs, b.facet_dofs, b.interior_dofs):
            for i, row in enumerate(dofs):
                component[row] = i % 3
        return component

    def _fixed(self, n):
        on_axis, part = self.axis_dofs, self.component[self.axis_dofs]
        if n == 0:
            fixed = [np.flatnonzero(self.component == 1), on_axis[part == 0]]
        else:
            fixed = [on_axis[part == 2]] if n == 1 else [on_axis]
        return np.unique(np.concatenate([self.clamped_dofs, self.flat_dofs, *fixed]))

    def rigid_motions(self, n):
        """Rigid motions of harmonic n [dofs, count]: z (n = 0); x and rotation about y (n = 1)."""
        if not self.free or n > 1:
            return np.zeros((self.basis.N, 0))
        z, c = self.basis.doflocs[1], self.component
        r = self.basis.doflocs[0]
        if n == 0:
            return np.where(c == 2, 1.0, 0.0)[:, None]
        shift = np.choose(c, [1.0, -1.0, 0.0])
        return np.stack([shift, np.choose(c, [z, -z, -r])], axis=1)

    def solve(self, n, loads):
        """Displacements [dofs, cases] of harmonic n under the loads [dofs, cases]."""
        K = (self.K[0] + n * self.K[1] + n**2 * self.K[2]).tocsc()
        keep = np.setdiff1d(np.arange(self.basis.N), self._fixed(n))
        R = self.rigid_motions(n)
        u = np.zeros((self.basis.N, loads.shape[1]))
        if R.shape[1] == 0:
            u[keep] = splu(K[keep][:, keep]).solve(np.ascontiguousarray(loads[keep]))
            return u
        MR = self.mass @ R
        gram = np.linalg.inv(R.T @ MR)
        balanced = loads - MR @ (gram @ (R.T @ loads))
        keep = np.setdiff1d(keep, self._pins(n))
        u[keep] = splu(K[keep][:, keep]).solve(np.ascontiguousarray(balanced[keep]))
        return u - R @ (gram @ (MR.T @ u))

    def _pins(self, n):
        """Dofs that hold a free body under balanced loads without reaction: z of one point (n = 0), x of the surface at
        two heights (n = 1).
        """
        x = self.basis.doflocs
        candidates = np.flatnonzero((self.component == (2 if n == 0 else 0)) & (x[0] > 0.5 * x[0].max()))
        order = candidates[np.argsort(x[1][candidates])]
        return order[:1] if n == 0 else order[[0, -1]]

    def ring_loads(self, nodes, positions, normal, axis):
        """Normal pressure loads of hats over rings [dofs, rings]: G_j = int hat_j (u . normal) r ds.

        nodes: mesh vertices of the contact edge, in order; positions: coordinates (`axis`) of the rings along the edge,
        among the nodes. A pressure p_j acts as -G_j p_j; G_j^T u is the mean normal displacement times the ring's area
        (without the factor of theta).
        """
        return self.traction_loads(nodes, positions, (normal[0], 0.0, normal[1]), axis)

    def traction_loads(self, nodes, positions, direction, axis):
        """The same for a traction along a constant direction (r, theta, z)."""
        facets = self._facets(nodes)
        vector = FacetBasis(self.mesh, self.element, facets=facets, intorder=5)
        scalar = FacetBasis(self.mesh, ElementQuad1(), facets=facets, intorder=5)
        form = BilinearForm(
            lambda p, v, w: p * (v[0] * direction[0] + v[1] * direction[1] + v[2] * direction[2]) * w.x[0]
        )
        G = form.assemble(scalar, vector).tocsc()[:, scalar.nodal_dofs[0, nodes]]
        hats = np.stack([np.interp(self.mesh.p[axis, nodes], positions, row) for row in np.eye(len(positions))], axis=1)
        return G @ hats

    def shear_load(self, nodes):
        """Load [dofs, 1] of harmonic 1 by a uniform traction of 1 Pa along x on the edge: t_r = cos theta, t_theta =
        -sin theta.
        """
        basis = FacetBasis(self.mesh, self.element, facets=self._facets(nodes), intorder=5)
        return LinearForm(lambda v, w: (v[0] - v[1]) * w.x[0]).assemble(basis)[:, None]

    def _facets(self, nodes):
        on = np.zeros(self.mesh.nvertices, dtype=bool)
        on[nodes] = True
        facets = self.mesh.boundary_facets()
        return facets[np.all(on[self.mesh.facets[:, facets]], axis=0)]

    def ring_moments(self, nodes, positions, axis):
        """int hat_j r ds and int hat_j r s ds of each ring, s the coordinate along the edge: [2, rings]."""
        facets = self._facets(nodes)
        scalar = FacetBasis(self.mesh, ElementQuad1(), facets=facets, intorder=5)
        forms = [LinearForm(lambda v, w: v * w.x[0]), LinearForm(lambda v, w: v * w.x[0] * w.x[axis])]
        hats = np.stack([np.interp(self.mesh.p[axis, nodes], positions, row) for row in np.eye(len(positions))], axis=1)
        return np.stack([form.assemble(scalar)[scalar.nodal_dofs[0, nodes]] @ hats for form in forms])

    def stress_rows(self, facets):
        """Stress at two Gauss points on each facet, where it is superconvergent: matrices (S_0, S_1) and the points x
        [2, points].

        Amplitudes of harmonic n: (S_0 + n S_1) u [6 points, cases], component by component in the order COMPONENTS.
        """
        return self._rows(FacetBasis(self.mesh, self.element, facets=facets, intorder=2))

    def centre_stress(self):
        """Stress at the middle of each element: matrices (S_0, S_1)."""
        return self._rows(Basis(self.mesh, self.element, quadrature=(np.array([[0.5], [0.5]]), np.array([1.0]))))[:2]

    def _rows(self, basis):
        place = SimpleNamespace(x=np.asarray(basis.global_coordinates()))
        count = place.x[0].size
        rows = np.arange(6 * count).reshape(6, *place.x[0].shape)
        matrices = []
        for strain in (strain_0, strain_1):
            matrix = sp.csr_matrix((6 * count, basis.N))
            for i in range(basis.Nbfun):
                values = np.einsum("ij,jef->ief", self.C, strain(basis.basis[i][0], place))
                columns = np.broadcast_to(basis.element_dofs[i][None, :, None], values.shape)
                matrix += sp.csr_matrix((values.ravel(), (rows.ravel(), columns.ravel())), shape=matrix.shape)
            matrices.append(matrix)
        return (*matrices, place.x.reshape(2, -1))

    def volume(self):
        """Volume of the body [m3]: a check of mesh and weights."""
        return 2 * np.pi * Functional(lambda w: w.x[0]).assemble(self.basis)
