"""A ribbon half beside CalculiX, an independent finite-element program (Debian: calculix-ccx): the whole ring by finer
elements of its own, free-free modes and two self-equilibrated loads.  Slow, and skipped where the program is missing.
"""

import re
import shutil
import subprocess

import numpy as np
import pytest
from ribbons import RIBBONS, bare
from scipy.spatial import cKDTree
from skfem import ElementHex2

from rivet_model import half, half_loads, half_modes, half_strength

CCX = shutil.which("ccx")
pytestmark = [pytest.mark.slow, pytest.mark.skipif(CCX is None, reason="CalculiX (ccx) is not installed")]
CORNERS = [1, 5, 7, 4, 0, 3, 6, 2]  # of scikit-fem's hexahedron in CalculiX's order
EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
FINER = half.HalfMesh(5, 2, 1, 1, 4, 5, 1)


class WholeRing:
    """All pitches as bricks with 20 nodes: places [nodes, 3] in mm and cells [cells, 20]."""

    def __init__(self, g, size):
        self.g, mesh = g, half.pitch_mesh(g, size)
        basis = half.solid_basis(mesh, ElementHex2())
        edge = {tuple(pair): i for i, pair in enumerate(mesh.edges.T.tolist())}
        corners = mesh.t[CORNERS].T
        middle = np.array([[edge[tuple(sorted((c[a], c[b])))] for a, b in EDGES] for c in corners.tolist()])
        cells = np.hstack([basis.nodal_dofs[0, corners], basis.edge_dofs[0, middle]])
        pitch, places, all_cells = 1e3 * basis.doflocs.T, [], []
        for k in range(g.Z):
            c, s = np.cos(2 * np.pi * k / g.Z), np.sin(2 * np.pi * k / g.Z)
            places.append(pitch @ np.array([[1.0, 0.0, 0.0], [0.0, c, s], [0.0, -s, c]]))
            all_cells.append(cells + k * len(pitch))
        places, cells = np.concatenate(places), np.concatenate(all_cells)
        _, first, same = np.unique(np.round(places, 6), axis=0, return_index=True, return_inverse=True)
        cells = same.ravel()[cells]
        used, cells = np.unique(cells, return_inverse=True)
        self.nodes, self.cells = places[first][used], cells.reshape(-1, 20)

    def at(self, place):
        """Number from 1 of the node at a place [mm]."""
        distance, i = cKDTree(self.nodes).query(place)
        assert distance < 1e-4, f"no node at {place}"
        return int(i) + 1

    def deck(self, step, fixed=""):
        """Input of the program, in mm, N, t."""
        lines = ["*NODE, NSET=ALL"] + [f"{i + 1}, {x:.9g}, {y:.9g}, {z:.9g}" for i, (x, y, z) in enumerate(self.nodes)]
        lines.append("*ELEMENT, TYPE=C3D20, ELSET=HALF")
        for i, cell in enumerate(self.cells + 1):
            numbers = [str(n) for n in cell]
            lines += [f"{i + 1}, {', '.join(numbers[:10])},", ", ".join(numbers[10:])]
        lines += ["*MATERIAL, NAME=STEEL", "*ELASTIC", f"{1e-6 * self.g.E_flange:.9g}, {self.g.nu_flange}"]
        lines += ["*DENSITY", f"{1e-12 * self.g.rho_flange:.9g}", "*SOLID SECTION, ELSET=HALF, MATERIAL=STEEL"]
        return "\n".join([*lines, *([f"*BOUNDARY\n{fixed}"] if fixed else []), step, "*END STEP", ""])

    def run(self, folder, step, fixed=""):
        """The program's .dat file."""
        (folder / "half.inp").write_text(self.deck(step, fixed))
        done = subprocess.run([CCX, "-i", "half"], cwd=folder, capture_output=True, text=True, timeout=1500)
        assert (folder / "half.dat").is_file(), done.stdout[-2000:]
        return (folder / "half.dat").read_text()

    def displacements(self, folder, loads):
        """[nodes, 3] in mm under forces {node: vector [N]} in equilibrium, three nodes held without reaction."""
        a, b, c = (self.at([1e3 * self.g.cage_half_width, y, z]) for y, z in self.tops())
        fixed = f"{a}, 1, 3\n{b}, 1\n{b}, 3\n{c}, 1"
        forces = "\n".join(f"{n}, {i + 1}, {f:.9g}" for n, v in loads.items() for i, f in enumerate(v) if f)
        text = self.run(folder, f"*STEP\n*STATIC\n*CLOAD\n{forces}\n*NODE PRINT, NSET=ALL\nU", fixed)
        rows = re.findall(r"^\s*(\d+)((?:\s+[-+.\dE]+){3})\s*$", text, re.MULTILINE)
        result = np.zeros((len(self.nodes), 3))
        for n, values in rows:
            result[int(n) - 1] = [float(v) for v in values.split()]
        return result

    def tops(self):
        """(y, z) over the middles of the pockets 0, 2, 4 on the outside of the sheet [mm]."""
        angle = 2 * np.pi / self.g.Z * np.array([0, 2, self.g.Z // 2])
        return 0.5e3 * self.g.d_m * np.stack([np.cos(angle), np.sin(angle)], axis=1)


@pytest.fixture(scope="module", params=["6309"])
def both(request):
    g = bare(RIBBONS[request.param])
    return g, WholeRing(g, FINER), half_loads.elastic_half(g)


def test_frequencies(both, tmp_path):
    """The first sixteen elastic modes: within 2 %, the issue's line; the harmonics come in the same order."""
    g, ring, elastic = both
    text = ring.run(tmp_path, "*STEP\n*FREQUENCY, SOLVER=ARPACK\n22")
    hertz = [float(row.split()[3]) for row in re.findall(r"^\s+\d+(?:\s+[-+.\dE]+){4}\s*$", text, re.MULTILINE)][:22]
    other = np.array([f for f in hertz if f > 50.0][:14])
    assert len(other) == 14, text[:500]
    massive = half_modes.MassiveHalf(elastic)
    own = []
    for n in range(g.Z // 2 + 1):
        square, _ = half_modes.wave_modes(elastic, massive.M, n, 5)
        own += list(np.repeat(np.sqrt(square) / (2 * np.pi), 1 if 2 * n in (0, g.Z) else 2))
    own = np.sort(own)[: len(other)]
    print(np.round(own, 1), np.round(other, 1), own / other - 1.0)
    np.testing.assert_allclose(own, other, rtol=0.02)


def von_mises(rows):
    """Von Mises stress of rows (xx, yy, zz, xy, xz, yz)."""
    xx, yy, zz, xy, xz, yz = rows.T
    return np.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3.0 * (xy**2 + xz**2 + yz**2))


def spread(ring, place, force):
    """Forces on the nodes nearest to a place [mm] with the resultant and the moment of one force there."""
    near = cKDTree(ring.nodes).query(place, k=8)[1]
    shares = np.linalg.lstsq(np.vstack([np.ones(8), ring.nodes[near].T]), np.append(1.0, place), rcond=None)[0]
    return {int(n) + 1: share * np.asarray(force) for n, share in zip(near, shares, strict=True)}


def pushed(ring, folder, place, forces, large=False):
    """Displacements [nodes, 3] in mm and the largest stress in MPa, off heads and contact, under forces {node: vector [N]}
    about a place of pocket 0 with the lands held under the heads.
    """
    g, (_, y, z) = ring.g, ring.nodes.T

    def beside_rivet(y, z):
        angle = 2.0 * np.pi / g.Z * (np.floor(np.arctan2(z, y) * g.Z / (2.0 * np.pi)) + 0.5)
        return np.hypot(y - 0.5e3 * g.d_m * np.cos(angle), z - 0.5e3 * g.d_m * np.sin(angle))

    head, sheet = 0.5e3 * g.head_diameter, 1e3 * g.flange_thickness
    under = np.flatnonzero((np.abs(ring.nodes[:, 0]) < 1e-6) & (beside_rivet(y, z) < head + 1e-6))
    fixed = "\n".join(f"{n + 1}, 1, 3" for n in under)
    step = "*STEP, NLGEOM, INC=100\n*STATIC\n0.5, 1.0" if large else "*STEP\n*STATIC"
    loads = "\n".join(f"{n}, {i + 1}, {f:.9g}" for n, v in forces.items() for i, f in enumerate(v))
    prints = "*NODE PRINT, NSET=ALL, FREQUENCY=100\nU\n*EL FILE, FREQUENCY=100\nS"
    text = ring.run(folder, f"{step}\n*CLOAD\n{loads}\n{prints}", fixed)
    number = r"((?:\s+[-+.\dE]+){%d})\s*$"
    u = np.zeros_like(ring.nodes)
    for n, row in re.findall(r"^\s*(\d+)" + number % 3, text.rpartition("displacements")[2], re.MULTILINE):
        u[int(n) - 1] = [float(v) for v in row.split()]
    rows = (folder / "half.frd").read_text().rpartition(" -4  STRESS")[2].partition("\n -3")[0].splitlines()
    rows = [row for row in rows if row.startswith(" -1")]  # the number in 10 columns, six stresses in 12 each
    at = ring.nodes[[int(row[3:13]) - 1 for row in rows]]
    stress = von_mises(np.array([[float(row[i : i + 12]) for i in range(13, 85, 12)] for row in rows]))
    off = (beside_rivet(*at[:, 1:].T) > head + sheet) & (np.linalg.norm(at - place, axis=1) > sheet)
    return u, stress[off].max()


def test_strength(both, tmp_path):
    """The largest stress one sheet off heads and contact, under the force that gives most of it: within 10 % of the other
    program's nodal stress.  Under twice the force that begins to yield, displacements by large
    deformation are the linear ones within 1 % (1.1 % under five times it): the sheet yields long before small
    displacements end.
    """
    g, ring, elastic = both
    nodes = np.flatnonzero(np.abs(elastic.points[:, 1] - 0.5 * g.d_m) < 1e-9)
    each = 1e-6 * half_strength.stress_per_force(elastic, nodes)
    own, worst = each.max(), nodes[np.argmax(each)]
    place, normal = 1e3 * elastic.point_places()[worst], elastic.wall.normal(*elastic.points[worst])
    linear, found = pushed(ring, tmp_path, place, spread(ring, place, normal))
    print(each, own, found, own / found - 1.0)
    assert own == pytest.approx(found, rel=0.10)
    force = 2e-6 * g.yield_flange / own
    large, _ = pushed(ring, tmp_path, place, spread(ring, place, force * normal), large=True)
    node = np.argmax(np.where(np.linalg.norm(ring.nodes - place, axis=1) > 3.0, linear @ normal, 0.0))
    print(force, large[node] @ normal / (force * (linear[node] @ normal)) - 1.0)
    assert large[node] @ normal == pytest.approx(force * (linear[node] @ normal), rel=0.01)


def column(elastic, node, force, pitch):
    """Patterns of a force (x, r, t) at a node of the tables on the wall of pocket `pitch` [Z, patterns]."""
    result, first, count = (
        np.zeros((elastic.Z, elastic.loads.shape[1])),
        elastic.patterns.pocket.start,
        len(elastic.points),
    )
    result[pitch, first + 3 * node + np.arange(3)] = np.asarray(force)
    result[pitch, first + 3 * (count + node) + np.arange(3)] = np.asarray(force)
    return result


def moved(elastic, loads):
    """Displacements of all patterns [Z, patterns] under patterns [Z, patterns] in equilibrium."""
    C = elastic.circulant(elastic.waves)
    relative = (np.arange(elastic.Z)[:, None] - np.arange(elastic.Z)) % elastic.Z
    return np.einsum("kjpq,jq->kp", C[relative], loads)


def test_static_displacements(both, tmp_path):
    """Pockets pulled apart across the ring: the diameter 90 degrees away; lands bent out of the plane by forces along the
    axis: heads beside it; within 2 %.
    """
    g, ring, elastic = both
    Z, quarter = g.Z, g.Z // 4
    bottom = next(i for i, (a, r) in enumerate(elastic.points) if a > 1.57 and abs(r - g.d_m / 2) < 1e-9)
    pole = 1e3 * (g.cage_half_width - g.flange_thickness)

    def at_pole(j):
        angle = 2 * np.pi * j / Z
        return ring.at([pole, 0.5e3 * g.d_m * np.cos(angle), 0.5e3 * g.d_m * np.sin(angle)])

    first = elastic.patterns.pocket.start + 3 * bottom
    u = moved(elastic, column(elastic, bottom, [0.0, 1.0, 0.0], 0) + column(elastic, bottom, [0.0, 1.0, 0.0], Z // 2))
    own = u[quarter, first + 1] + u[quarter + Z // 2, first + 1]
    other = ring.displacements(tmp_path, {at_pole(0): [0.0, 1.0, 0.0], at_pole(Z // 2): [0.0, -1.0, 0.0]})
    found = 1e-3 * (other[at_pole(quarter) - 1, 2] - other[at_pole(quarter + Z // 2) - 1, 2])
    print(own, found, own / found - 1.0)
    assert own == pytest.approx(found, rel=0.02)

    signs = {0: 1.0, quarter: -1.0, Z // 2: 1.0, 3 * quarter: -1.0}
    u = moved(elastic, sum(column(elastic, bottom, [s, 0.0, 0.0], j) for j, s in signs.items()))
    head = elastic.patterns.head.start
    own = sum(s * u[j, head] for j, s in signs.items())
    other = ring.displacements(tmp_path, {at_pole(j): [s, 0.0, 0.0] for j, s in signs.items()})
    found = 0.0
    for j, s in signs.items():
        angle = 2 * np.pi * (j + 0.5) / Z
        axis = 0.5e3 * g.d_m * np.array([np.cos(angle), np.sin(angle)])
        near = np.hypot(*(ring.nodes[:, 1:] - axis).T)
        under = (np.abs(ring.nodes[:, 0] - 1e3 * g.flange_thickness) < 1e-6) & (
            np.abs(near - 0.5e3 * g.head_diameter) < 1e-4
        )
        found += 1e-3 * s * other[under, 0].mean()
    print(own, found, own / found - 1.0)
    assert own == pytest.approx(found, rel=0.02)
