"""The whole joint as three solids of hexahedra in contact against the Fourier elements: nothing shared but the meridian
mesh and the contact solver.
"""

import numpy as np
import pytest
from scipy.sparse.linalg import splu
from skfem import Basis, BilinearForm, ElementHex1, ElementHex2, ElementVector, FacetBasis, LinearForm, MeshHex2

from rivet_model import half, load_cases, section_mesh
from rivet_model.elasticity import stiffness
from rivet_model.geometry import Geometry
from rivet_model.lcp import Contact
from rivet_model.section_mesh import Fineness

G = Geometry()
FINE, SECTORS = Fineness(0.5), 12  # 12 sectors of 15 degrees over half the circle
R, T = G.shank_diameter / 2, G.flange_thickness
SYMMETRIC = {"permc_spec": "MMD_AT_PLUS_A", "diag_pivot_thresh": 0.0, "options": {"SymmetricMode": True}}  # for splu
HOLE = 0.03 * R  # radius of a hole along the rivet's axis, where hexahedra cannot meet: 0.1 % of the section


def turned(flat, mirror=1.0):
    """Half of the body of revolution of a meridian mesh: quadratic hexahedra on true circles."""
    r, z = np.maximum(flat.p[0], HOLE), mirror * flat.p[1]
    theta = np.linspace(0.0, np.pi, SECTORS + 1)
    points = np.concatenate([np.stack([r * np.cos(t), r * np.sin(t), z]) for t in theta], axis=1)
    cells = np.concatenate(
        [np.concatenate([flat.t + k * r.size, flat.t + (k + 1) * r.size]) for k in range(SECTORS)], axis=1
    )
    mesh = MeshHex2.from_mesh(half.hexahedra(points, cells))
    step = np.pi / SECTORS
    between = np.abs(np.arctan2(mesh.doflocs[1], mesh.doflocs[0]) / step % 1.0 - 0.5) < 0.25
    mesh.doflocs[:2, between] /= np.cos(step / 2)
    return mesh


class Solid:
    """One body: stiffness, contact surfaces, rigid motions x, z and rotation about y (the plane y = 0 is one of
    symmetry).
    """

    def __init__(self, mesh, E, nu, held):
        self.mesh, self.C = mesh, stiffness(E, nu)
        self.mapping = half.Mapping(mesh, mesh.elem(), mesh.bndelem)
        self.basis = Basis(mesh, ElementVector(ElementHex2()), mapping=self.mapping, intorder=4)
        lam, mu = E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu))

        @BilinearForm
        def hooke(u, v, w):
            e, f = (g + np.swapaxes(g, 0, 1) for g in (u.grad, v.grad))
            return lam * np.trace(u.grad) * np.trace(v.grad) + 0.5 * mu * np.einsum("ij...,ij...->...", e, f)

        part = np.zeros(self.basis.N, dtype=int)
        for dofs in (self.basis.nodal_dofs, self.basis.edge_dofs, self.basis.facet_dofs, self.basis.interior_dofs):
            for i, row in enumerate(dofs):
                part[row] = i % 3
        x = self.basis.doflocs
        fixed = (np.abs(x[1]) < 1e-9) & (part == 1)
        if held:
            fixed |= np.hypot(x[0], x[1]) > G.patch_radius - 1e-8
        self.motions = np.stack(
            [np.where(part == 0, 1.0, 0.0), np.where(part == 2, 1.0, 0.0), np.choose(part, [x[2], 0.0, -x[0]])], axis=1
        )
        self.free = not held
        keep = np.flatnonzero(~fixed)
        if self.free:  # three pins: loads are balanced, so they carry nothing
            on_plane = np.flatnonzero((np.abs(x[1]) < 1e-9) & (x[0] > 0.9 * R) & (x[0] < 1.1 * R))
            low, high = (
                on_plane[part[on_plane] == 0][np.argsort(x[2][on_plane[part[on_plane] == 0]])][[0, -1]]
            ).tolist()
            keep = np.setdiff1d(keep, [low, high, on_plane[part[on_plane] == 2][0]])
        self.keep, self.factor = keep, splu(hooke.assemble(self.basis)[keep][:, keep].tocsc(), **SYMMETRIC)
        self.weight = LinearForm(lambda v, w: v[0]).assemble(self.basis) + LinearForm(lambda v, w: v[2]).assemble(
            self.basis
        )

    def solve(self, loads):
        """Displacements; of a free body under loads balanced by body forces, and without rigid motion."""
        u = np.zeros_like(loads)
        if not self.free:
            u[self.keep] = self.factor.solve(loads[self.keep])
            return u
        lumped = np.abs(self.weight)[:, None] * self.motions
        gram = np.linalg.inv(self.motions.T @ lumped)
        balanced = loads - lumped @ (gram @ (self.motions.T @ loads))
        u[self.keep] = self.factor.solve(balanced[self.keep])
        return u - self.motions @ (gram @ (lumped.T @ u))

    def normal_loads(self, on):
        """Loads of hats at the vertices of a surface, and the vertices' places: columns sorted by place."""
        facets = self.mesh.facets_satisfying(on, boundaries_only=True)
        vector = FacetBasis(self.mesh, self.basis.elem, mapping=self.mapping, facets=facets, intorder=4)
        scalar = FacetBasis(self.mesh, ElementHex1(), mapping=self.mapping, facets=facets, intorder=4)
        form = BilinearForm(lambda p, v, w: p * (v[0] * w.n[0] + v[1] * w.n[1] + v[2] * w.n[2]))
        vertices = np.unique(self.mesh.facets[:, facets])
        places = self.mesh.doflocs[:, vertices]
        order = np.lexsort(np.round(places / 1e-8).astype(np.int64))
        loads = form.assemble(scalar, vector).tocsc()[:, scalar.nodal_dofs[0, vertices[order]]]
        area = LinearForm(lambda v, w: v).assemble(scalar)[scalar.nodal_dofs[0, vertices[order]]]
        return loads.toarray(), places[:, order], area

    def largest_principal(self, on, u):
        """Of the stress at Gauss points of a surface [Pa]."""
        basis = FacetBasis(
            self.mesh,
            self.basis.elem,
            mapping=self.mapping,
            facets=self.mesh.facets_satisfying(on, boundaries_only=True),
            intorder=2,
        )
        grad = basis.interpolate(u).grad
        lam, mu = self.C[0, 1], self.C[3, 3]
        stress = mu * (grad + np.swapaxes(grad, 0, 1)) + lam * np.trace(grad) * np.eye(3)[:, :, None, None]
        return np.linalg.eigvalsh(np.moveaxis(stress.reshape(3, 3, -1), 2, 0))[:, 2].max()


def surface(kind, side):
    """Test for the centres of a contact's facets; those on the plane of symmetry are none."""

    def on(x):
        r, z = np.where(x[1] > 1e-9, np.hypot(x[0], x[1]), 0.0), side * x[2]
        if kind == "head":
            return (np.abs(z - T) < 1e-8) & (r > R + G.relief_radius) & (r < G.head_diameter / 2)
        if kind == "bore":
            return (np.abs(r - R) < 0.02 * R) & (z > G.edge_break) & (z < T - G.relief_depth)
        return (np.abs(z) < 1e-8) & (r > R + G.edge_break)

    return on


def on_fillet(x):
    """The same for the fillets; the middle of a facet's corners lies on the chord, not on the circle."""
    r, z = np.where(x[1] > 1e-9, np.hypot(x[0], x[1]) / np.cos(0.5 * np.pi / SECTORS), 0.0), np.abs(x[2])
    return (r > R) & (r < R + G.fillet_radius) & (z > T - G.fillet_radius) & (z < T)


class Joint3D:
    """Rivet and two flanges condensed to their contacts; half of the joint, so half of each force."""

    def __init__(self):
        self.rivet = Solid(turned(section_mesh.rivet_mesh(G, FINE)), G.E_rivet, G.nu_rivet, held=False)
        flat = section_mesh.flange_mesh(G, FINE)
        upper, lower = (Solid(turned(flat, side), G.E_flange, G.nu_flange, held=True) for side in (1.0, -1.0))
        columns = {self.rivet: [], upper: [], lower: []}
        kinds, areas = [], []
        pairs = [
            (self.rivet, body, kind, side) for kind in ("head", "bore") for body, side in ((upper, 1), (lower, -1))
        ]
        for one, other, kind, side in (*pairs, (upper, lower, "plate", 1)):
            (a, place, area), (b, opposite, _) = (
                one.normal_loads(surface(kind, side)),
                other.normal_loads(surface(kind, side)),
            )
            np.testing.assert_allclose(place, opposite, atol=2e-9)
            for body, loads in columns.items():
                loads.append(a if body is one else b if body is other else np.zeros((body.basis.N, len(area))))
            kinds += [kind] * len(area)
            areas.append(area)
        self.loads = {body: np.hstack(loads) for body, loads in columns.items()}
        self.kind, area = np.array(kinds), np.concatenate(areas)
        self.area = area
        self.response = self.rivet.solve(self.loads[self.rivet])
        C = self.loads[self.rivet].T @ self.response + sum(
            self.loads[b].T @ b.solve(self.loads[b]) for b in (upper, lower)
        )
        self.D = np.hstack([self.loads[body].T @ body.motions for body in (self.rivet, upper)]) / area[:, None]
        self.C = 0.5 * (C + C.T) / np.outer(area, area)

    def head_stress(self, P, N, V, fit):
        """Largest principal stress of the fillets [Pa]."""
        springs = np.tile(load_cases.SPRINGS[[0, 2, 4]], 2)
        heads, bores = 1.0 * (self.kind == "head"), 1.0 * (self.kind == "bore")
        preload = Contact(self.C, np.column_stack([self.D, 0.5 * heads]), np.append(springs, springs[1]))
        short = preload.solve(-0.5 * fit * bores, np.array([0, 0, 0, 0, 0, 0, 0.5 * P])).q[-1]
        loaded = Contact(self.C, self.D, springs)
        forces = loaded.solve(-0.5 * fit * bores - 0.5 * short * heads, 0.5 * np.array([0.0, 0.0, 0.0, V, N, 0.0])).p
        return self.rivet.largest_principal(on_fillet, -self.response @ (forces / self.area))


@pytest.mark.slow
def test_joint_of_three_solids():
    """Head stress of preload, transverse load in clearance, and all loads in interference: within 3 % of Fourier
    elements with hats as wide.

    The solids' stress is quadratic over sectors of 15 degrees, the Fourier elements' is smooth.
    """
    solid = Joint3D()
    fourier = load_cases.Joint(G, load_cases.Grid(FINE, 15.0, 2 * SECTORS, 16))
    for load in ((60.0, 0.0, 0.0, -90e-6), (20.0, 0.0, 20.0, -20e-6), (20.0, 10.0, 10.0, 5e-6)):
        P, N, V, fit = load
        expected = fourier.channels(fourier.solve(P, N, V, 0.0, 0.0, fit)[0][:, None])[0][0]
        found = solid.head_stress(*load)
        print(
            f"P {P:g} N {N:g} V {V:g} N, fit {1e6 * fit:g} um: solids {found / 1e6:.1f}, Fourier {expected / 1e6:.1f} MPa"
        )
        assert found == pytest.approx(expected, rel=0.03)
