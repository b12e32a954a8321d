"""Hertz' contact with exact elliptic integrals.

    kappa = a/b from  F(rho) = ((kappa^2 + 1) E - 2 F) / ((kappa^2 - 1) E),   F, E elliptic integrals of modulus^2 = 1 - 1/kappa^2,
    F(rho) = (rho_x - rho_y)/(rho_x + rho_y)
    a* = (2 kappa^2 E/pi)^(1/3),  b* = (2 E/(pi kappa))^(1/3),  delta* = (2 F/pi) (pi/(2 kappa^2 E))^(1/3)
    a = a* (3 Q/(2 sum_rho E_star))^(1/3),  delta = delta* (3 Q/(2 sum_rho E_star))^(2/3) sum_rho/2

Harris, Rolling Bearing Analysis, chapter 6.  kappa = 1 gives the sphere: a* = b* = delta* = 1.
"""

from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq
from scipy.special import ellipe, ellipkm1

from bearing_model.numbers.lanes import maximum


class Hertz(NamedTuple):
    """Constants of one contact."""

    K: float  # Q = K delta^1.5 [N/m^1.5]
    a: float  # semi-axes of the contact ellipse / Q^(1/3), a >= b [m/N^(1/3)]
    b: float
    a_delta: float  # a / delta^(1/2) [m^0.5]
    k: float  # a/b
    R_x: float  # reduced radius in the rolling direction [m]


def hertz_elliptic(kappa):
    """Complete elliptic integrals of the first and second kind of modulus^2 = 1 - 1/kappa^2."""
    m_1 = kappa**-2.0
    return ellipkm1(m_1), ellipe(1.0 - m_1)


def curvature_difference(kappa):
    """F(rho) of an ellipse with axes ratio kappa > 1."""
    k2 = kappa * kappa
    F, E = hertz_elliptic(kappa)
    return ((k2 + 1.0) * E - 2.0 * F) / ((k2 - 1.0) * E)


def hertz_contact(rho_x, rho_y, E_star):
    """Contact of bodies whose principal curvatures add up to rho_x in one direction and rho_y in the other [1/m], rho_x
    > rho_y >= 0.

    1/E_star = sum (1 - nu^2)/E [1/Pa].  The ellipse's long axis a lies along y.

    >>> print(f"{hertz_contact(100.0, 100.0, 1e11).K:.6e}")  # sphere on plane: (4/3) E_star sqrt(R)
    1.333333e+10
    """
    sum_ = rho_x + rho_y
    F_rho = min((rho_x - rho_y) / sum_, 1.0 - 1e-9)  # a line contact is out of range: kappa <= 1e5
    if F_rho > 1e-8:  # F(rho) grows with kappa; near the sphere it is (3/4)(kappa - 1)
        kappa = np.exp(
            brentq(
                lambda log_kappa: curvature_difference(np.exp(log_kappa)) - F_rho,
                1e-9,
                np.log(1e5),
                xtol=1e-15,
                rtol=1e-14,
            )
        )
    else:
        kappa = 1.0
    F, E = hertz_elliptic(kappa)
    a_star = np.cbrt(2.0 * kappa**2 * E / np.pi)
    b_star, delta_star = a_star / kappa, 2.0 * F / (np.pi * a_star)
    load = 3.0 / (2.0 * sum_ * E_star)  # (Q load)^(1/3) scales the ellipse
    compliance = delta_star * 0.5 * sum_ * np.cbrt(load) ** 2
    K, a = compliance**-1.5, a_star * np.cbrt(load)
    return Hertz(K=K, a=a, b=b_star * np.cbrt(load), a_delta=a * np.cbrt(K), k=kappa, R_x=1.0 / rho_x)


def hertz_load(K, delta):
    """Contact load Q = K delta^1.5 [N], none in separation.  C1 at touch-down.  Johnson (1985), eq. 4.23."""
    delta = maximum(delta, 0.0)
    return K * delta * np.sqrt(delta)


def hertz_damped(Q, lambda_, delta_dot):
    """Hunt-Crossley damping: Q (1 + lambda delta_dot) [N], never pulling.  Hunt & Crossley (1975), J. Appl. Mech. 42,
    440.
    """
    return Q * maximum(1.0 + lambda_ * delta_dot, 0.0)


def hertz_energy(K, delta):
    """Elastic energy (2/5) K delta^2.5 [J]."""
    return 0.4 * hertz_load(K, delta) * maximum(delta, 0.0)


def hertz_pressure(hertz, Q):
    """Largest pressure p_max = 3 Q/(2 pi a b) [Pa] of a contact."""
    return 1.5 * np.cbrt(Q) / (np.pi * hertz.a * hertz.b)
