"""Coulomb friction of the closed joint: against Coulomb's own limits, an independent prototype, and the numbers the
dynamics uses.
"""

import re

import numpy as np
import pytest

from rivet_model import friction, stiffness
from rivet_model.geometry import Geometry
from rivet_model.load_cases import Joint

P, MU = 20.0, 0.15
LOADS = (1.0, 2.0, 2.6, 3.0, 3.5, 4.0, 5.0, 5.8)


@pytest.fixture(scope="module")
def joint():
    return Joint(Geometry(), friction.GRID)


@pytest.fixture(scope="module")
def condensed(joint):
    return friction.Friction(joint)


@pytest.fixture(scope="module")
def curve(condensed):
    return dict(zip(LOADS, condensed.curve(P, LOADS, MU), strict=True))


def test_normal_compliance_is_that_of_the_frictionless_joint(condensed, joint):
    """Two assemblies, one compliance (observed 7e-6: harmonics between the solved ones are interpolated in one of
    them).
    """
    for first in friction.CONTACTS:
        for second in friction.CONTACTS:
            a = condensed.C[condensed.slices["n", first], condensed.slices["n", second]]
            b = joint.C[joint.slices[first], joint.slices[second]]
            np.testing.assert_allclose(a, b, atol=1e-4 * np.abs(joint.C).max())
    np.testing.assert_allclose(condensed.C, condensed.C.T, atol=1e-12 * np.abs(condensed.C).max())  # Betti


def test_forces_balance_and_obey_coulomb(curve):
    """Plates and heads carry V together (springs: 1e-9), each at most mu P; slip and stress grow with V."""
    for V, answer in curve.items():
        assert answer.plates + answer.heads == pytest.approx(V, rel=1e-6)
        assert max(answer.plates, answer.heads) <= MU * P * (1 + 1e-6)
    assert np.all(np.diff([a.slip for a in curve.values()]) > 0.0) and np.all(
        np.diff([a.head_p1 for a in curve.values()]) > 0.0
    )


def test_against_the_prototype(curve):
    """A separate program, not kept: semismooth Newton on another mesh: plates first, then the heads.  V: slip [um],
    plates, heads [N], head stress [MPa].
    """
    for V, slip, plates, heads, head_p1 in (
        (2.0, 0.01, 1.97, 0.03, 49.0),
        (4.0, 0.15, 3.00, 1.00, 60.0),
        (5.8, 0.43, 2.99, 2.81, 82.0),
    ):
        a = curve[V]
        assert (a.plates, a.heads) == pytest.approx((plates, heads), abs=0.03)  # observed 0.02
        assert a.head_p1 == pytest.approx(1e6 * head_p1, rel=0.03)  # observed 2 %
        assert a.slip == pytest.approx(1e-6 * slip, rel=0.07, abs=0.6e-8)  # observed 6 %; 0.01 is rounded


def test_stiffness_and_stress_of_the_head_branch(curve, joint):
    """What the dynamics takes from uniform tractions (k_t_head, head_friction) is Coulomb's answer between plates and
    heads (observed 2 %, 1 %).
    """
    k_head, growth, _ = stiffness.head_friction(joint)
    one, two = curve[3.5], curve[5.0]
    assert (two.V - one.V) / (two.slip - one.slip) == pytest.approx(k_head, rel=0.05)
    assert (two.head_p1 - one.head_p1) / (two.heads - one.heads) == pytest.approx(growth, rel=0.05)
    assert curve[1.0].V / curve[1.0].slip > 2e8  # plates: far stiffer


def test_capacity(condensed):
    """2 mu P, not mu P; a little less, as the drag unloads the plates (observed 1.2 %)."""
    with pytest.raises(ArithmeticError, match="slip freely") as error:
        condensed.curve(P, (2.0, 2.8, 3.5, 4.5, 5.5, 6.1), MU)
    assert float(re.search(r"hold ([\d.]+) N", str(error.value))[1]) == pytest.approx(2 * MU * P, rel=0.02)
