"""One riveted joint under shear by Coulomb friction on the finite elements: the reference for the joint's law of friction.

The relative displacement delta of the rims along x pulls the split plane (rings PP) and the heads (rings UH, LH) into
slip. The unknowns are the ring forces F along x.  Half a turn about y maps the joint onto itself, so both heads bear the
same F, the plates' tractions are equal and opposite, and only the heads have pressures of harmonic 1 (they balance the
couple 2 t T_h):

    slip = delta - C F,  |F_j| <= mu N_j,  slip grows only along F_j where |F_j| = mu N_j     N_j: preload on ring j

Slip tractions on a ring have one direction (Cattaneo 1938, Mindlin 1949), and the limit holds in the mean over the ring.
Of two directions each has the same C, so that a load may turn.  Bores are open, rims stay parallel.
"""

from dataclasses import dataclass

import numpy as np

from rivet_model import section_mesh
from rivet_model.elasticity import Body
from rivet_model.lcp import Contact
from rivet_model.section_mesh import Fineness, edge_nodes

ALONG_X = (1.0, -1.0, 0.0)  # harmonic 1 of a unit traction along x: cos theta, -sin theta


def within(limit, v):
    """v [rings, directions] cut to the length `limit` [rings], and its derivative by v [rings, directions, directions]."""
    length = np.maximum(np.linalg.norm(v, axis=1), 1e-300)[:, None, None]
    unit = v / length[:, :, 0]
    along = unit[:, :, None] * unit[:, None, :]
    one, ratio = np.eye(v.shape[1]), limit[:, None, None] / length
    derivative = np.where(ratio < 1.0, ratio * (one - along), one)
    return np.minimum(ratio[:, 0], 1.0) * v, derivative


def rub(C, limit, push, F):
    """Forces F [rings, directions] with |F| <= limit and slip = push - C F: zero inside, along F at the limit.

    Newton on F = within(F + slip/c), c = diag C, from the F of a similar case.  (Alart and Curnier 1991)
    """
    c = np.diag(C)[:, None]

    def residual(F):
        cut, derivative = within(limit, F + (push - C @ F) / c)
        return F - cut, derivative

    rest, derivative = residual(F)
    for _ in range(100):
        if np.abs(rest).max() < 1e-12 * limit.max():
            return F
        n, d = F.shape
        step = np.einsum("iab,ij->iajb", derivative, np.eye(n) - C / c)
        change = np.linalg.solve(np.eye(n * d) - step.reshape(n * d, n * d), rest.ravel()).reshape(n, d)
        for share in 0.5 ** np.arange(12):
            there, tangent = residual(F - share * change)
            if np.linalg.norm(there) < np.linalg.norm(rest):
                break
        F, rest, derivative = F - share * change, there, tangent
    raise ArithmeticError(f"friction not found: {np.abs(rest).max():g} N of {limit.max():g} N left")


@dataclass
class Path:
    """Shear T [N] at each delta [m], its part under the heads, and the friction's work since the start [J].

    delta, T and T_head are numbers (along x) or have a row (x, y) for each step.
    """

    delta: np.ndarray
    T: np.ndarray
    T_head: np.ndarray
    dissipated: np.ndarray


class Sliding:
    """Rings with compliance C [m/N], limits [N]; `heads` of them (the last ones) are under the heads."""

    def __init__(self, C, limit, heads=0):
        self.C, self.limit, self.heads = 0.5 * (C + C.T), limit, heads

    @property
    def stiffness(self):
        """Tangent dT/d delta [N/m] while every ring sticks."""
        return np.linalg.solve(self.C, np.ones(len(self.C))).sum()

    @property
    def full_slip(self):
        """Smallest delta [m] at which every ring slips."""
        return (self.C @ self.limit).max()

    def follow(self, deltas):
        """Path through the rims' displacements `deltas` [steps] or [steps, 2], from no shear."""
        path = np.asarray(deltas, dtype=float)
        steps = path.reshape(len(path), -1)
        slip, F = (np.zeros((len(self.C), steps.shape[1])) for _ in range(2))
        T, T_head, work = np.zeros_like(steps), np.zeros_like(steps), np.zeros(len(steps))
        for i, delta in enumerate(steps):
            F = rub(self.C, self.limit, delta - slip, F)
            grown = delta - slip - self.C @ F
            slip += grown
            T[i], T_head[i], work[i] = F.sum(axis=0), F[len(F) - self.heads :].sum(axis=0), np.sum(F * grown)
        return Path(path, T.reshape(path.shape), T_head.reshape(path.shape), work.cumsum())

    def backbone(self, last=None, count=400):
        """Path of a first loading up to `last` [m] (full slip if not given), steps growing from the smallest."""
        return self.follow((last or self.full_slip) * np.linspace(0.0, 1.0, count + 1) ** 2)

    def cycle(self, amplitude, count=100):
        """Path of two cycles between +-amplitude [m] after the first loading, and the energy lost in the second [J]."""
        turns = [0.0, amplitude, -amplitude, amplitude, -amplitude, amplitude]
        path = self.follow(np.interp(np.arange(5 * count + 1) / count, np.arange(6), turns))
        return path, path.dissipated[-1] - path.dissipated[3 * count]


def compliance(body, loads):
    """Mean displacements of rings per ring force: [columns, columns]; loads [dofs, columns] in unit forces, harmonic 1."""
    S = np.pi * loads.T @ body.solve(1, loads)
    return 0.5 * (S + S.T)


class JointFriction:
    """Finite elements of one joint (geometry.Geometry) at a fineness; loads scale with preload and friction."""

    def __init__(self, g, fine=None):
        self.g, fine = g, fine or Fineness()
        self.t = t = g.flange_thickness
        seat = (g.shank_diameter / 2 + g.relief_radius, g.head_diameter / 2)
        self.rivet = Body(section_mesh.rivet_mesh(g, fine), g.E_rivet, g.nu_rivet)
        self.flange = Body(
            section_mesh.flange_mesh(g, fine), g.E_flange, g.nu_flange, lambda x: x[0] > g.patch_radius - 1e-9
        )
        self.head_rings, self.plate_rings = section_mesh.head_radii(g, fine), section_mesh.plate_radii(g, fine)
        top, plane = edge_nodes(self.flange.mesh, z=t, between=seat), edge_nodes(self.flange.mesh, z=0.0)
        up, down = (edge_nodes(self.rivet.mesh, z=z, between=seat) for z in (t, -t))
        head_area, turn = 2 * np.pi * self.flange.ring_moments(top, self.head_rings, 0)
        plate_area = 2 * np.pi * self.flange.ring_moments(plane, self.plate_rings, 0)[0]
        self.lever = turn / head_area  # mean radius of the rings under the head

        def loads(body, nodes, rings, area, direction):
            return body.traction_loads(nodes, rings, direction, 0) / area

        axial = (0.0, 0.0, 1.0)
        head, plate = (self.head_rings, head_area), (self.plate_rings, plate_area)
        self.on_flange = {
            "plate_x": loads(self.flange, plane, *plate, ALONG_X),
            "head_x": loads(self.flange, top, *head, ALONG_X),
            "plate_z": loads(self.flange, plane, *plate, axial),
            "head_z": loads(self.flange, top, *head, axial),
        }
        self.on_rivet = {
            "x": loads(self.rivet, up, *head, ALONG_X) - loads(self.rivet, down, *head, ALONG_X),
            "z": loads(self.rivet, up, *head, axial) + loads(self.rivet, down, *head, axial),
            "apart": loads(self.rivet, up, *head, axial) - loads(self.rivet, down, *head, axial),
        }
        self._preload()
        self._shear()

    def _preload(self):
        """Shares of the preload on the rings under a head and in the split plane, which may open: half a rivet pulls its
        head onto a flange that stands on the rigid split plane.
        """
        heads = len(self.head_rings)
        flange = np.hstack([-self.on_flange["head_z"], self.on_flange["plate_z"]])
        C = 2 * np.pi * flange.T @ self.flange.solve(0, flange)
        apart = self.on_rivet["apart"]
        C[:heads, :heads] += np.pi * apart.T @ self.rivet.solve(0, apart)
        head = np.arange(len(C)) < heads
        D = np.stack([np.where(head, 1.0, 0.0), np.where(head, 1.0, -1.0)], axis=1)
        share = Contact(0.5 * (C + C.T), D, np.full(2, 1e-5)).solve(np.zeros(len(C)), np.array([1.0, 0.0])).p
        self.head_share, self.plate_share = share[:heads], share[heads:]

    def _shear(self):
        """Compliance of the tractions along x with the heads' pressures of harmonic 1 and the rivet's rotation solved."""
        plates, heads = len(self.plate_rings), len(self.head_rings)
        flange = np.hstack([self.on_flange[name] for name in ("plate_x", "head_x", "head_z")])
        C = 2 * compliance(self.flange, flange)
        C[plates:, plates:] += compliance(self.rivet, np.hstack([self.on_rivet["x"], self.on_rivet["z"]]))
        D = np.concatenate([np.zeros(plates), np.full(heads, 2 * self.t), -self.lever])
        x, z = np.arange(plates + heads), plates + heads + np.flatnonzero(self.head_share > 0.0)
        pressure = np.block([[C[np.ix_(z, z)], D[z, None]], [D[None, z], np.zeros((1, 1))]])
        coupling = np.vstack([C[np.ix_(z, x)], D[None, x]])
        self.response = -np.linalg.solve(pressure, coupling)  # heads' pressures and rotation by the forces along x
        self.C = C[np.ix_(x, x)] + coupling.T @ self.response

    def sliding(self, P, mu, plates=True, heads=True):
        """Rings that rub at the preload P [N]: in the split plane, under the heads, or both."""
        limit = mu * P * np.concatenate([self.plate_share, self.head_share])
        on_plate = np.arange(len(limit)) < len(self.plate_rings)
        on = np.flatnonzero((limit > 0.0) & np.where(on_plate, plates, heads))
        return Sliding(self.C[np.ix_(on, on)], limit[on], np.count_nonzero(~on_plate[on]))


def deviation(sliding, law, deltas):
    """A law's shear against the rings' along a path of `deltas` [m] from rest: RMS and largest error over the slip load.

    law: function of the path that returns T [N] at each delta.  The path may turn: its errors include the loops.
    """
    error = (law(deltas) - sliding.follow(deltas).T) / sliding.limit.sum()
    return np.sqrt(np.mean(error**2)), np.abs(error).max()


def loop_area(delta, T):
    """Energy [J] that a closed path takes, by the trapezoidal rule."""
    return np.sum(0.5 * (T[1:] + T[:-1]) * np.diff(delta))
