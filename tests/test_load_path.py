"""From pocket forces to rivets: equilibrium and symmetry of both shares; both twins alike."""

import numpy as np
import pytest

from bearing_model import load_path
from bearing_model.variables import Z
from rivet_model.embed import path_columns

D_M = 53.5e-3
ANGLE = 2 * np.pi * (np.arange(Z) + 0.5) / Z


def doubles(ffi, values):
    return ffi.new("double[]", [float(v) for v in np.ravel(values)])


@pytest.fixture(params=["C", "Python"])
def rigid(request, core):
    if request.param == "Python":
        return load_path.load_path_rigid
    ffi = core.ffi

    def call(d_m, wrench, c, s):
        out = [ffi.new("double[]", Z) for _ in range(3)]
        core.model().kernel("load_path_rigid")(d_m, doubles(ffi, wrench), doubles(ffi, c), doubles(ffi, s), *out)
        return tuple(np.array(list(v)) for v in out)

    return call


@pytest.fixture(params=["C", "Python"])
def flexible(request, core):
    if request.param == "Python":
        return load_path.load_path_flexible
    ffi = core.ffi

    def call(matrix, side, *forces):
        loads = core.new("PathLoads")
        core.model().kernel("load_path_flexible")(doubles(ffi, path_columns(matrix)), side, True, *(doubles(ffi, f) for f in forces), loads)
        return np.array([list(sum)[:Z] for sum in loads.sum]).T

    return call


def test_rigid_share_carries_the_wrench(rigid):
    """Resultant of all rivets = the wrench, at any rotation of the circle (rounding; observed 1e-15)."""
    rng = np.random.default_rng(1)
    for psi in (0.0, 0.3, 2.0):
        wrench = rng.normal(size=6) * [100, 100, 100, 1, 1, 1]
        c, s = np.cos(ANGLE + psi), np.sin(ANGLE + psi)
        N, V_y, V_z = rigid(D_M, wrench, c, s)
        R = D_M / 2
        resultant = [N.sum(), V_y.sum(), V_z.sum(), (R * (c * V_z - s * V_y)).sum(), (R * s * N).sum(), (-R * c * N).sum()]
        np.testing.assert_allclose(resultant, wrench, rtol=1e-12, atol=1e-12)


def test_rigid_share_of_a_moment_is_linear_in_the_lever(rigid):
    """M_y alone: N = M_y r_z / sum r_z^2 (plane stays plane)."""
    N, V_y, V_z = rigid(D_M, [0, 0, 0, 0, 1.5, 0], np.cos(ANGLE), np.sin(ANGLE))
    r_z = D_M / 2 * np.sin(ANGLE)
    np.testing.assert_allclose(N, 1.5 * r_z / (r_z**2).sum(), atol=1e-12)
    assert not np.any(V_y) and not np.any(V_z)


def test_flexible_share_is_circulant(flexible):
    """A force moved on by one pocket moves the answer on by one rivet, to the bit."""
    rng = np.random.default_rng(2)
    matrix, forces = rng.normal(size=(Z, 5, 3)), rng.normal(size=(3, Z))
    moved = flexible(matrix, 1, *np.roll(forces, 1, axis=1))
    np.testing.assert_allclose(moved, np.roll(flexible(matrix, 1, *forces), 1, axis=0), rtol=1e-12, atol=1e-12)  # order of sums


def test_flexible_share_reads_the_matrix(flexible):
    """A unit force at pocket 2 shows column f of the matrix at relative index (k - 2) mod Z."""
    matrix = np.arange(Z * 15, dtype=float).reshape(Z, 5, 3)
    for f in range(3):
        forces = np.zeros((3, Z))
        forces[f, 2] = 1.0
        np.testing.assert_array_equal(flexible(matrix, 1, *forces), np.roll(matrix[:, :, f], 2, axis=0))


def test_opposite_walls_are_mirror_images(flexible):
    """F_t and -F_t on pocket 0: rivet i answers like rivet -1 - i, V_t and M_r (pseudovector) with the other sign; continuous through 0."""
    matrix, forces = np.random.default_rng(5).normal(size=(Z, 5, 3)), np.zeros((3, Z))
    forces[2, 0] = 2.0
    plus, minus = flexible(matrix, 1, *forces), flexible(matrix, 1, *-forces)
    np.testing.assert_array_equal(minus, plus[::-1] * [1, 1, -1, -1, 1])


def test_mirrored_halves(flexible):
    """Mirrored forces on the other half: the same N and M, opposite V, so equal forces on both leave no V."""
    rng = np.random.default_rng(3)
    matrix, (F_x, F_r, F_t) = rng.normal(size=(Z, 5, 3)), rng.normal(size=(3, Z))
    plus, minus = flexible(matrix, 1, F_x, F_r, F_t), flexible(matrix, -1, -F_x, F_r, F_t)
    np.testing.assert_array_equal(plus[:, [0, 3, 4]], minus[:, [0, 3, 4]])
    np.testing.assert_array_equal(plus[:, 1:3], -minus[:, 1:3])


def test_twins(flexible):
    """C and Python agree to the order of their sums (observed 4e-16)."""
    rng = np.random.default_rng(4)
    matrix, forces = rng.normal(size=(Z, 5, 3)), rng.normal(size=(3, Z))
    np.testing.assert_allclose(flexible(matrix, -1, *forces), load_path.load_path_flexible(matrix, -1, *forces), rtol=1e-13, atol=1e-13)
