"""Rivet tables of bearings other than the 6207, beside a cage made by hand (cage_by_hand.py): 6205, 6309 and 6316, with
cages of steel and of brass.

Compared: mass and inertia, vibration of a free half, the rivet's tension and head stress of a cage that turns at rest
of impacts.  Both sides have meshes; wanted are 3 % of the full finite elements and 10 % of the coarse table.  Run one
with -s to see the numbers.
"""

from dataclasses import asdict, replace
from functools import cache
from typing import NamedTuple

import numpy as np
import pytest

try:
    import cage_by_hand as by_hand
except (ImportError, OSError) as error:  # gmsh, or a library of the system that it loads
    pytest.skip(f"the mesher gmsh cannot be loaded, `make test-slow` installs it: {error}", allow_module_level=True)

from bearing_model.cage.common import joint_law
from bearing_model.cage.two_half.joint_open import joints_open
from bearing_model.rivet.rivet_rom import HEAD_P1, RivetLoad, rivet_rom_stress
from rivet_model import build, half, half_loads, half_modes, half_shape, joint_contact, load_cases
from rivet_model.geometry import Geometry
from riveted_bearing.bearing.bearing_file import bearing_case

# The test's own numbers, of no data sheet.
MATERIALS = {"steel": by_hand.Material(206e9, 0.30, 7850.0), "brass": by_hand.Material(100e9, 0.34, 8400.0)}
RIVET = by_hand.Material(192e9, 0.30, 7850.0)
ALL = [(bearing, material) for bearing in ("6205", "6309", "6316") for material in MATERIALS]
FULL_T, FULL_HEAD, LAW_T, LAW_HEAD = 3.5, 5.5, 3.5, 6.0  # %
FULL_FREQUENCY, COARSE_FREQUENCY = 0.01, 0.04
CLEARANCE = -0.04  # fit over the shank's diameter: the hole does not bear


def geometry(bearing, material):
    """Geometry of a bearing by the project's rule, with a material of the test."""
    E, nu, rho = MATERIALS[material]
    return Geometry(**(bearing_case(bearing).joint | {"E_flange": E, "nu_flange": nu, "rho_flange": rho}))


@cache
def hand_meshes(bearing):
    """The half's and the rivet's mesh: they do not depend on the material."""
    g = geometry(bearing, "steel")
    return by_hand.half_mesh(g, 1.0), by_hand.rivet_mesh(g, 8, 8)


def test_the_rivet_is_as_the_test_says():
    g = geometry("6309", "brass")
    assert (g.E_rivet, g.nu_rivet, g.rho_rivet) == RIVET


# The path by hand itself ----------------------------------------------------------------------------------------------


def test_elements_by_hand_against_closed_forms():
    """Energies of displacements whose integrals are second moments of the volume: u = (x^2, 0, 0), 4 (lambda + 2 mu)
    int x^2, and (0, x y, 0).

    Kinetic energy of the speed (x, 0, 0): rho int x^2.  Observed 1e-6 of the rivet, 1e-4 of the half: sides of its
    elements are curved.
    """
    E, nu = 2.0, 0.3
    lam, mu = E * nu / (1 + nu) / (1 - 2 * nu), E / 2 / (1 + nu)
    g = geometry("6309", "steel")
    for solid in (by_hand.half_mesh(g, 2.0).solid, by_hand.rivet_mesh(g, 4, 4)):
        second, (x, y, _) = solid.moments()[2], solid.nodes.T
        zero, K = 0.0 * x, solid.stiffness(E, nu)
        for u, expected in (
            ((x * x, zero, zero), 4 * (lam + 2 * mu) * second[0, 0]),
            ((zero, x * y, zero), (lam + 2 * mu) * second[0, 0] + mu * second[1, 1]),
        ):
            u = np.stack(u, axis=1).ravel()
            assert u @ K @ u == pytest.approx(expected, rel=5e-4)
        v = np.stack([x, zero, zero], axis=1).ravel()
        assert v @ solid.inertia(3.0) @ v == pytest.approx(3.0 * second[0, 0], rel=1e-6)


# Mass and inertia -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("bearing", "material"), ALL)
def test_mass_and_inertia(bearing, material):
    """Volumes of the meshes against the closed form, which leaves the hole's chamfer out: observed 0.013 to 0.017 %."""
    g = geometry(bearing, material)
    found, expected = half_shape.half_inertia(g), by_hand.inertia(g, MATERIALS[material], RIVET, *hand_meshes(bearing))
    print(bearing, material, *expected, *found)
    np.testing.assert_allclose(found, expected, rtol=3e-4)


# A free half ----------------------------------------------------------------------------------------------------------


def project_frequencies(elastic, waves, count):
    """{number of waves: lowest frequencies [Hz]} of a condensed half."""
    massive = half_modes.MassiveHalf(elastic)
    return {n: massive.wave(n, count).omega / (2 * np.pi) for n in waves}


def rivet_mass(rivet):
    """Half of a rivet [kg]: its head and the shank above the split."""
    return 2.0 * RIVET.rho * rivet.moments()[0]


@pytest.mark.slow
@pytest.mark.parametrize(("bearing", "material"), ALL)
def test_frequencies_of_a_free_half(bearing, material):
    """The four lowest of each number of waves, 20 in all: 1 % of the elements of a full table, 4 % of those of a coarse
    one.

    Both sides err to the high side with the size of their elements.  Observed, by elements of 1.2 here: -0.1 to +0.5 %,
    of the ten lowest 0.2 %; of the coarse ones +1.2 to +3.4 %.  Those of 1.5, which are used, are 0.6 % higher.
    """
    g = geometry(bearing, material)
    waves = range(g.Z // 2 + 1)
    expected = by_hand.frequencies(
        g, MATERIALS[material], rivet_mass(hand_meshes(bearing)[1]), by_hand.half_mesh(g, 1.5, 3.0), waves, 4
    )
    expected = np.concatenate(list(expected.values()))
    for size, allowed in ((None, FULL_FREQUENCY), (half.COARSE, COARSE_FREQUENCY)):
        found = np.concatenate(list(project_frequencies(half_loads.elastic_half(g, size), waves, 4).values()))
        for n, rows in zip(
            waves, np.split(np.stack([expected, found, 100 * (found / expected - 1)]), len(waves), axis=1), strict=True
        ):
            print(
                bearing,
                material,
                size or "full",
                "n =",
                n,
                *("%.1f %.1f %+.2f %%" % tuple(row) for row in rows.T),
                sep="  ",
            )
        assert np.abs(found / expected - 1).max() < allowed


@pytest.mark.slow
def test_frequencies_of_fine_meshes():
    """The 6309 of steel on fine meshes of both sides, n = 2 and 3, to 0.1 %: 1 % of E or of the density would be 0.5 %.
    Observed 0.02 %.
    """
    g = geometry("6309", "steel")
    expected = by_hand.frequencies(
        g, MATERIALS["steel"], rivet_mass(hand_meshes("6309")[1]), by_hand.half_mesh(g, 0.8, 3.0), (2, 3), 3
    )
    found = project_frequencies(half_loads.elastic_half(g, half.FINE), (2, 3), 3)
    for n in (2, 3):
        print(n, expected[n], found[n])
        np.testing.assert_allclose(found[n], expected[n], rtol=1e-3)


# Turning at rest of impacts -------------------------------------------------------------------------------------------


class Turning(NamedTuple):
    """A cage made by hand at its speeds."""

    g: Geometry
    P: float  # preload [N]
    fit: float  # [m]
    omega: np.ndarray  # [4] rad/s
    T: np.ndarray  # [4] tension [N]
    head: np.ndarray  # [4] head stress [Pa]


@cache
def turning(bearing, material):
    """From standstill to wide open joints, whose tension is five times the preload."""
    g = geometry(bearing, material)
    cage, P = (
        by_hand.Cage(g, MATERIALS[material], RIVET, *hand_meshes(bearing)),
        20.0 * (g.shank_diameter / 1.5e-3) ** 2,
    )
    # the moment of a pitch about the split, over that at which it would stand on the edge of its pad
    pull, x = cage.centrifugal().reshape(-1, 3), cage.half.solid.nodes[:, 0]
    omega = np.sqrt(np.array([0.0, 1.0, 2.0, 8.0]) * P * by_hand.pad_half_length(g) / (2.0 * pull[:, 1] @ x))
    states = [cage.at_rest(P, one) for one in omega]
    T, head = (np.array([getattr(state, name) for state in states]) for name in ("T", "head"))
    assert T[0] == pytest.approx(P, rel=1e-6) and T[-1] > 3.0 * P
    return Turning(g, P, CLEARANCE * g.shank_diameter, omega, T, head)


def differences(name, hand, T, head):
    """Of tension and head stress [4] each from those by hand [%], printed beside them."""
    table = np.stack(
        [hand.omega, hand.T, T, 100 * (T / hand.T - 1), 1e-6 * hand.head, 1e-6 * head, 100 * (head / hand.head - 1)],
        axis=1,
    )
    print(f"{name}: speed [rad/s]; T [N] by hand, found, difference [%]; head stress [MPa] likewise")
    print(*("  ".join(f"{value:9.2f}" for value in row) for row in table), sep="\n")
    return table[:, 3], table[:, 6]


def by_law(law, spin, P, omega):
    """Tension and moment of the rivet by the law of the joint; spin: bonded rows [8] per (rad/s)^2."""
    rows = np.tile(spin * omega**2, (law.Z, 1))
    rivet = joints_open(law, rows[:, [0, 3, 4]], np.maximum(P + rows[:, 5], 0.0), rows[0, 4], P + rows[0, 5])[1]
    return rivet[0, 0], rivet[0, 2] + rows[0, 7]


@pytest.mark.slow
@pytest.mark.parametrize(("bearing", "material"), ALL)
def test_rivet_of_a_turning_cage_by_full_elements(bearing, material):
    """Tension and head stress by the contact of the elements of a full table, and by the law of the joint made from
    them.

    Tension of the contact: wide open joints touch at the edges of their pads, which takes finer elements: see the test
    of the fine mesh below. Head stress at the same T and m: the bar of an open joint bends in one plane, so its seat
    presses with a second harmonic of the angle, 5 % of T (6316, brass).  A table of T and m cannot have it; without
    that harmonic the stress by hand is 3.5 % smaller. Observed, of the contact: tension -0.3 to +2.9 %, head stress
    -5.3 to 0.0 %; of the law -0.3 to +3.1 % and -5.6 to +0.1 %.
    """
    hand = turning(bearing, material)
    elastic = half_loads.elastic_half(hand.g)
    contact, joint, spin = (
        joint_contact.JointContact(elastic),
        load_cases.Joint(hand.g),
        half_loads.centrifugal(elastic),
    )
    alone = half_loads.JointAlone(elastic)
    law, row = half_loads.make_law(elastic, alone), half_loads.uniform_rows(elastic, alone, spin)
    law.sign = np.sign(row[4])
    direct = [contact.solve(hand.P, contact.loads((), omega**2 * spin)).rivet[0, [0, 2]] for omega in hand.omega]
    for name, rivets, allowed_T, allowed_head in (
        ("contact", direct, FULL_T, FULL_HEAD),
        ("law", [by_law(law, row, hand.P, omega) for omega in hand.omega], LAW_T, LAW_HEAD),
    ):
        head = [
            joint.channels(joint.solve_shank(T, 0.0, abs(m), 0.0, hand.fit)[0][:, None])[0, HEAD_P1] for T, m in rivets
        ]
        off_T, off_head = differences(f"{bearing} {material} {name}", hand, np.array(rivets)[:, 0], np.array(head))
        assert np.abs(off_T).max() < allowed_T
        assert np.abs(off_head).max() < allowed_head


@pytest.mark.slow
@pytest.mark.parametrize(
    ("bearing", "material"),
    ALL,
)
def test_rivet_of_a_turning_cage_by_a_coarse_table(bearing, material):
    """Tension and head stress by a whole coarse table: 10 %.

    Observed: tension -0.4 to +7.4 %, of which the coarse mesh of the half makes most; head stress -3.5 to +4.2 %.
    """
    hand = turning(bearing, material)
    table = build.make_table(hand.g, coarse=True, workers=1, hold_out=0)
    T, m = np.array([by_law(table.half.law, table.half.spin, hand.P, omega) for omega in hand.omega]).T
    head = rivet_rom_stress(table, RivetLoad(T=T, m_z=m), hand.fit)[0][:, HEAD_P1]
    off_T, off_head = differences(f"{bearing} {material} coarse table", hand, T, head)
    assert np.abs(off_T).max() < 10.0
    assert np.abs(off_head).max() < 10.0


@pytest.mark.slow
def test_tension_by_a_fine_mesh():
    """The 6309 of steel at the highest speed by a fine mesh: 1.5 %, observed 1.0 %, of the standard mesh 3.0 %."""
    hand = turning("6309", "steel")
    elastic = half_loads.elastic_half(hand.g, half.FINE)
    contact = joint_contact.JointContact(elastic)
    T = contact.solve(hand.P, contact.loads((), hand.omega[-1] ** 2 * half_loads.centrifugal(elastic))).rivet[0, 0]
    print(T, hand.T[-1])
    assert T == pytest.approx(hand.T[-1], rel=0.015)


# Similar joints -------------------------------------------------------------------------------------------------------

LARGER = 2.5  # about the 6316's size over the 6207's


def enlarged(g, factor):
    """The same joint and half, all their lengths times factor."""
    others = ("E_", "nu_", "rho_", "alpha_", "yield_", "hardening_", "Z", "T_0", "shape")
    lengths = [name for name in asdict(g) if not name.startswith(others)]
    return replace(g, **{name: getattr(g, name) * factor for name in lengths})


def test_law_of_an_enlarged_joint():
    """All lengths times f, all forces times f^2, all moments times f^3: the tension over the preload of an opening
    joint is the same, to rounding.

    Observed with l = f 1.5 mm: equal to 1e-6; with the same l up to 1.7 % apart.
    """
    P, ratios = 20.0, []
    for factor in (1.0, LARGER):
        g = enlarged(Geometry(), factor)
        elastic = half_loads.elastic_half(g, half.COARSE)
        law = half_loads.make_law(elastic, half_loads.JointAlone(elastic))
        M_t = -np.array([0.5, 1.0, 2.0, 4.0]) * P * Geometry().patch_radius
        loads = np.stack([0.0 * M_t, 0.0 * M_t, factor**3 * M_t], axis=1)
        ratios.append(joint_law.joint_law(law, loads, np.full(4, factor**2 * P))[1][:, 0] / (factor**2 * P))
    print(ratios)
    np.testing.assert_allclose(ratios[1], ratios[0], rtol=1e-5)


@pytest.mark.slow
def test_head_stress_of_a_bent_rivet_of_a_large_bearing():
    """The 6316's coarse table at |m|/T from 0 to 0.2 mm times its size over the 6207's, beside fresh solutions on the
    shipped grid: 3 %.
    """
    g = geometry("6316", "steel")
    table, joint, larger = (
        build.make_table(g, coarse=True, workers=1, hold_out=0),
        load_cases.Joint(g),
        g.shank_diameter / 1.5e-3,
    )
    fit, T = CLEARANCE * g.shank_diameter, 100.0 * larger**2
    m = T * larger * np.array([0.0, 0.05e-3, 0.1e-3, 0.15e-3, 0.2e-3])
    fresh = np.array([joint.channels(joint.solve_shank(T, 0.0, one, 0.0, fit)[0][:, None])[0, HEAD_P1] for one in m])
    found = rivet_rom_stress(table, RivetLoad(T=T + 0.0 * m, m_z=m), fit)[0][:, HEAD_P1]
    print(np.round(1e-6 * fresh, 1), np.round(100 * (found / fresh - 1), 2))
    np.testing.assert_allclose(found, fresh, rtol=0.03)
