"""Finite elements of the rivet joint against closed forms, references and themselves.  Checks of what was fitted say
"calibration".
"""

import numpy as np
import pytest
from library import ROOT
from skfem import Basis, BilinearForm, ElementHex2, ElementVector, FacetBasis, LinearForm, MeshQuad, condense, solve

from bearing_model.rivet import rivet_rom, rivet_table
from rivet_model import build, geometry, half, load_cases, plastic_fit, reduction, section_mesh, stiffness
from rivet_model.elasticity import Body
from rivet_model.lcp import Contact
from rivet_model.load_cases import Grid, Joint, hat_harmonics
from rivet_model.section_mesh import Fineness, edge_nodes

G = geometry.Geometry()
R, E, NU = 0.75e-3, 200e9, 0.3
TABLE = ROOT / "rivet_model" / "tables" / "6207.json"


@pytest.fixture(scope="module")
def joint():
    return Joint(G, load_cases.SHIPPED)


def channels(joint, *load):
    """Channels [MPa] of P, N, V, M_plane, M_across, fit."""
    return joint.channels(joint.solve(*load)[0][:, None])[0] / 1e6


# Elasticity -----------------------------------------------------------------------------------------------------------


def end_loads(body, height):
    """Unit pull on both ends of a cylinder, by hats over the radius: [dofs, rings]."""
    radii = np.unique(np.round(body.mesh.p[0], 12))
    loads = 0.0
    for z, normal in ((height, 1.0), (0.0, -1.0)):
        loads = loads + body.ring_loads(edge_nodes(body.mesh, z=z), radii, (0.0, normal), 0)
    return loads, radii


@pytest.mark.parametrize(("n", "profile"), [(0, lambda r: 1.0 + 0.0 * r), (1, lambda r: r / R)])
def test_tension_and_bending_of_a_bar(n, profile):
    """sigma_zz = F/A, and M r cos theta/I: fields that the elements contain, so exact (observed 1e-11)."""
    body = Body(MeshQuad.init_tensor(np.linspace(0, R, 5), np.linspace(0, 4 * R, 9)), E, NU)
    loads, radii = end_loads(body, 4 * R)
    u = body.solve(n, loads @ profile(radii)[:, None])
    facets = body.mesh.facets_satisfying(lambda x: np.abs(x[0] - R) < 1e-9, True)
    S_0, S_1, x = body.stress_rows(facets)
    stress = ((S_0 + n * S_1) @ u).reshape(6, -1)
    np.testing.assert_allclose(stress[2], 1.0, rtol=1e-8)
    np.testing.assert_allclose(stress[[0, 1, 3, 4, 5]], 0.0, atol=1e-8)
    assert x.shape[1] == stress.shape[1]


def test_lame(joint):
    """Pressure of a solid shank in a ring, plane stress: compliances of both bodies against Lame (observed 1e-5)."""
    height, outer = 1e-3, 2.45e-3
    disc = Body(MeshQuad.init_tensor(np.linspace(0, R, 5), np.linspace(0, height, 3)), E, NU)
    ring = Body(MeshQuad.init_tensor(np.linspace(R, outer, 12), np.linspace(0, height, 3)), 110e9, 0.33)
    p = 0.0
    for body, sign in ((disc, 1.0), (ring, -1.0)):
        nodes = edge_nodes(body.mesh, r=R)
        load = body.ring_loads(nodes, body.mesh.p[1, nodes], (sign, 0.0), 1).sum(axis=1)
        p += load @ body.solve(0, load[:, None])[:, 0] / (R * height)  # closing per unit pressure
    k = (outer**2 + R**2) / (outer**2 - R**2)
    assert p == pytest.approx(R * (0.7 / E + (k + 0.33) / 110e9), rel=1e-3)


# Contact --------------------------------------------------------------------------------------------------------------


def pin_in_hole(clearance, load, hats, n_max):
    """Half-angle [deg] and peak pressure [Pa] of a pin in a wide plate, plane strain, equal materials; load [N/m],
    radial clearance [m].
    """
    height = 1e-3
    pin = Body(
        MeshQuad.init_tensor(R - section_mesh.graded(0, R, 14, 60.0)[::-1], np.linspace(0, height, 2)),
        E,
        NU,
        plane_strain=True,
    )
    far = section_mesh.graded(R, 40 * R, 26, 3000.0)
    plate = Body(
        MeshQuad.init_tensor(far, np.linspace(0, height, 2)), E, NU, lambda x: x[0] > 39.9 * R, plane_strain=True
    )
    angles = 2 * np.pi * np.arange(hats) / hats
    shape = hat_harmonics(angles, n_max)
    C = np.zeros((hats, hats))
    for n in range(n_max + 1):
        S = 0.0
        for body, sign in ((pin, 1.0), (plate, -1.0)):
            nodes = edge_nodes(body.mesh, r=R)
            G_n = body.ring_loads(nodes, body.mesh.p[1, nodes], (sign, 0.0), 1).sum(axis=1)
            S += G_n @ body.solve(n, G_n[:, None])[:, 0]
        C += (
            S
            / (2 * np.pi if n == 0 else np.pi)
            * (np.outer(shape[0][:, n], shape[0][:, n]) + np.outer(shape[1][:, n], shape[1][:, n]))
        )
        if n == 1:  # the load acts at the pin's core, not on its whole volume: a self-equilibrated difference
            core = LinearForm(lambda v, w: (v[0] - v[1]) * w.x[0] * (w.x[0] < 0.2 * R)).assemble(pin.basis)
            core *= (
                load
                * height
                / (np.pi * (core @ np.where(pin.component == 0, 1.0, np.where(pin.component == 1, -1.0, 0.0))))
            )
            nodes = edge_nodes(pin.mesh, r=R)
            on_rim = (
                pin.ring_loads(nodes, pin.mesh.p[1, nodes], (1.0, 0.0), 1).sum(axis=1)
                @ pin.solve(1, core[:, None])[:, 0]
            )
    weight = R * height * shape[0][:, 0]
    core_gap = -on_rim * shape[0][:, 1] / weight
    contact = Contact(C / np.outer(weight, weight), (R * height * shape[0][:, 1] / weight)[:, None], np.array([1e-6]))
    solution = contact.solve(clearance + core_gap, np.array([load * height]))
    pressure = solution.p / weight
    theta = np.degrees(np.abs(np.angle(np.exp(1j * angles))))
    # the outermost hat ends between its node and the next one
    return theta[pressure > 0.0].max() + 180.0 / hats, pressure.max()


@pytest.mark.parametrize(
    ("clearance", "load", "half_angle"),
    [
        (0.0, 20e3, 84.8),
        *(pytest.param(*case, marks=pytest.mark.slow) for case in [(5e-6, 20e3, 12.2), (45e-6, 100e3, 9.1)]),
    ],
)
def test_persson(clearance, load, half_angle):
    """Pin in hole: half-angles of Persson (1964) in Ciavarella and Decuzzi's form (2001), to 0.5 degrees; hats 0.7
    degrees apart.
    """
    found, peak = pin_in_hole(clearance, load, 512, 256)
    assert found == pytest.approx(half_angle, abs=0.5)
    # a = sqrt(4 Q R*/(pi E*)), p = 2 Q/(pi a): Hertz for nearly equal radii; a finer model: 534 against 514
    if clearance == 45e-6:
        R_star, E_star = R * (R + clearance) / clearance, E / (2 * (1 - NU**2))
        a = np.sqrt(4 * load * R_star / (np.pi * E_star))
        assert peak == pytest.approx(2 * load / (np.pi * a), rel=0.06)


def random_problem(rng, n=60, m=4):
    A = rng.normal(size=(n, n))
    return (
        Contact(A @ A.T / n + 1e-3 * np.eye(n), rng.normal(size=(n, m)), np.full(m, 1e-3)),
        rng.normal(size=n),
        rng.normal(size=m),
    )


def test_contact_conditions_hold_on_random_problems():
    """p >= 0, gap >= 0, p gap = 0, equilibrium, also from a wrong starting set (observed 1e-13): pivoting always ends."""
    rng = np.random.default_rng(1)
    for _ in range(60):
        contact, g, f = random_problem(rng)
        first = contact.solve(g, f)
        second = contact.solve(g, f, rng.random(len(g)) < 0.5)
        scale = np.abs(first.p).max()
        np.testing.assert_allclose(second.p, first.p, atol=1e-8 * scale)
        gap = contact.C @ first.p + g - contact.D @ first.q
        assert first.p.min() >= -1e-10 * scale and gap.min() >= -1e-9 * np.abs(gap).max()
        assert abs(first.p @ gap) <= 1e-9 * scale * np.abs(gap).max()
        np.testing.assert_allclose(contact.D.T @ first.p + contact.springs @ first.q, f, atol=1e-9 * np.abs(f).max())


def test_equilibrium_of_contact_forces(joint):
    """Forces of all contacts balance rivet and upper half: to 1e-9 of the largest load (observed 3e-11)."""
    P, N, V, M_plane, M_across = 20.0, 8.0, 12.0, 0.02, 0.01
    forces, _, solution, symmetry = joint.solve(P, N, V, M_plane, M_across, -10e-6)
    assert symmetry == "full" and solution.residual < 1e-9
    resultant = joint.D.T @ forces
    np.testing.assert_allclose(resultant[:5], 0.0, atol=1e-9 * P)
    np.testing.assert_allclose(resultant[5:], [V, 0.0, N, M_across, M_plane], atol=1e-9 * P)


def test_homogeneity(joint):
    """Loads, moment and fit times 20: stress times 20, to 1e-9 (observed 1e-12)."""
    load = np.array([20.0, 5.0, 10.0, 0.02, 0.0, -8e-6])
    np.testing.assert_allclose(channels(joint, *(20 * load)), 20 * channels(joint, *load), rtol=1e-9)


def test_symmetries_change_nothing(joint):
    """Plane, half turn and whole circle give one answer; the sign of M against V does not matter (observed 1e-6:
    springs, rounding).
    """
    for M_plane, M_across in ((0.04, 0.0), (0.0, 0.04)):
        short = channels(joint, 20.0, 5.0, 10.0, M_plane, M_across, -10e-6)
        whole = channels(joint, 20.0, 5.0, 10.0, M_plane or 1e-12, M_across or 1e-12, -10e-6)
        np.testing.assert_allclose(whole, short, rtol=1e-5)
    np.testing.assert_allclose(
        channels(joint, 20, 5, 10, -0.04, 0, -1e-5), channels(joint, 20, 5, 10, 0.04, 0, -1e-5), rtol=1e-6
    )


def test_preload_stress(joint):
    """Middle: F/A less the uneven section two diameters from the heads (observed -0.5 %).  Calibration: head 140-150
    MPa at 60 N (147.0).
    """
    stress = channels(joint, 60.0, 0.0, 0.0, 0.0, 0.0, -90e-6)
    assert stress[rivet_rom.MID_VM] == pytest.approx(60.0 / G.shank_area / 1e6, rel=0.01)
    assert 140.0 < stress[rivet_rom.HEAD_P1] < 150.0


def test_calibration_crossing(joint):
    """Calibration: with the shipped swell, head and middle cross inside -0.02...0 mm; the middle leads at +0.04 mm with
    and without yield.
    """
    load = 20.0, 10.0, 10.0, 0.0, 0.0
    ratio = {fit: (lambda s: s[2] / s[0])(channels(joint, *load, fit + 4e-6)) for fit in (-20e-6, -10e-6, 0.0, 40e-6)}
    assert ratio[-20e-6] < 1.0 < ratio[0.0]
    assert ratio[40e-6] > 1.5
    fit = plastic_fit.plastic_fit(G, fine=Fineness(0.6))
    yielded = channels(joint, *load, np.interp(44e-6, fit.fit_a, fit.fit_eff))
    assert yielded[2] > 1.5 * yielded[0]


def test_monotone_in_preload(joint):
    """Both channels grow with the preload at fixed load and fit."""
    stress = np.array([channels(joint, P, 0.0, 10.0, 0.0, 0.0, -6e-6) for P in (5.0, 10.0, 20.0, 40.0, 60.0)])
    assert np.all(np.diff(stress, axis=0) > 0.0)


def test_joint_stiffness(joint):
    """Against an independent prototype, not kept here: stack 50.5 kN/mm, heads 6.5, bores 14-15 (-90 um) and 46-47 (+5
    um), head 11.7 MPa/N.
    """
    data = stiffness.joint_data(joint)
    assert data["k_stack"] == pytest.approx(50.5e6, rel=0.08)
    assert data["k_t_head"] == pytest.approx(6.5e6, rel=0.05)
    assert data["k_hole"][0] == pytest.approx(14.5e6, rel=0.05)
    assert data["k_hole"][-2] == pytest.approx(46.5e6, rel=0.05)
    assert stiffness.head_friction(joint)[1] == pytest.approx(11.7e6, rel=0.06)
    # force in the split plane
    clamped, open_ = (joint.solve(20.0, N, 0.0, 0.0, 0.0, -90e-6)[0][joint.slices["PP"]].sum() for N in (0.0, 30.0))
    assert clamped == pytest.approx(20.0, rel=1e-6)
    assert open_ < 1e-6


# Interference with plasticity -----------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def fit_map():
    return plastic_fit.plastic_fit(G, largest=20e-6, fine=Fineness(0.6))


def test_fit_map(fit_map):
    """Elastic first, then less; onset of the flange between +2 and +5 um (prototype); a 590 MPa rivet yields later."""
    assert fit_map.fit_eff[1] == fit_map.fit_a[1]
    assert np.all(np.diff(fit_map.fit_eff) > 0.0) and np.all(fit_map.fit_eff <= fit_map.fit_a * (1 + 1e-9))
    assert 2e-6 < fit_map.flange_yield < 5e-6 < fit_map.rivet_yield
    assert fit_map.fit_eff[-1] < 0.5 * fit_map.fit_a[-1]


def test_steps_do_not_matter(fit_map, monkeypatch):
    """Half the step: nearly the same pressure (observed 1.5 % at the bore's edges' 5 % of plastic strain)."""
    monkeypatch.setattr(plastic_fit, "STEP", 0.5e-6)
    finer = plastic_fit.plastic_fit(G, largest=10e-6, fine=Fineness(0.6))
    assert finer.pressure[-1] == pytest.approx(fit_map.pressure[9], rel=0.02)


def test_elastic_pressure_of_contact_and_plasticity_agree(joint, fit_map):
    """Two models, one elastic bore pressure per fit (observed 1 %: the contact also has heads and plates)."""
    forces = joint.solve(1e-3, 0.0, 0.0, 0.0, 0.0, 1e-6)[0][joint.slices["UB"]]
    mean = forces.sum() / (2 * np.pi * joint.moments["UB"][0].sum())
    assert fit_map.pressure[0] == pytest.approx(mean, rel=0.03)


# The table ------------------------------------------------------------------------------------------------------------


@pytest.mark.slow  # most of a minute; test_app_rivet makes a coarse table among the fast tests
def test_coarse_table_end_to_end(tmp_path):
    """A coarse table in seconds: written, read, and equal to its own finite elements where it was sampled.

    The error that it states is the one that is found against the full table at 4,000 other loads: to half of it,
    observed 0.90 to 1.21 times.
    """
    path = tmp_path / "coarse.json"
    assert build.main([str(path), "--coarse", "--workers", "1"]) == 0
    t = rivet_table.read(path, Z=9)
    assert t.kind == "fe_coarse" and t.kind_number == 2 and t.errors["all"]["loads"] == 320
    assert t.geometry_hash == G.digest and np.any(t.half.path)
    loads = reduction.random_loads(4000, 77)
    found = reduction.hold_out_errors(t, loads, reduction.table_stress(rivet_table.read(TABLE), loads))
    for region in ("all", "clearance"):
        for measure in ("maximum", "rms"):
            for name in rivet_table.CHANNELS:
                assert t.errors[region][measure][name] == pytest.approx(found[region][measure][name], rel=0.5), (
                    region,
                    measure,
                    name,
                )
    joint = Joint(G, load_cases.COARSE)
    sampled = reduction.solve_loads(joint, [reduction.Load(20.0, 0.0, 0.0, 0.0, -30e-6)], 1)
    got, _ = rivet_rom.rivet_rom_stress(t, rivet_rom.RivetLoad(T=20.0), -30e-6)
    np.testing.assert_allclose(got, sampled[0], rtol=1e-4)  # five digits in the file


def test_nothing_is_written_for_an_impossible_geometry(tmp_path, capsys):
    """Sizes that overlap, a cage without material between its pockets: message, status 2, no file."""
    (tmp_path / "bad.toml").write_text("cage_half_width = 5e-3", encoding="utf-8")
    assert build.main([str(tmp_path / "out.json"), str(tmp_path / "bad.toml"), "--coarse"]) == 2
    assert "cage_half_width" in capsys.readouterr().err
    assert list(tmp_path.glob("out*")) == []


def test_grid_with_too_few_harmonics_is_refused():
    with pytest.raises(ValueError, match="need 48 harmonics"):
        Grid(n_max=24)


def test_hold_out_of_the_shipped_table():
    """What the shipped table says of itself, measured on 320 loads that neither built it nor chose its knots.

    Reach: 2 % and RMS 0.5 % of each channel's maximum, over all loads and in clearance alone.  There the middle, which
    carries little, misses the 2 % at one load of 160 (observed von Mises 3.2 %, p1 2.2 %; RMS 0.36 %).
    """
    t = rivet_table.read(TABLE)
    assert t.kind == "fe" and t.geometry_hash == G.digest
    for region, largest in (("all", {"head": 0.02, "mid": 0.02}), ("clearance", {"head": 0.02, "mid": 0.04})):
        report = t.errors[region]
        assert report["loads"] >= 160
        assert all(value <= largest[name.partition("_")[0]] for name, value in report["maximum"].items()), report
        assert max(report["rms"].values()) <= 0.005, report


def test_errors_on_the_page():
    """docs/rivet.md shows the errors of the shipped table's header."""
    errors, page = rivet_table.read(TABLE).errors, (ROOT / "docs" / "rivet.md").read_text(encoding="utf-8")
    for title, region in (("all", "all"), ("clearance alone", "clearance")):
        shown = [
            f"{100 * errors[region]['maximum'][name]:.2f} %, {100 * errors[region]['rms'][name]:.2f} %"
            for name in rivet_table.CHANNELS
        ]
        assert f"| {title}: maximum, RMS | {' | '.join(shown)} |" in page


@pytest.mark.slow
def test_table_against_fresh_solutions():
    """Forty loads of another seed, solved anew with 100 angles around each bore: the header's promise holds."""
    t = rivet_table.read(TABLE)
    joint = Joint(G, load_cases.TRUTH)
    loads = reduction.random_loads(40, seed=77)
    errors = reduction.hold_out_errors(t, loads, reduction.solve_loads(joint, loads, 2))
    print(errors)
    assert max(errors["all"]["maximum"].values()) <= 0.025  # relative to the maximum of only 40 loads


@pytest.mark.slow
def test_h_convergence():
    """Half the element size: head stress moves by less than 0.5 % (observed 0.19, 0.18, 0.11, 0.43 %)."""
    coarse, fine = Joint(G, Grid(Fineness(1.0), 7.5, 12, 24)), Joint(G, Grid(Fineness(2.0), 7.5, 12, 24))
    for load in (
        (60.0, 0, 0, 0, 0, -90e-6),
        (20.0, 0, 20.0, 0, 0, -20e-6),
        (20.0, 10.0, 10.0, 0, 0, 5e-6),
        (20.0, 0, 10.0, 0.04, 0, -1e-5),
    ):
        assert channels(coarse, *load)[0] == pytest.approx(channels(fine, *load)[0], rel=0.005)


@pytest.mark.slow
def test_full_3d():
    """The flange as a solid of hexahedra, half of it, under a bore pressure of three harmonics: work of the pressure
    within 1 %.

    The solid's facets are flat (32 to the half circle: 0.2 % of the radius); observed below 0.5 %.
    """
    fine, sectors = Fineness(0.5), 32
    flat = section_mesh.flange_mesh(G, fine)
    body = Body(flat, G.E_flange, G.nu_flange, lambda x: x[0] > G.patch_radius - 1e-9)
    nodes = edge_nodes(flat, r=R, between=(G.edge_break, G.flange_thickness - G.relief_depth))
    load = body.ring_loads(nodes, flat.p[1, nodes], (-1.0, 0.0), 1).sum(axis=1)
    fourier = sum((2 * np.pi if n == 0 else np.pi) * (load @ body.solve(n, load[:, None])[:, 0]) for n in range(3))

    theta = np.linspace(0.0, np.pi, sectors + 1)
    r, x = flat.p
    p = np.concatenate([np.stack([r * np.cos(t), r * np.sin(t), x]) for t in theta], axis=1)
    cells = [np.concatenate([flat.t + k * r.size, flat.t + (k + 1) * r.size]) for k in range(sectors)]
    mesh = half.hexahedra(p, np.concatenate(cells, axis=1))
    basis = Basis(mesh, ElementVector(ElementHex2()), intorder=4)
    mu, lam = (
        G.E_flange / (2 * (1 + G.nu_flange)),
        G.E_flange * G.nu_flange / ((1 + G.nu_flange) * (1 - 2 * G.nu_flange)),
    )

    @BilinearForm
    def hooke(u, v, w):
        e, f = (g + np.swapaxes(g, 0, 1) for g in (u.grad, v.grad))
        return lam * np.trace(u.grad) * np.trace(v.grad) + 0.5 * mu * np.einsum("ij...,ij...->...", e, f)

    def on_bore(y):
        return (np.hypot(y[0], y[1]) < 1.01 * R) & (y[2] > G.edge_break) & (y[2] < G.flange_thickness - G.relief_depth)

    wall = FacetBasis(mesh, basis.elem, facets=mesh.facets_satisfying(on_bore, True), intorder=4)

    @LinearForm
    def pressure(v, w):
        angle = np.arctan2(w.x[1], w.x[0])
        push = 1 + np.cos(angle) + np.cos(2 * angle)
        return push * (np.cos(angle) * v[0] + np.sin(angle) * v[1])

    f = pressure.assemble(wall)
    radius, height = np.hypot(*basis.doflocs[:2]), np.abs(basis.doflocs[1])
    held = radius > G.patch_radius * np.cos(0.51 * np.pi / sectors) - 1e-9
    part = np.zeros(basis.N, dtype=int)
    for dofs in (basis.nodal_dofs, basis.edge_dofs, basis.facet_dofs, basis.interior_dofs):
        for i, row in enumerate(dofs):
            part[row] = i % 3
    fixed = np.flatnonzero(held | ((height < 1e-12) & (part == 1)))
    u = solve(*condense(hooke.assemble(basis), f, D=fixed))
    work = 2 * (f @ u)
    print(f"3D / Fourier: {work / fourier:.4f}")
    assert work == pytest.approx(fourier, rel=0.01)
