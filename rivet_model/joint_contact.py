"""Both halves and their rivets in unilateral contact: the direct solution that the joint's law is made from and held
against.

The halves mirror each other, and of the forces on both only the mirrored part (half their mirrored sum) opens or closes
a joint: the rest moves both pads alike.  So one half stands on a rigid plane at the split; half a rivet pulls its head
there:

    pads      p >= 0,  gap = C_pp p + C_ph h + D_p q + free >= 0,  p gap = 0         p: forces of the hats on the half, along x
    rivet     -(T, m_r, m_t) = h,  half a rivet: its head follows the seat's bottom,  C_hp p + (C_hh + c) h + D_h q + free_h + e = 0
    balance   D_p^T p + D_h^T h + resultant = 0                                       q: motion along x, rotations about y and z

e: shortening of the rivet that gives the tension P to the unloaded joint.  With h eliminated this is the problem of
lcp.py. Loads of a joint, as the half gives them to it: N = T - sum p, M_r = m_r - sum p t, M_t = m_t + sum p r (place
(r, t) from the rivet's axis).
"""

from dataclasses import dataclass

import numpy as np

from . import section_mesh
from .cage_half import MIRRORED
from .elasticity import Body
from .lcp import Contact
from .section_mesh import edge_nodes


@dataclass
class JointState:
    """Loads at each rivet [..., Z] in N and N.m: (N, M_r, M_t) of the joint, (T, m_r, m_t) of the rivet; motion (u,
    phi_r, phi_t) of the pad [m, rad].
    """

    load: np.ndarray  # [Z, 3]
    rivet: np.ndarray  # [Z, 3]
    motion: np.ndarray  # [Z, 3]
    pressure: np.ndarray  # [Z, hats] forces [N]
    # [3] motion along x, rotations about y and z of the whole half; along x alone [1] of joints that are all alike
    closing: np.ndarray


def rivet_compliance(g, fine=None):
    """Half a rivet under uniform and linear pressure below its head: axial [m/N] and bending [rad/(N.m)], by the
    elements of revolution.
    """
    body = Body(section_mesh.rivet_mesh(g, fine), g.E_rivet, g.nu_rivet)
    radii = (g.shank_diameter / 2 + g.relief_radius, g.head_diameter / 2)
    up, down = (edge_nodes(body.mesh, z=z, between=radii) for z in (g.flange_thickness, -g.flange_thickness))
    positions = section_mesh.head_radii(g, fine or section_mesh.Fineness())
    area, moment = np.pi * (radii[1] ** 2 - radii[0] ** 2), np.pi / 4 * (radii[1] ** 4 - radii[0] ** 4)
    # uniform pressure p_0 = 1/area pushes the heads apart; harmonic 1 with p_0 = r/moment turns them against each other
    both = [body.ring_loads(nodes, positions, (0.0, sign), 0) for nodes, sign in ((up, 1.0), (down, -1.0))]
    axial = (both[0] + both[1]).sum(axis=1) / area
    w = 2 * np.pi * axial @ body.solve(0, axial[:, None])[:, 0]
    turning = (both[0] + both[1]) @ positions / moment
    phi = np.pi * turning @ body.solve(1, turning[:, None])[:, 0]
    return 0.5 * w, 0.5 * phi


class JointContact:
    """The contact problem of a half whose patterns (cage_half.CageHalf) and whose rivet's compliance are given.

    alike: all joints carry the same, so that one stands for all of them (Z = 1) and the half moves along x only.
    """

    def __init__(self, elastic, rivet=None, alike=False):
        self.half, g, p = elastic, elastic.g, elastic.patterns
        self.Z, self.hats = 1 if alike else g.Z, len(elastic.pad_area)
        self.c_rivet = np.diag(np.array(rivet or rivet_compliance(g))[[0, 1, 1]])
        self.head = slice(p.head.start, p.head.start + 3)
        r, t = elastic.pad_place
        self.lever = np.stack([np.ones(self.hats), t, -r], axis=1)  # of hats by (u, phi_r, phi_t)
        # [k, patterns, patterns]: displacement on pitch k by loads on pitch 0
        C = elastic.waves[:1].real if alike else elastic.circulant(elastic.waves)
        self.C = C
        Z = self.Z
        relative = (np.arange(Z)[:, None] - np.arange(Z)) % Z

        def spread(rows, columns):
            block = C[:, rows, columns][relative]
            return block.transpose(0, 2, 1, 3).reshape(Z * block.shape[2], -1)

        C_pp, C_ph, C_hh = spread(p.pad, p.pad), spread(p.pad, self.head), spread(self.head, self.head)
        D = self.rigid = self._rigid()
        D_p, D_h = (D[:, part].reshape(-1, D.shape[-1]) for part in (p.pad, self.head))
        self.A = np.linalg.inv(C_hh + np.kron(np.eye(Z), self.c_rivet))
        self.C_ph, self.D_h = C_ph, D_h
        pull = C_ph @ self.A
        self.pull = pull
        C_c = C_pp - pull @ C_ph.T
        self.D_c = D_p - pull @ D_h
        self.contact = Contact(0.5 * (C_c + C_c.T), self.D_c, D_h.T @ self.A @ D_h)
        self.e = self._shortening()

    def _rigid(self):
        """Work of the patterns on (motion along x, rotations about y, z of the whole half) [Z, patterns, 3],
        without the part that inertia balances.

        Joints that are all alike: on the motion along x alone [1, patterns, 1].
        """
        e = self.half
        # tilt: about y, and i times about z
        x, tilt = e.prevented(0, MIRRORED)[:, 0].real, e.prevented(1, MIRRORED)[:, 0]
        if self.Z == 1:
            return (e.resultants @ x)[None, :, None]
        D = np.zeros((self.Z, len(e.resultants), 3))
        for k in range(self.Z):
            about = np.exp(2j * np.pi * k / self.Z) * (e.resultants @ tilt)
            D[k] = np.stack([e.resultants @ x, about.real, about.imag], axis=1)
        return D

    def _shortening(self):
        """e of the heads per newton of preload [Z, 3]: along x only, the same everywhere."""
        e = np.tile([1.0, 0.0, 0.0], self.Z)
        T = (
            -self._solve(np.zeros(self.Z * self.hats), e, np.zeros(self.D_c.shape[1]))[1]
            .reshape(self.Z, 3)[:, 0]
            .mean()
        )
        return e / T

    def _solve(self, free, e, resultant, active=None):
        """p, h, q for free displacements of the hats, those of the heads with the shortening, and the loads' resultant."""
        g, f = free - self.pull @ e, -resultant + self.D_h.T @ self.A @ e
        solution = self.contact.solve(g, f, active)
        q = -solution.q
        h = -self.A @ (self.C_ph.T @ solution.p + self.D_h @ q + e)
        return solution.p, h, q, solution

    def loads(self, forces=(), column=None):
        """Mirrored loads for `solve`: (displacements of all patterns if nothing held them [Z, patterns], resultant
        [3]).

        forces: (pocket, point, (F_x, F_r, F_t)) on the +x half, point: index into the half's points; half of each is
        mirrored. column: patterns [patterns] that every pitch of both halves has beside (half_loads.centrifugal).
        """
        p, Z = self.half.patterns, self.Z
        count = 3 * len(self.half.points)
        u, resultant = np.zeros((Z, self.C.shape[1])), np.zeros(3)
        if column is not None:
            u += self.C.sum(axis=0) @ column
        for pocket, point, force in forces:
            for part, shift in ((0, 0), (1, -1)):
                columns = p.pocket.start + part * count + 3 * point + np.arange(3)
                f = 0.5 * np.asarray(force)
                # the waves count both parts at their pocket (CyclicSolid._phase), the rigid motions count them at the
                # pitch that they stand on
                u += np.roll(self.C[:, :, columns] @ f, pocket, axis=0)
                resultant += f @ self.rigid[(pocket + shift) % Z, columns]
        return u, resultant

    def solve(self, P, load, active=None):
        """JointState under the preload P [N] (one number or one for each rivet) and mirrored loads (from `loads`)."""
        u, resultant = load
        p = self.half.patterns
        e = self.e * np.repeat(np.broadcast_to(P, self.Z), 3) + u[:, self.head].ravel()
        forces, h, q, solution = self._solve(u[:, p.pad].ravel(), e, resultant, active)
        forces, rivet = forces.reshape(self.Z, -1), -h.reshape(self.Z, 3)
        # motion of the pad: mean and rotation of its hats, weighted by their areas
        area = self.half.pad_area[:, None] * self.lever
        motion = np.linalg.solve(self.lever.T @ area, area.T @ solution.gap.reshape(self.Z, -1).T).T
        return JointState(rivet - forces @ self.lever, rivet, motion, forces, q)

    def displacement(self, column, pitch, load, state):
        """Work-conjugate displacement of the patterns `column` [patterns] of one pitch in a state under a load of
        `solve`.
        """
        u, p = load[0].copy(), self.half.patterns
        relative = (np.arange(self.Z)[:, None] - np.arange(self.Z)) % self.Z
        for where, forces in ((p.pad, state.pressure), (self.head, -state.rivet)):
            u += np.einsum("kjpq,jq->kp", self.C[:, :, where][relative], forces)
        return column @ (u[pitch] + self.rigid[pitch] @ state.closing)
