"""Preload of a ribbon's joints under spin: s S(tau), homogeneous and smooth; both twins."""

from types import SimpleNamespace

import numpy as np
import pytest

from bearing_model.cage.common.spin_preload import spin_bending

TAU = np.linspace(0.0, 1.0, 33)


def half(S):
    return SimpleNamespace(spin_preload=np.asarray(S))


@pytest.fixture(params=["C", "Python"])
def bending(request, core):
    """(S, P, w [n]) -> addition [n]."""
    if request.param == "Python":
        return lambda S, P, w: spin_bending(half(S), P, np.asarray(w))

    def call(S, P, w):
        w, S, more = np.asarray(w, float), np.asarray(S, float), np.empty(len(w))
        core.lib.test_spin_bending(len(w), len(S), core.array(S), P, core.array(w), core.array(more))
        return more

    return call


def test_a_parabola_is_exact(bending):
    """s (S(tau) - 1) of S = 1 + 0.3 tau + 0.1 tau^2: Catmull-Rom splines contain parabolas, but for the first and last cell."""
    P, w = 20.0, np.array([1.0, 7.0, 20.0, 90.0, 500.0])
    tau = w / (P + w)
    S = 1.0 + 0.3 * TAU + 0.1 * TAU**2
    assert bending(S, P, w) == pytest.approx((P + w) * (0.3 * tau + 0.1 * tau**2), rel=1e-12)


def test_ends_and_homogeneity(bending):
    """Nothing at rest; the last number without preload; twice both is twice the addition; nothing of nothing."""
    S = 1.0 + 0.5 * TAU * (1.0 - 0.4 * TAU)
    assert bending(S, 20.0, [0.0]) == pytest.approx([0.0], abs=1e-12)
    assert bending(S, 0.0, [10.0]) == pytest.approx([10.0 * (S[-1] - 1.0)], rel=1e-12)
    w = np.array([3.0, 30.0])
    assert bending(S, 40.0, 2.0 * w) == pytest.approx(2.0 * bending(S, 20.0, w), rel=1e-12)
    assert bending(S, 0.0, [0.0]) == pytest.approx([0.0], abs=0.0)


def test_twins(bending):
    rng = np.random.default_rng(1)
    S, w = 1.0 + rng.uniform(0.0, 0.3, 33), rng.uniform(0.0, 200.0, 50)
    assert bending(S, 15.0, w) == pytest.approx(spin_bending(half(S), 15.0, w), rel=1e-11)


def test_a_machined_half_has_none():
    assert spin_bending(half([]), 20.0, 5.0) == 0.0
