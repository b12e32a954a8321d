"""Elliptic Hertz contact for the quasi-static model, written apart from the dynamics' own (hertz.py) so that each
checks the other.

    F(rho) = sum of the curvature differences / sum of the curvatures,   kappa = a/b >= 1,   m = 1 - 1/kappa^2
    F(rho) = ((kappa^2 + 1) E(m) - 2 F(m)) / ((kappa^2 - 1) E(m))        -> kappa
    a* = (2 kappa^2 E/pi)^(1/3),  b* = a*/kappa,  delta* = (2 F/pi) (pi/(2 kappa^2 E))^(1/3)

    c = 3 Q/(2 sum_rho E*):  a = a* c^(1/3),  b = b* c^(1/3),  delta = delta* c^(2/3) sum_rho/2,  p_max = 3 Q/(2 pi a b),  Q = K delta^1.5

F(m), E(m) complete elliptic integrals of first and second kind, 1/E* = sum (1 - nu^2)/E.   Harris & Kotzalas, Essential Concepts of Bearing
Technology (2006), ch. 6; Johnson, Contact Mechanics (1985), section 4.2.  Limit: kappa = 1 gives two spheres.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq
from scipy.special import ellipe, ellipkm1


class Ellipse(NamedTuple):
    """Dimensionless Hertz contact: kappa = a/b and the factors a*, b*, delta* [-]."""

    kappa: float
    a_star: float
    b_star: float
    delta_star: float


def hertz_ellipse(F_rho):
    """Dimensionless contact for the curvature difference F(rho) [-], 0 (sphere) <= F_rho < 1 (line contact, excluded).

    Raises ValueError outside.  Harris & Kotzalas (2006), ch. 6.

    >>> round(hertz_ellipse(0.95).delta_star, 3)
    0.577
    """
    if not 0.0 <= F_rho < 1.0:
        raise ValueError(f"F_rho = {F_rho}: must be at least 0 and less than 1")

    def difference(log_kappa):
        k2 = np.exp(2.0 * log_kappa)
        F, E = ellipkm1(1.0 / k2), ellipe(1.0 - 1.0 / k2)
        return ((k2 + 1.0) * E - 2.0 * F) / ((k2 - 1.0) * E) - F_rho

    # F(rho) is odd in log kappa and tends to 3/4 log kappa at the circle; there the quotient loses digits, and the line
    # is exact to F^3 = 1e-12
    kappa = np.exp(4.0 / 3.0 * F_rho if F_rho < 1e-4 else brentq(difference, 1e-5, 30.0, xtol=1e-15, rtol=1e-14))
    F, E = ellipkm1(1.0 / kappa**2), ellipe(1.0 - 1.0 / kappa**2)
    a_star = (2.0 * kappa**2 * E / np.pi) ** (1 / 3)
    return Ellipse(float(kappa), float(a_star), float(a_star / kappa), float(2.0 * F / np.pi / a_star))


@dataclass(frozen=True)
class HertzContact:
    """One elliptic contact of given curvatures; load Q [N] and approach delta [m] may be arrays."""

    sum_rho: float  # sum of the four principal curvatures [1/m]
    F_rho: float  # curvature difference [-]
    E_star: float  # 1/E* = sum (1 - nu^2)/E [Pa]
    ellipse: Ellipse

    @property
    def K(self):
        """Stiffness constant K of Q = K delta^1.5 [N/m^1.5]."""
        return 2.0 * self.sum_rho * self.E_star / 3.0 * (2.0 / (self.sum_rho * self.ellipse.delta_star)) ** 1.5

    def load(self, delta):
        """Load Q [N] at the approach delta [m]; none in separation."""
        return self.K * np.maximum(delta, 0.0) ** 1.5

    def semi_axes(self, Q):
        """Semi-axes a (across the rolling direction) and b (along it) [m] under the load Q [N]."""
        c = np.cbrt(1.5 * np.maximum(Q, 0.0) / (self.sum_rho * self.E_star))
        return self.ellipse.a_star * c, self.ellipse.b_star * c

    def p_max(self, Q):
        """Largest contact pressure [Pa] under the load Q [N]."""
        c = np.cbrt(1.5 * np.maximum(Q, 0.0) / (self.sum_rho * self.E_star))
        return c * self.sum_rho * self.E_star / (np.pi * self.ellipse.a_star * self.ellipse.b_star)


def ball_race_contact(D, d_m, f, alpha, E, nu, race, ball=None):
    """Hertz contact of a ball with a groove.

    D ball diameter, d_m pitch diameter [m], f groove radius / D [-], alpha contact angle [rad], E [Pa], nu [-] of the
    ring, race "inner" or "outer", ball: E and nu of the ball, None for those of the ring.
    Curvatures 2/D, 2/D of the ball, -1/(f D) across the groove, and along it gamma = D cos(alpha)/d_m:  (2/D) gamma/(1
    - gamma) inner, -(2/D) gamma/(1 + gamma) outer.  Harris & Kotzalas (2006), ch. 2.

    >>> contact = ball_race_contact(0.0111125, 0.0535, 0.515, 0.0, 207e9, 0.3, "inner")
    >>> print(f"{contact.K:.3e} N/m^1.5, {contact.p_max(1000.0) / 1e6:.0f} MPa")
    3.331e+10 N/m^1.5, 1942 MPa
    """
    side = {"inner": 1.0, "outer": -1.0}[race]
    gamma = D * np.cos(alpha) / d_m
    along = side * 2.0 / D * gamma / (1.0 - side * gamma)
    across = -1.0 / (f * D)
    sum_rho = 4.0 / D + along + across
    F_rho = (along - across) / sum_rho
    (E_b, nu_b), ring = ball or (E, nu), E / (1.0 - nu**2)
    return HertzContact(
        float(sum_rho), float(F_rho), ring / (1.0 + ring / (E_b / (1.0 - nu_b**2))), hertz_ellipse(F_rho)
    )
