"""How far a run's statistics are from converged ones: the error of the step, and the scatter of the seeds.

From n runs x of the default with different seeds, and m finer runs y on the first m seeds.  Where the tolerance limits the steps, which
shows in steps that failed the error test, finer is a tenth of it.  Elsewhere finer are equal steps (solver.method = fixed), sqrt(3) times
shorter than they are on average: an error of second order falls to a third.

    V      variance of a run about the long run, of the seeds or of the blocks of a run (spread_of)
    b      mean of y - x, the numerical bias of x with the opposite sign; s_b its standard error
    w      tau^2/(tau^2 + s_b^2), tau^2 the larger of PRIOR^2 and b^2 - s_b^2: the share of b that is no scatter
    value  mean x + w b
    seeds  t [var(mean x + w b) + C]^(1/2)             C: common to all seeds, where they fall on one motion
    numerical  [z^2 (1 - w)^2 tau^2 + (w b)^2]^(1/2)   what b leaves open, and the bound of the finer run's own error; RESOLUTION at least

PRIOR is the standard deviation of the default's bias in the scenes of benchmarks/blind.py, known before any finer run.  The finer run's
own error is at most b if it is at most half of the plain run's: an order of 1.3.  Both half-widths add as the root of their squares.
t has fewer degrees of freedom where the seeds' scatter has heavy tails: the variance of a sample variance is
V^2 [2/(n-1) + K/n] with the excess kurtosis K, that of 2/[2/(n-1) + K/n] degrees of freedom of a normal law.
benchmarks/coverage.py measures how often the interval holds a reference.
"""

import math
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ..base.errors import UserError
from .fmu import Model
from .results import Result
from .runner import simulate
from .scene import Scene
from .seeds import seeded
from .summary import columns, has_statistics, settled

# name -> in words, unit, factor from SI; DECADES is a logarithm, the others are judged relative to their value
FIGURES = {
    "stress": ("99.9 % quantile of the worst head", "MPa", 1e-6),
    "static": ("mean of the worst head", "MPa", 1e-6),
    "pocket_force": ("RMS of the pocket force", "N", 1.0),
    "damage": ("damage of the worst place", "decades", 1.0),
}
DECADES = "damage"
NAMED = ("stress", "static", "pocket_force")  # what an accuracy in per cent is of
COLUMNS = {"stress": "stat.sigma_head_p999", "static": "stat.sigma_head_mean", "pocket_force": "stat.Q_c_rms"}
CHANNELS = ("rivet.sigma_head_max", "cage.F_pocket_peak")
# 95 % quantiles of 102 scenes over 1.96, of an earlier record: the newest ones are at most three quarters of the first three, none is known of damage
PRIOR = {"stress": 0.014, "static": 0.0065, "pocket_force": 0.039, "damage": 0.09}
# excess, of 24 seeds: mean of 38 scenes of benchmarks/coverage.py; the other figures are pooled with blocks
KURTOSIS = {DECADES: 2.3}
FINER, FINE_STEPS = 0.1, 1.05  # of the tolerance, and the least number of steps that it then takes over that before
SHORTER, SHORTEST = math.sqrt(3.0), 3  # of equal steps, times SHORTER
FEW = 1e-3  # share of steps that may fail the error test where the tolerance does not limit them
FINEST = 1e-5  # tolerance; below, other limits act
RESOLUTION = 1e-3  # of a value, or decades: less is never told
BLOCKS = 4  # of a run
CONFIDENCE = 0.9
LEVEL = 0.01  # of the tests of the seeds' scatter against that of the blocks
ONE_MOTION = 0.1  # variance of the seeds over that of the blocks, below which all seeds fall on one motion


@dataclass(frozen=True)
class Sample:
    """Figures of one run, the variance of each by its blocks, its processor time [s], steps, and the share that failed the error test."""

    values: dict
    blocks: dict
    cost: float
    steps: float = 0.0
    failed: float = 0.0
    result: Any = field(default=None, repr=False)


@dataclass(frozen=True)
class Found:
    """Value corrected by its bias, plain mean, shift, half-widths of seeds and step, whether one motion only."""

    value: float
    plain: float
    shift: float
    seeds: float
    numerical: float
    one_motion: bool
    runs: tuple

    @property
    def half(self):
        """Half-width of the interval about `value`."""
        return math.hypot(self.seeds, self.numerical)

    def record(self):
        """As JSON has it."""
        return vars(self) | {"half_width": self.half}

    def within(self, share):
        """Whether the interval is within a share of the value."""
        return self.half <= share * abs(self.value)


# One run --------------------------------------------------------------------------------------------------------------


def sample(model: Model, scene: Scene, whole: bool = False) -> Sample:
    """The Sample of a scene; UserError where it has no statistics.  whole: with the Result and all outputs of the scene."""
    parameters = dict(scene.parameters)
    if parameters.get("scene.stress", "peak") == "peak":
        parameters["scene.stress"] = "fatigue"  # counts damage, and leaves the motion as it is
    outputs = tuple(dict.fromkeys([*scene.outputs, *CHANNELS])) if whole else CHANNELS
    result = simulate(model, replace(scene, accuracy=None, parameters=parameters, outputs=outputs))
    found = sample_of(result, scene.name)
    return found if whole else replace(found, result=None)


def sample_of(result: Result, name: str = "the run", damage: float | None = None) -> Sample:
    """The Sample of a Result; damage: log10 per hour, where the FMU counted none."""
    summary = result.summary
    if result.stopped:
        raise UserError(f"{name}: no accuracy of a run that stopped: {result.stopped}")
    if not has_statistics(result) or not summary.get("stat.time") or result.parameters.get("scene.stress") == "off":
        raise UserError(
            f"{name}: no accuracy without statistics of stress after start.settle: a longer t_end is needed"
        )
    values = {figure: float(summary[column]) for figure, column in COLUMNS.items()}
    hours = (summary["simulated_time"] - result.parameters["start.settle"]) / 3600.0
    counted = max((value for key, value in summary.items() if "].damage_" in key), default=0.0)
    if counted > 0.0 or damage is not None:
        values[DECADES] = damage if damage is not None else math.log10(counted / hours)
    blocks = block_variances(result, values)
    blocks = {name: blocks[name] for name in values if name in blocks}
    return Sample(values, blocks, float(summary["cpu_time"]), *steps_of(summary), result)


def steps_of(summary: Any) -> tuple[float, float]:
    """Steps of a run, and the share that failed the error test."""
    steps = float(summary["solver.steps"])
    return steps, float(summary["solver.error_tests_failed"]) / max(steps, 1.0)


def block_variances(result: Result, values: dict[str, float]) -> dict[str, float]:
    """Variance of each figure by a run's BLOCKS; values: of the whole run, to which blocks' are scaled, as their quantiles lie
    lower and largest forces of all balls higher.
    """
    late, slope = settled(result), result.parameters["fatigue.k_2"]
    heads = [CHANNELS[0]] if CHANNELS[0] in result.data else columns(result, "rivet[", "].sigma_head_peak")
    if not heads or np.count_nonzero(late) < BLOCKS:
        return {}
    stress = np.array_split(np.max([result.data[name][late] for name in heads], axis=0), BLOCKS)
    kinds = {"stress": [np.quantile(x, 0.999) for x in stress], "static": [x.mean() for x in stress]}
    if CHANNELS[1] in result.data:
        force = np.array_split(result.data[CHANNELS[1]][late], BLOCKS)
        kinds["pocket_force"] = [math.sqrt(np.mean(x**2)) for x in force]
    found = {}
    for figure, blocks in kinds.items():
        mean = float(np.mean(blocks))
        scale = values.get(figure, mean) / mean if mean else 0.0
        found[figure] = float(scale**2 * np.var(blocks, ddof=1) / BLOCKS)
    swings = [np.quantile(x, 0.999) - np.mean(np.concatenate(stress)) for x in stress]
    if min(swings) > 0.0:
        found[DECADES] = float(np.var(slope * np.log10(swings), ddof=1) / BLOCKS)
    return found


# Several runs ---------------------------------------------------------------------------------------------------------


def spread_of(values: Any, blocks: Any, kurtosis: float = 0.0) -> tuple[float, float, float]:
    """Variance of a run about the long run, its degrees of freedom, and the part of it that is common to all seeds; kurtosis: excess of
    the seeds' scatter.

    Seeds and blocks tell the same where both are chance: then both count.  Seeds that scatter more have come to several
    motions; seeds that scatter less fall on one motion, whose change from block to block no seed shows.
    """
    from scipy import stats  # the extra full has it, an installation to simulate not

    n, own = len(values), float(np.var(values, ddof=1)) if len(values) > 1 else 0.0
    within, of_seeds = float(np.mean(blocks)) if len(blocks) else 0.0, 2.0 / (2.0 / max(n - 1, 1) + kurtosis / n)
    if not len(blocks) or within <= 0.0:
        return own, of_seeds, 0.0
    freedom = n * (BLOCKS - 1)
    if n < 2:
        return within, freedom, 0.0
    ratio, law = own / within, stats.f(n - 1, freedom)
    low, high = law.ppf(LEVEL), law.ppf(1.0 - LEVEL)
    if ratio < min(low, ONE_MOTION):
        return own, BLOCKS - 1, within - own
    if not low < ratio < high:
        return own, of_seeds, 0.0
    return ((n - 1) * own + freedom * within) / (n - 1 + freedom), n - 1 + freedom, 0.0


def found_of(figure: str, plain: Any, fine: Any = (), blocks: Any = (), confidence: float = CONFIDENCE) -> Found:
    """The Found of a figure: plain runs [n], finer ones on the first seeds [m], block variances of the plain."""
    from scipy import stats

    x, y = np.asarray(plain, float), np.asarray(fine, float)
    n, m, mean = len(x), len(y), float(np.mean(plain))
    size = 1.0 if figure == DECADES else abs(mean)
    V, freedom, common = spread_of(x, blocks, KURTOSIS.get(figure, 0.0))
    t, z = stats.t.ppf(0.5 + 0.5 * confidence, freedom), stats.norm.ppf(0.5 + 0.5 * confidence)
    tau, one = PRIOR[figure] * size, bool(common > 0.0)
    if not m:
        return Found(mean, mean, 0.0, float(t) * math.sqrt(V / n + common), float(z) * tau, one, (n, 0))
    d = y - x[:m]
    b, of_pair, shared = float(d.mean()), 2.0 * V, -V
    if m > 2:
        of_pair, shared = float(np.var(d, ddof=1)), float(np.cov(x[:m], d)[0, 1])
    s2 = of_pair / m
    tau2 = max(tau**2, b**2 - s2)
    w = tau2 / (tau2 + s2) if s2 > 0.0 else 1.0
    variance = max(V / n + w**2 * s2 + 2.0 * w * shared / n, 0.0) + common
    left = max(math.hypot(float(z) * (1.0 - w) * math.sqrt(tau2), w * b), RESOLUTION * size)
    return Found(mean + w * b, mean, w * b, float(t) * math.sqrt(variance), left, one, (n, m))


def found_in(plain: Any, fine: Any = (), confidence: float = CONFIDENCE) -> dict[str, Found]:
    """The Found of each figure that all Samples have."""
    names = [name for name in FIGURES if all(name in run.values for run in [*plain, *fine])]
    found = {}
    for name in names:
        x, y = ([run.values[name] for run in runs] for runs in (plain, fine))
        found[name] = found_of(name, x, y, [run.blocks[name] for run in plain if name in run.blocks], confidence)
    return found


# To an accuracy -------------------------------------------------------------------------------------------------------

SURE = 0.95  # confidence of an accuracy that is reached
LEVELS = 3  # of the steps, each finer than the one before it
WITHIN = 600.0  # s of processor time, unless more is allowed
GROWTH = 2.0  # of the runs in a round
ENOUGH = 4  # runs from which on their scatter is believed
FALLS = 0.8  # largest share of a bias that shorter steps may leave, else it does not fall


@dataclass(frozen=True)
class Reached:
    """Target, settings and mean length [s] of the steps, Found by figure, why some missed, the plain run, Result, Samples
    (plain, finer) and processor time [s].
    """

    target: float
    settings: dict
    step: float
    found: dict
    missed: dict
    plain: Sample
    result: Any = field(repr=False)
    samples: tuple = field(repr=False)
    seconds: float

    @property
    def cost(self):
        """Processor time over that of a plain run."""
        return self.seconds / max(self.plain.cost, 1e-9)

    def record(self):
        """As JSON has it."""
        return {
            "target": self.target,
            "confidence": SURE,
            "settings": self.settings,
            "step": self.step,
            "cost": self.cost,
            "figures": {
                name: each.record() | {"plain_run": self.plain.values[name]} for name, each in self.found.items()
            },
            "missed": self.missed,
        }


class Runs:
    """Samples of a scene by seed and level of the steps, simulated when they are asked for."""

    def __init__(self, model, scene, progress):
        self.model, self.progress, self.scenes, self.settings = model, progress, [scene], [{}]
        self.first = int(scene.value("start.seed", model))
        self.done, self.seconds = {}, 0.0

    def __call__(self, level, count):
        """The first samples of a level."""
        for s in range(count):
            scene = self.scene(level)
            if (level, s) not in self.done:
                self.done[level, s] = self.run(scene, s)
        return [self.done[level, s] for s in range(count)]

    def scene(self, level):
        """The scene with the steps of a level: the first finer ones that prove to be finer."""
        while len(self.scenes) <= level:
            above = self(len(self.scenes) - 1, 1)[0]
            at = lambda settings: self.run(with_settings(self.scenes[0], settings), 0)
            settings, found = finer_settings(self.model, self.scenes[-1], above, at)
            self.done[len(self.scenes), 0] = found
            self.scenes.append(with_settings(self.scenes[0], settings))
            self.settings.append(settings)
        return self.scenes[level]

    def run(self, scene, s):
        """The Sample of a scene with a seed, that of the first seed with its Result; its processor time counts."""
        found = sample(self.model, seeded(scene, self.model, self.first, s), s == 0)
        self.seconds += found.cost
        self.progress(len(self.done) + 1)
        return found


def with_settings(scene: Scene, settings: dict[str, Any]) -> Scene:
    """A scene with other steps."""
    return replace(scene, tolerance=None, parameters=scene.parameters | settings) if settings else scene


def finer_settings(model: Model, scene: Scene, above: Sample, run: Any) -> tuple[dict[str, Any], Sample]:
    """Parameters of the first finer steps than the scene's, and run(them); above: the scene's own Sample."""
    for settings in shorter_steps(model, scene, above):
        found = run(settings)
        limited = found.failed > max(above.failed, FEW)
        if found.steps >= FINE_STEPS * above.steps and not ("solver.step" in settings and limited):
            break
    return settings, found


def shorter_steps(model, scene, above):
    """Parameters with which steps may be shorter than those of a scene's Sample."""
    tolerance = float(scene.tolerance or scene.value("solver.tol", model))
    if above.failed > FEW and tolerance * FINER >= FINEST:
        yield {"solver.tol": tolerance * FINER}
    for shorter in range(1, SHORTEST + 1):
        yield {"solver.method": "fixed", "solver.step": scene.t_end / above.steps / SHORTER**shorter}


def accurate(
    model: Model, scene: Scene, target: float, within: float = WITHIN, progress: Any = lambda runs: None
) -> Reached:
    """Run until the NAMED figures are within `target` of their values or no runs help, by more of them or by shorter steps where
    the bias decides; UserError where it takes longer than `within` [s].
    """
    runs, level, n, m, before = Runs(model, scene, progress), 0, 2, 1, {}
    while True:
        plain, fine = runs(level, n), runs(level + 1, m)
        found = {name: each for name, each in found_in(plain, fine, SURE).items() if name in NAMED}
        wide = {name: each for name, each in found.items() if each.value and not each.within(target)}
        missed = {name: why for name, each in wide.items() if (why := no_way(each, target, before.get(name), level))}
        open_ones = {name: each for name, each in wide.items() if name not in missed}
        if not open_ones:
            break
        if level + 1 < LEVELS and any(
            abs(each.shift) > 0.7 * target * abs(each.value) for each in open_ones.values() if is_bias(each)
        ):
            before, level, m = {name: each.shift for name, each in found.items()}, level + 1, 1
            continue
        needed = max(runs_needed(each, target) for each in open_ones.values())
        each_costs = runs.seconds / len(runs.done) * 1.5
        if needed * each_costs > within and n >= ENOUGH:
            name, each = max(open_ones.items(), key=lambda item: item[1].half / abs(item[1].value))
            raise UserError(
                f"accuracy {100 * target:g} %: {FIGURES[name][0]} is known to {100 * each.half / abs(each.value):.2g} % after {len(runs.done)} "
                f"runs; {100 * target:g} % would take about {needed:,.0f} seeds, {needed * each_costs:,.0f} s of processor time, and {within:,.0f} s are "
                f"allowed: {100 * target * math.sqrt(needed / max(within / each_costs, 1.0)):.2g} % can be reached, or a longer time (within)"
            )
        n = int(max(n + 1, min(math.ceil(needed), GROWTH * n)))
        m = (n + 1) // 2
    step, first = scene.t_end / plain[0].steps, runs(0, 1)[0]
    chosen = target, runs.settings[level], step, found, missed
    return Reached(*chosen, first, plain[0].result, (plain, fine), runs.seconds)


def is_bias(each):
    """Whether the shift is more than scatter."""
    return abs(each.shift) > each.seeds


def runs_needed(each, target):
    """Runs with which the scatter would be narrow enough beside the bias."""
    bias = abs(each.shift) if is_bias(each) else 0.0  # of the finer run's own error, which no seeds reduce
    room = (target * abs(each.value)) ** 2 - bias**2
    return each.runs[0] * (each.half**2 - bias**2) / room if room > 0.0 else GROWTH * each.runs[0]


def no_way(each, target, before, level):
    """Why no further runs bring a figure within the target, "" if they may."""
    share = 100.0 / abs(each.value)
    if each.one_motion and each.seeds > target * abs(each.value):
        return f"all seeds fall on one motion, which changes by {share * each.seeds:.2g} % from block to block: a longer t_end shows more of it"
    if is_bias(each) and abs(each.shift) > target * abs(each.value):
        if before and abs(each.shift) > FALLS * abs(before):
            return f"its bias of {share * abs(before):.2g} % does not fall with the step: {share * abs(each.shift):.2g} % is left at shorter ones"
        if level + 1 >= LEVELS:
            return f"its bias is still {share * abs(each.shift):.2g} % with the shortest steps"
    return ""
