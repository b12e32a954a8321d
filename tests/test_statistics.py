"""Running statistics against numpy on the whole sample, and against an instance's own history."""

import numpy as np
import pytest
from mechanics import Instance

from bearing_model.generated.variables import Method, Switch

FLOOR = 1e-3
BIN = 1.0 / 64.0  # of the lower edge, at most


def channel(core, values, weights):
    """Of steps within which the value does not change."""
    c = core.new("StatisticsChannel")
    for value, weight in zip(values, weights, strict=True):
        core.lib.statistics_add(c, FLOOR, weight, value, value)
    return c


def channel_of(core, t, values):
    """Of steps from each time to the next one."""
    c = core.new("StatisticsChannel")
    for h, before, now in zip(np.diff(t), values[:-1], values[1:], strict=True):
        core.lib.statistics_add(c, FLOOR, h, before, now)
    return c


def weighted_quantile(values, weights, p):
    order = np.argsort(values)
    return values[order][np.searchsorted(np.cumsum(weights[order]), p * weights.sum())]


@pytest.mark.parametrize("kind", ["lognormal", "pulses", "constant"])
def test_against_the_whole_sample(core, kind):
    """Mean and RMS to rounding, quantiles to a bin's width (1.6 %), of 50,000 weighted samples."""
    rng = np.random.default_rng(1)
    n = 50_000
    values = {
        "lognormal": np.exp(rng.normal(1.0, 2.0, n)),
        "pulses": np.where(rng.uniform(size=n) < 0.09, rng.exponential(30.0, n), 0.0),
        "constant": np.full(n, 12.3),
    }[kind]
    weights = rng.uniform(1e-6, 1e-5, n)
    c = channel(core, values, weights)
    assert c.time == pytest.approx(weights.sum(), rel=1e-11)
    assert core.lib.statistics_mean(c) == pytest.approx(np.average(values, weights=weights), rel=1e-11)
    assert core.lib.statistics_rms(c) == pytest.approx(np.sqrt(np.average(values**2, weights=weights)), rel=1e-11)
    assert c.max == values.max()
    for p in (0.5, 0.9, 0.99, 0.999):
        exact = weighted_quantile(values, weights, p)
        assert core.lib.statistics_quantile(c, FLOOR, p) == pytest.approx(exact, rel=BIN, abs=FLOOR)


def test_steps_of_unequal_lengths_weigh_by_the_trapezoidal_rule(core):
    """Mean and RMS as numpy's trapezoidal rule has them; the quantile of pulses whose rise has short steps and whose fall
    long ones is that of the pulses.

    Half sines of height 1: for the part a of its time each is above cos(a pi/2).  The rise has four
    times as many steps as the fall.  Mean and RMS to rounding tell these weights from those of the values at the ends alone.
    """
    rise, fall = np.linspace(0.0, 0.5, 2001), np.linspace(0.5, 1.0, 501)[1:]
    phase = np.concatenate([rise, fall, [10.0]])
    t = np.concatenate([period * 10.0 + phase[: len(phase) - 1] for period in range(3)])
    values = np.maximum(np.sin(np.pi * (t % 10.0)) * (t % 10.0 <= 1.0), 0.0)
    c = channel_of(core, t, values)
    assert c.time == pytest.approx(t[-1] - t[0], rel=1e-12)
    assert core.lib.statistics_mean(c) == pytest.approx(np.trapezoid(values, t) / c.time, rel=1e-12)
    assert core.lib.statistics_rms(c) == pytest.approx(np.sqrt(np.trapezoid(values**2, t) / c.time), rel=1e-12)
    pulses = 3.0 / c.time  # part of the time
    for above in (0.2, 0.1, 0.05):
        exact = np.cos(0.5 * np.pi * above)
        assert core.lib.statistics_quantile(c, FLOOR, 1.0 - above * pulses) == pytest.approx(exact, rel=2e-3)


def test_quantile_is_linear_inside_a_bin(core):
    """Uniform values: the quantiles are those of the uniform law far better than a bin: 1 % of one, observed 3e-5."""
    values = np.linspace(1.0, 2.0, 20_001)
    c = channel(core, values, np.ones_like(values))
    for p in (0.1, 0.37, 0.5, 0.9):
        assert core.lib.statistics_quantile(c, FLOOR, p) == pytest.approx(1.0 + p, abs=0.01 * BIN)


def test_zeros_and_an_empty_channel(core):
    c = channel(core, [], [])
    assert (
        core.lib.statistics_mean(c)
        == core.lib.statistics_rms(c)
        == core.lib.statistics_quantile(c, FLOOR, 0.999)
        == 0.0
    )
    c = channel(core, [0.0, 0.0, 8.0], [1.0, 1.0, 2.0])
    assert core.lib.statistics_mean(c) == 4.0
    assert core.lib.statistics_quantile(c, FLOOR, 0.4) == 0.0


def test_values_beyond_the_range_go_into_the_last_bin(core):
    c = channel(core, [1e9, 2e9], [1.0, 1.0])
    assert c.max == 2e9
    assert core.lib.statistics_quantile(c, FLOOR, 0.999) <= 2e9


def test_statistics_of_a_run(core):
    """stat.* after 2 ms against a history sampled at 1e-6 s, well below the step of 8e-6 s; settle and pooling count.

    Steps end at communication points, so both samples are the same: values at the ends of accepted steps, each for half of
    the two steps there.  Observed 1e-12.
    """
    bearing = Instance(
        core,
        {
            "scene.statistics": Switch.ON,
            "start.settle": 5e-4,
            "cage.pocket_clearance": 7e-5,
            "solver.method": Method.EXPLICIT,
        },
    )
    history, t = [], np.arange(1, 2001) * 1e-6
    for time in t:
        bearing.step(time)
        history.append(
            [
                *bearing.output("ball.Q_c"),
                bearing.output("cage.omega"),
                bearing.output("cage.eccentricity"),
                bearing.output("cage.dislocation"),
            ]
        )
    history, counts = np.array(history), np.flatnonzero(t >= 5e-4)
    omega, eccentricity, dislocation = history[counts, 9:].T
    weight = np.diff(t, prepend=0.0)[counts]
    Q_c, half = history[counts[0] - 1 : counts[-1] + 1, :9], np.zeros(len(counts) + 1)
    half[:-1] += 0.5 * weight
    half[1:] += 0.5 * weight
    assert bearing.output("stat.time") == pytest.approx(weight.sum(), rel=1e-9)
    assert bearing.output("stat.Q_c_mean") == pytest.approx(np.average(Q_c.mean(1), weights=half), rel=1e-9)
    assert bearing.output("stat.Q_c_rms") == pytest.approx(
        np.sqrt(np.average((Q_c**2).mean(1), weights=half)), rel=1e-9
    )
    assert bearing.output("stat.Q_c_max") == Q_c.max() > 0.0
    assert bearing.output("stat.contact_duty") == pytest.approx(np.average((Q_c > 0.0).mean(1), weights=half), rel=1e-9)
    assert bearing.output("stat.cage_omega") == pytest.approx(np.average(omega, weights=weight), rel=1e-9)
    assert bearing.output("stat.eccentricity") == pytest.approx(np.average(eccentricity, weights=weight), rel=1e-9)
    assert bearing.output("stat.dislocation_max") == dislocation.max()
    pooled, weights = Q_c.T.ravel(), np.tile(half, 9)
    exact = weighted_quantile(pooled, weights, 0.999)
    assert bearing.output("stat.Q_c_p999") == pytest.approx(exact, rel=BIN, abs=FLOOR)


def test_peak_is_the_largest_since_the_last_point(core):
    """cage.F_pocket_peak over a communication step of 1e-4 s against the largest of all its internal steps."""
    tight = {"cage.pocket_clearance": 4e-5}  # contacts from the start
    fine, coarse = (Instance(core, tight, tolerance=1e-6) for _ in range(2))
    t, largest = 0.0, 0.0
    for _ in range(20):
        coarse.step(t + 1e-4)
        peak, before = 0.0, fine.output("cage.F_pocket_max")
        for n in range(1, 101):
            fine.step(t + n * 1e-6)
            peak = max(peak, fine.output("cage.F_pocket_max"))
        t += 1e-4
        largest = max(largest, peak)
        # Other steps, the same 2 ms: before chaos parts them.  A force that falls from the last point on has its
        # largest value between that point and the
        # first step, whose lengths differ.
        assert 0.98 * peak - 0.05 <= coarse.output("cage.F_pocket_peak") <= 1.02 * max(peak, before) + 0.05
        # The peak is that of the steps' own evaluations, which are before the step corrects its positions; observed
        # 5e-6 below.
        assert coarse.output("cage.F_pocket_peak") >= (1.0 - 1e-4) * coarse.output("cage.F_pocket_max")
    assert largest > 10.0
