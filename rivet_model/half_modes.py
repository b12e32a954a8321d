"""Free-free modes of a cage half by its solid finite elements, wave by wave, and the residual flexibility beside them:
bearing_model/cage/elastic/half_modes.py.

The half of cage_half.py, of its density, with its part of the rivets as point masses at the seats' bottoms (their
centre of mass is within 0.1 mm of it). Wave n of one pitch meets itself at the cuts, u(far) = turn(2 pi/Z) exp(2 pi i
n/Z) u(near), and Lanczos iteration about a small negative shift finds its lowest modes.  Statics come from the same
elements by another way (the condensed pitch, inertia in balance), so the residual is the difference of two numbers that
differ by the modes that are left out; tests hold it against their sum.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import LinearOperator, eigsh, splu

from bearing_model.cage.elastic.half_modes import (
    EVEN,
    OUT,
    PAD,
    HalfModes,
    Residual,
    frequencies,
    pocket_shapes,
    rivet_shapes,
    spin_load,
)

from . import half_lands, half_loads, half_shape
from .cage_half import BODY, SYMMETRIC

# Octets of modes a pitch, a pair counted as two.  Measured on the 6207: 40 and 48 modes give the same forces and stress
# within 0.3 %, 32 a 99.9 % pocket force 2 % larger.  Below 3.5 a pitch the statics of the modes left out couple the
# joints, above 5.5 vibrations beyond 50 kHz make the step short.
USUAL, FEWEST, MOST = 5 / 9, 4 / 9, 2 / 3
# Modes a pitch that are found at least, about as many again beside them, so that the statics left to the walls do not
# depend on how many the half keeps.
FOUND = 20 / 3
SHIFT = -((2.0 * np.pi * 500.0) ** 2)  # (rad/s)^2 below the rigid motions, whose frequency is 0
TOLERANCE = 1e-6  # of symmetry: shapes whose real or imaginary part should be 0 (observed 1e-9)
APART = 1.1e-3  # m between two places of the wall beyond which point loads need no finer cells than those of the half


@dataclass
class Wave:
    """Modes of harmonic n on pitch 0."""

    n: int
    omega: np.ndarray  # [modes] rad/s
    parity: np.ndarray  # [modes] as HalfModes
    # [dofs, modes] complex amplitudes, mirror images of themselves; conj(shape) M shape = 1/Z, 2/Z of a pair
    shape: np.ndarray


class Places:
    """Loads at the places of a half as combinations of its patterns [patterns, places]; their transposes measure
    displacements.
    """

    def __init__(self, elastic, alone):
        p, patterns = elastic.patterns, elastic.loads.shape[1]
        head = slice(p.head.start, p.head.start + 3)
        # pressure under unit loads of a pad that stays flat [hats, 3]
        spread = alone.own @ alone.lever @ np.linalg.inv(alone.K_0)
        pad = np.zeros((patterns, len(PAD)))
        pad[p.pad, 0], pad[p.pad, 4], pad[p.pad, 5] = spread.T
        pad[p.plane, 1:3] = np.eye(2)
        pad[p.twist, 3] = 1.0
        # the head against its pad, the pad's own bending taken back; then the rivet's loads by this shift
        shift = np.zeros((patterns, 3))
        shift[head] = np.eye(3)
        bent = alone.own @ alone.B_ph
        shift[p.pad] = -spread - bent + spread @ (alone.lever.T @ bent)
        self.rivet_of_shift = np.linalg.inv(alone.clamped)
        self.rivet_of_shift[0] = [1.0 / alone.shortening, 0.0, 0.0]
        self.rivet_of_load = self.rivet_of_shift @ alone.follows @ np.linalg.inv(alone.K_0)
        nodes, near = len(half_loads.nodes(elastic.g)), p.pocket.start
        pocket = np.zeros((patterns, 3 * nodes))
        pocket[near : near + 3 * nodes] = np.eye(3 * nodes)
        self.rivet = np.concatenate([pad, shift @ self.rivet_of_shift.T], axis=1)  # [patterns, PAD and RIVET]
        self.pocket = pocket  # [patterns, nodes and (x, r, t)]
        self.spin = half_loads.centrifugal(elastic)  # [patterns]


class MassiveHalf:
    """The condensed half with its density and its part of the rivets."""

    def __init__(self, elastic):
        self.elastic, p = elastic, elastic.patterns
        self.density, self.rivet = elastic.g.rho_flange, half_shape.rivet_mass(elastic.g)
        self.seat = [p.head.start, p.head.start + 3, p.head.start + 4]
        seat = sp.csc_matrix(elastic.loads[:, self.seat])
        self.M = (self.density * elastic.M + self.rivet * (seat @ seat.T)).tocsc()

    def balance(self, n):
        """Matrix [patterns, patterns] as CyclicSolid.balance, by the inertia of half and rivets."""
        e = self.elastic
        rigid = e._rigid(n)
        inertia = np.zeros((e.loads.shape[1], rigid.shape[1]), dtype=complex)
        inertia[:BODY] = self.density * rigid
        inertia[self.seat] += self.rivet * e.resultants[self.seat] @ rigid
        work = rigid.conj().T @ e.resultants.T
        return np.eye(len(inertia)) - inertia @ np.linalg.solve(work @ inertia, work * e._phase(n))

    def compliance(self, n):
        """Compliance [patterns, patterns] of wave n, balanced by the inertia of half and rivets."""
        balance = self.balance(n)
        return balance.conj().T @ self.elastic.waves[n] @ balance

    def wave(self, n, count):
        """The first `count` elastic modes of wave n: Wave.  Raises ArithmeticError if they are not found or not
        symmetric.
        """
        Z, (square, shape) = self.elastic.Z, wave_modes(self.elastic, self.M, n, count)
        single = 2 * n in (0, Z)
        shape /= np.sqrt(Z if single else 0.5 * Z)
        shape, parity = symmetric(self.elastic, n, shape)
        return Wave(n, np.sqrt(square), parity if single else 0 * parity, shape)


def wave_modes(solid, M, n, count):
    """Squares of the first `count` elastic frequencies of wave n of a CyclicSolid, and shapes [dofs, count] of one
    pitch with conj(shape) M shape = 1.

    Raises ArithmeticError if there is another number of rigid motions.
    """
    T, rigid = cut(solid, n), solid._rigid(n).shape[1]
    K_n, M_n = (T.conj().T @ A @ T for A in (solid.K, M))
    if 2 * n in (0, solid.Z):
        K_n, M_n = K_n.real, M_n.real
    factor = splu((K_n - SHIFT * M_n).tocsc(), **SYMMETRIC)
    inverse = LinearOperator(K_n.shape, factor.solve, dtype=K_n.dtype)
    # of its own, so that the same half gives the same bits
    start = np.random.default_rng(0).standard_normal(K_n.shape[0])
    square, v = eigsh(K_n, count + rigid, M_n.tocsc(), sigma=SHIFT, OPinv=inverse, which="LM", v0=start)
    order = np.argsort(square)
    if not (np.all(np.abs(square[order[:rigid]]) < -1e-3 * SHIFT) and square[order[rigid]] > -1e-3 * SHIFT):
        raise ArithmeticError(
            f"modes of the cage half: the squares of the lowest frequencies of wave {n} are {square[order[: rigid + 1]]} (rad/s)^2"
        )
    shape = T @ v[:, order[rigid:]].astype(complex)
    return square[order[rigid:]], shape / np.sqrt(np.einsum("di,di->i", shape.conj(), M @ shape).real)


def cut(elastic, n):
    """Matrix [dofs, dofs but the far cut's] that gives a pitch the displacements of wave n."""
    near, far = elastic.near, elastic.far
    kept = np.setdiff1d(np.arange(elastic.basis.N), far)
    angle = 2 * np.pi / elastic.Z
    c, s = np.cos(angle), np.sin(angle)
    turn = np.exp(1j * n * angle) * sp.kron(
        sp.eye(len(near) // 3), np.array([[1, 0, 0], [0, c, -s], [0, s, c]]), format="coo"
    )
    rows, columns = np.concatenate([kept, far[turn.row]]), np.concatenate([kept, near[turn.col]])
    T = sp.csc_matrix((np.concatenate([np.ones(len(kept)), turn.data]), (rows, columns)), shape=2 * (elastic.basis.N,))
    return T[:, kept]


def symmetric(elastic, n, shape):
    """Shapes [dofs, modes] with the phase in which each is its own mirror image, and their parities.  ArithmeticError
    if one has none.

    Mirrored in the plane of the rivet, displacements change place with those of the other side; those at the seat's
    bottom and at the pocket's do not.
    """
    p = elastic.patterns
    seat = slice(p.head.start, p.head.start + 5)
    even = np.array([1.0, -1.0, 1.0, 1.0, -1.0])  # x, about r and t, r, t
    chi, radii = half_loads.places(elastic.g)
    bottom = p.pocket.start + 3 * (len(chi) * (len(radii) // 2 + 1) - 1) + np.arange(3)
    at_seat = np.exp(-1j * np.pi * n / elastic.Z) * (elastic.loads[:, seat].T @ shape).T * [1.0, 1e-3, 1e-3, 1.0, 1.0]
    at_bottom = (elastic.loads[:, bottom].T @ shape).T
    both, sign = np.concatenate([at_seat, at_bottom], axis=1), np.concatenate([even, [1.0, 1.0, -1.0]])
    phase = np.exp(-0.5j * np.angle((both**2) @ sign))
    # real or imaginary; its sign is free
    largest = (both * phase[:, None])[np.arange(len(both)), np.argmax(np.abs(both), axis=1)]
    phase *= np.where(largest.real + largest.imag < 0.0, -1.0, 1.0)
    both = both * phase[:, None]
    wrong = np.where(sign > 0.0, np.abs(both.imag), np.abs(both.real)).max(axis=1) / np.abs(both).max(axis=1)
    if wrong.max() > TOLERANCE:
        raise ArithmeticError(
            f"modes of the cage half: wave {n} has a shape that is not symmetric by {wrong.max():.1g} of its largest displacement"
        )
    shape = shape * phase
    return shape, np.where(np.linalg.norm(shape.real, axis=0) > np.linalg.norm(shape.imag, axis=0), 1, -1)


def default_count(Z, octets=USUAL):
    """Modes of a half with Z pitches: as many for each pitch as the 6207 has, in octets.

    >>> [default_count(9, octets) for octets in (FEWEST, USUAL, MOST)]
    [32, 40, 48]
    """
    return 8 * math.ceil(octets * Z - 1e-9)


def check_count(count, Z):
    """Raises ValueError for a number of modes outside the range in which halves were measured."""
    low, high = default_count(Z, FEWEST), default_count(Z, MOST)
    if isinstance(count, bool) or not isinstance(count, int) or not low <= count <= high:
        raise ValueError(f"modes = {count!r}: a whole number from {low} to {high} is needed for Z = {Z}")


def waves(massive, count, progress=lambda done, total: None):
    """Waves 0...Z//2 with the first `count` modes of the half and about as many again, pairs counted as two."""
    Z = massive.elastic.Z
    each, found = np.full(Z // 2 + 1, 4 + -(-4 * count // (3 * Z))), [None] * (Z // 2 + 1)
    while True:
        for n in range(len(each)):
            if found[n] is None:
                found[n] = massive.wave(n, int(each[n]))
                progress(sum(w is not None for w in found), len(found))
        order = np.sort(np.concatenate([np.repeat(w.omega, 1 if 2 * w.n in (0, Z) else 2) for w in found]))
        short = [n for n, w in enumerate(found) if len(order) < count or w.omega[-1] <= order[count - 1]]
        if not short:
            return found
        for n in short:
            each[n] += 3
            found[n] = None


def half_modes(elastic, alone, count, progress=lambda done, total: None):
    """HalfModes of a condensed half (half_loads.elastic_half) with its pads (JointAlone), without the joints' law: the
    first `count` modes or one less, and all that were found.

    Raises ArithmeticError if they cannot be found.
    """
    Z, massive, places = elastic.Z, MassiveHalf(elastic), Places(elastic, alone)
    everything = np.column_stack([places.rivet, places.pocket, places.spin])
    rims, rows, static = rim_means(elastic), [], []
    for wave in waves(massive, max(count, round(FOUND * Z)), progress):
        u = everything.T @ (elastic.loads.T @ wave.shape)  # [places, modes]
        rim = rims[wave.n] @ wave.shape
        land = half_lands.land_shapes(elastic, wave)
        rows += [(wave.omega[i], wave.n, wave.parity[i], u[:, i], rim[:, i], land[i]) for i in range(len(wave.omega))]
        static.append(everything.T @ massive.compliance(wave.n) @ everything)
    static = np.stack(static)
    rows.sort(key=lambda row: row[0])
    for omega, n, parity, u, *_ in rows:
        static[n] -= (1.0 if parity else 0.5) * Z / omega**2 * np.outer(u, u.conj())
    found = HalfModes(
        Z=Z,
        chi=half_loads.places(elastic.g)[0],
        radii=half_loads.places(elastic.g)[1],
        omega=np.array([row[0] for row in rows]),
        harmonic=np.array([row[1] for row in rows]),
        parity=np.array([row[2] for row in rows]),
        residual=residual(elastic, places, elastic.circulant(static)),
        law=None,
        land_residual=None,
        **amplitudes(Z, half_loads.shape(elastic.g), rows),
    )
    return fewer(found, count, wall_normals(elastic)), found


def with_law(modes, alone):
    """HalfModes with the law of their joints around the residual stiffness, and with the residual motions of the joints by the
    land's film; alone: JointAlone.
    """
    R = joint_residual(modes)
    # the other elements are 0: mirroring in the rivet's plane changes their sign
    even = np.multiply.outer(EVEN[OUT], EVEN[OUT]) > 0.0
    stiffness = np.linalg.inv(np.where(even, 0.5 * (R + R.T), 0.0))
    modes = replace(modes, law=half_loads.make_law_of_modes(alone, stiffness))
    return replace(modes, land_residual=half_lands.land_residual(modes, alone, alone.elastic))


def amplitudes(Z, nodes, rows):
    """The shapes of HalfModes from displacements of pitch 0 at all places; nodes: half_loads.shape."""
    n, u, rim, land = (np.array([row[i] for row in rows]) for i in (1, 3, 4, 5))
    at_rivet = u[:, : len(EVEN)] * np.exp(-1j * np.pi * n / Z)[:, None]
    at_rivet = np.where(EVEN > 0.0, at_rivet.real, at_rivet.imag)
    at_pocket = u[:, len(EVEN) : -1].reshape(-1, *nodes, 3)
    spin = np.where((n == 0) & (np.array([row[2] for row in rows]) == 1), Z * u[:, -1].real, 0.0)
    return {
        "pocket": np.stack([at_pocket.real, at_pocket.imag], axis=-1),
        "pad": at_rivet[:, : len(PAD)],
        "rivet": at_rivet[:, len(PAD) :],
        "rim": rim.real,
        "land": land,
        "spin": spin,
    }


def residual(elastic, places, C):
    """Residual from the compliances [pitch, places, places] that modes leave: displacements by loads on pitch 0."""
    pads, nodes, shape = len(PAD), len(half_loads.nodes(elastic.g)), half_loads.shape(elastic.g)
    pocket = C[:, : len(EVEN), len(EVEN) : -1].reshape(elastic.Z, len(EVEN), nodes, 3)
    walls = C[0, len(EVEN) : -1, len(EVEN) : -1].reshape(shape[0] if len(shape) > 1 else 1, shape[-1], 3, -1)
    rivet = C[:, pads : len(EVEN), :pads].copy()
    rivet[0][:, [0, 4, 5]] += places.rivet_of_load  # this part is in the law of the joint
    return Residual(
        pad=C[:, :pads, :pads],
        rivet=rivet,
        pocket=pocket.transpose(2, 0, 1, 3).reshape(*shape, elastic.Z, len(EVEN), 3),
        spin=C[:, : len(EVEN), -1].sum(axis=0),
        wall=np.reshape(
            [
                wall_compliance(elastic, rows.reshape(shape[-1], 3, -1, shape[-1], 3)[:, :, i], i)
                for i, rows in enumerate(walls)
            ],
            shape,
        ),
    )


def wall_compliance(elastic, C, line=0):
    """Compliance [nodes] along the normal under the contact, without the indentation of the half-space that Hertz's
    formula counts.

    C [nodes, 3, nodes, 3]: of the wall at the nodes of one radius, the `line`-th.  Indentation is the displacement
    of the half-space by a unit load at a distance s, (1 - nu^2)/(pi E s); the rest of the compliance between two places varies
    slowly, so that of the neighbours on both sides of a node stands for its own (of the ends: the nearest one's).
    """
    g, (chi, radii) = elastic.g, half_loads.places(elastic.g)
    radius = radii[line] if len(radii) else 0.5 * g.d_m
    normal = elastic.wall.normal(chi, np.full(len(chi), radius))
    between = np.einsum("ia,iajb,jb->ij", normal, C, normal)
    place, found = [], []
    for i in range(len(chi) - 2):
        j = next(
            j
            for j in range(i + 2, len(chi))
            if half_shape.pocket_radius(g) * (chi[j] - chi[i]) > APART or j == len(chi) - 1
        )
        s = 2.0 * half_shape.pocket_radius(g) * np.sin(0.5 * (chi[j] - chi[i]))
        place.append(0.5 * (chi[i] + chi[j]))
        found.append(between[i, j] - (1.0 - g.nu_flange**2) / (np.pi * g.E_flange * s))
    return np.interp(chi, place, found)


def rim_means(elastic):
    """Rows [n, outer and inner, dofs] whose product with a shape of wave n is the mean of u_r exp(-i n theta) over the
    rim, facets by their middles.
    """
    g, mesh = elastic.g, elastic.basis.mesh
    facets = mesh.boundary_facets()
    corners = mesh.p[:, mesh.facets[:, facets]]  # [3, a facet's corners, facets]
    area = np.linalg.norm(np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1], axis=0), axis=0)
    result = np.zeros((elastic.Z // 2 + 1, 2, elastic.basis.N), dtype=complex)
    for side, diameter in enumerate((g.cage_outer_diameter, g.cage_inner_diameter)):
        rim = np.flatnonzero(np.all(np.abs(np.hypot(corners[1], corners[2]) - 0.5 * diameter) < 1e-9, axis=0))
        along_y, along_z = elastic.basis.facet_dofs[1:, facets[rim]]
        theta = np.arctan2(elastic.x[2], elastic.x[1])[along_y]
        weight = area[rim] / area[rim].sum() * np.exp(-1j * np.outer(np.arange(len(result)), theta))
        result[:, side, along_y] = weight * np.cos(theta)
        result[:, side, along_z] = weight * np.sin(theta)
    return result


def wall_normals(elastic):
    """Directions of a ball's force on the wall at the nodes of the tables [..., 3]."""
    at = half_loads.nodes(elastic.g).T
    return elastic.wall.normal(*at).reshape(*half_loads.shape(elastic.g), 3)


def fewer(modes, n, normal=None):
    """The first modes, n of them or one less where a pair would be parted; the residual takes the statics of the
    others, and a law would belong to another residual.

    n: 0 leaves none; normal: wall_normals, None: those of a machined pocket.  Raises ValueError if there are not so many.
    """
    total = int(modes.count.sum())
    if not 0 <= n <= total:
        raise ValueError(f"modes = {n}: a number from 0 to {total} is needed")
    kept = int(np.searchsorted(np.cumsum(modes.count), n, side="right"))
    normal = np.stack([np.sin(modes.chi), 0.0 * modes.chi, np.cos(modes.chi)], axis=1) if normal is None else normal
    arrays = {
        name: getattr(modes, name)
        for name in ("omega", "harmonic", "parity", "pocket", "pad", "rivet", "rim", "land", "spin")
    }
    rest = replace(modes, **{name: values[kept:] for name, values in arrays.items()})
    return replace(
        modes,
        **{name: values[:kept] for name, values in arrays.items()},
        residual=softer(modes.residual, rest, normal),
        law=None,
        land_residual=None,
    )


def joint_residual(modes):
    """Compliance [3, 3] between the pads of one joint, out of the plane, that the modes leave; m/N, rad/N, rad/(N.m)."""
    return modes.residual.pad[0][np.ix_(OUT, OUT)]


def softer(residual, modes, normal):
    """The residual with the static displacements of modes; normal [chi, 3] of the wall at its nodes."""
    compliance = 1.0 / frequencies(modes) ** 2
    at, wall = rivet_shapes(modes), pocket_shapes(modes)[:, 0, ..., 0, :]  # [n, Z, 9], pocket 0, t > 0 [n, chi, 3]
    own = np.einsum("nka,nb,n->kab", at, at[:, 0, : len(PAD)], compliance)
    return Residual(
        pad=residual.pad + own[:, : len(PAD)],
        rivet=residual.rivet + own[:, len(PAD) :],
        pocket=residual.pocket + np.einsum("nka,n...f,n->...kaf", at, wall, compliance),
        spin=residual.spin + np.einsum("na,n,n->a", at[:, 0], spin_load(modes), compliance),
        wall=residual.wall + np.einsum("n...,n->...", np.einsum("n...f,...f->n...", wall, normal) ** 2, compliance),
    )
