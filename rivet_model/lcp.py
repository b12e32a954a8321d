"""Frictionless contact with rigid motions as a linear complementarity problem.

Find pressures p >= 0 and rigid motions q with

    gap = C p + g - D q >= 0,   p gap = 0,   D^T p + e q = f

C symmetric positive definite (elastic compliance), D q the approach by rigid motions, f the outer loads, e springs:
tiny ones hold motions which no contact resists.  Block principal pivoting (Judice and Pires 1994): all points of wrong
sign change between touching and open at once; when the number of wrong signs has not fallen for PATIENCE steps, only
the last such point changes (Murty), until the number falls again.  For positive definite C this always ends.
"""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import cho_factor, cho_solve

PATIENCE = 6  # block steps without progress before single pivots
LIMIT = 3000  # a guard against a matrix that is not positive definite


@dataclass
class Solution:
    """p, q, gap, number of iterations, and the largest violation of the conditions relative to the largest pressure and
    gap.
    """

    p: np.ndarray
    q: np.ndarray
    gap: np.ndarray
    active: np.ndarray
    iterations: int
    residual: float


class Contact:
    """C [n, n], D [n, m], springs e [m] or [m, m]: the part of the problem that does not depend on loads and gaps."""

    def __init__(self, C, D, springs):
        self.C, self.D, self.springs = C, D, np.diag(springs) if np.ndim(springs) == 1 else springs

    def solve_active(self, active, g, f):
        """p and q when exactly the active points touch."""
        A = np.flatnonzero(active)
        p = np.zeros(len(g))
        if len(A) == 0:
            return p, np.linalg.solve(self.springs, f)
        D = self.D[A]
        Y = cho_solve(
            cho_factor(self.C[np.ix_(A, A)], lower=True, overwrite_a=True, check_finite=False),
            np.column_stack([D, g[A]]),
            check_finite=False,
        )
        q = np.linalg.solve(D.T @ Y[:, :-1] + self.springs, f + D.T @ Y[:, -1])
        p[A] = Y[:, :-1] @ q - Y[:, -1]
        return p, q

    def solve(self, g, f, active=None):
        """Solution for gaps g and loads f, from the active set of a similar case if given.  Raises ArithmeticError past
        the limit.
        """
        active = (g <= 0.0) if active is None else active.copy()
        fewest, patience = len(g) + 1, PATIENCE
        for iteration in range(1, LIMIT + 1):
            p, q = self.solve_active(active, g, f)
            gap = self.C @ p + g - self.D @ q
            tiny_p, tiny_gap = (
                1e-12 * np.abs(p).max(initial=0.0),
                1e-12 * (np.abs(g).max(initial=0.0) + np.abs(self.D @ q).max(initial=0.0)),
            )
            wrong = np.where(active, p < -tiny_p, gap < -tiny_gap)
            count = np.count_nonzero(wrong)
            if count == 0:
                residual = max(
                    -p.min(initial=0.0) / max(p.max(initial=0.0), 1e-300),
                    -gap.min(initial=0.0) / max(np.abs(gap).max(initial=0.0), 1e-300),
                )
                return Solution(p, q, gap, active, iteration, residual)
            if count < fewest:
                fewest, patience = count, PATIENCE
            elif patience > 0:
                patience -= 1
            else:
                last = np.flatnonzero(wrong)[-1]
                wrong = np.zeros_like(wrong)
                wrong[last] = True
            active = active ^ wrong
        raise ArithmeticError(f"contact not found after {LIMIT} pivots: {count} wrong signs of {len(g)}")
