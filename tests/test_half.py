"""The cage half: its mass and limits, its elastic answer against closed forms, other formulations and finer elements."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.sparse.linalg import splu
from skfem import ElementHex1
from whole_half import SMALL, whole

from bearing_model.cage.two_half import half_path
from bearing_model.rivet import rivet_table
from rivet_model import cage_half, half, half_loads, half_shape, joint_contact
from rivet_model.geometry import Geometry

G = Geometry()
BARE = replace(G, rho_rivet=1e-9)  # the bronze alone: rivets without mass
STEPS = np.deg2rad(np.arange(0.0, 91.0, 5.0))


def wall_points(angles, g=G):
    return np.stack([angles, np.full(len(angles), g.d_m / 2)], axis=1)


@pytest.fixture(scope="module")
def coarse():
    """Coarse half with further points at the steps of 5 degrees, then a Hertz patch about 30 degrees, then the same
    place nearer and farther out.
    """
    patch, _ = hertz_patch(np.deg2rad(30.0))
    radial = np.stack([np.full(2, np.deg2rad(30.0)), G.d_m / 2 + np.array([-0.1e-3, 0.1e-3])], axis=1)
    elastic = half_loads.elastic_half(G, half.COARSE, np.concatenate([wall_points(STEPS), patch, radial]))
    return elastic, half_loads.JointAlone(elastic)


def hertz_patch(angle, a=0.9e-3, b=0.16e-3, count=5):
    """Points and weights of Hertz's pressure over an ellipse with half axes a along the wall (200 N in the 6207's
    pocket) and b along the pocket's axis.
    """
    nodes, weights = np.polynomial.legendre.leggauss(count)
    u, v = np.meshgrid(nodes, nodes, indexing="ij")
    pressure = np.sqrt(np.clip(1.0 - u**2 - v**2, 0.0, None)) * np.outer(weights, weights)
    points = np.stack([angle + a / half_shape.pocket_radius(G) * u.ravel(), G.d_m / 2 + b * v.ravel()], axis=1)
    return points, pressure.ravel() / pressure.sum()


# Geometry -------------------------------------------------------------------------------------------------------------


def mesh_inertia(size, density):
    """Mass, centre of mass and moments of inertia of the bronze half by its mesh."""
    basis = half.solid_basis(half.pitch_mesh(G, size), ElementHex1())
    x, y, z = np.asarray(basis.global_coordinates())
    dm = G.Z * density * basis.dx
    m, x_c, J_p = dm.sum(), (dm * x).sum() / dm.sum(), (dm * (y**2 + z**2)).sum()
    return half_shape.Inertia(m, x_c, J_p, 0.5 * J_p + (dm * x**2).sum() - m * x_c**2)


def test_mass_and_inertia_of_the_mesh():
    """Bronze by the mesh and by the drawing's integrals: within 0.1 % on coarse cells, too (observed 1.4e-4; the
    shipped mesh 3e-5).
    """
    bronze = half_shape.half_inertia(BARE)
    for size in (half.COARSE, half.HalfMesh()):
        np.testing.assert_allclose(mesh_inertia(size, G.rho_flange), bronze, rtol=1e-3)


def test_inertia_of_the_whole():
    """Bronze and rivets together: masses add; the polar moment exceeds m d_m2/4 as the ring's section and the rivets
    say (to 2 %: the pockets).
    """
    both, bronze = half_shape.half_inertia(G), half_shape.half_inertia(BARE)
    assert both.m - bronze.m == pytest.approx(G.Z * half_shape.rivet_mass(G), rel=1e-9)
    mean_square = (G.cage_outer_diameter**2 + G.cage_inner_diameter**2) / 8
    assert both.J_p == pytest.approx(both.m * mean_square, rel=0.02)
    assert both.J_p < 2.0 * both.J_t  # a body of finite width: J_t = J_p/2 + m <(x - x_c)^2>


def test_inertia_of_a_plain_ring():
    """Tiny pockets, holes and rivets leave a ring: m = rho pi (r_o^2 - r_i^2) w, x_c = w/2, J_t = m ((r_o^2 + r_i^2)/4
    + w^2/12) (to 1e-6).
    """
    names = (
        "ball_diameter",
        "pocket_clearance",
        "shank_diameter",
        "head_diameter",
        "head_height",
        "seat_diameter",
        "relief_radius",
    )
    tiny = dict.fromkeys(names, 1e-9)
    g = SimpleNamespace(**(vars(G) | tiny))
    r_i, r_o, w = g.cage_inner_diameter / 2, g.cage_outer_diameter / 2, g.cage_half_width
    m = G.rho_flange * np.pi * (r_o**2 - r_i**2) * w
    expected = m, w / 2, m * (r_o**2 + r_i**2) / 2, m * ((r_o**2 + r_i**2) / 4 + w**2 / 12)
    np.testing.assert_allclose(half_shape.half_inertia(g), expected, rtol=1e-6)


@pytest.mark.parametrize(
    ("change", "key"),
    [
        ({"cage_half_width": 2.2e-3}, "cage_half_width"),
        ({"cage_half_width": 5.7e-3}, "cage_half_width"),
        ({"seat_diameter": 2.5e-3}, "head_diameter"),
        ({"Z": 13}, "seat_diameter"),
        ({"cage_inner_diameter": 51e-3}, "cage_inner_diameter"),
        ({"cage_outer_diameter": 56e-3}, "cage_outer_diameter"),
    ],
)
def test_limits_name_what_cannot_be_built(change, key):
    """A bridge too narrow for the head, no seat, no web: named with its value; the default passes."""
    half_shape.check_half(G)
    g = Geometry(**change)
    with pytest.raises(ValueError, match=f"geometry: {key} = {getattr(g, key):g}: no "):
        half_shape.check_half(g)


# Elasticity -----------------------------------------------------------------------------------------------------------


def plain_ring(R, thickness, width, Z, cells=16):
    """A ring of rectangular section as a cyclic solid with its body patterns alone."""
    blocks = half.Blocks()
    x, r, theta = (
        np.linspace(a, b, 2 * n + 1)
        for a, b, n in ((0, width, 2), (R - thickness / 2, R + thickness / 2, 2), (0, 2 * np.pi / Z, cells))
    )
    blocks.add(np.stack(np.meshgrid(x - width / 2, r, theta, indexing="ij"), axis=-1))
    ring = cage_half.CyclicSolid(blocks.mesh(), Z, G.E_flange, G.nu_flange)
    ring.condense(ring.body_loads())
    return ring


def test_free_ring():
    """Waves of a thin ring (R/thickness 50) against the formulas of rings: stretching, bending in and out of its plane
    with torsion.

    Body forces q_r, q_t per length in the frame of each place, wave m: u_r = (q_r - i q_t/m) R4/(E I (m2 - 1)2); along
    x: u_x = q R4 (m2 + E I/(G J))/(E I m2 (m2 - 1)2).  The pitches' patterns turn by steps, of which wave m has the
    part sinc(m/Z), in load and answer. Observed 0.4 % with torsion, else 0.18 %: shear, curvature and elements.
    """
    R, t, Z = 25e-3, 0.5e-3, 12
    E, nu, A = G.E_flange, G.nu_flange, t * t
    ring = plain_ring(R, t, t, Z)
    I, J = t**4 / 12, 0.1406 * t**4  # square section
    length, H = 2 * np.pi * R / Z, ring.waves

    def u(m, displacement, load):
        """Amplitude of a mean displacement over the mass per unit force and length."""
        return displacement.conj() @ H[m][:7, :7] @ load / (A * length * A) / np.sinc(m / Z) ** 2

    e = np.eye(7, dtype=complex)
    assert u(0, e[6], e[6]).real == pytest.approx(R * (A * R) * R**2 / (E * A) / A, rel=5e-4)  # spin: q = A R
    for m in (2, 3):
        bending = R**4 / (E * I * (m**2 - 1) ** 2)
        assert u(m, e[0], e[0]).real == pytest.approx(bending * (m**2 + 2 * (1 + nu) * I / J) / m**2, rel=5e-3)
        assert u(m, e[6] / R, e[6] / R).real == pytest.approx(bending, rel=3e-3)
        assert u(m, e[3] / R, e[6] / R) == pytest.approx(1j / m * bending, rel=3e-3)


@pytest.mark.slow
def test_cyclic_half_equals_the_whole_half():
    """Rows under a pocket force and under the centrifugal load, by waves and by one sparse solution of all pitches,
    pads held by stiff springs.

    Observed 2e-5 of the row's largest: springs of 1e13 N/m give, and the inertia balances free motions; of a hundredth of
    it rounding leaves 1e-3.
    """
    elastic = cage_half.CageHalf(SMALL, half.COARSE, wall_points(np.deg2rad([12.0]), SMALL))
    alone, p, Z = half_loads.JointAlone(elastic), elastic.patterns, SMALL.Z
    assert np.array_equal(elastic.component, np.arange(elastic.basis.N) % 3)
    to_whole = whole(elastic)
    K = sum(T @ (elastic.K + 1e7 * elastic.M) @ T.T for T in to_whole)
    loads = np.column_stack(
        [
            to_whole[0] @ (0.5 * elastic.loads[:, p.pocket][:, :3]),
            sum(T @ elastic.loads[:, cage_half.SPIN] for T in to_whole),
        ]
    )
    rows = half_loads.path_at(elastic, alone, 0)
    rows[:, :3] += np.moveaxis(half_loads.rigid_rows(elastic, elastic.point_places()[0]), 0, -1)
    spin = half_loads.uniform_rows(elastic, alone, np.eye(elastic.loads.shape[1])[cage_half.SPIN])
    rows = np.concatenate([rows, np.tile(spin, (Z, 1))[:, :, None]], axis=2)
    for chosen, held, lever in (((0, 3, 4), p.pad, alone.lever), ((1, 2), p.plane, np.eye(2))):
        B = sp.hstack([sp.csr_matrix(T @ elastic.loads[:, held]) for T in to_whole]).tocsc()
        u = splu((K + 1e13 * (B @ B.T)).tocsc(), **cage_half.SYMMETRIC).solve(loads)
        found = np.einsum("khf,hl->klf", 1e13 * (B.T @ u).reshape(Z, -1, 4), lever)
        for load in range(4 if held == p.pad else 3):  # in the plane the centrifugal load is not opposed
            expected = rows[:, chosen, load]
            assert np.all(np.abs(found[..., load] - expected) < 1e-4 * np.abs(expected).max(axis=0) + 1e-12)


@pytest.mark.slow
def test_pair_stiffness_of_the_whole_half():
    """Separation of the halves' bodies, closed and open: waves, condensation and contact beside one sparse solution of
    all pitches with pads and rivets.

    The pads' hats that touch are held by stiff springs, the heads by springs of half a rivet that are too short by the
    preload.  No compliance is in one of the two and not in the other: within 1e-6 (observed 3e-8).
    """
    rivet = joint_contact.rivet_compliance(SMALL)
    elastic = cage_half.CageHalf(SMALL, half.COARSE)
    contact, p, to_whole = joint_contact.JointContact(elastic, rivet, alike=True), elastic.patterns, whole(elastic)
    K = sum(T @ (elastic.K + 1e5 * elastic.M) @ T.T for T in to_whole)
    springs, column, P = 1.0 / np.array(rivet)[[0, 1, 1]], np.zeros(elastic.loads.shape[1]), 20.0
    column[0] = 1.0 / elastic.resultants[0, 0]
    body, heads = sum(T @ (elastic.loads @ column) for T in to_whole), elastic.loads[:, contact.head]
    H = sp.hstack([sp.csr_matrix(T @ heads) for T in to_whole]).tocsc()
    held = H @ sp.diags(np.tile(springs, SMALL.Z)) @ H.T
    for first, last, expected in zip((-5.0, 60.0), (5.0, 80.0), half_loads.pair_stiffness(contact, P), strict=True):
        separation = []
        for N in (first, last):
            touching = contact.solve(P, (contact.loads(column=N * column)[0], np.array([N]))).pressure[0] > 0.0
            pads = elastic.loads[:, p.pad][:, touching]
            B = sp.hstack([sp.csr_matrix(T @ pads) for T in to_whole]).tocsc()
            load = N * body - H @ np.tile(springs * contact.e * P, SMALL.Z)
            u = splu((K + held + 1e13 * (B @ B.T)).tocsc(), **cage_half.SYMMETRIC).solve(load)
            separation.append(2.0 * (body @ u) / SMALL.Z)
        found = (last - first) / (separation[1] - separation[0])
        assert found == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("shank", [1.5e-3, 1.9e-3, 2e-3])
def test_the_pad_takes_what_the_head_brings(shank):
    """Force and moments of a unit at the head come out at the held pad however narrow the seat, 0.3, 0.1 or 0.05 mm;
    neighbours take 2 % (observed).

    Lost facets of a narrow seat would leave a pressure that does not balance: they made 55 % of a moment.
    """
    alone = half_loads.JointAlone(half_loads.elastic_half(replace(G, shank_diameter=shank), half.COARSE))
    length = np.array([1.0, 1e-3, 1e-3])  # moments per mm
    taken = alone.lever.T @ alone.own @ alone.B_ph * length / length[:, None]
    np.testing.assert_allclose(taken, np.eye(3), atol=0.03)


def test_bonded_rows_balance(coarse):
    """Joints carry the force and the moments of a pocket force less what inertia takes, whatever the angle.

    Observed 2e-5: the mesh's wall lies 0.1 um beside the cylinder.
    """
    elastic, alone = coarse
    angle = 2 * np.pi * (np.arange(G.Z) + 0.5) / G.Z
    c, s, R = np.cos(angle), np.sin(angle), G.d_m / 2
    for point in (0, 4, 8):
        N, V_r, V_t, M_r, M_t = np.moveaxis(half_loads.path_at(elastic, alone, point)[:, :5], 1, 0)
        c_, s_ = c[:, None], s[:, None]
        for balance in (
            N.sum(axis=0),
            (R * s_ * N + c_ * M_r - s_ * M_t).sum(axis=0) / R,
            (-R * c_ * N + s_ * M_r + c_ * M_t).sum(axis=0) / R,
            (c_ * V_r - s_ * V_t).sum(axis=0),
            (s_ * V_r + c_ * V_t).sum(axis=0),
        ):
            np.testing.assert_allclose(balance, 0.0, atol=1e-4)


def test_path_between_its_nodes(coarse):
    """Cubic between nine angles against direct solutions at 0...90 degrees in steps of 5: below 3 % of the largest
    moment (observed 1.1 %, N 1.0 %).
    """
    elastic, alone = coarse
    nodes = len(half_loads.CHI)
    table = np.stack([half_loads.path_at(elastic, alone, i) for i in range(nodes)])
    slopes = half_path.path_slopes(half_loads.CHI, table)
    direct = np.stack([half_loads.path_at(elastic, alone, nodes + i) for i in range(len(STEPS))])
    error = np.abs(np.stack([half_path.path_rows(half_loads.CHI, table, slopes, at) for at in STEPS]) - direct)
    for rows in ([0], [1, 2], [3, 4]):
        assert error[:, :, rows].max() < 0.02 * np.abs(direct[:, :, rows]).max()
    assert error[:, :, 3:5].max() > 1e-3 * np.abs(direct[:, :, 3:5]).max(), "the angles are not the nodes"


@pytest.mark.slow
def test_shipped_path_on_finer_elements():
    """Path and centrifugal load of the shipped table beside direct solutions on finer elements, at angles of 0...90
    degrees in steps of 5.

    Within 1 % of the largest of their kind (observed: tension 0.88, transverse loads 0.23, moments 0.93 %); the
    centrifugal moment 0.2 % (0.04 %).
    """
    t = rivet_table.read(rivet_table.DEFAULT_TABLE).half
    elastic = half_loads.elastic_half(G, half.FINE, wall_points(STEPS))
    alone, nodes = half_loads.JointAlone(elastic), len(half_loads.CHI)
    direct = np.stack([half_loads.path_at(elastic, alone, nodes + i) for i in range(len(STEPS))])
    error = np.abs(np.stack([half_path.path_rows(t.chi, t.path, t.path_slope, at) for at in STEPS]) - direct)
    for rows in ([0], [1, 2], [3, 4]):
        assert error[:, :, rows].max() < 0.01 * np.abs(direct[:, :, rows]).max()
    spin = half_loads.uniform_rows(elastic, alone, half_loads.centrifugal(elastic))
    assert t.spin[4] == pytest.approx(spin[4], rel=0.002)


def test_patch_and_radial_place_do_not_matter(coarse):
    """The path of Hertz's patch of 200 N within 1 % of the largest moment of the point's (observed 0.4 %), and of a
    contact 0.1 mm nearer to the axis or farther, as far as the guide clearance lets the cage go: within 3 % (observed
    2.6 %: the lever of a force along x).
    """
    elastic, alone = coarse
    first = len(half_loads.CHI) + len(STEPS)
    _, weights = hertz_patch(np.deg2rad(30.0))
    rows = np.stack([half_loads.path_at(elastic, alone, first + i) for i in range(len(weights) + 2)])
    point = half_loads.path_at(elastic, alone, len(half_loads.CHI) + 6)
    largest = np.abs(point[:, 3:5]).max()
    patch = np.einsum("p,pkrf->krf", weights, rows[:-2])
    assert np.abs((patch - point)[:, 3:5]).max() < 0.01 * largest
    for row in rows[-2:]:
        assert np.abs((row - point)[:, 3:5]).max() < 0.03 * largest


def test_centrifugal_load_beside_statics(coarse):
    """No tension and no radial moment by symmetry; M_t beside statics: the pitch pulls at its centre of mass, the web's
    tension holds it beside.

    The bar carries a part of the tension, so M_t lies between half and all of pull times distance.  The bare half:
    -93.2 N.mm at 754 rad/s.
    """
    elastic, alone = coarse
    spin = half_loads.uniform_rows(elastic, alone, half_loads.centrifugal(elastic))
    assert np.abs(spin[[0, 3]]).max() < 1e-6 * abs(spin[4])
    inertia = half_shape.half_inertia(G)
    pull = inertia.m / G.Z * np.sqrt(inertia.J_p / inertia.m)  # per pitch and (rad/s)2
    lever = 0.5 * (G.cage_half_width + half_shape.pocket_radius(G)) - inertia.x_c
    assert -pull * lever < spin[4] < -0.5 * pull * lever
    column = half_loads.centrifugal(elastic)
    column[elastic.patterns.head] = 0.0
    bare = half_loads.uniform_rows(elastic, alone, column)
    assert bare[4] * 754.0**2 == pytest.approx(-93.2e-3, rel=0.01)  # guards against change; finer elements: -93.28
