"""A Gaussian process of one target over the unit cube of the parameters, with the noise of the seeds.

    y = c + b.u + g(u) + noise,   g ~ GP(0, a^2 exp(-1/2 sum ((u - u')/l)^2)),   c ~ N(0, 100), b ~ N(0, 4)

in units of the target's standard deviation over the points (Rasmussen and Williams 2006, chapters 2 and 5).  Length
scales l and amplitude a maximize the marginal likelihood with a weak prior, ln l ~ N(ln 1, 1).  The noise of a point's
mean is known from its seeds (two-way analysis of variance): seeds that all points share have a part in common, which no
number of points averages out; it is added to the variance of the prediction.
"""

import numpy as np
from scipy.linalg import cho_factor, cho_solve
from scipy.optimize import minimize

CONSTANT, SLOPE = 100.0, 4.0  # variances of c and b
LENGTHS, AMPLITUDES, NOISES = (0.08, 30.0), (1e-3, 10.0), (1e-6, 1.0)
JITTER = 1e-9
EVIDENCE = 4.0  # of ln likelihood: by chance in half a per cent
CLEAR = 6.0  # standard deviations of a point's noise: an effect beyond needs no test


def noise_parts(values):
    """Variance that the seeds leave in a point's mean, own and common, of [n, seeds]; nan, 0 with one seed."""
    n, seeds = values.shape
    if seeds < 2 or n < 2:
        return np.nan, 0.0
    rest = values - values.mean(axis=1, keepdims=True)
    shared = rest.mean(axis=0)
    own = ((rest - shared) ** 2).sum() / ((n - 1) * (seeds - 1))
    common = max(0.0, n * (shared**2).sum() / (seeds - 1) - own) / n
    return own / seeds, common / seeds


class Surrogate:
    """The prediction of a target from points u [n, d] of the unit cube and values [n, seeds]."""

    def __init__(self, u, values, active=None):
        whole, y = np.asarray(u, float), np.asarray(values, float).mean(axis=1)
        self.active = np.ones(whole.shape[1], bool) if active is None else active
        self.all, self.u = whole, whole[:, self.active]
        self.shift, self.size = y.mean(), max(y.std(), 1e-12 * abs(y.mean()), 1e-300)
        own, common = noise_parts(np.asarray(values, float))
        self.y = (y - self.shift) / self.size
        self.noise, self.common = own / self.size**2, common
        self.squares = (self.u[:, None, :] - self.u[None, :, :]) ** 2
        self.trend = CONSTANT + SLOPE * self.u @ self.u.T
        d = self.u.shape[1]
        limits = [np.log(LENGTHS)] * d + [np.log(AMPLITUDES)] + ([np.log(NOISES)] if np.isnan(self.noise) else [])
        start = [0.0] * d + [0.0] + ([np.log(1e-2)] if np.isnan(self.noise) else [])
        starts = [np.array(start), np.array(start) - np.array([1.0] * d + [1.0] * (len(start) - d))]
        best = min(
            (minimize(self.cost, x, jac=True, bounds=limits, method="L-BFGS-B") for x in starts), key=lambda f: f.fun
        )
        lengths, self.amplitude, self.loss = np.exp(best.x[:d]), np.exp(best.x[d]), float(best.fun)
        self.lengths = np.full(len(self.active), np.inf)
        self.lengths[self.active] = lengths
        if np.isnan(self.noise):
            self.noise = float(np.exp(best.x[d + 1]))
        G = self.amplitude**2 * np.exp(-0.5 * (self.squares / lengths**2).sum(axis=-1))
        K = self.trend + G + (self.noise + JITTER) * np.eye(len(y))
        factor = cho_factor(K, lower=True)
        self.alpha, self.inverse = cho_solve(factor, self.y), cho_solve(factor, np.eye(len(self.y)))

    def cost(self, x):
        """-ln of the marginal likelihood and prior, and its gradient; x: ln of lengths, amplitude and maybe noise."""
        d = self.u.shape[1]
        lengths, amplitude = np.exp(x[:d]), np.exp(x[d])
        noise = np.exp(x[d + 1]) if len(x) > d + 1 else self.noise
        G = amplitude**2 * np.exp(-0.5 * (self.squares / lengths**2).sum(axis=-1))
        K = self.trend + G + (noise + JITTER) * np.eye(len(self.y))
        try:
            factor = cho_factor(K, lower=True)
        except np.linalg.LinAlgError:
            return 1e12, np.zeros(len(x))
        alpha, inverse = cho_solve(factor, self.y), cho_solve(factor, np.eye(len(self.y)))
        value = 0.5 * self.y @ alpha + np.log(np.diag(factor[0])).sum() + 0.5 * (x[:d] ** 2).sum()
        W = 0.5 * (inverse - np.outer(alpha, alpha))
        gradient = [(W * G * self.squares[..., k]).sum() / lengths[k] ** 2 + x[k] for k in range(d)]
        gradient.append(2.0 * (W * G).sum())
        if len(x) > d + 1:
            gradient.append(noise * np.trace(W))
        return value, np.array(gradient)

    def __call__(self, u):
        """Mean and variance of the target at points u [m, d]."""
        mean, variance = Together([self])(u)
        return mean[:, 0], variance[:, 0]


def pruned(u, values):
    """The Surrogate without parameters whose loss costs less than EVIDENCE of ln likelihood."""
    found = Surrogate(u, values)
    line = np.full((11, u.shape[1]), 0.5)
    effects = []
    for j in range(u.shape[1]):
        at = line.copy()
        at[:, j] = np.linspace(0.0, 1.0, 11)
        effects.append(np.ptp(found(at)[0]))
    for j in np.argsort(effects):
        if effects[j] > CLEAR * found.size * np.sqrt(found.noise) and effects[j] > 1e-9 * found.size:
            continue
        active = found.active.copy()
        active[j] = False
        if not active.any():
            break
        without = Surrogate(u, values, active)
        if without.loss - found.loss < EVIDENCE:
            found = without
    return found


class Together:
    """Predictions of several surrogates over the same points at once."""

    CHUNK = 256  # points at a time, for the memory

    def __init__(self, surrogates):
        self.u = surrogates[0].all
        self.active = np.array([one.active for one in surrogates], float).T  # [d, k]
        self.sharpness = np.array([one.lengths**-2.0 for one in surrogates]).T  # [d, k]
        self.shift, self.size, self.common, self.amplitude = (
            np.array([getattr(one, name) for one in surrogates]) for name in ("shift", "size", "common", "amplitude")
        )
        self.alpha = np.array([one.alpha for one in surrogates]).T  # [n, k]
        self.inverse = np.array([one.inverse for one in surrogates])  # [k, n, n]

    def __call__(self, u):
        """Mean and variance at points u [m, d], both [m, k]."""
        u = np.atleast_2d(u)
        parts = [self.few(u[i : i + self.CHUNK]) for i in range(0, len(u), self.CHUNK)]
        return tuple(np.concatenate(one) for one in zip(*parts))

    def few(self, u):
        squares = (u[:, None, :] - self.u) ** 2  # [m, n, d]
        trend = CONSTANT + SLOPE * (u[:, None, :] * self.u) @ self.active
        cross = trend + self.amplitude**2 * np.exp(-0.5 * squares @ self.sharpness)  # [m, n, k]
        by_target = cross.transpose(2, 0, 1)
        explained = ((by_target @ self.inverse) * by_target).sum(axis=2).T
        own = CONSTANT + SLOPE * u**2 @ self.active + self.amplitude**2
        mean = self.shift + self.size * (cross * self.alpha).sum(axis=1)
        return mean, self.size**2 * np.maximum(own - explained, 0.0) + self.common
