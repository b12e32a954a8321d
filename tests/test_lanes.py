"""Elementary functions against extended precision; the same bits on all instruction sets with a fused multiply-add, and
on all without.
"""

import itertools

import numpy as np
import pytest
from library import INSTRUCTION_SETS
from mechanics import pocket_loads, running_state

from bearing_model.generated.variables import STATE_SLICES, CageModel, Lubrication, Traction

extended = pytest.mark.skipif(
    np.finfo(np.longdouble).eps > 2e-19, reason="this machine's long double is no better than double"
)
N = 100_000


def relative_error(computed, exact):
    return float(np.max(np.abs((computed - exact) / exact)))


def uniform(low, high, seed=1):
    return np.random.default_rng(seed).uniform(low, high, N)


def instruction_sets(core):
    """Those that are built and that this processor has, the narrowest first."""
    order = ("generic", "neon", "sse2", "avx2", "avx512")
    best = core.ffi.string(core.lib.kernels_select().name).decode()
    return [isa for isa in order[: order.index(best) + 1] if hasattr(core.lib, f"rhs_{isa}")]


@pytest.fixture(params=INSTRUCTION_SETS)
def function(core, request):
    """The elementary functions by name: of the core ("generic") and of every instruction set of the kernels."""
    if request.param not in ("generic", *instruction_sets(core)):
        pytest.skip("not on this processor")
    return lambda name: getattr(core.lib, f"{name}_{request.param}")


@extended
def test_exp(core, function):
    """Errors as lanes.h states them; observed 1.3e-15."""
    for span in (1.0, 50.0, 700.0):
        x = uniform(-span, span)
        assert relative_error(core.map(function("test_exp"), x), np.exp(x.astype(np.longdouble))) < 3e-15


def test_exp_far_out(core, function):
    assert core.map(function("test_exp"), [0.0])[0] == 1.0
    assert core.map(function("test_exp"), [-1e4, -800.0]).tolist() == [0.0, 0.0]
    assert core.map(function("test_exp"), [800.0, 1e300]) == pytest.approx(np.exp(700.0), rel=1e-14)


@extended
def test_power_of_2(core, function):
    """Observed 1.5e-14, the polynomial's own error; integers are exact."""
    for span in (0.5, 50.0, 1000.0):
        x = uniform(-span, span)
        assert relative_error(core.map(function("test_power_of_2"), x), np.exp2(x.astype(np.longdouble))) < 2e-14
    whole = np.arange(-1020.0, 1020.0)
    assert (core.map(function("test_power_of_2"), whole) == np.exp2(whole)).all()
    assert core.map(function("test_power_of_2"), [-1e300, -1021.0]).tolist() == [2.0**-1020, 2.0**-1020]


@extended
def test_inv_sqrt(core, function):
    """Uniform in the exponent, and at the places of the largest first errors; observed 3e-16."""
    for x in (np.exp(uniform(-700.0, 700.0)), uniform(1.0, 4.0)):
        assert relative_error(core.map(function("test_inv_sqrt"), x), 1.0 / np.sqrt(x.astype(np.longdouble))) < 5e-16


@extended
def test_log(core, function):
    """Uniform in the exponent, and close to 1 where the logarithm vanishes; observed 7e-16."""
    x = np.exp(uniform(-700.0, 700.0))
    assert relative_error(core.map(function("test_log"), x), np.log(x.astype(np.longdouble))) < 3e-15
    direct, inverse = core.map(function("test_log2"), x, outputs=2)
    assert relative_error(direct, np.log(x.astype(np.longdouble))) < 3e-15
    assert relative_error(inverse, np.log((1.0 / x).astype(np.longdouble))) < 3e-15
    x = 1.0 + np.exp(uniform(-30.0, -1.0, 2)) * np.sign(uniform(-1.0, 1.0, 3))
    assert relative_error(core.map(function("test_log"), x), np.log(x.astype(np.longdouble))) < 3e-15


@extended
def test_sincos(core, function):
    """304 rad are reached in 0.4 s, 1e7 rad in 3.6 h; observed 2.0e-16."""
    for span in (4.0, 400.0, 1e7):
        x = uniform(-span, span)
        sine, cosine = core.map(function("test_sincos"), x, outputs=2)
        exact = x.astype(np.longdouble)
        assert np.max(np.abs(sine - np.sin(exact))) < 3e-16
        assert np.max(np.abs(cosine - np.cos(exact))) < 3e-16


@extended
def test_atan(core, function):
    """Observed 3.8e-15."""
    x = np.exp(uniform(-40.0, 40.0)) * np.sign(uniform(-1.0, 1.0, 2))
    assert relative_error(core.map(function("test_atan"), x), np.arctan(x.astype(np.longdouble))) < 1e-14


@extended
def test_powers_and_arcsine(core):
    """Errors as elementary.h states them: those of exp and log times |y ln x|; observed 1.0e-15, 1.7e-16, 3.9e-15."""
    x = np.exp(uniform(-30.0, 30.0))
    exact = x.astype(np.longdouble)
    for y in (-1.5, 0.067, 5.0):
        scale = 1.0 + np.abs(y * np.log(x))
        assert np.max(np.abs(core.map(core.lib.test_pow, x, y) / exact**y - 1.0) / scale) < 3e-15
    assert relative_error(core.map(core.lib.test_cbrt, x), np.cbrt(exact)) < 5e-16
    wide = np.exp(uniform(-700.0, 700.0))
    assert relative_error(core.map(core.lib.test_rcbrt, wide), 1.0 / np.cbrt(wide)) < 2e-5
    sine = uniform(-0.99, 0.99)
    # of atan, and of its argument
    assert relative_error(core.map(core.lib.test_asin, sine), np.arcsin(sine.astype(np.longdouble))) < 1.1e-14
    zeros = [
        core.map(core.lib.test_pow, [0.0], 0.3)[0],
        core.map(core.lib.test_cbrt, [0.0])[0],
        core.map(core.lib.test_asin, [0.0])[0],
    ]
    assert zeros == [0.0, 0.0, 0.0]


def test_inverse_functions(core, function):
    """exp(log x) = x and sin^2 + cos^2 = 1: holds without a reference."""
    x = np.exp(uniform(-5.0, 5.0))
    assert relative_error(core.map(function("test_exp"), core.map(function("test_log"), x)), x) < 5e-15
    sine, cosine = core.map(function("test_sincos"), uniform(-400.0, 400.0), outputs=2)
    assert np.max(np.abs(sine**2 + cosine**2 - 1.0)) < 1e-15


# ----------------------------------------------------------------------------------------------------- instruction sets


def verlet_step(core, m, y):
    """All bits of a step of 8 us from y."""
    start = core.new("VerletState")
    start.y[0 : m.states], start.f[0 : m.states] = list(y), list(m.rhs(0.0, y))
    end, error = m.verlet(0.0, 8e-6, start, np.ones(m.states))
    return np.concatenate([list(end.y), list(end.f), list(end.jerk), [error]])


FUSED = ("neon", "avx2", "avx512")


@pytest.mark.parametrize("lubrication", Lubrication)
@pytest.mark.parametrize("traction", Traction)
@pytest.mark.parametrize("cage", CageModel)
def test_instruction_sets(core, cage, traction, lubrication):
    """The same bits but for fused multiply-adds; with and without them to rounding.

    Rounding: twice what a change of each state in its last place does to dy/dt, the largest of six random ones in a
    block (observed 0.83 of it).
    """
    sets = instruction_sets(core)
    if len(sets) < 2:
        pytest.skip(f"this processor has {sets} only")
    scene = {"scene.cage": cage, "scene.traction": traction, "scene.lubrication": lubrication}
    models = [core.model(parameters=scene, isa=isa) for isa in sets]
    rng = np.random.default_rng(7)
    for _ in range(20):
        y = running_state(models[0], rng)
        results = [np.concatenate([m.rhs(0.0, y), [m.energy(y)], verlet_step(core, m, y)]) for m in models]
        closed = pocket_loads(models[0]).max()
        assert closed > 0.0
        assert np.isfinite(results[0]).all()
        for (isa, mine), (other, its) in itertools.pairwise(zip(sets, results, strict=True)):
            if (isa in FUSED) == (other in FUSED):
                assert mine.tobytes() == its.tobytes(), (isa, other, np.flatnonzero(mine != its))
        states = models[0].states
        first, last = results[0][:states], results[-1][:states]
        nearby = [models[0].rhs(0.0, y * (1.0 + np.finfo(float).eps * rng.integers(-1, 2, states))) for _ in range(6)]
        rounding = np.max(np.abs(np.array(nearby) - first), axis=0)
        for name, rows in STATE_SLICES.items():
            assert np.max(np.abs(last[rows] - first[rows])) <= 2.0 * np.max(rounding[rows]), (sets, name)
