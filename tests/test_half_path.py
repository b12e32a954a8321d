"""From pocket forces to bonded joints: equilibrium of the rigid share, symmetry and smoothness of the half's; both
twins alike.
"""

from types import SimpleNamespace

import numpy as np
import pytest

from bearing_model.cage.two_half import half_path
from bearing_model.generated.variables import Z
from bearing_model.physics.derived import default_table
from rivet_model import embed
from rivet_model.half_loads import bolt_group

D_M = 53.5e-3
ANGLE = 2 * np.pi * (np.arange(Z) + 0.5) / Z
MIRROR, SIDE = half_path.PATH_MIRROR, half_path.PATH_SIDE


def doubles(ffi, values):
    """A C array, with zeros behind it as packets of pockets need them."""
    values = np.ravel(values)
    return ffi.new(f"double[{len(values) + 8}]", values.tolist())


@pytest.fixture(params=["C", "Python"])
def rows(request, core):
    """(side, push [2, Z], force [3, Z]) -> rows [Z, 8] of the shipped table."""
    if request.param == "Python":
        return lambda side, push, force: half_path.half_path_rows(default_table().half, side, push, force)
    ffi, lib = core.ffi, core.lib

    def call(side, push, force):
        both, kept, found = core.new("PathForces", 2), [], core.new("ball_array", 8)
        for h in range(2):
            acts = 1.0 if 2 * h - 1 == side else 0.0
            for name, values in zip(("F_x", "F_r", "F_t", "push_x", "push_t"), (*force, *push), strict=True):
                kept.append(doubles(ffi, acts * values))
                setattr(both[h], name, kept[-1])
        touched = core.model().kernel("half_path_rows")(ffi.addressof(lib.rivet_table.half, "path"), both, found)
        assert touched == bool(np.any(force))
        return np.array([list(found[i])[:Z] for i in range(8)]).T if touched else np.zeros((Z, 8))

    return call


def random_forces(rng, touched=Z):
    """Forces on some pockets, most of them along the wall's normal."""
    push, force = rng.normal(size=(2, Z)) * 50.0, rng.normal(size=(3, Z)) * 5.0
    force[0] += push[0]
    force[2] += push[1]
    idle = rng.permutation(Z)[touched:]
    push[:, idle] = force[:, idle] = 0.0
    return push, force


def test_rigid_share_carries_the_wrench():
    """Resultant of all rivets = the wrench, at any rotation of the circle (rounding; observed 1e-15)."""
    rng = np.random.default_rng(1)
    for psi in (0.0, 0.3, 2.0):
        wrench = rng.normal(size=6) * [100, 100, 100, 1, 1, 1]
        c, s = np.cos(ANGLE + psi), np.sin(ANGLE + psi)
        N, V_y, V_z = bolt_group(D_M, wrench, c, s)
        R = D_M / 2
        resultant = [
            N.sum(),
            V_y.sum(),
            V_z.sum(),
            (R * (c * V_z - s * V_y)).sum(),
            (R * s * N).sum(),
            (-R * c * N).sum(),
        ]
        np.testing.assert_allclose(resultant, wrench, rtol=1e-12, atol=1e-12)


def test_rigid_share_of_a_moment_is_linear_in_the_lever():
    """M_y alone: N = M_y r_z / sum r_z^2 (plane stays plane)."""
    N, V_y, V_z = bolt_group(D_M, [0, 0, 0, 0, 1.5, 0], np.cos(ANGLE), np.sin(ANGLE))
    r_z = D_M / 2 * np.sin(ANGLE)
    np.testing.assert_allclose(N, 1.5 * r_z / (r_z**2).sum(), atol=1e-12)
    assert not np.any(V_y) and not np.any(V_z)


def test_rows_at_the_nodes_are_those_of_the_finite_elements(rows):
    """A unit force at pocket 2 that pushes the wall at a node's angle shows the matrix at relative index (k - 2) mod Z
    (float32 of four digits).
    """
    half = default_table().half
    for node, chi in enumerate(half.chi):
        for f in range(3):
            push, force = np.zeros((2, Z)), np.zeros((3, Z))
            push[:, 2] = np.sin(chi), np.cos(chi)
            force[f, 2] = 1.0
            np.testing.assert_allclose(
                rows(1, push, force), np.roll(half.path[node, :, :, f], 2, axis=0), rtol=1e-9, atol=1e-9
            )


def test_rows_are_circulant_linear_and_homogeneous(rows):
    """A force moved on by one pocket moves the answer on by one rivet; pockets add; twice the force is twice the load
    (order of sums: 1e-12).
    """
    rng = np.random.default_rng(2)
    push, force = random_forces(rng)
    found = rows(1, push, force)
    tolerance = {"rtol": 1e-12, "atol": 1e-12}
    np.testing.assert_allclose(
        rows(1, np.roll(push, 1, axis=1), np.roll(force, 1, axis=1)), np.roll(found, 1, axis=0), **tolerance
    )
    np.testing.assert_allclose(rows(1, 2.0 * push, 2.0 * force), 2.0 * found, **tolerance)
    each = [rows(1, push * (np.arange(Z) == j), force * (np.arange(Z) == j)) for j in range(Z)]
    np.testing.assert_allclose(sum(each), found, **tolerance)


def test_opposite_walls_are_mirror_images(rows):
    """Forces on pocket 0 mirrored at its plane: rivet i answers like rivet -1 - i, V_t, M_r and dm_r with the other
    sign.
    """
    push, force = (v * (np.arange(Z) == 0) for v in random_forces(np.random.default_rng(5)))
    push[1] = np.abs(push[1])
    front, back = rows(1, push, force), rows(1, push * [[1], [-1]], force * [[1], [1], [-1]])
    np.testing.assert_allclose(back, front[::-1] * MIRROR, rtol=1e-12, atol=1e-12)


def test_mirrored_halves(rows):
    """Mirrored forces on the other half: the same rows but for V, which is opposite, so equal forces on both leave no
    V.
    """
    push, force = random_forces(np.random.default_rng(3))
    front, back = rows(1, push, force), rows(-1, push * [[-1], [1]], force * [[-1], [1], [1]])
    np.testing.assert_allclose(back, front * SIDE, rtol=1e-12, atol=1e-12)


def test_rows_are_smooth_over_the_angle(rows):
    """No jump of value or slope at a node, at the split (push_x = 0) and at the bottom (push_t = 0): differences over
    1e-5 rad beside the curvature's share.
    """
    half, h = default_table().half, 1e-5

    def at(chi):
        push, force = np.zeros((2, Z)), np.zeros((3, Z))
        push[:, 0] = np.sin(chi), np.cos(chi)
        force[:, 0] = np.sin(chi), 0.3, np.cos(chi)
        return rows(1, push, force)

    for chi in half.chi[1:-1]:
        jump = at(chi + h) - 2.0 * at(chi) + at(chi - h)
        assert np.abs(jump).max() < 1e-3 * np.abs(at(chi + h) - at(chi - h)).max()
    np.testing.assert_allclose(at(np.pi / 2 + h), at(np.pi / 2 - h), atol=5e-4 * np.abs(at(np.pi / 2)).max())


def test_twins(core, rows):
    """C and Python agree to the order of their sums, with some and with all pockets touched (observed 3e-15 of the
    largest).
    """
    rng = np.random.default_rng(4)
    for touched in (0, 1, 2, 5, Z):
        for side in (-1, 1):
            push, force = random_forces(rng, touched)
            expected = half_path.half_path_rows(default_table().half, side, push, force)
            np.testing.assert_allclose(
                rows(side, push, force), expected, rtol=1e-12, atol=1e-12 * max(np.abs(expected).max(), 1e-9)
            )


# ------------------------------------------------------------------------------------------------------------- ribbons


def ribbon_half():
    """A ribbon's path of random rows: three radii, angles from a seam on."""
    rng = np.random.default_rng(11)
    chi, radii = np.append(np.linspace(0.3, 1.4, 5), np.pi / 2), np.array([24.2e-3, 26.7e-3, 29.2e-3])
    path = rng.normal(size=(3, len(chi), Z, 8, 3)).astype(np.float32).astype(float)
    # the bottom's rows are their own mirror image
    path[:, -1] = 0.5 * (path[:, -1] + path[:, -1, ::-1] * half_path.PATH_MIRROR[:, None] * [1.0, 1.0, -1.0])
    path = path.astype(np.float32).astype(float)
    slope = np.stack([half_path.path_slopes(chi, one) for one in path]).astype(np.float32).astype(float)
    return SimpleNamespace(chi=chi, radii=radii, path=path, path_slope=slope)


def c_ribbon_rows(core, half, side, push, force, radius):
    """Rows [Z, 8] of that half by the C core."""
    ffi, both, found = core.ffi, core.new("PathForces", 2), core.new("ball_array", 8)
    numbers = np.ascontiguousarray(embed.path_rows(half), dtype=np.float32)
    kept = [ffi.from_buffer("float[]", numbers), doubles(ffi, half.chi), doubles(ffi, half.radii)]
    members = {"nodes": len(half.chi), "chi": kept[1], "rows": kept[0], "radii": len(half.radii), "radius": kept[2]}
    path = ffi.new("HalfPath *", members)
    for h in range(2):
        acts = 1.0 if 2 * h - 1 == side else 0.0
        for name, values in zip(
            ("F_x", "F_r", "F_t", "push_x", "push_t", "radius"), (*force, *push, radius), strict=True
        ):
            kept.append(doubles(ffi, acts * values))
            setattr(both[h], name, kept[-1])
    assert core.model().kernel("half_path_rows")(path, both, found)
    return np.array([list(found[i])[:Z] for i in range(8)]).T


@pytest.mark.parametrize("side", [-1, 1])
def test_rows_over_the_sphere_of_a_ribbon(core, side):
    """Both twins alike at places inside and outside of the nodes; at a node the rows are the table's."""
    half, rng = ribbon_half(), np.random.default_rng(12)
    push, force = random_forces(rng)
    radius = rng.uniform(23.5e-3, 30e-3, Z)
    expected = half_path.half_path_rows(half, side, push, force, radius)
    assert np.abs(expected).max() > 10.0
    found = c_ribbon_rows(core, half, side, push, force, radius)
    np.testing.assert_allclose(found, expected, rtol=1e-11, atol=1e-9)

    for node, chi in enumerate(half.chi):
        for i, r in enumerate(half.radii):
            push, force = np.zeros((2, Z)), np.zeros((3, Z))
            push[:, 2], force[1, 2] = (np.sin(chi), np.cos(chi)), 1.0
            rows_there = half_path.half_path_rows(half, 1, push, force, np.full(Z, r))
            np.testing.assert_allclose(rows_there, np.roll(half.path[i, node, :, :, 1], 2, axis=0), atol=1e-9)


def test_radius_weights_are_a_parabola():
    """They add up to 1, return r and r^2, and their slopes are those by differences; clamped beyond the nodes."""
    radii, r = np.array([1.0, 1.4, 2.0]), np.linspace(1.05, 1.95, 19)
    weights, slopes = half_path.radius_weights(radii, r), half_path.radius_slopes(radii, r)
    for power in range(3):
        np.testing.assert_allclose(sum(w * a**power for w, a in zip(weights, radii, strict=True)), r**power, rtol=1e-13)
        by = sum(s * a**power for s, a in zip(slopes, radii, strict=True))
        np.testing.assert_allclose(by, power * r ** max(power - 1, 0), atol=1e-12)
    assert np.allclose(half_path.radius_weights(radii, np.array([0.5, 3.0])), [[1, 0], [0, 0], [0, 1]])
    assert not np.any(half_path.radius_slopes(radii, np.array([0.5, 3.0])))
