"""The rivet joint condensed to its contacts: from loads follow pressures, stresses and displacements without solving on
the mesh again.

Pressure in each contact is a sum of hats along the edge (rings) times hats over the angle; gaps are means with the same
hats, so the compliance is symmetric and positive definite on any grid.  Fit and preload change the gaps only.
Contacts: UH, LH under the upper and lower head, UB, LB in the bores, PP in the split plane.  Upper = the +x half; loads
act on its rigid rim, and the lower rim is held:

    rigid motions q = (x, y, z, rotation x, rotation y) of the rivet, then of the upper rim;  V along x, M about x and
    y, N along z

here with z along the rivet.  Two symmetries halve the work: the plane of V if M bends in it ("plane": M about y), and
half a turn about y if M bends across it ("across": M about x).
"""

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import PchipInterpolator

from . import section_mesh
from .elasticity import Body
from .lcp import Contact
from .section_mesh import Fineness, edge_nodes

GROUPS = ("UH", "UB", "LB", "LH", "PP")
SPRINGS = np.array([1e-5, 1e-5, 1e-5, 1e-11, 1e-11])  # N/m, N.m/rad: 1e-12 of the joint's own stiffness
NO_PRELOAD = 1e-9  # share of s that replaces P = 0, so that the heads just touch


def graded_angles(step, dense=16.0, coarse=15.0):
    """Angles of the bore's hats [rad]: `step` degrees within `dense` degrees of 0 and 180, growing to `coarse`;
    symmetric about 0, 90 and 180.

    >>> len(graded_angles(3.75))
    48
    """
    angles, size = [0.0], step
    while angles[-1] + size < 90.0 - 0.5 * size:
        angles.append(angles[-1] + size)
        if angles[-1] >= dense - 1e-9:
            size = min(1.5 * size, coarse)
    quarter = np.array(angles)
    half = np.concatenate([quarter, [90.0], 180.0 - quarter[::-1]])
    return np.deg2rad(np.concatenate([half, 360.0 - half[-2:0:-1]]))


def hat_harmonics(angles, n_max):
    """Integrals of the periodic hats at `angles` with cos n theta and sin n theta: [2, angles, n_max + 1]."""
    left, right = np.roll(angles, 1), np.roll(angles, -1)
    left[0] -= 2 * np.pi
    right[-1] += 2 * np.pi
    n = np.arange(1, n_max + 1)

    def e(t):
        return np.exp(1j * np.outer(t, n))

    z = ((e(angles) - e(left)) / (angles - left)[:, None] - (e(right) - e(angles)) / (right - angles)[:, None]) / n**2
    z = np.concatenate([0.5 * (right - left)[:, None], z], axis=1)
    return np.stack([z.real, z.imag])


@dataclass(frozen=True)
class Grid:
    """Discretization: mesh, bore angles, uniform angles under heads and in the split plane, harmonics."""

    fine: Fineness = Fineness()
    step: float = 3.75  # degrees, near the contact of the bore
    uniform: int = 24
    n_max: int = 48

    def __post_init__(self):
        if self.n_max < max(180.0 / self.step, self.uniform / 2):
            raise ValueError(
                f"grid: n_max = {self.n_max}: hats of {self.step:g} degrees need {np.ceil(max(180.0 / self.step, self.uniform / 2)):g} harmonics"
            )

    def solved_harmonics(self):
        """Harmonics that are solved; between them n times the compliance is smooth over n and is interpolated."""
        n = [k for k in (*range(9), 10, 12, 14, 16, 20, 24, 32, 40, 48, 64, 80, 96, 128) if k < self.n_max]
        return np.array([*n, self.n_max])


COARSE = Grid(Fineness(0.6), 11.25, 12, 16)
SHIPPED = Grid()
TRUTH = Grid(Fineness(1.0), 1.875, 24, 96)


def surface_stress(tt, hoop, shear):
    """Largest principal and von Mises stress at a free surface from its three components."""
    mean, half = 0.5 * (tt + hoop), 0.5 * (tt - hoop)
    return mean + np.sqrt(half**2 + shear**2), np.sqrt(tt**2 - tt * hoop + hoop**2 + 3 * shear**2)


class Joint:
    """Condensed model of one geometry on one grid."""

    def __init__(self, geometry, grid=SHIPPED, progress=None):
        self.geometry, self.grid = geometry, grid
        g = geometry
        self.rings = {"UH": section_mesh.head_radii(g, grid.fine), "UB": section_mesh.bore_levels(g, grid.fine)}
        self.rings |= {"LH": self.rings["UH"], "LB": -self.rings["UB"], "PP": section_mesh.plate_radii(g, grid.fine)}
        bore, uniform = graded_angles(grid.step), 2 * np.pi * np.arange(grid.uniform) / grid.uniform
        self.angles = {name: bore if name.endswith("B") else uniform for name in GROUPS}
        self.hats = {name: hat_harmonics(angles, grid.n_max) for name, angles in self.angles.items()}
        self.kappa = np.where(np.arange(grid.n_max + 1) == 0, 2 * np.pi, np.pi)
        self._condense(progress or (lambda done, total: None))
        self._assemble()

    # Finite elements, once per geometry -------------------------------------------------------------------------------

    def _condense(self, progress):
        g, fine = self.geometry, self.grid.fine
        R, t = g.shank_diameter / 2, g.flange_thickness
        self.rivet = Body(section_mesh.rivet_mesh(g, fine), g.E_rivet, g.nu_rivet)
        self.flange = Body(
            section_mesh.flange_mesh(g, fine), g.E_flange, g.nu_flange, lambda x: x[0] > g.patch_radius - 1e-9
        )
        bore, heads = (g.edge_break, t - g.relief_depth), (R + g.relief_radius, g.head_diameter / 2)

        def pair(body, normal_side):
            """Loads of UH and UB on the rivet (normal_side +1) or the flange (-1), and of LB, LH on the rivet."""
            sign = normal_side
            on_head = edge_nodes(body.mesh, z=t, between=heads)
            on_bore = edge_nodes(body.mesh, r=R, between=bore)
            upper = [
                body.ring_loads(on_head, self.rings["UH"], (0.0, -sign), 0),
                body.ring_loads(on_bore, self.rings["UB"], (sign, 0.0), 1),
            ]
            self.moments = {
                "UH": body.ring_moments(on_head, self.rings["UH"], 0),
                "UB": body.ring_moments(on_bore, self.rings["UB"], 1),
            }
            return upper

        upper = pair(self.rivet, 1.0)
        low_bore = edge_nodes(self.rivet.mesh, r=R, between=(-bore[1], -bore[0]))
        low_head = edge_nodes(self.rivet.mesh, z=-t, between=heads)
        lower_bore = self.rivet.ring_loads(low_bore, self.rings["LB"][::-1], (1.0, 0.0), 1)[:, ::-1]
        rivet_loads = np.hstack([*upper, lower_bore, self.rivet.ring_loads(low_head, self.rings["LH"], (0.0, 1.0), 0)])
        flange_upper = pair(self.flange, -1.0)
        on_plate = edge_nodes(self.flange.mesh, z=0.0)
        flange_loads = np.hstack([*flange_upper, self.flange.ring_loads(on_plate, self.rings["PP"], (0.0, -1.0), 0)])
        self.rivet_loads, self.flange_loads = rivet_loads, flange_loads
        m = self.moments
        m["PP"] = self.flange.ring_moments(on_plate, self.rings["PP"], 0)
        m["LH"], m["LB"] = m["UH"], m["UB"] * np.array([[1.0], [-1.0]])
        self.fillet, self.lower_fillet, self.middle = self._stress_places()

        size = {name: len(self.rings[name]) for name in GROUPS}
        half = size["UH"] + size["UB"]
        # mirror[i]: the mirrored ring, in the order UH, UB, LB, LH
        heads, bores = np.arange(size["UH"]), np.arange(size["UB"])
        mirror = np.concatenate([half + size["LB"] + heads, half + bores, size["UH"] + bores, heads])
        solved = self.grid.solved_harmonics()
        rivet, flange, stress = [], [], []
        for i, n in enumerate(solved):
            u = self.rivet.solve(n, rivet_loads[:, :half])
            S = rivet_loads.T @ u  # [all rings, upper rings]
            S = np.hstack([S, S[mirror][:, mirror[half:]]])
            rivet.append(0.5 * (S + S.T))
            stress.append(self._stress_response(n, -u, mirror, half))
            v = self.flange.solve(n, flange_loads)
            flange.append(flange_loads.T @ v)
            progress(i + 1, len(solved))
        all_n = np.arange(self.grid.n_max + 1)

        def spread(values):
            values = np.array(values)
            scale = np.maximum(solved, 1).reshape(-1, *[1] * (values.ndim - 1))
            return PchipInterpolator(solved, scale * values, axis=0)(all_n) / np.maximum(all_n, 1).reshape(
                -1, *[1] * (values.ndim - 1)
            )

        self.S_rivet, self.S_flange, self.S_stress = spread(rivet), spread(flange), spread(stress)
        self.ring_slices, start = {}, 0
        for name in ("UH", "UB", "LB", "LH"):
            self.ring_slices[name] = slice(start, start + size[name])
            start += size[name]

    def _stress_places(self):
        """Stress rows (S_0, S_1, x, tangent) of the upper fillet, the lower one with its points in mirrored order, and
        the middle.
        """
        g, mesh = self.geometry, self.rivet.mesh
        facets = mesh.boundary_facets()
        ends = mesh.p[:, mesh.facets[:, facets]]
        R, rf = g.shank_diameter / 2, g.fillet_radius
        places = []
        for side in (1.0, -1.0):
            off = ends - np.array([R + rf, side * (g.flange_thickness - rf)])[:, None, None]
            on_arc = (np.abs(np.hypot(*off) - rf) < 1e-9) & (off[0] < 1e-9) & (side * off[1] > -1e-9)
            places.append(self._stress_rows(facets[np.all(on_arc, axis=0)], side))
        zone = (np.abs(ends[0] - R) < 1e-9) & (np.abs(ends[1]) < g.middle_zone + 1e-9)
        return *places, self._stress_rows(facets[np.all(zone, axis=0)], 1.0)

    def _stress_rows(self, facets, side):
        """Rows sorted along the edge from the split plane outward; tangents of the lower side are the mirrored ones of
        the upper side.
        """
        mesh = self.rivet.mesh
        S_0, S_1, x = self.rivet.stress_rows(facets)
        along = np.diff(mesh.p[:, mesh.facets[:, facets]], axis=1)[:, 0]
        tangent = np.repeat(along / np.hypot(*along), 2, axis=1)  # two points per facet
        tangent *= np.where(side * tangent[1] < 0.0, -1.0, 1.0)
        order = np.argsort(side * x[1])
        rows = (x.shape[1] * np.arange(6)[:, None] + order).ravel()
        return S_0[rows], S_1[rows], x[:, order], tangent[:, order]

    def surface_response(self, place, n, u):
        """Surface stress (tt, hoop, shear) of harmonic n along an edge (`place`) for rivet displacements u [dofs,
        cases]: [3, points, cases].
        """
        S_0, S_1, x, (tr, tz) = place
        s = ((S_0 + n * S_1) @ u).reshape(6, x.shape[1], -1)
        tr, tz = tr[:, None], tz[:, None]
        return np.stack([tr**2 * s[0] + 2 * tr * tz * s[3] + tz**2 * s[2], s[1], tr * s[4] + tz * s[5]])

    def _stress_response(self, n, u, mirror, half):
        """Surface stress at upper fillet, then middle, per unit pressure amplitude of all rings, from displacements u
        by the upper rings.

        By symmetry a lower ring causes at a point the stress that the mirrored ring causes at the mirrored point.
        """
        back = mirror[half:]
        upper, lower = (self.surface_response(place, n, u) for place in (self.fillet, self.lower_fillet))
        middle = self.surface_response(self.middle, n, u)
        mirrored = middle[:, ::-1] * np.array([1.0, 1.0, -1.0])[:, None, None]  # the middle's tangents all point up
        fillets = np.concatenate([upper, lower[:, :, back]], axis=2)
        return np.concatenate([fillets, np.concatenate([middle, mirrored[:, :, back]], axis=2)], axis=1)

    # The contact problem ----------------------------------------------------------------------------------------------

    def _assemble(self):
        """Compliance C [m/N], approach by rigid motions D, and the two symmetric reductions of the whole circle."""
        self.slices, start = {}, 0
        for name in GROUPS:
            count = len(self.rings[name]) * len(self.angles[name])
            self.slices[name] = slice(start, start + count)
            start += count
        self.size = start
        self.weight = np.concatenate(
            [np.outer(self.moments[name][0], self.hats[name][0][:, 0]).ravel() for name in GROUPS]
        )
        C = np.zeros((start, start))
        heads, bores = len(self.rings["UH"]), len(self.rings["UB"])
        self.upper = {
            "UH": slice(0, heads),
            "UB": slice(heads, heads + bores),
            "PP": slice(heads + bores, self.S_flange.shape[1]),
        }
        self.lower = {"LH": self.upper["UH"], "LB": self.upper["UB"], "PP": self.upper["PP"]}
        for S, rings in ((self.S_rivet, self.ring_slices), (self.S_flange, self.upper), (self.S_flange, self.lower)):
            for first in rings:
                for second in rings:
                    C[self.slices[first], self.slices[second]] += self._spread(
                        S[:, rings[first], rings[second]], first, second
                    )
        C /= np.outer(self.weight, self.weight)
        self.C = 0.5 * (C + C.T)
        self.D = self._approach() / self.weight[:, None]

        position = {name: self._index(name) for name in GROUPS}
        plane, across = np.arange(self.size), np.arange(self.size)
        swap = {"UH": "LH", "UB": "LB", "LB": "UB", "LH": "UH", "PP": "PP"}
        for name in GROUPS:
            angles = self.angles[name]
            plane[position[name]] = position[name][:, self._turned(angles, -angles)]
            across[position[name]] = position[swap[name]][:, self._turned(angles, np.pi - angles)]
        self.problems = {
            "plane": self._reduced(plane),
            "across": self._reduced(across),
            "full": self._reduced(np.arange(self.size)),
        }

    def _index(self, name):
        s = self.slices[name]
        return np.arange(s.start, s.stop).reshape(len(self.rings[name]), len(self.angles[name]))

    @staticmethod
    def _turned(angles, wanted):
        return np.argmin(np.abs(np.angle(np.exp(1j * (angles[None, :] - wanted[:, None])))), axis=1)

    def _spread(self, S, first, second):
        a, b = self.hats[first], self.hats[second]
        total = np.zeros((S.shape[1], a.shape[1], S.shape[2], b.shape[1]))
        for part in range(2):
            left = np.einsum("nij,n->ijn", S, 1.0 / self.kappa)
            total += np.einsum("ijkn,ln->ikjl", left[:, :, None, :] * a[part][None, None], b[part], optimize=True)
        return total.reshape(S.shape[1] * a.shape[1], -1)

    def _approach(self):
        """Integrals of hat x normal displacement by the rigid motions of rivet and upper rim [contacts, 10]."""
        D = np.zeros((self.size, 10))
        for name in GROUPS:
            area, first = self.moments[name]
            one, c, s = self.hats[name][0][:, 0], self.hats[name][0][:, 1], self.hats[name][1][:, 1]
            zero = np.zeros((len(area), len(one)))
            if name.endswith("B"):  # u . r = (x + z ry) cos + (y - z rx) sin
                motion = [np.outer(area, c), np.outer(area, s), zero, -np.outer(first, s), np.outer(first, c)]
                rivet, rim = 1.0, -1.0
            # u_z = z + r (rx sin - ry cos); outward normal of the rivet -z under the upper head, +z under the lower one
            else:
                motion = [zero, zero, np.outer(area, one), np.outer(first, s), -np.outer(first, c)]
                rivet, rim = {"UH": (-1.0, 1.0), "LH": (1.0, 0.0), "PP": (0.0, -1.0)}[name]
            if name in ("LB", "LH"):
                rim = 0.0
            motion = np.stack([m.ravel() for m in motion], axis=1)
            D[self.slices[name], :5], D[self.slices[name], 5:] = rivet * motion, rim * motion
        return D

    def _reduced(self, image):
        """Contact problem of one member of each pair of contacts that the symmetry maps onto each other."""
        representative = np.minimum(np.arange(self.size), image)
        unique, member = np.unique(representative, return_inverse=True)
        E = np.zeros((self.size, len(unique)))
        E[np.arange(self.size), member] = 1.0
        C = self._fold(self._fold(self.C, member, len(unique)).T, member, len(unique)).T
        return Contact(C, self._fold(self.D, member, len(unique)), np.tile(SPRINGS, 2)), member

    @staticmethod
    def _fold(matrix, member, count):
        folded = np.zeros((count, matrix.shape[1]))
        np.add.at(folded, member, matrix)
        return folded

    def overclosure(self, P, fit):
        """Shortening of the rivet between its heads [m] that gives the clamp force P at this fit: the preload after
        riveting.
        """
        if not hasattr(self, "_axial"):
            area = {name: 2 * np.pi * self.moments[name][0] for name in GROUPS}
            uniform = {
                name: np.repeat(np.eye(len(self.rings[name])), len(self.angles[name]), axis=0) for name in GROUPS
            }
            E = np.zeros((self.size, sum(len(self.rings[name]) for name in GROUPS)))
            start = 0
            for name in GROUPS:
                share = (
                    self.weight[self.slices[name]].reshape(len(self.rings[name]), -1) / area[name][:, None]
                ).ravel()
                E[self.slices[name], start : start + len(self.rings[name])] = uniform[name] * share[:, None]
                start += len(self.rings[name])
            C, D = E.T @ self.C @ E, (E.T @ self.D)[:, [2, 7]]
            heads = np.concatenate(
                [np.full(len(self.rings[name]), 0.5 if name.endswith("H") else 0.0) for name in GROUPS]
            )
            bores = np.concatenate(
                [np.full(len(self.rings[name]), 1.0 if name.endswith("B") else 0.0) for name in GROUPS]
            )
            self._axial = Contact(C, np.column_stack([D, heads]), np.full(3, SPRINGS[2])), bores
        contact, bores = self._axial
        return contact.solve(-0.5 * fit * bores, np.array([0.0, 0.0, P])).q[2]

    def shank(self, T, m, fit):
        """Shortening of the rivet between its heads [m] and tilt of one head against the other [rad] that give the
        shank the tension T and the moment m.

        The plates stay closed and carry the rest, so this is the rivet of any joint, whatever load opens its
        plates.
        """
        if not hasattr(self, "_shank"):
            contact, member = self.problems["plane"]
            heads = np.concatenate(
                [np.full(self.slices[n].stop - self.slices[n].start, 0.5 if n.endswith("H") else 0.0) for n in GROUPS]
            )
            columns = np.column_stack([heads, self._head_tilt()[:, 1]])
            D = np.hstack([contact.D, self._fold(columns, member, contact.C.shape[0])])
            bores = np.concatenate(
                [np.full(self.slices[n].stop - self.slices[n].start, 1.0 if n.endswith("B") else 0.0) for n in GROUPS]
            )
            self._shank = (
                Contact(contact.C, D, np.concatenate([np.tile(SPRINGS, 2), SPRINGS[[2, 4]]])),
                np.bincount(member, weights=bores),
            )
        contact, bores = self._shank
        f = np.zeros(12)
        f[10:] = T, m
        return contact.solve(-0.5 * fit * bores, f).q[10:]

    def _head_tilt(self):
        """Approach of the contacts by a unit tilt of the upper head's seat against the lower one's, half of it each,
        about x and y [contacts, 2].
        """
        tilt = np.zeros((self.size, 2))
        for name, side in (("UH", 0.5), ("LH", -0.5)):
            tilt[self.slices[name]] = side * self.D[self.slices[name], 3:5]
        return tilt

    def solve_shank(self, T, V, m_plane, m_across, fit, active=None):
        """Contact forces and Solution of a rivet whose shank would carry tension T and moments m without V, then bears
        V [N, N.m, m].
        """
        symmetry = "plane" if m_across == 0.0 else "across" if m_plane == 0.0 else "full"
        contact, member = self.problems[symmetry]
        m = np.hypot(m_plane, m_across)
        short, tilt = self.shank(max(T, NO_PRELOAD * (T + V)), m, fit)
        g = np.zeros(self.size)
        for name in GROUPS:
            g[self.slices[name]] = {"B": -0.5 * fit, "H": -0.5 * short, "P": 0.0}[name[-1]]
        if m > 0.0:
            g -= self._head_tilt() @ (tilt * np.array([m_across, m_plane]) / m)
        folded = np.bincount(member, weights=g, minlength=contact.C.shape[0])
        f = np.zeros(10)
        f[5] = V
        solution = contact.solve(folded, f, active)
        return solution.p[member], solution

    def gaps(self, P, fit):
        """Gaps of all contacts before loading [m]."""
        g = np.zeros(self.size)
        delta = self.overclosure(P, fit)
        for name in GROUPS:
            g[self.slices[name]] = {"B": -0.5 * fit, "H": -0.5 * delta, "P": 0.0}[name[-1]]
        return g

    def solve(self, P, N, V, M_plane, M_across, fit, active=None):
        """Contact forces and rigid motions for one load [N, N.m, m]; the symmetry of the load is used.

        Returns (forces [contacts], q [10], Solution, symmetry).  `active`: active set of a similar case of the same
        symmetry.
        """
        symmetry = "plane" if M_across == 0.0 else "across" if M_plane == 0.0 else "full"
        contact, member = self.problems[symmetry]
        scale = P + N + V + (abs(M_plane) + abs(M_across)) / 2e-3
        g = self.gaps(max(P, NO_PRELOAD * scale), fit)
        folded = np.bincount(member, weights=g, minlength=contact.C.shape[0])
        f = np.zeros(10)
        f[5:] = V, 0.0, N, M_across, M_plane
        solution = contact.solve(folded, f, active)
        return solution.p[member], solution.q, solution, symmetry

    # Stress -----------------------------------------------------------------------------------------------------------

    def amplitudes(self, forces, rings):
        """Cosine and sine amplitudes of the pressure of a body's rings [2, harmonics, rings, cases] in Pa.  rings: name
        -> places on that body.
        """
        pressure = forces / self.weight[:, None]
        amplitude = np.zeros((2, self.grid.n_max + 1, max(s.stop for s in rings.values()), forces.shape[1]))
        for name, place in rings.items():
            p = pressure[self.slices[name]].reshape(len(self.rings[name]), len(self.angles[name]), -1)
            amplitude[:, :, place] = (
                np.einsum("tkn,jkc->tnjc", self.hats[name], p, optimize=True) / self.kappa[:, None, None]
            )
        return amplitude

    def fields(self, forces, count=72):
        """Surface stress (tt, hoop, shear) of both fillets and the middle at `count` angles: [3, points, angles, cases]
        each.

        forces: contact forces [contacts, cases].  The lower fillet's points mirror the upper one's.
        """
        phi = 2 * np.pi * np.arange(count) / count
        n = np.arange(self.grid.n_max + 1)
        amplitude = self.amplitudes(forces, self.ring_slices)
        upper, lower, middle = [], [], []
        points = self.fillet[2].shape[1]
        order = np.concatenate(
            [np.arange(s.start, s.stop) for s in (self.ring_slices[k] for k in ("LH", "LB", "UB", "UH"))]
        )
        c, s = np.cos(np.outer(n, phi)), np.sin(np.outer(n, phi))
        for result, rows, amp in (
            (upper, self.S_stress[:, :, :points], amplitude),
            (lower, self.S_stress[:, :, :points], amplitude[:, :, order]),
            (middle, self.S_stress[:, :, points:], amplitude),
        ):
            A, B = (np.einsum("nspj,njc->spcn", rows, a, optimize=True) for a in amp)
            even = A[:2] @ c + B[:2] @ s
            odd = A[2:] @ s - B[2:] @ c
            result.append(np.concatenate([even, odd]).swapaxes(2, 3))
        return upper[0], lower[0], middle[0]

    def channels(self, forces, count=72):
        """The table's channels [cases, 4] in Pa: largest over both fillets, over the middle."""
        upper, lower, middle = self.fields(forces, count)
        (p_u, v_u), (p_l, v_l), (p_m, v_m) = (surface_stress(*field) for field in (upper, lower, middle))

        def top(*arrays):
            return np.max([a.max(axis=(0, 1)) for a in arrays], axis=0)

        return np.stack([top(p_u, p_l), top(v_u, v_l), top(v_m), top(p_m)], axis=-1)
