"""Weibull law of lives, with suspensions, by surpyval: maximum likelihood, intervals by the Fisher matrix.

R(t) = exp(-(t/eta)^beta)        B10: life that 10 % do not reach, eta (-ln 0.9)^(1/beta)
"""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..base.errors import UserError, library
from ..base.units import hours_text
from ..show.style import FORCE, HEAD, MIDDLE, few_ticks, picture


@dataclass(frozen=True)
class Weibull:
    """beta, eta, b10 [h] with intervals at `confidence`; failures: lives [h] with their median ranks."""

    beta: float
    eta: float
    b10: float
    beta_interval: tuple
    eta_interval: tuple
    b10_interval: tuple
    confidence: float
    lives: np.ndarray
    ranks: np.ndarray

    def record(self):
        """As a document for JSON."""
        keys = {"beta": "beta", "eta": "eta_h", "b10": "b10_h"}
        ends = {f"{key}_interval": list(getattr(self, f"{name}_interval")) for name, key in keys.items()}
        return {key: getattr(self, name) for name, key in keys.items()} | ends


def fit_weibull(lives, suspended=(), counts=None, confidence=0.9):
    """The Weibull law of lives [h] and running times of survivors [h]; counts: units at each time, lives first, None: one each.
    UserError with fewer than three failures, times not positive, or without surpyval.
    """
    surpyval = library("surpyval", "a Weibull law")
    lives, suspended = np.asarray(lives, float), np.asarray(suspended, float)
    times = np.concatenate([lives, suspended])
    if len(lives) < 3 or np.ptp(lives) == 0.0:
        raise UserError(f"a Weibull law needs at least three different lives, got {len(lives)}")
    if not np.all(np.isfinite(times)) or times.min() <= 0.0:
        raise UserError("a Weibull law needs times that are finite and greater than 0")
    unit = np.exp(np.log(lives).mean())  # the optimizer starts near 1
    counts = np.ones(len(times), int) if counts is None else np.asarray(counts)
    censored = np.repeat([0, 1], [len(lives), len(suspended)])
    found = surpyval.Weibull.fit(x=times / unit, c=censored, n=counts)
    alpha = 1.0 - confidence
    eta, beta = found.params
    drawn = found.get_plot_data(heuristic="Median")
    failed = drawn["failed"]
    return Weibull(
        float(beta),
        float(unit * eta),
        float(unit * found.qf(0.1)),
        tuple(map(float, found.param_cb("beta", alpha_ci=alpha))),
        tuple(map(float, unit * found.param_cb("alpha", alpha_ci=alpha))),
        tuple(map(float, unit * np.ravel(found.quantile_cb(0.1, alpha_ci=alpha)))),
        confidence,
        unit * drawn["x_"][failed],
        drawn["F"][failed],
    )


def write_weibull_plot(law: Any, title: str, path: Path) -> Path:
    """Weibull paper: lives at their median ranks, the law as a straight line, B10 with its interval; returns the path."""
    with picture(path, (6.4, 4.8), title) as figure:
        ax = figure.subplots()
        first, last = (law.eta * (-np.log1p(-share)) ** (1.0 / law.beta) for share in (0.01, 0.99))
        low = 0.97 * min(law.lives.min(), law.b10_interval[0], first)
        high = 1.03 * max(law.lives.max(), law.b10_interval[1], last)
        t = np.geomspace(low, high, 100)
        ax.plot(t, (t / law.eta) ** law.beta, color=MIDDLE, lw=1.4, label=f"β {law.beta:.3g}, η {hours_text(law.eta)}")
        ax.plot(law.lives, -np.log1p(-law.ranks), "o", color=FORCE, ms=4, label="lives, median ranks")
        ax.plot(law.b10_interval, [-np.log(0.9)] * 2, color=HEAD, lw=2.0, solid_capstyle="butt")
        label = f"B10 {hours_text(law.b10)}, {100 * law.confidence:g} % interval"
        ax.plot(law.b10, -np.log(0.9), "o", color=HEAD, ms=7, label=label)
        shares = np.array([0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 0.8, 0.95, 0.99])
        ax.set(
            xscale="log",
            yscale="log",
            xlabel="life [h]",
            ylabel="failed",
            xlim=(low, high),
            ylim=(0.6 * -np.log1p(-min(0.02, law.ranks.min())), 5.0),
        )
        ax.set_yticks(-np.log1p(-shares), [f"{100 * share:g} %" for share in shares])
        few_ticks(ax, np.geomspace(1.02 * low, 0.98 * high, 5))
        ax.minorticks_off()
        ax.legend(loc="upper left")
    return path
