"""Interference with plasticity: the effective fit is the elastic fit whose bore pressure is that of the yielded flange.

One half of the shank and its flange, axisymmetric, joined without friction along the bore; the shank swells by fit/d in
its section (eigenstrain). J2 flow with linear isotropic hardening, radial return with consistent tangent (Simo and
Hughes, Computational Inelasticity, section 3.3), fully converged in steps of at most 1 um, because larger steps have
converged to wrong states without an error.

    fit_eff(fit) = fit p_plastic(fit)/p_elastic(fit)       p: mean pressure in the bore

Cycles in operation are taken as elastic about the residual state (shakedown is assumed).
"""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import spsolve
from skfem import Basis, ElementQuad2, ElementVector

from . import section_mesh
from .elasticity import stiffness
from .section_mesh import Fineness

STEP = 1e-6  # m, of the 6207's joint; this and the next lengths go with Geometry.size
LARGEST = 46e-6  # m
TOLERANCE = 1e-9  # residual force / reaction
ITERATIONS = 30
LAYER = 0.05e-3  # m


@dataclass(frozen=True)
class FitMap:
    """fit_a and fit_eff [m], yield of flange and rivet as an elastic fit [m], mean pressure [Pa], largest plastic
    strain of the flange.

    Yield means that the mean von Mises stress of the layer of 0.05 mm along the bore reaches the yield stress: at the
    edges of the bore first yield comes at a fit that falls with the size of the elements, so it cannot serve.
    """

    fit_a: np.ndarray
    fit_eff: np.ndarray
    flange_yield: float
    rivet_yield: float
    pressure: np.ndarray
    plastic_strain: np.ndarray


class _Solid:
    """One axisymmetric body with J2 plasticity; strain order rr, tt, zz, rz."""

    def __init__(self, mesh, E, nu, yield_stress, hardening, swells):
        self.basis = Basis(mesh, ElementVector(ElementQuad2(), 2), intorder=4)
        b = self.basis
        x = np.asarray(b.global_coordinates())
        self.weight = b.dx * x[0]
        rows = []
        for i in range(b.Nbfun):
            u = b.basis[i][0]
            rows.append(np.stack([u.grad[0, 0], u[0] / x[0], u.grad[1, 1], u.grad[0, 1] + u.grad[1, 0]]))
        self.B = np.stack(rows)  # [functions, 4, elements, points]
        self.C = stiffness(E, nu)[:4, :4]
        self.mu, self.yield_stress, self.H = E / (2 * (1 + nu)), yield_stress, hardening
        self.swell = np.array([1.0, 1.0, 0.0, 0.0])[:, None, None] * swells
        self.plastic = np.zeros(self.B.shape[1:])
        self.hardened = np.zeros(self.B.shape[2:])

    def respond(self, u, swelling):
        """Internal forces, tangent stiffness, new plastic state, and von Mises stress of the elastic trial."""
        strain = np.einsum("bcef,be->cef", self.B, u[self.basis.element_dofs]) - swelling * self.swell - self.plastic
        trial = np.einsum("ij,jef->ief", self.C, strain)
        mean = trial[:3].mean(axis=0)
        deviator = trial - np.array([1.0, 1.0, 1.0, 0.0])[:, None, None] * mean
        norm = np.sqrt((deviator[:3] ** 2).sum(axis=0) + 2 * deviator[3] ** 2)
        mises = np.sqrt(1.5) * norm
        excess = mises - (self.yield_stress + self.H * self.hardened)
        flow = np.maximum(excess, 0.0) / (3 * self.mu + self.H)
        normal = deviator / np.maximum(norm, 1e-30)
        shrink = 3 * self.mu * flow / np.maximum(mises, 1e-30)
        stress = trial - shrink * deviator
        # consistent tangent: C - 2 mu shrink I_dev - 2 mu (3 mu/(3 mu + H) - shrink) n n where it flows
        dev = np.diag([1.0, 1.0, 1.0, 0.5])
        dev[:3, :3] -= 1.0 / 3.0
        flows = flow > 0.0
        second = np.where(flows, 2 * self.mu * (3 * self.mu / (3 * self.mu + self.H) - shrink), 0.0)
        tangent = (
            self.C[:, :, None, None]
            - 2 * self.mu * shrink * dev[:, :, None, None]
            - second * normal[:, None] * normal[None]
        )
        force_e = np.einsum("bcef,cef,ef->be", self.B, stress, self.weight)
        K_e = np.einsum("acef,cdef,bdef,ef->abe", self.B, tangent, self.B, self.weight, optimize=True)
        dofs = self.basis.element_dofs
        force = np.bincount(dofs.ravel(), force_e.ravel(), minlength=self.basis.N)
        rows, columns = np.broadcast_to(dofs[:, None], K_e.shape), np.broadcast_to(dofs[None], K_e.shape)
        K = sp.csr_matrix((K_e.ravel(), (rows.ravel(), columns.ravel())), shape=(self.basis.N,) * 2)
        engineering = np.array([1.0, 1.0, 1.0, 2.0])[:, None, None]
        state = self.plastic + np.sqrt(1.5) * flow * normal * engineering, self.hardened + flow
        return force, K, state, mises

    def keep(self, state):
        self.plastic, self.hardened = state


class _Joint:
    """Shank and flange tied in the radial direction along the bore."""

    def __init__(self, g, elastic, fine):
        huge = 1e30 if elastic else 1.0
        self.R = g.shank_diameter / 2
        bore = section_mesh.bore_levels(g, fine)
        below, above = np.linspace(0.0, bore[0], fine(3) + 1), np.linspace(bore[-1], g.flange_thickness, fine(4) + 1)
        levels = np.concatenate([below[:-1], bore, above[1:]])
        shank_mesh = section_mesh.MeshQuad.init_tensor(
            self.R - section_mesh.graded(0.0, self.R, fine(8), 4.0)[::-1], levels
        )
        self.shank = _Solid(shank_mesh, g.E_rivet, g.nu_rivet, huge * g.yield_rivet, g.hardening_rivet, 1.0)
        self.flange = _Solid(
            section_mesh.flange_mesh(g, fine), g.E_flange, g.nu_flange, huge * g.yield_flange, g.hardening_flange, 0.0
        )
        self.bodies = (self.shank, self.flange)
        self.bore_height = bore[-1] - bore[0]
        self.layers = []
        for body in self.bodies:
            x = np.asarray(body.basis.global_coordinates())
            self.layers.append(
                body.weight * ((np.abs(x[0] - self.R) < LAYER * g.size) & (x[1] > bore[0]) & (x[1] < bore[-1]))
            )
        self._tie(g, (g.edge_break - 1e-9, bore[-1] + 1e-9))

    def _tie(self, g, between):
        """Free dofs: all but the axis, the split plane (shank), the rim (flange); the flange's bore follows the shank's
        in r.
        """
        on_bore = []
        for body in self.bodies:
            facets = body.basis.mesh.facets_satisfying(
                lambda x: (np.abs(x[0] - self.R) < 1e-9) & (x[1] > between[0]) & (x[1] < between[1]), True
            )
            dofs = np.unique(body.basis.get_dofs(facets).all("u^1"))
            on_bore.append(dofs[np.argsort(body.basis.doflocs[1, dofs])])
        N = [body.basis.N for body in self.bodies]
        x, y = self.shank.basis.doflocs, self.flange.basis.doflocs
        radial = [self._radial(body) for body in self.bodies]
        fixed = np.concatenate([
            np.flatnonzero(radial[0] & (x[0] < 1e-12)),
            np.flatnonzero(~radial[0] & (x[1] < 1e-12)),
            N[0] + np.flatnonzero(y[0] > g.patch_radius - 1e-9),
        ])  # fmt: skip
        column = np.full(sum(N), -1)
        slave = N[0] + on_bore[1]
        free = np.setdiff1d(np.arange(sum(N)), np.concatenate([fixed, slave]))
        column[free] = np.arange(len(free))
        column[slave] = column[on_bore[0]]
        used = np.flatnonzero(column >= 0)
        self.T = sp.csr_matrix((np.ones(len(used)), (used, column[used])), shape=(sum(N), len(free)))
        self.slave, self.split = slave, N[0]

    @staticmethod
    def _radial(body):
        radial = np.zeros(body.basis.N, dtype=bool)
        for dofs in (body.basis.nodal_dofs, body.basis.facet_dofs, body.basis.interior_dofs):
            radial[dofs[::2].ravel()] = True
        return radial

    def step(self, u, swelling):
        """Converged displacements, mean bore pressure [Pa], largest and mean von Mises stress along the bore, before
        flow, of both bodies.
        """
        u = u.copy()
        for _ in range(ITERATIONS):
            parts = [
                body.respond(part, swelling)
                for body, part in zip(self.bodies, (u[: self.split], u[self.split :]), strict=True)
            ]
            force = np.concatenate([part[0] for part in parts])
            residual, reaction = self.T.T @ force, np.abs(force[self.slave]).sum()
            if np.abs(residual).max() <= TOLERANCE * max(reaction, 1e-12):
                for body, part in zip(self.bodies, parts, strict=True):
                    body.keep(part[2])
                pressure = force[self.slave].sum() / (self.R * self.bore_height)
                mean = [(part[3] * layer).sum() / layer.sum() for part, layer in zip(parts, self.layers, strict=True)]
                return u, pressure, [part[3].max() for part in parts], mean
            K = self.T.T @ sp.block_diag([part[1] for part in parts]) @ self.T
            u -= self.T @ spsolve(K.tocsc(), residual)
        raise ArithmeticError(
            f"interference did not converge at fit/d = {swelling:g}: residual {np.abs(residual).max():g} of {reaction:g}"
        )


def plastic_fit(geometry, largest=LARGEST, fine=None, progress=None):
    """FitMap of the geometry up to `largest` [m] times its size.  Raises ArithmeticError if a step does not converge."""
    fine = fine or Fineness()
    progress = progress or (lambda done, total: None)
    d, step = geometry.shank_diameter, STEP * geometry.size
    elastic = _Joint(geometry, True, fine)
    _, p_unit, largest_stress, mean_stress = elastic.step(np.zeros(elastic.T.shape[0]), step / d)
    limits = geometry.yield_rivet, geometry.yield_flange
    rivet_yield, flange_yield = (step * limit / stress for limit, stress in zip(limits, mean_stress, strict=True))
    first = min(step * limit / stress for limit, stress in zip(limits, largest_stress, strict=True))
    joint = _Joint(geometry, False, fine)
    count = int(np.ceil(largest / STEP))
    u, pressures, strains = np.zeros(joint.T.shape[0]), [], []
    for i in range(1, count + 1):
        u, p, *_ = joint.step(u, i * step / d)
        pressures.append(p)
        strains.append(joint.flange.hardened.max())
        progress(i, count)
    fits, pressures = step * np.arange(1, count + 1), np.array(pressures)
    effective = step * pressures / p_unit
    beyond = fits > first * 1.02
    return FitMap(
        np.concatenate([[0.0, first], fits[beyond]]),
        np.concatenate([[0.0, first], effective[beyond]]),
        float(flange_yield),
        float(rivet_yield),
        pressures,
        np.array(strains),
    )
