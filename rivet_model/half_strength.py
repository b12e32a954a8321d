"""The force of a ball on its pocket under which a half begins to yield.

One half, held at its joints, is pushed along the ball's normal at one place of a pocket's wall.  Joints: the face in the
split plane under the rivet's head does not move; the rest of it may gape, as it does once the force pries a joint open.
By linear elasticity the largest von Mises stress is in proportion to the force.  It is read one thickness of the flange
away from the head and from the contact, where the International Institute of Welding reads the structural stress beside
a notch (XIII-1965-03, its farther point): nearer, the held face and the point force decide the stress.

    K_m u_m = F_m,   u_k = sum_m u_m exp(2 pi i m k/Z)/Z       waves m of the pitch with the cuts u(far) = turn exp(2 pi i m/Z) u(near)
"""

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu
from skfem import Basis

from .cage_half import SYMMETRIC, CageHalf

FLAT = 0.3  # of the median volume per unit cell at the corners of a cell
ENDS = (0.03, 0.97)  # nearly those of a cell
CORNERS = np.array([[x, y, z] for x in ENDS for y in ENDS for z in ENDS]).T


def held(elastic):
    """Whether each degree of freedom lies under a rivet's head in the split plane [dofs]."""
    r, t = elastic.rivet_place(elastic.x)
    return (np.abs(elastic.x[0]) < 1e-9) & (np.hypot(r, t) < 0.5 * elastic.g.head_diameter + 1e-9)


def cuts(elastic, m):
    """Matrix [dofs, free dofs] of the displacements of a wave that meet at the cuts and vanish where the half is held."""
    alpha = 2.0 * np.pi / elastic.Z
    c, s = np.cos(alpha), np.sin(alpha)
    turn = np.exp(1j * m * alpha) * np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
    n = elastic.basis.N
    inside = np.setdiff1d(np.arange(n), elastic.far)
    same = sp.csc_matrix((np.ones(len(inside)), (inside, inside)), shape=(n, n))
    blocks = sp.coo_matrix(sp.block_diag([turn] * (len(elastic.near) // 3)))
    met = sp.csc_matrix((blocks.data, (elastic.far[blocks.row], elastic.near[blocks.col])), shape=(n, n))
    return (same + met)[:, np.setdiff1d(inside, np.flatnonzero(held(elastic)))]


def displacements(elastic, force):
    """Displacements [Z, dofs, loads] of all pitches under forces on pocket 0: force [patterns of the pocket, loads]."""
    pocket = elastic.loads[:, elastic.patterns.pocket]
    back = elastic.back[elastic.patterns.pocket]
    waves = []
    for m in range(elastic.Z // 2 + 1):
        phase = np.where(back, np.exp(2j * np.pi * m / elastic.Z), 1.0)
        T = cuts(elastic, m)
        K = (T.conj().T @ elastic.K @ T).tocsc()
        waves.append(T @ splu(K, **SYMMETRIC).solve(T.conj().T @ (pocket @ (phase[:, None] * force))))
    return elastic.circulant(np.stack(waves))


class Corners:
    """The corners of all cells, nearly: strain is not defined where two edges of a cell meet in one line, and such a corner
    is left to the cell beside it.
    """

    def __init__(self, elastic):
        b, count = elastic.basis, CORNERS.shape[1]
        self.basis = Basis(b.mesh, b.elem, mapping=b.mapping, quadrature=(CORNERS, np.full(count, 1.0 / count)))
        self.E, self.nu = elastic.g.E_flange, elastic.g.nu_flange
        self.x = np.asarray(self.basis.global_coordinates())  # [3, cells, corners]
        volume = np.abs(b.mapping.detDF(CORNERS))
        self.defined = volume > FLAT * np.median(volume, axis=-1, keepdims=True)
        off_head = np.hypot(*elastic.rivet_place(self.x)) > 0.5 * elastic.g.head_diameter + elastic.g.flange_thickness
        self.off_head = self.defined & off_head

    def von_mises(self, u):
        """Stress [cells, corners] by the displacements u [dofs]."""
        H = self.basis.interpolate(u).grad
        strain = 0.5 * (H + H.swapaxes(0, 1))
        strain -= np.eye(3)[:, :, None, None] * np.einsum("iict->ct", strain) / 3.0
        return self.E / (1.0 + self.nu) * np.sqrt(1.5 * np.einsum("ijct,ijct->ct", strain, strain))


def stress_per_force(elastic, nodes):
    """Largest von Mises stress per force along the normal, at each of some points of the wall [1/m2]."""
    count, corners = len(elastic.points), Corners(elastic)
    places, normals = (of(*elastic.points[nodes].T) for of in (elastic.wall.place, elastic.wall.normal))
    force = np.zeros((2, count, 3, len(nodes)))
    force[:, nodes, :, np.arange(len(nodes))] = normals[:, None]
    u = displacements(elastic, force.reshape(6 * count, -1))
    largest = np.zeros(len(nodes))
    for k in range(elastic.Z):
        c, s = np.cos(2.0 * np.pi * k / elastic.Z), np.sin(2.0 * np.pi * k / elastic.Z)
        at = np.tensordot(np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]]), corners.x, 1)
        for i, place in enumerate(places):
            off_contact = np.linalg.norm(at - place[:, None, None], axis=0) > elastic.g.flange_thickness
            stress = corners.von_mises(u[k, :, i])
            largest[i] = max(largest[i], np.max(stress, where=corners.off_head & off_contact, initial=0.0))
    return largest


def yield_force(elastic: CageHalf):
    """Least force of a ball on the wall, over its angle at the pitch circle, under which the half begins to yield [N]."""
    nodes = np.flatnonzero(np.abs(elastic.points[:, 1] - 0.5 * elastic.g.d_m) < 1e-9)
    return elastic.g.yield_flange / stress_per_force(elastic, nodes).max()
